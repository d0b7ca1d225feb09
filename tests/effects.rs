//! A module pays only for what it is asked for: proof by deletion, and compilation of every choice.

#[path = "common/tools.rs"]
mod tools;

#[path = "common/sets.rs"]
mod sets;

use std::process::Command;
use std::sync::LazyLock;

use softbox::effects::{Effect, Effects, wgsl_from};
use softbox::translate::{self, Target};

static TOY: LazyLock<String> = LazyLock::new(|| sets::completed(include_str!("shaders/toy.wgsl")));
const TOY_KERNEL: &str = include_str!("shaders/toy_kernel.wgsl");

/// The include and the toy, each with a kernel for it.
fn subjects() -> [(&'static str, &'static str, &'static str); 2] {
    [("include", softbox::WGSL_INCLUDE, softbox::WGSL_EVALUATE), ("toy", &TOY, TOY_KERNEL)]
}

fn library(include: &str, effects: Effects) -> Vec<u8> {
    translate::library_spirv(include, effects).unwrap_or_else(|error| panic!("{effects}: {error}"))
}

fn kernel(include: &str, kernel: &str, effects: Effects) -> Vec<u8> {
    let source = format!("{include}\n{kernel}");
    translate::kernel_spirv(&source, "evaluate", effects).unwrap_or_else(|error| panic!("{effects}: {error}"))
}

/// The position after the bracket that closes the one at `open`.
fn after_bracket(text: &str, open: usize) -> usize {
    let mut depth = 0;
    for (at, c) in text.char_indices().skip_while(|(at, _)| *at < open) {
        depth += match c {
            '{' => 1,
            '}' => -1,
            _ => 0,
        };
        if depth == 0 {
            return at + 1;
        }
    }
    panic!("a bracket stays open:\n{}", &text[open..])
}

/// The text without the branches and functions of an effect and of those that need it, by plain search and matching of
/// braces.
fn deleted(text: &str, effect: Effect) -> String {
    let present = Effects::declared(text);
    let gone = present - present.without(effect);
    let gone = gone.iter().chain([effect]).filter(|effect| !effect.entry().switch.is_empty());
    gone.fold(text.to_owned(), |text, effect| deleted_alone(&text, effect))
}

fn deleted_alone(text: &str, effect: Effect) -> String {
    let entry = effect.entry();
    let kept = Effects::declared(text).without(effect).roots();
    let mut text = text.to_owned();
    for start in [format!("if ({}", entry.switch), format!("else if ({}", entry.switch)] {
        while let Some(at) = text.rfind(&start).filter(|at| {
            // Not `if (x | y)`: that needs the other one only.
            let condition = text[*at..].split('{').next().unwrap_or_default();
            !condition.contains('|')
        }) {
            let open = at + text[at..].find('{').expect("a branch without a block");
            let end = after_bracket(&text, open);
            let rest = text[end..].trim_start();
            let has_else = rest.starts_with("else");
            let after = if has_else { text.len() - rest["else".len()..].trim_start().len() } else { end };
            let before = text[..at].trim_end_matches(' ');
            // `else if` loses its own `else`, unless there is another to take its place.
            let before = before.strip_suffix("else").unwrap_or(before);
            let joins =
                before.trim_end().ends_with('}') && has_else && text[..at].trim_end().ends_with("else");
            text = format!("{before}{}{}", if joins { "else " } else { "" }, &text[after..]);
        }
    }
    let lines = text.lines().filter(|line| !line.starts_with(&format!("override {}:", entry.switch)));
    text = lines.collect::<Vec<_>>().join("\n").replace(entry.switch, "false");
    // Its functions, those that call others before these; what something else calls stays.
    let own = || entry.roots.iter().chain(entry.lobe_roots).filter(|root| !kept.contains(root));
    while let Some(function) = own().find(|function| mentions(&text, function) == 1) {
        text = without_function(&text, function);
    }
    // What only those called.
    let present = Effects::declared(&text);
    let roots = present.roots();
    while let Some(name) = text
        .lines()
        .filter_map(|line| line.strip_prefix("fn ")?.split('(').next())
        .find(|name| !roots.contains(name) && !text.contains("fn evaluate(") && mentions(&text, name) == 1)
    {
        text = without_function(&text, name);
    }
    text
}

fn without_function(text: &str, name: &str) -> String {
    let Some(at) = text.find(&format!("\nfn {name}(")) else { return text.to_owned() };
    let open = at + text[at..].find(" {").expect("a function without a body") + 1;
    text[..at].to_owned() + &text[after_bracket(text, open)..]
}

fn mentions(text: &str, name: &str) -> usize {
    let code = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    code.flat_map(|line| line.split(|c: char| !c.is_ascii_alphanumeric() && c != '_'))
        .filter(|word| *word == name)
        .count()
}

/// The effects of a text that have a switch.
fn switched(include: &str) -> impl Iterator<Item = Effect> {
    Effects::declared(include).iter().filter(|effect| !effect.entry().switch.is_empty())
}

#[test]
fn a_module_without_an_effect_is_one_that_never_had_it() {
    for (name, include, evaluate) in subjects() {
        assert!(switched(include).count() >= 4);
        for effect in switched(include) {
            let never = deleted(include, effect);
            assert!(!never.contains(effect.entry().switch), "{name}: {effect:?} was not deleted:\n{never}");
            let kept = Effects::declared(include).without(effect).roots();
            let own: Vec<_> = effect.entry().roots.iter().filter(|root| !kept.contains(root)).collect();
            let left = own.iter().filter(|root| mentions(&never, root) > 0).count();
            assert!(own.is_empty() || left < own.len(), "{name}: nothing of {own:?} was deleted:\n{never}");
            let rest = Effects::declared(include).without(effect);
            assert_eq!(Effects::declared(&never), rest, "{name}");
            for effects in sets::sets(include).into_iter().filter(|effects| rest.is_superset(*effects)) {
                assert!(
                    library(include, effects) == library(&never, effects),
                    "{name}: {effects} still has something of {effect:?}"
                );
            }
            let never = deleted(&format!("{include}\n{evaluate}"), effect);
            assert!(
                kernel(include, evaluate, rest) == kernel(&never, "", rest),
                "{name}: the kernel of {rest} still has something of {effect:?}"
            );
        }
    }
}

/// The comparison of the proof can fail: whatever is left of an effect shows.
#[test]
fn a_module_with_an_effect_differs_from_one_without() {
    for (name, include, evaluate) in subjects() {
        for effect in switched(include) {
            let all = Effects::declared(include);
            let rest = all.without(effect);
            let shows = library(include, all) != library(include, rest)
                || kernel(include, evaluate, all) != kernel(include, evaluate, rest);
            assert!(shows, "{name}: {effect:?} changes nothing");
        }
    }
    // One branch that is left on.
    let all = Effects::declared(&TOY);
    let rest = all.without(Effect::Caps);
    let forgotten = deleted(&TOY.replace("if (ltc_use_caps)", "if (true)"), Effect::Caps);
    assert!(library(&TOY, rest) != library(&forgotten, rest));
}

#[test]
fn nothing_is_left_of_the_empty_set() {
    for (name, include, _) in subjects() {
        let empty = library(include, Effects::NONE);
        let none = library("", Effects::NONE);
        assert_eq!(empty, none, "{name}");
        for target in Target::ALL {
            let text = translate::include_from(include, target, Effects::NONE)
                .unwrap_or_else(|error| panic!("{target:?}: {error}"));
            let code = text.lines().filter(|line| {
                let line = line.trim();
                !(line.is_empty() || line.starts_with("//") || line.starts_with('#'))
            });
            assert_eq!(
                code.filter(|line| !line.starts_with("using ")).collect::<Vec<_>>(),
                Vec::<&str>::new(),
                "{name}: {target:?}"
            );
        }
    }
}

#[test]
fn the_selected_text_gives_the_module_of_the_whole_one() {
    for (name, include, evaluate) in subjects() {
        for effects in sets::sets(include) {
            let text = wgsl_from(include, effects).unwrap_or_else(|error| panic!("{effects}: {error}"));
            assert!(library(&text, effects) == library(include, effects), "{name}: {effects}\n{text}");
            assert!(!text.contains("\n\n\n"), "{name}: {effects} leaves holes:\n{text}");
        }
        let all = Effects::declared(include);
        assert!(
            kernel(&wgsl_from(include, all).unwrap_or_default(), evaluate, all)
                == kernel(include, evaluate, all)
        );
    }
}

#[test]
fn selected_modules_are_valid() {
    let folder = tools::scratch("selected");
    for (name, include, evaluate) in subjects() {
        for effects in sets::sets(include) {
            let path =
                tools::write(&folder, &format!("{name}_{effects}.spv"), kernel(include, evaluate, effects));
            tools::assert_silent(
                &tools::run(Command::new("spirv-val").args(["--target-env", "vulkan1.1"]).arg(&path)),
                &[],
            );
        }
    }
}

#[test]
fn no_name_of_an_effect_is_left_without_it() {
    for (name, include, _) in subjects() {
        for effects in sets::sets(include) {
            let spirv = library(include, effects);
            // Some functions serve several effects.
            let kept = wgsl_from(include, effects).unwrap_or_else(|error| panic!("{effects}: {error}"));
            for effect in switched(include).filter(|effect| !effects.contains(*effect)) {
                for root in effect.entry().roots.iter().chain(effect.entry().lobe_roots) {
                    let found = spirv
                        .windows(root.len() + 1)
                        .any(|bytes| &bytes[..root.len()] == root.as_bytes() && bytes[root.len()] == 0);
                    let shared = kept.contains(&format!("fn {root}("));
                    assert!(!found || shared, "{name}: {effects} has {root}");
                }
            }
        }
    }
}

/// Choices of macros, as text to put before the include.
fn choices(include: &str) -> Vec<(String, String)> {
    let sets = sets::sets(include);
    sets.into_iter()
        .map(|set| {
            let lines = switched(include).map(|effect| {
                format!("#define {} {}\n", effect.switch_macro(), u8::from(set.contains(effect)))
            });
            (set.to_string(), lines.collect())
        })
        .collect()
}

/// A use of whatever a choice leaves, in the words of GLSL, HLSL and Metal alike.
const USE: &str = "
#if LTC_QUAD || LTC_POLYGON || LTC_DISK || LTC_SPHERE || LTC_TUBE
    LtcSurface surface = ltc_surface(at, at, at, 0.5);
    LtcLobes lobes = NO_LOBE;
#if LTC_GGX
    lobes = ltc_lobes_of(surface, ltc_lobe(surface, AT_FOUR, AT_FOUR));
#endif
#if LTC_QUAD
    value += ltc_quad(surface, lobes, at, at, at, at, true);
#endif
#if LTC_POLYGON
    LtcPolygon polygon = ltc_polygon_begin(surface, at);
    ltc_polygon_add(POLYGON, surface, lobes, at);
    value += ltc_polygon_end(POLYGON, surface, lobes, true);
#endif
#if LTC_DISK
    value += ltc_disk(surface, lobes, at, at, at, true);
#endif
#if LTC_SPHERE
    value += ltc_sphere(surface, lobes, at, 0.5);
#endif
#if LTC_TUBE
    value += ltc_tube(surface, lobes, at, at, 0.5, true);
#endif
#endif
";

const USE_TOY: &str = "
    value.x += ltc_surface(at, KIND, true);
#if LTC_DISK
    value.x += ltc_disk_diffuse(ltc_begin(at, 0.5), 0.5);
#endif
#if LTC_TUBE && LTC_SHEEN
    value.x += ltc_tube(ltc_begin(at, 0.5), ltc_tube_begin(ltc_begin(at, 0.5)));
#endif
";

#[test]
fn macros_choose_in_glsl() {
    let folder = tools::scratch("macros_glsl");
    for (name, include, code) in [("include", softbox::WGSL_INCLUDE, USE), ("toy", &*TOY, USE_TOY)] {
        let text =
            translate::switchable_from(include, Target::Glsl450).unwrap_or_else(|error| panic!("{error}"));
        let code = code
            .replace("POLYGON,", "polygon,")
            .replace("AT_FOUR", "vec4(at, 1.0)")
            .replace("KIND", "uint(at.x)");
        let lobe = "\nLtcLobes no_lobe;\n";
        for (choice, macros) in choices(include) {
            let lobe = if name == "include" {
                format!("#if LTC_QUAD || LTC_POLYGON || LTC_DISK || LTC_SPHERE || LTC_TUBE\n{lobe}#endif\n")
            } else {
                String::new()
            };
            let main = format!(
                "layout(location = 0) out vec4 color;\n{lobe}void main() {{\n    vec3 at = gl_FragCoord.xyz;\n    vec3 value = at;\n{}    color = vec4(value, 1.0);\n}}\n",
                code.replace("NO_LOBE", "no_lobe")
            );
            let file = format!("{name}_{choice}.frag");
            let source = tools::write(&folder, &file, format!("#version 450\n{macros}{text}{main}"));
            tools::assert_silent(&tools::run(Command::new("glslangValidator").arg(&source)), &[&file]);
        }
    }
}

#[test]
fn macros_choose_in_hlsl() {
    let folder = tools::scratch("macros_hlsl");
    for (name, include, code) in [("include", softbox::WGSL_INCLUDE, USE), ("toy", &*TOY, USE_TOY)] {
        let text =
            translate::switchable_from(include, Target::Hlsl).unwrap_or_else(|error| panic!("{error}"));
        let code = code
            .replace("POLYGON,", "polygon,")
            .replace("AT_FOUR", "float4(at, 1.0)")
            .replace("KIND", "uint(at.x)")
            .replace("NO_LOBE", "(LtcLobes)0");
        let main = format!(
            "float4 main(float4 position : SV_Position) : SV_Target {{\n    float3 at = position.xyz;\n    float3 value = at;\n{code}    return float4(value, 1.0);\n}}\n"
        );
        for (choice, macros) in choices(include) {
            let source =
                tools::write(&folder, &format!("{name}_{choice}.hlsl"), format!("{macros}{text}{main}"));
            let said = tools::run(
                tools::dxc()
                    .arg(&source)
                    .arg(folder.join("pixel.dxil"))
                    .args(["-T", "ps_6_0", "-E", "main", "-HV", "2018", "-WX", "-Ges"]),
            );
            tools::assert_silent(&said, &["DXIL.dll not found", "DXIL signing library"]);
        }
    }
}

#[test]
fn macros_choose_in_metal() {
    let folder = tools::scratch("macros_metal");
    let stand_in = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/tools/metal");
    let text = translate::switchable_from(softbox::WGSL_INCLUDE, Target::Msl)
        .unwrap_or_else(|error| panic!("{error}"));
    let code = USE
        .replace("POLYGON,", "polygon,")
        .replace("AT_FOUR", "metal::float4{0.5, 0.5, 0.5, 0.5}")
        .replace("NO_LOBE", "{}");
    for (choice, macros) in choices(softbox::WGSL_INCLUDE) {
        let main = format!(
            "metal::float3 evaluate(metal::float3 at) {{\n    metal::float3 value = at;\n{code}    return value;\n}}\n"
        );
        let source = tools::write(&folder, &format!("{choice}.cpp"), format!("{macros}{text}{main}"));
        tools::run(
            Command::new("clang++")
                .args([
                    "-std=c++17",
                    "-fsyntax-only",
                    "-Xclang",
                    "-cl-single-precision-constant",
                    "-Wall",
                    "-Wextra",
                ])
                .args([
                    "-Werror",
                    "-Wno-unused-parameter",
                    "-Wno-unused-variable",
                    "-Wno-unused-const-variable",
                    "-I",
                ])
                .arg(&stand_in)
                .arg(&source),
        );
    }
}

/// A text that holds only what it was asked for compiles by itself, in every language.
#[test]
fn selected_translations_compile() {
    let folder = tools::scratch("selected_glsl");
    for (name, include, _) in subjects() {
        for effects in sets::sets(include) {
            let text = |target| {
                translate::include_from(include, target, effects)
                    .unwrap_or_else(|error| panic!("{effects}: {error}"))
            };
            let file = format!("{name}_{effects}.frag");
            let main = "void main() {}\n";
            let source =
                tools::write(&folder, &file, format!("#version 450\n{}{main}", text(Target::Glsl450)));
            tools::assert_silent(&tools::run(Command::new("glslangValidator").arg(&source)), &[&file]);
            for target in Target::ALL {
                assert!(
                    !text(target).contains("ltc_use_"),
                    "{name}: {effects}: a switch is left in {target:?}"
                );
            }
        }
    }
}
