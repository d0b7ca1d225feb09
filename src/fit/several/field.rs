//! Tables of numbers and the equations for them.

use super::sum::Quadratic;

/// D numbers for each texel.
pub(super) type Field<const D: usize> = Vec<[f64; D]>;

/// A place where interpolated texels are compared with a BRDF: four texels and their weights.
pub(super) struct Place {
    pub corners: [usize; 4],
    pub weights: [f64; 4],
    pub alpha: f64,
    pub cosine: f64,
}

impl Place {
    pub fn interpolate<const D: usize>(&self, field: &Field<D>) -> [f64; D] {
        core::array::from_fn(|k| {
            (0..4).map(|corner| self.weights[corner] * field[self.corners[corner]][k]).sum()
        })
    }
}

/// The same function on another number of texels along each axis.
pub(super) fn resample<const D: usize>(field: &Field<D>, from: usize, to: usize) -> Field<D> {
    let place = |index: usize| {
        let position = index as f64 * (from - 1) as f64 / (to - 1) as f64;
        let cell = (position as usize).min(from - 2);
        (cell, position - cell as f64)
    };
    let texel = |index: usize| {
        let ((column, right), (row, down)) = (place(index % to), place(index / to));
        let first = column + row * from;
        let corners = [first, first + 1, first + from, first + from + 1];
        let weights =
            [(1.0 - right) * (1.0 - down), right * (1.0 - down), (1.0 - right) * down, right * down];
        Place { corners, weights, alpha: 0.0, cosine: 0.0 }.interpolate(field)
    };
    (0..to * to).map(texel).collect()
}

/// A penalty on rough fields: the squares of the second differences along both axes, times `weights`, and those of
/// the first ones, times `slope` of that.
pub(super) struct Smoothness<const D: usize> {
    pub size: usize,
    pub weights: [f64; D],
    pub slope: f64,
}

impl<const D: usize> Smoothness<D> {
    /// Half the gradient at `field`, which is linear in it.
    pub fn gradient(&self, field: &Field<D>) -> Field<D> {
        let mut gradient = vec![[0.0; D]; field.len()];
        self.lines(|a, b, c| {
            for k in 0..D {
                let w = self.weights[k];
                if let Some(c) = c {
                    let second = w * (field[a][k] - 2.0 * field[b][k] + field[c][k]);
                    gradient[a][k] += second;
                    gradient[b][k] -= 2.0 * second;
                    gradient[c][k] += second;
                }
                let first = self.slope * w * (field[b][k] - field[a][k]);
                gradient[b][k] += first;
                gradient[a][k] -= first;
            }
        });
        gradient
    }

    pub fn loss(&self, field: &Field<D>) -> f64 {
        let gradient = self.gradient(field);
        field.iter().zip(&gradient).map(|(f, g)| (0..D).map(|k| f[k] * g[k]).sum::<f64>()).sum()
    }

    /// Calls `each` with every texel, its successor and, where there is one, the one after, along both axes.
    fn lines(&self, mut each: impl FnMut(usize, usize, Option<usize>)) {
        let size = self.size;
        for line in 0..size {
            for (first, stride) in [(line * size, 1), (line, size)] {
                for i in 0..size - 1 {
                    let a = first + i * stride;
                    each(a, a + stride, (i + 2 < size).then_some(a + 2 * stride));
                }
            }
        }
    }
}

/// Share of a number's mean curvature over the table that a damping counts on where the number has none.
const LEAST_CURVATURE: f64 = 1e-3;

