//! Elliptical disks and spheres.

use super::cone::{
    LtcCut, Together, ltc_cone, ltc_cone_across, ltc_cone_between, ltc_cone_outward, ltc_cone_part,
    ltc_cone_tilt, ltc_cut, ltc_cut_together,
};
use super::quad::{OVER_TWO_PI, ltc_angle_excess};
use super::real::{Real, Vector};
use super::several::{LobeSum, ltc_all_around, ltc_lobes_value, with_form_factor};
use super::surface::{
    LTC_HEADROOM, LTC_SMALLEST, LTC_TINY, LtcLobe, LtcSurface, ltc_extent, ltc_transform,
    ltc_transform_normal,
};

/// An elliptical disk, placed over a surface: what all lobes share of the work on it.
#[derive(Clone, Copy, Debug)]
pub struct LtcDisk<R: Real> {
    /// First semi-axis over `size`.
    half_x: R::Vec3,
    /// Second semi-axis over `size`; the two run counter-clockwise about the direction away from the surface.
    half_y: R::Vec3,
    /// Centre from the surface point, in units of the farthest coordinate.
    centre: R::Vec3,
    /// Cross product of the semi-axes over `size`.
    normal: R::Vec3,
    size: R,
    /// Scalar product of normal and centre.
    volume: R,
    /// The surface's horizon.
    cut: LtcCut<R>,
    reaches: bool,
}

/// A sphere, placed over a surface.
#[derive(Clone, Copy, Debug)]
pub struct LtcSphere<R: Real> {
    /// A disk that hides the same directions.
    disk: LtcDisk<R>,
    /// Whether the surface point is in the sphere.
    inside: bool,
}

/// Places an elliptical disk over a surface; see [`ltc_disk`].
pub fn ltc_disk_begin<R: Real>(
    surface: &LtcSurface<R>,
    centre: R::Vec3,
    half_x: R::Vec3,
    half_y: R::Vec3,
    two_sided: bool,
) -> LtcDisk<R> {
    let (zero, one, headroom, tiny) = (R::new(0.0), R::new(1.0), R::new(LTC_HEADROOM), R::new(LTC_TINY));
    let away = centre * headroom - surface.position * headroom;
    let (x, y) = (half_x * headroom, half_y * headroom);
    let width = ltc_extent::<R>(x).max(ltc_extent::<R>(y));
    let scale = one / ltc_extent::<R>(away).max(width).max(tiny);
    let shrink = one / width.max(tiny);
    let (x, y) = (x * shrink, y * shrink);
    let centre = away * scale;
    let normal = x.cross(y);
    let volume = normal.dot(centre);
    let front = volume < zero;
    let (half_x, half_y) = if front { (y, x) } else { (x, y) };
    let size = (width * scale).min(R::new(1.0));
    let cut = ltc_cut::<R>(surface.normal, half_x, half_y, size, centre);
    // As in the include: in single precision an ellipse more slender than 1e18 has no plane.
    let is_line = normal.dot(normal) <= tiny;
    LtcDisk {
        half_x,
        half_y,
        centre,
        normal: if front { -normal } else { normal },
        size,
        volume: volume.abs(),
        cut,
        reaches: (front | (two_sided & (volume > zero))) & (cut.offset < one) & !is_line,
    }
}

/// The form factor of a disk, 0…1.
pub fn ltc_disk_diffuse<R: Real>(disk: &LtcDisk<R>) -> R {
    let (zero, one) = (R::new(0.0), R::new(1.0));
    if !disk.reaches {
        return zero;
    }
    let cone = ltc_cone::<R>(disk.half_x, disk.half_y, disk.size, disk.centre, disk.normal, disk.volume);
    let value = if disk.cut.offset > -one {
        ltc_cone_part(&cone, &ltc_cone_across(&cone), &disk.cut).1 * R::new(OVER_TWO_PI)
    } else {
        cone.whole * ltc_cone_tilt(&cone, &disk.cut)
    };
    value.clamp(zero, one)
}

