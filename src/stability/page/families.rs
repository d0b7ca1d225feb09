//! The families: bounds, worst errors, and the inputs that gave them.

use super::{LevelSheet, Sheet, table};
use crate::effects::Quality;
use crate::stability::text::{part, short};
use crate::stability::{CATALOGUE, FamilyRow, Inputs, PARTS, Run, Worst};

/// Lights in the order of the page.
const LIGHTS: [&str; 5] = ["quads and polygons", "disks and ellipses", "spheres", "tubes", "several lights"];

/// Points of a light beyond which its input is not printed.
const MOST_POINTS: usize = 24;

pub(super) fn section(sheet: &Sheet) -> String {
    let exact = |level: &&LevelSheet| level.inputs.level == Quality::Standard;
    let Some(standard) = sheet.levels.iter().find(exact) else { return String::new() };
    let Some(run) = standard.runs.first() else { return String::new() };
    let mut text = format!(
        "\n## The catalogue\n\n{} inputs at `standard`, by the include's twin on the CPU in single precision. _Share_ is the part of its own bound \
         that an input used at most; errors are the largest of the family, whatever the input's bound. Specular is for F = 1, \
         or half the error of Schlick's part.\n",
        run.stack.inputs
    );
    for lights in LIGHTS {
        let rows: Vec<&FamilyRow> = run.families.iter().filter(|row| row.lights == lights).collect();
        if rows.is_empty() {
            continue;
        }
        let title = lights[..1].to_uppercase() + &lights[1..];
        text += &format!("\n### {title}\n\n{}", family_table(&rows));
        text += &details(&standard.inputs, run, &rows);
    }
    text += "\n### Every level\n\nShares of the bounds that hold at each level, of the form factor / of specular light; a dash where only physics bounds a value, \
             and it is physical.\n\n";
    text + &level_table(sheet)
}

fn family_table(rows: &[&FamilyRow]) -> String {
    let error = |worst: Option<Worst>, error: f64| worst.map_or("—".to_owned(), |_| short(error));
    let share = |worst: Option<Worst>| worst.map_or("—".to_owned(), |worst| part(worst.share));
    let line = |row: &&FamilyRow| {
        let entry = row.entry();
        let about = entry.map_or("", |family| family.about);
        let met = entry.map_or("", |family| family.met);
        vec![
            format!("<b>{}</b>: {about}", row.family),
            met.to_owned(),
            row.inputs.to_string(),
            row.bounds.words(),
            error(row.worst, row.error),
            share(row.worst),
            row.specular_bounds.words(),
            error(row.specular_worst, row.specular_error),
            share(row.specular_worst),
        ]
    };
    let head = [
        "family",
        "met in",
        ">inputs",
        "form factor within",
        ">worst",
        ">share",
        "specular within",
        ">worst",
        ">share",
    ];
    table(&head, rows.iter().map(line))
}

/// The inputs that came closest to their bounds, to be tried again.
fn details(inputs: &Inputs, run: &Run, rows: &[&FamilyRow]) -> String {
    let mut text = "\n<details><summary>The inputs that came closest to their bounds</summary>\n\n\
                    Lines for `softbox eval`, which takes convex quads by `ltc_quad`; every number is exact in single precision.\n\n"
        .to_owned();
    for row in rows {
        let parts = [(PARTS[0], row.worst), (PARTS[1], row.specular_worst)];
        for (name, worst) in parts {
            let Some(worst) = worst.filter(|worst| worst.share > 0.0) else { continue };
            let (case, value) = (&inputs.cases[worst.index], run.values[worst.index]);
            text += &format!(
                "- {}, {name}: {} of {}, by `{}`, values {}\n",
                row.family,
                short(worst.error),
                short(worst.bound),
                case.shape.function(),
                value.map(|number| short(number.into())).join(", ")
            );
            text += &match case.shape.vertices().len() {
                0..=MOST_POINTS => format!("  ```json\n  {}\n  ```\n", case.line()),
                count => format!(
                    "  {count} vertices: input {} of `stability::cases({})`\n",
                    worst.index,
                    super::DOCUMENTED_CASES
                ),
            };
        }
    }
    text + "\n</details>\n"
}

fn level_table(sheet: &Sheet) -> String {
    let mut head = vec!["family".to_owned()];
    head.extend(sheet.levels.iter().map(|level| format!(">{}", level.inputs.level)));
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    let share = |worst: Option<Worst>| worst.map_or("—".to_owned(), |worst| part(worst.share));
    let cell = |level: &LevelSheet, name: &str| {
        let row = level.runs.first()?.families.iter().find(|row| row.family == name)?;
        Some(match row.beyond {
            0 => format!("{} / {}", share(row.worst), share(row.specular_worst)),
            beyond => format!("{beyond} beyond"),
        })
    };
    let rows = CATALOGUE.iter().map(|family| {
        let cells = sheet.levels.iter().map(|level| cell(level, family.name).unwrap_or_default());
        std::iter::once(family.name.to_owned()).chain(cells).collect()
    });
    table(&head, rows)
}
