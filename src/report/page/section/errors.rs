//! Errors, alone and against costs.

use super::super::chart::{self, points, whole_error};
use super::super::document::{Block, Cell, Columns, Figure, Table};
use super::super::measure::{Measure, charted, headlines, measures};
use super::super::{budget, map};
use super::{drawing, heading, label, origins, parts_of, text};
use crate::report::data::{CostRow, ErrorMap, ErrorRow, Part, Report};

/// The part that the first chart shows: the one that most surfaces have.
const FIRST_PART: Part = Part::Dielectric;

pub(super) fn glance(report: &Report) -> Vec<Block> {
    if report.errors.is_empty() {
        return Vec::new();
    }
    let parts = parts_of(|part| report.errors.iter().any(|row| row.part == part && row.stratum == "all"));
    let measures = headlines(report);
    let mut blocks = vec![heading("At a glance")];
    // The chart has a name that stays the same, so that others can show it.
    let first = measures.first().map(|measure| (measure, points(report, *measure, FIRST_PART)));
    if let Some((measure, points)) = first.filter(|(_, points)| !points.is_empty()) {
        let title = format!("Error against cost: {}, {}", FIRST_PART.name(), measure.said());
        let svg = chart::draw(report, *measure, FIRST_PART, &points);
        blocks.extend([text(LEGEND), Block::Figures(Columns::One, vec![drawing("error-cost", title, svg)])]);
    }
    let mut columns = vec!["method".to_owned()];
    columns.extend(parts.iter().map(|part| format!("error, {}", part.name())));
    columns.extend(measures.iter().map(|measure| format!("cost: {} (×)", measure.said())));
    let rows = report.methods.iter().filter(|method| {
        let has_error = parts.iter().any(|part| whole_error(report, &method.name, *part).is_some());
        has_error || report.costs.iter().any(|row| row.method == method.name)
    });
    let rows = rows.map(|method| {
        let name = [Cell::text(&method.label)].into_iter();
        let errors = parts.iter().map(|part| error(report, &method.name, *part));
        name.chain(errors)
            .chain(measures.iter().map(|measure| ratio(report, &method.name, measure)))
            .collect()
    });
    let caption = "Mean error, and cost as a multiple of the published method's".to_owned();
    blocks.push(Block::Table(Table { caption, columns, rows: rows.collect(), folded: false }));
    let costs = report.costs.iter().filter(|row| {
        measures.iter().any(|measure| row.measure == measure.measure && row.stage == measure.stage)
    });
    blocks.push(origins(report, [report.errors_origin].into_iter().chain(costs.map(|row| row.origin))));
    blocks
}

fn error(report: &Report, method: &str, part: Part) -> Cell {
    whole_error(report, method, part).map_or_else(Cell::none, |row| Cell::percent(row.mean))
}

fn cost<'a>(report: &'a Report, method: &str, measure: &Measure) -> Option<&'a CostRow> {
    let mut rows = report.costs.iter();
    rows.find(|row| row.method == method && row.measure == measure.measure && row.stage == measure.stage)
}

fn ratio(report: &Report, method: &str, measure: &Measure) -> Cell {
    cost(report, method, measure).map_or_else(Cell::none, |row| Cell::figure(row.ratio))
}

/// How charts of error against cost are read.
const LEGEND: &str = "Each point is a method; names of quality levels are bold. The dashed steps are the frontier over all \
    methods: the least error that can be had for a cost. A hollow point lies behind it: another method is at least as cheap and \
    as close. Both axes are logarithmic. Errors above 100\u{202f}% are drawn at 100\u{202f}% with their figure, those below 0.001\u{202f}%, \
    which are but roundings, at 0.001\u{202f}%.";

