//! The include as WGSL, with less in it.
//!
//! What is left is the include's own text: whole declarations go with their comments, and `if` statements
//! that a switch decides by being off leave at most the block that is run.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::source::{Formula, check_nesting, closing, is_part, without_comments, words};
use super::{Effects, EffectsError};

/// The include for a set of effects: the same text without what nothing of the set reaches. Switches that
/// are on stay overrides, so a pipeline can still turn them off.
///
/// # Errors
///
/// If the set has an effect that the include does not have.
pub fn wgsl(effects: Effects) -> Result<String, EffectsError> {
    wgsl_from(crate::WGSL_INCLUDE, effects)
}

/// The same for another text of the include, such as one that a caller has changed. Its functions are kept
/// where a root of the set reaches them.
///
/// # Errors
///
/// As [`wgsl`], and if the text's brackets do not match or nest deeper than any shader's.
pub fn wgsl_from(include: &str, effects: Effects) -> Result<String, EffectsError> {
    effects.check_declared(include)?;
    check_nesting(&without_comments(include))?;
    let switches: BTreeMap<&str, bool> = effects.switches().collect();
    let off: BTreeMap<&str, bool> = effects.switches().filter(|(_, on)| !on).collect();
    let mut items = items(include);
    for item in &mut items {
        if item.kind == "fn" {
            item.text = selected(&item.text, &off);
        }
    }
    let by_name: BTreeMap<&str, usize> =
        items.iter().enumerate().map(|(index, item)| (item.name.as_str(), index)).collect();
    let mut kept = BTreeSet::new();
    let mut pending = Vec::new();
    for effect in effects.iter() {
        let entry = effect.entry();
        let with_lobe = if effects.has_lobe() { entry.lobe_roots } else { &[] };
        for function in entry.roots.iter().chain(with_lobe) {
            let index = by_name.get(function).ok_or(EffectsError::Broken { effect, function })?;
            pending.push(*index);
        }
    }
    // Switches that are on are the engine's to turn, whether anything asks for them or not.
    pending.extend(items.iter().enumerate().filter_map(|(index, item)| {
        (item.kind == "override" && switches.get(item.name.as_str()).copied().unwrap_or(!effects.is_empty()))
            .then_some(index)
    }));
    while let Some(index) = pending.pop() {
        if kept.insert(index) {
            pending.extend(words(&without_comments(&items[index].text)).filter_map(|word| by_name.get(word)));
        }
    }

    let mut text = header(include).to_owned();
    let mut banner = "";
    for (index, item) in items.iter().enumerate() {
        if item.banner.is_some() {
            banner = item.banner.as_deref().unwrap_or_default();
        }
        if kept.contains(&index) {
            text.push_str(core::mem::take(&mut banner));
            text.push_str(&item.comment);
            match switches.get(item.name.as_str()) {
                Some(false) if item.kind == "override" => {
                    text.push_str(&format!("const {}: bool = false;\n", item.name));
                }
                // One that is off unless it is asked for has been.
                Some(true) if item.kind == "override" => {
                    text.push_str(&item.text.replace("bool = false;", "bool = true;"));
                }
                _ => text.push_str(&item.text),
            }
        }
    }
    Ok(text)
}

/// A declaration.
struct Item {
    /// `fn`, `struct`, `const`, `override` or `alias`; the include has no variables.
    kind: String,
    name: String,
    /// The banner of the section that it begins, with the empty lines around it.
    banner: Option<String>,
    /// The empty lines and the comment before it.
    comment: String,
    /// Itself, with the line's end.
    text: String,
}

/// The comment at the top.
fn header(include: &str) -> &str {
    let lines = include.split_inclusive('\n').take_while(|line| line.starts_with("//"));
    &include[..lines.map(str::len).sum()]
}

