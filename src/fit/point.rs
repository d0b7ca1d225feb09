//! The fit of one lobe to one roughness and view, free of any table.

use super::Settings;
use super::single::Target;
use crate::brdf::Brdf;
use crate::lobe::Lobe;

/// A lobe fitted to one roughness and view, with the integrals that it carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointFit {
    /// The lobe.
    pub lobe: Lobe,
    /// ∫ f·cos over the hemisphere.
    pub albedo: f64,
    /// ∫ f·cos·(1 − v·h)⁵ over the hemisphere.
    pub fresnel: f64,
}

/// Fits a lobe to the view whose cosine is given, with the loss, the horizon and the nodes of `settings`, starting at
/// `start`; neither neighbours nor smoothness have a say. All four entries are free.
pub fn fit_point(brdf: &dyn Brdf, cosine: f64, start: Lobe, settings: &Settings) -> PointFit {
    let target = Target::new(brdf, cosine, settings.nodes, settings.albedo_nodes);
    let lobe = target.fit(start, [true; 4], settings.goal(), 60);
    PointFit { lobe, albedo: target.albedo, fresnel: target.fresnel }
}
