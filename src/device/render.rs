//! Pictures of scenes by the include.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;
use wgpu::util::DeviceExt;

use super::{Device, DeviceError, EvaluateLight};
use crate::effects::{Effect, Effects};
use crate::scene::{Image, Light, Object, Scene, SceneError, Shape, sample_positions};
use crate::table::{Layer, Table};
use crate::texture::{Prefiltered, prefilter};

/// Why a scene was not drawn.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The scene calls for effects that were left out.
    #[error(transparent)]
    Effects(#[from] SceneError),
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
    sheen_layer: i32,
    diffuse_layer: i32,
    anisotropic_layer: i32,
    lobes_layer: i32,
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
    diffuse_roughness: f32,
    roughness_start: [f32; 3],
    coat: f32,
    roughness_gradient: [f32; 3],
    coat_roughness: f32,
    sheen_colour: [f32; 3],
    sheen_roughness: f32,
    grain: [f32; 3],
    anisotropy: f32,
    coat_reflectance: f32,
    spare: [f32; 3],
}

#[derive(Clone, Copy, Default, Pod, Zeroable)]
#[repr(C)]
struct RenderLight {
    radiance: [f32; 3],
    picture: u32,
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
            diffuse_roughness: material.diffuse_roughness as f32,
            roughness_start: single(material.roughness.start),
            coat: material.coat as f32,
            roughness_gradient: single(material.roughness.gradient),
            coat_roughness: material.coat_roughness as f32,
            sheen_colour: single(material.sheen_colour),
            sheen_roughness: material.sheen_roughness as f32,
            grain: single(material.grain),
            anisotropy: material.anisotropy as f32,
            coat_reflectance: material.coat_reflectance as f32,
            spare: [0.0; 3],
        }
    }
}

impl RenderLight {
    /// Adds the light's vectors to `vertices` and its picture to `pictures`.
    fn new<'a>(light: &'a Light, vertices: &mut Vec<[f32; 4]>, pictures: &mut Vec<&'a Prefiltered>) -> Self {
        pictures.extend(&light.picture);
        Self {
            shape: EvaluateLight::new(&light.shape, vertices),
            radiance: single(light.radiance),
            picture: if light.picture.is_some() { pictures.len() as u32 } else { 0 },
            normal: single(light.normal),
            spare_b: 0,
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

    /// Draws a scene with as much of the include as it calls for, see [`Scene::effects`]: linear radiance, each pixel
    /// the mean of its samples. `progress` hears the share that is done after each band of rows. What `table` lacks
    /// of the layers comes from the embedded ones.
    ///
    /// # Errors
    ///
    /// If the device fails, the size is out of range, or a pixel is not finite.
    ///
    /// # Panics
    ///
    /// If `table` lacks layers and has another size than the embedded ones, or more than [`Scene::MOST_PICTURES`]
    /// lights have a picture.
    pub fn render(
        &self,
        table: &Table,
        scene: &Scene,
        size: [u32; 2],
        samples: u32,
        progress: &dyn Fn(f64),
    ) -> Result<Image, RenderError> {
        self.render_with(table, scene, scene.effects(), size, samples, progress)
    }

    /// The same with the effects of a given set, which may have more than the scene calls for. Energy compensation and
    /// what belongs to a quality level change the picture even of a scene that does not call for them.
    ///
    /// # Errors
    ///
    /// As [`Device::render`], or if the scene calls for an effect that the set lacks.
    ///
    /// # Panics
    ///
    /// As [`Device::render`].
    pub fn render_with(
        &self,
        table: &Table,
        scene: &Scene,
        effects: Effects,
        [width, height]: [u32; 2],
        samples: u32,
        progress: &dyn Fn(f64),
    ) -> Result<Image, RenderError> {
        scene.check_effects(effects)?;
        let constants: Vec<(&str, f64)> =
            effects.switches().map(|(name, on)| (name, f64::from(u8::from(on)))).collect();
        let image = self.draw(
            &format!("{}{}", crate::WGSL_INCLUDE, crate::WGSL_RENDER),
            &constants,
            &needed_layers(table, effects),
            scene,
            effects,
            [width, height],
            samples,
            progress,
        )?;
        if let Some(index) =
            image.pixels.iter().position(|pixel| !pixel.iter().all(|value| value.is_finite()))
        {
            let (column, row) = (index as u32 % width, index as u32 / width);
            return Err(RenderError::NotFinite { column, row, adapter: self.info().name.clone() });
        }
        Ok(image)
    }

    /// Draws a scene by the text of a module with the kernel of `wgsl/render.wgsl`, its overrides, and the table that it
    /// reads, whatever the pixels are.
    #[allow(clippy::too_many_arguments, reason = "each is a part of what the kernel reads")]
    pub(crate) fn draw(
        &self,
        text: &str,
        constants: &[(&str, f64)],
        table: &Table,
        scene: &Scene,
        effects: Effects,
        [width, height]: [u32; 2],
        samples: u32,
        progress: &dyn Fn(f64),
    ) -> Result<Image, RenderError> {
        let sides = 1..=16384;
        if !(sides.contains(&width) && sides.contains(&height) && (1..=4096).contains(&samples)) {
            return Err(RenderError::Size { width, height, samples });
        }
        let (mut vertices, mut pictures) = (Vec::new(), Vec::new());
        let lights: Vec<RenderLight> =
            scene.lights.iter().map(|light| RenderLight::new(light, &mut vertices, &mut pictures)).collect();
        assert!(pictures.len() <= Scene::MOST_PICTURES, "{} lights have pictures", pictures.len());
        let layer = |layer: Layer| table.index(layer).map_or(0, |index| index as i32);
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
            sheen_layer: layer(Layer::Sheen),
            diffuse_layer: layer(Layer::Diffuse),
            anisotropic_layer: layer(Layer::AnisotropicFirst),
            lobes_layer: layer(if effects.contains(Effect::ThirdLobe) {
                Layer::FirstOfThree
            } else {
                Layer::FirstOfTwo
            }),
            spare: [0; 2],
        };
        let row_work = u64::from(width) * u64::from(samples) * (1 + vertices.len() + objects.len()) as u64;
        let band = (BAND_WORK / row_work).clamp(1, u64::from(height)) as u32;
        let mut pixels = Vec::with_capacity(width as usize * height as usize);
        let positions = sample_positions(samples);
        let inputs = [
            bytemuck::cast_slice(&objects),
            bytemuck::cast_slice(&lights),
            bytemuck::cast_slice(&vertices),
            bytemuck::cast_slice(&positions),
        ];
        let kernel = self.render_kernel((text, constants), table, &pictures, inputs, width * band)?;
        for row in (0..height).step_by(band as usize) {
            settings.row = row;
            settings.rows = band.min(height - row);
            let bytes = self.render_band(&kernel, &settings)?;
            pixels.extend(
                bytemuck::pod_collect_to_vec::<u8, [f32; 4]>(&bytes).iter().map(|[r, g, b, _]| [*r, *g, *b]),
            );
            progress(f64::from(row + settings.rows) / f64::from(height));
        }
        Ok(Image { width, height, pixels })
    }

