//! Every quality level: its error is within its documented bound, it keeps the bounds on hard cases, and every translation
//! gives what the WGSL gives.

mod common;

use std::process::Command;

use common::{Bound, Case, tools};
use softbox::device::{Device, Program};
use softbox::effects::{Effects, Quality, wgsl};
use softbox::report::compare::Level;
use softbox::report::data::Part;
use softbox::report::errors::{ErrorSet, error_rows};
use softbox::table::Table;
use softbox::translate::{self, Target};

/// What the evaluation kernel calls for, at a level.
fn effects(level: Quality) -> Effects {
    let plain = "quad,polygon,disk,sphere,tube+ggx+two-sided,caps".parse();
    level.of(plain.unwrap_or_else(|error| panic!("{error}")))
}

/// The table of a level, as the kernel reads it.
fn table(effects: Effects) -> Table {
    let layers = effects.layers();
    let table = Table::default().completed(&layers);
    if layers.is_empty() { table } else { table.only(&layers) }
}

/// The figures of a level against numerical integration, with those that its documentation states.
#[test]
fn no_level_is_further_off_than_it_says() {
    let set = ErrorSet::of(6000, 0);
    for level in Level::all() {
        let rows = error_rows(&[&level], &set);
        let bound = level.quality().error_bound();
        let stated = [
            (Part::Diffuse, bound.diffuse),
            (Part::Specular, bound.specular),
            (Part::Fresnel, bound.fresnel),
            (Part::Dielectric, bound.dielectric),
        ];
        for (part, bound) in stated {
            let row = rows.iter().find(|row| row.part == part && row.stratum == "all");
            let row = row.unwrap_or_else(|| panic!("no row for {part:?}"));
            println!(
                "{}: {}: {:.3} %, stated {:.3} %",
                level.quality(),
                part.name(),
                100.0 * row.mean,
                100.0 * bound
            );
            assert!(
                row.mean <= bound,
                "{}: {} is off by {:.3} % on average, more than the {:.3} % that are stated",
                level.quality(),
                part.name(),
                100.0 * row.mean,
                100.0 * bound
            );
            // A bound that is far from what is true says little.
            assert!(bound <= 1e-5 || row.mean >= 0.8 * bound, "{}: {part:?}: {}", level.quality(), row.mean);
        }
    }
}

/// A level that is worse than another one costs less, or nobody would want it: here that errors are in order.
#[test]
fn levels_are_in_order_of_their_errors() {
    for pair in Quality::ALL.windows(2) {
        let [cheaper, dearer] = [pair[0], pair[1]].map(Quality::error_bound);
        assert!(dearer.specular < cheaper.specular && dearer.fresnel < cheaper.fresnel, "{pair:?}");
        assert!(dearer.dielectric < cheaper.dielectric, "{pair:?}");
    }
}

fn run(device: &Device, program: &Program, table: &Table, cases: &[Case]) -> Vec<[f32; 3]> {
    device.evaluate(program, table, &common::batch(cases)).unwrap_or_else(|error| panic!("{error}"))
}

/// How many values differ in any bit, and the largest difference where a bound is absolute.
fn difference(what: &str, cases: &[Case], a: &[[f32; 3]], b: &[[f32; 3]]) -> (usize, f32) {
    let (mut bits, mut largest) = (0, 0.0_f32);
    for ((case, a), b) in cases.iter().zip(a).zip(b) {
        bits += a.iter().zip(b).filter(|(a, b)| a.to_bits() != b.to_bits()).count();
        if matches!(case.bound, Bound::Absolute(bound) if bound <= 2e-6) {
            largest = a.iter().zip(b).fold(largest, |largest, (a, b)| largest.max((a - b).abs()));
        }
    }
    println!("{what}: {bits} of {} values differ, by up to {largest:.2e}", 3 * a.len());
    (bits, largest)
}

