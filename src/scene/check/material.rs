//! Materials.

use glam::DVec3;

use super::Place;
use crate::scene::file::{MaterialEntry, RoughnessEntry};
use crate::scene::{Material, Roughness, SceneError};

pub(super) fn material(entry: &MaterialEntry, place: &Place) -> Result<Material, SceneError> {
    let roughness = match entry.roughness {
        RoughnessEntry::Constant(value) => {
            let value = place.within("roughness", value, 0.0, 1.0)?;
            Roughness { from: value, to: value, start: DVec3::ZERO, gradient: DVec3::ZERO }
        }
        RoughnessEntry::Varying(varying) => {
            let from = place.within("roughness's from", varying.from, 0.0, 1.0)?;
            let to = place.within("roughness's to", varying.to, 0.0, 1.0)?;
            let start = place.position("roughness's start", varying.start)?;
            let way = place.position("roughness's end", varying.end)? - start;
            if way.length() < 1e-6 {
                return place.error("roughness's start and end are one point; they must be apart");
            }
            Roughness { from, to, start, gradient: way / way.length_squared() }
        }
    };
    let anisotropy = place.within("anisotropy", entry.anisotropy, 0.0, 1.0)?;
    let grain = match entry.grain {
        Some(grain) => place.direction("grain", grain)?,
        None if anisotropy > 0.0 => {
            return place.error(format!(
                "anisotropy is {anisotropy}, but there is no grain; \
                 give a direction along the surface, such as grain = [1, 0, 0]"
            ));
        }
        None => DVec3::ZERO,
    };
    Ok(Material {
        base_colour: place.reflectance("base_colour", entry.base_colour)?,
        f0: place.reflectance("f0", entry.f0)?,
        f90: place.reflectance("f90", entry.f90)?,
        roughness,
        diffuse_roughness: place.within("diffuse_roughness", entry.diffuse_roughness, 0.0, 1.0)?,
        coat: place.within("coat", entry.coat, 0.0, 1.0)?,
        coat_roughness: place.within("coat_roughness", entry.coat_roughness, 0.0, 1.0)?,
        coat_reflectance: place.within("coat_reflectance", entry.coat_reflectance, 0.0, 1.0)?,
        sheen_colour: place.reflectance("sheen_colour", entry.sheen_colour)?,
        sheen_roughness: place.within("sheen_roughness", entry.sheen_roughness, 0.0, 1.0)?,
        anisotropy,
        grain,
    })
}
