//! Lights and surfaces from the API, of any numbers.

use std::sync::LazyLock;

use glam::{DVec3, Vec3};
use softbox::effects::{Effects, Quality};
use softbox::light::{Light, is_convex_quad, light_value_with, polygon_normal};
use softbox::shade::{
    LobeSum, LtcMaterial, Real, Vector, ltc_material, ltc_reflected, ltc_shading, ltc_shading_disk,
    ltc_shading_polygon, ltc_shading_quad, ltc_shading_sphere, ltc_shading_tube, ltc_surface,
};
use softbox::table::{AnisotropicTable, Table};

use super::assert_sentence;
use super::bytes::Bytes;

static TABLE: LazyLock<Table> = LazyLock::new(|| {
    let layers: Vec<_> = levels().flat_map(|effects| effects.layers()).collect();
    Table::default()
        .with(&Table::sheen())
        .with(&Table::diffuse())
        .with(AnisotropicTable::default().layers())
        .completed(&layers)
});

/// What is on by default at each quality level.
static LEVELS: LazyLock<Vec<Effects>> = LazyLock::new(|| {
    let standing = Effects::standing();
    Quality::ALL.into_iter().map(|level| level.of(standing)).collect()
});

fn levels() -> impl Iterator<Item = Effects> {
    LEVELS.iter().copied()
}

/// A light of any numbers.
fn any_light(bytes: &mut Bytes) -> Light {
    let kind = bytes.byte();
    let flag = kind & 1 != 0;
    match kind / 2 % 5 {
        0 => {
            let count = usize::from(bytes.byte() % 8);
            Light::Polygon { points: (0..count).map(|_| bytes.vector()).collect(), two_sided: flag }
        }
        // Planar ones, which random points hardly ever are.
        1 => {
            let (corner, x, y) = (bytes.vector(), bytes.vector(), bytes.vector());
            Light::Polygon { points: vec![corner, corner + x, corner + x + y, corner + y], two_sided: flag }
        }
        2 => Light::Disk {
            center: bytes.vector(),
            half_x: bytes.vector(),
            half_y: bytes.vector(),
            two_sided: flag,
        },
        3 => Light::Sphere { center: bytes.vector(), radius: bytes.double() },
        _ => Light::Tube { start: bytes.vector(), end: bytes.vector(), radius: bytes.double(), caps: flag },
    }
}

/// Asserts what is to be known of a light that [`Light::check`] lets through: its bounds, its area, its range.
pub fn assert_light_is_described(light: &Light) {
    let (center, radius) = light.bounds();
    assert!(center.is_finite() && radius.is_finite() && radius >= 0.0, "{center} {radius}: {light:?}");
    let area = light.largest_projected_area();
    assert!(area >= 0.0, "{area}: {light:?}");
    let mut nearer = f64::INFINITY;
    for threshold in [0.0, 1e-300, 1e-6, 0.5, 1.0, 2.0, f64::INFINITY] {
        let range = light.range(1.0, threshold, 10.0);
        assert!((0.0..=nearer).contains(&range), "{range} at {threshold}: {light:?}");
        nearer = range;
    }
    let _ = light.effects();
}

/// Whether the include promises something: coordinates are finite in single precision, directions have a length, a radius is
/// positive, and there is a vertex.
fn is_in_domain([position, normal, view]: [DVec3; 3], roughness: f64, light: &Light) -> bool {
    let single = |v: DVec3| v.as_vec3().is_finite();
    let directed = |v: DVec3| single(v) && v.as_vec3() != Vec3::ZERO;
    let radius = |radius: f64| radius as f32 > 0.0 && (radius as f32).is_finite();
    let light = match light {
        Light::Polygon { points, .. } => !points.is_empty() && points.iter().all(|point| single(*point)),
        Light::Disk { center, half_x, half_y, .. } => [*center, *half_x, *half_y].into_iter().all(single),
        Light::Sphere { center, radius: r } => single(*center) && radius(*r),
        Light::Tube { start, end, radius: r, .. } => single(*start) && single(*end) && radius(*r),
    };
    light && single(position) && directed(normal) && directed(view) && (0.0..=1.0).contains(&roughness)
}

/// Asserts that the twin in single precision makes physical values, at every quality level.
pub fn assert_twin_is_physical(surface: [DVec3; 3], roughness: f64, light: &Light) {
    for effects in levels() {
        let [value, albedo] = twin::<f32>(surface, roughness, light, effects);
        let albedo = albedo[1] * (1.0 + 1e-5);
        let physical = (0.0..=1.0).contains(&value[0])
            && (0.0..=albedo).contains(&value[1])
            && (0.0..=value[1] * (1.0 + 1e-6)).contains(&value[2]);
        assert!(
            physical,
            "{value:?} of an albedo of {albedo} with {effects}: {surface:?} {roughness} {light:?}"
        );
    }
}

