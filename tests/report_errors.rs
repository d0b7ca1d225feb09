//! What a report says of errors is right: known errors are found, shares add up, strata part.

use core::f64::consts::PI;

use glam::{DVec2, DVec3};
use softbox::brdf::{Brdf, Ggx, Lambert, schlick};
use softbox::device::Device;
use softbox::effects::{Effect, Effects};
use softbox::fit::{Settings, ggx};
use softbox::report::data::{Kind, MethodInfo, Part};
use softbox::report::errors::{
    Case, Effort, Error, ErrorSet, LevelSteps, MapSet, MapSettings, PARTS, PictureLevel, QUAD_SEED, REGION,
    STRATA, StandardSteps, Sweep, TableMethod, UNIVARIATE, budget, cases, error_row, error_rows, exact_angle,
    exact_value, fitted_angle, lobe_rows, model, parts, pictures, random_lights, read_table, solid_angle,
    sweep, table_lobes, total_variation, true_value, univariate,
};
use softbox::report::{Method, Quad, Region, Technique, accuracy};
use softbox::scene::{Comparison, Scene, render_truth};
use softbox::shade::{ltc_angle_excess, ltc_quad, ltc_surface};
use softbox::table::Table;

/// The truth, each part with an error of its own.
struct Planted([f64; 3]);

impl Method for Planted {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: "planted".to_owned(),
            label: "Planted".to_owned(),
            kind: Kind::Comparator,
            description: String::new(),
        }
    }

    fn value(&self, quad: &Quad) -> [f64; 3] {
        let truth = true_value(quad);
        core::array::from_fn(|k| truth[k] * self.0[k])
    }
}

fn near(found: f64, expected: f64, bound: f64, what: &str) {
    assert!((found - expected).abs() <= bound, "{what}: {found} is not {expected} within {bound}");
}

#[test]
fn a_planted_error_is_found_in_every_stratum() {
    let set = ErrorSet::of(200, 40);
    for row in error_rows(&[&Planted([1.03; 3])], &set) {
        let what = format!("{row:?}");
        near(row.mean, 0.03, 1e-12, &what);
        near(row.bias, 0.03, 1e-12, &what);
        assert!(row.maximum >= row.percentile && row.percentile >= row.mean, "{what}");
    }
    for row in error_rows(&[&Planted([1.0, 0.98, 1.0])], &set) {
        let expected = match row.part {
            Part::Specular => -0.02,
            Part::Dielectric => -0.02 * 0.04,
            Part::Diffuse | Part::Fresnel => 0.0,
        };
        // Of a dielectric's value, Schlick's part is a share that depends on the lights.
        if row.part != Part::Dielectric {
            near(row.bias, expected, 1e-12, &format!("{row:?}"));
        } else {
            assert!(row.bias < 0.0 && row.bias > -0.02, "{row:?}");
        }
    }
    for map in MapSet::new(MapSettings { cells: 3, lights: 4, region: REGION }).maps(&Planted([1.03; 3])) {
        assert_eq!((map.values.len(), map.roughness.len(), map.cosine.len()), (3, 3, 3));
        for value in map.values.iter().flatten() {
            near(*value, 0.03, 1e-12, &format!("{:?}", map.part));
        }
    }
}

#[test]
fn statistics_are_those_of_the_definition() {
    let pairs: Vec<(f64, f64)> = (0..200).map(|i| (2.0 + f64::from(i - 100) * 0.01, 2.0)).collect();
    let row = error_row("m", Part::Specular, "all", &pairs);
    assert_eq!(row.count, 200);
    near(row.mean, 0.25, 1e-12, "mean");
    near(row.bias, -0.0025, 1e-12, "bias");
    near(row.maximum, 0.5, 1e-12, "maximum");
    near(row.percentile, 0.495, 1e-12, "percentile");
}

