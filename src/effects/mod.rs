//! What a scene calls for, as a set: the kinds of light, the layers of surfaces, the options.
//!
//! A set chooses what is left of the include. Each effect is one line of one table, which names the
//! `override` that it switches in the include, the functions that it is there for, the layers of the lookup
//! table that it reads and the effects without which it means nothing.
//!
//! ```
//! use softbox::effects::Effects;
//!
//! let effects: Effects = "two-sided+ggx+polygon,quad".parse()?;
//! assert_eq!(effects.to_string(), "quad,polygon+ggx+two-sided");
//! assert!(softbox::effects::wgsl(effects)?.contains("fn ltc_quad("));
//! # Ok::<(), softbox::effects::EffectsError>(())
//! ```

mod error;
mod quality;
mod source;
mod table;
mod text;
mod wgsl;

use core::ops::{BitAnd, BitOr, Sub};

pub use error::EffectsError;
pub use quality::{ErrorBound, Quality};
#[cfg(feature = "translate")]
pub(crate) use source::{Formula, words};
use table::TABLE;
pub use table::{Effect, Entry, Group, Layer};
pub use wgsl::{wgsl, wgsl_from};

impl Effect {
    /// Every effect, in canonical order.
    pub fn all() -> impl Iterator<Item = Self> {
        TABLE.iter().map(|entry| entry.effect)
    }

    /// Its line of the table.
    pub fn entry(self) -> &'static Entry {
        &TABLE[self as usize]
    }

    /// Its name in texts.
    pub fn name(self) -> &'static str {
        self.entry().name
    }

    /// The macro that switches it where the whole include is read by a C preprocessor.
    pub fn switch_macro(self) -> String {
        format!("LTC_{}", self.name().replace('-', "_").to_ascii_uppercase())
    }

    /// Whether it is part of the include as it stands: everything is but what trades accuracy for cost or cost for
    /// accuracy.
    pub const fn is_default(self) -> bool {
        !matches!(
            self,
            Self::CheapHorizon | Self::CheapDistance | Self::TableFree | Self::SecondLobe | Self::ThirdLobe
        )
    }

    const fn bit(self) -> u32 {
        1 << self as u32
    }

    /// Whether a text of the include can do without it: whether it declares the effect's `override`.
    pub fn is_declared(self, include: &str) -> bool {
        let switch = self.entry().switch;
        switch.is_empty() || include.lines().any(|line| declares(line, switch))
    }
}

/// Whether a line declares the switch, be it one or already decided.
fn declares(line: &str, switch: &str) -> bool {
    ["override ", "const "].iter().any(|word| {
        line.strip_prefix(word).is_some_and(|rest| rest.trim_start().starts_with(&format!("{switch}:")))
    })
}

/// A set of effects in which everything has what it needs. Diffuse reflection by Lambert's law is part of
/// every set but the empty one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Effects(u32);

impl Effects {
    /// Nothing at all.
    pub const NONE: Self = Self(0);

    /// Everything that there is a name for.
    pub const fn all() -> Self {
        Self((1 << TABLE.len()) - 1)
    }

    /// What the include has.
    pub fn present() -> Self {
        Self::declared(crate::WGSL_INCLUDE)
    }

    /// What the include does as it stands: everything but what trades accuracy for cost or cost for accuracy.
    pub fn standing() -> Self {
        let present = Self::present();
        present.iter().filter(|effect| !effect.is_default()).fold(present, Self::without)
    }

    /// What a text of the include has.
    pub fn declared(include: &str) -> Self {
        Self::sustained(bits(Effect::all().filter(|effect| effect.is_declared(include))))
    }

    /// The set of the given effects.
    ///
    /// # Errors
    ///
    /// If one of them needs another that is not there.
    pub fn of(effects: &[Effect]) -> Result<Self, EffectsError> {
        let set = Self::closed(bits(effects.iter().copied()));
        match set.iter().find(|effect| !set.sustains(*effect)) {
            Some(effect) => Err(EffectsError::needs(effect, effects)),
            None => Ok(set),
        }
    }

    /// Every set, the empty one first.
    pub fn every() -> impl Iterator<Item = Self> {
        (0..=Self::all().0)
            .map(Self)
            .filter(|set| *set == Self::closed(set.0) && set.iter().all(|effect| set.sustains(effect)))
    }

    /// With what every set has.
    fn closed(bits: u32) -> Self {
        Self(if bits == 0 { 0 } else { bits | Effect::Lambert.bit() })
    }

