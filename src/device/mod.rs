//! Evaluation on a wgpu adapter.

mod prefilter;
#[cfg(feature = "scene")]
mod render;
mod run;

#[cfg(feature = "scene")]
pub use render::RenderError;
pub use run::{Device, DeviceError, Program};

use bytemuck::{Pod, Zeroable};
use glam::DVec3;
use wgpu::util::DeviceExt;

use crate::light::{Light, is_convex_quad};
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

/// A light as the kernel reads it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct EvaluateLight {
    /// Index of its first vector.
    pub first: u32,
    /// Number of its vectors: a polygon's vertices; a disk's centre and half-axes; a sphere's centre with the radius as
    /// fourth number; a tube's ends, the first with the radius.
    pub count: u32,
    /// Sum of [`EvaluateLight::TWO_SIDED`], [`EvaluateLight::CONVEX_QUAD`] and [`EvaluateLight::CAPS`], where they apply.
    pub flags: u32,
    /// [`EvaluateLight::POLYGON`], [`EvaluateLight::DISK`], [`EvaluateLight::SPHERE`] or [`EvaluateLight::TUBE`].
    pub kind: u32,
}

impl EvaluateLight {
    /// The light emits from both sides.
    pub const TWO_SIDED: u32 = 1;
    /// The light has four vertices and is convex.
    pub const CONVEX_QUAD: u32 = 2;
    /// Hemispheres close the tube's ends.
    pub const CAPS: u32 = 4;

    /// The light is a polygon.
    pub const POLYGON: u32 = 0;
    /// The light is a disk.
    pub const DISK: u32 = 1;
    /// The light is a sphere.
    pub const SPHERE: u32 = 2;
    /// The light is a tube.
    pub const TUBE: u32 = 3;

    /// Adds the vectors of `light` to `vertices`. Triangles become quads with a repeated vertex, for which the include
    /// has its fastest function.
    pub fn new(light: &Light, vertices: &mut Vec<[f32; 4]>) -> Self {
        let first = vertices.len() as u32;
        let mut add = |v: DVec3, fourth: f64| vertices.push(v.as_vec3().extend(fourth as f32).to_array());
        let sides = |two_sided: bool| if two_sided { Self::TWO_SIDED } else { 0 };
        let (kind, flags) = match light {
            Light::Polygon { points, two_sided } => {
                let mut points = points.clone();
                if let [_, _, last] = points[..] {
                    points.push(last);
                }
                points.iter().for_each(|point| add(*point, 0.0));
                let convex = if is_convex_quad(&points) { Self::CONVEX_QUAD } else { 0 };
                (Self::POLYGON, sides(*two_sided) | convex)
            }
            Light::Disk { center, half_x, half_y, two_sided } => {
                [center, half_x, half_y].into_iter().for_each(|v| add(*v, 0.0));
                (Self::DISK, sides(*two_sided))
            }
            Light::Sphere { center, radius } => {
                add(*center, *radius);
                (Self::SPHERE, 0)
            }
            Light::Tube { start, end, radius, caps } => {
                add(*start, *radius);
                add(*end, 0.0);
                (Self::TUBE, if *caps { Self::CAPS } else { 0 })
            }
        };
        Self { first, count: vertices.len() as u32 - first, flags, kind }
    }
}

/// What to evaluate: the values of `pairs` of indices into `surfaces` and `lights`.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// Surface points.
    pub surfaces: Vec<EvaluateSurface>,
    /// Lights.
    pub lights: Vec<EvaluateLight>,
    /// Their vectors.
    pub vertices: Vec<[f32; 4]>,
    /// Index of a surface and of a light.
    pub pairs: Vec<[u32; 2]>,
}

impl Batch {
    /// Adds a light and returns its index.
    pub fn add_light(&mut self, light: &Light) -> u32 {
        self.lights.push(EvaluateLight::new(light, &mut self.vertices));
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
                size: wgpu::Extent3d {
                    width: size,
                    height: size,
                    depth_or_array_layers: table.layers().len() as u32,
                },
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
