//! Sets of effects as text, and shader text.

use softbox::effects::{self, Effects, EffectsError, Quality};

use super::assert_sentence;
use super::bytes::Bytes;

/// The text of a set, or the name of a level: what it means, in a canonical form that means the same, or a sentence.
pub fn effects(data: &[u8]) {
    let Ok(text) = core::str::from_utf8(data) else { return };
    match text.parse::<Effects>() {
        Ok(set) => {
            assert_eq!(set.to_string().parse(), Ok(set), "{text:?}");
            for level in Quality::ALL {
                let leveled = level.of(set);
                assert_eq!(leveled.to_string().parse(), Ok(leveled), "{text:?} at {level}");
            }
            assert!(effects::wgsl(set).is_ok(), "{text:?}");
        }
        Err(error) => assert_sentence(&error),
    }
    if let Err(error) = text.parse::<Quality>() {
        assert_sentence(&error);
    }
}

/// Any text in the place of the include, and a set that the first four bytes tell: less text, or a sentence.
pub fn source(data: &[u8]) {
    let mut bytes = Bytes(data);
    let mut set = Effects::NONE;
    let bits = u32::from_le_bytes([bytes.byte(), bytes.byte(), bytes.byte(), bytes.byte()]);
    for (index, effect) in effects::Effect::all().enumerate() {
        if bits >> index & 1 == 1 {
            set = set | Effects::of(&[effect]).unwrap_or(Effects::NONE);
        }
    }
    let Ok(text) = core::str::from_utf8(bytes.0) else { return };
    // A text that declares every switch of the set and all of its functions, so that what comes first is read.
    let roots: Vec<String> = set
        .iter()
        .flat_map(|effect| effect.entry().roots.iter().chain(effect.entry().lobe_roots))
        .map(|root| format!("fn {root}() {{ body(); }}\n"))
        .collect();
    let switches: Vec<String> = effects::Effect::all()
        .filter(|effect| !effect.entry().switch.is_empty())
        .map(|effect| format!("override {}: bool = true;\n", effect.entry().switch))
        .collect();
    for whole in [text.to_owned(), format!("{}\n{text}\n{}", switches.concat(), roots.concat())] {
        match effects::wgsl_from(&whole, set) {
            Ok(selected) => assert!(selected.len() <= 2 * whole.len() + 4096, "text from nowhere"),
            Err(error) => {
                let _: &EffectsError = &error;
                assert_sentence(&error);
            }
        }
    }
}
