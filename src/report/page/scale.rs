//! From values to lengths.

/// What equal lengths on an axis are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Law {
    /// Equal differences.
    Linear,
    /// Equal ratios.
    Logarithmic,
    /// Equal differences of signed square roots, around zero in the middle.
    Root,
}

/// An axis: values `low`…`high` lie at `from`…`to`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    pub low: f64,
    pub high: f64,
    pub from: f64,
    pub to: f64,
    pub law: Law,
    /// Distance of the ticks of a linear axis, where it is not left to [`Scale::ticks`].
    pub step: Option<f64>,
}

impl Scale {
    /// An axis of length 1.
    pub fn between(low: f64, high: f64, law: Law) -> Self {
        Self { low, high, from: 0.0, to: 1.0, law, step: None }
    }

    /// An axis of length 1 for values within ±`full`, by their roots.
    pub fn root(full: f64) -> Self {
        Self::between(-full, full, Law::Root)
    }

    /// A linear axis over `values`, from zero if none is below, with room at the end.
    pub fn linear(values: impl Iterator<Item = f64> + Clone, from: f64, to: f64) -> Self {
        let high = values.clone().fold(0.0_f64, f64::max);
        let low = values.fold(0.0_f64, f64::min);
        let high = if high > low { high } else { low + 1.0 };
        let step = step(high - low);
        let round = |value: f64, up: bool| {
            let steps = value / step;
            step * if up { (steps - 1e-9).ceil() } else { (steps + 1e-9).floor() }
        };
        Self { from, to, ..Self::between(round(low, false), round(high, true), Law::Linear) }
    }

    /// A logarithmic axis over positive `values`, with a little room at both ends.
    pub fn logarithmic(values: impl Iterator<Item = f64> + Clone, from: f64, to: f64) -> Self {
        let values = values.filter(|value| *value > 0.0);
        let low = values.clone().fold(f64::INFINITY, f64::min);
        let high = values.fold(0.0_f64, f64::max);
        let [low, high] = if low <= high { [low, high] } else { [0.5, 2.0] };
        let room = (high / low).powf(0.07).max(1.25);
        Self { from, to, ..Self::between(low / room, high * room, Law::Logarithmic) }
    }

    /// Where a value lies; a logarithmic axis keeps what is not above its low end there.
    pub fn place(&self, value: f64) -> f64 {
        let share = match self.law {
            Law::Linear => (value - self.low) / (self.high - self.low),
            Law::Logarithmic => (value.max(self.low) / self.low).ln() / (self.high / self.low).ln(),
            Law::Root => 0.5 + 0.5 * signed_root(value / self.high),
        };
        self.from + share * (self.to - self.from)
    }

    /// Round values along the axis, at most a dozen.
    pub fn ticks(&self) -> Vec<f64> {
        if self.law == Law::Root {
            return [-1.0, -0.5, -0.1, 0.0, 0.1, 0.5, 1.0].map(|share| share * self.high).to_vec();
        }
        if self.law == Law::Linear {
            let step = self.step.unwrap_or_else(|| step(self.high - self.low));
            let first = (self.low / step - 1e-9).ceil() as i64;
            let last = (self.high / step + 1e-9).floor() as i64;
            return (first..=last).map(|index| index as f64 * step).collect();
        }
        let decades = (self.high / self.low).log10();
        let [first, last] = [self.low.log10().floor() as i32, self.high.log10().ceil() as i32];
        let steps: &[f64] = match decades {
            ..0.3 => &[
                1.0, 1.1, 1.2, 1.3, 1.4, 1.6, 1.8, 2.0, 2.2, 2.5, 2.8, 3.2, 3.6, 4.0, 4.5, 5.0, 5.5, 6.0,
                7.0, 8.0, 9.0,
            ],
            ..0.5 => &[1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0],
            ..1.2 => &[1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0],
            ..3.5 => &[1.0, 2.0, 5.0],
            _ => &[1.0],
        };
        let stride = ((decades / 8.0).ceil() as i32).max(1);
        let decades = (first..=last).filter(|decade| decade.rem_euclid(stride) == 0);
        let values = decades.flat_map(|decade| steps.iter().map(move |step| step * 10_f64.powi(decade)));
        values.filter(|value| (self.low * (1.0 - 1e-9)..=self.high * (1.0 + 1e-9)).contains(value)).collect()
    }
}

/// The root of |x| with the sign of x.
pub(super) fn signed_root(x: f64) -> f64 {
    x.abs().sqrt().copysign(x)
}

/// A round step that divides a length into three to eight.
fn step(length: f64) -> f64 {
    let power = 10_f64.powf((length / 8.0).log10().floor());
    [1.0, 2.0, 2.5, 5.0]
        .into_iter()
        .map(|factor| factor * power)
        .find(|step| length / step <= 8.0)
        .unwrap_or(10.0 * power)
}

/// The next of 1, 2, 5, 10, … in the direction of `up`.
pub(super) fn rounded(value: f64, up: bool) -> f64 {
    let power = 10_f64.powf(value.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power);
    if up {
        steps.into_iter().find(|step| *step >= value * (1.0 - 1e-9)).unwrap_or(steps[3])
    } else {
        steps.into_iter().rev().find(|step| *step <= value * (1.0 + 1e-9)).unwrap_or(steps[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_within_and_not_many() {
        for power in -30..30 {
            let high = 1.7_f64.powi(power);
            for low in [0.0, 0.001, 0.03, 0.5, 0.9].map(|share| share * high) {
                let linear = Scale::linear([low, high].into_iter(), 0.0, 100.0);
                let logarithmic = Scale::logarithmic([low, high].into_iter(), 0.0, 100.0);
                for scale in [linear, logarithmic, Scale { to: 100.0, ..Scale::root(high) }] {
                    let ticks = scale.ticks();
                    assert!((2..=14).contains(&ticks.len()), "{scale:?} {ticks:?}");
                    for place in ticks.iter().map(|tick| scale.place(*tick)) {
                        assert!((-1e-6..=100.000_001).contains(&place), "{scale:?} {ticks:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn rounding_goes_to_one_two_or_five() {
        assert_eq!([rounded(0.013, true), rounded(0.013, false)], [0.02, 0.01]);
        assert_eq!([rounded(6.0, true), rounded(5.0, true), rounded(5.0, false)], [10.0, 5.0, 5.0]);
    }
}
