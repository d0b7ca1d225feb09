//! From a BRDF to the lobes of a table.
//!
//! Each texel is fitted on its own first, walking over the views (from the normal to the grazing one, for
//! sheen the other way) with the last result as the next start. Then all texels move together so that the
//! *interpolated* lobes fit, at the texels and at the centres of the cells between them.

mod angle;
mod anisotropic;
mod fitted;
mod layout;
mod point;
mod published;
mod several;
mod single;
mod texture;
mod whole;

pub use angle::{fit_angle_excess, fit_half_angle, fit_hyperbolic_excess};
pub use anisotropic::{FittedAnisotropic, bake_anisotropic};
pub use fitted::{fit_lobe_formula, fit_round_above};
pub use layout::Layout;
pub use point::{PointFit, fit_point};
pub use published::{bake_published, fit_published_angle, published_lobe};
pub use several::{FittedLobes, LobesTexel, bake_lobes};
pub use single::{Horizon, Loss};
pub use texture::{Sight, fit_lookup, lookup_loss};

use rayon::prelude::*;

use crate::brdf::{Brdf, Charlie, Eon, Ggx};
use crate::lobe::Lobe;
use single::{Goal, Target};

/// A material model at every roughness.
pub trait Family: Sync {
    /// The model at a perceptual roughness in 0…1.
    fn at(&self, roughness: f64) -> Box<dyn Brdf>;
}

impl<F: Fn(f64) -> Box<dyn Brdf> + Sync> Family for F {
    fn at(&self, roughness: f64) -> Box<dyn Brdf> {
        self(roughness)
    }
}

/// GGX with height-correlated Smith masking, the default model: α = roughness².
pub fn ggx(roughness: f64) -> Box<dyn Brdf> {
    Box::new(Ggx::new(roughness * roughness))
}

/// The sheen of [`Charlie`], the default model of a sheen layer.
pub fn sheen(roughness: f64) -> Box<dyn Brdf> {
    Box::new(Charlie::of_roughness(roughness))
}

/// The single scattering of a white [`Eon`], the default model of a diffuse layer.
pub fn diffuse(roughness: f64) -> Box<dyn Brdf> {
    Box::new(Eon::single(roughness))
}

/// What to fit and how carefully.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Texels along each axis, at least 2.
    pub size: usize,
    /// The meaning of axes and texels.
    pub layout: Layout,
    /// How the shader will treat the part of a lobe below the surface.
    pub horizon: Horizon,
    /// How the distance between lobe and BRDF is measured.
    pub loss: Loss,
    /// How much the lobe's shape heeds the BRDF's Schlick part, 0 for not at all. The include finds
    /// that part by the light's direction; other code takes it for a constant share.
    pub schlick_weight: f64,
    /// Quadrature nodes across a lobe; the default of 40 changes the measured error of light
    /// integrals by less than a twentieth of itself against 64.
    pub nodes: usize,
    /// Nodes of a finer rule by the model's sampling alone for the albedo, or 0 to take it from the nodes
    /// of the fit. Those see too little of the horizon to know the albedo of a diffuse model or a sheen to
    /// half precision.
    pub albedo_nodes: usize,
}

impl Settings {
    /// The settings of the table that the include reads.
    pub fn native(size: usize) -> Self {
        Self {
            size,
            layout: Layout::Native,
            horizon: Horizon::Cut,
            loss: Loss::Squares,
            schlick_weight: 0.0,
            nodes: 40,
            albedo_nodes: 0,
        }
    }

    fn goal(&self) -> Goal {
        Goal { horizon: self.horizon, loss: self.loss, schlick_weight: self.schlick_weight }
    }

    /// The settings of a sheen layer.
    pub fn sheen(size: usize) -> Self {
        // Of the exponents 3/4 to 6/4 this one gave the least mean error of light integrals on random quads.
        Self { layout: Layout::Sheen, loss: Loss::Divergence(5), albedo_nodes: 80, ..Self::native(size) }
    }

    /// The settings of a layer for rough diffuse surfaces.
    pub fn diffuse(size: usize) -> Self {
        // Of the exponents 0 to 4/4 this one gave the least mean error of light integrals on random quads.
        Self { layout: Layout::Diffuse, loss: Loss::Divergence(1), albedo_nodes: 80, ..Self::native(size) }
    }

    /// The settings of a table for code that implements the published technique.
    pub fn compatible(size: usize) -> Self {
        // The weight at which no part is worse than the published table's on random quads.
        Self {
            layout: Layout::Compatible,
            horizon: Horizon::Uncut,
            schlick_weight: 0.5,
            ..Self::native(size)
        }
    }
}

