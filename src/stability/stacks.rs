//! The same cases through one shader stack after another: compilers, drivers and processors that share no code, measured
//! against exact arithmetic and against one another.

use serde::{Deserialize, Serialize};

use super::{Bound, Case, Outcome, VANISHING, at_level, batch, cases, offences, outcomes};
use crate::device::{Batch, Device, DeviceError, Program};
use crate::effects::{Effects, EffectsError, Quality, wgsl};
use crate::table::Table;

/// Names of the three numbers that the include returns, in their order.
pub const PARTS: [&str; 3] = ["form factor", "specular", "Schlick part"];

/// How far the values of one part are from exact arithmetic, over the cases that have a bound in numbers: absolute
/// differences of numbers between 0 and 1. The cases are those that the catalogue bounds at every level; at `fast`, exact arithmetic
/// is that of its own closed forms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Differences {
    /// Half of the cases are closer.
    pub median: f64,
    /// 99 of 100 cases are closer.
    pub p99: f64,
    /// 999 of 1000 cases are closer.
    pub p999: f64,
    /// The largest.
    pub max: f64,
}

impl Differences {
    fn of(mut differences: Vec<f64>) -> Self {
        // What is not a number counts as furthest.
        differences.sort_by(f64::total_cmp);
        let at = |share: f64| match differences.len() {
            0 => 0.0,
            count => differences[((share * count as f64) as usize).min(count - 1)],
        };
        Self { median: at(0.5), p99: at(0.99), p999: at(0.999), max: at(1.0) }
    }
}

/// What one stack made of the cases of one quality level.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StackRow {
    /// What ran the code.
    pub driver: String,
    /// What the text went through on its way there.
    pub path: String,
    /// Name of the quality level.
    pub level: String,
    /// What the driver, or the compiler where that is the device, says of itself.
    pub version: String,
    /// How to have this row again.
    pub command: String,
    /// How many cases there were.
    pub inputs: usize,
    /// How many of their values hold a number that is not finite.
    pub not_finite: usize,
    /// How many are beyond their bound or beyond physics.
    pub beyond: usize,
    /// Largest share of the form factor's bound that was used.
    pub share: f64,
    /// Largest share of the bound of specular light, or of twice that of Schlick's part.
    pub specular_share: f64,
    /// Family of the case with the largest share.
    pub family: String,
    /// Index of that case.
    pub worst: usize,
    /// For each of [`PARTS`].
    pub differences: [Differences; 3],
    /// How many of the numbers differ in any bit from those of the reference stack.
    pub different: usize,
    /// Largest difference from the reference stack, over the cases that have a bound in numbers.
    pub from_reference: f64,
}

impl StackRow {
    /// The larger of the two shares: at most 1 where the stack keeps the stated bounds.
    pub fn worst_share(&self) -> f64 {
        // Not `max`, which drops what is not a number.
        if self.share >= self.specular_share { self.share } else { self.specular_share }
    }
}

/// The cases of a quality level with their exact values: what every stack is measured by.
#[derive(Clone, Debug)]
pub struct Inputs {
    /// The level.
    pub level: Quality,
    /// The effects that the evaluation kernel calls for at that level.
    pub effects: Effects,
    /// The table, with the layers that the level reads.
    pub table: Table,
    /// The cases.
    pub cases: Vec<Case>,
    /// The cases as the kernel reads them.
    pub batch: Batch,
    exact: Vec<[f64; 3]>,
    /// For each case, whether its form factor and whether its specular light has a bound in numbers.
    bounded: Vec<[bool; 2]>,
}

