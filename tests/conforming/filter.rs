//! Textures filtered with weights of few binary places.

use rayon::prelude::*;
use softbox::WGSL_INCLUDE;
use softbox::effects::Quality;
use softbox::interpret::{Filter, Policy, Rounding};
use softbox::stability::{Case, FILTERED};

use super::{evaluation, exact, most, thinned};

/// How far specular light by the texels that such a filter gives is from that by the texels of an exact filter, both in exact
/// arithmetic, as a share of the albedo; with the case.
fn worst(quality: Quality, cases: &[Case], bits: u32) -> (f64, String) {
    let effects = evaluation::effects(quality);
    let table = evaluation::table(effects);
    let kernel = evaluation::kernel(WGSL_INCLUDE, effects, cases);
    let indices: Vec<usize> = (0..cases.len()).collect();
    let parts = indices.par_chunks(16).map(|chunk| {
        let mut machine = kernel.machine();
        let mut worst = (0.0, String::new());
        for &index in chunk {
            let case = &cases[index];
            let plain = case.exact(&table, effects);
            // As the hardware may round its weights: either way.
            for rounding in [Rounding::Down, Rounding::Up] {
                let policy = Policy::exact().with_rounding(rounding).with_filter(Filter::FixedPoint(bits));
                let outcome = machine.run(index as u32, policy);
                let outcome = outcome.unwrap_or_else(|error| panic!("{error}: {case:?}"));
                let (filtered, albedo) = exact(&table, effects, case, &outcome);
                let difference = (filtered[1] - plain[1]).abs().max((filtered[2] - plain[2]).abs());
                if difference.is_nan() || difference / albedo > worst.0 {
                    worst =
                        (difference / albedo, format!("{rounding:?}: {filtered:?}, not {plain:?}: {case:?}"));
                }
            }
        }
        worst
    });
    parts.reduce(|| (0.0, String::new()), |a, b| if b.0 > a.0 || b.0.is_nan() { b } else { a })
}

/// Graphics processors weight texels by numbers of 8 binary places.
#[test]
fn a_filter_of_eight_bits_moves_specular_light_by_no_more_than_is_stated() {
    let mut cases = thinned(1, 5 * most());
    // Elsewhere even the last digit of a texel may decide on which side of a lobe's horizon a light is.
    cases.retain(|case| case.specular_bound.is_finite());
    for quality in [Quality::Standard, Quality::Fine, Quality::Finest] {
        let (share, what) = worst(quality, &cases, 8);
        println!("{quality}: {share:.4} of the albedo, {what}");
        assert!(share <= FILTERED, "{quality}: {share} of the albedo, and {FILTERED} is stated: {what}");
        let (coarser, _) = worst(quality, &cases, 4);
        assert!(
            coarser > 3.0 * share,
            "{quality}: weights of 4 places move it by {coarser}, of 8 by {share}"
        );
    }
}
