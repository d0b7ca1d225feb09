//! Hard cases: where lights and surfaces lie so that arithmetic of single precision goes wrong, and what must hold there.
//!
//! [`CATALOGUE`] names the families; [`cases`] makes inputs of all of them, the same ones on every run.
//! [`approach`] leads into them by one number, and shows what becomes of errors on the way.

pub mod approach;
mod both;
mod case;
mod check;
mod families;
mod known;
mod level;
mod line;
pub mod page;
mod random;
pub mod relations;
mod rows;
mod run;
mod stacks;
mod text;

pub use both::{BothError, NOT_FINITE, Shaded, Spread, scene_by_both, sheet};
pub use case::{Bound, Case, Shape, batch};
pub use check::{Outcome, offences, outcomes};
pub use families::{CATALOGUE, Family, cases, cases_of, perpendicular};
pub use known::{KNOWN, KnownCase};
pub use level::{
    FACTORS, FAST, FAST_FAMILIES, FILTERED, REORDERED, TERM, VANISHING, at_level, conforming_bound,
};
pub use random::{Random, neighbour};
pub use rows::{Bounds, FamilyRow, Worst};
pub use run::Run;
pub use stacks::{
    Differences, Inputs, PARTS, Stack, StackRow, adapter_rows, driver_name, driver_version, effects, program,
    table,
};
pub use text::{beyond_lines, summary, table_text};
