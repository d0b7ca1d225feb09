//! The package's README, for the engine programmer.

use super::{Contents, Measured, Package};
use crate::report::REGIONS;
use crate::table::Container;
use crate::translate::Target;

pub(super) fn guide(contents: &Contents, package: &Package) -> String {
    let size = contents.table_size;
    let mut text = String::from(
        "# Softbox: area lights by linearly transformed cosines\n\n\
         Light from polygons, disks, spheres and tubes on rough surfaces, in closed form and without noise. The contract (spaces,\n\
         winding, units, roughness) stands at the top of each shader file, the meaning and the error of\n\
         each function above it.\n\n\
         ## Files\n\n| file | for |\n|---|---|\n| `wgsl/ltc.wgsl` | WebGPU, wgpu, Bevy, three.js |\n",
    );
    for target in &contents.targets {
        let (path, purpose) = (target.path(), purpose(*target));
        text.push_str(&format!("| `{path}` | {purpose} |\n"));
    }
    text.push_str(
        "| `spirv/ltc_evaluate.spv` | Vulkan: a kernel that evaluates pairs of surfaces and lights |\n",
    );
    let names: Vec<String> =
        contents.containers.iter().map(|container| format!("`.{}`", container.extension())).collect();
    text.push_str(&format!("| `table/ltc` ({}) | the table for these shaders |\n", names.join(", ")));
    if contents.effects.is_none() && size == crate::TABLE_SIZE {
        text.push_str("| `table/ltc_all` (the same) | the same with the layers of every surface |\n");
        text.push_str("| `table/ltc_two_lobes`, `table/ltc_three_lobes` (the same) | those for the quality levels fine and finest, in its place |\n");
    }
    if contents.compatible {
        text.push_str(
            "| `table/ltc_compatible` (the same) | the table for an engine that already implements the published technique: swap the file |\n",
        );
    }
    text.push_str(&effects(contents));
    let layers = contents.effects.map_or(2, |effects| effects.layers().len());
    text.push_str(&format!(
        "\n## Use\n\n\
         1. Create a texture array of {size} × {size} texels and {layers} layers, RGBA16F, without mipmaps, from\n   \
            `table/ltc`, and a sampler that filters linearly and clamps to the edge.\n\
         2. For each surface point: `ltc_surface`, then `ltc_lobes_from_table`. Both serve all lights.\n\
         3. For each light: `ltc_quad` for a convex quad, `ltc_disk`, `ltc_sphere`, `ltc_tube`, or `ltc_polygon_begin`,\n   \
            `ltc_polygon_add` for each further vertex and `ltc_polygon_end`. They return (diffuse, specular, fresnel).\n\
         4. Reflected radiance = light radiance × (base colour × diffuse\n   \
            + `ltc_reflectance(value, F0, F90)`).\n\n\
         For surfaces with more parts: `ltc_shading` in step 2, `ltc_shading_quad` and so on in step 3,\n\
         `ltc_reflected` in step 4.\n\n\
         In WGSL:\n\n\
         ```wgsl\n\
         let surface = ltc_surface(position, normal, eye - position, roughness);\n\
         let lobes = ltc_lobes_from_table(surface, table, table_sampler, {size}.0, 0);\n\
         let value = ltc_quad(surface, lobes, corner_a, corner_b, corner_c, corner_d, false);\n\
         let reflected = radiance * (base_colour * value.x + ltc_reflectance(value, f0, f90));\n\
         ```\n\n\
         GLSL takes one `sampler2DArray` in place of texture and sampler. To sample the table in another\n\
         way, fetch the layers at `ltc_table_coordinates(surface, {size}.0)`: two for one lobe, for\n\
         `ltc_lobes_of(surface, ltc_lobe(...))`; three for two lobes, for `ltc_two_lobes`; five for three, for\n\
         `ltc_three_lobes`.\n\n\
         ## Table files\n\n",
    ));
    for container in &contents.containers {
        text.push_str(&format!("- `.{}`: {}\n", container.extension(), describe(*container)));
    }
    if contents.compatible {
        text.push_str(
            "\nThe compatible table has the published layout: layer 0 holds the inverse matrix's entries\n\
             (x, y, z, w), its middle entry being 1; layer 1 holds the magnitude, the Schlick part's\n\
             magnitude, 0, and the horizon-clipped sphere. Its axes are roughness and √(1 − cos θ).\n",
        );
    }
    text.push_str("\n## Accuracy\n\n");
    if let Some(native) = &package.native {
        text.push_str(
            "Mean |error| over mean value, in per cent, against numerical integration of the reflectance\n\
             model, on random quads (60 % near the mirror direction, many across the horizon): of the\n\
             specular value, of its Schlick part, and of a dielectric with F0 = 0.04.\n\n",
        );
        text.push_str(&table("These shaders", native));
    } else {
        text.push_str("Not measured for this package.\n");
    }
    if let Some(compatible) = &package.compatible {
        text.push('\n');
        text.push_str(&table("The published technique with the compatible table", compatible));
    }
    text.push_str(
        "\n## Limits\n\n\
         No shadows. Below roughness 0.02 the lobe stays that\n\
         of 0.02. Polygons are planar and simple. No Metal compiler has seen `msl/ltc.metal`.\n\n\
         ## Sources\n\n\
         Heitz, Dupuy, Hill and Neubelt 2016, *Real-Time Polygonal-Light Shading with Linearly Transformed\n\
         Cosines*; Lambert 1760; Schlick 1994; Duff et al. 2017. MIT or Apache-2.0, at your choice.\n",
    );
    text
}

