//! What makes a translated text an include: header, guard and comments.

use std::collections::{BTreeMap, BTreeSet};

use naga::Module;

use super::{Choice, Target, guard};

/// Puts the contract on top, a guard around, and the doc comments of the WGSL source before the
/// functions, types, members and constants that they belong to.
pub(super) fn decorate(include: &str, target: Target, module: &Module, body: &str, choice: Choice) -> String {
    let mut text = String::new();
    for line in contract(include) {
        text.push_str(line);
        text.push('\n');
    }
    text.push_str("//\n");
    for line in usage(target) {
        text.push_str(&format!("// {line}"));
        text.push('\n');
    }
    match choice {
        Choice::Made(effects) => text.push_str(&format!("//\n// Effects    {effects}\n")),
        Choice::Macros(_) => MACROS.iter().for_each(|line| text.push_str(&format!("// {line}\n"))),
    }
    text.push_str("//\n// Translated from wgsl/ltc.wgsl; edit that file, not this one.\n");
    text.push_str("// SPDX-License-Identifier: MIT OR Apache-2.0\n\n");
    let guard = match target {
        Target::Hlsl | Target::Unreal => "LTC_HLSL_INCLUDED",
        Target::Msl => "LTC_METAL_INCLUDED",
        _ => "LTC_GLSL_INCLUDED",
    };
    text.push_str(&format!("#ifndef {guard}\n#define {guard}\n\n"));
    let documented = documented(include, module, body);
    match choice {
        Choice::Made(_) => text.push_str(documented.trim()),
        Choice::Macros(effects) => {
            let guarded = guard::guard(&documented, effects);
            text.push_str(&format!("{}\n{}", guard::macros(effects), guarded.trim()));
        }
    }
    text.push_str(&format!("\n\n#endif // {guard}\n"));
    text
}

/// The comment at the top of the include.
fn contract(include: &str) -> impl Iterator<Item = &str> {
    include.lines().take_while(|line| line.starts_with("//"))
}

/// How to leave effects out.
const MACROS: [&str; 2] = [
    "           Define a switch, such as LTC_POLYGON, as 0 before, and what only serves that effect is",
    "           not compiled.",
];

fn usage(target: Target) -> &'static [&'static str] {
    match target {
        Target::Glsl450 | Target::Glsl330 => &[
            "GLSL       Include this text after #version and anything that it may need. Where WGSL",
            "           takes a texture and a sampler, GLSL takes a sampler2DArray. In Vulkan GLSL",
            "           with separate textures and samplers, sample the table yourself (level 2).",
        ],
        Target::GlslEs300 | Target::GlslEs310 => &[
            "GLSL ES    Include this text after #version, `precision highp float;`,",
            "           `precision highp int;` and `precision highp sampler2DArray;`: lower",
            "           precision breaks the geometry.",
        ],
        Target::Hlsl => &[
            "HLSL       Written in the subset of HLSL 2018 that shader model 5 compiles. Declares no",
            "           register: texture and sampler are parameters.",
        ],
        Target::Unreal => &[
            "Unreal     #include it from a .usf or a Custom node by the virtual path that your module",
            "           maps with AddShaderSourceDirectoryMapping. Declares no register: texture and",
            "           sampler are parameters.",
        ],
        Target::Msl => &[
            "Metal      Include this text in a .metal file. No Metal compiler has seen it: it is",
            "           tested as C++ with a stand-in for the Metal library.",
        ],
    }
}

/// The doc comments of the include, by the name of what they belong to; a member's name follows its
/// type's and a dot.
///
/// They are read from the text. naga parses them too, but gives a struct's comments to its first
/// members instead of their own, and loses those that follow an ordinary comment.
fn doc_comments(include: &str) -> BTreeMap<String, Vec<&str>> {
    let mut comments = BTreeMap::new();
    let mut pending = Vec::new();
    let mut structure: Option<&str> = None;
    for line in include.lines() {
        let code = line.trim();
        if let Some(comment) = code.strip_prefix("///") {
            pending.push(comment.trim_end());
            continue;
        }
        let mut words = code.split(|c: char| !is_part(c)).filter(|word| !word.is_empty());
        let name = match (words.next(), structure) {
            (Some("struct"), _) => {
                structure = words.next();
                structure.map(str::to_owned)
            }
            (Some("fn" | "const" | "override"), _) => words.next().map(str::to_owned),
            (Some(member), Some(structure)) => Some(format!("{structure}.{member}")),
            _ => None,
        };
        if code.starts_with('}') {
            structure = None;
        }
        if let Some(name) = name.filter(|_| !pending.is_empty()) {
            comments.insert(name, core::mem::take(&mut pending));
        }
        pending.clear();
    }
    comments
}

