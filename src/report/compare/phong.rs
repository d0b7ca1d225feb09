//! Axial moments of a Phong lobe.

use core::f32::consts::FRAC_1_PI;

use glam::Vec3;

use super::published::published_lobe;
use super::{Input, comparator, published_table};
use crate::report::data::MethodInfo;
use crate::report::measure::Quad;
use crate::report::method::Method;
use crate::table::Table;

/// Axial moments of a Phong lobe over a polygon (Arvo 1995, "Applications of Irradiance Tensors to the Simulation of
/// Non-Lambertian Phenomena").
#[derive(Clone, Debug, PartialEq)]
pub struct Phong(Table);

impl Phong {
    /// With another table of albedos in the published layout.
    pub fn with(table: Table) -> Self {
        Self(table)
    }
}

impl Default for Phong {
    fn default() -> Self {
        Self(published_table())
    }
}

impl Method for Phong {
    fn info(&self) -> MethodInfo {
        comparator(
            "phong",
            "Phong lobe",
            "Exact integral of a Phong lobe with GGX's albedo by axial moments (Arvo 1995), clipped exactly at the \
             surface's and the lobe's horizon; work grows with the exponent.",
        )
    }

    fn value(&self, quad: &Quad) -> [f64; 3] {
        phong_value(&self.0, &quad.into()).map(f64::from)
    }
}

/// Largest exponent; sharper lobes are taken for this one.
const EXPONENT_CAP: f32 = 2047.0;

/// The exponent of cosⁿ around the mirror direction that stands for GGX: a quarter of the half vector's 2/α² − 2
/// (Walter et al. 2007, section 5), no less than 1 and no more than 2047.
pub fn phong_exponent(roughness: f32) -> f32 {
    let alpha = (roughness * roughness).max(1e-3);
    (0.5 / (alpha * alpha) - 0.5).clamp(1.0, EXPONENT_CAP)
}

/// What has been seen of a light so far.
#[derive(Clone, Copy)]
struct Sum {
    /// The form factor times −2π.
    diffuse: f32,
    /// The lobe's integral.
    lobe: f32,
    /// Where the outline leaves the surface's upper side and where it comes back.
    horizon: [Vec3; 2],
    /// The same for the lobe's upper side.
    lobe_horizon: [Vec3; 2],
}

/// The surface's normal and the lobe.
#[derive(Clone, Copy)]
struct Axes {
    normal: Vec3,
    mirror: Vec3,
    exponent: f32,
}

/// (diffuse, specular, fresnel) by a Phong lobe around the mirror direction with the albedo of GGX. Schlick's part is a
/// constant share.
pub fn phong_value(table: &Table, input: &Input) -> [f32; 3] {
    let (_, [albedo, fresnel, ..]) = published_lobe(table, input);
    let [diffuse, lobe] = phong_integrals(input, phong_exponent(input.roughness));
    [diffuse, albedo * lobe, fresnel * lobe]
}

/// The exact form factor of a convex quad, and ∫ (n + 1) / 2π · (r·l)ⁿ over the part of it above both the surface's and the
/// lobe's horizon, for the mirror direction r and the exponent n ≥ 1.
pub fn phong_integrals(input: &Input, exponent: f32) -> [f32; 2] {
    let normal = input.normal;
    let mirror = normal * (2.0 * normal.dot(input.view)) - input.view;
    let axes = Axes { normal, mirror, exponent };
    let none = [Vec3::ZERO; 2];
    let mut sum = Sum { diffuse: 0.0, lobe: 0.0, horizon: none, lobe_horizon: none };
    let corners = input.corners.map(|v| v - input.position);
    for i in 0..4 {
        side(&mut sum, axes, corners[i], corners[(i + 1) % 4]);
    }
    // The outline closes along the two horizons; along the lobe's one only the power 0 adds anything.
    let [leave, enter] = sum.horizon;
    arc(&mut sum, axes, leave, enter);
    let [leave, enter] = sum.lobe_horizon;
    sum.lobe -= 0.5 * FRAC_1_PI * mirror.dot(edge(leave, enter));
    [(-0.5 * FRAC_1_PI * sum.diffuse).max(0.0), sum.lobe.max(0.0)]
}