/// One fitted texel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Texel {
    /// The lobe in the layout's parameters.
    pub parameters: [f64; 4],
    /// ∫ f·cos over the hemisphere, for F = 1.
    pub albedo: f64,
    /// ∫ f·cos·(1 − v·h)⁵ over the hemisphere.
    pub fresnel: f64,
}

/// A fitted table before it is packed.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// What was fitted.
    pub settings: Settings,
    /// `size`² texels, roughness fastest.
    pub texels: Vec<Texel>,
}

impl Fitted {
    /// The lobe that a texel holds, at its own roughness and view.
    pub fn lobe(&self, column: usize, row: usize) -> Lobe {
        let Settings { size, layout, .. } = self.settings;
        let last = (size - 1) as f64;
        let alpha = layout.alpha(column as f64 / last);
        let cosine = layout.cosine(row as f64 / last);
        decode(layout, &self.texels[column + row * size].parameters, alpha, cosine)
    }
}

pub(crate) fn decode(layout: Layout, parameters: &[f64; 4], alpha: f64, cosine: f64) -> Lobe {
    let (offset, scale) = layout.affine(alpha, cosine);
    Lobe::from_entries(core::array::from_fn(|k| offset[k] + scale[k] * parameters[k]))
}

pub(crate) fn encode(layout: Layout, lobe: &Lobe, alpha: f64, cosine: f64) -> [f64; 4] {
    let (offset, scale) = layout.affine(alpha, cosine);
    let entries = lobe.entries();
    core::array::from_fn(|k| if scale[k] == 0.0 { 0.0 } else { (entries[k] - offset[k]) / scale[k] })
}

/// Fits a whole table. The result depends on nothing but the arguments: not on the number of
/// threads, nor on their timing.
///
/// `progress` is told the share of the work done, 0…1, from any thread.
///
/// # Panics
///
/// If `settings.size < 2`.
pub fn bake(family: &dyn Family, settings: Settings, progress: &(dyn Fn(f64) + Sync)) -> Fitted {
    let Settings { size, layout, nodes, albedo_nodes, .. } = settings;
    let goal = settings.goal();
    assert!(size >= 2, "a table needs at least 2 texels along each axis, not {size}");
    let done = core::sync::atomic::AtomicUsize::new(0);
    let advance = |columns: f64| {
        let before = done.fetch_add(1, core::sync::atomic::Ordering::Relaxed);
        progress(((before + 1) as f64 / columns).min(1.0));
    };
    let steps = (2 * size - 1) as f64;
    let last = (size - 1) as f64;

    let columns: Vec<Vec<(Texel, Target)>> = (0..size)
        .into_par_iter()
        .map(|column| {
            let alpha = layout.alpha(column as f64 / last);
            let brdf = family.at(alpha.sqrt());
            let (walk, free) = (layout.walk(), layout.free());
            let mut start = None;
            let mut texels = Vec::with_capacity(size);
            for step in 0..size {
                let row = if layout.ascends() { step } else { size - 1 - step };
                let cosine = layout.cosine(row as f64 / last);
                let target = Target::new(brdf.as_ref(), cosine, nodes, albedo_nodes);
                // From the first view on, the last texel's lobe leads.
                let starts = match start {
                    Some(start) => vec![decode(walk, &start, alpha, cosine)],
                    None => layout.starts(alpha, cosine).to_vec(),
                };
                let fits = starts.into_iter().map(|start| {
                    let lobe = target.fit(start, free, goal, 60);
                    (target.normal(&lobe, goal).loss, lobe)
                });
                let (_, lobe) = fits.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, Lobe::IDENTITY));
                start = Some(encode(walk, &lobe, alpha, cosine));
                texels.push((
                    Texel {
                        parameters: encode(layout, &lobe, alpha, cosine),
                        albedo: target.albedo,
                        fresnel: target.fresnel,
                    },
                    target,
                ));
            }
            if !layout.ascends() {
                texels.reverse();
            }
            advance(steps);
            texels
        })
        .collect();

    let between: Vec<Vec<Target>> = (0..size - 1)
        .into_par_iter()
        .map(|column| {
            let brdf = family.at(layout.alpha((column as f64 + 0.5) / last).sqrt());
            let targets = (0..size - 1)
                .map(|row| {
                    let cosine = layout.cosine((row as f64 + 0.5) / last);
                    Target::new(brdf.as_ref(), cosine, nodes, albedo_nodes)
                })
                .collect();
            advance(steps);
            targets
        })
        .collect();

    let mut fitted = Fitted { settings, texels: Vec::with_capacity(size * size) };
    for row in 0..size {
        fitted.texels.extend(columns.iter().map(|column| column[row].0));
    }
    whole::refine(&mut fitted, &columns, &between);
    fitted
}
