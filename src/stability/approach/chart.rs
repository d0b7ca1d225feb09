//! Curves as pictures and as numbers.

use super::curve::{Curve, Method};
use super::list::{Measure, Part};
use super::published::EdgeForm;
use crate::effects::Quality;
use crate::report::page::{ErrorLine, Series, SmallChart, small_charts};

/// Approaches that the overview shows: those that say most, in its order.
const OVERVIEW: [&str; 12] = [
    "gap",
    "gap-glossy",
    "distance",
    "rising",
    "edge-on",
    "thin",
    "view-normal",
    "disk-axis",
    "disk-large",
    "disk-small",
    "tube-short",
    "tube-end-on",
];

/// The name of the overview among the charts.
pub const OVERVIEW_NAME: &str = "stability";

fn series() -> Vec<Series> {
    let series = |name: &str, colour, width| Series { name: name.to_owned(), colour, width };
    vec![
        series("published 2016: arc cosine", "#e69f00", 1.4),
        series("published 2017: rational fit; disk; line", "#d55e00", 1.4),
        series("Softbox, fast", "#56b4e9", 1.4),
        series("Softbox, standard to finest", "#0072b2", 2.0),
    ]
}

fn series_of(method: Method) -> usize {
    match method {
        Method::Polygon(EdgeForm::Printed) => 0,
        Method::Polygon(EdgeForm::Fitted) | Method::Disk | Method::Line => 1,
        Method::Level(Quality::Fast) => 2,
        Method::Level(_) => 3,
    }
}

/// The chart of one approach from its curves. The exact levels are one line: the worst of them.
fn small_chart(curves: &[&Curve]) -> SmallChart {
    let approach = curves[0].approach;
    let [low, high] = approach.range;
    let mut lines: Vec<ErrorLine> = Vec::new();
    for curve in curves {
        let series = series_of(curve.method);
        let points = curve.steps.iter().map(|step| [step.parameter, step.error]);
        let share = |step: &super::Step| step.not_finite as f64 / step.count as f64;
        let marks =
            curve.steps.iter().map(|step| [step.parameter, share(step)]).filter(|[_, share]| *share > 0.0);
        match lines.iter_mut().find(|line| line.series == series) {
            Some(line) => {
                for (worst, [_, error]) in line.points.iter_mut().zip(points) {
                    worst[1] = worst[1].max(error);
                }
                line.not_finite.extend(marks);
            }
            None => lines.push(ErrorLine { series, points: points.collect(), not_finite: marks.collect() }),
        }
    }
    // Where no value is finite there is no error to draw.
    for (line, curve) in lines.iter_mut().zip(curves) {
        line.points.retain(|[parameter, _]| {
            let step = curve.steps.iter().find(|step| step.parameter == *parameter);
            step.is_none_or(|step| step.not_finite < step.count)
        });
    }
    let exact = curves.iter().find(|curve| curve.method == Method::Level(Quality::Standard));
    let bound = exact.map(|curve| curve.steps.iter().map(|step| [step.parameter, step.bound]).collect());
    let part = match approach.part {
        Part::Diffuse => "form factor",
        Part::Specular => "specular",
    };
    let measure = match approach.measure {
        Measure::Absolute => "error",
        Measure::Relative => "relative error",
        Measure::OfLight => "error of its form factor",
    };
    SmallChart {
        title: approach.title.to_owned(),
        parameter: approach.parameter.to_owned(),
        measure: format!("{part}, {measure}"),
        ends: if approach.rises { [low, high] } else { [high, low] },
        lines,
        bound: bound.unwrap_or_default(),
    }
}

/// Pictures of curves as SVG documents with their names: an overview of those that say most, and one for each approach.
pub fn charts(curves: &[Curve]) -> Vec<(String, String)> {
    let mut names: Vec<&str> = curves.iter().map(|curve| curve.approach.name).collect();
    names.dedup();
    let chart = |name: &str| {
        let of: Vec<&Curve> = curves.iter().filter(|curve| curve.approach.name == name).collect();
        (!of.is_empty()).then(|| small_chart(&of))
    };
    let shown: Vec<SmallChart> = OVERVIEW.iter().filter_map(|name| chart(name)).collect();
    let title = format!(
        "Rounding error in f32 on {} of {} ways to hard cases, each method against itself in exact arithmetic",
        shown.len(),
        names.len()
    );
    let mut documents =
        vec![(OVERVIEW_NAME.to_owned(), small_charts(&title, &shown, &series(), 4, [225.0, 196.0]))];
    documents.extend(names.iter().filter_map(|name| {
        let chart = chart(name)?;
        Some(((*name).to_owned(), small_charts(&chart.title.clone(), &[chart], &series(), 1, [480.0, 320.0])))
    }));
    documents
}

/// The numbers of curves as a CSV file: one row for each parameter of each method on each approach.
///
/// # Panics
///
/// Never: writing to memory does not fail.
pub fn table(curves: &[Curve]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let head =
        ["approach", "part", "measure", "method", "parameter", "error", "bound", "values", "not finite"];
    writer.write_record(head).expect("memory takes it");
    for curve in curves {
        let approach = &curve.approach;
        for step in &curve.steps {
            let row = [
                approach.name.to_owned(),
                format!("{:?}", approach.part).to_lowercase(),
                format!("{:?}", approach.measure).to_lowercase(),
                curve.method.label().to_owned(),
                format!("{:.4e}", step.parameter),
                format!("{:.4e}", step.error),
                if curve.method.is_ours() { format!("{:.4e}", step.bound) } else { String::new() },
                step.count.to_string(),
                step.not_finite.to_string(),
            ];
            writer.write_record(row).expect("memory takes it");
        }
    }
    String::from_utf8(writer.into_inner().expect("memory takes it")).expect("all of it is text")
}

/// The same as JSON Lines, an object for each row: what is not finite has no error that could be written.
///
/// # Errors
///
/// If a row cannot be written: what is said.
pub fn lines(curves: &[Curve]) -> Result<String, String> {
    let rows = curves.iter().flat_map(|curve| curve.steps.iter().map(move |step| (curve, step)));
    let line = |(curve, step): (&Curve, &super::Step)| {
        let approach = &curve.approach;
        let row = serde_json::json!({
            "approach": approach.name,
            "part": format!("{:?}", approach.part).to_lowercase(),
            "measure": format!("{:?}", approach.measure).to_lowercase(),
            "method": curve.method.label(),
            "parameter": step.parameter,
            "error": step.error,
            "bound": curve.method.is_ours().then_some(step.bound),
            "values": step.count,
            "not_finite": step.not_finite,
        });
        serde_json::to_string(&row).map(|line| line + "\n").map_err(|error| error.to_string())
    };
    rows.map(line).collect()
}