    fn render_kernel(
        &self,
        (text, constants): (&str, &[(&str, f64)]),
        table: &Table,
        pictures: &[&Prefiltered],
        inputs: [&[u8]; 4],
        band_pixels: u32,
    ) -> Result<Kernel, DeviceError> {
        let device = self.device();
        let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(text.into()),
        });
        let mut constants = constants.to_vec();
        constants.push(("render_pictures", pictures.len() as f64));
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &module,
            entry_point: Some("render"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &constants,
                ..wgpu::PipelineCompilationOptions::default()
            },
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
        let inputs = inputs.map(storage);
        let (view, sampler) = self.upload_table(table);
        let nothing = prefilter(1, 1, &[[0.0; 4]]);
        let uploaded: [wgpu::TextureView; Scene::MOST_PICTURES] =
            std::array::from_fn(|index| self.upload_picture(pictures.get(index).unwrap_or(&&nothing)));
        let picture_sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let buffers = std::iter::once(&settings).chain(&inputs).chain([&output]);
        let resources = buffers
            .map(wgpu::Buffer::as_entire_binding)
            .chain([wgpu::BindingResource::TextureView(&view), wgpu::BindingResource::Sampler(&sampler)])
            .chain(uploaded.iter().map(wgpu::BindingResource::TextureView))
            .chain([wgpu::BindingResource::Sampler(&picture_sampler)]);
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

    /// A light's picture with its levels as mipmaps.
    fn upload_picture(&self, picture: &Prefiltered) -> wgpu::TextureView {
        let [width, height] = picture.texels().map(|side| side as u32);
        let descriptor = wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: picture.levels().len() as u32,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba16Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        };
        let order = wgpu::util::TextureDataOrder::LayerMajor;
        let texture =
            self.device().create_texture_with_data(self.queue(), &descriptor, order, &picture.bytes());
        texture.create_view(&wgpu::TextureViewDescriptor::default())
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

/// The layers that the effects read, and no other as long as there is one.
fn needed_layers(table: &Table, effects: Effects) -> Table {
    let needed = effects.layers();
    let completed = table.clone().completed(&needed);
    if needed.is_empty() { completed } else { completed.only(&needed) }
}

/// The pipeline of `wgsl/render.wgsl` with its buffers, for any number of bands.
struct Kernel {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    settings: wgpu::Buffer,
    output: wgpu::Buffer,
    readback: wgpu::Buffer,
}
