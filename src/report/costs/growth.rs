//! How costs grow: with lights, vertices, pixels, lobes and effects.

use super::CostsError;
use rayon::prelude::*;

use super::bench::{Adapter, Bench, Bound, Job};
use super::inputs;
use super::kernel::Kernel;
use super::timing::{Effort, job, timed_inputs};
use crate::effects::Effects;
use crate::interpret::{Interpreter, Operations, Texels};
use crate::report::cost::{self, Binding, Cost, ENTRY_POINT, KERNEL, Program, StageModule};
use crate::report::data::GrowthCurve;
use crate::table::{Layer, Table};
use crate::{TABLE_SIZE, WGSL_INCLUDE};

/// Numbers of lights.
pub const LIGHTS: [u32; 9] = [1, 2, 4, 8, 16, 32, 64, 128, 256];
/// Numbers of a polygon's vertices.
pub const VERTICES: [u32; 9] = [3, 4, 6, 8, 16, 32, 64, 128, 256];
/// Numbers of pixels.
pub const PIXELS: [u32; 6] = [1 << 10, 1 << 12, 1 << 14, 1 << 16, 1 << 18, 1 << 20];
/// Lobes of a surface, one more each.
pub const LOBES: [(&str, &str); 7] = [
    ("diffuse", "quad"),
    ("specular", "quad+ggx"),
    ("two lobes", "quad+ggx+second-lobe"),
    ("three lobes", "quad+ggx+second-lobe,third-lobe"),
    ("and a coat", "quad+ggx,clearcoat"),
    ("and a sheen", "quad+ggx,clearcoat,sheen"),
    ("and rough diffuse", "quad+ggx,clearcoat,sheen,rough-diffuse"),
];
/// Sets of one light and one effect, or of what takes its place.
pub const EFFECTS: [&str; 13] = [
    "quad",
    "quad+ggx",
    "quad+ggx+two-sided",
    "quad+ggx+cheap-horizon",
    "quad+ggx,clearcoat",
    "quad+ggx,sheen",
    "quad+ggx,rough-diffuse",
    "quad+ggx,energy-compensation",
    "quad+ggx,anisotropic",
    "polygon+ggx",
    "disk+ggx",
    "sphere+ggx",
    "tube+ggx",
];

/// Surface points of a scene for the kernel of `wgsl/cost.wgsl`.
const POINTS: u32 = 4;

/// The bindings of that kernel.
pub const SCENE_BINDINGS: [Binding; 8] = {
    let mut bindings = [Binding::Buffer; 8];
    bindings[5] = Binding::Texture;
    bindings[6] = Binding::Sampler;
    bindings[7] = Binding::Texture;
    bindings
};

/// A scene for the kernel of `wgsl/cost.wgsl`: so many lights of the kind that the set of effects calls for first, each of so many
/// vertices if it is a polygon.
pub fn scene(effects: Effects, lights: u32, vertices: u32, points: u32) -> Job {
    let has = |name: &str| name.parse::<Effects>().is_ok_and(|one| effects.is_superset(one));
    let surface = |at: u32| {
        let turn = at as f32 * 2.4;
        let tilt = 0.1 + 0.8 * (at % 16) as f32 / 16.0;
        let position = [turn.cos() * tilt, turn.sin() * tilt, 0.0, 0.2 + 0.7 * tilt];
        let view = [tilt * turn.sin(), tilt * turn.cos(), (1.0 - tilt * tilt).sqrt(), 0.5];
        // Position and roughness; normal and coat; view and diffuse roughness; colours with the roughness of coat and sheen;
        // grain and anisotropy.
        [
            position,
            [0.0, 0.0, 1.0, 0.6],
            view,
            [0.5, 0.5, 0.5, 0.2],
            [0.2, 0.2, 0.2, 0.5],
            [1.0, 0.0, 0.0, 0.5],
        ]
        .concat()
    };
    let surfaces: Vec<f32> = (0..points).flat_map(surface).collect();
    let point: [f32; 8] = [0.0, 0.0, 4.0, 0.0, 1.0, 1.0, 1.0, 0.0];
    let mut corners: Vec<[f32; 4]> = Vec::new();
    let mut kinds: Vec<u32> = Vec::new();
    for light in 0..lights {
        let first = corners.len() as u32;
        let turn = light as f32 * 0.7;
        let centre = [1.5 * turn.cos(), 1.5 * turn.sin(), 1.5, 0.3];
        let beside = |x: f32, y: f32| [centre[0] + 0.5 * x, centre[1] + 0.5 * y, centre[2], 0.0];
        let (kind, more) = if has("disk") {
            (2, vec![centre, [0.5, 0.0, 0.0, 0.0], [0.0, -0.5, 0.0, 0.0]])
        } else if has("sphere") {
            (3, vec![centre])
        } else if has("tube") {
            let [x, y, z, _] = centre;
            (4, vec![[x, y, z, 0.1], [x, y + 1.0, z, 0.1]])
        } else if has("polygon") {
            // Clockwise from above, so counter-clockwise from the floor.
            let vertex = |at: u32| {
                let angle = -core::f32::consts::TAU * at as f32 / vertices as f32;
                beside(angle.cos(), angle.sin())
            };
            (1, (0..vertices).map(vertex).collect())
        } else {
            (0, vec![beside(-1.0, -1.0), beside(-1.0, 1.0), beside(1.0, 1.0), beside(1.0, -1.0)])
        };
        kinds.extend([1.0_f32.to_bits(), 1.0_f32.to_bits(), 1.0_f32.to_bits(), kind]);
        kinds.extend([first, more.len() as u32, u32::from(has("quad+two-sided")), 0]);
        corners.extend(more);
    }
    let layers = [
        &Layer::BASE[..],
        &[Layer::Sheen, Layer::Diffuse, Layer::AnisotropicFirst, Layer::AnisotropicSecond],
    ];
    let table = Table::default().completed(&layers.concat());
    let bound = vec![
        Bound::Input(bytemuck::cast_slice(&surfaces).to_vec()),
        Bound::Input(bytemuck::cast_slice(&point).to_vec()),
        Bound::Input(bytemuck::cast_slice(&kinds).to_vec()),
        Bound::Input(bytemuck::cast_slice(&corners).to_vec()),
        Bound::Output(16 * u64::from(points)),
        Bound::Table(table.bytes()),
        Bound::Sampler,
    ];
    Job { source: format!("{WGSL_INCLUDE}\n{KERNEL}"), entry_point: ENTRY_POINT, effects, bound }
}

