//! Tubes: thin cylinders, open or with rounded ends.

use super::quad::ltc_angle_excess;
use super::real::{Real, Vector};
use super::several::{LobeSum, ltc_lobes_value, with_form_factor};
use super::surface::{
    LTC_HEADROOM, LTC_SMALLEST, LTC_TINY, LTC_TUBE_TINY, LtcLobe, LtcSurface, ltc_direction, ltc_extent,
    ltc_transform, ltc_transform_normal,
};

/// A tube as all lobes share it: relative to the surface point, scaled, and cut at the surface's horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LtcTube<R: Real> {
    /// One end of what is left of the axis, moved to where the rim is seen.
    pub start: R::Vec3,
    /// Length of what is left.
    pub remaining_length: R,
    /// Its other end.
    pub end: R::Vec3,
    /// Distance of the moved axis.
    pub axis_distance: R,
    /// Direction from `start` to `end`; zero for a tube of no length.
    pub axis: R::Vec3,
    /// Sine of half the angle under which the tube's width is seen, 0…1.
    pub sine: R,
    /// Normal of the plane through axis and surface point; shorter than 1 where the point is inside the tube.
    pub across: R::Vec3,
    /// Share of the width that is above the surface's horizon; 0 if all of the axis is below.
    pub share: R,
    /// Towards the cap at the start, as long as the sine of half the angle under which it is seen.
    pub start_cap: R::Vec3,
    /// Share of that cap that is seen, 0…1.
    pub start_weight: R,
    /// Towards the cap at the end.
    pub end_cap: R::Vec3,
    /// Share of that cap that is seen.
    pub end_weight: R,
}

/// Square root of a number that is not negative; 0 below 1e-30.
pub fn ltc_root<R: Real>(x: R) -> R {
    x * x.max(R::new(1e-30)).inverse_sqrt()
}

fn saturate<R: Real>(x: R) -> R {
    x.clamp(R::new(0.0), R::new(1.0))
}

/// The vector form factor of a line of constant width from `a` to `b`, over the sine of half the angle under
/// which that width is seen at its `foot`, the direction of its closest point, at the given distance.
pub fn ltc_tube_line<R: Real>(a: R::Vec3, b: R::Vec3, foot: R::Vec3, distance: R, length: R) -> R::Vec3 {
    let (zero, one, two, half) = (R::new(0.0), R::new(1.0), R::new(2.0), R::new(0.5));
    let tiny: R = R::new(LTC_TINY);
    let hidden = (one - foot.dot(foot)).max(zero);
    let inside = hidden * distance * distance;
    let a_inverse = (a.dot(a) + inside).max(tiny).inverse_sqrt();
    let b_inverse = (b.dot(b) + inside).max(tiny).inverse_sqrt();
    let (a_unit, b_unit) = (a * a_inverse, b * b_inverse);
    let (a_cosine, b_cosine) = ((distance * a_inverse).min(one), (distance * b_inverse).min(one));
    // As if no farther than its ends, whichever is named first: a line that the horizon has moved may be nearer than that.
    let sine = length * (a_inverse * b_cosine).min(b_inverse * a_cosine);
    let chord = b_unit - a_unit;
    let change = b_cosine - a_cosine;
    let k = half * (chord.dot(chord) + hidden * change * change);
    let cosine = one - k;
    let agreed = (sine * sine + cosine * cosine).max(tiny).inverse_sqrt();
    let sine = sine * agreed;
    let k = k + (one - cosine * agreed - k) * k.min(one);
    let excess = ltc_angle_excess(k.min((two - k).max(zero)));
    // The angle between the ends less the product of its sine and cosine.
    let bulge = if k > one {
        R::new(core::f64::consts::PI) - sine * (two + excess - k.min(two))
    } else {
        sine * (excess + k)
    };
    ((a_unit * b_cosine + b_unit * a_cosine) * sine + foot * bulge) * R::new(core::f64::consts::FRAC_1_PI)
}