fn items(include: &str) -> Vec<Item> {
    let code = without_comments(include);
    let mut items = Vec::new();
    let mut end = header(include).len();
    while let Some(start) = code[end..].find(|c: char| !c.is_whitespace()).map(|offset| end + offset) {
        let stop = code[start..].find([';', '{']).map_or(code.len(), |offset| start + offset);
        let last =
            if code[stop..].starts_with('{') { closing(&code, stop).unwrap_or(code.len() - 1) } else { stop };
        let next = code[last..].find('\n').map_or(code.len(), |offset| last + offset + 1);
        let mut declared = words(&code[start..stop])
            .skip_while(|word| !["fn", "struct", "const", "override", "alias"].contains(word));
        let kind = declared.next().unwrap_or_default().to_owned();
        let name = declared.next().unwrap_or_default().to_owned();

        // A banner stands between empty lines; a declaration's own comment directly above it.
        let gap = &include[end..start];
        let own = if gap.ends_with("\n\n") { gap.len() } else { gap.rfind("\n\n").map_or(0, |at| at + 1) };
        let (banner, comment) = match gap[..own].trim() {
            "" => (None, gap),
            _ => (Some(gap[..own].to_owned()), &gap[own..]),
        };
        items.push(Item {
            kind,
            name,
            banner,
            comment: comment.to_owned(),
            text: include[start..next].to_owned(),
        });
        end = next;
    }
    items
}

/// A function's text with what the switches decide.
fn selected(text: &str, switches: &BTreeMap<&str, bool>) -> String {
    let code = without_comments(text);
    let Some(open) = code.find('{') else { return text.to_owned() };
    let close = closing(&code, open).unwrap_or(text.len() - 1);
    let cut = Cut { text, code: &code, switches };
    let mut out = text[..=open].to_owned();
    cut.block(open + 1..close, &mut out);
    let mut out = out + &text[close..];
    while let Some(less) = without_unused(&out) {
        out = less;
    }
    out
}

/// A function's text, and the same without comments.
struct Cut<'a> {
    text: &'a str,
    code: &'a str,
    switches: &'a BTreeMap<&'a str, bool>,
}

/// An `if` statement.
struct Branch {
    condition: Range<usize>,
    accept: Range<usize>,
    /// What follows `else`: a block or another `if`.
    reject: Option<Reject>,
    end: usize,
}

enum Reject {
    Block(Range<usize>),
    If(usize),
}