/// Where the way from `above` a plane to `below` it meets it, from the two heights.
fn crossing(above: Vec3, high: f32, below: Vec3, low: f32) -> Vec3 {
    below * high - above * low
}

/// Adds the part of a side of the polygon above the surface's horizon.
fn side(sum: &mut Sum, axes: Axes, from: Vec3, to: Vec3) {
    let (a, b) = (axes.normal.dot(from), axes.normal.dot(to));
    let (mut start, mut end) = (from, to);
    if a <= 0.0 && b <= 0.0 {
        return;
    }
    if b <= 0.0 {
        end = crossing(from, a, to, b);
        sum.horizon[0] = end;
    }
    if a <= 0.0 {
        start = crossing(to, b, from, a);
        sum.horizon[1] = start;
    }
    arc(sum, axes, start, end);
}

/// Adds an arc above the surface's horizon.
fn arc(sum: &mut Sum, axes: Axes, from: Vec3, to: Vec3) {
    sum.diffuse += axes.normal.dot(edge(from, to));
    let (a, b) = (axes.mirror.dot(from), axes.mirror.dot(to));
    let (mut start, mut end) = (from, to);
    if a <= 0.0 && b <= 0.0 {
        return;
    }
    if b <= 0.0 {
        end = crossing(from, a, to, b);
        sum.lobe_horizon[0] = end;
    }
    if a <= 0.0 {
        start = crossing(to, b, from, a);
        sum.lobe_horizon[1] = start;
    }
    sum.lobe += phong_moment(axes.mirror, start, end, axes.exponent);
}

/// The angle of two vectors along the unit normal of their plane; zero for zero vectors.
fn edge(a: Vec3, b: Vec3) -> Vec3 {
    let product = a.cross(b);
    let length = product.dot(product).sqrt();
    product * (length.atan2(a.dot(b)) / length.max(1e-30))
}

/// What the arc between the directions of `from` and `to`, on the upper side of `axis`, adds to the integral of
/// (n + 1) / 2π · (axis·u)ⁿ over a polygon whose vertices run counter-clockwise seen from behind the polygon.
///
/// Arvo (1995, section 4): (n + 1)·τₙ = (n − 1)·τₙ₋₂ − Σ (axis·normal) ∫ (axis·u)ⁿ⁻¹ ds over the arcs. Odd moments start from
/// the form factor and need no solid angle; so the normalised one is −Σ (axis·normal) / 2π times the sum of the integrals of
/// the even powers below n, each of which follows by parts from the one before. What lies between two odd exponents is
/// interpolated.
pub fn phong_moment(axis: Vec3, from: Vec3, to: Vec3, exponent: f32) -> f32 {
    let normal = from.cross(to);
    let length = normal.dot(normal).sqrt();
    let angle = length.atan2(from.dot(to));
    let normal = normal * (1.0 / length.max(1e-30));
    let start = from * (1.0 / from.dot(from).max(1e-30).sqrt());
    let end = to * (1.0 / to.dot(to).max(1e-30).sqrt());
    let tilt = axis.dot(normal);
    let (at_start, at_end) = (axis.dot(start), axis.dot(end));
    let (slope_start, slope_end) = (axis.dot(normal.cross(start)), axis.dot(normal.cross(end)));
    // Square of the largest cosine on the arc's circle.
    let largest = (1.0 - tilt * tilt).max(0.0);
    let (square_start, square_end) = (at_start * at_start, at_end * at_end);
    let (mut boundary_start, mut boundary_end) = (at_start * slope_start, at_end * slope_end);

    let steps = (0.5 * (exponent - 1.0)).floor();
    let mut integral = angle;
    let mut sum = angle;
    let mut power = 2.0;
    while power <= 2.0 * steps {
        integral = ((power - 1.0) * largest * integral + boundary_start - boundary_end) * (1.0 / power);
        sum += integral;
        boundary_start *= square_start;
        boundary_end *= square_end;
        power += 2.0;
    }
    integral = ((power - 1.0) * largest * integral + boundary_start - boundary_end) * (1.0 / power);
    sum += (0.5 * (exponent - 1.0) - steps) * integral;
    -0.5 * FRAC_1_PI * tilt * sum
}
