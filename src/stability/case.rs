//! One hard case: a surface, a light, and what must hold of the value.

use core::ops::RangeInclusive;

use glam::{DVec3, Vec3};

use crate::device::{Batch, EvaluateLight, EvaluateSurface};
use crate::effects::Effects;
use crate::light::{Light, light_value, polygon_value};
use crate::shade::{
    LobeSum, LtcSpecular, LtcSurface, Real, Vector, ltc_fast_polygon, ltc_fast_quad, ltc_surface,
};
use crate::table::Table;

/// What must hold for the form factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// It is within this of exact arithmetic.
    Absolute(f64),
    /// It is within this share of its value of exact arithmetic.
    Relative(f64),
    /// It is exactly zero, and so is the reflected light.
    Zero,
    /// It is finite and within what physics allows.
    Physical,
}

/// A light in single precision, by the function that evaluates it.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum Shape {
    /// By `ltc_quad`: the corners of a convex quadrilateral.
    Quad {
        /// The corners.
        corners: [Vec3; 4],
        /// It emits from both sides.
        two_sided: bool,
    },
    /// By the `ltc_polygon` functions.
    Polygon {
        /// The vertices.
        vertices: Vec<Vec3>,
        /// It emits from both sides.
        two_sided: bool,
    },
    /// By `ltc_disk`.
    Disk {
        /// The centre.
        center: Vec3,
        /// From the centre to the rim.
        half_x: Vec3,
        /// From the centre to the rim, conjugate to the other.
        half_y: Vec3,
        /// It emits from both sides.
        two_sided: bool,
    },
    /// By `ltc_sphere`.
    Sphere {
        /// The centre.
        center: Vec3,
        /// The radius.
        radius: f32,
    },
    /// By `ltc_tube`.
    Tube {
        /// One end of the axis.
        start: Vec3,
        /// The other.
        end: Vec3,
        /// The radius.
        radius: f32,
        /// Hemispheres close the ends.
        caps: bool,
    },
}

impl Shape {
    /// The same light in double precision.
    pub fn light(&self) -> Light {
        match *self {
            Self::Quad { corners, two_sided } => {
                Light::Polygon { points: corners.map(|v| v.as_dvec3()).to_vec(), two_sided }
            }
            Self::Polygon { ref vertices, two_sided } => {
                Light::Polygon { points: vertices.iter().map(|v| v.as_dvec3()).collect(), two_sided }
            }
            Self::Disk { center, half_x, half_y, two_sided } => Light::Disk {
                center: center.as_dvec3(),
                half_x: half_x.as_dvec3(),
                half_y: half_y.as_dvec3(),
                two_sided,
            },
            Self::Sphere { center, radius } => {
                Light::Sphere { center: center.as_dvec3(), radius: radius.into() }
            }
            Self::Tube { start, end, radius, caps } => {
                Light::Tube { start: start.as_dvec3(), end: end.as_dvec3(), radius: radius.into(), caps }
            }
        }
    }

    /// The vertices of a quad or polygon; of other lights none.
    pub fn vertices(&self) -> &[Vec3] {
        match self {
            Self::Quad { corners, .. } => corners,
            Self::Polygon { vertices, .. } => vertices,
            _ => &[],
        }
    }

    /// The function of the include that evaluates it.
    pub fn function(&self) -> &'static str {
        match self {
            Self::Quad { .. } => "ltc_quad",
            Self::Polygon { .. } => "ltc_polygon",
            Self::Disk { .. } => "ltc_disk",
            Self::Sphere { .. } => "ltc_sphere",
            Self::Tube { .. } => "ltc_tube",
        }
    }
}

/// A surface, a light and what must hold. Coordinates are of single precision, so that every form of the include sees the
/// same input.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Name of the family that it belongs to, as in [`super::CATALOGUE`].
    pub family: &'static str,
    /// The surface point.
    pub position: Vec3,
    /// The normal, of any length but zero.
    pub normal: Vec3,
    /// Direction towards the eye, of any length but zero.
    pub view: Vec3,
    /// Perceptual roughness.
    pub roughness: f32,
    /// The light.
    pub shape: Shape,
    /// What must hold for the form factor.
    pub bound: Bound,
    /// How far specular light may be from exact arithmetic, Schlick's part twice as far; infinite where physics alone
    /// bounds it.
    pub specular_bound: f64,
    /// The form factor where a closed form knows it better than exact arithmetic on rounded input.
    pub form_factor: Option<f64>,
}

impl Case {
    /// Shows position, normal, view and the light's vectors, each as three numbers, and its radius as one.
    pub fn each_vector(&mut self, show: &mut dyn FnMut(&mut [f32])) {
        let mut vector = |v: &mut Vec3| {
            let numbers: &mut [f32; 3] = v.as_mut();
            show(numbers);
        };
        [&mut self.position, &mut self.normal, &mut self.view].into_iter().for_each(&mut vector);
        match &mut self.shape {
            Shape::Quad { corners, .. } => corners.iter_mut().for_each(vector),
            Shape::Polygon { vertices, .. } => vertices.iter_mut().for_each(vector),
            Shape::Disk { center, half_x, half_y, .. } => {
                [center, half_x, half_y].into_iter().for_each(vector);
            }
            Shape::Sphere { center, radius } => {
                vector(center);
                show(core::slice::from_mut(radius));
            }
            Shape::Tube { start, end, radius, .. } => {
                [start, end].into_iter().for_each(vector);
                show(core::slice::from_mut(radius));
            }
        }
    }

