//! One view of a BRDF: what it reflects into small cells of directions.

use core::f64::consts::PI;
use core::ops::Range;

use glam::{DVec2, DVec3};

use crate::brdf::{Brdf, Lambert, schlick};

/// Nodes along one side of half the hemisphere, and of the square of them that make a cell. What counts is the light
/// that a lobe takes from one cell or gives to another.
const NODES: usize = 40;
const BLOCK: usize = 2;

/// A direction of the upper hemisphere. Lobes and BRDF are symmetric about the plane of incidence, so `y` enters
/// through its square alone.
#[derive(Clone, Copy)]
pub(super) struct Node {
    pub x: f64,
    pub y2: f64,
    pub z: f64,
    /// The solid angle for which it stands.
    pub weight: f64,
    /// (1 − v·h)⁵.
    pub schlick: f64,
}

/// Neighbouring nodes.
pub(super) struct Cell {
    pub nodes: Range<usize>,
    /// ∫ f·cos over the cell.
    pub mass: f64,
    /// Its solid angle.
    pub angle: f64,
}

/// A view of a BRDF prepared for fitting.
pub(super) struct View {
    pub nodes: Vec<Node>,
    pub cells: Vec<Cell>,
    /// ∫ f·cos over the hemisphere.
    pub albedo: f64,
    /// ∫ f·cos·(1 − v·h)⁵ over the hemisphere.
    pub fresnel: f64,
}

impl View {
    /// Places nodes by the BRDF's own sampling over half the hemisphere and a quarter as many by the cosine, and
    /// weighs them by the balance heuristic (Veach 1997).
    pub fn new(brdf: &dyn Brdf, cosine: f64) -> Self {
        let view = DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine);
        let samplings: [(&dyn Brdf, usize); 2] = [(brdf, NODES), (&Lambert, NODES / 2)];
        let number = |count: usize| (count * (count / 2)) as f64;
        let density = |light: DVec3| number(NODES) * brdf.pdf(view, light) + number(NODES / 2) * light.z / PI;
        let place = |index: usize, count: usize| (index as f64 + 0.5) / count as f64;
        let mut all = Self { nodes: Vec::new(), cells: Vec::new(), albedo: 0.0, fresnel: 0.0 };
        for (sampling, count) in samplings {
            for block in 0..(count / BLOCK) * (count / 2 / BLOCK) {
                let (first, second) = (block % (count / BLOCK) * BLOCK, block / (count / BLOCK) * BLOCK);
                let start = all.nodes.len();
                let mut mass = 0.0;
                for inside in 0..BLOCK * BLOCK {
                    let random = DVec2::new(
                        place(first + inside % BLOCK, count),
                        0.5 * place(second + inside / BLOCK, count / 2),
                    );
                    let light = sampling.sample(view, random);
                    let density = if light.z > 0.0 { density(light) } else { 0.0 };
                    if density > 0.0 {
                        let node_mass = brdf.evaluate(view, light) * light.z / density;
                        mass += node_mass;
                        all.fresnel += node_mass * schlick(view, light);
                        all.nodes.push(Node {
                            x: light.x,
                            y2: light.y * light.y,
                            z: light.z,
                            weight: 1.0 / density,
                            schlick: schlick(view, light),
                        });
                    }
                }
                let nodes = start..all.nodes.len();
                let angle: f64 = all.nodes[nodes.clone()].iter().map(|node| node.weight).sum();
                if angle > 0.0 {
                    all.albedo += mass;
                    all.cells.push(Cell { nodes, mass, angle });
                }
            }
        }
        all
    }
}
