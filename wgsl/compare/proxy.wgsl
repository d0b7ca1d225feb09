// Linearly transformed cosines with a sphere in place of the light at the horizon (Hill and Heitz 2016, "Real-Time Area
// Lighting: a Journey from Research to Production"). The table has the published axes and layout; the fourth number of its
// second layer is the part of a sphere above the horizon.

/// The edge integral over 2 pi of two unit vectors. The ratio of the angle to its sine is a rational function of the cosine,
/// fitted by `fit_published_angle` in src/fit/published.rs.
fn proxy_edge(a: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
    let cosine = dot(a, b);
    let y = abs(cosine);
    let acute = (0.8638555 + (0.4981491 + 0.0143163 * y) * y) / (3.4554237 + (4.1922505 + y) * y);
    // An angle and its supplement have the same sine; the sum of both ratios is pi over it.
    let ratio = select(0.5 * inverseSqrt(max(1.0 - y * y, 1e-7)) - acute, acute, cosine > 0.0);
    return cross(a, b) * ratio;
}

/// The form factor over the horizon of the sphere that has the vector form factor of the whole quad (Snyder 1996, "Area Light
/// Sources for Real-Time Graphics").
fn proxy_form_factor(to_lobe: mat3x3<f32>, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>) -> f32 {
    let unit_a = normalize(to_lobe * a);
    let unit_b = normalize(to_lobe * b);
    let unit_c = normalize(to_lobe * c);
    let unit_d = normalize(to_lobe * d);
    let sum = proxy_edge(unit_a, unit_b) + proxy_edge(unit_b, unit_c) + proxy_edge(unit_c, unit_d) + proxy_edge(unit_d, unit_a);
    let whole = sqrt(max(dot(sum, sum), 1e-30));
    let at = vec2<f32>(0.5 - 0.5 * sum.z / whole, whole) * (63.0 / 64.0) + 0.5 / 64.0;
    return whole * textureSampleLevel(table, table_sampler, at, 1, 0.0).w;
}

fn method_value(position: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, roughness: f32, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>) -> vec3<f32> {
    let from_a = a - position;
    let from_b = b - position;
    let from_c = c - position;
    let from_d = d - position;
    if (dot(cross(b - a, d - a), from_a) >= 0.0) {
        return vec3<f32>(0.0);
    }
    let cosine = clamp(dot(normal, view), 0.0, 1.0);
    let at = vec2<f32>(roughness, sqrt(1.0 - cosine)) * (63.0 / 64.0) + 0.5 / 64.0;
    let shape = textureSampleLevel(table, table_sampler, at, 0, 0.0);
    let amplitude = textureSampleLevel(table, table_sampler, at, 1, 0.0);
    let aside = view - normal * dot(normal, view);
    let tangent = aside * inverseSqrt(max(dot(aside, aside), 1e-12));
    let bitangent = cross(normal, tangent);
    let to_surface = transpose(mat3x3<f32>(tangent, bitangent, normal));
    let inverse_lobe = mat3x3<f32>(vec3<f32>(shape.x, 0.0, shape.y), vec3<f32>(0.0, 1.0, 0.0), vec3<f32>(shape.z, 0.0, shape.w));
    let diffuse = proxy_form_factor(to_surface, from_a, from_b, from_c, from_d);
    let specular = proxy_form_factor(inverse_lobe * to_surface, from_a, from_b, from_c, from_d);
    return vec3<f32>(diffuse, amplitude.x * specular, amplitude.y * specular);
}
