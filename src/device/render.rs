//! Pictures of scenes by the include.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;
use wgpu::util::DeviceExt;

use super::{Device, DeviceError, EvaluateLight};
use crate::scene::{Image, Light, Object, Scene, Shape, sample_positions};
use crate::table::Table;

/// Why a scene was not drawn.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// A pixel is infinite or not a number.
    #[error(
        "pixel ({column}, {row}) on {adapter} is not finite; please report the scene, for the include promises finite values"
    )]
    NotFinite {
        /// Pixels from the left.
        column: u32,
        /// Pixels from the top.
        row: u32,
        /// The adapter's name.
        adapter: String,
    },
    /// The picture does not fit the device.
    #[error(
        "a picture of {width} x {height} pixels with {samples} samples is too large; each side may have 1 to 16384 pixels, each pixel 1 to 4096 samples"
    )]
    Size {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// Samples of a pixel.
        samples: u32,
    },
}

/// Evaluations of a light or intersections with an object that one dispatch may ask for: below a second on a CPU,
/// and far from the time after which drivers give a GPU up.
const BAND_WORK: u64 = 4_000_000;

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct RenderSettings {
    position: [f32; 3],
    width: u32,
    forward: [f32; 3],
    height: u32,
    right: [f32; 3],
    row: u32,
    up: [f32; 3],
    rows: u32,
    background: [f32; 3],
    object_count: u32,
    light_count: u32,
    sample_count: u32,
    spare: [u32; 2],
}

#[derive(Clone, Copy, Default, Pod, Zeroable)]
#[repr(C)]
struct RenderObject {
    centre: [f32; 3],
    kind: u32,
    axis_x: [f32; 3],
    extent_x: f32,
    axis_y: [f32; 3],
    extent_y: f32,
    axis_z: [f32; 3],
    extent_z: f32,
    base_colour: [f32; 3],
    roughness_from: f32,
    f0: [f32; 3],
    roughness_to: f32,
    f90: [f32; 3],
    spare_a: f32,
    roughness_start: [f32; 3],
    spare_b: f32,
    roughness_gradient: [f32; 3],
    spare_c: f32,
}

#[derive(Clone, Copy, Default, Pod, Zeroable)]
#[repr(C)]
struct RenderLight {
    radiance: [f32; 3],
    spare_a: u32,
    normal: [f32; 3],
    spare_b: u32,
    shape: EvaluateLight,
}

fn single(v: DVec3) -> [f32; 3] {
    v.as_vec3().to_array()
}

impl RenderObject {
    fn new(object: &Object) -> Self {
        let (kind, centre, axes, extent) = match object.shape {
            // A length beyond every scene stands for no end: a shader may assume that there is no infinity.
            Shape::Plane { point, axes, extent } => {
                (0, point, axes, [extent[0].min(1e30), extent[1].min(1e30), 0.0])
            }
            Shape::Box { centre, axes, half_size } => (1, centre, axes, half_size.to_array()),
            Shape::Sphere { centre, radius } => (2, centre, DVec3::AXES, [radius; 3]),
        };
        let [extent_x, extent_y, extent_z] = extent.map(|length| length as f32);
        let material = &object.material;
        Self {
            centre: single(centre),
            kind,
            axis_x: single(axes[0]),
            extent_x,
            axis_y: single(axes[1]),
            extent_y,
            axis_z: single(axes[2]),
            extent_z,
            base_colour: single(material.base_colour),
            roughness_from: material.roughness.from as f32,
            f0: single(material.f0),
            roughness_to: material.roughness.to as f32,
            f90: single(material.f90),
            roughness_start: single(material.roughness.start),
            roughness_gradient: single(material.roughness.gradient),
            ..Self::default()
        }
    }
}

impl RenderLight {
    fn new(light: &Light, vertices: &mut Vec<[f32; 4]>) -> Self {
        Self {
            shape: EvaluateLight::new(&light.shape, vertices),
            radiance: single(light.radiance),
            normal: single(light.normal),
            ..Self::default()
        }
    }
}

impl Device {
    /// Opens the best adapter of the platform's own APIs: Vulkan, Metal or Direct3D 12; OpenGL if there is none.
    ///
    /// # Errors
    ///
    /// If there is none or it refuses.
    pub fn open_any() -> Result<Self, DeviceError> {
        Self::open(wgpu::Backends::PRIMARY).or_else(|error| Self::open(wgpu::Backends::GL).map_err(|_| error))
    }

