//! The include on the CPU: the same functions under the same names, generic over `f32` and `f64`.
//!
//! ```
//! use glam::DVec3;
//! use softbox::shade::{ltc_quad, ltc_surface};
//!
//! let table = softbox::table::Table::default();
//! let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, DVec3::new(0.6, 0.0, 0.8), 0.3);
//! let lobe = table.lobe(&surface);
//! // A unit square one unit above the point, emitting downwards.
//! let square = [
//!     DVec3::new(-0.5, -0.5, 1.0),
//!     DVec3::new(-0.5, 0.5, 1.0),
//!     DVec3::new(0.5, 0.5, 1.0),
//!     DVec3::new(0.5, -0.5, 1.0),
//! ];
//! let value = ltc_quad(&surface, &lobe, square, false);
//! assert!((value.x - 0.2395).abs() < 1e-4); // the form factor
//! ```

mod anisotropic;
mod cone;
mod disk;
mod fast;
mod fitted;
mod layers;
mod polygon;
mod quad;
mod real;
mod several;
mod surface;
mod texture;
mod tube;
mod whole;

pub use anisotropic::{
    LTC_ALPHA_FLOOR, LTC_ANISOTROPIC_KNEE, LTC_ANISOTROPIC_SIZE, LtcAnisotropy, ltc_anisotropic_alpha,
    ltc_anisotropic_coordinates, ltc_anisotropic_lobe, ltc_anisotropic_root, ltc_anisotropic_round,
    ltc_anisotropic_texels, ltc_anisotropy,
};
#[cfg(feature = "bake")]
pub(crate) use anisotropic::{
    azimuth as anisotropic_azimuth, base as anisotropic_base, stretch as anisotropic_stretch,
};
pub use cone::{
    LtcAcross, LtcCone, LtcCut, Together, ltc_cone, ltc_cone_across, ltc_cone_between, ltc_cone_inward,
    ltc_cone_outward, ltc_cone_part, ltc_cone_step, ltc_cone_tilt, ltc_cut, ltc_cut_together, ltc_half_turn,
    ltc_hyperbolic_deficit,
};
pub use disk::{
    LtcDisk, LtcSphere, ltc_disk, ltc_disk_begin, ltc_disk_diffuse, ltc_disk_lobe, ltc_sphere,
    ltc_sphere_begin, ltc_sphere_diffuse, ltc_sphere_lobe,
};
pub use fast::{
    LTC_HALF_ANGLE, LTC_ROUND_ABOVE, LtcFastLight, ltc_fast_edge, ltc_fast_form_factor, ltc_fast_polygon,
    ltc_fast_quad, ltc_fast_ratio, ltc_fast_unit, ltc_round_above,
};
pub use fitted::{FittedLobe, LTC_FITTED, ltc_lobe_fitted};
pub use layers::{
    LTC_ALBEDO_FLOOR, LTC_SHEEN_ROUGHNESS_FLOOR, ltc_coat_over, ltc_coat_transmission, ltc_diffuse_lobe,
    ltc_energy_compensation, ltc_rough_diffuse, ltc_sheen_lobe, ltc_sheen_over, ltc_surface_with_roughness,
};
pub use polygon::{
    LtcOutline, LtcOutlineLobe, LtcPolygon, ltc_outline_add, ltc_outline_begin, ltc_outline_diffuse,
    ltc_outline_lobe, ltc_outline_lobe_add, ltc_outline_lobe_begin, ltc_polygon_add, ltc_polygon_begin,
    ltc_polygon_end,
};
pub use quad::{
    LtcQuad, ltc_angle, ltc_angle_excess, ltc_crossing, ltc_edge_about, ltc_edge_excess, ltc_edge_near,
    ltc_edge_normal, ltc_edge_part, ltc_edge_turn, ltc_edge_weight, ltc_edges, ltc_far_offset,
    ltc_far_pentagon, ltc_flat_crossing, ltc_horizon, ltc_inverse_length, ltc_offset, ltc_pentagon, ltc_quad,
    ltc_quad_begin, ltc_quad_diffuse, ltc_quad_form_factor, ltc_quad_lobe, ltc_quad_toward, ltc_shorter,
};
pub use real::{Real, Vector, angle_excess, hyperbolic_excess};
pub use several::{
    LTC_MEAN_SHIFT, LobeSum, LtcLobes, LtcSpecular, ltc_all_around, ltc_lobes_of, ltc_lobes_part,
    ltc_lobes_together, ltc_lobes_value, ltc_mean_schlick, ltc_three_lobes, ltc_two_lobes,
};
pub use surface::{
    LTC_HEADROOM, LTC_ROUGHNESS_FLOOR, LTC_TINY, LtcLobe, LtcSurface, ltc_direction, ltc_extent,
    ltc_framed_lobe, ltc_in_frame, ltc_lobe, ltc_lobe_value, ltc_planar_lobe, ltc_received,
    ltc_received_vector, ltc_reflectance, ltc_schlick, ltc_specular, ltc_surface, ltc_table_coordinates,
    ltc_transform, ltc_transform_framed, ltc_transform_framed_normal, ltc_transform_normal,
};
pub use texture::{
    LTC_LOOKUP, LookupConstants, LtcLookup, ltc_lookup, ltc_lookup_with, ltc_outlined,
    ltc_rectangle_diffuse_lookup, ltc_rectangle_lookup,
};
pub use tube::{
    LtcTube, ltc_root, ltc_tube, ltc_tube_begin, ltc_tube_cap, ltc_tube_cap_begin, ltc_tube_diffuse,
    ltc_tube_line, ltc_tube_lobe, ltc_tube_share,
};
pub use whole::{
    LtcMaterial, LtcReceived, LtcShading, ltc_in_range, ltc_material, ltc_plain_value, ltc_reflected,
    ltc_reflected_picture, ltc_shading, ltc_shading_disk, ltc_shading_polygon, ltc_shading_quad,
    ltc_shading_sphere, ltc_shading_tube,
};
