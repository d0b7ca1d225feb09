//! Where to look up the image of a textured light.

use super::real::{Real, Vector};
use super::surface::{
    LTC_HEADROOM, LTC_TINY, LtcLobe, LtcSurface, ltc_direction, ltc_extent, ltc_transform,
    ltc_transform_normal,
};
use crate::texture::{LINEAR_VARIANCE, VARIANCE};

/// Largest gradient of texture coordinates by direction that counts; a light that small is seen as its mean.
const GRADIENT_LIMIT: f64 = 1e4;

/// Where to sample the pyramid of a light's image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LtcLookup<R: Real> {
    /// Texture coordinates.
    pub place: R::Vec2,
    /// What to add to them for the one, and subtract for the other, of a pair of samples; zero for a single one.
    pub apart: R::Vec2,
    /// Level of the pyramid.
    pub level: R,
}

/// The numbers of the relation between what a lobe sees of a light and the place and blur of its image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookupConstants {
    /// Spread of the directions around the mean one, before the light's outline limits it, in units of their
    /// distance to the origin: what leads from the mean direction to the cosine's centre.
    pub spread: f64,
    /// The same for the blur.
    pub blur: f64,
    /// How much of the blur's variance is missing for directions near the horizon.
    pub tilt: f64,
    /// How much of it is missing for a light that is seen edge-on.
    pub edge_on: f64,
    /// How much further from the picture's centre to look for each unit of variance: blurring pulls towards it.
    pub push: f64,
    /// The same for each square of it.
    pub push_more: f64,
    /// For a pair of samples, the least share of the longer variance that each of them has.
    pub pair_share: f64,
    /// Distance between the two over what would make up for the rest.
    pub pair_reach: f64,
}

impl From<[f64; 8]> for LookupConstants {
    fn from([spread, blur, tilt, edge_on, push, push_more, pair_share, pair_reach]: [f64; 8]) -> Self {
        Self { spread, blur, tilt, edge_on, push, push_more, pair_share, pair_reach }
    }
}

impl From<LookupConstants> for [f64; 8] {
    fn from(constants: LookupConstants) -> Self {
        let LookupConstants { spread, blur, tilt, edge_on, push, push_more, pair_share, pair_reach } =
            constants;
        [spread, blur, tilt, edge_on, push, push_more, pair_share, pair_reach]
    }
}

/// The constants of the include, from `softbox::fit::fit_lookup`.
pub const LTC_LOOKUP: LookupConstants = LookupConstants {
    spread: 0.497,
    blur: 0.97,
    tilt: 0.555,
    edge_on: 0.7,
    push: 3.7,
    push_more: 3.4,
    pair_share: 0.133,
    pair_reach: 0.642,
};

/// The look-up for a lobe: `toward` is the vector form factor of the light in the lobe's space. The light is a
/// parallelogram of the corners a, b and d; the image has `texels` texels along each axis.
pub fn ltc_rectangle_lookup<R: Real>(
    surface: &LtcSurface<R>,
    lobe: &LtcLobe<R>,
    corners: [R::Vec3; 3],
    toward: R::Vec3,
    texels: R::Vec2,
    pair: bool,
) -> LtcLookup<R> {
    let [corner, edge_u, edge_v] = frame(surface, corners);
    let [normal_u, normal_v, normal] = [edge_v.cross(corner), corner.cross(edge_u), edge_u.cross(edge_v)]
        .map(|v| ltc_transform_normal(lobe, v));
    let direction = ltc_direction::<R>(toward);
    let rise = R::Vec3::new(ltc_transform(lobe, edge_u).z(), ltc_transform(lobe, edge_v).z(), direction.z());
    let offset = ltc_transform(lobe, corner).dot(normal);
    ltc_lookup(direction, rise, normal_u, normal_v, normal, offset, texels, pair)
}

/// The look-up for diffuse light: `toward` is the vector form factor of the light in the caller's space.
pub fn ltc_rectangle_diffuse_lookup<R: Real>(
    surface: &LtcSurface<R>,
    corners: [R::Vec3; 3],
    toward: R::Vec3,
    texels: R::Vec2,
    pair: bool,
) -> LtcLookup<R> {
    let [corner, edge_u, edge_v] = frame(surface, corners);
    let normal = edge_u.cross(edge_v);
    let direction = ltc_direction::<R>(toward);
    let rise =
        R::Vec3::new(surface.normal.dot(edge_u), surface.normal.dot(edge_v), surface.normal.dot(direction));
    let (normal_u, normal_v) = (edge_v.cross(corner), corner.cross(edge_u));
    ltc_lookup(direction, rise, normal_u, normal_v, normal, corner.dot(normal), texels, pair)
}

/// The picture's upper left corner from the surface point, and its sides to the right and downwards, in units of
/// the light's distance.
fn frame<R: Real>(surface: &LtcSurface<R>, corners: [R::Vec3; 3]) -> [R::Vec3; 3] {
    let headroom: R = R::new(LTC_HEADROOM);
    let origin = surface.position * headroom;
    let [a, b, d] = corners.map(|corner| corner * headroom);
    let extent =
        ltc_extent::<R>(a - origin).max(ltc_extent::<R>(b - origin)).max(ltc_extent::<R>(d - origin));
    let scale = R::new(1.0) / extent.max(R::new(LTC_TINY));
    [(d - origin) * scale, (b - a) * scale, (a - d) * scale]
}

