//! The published fit of a table and of its edge integral, made anew: what others' shaders run on.
//!
//! Nothing of the include needs this. It shows what the same technique yields without the changes that the include's
//! own tables and formulas bring.

use core::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::angle::eliminate;
use super::single::Target;
use super::{Fitted, Layout, Settings, Texel};
use crate::brdf::{Brdf, Ggx, Lambert};
use crate::lobe::Lobe;
use crate::shade::angle_excess;
use crate::table::Table;

/// Points across a lobe from each of the two ways of sampling, and half as many around it; the other half is symmetric.
const POINTS: usize = 32;

/// Smallest α of a texel.
const ALPHA_FLOOR: f64 = 1e-5;

/// Smallest width of a lobe.
const WIDTH_FLOOR: f64 = 1e-7;

/// The table of the published technique for GGX, of `size` × `size` texels: lobes with three parameters whose axis is
/// the BRDF's mean direction, each fitted alone by the integral of |error|³ (Heitz et al. 2016, sections 4 and 5, with
/// the axes and the normalisation of the release of 2017, for which see
/// [`Layout::Compatible`]).
///
/// `table/ltc_published.bin` holds the bytes of the one of 64 × 64 texels. The result depends on nothing but `size`.
///
/// # Panics
///
/// If `size < 2`.
pub fn bake_published(size: usize) -> Table {
    assert!(size >= 2, "a table needs at least 2 texels along each axis, not {size}");
    let columns: Vec<Vec<Texel>> =
        firsts(size).into_par_iter().enumerate().map(|(column, first)| walk(size, column, first)).collect();
    let texels = (0..size).flat_map(|row| columns.iter().map(move |column| column[row])).collect();
    let settings = Settings { schlick_weight: 0.0, ..Settings::compatible(size) };
    Table::pack(&Fitted { settings, texels })
}

/// The lobe of one texel of that table, and its BRDF, before rounding.
pub fn published_lobe(size: usize, column: usize, row: usize) -> (Ggx, Lobe) {
    let texel = walk(size, column, firsts(size)[column])[row];
    (Ggx::new(alpha(size, column)), Lobe::from_entries(texel.parameters))
}

/// The widths of the round lobes along the normal. The roughest one leads, each fit starts where the last one ended.
fn firsts(size: usize) -> Vec<f64> {
    let mut widths = vec![1.0; size];
    for column in (0..size).rev() {
        let view = Sight::new(alpha(size, column), Layout::Compatible.cosine(0.0));
        let start = widths[(column + 1).min(size - 1)];
        widths[column] = least([start], |[width]| view.error(&Shape::round(width)))[0].max(WIDTH_FLOOR);
    }
    widths
}

/// The texels of a column from the normal to the grazing view, each fit starting where the last one ended.
fn walk(size: usize, column: usize, first: f64) -> Vec<Texel> {
    let mut parameters = [first, first, 0.0];
    let alpha = alpha(size, column);
    let texels = (0..size).map(|row| {
        let cosine = Layout::Compatible.cosine(row as f64 / (size - 1) as f64);
        let sight = Sight::new(alpha, cosine);
        if row > 0 {
            parameters = least(parameters, |p| sight.error(&sight.shape(p)));
        }
        let lobe = if row > 0 { sight.shape(parameters).inverse } else { Shape::round(first).inverse };
        // Half of the view's integrals is all that is kept, on more nodes than the error needs.
        let target = Target::new(&sight.brdf, cosine, 40, 0);
        Texel { parameters: lobe.entries(), albedo: target.albedo, fresnel: target.fresnel }
    });
    texels.collect()
}

fn alpha(size: usize, column: usize) -> f64 {
    (column as f64 / (size - 1) as f64).powi(2).max(ALPHA_FLOOR)
}

/// A lobe with the matrix that its inverse is the inverse of.
struct Shape {
    inverse: Lobe,
    /// The images of the three axes.
    axes: [DVec3; 3],
}

