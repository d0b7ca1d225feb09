//! Sheen, rough diffuse surfaces, clear coat and rough metals: their models, their layers, their energy.

#[path = "../common/mod.rs"]
mod common;
mod errors;
mod models;

use common::Random;
use core::f64::consts::{PI, TAU};
use glam::{DVec3, Vec3};
use softbox::brdf::{Brdf, Charlie, Eon};
use softbox::fit::{self, Family, Settings};
use softbox::shade::{
    LTC_ALBEDO_FLOOR, LtcLobe, LtcSurface, Real, Vector, ltc_coat_over, ltc_coat_transmission,
    ltc_energy_compensation, ltc_quad, ltc_reflectance, ltc_rough_diffuse, ltc_sheen_over, ltc_surface,
    ltc_surface_with_roughness, ltc_transform,
};
use softbox::table::{Container, Layer, Table};
use softbox::translate::{self, Target};

fn table() -> Table {
    Table::default().with(&Table::sheen()).with(&Table::diffuse())
}

fn view(cosine: f64) -> DVec3 {
    DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine)
}

/// The midpoint rule over the upper hemisphere, in the fourth root of the height: functions that pile up
/// on the horizon are smooth in it.
fn hemisphere(mut function: impl FnMut(DVec3) -> f64) -> f64 {
    let (heights, azimuths) = (600, 120);
    let mut sum = 0.0;
    for i in 0..heights {
        let root = (f64::from(i) + 0.5) / f64::from(heights);
        let z = root.powi(4);
        let radius = (1.0 - z * z).sqrt();
        for j in 0..azimuths {
            let azimuth = TAU * (f64::from(j) + 0.5) / f64::from(azimuths);
            sum +=
                4.0 * root.powi(3) * function(DVec3::new(radius * azimuth.cos(), radius * azimuth.sin(), z));
        }
    }
    sum * TAU / f64::from(heights * azimuths)
}

fn albedo(model: &dyn Brdf, cosine: f64) -> f64 {
    hemisphere(|light| model.evaluate(view(cosine), light) * light.z)
}

#[test]
fn the_committed_layers_are_what_a_bake_gives() {
    let bake = |family: &dyn Family, settings| Table::pack(&fit::bake(family, settings, &|_| ())).bytes();
    assert!(bake(&fit::sheen, Settings::sheen(64)) == softbox::TABLE_SHEEN, "table/ltc_sheen.bin is stale");
    assert!(
        bake(&fit::diffuse, Settings::diffuse(64)) == softbox::TABLE_DIFFUSE,
        "table/ltc_diffuse.bin is stale"
    );
}

#[test]
fn layers_are_finite_normal_and_make_proper_lobes() {
    for (table, limit) in [(Table::sheen(), 8.0), (Table::diffuse(), 1.1)] {
        let layer = table.layers()[0];
        for row in 0..64 {
            for column in 0..64 {
                let texel = table.texel(0, column, row);
                // Where next to nothing is reflected, the shape of it may be extreme.
                let limit = if texel[3].to_f64() < 1e-3 { 250.0 } else { limit };
                for number in texel {
                    let fine = number == half::f16::ZERO || number.is_normal();
                    assert!(fine && number.to_f64().abs() < limit, "{layer:?} ({column}, {row}): {texel:?}");
                }
                assert!((0.0..=1.0).contains(&texel[3].to_f64()), "{layer:?} ({column}, {row}): {texel:?}");
            }
        }
        let mut random = Random::new(3);
        for _ in 0..20_000 {
            let roughness = random.unit();
            let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, view(random.unit()), roughness);
            let lobe = lobe(&table, layer, &surface);
            let volume = lobe.axis_x.dot(lobe.axis_y.cross(lobe.axis_z));
            assert!(volume > 0.0 && (0.5..=1.0).contains(&lobe.share), "{layer:?}: {lobe:?}");
        }
    }
}

fn lobe<R: Real>(table: &Table, layer: Layer, surface: &LtcSurface<R>) -> LtcLobe<R> {
    match layer {
        Layer::Sheen => table.sheen_lobe(surface),
        Layer::Diffuse => table.diffuse_lobe(surface),
        _ => table.lobe(surface),
    }
}

