//! The fit of anisotropic GGX: what its lobes differ by from stretched isotropic ones.
//!
//! Two analytic steps do most of the work, see `ltc_anisotropic_lobe` in the include; the table holds the
//! rest. Of the nine entries of a lobe's matrix two say nothing: its scale, and a rotation of the
//! lobe's space about its axis (the clamped cosine is round). So seven are fitted, with a symmetric upper
//! left block. The symmetries that halve the range of azimuths twice and the ratios once are those of
//! Kt, Heitz, Dupuy and Narayanan 2022, "Bringing Linearly Transformed Cosines to Anisotropic GGX".

use core::f64::consts::{FRAC_PI_4, PI, SQRT_2};
use core::sync::atomic::{AtomicUsize, Ordering};

use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;

use crate::brdf::AnisotropicGgx;
use crate::brdf::{Brdf, Lambert};
use crate::shade::{
    LTC_ALPHA_FLOOR, LTC_ANISOTROPIC_KNEE as KNEE, LTC_ANISOTROPIC_SIZE, LtcAnisotropy, LtcSurface,
    anisotropic_azimuth, anisotropic_base, anisotropic_stretch, ltc_anisotropic_round, ltc_anisotropy,
    ltc_surface, ltc_table_coordinates,
};
use crate::table::Table;

/// The seven numbers of a lobe's matrix: entries (1,1), (1,2), (2,2), (1,3), (2,3), (3,1), (3,2); (2,1) equals
/// (1,2), and (3,3) is 1.
type Shape = [f64; 7];

/// The smallest cosine of a view that is fitted, as for the isotropic table.
const SMALLEST_COSINE: f64 = 1e-4;

/// The largest α at the first texels: there the smaller one is the floor at a ratio of ten.
const SMALLEST_ALPHA: f64 = 10.0 * LTC_ALPHA_FLOOR;

/// Weight of the distance from the stretched isotropic lobe, at the largest ratio. It decides what the BRDF
/// leaves open, at grazing views of sharp lobes: corrections stay half as large, and the error of light integrals
/// moves by less than a fiftieth of itself against a weight of 1e-4.
const PRIOR: f64 = 3e-3;

/// Levenberg–Marquardt steps at most.
const STEPS: usize = 60;

/// A fitted table of anisotropic lobes before it is packed.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedAnisotropic {
    /// Eight numbers for each of the 8⁴ texels: seven corrections of the matrix and that of the albedo.
    /// The larger α runs fastest, then view, azimuth and ratio.
    pub texels: Vec<[f64; 8]>,
}

/// What a texel stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    alpha_x: f64,
    alpha_y: f64,
    view: DVec3,
    /// The fourth coordinate, which multiplies the correction.
    depth: f64,
}

impl Place {
    /// The inverse of `ltc_anisotropic_coordinates`.
    fn new([alpha, view, azimuth, ratio]: [f64; 4]) -> Self {
        let alpha_x = (alpha * alpha).max(SMALLEST_ALPHA);
        // The correction of equal roughnesses is multiplied by zero: its texels are fitted where they count.
        let depth = ratio.max(0.5 / (LTC_ANISOTROPIC_SIZE - 1) as f64);
        let root = 1.0 - depth * (1.0 - 0.1_f64.sqrt());
        let alpha_y = alpha_x * root * root;
        let (sine, cosine) = (FRAC_PI_4 + ((2.0 * azimuth - 1.0) / SQRT_2).asin()).sin_cos();
        // Exactly zero at the ends, where symmetry makes some of the numbers zero.
        let sine = if azimuth > 0.0 { sine } else { 0.0 };
        let cosine = if azimuth < 1.0 { cosine } else { 0.0 };
        let alpha_view = (alpha_x * cosine).hypot(alpha_y * sine);
        // The tangent of half the stretched view's angle, and from it the cotangent of the whole.
        let half = KNEE * view / (1.0 + KNEE - view);
        let stretched = (1.0 - half * half).max(1e-12) / (2.0 * half).max(1e-300);
        let cotangent = (alpha_view * stretched).max(SMALLEST_COSINE);
        let view = if half > 0.0 { DVec3::new(cosine, sine, cotangent).normalize() } else { DVec3::Z };
        Self { alpha_x, alpha_y, view, depth }
    }

    fn surface(&self) -> (LtcSurface<f64>, LtcAnisotropy<f64>) {
        let surface = ltc_surface(DVec3::ZERO, DVec3::Z, self.view, 1.0);
        let anisotropy = ltc_anisotropy(&surface, DVec3::X, self.alpha_x, self.alpha_y);
        (surface, anisotropy)
    }

    /// Which of the seven numbers are not zero by symmetry.
    fn free(&self) -> [bool; 7] {
        let (along, across) = (self.view.x > 0.0, self.view.y > 0.0);
        [true, along & across, true, along, across, along, across]
    }
}

/// One quadrature node of the upper hemisphere.
struct Node {
    /// The direction in the lobe's space before the seven numbers.
    at: DVec3,
    value: f64,
    weight: f64,
}

