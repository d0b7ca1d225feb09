//! What keeps a light from being shaded.

use glam::{DVec3, Vec3};

use super::{Light, polygon_normal};

/// Why a light cannot be shaded: a sentence without the light's own name.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LightError {
    /// A number is not finite in single precision.
    #[error(
        "{field} is not finite in single precision: it is {value}, and each number must be from -3.4e38 to 3.4e38"
    )]
    NotFinite {
        /// The field.
        field: String,
        /// What it holds.
        value: String,
    },
    /// Too few vertices.
    #[error("points holds {count} of them; a light needs three or more")]
    TooFewPoints {
        /// How many there are.
        count: usize,
    },
    /// The vertices lie on one line.
    #[error("points cover no area; a light must be a polygon that is not flat as a line")]
    NoArea,
    /// The vertices are not in one plane.
    #[error("points are not in one plane; a light must be flat to {share} of its size")]
    NotPlanar {
        /// The largest share of its size by which it may leave a plane.
        share: f64,
    },
    /// The outline crosses itself.
    #[error("sides {first} and {second} cross; the outline of a light must not cross itself")]
    Crossing {
        /// The first of the sides, counted from 1.
        first: usize,
        /// The other.
        second: usize,
    },
    /// A half-axis is zero.
    #[error("{field} is zero; a half-axis must have a length")]
    ZeroAxis {
        /// The half-axis.
        field: &'static str,
    },
    /// The half-axes point the same way.
    #[error("half_x and half_y are parallel; the two half-axes of a disk must span a plane")]
    ParallelAxes,
    /// A radius is zero or negative.
    #[error("radius is {radius}; it must be larger than 0")]
    Radius {
        /// What it is.
        radius: f64,
    },
}

impl Light {
    /// Whether the light can be shaded.
    ///
    /// The include's functions are defined for every finite input; what is refused here emits nothing, or is not
    /// what a person meant.
    ///
    /// # Errors
    ///
    /// The first thing that is wrong.
    pub fn check(&self) -> Result<(), LightError> {
        for (field, value) in self.vectors() {
            if !value.as_vec3().is_finite() {
                return Err(LightError::NotFinite { field, value: format!("{:?}", value.to_array()) });
            }
        }
        match *self {
            Self::Polygon { ref points, .. } => polygon_normal(points).map(|_| ()),
            Self::Disk { half_x, half_y, .. } => axes(half_x, half_y),
            Self::Sphere { radius, .. } => positive(radius),
            Self::Tube { radius, .. } => positive(radius),
        }
    }
}

fn axes(half_x: DVec3, half_y: DVec3) -> Result<(), LightError> {
    let direction = |field: &'static str, v: DVec3| {
        let scaled = if v.as_vec3() == Vec3::ZERO { DVec3::ZERO } else { v / v.abs().max_element() };
        scaled.try_normalize().ok_or(LightError::ZeroAxis { field })
    };
    let (x, y) = (direction("half_x", half_x)?, direction("half_y", half_y)?);
    if x.cross(y).length() < 1e-6 { Err(LightError::ParallelAxes) } else { Ok(()) }
}

fn positive(radius: f64) -> Result<(), LightError> {
    if !(radius as f32).is_finite() {
        return Err(LightError::NotFinite { field: "radius".to_owned(), value: radius.to_string() });
    }
    // What rounds to zero in single precision is zero to a shader.
    if radius as f32 > 0.0 { Ok(()) } else { Err(LightError::Radius { radius }) }
}