/// The value of a room of which every wall shines: a box around the surface point.
fn furnace<R: Real>(surface: &LtcSurface<R>, lobe: &LtcLobe<R>) -> R::Vec3 {
    let corner = |x: f64, y: f64, z: f64| {
        let along = |axis: R::Vec3, length: f64| axis * R::new(length);
        along(surface.tangent, x) + along(surface.bitangent, y) + along(surface.normal, z) + surface.position
    };
    let (low, high) = ([-1.3, -0.9, -0.7], [0.8, 1.1, 1.2]);
    let at = |i: usize| {
        let pick = |axis: usize| if i >> axis & 1 == 1 { high[axis] } else { low[axis] };
        corner(pick(0), pick(1), pick(2))
    };
    let walls = [[0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6], [4, 5, 7, 6]];
    let zero = R::Vec3::new(R::new(0.0), R::new(0.0), R::new(0.0));
    walls.iter().fold(zero, |sum, wall| sum + ltc_quad(surface, lobe, wall.map(at), true))
}

/// A surface with a random frame.
fn random_surface(random: &mut Random) -> LtcSurface<f64> {
    let normal = random.direction();
    let eye = (normal + random.direction() * 0.98).normalize();
    let (position, roughness) = (random.direction() * 3.0, random.between(0.1, 1.0));
    ltc_surface::<f64>(position, normal, eye, roughness)
}

#[test]
fn light_from_everywhere_gives_the_albedo() {
    let table = table();
    let mut random = Random::new(17);
    for _ in 0..2000 {
        let surface = random_surface(&mut random);
        for layer in [Layer::Sheen, Layer::Diffuse] {
            let lobe = lobe(&table, layer, &surface);
            let value = furnace(&surface, &lobe);
            assert!(
                (value.x - 1.0).abs() < 1e-9 && (value.y - lobe.albedo).abs() < 1e-7,
                "{layer:?}: {value} is not (1, {}, -) for {surface:?}",
                lobe.albedo
            );
            assert!(lobe.fresnel == 0.0, "{layer:?} has no Schlick part");
        }
    }
}

#[test]
fn albedos_of_the_layers_are_those_of_the_models() {
    let table = table();
    let mut worst = [0.0_f64; 2];
    for roughness in [0.12, 0.2, 0.33, 0.5, 0.71, 1.0] {
        for cosine in [0.02, 0.05, 0.11, 0.3, 0.52, 0.8, 0.97] {
            // Around the cut at 1 and the floor of the roughness the albedo has kinks within a cell.
            let sheen_bound = if roughness < 0.2 { 6e-3 } else { 5e-4 };
            let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, view(cosine), roughness);
            let sheen = albedo(&Charlie::of_roughness(roughness), cosine).min(1.0);
            let diffuse = Eon::single(roughness).single_albedo(cosine);
            for (k, (layer, exact, bound)) in
                [(Layer::Sheen, sheen, sheen_bound), (Layer::Diffuse, diffuse, 5e-4)].into_iter().enumerate()
            {
                let held = lobe(&table, layer, &surface).albedo;
                worst[k] = worst[k].max((held - exact).abs());
                assert!(
                    (held - exact).abs() < bound,
                    "{layer:?}, roughness {roughness}, cosine {cosine}: {held}, and the model has {exact}"
                );
            }
        }
    }
    println!("largest errors of the albedo: sheen {:.1e}, diffuse {:.1e}", worst[0], worst[1]);
}

