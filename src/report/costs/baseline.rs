//! What costs must not grow beyond.
//!
//! Counts of operations are the same everywhere, so they are compared everywhere. What a compiler makes of a kernel is compared
//! with what the same version of it made before, and only with that: a file holds a list for each version that anyone has
//! measured with.

use serde::{Deserialize, Serialize};

use super::Costs;

/// By how much of itself a figure may grow.
pub const TOLERANCE: f64 = 0.02;

/// A figure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figure {
    /// The method's name.
    pub method: String,
    /// What is measured, as in [`CostRow`](crate::report::data::CostRow), with the stage.
    pub measure: String,
    /// How much.
    pub value: f64,
}

/// What one version of a compiler made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Compiled {
    /// The version.
    pub compiler: String,
    /// The figures.
    pub figures: Vec<Figure>,
}

/// What costs must not grow beyond.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Baseline {
    /// Operations executed; no compiler has a say in them.
    #[serde(default)]
    pub executed: Vec<Figure>,
    /// What compilers make, by version.
    #[serde(default)]
    pub compiled: Vec<Compiled>,
}

/// Why costs are not what they were.
#[derive(Debug, thiserror::Error)]
pub enum BaselineError {
    /// The file does not read.
    #[error("the baseline does not read: {0}")]
    Unreadable(String),
    /// Nobody has measured with this compiler.
    #[error(
        "the baseline has no figures of {found}, but of {known}: figures of different compilers do not compare. `{update}` adds those of {found}; do so at a commit whose costs are known to be good"
    )]
    OtherCompiler {
        /// The compiler that is here.
        found: String,
        /// Those of the baseline.
        known: String,
        /// The command that adds it.
        update: String,
    },
    /// Some figures have grown, or are missing.
    #[error("{list}\nIf that is meant, `{update}` makes these the baseline")]
    Grown {
        /// A line for each.
        list: String,
        /// The command that accepts them.
        update: String,
    },
}

impl Baseline {
    /// The figures of some costs that it keeps: operations executed, and instructions, vector registers and inverse throughput as
    /// compiled by `compiler`.
    pub fn of(costs: &Costs, compiler: &str) -> Self {
        let figures = |names: &[&str]| -> Vec<Figure> {
            let kept = costs.rows.iter().filter(|row| names.iter().any(|name| row.measure.ends_with(name)));
            kept.map(|row| Figure {
                method: row.method.clone(),
                measure: if row.stage == "any" {
                    row.measure.clone()
                } else {
                    format!("{}, {}", row.measure, row.stage)
                },
                value: (row.value * 10.0).round() / 10.0,
            })
            .collect()
        };
        let compiled = Compiled {
            compiler: compiler.to_owned(),
            figures: figures(&[" instructions", " vector registers", " inverse throughput"]),
        };
        let executed = figures(&["executed mean", "executed wave", "executed worst"]);
        Self { executed, compiled: if compiled.figures.is_empty() { Vec::new() } else { vec![compiled] } }
    }

    /// Reads a baseline from TOML.
    ///
    /// # Errors
    ///
    /// If the text is none, or a figure of it is not a number from 0 on.
    pub fn read(text: &str) -> Result<Self, BaselineError> {
        let baseline: Self = toml::from_str(text).map_err(|error| {
            let line = error.span().map_or(1, |span| 1 + text[..span.start].matches('\n').count());
            let reason = error.message().lines().collect::<Vec<_>>().join(", ");
            BaselineError::Unreadable(format!("line {line}: {reason}"))
        })?;
        let compiled = baseline.compiled.iter().flat_map(|compiled| &compiled.figures);
        // Nothing is more than what is not a number, so such a figure would hide any growth.
        match baseline
            .executed
            .iter()
            .chain(compiled)
            .find(|figure| !(0.0..f64::INFINITY).contains(&figure.value))
        {
            Some(Figure { method, measure, value }) => Err(BaselineError::Unreadable(format!(
                "{method}, {measure} is {value}, and a cost is a number from 0 on"
            ))),
            None => Ok(baseline),
        }
    }

    /// The baseline as TOML.
    ///
    /// # Errors
    ///
    /// If a figure is not a number.
    pub fn write(&self) -> Result<String, BaselineError> {
        toml::to_string(self).map_err(|error| BaselineError::Unreadable(error.to_string()))
    }

    /// This baseline with the figures of `now` in the place of its own; those of other compilers stay.
    pub fn updated(mut self, now: Self) -> Self {
        self.executed = now.executed;
        for compiled in now.compiled {
            self.compiled.retain(|old| old.compiler != compiled.compiler);
            self.compiled.push(compiled);
        }
        self.compiled.sort_by(|a, b| a.compiler.cmp(&b.compiler));
        self
    }

