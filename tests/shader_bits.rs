//! Any bits at all into the shaders: every dispatch ends, and where the include promises values they are physical.
//!
//! Its promise, at the top of `ltc.wgsl`, is for coordinates that are finite, a normal and a view that are not zero, roughness
//! within 0 to 1 and a positive radius. For anything else a value may be anything; the dispatch must still end.

mod common;
mod loops;

use std::fmt::Write;

use bytemuck::{Pod, Zeroable};
use common::Random;
use softbox::device::{Device, Program};
use softbox::effects::{Effects, Quality};
use softbox::table::{AnisotropicTable, Table};
use wgpu::util::DeviceExt;

/// Evaluations of each quality level, half of them of what the include promises something for.
const COUNT: usize = 1 << 20;

/// Those of one dispatch.
const CHUNK: usize = 1 << 18;

/// Numbers at which something happens.
const SPECIAL: [f32; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    f32::MIN_POSITIVE,
    1e-45,
    -1e-40,
    f32::MAX,
    f32::MIN,
    1e-37,
    1e37,
    f32::EPSILON,
    0.5,
    16.0,
    1e-20,
    1e20,
];

/// What is no number, and what is none that is finite.
const WILD: [u32; 6] = [0x7F80_0000, 0xFF80_0000, 0x7FC0_0000, 0xFFC0_0001, 0x7F80_0001, 0x7FFF_FFFF];

/// A number: any finite bits, a special one, or one like its neighbours, so that some lights are seen.
fn finite(random: &mut Random) -> f32 {
    match random.index(4) {
        0 => random.finite(),
        1 => SPECIAL[random.index(SPECIAL.len())],
        _ => (random.between(-4.0, 4.0) * 16.0).round() as f32 / 16.0,
    }
}

/// Any bits: what is not finite, too.
fn any(random: &mut Random) -> f32 {
    match random.index(6) {
        0 => f32::from_bits(WILD[random.index(WILD.len())]),
        1 => f32::from_bits((random.unit() * 4_294_967_296.0) as u32),
        _ => finite(random),
    }
}

fn vector(random: &mut Random, number: fn(&mut Random) -> f32) -> [f32; 3] {
    // Whole vectors of ordinary numbers now and then: three at once are rare otherwise.
    let calm = random.index(3) > 0;
    [(); 3]
        .map(|()| if calm { (random.between(-3.0, 3.0) * 8.0).round() as f32 / 8.0 } else { number(random) })
}

/// An input of `tests/shaders/bits.wgsl`.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
struct Case {
    position: [f32; 3],
    roughness: f32,
    normal: [f32; 3],
    radius: f32,
    view: [f32; 3],
    kind: u32,
    a: [f32; 3],
    flag: u32,
    b: [f32; 3],
    spare_a: f32,
    c: [f32; 3],
    spare_b: f32,
    d: [f32; 3],
    spare_c: f32,
}

const KINDS: u32 = 5;

fn case(random: &mut Random, index: usize, number: fn(&mut Random) -> f32) -> Case {
    let mut v = || vector(random, number);
    let [position, normal, view, a, b, c, d] = [v(), v(), v(), v(), v(), v(), v()];
    let promised = index.is_multiple_of(2);
    Case {
        position,
        roughness: if promised { random.unit() as f32 } else { number(random) },
        normal,
        radius: if promised { number(random).abs() } else { number(random) },
        view,
        kind: (index / 2) as u32 % KINDS,
        a,
        flag: random.index(2) as u32,
        b,
        c,
        d,
        ..Case::default()
    }
}

/// Whether the include promises something: see the top of this file. Subnormal numbers may count as zero.
fn is_promised(case: &Case) -> bool {
    let finite = |v: [f32; 3]| v.iter().all(|number| number.is_finite());
    let directed = |v: [f32; 3]| finite(v) && v.iter().any(|number| number.is_normal());
    finite(case.position)
        && directed(case.normal)
        && directed(case.view)
        && (0.0..=1.0).contains(&case.roughness)
        && [case.a, case.b, case.c, case.d].into_iter().all(finite)
        && (!matches!(case.kind, 2 | 3) || (case.radius.is_normal() && case.radius > 0.0))
}

