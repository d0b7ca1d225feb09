//! Surfaces of two and of three lobes: the tables are sound, baked again they are the same, and their errors hold.

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use softbox::effects::Quality;
use softbox::fit::{bake_lobes, ggx};
use softbox::report::{Quad, Region, random_quads};
use softbox::shade::{LtcLobes, LtcSurface, ltc_lobes_part, ltc_quad, ltc_surface};
use softbox::table::{Layer, Table};
use softbox::truth;

const COUNTS: [usize; 2] = [2, 3];

fn table(count: usize) -> Table {
    if count == 2 { Table::two_lobes() } else { Table::three_lobes() }
}

fn surface(roughness: f64, cosine: f64) -> LtcSurface<f64> {
    let view = DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine);
    ltc_surface(DVec3::ZERO, DVec3::Z, view, roughness)
}

fn bake(count: usize, size: usize) -> Table {
    Table::pack_lobes(&bake_lobes(&ggx, count, size, &|_| ()))
}

#[test]
fn the_committed_tables_are_what_a_bake_gives() {
    assert!(bake(2, 64).bytes() == softbox::TABLE_TWO_LOBES, "table/ltc_two_lobes.bin is stale");
    assert!(bake(3, 64).bytes() == softbox::TABLE_THREE_LOBES, "table/ltc_three_lobes.bin is stale");
}

#[test]
fn a_bake_does_not_depend_on_the_number_of_threads() {
    for count in COUNTS {
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
            pool.install(|| bake(count, 9).bytes())
        };
        assert!(with(1) == with(3), "{count} lobes");
    }
}

#[test]
fn every_size_bakes() {
    for count in COUNTS {
        for size in [2, 3, 7] {
            let table = bake(count, size);
            let layers: &[Layer] = if count == 2 { &Layer::TWO_LOBES } else { &Layer::THREE_LOBES };
            assert_eq!(Table::from_layers(size, layers, &table.bytes()), Ok(table), "{count} lobes, {size}");
        }
    }
}

#[test]
fn progress_rises_to_one() {
    let shares = std::sync::Mutex::new(Vec::new());
    bake_lobes(&ggx, 2, 5, &|share| shares.lock().expect("no panic").push(share));
    let shares = shares.into_inner().expect("no panic");
    assert!(shares.iter().all(|share| (0.0..=1.0).contains(share)), "{shares:?}");
    assert_eq!(shares.last(), Some(&1.0), "{shares:?}");
}

#[test]
fn no_texel_is_subnormal() {
    for count in COUNTS {
        let table = table(count);
        for (layer, row, column) in
            (0..table.layers().len()).flat_map(|l| (0..64 * 64).map(move |i| (l, i / 64, i % 64)))
        {
            let texel = table.texel(layer, column, row);
            let sound = texel.iter().all(|n| n.is_finite() && (n.to_f32() == 0.0 || n.is_normal()));
            assert!(sound, "{count} lobes, layer {layer} ({column}, {row}): {texel:?}");
        }
    }
}

/// At the texels and between them: positive weights that add up to the albedo, and lobes that are not flat.
#[test]
fn lobes_are_lobes_everywhere() {
    let single = Table::default();
    for count in COUNTS {
        let table = table(count);
        let steps = 3 * 63;
        for (i, j) in (0..=steps).flat_map(|i| (0..=steps).map(move |j| (i, j))) {
            let root = f64::from(j) / f64::from(steps);
            let surface = surface(f64::from(i) / f64::from(steps), root * root);
            let lobes = table.lobes(&surface, count);
            let at = format!("{count} lobes, roughness {}, cosine {}", surface.roughness, surface.cos_view);
            for lobe in lobes.as_slice() {
                assert!(lobe.albedo > 0.0, "{at}: weight {}", lobe.albedo);
                let (x, w) = (lobe.axis_x.dot(surface.tangent), lobe.axis_z.dot(surface.normal));
                let determinant = lobe.axis_x.dot(lobe.normal_x);
                assert!(x > 0.0 && w > 0.0, "{at}: x {x}, w {w}");
                assert!(determinant > 0.02 * x * w, "{at}: |M⁻¹| {determinant}, x·w {}", x * w);
            }
            let sum: f64 = lobes.as_slice().iter().map(|lobe| lobe.albedo).sum();
            let expected = single.lobe(&surface).albedo;
            assert!((sum - expected).abs() < 2e-3, "{at}: the weights add up to {sum}, not {expected}");
        }
    }
}

