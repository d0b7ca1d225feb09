//! The include keeps its promises on every device that conforms to WGSL, the worst included.

mod controls;
mod evaluation;
mod filter;
mod reordering;
mod summary;

use std::collections::BTreeMap;

use rayon::prelude::*;
use softbox::WGSL_INCLUDE;
use softbox::effects::{Effects, Quality};
use softbox::interpret::{Filter, Freedom, Outcome, Policy};
use softbox::shade::LobeSum;
use softbox::stability::{Bound, Case, REORDERED, conforming_bound};
use softbox::table::Table;

use summary::Summary;

/// A part of each family, spread over it.
pub fn thinned(scale: usize, most: usize) -> Vec<Case> {
    let mut families: BTreeMap<&str, Vec<Case>> = BTreeMap::new();
    for case in softbox::stability::cases(scale) {
        families.entry(case.family).or_default().push(case);
    }
    let each = families.into_values().flat_map(|family| {
        // Thousands of vertices take as long as hundreds of quads.
        let many = family.iter().any(|case| case.shape.vertices().len() > 500);
        let most = if many { most.div_ceil(8) } else { most };
        // A quad and the same as a polygon are neighbours: an odd step takes both kinds.
        let step = family.len().div_ceil(most) | 1;
        family.into_iter().step_by(step)
    });
    each.collect()
}

/// Devices that keep the order of the text.
pub fn in_order() -> Vec<(String, Policy)> {
    let mut devices = Policy::devices(4);
    for (_, policy) in &mut devices {
        policy.reassociation = Freedom::Never;
        policy.filter = Filter::FixedPoint(8);
    }
    devices.push((
        "capricious".to_owned(),
        Policy { reassociation: Freedom::Never, ..Policy::random(9).capricious() },
    ));
    devices
}

/// What a value ought to be, on the texels that the device fetched, with the albedo of those.
pub fn exact(table: &Table, effects: Effects, case: &Case, outcome: &Outcome) -> ([f64; 3], f64) {
    let surface = case.surface::<f64>();
    let lobes = evaluation::lobes(&surface, effects, &outcome.sampled);
    let lobes = lobes.unwrap_or_else(|| table.specular(&surface, effects));
    let albedo = lobes.lobes().iter().map(|lobe| lobe.albedo).sum();
    (case.shaded(&surface, &lobes, effects), albedo)
}

/// How far a value is from what it ought to be, in units of what is promised; infinite if it is not physical.
fn shares(quality: Quality, case: &Case, outcome: &Outcome, (exact, albedo): ([f64; 3], f64)) -> [f64; 2] {
    let values = [0, 1, 2].map(|at: usize| f64::from(outcome.values[at]));
    let [diffuse, specular, fresnel] = values;
    // Some units in the last place of what they are compared with. Schlick's fifth power of 1 less what rounding has made
    // larger than 1 may be below zero, by the fifth power of those units.
    let physical = (0.0..=1.0).contains(&diffuse)
        && (0.0..=albedo * (1.0 + 2e-6)).contains(&specular)
        && (-1e-30..=specular * (1.0 + 2e-6) + 1e-30).contains(&fresnel);
    if !physical {
        return [f64::INFINITY; 2];
    }
    let form_factor = case.form_factor.unwrap_or(exact[0]);
    let relative = Case { form_factor: Some(form_factor), ..case.clone() };
    let Some([diffuse_bound, specular_bound]) = conforming_bound(quality, &relative, exact[1]) else {
        return [0.0; 2];
    };
    let of_specular = (specular - exact[1]).abs().max(0.5 * (fresnel - exact[2]).abs());
    [(diffuse - form_factor).abs() / diffuse_bound, of_specular / specular_bound]
}

/// Runs a text of the include at a level on devices and says what comes of it.
pub fn summarised(include: &str, quality: Quality, cases: &[Case], devices: &[(String, Policy)]) -> Summary {
    let effects = evaluation::effects(quality);
    let table = evaluation::table(effects);
    let kernel = evaluation::kernel(include, effects, cases);
    let indices: Vec<usize> = (0..cases.len()).collect();
    let parts = indices.par_chunks(4).map(|chunk| {
        let mut machine = kernel.machine();
        let mut summary = Summary::default();
        for &index in chunk {
            let case = &cases[index];
            for (name, policy) in devices {
                let outcome = machine.run(index as u32, *policy);
                let outcome = outcome.unwrap_or_else(|error| panic!("{quality}, {name}: {error}: {case:?}"));
                let shares = shares(quality, case, &outcome, exact(&table, effects, case, &outcome));
                summary.add(case, name, &outcome, shares);
            }
        }
        summary
    });
    parts.reduce(Summary::default, Summary::and)
}

