//! What a scene calls for.

use glam::DVec3;

use super::{Light, Material, Scene, SceneError, Shape};
use crate::effects::{Effect, Effects, Quality};
use crate::shade::{LtcMaterial, ltc_material};

/// A set of effects that is known to have what each of them needs.
fn set(effects: &[Effect]) -> Effects {
    Effects::of(effects).expect("an effect comes with what it needs")
}

impl Light {
    /// The least set of effects that shades this light; none for a light that emits nothing.
    pub fn effects(&self) -> Effects {
        if self.radiance.max_element() <= 0.0 {
            return Effects::NONE;
        }
        match self.picture {
            Some(_) => self.shape.effects() | set(&[Effect::Quad, Effect::Textured]),
            None => self.shape.effects(),
        }
    }
}

impl Material {
    /// The material at a point, as the functions of the include take it.
    pub fn at(&self, point: DVec3) -> LtcMaterial<f64> {
        LtcMaterial {
            grazing_reflectance: self.f90,
            diffuse_roughness: self.diffuse_roughness,
            coat: self.coat,
            sheen_colour: self.sheen_colour,
            sheen_roughness: self.sheen_roughness,
            grain: self.grain,
            anisotropy: self.anisotropy,
            coat_roughness: self.coat_roughness,
            coat_reflectance: self.coat_reflectance,
            ..ltc_material(self.base_colour, self.roughness.at(point), self.f0)
        }
    }

    /// The least set of effects that shades this material.
    pub fn effects(&self) -> Effects {
        self.at(DVec3::ZERO).effects()
    }
}

impl Scene {
    /// The least set of effects that draws the scene at a quality level. Where the second or third lobe of a level is not
    /// needed to keep what the level promises of a dielectric, it is left out: metals, whose Schlick part is small, have
    /// with a lobe less no larger an error than a dielectric with it.
    pub fn effects_at(&self, level: Quality) -> Effects {
        let promised = level.error_bound().dielectric;
        let keeps = |cheaper: Quality| {
            self.objects.iter().all(|object| {
                let material = &object.material;
                let (normal, grazing) = (material.f0.to_array(), material.f90.to_array());
                let coat = if material.coat > 0.0 {
                    cheaper.expected_error(material.coat_reflectance, 1.0)
                } else {
                    0.0
                };
                let worst =
                    (0..3).map(|k| cheaper.expected_error(normal[k], grazing[k])).fold(coat, f64::max);
                worst <= promised
            })
        };
        let exact = |cheaper: &Quality| *cheaper >= Quality::Standard && *cheaper < level;
        let least = Quality::ALL.into_iter().filter(exact).find(|cheaper| keeps(*cheaper));
        least.unwrap_or(level).of(self.effects())
    }

    /// The least set of effects that draws the scene right: none at all if there is nothing to shade.
    pub fn effects(&self) -> Effects {
        let lights = self.lights.iter().fold(Effects::NONE, |sum, light| sum | light.effects());
        if lights.is_empty() || self.objects.is_empty() {
            return Effects::NONE;
        }
        self.objects.iter().fold(lights, |sum, object| sum | object.material.effects()) | self.own_effects()
    }

    /// What the scene as a whole calls for.
    fn own_effects(&self) -> Effects {
        let is_metal = |material: &Material| material.f0.max_element() > 0.0;
        if self.energy_compensation && self.objects.iter().any(|object| is_metal(&object.material)) {
            set(&[Effect::Ggx, Effect::EnergyCompensation])
        } else {
            Effects::NONE
        }
    }

    /// The entries of the scene file with what each calls for: objects, lights, and what holds for all of them.
    pub fn entries(&self) -> Vec<(String, Effects)> {
        let mut counts = [0; 3];
        let objects = self.objects.iter().map(|object| {
            let (kind, name) = match object.shape {
                Shape::Plane { .. } => (0, "plane"),
                Shape::Box { .. } => (1, "box"),
                Shape::Sphere { .. } => (2, "sphere"),
            };
            counts[kind] += 1;
            (format!("{name} {}", counts[kind]), object.material.effects())
        });
        let mut entries: Vec<_> = objects.collect();
        let lights = self.lights.iter().enumerate();
        entries.extend(lights.map(|(index, light)| (format!("light {}", index + 1), light.effects())));
        entries.push(("energy_compensation".to_owned(), self.own_effects()));
        entries.retain(|(_, effects)| !effects.is_empty());
        entries
    }

    /// Asserts that a module with the given effects draws the scene right.
    ///
    /// # Errors
    ///
    /// If it lacks an effect: the first entry that calls for one, and the least set that would do.
    pub fn check_effects(&self, effects: Effects) -> Result<(), SceneError> {
        let wanted = self.effects();
        if effects.is_superset(wanted) {
            return Ok(());
        }
        let missing = self.entries().into_iter().find_map(|(place, called)| {
            called.iter().find(|effect| !effects.contains(*effect)).map(|effect| (place, effect))
        });
        let (place, effect) = missing.expect("what a scene calls for is what its entries call for");
        Err(SceneError::new(
            place,
            format!(
                "calls for the effect {:?}, which the set \"{effects}\" lacks; \"{wanted}\" would do",
                effect.name()
            ),
        ))
    }
}