pub(super) fn error_cost(report: &Report) -> Vec<Block> {
    let option = |measure: &Measure| {
        let figures = [Part::Specular, Part::Dielectric, Part::Fresnel, Part::Diffuse].into_iter();
        let figures = figures.filter_map(|part| {
            let points = points(report, *measure, part);
            let name = format!("error-cost {} {}", measure.name(), part.name());
            let title = format!("Error against cost: {}, {}", part.name(), measure.said());
            (!points.is_empty()).then(|| drawing(&name, title, chart::draw(report, *measure, part, &points)))
        });
        let figures: Vec<Figure> = figures.collect();
        let of = |row: &&CostRow| row.measure == measure.measure && row.stage == measure.stage;
        let best = |method: &str, part| {
            let points = points(report, *measure, part);
            let point = points.iter().find(|point| report.methods[point.method].name == method);
            match point {
                Some(point) if point.best => Cell::text("on"),
                Some(_) => Cell::text("behind"),
                None => Cell::none(),
            }
        };
        let rows = report.costs.iter().filter(of).map(|row| {
            vec![
                Cell::text(label(report, &row.method)),
                Cell::figure(row.value),
                Cell::text(&row.unit),
                Cell::figure(row.ratio),
                error(report, &row.method, Part::Specular),
                best(&row.method, Part::Specular),
                error(report, &row.method, Part::Dielectric),
                best(&row.method, Part::Dielectric),
            ]
        });
        let columns = [
            "method",
            "cost",
            "unit",
            "over published (×)",
            "error, specular",
            "frontier, specular",
            "error, dielectric",
            "frontier, dielectric",
        ];
        let table = Table::new(&format!("Costs: {}", measure.said()), &columns, rows.collect());
        let indices = report.costs.iter().filter(of).map(|row| row.origin).chain([report.errors_origin]);
        let mut blocks = Vec::new();
        if !figures.is_empty() {
            blocks.push(Block::Figures(Columns::Two, figures));
        }
        blocks.extend([origins(report, indices), Block::Table(table)]);
        (measure.said(), blocks)
    };
    let options: Vec<_> = charted(report).iter().map(option).collect();
    if options.is_empty() {
        return Vec::new();
    }
    let mut blocks = vec![
        heading("Error against cost"),
        text(
            "No single figure is what a method costs; these are several, each blind to something else. Slots executed: what the \
             path that an input takes needs, a division or root as several slots; it knows nothing of registers and waiting. \
             Inverse throughput: cycles for each wave as a compiler for a graphics processor estimates them, which guesses how \
             often branches are taken; of methods with loops it knows nothing, so they are not there. Time and instructions on a \
             CPU: of the same shader on a software renderer, which runs both sides of most branches.",
        ),
        Block::Choice("Cost measured as".to_owned(), options),
    ];
    let mut groups: Vec<(&str, Vec<Measure>)> = Vec::new();
    for measure in measures(report) {
        match groups.iter_mut().find(|(group, _)| *group == measure.group()) {
            Some((_, members)) => members.push(measure),
            None => groups.push((measure.group(), vec![measure])),
        }
    }
    blocks.push(Block::Heading(3, "All measures".to_owned()));
    blocks.push(text(
        "Waves are how many run at once, where more is better. Registers, waves and the length of code are no times.",
    ));
    // Single ones have a table above.
    let is_shown = |measure: &Measure| charted(report).contains(measure);
    for (group, members) in groups.into_iter().filter(|(_, members)| !members.iter().all(is_shown)) {
        blocks.extend(all_costs(report, group, &members));
    }
    blocks.push(origins(report, report.costs.iter().map(|row| row.origin)));
    blocks
}

/// Every figure of a group of measures, and its ratio.
fn all_costs(report: &Report, group: &str, members: &[Measure]) -> [Block; 2] {
    let table = |caption: &str, name: &dyn Fn(&Measure) -> String, cell: &dyn Fn(&CostRow) -> Cell| {
        let columns = members.iter().map(name);
        let columns = ["method".to_owned()].into_iter().chain(columns).collect();
        let measured = report
            .methods
            .iter()
            .filter(|method| members.iter().any(|member| cost(report, &method.name, member).is_some()));
        let rows = measured.map(|method| {
            let cells =
                members.iter().map(|member| cost(report, &method.name, member).map_or_else(Cell::none, cell));
            [Cell::text(&method.label)].into_iter().chain(cells).collect()
        });
        let caption = format!("All of {group}: {caption}");
        Block::Table(Table { caption, columns, rows: rows.collect(), folded: true })
    };
    let unit = |member: &Measure| {
        let mut rows = report.costs.iter();
        let row = rows.find(|row| row.measure == member.measure && row.stage == member.stage);
        row.map_or("", |row| row.unit.as_str())
    };
    let named = |member: &Measure| {
        let name = member.name();
        name.strip_prefix(group).map_or_else(|| name.clone(), |rest| rest.trim_start().to_owned())
    };
    let with_unit = |member: &Measure| format!("{} ({})", named(member), unit(member));
    let over = |member: &Measure| format!("{} (×)", named(member));
    [
        table("figures", &with_unit, &|row| Cell::figure(row.value)),
        table("over published", &over, &|row| Cell::figure(row.ratio)),
    ]
}