/// The vector form factor of a disk in a lobe's space, cut at both horizons, towards the light.
pub fn ltc_disk_lobe<R: Real>(disk: &LtcDisk<R>, lobe: &LtcLobe<R>) -> R::Vec3 {
    let (zero, one, tiny) = (R::new(0.0), R::new(1.0), R::new(LTC_TINY));
    let nothing = R::Vec3::new(zero, zero, zero);
    if !disk.reaches {
        return nothing;
    }
    let half_x = ltc_transform(lobe, disk.half_x);
    let half_y = ltc_transform(lobe, disk.half_y);
    let centre = ltc_transform(lobe, disk.centre);
    let own = ltc_cut::<R>(R::Vec3::new(zero, zero, one), half_x, half_y, disk.size, centre);
    if own.offset >= one {
        return nothing;
    }
    let normal = ltc_transform_normal(lobe, disk.normal);
    let volume = lobe.axis_x.dot(lobe.normal_x);
    let cone = ltc_cone::<R>(half_x, half_y, disk.size, centre, normal, volume * disk.volume);
    let surface_cuts = disk.cut.offset > -one;
    let own_cuts = own.offset > -one;
    if !(surface_cuts | own_cuts) {
        return upward::<R>(ltc_cone_outward(&cone, cone.axis) * cone.whole);
    }
    let horizon = ltc_transform_normal(lobe, disk.cut.normal);
    let square = horizon.dot(horizon);
    let inverse = square.max(tiny).inverse_sqrt();
    let stretch = volume * inverse;
    let surface = LtcCut {
        normal: horizon * inverse,
        height: disk.cut.height * stretch,
        steepness: disk.cut.steepness * stretch,
        moment: disk.cut.moment * (square * inverse),
        ..disk.cut
    };
    let together = match (surface_cuts, own_cuts) {
        (true, true) => ltc_cut_together(&surface, &own),
        (true, false) => Together::First,
        _ => Together::Second,
    };
    let across = ltc_cone_across(&cone);
    let part = |cut: &LtcCut<R>| ltc_cone_part(&cone, &across, cut).0;
    let sum = match together {
        Together::Nothing => nothing,
        Together::First => part(&surface),
        Together::Second => part(&own),
        // What neither cuts off is what each leaves, together, less the whole.
        Together::Apart => {
            let whole = ltc_cone_outward(&cone, cone.axis) * (cone.whole * R::new(core::f64::consts::TAU));
            part(&surface) + part(&own) - whole
        }
        Together::Crossing => ltc_cone_between(&cone, &across, &surface, &own),
    };
    upward::<R>(sum * R::new(OVER_TWO_PI))
}

/// `v` without what rounding puts below the horizon.
fn upward<R: Real>(v: R::Vec3) -> R::Vec3 {
    R::Vec3::new(v.x(), v.y(), v.z().max(R::new(0.0)))
}

/// The value (diffuse, specular, fresnel) of an elliptical disk light; see the include for its domain and its
/// error.
pub fn ltc_disk<R: Real>(
    surface: &LtcSurface<R>,
    lobes: &impl LobeSum<R>,
    centre: R::Vec3,
    half_x: R::Vec3,
    half_y: R::Vec3,
    two_sided: bool,
) -> R::Vec3 {
    let disk = ltc_disk_begin(surface, centre, half_x, half_y, two_sided);
    if !disk.reaches {
        return R::Vec3::new(R::new(0.0), R::new(0.0), R::new(0.0));
    }
    let specular = ltc_lobes_value(surface, lobes, |lobe| ltc_disk_lobe(&disk, lobe));
    with_form_factor(ltc_disk_diffuse(&disk), specular)
}

