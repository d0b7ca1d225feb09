//! What counts operations runs kernels as a device does, and counts what a hand counts.

use softbox::TABLE_SIZE;
use softbox::device::{Device, Program};
use softbox::effects::Effects;
use softbox::report::costs::inputs;
use softbox::report::costs::{
    Adapter, BASELINE, Bench, Bound, COMPUTE, EFFECTS, Executed, INPUTS, Interpreter, Job, Kernel,
    Operations, Texels, execute, executed_growth, lobes_of_one_light, scene,
};
use softbox::translate::kernel_spirv;

/// What a device and the interpreter write to the output of a job.
fn both(job: &Job, entry_point: &'static str, invocations: u32) -> [Vec<f32>; 2] {
    let device = Device::open(wgpu::Backends::VULKAN).unwrap_or_else(|error| panic!("{error}"));
    let mut interpreter =
        Interpreter::new(&job.source, entry_point, job.effects).unwrap_or_else(|error| panic!("{error}"));
    let mut buffers = Vec::new();
    let mut output: Option<(u32, usize)> = None;
    for (binding, bound) in (0..).zip(&job.bound) {
        let (contents, usage) = match bound {
            Bound::Input(bytes) => (bytes.clone(), wgpu::BufferUsages::STORAGE),
            Bound::Output(size) => {
                output = Some((binding, buffers.len()));
                (vec![0; *size as usize], wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC)
            }
            Bound::Table(bytes) => {
                interpreter.bind_texels(binding, Texels::new(TABLE_SIZE, bytes));
                continue;
            }
            Bound::Sampler => continue,
        };
        interpreter.bind_buffer(binding, contents.clone());
        let descriptor = wgpu::util::BufferInitDescriptor { label: None, contents: &contents, usage };
        buffers.push(wgpu::util::DeviceExt::create_buffer_init(device.device(), &descriptor));
    }
    for at in 0..invocations {
        interpreter.run(at).unwrap_or_else(|error| panic!("{error}"));
    }
    let mut resources: Vec<_> = buffers.iter().map(wgpu::Buffer::as_entire_binding).collect();
    let uploaded = job.bound.iter().find_map(|bound| match bound {
        Bound::Table(bytes) => Some(upload(&device, bytes)),
        _ => None,
    });
    if let Some((view, sampler)) = &uploaded {
        resources.push(wgpu::BindingResource::TextureView(view));
        resources.push(wgpu::BindingResource::Sampler(sampler));
    }
    let spirv = kernel_spirv(&job.source, entry_point, job.effects).unwrap_or_else(|error| panic!("{error}"));
    // SAFETY: naga has validated it, and the interpreter has found no index out of bounds.
    let program = unsafe { Program::spirv(spirv, entry_point) };
    let (binding, index) = output.unwrap_or_else(|| panic!("a job without an output"));
    let bytes = device
        .compute(&program, entry_point, &resources, [invocations.div_ceil(64), 1], &buffers[index])
        .unwrap_or_else(|error| panic!("{error}"));
    [bytemuck::pod_collect_to_vec(&bytes), bytemuck::pod_collect_to_vec(interpreter.buffer(binding))]
}

fn upload(device: &Device, bytes: &[u8]) -> (wgpu::TextureView, wgpu::Sampler) {
    use softbox::table::{Layer, Table};
    let layers = [
        Layer::Shape,
        Layer::Amplitude,
        Layer::Sheen,
        Layer::Diffuse,
        Layer::AnisotropicFirst,
        Layer::AnisotropicSecond,
    ];
    let count = bytes.len() / (8 * TABLE_SIZE * TABLE_SIZE);
    let table = Table::from_layers(TABLE_SIZE, &layers[..count], bytes);
    device.upload_table(&table.unwrap_or_else(|error| panic!("{error}")))
}

fn assert_close(what: &str, [device, interpreted]: [Vec<f32>; 2], tolerance: f32) {
    assert_eq!(device.len(), interpreted.len());
    let nothing = device.iter().all(|value| *value == 0.0);
    assert!(!nothing, "{what}: the device wrote nothing");
    for (at, (device, interpreted)) in device.iter().zip(&interpreted).enumerate() {
        let close = (device - interpreted).abs() <= tolerance * (1.0 + device.abs());
        assert!(close, "{what}, number {at}: {device} on the device, {interpreted} interpreted");
    }
}

