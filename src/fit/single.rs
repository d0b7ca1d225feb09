//! The fit of one lobe to one view of a BRDF.

use core::f64::consts::PI;
use glam::{DVec2, DVec3};

use crate::brdf::{Brdf, schlick};
use crate::lobe::Lobe;

/// What a lobe is fitted for: how the shader will treat the part that lies below the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Horizon {
    /// Light is cut at the surface's horizon and the rest of the lobe carries the whole energy.
    /// This is what the include does.
    Cut,
    /// Light is cut at the lobe's horizon alone, as in the published technique, so the part of the
    /// lobe below the surface is lost or leaks.
    Uncut,
}

/// Least share of the loss's curvature that a step counts on.
const LEAST_BEND: f64 = 0.1;

/// How the distance of a lobe l from a BRDF f is measured at one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Loss {
    /// (f − l)² / (f + l)^¾. Its derivative is taken with the divisor held fixed, which is right where
    /// lobe and BRDF are alike. Of the exponents ½, ¾ and 1 the middle one gave the least mean error of
    /// light integrals on random quads for GGX.
    Squares,
    /// The convex function that is zero at l = f and has the derivative (l − f) / (f + l)^p in l, for the
    /// exponent p = n / 4 with the given n in 0…7. The larger p, the more do faint directions count: 0 is
    /// the square, 1 comes close to |f − l|. Unlike the squares it has the same least value wherever a fit
    /// starts, however far the best lobe stays from the BRDF.
    Divergence(i32),
}

impl Loss {
    /// The loss, the weight w for which its derivative in l is 2·w·(l − f), and half its curvature.
    fn at(self, value: f64, target: f64, tiny: f64) -> (f64, f64, f64) {
        let residual = value - target;
        let sum = value + target + tiny;
        match self {
            Self::Squares => {
                let root = sum.sqrt();
                let weight = 1.0 / (root * root.sqrt());
                (weight * residual * residual, weight, weight)
            }
            Self::Divergence(quarters) => {
                let exponent = 0.25 * f64::from(quarters);
                // Roots alone are the same on every machine.
                let power = |s: f64| s.sqrt().sqrt().powi(-quarters);
                // With s = l + f the derivative is s^(1 − p) − 2·f·s^(−p).
                let double = 2.0 * target + tiny;
                let primitive = |s: f64, power: f64| {
                    let grown = if quarters == 4 { s.ln() } else { s * power / (1.0 - exponent) };
                    s * s * power / (2.0 - exponent) - double * grown
                };
                let weight = power(sum);
                let loss = primitive(sum, weight) - primitive(double, power(double));
                // Beyond p = 1 the function is concave far above f.
                let bend = (1.0 - exponent * residual / sum).max(LEAST_BEND);
                (2.0 * loss.max(0.0), weight, weight * bend)
            }
        }
    }
}

/// One quadrature node of the upper hemisphere; `y` enters only through its square because the
/// lobe and the BRDF are symmetric about the plane of incidence.
#[derive(Clone, Copy)]
struct Node {
    x: f64,
    y2: f64,
    z: f64,
    value: f64,
    /// `value` times (1 − v·h)⁵.
    schlick: f64,
    weight: f64,
}

/// A view of a BRDF prepared for fitting: its two integrals and its values at quadrature nodes.
pub(crate) struct Target {
    nodes: Vec<Node>,
    /// ∫ f·cos over the hemisphere.
    pub albedo: f64,
    /// ∫ f·cos·(1 − v·h)⁵ over the hemisphere.
    pub fresnel: f64,
}

