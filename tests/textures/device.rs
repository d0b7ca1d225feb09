//! The kernels and the include on a device, against the library.

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec2, Vec3};
use softbox::device::{Device, Program};
use softbox::report::{Region, form_factors, random_quads};
use softbox::shade::{LTC_LOOKUP, ltc_rectangle_diffuse_lookup, ltc_rectangle_lookup, ltc_surface};
use softbox::table::Table;
use softbox::texture::{TAPS, prefilter};
use wgpu::util::DeviceExt;

use crate::common::Random;
use crate::lookup::is_seen;
use crate::pyramid::noise;

fn device() -> Device {
    Device::open(wgpu::Backends::VULKAN).expect("a Vulkan device")
}

#[test]
fn the_kernel_makes_the_library_s_pyramid() {
    let device = device();
    let mut random = Random::new(8);
    for [width, height] in [[64, 64], [256, 128], [100, 37], [5, 3], [1, 9], [1, 1], [2, 2]] {
        let image = noise(&mut random, [width, height]);
        let wanted = prefilter(width, height, &image);
        let found = device.prefilter(width, height, &image).unwrap();
        assert_eq!(found.levels().len(), wanted.levels().len());
        for (index, (found, wanted)) in found.levels().iter().zip(wanted.levels()).enumerate() {
            for (at, (found, wanted)) in found.texels.iter().zip(&wanted.texels).enumerate() {
                for k in 0..4 {
                    assert!(
                        (found[k] - wanted[k]).abs() < 1e-3,
                        "{found:?}, not {wanted:?}: {width} x {height}, texel {at} of level {index}"
                    );
                }
            }
        }
    }
}

#[test]
fn the_numbers_in_the_shaders_are_those_of_the_library() {
    let stated = |text: &str, name: &str| -> f64 {
        let line = text.lines().find(|line| line.starts_with(&format!("const {name}: "))).expect(name);
        let number = line.split('=').nth(1).unwrap();
        number.trim_matches(|c: char| c == ' ' || c == ';' || c == 'u').parse().unwrap()
    };
    assert_eq!(stated(softbox::WGSL_PREFILTER, "PREFILTER_TAPS"), TAPS as f64);
    let numbers: [f64; 8] = LTC_LOOKUP.into();
    let names = ["SPREAD", "BLUR", "TILT", "EDGE_ON", "PUSH", "PUSH_MORE", "PAIR_SHARE", "PAIR_REACH"];
    for (name, number) in names.into_iter().zip(numbers) {
        assert_eq!(stated(softbox::WGSL_INCLUDE, &format!("LTC_LOOKUP_{name}")), number, "{name}");
    }
}

/// One case of the kernel below.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Case {
    view: [f32; 3],
    roughness: f32,
    a: [f32; 3],
    width: f32,
    b: [f32; 3],
    height: f32,
    d: [f32; 3],
    pair: f32,
    diffuse: [f32; 4],
    specular: [f32; 4],
}

const KERNEL: &str = "
struct Case {
    view: vec3<f32>,
    roughness: f32,
    a: vec3<f32>,
    width: f32,
    b: vec3<f32>,
    height: f32,
    d: vec3<f32>,
    pair: f32,
    diffuse: vec4<f32>,
    specular: vec4<f32>,
}
@group(0) @binding(0) var<storage, read> cases: array<Case>;
@group(0) @binding(1) var<storage, read_write> results: array<vec4<f32>>;
@group(0) @binding(2) var table: texture_2d_array<f32>;
@group(0) @binding(3) var table_sampler: sampler;

