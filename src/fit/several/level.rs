//! The fit of all texels of one table together.

use rayon::prelude::*;

use super::field::{Field, Place, Smoothness, step};
use super::sum::{Cut, Quadratic, quadratic};
use super::view::View;
use super::{Family, LAYOUT, decode};
use crate::lobe::Lobe;

/// Weight of the second differences of the shapes' numbers in a table of 64² texels, where a wholly wrong view costs
/// about 1, and of those of the lobes' weights. It decides what the loss leaves open: how two lobes share what each of
/// them could do, and the shape of one that has no weight. A thousandth of it gave
/// about the same mean error of light integrals, with lobes that change far less evenly. For two lobes the error
/// depends on where the fit starts more than on this.
const SMOOTHNESS: [f64; 2] = [1e-2, 1e-1];

/// The same of first differences, relative to that: so that what nothing else decides stays as it is next to it.
const SLOPE: f64 = 1e-3;

/// The least part of the albedo that a lobe may have, so that there is something that fits its shape.
const LEAST_WEIGHT: f64 = 1e-3;

/// The least fourth number of a shape. The sharpest lobes have 1 along the normal and 2 at grazing views.
const LEAST_WIDTH: f64 = 0.25;

/// How much rows of texels count whatever their view: others by the root of its cosine, as their views are uniform in
/// it.
const GRAZING: f64 = 0.05;

/// Gain at which a fit ends, relative to the loss.
const LEAST_GAIN: f64 = 1e-4;

/// A table of some size with the places to compare at, and the BRDF there.
pub(super) struct Level {
    pub size: usize,
    /// The texels come first.
    pub places: Vec<Place>,
    pub views: Vec<View>,
    /// (albedo, Schlick part) of the texels, so that the interpolated ones fit.
    pub amplitudes: Field<2>,
}

impl Level {
    /// `centres` says whether to compare between texels, too.
    pub fn new(family: &dyn Family, size: usize, centres: bool) -> Self {
        let last = (size - 1) as f64;
        let place = |corners: [usize; 4], weights: [f64; 4], column: f64, row: f64| Place {
            corners,
            weights,
            alpha: LAYOUT.alpha(column / last),
            cosine: LAYOUT.cosine(row / last),
        };
        let mut places = Vec::new();
        for index in 0..size * size {
            let (column, row) = (index % size, index / size);
            places.push(place([index; 4], [1.0, 0.0, 0.0, 0.0], column as f64, row as f64));
        }
        for index in 0..if centres { (size - 1) * (size - 1) } else { 0 } {
            let (column, row) = (index % (size - 1), index / (size - 1));
            let first = column + row * size;
            let corners = [first, first + 1, first + size, first + size + 1];
            places.push(place(corners, [0.25; 4], column as f64 + 0.5, row as f64 + 0.5));
        }
        let view = |place: &Place| View::new(family.at(place.alpha.sqrt()).as_ref(), place.cosine);
        let views = places.par_iter().map(view).collect();
        let mut level = Self { size, places, views, amplitudes: Vec::new() };
        level.amplitudes = level.fit_amplitudes();
        level
    }

    /// The least-squares fit of interpolated albedo and Schlick part to their values at all places.
    fn fit_amplitudes(&self) -> Field<2> {
        let texels = &self.views[..self.size * self.size];
        let start: Field<2> = texels.iter().map(|view| [view.albedo, view.fresnel]).collect();
        let models: Vec<Quadratic<2>> = self
            .places
            .iter()
            .zip(&self.views)
            .map(|(place, view)| {
                let [albedo, fresnel] = place.interpolate(&start);
                let gradient = [albedo - view.albedo, fresnel - view.fresnel];
                Quadratic { loss: 0.0, gradient, hessian: [[1.0, 0.0], [0.0, 1.0]] }
            })
            .collect();
        let free = Smoothness { size: self.size, weights: [0.0; 2], slope: 0.0 };
        let step = step(&self.places, &models, &free, &start, &vec![0.0; start.len()]);
        start
            .iter()
            .zip(step)
            .map(|(s, d)| [(s[0] - d[0]).clamp(0.0, 1.0), (s[1] - d[1]).clamp(0.0, 1.0)])
            .collect()
    }

