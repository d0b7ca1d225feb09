//! Hard cases: where lights and surfaces lie so that arithmetic of single precision goes wrong, and what must hold there.
//!
//! [`CATALOGUE`] names the families; [`cases`] makes inputs of all of them, the same ones on every run.

mod case;
mod check;
mod families;
mod random;
mod stacks;

pub use case::{Bound, Case, Shape, batch};
pub use check::{Outcome, offences, outcomes};
pub use families::{CATALOGUE, Family, cases, cases_of, perpendicular};
pub use random::{Random, neighbour};
pub use stacks::{
    Differences, Inputs, PARTS, Stack, StackRow, adapter_rows, driver_name, driver_version, effects, program,
    table,
};
