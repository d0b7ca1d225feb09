//! Adapters, programs and dispatches.

use std::borrow::Cow;

/// Why nothing could be evaluated on a device.
#[derive(Debug, thiserror::Error)]
pub enum DeviceError {
    /// No adapter for the wanted API.
    #[error(
        "no graphics adapter for {0} was found; Mesa's lavapipe (Debian package mesa-vulkan-drivers) is one that needs no GPU"
    )]
    NoAdapter(String),
    /// The adapter gave no device.
    #[error("the adapter {adapter} refused a device: {reason}")]
    Refused {
        /// The adapter's name.
        adapter: String,
        /// What it said.
        reason: String,
    },
    /// The device refused a program or a dispatch.
    #[error("the device {adapter} could not run the shader: {reason}")]
    Failed {
        /// The adapter's name.
        adapter: String,
        /// What it said.
        reason: String,
    },
}

/// A shader in one of the forms that a device takes.
#[derive(Clone, Debug)]
pub struct Program(Source);

#[derive(Clone, Debug)]
enum Source {
    Wgsl(String),
    SpirV(Vec<u8>, &'static str),
    Glsl(String),
}

impl Program {
    /// WGSL text; wgpu adds its own checks of indices and loops.
    pub fn wgsl(text: String) -> Self {
        Self(Source::Wgsl(text))
    }

    /// SPIR-V bytes with an entry point of the given name, handed to Vulkan as they are.
    ///
    /// # Safety
    ///
    /// The module must be valid, index nothing beyond the buffers that it will be given, and end.
    pub unsafe fn spirv(bytes: Vec<u8>, entry_point: &'static str) -> Self {
        Self(Source::SpirV(bytes, entry_point))
    }

    /// GLSL text with the entry point `main`, handed to OpenGL as it is.
    ///
    /// # Safety
    ///
    /// As for [`Program::spirv`].
    pub unsafe fn glsl(text: String) -> Self {
        Self(Source::Glsl(text))
    }
}

/// An open device.
pub struct Device {
    device: wgpu::Device,
    queue: wgpu::Queue,
    info: wgpu::AdapterInfo,
}

impl TryFrom<wgpu::Adapter> for Device {
    type Error = DeviceError;

    fn try_from(adapter: wgpu::Adapter) -> Result<Self, DeviceError> {
        let info = adapter.get_info();
        let features = adapter.features() & wgpu::Features::PASSTHROUGH_SHADERS;
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: None,
            required_features: features,
            required_limits: adapter.limits(),
            // SAFETY: the one experimental feature used is the hand-over of shaders, whose contract
            // `compute` keeps.
            experimental_features: unsafe { wgpu::ExperimentalFeatures::enabled() },
            memory_hints: wgpu::MemoryHints::default(),
            trace: wgpu::Trace::Off,
        }))
        .map_err(|error| DeviceError::Refused { adapter: info.name.clone(), reason: error.to_string() })?;
        Ok(Self { device, queue, info })
    }
}

impl Device {
    /// Opens the first adapter of the given API, a GPU before a CPU.
    ///
    /// # Errors
    ///
    /// If there is none or it refuses.
    pub fn open(backends: wgpu::Backends) -> Result<Self, DeviceError> {
        Self::adapters(backends)?.swap_remove(0).try_into()
    }

    /// Opens every adapter of the given APIs, GPUs before CPUs.
    ///
    /// # Errors
    ///
    /// If there is none or one refuses.
    pub fn every(backends: wgpu::Backends) -> Result<Vec<Self>, DeviceError> {
        Self::adapters(backends)?.into_iter().map(Self::try_from).collect()
    }

