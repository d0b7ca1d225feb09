//! What a set of effects costs on a real processor, as its compiler says.
//!
//! No such processor is needed: Mesa's driver for AMD's compiles for any of them and reports what came out
//! (`VK_KHR_pipeline_executable_properties`), but runs nothing.

use std::ffi::{CStr, CString, OsString};
use std::path::{Path, PathBuf};

use ash::vk;

use crate::WGSL_INCLUDE;
use crate::effects::{Effects, wgsl};
use crate::translate::{self, Target, TranslateError};

/// A kernel that shades a surface point by point lights and, where the set of effects has any, by area
/// lights; to be appended to [`WGSL_INCLUDE`].
pub const KERNEL: &str = include_str!("../../wgsl/cost.wgsl");

/// The entry point of [`KERNEL`].
pub const ENTRY_POINT: &str = "cost";

/// Families of processors that the driver of Debian 12 knows: RDNA 1, 2 and 3.
pub const FAMILIES: [&str; 3] = ["navi10", "navi21", "gfx1100"];

/// Sets that scenes commonly call for. Those of which the include lacks something are left out.
pub fn typical() -> Vec<Effects> {
    const TYPICAL: [&str; 18] = [
        "none",
        "quad",
        "polygon",
        "quad+ggx",
        "quad+ggx+two-sided",
        "quad+ggx+cheap-horizon",
        "polygon+ggx",
        "quad,polygon+ggx",
        "disk+ggx",
        "sphere+ggx",
        "tube+ggx",
        "quad,textured+ggx",
        "quad,disk,sphere,tube+ggx",
        "quad+ggx,clearcoat",
        "quad+ggx,sheen",
        "quad+ggx,rough-diffuse",
        "quad+ggx,energy-compensation",
        "quad+ggx,anisotropic",
    ];
    let present = Effects::present();
    let known = TYPICAL.iter().filter_map(|text| text.parse::<Effects>().ok());
    known.filter(|effects| present.is_superset(*effects)).chain([Effects::standing()]).collect()
}

/// The kernel for a set of effects, as SPIR-V.
///
/// # Errors
///
/// If the set has an effect that the include does not have.
pub fn kernel(effects: Effects) -> Result<Vec<u8>, TranslateError> {
    effects.check_declared(WGSL_INCLUDE)?;
    translate::kernel_spirv(&format!("{WGSL_INCLUDE}\n{KERNEL}"), ENTRY_POINT, effects)
}

/// The kernel as an engine writes it that has no area lights and has never heard of the include.
///
/// # Errors
///
/// Only if the kernel is broken.
pub fn kernel_without_library() -> Result<Vec<u8>, TranslateError> {
    let start = KERNEL.find("    // From here on area lights.").unwrap_or(KERNEL.len());
    let end = KERNEL.rfind("    reflected[index]").unwrap_or(start);
    translate::kernel_spirv(&format!("{}{}", &KERNEL[..start], &KERNEL[end..]), ENTRY_POINT, Effects::NONE)
}

/// Bytes of what a set of effects comes to in each form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    /// The include in WGSL.
    pub wgsl: usize,
    /// In GLSL 4.50.
    pub glsl: usize,
    /// In HLSL.
    pub hlsl: usize,
    /// In the Metal shading language.
    pub msl: usize,
    /// The kernel in SPIR-V.
    pub spirv: usize,
    /// The layers of the table.
    pub table: usize,
}

/// Measures what a set of effects comes to in each form.
///
/// # Errors
///
/// If the set has an effect that the include does not have.
pub fn sizes(effects: Effects) -> Result<Sizes, TranslateError> {
    let text = |target| translate::include_for(target, effects).map(|text| text.len());
    Ok(Sizes {
        wgsl: wgsl(effects)?.len(),
        glsl: text(Target::Glsl450)?,
        hlsl: text(Target::Hlsl)?,
        msl: text(Target::Msl)?,
        spirv: kernel(effects)?.len(),
        table: effects.layers().iter().map(|layer| layer.bytes(crate::TABLE_SIZE)).sum(),
    })
}

/// What a compiler says of a kernel. The numbers are estimates of its own: it guesses how often loops run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Registers that hold a value for each invocation.
    pub vector_registers: u64,
    /// Registers that hold a value for all invocations of a wave.
    pub scalar_registers: u64,
    /// Registers of both kinds that did not fit and went to memory.
    pub spilled_registers: u64,
    /// Bytes of memory for each invocation.
    pub scratch_bytes: u64,
    /// Waves that run at once on one unit.
    pub waves: u64,
    /// Instructions.
    pub instructions: u64,
    /// Cycles from the first instruction of one wave to its last.
    pub latency: u64,
    /// Cycles for each wave when many run at once.
    pub inverse_throughput: u64,
    /// Bytes of the program.
    pub code_bytes: u64,
}

