//! Any device that conforms to WGSL's specification, the worst included.
//!
//! A test on devices that are at hand says nothing about those that are not. WGSL says how far an operation may be off; here
//! kernels run on devices that make use of that: [`Policy`]. For each invocation there is what it wrote, and a [`Finding`] for
//! each operation of which WGSL does not say what it comes to.
//!
//! What is modelled: sums and products rounded to either neighbour; quotients, roots and functions within their units in the
//! last place; subnormal numbers that become zero; the sign of zero; products that sums take unrounded; sums and products in
//! another order; texture filters with few binary places. Results that are no numbers are passed on as devices do that know
//! them, but comparisons with them come to anything.
//!
//! What is not: that a compiler multiplies out or factors, which WGSL's list of what is allowed does not have; other orders
//! than those that put one operation at a time in another place; the arithmetic of the filter itself, whose accuracy no
//! specification states.

mod device;
mod finding;
mod order;
mod permitted;
mod policy;
mod run;
mod trace;

pub use finding::{Concern, Finding};
pub use policy::{Filter, Freedom, Policy, Rounding};
pub use run::{Conforming, ConformingMachine, Outcome, Sampled, Worst};
