//! What each family is, and where it has been met.

use super::Family;

const fn family(name: &'static str, about: &'static str, met: &'static str) -> Family {
    Family { name, about, met }
}

/// Every family of hard cases, by the light and what is hard about it.
pub const CATALOGUE: &[Family] = &[
    family(
        "size at least a tenth of the distance",
        "quads and polygons of every size, place and view, with mirrors and grazing views among them",
        "",
    ),
    family(
        "distant",
        "cross products and sums of edges lose all digits where a light is small for its distance",
        "UntoldEngine #724; a note in Unity's AreaLighting.hlsl",
    ),
    family("distant, on the horizon", "the same, cut by the surface's horizon", ""),
    family(
        "distant, on a turned horizon",
        "the same where a rounded normal leaves the horizon uncertain",
        "",
    ),
    family(
        "standing on the surface",
        "the edge at the surface is seen under nearly a half turn: the reciprocal of a sine that vanishes",
        "O3DE #5912, #6174, #18683, #18896; Unity Graphics #4081; Godot #66623",
    ),
    family(
        "standing on the surface, less than 4e-7 away",
        "the same where the edge's direction in the lobe's space has no digit left",
        "O3DE #18683",
    ),
    family("standing on a turned surface", "the same in any orientation", ""),
    family(
        "an edge passes close by",
        "an edge at less than 1/25 of its ends' distance: so much do the coordinates leave open",
        "",
    ),
    family(
        "an edge subtends nearly a half turn",
        "an edge passes the point at 1 to 1e-8 of its length",
        "Unity Graphics #4081; ltc_code's clamp of the cosine",
    ),
    family(
        "an edge subtends nearly nothing",
        "vertices that all but coincide: a normal made of two equal directions",
        "Unity's AreaLighting.hlsl",
    ),
    family(
        "a vertex next to the point",
        "a vertex whose direction is a tiny vector over its length",
        "Unity's AreaLighting.hlsl",
    ),
    family(
        "ceiling",
        "a light parallel to the surface that closes onto the point",
        "Godot area_lights_inc.glsl",
    ),
    family(
        "the point in the light",
        "the same down to distances that are subnormal or nothing",
        "Godot area_lights_inc.glsl",
    ),
    family("a million times the distance", "lights that fill half of all directions", "Blender #67060"),
    family(
        "edge-on",
        "the light's plane passes through the point: its normal times a vertex vanishes",
        "Unity Graphics #4597",
    ),
    family(
        "vertices on the horizon",
        "vertices whose height is nothing, subnormal or a rounding: which side are they on?",
        "ltc_code's cases by the signs of four heights",
    ),
    family("flat on the horizon", "a light in the surface's own plane", "O3DE #5912"),
    family(
        "below the horizon",
        "light that must not come through the surface",
        "ltc_code #3; O3DE #1881; Unity Graphics #4630",
    ),
    family(
        "seen from behind",
        "light that must not come from the back, however close",
        "Bevy's and PlayCanvas' tests by sign",
    ),
    family(
        "seen along the normal",
        "the view's azimuth is the direction of a vector of no length",
        "MaterialX; Blender eevee_ltc_lib.glsl; Bevy",
    ),
    family(
        "seen along the surface",
        "the cosine of the view vanishes, is subnormal or negative: the last row of tables",
        "the published table's last row; Bevy",
    ),
    family("mirrors", "a lobe without width", "three.js #12922; Godot's floor of 0.02; PlayCanvas' of 0.001"),
    family(
        "normal and view of any length",
        "squares of lengths that leave the range of single precision",
        "Bevy #25308",
    ),
    family(
        "between the table's texels",
        "centres, edges and corners of texels and the numbers next to them",
        "Bifrost3D #38",
    ),
    family(
        "far from the origin",
        "positions whose differences have few digits",
        "Godot's large world coordinates",
    ),
    family(
        "in units of 2^-40 to 2^40",
        "absolute thresholds that mean something in one unit only",
        "ltc_code's 1e-7; Blender's 7e-4",
    ),
    family(
        "a million times as long as wide",
        "slivers",
        "Unity's AreaLighting.hlsl: lights that shrink to a line",
    ),
    family("simple polygon", "stars of up to 200 vertices, not convex", "O3DE LtcPolygonEvaluate"),
    family(
        "thousands of vertices",
        "sums of thousands of edges",
        "fixed arrays of five vertices in Bevy, Unity and ltc_code",
    ),
    family("spiral", "outlines that wind many times", ""),
    family("around the nadir", "polygons below the point that reach over its horizon", ""),
    family("crossed, dented and bent quads", "what a quad should not be", "Bevy's clipped array of five"),
    family(
        "degenerate",
        "repeated and collinear vertices, no area, vertices at the point, opposite vertices",
        "Unity's AreaLighting.hlsl",
    ),
    family(
        "disk, ordinary",
        "disks and ellipses of every size and place",
        "ltc_code's cubic: rare errors of any size",
    ),
    family(
        "disk, distant",
        "an eigenvalue of a matrix whose entries cancel",
        "Blender eevee_ltc_lib.glsl scales its cubic",
    ),
    family("disk, distant, on the horizon", "the same, cut by the horizon", ""),
    family("disk, touching the horizon", "a rim that touches the surface's plane", ""),
    family("disk, standing on the surface", "a disk through the surface next to the point", ""),
    family("disk, standing on a turned surface", "the same in any orientation", ""),
    family("disk, the rim passes close by", "the point next to the rim", ""),
    family(
        "disk, ceiling",
        "a parallel disk that closes onto the point, and a million times as large",
        "PlayCanvas #5381, #7015, #7539; Blender #67060",
    ),
    family(
        "disk, parallel to the surface",
        "on the axis, huge, tiny: a discriminant below zero, a cubic that overflows",
        "ltc_code #9; amethyst #2016; PlayCanvas #5116",
    ),
    family(
        "disk, slender",
        "ellipses a million times as long as wide",
        "ltc_code's and Blender's thresholds for d12",
    ),
    family("disk, edge-on", "a disk whose plane passes through the point", ""),
    family("in the light's plane", "the same, exactly", ""),
    family(
        "without area",
        "disks without an axis or two, spheres of no radius: no light, exactly",
        "Bevy #25308",
    ),
    family("without area, but for rounding", "disks whose axes are parallel", ""),
    family("sphere, ordinary", "spheres of every size and place", ""),
    family("sphere, distant", "1 - cosine of a small angle", ""),
    family("sphere, distant, on the horizon", "the same, cut by the horizon", ""),
    family(
        "sphere, touching the horizon",
        "spheres that touch the surface's plane from above or below",
        "Snyder's four cases",
    ),
    family("sphere, all but touched", "the point next to the sphere", ""),
    family("sphere, around the point", "the point inside", "Frostbite's clamp of the distance"),
    family("tube, ordinary", "tubes of every size and place", ""),
    family("tube, turned and moved", "the same on any surface", ""),
    family("tube, distant", "small for their distance", ""),
    family("tube, tiny", "shorter and thinner than a rounding of their place", ""),
    family("tube, all but touched", "the point next to the tube", "Unity's guard against orthoSq == 0"),
    family("tube, along the horizon", "cut lengthwise by the surface's plane", ""),
    family("tube, pointing at the point", "seen along its axis", "ltc_code's line light has no guard"),
    family("tube, along the normal", "the same above the point", ""),
    family("tube, from the point", "an end at the point", "Unity's guard against orthoSq == 0"),
    family("tube, through the point", "with and without width", "Unity's guard against orthoSq == 0"),
    family("tube, around the point", "the point inside", ""),
    family(
        "tube, of no length",
        "both ends at one place, or at the point",
        "Unity's guard of a line without length",
    ),
    family(
        "any finite numbers",
        "any bits that make a finite number, for every light, its surface and its roughness",
        "PlayCanvas #7539, #7544: NaN whose cause stayed unknown",
    ),
];