/// The same integrals over the light's area instead of the solid angle, and by another rule.
#[test]
fn the_truth_is_true() {
    let quads = random_lights(5, Region { roughness: (0.4, 1.0), cosine: (0.1, 1.0) }, 400);
    let above = quads.into_iter().filter(|quad| quad.corners.iter().all(|corner| corner.z > 0.0));
    let (mut errors, mut total) = ([0.0; 4], [0.0; 4]);
    for quad in above.take(60) {
        let [corner, b, _, d] = quad.corners;
        let (x, y) = (b - corner, d - corner);
        let normal = x.cross(y);
        let brdf = model(quad.roughness);
        let count = 300;
        let mut sum = [0.0; 3];
        for i in 0..count {
            for j in 0..count {
                let at = |i: i32| (f64::from(i) + 0.5) / f64::from(count);
                let point = corner + x * at(i) + y * at(j);
                let light = point.normalize();
                let solid = normal.dot(-light).abs() / point.length_squared() / f64::from(count).powi(2);
                let value = brdf.evaluate(quad.view, light) * light.z * solid;
                sum[0] += light.z / PI * solid;
                sum[1] += value;
                sum[2] += value * schlick(quad.view, light);
            }
        }
        for (k, (found, truth)) in parts(sum).into_iter().zip(parts(true_value(&quad))).enumerate() {
            errors[k] += (found - truth).abs();
            total[k] += truth;
        }
    }
    for k in 0..4 {
        let error = errors[k] / total[k];
        println!("{:?}: {error:.2e}", PARTS[k]);
        assert!(error < 1e-4, "{:?}: {error}", PARTS[k]);
    }
}

#[test]
fn strata_part_the_set() {
    let set = ErrorSet::of(500, 50);
    let rows = error_rows(&[&TableMethod::standard()], &set);
    for part in PARTS {
        let of = |name: &str| {
            let all: Vec<_> =
                rows.iter().filter(|row| row.part == part && row.stratum.starts_with(name)).collect();
            (all.iter().map(|row| row.count).sum::<usize>(), all.len(), all)
        };
        let (count, _, all) = of("all");
        assert_eq!(count, 500);
        assert_eq!(of("triangles").0, 50);
        let value = |row: &softbox::report::data::ErrorRow, sum: f64| row.mean * sum;
        for stratum in &STRATA {
            let (count, classes, rows) = of(stratum.name);
            assert_eq!((count, classes), (500, stratum.classes.len()), "{}", stratum.name);
            // The mean |errors| of the classes, each times its own mean value, add up.
            let index = PARTS.iter().position(|one| *one == part).unwrap_or(0);
            let whole = |class: Option<usize>| -> f64 {
                let belongs = |case: &&Case| class.is_none_or(|class| stratum.class(&case.quad) == class);
                set.quads.iter().filter(belongs).map(|case| parts(case.truth)[index]).sum()
            };
            let sum: f64 = rows.iter().enumerate().map(|(class, row)| value(row, whole(Some(class)))).sum();
            let expected = value(all[0], whole(None));
            near(sum / expected, 1.0, 1e-9, stratum.name);
        }
    }
}

#[test]
fn solid_angles_are_right() {
    // A face of a cube, seen from its centre.
    let face = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 1.0));
    near(solid_angle(&face), 4.0 * PI / 6.0, 1e-14, "a face");
    let [a, b, c, _] = face;
    near(solid_angle(&[a, b, c, c]), 2.0 * PI / 6.0, 1e-14, "half a face");
}

/// The errors are those by which the README's figures are held.
#[test]
fn standard_has_the_figures_of_its_table() {
    let set = ErrorSet::of(1500, 0);
    let quads: Vec<Quad> = set.quads.iter().map(|case| case.quad.clone()).collect();
    assert_eq!(quads, random_lights(QUAD_SEED, REGION, 1500));
    let expected =
        accuracy(&Table::default(), Technique::Include, &|r| Box::new(model(r)) as Box<dyn Brdf>, &quads);
    for row in error_rows(&[&TableMethod::standard()], &set).into_iter().filter(|row| row.stratum == "all") {
        let expected = match row.part {
            Part::Diffuse => 0.0,
            Part::Specular => expected.specular,
            Part::Fresnel => expected.fresnel,
            Part::Dielectric => expected.dielectric,
        };
        // One is in single, the other in double precision.
        near(row.mean, expected, 1e-6, &format!("{row:?}"));
    }
}