    /// Asserts that no figure of `now` is more than [`TOLERANCE`] above this baseline's, and that each has one here. `update` is the
    /// command that makes them the baseline.
    ///
    /// # Errors
    ///
    /// If one is not, with both figures.
    pub fn check(&self, now: &Self, update: &str) -> Result<(), BaselineError> {
        let mut lines = grown(&self.executed, &now.executed);
        for compiled in &now.compiled {
            let Some(old) = self.compiled.iter().find(|old| old.compiler == compiled.compiler) else {
                let known: Vec<_> = self.compiled.iter().map(|old| old.compiler.as_str()).collect();
                return Err(BaselineError::OtherCompiler {
                    found: compiled.compiler.clone(),
                    known: known.join(" and "),
                    update: update.to_owned(),
                });
            };
            lines.extend(grown(&old.figures, &compiled.figures));
        }
        if lines.is_empty() {
            return Ok(());
        }
        Err(BaselineError::Grown { list: lines.join("\n"), update: update.to_owned() })
    }
}

/// A line for each figure that is more than it was, is new, or is gone.
fn grown(before: &[Figure], now: &[Figure]) -> Vec<String> {
    let same = |a: &Figure, b: &Figure| a.method == b.method && a.measure == b.measure;
    let mut lines = Vec::new();
    for figure in now {
        let name = format!("{}, {}", figure.method, figure.measure);
        match before.iter().find(|old| same(old, figure)) {
            None => lines.push(format!("{name}: {}, not in the baseline", figure.value)),
            // Not the other way round: what is not a number has grown.
            Some(old) if figure.value <= old.value * (1.0 + TOLERANCE) => {}
            Some(old) => {
                let percent = 100.0 * (figure.value / old.value - 1.0);
                lines.push(format!("{name}: {} was {} ({percent:+.1} %)", figure.value, old.value));
            }
        }
    }
    let gone = before.iter().filter(|old| !now.iter().any(|figure| same(old, figure)));
    lines.extend(gone.map(|old| format!("{}, {}: not measured, was {}", old.method, old.measure, old.value)));
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn baseline(compiler: &str, value: f64) -> Baseline {
        let figure =
            |measure: &str| Figure { method: "standard".to_owned(), measure: measure.to_owned(), value };
        let compiled = Compiled { compiler: compiler.to_owned(), figures: vec![figure("instructions")] };
        Baseline { executed: vec![figure("executed mean")], compiled: vec![compiled] }
    }

    #[test]
    fn growth_beyond_the_tolerance_fails_with_both_figures_and_the_way_out() {
        let old = baseline("one", 1000.0);
        assert!(old.check(&baseline("one", 1020.0), "update").is_ok());
        assert!(old.check(&baseline("one", 500.0), "update").is_ok());
        let error = old.check(&baseline("one", 1021.0), "update it").err().map(|error| error.to_string());
        let error = error.unwrap_or_default();
        for part in ["instructions", "executed mean", "1021", "1000", "+2.1 %", "update it"] {
            assert!(error.contains(part), "{part} is not in: {error}");
        }
    }

    #[test]
    fn figures_of_another_compiler_are_not_compared_but_added() {
        let old = baseline("one", 1000.0);
        let other = baseline("two", 10.0);
        let error = old.check(&other, "update it").err().map(|error| error.to_string()).unwrap_or_default();
        assert!(
            error.contains("of two") && error.contains("of one") && error.contains("update it"),
            "{error}"
        );
        let both = old.updated(other.clone());
        assert!(both.compiled.len() == 2 && both.check(&other, "").is_ok());
        let text = both.write().unwrap_or_default();
        assert_eq!(Baseline::read(&text).ok(), Some(both), "{text}");
    }

    #[test]
    fn a_figure_that_is_no_number_hides_no_growth() {
        for value in ["nan", "inf", "-1.0"] {
            let text = format!("[[executed]]\nmethod = \"a\"\nmeasure = \"b\"\nvalue = {value}\n");
            let error = Baseline::read(&text).expect_err(value).to_string();
            assert!(error.contains("a, b is"), "{error}");
        }
        let error = Baseline::read("executed = 1").expect_err("no list").to_string();
        assert!(error.contains("line 1") && !error.contains('\n'), "{error}");
        assert!(baseline("one", 1000.0).check(&baseline("one", f64::NAN), "").is_err());
    }

    #[test]
    fn a_method_that_is_no_longer_measured_is_told() {
        let mut now = baseline("one", 1000.0);
        now.executed.clear();
        let error = baseline("one", 1000.0).check(&now, "").err().map(|error| error.to_string());
        assert!(
            error.as_ref().is_some_and(|error| error.contains("executed mean: not measured")),
            "{error:?}"
        );
    }
}
