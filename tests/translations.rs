//! What holds for every translation as a text: committed, compiles everywhere, keeps its names.

mod common;

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use common::tools;
use softbox::translate::{self, Target};

fn include(target: Target) -> String {
    translate::include(target).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn committed_translations_are_fresh() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for target in Target::ALL {
        let committed = tools::read(&root.join(target.path()));
        assert!(
            committed == include(target).as_bytes(),
            "{} is not what the include translates to; `softbox build --update .` writes it anew",
            target.path()
        );
    }
    let spirv = translate::spirv().unwrap_or_else(|error| panic!("{error}"));
    assert!(tools::read(&root.join(translate::SPIRV_PATH)) == spirv, "{} is stale", translate::SPIRV_PATH);
}

/// The names that the include declares: functions, types and constants.
fn public_names() -> Vec<&'static str> {
    softbox::WGSL_INCLUDE
        .lines()
        .filter_map(|line| {
            let mut words = line.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
            matches!(words.next(), Some("fn" | "struct" | "const")).then(|| words.next()).flatten()
        })
        .collect()
}

/// Whether the include uses a constant with other constants only, so that a translation holds but their product.
fn is_folded(name: &str) -> bool {
    let mut uses = softbox::WGSL_INCLUDE.lines().filter(|line| line.starts_with(' ') && line.contains(name));
    name.starts_with("LTC_") && uses.all(|line| line.matches("LTC_").count() >= 2)
}

#[test]
fn public_names_are_kept() {
    let names = public_names();
    assert!(names.len() > 20, "found only {names:?}");
    for name in &names {
        assert!(["ltc_", "Ltc", "LTC_"].iter().any(|prefix| name.starts_with(prefix)), "{name}");
        assert!(!name.ends_with(|c: char| c == '_' || c.is_ascii_digit()) && !name.contains("__"), "{name}");
    }
    for target in Target::ALL {
        let text = include(target);
        let words: BTreeSet<&str> = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').collect();
        for name in names.iter().filter(|name| !is_folded(name)) {
            assert!(words.contains(name), "{target:?} lost {name}");
        }
    }
}

/// The members of the include's types.
fn member_names() -> Vec<&'static str> {
    let mut inside = false;
    softbox::WGSL_INCLUDE
        .lines()
        .filter_map(|line| {
            inside = line.starts_with("struct ") || (inside && !line.starts_with('}'));
            let (name, _) = line.trim().split_once(':')?;
            (inside && line.starts_with("    ") && !name.starts_with("//")).then_some(name)
        })
        .collect()
}

#[test]
fn members_keep_their_names_and_comments() {
    let names = member_names();
    assert!(names.contains(&"axis_x") && names.contains(&"cos_view"), "{names:?}");
    for target in Target::ALL {
        let text = include(target);
        let lines: Vec<&str> = text.lines().collect();
        for name in &names {
            let declaration = format!(" {name};");
            let at = lines
                .iter()
                .position(|line| line.starts_with("    ") && line.ends_with(&declaration))
                .unwrap_or_else(|| panic!("{target:?} does not declare the member {name}"));
            assert!(lines[at - 1].trim().starts_with("//"), "{target:?}: {name} has no comment");
        }
    }
}

/// Where two targets differ in nothing that matters, running one runs the other.
#[test]
fn the_older_versions_of_glsl_say_what_the_newer_ones_say() {
    let code = |target: Target| {
        let text = include(target);
        let lines: Vec<&str> = text.lines().filter(|line| !line.trim().starts_with("//")).collect();
        lines.join("\n").replace("highp ", "")
    };
    assert_eq!(code(Target::Glsl330), code(Target::Glsl450));
    assert_eq!(code(Target::GlslEs300), code(Target::GlslEs310));
    assert_eq!(code(Target::GlslEs300), code(Target::Glsl450));
}

/// A line at the start of which something is declared, without its comment.
fn declarations(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| {
        line.starts_with(|c: char| c.is_ascii_alphabetic())
            && !["using ", "precision "].iter().any(|start| line.starts_with(start))
    })
}

#[test]
fn nothing_but_the_library_s_names_reaches_the_including_file() {
    for target in Target::ALL {
        let text = include(target);
        for line in declarations(&text) {
            let own = ["ltc_", "Ltc", "LTC_"].iter().any(|prefix| {
                line.split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
                    .any(|word| word.starts_with(prefix))
            });
            assert!(own, "{target:?} declares: {line}");
        }
    }
}

#[test]
fn every_function_keeps_its_comment() {
    for target in Target::ALL {
        let text = include(target);
        let lines: Vec<&str> = text.lines().collect();
        for name in public_names().into_iter().filter(|name| !is_folded(name)) {
            let at = lines
                .iter()
                .position(|line| {
                    !line.starts_with("//")
                        && !line.starts_with(char::is_whitespace)
                        && line
                            .split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
                            .any(|word| word == name)
                })
                .unwrap_or_else(|| panic!("{target:?} does not declare {name}"));
            assert!(lines[at - 1].starts_with("//"), "{target:?}: {name} has no comment: {}", lines[at]);
        }
        for section in ["CONVENTIONS", "THREE LEVELS OF USE", "SPDX-License-Identifier"] {
            assert!(text.contains(section), "{target:?} lacks {section}");
        }
    }
}

