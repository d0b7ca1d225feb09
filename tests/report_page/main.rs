//! What a report shows is what it holds, and it needs nothing else to be seen.

mod layout;
mod sample;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;
use std::sync::OnceLock;

use sample::report;
use serde::de::DeserializeOwned;
use softbox::report::data::{ErrorMap, ErrorRow, MethodInfo, Part, Report};
use softbox::report::page::{self, LobePlot, PageError, PictureFile, chart_svg};

type Files = BTreeMap<String, Vec<u8>>;

fn files(report: &Report, pictures: &[PictureFile]) -> Files {
    let plots = [LobePlot::ggx(0.5, 0.4), LobePlot { label: "other".to_owned(), ..LobePlot::ggx(0.6, 0.4) }];
    let plots = plots.map(|plot| LobePlot { roughness: 0.5, ..plot });
    page::files(report, &plots, pictures).expect("the report is whole").into_iter().collect()
}

/// The sample and its files, made once.
fn whole() -> &'static (Report, Vec<PictureFile>, Files) {
    static WHOLE: OnceLock<(Report, Vec<PictureFile>, Files)> = OnceLock::new();
    WHOLE.get_or_init(|| {
        let (report, pictures) = report();
        let files = files(&report, &pictures);
        (report, pictures, files)
    })
}

fn text(files: &Files, name: &str) -> String {
    String::from_utf8(files[name].clone()).unwrap_or_else(|_| panic!("{name} is text"))
}

/// A new folder below the system's temporary one.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("softbox-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("the temporary folder can be written to");
    folder
}

/// Asserts that every element of an HTML text is closed by its own end.
fn assert_nested(html: &str) {
    const EMPTY: [&str; 4] = ["meta", "br", "img", "!DOCTYPE"];
    let (mut open, mut rest) = (Vec::new(), html);
    while let Some(start) = rest.find('<') {
        let tag = &rest[start + 1..];
        let end = tag.find('>').unwrap_or_else(|| panic!("no end of the tag {}", &tag[..tag.len().min(60)]));
        let (tag, after) = (&tag[..end], &tag[end + 1..]);
        let name = tag.split([' ', '\n']).next().unwrap_or_default();
        rest = after;
        if let Some(name) = name.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "before {}", &rest[..rest.len().min(60)]);
        } else if !EMPTY.contains(&name) {
            assert_eq!(tag.matches('"').count() % 2, 0, "quotes in {tag}");
            open.push(name);
            if matches!(name, "script" | "style") {
                rest = &rest[rest.find(&format!("</{name}")).expect("it ends")..];
            }
        }
    }
    assert!(open.is_empty(), "{open:?} stay open");
}

#[test]
fn page_is_well_formed_and_names_every_method() {
    let (report, _, files) = whole();
    let (html, markdown) = (text(files, "index.html"), text(files, "report.md"));
    assert_nested(&html);
    for MethodInfo { name, label, description, .. } in &report.methods {
        for said in [name, label, &description.replace('\'', "&#39;")] {
            let said = said.replace('"', "&quot;");
            assert!(html.contains(&said) || html.contains(&said.replace("&#39;", "'")), "{said}");
        }
        assert!(markdown.contains(&format!("| `{name}` | {label} |")), "{name}");
    }
    for origin in &report.origins {
        assert!(html.contains(&origin.command) && html.contains(&origin.device), "{origin:?}");
    }
    for (name, bytes) in files.iter().filter(|(name, _)| name.ends_with(".svg")) {
        let chart = std::str::from_utf8(bytes).expect("charts are text");
        if let Err(error) = roxmltree::Document::parse(chart) {
            panic!("{name}: {error}");
        }
    }
}

#[test]
fn page_refers_to_nothing_outside() {
    let html = text(&whole().2, "index.html");
    let bare = html.replace("xmlns=\"http://www.w3.org/2000/svg\"", "");
    for word in ["http:", "https:", "<link", "@import", "url(", "fetch(", "XMLHttpRequest"] {
        assert!(!bare.contains(word), "{word}");
    }
    for (attribute, start) in [("src=\"", "data:image/png;base64,"), ("href=\"", "#")] {
        let mut count = 0;
        for value in bare.split(attribute).skip(1) {
            assert!(value.starts_with(start), "{attribute}{}", &value[..value.len().min(60)]);
            count += 1;
        }
        assert!(count > 5, "the page has {count} of {attribute}");
    }
}

