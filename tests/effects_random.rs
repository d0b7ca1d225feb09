//! Selection from programs that nobody would write: random branches on random conditions.

mod common;
#[path = "common/sets.rs"]
mod sets;

use std::process::Command;

use common::{Random, tools};
use softbox::device::{Device, Program};
use softbox::effects::{Effects, wgsl_from};
use softbox::translate::{self, Target};
use wgpu::util::DeviceExt;

const PROGRAMS: u64 = 60;

const HEAD: &str = "// A random include.

override ltc_use_disk: bool = true;
override ltc_use_sheen: bool = true;
override ltc_use_rough_diffuse: bool = true;

fn ltc_helper_a(v: f32) -> f32 {
    return v * 0.5 + 1.0;
}

fn ltc_helper_b(v: f32) -> f32 {
    return ltc_helper_a(v) - 3.0;
}

fn ltc_disk_begin(v: f32) -> f32 {
    return v + 2.0;
}

fn ltc_disk_diffuse(v: f32) -> f32 {
    return v + 4.0;
}
fn ltc_disk_lobe(v: f32) -> f32 {
    return v + 8.0;
}
fn ltc_disk(v: f32) -> f32 {
    return v + 16.0;
}

";

const KERNEL: &str = "
@group(0) @binding(0) var<storage, read> inputs: array<u32>;
@group(0) @binding(1) var<storage, read_write> values: array<f32>;

@compute @workgroup_size(64)
fn evaluate(@builtin(global_invocation_id) invocation: vec3<u32>) {
    values[invocation.x] = ltc_surface(f32(inputs[invocation.x] & 7u), inputs[invocation.x]);
}
";

struct Writer {
    random: Random,
    text: String,
}

impl Writer {
    fn pick(&mut self, count: u32) -> u32 {
        self.random.index(count as usize) as u32
    }

    fn condition(&mut self, depth: u32) -> String {
        match self.pick(if depth == 0 { 6 } else { 10 }) {
            0 => "ltc_use_disk".to_owned(),
            1 => "ltc_use_sheen".to_owned(),
            2 => "ltc_use_rough_diffuse".to_owned(),
            3 => "(kind > 20u)".to_owned(),
            4 => "(value < 4.0)".to_owned(),
            5 => "flag".to_owned(),
            6 => format!("!({})", self.condition(depth - 1)),
            7 => {
                format!("select({}, {}, ltc_use_sheen)", self.condition(depth - 1), self.condition(depth - 1))
            }
            8 => format!("({} | {})", self.condition(depth - 1), self.condition(depth - 1)),
            _ => format!("({} & {})", self.condition(depth - 1), self.condition(depth - 1)),
        }
    }

    fn block(&mut self, depth: u32, looped: bool) {
        let indent = "    ".repeat(4 - depth as usize);
        let mut declared = Vec::new();
        for _ in 0..=self.pick(4) {
            let constant = self.pick(9);
            match self.pick(if depth == 0 { 4 } else { 8 }) {
                0 => self.text.push_str(&format!("{indent}value = value * 0.75 + {constant}.0;\n")),
                1 => {
                    let name = ["part", "other", "rest"][self.pick(3) as usize];
                    if !declared.contains(&name) {
                        declared.push(name);
                        self.text
                            .push_str(&format!("{indent}let {name} = ltc_helper_b(value + {constant}.0);\n"));
                        if self.pick(3) > 0 {
                            self.text.push_str(&format!("{indent}value += {name};\n"));
                        }
                    }
                }
                2 => self
                    .text
                    .push_str(&format!("{indent}// A remark.\n{indent}value = ltc_helper_a(value);\n")),
                3 => {
                    let condition = self.condition(2);
                    self.text.push_str(&format!(
                        "{indent}value = select(value, ltc_disk_diffuse(value), {condition});\n"
                    ));
                }
                4 => {
                    self.text.push_str(&format!("{indent}for (var i = 0; i < {}; i++) {{\n", constant % 4));
                    self.block(depth - 1, true);
                    self.text.push_str(&format!("{indent}}}\n"));
                }
                _ => {
                    let condition = self.condition(2);
                    self.text.push_str(&format!("{indent}if ({condition}) {{\n"));
                    self.block(depth - 1, looped);
                    while self.pick(3) == 0 {
                        let condition = self.condition(2);
                        self.text.push_str(&format!("{indent}}} else if ({condition}) {{\n"));
                        self.block(depth - 1, looped);
                    }
                    if self.pick(2) == 0 {
                        self.text.push_str(&format!("{indent}}} else {{\n"));
                        self.block(depth - 1, looped);
                    }
                    self.text.push_str(&format!("{indent}}}\n"));
                }
            }
        }
        match self.pick(8) {
            0 if depth < 3 => self.text.push_str(&format!("{indent}return value;\n")),
            1 if looped && depth < 3 => self.text.push_str(&format!("{indent}break;\n")),
            _ => {}
        }
    }
}