impl Shape {
    /// Leads the cosine's axis to `axis`, squeezes by the two widths and shears by `shear` in the plane of incidence
    /// (Heitz et al. 2016, section 4).
    fn new(axis: DVec3, [across, aside, shear]: [f64; 3]) -> Self {
        let (across, aside) = (across.max(WIDTH_FLOOR), aside.max(WIDTH_FLOOR));
        let x = DVec3::new(axis.z, 0.0, -axis.x);
        // Rows of the inverse, times the width aside.
        let first = (x - shear * axis) * (aside / across);
        let last = axis * aside;
        Self {
            inverse: Lobe { x: first.x, z: first.z, y: last.x, w: last.z },
            axes: [x * across, DVec3::Y * aside, x * shear + axis],
        }
    }

    fn round(width: f64) -> Self {
        Self::new(DVec3::Z, [width, width, 0.0])
    }

    /// A direction with the lobe's density.
    fn sample(&self, random: DVec2) -> DVec3 {
        let cosine = Lambert.sample(DVec3::Z, random);
        (self.axes[0] * cosine.x + self.axes[1] * cosine.y + self.axes[2] * cosine.z).normalize_or(DVec3::Z)
    }

    /// The lobe's density in a direction (Heitz et al. 2016, equation 7).
    fn density(&self, direction: DVec3) -> f64 {
        let original = self.inverse.transform(direction);
        let squared = original.length_squared();
        self.inverse.determinant() * original.z.max(0.0) / (PI * squared * squared)
    }
}

/// A BRDF seen from one direction, and points that it was sampled at.
struct Sight {
    brdf: Ggx,
    view: DVec3,
    albedo: f64,
    /// Mean direction.
    axis: DVec3,
    /// A direction, the value of f·cos and the density of both.
    points: Vec<(DVec3, f64, f64)>,
}

impl Sight {
    fn new(alpha: f64, cosine: f64) -> Self {
        let brdf = Ggx::new(alpha);
        let view = DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine);
        let points: Vec<_> = stratified()
            .map(|random| {
                let light = brdf.sample(view, random);
                (light, brdf.evaluate(view, light) * light.z.max(0.0), brdf.pdf(view, light))
            })
            .filter(|(_, _, density)| *density > 0.0)
            .collect();
        let mut sight = Self { brdf, view, albedo: 0.0, axis: DVec3::ZERO, points };
        for (light, value, density) in &sight.points {
            let share = value / density;
            sight.albedo += share;
            sight.axis += DVec3::new(light.x, 0.0, light.z) * share;
        }
        sight.albedo /= (POINTS * POINTS / 2) as f64;
        sight.axis = sight.axis.normalize_or(DVec3::Z);
        sight
    }

    fn shape(&self, parameters: [f64; 3]) -> Shape {
        Shape::new(self.axis, parameters)
    }

    /// ∫ |f·cos − lobe|³ over all directions, by points of both (Veach and Guibas 1995, balance heuristic).
    fn error(&self, shape: &Shape) -> f64 {
        let term = |light: DVec3, value: f64, density: f64| {
            let own = shape.density(light);
            let difference = (value - self.albedo * own).abs();
            difference * difference * difference / (density + own).max(f64::MIN_POSITIVE)
        };
        let of_brdf: f64 =
            self.points.iter().map(|&(light, value, density)| term(light, value, density)).sum();
        let of_lobe: f64 = stratified()
            .map(|random| {
                let light = shape.sample(random);
                let value = self.brdf.evaluate(self.view, light) * light.z.max(0.0);
                term(light, value, self.brdf.pdf(self.view, light))
            })
            .sum();
        of_brdf + of_lobe
    }
}

fn stratified() -> impl Iterator<Item = DVec2> {
    (0..POINTS * POINTS / 2).map(|i| {
        let (across, around) = (i % POINTS, i / POINTS);
        DVec2::new((across as f64 + 0.5) / POINTS as f64, (around as f64 + 0.5) / POINTS as f64)
    })
}

