//! Anisotropic surfaces: the model, its table, the lobes' symmetries, limits and errors.

mod common;

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use common::Random;
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use softbox::brdf::AnisotropicGgx;
use softbox::brdf::{Brdf, schlick};
use softbox::report::{Quad, Region, random_quads};
use softbox::shade::{
    LtcAnisotropy, LtcLobe, LtcSurface, Real, Vector, ltc_anisotropic_alpha, ltc_anisotropic_coordinates,
    ltc_anisotropy, ltc_quad, ltc_surface,
};
use softbox::table::{AnisotropicTable, Table, stretched_lobe};
use softbox::truth;

fn direction(cosine: f64, azimuth: f64) -> DVec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    DVec3::new(sine * azimuth.cos(), sine * azimuth.sin(), cosine)
}

/// Midpoints of a grid of `count`² cells.
fn grid(count: usize) -> impl Iterator<Item = DVec2> {
    let place = move |i: usize| (i as f64 + 0.5) / count as f64;
    (0..count * count).map(move |i| DVec2::new(place(i % count), place(i / count)))
}

/// An anisotropic surface and a quad light.
struct Case {
    quad: Quad,
    brdf: AnisotropicGgx,
}

impl Case {
    fn ratio(&self) -> f64 {
        self.brdf.alpha_x / self.brdf.alpha_y
    }

    fn surface<R: Real>(&self) -> (LtcSurface<R>, LtcAnisotropy<R>) {
        frame(self.quad.view, self.brdf)
    }

    fn light<R: Real>(&self, lobe: impl Fn(&LtcSurface<R>, &LtcAnisotropy<R>) -> LtcLobe<R>) -> DVec3 {
        let (surface, anisotropy) = self.surface::<R>();
        let corners = self.quad.corners.map(vector::<R>);
        let value = ltc_quad(&surface, &lobe(&surface, &anisotropy), corners, false);
        DVec3::new(value.x().to_f64(), value.y().to_f64(), value.z().to_f64())
    }
}

fn vector<R: Real>(v: DVec3) -> R::Vec3 {
    R::Vec3::new(R::new(v.x), R::new(v.y), R::new(v.z))
}

fn frame<R: Real>(view: DVec3, brdf: AnisotropicGgx) -> (LtcSurface<R>, LtcAnisotropy<R>) {
    let surface =
        ltc_surface::<R>(vector::<R>(DVec3::ZERO), vector::<R>(DVec3::Z), vector::<R>(view), R::new(0.5));
    let tangent = vector::<R>(direction(0.0, brdf.azimuth));
    let anisotropy = ltc_anisotropy(&surface, tangent, R::new(brdf.alpha_x), R::new(brdf.alpha_y));
    (surface, anisotropy)
}

/// Quads as the isotropic measurement has them, the roughness being the geometric mean's; ratios up to 10,
/// uniform in the logarithm, so far as neither α exceeds 1.
fn cases(region: Region, count: usize) -> Vec<Case> {
    let mut random = Random::new(4);
    let quads = random_quads(region, count).into_iter();
    let cases = quads.map(|quad| {
        let (root, azimuth) = (random.log(1.0, 10.0).sqrt(), random.between(0.0, TAU));
        let alpha = quad.roughness * quad.roughness;
        Case { quad, brdf: AnisotropicGgx { alpha_x: alpha * root, alpha_y: alpha / root, azimuth } }
    });
    cases.filter(|case| case.brdf.alpha_x <= 1.0).collect()
}

const USUAL: Region = Region { roughness: (0.1, 1.0), cosine: (0.05, 1.0) };

