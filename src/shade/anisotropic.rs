//! Lobes of surfaces that are rougher along one direction than across it.

use super::real::{Real, Vector};
use super::surface::{LTC_TINY, LtcLobe, LtcSurface, ltc_direction, ltc_framed_lobe};

/// Smallest α along any direction: the square of the roughness' floor.
pub const LTC_ALPHA_FLOOR: f64 = 0.0004;

/// Texels along each of the table's four axes.
pub const LTC_ANISOTROPIC_SIZE: usize = 8;

/// Tangent of half the stretched view's angle around which the table's second axis bends.
pub const LTC_ANISOTROPIC_KNEE: f64 = 0.8;

/// The directions along which a surface is roughest and smoothest, turned so that the view has no
/// negative component along either.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LtcAnisotropy<R: Real> {
    /// Direction of the larger α.
    pub major: R::Vec3,
    /// The larger α.
    pub alpha_major: R,
    /// Direction of the smaller α.
    pub minor: R::Vec3,
    /// The smaller α.
    pub alpha_minor: R,
    /// Component of the view along the major direction, 0…1.
    pub view_major: R,
    /// Component of the view along the minor direction, 0…1.
    pub view_minor: R,
    /// α of the isotropic surface whose lobe is stretched.
    pub alpha_round: R,
    /// 1 where major × minor is the normal, −1 where it is the opposite.
    pub handedness: R,
}

/// The square root, without the built-in one's lack of a guarantee at zero.
pub fn ltc_anisotropic_root<R: Real>(x: R) -> R {
    x * x.max(R::new(LTC_TINY)).inverse_sqrt()
}

/// α along the tangent and across it, from a perceptual roughness and an anisotropy of 0…1; see the include.
pub fn ltc_anisotropic_alpha<R: Real>(roughness: R, anisotropy: R) -> R::Vec2 {
    let (zero, one) = (R::new(0.0), R::new(1.0));
    let clamped = roughness.clamp(zero, one);
    let ratio = one - R::new(0.9) * anisotropy.clamp(zero, one);
    let stretch = ratio.inverse_sqrt();
    [(clamped * clamped * stretch).min(one), clamped * clamped * ratio * stretch].into()
}

/// The anisotropy of a surface point with `alpha_x` along `tangent` and `alpha_y` across it; see the include
/// for the domain.
pub fn ltc_anisotropy<R: Real>(
    surface: &LtcSurface<R>,
    tangent: R::Vec3,
    alpha_x: R,
    alpha_y: R,
) -> LtcAnisotropy<R> {
    let (zero, one): (R, R) = (R::new(0.0), R::new(1.0));
    let floor: R = R::new(LTC_ALPHA_FLOOR);
    let given = ltc_direction::<R>(tangent);
    let flat = given - surface.normal * surface.normal.dot(given);
    let usable = flat.dot(flat) > R::new(1e-8);
    let along = ltc_direction::<R>(if usable { flat } else { surface.tangent });
    let across = surface.normal.cross(along);
    let bounded_x = alpha_x.clamp(floor, one);
    let bounded_y = alpha_y.clamp(floor, one);
    let swapped = bounded_y > bounded_x;
    let major = if swapped { across } else { along };
    let minor = if swapped { along } else { across };
    let cos_major = surface.tangent.dot(major);
    let cos_minor = surface.tangent.dot(minor);
    let (back_major, back_minor) = (cos_major < zero, cos_minor < zero);
    let alpha_major = bounded_x.max(bounded_y);
    let alpha_minor = bounded_x.min(bounded_y);
    let view_major = surface.sin_view * cos_major.abs();
    let view_minor = surface.sin_view * cos_minor.abs();
    let wide = alpha_major * view_major;
    let narrow = alpha_minor * view_minor;
    let upright = alpha_major * alpha_minor * surface.cos_view * surface.cos_view;
    let alpha_round = ltc_anisotropic_root(wide * wide + narrow * narrow + upright);
    LtcAnisotropy {
        major: if back_major { -major } else { major },
        alpha_major,
        minor: if back_minor { -minor } else { minor },
        alpha_minor,
        view_major,
        view_minor,
        alpha_round: alpha_round.clamp(alpha_minor, alpha_major),
        handedness: if (swapped != back_major) != back_minor { -one } else { one },
    }
}

/// The isotropic surface whose lobe is stretched: where to sample the isotropic table.
pub fn ltc_anisotropic_round<R: Real>(
    surface: &LtcSurface<R>,
    anisotropy: &LtcAnisotropy<R>,
) -> LtcSurface<R> {
    let roughness = ltc_anisotropic_root(anisotropy.alpha_round);
    LtcSurface { roughness, alpha: anisotropy.alpha_round, ..*surface }
}

