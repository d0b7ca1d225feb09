//! Whether a report can be shown: what would make its page wrong is said by name.

use std::collections::BTreeSet;
use std::path::{Component, Path};

use super::PageError;
use crate::report::data::Report;

/// Asserts that every figure is a number, every index and every method is there, lists that belong together are of one
/// length, and no row is there twice.
pub(super) fn check(report: &Report) -> Result<(), PageError> {
    numbers(report)?;
    let fault = |place: String, reason: &str| Err(PageError::Fault { place, reason: reason.to_owned() });
    let mut names = BTreeSet::new();
    for method in &report.methods {
        if !names.insert(method.name.as_str()) {
            return fault(format!("method {}", method.name), "it is there twice");
        }
    }
    let methods = (report.errors.iter().map(|row| ("errors", &row.method)))
        .chain(report.budget.iter().map(|row| ("budget", &row.method)))
        .chain(report.lobes.iter().map(|row| ("lobes", &row.method)))
        .chain(report.costs.iter().map(|row| ("costs", &row.method)))
        .chain(report.pictures.iter().map(|row| ("pictures", &row.method)));
    for (list, method) in methods {
        if !names.contains(method.as_str()) {
            return fault(format!("{list}, method {method}"), "no such method is described");
        }
    }
    let origins = [
        ("errors", report.errors.is_empty(), report.errors_origin),
        ("maps", report.maps.is_empty(), report.maps_origin),
        ("budget", report.budget.is_empty(), report.budget_origin),
        ("lobes", report.lobes.is_empty(), report.lobes_origin),
        ("sweeps", report.sweeps.is_empty(), report.sweeps_origin),
    ];
    let origins =
        (origins.into_iter().filter(|(_, empty, _)| !empty).map(|(list, _, origin)| (list, origin)))
            .chain(report.costs.iter().map(|row| ("costs", row.origin)))
            .chain(report.growth.iter().map(|row| ("growth", row.origin)))
            .chain(report.pictures.iter().map(|row| ("pictures", row.origin)));
    for (list, origin) in origins {
        if origin >= report.origins.len() {
            return fault(format!("{list}, origin {origin}"), "there is no such origin");
        }
    }
    for map in &report.maps {
        let fits = map.values.len() == map.cosine.len()
            && map.values.iter().all(|row| row.len() == map.roughness.len());
        let rising = [&map.roughness, &map.cosine]
            .iter()
            .all(|axis| axis.is_sorted_by(|a, b| a < b) || axis.is_sorted_by(|a, b| a > b));
        if !fits || !rising {
            return fault(
                format!("map of {}, {}", map.method, map.part.name()),
                "it needs a row for each cosine, a column for each roughness, and both in order",
            );
        }
    }
    for curve in &report.growth {
        let named = curve.names.is_empty() || curve.names.len() == curve.y.len();
        if curve.x.len() != curve.y.len() || !named {
            return fault(
                format!("growth {}, {}", curve.chart, curve.method),
                "x, y and names differ in length",
            );
        }
    }
    let mut seen = BTreeSet::new();
    let keys = (report.errors.iter())
        .map(|row| format!("error of {}, {}, {}", row.method, row.part.name(), row.stratum))
        .chain(
            report.costs.iter().map(|row| format!("cost of {}, {}, {}", row.method, row.measure, row.stage)),
        )
        .chain(
            report
                .budget
                .iter()
                .map(|row| format!("budget of {}, {}, {}", row.method, row.part.name(), row.cause)),
        );
    for key in keys {
        if seen.contains(&key) {
            return fault(key, "it is there twice");
        }
        seen.insert(key);
    }
    Ok(())
}

/// Asserts that every figure is a number: JSON has no others.
fn numbers(report: &Report) -> Result<(), PageError> {
    let finite =
        |place: &dyn Fn() -> String, values: &[f64]| match values.iter().find(|value| !value.is_finite()) {
            Some(value) => Err(PageError::Fault { place: place(), reason: format!("{value} is no figure") }),
            None => Ok(()),
        };
    for row in &report.errors {
        let place = || format!("error of {}, {}, {}", row.method, row.part.name(), row.stratum);
        finite(&place, &[row.mean, row.percentile, row.maximum, row.bias])?;
    }
    for map in &report.maps {
        let place = || format!("map of {}, {}", map.method, map.part.name());
        for values in map.values.iter().chain([&map.roughness, &map.cosine]) {
            finite(&place, values)?;
        }
    }
    for row in &report.budget {
        let place = || format!("budget of {}, {}, {}", row.method, row.part.name(), row.cause);
        finite(&place, &[row.alone, row.added])?;
    }
    for row in &report.lobes {
        let place = || format!("lobes of {}, {}", row.method, row.part.name());
        finite(&place, &[row.mean, row.maximum, row.worst[0], row.worst[1]])?;
    }
    for row in &report.sweeps {
        finite(&|| format!("sweep of {}", row.function), &[row.maximum, row.worst])?;
    }
    for row in &report.costs {
        let place = || format!("cost of {}, {}, {}", row.method, row.measure, row.stage);
        finite(&place, &[row.value, row.ratio])?;
    }
    for curve in &report.growth {
        let place = || format!("growth {}, {}", curve.chart, curve.method);
        finite(&place, &curve.x)?;
        finite(&place, &curve.y)?;
    }
    for row in &report.pictures {
        finite(&|| format!("picture of {}, {}", row.method, row.scene), &[row.rmse, row.mean])?;
    }
    Ok(())
}

/// Whether a file's name stays in its folder, and is that of a PNG file.
pub(super) fn is_picture_name(name: &str) -> bool {
    let path = Path::new(name);
    let plain = path.components().all(|part| matches!(part, Component::Normal(_)));
    let known = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"));
    plain && known && !name.contains('\\')
}
