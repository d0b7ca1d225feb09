//! Tubes in hard places: single precision and the shader against double precision, and nothing that jumps.

mod common;

use std::collections::BTreeMap;

use bytemuck::{Pod, Zeroable};
use common::Random;
use glam::{DVec3, Vec3};
use softbox::device::{Device, Program};
use softbox::shade::{LtcSurface, Real, Vector, ltc_surface, ltc_tube, ltc_tube_begin, ltc_tube_lobe};
use softbox::table::Table;
use wgpu::util::DeviceExt;

/// A surface, a tube and what must hold.
#[derive(Clone, Copy, Debug)]
struct Case {
    family: &'static str,
    position: Vec3,
    normal: Vec3,
    view: Vec3,
    roughness: f32,
    start: Vec3,
    end: Vec3,
    radius: f32,
    caps: bool,
    /// Whether the value must be within `bounds` of exact arithmetic; else it must be finite and physical.
    bounded: bool,
}

impl Case {
    fn surface<R: Real>(&self) -> LtcSurface<R> {
        let roughness = R::new(self.roughness.into());
        ltc_surface(vector::<R>(self.position), vector::<R>(self.normal), vector::<R>(self.view), roughness)
    }

    fn value<R: Real>(&self, table: &Table) -> [f64; 3] {
        let surface = self.surface::<R>();
        let (start, end) = (vector::<R>(self.start), vector::<R>(self.end));
        let lobe = table.lobe(&surface);
        let value = ltc_tube(&surface, &lobe, start, end, R::new(self.radius.into()), self.caps);
        [value.x(), value.y(), value.z()].map(Real::to_f64)
    }

    /// Bounds on the errors of the form factor and of specular light.
    ///
    /// Both grow with the angles under which the tube's width and length are seen, and with the ratio of its farther end's
    /// distance to its own, for coordinates have digits to so much. Specular light is 1 / α as sensitive, and
    /// 1 / cos θ times that seen at a grazing angle.
    fn bounds(&self) -> (f64, f64) {
        let [start, end] = [self.start, self.end].map(|v| (v - self.position).as_dvec3());
        let side = end - start;
        let moment = start.cross(side).length() / side.length().max(1e-300);
        let far = start.length().max(end.length());
        let near = moment.max(self.radius.into()).max(1e-300);
        let sine = f64::from(self.radius) / near;
        let moved = self.position.abs().max_element() as f64 / near;
        let alpha = f64::from(self.roughness.clamp(0.02, 1.0)).powi(2);
        let cosine = self.view.as_dvec3().normalize().dot(self.normal.as_dvec3().normalize()).max(1e-9);
        let cap = if self.caps { f64::from(self.radius) / start.length().min(end.length()) } else { 0.0 };
        let share = sine.max(cap).min(1.0);
        let reach = side.length() + if self.caps { f64::from(self.radius) } else { 0.0 };
        let size = share * (2.0 * reach / nearest(start, end).length()).min(1.0);
        let rounding = far / near + moved;
        (size * (4e-7 + 1e-7 * rounding), size * (3e-7 + 2e-7 * rounding) / (alpha * cosine))
    }
}

/// The point of a segment that is nearest to the origin.
fn nearest(start: DVec3, end: DVec3) -> DVec3 {
    let side = end - start;
    let t = (-start.dot(side) / side.length_squared().max(1e-300)).clamp(0.0, 1.0);
    start + side * t
}

fn vector<R: Real>(v: Vec3) -> R::Vec3 {
    R::Vec3::new(R::new(v.x.into()), R::new(v.y.into()), R::new(v.z.into()))
}

struct Builder {
    random: Random,
    cases: Vec<Case>,
}

impl Builder {
    fn add(&mut self, family: &'static str, start: DVec3, end: DVec3, radius: f64, bounded: bool) {
        let around = self.random.direction();
        let view = match self.random.index(10) {
            0 => DVec3::Z,
            1 => DVec3::Z + around * self.random.log(1e-8, 1e-2),
            2 => DVec3::new(around.x, around.y, around.z * self.random.log(1e-6, 1e-2)),
            _ => DVec3::new(around.x, around.y, around.z.abs()),
        };
        let roughness = match self.random.index(8) {
            0 => 0.0,
            1 => 1.0,
            _ => self.random.unit() as f32,
        };
        for caps in [false, true] {
            self.cases.push(Case {
                family,
                position: Vec3::ZERO,
                normal: Vec3::Z,
                view: view.as_vec3(),
                roughness,
                start: start.as_vec3(),
                end: end.as_vec3(),
                radius: radius as f32,
                caps,
                bounded,
            });
        }
    }

