//! Whole surfaces: all lobes of a material under every light, on the processor and on a device.

mod common;

use bytemuck::{Pod, Zeroable};
use common::Random;
use glam::{DVec3, Vec3};
use softbox::device::{Device, Program};
use softbox::effects::{Effect, Effects, Quality};
use softbox::shade::{
    LtcMaterial, LtcReceived, LtcShading, Real, Vector, ltc_disk, ltc_fast_polygon, ltc_fast_quad,
    ltc_material, ltc_polygon_add, ltc_polygon_begin, ltc_polygon_end, ltc_quad, ltc_reflected, ltc_shading,
    ltc_shading_disk, ltc_shading_polygon, ltc_shading_quad, ltc_shading_sphere, ltc_shading_tube,
    ltc_sphere, ltc_surface, ltc_tube,
};
use softbox::table::{AnisotropicTable, Table};
use wgpu::util::DeviceExt;

/// Every layer, in the order that the kernel expects.
fn table() -> Table {
    Table::default().with(&Table::sheen()).with(&Table::diffuse()).with(AnisotropicTable::default().layers())
}

/// The same with what a set of effects reads besides, behind it.
fn table_for(effects: Effects) -> Table {
    table().completed(&effects.layers())
}

/// Everything that is on by default, at each quality level.
fn everything() -> impl Iterator<Item = Effects> {
    Quality::ALL.into_iter().map(|level| level.of(Effects::standing()))
}

/// A material and a light, as `tests/shaders/whole.wgsl` reads them.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
struct Case {
    position: [f32; 3],
    roughness: f32,
    normal: [f32; 3],
    diffuse_roughness: f32,
    view: [f32; 3],
    coat: f32,
    base_colour: [f32; 3],
    sheen_roughness: f32,
    normal_reflectance: [f32; 3],
    anisotropy: f32,
    sheen_colour: [f32; 3],
    coat_roughness: f32,
    grain: [f32; 3],
    radius: f32,
    a: [f32; 3],
    kind: u32,
    b: [f32; 3],
    flag: u32,
    c: [f32; 3],
    spare_a: u32,
    d: [f32; 3],
    spare_b: u32,
}

const KINDS: u32 = 5;

fn case(random: &mut Random, index: usize) -> Case {
    let mut direction = || random.direction().as_vec3();
    let (position, normal, around, grain) = (direction(), direction(), direction(), direction());
    let (toward, aside, beside) = (direction(), direction(), direction());
    let mut unit = || random.unit() as f32;
    let mut colour = || [unit(), unit(), unit()];
    let (base_colour, normal_reflectance, sheen_colour) = (colour(), colour(), colour());
    let (x, y) = (aside * (0.1 + unit()), beside * (0.1 + unit()));
    let a = position + (toward + normal * 0.5) * (0.5 + 3.0 * unit());
    let kind = index as u32 % KINDS;
    let [b, c, d] = match kind {
        1 => [x, y, Vec3::ZERO],
        3 => [a + x, Vec3::ZERO, Vec3::ZERO],
        _ => [a + x, a + x + y, a + y],
    };
    Case {
        position: position.into(),
        // Lobes so sharp that rounding decides what they see are tested elsewhere.
        roughness: 0.2 + 0.8 * unit(),
        normal: normal.into(),
        diffuse_roughness: unit(),
        view: (normal * (0.3 + unit()) + around * 0.9).into(),
        coat: unit(),
        base_colour,
        sheen_roughness: 0.2 + 0.8 * unit(),
        normal_reflectance,
        anisotropy: unit(),
        sheen_colour,
        coat_roughness: 0.2 + 0.8 * unit(),
        grain: grain.into(),
        radius: if kind == 3 { 0.02 } else { 0.1 + unit() },
        a: a.into(),
        kind,
        b: b.into(),
        flag: u32::from(index.is_multiple_of(3)),
        c: c.into(),
        d: d.into(),
        ..Case::default()
    }
}

fn wide<R: Real>(v: [f32; 3]) -> R::Vec3 {
    let [x, y, z] = v.map(|number| R::new(number.into()));
    R::Vec3::new(x, y, z)
}

fn material<R: Real>(case: &Case) -> LtcMaterial<R> {
    let number = |number: f32| R::new(number.into());
    LtcMaterial {
        diffuse_roughness: number(case.diffuse_roughness),
        coat: number(case.coat),
        coat_roughness: number(case.coat_roughness),
        sheen_colour: wide::<R>(case.sheen_colour),
        sheen_roughness: number(case.sheen_roughness),
        grain: wide::<R>(case.grain),
        anisotropy: number(case.anisotropy),
        ..ltc_material(
            wide::<R>(case.base_colour),
            number(case.roughness),
            wide::<R>(case.normal_reflectance),
        )
    }
}

fn shading<R: Real>(case: &Case, table: &Table, effects: Effects) -> LtcShading<R> {
    let (position, normal, view) = (wide::<R>(case.position), wide::<R>(case.normal), wide::<R>(case.view));
    ltc_shading(position, normal, view, &material::<R>(case), table, effects)
}

