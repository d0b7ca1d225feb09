//! The methods in WGSL, and their evaluation on a device.

use bytemuck::{Pod, Zeroable};
use wgpu::util::DeviceExt;

use super::{Input, published_table};
use crate::device::{Device, DeviceError, Program};
use crate::effects::{self, Effect, Effects, Quality};
use crate::report::costs::{COMPUTE, MEASURE};
use crate::report::measure::Quad;
use crate::table::Table;

/// The text of Monte Carlo integration behind the constants of a variant.
macro_rules! samples {
    ($count:literal, $light:literal, $visible:literal, $cosine:literal) => {
        concat!(
            "const SAMPLES_COUNT: u32 = ",
            $count,
            "u;\nconst SAMPLES_LIGHT: f32 = ",
            $light,
            ";\nconst SAMPLES_VISIBLE: f32 = ",
            $visible,
            ";\nconst SAMPLES_COSINE: f32 = ",
            $cosine,
            ";\n\n",
            include_str!("../../../wgsl/compare/samples.wgsl")
        )
    };
}

/// A method's text, which defines
///
/// ```wgsl
/// fn method_value(position: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, roughness: f32,
///     a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>) -> vec3<f32>
/// ```
///
/// for a surface point with a unit normal and a unit view, and the four vertices of a light: the value (diffuse, specular,
/// fresnel). It may read the bindings `table: texture_2d_array<f32>` and `table_sampler: sampler`, which whatever it is put
/// into declares. Levels call the include; all others stand alone.
pub fn wgsl(name: &str) -> Option<&'static str> {
    Some(match name {
        _ if level(name).is_some() => include_str!("../../../wgsl/compare/level.wgsl"),
        "published" => include_str!("../../../wgsl/compare/published.wgsl"),
        "proxy" => include_str!("../../../wgsl/compare/proxy.wgsl"),
        "representative" => include_str!("../../../wgsl/compare/representative.wgsl"),
        "phong" => include_str!("../../../wgsl/compare/phong.wgsl"),
        "samples-1" => samples!("1", "0.5", "0.5", "0.0"),
        "samples-4" => samples!("4", "0.5", "0.5", "0.0"),
        "samples-16" => samples!("16", "0.5", "0.5", "0.0"),
        "samples-64" => samples!("64", "0.5", "0.5", "0.0"),
        "light-16" => samples!("16", "1.0", "0.0", "0.0"),
        "brdf-16" => samples!("16", "0.0", "0.5", "0.5"),
        _ => return None,
    })
}

/// What a quality level of that name makes of one quad on a GGX surface.
pub fn level(name: &str) -> Option<Effects> {
    let plain = Effects::of(&[Effect::Quad, Effect::Ggx]).expect("neither needs another");
    Some(name.parse::<Quality>().ok()?.of(plain))
}

/// The whole module of a method: the include for levels, the method and [`MEASURE`].
pub fn source(name: &str) -> Option<String> {
    let text = wgsl(name)?;
    let include = level(name).map(|effects| effects::wgsl(effects).expect("the include has its levels"));
    Some(format!("{}\n{text}\n{MEASURE}", include.unwrap_or_default()))
}

/// The table that a method reads, or any where it reads none.
pub(crate) fn table(name: &str) -> Table {
    match level(name).map(Effects::layers) {
        Some(layers) if !layers.is_empty() => Table::default().completed(&layers).only(&layers),
        _ => published_table(),
    }
}

/// Why a method could not be evaluated on a device.
#[derive(Debug, thiserror::Error)]
pub enum CompareError {
    /// There is no such method in WGSL.
    #[error("no method named {0:?} is there in WGSL")]
    UnknownMethod(String),
    /// The device refused.
    #[error(transparent)]
    Device(#[from] DeviceError),
}

/// A surface as [`MEASURE`] reads it.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct CompareSurface {
    position: [f32; 3],
    roughness: f32,
    normal: [f32; 3],
    spare_a: f32,
    view: [f32; 3],
    spare_b: f32,
}

/// Evaluates a method on a device: (diffuse, specular, fresnel) of each quad.
///
/// # Errors
///
/// If there is no such method in WGSL, or the device refuses.
pub fn run(device: &Device, name: &str, quads: &[Quad]) -> Result<Vec<[f32; 3]>, CompareError> {
    let inputs: Vec<Input> = quads.iter().map(Input::from).collect();
    run_inputs(device, name, &inputs)
}

/// [`run`] for surfaces anywhere.
///
/// # Errors
///
/// As [`run`].
pub fn run_inputs(device: &Device, name: &str, inputs: &[Input]) -> Result<Vec<[f32; 3]>, CompareError> {
    let source = source(name).ok_or_else(|| CompareError::UnknownMethod(name.to_owned()))?;
    if inputs.is_empty() {
        return Ok(Vec::new());
    }
    // The kernel takes a power of two of them.
    let padded = || inputs.iter().chain(std::iter::repeat(&inputs[0])).take(inputs.len().next_power_of_two());
    let surfaces: Vec<CompareSurface> = padded()
        .map(|input| CompareSurface {
            position: input.position.to_array(),
            roughness: input.roughness,
            normal: input.normal.to_array(),
            spare_a: 0.0,
            view: input.view.to_array(),
            spare_b: 0.0,
        })
        .collect();
    let corners: Vec<[f32; 4]> =
        padded().flat_map(|input| input.corners).map(|corner| corner.extend(0.0).to_array()).collect();
    let storage = |contents: &[u8]| {
        device.device().create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents,
            usage: wgpu::BufferUsages::STORAGE,
        })
    };
    let (surfaces, corners) =
        (storage(bytemuck::cast_slice(&surfaces)), storage(bytemuck::cast_slice(&corners)));
    let results = device.device().create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 16 * inputs.len() as u64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let (view, sampler) = device.upload_table(&table(name));
    let resources = [
        surfaces.as_entire_binding(),
        corners.as_entire_binding(),
        results.as_entire_binding(),
        wgpu::BindingResource::TextureView(&view),
        wgpu::BindingResource::Sampler(&sampler),
    ];
    let groups = (inputs.len() as u32).div_ceil(64);
    let bytes = device.compute(&Program::wgsl(source), COMPUTE, &resources, [groups, 1], &results)?;
    let values: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
    Ok(values.into_iter().map(|[diffuse, specular, fresnel, _]| [diffuse, specular, fresnel]).collect())
}
