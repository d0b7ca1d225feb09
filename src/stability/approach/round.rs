//! The published formulas for disks and lines (Heitz and Hill 2017, "Real-Time Line- and Disk-Light Shading with Linearly
//! Transformed Cosines").

use super::precision::{Precision, normalize, vector};
use super::published::{place, transform};
use super::setting::Setting;
use crate::light::Light;
use crate::shade::{Real, Vector};
use crate::table::Table;

/// An ellipse: its centre, and orthogonal unit vectors along its half-axes and its normal, which points away.
pub(super) struct Ellipse<R: Real> {
    pub axes: [R::Vec3; 3],
    pub half_lengths: [R; 2],
    pub centre: R::Vec3,
}

/// The share of the vector form factor of a sphere that its horizon leaves, by the table: for the cosine between its direction
/// and the normal, and its length.
pub(super) fn horizon_share<R: Precision>(table: &Table, cosine: R, length: R) -> R {
    let at = place(table, [cosine * R::new(0.5) + R::new(0.5), length]);
    let [_, _, _, share] = table.sample::<R>(1, at.into()).into();
    share
}

/// The light's ellipse in the space that `rows` lead to, if it faces the surface point. A sphere is the disk that hides the same
/// directions, for the formula knows nothing else.
pub(super) fn ellipse<R: Precision>(rows: [R::Vec3; 3], setting: &Setting) -> Option<Ellipse<R>> {
    let position = vector::<R>(setting.position);
    let (centre, half_x, half_y) = match &setting.light {
        Light::Disk { center, half_x, half_y, .. } => {
            (vector::<R>(*center) - position, vector::<R>(*half_x), vector::<R>(*half_y))
        }
        Light::Sphere { center, radius } => {
            hiding_disk::<R>(vector::<R>(*center) - position, R::new(*radius))
        }
        _ => panic!("{} lights are no ellipses", setting.light.shape()),
    };
    let (one, half) = (R::new(1.0), R::new(0.5));
    let centre = transform::<R>(rows, centre);
    let (x, y) = (transform::<R>(rows, half_x), transform::<R>(rows, half_y));
    let normal = normalize::<R>(x.cross(y));
    if normal.dot(centre) > R::new(0.0) {
        return None;
    }
    let away = -normal;
    let (xx, yy, xy) = (x.dot(x), y.dot(y), x.dot(y));
    // Vectors that a transformation left oblique are conjugate half-axes: the principal ones turn by the angle of the symmetric
    // matrix of their products.
    let oblique = xy.abs() > R::new(1e-4) * (xx * yy).sqrt();
    let (u, v) = if oblique {
        let turn = half * (R::new(2.0) * xy).atan2(xx - yy);
        let (cosine, sine) = (turn.cos(), turn.sin());
        (x * cosine + y * sine, y * cosine - x * sine)
    } else {
        (x, y)
    };
    let lengths = [u.dot(u).sqrt(), v.dot(v).sqrt()];
    let axes = [u * (one / lengths[0]), v * (one / lengths[1]), away];
    Some(Ellipse { axes, half_lengths: lengths, centre })
}

/// The disk on whose rim the rays from the origin touch a sphere: centre and two half-axes, facing the origin.
fn hiding_disk<R: Precision>(centre: R::Vec3, radius: R) -> (R::Vec3, R::Vec3, R::Vec3) {
    let (zero, one) = (R::new(0.0), R::new(1.0));
    let squared = centre.dot(centre);
    let left = one - radius * radius / squared;
    let toward = normalize::<R>(centre);
    let helper = if toward.z().abs() < R::new(0.9) {
        R::Vec3::new(zero, zero, one)
    } else {
        R::Vec3::new(one, zero, zero)
    };
    let x = normalize::<R>(helper.cross(toward));
    let reach = radius * left.sqrt();
    // Their cross product points back.
    (centre * left, toward.cross(x) * reach, x * reach)
}

/// The form factor of an elliptic light: the roots of the cone's characteristic cubic give its axes.
pub(super) fn elliptic<R: Precision>(table: &Table, ellipse: &Ellipse<R>) -> R {
    let (one, two, three) = (R::new(1.0), R::new(2.0), R::new(3.0));
    let [first, second, away] = ellipse.axes;
    let distance = away.dot(ellipse.centre);
    let (x, y) = (first.dot(ellipse.centre) / distance, second.dot(ellipse.centre) / distance);
    let [a, b] = ellipse.half_lengths.map(|length| {
        let ratio = distance / length;
        ratio * ratio
    });
    // λ³ − trace λ² + minors λ − determinant, for the cone a(X − xZ)² + b(Y − yZ)² = Z².
    let trace = a * (one + x * x) + b * (one + y * y) - one;
    let minors = a * b * (one + x * x + y * y) - a - b;
    let determinant = -(a * b);
    let mean = trace / three;
    let p = mean * mean - minors / three;
    let q = mean * mean * mean - mean * minors / two + determinant / two;
    // Three real roots lie on a circle around the mean; its radius is real because a symmetric matrix has no others.
    let angle = (p * p * p - q * q).sqrt().atan2(q) / three;
    let third = R::new(core::f64::consts::TAU / 3.0);
    let root = |turns: R| mean + two * p.sqrt() * (angle + third * turns).cos();
    let (largest, lowest, middle) = (root(R::new(0.0)), root(one), root(two));
    let (wide, narrow) = (-lowest / middle, -lowest / largest);
    let size = (wide * narrow / ((one + wide) * (one + narrow))).sqrt();
    // The axis in the ellipse's frame: where two rows of the shifted matrix vanish.
    let local = [a * x / (a - lowest), b * y / (b - lowest)];
    let axis = normalize::<R>(first * local[0] + second * local[1] + away);
    size * horizon_share(table, axis.z(), size)
}

/// The form factor of a line light from `start` to `end`, seen from the origin, that is as wide as the diameter of a radius.
pub(super) fn line<R: Precision>(start: R::Vec3, end: R::Vec3, radius: R) -> R {
    let axis = normalize::<R>(end - start);
    let (from, to) = (start.dot(axis), end.dot(axis));
    let foot = start - axis * from;
    let distance = foot.dot(foot).sqrt();
    let squared = distance * distance;
    let across = |l: R| l / (distance * (squared + l * l)) + (l / distance).atan() / squared;
    let along = |l: R| l * l / (distance * (squared + l * l));
    let sum = (across(to) - across(from)) * foot.z() + (along(to) - along(from)) * axis.z();
    sum * radius * R::new(core::f64::consts::FRAC_1_PI)
}
