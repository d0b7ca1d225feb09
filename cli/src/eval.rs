//! `softbox eval`.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::Context;
use clap::{Args, ValueEnum};
use glam::DVec3;
use rayon::prelude::*;
use softbox::brdf::{Brdf, Ggx};
use softbox::device::{Batch, Device, EvaluateSurface, Program};
use softbox::effects::{self, Effects, Quality};
use softbox::light::{Light, light_value_with};
use softbox::scene::{Case, LONGEST_LINE, Precision, load_picture};
use softbox::shade::{
    LTC_ROUGHNESS_FLOOR, LobeSum, LtcLookup, Real, Vector, ltc_quad_begin, ltc_quad_lobe, ltc_quad_toward,
    ltc_rectangle_diffuse_lookup, ltc_rectangle_lookup, ltc_surface,
};
use softbox::table::Table;
use softbox::texture::Prefiltered;
use softbox::truth;

/// The long help.
pub const HELP: &str = r#"Evaluate surfaces and lights given as JSON Lines, one case a line:

{"surface":{"position":[0,0,0],"normal":[0,0,1],"view":[0.6,0,0.8],"roughness":0.5},
 "light":{"shape":"polygon","points":[[x,y,z],...],"two_sided":false}}

(on one line). normal and view (towards the eye) need not be unit; two_sided may be left out;
unknown fields are ignored. The polygon emits from the side from which its points run
counter-clockwise, with radiance 1. Other lights:

{"shape":"disk","center":[x,y,z],"half_x":[x,y,z],"half_y":[x,y,z],"two_sided":false}
{"shape":"sphere","center":[x,y,z],"radius":r}
{"shape":"tube","start":[x,y,z],"end":[x,y,z],"radius":r,"caps":false}

A disk emits towards half_x x half_y, a tube from its lateral surface, with caps from two hemispheres too.
A polygon that is a parallelogram may show a "picture", the name of a PNG file in sRGB: its first point is
the picture's lower left corner, and each integral is then three, of red, green and blue.
One line each is written:

{"diffuse":d,"specular":s,"fresnel":f}

with the integrals over the light's solid angle of cos/pi, of f cos for F = 1, and of
f cos (1 - v.h)^5. The model is GGX with height-correlated Smith masking."#;

