//! The anisotropic reflectance model against itself and against the isotropic one.

mod common;

use core::f64::consts::{PI, TAU};

use common::Random;
use glam::{DVec2, DVec3};
use softbox::brdf::AnisotropicGgx;
use softbox::brdf::{Brdf, Ggx};

fn direction(cosine: f64, azimuth: f64) -> DVec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    DVec3::new(sine * azimuth.cos(), sine * azimuth.sin(), cosine)
}

fn upper(random: &mut Random) -> DVec3 {
    direction(random.between(0.02, 1.0), random.between(0.0, TAU))
}

fn model(random: &mut Random, smallest: f64) -> AnisotropicGgx {
    AnisotropicGgx {
        alpha_x: random.log(smallest, 1.0),
        alpha_y: random.log(smallest, 1.0),
        azimuth: random.between(0.0, TAU),
    }
}

/// Midpoints of a grid of `count`² cells.
fn grid(count: usize) -> impl Iterator<Item = DVec2> {
    let place = move |i: usize| (i as f64 + 0.5) / count as f64;
    (0..count * count).map(move |i| DVec2::new(place(i % count), place(i / count)))
}

#[test]
fn the_model_is_reciprocal() {
    let mut random = Random::new(1);
    for _ in 0..20_000 {
        let (brdf, view, light) = (model(&mut random, 0.01), upper(&mut random), upper(&mut random));
        let (there, back) = (brdf.evaluate(view, light), brdf.evaluate(light, view));
        assert!((there - back).abs() <= 1e-12 * there, "{there} and {back}: {brdf:?} {view} {light}");
    }
}

#[test]
fn equal_roughnesses_are_the_isotropic_model() {
    let mut random = Random::new(2);
    for _ in 0..20_000 {
        let AnisotropicGgx { alpha_x: alpha, azimuth, .. } = model(&mut random, 0.01);
        let (view, light) = (upper(&mut random), upper(&mut random));
        let brdf = AnisotropicGgx { alpha_x: alpha, alpha_y: alpha, azimuth };
        for (value, expected) in [
            (brdf.evaluate(view, light), Ggx::new(alpha).evaluate(view, light)),
            (brdf.pdf(view, light), Ggx::new(alpha).pdf(view, light)),
        ] {
            assert!(
                (value - expected).abs() <= 1e-10 * expected,
                "{value}, not {expected}: {brdf:?} {view} {light}"
            );
        }
    }
}

/// The density integrates to one over the sphere, and to the share of samples over a part of it; the
/// albedo by own samples is that by uniform ones.
#[test]
fn samples_have_their_density() {
    let mut random = Random::new(3);
    for _ in 0..24 {
        let brdf = model(&mut random, 0.08);
        let view = direction(random.between(0.15, 1.0), random.between(0.0, TAU));
        let cap = upper(&mut random);
        let (mut whole, mut part, mut albedo) = (0.0, 0.0, 0.0);
        let count = 1200;
        for place in grid(count) {
            let light = direction(2.0 * place.x - 1.0, TAU * place.y);
            let weight = 4.0 * PI / (count * count) as f64;
            let density = weight * brdf.pdf(view, light);
            whole += density;
            part += if light.dot(cap) > 0.5 { density } else { 0.0 };
            albedo += weight * brdf.evaluate(view, light) * light.z.max(0.0);
        }
        let (mut inside, mut own) = (0.0, 0.0);
        let count = 700;
        for place in grid(count) {
            let light = brdf.sample(view, place);
            let weight = 1.0 / (count * count) as f64;
            inside += if light.dot(cap) > 0.5 { weight } else { 0.0 };
            own += weight * brdf.evaluate(view, light) * light.z.max(0.0) / brdf.pdf(view, light);
        }
        let what = format!("{brdf:?} {view}");
        assert!((whole - 1.0).abs() < 2e-3, "the density integrates to {whole}: {what}");
        assert!((part - inside).abs() < 3e-3, "{part} of the density, {inside} of the samples: {what}");
        assert!((albedo - own).abs() < 2e-3, "albedo {albedo} and {own}: {what}");
    }
}