/// Places a sphere over a surface; see [`ltc_sphere`].
pub fn ltc_sphere_begin<R: Real>(surface: &LtcSurface<R>, centre: R::Vec3, radius: R) -> LtcSphere<R> {
    let (zero, one, headroom, tiny) = (R::new(0.0), R::new(1.0), R::new(LTC_HEADROOM), R::new(LTC_TINY));
    let away = centre * headroom - surface.position * headroom;
    let reach = radius.abs() * headroom;
    let scale = one / ltc_extent::<R>(away).max(reach).max(R::new(LTC_SMALLEST));
    let (away, reach) = (away * scale, reach * scale);
    let square = away.dot(away);
    let inverse = square.max(tiny).inverse_sqrt();
    let distance = square * inverse;
    let inside = reach >= distance;
    let w = away * inverse;
    let sine = (reach * inverse).min(one);
    let cosine_square = (distance - reach).max(zero) * (distance + reach);
    let cosine = cosine_square * cosine_square.max(tiny).inverse_sqrt() * inverse;
    let side = if w.z() >= zero { one } else { -one };
    let p = -one / (side + w.z());
    let q = w.x() * w.y() * p;
    let half_x = R::Vec3::new(one + side * w.x() * w.x() * p, side * q, -side * w.x());
    let half_y = R::Vec3::new(q, side + w.y() * w.y() * p, -w.y());
    let centre = w * cosine;
    let cut = ltc_cut::<R>(surface.normal, half_x, half_y, sine, centre);
    let disk = LtcDisk {
        half_x,
        half_y,
        centre,
        normal: w,
        size: sine,
        volume: cosine,
        cut,
        reaches: (inside | ((cut.offset < one) & (cosine > zero))) & (reach > zero),
    };
    LtcSphere { disk, inside: inside & disk.reaches }
}

/// The form factor of a sphere, 0…1.
pub fn ltc_sphere_diffuse<R: Real>(sphere: &LtcSphere<R>) -> R {
    let (zero, one, two) = (R::new(0.0), R::new(1.0), R::new(2.0));
    let pi = R::new(core::f64::consts::PI);
    let disk = &sphere.disk;
    if sphere.inside {
        return one;
    }
    if !disk.reaches {
        return zero;
    }
    let tilt = disk.cut.normal.dot(disk.normal);
    let whole = disk.size * disk.size;
    if disk.cut.offset <= -one {
        return (whole * tilt).clamp(zero, one);
    }
    let half_chord = disk.size * disk.cut.reach;
    let k = two * half_chord * half_chord;
    let rest = (one - half_chord * half_chord).max(zero);
    let sine = two * half_chord * (rest * rest.max(R::new(LTC_TINY)).inverse_sqrt());
    let excess = sine * ltc_angle_excess(k.min(two - k));
    let turn_less_sine = if k > one { pi - excess - two * sine } else { excess };
    let around = two * disk.cut.reach * disk.cut.reach;
    let lesser = two * disk.cut.reach * disk.cut.offset.abs();
    let acute = lesser + lesser * ltc_angle_excess(around.min(two - around).max(zero));
    let part = if around > one { pi - acute } else { acute };
    let angle = if tilt < zero { part } else { two * pi - part };
    let sum = turn_less_sine + tilt * (sine * tilt + whole * angle);
    (sum * R::new(OVER_TWO_PI)).clamp(zero, one)
}

/// The vector form factor of a sphere in a lobe's space, cut at both horizons, towards the light.
pub fn ltc_sphere_lobe<R: Real>(sphere: &LtcSphere<R>, lobe: &LtcLobe<R>) -> R::Vec3 {
    if sphere.inside {
        let around: R::Vec3 = ltc_all_around(lobe);
        return R::Vec3::new(around.x(), around.y(), lobe.share);
    }
    ltc_disk_lobe(&sphere.disk, lobe)
}

/// The value (diffuse, specular, fresnel) of a sphere light; see the include for its domain and its error.
pub fn ltc_sphere<R: Real>(
    surface: &LtcSurface<R>,
    lobes: &impl LobeSum<R>,
    centre: R::Vec3,
    radius: R,
) -> R::Vec3 {
    let sphere = ltc_sphere_begin(surface, centre, radius);
    if !sphere.disk.reaches {
        return R::Vec3::new(R::new(0.0), R::new(0.0), R::new(0.0));
    }
    let specular = ltc_lobes_value(surface, lobes, |lobe| ltc_sphere_lobe(&sphere, lobe));
    with_form_factor(ltc_sphere_diffuse(&sphere), specular)
}