    /// Whether the largest number of every vector, and every radius, is zero or in `range`, as [`REORDERED`](super::REORDERED) asks for.
    pub fn is_within(&self, range: &RangeInclusive<f32>) -> bool {
        let mut all = true;
        self.clone().each_vector(&mut |numbers| {
            let extent = numbers.iter().fold(0.0, |most: f32, number| most.max(number.abs()));
            all &= extent == 0.0 || range.contains(&extent);
        });
        all
    }

    /// Values (diffuse, specular, fresnel) by the twin of the include on the CPU, in the precision of `R`, at the quality
    /// level that `effects` holds.
    pub fn twin<R: Real>(&self, table: &Table, effects: Effects) -> [f64; 3] {
        let surface = self.surface::<R>();
        self.shaded(&surface, &table.specular(&surface, effects), effects)
    }

    /// The same for given lobes of its surface.
    pub fn shaded<R: Real>(
        &self,
        surface: &LtcSurface<R>,
        lobes: &LtcSpecular<R>,
        effects: Effects,
    ) -> [f64; 3] {
        let v = vector::<R>;
        let value = match &self.shape {
            Shape::Quad { corners, two_sided } if effects.is_fast() => {
                ltc_fast_quad(surface, lobes, corners.map(v), *two_sided)
            }
            Shape::Quad { corners, two_sided } => {
                polygon_value(surface, lobes, &corners.map(v), true, *two_sided)
            }
            Shape::Polygon { vertices, two_sided } => {
                let vertices: Vec<R::Vec3> = vertices.iter().map(|vertex| v(*vertex)).collect();
                if effects.is_fast() {
                    ltc_fast_polygon(surface, lobes, &vertices, *two_sided)
                } else {
                    polygon_value(surface, lobes, &vertices, false, *two_sided)
                }
            }
            other => light_value(surface, lobes, &other.light()),
        };
        [value.x(), value.y(), value.z()].map(Real::to_f64)
    }

    /// Values of exact arithmetic: the twin in double precision, or a closed form for the form factor.
    pub fn exact(&self, table: &Table, effects: Effects) -> [f64; 3] {
        let [form_factor, specular, fresnel] = self.twin::<f64>(table, effects);
        [self.form_factor.unwrap_or(form_factor), specular, fresnel]
    }

    /// The most that the lobes that the case is shaded with reflect: their albedo, which a light all around the point gets, in
    /// whichever precision it is larger, and what a rounding of a grazing view's cosine changes of it.
    pub fn albedo(&self, table: &Table, effects: Effects) -> f64 {
        fn sum<R: Real>(case: &Case, table: &Table, effects: Effects) -> f64 {
            let surface = case.surface::<R>();
            table.specular(&surface, effects).lobes().iter().map(|lobe| lobe.albedo.to_f64()).sum()
        }
        let albedo = sum::<f32>(self, table, effects).max(sum::<f64>(self, table, effects));
        albedo * (1.0 + 1e-6) + (1e-6 / self.surface::<f64>().cos_view.max(1e-6).sqrt())
    }

    /// The surface with its frame.
    pub fn surface<R: Real>(&self) -> LtcSurface<R> {
        let roughness = R::new(self.roughness.into());
        ltc_surface(vector::<R>(self.position), vector::<R>(self.normal), vector::<R>(self.view), roughness)
    }

    /// α of the surface's lobe times the cosine of the view: what the sensitivity of specular light is inversely
    /// proportional to.
    pub(super) fn sharpness(&self) -> f64 {
        let alpha = f64::from(self.roughness.clamp(0.02, 1.0)).powi(2);
        let cosine = self.view.as_dvec3().normalize().dot(self.normal.as_dvec3().normalize());
        alpha * cosine.max(1e-9)
    }

    /// The sine between view and normal.
    pub(super) fn tilt(&self) -> f64 {
        self.view.as_dvec3().normalize().cross(self.normal.as_dvec3().normalize()).length()
    }

    /// The light's points seen from the surface point.
    pub(super) fn seen(&self) -> Vec<DVec3> {
        self.shape.vertices().iter().map(|v| v.as_dvec3() - self.position.as_dvec3()).collect()
    }
}

fn vector<R: Real>(v: Vec3) -> R::Vec3 {
    R::Vec3::new(R::new(v.x.into()), R::new(v.y.into()), R::new(v.z.into()))
}

/// The cases as buffers of the evaluation kernel, one surface and one light each.
pub fn batch(cases: &[Case]) -> Batch {
    let mut batch = Batch::default();
    for (index, case) in cases.iter().enumerate() {
        batch.surfaces.push(EvaluateSurface {
            position: case.position.into(),
            roughness: case.roughness,
            normal: case.normal.into(),
            view: case.view.into(),
            ..EvaluateSurface::default()
        });
        let light = batch.add_light(&case.shape.light());
        if !case.shape.vertices().is_empty() {
            let flags = &mut batch.lights[light as usize].flags;
            *flags &= !EvaluateLight::CONVEX_QUAD;
            *flags |= u32::from(matches!(case.shape, Shape::Quad { .. })) * EvaluateLight::CONVEX_QUAD;
        }
        batch.pairs.push([index as u32, light]);
    }
    batch
}