/// Share of what reaches from `height` − `rise` to `height` + `rise` that is above 0.
pub fn ltc_tube_share<R: Real>(height: R, rise: R) -> R {
    let half: R = R::new(0.5);
    saturate(half + half * height / rise.max(height.abs()).max(R::new(LTC_TINY)))
}

/// Towards a cap around `center` and the share of it that is seen; see the include.
pub fn ltc_tube_cap_begin<R: Real>(
    surface: &LtcSurface<R>,
    center: R::Vec3,
    inverse_distance: R,
    outward: R::Vec3,
    radius: R,
    reach: R,
    turned: R,
) -> (R::Vec3, R) {
    let (one, half) = (R::new(1.0), R::new(0.5));
    let toward = center * inverse_distance;
    let aside = outward - toward * toward.dot(outward);
    let area_center: R = R::new(4.0 / (3.0 * core::f64::consts::PI));
    let middle = center + aside * (area_center * reach * (one - turned));
    let seen = ltc_tube_share(surface.normal.dot(middle), radius);
    let lifted = ltc_direction::<R>(middle + surface.normal * (radius * (one - seen)));
    (lifted * (radius * inverse_distance).min(one), (half + half * turned) * seen)
}

/// What all lobes share of a tube; see the include.
pub fn ltc_tube_begin<R: Real>(
    surface: &LtcSurface<R>,
    start: R::Vec3,
    end: R::Vec3,
    radius: R,
    caps: bool,
) -> LtcTube<R> {
    let (zero, one) = (R::new(0.0), R::new(1.0));
    let tiny: R = R::new(LTC_TINY);
    let headroom: R = R::new(LTC_HEADROOM);
    let origin = surface.position * headroom;
    let a_full = start * headroom - origin;
    let b_full = end * headroom - origin;
    let radius_full = radius.abs() * headroom;
    let extent = ltc_extent::<R>(a_full).max(ltc_extent::<R>(b_full)).max(radius_full);
    let scale = one / extent.max(R::new(LTC_SMALLEST));
    let side = (end * headroom - start * headroom) * scale;
    let (p_a, p_b, r) = (a_full * scale, b_full * scale, radius_full * scale);
    let axis = side * side.dot(side).max(R::new(1e-36)).inverse_sqrt();
    let length = axis.dot(side);
    let (a_squared, b_squared) = (p_a.dot(p_a), p_b.dot(p_b));
    let moment = (if b_squared < a_squared { p_b } else { p_a }).cross(axis);
    let squared = moment.dot(moment).max(r * r);
    let inverse = squared.max(R::new(1e-30)).inverse_sqrt();
    let is_inside = moment.dot(moment) < r * r;
    let sine = if is_inside { one } else { (r * inverse).min(one) };
    let across = moment * inverse;

    let nearer = if caps { zero } else { R::new(0.25 * core::f64::consts::PI) * sine };
    let moved = axis.cross(moment) * nearer;
    let upright = surface.normal - axis * surface.normal.dot(axis);
    let hidden = if is_inside { (one - across.dot(across)).max(zero) } else { zero };
    let slope = across * surface.normal.dot(across) + upright * hidden;
    let extent = ltc_root(surface.normal.dot(slope).max(slope.dot(slope)));
    let rise = r * extent;
    let highest = surface.normal.dot(p_a - moved).max(surface.normal.dot(p_b - moved));
    let seen = ltc_tube_share(highest, rise);
    let lift = slope * ((one - seen) * r / extent.max(R::new(1e-15)));
    let (q_a, q_b) = (p_a - moved + lift, p_b - moved + lift);
    let (a_height, b_height) = (surface.normal.dot(q_a), surface.normal.dot(q_b));
    let a_part = saturate(-a_height / (b_height - a_height).max(tiny));
    let b_part = saturate(-b_height / (a_height - b_height).max(tiny));
    let left = q_b - q_a;
    let above = a_height.max(b_height) > zero;

    let least = R::new(LTC_TUBE_TINY);
    let a_inverse = a_squared.max(r * r).max(least).inverse_sqrt();
    let b_inverse = b_squared.max(r * r).max(least).inverse_sqrt();
    let farther = b_squared.max(r * r) * b_inverse - a_squared.max(r * r) * a_inverse;
    let turned = sine * (farther / length.max(tiny)).clamp(-one, one);
    let reach = r.min(length);
    let (start_cap, start_weight) = ltc_tube_cap_begin(surface, p_a, a_inverse, -axis, r, reach, turned);
    let (end_cap, end_weight) = ltc_tube_cap_begin(surface, p_b, b_inverse, axis, r, reach, -turned);
    let weigh = |weight: R| if caps { weight } else { zero };
    // Seen along its axis a capsule shows one cap, and its side lies behind it.
    let side = if caps { (one - turned * turned).max(zero) } else { one };
    LtcTube {
        start: q_a + left * a_part,
        remaining_length: length * (one - a_part - b_part).max(zero),
        end: q_b - left * b_part,
        axis_distance: squared * inverse * (one - nearer),
        axis,
        sine,
        across,
        share: (if above { seen } else { zero }) * side,
        start_cap,
        start_weight: weigh(start_weight),
        end_cap,
        end_weight: weigh(end_weight),
    }
}

