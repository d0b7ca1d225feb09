//! The models themselves: reciprocity, sampling, energy.

use glam::{DVec2, DVec3};
use softbox::brdf::{Brdf, Charlie, Eon, Scattering, Visibility};

use crate::common::Random;
use crate::{albedo, hemisphere, view};
use core::f64::consts::TAU;

fn models() -> Vec<(String, Box<dyn Brdf>)> {
    let mut models: Vec<(String, Box<dyn Brdf>)> = Vec::new();
    for roughness in [0.25, 0.5, 1.0] {
        for visibility in [Visibility::Smith, Visibility::Neubelt] {
            let model = Charlie { visibility, ..Charlie::of_roughness(roughness) };
            models.push((format!("{model:?}"), Box::new(model)));
        }
        for scattering in [Scattering::Single, Scattering::Multiple, Scattering::All] {
            let model = Eon { roughness, colour: 0.8, scattering };
            models.push((format!("{model:?}"), Box::new(model)));
        }
    }
    models
}

#[test]
fn models_are_reciprocal() {
    for (name, model) in models() {
        let mut random = Random::new(11);
        for _ in 0..2000 {
            let mut upper = || {
                let direction = random.direction();
                DVec3::new(direction.x, direction.y, direction.z.abs())
            };
            let (a, b) = (upper(), upper());
            let (there, back) = (model.evaluate(a, b), model.evaluate(b, a));
            assert!((there - back).abs() <= 1e-12 * there, "{name}: {there} and {back} for {a}, {b}");
        }
    }
}

#[test]
fn densities_integrate_to_one_and_samples_find_the_albedo() {
    for (name, model) in models() {
        for cosine in [0.02, 0.3, 0.8, 1.0] {
            let view = view(cosine);
            let whole = hemisphere(|light| model.pdf(view, light));
            assert!((whole - 1.0).abs() < 1e-3, "{name}, cosine {cosine}: the density adds up to {whole}");
            let mut random = Random::new(5);
            let (mut sum, mut squares) = (0.0, 0.0);
            let count = 200_000;
            for _ in 0..count {
                let light = model.sample(view, DVec2::new(random.unit(), random.unit()));
                assert!((light.length() - 1.0).abs() < 1e-9, "{name}: {light} is no direction");
                let weight = model.evaluate(view, light) * light.z / model.pdf(view, light).max(1e-300);
                sum += weight;
                squares += weight * weight;
            }
            let mean = sum / f64::from(count);
            let variance = (squares / f64::from(count) - mean * mean).max(0.0);
            let deviation = (variance / f64::from(count)).sqrt();
            let exact = albedo(model.as_ref(), cosine);
            assert!(
                (mean - exact).abs() < 5.0 * deviation + 1e-3 * exact,
                "{name}, cosine {cosine}: {mean} ± {deviation} by samples, {exact} by quadrature"
            );
        }
    }
}

#[test]
fn the_rough_diffuse_model_keeps_its_closed_forms_and_all_energy() {
    for roughness in [0.0, 0.1, 0.5, 1.0] {
        let (single, all) = (Eon::single(roughness), Eon::new(roughness));
        for cosine in [0.01, 0.1, 0.4, 0.9, 1.0] {
            let (measured, stated) = (albedo(&single, cosine), single.single_albedo(cosine));
            assert!((measured - stated).abs() < 2e-4, "r {roughness}, cosine {cosine}: {measured}, {stated}");
            let whole = albedo(&all, cosine);
            assert!((whole - 1.0).abs() < 2e-4, "r {roughness}, cosine {cosine}: {whole} is not 1");
        }
        let mean = 2.0 * hemisphere(|light| single.single_albedo(light.z) * light.z) / TAU;
        assert!((mean - single.mean_albedo()).abs() < 1e-5, "{mean} and {}", single.mean_albedo());
    }
}

/// Where the published shadowing reflects more than it receives, which the fit cuts to 1.
#[test]
fn sheen_keeps_its_energy_but_for_smooth_cloth_at_grazing_views() {
    for roughness in [0.3, 0.5, 0.7, 1.0] {
        for cosine in [0.001, 0.01, 0.1, 0.5, 1.0] {
            let whole = albedo(&Charlie::of_roughness(roughness), cosine);
            assert!((0.0..=1.0).contains(&whole), "roughness {roughness}, cosine {cosine}: {whole}");
        }
    }
    let beyond = albedo(&Charlie::of_roughness(0.1), 0.01);
    assert!(beyond > 1.5, "the known excess is gone: {beyond}");
}

/// Smith's Λ for a distribution is the integral of its projection towards the view over the cosine,
/// less 1. The model's own follows from its value where view and light are one.
#[test]
fn the_published_shadowing_is_that_of_the_distribution() {
    for alpha in [0.15, 0.3, 0.6, 1.0] {
        let model = Charlie::new(alpha);
        let distribution =
            |h: DVec3| (2.0 + 1.0 / alpha) * (1.0 - h.z * h.z).powf(0.5 / alpha) / core::f64::consts::TAU;
        let whole = hemisphere(|h| distribution(h) * h.z);
        assert!((whole - 1.0).abs() < 1e-3, "α {alpha}: the facets cover {whole} of the surface");
        for cosine in [0.05, 0.2, 0.4, 0.6, 0.8, 0.95] {
            let view = view(cosine);
            let exact = hemisphere(|h| distribution(h) * view.dot(h).max(0.0)) / cosine - 1.0;
            let masking = distribution(view) / (4.0 * cosine * cosine * model.evaluate(view, view));
            let fitted = 0.5 * (masking - 1.0);
            // As shares of light that is let through, which is what the fit is for.
            let (exact_share, fitted_share) = (1.0 / (1.0 + exact), 1.0 / (1.0 + fitted));
            println!("α {alpha}, cosine {cosine}: {exact_share:.4} exactly, {fitted_share:.4} by the fit");
            assert!(
                (exact_share - fitted_share).abs() < 0.05,
                "α {alpha}, cosine {cosine}: {exact_share} exactly, {fitted_share} by the fit"
            );
        }
    }
}
