//! Sets of effects, their texts, and the include's text by them.

#[path = "common/sets.rs"]
mod sets;

use std::collections::BTreeSet;

use softbox::effects::{self, Effect, Effects, EffectsError, Group};

fn set(text: &str) -> Effects {
    text.parse().unwrap_or_else(|error| panic!("{text}: {error}"))
}

#[test]
fn every_set_is_read_back_from_its_text() {
    let mut texts = BTreeSet::new();
    for effects in Effects::every() {
        let text = effects.to_string();
        assert_eq!(text.parse(), Ok(effects), "{text}");
        let mut names: Vec<&str> = text.split(['+', ',']).collect();
        names.reverse();
        assert_eq!(names.join(",").parse(), Ok(effects), "{text} from its end");
        assert!(
            text.chars().all(|c| c.is_ascii_lowercase() || "+,-".contains(c)),
            "{text} is no name for a file"
        );
        assert!(texts.insert(text.clone()), "{text} stands for two sets");
    }
    println!("{} sets", texts.len());
}

/// The rules, written out by hand.
#[test]
fn sets_are_counted() {
    let mut count = 1; // the empty one
    for bits in 0_u32..1 << 19 {
        let has = |bit: u32| bits & (1 << bit) != 0;
        let [quad, polygon, disk, _sphere, tube, textured] = [0, 1, 2, 3, 4, 5].map(has);
        let [ggx, clearcoat, _sheen, _rough, energy, anisotropic] = [6, 7, 8, 9, 10, 11].map(has);
        let [two_sided, caps, horizon, distance, table_free, second, third] =
            [12, 13, 14, 15, 16, 17, 18].map(has);
        let lights = quad || !textured;
        let surfaces = (ggx || !(clearcoat || energy || anisotropic || second)) && (second || !third);
        let options = (quad || polygon || disk || !two_sided) && (tube || !caps);
        let cheap = (quad || polygon || !(horizon || distance)) && (ggx || !table_free);
        count += usize::from(lights && surfaces && options && cheap);
    }
    assert_eq!(Effects::every().count(), count);
    let present = Effects::present();
    println!(
        "{count} sets, {} of them in the include",
        Effects::every().filter(|set| present.is_superset(*set)).count()
    );
}

#[test]
fn switches_stand_as_the_table_says() {
    for effect in Effect::all().filter(|effect| !effect.entry().switch.is_empty()) {
        let declared = format!("override {}: bool = {};", effect.entry().switch, effect.is_default());
        assert!(softbox::WGSL_INCLUDE.contains(&declared), "{declared}");
    }
}

#[test]
fn the_table_is_in_order() {
    let groups: Vec<Group> = Effect::all().map(|effect| effect.entry().group).collect();
    assert!(groups.is_sorted(), "{groups:?}");
    let mut names = BTreeSet::new();
    for (index, effect) in Effect::all().enumerate() {
        let entry = effect.entry();
        assert_eq!(effect as usize, index, "{effect:?}");
        assert!(names.insert(entry.name), "{} names two effects", entry.name);
        assert!(!entry.needs.contains(&effect), "{effect:?} needs itself");
        let switch = format!("ltc_use_{}", entry.name.replace('-', "_"));
        assert!(entry.switch.is_empty() || entry.switch == switch, "{}: {}", entry.name, entry.switch);
    }
}

#[test]
fn sets_have_the_algebra_of_sets() {
    let all = Effects::all();
    assert_eq!(Effects::NONE.iter().count(), 0);
    assert_eq!(set("none"), Effects::NONE);
    assert_eq!(Effects::of(&[Effect::Quad]), Ok(set("quad")));
    assert!(set("quad").contains(Effect::Lambert));
    let some: Vec<Effects> = Effects::every().step_by(97).collect();
    for a in &some {
        assert!(all.is_superset(*a) && a.is_superset(Effects::NONE), "{a}");
        assert_eq!(*a | Effects::NONE, *a);
        assert_eq!(*a - *a, Effects::NONE, "{a}");
        assert_eq!(a.iter().count(), a.len(), "{a}");
        for b in &some {
            let (either, both, rest) = (*a | *b, *a & *b, *a - *b);
            assert!(either.is_superset(*a) && either.is_superset(*b), "{a} or {b}: {either}");
            assert!(a.is_superset(both) && b.is_superset(both), "{a} and {b}: {both}");
            assert!(a.is_superset(rest), "{a} less {b}: {rest}");
            for result in [either, both, rest] {
                // Reading a text checks that everything has what it needs.
                assert_eq!(result.to_string().parse(), Ok(result), "from {a} and {b}");
            }
        }
    }
    assert_eq!(set("tube,quad+caps,two-sided").without(Effect::Tube), set("quad+two-sided"));
    assert_eq!(set("quad+ggx,clearcoat").without(Effect::Ggx), set("quad"));
}

