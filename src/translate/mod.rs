//! The include in other languages.
//!
//! naga carries the functions over; this module gives them their comments, a guard and a header
//! back, and sees to it that nothing but the library's own names reaches the file that includes it.

mod decorate;
mod fold;
mod guard;
mod select;
mod visit;

use naga::back::{glsl, hlsl, msl, spv};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Arena, Block, EntryPoint, Function, Module, ShaderStage, Statement};

use crate::effects::{Effects, EffectsError};
use crate::{WGSL_EVALUATE, WGSL_INCLUDE};
use select::{Switches, select};

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

impl From<EffectsError> for TranslateError {
    fn from(error: EffectsError) -> Self {
        Self(error.to_string())
    }
}

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

/// The include as a text to be included in a shader of the target language: all of it, with a macro for
/// each effect that leaves the effect out where it is defined as 0 before.
///
/// # Errors
///
/// Only if the include itself is broken; the tests translate it to every target.
pub fn include(target: Target) -> Result<String, TranslateError> {
    switchable_from(WGSL_INCLUDE, target)
}

/// The same for another text of the include, such as one that a caller has changed. Its functions are kept
/// where a root of the set reaches them.
///
/// # Errors
///
/// If the text is no valid WGSL.
pub fn switchable_from(include: &str, target: Target) -> Result<String, TranslateError> {
    let effects = Effects::declared(include);
    let switches = effects.switches().collect();
    let (module, info) = part(include, effects, Switches::Named(&switches))?;
    Ok(decorate::decorate(include, target, &module, &body(target, &module, &info)?, Choice::Macros(effects)))
}

/// The part of the include that a set of effects calls for, as a text to be included in a shader of the
/// target language.
///
/// # Errors
///
/// If the set has an effect that the include does not have.
pub fn include_for(target: Target, effects: Effects) -> Result<String, TranslateError> {
    include_from(WGSL_INCLUDE, target, effects)
}

/// The same for another text of the include, such as one that a caller has changed. Its functions are kept
/// where a root of the set reaches them.
///
/// # Errors
///
/// If the text is no valid WGSL, or the set has an effect that it does not have.
pub fn include_from(include: &str, target: Target, effects: Effects) -> Result<String, TranslateError> {
    let switches = effects.switches().collect();
    let (module, info) = part(include, effects, Switches::Decided(&switches))?;
    Ok(decorate::decorate(include, target, &module, &body(target, &module, &info)?, Choice::Made(effects)))
}

/// The part of a text of the include that a set of effects calls for, as a SPIR-V 1.3 module without an
/// entry point.
///
/// # Errors
///
/// As [`include_from`].
pub fn library_spirv(include: &str, effects: Effects) -> Result<Vec<u8>, TranslateError> {
    let switches = effects.switches().collect();
    let (module, info) = part(include, effects, Switches::Decided(&switches))?;
    spirv_module(&module, &info, None)
}

/// Who chooses among the effects of a translation.
#[derive(Clone, Copy)]
enum Choice {
    /// The file that includes it, by macros for these effects.
    Macros(Effects),
    /// It holds these and no others.
    Made(Effects),
}

/// What the roots of a set of effects reach.
fn part(include: &str, effects: Effects, switches: Switches) -> Result<(Module, ModuleInfo), TranslateError> {
    effects.check_declared(include)?;
    let (module, _) = parse(include)?;
    let module = select(&module, &effects.roots(), switches)?;
    let info = validate(&module)?;
    Ok((module, info))
}

fn body(target: Target, module: &Module, info: &ModuleInfo) -> Result<String, TranslateError> {
    match target {
        Target::Glsl450 => glsl_text(module, glsl::Version::Desktop(450)),
        Target::Glsl330 => glsl_text(module, glsl::Version::Desktop(330)),
        Target::GlslEs300 => glsl_text(module, glsl::Version::new_gles(300)),
        Target::GlslEs310 => glsl_text(module, glsl::Version::new_gles(310)),
        Target::Hlsl | Target::Unreal => hlsl_text(module, info),
        Target::Msl => msl_text(module, info),
    }
}

/// The kernel of `wgsl/evaluate.wgsl`, which evaluates an array of pairs of surfaces and lights, as
/// a SPIR-V 1.3 module with the entry point `evaluate`.
///
/// # Errors
///
/// As [`include()`].
pub fn spirv() -> Result<Vec<u8>, TranslateError> {
    kernel_spirv(&format!("{WGSL_INCLUDE}\n{WGSL_EVALUATE}"), "evaluate", Effects::standing())
}

/// What an entry point of a WGSL module calls for with the switches of a set of effects, as SPIR-V
/// 1.3, without checks that the include has no need for.
///
/// # Errors
///
/// If `source` is not valid WGSL, has no entry point of that name, or has overrides other than the
/// include's.
pub fn kernel_spirv(source: &str, entry_point: &str, effects: Effects) -> Result<Vec<u8>, TranslateError> {
    let (module, info) = kernel_module(source, entry_point, effects)?;
    spirv_module(&module, &info, Some(entry_point))
}

/// What an entry point of a WGSL module calls for with the switches of a set of effects.
pub(crate) fn kernel_module(
    source: &str,
    entry_point: &str,
    effects: Effects,
) -> Result<(Module, ModuleInfo), TranslateError> {
    let (mut module, _) = parse(source)?;
    module.entry_points.retain(|known| known.name == entry_point);
    if module.entry_points.is_empty() {
        return Err(failed("no kernel", format!("there is no entry point {entry_point}")));
    }
    let switches = effects.switches().collect();
    let module = select(&module, &[], Switches::Decided(&switches))?;
    let info = validate(&module)?;
    Ok((module, info))
}

fn spirv_module(
    module: &Module,
    info: &ModuleInfo,
    entry_point: Option<&str>,
) -> Result<Vec<u8>, TranslateError> {
    let options = spv::Options {
        lang_version: (1, 3),
        flags: spv::WriterFlags::DEBUG,
        zero_initialize_workgroup_memory: spv::ZeroInitializeWorkgroupMemoryMode::None,
        force_loop_bounding: false,
        emit_int_div_checks: false,
        ..Default::default()
    };
    let pipeline = entry_point.map(|name| spv::PipelineOptions {
        shader_stage: module
            .entry_points
            .iter()
            .find(|known| known.name == name)
            .map_or(ShaderStage::Compute, |known| known.stage),
        entry_point: name.to_owned(),
    });
    let words = spv::write_vec(module, info, &options, pipeline.as_ref())
        .map_err(|error| failed("no SPIR-V", error))?;
    Ok(words.iter().flat_map(|word| word.to_le_bytes()).collect())
}

fn glsl_text(module: &Module, version: glsl::Version) -> Result<String, TranslateError> {
    // naga writes GLSL for an entry point only, so one is lent to it and taken away again.
    let mut module = module.clone();
    module.entry_points.push(nothing());
    let info = validate(&module)?;
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

/// A fragment entry point that does nothing.
fn nothing() -> EntryPoint {
    EntryPoint {
        name: "main".to_owned(),
        stage: ShaderStage::Fragment,
        early_depth_test: None,
        workgroup_size: [0; 3],
        workgroup_size_overrides: None,
        function: Function {
            name: Some("main".to_owned()),
            expressions: Arena::new(),
            body: Block::from_vec(vec![Statement::Return { value: None }]),
            ..Function::default()
        },
        mesh_info: None,
        task_payload: None,
        incoming_ray_payload: None,
    }
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
