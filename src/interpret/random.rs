//! Numbers that look random and are the same on every run.

/// A sequence of numbers (Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number Generators").
#[derive(Clone, Debug, Default)]
pub(crate) struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// A number that depends on others and on nothing else.
    pub fn of(numbers: impl IntoIterator<Item = u64>) -> u64 {
        numbers.into_iter().fold(0, |state, number| Self(state ^ number).bits())
    }

    pub fn coin(&mut self) -> bool {
        self.bits() >> 63 == 1
    }

    /// Below `count`.
    pub fn index(&mut self, count: u64) -> u64 {
        self.bits() % count
    }
}