/// A view along the normal has no azimuth, and what rounding says of it must not show: lobes are round there.
#[test]
fn seen_along_the_normal_light_may_turn_around_it() {
    for count in COUNTS {
        let table = table(count);
        for roughness in [0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0] {
            let surface = surface(roughness, 1.0);
            let lobes = table.lobes(&surface, count);
            let value = |turn: f64| {
                let corner = |x: f64, y: f64| {
                    let (sin, cos) = turn.sin_cos();
                    DVec3::new(cos * x - sin * y, sin * x + cos * y, 1.5)
                };
                let corners = [corner(0.2, -0.3), corner(0.2, 0.9), corner(0.9, 0.9), corner(0.9, -0.3)];
                ltc_quad(&surface, &lobes, corners, false)
            };
            let still = value(0.0);
            for turn in [0.4, 1.1, 2.0, 4.4] {
                let turned = value(turn);
                let difference = (turned - still).abs().max_element();
                assert!(difference < 1e-12, "{count} lobes, roughness {roughness}: {turned} and {still}");
            }
        }
    }
}

/// What lights are culled by holds for sums of lobes: no small light is brighter than the peak says.
#[test]
fn no_small_light_is_brighter_than_the_peak() {
    for (count, level) in [(2, Quality::Fine), (3, Quality::Finest)] {
        let table = table(count);
        let effects = level.of("quad+ggx".parse().expect("a set"));
        let least = 0.3;
        let peak = table.peak_with(least, effects);
        let (mut brightest, half) = (0.0_f64, 1e-3);
        for (i, j, k) in (0..12).flat_map(|i| (0..12).flat_map(move |j| (0..40).map(move |k| (i, j, k)))) {
            let roughness = least + (1.0 - least) * f64::from(i) / 11.0;
            let surface = surface(roughness, 0.02 + 0.98 * f64::from(j) / 11.0);
            let angle = -1.55 + 3.1 * f64::from(k) / 39.0;
            let direction = DVec3::new(angle.sin(), 0.0, angle.cos());
            let (x, y) = (DVec3::new(angle.cos(), 0.0, -angle.sin()) * half, DVec3::Y * half);
            let corners = [direction - x - y, direction - x + y, direction + x + y, direction + x - y];
            let value = ltc_quad(&surface, &table.lobes(&surface, count), corners, false);
            brightest = brightest.max(value.y / (4.0 * half * half));
        }
        assert!(brightest <= peak, "{count} lobes: {brightest} is more than {peak}");
        // A bound that is far off culls nothing.
        assert!(brightest > 0.3 * peak, "{count} lobes: {brightest} is far from {peak}");
    }
}

/// A light that covers the whole hemisphere gets the albedo and the Schlick part, which the default table holds.
#[test]
fn a_light_all_around_gets_everything() {
    let single = Table::default();
    let far = 1e6;
    let sky = [(-far, -far), (-far, far), (far, far), (far, -far)].map(|(x, y)| DVec3::new(x, y, 1.0));
    for count in COUNTS {
        let table = table(count);
        for (roughness, cosine) in [(0.1, 0.9), (0.3, 0.5), (0.3, 0.2), (0.6, 0.7), (0.8, 0.15), (1.0, 1.0)] {
            let surface = surface(roughness, cosine);
            let value = ltc_quad(&surface, &table.lobes(&surface, count), sky, false);
            let whole = single.lobe(&surface);
            let at = format!("{count} lobes, roughness {roughness}, cosine {cosine}");
            assert!((value.y - whole.albedo).abs() < 2e-3, "{at}: {} is not {}", value.y, whole.albedo);
            assert!((value.z - whole.fresnel).abs() < 2e-3, "{at}: {} is not {}", value.z, whole.fresnel);
        }
    }
}

