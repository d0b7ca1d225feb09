//! From a BRDF to the lobes of a table.
//!
//! Each texel is fitted on its own first, walking from the normal view to the grazing one with the
//! last result as the next start. Then all texels move together so that the *interpolated* lobes
//! fit, at the texels and at the centres of the cells between them.

mod angle;
mod layout;
mod single;
mod texture;
mod whole;

pub use angle::fit_angle_excess;
pub use layout::Layout;
pub use single::Horizon;
pub use texture::{Sight, fit_lookup, lookup_loss};

use rayon::prelude::*;

use crate::brdf::{Brdf, Ggx};
use crate::lobe::Lobe;
use single::Target;

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

/// What to fit and how carefully.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Texels along each axis, at least 2.
    pub size: usize,
    /// The meaning of axes and texels.
    pub layout: Layout,
    /// How the shader will treat the part of a lobe below the surface.
    pub horizon: Horizon,
    /// How much the lobe's shape heeds the BRDF's Schlick part, 0 for not at all. The include finds
    /// that part by the light's direction; other code takes it for a constant share.
    pub schlick_weight: f64,
    /// Quadrature nodes across a lobe; the default of 40 changes the measured error of light
    /// integrals by less than a twentieth of itself against 64.
    pub nodes: usize,
}

impl Settings {
    /// The settings of the table that the include reads.
    pub fn native(size: usize) -> Self {
        Self { size, layout: Layout::Native, horizon: Horizon::Cut, schlick_weight: 0.0, nodes: 40 }
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

fn encode(layout: Layout, lobe: &Lobe, alpha: f64, cosine: f64) -> [f64; 4] {
    let (offset, scale) = layout.affine(alpha, cosine);
    let entries = lobe.entries();
    core::array::from_fn(|k| (entries[k] - offset[k]) / scale[k])
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
    let Settings { size, layout, horizon, schlick_weight, nodes } = settings;
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
            let mut start = None;
            let mut texels = Vec::with_capacity(size);
            for step in 0..size {
                let row = if layout == Layout::Native { size - 1 - step } else { step };
                let cosine = layout.cosine(row as f64 / last);
                let target = Target::new(brdf.as_ref(), cosine, nodes);
                // Seen along the normal a lobe is round: as narrow as the mirror's, 2α to about α, or as
                // wide as the cosine. From there on the last texel's lobe leads.
                let starts = match start {
                    Some(start) => vec![decode(Layout::Native, &start, alpha, cosine)],
                    None => vec![
                        decode(Layout::Native, &[0.0, -2.0, 0.0, 2.0 - alpha], alpha, cosine),
                        Lobe::IDENTITY,
                    ],
                };
                let fits = starts.into_iter().map(|start| {
                    let lobe = target.fit(start, horizon, schlick_weight, 60);
                    (target.normal(&lobe, horizon, schlick_weight).loss, lobe)
                });
                let (_, lobe) = fits.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, Lobe::IDENTITY));
                start = Some(encode(Layout::Native, &lobe, alpha, cosine));
                texels.push((
                    Texel {
                        parameters: encode(layout, &lobe, alpha, cosine),
                        albedo: target.albedo,
                        fresnel: target.fresnel,
                    },
                    target,
                ));
            }
            if layout == Layout::Native {
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
                    Target::new(brdf.as_ref(), cosine, nodes)
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