#[test]
fn a_budget_adds_up() {
    let set = cases(random_lights(QUAD_SEED, REGION, 150));
    let settings = Settings { nodes: 16, ..Settings::native(12) };
    let table = Table::pack(&softbox::fit::bake(&ggx, settings, &|_| ()));
    let method = TableMethod { table, ..TableMethod::standard() };
    let steps = StandardSteps::new(method, settings, &set, &|_| ());
    let level = steps.steps();
    let rows = budget(&level, &set);
    assert_eq!(rows.len(), 4 * (level.steps.len() + 1));
    for part in PARTS {
        let rows: Vec<_> = rows.iter().filter(|row| row.part == part).collect();
        let (total, causes) = rows.split_last().expect("rows");
        assert_eq!(total.cause, "total");
        let sum: f64 = causes.iter().map(|row| row.added).sum();
        println!("{part:?} {causes:#?}");
        near(sum, total.added, 1e-12, &format!("{part:?}"));
        for row in causes {
            // A cause cannot change the error by more than the value.
            assert!(row.added.abs() <= row.alone + 1e-12, "{row:?}");
        }
        let cause = |name: &str| causes.iter().find(|row| row.cause == name).expect(name).alone;
        // Small tables interpolate badly, half precision hardly matters, and arithmetic even less.
        if part == Part::Specular {
            assert!(cause("interpolation") > 10.0 * cause("half precision"), "{part:?}");
            assert!(cause("half precision") > 10.0 * cause("edge integral"), "{part:?}");
        }
        assert!(cause("horizon") < 1e-6 && cause("edge integral") < 1e-6, "{part:?}");
        assert!(cause("single precision") > 0.0 && cause("single precision") < 1e-5, "{part:?}");
    }
}

#[test]
fn a_budget_knows_its_causes() {
    let set = cases(random_lights(QUAD_SEED, REGION, 50));
    let planted = Planted([1.03; 3]);
    let by = |factor: f64| move |quad: &Quad| true_value(quad).map(|value| value * factor);
    let level = LevelSteps {
        steps: vec![
            ("first".to_owned(), Box::new(by(1.05))),
            ("second".to_owned(), Box::new(by(0.99))),
            ("third".to_owned(), Box::new(by(1.03))),
        ],
        method: &planted,
    };
    for part in budget(&level, &set).chunks(4) {
        for (row, (alone, added)) in
            part.iter().zip([(0.05, 0.05), (0.06, -0.04), (0.04, 0.02), (0.03, 0.03)])
        {
            near(row.alone, alone, 1e-12, &format!("{row:?}"));
            near(row.added, added, 1e-12, &format!("{row:?}"));
        }
    }
}

/// Cutting polygons and summing exact angles is what the include does another way.
#[test]
fn exact_values_are_those_of_the_twin() {
    let (table, fitted) = (Table::default(), fitted_angle());
    let mut worst = [0.0_f64; 2];
    for quad in random_lights(QUAD_SEED, REGION, 3000) {
        let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, quad.view, quad.roughness);
        let lobe = table.lobe(&surface);
        let twin = ltc_quad(&surface, &lobe, quad.corners, false).to_array();
        let exact = exact_value(&surface, &[lobe], &quad.corners, &exact_angle);
        let with_fit = exact_value(&surface, &[lobe], &quad.corners, &fitted);
        for k in 0..3 {
            worst[0] = worst[0].max((twin[k] - exact[k]).abs());
            worst[1] = worst[1].max((with_fit[k] - exact[k]).abs());
        }
    }
    println!("{worst:?}");
    assert!(worst[0] < 1e-9 && worst[1] < 1e-6 && worst[1] > 1e-9, "{worst:?}");
}

/// The polynomial in f64 is the include's but for rounding.
#[test]
fn the_fitted_angle_is_the_includes() {
    let fitted = fitted_angle();
    for step in 1..2000 {
        let angle = f64::from(step) * PI / 2000.0;
        let (a, b) = (DVec3::X, DVec3::new(angle.cos(), angle.sin(), 0.0));
        let k = 1.0 - angle.cos().abs();
        let acute = angle.sin() * (1.0 + f64::from(ltc_angle_excess(k as f32)));
        let expected = if angle > 0.5 * PI { PI - acute } else { acute };
        near(fitted(a, b), expected, 3e-7, &format!("at {angle}"));
    }
}

/// What a BRDF sends into some directions.
struct Cut<F> {
    brdf: Ggx,
    kept: F,
}

impl<F: Fn(DVec3) -> bool + Sync> Brdf for Cut<F> {
    fn evaluate(&self, view: DVec3, light: DVec3) -> f64 {
        if (self.kept)(light) { self.brdf.evaluate(view, light) } else { 0.0 }
    }
    fn sample(&self, view: DVec3, random: DVec2) -> DVec3 {
        self.brdf.sample(view, random)
    }
    fn pdf(&self, view: DVec3, light: DVec3) -> f64 {
        self.brdf.pdf(view, light)
    }
    fn width(&self) -> f64 {
        self.brdf.width()
    }
}

