//! Sets of effects as text: `quad,disk+ggx,clearcoat+two-sided`.

use core::fmt::{Display, Formatter};
use core::str::FromStr;

use super::{Effect, Effects, EffectsError, Group};

/// The text of the empty set.
const NONE: &str = "none";

impl Display for Effects {
    /// Lights, surfaces and options with a plus sign between the three and commas within each; fit for a
    /// file's name. Lambert's law goes without saying where there is anything else.
    fn fmt(&self, formatter: &mut Formatter) -> core::fmt::Result {
        let said = |effect: &Effect| *effect != Effect::Lambert || self.len() == 1;
        let groups = [Group::Light, Group::Surface, Group::Option].map(|group| {
            let names = self.iter().filter(|effect| effect.entry().group == group).filter(said);
            names.map(Effect::name).collect::<Vec<_>>().join(",")
        });
        let groups: Vec<String> = groups.into_iter().filter(|names| !names.is_empty()).collect();
        formatter.pad(if groups.is_empty() { NONE.to_owned() } else { groups.join("+") }.as_str())
    }
}

impl FromStr for Effects {
    type Err = EffectsError;

    /// Reads names in any order, with commas or plus signs between them.
    fn from_str(text: &str) -> Result<Self, EffectsError> {
        if text.trim() == NONE {
            return Ok(Self::NONE);
        }
        let mut effects = Vec::new();
        for name in text.split([',', '+']).map(str::trim) {
            if name.is_empty() {
                return Err(EffectsError::Nameless { text: text.to_owned() });
            }
            let Some(effect) = Effect::all().find(|effect| effect.name() == name) else {
                let nearest = Effect::all()
                    .min_by_key(|effect| distance(&name.to_lowercase(), effect.name()))
                    .unwrap_or(Effect::Quad);
                return Err(EffectsError::Unknown { text: text.to_owned(), name: name.to_owned(), nearest });
            };
            effects.push(effect);
        }
        Self::of(&effects).map_err(|error| match error {
            EffectsError::Lacks { effect, .. } => EffectsError::Lacks { text: text.to_owned(), effect },
            other => other,
        })
    }
}

/// How many characters must be put in, left out or replaced to make one text of the other (Levenshtein 1966).
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(from != *to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}