#[test]
fn no_combination_makes_light_and_white_ones_lose_none() {
    let table = table();
    let mut random = Random::new(23);
    for _ in 0..1000 {
        let surface = random_surface(&mut random);
        let near = |what: &str, value: DVec3, exact: DVec3, tolerance: f64| {
            let fine = (value - exact).abs().max_element() < tolerance;
            assert!(fine, "{what}: {value} is not {exact} for {surface:?}");
        };

        let diffuse = table.diffuse_lobe(&surface);
        let value = furnace(&surface, &diffuse);
        let white = ltc_rough_diffuse(&surface, &diffuse, value, DVec3::ONE);
        near("white rough diffuse", white, DVec3::ONE, 1e-6);
        let colour = DVec3::new(random.unit(), random.unit(), random.unit());
        let tinted = ltc_rough_diffuse(&surface, &diffuse, value, colour);
        // Later bounces deepen the colour and never add to it.
        let exact = |colour: f64| {
            let model = Eon { colour, ..Eon::new(surface.roughness) };
            colour * diffuse.albedo + model.multiple_colour() * (1.0 - diffuse.albedo)
        };
        let exact = DVec3::new(exact(colour.x), exact(colour.y), exact(colour.z));
        near("tinted rough diffuse", tinted, exact, 1e-6);
        assert!(tinted.cmple(colour + 1e-6).all(), "{tinted} is more than {colour}");

        let coated = ltc_surface_with_roughness(&surface, random.between(0.02, 1.0));
        let coat = table.lobe(&coated);
        let (reflectance, weight) = (random.between(0.0, 0.2), random.unit());
        // Schlick's part is that of the whole lobe for a light that covers all of it, and an estimate for
        // each wall of a room: such a light is one value here.
        let whole = DVec3::new(1.0, coat.albedo, coat.fresnel);
        let over = ltc_coat_over(DVec3::ONE, &coat, whole, reflectance, weight);
        near("coat over white", over, DVec3::ONE, 1e-12);
        let room = furnace(&coated, &coat);
        assert!((room.y - coat.albedo).abs() < 1e-6, "{room} and {} for {coated:?}", coat.albedo);
        let dim = ltc_coat_over(colour, &coat, whole, reflectance, weight);
        assert!(dim.max_element() <= 1.0 + 1e-12, "{dim}");
        let none = ltc_coat_over(colour, &coat, whole, reflectance, 0.0);
        near("no coat", none, colour, 1e-15);

        let cloth = ltc_surface_with_roughness(&surface, random.between(0.1, 1.0));
        let sheen = table.sheen_lobe(&cloth);
        let value = furnace(&cloth, &sheen);
        let grey = DVec3::splat(random.unit());
        near("grey sheen over white", ltc_sheen_over(DVec3::ONE, &sheen, value, grey), DVec3::ONE, 1e-6);
        let over = ltc_sheen_over(DVec3::ONE, &sheen, value, colour);
        assert!(over.max_element() <= 1.0 + 1e-6, "{over} under {colour}");

        let metal = table.lobe(&surface);
        let whole = DVec3::new(1.0, metal.albedo, metal.fresnel);
        let compensated =
            |f0: DVec3| ltc_energy_compensation(&metal, f0) * ltc_reflectance::<f64>(whole, f0, DVec3::ONE);
        near("white metal", compensated(DVec3::ONE), DVec3::ONE, 1e-12);
        let metallic = compensated(colour);
        assert!(metallic.max_element() <= 1.0 + 1e-12, "{metallic} for F0 = {colour}");
        assert!(metallic.cmpge(ltc_reflectance::<f64>(whole, colour, DVec3::ONE)).all(), "{metallic}");
    }
}

#[test]
fn energy_compensation_is_finite_and_its_guard_touches_no_entry() {
    let table = Table::default();
    let mut least = f64::INFINITY;
    for index in 0..64 * 64 {
        least = least.min(table.texel(1, index % 64, index / 64)[0].to_f64());
    }
    println!("least albedo of the table: {least}");
    assert!(least > LTC_ALBEDO_FLOOR, "{least}");
    let surface = ltc_surface::<f32>(Vec3::ZERO, Vec3::Z, Vec3::Z, 1.0);
    let black = LtcLobe { albedo: 0.0, ..table.lobe(&surface) };
    let factor = ltc_energy_compensation(&black, Vec3::ONE);
    assert!((factor - Vec3::splat(8.0)).abs().max_element() < 1e-5, "{factor}");
}

/// Mean of |f(v, l) − f(l, v)| over the mean of f, both weighted with the cosines.
fn asymmetry(function: impl Fn(DVec3, DVec3) -> f64) -> f64 {
    let mut random = Random::new(31);
    let (mut difference, mut sum) = (0.0, 0.0);
    for _ in 0..40_000 {
        let mut draw = || {
            let (azimuth, square) = (TAU * random.unit(), random.unit());
            DVec3::new(square.sqrt() * azimuth.cos(), square.sqrt() * azimuth.sin(), (1.0 - square).sqrt())
        };
        let (a, b) = (draw(), draw());
        let (there, back) = (function(a, b), function(b, a));
        difference += (there - back).abs();
        sum += there + back;
    }
    2.0 * difference / sum
}

/// The BRDF that a lobe stands for.
fn lobe_brdf(table: &Table, layer: Layer, roughness: f64, view: DVec3, light: DVec3) -> f64 {
    let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, view, roughness);
    let lobe = lobe(table, layer, &surface);
    let q = ltc_transform(&lobe, light);
    let volume = lobe.axis_x.dot(lobe.axis_y.cross(lobe.axis_z));
    let square = q.length_squared();
    lobe.albedo / lobe.share * volume * q.z.max(0.0) / (PI * square * square) / light.z
}