impl Target {
    /// Places `count`² / 2 nodes by the BRDF's own sampling over half the hemisphere, and a
    /// quarter of that by the cosine, and weighs them by the balance heuristic (Veach 1997). The albedo is
    /// that of `albedo_count`² / 2 nodes of the BRDF's own sampling, unless they are none.
    pub fn new(brdf: &dyn Brdf, cosine: f64, count: usize, albedo_count: usize) -> Self {
        let view = DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine);
        let (radial, angular) = (count, count / 2);
        let own = (radial * angular) as f64;
        let (radial_cosine, angular_cosine) = (count / 2, count / 4);
        let diffuse = (radial_cosine * angular_cosine) as f64;
        let mut target = Self { nodes: Vec::with_capacity(2 * count * count), albedo: 0.0, fresnel: 0.0 };
        let mut add = |light: DVec3| {
            if light.z <= 0.0 {
                return;
            }
            let density = own * brdf.pdf(view, light) + diffuse * light.z / PI;
            if density <= 0.0 {
                return;
            }
            let weight = 1.0 / density;
            let value = brdf.evaluate(view, light) * light.z;
            target.albedo += weight * value;
            let schlick = value * schlick(view, light);
            target.fresnel += weight * schlick;
            target.nodes.push(Node { x: light.x, y2: light.y * light.y, z: light.z, value, schlick, weight });
        };
        for i in 0..radial {
            for j in 0..angular {
                add(brdf.sample(
                    view,
                    DVec2::new((i as f64 + 0.5) / radial as f64, (j as f64 + 0.5) / (2 * angular) as f64),
                ));
            }
        }
        for i in 0..radial_cosine {
            for j in 0..angular_cosine {
                add(crate::brdf::Lambert.sample(
                    view,
                    DVec2::new(
                        (i as f64 + 0.5) / radial_cosine as f64,
                        (j as f64 + 0.5) / (2 * angular_cosine) as f64,
                    ),
                ));
            }
        }
        if albedo_count > 0 {
            target.albedo = own_albedo(brdf, view, albedo_count);
        }
        target
    }
}

/// ∫ f·cos over the hemisphere by `count`² / 2 nodes of the BRDF's own sampling.
fn own_albedo(brdf: &dyn Brdf, view: DVec3, count: usize) -> f64 {
    let (radial, angular) = (count, count / 2);
    let mut sum = 0.0;
    for i in 0..radial {
        for j in 0..angular {
            let place = |index: usize, count: usize| (index as f64 + 0.5) / count as f64;
            let light = brdf.sample(view, DVec2::new(place(i, radial), place(j, 2 * angular)));
            let density = brdf.pdf(view, light);
            if light.z > 0.0 && density > 0.0 {
                sum += brdf.evaluate(view, light) * light.z / density;
            }
        }
    }
    sum / (radial * angular) as f64
}

/// What a fit strives for; see the fields of [`Settings`](super::Settings).
#[derive(Clone, Copy)]
pub(crate) struct Goal {
    pub horizon: Horizon,
    pub loss: Loss,
    pub schlick_weight: f64,
}

/// Sum of the losses, its gradient half and the Gauss–Newton matrix in (x, y, z, w).
#[derive(Clone, Copy, Default)]
pub(crate) struct Normal {
    pub loss: f64,
    pub gradient: [f64; 4],
    pub hessian: [[f64; 4]; 4],
}

impl Target {
    /// The weighted least-squares problem around `lobe`.
    ///
    /// The Schlick part s of f, for which the lobe stands with its own magnitude, joins with
    /// `schlick_weight` times (s − l)² / (s + l)^½. Both residuals count relative to their
    /// magnitudes, and the second also by the root of the part's share: where it is small, the
    /// lobe's shape is not worth spending on it.
    pub fn normal(&self, lobe: &Lobe, goal: Goal) -> Normal {
        let Goal { horizon, loss, schlick_weight } = goal;
        let det = lobe.determinant();
        let radius2 = lobe.x * lobe.x + lobe.y * lobe.y;
        let radius = radius2.sqrt();
        let (share, share_x, share_y) = match horizon {
            Horizon::Cut => (
                0.5 + 0.5 * lobe.x / radius,
                0.5 * lobe.y * lobe.y / (radius2 * radius),
                -0.5 * lobe.x * lobe.y / (radius2 * radius),
            ),
            Horizon::Uncut => (1.0, 0.0, 0.0),
        };
        let scale = self.albedo * det / (PI * share);
        let constant =
            [lobe.w / det - share_x / share, -lobe.z / det - share_y / share, -lobe.y / det, lobe.x / det];
        let ratio = self.fresnel / self.albedo;
        // Brings the two losses to one scale: that of the albedo to the power 2 − ¾.
        let schlick_weight = schlick_weight * ratio.sqrt() * self.albedo.powf(1.25)
            / self.fresnel.max(f64::MIN_POSITIVE).powf(1.5);
        let mut normal = Normal::default();
        for node in &self.nodes {
            let qx = lobe.x * node.x + lobe.z * node.z;
            let qz = lobe.y * node.x + lobe.w * node.z;
            let n = 1.0 / (qx * qx + node.y2 + qz * qz);
            let value = if qz > 0.0 { scale * qz * n * n } else { 0.0 };
            let residual = value - node.value;
            let (loss, weight, curvature) = loss.at(value, node.value, 1e-9 * self.albedo);
            let weight = node.weight * weight;
            normal.loss += node.weight * loss;
            let (mut pull, mut curvature) = (weight * residual, node.weight * curvature);
            if schlick_weight > 0.0 {
                let part = ratio * value;
                let residual = part - node.schlick;
                let weight =
                    schlick_weight * node.weight / (part + node.schlick + 1e-9 * self.fresnel).sqrt();
                normal.loss += weight * residual * residual;
                pull += ratio * weight * residual;
                curvature += ratio * ratio * weight;
            }
            if value <= 0.0 {
                continue;
            }
            let from_x = -4.0 * qx * n;
            let from_z = -4.0 * qz * n + 1.0 / qz;
            let derivative = [
                value * (constant[0] + from_x * node.x),
                value * (constant[1] + from_z * node.x),
                value * (constant[2] + from_x * node.z),
                value * (constant[3] + from_z * node.z),
            ];
            for i in 0..4 {
                let weighted = curvature * derivative[i];
                normal.gradient[i] += pull * derivative[i];
                for j in 0..=i {
                    normal.hessian[i][j] += weighted * derivative[j];
                }
            }
        }
        for i in 0..4 {
            for j in 0..i {
                normal.hessian[j][i] = normal.hessian[i][j];
            }
        }
        normal
    }