/// The four coordinates of a lobe in the anisotropic table, each 0…1: the root of the larger α, the
/// stretched view's angle, its azimuth, and the ratio of the two α.
pub fn ltc_anisotropic_coordinates<R: Real>(
    surface: &LtcSurface<R>,
    anisotropy: &LtcAnisotropy<R>,
) -> R::Vec4 {
    let (zero, one, half): (R, R, R) = (R::new(0.0), R::new(1.0), R::new(0.5));
    let wide = anisotropy.alpha_major * anisotropy.view_major;
    let narrow = anisotropy.alpha_minor * anisotropy.view_minor;
    let tangential = wide * wide + narrow * narrow;
    let whole = ltc_anisotropic_root(tangential + surface.cos_view * surface.cos_view);
    let sine = ltc_anisotropic_root(tangential);
    let knee: R = R::new(LTC_ANISOTROPIC_KNEE);
    let bent = sine * (one + knee) / (sine + knee * (whole + surface.cos_view)).max(R::new(LTC_TINY));
    // Along the normal every azimuth is the same.
    let aside = (anisotropy.view_minor - anisotropy.view_major) / surface.sin_view.max(R::new(1e-6));
    let ratio = anisotropy.alpha_minor / anisotropy.alpha_major;
    [
        ltc_anisotropic_root(anisotropy.alpha_major),
        bent,
        half + half * aside,
        (one - ltc_anisotropic_root(ratio)) * R::new(1.462_475_3),
    ]
    .map(|coordinate| coordinate.clamp(zero, one))
    .into()
}

/// The places in a layer and the weights of the four linearly filtered samples whose weighted sum is the
/// table's value at four `coordinates`.
pub fn ltc_anisotropic_texels<R: Real>(coordinates: R::Vec4, table_size: R) -> ([R::Vec2; 4], [R; 4]) {
    let (half, one): (R, R) = (R::new(0.5), R::new(1.0));
    let [x, y, z, w]: [R; 4] = coordinates.into();
    let last: R = R::new((LTC_ANISOTROPIC_SIZE - 1) as f64);
    let size: R = R::new(LTC_ANISOTROPIC_SIZE as f64);
    let cell = |c: R| R::new((c * last).to_f64().floor().min((LTC_ANISOTROPIC_SIZE - 2) as f64));
    let (cell_z, cell_w) = (cell(z), cell(w));
    let (right, down) = (z * last - cell_z, w * last - cell_w);
    let left = (cell_z * size + x * last + half) / table_size;
    let top = (cell_w * size + y * last + half) / table_size;
    let step = size / table_size;
    let places = [[left, top], [left + step, top], [left, top + step], [left + step, top + step]];
    let weights = [(one - right) * (one - down), right * (one - down), (one - right) * down, right * down];
    (places.map(Into::into), weights)
}

/// Direction of the stretched view from the major direction, a unit vector; along the normal any.
pub(crate) fn azimuth<R: Real>(anisotropy: &LtcAnisotropy<R>) -> [R; 2] {
    let wide = anisotropy.alpha_major * anisotropy.view_major;
    let narrow = anisotropy.alpha_minor * anisotropy.view_minor;
    let squared = wide * wide + narrow * narrow;
    if squared > R::new(1e-30) {
        let inverse = squared.inverse_sqrt();
        [wide * inverse, narrow * inverse]
    } else {
        [R::new(1.0), R::new(0.0)]
    }
}

/// The columns of the matrix that leads microfacet normals, in the space where their distribution is a
/// hemisphere, to directions of reflected light near the middle of the lobe; see `ltc_anisotropic_lobe` in the include. From
/// components along the [`azimuth`], across it and along the normal to (major, minor, normal).
pub(crate) fn stretch<R: Real>(surface: &LtcSurface<R>, anisotropy: &LtcAnisotropy<R>) -> [[R; 3]; 3] {
    let (one, half): (R, R) = (R::new(1.0), R::new(0.5));
    let c = surface.cos_view;
    let (view_x, view_y) = (anisotropy.view_major, anisotropy.view_minor);
    let (alpha_x, alpha_y) = (anisotropy.alpha_major, anisotropy.alpha_minor);
    let wide = alpha_x * view_x;
    let narrow = alpha_y * view_y;
    let tangential = wide * wide + narrow * narrow;
    let inverse = (tangential + c * c).max(R::new(LTC_TINY)).inverse_sqrt();
    let slope_x = alpha_x * wide * inverse;
    let slope_y = alpha_y * narrow * inverse;
    let tilt = tangential * inverse;
    let height = tilt + c;
    let lift = half + half * (slope_x * slope_x + slope_y * slope_y);
    let turn = view_x * slope_y - view_y * slope_x;
    let [cosine, sine] = azimuth(anisotropy);
    let (x, y) = ([alpha_x * cosine, alpha_x * sine], [alpha_y * cosine, alpha_y * sine]);
    // Multiplied out, as the rest of it cancels.
    let lean = c * inverse * wide * sine * ((alpha_x - alpha_y) * (alpha_x + alpha_y));
    [
        [
            x[0] * height - y[1] * turn,
            x[0] * turn + y[1] * height,
            x[0] * (view_x - c * slope_x) + y[1] * (view_y - c * slope_y),
        ],
        [-(y[0] * turn + x[1] * height), y[0] * height - x[1] * turn, lean],
        [view_x * (lift - one) - tilt * slope_x, view_y * (lift - one) - tilt * slope_y, c * lift],
    ]
}

