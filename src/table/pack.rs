//! From fitted lobes to half-precision texels.

use core::f64::consts::PI;
use half::f16;

use super::{Layer, Table};
use crate::fit::{Fitted, Layout};

impl Table {
    /// Rounds a fitted table to half precision: to one layer in the layouts of sheen and of rough
    /// diffuse surfaces, to two in the others. The second one holds albedo and Schlick part; in
    /// the compatible layout its fourth number is the horizon-clipped sphere of the published
    /// table, see [`clipped_sphere`].
    ///
    /// No texel is subnormal: some devices flush those to zero, so all see the same numbers.
    pub fn pack(fitted: &Fitted) -> Self {
        let size = fitted.settings.size;
        let single = match fitted.settings.layout {
            Layout::Sheen => Some((Layer::Sheen, [0, 2, 3])),
            Layout::Diffuse => Some((Layer::Diffuse, [1, 2, 3])),
            Layout::Native | Layout::Compatible => None,
        };
        if let Some((layer, [a, b, c])) = single {
            let texels = fitted.texels.iter().map(|texel| {
                let shape = texel.parameters;
                [shape[a], shape[b], shape[c], texel.albedo].map(normal_half)
            });
            return Self::new(size, vec![layer], texels.collect());
        }
        let compatible = fitted.settings.layout == Layout::Compatible;
        let native = fitted.settings.layout == Layout::Native;
        let shape = fitted.texels.iter().enumerate().map(|(index, texel)| {
            let mut texel = texel.parameters.map(normal_half);
            if native && index / size == size - 1 {
                // Along the normal a lobe is round: light must not depend on the azimuth of such a view.
                texel[0] = f16::ZERO;
            }
            if compatible {
                // A zero on the diagonal would make the matrix singular.
                for k in [0, 3] {
                    texel[k] = texel[k].max(f16::MIN_POSITIVE);
                }
            }
            texel
        });
        let amplitude = fitted.texels.iter().enumerate().map(|(index, texel)| {
            let last = (size - 1) as f64;
            let (column, row) = ((index % size) as f64 / last, (index / size) as f64 / last);
            let sphere = if compatible { clipped_sphere(2.0 * column - 1.0, row) } else { 0.0 };
            [texel.albedo, texel.fresnel, 0.0, sphere].map(normal_half)
        });
        Self::new(size, Layer::BASE.to_vec(), shape.chain(amplitude).collect())
    }
}

/// The nearest half-precision number that is not subnormal.
pub(super) fn normal_half(value: f64) -> f16 {
    let smallest = f16::MIN_POSITIVE.to_f64();
    if value.abs() >= smallest {
        f16::from_f64(value)
    } else if value.abs() >= 0.5 * smallest {
        f16::from_f64(smallest.copysign(value))
    } else {
        f16::ZERO
    }
}

/// The form factor over the horizon of a sphere of which the whole has the form factor `whole`
/// towards itself (sin² of its angular radius, 0…1), seen under an angle to the normal with the
/// given `cosine`, divided by `whole` (Snyder 1996, "Area Light Sources for Real-Time Graphics"; in
/// the closed form of Lagarde and de Rousiers 2014).
pub fn clipped_sphere(cosine: f64, whole: f64) -> f64 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    if cosine * cosine >= whole || sine == 0.0 {
        return cosine.max(0.0);
    }
    let cotangent = (1.0 / whole - 1.0).max(0.0).sqrt();
    let y = (-cotangent * cosine / sine).clamp(-1.0, 1.0);
    let chord = sine * (1.0 - y * y).sqrt();
    let inside = whole * (cosine * y.acos() - cotangent * chord);
    ((inside + chord.atan2(cotangent)) / (PI * whole)).max(0.0)
}