/// Mean |error| over mean value in per cent: specular, Schlick part, dielectric.
fn errors(count: usize, quads: &[Quad]) -> [f64; 3] {
    let table = table(count);
    let rows: Vec<[[f64; 2]; 3]> = quads
        .par_iter()
        .map(|quad| {
            let exact = truth::polygon(ggx(quad.roughness).as_ref(), quad.view, &quad.corners, false, 1e-5);
            let surface = ltc_surface(DVec3::ZERO, DVec3::Z, quad.view, quad.roughness);
            let value = ltc_quad(&surface, &table.lobes(&surface, count), quad.corners, false);
            let parts =
                |specular: f64, fresnel: f64| [specular, fresnel, 0.04 * (specular - fresnel) + fresnel];
            let (found, exact) = (parts(value.y, value.z), parts(exact.specular, exact.fresnel));
            core::array::from_fn(|k| [(found[k] - exact[k]).abs(), exact[k]])
        })
        .collect();
    core::array::from_fn(|k| {
        let sum = |which: usize| rows.iter().map(|row| row[k][which]).sum::<f64>();
        100.0 * sum(0) / sum(1)
    })
}

fn assert_within(what: &str, measured: [f64; 3], bounds: [f64; 3]) {
    println!("{what}: {measured:.2?}");
    assert!((0..3).all(|k| measured[k] <= bounds[k]), "{what}: {measured:.3?} is beyond {bounds:?}");
}

#[test]
fn errors_over_everything_hold() {
    let quads = random_quads(Region { roughness: (0.1, 1.0), cosine: (0.05, 1.0) }, 3000);
    assert_within("two lobes", errors(2, &quads), [0.95, 4.5, 3.2]);
    assert_within("three lobes", errors(3, &quads), [0.6, 3.6, 2.5]);
}

type Range = (f64, f64);

/// For two lobes, then for three.
type Bounds = [[f64; 3]; 2];

/// By ranges of roughness and of the cosine; the last two of these lie beyond what the figure above covers.
const REGIONS: [(Range, Range, Bounds); 12] = [
    ((0.02, 0.1), (0.3, 1.0), [[0.03, 0.25, 0.12], [0.03, 0.25, 0.12]]),
    ((0.02, 0.1), (0.05, 0.3), [[0.2, 0.25, 0.25], [0.2, 0.25, 0.25]]),
    ((0.1, 0.3), (0.6, 1.0), [[0.2, 13.0, 0.6], [0.15, 13.0, 0.6]]),
    ((0.1, 0.3), (0.3, 0.6), [[0.5, 2.5, 1.7], [0.35, 2.3, 1.6]]),
    ((0.1, 0.3), (0.05, 0.3), [[1.5, 2.0, 1.8], [1.1, 1.6, 1.5]]),
    ((0.3, 0.6), (0.6, 1.0), [[0.7, 24.0, 1.5], [0.4, 20.0, 1.2]]),
    ((0.3, 0.6), (0.3, 0.6), [[1.4, 7.2, 4.2], [0.9, 5.6, 3.1]]),
    ((0.3, 0.6), (0.05, 0.3), [[2.7, 5.2, 4.6], [1.8, 4.3, 3.7]]),
    ((0.6, 1.0), (0.6, 1.0), [[0.6, 26.0, 2.0], [0.3, 23.0, 1.6]]),
    ((0.6, 1.0), (0.3, 0.6), [[1.2, 12.0, 5.2], [0.8, 10.5, 4.6]]),
    ((0.6, 1.0), (0.05, 0.3), [[2.4, 15.0, 11.0], [1.1, 11.5, 8.2]]),
    ((0.1, 1.0), (0.01, 0.05), [[6.5, 8.0, 7.5], [5.0, 6.5, 6.0]]),
];

#[test]
fn errors_of_every_region_hold() {
    for (roughness, cosine, bounds) in REGIONS {
        let quads = random_quads(Region { roughness, cosine }, 400);
        for (count, bounds) in COUNTS.into_iter().zip(bounds) {
            let what = format!("{count} lobes, roughness {roughness:?}, cosine {cosine:?}");
            assert_within(&what, errors(count, &quads), bounds);
        }
    }
}