#[test]
fn a_lobe_is_at_no_distance_from_itself() {
    for (roughness, cosine) in [(0.1, 1.0), (0.1, 0.05), (0.5, 0.3), (1.0, 0.7)] {
        let brdf = model(roughness);
        let view = DVec3::new((1.0_f64 - cosine * cosine).sqrt(), 0.0, cosine);
        let own = |light: DVec3| {
            let value = 7.0 * brdf.evaluate(view, light) * light.z;
            [value, value * schlick(view, light)]
        };
        for distance in total_variation(&brdf, cosine, &own, 32) {
            near(distance, 0.0, 1e-12, "itself");
        }
        // A lobe that is cut in two, and its two parts.
        let cut = |forth: bool| move |light: DVec3| (light.x > -0.3) == forth;
        let [front, back] = [true, false].map(|forth| Cut { brdf, kept: cut(forth) });
        let other = |light: DVec3| {
            let value = back.evaluate(view, light) * light.z;
            [value, value * schlick(view, light)]
        };
        for distance in total_variation(&front, cosine, &other, 48) {
            near(distance, 1.0, 1e-12, "apart");
        }
    }
    // cos/π and 1/(2π) differ by ¼·∫|2z − 1|·2 dz = ¼ over the hemisphere.
    let [flat, _] = total_variation(&Lambert, 0.5, &|_| [1.0, 0.0], 200);
    near(flat, 0.25, 1e-3, "flat");
}

#[test]
fn lobes_of_the_table_are_near_the_models() {
    let table = Table::default();
    let [plain, schlick] = lobe_rows("standard", &table_lobes(&table), Effort::Quick);
    println!("{plain:?} {schlick:?}");
    assert!(plain.mean > 0.005 && plain.mean < 0.1, "{plain:?}");
    assert!(plain.maximum >= plain.mean && schlick.maximum >= schlick.mean && schlick.maximum <= 1.0);
    // Another model's lobes are farther away.
    let lambert = |_: f64, _: f64| Box::new(|light: DVec3| [light.z, light.z]) as _;
    assert!(lobe_rows("lambert", &lambert, Effort::Quick)[0].mean > 5.0 * plain.mean);
}

#[test]
fn sweeps_find_a_planted_error() {
    let planted = Sweep {
        function: "planted",
        domain: "1 to 1.001",
        low: 1.0,
        high: 1.001,
        approximate: |x| if x.to_bits() == 0x3F80_0123 { 1.5 } else { f64::from(x) },
        exact: f64::from,
        error: Error::Absolute("absolute"),
    };
    let row = sweep(&planted, 1, &|_| ());
    assert_eq!((row.count, row.exhaustive), (u64::from(1.001_f32.to_bits() - 1.0_f32.to_bits()) + 1, true));
    assert_eq!(row.worst, f64::from(f32::from_bits(0x3F80_0123)));
    near(row.maximum, 1.5 - row.worst, 1e-15, "planted");
    // Not a number is an error too, and the last float is always tried.
    let last = Sweep { approximate: |x| if x == 1.001 { f64::NAN } else { f64::from(x) }, ..planted };
    let row = sweep(&last, 1000, &|_| ());
    assert!(row.maximum.is_infinite() && !row.exhaustive && row.worst == f64::from(1.001_f32), "{row:?}");
}

/// The bounds that the include states.
#[test]
fn approximations_keep_their_bounds() {
    let rows = univariate(Effort::Quick, &|_| ());
    assert_eq!(rows.len(), UNIVARIATE.len());
    for row in rows {
        println!("{row:?}");
        let bound = match row.function.as_str() {
            "ltc_angle_excess" | "ltc_hyperbolic_deficit" => 2e-7,
            "ltc_angle" => 4e-7,
            "ltc_half_turn" => 2.5e-7,
            // Of x / √x, three roundings.
            "ltc_root" | "ltc_anisotropic_root" => 1.8e-7,
            "ltc_outlined" => 1e-3,
            other => panic!("no bound for {other}"),
        };
        assert!(row.maximum < bound && row.count > 500_000, "{row:?}, bound {bound}");
    }
}

