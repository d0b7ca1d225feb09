//! Sets of effects that make no sense.

use super::{Effect, Effects};

/// Why a set of effects is refused: one sentence that names it, what is wrong, and what would be right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EffectsError {
    /// A name that no effect has.
    Unknown {
        /// The whole text.
        text: String,
        /// The name.
        name: String,
        /// The effect whose name is nearest.
        nearest: Effect,
    },
    /// A name that no quality level has.
    Quality {
        /// The name.
        text: String,
    },
    /// Two separators without a name between them, or no text at all.
    Nameless {
        /// The whole text.
        text: String,
    },
    /// An effect without any of those that give it a meaning.
    Lacks {
        /// The whole text.
        text: String,
        /// The effect.
        effect: Effect,
    },
    /// An effect that this text of the include does not have.
    Absent {
        /// The whole set.
        effects: Effects,
        /// The effect.
        effect: Effect,
        /// What the text has.
        present: Effects,
    },
    /// A text that is no include: a function that an effect is there for is missing.
    Broken {
        /// The effect.
        effect: Effect,
        /// The function.
        function: &'static str,
    },
    /// A text that is no shader.
    Malformed {
        /// The line, counted from 1.
        line: usize,
        /// What is wrong there and what would be right.
        reason: &'static str,
    },
}

impl EffectsError {
    pub(super) fn needs(effect: Effect, effects: &[Effect]) -> Self {
        let text = effects.iter().map(|effect| effect.name()).collect::<Vec<_>>().join(",");
        Self::Lacks { text, effect }
    }

    pub(super) fn absent(effects: Effects, effect: Effect, present: Effects) -> Self {
        Self::Absent { effects, effect, present }
    }
}

impl core::fmt::Display for EffectsError {
    fn fmt(&self, formatter: &mut core::fmt::Formatter) -> core::fmt::Result {
        match self {
            Self::Unknown { text, name, nearest } => {
                let names: Vec<_> = Effect::all().map(Effect::name).collect();
                write!(
                    formatter,
                    "the set of effects {text:?} names {name:?}, which is none; the nearest is {:?}, all are {}",
                    nearest.name(),
                    names.join(", ")
                )
            }
            Self::Quality { text } => {
                let names: Vec<_> = super::Quality::ALL.iter().map(|level| level.name()).collect();
                write!(formatter, "the quality level {text:?} does not exist; all are {}", names.join(", "))
            }
            Self::Nameless { text } => write!(
                formatter,
                "the set of effects {text:?} lacks a name; write names with commas or plus signs between \
                 them, such as \"quad,polygon+ggx+two-sided\", or \"none\""
            ),
            Self::Lacks { text, effect } => {
                let needs: Vec<_> = effect.entry().needs.iter().map(|need| need.name()).collect();
                write!(
                    formatter,
                    "the set of effects {text:?} has {:?}, which means nothing without {}; add that or leave it out",
                    effect.name(),
                    needs.join(" or ")
                )
            }
            Self::Absent { effects, effect, present } => write!(
                formatter,
                "the set of effects \"{effects}\" has {:?}, which this include does not have; it has \"{present}\"",
                effect.name()
            ),
            Self::Malformed { line, reason } => {
                write!(formatter, "line {line} of the include {reason}")
            }
            Self::Broken { effect, function } => write!(
                formatter,
                "the include lacks {function}, which the effect {:?} is there for; declare it or correct the \
                 effect's line in the table",
                effect.name()
            ),
        }
    }
}

impl core::error::Error for EffectsError {}
