//! The part of the include that a set of effects calls for gives what the whole one gives with the same
//! switches as overrides of the pipeline, which another compiler decides.

mod common;
#[path = "common/sets.rs"]
mod sets;

use common::Shape;
use softbox::device::{Batch, Device, EvaluateSurface, Program};
use softbox::effects::{Effect, Effects};
use softbox::light::Light;
use softbox::report::{Region, random_quads};
use softbox::table::Table;
use softbox::translate;

#[test]
fn selected_kernels_give_what_overrides_give() {
    let device = Device::open(wgpu::Backends::VULKAN).unwrap_or_else(|error| panic!("{error}"));
    let table = Table::default();
    let cases = common::cases(10);
    assert!(cases.len() >= 10_000, "{} cases are too few", cases.len());
    let source = format!("{}\n{}", softbox::WGSL_INCLUDE, softbox::WGSL_EVALUATE);
    let run = |program: &Program| -> Vec<[f32; 3]> {
        let parts = cases.chunks(100_000).map(|cases| {
            device.evaluate(program, &table, &common::batch(cases)).unwrap_or_else(|error| panic!("{error}"))
        });
        parts.collect::<Vec<_>>().concat()
    };
    let whole = run(&Program::wgsl(source.clone()));
    let diffuse = Effects::standing().without(Effect::Ggx);
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
        // Kernels take quads for polygons where they have no function for quads; of other lights they have not got, no
        // value means anything.
        let flat = effects.roots().iter().any(|root| *root == "ltc_quad" || *root == "ltc_polygon_begin");
        let (mut lit, mut present, mut largest) = (0, 0, 0.0_f32);
        for ((case, value), all) in cases.iter().zip(&selected).zip(&whole) {
            let counts = matches!(case.shape, Shape::Quad { .. }) && flat;
            present += usize::from(counts);
            lit += usize::from(counts && value[0] > 0.0);
            assert!(effects.has_lobe() || (value[1] == 0.0 && value[2] == 0.0), "{effects}: {value:?}");
            if effects == diffuse {
                largest = largest.max((value[0] - all[0]).abs());
            }
        }
        assert!(lit >= present / 4, "{effects}: {lit} of {present} quads are lit");
        assert!(largest <= 1e-6, "{effects}: the diffuse value is {largest:e} from that of everything");
        println!("{effects}: {lit} of {present} quads are lit");
    }
}

/// What the cheap horizon costs in accuracy, on quads of which many straddle the horizon.
#[test]
fn a_cheap_horizon_is_off_by_as_much_as_it_says() {
    let device = Device::open(wgpu::Backends::VULKAN).unwrap_or_else(|error| panic!("{error}"));
    let table = Table::default();
    let region = Region { roughness: (0.1, 1.0), cosine: (0.05, 1.0) };
    let quads = random_quads(region, 20_000);
    let mut batch = Batch::default();
    for (index, quad) in quads.iter().enumerate() {
        batch.surfaces.push(EvaluateSurface {
            roughness: quad.roughness as f32,
            normal: [0.0, 0.0, 1.0],
            view: quad.view.as_vec3().into(),
            ..EvaluateSurface::default()
        });
        let light = batch.add_light(&Light::Polygon { points: quad.corners.to_vec(), two_sided: false });
        batch.pairs.push([index as u32, light]);
    }
    let exact = format!("{}\n{}", softbox::WGSL_INCLUDE, softbox::WGSL_EVALUATE);
    let declared = "override ltc_use_cheap_horizon: bool = ";
    let cheap = exact.replace(&format!("{declared}false;"), &format!("{declared}true;"));
    assert_ne!(exact, cheap);
    let [exact, cheap] = [exact, cheap].map(|text| {
        device.evaluate(&Program::wgsl(text), &table, &batch).unwrap_or_else(|error| panic!("{error}"))
    });
    let (mut largest, mut above) = (0.0_f32, 0);
    let (mut errors, mut sums) = ([0.0_f64; 3], [0.0_f64; 3]);
    for ((quad, exact), cheap) in quads.iter().zip(&exact).zip(&cheap) {
        let difference = (exact[0] - cheap[0]).abs();
        assert!(cheap.iter().all(|value| (0.0..=1.0).contains(value)), "{cheap:?}: {quad:?}");
        // The proxy is round: it is sure to be above where the light's own cone is well above.
        let lowest = quad.corners.iter().map(|corner| corner.normalize().z).fold(1.0, f64::min);
        let widest = quad.corners.iter().map(|corner| corner.normalize().dot(quad.corners[0].normalize()));
        if lowest > 0.0 && widest.fold(1.0, f64::min) > (1.0 - lowest * lowest).sqrt() {
            assert!(difference < 2e-6, "{exact:?} and {cheap:?}: {quad:?}");
            above += 1;
        }
        largest = largest.max(difference);
        for k in 0..3 {
            errors[k] += f64::from(exact[k] - cheap[k]).abs();
            sums[k] += f64::from(exact[k]);
        }
    }
    let [diffuse, specular, fresnel] = [0, 1, 2].map(|k| 100.0 * errors[k] / sums[k]);
    println!(
        "cheap horizon: {diffuse:.2} / {specular:.2} / {fresnel:.2} %, diffuse at most {largest:.3}, {above} above"
    );
    assert!(above > 1000 && largest < 0.1, "{above}, {largest}");
    assert!(diffuse < 2.0 && specular < 1.5 && fresnel < 10.0, "{diffuse} {specular} {fresnel}");
}
