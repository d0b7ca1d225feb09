//! Layered materials in ground truth.

use glam::DVec3;

use super::{Light, Material};
use crate::brdf::{AnisotropicGgx, Brdf, Charlie, Eon, Ggx, Scattering};
use crate::light;
use crate::shade::{LTC_ALPHA_FLOOR, LTC_ROUGHNESS_FLOOR, ltc_anisotropic_alpha};
use crate::texture::Prefiltered;
use crate::truth::{self, Truth};

/// Relative error allowed to each integral.
const TOLERANCE: f64 = 1e-4;

/// A surface point with the reflectance models of its layers, in a frame whose x-axis runs along the grain.
pub(super) struct Layers<'a> {
    material: &'a Material,
    axes: [DVec3; 3],
    position: DVec3,
    view: DVec3,
    specular: Specular,
    /// Factor on the specular part for the light that one bounce loses.
    compensation: DVec3,
    coat: Option<Covering<Ggx>>,
    sheen: Option<Covering<Charlie>>,
}

/// The specular part.
enum Specular {
    Round(Ggx),
    Stretched(AnisotropicGgx),
}

impl Specular {
    fn brdf(&self) -> &dyn Brdf {
        match self {
            Self::Round(ggx) => ggx,
            Self::Stretched(ggx) => ggx,
        }
    }
}

/// A layer that takes from what is below it.
struct Covering<B> {
    brdf: B,
    /// Share of the light that gets to what is below.
    passes: f64,
}

/// The light of unit radiance that comes from everywhere and leaves towards `view`, with its Schlick part.
fn albedo(brdf: &dyn Brdf, view: DVec3) -> Truth {
    truth::sphere(brdf, view, DVec3::ZERO, 1.0, TOLERANCE)
}

fn ggx(roughness: f64) -> Ggx {
    let roughness = roughness.max(LTC_ROUGHNESS_FLOOR);
    Ggx::new(roughness * roughness)
}

impl<'a> Layers<'a> {
    pub(super) fn new(
        material: &'a Material,
        energy_compensation: bool,
        position: DVec3,
        normal: DVec3,
        view: DVec3,
    ) -> Self {
        // Where the grain leaves the surface the view's azimuth takes its place, as in the include.
        let along = |direction: DVec3| direction - normal * normal.dot(direction);
        let (grain, seen) = (along(material.grain), along(view));
        let x = if grain.length_squared() > 1e-8 { grain } else { seen };
        let x = x.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
        let axes = [x, normal.cross(x), normal];
        let view = DVec3::from(axes.map(|axis| axis.dot(view)));
        let roughness = material.roughness.at(position);
        let specular = if material.anisotropy > 0.0 {
            let alpha = ltc_anisotropic_alpha::<f64>(roughness, material.anisotropy);
            let [alpha_x, alpha_y] = alpha.to_array().map(|alpha| alpha.clamp(LTC_ALPHA_FLOOR, 1.0));
            Specular::Stretched(AnisotropicGgx { alpha_x, alpha_y, azimuth: 0.0 })
        } else {
            Specular::Round(ggx(roughness))
        };
        let is_metal = material.f0.max_element() > 0.0;
        let compensation = if energy_compensation && is_metal {
            DVec3::ONE + material.f0 * (1.0 / albedo(specular.brdf(), view).specular - 1.0)
        } else {
            DVec3::ONE
        };
        let coat = (material.coat > 0.0).then(|| {
            let brdf = ggx(material.coat_roughness);
            let whole = albedo(&brdf, view);
            let reflected = material.coat_reflectance * (whole.specular - whole.fresnel) + whole.fresnel;
            Covering { brdf, passes: 1.0 - material.coat * reflected }
        });
        let strongest = material.sheen_colour.max_element();
        let sheen = (strongest > 0.0).then(|| {
            let brdf = Charlie::of_roughness(material.sheen_roughness);
            let passes = (1.0 - strongest * albedo(&brdf, view).specular).max(0.0);
            Covering { brdf, passes }
        });
        Self { material, axes, position, view, specular, compensation, coat, sheen }
    }

