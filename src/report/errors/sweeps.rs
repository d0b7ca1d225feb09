//! Univariate approximations of the include over all floats of their domain.

use core::sync::atomic::{AtomicU32, Ordering};

use glam::Vec3;
use rayon::prelude::*;

use super::Effort;
use crate::report::data::SweepRow;
use crate::shade::{
    ltc_angle, ltc_angle_excess, ltc_anisotropic_root, ltc_half_turn, ltc_hyperbolic_deficit, ltc_outlined,
    ltc_root,
};

/// What an error is measured in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Error {
    /// |difference| over the exact value.
    Relative,
    /// |difference|, in the unit of the values.
    Absolute(&'static str),
}

/// An approximation in f32 and the function that it approximates, by another formula in f64.
#[derive(Clone, Copy, Debug)]
pub struct Sweep {
    /// The function of the include.
    pub function: &'static str,
    /// What is swept, with its bounds.
    pub domain: &'static str,
    /// Smallest input, not negative.
    pub low: f32,
    /// Largest input.
    pub high: f32,
    /// The approximation, as the shader computes it.
    pub approximate: fn(f32) -> f64,
    /// The exact value.
    pub exact: fn(f32) -> f64,
    /// How their difference is measured.
    pub error: Error,
}

/// θ / sin θ for cos θ = 1 − k.
fn angle_over_sine(k: f64) -> f64 {
    let sine = (k * (2.0 - k)).sqrt();
    if sine > 0.0 { sine.atan2(1.0 - k) / sine } else { 1.0 }
}

/// η / sinh η for cosh η = 1 + k.
fn area_over_sine(k: f64) -> f64 {
    let sine = (k * (2.0 + k)).sqrt();
    if sine > 0.0 { (k + sine).ln_1p() / sine } else { 1.0 }
}

/// Vectors at an angle to each other, nearly of length 1, with the sine of that angle, all rounded.
fn corner(angle: f32) -> (Vec3, Vec3, f32) {
    let (sine, cosine) = f64::from(angle).sin_cos();
    (Vec3::X, Vec3::new(cosine as f32, sine as f32, 0.0), sine as f32)
}

/// The larger of the two distances of a half turn from the direction at half the angle of (difference, product).
fn half_turn(difference: f32, product: f32) -> f64 {
    let [cosine, sine] = ltc_half_turn::<f32>(difference, product).map(f64::from);
    sine.atan2(cosine)
}

/// Every approximation of the include that depends on one number.
pub const UNIVARIATE: [Sweep; 9] = [
    Sweep {
        function: "ltc_angle_excess",
        domain: "1 + the value for k from 0 to 1",
        low: 0.0,
        high: 1.0,
        approximate: |k| 1.0 + f64::from(ltc_angle_excess(k)),
        exact: |k| angle_over_sine(f64::from(k)),
        error: Error::Relative,
    },
    Sweep {
        function: "ltc_hyperbolic_deficit",
        domain: "k from 0 to 1e18",
        low: 0.0,
        high: 1e18,
        approximate: |k| f64::from(ltc_hyperbolic_deficit(k)),
        exact: |k| 1.0 - area_over_sine(f64::from(k)),
        error: Error::Absolute("absolute"),
    },
    Sweep {
        function: "ltc_angle",
        domain: "unit vectors at an angle from 1e-6 to pi",
        low: 1e-6,
        high: core::f32::consts::PI,
        approximate: |angle| {
            let (a, b, sine) = corner(angle);
            f64::from(ltc_angle::<f32>(a, b, sine))
        },
        exact: |angle| {
            let (a, b, _) = corner(angle);
            let (a, b) = (a.as_dvec3(), b.as_dvec3());
            a.cross(b).length().atan2(a.dot(b))
        },
        error: Error::Absolute("radians"),
    },
    Sweep {
        function: "ltc_half_turn",
        domain: "difference 1, product from 0 to 1",
        low: 0.0,
        high: 1.0,
        approximate: |product| half_turn(1.0, product),
        exact: |product| 0.5 * f64::from(product).atan2(1.0),
        error: Error::Absolute("radians"),
    },
    Sweep {
        function: "ltc_half_turn",
        domain: "difference from 0 to 1, product 1",
        low: 0.0,
        high: 1.0,
        approximate: |difference| half_turn(difference, 1.0),
        exact: |difference| 0.5 * 1.0_f64.atan2(f64::from(difference)),
        error: Error::Absolute("radians"),
    },
    Sweep {
        function: "ltc_half_turn",
        domain: "difference from -1e-12 to -1, product 1",
        low: 1e-12,
        high: 1.0,
        approximate: |difference| half_turn(-difference, 1.0),
        exact: |difference| 0.5 * 1.0_f64.atan2(-f64::from(difference)),
        error: Error::Absolute("radians"),
    },
    Sweep {
        function: "ltc_root",
        domain: "x from 1e-30 to 3.4e38",
        low: 1e-30,
        high: f32::MAX,
        approximate: |x| f64::from(ltc_root(x)),
        exact: |x| f64::from(x).sqrt(),
        error: Error::Relative,
    },
    Sweep {
        function: "ltc_anisotropic_root",
        domain: "x from 1e-37 to 3.4e38",
        low: 1e-37,
        high: f32::MAX,
        approximate: |x| f64::from(ltc_anisotropic_root(x)),
        exact: |x| f64::from(x).sqrt(),
        error: Error::Relative,
    },
    Sweep {
        function: "ltc_outlined",
        domain: "spread from 1e-30 to 1e30",
        low: 1e-30,
        high: 1e30,
        approximate: |spread| f64::from(ltc_outlined(spread)),
        exact: |spread| {
            let waves = 2.0 * core::f64::consts::PI.powi(2);
            (waves * f64::from(spread)).ln_1p() / waves
        },
        error: Error::Relative,
    },
];

