//! The figures as files for other programs: CSV and JSON.

use serde::Serialize;

use crate::report::data::Report;

/// The whole report as JSON, which serde reads back.
pub(super) fn json(report: &Report) -> Vec<u8> {
    let mut text = serde_json::to_vec_pretty(report).expect("a report has no keys but names");
    text.push(b'\n');
    text
}

/// A CSV file for each list of the report, with its rows; a row for each cell of a map and each point of a curve.
pub(super) fn csv(report: &Report) -> Vec<(String, Vec<u8>)> {
    let maps = report.maps.iter().flat_map(|map| {
        map.values.iter().zip(&map.cosine).flat_map(move |(row, cosine)| {
            row.iter()
                .zip(&map.roughness)
                .map(move |(value, roughness)| (&map.method, map.part, *roughness, *cosine, *value))
        })
    });
    let growth = report.growth.iter().flat_map(|curve| {
        curve.x.iter().zip(&curve.y).enumerate().map(move |(index, (x, y))| {
            let name = curve.names.get(index).map_or("", String::as_str);
            (&curve.chart, &curve.method, &curve.x_label, *x, name, &curve.y_label, *y, curve.origin)
        })
    });
    let lobes = report
        .lobes
        .iter()
        .map(|row| (&row.method, row.part, row.mean, row.maximum, row.worst[0], row.worst[1]));
    let origins = report.origins.iter().enumerate();
    let origins = origins.map(|(index, row)| (index, &row.command, &row.device, &row.seed));
    vec![
        file("methods", &[], report.methods.iter()),
        file("origins", &["index", "command", "device", "seed"], origins),
        file("errors", &[], report.errors.iter()),
        file("maps", &["method", "part", "roughness", "cosine", "value"], maps),
        file("budget", &[], report.budget.iter()),
        file("lobes", &["method", "part", "mean", "maximum", "roughness", "cosine"], lobes),
        file("sweeps", &[], report.sweeps.iter()),
        file("costs", &[], report.costs.iter()),
        file("growth", &["chart", "method", "x_label", "x", "name", "y_label", "y", "origin"], growth),
        file("pictures", &[], report.pictures.iter()),
    ]
}

/// Rows under `columns`, or under the names of their members where those are none.
fn file<Row: Serialize>(name: &str, columns: &[&str], rows: impl Iterator<Item = Row>) -> (String, Vec<u8>) {
    let mut writer = csv::WriterBuilder::new().has_headers(columns.is_empty()).from_writer(Vec::new());
    let wrote = "rows of one list are alike, and memory takes them";
    if !columns.is_empty() {
        writer.write_record(columns).expect(wrote);
    }
    for row in rows {
        writer.serialize(row).expect(wrote);
    }
    (format!("data/{name}.csv"), writer.into_inner().expect(wrote))
}