#[test]
fn markdown_shows_files_that_are_there() {
    let (_, pictures, files) = whole();
    let markdown = text(files, "report.md");
    let mut shown = BTreeSet::new();
    for link in markdown.split("](").skip(1) {
        let name = &link[..link.find(')').expect("links end")];
        assert!(files.contains_key(name), "{name}");
        shown.insert(name);
    }
    let pictured = files.keys().filter(|name| name.ends_with(".svg") || name.ends_with(".png"));
    for name in pictured {
        assert!(shown.contains(name.as_str()), "{name} is nowhere shown");
    }
    for (name, bytes) in pictures {
        assert_eq!(files[name], *bytes, "{name} is whole");
    }
}

fn rows<Row: DeserializeOwned>(files: &Files, name: &str) -> Vec<Row> {
    let mut reader = csv::Reader::from_reader(files[&format!("data/{name}.csv")].as_slice());
    reader.deserialize().map(|row| row.unwrap_or_else(|error| panic!("{name}: {error}"))).collect()
}

#[test]
fn tables_for_programs_hold_every_row() {
    let (report, _, files) = whole();
    let read: Report = serde_json::from_slice(&files["report.json"]).expect("it is a report");
    assert_eq!(read, *report);
    assert_eq!(rows::<MethodInfo>(files, "methods"), report.methods);
    assert_eq!(rows::<ErrorRow>(files, "errors"), report.errors);
    assert_eq!(rows::<softbox::report::data::BudgetRow>(files, "budget"), report.budget);
    assert_eq!(rows::<softbox::report::data::SweepRow>(files, "sweeps"), report.sweeps);
    assert_eq!(rows::<softbox::report::data::CostRow>(files, "costs"), report.costs);
    assert_eq!(rows::<softbox::report::data::PictureRow>(files, "pictures"), report.pictures);
    let mut cells = rows::<(String, Part, f64, f64, f64)>(files, "maps").into_iter();
    for ErrorMap { method, part, roughness, cosine, values } in &report.maps {
        for (row, column) in (0..cosine.len()).flat_map(|row| (0..roughness.len()).map(move |c| (row, c))) {
            let expected = (method.clone(), *part, roughness[column], cosine[row], values[row][column]);
            assert_eq!(cells.next(), Some(expected));
        }
    }
    assert_eq!(cells.next(), None);
    let mut points =
        rows::<(String, String, String, f64, String, String, f64, usize)>(files, "growth").into_iter();
    for curve in &report.growth {
        for index in 0..curve.y.len() {
            let point = points.next().unwrap_or_else(|| panic!("{curve:?} is whole"));
            assert_eq!((&point.0, &point.1), (&curve.chart, &curve.method));
            assert_eq!((point.3, point.6), (curve.x[index], curve.y[index]));
        }
    }
    assert_eq!(points.count(), 0);
    assert_eq!(rows::<(usize, String, String, String)>(files, "origins").len(), report.origins.len());
    assert_eq!(rows::<(String, Part, f64, f64, f64, f64)>(files, "lobes").len(), report.lobes.len());
}

/// All numbers of a JSON value, as bits.
fn numbers(value: &serde_json::Value, found: &mut BTreeSet<u64>) {
    match value {
        serde_json::Value::Number(number) => {
            found.extend(number.as_f64().map(f64::to_bits));
        }
        serde_json::Value::Array(list) => list.iter().for_each(|value| numbers(value, found)),
        serde_json::Value::Object(members) => members.values().for_each(|value| numbers(value, found)),
        _ => {}
    }
}

/// The number that a cell shows, and half a unit of its last digit.
fn shown(cell: &str) -> (f64, f64) {
    let plain = cell.replace('−', "-").replace(['\u{202f}', '+'], "");
    let (plain, unit) = plain.strip_suffix('%').map_or((plain.as_str(), 1.0), |share| (share, 0.01));
    let raised = |power: &str| -> i32 {
        let digit = |sign| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|known| known == sign);
        let text: String =
            power.chars().map(|sign| digit(sign).map_or("-".to_owned(), |digit| digit.to_string())).collect();
        text.parse().unwrap_or_else(|_| panic!("the power in {cell}"))
    };
    let (mantissa, power) =
        plain.split_once("·10").map_or((plain, 0), |(mantissa, power)| (mantissa, raised(power)));
    let unit = unit * 10_f64.powi(power);
    let decimals = mantissa.find('.').map_or(0, |point| mantissa.len() - point - 1) as i32;
    let value: f64 = mantissa.parse().unwrap_or_else(|_| panic!("the figure {cell}"));
    (unit * value, 0.5 * unit * 10_f64.powi(-decimals))
}

