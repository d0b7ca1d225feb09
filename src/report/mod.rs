//! What a table is worth: its error against ground truth.

mod measure;
mod texture;

pub use measure::{Accuracy, Quad, REGIONS, Region, Technique, accuracy, random_quads, shade};
pub use texture::{
    Colouring, PICTURE_SIZE, TextureAccuracy, fetch, form_factors, lookup_sights, pictures, texture_accuracy,
};
