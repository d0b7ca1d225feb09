//! The table of the catalogue on a terminal, and numbers as the tables write them.

use super::{Bounds, FamilyRow, Inputs, Run};

/// A number in two digits, `2e-6`, `3.7e-7` and `0.05`; 0 as it is.
pub(super) fn short(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        _ if (0.01..1.0).contains(&value) => format!("{value:.2}"),
        _ if (1.0..100.0).contains(&value) => format!("{value:.1}").trim_end_matches(".0").to_owned(),
        _ => format!("{value:.1e}").replacen(".0e", "e", 1),
    }
}

/// A part of a bound, two digits after the point.
pub(super) fn part(share: f64) -> String {
    match share {
        _ if share > 0.0 && share < 0.01 => "< 0.01".to_owned(),
        _ if share < 1000.0 => format!("{share:.2}"),
        _ => short(share),
    }
}

impl Bounds {
    /// The bounds in a few words: `2e-6 to 1e-3`, `exactly 0`, `physical` where physics alone is one.
    pub fn words(&self) -> String {
        let range = |[low, high]: [f64; 2]| {
            let [low, high] = [short(low), short(high)];
            if low == high { low } else { format!("{low} to {high}") }
        };
        let mut words: Vec<String> = self.absolute.map(range).into_iter().collect();
        words.extend(self.relative.map(|bounds| format!("{} of the value", range(bounds))));
        words.extend((self.zero > 0).then(|| "exactly 0".to_owned()));
        words.extend((self.physical > 0).then(|| "physical".to_owned()));
        words.join(", ")
    }
}

/// What no reading of a table leaves out: the row of a family on a stack, in a word.
fn verdict(row: &FamilyRow) -> String {
    if row.not_finite > 0 {
        "NOT FINITE".to_owned()
    } else if row.beyond > 0 {
        format!("{} BEYOND", row.beyond)
    } else if row.worst.is_none() && row.specular_worst.is_none() {
        "holds".to_owned()
    } else {
        part(row.share())
    }
}

/// The runs of a level as a table of text: a line for each family, a column for each stack with the part of the bounds that it uses.
/// Errors are those of the stack that errs most.
pub fn table_text(inputs: &Inputs, runs: &[Run]) -> String {
    let mut head = vec!["family", "inputs", "worst error", "bound", "specular", "bound"]
        .into_iter()
        .map(str::to_owned)
        .collect::<Vec<_>>();
    head.extend(runs.iter().map(|run| run.stack.driver.clone()));
    let mut lines = vec![head];
    let families = runs.first().map_or(0, |run| run.families.len());
    for index in 0..families {
        let rows: Vec<&FamilyRow> = runs.iter().map(|run| &run.families[index]).collect();
        let most = |error: &dyn Fn(&FamilyRow) -> Option<f64>| {
            let errors = rows.iter().filter_map(|row| error(row));
            errors.reduce(|a, b| if a >= b { a } else { b }).map_or("-".to_owned(), short)
        };
        let mut line = vec![
            rows[0].family.to_owned(),
            rows[0].inputs.to_string(),
            most(&|row| row.worst.map(|_| row.error)),
            rows[0].bounds.words(),
            most(&|row| row.specular_worst.map(|_| row.specular_error)),
            rows[0].specular_bounds.words(),
        ];
        line.extend(rows.iter().map(|row| verdict(row)));
        lines.push(line);
    }
    let widths: Vec<usize> = (0..lines[0].len())
        .map(|column| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0))
        .collect();
    let text = lines.iter().map(|line| {
        let cells = line.iter().zip(&widths).enumerate().map(|(column, (cell, width))| match column {
            0 | 3 | 5 => format!("{cell:width$}"),
            _ => format!("{cell:>width$}"),
        });
        cells.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    });
    let mut text: Vec<String> = text.collect();
    text.push(String::new());
    text.extend(runs.iter().map(|run| {
        format!(
            "{}: {} of {} cases of {} beyond their bounds, {} not finite; {} ({})",
            run.stack.driver,
            run.stack.beyond,
            run.stack.inputs,
            inputs.level,
            run.stack.not_finite,
            run.stack.path,
            run.stack.version
        )
    }));
    text.join("\n")
}

/// What is wrong with runs, in one sentence: values beyond bounds or physics, or shares of bounds above `limit`; nothing if all is well.
pub fn summary(inputs: &Inputs, runs: &[Run], limit: f64) -> Option<String> {
    let rows = || runs.iter().flat_map(|run| run.families.iter().map(move |row| (run, row)));
    // Written so that what is not a number is reported.
    let wrong = |row: &FamilyRow| row.beyond > 0 || !(row.share() <= limit || row.worst.is_none());
    let (run, row) = rows().find(|(_, row)| wrong(row))?;
    let count = rows().filter(|(_, row)| wrong(row)).count();
    let what = match row.beyond {
        0 => format!("uses {} of its bound, more than {limit}", part(row.share())),
        beyond => format!("has {beyond} of {} cases beyond their bounds", row.inputs),
    };
    let others = match count {
        1 => String::new(),
        _ => format!(", and {} more", count - 1),
    };
    Some(format!("at {} on {}, the family {:?} {what}{others}", inputs.level, run.stack.driver, row.family))
}

/// For each of the first cases of a family that are beyond their bounds: stack, values, what they ought to be, and the input as a line
/// that `softbox eval` reads.
pub fn beyond_lines(inputs: &Inputs, runs: &[Run]) -> Vec<String> {
    const FIRST: usize = 3;
    let mut lines = Vec::new();
    for run in runs.iter().filter(|run| run.stack.beyond > 0) {
        for (family, outcome) in inputs.outcomes(&run.values) {
            for &index in outcome.offenders.iter().take(FIRST) {
                let case = &inputs.cases[index];
                lines.push(format!(
                    "{}, {}, {family}: {} gives {:?}, exact {:?}, form factor within {:?}, specular within {}; {}",
                    run.stack.driver,
                    inputs.level,
                    case.shape.function(),
                    run.values[index],
                    inputs.exact()[index],
                    case.bound,
                    short(case.specular_bound),
                    case.line()
                ));
            }
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_two_digits() {
        let cases = [
            (0.0, "0"),
            (2e-6, "2e-6"),
            (3.66e-7, "3.7e-7"),
            (0.05, "0.05"),
            (1.0, "1"),
            (7.44, "7.4"),
            (20.0, "20"),
            (1e6, "1e6"),
            (f64::NAN, "NaN"),
        ];
        for (value, text) in cases {
            assert_eq!(short(value), text);
        }
        assert_eq!([0.0, 0.004, 0.5, 5e4].map(part), ["0.00", "< 0.01", "0.50", "5e4"]);
        assert_eq!(part(f64::NAN), "NaN");
    }

    #[test]
    fn bounds_in_words() {
        let mut bounds = Bounds::default();
        assert_eq!(bounds.words(), "");
        (bounds.absolute, bounds.zero) = (Some([1e-6, 1e-3]), 2);
        assert_eq!(bounds.words(), "1e-6 to 1e-3, exactly 0");
        bounds = Bounds { relative: Some([1e-4; 2]), physical: 1, ..Bounds::default() };
        assert_eq!(bounds.words(), "1e-4 of the value, physical");
    }
}
