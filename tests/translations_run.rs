//! Every translation of the include, run on a device, gives the same values within the same bounds.

mod common;

use std::process::Command;
use std::sync::OnceLock;

use common::{Bound, Case, tools};
use softbox::device::{Device, Program};
use softbox::table::Table;
use softbox::translate::{self, Target};

const GLSL: &str = include_str!("shaders/evaluate.comp");
const HLSL: &str = include_str!("shaders/evaluate.hlsl");

struct Inputs {
    table: Table,
    cases: Vec<Case>,
    exact: Vec<[f64; 3]>,
}

fn inputs() -> &'static Inputs {
    static INPUTS: OnceLock<Inputs> = OnceLock::new();
    INPUTS.get_or_init(|| {
        let table = Table::default();
        let cases = common::cases(100);
        let exact = common::exact(&cases, &table);
        Inputs { table, cases, exact }
    })
}

fn vulkan() -> &'static Device {
    static DEVICE: OnceLock<Device> = OnceLock::new();
    DEVICE.get_or_init(|| Device::open(wgpu::Backends::VULKAN).unwrap_or_else(|error| panic!("{error}")))
}

fn wgsl() -> Program {
    Program::wgsl(format!("{}\n{}", softbox::WGSL_INCLUDE, softbox::WGSL_EVALUATE))
}

/// The evaluation kernel as a compiler translated it.
fn spirv(bytes: Vec<u8>, entry_point: &'static str) -> Program {
    // SAFETY: the kernel checks its index against the number of pairs, and walks over the vertices that a
    // light counts; `common::batch` makes both right.
    unsafe { Program::spirv(bytes, entry_point) }
}

fn opengl_program(text: String) -> Program {
    // SAFETY: as above.
    unsafe { Program::glsl(text) }
}

fn run(device: &Device, program: &Program) -> Vec<[f32; 3]> {
    let inputs = inputs();
    // Within the size of a storage buffer and the number of workgroups that every device has.
    inputs
        .cases
        .chunks(100_000)
        .flat_map(|cases| {
            device
                .evaluate(program, &inputs.table, &common::batch(cases))
                .unwrap_or_else(|error| panic!("{error}"))
        })
        .collect()
}

fn reference() -> &'static [[f32; 3]] {
    static VALUES: OnceLock<Vec<[f32; 3]>> = OnceLock::new();
    VALUES.get_or_init(|| run(vulkan(), &wgsl()))
}

fn check(what: &str, values: &[[f32; 3]]) {
    let inputs = inputs();
    common::check(what, &inputs.cases, &inputs.exact, values, &inputs.table);
}

/// How far a translation is from the WGSL on the same driver: how many values differ in any bit, and
/// the largest difference of diffuse, specular and fresnel where a bound is absolute.
fn difference(what: &str, values: &[[f32; 3]]) -> (usize, f32) {
    let mut bits = 0;
    let mut largest = 0.0_f32;
    for ((case, a), b) in inputs().cases.iter().zip(reference()).zip(values) {
        bits += a.iter().zip(b).filter(|(a, b)| a.to_bits() != b.to_bits()).count();
        if matches!(case.bound, Bound::Absolute(bound) if bound <= 2e-6) {
            largest = a.iter().zip(b).fold(largest, |largest, (a, b)| largest.max((a - b).abs()));
        }
    }
    println!("{what}: {bits} of {} values differ, by up to {largest:.2e}", 3 * values.len());
    (bits, largest)
}

#[test]
fn wgsl_on_vulkan() {
    println!("adapter: {:?}", vulkan().info());
    assert!(inputs().cases.len() >= 100_000, "{} cases are too few", inputs().cases.len());
    check("WGSL", reference());
}

#[test]
fn spirv_is_bit_identical_to_wgsl() {
    let module = translate::spirv().unwrap_or_else(|error| panic!("{error}"));
    let values = run(vulkan(), &spirv(module, "evaluate"));
    check("SPIR-V", &values);
    assert_eq!(difference("SPIR-V", &values).0, 0);
}

fn glsl(version: &str, defines: &str, target: Target) -> String {
    let include = translate::include(target).unwrap_or_else(|error| panic!("{error}"));
    format!("#version {version}\n{defines}{}", tools::with_include(GLSL, &include))
}

#[test]
fn glsl_through_glslang_is_bit_identical_to_wgsl() {
    let folder = tools::scratch("glsl");
    for (name, version, target) in [("450", "450", Target::Glsl450), ("310", "310 es", Target::GlslEs310)] {
        let source = tools::write(
            &folder,
            &format!("{name}.comp"),
            glsl(version, "#define TABLE_SEPARATE\n#define LOBES 1\n", target),
        );
        let output = folder.join(format!("{name}.spv"));
        tools::run(Command::new("glslangValidator").arg("-V").arg(&source).arg("-o").arg(&output));
        let values = run(vulkan(), &spirv(tools::read(&output), "main"));
        check(name, &values);
        assert_eq!(difference(name, &values).0, 0, "GLSL {name}");
    }
}

