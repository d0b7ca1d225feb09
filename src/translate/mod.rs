//! The include in other languages.
//!
//! naga carries the functions over; this module gives them their comments, a guard and a header
//! back, and sees to it that nothing but the library's own names reaches the file that includes it.

mod decorate;

use naga::back::{glsl, hlsl, msl, spv};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Module, ShaderStage};

use crate::{WGSL_EVALUATE, WGSL_INCLUDE};

/// A language, dialect or format that the include is translated to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Target {
    /// GLSL 4.50, for Vulkan and desktop OpenGL.
    Glsl450,
    /// GLSL 3.30, for OpenGL 3.3.
    Glsl330,
    /// GLSL ES 3.00, for WebGL 2 and OpenGL ES 3.0.
    GlslEs300,
    /// GLSL ES 3.10.
    GlslEs310,
    /// HLSL 2018, shader model 5 and later.
    Hlsl,
    /// The same with the file name and guard that Unreal expects.
    Unreal,
    /// The Metal shading language, version 2.0 and later.
    Msl,
}

impl Target {
    /// Every target, in the order of their folders.
    pub const ALL: [Self; 7] =
        [Self::Glsl450, Self::Glsl330, Self::GlslEs300, Self::GlslEs310, Self::Hlsl, Self::Unreal, Self::Msl];

    /// Where the translation lies, relative to the repository and to a package.
    pub fn path(self) -> &'static str {
        match self {
            Self::Glsl450 => "glsl/450/ltc.glsl",
            Self::Glsl330 => "glsl/330/ltc.glsl",
            Self::GlslEs300 => "glsl/es300/ltc.glsl",
            Self::GlslEs310 => "glsl/es310/ltc.glsl",
            Self::Hlsl => "hlsl/ltc.hlsl",
            Self::Unreal => "hlsl/Ltc.ush",
            Self::Msl => "msl/ltc.metal",
        }
    }
}

/// Where the SPIR-V module lies, relative to the repository and to a package.
pub const SPIRV_PATH: &str = "spirv/ltc_evaluate.spv";

/// Why a WGSL text could not be translated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TranslateError(String);

impl core::fmt::Display for TranslateError {
    fn fmt(&self, formatter: &mut core::fmt::Formatter) -> core::fmt::Result {
        formatter.write_str(&self.0)
    }
}

impl core::error::Error for TranslateError {}

fn failed(what: &str, why: impl core::fmt::Display) -> TranslateError {
    TranslateError(format!("{what}: {why}"))
}

/// Parses and validates WGSL.
pub(crate) fn parse(source: &str) -> Result<(Module, ModuleInfo), TranslateError> {
    let module = naga::front::wgsl::parse_str(source)
        .map_err(|error| failed("the WGSL does not parse", error.emit_to_string(source)))?;
    let info = validate(&module)?;
    Ok((module, info))
}

fn validate(module: &Module) -> Result<ModuleInfo, TranslateError> {
    Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(module)
        .map_err(|error| failed("the WGSL is not valid", error.into_inner()))
}

/// The include as a text to be included in a shader of the target language.
///
/// # Errors
///
/// Only if the include itself is broken; the tests translate it to every target.
pub fn include(target: Target) -> Result<String, TranslateError> {
    let (module, info) = parse(WGSL_INCLUDE)?;
    let body = match target {
        Target::Glsl450 => glsl_text(glsl::Version::Desktop(450))?,
        Target::Glsl330 => glsl_text(glsl::Version::Desktop(330))?,
        Target::GlslEs300 => glsl_text(glsl::Version::new_gles(300))?,
        Target::GlslEs310 => glsl_text(glsl::Version::new_gles(310))?,
        Target::Hlsl | Target::Unreal => hlsl_text(&module, &info)?,
        Target::Msl => msl_text(&module, &info)?,
    };
    Ok(decorate::decorate(target, &module, &body))
}

