//! Where area lights are known to fail in public code, and what of this library answers it.

/// A hard case that was met in public, or measured on published code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KnownCase {
    /// What is hard.
    pub name: &'static str,
    /// What is seen where it is not handled.
    pub symptom: &'static str,
    /// Public places where it was met: projects with numbers of their issues and changes, or files.
    pub met: &'static str,
    /// Families of [`super::CATALOGUE`] that hold inputs of it.
    pub families: &'static [&'static str],
    /// Approaches of [`super::approach`] that lead into it.
    pub approaches: &'static [&'static str],
    /// What else answers it, or why it cannot arise; empty where the families say all.
    pub answer: &'static str,
}

const fn known(name: &'static str, symptom: &'static str, met: &'static str) -> KnownCase {
    KnownCase { name, symptom, met, families: &[], approaches: &[], answer: "" }
}

impl KnownCase {
    const fn families(self, families: &'static [&'static str]) -> Self {
        Self { families, ..self }
    }

    const fn approaches(self, approaches: &'static [&'static str]) -> Self {
        Self { approaches, ..self }
    }

    const fn answer(self, answer: &'static str) -> Self {
        Self { answer, ..self }
    }
}

/// Every case that was found in public trackers, shader code and by measuring the published form, by what is hard: edges and places
/// of polygons, the surface, horizons and outlines, round lights, numbers and formats, and what a renderer does around it.
pub const KNOWN: &[KnownCase] = &[
    known(
        "an edge seen under a half turn",
        "division by the sine of a half turn: black or glittering squares, spread by bloom",
        "O3DE #5912, #6174, #18683, #18896; Unity Graphics #4081; Godot #66623; ltc_code b23b090",
    )
    .families(&[
        "standing on the surface",
        "standing on the surface, less than 4e-7 away",
        "an edge subtends nearly a half turn",
        "flat on the horizon",
        "edge-on",
    ])
    .approaches(&["gap", "edge-line"]),
    known(
        "the same, finite and wrong",
        "a dark line where a light touches the floor: 0.316 instead of 0.5 at a gap of 1e-4",
        "measured on the published edge integral",
    )
    .families(&["standing on the surface", "standing on a turned surface", "disk, standing on the surface"])
    .approaches(&["gap", "gap-glossy"]),
    known(
        "the point within the light's outline",
        "the light's plane is undefined: black in front of it",
        "Godot area_lights_inc.glsl",
    )
    .families(&["ceiling", "the point in the light", "in the light's plane"])
    .approaches(&["head-on"]),
    known("a vertex at the point", "a direction without length", "Unity's AreaLighting.hlsl")
        .families(&["a vertex next to the point", "degenerate"])
        .approaches(&["vertex"]),
    known(
        "tiny and distant lights",
        "edges cancel: flicker, values many times too large",
        "Unity's AreaLighting.hlsl; UntoldEngine #724",
    )
    .families(&[
        "distant",
        "distant, on the horizon",
        "distant, on a turned horizon",
        "an edge subtends nearly nothing",
        "a million times as long as wide",
        "disk, distant",
        "sphere, distant",
        "tube, distant",
        "tube, tiny",
    ])
    .approaches(&["distance", "distance-glossy", "lobe-horizon", "thin", "disk-small"]),
    known(
        "the arc cosine next to 1",
        "bands, and spikes of bright lights",
        "Unity's AreaLighting.hlsl; O3DE #1881; Bevy",
    )
    .families(&["size at least a tenth of the distance", "distant", "an edge subtends nearly nothing"])
    .approaches(&["distance"])
    .answer("The include calls no inverse trigonometric function of its language."),
    known(
        "seen along the normal",
        "the tangent is a vector of no length",
        "MaterialX; Blender eevee_ltc_lib.glsl; Bevy",
    )
    .families(&["seen along the normal"])
    .approaches(&["view-normal"]),
    known(
        "a cosine of the view beyond 0 and 1",
        "roots of negative numbers, look-ups beside the table",
        "ltc_code; Bevy; PlayCanvas",
    )
    .families(&["seen along the surface", "seen along the normal", "normal and view of any length"])
    .approaches(&["grazing", "view-normal"]),
    known(
        "the table's last row",
        "lobes that mean nothing at grazing views",
        "the published table; its anisotropic successor stops at 0.9999 of a right angle",
    )
    .families(&["seen along the surface"])
    .approaches(&["grazing"])
    .answer("How close the lobes come to GGX there is another question: `tests/accuracy.rs`."),
    known(
        "no roughness",
        "a lobe without width; texels that are subnormal",
        "three.js #12922; Godot's floor of 0.02; PlayCanvas' of 0.001",
    )
    .families(&["mirrors"])
    .approaches(&["roughness"]),
    known(
        "between texels at low roughness",
        "highlights too wide or too narrow between the texels of a table",
        "measured on the published table",
    )
    .families(&["between the table's texels"])
    .approaches(&["texel"])
    .answer("Texels hold ratios to the mirror's lobe; `tests/accuracy.rs` compares between texels."),
    known("half a texel, or axes exchanged", "distorted highlights", "Bifrost3D #38")
        .families(&["between the table's texels"])
        .approaches(&["texel"])
        .answer("`ltc_table_coordinates` places the sample; `tests/stacks` samples on every stack."),
    known(
        "α in the place of perceptual roughness",
        "highlights too sharp",
        "nightshade-renderer 0.56; PlayCanvas",
    )
    .answer("The parameter is called `roughness` and α is its square; `tests/accuracy.rs` holds it to the integral of GGX."),
    known("1 / 2π twice", "six times too dark", "nightshade-renderer 0.56")
        .families(&["a million times the distance", "sphere, around the point"])
        .answer("Every function returns the integral itself: a light that fills the sky gives 1."),
    known(
        "cut before or after the lobe's transform",
        "light from below the floor",
        "ltc_code #3; O3DE #1881; Unity Graphics #1924, #4630",
    )
    .families(&["below the horizon", "standing on the surface", "vertices on the horizon"])
    .approaches(&["rising", "lifted", "sunk"])
    .answer("The exact levels cut at both horizons."),
    known("a horizon by a formula", "light leaks behind the camera", "Unity's AreaLighting.hlsl")
        .families(&["below the horizon", "distant, on the horizon", "sphere, distant, on the horizon"])
        .approaches(&["rising"])
        .answer("Only `fast` has such a formula, for quads and polygons."),
    known(
        "five vertices after the cut; crossed and bent quads",
        "light is lost, arrays overflow",
        "ltc_code; Bevy",
    )
    .families(&["vertices on the horizon", "crossed, dented and bent quads"])
    .answer("Edges are summed as they come; nothing is stored."),
    known("polygons of many vertices", "fixed arrays", "Peters' generated switches; O3DE LtcPolygonEvaluate")
        .families(&["simple polygon", "thousands of vertices", "spiral", "around the nadir"]),
    known(
        "winding, two sides, handedness",
        "lights that are black, or shine backwards",
        "three.js; Bevy; PlayCanvas; O3DE",
    )
    .families(&["seen from behind"])
    .answer("One convention, at the top of the include; `tests/properties.rs` reverses lights and adds both sides."),
    known(
        "a disk straight ahead or as wide as the sky",
        "a discriminant below zero: black spots and circles",
        "ltc_code #9; Blender #67060; PlayCanvas #5116, #5381, #7015, #7539; amethyst #2016",
    )
    .families(&["disk, parallel to the surface", "disk, ceiling"])
    .approaches(&["disk-axis", "disk-large"]),
    known("a tiny disk", "a cubic that overflows", "Blender eevee_ltc_lib.glsl; measured on the published form")
        .families(&["disk, distant", "disk, parallel to the surface", "disk, distant, on the horizon"])
        .approaches(&["disk-small"]),
    known(
        "the axes of an ellipse",
        "thresholds that show as edges",
        "ltc_code's 1e-4; Blender's 7e-4",
    )
    .families(&["disk, ordinary", "disk, slender"]),
    known("disks at random", "rare errors of any size", "measured on the published form")
        .families(&["disk, ordinary", "disk, edge-on", "disk, touching the horizon"]),
    known(
        "NaN whose cause stays unknown",
        "black squares by bloom; a test for NaN that a compiler may leave out",
        "PlayCanvas #7539, #7544",
    )
    .families(&["any finite numbers", "degenerate"])
    .answer("NaN is prevented, never looked for; `tests/shader_bits.rs` gives any bits, `tests/conforming` any device."),
    known(
        "tubes of no length, through the point, with an end below the horizon",
        "0 / 0",
        "Unity's line light; ltc_code's has no guard",
    )
    .families(&[
        "tube, of no length",
        "tube, from the point",
        "tube, through the point",
        "tube, along the horizon",
        "tube, pointing at the point",
    ])
    .approaches(&["tube-short", "tube-end-on"]),
    known(
        "half precision in arithmetic",
        "squares beyond 65504: black arcs",
        "Godot #120742, #120884",
    )
    .families(&["normal and view of any length", "in units of 2^-40 to 2^40", "far from the origin"])
    .approaches(&["scale", "offset"])
    .answer("The include has no type of half precision; the table alone is stored so."),
    known(
        "textures of floats that no sampler filters",
        "black or banded lights",
        "three.js #20415, #20477, #27305, #27315; PlayCanvas #2736, #6281",
    )
    .answer("The table is RGBA16F, which every sampler filters; `ltc_lobe` takes texels that were fetched in any other way."),
    known("tables of 8 bits", "bands", "PlayCanvas' packed tables; three.js #9373")
        .answer("No table of 8 bits is made. A filter whose weights have 8 bits is one of the stacks."),
    known(
        "too many bindings and samplers",
        "the feature is turned down",
        "Filament #8020; Bevy #24065",
    )
    .answer("One texture array and one sampler, of which `fast` needs neither."),
    known("a light scaled to nothing", "NaN, or a panic", "Bevy #25308").families(&[
        "without area",
        "without area, but for rounding",
        "degenerate",
        "tube, of no length",
    ]),
    known("small pictures on lights, and their mipmaps", "wrong pictures below 128 texels", "Godot #108219")
        .answer("A matter of looking up, not of edges: `tests/textures`."),
    known(
        "F90 other than 1, clear coat",
        "too dark",
        "O3DE #6018",
    )
    .answer("`ltc_reflectance` takes F0 and F90; layers share the energy: `tests/surfaces`."),
    known(
        "a sphere's form factor beyond 1, or of no length",
        "NaN at the border of the clipped sphere's table",
        "ltc_code; sgl-3d",
    )
    .families(&["sphere, ordinary", "sphere, all but touched", "sphere, around the point", "without area"])
    .approaches(&["sphere-contact"])
    .answer("Spheres read no table."),
    known("subnormal numbers", "texels that some processors take for zero", "measured on the published table")
        .families(&["the point in the light", "any finite numbers", "tube, tiny"])
        .answer("No texel is subnormal: `tests/table.rs`. Devices that flush are run: `tests/conforming`, `tests/stacks`."),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stability::CATALOGUE;
    use crate::stability::approach::approaches;

    #[test]
    fn every_known_case_is_answered_by_what_exists() {
        for case in KNOWN {
            for name in case.families {
                assert!(
                    CATALOGUE.iter().any(|family| family.name == *name),
                    "{}: no family {name:?}",
                    case.name
                );
            }
            for name in case.approaches {
                assert!(
                    approaches().iter().any(|approach| approach.name == *name),
                    "{}: no approach {name:?}",
                    case.name
                );
            }
            assert!(!case.families.is_empty() || !case.answer.is_empty(), "{} has no answer", case.name);
            assert!(!case.symptom.is_empty() && !case.met.is_empty(), "{} was met nowhere", case.name);
            for file in case.answer.split('`').filter(|text| text.starts_with("tests/")) {
                let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
                assert!(path.exists(), "{} names {file}, which is not there", case.name);
            }
        }
        for family in CATALOGUE {
            assert!(!family.about.is_empty(), "{} does not say what is hard", family.name);
        }
        assert_eq!(KNOWN.len(), 34);
    }
}
