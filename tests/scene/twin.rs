//! Pixels of scenes in f64 by the twin.

use glam::{DVec2, DVec3};
use softbox::light::{self, is_convex_quad};
use softbox::scene::{Hit, Light, Scene};
use softbox::shade::{
    LtcMaterial, LtcReceived, LtcShading, ltc_reflected, ltc_reflected_picture, ltc_shading,
    ltc_shading_disk, ltc_shading_polygon, ltc_shading_quad, ltc_shading_sphere, ltc_shading_tube,
};
use softbox::table::Table;
use softbox::texture::Prefiltered;

/// The scene's pixel in f64 by the twin, or nothing where the ray passes close to an outline: a neighbour within a
/// thousandth of a pixel meets something else, and rounding decides which.
pub fn exact(
    scene: &Scene,
    table: &Table,
    column: u32,
    row: u32,
    [width, height]: [u32; 2],
) -> Option<DVec3> {
    let ray = |x: f64, y: f64| {
        let direction =
            scene.camera.direction(f64::from(column) + 0.5 + x, f64::from(row) + 0.5 + y, width, height);
        (direction, scene.trace(scene.camera.position, direction))
    };
    let (direction, hit) = ray(0.0, 0.0);
    let Hit::Surface { object, position, normal } = hit else {
        return None;
    };
    for (x, y) in [(1e-3, 0.0), (-1e-3, 0.0), (0.0, 1e-3), (0.0, -1e-3)] {
        match ray(x, y).1 {
            Hit::Surface { object: beside, normal: turned, .. }
                if beside == object && normal.dot(turned) > 0.999 => {}
            _ => return None,
        }
    }
    let material = &scene.objects[object].material;
    let effects = if scene.energy_compensation {
        material.effects() | "ggx,energy-compensation".parse().expect("a set")
    } else {
        material.effects()
    };
    let material = material.at(position);
    let shading = ltc_shading::<f64>(position, normal, -direction, &material, table, effects);
    let reflected = |light: &Light| {
        light.radiance
            * match &light.picture {
                Some(picture) => pictured(&shading, &material, &light.shape, picture),
                None => ltc_reflected(&shading, &material, &received(&shading, &light.shape)),
            }
    };
    Some(scene.lights.iter().map(reflected).sum())
}

fn received(shading: &LtcShading<f64>, light: &light::Light) -> LtcReceived<f64> {
    match light {
        light::Light::Polygon { points, two_sided } => {
            let mut points = points.clone();
            if let [_, _, last] = points[..] {
                points.push(last);
            }
            if is_convex_quad(&points) {
                ltc_shading_quad(shading, [points[0], points[1], points[2], points[3]], *two_sided)
            } else {
                ltc_shading_polygon(shading, &points, *two_sided)
            }
        }
        light::Light::Disk { center, half_x, half_y, two_sided } => {
            ltc_shading_disk(shading, *center, *half_x, *half_y, *two_sided)
        }
        light::Light::Sphere { center, radius } => ltc_shading_sphere(shading, *center, *radius),
        light::Light::Tube { start, end, radius, caps } => {
            ltc_shading_tube(shading, *start, *end, *radius, *caps)
        }
    }
}

fn pictured(
    shading: &LtcShading<f64>,
    material: &LtcMaterial<f64>,
    light: &light::Light,
    picture: &Prefiltered,
) -> DVec3 {
    let light::Light::Polygon { points, two_sided } = light else { panic!("a picture on {light:?}") };
    let vertices = [points[0], points[1], points[2], points[3]];
    let texels = DVec2::from(picture.texels());
    ltc_reflected_picture(shading, material, vertices, *two_sided, texels, |place, level| {
        let [red, green, blue, _] = picture.sample(place.into(), level);
        DVec3::new(red, green, blue)
    })
}
