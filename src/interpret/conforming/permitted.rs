//! What WGSL permits an operation to come to.
//!
//! The source of all figures: the W3C's "WebGPU Shading Language", section "Floating Point Accuracy". An operation is
//! correctly rounded, that is, either neighbour of the exact result will do, or off by some units in the last place, or by
//! some absolute amount.

use naga::MathFunction;

/// Smallest magnitude of a divisor for which WGSL states the accuracy of a quotient.
pub const LEAST_DIVISOR: f32 = f32::MIN_POSITIVE;
/// Largest magnitude of such a divisor.
pub const LARGEST_DIVISOR: f32 = 8.507_059e37;
/// Units in the last place by which a quotient may be off.
pub const QUOTIENT_ULPS: f64 = 2.5;
/// Units in the last place by which an inverse square root may be off.
pub const INVERSE_ROOT_ULPS: f64 = 2.0;

/// A real number as the sum of two: the second is what rounding takes from the first. Where the first is all there is to
/// know, the second is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exact(pub f64, pub f64);

impl Exact {
    /// The sum of two numbers (Møller 1965, Knuth 1969: the rounding error of a sum is a number of the same precision).
    pub fn sum(a: f64, b: f64) -> Self {
        let sum = a + b;
        let of_b = sum - a;
        let rest = (a - (sum - of_b)) + (b - of_b);
        Self(sum, if rest.is_finite() { rest } else { 0.0 })
    }
}

/// The numbers that an operation may come to: all from the first to the last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Permitted {
    /// The least.
    pub low: f32,
    /// The largest.
    pub high: f32,
}

impl Permitted {
    /// No other than one.
    pub const fn only(value: f32) -> Self {
        Self { low: value, high: value }
    }

    /// Both neighbours of a number, or that number itself.
    pub fn rounded(Exact(first, rest): Exact) -> Self {
        let nearest = first as f32;
        let above = f64::from(nearest) - first;
        // What is beyond all finite numbers may be rounded to the last of them or not.
        if nearest.is_infinite() && first.is_finite() {
            let beyond = first.abs() >= 2.0_f64.powi(128);
            let last = if beyond { nearest } else { f32::MAX.copysign(nearest) };
            return Self { low: last.min(nearest), high: last.max(nearest) };
        }
        if !nearest.is_finite() {
            return Self::only(nearest);
        }
        if above > 0.0 || (above == 0.0 && rest < 0.0) {
            Self { low: nearest.next_down(), high: nearest }
        } else if above < 0.0 || rest > 0.0 {
            Self { low: nearest, high: nearest.next_up() }
        } else {
            Self::only(nearest)
        }
    }

    /// All numbers within a distance of a real number; where there is none, its neighbours.
    pub fn within(exact: f64, distance: f64) -> Self {
        let (least, most) = (exact - distance, exact + distance);
        let (low, high) = (Self::rounded(Exact(least, 0.0)).high, Self::rounded(Exact(most, 0.0)).low);
        if low <= high { Self { low, high } } else { Self::rounded(Exact(exact, 0.0)) }
    }

    /// All numbers within some units in the last place of a real number.
    pub fn within_ulps(exact: f64, ulps: f64) -> Self {
        Self::within(exact, ulps * ulp(exact))
    }

    /// Whether there is but one.
    pub fn is_single(&self) -> bool {
        self.low.to_bits() == self.high.to_bits()
    }
}

/// A unit in the last place of a real number, as WGSL defines it: the least distance between two numbers of single precision
/// of which one is not above and one is not below it.
pub fn ulp(exact: f64) -> f64 {
    let magnitude = exact.abs();
    if magnitude <= f64::from(f32::MIN_POSITIVE) {
        return 2.0_f64.powi(-149);
    }
    let bits = magnitude.min(f64::from(f32::MAX)).to_bits();
    let exponent = (bits >> 52) as i32 - 1023;
    let is_power = bits << 12 == 0;
    2.0_f64.powi(exponent - 23 - i32::from(is_power))
}

