//! Lights as values: what they are, whether they can be shaded, how far they reach.

mod check;
mod effects;
mod outline;
mod range;
mod value;

pub use check::LightError;
pub use outline::{is_convex_quad, polygon_normal};
pub use value::{light_value, light_value_with, polygon_value};

use glam::DVec3;

/// An area light of constant radiance, in any right-handed space and any unit of length.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "scene", derive(serde::Deserialize))]
#[cfg_attr(feature = "scene", serde(tag = "shape", rename_all = "lowercase"))]
pub enum Light {
    /// A planar polygon that does not cross itself, convex or not.
    Polygon {
        /// Its vertices, three or more, counter-clockwise seen from the side that emits.
        points: Vec<DVec3>,
        /// Whether both sides emit.
        #[cfg_attr(feature = "scene", serde(default))]
        two_sided: bool,
    },
    /// An ellipse.
    Disk {
        /// Its centre.
        #[cfg_attr(feature = "scene", serde(alias = "centre"))]
        center: DVec3,
        /// One half-axis, or any vector from the centre to the edge.
        half_x: DVec3,
        /// The other, or the conjugate one; the side to which `half_x` × `half_y` points emits.
        half_y: DVec3,
        /// Whether both sides emit.
        #[cfg_attr(feature = "scene", serde(default))]
        two_sided: bool,
    },
    /// A sphere.
    Sphere {
        /// Its centre.
        #[cfg_attr(feature = "scene", serde(alias = "centre"))]
        center: DVec3,
        /// Its radius.
        radius: f64,
    },
    /// A thin cylinder, which emits from its lateral surface.
    Tube {
        /// One end of its axis.
        start: DVec3,
        /// The other.
        end: DVec3,
        /// Its radius, at most about an eighth of the distance to what it lights.
        radius: f64,
        /// Whether hemispheres close its ends.
        #[cfg_attr(feature = "scene", serde(default))]
        caps: bool,
    },
}

impl Light {
    /// The name of its shape, as files spell it.
    pub fn shape(&self) -> &'static str {
        match self {
            Self::Polygon { .. } => "polygon",
            Self::Disk { .. } => "disk",
            Self::Sphere { .. } => "sphere",
            Self::Tube { .. } => "tube",
        }
    }

    /// The light moved: `point` maps positions, `vector` differences of positions. Both are parts of one rigid
    /// motion.
    pub fn moved(&self, point: impl Fn(DVec3) -> DVec3, vector: impl Fn(DVec3) -> DVec3) -> Self {
        match self {
            Self::Polygon { points, two_sided } => {
                Self::Polygon { points: points.iter().map(|&p| point(p)).collect(), two_sided: *two_sided }
            }
            Self::Disk { center, half_x, half_y, two_sided } => Self::Disk {
                center: point(*center),
                half_x: vector(*half_x),
                half_y: vector(*half_y),
                two_sided: *two_sided,
            },
            Self::Sphere { center, radius } => Self::Sphere { center: point(*center), radius: *radius },
            Self::Tube { start, end, radius, caps } => {
                Self::Tube { start: point(*start), end: point(*end), radius: *radius, caps: *caps }
            }
        }
    }

    /// Its vectors, each with what to call it in an error.
    fn vectors(&self) -> Vec<(String, DVec3)> {
        let named = |name: &str, v: &DVec3| (name.to_owned(), *v);
        match self {
            Self::Polygon { points, .. } => {
                points.iter().enumerate().map(|(i, point)| (format!("point {}", i + 1), *point)).collect()
            }
            Self::Disk { center, half_x, half_y, .. } => {
                vec![named("center", center), named("half_x", half_x), named("half_y", half_y)]
            }
            Self::Sphere { center, .. } => vec![named("center", center)],
            Self::Tube { start, end, .. } => vec![named("start", start), named("end", end)],
        }
    }
}