fn assert_none(offences: &[String]) {
    assert!(offences.is_empty(), "{} promises are not kept:\n{}", offences.len(), offences.join("\n"));
}

/// How many cases of each family are run: more take longer and find more.
fn most() -> usize {
    match std::env::var("SOFTBOX_CONFORMING_CASES") {
        Ok(text) => text
            .parse()
            .unwrap_or_else(|_| panic!("SOFTBOX_CONFORMING_CASES is {text}, and should be a number")),
        Err(_) => 8,
    }
}

#[test]
fn every_level_keeps_its_bounds_on_any_device_that_keeps_the_order_of_the_text() {
    let cases = thinned(1, most());
    let mut offences = Vec::new();
    for quality in Quality::ALL {
        let summary = summarised(WGSL_INCLUDE, quality, &cases, &in_order());
        println!("{quality}, in order:\n{summary}");
        offences.extend(summary.offences(&format!("{quality}, in order")));
    }
    assert_none(&offences);
}

/// Every operation errs as far as it may, in the direction that moves the value most.
#[test]
fn every_level_keeps_its_bounds_on_the_worst_device() {
    let mut cases = thinned(1, most().div_ceil(2));
    cases.retain(|case| !matches!(case.bound, Bound::Physical));
    let mut offences = Vec::new();
    for quality in Quality::ALL {
        let effects = evaluation::effects(quality);
        let table = evaluation::table(effects);
        let kernel = evaluation::kernel(WGSL_INCLUDE, effects, &cases);
        let indices: Vec<usize> = (0..cases.len()).collect();
        let parts = indices.par_chunks(1).map(|chunk| {
            let mut machine = kernel.machine();
            let mut summary = Summary::default();
            for &index in chunk {
                let case = &cases[index];
                let orders = [("worst", Policy::exact()), ("worst in another order", Policy::ordered(3))];
                let orders = &orders[..if case.is_within(&REORDERED) { 2 } else { 1 }];
                for (name, order) in orders {
                    let policy = order.with_rounding(softbox::interpret::Rounding::Nearest);
                    let worst = machine.worst(index as u32, policy, 3);
                    for (part, worst) in
                        worst.unwrap_or_else(|error| panic!("{error}: {case:?}")).iter().enumerate()
                    {
                        for outcome in &worst.found {
                            let shares =
                                shares(quality, case, outcome, exact(&table, effects, case, outcome));
                            summary.add(case, name, outcome, shares);
                        }
                        let reach = worst.found.iter().map(|outcome| f64::from(outcome.values[part]));
                        summary.predict(worst.predicted, reach, f64::from(worst.nearest));
                    }
                }
            }
            summary
        });
        let summary = parts.reduce(Summary::default, Summary::and);
        println!("{quality}, worst:\n{summary}");
        offences.extend(summary.offences(&format!("{quality}, worst")));
    }
    assert_none(&offences);
}

/// Rounding as IEEE 754 does, a device writes what the interpreter writes that does nothing but count, to the bit.
#[test]
fn the_exact_device_is_plain_single_precision() {
    let cases = thinned(1, 12);
    let mut offences = Vec::new();
    for quality in Quality::ALL {
        let effects = evaluation::effects(quality);
        let kernel = evaluation::kernel(WGSL_INCLUDE, effects, &cases);
        let mut machine = kernel.machine();
        let mut plain = evaluation::plain(WGSL_INCLUDE, effects, &cases);
        let mut lit = 0;
        for (index, case) in cases.iter().enumerate() {
            let outcome = machine.run(index as u32, Policy::exact());
            let outcome = outcome.unwrap_or_else(|error| panic!("{error}: {case:?}"));
            plain.run(index as u32).unwrap_or_else(|error| panic!("{error}: {case:?}"));
            let written: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(plain.buffer(4));
            let bits = |values: &[f32]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&outcome.values), bits(&written[index]), "{quality}: {outcome:?} of {case:?}");
            lit += usize::from(outcome.values[0] > 0.0);
        }
        assert!(2 * lit > cases.len(), "{quality}: {lit} of {} are lit", cases.len());
        let strict = [("exact".to_owned(), Policy::exact())];
        let summary = summarised(WGSL_INCLUDE, quality, &cases, &strict);
        offences.extend(summary.offences(&format!("{quality}, exact")));
    }
    assert_none(&offences);
}