fn job(kernel: &Kernel, inputs: &[inputs::Input]) -> Job {
    let (surfaces, quads) = inputs::buffers(inputs);
    let bound = vec![
        Bound::Input(surfaces),
        Bound::Input(quads),
        Bound::Output(16 * inputs.len() as u64),
        Bound::Table(kernel.table.to_vec()),
        Bound::Sampler,
    ];
    Job { source: kernel.source(), entry_point: COMPUTE, effects: kernel.effects, bound }
}

#[test]
fn methods_have_the_same_values_interpreted_as_on_a_device() {
    let mut inputs = inputs::random(250);
    inputs.extend(inputs::named().into_iter().map(|(_, input)| input));
    let mut kernels = Kernel::levels();
    for shared in [true, false] {
        kernels.push(lobes_of_one_light(2, shared).unwrap_or_else(|error| panic!("{error}")));
    }
    for kernel in kernels {
        // The published edge integral has no more digits where a light touches the surface.
        let tolerance = if kernel.name == BASELINE { 3e-4 } else { 3e-5 };
        assert_close(&kernel.name, both(&job(&kernel, &inputs), COMPUTE, 256), tolerance);
    }
}

#[test]
fn scenes_have_the_same_values_interpreted_as_on_a_device() {
    for set in EFFECTS {
        let effects: Effects = set.parse().unwrap_or_else(|error| panic!("{error}"));
        let job = scene(effects, 3, 7, 64);
        assert_close(set, both(&job, job.entry_point, 64), 3e-5);
    }
}

/// Everything that comparators may be written with: loops, switches, arrays, matrices, pointers, whole numbers.
const LANGUAGE: &str = "
struct Pair { first: vec3<f32>, second: mat3x3<f32> }
@group(0) @binding(0) var<storage, read> numbers: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> results: array<vec4<f32>>;
const STEPS: array<f32, 3> = array<f32, 3>(0.5, 1.5, 2.5);
fn hash(value: u32) -> u32 {
    var state = value * 747796405u + 2891336453u;
    state = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (state >> 22u) ^ state;
}
fn halve(value: ptr<function, vec3<f32>>, at: i32) { (*value)[at] *= 0.5; (*value).y -= 0.25; }
fn early(x: f32) -> f32 { if (x > 0.5) { return 1.0; } for (var i = 0; i < 5; i++) { if (f32(i) > 4.0 * x) { return f32(i); } } return -1.0; }
@compute @workgroup_size(64) fn language(@builtin(global_invocation_id) invocation: vec3<u32>) {
    let v = numbers[invocation.x];
    var sum = 0.0;
    var state = invocation.x;
    for (var i = 0u; i < 4u + (invocation.x & 3u); i++) {
        state = hash(state);
        if ((state & 7u) == 3u) { continue; }
        if ((state & 63u) == 5u) { break; }
        sum += f32(state >> 8u) * (1.0 / 16777216.0);
    }
    var steps = STEPS;
    steps[invocation.x % 3u] += v.x;
    var picked = 0.0;
    switch invocation.x & 3u {
        case 0u: { picked = 1.0; }
        case 1u, 2u: { picked = steps[2]; if (v.x > 0.5) { break; } picked = -picked; }
        default: { picked = cos(v.y); }
    }
    var moved = v.xyz;
    halve(&moved, 2);
    var pair: Pair;
    pair.first = normalize(moved + 0.1);
    pair.second = mat3x3<f32>(v.xyz, cross(v.xyz, pair.first), vec3<f32>(v.w, 0.0, 1.0));
    let turned = transpose(pair.second) * pair.first + pair.first * pair.second;
    let signs = sign(v - 0.5);
    let any_large = any(v.xy > vec2<f32>(0.9)) | all(v < vec4<f32>(0.5));
    results[invocation.x] = vec4<f32>(sum + picked, length(turned) + early(v.z), select(mix(v.x, v.y, v.z), step(0.3, v.w), any_large),
        dot(signs, vec4<f32>(1.0, 2.0, 4.0, 8.0)) + floor(v.x * 8.0) + fract(v.y * 8.0) + clamp(v.z, 0.2, 0.6) + pow(v.w + 0.1, 1.5) + reflect(v.xyz, pair.first).z + f32(i32(v.x * 10.0) / 3));
}";

