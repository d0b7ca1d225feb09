// The shading of render.wgsl by linearly transformed cosines as published (Heitz, Dupuy, Hill and Neubelt 2016): appended to
// ltc.wgsl and render.wgsl, whose own render_shade has another name then. Lights are polygons, each clipped at the horizon of
// each lobe, edge by edge. The table has the published axes and layout. There is no guard but the published ones.

/// Whether the angle of an edge is the arc cosine of the paper, or else the rational function of Hill and Heitz (2016, "Real-Time
/// Area Lighting: a Journey from Research to Production").
override published_arc_cosine: bool = false;

/// The height of the edge integral of two unit vectors over 2 pi.
fn published_edge(a: vec3<f32>, b: vec3<f32>) -> f32 {
    let cosine = dot(a, b);
    if (published_arc_cosine) {
        return normalize(cross(a, b)).z * acos(cosine) * 0.15915494;
    }
    let y = abs(cosine);
    let acute = (0.8638555 + (0.4981491 + 0.0143163 * y) * y) / (3.4554237 + (4.1922505 + y) * y);
    let ratio = select(0.5 * inverseSqrt(max(1.0 - y * y, 1e-7)) - acute, acute, cosine > 0.0);
    return (a.x * b.y - a.y * b.x) * ratio;
}

/// What is left of an outline above the horizon, summed as it is walked.
struct PublishedOutline {
    first: vec3<f32>,
    last: vec3<f32>,
    sum: f32,
    begun: bool,
}

fn published_outline_add(outline: ptr<function, PublishedOutline>, vertex: vec3<f32>) {
    let unit = normalize(vertex);
    if ((*outline).begun) {
        (*outline).sum += published_edge((*outline).last, unit);
    } else {
        (*outline).first = unit;
        (*outline).begun = true;
    }
    (*outline).last = unit;
}

/// The signed form factor of a polygon over the horizon of the space that a matrix leads to.
fn published_polygon(to_lobe: mat3x3<f32>, position: vec3<f32>, light: RenderLight) -> f32 {
    var outline: PublishedOutline;
    var a = to_lobe * (vertices[light.first].xyz - position);
    for (var index = 1u; index <= light.count; index++) {
        let b = to_lobe * (vertices[light.first + index % light.count].xyz - position);
        if (a.z > 0.0) {
            published_outline_add(&outline, a);
        }
        if ((a.z > 0.0) != (b.z > 0.0)) {
            let above = select(b, a, a.z > 0.0);
            let below = select(a, b, a.z > 0.0);
            published_outline_add(&outline, below * above.z - above * below.z);
        }
        a = b;
    }
    if (!outline.begun) {
        return 0.0;
    }
    return -(outline.sum + published_edge(outline.last, outline.first));
}

/// The form factor of a light of one or two sides.
fn published_form_factor(to_lobe: mat3x3<f32>, position: vec3<f32>, light: RenderLight) -> f32 {
    let value = published_polygon(to_lobe, position, light);
    return select(max(value, 0.0), abs(value), (light.flags & RENDER_TWO_SIDED) != 0u);
}

/// Radiance that a surface point reflects of all lights.
fn render_shade(hit: RenderHit, view: vec3<f32>) -> vec3<f32> {
    let object = objects[hit.object];
    let share = clamp(dot(hit.position - object.roughness_start, object.roughness_gradient), 0.0, 1.0);
    let roughness = mix(object.roughness_from, object.roughness_to, share);
    let cosine = clamp(dot(hit.normal, view), 0.0, 1.0);
    let at = vec2<f32>(roughness, sqrt(1.0 - cosine)) * (63.0 / 64.0) + 0.5 / 64.0;
    let shape = textureSampleLevel(table, table_sampler, at, 0, 0.0);
    let amplitude = textureSampleLevel(table, table_sampler, at, 1, 0.0);
    let tangent = normalize(view - hit.normal * dot(hit.normal, view));
    let bitangent = cross(hit.normal, tangent);
    let to_surface = transpose(mat3x3<f32>(tangent, bitangent, hit.normal));
    let inverse_lobe = mat3x3<f32>(vec3<f32>(shape.x, 0.0, shape.y), vec3<f32>(0.0, 1.0, 0.0), vec3<f32>(shape.z, 0.0, shape.w));
    let reflectance = object.f0 * (amplitude.x - amplitude.y) + object.f90 * amplitude.y;
    var sum = vec3<f32>(0.0);
    for (var index = 0u; index < settings.light_count; index++) {
        let light = lights[index];
        let diffuse = published_form_factor(to_surface, hit.position, light);
        let specular = published_form_factor(inverse_lobe * to_surface, hit.position, light);
        sum += light.radiance * (object.base_colour * diffuse + reflectance * specular);
    }
    return sum;
}