    /// Draws a scene with the include: linear radiance, each pixel the mean of its samples. `progress` hears the
    /// share that is done after each band of rows.
    ///
    /// # Errors
    ///
    /// If the device fails, the size is out of range, or a pixel is not finite.
    pub fn render(
        &self,
        table: &Table,
        scene: &Scene,
        [width, height]: [u32; 2],
        samples: u32,
        progress: &dyn Fn(f64),
    ) -> Result<Image, RenderError> {
        let sides = 1..=16384;
        if !(sides.contains(&width) && sides.contains(&height) && (1..=4096).contains(&samples)) {
            return Err(RenderError::Size { width, height, samples });
        }
        let mut vertices = Vec::new();
        let lights: Vec<RenderLight> =
            scene.lights.iter().map(|light| RenderLight::new(light, &mut vertices)).collect();
        let objects: Vec<RenderObject> = scene.objects.iter().map(RenderObject::new).collect();
        let half = (0.5 * scene.camera.field_of_view).tan();
        let mut settings = RenderSettings {
            position: single(scene.camera.position),
            width,
            forward: single(scene.camera.forward),
            height,
            right: single(scene.camera.right * half),
            row: 0,
            up: single(scene.camera.up * half),
            rows: 0,
            background: single(scene.background),
            object_count: objects.len() as u32,
            light_count: lights.len() as u32,
            sample_count: samples,
            spare: [0; 2],
        };
        let row_work = u64::from(width) * u64::from(samples) * (1 + vertices.len() + objects.len()) as u64;
        let band = (BAND_WORK / row_work).clamp(1, u64::from(height)) as u32;
        let mut pixels = Vec::with_capacity(width as usize * height as usize);
        let positions = sample_positions(samples);
        let kernel = self.render_kernel(table, &objects, &lights, &vertices, &positions, width * band)?;
        for row in (0..height).step_by(band as usize) {
            settings.row = row;
            settings.rows = band.min(height - row);
            let bytes = self.render_band(&kernel, &settings)?;
            pixels.extend(
                bytemuck::pod_collect_to_vec::<u8, [f32; 4]>(&bytes).iter().map(|[r, g, b, _]| [*r, *g, *b]),
            );
            progress(f64::from(row + settings.rows) / f64::from(height));
        }
        if let Some(index) =
            pixels.iter().position(|pixel: &[f32; 3]| !pixel.iter().all(|value| value.is_finite()))
        {
            let (column, row) = (index as u32 % width, index as u32 / width);
            return Err(RenderError::NotFinite { column, row, adapter: self.info().name.clone() });
        }
        Ok(Image { width, height, pixels })
    }

    fn render_kernel(
        &self,
        table: &Table,
        objects: &[RenderObject],
        lights: &[RenderLight],
        vertices: &[[f32; 4]],
        positions: &[[f32; 2]],
        band_pixels: u32,
    ) -> Result<Kernel, DeviceError> {
        let device = self.device();
        let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(format!("{}{}", crate::WGSL_INCLUDE, crate::WGSL_RENDER).into()),
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &module,
            entry_point: Some("render"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let storage = |contents: &[u8]| {
            // A binding must hold at least one element of its array; no index reaches this one.
            let contents = if contents.is_empty() { &[0; size_of::<RenderObject>()] } else { contents };
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: None,
                contents,
                usage: wgpu::BufferUsages::STORAGE,
            })
        };
        let buffer = |size: u64, usage: wgpu::BufferUsages| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let settings = buffer(
            size_of::<RenderSettings>() as u64,
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        );
        let size = 16 * u64::from(band_pixels);
        let output = buffer(size, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let readback = buffer(size, wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ);
        let inputs = [
            storage(bytemuck::cast_slice(objects)),
            storage(bytemuck::cast_slice(lights)),
            storage(bytemuck::cast_slice(vertices)),
            storage(bytemuck::cast_slice(positions)),
        ];
        let (view, sampler) = self.upload_table(table);
        let buffers = std::iter::once(&settings).chain(&inputs).chain([&output]);
        let resources = buffers
            .map(wgpu::Buffer::as_entire_binding)
            .chain([wgpu::BindingResource::TextureView(&view), wgpu::BindingResource::Sampler(&sampler)]);
        let entries: Vec<wgpu::BindGroupEntry> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        match pollster::block_on(scope.pop()) {
            Some(error) => Err(self.failed(error.to_string())),
            None => Ok(Kernel { pipeline, group, settings, output, readback }),
        }
    }

    fn render_band(&self, kernel: &Kernel, settings: &RenderSettings) -> Result<Vec<u8>, DeviceError> {
        let scope = self.device().push_error_scope(wgpu::ErrorFilter::Validation);
        self.queue().write_buffer(&kernel.settings, 0, bytemuck::bytes_of(settings));
        let pixels = settings.width * settings.rows;
        let size = 16 * u64::from(pixels);
        let mut encoder = self.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&kernel.pipeline);
            pass.set_bind_group(0, &kernel.group, &[]);
            pass.dispatch_workgroups(pixels.div_ceil(64), 1, 1);
        }
        encoder.copy_buffer_to_buffer(&kernel.output, 0, &kernel.readback, 0, size);
        self.queue().submit([encoder.finish()]);
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(self.failed(error.to_string()));
        }
        kernel.readback.slice(..size).map_async(wgpu::MapMode::Read, |_| ());
        self.device()
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|error| self.failed(error.to_string()))?;
        let view = kernel.readback.slice(..size).get_mapped_range();
        let bytes = view.map_err(|error| self.failed(error.to_string()))?.to_vec();
        kernel.readback.unmap();
        Ok(bytes)
    }

    fn failed(&self, reason: String) -> DeviceError {
        DeviceError::Failed { adapter: self.info().name.clone(), reason }
    }
}

/// The pipeline of `wgsl/render.wgsl` with its buffers, for any number of bands.
struct Kernel {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    settings: wgpu::Buffer,
    output: wgpu::Buffer,
    readback: wgpu::Buffer,
}
