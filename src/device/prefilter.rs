//! Pyramids of blurred images, made on a device.

use bytemuck::pod_collect_to_vec;
use half::f16;
use wgpu::util::DeviceExt;

use super::{Device, DeviceError};
use crate::texture::{Level, Prefiltered};

/// Bytes of an RGBA16F texel.
const TEXEL: u32 = 8;

impl Device {
    /// [`prefilter`](crate::texture::prefilter) by the kernel of `wgsl/prefilter.wgsl`, with levels in half precision.
    ///
    /// # Errors
    ///
    /// If the device refuses the program or a texture of this size, or is lost.
    ///
    /// # Panics
    ///
    /// If a side is zero, or there are not `width` · `height` texels.
    pub fn prefilter(
        &self,
        width: usize,
        height: usize,
        image: &[[f32; 4]],
    ) -> Result<Prefiltered, DeviceError> {
        assert!(width > 0 && height > 0 && image.len() == width * height, "not {width} x {height} texels");
        let scope = self.device().push_error_scope(wgpu::ErrorFilter::Validation);
        let last = width.max(height).ilog2();
        let sizes: Vec<[u32; 2]> =
            (0..=last).map(|level| [width, height].map(|side| (side >> level).max(1) as u32)).collect();
        let first = Level { width, height, texels: image.to_vec() };
        let textures: Vec<wgpu::Texture> = sizes
            .iter()
            .enumerate()
            .map(|(level, size)| self.level(*size, (level == 0).then_some(&first)))
            .collect();
        let module = self.device().create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(crate::WGSL_PREFILTER.into()),
        });
        let pipeline = |entry_point| {
            self.device().create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: None,
                layout: None,
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        };
        let (reduce, average) = (pipeline("reduce"), pipeline("average"));
        let mut encoder = self.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        for level in 1..textures.len() {
            let top = level + 1 == textures.len();
            let (pipeline, finer) = if top { (&average, 0) } else { (&reduce, level - 1) };
            let views = [finer, level]
                .map(|index| textures[index].create_view(&wgpu::TextureViewDescriptor::default()));
            let entries: Vec<_> = views
                .iter()
                .enumerate()
                .map(|(binding, view)| wgpu::BindGroupEntry {
                    binding: binding as u32,
                    resource: wgpu::BindingResource::TextureView(view),
                })
                .collect();
            let group = self.device().create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &pipeline.get_bind_group_layout(0),
                entries: &entries,
            });
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &group, &[]);
            let [x, y] = if top { [1; 2] } else { sizes[level].map(|side| side.div_ceil(8)) };
            pass.dispatch_workgroups(x, y, 1);
        }
        let readbacks: Vec<wgpu::Buffer> = textures
            .iter()
            .zip(&sizes)
            .map(|(texture, size)| self.read_back(&mut encoder, texture, *size))
            .collect();
        self.queue().submit([encoder.finish()]);
        let failed = |reason: String| {
            let reason = reason.split_whitespace().collect::<Vec<_>>().join(" ");
            DeviceError::Failed { adapter: self.info().name.clone(), reason }
        };
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(failed(error.to_string()));
        }
        for buffer in &readbacks {
            buffer.slice(..).map_async(wgpu::MapMode::Read, |_| ());
        }
        self.device().poll(wgpu::PollType::wait_indefinitely()).map_err(|error| failed(error.to_string()))?;
        let mut levels = vec![first];
        for (buffer, [width, height]) in readbacks.iter().zip(&sizes).skip(1) {
            let bytes = buffer.slice(..).get_mapped_range().map_err(|error| failed(error.to_string()))?;
            let rows = bytes.chunks_exact(row_length(*width) as usize);
            let texels = rows
                .flat_map(|row| pod_collect_to_vec::<u8, [u16; 4]>(&row[..(width * TEXEL) as usize]))
                .map(|texel| texel.map(|bits| f16::from_bits(bits).to_f32()))
                .collect();
            levels.push(Level { width: *width as usize, height: *height as usize, texels });
        }
        Ok(Prefiltered::from_levels(levels))
    }

    /// A texture of one level, filled with `contents` if there are any.
    fn level(&self, [width, height]: [u32; 2], contents: Option<&Level>) -> wgpu::Texture {
        let descriptor = wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba16Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::STORAGE_BINDING
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        };
        match contents {
            Some(level) => self.device().create_texture_with_data(
                self.queue(),
                &descriptor,
                wgpu::util::TextureDataOrder::LayerMajor,
                &level.bytes(),
            ),
            None => self.device().create_texture(&descriptor),
        }
    }

    /// Asks for a copy of a texture in a buffer that can be mapped.
    fn read_back(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        texture: &wgpu::Texture,
        [width, height]: [u32; 2],
    ) -> wgpu::Buffer {
        let buffer = self.device().create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row_length(width)) * u64::from(height),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row_length(width)),
                    rows_per_image: None,
                },
            },
            texture.size(),
        );
        buffer
    }
}

/// Bytes of a row in a buffer, which copies want aligned.
fn row_length(width: u32) -> u32 {
    (width * TEXEL).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
}
