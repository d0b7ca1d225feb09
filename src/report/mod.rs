//! What methods are worth: their errors against ground truth, their costs, and the report that shows both.

#[cfg(feature = "report")]
pub mod compare;
#[cfg(feature = "cost")]
pub mod cost;
#[cfg(feature = "report")]
pub mod costs;
#[cfg(feature = "report")]
pub mod data;
#[cfg(feature = "report")]
pub mod errors;
#[cfg(feature = "report")]
mod gather;
#[cfg(feature = "bake")]
mod measure;
#[cfg(feature = "report")]
mod method;
#[cfg(feature = "report")]
pub mod page;
#[cfg(feature = "bake")]
mod texture;

#[cfg(feature = "report")]
pub use gather::{Gathered, ReportError, Settings, gather};
#[cfg(feature = "bake")]
pub use measure::{Accuracy, Quad, REGIONS, Region, Technique, accuracy, random_quads, shade};
#[cfg(feature = "report")]
pub use method::Method;
#[cfg(feature = "bake")]
pub use texture::{
    Colouring, PICTURE_SIZE, TextureAccuracy, fetch, form_factors, lookup_sights, pictures, texture_accuracy,
};
