//! Errors over roughness and view.

use rayon::prelude::*;

use super::{Case, Effort, PARTS, parts, random_lights, true_value, values};
use crate::report::data::ErrorMap;
use crate::report::{Method, Region};

/// Seed of the lights, the same in every cell: what differs from cell to cell is the surface more than the lights.
pub const MAP_SEED: u64 = 2;

/// What a map covers and how finely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapSettings {
    /// Cells along each axis.
    pub cells: usize,
    /// Lights in each cell.
    pub lights: usize,
    /// What is covered.
    pub region: Region,
}

impl MapSettings {
    /// Cells over all roughness but what is below the shader's floor, and over all views but what is below 1° over the
    /// horizon, with as many lights as an effort allows for.
    pub fn new(effort: Effort) -> Self {
        let region = Region { roughness: (0.02, 1.0), cosine: (0.02, 1.0) };
        match effort {
            Effort::Quick => Self { cells: 12, lights: 10, region },
            Effort::Full => Self { cells: 16, lights: 64, region },
        }
    }
}

/// Lights in cells of roughness and view, with their true values. No cell knows of another one.
#[derive(Clone, Debug, PartialEq)]
pub struct MapSet {
    settings: MapSettings,
    /// Cell after cell, roughness fastest.
    cases: Vec<Vec<Case>>,
}

impl MapSet {
    /// Makes the lights and finds their true values.
    pub fn new(settings: MapSettings) -> Self {
        let MapSettings { cells, lights, region } = settings;
        let cases = (0..cells * cells).into_par_iter().map(|index| {
            let cell = |(low, high): (f64, f64), index: usize| {
                let at = |index: usize| low + (high - low) * index as f64 / cells as f64;
                (at(index), at(index + 1))
            };
            let region = Region {
                roughness: cell(region.roughness, index % cells),
                cosine: cell(region.cosine, index / cells),
            };
            let quads = random_lights(MAP_SEED, region, lights);
            quads.into_iter().map(|quad| Case { truth: true_value(&quad), quad }).collect()
        });
        Self { settings, cases: cases.collect() }
    }

    /// The maps of one method, one for each part.
    pub fn maps(&self, method: &dyn Method) -> Vec<ErrorMap> {
        let MapSettings { cells, region, .. } = self.settings;
        let middles = |(low, high): (f64, f64)| {
            (0..cells).map(|index| low + (high - low) * (index as f64 + 0.5) / cells as f64).collect()
        };
        let (roughness, cosine): (Vec<f64>, Vec<f64>) = (middles(region.roughness), middles(region.cosine));
        let errors: Vec<[f64; 4]> = self.cases.iter().map(|cases| cell_errors(method, cases)).collect();
        let name = method.info().name;
        PARTS
            .into_iter()
            .enumerate()
            .map(|(part, label)| ErrorMap {
                method: name.clone(),
                part: label,
                roughness: roughness.clone(),
                cosine: cosine.clone(),
                values: errors
                    .chunks(cells)
                    .map(|row| row.iter().map(|error| error[part]).collect())
                    .collect(),
            })
            .collect()
    }
}

/// Mean |error| over mean value of each part in one cell.
fn cell_errors(method: &dyn Method, cases: &[Case]) -> [f64; 4] {
    let found = values(method, cases);
    core::array::from_fn(|part| {
        let pairs = cases.iter().zip(&found);
        let (errors, truths) = pairs.fold((0.0, 0.0), |(errors, truths), (case, value)| {
            let truth = parts(case.truth)[part];
            (errors + (parts(*value)[part] - truth).abs(), truths + truth)
        });
        if truths > 0.0 { errors / truths } else { 0.0 }
    })
}
