//! Times that another run measured, read back.

use std::collections::BTreeSet;

use super::Measured;

/// Nanoseconds and ratios that any device could take: beyond them charts would show nothing.
const PLAUSIBLE: core::ops::RangeInclusive<f64> = 1e-9..=1e12;

/// Why a text holds no times.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeasuredError {
    /// It is not what `softbox report --gpu` writes.
    #[error("it holds no times that `softbox report --gpu` wrote: {0}")]
    Unreadable(String),
    /// There is no time in it.
    #[error("it holds the time of no method; measure with `softbox report --gpu`")]
    Empty,
    /// A figure that no device gives.
    #[error("{field} of {method} is {value}; it must be a number from {low} to {high}", low = PLAUSIBLE.start(), high = PLAUSIBLE.end())]
    Implausible {
        /// The method.
        method: String,
        /// The field.
        field: &'static str,
        /// What it holds.
        value: String,
    },
    /// Two times of one method.
    #[error("the method {0} is there twice; leave one of its times")]
    Twice(String),
}

impl Measured {
    /// Reads the JSON that `softbox report --gpu` writes.
    ///
    /// # Errors
    ///
    /// If the text is none, or a figure of it is one that no device gives.
    pub fn read(text: &str) -> Result<Self, MeasuredError> {
        let measured: Self =
            serde_json::from_str(text).map_err(|error| MeasuredError::Unreadable(error.to_string()))?;
        if measured.times.is_empty() {
            return Err(MeasuredError::Empty);
        }
        let mut methods = BTreeSet::new();
        for time in &measured.times {
            let fields = [
                ("nanoseconds", time.nanoseconds),
                ("ratio", time.ratio),
                ("median_ratio", time.median_ratio),
                // None at all is a steady clock.
                ("spread", if time.spread == 0.0 { 1.0 } else { time.spread }),
            ];
            if let Some((field, value)) = fields.into_iter().find(|(_, value)| !PLAUSIBLE.contains(value)) {
                let (method, value) = (time.method.clone(), format!("{value:?}"));
                return Err(MeasuredError::Implausible { method, field, value });
            }
            if !methods.insert(&time.method) {
                return Err(MeasuredError::Twice(time.method.clone()));
            }
        }
        Ok(measured)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(nanoseconds: &str, second: &str) -> String {
        let time = |method: &str, nanoseconds: &str| {
            format!(
                r#"{{"method":"{method}","nanoseconds":{nanoseconds},"ratio":1,"median_ratio":1,"spread":0}}"#
            )
        };
        format!(
            r#"{{"device":"d","command":"c","times":[{},{}]}}"#,
            time("standard", nanoseconds),
            time(second, "1")
        )
    }

    #[test]
    fn figures_that_no_device_gives_are_refused_by_name() {
        assert!(Measured::read(&text("2.5", "published")).is_ok());
        for (text, words) in [
            (text("0", "published"), "nanoseconds of standard is 0.0"),
            (text("-1", "published"), "nanoseconds of standard is -1.0"),
            (text("1e300", "published"), "nanoseconds of standard is 1e300"),
            (text("1", "standard"), "standard is there twice"),
            (text("1e999", "published"), "holds no times"),
            ("{}".to_owned(), "holds no times"),
            (r#"{"device":"","command":"","times":[]}"#.to_owned(), "the time of no method"),
        ] {
            let error = Measured::read(&text).expect_err(&text).to_string();
            assert!(error.contains(words), "{words:?} is not in {error:?}");
        }
    }
}
