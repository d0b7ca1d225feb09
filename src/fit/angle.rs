//! The minimax polynomials behind the include's integrals along edges and arcs.

use crate::shade::{angle_excess, hyperbolic_excess};

/// Coefficients q₀…q_degree, and the largest relative error of 1 + k·Σ qᵢkⁱ against θ / sin θ on
/// 0 ≤ k ≤ 1, by Remez's exchange algorithm.
///
/// The include's `ltc_angle_excess` holds the coefficients for degree 7, rounded to f32.
pub fn fit_angle_excess(degree: usize) -> (Vec<f64>, f64) {
    fit_excess(degree, angle_excess)
}

/// The same for η / sinh η as a function of k = cosh η − 1.
///
/// The include's `ltc_hyperbolic_excess` holds the coefficients for degree 5, rounded to f32.
pub fn fit_hyperbolic_excess(degree: usize) -> (Vec<f64>, f64) {
    fit_excess(degree, hyperbolic_excess)
}

/// Coefficients τ₀…τ_degree, and the largest relative error of 1 + (1/c − 1)·Σ τᵢcⁱ against θ / sin θ, with
/// c = cos(θ/2), over all angles: the pole at 180° is that of 1/c.
///
/// The include's `ltc_fast_ratio` holds what follows from the coefficients for degree 2, with twice the cosine.
pub fn fit_half_angle(degree: usize) -> (Vec<f64>, f64) {
    let quotient = |c: f64| {
        let sine = (1.0 - c * c).sqrt();
        // For small angles the difference of the two has no digits; θ / sin θ − 1 is 4/3 of 1/c − 1 there.
        if c > 1.0 - 1e-7 { 4.0 / 3.0 } else { (c.acos() / sine - c) / (1.0 - c) }
    };
    // (1/c − 1) over 1 + (1/c − 1)·τ, without the pole.
    remez(degree, quotient, |c| (1.0 - c) / (c + (1.0 - c) * quotient(c)))
}

/// Coefficients of the polynomial q(k) for which 1 + k·q(k) is closest to 1 + `excess`(k) on 0 ≤ k ≤ 1,
/// and the largest relative error.
fn fit_excess(degree: usize, excess: fn(f64) -> f64) -> (Vec<f64>, f64) {
    remez(degree, |k| excess(k) / k, |k| k / (1.0 + excess(k)))
}

/// Coefficients of the polynomial whose largest weighted error against `target` on 0 < k ≤ 1 is the least, and that
/// error.
fn remez(degree: usize, target: impl Fn(f64) -> f64, weight: impl Fn(f64) -> f64) -> (Vec<f64>, f64) {
    let unknowns = degree + 2;
    let error = |coefficients: &[f64], k: f64| {
        let fitted = coefficients.iter().rev().fold(0.0, |sum, q| sum * k + q);
        weight(k) * (fitted - target(k))
    };
    let grid: Vec<f64> =
        (1..=20_000).map(|i| 0.5 - 0.5 * (core::f64::consts::PI * f64::from(i) / 20_000.0).cos()).collect();
    let mut points: Vec<f64> = (0..unknowns)
        .map(|i| {
            let position = (i as f64 + 0.5) / unknowns as f64;
            0.5 - 0.5 * (core::f64::consts::PI * position).cos()
        })
        .collect();
    let mut coefficients = vec![0.0; degree + 1];
    for _ in 0..30 {
        let rows = points.iter().enumerate().map(|(i, &k)| {
            let mut row: Vec<f64> = (0..=degree).map(|power| k.powi(power as i32)).collect();
            row.push(if i % 2 == 0 { 1.0 } else { -1.0 } / weight(k));
            row.push(target(k));
            row
        });
        coefficients = eliminate(rows.collect());
        let level = coefficients.pop().unwrap_or(0.0).abs();
        // The new points: the extremum of each run of equal sign.
        let mut extrema: Vec<(f64, f64)> = Vec::new();
        for &k in &grid {
            let value = error(&coefficients, k);
            match extrema.last_mut() {
                Some(last) if (last.1 > 0.0) == (value > 0.0) => {
                    if value.abs() > last.1.abs() {
                        *last = (k, value);
                    }
                }
                _ => extrema.push((k, value)),
            }
        }
        while extrema.len() > unknowns {
            let first = extrema[0].1.abs();
            let last = extrema[extrema.len() - 1].1.abs();
            if first < last {
                extrema.remove(0);
            } else {
                extrema.pop();
            }
        }
        if extrema.len() < unknowns {
            break;
        }
        points = extrema.iter().map(|extremum| extremum.0).collect();
        let worst = extrema.iter().map(|extremum| extremum.1.abs()).fold(0.0, f64::max);
        if worst < level * (1.0 + 1e-6) {
            break;
        }
    }
    let worst = grid.iter().map(|&k| error(&coefficients, k).abs()).fold(0.0, f64::max);
    (coefficients, worst)
}

/// Gaussian elimination with partial pivoting of rows that end in the right-hand side.
pub(super) fn eliminate(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for column in 0..n {
        let pivot = (column..n)
            .max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()))
            .unwrap_or(column);
        rows.swap(column, pivot);
        let pivot = rows[column].clone();
        for row in &mut rows[column + 1..] {
            let factor = row[column] / pivot[column];
            for (entry, above) in row.iter_mut().zip(&pivot).skip(column) {
                *entry -= factor * above;
            }
        }
    }
    let mut solution = vec![0.0; n];
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|j| rows[i][j] * solution[j]).sum();
        solution[i] = (rows[i][n] - known) / rows[i][i];
    }
    solution
}