/// The form factor of a tube.
pub fn ltc_tube_diffuse<R: Real>(surface: &LtcSurface<R>, tube: &LtcTube<R>) -> R {
    let zero: R = R::new(0.0);
    let foot = tube.axis.cross(tube.across);
    let line = ltc_tube_line::<R>(tube.start, tube.end, foot, tube.axis_distance, tube.remaining_length);
    let cap = |cap: R::Vec3, weight: R| weight * surface.normal.dot(cap).max(zero) * ltc_root(cap.dot(cap));
    saturate(
        surface.normal.dot(line).max(zero) * (tube.sine * tube.share)
            + cap(tube.start_cap, tube.start_weight)
            + cap(tube.end_cap, tube.end_weight),
    )
}

/// The vector form factor of a tube's cap in the lobe's space.
pub fn ltc_tube_cap<R: Real>(lobe: &LtcLobe<R>, cap: R::Vec3, weight: R) -> R::Vec3 {
    let (zero, one) = (R::new(0.0), R::new(1.0));
    let tiny: R = R::new(LTC_TINY);
    let toward = ltc_transform(lobe, cap);
    let squared = cap.dot(cap);
    let inverse = toward.dot(toward).max(tiny).inverse_sqrt();
    let narrowed = (ltc_root(squared) * inverse).min(R::new(1e9));
    let volume = ltc_transform_normal(lobe, cap).dot(toward).max(zero);
    let area = (volume * narrowed * narrowed * narrowed).min(R::new(1e30));
    let covered = (area / (one - squared + area).max(tiny)).min(one);
    toward * if toward.z() > zero { weight * covered * inverse } else { zero }
}