    /// Fits the `free` entries of a lobe by Levenberg–Marquardt, starting at `start`.
    pub fn fit(&self, start: Lobe, free: [bool; 4], goal: Goal, iterations: usize) -> Lobe {
        let mut lobe = start;
        let mut normal = self.normal(&lobe, goal);
        let mut damping = 1e-3;
        for _ in 0..iterations {
            let mut system = normal.hessian;
            for (i, row) in system.iter_mut().enumerate() {
                row[i] *= 1.0 + damping;
                row[i] += 1e-300;
            }
            let mut gradient = normal.gradient;
            for i in (0..4).filter(|&i| !free[i]) {
                gradient[i] = 0.0;
                for j in 0..4 {
                    (system[i][j], system[j][i]) = (0.0, 0.0);
                }
                system[i][i] = 1.0;
            }
            let step = solve(system, gradient);
            let next =
                Lobe { x: lobe.x - step[0], y: lobe.y - step[1], z: lobe.z - step[2], w: lobe.w - step[3] };
            let valid = next.x > 0.0 && next.w > 0.0 && next.determinant() > 0.0;
            let trial = if valid { Some(self.normal(&next, goal)) } else { None };
            match trial {
                Some(trial) if trial.loss < normal.loss => {
                    let gain = (normal.loss - trial.loss) / normal.loss;
                    lobe = next;
                    normal = trial;
                    damping *= 0.2;
                    if gain < 1e-7 {
                        break;
                    }
                }
                _ => {
                    damping *= 8.0;
                    if damping > 1e12 {
                        break;
                    }
                }
            }
        }
        lobe
    }
}

impl Target {
    /// The magnitude with which `lobe` comes closest to Schlick's part, by weighted least squares.
    pub fn schlick_magnitude(&self, lobe: &Lobe) -> f64 {
        let (mut product, mut square) = (0.0, 0.0);
        for node in &self.nodes {
            let q = lobe.transform(glam::DVec3::new(node.x, node.y2.sqrt(), node.z));
            let n = 1.0 / q.length_squared();
            let density = lobe.determinant() * q.z.max(0.0) * n * n / PI;
            let weight = node.weight / (self.fresnel * density + node.schlick + 1e-9 * self.fresnel).sqrt();
            product += weight * node.schlick * density;
            square += weight * density * density;
        }
        product / square
    }
}

/// Solves a symmetric positive definite 4×4 system by Cholesky's factorisation.
pub(crate) fn solve(mut a: [[f64; 4]; 4], mut b: [f64; 4]) -> [f64; 4] {
    for i in 0..4 {
        for j in 0..=i {
            let mut sum = a[i][j];
            for k in 0..j {
                sum -= a[i][k] * a[j][k];
            }
            a[i][j] = if i == j { sum.max(1e-300).sqrt() } else { sum / a[j][j] };
        }
    }
    for i in 0..4 {
        for k in 0..i {
            b[i] -= a[i][k] * b[k];
        }
        b[i] /= a[i][i];
    }
    for i in (0..4).rev() {
        for k in i + 1..4 {
            b[i] -= a[k][i] * b[k];
        }
        b[i] /= a[i][i];
    }
    b
}
