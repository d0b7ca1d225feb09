//! Devices that put sums and products in another order than the text.

use glam::Vec3;
use rayon::prelude::*;
use softbox::WGSL_INCLUDE;
use softbox::effects::Quality;
use softbox::interpret::{Freedom, Policy};
use softbox::stability::{Bound, Case, REORDERED, Shape};

use super::controls::replaced;
use super::{assert_none, most, summarised, thinned};

fn devices() -> Vec<(String, Policy)> {
    let always = Policy { reassociation: Freedom::Always, ..Policy::random(5) };
    let mut devices = vec![("always another order".to_owned(), always)];
    devices.extend((1..=3).map(|seed| (format!("another order {seed}"), Policy::random(seed))));
    devices
}

fn extent(numbers: &[f32]) -> f32 {
    numbers.iter().fold(0.0, |most: f32, number| most.max(number.abs()))
}

/// The same case with every vector and length that is out of range multiplied by a power of two that brings it there: how far
/// apart the numbers of a vector are stays the same.
fn brought_into_range(mut case: Case) -> Case {
    let powers = REORDERED.end().log2().floor() as i32;
    case.each_vector(&mut |numbers| {
        let extent = extent(numbers);
        if extent == 0.0 || REORDERED.contains(&extent) {
            return;
        }
        let power = extent.log2().floor() as i32;
        let wanted = power.rem_euclid(2 * powers - 1) - powers + 1;
        // In two steps: the power itself may be out of range.
        let half = (wanted - power) / 2;
        let factors = [half, wanted - power - half].map(|power| 2.0_f32.powi(power));
        numbers.iter_mut().for_each(|number| *number = *number * factors[0] * factors[1]);
    });
    case
}

/// The catalogue's bounds, and more than is promised: what is very small, very large or far away as a whole keeps them as well.
#[test]
fn every_level_keeps_its_bounds_on_any_device_that_does_not() {
    let mut offences = Vec::new();
    for quality in Quality::ALL {
        let mut cases = thinned(1, most());
        cases.retain(|case| case.family != "any finite numbers");
        let summary = summarised(WGSL_INCLUDE, quality, &cases, &devices());
        println!("{quality}, in another order:\n{summary}");
        offences.extend(summary.offences(&format!("{quality}, in another order")));
    }
    assert_none(&offences);
}

/// Vectors whose numbers have nothing to do with each other, and that have none with other vectors.
#[test]
fn any_numbers_in_range_stay_physical_on_any_device_that_does_not() {
    let mut cases = thinned(5 * most(), usize::MAX);
    cases.retain(|case| ["any finite numbers", "degenerate"].contains(&case.family));
    let cases: Vec<Case> = cases.into_par_iter().map(brought_into_range).collect();
    assert!(cases.iter().all(|case| case.is_within(&REORDERED)));
    let mut offences = Vec::new();
    for quality in Quality::ALL {
        let summary = summarised(WGSL_INCLUDE, quality, &cases, &devices());
        println!("{quality}, in another order: {} cases", cases.len());
        offences.extend(summary.offences(&format!("{quality}, any numbers in another order")));
    }
    assert_none(&offences);
}

/// A disk without area at the surface point has the reciprocal of nothing as its unit.
#[test]
fn a_disk_that_is_nothing_at_the_surface_point_stays_finite_in_any_order() {
    let mut cases = thinned(1, 40);
    cases.retain(|case| matches!(case.shape, Shape::Disk { .. }));
    cases.truncate(1);
    let nothing = Vec3::ZERO;
    cases[0].shape =
        Shape::Disk { center: cases[0].position, half_x: nothing, half_y: nothing, two_sided: true };
    cases[0].bound = Bound::Physical;
    cases[0].specular_bound = f64::INFINITY;
    let devices: Vec<_> =
        (0..100).map(|seed| (format!("another order {seed}"), Policy::random(seed))).collect();
    let unbounded =
        replaced(WGSL_INCLUDE, "disk.size = min(width * scale, 1.0);", "disk.size = width * scale;");
    for quality in Quality::ALL {
        let summary = summarised(WGSL_INCLUDE, quality, &cases, &devices);
        assert_eq!(summary.offences(&format!("{quality}, in another order")), [""; 0]);
    }
    let summary = summarised(&unbounded, Quality::Standard, &cases, &devices);
    assert!(!summary.is_clean(), "the size needs no bound: {summary}");
}

/// The range means something: beyond it such devices give what is no number.
#[test]
fn numbers_beyond_that_range_are_not_promised_for_a_reason() {
    let mut cases = thinned(1, 40);
    cases.retain(|case| case.family == "any finite numbers" && !case.is_within(&REORDERED));
    let summary = summarised(WGSL_INCLUDE, Quality::Finest, &cases, &devices());
    assert!(!summary.is_clean(), "nothing goes wrong beyond {REORDERED:?}:\n{summary}");
}
