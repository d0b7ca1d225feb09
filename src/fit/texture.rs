//! The relation behind the include's look-up of textures.
//!
//! A lobe sees a rectangle as the clamped cosine sees a parallelogram in the lobe's space. The look-up replaces the
//! cosine by one sample of a blurred image, or two. How well that does for any image is best said in waves:
//! cos(πku)·cos(πlv) for all k and l make up every image, the blur of the pyramid only shrinks each of them, and what
//! the cosine leaves of one is an integral. The loss is the root mean square error over images whose waves have
//! powers in proportion to 1/(k² + l²), as those of photographs have, in units of the image's own deviation from its
//! mean.

use core::f64::consts::PI;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::shade::{LTC_LOOKUP, LookupConstants, LtcLookup, ltc_lookup_with};
use crate::texture::{LINEAR_VARIANCE, VARIANCE};

/// Waves along each axis.
const WAVES: usize = 9;

/// Texels along each axis of the pyramid that is fitted to, and its last level.
const TEXELS: f64 = 256.0;
const LAST_LEVEL: f64 = 8.0;

/// What the cosine of a lobe sees of a rectangle.
#[derive(Clone, Debug)]
pub struct Sight {
    /// Upper left corner and sides in the lobe's space.
    corner: DVec3,
    edge_u: DVec3,
    edge_v: DVec3,
    /// Direction of the vector form factor.
    toward: DVec3,
    /// Form factor: the light's share of the cosine's energy.
    coverage: f64,
    /// Means of the waves.
    waves: [[f64; WAVES]; WAVES],
}

impl Sight {
    /// A rectangle of the corners a, b, c and d, relative to the surface point in its frame, seen by the lobe to whose
    /// space `map` leads; the identity for diffuse light.
    pub fn new([a, b, _, d]: [DVec3; 4], map: &dyn Fn(DVec3) -> DVec3) -> Self {
        let sides = [d, b - a, a - d];
        let [corner, edge_u, edge_v] = sides.map(map);
        let mut waves = [[0.0; WAVES]; WAVES];
        let mut toward = DVec3::ZERO;
        integrate(sides.map(|side| side.z), [corner, edge_u, edge_v], &mut |at, weight, point| {
            let (along, down) = (wave(at.x), wave(at.y));
            for (row, along) in waves.iter_mut().zip(along) {
                for (sum, down) in row.iter_mut().zip(down) {
                    *sum += weight * along * down;
                }
            }
            toward += point * (weight / point.z);
        });
        let total = waves[0][0].max(f64::MIN_POSITIVE);
        Self {
            corner,
            edge_u,
            edge_v,
            toward: toward.normalize_or(DVec3::Z),
            coverage: total / PI,
            waves: waves.map(|row| row.map(|sum| sum / total)),
        }
    }

    /// The share of the lobe's energy that the rectangle covers, but for what a horizon cuts off the lobe.
    pub fn coverage(&self) -> f64 {
        self.coverage
    }

    /// Root mean square error of a look-up with one sample, or a pair.
    fn loss(&self, constants: &LookupConstants, pair: bool) -> f64 {
        let [corner, u, v] = [self.corner, self.edge_u, self.edge_v];
        let normal = u.cross(v);
        let lookup = ltc_lookup_with::<f64>(
            constants,
            self.toward,
            DVec3::new(u.z, v.z, self.toward.z),
            v.cross(corner),
            corner.cross(u),
            normal,
            corner.dot(normal),
            DVec2::splat(TEXELS),
            pair,
        );
        let left = blurred(&lookup);
        let (mut sum, mut scale) = (0.0, 0.0);
        for k in 0..WAVES {
            for l in 0..WAVES {
                if k + l == 0 {
                    continue;
                }
                let power = 1.0 / ((k * k + l * l) as f64);
                // The mean square of the wave itself.
                let square = if k > 0 && l > 0 { 0.25 } else { 0.5 };
                sum += power / square * (self.waves[k][l] - left[k][l]).powi(2);
                scale += power;
            }
        }
        (sum / scale).sqrt()
    }
}

/// cos(πkx) for all k.
fn wave(x: f64) -> [f64; WAVES] {
    core::array::from_fn(|k| (PI * k as f64 * x).cos())
}

/// What a look-up in the pyramid leaves of each wave.
fn blurred(lookup: &LtcLookup<f64>) -> [[f64; WAVES]; WAVES] {
    let (place, apart) = (lookup.place, lookup.apart);
    let level = lookup.level.clamp(0.0, LAST_LEVEL);
    // What one level leaves of a wave of the squared frequency k²; nothing at the last one.
    let shrink = |level: f64, square: f64| {
        let scale = level.exp2().powi(2);
        let variance = VARIANCE * (scale - 1.0) + LINEAR_VARIANCE * scale;
        let kept = (-0.5 * PI * PI * square * variance / (TEXELS * TEXELS)).exp();
        if level < LAST_LEVEL { kept } else { 0.0 }
    };
    let share = level - level.floor();
    let samples = [place + apart, place - apart].map(|at| at.clamp(DVec2::ZERO, DVec2::ONE));
    let waves = samples.map(|at| (wave(at.x), wave(at.y)));
    core::array::from_fn(|k| {
        core::array::from_fn(|l| {
            let square = (k * k + l * l) as f64;
            let kept =
                (1.0 - share) * shrink(level.floor(), square) + share * shrink(level.floor() + 1.0, square);
            0.5 * kept * waves.iter().map(|(along, down)| along[k] * down[l]).sum::<f64>()
        })
    })
}

