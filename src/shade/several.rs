//! Sums of lobes.

use super::real::{Real, Vector};
use super::surface::{LtcLobe, LtcSurface, ltc_lobe_value};

/// The lobes whose sum is isotropic GGX: one, two or three.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LtcLobes<R: Real> {
    lobes: [LtcLobe<R>; 3],
    count: usize,
}

impl<R: Real> LtcLobes<R> {
    /// A sum of lobes.
    ///
    /// # Panics
    ///
    /// If there are none or more than three.
    pub fn new(lobes: &[LtcLobe<R>]) -> Self {
        assert!((1..=3).contains(&lobes.len()), "a sum has one to three lobes, not {}", lobes.len());
        let last = lobes.len() - 1;
        Self { lobes: core::array::from_fn(|i| lobes[i.min(last)]), count: lobes.len() }
    }

    /// The lobes.
    pub fn as_slice(&self) -> &[LtcLobe<R>] {
        &self.lobes[..self.count]
    }
}

/// What a light can be reflected by: one lobe, or a sum of them.
pub trait LobeSum<R: Real> {
    /// The lobes of the sum.
    fn lobes(&self) -> &[LtcLobe<R>];
}

impl<R: Real> LobeSum<R> for LtcLobe<R> {
    fn lobes(&self) -> &[LtcLobe<R>] {
        core::slice::from_ref(self)
    }
}

impl<R: Real> LobeSum<R> for LtcLobes<R> {
    fn lobes(&self) -> &[LtcLobe<R>] {
        self.as_slice()
    }
}

/// The first lobe with the albedo and the Schlick part of all: for functions that ask how much a surface reflects, not
/// where.
pub fn ltc_lobes_together<R: Real>(lobes: &LtcLobes<R>) -> LtcLobe<R> {
    let mut together = lobes.lobes[0];
    for lobe in &lobes.as_slice()[1..] {
        together.albedo += lobe.albedo;
        together.fresnel += lobe.fresnel;
    }
    together
}

/// (diffuse, specular, fresnel) from the form factor and the other two.
pub(super) fn with_form_factor<R: Real>(form_factor: R, parts: R::Vec2) -> R::Vec3 {
    let [specular, fresnel] = parts.into();
    R::Vec3::new(form_factor, specular, fresnel)
}

/// The parts (specular, fresnel) of a sum of lobes from the vector form factor in each one's space.
pub fn ltc_lobes_value<R: Real>(
    surface: &LtcSurface<R>,
    lobes: &impl LobeSum<R>,
    mut toward: impl FnMut(&LtcLobe<R>) -> R::Vec3,
) -> R::Vec2 {
    let (mut specular, mut fresnel) = (R::new(0.0), R::new(0.0));
    for lobe in lobes.lobes() {
        let [s, f] = ltc_lobe_value(surface, lobe, toward(lobe)).into();
        (specular, fresnel) = (specular + s, fresnel + f);
    }
    [specular, fresnel].into()
}
