//! What a report says, in its order.

mod errors;
mod pictures;

use super::document::{Block, Cell, Columns, Figure, Table};
use super::number::slug;
use super::{LobePlot, PageError, PictureFile, curve};
use crate::report::data::{GrowthCurve, Kind, Origin, Part, Report};

pub(super) use pictures::picture_names;

/// All blocks below the title.
pub(super) fn blocks(
    report: &Report,
    lobes: &[LobePlot],
    pictures: &[PictureFile],
) -> Result<Vec<Block>, PageError> {
    // First of all: it can fail, and lobes take time.
    let scenes = pictures::scenes(report, pictures)?;
    let mut blocks = head(report);
    blocks.extend(errors::glance(report));
    blocks.extend(errors::error_cost(report));
    blocks.extend(scenes);
    blocks.extend(errors::maps(report));
    blocks.extend(errors::causes(report));
    blocks.extend(errors::bias(report));
    blocks.extend(growth(report));
    blocks.extend(pictures::lobes(report, lobes));
    blocks.extend(errors::sweeps(report));
    blocks.extend(methods(report));
    blocks.extend(foot(report));
    Ok(blocks)
}

fn heading(text: &str) -> Block {
    Block::Heading(2, text.to_owned())
}

fn text(text: &str) -> Block {
    Block::Text(text.to_owned())
}

fn drawing(name: &str, title: String, svg: String) -> Figure {
    Figure { file: format!("charts/{}.svg", slug(name)), title, svg, origin: None }
}

fn origins(report: &Report, indices: impl IntoIterator<Item = usize>) -> Block {
    let mut known: Vec<usize> = Vec::new();
    for index in indices {
        if !known.contains(&index) {
            known.push(index);
        }
    }
    Block::Origins(known.into_iter().map(|index| short(report, report.origins[index].clone())).collect())
}

/// An origin without the command that the page names as its own.
fn short(report: &Report, mut origin: Origin) -> Origin {
    if origin.command == report.command {
        origin.command.clear();
    }
    origin
}

/// What a method is called: its label, or its name where it is none of the list.
fn label(report: &Report, name: &str) -> String {
    let method = report.methods.iter().find(|method| method.name == name);
    method.map_or_else(|| name.to_owned(), |method| method.label.clone())
}

/// The parts of which a list has rows.
fn parts_of(present: impl Fn(Part) -> bool) -> Vec<Part> {
    Part::ALL.into_iter().filter(|part| present(*part)).collect()
}

fn head(report: &Report) -> Vec<Block> {
    vec![
        text(
            "How close each quality level of Softbox comes to the light that a rough surface reflects from an area light, what \
             that costs on a processor, and where what else there is stands by the same measures.",
        ),
        text(
            "Errors are mean |error| over mean value, on random lights, against numerical integration of the reflectance model \
             itself (GGX). Costs are ratios to the published exact method, measured in the same run, each for one light with its \
             diffuse and specular part. In both, less is better. What each method is, is said below all figures.",
        ),
        Block::Text(format!(
            "Version {}. Made by `{}`, which makes every figure again that does not name a command of its own.",
            report.version, report.command
        )),
    ]
}

fn methods(report: &Report) -> Vec<Block> {
    let kind = |kind| match kind {
        Kind::Level => "level",
        Kind::Comparator => "comparator",
        Kind::Reference => "reference",
    };
    let rows = report
        .methods
        .iter()
        .map(|method| {
            vec![
                Cell::code(&method.name),
                Cell::text(&method.label),
                Cell::text(kind(method.kind)),
                Cell::text(&method.description),
            ]
        })
        .collect();
    vec![
        heading("Methods"),
        Block::Table(Table::new("What is compared", &["name", "on charts", "kind", "what it does"], rows)),
    ]
}

/// What the axis of compilers' estimates says.
const COMPILED: &str = " inverse throughput, ";

fn growth(report: &Report) -> Vec<Block> {
    if report.growth.is_empty() {
        return Vec::new();
    }
    let mut groups: Vec<Vec<&GrowthCurve>> = Vec::new();
    for curve in &report.growth {
        let axes = |curve: &GrowthCurve| {
            let labels = (curve.chart.clone(), curve.x_label.clone(), curve.y_label.clone());
            (labels, curve.names.is_empty(), curve.origin)
        };
        match groups.iter_mut().find(|group| axes(group[0]) == axes(curve)) {
            Some(group) => group.push(curve),
            None => groups.push(vec![curve]),
        }
    }
    // What grows by the same stands together.
    let charts: Vec<&str> = report.growth.iter().map(|curve| curve.chart.as_str()).collect();
    groups.sort_by_key(|group| charts.iter().position(|chart| *chart == group[0].chart));
    // Compilers for processors of one maker say the same but for a few cycles.
    let compiled: Vec<(String, String)> = groups
        .iter()
        .filter(|group| group[0].y_label.contains(COMPILED))
        .map(|group| (group[0].chart.clone(), group[0].y_label.clone()))
        .collect();
    groups.retain(|group| {
        let [chart, label] = [&group[0].chart, &group[0].y_label];
        let last = compiled.iter().rfind(|(known, _)| known == chart);
        !label.contains(COMPILED) || last.is_some_and(|(_, last)| last == label)
    });
    let figures = groups.iter().enumerate().map(|(index, group)| {
        let title = format!("By {}: {}", group[0].chart, group[0].y_label);
        let svg = curve::draw(report, group, &title);
        let origin = Some(short(report, report.origins[group[0].origin].clone()));
        Figure { origin, ..drawing(&format!("growth {} {}", group[0].chart, index + 1), title, svg) }
    });
    let rows = report.growth.iter().flat_map(|curve| {
        curve.x.iter().zip(&curve.y).enumerate().map(|(index, (x, y))| {
            let name = curve.names.get(index);
            vec![
                Cell::text(&curve.chart),
                Cell::text(label(report, &curve.method)),
                name.map_or_else(|| Cell::figure(*x), Cell::text),
                Cell::figure(*y),
                Cell::text(&curve.y_label),
            ]
        })
    });
    let columns = ["by", "method", "at", "value", "measured"];
    vec![
        heading("How costs grow"),
        text(
            "Lines have two logarithmic axes: one of slope 1 means that twice as many cost twice as much. Of compilers' estimates, \
             which are alike for all processors, one processor's are drawn; the table has all.",
        ),
        Block::Figures(Columns::Two, figures.collect()),
        Block::Table(Table::new("All points", &columns, rows.collect()).folded()),
    ]
}

fn foot(report: &Report) -> Vec<Block> {
    // Lists that were made alike share a row.
    let mut known: Vec<&Origin> = Vec::new();
    for origin in &report.origins {
        if !known.contains(&origin) {
            known.push(origin);
        }
    }
    let rows = known.into_iter().map(|origin| {
        let command = if origin.command == report.command {
            Cell::text("that of this report")
        } else {
            Cell::code(&origin.command)
        };
        vec![Cell::text(&origin.device), Cell::text(&origin.seed), command]
    });
    vec![
        heading("Where the figures come from"),
        Block::Table(Table::new("Origins", &["device and compiler", "seed", "command"], rows.collect())),
        text(
            "Beside the page: `report.json` holds every figure in full, `data/` the same lists as CSV files, `report.md` this text with \
             its charts as SVG files in `charts/`.",
        ),
    ]
}
