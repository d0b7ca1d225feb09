//! Whole surfaces under many lights: what belongs to the surface alone is made once, and each light is cut at the
//! surface's horizon once for all lobes.

use super::anisotropic::{ltc_anisotropic_alpha, ltc_anisotropy};
use super::disk::{ltc_disk_begin, ltc_disk_diffuse, ltc_disk_lobe};
use super::disk::{ltc_sphere_begin, ltc_sphere_diffuse, ltc_sphere_lobe};
use super::fast::LtcFastLight;
use super::layers::{
    ltc_coat_over, ltc_energy_compensation, ltc_rough_diffuse, ltc_sheen_over, ltc_surface_with_roughness,
};
use super::polygon::{
    ltc_outline_add, ltc_outline_begin, ltc_outline_diffuse, ltc_outline_lobe, ltc_outline_lobe_add,
    ltc_outline_lobe_begin,
};
use super::quad::{ltc_quad_begin, ltc_quad_diffuse, ltc_quad_lobe, ltc_quad_toward};
use super::real::{Real, Vector};
use super::several::{LobeSum, LtcSpecular, ltc_lobes_of, ltc_lobes_together, ltc_lobes_value};
use super::surface::{LTC_HEADROOM, LTC_TINY, LtcLobe, LtcSurface, ltc_extent, ltc_reflectance, ltc_surface};
use super::texture::{LtcLookup, ltc_rectangle_diffuse_lookup, ltc_rectangle_lookup};
use super::tube::{ltc_tube_begin, ltc_tube_diffuse, ltc_tube_lobe};
use crate::effects::{Effect, Effects};
use crate::table::Table;

/// What a surface is made of. Members that belong to an effect that is off are not read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LtcMaterial<R: Real> {
    /// Reflectance of the diffuse part, 0…1.
    pub base_colour: R::Vec3,
    /// Perceptual roughness of the specular part, 0…1.
    pub roughness: R,
    /// Specular reflectance at normal incidence (F0).
    pub normal_reflectance: R::Vec3,
    /// Roughness of the diffuse part, from 0 for Lambert's law to 1.
    pub diffuse_roughness: R,
    /// Specular reflectance at grazing incidence (F90).
    pub grazing_reflectance: R::Vec3,
    /// Share of the surface that a clear coat covers, 0…1.
    pub coat: R,
    /// Reflectance of the sheen over everything but the coat, 0…1.
    pub sheen_colour: R::Vec3,
    /// Perceptual roughness of the sheen.
    pub sheen_roughness: R,
    /// Direction along the surface in which highlights are longest; need be neither unit nor quite along it.
    pub grain: R::Vec3,
    /// Strength of the anisotropy, 0…1, see [`ltc_anisotropic_alpha`].
    pub anisotropy: R,
    /// Perceptual roughness of the coat.
    pub coat_roughness: R,
    /// Reflectance of the coat at normal incidence.
    pub coat_reflectance: R,
}

impl<R: Real> LtcMaterial<R> {
    /// The effects without which the material looks different. Energy compensation is a renderer's choice, not a
    /// material's.
    pub fn effects(&self) -> Effects {
        let zero: R = R::new(0.0);
        let black = |v: R::Vec3| v.x() <= zero && v.y() <= zero && v.z() <= zero;
        let glossy = !(black(self.normal_reflectance) && black(self.grazing_reflectance));
        let calls = [
            (Effect::Lambert, true),
            (Effect::Ggx, glossy || self.coat > zero),
            (Effect::ClearCoat, self.coat > zero),
            (Effect::Sheen, !black(self.sheen_colour)),
            (Effect::RoughDiffuse, self.diffuse_roughness > zero && !black(self.base_colour)),
            (Effect::Anisotropic, self.anisotropy > zero && glossy),
        ];
        let called: Vec<Effect> =
            calls.into_iter().filter(|(_, called)| *called).map(|(effect, _)| effect).collect();
        Effects::of(&called).expect("a clear coat and a grain bring the specular part that they need")
    }
}

/// A surface point with the lobes of the effects that are on.
#[derive(Clone, Copy, Debug)]
pub struct LtcShading<R: Real> {
    /// The point and its frame.
    pub surface: LtcSurface<R>,
    /// The specular lobes; an anisotropic surface has one.
    pub specular: Option<LtcSpecular<R>>,
    /// The coat's lobes.
    pub coat: Option<LtcSpecular<R>>,
    /// The sheen's lobe.
    pub sheen: Option<LtcLobe<R>>,
    /// The lobe of a rough diffuse part.
    pub rough: Option<LtcLobe<R>>,
    /// Whether quads and polygons are as [`LtcFastLight`] has them.
    pub fast: bool,
    /// Whether rough metals get back what their facets reflect more than once.
    pub energy_compensation: bool,
}

