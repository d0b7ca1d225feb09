// Makes the mipmaps that ltc_texture_fetch reads, each from the one before. Stands alone.
//
// One dispatch of `reduce` makes one level, an invocation each of its texels: with the level before bound as
// `finer` and the new one as `coarser`, (width + 7) / 8 by (height + 7) / 8 workgroups. The last level, of one
// texel, comes from `average` instead, in one workgroup, with the image itself as `finer`: where sides cannot be
// halved, the mean of the levels between is not quite the image's. `softbox::texture::prefilter` does the same.
//
// 64 texels are read for each one written: 21 for each texel of the image in all.

/// The level before, without its own finer and coarser ones.
@group(0) @binding(0) var finer: texture_2d<f32>;
/// The level to make, of half the size, rounded down, but at least one.
@group(0) @binding(1) var coarser: texture_storage_2d<rgba16float, write>;

/// Texels along each axis that one is made from.
const PREFILTER_TAPS: i32 = 8;

/// The cubic B-spline of unit knots, centred.
fn spline(x: f32) -> f32 {
    let near = max(1.0 - abs(x), 0.0);
    let far = max(2.0 - abs(x), 0.0);
    return (far * far * far - 4.0 * near * near * near) / 6.0;
}

/// The index 0 to `count` - 1 of the texel that lies at `index` of a row that is mirrored at both ends.
fn mirrored(index: i32, count: i32) -> i32 {
    let folded = ((index % (2 * count)) + 2 * count) % (2 * count);
    return select(2 * count - 1 - folded, folded, folded < count);
}

/// `colour` rounded to the nearest numbers of half precision. Devices may round towards zero when they store it, and
/// level after level would get darker.
fn halved(colour: vec4<f32>) -> vec4<f32> {
    let bits = bitcast<vec4<u32>>(clamp(colour, vec4<f32>(-65504.0), vec4<f32>(65504.0)));
    let odd = (bits >> vec4<u32>(13u)) & vec4<u32>(1u);
    return bitcast<vec4<f32>>((bits + vec4<u32>(0xfffu) + odd) & vec4<u32>(0xffffe000u));
}

@compute @workgroup_size(8, 8)
fn reduce(@builtin(global_invocation_id) invocation: vec3<u32>) {
    let size = vec2<i32>(textureDimensions(coarser));
    let finer_size = vec2<i32>(textureDimensions(finer));
    let at = vec2<i32>(invocation.xy);
    if (at.x >= size.x || at.y >= size.y) {
        return;
    }
    let centre = (vec2<f32>(at) + 0.5) * (vec2<f32>(finer_size) / vec2<f32>(size));
    let first = floor(centre + 0.5) - 0.5 * f32(PREFILTER_TAPS);
    var sum = vec4<f32>(0.0);
    for (var j = 0; j < PREFILTER_TAPS; j++) {
        let row = mirrored(i32(first.y) + j, finer_size.y);
        var along = vec4<f32>(0.0);
        for (var i = 0; i < PREFILTER_TAPS; i++) {
            let column = mirrored(i32(first.x) + i, finer_size.x);
            let weight = 0.5 * spline(0.5 * (first.x + f32(i) + 0.5 - centre.x));
            along += weight * textureLoad(finer, vec2<i32>(column, row), 0);
        }
        sum += 0.5 * spline(0.5 * (first.y + f32(j) + 0.5 - centre.y)) * along;
    }
    textureStore(coarser, at, halved(sum));
}

/// Invocations of `average`.
const PREFILTER_THREADS: u32 = 256u;

var<workgroup> sums: array<vec4<f32>, PREFILTER_THREADS>;

@compute @workgroup_size(PREFILTER_THREADS)
fn average(@builtin(local_invocation_index) thread: u32) {
    let size = textureDimensions(finer);
    // Sums of columns first, so that no sum runs over many numbers.
    var sum = vec4<f32>(0.0);
    for (var x = thread; x < size.x; x += PREFILTER_THREADS) {
        var column = vec4<f32>(0.0);
        for (var y = 0u; y < size.y; y++) {
            column += textureLoad(finer, vec2<u32>(x, y), 0);
        }
        sum += column / f32(size.y);
    }
    sums[thread] = sum;
    workgroupBarrier();
    for (var step = PREFILTER_THREADS / 2u; step > 0u; step /= 2u) {
        if (thread < step) {
            sums[thread] += sums[thread + step];
        }
        workgroupBarrier();
    }
    if (thread == 0u) {
        textureStore(coarser, vec2<u32>(0u, 0u), halved(sums[0] / f32(size.x)));
    }
}
