//! Errors on random lights, as a whole and in strata.

use glam::DVec3;

use super::{Case, Effort, PARTS, cases, parts, random_lights, values};
use crate::report::data::{ErrorRow, Part};
use crate::report::{Method, Quad, Region};

/// Seed of the quads.
pub const QUAD_SEED: u64 = 1;

/// Seed of the triangles.
pub const TRIANGLE_SEED: u64 = 3;

/// Roughness and views of the lights.
pub const REGION: Region = Region { roughness: (0.1, 1.0), cosine: (0.05, 1.0) };

/// Lights to measure errors on, with their true values.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorSet {
    /// [`random_lights`] over the [`REGION`] with [`QUAD_SEED`]: rectangles.
    pub quads: Vec<Case>,
    /// The same with [`TRIANGLE_SEED`] and without the last corner, which repeats the third.
    pub triangles: Vec<Case>,
}

impl ErrorSet {
    /// As many lights as an effort allows for; the true value of one takes a fraction of a millisecond.
    pub fn new(effort: Effort) -> Self {
        match effort {
            Effort::Quick => Self::of(2000, 400),
            Effort::Full => Self::of(20_000, 4000),
        }
    }

    /// A number of quads and of triangles.
    pub fn of(quads: usize, triangles: usize) -> Self {
        // Half of a rectangle may be wholly below the horizon: one in twelve or so.
        let spare = random_lights(TRIANGLE_SEED, REGION, triangles + triangles / 4 + 8);
        let cut = spare.into_iter().filter_map(|quad| {
            let [a, b, c, _] = quad.corners;
            let lit = [a, b, c].iter().any(|corner| corner.z > 0.0);
            lit.then_some(Quad { corners: [a, b, c, c], ..quad })
        });
        Self {
            quads: cases(random_lights(QUAD_SEED, REGION, quads)),
            triangles: cases(cut.take(triangles).collect()),
        }
    }
}

/// A way to part lights.
#[derive(Clone, Copy, Debug)]
pub struct Stratum {
    /// By what, and the first word of the rows' names.
    pub name: &'static str,
    /// The classes, in the order of their bounds.
    pub classes: &'static [&'static str],
    /// Where classes end, in ascending order: a light with a measure of at least a bound belongs behind it.
    bounds: &'static [f64],
    /// What is compared with the bounds.
    measure: fn(&Quad) -> f64,
}

/// Ways to part lights; each puts every light into one class. Solid angles are those of whole lights, aspects those of
/// the longer to the shorter side.
pub const STRATA: [Stratum; 5] = [
    Stratum {
        name: "roughness",
        classes: &["0.1-0.3", "0.3-0.6", "0.6-1"],
        bounds: &[0.3, 0.6],
        measure: |quad| quad.roughness,
    },
    Stratum {
        name: "view",
        classes: &["0.05-0.3", "0.3-0.6", "0.6-1"],
        bounds: &[0.3, 0.6],
        measure: |quad| quad.view.z,
    },
    Stratum {
        name: "size",
        classes: &["below 0.05 sr", "0.05-0.5 sr", "above 0.5 sr"],
        bounds: &[0.05, 0.5],
        measure: |quad| solid_angle(&quad.corners),
    },
    Stratum {
        name: "aspect",
        classes: &["1-2", "2-5", "above 5"],
        bounds: &[2.0, 5.0],
        measure: |quad| {
            let [a, b, c, _] = quad.corners;
            let [x, y] = [(b - a).length(), (c - b).length()];
            x.max(y) / x.min(y)
        },
    },
    Stratum {
        name: "horizon",
        classes: &["above", "straddling"],
        bounds: &[0.5],
        measure: |quad| if quad.corners.iter().all(|corner| corner.z > 0.0) { 0.0 } else { 1.0 },
    },
];

impl Stratum {
    /// The index of a light's class.
    pub fn class(&self, quad: &Quad) -> usize {
        let measure = (self.measure)(quad);
        self.bounds.iter().filter(|bound| measure >= **bound).count()
    }
}

/// Solid angle of a quad, seen from the origin, by two triangles (van Oosterom and Strackee 1983, "The Solid Angle of a
/// Plane Triangle", equation 8).
pub fn solid_angle(corners: &[DVec3; 4]) -> f64 {
    let [a, b, c, d] = corners.map(DVec3::normalize);
    let triangle = |a: DVec3, b: DVec3, c: DVec3| {
        let volume = a.dot(b.cross(c)).abs();
        2.0 * volume.atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
    };
    triangle(a, b, c) + triangle(a, c, d)
}

/// The row of one part over pairs of a value and the truth.
pub fn error_row(method: &str, part: Part, stratum: &str, pairs: &[(f64, f64)]) -> ErrorRow {
    let count = pairs.len();
    let share = 1.0 / count.max(1) as f64;
    let mean = share * pairs.iter().map(|(_, truth)| truth).sum::<f64>();
    let unit = if mean > 0.0 { mean } else { 1.0 };
    let mut errors: Vec<f64> = pairs.iter().map(|(value, truth)| (value - truth).abs() / unit).collect();
    errors.sort_unstable_by(f64::total_cmp);
    let ranked = |index: usize| errors.get(index).copied().unwrap_or(0.0);
    ErrorRow {
        method: method.to_owned(),
        part,
        stratum: stratum.to_owned(),
        count,
        mean: share * errors.iter().sum::<f64>(),
        percentile: ranked(count * 99 / 100),
        maximum: ranked(count.saturating_sub(1)),
        bias: share * pairs.iter().map(|(value, truth)| (value - truth) / unit).sum::<f64>(),
    }
}

/// Errors of methods: over all quads, in each class of the [`STRATA`], and over the triangles, for each part.
pub fn error_rows(methods: &[&dyn Method], set: &ErrorSet) -> Vec<ErrorRow> {
    let mut rows = Vec::new();
    for method in methods {
        let name = method.info().name;
        let found = values(*method, &set.quads);
        let mut add = |stratum: &str, cases: &[Case], found: &[[f64; 3]], belongs: &dyn Fn(&Quad) -> bool| {
            for (index, part) in PARTS.into_iter().enumerate() {
                let pairs: Vec<(f64, f64)> = cases
                    .iter()
                    .zip(found)
                    .filter(|(case, _)| belongs(&case.quad))
                    .map(|(case, value)| (parts(*value)[index], parts(case.truth)[index]))
                    .collect();
                rows.push(error_row(&name, part, stratum, &pairs));
            }
        };
        add("all", &set.quads, &found, &|_| true);
        for stratum in &STRATA {
            for (class, label) in stratum.classes.iter().enumerate() {
                let label = format!("{} {label}", stratum.name);
                add(&label, &set.quads, &found, &|quad| stratum.class(quad) == class);
            }
        }
        let found = values(*method, &set.triangles);
        add("triangles", &set.triangles, &found, &|_| true);
    }
    rows
}