    fn upper(&mut self) -> DVec3 {
        let direction = self.random.direction();
        DVec3::new(direction.x, direction.y, direction.z.abs())
    }

    fn build(mut self, count: usize) -> Vec<Case> {
        for _ in 0..count {
            let distance = self.random.log(0.1, 30.0);
            let center = self.random.direction() * distance;
            let half = self.random.direction() * (distance * self.random.log(0.05, 30.0));
            let radius = distance * self.random.log(1e-3, 0.125);
            self.add("ordinary", center - half, center + half, radius, true);

            let center = self.upper() * self.random.log(1e-3, 1e3);
            let size = center.length() * self.random.log(1e-5, 0.1);
            let half = self.random.direction() * size;
            let radius = size * self.random.log(1e-3, 0.5);
            self.add("far", center - half, center + half, radius, true);

            let center = self.upper();
            let half = self.random.direction() * self.random.log(1e-12, 1e-4);
            let radius = self.random.log(1e-12, 1e-3);
            self.add("tiny", center - half, center + half, radius, true);

            let gap = self.random.log(1e-7, 0.1);
            let azimuth = self.random.between(0.0, core::f64::consts::TAU);
            let foot = DVec3::new(azimuth.cos(), azimuth.sin(), 0.0) * gap;
            let along = match self.random.index(3) {
                0 => DVec3::Z,
                1 => DVec3::new(-foot.y, foot.x, 0.0) / gap,
                _ => self.random.direction(),
            };
            let reach = [self.random.log(0.01, 3.0), self.random.log(0.01, 3.0)];
            let radius = gap * self.random.log(1e-2, 0.9);
            let rise = DVec3::Z * (self.random.between(0.0, 3.0) * gap);
            self.add(
                "touching",
                foot + rise - along * reach[0],
                foot + rise + along * reach[1],
                radius,
                true,
            );

            let height = self.random.log(1e-6, 0.3);
            let direction = DVec3::new(azimuth.sin(), azimuth.cos(), 0.0);
            let center = DVec3::new(azimuth.cos(), azimuth.sin(), height * self.random.between(-1.5, 1.5));
            let half = direction * self.random.log(1e-3, 10.0);
            self.add("along the horizon", center - half, center + half, height, true);

            let direction = self.random.direction();
            let aside = direction.any_orthonormal_vector() * self.random.log(1e-6, 1e-1);
            let near = self.random.log(0.1, 2.0);
            let far = near + self.random.log(0.01, 5.0);
            let radius = self.random.log(1e-4, 0.1);
            self.add(
                "pointing at the point",
                direction * near + aside,
                direction * far + aside,
                radius,
                true,
            );

            let reach = self.random.log(0.01, 3.0);
            self.add("along the normal", DVec3::Z * near, DVec3::Z * far, radius, true);
            self.add("from the point", DVec3::ZERO, direction * near, radius, false);
            self.add("through the point", direction * -reach, direction * near, radius, false);
            self.add("through the point, of no width", direction * -reach, direction * near, 0.0, false);
            let radius = [0.0, near, near * 0.999, far, 1e-30, 1e30][self.random.index(6)];
            self.add("the point inside", direction * near + aside, direction * far - aside, radius, false);
            self.add("of no length", direction * near, direction * near, 0.1 * near, false);
            self.add("at the point, of no length", DVec3::ZERO, DVec3::ZERO, radius, false);
        }
        for i in 0..4 * count {
            let random = &mut self.random;
            let mut v = || match i % 3 {
                0 => Vec3::new(random.finite(), random.finite(), random.finite()),
                1 => (random.direction() * random.log(1e-38, 3e38)).as_vec3(),
                _ => Vec3::new(f32::MAX, -f32::MAX, f32::MIN_POSITIVE) * random.between(-1.0, 1.0) as f32,
            };
            let nonzero = |v: Vec3| if v == Vec3::ZERO { Vec3::Z } else { v };
            let (start, end, position) = (v(), v(), v());
            let (normal, view) = (nonzero(v()), nonzero(v()));
            self.cases.push(Case {
                family: "any finite numbers",
                position: [Vec3::ZERO, position, start, -start][i / 3 % 4],
                normal,
                view,
                roughness: self.random.unit() as f32,
                start,
                end: if i % 7 == 0 { start } else { end },
                radius: self.random.finite(),
                caps: i % 2 == 0,
                bounded: false,
            });
        }
        // Any frame and place.
        for i in 0..self.cases.len() {
            let mut case = self.cases[i];
            if i % 3 == 0 && case.family == "ordinary" {
                let normal = self.random.direction();
                let (x, y) = normal.any_orthonormal_pair();
                let offset = self.random.direction();
                let turn =
                    |v: Vec3| (x * f64::from(v.x) + y * f64::from(v.y) + normal * f64::from(v.z)).as_vec3();
                case.family = "ordinary, turned and moved";
                case.normal = normal.as_vec3();
                case.view = turn(case.view);
                case.position = offset.as_vec3();
                case.start = turn(case.start) + case.position;
                case.end = turn(case.end) + case.position;
                self.cases.push(case);
            }
        }
        self.cases
    }
}

