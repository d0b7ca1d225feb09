//! Tables of several lobes.

use super::{Layer, Table};
use crate::effects::{Effect, Effects};
use crate::shade::{
    LtcLobes, LtcSpecular, LtcSurface, Real, ltc_lobe_fitted, ltc_table_coordinates, ltc_three_lobes,
    ltc_two_lobes,
};

impl Table {
    /// The embedded layers of GGX as a sum of two lobes.
    pub fn two_lobes() -> Self {
        Self::from_layers(crate::TABLE_SIZE, &Layer::TWO_LOBES, crate::TABLE_TWO_LOBES)
            .expect("the embedded layers are whole")
    }

    /// The embedded layers of GGX as a sum of three lobes.
    pub fn three_lobes() -> Self {
        Self::from_layers(crate::TABLE_SIZE, &Layer::THREE_LOBES, crate::TABLE_THREE_LOBES)
            .expect("the embedded layers are whole")
    }

    /// The lobes of a surface, as many as the effects say.
    ///
    /// # Panics
    ///
    /// If the table lacks their layers.
    pub fn specular<R: Real>(&self, surface: &LtcSurface<R>, effects: Effects) -> LtcSpecular<R> {
        if effects.contains(Effect::TableFree) && !effects.contains(Effect::SecondLobe) {
            return LtcSpecular::One(ltc_lobe_fitted(surface));
        }
        match (effects.contains(Effect::SecondLobe), effects.contains(Effect::ThirdLobe)) {
            (false, _) => LtcSpecular::One(self.lobe(surface)),
            (true, false) => LtcSpecular::Several(self.lobes(surface, 2)),
            (true, true) => LtcSpecular::Several(self.lobes(surface, 3)),
        }
    }

    /// The two or three lobes of a surface.
    ///
    /// # Panics
    ///
    /// If the table lacks the layers for `count` lobes, or there can be no such count.
    pub fn lobes<R: Real>(&self, surface: &LtcSurface<R>, count: usize) -> LtcLobes<R> {
        let [u, v] = ltc_table_coordinates(surface, R::new(self.size as f64)).into();
        let texel = |layer: Layer| {
            let index = self.index(layer).unwrap_or_else(|| panic!("the table has no layer {layer:?}"));
            self.sample::<R>(index, [u, v].into())
        };
        match count {
            2 => {
                let [first, second, weights] = Layer::TWO_LOBES.map(texel);
                ltc_two_lobes(surface, [first, second], weights)
            }
            3 => {
                let [first, second, third, albedos, parts] = Layer::THREE_LOBES.map(texel);
                ltc_three_lobes(surface, [first, second, third], albedos, parts)
            }
            _ => panic!("there are tables of two and of three lobes, not of {count}"),
        }
    }
}
