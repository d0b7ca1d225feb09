//! What a set of effects costs on a real processor, as its compiler says.
//!
//! No such processor is needed: Mesa's driver for AMD's compiles for any of them and reports what came out
//! (`VK_KHR_pipeline_executable_properties`), but runs nothing.

mod driver;

pub use driver::compile_programs;

use std::ffi::OsString;
use std::path::{Path, PathBuf};

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
    const TYPICAL: [&str; 21] = [
        "none",
        "quad",
        "polygon",
        "quad+ggx",
        "quad+ggx+two-sided",
        "quad+ggx+cheap-horizon",
        "quad+ggx+cheap-horizon,cheap-distance,table-free",
        "quad+ggx+second-lobe",
        "quad+ggx+second-lobe,third-lobe",
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
#[cfg_attr(feature = "report", derive(serde::Serialize, serde::Deserialize))]
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

/// What a program finds at a binding of group 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Binding {
    /// A storage buffer.
    Buffer,
    /// A texture.
    Texture,
    /// A sampler.
    Sampler,
}

/// A SPIR-V module with the name of its entry point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StageModule {
    /// SPIR-V.
    pub spirv: Vec<u8>,
    /// The entry point's name.
    pub entry_point: String,
}

/// A program to compile.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Program {
    /// A compute stage.
    Compute(StageModule),
    /// A vertex stage, and the fragment stage that is asked for: it writes one colour.
    Fragment {
        /// The vertex stage, which reads no buffers of vertices.
        vertex: StageModule,
        /// The fragment stage.
        fragment: StageModule,
    },
}

/// Compiles kernels with the bindings of [`KERNEL`] by the first Vulkan driver that the environment names,
/// and asks what came out.
///
/// # Errors
///
/// If there is no such driver, or it does not tell.
pub fn compile(kernels: &[Vec<u8>]) -> Result<(Compiler, Vec<Cost>), CostError> {
    let mut bindings = [Binding::Buffer; 7];
    bindings[5] = Binding::Texture;
    bindings[6] = Binding::Sampler;
    let program = |spirv: &Vec<u8>| {
        Program::Compute(StageModule { spirv: spirv.clone(), entry_point: ENTRY_POINT.to_owned() })
    };
    compile_programs(&bindings, &kernels.iter().map(program).collect::<Vec<_>>())
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