/// Floats that one thread tries at a time.
const BLOCK: u32 = 1 << 20;

/// Tries every `stride`-th float of the domain, the ends among them. `progress` hears the share that is done, from any
/// thread.
pub fn sweep(sweep: &Sweep, stride: u32, progress: &(dyn Fn(f64) + Sync)) -> SweepRow {
    // Floats that are not negative are in the order of their bits.
    let (first, last) = (sweep.low.to_bits(), sweep.high.to_bits());
    let stride = stride.max(1);
    let error = |bits: u32| {
        let x = f32::from_bits(bits);
        let (found, exact) = ((sweep.approximate)(x), (sweep.exact)(x));
        let error = (found - exact).abs();
        let error = match sweep.error {
            Error::Relative => error / exact.abs().max(f64::MIN_POSITIVE),
            Error::Absolute(_) => error,
        };
        // A value that is no number is worse than any other.
        (if error.is_nan() { f64::INFINITY } else { error }, x)
    };
    let worse = |a: (f64, f32), b: (f64, f32)| if b.0 > a.0 { b } else { a };
    let steps = (last - first) / stride;
    let blocks = steps / BLOCK + 1;
    let done = AtomicU32::new(0);
    let block = |index: u32| {
        progress(f64::from(done.fetch_add(1, Ordering::Relaxed)) / f64::from(blocks));
        let end = ((index + 1).saturating_mul(BLOCK)).min(steps + 1);
        (index * BLOCK..end).map(|step| error(first + step * stride)).fold((0.0, sweep.low), worse)
    };
    let found: Vec<(f64, f32)> = (0..blocks).into_par_iter().map(block).collect();
    let ends_at_last = first + steps * stride == last;
    let (maximum, worst) = found.into_iter().chain([error(last)]).fold((0.0, sweep.low), worse);
    SweepRow {
        function: sweep.function.to_owned(),
        domain: sweep.domain.to_owned(),
        count: u64::from(steps) + 1 + u64::from(!ends_at_last),
        exhaustive: stride == 1,
        maximum,
        unit: match sweep.error {
            Error::Relative => "relative",
            Error::Absolute(unit) => unit,
        }
        .to_owned(),
        worst: f64::from(worst),
    }
}

/// Sweeps all of [`UNIVARIATE`]: every float of the polynomials' domains and 16 million of the others' if there is time,
/// a million each otherwise. `progress` hears the share that is done, from any thread.
pub fn univariate(effort: Effort, progress: &(dyn Fn(f64) + Sync)) -> Vec<SweepRow> {
    let stride = |one: &Sweep| {
        let floats = one.high.to_bits() - one.low.to_bits();
        let polynomial = matches!(one.function, "ltc_angle_excess" | "ltc_hyperbolic_deficit");
        match effort {
            Effort::Full if polynomial => 1,
            Effort::Full => floats >> 24,
            Effort::Quick => floats >> 20,
        }
    };
    let counts: Vec<f64> = UNIVARIATE
        .iter()
        .map(|one| f64::from((one.high.to_bits() - one.low.to_bits()) / stride(one).max(1)))
        .collect();
    let total: f64 = counts.iter().sum();
    let mut before = 0.0;
    let rows = UNIVARIATE.iter().zip(&counts).map(|(one, count)| {
        // An odd stride meets floats of every kind of last digit.
        let row = sweep(one, stride(one) | 1, &|share| progress((before + share * count) / total));
        before += count;
        row
    });
    rows.collect()
}