/// The entries (1,1), (2,2), (1,3) and (3,1) of the matrix from the clamped cosine to the normals that [`stretch`] takes, for the
/// isotropic lobe; the entry (3,3) is 1, and there are no others.
pub(crate) fn base<R: Real>(
    surface: &LtcSurface<R>,
    anisotropy: &LtcAnisotropy<R>,
    shape: R::Vec4,
) -> [R; 4] {
    let (one, half): (R, R) = (R::new(1.0), R::new(0.5));
    let (c, s, a) = (surface.cos_view, surface.sin_view, anisotropy.alpha_round);
    let [x, y, z, w] = shape.into();
    let m = [c * c + a * x, a * s * y, s * (c + a * z), a * w];
    let tangential = a * s * a * s;
    let inverse = (tangential + c * c).max(R::new(LTC_TINY)).inverse_sqrt();
    let slope = a * a * s * inverse;
    let tilt = tangential * inverse;
    let lift = half + half * slope * slope;
    let rise = s - c * slope;
    let reach = s * (lift - one) - tilt * slope;
    let scale = one / (a * (rise * m[2] + (tilt + c) * m[0])).max(R::new(1e-12));
    let xx = (c * lift * m[3] + reach * m[1]) * scale;
    let xz = -(c * lift * m[2] + reach * m[0]) * scale;
    let zx = -(rise * m[3] + (tilt + c) * m[1]) * a * scale;
    let volume = (m[0] * m[3] - m[1] * m[2]) * scale;
    let yy = volume * (c * lift - reach * rise / (tilt + c).max(R::new(LTC_TINY)));
    [xx, yy, xz, zx]
}

/// The lobe of an anisotropic surface from two texels of the isotropic table at `ltc_anisotropic_round` and two of
/// the anisotropic table; see the include.
pub fn ltc_anisotropic_lobe<R: Real>(
    surface: &LtcSurface<R>,
    anisotropy: &LtcAnisotropy<R>,
    shape: R::Vec4,
    amplitude: R::Vec4,
    first: R::Vec4,
    second: R::Vec4,
) -> LtcLobe<R> {
    let (zero, one, half) = (R::new(0.0), R::new(1.0), R::new(0.5));
    let ratio = anisotropy.alpha_minor / anisotropy.alpha_major;
    let depth = ((one - ltc_anisotropic_root(ratio)) * R::new(1.462_475_3)).clamp(zero, one);
    let [along, across, along_up, up_along] = base(surface, anisotropy, shape);
    let [xx, xy, yy, xz] = first.into();
    let [yz, zx, zy, brighter] = second.into();
    // As in the include, in the plane of the stretched view's azimuth.
    let [cosine, sine] = azimuth(anisotropy);
    let (along_square, both, across_square) = (cosine * cosine, cosine * sine, sine * sine);
    let two = R::new(2.0);
    let e_uu = along + depth * (xx * along_square + two * xy * both + yy * across_square);
    let e_uv = depth * ((yy - xx) * both + xy * (along_square - across_square));
    let e_vv = across + depth * (xx * across_square - two * xy * both + yy * along_square);
    let e_uz = along_up + depth * (xz * cosine + yz * sine);
    let e_vz = depth * (yz * cosine - xz * sine);
    let e_zu = up_along + depth * (zx * cosine + zy * sine);
    let e_zv = depth * (zy * cosine - zx * sine);
    let [u, v, z] = stretch(surface, anisotropy)
        .map(|[x, y, z]| anisotropy.major * x + anisotropy.minor * y + surface.normal * z);
    let m_x = u * e_uu + v * e_uv + z * e_zu;
    let m_y = (u * e_uv + v * e_vv + z * e_zv) * anisotropy.handedness;
    let m_z = u * e_uz + v * e_vz + z;
    let across = m_z.cross(m_x);
    let scale = across.dot(across).max(R::new(LTC_TINY)).inverse_sqrt();
    let axis_y = across * scale;
    let volume = (scale * m_y.dot(axis_y)).abs();
    let heights = [m_x, m_y, m_z].map(|m| surface.normal.dot(m));
    let squared = heights[0] * heights[0] + heights[1] * heights[1] + heights[2] * heights[2];
    let [albedo, fresnel, ..] = amplitude.into();
    let nothing = R::Vec3::new(zero, zero, zero);
    let lobe = LtcLobe {
        axis_x: m_y.cross(m_z) * scale,
        albedo: (albedo * (one + depth * brighter)).clamp(zero, one),
        axis_y,
        fresnel: (fresnel * (one + depth * brighter)).clamp(zero, one),
        axis_z: m_x.cross(m_y) * scale,
        share: half + half * heights[2] * squared.max(R::new(LTC_TINY)).inverse_sqrt(),
        normal_x: m_x * volume,
        normal_y: m_y * volume,
        normal_z: m_z * volume,
        frame_x: nothing,
        frame_y: nothing,
        frame_z: nothing,
        frame_normal_x: nothing,
        frame_normal_y: nothing,
        frame_normal_z: nothing,
    };
    ltc_framed_lobe(surface, lobe)
}