impl Cut<'_> {
    /// Writes the statements of a block; returns whether nothing after them is run.
    fn block(&self, range: Range<usize>, out: &mut String) -> bool {
        let mut at = range.start;
        while at < range.end {
            let rest = &self.code[at..range.end];
            let next_block = rest.find('{').map(|offset| at + offset);
            let next_if = self.word("if", at..range.end);
            match (next_if, next_block) {
                (Some(start), block) if block.is_none_or(|block| start < block) => {
                    out.push_str(&self.text[at..start]);
                    // An `if` whose block lies beyond this one is none; what it is stays.
                    let Some(branch) = self.branch(start).filter(|branch| branch.end <= range.end) else {
                        at = start;
                        break;
                    };
                    at = branch.end;
                    if self.choose(start, &branch, out) {
                        return true;
                    }
                }
                (_, Some(open)) => {
                    let close = closing(self.code, open).unwrap_or(range.end);
                    out.push_str(&self.text[at..=open]);
                    self.block(open + 1..close, out);
                    at = close;
                    out.push('}');
                    at += 1;
                }
                (_, None) => break,
            }
        }
        out.push_str(&self.text[at..range.end]);
        ends(&self.code[range])
    }

    /// Writes what is left of an `if` statement; returns whether nothing after it is run.
    fn choose(&self, start: usize, branch: &Branch, out: &mut String) -> bool {
        match (self.decided(branch), &branch.reject) {
            (Some(true), _) => self.splice(branch.accept.clone(), out),
            (Some(false), Some(Reject::Block(block))) => self.splice(block.clone(), out),
            (Some(false), Some(Reject::If(next))) => match self.branch(*next) {
                Some(branch) => self.choose(*next, &branch, out),
                None => false,
            },
            (Some(false), None) => {
                // The statement's line and the comment above it go, too.
                let line = out.rfind('\n').map_or(0, |at| at + 1);
                if out[line..].trim().is_empty() {
                    out.truncate(line.saturating_sub(1));
                    while let Some(at) = out.rfind('\n').filter(|at| out[at + 1..].trim().starts_with("//")) {
                        out.truncate(at);
                    }
                }
                false
            }
            (None, reject) => {
                out.push_str(&self.text[start..branch.accept.start]);
                self.block(branch.accept.clone(), out);
                out.push('}');
                match reject {
                    None => {}
                    Some(Reject::Block(block)) => {
                        out.push_str(" else {");
                        self.block(block.clone(), out);
                        out.push('}');
                    }
                    Some(Reject::If(next)) => {
                        let mut rest = String::new();
                        if let Some(branch) = self.branch(*next) {
                            self.choose(*next, &branch, &mut rest);
                        }
                        if self.stays(*next) {
                            out.push_str(&format!(" else {}", rest.trim_start()));
                        } else if !rest.trim().is_empty() {
                            out.push_str(&format!(" else {{\n{rest}\n}}"));
                        }
                    }
                }
                false
            }
        }
    }

    /// Whether anything of a chain of `if` statements is left to be decided when the program runs.
    fn stays(&self, start: usize) -> bool {
        let Some(branch) = self.branch(start) else { return false };
        match (self.decided(&branch), branch.reject) {
            (None, _) => true,
            (Some(false), Some(Reject::If(next))) => self.stays(next),
            _ => false,
        }
    }

    /// The value of a condition, if the switches decide it.
    fn decided(&self, branch: &Branch) -> Option<bool> {
        let condition = &self.code[branch.condition.clone()];
        let formula = Formula::read(condition, &|name| self.switches.contains_key(name));
        formula.value(&|name| self.switches.get(name).copied())
    }

    /// Writes a block's statements in the place of the statement that it belongs to; in braces where it
    /// declares a name, which another block may use again.
    fn splice(&self, block: Range<usize>, out: &mut String) -> bool {
        let mut inner = String::new();
        let finished = self.block(block.clone(), &mut inner);
        let mut depth = 0;
        let declares = self.code[block].lines().any(|line| {
            let outermost = depth == 0;
            depth += line.matches('{').count() as i32 - line.matches('}').count() as i32;
            outermost && ["let ", "var ", "const "].iter().any(|word| line.trim_start().starts_with(word))
        });
        if declares && !finished {
            out.push_str(&format!("{{{inner}}}"));
        } else {
            let inner = inner.trim_start_matches('\n').trim_end().replace("\n    ", "\n");
            out.push_str(inner.trim_start());
            if finished {
                out.push('\n');
                let line = out[..out.len() - 1].rfind('\n').map_or(0, |at| at + 1);
                let indent = out[line..].len() - out[line..].trim_start().len();
                out.push_str(&" ".repeat(indent.saturating_sub(4)));
            }
        }
        finished
    }

    fn branch(&self, start: usize) -> Option<Branch> {
        let open = start + self.code[start..].find('{')?;
        let close = closing(self.code, open)?;
        let mut branch =
            Branch { condition: start + 2..open, accept: open + 1..close, reject: None, end: close + 1 };
        let rest = self.code[branch.end..].trim_start();
        if let Some(after) = rest.strip_prefix("else").filter(|after| !after.starts_with(is_part)) {
            let after = after.trim_start();
            let at = self.code.len() - after.len();
            if after.starts_with('{') {
                let close = closing(self.code, at)?;
                branch.reject = Some(Reject::Block(at + 1..close));
                branch.end = close + 1;
            } else {
                branch.end = self.branch(at)?.end;
                branch.reject = Some(Reject::If(at));
            }
        }
        Some(branch)
    }

    /// Where a word stands first in a part of the code.
    fn word(&self, word: &str, range: Range<usize>) -> Option<usize> {
        self.code[range.clone()].match_indices(word).map(|(offset, _)| range.start + offset).find(|at| {
            !self.code[..*at].ends_with(is_part) && !self.code[at + word.len()..].starts_with(is_part)
        })
    }
}

