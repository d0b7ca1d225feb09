//! What users of area lights have otherwise, made anew from the papers, each on the CPU and in WGSL.
//!
//! Every method is written as a shader would have it, in single precision and with the shortcuts that its users take, so
//! that its error and its cost are those that they see. Nothing of the include needs any of this.
//!
//! | name | technique |
//! |---|---|
//! | `published` | linearly transformed cosines as published: exact clipping at the lobe's horizon in sixteen cases |
//! | `proxy` | the same with a sphere in place of the light at the horizon |
//! | `representative` | the point of the light closest to the mirror direction |
//! | `phong` | axial moments of a Phong lobe |
//! | `samples-1` … `samples-64` | Monte Carlo integration, light and reflectance sampled |
//! | `light-16`, `brdf-16` | the same, one of the two sampled |

mod microfacet;
mod phong;
mod published;
mod reference;
mod representative;
mod run;
mod samples;

use glam::Vec3;

use super::data::{Kind, MethodInfo};
use super::measure::Quad;
use super::method::Method;
use crate::table::Table;

pub use phong::{Phong, phong_exponent, phong_integrals, phong_moment, phong_value};
pub use published::{
    Proxy, Published, proxy_value, published_clip, published_edge, published_lobe, published_value,
};
pub use reference::{Level, Truth};
pub use representative::{Representative, representative_value};
pub(crate) use run::table;
pub use run::{CompareError, level, run, run_inputs, source, wgsl};
pub use samples::{Samples, samples_seed, samples_value};

/// The table of [`crate::fit::bake_published`], in the layout of the published tables.
pub const TABLE_PUBLISHED: &[u8] = include_bytes!("../../../table/ltc_published.bin");

/// The table of the published technique, of 64 × 64 texels in the published layout.
pub fn published_table() -> Table {
    Table::from_bytes(crate::TABLE_SIZE, TABLE_PUBLISHED).expect("the embedded table is whole")
}

/// What a shader gets: a surface point and a light of four vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Input {
    /// The surface point.
    pub position: Vec3,
    /// Unit normal.
    pub normal: Vec3,
    /// Unit vector to the eye.
    pub view: Vec3,
    /// Perceptual roughness, 0…1.
    pub roughness: f32,
    /// The light's vertices; it emits from the side from which they run counter-clockwise.
    pub corners: [Vec3; 4],
}

impl From<&Quad> for Input {
    fn from(quad: &Quad) -> Self {
        Self {
            position: Vec3::ZERO,
            normal: Vec3::Z,
            view: quad.view.as_vec3(),
            roughness: quad.roughness as f32,
            corners: quad.corners.map(|corner| corner.as_vec3()),
        }
    }
}

/// Everything that is no level of this library and no reference, in the order of charts.
pub fn comparators() -> Vec<Box<dyn Method>> {
    let mut methods: Vec<Box<dyn Method>> = vec![
        Box::new(Published::default()),
        Box::new(Proxy::default()),
        Box::new(Representative),
        Box::new(Phong::default()),
    ];
    methods.extend(Samples::ALL.map(|samples| Box::new(samples) as Box<dyn Method>));
    methods
}

/// The description of a comparator.
fn comparator(name: &str, label: &str, description: &str) -> MethodInfo {
    MethodInfo {
        name: name.to_owned(),
        label: label.to_owned(),
        kind: Kind::Comparator,
        description: description.to_owned(),
    }
}
