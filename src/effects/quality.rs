//! Quality levels: how much accuracy a renderer buys, as effects.

use super::{Effect, Effects, EffectsError};

/// How much accuracy a renderer buys. Levels differ by effects and nothing else, so a set of effects can also be put
/// together by hand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quality {
    /// One lobe by a closed form, without a table; round lights of the same vector form factor where a horizon cuts.
    Fast,
    /// One lobe, exact horizons.
    #[default]
    Standard,
    /// The sum of two lobes, exact horizons.
    Fine,
    /// The sum of three lobes, exact horizons.
    Finest,
}

/// Mean |error| over mean value; see [`Quality::error_bound`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorBound {
    /// Of the form factor.
    pub diffuse: f64,
    /// Of the specular value for F = 1.
    pub specular: f64,
    /// Of its Schlick part.
    pub fresnel: f64,
    /// Of a dielectric with F0 = 0.04 and F90 = 1.
    pub dielectric: f64,
}

impl Quality {
    /// Every level, the cheapest first.
    pub const ALL: [Self; 4] = [Self::Fast, Self::Standard, Self::Fine, Self::Finest];

    /// The effects by which the level differs from [`Quality::Standard`].
    const fn changes(self) -> &'static [Effect] {
        match self {
            Self::Fast => &[Effect::CheapHorizon, Effect::CheapDistance, Effect::TableFree],
            Self::Standard => &[],
            Self::Fine => &[Effect::SecondLobe],
            Self::Finest => &[Effect::SecondLobe, Effect::ThirdLobe],
        }
    }

    /// Its name in texts.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Standard => "standard",
            Self::Fine => "fine",
            Self::Finest => "finest",
        }
    }

    /// What the level does, in one sentence.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Fast => {
                "One lobe by a closed form, without a table; quads and polygons uncut, a horizon by a formula in their vector form factor."
            }
            Self::Standard => "One lobe from a table of two layers, cut exactly at both horizons.",
            Self::Fine => {
                "The sum of two lobes, each with a weight for either part, from a table of three layers."
            }
            Self::Finest => {
                "The sum of three lobes, each with a weight for either part, from a table of five layers."
            }
        }
    }

    /// The mean |error| that the level has, over the mean value, against numerical integration of GGX on the random quads
    /// of `softbox::report::errors::random_lights`: roughness 0.1 to 1, cosine between normal and view 0.05 to 1. Tests assert it.
    pub const fn error_bound(self) -> ErrorBound {
        match self {
            Self::Fast => ErrorBound { diffuse: 0.031, specular: 0.0358, fresnel: 0.12, dielectric: 0.0875 },
            Self::Standard => {
                ErrorBound { diffuse: 1e-6, specular: 0.0216, fresnel: 0.0635, dielectric: 0.0467 }
            }
            Self::Fine => ErrorBound { diffuse: 1e-6, specular: 0.0076, fresnel: 0.0307, dielectric: 0.0221 },
            Self::Finest => {
                ErrorBound { diffuse: 1e-6, specular: 0.0046, fresnel: 0.025, dielectric: 0.0176 }
            }
        }
    }

    /// The mean |error| over mean value to be expected of a surface with the given reflectances at normal and at grazing
    /// incidence: that of its two parts, each by its share of the light. A surface that reflects nothing has none.
    ///
    /// ```
    /// use softbox::effects::Quality;
    ///
    /// let dielectric = Quality::Fine.error_bound().dielectric;
    /// assert!((Quality::Fine.expected_error(0.04, 1.0) - dielectric).abs() < 2e-3);
    /// // Of metals one lobe says as much as two of a dielectric.
    /// assert!(Quality::Standard.expected_error(0.9, 1.0) < dielectric);
    /// ```
    pub const fn expected_error(self, normal_reflectance: f64, grazing_reflectance: f64) -> f64 {
        // Mean Schlick part over mean specular value, on the quads of the bounds.
        const SCHLICK_SHARE: f64 = 0.062;
        let bound = self.error_bound();
        let rise = (grazing_reflectance - normal_reflectance).abs() * SCHLICK_SHARE;
        let whole = normal_reflectance + rise;
        if whole > 0.0 { (normal_reflectance * bound.specular + rise * bound.fresnel) / whole } else { 0.0 }
    }

    /// A set of effects at this level: with the level's own effects, as far as the set has what they need, and without
    /// those of other levels.
    ///
    /// ```
    /// use softbox::effects::{Effects, Quality};
    ///
    /// let scene: Effects = "quad+ggx".parse()?;
    /// assert_eq!(Quality::Fine.of(scene).to_string(), "quad+ggx+second-lobe");
    /// assert_eq!(Quality::Standard.of(Quality::Finest.of(scene)), scene);
    /// assert_eq!(Quality::Fast.of(scene).to_string(), "quad+ggx+cheap-horizon,cheap-distance,table-free");
    /// // Diffuse surfaces have no lobe.
    /// assert_eq!(Quality::Finest.of("quad".parse()?).to_string(), "quad");
    /// # Ok::<(), softbox::effects::EffectsError>(())
    /// ```
    pub fn of(self, effects: Effects) -> Effects {
        let others = Self::ALL.iter().flat_map(|level| level.changes());
        let plain = others.fold(effects, |set, effect| set.without(*effect));
        if plain.is_empty() {
            return plain;
        }
        Effects::sustained(self.changes().iter().fold(plain.0, |bits, effect| bits | effect.bit()))
    }
}

impl core::fmt::Display for Quality {
    fn fmt(&self, formatter: &mut core::fmt::Formatter) -> core::fmt::Result {
        formatter.pad(self.name())
    }
}

impl core::str::FromStr for Quality {
    type Err = EffectsError;

    fn from_str(text: &str) -> Result<Self, EffectsError> {
        Self::ALL
            .into_iter()
            .find(|level| level.name() == text)
            .ok_or_else(|| EffectsError::Quality { text: text.to_owned() })
    }
}