/// What is wrong with the values of a case that the include promises something for.
fn fault([value, place, level]: [[f32; 4]; 3]) -> Option<&'static str> {
    let [diffuse, specular, fresnel, albedo] = value;
    // One rounding each of the sum over the lobes.
    let albedo = albedo * (1.0 + 1e-6);
    if !(0.0..=1.0).contains(&diffuse) {
        Some("the form factor is not from 0 to 1")
    } else if !(0.0..=albedo).contains(&specular) || albedo > 1.001 {
        Some("the specular value is not from 0 to the albedo")
    } else if !(0.0..=specular * (1.0 + 1e-6)).contains(&fresnel) {
        Some("Schlick's part is not from 0 to the specular value")
    } else if !place[..2].iter().all(|share| (0.0..=1.0).contains(share)) {
        Some("the place in the picture is not from 0 to 1")
    } else if !(place[2].is_finite() && place[3].is_finite() && level[0] >= 0.0 && level[0].is_finite()) {
        Some("the level of the picture is not a number from 0 on")
    } else {
        None
    }
}

fn source(include: &str, kernel: &str) -> Program {
    Program::wgsl(format!("{include}\n{kernel}"))
}

/// Runs a kernel over inputs, with `outputs` vectors for each.
fn run<T: Pod>(
    device: &Device,
    (program, entry): (&Program, &str),
    table: &Table,
    cases: &[T],
    outputs: usize,
) -> Vec<[f32; 4]> {
    let inputs = device.device().create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(cases),
        usage: wgpu::BufferUsages::STORAGE,
    });
    let output = device.device().create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: (16 * outputs * cases.len()) as u64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let (view, sampler) = device.upload_table(table);
    let resources = [
        inputs.as_entire_binding(),
        output.as_entire_binding(),
        wgpu::BindingResource::TextureView(&view),
        wgpu::BindingResource::Sampler(&sampler),
    ];
    let groups = [(cases.len() as u32).div_ceil(64), 1];
    let bytes =
        device.compute(program, entry, &resources, groups, &output).unwrap_or_else(|error| panic!("{error}"));
    bytemuck::pod_collect_to_vec(&bytes)
}

fn open() -> Device {
    Device::open(wgpu::Backends::VULKAN).unwrap_or_else(|error| panic!("{error}"))
}

/// Counts, and panics with the first faults.
#[derive(Default)]
struct Tally {
    promised: usize,
    lit: usize,
    faults: usize,
    text: String,
}

impl Tally {
    fn add(&mut self, fault: Option<&str>, lit: bool, shown: impl FnOnce() -> String) {
        self.promised += 1;
        self.lit += usize::from(lit);
        if let Some(fault) = fault {
            self.faults += 1;
            if self.faults <= 8 {
                let _ = writeln!(self.text, "{fault}: {}", shown());
            }
        }
    }

    fn finish(&self, what: &dyn core::fmt::Display, all: usize) {
        println!("{what}: {all} ended; of {} promised {} are lit", self.promised, self.lit);
        assert_eq!(self.faults, 0, "{what}: {} of {}:\n{}", self.faults, self.promised, self.text);
        assert!(self.promised > all / 8 && self.lit > self.promised / 50, "{what}: too few to tell");
    }
}

fn bits_of(v: &[f32]) -> String {
    v.iter().map(|number| format!("{number:?} ({:#010x}) ", number.to_bits())).collect()
}

#[test]
fn every_light_ends_and_is_physical_where_it_is_promised() {
    let device = open();
    for level in Quality::ALL {
        let set: Effects =
            "quad,polygon,disk,sphere,tube,textured+ggx+two-sided,caps".parse().expect("a set");
        let effects = level.of(set);
        let table = Table::default().completed(&effects.layers());
        let layers = effects.layers();
        let table = if layers.is_empty() { table } else { table.only(&layers) };
        let include = softbox::effects::wgsl(effects).unwrap_or_else(|error| panic!("{error}"));
        let program = source(&include, include_str!("shaders/bits.wgsl"));
        let mut random = Random::new(31);
        let mut tally = Tally::default();
        for chunk in 0..COUNT / CHUNK {
            let number = |index: usize| if index.is_multiple_of(2) { finite } else { any };
            let cases: Vec<Case> =
                (0..CHUNK).map(|index| case(&mut random, chunk * CHUNK + index, number(index))).collect();
            let values = run(&device, (&program, "bits"), &table, &cases, 3);
            for (case, value) in cases.iter().zip(values.chunks_exact(3)) {
                if is_promised(case) {
                    let value = [value[0], value[1], value[2]];
                    tally.add(fault(value), value[0][0] > 0.0, || format!("{value:?} of {case:?}"));
                }
            }
        }
        tally.finish(&level, COUNT);
    }
}