/// The truth that errors are measured against: it converges, and it is what the model's samples say.
#[test]
fn the_truth_is_true() {
    cases(USUAL, 400).par_iter().for_each(|case| {
        let at = |tolerance| truth::polygon(&case.brdf, case.quad.view, &case.quad.corners, false, tolerance);
        let (usual, fine) = (at(1e-5), at(1e-9));
        assert!(usual.converged & fine.converged);
        for (value, expected) in [(usual.specular, fine.specular), (usual.fresnel, fine.fresnel)] {
            assert!((value - expected).abs() <= 1e-5 * expected + 1e-12, "{value}, not {expected}");
        }
        let [a, b, c, d] = case.quad.corners;
        let sides = [a.cross(b), b.cross(c), c.cross(d), d.cross(a)];
        let (mut specular, mut fresnel) = (0.0, 0.0);
        for place in grid(500) {
            let light = case.brdf.sample(case.quad.view, place);
            if light.z > 0.0 && sides.iter().all(|side| side.dot(light) < 0.0) {
                let weight = case.brdf.evaluate(case.quad.view, light) * light.z
                    / (250_000.0 * case.brdf.pdf(case.quad.view, light));
                specular += weight;
                fresnel += weight * schlick(case.quad.view, light);
            }
        }
        let what = format!("{:?} {:?}", case.brdf, case.quad);
        assert!((specular - fine.specular).abs() < 1.5e-3, "{specular}, not {}: {what}", fine.specular);
        assert!((fresnel - fine.fresnel).abs() < 5e-4, "{fresnel}, not {}: {what}", fine.fresnel);
    });
}

/// Mean |error| over mean of specular value, Schlick part and dielectric (F0 = 0.04), in per cent.
fn errors(cases: &[&Case], light: &(dyn Fn(&Case) -> DVec3 + Sync)) -> [f64; 3] {
    let rows: Vec<[f64; 6]> = cases
        .par_iter()
        .map(|case| {
            let truth = truth::polygon(&case.brdf, case.quad.view, &case.quad.corners, false, 1e-5);
            let value = light(case);
            let parts =
                |specular: f64, fresnel: f64| [specular, fresnel, 0.04 * (specular - fresnel) + fresnel];
            let (value, truth) = (parts(value.y, value.z), parts(truth.specular, truth.fresnel));
            core::array::from_fn(|k| if k < 3 { (value[k] - truth[k]).abs() } else { truth[k - 3] })
        })
        .collect();
    let sum = |k: usize| rows.iter().map(|row| row[k]).sum::<f64>();
    core::array::from_fn(|k| 100.0 * sum(k) / sum(k + 3))
}

/// The include's table of errors: for each band of ratios what an isotropic lobe of the geometric mean, the
/// stretched lobe and the corrected lobe are off by.
#[test]
fn every_ratio_keeps_its_figures() {
    let (table, anisotropic) = (Table::default(), AnisotropicTable::default());
    let isotropic = |case: &Case| {
        let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, case.quad.view, case.quad.roughness);
        ltc_quad(&surface, &table.lobe(&surface), case.quad.corners, false)
    };
    let stretched = |case: &Case| case.light::<f64>(|surface, a| stretched_lobe(&table, surface, a));
    let corrected = |case: &Case| case.light::<f64>(|surface, a| anisotropic.lobe(&table, surface, a));
    let all = cases(USUAL, 5000);
    let bands = [
        ((1.0, 11.0), [7.3, 9.3, 8.1], [4.15, 7.95, 6.2]),
        ((1.0, 2.0), [3.8, 7.45, 5.95], [2.75, 6.85, 5.25]),
        ((2.0, 4.0), [7.7, 9.3, 8.2], [3.9, 8.2, 6.3]),
        ((4.0, 7.0), [8.5, 10.2, 9.0], [5.15, 8.2, 6.4]),
        ((7.0, 11.0), [14.7, 14.5, 13.6], [7.2, 10.7, 8.85]),
    ];
    for ((low, high), stretched_bound, corrected_bound) in bands {
        let band: Vec<&Case> = all.iter().filter(|case| (low..high).contains(&case.ratio())).collect();
        let plain = errors(&band, &isotropic);
        println!("ratio {low} to {high}, {} quads: isotropic {plain:.2?}", band.len());
        for (what, light, bound) in [
            ("stretched", &stretched as &(dyn Fn(&Case) -> DVec3 + Sync), stretched_bound),
            ("corrected", &corrected, corrected_bound),
        ] {
            let measured = errors(&band, light);
            println!("    {what} {measured:.2?}");
            let within = measured.iter().zip(bound).all(|(measured, bound)| *measured <= bound);
            assert!(within, "ratio {low} to {high}, {what}: {measured:.2?} is beyond {bound:?}");
        }
    }
}

