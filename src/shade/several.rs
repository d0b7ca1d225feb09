//! Sums of lobes.

use super::real::{Real, Vector};
use super::surface::{LTC_TINY, LtcLobe, LtcSurface, ltc_lobe, ltc_lobe_value, ltc_schlick};

/// How far the mean direction of a light turns towards a lobe's axis, for lack of the cosine in its mean.
pub const LTC_MEAN_SHIFT: f64 = 0.5;

/// One, two or three lobes whose values add up. The albedo of each is its own share of the surface's; its Schlick part is
/// that of [`ltc_lobes_part`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LtcLobes<R: Real> {
    lobes: [LtcLobe<R>; 3],
    count: usize,
}

impl<R: Real> LtcLobes<R> {
    fn new(lobes: &[LtcLobe<R>]) -> Self {
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

    /// The parts (specular, fresnel) of one of these lobes from the vector form factor in its space.
    fn part(&self, surface: &LtcSurface<R>, lobe: &LtcLobe<R>, toward: R::Vec3) -> R::Vec2;
}

impl<R: Real> LobeSum<R> for LtcLobe<R> {
    fn lobes(&self) -> &[LtcLobe<R>] {
        core::slice::from_ref(self)
    }

    fn part(&self, surface: &LtcSurface<R>, lobe: &LtcLobe<R>, toward: R::Vec3) -> R::Vec2 {
        ltc_lobe_value(surface, lobe, toward)
    }
}

impl<R: Real> LobeSum<R> for LtcLobes<R> {
    fn lobes(&self) -> &[LtcLobe<R>] {
        self.as_slice()
    }

    fn part(&self, surface: &LtcSurface<R>, lobe: &LtcLobe<R>, toward: R::Vec3) -> R::Vec2 {
        ltc_lobes_part(surface, lobe, toward)
    }
}

/// Either of them: what a surface has, as the effects of a set say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LtcSpecular<R: Real> {
    /// A single lobe.
    One(LtcLobe<R>),
    /// A sum.
    Several(LtcLobes<R>),
}

impl<R: Real> LobeSum<R> for LtcSpecular<R> {
    fn lobes(&self) -> &[LtcLobe<R>] {
        match self {
            Self::One(lobe) => lobe.lobes(),
            Self::Several(lobes) => lobes.lobes(),
        }
    }

    fn part(&self, surface: &LtcSurface<R>, lobe: &LtcLobe<R>, toward: R::Vec3) -> R::Vec2 {
        match self {
            Self::One(one) => one.part(surface, lobe, toward),
            Self::Several(lobes) => lobes.part(surface, lobe, toward),
        }
    }
}

/// A sum of one lobe.
pub fn ltc_lobes_of<R: Real>(surface: &LtcSurface<R>, lobe: LtcLobe<R>) -> LtcLobes<R> {
    let schlick = ltc_mean_schlick(surface, &lobe, ltc_all_around(&lobe));
    LtcLobes::new(&[LtcLobe { fresnel: lobe.fresnel - lobe.albedo * schlick, ..lobe }])
}

/// The lobes that three texels describe: two shapes as in [`ltc_lobe`], and (albedo of the first, of the second,
/// excess of the first, of the second).
pub fn ltc_two_lobes<R: Real>(
    surface: &LtcSurface<R>,
    shapes: [R::Vec4; 2],
    weights: R::Vec4,
) -> LtcLobes<R> {
    let zero: R = R::new(0.0);
    let [first, second, first_excess, second_excess] = weights.into();
    let lobe = |shape, albedo, fresnel| ltc_lobe(surface, shape, [albedo, fresnel, zero, zero].into());
    LtcLobes::new(&[lobe(shapes[0], first, first_excess), lobe(shapes[1], second, second_excess)])
}

/// The lobes that five texels describe: three shapes as in [`ltc_lobe`], their albedos, and their excesses.
pub fn ltc_three_lobes<R: Real>(
    surface: &LtcSurface<R>,
    shapes: [R::Vec4; 3],
    albedos: R::Vec4,
    excesses: R::Vec4,
) -> LtcLobes<R> {
    let zero: R = R::new(0.0);
    let (albedos, excesses): ([R; 4], [R; 4]) = (albedos.into(), excesses.into());
    let lobe = |i: usize| ltc_lobe(surface, shapes[i], [albedos[i], excesses[i], zero, zero].into());
    LtcLobes::new(&[lobe(0), lobe(1), lobe(2)])
}

/// The vector form factor, in a lobe's space, of a light all around the surface: half the sum of the normals of the two
/// horizons.
pub fn ltc_all_around<R: Real>(lobe: &LtcLobe<R>) -> R::Vec3 {
    let (half, tiny) = (R::new(0.5), R::new(LTC_TINY));
    let horizon = R::Vec3::new(lobe.frame_normal_x.z(), lobe.frame_normal_y.z(), lobe.frame_normal_z.z());
    let unit = horizon * horizon.dot(horizon).max(tiny).inverse_sqrt();
    R::Vec3::new(half * unit.x(), half * unit.y(), half + half * unit.z())
}

/// Schlick's factor (1 − v·h)⁵ at the mean direction of a light, from its vector form factor `toward` in a lobe's space.
///
/// The vector form factor t averages directions without the lobe's cosine. For a cap around a direction d, so small that
/// |t| is the square of its angle, the mean with the cosine is d·cos θ + |t|/4·z, up to a factor: z turns in by
/// |t|²/(4 cos θ) beside t. The cosine is left out, and the factor is not the derived one but the round number that did
/// best of a few on random quads.
pub fn ltc_mean_schlick<R: Real>(surface: &LtcSurface<R>, lobe: &LtcLobe<R>, toward: R::Vec3) -> R {
    let height = toward.z() + R::new(LTC_MEAN_SHIFT) * toward.dot(toward);
    ltc_schlick(surface, lobe, R::Vec3::new(toward.x(), toward.y(), height))
}

/// The parts (specular, fresnel) of one lobe of a sum from the vector form factor `toward` in its space.
///
/// Schlick's factor is that of the mean direction of the light. What a light all around gets beyond that, the lobe's
/// `fresnel` holds as an excess of either sign; it comes in with the variance of the factor over the light, for which the
/// square of the coverage stands.
pub fn ltc_lobes_part<R: Real>(surface: &LtcSurface<R>, lobe: &LtcLobe<R>, toward: R::Vec3) -> R::Vec2 {
    let (zero, one) = (R::new(0.0), R::new(1.0));
    let coverage = (toward.z() / lobe.share).clamp(zero, one);
    let schlick =
        lobe.albedo * ltc_mean_schlick(surface, lobe, toward) + lobe.fresnel * (coverage * coverage);
    [coverage * lobe.albedo, coverage * schlick.clamp(zero, lobe.albedo)].into()
}

/// The first lobe with the albedo and the Schlick part of all: for functions that ask how much a surface reflects, not
/// where.
pub fn ltc_lobes_together<R: Real>(surface: &LtcSurface<R>, lobes: &LtcSpecular<R>) -> LtcLobe<R> {
    match lobes {
        LtcSpecular::One(lobe) => *lobe,
        LtcSpecular::Several(lobes) => {
            let parts = ltc_lobes_value(surface, lobes, |lobe| ltc_all_around(lobe));
            let [albedo, fresnel] = parts.into();
            LtcLobe { albedo, fresnel, ..lobes.lobes[0] }
        }
    }
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
        let [s, f] = lobes.part(surface, lobe, toward(lobe)).into();
        (specular, fresnel) = (specular + s, fresnel + f);
    }
    [specular, fresnel].into()
}