@compute @workgroup_size(64)
fn look_up(@builtin(global_invocation_id) invocation: vec3<u32>) {
    let index = invocation.x;
    if (index >= arrayLength(&cases)) {
        return;
    }
    let one = cases[index];
    let surface = ltc_surface(vec3<f32>(0.0), vec3<f32>(0.0, 0.0, 1.0), one.view, one.roughness);
    let lobe = ltc_lobe_from_table(surface, table, table_sampler, 64.0);
    let texels = vec2<f32>(one.width, one.height);
    let diffuse = ltc_rectangle_diffuse_lookup(surface, one.a, one.b, one.d, one.diffuse.xyz, texels, one.pair > 0.5);
    let specular = ltc_rectangle_lookup(surface, lobe, one.a, one.b, one.d, one.specular.xyz, texels, one.pair > 0.5);
    results[3u * index] = vec4<f32>(diffuse.place, diffuse.apart);
    results[3u * index + 1u] = vec4<f32>(specular.place, specular.apart);
    results[3u * index + 2u] = vec4<f32>(diffuse.level, specular.level, 0.0, 0.0);
}
";

#[test]
fn the_include_looks_where_the_library_does() {
    let device = device();
    let table = Table::default();
    let quads = random_quads(Region { roughness: (0.1, 1.0), cosine: (0.05, 1.0) }, 3000);
    let mut cases = Vec::new();
    let mut wanted = Vec::new();
    for (index, quad) in quads.iter().filter(|quad| is_seen(&table, quad)).enumerate() {
        let exact = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, quad.view, quad.roughness);
        let [diffuse, specular] =
            form_factors(&table.lobe(&exact), quad.corners).map(|vector| vector.as_vec3());
        let [a, b, _, d] = quad.corners.map(|corner| corner.as_vec3());
        let (pair, texels) = (index % 2 == 1, Vec2::new(256.0, 64.0 + (index % 5) as f32 * 100.0));
        let surface = ltc_surface::<f32>(Vec3::ZERO, Vec3::Z, quad.view.as_vec3(), quad.roughness as f32);
        let lobe = table.lobe(&surface);
        wanted.push([
            ltc_rectangle_diffuse_lookup::<f32>(&surface, [a, b, d], diffuse, texels, pair),
            ltc_rectangle_lookup::<f32>(&surface, &lobe, [a, b, d], specular, texels, pair),
        ]);
        cases.push(Case {
            view: quad.view.as_vec3().into(),
            roughness: quad.roughness as f32,
            a: a.into(),
            width: texels.x,
            b: b.into(),
            height: texels.y,
            d: d.into(),
            pair: f32::from(u8::from(pair)),
            diffuse: diffuse.extend(0.0).into(),
            specular: specular.extend(0.0).into(),
        });
    }
    assert!(cases.len() > 2000);
    let input = device.device().create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(&cases),
        usage: wgpu::BufferUsages::STORAGE,
    });
    let output = device.device().create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 48 * cases.len() as u64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let (view, sampler) = device.upload_table(&table);
    let resources = [
        input.as_entire_binding(),
        output.as_entire_binding(),
        wgpu::BindingResource::TextureView(&view),
        wgpu::BindingResource::Sampler(&sampler),
    ];
    let program = Program::wgsl(format!("{}{KERNEL}", softbox::WGSL_INCLUDE));
    let groups = [(cases.len() as u32).div_ceil(64), 1];
    let bytes = device.compute(&program, "look_up", &resources, groups, &output).unwrap();
    let results: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
    for (index, (wanted, result)) in wanted.iter().zip(results.chunks_exact(3)).enumerate() {
        for (k, wanted) in wanted.iter().enumerate() {
            let [u, v, apart_u, apart_v] = result[k];
            let level = result[2][k];
            let blur = level.exp2() / 256.0;
            let place = (Vec2::new(u, v) - wanted.place).length() / blur;
            // Where the blur is round its longer axis may point anywhere, and either way along itself.
            let apart = Vec2::new(apart_u, apart_v);
            let apart = (apart - wanted.apart).length().min((apart + wanted.apart).length()) / blur;
            assert!(
                place < 0.02 && apart < 0.1 && (level - wanted.level).abs() < 0.01,
                "{:?} at level {level}, not {wanted:?}: case {index}: {:?}",
                result[k],
                quads[index]
            );
        }
    }
}