/// Abscissae and weights of the Gauss rule of three points on 0…1.
const GAUSS: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

/// Integrates the clamped cosine over a parallelogram of the given corner and sides in the lobe's space, cut at both
/// horizons; `heights` are those of corner and sides over the surface. `visit` is told texture coordinates, weight
/// and point. Cells are halved until they are shorter than half their distance, and down to a hundredth across a horizon.
fn integrate(heights: [f64; 3], [corner, u, v]: [DVec3; 3], visit: &mut dyn FnMut(DVec2, f64, DVec3)) {
    let volume = corner.dot(u.cross(v)).abs();
    let mut cells = vec![(DVec2::ZERO, DVec2::ONE)];
    let surface = |at: DVec2| heights[0] + at.x * heights[1] + at.y * heights[2];
    let place = |at: DVec2| corner + u * at.x + v * at.y;
    while let Some((at, size)) = cells.pop() {
        let corners = [at, at + size * DVec2::X, at + size * DVec2::Y, at + size];
        let above = corners.iter().filter(|at| surface(**at) > 0.0).count();
        let in_lobe = corners.iter().filter(|at| place(**at).z > 0.0).count();
        if above == 0 || in_lobe == 0 {
            continue;
        }
        let (along, down) = (u.length() * size.x, v.length() * size.y);
        let cut = above.min(in_lobe) < 4 && size.max_element() > 0.01;
        let near = along.max(down) > 0.5 * place(at + 0.5 * size).length() && size.min_element() > 1e-5;
        if cut || near || size.max_element() > 0.26 {
            let half = if along > down { DVec2::new(0.5, 1.0) } else { DVec2::new(1.0, 0.5) };
            cells.push((at, size * half));
            cells.push((at + size * (DVec2::ONE - half), size * half));
            continue;
        }
        for (x, x_weight) in GAUSS {
            for (y, y_weight) in GAUSS {
                let at = at + size * DVec2::new(x, y);
                let point = place(at);
                if surface(at) > 0.0 && point.z > 0.0 {
                    let squared = point.length_squared();
                    let density = point.z * volume / (squared * squared);
                    visit(at, density * x_weight * y_weight * size.x * size.y, point);
                }
            }
        }
    }
}

/// Mean loss of look-ups, weighted by the light's share of the lobe: 1 is what the mean colour would cost at worst.
pub fn lookup_loss(constants: &LookupConstants, sights: &[Sight], pair: bool) -> f64 {
    let sums = sights.par_iter().map(|sight| [sight.coverage * sight.loss(constants, pair), sight.coverage]);
    let [loss, weight] = sums.reduce(|| [0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
    loss / weight
}

/// The constants of `ltc_lookup`, by a search along the axes from those of the include; the last two for pairs of
/// samples, given the others. Returns them with the loss of single samples and of pairs.
///
/// All of `sets` count alike, however many sights each has. The include's constants are the fit to those of
/// `softbox::report::lookup_sights` with 2000 of each, rounded.
pub fn fit_lookup(sets: &[Vec<Sight>]) -> (LookupConstants, [f64; 2]) {
    let loss = |numbers: &[f64; 8], pair: bool| {
        let constants = LookupConstants::from(*numbers);
        sets.iter().map(|set| lookup_loss(&constants, set, pair)).sum::<f64>() / sets.len() as f64
    };
    let start: [f64; 8] = LTC_LOOKUP.into();
    let (numbers, single) = search(start, 0..6, &|numbers| loss(numbers, false));
    let (numbers, pair) = search(numbers, 6..8, &|numbers| loss(numbers, true));
    (numbers.into(), [single, pair])
}

/// Coordinate search with steps that grow with success and shrink without.
fn search(
    mut at: [f64; 8],
    free: core::ops::Range<usize>,
    cost: &dyn Fn(&[f64; 8]) -> f64,
) -> ([f64; 8], f64) {
    let mut best = cost(&at);
    let mut steps = at.map(|number| (0.2 * number.abs()).max(0.05));
    for _ in 0..24 {
        for index in free.clone() {
            let tried = [steps[index], -steps[index]].map(|step| {
                let mut tried = at;
                tried[index] += step;
                (cost(&tried), tried, step)
            });
            let [up, down] = tried;
            let (lowest, there, step) = if up.0 < down.0 { up } else { down };
            if lowest < best {
                (best, at) = (lowest, there);
                steps[index] = 1.3 * step;
            } else {
                steps[index] *= 0.5;
            }
        }
    }
    (at, best)
}
