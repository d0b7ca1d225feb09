//! The catalogue as a table: of each family what was tried, what is promised and what was found.

use rayon::prelude::*;
use serde::Serialize;

use super::{Bound, CATALOGUE, Case, Family, Inputs};

/// The bounds of the cases of a family on one part of a value. A family whose bound follows a gap or a size has a range of them; one
/// of 1 or more says nothing that physics does not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Bounds {
    /// The smallest and the largest of absolute bounds: of numbers between 0 and 1.
    pub absolute: Option<[f64; 2]>,
    /// The smallest and the largest of bounds that are shares of the value.
    pub relative: Option<[f64; 2]>,
    /// How many cases must be exactly zero.
    pub zero: usize,
    /// How many cases need only be finite and within what physics allows.
    pub physical: usize,
}

impl Bounds {
    fn add(&mut self, bound: Bound) {
        let widen = |range: &mut Option<[f64; 2]>, bound: f64| {
            let [low, high] = range.unwrap_or([bound; 2]);
            *range = Some([low.min(bound), high.max(bound)]);
        };
        match bound {
            Bound::Absolute(bound) if bound < 1.0 => widen(&mut self.absolute, bound),
            Bound::Relative(bound) if bound < 1.0 => widen(&mut self.relative, bound),
            Bound::Zero => self.zero += 1,
            Bound::Absolute(_) | Bound::Relative(_) | Bound::Physical => self.physical += 1,
        }
    }
}

/// The input of a family that came closest to a bound, or went furthest beyond it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Worst {
    /// Its place among the cases.
    pub index: usize,
    /// Its error: a share of the value where the bound is one.
    pub error: f64,
    /// Its own bound.
    pub bound: f64,
    /// The part of the bound that was used; the error itself where the value must be zero.
    pub share: f64,
}

impl Worst {
    fn replaces(&self, other: Option<&Self>) -> bool {
        other.is_none_or(|other| self.share > other.share || (self.share.is_nan() && !other.share.is_nan()))
    }
}

/// What became of a family at a level on a stack.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FamilyRow {
    /// Name of the family.
    pub family: &'static str,
    /// The lights that its cases have.
    pub lights: &'static str,
    /// How many cases there were.
    pub inputs: usize,
    /// What is promised of the form factor.
    pub bounds: Bounds,
    /// Largest error of the form factor, absolute or a share of the value as its bound is.
    pub error: f64,
    /// Where the form factor came closest to its bound; none where physics alone bounds it.
    pub worst: Option<Worst>,
    /// What is promised of specular light; Schlick's part may be off by twice as much.
    pub specular_bounds: Bounds,
    /// Largest error of specular light, or half of that of its Schlick part, where they are bounded.
    pub specular_error: f64,
    /// Where specular light came closest to its bound.
    pub specular_worst: Option<Worst>,
    /// How many cases have a value that is not finite.
    pub not_finite: usize,
    /// How many are beyond a bound or beyond physics.
    pub beyond: usize,
}

impl FamilyRow {
    /// The larger share of a bound that was used, of the form factor's and of specular light's; 0 where physics alone bounds both.
    pub fn share(&self) -> f64 {
        let shares = [self.worst, self.specular_worst].map(|worst| worst.map_or(0.0, |worst| worst.share));
        // Not `max`, which drops what is not a number.
        if shares[0] >= shares[1] { shares[0] } else { shares[1] }
    }

    /// What the catalogue says of the family.
    pub fn entry(&self) -> Option<&'static Family> {
        CATALOGUE.iter().find(|family| family.name == self.family)
    }
}

/// What the lights of a family are called together.
fn lights<'a>(cases: impl Iterator<Item = &'a Case>) -> &'static str {
    let mut functions: Vec<&str> = cases.map(|case| case.shape.function()).collect();
    functions.sort_unstable();
    functions.dedup();
    match functions[..] {
        ["ltc_disk"] => "disks and ellipses",
        ["ltc_sphere"] => "spheres",
        ["ltc_tube"] => "tubes",
        _ if functions.iter().all(|function| ["ltc_quad", "ltc_polygon"].contains(function)) => {
            "quads and polygons"
        }
        _ => "several lights",
    }
}

impl Inputs {
    /// What the twin of the include on the CPU makes of the cases in single precision.
    pub fn twin(&self) -> Vec<[f32; 3]> {
        let value = |case: &Case| case.twin::<f32>(&self.table, self.effects).map(|number| number as f32);
        self.cases.par_iter().map(value).collect()
    }

    /// A row for each family, in the order of the catalogue.
    pub fn families(&self, values: &[[f32; 3]]) -> Vec<FamilyRow> {
        let outcomes = self.outcomes(values);
        let row = |family: &Family| {
            let outcome = outcomes.get(family.name)?;
            let indices = || (0..self.cases.len()).filter(|index| self.cases[*index].family == family.name);
            let mut row = FamilyRow {
                family: family.name,
                lights: lights(indices().map(|index| &self.cases[index])),
                inputs: outcome.count,
                bounds: Bounds::default(),
                error: outcome.error,
                worst: None,
                specular_bounds: Bounds::default(),
                specular_error: 0.0,
                specular_worst: None,
                not_finite: outcome.not_finite,
                beyond: outcome.offenders.len(),
            };
            for index in indices() {
                self.add(&mut row, index, values[index].map(f64::from));
            }
            Some(row)
        };
        CATALOGUE.iter().filter_map(row).collect()
    }

    /// Takes the value of a case into the row of its family.
    fn add(&self, row: &mut FamilyRow, index: usize, [diffuse, specular, fresnel]: [f64; 3]) {
        let (case, exact) = (&self.cases[index], self.exact()[index]);
        let reference = case.form_factor.unwrap_or(exact[0]);
        let difference = (diffuse - reference).abs();
        row.bounds.add(case.bound);
        let found = match case.bound {
            Bound::Absolute(bound) => Some((difference, bound, difference / bound)),
            Bound::Relative(bound) => Some((difference / reference, bound, difference / reference / bound)),
            Bound::Zero => {
                let most = diffuse.max(specular).max(fresnel);
                Some((most, 0.0, most))
            }
            Bound::Physical => None,
        };
        let found = found.map(|(error, bound, share)| Worst { index, error, bound, share });
        if found.is_some_and(|found| found.replaces(row.worst.as_ref())) {
            row.worst = found;
        }
        let bound = case.specular_bound;
        if !bound.is_finite() {
            row.specular_bounds.add(if case.bound == Bound::Zero { Bound::Zero } else { Bound::Physical });
            return;
        }
        row.specular_bounds.add(Bound::Absolute(bound));
        // Written so that what is not a number stays.
        let larger = |a: f64, b: f64| if a >= b { a } else { b };
        let error = larger(0.5 * (fresnel - exact[2]).abs(), (specular - exact[1]).abs());
        row.specular_error = larger(error, row.specular_error);
        let found = Worst { index, error, bound, share: error / bound };
        if found.replaces(row.specular_worst.as_ref()) {
            row.specular_worst = Some(found);
        }
    }
}