/// The value of a light, and in the middle of the second triple the albedo.
fn twin<R: Real>(
    [position, normal, view]: [DVec3; 3],
    roughness: f64,
    light: &Light,
    effects: Effects,
) -> [[f64; 3]; 2] {
    let v = |v: DVec3| R::Vec3::new(R::new(v.x), R::new(v.y), R::new(v.z));
    let surface = ltc_surface::<R>(v(position), v(normal), v(view), R::new(roughness));
    let lobes = TABLE.specular(&surface, effects);
    let value = light_value_with(&surface, &lobes, light, effects);
    let albedo: f64 = lobes.lobes().iter().map(|lobe| lobe.albedo.to_f64()).sum();
    [[value.x(), value.y(), value.z()].map(Real::to_f64), [0.0, albedo, 0.0]]
}

/// A surface and a light of any numbers: physical values where the include promises them, and an end everywhere.
pub fn light(data: &[u8]) {
    let mut bytes = Bytes(data);
    let light = any_light(&mut bytes);
    match light.check() {
        Ok(()) => assert_light_is_described(&light),
        Err(error) => assert_sentence(&error),
    }
    if let Light::Polygon { points, .. } = &light {
        let _ = is_convex_quad(points);
        let _ = polygon_normal(points);
    }
    let _ = (light.bounds(), light.largest_projected_area(), light.effects());
    let range = light.range(bytes.double(), bytes.double(), bytes.double());
    assert!(range >= 0.0, "{range}: {light:?}");
    for _ in 0..4 {
        if bytes.is_empty() {
            break;
        }
        let surface = [bytes.vector(), bytes.vector(), bytes.vector()];
        let roughness = bytes.double();
        for effects in levels() {
            let _ = twin::<f32>(surface, roughness, &light, effects);
            let _ = twin::<f64>(surface, roughness, &light, effects);
        }
        if is_in_domain(surface, roughness, &light) {
            assert_twin_is_physical(surface, roughness, &light);
        }
    }
}

/// A whole surface under a light, of any numbers: finite radiance for a material whose numbers are in their ranges.
pub fn surface(data: &[u8]) {
    let mut bytes = Bytes(data);
    let light = any_light(&mut bytes);
    // The function that takes vertices one by one asks for the first.
    if matches!(&light, Light::Polygon { points, .. } if points.is_empty()) {
        return;
    }
    let at = [bytes.vector(), bytes.vector(), bytes.vector()];
    let roughness = bytes.double();
    let mut numbers = [0.0_f32; 19];
    numbers.fill_with(|| bytes.single());
    let colour = |at: usize| Vec3::from_slice(&numbers[at..at + 3]);
    let material = LtcMaterial {
        diffuse_roughness: numbers[9],
        coat: numbers[10],
        coat_roughness: numbers[11],
        coat_reflectance: numbers[12],
        sheen_colour: colour(6),
        sheen_roughness: numbers[13],
        anisotropy: numbers[14],
        grain: colour(15),
        ..ltc_material::<f32>(colour(0), roughness as f32, colour(3))
    };
    let shares = numbers[..15].iter().all(|number| (0.0..=1.0).contains(number));
    let promised = shares && material.grain.is_finite() && is_in_domain(at, roughness, &light);
    for effects in levels() {
        let [position, normal, view] = at.map(|v| v.as_vec3());
        let shading = ltc_shading(position, normal, view, &material, &TABLE, effects);
        let received = match &light {
            Light::Polygon { points, two_sided } if points.len() == 4 && is_convex_quad(points) => {
                ltc_shading_quad(&shading, core::array::from_fn(|i| points[i].as_vec3()), *two_sided)
            }
            Light::Polygon { points, two_sided } => {
                let points: Vec<Vec3> = points.iter().map(|point| point.as_vec3()).collect();
                ltc_shading_polygon(&shading, &points, *two_sided)
            }
            Light::Disk { center, half_x, half_y, two_sided } => {
                ltc_shading_disk(&shading, center.as_vec3(), half_x.as_vec3(), half_y.as_vec3(), *two_sided)
            }
            Light::Sphere { center, radius } => {
                ltc_shading_sphere(&shading, center.as_vec3(), *radius as f32)
            }
            Light::Tube { start, end, radius, caps } => {
                ltc_shading_tube(&shading, start.as_vec3(), end.as_vec3(), *radius as f32, *caps)
            }
        };
        let reflected = ltc_reflected(&shading, &material, &received);
        assert!(
            !promised || (reflected.is_finite() && reflected.min_element() >= 0.0),
            "{reflected} with {effects}: {at:?} {material:?} {light:?}"
        );
    }
}
