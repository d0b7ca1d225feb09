//! Surfaces and lobes.

use super::real::{Real, Vector};

/// Roughness below which the lobe no longer changes.
pub const LTC_ROUGHNESS_FLOOR: f64 = 0.02;

/// Smallest length by which anything is divided.
pub const LTC_TINY: f64 = 1e-37;
/// Extent of a polygon, sphere or tube together with its distance, times [`LTC_HEADROOM`], below which it shrinks to nothing.
pub const LTC_SMALLEST: f64 = 1e-19;
/// Least depth of a cone, in units of the disk's distance and size together, squared.
pub const LTC_SHALLOWEST: f64 = 1e-18;
/// Largest product of the reciprocal distances of two points of a disk's rim, in the same units.
pub const LTC_NEAREST_PAIR: f64 = 1e18;
/// Smallest square by which a tube's own directions are divided.
pub const LTC_TUBE_TINY: f64 = 1e-20;

/// Factor on positions that leaves room for their differences.
pub const LTC_HEADROOM: f64 = 0.0625;

/// A surface point with its shading frame: the view direction lies in the half-plane of tangent
/// and normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LtcSurface<R: Real> {
    /// The point.
    pub position: R::Vec3,
    /// Perceptual roughness, at least [`LTC_ROUGHNESS_FLOOR`].
    pub roughness: R,
    /// First axis of the frame.
    pub tangent: R::Vec3,
    /// Cosine between normal and view, 0…1.
    pub cos_view: R,
    /// Second axis of the frame.
    pub bitangent: R::Vec3,
    /// Sine between normal and view, 0…1.
    pub sin_view: R,
    /// Third axis of the frame.
    pub normal: R::Vec3,
    /// Square of the roughness.
    pub alpha: R,
}

/// One lobe: a linearly transformed cosine and the weights of the BRDF's two parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LtcLobe<R: Real> {
    /// First row of the inverse matrix: it leads vectors from the caller's space to the lobe's.
    pub axis_x: R::Vec3,
    /// ∫ f·cos over the hemisphere.
    pub albedo: R,
    /// Second row of the inverse matrix.
    pub axis_y: R::Vec3,
    /// ∫ f·cos·(1 − v·h)⁵ over the hemisphere.
    pub fresnel: R,
    /// Third row of the inverse matrix.
    pub axis_z: R::Vec3,
    /// Share of the lobe's energy above the surface.
    pub share: R,
    /// First row of its cofactors: they lead cross products of vectors to the lobe's space, and directions, as
    /// the transpose, back.
    pub normal_x: R::Vec3,
    /// Second row of the cofactors.
    pub normal_y: R::Vec3,
    /// Third row of the cofactors.
    pub normal_z: R::Vec3,
    /// The same for vectors in the surface's frame (tangent, bitangent, normal): first row of the inverse matrix.
    pub frame_x: R::Vec3,
    /// Its second row.
    pub frame_y: R::Vec3,
    /// Its third row.
    pub frame_z: R::Vec3,
    /// First row of its cofactors.
    pub frame_normal_x: R::Vec3,
    /// Second row of its cofactors.
    pub frame_normal_y: R::Vec3,
    /// Third row of its cofactors.
    pub frame_normal_z: R::Vec3,
}

/// Largest absolute component of `v`.
pub fn ltc_extent<R: Real>(v: R::Vec3) -> R {
    v.x().abs().max(v.y().abs()).max(v.z().abs())
}

/// `v` over its length, whatever that is; zero for a zero vector.
pub fn ltc_direction<R: Real>(v: R::Vec3) -> R::Vec3 {
    let scaled = v * (R::new(1.0) / ltc_extent::<R>(v).clamp(R::new(1e-35), R::new(8e37)));
    scaled * scaled.dot(scaled).max(R::new(1e-3)).inverse_sqrt()
}

/// `v` over its length, for a `v` whose square is in range.
pub(super) fn unit<R: Real>(v: R::Vec3) -> R::Vec3 {
    v * v.dot(v).max(R::new(LTC_TINY)).inverse_sqrt()
}