/// The kernel of `wgsl/evaluate.wgsl`, which evaluates an array of pairs of surfaces and lights, as
/// a SPIR-V 1.3 module with the entry point `evaluate`.
///
/// # Errors
///
/// As [`include()`].
pub fn spirv() -> Result<Vec<u8>, TranslateError> {
    kernel_spirv(&format!("{WGSL_INCLUDE}\n{WGSL_EVALUATE}"), "evaluate")
}

/// A WGSL module with a compute entry point as SPIR-V 1.3, without checks that the include has no
/// need for.
///
/// # Errors
///
/// If `source` is not valid WGSL or has no compute entry point of that name.
pub fn kernel_spirv(source: &str, entry_point: &str) -> Result<Vec<u8>, TranslateError> {
    let (module, info) = parse(source)?;
    let options = spv::Options {
        lang_version: (1, 3),
        flags: spv::WriterFlags::DEBUG,
        zero_initialize_workgroup_memory: spv::ZeroInitializeWorkgroupMemoryMode::None,
        force_loop_bounding: false,
        emit_int_div_checks: false,
        ..Default::default()
    };
    let pipeline =
        spv::PipelineOptions { shader_stage: ShaderStage::Compute, entry_point: entry_point.to_owned() };
    let words = spv::write_vec(&module, &info, &options, Some(&pipeline))
        .map_err(|error| failed("no SPIR-V", error))?;
    Ok(words.iter().flat_map(|word| word.to_le_bytes()).collect())
}

fn glsl_text(version: glsl::Version) -> Result<String, TranslateError> {
    // naga writes GLSL for an entry point only, so one is lent to it and taken away again.
    let (module, info) = parse(&format!("{WGSL_INCLUDE}\n@fragment fn main() {{}}\n"))?;
    let options = glsl::Options {
        version,
        writer_flags: glsl::WriterFlags::INCLUDE_UNUSED_ITEMS,
        binding_map: glsl::BindingMap::default(),
        zero_initialize_workgroup_memory: false,
    };
    let pipeline = glsl::PipelineOptions {
        shader_stage: ShaderStage::Fragment,
        entry_point: "main".to_owned(),
        multiview: None,
    };
    let mut text = String::new();
    glsl::Writer::new(
        &mut text,
        &module,
        &info,
        &options,
        &pipeline,
        naga::proc::BoundsCheckPolicies::default(),
    )
    .and_then(|mut writer| writer.write())
    .map_err(|error| failed("no GLSL", error))?;
    let end = text.rfind("void main() {").unwrap_or(text.len());
    Ok(text[..end]
        .lines()
        .filter(|line| !line.starts_with("#version") && !line.starts_with("precision "))
        .fold(String::new(), |text, line| text + line + "\n"))
}

fn hlsl_text(module: &Module, info: &ModuleInfo) -> Result<String, TranslateError> {
    let options = hlsl::Options {
        shader_model: hlsl::ShaderModel::V5_0,
        fake_missing_bindings: false,
        zero_initialize_workgroup_memory: false,
        restrict_indexing: false,
        force_loop_bounding: false,
        ..Default::default()
    };
    let mut text = String::new();
    hlsl::Writer::new(&mut text, &options, &hlsl::PipelineOptions::default())
        .write(module, info, None)
        .map_err(|error| failed("no HLSL", error))?;
    Ok(without_padding(&text))
}

/// Without the members that naga adds to match WGSL's layout in buffers, where no type of the include
/// ever lies.
fn without_padding(text: &str) -> String {
    text.lines().filter(|line| !line.contains("_pad")).fold(String::new(), |text, line| text + line + "\n")
}

fn msl_text(module: &Module, info: &ModuleInfo) -> Result<String, TranslateError> {
    let options = msl::Options {
        lang_version: (2, 0),
        fake_missing_bindings: false,
        zero_initialize_workgroup_memory: false,
        force_loop_bounding: false,
        ..Default::default()
    };
    msl::write_string(module, info, &options, &msl::PipelineOptions::default())
        .map(|(text, _)| {
            // A comment of naga's and a name that nothing here uses.
            without_padding(&text.replace("// language: metal2.0\n", "").replace("using metal::uint;\n", ""))
        })
        .map_err(|error| failed("no MSL", error))
}
