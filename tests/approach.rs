//! The ways to hard places: this library stays within its bounds along each, the published forms do not.

use core::f64::consts::TAU;
use std::path::Path;

use softbox::device::Device;
use softbox::effects::Quality;
use softbox::light::Light;
use softbox::scene::Scene;
use softbox::stability::approach::{
    Approach, Curve, EdgeForm, Measure, Method, OVERVIEW_NAME, Tables, VARIANTS, approaches, charts, curves,
    parameters, read, table,
};
use softbox::stability::{BothError, scene_by_both};

const PRINTED: Method = Method::Polygon(EdgeForm::Printed);
const FITTED: Method = Method::Polygon(EdgeForm::Fitted);

fn levels(approach: &Approach) -> impl Iterator<Item = Method> {
    Method::of(approach).into_iter().filter(|method| method.is_ours())
}

fn approach(name: &str) -> Approach {
    approaches().into_iter().find(|approach| approach.name == name).expect("the approach is there")
}

#[test]
fn every_level_stays_within_its_bound() {
    let tables = Tables::default();
    for approach in approaches() {
        for method in levels(&approach) {
            let mut worst = 0.0_f64;
            for parameter in parameters(&approach) {
                for variant in 0..VARIANTS {
                    let setting = approach.setting(parameter, variant);
                    let bound = approach.bound(method, &setting, parameter);
                    let reading = read(&approach, method, &tables, &setting);
                    worst = worst.max(reading.error / bound);
                    assert!(
                        // The albedos of a table may pass 1 by their own fit.
                        reading.error <= bound && (0.0..=1.001).contains(&reading.value),
                        "{}, {method:?}: {reading:?}, bound {bound:e}, at {parameter:e}, variant {variant}: {setting:?}",
                        approach.name
                    );
                }
            }
            println!("{}, {}: at most {worst:.3} of the bound", approach.name, method.label());
        }
    }
}

/// From each parameter over the f32 numbers next to it, and over a step of a thousandth: what a pixel's neighbour gets.
#[test]
fn no_level_jumps() {
    let tables = Tables::default();
    for approach in approaches() {
        for method in levels(&approach) {
            for parameter in parameters(&approach).into_iter().step_by(4) {
                for variant in 0..6 {
                    let single = parameter as f32;
                    let beside =
                        [single.next_up(), single.next_up().next_up(), single.next_down(), single * 1.001];
                    let setting = approach.setting(f64::from(single), variant);
                    let here = read(&approach, method, &tables, &setting);
                    for next in beside {
                        let moved = approach.setting(f64::from(next), variant);
                        let there = read(&approach, method, &tables, &moved);
                        let unit = match approach.measure {
                            Measure::Absolute => 1.0,
                            Measure::Relative => here.exact.max(there.exact),
                            Measure::OfLight => {
                                method.exact(&tables, &setting)[0].max(method.exact(&tables, &moved)[0])
                            }
                        };
                        let allowed = (there.exact - here.exact).abs()
                            + 2.0 * unit * approach.bound(method, &setting, parameter);
                        assert!(
                            (there.value - here.value).abs() <= allowed,
                            "{}, {method:?}: {here:?} and {there:?} may be {allowed:e} apart, at {single:e} and {next:e}, variant {variant}: {setting:?}",
                            approach.name
                        );
                    }
                }
            }
        }
    }
}

/// What a method does along an approach: the worst error as a share of the bound of the exact levels, and the share of values
/// that are not finite.
fn worst(name: &str, method: Method) -> (f64, f64) {
    let approach = approach(name);
    let all = curves(&approach, &Tables::default());
    let of = |wanted: Method| all.iter().find(|curve| curve.method == wanted).expect("the method is drawn");
    let bounds = of(Method::Level(Quality::Standard)).steps.iter().map(|step| step.bound);
    let steps = &of(method).steps;
    let share = steps.iter().zip(bounds).map(|(step, bound)| step.error / bound).fold(0.0, f64::max);
    let lost: usize = steps.iter().map(|step| step.not_finite).sum();
    (share, lost as f64 / steps.iter().map(|step| step.count).sum::<usize>() as f64)
}

/// Where the literature says that a published form breaks, it breaks by a factor of the bound, or a share of its values is not
/// finite: what the other tests assert of this library can fail.
#[test]
fn published_forms_break_where_they_are_known_to() {
    let broken = [
        ("gap", PRINTED, 1e5, 0.02),
        ("gap", FITTED, 1e5, 0.0),
        ("edge-line", PRINTED, 10.0, 0.05),
        ("distance", PRINTED, 1e6, 0.05),
        ("distance", FITTED, 1e6, 0.0),
        ("rising", PRINTED, 10.0, 0.05),
        ("edge-on", PRINTED, 10.0, 0.01),
        ("view-normal", FITTED, 1e3, 0.0),
        ("thin", PRINTED, 10.0, 0.05),
        ("scale", FITTED, 1e3, 0.0),
        ("disk-axis", Method::Disk, 0.0, 0.1),
        ("disk-large", Method::Disk, 0.0, 0.05),
        ("disk-small", Method::Disk, 1e3, 0.1),
        ("sphere-contact", Method::Disk, 0.0, 0.1),
        ("tube-short", Method::Line, 1e4, 0.01),
        ("tube-end-on", Method::Line, 1e3, 0.0),
    ];
    for (name, method, factor, lost) in broken {
        let (error, not_finite) = worst(name, method);
        println!("{name}, {}: {error:.1e} of the bound, {not_finite:.3} not finite", method.label());
        assert!(error >= factor, "{name}, {method:?}: {error:e} of the bound, not {factor:e}");
        assert!(not_finite >= lost, "{name}, {method:?}: {not_finite} not finite, not {lost}");
    }
}

