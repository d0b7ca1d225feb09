//! What offline compilers make of kernels: Mesa's driver for AMD's processors, none of which needs to be there.

use std::io::{Read, Write};
use std::process::{Command, Stdio};

use serde::{Deserialize, Serialize};

use super::CostsError;
use super::kernel::{COMPUTE, FRAGMENT, Kernel, VERTEX};
use crate::report::cost::{self, Binding, Compiler, Cost, Program, StageModule};
use crate::translate::{TranslateError, kernel_spirv};

/// The bindings of methods' kernels.
pub const BINDINGS: [Binding; 5] =
    [Binding::Buffer, Binding::Buffer, Binding::Buffer, Binding::Texture, Binding::Sampler];

/// A method as a program of each stage: compute and fragment.
///
/// # Errors
///
/// If the kernel is no valid WGSL.
pub fn programs(kernel: &Kernel) -> Result<[Program; 2], TranslateError> {
    let module = |entry_point: &str| -> Result<StageModule, TranslateError> {
        let spirv = kernel_spirv(&kernel.source(), entry_point, kernel.effects)?;
        Ok(StageModule { spirv, entry_point: entry_point.to_owned() })
    };
    let fragment = Program::Fragment { vertex: module(VERTEX)?, fragment: module(FRAGMENT)? };
    Ok([Program::Compute(module(COMPUTE)?), fragment])
}

/// What goes to the process that compiles.
#[derive(Serialize, Deserialize)]
struct Request {
    /// A letter for each binding.
    bindings: String,
    programs: Vec<Modules>,
}

/// The modules of a program: one of compute, or of vertex and fragment.
#[derive(Serialize, Deserialize)]
struct Modules {
    /// Entry points.
    names: Vec<String>,
    /// SPIR-V in hexadecimal digits.
    spirv: Vec<String>,
}

/// What comes back.
#[derive(Serialize, Deserialize)]
struct Reply {
    device: String,
    driver: String,
    costs: Vec<Cost>,
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn bytes(digits: &str) -> Vec<u8> {
    let byte = |pair: &[u8]| u8::from_str_radix(core::str::from_utf8(pair).unwrap_or("00"), 16);
    digits.as_bytes().chunks(2).map(|pair| byte(pair).unwrap_or_default()).collect()
}

const LETTERS: [(char, Binding); 3] =
    [('b', Binding::Buffer), ('t', Binding::Texture), ('s', Binding::Sampler)];

/// Compiles programs for a family of AMD's processors in a process of its own, since the driver reads the family from the
/// environment and ends the process when it does not know it. `child` starts one that calls [`serve`].
///
/// # Errors
///
/// If the driver is missing, or the process fails.
pub fn compile_for(
    family: &str,
    bindings: &[Binding],
    programs: &[Program],
    mut child: Command,
) -> Result<(Compiler, Vec<Cost>), CostsError> {
    let modules = |program: &Program| {
        let modules = match program {
            Program::Compute(module) => vec![module],
            Program::Fragment { vertex, fragment } => vec![vertex, fragment],
        };
        Modules {
            names: modules.iter().map(|module| module.entry_point.clone()).collect(),
            spirv: modules.iter().map(|module| hexadecimal(&module.spirv)).collect(),
        }
    };
    let letter = |kind: &Binding| LETTERS.iter().find(|(_, known)| known == kind).map(|(letter, _)| letter);
    let request = Request {
        bindings: bindings.iter().filter_map(letter).collect(),
        programs: programs.iter().map(modules).collect(),
    };
    let request = toml::to_string(&request);
    let request = request.map_err(|error| CostsError::Child(error.to_string()))?;
    child
        .envs(cost::environment(family)?)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let failed = |error: std::io::Error| CostsError::Child(error.to_string());
    let mut child = child.spawn().map_err(failed)?;
    if let Some(mut to) = child.stdin.take() {
        to.write_all(request.as_bytes()).map_err(failed)?;
    }
    let output = child.wait_with_output().map_err(failed)?;
    let said = String::from_utf8_lossy(&output.stdout);
    // A test harness adds lines of its own.
    let reply = said.split(FENCE).nth(1).and_then(|reply| toml::from_str::<Reply>(reply).ok());
    let Some(reply) = reply else {
        let error = String::from_utf8_lossy(&output.stderr);
        return Err(CostsError::Child(format!("compiling for {family}: {}", error.trim())));
    };
    Ok((Compiler { device: reply.device, driver: reply.driver }, reply.costs))
}

const FENCE: &str = "\n# costs\n";

/// Compiles what [`compile_for`] of another process hands over to the standard input, and answers to the standard output.
///
/// # Errors
///
/// If the driver is missing or the input is not what it should be.
pub fn serve() -> Result<(), CostsError> {
    let failed = |error: &dyn core::fmt::Display| CostsError::Child(error.to_string());
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text).map_err(|error| failed(&error))?;
    let request: Request = toml::from_str(&text).map_err(|error| failed(&error))?;
    let program = |modules: &Modules| {
        let pairs = modules.spirv.iter().zip(&modules.names);
        let mut stages =
            pairs.map(|(spirv, name)| StageModule { spirv: bytes(spirv), entry_point: name.clone() });
        match (stages.next(), stages.next()) {
            (Some(vertex), Some(fragment)) => Ok(Program::Fragment { vertex, fragment }),
            (Some(module), None) => Ok(Program::Compute(module)),
            _ => Err(failed(&"a program without stages")),
        }
    };
    let binding = |letter: char| LETTERS.iter().find(|(known, _)| *known == letter).map(|(_, kind)| *kind);
    let bindings: Vec<Binding> = request.bindings.chars().filter_map(binding).collect();
    let programs = request.programs.iter().map(program).collect::<Result<Vec<_>, _>>()?;
    let (compiler, costs) = cost::compile_programs(&bindings, &programs)?;
    let reply = Reply { device: compiler.device, driver: compiler.driver, costs };
    let reply = toml::to_string(&reply).map_err(|error| failed(&error))?;
    print!("{FENCE}{reply}{FENCE}");
    Ok(())
}
