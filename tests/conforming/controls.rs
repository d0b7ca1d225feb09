//! What must be condemned, and freedoms that must be seen to be used.

use std::sync::Arc;

use softbox::WGSL_INCLUDE;
use softbox::effects::{Effects, Quality};
use softbox::interpret::{
    Concern, Conforming, ExecuteError, Filter, Freedom, Outcome, Policy, Rounding, Texels,
};
use softbox::stability::{Bound, Case, Shape};

use super::{in_order, summarised, thinned};

/// A kernel that writes what a function of four numbers returns.
fn kernel(body: &str, numbers: [f32; 4]) -> Conforming {
    let source = format!(
        "@group(0) @binding(0) var<storage, read> numbers: array<vec4<f32>>;
        @group(0) @binding(1) var<storage, read_write> results: array<f32>;
        @group(0) @binding(2) var table: texture_2d_array<f32>;
        @group(0) @binding(3) var table_sampler: sampler;
        fn value(v: vec4<f32>) -> f32 {{ {body} }}
        @compute @workgroup_size(64) fn control(@builtin(global_invocation_id) invocation: vec3<u32>) {{
            results[invocation.x] = value(numbers[invocation.x]);
        }}"
    );
    let kernel = Conforming::new(&source, "control", Effects::NONE);
    let mut kernel = kernel.unwrap_or_else(|error| panic!("{body}: {error}"));
    kernel.bind_buffer(0, bytemuck::cast_slice(&numbers));
    kernel.bind_output(1, 4);
    kernel
}

fn run(body: &str, numbers: [f32; 4], policy: Policy) -> Outcome {
    let kernel = kernel(body, numbers);
    let outcome = kernel.machine().run(0, policy);
    outcome.unwrap_or_else(|error| panic!("{body}: {error}"))
}

fn value(body: &str, numbers: [f32; 4], policy: Policy) -> f32 {
    run(body, numbers, policy).values[0]
}

/// What the function comes to on devices of a policy with many seeds.
fn values(body: &str, numbers: [f32; 4], policy: Policy) -> Vec<f32> {
    let kernel = kernel(body, numbers);
    let mut machine = kernel.machine();
    let mut one = |seed| machine.run(0, Policy { seed, ..policy }).map(|outcome| outcome.values[0]);
    (0..64).map(|seed| one(seed).unwrap_or_else(|error| panic!("{body}: {error}"))).collect()
}

const STRICT: Policy = Policy::exact();

#[test]
fn every_freedom_is_used() {
    let third = [1.0, 3.0, 0.0, 0.0];
    let rounded = |rounding| value("return v.x / v.y;", third, STRICT.with_rounding(rounding));
    let exact = 1.0_f64 / 3.0;
    let off = |value: f32| (f64::from(value) - exact) * 2.0_f64.powi(25);
    assert!((-2.5..-1.0).contains(&off(rounded(Rounding::Down))), "{}", rounded(Rounding::Down));
    assert!((1.0..2.5).contains(&off(rounded(Rounding::Up))), "{}", rounded(Rounding::Up));
    assert_eq!(rounded(Rounding::Plain), 1.0_f32 / 3.0);

    // The rounding error of a product, which is zero unless a device fuses.
    let [x, y] = [1.1_f32, 1.3];
    let product = [x, y, x * y, 0.0];
    let fused = Policy { fusion: Freedom::Always, ..STRICT };
    assert_eq!(value("return v.x * v.y - v.z;", product, STRICT), 0.0);
    let error = f64::from(x) * f64::from(y) - f64::from(x * y);
    assert_eq!(f64::from(value("return v.x * v.y - v.z;", product, fused)), error);
    assert_eq!(f64::from(value("let p = -(v.x * v.y); return p + v.z;", product, fused)), -error);

    // That of a sum, which is zero for a compiler that moves brackets.
    let two_sum = "let s = v.x + v.y; let b = s - v.x; return (v.x - (s - b)) + (v.y - b);";
    let sum = [1.0, 1e-8, 0.0, 0.0];
    let moved = Policy { reassociation: Freedom::Either, ..STRICT };
    assert_eq!(value(two_sum, sum, STRICT), 1e-8);
    assert!(values(two_sum, sum, moved).contains(&0.0), "no device lost the rounding error of a sum");

    // A product that is finite in the order of the text alone.
    let scaled = [0.0, 1e30, 1e20, 0.0];
    let outcomes = values("return (v.x * v.y) * v.z;", scaled, moved);
    assert!(outcomes.contains(&0.0) && outcomes.iter().any(|value| value.is_nan()), "{outcomes:?}");

    let least = [f32::MIN_POSITIVE, 0.5, 0.0, 0.0];
    let flushing = Policy { flushing: Freedom::Always, ..STRICT };
    assert_eq!(value("return v.x * v.y;", least, STRICT), 0.5 * f32::MIN_POSITIVE);
    assert_eq!(value("return v.x * v.y;", least, flushing), 0.0);
    assert_eq!(value("return v.x * 2.0;", [f32::from_bits(7); 4], flushing), 0.0);

    let zeros = Policy { zeros: Freedom::Always, ..STRICT };
    let sign = "return f32(bitcast<u32>(v.x * v.z) >> 31u);";
    assert_eq!(value(sign, least, STRICT), 0.0);
    assert_eq!(value(sign, least, zeros), 1.0);
}

