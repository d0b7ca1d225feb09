//! The worst settings that were found, as lines of JSON.

use serde::{Deserialize, Serialize};

use super::{Finding, RELATIONS, Relation, Setting};
use crate::stability::{Bound, CATALOGUE, Case, Shape};

/// A setting in which a relation took a large share of its tolerance, with that share as it was when it was kept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Kept {
    /// The relation's name.
    pub relation: String,
    /// The family that the case was made from.
    pub family: String,
    /// Seed of the relation's choices.
    pub seed: u64,
    /// The surface point.
    pub position: [f32; 3],
    /// The normal.
    pub normal: [f32; 3],
    /// Direction towards the eye.
    pub view: [f32; 3],
    /// Perceptual roughness.
    pub roughness: f32,
    /// The light.
    pub shape: Shape,
    /// The largest residual over its tolerance.
    pub share: f64,
}

impl Kept {
    /// What was found, as it is kept.
    pub fn of(finding: &Finding) -> Self {
        let Setting { case, seed } = &finding.setting;
        Self {
            relation: finding.relation.to_owned(),
            family: case.family.to_owned(),
            seed: *seed,
            position: case.position.into(),
            normal: case.normal.into(),
            view: case.view.into(),
            roughness: case.roughness,
            shape: case.shape.clone(),
            share: finding.share,
        }
    }

    /// Relation and setting.
    ///
    /// # Errors
    ///
    /// A sentence if relation or family does not exist.
    pub fn restore(&self) -> Result<(Relation, Setting), String> {
        let relation = RELATIONS.iter().find(|relation| relation.name == self.relation);
        let relation = relation.ok_or_else(|| format!("there is no relation {:?}", self.relation))?;
        let family = CATALOGUE.iter().find(|family| family.name == self.family);
        let family = family.ok_or_else(|| format!("there is no family {:?}", self.family))?;
        let case = Case {
            family: family.name,
            position: self.position.into(),
            normal: self.normal.into(),
            view: self.view.into(),
            roughness: self.roughness,
            shape: self.shape.clone(),
            bound: Bound::Physical,
            specular_bound: f64::INFINITY,
            form_factor: None,
        };
        Ok((*relation, Setting { case, seed: self.seed }))
    }
}
