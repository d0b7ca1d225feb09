//! The stacks: drivers, compilers and browsers that ran the catalogue.

use super::table;
use crate::effects::Quality;
use crate::stability::StackRow;
use crate::stability::text::{part, short};

pub(super) fn section(rows: &[StackRow]) -> String {
    let heading = "\n## Stacks\n\n";
    if rows.is_empty() {
        return format!(
            "{heading}None are recorded; `tests/stacks/run` runs them and writes `docs/stacks.jsonl`.\n"
        );
    }
    let mut ways: Vec<(&str, &str)> =
        rows.iter().map(|row| (row.driver.as_str(), row.path.as_str())).collect();
    let mut known = std::collections::BTreeSet::new();
    ways.retain(|way| known.insert(*way));
    let line = |way: &(&str, &str)| {
        let of: Vec<&StackRow> =
            rows.iter().filter(|row| (row.driver.as_str(), row.path.as_str()) == *way).collect();
        let mut line = vec![way.0.to_owned(), way.1.to_owned()];
        line.push(of.iter().map(|row| row.inputs).max().unwrap_or(0).to_string());
        line.extend(Quality::ALL.map(|level| {
            let row = of.iter().find(|row| row.level == level.name());
            row.map_or("—".to_owned(), |row| match (row.not_finite, row.beyond) {
                (0, 0) => format!("{} / {}", part(row.share), part(row.specular_share)),
                (0, beyond) => format!("{} / {}; {beyond} beyond", part(row.share), part(row.specular_share)),
                (lost, _) => format!("{lost} not finite"),
            })
        }));
        let apart = of.iter().map(|row| row.from_reference).fold(0.0, |a, b| if a >= b { a } else { b });
        line.push(short(apart));
        line.push(of.first().map(|row| row.version.clone()).unwrap_or_default());
        line
    };
    let head = [
        "driver",
        "path",
        ">inputs",
        ">fast",
        ">standard",
        ">fine",
        ">finest",
        ">apart from the first by",
        "version",
    ];
    format!(
        "{heading}A part of the catalogue, the same for all, through compilers and drivers that share no code. Each level shows the share of the bounds that was \
         used, of the form factor / of specular light. Rows beyond them are processors that round one way only, filters with weights of 8 bits, whose own wider \
         bounds the test asserts, reciprocals from estimates of 12 bits, without which nothing would show that the test can fail, and those with one step of \
         Newton's, which lose lengths near the largest number that there is: WGSL permits neither. The next column is the largest difference \
         from the first row in a number that has a bound: where the bound is wide the side of a horizon may hang on one rounding.\n\n{}",
        table(&head, ways.iter().map(line))
    )
}
