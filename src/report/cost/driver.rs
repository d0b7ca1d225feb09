//! The compiler within a Vulkan driver.

use std::ffi::{CStr, CString};

use ash::vk;

use super::{Binding, Compiler, Cost, CostError, Program, StageModule};

fn refused(what: &'static str) -> impl Fn(vk::Result) -> CostError {
    move |result| CostError::Refused { what, reason: result.to_string() }
}

/// Compiles programs by the first Vulkan driver that the environment names, and asks what came out. Of a program with a
/// fragment stage it is that one's cost.
///
/// # Errors
///
/// If there is no such driver, or it does not tell.
pub fn compile_programs(
    bindings: &[Binding],
    programs: &[Program],
) -> Result<(Compiler, Vec<Cost>), CostError> {
    // SAFETY: the loader is the system's own.
    let entry = unsafe { ash::Entry::load() }.map_err(|error| CostError::NoLoader(error.to_string()))?;
    let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_2);
    let create = vk::InstanceCreateInfo::default().application_info(&application);
    // SAFETY: what the structures point to outlives the call; the handle is destroyed below.
    let instance = unsafe { entry.create_instance(&create, None) }.map_err(refused("start"))?;
    // SAFETY: everything made from the instance is destroyed by then.
    let result = unsafe { compile_by(&instance, bindings, programs) };
    // SAFETY: as before.
    unsafe { instance.destroy_instance(None) };
    result
}

/// # Safety
///
/// The instance must be alive.
unsafe fn compile_by(
    instance: &ash::Instance,
    bindings: &[Binding],
    programs: &[Program],
) -> Result<(Compiler, Vec<Cost>), CostError> {
    // SAFETY, for all calls of this function: handles come from the calls before and are destroyed once,
    // at the end; what structures point to outlives the calls.
    unsafe {
        let devices = instance.enumerate_physical_devices().map_err(refused("list processors"))?;
        let physical = *devices.first().ok_or(CostError::NoDriver { folders: Vec::new() })?;
        let mut driver = vk::PhysicalDeviceDriverProperties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut driver);
        instance.get_physical_device_properties2(physical, &mut properties);
        let text = |name: Result<&CStr, _>| {
            name.map(|name: &CStr| name.to_string_lossy().into_owned()).unwrap_or_default()
        };
        let device = text(properties.properties.device_name_as_c_str());
        let driver =
            format!("{} {}", text(driver.driver_name_as_c_str()), text(driver.driver_info_as_c_str()));
        let reports = ash::khr::pipeline_executable_properties::NAME;
        let extensions =
            instance.enumerate_device_extension_properties(physical).map_err(refused("list extensions"))?;
        if !extensions.iter().any(|extension| extension.extension_name_as_c_str() == Ok(reports)) {
            return Err(CostError::NoStatistics { device });
        }
        let mut enabled = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default()
            .pipeline_executable_info(true);
        let priorities = [1.0];
        let queues = [vk::DeviceQueueCreateInfo::default().queue_priorities(&priorities)];
        let names = [reports.as_ptr()];
        let create = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queues)
            .enabled_extension_names(&names)
            .push_next(&mut enabled);
        let logical = instance.create_device(physical, &create, None).map_err(refused("make a device"))?;
        let statistics = ash::khr::pipeline_executable_properties::Device::new(instance, &logical);
        let compiling = Compiling { device: &logical, statistics: &statistics };
        let costs = programs.iter().map(|program| compiling.one(bindings, program)).collect();
        logical.destroy_device(None);
        Ok((Compiler { device, driver }, Result::from_iter::<Vec<_>>(costs)?))
    }
}

struct Compiling<'a> {
    device: &'a ash::Device,
    statistics: &'a ash::khr::pipeline_executable_properties::Device,
}

