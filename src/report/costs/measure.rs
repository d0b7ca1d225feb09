//! Everything together, as rows of a report.

use std::path::PathBuf;
use std::process::Command;

use super::bench::Adapter;
use super::callgrind::callgrind;
use super::compiled::{BINDINGS, compile_for, programs};
use super::executed::{ExecutedCosts, executed_costs};
use super::growth::{SCENE_BINDINGS, compiled_growth, executed_growth, growing_programs, timed_growth};
use super::inputs;
use super::kernel::{Kernel, baseline};
use super::timing::{Effort, Measured, time};
use super::{CostsError, SPECIAL_SLOTS};
use crate::interpret::Operations;
use crate::report::cost::Cost;
use crate::report::data::{CostRow, GrowthCurve, Origin, Report};

/// What to measure, and how.
pub struct Options<'a> {
    /// The command that figures are reproduced by.
    pub command: String,
    /// Families of AMD's processors to compile for.
    pub families: Vec<String>,
    /// Starts a process that calls [`serve`](super::serve); without it nothing is compiled.
    pub compiler: Option<&'a dyn Fn() -> Command>,
    /// A process that calls [`callgrind_child`](super::callgrind_child) with the same methods, and a folder for what callgrind
    /// writes; without it no instructions are counted.
    pub callgrind: Option<(Command, PathBuf)>,
    /// Whether to time on lavapipe.
    pub lavapipe: bool,
    /// How long.
    pub effort: Effort,
    /// Random quads to count operations on.
    pub random: usize,
    /// Whether to measure how costs grow.
    pub growth: bool,
    /// Methods whose times over numbers of pixels are measured.
    pub pixels: Vec<String>,
    /// Times on other devices, measured before.
    pub measured: Vec<Measured>,
}

impl Options<'_> {
    /// Counts of operations and their growth; no device is asked.
    pub fn quick(command: &str) -> Self {
        Self {
            command: command.to_owned(),
            families: Vec::new(),
            compiler: None,
            callgrind: None,
            lavapipe: false,
            effort: Effort::QUICK,
            random: 64,
            growth: false,
            pixels: Vec::new(),
            measured: Vec::new(),
        }
    }
}

/// Costs and what reproduces them.
#[derive(Clone, Debug, Default)]
pub struct Costs {
    /// What rows and curves point to.
    pub origins: Vec<Origin>,
    /// Costs of methods.
    pub rows: Vec<CostRow>,
    /// How costs grow.
    pub growth: Vec<GrowthCurve>,
}

impl Costs {
    /// Adds everything to a report.
    pub fn append_to(self, report: &mut Report) {
        let first = report.origins.len();
        report.origins.extend(self.origins);
        report.costs.extend(self.rows.into_iter().map(|row| CostRow { origin: first + row.origin, ..row }));
        let moved = |curve: GrowthCurve| GrowthCurve { origin: first + curve.origin, ..curve };
        report.growth.extend(self.growth.into_iter().map(moved));
    }

    fn origin(&mut self, command: &str, device: &str, seed: &str) -> usize {
        let [command, device, seed] = [command, device, seed].map(str::to_owned);
        self.origins.push(Origin { command, device, seed });
        self.origins.len() - 1
    }

    fn grow(&mut self, curves: Vec<GrowthCurve>, origin: usize) {
        self.growth.extend(curves.into_iter().map(|curve| GrowthCurve { origin, ..curve }));
    }

    /// One figure of each method, and its ratio to that of the first-named index.
    fn add(
        &mut self,
        kernels: &[Kernel],
        (measure, stage, unit): (&str, &str, &str),
        values: &[f64],
        origin: usize,
    ) {
        let base = values[baseline(kernels)];
        for (kernel, value) in kernels.iter().zip(values) {
            self.rows.push(CostRow {
                method: kernel.name.clone(),
                measure: measure.to_owned(),
                stage: stage.to_owned(),
                value: *value,
                unit: unit.to_owned(),
                // Of nothing to nothing there is no ratio.
                ratio: if base == 0.0 { f64::from(u8::from(*value == 0.0)) } else { value / base },
                origin,
            });
        }
    }
}

/// Measures what methods cost. `progress` hears what is being done.
///
/// # Errors
///
/// If something that is asked for is missing.
pub fn measure(
    kernels: &[Kernel],
    options: &Options,
    progress: &mut dyn FnMut(&str),
) -> Result<Costs, CostsError> {
    let mut costs = Costs::default();
    // Both count, so neither minds the other.
    let counts = std::thread::scope(|scope| -> Result<Option<Vec<f64>>, CostsError> {
        let counting = options.callgrind.as_ref().map(|(child, folder)| {
            progress("counting instructions in valgrind");
            scope.spawn(move || callgrind(kernels.len(), child, folder))
        });
        add_executed(&mut costs, kernels, options, progress)?;
        if options.growth {
            progress("counting how operations grow");
            let origin = costs.origin(&options.command, INTERPRETER, "");
            costs.grow(executed_growth()?, origin);
        }
        if let Some(child) = options.compiler {
            compile_all(&mut costs, kernels, options, child, progress)?;
        }
        let counts = counting.map(|counting| {
            progress("waiting for valgrind");
            counting.join().unwrap_or_else(|_| Err(CostsError::Callgrind("it panicked".to_owned())))
        });
        counts.transpose()
    })?;
    if let Some(counts) = counts {
        let origin = costs.origin(&options.command, "lavapipe within valgrind's callgrind", "");
        costs.add(kernels, ("callgrind instructions", "compute", "instructions"), &counts, origin);
    }
    if options.lavapipe {
        progress("timing on lavapipe");
        let measured = time(kernels, &Adapter::Software, options.effort, &options.command)?;
        add_times(&mut costs, "lavapipe time", &measured);
        if options.growth {
            progress("timing how costs grow");
            let is_chosen = |kernel: &&Kernel| options.pixels.contains(&kernel.name);
            let chosen: Vec<Kernel> = kernels.iter().filter(is_chosen).cloned().collect();
            let (device, curves) = timed_growth(&chosen, options.effort)?;
            let origin = costs.origin(&options.command, &device, "");
            costs.grow(curves, origin);
        }
    }
    for measured in &options.measured {
        add_times(&mut costs, "gpu time", measured);
    }
    Ok(costs)
}