/// A function of one or two numbers: what it comes to, its slopes, and what is permitted. Nothing for functions that WGSL
/// defines by other operations, and for those that are exact.
pub fn function(function: MathFunction, x: f64, y: f64) -> Option<(f64, [f64; 2], Permitted)> {
    use MathFunction as M;
    use core::f64::consts::LN_2;
    let absolute =
        |value: f64, slope: f64, error: f64| (value, [slope, 0.0], Permitted::within(value, error));
    let ulps =
        |value: f64, slope: f64, count: f64| (value, [slope, 0.0], Permitted::within_ulps(value, count));
    let logarithm = |value: f64, slope: f64| {
        if (0.5..=2.0).contains(&x) {
            absolute(value, slope, 2.0_f64.powi(-21))
        } else {
            ulps(value, slope, 3.0)
        }
    };
    Some(match function {
        M::InverseSqrt => ulps(1.0 / x.sqrt(), -0.5 / (x * x.sqrt()), INVERSE_ROOT_ULPS),
        M::Exp2 => ulps(x.exp2(), x.exp2() * LN_2, 3.0 + 2.0 * x.abs()),
        M::Exp => ulps(x.exp(), x.exp(), 3.0 + 2.0 * x.abs()),
        M::Log2 => logarithm(x.log2(), 1.0 / (x * LN_2)),
        M::Log => logarithm(x.ln(), 1.0 / x),
        M::Sin => absolute(x.sin(), x.cos(), 2.0_f64.powi(-11)),
        M::Cos => absolute(x.cos(), -x.sin(), 2.0_f64.powi(-11)),
        M::Atan => ulps(x.atan(), 1.0 / (1.0 + x * x), 4096.0),
        M::Atan2 => {
            let squared = x * x + y * y;
            let value = x.atan2(y);
            (value, [y / squared, -x / squared], Permitted::within_ulps(value, 4096.0))
        }
        // The worse of a bound and of atan2 of a root, whose own error is some units more.
        M::Acos => {
            let value = x.acos();
            absolute(value, -1.0 / (1.0 - x * x).sqrt(), (4100.0 * ulp(value)).max(6.77e-5))
        }
        M::Asin => {
            let value = x.asin();
            absolute(value, 1.0 / (1.0 - x * x).sqrt(), (4100.0 * ulp(value)).max(6.81e-5))
        }
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_and_products_come_to_either_neighbour_and_to_no_other_number() {
        let third = f64::from(1.0_f32 / 3.0);
        for exact in [0.1, -0.1, 1e-40, -1e-40, 1e30, third + 1e-12] {
            let Permitted { low, high } = Permitted::rounded(Exact(exact, 0.0));
            assert!(f64::from(low) < exact && exact < f64::from(high), "{exact}: {low}, {high}");
            assert_eq!(low.next_up(), high, "{exact}");
        }
        for exact in [0.0, 1.0, -3.5, third, f64::from(f32::MAX)] {
            assert!(
                Permitted::rounded(Exact(exact, 0.0)).is_single(),
                "{exact} is a number of single precision"
            );
        }
        // What a sum loses in double precision still tells that it is not exact, and on which side it lies.
        let above = Permitted::rounded(Exact::sum(1.0, 1e-30));
        let below = Permitted::rounded(Exact::sum(1.0, -1e-30));
        assert_eq!(above, Permitted { low: 1.0, high: 1.0_f32.next_up() });
        assert_eq!(below, Permitted { low: 1.0_f32.next_down(), high: 1.0 });
        // Beyond the last finite number infinity is the other neighbour, and far beyond the only one.
        let last = f64::from(f32::MAX);
        let over = Permitted::rounded(Exact(last * (1.0 + 1e-8), 0.0));
        assert_eq!(over, Permitted { low: f32::MAX, high: f32::INFINITY });
        assert_eq!(Permitted::rounded(Exact(2.0 * last, 0.0)), Permitted::only(f32::INFINITY));
    }

    #[test]
    fn units_in_the_last_place_are_those_of_the_specification() {
        assert_eq!(ulp(1.5), 2.0_f64.powi(-23));
        // Below a power of two numbers are twice as dense, and the power is between two of those.
        assert_eq!(ulp(1.0), 2.0_f64.powi(-24));
        assert_eq!(ulp(-1.0 - 1e-12), 2.0_f64.powi(-23));
        assert_eq!(ulp(0.0), f64::from(f32::from_bits(1)));
        assert_eq!(ulp(1e-40), f64::from(f32::from_bits(1)));
        assert_eq!(ulp(f64::from(f32::MAX)), f64::from(f32::MAX) - f64::from(f32::MAX.next_down()));
        assert_eq!(ulp(1e39), ulp(f64::from(f32::MAX)));
    }

    #[test]
    fn a_quotient_comes_to_no_more_than_five_or_six_numbers() {
        for exact in [1.0 / 3.0, 1.1, 1.0, 1.9999, 7e-20, -2.0 / 3.0] {
            let Permitted { low, high } = Permitted::within_ulps(exact, QUOTIENT_ULPS);
            let unit = ulp(exact);
            for end in [low, high] {
                assert!((f64::from(end) - exact).abs() <= 2.5 * unit, "{exact}: {end}");
            }
            let beyond = [low.next_down(), high.next_up()];
            for end in beyond {
                assert!((f64::from(end) - exact).abs() > 2.5 * unit, "{exact}: {end} was left out");
            }
        }
        // Exact quotients may be off as well.
        assert!(Permitted::within_ulps(1.0, QUOTIENT_ULPS).high > 1.0);
    }

    #[test]
    fn functions_are_as_far_off_as_their_row_says() {
        let width = |of: MathFunction, x: f64| {
            let (exact, _, Permitted { low, high }) = function(of, x, 1.0).expect("a function");
            let distance = (f64::from(high) - exact).min(exact - f64::from(low));
            (exact, distance)
        };
        let (exact, distance) = width(MathFunction::InverseSqrt, 2.0);
        assert!((1.0..=2.0).contains(&(distance / ulp(exact))), "{distance}");
        let (exact, distance) = width(MathFunction::Exp2, 3.3);
        assert!((8.6..=9.6).contains(&(distance / ulp(exact))), "{distance}");
        let (_, distance) = width(MathFunction::Log2, 1.0);
        assert!((4.7e-7..=4.8e-7).contains(&distance), "{distance}");
        let (exact, distance) = width(MathFunction::Log, 3.0);
        assert!((2.0..=3.0).contains(&(distance / ulp(exact))), "{distance}");
        let (_, distance) = width(MathFunction::Sin, 0.5);
        assert!((distance - 2.0_f64.powi(-11)).abs() < 1e-7, "{distance}");
        let (exact, distance) = width(MathFunction::Atan2, 0.7);
        assert!((4095.0..=4096.0).contains(&(distance / ulp(exact))), "{distance}");
        let (_, distance) = width(MathFunction::Acos, 0.999);
        assert!((distance - 6.77e-5).abs() < 1e-7, "{distance}");
        assert!(function(MathFunction::Abs, 1.0, 1.0).is_none());
    }

    #[test]
    fn slopes_are_those_of_the_functions() {
        use MathFunction as M;
        for of in [
            M::InverseSqrt,
            M::Exp2,
            M::Exp,
            M::Log2,
            M::Log,
            M::Sin,
            M::Cos,
            M::Atan,
            M::Atan2,
            M::Acos,
            M::Asin,
        ] {
            let value = |x: f64, y: f64| function(of, x, y).expect("a function").0;
            let (_, slopes, _) = function(of, 0.3, 0.8).expect("a function");
            let step = 1e-6;
            let along = (value(0.3 + step, 0.8) - value(0.3 - step, 0.8)) / (2.0 * step);
            let across = (value(0.3, 0.8 + step) - value(0.3, 0.8 - step)) / (2.0 * step);
            assert!(
                (slopes[0] - along).abs() < 1e-6 && (slopes[1] - across).abs() < 1e-6,
                "{of:?}: {slopes:?}"
            );
        }
    }
}
