//! Where the include looks, and how blurred.

use glam::{DVec2, DVec3, Vec2, Vec3};
use softbox::fit::{fit_lookup, lookup_loss};
use softbox::report::{Quad, Region, form_factors, lookup_sights, random_quads};
use softbox::shade::{
    LTC_LOOKUP, LookupConstants, LtcLookup, ltc_lookup, ltc_quad, ltc_rectangle_diffuse_lookup,
    ltc_rectangle_lookup, ltc_surface,
};
use softbox::table::Table;

use crate::common::Random;

pub const TEXELS: f64 = 256.0;

/// The look-ups of diffuse light and of the lobe, in f64.
pub fn lookups(table: &Table, quad: &Quad, texels: [f64; 2], pair: bool) -> [LtcLookup<f64>; 2] {
    let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, quad.view, quad.roughness);
    let lobe = table.lobe(&surface);
    let [diffuse, specular] = form_factors(&lobe, quad.corners);
    let [a, b, _, d] = quad.corners;
    [
        ltc_rectangle_diffuse_lookup::<f64>(&surface, [a, b, d], diffuse, texels.into(), pair),
        ltc_rectangle_lookup::<f64>(&surface, &lobe, [a, b, d], specular, texels.into(), pair),
    ]
}

fn quads(count: usize) -> Vec<Quad> {
    random_quads(Region { roughness: (0.05, 1.0), cosine: (0.05, 1.0) }, count)
}

/// Whether the lobe sees enough of a quad for its picture to matter.
pub fn is_seen(table: &Table, quad: &Quad) -> bool {
    let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, quad.view, quad.roughness);
    let lobe = table.lobe(&surface);
    form_factors(&lobe, quad.corners).into_iter().all(|vector| vector.z > 1e-4)
}

/// Someone at the surface point who looks along +y, the z-axis up and so the x-axis to the right, sees the picture
/// the right way round.
#[test]
fn the_picture_is_seen_the_right_way_round_from_the_emitting_side() {
    let (left, right, lower, upper) = (-1.0, 1.0, 1.0, 3.0);
    let at = |x: f64, z: f64| DVec3::new(x, 5.0, z);
    let corners = [at(left, lower), at(right, lower), at(right, upper), at(left, upper)];
    let table = Table::default();
    for (x, z) in [(-0.5, 2.5), (0.5, 2.5), (0.5, 1.5), (-0.5, 1.5), (0.0, 2.0), (0.9, 1.2)] {
        // A view whose mirror direction points to that place of the light.
        let direction = at(x, z).normalize();
        let view = DVec3::new(-direction.x, -direction.y, direction.z);
        let quad = Quad { roughness: 0.03, view, corners };
        let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, view, quad.roughness);
        assert!(ltc_quad(&surface, &table.lobe(&surface), corners, false).y > 0.5, "the light does not emit");
        let wanted = DVec2::new((x - left) / (right - left), (upper - z) / (upper - lower));
        let place = lookups(&table, &quad, [TEXELS; 2], false)[1].place;
        assert!((place - wanted).length() < 0.01, "{place}, not {wanted}: {x} {z}");
    }
}

/// A quarter turn of the picture on the light is one of the look-up.
#[test]
fn turning_the_corners_turns_the_picture() {
    let table = Table::default();
    for quad in quads(2000).into_iter().filter(|quad| is_seen(&table, quad)) {
        let [a, b, c, d] = quad.corners;
        let turned = Quad { corners: [b, c, d, a], ..quad.clone() };
        for pair in [false, true] {
            let plain = lookups(&table, &quad, [512.0, 128.0], pair);
            let turned = lookups(&table, &turned, [128.0, 512.0], pair);
            for (plain, turned) in plain.into_iter().zip(turned) {
                let wanted = DVec2::new(1.0 - plain.place.y, plain.place.x);
                let apart = DVec2::new(-plain.apart.y, plain.apart.x);
                let difference = (turned.place - wanted).length()
                    + (turned.apart - apart).length().min((turned.apart + apart).length())
                    + (turned.level - plain.level).abs();
                assert!(difference < 1e-6, "{plain:?} and {turned:?} differ: {quad:?}");
            }
        }
    }
}

