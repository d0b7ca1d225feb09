//! What executed paths take, counted without any device: see [`Interpreter`].

use rayon::prelude::*;

use super::inputs::{self, Input};
use super::kernel::{COMPUTE, Kernel};
use crate::TABLE_SIZE;
use crate::interpret::{ExecuteError, Executed, Interpreter, Operations, Texels};

/// What a method's executed paths take.
#[derive(Clone, Debug)]
pub struct ExecutedCosts {
    /// For each of [`inputs::named`].
    pub named: Vec<(&'static str, Operations)>,
    /// Sums over the random quads.
    pub random: Operations,
    /// How many of these there are.
    pub count: usize,
    /// The most slots that any of these or a named one takes.
    pub worst: u64,
    /// Sums over waves of neighbouring pixels that run in step.
    pub waves: Operations,
    /// How many of these there are.
    pub wave_count: usize,
}

/// Values (diffuse, specular, fresnel) of a kernel on some inputs, and what each took.
///
/// # Errors
///
/// If the kernel has something that the interpreter lacks.
pub fn execute(kernel: &Kernel, inputs: &[Input]) -> Result<Vec<([f32; 3], Executed)>, ExecuteError> {
    let mut interpreter = Interpreter::new(&kernel.source(), COMPUTE, kernel.effects)?;
    // The kernel wraps its indices around a power of two.
    let mut padded = inputs.to_vec();
    padded.resize(inputs.len().next_power_of_two(), inputs[0]);
    let (surfaces, quads) = inputs::buffers(&padded);
    interpreter.bind_buffer(0, surfaces);
    interpreter.bind_buffer(1, quads);
    interpreter.bind_buffer(2, vec![0; 16 * inputs.len()]);
    interpreter.bind_texels(3, Texels::new(TABLE_SIZE, &kernel.table));
    let executed = (0..inputs.len() as u32).map(|at| interpreter.run(at)).collect::<Result<Vec<_>, _>>()?;
    let values: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(interpreter.buffer(2));
    Ok(values.iter().map(|v| [v[0], v[1], v[2]]).zip(executed).collect())
}

/// What kernels' executed paths take, on the named inputs, on `count` random quads and on waves, `across` by `across` for each
/// of two lights.
///
/// # Errors
///
/// If a kernel has something that the interpreter lacks.
pub fn executed_costs(
    kernels: &[Kernel],
    count: usize,
    across: usize,
) -> Result<Vec<ExecutedCosts>, ExecuteError> {
    let named = inputs::named();
    let waves = inputs::waves(across);
    let all: Vec<Input> = named
        .iter()
        .map(|(_, input)| *input)
        .chain(inputs::random(count))
        .chain(waves.iter().flatten().copied())
        .collect();
    let one = |kernel: &Kernel| {
        let executed = execute(kernel, &all)?;
        let (singles, in_waves) = executed.split_at(named.len() + count);
        let totals: Vec<Operations> = singles.iter().map(|(_, executed)| executed.total()).collect();
        let wave = |wave: &[([f32; 3], Executed)]| Executed::wave(wave.iter().map(|(_, executed)| executed));
        Ok(ExecutedCosts {
            named: named.iter().map(|(name, _)| *name).zip(totals.iter().copied()).collect(),
            random: totals[named.len()..].iter().copied().sum(),
            count,
            worst: totals.iter().map(Operations::slots).max().unwrap_or_default(),
            waves: in_waves.chunks(inputs::WAVE).map(wave).sum(),
            wave_count: waves.len(),
        })
    };
    kernels.par_iter().map(one).collect()
}
