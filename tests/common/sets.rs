//! Sets of effects to try on a text.
#![allow(dead_code, reason = "each test file uses a part of this module")]

use softbox::effects::{Effect, Effects};

/// Most sets of a text that a test tries.
const MOST: usize = 40;

/// Every set of what a text has, or a choice of those where there are many: nothing, everything, everything but one
/// effect, one effect alone where it can be, and some from all over.
pub fn sets(include: &str) -> Vec<Effects> {
    let present = Effects::declared(include);
    let all: Vec<Effects> = Effects::every().filter(|effects| present.is_superset(*effects)).collect();
    if all.len() <= 4 * MOST {
        return all;
    }
    let mut chosen = vec![Effects::NONE, present];
    for effect in Effect::all().filter(|effect| present.contains(*effect)) {
        chosen.push(present.without(effect));
        chosen.extend(Effects::of(&[effect]));
    }
    let step = all.len() / (MOST - chosen.len().min(MOST - 8));
    chosen.extend(all.iter().skip(step / 2).step_by(step));
    chosen.sort_unstable();
    chosen.dedup();
    chosen
}

/// A text with the root functions that it lacks for the effects that it declares, so that a small text can stand in for
/// the include.
pub fn completed(include: &str) -> String {
    let mut text = include.to_owned();
    for (index, root) in Effects::declared(include).roots().into_iter().enumerate() {
        if !text.contains(&format!("fn {root}(")) {
            text.push_str(&format!(
                "\n/// A root.\nfn {root}(v: f32) -> f32 {{\n    return v * {index}.5;\n}}\n"
            ));
        }
    }
    text
}
