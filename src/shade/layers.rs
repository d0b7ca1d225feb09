//! Sheen, rough diffuse surfaces, clear coat and rough metals; see the include for each function's
//! domain and its source.

use super::real::{Real, Vector};
use super::surface::{LTC_ROUGHNESS_FLOOR, LtcLobe, LtcSurface, ltc_planar_lobe};

/// Sheen roughness below which the sheen no longer changes.
pub const LTC_SHEEN_ROUGHNESS_FLOOR: f64 = crate::brdf::SHEEN_ROUGHNESS_FLOOR;

/// Albedo to which a lobe's own is raised where energy compensation divides by it.
pub const LTC_ALBEDO_FLOOR: f64 = 0.125;

/// The same surface point and frame with another roughness.
pub fn ltc_surface_with_roughness<R: Real>(surface: &LtcSurface<R>, roughness: R) -> LtcSurface<R> {
    let roughness = roughness.clamp(R::new(LTC_ROUGHNESS_FLOOR), R::new(1.0));
    LtcSurface { roughness, alpha: roughness * roughness, ..*surface }
}

/// The lobe of a sheen of colour 1 from its texel.
pub fn ltc_sheen_lobe<R: Real>(surface: &LtcSurface<R>, texel: R::Vec4) -> LtcLobe<R> {
    let [x, z, w, albedo] = texel.into();
    let reach = R::new(1.0) / surface.roughness.max(R::new(LTC_SHEEN_ROUGHNESS_FLOOR));
    let zero = R::new(0.0);
    ltc_planar_lobe(surface, [x, zero, surface.sin_view * z * reach, w * reach], albedo, zero)
}

/// Radiance of a surface under a sheen: `base` is that without it, `value` the light's for the lobe.
pub fn ltc_sheen_over<R: Real>(
    base: R::Vec3,
    sheen: &LtcLobe<R>,
    value: R::Vec3,
    sheen_colour: R::Vec3,
) -> R::Vec3 {
    let strongest = sheen_colour.x().max(sheen_colour.y()).max(sheen_colour.z());
    base * (R::new(1.0) - strongest * sheen.albedo).max(R::new(0.0)) + sheen_colour * value.y()
}

/// The lobe of what a rough diffuse surface of colour 1 reflects at the first bounce, from its texel.
pub fn ltc_diffuse_lobe<R: Real>(surface: &LtcSurface<R>, texel: R::Vec4) -> LtcLobe<R> {
    let [y, z, w, albedo] = texel.into();
    let s = surface.sin_view;
    ltc_planar_lobe(surface, [R::new(1.0), s * y, s * z, w], albedo, R::new(0.0))
}

/// Reflected radiance of a rough diffuse surface from the value (diffuse, lobe, –) of a light.
pub fn ltc_rough_diffuse<R: Real>(
    surface: &LtcSurface<R>,
    lobe: &LtcLobe<R>,
    value: R::Vec3,
    colour: R::Vec3,
) -> R::Vec3 {
    let one: R = R::new(1.0);
    let r = surface.roughness;
    let mean_albedo = (one + R::new(0.072_488_21) * r) / (one + R::new(0.287_793_41) * r);
    let channel = |colour: R| {
        let series = (one - colour * (one - mean_albedo)).max(R::new(0.5));
        let later = colour * colour * mean_albedo / series;
        colour * value.y() + later * ((one - lobe.albedo) * value.x())
    };
    R::Vec3::new(channel(colour.x()), channel(colour.y()), channel(colour.z()))
}

/// Share of the light that reaches the base below a clear coat.
pub fn ltc_coat_transmission<R: Real>(coat: &LtcLobe<R>, reflectance: R, weight: R) -> R {
    let (zero, one) = (R::new(0.0), R::new(1.0));
    (one - weight * (reflectance * (coat.albedo - coat.fresnel) + coat.fresnel)).clamp(zero, one)
}

/// Radiance of a surface under a clear coat: `base` is that without it, `value` the light's for the
/// lobe.
pub fn ltc_coat_over<R: Real>(
    base: R::Vec3,
    coat: &LtcLobe<R>,
    value: R::Vec3,
    reflectance: R,
    weight: R,
) -> R::Vec3 {
    let gloss = weight * (reflectance * (value.y() - value.z()) + value.z());
    base * ltc_coat_transmission(coat, reflectance, weight) + R::Vec3::new(gloss, gloss, gloss)
}

/// Factor on the reflected radiance of a rough metal that makes up for the light which a single bounce
/// between its facets loses.
pub fn ltc_energy_compensation<R: Real>(lobe: &LtcLobe<R>, normal_reflectance: R::Vec3) -> R::Vec3 {
    let one: R = R::new(1.0);
    let lost = one / lobe.albedo.max(R::new(LTC_ALBEDO_FLOOR)) - one;
    R::Vec3::new(one, one, one) + normal_reflectance * lost
}
