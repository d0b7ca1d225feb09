//! The page on hard cases in `docs/` is what the code makes, and what it says can be tried again.

use std::path::Path;

use softbox::effects::Quality;
use softbox::stability::page::{DOCUMENTED_COMMAND, Sheet, read_stacks};
use softbox::stability::{CATALOGUE, FamilyRow, Inputs, KNOWN, StackRow, summary};

fn docs(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs").join(name)
}

/// The rows that `tests/stacks/run` recorded, if it was ever run.
fn recorded() -> Vec<StackRow> {
    let path = docs("stacks.jsonl");
    if !path.exists() {
        return Vec::new();
    }
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    read_stacks(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn the_page_is_what_the_code_makes() {
    let sheet = Sheet::documented(recorded());
    for (name, text) in sheet.documents() {
        let kept = std::fs::read_to_string(docs(&name)).unwrap_or_default();
        let differs = kept.lines().zip(text.lines()).position(|(kept, text)| kept != text);
        let differs = differs.unwrap_or(kept.lines().count().min(text.lines().count()));
        assert!(
            kept == text,
            "docs/{name} differs from line {}:\n{:?}, where the code makes\n{:?}\n`{DOCUMENTED_COMMAND}` writes it anew",
            differs + 1,
            kept.lines().nth(differs),
            text.lines().nth(differs)
        );
    }
    for level in &sheet.levels {
        assert_eq!(summary(&level.inputs, &level.runs, 1.0), None);
    }
}

#[test]
fn the_page_holds_every_family_and_every_known_case() {
    let page = std::fs::read_to_string(docs("stability.md")).expect("docs/stability.md");
    for family in CATALOGUE {
        assert!(page.contains(&format!("<b>{}</b>: {}", family.name, family.about)), "{}", family.name);
    }
    for case in KNOWN {
        assert!(page.contains(case.name) && page.contains(case.symptom), "{}", case.name);
    }
    for row in recorded() {
        assert!(page.contains(&row.driver) && page.contains(&row.version), "{row:?}");
    }
}

/// Rows say of each family what the check of the bounds says.
#[test]
fn rows_agree_with_the_check_of_bounds() {
    for level in Quality::ALL {
        let inputs = Inputs::of(level, 2);
        let mut values = inputs.twin();
        for broken in [false, true] {
            if broken {
                for value in values.iter_mut().step_by(7) {
                    value[0] *= 1.01;
                    value[1] *= 0.9;
                }
                values[11] = [f32::NAN; 3];
            }
            let outcomes = inputs.outcomes(&values);
            let rows: Vec<FamilyRow> = inputs.families(&values);
            assert_eq!(rows.len(), outcomes.len());
            for row in &rows {
                let outcome = &outcomes[row.family];
                let same = |a: f64, b: f64| a == b || (a.is_nan() && b.is_nan());
                let share = row.worst.map_or(0.0, |worst| worst.share);
                assert!(same(share, outcome.share), "{level}: {row:?} and {outcome:?}");
                if !share.is_nan() {
                    let specular = row.specular_worst.map_or(0.0, |worst| worst.share);
                    assert!(same(specular, outcome.specular_share), "{level}: {row:?} and {outcome:?}");
                }
                assert_eq!((row.inputs, row.beyond), (outcome.count, outcome.offenders.len()));
            }
            let beyond: usize = rows.iter().map(|row| row.beyond).sum();
            assert_eq!(beyond > 100, broken, "{level}: {beyond} beyond");
            assert_eq!(rows.iter().map(|row| row.not_finite).sum::<usize>(), usize::from(broken));
        }
    }
}