/// What the parts of a surface receive of a light of unit radiance and reflect of it for a colour of 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LtcReceived<R: Real> {
    /// The form factor.
    pub diffuse: R,
    /// The value of the rough diffuse lobe.
    pub rough: R,
    /// The specular value and Schlick's part of it.
    pub specular: R::Vec2,
    /// The same of the coat.
    pub coat: R::Vec2,
    /// The value of the sheen's lobe.
    pub sheen: R,
}

/// A material of a diffuse and a specular part and nothing else; F90 is 1.
pub fn ltc_material<R: Real>(
    base_colour: R::Vec3,
    roughness: R,
    normal_reflectance: R::Vec3,
) -> LtcMaterial<R> {
    let (zero, one) = (R::new(0.0), R::new(1.0));
    LtcMaterial {
        base_colour,
        roughness,
        normal_reflectance,
        diffuse_roughness: zero,
        grazing_reflectance: R::Vec3::new(one, one, one),
        coat: zero,
        sheen_colour: R::Vec3::new(zero, zero, zero),
        sheen_roughness: R::new(0.5),
        grain: R::Vec3::new(zero, zero, zero),
        anisotropy: zero,
        coat_roughness: R::new(0.1),
        coat_reflectance: R::new(0.04),
    }
}

/// Whether a surface point lies within `range` of the centre of a light, beyond which the light may be skipped; see
/// [`Light::range`](crate::light::Light::range).
pub fn ltc_in_range<R: Real>(position: R::Vec3, centre: R::Vec3, range: R) -> bool {
    let headroom: R = R::new(LTC_HEADROOM);
    let tiny: R = R::new(LTC_TINY);
    let away = centre * headroom - position * headroom;
    let extent = ltc_extent::<R>(away);
    let scaled = away * (R::new(1.0) / extent.max(tiny));
    let squared = scaled.dot(scaled);
    extent * (squared * squared.max(tiny).inverse_sqrt()) <= range * headroom
}

/// The lobes of a surface point, as far as `effects` are on.
///
/// # Panics
///
/// If `table` lacks a layer of `effects`.
pub fn ltc_shading<R: Real>(
    position: R::Vec3,
    normal: R::Vec3,
    view: R::Vec3,
    material: &LtcMaterial<R>,
    table: &Table,
    effects: Effects,
) -> LtcShading<R> {
    let surface = ltc_surface(position, normal, view, material.roughness);
    let with = |roughness: R| ltc_surface_with_roughness(&surface, roughness);
    let on = |effect: Effect| effects.contains(effect);
    let specular = if on(Effect::Anisotropic) & (material.anisotropy > R::new(0.0)) {
        let alpha = ltc_anisotropic_alpha(material.roughness, material.anisotropy);
        let [along, across] = alpha.into();
        let anisotropy = ltc_anisotropy(&surface, material.grain, along, across);
        let lobe = table.anisotropic_lobe(&surface, &anisotropy);
        Some(if on(Effect::SecondLobe) {
            LtcSpecular::Several(ltc_lobes_of(&surface, lobe))
        } else {
            LtcSpecular::One(lobe)
        })
    } else {
        on(Effect::Ggx).then(|| table.specular(&surface, effects))
    };
    LtcShading {
        surface,
        specular,
        coat: on(Effect::ClearCoat).then(|| table.specular(&with(material.coat_roughness), effects)),
        sheen: on(Effect::Sheen).then(|| table.sheen_lobe(&with(material.sheen_roughness))),
        rough: on(Effect::RoughDiffuse).then(|| table.diffuse_lobe(&with(material.diffuse_roughness))),
        fast: effects.is_fast(),
        energy_compensation: on(Effect::EnergyCompensation),
    }
}

/// What all lobes receive of a light, from its form factor and its vector form factor in each lobe's space.
fn received<R: Real>(
    shading: &LtcShading<R>,
    diffuse: R,
    toward: impl Fn(&LtcLobe<R>) -> R::Vec3,
) -> LtcReceived<R> {
    let zero: R = R::new(0.0);
    let glossy = |lobes: &Option<LtcSpecular<R>>| match lobes {
        Some(lobes) => ltc_lobes_value(&shading.surface, lobes, &toward),
        None => [zero, zero].into(),
    };
    let plain = |lobe: &Option<LtcLobe<R>>| match lobe {
        Some(lobe) => ltc_plain_value(lobe, toward(lobe)),
        None => zero,
    };
    LtcReceived {
        diffuse,
        rough: plain(&shading.rough),
        specular: glossy(&shading.specular),
        coat: glossy(&shading.coat),
        sheen: plain(&shading.sheen),
    }
}

