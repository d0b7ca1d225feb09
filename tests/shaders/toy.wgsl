// A toy include: what conditions and calls the real one may come to have.

/// Whether there are disks.
override ltc_use_disk: bool = true;
/// Whether there are spheres.
override ltc_use_sphere: bool = true;
/// Whether there are tubes.
override ltc_use_tube: bool = true;
/// Whether there is sheen.
override ltc_use_sheen: bool = true;
/// Whether lights emit from both sides.
override ltc_use_two_sided: bool = true;
/// Whether tubes have ends.
override ltc_use_caps: bool = true;

/// For everything.
const LTC_COMMON: f32 = 0.5;
/// For disks alone.
const LTC_DISK_SCALE: f32 = 0.25;
/// Which light is a disk.
const LTC_KIND_DISK: u32 = 0u;

/// A surface.
struct LtcSurface {
    /// The point.
    position: vec3<f32>,
    /// Its roughness.
    roughness: f32,
}

/// What tubes keep.
struct LtcTube {
    /// The axis.
    axis: vec3<f32>,
    /// The radius.
    radius: f32,
}

// ---------------------------------------------------------------------------------------------
// Helpers
// ---------------------------------------------------------------------------------------------

/// Reached by everything.
fn ltc_everywhere(v: f32) -> f32 {
    return v * LTC_COMMON;
}

/// Reached by round lights, after the functions that use it.
fn ltc_round(v: f32) -> f32 {
    return ltc_everywhere(v) + 1.0;
}

/// Reached by ends alone.
fn ltc_ends(tube: ptr<function, LtcTube>, v: f32) -> f32 {
    (*tube).radius += v;
    return ltc_everywhere((*tube).radius);
}

/// Begins a surface.
fn ltc_begin(position: vec3<f32>, roughness: f32) -> LtcSurface {
    var surface: LtcSurface;
    surface.position = position;
    surface.roughness = ltc_everywhere(roughness);
    return surface;
}

// ---------------------------------------------------------------------------------------------
// Disks
// ---------------------------------------------------------------------------------------------

/// Begins a disk.
fn ltc_disk_begin(surface: LtcSurface, two_sided: bool) -> f32 {
    let both = two_sided & ltc_use_two_sided;
    if (!both) {
        return 0.0;
    }
    return ltc_round(surface.roughness) * LTC_DISK_SCALE;
}

/// The form factor of a disk.
fn ltc_disk_diffuse(surface: LtcSurface, state: f32) -> f32 {
    return ltc_round(state) + surface.position.x;
}

/// The lobe of a disk.
fn ltc_disk_lobe(surface: LtcSurface, state: f32) -> f32 {
    return ltc_disk_diffuse(surface, state) * 2.0;
}

/// A disk.
fn ltc_disk(surface: LtcSurface, state: f32) -> f32 {
    return ltc_disk_lobe(surface, state) + ltc_disk_diffuse(surface, state);
}

// ---------------------------------------------------------------------------------------------
// Spheres
// ---------------------------------------------------------------------------------------------

/// Begins a sphere.
fn ltc_sphere_begin(surface: LtcSurface) -> f32 {
    return ltc_round(surface.position.y);
}

/// The form factor of a sphere.
fn ltc_sphere_diffuse(surface: LtcSurface, state: f32) -> f32 {
    return max(state, surface.position.z);
}

/// The lobe of a sphere.
fn ltc_sphere_lobe(surface: LtcSurface, state: f32) -> f32 {
    return state * surface.roughness;
}

/// A sphere.
fn ltc_sphere(surface: LtcSurface, state: f32) -> f32 {
    return ltc_sphere_lobe(surface, state);
}

// ---------------------------------------------------------------------------------------------
// Tubes
// ---------------------------------------------------------------------------------------------

/// Begins a tube.
fn ltc_tube_begin(surface: LtcSurface) -> LtcTube {
    var tube: LtcTube;
    tube.axis = surface.position;
    tube.radius = surface.roughness;
    return tube;
}

/// The form factor of a tube.
fn ltc_tube_diffuse(surface: LtcSurface, tube: LtcTube) -> f32 {
    var state = tube;
    var sum = dot(state.axis, surface.position);
    // Ends count once.
    if (ltc_use_caps) {
        sum += ltc_ends(&state, surface.roughness);
    }
    return sum + state.radius;
}

/// The lobe of a tube.
fn ltc_tube_lobe(surface: LtcSurface, tube: LtcTube) -> f32 {
    return ltc_tube_diffuse(surface, tube);
}

/// A tube.
fn ltc_tube(surface: LtcSurface, tube: LtcTube) -> f32 {
    return ltc_tube_lobe(surface, tube);
}

// ---------------------------------------------------------------------------------------------
// All lights
// ---------------------------------------------------------------------------------------------

/// Reached by sheen alone.
fn ltc_sheen_weight(surface: LtcSurface) -> f32 {
    if (!ltc_use_sheen) {
        return 0.0;
    }
    var weight = 1.0;
    for (var i = 0; i < 3; i++) {
        weight *= ltc_everywhere(surface.roughness);
        if (weight < 0.1) {
            break;
        }
    }
    return weight;
}

/// The light of any kind, under the name of what every set has.
fn ltc_surface(position: vec3<f32>, kind: u32, two_sided: bool) -> f32 {
    let surface = ltc_begin(position, f32(kind));
    let sheen = ltc_sheen_weight(surface);
    let round_light = ltc_round(surface.roughness);
    var value = 0.0;
    // Disks first.
    if (ltc_use_disk & (kind == LTC_KIND_DISK)) {
        let state = ltc_disk_begin(surface, two_sided);
        value = ltc_disk(surface, state) + select(0.0, sheen, ltc_use_sheen);
    } else if (ltc_use_sphere & (kind == 1u)) {
        let state = ltc_sphere_begin(surface);
        value = ltc_sphere_diffuse(surface, state);
        if (ltc_use_sheen) {
            value += ltc_sphere(surface, state) * sheen;
        } else {
            value += 1.0;
        }
    } else if (ltc_use_tube & (kind == 2u)) {
        value = ltc_tube(surface, ltc_tube_begin(surface));
    } else {
        value = -1.0;
    }
    if ((ltc_use_disk | ltc_use_sphere) & (kind < 2u)) {
        value += round_light;
    }
    if (kind > 2u) {
        if (ltc_use_tube) {
            value *= 2.0;
        }
    }
    return value;
}