#[test]
fn figures_of_tables_are_those_of_the_report() {
    let (report, _, files) = whole();
    let (html, markdown) = (text(files, "index.html"), text(files, "report.md"));
    let mut known = BTreeSet::new();
    numbers(&serde_json::from_slice(&files["report.json"]).expect("it is JSON"), &mut known);
    let mut found = BTreeSet::new();
    for cell in html.split("data-value=\"").skip(1) {
        let (value, rest) = cell.split_once('"').expect("attributes end");
        let value: f64 = value.parse().expect("it is a number");
        let shown_text = &rest[rest.find('>').expect("tags end") + 1..rest.find("</td>").expect("cells end")];
        assert!(known.contains(&value.to_bits()), "{value} is not in the report");
        let (read, half) = shown(shown_text);
        assert!((read - value).abs() <= half * 1.0001, "{shown_text} shows {value}");
        assert!(markdown.contains(&format!("| {shown_text} |")), "{shown_text} is not in the Markdown text");
        found.insert(value.to_bits());
    }
    let errors = report.errors.iter().flat_map(|row| [row.mean, row.bias, row.percentile, row.maximum]);
    let others = report.costs.iter().flat_map(|row| [row.value, row.ratio]);
    let others = others.chain(report.sweeps.iter().map(|row| row.maximum));
    for value in errors.chain(others).chain(report.budget.iter().map(|row| row.alone)) {
        assert!(found.contains(&value.to_bits()), "{value} is in no table");
    }
}

#[test]
fn chart_has_every_method_that_was_measured() {
    let (report, _) = report();
    let svg = chart_svg(&report, "navi21 instructions", Part::Specular).expect("it was measured");
    let parsed = roxmltree::Document::parse(&svg).expect("it is SVG");
    let labels: BTreeSet<&str> = parsed
        .descendants()
        .filter(|node| node.attribute("class") == Some("label"))
        .filter_map(|node| node.text())
        .collect();
    let measured = report.methods.iter().filter(|method| method.name != "truth");
    assert_eq!(labels, measured.map(|method| method.label.as_str()).collect());
    let points = parsed.descendants().filter(|node| node.attribute("class") == Some("point"));
    for point in points {
        let title = point.children().find_map(|node| node.children().find_map(|text| text.text()));
        let title = title.expect("points say what they are");
        let hollow = point.descendants().any(|node| node.attribute("fill") == Some("#fff"));
        assert_eq!(hollow, title.contains("cheaper and closer"), "{title}");
    }
    // The chart that stands first has a name of its own, and nothing that a picture may not hold.
    let first = text(&whole().2, "charts/error-cost.svg");
    let made = chart_svg(&report, "navi21 inverse throughput", Part::Dielectric);
    assert_eq!(Some(&first), made.as_ref());
    for word in ["<script", "<foreignObject", "href", "url("] {
        assert!(!first.contains(word), "{word}");
    }
    assert_eq!(chart_svg(&report, "no such measure", Part::Specular), None);
    let fragment = chart_svg(&report, "navi21 instructions, fragment", Part::Specular);
    assert!(fragment.is_some_and(|fragment| fragment != svg));
}

#[test]
fn useless_and_exact_methods_do_not_squeeze_a_chart() {
    let (mut report, _) = report();
    let height = |report: &Report, method: &str| {
        let svg = chart_svg(report, "navi21 instructions", Part::Specular).expect("it was measured");
        let parsed = roxmltree::Document::parse(&svg).expect("it is SVG");
        let label =
            report.methods.iter().find(|known| known.name == method).expect("it is there").label.clone();
        let point = parsed.descendants().find(|node| {
            let title = node.children().find(|child| child.has_tag_name("title"));
            let said = title.and_then(|title| title.text()).unwrap_or_default();
            said.starts_with(&format!("{label}\n"))
        });
        let circle = point.expect("it is drawn").descendants().find(|node| node.has_tag_name("circle"));
        let height = circle.and_then(|circle| circle.attribute("cy")?.parse::<f64>().ok());
        (height.expect("points have a place"), svg)
    };
    let mut set = |method: &str, mean: f64| {
        let row = report
            .errors
            .iter_mut()
            .find(|row| row.method == method && row.part == Part::Specular && row.stratum == "all");
        row.expect("it is there").mean = mean;
        height(&report, method)
    };
    let (edge, _) = set("representative", 1.0);
    let (beyond, svg) = set("representative", 50.0);
    assert_eq!(beyond, edge, "what lies beyond stays at the edge");
    assert!(svg.contains("↑ 5000\u{202f}%"), "and says how far");
    let (least, _) = set("fast", 1e-5);
    assert_eq!(set("fast", 1e-9).0, least, "roundings are alike");
}