/// What some invocations of a program take on average.
///
/// # Errors
///
/// If it has something that the interpreter lacks.
pub fn executed_on_average(job: &Job, invocations: u32) -> Result<Average, CostsError> {
    let mut interpreter = Interpreter::new(&job.source, job.entry_point, job.effects)?;
    for (binding, bound) in (0..).zip(&job.bound) {
        match bound {
            Bound::Input(bytes) => interpreter.bind_buffer(binding, bytes.clone()),
            Bound::Output(size) => interpreter.bind_buffer(binding, vec![0; *size as usize]),
            Bound::Table(bytes) => interpreter.bind_texels(binding, Texels::new(TABLE_SIZE, bytes)),
            Bound::Sampler => {}
        }
    }
    let mut sum = Operations::default();
    for at in 0..invocations {
        sum = sum + interpreter.run(at)?.total();
    }
    Ok(Average { sum, invocations })
}

/// What some invocations took.
#[derive(Clone, Copy, Debug)]
pub struct Average {
    /// All together.
    pub sum: Operations,
    /// How many there were.
    pub invocations: u32,
}

impl Average {
    /// Slots of one.
    pub fn slots(&self) -> f64 {
        self.sum.slots() as f64 / f64::from(self.invocations)
    }
}

fn effects(text: &str) -> Result<Effects, CostsError> {
    text.parse().map_err(|error: crate::effects::EffectsError| CostsError::Invalid(error.into()))
}

fn curve(
    chart: &str,
    method: &str,
    labels: [&str; 2],
    points: impl IntoIterator<Item = (f64, f64)>,
) -> GrowthCurve {
    let (x, y) = points.into_iter().unzip();
    let [x_label, y_label] = labels.map(str::to_owned);
    GrowthCurve {
        chart: chart.to_owned(),
        method: method.to_owned(),
        x_label,
        y_label,
        x,
        y,
        names: Vec::new(),
        origin: 0,
    }
}

const SLOTS: &str = "slots executed for each pixel";