fn cases(count: usize) -> Vec<Case> {
    Builder { random: Random::new(11), cases: Vec::new() }.build(count)
}

#[derive(Default)]
struct Worst {
    count: usize,
    error: [f64; 2],
    share: [f64; 2],
}

/// Checks values against double precision; prints how much of each bound is used.
fn check(what: &str, cases: &[Case], values: &[[f64; 3]]) {
    let table = Table::default();
    assert_eq!(cases.len(), values.len(), "{what}: one value for each case");
    let mut worst: BTreeMap<&str, Worst> = BTreeMap::new();
    let mut offenders = Vec::new();
    for (case, value) in cases.iter().zip(values) {
        let [diffuse, specular, fresnel] = *value;
        let exact = case.value::<f64>(&table);
        let albedo = table.lobe(&case.surface::<f64>()).albedo * (1.0 + 1e-6);
        let physical = (0.0..=1.0).contains(&diffuse)
            && (0.0..=albedo).contains(&specular)
            && (0.0..=specular * (1.0 + 1e-6)).contains(&fresnel);
        let error = [(diffuse - exact[0]).abs(), (specular - exact[1]).abs()];
        let bounds = case.bounds();
        let limits = if case.bounded { [bounds.0, bounds.1] } else { [f64::INFINITY; 2] };
        let share: [f64; 2] = core::array::from_fn(|k| error[k] / limits[k].max(1e-37));
        let entry = worst.entry(case.family).or_default();
        entry.count += 1;
        for k in 0..2 {
            entry.error[k] = entry.error[k].max(error[k]);
            entry.share[k] = entry.share[k].max(share[k]);
        }
        if !physical || share[0] > 1.0 || share[1] > 1.0 {
            offenders.push(format!("{value:?}, exact {exact:?}, bounds {bounds:?}: {case:?}"));
        }
    }
    for (family, worst) in &worst {
        println!(
            "{what}: {family}: of {} the worst errors are {:.1e} and {:.1e}, {:.2} and {:.2} of their bounds",
            worst.count, worst.error[0], worst.error[1], worst.share[0], worst.share[1]
        );
    }
    assert!(
        offenders.is_empty(),
        "{what}: {} of {} beyond their bounds:\n{}",
        offenders.len(),
        cases.len(),
        offenders.iter().step_by(1 + offenders.len() / 12).cloned().collect::<Vec<_>>().join("\n")
    );
}

#[test]
fn single_precision_keeps_its_bounds() {
    let table = Table::default();
    let cases = cases(2000);
    let values: Vec<_> = cases.iter().map(|case| case.value::<f32>(&table)).collect();
    check("twin", &cases, &values);
}

/// A case as the kernel reads it.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Record {
    position: [f32; 3],
    roughness: f32,
    normal: [f32; 3],
    radius: f32,
    view: [f32; 3],
    caps: f32,
    start: [f32; 4],
    end: [f32; 4],
}

const KERNEL: &str = "
struct Record {
    position: vec3<f32>,
    roughness: f32,
    normal: vec3<f32>,
    radius: f32,
    view: vec3<f32>,
    caps: f32,
    start: vec4<f32>,
    end: vec4<f32>,
}

@group(0) @binding(0) var<storage, read> records: array<Record>;
@group(0) @binding(1) var<storage, read_write> values: array<vec4<f32>>;
@group(0) @binding(2) var table: texture_2d_array<f32>;
@group(0) @binding(3) var table_sampler: sampler;

@compute @workgroup_size(64)
fn evaluate(@builtin(global_invocation_id) invocation: vec3<u32>) {
    if (invocation.x >= arrayLength(&records)) {
        return;
    }
    let record = records[invocation.x];
    let surface = ltc_surface(record.position, record.normal, record.view, record.roughness);
    let lobes = ltc_lobes_from_table(surface, table, table_sampler, f32(textureDimensions(table).x), 0);
    let value = ltc_tube(surface, lobes, record.start.xyz, record.end.xyz, record.radius, record.caps > 0.0);
    values[invocation.x] = vec4<f32>(value, 0.0);
}
";