const FETCH: &str = "
@group(0) @binding(0) var<storage, read> lookups: array<LtcLookup>;
@group(0) @binding(1) var<storage, read_write> colours: array<vec4<f32>>;
@group(0) @binding(2) var picture: texture_2d<f32>;
@group(0) @binding(3) var picture_sampler: sampler;

@compute @workgroup_size(64)
fn fetch(@builtin(global_invocation_id) invocation: vec3<u32>) {
    let index = invocation.x;
    if (index >= arrayLength(&lookups)) {
        return;
    }
    colours[2u * index] = ltc_texture_fetch(picture, picture_sampler, lookups[index]);
    colours[2u * index + 1u] = ltc_texture_fetch_pair(picture, picture_sampler, lookups[index]);
}
";

/// A sampler filters what was uploaded as the library does.
#[test]
fn a_texture_is_sampled_as_the_library_samples() {
    let device = device();
    let mut random = Random::new(10);
    let (width, height) = (64, 32);
    let prefiltered = prefilter(width, height, &noise(&mut random, [width, height]));
    // Place, apart, level and the padding of an array's element.
    let lookups: Vec<[f32; 6]> = (0..4096)
        .map(|_| {
            let apart = [random.between(-0.3, 0.3) as f32, random.between(-0.3, 0.3) as f32];
            [
                random.unit() as f32,
                random.unit() as f32,
                apart[0],
                apart[1],
                random.between(0.0, 9.0) as f32,
                0.0,
            ]
        })
        .collect();
    let wgpu_device = device.device();
    let input = wgpu_device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(&lookups),
        usage: wgpu::BufferUsages::STORAGE,
    });
    let buffer = |usage| {
        let size = 32 * lookups.len() as u64;
        wgpu_device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage,
            mapped_at_creation: false,
        })
    };
    let output = buffer(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
    let readback = buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
    let texture = wgpu_device.create_texture_with_data(
        device.queue(),
        &wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: width as u32, height: height as u32, depth_or_array_layers: 1 },
            mip_level_count: prefiltered.levels().len() as u32,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba16Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::LayerMajor,
        &prefiltered.bytes(),
    );
    let sampler = wgpu_device.create_sampler(&wgpu::SamplerDescriptor {
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        ..Default::default()
    });
    let module = wgpu_device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(format!("{}{FETCH}", softbox::WGSL_INCLUDE).into()),
    });
    let pipeline = wgpu_device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: Some("fetch"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let resources = [
        input.as_entire_binding(),
        output.as_entire_binding(),
        wgpu::BindingResource::TextureView(&view),
        wgpu::BindingResource::Sampler(&sampler),
    ];
    let entries: Vec<_> = resources
        .into_iter()
        .enumerate()
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding: binding as u32, resource })
        .collect();
    let group = wgpu_device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &entries,
    });
    let mut encoder = wgpu_device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(lookups.len().div_ceil(64) as u32, 1, 1);
    }
    encoder.copy_buffer_to_buffer(&output, 0, &readback, 0, output.size());
    device.queue().submit([encoder.finish()]);
    readback.slice(..).map_async(wgpu::MapMode::Read, |_| ());
    wgpu_device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    let colours: Vec<[f32; 4]> =
        bytemuck::pod_collect_to_vec(&readback.slice(..).get_mapped_range().unwrap());
    for (lookup, found) in lookups.iter().zip(colours.chunks_exact(2)) {
        let [u, v, apart_u, apart_v, level, _] = lookup.map(f64::from);
        let sample = |sign: f64| prefiltered.sample([u + sign * apart_u, v + sign * apart_v], level);
        let (single, first, second) = (sample(0.0), sample(1.0), sample(-1.0));
        for k in 0..4 {
            // Samplers place texels and levels to 1/256.
            for (found, wanted) in [(found[0][k], single[k]), (found[1][k], 0.5 * (first[k] + second[k]))] {
                assert!((f64::from(found) - wanted).abs() < 0.015, "{found}, not {wanted}: {lookup:?}");
            }
        }
    }
}
