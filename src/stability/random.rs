//! Numbers that look random and are the same on every run.

use glam::DVec3;

/// SplitMix64 (Steele, Lea and Flood 2014), and distributions that aim at trouble.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The same numbers for the same seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Any 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in 0…1.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform between two numbers.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform in the logarithm, between two positive numbers.
    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    /// One of the first `count` whole numbers.
    pub fn index(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }

    /// A unit vector, uniform on the sphere.
    pub fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let azimuth = self.between(0.0, core::f64::consts::TAU);
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * azimuth.cos(), radius * azimuth.sin(), z)
    }

    /// A unit vector above the surface whose normal is z.
    pub fn upper(&mut self) -> DVec3 {
        let direction = self.direction();
        DVec3::new(direction.x, direction.y, direction.z.abs())
    }

    /// Either sign.
    pub fn sign(&mut self) -> f64 {
        if self.index(2) == 0 { 1.0 } else { -1.0 }
    }

    /// Any finite number of single precision, all bit patterns alike.
    pub fn finite(&mut self) -> f32 {
        loop {
            let value = f32::from_bits(self.bits() as u32);
            if value.is_finite() {
                return value;
            }
        }
    }

    /// A number of single precision at most `steps` representable ones away.
    pub fn near(&mut self, value: f32, steps: u32) -> f32 {
        let step = self.index(2 * steps as usize + 1) as i64 - i64::from(steps);
        neighbour(value, step)
    }
}

/// The representable number so many steps above (or below) a finite one.
pub fn neighbour(value: f32, steps: i64) -> f32 {
    // Bit patterns of one sign are in the order of their values, and those of the other in the reverse order.
    let bits = value.to_bits() as i32;
    let place = i64::from(if bits < 0 { i32::MIN.wrapping_sub(bits) } else { bits });
    let last = i64::from(f32::MAX.to_bits());
    let place = (place + steps).clamp(-last, last);
    f32::from_bits(if place < 0 { 0x8000_0000 | (-place) as u32 } else { place as u32 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_the_next_numbers() {
        for value in [0.0_f32, -0.0, 1.0, -1.0, 1e-45, -1e-45, 3.5e20, f32::MIN_POSITIVE] {
            assert_eq!(neighbour(value, 1), value.next_up(), "{value:e}");
            assert_eq!(neighbour(value, -1), value.next_down(), "{value:e}");
            assert_eq!(neighbour(neighbour(value, 1000), -1000), value, "{value:e}");
        }
        assert_eq!(neighbour(f32::MAX, 5), f32::MAX);
    }
}
