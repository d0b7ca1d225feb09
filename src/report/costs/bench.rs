//! Dispatches that are timed.

use std::borrow::Cow;
use std::time::Instant;

use wgpu::util::DeviceExt;

use super::CostsError;
use crate::TABLE_SIZE;
use crate::effects::Effects;
use crate::translate::kernel_spirv;

/// Which adapter to measure on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Adapter {
    /// A graphics processor; never one that is imitated.
    Hardware,
    /// One that is imitated on the processor: Mesa's lavapipe.
    Software,
    /// The one whose name or driver's name holds this text, whatever its case.
    Named(String),
}

/// What is bound to a program, in the order of its bindings.
#[derive(Clone, Debug)]
pub enum Bound {
    /// A buffer that is read.
    Input(Vec<u8>),
    /// A buffer of so many bytes that is written.
    Output(u64),
    /// Layers of 64 × 64 RGBA16F texels.
    Table(Vec<u8>),
    /// A sampler that filters linearly.
    Sampler,
}

/// A program that is timed.
#[derive(Clone, Debug)]
pub struct Job {
    /// WGSL.
    pub source: String,
    /// The compute entry point, of workgroups of 64.
    pub entry_point: &'static str,
    /// The include's switches.
    pub effects: Effects,
    /// What is bound.
    pub bound: Vec<Bound>,
}

/// A program that is ready to run.
pub struct Prepared {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
}

/// An open device.
pub struct Bench {
    device: wgpu::Device,
    queue: wgpu::Queue,
    info: wgpu::AdapterInfo,
}