fn hlsl() -> String {
    let include = translate::include(Target::Hlsl).unwrap_or_else(|error| panic!("{error}"));
    tools::with_include(HLSL, &include)
}

#[test]
fn hlsl_through_dxc() {
    let folder = tools::scratch("dxc");
    let source = tools::write(&folder, "evaluate.hlsl", hlsl());
    for (level, same) in [("-O0", 1e-7), ("-O3", 1e-6)] {
        let output = folder.join(format!("evaluate{level}.spv"));
        tools::run(tools::dxc().arg(&source).arg(&output).args([
            "-T",
            "cs_6_0",
            "-E",
            "main",
            "-spirv",
            "-fspv-target-env=vulkan1.1",
            "-D",
            "VULKAN_BINDINGS",
            "-HV",
            "2018",
            level,
        ]));
        let values = run(vulkan(), &spirv(tools::read(&output), "main"));
        check(level, &values);
        assert!(difference(level, &values).1 <= same, "DXC {level}");
    }
}

#[test]
fn hlsl_through_glslang() {
    let folder = tools::scratch("glslang");
    // glslang's preprocessor takes Vulkan bindings from its own switches.
    let source = tools::write(&folder, "evaluate.hlsl", format!("#define VULKAN_BINDINGS\n{}", hlsl()));
    let output = folder.join("evaluate.spv");
    tools::run(
        Command::new("glslangValidator")
            .args(["-D", "-V", "-S", "comp", "-e", "main"])
            .arg(&source)
            .arg("-o")
            .arg(&output),
    );
    let values = run(vulkan(), &spirv(tools::read(&output), "main"));
    check("glslang -D", &values);
    assert!(difference("glslang -D", &values).1 <= 1e-6);
}

#[test]
fn opengl() {
    let device = Device::open(wgpu::Backends::GL).unwrap_or_else(|error| panic!("{error}"));
    println!("adapter: {:?}", device.info());
    for (what, program) in [
        ("WGSL on OpenGL", wgsl()),
        ("GLSL 450 on OpenGL", opengl_program(glsl("450", "", Target::Glsl450))),
        ("GLSL ES 310 on OpenGL", opengl_program(glsl("310 es", "", Target::GlslEs310))),
    ] {
        let values = run(&device, &program);
        check(what, &values);
        difference(what, &values);
    }
}

#[test]
fn metal_through_its_stand_in() {
    let folder = tools::scratch("metal");
    let include = translate::include(Target::Msl).unwrap_or_else(|error| panic!("{error}"));
    let include = tools::write(&folder, "ltc.metal", include);
    let tests = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let program = folder.join("evaluate");
    tools::run(
        Command::new("clang++")
            .args(["-std=c++17", "-O1", "-ffp-contract=off", "-Xclang", "-cl-single-precision-constant"])
            .args(["-Wall", "-Wextra", "-Werror", "-Wno-unused-parameter", "-Wno-unused-variable", "-I"])
            .arg(tests.join("tools/metal"))
            .arg(format!("-DINCLUDE=\"{}\"", include.display()))
            .arg(tests.join("shaders/evaluate.metal.cpp"))
            .arg("-o")
            .arg(&program),
    );
    let inputs = inputs();
    let batch = common::batch(&inputs.cases);
    let counts = [
        batch.surfaces.len() as u32,
        batch.lights.len() as u32,
        batch.vertices.len() as u32,
        batch.pairs.len() as u32,
        inputs.table.size() as u32,
    ];
    let mut bytes = bytemuck::cast_slice(&counts).to_vec();
    bytes.extend(bytemuck::cast_slice::<_, u8>(&batch.surfaces));
    bytes.extend(bytemuck::cast_slice::<_, u8>(&batch.lights));
    bytes.extend(bytemuck::cast_slice::<_, u8>(&batch.vertices));
    bytes.extend(bytemuck::cast_slice::<_, u8>(&batch.pairs));
    for half in inputs.table.bytes().chunks_exact(2) {
        bytes.extend(half::f16::from_le_bytes([half[0], half[1]]).to_f32().to_le_bytes());
    }
    let input = tools::write(&folder, "input.bin", bytes);
    let output = folder.join("output.bin");
    tools::run(Command::new(&program).arg(&input).arg(&output));
    let values: Vec<[f32; 3]> = tools::read(&output)
        .chunks_exact(16)
        .map(|value| bytemuck::pod_read_unaligned(&value[..12]))
        .collect();
    check("Metal", &values);
    difference("Metal", &values);
}
