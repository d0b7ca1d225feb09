//! An interpreter of WGSL kernels, one scalar operation at a time.
//!
//! What becomes of each operation is up to an observer. One counts what the path of an input takes: [`Interpreter`]. Another
//! is a device that makes use of all that WGSL's specification leaves open, in rounding, order, subnormal numbers and texture
//! filters, and that finds where the specification promises nothing: [`Conforming`].

mod arithmetic;
mod conforming;
mod count;
mod memory;
mod number;
mod observer;
mod program;
mod random;
mod run;
mod texels;
mod values;

pub use conforming::{
    Concern, Conforming, ConformingMachine, Filter, Finding, Freedom, Outcome, Policy, Rounding, Sampled,
    Worst,
};
pub use count::{Executed, Interpreter, Operations, SPECIAL_SLOTS};
pub use program::{ExecuteError, STATEMENTS};
pub use texels::Texels;