fn compile_all(
    costs: &mut Costs,
    kernels: &[Kernel],
    options: &Options,
    child: &dyn Fn() -> Command,
    progress: &mut dyn FnMut(&str),
) -> Result<(), CostsError> {
    let pairs = kernels.iter().map(programs).collect::<Result<Vec<_>, _>>()?;
    let programs: Vec<_> = pairs.into_iter().flatten().collect();
    let growing = if options.growth { growing_programs()? } else { Vec::new() };
    for family in &options.families {
        progress(&format!("compiling for {family}"));
        let (compiler, compiled) = compile_for(family, &BINDINGS, &programs, child())?;
        let device = format!("{}, {}", compiler.device, compiler.driver);
        let origin = costs.origin(&options.command, &device, "");
        add_compiled(costs, kernels, family, &compiled, origin);
        if options.growth {
            let (_, grown) = compile_for(family, &SCENE_BINDINGS, &growing, child())?;
            costs.grow(compiled_growth(family, &grown), origin);
        }
    }
    Ok(())
}

const INTERPRETER: &str = "the interpreter of src/report/costs, on no device";
/// What makes the random quads.
const SEED: &str = "softbox::report::random_quads";

fn add_executed(
    costs: &mut Costs,
    kernels: &[Kernel],
    options: &Options,
    progress: &mut dyn FnMut(&str),
) -> Result<(), CostsError> {
    progress("counting operations");
    let executed = executed_costs(kernels, options.random, 3)?;
    let device = format!("{INTERPRETER}; a special operation takes {SPECIAL_SLOTS} slots");
    let origin = costs.origin(&options.command, &device, SEED);
    let mut add = |measure: &str, unit: &str, of: &dyn Fn(&ExecutedCosts) -> f64| {
        let values: Vec<f64> = executed.iter().map(of).collect();
        costs.add(kernels, (measure, "any", unit), &values, origin);
    };
    add("executed mean", "slots", &|one| one.random.slots() as f64 / one.count as f64);
    add("executed wave", "slots", &|one| one.waves.slots() as f64 / one.wave_count as f64);
    add("executed worst", "slots", &|one| one.worst as f64);
    for (at, (name, _)) in inputs::named().iter().enumerate() {
        add(&format!("executed {name}"), "slots", &|one| one.named[at].1.slots() as f64);
    }
    let mut mean = |measure: &str, unit: &str, of: &dyn Fn(&Operations) -> u64| {
        add(measure, unit, &|one| of(&one.random) as f64 / one.count as f64);
    };
    mean("executed operations", "operations", &Operations::count);
    mean("executed special", "operations", &|all| all.special);
    mean("executed samples", "samples", &|all| all.samples);
    mean("executed branches", "branches", &|all| all.branches);
    Ok(())
}

fn add_compiled(costs: &mut Costs, kernels: &[Kernel], family: &str, compiled: &[Cost], origin: usize) {
    type Figure = (&'static str, &'static str, fn(&Cost) -> u64);
    let figures: [Figure; 6] = [
        ("instructions", "instructions", |cost| cost.instructions),
        ("inverse throughput", "cycles", |cost| cost.inverse_throughput),
        ("latency", "cycles", |cost| cost.latency),
        ("vector registers", "registers", |cost| cost.vector_registers),
        ("waves", "waves", |cost| cost.waves),
        ("spilled registers", "registers", |cost| cost.spilled_registers),
    ];
    for (at, stage) in ["compute", "fragment"].into_iter().enumerate() {
        for (name, unit, of) in figures {
            let values: Vec<f64> = compiled.chunks(2).map(|pair| of(&pair[at]) as f64).collect();
            costs.add(kernels, (&format!("{family} {name}"), stage, unit), &values, origin);
            if matches!(name, "inverse throughput" | "latency") {
                let guessed = |row: &CostRow| {
                    row.measure == format!("{family} {name}")
                        && kernels.iter().any(|kernel| kernel.name == row.method && kernel.has_loops())
                };
                costs.rows.retain(|row| !guessed(row));
            }
        }
    }
}

fn add_times(costs: &mut Costs, measure: &str, measured: &Measured) {
    let origin = costs.origin(&measured.command, &measured.device, "");
    for time in &measured.times {
        costs.rows.push(CostRow {
            method: time.method.clone(),
            measure: measure.to_owned(),
            stage: "compute".to_owned(),
            value: time.nanoseconds,
            unit: "ns".to_owned(),
            ratio: time.ratio,
            origin,
        });
    }
}
