//! Inputs that every form of the include has to survive, checked against the bound that holds for each.
#![allow(dead_code, unused_imports, reason = "each test file uses a part of this module")]

pub mod tools;

use softbox::effects::Effects;
use softbox::shade::Real;
use softbox::stability::{offences, outcomes};
use softbox::table::Table;

pub use softbox::stability::{Bound, Case, Random, Shape, batch, cases, perpendicular};

/// Checks values against the bounds and exact arithmetic; prints the worst of each family, panics with the first offenders.
pub fn check(what: &str, cases: &[Case], exact: &[[f64; 3]], values: &[[f32; 3]], table: &Table) {
    check_with(what, cases, exact, values, (table, Effects::NONE));
}

/// The same with some effects.
pub fn check_with(
    what: &str,
    cases: &[Case],
    exact: &[[f64; 3]],
    values: &[[f32; 3]],
    with: (&Table, Effects),
) {
    let outcomes = outcomes(cases, exact, values, with);
    for (family, outcome) in &outcomes {
        println!(
            "{what}: {family}: of {} the worst error is {:.2e}; {:.2} of the bound at {}, specular {:.2}",
            outcome.count, outcome.error, outcome.share, outcome.worst, outcome.specular_share
        );
    }
    let beyond: usize = outcomes.values().map(|outcome| outcome.offenders.len()).sum();
    assert!(
        beyond == 0,
        "{what}: {beyond} of {} cases beyond their bounds:\n{}",
        cases.len(),
        offences(&outcomes, cases, exact, values).join("\n")
    );
}

/// Exact values at the standard level.
pub fn exact(cases: &[Case], table: &Table) -> Vec<[f64; 3]> {
    cases.iter().map(|case| case.exact(table, Effects::NONE)).collect()
}

/// The twin's values in single precision.
pub fn twin(cases: &[Case], table: &Table, effects: Effects) -> Vec<[f32; 3]> {
    cases.iter().map(|case| case.twin::<f32>(table, effects).map(|value| value as f32)).collect()
}