/// The text with the include's comments before the functions, types, members and constants that
/// they belong to, and with the include's own names of parameters and locals.
fn documented(include: &str, module: &Module, body: &str) -> String {
    let comments = doc_comments(include);
    let body = with_plain_names(module, body);
    let mut text = String::new();
    let mut structure: Option<&str> = None;
    for line in body.lines() {
        let name = if let Some(rest) = line.strip_prefix("struct ") {
            let name = identifier(rest);
            structure = Some(name);
            name.to_owned()
        } else if line.starts_with('}') {
            structure = None;
            String::new()
        } else if let Some(within) = structure {
            format!("{within}.{}", last_identifier(line))
        } else if line.starts_with(char::is_whitespace) {
            String::new()
        } else if let Some((head, _)) = line.split_once('(').filter(|(head, _)| !head.contains('=')) {
            last_identifier(head).to_owned()
        } else {
            line.split_once('=').map_or(String::new(), |(head, _)| last_identifier(head).to_owned())
        };
        let comment = comments.get(&name);
        let indent = &line[..line.len() - line.trim_start().len()];
        if comment.is_some() && indent.is_empty() && !text.ends_with("\n\n") {
            text.push('\n');
        }
        for comment in comment.into_iter().flatten() {
            text.push_str(&format!("{indent}//{comment}\n"));
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

/// The text with parameters and locals renamed to what the include calls them. naga numbers names
/// that any other function uses too; within one function the number says nothing.
fn with_plain_names(module: &Module, body: &str) -> String {
    let global: BTreeSet<&str> = module
        .functions
        .iter()
        .filter_map(|(_, function)| function.name.as_deref())
        .chain(module.types.iter().filter_map(|(_, kind)| kind.name.as_deref()))
        .chain(module.constants.iter().filter_map(|(_, constant)| constant.name.as_deref()))
        .collect();
    // naga leaves the first use of a name as it is, unless the name is a keyword of the target.
    let allowed: BTreeSet<&str> = body.split(|c: char| !is_part(c)).collect();
    let mut text = String::new();
    let mut function = String::new();
    for line in body.lines() {
        function.push_str(line);
        function.push('\n');
        if line.starts_with('}') {
            text.push_str(&with_plain_names_in(&function, &global, &allowed));
            function.clear();
        }
    }
    text + &function
}

fn with_plain_names_in(function: &str, global: &BTreeSet<&str>, allowed: &BTreeSet<&str>) -> String {
    let words: BTreeSet<&str> = function.split(|c: char| !is_part(c)).collect();
    let plain = |word: &str| -> Option<String> {
        let (base, number) = word.rsplit_once('_')?;
        let numbered = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
        // naga's own temporaries start with an underscore.
        let named = base.starts_with(|c: char| c.is_ascii_lowercase());
        (numbered && named).then(|| base.to_owned())
    };
    let mut bases: BTreeMap<String, usize> = BTreeMap::new();
    for base in words.iter().filter_map(|word| plain(word)) {
        *bases.entry(base).or_default() += 1;
    }
    let free = |base: &str| {
        bases.get(base) == Some(&1)
            && allowed.contains(base)
            && !words.contains(base)
            && !global.contains(base)
    };
    let mut text = String::new();
    let mut rest = function;
    while let Some(start) = rest.find(is_part) {
        text.push_str(&rest[..start]);
        let word = identifier(&rest[start..]);
        match plain(word).filter(|base| free(base)) {
            Some(base) => text.push_str(&base),
            None => text.push_str(word),
        }
        rest = &rest[start + word.len()..];
    }
    text + rest
}

fn is_part(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

fn identifier(text: &str) -> &str {
    let end = text.find(|c| !is_part(c)).unwrap_or(text.len());
    &text[..end]
}

fn last_identifier(text: &str) -> &str {
    let text = text.trim_end_matches(|c| !is_part(c));
    let start = text.rfind(|c| !is_part(c)).map_or(0, |i| i + 1);
    &text[start..]
}