/// Which compiler said so.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Compiler {
    /// The processor that it compiled for.
    pub device: String,
    /// The driver with its version.
    pub driver: String,
}

/// Why nothing could be compiled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CostError {
    /// The Vulkan loader is missing.
    NoLoader(String),
    /// The driver is missing.
    NoDriver {
        /// Where it was looked for.
        folders: Vec<PathBuf>,
    },
    /// The driver reports nothing about what it compiles.
    NoStatistics {
        /// What there is.
        device: String,
    },
    /// A call failed.
    Refused {
        /// What was asked of the driver.
        what: &'static str,
        /// What it said.
        reason: String,
    },
}

const PACKAGES: &str = "Debian's packages mesa-vulkan-drivers and libvulkan1 bring what is needed";

impl core::fmt::Display for CostError {
    fn fmt(&self, formatter: &mut core::fmt::Formatter) -> core::fmt::Result {
        match self {
            Self::NoLoader(reason) => write!(formatter, "there is no Vulkan loader ({reason}); {PACKAGES}"),
            Self::NoDriver { folders } => {
                let folders: Vec<_> = folders.iter().map(|folder| folder.display().to_string()).collect();
                write!(formatter, "there is no radeon_icd.*.json in {}; {PACKAGES}", folders.join(" or "))
            }
            Self::NoStatistics { device } => write!(
                formatter,
                "the Vulkan driver of {device} does not report what it compiles, RADV does; {PACKAGES}"
            ),
            Self::Refused { what, reason } => {
                write!(formatter, "the Vulkan driver failed to {what}: {reason}")
            }
        }
    }
}

impl core::error::Error for CostError {}

fn refused(what: &'static str) -> impl Fn(vk::Result) -> CostError {
    move |result| CostError::Refused { what, reason: result.to_string() }
}

/// Environment in which [`compile`] compiles for a family of processors. A driver reads it when it is
/// loaded, so a process can compile for one family only; one that the driver does not know ends it.
///
/// # Errors
///
/// If the driver is not installed.
pub fn environment(family: &str) -> Result<Vec<(&'static str, OsString)>, CostError> {
    let folders = ["/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d"];
    let folders: Vec<PathBuf> = folders.iter().map(PathBuf::from).collect();
    let manifest = folders.iter().find_map(|folder| manifest(folder));
    let manifest = manifest.ok_or(CostError::NoDriver { folders })?.into_os_string();
    Ok(vec![
        ("RADV_FORCE_FAMILY", family.into()),
        // The newer and the older name of the same.
        ("VK_DRIVER_FILES", manifest.clone()),
        ("VK_ICD_FILENAMES", manifest),
    ])
}

/// The driver's manifest in a folder, of this processor's architecture where there are several.
fn manifest(folder: &Path) -> Option<PathBuf> {
    let files = std::fs::read_dir(folder).ok()?.filter_map(|entry| Some(entry.ok()?.path()));
    let mut found: Vec<PathBuf> = files
        .filter(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            name.starts_with("radeon_icd.") && name.ends_with(".json")
        })
        .collect();
    found.sort_by_key(|path| !path.to_string_lossy().contains(std::env::consts::ARCH));
    found.into_iter().next()
}

/// Compiles kernels with the bindings of [`KERNEL`] by the first Vulkan driver that the environment names,
/// and asks what came out.
///
/// # Errors
///
/// If there is no such driver, or it does not tell.
pub fn compile(kernels: &[Vec<u8>]) -> Result<(Compiler, Vec<Cost>), CostError> {
    compile_kernels(kernels, ENTRY_POINT, 5)
}

/// [`compile`] for kernels with another entry point, whose bindings are `buffers` storage buffers, a sampled image and a
/// sampler.
///
/// # Errors
///
/// As [`compile`].
pub fn compile_kernels(
    kernels: &[Vec<u8>],
    entry_point: &str,
    buffers: usize,
) -> Result<(Compiler, Vec<Cost>), CostError> {
    // SAFETY: the loader is the system's own.
    let entry = unsafe { ash::Entry::load() }.map_err(|error| CostError::NoLoader(error.to_string()))?;
    let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_2);
    let create = vk::InstanceCreateInfo::default().application_info(&application);
    // SAFETY: what the structures point to outlives the call; the handle is destroyed below.
    let instance = unsafe { entry.create_instance(&create, None) }.map_err(refused("start"))?;
    // SAFETY: everything made from the instance is destroyed by then.
    let result = unsafe { compile_by(&instance, kernels, entry_point, buffers) };
    // SAFETY: as before.
    unsafe { instance.destroy_instance(None) };
    result
}