/// Frame and roughness of a surface point; see the include for the domain.
pub fn ltc_surface<R: Real>(
    position: R::Vec3,
    normal: R::Vec3,
    view: R::Vec3,
    roughness: R,
) -> LtcSurface<R> {
    let (zero, one) = (R::new(0.0), R::new(1.0));
    let n = ltc_direction::<R>(normal);
    let v = ltc_direction::<R>(view);
    let side = if n.z() >= zero { one } else { -one };
    let p = -one / (side + n.z());
    let q = n.x() * n.y() * p;
    let basis_x = R::Vec3::new(one + side * n.x() * n.x() * p, side * q, -side * n.x());
    let basis_y = R::Vec3::new(q, side + n.y() * n.y() * p, -n.y());
    let along = [basis_x.dot(v), basis_y.dot(v)];
    let sine_squared = along[0] * along[0] + along[1] * along[1];
    let sine_inverse = sine_squared.max(R::new(1e-12)).inverse_sqrt();
    let azimuth = if sine_squared > R::new(1e-12) {
        [along[0] * sine_inverse, along[1] * sine_inverse]
    } else {
        [one, zero]
    };
    let cosine = n.dot(v);
    let sine = if cosine > zero { (sine_squared * sine_inverse).min(one) } else { one };
    let clamped = roughness.clamp(R::new(LTC_ROUGHNESS_FLOOR), one);
    LtcSurface {
        position,
        roughness: clamped,
        tangent: basis_x * azimuth[0] + basis_y * azimuth[1],
        cos_view: cosine.clamp(zero, one),
        bitangent: basis_y * azimuth[0] - basis_x * azimuth[1],
        sin_view: sine,
        normal: n,
        alpha: clamped * clamped,
    }
}

/// Texture coordinates of a surface in a table of `table_size` by `table_size` texels.
pub fn ltc_table_coordinates<R: Real>(surface: &LtcSurface<R>, table_size: R) -> R::Vec2 {
    let root = surface.cos_view * surface.cos_view.max(R::new(1e-20)).inverse_sqrt();
    let coordinate = |c: R| (c * (table_size - R::new(1.0)) + R::new(0.5)) / table_size;
    [coordinate(surface.roughness), coordinate(root)].into()
}

/// The lobe that two texels of the table describe.
pub fn ltc_lobe<R: Real>(surface: &LtcSurface<R>, shape: R::Vec4, amplitude: R::Vec4) -> LtcLobe<R> {
    let (c, s, a) = (surface.cos_view, surface.sin_view, surface.alpha);
    let [x, y, z, w] = shape.into();
    let [albedo, fresnel, ..] = amplitude.into();
    let m = [c * c + a * x, a * s * y, s * (c + a * z), a * w];
    ltc_planar_lobe(surface, m, albedo, fresnel)
}

/// The lobe whose inverse matrix has the rows (x, 0, z), (0, 1, 0), (y, 0, w) in the surface's frame.
pub fn ltc_planar_lobe<R: Real>(
    surface: &LtcSurface<R>,
    [x, y, z, w]: [R; 4],
    albedo: R,
    fresnel: R,
) -> LtcLobe<R> {
    let (zero, one, half): (R, R, R) = (R::new(0.0), R::new(1.0), R::new(0.5));
    LtcLobe {
        axis_x: surface.tangent * x + surface.normal * z,
        albedo,
        axis_y: surface.bitangent,
        fresnel,
        axis_z: surface.tangent * y + surface.normal * w,
        share: half + half * x * (x * x + y * y).max(R::new(LTC_TINY)).inverse_sqrt(),
        normal_x: surface.tangent * w - surface.normal * y,
        normal_y: surface.bitangent * (x * w - y * z),
        normal_z: surface.normal * x - surface.tangent * z,
        frame_x: R::Vec3::new(x, zero, z),
        frame_y: R::Vec3::new(zero, one, zero),
        frame_z: R::Vec3::new(y, zero, w),
        frame_normal_x: R::Vec3::new(w, zero, -y),
        frame_normal_y: R::Vec3::new(zero, x * w - y * z, zero),
        frame_normal_z: R::Vec3::new(-z, zero, x),
    }
}

/// `v` in the surface's frame: its parts along tangent, bitangent and normal.
pub fn ltc_in_frame<R: Real>(surface: &LtcSurface<R>, v: R::Vec3) -> R::Vec3 {
    R::Vec3::new(surface.tangent.dot(v), surface.bitangent.dot(v), surface.normal.dot(v))
}

/// A lobe whose rows are given for the caller's space only, with those for the surface's frame.
pub fn ltc_framed_lobe<R: Real>(surface: &LtcSurface<R>, lobe: LtcLobe<R>) -> LtcLobe<R> {
    LtcLobe {
        frame_x: ltc_in_frame(surface, lobe.axis_x),
        frame_y: ltc_in_frame(surface, lobe.axis_y),
        frame_z: ltc_in_frame(surface, lobe.axis_z),
        frame_normal_x: ltc_in_frame(surface, lobe.normal_x),
        frame_normal_y: ltc_in_frame(surface, lobe.normal_y),
        frame_normal_z: ltc_in_frame(surface, lobe.normal_z),
        ..lobe
    }
}