/// What matters of a distant light, or of one that fills none of the lobe, is its mean.
#[test]
fn distant_lights_show_their_mean() {
    let table = Table::default();
    let mut random = Random::new(6);
    for _ in 0..1000 {
        let centre = random.direction();
        let centre = DVec3::new(centre.x, centre.y, centre.z.abs().max(0.2)) * random.log(200.0, 1e6);
        let side = random.direction();
        let x = side.cross(centre).normalize() * 0.5;
        let y = centre.cross(x).normalize() * 0.5;
        let corners = [centre - x + y, centre + x + y, centre + x - y, centre - x - y];
        let quad = Quad { roughness: random.between(0.5, 1.0), view: DVec3::new(0.6, 0.0, 0.8), corners };
        for lookup in lookups(&table, &quad, [TEXELS; 2], false) {
            assert!(lookup.level >= TEXELS.log2(), "level {}: {quad:?}", lookup.level);
        }
    }
}

#[test]
fn blur_grows_with_roughness() {
    let table = Table::default();
    for (cosine, distance) in [(0.95_f64, 1.0), (0.8, 3.0), (0.5, 0.7), (0.3, 2.0)] {
        let sine = (1.0 - cosine * cosine).sqrt();
        let (view, mirror) = (DVec3::new(sine, 0.0, cosine), DVec3::new(-sine, 0.0, cosine));
        let centre = mirror * distance;
        let (x, y) = (DVec3::Y * 0.5, DVec3::new(cosine, 0.0, sine) * 0.5);
        let corners = [centre - x - y, centre + x - y, centre + x + y, centre - x + y];
        for pair in [false, true] {
            let mut last = -1.0;
            for step in 2..=100 {
                let quad = Quad { roughness: f64::from(step) / 100.0, view, corners };
                let level = lookups(&table, &quad, [TEXELS; 2], pair)[1].level;
                // Two lobes of the table may differ in shape by more than in width.
                assert!(level >= last - 0.02, "level {level} after {last}, pair {pair}: {quad:?}");
                last = level;
            }
            assert!(last > 5.5, "level {last} at the roughest, cosine {cosine}");
        }
    }
}

fn is_sound(lookup: &LtcLookup<f32>) -> bool {
    let (place, apart) = (lookup.place, lookup.apart);
    let inside = |c: f32| (0.0..=1.0).contains(&c);
    inside(place.x) && inside(place.y) && apart.is_finite() && (0.0..1e3).contains(&lookup.level)
}

/// No finite input makes anything else than a place on the picture and a level.
#[test]
fn degenerate_lights_keep_to_the_picture() {
    let table = Table::default();
    let mut random = Random::new(7);
    for index in 0..200_000 {
        let mut vector = || match index % 4 {
            0 => Vec3::new(random.finite(), random.finite(), random.finite()),
            1 => (random.direction() * random.log(1e-30, 1e30)).as_vec3(),
            2 => Vec3::new(
                random.index(3) as f32 - 1.0,
                random.index(3) as f32 - 1.0,
                random.index(3) as f32 - 1.0,
            ),
            _ => random.direction().as_vec3() * 1e-3 + Vec3::new(0.0, 0.0, 1.0),
        };
        let corners = [vector(), vector(), vector()];
        let (toward, position) = (vector(), if index % 8 < 4 { Vec3::ZERO } else { vector() });
        let (normal, view) = (random.direction().as_vec3(), random.direction().as_vec3());
        let surface = ltc_surface::<f32>(position, normal, view, random.unit() as f32);
        let lobe = table.lobe(&surface);
        for pair in [false, true] {
            let texels = Vec2::new(1.0 + random.index(8192) as f32, 1.0 + random.index(8192) as f32);
            let specular = ltc_rectangle_lookup::<f32>(&surface, &lobe, corners, toward, texels, pair);
            let diffuse = ltc_rectangle_diffuse_lookup::<f32>(&surface, corners, toward, texels, pair);
            for lookup in [specular, diffuse] {
                assert!(is_sound(&lookup), "{lookup:?}: {surface:?} {corners:?} {toward} {texels} {pair}");
            }
        }
    }
}