#[test]
fn a_filter_of_few_places_moves_what_it_filters() {
    let body = "return textureSampleLevel(table, table_sampler, v.xy, 0, 0.0).x;";
    // Texels 0 and 1, so that the value is the weight.
    let half = |value: f32| if value == 0.0 { [0, 0] } else { [0x00, 0x3C] };
    let texels: Vec<u8> = [0.0, 1.0, 0.0, 1.0].into_iter().flat_map(|v| half(v).repeat(4)).collect();
    let weight = 0.3;
    let mut kernel = kernel(body, [0.25 + 0.5 * weight, 0.5, 0.0, 0.0]);
    kernel.bind_texels(2, Texels::new(2, &texels));
    let mut machine = kernel.machine();
    let mut sampled = |policy: Policy| {
        let outcome = machine.run(0, policy).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(outcome.sampled.len(), 1);
        outcome.values[0]
    };
    assert!((sampled(STRICT) - weight).abs() < 1e-7);
    for (bits, rounding) in [(8, Rounding::Down), (8, Rounding::Up), (4, Rounding::Up)] {
        let of = sampled(STRICT.with_rounding(rounding).with_filter(Filter::FixedPoint(bits)));
        let unit = 2.0_f32.powi(-(bits as i32));
        let places = if rounding == Rounding::Up { (weight / unit).ceil() } else { (weight / unit).floor() };
        assert!((of - places * unit).abs() < 1e-6, "{bits} places, {rounding:?}: {of}");
    }
}

/// The first-order bound is reached where a function is as good as linear, and not exceeded.
#[test]
fn the_worst_device_goes_as_far_as_first_order_says() {
    let numbers = [0.3, -0.7, 0.51, 0.9];
    let bodies = [
        "return dot(v, v.wzyx) * 0.37 + v.x / v.y;",
        "return normalize(v.xyz).y * sqrt(v.w);",
        "return exp2(v.x) * log2(v.w) + sin(v.y) * cos(v.z);",
    ];
    for body in bodies {
        let kernel = kernel(body, numbers);
        let worst = kernel.machine().worst(0, STRICT.with_rounding(Rounding::Nearest), 1);
        let worst = &worst.unwrap_or_else(|error| panic!("{body}: {error}"))[0];
        for (predicted, found) in worst.predicted.iter().zip(&worst.found) {
            let share = (f64::from(found.values[0]) - f64::from(worst.nearest))
                / (predicted - f64::from(worst.nearest));
            assert!((0.7..=1.3).contains(&share), "{body}: {share} of {worst:?}");
        }
        let by_chance = values(body, numbers, STRICT.with_rounding(Rounding::Random));
        let [low, high] = worst.predicted;
        let slack = 0.3 * (high - low);
        let inside = |value: &f32| (low - slack..=high + slack).contains(&f64::from(*value));
        assert!(by_chance.iter().all(inside), "{body}: {by_chance:?} outside {:?}", worst.predicted);
    }
}

#[test]
fn operations_outside_their_domain_are_found() {
    let cases: [(&str, Concern); 12] = [
        ("return v.y / v.x;", Concern::Divisor),
        ("return v.y / (v.z * v.z);", Concern::Divisor),
        ("return inverseSqrt(v.x);", Concern::Zero),
        ("return inverseSqrt(-v.y);", Concern::Negative),
        ("return sqrt(-v.y);", Concern::Negative),
        ("return sqrt(v.x);", Concern::RootOfZero),
        ("return v.z * v.z;", Concern::Infinite),
        ("return log2(v.x);", Concern::Zero),
        ("return atan2(v.y, v.x);", Concern::Domain),
        ("return sin(v.w);", Concern::Domain),
        ("return f32(i32(v.z));", Concern::Converted),
        ("return (v.x / v.x) * 1.0;", Concern::NotANumber),
    ];
    for (body, concern) in cases {
        let outcome = run(body, [0.0, 1.0, 1e30, 4.0], STRICT);
        let found = outcome
            .findings
            .iter()
            .any(|finding| finding.concern == concern && finding.matters && finding.line == 5);
        assert!(found, "{body}: {:?}", outcome.findings);
    }
    let unchosen = run("return select(v.y, 1.0 / v.x, v.x > 0.0);", [0.0, 1.0, 0.0, 0.0], STRICT);
    assert!(
        !unchosen.findings.is_empty() && unchosen.findings.iter().all(|finding| !finding.matters),
        "{unchosen:?}"
    );
    let clean = run("return v.x / v.y + sqrt(v.z) + atan2(v.y, v.z);", [0.0, 1.0, 2.0, 3.0], STRICT);
    assert_eq!(clean.findings, []);
}

