//! Inputs that every form of the include has to survive, with the bound that holds for each.
#![allow(dead_code, reason = "each test file uses a part of this module")]

pub mod families;
pub mod tools;

use glam::{DVec3, Vec3};
use softbox::device::{Batch, EvaluateLight, EvaluateSurface};
use softbox::effects::Effects;
use softbox::light::{Light, light_value, polygon_value};
use softbox::shade::{LobeSum, Real, Vector, ltc_fast_polygon, ltc_fast_quad, ltc_surface};
use softbox::table::Table;

use families::TOUCHING;

/// Numbers that look random and are the same on every run (Steele et al. 2014, SplitMix64).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in 0…1.
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform in the logarithm.
    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    pub fn index(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    pub fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let azimuth = self.between(0.0, core::f64::consts::TAU);
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * azimuth.cos(), radius * azimuth.sin(), z)
    }

    /// Any finite f32, all bit patterns alike.
    pub fn finite(&mut self) -> f32 {
        loop {
            let value = f32::from_bits(self.next() as u32);
            if value.is_finite() {
                return value;
            }
        }
    }
}

/// What must hold for a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// The form factor is within this of exact arithmetic.
    Absolute(f64),
    /// The form factor is within this share of its value of exact arithmetic.
    Relative(f64),
    /// All three numbers are exactly zero.
    Zero,
    /// Finite, and within what physics allows.
    Physical,
}

/// A surface, a light and what must hold. Coordinates are f32, so every form sees the same input.
#[derive(Clone, Debug)]
pub struct Case {
    pub family: &'static str,
    pub position: Vec3,
    pub normal: Vec3,
    pub view: Vec3,
    pub roughness: f32,
    pub vertices: Vec<Vec3>,
    /// Of a tube, whether it has caps.
    pub two_sided: bool,
    /// Hand it to the quad functions.
    pub quad: bool,
    /// What the vertices are, see [`EvaluateLight`].
    pub kind: u32,
    /// Radius of a sphere or tube.
    pub radius: f32,
    pub bound: Bound,
    /// The form factor where a closed form knows it better than exact arithmetic on rounded input.
    pub form_factor: Option<f64>,
    /// What the light's closeness adds to the error that specular light may have.
    pub specular_slack: f64,
}

impl Case {
    /// The light.
    pub fn light(&self) -> Light {
        let v = |i: usize| self.vertices[i].as_dvec3();
        let radius = f64::from(self.radius);
        match self.kind {
            EvaluateLight::DISK => {
                Light::Disk { center: v(0), half_x: v(1), half_y: v(2), two_sided: self.two_sided }
            }
            EvaluateLight::SPHERE => Light::Sphere { center: v(0), radius },
            EvaluateLight::TUBE => Light::Tube { start: v(0), end: v(1), radius, caps: self.two_sided },
            _ => Light::Polygon {
                points: self.vertices.iter().map(|v| v.as_dvec3()).collect(),
                two_sided: self.two_sided,
            },
        }
    }
}

/// F of a rectangle that stands on the surface with a lower corner at the foot of the
/// perpendicular: width along the surface, height over it, gap between point and rectangle
/// (Hamilton and Morgan 1952; Howell's catalogue, B-4).
pub fn perpendicular(width: f64, height: f64, gap: f64) -> f64 {
    let hypotenuse = (height * height + gap * gap).sqrt();
    ((width / gap).atan() - gap / hypotenuse * (width / hypotenuse).atan()) / core::f64::consts::TAU
}

/// The value of a case by the twin.
pub fn twin<R: Real>(table: &Table, case: &Case) -> [f64; 3] {
    twin_with::<R>(table, Effects::NONE, case)
}

/// The same with some effects.
pub fn twin_with<R: Real>(table: &Table, effects: Effects, case: &Case) -> [f64; 3] {
    let v = |v: Vec3| R::Vec3::new(R::new(v.x.into()), R::new(v.y.into()), R::new(v.z.into()));
    let roughness = R::new(case.roughness.into());
    let surface = ltc_surface::<R>(v(case.position), v(case.normal), v(case.view), roughness);
    let lobes = table.specular(&surface, effects);
    let value = match case.light() {
        Light::Polygon { two_sided, .. } => {
            let points: Vec<R::Vec3> = case.vertices.iter().map(|vertex| v(*vertex)).collect();
            match points[..] {
                [a, b, c, d] if case.quad && effects.is_fast() => {
                    ltc_fast_quad(&surface, &lobes, [a, b, c, d], two_sided)
                }
                _ if effects.is_fast() => ltc_fast_polygon(&surface, &lobes, &points, two_sided),
                _ => polygon_value(&surface, &lobes, &points, case.quad, two_sided),
            }
        }
        light => light_value(&surface, &lobes, &light),
    };
    [value.x(), value.y(), value.z()].map(Real::to_f64)
}

/// The albedo of the lobes that a case is shaded with.
pub fn albedo(table: &Table, effects: Effects, case: &Case) -> f64 {
    let v = |v: Vec3| v.as_dvec3();
    let surface = ltc_surface::<f64>(v(case.position), v(case.normal), v(case.view), case.roughness.into());
    table.specular(&surface, effects).lobes().iter().map(|lobe| lobe.albedo).sum()
}

