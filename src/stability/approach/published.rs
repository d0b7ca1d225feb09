//! Linearly transformed cosines as published, in any precision and without guards beyond the published ones.
//!
//! [`crate::report::compare`] has the technique as a shader that is to be timed; this is its mathematics, so that what
//! rounding makes of it can be told from what it is.

use super::precision::{Precision, normalize, vector};
use super::setting::Setting;
use crate::shade::{Real, Vector};
use crate::table::Table;

/// How the integral along an edge is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgeForm {
    /// The angle between both ends by its arc cosine, along the unit normal of their plane: as printed in Heitz, Dupuy,
    /// Hill and Neubelt (2016, "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines").
    Printed,
    /// The ratio of the angle to its sine as a rational function of the cosine, with a floor below the squared sine: Hill and
    /// Heitz (2016, "Real-Time Area Lighting: a Journey from Research to Production").
    Fitted,
}

/// A lobe in the published layout: the rows of the inverse matrix, its albedo and its Schlick part.
pub(super) type PublishedLobe<R> = ([<R as Real>::Vec3; 3], [R; 2]);

/// The published lobe of a surface, with the tangent as published: the view's part across the normal over its length,
/// whatever that is.
pub(super) fn lobe<R: Precision>(table: &Table, setting: &Setting) -> PublishedLobe<R> {
    let (normal, view) = (vector::<R>(setting.normal), vector::<R>(setting.view));
    let cosine = normal.dot(view).clamp(R::new(0.0), R::new(1.0));
    let tangent = normalize::<R>(view - normal * normal.dot(view));
    with_frame(table, setting, cosine, [tangent, normal.cross(tangent), normal])
}

/// The lobe of the table for a frame (tangent, bitangent, normal) in which the view has a cosine.
pub(super) fn with_frame<R: Precision>(
    table: &Table,
    setting: &Setting,
    cosine: R,
    [tangent, bitangent, normal]: [R::Vec3; 3],
) -> PublishedLobe<R> {
    let at = place(table, [R::new(setting.roughness), (R::new(1.0) - cosine).sqrt()]);
    let [x, y, z, w] = table.sample::<R>(0, at.into()).into();
    let [albedo, fresnel, ..] = table.sample::<R>(1, at.into()).into();
    let rows = [tangent * x + normal * z, bitangent, tangent * y + normal * w];
    (rows, [albedo, fresnel])
}

/// Texture coordinates for coordinates in 0…1 between the centres of the first and the last texel.
pub(super) fn place<R: Real>(table: &Table, coordinates: [R; 2]) -> [R; 2] {
    let size = table.size() as f64;
    coordinates.map(|c| c * R::new((size - 1.0) / size) + R::new(0.5 / size))
}

/// The frame of a surface without a lobe.
pub(super) fn plain_frame<R: Precision>(setting: &Setting) -> [R::Vec3; 3] {
    let (normal, view) = (vector::<R>(setting.normal), vector::<R>(setting.view));
    let tangent = normalize::<R>(view - normal * normal.dot(view));
    [tangent, normal.cross(tangent), normal]
}

pub(super) fn transform<R: Real>(rows: [R::Vec3; 3], v: R::Vec3) -> R::Vec3 {
    R::Vec3::new(rows[0].dot(v), rows[1].dot(v), rows[2].dot(v))
}

/// The part of a polygon above the plane z = 0, edge by edge.
pub(super) fn clipped<R: Real>(vertices: &[R::Vec3]) -> Vec<R::Vec3> {
    let zero = R::new(0.0);
    let mut kept = Vec::with_capacity(vertices.len() + 1);
    for (index, &a) in vertices.iter().enumerate() {
        let b = vertices[(index + 1) % vertices.len()];
        if a.z() > zero {
            kept.push(a);
        }
        if (a.z() > zero) != (b.z() > zero) {
            let (above, below) = if a.z() > zero { (a, b) } else { (b, a) };
            kept.push(below * above.z() - above * below.z());
        }
    }
    kept
}

/// The height of the edge integral of two unit vectors over 2π.
pub(super) fn edge<R: Precision>(form: EdgeForm, a: R::Vec3, b: R::Vec3) -> R {
    let cosine = a.dot(b);
    let normal = a.cross(b);
    match form {
        EdgeForm::Printed => {
            normalize::<R>(normal).z() * cosine.acos() * R::new(0.5 * core::f64::consts::FRAC_1_PI)
        }
        EdgeForm::Fitted => {
            // The coefficients are those of `crate::fit::fit_published_angle`.
            let y = cosine.abs();
            let numerator = R::new(0.863_855_5) + (R::new(0.498_149_1) + R::new(0.014_316_3) * y) * y;
            let acute = numerator / (R::new(3.455_423_7) + (R::new(4.192_250_5) + y) * y);
            let ratio = if cosine > R::new(0.0) {
                acute
            } else {
                R::new(0.5) * (R::new(1.0) - y * y).max(R::new(1e-7)).inverse_sqrt() - acute
            };
            normal.z() * ratio
        }
    }
}

/// The form factor of a polygon over the horizon of the space that `rows` lead to.
pub(super) fn form_factor<R: Precision>(
    form: EdgeForm,
    rows: [R::Vec3; 3],
    setting: &Setting,
    vertices: &[glam::DVec3],
) -> R {
    let position = vector::<R>(setting.position);
    let moved: Vec<R::Vec3> =
        vertices.iter().map(|v| transform::<R>(rows, vector::<R>(*v) - position)).collect();
    let units: Vec<R::Vec3> = clipped::<R>(&moved).into_iter().map(normalize::<R>).collect();
    let mut sum = R::new(0.0);
    for (index, &a) in units.iter().enumerate() {
        sum += edge::<R>(form, a, units[(index + 1) % units.len()]);
    }
    // The comparison keeps what is not a number, which the `max` of a shading language may or may not do.
    if -sum < R::new(0.0) { if setting.is_two_sided() { sum } else { R::new(0.0) } } else { -sum }
}