#[test]
fn the_shader_keeps_the_bounds() {
    let device = Device::open(wgpu::Backends::VULKAN).unwrap_or_else(|error| panic!("{error}"));
    let cases = cases(500);
    let records: Vec<Record> = cases
        .iter()
        .map(|case| Record {
            position: case.position.into(),
            roughness: case.roughness,
            normal: case.normal.into(),
            radius: case.radius,
            view: case.view.into(),
            caps: f32::from(u8::from(case.caps)),
            start: case.start.extend(0.0).into(),
            end: case.end.extend(0.0).into(),
        })
        .collect();
    let input = device.device().create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(&records),
        usage: wgpu::BufferUsages::STORAGE,
    });
    let output = device.device().create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 16 * records.len() as u64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let (view, sampler) = device.upload_table(&Table::default());
    let resources = [
        input.as_entire_binding(),
        output.as_entire_binding(),
        wgpu::BindingResource::TextureView(&view),
        wgpu::BindingResource::Sampler(&sampler),
    ];
    let program = Program::wgsl([softbox::WGSL_INCLUDE, KERNEL].concat());
    let groups = [(records.len() as u32).div_ceil(64), 1];
    let bytes = device
        .compute(&program, "evaluate", &resources, groups, &output)
        .unwrap_or_else(|error| panic!("{error}"));
    let values: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
    let values: Vec<_> = values.iter().map(|value| [value[0], value[1], value[2]].map(f64::from)).collect();
    check(&device.info().name, &cases, &values);
}

// ---- relations ----

/// No vector form factor is longer than that of the whole hemisphere.
#[test]
fn vector_form_factors_are_bounded() {
    let table = Table::default();
    let mut longest = 0.0_f32;
    for case in cases(1000) {
        let surface = case.surface::<f32>();
        let tube = ltc_tube_begin(&surface, case.start, case.end, case.radius, case.caps);
        let toward = ltc_tube_lobe(&tube, &table.lobe(&surface));
        assert!(
            toward.z >= 0.0 && toward.length() < 1.0 + 1e-5,
            "{toward:?}, length {}: {case:?}",
            toward.length()
        );
        longest = longest.max(toward.length());
    }
    println!("longest {longest}");
}

/// The largest change left where light changes fastest while a tube moves, after looking closer and closer there.
fn jump(table: &Table, from: &Case, to: &Case) -> (f64, f64) {
    let surface = from.surface::<f64>();
    let lobe = table.lobe(&surface);
    let value = |t: f64| {
        let mix = |a: Vec3, b: Vec3| a.as_dvec3().lerp(b.as_dvec3(), t);
        let radius = f64::from(from.radius) * (1.0 - t) + f64::from(to.radius) * t;
        ltc_tube(&surface, &lobe, mix(from.start, to.start), mix(from.end, to.end), radius, from.caps)
    };
    let (mut low, mut width, mut largest) = (0.0, 1.0, 0.0);
    for steps in [1000.0, 16.0, 16.0, 16.0, 16.0, 16.0, 16.0, 16.0] {
        width /= steps;
        let change = |i: f64| {
            let change = (value(low + width * (i + 1.0)) - value(low + width * i)).abs();
            change.x.max(change.y)
        };
        let mut fastest = 0.0;
        largest = 0.0;
        for i in 0..steps as u32 {
            if change(f64::from(i)) > largest {
                (fastest, largest) = (f64::from(i), change(f64::from(i)));
            }
        }
        low += width * fastest;
    }
    (low, largest)
}

/// Nothing jumps while tubes move through both horizons and the surface point, grow, shrink and vanish.
#[test]
fn moving_tubes_change_their_light_continuously() {
    let table = Table::default();
    let all: Vec<Case> = cases(300).into_iter().filter(|case| case.family != "any finite numbers").collect();
    let mut random = Random::new(25);
    let mut worst = 0.0_f64;
    for from in &all {
        let to = &all[random.index(all.len())];
        let view = (from.view + Vec3::Z * 0.3).normalize();
        let from = Case { roughness: from.roughness.max(0.3), view, ..*from };
        // Thinner tubes change faster than the last look resolves, and one of no width through the point has no limit.
        let limited = |case: &Case| (1e-6..30.0).contains(&case.radius);
        if !limited(&from) || !limited(to) {
            continue;
        }
        let (at, left) = jump(&table, &from, to);
        worst = worst.max(left);
        assert!(left < 1e-3, "a jump of {left} at {at}: {from:?} to {to:?}");
    }
    println!("the largest jump is {worst:.1e}");
}
