//! A sum of lobes against one view of a BRDF.

use core::f64::consts::PI;

use super::view::{Node, View};
use crate::lobe::Lobe;

/// A quadratic model of a loss: its value, half its gradient and the Gauss–Newton matrix.
#[derive(Clone, Copy)]
pub(super) struct Quadratic<const D: usize> {
    pub loss: f64,
    pub gradient: [f64; D],
    pub hessian: [[f64; D]; D],
}

impl<const D: usize> Quadratic<D> {
    /// Of numbers that describe no lobes: far worse than any lobes, and without a way out.
    const INVALID: Self = Self { loss: 100.0, gradient: [0.0; D], hessian: [[0.0; D]; D] };

    pub fn times(mut self, factor: f64) -> Self {
        self.loss *= factor;
        self.gradient = self.gradient.map(|g| g * factor);
        self.hessian = self.hessian.map(|row| row.map(|h| h * factor));
        self
    }
}

/// The least that a lobe's determinant may be, in units of x·w. It leaves room for rounding and for interpolation: at
/// 0 a lobe becomes flat.
const LEAST_DETERMINANT: f64 = 0.1;

/// A lobe cut at the surface's horizon and divided by what is left, with what its derivatives need.
pub(super) struct Cut {
    lobe: Lobe,
    /// Factor on z / length⁴ of a transformed direction that gives the density in 1/sr.
    scale: f64,
    /// Logarithmic derivatives of `scale`.
    slope: [f64; 4],
}

impl Cut {
    /// None for entries that describe no lobe, or one that is nearly flat.
    pub fn new(lobe: Lobe) -> Option<Self> {
        let det = lobe.determinant();
        if !(lobe.x > 0.0 && lobe.w > 0.0 && det > LEAST_DETERMINANT * lobe.x * lobe.w) {
            return None;
        }
        let radius2 = lobe.x * lobe.x + lobe.y * lobe.y;
        let radius = radius2.sqrt();
        let share = 0.5 + 0.5 * lobe.x / radius;
        let from_x = 0.5 * lobe.y * lobe.y / (radius2 * radius) / share;
        let from_y = -0.5 * lobe.x * lobe.y / (radius2 * radius) / share;
        let slope = [lobe.w / det - from_x, -lobe.z / det - from_y, -lobe.y / det, lobe.x / det];
        Some(Self { lobe, scale: det / (PI * share), slope })
    }

    /// The lobe's mass at some nodes and its derivatives in (x, y, z, w).
    fn mass(&self, nodes: &[Node]) -> (f64, [f64; 4]) {
        let Self { scale, slope, .. } = self;
        let (mut mass, mut bend) = (0.0, [0.0; 4]);
        for node in nodes {
            let (qx, qz, n) = self.transform(node);
            let slant = if qz > 0.0 { node.weight * n * n } else { 0.0 };
            let value = slant * qz;
            let from_x = -4.0 * qx * n * value;
            let from_z = slant * (1.0 - 4.0 * qz * qz * n);
            mass += value;
            bend[0] += from_x * node.x;
            bend[1] += from_z * node.x;
            bend[2] += from_x * node.z;
            bend[3] += from_z * node.z;
        }
        (scale * mass, core::array::from_fn(|k| scale * (bend[k] + slope[k] * mass)))
    }

    /// ∫ (1 − v·h)⁵ over the lobe.
    pub fn schlick(&self, view: &View) -> f64 {
        let part = |node: &Node| {
            let (_, qz, n) = self.transform(node);
            node.weight * qz.max(0.0) * n * n * node.schlick
        };
        self.scale * view.nodes.iter().map(part).sum::<f64>()
    }

    /// The first and the third component of a node in the lobe's space, and one over its squared length there.
    fn transform(&self, node: &Node) -> (f64, f64, f64) {
        let qx = self.lobe.x * node.x + self.lobe.z * node.z;
        let qz = self.lobe.y * node.x + self.lobe.w * node.z;
        (qx, qz, 1.0 / (qx * qx + node.y2 + qz * qz))
    }
}

/// The loss of the sum of `lobes` with `weights`: (l − f)² / (l + f) over the cells, with the divisor held fixed in
/// its derivatives, over the albedo. Of the powers ½, ¾, 1 and 5/4 of the divisor this one gave the least mean error
/// of specular light integrals on random quads; for two lobes ¾ gave a slightly smaller one of the Schlick part by
/// regions.
///
/// It is a function of all entries of the lobes (times `scale`) and of the weights but the last one, which is what the
/// others leave of the albedo: 5·N − 1 = D numbers, lobe by lobe.
pub(super) fn quadratic<const N: usize, const D: usize>(
    view: &View,
    lobes: &[Lobe; N],
    weights: &[f64; N],
    scale: &[f64; 4],
) -> Quadratic<D> {
    let mut cuts = Vec::with_capacity(N);
    for lobe in lobes {
        match Cut::new(*lobe) {
            Some(cut) => cuts.push(cut),
            None => return Quadratic::INVALID,
        }
    }
    let mut sum = Quadratic { loss: 0.0, gradient: [0.0; D], hessian: [[0.0; D]; D] };
    for cell in &view.cells {
        let mut derivative = [0.0; D];
        let mut total = 0.0;
        let mut masses = [0.0; N];
        for i in 0..N {
            let (mass, bend) = cuts[i].mass(&view.nodes[cell.nodes.clone()]);
            masses[i] = mass;
            total += weights[i] * mass;
            for k in 0..4 {
                derivative[5 * i + k] = weights[i] * scale[k] * bend[k];
            }
        }
        for i in 0..N - 1 {
            derivative[5 * i + 4] = masses[i] - masses[N - 1];
        }
        let residual = total - cell.mass;
        let tiny = 1e-9 * view.albedo * cell.angle;
        let weight = 1.0 / (view.albedo * (total + cell.mass + tiny));
        sum.loss += weight * residual * residual;
        for i in 0..D {
            let weighted = weight * derivative[i];
            sum.gradient[i] += residual * weighted;
            for j in 0..=i {
                sum.hessian[i][j] += weighted * derivative[j];
            }
        }
    }
    for i in 0..D {
        for j in 0..i {
            sum.hessian[j][i] = sum.hessian[i][j];
        }
    }
    sum
}