/// What executed paths take for more and more of lights, vertices, lobes and effects; no device is asked.
///
/// # Errors
///
/// If a kernel has something that the interpreter lacks.
pub fn executed_growth() -> Result<Vec<GrowthCurve>, CostsError> {
    let counted: Vec<(&str, &str, &str, &[u32])> = vec![
        ("lights", "quad+ggx", "lights", &LIGHTS),
        ("lights", "quad+ggx+cheap-horizon", "lights", &LIGHTS),
        ("lights", "sphere+ggx", "lights", &LIGHTS),
        ("vertices", "polygon", "vertices of a polygon", &VERTICES),
        ("vertices", "polygon+ggx", "vertices of a polygon", &VERTICES),
    ];
    let one = |(chart, set, label, counts): &(&str, &str, &str, &[u32])| -> Result<GrowthCurve, CostsError> {
        let effects = effects(set)?;
        let point = |count: &u32| {
            let (lights, vertices) = if *chart == "lights" { (*count, 4) } else { (1, *count) };
            slots(effects, lights, vertices).map(|slots| (f64::from(*count), slots))
        };
        let points = counts.par_iter().map(point).collect::<Result<Vec<_>, _>>()?;
        Ok(curve(chart, set, [label, SLOTS], points))
    };
    let mut curves = counted.par_iter().map(one).collect::<Result<Vec<_>, _>>()?;
    for (chart, sets) in named_sets() {
        let slots = sets.par_iter().map(|(_, set)| slots(effects(set)?, 1, 4));
        curves.push(by_name(chart, "standard", SLOTS, &sets, slots.collect::<Result<_, _>>()?));
    }
    for (name, shared) in SHARED {
        let kernels =
            (1..=4).map(|lobes| lobes_of_one_light(lobes, shared)).collect::<Result<Vec<_>, _>>()?;
        let slots = |(lobes, kernel): (usize, &Kernel)| -> Result<(f64, f64), CostsError> {
            let executed = super::execute(kernel, &inputs::random(64))?;
            let slots: u64 = executed.iter().map(|(_, executed)| executed.total().slots()).sum();
            Ok((lobes as f64 + 1.0, slots as f64 / executed.len() as f64))
        };
        let points = kernels.par_iter().enumerate().map(slots).collect::<Result<Vec<_>, _>>()?;
        curves.push(curve("shared work", name, ["lobes", SLOTS], points));
    }
    Ok(curves)
}

fn slots(effects: Effects, lights: u32, vertices: u32) -> Result<f64, CostsError> {
    Ok(executed_on_average(&scene(effects, lights, vertices, POINTS), POINTS)?.slots())
}

/// Whether several lobes share the work on a light, and what curves call that.
const SHARED: [(&str, bool); 2] = [("ltc_quad_begin once", true), ("ltc_quad for each lobe", false)];

type NamedSets = Vec<(&'static str, &'static str)>;

