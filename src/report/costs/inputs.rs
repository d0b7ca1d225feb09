//! What methods are measured on.

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};

use crate::device::EvaluateSurface;
use crate::report::{Quad, REGIONS, random_quads};

/// A surface point and a quad as kernels read them.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Input {
    /// The point.
    pub surface: EvaluateSurface,
    /// The quad's corners; the fourth number of each is not used.
    pub corners: [[f32; 4]; 4],
}

impl Input {
    /// A point with its normal, the position of the eye, and a quad.
    pub fn new(position: DVec3, normal: DVec3, eye: DVec3, roughness: f64, corners: [DVec3; 4]) -> Self {
        let surface = EvaluateSurface {
            position: position.as_vec3().to_array(),
            roughness: roughness as f32,
            normal: normal.as_vec3().to_array(),
            view: (eye - position).normalize().as_vec3().to_array(),
            ..EvaluateSurface::default()
        };
        Self { surface, corners: corners.map(|corner| corner.as_vec3().extend(0.0).to_array()) }
    }

    /// The corners seen from the surface point.
    pub fn seen(&self) -> [Vec3; 4] {
        self.corners.map(|c| Vec3::new(c[0], c[1], c[2]) - Vec3::from(self.surface.position))
    }
}

impl From<&Quad> for Input {
    fn from(quad: &Quad) -> Self {
        Self::new(DVec3::ZERO, DVec3::Z, quad.view, quad.roughness, quad.corners)
    }
}

/// The buffers of bindings 0 and 1 for some inputs.
pub fn buffers(inputs: &[Input]) -> (Vec<u8>, Vec<u8>) {
    let surfaces: Vec<EvaluateSurface> = inputs.iter().map(|input| input.surface).collect();
    let quads: Vec<[[f32; 4]; 4]> = inputs.iter().map(|input| input.corners).collect();
    (bytemuck::cast_slice(&surfaces).to_vec(), bytemuck::cast_slice(&quads).to_vec())
}

/// A rectangle of the given half-sizes around a point, facing the origin, one pair of sides horizontal.
fn rectangle(centre: DVec3, half_width: f64, half_height: f64) -> [DVec3; 4] {
    let facing = -centre.normalize();
    let x = DVec3::Z.cross(facing).normalize() * half_width;
    let y = facing.cross(x).normalize() * half_height;
    [centre - x - y, centre + x - y, centre + x + y, centre - x + y]
}

/// One input for each way that a light can lie to the two horizons, by name, for a surface of roughness 0.4 seen at
/// 60 degrees.
pub fn named() -> Vec<(&'static str, Input)> {
    let view = DVec3::new(0.75_f64.sqrt(), 0.0, 0.5);
    let mirror = DVec3::new(-view.x, 0.0, view.z);
    let input = |corners| Input::new(DVec3::ZERO, DVec3::Z, view, 0.4, corners);
    let near = rectangle(mirror * 1.5, 0.5, 0.5);
    let mut behind = near;
    behind.reverse();
    vec![
        ("near", input(near)),
        ("distant", input(rectangle(mirror * 30.0, 0.5, 0.5))),
        ("surface cut", input(rectangle(DVec3::new(-1.2, 0.0, 0.1), 0.4, 0.3))),
        ("lobe cut", input(rectangle(DVec3::new(1.2, 0.2, 0.5), 0.5, 0.3))),
        ("both cut", input(rectangle(DVec3::new(0.4, 1.0, 0.2), 0.9, 0.6))),
        ("behind", input(behind)),
    ]
}

/// `count` random quads, evenly over the strata of roughness and view of [`REGIONS`].
pub fn random(count: usize) -> Vec<Input> {
    let each = count.div_ceil(REGIONS.len());
    let strata: Vec<Vec<Quad>> = REGIONS.iter().map(|region| random_quads(*region, each)).collect();
    let quads = (0..each).flat_map(|at| strata.iter().map(move |stratum| &stratum[at]));
    quads.take(count).map(Input::from).collect()
}

/// Invocations of a wave.
pub const WAVE: usize = 32;

