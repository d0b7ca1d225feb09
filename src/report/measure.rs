//! The error of shading with a table, on random quads.

use glam::DVec3;
use rayon::prelude::*;

use crate::effects::Effects;
use crate::fit::Family;
use crate::lobe::Lobe;
use crate::shade::{Vector, ltc_fast_quad, ltc_pentagon, ltc_quad, ltc_surface};
use crate::table::Table;
use crate::truth;

/// A surface point and a quad light, in the surface's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Quad {
    /// Perceptual roughness.
    pub roughness: f64,
    /// Unit vector to the eye.
    pub view: DVec3,
    /// Vertices, counter-clockwise seen from the surface point.
    pub corners: [DVec3; 4],
}

/// How a table's texels become light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Technique {
    /// As the include does it, with a table in the native layout.
    Include,
    /// As the include does it with some effects, with a table that has their layers.
    With(Effects),
    /// As published (Heitz et al. 2016): light is cut at the lobe's horizon alone, and Schlick's part
    /// is a constant share of the whole. For a table in the compatible layout.
    Published,
}

/// Bounds of roughness and of the view's cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Smallest and largest roughness.
    pub roughness: (f64, f64),
    /// Smallest and largest cosine between normal and view.
    pub cosine: (f64, f64),
}

/// Three ranges of roughness by three of the view's cosine.
pub const REGIONS: [Region; 9] = {
    let roughness = [(0.1, 0.3), (0.3, 0.6), (0.6, 1.0)];
    let cosine = [(0.6, 1.0), (0.3, 0.6), (0.05, 0.3)];
    let mut regions = [Region { roughness: (0.0, 0.0), cosine: (0.0, 0.0) }; 9];
    let mut i = 0;
    while i < 9 {
        regions[i] = Region { roughness: roughness[i / 3], cosine: cosine[i % 3] };
        i += 1;
    }
    regions
};

/// Mean |error| over mean value, of the specular value (F = 1), of its Schlick part, and of a
/// dielectric with F0 = 0.04 and F90 = 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Accuracy {
    /// Of ∫ f·cos.
    pub specular: f64,
    /// Of ∫ f·cos·(1 − v·h)⁵.
    pub fresnel: f64,
    /// Of 0.04·(specular − fresnel) + fresnel.
    pub dielectric: f64,
}

/// Numbers that look random and are the same on every run: SplitMix64 (Steele et al. 2014).
pub(super) struct Random(pub(super) u64);

impl Random {
    /// Uniform in 0…1.
    pub(super) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform between two bounds.
    pub(super) fn between(&mut self, (low, high): (f64, f64)) -> f64 {
        low + (high - low) * self.unit()
    }
}

/// `count` quads in a region, the same on every run: 60 % near the mirror direction, at distances
/// of 0.5…8 with half-sizes of 0.1…2; many straddle the horizon.
pub fn random_quads(region: Region, count: usize) -> Vec<Quad> {
    let mut random = Random(region.roughness.0.to_bits() ^ region.cosine.0.to_bits().rotate_left(17));
    let mut quads = Vec::with_capacity(count);
    while quads.len() < count {
        let mut between = |bounds: (f64, f64)| random.between(bounds);
        let roughness = between(region.roughness);
        let cosine = between(region.cosine);
        let view = DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
        let mut direction = || {
            let z = between((-1.0, 1.0));
            let azimuth = between((0.0, core::f64::consts::TAU));
            let radius = (1.0 - z * z).sqrt();
            DVec3::new(radius * azimuth.cos(), radius * azimuth.sin(), z)
        };
        let mirror = DVec3::new(-view.x, 0.0, view.z);
        let (aside, anywhere, facing, turn) = (direction(), direction(), direction(), direction());
        let near_mirror = between((0.0, 1.0)) < 0.6;
        let distance = between((0.5, 8.0));
        let (width, height) = (between((0.1, 2.0)), between((0.1, 2.0)));
        let towards = if near_mirror {
            (mirror + aside * 0.5).normalize_or(mirror)
        } else {
            DVec3::new(anywhere.x, anywhere.y, anywhere.z.abs())
        };
        let centre = towards * distance;
        let facing = if facing.dot(centre) > 0.0 { -facing } else { facing };
        let x = facing.cross(turn).normalize_or_zero();
        let y = facing.cross(x);
        let (x, y) = (x * width, y * height);
        let corners = [centre - x - y, centre + x - y, centre + x + y, centre - x + y];
        // A light wholly below the horizon says nothing.
        if corners.iter().any(|corner| corner.z > 0.0) && x != DVec3::ZERO {
            quads.push(Quad { roughness, view, corners });
        }
    }
    quads
}

/// (specular, fresnel) of a quad by a table.
pub fn shade(table: &Table, technique: Technique, quad: &Quad) -> [f64; 2] {
    match technique {
        Technique::Include => shade(table, Technique::With(Effects::NONE), quad),
        Technique::With(effects) => {
            let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, quad.view, quad.roughness);
            let lobes = table.specular(&surface, effects);
            let value = if effects.is_fast() {
                ltc_fast_quad(&surface, &lobes, quad.corners, false)
            } else {
                ltc_quad(&surface, &lobes, quad.corners, false)
            };
            [value.y(), value.z()]
        }
        Technique::Published => {
            let last = (table.size() - 1) as f64;
            let place = |coordinate: f64| (coordinate * last + 0.5) / (last + 1.0);
            let at = glam::DVec2::new(place(quad.roughness), place((1.0 - quad.view.z).max(0.0).sqrt()));
            let lobe = Lobe::from_entries(table.sample::<f64>(0, at).into());
            let amplitude = table.sample::<f64>(1, at);
            let [a, b, c, d] = quad.corners.map(|corner| lobe.transform(corner));
            let vertices = [a, b, c, d, d];
            let normals = core::array::from_fn(|i| vertices[i].cross(vertices[(i + 1) % 5]));
            let form_factor = ltc_pentagon::<f64>(vertices, normals, 0.0).z / core::f64::consts::TAU;
            let form_factor = form_factor.max(0.0);
            [amplitude.x * form_factor, amplitude.y * form_factor]
        }
    }
}

/// Mean |error| over mean value of a table on some quads, against numerical integration of the
/// model itself.
pub fn accuracy(table: &Table, technique: Technique, family: &dyn Family, quads: &[Quad]) -> Accuracy {
    let rows: Vec<[f64; 6]> = quads
        .par_iter()
        .map(|quad| {
            let brdf = family.at(quad.roughness);
            let truth = truth::polygon(brdf.as_ref(), quad.view, &quad.corners, false, 1e-5);
            let [specular, fresnel] = shade(table, technique, quad);
            let dielectric = |specular: f64, fresnel: f64| 0.04 * (specular - fresnel) + fresnel;
            let exact = dielectric(truth.specular, truth.fresnel);
            [
                (specular - truth.specular).abs(),
                truth.specular,
                (fresnel - truth.fresnel).abs(),
                truth.fresnel,
                (dielectric(specular, fresnel) - exact).abs(),
                exact,
            ]
        })
        .collect();
    let ratio = |k: usize| {
        let sum = |k: usize| rows.iter().map(|row| row[k]).sum::<f64>();
        sum(k) / sum(k + 1)
    };
    Accuracy { specular: ratio(0), fresnel: ratio(2), dielectric: ratio(4) }
}
