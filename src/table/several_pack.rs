//! From fitted sums of lobes to half-precision texels.

use super::pack::normal_half;
use super::{Layer, Table};
use crate::fit::{FittedLobes, LobesTexel};

impl Table {
    /// Rounds a fitted table of two or three lobes to half precision: to [`Layer::TWO_LOBES`] or
    /// [`Layer::THREE_LOBES`]. No texel is subnormal.
    pub fn pack_lobes(fitted: &FittedLobes) -> Self {
        let layer = |numbers: &dyn Fn(&LobesTexel) -> [f64; 4]| -> Vec<_> {
            fitted.texels.iter().map(|texel| numbers(texel).map(normal_half)).collect()
        };
        let shapes: Vec<_> = (0..fitted.count).flat_map(|i| layer(&|texel| texel.shapes[i])).collect();
        let (layers, weights) = if fitted.count == 2 {
            let weights = layer(&|texel| {
                let ([a, b, _], [c, d, _]) = (texel.albedos, texel.excesses);
                [a, b, c, d]
            });
            (Layer::TWO_LOBES.to_vec(), weights)
        } else {
            let albedos = layer(&|texel| {
                let [a, b, c] = texel.albedos;
                [a, b, c, texel.fresnel]
            });
            let excesses = layer(&|texel| {
                let [a, b, c] = texel.excesses;
                [a, b, c, 0.0]
            });
            (Layer::THREE_LOBES.to_vec(), [albedos, excesses].concat())
        };
        Self::new(fitted.size, layers, [shapes, weights].concat())
    }
}