/// What the shaders hold and how to have less of it.
fn effects(contents: &Contents) -> String {
    let Some(effects) = contents.effects else {
        return "\n## Effects\n\n\
             The shaders hold every light and every surface. What a scene does not call for costs nothing: in WGSL set\n\
             the overrides `ltc_use_…` to false, elsewhere define the macros `LTC_…` as 0 before the file is included.\n\
             The list stands at the top of each file.\n"
            .to_owned();
    };
    let layers = effects.layers();
    let layers: Vec<String> =
        layers.iter().enumerate().map(|(index, layer)| format!("{index} {layer:?}")).collect();
    let layers = if layers.is_empty() { "none".to_owned() } else { layers.join(", ") };
    format!("\n## Effects\n\nThese shaders hold what `{effects}` calls for. Layers of the table: {layers}.\n")
}

fn table(title: &str, measured: &Measured) -> String {
    let mut text = format!("| {title} | specular | Schlick part | dielectric |\n|---|---|---|---|\n");
    let mut row = |name: String, accuracy: &crate::report::Accuracy| {
        text.push_str(&format!(
            "| {name} | {:.1} | {:.1} | {:.1} |\n",
            100.0 * accuracy.specular,
            100.0 * accuracy.fresnel,
            100.0 * accuracy.dielectric
        ));
    };
    row("all".to_owned(), &measured.all);
    for (region, accuracy) in REGIONS.iter().zip(&measured.regions) {
        let ((low, high), (grazing, steep)) = (region.roughness, region.cosine);
        row(format!("roughness {low}…{high}, cos θ {grazing}…{steep}"), accuracy);
    }
    text
}

fn purpose(target: Target) -> &'static str {
    match target {
        Target::Glsl450 => "Vulkan GLSL, desktop OpenGL 4.5, Godot compute shaders",
        Target::Glsl330 => "desktop OpenGL 3.3",
        Target::GlslEs300 => "WebGL 2, OpenGL ES 3.0, Godot `.gdshaderinc`",
        Target::GlslEs310 => "OpenGL ES 3.1",
        Target::Hlsl => "Direct3D 11 and 12, Unity",
        Target::Unreal => "Unreal Engine",
        Target::Msl => "Metal",
    }
}

fn describe(container: Container) -> &'static str {
    match container {
        Container::Raw => "the texels as they are uploaded: little-endian, layer after layer, row after row",
        Container::Dds => "DirectDraw surface, DX10 header, an array of R16G16B16A16_FLOAT layers",
        Container::Ktx => "Khronos texture 2, an array of R16G16B16A16_SFLOAT layers",
        Container::Rust => "a Rust constant of half-precision bits",
        Container::C => "a C and C++ array of half-precision bits",
    }
}
