//! What the published forms would be worth in exact arithmetic: the same lobes and lights, integrated in f64 by formulas that
//! hold in the limits.

use core::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};

use super::published::{clipped, with_frame};
use super::round::{Ellipse, horizon_share};
use super::setting::Setting;
use crate::table::Table;

/// The published lobe of a surface in its true frame; along the normal any tangent will do.
pub(super) fn lobe(table: &Table, setting: &Setting) -> ([DVec3; 3], [f64; 2]) {
    let [tangent, bitangent, normal] = frame(setting);
    let cosine = setting.cosine().clamp(0.0, 1.0);
    with_frame::<f64>(table, setting, cosine, [tangent, bitangent, normal])
}

/// Tangent towards the view, bitangent and normal.
pub(super) fn frame(setting: &Setting) -> [DVec3; 3] {
    let normal = setting.normal.normalize();
    let aside = setting.view.reject_from_normalized(normal);
    let tangent = aside.try_normalize().filter(|_| aside.length() > 1e-12 * setting.view.length());
    let tangent = tangent.unwrap_or_else(|| normal.any_orthonormal_vector());
    [tangent, normal.cross(tangent), normal]
}

/// The form factor of a polygon over the horizon of the space that `rows` lead to. The angles of edges come from sines and
/// cosines together, and cross products from the edges themselves.
pub(super) fn form_factor(rows: [DVec3; 3], setting: &Setting, vertices: &[DVec3]) -> f64 {
    let to_lobe = DMat3::from_cols(rows[0], rows[1], rows[2]).transpose();
    let moved: Vec<DVec3> = vertices.iter().map(|v| to_lobe * (*v - setting.position)).collect();
    let vertices = clipped::<f64>(&moved);
    let edges = vertices.iter().enumerate().map(|(index, a)| {
        let a = a.normalize();
        let b = vertices[(index + 1) % vertices.len()].normalize();
        let normal = a.cross(b - a);
        let sine = normal.length();
        if sine > 0.0 { normal.z / sine * sine.atan2(a.dot(b)) } else { 0.0 }
    });
    let signed = -edges.sum::<f64>() / TAU;
    if setting.is_two_sided() { signed.abs() } else { signed.max(0.0) }
}

/// The form factor of an elliptic light by the published formula: that of its cone, times the share that the table leaves of a
/// sphere of the same vector form factor. The axes of the cone come from rotations (Jacobi 1846), whatever their lengths.
pub(super) fn elliptic(table: &Table, ellipse: &Ellipse<f64>) -> f64 {
    let [first, second, third] = ellipse.axes;
    let centre = ellipse.centre;
    let distance = third.dot(centre);
    let [x, y] = [first.dot(centre) / distance, second.dot(centre) / distance];
    let [a, b] = ellipse.half_lengths.map(|length| (distance / length).powi(2));
    let mut matrix = [[a, 0.0, -a * x], [0.0, b, -b * y], [-a * x, -b * y, a * x * x + b * y * y - 1.0]];
    let mut vectors = DMat3::IDENTITY.to_cols_array_2d();
    for _ in 0..64 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            rotate(&mut matrix, &mut vectors, p, q);
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|i, j| matrix[*i][*i].total_cmp(&matrix[*j][*j]));
    let values = order.map(|i| matrix[i][i]);
    let widths = [-values[0] / values[1], -values[0] / values[2]];
    let size = (widths[0] / (1.0 + widths[0]) * widths[1] / (1.0 + widths[1])).sqrt();
    let axis = vectors[order[0]];
    let axis = first * axis[0] + second * axis[1] + third * axis[2];
    let axis = if axis.dot(centre) < 0.0 { -axis } else { axis };
    size * horizon_share(table, axis.z, size)
}

/// Turns the plane of two axes so that their product vanishes; `vectors` are the axes so far.
fn rotate(matrix: &mut [[f64; 3]; 3], vectors: &mut [[f64; 3]; 3], p: usize, q: usize) {
    if matrix[p][q] == 0.0 {
        return;
    }
    let slope = (matrix[q][q] - matrix[p][p]) / (2.0 * matrix[p][q]);
    let tangent = slope.signum() / (slope.abs() + (1.0 + slope * slope).sqrt());
    let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
    let sine = tangent * cosine;
    for k in 0..3 {
        let (at, to) = (matrix[k][p], matrix[k][q]);
        (matrix[k][p], matrix[k][q]) = (cosine * at - sine * to, sine * at + cosine * to);
    }
    for k in 0..3 {
        let (at, to) = (matrix[p][k], matrix[q][k]);
        (matrix[p][k], matrix[q][k]) = (cosine * at - sine * to, sine * at + cosine * to);
        let (at, to) = (vectors[p][k], vectors[q][k]);
        (vectors[p][k], vectors[q][k]) = (cosine * at - sine * to, sine * at + cosine * to);
    }
}

/// The form factor of the line from `start` to `end` of unit width, seen from the origin: integrated over the angle along the
/// line, in which it is a polynomial of sine and cosine.
pub(super) fn line(start: DVec3, end: DVec3) -> f64 {
    let side = end - start;
    let axis = side.try_normalize().unwrap_or(DVec3::ZERO);
    let foot = start.reject_from_normalized(axis);
    let distance = foot.length();
    if axis == DVec3::ZERO || distance == 0.0 {
        return 0.0;
    }
    let angle = |v: DVec3| v.dot(axis).atan2(distance);
    let (low, high) = (angle(start), angle(end));
    // ∫ cos φ (cos φ · foot + sin φ · axis) dφ over the distance, for the line's width shrinks with its obliquity.
    let turned = |angle: f64| 0.5 * (angle + angle.sin() * angle.cos());
    let raised = |angle: f64| 0.5 * angle.sin().powi(2);
    ((turned(high) - turned(low)) * foot.z / distance + (raised(high) - raised(low)) * axis.z)
        / (distance * PI)
}
