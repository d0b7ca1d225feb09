//! Errors, alone and against costs.

use super::super::chart::{self, Measure, measures, points, whole_error};
use super::super::document::{Block, Cell, Columns, Figure, Table};
use super::super::{budget, map};
use super::{drawing, heading, label, origins, parts_of, text};
use crate::report::data::{CostRow, ErrorMap, Part, Report};

pub(super) fn glance(report: &Report) -> Vec<Block> {
    if report.errors.is_empty() {
        return Vec::new();
    }
    let parts = parts_of(|part| report.errors.iter().any(|row| row.part == part && row.stratum == "all"));
    let measures = measures(report);
    let mut columns = vec!["method".to_owned()];
    columns.extend(parts.iter().map(|part| format!("error, {}", part.name())));
    columns.extend(measures.iter().map(|measure| format!("cost, {} (×)", measure.name())));
    let cost = |method: &str, measure: &Measure| {
        let row = report
            .costs
            .iter()
            .find(|row| row.method == method && row.measure == measure.measure && row.stage == measure.stage);
        row.map_or_else(Cell::none, |row| Cell::figure(row.ratio))
    };
    let error = |method: &str, part| {
        whole_error(report, method, part).map_or_else(Cell::none, |row| Cell::percent(row.mean))
    };
    let rows = report.methods.iter().map(|method| {
        let name = [Cell::text(&method.label)].into_iter();
        let errors = parts.iter().map(|part| error(&method.name, *part));
        name.chain(errors).chain(measures.iter().map(|measure| cost(&method.name, measure))).collect()
    });
    let caption = "Mean error, and cost as a multiple of the published method's".to_owned();
    let table = Table { caption, columns, rows: rows.collect(), folded: false };
    vec![
        heading("At a glance"),
        Block::Table(table),
        origins(report, [report.errors_origin].into_iter().chain(report.costs.iter().map(|row| row.origin))),
    ]
}

pub(super) fn error_cost(report: &Report) -> Vec<Block> {
    let option = |measure: &Measure| {
        let figures = [Part::Specular, Part::Dielectric, Part::Fresnel, Part::Diffuse].into_iter();
        let figures = figures.filter_map(|part| {
            let points = points(report, *measure, part);
            let name = format!("error-cost {} {}", measure.name(), part.name());
            let title = format!("Error against cost: {}, {}", part.name(), measure.name());
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
        let error = |method: &str, part| {
            whole_error(report, method, part).map_or_else(Cell::none, |row| Cell::percent(row.mean))
        };
        let rows = report.costs.iter().filter(of).map(|row| {
            vec![
                Cell::text(label(report, &row.method)),
                Cell::figure(row.value),
                Cell::text(&row.unit),
                Cell::figure(row.ratio),
                error(&row.method, Part::Specular),
                best(&row.method, Part::Specular),
                error(&row.method, Part::Dielectric),
                best(&row.method, Part::Dielectric),
            ]
        });
        let columns = [
            "method",
            "cost",
            "unit",
            "over published (×)",
            "error, specular",
            "frontier",
            "error, dielectric",
            "frontier",
        ];
        let table = Table::new(&format!("Costs: {}", measure.name()), &columns, rows.collect());
        let indices = report.costs.iter().filter(of).map(|row| row.origin).chain([report.errors_origin]);
        let mut blocks = Vec::new();
        if !figures.is_empty() {
            blocks.push(Block::Figures(Columns::Two, figures));
        }
        blocks.extend([origins(report, indices), Block::Table(table)]);
        (measure.name(), blocks)
    };
    let options: Vec<_> = measures(report).iter().map(option).collect();
    if options.is_empty() {
        return Vec::new();
    }
    vec![
        heading("Error against cost"),
        text(
            "Each point is a method. The dashed steps are the frontier: the least error that can be had for a cost. A hollow point \
             lies behind it: another method is cheaper and closer. Names of quality levels are bold. Both axes are logarithmic, so \
             a method without error, and one that was not measured, are only in the tables.",
        ),
        Block::Choice("Cost measured as".to_owned(), options),
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
         is much, on a logarithmic scale. Below the range of the key colours stay at its end.",
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
        let caption = format!("Mean error by range of inputs: {}", part.name());
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
         causes span many powers of ten, a second chart shows each of them alone.",
        ),
    ];
    for part in parts_of(|part| report.budget.iter().any(|row| row.part == part)) {
        let title = |name: &str| format!("{name}: {}", part.name());
        let figures = vec![
            drawing(
                &format!("budget {}", part.name()),
                title("Where the error comes from"),
                budget::stacked(report, part),
            ),
            drawing(
                &format!("budget alone {}", part.name()),
                title("Each cause alone"),
                budget::alone(report, part),
            ),
        ];
        blocks.push(Block::Figures(Columns::Two, figures));
        blocks.push(origins(report, [report.budget_origin]));
    }
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
    let rows = |whole: bool| -> Vec<Vec<Cell>> {
        let rows = report.errors.iter().filter(|row| !whole || row.stratum == "all");
        rows.map(|row| {
            let mut cells = vec![Cell::text(label(report, &row.method)), Cell::text(row.part.name())];
            if !whole {
                cells.push(Cell::text(&row.stratum));
            }
            cells.extend([
                Cell::count(row.count as u64),
                Cell::percent(row.mean),
                Cell::signed_percent(row.bias),
                Cell::percent(row.percentile),
                Cell::percent(row.maximum),
            ]);
            cells
        })
        .collect()
    };
    let columns = ["method", "part", "inputs", "mean |error|", "bias (signed)", "99th percentile", "largest"];
    let all =
        ["method", "part", "range", "inputs", "mean |error|", "bias (signed)", "99th percentile", "largest"];
    vec![
        heading("Bias and percentiles"),
        text(
            "All over the mean value. A positive bias is too bright. The percentile and the largest error are of single inputs, so \
             they may exceed 100 %.",
        ),
        Block::Table(Table::new("On all inputs", &columns, rows(true))),
        Block::Table(Table::new("By range of inputs", &all, rows(false)).folded()),
        origins(report, [report.errors_origin]),
    ]
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
