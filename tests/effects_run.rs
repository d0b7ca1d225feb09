//! The part of the include that a set of effects calls for gives what the whole one gives with the same
//! switches as overrides of the pipeline, which another compiler decides.

mod common;
#[allow(dead_code, reason = "other tests use the rest")]
#[path = "common/sets.rs"]
mod sets;

use softbox::device::{Device, Program};
use softbox::effects::{Effect, Effects};
use softbox::table::Table;
use softbox::translate;

#[test]
fn selected_kernels_give_what_overrides_give() {
    let device = Device::open(wgpu::Backends::VULKAN).unwrap_or_else(|error| panic!("{error}"));
    let table = Table::default();
    let cases = common::families::cases(10);
    assert!(cases.len() >= 10_000, "{} cases are too few", cases.len());
    let source = format!("{}\n{}", softbox::WGSL_INCLUDE, softbox::WGSL_EVALUATE);
    let run = |program: &Program| -> Vec<[f32; 3]> {
        let parts = cases.chunks(100_000).map(|cases| {
            device.evaluate(program, &table, &common::batch(cases)).unwrap_or_else(|error| panic!("{error}"))
        });
        parts.collect::<Vec<_>>().concat()
    };
    let whole = run(&Program::wgsl(source.clone()));
    let present = Effects::present();
    let diffuse = present.without(Effect::Ggx).without(Effect::CheapHorizon);
    for effects in sets::sets(softbox::WGSL_INCLUDE).into_iter().step_by(3).chain([diffuse]) {
        let mut switched = source.clone();
        for (switch, on) in effects.switches() {
            let declared = format!("override {switch}: bool = ");
            switched = switched.replace(&format!("{declared}{};", !on), &format!("{declared}{on};"));
        }
        let overridden = run(&Program::wgsl(switched));
        let kernel = translate::kernel_spirv(&source, "evaluate", effects);
        let kernel = kernel.unwrap_or_else(|error| panic!("{effects}: {error}"));
        // SAFETY: the kernel checks its index against the number of pairs, and walks over the vertices that
        // a light counts; `common::batch` makes both right.
        let selected = run(&unsafe { Program::spirv(kernel, "evaluate") });
        let shows = |values: [f32; 3]| values.map(f32::to_bits);
        for (index, (a, b)) in overridden.iter().zip(&selected).enumerate() {
            assert_eq!(shows(*a), shows(*b), "{effects}: case {index}: {a:?} by override, {b:?} selected");
        }
        let (mut lit, mut largest) = (0, 0.0_f32);
        for (value, all) in selected.iter().zip(&whole) {
            lit += usize::from(value[0] > 0.0);
            assert!(effects.has_lobe() || (value[1] == 0.0 && value[2] == 0.0), "{effects}: {value:?}");
            if effects == diffuse {
                largest = largest.max((value[0] - all[0]).abs());
            }
        }
        // Disks, spheres and tubes are fewer among the cases than a tenth.
        let has_light =
            effects.roots().iter().any(|root| *root == "ltc_quad" || *root == "ltc_polygon_begin");
        assert!((lit > cases.len() / 10) == has_light, "{effects}: {lit} of {} cases are lit", cases.len());
        assert!(largest <= 1e-6, "{effects}: the diffuse value is {largest:e} from that of everything");
        println!("{effects}: {lit} of {} cases are lit", cases.len());
    }
}