fn program(seed: u64) -> String {
    let mut writer = Writer { random: Random::new(seed), text: HEAD.to_owned() };
    writer.text.push_str("fn ltc_surface(start: f32, kind: u32) -> f32 {\n    var value = start;\n    let flag = (kind & 1u) != 0u;\n");
    writer.block(if seed.is_multiple_of(2) { 3 } else { 2 }, false);
    writer.text.push_str("    return value;\n}\n");
    sets::completed(&writer.text)
}

fn some_sets() -> impl Iterator<Item = Effects> {
    let present = Effects::declared(HEAD);
    Effects::every().filter(move |effects| present.is_superset(*effects) && !effects.is_empty())
}

#[test]
fn random_programs_keep_their_meaning() {
    let device = Device::open(wgpu::Backends::VULKAN).unwrap_or_else(|error| panic!("{error}"));
    let inputs: Vec<u32> = (0..64).collect();
    let input = device.device().create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(&inputs),
        usage: wgpu::BufferUsages::STORAGE,
    });
    let output = device.device().create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 256,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let run = |program: &Program| -> Vec<u32> {
        let resources = [input.as_entire_binding(), output.as_entire_binding()];
        let bytes = device.compute(program, "evaluate", &resources, [1, 1], &output);
        bytemuck::pod_collect_to_vec(&bytes.unwrap_or_else(|error| panic!("{error}")))
    };
    let mut different = 0;
    for seed in 0..PROGRAMS {
        let include = program(seed);
        let source = format!("{include}{KERNEL}");
        let mut values = Vec::new();
        for effects in some_sets() {
            let mut switched = source.clone();
            for (switch, on) in effects.switches() {
                switched =
                    switched.replace(&format!("{switch}: bool = true"), &format!("{switch}: bool = {on}"));
            }
            let overridden = run(&Program::wgsl(switched));
            let kernel = translate::kernel_spirv(&source, "evaluate", effects);
            let kernel = kernel.unwrap_or_else(|error| panic!("{seed}, {effects}: {error}\n{source}"));
            // SAFETY: one workgroup of 64 invocations, each of which touches one element of 64; loops end.
            let selected = run(&unsafe { Program::spirv(kernel, "evaluate") });
            assert_eq!(overridden, selected, "{seed}, {effects}:\n{include}");

            let text = wgsl_from(&include, effects).unwrap_or_else(|error| panic!("{error}"));
            let from = |text: &str| translate::library_spirv(text, effects);
            assert!(from(&text).is_ok(), "{seed}, {effects}: {:?}\n{include}\nbecame\n{text}", from(&text));
            assert!(from(&text) == from(&include), "{seed}, {effects}:\n{include}\nbecame\n{text}");
            values.push(selected);
        }
        different += usize::from(values.iter().any(|value| *value != values[0]));
    }
    assert!(different as u64 > PROGRAMS / 2, "only {different} programs depend on their switches");
    println!("{different} of {PROGRAMS} programs depend on their switches");
}

#[test]
fn random_programs_compile_by_macros() {
    let folder = tools::scratch("random_macros");
    for seed in PROGRAMS..PROGRAMS + 20 {
        let include = program(seed);
        let text = translate::switchable_from(&include, Target::Glsl450);
        let text = text.unwrap_or_else(|error| panic!("{seed}: {error}\n{include}"));
        for effects in some_sets() {
            let switched = Effects::declared(HEAD).iter().filter(|effect| !effect.entry().switch.is_empty());
            let macros: String = switched
                .map(|effect| {
                    format!("#define {} {}\n", effect.switch_macro(), u8::from(effects.contains(effect)))
                })
                .collect();
            let main = "void main() {\n    ltc_surface(0.5, 1u);\n}\n";
            let file = format!("{seed}_{effects}.frag");
            let source = tools::write(&folder, &file, format!("#version 450\n{macros}{text}{main}"));
            tools::assert_silent(&tools::run(Command::new("glslangValidator").arg(&source)), &[&file]);
        }
    }
}