/// Beyond the ranges of the usual figures: sharp lobes, grazing views, and ratios that the table does not hold.
#[test]
fn other_regions_keep_their_figures() {
    let (table, anisotropic) = (Table::default(), AnisotropicTable::default());
    let corrected = |case: &Case| case.light::<f64>(|surface, a| anisotropic.lobe(&table, surface, a));
    let sharp = Region { roughness: (0.04, 0.1), cosine: (0.05, 1.0) };
    let grazing = Region { roughness: (0.1, 1.0), cosine: (0.001, 0.05) };
    for (what, region, bound) in
        [("sharp", sharp, [0.125, 0.45, 0.36]), ("grazing", grazing, [17.3, 15.3, 15.3])]
    {
        let all = cases(region, 1500);
        let measured = errors(&all.iter().collect::<Vec<_>>(), &corrected);
        println!("{what}: {measured:.2?}");
        let within = measured.iter().zip(bound).all(|(measured, bound)| *measured <= bound);
        assert!(within, "{what}: {measured:.2?} is beyond {bound:?}");
    }
    let mut all = cases(USUAL, 1500);
    for case in &mut all {
        case.brdf.alpha_y = (case.brdf.alpha_y * 0.2).max(0.0005);
    }
    all.retain(|case| case.ratio() > 10.0);
    let measured = errors(&all.iter().collect::<Vec<_>>(), &corrected);
    println!("ratios of 10 to 50: {measured:.2?}");
    assert!(measured[0] < 9.3 && measured[2] < 11.7, "{measured:.2?}");
}

/// Both mirrors, the exchange of the axes and the tangent's sign.
#[test]
fn lobes_have_the_symmetries_of_the_model() {
    let (table, anisotropic) = (Table::default(), AnisotropicTable::default());
    let light = |quad: &Quad, brdf: AnisotropicGgx| {
        Case { quad: quad.clone(), brdf }.light::<f64>(|surface, a| anisotropic.lobe(&table, surface, a))
    };
    for Case { quad, brdf } in cases(USUAL, 2000) {
        let value = light(&quad, brdf);
        let AnisotropicGgx { alpha_x, alpha_y, azimuth } = brdf;
        let mirrored = Quad {
            corners: [3, 2, 1, 0].map(|i| quad.corners[i] * DVec3::new(1.0, -1.0, 1.0)),
            ..quad.clone()
        };
        let swapped = AnisotropicGgx { alpha_x: alpha_y, alpha_y: alpha_x, azimuth: azimuth + FRAC_PI_2 };
        for (what, other) in [
            ("mirrored", light(&mirrored, AnisotropicGgx { azimuth: -azimuth, ..brdf })),
            ("axes exchanged", light(&quad, swapped)),
            ("tangent turned round", light(&quad, AnisotropicGgx { azimuth: azimuth + PI, ..brdf })),
        ] {
            assert!(value.abs_diff_eq(other, 1e-9), "{what}: {other}, not {value}: {brdf:?} {quad:?}");
        }
    }
}

