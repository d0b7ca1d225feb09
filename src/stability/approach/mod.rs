//! Ways to hard places: the error of the published forms and of this library along each.
//!
//! What is measured is what single precision does. Every method is compared with itself in exact arithmetic, on the same
//! table, the same lobe and the same light, whose coordinates are f32 for all; whether its lobes are those of GGX is another
//! question, which [`crate::report`] answers.

mod chart;
mod curve;
mod exact;
mod list;
mod make;
mod precision;
mod published;
mod round;
mod setting;

pub use chart::{OVERVIEW_NAME, charts, lines, table};
pub use curve::{Curve, Method, Parts, Reading, Step, Tables, VARIANTS, curves, parameters, read};
pub use list::{Approach, Measure, Part, approaches};
pub use published::EdgeForm;
pub use setting::Setting;
