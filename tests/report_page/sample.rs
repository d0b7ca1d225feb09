//! A report of invented figures, to try the page with: nothing in it was measured.

use std::io::Cursor;

use softbox::report::data::{
    BudgetRow, CostRow, ErrorMap, ErrorRow, GrowthCurve, Kind, LobeRow, MethodInfo, Origin, Part, PictureRow,
    Report, SweepRow,
};
use softbox::report::page::PictureFile;

/// Name, label, kind, error and cost.
const METHODS: [(&str, &str, Kind, f64, f64); 14] = [
    ("fast", "fast", Kind::Level, 0.058, 0.37),
    ("standard", "standard", Kind::Level, 0.021, 0.78),
    ("fine", "fine", Kind::Level, 0.016, 1.35),
    ("finest", "finest", Kind::Level, 0.0095, 1.9),
    ("truth", "ground truth", Kind::Reference, 0.0, 0.0),
    ("published", "published LTC", Kind::Comparator, 0.059, 1.0),
    ("proxy", "sphere-proxy LTC", Kind::Comparator, 0.066, 0.72),
    ("representative", "representative point", Kind::Comparator, 0.31, 0.17),
    ("phong", "Arvo's Phong moments", Kind::Comparator, 0.24, 1.6),
    ("samples-1", "1 sample", Kind::Comparator, 0.62, 0.41),
    ("samples-4", "4 samples", Kind::Comparator, 0.33, 1.5),
    ("samples-16", "16 samples", Kind::Comparator, 0.16, 5.8),
    ("samples-64", "64 samples", Kind::Comparator, 0.081, 23.0),
    ("light-16", "16 samples of the light", Kind::Comparator, 0.21, 4.9),
];

/// SplitMix64 (Steele et al. 2014).
pub struct Random(pub u64);

impl Random {
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A value near another one.
    fn near(&mut self, value: f64) -> f64 {
        value * (0.8 + 0.4 * self.unit())
    }
}

fn factor(part: Part) -> f64 {
    match part {
        Part::Diffuse => 1e-5,
        Part::Specular => 1.0,
        Part::Fresnel => 2.2,
        Part::Dielectric => 1.6,
    }
}

fn picture(random: &mut Random, width: u32, height: u32) -> Vec<u8> {
    let noise = random.unit();
    let pixels = (0..width * height).flat_map(|index| {
        let [u, v] = [index % width, index / width].map(|place| f64::from(place) / f64::from(width));
        [u, v, noise].map(|channel| (255.0 * channel) as u8)
    });
    let image = image::RgbImage::from_raw(width, height, pixels.collect()).expect("as many bytes as pixels");
    let mut png = Cursor::new(Vec::new());
    image.write_to(&mut png, image::ImageFormat::Png).expect("memory takes it");
    png.into_inner()
}