#[test]
fn equal_roughnesses_have_the_isotropic_lobe() {
    let (table, anisotropic) = (Table::default(), AnisotropicTable::default());
    let mut random = Random::new(5);
    for (index, mut case) in cases(USUAL, 3000).into_iter().enumerate() {
        let alpha = if index % 3 == 0 { random.log(4e-4, 1.0) } else { case.brdf.alpha_x };
        (case.brdf.alpha_x, case.brdf.alpha_y) = (alpha, alpha);
        if index % 5 == 0 {
            case.quad.view = direction(random.log(1e-6, 1.0), 0.0);
        }
        let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, case.quad.view, alpha.sqrt());
        let expected = ltc_quad(&surface, &table.lobe(&surface), case.quad.corners, false);
        let value = case.light::<f64>(|surface, a| anisotropic.lobe(&table, surface, a));
        assert!(
            value.abs_diff_eq(expected, 1e-7),
            "{value}, not {expected}: {:?} {:?}",
            case.brdf,
            case.quad
        );
    }
}

/// Seen along the normal the azimuth is nothing but noise, so that lobes of all azimuths must be one.
#[test]
fn the_normal_view_has_no_azimuth() {
    let (table, anisotropic) = (Table::default(), AnisotropicTable::default());
    let mut worst = 0.0_f64;
    for (index, mut case) in cases(USUAL, 2000).into_iter().enumerate() {
        let at = |case: &Case| case.light::<f64>(|surface, a| anisotropic.lobe(&table, surface, a));
        case.quad.view = DVec3::Z;
        let value = at(&case);
        case.quad.view = direction(1.0 - 1e-10, index as f64);
        let near = at(&case);
        worst = worst.max((value - near).abs().max_element());
        assert!(value.abs_diff_eq(near, 1e-4), "{near}, not {value}: {:?}", case.brdf);
    }
    println!("the largest change is {worst:.1e}");
}