/// Where nothing is hard, all forms agree with exact arithmetic: what breaks is not the comparison.
#[test]
fn published_forms_hold_where_nothing_is_hard() {
    for approach in approaches() {
        for curve in curves(&approach, &Tables::default()).iter().filter(|curve| !curve.method.is_ours()) {
            let [low, high] = approach.range;
            // On a logarithmic axis of units of length, the easy place is in the middle.
            let easy = match approach.name {
                "scale" => 1.0,
                _ if approach.rises => low,
                _ => high.min(0.3),
            };
            let step = curve
                .steps
                .iter()
                .min_by(|a, b| (a.parameter / easy).ln().abs().total_cmp(&(b.parameter / easy).ln().abs()))
                .expect("a curve has steps");
            assert!(step.error < 2e-4, "{}, {:?}: {step:?}", approach.name, curve.method);
            assert!(step.not_finite < step.count, "{}, {:?}: {step:?}", approach.name, curve.method);
        }
    }
}

/// F of a rectangle that stands on the surface with a lower corner at the foot of the perpendicular (Hamilton and Morgan 1952).
fn perpendicular(width: f64, height: f64, gap: f64) -> f64 {
    let hypotenuse = height.hypot(gap);
    ((width / gap).atan() - gap / hypotenuse * (width / hypotenuse).atan()) / TAU
}

#[test]
fn exact_arithmetic_is_the_closed_form() {
    let (tables, approach) = (Tables::default(), approach("gap"));
    for parameter in parameters(&approach) {
        for variant in 0..VARIANTS {
            let setting = approach.setting(parameter, variant);
            let Light::Polygon { points, .. } = &setting.light else { panic!("{setting:?} has no polygon") };
            let (left, right, gap, height) = (points[0].x, points[1].x, points[0].y, points[2].z);
            let closed = perpendicular(right, height, gap) + perpendicular(-left, height, gap);
            for method in [FITTED, Method::Level(Quality::Standard)] {
                let [diffuse, ..] = method.exact(&tables, &setting);
                assert!((diffuse - closed).abs() < 1e-13, "{method:?}: {diffuse} and {closed}: {setting:?}");
            }
        }
    }
}

fn all_curves() -> Vec<Curve> {
    let tables = Tables::default();
    approaches().iter().flat_map(|approach| curves(approach, &tables)).collect()
}

#[test]
fn charts_and_table_show_every_approach() {
    let curves = all_curves();
    let documents = charts(&curves);
    assert_eq!(documents.len(), approaches().len() + 1);
    assert_eq!(documents[0].0, OVERVIEW_NAME);
    for (name, text) in &documents {
        let document = roxmltree::Document::parse(text).unwrap_or_else(|error| panic!("{name}: {error}"));
        let width: f64 = document.root_element().attribute("width").unwrap().parse().unwrap();
        assert!(width <= 900.0, "{name} is {width} wide");
        for node in document.descendants().filter_map(|node| node.attribute("d")) {
            assert!(!node.contains("NaN") && !node.contains("inf"), "{name}: {node}");
        }
    }
    let text = table(&curves);
    let rows: usize = curves.iter().map(|curve| curve.steps.len()).sum();
    assert_eq!(text.lines().count(), rows + 1);
    for approach in approaches() {
        assert!(text.contains(approach.name), "{} has no row", approach.name);
    }
}

fn device() -> Device {
    Device::open_any().expect("a device; tests/tools/install installs Mesa's lavapipe")
}

fn scene(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
    Scene::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn the_contact_scene_shows_the_difference() {
    let [printed, fitted, ours] =
        scene_by_both(&device(), &scene("contact.toml"), [160, 120]).expect("it draws");
    let [printed, fitted, ours] = [printed, fitted, ours].map(|shaded| shaded.spread());
    println!("{printed:?}\n{fitted:?}\n{ours:?}");
    assert!(printed.visible > 0.3, "{printed:?}");
    assert!(fitted.visible > 0.1, "{fitted:?}");
    assert!(ours.visible < 1e-3 && ours.not_finite == 0 && ours.mean < 1e-4, "{ours:?}");
}

#[test]
fn the_hard_scene_loses_pixels_by_the_printed_form_only() {
    let [printed, fitted, ours] = scene_by_both(&device(), &scene("hard.toml"), [160, 90]).expect("it draws");
    let [printed, fitted, ours] = [printed, fitted, ours].map(|shaded| shaded.spread());
    println!("{printed:?}\n{fitted:?}\n{ours:?}");
    assert!(printed.not_finite > 1000, "{printed:?}");
    // The text on the device is that of the mathematics on the CPU.
    assert!(fitted.mean < 1e-3 && fitted.visible < 0.01, "{fitted:?}");
    assert!(ours.mean < 1e-5 && ours.visible < 1e-3 && ours.not_finite == 0, "{ours:?}");
}

#[test]
fn scenes_beyond_the_published_technique_are_refused() {
    let error = scene_by_both(&device(), &scene("lights.toml"), [16, 9]).expect_err("it has disks and coats");
    assert!(matches!(error, BothError::Unpublished { .. }), "{error}");
    assert!(error.to_string().starts_with("light "), "{error}");
}

/// The largest share of its bound that the standard level takes along an approach.
fn share_of_bound(name: &str) -> f64 {
    worst(name, Method::Level(Quality::Standard)).0
}

#[test]
fn a_quad_whose_vertex_touches_the_point_keeps_its_digits() {
    let share = share_of_bound("vertex");
    assert!(share <= 1.0, "{share:e} of the bound");
}

#[test]
fn a_far_quad_on_the_lobes_horizon_keeps_its_digits() {
    let share = share_of_bound("lobe-horizon");
    assert!(share <= 1.0, "{share:e} of the bound");
}
