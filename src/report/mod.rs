//! What a table is worth: its error against ground truth.

mod measure;

pub use measure::{Accuracy, Quad, REGIONS, Region, Technique, accuracy, random_quads, shade};
