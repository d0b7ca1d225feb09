//! The ways into hard places: the worst of each method.

use super::table;
use crate::effects::Quality;
use crate::stability::approach::{Approach, Curve, Measure, Method, OVERVIEW_NAME, Part};
use crate::stability::text::short;

/// The worst along a curve, and the share of the values that are not finite.
fn worst(curve: &Curve) -> String {
    let error = curve.steps.iter().map(|step| step.error).fold(0.0, f64::max);
    let lost: usize = curve.steps.iter().map(|step| step.not_finite).sum();
    let count: usize = curve.steps.iter().map(|step| step.count).sum();
    match lost {
        0 => short(error),
        _ => format!("{}; {:.0} % not finite", short(error), (100.0 * lost as f64 / count as f64).max(1.0)),
    }
}

fn measured(approach: &Approach) -> &'static str {
    match (approach.part, approach.measure) {
        (Part::Diffuse, Measure::Absolute) => "form factor",
        (Part::Diffuse, Measure::Relative) => "form factor, relative",
        (Part::Specular, Measure::Absolute) => "specular",
        (Part::Specular, Measure::Relative) => "specular, relative",
        (_, Measure::OfLight) => "specular, of the form factor",
    }
}

pub(super) fn section(curves: &[Curve]) -> String {
    let mut approaches: Vec<Approach> = curves.iter().map(|curve| curve.approach).collect();
    approaches.dedup();
    let line = |approach: &Approach| {
        let of: Vec<&Curve> = curves.iter().filter(|curve| curve.approach == *approach).collect();
        let cell = |which: &dyn Fn(Method) -> bool| {
            of.iter().find(|curve| which(curve.method)).map_or("—".to_owned(), |curve| worst(curve))
        };
        let exact = of.iter().filter(|curve| is_exact(curve.method));
        let steps = || exact.clone().flat_map(|curve| &curve.steps);
        let [from, to] = approach.range;
        let [from, to] = if approach.rises { [from, to] } else { [to, from] };
        let share = steps().map(|step| step.error / step.bound).fold(0.0, f64::max);
        vec![
            format!("{} ({})", approach.title, approach.name),
            format!("{} {} to {}", approach.parameter, short(from), short(to)),
            measured(approach).to_owned(),
            cell(&|method| method == Method::Polygon(super::super::approach::EdgeForm::Printed)),
            cell(&|method| {
                matches!(method, Method::Disk | Method::Line)
                    || method == Method::Polygon(super::super::approach::EdgeForm::Fitted)
            }),
            cell(&|method| method == Method::Level(Quality::Fast)),
            short(steps().map(|step| step.error).fold(0.0, f64::max)),
            crate::stability::text::part(share),
        ]
    };
    let head = [
        "approach",
        "over",
        "of",
        ">published 2016, arc cosine",
        ">published 2017: rational fit, disk, line",
        ">Softbox, fast",
        ">Softbox, standard to finest",
        ">share of the bound",
    ];
    format!(
        "\n## Errors on the way there\n\n![Error along a choice of the approaches]({OVERVIEW_NAME}.svg)\n\n\
         The largest rounding error along each way into a hard place, of each method against itself in exact arithmetic on the same table and \
         light; {} ways, each with {} settings a step. `stability --out` draws every one.\n\n{}",
        approaches.len(),
        super::super::approach::VARIANTS,
        table(&head, approaches.iter().map(line))
    )
}

fn is_exact(method: Method) -> bool {
    matches!(method, Method::Level(level) if level != Quality::Fast)
}
