// Linearly transformed cosines as published (Heitz, Dupuy, Hill and Neubelt 2016, "Real-Time Polygonal-Light Shading with
// Linearly Transformed Cosines"): the light is clipped at the horizon of each lobe, after the transformation. The table has
// the published axes and layout.

/// What is left of a quad: 0 or 3 to 5 vertices, the first one repeated behind the last.
struct PublishedPolygon {
    a: vec3<f32>,
    b: vec3<f32>,
    c: vec3<f32>,
    d: vec3<f32>,
    e: vec3<f32>,
    count: u32,
}

/// Where the way from `above` the horizon to `below` it meets it, but for the length.
fn published_cut(above: vec3<f32>, below: vec3<f32>) -> vec3<f32> {
    return below * above.z - above * below.z;
}

fn published_polygon(count: u32, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>, e: vec3<f32>) -> PublishedPolygon {
    return PublishedPolygon(a, b, c, d, e, count);
}

/// The part of a quad above the plane z = 0, one of sixteen cases by which vertices are above; opposite vertices alone
/// cannot be.
fn published_clip(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>) -> PublishedPolygon {
    var above = select(0u, 1u, a.z > 0.0);
    above += select(0u, 2u, b.z > 0.0);
    above += select(0u, 4u, c.z > 0.0);
    above += select(0u, 8u, d.z > 0.0);
    switch (above) {
        case 1u: {
            return published_polygon(3u, a, published_cut(a, b), published_cut(a, d), a, a);
        }
        case 2u: {
            return published_polygon(3u, b, published_cut(b, c), published_cut(b, a), b, b);
        }
        case 3u: {
            return published_polygon(4u, a, b, published_cut(b, c), published_cut(a, d), a);
        }
        case 4u: {
            return published_polygon(3u, c, published_cut(c, d), published_cut(c, b), c, c);
        }
        case 6u: {
            return published_polygon(4u, b, c, published_cut(c, d), published_cut(b, a), b);
        }
        case 7u: {
            return published_polygon(5u, a, b, c, published_cut(c, d), published_cut(a, d));
        }
        case 8u: {
            return published_polygon(3u, d, published_cut(d, a), published_cut(d, c), d, d);
        }
        case 9u: {
            return published_polygon(4u, d, a, published_cut(a, b), published_cut(d, c), d);
        }
        case 11u: {
            return published_polygon(5u, d, a, b, published_cut(b, c), published_cut(d, c));
        }
        case 12u: {
            return published_polygon(4u, c, d, published_cut(d, a), published_cut(c, b), c);
        }
        case 13u: {
            return published_polygon(5u, c, d, a, published_cut(a, b), published_cut(c, b));
        }
        case 14u: {
            return published_polygon(5u, b, c, d, published_cut(d, a), published_cut(b, a));
        }
        case 15u: {
            return published_polygon(4u, a, b, c, d, a);
        }
        default: {
            return PublishedPolygon();
        }
    }
}

/// The height of the edge integral over 2 pi of two unit vectors. The ratio of the angle to its sine is a rational function of
/// the cosine (Hill and Heitz 2016, "Real-Time Area Lighting: a Journey from Research to Production"), fitted by
/// `fit_published_angle` in src/fit/published.rs.
fn published_edge(a: vec3<f32>, b: vec3<f32>) -> f32 {
    let cosine = dot(a, b);
    let y = abs(cosine);
    let acute = (0.8638555 + (0.4981491 + 0.0143163 * y) * y) / (3.4554237 + (4.1922505 + y) * y);
    // An angle and its supplement have the same sine; the sum of both ratios is pi over it.
    let ratio = select(0.5 * inverseSqrt(max(1.0 - y * y, 1e-7)) - acute, acute, cosine > 0.0);
    return (a.x * b.y - a.y * b.x) * ratio;
}

/// The form factor over the horizon of the space that a matrix leads to, of a quad from the surface point.
fn published_form_factor(to_lobe: mat3x3<f32>, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>) -> f32 {
    let polygon = published_clip(to_lobe * a, to_lobe * b, to_lobe * c, to_lobe * d);
    if (polygon.count == 0u) {
        return 0.0;
    }
    let unit_a = normalize(polygon.a);
    let unit_b = normalize(polygon.b);
    let unit_c = normalize(polygon.c);
    let unit_d = normalize(polygon.d);
    let unit_e = normalize(polygon.e);
    var sum = published_edge(unit_a, unit_b) + published_edge(unit_b, unit_c) + published_edge(unit_c, unit_d);
    if (polygon.count > 3u) {
        sum += published_edge(unit_d, unit_e);
    }
    if (polygon.count > 4u) {
        sum += published_edge(unit_e, unit_a);
    }
    return max(-sum, 0.0);
}

fn method_value(position: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, roughness: f32, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>) -> vec3<f32> {
    let cosine = clamp(dot(normal, view), 0.0, 1.0);
    let at = vec2<f32>(roughness, sqrt(1.0 - cosine)) * (63.0 / 64.0) + 0.5 / 64.0;
    let shape = textureSampleLevel(table, table_sampler, at, 0, 0.0);
    let amplitude = textureSampleLevel(table, table_sampler, at, 1, 0.0);
    let aside = view - normal * dot(normal, view);
    let tangent = aside * inverseSqrt(max(dot(aside, aside), 1e-12));
    let bitangent = cross(normal, tangent);
    let to_surface = transpose(mat3x3<f32>(tangent, bitangent, normal));
    let inverse_lobe = mat3x3<f32>(vec3<f32>(shape.x, 0.0, shape.y), vec3<f32>(0.0, 1.0, 0.0), vec3<f32>(shape.z, 0.0, shape.w));
    let from_a = a - position;
    let from_b = b - position;
    let from_c = c - position;
    let from_d = d - position;
    let diffuse = published_form_factor(to_surface, from_a, from_b, from_c, from_d);
    let specular = published_form_factor(inverse_lobe * to_surface, from_a, from_b, from_c, from_d);
    return vec3<f32>(diffuse, amplitude.x * specular, amplitude.y * specular);
}