/// The step that the quadratic models of all places and the smoothness ask for, with a damping for each texel
/// relative to its own curvature, by conjugate gradients. The field's new value is the old one less the step.
pub(super) fn step<const D: usize>(
    places: &[Place],
    models: &[Quadratic<D>],
    smoothness: &Smoothness<D>,
    field: &Field<D>,
    damping: &[f64],
) -> Field<D> {
    let mut right = smoothness.gradient(field);
    let mut blocks = vec![[[0.0; D]; D]; field.len()];
    for (place, model) in places.iter().zip(models) {
        for corner in 0..4 {
            let (weight, texel) = (place.weights[corner], place.corners[corner]);
            if weight == 0.0 {
                continue;
            }
            for i in 0..D {
                right[texel][i] += weight * model.gradient[i];
                for j in 0..D {
                    blocks[texel][i][j] += weight * weight * model.hessian[i][j];
                }
            }
        }
    }
    let mean: [f64; D] =
        core::array::from_fn(|k| blocks.iter().map(|block| block[k][k]).sum::<f64>() / blocks.len() as f64);
    let extra: Field<D> = blocks
        .iter()
        .zip(damping)
        .map(|(block, damping)| core::array::from_fn(|k| damping * (block[k][k] + LEAST_CURVATURE * mean[k])))
        .collect();
    for (block, extra) in blocks.iter_mut().zip(&extra) {
        for k in 0..D {
            // The second differences along two axes, of which three hold a texel.
            block[k][k] += extra[k] + 12.0 * smoothness.weights[k];
        }
        factorise(block);
    }
    let apply = |x: &Field<D>| -> Field<D> {
        let mut y = smoothness.gradient(x);
        for (place, model) in places.iter().zip(models) {
            let p = place.interpolate(x);
            for i in 0..D {
                let h: f64 = (0..D).map(|j| model.hessian[i][j] * p[j]).sum();
                for corner in 0..4 {
                    y[place.corners[corner]][i] += place.weights[corner] * h;
                }
            }
        }
        for ((y, x), extra) in y.iter_mut().zip(x).zip(&extra) {
            for k in 0..D {
                y[k] += extra[k] * x[k];
            }
        }
        y
    };
    conjugate_gradients(apply, right, &blocks)
}

fn conjugate_gradients<const D: usize>(
    apply: impl Fn(&Field<D>) -> Field<D>,
    right: Field<D>,
    blocks: &[[[f64; D]; D]],
) -> Field<D> {
    let dot = |a: &Field<D>, b: &Field<D>| -> f64 {
        a.iter().zip(b).map(|(a, b)| (0..D).map(|k| a[k] * b[k]).sum::<f64>()).sum()
    };
    let precondition =
        |r: &Field<D>| -> Field<D> { r.iter().zip(blocks).map(|(r, b)| substitute(b, *r)).collect() };
    let mut solution = vec![[0.0; D]; right.len()];
    let mut residual = right;
    let mut conditioned = precondition(&residual);
    let mut direction = conditioned.clone();
    let mut product = dot(&residual, &conditioned);
    let goal = product * 1e-8;
    for _ in 0..100 {
        if product <= goal {
            break;
        }
        let image = apply(&direction);
        let length = product / dot(&direction, &image);
        for i in 0..solution.len() {
            for k in 0..D {
                solution[i][k] += length * direction[i][k];
                residual[i][k] -= length * image[i][k];
            }
        }
        conditioned = precondition(&residual);
        let next = dot(&residual, &conditioned);
        let ratio = next / product;
        product = next;
        for (d, c) in direction.iter_mut().zip(&conditioned) {
            for k in 0..D {
                d[k] = c[k] + ratio * d[k];
            }
        }
    }
    solution
}

/// Cholesky's factor of a symmetric positive definite matrix, in its lower half.
fn factorise<const D: usize>(a: &mut [[f64; D]; D]) {
    for i in 0..D {
        for j in 0..=i {
            let mut sum = a[i][j];
            for k in 0..j {
                sum -= a[i][k] * a[j][k];
            }
            a[i][j] = if i == j { sum.max(1e-300).sqrt() } else { sum / a[j][j] };
        }
    }
}

/// Solves for `b` with that factor.
fn substitute<const D: usize>(a: &[[f64; D]; D], mut b: [f64; D]) -> [f64; D] {
    for i in 0..D {
        for k in 0..i {
            b[i] -= a[i][k] * b[k];
        }
        b[i] /= a[i][i];
    }
    for i in (0..D).rev() {
        for k in i + 1..D {
            b[i] -= a[k][i] * b[k];
        }
        b[i] /= a[i][i];
    }
    b
}