    /// At least one adapter, GPUs before CPUs.
    fn adapters(backends: wgpu::Backends) -> Result<Vec<wgpu::Adapter>, DeviceError> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = backends;
        let instance = wgpu::Instance::new(descriptor);
        let mut adapters = pollster::block_on(instance.enumerate_adapters(backends));
        let rank = |adapter: &wgpu::Adapter| match adapter.get_info().device_type {
            wgpu::DeviceType::DiscreteGpu => 0,
            wgpu::DeviceType::IntegratedGpu => 1,
            wgpu::DeviceType::VirtualGpu => 2,
            wgpu::DeviceType::Other => 3,
            wgpu::DeviceType::Cpu => 4,
        };
        adapters.sort_by_key(rank);
        if adapters.is_empty() {
            return Err(DeviceError::NoAdapter(format!("{backends:?}")));
        }
        Ok(adapters)
    }

    /// The adapter's name, driver and kind.
    pub fn info(&self) -> &wgpu::AdapterInfo {
        &self.info
    }

    /// The wgpu device.
    pub fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// The wgpu queue.
    pub fn queue(&self) -> &wgpu::Queue {
        &self.queue
    }

    fn module(&self, program: &Program, workgroup_size: (u32, u32, u32)) -> wgpu::ShaderModule {
        let passthrough = |name: &'static str, spirv: Option<Vec<u32>>, glsl: Option<String>| {
            let descriptor = wgpu::ShaderModuleDescriptorPassthrough {
                label: None,
                entry_points: Cow::Owned(vec![wgpu::PassthroughShaderEntryPoint {
                    name: name.into(),
                    workgroup_size,
                }]),
                spirv: spirv.map(Cow::Owned),
                glsl: glsl.map(Cow::Owned),
                ..Default::default()
            };
            // SAFETY: whoever made the program answers for it, see `Program::spirv`.
            unsafe { self.device.create_shader_module_passthrough(descriptor) }
        };
        match &program.0 {
            Source::Wgsl(text) => self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: None,
                source: wgpu::ShaderSource::Wgsl(text.into()),
            }),
            Source::SpirV(bytes, entry_point) => {
                let words = bytes
                    .chunks_exact(4)
                    .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
                    .collect();
                passthrough(entry_point, Some(words), None)
            }
            Source::Glsl(text) => passthrough("main", None, Some(text.clone())),
        }
    }

    /// Binds `resources` in the order of their bindings, runs one dispatch of workgroups of 64 × 1,
    /// and reads `output` back.
    ///
    /// # Errors
    ///
    /// If the device refuses the program or is lost.
    pub fn compute(
        &self,
        program: &Program,
        entry_point: &str,
        resources: &[wgpu::BindingResource],
        groups: [u32; 2],
        output: &wgpu::Buffer,
    ) -> Result<Vec<u8>, DeviceError> {
        let failed = |reason: String| {
            // wgpu's reasons run over several lines.
            let reason = reason.split_whitespace().collect::<Vec<_>>().join(" ");
            DeviceError::Failed { adapter: self.info.name.clone(), reason }
        };
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let module = self.module(program, (64, 1, 1));
        let last_buffer =
            resources.iter().rposition(|resource| matches!(resource, wgpu::BindingResource::Buffer(_)));
        let layout_entries: Vec<wgpu::BindGroupLayoutEntry> = resources
            .iter()
            .enumerate()
            .map(|(index, resource)| wgpu::BindGroupLayoutEntry {
                binding: index as u32,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: match resource {
                    wgpu::BindingResource::TextureView(_) => wgpu::BindingType::Texture {
                        sample_type: wgpu::TextureSampleType::Float { filterable: true },
                        view_dimension: wgpu::TextureViewDimension::D2Array,
                        multisampled: false,
                    },
                    wgpu::BindingResource::Sampler(_) => {
                        wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)
                    }
                    _ => wgpu::BindingType::Buffer {
                        ty: wgpu::BufferBindingType::Storage { read_only: Some(index) != last_buffer },
                        has_dynamic_offset: false,
                        min_binding_size: None,
                    },
                },
                count: None,
            })
            .collect();
        let layout = self.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &layout_entries,
        });
        let pipeline_layout = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let entry_point = match &program.0 {
            Source::Glsl(_) => "main",
            Source::SpirV(_, name) => name,
            Source::Wgsl(_) => entry_point,
        };
        let pipeline = self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some(entry_point),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let entries: Vec<wgpu::BindGroupEntry> = resources
            .iter()
            .enumerate()
            .map(|(index, resource)| wgpu::BindGroupEntry {
                binding: index as u32,
                resource: resource.clone(),
            })
            .collect();
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &layout,
            entries: &entries,
        });
        let readback = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: output.size(),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups(groups[0], groups[1], 1);
        }
        encoder.copy_buffer_to_buffer(output, 0, &readback, 0, output.size());
        self.queue.submit([encoder.finish()]);
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(failed(error.to_string()));
        }
        readback.slice(..).map_async(wgpu::MapMode::Read, |_| ());
        self.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| failed(error.to_string()))?;
        let bytes =
            readback.slice(..).get_mapped_range().map_err(|error| failed(error.to_string()))?.to_vec();
        Ok(bytes)
    }
}