/// Rounding: a hundredth of a level, and of the picture where it is that sharp.
#[test]
fn single_precision_is_enough() {
    let table = Table::default();
    let mut worst = [0.0_f64; 2];
    for quad in quads(4000).into_iter().filter(|quad| is_seen(&table, quad)) {
        let surface = ltc_surface::<f32>(Vec3::ZERO, Vec3::Z, quad.view.as_vec3(), quad.roughness as f32);
        let lobe = table.lobe(&surface);
        let exact_surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, quad.view, quad.roughness);
        let vectors = form_factors(&table.lobe(&exact_surface), quad.corners).map(|vector| vector.as_vec3());
        let [a, b, _, d] = quad.corners.map(|corner| corner.as_vec3());
        for pair in [false, true] {
            let texels = Vec2::splat(TEXELS as f32);
            let single = [
                ltc_rectangle_diffuse_lookup::<f32>(&surface, [a, b, d], vectors[0], texels, pair),
                ltc_rectangle_lookup::<f32>(&surface, &lobe, [a, b, d], vectors[1], texels, pair),
            ];
            for (single, exact) in single.iter().zip(lookups(&table, &quad, [TEXELS; 2], pair)) {
                // What matters is the picture, blurred so much: places count in units of the blur.
                let blur = exact.level.exp2() / TEXELS;
                let place = (single.place.as_dvec2() - exact.place).length() / blur;
                let level = (f64::from(single.level) - exact.level).abs();
                worst = [worst[0].max(place), worst[1].max(level)];
                assert!(place < 0.02 && level < 0.01, "{single:?}, not {exact:?}: {quad:?}");
            }
        }
    }
    println!("places differ by {:.1e} of the blur, levels by {:.1e}", worst[0], worst[1]);
}

/// A light straight ahead is looked up in its middle; the blur has the size that the relation states.
#[test]
fn a_light_straight_ahead_is_looked_up_in_the_middle() {
    for distance in [0.3, 1.0, 4.0, 20.0] {
        let (corner, u, v) = (DVec3::new(-0.5, 0.5, distance), DVec3::X, -DVec3::Y);
        let normal = u.cross(v);
        let rise = DVec3::Z;
        let lookup = ltc_lookup::<f64>(
            DVec3::Z,
            rise,
            v.cross(corner),
            corner.cross(u),
            normal,
            corner.dot(normal),
            DVec2::splat(TEXELS),
            false,
        );
        assert!((lookup.place - DVec2::splat(0.5)).length() < 1e-12, "{lookup:?}");
        let waves = 2.0 * core::f64::consts::PI.powi(2);
        let variance = (1.0 + waves * (LTC_LOOKUP.blur * distance).powi(2)).ln() / waves;
        let level = 0.5 * ((variance * TEXELS * TEXELS + 4.0 / 9.0) / (4.0 / 9.0 + 1.0 / 6.0)).log2();
        assert!((lookup.level - level).abs() < 1e-9, "{} and {level} differ at {distance}", lookup.level);
        assert_eq!(lookup.apart, DVec2::ZERO);
    }
}

/// The include's constants are as good as a fresh fit, and no longer so when one is changed.
#[test]
fn the_constants_are_those_of_the_fit() {
    let table = Table::default();
    let sets = lookup_sights(&table, 300);
    let (fitted, losses) = fit_lookup(&sets);
    println!("{fitted:?} with losses {losses:?}");
    for (pair, fresh) in losses.into_iter().enumerate() {
        let mean = |constants: &LookupConstants| {
            sets.iter().map(|set| lookup_loss(constants, set, pair == 1)).sum::<f64>() / sets.len() as f64
        };
        let stored = mean(&LTC_LOOKUP);
        assert!(stored < 1.04 * fresh, "loss {stored} of the include's constants, {fresh} of {fitted:?}");
        let changed = LookupConstants { blur: 0.5 * LTC_LOOKUP.blur, ..LTC_LOOKUP };
        assert!(mean(&changed) > 1.1 * fresh, "loss {} of half the blur, {fresh} of the fit", mean(&changed));
    }
}
