//! Where a method's error comes from.

use rayon::prelude::*;

use super::{Case, PARTS, parts};
use crate::report::data::BudgetRow;
use crate::report::{Method, Quad};

/// (diffuse, specular, fresnel) of a light with some of a method's causes of error and without the others.
pub type Evaluate<'a> = Box<dyn Fn(&Quad) -> [f64; 3] + Sync + 'a>;

/// A method step by step, from the truth to what it computes.
pub struct LevelSteps<'a> {
    /// The causes of error in the order in which they are added, each with the value that has it and all before it,
    /// but none of those behind. The last one is the method.
    pub steps: Vec<(String, Evaluate<'a>)>,
    /// The method itself, for the total.
    pub method: &'a dyn Method,
}

/// The causes of a method's error, and as the last row of each part their `total`.
///
/// With e₀ = 0 and eᵢ the mean |error| of the i-th step, `added` is eᵢ − eᵢ₋₁, so that it adds up to the mean |error| of
/// the last step; it is negative where a cause happens to make up for others. `alone` is the mean |difference| between a
/// step and the one before it, for the first one the truth. The total is measured with the method itself.
pub fn budget(level: &LevelSteps, cases: &[Case]) -> Vec<BudgetRow> {
    let name = level.method.info().name;
    let evaluate = |value: &(dyn Fn(&Quad) -> [f64; 3] + Sync)| -> Vec<[f64; 4]> {
        cases.par_iter().map(|case| parts(value(&case.quad))).collect()
    };
    let truth: Vec<[f64; 4]> = cases.iter().map(|case| parts(case.truth)).collect();
    let distance = |a: &[[f64; 4]], b: &[[f64; 4]], part: usize| {
        let sum: f64 = a.iter().zip(b).map(|(a, b)| (a[part] - b[part]).abs()).sum();
        let unit: f64 = truth.iter().map(|truth| truth[part]).sum();
        if unit > 0.0 { sum / unit } else { 0.0 }
    };
    let steps: Vec<Vec<[f64; 4]>> = level.steps.iter().map(|(_, value)| evaluate(value)).collect();
    let total = evaluate(&|quad| level.method.value(quad));
    let mut rows = Vec::new();
    for (part, label) in PARTS.into_iter().enumerate() {
        let mut row = |cause: &str, alone: f64, added: f64| {
            rows.push(BudgetRow { method: name.clone(), part: label, cause: cause.to_owned(), alone, added });
        };
        let mut before = &truth;
        let mut reached = 0.0;
        for ((cause, _), values) in level.steps.iter().zip(&steps) {
            let error = distance(values, &truth, part);
            row(cause, distance(values, before, part), error - reached);
            (before, reached) = (values, error);
        }
        let error = distance(&total, &truth, part);
        row("total", error, error);
    }
    rows
}
