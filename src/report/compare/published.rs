//! Linearly transformed cosines as published.

use glam::{Vec2, Vec3};

use super::{Input, comparator, published_table};
use crate::report::data::MethodInfo;
use crate::report::measure::Quad;
use crate::report::method::Method;
use crate::table::Table;

/// Linearly transformed cosines with exact clipping (Heitz, Dupuy, Hill and Neubelt 2016, "Real-Time Polygonal-Light
/// Shading with Linearly Transformed Cosines").
#[derive(Clone, Debug, PartialEq)]
pub struct Published(Table);

/// Linearly transformed cosines with a sphere in place of the light at the horizon (Hill and Heitz 2016, "Real-Time Area
/// Lighting: a Journey from Research to Production").
#[derive(Clone, Debug, PartialEq)]
pub struct Proxy(Table);

impl Published {
    /// With another table in the published layout.
    pub fn with(table: Table) -> Self {
        Self(table)
    }
}

impl Proxy {
    /// With another table in the published layout.
    pub fn with(table: Table) -> Self {
        Self(table)
    }
}

impl Default for Published {
    fn default() -> Self {
        Self(published_table())
    }
}

impl Default for Proxy {
    fn default() -> Self {
        Self(published_table())
    }
}

impl Method for Published {
    fn info(&self) -> MethodInfo {
        comparator(
            "published",
            "LTC as published",
            "Linearly transformed cosines (Heitz, Dupuy, Hill and Neubelt 2016): lobes of three parameters fitted by the \
             cubed error, clipped exactly at the lobe's horizon, edge integrals by a rational function; Schlick's part is \
             a constant share.",
        )
    }

    fn value(&self, quad: &Quad) -> [f64; 3] {
        published_value(&self.0, &quad.into()).map(f64::from)
    }
}

impl Method for Proxy {
    fn info(&self) -> MethodInfo {
        comparator(
            "proxy",
            "LTC, sphere at the horizon",
            "The published lobes without clipping: the horizon cuts a sphere that has the light's vector form factor, by \
             a table (Hill and Heitz 2016).",
        )
    }

    fn value(&self, quad: &Quad) -> [f64; 3] {
        proxy_value(&self.0, &quad.into()).map(f64::from)
    }
}

/// The rows of the inverse matrix, from the caller's space, and (albedo, Schlick's part, 0, 0) of a lobe of the table.
pub fn published_lobe(table: &Table, input: &Input) -> ([Vec3; 3], [f32; 4]) {
    let cosine = input.normal.dot(input.view).clamp(0.0, 1.0);
    let at = place(table, Vec2::new(input.roughness, (1.0 - cosine).sqrt()));
    let [x, y, z, w] = table.sample::<f32>(0, at).into();
    let [tangent, bitangent, normal] = frame(input);
    let rows = [tangent * x + normal * z, bitangent, tangent * y + normal * w];
    (rows, table.sample::<f32>(1, at).into())
}

/// Texture coordinates for coordinates in 0…1 between the first and the last texel's centres.
fn place(table: &Table, coordinates: Vec2) -> Vec2 {
    let size = table.size() as f32;
    coordinates * ((size - 1.0) / size) + 0.5 / size
}

/// The tangent towards the view, the bitangent and the normal.
fn frame(input: &Input) -> [Vec3; 3] {
    let aside = input.view - input.normal * input.normal.dot(input.view);
    // Along the normal any tangent will do, but not none.
    let tangent = aside * (1.0 / aside.dot(aside).max(1e-12).sqrt());
    [tangent, input.normal.cross(tangent), input.normal]
}