#[test]
fn what_makes_no_sense_is_refused_in_one_sentence() {
    for (text, says) in [
        ("quda", ["\"quda\"", "nearest is \"quad\""]),
        ("quad+GGX", ["\"quad+GGX\"", "nearest is \"ggx\""]),
        ("quad+clear-coat", ["\"clear-coat\"", "nearest is \"clearcoat\""]),
        ("quad,,disk", ["\"quad,,disk\"", "or \"none\""]),
        ("", ["\"\"", "or \"none\""]),
        ("quad+", ["\"quad+\"", "or \"none\""]),
        ("ggx+two-sided", ["\"two-sided\"", "without quad or polygon or disk"]),
        ("sphere+caps", ["\"caps\"", "without tube"]),
        ("disk,textured", ["\"textured\"", "without quad"]),
        ("quad+clearcoat", ["\"clearcoat\"", "without ggx"]),
    ] {
        let error = text.parse::<Effects>().expect_err(text).to_string();
        for part in says {
            assert!(error.contains(part), "{text}: {error}");
        }
        assert!(!error.contains('\n') && !error.ends_with('.'), "{text}: {error}");
    }
    assert_eq!(
        Effects::of(&[Effect::Caps]),
        Err(EffectsError::Lacks { text: "caps".to_owned(), effect: Effect::Caps })
    );
}

#[test]
fn everything_is_the_include_itself() {
    let text = effects::wgsl(Effects::present()).unwrap_or_else(|error| panic!("{error}"));
    let whole = softbox::WGSL_INCLUDE.replace("bool = false;", "bool = true;");
    assert!(text == whole, "something in the include is reached from no effect");
}

#[test]
fn nothing_is_the_contract_alone() {
    let text = effects::wgsl(Effects::NONE).unwrap_or_else(|error| panic!("{error}"));
    assert!(text.lines().all(|line| line.starts_with("//")), "{text}");
    assert!(softbox::WGSL_INCLUDE.starts_with(&text));
}

/// Lines that no part of the include has, are switches that are decided.
#[test]
fn a_part_of_the_include_is_its_own_text() {
    let own: BTreeSet<&str> = softbox::WGSL_INCLUDE.lines().map(str::trim).collect();
    let present = Effects::present();
    for effects in sets::sets(softbox::WGSL_INCLUDE) {
        let text = effects::wgsl(effects).unwrap_or_else(|error| panic!("{effects}: {error}"));
        for line in text.lines().map(str::trim) {
            assert!(
                own.contains(line) || line.ends_with(": bool = false;") || line.ends_with(": bool = true;"),
                "{effects}: {line}"
            );
        }
        assert_eq!(effects::wgsl_from(&text, effects).as_ref(), Ok(&text), "{effects} twice");
        for effect in effects.iter() {
            for root in effect.entry().roots {
                assert!(text.contains(&format!("fn {root}(")), "{effects} lacks {root}");
            }
        }
        assert!(effects == present || text.len() < softbox::WGSL_INCLUDE.len(), "{effects}");
    }
}

#[test]
fn what_the_include_lacks_is_refused() {
    let error = effects::wgsl_from("fn ltc_surface() {}\n", set("quad")).expect_err("no quads").to_string();
    assert!(error.contains("\"quad\"") && error.contains("does not have"), "{error}");
    let error =
        effects::wgsl_from("override ltc_use_quad: bool = true;\n", set("quad")).expect_err("no functions");
    assert_eq!(error, EffectsError::Broken { effect: Effect::Quad, function: "ltc_quad" });
}