#[test]
fn the_language_of_methods_is_run_as_a_device_runs_it() {
    let number = |at: u32| (at.wrapping_mul(2_654_435_761) >> 8) as f32 / 16_777_216.0;
    let numbers: Vec<f32> = (0..1024).map(number).collect();
    let bound = vec![Bound::Input(bytemuck::cast_slice(&numbers).to_vec()), Bound::Output(4096)];
    let job = Job { source: LANGUAGE.to_owned(), entry_point: "language", effects: Effects::NONE, bound };
    assert_close("language", both(&job, "language", 256), 1e-5);
}

/// What the body of a function of a vector `v`, which returns a number, takes when it is run.
fn count(body: &str, invocation: u32) -> Executed {
    let source = format!(
        "@group(0) @binding(0) var<storage, read> numbers: array<vec4<f32>>;
        @group(0) @binding(1) var<storage, read_write> results: array<f32>;
        fn value(v: vec4<f32>, at: u32) -> f32 {{ {body} }}
        @compute @workgroup_size(64) fn count(@builtin(global_invocation_id) invocation: vec3<u32>) {{
            results[invocation.x] = value(numbers[invocation.x], invocation.x);
        }}"
    );
    let mut interpreter =
        Interpreter::new(&source, "count", Effects::NONE).unwrap_or_else(|error| panic!("{body}: {error}"));
    let numbers: Vec<f32> = (1..=16).map(|at| at as f32).collect();
    interpreter.bind_buffer(0, bytemuck::cast_slice(&numbers).to_vec());
    interpreter.bind_buffer(1, vec![0; 16]);
    let run = interpreter.run(invocation);
    run.unwrap_or_else(|error| panic!("{body}: {error}"))
}

#[test]
fn operations_are_what_a_hand_counts() {
    let of = |arithmetic, special, decisions, branches| Operations {
        arithmetic,
        special,
        decisions,
        branches,
        ..Operations::default()
    };
    let cases = [
        ("return v.x * v.y;", of(1, 0, 0, 0)),
        ("return v.x * v.y + v.z;", of(1, 0, 0, 0)),
        ("return v.x * v.y + v.z * v.w;", of(2, 0, 0, 0)),
        // The product has two readers.
        ("let p = v.x * v.y; return (p + v.z) * p;", of(3, 0, 0, 0)),
        ("return dot(v, v);", of(4, 0, 0, 0)),
        ("return cross(v.xyz, v.yzw).x;", of(2, 0, 0, 0)),
        ("return 1.0 / v.x;", of(0, 1, 0, 0)),
        ("return v.x / v.y;", of(1, 1, 0, 0)),
        ("return v.x / 3.0;", of(1, 0, 0, 0)),
        ("return normalize(v.xyz).x;", of(4, 1, 0, 0)),
        // What nothing reads, what is known beforehand, and what has been computed.
        ("let unread = sin(v.x); return v.y + sqrt(4.0);", of(1, 0, 0, 0)),
        ("return (v.x + v.y) * (v.x + v.y);", of(2, 0, 0, 0)),
        ("return -abs(v.x) * 1.0 + 0.0;", of(0, 0, 0, 0)),
        ("return saturate(v.x + v.y);", of(1, 0, 0, 0)),
        ("return clamp(v.x, 0.5, 1.0);", of(2, 0, 0, 0)),
        ("return select(v.x, v.y, v.z > v.w);", of(0, 0, 2, 0)),
        ("return select(v.x, v.y, 1.0 > 2.0);", of(0, 0, 0, 0)),
        ("if (v.x > 100.0) { return sqrt(v.y); } return v.z * v.w;", of(1, 0, 1, 1)),
        ("if (v.x < 100.0) { return sqrt(v.y); } return v.z * v.w;", of(0, 1, 1, 1)),
        // A loop of a known number of turns is no loop.
        ("var s = v.x; for (var i = 0; i < 3; i++) { s = s * s; } return s;", of(3, 0, 0, 0)),
        // One of an unknown number, here 2, counts its turns, compares and branches before each and after the last.
        ("var s = v.x; for (var i = 0.0; i < v.y; i += 1.0) { s = s * s; } return s;", of(4, 0, 3, 3)),
    ];
    for (body, expected) in cases {
        let total = Operations { loads: 0, ..count(body, 0).total() };
        assert_eq!(total, expected, "of {body}");
        assert_eq!(expected.slots(), expected.count() + 3 * expected.special);
    }
}