impl Compiling<'_> {
    /// # Safety
    ///
    /// The device must be alive.
    unsafe fn one(&self, bindings: &[Binding], program: &Program) -> Result<Cost, CostError> {
        let binding = |(index, kind): (usize, &Binding)| {
            vk::DescriptorSetLayoutBinding::default()
                .binding(index as u32)
                .descriptor_type(match kind {
                    Binding::Buffer => vk::DescriptorType::STORAGE_BUFFER,
                    Binding::Texture => vk::DescriptorType::SAMPLED_IMAGE,
                    Binding::Sampler => vk::DescriptorType::SAMPLER,
                })
                .descriptor_count(1)
                .stage_flags(vk::ShaderStageFlags::COMPUTE | vk::ShaderStageFlags::FRAGMENT)
        };
        let bindings: Vec<_> = bindings.iter().enumerate().map(binding).collect();
        // SAFETY: as in `compile_by`; after a failure what was made before goes with the device.
        unsafe {
            let create = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
            let sets = [self
                .device
                .create_descriptor_set_layout(&create, None)
                .map_err(refused("make a set's layout"))?];
            let create = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets);
            let layout =
                self.device.create_pipeline_layout(&create, None).map_err(refused("make a layout"))?;
            let (pipeline, stage) = match program {
                Program::Compute(module) => (self.compute(layout, module)?, vk::ShaderStageFlags::COMPUTE),
                Program::Fragment { vertex, fragment } => {
                    (self.graphics(layout, vertex, fragment)?, vk::ShaderStageFlags::FRAGMENT)
                }
            };
            let cost = self.cost(pipeline, stage);
            self.device.destroy_pipeline(pipeline, None);
            self.device.destroy_pipeline_layout(layout, None);
            self.device.destroy_descriptor_set_layout(sets[0], None);
            cost
        }
    }

    /// # Safety
    ///
    /// As for [`Self::one`]; the module is to be destroyed.
    unsafe fn module(&self, module: &StageModule) -> Result<(vk::ShaderModule, CString), CostError> {
        let words: Vec<u32> =
            module.spirv.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
        let create = vk::ShaderModuleCreateInfo::default().code(&words);
        let name = CString::new(module.entry_point.as_str()).unwrap_or_default();
        // SAFETY: as in `compile_by`.
        let module = unsafe { self.device.create_shader_module(&create, None) };
        Ok((module.map_err(refused("read SPIR-V"))?, name))
    }

    /// # Safety
    ///
    /// As for [`Self::one`]; the pipeline is to be destroyed.
    unsafe fn compute(
        &self,
        layout: vk::PipelineLayout,
        module: &StageModule,
    ) -> Result<vk::Pipeline, CostError> {
        // SAFETY: as in `compile_by`.
        unsafe {
            let (module, name) = self.module(module)?;
            let stage = vk::PipelineShaderStageCreateInfo::default()
                .stage(vk::ShaderStageFlags::COMPUTE)
                .module(module)
                .name(&name);
            let create = vk::ComputePipelineCreateInfo::default()
                .flags(vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR)
                .layout(layout)
                .stage(stage);
            let pipelines = self.device.create_compute_pipelines(vk::PipelineCache::null(), &[create], None);
            self.device.destroy_shader_module(module, None);
            Ok(pipelines.map_err(|(_, result)| refused("compile")(result))?[0])
        }
    }

    /// # Safety
    ///
    /// As for [`Self::one`]; the pipeline is to be destroyed.
    unsafe fn graphics(
        &self,
        layout: vk::PipelineLayout,
        vertex: &StageModule,
        fragment: &StageModule,
    ) -> Result<vk::Pipeline, CostError> {
        // SAFETY: as in `compile_by`.
        unsafe {
            let attachments = [vk::AttachmentDescription::default()
                .format(vk::Format::R32G32B32A32_SFLOAT)
                .samples(vk::SampleCountFlags::TYPE_1)
                .final_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)];
            let colours =
                [vk::AttachmentReference::default().layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)];
            let passes = [vk::SubpassDescription::default().color_attachments(&colours)];
            let create = vk::RenderPassCreateInfo::default().attachments(&attachments).subpasses(&passes);
            let pass = self.device.create_render_pass(&create, None).map_err(refused("make a pass"))?;
            let (vertex, vertex_name) = self.module(vertex)?;
            let (fragment, fragment_name) = self.module(fragment)?;
            let stage = |stage, module, name| {
                vk::PipelineShaderStageCreateInfo::default().stage(stage).module(module).name(name)
            };
            let stages = [
                stage(vk::ShaderStageFlags::VERTEX, vertex, &vertex_name),
                stage(vk::ShaderStageFlags::FRAGMENT, fragment, &fragment_name),
            ];
            let vertices = vk::PipelineVertexInputStateCreateInfo::default();
            let assembly = vk::PipelineInputAssemblyStateCreateInfo::default()
                .topology(vk::PrimitiveTopology::TRIANGLE_LIST);
            let extent = vk::Extent2D { width: 64, height: 64 };
            let viewports =
                [vk::Viewport { width: 64.0, height: 64.0, max_depth: 1.0, ..Default::default() }];
            let scissors = [vk::Rect2D { extent, ..Default::default() }];
            let viewport =
                vk::PipelineViewportStateCreateInfo::default().viewports(&viewports).scissors(&scissors);
            let raster = vk::PipelineRasterizationStateCreateInfo::default().line_width(1.0);
            let samples = vk::PipelineMultisampleStateCreateInfo::default()
                .rasterization_samples(vk::SampleCountFlags::TYPE_1);
            let blends = [vk::PipelineColorBlendAttachmentState::default()
                .color_write_mask(vk::ColorComponentFlags::RGBA)];
            let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&blends);
            let create = vk::GraphicsPipelineCreateInfo::default()
                .flags(vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR)
                .stages(&stages)
                .vertex_input_state(&vertices)
                .input_assembly_state(&assembly)
                .viewport_state(&viewport)
                .rasterization_state(&raster)
                .multisample_state(&samples)
                .color_blend_state(&blend)
                .layout(layout)
                .render_pass(pass);
            let pipelines = self.device.create_graphics_pipelines(vk::PipelineCache::null(), &[create], None);
            self.device.destroy_shader_module(vertex, None);
            self.device.destroy_shader_module(fragment, None);
            self.device.destroy_render_pass(pass, None);
            Ok(pipelines.map_err(|(_, result)| refused("compile")(result))?[0])
        }
    }

    /// What the driver says of a stage of a pipeline.
    ///
    /// # Safety
    ///
    /// The pipeline must be alive.
    unsafe fn cost(&self, pipeline: vk::Pipeline, stage: vk::ShaderStageFlags) -> Result<Cost, CostError> {
        // SAFETY: as in `compile_by`.
        let reported = unsafe {
            let info = vk::PipelineInfoKHR::default().pipeline(pipeline);
            let executables = self
                .statistics
                .get_pipeline_executable_properties(&info)
                .map_err(refused("list what it compiled"))?;
            let index = executables.iter().position(|executable| executable.stages.contains(stage));
            let info = vk::PipelineExecutableInfoKHR::default()
                .pipeline(pipeline)
                .executable_index(index.unwrap_or_default() as u32);
            self.statistics
                .get_pipeline_executable_statistics(&info)
                .map_err(refused("tell what it compiled"))?
        };
        let mut cost = Cost::default();
        for statistic in &reported {
            let name = statistic.name_as_c_str().unwrap_or_default().to_string_lossy();
            // SAFETY: the format says which of the values is there.
            let value = unsafe {
                match statistic.format {
                    vk::PipelineExecutableStatisticFormatKHR::UINT64 => statistic.value.u64,
                    vk::PipelineExecutableStatisticFormatKHR::INT64 => statistic.value.i64.max(0) as u64,
                    _ => continue,
                }
            };
            match &*name {
                "VGPRs" => cost.vector_registers = value,
                "SGPRs" => cost.scalar_registers = value,
                "Spilled VGPRs" | "Spilled SGPRs" => cost.spilled_registers += value,
                "Scratch size" => cost.scratch_bytes = value,
                "Subgroups per SIMD" => cost.waves = value,
                "Instructions" => cost.instructions = value,
                "Latency" => cost.latency = value,
                "Inverse Throughput" => cost.inverse_throughput = value,
                "Code size" => cost.code_bytes = value,
                _ => {}
            }
        }
        if cost.instructions == 0 {
            return Err(CostError::Refused {
                what: "compile",
                reason: "it reports no instructions".to_owned(),
            });
        }
        Ok(cost)
    }
}
