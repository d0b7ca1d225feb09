//! Evaluation on a wgpu adapter.

#[cfg(feature = "scene")]
mod render;
mod run;

#[cfg(feature = "scene")]
pub use render::RenderError;
pub use run::{Device, DeviceError, Program};

use bytemuck::{Pod, Zeroable};
use wgpu::util::DeviceExt;

use crate::table::Table;

/// A surface point as the kernel of `wgsl/evaluate.wgsl` reads it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct EvaluateSurface {
    /// The point.
    pub position: [f32; 3],
    /// Perceptual roughness, 0…1.
    pub roughness: f32,
    /// The normal, of any length but zero.
    pub normal: [f32; 3],
    /// Not used.
    pub spare_a: f32,
    /// Direction towards the eye, of any length but zero.
    pub view: [f32; 3],
    /// Not used.
    pub spare_b: f32,
}

/// A polygon light as the kernel reads it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct EvaluateLight {
    /// Index of its first vertex.
    pub first: u32,
    /// Number of its vertices.
    pub count: u32,
    /// Sum of [`EvaluateLight::TWO_SIDED`] and [`EvaluateLight::CONVEX_QUAD`], where they apply.
    pub flags: u32,
    /// Not used.
    pub spare: u32,
}

impl EvaluateLight {
    /// The light emits from both sides.
    pub const TWO_SIDED: u32 = 1;
    /// The light has four vertices and is convex.
    pub const CONVEX_QUAD: u32 = 2;
}

/// What to evaluate: the values of `pairs` of indices into `surfaces` and `lights`.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// Surface points.
    pub surfaces: Vec<EvaluateSurface>,
    /// Lights.
    pub lights: Vec<EvaluateLight>,
    /// Their vertices; the fourth number is not used.
    pub vertices: Vec<[f32; 4]>,
    /// Index of a surface and of a light.
    pub pairs: Vec<[u32; 2]>,
}

impl Batch {
    /// Adds a light and returns its index.
    pub fn add_light(&mut self, vertices: &[[f32; 3]], flags: u32) -> u32 {
        let first = self.vertices.len() as u32;
        self.vertices.extend(vertices.iter().map(|[x, y, z]| [*x, *y, *z, 0.0]));
        self.lights.push(EvaluateLight { first, count: vertices.len() as u32, flags, spare: 0 });
        self.lights.len() as u32 - 1
    }
}

impl Device {
    /// Runs the evaluation kernel in any of its forms and returns (diffuse, specular, fresnel) of
    /// each pair.
    ///
    /// # Errors
    ///
    /// If the device refuses the program or is lost.
    pub fn evaluate(
        &self,
        program: &Program,
        table: &Table,
        batch: &Batch,
    ) -> Result<Vec<[f32; 3]>, DeviceError> {
        if batch.pairs.is_empty() {
            return Ok(Vec::new());
        }
        let device = self.device();
        let storage = |contents: &[u8]| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: None,
                contents,
                usage: wgpu::BufferUsages::STORAGE,
            })
        };
        let inputs = [
            storage(bytemuck::cast_slice(&batch.surfaces)),
            storage(bytemuck::cast_slice(&batch.lights)),
            storage(bytemuck::cast_slice(&batch.vertices)),
            storage(bytemuck::cast_slice(&batch.pairs)),
        ];
        let output = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: 16 * batch.pairs.len() as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let (view, sampler) = self.upload_table(table);
        let mut resources: Vec<wgpu::BindingResource> =
            inputs.iter().map(wgpu::Buffer::as_entire_binding).collect();
        resources.push(output.as_entire_binding());
        resources.push(wgpu::BindingResource::TextureView(&view));
        resources.push(wgpu::BindingResource::Sampler(&sampler));
        let groups = (batch.pairs.len() as u32).div_ceil(64);
        let bytes = self.compute(program, "evaluate", &resources, [groups, 1], &output)?;
        let values: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
        Ok(values.into_iter().map(|[diffuse, specular, fresnel, _]| [diffuse, specular, fresnel]).collect())
    }

    /// The table as a texture array, and a sampler for it.
    pub fn upload_table(&self, table: &Table) -> (wgpu::TextureView, wgpu::Sampler) {
        let size = table.size() as u32;
        let texture = self.device().create_texture_with_data(
            self.queue(),
            &wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d { width: size, height: size, depth_or_array_layers: 2 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: wgpu::TextureFormat::Rgba16Float,
                usage: wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            },
            wgpu::util::TextureDataOrder::LayerMajor,
            &table.bytes(),
        );
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        let sampler = self.device().create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        (view, sampler)
    }
}
