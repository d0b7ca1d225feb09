//! The switches of a text that a C preprocessor reads: a macro for each effect, and conditional sections
//! around everything that only serves effects that are left out.

use std::collections::{BTreeMap, BTreeSet};

use crate::effects::{Effect, Effects, Formula, words};

/// Macros of which all must hold, negated where the flag is false.
type Case = BTreeSet<(String, bool)>;

/// When something is needed: in any of these cases. No case at all is never, the empty case always.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Need(BTreeSet<Case>);

impl Need {
    fn always() -> Self {
        Self([Case::new()].into())
    }

    fn never() -> Self {
        Self(BTreeSet::new())
    }

    fn of(effect: Effect) -> Self {
        match effect.entry().switch {
            "" => Self::always(),
            _ => Self([[(effect.switch_macro(), true)].into()].into()),
        }
    }

    fn or(&self, other: &Self) -> Self {
        let all: BTreeSet<Case> = self.0.union(&other.0).cloned().collect();
        // A case that demands more than another adds nothing to it.
        let tighter = |case: &Case| all.iter().any(|wider| wider != case && wider.is_subset(case));
        Self(all.iter().filter(|case| !tighter(case)).cloned().collect())
    }

    fn and(&self, other: &Self) -> Self {
        let both = |left: &Case| other.0.iter().map(|right| left.union(right).cloned().collect()).collect();
        let all = Self(self.0.iter().flat_map::<BTreeSet<Case>, _>(both).collect());
        all.or(&Self::never())
    }

    /// When a condition may hold.
    fn may_hold(condition: &Formula, positive: bool) -> Self {
        let join = |parts: &[Formula], all: bool| {
            let needs = parts.iter().map(|part| Self::may_hold(part, positive));
            match all {
                true => needs.fold(Self::always(), |joined, need| joined.and(&need)),
                false => needs.fold(Self::never(), |joined, need| joined.or(&need)),
            }
        };
        match condition {
            Formula::Known(value) if *value == positive => Self::always(),
            Formula::Known(_) => Self::never(),
            Formula::Switch(switch) => match by_switch(switch) {
                Some(effect) => Self([[(effect.switch_macro(), positive)].into()].into()),
                None => Self::always(),
            },
            Formula::Unknown => Self::always(),
            Formula::Not(part) => Self::may_hold(part, !positive),
            Formula::All(parts) => join(parts, positive),
            Formula::Any(parts) => join(parts, !positive),
        }
    }

    /// The condition for the preprocessor; nothing where it always holds.
    fn condition(&self) -> Option<String> {
        if *self == Self::always() || *self == Self::never() {
            return None;
        }
        let cases = self.0.iter().map(|case| {
            let terms =
                case.iter().map(|(name, holds)| if *holds { name.clone() } else { format!("!{name}") });
            let all = terms.collect::<Vec<_>>().join(" && ");
            if case.len() > 1 && self.0.len() > 1 { format!("({all})") } else { all }
        });
        Some(cases.collect::<Vec<_>>().join(" || "))
    }
}

fn by_switch(switch: &str) -> Option<Effect> {
    Effect::all().find(|effect| !switch.is_empty() && effect.entry().switch == switch)
}

/// The macros of the include's effects, on where the including file does not say otherwise.
pub(super) fn macros(effects: Effects) -> String {
    let mut text = String::new();
    for effect in effects.iter().filter(|effect| !effect.entry().switch.is_empty()) {
        let name = effect.switch_macro();
        let meaning = effect.entry().meaning;
        let on = u8::from(effect.is_default());
        text.push_str(&format!("// {meaning}\n#ifndef {name}\n#define {name} {on}\n#endif\n"));
    }
    text
}

/// A text whose switches are constants, with the macros of its effects in charge.
pub(super) fn guard(text: &str, effects: Effects) -> String {
    let declarations = declarations(text);
    let needs = needs(&declarations, effects);
    let mut out = String::new();
    for Declaration { space, name, is_function, text } in &declarations {
        let text = match by_switch(name) {
            _ if *is_function => guarded_branches(text),
            Some(effect) => text.replace("= true;", &format!("= bool({});", effect.switch_macro())),
            None => text.clone(),
        };
        match needs.get(name.as_str()).and_then(Need::condition) {
            Some(condition) => out.push_str(&format!("{space}#if {condition}\n{text}#endif\n")),
            None => out.push_str(&format!("{space}{text}")),
        }
    }
    out
}

/// A declaration at the outermost level with the comment above it.
struct Declaration {
    /// Empty lines before.
    space: String,
    name: String,
    is_function: bool,
    text: String,
}

