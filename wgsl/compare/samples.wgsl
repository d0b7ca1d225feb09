// Monte Carlo integration over a parallelogram, weighted by the balance heuristic (Veach and Guibas 1995, "Optimally Combining
// Sampling Techniques for Monte Carlo Rendering"). Goes behind the constants of a variant:
//   SAMPLES_COUNT    how many directions;
//   SAMPLES_LIGHT    share of directions to uniformly distributed points of the light;
//   SAMPLES_VISIBLE  share of directions reflected by visible normals;
//   SAMPLES_COSINE   share of directions distributed as the cosine.

/// A hash of three numbers to three numbers (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", pcg3d).
fn samples_hash(key: vec3<u32>) -> vec3<u32> {
    var v = key * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3<u32>(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

/// Two axes across a unit vector (Duff et al. 2017, "Building an Orthonormal Basis, Revisited"), and the vector.
fn samples_basis(n: vec3<f32>) -> mat3x3<f32> {
    let side = select(-1.0, 1.0, n.z >= 0.0);
    let p = -1.0 / (side + n.z);
    let q = n.x * n.y * p;
    return mat3x3<f32>(vec3<f32>(1.0 + side * n.x * n.x * p, side * q, -side * n.x), vec3<f32>(q, side + n.y * n.y * p, -n.y), n);
}

/// A direction above the surface with the density of its cosine.
fn samples_lambertian(u: f32, v: f32) -> vec3<f32> {
    let radius = sqrt(u);
    return vec3<f32>(radius * cos(6.283185307 * v), radius * sin(6.283185307 * v), sqrt(max(1.0 - u, 0.0)));
}

/// The view reflected by a normal that it sees (Heitz 2018, "Sampling the GGX Distribution of Visible Normals").
fn samples_reflected(view: vec3<f32>, alpha: f32, u: f32, v: f32) -> vec3<f32> {
    let stretched = normalize(vec3<f32>(alpha * view.x, alpha * view.y, view.z));
    // The projected hemisphere as the stretched view sees it: a half disk and a foreshortened one.
    let radius = sqrt(u);
    let x = radius * cos(6.283185307 * v);
    let whole = radius * sin(6.283185307 * v);
    // The disk's second axis leans towards the normal.
    let flatness = stretched.x * stretched.x + stretched.y * stretched.y;
    let reciprocal = inverseSqrt(max(flatness, 1e-20));
    let x_axis = select(vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(-stretched.y * reciprocal, stretched.x * reciprocal, 0.0), flatness > 1e-12);
    let y_axis = cross(stretched, x_axis);
    let share = 0.5 * (1.0 + stretched.z);
    let y = (1.0 - share) * sqrt(max(1.0 - x * x, 0.0)) + share * whole;
    let z = sqrt(max(1.0 - x * x - y * y, 0.0));
    let visible = x_axis * x + y_axis * y + stretched * z;
    let halfway = normalize(vec3<f32>(alpha * visible.x, alpha * visible.y, max(visible.z, 0.0)));
    return halfway * (2.0 * dot(view, halfway)) - view;
}

fn samples_root(squared: f32, cosine: f32) -> f32 {
    return sqrt(squared + (1.0 - squared) * cosine * cosine);
}

/// f cos of GGX with height-correlated masking (Heitz 2014, equation 99) for F = 1, (1 - v.h)^5, and the density of visible
/// normals turned into that of reflected directions (Heitz 2018, equation 3).
fn samples_ggx(normal: vec3<f32>, view: vec3<f32>, light: vec3<f32>, alpha: f32) -> vec3<f32> {
    let squared = alpha * alpha;
    let cos_view = max(dot(normal, view), 1e-4);
    let cos_light = dot(normal, light);
    let root_view = samples_root(squared, cos_view);
    let halfway = normalize(view + light);
    // The sine between normal and half vector keeps its digits where the cosine has lost them.
    let across = cross(normal, halfway);
    let along = dot(normal, halfway);
    let divisor = dot(across, across) + squared * along * along;
    let distribution = squared * 0.318309886 / (divisor * divisor);
    let masking = 0.5 / max(cos_light * root_view + cos_view * samples_root(squared, cos_light), 1e-20);
    let f = max(1.0 - dot(view, halfway), 0.0);
    return vec3<f32>(distribution * masking * cos_light, f * f * f * f * f, distribution / (2.0 * (cos_view + root_view)));
}

fn method_value(position: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, roughness: f32, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>) -> vec3<f32> {
    let from_a = a - position;
    let x = b - a;
    let y = d - a;
    let plane = cross(x, y);
    let distance = -dot(plane, from_a);
    if (distance <= 0.0) {
        return vec3<f32>(0.0);
    }
    let alpha = max(roughness * roughness, 1e-3);
    let inverse_square = 1.0 / dot(plane, plane);
    let frame = samples_basis(normal);
    let local_view = view * frame;
    let surface_key = samples_hash(bitcast<vec3<u32>>(position) ^ samples_hash(bitcast<vec3<u32>>(view) ^ vec3<u32>(bitcast<u32>(roughness))));
    let seed = samples_hash(surface_key ^ samples_hash(bitcast<vec3<u32>>(a) ^ samples_hash(bitcast<vec3<u32>>(b))));
    // The third of a direction's numbers serves nothing else.
    let first = samples_hash(seed).z >> 31u;
    var sum = vec3<f32>(0.0);
    for (var i = 0u; i < SAMPLES_COUNT; i++) {
        let random = vec2<f32>(samples_hash(vec3<u32>(seed.x + i, seed.y, seed.z)).xy >> vec2<u32>(8u)) * (1.0 / 16777216.0);
        let odd = ((i + first) & 1u) == 1u;
        let aimed = (SAMPLES_LIGHT > 0.0) & !(odd & (SAMPLES_VISIBLE > 0.0));
        var light: vec3<f32>;
        if (aimed) {
            light = normalize(from_a + x * random.x + y * random.y);
        } else if (odd) {
            light = frame * samples_reflected(local_view, alpha, random.x, random.y);
        } else {
            light = frame * samples_lambertian(random.x, random.y);
        }
        // Where the ray meets the light's plane.
        let facing = -dot(plane, light);
        let cosine = dot(normal, light);
        if ((facing > 0.0) & (cosine > 0.0)) {
            let reach = distance / facing;
            let met = light * reach - from_a;
            let along = dot(cross(met, y), plane) * inverse_square;
            let across = dot(cross(x, met), plane) * inverse_square;
            let within = (along >= 0.0) & (along <= 1.0) & (across >= 0.0) & (across <= 1.0);
            if (aimed | within) {
                let value = samples_ggx(normal, view, light, alpha);
                let density = SAMPLES_LIGHT * (reach * reach / facing) + SAMPLES_VISIBLE * value.z + SAMPLES_COSINE * (cosine * 0.318309886);
                sum += vec3<f32>(cosine * 0.318309886, value.x, value.x * value.y) * (1.0 / max(density, 1e-30));
            }
        }
    }
    return sum * (1.0 / f32(SAMPLES_COUNT));
}
