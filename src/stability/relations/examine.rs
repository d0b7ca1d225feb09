//! Poses relations of settings, evaluates all of them at once, and judges the values.

use rayon::prelude::*;

use super::{Claim, Lobes, Posed, Promise, Relation, Setting, promise};
use crate::effects::{Layer, Quality};
use crate::shade::LobeSum;
use crate::stability::{Case, Random, effects, table};
use crate::table::Table;

/// Values of cases with a table, by whatever evaluates them.
pub type Values<'a, E> = &'a dyn Fn(&[Case], &Table) -> Result<Vec<[f32; 3]>, E>;

/// What became of a relation in one setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The relation's name.
    pub relation: &'static str,
    /// The setting.
    pub setting: Setting,
    /// The values that were compared.
    pub values: Vec<[f32; 3]>,
    /// How far they are from what is claimed, of each part.
    pub residual: [f64; 3],
    /// How far they may be.
    pub tolerance: [f64; 3],
    /// The largest residual over its tolerance; infinite for what is not a number, and where bits differ that must not.
    pub share: f64,
}

/// What became of a relation in many settings.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// The relation's name.
    pub relation: &'static str,
    /// In how many settings it says something.
    pub count: usize,
    /// Where the largest share of the tolerance was used.
    pub worst: Option<Finding>,
    /// How often it did not hold.
    pub broken: usize,
    /// The first settings where it did not.
    pub offenders: Vec<Finding>,
}

/// What a relation makes of a setting.
pub fn pose(relation: &Relation, setting: &Setting) -> Option<Posed> {
    (relation.pose)(&setting.case, &mut Random::new(setting.seed))
}

/// A table that gives the cosine itself to a surface of roughness 1 that is seen along its normal.
pub fn identity() -> Table {
    // As ltc_shape has it: the entries are cos² t + α X = 1 and α W = 1 there, and the others are multiples of sin t.
    let texels = [[0.0, 0.0, 0.0, 1.0], [1.0, 1.0, 0.0, 0.0]];
    let bytes: Vec<u8> = texels
        .iter()
        .flat_map(|texel| [texel; 4])
        .flat_map(|texel| texel.map(|number| half::f16::from_f64(number).to_le_bytes()).concat())
        .collect();
    Table::from_layers(2, &Layer::BASE, &bytes)
        .unwrap_or_else(|error| panic!("the identity's table: {error}"))
}

/// The twin's values in single precision.
pub fn on_twin(
    level: Quality,
) -> impl Fn(&[Case], &Table) -> Result<Vec<[f32; 3]>, core::convert::Infallible> {
    move |cases, table| {
        let value = |case: &Case| case.twin::<f32>(table, effects(level)).map(|value| value as f32);
        Ok(cases.par_iter().map(value).collect())
    }
}

/// Examines relations in settings, all cases in one evaluation for each kind of lobes.
///
/// # Errors
///
/// If the evaluation fails.
pub fn examine<E>(
    relations: &[Relation],
    settings: &[Setting],
    level: Quality,
    values: Values<E>,
) -> Result<Vec<Tally>, E> {
    let relations: Vec<&Relation> =
        relations.iter().filter(|relation| relation.levels.contains(&level)).collect();
    let pairs: Vec<(usize, &Setting)> =
        (0..relations.len()).flat_map(|index| settings.iter().map(move |setting| (index, setting))).collect();
    let posed: Vec<(usize, &Setting, Posed)> = pairs
        .into_par_iter()
        .filter_map(|(index, setting)| Some((index, setting, pose(relations[index], setting)?)))
        .collect();
    let mut tallies: Vec<Tally> =
        relations.iter().map(|relation| Tally { relation: relation.name, ..Tally::default() }).collect();
    for lobes in [Lobes::Level, Lobes::Identity] {
        let table = match lobes {
            Lobes::Level => table(level),
            Lobes::Identity => identity(),
        };
        let posed: Vec<&(usize, &Setting, Posed)> =
            posed.iter().filter(|(_, _, posed)| posed.lobes == lobes).collect();
        let cases: Vec<Case> = posed.iter().flat_map(|(_, _, posed)| posed.cases.iter().cloned()).collect();
        let values = values(&cases, &table)?;
        assert_eq!(values.len(), cases.len(), "one value for each case");
        let starts: Vec<usize> = posed
            .iter()
            .scan(0, |sum, (_, _, posed)| Some(core::mem::replace(sum, *sum + posed.cases.len())))
            .collect();
        let findings: Vec<(usize, Option<Finding>)> = posed
            .par_iter()
            .zip(starts)
            .map(|((index, setting, posed), start)| {
                let values = &values[start..start + posed.cases.len()];
                (*index, judge(relations[*index].name, setting, posed, values, (&table, level)))
            })
            .collect();
        for (index, finding) in findings {
            if let Some(finding) = finding {
                tallies[index].add(finding);
            }
        }
    }
    Ok(tallies)
}