    /// Moves `field` to where the loss is least, by Levenberg's and Marquardt's method with a damping for each texel.
    /// `advance` is told how many places were compared.
    pub fn fit<const N: usize, const D: usize>(
        &self,
        mut field: Field<D>,
        steps: usize,
        advance: &(dyn Fn(usize) + Sync),
    ) -> Field<D> {
        // In a coarser table the same function has larger differences, and there are fewer.
        let finer = (self.size as f64 / 64.0).powi(3).max(1e-3);
        let smoothness = Smoothness {
            size: self.size,
            weights: core::array::from_fn(|k| finer * SMOOTHNESS[usize::from(k % 5 == 4)]),
            slope: SLOPE,
        };
        let total = |models: &[Quadratic<D>], field: &Field<D>| {
            models.iter().map(|model| model.loss).sum::<f64>() + smoothness.loss(field)
        };
        field.iter_mut().enumerate().for_each(|(texel, numbers)| self.round::<N, D>(texel, numbers));
        let indices = 0..self.places.len();
        let mut damping = vec![1e-2; field.len()];
        let mut models: Vec<_> =
            indices.clone().into_par_iter().map(|i| self.model::<N, D>(i, &field)).collect();
        let mut loss = total(&models, &field);
        for _ in 0..steps {
            let step = step(&self.places, &models, &smoothness, &field, &damping);
            let mut trial: Field<D> = (0..field.len())
                .map(|texel| self.moved::<N, D>(texel, &field[texel], &step[texel]))
                .collect();
            let mut trial_models: Vec<_> =
                indices.clone().into_par_iter().map(|i| self.model::<N, D>(i, &trial)).collect();
            // Each texel learns from the places around it whether it went too far, and then stays.
            let mut change = vec![0.0; field.len()];
            for (place, (old, new)) in self.places.iter().zip(models.iter().zip(&trial_models)) {
                for corner in 0..4 {
                    change[place.corners[corner]] += place.weights[corner] * (new.loss - old.loss);
                }
            }
            let worse: Vec<bool> = change.iter().map(|change| *change > 0.0).collect();
            for texel in (0..field.len()).filter(|texel| worse[*texel]) {
                trial[texel] = field[texel];
            }
            trial_models.par_iter_mut().enumerate().for_each(|(i, model)| {
                if self.places[i].corners.iter().any(|texel| worse[*texel]) {
                    *model = self.model::<N, D>(i, &trial);
                }
            });
            advance(self.places.len());
            let trial_loss = total(&trial_models, &trial);
            let better = trial_loss < loss;
            for (damping, worse) in damping.iter_mut().zip(worse) {
                let factor = if worse { 6.0 } else { 0.3 } * if better { 1.0 } else { 4.0 };
                *damping = (*damping * factor).clamp(1e-6, 1e6);
            }
            if better {
                let gain = (loss - trial_loss) / loss;
                (field, models, loss) = (trial, trial_models, trial_loss);
                if gain < LEAST_GAIN {
                    break;
                }
            }
        }
        field
    }

    fn model<const N: usize, const D: usize>(&self, index: usize, field: &Field<D>) -> Quadratic<D> {
        let place = &self.places[index];
        let [albedo, _] = place.interpolate(&self.amplitudes);
        let (shapes, weights) = separate::<N, D>(&place.interpolate(field), albedo);
        let lobes = shapes.map(|shape| decode(LAYOUT, &shape, place.alpha, place.cosine));
        let (_, scale) = LAYOUT.affine(place.alpha, place.cosine);
        quadratic(&self.views[index], &lobes, &weights, &scale).times(place.cosine.sqrt() + GRAZING)
    }

