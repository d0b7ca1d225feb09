//! The level of one lobe and a table, step by step.

use std::collections::HashMap;

use glam::DVec3;
use rayon::prelude::*;

use super::{Case, Evaluate, LevelSteps, TableMethod, exact_angle, exact_value, fitted_angle, model};
use crate::fit::{Fitted, Layout, PointFit, Settings, bake, decode, encode, fit_point, ggx};
use crate::report::Quad;
use crate::shade::{
    LtcLobe, LtcSurface, ltc_lobe, ltc_planar_lobe, ltc_quad, ltc_surface, ltc_table_coordinates,
};

/// Parameters of a lobe in the table's layout, then its albedo and Schlick part.
type Texel = [f64; 6];

/// The fits that the steps of the level `standard` differ by.
pub struct StandardSteps {
    method: TableMethod,
    /// The table before it was rounded.
    joint: Fitted,
    /// What each texel would be, had it been fitted alone.
    free: Vec<Texel>,
    /// Lobes fitted to single cases, by roughness and cosine of the view.
    points: HashMap<[u64; 2], PointFit>,
}

impl StandardSteps {
    /// Fits what is needed for the given cases: the table as it is baked, which takes most of the time, its texels one
    /// by one, and each case.
    ///
    /// `settings` are those that the method's table was baked with. `progress` hears the share of the bake.
    pub fn new(
        method: TableMethod,
        settings: Settings,
        cases: &[Case],
        progress: &(dyn Fn(f64) + Sync),
    ) -> Self {
        let joint = bake(&ggx_floored, settings, progress);
        let size = settings.size;
        let free = (0..size * size).into_par_iter().map(|index| {
            let at = |index: usize| index as f64 / (size - 1) as f64;
            let (alpha, cosine) =
                (Layout::Native.alpha(at(index % size)), Layout::Native.cosine(at(index / size)));
            let start = joint.lobe(index % size, index / size);
            let fit = fit_point(&model(alpha.sqrt()), cosine, start, &settings);
            texel(&fit, alpha, cosine)
        });
        let free = free.collect();
        let mut steps = Self { method, joint, free, points: HashMap::new() };
        steps.points = cases.par_iter().map(|case| (key(&case.quad), steps.point(&case.quad))).collect();
        steps
    }