#[test]
fn texts_are_not_taken_for_markup() {
    let (mut report, pictures) = report();
    report.methods[1].label = "<script>\"&'|*".to_owned();
    report.growth[0].x_label = "a<b".to_owned();
    let files = files(&report, &pictures);
    let html = text(&files, "index.html");
    assert_nested(&html);
    assert_eq!(html.matches("<script").count(), 1, "the page's own");
    assert!(text(&files, "report.md").contains("\\|\\*"));
}

#[test]
fn empty_report_has_a_page() {
    let files: Files =
        page::files(&Report::default(), &[], &[]).expect("nothing is wrong with it").into_iter().collect();
    assert_nested(&text(&files, "index.html"));
}

#[test]
fn contradictions_are_refused_by_name() {
    let (whole, pictures) = report();
    let refused = |spoil: &dyn Fn(&mut Report), words: &[&str]| {
        let mut report = whole.clone();
        spoil(&mut report);
        let error = page::files(&report, &[], &pictures).expect_err("it is not whole").to_string();
        for word in words {
            assert!(error.contains(word), "{error} names {word}");
        }
    };
    refused(&|report| report.errors[3].bias = f64::NAN, &["fast", "roughness 0.6-1", "NaN"]);
    refused(&|report| report.costs[0].method = "fasst".to_owned(), &["costs", "fasst"]);
    refused(&|report| report.costs[0].origin = 99, &["costs", "99"]);
    refused(&|report| report.methods[1].name = "fast".to_owned(), &["fast", "twice"]);
    refused(
        &|report| {
            report.maps[0].values.pop();
        },
        &["map", "fast"],
    );
    refused(
        &|report| {
            report.growth[0].x.pop();
        },
        &["growth", "lights"],
    );
    refused(&|report| report.errors[1] = report.errors[0].clone(), &["fast", "twice"]);
    refused(&|report| report.pictures[0].picture = "../away.png".to_owned(), &["../away.png"]);
    refused(&|report| report.pictures[0].picture = "lost.png".to_owned(), &["lost.png"]);
}

#[test]
fn folder_of_something_else_is_left_alone() {
    let (report, pictures) = report();
    let parent = folder("foreign");
    let taken = parent.join("taken");
    fs::create_dir(&taken).expect("it is new");
    fs::write(taken.join("letter.txt"), "dear").expect("it is new");
    let error = page::write(&report, &[], &pictures, &taken).expect_err("it holds a letter");
    assert!(matches!(error, PageError::Write(_)) && error.to_string().contains("letter.txt"), "{error}");
    assert_eq!(fs::read_to_string(taken.join("letter.txt")).expect("it is there"), "dear");

    // A folder with a list of files, but not of a report's.
    fs::remove_file(taken.join("letter.txt")).expect("it is there");
    fs::write(taken.join("MANIFEST"), "MANIFEST\nwgsl/ltc.wgsl\n").expect("it is new");
    let error = page::write(&report, &[], &pictures, &taken).expect_err("it is no report");
    assert!(error.to_string().contains("MANIFEST"), "{error}");

    let own = parent.join("own");
    page::write(&report, &[], &pictures, &own).expect("there is nothing yet");
    assert!(own.join("data/errors.csv").exists());
    let fewer = Report { errors: Vec::new(), pictures: Vec::new(), ..report.clone() };
    page::write(&fewer, &[], &[], &own).expect("it is an older report");
    assert!(!own.join(&pictures[0].0).exists(), "nothing of the older one is left");
    fs::write(own.join("notes.txt"), "mine").expect("it is new");
    page::write(&report, &[], &pictures, &own).expect_err("notes are no part of a report");
    let left: BTreeSet<String> = fs::read_dir(&parent)
        .expect("it is there")
        .map(|entry| entry.expect("it can be read").file_name().to_string_lossy().into_owned())
        .collect();
    assert_eq!(left, ["own", "taken"].map(str::to_owned).into());
    fs::remove_dir_all(parent).expect("it is ours");
}
