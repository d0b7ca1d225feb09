//! The joint fit of all texels to what bilinear interpolation returns.

use rayon::prelude::*;

use super::single::{Normal, Target};
use super::{Fitted, Layout, Settings, Texel, decode};

/// Gauss–Newton steps over the whole table.
const STEPS: usize = 3;

/// Weight of the second differences of the parameters along each axis, relative to the mean
/// curvature of the loss. It decides only what the loss leaves open: where two parameters trade
/// off against each other, and at grazing views of sharp lobes.
const SMOOTHNESS: f64 = 1e-4;

/// A place where the interpolated lobe is compared with the BRDF: four texels and their weights.
struct Sample<'a> {
    corners: [usize; 4],
    weights: [f64; 4],
    alpha: f64,
    cosine: f64,
    target: &'a Target,
}

/// The quadratic model of the loss at one sample, in the layout's parameters.
struct Quadratic {
    gradient: [f64; 4],
    hessian: [[f64; 4]; 4],
    loss: f64,
}

type Field = Vec<[f64; 4]>;

pub(super) fn refine(fitted: &mut Fitted, columns: &[Vec<(Texel, Target)>], between: &[Vec<Target>]) {
    let Settings { size, layout, .. } = fitted.settings;
    let last = (size - 1) as f64;
    let mut samples = Vec::with_capacity(2 * size * size);
    for row in 0..size {
        for column in 0..size {
            samples.push(Sample {
                corners: [column + row * size; 4],
                weights: [1.0, 0.0, 0.0, 0.0],
                alpha: layout.alpha(column as f64 / last),
                cosine: layout.cosine(row as f64 / last),
                target: &columns[column][row].1,
            });
        }
    }
    for row in 0..size - 1 {
        for column in 0..size - 1 {
            let first = column + row * size;
            samples.push(Sample {
                corners: [first, first + 1, first + size, first + size + 1],
                weights: [0.25; 4],
                alpha: layout.alpha((column as f64 + 0.5) / last),
                cosine: layout.cosine((row as f64 + 0.5) / last),
                target: &between[column][row],
            });
        }
    }

    // The amplitudes are fitted the same way: they are plain functions of the two axes.
    let amplitudes = fit_amplitudes(fitted, &samples);
    for (texel, [albedo, fresnel, ..]) in fitted.texels.iter_mut().zip(amplitudes) {
        texel.albedo = albedo;
        texel.fresnel = fresnel;
    }

    let mut field: Field = fitted.texels.iter().map(|texel| texel.parameters).collect();
    let mut models = quadratics(fitted, &samples, &field);
    let mut loss = total(&models);
    for _ in 0..STEPS {
        let step = solve(&samples, &models, size);
        // Halve the step until the loss falls: far from the optimum the quadratic model may
        // promise too much.
        let mut factor = 1.0;
        let mut improved = false;
        while factor > 0.05 {
            let trial: Field = field
                .iter()
                .zip(&step)
                .map(|(p, d)| core::array::from_fn(|k| p[k] - factor * d[k]))
                .collect();
            let trial_models = quadratics(fitted, &samples, &trial);
            let trial_loss = total(&trial_models);
            if trial_loss < loss {
                (field, models, loss, improved) = (trial, trial_models, trial_loss, true);
                break;
            }
            factor *= 0.5;
        }
        if !improved {
            break;
        }
    }
    for (texel, parameters) in fitted.texels.iter_mut().zip(field) {
        texel.parameters = parameters;
    }
    if layout == Layout::Compatible {
        // Where Schlick's part is a constant share of the lobe, the best share is not the part's
        // integral: some of that lies where the lobe does not reach.
        for row in 0..size {
            for (column, targets) in columns.iter().enumerate() {
                let lobe = fitted.lobe(column, row);
                fitted.texels[column + row * size].fresnel =
                    targets[row].1.schlick_magnitude(&lobe).clamp(0.0, 1.0);
            }
        }
    }
}

fn total(models: &[Quadratic]) -> f64 {
    models.iter().map(|model| model.loss).sum()
}

fn interpolate(sample: &Sample, field: &[[f64; 4]]) -> [f64; 4] {
    core::array::from_fn(|k| {
        (0..4).map(|corner| sample.weights[corner] * field[sample.corners[corner]][k]).sum()
    })
}

fn quadratics(fitted: &Fitted, samples: &[Sample], field: &[[f64; 4]]) -> Vec<Quadratic> {
    let layout = fitted.settings.layout;
    let goal = fitted.settings.goal();
    samples
        .par_iter()
        .map(|sample| {
            let parameters = interpolate(sample, field);
            let lobe = decode(layout, &parameters, sample.alpha, sample.cosine);
            if lobe.determinant() <= 0.0 || lobe.x <= 0.0 || lobe.w <= 0.0 {
                return Quadratic { gradient: [0.0; 4], hessian: [[0.0; 4]; 4], loss: f64::INFINITY };
            }
            let Normal { loss, gradient, hessian } = sample.target.normal(&lobe, goal);
            let (_, scale) = layout.affine(sample.alpha, sample.cosine);
            Quadratic {
                loss,
                gradient: core::array::from_fn(|i| scale[i] * gradient[i]),
                hessian: core::array::from_fn(|i| {
                    core::array::from_fn(|j| scale[i] * scale[j] * hessian[i][j])
                }),
            }
        })
        .collect()
}

