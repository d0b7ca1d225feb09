//! Tubes in hard places: vector form factors are bounded, and nothing jumps.

mod common;

use common::{Case, Random, Shape, cases};
use glam::Vec3;
use softbox::shade::{LtcSurface, Real, Vector, ltc_surface, ltc_tube, ltc_tube_begin, ltc_tube_lobe};
use softbox::table::Table;

/// A surface and a tube.
#[derive(Clone, Copy, Debug)]
struct Tube {
    view: Vec3,
    normal: Vec3,
    position: Vec3,
    roughness: f32,
    start: Vec3,
    end: Vec3,
    radius: f32,
    caps: bool,
}

impl Tube {
    fn surface<R: Real>(&self) -> LtcSurface<R> {
        let roughness = R::new(self.roughness.into());
        ltc_surface(vector::<R>(self.position), vector::<R>(self.normal), vector::<R>(self.view), roughness)
    }
}

fn vector<R: Real>(v: Vec3) -> R::Vec3 {
    R::Vec3::new(R::new(v.x.into()), R::new(v.y.into()), R::new(v.z.into()))
}

/// The tubes among the hard cases.
fn tubes(scale: usize, any_numbers: bool) -> Vec<Tube> {
    let tube = |case: Case| match case.shape {
        Shape::Tube { start, end, radius, caps } if any_numbers || case.family != "any finite numbers" => {
            let Case { view, normal, position, roughness, .. } = case;
            Some(Tube { view, normal, position, roughness, start, end, radius, caps })
        }
        _ => None,
    };
    cases(scale).into_iter().filter_map(tube).collect()
}

/// No vector form factor is longer than that of the whole hemisphere.
#[test]
fn vector_form_factors_are_bounded() {
    let table = Table::default();
    let mut longest = 0.0_f32;
    for case in tubes(30, true) {
        let surface = case.surface::<f32>();
        let tube = ltc_tube_begin(&surface, case.start, case.end, case.radius, case.caps);
        let toward = ltc_tube_lobe(&tube, &table.lobe(&surface));
        assert!(
            toward.z >= 0.0 && toward.length() < 1.0 + 1e-5,
            "{toward:?}, length {}: {case:?}",
            toward.length()
        );
        longest = longest.max(toward.length());
    }
    println!("longest {longest}");
}

/// The largest change left where light changes fastest while a tube moves, after looking closer and closer there.
fn jump(table: &Table, from: &Tube, to: &Tube) -> (f64, f64) {
    let surface = from.surface::<f64>();
    let lobe = table.lobe(&surface);
    let value = |t: f64| {
        let mix = |a: Vec3, b: Vec3| a.as_dvec3().lerp(b.as_dvec3(), t);
        let radius = f64::from(from.radius) * (1.0 - t) + f64::from(to.radius) * t;
        ltc_tube(&surface, &lobe, mix(from.start, to.start), mix(from.end, to.end), radius, from.caps)
    };
    let (mut low, mut width, mut largest) = (0.0, 1.0, 0.0);
    for steps in [1000.0, 16.0, 16.0, 16.0, 16.0, 16.0, 16.0, 16.0] {
        width /= steps;
        let change = |i: f64| {
            let change = (value(low + width * (i + 1.0)) - value(low + width * i)).abs();
            change.x.max(change.y)
        };
        let mut fastest = 0.0;
        largest = 0.0;
        for i in 0..steps as u32 {
            if change(f64::from(i)) > largest {
                (fastest, largest) = (f64::from(i), change(f64::from(i)));
            }
        }
        low += width * fastest;
    }
    (low, largest)
}

/// Nothing jumps while tubes move through both horizons and the surface point, grow, shrink and vanish.
#[test]
fn moving_tubes_change_their_light_continuously() {
    let table = Table::default();
    let all = tubes(10, false);
    let mut random = Random::new(25);
    let mut worst = 0.0_f64;
    for from in &all {
        let to = &all[random.index(all.len())];
        let view = (from.view + Vec3::Z * 0.3).normalize();
        let from = Tube { roughness: from.roughness.max(0.3), view, ..*from };
        // Thinner tubes change faster than the last look resolves, and one of no width through the point has no limit.
        let limited = |case: &Tube| (1e-5..30.0).contains(&case.radius);
        if !limited(&from) || !limited(to) {
            continue;
        }
        let (at, left) = jump(&table, &from, to);
        worst = worst.max(left);
        assert!(left < 1e-3, "a jump of {left} at {at}: {from:?} to {to:?}");
    }
    println!("the largest jump is {worst:.1e}");
}
