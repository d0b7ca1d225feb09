// The point of a rectangle that is closest to the mirror direction, in place of the whole (Karis 2013, "Real Shading in Unreal
// Engine 4"); diffuse light from the vertices and the centre (Lagarde and de Rousiers 2014, "Moving Frostbite to Physically
// Based Rendering").

/// The solid angle of the triangle of three unit vectors (van Oosterom and Strackee 1983, equation 8).
fn representative_triangle(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> f32 {
    let volume = abs(dot(a, cross(b - a, c - a)));
    return 2.0 * atan2(volume, 1.0 + dot(a, b) + dot(b, c) + dot(c, a));
}

fn representative_root(squared: f32, cosine: f32) -> f32 {
    return sqrt(squared + (1.0 - squared) * cosine * cosine);
}

/// f cos of GGX with height-correlated masking (Heitz 2014, equation 99) for F = 1, and (1 - v.h)^5.
fn representative_ggx(normal: vec3<f32>, view: vec3<f32>, light: vec3<f32>, alpha: f32) -> vec2<f32> {
    let squared = alpha * alpha;
    let cos_view = max(dot(normal, view), 1e-4);
    let cos_light = dot(normal, light);
    let halfway = normalize(view + light);
    // The sine between normal and half vector keeps its digits where the cosine has lost them.
    let across = cross(normal, halfway);
    let along = dot(normal, halfway);
    let divisor = dot(across, across) + squared * along * along;
    let distribution = squared * 0.318309886 / (divisor * divisor);
    let roots = cos_light * representative_root(squared, cos_view) + cos_view * representative_root(squared, cos_light);
    let masking = 0.5 / max(roots, 1e-20);
    let f = max(1.0 - dot(view, halfway), 0.0);
    return vec2<f32>(distribution * masking * cos_light, f * f * f * f * f);
}

fn method_value(position: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, roughness: f32, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>) -> vec3<f32> {
    let from_a = a - position;
    let from_b = b - position;
    let from_c = c - position;
    let from_d = d - position;
    let x = from_b - from_a;
    let y = from_d - from_a;
    let plane = cross(x, y);
    let distance = -dot(plane, from_a);
    if (distance <= 0.0) {
        return vec3<f32>(0.0);
    }
    let unit_a = normalize(from_a);
    let unit_b = normalize(from_b);
    let unit_c = normalize(from_c);
    let unit_d = normalize(from_d);
    let solid_angle = representative_triangle(unit_a, unit_b, unit_c) + representative_triangle(unit_a, unit_c, unit_d);
    let unit_centre = normalize(from_a + from_b + from_c + from_d);
    let cosines = max(dot(normal, unit_a), 0.0) + max(dot(normal, unit_b), 0.0) + max(dot(normal, unit_c), 0.0) + max(dot(normal, unit_d), 0.0) + max(dot(normal, unit_centre), 0.0);
    let diffuse = solid_angle * cosines * (0.2 * 0.318309886);

    let mirror = normal * (2.0 * dot(normal, view)) - view;
    // A ray that leaves the plane meets it at infinity.
    let facing = max(-dot(plane, mirror), 1e-4 * sqrt(dot(plane, plane)));
    let met = mirror * (distance / facing) - from_a;
    let along = clamp(dot(met, x) / dot(x, x), 0.0, 1.0);
    let across = clamp(dot(met, y) / dot(y, y), 0.0, 1.0);
    let light = normalize(from_a + x * along + y * across);
    if (dot(normal, light) <= 0.0) {
        return vec3<f32>(diffuse, 0.0, 0.0);
    }
    let alpha = roughness * roughness;
    // The lobe is as wide as lobe and light together, and as much lower.
    let widened = min(alpha + 0.5 * sqrt(solid_angle * 0.318309886), 1.0);
    let value = representative_ggx(normal, view, light, alpha);
    let specular = value.x * solid_angle * (alpha * alpha) / (widened * widened);
    return vec3<f32>(diffuse, specular, specular * value.y);
}