impl Tally {
    fn add(&mut self, finding: Finding) {
        self.count += 1;
        if finding.share > 1.0 {
            self.broken += 1;
            if self.offenders.len() < 3 {
                self.offenders.push(finding.clone());
            }
        }
        if self.worst.as_ref().is_none_or(|worst| finding.share > worst.share) {
            self.worst = Some(finding);
        }
    }
}

/// Judges the values of what a relation has posed; nothing where physics alone bounds them.
pub fn judge(
    relation: &'static str,
    setting: &Setting,
    posed: &Posed,
    values: &[[f32; 3]],
    with: (&Table, Quality),
) -> Option<Finding> {
    let numbers: Vec<[f64; 3]> = values.iter().map(|value| value.map(f64::from)).collect();
    let (residual, tolerance) = match &posed.claim {
        Claim::SameBits => {
            let bits = |value: &[f32; 3]| value.map(f32::to_bits);
            let same = values.iter().all(|value| bits(value) == bits(&values[0]));
            let differences: [f64; 3] = core::array::from_fn(|part| {
                numbers.iter().map(|value| (value[part] - numbers[0][part]).abs()).fold(0.0, f64::max)
            });
            (if same { [0.0; 3] } else { differences.map(|value| value.max(f64::MIN_POSITIVE)) }, [0.0; 3])
        }
        Claim::Nothing(weights) => {
            let sum = weighted(&numbers, weights);
            (sum.map(f64::abs), allowance(posed, &numbers, weights))
        }
        Claim::AtMost(weights) => {
            let sum = weighted(&numbers, weights);
            (sum.map(|sum| sum.max(0.0)), allowance(posed, &numbers, weights))
        }
        Claim::AllAround => {
            let weights = vec![1.0; numbers.len()];
            let [diffuse, specular, _] = weighted(&numbers, &weights);
            let surface = posed.cases[0].surface::<f32>();
            let lobes = with.0.specular(&surface, effects(with.1));
            let albedo: f64 = lobes.lobes().iter().map(|lobe| f64::from(lobe.albedo)).sum();
            ([(diffuse - 1.0).abs(), (specular - albedo).abs(), 0.0], allowance(posed, &numbers, &weights))
        }
        Claim::OneLit => {
            let second = |part: usize| {
                let mut lit: Vec<f64> = numbers.iter().map(|value| value[part]).collect();
                lit.sort_by(f64::total_cmp);
                lit[lit.len() - 2]
            };
            (core::array::from_fn(second), allowance(posed, &numbers, &vec![1.0; numbers.len()]))
        }
        Claim::Cosine => {
            let [diffuse, specular, _] = numbers[0];
            let allowed = allowance(posed, &numbers, &[1.0]);
            ([(diffuse - specular).abs(), 0.0, 0.0], [allowed[0] + allowed[1], f64::INFINITY, f64::INFINITY])
        }
    };
    let not_finite = values.iter().flatten().any(|value| !value.is_finite());
    if !not_finite && posed.claim != Claim::SameBits && tolerance.iter().all(|value| *value == f64::INFINITY)
    {
        return None;
    }
    let share = |part: usize| match (residual[part], tolerance[part]) {
        (residual, 0.0) if residual > 0.0 => f64::INFINITY,
        (_, 0.0) => 0.0,
        (residual, tolerance) => residual / tolerance,
    };
    let share = if not_finite { f64::INFINITY } else { share(0).max(share(1)).max(share(2)) };
    Some(Finding { relation, setting: setting.clone(), values: values.to_vec(), residual, tolerance, share })
}

fn weighted(values: &[[f64; 3]], weights: &[f64]) -> [f64; 3] {
    core::array::from_fn(|part| values.iter().zip(weights).map(|(value, weight)| value[part] * weight).sum())
}

/// What the values' own bounds allow a weighted sum, and the rounding of coordinates.
fn allowance(posed: &Posed, values: &[[f64; 3]], weights: &[f64]) -> [f64; 3] {
    let promises: Vec<Promise> =
        posed.cases.iter().zip(values).map(|(case, value)| promise(case, value[0].clamp(0.0, 1.0))).collect();
    let allowed = |part: usize| -> f64 {
        let of_values: f64 =
            promises.iter().zip(weights).map(|(promise, weight)| promise[part] * weight.abs()).sum();
        of_values + posed.slack[part]
    };
    core::array::from_fn(allowed)
}
