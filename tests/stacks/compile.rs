//! What the include goes through on its way to a driver: naga, and compilers that share no code with it.

use std::path::{Path, PathBuf};
use std::process::Command;

use softbox::effects::{Quality, wgsl};
use softbox::translate::{self, Target};

use crate::driver::installed;
use crate::level::Level;
use crate::tools;

/// What a driver is handed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// WGSL text.
    Wgsl,
    /// GLSL text, for OpenGL.
    Glsl,
    /// SPIR-V with an entry point.
    Spirv(&'static str),
}

impl Form {
    const ALL: [Self; 4] = [Self::Wgsl, Self::Glsl, Self::Spirv("evaluate"), Self::Spirv("main")];

    /// Its name on a command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Wgsl => "wgsl",
            Self::Glsl => "glsl",
            Self::Spirv(entry_point) => entry_point,
        }
    }

    /// The form of that name.
    pub fn named(name: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|form| form.name() == name);
        found.ok_or_else(|| format!("a program is wgsl, glsl, evaluate or main, not {name}"))
    }
}

/// One way from the include to what a driver takes.
#[derive(Clone)]
pub struct Recipe {
    /// What the text goes through.
    pub name: String,
    /// What comes out.
    pub form: Form,
    /// It needs what only `tests/stacks/install` brings, or says little that another recipe does not.
    pub long: bool,
    /// The levels that it exists for.
    pub levels: Vec<Quality>,
    steps: Steps,
}