impl Bench {
    /// Opens an adapter.
    ///
    /// # Errors
    ///
    /// If there is none of the kind.
    pub fn open(wanted: &Adapter) -> Result<Self, CostsError> {
        let backends = wgpu::Backends::PRIMARY;
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = backends;
        descriptor.flags = wgpu::InstanceFlags::empty();
        let instance = wgpu::Instance::new(descriptor);
        let adapters = pollster::block_on(instance.enumerate_adapters(backends));
        let names: Vec<String> = adapters.iter().map(|adapter| adapter.get_info().name).collect();
        let is_wanted = |adapter: &wgpu::Adapter| {
            let info = adapter.get_info();
            let hardware = matches!(
                info.device_type,
                wgpu::DeviceType::DiscreteGpu
                    | wgpu::DeviceType::IntegratedGpu
                    | wgpu::DeviceType::VirtualGpu
            );
            match wanted {
                Adapter::Hardware => hardware,
                Adapter::Software => info.device_type == wgpu::DeviceType::Cpu,
                Adapter::Named(name) => {
                    let name = name.to_lowercase();
                    info.name.to_lowercase().contains(&name) || info.driver.to_lowercase().contains(&name)
                }
            }
        };
        let adapter = adapters.into_iter().filter(is_wanted).min_by_key(|adapter| {
            // Whole graphics processors before parts of others.
            adapter.get_info().device_type != wgpu::DeviceType::DiscreteGpu
        });
        let Some(adapter) = adapter else {
            let kind = match wanted {
                Adapter::Hardware => "graphics processor".to_owned(),
                Adapter::Software => {
                    "adapter on the processor (Mesa's lavapipe, Debian package mesa-vulkan-drivers)"
                        .to_owned()
                }
                Adapter::Named(name) => format!("adapter named {name:?}"),
            };
            let there = if names.is_empty() { "nothing".to_owned() } else { names.join(", ") };
            return Err(CostsError::Device(format!("there is no {kind} to measure on; there is {there}")));
        };
        let info = adapter.get_info();
        let useful = wgpu::Features::PASSTHROUGH_SHADERS | wgpu::Features::TIMESTAMP_QUERY;
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: None,
            required_features: adapter.features() & useful,
            required_limits: adapter.limits(),
            // SAFETY: the one experimental feature used is the hand-over of shaders, which are the project's own.
            experimental_features: unsafe { wgpu::ExperimentalFeatures::enabled() },
            memory_hints: wgpu::MemoryHints::default(),
            trace: wgpu::Trace::Off,
        }))
        .map_err(|error| CostsError::Device(format!("{} refused a device: {error}", info.name)))?;
        Ok(Self { device, queue, info })
    }

    /// The adapter's name and its driver's, with its version.
    pub fn name(&self) -> String {
        format!("{}, {} {}", self.info.name, self.info.driver, self.info.driver_info).trim_end().to_owned()
    }

    /// The adapter.
    pub fn info(&self) -> &wgpu::AdapterInfo {
        &self.info
    }

    fn failed(&self, reason: impl core::fmt::Display) -> CostsError {
        let reason = reason.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
        CostsError::Device(format!("{} could not run the kernel: {reason}", self.info.name))
    }

    fn module(&self, job: &Job) -> Result<wgpu::ShaderModule, CostsError> {
        let vulkan = self.info.backend == wgpu::Backend::Vulkan;
        if vulkan && self.device.features().contains(wgpu::Features::PASSTHROUGH_SHADERS) {
            let spirv = kernel_spirv(&job.source, job.entry_point, job.effects)?;
            let words: Vec<u32> = bytemuck::pod_collect_to_vec(&spirv);
            let descriptor = wgpu::ShaderModuleDescriptorPassthrough {
                label: None,
                entry_points: Cow::Owned(vec![wgpu::PassthroughShaderEntryPoint {
                    name: job.entry_point.into(),
                    workgroup_size: (64, 1, 1),
                }]),
                spirv: Some(Cow::Owned(words)),
                ..Default::default()
            };
            // SAFETY: naga has validated the module; its indices stay within the buffers that it is given.
            return Ok(unsafe { self.device.create_shader_module_passthrough(descriptor) });
        }
        let source = wgpu::ShaderSource::Wgsl(Cow::Borrowed(&job.source));
        let descriptor = wgpu::ShaderModuleDescriptor { label: None, source };
        // SAFETY: as above; checks would be measured with it.
        Ok(unsafe {
            self.device.create_shader_module_trusted(descriptor, wgpu::ShaderRuntimeChecks::unchecked())
        })
    }

    fn resource(&self, bound: &Bound) -> (wgpu::BindingType, Resource) {
        let buffer = |read_only| wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only },
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        match bound {
            Bound::Input(bytes) => {
                let usage = wgpu::BufferUsages::STORAGE;
                let descriptor = wgpu::util::BufferInitDescriptor { label: None, contents: bytes, usage };
                (buffer(true), Resource::Buffer(self.device.create_buffer_init(&descriptor)))
            }
            Bound::Output(size) => {
                let usage = wgpu::BufferUsages::STORAGE;
                let descriptor =
                    wgpu::BufferDescriptor { label: None, size: *size, usage, mapped_at_creation: false };
                (buffer(false), Resource::Buffer(self.device.create_buffer(&descriptor)))
            }
            Bound::Table(bytes) => {
                let size = TABLE_SIZE as u32;
                let layers = (bytes.len() / (8 * TABLE_SIZE * TABLE_SIZE)) as u32;
                let texture = self.device.create_texture_with_data(
                    &self.queue,
                    &wgpu::TextureDescriptor {
                        label: None,
                        size: wgpu::Extent3d { width: size, height: size, depth_or_array_layers: layers },
                        mip_level_count: 1,
                        sample_count: 1,
                        dimension: wgpu::TextureDimension::D2,
                        format: wgpu::TextureFormat::Rgba16Float,
                        usage: wgpu::TextureUsages::TEXTURE_BINDING,
                        view_formats: &[],
                    },
                    wgpu::util::TextureDataOrder::LayerMajor,
                    bytes,
                );
                let kind = wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Float { filterable: true },
                    view_dimension: wgpu::TextureViewDimension::D2Array,
                    multisampled: false,
                };
                let dimension = Some(wgpu::TextureViewDimension::D2Array);
                let view = wgpu::TextureViewDescriptor { dimension, ..Default::default() };
                (kind, Resource::View(texture.create_view(&view)))
            }
            Bound::Sampler => {
                let sampler = self.device.create_sampler(&wgpu::SamplerDescriptor {
                    mag_filter: wgpu::FilterMode::Linear,
                    min_filter: wgpu::FilterMode::Linear,
                    ..Default::default()
                });
                (wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering), Resource::Sampler(sampler))
            }
        }
    }

    /// Compiles a program and makes what is bound to it.
    ///
    /// # Errors
    ///
    /// If the device refuses it.
    pub fn prepare(&self, job: &Job) -> Result<Prepared, CostsError> {
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let module = self.module(job)?;
        let resources: Vec<_> = job.bound.iter().map(|bound| self.resource(bound)).collect();
        let layouts: Vec<_> = (0_u32..)
            .zip(&resources)
            .map(|(binding, (kind, _))| wgpu::BindGroupLayoutEntry {
                binding,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: *kind,
                count: None,
            })
            .collect();
        let layout = self
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries: &layouts });
        let entries: Vec<_> = (0_u32..)
            .zip(&resources)
            .map(|(binding, (_, resource))| wgpu::BindGroupEntry {
                binding,
                resource: match resource {
                    Resource::Buffer(buffer) => buffer.as_entire_binding(),
                    Resource::View(view) => wgpu::BindingResource::TextureView(view),
                    Resource::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
                },
            })
            .collect();
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &layout,
            entries: &entries,
        });
        let pipeline_layout = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        // An override that the text does not have is an error.
        let has = |name: &str| job.source.contains(&format!("override {name}:"));
        let switches = job.effects.switches().filter(|(name, _)| has(name));
        let constants: Vec<_> = switches.map(|(name, on)| (name, f64::from(u8::from(on)))).collect();
        let pipeline = self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some(job.entry_point),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &constants,
                ..Default::default()
            },
            cache: None,
        });
        match pollster::block_on(scope.pop()) {
            Some(error) => Err(self.failed(error)),
            None => Ok(Prepared { pipeline, group }),
        }
    }

    fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        prepared: &Prepared,
        invocations: u32,
        dispatches: u32,
        timestamps: Option<wgpu::ComputePassTimestampWrites>,
    ) {
        let descriptor = wgpu::ComputePassDescriptor { label: None, timestamp_writes: timestamps };
        let mut pass = encoder.begin_compute_pass(&descriptor);
        pass.set_pipeline(&prepared.pipeline);
        pass.set_bind_group(0, &prepared.group, &[]);
        for _ in 0..dispatches {
            pass.dispatch_workgroups(invocations.div_ceil(64), 1, 1);
        }
    }

    /// Runs dispatches of so many invocations and returns the nanoseconds from their submission to their end.
    ///
    /// # Errors
    ///
    /// If the device is lost.
    pub fn run(&self, prepared: &Prepared, invocations: u32, dispatches: u32) -> Result<f64, CostsError> {
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.record(&mut encoder, prepared, invocations, dispatches, None);
        let commands = encoder.finish();
        let start = Instant::now();
        self.queue.submit([commands]);
        self.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| self.failed(error))?;
        Ok(start.elapsed().as_secs_f64() * 1e9)
    }

    /// The same for several programs, one after the other, by the device's own clock.
    ///
    /// # Errors
    ///
    /// If it has none, or is lost.
    pub fn run_by_its_clock(&self, each: &[(&Prepared, u32, u32)]) -> Result<Vec<f64>, CostsError> {
        if !self.device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return Err(self.failed("it has no timestamp queries"));
        }
        let count = 2 * each.len() as u32;
        let queries = self.device.create_query_set(&wgpu::QuerySetDescriptor {
            label: None,
            ty: wgpu::QueryType::Timestamp,
            count,
        });
        let buffer = |usage| {
            let size = 8 * u64::from(count);
            self.device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let resolved = buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC);
        let read = buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        for (at, (prepared, invocations, dispatches)) in (0_u32..).zip(each) {
            let timestamps = wgpu::ComputePassTimestampWrites {
                query_set: &queries,
                beginning_of_pass_write_index: Some(2 * at),
                end_of_pass_write_index: Some(2 * at + 1),
            };
            self.record(&mut encoder, prepared, *invocations, *dispatches, Some(timestamps));
        }
        encoder.resolve_query_set(&queries, 0..count, &resolved, 0);
        encoder.copy_buffer_to_buffer(&resolved, 0, &read, 0, read.size());
        self.queue.submit([encoder.finish()]);
        read.slice(..).map_async(wgpu::MapMode::Read, |_| ());
        self.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| self.failed(error))?;
        let bytes = read.slice(..).get_mapped_range().map_err(|error| self.failed(error))?.to_vec();
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
        let period = f64::from(self.queue.get_timestamp_period());
        Ok(ticks.chunks_exact(2).map(|pair| pair[1].saturating_sub(pair[0]) as f64 * period).collect())
    }
}

enum Resource {
    Buffer(wgpu::Buffer),
    View(wgpu::TextureView),
    Sampler(wgpu::Sampler),
}