/// Waves of 8 × 4 neighbouring pixels, as a renderer runs them: `across` by `across` of them spread over a picture of a
/// floor with a rectangle that stands over it and one that dips into it.
pub fn waves(across: usize) -> Vec<Vec<Input>> {
    let eye = DVec3::new(0.0, -3.0, 1.6);
    let [width, height] = [640.0, 360.0];
    let over = [(-1.2, 0.3), (0.4, 0.3), (0.4, 1.4), (-1.2, 1.4)].map(|(x, z)| DVec3::new(x, 1.5, z));
    let dipping =
        [(-0.5, -0.4), (1.3, -0.4), (1.3, 0.9), (-0.5, 0.9)].map(|(x, z)| DVec3::new(x, 1.0 - 0.3 * z, z));
    let mut waves = Vec::new();
    for light in [over, dipping] {
        for place in 0..across * across {
            let [column, row] = [place % across, place / across].map(|at| (at as f64 + 0.5) / across as f64);
            let pixels = (0..WAVE).map(|at| {
                let x = (column * width).floor() + (at % 8) as f64 + 0.5;
                let y = (row * height).floor() + (at / 8) as f64 + 0.5;
                // The eye looks down at the floor; a pixel is 1 / height wide at a distance of 1.
                let ray = DVec3::new((x - 0.5 * width) / height, 1.0, -(0.25 + y / height));
                let point = eye - ray * (eye.z / ray.z);
                Input::new(DVec3::new(point.x, point.y, 0.0), DVec3::Z, eye, 0.3, light)
            });
            waves.push(pixels.collect());
        }
    }
    waves
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shade::{ltc_surface, ltc_transform};
    use crate::table::Table;

    /// How many corners are above the surface and above the lobe's horizon.
    fn above(input: &Input) -> [usize; 2] {
        let vector = |v: [f32; 3]| Vec3::from(v).as_dvec3();
        let surface = ltc_surface::<f64>(
            vector(input.surface.position),
            vector(input.surface.normal),
            vector(input.surface.view),
            f64::from(input.surface.roughness),
        );
        let lobe = Table::default().lobe(&surface);
        let seen = input.seen().map(|corner| corner.as_dvec3());
        let count = |is: &dyn Fn(DVec3) -> bool| seen.iter().filter(|corner| is(**corner)).count();
        [count(&|v| v.z > 0.0), count(&|v| ltc_transform(&lobe, v).z > 0.0)]
    }

    #[test]
    fn named_inputs_are_what_their_names_say() {
        for (name, input) in named() {
            let [surface, lobe] = above(&input);
            let seen = input.seen();
            let front = (seen[2] - seen[0]).cross(seen[3] - seen[1]).dot(seen[0]) < 0.0;
            let extent = (seen[2] - seen[0]).length() / seen[0].length();
            let expected = match name {
                "near" => surface == 4 && lobe == 4 && front && extent > 0.3,
                "distant" => surface == 4 && lobe == 4 && front && extent < 0.2,
                "surface cut" => surface == 2 && lobe == 4 && front,
                "lobe cut" => surface == 4 && (1..4).contains(&lobe) && front,
                "both cut" => (1..4).contains(&surface) && (1..4).contains(&lobe) && front,
                "behind" => surface == 4 && !front,
                _ => false,
            };
            assert!(
                expected,
                "{name}: {surface} corners above the surface, {lobe} above the lobe's horizon, front {front}, extent {extent}"
            );
        }
    }

    #[test]
    fn waves_differ_within_and_between_each_other() {
        let waves = waves(3);
        assert_eq!((waves.len(), waves[0].len()), (18, WAVE));
        let cut = |wave: &Vec<Input>| wave.iter().all(|input| above(input)[0] < 4);
        let counts = (waves.iter().filter(|wave| cut(wave)).count(), waves.len());
        assert!(counts.0 > 0 && counts.0 < counts.1, "{counts:?} waves with a light that is cut");
        for wave in &waves {
            assert!(
                wave.iter().all(|input| input.surface.position != [0.0; 3] && input.surface.view[2] > 0.0)
            );
        }
    }
}