/// A device may take it for granted that nothing is no number, so such a guard guards nothing.
#[test]
fn a_guard_that_asks_whether_a_number_is_one_is_condemned() {
    let body = "let q = v.x / v.y; return select(q, 0.5, q != q);";
    let outcome = run(body, [0.0; 4], STRICT);
    assert_eq!(outcome.values, [0.5]);
    assert!(outcome.findings.iter().any(|finding| finding.concern == Concern::Compared), "{outcome:?}");
    let devices = values(body, [0.0; 4], Policy::random(0));
    assert!(devices.iter().any(|value| value.is_nan()), "every device kept the guard: {devices:?}");
}

#[test]
fn a_loop_without_an_end_is_an_error() {
    let kernel = kernel("var s = v.x; loop { s = s * 0.5; if (s < 0.0) { break; } } return s;", [1.0; 4]);
    let error = kernel.machine().run(0, STRICT);
    assert!(matches!(error, Err(ExecuteError::Endless { line: 5 })), "{error:?}");
}

/// The published edge integral loses a light that touches the surface, and asks for the root of zero.
#[test]
fn the_published_edge_integral_is_condemned_at_contact() {
    let source = concat!(
        include_str!("../../wgsl/compare/published.wgsl"),
        include_str!("../../wgsl/compare/measure.wgsl")
    );
    let kernel = Conforming::new(source, "compare_quads", Effects::NONE);
    let mut kernel = kernel.unwrap_or_else(|error| panic!("{error}"));
    let gap = 1e-4_f32;
    let surface: [f32; 12] = [0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let corner = |x: f32, z: f32| [x, gap, z, 0.0];
    let quad = [corner(-1.0, 0.0), corner(1.0, 0.0), corner(1.0, 2.0), corner(-1.0, 2.0)];
    kernel.bind_buffer(0, bytemuck::cast_slice(&surface));
    kernel.bind_buffer(1, bytemuck::cast_slice(&quad));
    kernel.bind_output(2, 16);
    kernel.bind_texels(3, Texels::new(softbox::TABLE_SIZE, softbox::TABLE_COMPATIBLE));
    let mut machine = kernel.machine();
    let devices = Policy::devices(8).into_iter().chain([("plain".to_owned(), STRICT)]);
    let mut worst = 0.0_f32;
    let mut concerns = Vec::new();
    for (name, policy) in devices {
        let outcome = machine.run(0, policy).unwrap_or_else(|error| panic!("{name}: {error}"));
        worst = worst.max((outcome.values[0] - 0.5).abs());
        concerns
            .extend(outcome.findings.iter().filter(|finding| finding.matters).map(|finding| finding.concern));
    }
    assert!(worst > 0.1, "the published form was off by no more than {worst}");
    assert!(concerns.contains(&Concern::RootOfZero), "{concerns:?}");
}

/// Cases of one family.
fn family(name: &str, scale: usize) -> Vec<Case> {
    let mut cases = thinned(scale, 1000);
    cases.retain(|case| case.family == name);
    assert!(cases.len() >= 10, "{} cases of {name}", cases.len());
    cases
}

pub fn replaced(include: &str, from: &str, to: &str) -> String {
    assert!(include.contains(from), "the include has no {from}");
    include.replace(from, to)
}

/// A vertex on the horizon that is judged at each of its edges anew: plain single precision sees nothing of it.
#[test]
fn an_outline_that_does_not_close_is_condemned() {
    let judged = replaced(WGSL_INCLUDE, "let a_up = (*outline).previous_up;", "let a_up = a_height > 0.0;");
    let judged = replaced(
        &judged,
        "select(b_height > 0.0, (*outline).first_up, (*outline).returns)",
        "b_height > 0.0",
    );
    let cases = family("standing on a turned surface", 2);
    let plain = [("plain".to_owned(), STRICT)];
    assert!(summarised(&judged, Quality::Standard, &cases, &plain).is_kept());
    let summary = summarised(&judged, Quality::Standard, &cases, &in_order());
    assert!(!summary.is_kept() && summary.largest(false)[0] > 1e3, "{summary}");
    assert!(summarised(WGSL_INCLUDE, Quality::Standard, &cases, &in_order()).is_kept());
}

/// Tubes that stand upright on surfaces of any orientation.
fn upright_tubes() -> Vec<Case> {
    let tubes = family("size at least a tenth of the distance", 1).into_iter().map(|mut case| {
        let normal = case.normal.normalize();
        let start = case.position + normal.any_orthonormal_vector() + normal * 0.1;
        case.shape = Shape::Tube { start, end: start + normal * 0.8, radius: 0.05, caps: false };
        case.bound = Bound::Absolute(2e-6);
        case
    });
    tubes.collect()
}

#[test]
fn a_tube_that_is_lifted_by_noise_is_condemned() {
    let lifted = replaced(
        WGSL_INCLUDE,
        "let extent = ltc_root(max(dot(surface.normal, slope), dot(slope, slope)));",
        "let extent = ltc_root(max(dot(surface.normal, slope), 0.0));",
    );
    let lifted = replaced(
        &lifted,
        "let lift = slope * ((1.0 - seen) * r / max(extent, 1e-15));",
        "let lift = slope * ((1.0 - seen) * r * r / max(rise, LTC_TINY));",
    );
    let cases = upright_tubes();
    let summary = summarised(&lifted, Quality::Standard, &cases, &in_order());
    assert!(!summary.is_kept() && !summary.is_clean() && summary.largest(false)[0] > 100.0, "{summary}");
    let summary = summarised(WGSL_INCLUDE, Quality::Standard, &cases, &in_order());
    assert_eq!(summary.offences("upright tubes"), [""; 0]);
}

/// Seen along the normal a lobe's horizon is the surface's: a polygon cut there lies along it with rounding above and below, and each
/// edge may be compiled in its own way.
#[test]
fn an_outline_along_a_lobes_horizon_stays_closed_however_products_are_fused() {
    let case = |position: [f32; 3], normal: [f32; 3], view: [f32; 3], vertices: [[f32; 3]; 4]| Case {
        family: "seen along the normal",
        position: position.into(),
        normal: normal.into(),
        view: view.into(),
        roughness: 0.4562227,
        shape: Shape::Polygon { vertices: vertices.map(glam::Vec3::from).to_vec(), two_sided: false },
        bound: Bound::Absolute(2e-6),
        specular_bound: 3.84e-5,
        form_factor: None,
    };
    let cases = [
        case(
            [-0.082439795, -0.25007284, -0.038955566],
            [1.2055333, 0.70406824, -0.087689236],
            [0.5442805, 0.31787765, -0.03958776],
            [
                [-19.041767, -39.318264, 13.45296],
                [-42.747704, 17.609138, -7.647664],
                [17.694363, 35.727367, 8.674816],
                [41.4003, -21.200037, 29.77544],
            ],
        ),
        case(
            [0.06047219, 0.29386842, -0.10850614],
            [0.0939752, 0.6621485, -0.7434567],
            [0.0939752, 0.6621485, -0.7434567],
            [
                [-4.996687, 1.7316073, 14.795649],
                [-1.4893172, -10.035034, -0.23284552],
                [-4.3371434, 3.1073642, -10.428292],
                [-5.106614, 14.709919, 4.02952],
            ],
        ),
    ];
    let device = |seed| {
        let policy = Policy { fusion: Freedom::Either, consistent: seed % 2 == 0, seed, ..STRICT };
        (format!("fused by chance {seed}"), policy)
    };
    let devices: Vec<_> = (0..400).map(device).collect();
    let anew = replaced(
        WGSL_INCLUDE,
        "let crossing_up = select(start_up, end_up, outline.starts_up);",
        "let crossing_up = ltc_transform(lobe, select(outline.start, outline.end, outline.starts_up)).z > 0.0;",
    );
    let summary = summarised(&anew, Quality::Finest, &cases, &devices);
    assert!(!summary.is_kept(), "a point on the horizon may be judged anew: {summary}");
    for quality in [Quality::Standard, Quality::Fine, Quality::Finest] {
        let summary = summarised(WGSL_INCLUDE, quality, &cases, &devices);
        assert_eq!(summary.offences(&format!("{quality}, fused")), [""; 0]);
        // The stated bound is a hundred times what such a polygon takes.
        assert!(summary.largest(true)[1] < 0.02, "{quality}: {summary}");
    }
}

/// Several machines of a kernel do not disturb each other, and a run depends on nothing but its policy and number.
#[test]
fn runs_are_repeated_to_the_bit() {
    let kernel = Arc::new(kernel("return normalize(v.xyz).x * sqrt(v.w) - v.y / v.z;", [0.3, 0.4, 0.5, 0.6]));
    for policy in [Policy::random(3), Policy::random(3).capricious(), STRICT] {
        let first = kernel.machine().run(0, policy).unwrap_or_else(|error| panic!("{error}"));
        let mut machine = kernel.machine();
        machine.run(0, Policy::random(77)).unwrap_or_else(|error| panic!("{error}"));
        let second = machine.run(0, policy).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(first, second);
    }
}