#[test]
fn no_padding_or_checks_are_left() {
    for target in Target::ALL {
        let text = include(target);
        for stray in ["loop_bound", "loop_init", "naga_", "Construct", "ZeroValue", "NagaDimensions", "_pad"]
        {
            assert!(!text.contains(stray), "{target:?} contains {stray}");
        }
    }
}

const FRAGMENT: &str = "
layout(location = 0) out vec4 color;
uniform highp sampler2DArray table;
void main() {
    LtcSurface surface = ltc_surface(vec3(0.0), vec3(0.0, 0.0, 1.0), gl_FragCoord.xyz, 0.5);
    LtcLobes lobes = ltc_lobes_from_table(surface, table, 64.0, 0);
    LtcPolygon polygon = ltc_polygon_begin(surface, gl_FragCoord.xyz);
    ltc_polygon_add(polygon, surface, lobes, gl_FragCoord.yzx);
    ltc_polygon_add(polygon, surface, lobes, gl_FragCoord.zxy);
    vec3 value = ltc_polygon_end(polygon, surface, lobes, false)
        + ltc_quad(surface, lobes, gl_FragCoord.xyz, gl_FragCoord.yzx, gl_FragCoord.zxy, gl_FragCoord.xzy, true);
    color = vec4(ltc_reflectance(value, vec3(0.04), vec3(1.0)), 1.0);
}
";

#[test]
fn glsl_compiles_in_every_version_without_a_warning() {
    let folder = tools::scratch("versions");
    let es = "precision highp float;\nprecision highp int;\nprecision highp sampler2DArray;\n";
    for (name, head, target) in [
        ("450", "#version 450\n".to_owned(), Target::Glsl450),
        ("330", "#version 330\n".to_owned(), Target::Glsl330),
        ("es300", format!("#version 300 es\n{es}"), Target::GlslEs300),
        ("es310", format!("#version 310 es\n{es}"), Target::GlslEs310),
    ] {
        // Included twice: the guard has to hold.
        let include = include(target);
        let fragment = if name == "330" {
            FRAGMENT.replace("layout(location = 0) out", "out")
        } else {
            FRAGMENT.to_owned()
        };
        let source =
            tools::write(&folder, &format!("{name}.frag"), format!("{head}{include}{include}{fragment}"));
        let said = tools::run(Command::new("glslangValidator").arg(&source));
        tools::assert_silent(&said, &[&format!("{name}.frag")]);
    }
}

const PIXEL: &str = "
Texture2DArray<float4> table : register(t0);
SamplerState table_sampler : register(s0);
float4 main(float4 at : SV_Position) : SV_Target {
    LtcSurface surface = ltc_surface((float3)0.0, float3(0.0, 0.0, 1.0), at.xyz, 0.5);
    LtcLobes lobes = ltc_lobes_from_table(surface, table, table_sampler, 64.0, 0);
    LtcPolygon polygon = ltc_polygon_begin(surface, at.xyz);
    ltc_polygon_add(polygon, surface, lobes, at.yzx);
    ltc_polygon_add(polygon, surface, lobes, at.zxy);
    float3 value = ltc_polygon_end(polygon, surface, lobes, false)
        + ltc_quad(surface, lobes, at.xyz, at.yzx, at.zxy, at.xzy, true);
    return float4(ltc_reflectance(value, (float3)0.04, (float3)1.0), 1.0);
}
";

#[test]
fn hlsl_compiles_in_every_language_version_with_warnings_as_errors() {
    let folder = tools::scratch("profiles");
    for target in [Target::Hlsl, Target::Unreal] {
        let include = include(target);
        let source = tools::write(&folder, "pixel.hlsl", format!("{include}{include}{PIXEL}"));
        for (profile, version) in
            [("ps_6_0", "2016"), ("ps_6_0", "2018"), ("ps_6_0", "2021"), ("ps_6_6", "2021")]
        {
            let said = tools::run(
                tools::dxc()
                    .arg(&source)
                    .arg(folder.join("pixel.dxil"))
                    .args(["-T", profile, "-E", "main", "-HV", version, "-WX", "-Ges"]),
            );
            // Without Microsoft's signing library the output stays unsigned.
            tools::assert_silent(&said, &["DXIL.dll not found", "DXIL signing library"]);
        }
    }
}

#[test]
fn spirv_is_valid() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let said = tools::run(
        Command::new("spirv-val").args(["--target-env", "vulkan1.1"]).arg(root.join(translate::SPIRV_PATH)),
    );
    tools::assert_silent(&said, &[]);
}