    /// The causes, in this order:
    ///
    /// * `lobe model`: the lobe that is fitted to the case's own roughness and view alone, with the loss of the table's
    ///   bake, and evaluated exactly;
    /// * `fit`: what the joint fit of all texels changes of their own fits, interpolated, is added to that lobe;
    /// * `interpolation`: the lobe comes from the table before rounding;
    /// * `half precision`: from the table;
    /// * `horizon`: cut as the include does it, in f64;
    /// * `edge integral`: with the include's polynomial for angles;
    /// * `single precision`: the include in f32.
    pub fn steps(&self) -> LevelSteps<'_> {
        let fitted = fitted_angle();
        let rounded = |surface: &LtcSurface<f64>| self.method.table.lobe(surface);
        let exact = |quad: &Quad, lobe: &LtcLobe<f64>, surface: &LtcSurface<f64>| {
            exact_value(surface, &[*lobe], &quad.corners, &exact_angle)
        };
        let own = move |quad: &Quad| {
            let surface = surface(quad);
            let fit = self.points.get(&key(quad)).copied().unwrap_or_else(|| self.point(quad));
            exact(quad, &planar(&surface, &fit), &surface)
        };
        let joint = move |quad: &Quad| {
            let surface = surface(quad);
            let fit = self.points.get(&key(quad)).copied().unwrap_or_else(|| self.point(quad));
            let (ideal, joint, free) = (
                texel(&fit, surface.alpha, surface.cos_view),
                self.interpolated_joint(&surface),
                bilinear(&surface, self.joint.settings.size, |index| self.free[index]),
            );
            exact(quad, &lobe(&surface, core::array::from_fn(|k| ideal[k] + joint[k] - free[k])), &surface)
        };
        let interpolated = move |quad: &Quad| {
            let surface = surface(quad);
            exact(quad, &lobe(&surface, self.interpolated_joint(&surface)), &surface)
        };
        let half = move |quad: &Quad| {
            let surface = surface(quad);
            exact(quad, &rounded(&surface), &surface)
        };
        let cut = move |quad: &Quad| {
            let surface = surface(quad);
            ltc_quad(&surface, &rounded(&surface), quad.corners, false).to_array()
        };
        let edges = move |quad: &Quad| {
            let surface = surface(quad);
            let lobe = rounded(&surface);
            let (value, exact) = (cut(quad), exact(quad, &lobe, &surface));
            let with_fit = exact_value(&surface, &[lobe], &quad.corners, &fitted);
            core::array::from_fn(|k| value[k] + with_fit[k] - exact[k])
        };
        let single = move |quad: &Quad| crate::report::Method::value(&self.method, quad);
        let steps: [(&str, Evaluate); 7] = [
            ("lobe model", Box::new(own)),
            ("fit", Box::new(joint)),
            ("interpolation", Box::new(interpolated)),
            ("half precision", Box::new(half)),
            ("horizon", Box::new(cut)),
            ("edge integral", Box::new(edges)),
            ("single precision", Box::new(single)),
        ];
        let steps = steps.into_iter().map(|(cause, value)| (cause.to_owned(), value)).collect();
        LevelSteps { steps, method: &self.method }
    }

    /// The lobe that fits a case's own roughness and view, found from the table's.
    fn point(&self, quad: &Quad) -> PointFit {
        let surface = surface(quad);
        let near: [f64; 4] = core::array::from_fn(|k| self.interpolated_joint(&surface)[k]);
        let start = decode(Layout::Native, &near, surface.alpha, surface.cos_view);
        fit_point(&model(quad.roughness), quad.view.z, start, &self.joint.settings)
    }

    fn interpolated_joint(&self, surface: &LtcSurface<f64>) -> Texel {
        bilinear(surface, self.joint.settings.size, |index| {
            let texel = &self.joint.texels[index];
            let [x, y, z, w] = texel.parameters;
            [x, y, z, w, texel.albedo, texel.fresnel]
        })
    }
}

/// The model of the bake: roughness never falls below the table's floor there.
fn ggx_floored(roughness: f64) -> Box<dyn crate::brdf::Brdf> {
    ggx(roughness)
}

fn key(quad: &Quad) -> [u64; 2] {
    [quad.roughness.to_bits(), quad.view.z.to_bits()]
}

fn surface(quad: &Quad) -> LtcSurface<f64> {
    ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, quad.view, quad.roughness)
}

fn texel(fit: &PointFit, alpha: f64, cosine: f64) -> Texel {
    let [x, y, z, w] = encode(Layout::Native, &fit.lobe, alpha, cosine);
    [x, y, z, w, fit.albedo, fit.fresnel]
}

fn lobe(surface: &LtcSurface<f64>, [x, y, z, w, albedo, fresnel]: Texel) -> LtcLobe<f64> {
    ltc_lobe(surface, [x, y, z, w].into(), [albedo, fresnel, 0.0, 0.0].into())
}

fn planar(surface: &LtcSurface<f64>, fit: &PointFit) -> LtcLobe<f64> {
    ltc_planar_lobe(surface, fit.lobe.entries(), fit.albedo, fit.fresnel)
}

/// What a sampler returns from texels that are not rounded.
fn bilinear(surface: &LtcSurface<f64>, size: usize, texel: impl Fn(usize) -> Texel) -> Texel {
    let place = |coordinate: f64| {
        let position = (coordinate * size as f64 - 0.5).clamp(0.0, (size - 1) as f64);
        let cell = (position as usize).min(size - 2);
        (cell, position - cell as f64)
    };
    let [u, v] = ltc_table_coordinates(surface, size as f64).to_array();
    let ((column, right), (row, down)) = (place(u), place(v));
    let first = column + row * size;
    let corners = [
        (texel(first), (1.0 - right) * (1.0 - down)),
        (texel(first + 1), right * (1.0 - down)),
        (texel(first + size), (1.0 - right) * down),
        (texel(first + size + 1), right * down),
    ];
    core::array::from_fn(|k| corners.iter().map(|(texel, weight)| weight * texel[k]).sum())
}