pub(super) fn maps(report: &Report) -> Vec<Block> {
    if report.maps.is_empty() && report.errors.iter().all(|row| row.stratum == "all") {
        return Vec::new();
    }
    let mut blocks = vec![
        heading("Where errors are"),
        text(
            "Mean error by roughness and by the angle of the view. Colours of one group of maps mean the same: dark is little, bright \
         is much, on a logarithmic scale. Beyond the range of the key colours stay at its ends.",
        ),
    ];
    let option = |part: Part| {
        let maps: Vec<&ErrorMap> = report.maps.iter().filter(|map| map.part == part).collect();
        let bounds = map::bounds(maps.iter().copied());
        let title = format!("Mean |error| / mean value, {} (%)", part.name());
        let key = drawing(&format!("map {} key", part.name()), title.clone(), map::key(bounds, &title));
        let figures = maps.iter().map(|shown| {
            let title = format!("{}: {}", label(report, &shown.method), part.name());
            let svg = map::draw(shown, &title, bounds);
            drawing(&format!("map {} {}", part.name(), shown.method), title, svg)
        });
        let blocks = vec![
            Block::Figures(Columns::Two, vec![key]),
            Block::Figures(Columns::Three, figures.collect()),
            origins(report, [report.maps_origin]),
        ];
        (part.name().to_owned(), blocks)
    };
    let order = [Part::Specular, Part::Dielectric, Part::Fresnel, Part::Diffuse].into_iter();
    let options: Vec<_> =
        order.filter(|part| report.maps.iter().any(|map| map.part == *part)).map(option).collect();
    if !options.is_empty() {
        blocks.push(Block::Choice("Error of".to_owned(), options));
    }
    for part in parts_of(|part| report.errors.iter().any(|row| row.part == part && row.stratum != "all")) {
        blocks.extend(strata(report, part));
    }
    blocks
}

/// Methods over strata of inputs.
fn strata(report: &Report, part: Part) -> Option<Block> {
    let mut strata: Vec<&str> = Vec::new();
    for row in report.errors.iter().filter(|row| row.part == part) {
        if !strata.contains(&row.stratum.as_str()) {
            strata.push(&row.stratum);
        }
    }
    let columns: Vec<&str> = ["method"].into_iter().chain(strata.iter().copied()).collect();
    let rows: Vec<Vec<Cell>> = report
        .methods
        .iter()
        .filter(|method| report.errors.iter().any(|row| row.part == part && row.method == method.name))
        .map(|method| {
            let cell = |stratum: &&str| {
                let row = report
                    .errors
                    .iter()
                    .find(|row| row.part == part && row.method == method.name && row.stratum == **stratum);
                row.map_or_else(Cell::none, |row| Cell::percent(row.mean))
            };
            [Cell::text(&method.label)].into_iter().chain(strata.iter().map(cell)).collect()
        })
        .collect();
    (!rows.is_empty()).then(|| {
        let caption =
            format!("Mean error by range of inputs (view: its cosine with the normal): {}", part.name());
        Block::Table(Table::new(&caption, &columns, rows).folded())
    })
}