    /// Without what lacks what it needs.
    fn sustained(bits: u32) -> Self {
        let mut set = Self::closed(bits);
        loop {
            let kept =
                Self::closed(set.iter().filter(|effect| set.sustains(*effect)).fold(0, |b, e| b | e.bit()));
            if kept == set {
                return set;
            }
            set = kept;
        }
    }

    /// Whether the set has what `effect` needs.
    fn sustains(self, effect: Effect) -> bool {
        let needs = effect.entry().needs;
        needs.is_empty() || needs.iter().any(|need| self.contains(*need))
    }

    /// Whether the effect is in the set.
    pub const fn contains(self, effect: Effect) -> bool {
        self.0 & effect.bit() != 0
    }

    /// Whether nothing is.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// How many effects the set has.
    pub const fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    /// Whether everything in `other` is in this set.
    pub const fn is_superset(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// The effects of the set, in canonical order.
    pub fn iter(self) -> impl Iterator<Item = Effect> {
        Effect::all().filter(move |effect| self.contains(*effect))
    }

    /// Without an effect, and without those that need it.
    pub fn without(self, effect: Effect) -> Self {
        Self::sustained(self.0 & !effect.bit())
    }

    /// What each `override` of the include is for this set, those of the WebGPU pipeline, too.
    pub fn switches(self) -> impl Iterator<Item = (&'static str, bool)> {
        let switched = TABLE.iter().filter(|entry| !entry.switch.is_empty());
        switched.map(move |entry| (entry.switch, self.contains(entry.effect)))
    }

    /// Whether quads and polygons are neither cut nor told apart by distance.
    pub const fn is_fast(self) -> bool {
        self.contains(Effect::CheapHorizon) && self.contains(Effect::CheapDistance)
    }

    /// Whether a surface of the set has a lobe.
    pub fn has_lobe(self) -> bool {
        self.iter().any(|effect| effect.entry().has_lobe)
    }

    /// The include's functions that the set is there for.
    pub fn roots(self) -> Vec<&'static str> {
        let has_lobe = self.has_lobe();
        let with_lobe = |effect: Effect| if has_lobe { effect.entry().lobe_roots } else { &[] };
        self.iter().flat_map(|effect| effect.entry().roots.iter().chain(with_lobe(effect)).copied()).collect()
    }

    /// The layers of the table that the set reads, each once. Anisotropic surfaces are of one lobe; others read the
    /// layers of as many as the set has.
    pub fn layers(self) -> Vec<Layer> {
        let has = |effect: Effect| self.contains(effect);
        let is_read = |layer: &Layer| match layer {
            Layer::Shape | Layer::Amplitude => {
                has(Effect::Anisotropic) || !(has(Effect::SecondLobe) || has(Effect::TableFree))
            }
            Layer::FirstOfTwo | Layer::SecondOfTwo | Layer::WeightsOfTwo => !has(Effect::ThirdLobe),
            _ => true,
        };
        let mut layers: Vec<Layer> = Vec::new();
        for layer in self.iter().flat_map(|effect| effect.entry().layers).filter(|layer| is_read(layer)) {
            if !layers.contains(layer) {
                layers.push(*layer);
            }
        }
        // A sum of lobes comes right behind the single lobe, or first.
        let place = |layer: &Layer| match layer {
            Layer::Shape | Layer::Amplitude => 0,
            layer if Layer::TWO_LOBES.contains(layer) || Layer::THREE_LOBES.contains(layer) => 1,
            _ => 2,
        };
        layers.sort_by_key(place);
        layers
    }

    /// Asserts that a text of the include has every effect of the set.
    pub(crate) fn check_declared(self, include: &str) -> Result<(), EffectsError> {
        match self.iter().find(|effect| !effect.is_declared(include)) {
            Some(effect) => Err(EffectsError::absent(self, effect, Self::declared(include))),
            None => Ok(()),
        }
    }
}

fn bits(effects: impl Iterator<Item = Effect>) -> u32 {
    effects.fold(0, |bits, effect| bits | effect.bit())
}

impl BitOr for Effects {
    type Output = Self;

    /// What is in either.
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl BitAnd for Effects {
    type Output = Self;

    /// What is in both, less what then lacks what it needs.
    fn bitand(self, other: Self) -> Self {
        Self::sustained(self.0 & other.0)
    }
}

impl Sub for Effects {
    type Output = Self;

    /// What is in the first only, less what then lacks what it needs.
    fn sub(self, other: Self) -> Self {
        Self::sustained((self.0 & !other.0) & !Effect::Lambert.bit())
    }
}