/// The check above fails for values that are not physical.
#[test]
fn faults_are_seen() {
    let good = [[0.5, 0.25, 0.125, 0.75], [0.5, 0.5, 0.1, 0.1], [3.0, 0.0, 0.0, 0.0]];
    assert_eq!(fault(good), None);
    for (vector, number, value) in [
        (0, 0, f32::NAN),
        (0, 0, 1.0001),
        (0, 0, -1e-9),
        (0, 1, 0.7501),
        (0, 1, f32::NAN),
        (0, 2, 0.2501),
        (0, 3, f32::NAN),
        (1, 0, 1.5),
        (1, 2, f32::INFINITY),
        (2, 0, f32::NAN),
    ] {
        let mut bad = good;
        bad[vector][number] = value;
        assert!(fault(bad).is_some(), "{bad:?}");
    }
}

/// An input of `tests/shaders/whole.wgsl`: numbers in the order of its fields, with the places of the two that are none.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
struct Whole([f32; 44]);

/// Where a whole surface's vectors of coordinates, its shares of 0 to 1, its kind and its flag stand.
const COORDINATES: [usize; 8] = [0, 4, 8, 24, 28, 32, 36, 40];
const SHARES: [usize; 15] = [3, 7, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23];
const RADIUS: usize = 27;
const KIND: usize = 31;
const FLAG: usize = 35;

fn whole(random: &mut Random, index: usize, kind: u32) -> Whole {
    let promised = index.is_multiple_of(2);
    let number = if promised { finite } else { any };
    let mut numbers = [0.0; 44];
    numbers.fill_with(|| number(random));
    for at in COORDINATES {
        numbers[at..at + 3].copy_from_slice(&vector(random, number));
    }
    if promised {
        SHARES.iter().for_each(|at| {
            numbers[*at] = [random.unit() as f32, 0.0, 1.0][random.index(4).saturating_sub(1)]
        });
        numbers[RADIUS] = numbers[RADIUS].abs();
    }
    numbers[KIND] = f32::from_bits(kind);
    numbers[FLAG] = f32::from_bits(random.index(2) as u32);
    Whole(numbers)
}

fn is_whole_promised(Whole(numbers): &Whole, kind: u32) -> bool {
    let v = |at: usize| &numbers[at..at + 3];
    let finite = COORDINATES.iter().all(|at| v(*at).iter().all(|number| number.is_finite()));
    let directed = [4, 8].iter().all(|at| v(*at).iter().any(|number| number.is_normal()));
    let shares = SHARES.iter().all(|at| (0.0..=1.0).contains(&numbers[*at]));
    let radius = numbers[RADIUS];
    finite && directed && shares && (!matches!(kind, 2 | 3) || (radius.is_normal() && radius > 0.0))
}

/// Whole surfaces of every layer, with numbers of any bits in all that a material has.
#[test]
fn every_whole_surface_ends_and_is_finite_where_it_is_promised() {
    let device = open();
    let lights = ["quad", "disk", "sphere", "tube", "polygon"];
    let count = 1 << 16;
    for level in Quality::ALL {
        for (kind, light) in lights.iter().enumerate() {
            let option = ["+two-sided", "+two-sided", "", "+caps", "+two-sided"][kind];
            let surface = "ggx,clearcoat,sheen,rough-diffuse,energy-compensation,anisotropic";
            let effects: Effects =
                format!("{light}+{surface}{option}").parse().unwrap_or_else(|error| panic!("{error}"));
            let effects = level.of(effects);
            let table = Table::default()
                .with(&Table::sheen())
                .with(&Table::diffuse())
                .with(AnisotropicTable::default().layers())
                .completed(&effects.layers());
            let mut include = softbox::WGSL_INCLUDE.to_owned();
            for (switch, on) in effects.switches() {
                let declared = format!("override {switch}: bool = ");
                include = include.replace(&format!("{declared}{};", !on), &format!("{declared}{on};"));
            }
            let program = source(&include, include_str!("shaders/whole.wgsl"));
            let mut random = Random::new(32 + kind as u64);
            let kind = kind as u32;
            let cases: Vec<Whole> = (0..count).map(|index| whole(&mut random, index, kind)).collect();
            let values = run(&device, (&program, "whole"), &table, &cases, 1);
            let mut tally = Tally::default();
            for (case, value) in cases.iter().zip(values) {
                if is_whole_promised(case, kind) {
                    let physical = value[..3].iter().all(|channel| (0.0..f32::INFINITY).contains(channel))
                        && (0.0..=1.0).contains(&value[3]);
                    let fault = (!physical).then_some("the reflected light is not a number from 0 on");
                    tally.add(fault, value[3] > 0.0, || format!("{value:?} of {}", bits_of(&case.0)));
                }
            }
            tally.finish(&format!("{level}, {light}"), count);
        }
    }
}