pub(super) fn causes(report: &Report) -> Vec<Block> {
    if report.budget.is_empty() {
        return Vec::new();
    }
    let mut blocks = vec![
        heading("Where errors come from"),
        text(
            "What each cause adds to the mean error when causes are added one by one, from the lobe model down to single precision; an \
         upright mark is the error of the method itself, measured on its own. A cause that takes away stands left of zero. Since \
         causes span many powers of ten, further charts show each of them alone; what is below 10⁻⁶ % is drawn there. Where a \
         method has no fit or horizon of its own, that is part of its lobe model. These are fewer lights than those of the tables \
         above, so that totals differ a little.",
        ),
    ];
    let parts = parts_of(|part| report.budget.iter().any(|row| row.part == part));
    let figures = |name: &str, title: &str, draw: &dyn Fn(&Report, Part) -> String| {
        let figure = |part: &Part| {
            drawing(
                &format!("{name} {}", part.name()),
                format!("{title}: {}", part.name()),
                draw(report, *part),
            )
        };
        Block::Figures(Columns::Two, parts.iter().map(figure).collect())
    };
    blocks.push(figures("budget", "Where the error comes from", &budget::stacked));
    blocks.push(figures("budget alone", "Each cause alone", &budget::alone));
    blocks.push(origins(report, [report.budget_origin]));
    let rows = report.budget.iter().map(|row| {
        vec![
            Cell::text(label(report, &row.method)),
            Cell::text(row.part.name()),
            Cell::text(&row.cause),
            Cell::percent(row.alone),
            Cell::signed_percent(row.added),
        ]
    });
    let columns = ["method", "part", "cause", "alone", "adds"];
    blocks.push(Block::Table(Table::new("All causes", &columns, rows.collect()).folded()));
    blocks
}

pub(super) fn bias(report: &Report) -> Vec<Block> {
    if report.errors.is_empty() {
        return Vec::new();
    }
    let cells = |row: &ErrorRow| {
        [
            Cell::count(row.count as u64),
            Cell::percent(row.mean),
            Cell::signed_percent(row.bias),
            Cell::percent(row.percentile),
            Cell::percent(row.maximum),
        ]
    };
    let option = |part: Part| {
        let rows = report.errors.iter().filter(|row| row.part == part && row.stratum == "all");
        let rows =
            rows.map(|row| [Cell::text(label(report, &row.method))].into_iter().chain(cells(row)).collect());
        let columns = ["method", "inputs", "mean |error|", "bias (signed)", "99th percentile", "largest"];
        let caption = format!("On all inputs: {}", part.name());
        (part.name().to_owned(), vec![Block::Table(Table::new(&caption, &columns, rows.collect()))])
    };
    let order = [Part::Specular, Part::Dielectric, Part::Fresnel, Part::Diffuse].into_iter();
    let present = |part: &Part| report.errors.iter().any(|row| row.part == *part && row.stratum == "all");
    let options: Vec<_> = order.filter(present).map(option).collect();
    let all = report.errors.iter().map(|row| {
        let names =
            [label(report, &row.method), row.part.name().to_owned(), row.stratum.clone()].map(Cell::text);
        names.into_iter().chain(cells(row)).collect()
    });
    let columns =
        ["method", "part", "range", "inputs", "mean |error|", "bias (signed)", "99th percentile", "largest"];
    let mut blocks = vec![
        heading("Bias and percentiles"),
        text(
            "All over the mean value. A positive bias is too bright. The percentile and the largest error are of single inputs, so \
             they may exceed 100 %.",
        ),
    ];
    if !options.is_empty() {
        blocks.push(Block::Choice("Error of".to_owned(), options));
    }
    blocks.push(Block::Table(Table::new("By range of inputs", &columns, all.collect()).folded()));
    blocks.push(origins(report, [report.errors_origin]));
    blocks
}

pub(super) fn sweeps(report: &Report) -> Vec<Block> {
    if report.sweeps.is_empty() {
        return Vec::new();
    }
    let rows = report.sweeps.iter().map(|row| {
        vec![
            Cell::code(&row.function),
            Cell::text(&row.domain),
            Cell::count(row.count),
            Cell::text(if row.exhaustive { "every float" } else { "sampled" }),
            Cell::figure(row.maximum),
            Cell::text(&row.unit),
            Cell::figure(row.worst),
        ]
    });
    let columns = ["function", "domain", "inputs", "which", "largest error", "in", "at"];
    vec![
        heading("Approximations of one variable"),
        text(
            "The include's own polynomials against the functions that they stand for. Where it says \"every float\", there is no \
             input of the domain that was not tried.",
        ),
        Block::Table(Table::new("Largest errors", &columns, rows.collect())),
        origins(report, [report.sweeps_origin]),
    ]
}
