// Draws a scene, each pixel's radiance into a storage buffer. Appended to ltc.wgsl.
//
// One invocation draws one pixel of a band of rows; dispatch (number of pixels + 63) / 64 workgroups.
// Light falls directly from each light on each surface: nothing casts a shadow. The include's overrides and
// render_pictures decide what is compiled.

/// Number of pictures that lights show, 0 to 4; the other bindings hold nothing of use.
override render_pictures: u32 = 4u;

/// Camera, picture and counts.
struct RenderSettings {
    position: vec3<f32>,
    /// Pixels in a row.
    width: u32,
    forward: vec3<f32>,
    /// Rows of the whole picture.
    height: u32,
    /// To the right edge of a picture as wide as high, at distance 1.
    right: vec3<f32>,
    /// First row of the band.
    row: u32,
    /// To the upper edge of the picture, at distance 1.
    up: vec3<f32>,
    /// Rows of the band.
    rows: u32,
    background: vec3<f32>,
    object_count: u32,
    light_count: u32,
    sample_count: u32,
    /// Layers of the table, see LtcLayers.
    sheen_layer: i32,
    diffuse_layer: i32,
    anisotropic_layer: i32,
    lobes_layer: i32,
    spare_a: u32,
    spare_b: u32,
}

/// A surface and its material.
struct RenderObject {
    centre: vec3<f32>,
    /// RENDER_PLANE, RENDER_BOX or RENDER_SPHERE.
    kind: u32,
    /// Unit vectors: along the sides of a rectangle, then its normal, or along the edges of a box.
    axis_x: vec3<f32>,
    /// Half the length along axis_x, or the radius of a sphere.
    extent_x: f32,
    axis_y: vec3<f32>,
    extent_y: f32,
    axis_z: vec3<f32>,
    extent_z: f32,
    base_colour: vec3<f32>,
    roughness_from: f32,
    f0: vec3<f32>,
    roughness_to: f32,
    f90: vec3<f32>,
    diffuse_roughness: f32,
    roughness_start: vec3<f32>,
    coat: f32,
    /// Change of the share of roughness_to per unit of length.
    roughness_gradient: vec3<f32>,
    coat_roughness: f32,
    sheen_colour: vec3<f32>,
    sheen_roughness: f32,
    grain: vec3<f32>,
    anisotropy: f32,
    coat_reflectance: f32,
    spare_a: f32,
    spare_b: f32,
    spare_c: f32,
}

/// A light: `count` vectors from `first` on.
struct RenderLight {
    radiance: vec3<f32>,
    /// Number of the picture that it shows, from 1; 0 for none.
    picture: u32,
    /// Unit normal of the emitting side of a polygon or disk.
    normal: vec3<f32>,
    spare_b: u32,
    first: u32,
    count: u32,
    /// Sum of RENDER_TWO_SIDED, RENDER_CONVEX_QUAD and RENDER_CAPS, where they apply.
    flags: u32,
    /// RENDER_POLYGON, RENDER_DISK, RENDER_SPHERE_LIGHT or RENDER_TUBE.
    kind: u32,
}

/// What a ray meets first.
struct RenderHit {
    position: vec3<f32>,
    /// Along the ray.
    distance: f32,
    normal: vec3<f32>,
    /// Index of the object.
    object: u32,
}

const RENDER_PLANE: u32 = 0u;
const RENDER_BOX: u32 = 1u;
const RENDER_TWO_SIDED: u32 = 1u;
/// The light has four vertices and is convex.
const RENDER_CONVEX_QUAD: u32 = 2u;
const RENDER_CAPS: u32 = 4u;
/// A light's vectors are its vertices.
const RENDER_POLYGON: u32 = 0u;
/// They are its centre and its half-axes.
const RENDER_DISK: u32 = 1u;
/// They are its centre, with the radius.
const RENDER_SPHERE_LIGHT: u32 = 2u;
/// They are its ends, the first with the radius.
const RENDER_TUBE: u32 = 3u;
/// Farther than any surface.
const RENDER_FAR: f32 = 1e30;