fn declarations(text: &str) -> Vec<Declaration> {
    let mut all = Vec::new();
    let fresh =
        || Declaration { space: String::new(), name: String::new(), is_function: false, text: String::new() };
    let mut current = fresh();
    for line in text.split_inclusive('\n') {
        if current.text.is_empty() && line.trim().is_empty() {
            current.space.push_str(line);
            continue;
        }
        current.text.push_str(line);
        if line.starts_with("//") || line.starts_with(char::is_whitespace) {
            continue;
        }
        if current.name.is_empty() {
            current.is_function = line.contains('(') && !line.contains('=');
            let head = line.split(['(', '=', '{']).next().unwrap_or_default();
            current.name = words(head).last().unwrap_or_default().to_owned();
        }
        if line.starts_with('}') || line.trim_end().ends_with(';') {
            all.push(core::mem::replace(&mut current, fresh()));
        }
    }
    if !current.text.is_empty() {
        all.push(current);
    }
    all
}

/// When each function and structure is needed.
fn needs(declarations: &[Declaration], effects: Effects) -> BTreeMap<&str, Need> {
    let mut needs: BTreeMap<&str, Need> = BTreeMap::new();
    let guarded = declarations.iter().filter(|declaration| {
        declaration.is_function || declaration.text.lines().any(|line| line.starts_with("struct "))
    });
    needs.extend(guarded.map(|declaration| (declaration.name.as_str(), Need::never())));
    for effect in effects.iter() {
        let entry = effect.entry();
        let own = Need::of(effect);
        let lobes = effects.iter().filter(|effect| effect.entry().has_lobe);
        let lobe = lobes.fold(Need::never(), |any, effect| any.or(&Need::of(effect)));
        let with_lobe = entry.lobe_roots.iter().map(|root| (root, own.and(&lobe)));
        for (root, need) in entry.roots.iter().map(|root| (root, own.clone())).chain(with_lobe) {
            if let Some(known) = needs.get_mut(root) {
                *known = known.or(&need);
            }
        }
    }
    // What refers to something comes after it.
    for declaration in declarations.iter().rev() {
        let Some(own) = needs.get(declaration.name.as_str()).cloned() else { continue };
        for (line, need) in lines_with_needs(&declaration.text) {
            let code = line.split("//").next().unwrap_or_default();
            for word in words(code).filter(|word| *word != declaration.name) {
                if let Some(known) = needs.get_mut(word) {
                    *known = known.or(&own.and(&need));
                }
            }
        }
    }
    needs
}

/// Each line with when the branches that it lies in may be taken.
fn lines_with_needs(function: &str) -> Vec<(&str, Need)> {
    let mut open: Vec<(Need, Need)> = Vec::new();
    let mut lines = Vec::new();
    for line in function.lines() {
        let code = line.trim();
        let closed = if code.starts_with('}') { open.pop() } else { None };
        let need = open.iter().fold(Need::always(), |all, (need, _)| all.and(need));
        lines.push((line, need));
        if code.ends_with('{') {
            open.push(match (condition(code), closed) {
                (Some(condition), _) => (Need::may_hold(&condition, true), Need::may_hold(&condition, false)),
                (None, Some((_, otherwise))) if code == "} else {" => (otherwise, Need::always()),
                _ => (Need::always(), Need::always()),
            });
        }
    }
    lines
}

/// The condition of a line that begins an `if` statement.
fn condition(line: &str) -> Option<Formula> {
    let text = line.strip_prefix("if ")?.strip_suffix('{')?;
    Some(Formula::read(text, &|name| by_switch(name).is_some()))
}

/// A block of a function that is still open.
#[derive(Default)]
struct Open {
    /// Whether it and its head stand in a conditional section.
    whole: bool,
    /// Whether its statements alone do.
    statements: bool,
    /// When the branch after `else` may be taken.
    otherwise: Option<String>,
}

/// A function whose branches are left out where their condition cannot hold.
fn guarded_branches(function: &str) -> String {
    let mut out = String::new();
    let mut open: Vec<Open> = Vec::new();
    for line in function.lines() {
        let code = line.trim();
        let indent = &line[..line.len() - line.trim_start().len()];
        let closed = code.starts_with('}').then(|| open.pop()).flatten().unwrap_or_default();
        let mut opened = Open::default();
        if closed.statements {
            out.push_str("#endif\n");
        }
        if let Some(condition) = condition(code) {
            opened.otherwise = Need::may_hold(&condition, false).condition();
            if let Some(needed) = Need::may_hold(&condition, true).condition() {
                opened.whole = true;
                out.push_str(&format!("#if {needed}\n"));
            }
        }
        out.push_str(&format!("{line}\n"));
        if code == "} else {" {
            if closed.whole {
                // Where the condition cannot hold, the other branch stays as a block.
                out.push_str(&format!("#else\n{indent}{{\n#endif\n"));
            }
            if let Some(needed) = closed.otherwise {
                opened.statements = true;
                out.push_str(&format!("#if {needed}\n"));
            }
        } else if closed.whole {
            out.push_str("#endif\n");
        }
        if code.ends_with('{') {
            open.push(opened);
        }
    }
    debug_assert!(!out.contains("} else if"), "a translation with `else if`");
    out
}
