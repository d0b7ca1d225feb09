//! Checks values of cases against their bounds.

use std::collections::BTreeMap;

use super::{Bound, Case};
use crate::effects::Effects;
use crate::table::Table;

/// The worst of a family.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// How many cases there were.
    pub count: usize,
    /// Largest error of the form factor: absolute or relative as the bound is.
    pub error: f64,
    /// Index of the case with the largest share of its bound, or, where there is none, the largest error.
    pub worst: usize,
    /// Largest share of the form factor's bound that was used.
    pub share: f64,
    /// Largest error of specular light, where it is bounded.
    pub specular_error: f64,
    /// Largest share of the bound of specular light, or of twice that of Schlick's part.
    pub specular_share: f64,
    /// Indices of cases beyond their bounds or beyond physics.
    pub offenders: Vec<usize>,
    /// How many values were not finite.
    pub not_finite: usize,
}

/// Checks values against bounds and exact arithmetic, family by family.
pub fn outcomes(
    cases: &[Case],
    exact: &[[f64; 3]],
    values: &[[f32; 3]],
    (table, effects): (&Table, Effects),
) -> BTreeMap<&'static str, Outcome> {
    assert!(cases.len() == values.len() && cases.len() == exact.len(), "one value for each case");
    let mut outcomes: BTreeMap<&str, Outcome> = BTreeMap::new();
    for (index, ((case, exact), value)) in cases.iter().zip(exact).zip(values).enumerate() {
        let [diffuse, specular, fresnel] = value.map(f64::from);
        let reference = case.form_factor.unwrap_or(exact[0]);
        let difference = (diffuse - reference).abs();
        let error = match case.bound {
            Bound::Absolute(_) => difference,
            Bound::Relative(_) => difference / reference,
            Bound::Zero => diffuse.max(specular).max(fresnel),
            Bound::Physical => 0.0,
        };
        let limit = match case.bound {
            Bound::Absolute(bound) | Bound::Relative(bound) => bound,
            Bound::Zero | Bound::Physical => 0.0,
        };
        let albedo = case.albedo(table, effects);
        let physical = (0.0..=1.0).contains(&diffuse)
            && (0.0..=albedo).contains(&specular)
            && (0.0..=specular * (1.0 + 1e-6)).contains(&fresnel);
        let specular_error = (specular - exact[1]).abs();
        // Schlick's part follows the light's direction as well.
        let specular_share = specular_error.max(0.5 * (fresnel - exact[2]).abs()) / case.specular_bound;
        let outcome = outcomes.entry(case.family).or_default();
        outcome.count += 1;
        let share = if limit > 0.0 { error / limit } else { error };
        if outcome.count == 1 || share > outcome.share || share.is_nan() {
            (outcome.share, outcome.worst) = (share, index);
        }
        outcome.error = if error.is_nan() { error } else { outcome.error.max(error) };
        if case.specular_bound.is_finite() {
            outcome.specular_error = outcome.specular_error.max(specular_error);
            outcome.specular_share = outcome.specular_share.max(specular_share);
        }
        outcome.not_finite += usize::from(value.iter().any(|number| !number.is_finite()));
        // Written so that what is not a number offends.
        let within = error <= limit && specular_share <= 1.0;
        if !(physical && within) {
            outcome.offenders.push(index);
        }
    }
    outcomes
}

/// A sentence for each of the first offenders of each family, with values and input.
pub fn offences(
    outcomes: &BTreeMap<&'static str, Outcome>,
    cases: &[Case],
    exact: &[[f64; 3]],
    values: &[[f32; 3]],
) -> Vec<String> {
    let firsts = outcomes.values().flat_map(|outcome| outcome.offenders.iter().take(3));
    let say = |index: &usize| {
        let (value, exact, case) = (values[*index], exact[*index], &cases[*index]);
        format!("value {value:?}, exact {exact:?}, input {index}: {case:?}")
    };
    firsts.map(say).collect()
}