@group(0) @binding(0) var<storage, read> settings: RenderSettings;
@group(0) @binding(1) var<storage, read> objects: array<RenderObject>;
@group(0) @binding(2) var<storage, read> lights: array<RenderLight>;
@group(0) @binding(3) var<storage, read> vertices: array<vec4<f32>>;
/// Where in a pixel to sample it, 0 to 1.
@group(0) @binding(4) var<storage, read> samples: array<vec2<f32>>;
/// Radiance of each pixel of the band, and 1.
@group(0) @binding(5) var<storage, read_write> pixels: array<vec4<f32>>;
@group(0) @binding(6) var table: texture_2d_array<f32>;
@group(0) @binding(7) var table_sampler: sampler;
@group(0) @binding(8) var first_picture: texture_2d<f32>;
@group(0) @binding(9) var second_picture: texture_2d<f32>;
@group(0) @binding(10) var third_picture: texture_2d<f32>;
@group(0) @binding(11) var fourth_picture: texture_2d<f32>;
@group(0) @binding(12) var picture_sampler: sampler;

fn render_keep_sign(value: f32) -> f32 {
    return select(value, select(-1e-20, 1e-20, value >= 0.0), abs(value) < 1e-20);
}

/// The first hit with an object in front of `origin`; its distance is RENDER_FAR if there is none. The
/// position is put back onto the surface, so that its distance from a light that touches it is exact.
fn render_meet(object: RenderObject, origin: vec3<f32>, direction: vec3<f32>) -> RenderHit {
    var hit: RenderHit;
    hit.distance = RENDER_FAR;
    let offset = origin - object.centre;
    if (object.kind == RENDER_PLANE) {
        let distance = -dot(offset, object.axis_z) / render_keep_sign(dot(direction, object.axis_z));
        let place = offset + direction * distance;
        let across = dot(place, object.axis_x);
        let along = dot(place, object.axis_y);
        if (distance > 0.0 && distance < RENDER_FAR && abs(across) <= object.extent_x && abs(along) <= object.extent_y) {
            hit.distance = distance;
            hit.position = object.centre + object.axis_x * across + object.axis_y * along;
            hit.normal = object.axis_z;
        }
        return hit;
    }
    if (object.kind == RENDER_BOX) {
        let start = vec3<f32>(dot(offset, object.axis_x), dot(offset, object.axis_y), dot(offset, object.axis_z));
        let along = vec3<f32>(dot(direction, object.axis_x), dot(direction, object.axis_y), dot(direction, object.axis_z));
        let inverse = 1.0 / vec3<f32>(render_keep_sign(along.x), render_keep_sign(along.y), render_keep_sign(along.z));
        let extent = vec3<f32>(object.extent_x, object.extent_y, object.extent_z);
        let one = (-extent - start) * inverse;
        let other = (extent - start) * inverse;
        let low = min(one, other);
        let high = max(one, other);
        let enter = max(max(low.x, low.y), low.z);
        let leave = min(min(high.x, high.y), high.z);
        if (enter > leave || leave <= 0.0) {
            return hit;
        }
        let outside = enter > 0.0;
        let distance = select(leave, enter, outside);
        let times = select(high, low, outside);
        let on_x = times.x == distance;
        let on_y = !on_x && times.y == distance;
        let face = vec3<f32>(select(0.0, 1.0, on_x), select(0.0, 1.0, on_y), select(1.0, 0.0, on_x || on_y));
        let place = start + along * distance;
        let side = select(vec3<f32>(-1.0), vec3<f32>(1.0), place >= vec3<f32>(0.0));
        let local = mix(place, side * extent, face);
        let normal = side * face;
        hit.distance = distance;
        hit.position = object.centre + object.axis_x * local.x + object.axis_y * local.y + object.axis_z * local.z;
        hit.normal = object.axis_x * normal.x + object.axis_y * normal.y + object.axis_z * normal.z;
        return hit;
    }
    let half = -dot(offset, direction);
    // From the point of the ray next to the centre: the usual discriminant cancels for distant spheres.
    let aside = offset + direction * half;
    let depth_squared = object.extent_x * object.extent_x - dot(aside, aside);
    if (depth_squared < 0.0) {
        return hit;
    }
    let depth = sqrt(max(depth_squared, 1e-30));
    let distance = select(half + depth, half - depth, half > depth);
    if (distance > 0.0) {
        hit.distance = distance;
        hit.normal = ltc_direction(offset + direction * distance);
        hit.position = object.centre + hit.normal * object.extent_x;
    }
    return hit;
}

