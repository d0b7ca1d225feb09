//! Monte Carlo integration.

use core::f32::consts::{FRAC_1_PI, TAU};

use glam::{UVec3, Vec3};

use super::microfacet::Microfacet;
use super::{Input, comparator};
use crate::report::data::MethodInfo;
use crate::report::measure::Quad;
use crate::report::method::Method;

/// Monte Carlo integration by a number of directions, some drawn from the light and some from the reflectance, weighted by
/// the balance heuristic (Veach and Guibas 1995, "Optimally Combining Sampling Techniques for Monte Carlo Rendering").
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Samples {
    /// Its name among the methods.
    pub name: &'static str,
    /// How many directions.
    pub count: u32,
    /// Share of directions to uniformly distributed points of the light.
    pub light: f32,
    /// Share of directions reflected by visible normals.
    pub visible: f32,
    /// Share of directions distributed as the cosine.
    pub cosine: f32,
}

impl Samples {
    const fn both(name: &'static str, count: u32) -> Self {
        Self { name, count, light: 0.5, visible: 0.5, cosine: 0.0 }
    }

    /// The variants that are compared.
    pub const ALL: [Self; 6] = [
        Self::both("samples-1", 1),
        Self::both("samples-4", 4),
        Self::both("samples-16", 16),
        Self::both("samples-64", 64),
        Self { name: "light-16", count: 16, light: 1.0, visible: 0.0, cosine: 0.0 },
        Self { name: "brdf-16", count: 16, light: 0.0, visible: 0.5, cosine: 0.5 },
    ];
}

impl Method for Samples {
    fn info(&self) -> MethodInfo {
        let count = self.count;
        let (label, how) = match self.name {
            "light-16" => ("Monte Carlo, light", "all to points of the light"),
            "brdf-16" => (
                "Monte Carlo, reflectance",
                "half by the visible normals (Heitz 2018) and half by the cosine",
            ),
            _ => ("Monte Carlo", "half to points of the light and half by the visible normals (Heitz 2018)"),
        };
        let directions = if count == 1 { "direction" } else { "directions" };
        comparator(
            self.name,
            &format!("{label}, {count}"),
            &format!(
                "Monte Carlo integration by {count} {directions}, {how}, weighted by the balance heuristic (Veach and \
                 Guibas 1995); random numbers from a hash of the input."
            ),
        )
    }

    fn value(&self, quad: &Quad) -> [f64; 3] {
        let input = quad.into();
        samples_value(self, &input, samples_seed(&input)).map(f64::from)
    }
}

/// A hash of three numbers to three numbers (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", `pcg3d`).
fn hash(key: UVec3) -> UVec3 {
    let step = |v: UVec3| {
        let x = v.x.wrapping_add(v.y.wrapping_mul(v.z));
        let y = v.y.wrapping_add(v.z.wrapping_mul(x));
        let z = v.z.wrapping_add(x.wrapping_mul(y));
        UVec3::new(x, y, z)
    };
    let spread = UVec3::from(key.to_array().map(|k| k.wrapping_mul(1_664_525).wrapping_add(1_013_904_223)));
    let mixed = step(spread);
    step(UVec3::from(mixed.to_array().map(|k| k ^ (k >> 16))))
}

fn bits(v: Vec3) -> UVec3 {
    UVec3::from(v.to_array().map(f32::to_bits))
}

/// The seed of what a shader is asked for: a hash of all its numbers but the light's last two vertices.
pub fn samples_seed(input: &Input) -> [u32; 3] {
    let [a, b, ..] = input.corners;
    let surface =
        hash(bits(input.position) ^ hash(bits(input.view) ^ UVec3::splat(input.roughness.to_bits())));
    hash(surface ^ hash(bits(a) ^ hash(bits(b)))).to_array()
}