#[derive(Clone)]
enum Steps {
    Wgsl,
    Naga,
    Committed,
    Glsl(&'static str, Target),
    Glslang { version: &'static str, target: Target, optimise: Optimise },
    GlslangHlsl,
    Dxc(&'static str),
    Slang(&'static str),
    Cross(&'static str),
}

/// Passes over a compiled module.
#[derive(Clone, Copy)]
enum Optimise {
    No,
    ByGlslang,
    BySpirvTools(&'static str),
}

/// Every recipe.
pub fn recipes() -> Vec<Recipe> {
    use Optimise::{ByGlslang, BySpirvTools, No};
    let mut recipes = Vec::new();
    let mut add = |name: &str, form: Form, long: bool, steps: Steps| {
        let name = name.to_owned();
        recipes.push(Recipe { name, form, long, levels: Quality::ALL.to_vec(), steps });
    };
    let main = Form::Spirv("main");
    add("WGSL, naga", Form::Wgsl, false, Steps::Wgsl);
    add("SPIR-V by naga", Form::Spirv("evaluate"), false, Steps::Naga);
    add("the kernel in spirv/", Form::Spirv("evaluate"), false, Steps::Committed);
    add("GLSL 450", Form::Glsl, false, Steps::Glsl("450", Target::Glsl450));
    add("GLSL ES 310", Form::Glsl, false, Steps::Glsl("310 es", Target::GlslEs310));
    let glslang = |version, target, optimise| Steps::Glslang { version, target, optimise };
    add("GLSL 450, glslang", main, false, glslang("450", Target::Glsl450, No));
    add("GLSL ES 310, glslang", main, true, glslang("310 es", Target::GlslEs310, No));
    add("GLSL 450, glslang -Os", main, true, glslang("450", Target::Glsl450, ByGlslang));
    for passes in SPIRV_PASSES {
        let short = if passes.len() > 3 { "with branches flattened and loops unrolled" } else { passes };
        add(
            &format!("GLSL 450, glslang, spirv-opt {short}"),
            main,
            *passes != "-O",
            glslang("450", Target::Glsl450, BySpirvTools(passes)),
        );
    }
    add("HLSL, glslang -D", main, true, Steps::GlslangHlsl);
    for (flags, long) in DXC_FLAGS {
        add(&format!("HLSL, DXC {flags}"), main, *long, Steps::Dxc(flags));
    }
    for flags in SLANG_FLAGS {
        add(&format!("HLSL, Slang {flags}"), main, true, Steps::Slang(flags));
    }
    for target in ["GLSL, glslang", "HLSL, DXC -O3"] {
        add(&format!("SPIR-V by naga, spirv-cross to {target}"), main, true, Steps::Cross(target));
    }
    for recipe in &mut recipes {
        if matches!(recipe.steps, Steps::Committed) {
            recipe.levels = vec![Quality::Standard];
        }
    }
    recipes
}

/// Orders of SPIRV-Tools' passes: the two that it offers, and those that may change the order of arithmetic.
const SPIRV_PASSES: &[&str] = &[
    "-O",
    "-Os",
    "--inline-entry-points-exhaustive --ssa-rewrite --if-conversion --loop-unroll --redundancy-elimination",
];

/// Optimisation levels; strict arithmetic; branches flattened or kept.
const DXC_FLAGS: &[(&str, bool)] = &[
    ("-Od", true),
    ("-O0", false),
    ("-O1", true),
    ("-O2", true),
    ("-O3", false),
    ("-O3 -Gis", true),
    ("-O3 -Gfa", true),
    ("-O3 -Gfp", true),
    ("-O3 -HV 2021", true),
];

const SLANG_FLAGS: &[&str] =
    &["-O0", "-O1", "-O3", "-O3 -fp-mode fast", "-O3 -fp-mode precise", "-O3 -emit-spirv-via-glsl"];

impl Recipe {
    /// The levels that differ most, but of WGSL all of them.
    pub fn short_levels(&self) -> Vec<Quality> {
        let kept = |level: &&Quality| {
            self.form == Form::Wgsl || matches!(level, Quality::Standard | Quality::Finest)
        };
        self.levels.iter().filter(kept).copied().collect()
    }

    /// The program at a level.
    pub fn program(&self, level: &Level) -> Result<PathBuf, String> {
        let name: String = self
            .name
            .chars()
            .map(|character| if character.is_alphanumeric() { character } else { '_' })
            .collect();
        level.made(&name, |output| self.make(level, &name, output))
    }

    fn make(&self, level: &Level, name: &str, output: &Path) -> Result<(), String> {
        let effects = level.inputs.effects;
        let source =
            |extension: &str, text: String| write(&level.folder.join(format!("{name}.{extension}")), text);
        match &self.steps {
            Steps::Wgsl => {
                let text = wgsl(effects).map_err(|error| error.to_string())?;
                write(output, format!("{text}\n{}", softbox::WGSL_EVALUATE)).map(drop)
            }
            Steps::Naga => write(output, naga(level)?).map(drop),
            Steps::Committed => write(output, softbox::SPIRV_EVALUATE).map(drop),
            Steps::Glsl(version, target) => write(output, glsl(level, version, *target, "")?).map(drop),
            Steps::Glslang { version, target, optimise } => {
                let text = glsl(level, version, *target, &separate(level.inputs.level))?;
                glslang(&source("comp", text)?, output, *optimise)
            }
            Steps::GlslangHlsl => {
                // glslang's preprocessor takes Vulkan bindings from its own switches.
                let text = format!("#define VULKAN_BINDINGS\n{}", hlsl(level)?);
                let mut command = Command::new("glslangValidator");
                command.args("-D -V -S comp -e main".split(' ')).arg(source("hlsl", text)?);
                run(command.arg("-o").arg(output))
            }
            Steps::Dxc(flags) => dxc(&source("hlsl", hlsl(level)?)?, output, flags),
            Steps::Slang(flags) => {
                let mut command = Command::new("python3");
                command.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/stacks/slang.py"));
                command.arg(installed("stacks/slang")?).arg(output).arg(source("hlsl", hlsl(level)?)?);
                command.args(
                    "-target spirv -entry main -stage compute -profile sm_6_0 -DVULKAN_BINDINGS".split(' '),
                );
                run(command.args(flags.split(' ')))
            }
            Steps::Cross(target) => {
                let module = source("naga.spv", String::new())?;
                write(&module, naga(level)?)?;
                let is_hlsl = target.starts_with("HLSL");
                let text = level.folder.join(format!("{name}.{}", if is_hlsl { "hlsl" } else { "comp" }));
                let mut command = Command::new("spirv-cross");
                command.arg(&module).arg("--output").arg(&text);
                if is_hlsl {
                    run(command.args(["--hlsl", "--shader-model", "60", "--hlsl-auto-binding", "all"]))?;
                    dxc(&text, output, "-O3")
                } else {
                    run(command.args(["-V", "--version", "450"]))?;
                    glslang(&text, output, Optimise::No)
                }
            }
        }
    }
}

fn write(path: &Path, text: impl AsRef<[u8]>) -> Result<PathBuf, String> {
    std::fs::write(path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    Ok(path.to_owned())
}

/// Runs a compiler.
pub fn run(command: &mut Command) -> Result<(), String> {
    let shown = format!("{command:?}");
    let advice = "`tests/tools/install` and `tests/stacks/install` install what the stacks need";
    let output = command.output().map_err(|error| format!("cannot run {shown}: {error}; {advice}"))?;
    let said =
        [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    if output.status.success() { Ok(()) } else { Err(format!("{shown}: {}:\n{said}", output.status)) }
}

fn include(level: &Level, target: Target) -> Result<String, String> {
    translate::include_for(target, level.inputs.effects).map_err(|error| error.to_string())
}

fn naga(level: &Level) -> Result<Vec<u8>, String> {
    let source = format!("{}\n{}", softbox::WGSL_INCLUDE, softbox::WGSL_EVALUATE);
    translate::kernel_spirv(&source, "evaluate", level.inputs.effects).map_err(|error| error.to_string())
}

fn glsl(level: &Level, version: &str, target: Target, defines: &str) -> Result<String, String> {
    let kernel = tools::with_include(include_str!("../shaders/evaluate.comp"), &include(level, target)?);
    Ok(format!("#version {version}\n{defines}{kernel}"))
}

/// Vulkan's textures and samplers are bound apart.
fn separate(level: Quality) -> String {
    let (lobes, rest) = match level {
        Quality::Fast => (1, "#define TABLE_FREE\n"),
        Quality::Standard => (1, ""),
        Quality::Fine => (2, ""),
        Quality::Finest => (3, ""),
    };
    format!("#define TABLE_SEPARATE\n#define LOBES {lobes}\n{rest}")
}

fn glslang(source: &Path, output: &Path, optimise: Optimise) -> Result<(), String> {
    let mut command = Command::new("glslangValidator");
    command.arg("-V");
    if let Optimise::ByGlslang = optimise {
        command.arg("-Os");
    }
    run(command.arg(source).arg("-o").arg(output))?;
    if let Optimise::BySpirvTools(passes) = optimise {
        let mut command = Command::new("spirv-opt");
        run(command.args(passes.split(' ')).arg(output).arg("-o").arg(output))?;
    }
    Ok(())
}

fn hlsl(level: &Level) -> Result<String, String> {
    Ok(tools::with_include(include_str!("../shaders/evaluate.hlsl"), &include(level, Target::Hlsl)?))
}

fn dxc(source: &Path, output: &Path, flags: &str) -> Result<(), String> {
    let arguments = "-T cs_6_0 -E main -spirv -fspv-target-env=vulkan1.1 -D VULKAN_BINDINGS";
    let version = if flags.contains("-HV") { "" } else { " -HV 2018" };
    let arguments = format!("{arguments}{version} {flags}");
    run(tools::dxc().arg(source).arg(output).args(arguments.split(' ')))
}