/// A box of lights around the surface returns the albedo, and that is the model's.
#[test]
fn a_white_furnace_returns_the_albedo() {
    let (table, anisotropic) = (Table::default(), AnisotropicTable::default());
    let box_corner = |i: usize| {
        let sign = |bit: usize| if i & bit == 0 { -1.0 } else { 1.0 };
        DVec3::new(sign(1) * 1.5, sign(2) * 2.0, if i & 4 == 0 { -1.0 } else { 0.7 })
    };
    // Counter-clockwise seen from inside.
    let faces = [[4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let (mut error, mut sum, mut worst) = (0.0, 0.0, 0.0_f64);
    let all = cases(USUAL, 1500);
    for case in &all {
        let (surface, anisotropy) = case.surface::<f64>();
        let lobe = anisotropic.lobe(&table, &surface, &anisotropy);
        let specular: f64 =
            faces.iter().map(|face| ltc_quad(&surface, &lobe, face.map(box_corner), false).y).sum();
        let what = format!("{:?} {}", case.brdf, case.quad.view);
        assert!((specular - lobe.albedo).abs() < 1e-9, "{specular}, not {}: {what}", lobe.albedo);
        let mut albedo = 0.0;
        for place in grid(60) {
            let light = case.brdf.sample(case.quad.view, place);
            if light.z > 0.0 {
                albedo += case.brdf.evaluate(case.quad.view, light) * light.z
                    / (3600.0 * case.brdf.pdf(case.quad.view, light));
            }
        }
        error += (lobe.albedo - albedo).abs();
        worst = worst.max((lobe.albedo - albedo).abs());
        sum += albedo;
    }
    println!("albedo: mean error {:.5} of the mean, worst {worst:.5}", error / sum);
    assert!(error / sum < 0.0028 && worst < 0.025, "{} {worst}", error / sum);
}

/// Every lobe of the whole domain, and beyond it, is one: finite, not turned inside out, with a share.
#[test]
fn every_lobe_is_sound() {
    let (table, anisotropic) = (Table::default(), AnisotropicTable::default());
    let mut random = Random::new(6);
    let mut smallest = f64::INFINITY;
    for index in 0..300_000 {
        let brdf = AnisotropicGgx {
            alpha_x: random.log(1e-5, 1.2),
            alpha_y: random.log(1e-5, 1.2),
            azimuth: random.between(0.0, TAU),
        };
        let cosine = match index % 3 {
            0 => random.log(1e-9, 1.0),
            1 => 1.0 - random.log(1e-12, 1.0),
            _ => random.unit(),
        };
        let (surface, anisotropy) = frame::<f32>(direction(cosine, 0.0), brdf);
        for coordinate in <[f32; 4]>::from(ltc_anisotropic_coordinates(&surface, &anisotropy)) {
            assert!((0.0..=1.0).contains(&coordinate), "{coordinate}: {brdf:?}, cosine {cosine}");
        }
        for (what, lobe) in [
            ("corrected", anisotropic.lobe(&table, &surface, &anisotropy)),
            ("stretched", stretched_lobe(&table, &surface, &anisotropy)),
        ] {
            let volume = lobe.axis_x.as_dvec3().dot(lobe.axis_y.as_dvec3().cross(lobe.axis_z.as_dvec3()));
            let normals = [lobe.normal_x, lobe.normal_y, lobe.normal_z];
            let sound = volume > 0.0
                && volume.is_finite()
                && normals.iter().all(|normal| normal.is_finite())
                && lobe.share > 0.0
                && lobe.share <= 1.0
                && (0.0..=1.0).contains(&lobe.albedo)
                && (0.0..=lobe.albedo).contains(&lobe.fresnel);
            assert!(sound, "{what}: {lobe:?}: {brdf:?}, cosine {cosine}");
            smallest = smallest.min(f64::from(lobe.share));
        }
    }
    println!("the smallest share is {smallest}");
}

#[test]
fn single_precision_is_precise() {
    let (table, anisotropic) = (Table::default(), AnisotropicTable::default());
    let (mut worst, mut sum) = (0.0_f64, 0.0);
    let all = cases(Region { roughness: (0.05, 1.0), cosine: (0.02, 1.0) }, 20_000);
    for case in &all {
        let exact = case.light::<f64>(|surface, a| anisotropic.lobe(&table, surface, a));
        let value = case.light::<f32>(|surface, a| anisotropic.lobe(&table, surface, a));
        let difference = (value - exact).abs().max_element();
        // Rounding moves a light by so much in a lobe of that width.
        let scaled = difference * case.brdf.alpha_y * case.quad.view.z;
        worst = worst.max(scaled);
        sum += difference;
        assert!(scaled < 3e-7, "{value}, not {exact}: {:?} {:?}", case.brdf, case.quad);
    }
    println!("worst {worst:.2e} / (alpha cos), mean {:.2e}", sum / all.len() as f64);
}

#[test]
fn roughness_and_anisotropy_make_two_alphas() {
    for roughness in [0.0, 0.1, 0.5, 0.9, 1.0, 2.0] {
        for anisotropy in [-1.0, 0.0, 0.3, 0.7, 1.0, 2.0] {
            let [x, y]: [f64; 2] = ltc_anisotropic_alpha::<f64>(roughness, anisotropy).into();
            let alpha = f64::min(roughness, 1.0).powi(2);
            let ratio = 1.0 / (1.0 - 0.9 * anisotropy.clamp(0.0, 1.0));
            assert!((y - alpha / ratio.sqrt()).abs() < 1e-12, "{roughness} {anisotropy}: {y}");
            assert!((x - (y * ratio).min(1.0)).abs() < 1e-12, "{roughness} {anisotropy}: {x}");
        }
    }
}

#[test]
fn the_committed_table_is_what_a_bake_gives() {
    let fitted = softbox::fit::bake_anisotropic(&Table::default(), 40, &|_| ());
    let table = AnisotropicTable::pack(&fitted);
    assert!(table.bytes() == softbox::TABLE_ANISOTROPIC, "table/ltc_anisotropic.bin is stale");
}

#[test]
fn a_bake_does_not_depend_on_the_number_of_threads() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
        pool.install(|| softbox::fit::bake_anisotropic(&Table::default(), 6, &|_| ()))
    };
    assert!(with(1) == with(3));
}

