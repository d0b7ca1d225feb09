//! Disks and spheres: the bounds that the documentation states, and relations that hold whatever the value is.

#[path = "../common/mod.rs"]
mod common;
mod families;

mod relations;

use families::{Bound, Case, Shape, cases};
use softbox::device::{Device, Program};
use softbox::table::Table;
use wgpu::util::DeviceExt;

/// The worst of a family.
#[derive(Default)]
struct Worst {
    count: usize,
    error: f64,
    share: f64,
    specular_share: f64,
}

/// Checks values against the bounds and exact arithmetic, the twin in f64; panics with the first offenders.
fn check(what: &str, cases: &[Case], values: &[[f64; 3]], table: &Table) {
    let mut worst: std::collections::BTreeMap<&str, Worst> = std::collections::BTreeMap::new();
    let mut offenders = Vec::new();
    for (case, value) in cases.iter().zip(values) {
        let exact = case.twin::<f64>(table);
        let [diffuse, specular, fresnel] = *value;
        let difference = (diffuse - exact[0]).abs();
        let (error, limit) = match case.bound {
            Bound::Absolute(bound) => (difference, bound),
            Bound::Relative(bound) => (difference / exact[0], bound),
            Bound::Zero => (diffuse.max(specular).max(fresnel), 0.0),
            Bound::Physical => (0.0, 0.0),
        };
        let albedo = case.albedo(table) * (1.0 + 1e-6);
        let physical = (0.0..=1.0).contains(&diffuse)
            && (0.0..=albedo).contains(&specular)
            && (0.0..=specular * (1.0 + 1e-6)).contains(&fresnel);
        let slack = case.specular_bound();
        let specular_error = (specular - exact[1]).abs().max((fresnel - exact[2]).abs());
        let entry = worst.entry(case.family).or_default();
        entry.count += 1;
        entry.error = entry.error.max(error);
        if limit > 0.0 {
            entry.share = entry.share.max(error / limit);
        }
        if slack.is_finite() {
            entry.specular_share = entry.specular_share.max(specular_error / slack);
        }
        if !(physical && error <= limit && specular_error <= slack) {
            offenders.push(format!("value {value:?}, exact {exact:?}, error {error:e}: {case:?}"));
        }
    }
    for (family, worst) in &worst {
        println!(
            "{what}: {family}: of {} the worst is {:.2e}; at most {:.2} of the bound, specular {:.2}",
            worst.count, worst.error, worst.share, worst.specular_share
        );
    }
    let shown = offenders.len().min(20);
    assert!(
        offenders.is_empty(),
        "{what}: {} of {} cases beyond their bounds:\n{}",
        offenders.len(),
        cases.len(),
        offenders[..shown].join("\n")
    );
}

#[test]
fn the_twin_in_single_precision_keeps_every_bound() {
    let table = Table::default();
    let cases = cases(400);
    let values: Vec<_> = cases.iter().map(|case| case.twin::<f32>(&table)).collect();
    check("twin", &cases, &values, &table);
}

/// The include itself, on a device.
#[test]
fn the_include_keeps_every_bound() {
    let table = Table::default();
    let cases = cases(400);
    let device = Device::open(wgpu::Backends::VULKAN).expect("a Vulkan adapter");
    let input: Vec<[f32; 24]> = cases
        .iter()
        .map(|case| {
            let (kind, radius, center, half_x, half_y) = match case.shape {
                Shape::Disk { center, half_x, half_y, two_sided } => {
                    (f32::from(u8::from(two_sided)), 0.0, center, half_x, half_y)
                }
                Shape::Sphere { center, radius } => (2.0, radius, center, center, center),
            };
            let rows = [
                (case.position, case.roughness),
                (case.normal, radius),
                (case.view, kind),
                (center, 0.0),
                (half_x, 0.0),
                (half_y, 0.0),
            ];
            core::array::from_fn(|i| {
                let (vector, number) = rows[i / 4];
                if i % 4 == 3 { number } else { vector[i % 4] }
            })
        })
        .collect();
    let buffer = device.device().create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(&input),
        usage: wgpu::BufferUsages::STORAGE,
    });
    let output = device.device().create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 16 * cases.len() as u64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let (view, sampler) = device.upload_table(&table);
    let resources = [
        buffer.as_entire_binding(),
        output.as_entire_binding(),
        wgpu::BindingResource::TextureView(&view),
        wgpu::BindingResource::Sampler(&sampler),
    ];
    let program = Program::wgsl(format!("{}{}", softbox::WGSL_INCLUDE, include_str!("evaluate.wgsl")));
    let groups = (cases.len() as u32).div_ceil(64);
    let bytes = device
        .compute(&program, "evaluate_disks", &resources, [groups, 1], &output)
        .expect("a device that runs the kernel");
    let values: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
    let values: Vec<_> = values.iter().map(|v| [v[0], v[1], v[2]].map(f64::from)).collect();
    check(&device.info().name, &cases, &values, &table);
}