/// Distance at which the ray first meets a sphere from outside, or RENDER_FAR.
fn render_meet_sphere(centre: vec3<f32>, radius: f32, origin: vec3<f32>, direction: vec3<f32>) -> f32 {
    let half = dot(centre - origin, direction);
    let aside = origin - centre + direction * half;
    let depth_squared = radius * radius - dot(aside, aside);
    let distance = half - sqrt(max(depth_squared, 1e-30));
    return select(RENDER_FAR, distance, depth_squared >= 0.0 && distance > 0.0);
}

/// Distance at which the ray first meets an open cylinder from outside, or RENDER_FAR.
fn render_meet_cylinder(start: vec3<f32>, end: vec3<f32>, radius: f32, origin: vec3<f32>, direction: vec3<f32>) -> f32 {
    let axis = ltc_direction(end - start);
    let offset = origin - start;
    let aside = offset - axis * dot(offset, axis);
    let way = direction - axis * dot(direction, axis);
    let a = max(dot(way, way), 1e-20);
    // From the point of the ray next to the axis.
    let half = -dot(aside, way) / a;
    let nearest = aside + way * half;
    let depth_squared = (radius * radius - dot(nearest, nearest)) / a;
    let distance = half - sqrt(max(depth_squared, 1e-30));
    let along = dot(offset + direction * distance, axis);
    return select(RENDER_FAR, distance, depth_squared >= 0.0 && distance > 0.0 && along >= 0.0 && along <= dot(end - start, axis));
}

/// Distance along the ray at which it meets a light, or RENDER_FAR.
fn render_meet_light(light: RenderLight, origin: vec3<f32>, direction: vec3<f32>) -> f32 {
    let first = vertices[light.first].xyz;
    let radius = vertices[light.first].w;
    if (light.kind == RENDER_SPHERE_LIGHT) {
        return render_meet_sphere(first, radius, origin, direction);
    }
    if (light.kind == RENDER_TUBE) {
        let second = vertices[light.first + 1u].xyz;
        let lateral = render_meet_cylinder(first, second, radius, origin, direction);
        let ends = min(render_meet_sphere(first, radius, origin, direction), render_meet_sphere(second, radius, origin, direction));
        return select(lateral, min(lateral, ends), (light.flags & RENDER_CAPS) != 0u);
    }
    let distance = dot(first - origin, light.normal) / render_keep_sign(dot(direction, light.normal));
    if (distance <= 0.0 || distance >= RENDER_FAR) {
        return RENDER_FAR;
    }
    let place = origin + direction * distance;
    if (light.kind == RENDER_DISK) {
        let half_x = vertices[light.first + 1u].xyz;
        let half_y = vertices[light.first + 2u].xyz;
        let area = dot(cross(half_x, half_y), light.normal);
        let x = dot(cross(place - first, half_y), light.normal) / area;
        let y = dot(cross(half_x, place - first), light.normal) / area;
        return select(RENDER_FAR, distance, x * x + y * y <= 1.0);
    }
    let size = abs(light.normal);
    let drop_x = size.x >= size.y && size.x >= size.z;
    let drop_y = !drop_x && size.y >= size.z;
    // A ray to one side within the plane crosses the outline of what surrounds it an odd number of times.
    var inside = false;
    var start = vertices[light.first + light.count - 1u].xyz - place;
    for (var i = 0u; i < light.count; i++) {
        let end = vertices[light.first + i].xyz - place;
        let a = select(select(start.xy, start.zx, drop_y), start.yz, drop_x);
        let b = select(select(end.xy, end.zx, drop_y), end.yz, drop_x);
        if ((a.y > 0.0) != (b.y > 0.0)) {
            inside = inside != (a.x + (b.x - a.x) * (a.y / (a.y - b.y)) > 0.0);
        }
        start = end;
    }
    return select(RENDER_FAR, distance, inside);
}