#[test]
fn no_texel_is_subnormal() {
    let table = AnisotropicTable::default();
    assert_eq!(AnisotropicTable::from_bytes(&table.bytes()), Ok(table.clone()));
    for layer in 0..2 {
        for row in 0..AnisotropicTable::SIZE {
            for column in 0..AnisotropicTable::SIZE {
                let texel = table.texel(layer, column, row);
                let normal = texel.iter().all(|number| number.to_f32() == 0.0 || number.is_normal());
                assert!(normal, "layer {layer} ({column}, {row}): {texel:?}");
            }
        }
    }
}

/// The shader itself, on a device, against the twin.
#[test]
fn the_shader_agrees_with_the_twin() {
    use softbox::device::{Device, Program};
    use wgpu::util::DeviceExt;

    let device = Device::open(wgpu::Backends::VULKAN).expect("a Vulkan device");
    let (table, anisotropic) = (Table::default(), AnisotropicTable::default());
    let all = cases(Region { roughness: (0.1, 1.0), cosine: (0.02, 1.0) }, 4000);
    let points: Vec<f32> = all
        .iter()
        .flat_map(|case| {
            let tangent = direction(0.0, case.brdf.azimuth);
            let heads = [
                DVec3::Z.extend(case.brdf.alpha_x),
                case.quad.view.extend(case.brdf.alpha_y),
                (tangent * 3.0 + DVec3::Z).extend(0.0),
            ];
            let corners = case.quad.corners.map(|corner| corner.extend(0.0));
            heads.into_iter().chain(corners).flat_map(|row| row.as_vec4().to_array()).collect::<Vec<f32>>()
        })
        .collect();
    let input = device.device().create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(&points),
        usage: wgpu::BufferUsages::STORAGE,
    });
    let output = device.device().create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 32 * all.len() as u64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let (_, sampler) = device.upload_table(&table);
    let texture = device.device().create_texture_with_data(
        device.queue(),
        &wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: 64, height: 64, depth_or_array_layers: 4 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba16Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::LayerMajor,
        &[softbox::TABLE_NATIVE, softbox::TABLE_ANISOTROPIC].concat(),
    );
    let view = texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    });
    let resources = [
        input.as_entire_binding(),
        output.as_entire_binding(),
        wgpu::BindingResource::TextureView(&view),
        wgpu::BindingResource::Sampler(&sampler),
    ];
    let program = Program::wgsl(softbox::WGSL_INCLUDE.to_owned() + include_str!("shaders/anisotropic.wgsl"));
    let groups = [(all.len() as u32).div_ceil(64), 1];
    let bytes = device.compute(&program, "evaluate", &resources, groups, &output).expect("the shader runs");
    let values: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
    let (mut worst, mut sum) = (0.0_f64, 0.0);
    for (case, pair) in all.iter().zip(values.chunks_exact(2)) {
        for (what, value, exact) in [
            ("corrected", pair[0], case.light::<f64>(|surface, a| anisotropic.lobe(&table, surface, a))),
            ("stretched", pair[1], case.light::<f64>(|surface, a| stretched_lobe(&table, surface, a))),
        ] {
            let value = glam::Vec4::from(value).as_dvec4();
            let difference = (value.truncate() - exact).abs().max_element();
            let scaled = difference * case.brdf.alpha_y * case.quad.view.z;
            worst = worst.max(scaled);
            sum += difference;
            assert!(scaled < 1e-6, "{what}: {value}, not {exact}: {:?} {:?}", case.brdf, case.quad);
        }
    }
    println!(
        "{}: worst {worst:.2e} / (alpha cos), mean {:.2e}",
        device.info().name,
        sum / (2 * all.len()) as f64
    );
}