pub fn report() -> (Report, Vec<PictureFile>) {
    let mut random = Random(7);
    let origin = |command: &str, device: &str, seed: &str| Origin {
        command: command.to_owned(),
        device: format!("{device} (invented)"),
        seed: seed.to_owned(),
    };
    let mut report = Report {
        version: "0.0.0 (invented figures)".to_owned(),
        command: "cargo run --example page_sample (invented figures)".to_owned(),
        origins: vec![
            origin("softbox report --quads 5000", "CPU, f32", "0x5eed"),
            origin("softbox cost --family navi21", "AMD RDNA 2 (navi21), RADV 22.3.6", ""),
            origin("softbox cost --lavapipe", "llvmpipe, LLVM 15.0.6, 256 bits", "42"),
            origin("softbox report --scenes", "llvmpipe, LLVM 15.0.6", ""),
        ],
        ..Report::default()
    };
    for (name, label, kind, ..) in METHODS {
        report.methods.push(MethodInfo {
            name: name.to_owned(),
            label: label.to_owned(),
            kind,
            description: format!(
                "An invented entry that stands where {label} will; two sentences are usual. (Nobody 2000)"
            ),
        });
    }
    let strata = ["all", "roughness 0.1-0.3", "roughness 0.3-0.6", "roughness 0.6-1", "cosine 0.05-0.3"];
    for (name, _, kind, error, _) in METHODS {
        if kind == Kind::Reference {
            continue;
        }
        for (part, stratum) in Part::ALL.into_iter().flat_map(|part| strata.map(|stratum| (part, stratum))) {
            let mean = random.near(error * factor(part));
            report.errors.push(ErrorRow {
                method: name.to_owned(),
                part,
                stratum: stratum.to_owned(),
                count: if stratum == "all" { 20_000 } else { 5_000 },
                mean,
                percentile: 6.0 * mean,
                maximum: 25.0 * mean,
                bias: mean * (random.unit() - 0.5),
            });
        }
    }
    maps(&mut report, &mut random);
    budget(&mut report, &mut random);
    costs(&mut report, &mut random);
    growth(&mut report);
    for (function, exhaustive) in
        [("ltc_angle_excess", true), ("ltc_sphere_share", true), ("ltc_horizon_angle", false)]
    {
        report.sweeps.push(SweepRow {
            function: function.to_owned(),
            domain: "[0, 1]".to_owned(),
            count: if exhaustive { 1_065_353_217 } else { 1 << 24 },
            exhaustive,
            maximum: random.near(3e-8),
            unit: "relative".to_owned(),
            worst: random.unit(),
        });
    }
    for name in ["fast", "standard", "fine", "finest"] {
        report.lobes.push(LobeRow {
            method: name.to_owned(),
            part: Part::Specular,
            mean: random.near(0.06),
            maximum: random.near(0.3),
            worst: [0.4, 0.1],
        });
    }
    let mut pictures = Vec::new();
    for scene in ["lights", "gallery"] {
        for name in ["fast", "standard", "fine", "finest", "truth"] {
            let file = |what: &str| format!("pictures/{scene}-{name}{what}.png");
            let truth = name == "truth";
            report.pictures.push(PictureRow {
                method: name.to_owned(),
                scene: scene.to_owned(),
                rmse: if truth { 0.0 } else { random.near(0.04) },
                mean: if truth { 0.0 } else { random.near(0.02) },
                picture: file(""),
                difference: if truth { String::new() } else { file("-difference") },
                origin: 3,
            });
            pictures.push((file(""), picture(&mut random, 640, 360)));
            if !truth {
                pictures.push((file("-difference"), picture(&mut random, 640, 360)));
            }
        }
    }
    (report, pictures)
}

fn maps(report: &mut Report, random: &mut Random) {
    let middles = |count: usize| (0..count).map(move |index| (index as f64 + 0.5) / count as f64);
    for (name, error, part) in METHODS[..4]
        .iter()
        .chain(&METHODS[5..7])
        .map(|method| (method.0, method.3))
        .chain([("ltc_own.bin", 0.03)])
        .flat_map(|(name, error)| [Part::Specular, Part::Dielectric].map(|part| (name, error, part)))
    {
        let roughness: Vec<f64> = middles(12).map(|share| 0.1 + 0.9 * share).collect();
        let cosine: Vec<f64> = middles(10).collect();
        let cell = |roughness: f64, cosine: f64| {
            let hill = (-8.0 * (roughness - 0.45).powi(2) - 4.0 * cosine).exp();
            error * factor(part) * (0.2 + 5.0 * hill)
        };
        let values = cosine
            .iter()
            .map(|cosine| roughness.iter().map(|rough| random.near(cell(*rough, *cosine))).collect())
            .collect();
        report.maps.push(ErrorMap { method: name.to_owned(), part, roughness, cosine, values });
    }
}