#[test]
fn tables_are_read_from_files() {
    let folder = std::env::temp_dir().join(format!("softbox-tables-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        std::fs::write(&path, bytes).expect("a file");
        path
    };
    let numbers = |bytes: &[u8]| -> Vec<f32> {
        bytes.chunks(2).map(|two| half(u16::from_le_bytes([two[0], two[1]]))).collect()
    };
    for (bytes, technique) in
        [(softbox::TABLE_NATIVE, Technique::Include), (softbox::TABLE_COMPATIBLE, Technique::Published)]
    {
        let table = Table::from_bytes(64, bytes).expect("a table");
        let expected = (table, technique);
        let values = numbers(bytes);
        let single: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        let list = |values: &[f32]| values.iter().map(f32::to_string).collect::<Vec<_>>().join(",\n");
        let (first, second) = values.split_at(values.len() / 2);
        let text = format!("var a = [{},\n];\nvar b = [{}];", list(first), list(second));
        for (name, bytes) in [("t.bin", bytes), ("t.raw", &single), ("t.js", text.as_bytes())] {
            let found = read_table(&write(name, bytes)).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert_eq!(found.1, technique, "{name}");
            assert!(found == expected, "{name}");
        }
        #[cfg(feature = "package")]
        {
            let dds = softbox::table::Container::Dds.write(&expected.0).expect("a file");
            let found = read_table(&write("t.dds", &dds)).unwrap_or_else(|error| panic!("{error}"));
            assert!(found == expected, "DDS");
        }
    }
    for (name, bytes) in
        [("t.bin", &b"short"[..]), ("t.js", b"[1, 2]"), ("t.dds", b"DDS "), ("t.js", b"[a],[b]")]
    {
        let error = read_table(&write(name, bytes)).expect_err(name).to_string();
        assert!(error.contains(name) && error.contains("no table"), "{error}");
    }
    assert!(read_table(&folder.join("missing")).is_err());
    std::fs::remove_dir_all(&folder).expect("a folder");
}

/// A finite half-precision number.
fn half(bits: u16) -> f32 {
    let (sign, exponent, mantissa) = (bits >> 15, (bits >> 10) & 31, f32::from(bits & 1023));
    let size = match exponent {
        0 => mantissa * 2.0_f32.powi(-24),
        _ => (1024.0 + mantissa) * 2.0_f32.powi(i32::from(exponent) - 25),
    };
    if sign == 1 { -size } else { size }
}

/// Errors of pictures are those of the comparison, and a wrong table shows.
#[test]
fn pictures_tell_levels_apart() {
    let device = Device::open_any().unwrap_or_else(|error| panic!("{error}"));
    let folder = std::env::temp_dir().join(format!("softbox-pictures-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let scene = Scene::load("scenes/gallery.toml".as_ref()).unwrap_or_else(|error| panic!("{error}"));
    let cheap = Effects::of(&[Effect::Quad, Effect::CheapHorizon]).unwrap_or_else(|error| panic!("{error}"));
    let wrong = Table::from_bytes(64, softbox::TABLE_COMPATIBLE).expect("a table");
    let levels = [
        ("standard", Effects::NONE, Table::default()),
        ("cheap", cheap, Table::default()),
        ("wrong", Effects::NONE, wrong),
    ]
    .map(|(name, effects, table)| PictureLevel { name: name.to_owned(), effects, table });
    let size = [32, 18];
    let rows = pictures(&device, &levels, ("gallery", &scene), size, &folder, 7, &|_| ())
        .unwrap_or_else(|error| panic!("{error}"));
    println!("{rows:#?}");
    let truth = render_truth(&scene, 32, 18, 1, &|_| ());
    for (row, level) in rows.iter().zip(&levels) {
        assert_eq!(
            (row.method.as_str(), row.scene.as_str(), row.origin),
            (level.name.as_str(), "gallery", 7)
        );
        let image = device
            .render_with(&level.table, &scene, scene.effects() | level.effects, size, 1, &|_| ())
            .unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(row.mean, Comparison::new(&image, &truth).mean_error);
        assert!(row.rmse >= row.mean, "{row:?}");
        for file in [&row.picture, &row.difference] {
            let bytes = std::fs::read(folder.join(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
            assert!(bytes.starts_with(b"\x89PNG"), "{file}");
        }
    }
    assert!(rows[0].mean < 0.04 && rows[1].mean < 0.06 && rows[1].mean != rows[0].mean, "{rows:?}");
    assert!(rows[2].mean > 3.0 * rows[0].mean, "{rows:?}");
    std::fs::remove_dir_all(&folder).expect("a folder");
}
