// Axial moments of a Phong lobe over a polygon (Arvo 1995, "Applications of Irradiance Tensors to the Simulation of
// Non-Lambertian Phenomena"), in place of GGX. Albedo and Schlick's part come from the second layer of a table with the
// published axes and layout.

/// Largest exponent; sharper lobes are taken for this one.
const PHONG_EXPONENT_CAP: f32 = 2047.0;

/// What has been seen of a light so far.
struct PhongSum {
    /// Where the outline leaves the surface's upper side.
    leave: vec3<f32>,
    /// The form factor times -2 pi.
    diffuse: f32,
    /// Where the outline comes back to the surface's upper side.
    enter: vec3<f32>,
    /// The lobe's integral.
    lobe: f32,
    /// Where the outline leaves the lobe's upper side.
    lobe_leave: vec3<f32>,
    /// The lobe's exponent.
    exponent: f32,
    /// Where the outline comes back to the lobe's upper side.
    lobe_enter: vec3<f32>,
}

/// The angle of two vectors along the unit normal of their plane; zero for zero vectors.
fn phong_edge(a: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
    let product = cross(a, b);
    let extent = sqrt(dot(product, product));
    return product * (atan2(extent, dot(a, b)) / max(extent, 1e-30));
}

/// What the arc between the directions of two vectors, on the upper side of `axis`, adds to the integral of
/// (n + 1) / (2 pi) (axis.u)^n over a polygon.
///
/// Arvo (1995, section 4): (n + 1) t(n) = (n - 1) t(n - 2) - the sum of (axis.normal) times the integral of (axis.u)^(n - 1) over the
/// arcs. Odd moments start from the form factor and need no solid angle; so the normalised one is the sum of the integrals of the
/// even powers below n, each of which follows by parts from the one before. What lies between two odd exponents is interpolated.
fn phong_moment(axis: vec3<f32>, start_point: vec3<f32>, end_point: vec3<f32>, exponent: f32) -> f32 {
    let product = cross(start_point, end_point);
    let extent = sqrt(dot(product, product));
    let angle = atan2(extent, dot(start_point, end_point));
    let across = product * (1.0 / max(extent, 1e-30));
    let start = start_point * inverseSqrt(max(dot(start_point, start_point), 1e-30));
    let end = end_point * inverseSqrt(max(dot(end_point, end_point), 1e-30));
    let tilt = dot(axis, across);
    let at_start = dot(axis, start);
    let at_end = dot(axis, end);
    // Square of the largest cosine on the arc's circle.
    let largest = max(1.0 - tilt * tilt, 0.0);
    let square_start = at_start * at_start;
    let square_end = at_end * at_end;
    var boundary_start = at_start * dot(axis, cross(across, start));
    var boundary_end = at_end * dot(axis, cross(across, end));

    let steps = floor(0.5 * (exponent - 1.0));
    let last = 2.0 * steps;
    var integral = angle;
    var sum = angle;
    var power = 2.0;
    while (power <= last) {
        integral = ((power - 1.0) * largest * integral + boundary_start - boundary_end) * (1.0 / power);
        sum += integral;
        boundary_start *= square_start;
        boundary_end *= square_end;
        power += 2.0;
    }
    integral = ((power - 1.0) * largest * integral + boundary_start - boundary_end) * (1.0 / power);
    sum += (0.5 * (exponent - 1.0) - steps) * integral;
    return -0.159154943 * tilt * sum;
}

/// Where the way from `above` a plane to `below` it meets it, from the two heights.
fn phong_crossing(above: vec3<f32>, high: f32, below: vec3<f32>, low: f32) -> vec3<f32> {
    return below * high - above * low;
}

/// Adds an arc above the surface's horizon.
fn phong_arc(sum: ptr<function, PhongSum>, normal: vec3<f32>, mirror: vec3<f32>, a: vec3<f32>, b: vec3<f32>) {
    (*sum).diffuse += dot(normal, phong_edge(a, b));
    let high = dot(mirror, a);
    let low = dot(mirror, b);
    if (max(high, low) <= 0.0) {
        return;
    }
    var start = a;
    var end = b;
    if (low <= 0.0) {
        end = phong_crossing(a, high, b, low);
        (*sum).lobe_leave = end;
    }
    if (high <= 0.0) {
        start = phong_crossing(b, low, a, high);
        (*sum).lobe_enter = start;
    }
    (*sum).lobe += phong_moment(mirror, start, end, (*sum).exponent);
}

/// Adds the part of a side of the polygon above the surface's horizon.
fn phong_side(sum: ptr<function, PhongSum>, normal: vec3<f32>, mirror: vec3<f32>, a: vec3<f32>, b: vec3<f32>) {
    let high = dot(normal, a);
    let low = dot(normal, b);
    if (max(high, low) <= 0.0) {
        return;
    }
    var start = a;
    var end = b;
    if (low <= 0.0) {
        end = phong_crossing(a, high, b, low);
        (*sum).leave = end;
    }
    if (high <= 0.0) {
        start = phong_crossing(b, low, a, high);
        (*sum).enter = start;
    }
    phong_arc(sum, normal, mirror, start, end);
}

fn method_value(position: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, roughness: f32, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>) -> vec3<f32> {
    let cosine = clamp(dot(normal, view), 0.0, 1.0);
    let at = vec2<f32>(roughness, sqrt(1.0 - cosine)) * (63.0 / 64.0) + 0.5 / 64.0;
    let amplitude = textureSampleLevel(table, table_sampler, at, 1, 0.0);
    let mirror = normal * (2.0 * dot(normal, view)) - view;
    // A quarter of the half vector's exponent 2 / alpha^2 - 2 (Walter et al. 2007, section 5).
    let alpha = max(roughness * roughness, 1e-3);
    var sum: PhongSum;
    sum.exponent = clamp(0.5 / (alpha * alpha) - 0.5, 1.0, PHONG_EXPONENT_CAP);
    let from_a = a - position;
    let from_b = b - position;
    let from_c = c - position;
    let from_d = d - position;
    phong_side(&sum, normal, mirror, from_a, from_b);
    phong_side(&sum, normal, mirror, from_b, from_c);
    phong_side(&sum, normal, mirror, from_c, from_d);
    phong_side(&sum, normal, mirror, from_d, from_a);
    // The outline closes along the two horizons; along the lobe's one only the power 0 adds anything.
    phong_arc(&sum, normal, mirror, sum.leave, sum.enter);
    sum.lobe -= 0.159154943 * dot(mirror, phong_edge(sum.lobe_leave, sum.lobe_enter));
    let diffuse = max(-0.5 * 0.318309886 * sum.diffuse, 0.0);
    let lobe = max(sum.lobe, 0.0);
    return vec3<f32>(diffuse, amplitude.x * lobe, amplitude.y * lobe);
}
