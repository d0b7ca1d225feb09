//! The families of hard cases.

mod bits;
mod catalogue;
mod disks;
mod flat;
mod further;
mod quads;
mod tubes;

use glam::{DVec3, Vec3};

use super::random::Random;
use super::{Bound, Case, Shape};

/// A family of hard cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Family {
    /// Its name, as in [`Case::family`].
    pub name: &'static str,
    /// What is hard about it, and what goes wrong there in other code.
    pub about: &'static str,
    /// Where it has been met.
    pub met: &'static str,
}

pub use catalogue::CATALOGUE;
pub(super) use tubes::bounds as tube_bounds;

type Axes = [DVec3; 3];

const STANDARD: Axes = [DVec3::X, DVec3::Y, DVec3::Z];

/// An orthonormal frame with the given third axis.
fn frame(normal: DVec3) -> Axes {
    let (tangent, bitangent) = normal.any_orthonormal_pair();
    [tangent, bitangent, normal]
}

fn place(axes: &Axes, v: DVec3) -> DVec3 {
    axes[0] * v.x + axes[1] * v.y + axes[2] * v.z
}

/// The corners of a parallelogram, counter-clockwise seen from `facing`.
fn parallelogram(centre: DVec3, x: DVec3, y: DVec3, facing: DVec3) -> [DVec3; 4] {
    let (x, y) = if x.cross(y).dot(facing) >= 0.0 { (x, y) } else { (y, x) };
    [centre - x - y, centre + x - y, centre + x + y, centre - x + y]
}

/// F of a rectangle that stands on the surface with a lower corner at the foot of the
/// perpendicular: width along the surface, height over it, gap between point and rectangle
/// (Hamilton and Morgan 1952; Howell's catalogue, B-4).
pub fn perpendicular(width: f64, height: f64, gap: f64) -> f64 {
    let hypotenuse = (height * height + gap * gap).sqrt();
    ((width / gap).atan() - gap / hypotenuse * (width / hypotenuse).atan()) / core::f64::consts::TAU
}

/// The largest ratio, over all edges, of the farther end's distance to the edge's own.
fn edge_ratio(points: &[DVec3]) -> f64 {
    let edges = points.iter().zip(points.iter().cycle().skip(1));
    let ratio = |(a, b): (&DVec3, &DVec3)| {
        let along = (b - a).normalize_or_zero();
        let nearest = a - along * a.dot(along).clamp(-(b - a).length(), 0.0);
        a.length().max(b.length()) / nearest.length()
    };
    edges.map(ratio).fold(1.0, f64::max)
}

struct Builder {
    random: Random,
    cases: Vec<Case>,
}

impl Builder {
    /// An axis-aligned frame, where rounding does not turn the surface, or any other.
    fn axes(&mut self) -> Axes {
        if self.random.index(2) == 0 { STANDARD } else { frame(self.random.direction()) }
    }

    /// Roughness with its ends and the floor's surroundings among the ordinary values.
    fn roughness(&mut self) -> f32 {
        match self.random.index(10) {
            0 => 0.0,
            1 => 1.0,
            2 => self.random.log(1e-4, 0.1) as f32,
            _ => self.random.unit() as f32,
        }
    }

    /// A view with the exact normal, its neighbourhood, the horizon and directions below it among the ordinary ones.
    fn view(&mut self, axes: &Axes) -> Vec3 {
        let around = self.random.direction();
        let local = match self.random.index(10) {
            0 => DVec3::Z,
            1 => DVec3::Z + around * self.random.log(1e-8, 1e-2),
            2 => DVec3::new(around.x, around.y, around.z * self.random.log(1e-8, 1e-2)),
            3 => DVec3::new(around.x, around.y, -around.z.abs()),
            _ => self.random.upper(),
        };
        (place(axes, local) * self.random.log(0.1, 10.0)).as_vec3()
    }

    /// A case on any surface with the given frame; its specular bound is none yet.
    fn case(
        &mut self,
        family: &'static str,
        axes: &Axes,
        position: DVec3,
        shape: Shape,
        bound: Bound,
    ) -> Case {
        let view = self.view(axes);
        let roughness = self.roughness();
        Case {
            family,
            position: position.as_vec3(),
            normal: (axes[2] * self.random.log(0.1, 10.0)).as_vec3(),
            view,
            roughness,
            shape,
            bound,
            specular_bound: f64::INFINITY,
            form_factor: None,
        }
    }

    /// A finite number, vectors that are not zero.
    fn nonzero(&mut self) -> Vec3 {
        let vector = Vec3::new(self.random.finite(), self.random.finite(), self.random.finite());
        if vector == Vec3::ZERO { Vec3::Z } else { vector }
    }
}

/// Inputs of all families, about `scale` × 3200 of them, the same ones on every run.
pub fn cases(scale: usize) -> Vec<Case> {
    cases_of(0, scale)
}

/// Other inputs of all families for every seed.
pub fn cases_of(seed: u64, scale: usize) -> Vec<Case> {
    let mut builder = Builder { random: Random::new(0x50F7_B0C5 ^ (seed << 32)), cases: Vec::new() };
    builder.quads(scale);
    builder.flat(scale);
    builder.disks(scale);
    builder.tubes(scale);
    builder.further(scale);
    builder.bits(scale);
    builder.cases
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn the_catalogue_names_every_family_once() {
        let named: Vec<&str> = CATALOGUE.iter().map(|family| family.name).collect();
        let made: BTreeSet<&str> = cases(3).iter().map(|case| case.family).collect();
        assert_eq!(named.iter().copied().collect::<BTreeSet<_>>(), made);
        assert_eq!(named.len(), made.len(), "a family stands twice in the catalogue");
    }
}