fn budget(report: &mut Report, random: &mut Random) {
    let causes = [
        ("lobe model", 0.6),
        ("fit", 0.25),
        ("interpolation", 0.08),
        ("half precision", 0.01),
        ("horizon", 0.15),
        ("edge integral", 1e-5),
        ("single precision", 1e-6),
    ];
    for (name, error, part) in METHODS[..4].iter().chain(&METHODS[5..7]).flat_map(|method| {
        [Part::Specular, Part::Fresnel, Part::Dielectric].map(|part| (method.0, method.3, part))
    }) {
        let row = |cause: &str, alone: f64, added: f64| BudgetRow {
            method: name.to_owned(),
            part,
            cause: cause.to_owned(),
            alone,
            added,
        };
        let whole = error * factor(part);
        let mut total = 0.0;
        for (cause, share) in causes {
            let alone = random.near(share * whole);
            // Some causes make up for others.
            let added = if cause == "interpolation" { -0.4 * alone } else { 0.8 * alone };
            total += added;
            report.budget.push(row(cause, alone, added));
        }
        report.budget.push(row("total", 1.02 * total, 0.0));
    }
}

fn costs(report: &mut Report, random: &mut Random) {
    let measures = [
        ("navi21 inverse throughput", "compute", "cycles", 1830.0, 1),
        ("navi21 instructions", "compute", "instructions", 953.0, 1),
        ("navi21 instructions", "fragment", "instructions", 980.0, 1),
        ("navi21 worst path", "compute", "cycles", 2400.0, 1),
        ("lavapipe time", "compute", "ns", 61.5, 2),
    ];
    for (measure, stage, unit, published, origin) in measures {
        for (name, _, kind, _, cost) in METHODS {
            if kind == Kind::Reference {
                continue;
            }
            let ratio = if name == "published" { 1.0 } else { random.near(cost) };
            report.costs.push(CostRow {
                method: name.to_owned(),
                measure: measure.to_owned(),
                stage: stage.to_owned(),
                value: ratio * published,
                unit: unit.to_owned(),
                ratio,
                origin,
            });
        }
    }
}

fn growth(report: &mut Report) {
    let mut curve = |chart: &str, method: &str, x_label: &str, x: &[f64], y: Vec<f64>, names: &[&str]| {
        report.growth.push(GrowthCurve {
            chart: chart.to_owned(),
            method: method.to_owned(),
            x_label: x_label.to_owned(),
            y_label: "time of a frame (ms)".to_owned(),
            x: x.to_vec(),
            y,
            names: names.iter().map(|name| (*name).to_owned()).collect(),
            origin: 2,
        });
    };
    let lights: Vec<f64> = (0..10).map(|power| f64::from(1 << power)).collect();
    let pixels: Vec<f64> = (0..7).map(|power| 4096.0 * 4_f64.powi(power)).collect();
    for (name, _, _, _, cost) in METHODS.iter().filter(|method| method.4 > 0.0).take(8) {
        curve("lights", name, "lights", &lights, lights.iter().map(|x| 0.3 + cost * x).collect(), &[]);
        curve("pixels", name, "pixels", &pixels, pixels.iter().map(|x| 0.1 + cost * 1e-5 * x).collect(), &[]);
    }
    let vertices: Vec<f64> = (3..=12).map(f64::from).collect();
    curve(
        "vertices",
        "standard",
        "vertices",
        &vertices,
        vertices.iter().map(|x| 0.3 + 0.11 * x).collect(),
        &[],
    );
    curve(
        "lobes",
        "lobes",
        "",
        &[1.0, 2.0, 3.0],
        vec![0.78, 1.35, 1.9],
        &["one lobe", "two lobes", "three lobes"],
    );
    let sets = ["diffuse only", "quad", "quad+ggx", "quad+ggx+two-sided", "quad+ggx,clearcoat"];
    curve(
        "effects",
        "standard",
        "set of effects",
        &[1.0, 2.0, 3.0, 4.0, 5.0],
        vec![0.1, 0.4, 0.78, 0.8, 1.3],
        &sets,
    );
    curve(
        "effects",
        "fast",
        "set of effects",
        &[1.0, 2.0, 3.0, 4.0, 5.0],
        vec![0.1, 0.3, 0.37, 0.4, 0.7],
        &sets,
    );
}