/// The cases as buffers of the evaluation kernel, one surface and one light each.
pub fn batch(cases: &[Case]) -> Batch {
    let mut batch = Batch::default();
    for (index, case) in cases.iter().enumerate() {
        batch.surfaces.push(EvaluateSurface {
            position: case.position.into(),
            roughness: case.roughness,
            normal: case.normal.into(),
            view: case.view.into(),
            ..EvaluateSurface::default()
        });
        let light = batch.add_light(&case.light());
        if case.kind == EvaluateLight::POLYGON {
            let flags = &mut batch.lights[light as usize].flags;
            *flags &= !EvaluateLight::CONVEX_QUAD;
            *flags |= u32::from(case.quad) * EvaluateLight::CONVEX_QUAD;
        }
        batch.pairs.push([index as u32, light]);
    }
    batch
}

/// How far specular light may be from exact arithmetic: rounding moves a light by so much in the space of
/// a lobe that is α wide, and 1 / cos θ times as sensitive seen at a grazing angle.
fn specular_bound(case: &Case) -> f64 {
    let bounded = matches!(case.bound, Bound::Absolute(_) | Bound::Relative(_)) && case.family != TOUCHING;
    if !bounded {
        return f64::INFINITY;
    }
    let alpha = f64::from(case.roughness.clamp(0.02, 1.0)).powi(2);
    let cosine = case.view.as_dvec3().normalize().dot(case.normal.as_dvec3().normalize());
    // A distant light is small, and so is its error.
    // An outline takes its points on the horizon one by one and measures all of them from the first.
    let base = match case.bound {
        Bound::Relative(_) => 4e-8,
        _ if case.kind == EvaluateLight::POLYGON && !case.quad => 8e-6,
        _ => 4e-6,
    };
    base / (alpha * cosine.max(1e-9)) + case.specular_slack
}

/// The worst of a family: the largest error with its index, and the largest shares of the bounds.
#[derive(Default)]
struct Worst {
    count: usize,
    error: f64,
    index: usize,
    share: f64,
    specular_share: f64,
}

/// Checks values against the bounds and exact arithmetic (the twin in f64, or a closed form).
/// Returns the worst form-factor error of each family; panics with the first offenders.
pub fn check(what: &str, cases: &[Case], exact: &[[f64; 3]], values: &[[f32; 3]], table: &Table) {
    check_with(what, cases, exact, values, (table, Effects::NONE));
}

/// The same with some effects.
pub fn check_with(
    what: &str,
    cases: &[Case],
    exact: &[[f64; 3]],
    values: &[[f32; 3]],
    (table, effects): (&Table, Effects),
) {
    assert_eq!(cases.len(), values.len(), "{what}: one value for each case");
    let mut worst: std::collections::BTreeMap<&str, Worst> = std::collections::BTreeMap::new();
    let mut offenders = Vec::new();
    for (i, ((case, exact), value)) in cases.iter().zip(exact).zip(values).enumerate() {
        let [diffuse, specular, fresnel] = value.map(f64::from);
        let reference = case.form_factor.unwrap_or(exact[0]);
        let difference = (diffuse - reference).abs();
        let error = match case.bound {
            Bound::Absolute(_) => difference,
            Bound::Relative(_) => difference / reference,
            Bound::Zero => diffuse.max(specular).max(fresnel),
            Bound::Physical => 0.0,
        };
        let limit = match case.bound {
            Bound::Absolute(bound) | Bound::Relative(bound) => bound,
            Bound::Zero | Bound::Physical => 0.0,
        };
        // One rounding of the table's own interpolation may separate device and twin.
        let albedo = albedo(table, effects, case) * (1.0 + 1e-6);
        let physical = (0.0..=1.0).contains(&diffuse)
            && (0.0..=albedo).contains(&specular)
            && (0.0..=specular * (1.0 + 1e-6)).contains(&fresnel);
        let within = error <= limit
            && (specular - exact[1]).abs() <= specular_bound(case)
            // Schlick's part follows the light's direction as well.
            && (fresnel - exact[2]).abs() <= 2.0 * specular_bound(case);
        if !physical || !within {
            offenders.push((i, error));
        }
        let entry = worst.entry(case.family).or_default();
        entry.count += 1;
        if error > entry.error || error.is_nan() {
            (entry.error, entry.index) = (error, i);
        }
        if limit > 0.0 {
            entry.share = entry.share.max(error / limit);
        }
        let slack = specular_bound(case);
        if slack.is_finite() {
            entry.specular_share = entry.specular_share.max((specular - exact[1]).abs() / slack);
        }
    }
    for (family, worst) in &worst {
        println!(
            "{what}: {family}: of {} the worst is {:.2e} at {}; at most {:.2} of the bound, specular {:.2}",
            worst.count, worst.error, worst.index, worst.share, worst.specular_share
        );
    }
    if !offenders.is_empty() {
        let shown: Vec<String> = offenders
            .iter()
            .enumerate()
            .filter(|(k, (i, _))| *k < 3 || cases[*i].family != cases[offenders[k - 3].0].family)
            .take(20)
            .map(|(_, (i, error))| {
                format!(
                    "value {:?}, exact {:?}, error {error:e}, input {i}: {:?}",
                    values[*i], exact[*i], cases[*i]
                )
            })
            .collect();
        panic!(
            "{what}: {} of {} cases beyond their bounds:\n{}",
            offenders.len(),
            cases.len(),
            shown.join("\n")
        );
    }
}