/// Along sweeps of roughness and of the view the error changes slowly: it has no steps at the texels or between them
/// where the truth has none.
#[test]
fn values_follow_the_truth_without_steps() {
    let light = |x: f64, y: f64, z: f64, half: f64| {
        [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)]
            .map(|(u, v)| DVec3::new(x + half * u, y + half * v, z))
    };
    let lights = [light(-1.0, 0.0, 1.0, 0.7), light(0.0, 0.5, 1.0, 0.3), light(-3.0, 0.5, 0.8, 1.5)];
    // Of a white metal and of a dielectric.
    let parts = |specular: f64, fresnel: f64| [specular, 0.04 * (specular - fresnel) + fresnel];
    // Roughness and the root of the cosine, three steps a texel, over the views from the cosine 0.05 on: at more grazing
    // ones the errors themselves are larger.
    let sweeps: [fn(f64) -> (f64, f64); 5] = [
        |t| (0.1 + 0.9 * t, 0.95),
        |t| (0.1 + 0.9 * t, 0.4),
        |t| (0.25, 0.23 + 0.77 * t),
        |t| (0.5, 0.23 + 0.77 * t),
        |t| (0.9, 0.23 + 0.77 * t),
    ];
    for (number, sweep) in sweeps.iter().enumerate() {
        for corners in lights {
            let place = |i: usize| {
                let (roughness, root) = sweep(i as f64 / 188.0);
                surface(roughness, root * root)
            };
            let exact: Vec<[f64; 2]> = (0..189)
                .into_par_iter()
                .map(|i| {
                    let at = place(i);
                    let view = DVec3::new(at.sin_view, 0.0, at.cos_view);
                    let value = truth::polygon(ggx(at.roughness).as_ref(), view, &corners, false, 1e-5);
                    parts(value.specular, value.fresnel)
                })
                .collect();
            for count in COUNTS {
                let table = table(count);
                let error: Vec<[f64; 2]> = (0..189)
                    .map(|i| {
                        let at = place(i);
                        let value = ltc_quad(&at, &table.lobes(&at, count), corners, false);
                        let found = parts(value.y, value.z);
                        [found[0] - exact[i][0], found[1] - exact[i][1]]
                    })
                    .collect();
                for (part, bound) in [(0, 0.012), (1, 0.02)] {
                    let largest = exact.iter().map(|value| value[part]).fold(0.0, f64::max);
                    for i in 1..189 {
                        let step = (error[i][part] - error[i - 1][part]).abs() / largest;
                        assert!(
                            step < bound,
                            "{count} lobes, sweep {number}, {corners:?}, part {part} at {:?}: the error goes from {} to {}, the largest value is {largest}",
                            sweep(i as f64 / 188.0),
                            error[i - 1][part],
                            error[i][part]
                        );
                    }
                }
            }
        }
    }
}

/// Parts are physical for every vector form factor that there can be, and in single precision the same.
#[test]
fn parts_are_physical() {
    let towards: Vec<DVec3> = (0..200)
        .map(|i| {
            let (turn, height) = (f64::from(i) * 2.399_963, (f64::from(i) + 0.5) / 200.0);
            let radius = (1.0_f64 - height * height).sqrt();
            DVec3::new(radius * turn.cos(), radius * turn.sin(), height) * f64::from(i % 7) / 6.0
        })
        .collect();
    for count in COUNTS {
        let table = table(count);
        for (roughness, cosine) in [(0.0, 1.0), (0.02, 0.0), (0.1, 0.01), (0.3, 0.3), (0.7, 0.05), (1.0, 1.0)]
        {
            let exact = surface(roughness, cosine);
            let view = Vec3::new((1.0 - cosine * cosine).max(0.0).sqrt() as f32, 0.0, cosine as f32);
            let single = ltc_surface::<f32>(Vec3::ZERO, Vec3::Z, view, roughness as f32);
            let lobes: LtcLobes<f64> = table.lobes(&exact, count);
            let single_lobes: LtcLobes<f32> = table.lobes(&single, count);
            for (lobe, single_lobe) in lobes.as_slice().iter().zip(single_lobes.as_slice()) {
                for toward in &towards {
                    let [specular, fresnel] = ltc_lobes_part(&exact, lobe, *toward).into();
                    let [s, f] = ltc_lobes_part(&single, single_lobe, toward.as_vec3()).into();
                    let at = format!("{count} lobes, roughness {roughness}, cosine {cosine}, {toward}");
                    let physical =
                        (0.0..=lobe.albedo).contains(&specular) && (0.0..=specular).contains(&fresnel);
                    assert!(physical, "{at}: ({specular}, {fresnel}) of {}", lobe.albedo);
                    let near = (specular - f64::from(s)).abs() + (fresnel - f64::from(f)).abs() < 2e-4;
                    assert!(near, "{at}: ({specular}, {fresnel}) is ({s}, {f}) in f32");
                }
            }
        }
    }
}