fn received<R: Real>(case: &Case, shading: &LtcShading<R>) -> LtcReceived<R> {
    let [a, b, c, d] = [case.a, case.b, case.c, case.d].map(wide::<R>);
    let (flag, radius) = (case.flag != 0, R::new(case.radius.into()));
    match case.kind {
        0 => ltc_shading_quad(shading, [a, b, c, d], flag),
        1 => ltc_shading_disk(shading, a, b, c, flag),
        2 => ltc_shading_sphere(shading, a, radius),
        3 => ltc_shading_tube(shading, a, b, radius, flag),
        _ => ltc_shading_polygon(shading, &[a, b, c, d], flag),
    }
}

/// With a specular part over Lambert's law a whole surface is what the functions of one light say, bit for bit.
#[test]
fn a_plain_surface_is_what_the_functions_of_one_light_say() {
    let plain: Effects = "quad,disk,sphere,tube,polygon+ggx+two-sided,caps".parse().expect("a set");
    for level in Quality::ALL {
        is_what_the_functions_of_one_light_say(level.of(plain));
    }
}

fn is_what_the_functions_of_one_light_say(effects: Effects) {
    let table = table_for(effects);
    let mut random = Random::new(71);
    let mut lit = 0;
    for index in 0..20_000 {
        let case = case(&mut random, index);
        let shading = shading::<f32>(&case, &table, effects);
        let whole = received(&case, &shading);
        let surface = ltc_surface::<f32>(
            wide::<f32>(case.position),
            wide::<f32>(case.normal),
            wide::<f32>(case.view),
            case.roughness,
        );
        let lobe = table.specular(&surface, effects);
        let [a, b, c, d] = [case.a, case.b, case.c, case.d].map(Vec3::from);
        let flag = case.flag != 0;
        let single = match case.kind {
            0 if effects.is_fast() => ltc_fast_quad(&surface, &lobe, [a, b, c, d], flag),
            4 if effects.is_fast() => ltc_fast_polygon(&surface, &lobe, &[a, b, c, d], flag),
            0 => ltc_quad(&surface, &lobe, [a, b, c, d], flag),
            1 => ltc_disk(&surface, &lobe, a, b, c, flag),
            2 => ltc_sphere(&surface, &lobe, a, case.radius),
            3 => ltc_tube(&surface, &lobe, a, b, case.radius, flag),
            _ => {
                let mut polygon = ltc_polygon_begin(&surface, a);
                for vertex in [b, c, d] {
                    ltc_polygon_add(&mut polygon, &surface, &lobe, vertex);
                }
                ltc_polygon_end(&mut polygon, &surface, &lobe, flag)
            }
        };
        let [specular, fresnel]: [f32; 2] = whole.specular.into();
        let bits = |v: Vec3| v.to_array().map(f32::to_bits);
        let both = (Vec3::new(whole.diffuse, specular, fresnel), single);
        assert_eq!(bits(both.0), bits(both.1), "{both:?}: {case:?}");
        lit += usize::from(single.x > 0.0);
    }
    assert!(lit > 8000, "{lit}");
}

/// What is reflected of two lights is the sum of what is reflected of each.
#[test]
fn reflection_is_linear_in_what_is_received() {
    let levels: Vec<(Effects, Table)> = everything().map(|effects| (effects, table_for(effects))).collect();
    let mut random = Random::new(72);
    for index in 0..5000 {
        let (one, other) = (case(&mut random, index), case(&mut random, index + 1));
        let (effects, table) = &levels[index % levels.len()];
        let shading = shading::<f64>(&one, table, *effects);
        let material = material::<f64>(&one);
        let other = Case { position: one.position, ..other };
        let (a, b) = (received(&one, &shading), received(&other, &shading));
        let both = LtcReceived {
            diffuse: a.diffuse + b.diffuse,
            rough: a.rough + b.rough,
            specular: a.specular + b.specular,
            coat: a.coat + b.coat,
            sheen: a.sheen + b.sheen,
        };
        let sum = ltc_reflected(&shading, &material, &a) + ltc_reflected(&shading, &material, &b);
        let whole = ltc_reflected(&shading, &material, &both);
        assert!((sum - whole).abs().max_element() < 1e-12, "{sum} and {whole}: {one:?}");
    }
}

/// A metal that reflects everything, under all that a material can have, reflects no more than it receives.
#[test]
fn nothing_is_brighter_than_the_room() {
    let levels: Vec<(Effects, Table)> = everything().map(|effects| (effects, table_for(effects))).collect();
    let mut random = Random::new(73);
    let mut least = 1.0_f64;
    for index in 0..6000 {
        let (effects, table) = &levels[index % levels.len()];
        let mut case = case(&mut random, index);
        case.base_colour = [0.0; 3];
        case.normal_reflectance = [1.0; 3];
        let shading = shading::<f64>(&case, table, *effects);
        let material = material::<f64>(&case);
        // From within a sphere there is light from everywhere.
        let room = ltc_shading_sphere(&shading, wide::<f64>(case.position), 10.0);
        let reflected = ltc_reflected(&shading, &material, &room);
        assert!(reflected.max_element() <= 1.0 + 1e-9, "{effects}: {reflected}: {case:?}");
        least = least.min(reflected.max_element());
    }
    // Sheen dims the channels that it does not colour, and little else is lost.
    println!("the darkest metal reflects {least} in its brightest channel");
    assert!(least > 0.9, "{least}");
}