#[test]
fn a_wave_takes_what_any_of_it_takes() {
    let body = "if ((at & 1u) == 0u) { return sqrt(v.x); } return v.y * v.z * v.w;";
    let source = |at| count(body, at).total();
    assert_eq!((source(0).special, source(1).special), (1, 0));
    // Sites are those of one interpreter, so the kernel of the include serves here.
    let inputs: Vec<_> = inputs::waves(2).concat();
    for kernel in Kernel::levels() {
        let executed = execute(&kernel, &inputs).unwrap_or_else(|error| panic!("{error}"));
        for wave in executed.chunks(inputs::WAVE) {
            let slots = wave.iter().map(|(_, executed)| executed.total().slots());
            let (most, sum) = (slots.clone().max().unwrap_or_default(), slots.sum::<u64>());
            let together = Executed::wave(wave.iter().map(|(_, executed)| executed)).slots();
            assert!(most <= together && together <= sum, "{}: {most}, {together}, {sum}", kernel.name);
            let same = Executed::wave([&wave[0].1, &wave[0].1]);
            assert_eq!(same, wave[0].1.total(), "{}", kernel.name);
        }
    }
}

#[test]
fn costs_grow_with_lights_vertices_and_lobes() {
    let curves = executed_growth().unwrap_or_else(|error| panic!("{error}"));
    let mut charts = 0;
    let named = ["effects", "lobes"];
    for curve in curves.iter().filter(|curve| !named.contains(&curve.chart.as_str())) {
        charts += 1;
        assert!(curve.x.len() == curve.y.len() && curve.x.len() >= 4, "{curve:?}");
        assert!(
            curve.y.windows(2).all(|pair| pair[0] < pair[1]),
            "{} of {}: {:?}",
            curve.chart,
            curve.method,
            curve.y
        );
    }
    assert!(charts >= 7, "{charts} curves");
    for curve in curves.iter().filter(|curve| curve.chart == "lobes") {
        let slots = |name: &str| curve.y[curve.names.iter().position(|one| one == name).expect("a name")];
        let sums = ["diffuse", "specular", "two lobes", "three lobes"].map(slots);
        let layers = ["diffuse", "specular", "and a coat", "and a sheen", "and rough diffuse"].map(slots);
        assert!(sums.is_sorted() && layers.is_sorted(), "{sums:?}, {layers:?}");
    }
    let of = |name: &str| curves.iter().find(|curve| curve.method == name).map(|curve| curve.y[3]);
    let (once, each) = (of("ltc_quad_begin once"), of("ltc_quad for each lobe"));
    assert!(once < each, "four lobes: {once:?} with the work on the light shared, {each:?} without");
}

#[test]
fn a_missing_adapter_is_told_with_those_that_are_there() {
    let Err(error) = Bench::open(&Adapter::Named("no such device".to_owned())) else {
        panic!("an adapter of that name was found");
    };
    assert!(error.to_string().contains("no such device"), "{error}");
}

/// Also by the device's own clock, which a graphics processor is measured by.
#[test]
fn methods_are_timed_by_either_clock() {
    use softbox::report::costs::{Effort, time};
    let effort = Effort { rounds: 2, nanoseconds: 1e5 };
    for adapter in [Adapter::Software, Adapter::Named("llvmpipe".to_owned())] {
        let measured =
            time(&Kernel::levels(), &adapter, effort, "test").unwrap_or_else(|error| panic!("{error}"));
        assert!(measured.device.contains("llvmpipe"), "{}", measured.device);
        let base = measured.times.iter().find(|time| time.method == BASELINE);
        assert!(base.is_some_and(|time| (time.ratio - 1.0).abs() < 1e-12), "{:?}", measured.times);
        for time in &measured.times {
            assert!(
                time.nanoseconds > 0.0 && time.ratio > 0.0 && time.median_ratio > 0.0 && time.spread >= 0.0,
                "{time:?}"
            );
        }
    }
    assert!(INPUTS.is_power_of_two(), "kernels wrap indices around {INPUTS} inputs");
}