#[derive(Args)]
pub struct EvalArguments {
    /// What evaluates.
    #[arg(long, value_enum, default_value = "cpu")]
    on: On,
    /// Quality level: fast, standard, fine or finest; standard by default. Truth has none.
    #[arg(long, value_name = "LEVEL")]
    quality: Option<Quality>,
    /// File of cases; standard input without it.
    file: Option<PathBuf>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum On {
    /// The include's twin in single precision.
    Cpu,
    /// The include's twin in double precision.
    CpuF64,
    /// The include on the first Vulkan adapter.
    Gpu,
    /// Numerical integration of the reflectance model in double precision.
    Truth,
}

/// Diffuse, specular and fresnel value, each alone or in red, green and blue.
enum Values {
    White([f64; 3]),
    Colour([DVec3; 3]),
}

/// Lines that are evaluated together: few enough to answer soon, enough to keep all cores busy; on a
/// device enough to be worth its start.
fn chunk(on: On) -> usize {
    if on == On::Gpu { 65_536 } else { 4096 }
}

/// Vertices that are evaluated together, so that they fit the storage buffers of every device.
const MOST_VERTICES: usize = 1 << 20;

pub fn eval(arguments: &EvalArguments) -> anyhow::Result<()> {
    let (name, input): (String, Box<dyn Read>) = match &arguments.file {
        Some(path) => {
            let file = File::open(path).with_context(|| format!("cannot read {}", path.display()))?;
            (path.display().to_string(), Box::new(file))
        }
        None => ("standard input".to_owned(), Box::new(io::stdin())),
    };
    let mut input = BufReader::with_capacity(1 << 16, input);
    let effects = "quad,polygon,disk,sphere,tube,textured+ggx+two-sided,caps".parse::<Effects>()?;
    anyhow::ensure!(
        arguments.on != On::Truth || arguments.quality.is_none(),
        "--quality says nothing to --on truth, which has no levels; leave one of them out"
    );
    let effects = arguments.quality.unwrap_or(Quality::Standard).of(effects);
    let layers = effects.layers();
    let table = Table::default().completed(&layers);
    let table = if layers.is_empty() { table } else { table.only(&layers) };
    let device = match arguments.on {
        On::Gpu => Some(Device::open(wgpu::Backends::VULKAN)?),
        _ => None,
    };
    let mut output = BufWriter::new(io::stdout().lock());
    let mut cases: Vec<Case> = Vec::new();
    let mut flush = |cases: &mut Vec<Case>| -> anyhow::Result<()> {
        let values: Vec<Values> = match arguments.on {
            On::Cpu => cases.par_iter().map(|case| by_twin::<f32>(&table, effects, case)).collect(),
            On::CpuF64 => cases.par_iter().map(|case| by_twin::<f64>(&table, effects, case)).collect(),
            On::Truth => cases.par_iter().map(by_truth).collect(),
            On::Gpu => match &device {
                Some(device) => by_device(device, &table, effects, cases)?,
                None => Vec::new(),
            },
        };
        let single = matches!(arguments.on, On::Cpu | On::Gpu);
        // The shortest text that is the same number of that precision.
        let number = |value: f64| if single { format!("{:?}", value as f32) } else { format!("{value:?}") };
        let colour = |value: DVec3| format!("[{}]", value.to_array().map(number).join(","));
        for values in values {
            let [diffuse, specular, fresnel] = match values {
                Values::White(values) => values.map(number),
                Values::Colour(values) => values.map(colour),
            };
            match writeln!(output, r#"{{"diffuse":{diffuse},"specular":{specular},"fresnel":{fresnel}}}"#) {
                // Whoever reads has seen enough.
                Err(error) if error.kind() == io::ErrorKind::BrokenPipe => std::process::exit(0),
                other => other.context("cannot write to standard output")?,
            }
        }
        match output.flush() {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => std::process::exit(0),
            other => other.context("cannot write to standard output")?,
        }
        cases.clear();
        Ok(())
    };
    let mut pictures = BTreeMap::new();
    let mut line = Vec::new();
    let mut vertices = 0;
    for number in 1.. {
        line.clear();
        // A line that never ends fills no memory.
        let parsed = match input.by_ref().take(LONGEST_LINE as u64 + 1).read_until(b'\n', &mut line) {
            Ok(0) => break,
            Ok(_) if line.len() > LONGEST_LINE => Err(anyhow::anyhow!(
                "{name}, line {number} is longer than {} MiB; put each case on a line of its own",
                LONGEST_LINE >> 20
            )),
            Ok(_) if line.iter().all(u8::is_ascii_whitespace) => continue,
            Ok(_) => {
                parse(&line, arguments.on, &mut pictures).with_context(|| format!("{name}, line {number}"))
            }
            Err(error) => Err(error).with_context(|| format!("cannot read {name} at line {number}")),
        };
        match parsed {
            Ok(case) => {
                vertices += vertex_count(&case.light);
                cases.push(case);
            }
            Err(error) => {
                flush(&mut cases)?;
                return Err(error);
            }
        }
        // Whoever types cases or sends them one by one gets the answers so; a device answers in batches.
        let waiting = input.buffer().is_empty() && arguments.on != On::Gpu;
        if waiting || cases.len() >= chunk(arguments.on) || vertices >= MOST_VERTICES {
            flush(&mut cases)?;
            vertices = 0;
        }
    }
    flush(&mut cases)
}

/// Pictures by the names of their files.
type Pictures = BTreeMap<String, Arc<Prefiltered>>;

fn parse(line: &[u8], on: On, pictures: &mut Pictures) -> anyhow::Result<Case> {
    let precision = match on {
        On::Cpu | On::Gpu => Precision::Single,
        On::CpuF64 | On::Truth => Precision::Double,
    };
    Ok(Case::parse(line, precision, &mut |name| {
        if on == On::Gpu {
            return Err(
                "the light has a picture, which cpu, cpu-f64 and truth evaluate, but not gpu".to_owned()
            );
        }
        if let Some(picture) = pictures.get(name) {
            return Ok(picture.clone());
        }
        let picture = Arc::new(load_picture(Path::new(name)).map_err(|error| error.to_string())?);
        pictures.insert(name.to_owned(), picture.clone());
        Ok(picture)
    })?)
}

fn by_twin<R: Real>(table: &Table, effects: Effects, case: &Case) -> Values {
    let v = |v: DVec3| R::Vec3::new(R::new(v.x), R::new(v.y), R::new(v.z));
    let surface = ltc_surface::<R>(v(case.position), v(case.normal), v(case.view), R::new(case.roughness));
    let lobes = table.specular(&surface, effects);
    let value = light_value_with(&surface, &lobes, &case.light, effects);
    let [diffuse, specular, fresnel] = [value.x(), value.y(), value.z()].map(Real::to_f64);
    let (Some(picture), Light::Polygon { points, two_sided }) = (&case.picture, &case.light) else {
        return Values::White([diffuse, specular, fresnel]);
    };
    let [a, b, c, d] = [points[0], points[1], points[2], points[3]].map(v);
    let quad = ltc_quad_begin(&surface, [a, b, c, d], *two_sided);
    let texels: R::Vec2 = picture.texels().map(R::new).into();
    let colour = |at: LtcLookup<R>| {
        let place: [R; 2] = at.place.into();
        let [red, green, blue, _] = picture.sample(place.map(Real::to_f64), at.level.to_f64());
        DVec3::new(red, green, blue)
    };
    let toward = ltc_quad_toward(&surface, &quad);
    let matte = colour(ltc_rectangle_diffuse_lookup(&surface, [a, b, d], toward, texels, false));
    let (mut glossy, mut sum) = (DVec3::ZERO, 0.0);
    for lobe in lobes.lobes() {
        let toward = ltc_quad_lobe(&quad, lobe);
        let [part, _]: [R; 2] = lobes.part(&surface, lobe, toward).into();
        glossy +=
            part.to_f64() * colour(ltc_rectangle_lookup(&surface, lobe, [a, b, d], toward, texels, false));
        sum += part.to_f64();
    }
    let glossy = glossy / sum.max(f64::MIN_POSITIVE);
    Values::Colour([matte * diffuse, glossy * specular, glossy * fresnel])
}

fn by_truth(case: &Case) -> Values {
    let normal = normalized(case.normal);
    let (tangent, bitangent) = normal.any_orthonormal_pair();
    let place = |v: DVec3| DVec3::new(v.dot(tangent), v.dot(bitangent), v.dot(normal));
    let mut view = place(normalized(case.view));
    // As for the include, a view on or below the horizon counts as a grazing one of the same azimuth.
    if view.z < 1e-4 {
        let along = if view.truncate().length() > 1e-6 {
            view
        } else {
            place(ltc_surface::<f64>(case.position, normal, case.view, case.roughness).tangent)
        };
        view = (along.truncate().normalize() * (1.0_f64 - 1e-8).sqrt()).extend(1e-4);
    }
    let light = case.light.moved(|point| place(point - case.position), place);
    let alpha = case.roughness.max(LTC_ROUGHNESS_FLOOR).powi(2);
    if let (Some(picture), Light::Polygon { points, two_sided }) = (&case.picture, &light) {
        return pictured(&Ggx::new(alpha), view, points, *two_sided, picture);
    }
    let truth = truth::light(&Ggx::new(alpha), view, &light, 1e-7);
    Values::White([truth.diffuse, truth.specular, truth.fresnel])
}

/// Ground truth of a light that shows a picture: the sum of what its texels add.
fn pictured(
    brdf: &dyn Brdf,
    view: DVec3,
    points: &[DVec3],
    two_sided: bool,
    picture: &Prefiltered,
) -> Values {
    let mut sums = [DVec3::ZERO; 3];
    let [a, b, d] = [points[0], points[1], points[3]];
    let front = (b - a).cross(d - a).dot(a) < 0.0;
    if front || two_sided {
        let image = &picture.levels()[0];
        let shares = truth::texel_shares(brdf, view, [a, b, d], [image.width, image.height]);
        for (&[red, green, blue, _], share) in image.texels.iter().zip(shares) {
            let colour = DVec3::new(red.into(), green.into(), blue.into());
            for (sum, share) in sums.iter_mut().zip(share) {
                *sum += colour * share;
            }
        }
    }
    Values::Colour(sums)
}

/// The direction of a vector of any length.
fn normalized(v: DVec3) -> DVec3 {
    (v / v.abs().max_element()).normalize()
}

fn by_device(
    device: &Device,
    table: &Table,
    effects: Effects,
    cases: &[Case],
) -> anyhow::Result<Vec<Values>> {
    let mut batch = Batch::default();
    for (index, case) in cases.iter().enumerate() {
        let single = |v: DVec3| <[f32; 3]>::from(v.as_vec3());
        batch.surfaces.push(EvaluateSurface {
            position: single(case.position),
            roughness: case.roughness as f32,
            normal: single(case.normal),
            view: single(case.view),
            ..EvaluateSurface::default()
        });
        let light = batch.add_light(&case.light);
        batch.pairs.push([index as u32, light]);
    }
    let program = Program::wgsl(format!("{}\n{}", effects::wgsl(effects)?, softbox::WGSL_EVALUATE));
    let values = device.evaluate(&program, table, &batch)?;
    Ok(values.into_iter().map(|value| Values::White(value.map(f64::from))).collect())
}

/// How many vectors of a storage buffer a light takes.
fn vertex_count(light: &Light) -> usize {
    match light {
        Light::Polygon { points, .. } => points.len(),
        _ => 3,
    }
}