/// The value of a lobe without a Schlick part from the vector form factor in its space.
pub fn ltc_plain_value<R: Real>(lobe: &LtcLobe<R>, toward: R::Vec3) -> R {
    lobe.albedo * (toward.z() / lobe.share).clamp(R::new(0.0), R::new(1.0))
}

/// What the surface receives of a convex quad.
pub fn ltc_shading_quad<R: Real>(
    shading: &LtcShading<R>,
    vertices: [R::Vec3; 4],
    two_sided: bool,
) -> LtcReceived<R> {
    if shading.fast {
        let light = LtcFastLight::quad(&shading.surface, vertices, two_sided);
        return received(shading, light.diffuse(), |lobe| light.lobe(lobe));
    }
    let quad = ltc_quad_begin(&shading.surface, vertices, two_sided);
    received(shading, ltc_quad_diffuse(&shading.surface, &quad), |lobe| ltc_quad_lobe(&quad, lobe))
}

/// What the surface receives of a disk.
pub fn ltc_shading_disk<R: Real>(
    shading: &LtcShading<R>,
    centre: R::Vec3,
    half_x: R::Vec3,
    half_y: R::Vec3,
    two_sided: bool,
) -> LtcReceived<R> {
    let disk = ltc_disk_begin(&shading.surface, centre, half_x, half_y, two_sided);
    received(shading, ltc_disk_diffuse(&disk), |lobe| ltc_disk_lobe(&disk, lobe))
}

/// What the surface receives of a sphere.
pub fn ltc_shading_sphere<R: Real>(shading: &LtcShading<R>, centre: R::Vec3, radius: R) -> LtcReceived<R> {
    let sphere = ltc_sphere_begin(&shading.surface, centre, radius);
    received(shading, ltc_sphere_diffuse(&sphere), |lobe| ltc_sphere_lobe(&sphere, lobe))
}

/// What the surface receives of a tube.
pub fn ltc_shading_tube<R: Real>(
    shading: &LtcShading<R>,
    start: R::Vec3,
    end: R::Vec3,
    radius: R,
    caps: bool,
) -> LtcReceived<R> {
    let tube = ltc_tube_begin(&shading.surface, start, end, radius, caps);
    received(shading, ltc_tube_diffuse(&shading.surface, &tube), |lobe| ltc_tube_lobe(&tube, lobe))
}

/// What the surface receives of a polygon of any number of vertices; in the include vertex by vertex.
///
/// # Panics
///
/// If there is no vertex.
pub fn ltc_shading_polygon<R: Real>(
    shading: &LtcShading<R>,
    vertices: &[R::Vec3],
    two_sided: bool,
) -> LtcReceived<R> {
    if shading.fast {
        let light = LtcFastLight::polygon(&shading.surface, vertices, two_sided);
        return received(shading, light.diffuse(), |lobe| light.lobe(lobe));
    }
    let steps = || {
        let mut outline = ltc_outline_begin(&shading.surface, vertices[0]);
        vertices.iter().cycle().skip(1).take(vertices.len()).map(move |vertex| {
            ltc_outline_add(&mut outline, &shading.surface, *vertex);
            outline
        })
    };
    let whole = steps().last().unwrap_or_else(|| ltc_outline_begin(&shading.surface, vertices[0]));
    received(shading, ltc_outline_diffuse(&whole, two_sided), |lobe| {
        let mut sum = ltc_outline_lobe_begin();
        for outline in steps() {
            ltc_outline_lobe_add(&mut sum, &outline, lobe);
        }
        ltc_outline_lobe(&whole, &sum, two_sided)
    })
}