/// The models are reciprocal to rounding. Lobes are not, since each view has its own; nor is what lies
/// under a layer, since the loss is taken from the view alone.
#[test]
fn reciprocity_is_broken_by_as_much_as_is_known() {
    let table = table();
    for (layer, roughness, low, high) in [
        (Layer::Sheen, 0.3, 0.3, 0.5),
        (Layer::Sheen, 0.5, 0.2, 0.32),
        (Layer::Sheen, 1.0, 0.08, 0.13),
        (Layer::Diffuse, 0.2, 0.01, 0.021),
        (Layer::Diffuse, 0.5, 0.03, 0.046),
        (Layer::Diffuse, 1.0, 0.05, 0.08),
        (Layer::Shape, 0.5, 0.08, 0.125),
    ] {
        let measured = asymmetry(|v, l| lobe_brdf(&table, layer, roughness, v, l));
        println!("asymmetry of {layer:?} at roughness {roughness}: {measured:.4}");
        assert!((low..high).contains(&measured), "{layer:?}, roughness {roughness}: {measured}");
    }
    for (roughness, low, high) in [(0.1, 0.05, 0.09), (0.5, 0.02, 0.03), (1.0, 0.005, 0.009)] {
        let transmission = |view: DVec3| {
            let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, view, roughness);
            ltc_coat_transmission(&table.lobe(&surface), 0.04, 1.0)
        };
        let measured = asymmetry(|v, _| transmission(v));
        println!("asymmetry of a base under a coat of roughness {roughness}: {measured:.4}");
        assert!((low..high).contains(&measured), "coat of roughness {roughness}: {measured}");
    }
    let model = Eon::single(0.5);
    assert!(asymmetry(|v, l| model.evaluate(v, l)) < 1e-12);
}

#[test]
fn the_include_with_these_functions_is_valid_for_every_target() {
    for target in Target::ALL {
        let text = translate::include(target).unwrap_or_else(|error| panic!("{error}"));
        for name in [
            "ltc_sheen_lobe_from_table",
            "ltc_diffuse_lobe_from_table",
            "ltc_sheen_over",
            "ltc_rough_diffuse",
            "ltc_coat_over",
            "ltc_energy_compensation",
        ] {
            assert!(text.contains(name), "{target:?} lacks {name}");
        }
    }
}

#[test]
fn a_table_holds_the_layers_that_it_is_given() {
    let whole = table();
    assert_eq!(whole.layers(), [Layer::Shape, Layer::Amplitude, Layer::Sheen, Layer::Diffuse]);
    assert_eq!((whole.index(Layer::Sheen), whole.index(Layer::Diffuse)), (Some(2), Some(3)));
    let bytes = [softbox::TABLE_NATIVE, softbox::TABLE_SHEEN, softbox::TABLE_DIFFUSE].concat();
    assert!(whole.bytes() == bytes, "layers lie one after the other");
    assert_eq!(Table::from_layers(64, whole.layers(), &bytes), Ok(whole.clone()));
    assert!(Table::from_layers(64, &Layer::BASE, &bytes).is_err());
    assert!(Table::from_layers(64, &[], &[]).is_err());
    // Any subset, in any order.
    let other = Table::default().with(&Table::diffuse());
    assert_eq!((other.index(Layer::Sheen), other.index(Layer::Diffuse)), (None, Some(2)));
    assert_eq!(Table::default().bytes().len(), 2 * 64 * 64 * 8);

    let ktx = Container::Ktx.write(&whole).expect("a KTX file");
    let reader = ktx2::Reader::new(ktx.as_slice()).expect("another reader takes the file");
    assert_eq!(reader.header().layer_count, 4);
    assert!(reader.levels().next().is_some_and(|level| level.data == bytes));
    let dds = Container::Dds.write(&whole).expect("a DDS file");
    assert!(dds.ends_with(&bytes), "the DDS file ends with the texels");
    let text = Container::C.write(&whole).expect("a C header");
    assert!(String::from_utf8_lossy(&text).contains("ltc_table[65536]"));
}

#[test]
#[should_panic(expected = "already")]
fn a_layer_comes_once() {
    let _ = Table::sheen().with(&Table::sheen());
}
