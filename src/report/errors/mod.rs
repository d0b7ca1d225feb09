//! How far a method is from the truth, and why.
//!
//! Everything is measured against [`truth::polygon`], the numerical integration of the real GGX,
//! which is found once for a set of lights and shared by all methods.

mod budget;
mod exact;
mod lights;
mod lobes;
mod maps;
mod pictures;
mod standard;
mod strata;
mod sweeps;
mod tables;

pub use budget::{Evaluate, LevelSteps, budget};
pub use exact::{EdgeAngle, exact_angle, exact_value, fitted_angle};
pub use lights::random_lights;
pub use lobes::{Density, Lobes, cosine_density, lobe_rows, table_lobes, total_variation};
pub use maps::{MAP_SEED, MapSet, MapSettings};
pub use pictures::{DIFFERENCE_SCALE, PictureError, PictureLevel, pictures};
pub use standard::StandardSteps;
pub use strata::{
    ErrorSet, QUAD_SEED, REGION, STRATA, Stratum, TRIANGLE_SEED, error_row, error_rows, solid_angle,
};
pub use sweeps::{Error, Sweep, UNIVARIATE, sweep, univariate};
pub use tables::{TableFileError, TableMethod, decode_table, read_table};

use rayon::prelude::*;

use super::data::Part;
use super::{Method, Quad};
use crate::brdf::Ggx;
use crate::shade::LTC_ROUGHNESS_FLOOR;
use crate::truth;

/// All parts, in the order of [`parts`].
pub const PARTS: [Part; 4] = [Part::Diffuse, Part::Specular, Part::Fresnel, Part::Dielectric];

/// Relative error that the truth is integrated to; its own estimate is mostly far below.
pub const TRUTH_TOLERANCE: f64 = 1e-5;

/// A light with its true value.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The surface point and the light.
    pub quad: Quad,
    /// (diffuse, specular, fresnel) by numerical integration of the model.
    pub truth: [f64; 3],
}

/// How much work a measurement may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Seconds.
    Quick,
    /// A minute.
    Full,
}

/// The model that all errors are measured against.
pub fn model(roughness: f64) -> Ggx {
    Ggx::new(roughness.max(LTC_ROUGHNESS_FLOOR).powi(2))
}

/// The true value of a light, (diffuse, specular, fresnel).
pub fn true_value(quad: &Quad) -> [f64; 3] {
    let truth = truth::polygon(&model(quad.roughness), quad.view, &quad.corners, false, TRUTH_TOLERANCE);
    [truth.diffuse, truth.specular, truth.fresnel]
}

/// Finds the true values of lights.
pub fn cases(quads: Vec<Quad>) -> Vec<Case> {
    quads.into_par_iter().map(|quad| Case { truth: true_value(&quad), quad }).collect()
}

/// The four parts of a value (diffuse, specular, fresnel); the last is that of a dielectric, F0 = 0.04 and F90 = 1.
pub fn parts([diffuse, specular, fresnel]: [f64; 3]) -> [f64; 4] {
    [diffuse, specular, fresnel, 0.04 * (specular - fresnel) + fresnel]
}

/// The values of a method.
pub fn values(method: &dyn Method, cases: &[Case]) -> Vec<[f64; 3]> {
    cases.par_iter().map(|case| method.value(&case.quad)).collect()
}
