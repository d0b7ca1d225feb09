//! What devices made of cases, by family.

use std::collections::BTreeMap;
use std::fmt;

use softbox::interpret::{Concern, Finding, Outcome};

use softbox::stability::Case;

/// The largest share of what is promised, with the case.
#[derive(Clone, Debug, Default)]
struct Largest {
    share: f64,
    what: String,
}

impl Largest {
    fn take(&mut self, share: f64, what: impl FnOnce() -> String) {
        // What is no number is larger than all.
        if share > self.share || share.is_nan() {
            *self = Self { share, what: what() };
        }
    }

    fn and(&mut self, other: Self) {
        let Self { share, what } = other;
        self.take(share, || what);
    }
}

#[derive(Clone, Debug, Default)]
struct Family {
    count: usize,
    /// Of the form factor and of specular light.
    largest: [Largest; 2],
}

/// What devices made of cases.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    families: BTreeMap<&'static str, Family>,
    /// How often something was found at a line, and the first time.
    found: BTreeMap<(u32, Concern), (usize, String)>,
    /// How many numbers were pushed, how many of them at least half as far as first order predicts, and how many further.
    predictions: [usize; 3],
}

impl Summary {
    pub fn add(&mut self, case: &Case, device: &str, outcome: &Outcome, shares: [f64; 2]) {
        let family = self.families.entry(case.family).or_default();
        family.count += 1;
        for (largest, share) in family.largest.iter_mut().zip(shares) {
            largest.take(share, || format!("{device}: {:?} of {case:?}", &outcome.values[..3]));
        }
        for finding in outcome.findings.iter().filter(|finding| counts(finding)) {
            let first = || (0, format!("{device}: {finding}, of {case:?}"));
            self.found.entry((finding.line, finding.concern)).or_insert_with(first).0 += 1;
        }
    }

    /// Takes note of how far a number of a case was predicted to go, and went.
    pub fn predict(&mut self, predicted: [f64; 2], found: impl Iterator<Item = f64>, nearest: f64) {
        for (predicted, found) in predicted.into_iter().zip(found) {
            let (expected, went) = (predicted - nearest, found - nearest);
            if expected.abs() > 1e-9 {
                let share = went / expected;
                self.predictions[0] += 1;
                self.predictions[1] += usize::from(share >= 0.5);
                self.predictions[2] += usize::from(share > 1.25);
            }
        }
    }

    pub fn and(mut self, other: Self) -> Self {
        for (name, family) in other.families {
            let mine = self.families.entry(name).or_default();
            mine.count += family.count;
            mine.largest.iter_mut().zip(family.largest).for_each(|(mine, other)| mine.and(other));
        }
        for (at, (count, first)) in other.found {
            self.found.entry(at).or_insert((0, first)).0 += count;
        }
        self.predictions.iter_mut().zip(other.predictions).for_each(|(mine, other)| *mine += other);
        self
    }

    /// The largest shares of all families.
    pub fn largest(&self, specular: bool) -> [f64; 2] {
        let most =
            |part: usize| self.families.values().map(|family| family.largest[part].share).fold(0.0, f64::max);
        [most(0), if specular { most(1) } else { 0.0 }]
    }

    /// Whether all is kept.
    pub fn is_kept(&self) -> bool {
        self.families.values().flat_map(|family| &family.largest).all(|largest| largest.share <= 1.0)
    }

    /// Whether nothing was found at which WGSL promises nothing.
    pub fn is_clean(&self) -> bool {
        self.found.is_empty()
    }

    /// A sentence for each promise that is not kept, and for each line of which WGSL promises nothing.
    pub fn offences(&self, what: &str) -> Vec<String> {
        let beyond = self.families.iter().flat_map(|(name, family)| {
            let beyond =
                family.largest.iter().filter(|largest| largest.share > 1.0 || largest.share.is_nan());
            beyond.map(move |largest| {
                format!("{what}: {name}: {} times what is promised, {}", largest.share, largest.what)
            })
        });
        let found = self.found.values().map(|(count, first)| format!("{what}: {count} times, first {first}"));
        beyond.chain(found).collect()
    }

    fn findings(&self) -> String {
        let each = self.found.values().map(|(count, first)| format!("{count} times, first {first}"));
        each.collect::<Vec<_>>().join("\n")
    }
}

/// Whether a finding is the device's excuse for any result: something depends on it, and its operands were in order.
fn counts(finding: &Finding) -> bool {
    finding.matters && finding.operands.iter().all(|operand| operand.is_finite())
}

impl fmt::Display for Summary {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        for (name, family) in &self.families {
            let [diffuse, specular] = &family.largest;
            writeln!(
                formatter,
                "  {name}: {} values, at most {:.3} of the bound, specular {:.3}",
                family.count, diffuse.share, specular.share
            )?;
        }
        let [count, half, beyond] = self.predictions;
        if count > 0 {
            writeln!(
                formatter,
                "  of {count} numbers {half} went at least half as far as first order predicts, {beyond} further than that and a quarter"
            )?;
        }
        formatter.write_str(&self.findings())
    }
}
