//! What methods cost, measured in independent ways, each with its own blindness:
//!
//! - **Operations executed** ([`executed_costs`]): an interpreter runs the kernel and counts what the path that an input takes
//!   needs. The same on every machine, loops included. It knows nothing of registers, addresses or of what waits for what, so
//!   for kernels with hardly a branch it counts up to a quarter fewer than Mesa's compiler for AMD's processors.
//! - **Compiled** ([`compile_for`]): registers, instructions, latency and inverse throughput as that compiler estimates them. It
//!   takes half of the waves to enter each branch, so nested branches all but vanish, and guesses at loops.
//! - **Time** ([`time`]): on lavapipe, or on a graphics processor by its own clock.
//! - **Instructions** ([`callgrind()`]) that lavapipe's code executes; it runs both sides of most branches.

mod baseline;
mod bench;
mod callgrind;
mod compiled;
mod executed;
mod growth;
pub mod inputs;
mod kernel;
mod measure;
mod measured;
mod timing;

pub use crate::interpret::{ExecuteError, Executed, Interpreter, Operations, SPECIAL_SLOTS, Texels};
pub use baseline::{Baseline, BaselineError, TOLERANCE};
pub use bench::{Adapter, Bench, Bound, Job, Prepared};
pub use callgrind::{callgrind, callgrind_child};
pub use compiled::{BINDINGS, compile_for, programs, serve};
pub use executed::{ExecutedCosts, execute, executed_costs};
pub use growth::{
    Average, EFFECTS, LIGHTS, LOBES, PIXELS, SCENE_BINDINGS, VERTICES, compiled_growth, executed_growth,
    executed_on_average, growing_programs, lobes_of_one_light, scene, timed_growth,
};
pub use kernel::{BASELINE, COMPUTE, FRAGMENT, Kernel, MEASURE, VERTEX, baseline};
pub use measure::{Costs, Options, measure};
pub use measured::MeasuredError;
pub use timing::{Effort, INPUTS, Measured, Timed, time, timed_inputs};

/// Why costs could not be measured.
#[derive(Debug, thiserror::Error)]
pub enum CostsError {
    /// A kernel is no valid WGSL.
    #[error("{0}")]
    Invalid(#[from] crate::translate::TranslateError),
    /// A kernel has something that the interpreter lacks.
    #[error("{0}")]
    Execute(#[from] ExecuteError),
    /// There is no compiler.
    #[error("{0}")]
    Compile(#[from] crate::report::cost::CostError),
    /// There is no device to measure on, or it failed.
    #[error("{0}")]
    Device(String),
    /// Instructions could not be counted.
    #[error("no instructions are counted: {0}")]
    Callgrind(String),
    /// A process that was started to measure failed.
    #[error("another process failed: {0}")]
    Child(String),
}