    fn lobes<const N: usize, const D: usize>(&self, texel: usize, numbers: &[f64; D]) -> [Lobe; N] {
        let Place { alpha, cosine, .. } = self.places[texel];
        separate::<N, D>(numbers, 0.0).0.map(|shape| decode(LAYOUT, &shape, alpha, cosine))
    }

    /// Keeps all weights and widths positive, and gives texels whose numbers describe no lobes the single one.
    pub fn mend<const N: usize, const D: usize>(&self, field: &mut Field<D>, single: &Field<4>) {
        for (texel, numbers) in field.iter_mut().enumerate() {
            limit::<N, D>(numbers, self.amplitudes[texel][0]);
            if self.lobes::<N, D>(texel, numbers).iter().any(|lobe| Cut::new(*lobe).is_none()) {
                for i in 0..N {
                    numbers[5 * i..5 * i + 4].copy_from_slice(&single[texel]);
                }
            }
        }
    }

    /// Makes lobes round where the view is along the normal: there the azimuth of the view means nothing, and light must
    /// not depend on it.
    fn round<const N: usize, const D: usize>(&self, texel: usize, numbers: &mut [f64; D]) {
        if texel / self.size == self.size - 1 {
            for i in 0..N {
                numbers[5 * i] = 0.0;
            }
        }
    }

    /// A texel's numbers less a step, of which only as much is taken as keeps lobes alike.
    fn moved<const N: usize, const D: usize>(
        &self,
        texel: usize,
        from: &[f64; D],
        step: &[f64; D],
    ) -> [f64; D] {
        let old = self.lobes::<N, D>(texel, from);
        let alike = |old: &Lobe, new: &Lobe| {
            let close = |old: f64, new: f64| new > 0.3 * old && new < 4.0 * old;
            let determinants = close(old.determinant(), new.determinant());
            close(old.x, new.x) && close(old.w, new.w) && determinants && Cut::new(*new).is_some()
        };
        let mut factor = 1.0;
        while factor > 1e-4 {
            let mut numbers: [f64; D] = core::array::from_fn(|k| from[k] - factor * step[k]);
            limit::<N, D>(&mut numbers, self.amplitudes[texel][0]);
            self.round::<N, D>(texel, &mut numbers);
            let new = self.lobes::<N, D>(texel, &numbers);
            if old.iter().zip(&new).all(|(old, new)| alike(old, new)) {
                return numbers;
            }
            factor *= 0.6;
        }
        *from
    }
}

/// The shapes and the weights of N lobes from the numbers of a field.
pub(super) fn separate<const N: usize, const D: usize>(
    numbers: &[f64; D],
    albedo: f64,
) -> ([[f64; 4]; N], [f64; N]) {
    let shapes = core::array::from_fn(|i| core::array::from_fn(|k| numbers[5 * i + k]));
    let mut weights = core::array::from_fn(|i| if i + 1 < N { numbers[5 * i + 4] } else { 0.0 });
    weights[N - 1] = albedo - weights.iter().sum::<f64>();
    (shapes, weights)
}

/// Keeps all weights and widths positive.
fn limit<const N: usize, const D: usize>(numbers: &mut [f64; D], albedo: f64) {
    let mut sum = 0.0;
    for i in 0..N {
        numbers[5 * i + 3] = numbers[5 * i + 3].max(LEAST_WIDTH);
        if i + 1 < N {
            numbers[5 * i + 4] = numbers[5 * i + 4].max(LEAST_WEIGHT * albedo);
            sum += numbers[5 * i + 4];
        }
    }
    let excess = sum / ((1.0 - LEAST_WEIGHT) * albedo).max(f64::MIN_POSITIVE);
    if excess > 1.0 {
        for i in 0..N - 1 {
            numbers[5 * i + 4] /= excess;
        }
    }
}