/// The look-up from the unit vector `toward` the light; the heights of the sides of u and v and of `toward` over
/// the cosine's horizon; the cross products v × corner, corner × u and u × v; and the product of the corner
/// and the last one of these.
#[allow(clippy::too_many_arguments, reason = "those of the include's function")]
pub fn ltc_lookup<R: Real>(
    toward: R::Vec3,
    rise: R::Vec3,
    normal_u: R::Vec3,
    normal_v: R::Vec3,
    normal: R::Vec3,
    offset: R,
    texels: R::Vec2,
    pair: bool,
) -> LtcLookup<R> {
    ltc_lookup_with(&LTC_LOOKUP, toward, rise, normal_u, normal_v, normal, offset, texels, pair)
}

/// [`ltc_lookup`] with constants of one's own; see the include for what it does.
#[allow(clippy::too_many_arguments, reason = "those of the include's function")]
pub fn ltc_lookup_with<R: Real>(
    constants: &LookupConstants,
    toward: R::Vec3,
    rise: R::Vec3,
    normal_u: R::Vec3,
    normal_v: R::Vec3,
    normal: R::Vec3,
    offset: R,
    texels: R::Vec2,
    pair: bool,
) -> LtcLookup<R> {
    let (zero, half, one) = (R::new(0.0), R::new(0.5), R::new(1.0));
    let (tiny, limit): (R, R) = (R::new(LTC_TINY), R::new(GRADIENT_LIMIT));
    let [width, height] = texels.into();
    // Where the mean direction meets the light.
    let facing = toward.dot(normal);
    let inverse = (if facing < zero { -one } else { one }) / facing.abs().max(R::new(1e-30));
    let u = (toward.dot(normal_u) * inverse).clamp(zero, one);
    let v = (toward.dot(normal_v) * inverse).clamp(zero, one);
    // How fast that point moves with the direction.
    let bounded = |v: R::Vec3| v * (limit / ltc_extent::<R>(v).max(limit));
    let along_u = bounded((normal_u - normal * u) * inverse);
    let along_v = bounded((normal_v - normal * v) * inverse);
    let moment = [along_u.dot(along_u), along_u.dot(along_v), along_v.dot(along_v)];
    let product = along_u.cross(along_v);
    let area = product.dot(product);

    // From the mean of directions to that of the cosine.
    let spread: R = R::new(constants.spread * constants.spread);
    let (room_u, room_v) = (u * (one - u), v * (one - v));
    let room = |room: R| R::new(4.0 / 3.0) * room * room + R::new(1e-6);
    let (room_u, room_v) = (room(room_u), room(room_v));
    let (s_u, s_v, s_area) = (spread * moment[0], spread * moment[2], spread * spread * area);
    let whole = s_area + s_u * room_v + s_v * room_u + room_u * room_v;
    let variance_u = room_u * ((s_area + s_u * room_v) / whole);
    let variance_v = room_v * ((s_area + s_v * room_u) / whole);
    let covariance = room_u * room_v * (spread * moment[1] / whole);
    let per_height = one / (offset * inverse * rise.z()).max(tiny);
    let (slope_u, slope_v) = (rise.x() * per_height, rise.y() * per_height);
    let u = (u + (variance_u * slope_u + covariance * slope_v)).clamp(zero, one);
    let v = (v + (covariance * slope_u + variance_v * slope_v)).clamp(zero, one);

    // The blur, in units of the image's mean side, along the axes of its ellipse.
    let cosine = facing.abs() * normal.dot(normal).max(tiny).inverse_sqrt();
    let lean = R::new(constants.tilt) * (one - rise.z()) + R::new(constants.edge_on) * (one - cosine);
    let blur = R::new(constants.blur * constants.blur) * (one - lean).max(R::new(0.05));
    let aspect = width.max(one) / height.max(one);
    let (x, y, z) = (blur * moment[0] * aspect, blur * moment[1], blur * moment[2] / aspect);
    let difference = half * (x - z);
    let square = difference * difference + y * y;
    let turn = square * square.max(tiny).inverse_sqrt();
    let long_side = half * (x + z) + turn;
    let (long, short) = (ltc_outlined(long_side), ltc_outlined(blur * blur * area / long_side.max(tiny)));
    let product = long * short;
    let variance = if pair {
        short.max(long * R::new(constants.pair_share))
    } else {
        product * product.max(tiny).inverse_sqrt()
    };
    let square = (variance * width * height + R::new(VARIANCE)) * R::new(1.0 / (VARIANCE + LINEAR_VARIANCE));
    let level = R::new(0.5 / core::f64::consts::LN_2) * square.max(one).ln();

    let axis = if difference < zero { [y, turn - difference] } else { [turn + difference, y] };
    let axis_length = (axis[0] * axis[0] + axis[1] * axis[1]).max(tiny).inverse_sqrt();
    let rest = (if pair { long - variance } else { zero }).max(zero);
    let reach = R::new(constants.pair_reach) * (rest * rest.max(tiny).inverse_sqrt()) * axis_length;
    let root = aspect * aspect.max(tiny).inverse_sqrt();
    let pushed = |c: R| {
        let push = R::new(constants.push) + R::new(constants.push * constants.push_more) * variance;
        (half + (c - half) * (one + push * variance)).clamp(zero, one)
    };
    LtcLookup {
        place: [pushed(u), pushed(v)].into(),
        apart: [reach * axis[0] / root, reach * axis[1] * root].into(),
        level,
    }
}

/// Variance of the blur that leaves of the second wave across a picture what a spread of the given variance leaves of
/// it: exp(−2π²·blur) = 1 / (1 + 2π²·spread).
pub fn ltc_outlined<R: Real>(spread: R) -> R {
    let waves: R = R::new(2.0 * core::f64::consts::PI * core::f64::consts::PI);
    let x = spread * waves;
    let logarithm = if x < R::new(1e-3) { x - R::new(0.5) * x * x } else { (R::new(1.0) + x).ln() };
    logarithm / waves
}
