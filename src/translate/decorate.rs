//! What makes a translated text an include: header, guard and comments.

use naga::Module;

use super::Target;
use crate::WGSL_INCLUDE;

/// Puts the contract on top, a guard around, and the doc comments of the WGSL source before the
/// functions, types, members and constants that they belong to.
pub(super) fn decorate(target: Target, module: &Module, body: &str) -> String {
    let mut text = String::new();
    for line in contract() {
        text.push_str(line);
        text.push('\n');
    }
    text.push_str("//\n");
    for line in usage(target) {
        text.push_str(&format!("// {line}"));
        text.push('\n');
    }
    text.push_str("//\n// Translated from wgsl/ltc.wgsl; edit that file, not this one.\n");
    text.push_str("// SPDX-License-Identifier: MIT OR Apache-2.0\n\n");
    let guard = match target {
        Target::Hlsl | Target::Unreal => "LTC_HLSL_INCLUDED",
        Target::Msl => "LTC_METAL_INCLUDED",
        _ => "LTC_GLSL_INCLUDED",
    };
    text.push_str(&format!("#ifndef {guard}\n#define {guard}\n\n"));
    text.push_str(documented(module, body).trim());
    text.push_str(&format!("\n\n#endif // {guard}\n"));
    text
}

/// The comment at the top of the include.
fn contract() -> impl Iterator<Item = &'static str> {
    WGSL_INCLUDE.lines().take_while(|line| line.starts_with("//"))
}

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

/// The doc comments by the name of what they belong to.
struct Comments<'a> {
    module: &'a Module,
}

impl Comments<'_> {
    fn of_function(&self, name: &str) -> Option<&[String]> {
        let docs = self.module.doc_comments.as_ref()?;
        let (handle, _) = self.module.functions.iter().find(|(_, f)| f.name.as_deref() == Some(name))?;
        docs.functions.get(&handle).map(Vec::as_slice)
    }

    fn of_constant(&self, name: &str) -> Option<&[String]> {
        let docs = self.module.doc_comments.as_ref()?;
        let (handle, _) = self.module.constants.iter().find(|(_, c)| c.name.as_deref() == Some(name))?;
        docs.constants.get(&handle).map(Vec::as_slice)
    }

    fn of_type(&self, name: &str) -> Option<&[String]> {
        let docs = self.module.doc_comments.as_ref()?;
        let (handle, _) = self.module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name))?;
        docs.types.get(&handle).map(Vec::as_slice)
    }

    fn of_member(&self, structure: &str, name: &str) -> Option<&[String]> {
        let docs = self.module.doc_comments.as_ref()?;
        let (handle, t) = self.module.types.iter().find(|(_, t)| t.name.as_deref() == Some(structure))?;
        let naga::TypeInner::Struct { members, .. } = &t.inner else { return None };
        let index = members.iter().position(|m| m.name.as_deref() == Some(name))?;
        docs.struct_members.get(&(handle, index)).map(Vec::as_slice)
    }
}

fn documented(module: &Module, body: &str) -> String {
    let comments = Comments { module };
    let mut text = String::new();
    let mut structure = None;
    for line in body.lines() {
        let declared = if let Some(rest) = line.strip_prefix("struct ") {
            let name = identifier(rest);
            structure = Some(name);
            comments.of_type(name)
        } else if line.starts_with('}') {
            structure = None;
            None
        } else if let Some(within) = structure {
            comments.of_member(within, last_identifier(line))
        } else if line.starts_with(char::is_whitespace) {
            None
        } else if let Some((head, _)) = line.split_once('(').filter(|(head, _)| !head.contains('=')) {
            comments.of_function(last_identifier(head))
        } else if let Some((head, _)) = line.split_once('=') {
            comments.of_constant(last_identifier(head))
        } else {
            None
        };
        let indent = &line[..line.len() - line.trim_start().len()];
        for comment in declared.unwrap_or_default() {
            // Plain comments: not every tool knows the third slash.
            text.push_str(indent);
            text.push_str(comment.trim_start().strip_prefix('/').unwrap_or(comment).trim_end());
            text.push('\n');
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
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