/// # Safety
///
/// The instance must be alive.
unsafe fn compile_by(
    instance: &ash::Instance,
    kernels: &[Vec<u8>],
    entry_point: &str,
    buffers: usize,
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
        let costs =
            kernels.iter().map(|kernel| one(&logical, &statistics, kernel, entry_point, buffers)).collect();
        logical.destroy_device(None);
        Ok((Compiler { device, driver }, Result::from_iter::<Vec<_>>(costs)?))
    }
}

/// # Safety
///
/// The device must be alive.
unsafe fn one(
    device: &ash::Device,
    statistics: &ash::khr::pipeline_executable_properties::Device,
    kernel: &[u8],
    entry_point: &str,
    buffers: usize,
) -> Result<Cost, CostError> {
    let words: Vec<u32> =
        kernel.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    let binding = |(index, kind): (usize, &vk::DescriptorType)| {
        vk::DescriptorSetLayoutBinding::default()
            .binding(index as u32)
            .descriptor_type(*kind)
            .descriptor_count(1)
            .stage_flags(vk::ShaderStageFlags::COMPUTE)
    };
    let mut kinds = vec![vk::DescriptorType::STORAGE_BUFFER; buffers];
    kinds.extend([vk::DescriptorType::SAMPLED_IMAGE, vk::DescriptorType::SAMPLER]);
    let bindings: Vec<_> = kinds.iter().enumerate().map(binding).collect();
    let name = CString::new(entry_point).unwrap_or_default();
    // SAFETY: as in `compile_by`; after a failure what was made before goes with the device.
    unsafe {
        let create = vk::ShaderModuleCreateInfo::default().code(&words);
        let module = device.create_shader_module(&create, None).map_err(refused("read SPIR-V"))?;
        let create = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        let sets =
            [device.create_descriptor_set_layout(&create, None).map_err(refused("make a set's layout"))?];
        let create = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets);
        let layout = device.create_pipeline_layout(&create, None).map_err(refused("make a layout"))?;
        let stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module)
            .name(&name);
        let create = vk::ComputePipelineCreateInfo::default()
            .flags(vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR)
            .layout(layout)
            .stage(stage);
        let pipelines = device
            .create_compute_pipelines(vk::PipelineCache::null(), &[create], None)
            .map_err(|(_, result)| refused("compile")(result))?;
        let info = vk::PipelineExecutableInfoKHR::default().pipeline(pipelines[0]);
        let reported =
            statistics.get_pipeline_executable_statistics(&info).map_err(refused("tell what it compiled"))?;
        let mut cost = Cost::default();
        for statistic in &reported {
            let name = CStr::from_ptr(statistic.name.as_ptr()).to_string_lossy();
            let value = match statistic.format {
                vk::PipelineExecutableStatisticFormatKHR::UINT64 => statistic.value.u64,
                vk::PipelineExecutableStatisticFormatKHR::INT64 => statistic.value.i64.max(0) as u64,
                _ => continue,
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
        device.destroy_pipeline(pipelines[0], None);
        device.destroy_pipeline_layout(layout, None);
        device.destroy_descriptor_set_layout(sets[0], None);
        device.destroy_shader_module(module, None);
        if cost.instructions == 0 {
            return Err(CostError::Refused {
                what: "compile",
                reason: "it reports no instructions".to_owned(),
            });
        }
        Ok(cost)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kernel_of_the_empty_set_has_nothing_of_the_include() {
        let none = kernel(Effects::NONE).unwrap_or_else(|error| panic!("{error}"));
        let without = kernel_without_library().unwrap_or_else(|error| panic!("{error}"));
        assert!(none == without, "{} bytes with the include, {} without it", none.len(), without.len());
        let some = kernel(Effects::present()).unwrap_or_else(|error| panic!("{error}"));
        assert!(some.len() > 4 * none.len(), "{} bytes with area lights", some.len());
    }

    #[test]
    fn typical_sets_include_nothing_and_everything() {
        let sets = typical();
        assert!(sets.contains(&Effects::NONE) && sets.contains(&Effects::standing()) && sets.len() >= 12);
    }

    #[test]
    fn a_missing_driver_is_told_with_its_package() {
        let error = CostError::NoDriver { folders: vec![PathBuf::from("/nowhere")] }.to_string();
        assert!(error.contains("/nowhere") && error.contains("mesa-vulkan-drivers"), "{error}");
        assert_eq!(manifest(Path::new("/nowhere")), None);
    }
}