/// A view of the BRDF prepared for fitting.
struct Target {
    nodes: Vec<Node>,
    albedo: f64,
    /// The surface's horizon in the lobe's space before the seven numbers.
    horizon: DVec3,
    /// Determinant of the matrix that leads directions there.
    volume: f64,
}

impl Target {
    /// Nodes by the BRDF's own sampling, `count`², and a quarter of that by the cosine, weighed by the balance
    /// heuristic (Veach 1997). `stretch` leads from the lobe's space, before the seven numbers, to the surface's
    /// frame.
    fn new(place: &Place, stretch: DMat3, count: usize) -> Self {
        let Place { alpha_x, alpha_y, view, .. } = *place;
        let brdf = AnisotropicGgx { alpha_x, alpha_y, azimuth: 0.0 };
        let inverse = stretch.inverse();
        let volume = inverse.determinant();
        let horizon = stretch.transpose() * DVec3::Z;
        let mut target = Self { nodes: Vec::with_capacity(2 * count * count), albedo: 0.0, horizon, volume };
        let (own, diffuse) = ((count * count) as f64, (count / 2 * (count / 2)) as f64);
        let mut add = |light: DVec3| {
            let density = own * brdf.pdf(view, light) + diffuse * light.z / PI;
            if light.z > 0.0 && density > 0.0 {
                let (value, weight) = (brdf.evaluate(view, light) * light.z, 1.0 / density);
                target.albedo += weight * value;
                target.nodes.push(Node { at: inverse * light, value, weight });
            }
        };
        let grid = |count: usize| {
            let place = move |i: usize| (i as f64 + 0.5) / count as f64;
            (0..count * count).map(move |i| DVec2::new(place(i % count), place(i / count)))
        };
        grid(count).for_each(|random| add(brdf.sample(view, random)));
        grid(count / 2).for_each(|random| add(Lambert.sample(view, random)));
        target
    }

    /// Logarithm of the factor on the lobe that its matrix and the horizon's cut cause.
    fn log_scale(&self, matrix: &DMat3) -> f64 {
        let normal = matrix.transpose() * self.horizon;
        let share = 0.5 + 0.5 * normal.z / normal.length();
        -(matrix.determinant() * share.max(1e-9)).ln()
    }

    /// Weighted least squares around `shape`, with the residual of the isotropic fit, and `prior_weight` times
    /// the distance from `prior`.
    fn normal(&self, shape: &Shape, prior: &Shape, prior_weight: f64) -> Normal {
        let matrix = matrix(shape);
        let inverse = matrix.inverse();
        let back = inverse.transpose();
        let scale = self.albedo * self.volume * self.log_scale(&matrix).exp() / PI;
        let mut normal = Normal::default();
        if !scale.is_finite() {
            normal.loss = f64::INFINITY;
            return normal;
        }
        let constant: Shape = core::array::from_fn(|k| {
            let shifted = |by: f64| {
                let mut shifted = *shape;
                shifted[k] += by;
                self.log_scale(&self::matrix(&shifted))
            };
            (shifted(1e-5) - shifted(-1e-5)) / 2e-5
        });
        let mut strength = 0.0;
        for node in &self.nodes {
            let q = inverse * node.at;
            let n = 1.0 / q.length_squared();
            let value = if q.z > 0.0 { scale * q.z * n * n } else { 0.0 };
            let residual = value - node.value;
            let root = (value + node.value + 1e-9 * self.albedo).sqrt();
            let weight = node.weight / (root * root.sqrt());
            normal.loss += weight * residual * residual;
            strength += node.weight * node.value.sqrt();
            if value <= 0.0 {
                continue;
            }
            let pull = back * (q * (-4.0 * n) + DVec3::Z * (1.0 / q.z));
            let slopes = [
                pull.x * q.x,
                pull.x * q.y + pull.y * q.x,
                pull.y * q.y,
                pull.x * q.z,
                pull.y * q.z,
                pull.z * q.x,
                pull.z * q.y,
            ];
            let derivative: Shape = core::array::from_fn(|k| value * (constant[k] - slopes[k]));
            for i in 0..7 {
                let weighted = weight * derivative[i];
                normal.gradient[i] += weighted * residual;
                for j in 0..=i {
                    normal.hessian[i][j] += weighted * derivative[j];
                }
            }
        }
        let strength = prior_weight * strength;
        for i in 0..7 {
            let away = shape[i] - prior[i];
            normal.loss += strength * away * away;
            normal.gradient[i] += strength * away;
            normal.hessian[i][i] += strength;
            for j in 0..i {
                normal.hessian[j][i] = normal.hessian[i][j];
            }
        }
        normal
    }