/// Whether the last statement of a block leaves it.
fn ends(block: &str) -> bool {
    let block = block.trim_end();
    let Some(body) = block.strip_suffix(';') else { return false };
    let start = body.rfind([';', '{', '}']).map_or(0, |at| at + 1);
    words(&body[start..])
        .next()
        .is_some_and(|word| ["return", "break", "continue", "discard"].contains(&word))
}

/// A function's text without each `let` whose name it never uses, if there is one. Calls that take pointers
/// stay: they have effects.
fn without_unused(text: &str) -> Option<String> {
    let code = without_comments(text);
    let mut uses: BTreeMap<&str, usize> = BTreeMap::new();
    words(&code).for_each(|word| *uses.entry(word).or_default() += 1);
    // From the last on: what only an unused name uses comes before it.
    let (mut parts, mut from) = (Vec::new(), text.len());
    for (start, _) in code.rmatch_indices("let ") {
        let line = code[..start].rfind('\n').map_or(0, |at| at + 1);
        let Some(end) = code[start..].find(';').map(|length| start + length) else { continue };
        let statement = &code[start..end];
        let Some(name) = words(&statement[4..]).next() else { continue };
        let pointer = statement.contains("(&") || statement.contains(", &");
        let alone = code[line..start].trim().is_empty() && code[end + 1..].starts_with('\n');
        if alone && !pointer && end + 2 <= from && uses.get(name) == Some(&1) {
            words(statement).for_each(|word| *uses.entry(word).or_default() -= 1);
            parts.push(&text[end + 2..from]);
            from = line;
        }
    }
    let found = !parts.is_empty();
    parts.push(&text[..from]);
    found.then(|| parts.into_iter().rev().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn select(text: &str) -> Result<String, EffectsError> {
        let set: Effects = "quad".parse()?;
        let switches: String =
            set.switches().map(|(switch, on)| format!("override {switch}: bool = {on};\n")).collect();
        let roots: String = ["ltc_surface", "ltc_in_range", "ltc_material", "ltc_shading", "ltc_reflected"]
            .iter()
            .chain(super::super::Effect::Quad.entry().roots)
            .map(|root| format!("fn {root}() {{ body(); }}\n"))
            .collect();
        wgsl_from(&format!("{switches}\n{text}\n{roots}"), set)
    }

    #[test]
    fn an_if_without_a_block_of_its_own_stays() {
        let text = "fn body() { if ltc_use_disk }\nstruct Other { x: f32 }\n";
        let selected = select(text).unwrap_or_else(|error| panic!("{error}"));
        assert!(selected.contains("fn body() { if ltc_use_disk }"), "{selected}");
    }

    #[test]
    fn brackets_that_do_not_match_are_refused_by_line() {
        let (open, close) = ("(".repeat(100_000), ")".repeat(100_000));
        for (text, words) in [
            ("fn body() {".to_owned(), "not closed"),
            ("fn body() { ) }".to_owned(), "not open"),
            ("fn body() { ( } )".to_owned(), "not open"),
            (format!("fn body() {{ if ({open}x{close}) {{ }} }}"), "within each other"),
            (format!("fn body() {{ if (x) {{ }}{} }}", " else if (x) { }".repeat(20_000)), "branches of one"),
        ] {
            let error = select(&text).expect_err("no shader").to_string();
            assert!(error.contains("line 2") && error.contains(words), "{words:?} is not in {error:?}");
        }
    }

    #[test]
    fn many_unused_names_go_in_little_time() {
        let lets: String = (0..20_000).map(|index| format!("    let a{} = a{index};\n", index + 1)).collect();
        let selected = select(&format!("fn body() {{\n{lets}}}\n")).unwrap_or_else(|error| panic!("{error}"));
        assert!(!selected.contains("let a20000 ") && selected.contains("fn body()"), "{}", selected.len());
    }
}