#[test]
fn levels_keep_the_bounds_of_hard_cases_in_every_translation() {
    let device = Device::open(wgpu::Backends::VULKAN).unwrap_or_else(|error| panic!("{error}"));
    let mut cases = common::cases(15);
    assert!(cases.len() > 15_000, "{}", cases.len());
    for level in [Quality::Fast, Quality::Fine, Quality::Finest] {
        let effects = effects(level);
        let table = table(effects);
        if effects.is_fast() {
            // Its error has bounds of their own, in the tests of the switches; here that it stays within physics.
            cases
                .iter_mut()
                .for_each(|case| (case.bound, case.specular_bound) = (Bound::Physical, f64::INFINITY));
        } else {
            cases = common::cases(15);
        }
        let exact: Vec<[f64; 3]> = cases.iter().map(|case| case.exact(&table, effects)).collect();
        let twin = common::twin(&cases, &table, effects);
        common::check_with(&format!("{level}, twin"), &cases, &exact, &twin, (&table, effects));

        let text = wgsl(effects).unwrap_or_else(|error| panic!("{error}"));
        let program = Program::wgsl(format!("{text}\n{}", softbox::WGSL_EVALUATE));
        let reference = run(&device, &program, &table, &cases);
        common::check_with(&format!("{level}, WGSL"), &cases, &exact, &reference, (&table, effects));

        let folder = tools::scratch(&format!("level_{level}"));
        let include =
            |target| translate::include_for(target, effects).unwrap_or_else(|error| panic!("{error}"));
        // SAFETY: the kernel checks its index against the number of pairs, and walks over the vertices that a light
        // counts; `common::batch` makes both right.
        let spirv = |bytes: Vec<u8>, entry_point| unsafe { Program::spirv(bytes, entry_point) };

        let source = format!("{}\n{}", softbox::WGSL_INCLUDE, softbox::WGSL_EVALUATE);
        let module =
            translate::kernel_spirv(&source, "evaluate", effects).unwrap_or_else(|error| panic!("{error}"));
        let values = run(&device, &spirv(module, "evaluate"), &table, &cases);
        assert!(difference(&format!("{level}, SPIR-V"), &cases, &reference, &values).1 <= 1e-6);
        common::check_with(&format!("{level}, SPIR-V"), &cases, &exact, &values, (&table, effects));

        let defines = match level {
            Quality::Fast => "#define TABLE_FREE\n#define LOBES 1\n",
            Quality::Standard => "#define LOBES 1\n",
            Quality::Fine => "#define LOBES 2\n",
            Quality::Finest => "#define LOBES 3\n",
        };
        let glsl = tools::with_include(include_str!("shaders/evaluate.comp"), &include(Target::Glsl450));
        let source = tools::write(
            &folder,
            "evaluate.comp",
            format!("#version 450\n#define TABLE_SEPARATE\n{defines}{glsl}"),
        );
        let output = folder.join("glsl.spv");
        tools::run(Command::new("glslangValidator").arg("-V").arg(&source).arg("-o").arg(&output));
        let values = run(&device, &spirv(tools::read(&output), "main"), &table, &cases);
        assert!(difference(&format!("{level}, GLSL"), &cases, &reference, &values).1 <= 1e-6);
        common::check_with(&format!("{level}, GLSL"), &cases, &exact, &values, (&table, effects));

        let hlsl = tools::with_include(include_str!("shaders/evaluate.hlsl"), &include(Target::Hlsl));
        let source = tools::write(&folder, "evaluate.hlsl", hlsl);
        let output = folder.join("hlsl.spv");
        let arguments = "-T cs_6_0 -E main -spirv -fspv-target-env=vulkan1.1 -D VULKAN_BINDINGS -HV 2018 -O3";
        tools::run(tools::dxc().arg(&source).arg(&output).args(arguments.split(' ')));
        let values = run(&device, &spirv(tools::read(&output), "main"), &table, &cases);
        assert!(difference(&format!("{level}, HLSL"), &cases, &reference, &values).1 <= 1e-6);
        common::check_with(&format!("{level}, HLSL"), &cases, &exact, &values, (&table, effects));
    }
}
