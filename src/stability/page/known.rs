//! What is known to fail elsewhere, and what answers it here.

use super::table;
use crate::stability::KNOWN;

pub(super) fn section() -> String {
    let rows = KNOWN.iter().map(|case| {
        let quoted = case.families.iter().map(|family| format!("“{family}”")).collect::<Vec<_>>();
        let mut answer = vec![];
        answer.extend((!quoted.is_empty()).then(|| format!("Families {}.", quoted.join(", "))));
        answer.extend(
            (!case.approaches.is_empty()).then(|| format!("Approaches {}.", case.approaches.join(", "))),
        );
        answer.extend((!case.answer.is_empty()).then(|| case.answer.to_owned()));
        vec![case.name.to_owned(), case.symptom.to_owned(), case.met.to_owned(), answer.join(" ")]
    });
    let head = ["case", "what is seen", "met in", "here"];
    format!(
        "\n## What fails elsewhere\n\n{} hard cases that were met in public, and what of this library answers each.\n\n{}",
        KNOWN.len(),
        table(&head, rows)
    )
}
