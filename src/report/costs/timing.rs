//! Times of methods against each other on one device.

use serde::{Deserialize, Serialize};

use super::CostsError;
use super::bench::{Adapter, Bench, Bound, Job, Prepared};
use super::inputs::{self, Input};
use super::kernel::{COMPUTE, Kernel, baseline};

/// How long to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Rounds over all methods, one dispatch of each in turn.
    pub rounds: usize,
    /// Nanoseconds that a method runs in each round, about.
    pub nanoseconds: f64,
}

impl Effort {
    /// For figures to be kept.
    pub const WHOLE: Self = Self { rounds: 121, nanoseconds: 2e6 };
    /// For a look.
    pub const QUICK: Self = Self { rounds: 7, nanoseconds: 1e6 };
}

/// A method's time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timed {
    /// The method's name.
    pub method: String,
    /// Nanoseconds for each invocation.
    pub nanoseconds: f64,
    /// The same over that of the method `published`.
    pub ratio: f64,
    /// Median of the ratios of each round. Where it is far from `ratio`, the machine was busy with something else.
    pub median_ratio: f64,
    /// Half the distance between the quartiles of the ratios of each round.
    pub spread: f64,
}

/// Times on one device, as a file keeps them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// The device and its driver, with its version.
    pub device: String,
    /// The command that measured.
    pub command: String,
    /// The methods.
    pub times: Vec<Timed>,
}

/// Inputs that each dispatch goes over again and again: few enough to stay in a cache, so that arithmetic is measured.
pub const INPUTS: usize = 8 * inputs::WAVE;

/// Waves of neighbouring pixels, since neighbours mostly go the same ways, as in a picture.
pub fn timed_inputs() -> Vec<Input> {
    inputs::waves(2).concat()
}

/// The share of rounds that are taken to be undisturbed: what else a machine does only ever adds time.
const UNDISTURBED: f64 = 0.1;

/// Most invocations of a dispatch.
const MOST: f64 = (1 << 20) as f64;

/// What is measured for a method: `invocations` of it on some inputs, whose number is a power of two.
pub fn job(kernel: &Kernel, inputs: &[Input], invocations: u32) -> Job {
    let (surfaces, quads) = inputs::buffers(inputs);
    let output = Bound::Output(16 * u64::from(invocations));
    let bound = vec![
        Bound::Input(surfaces),
        Bound::Input(quads),
        output,
        Bound::Table(kernel.table.to_vec()),
        Bound::Sampler,
    ];
    Job { source: kernel.source(), entry_point: COMPUTE, effects: kernel.effects, bound }
}

/// Times methods on an adapter, each in turn, round after round. A graphics processor's time is by its own clock.
///
/// # Errors
///
/// If there is no such adapter, or it refuses a kernel.
pub fn time(
    kernels: &[Kernel],
    adapter: &Adapter,
    effort: Effort,
    command: &str,
) -> Result<Measured, CostsError> {
    let bench = Bench::open(adapter)?;
    let own_clock = *adapter != Adapter::Software;
    let run = |each: &[(&Prepared, u32, u32)]| -> Result<Vec<f64>, CostsError> {
        if own_clock {
            return bench.run_by_its_clock(each);
        }
        each.iter().map(|(prepared, count, dispatches)| bench.run(prepared, *count, *dispatches)).collect()
    };
    let inputs = timed_inputs();
    let mut prepared = Vec::new();
    for kernel in kernels {
        // As many as make the wanted time, found by doubling.
        let whole = bench.prepare(&job(kernel, &inputs, MOST as u32))?;
        let mut count = 1024.0;
        loop {
            // The first run pays for what is done once, and any may be disturbed.
            let mut nanoseconds = f64::INFINITY;
            for _ in 0..4 {
                nanoseconds = nanoseconds.min(run(&[(&whole, count as u32, 1)])?[0].max(1.0));
            }
            if nanoseconds >= 0.5 * effort.nanoseconds || count >= MOST {
                let dispatches = (effort.nanoseconds / nanoseconds).round().clamp(1.0, 64.0);
                prepared.push((whole, count as u32, dispatches as u32));
                break;
            }
            let wanted = (effort.nanoseconds / nanoseconds).clamp(1.2, 16.0);
            count = (64.0 * (count * wanted / 64.0).ceil()).min(MOST);
        }
    }
    let each: Vec<_> =
        prepared.iter().map(|(prepared, count, dispatches)| (prepared, *count, *dispatches)).collect();
    let base = baseline(kernels);
    let mut times = vec![Vec::new(); kernels.len()];
    let mut ratios = vec![Vec::new(); kernels.len()];
    for _ in 0..effort.rounds {
        let round = run(&each)?;
        let one = |at: usize| round[at] / (f64::from(each[at].1) * f64::from(each[at].2));
        for at in 0..kernels.len() {
            times[at].push(one(at));
            ratios[at].push(one(at) / one(base));
        }
    }
    let least = quantile(&times[base], UNDISTURBED);
    let timed = kernels.iter().zip(times).zip(ratios).map(|((kernel, times), ratios)| Timed {
        method: kernel.name.clone(),
        nanoseconds: quantile(&times, UNDISTURBED),
        ratio: quantile(&times, UNDISTURBED) / least,
        median_ratio: quantile(&ratios, 0.5),
        spread: 0.5 * (quantile(&ratios, 0.75) - quantile(&ratios, 0.25)),
    });
    Ok(Measured { device: bench.name(), command: command.to_owned(), times: timed.collect() })
}

/// The value below which a share of the values lie.
pub(super) fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[(share * (sorted.len() - 1) as f64).round() as usize]
}
