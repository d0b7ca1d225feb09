//! Bytes as numbers, so that mutations of the bytes are small changes of what they mean.

use glam::DVec3;

/// Numbers at which something happens.
const SPECIAL: [f32; 20] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::MAX,
    f32::MIN,
    f32::MIN_POSITIVE,
    1e-45,
    -1e-45,
    1e-40,
    1e-37,
    1e-20,
    1e20,
    f32::EPSILON,
    16.0,
    1e30,
];

/// A reader that never runs out: after the end there are zeros.
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    pub fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    fn take<const N: usize>(&mut self) -> [u8; N] {
        core::array::from_fn(|_| self.byte())
    }

    /// A special number, a small multiple of 1/256, or any bits at all.
    pub fn single(&mut self) -> f32 {
        match self.byte() {
            special @ 0..=63 => SPECIAL[special as usize % SPECIAL.len()],
            64..=191 => f32::from(i16::from_le_bytes(self.take())) / 256.0,
            _ => f32::from_bits(u32::from_le_bytes(self.take())),
        }
    }

    /// The same in double precision, mostly numbers that f32 has.
    pub fn double(&mut self) -> f64 {
        match self.byte() {
            0..=239 => self.single().into(),
            _ => f64::from_bits(u64::from_le_bytes(self.take())),
        }
    }

    pub fn vector(&mut self) -> DVec3 {
        DVec3::new(self.double(), self.double(), self.double())
    }
}