/// Radiance that a surface reflects of a light of unit radiance that shows a picture.
fn render_reflected_picture(shading: LtcShading, material: LtcMaterial, light: RenderLight) -> vec3<f32> {
    let a = vertices[light.first].xyz;
    let b = vertices[light.first + 1u].xyz;
    let c = vertices[light.first + 2u].xyz;
    let d = vertices[light.first + 3u].xyz;
    let two_sided = (light.flags & RENDER_TWO_SIDED) != 0u;
    if (render_pictures > 3u) {
        if (light.picture == 4u) {
            return ltc_reflected_picture(shading, material, a, b, c, d, two_sided, fourth_picture, picture_sampler, vec2<f32>(textureDimensions(fourth_picture)));
        }
    }
    if (render_pictures > 2u) {
        if (light.picture == 3u) {
            return ltc_reflected_picture(shading, material, a, b, c, d, two_sided, third_picture, picture_sampler, vec2<f32>(textureDimensions(third_picture)));
        }
    }
    if (render_pictures > 1u) {
        if (light.picture == 2u) {
            return ltc_reflected_picture(shading, material, a, b, c, d, two_sided, second_picture, picture_sampler, vec2<f32>(textureDimensions(second_picture)));
        }
    }
    return ltc_reflected_picture(shading, material, a, b, c, d, two_sided, first_picture, picture_sampler, vec2<f32>(textureDimensions(first_picture)));
}

/// What a surface receives of a light of unit radiance.
fn render_received(shading: LtcShading, light: RenderLight) -> LtcReceived {
    let first = light.first;
    let two_sided = (light.flags & RENDER_TWO_SIDED) != 0u;
    let a = vertices[first];
    var received: LtcReceived;
    if (ltc_use_disk & (light.kind == RENDER_DISK)) {
        received = ltc_shading_disk(shading, a.xyz, vertices[first + 1u].xyz, vertices[first + 2u].xyz, two_sided);
    }
    if (ltc_use_sphere & (light.kind == RENDER_SPHERE_LIGHT)) {
        received = ltc_shading_sphere(shading, a.xyz, a.w);
    }
    if (ltc_use_tube & (light.kind == RENDER_TUBE)) {
        received = ltc_shading_tube(shading, a.xyz, vertices[first + 1u].xyz, a.w, (light.flags & RENDER_CAPS) != 0u);
    }
    let is_quad = (light.flags & RENDER_CONVEX_QUAD) != 0u;
    if (ltc_use_quad & is_quad) {
        received = ltc_shading_quad(shading, a.xyz, vertices[first + 1u].xyz, vertices[first + 2u].xyz, vertices[first + 3u].xyz, two_sided);
    }
    if (ltc_use_polygon & (light.kind == RENDER_POLYGON) & !is_quad) {
        var polygon = ltc_shading_polygon_begin(shading, a.xyz);
        for (var i = 1u; i < light.count; i++) {
            ltc_shading_polygon_add(&polygon, shading, vertices[first + i].xyz);
        }
        received = ltc_shading_polygon_end(&polygon, shading, two_sided);
    }
    return received;
}

/// Radiance that a surface point reflects of all lights.
fn render_shade(hit: RenderHit, view: vec3<f32>) -> vec3<f32> {
    let object = objects[hit.object];
    let share = clamp(dot(hit.position - object.roughness_start, object.roughness_gradient), 0.0, 1.0);
    let roughness = mix(object.roughness_from, object.roughness_to, share);
    var material = ltc_material(object.base_colour, roughness, object.f0);
    material.grazing_reflectance = object.f90;
    material.diffuse_roughness = object.diffuse_roughness;
    material.coat = object.coat;
    material.coat_roughness = object.coat_roughness;
    material.coat_reflectance = object.coat_reflectance;
    material.sheen_colour = object.sheen_colour;
    material.sheen_roughness = object.sheen_roughness;
    material.grain = object.grain;
    material.anisotropy = object.anisotropy;
    var layers: LtcLayers;
    layers.lobes = settings.lobes_layer;
    layers.sheen = settings.sheen_layer;
    layers.diffuse = settings.diffuse_layer;
    layers.anisotropic = settings.anisotropic_layer;
    let table_size = f32(textureDimensions(table).x);
    let shading = ltc_shading(hit.position, hit.normal, view, material, layers, table, table_sampler, table_size);
    var sum = vec3<f32>(0.0);
    for (var index = 0u; index < settings.light_count; index++) {
        let light = lights[index];
        var reflected: vec3<f32>;
        if (ltc_use_textured & (light.picture != 0u)) {
            reflected = render_reflected_picture(shading, material, light);
        } else {
            reflected = ltc_reflected(shading, material, render_received(shading, light));
        }
        sum += light.radiance * reflected;
    }
    return sum;
}