/// [`ltc_transform`] for a vector in the surface's frame.
pub fn ltc_transform_framed<R: Real>(lobe: &LtcLobe<R>, v: R::Vec3) -> R::Vec3 {
    R::Vec3::new(lobe.frame_x.dot(v), lobe.frame_y.dot(v), lobe.frame_z.dot(v))
}

/// [`ltc_transform_normal`] for a vector in the surface's frame.
pub fn ltc_transform_framed_normal<R: Real>(lobe: &LtcLobe<R>, v: R::Vec3) -> R::Vec3 {
    R::Vec3::new(lobe.frame_normal_x.dot(v), lobe.frame_normal_y.dot(v), lobe.frame_normal_z.dot(v))
}

/// `v`, a vector from the surface point, in the lobe's space.
pub fn ltc_transform<R: Real>(lobe: &LtcLobe<R>, v: R::Vec3) -> R::Vec3 {
    R::Vec3::new(lobe.axis_x.dot(v), lobe.axis_y.dot(v), lobe.axis_z.dot(v))
}

/// The cross product of two vectors from the surface point, in the lobe's space.
pub fn ltc_transform_normal<R: Real>(lobe: &LtcLobe<R>, v: R::Vec3) -> R::Vec3 {
    R::Vec3::new(lobe.normal_x.dot(v), lobe.normal_y.dot(v), lobe.normal_z.dot(v))
}

/// Reflected radiance from the value (diffuse, specular, fresnel) of a light.
pub fn ltc_reflectance<R: Real>(
    value: R::Vec3,
    normal_reflectance: R::Vec3,
    grazing_reflectance: R::Vec3,
) -> R::Vec3 {
    normal_reflectance * (value.y() - value.z()) + grazing_reflectance * value.z()
}

/// Schlick's factor (1 − v·h)⁵ for light from a direction `toward` in the lobe's space, of any length.
pub fn ltc_schlick<R: Real>(surface: &LtcSurface<R>, lobe: &LtcLobe<R>, toward: R::Vec3) -> R {
    let (zero, one, half) = (R::new(0.0), R::new(1.0), R::new(0.5));
    let direction = ltc_direction::<R>(
        lobe.frame_normal_x * toward.x()
            + lobe.frame_normal_y * toward.y()
            + lobe.frame_normal_z * toward.z(),
    );
    let along = surface.sin_view * direction.x() + surface.cos_view * direction.z();
    let half_cosine = (half + half * along).clamp(zero, one);
    let f = (one - half_cosine * half_cosine.max(R::new(1e-20)).inverse_sqrt()).max(zero);
    f * f * f * f * f
}

/// The parts (specular, fresnel) of a light's value from the `coverage` of a lobe and the mean
/// direction `toward` the light in the lobe's space.
pub fn ltc_specular<R: Real>(
    surface: &LtcSurface<R>,
    lobe: &LtcLobe<R>,
    coverage: R,
    toward: R::Vec3,
) -> R::Vec2 {
    let schlick = ltc_schlick(surface, lobe, toward);
    let whole = coverage * coverage;
    let rest = R::new(1.0) - whole;
    [coverage * lobe.albedo, coverage * (lobe.albedo * schlick * rest + lobe.fresnel * whole)].into()
}

/// The parts (specular, fresnel) of a lobe from the vector form factor in its space.
pub fn ltc_lobe_value<R: Real>(surface: &LtcSurface<R>, lobe: &LtcLobe<R>, toward: R::Vec3) -> R::Vec2 {
    let coverage = (toward.z() / lobe.share).clamp(R::new(0.0), R::new(1.0));
    ltc_specular(surface, lobe, coverage, toward)
}

/// The form factor of the light that arrives, from a signed one; `front` tells whether the light shows its
/// emitting side.
pub fn ltc_received<R: Real>(form_factor: R, front: bool, two_sided: bool) -> R {
    let (zero, one) = (R::new(0.0), R::new(1.0));
    let received = if two_sided { form_factor.abs() } else { form_factor };
    if front | two_sided { received.clamp(zero, one) } else { zero }
}

/// [`ltc_received`] for a vector form factor, whose sign is that of its z.
pub fn ltc_received_vector<R: Real>(form_factor: R::Vec3, front: bool, two_sided: bool) -> R::Vec3 {
    let zero: R = R::new(0.0);
    match (front | two_sided, two_sided & (form_factor.z() < zero)) {
        (true, false) => form_factor,
        (true, true) => -form_factor,
        (false, _) => R::Vec3::new(zero, zero, zero),
    }
}