    /// Radiance that the surface reflects of a light.
    pub(super) fn reflected(&self, light: &Light) -> DVec3 {
        let into = |v: DVec3| DVec3::from(self.axes.map(|axis| axis.dot(v)));
        let shape = light.shape.moved(|point| into(point - self.position), into);
        let lit = Lit { shape: &shape, picture: light.picture.as_ref() };
        let material = self.material;
        let value = lit.values(self.specular.brdf(), self.view);
        let specular = self.compensation
            * (material.f0 * (value.specular - value.fresnel) + material.f90 * value.fresnel);
        let mut radiance = self.diffuse(&lit, value.diffuse) + specular;
        if let Some(sheen) = &self.sheen {
            let value = lit.values(&sheen.brdf, self.view);
            radiance = radiance * sheen.passes + material.sheen_colour * value.specular;
        }
        if let Some(coat) = &self.coat {
            let value = lit.values(&coat.brdf, self.view);
            let gloss = material.coat_reflectance * (value.specular - value.fresnel) + value.fresnel;
            radiance = radiance * coat.passes + material.coat * gloss;
        }
        light.radiance * radiance
    }

    /// The diffuse part; `form_factor` is that of the light.
    fn diffuse(&self, lit: &Lit, form_factor: DVec3) -> DVec3 {
        let Material { base_colour, diffuse_roughness, .. } = *self.material;
        if diffuse_roughness == 0.0 || base_colour == DVec3::ZERO {
            return base_colour * form_factor;
        }
        // The model is a colour times one lobe and another colour times another.
        let white = |scattering| Eon { scattering, ..Eon::new(diffuse_roughness) };
        let single = lit.values(&white(Scattering::Single), self.view).specular;
        let multiple = lit.values(&white(Scattering::Multiple), self.view).specular;
        let later = DVec3::from(
            base_colour
                .to_array()
                .map(|colour| Eon { colour, ..Eon::new(diffuse_roughness) }.multiple_colour()),
        );
        base_colour * single + later * multiple
    }
}

/// What a reflectance model makes of a light, each colour for itself.
#[derive(Default)]
struct Values {
    diffuse: DVec3,
    specular: DVec3,
    fresnel: DVec3,
}

/// A light in the frame of a surface point.
struct Lit<'a> {
    shape: &'a light::Light,
    picture: Option<&'a Prefiltered>,
}

impl Lit<'_> {
    fn values(&self, brdf: &dyn Brdf, view: DVec3) -> Values {
        match (self.picture, self.shape) {
            (Some(picture), light::Light::Polygon { points, two_sided }) => {
                shown(brdf, view, points, *two_sided, picture)
            }
            _ => {
                let truth = truth::light(brdf, view, self.shape, TOLERANCE);
                let [diffuse, specular, fresnel] =
                    [truth.diffuse, truth.specular, truth.fresnel].map(DVec3::splat);
                Values { diffuse, specular, fresnel }
            }
        }
    }
}

/// The sum over the texels of a picture, which knows where each colour ends.
fn shown(brdf: &dyn Brdf, view: DVec3, points: &[DVec3], two_sided: bool, picture: &Prefiltered) -> Values {
    let [a, b, d] = [points[0], points[1], points[3]];
    let faces = (b - a).cross(d - a).dot(a) < 0.0;
    let mut values = Values::default();
    if !(faces || two_sided) {
        return values;
    }
    let image = &picture.levels()[0];
    let shares = truth::texel_shares(brdf, view, [a, b, d], [image.width, image.height]);
    for (&[red, green, blue, _], share) in image.texels.iter().zip(shares) {
        let colour = DVec3::new(red.into(), green.into(), blue.into());
        values.diffuse += colour * share[0];
        values.specular += colour * share[1];
        values.fresnel += colour * share[2];
    }
    values
}