impl Inputs {
    /// About 1,600 cases for each unit of `count`, see [`cases`].
    pub fn of(level: Quality, count: usize) -> Self {
        let (effects, table) = (effects(level), table(level));
        let mut cases = cases(count);
        let numeric = |case: &Case| matches!(case.bound, Bound::Absolute(_) | Bound::Relative(_));
        let mut bounded: Vec<[bool; 2]> =
            cases.iter().map(|case| [numeric(case), case.specular_bound.is_finite()]).collect();
        let physical = |case: &mut Case| {
            case.form_factor = None;
            case.specular_bound = f64::INFINITY;
            case.bound = Bound::Physical;
        };
        let mut exact: Vec<[f64; 3]> = cases.iter().map(|case| case.exact(&table, effects)).collect();
        for ((case, exact), bounded) in cases.iter_mut().zip(&mut exact).zip(&mut bounded) {
            if is_decided_by_subnormals(case, exact, &table, effects) {
                physical(case);
                *exact = case.exact(&table, effects);
                *bounded = [false; 2];
            }
        }
        if effects.is_fast() {
            // The catalogue bounds the distance from the integral, which this level's closed forms are not.
            exact = cases.iter().map(|case| case.twin::<f64>(&table, effects)).collect();
            cases.iter_mut().zip(&exact).for_each(|(case, exact)| *case = at_level(level, case, exact[1]));
        }
        let batch = batch(&cases);
        Self { level, effects, table, cases, batch, exact, bounded }
    }

    /// The values of exact arithmetic, a case each.
    pub fn exact(&self) -> &[[f64; 3]] {
        &self.exact
    }

    /// Each family's worst.
    pub fn outcomes(&self, values: &[[f32; 3]]) -> std::collections::BTreeMap<&'static str, Outcome> {
        outcomes(&self.cases, &self.exact, values, (&self.table, self.effects))
    }

    /// A sentence for each of the first cases beyond their bounds.
    pub fn offences(&self, values: &[[f32; 3]]) -> Vec<String> {
        offences(&self.outcomes(values), &self.cases, &self.exact, values)
    }

    /// The row of a stack that gave `values`, where the reference stack gave `reference`.
    pub fn row(&self, stack: &Stack, values: &[[f32; 3]], reference: &[[f32; 3]]) -> StackRow {
        let outcomes = self.outcomes(values);
        let larger = |a: f64, b: f64| if b.is_nan() || b > a { b } else { a };
        let worst = outcomes
            .iter()
            .max_by(|(_, a), (_, b)| {
                larger(a.share, a.specular_share).total_cmp(&larger(b.share, b.specular_share))
            })
            .map_or(("", 0), |(family, outcome)| (*family, outcome.worst));
        let bounded = |index: usize, part: usize| self.bounded[index][part.min(1)];
        let differences = core::array::from_fn(|part| {
            let indices = (0..values.len()).filter(|index| bounded(*index, part));
            let difference = |index: usize| (self.exact[index][part] - f64::from(values[index][part])).abs();
            Differences::of(indices.map(difference).collect())
        });
        let (mut different, mut from_reference) = (0, 0.0);
        for (index, (a, b)) in reference.iter().zip(values).enumerate() {
            for part in 0..3 {
                different += usize::from(a[part].to_bits() != b[part].to_bits());
                if bounded(index, part) {
                    from_reference = larger(from_reference, f64::from(a[part] - b[part]).abs());
                }
            }
        }
        StackRow {
            driver: stack.driver.clone(),
            path: stack.path.clone(),
            level: self.level.name().to_owned(),
            version: stack.version.clone(),
            command: stack.command.clone(),
            inputs: self.cases.len(),
            not_finite: outcomes.values().map(|outcome| outcome.not_finite).sum(),
            beyond: outcomes.values().map(|outcome| outcome.offenders.len()).sum(),
            share: outcomes.values().fold(0.0, |worst, outcome| larger(worst, outcome.share)),
            specular_share: outcomes
                .values()
                .fold(0.0, |worst, outcome| larger(worst, outcome.specular_share)),
            family: worst.0.to_owned(),
            worst: worst.1,
            differences,
            different,
            from_reference,
        }
    }
}