/// Radiance that a surface reflects of a light of unit radiance; it is linear in what is received.
pub fn ltc_reflected<R: Real>(
    shading: &LtcShading<R>,
    material: &LtcMaterial<R>,
    received: &LtcReceived<R>,
) -> R::Vec3 {
    let value = |lobe: R, fresnel: R| R::Vec3::new(received.diffuse, lobe, fresnel);
    let zero: R = R::new(0.0);
    let mut radiance = material.base_colour * received.diffuse;
    if let Some(rough) = shading.rough.as_ref().filter(|_| material.diffuse_roughness > zero) {
        let surface = ltc_surface_with_roughness(&shading.surface, material.diffuse_roughness);
        radiance = ltc_rough_diffuse(&surface, rough, value(received.rough, zero), material.base_colour);
    }
    if let Some(lobes) = &shading.specular {
        let [specular, fresnel] = received.specular.into();
        let (normal, grazing) = (material.normal_reflectance, material.grazing_reflectance);
        let mut glossy = ltc_reflectance::<R>(value(specular, fresnel), normal, grazing);
        if shading.energy_compensation {
            let gain = ltc_energy_compensation(&ltc_lobes_together(&shading.surface, lobes), normal);
            glossy = R::Vec3::new(glossy.x() * gain.x(), glossy.y() * gain.y(), glossy.z() * gain.z());
        }
        radiance = radiance + glossy;
    }
    if let Some(sheen) = &shading.sheen {
        radiance = ltc_sheen_over(radiance, sheen, value(received.sheen, zero), material.sheen_colour);
    }
    if let Some(coat) = &shading.coat {
        let [gloss, fresnel] = received.coat.into();
        let (reflectance, weight) = (material.coat_reflectance, material.coat);
        radiance = ltc_coat_over(
            radiance,
            &ltc_lobes_together(&shading.surface, coat),
            value(gloss, fresnel),
            reflectance,
            weight,
        );
    }
    radiance
}

/// Radiance that a surface reflects of a rectangle, or another parallelogram, that shows a picture of `texels` texels
/// along each axis: each lobe sees the picture as blurred as it is wide. `sample` gives its colour at texture
/// coordinates and a level.
pub fn ltc_reflected_picture<R: Real>(
    shading: &LtcShading<R>,
    material: &LtcMaterial<R>,
    vertices: [R::Vec3; 4],
    two_sided: bool,
    texels: R::Vec2,
    sample: impl Fn(R::Vec2, R) -> R::Vec3,
) -> R::Vec3 {
    let zero: R = R::new(0.0);
    let none = LtcReceived {
        diffuse: zero,
        rough: zero,
        specular: [zero, zero].into(),
        coat: [zero, zero].into(),
        sheen: zero,
    };
    let surface = &shading.surface;
    let quad = ltc_quad_begin(surface, vertices, two_sided);
    let corners = [vertices[0], vertices[1], vertices[3]];
    // What is reflected is linear in what is received, so each part brings its own colour.
    let part = |received: LtcReceived<R>, at: LtcLookup<R>| {
        let (light, colour) = (ltc_reflected(shading, material, &received), sample(at.place, at.level));
        R::Vec3::new(light.x() * colour.x(), light.y() * colour.y(), light.z() * colour.z())
    };
    let plain = |lobe: &LtcLobe<R>| ltc_plain_value(lobe, ltc_quad_lobe(&quad, lobe));
    let diffuse = LtcReceived {
        diffuse: ltc_quad_diffuse(surface, &quad),
        rough: shading.rough.as_ref().map_or(zero, plain),
        ..none
    };
    let toward = ltc_quad_toward(surface, &quad);
    let mut radiance = part(diffuse, ltc_rectangle_diffuse_lookup(surface, corners, toward, texels, false));
    let look = |lobe: &LtcLobe<R>| {
        let toward = ltc_quad_lobe(&quad, lobe);
        (toward, ltc_rectangle_lookup(surface, lobe, corners, toward, texels, false))
    };
    // Of several lobes each sees its own colour; Schlick's part shares that of the specular one.
    let several = |lobes: &LtcSpecular<R>| {
        let mut value = [zero, zero];
        let mut colour = R::Vec3::new(zero, zero, zero);
        for lobe in lobes.lobes() {
            let (toward, at) = look(lobe);
            let [specular, fresnel] = lobes.part(surface, lobe, toward).into();
            value = [value[0] + specular, value[1] + fresnel];
            let share = specular / value[0].max(R::new(LTC_TINY));
            colour = colour + (sample(at.place, at.level) - colour) * share;
        }
        (value.into(), colour)
    };
    let coloured = |received: LtcReceived<R>, colour: R::Vec3| {
        let light = ltc_reflected(shading, material, &received);
        R::Vec3::new(light.x() * colour.x(), light.y() * colour.y(), light.z() * colour.z())
    };
    if let Some(lobes) = &shading.specular {
        let (specular, colour) = several(lobes);
        radiance = radiance + coloured(LtcReceived { specular, ..none }, colour);
    }
    if let Some(lobes) = &shading.coat {
        let (coat, colour) = several(lobes);
        radiance = radiance + coloured(LtcReceived { coat, ..none }, colour);
    }
    if let Some(lobe) = &shading.sheen {
        let (toward, at) = look(lobe);
        radiance = radiance + part(LtcReceived { sheen: ltc_plain_value(lobe, toward), ..none }, at);
    }
    radiance
}