/// (diffuse, specular, fresnel) of a parallelogram by Monte Carlo integration.
///
/// One direction alone is of either kind with its share for probability; an even number of them is split exactly. Each
/// counts by the sum of the densities of all kinds, so the mean over seeds is the integral.
pub fn samples_value(samples: &Samples, input: &Input, seed: [u32; 3]) -> [f32; 3] {
    let normal = input.normal;
    let alpha = (input.roughness * input.roughness).max(1e-3);
    let surface = Microfacet::new(normal, input.view, alpha);
    let [a, b, _, d] = input.corners;
    let corner = a - input.position;
    let (x, y) = (b - a, d - a);
    let plane = x.cross(y);
    let distance = -plane.dot(corner);
    if distance <= 0.0 {
        return [0.0; 3];
    }
    let inverse_square = 1.0 / plane.dot(plane);
    let [tangent, bitangent] = basis(normal);
    let local = |v: Vec3| Vec3::new(tangent.dot(v), bitangent.dot(v), normal.dot(v));
    let world = |v: Vec3| tangent * v.x + bitangent * v.y + normal * v.z;
    let view = local(input.view);
    // The third of a direction's numbers serves nothing else.
    let first = hash(UVec3::from(seed)).z >> 31;
    let mut sum = Vec3::ZERO;
    for i in 0..samples.count {
        let random = hash(UVec3::new(seed[0].wrapping_add(i), seed[1], seed[2]));
        let (u, v) =
            ((random.x >> 8) as f32 * (1.0 / 16_777_216.0), (random.y >> 8) as f32 * (1.0 / 16_777_216.0));
        let odd = ((i + first) & 1) == 1;
        let aimed = samples.light > 0.0 && !(odd && samples.visible > 0.0);
        let light = if aimed {
            normalize(corner + x * u + y * v)
        } else if odd {
            world(reflected(view, alpha, u, v))
        } else {
            world(lambertian(u, v))
        };
        // Where the ray meets the light's plane.
        let facing = -plane.dot(light);
        let cosine = normal.dot(light);
        if facing <= 0.0 || cosine <= 0.0 {
            continue;
        }
        let reach = distance / facing;
        let met = light * reach - corner;
        let along = met.cross(y).dot(plane) * inverse_square;
        let across = x.cross(met).dot(plane) * inverse_square;
        let within = (0.0..=1.0).contains(&along) && (0.0..=1.0).contains(&across);
        if !(aimed || within) {
            continue;
        }
        let [value, schlick, visible] = surface.evaluate(light);
        let density = samples.light * (reach * reach / facing)
            + samples.visible * visible
            + samples.cosine * (cosine * FRAC_1_PI);
        sum += Vec3::new(cosine * FRAC_1_PI, value, value * schlick) * (1.0 / density.max(1e-30));
    }
    (sum * (1.0 / samples.count as f32)).to_array()
}

fn normalize(v: Vec3) -> Vec3 {
    v * (1.0 / v.dot(v).max(1e-30).sqrt())
}

/// Two axes across a unit vector (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
fn basis(n: Vec3) -> [Vec3; 2] {
    let side = if n.z >= 0.0 { 1.0 } else { -1.0 };
    let p = -1.0 / (side + n.z);
    let q = n.x * n.y * p;
    [Vec3::new(1.0 + side * n.x * n.x * p, side * q, -side * n.x), Vec3::new(q, side + n.y * n.y * p, -n.y)]
}

/// A direction above the surface with the density of its cosine.
fn lambertian(u: f32, v: f32) -> Vec3 {
    let radius = u.sqrt();
    Vec3::new(radius * (TAU * v).cos(), radius * (TAU * v).sin(), (1.0 - u).max(0.0).sqrt())
}

/// The view reflected by a normal that it sees (Heitz 2018, "Sampling the GGX Distribution of Visible Normals").
fn reflected(view: Vec3, alpha: f32, u: f32, v: f32) -> Vec3 {
    let stretched = normalize(Vec3::new(alpha * view.x, alpha * view.y, view.z));
    // The projected hemisphere as the stretched view sees it: a half disk and a foreshortened one.
    let radius = u.sqrt();
    let (x, whole) = (radius * (TAU * v).cos(), radius * (TAU * v).sin());
    // The disk's second axis leans towards the normal.
    let flat = stretched.x * stretched.x + stretched.y * stretched.y;
    let inverse = 1.0 / flat.max(1e-20).sqrt();
    let x_axis =
        if flat > 1e-12 { Vec3::new(-stretched.y * inverse, stretched.x * inverse, 0.0) } else { Vec3::X };
    let y_axis = stretched.cross(x_axis);
    let share = 0.5 * (1.0 + stretched.z);
    let y = (1.0 - share) * (1.0 - x * x).max(0.0).sqrt() + share * whole;
    let z = (1.0 - x * x - y * y).max(0.0).sqrt();
    let visible = x_axis * x + y_axis * y + stretched * z;
    let half = normalize(Vec3::new(alpha * visible.x, alpha * visible.y, visible.z.max(0.0)));
    half * (2.0 * view.dot(half)) - view
}