/// Where `function` is least, by the simplex method (Nelder and Mead 1965) with steps of 0.05, until the values differ
/// by less than 1e-5 of their mean or a hundred steps are made.
fn least<const N: usize>(start: [f64; N], function: impl Fn([f64; N]) -> f64) -> [f64; N] {
    let mut simplex: Vec<([f64; N], f64)> = vec![(start, function(start))];
    for axis in 0..N {
        let mut corner = start;
        corner[axis] += 0.05;
        simplex.push((corner, function(corner)));
    }
    for _ in 0..100 {
        simplex.sort_by(|a, b| a.1.total_cmp(&b.1));
        let (best, worst) = (simplex[0].1, simplex[N].1);
        if (worst - best).abs() <= 1e-5 * 0.5 * (worst.abs() + best.abs()) {
            break;
        }
        let middle: [f64; N] =
            core::array::from_fn(|k| simplex[..N].iter().map(|corner| corner.0[k]).sum::<f64>() / N as f64);
        let last = simplex[N].0;
        let beyond = |factor: f64| {
            let corner = core::array::from_fn(|k| middle[k] + factor * (middle[k] - last[k]));
            (corner, function(corner))
        };
        let reflected = beyond(1.0);
        let replacement = if reflected.1 < best {
            let expanded = beyond(2.0);
            if expanded.1 < reflected.1 { expanded } else { reflected }
        } else if N > 1 && reflected.1 < simplex[N - 1].1 {
            reflected
        } else {
            let contracted = if reflected.1 < worst { beyond(0.5) } else { beyond(-0.5) };
            if contracted.1 < worst.min(reflected.1) {
                contracted
            } else {
                let first = simplex[0].0;
                for corner in &mut simplex[1..] {
                    corner.0 = core::array::from_fn(|k| 0.5 * (first[k] + corner.0[k]));
                    corner.1 = function(corner.0);
                }
                continue;
            }
        };
        simplex[N] = replacement;
    }
    simplex.sort_by(|a, b| a.1.total_cmp(&b.1));
    simplex[0].0
}

/// Coefficients [a₀, a₁, a₂, b₀, b₁] for which (a₀ + a₁y + a₂y²) / (b₀ + b₁y + y²) is closest to θ / (2π sin θ) on
/// 0 ≤ y = cos θ ≤ 1, and the largest relative error, by Remez's exchange for a rational function: the form in which Hill
/// and Heitz (2016, "Real-Time Area Lighting: a Journey from Research to Production"; released in 2017) evaluate the edge
/// integral.
///
/// `wgsl/compare/published.wgsl` and its twin hold the coefficients, rounded to f32.
pub fn fit_published_angle() -> ([f64; 5], f64) {
    let exact = |y: f64| (1.0 + angle_excess((1.0 - y).max(0.0))) / TAU;
    let numerator = |c: &[f64; 5], y: f64| c[0] + (c[1] + c[2] * y) * y;
    let denominator = |c: &[f64; 5], y: f64| c[3] + (c[4] + y) * y;
    let error = |c: &[f64; 5], y: f64| numerator(c, y) / denominator(c, y) / exact(y) - 1.0;
    let place = |position: f64| 0.5 - 0.5 * (PI * position).cos();
    let grid: Vec<f64> = (0..=20_000).map(|i| place(f64::from(i) / 20_000.0)).collect();
    let mut points: Vec<f64> = (0..6).map(|i| place(f64::from(i) / 5.0)).collect();
    // The divisor of the last round stands for that of the next one where the error is levelled.
    let mut coefficients = [0.0, 0.0, 0.0, 3.0, 3.0];
    for _ in 0..100 {
        let rows = points.iter().enumerate().map(|(i, &y)| {
            let level = exact(y) * denominator(&coefficients, y) * if i % 2 == 0 { 1.0 } else { -1.0 };
            vec![1.0, y, y * y, -exact(y), -exact(y) * y, level, exact(y) * y * y]
        });
        let solution = eliminate(rows.collect());
        coefficients = core::array::from_fn(|k| solution[k]);
        let mut extrema: Vec<(f64, f64)> = Vec::new();
        for &y in &grid {
            let value = error(&coefficients, y);
            match extrema.last_mut() {
                Some(last) if (last.1 > 0.0) == (value > 0.0) => {
                    if value.abs() > last.1.abs() {
                        *last = (y, value);
                    }
                }
                _ => extrema.push((y, value)),
            }
        }
        if extrema.len() == points.len() {
            points = extrema.iter().map(|extremum| extremum.0).collect();
        }
    }
    let worst = grid.iter().map(|&y| error(&coefficients, y).abs()).fold(0.0, f64::max);
    (coefficients, worst)
}