#[test]
fn a_device_shades_what_the_twin_shades() {
    let device = Device::open(wgpu::Backends::VULKAN).unwrap_or_else(|error| panic!("{error}"));
    let mut random = Random::new(74);
    let cases: Vec<Case> = (0..20_000).map(|index| case(&mut random, index)).collect();
    let all = (0..KINDS).collect::<Vec<u32>>();
    let matte = [
        "quad,disk,sphere,tube,polygon+sheen,rough-diffuse+two-sided,caps",
        "quad,disk,sphere,tube,polygon+two-sided,caps",
    ];
    let mut sets: Vec<(Effects, &[u32])> =
        vec![(Effects::standing(), &all), (Effects::standing().without(Effect::Anisotropic), &all)];
    sets.extend(matte.map(|text| (set(text), &all[..])));
    // A driver may take minutes for a kernel of every light at once with every lobe.
    let lights = ["quad", "disk", "sphere", "tube", "polygon"];
    for level in [Quality::Fast, Quality::Fine, Quality::Finest] {
        for (kind, light) in lights.iter().enumerate() {
            let option = if *light == "tube" { "caps" } else { "two-sided" };
            let option = if *light == "sphere" { String::new() } else { format!("+{option}") };
            let plain = set(&format!("{light}+ggx,clearcoat,energy-compensation,anisotropic{option}"));
            sets.push((level.of(plain), &all[kind..=kind]));
        }
    }
    for (effects, kinds) in sets {
        let table = table_for(effects);
        let cases: Vec<Case> = cases.iter().filter(|case| kinds.contains(&case.kind)).copied().collect();
        let values = run(&device, &table, &cases, effects);
        let (mut worst, mut lit) = (0.0_f64, 0);
        for (case, value) in cases.iter().zip(values) {
            let exact = shading::<f64>(case, &table, effects);
            let reflected = ltc_reflected(&exact, &material(case), &received(case, &exact));
            let value = value.map(f64::from);
            let difference = (DVec3::new(value[0], value[1], value[2]) - reflected).abs().max_element();
            assert!(difference < 1e-4, "{effects}: {value:?} and {reflected}: {case:?}");
            worst = worst.max(difference);
            lit += usize::from(reflected.max_element() > 0.0);
        }
        println!("{effects}: {lit} lit, the worst is off by {worst:.1e}");
        assert!(lit > cases.len() / 4, "{effects}: {lit} of {}", cases.len());
    }
}

fn set(text: &str) -> Effects {
    text.parse().unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn run(device: &Device, table: &Table, cases: &[Case], effects: Effects) -> Vec<[f32; 4]> {
    let mut source = format!("{}\n{}", softbox::WGSL_INCLUDE, include_str!("shaders/whole.wgsl"));
    for (switch, on) in effects.switches() {
        let declared = format!("override {switch}: bool = ");
        source = source.replace(&format!("{declared}{};", !on), &format!("{declared}{on};"));
    }
    let inputs = device.device().create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(cases),
        usage: wgpu::BufferUsages::STORAGE,
    });
    let output = device.device().create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 16 * cases.len() as u64,
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
    let bytes = device
        .compute(&Program::wgsl(source), "whole", &resources, groups, &output)
        .unwrap_or_else(|error| panic!("{error}"));
    bytemuck::pod_collect_to_vec(&bytes)
}

#[test]
fn materials_call_for_what_they_show() {
    let plain = ltc_material::<f32>(Vec3::splat(0.5), 0.3, Vec3::splat(0.04));
    let matte = LtcMaterial { grazing_reflectance: Vec3::ZERO, ..ltc_material(Vec3::ONE, 0.5, Vec3::ZERO) };
    for (material, text) in [
        (plain, "lambert+ggx"),
        (matte, "lambert"),
        (LtcMaterial { coat: 0.5, ..matte }, "ggx,clearcoat"),
        (LtcMaterial { sheen_colour: Vec3::X, ..matte }, "sheen"),
        (LtcMaterial { diffuse_roughness: 0.1, ..matte }, "rough-diffuse"),
        (LtcMaterial { diffuse_roughness: 0.1, base_colour: Vec3::ZERO, ..plain }, "ggx"),
        (LtcMaterial { anisotropy: 0.4, ..plain }, "ggx,anisotropic"),
        (LtcMaterial { anisotropy: 0.4, ..matte }, "lambert"),
    ] {
        assert_eq!(material.effects(), text.parse().expect("a set"), "{material:?}");
    }
}