    /// Fits the `free` numbers by Levenberg–Marquardt, starting at the prior.
    fn fit(&self, prior: &Shape, weight: f64, free: [bool; 7]) -> Shape {
        let mut shape = *prior;
        let mut normal = self.normal(&shape, prior, weight);
        let mut damping = 1e-3;
        for _ in 0..STEPS {
            let (mut system, mut right) = (normal.hessian, normal.gradient);
            for i in 0..7 {
                system[i][i] *= 1.0 + damping;
                if !free[i] {
                    right[i] = 0.0;
                    for j in 0..7 {
                        system[i][j] = 0.0;
                        system[j][i] = 0.0;
                    }
                    system[i][i] = 1.0;
                }
            }
            let step = solve(system, right);
            let next: Shape = core::array::from_fn(|k| shape[k] - step[k]);
            let trial = (matrix(&next).determinant() > 0.0).then(|| self.normal(&next, prior, weight));
            match trial {
                Some(trial) if trial.loss < normal.loss => {
                    let gain = (normal.loss - trial.loss) / normal.loss;
                    (shape, normal) = (next, trial);
                    damping *= 0.2;
                    if gain < 1e-6 {
                        break;
                    }
                }
                _ => {
                    damping *= 8.0;
                    if damping > 1e10 {
                        break;
                    }
                }
            }
        }
        shape
    }
}

/// Sum of squared residuals, its gradient half and the Gauss–Newton matrix.
#[derive(Clone, Copy, Default)]
struct Normal {
    loss: f64,
    gradient: Shape,
    hessian: [[f64; 7]; 7],
}

/// The matrix that seven numbers describe.
fn matrix([xx, xy, yy, xz, yz, zx, zy]: &Shape) -> DMat3 {
    DMat3::from_cols_array(&[*xx, *xy, *zx, *xy, *yy, *zy, *xz, *yz, 1.0])
}

/// Solves a symmetric positive definite system by Cholesky's factorisation.
fn solve(mut a: [[f64; 7]; 7], mut b: Shape) -> Shape {
    for i in 0..7 {
        for j in 0..=i {
            let sum = (0..j).fold(a[i][j], |sum, k| sum - a[i][k] * a[j][k]);
            a[i][j] = if i == j { sum.max(1e-300).sqrt() } else { sum / a[j][j] };
        }
    }
    for i in 0..7 {
        b[i] = (0..i).fold(b[i], |sum, k| sum - a[i][k] * b[k]) / a[i][i];
    }
    for i in (0..7).rev() {
        b[i] = (i + 1..7).fold(b[i], |sum, k| sum - a[k][i] * b[k]) / a[i][i];
    }
    b
}

/// The eight numbers of a texel by its index.
fn texel(table: &Table, nodes: usize, index: usize) -> [f64; 8] {
    let size = LTC_ANISOTROPIC_SIZE;
    let digits = [index, index / size, index / size / size, index / size / size / size];
    let place = Place::new(digits.map(|digit| (digit % size) as f64 / (size - 1) as f64));
    let (surface, anisotropy) = place.surface();
    let round = ltc_anisotropic_round(&surface, &anisotropy);
    let at = ltc_table_coordinates(&round, table.size() as f64);
    // The table's entries are along the major and minor direction, wherever the view is.
    let [cosine, sine] = anisotropic_azimuth(&anisotropy);
    let turn = DMat3::from_cols_array_2d(&[[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]]);
    let stretch = DMat3::from_cols_array_2d(&anisotropic_stretch(&surface, &anisotropy)) * turn.transpose();
    let target = Target::new(&place, stretch, nodes);
    let [along, across, along_up, up_along] =
        anisotropic_base(&surface, &anisotropy, table.sample::<f64>(0, at));
    let difference = along - across;
    let base = [
        across + difference * cosine * cosine,
        difference * cosine * sine,
        across + difference * sine * sine,
        along_up * cosine,
        along_up * sine,
        up_along * cosine,
        up_along * sine,
    ];
    let shape = target.fit(&base, PRIOR / place.depth, place.free());
    let brightness = target.albedo / table.sample::<f64>(1, at).x - 1.0;
    core::array::from_fn(|k| (if k < 7 { shape[k] - base[k] } else { brightness }) / place.depth)
}

/// Fits the table of anisotropic GGX with height-correlated Smith masking on top of the isotropic `table`,
/// which must be that of GGX, with `nodes` quadrature nodes across a lobe; the embedded one has 40. The result
/// depends on nothing but the arguments: not on the number of threads, nor on their timing.
///
/// Each texel is fitted alone, from the stretched isotropic lobe. That the corrections are smooth shows in the
/// error of light integrals between texels, which is within a twentieth of that of fits of their own; pulling texels
/// towards the mean of their neighbours lowers it by a hundredth.
///
/// `progress` is told the share of the work done, 0…1, from any thread.
pub fn bake_anisotropic(table: &Table, nodes: usize, progress: &(dyn Fn(f64) + Sync)) -> FittedAnisotropic {
    let count = LTC_ANISOTROPIC_SIZE.pow(4);
    let done = AtomicUsize::new(0);
    let texels = (0..count)
        .into_par_iter()
        .map(|index| {
            let texel = texel(table, nodes, index);
            progress((done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / count as f64);
            texel
        })
        .collect();
    FittedAnisotropic { texels }
}