/// Solves the normal equations of all samples for the step, by conjugate gradients with the
/// diagonal as preconditioner.
fn solve(samples: &[Sample], models: &[Quadratic], size: usize) -> Field {
    let count = size * size;
    let mut right: Field = vec![[0.0; 4]; count];
    let mut diagonal: Field = vec![[0.0; 4]; count];
    for (sample, model) in samples.iter().zip(models) {
        for corner in 0..4 {
            let weight = sample.weights[corner];
            for k in 0..4 {
                right[sample.corners[corner]][k] += weight * model.gradient[k];
                diagonal[sample.corners[corner]][k] += weight * weight * model.hessian[k][k];
            }
        }
    }
    let mean: [f64; 4] =
        core::array::from_fn(|k| SMOOTHNESS * diagonal.iter().map(|d| d[k]).sum::<f64>() / count as f64);
    for entry in &mut diagonal {
        for k in 0..4 {
            entry[k] += 6.0 * mean[k];
        }
    }
    let apply = |x: &Field| -> Field {
        let mut y = vec![[0.0; 4]; count];
        for (sample, model) in samples.iter().zip(models) {
            let p = interpolate(sample, x);
            let h: [f64; 4] = core::array::from_fn(|i| (0..4).map(|j| model.hessian[i][j] * p[j]).sum());
            for corner in 0..4 {
                for k in 0..4 {
                    y[sample.corners[corner]][k] += sample.weights[corner] * h[k];
                }
            }
        }
        add_smoothness(x, &mut y, &mean, size);
        y
    };
    conjugate_gradients(apply, right, &diagonal)
}

fn add_smoothness(x: &Field, y: &mut Field, weight: &[f64; 4], size: usize) {
    let mut along = |first: usize, stride: usize| {
        for i in 1..size - 1 {
            let middle = first + i * stride;
            for k in 0..4 {
                let second = weight[k] * (x[middle - stride][k] - 2.0 * x[middle][k] + x[middle + stride][k]);
                y[middle - stride][k] += second;
                y[middle][k] -= 2.0 * second;
                y[middle + stride][k] += second;
            }
        }
    };
    for line in 0..size {
        along(line * size, 1);
        along(line, size);
    }
}

fn conjugate_gradients(apply: impl Fn(&Field) -> Field, right: Field, diagonal: &Field) -> Field {
    let dot = |a: &Field, b: &Field| -> f64 {
        a.iter().zip(b).map(|(a, b)| (0..4).map(|k| a[k] * b[k]).sum::<f64>()).sum()
    };
    let precondition = |r: &Field| -> Field {
        r.iter()
            .zip(diagonal)
            .map(|(r, d)| core::array::from_fn(|k| if d[k] > 0.0 { r[k] / d[k] } else { 0.0 }))
            .collect()
    };
    let mut solution: Field = vec![[0.0; 4]; right.len()];
    let mut residual = right;
    let mut conditioned = precondition(&residual);
    let mut direction = conditioned.clone();
    let mut product = dot(&residual, &conditioned);
    let goal = product * 1e-12;
    for _ in 0..100 {
        if product <= goal {
            break;
        }
        let image = apply(&direction);
        let length = product / dot(&direction, &image);
        for i in 0..solution.len() {
            for k in 0..4 {
                solution[i][k] += length * direction[i][k];
                residual[i][k] -= length * image[i][k];
            }
        }
        conditioned = precondition(&residual);
        let next = dot(&residual, &conditioned);
        let ratio = next / product;
        product = next;
        for (d, c) in direction.iter_mut().zip(&conditioned) {
            for k in 0..4 {
                d[k] = c[k] + ratio * d[k];
            }
        }
    }
    solution
}

/// The least-squares fit of interpolated albedo and Schlick part to their values at all samples.
fn fit_amplitudes(fitted: &Fitted, samples: &[Sample]) -> Field {
    let start: Field = fitted.texels.iter().map(|texel| [texel.albedo, texel.fresnel, 0.0, 0.0]).collect();
    let models: Vec<Quadratic> = samples
        .iter()
        .map(|sample| {
            let [albedo, fresnel, ..] = interpolate(sample, &start);
            let mut hessian = [[0.0; 4]; 4];
            hessian[0][0] = 1.0;
            hessian[1][1] = 1.0;
            Quadratic {
                gradient: [albedo - sample.target.albedo, fresnel - sample.target.fresnel, 0.0, 0.0],
                hessian,
                loss: 0.0,
            }
        })
        .collect();
    let step = solve(samples, &models, fitted.settings.size);
    start
        .iter()
        .zip(step)
        .map(|(s, d)| [(s[0] - d[0]).clamp(0.0, 1.0), (s[1] - d[1]).clamp(0.0, 1.0), 0.0, 0.0])
        .collect()
}