/// The part of a quad above the plane z = 0: the number of its vertices, 0 or 3…5, and these, the first one repeated
/// behind the last. Vertices that are new have another length than those of the quad, but their direction.
///
/// One of sixteen cases by which vertices are above; opposite vertices alone cannot be.
pub fn published_clip([a, b, c, d]: [Vec3; 4]) -> (u32, [Vec3; 5]) {
    let cut = |above: Vec3, below: Vec3| below * above.z - above * below.z;
    let above = [a, b, c, d].map(|v| u32::from(v.z > 0.0));
    match above[0] + 2 * above[1] + 4 * above[2] + 8 * above[3] {
        1 => (3, [a, cut(a, b), cut(a, d), a, a]),
        2 => (3, [b, cut(b, c), cut(b, a), b, b]),
        3 => (4, [a, b, cut(b, c), cut(a, d), a]),
        4 => (3, [c, cut(c, d), cut(c, b), c, c]),
        6 => (4, [b, c, cut(c, d), cut(b, a), b]),
        7 => (5, [a, b, c, cut(c, d), cut(a, d)]),
        8 => (3, [d, cut(d, a), cut(d, c), d, d]),
        9 => (4, [d, a, cut(a, b), cut(d, c), d]),
        11 => (5, [d, a, b, cut(b, c), cut(d, c)]),
        12 => (4, [c, d, cut(d, a), cut(c, b), c]),
        13 => (5, [c, d, a, cut(a, b), cut(c, b)]),
        14 => (5, [b, c, d, cut(d, a), cut(b, a)]),
        15 => (4, [a, b, c, d, a]),
        _ => (0, [Vec3::ZERO; 5]),
    }
}

/// The edge integral over 2π of two unit vectors: their angle along the normal of their plane. The ratio of the angle to its
/// sine is a rational function of the cosine, fitted by [`crate::fit::fit_published_angle`].
pub fn published_edge(a: Vec3, b: Vec3) -> Vec3 {
    let cosine = a.dot(b);
    let y = cosine.abs();
    let acute = (0.863_855_5 + (0.498_149_1 + 0.014_316_3 * y) * y) / (3.455_423_7 + (4.192_250_5 + y) * y);
    // θ and π − θ have the same sine; the sum of both ratios is π over it.
    let ratio = if cosine > 0.0 { acute } else { 0.5 / (1.0 - y * y).max(1e-7).sqrt() - acute };
    a.cross(b) * ratio
}

/// The form factor of a quad over the horizon of the space that `rows` lead to.
fn form_factor(rows: [Vec3; 3], input: &Input) -> f32 {
    let (count, vertices) = published_clip(input.corners.map(|v| transform(rows, v - input.position)));
    if count == 0 {
        return 0.0;
    }
    let units = vertices.map(normalize);
    let edge = |i: usize| published_edge(units[i], units[(i + 1) % 5]).z;
    let mut sum = edge(0) + edge(1) + edge(2);
    if count > 3 {
        sum += edge(3);
    }
    if count > 4 {
        sum += edge(4);
    }
    (-sum).max(0.0)
}

fn transform(rows: [Vec3; 3], v: Vec3) -> Vec3 {
    Vec3::new(rows[0].dot(v), rows[1].dot(v), rows[2].dot(v))
}

fn normalize(v: Vec3) -> Vec3 {
    v * (1.0 / v.dot(v).sqrt())
}

/// (diffuse, specular, fresnel) by linearly transformed cosines as published: the light is clipped at the horizon of each
/// lobe, after the transformation.
pub fn published_value(table: &Table, input: &Input) -> [f32; 3] {
    let (rows, [albedo, fresnel, ..]) = published_lobe(table, input);
    let diffuse = form_factor(frame(input), input);
    let specular = form_factor(rows, input);
    [diffuse, albedo * specular, fresnel * specular]
}

/// The form factor over the horizon of the sphere that has the vector form factor of the whole quad (Snyder 1996, by a
/// table).
fn proxy_form_factor(table: &Table, rows: [Vec3; 3], input: &Input) -> f32 {
    let [a, b, c, d] = input.corners.map(|v| normalize(transform(rows, v - input.position)));
    let sum = published_edge(a, b) + published_edge(b, c) + published_edge(c, d) + published_edge(d, a);
    let length = sum.dot(sum).max(1e-30).sqrt();
    let at = place(table, Vec2::new(0.5 - 0.5 * sum.z / length, length));
    let [_, _, _, share] = table.sample::<f32>(1, at).into();
    length * share
}

/// (diffuse, specular, fresnel) with a sphere in place of the light at each horizon.
pub fn proxy_value(table: &Table, input: &Input) -> [f32; 3] {
    let [a, b, _, d] = input.corners;
    if (b - a).cross(d - a).dot(a - input.position) >= 0.0 {
        return [0.0; 3];
    }
    let (rows, [albedo, fresnel, ..]) = published_lobe(table, input);
    let diffuse = proxy_form_factor(table, frame(input), input);
    let specular = proxy_form_factor(table, rows, input);
    [diffuse, albedo * specular, fresnel * specular]
}