/// The vector form factor of a tube in the lobe's space, of its part above both horizons.
pub fn ltc_tube_lobe<R: Real>(tube: &LtcTube<R>, lobe: &LtcLobe<R>) -> R::Vec3 {
    let (zero, one, half) = (R::new(0.0), R::new(1.0), R::new(0.5));
    let (tiny, least): (R, R) = (R::new(LTC_TINY), R::new(LTC_TUBE_TINY));
    let axis = ltc_transform(lobe, tube.axis);
    let volume = ltc_transform_normal(lobe, tube.axis).dot(axis).max(zero);
    let stretch_squared = axis.dot(axis);
    let stretch_inverse = stretch_squared.max(least).inverse_sqrt();
    let stretch = stretch_squared * stretch_inverse;
    let across = ltc_transform_normal(lobe, tube.across);
    let hidden = if tube.sine < one { zero } else { (one - tube.across.dot(tube.across)).max(zero) };
    let squared = across.dot(across) + hidden * volume * stretch;
    let inverse = squared.max(least).inverse_sqrt();
    let normal = across * inverse;
    let toward = axis.cross(across) * (inverse * stretch_inverse);

    let sine = tube.sine * tube.share;
    let side = ltc_transform(lobe, tube.across) * sine;
    let full_depth = squared * inverse * stretch_inverse;
    let depth = full_depth * ltc_root((one - sine * sine).max(zero));
    let width = sine * volume * inverse;
    let slope = toward.dot(side);
    let (left_depth, right_depth) = (depth - slope, depth + slope);
    let left_squared = left_depth * left_depth + width * width;
    let right_squared = right_depth * right_depth + width * width;
    let left_inverse = left_squared.max(least).inverse_sqrt();
    let right_inverse = right_squared.max(least).inverse_sqrt();
    let (left_cosine, right_cosine) = (left_depth * left_inverse, right_depth * right_inverse);
    let cosines = left_cosine + right_cosine;
    let narrow = width * left_inverse * right_inverse;
    let chord_depth = if cosines > one {
        R::new(4.0) * depth * slope * narrow * narrow / cosines
    } else {
        right_cosine - left_cosine
    };
    let chord_width = width * (left_inverse + right_inverse);
    let chord_squared = chord_depth * chord_depth + chord_width * chord_width;
    let chord_inverse = chord_squared.max(R::new(1e-30)).inverse_sqrt();
    let (turn_depth, turn_width) = (chord_width * chord_inverse, -chord_depth * chord_inverse);
    let foot = toward * turn_depth + normal * turn_width;
    let lengths = left_squared * left_inverse + right_squared * right_inverse;
    let shift = R::new(-4.0) * full_depth * slope / (lengths * lengths).max(R::new(1e-16));
    let distance = tube.axis_distance
        * (turn_depth * (full_depth + slope * shift) + turn_width * width * shift).max(zero);

    let moved = side * (tube.axis_distance * shift);
    let (a, b) = (ltc_transform(lobe, tube.start) + moved, ltc_transform(lobe, tube.end) + moved);
    let mut vector = R::Vec3::new(zero, zero, zero);
    if a.z().max(b.z()) > zero {
        let a_part = saturate(-a.z() / (b.z() - a.z()).max(tiny));
        let b_part = saturate(-b.z() / (a.z() - b.z()).max(tiny));
        let left = b - a;
        let length = tube.remaining_length * stretch * (one - a_part - b_part).max(zero);
        let line = ltc_tube_line::<R>(a + left * a_part, b - left * b_part, foot, distance, length);
        vector = line * (half * chord_squared * chord_inverse);
    }
    if tube.start_weight + tube.end_weight > zero {
        vector = vector
            + ltc_tube_cap(lobe, tube.start_cap, tube.start_weight)
            + ltc_tube_cap(lobe, tube.end_cap, tube.end_weight);
        vector = vector * vector.dot(vector).max(tiny).inverse_sqrt().min(one);
    }
    R::Vec3::new(vector.x(), vector.y(), vector.z().max(zero))
}

/// The value (diffuse, specular, fresnel) of a tube light; see the include for its domain and its error.
pub fn ltc_tube<R: Real>(
    surface: &LtcSurface<R>,
    lobes: &impl LobeSum<R>,
    start: R::Vec3,
    end: R::Vec3,
    radius: R,
    caps: bool,
) -> R::Vec3 {
    let tube = ltc_tube_begin(surface, start, end, radius, caps);
    let specular = ltc_lobes_value(surface, lobes, |lobe| ltc_tube_lobe(&tube, lobe));
    with_form_factor(ltc_tube_diffuse(surface, &tube), specular)
}
