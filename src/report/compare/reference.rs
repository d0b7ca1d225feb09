//! What comparators are compared with.

use glam::{DVec3, Vec3};

use super::Input;
use crate::brdf::Ggx;
use crate::effects::{Effect, Effects, Quality};
use crate::report::data::{Kind, MethodInfo};
use crate::report::measure::Quad;
use crate::report::method::Method;
use crate::shade::{
    LTC_ROUGHNESS_FLOOR, LtcSpecular, LtcSurface, Real, ltc_fast_quad, ltc_quad, ltc_surface,
};
use crate::table::Table;
use crate::truth;

/// A quality level, as the include's twin evaluates it in single precision.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    quality: Quality,
    effects: Effects,
    table: Table,
}

impl Level {
    /// The level with the embedded tables.
    pub fn new(quality: Quality) -> Self {
        let plain = Effects::of(&[Effect::Quad, Effect::Ggx]).expect("neither needs another");
        let effects = quality.of(plain);
        let table = Table::default().completed(&effects.layers());
        Self { quality, effects, table }
    }

    /// Which level it is.
    pub fn quality(&self) -> Quality {
        self.quality
    }

    /// The lobes of a surface.
    pub fn lobes<R: Real>(&self, surface: &LtcSurface<R>) -> LtcSpecular<R> {
        self.table.specular(surface, self.effects)
    }

    fn quad<R: Real>(&self, surface: &LtcSurface<R>, corners: [R::Vec3; 4]) -> R::Vec3 {
        let lobes = self.lobes(surface);
        if self.effects.is_fast() {
            ltc_fast_quad(surface, &lobes, corners, false)
        } else {
            ltc_quad(surface, &lobes, corners, false)
        }
    }

    /// [`Method::value`] in double precision.
    pub fn precise_value(&self, quad: &Quad) -> [f64; 3] {
        let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, quad.view, quad.roughness);
        self.quad(&surface, quad.corners).to_array()
    }

    /// Every level, the cheapest first.
    pub fn all() -> impl Iterator<Item = Self> {
        Quality::ALL.into_iter().map(Self::new)
    }
}

impl Method for Level {
    fn info(&self) -> MethodInfo {
        let name = self.quality.name();
        MethodInfo {
            name: name.to_owned(),
            label: name[..1].to_uppercase() + &name[1..],
            kind: Kind::Level,
            description: self.quality.meaning().to_owned(),
        }
    }

    fn value(&self, quad: &Quad) -> [f64; 3] {
        let Input { position, normal, view, roughness, corners } = quad.into();
        let surface = ltc_surface::<f32>(position, normal, view, roughness);
        let value: Vec3 = self.quad(&surface, corners);
        value.to_array().map(f64::from)
    }
}

/// Numerical integration of GGX.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// Relative error to reach, see [`truth::polygon`].
    pub tolerance: f64,
}

impl Default for Truth {
    fn default() -> Self {
        Self { tolerance: 1e-6 }
    }
}

impl Method for Truth {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: "truth".to_owned(),
            label: "Truth".to_owned(),
            kind: Kind::Reference,
            description: "GGX with height-correlated Smith masking, integrated over the light's solid angle by adaptive \
                          Gauss-Kronrod quadrature in double precision."
                .to_owned(),
        }
    }

    fn value(&self, quad: &Quad) -> [f64; 3] {
        let brdf = Ggx::new(quad.roughness.max(LTC_ROUGHNESS_FLOOR).powi(2));
        let truth = truth::polygon(&brdf, quad.view, &quad.corners, false, self.tolerance);
        [truth.diffuse, truth.specular, truth.fresnel]
    }
}