fn named_sets() -> [(&'static str, NamedSets); 2] {
    [("lobes", LOBES.to_vec()), ("effects", EFFECTS.map(|set| (set, set)).to_vec())]
}

fn by_name(chart: &str, method: &str, y_label: &str, sets: &NamedSets, y: Vec<f64>) -> GrowthCurve {
    let names = sets.iter().map(|(name, _)| (*name).to_owned()).collect();
    GrowthCurve { names, ..curve(chart, method, [chart, y_label], (0..).map(f64::from).zip(y)) }
}

/// The same as a compiler sees it: programs whose costs [`compiled_growth`] makes curves of.
///
/// # Errors
///
/// Only if the include is broken.
pub fn growing_programs() -> Result<Vec<Program>, CostsError> {
    let mut programs = Vec::new();
    for (_, set) in named_sets().into_iter().flat_map(|(_, sets)| sets) {
        let spirv = cost::kernel(effects(set)?)?;
        programs.push(Program::Compute(StageModule { spirv, entry_point: ENTRY_POINT.to_owned() }));
    }
    for (_, shared) in SHARED {
        for lobes in 1..=4 {
            let [compute, _] = super::programs(&lobes_of_one_light(lobes, shared)?)?;
            programs.push(compute);
        }
    }
    Ok(programs)
}

/// Whether the code of a set has a loop over lobes or vertices, of which a compiler guesses how often it turns.
fn is_guessed(set: &str) -> bool {
    ["second-lobe", "polygon"].iter().any(|looping| set.contains(looping))
}

/// Curves of what a compiler for `family` makes of [`growing_programs`], without those whose loops it guesses at.
pub fn compiled_growth(family: &str, costs: &[Cost]) -> Vec<GrowthCurve> {
    let y_label = format!("{family} inverse throughput, cycles");
    let mut costs = costs.iter().map(|cost| cost.inverse_throughput as f64);
    let mut curves = Vec::new();
    for (chart, sets) in named_sets() {
        let pairs = sets.iter().copied().zip(costs.by_ref().take(sets.len()));
        let (sets, y) = pairs.filter(|((_, set), _)| !is_guessed(set)).unzip();
        curves.push(by_name(chart, family, &y_label, &sets, y));
    }
    for (name, _) in SHARED {
        let points = (1..=4).map(f64::from).zip(costs.by_ref().take(4));
        curves.push(curve("shared work", &format!("{name}, {family}"), ["lobes", &y_label], points));
    }
    curves
}

/// Some lobes of different roughness under one quad: with the work on the light shared, or by a call for each.
pub fn lobes_of_one_light(lobes: u32, shared: bool) -> Result<Kernel, CostsError> {
    let mut body = String::from("    var value = vec3<f32>(0.0);\n");
    let begin = "    let quad = ltc_quad_begin(surface_0, a, b, c, d, false);\n";
    for at in 0..lobes {
        body += &format!(
            "    let surface_{at} = ltc_surface_with_roughness(base, max(roughness * {:.2}, 0.1));\n",
            1.0 - 0.2 * f64::from(at)
        );
        body +=
            &format!("    let lobe_{at} = ltc_lobe_from_table(surface_{at}, table, table_sampler, 64.0);\n");
        if shared && at == 0 {
            body += begin;
            body += "    value.x += ltc_quad_diffuse(base, quad);\n";
        }
        body += &if shared {
            format!(
                "    value += vec3<f32>(0.0, ltc_lobe_value(surface_{at}, lobe_{at}, ltc_quad_lobe(quad, lobe_{at})));\n"
            )
        } else {
            format!(
                "    value += ltc_quad(surface_{at}, ltc_lobes_of(surface_{at}, lobe_{at}), a, b, c, d, false);\n"
            )
        };
    }
    if !shared {
        body += &format!("    value.x *= {:?};\n", 1.0 / f64::from(lobes));
    }
    if shared {
        // As ltc_quad does: nothing more for a light that does not reach the surface.
        body = body.replace(
            "    value.x += ltc_quad_diffuse",
            "    if (!quad.reaches) {\n        return value;\n    }\n    value.x += ltc_quad_diffuse",
        );
    }
    let method = format!(
        "fn method_value(position: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, roughness: f32, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>) -> vec3<f32> {{\n    let base = ltc_surface(position, normal, view, roughness);\n{body}    return value;\n}}\n"
    );
    Ok(Kernel::level("lobes", &method, effects("quad+ggx")?, crate::TABLE_NATIVE))
}

/// The same on lavapipe, as ratios of times over lights and vertices, and as times over pixels.
///
/// # Errors
///
/// If there is no lavapipe.
pub fn timed_growth(kernels: &[Kernel], effort: Effort) -> Result<(String, Vec<GrowthCurve>), CostsError> {
    let bench = Bench::open(&Adapter::Software)?;
    let points = if effort == Effort::QUICK { 1024 } else { 8192 };
    let ratios = |jobs: &[Job]| -> Result<Vec<f64>, CostsError> {
        let prepared = jobs.iter().map(|job| bench.prepare(job)).collect::<Result<Vec<_>, _>>()?;
        // The least disturbed of a few: the runs differ too much in length for a round to see them all in the same state.
        let mut least = vec![f64::INFINITY; jobs.len()];
        for _ in 0..effort.rounds.div_ceil(8).max(3) {
            for (one, least) in prepared.iter().zip(&mut least) {
                *least = least.min(bench.run(one, points, 1)?);
            }
        }
        Ok(least.iter().map(|time| time / least[0]).collect())
    };
    let xs = |numbers: &[u32]| numbers.iter().map(|x| f64::from(*x)).collect::<Vec<_>>();
    let mut curves = Vec::new();
    let quad = effects("quad+ggx")?;
    let jobs: Vec<Job> = LIGHTS.iter().map(|count| scene(quad, *count, 4, points)).collect();
    let labels = ["lights", "time, over that of one light"];
    curves.push(curve("lights", "quad+ggx, lavapipe", labels, xs(&LIGHTS).into_iter().zip(ratios(&jobs)?)));
    let polygon = effects("polygon+ggx")?;
    let jobs: Vec<Job> = VERTICES.iter().map(|count| scene(polygon, 1, *count, points)).collect();
    let labels = ["vertices of a polygon", "time, over that of a triangle"];
    curves.push(curve(
        "vertices",
        "polygon+ggx, lavapipe",
        labels,
        xs(&VERTICES).into_iter().zip(ratios(&jobs)?),
    ));
    let inputs = timed_inputs();
    for kernel in kernels {
        let most = PIXELS[PIXELS.len() - 1].min((effort.nanoseconds * 0.03) as u32).max(PIXELS[0]);
        let prepared = bench.prepare(&job(kernel, &inputs, most))?;
        let mut points = Vec::new();
        for count in PIXELS.iter().filter(|count| **count <= most) {
            let times = (0..5).map(|_| bench.run(&prepared, *count, 1)).collect::<Result<Vec<_>, _>>()?;
            points.push((f64::from(*count), times.into_iter().fold(f64::INFINITY, f64::min) * 1e-6));
        }
        curves.push(curve("pixels", &kernel.name, ["pixels", "milliseconds on lavapipe"], points));
    }
    Ok((bench.name(), curves))
}