/// What a light emits from a point on it.
fn render_emitted(light: RenderLight, place: vec3<f32>) -> vec3<f32> {
    if (light.picture == 0u) {
        return light.radiance;
    }
    let corner = vertices[light.first + 3u].xyz;
    let u = vertices[light.first + 1u].xyz - vertices[light.first].xyz;
    let v = vertices[light.first].xyz - corner;
    let area = cross(u, v);
    let offset = place - corner;
    let at = vec2<f32>(dot(cross(offset, v), area), dot(cross(u, offset), area)) / dot(area, area);
    var colour: vec4<f32>;
    if (light.picture == 1u) {
        colour = textureSampleLevel(first_picture, picture_sampler, at, 0.0);
    } else if (light.picture == 2u) {
        colour = textureSampleLevel(second_picture, picture_sampler, at, 0.0);
    } else if (light.picture == 3u) {
        colour = textureSampleLevel(third_picture, picture_sampler, at, 0.0);
    } else {
        colour = textureSampleLevel(fourth_picture, picture_sampler, at, 0.0);
    }
    return light.radiance * colour.xyz;
}

/// Radiance along a ray.
fn render_trace(origin: vec3<f32>, direction: vec3<f32>) -> vec3<f32> {
    var hit: RenderHit;
    hit.distance = RENDER_FAR;
    for (var index = 0u; index < settings.object_count; index++) {
        let next = render_meet(objects[index], origin, direction);
        if (next.distance < hit.distance) {
            hit = next;
            hit.object = index;
        }
    }
    var radiance = settings.background;
    var nearest = hit.distance;
    for (var index = 0u; index < settings.light_count; index++) {
        let light = lights[index];
        let distance = render_meet_light(light, origin, direction);
        if (distance < nearest) {
            nearest = distance;
            let sided = light.kind == RENDER_POLYGON || light.kind == RENDER_DISK;
            let emits = !sided || (light.flags & RENDER_TWO_SIDED) != 0u || dot(light.normal, direction) < 0.0;
            radiance = select(vec3<f32>(0.0), render_emitted(light, origin + direction * distance), emits);
        }
    }
    if (hit.distance < RENDER_FAR && hit.distance <= nearest) {
        hit.normal = select(hit.normal, -hit.normal, dot(hit.normal, direction) > 0.0);
        radiance = render_shade(hit, -direction);
    }
    return radiance;
}

@compute @workgroup_size(64)
fn render(@builtin(global_invocation_id) invocation: vec3<u32>) {
    let index = invocation.x;
    if (index >= settings.width * settings.rows) {
        return;
    }
    let row = index / settings.width;
    let corner = vec2<f32>(f32(index - row * settings.width), f32(settings.row + row));
    let size = vec2<f32>(f32(settings.width), f32(settings.height));
    var sum = vec3<f32>(0.0);
    for (var i = 0u; i < settings.sample_count; i++) {
        let at = corner + samples[i];
        let across = (2.0 * at.x - size.x) / size.y;
        let upward = 1.0 - 2.0 * at.y / size.y;
        let direction = ltc_direction(settings.forward + settings.right * across + settings.up * upward);
        sum += render_trace(settings.position, direction);
    }
    pixels[index] = vec4<f32>(sum / f32(settings.sample_count), 1.0);
}