/// Whether what must hold of a case hangs on coordinates so small that a device may take them for zero: WGSL lets it flush
/// subnormal numbers, and the include divides coordinates by 16.
fn is_decided_by_subnormals(case: &Case, exact: &[f64; 3], table: &Table, effects: Effects) -> bool {
    let mut flushed = case.clone();
    let mut any = false;
    flushed.each_vector(&mut |numbers| {
        for number in numbers {
            if *number != 0.0 && number.abs() < VANISHING {
                (*number, any) = (0.0, true);
            }
        }
    });
    if !any {
        return false;
    }
    let differences = flushed.exact(table, effects).into_iter().zip(exact).map(|(a, b)| (a - b).abs());
    let limit = match case.bound {
        Bound::Absolute(bound) => bound,
        Bound::Relative(bound) => bound * exact[0],
        Bound::Zero => 0.0,
        Bound::Physical => return false,
    };
    // Written so that what is not a number counts as different.
    let limits = [limit, case.specular_bound, 2.0 * case.specular_bound];
    !differences.zip(limits).all(|(difference, limit)| difference <= 0.5 * limit)
}

/// The effects that the kernel of `wgsl/evaluate.wgsl` calls for, at a level.
pub fn effects(level: Quality) -> Effects {
    let plain: Result<Effects, EffectsError> = "quad,polygon,disk,sphere,tube+ggx+two-sided,caps".parse();
    level.of(plain.unwrap_or_else(|error| panic!("the effects of the evaluation kernel: {error}")))
}

/// The table with the layers that the kernel reads at a level.
pub fn table(level: Quality) -> Table {
    let layers = effects(level).layers();
    let table = Table::default().completed(&layers);
    if layers.is_empty() { table } else { table.only(&layers) }
}

/// What a row says of the stack itself; the fields are those of [`StackRow`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stack {
    /// What runs the code.
    pub driver: String,
    /// What the text goes through on its way there.
    pub path: String,
    /// What the driver says of itself.
    pub version: String,
    /// How to have the row again.
    pub command: String,
}

/// A short name of a device that stays the same from one version of its driver to the next, where it is a processor.
pub fn driver_name(device: &Device) -> String {
    let info = device.info();
    match (info.backend, info.device_type) {
        (wgpu::Backend::Vulkan, wgpu::DeviceType::Cpu) if info.name.starts_with("llvmpipe") => {
            "lavapipe".to_owned()
        }
        (_, wgpu::DeviceType::Cpu) => info.name.split(' ').next().unwrap_or_default().to_owned(),
        (backend, _) => format!("{} ({backend})", info.name),
    }
}

/// What a device says of itself and its driver.
pub fn driver_version(device: &Device) -> String {
    let info = device.info();
    let parts = [&info.name, &info.driver, &info.driver_info];
    let parts: Vec<&str> =
        parts.into_iter().map(|part| part.trim()).filter(|part| !part.is_empty()).collect();
    format!("{}; {}", parts.join(", "), info.backend)
}

/// The include with the evaluation kernel at a level, for any wgpu device.
///
/// # Errors
///
/// If the include cannot be reduced to the level's effects, which no release of the crate lets happen.
pub fn program(level: Quality) -> Result<Program, EffectsError> {
    Ok(Program::wgsl(format!("{}\n{}", wgsl(effects(level))?, crate::WGSL_EVALUATE)))
}

/// A row for every wgpu adapter of the given APIs, with the first adapter's values as reference.
///
/// # Errors
///
/// If there is no adapter, or one refuses the program.
pub fn adapter_rows(backends: wgpu::Backends, inputs: &Inputs) -> Result<Vec<StackRow>, DeviceError> {
    let mut reference = None;
    let devices = Device::every(backends)?;
    let rows = devices.iter().map(|device| {
        let failed = |error: EffectsError| DeviceError::Failed {
            adapter: device.info().name.clone(),
            reason: error.to_string(),
        };
        let program = program(inputs.level).map_err(failed)?;
        let values = device.evaluate(&program, &inputs.table, &inputs.batch)?;
        let stack = Stack {
            driver: driver_name(device),
            path: "WGSL, naga".to_owned(),
            version: driver_version(device),
            command: "softbox stability".to_owned(),
        };
        Ok(inputs.row(&stack, &values, reference.get_or_insert_with(|| values.clone())))
    });
    rows.collect()
}
