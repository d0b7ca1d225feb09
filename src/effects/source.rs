//! Shader text seen from far enough that WGSL, GLSL, HLSL and MSL look alike.

use super::EffectsError;

/// A condition, as far as it says something about switches.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Formula {
    /// A literal.
    Known(bool),
    /// A switch, by its name.
    Switch(String),
    /// Anything else.
    Unknown,
    /// The opposite.
    Not(Box<Formula>),
    /// All of them.
    All(Vec<Formula>),
    /// Any of them.
    Any(Vec<Formula>),
}

impl Formula {
    /// Reads a condition. `is_switch` tells which names are those of switches.
    pub(crate) fn read(condition: &str, is_switch: &dyn Fn(&str) -> bool) -> Self {
        let text = condition.trim();
        if split(text, '?').len() > 1 {
            return Self::Unknown;
        }
        // What binds loosest first. Shading languages demand parentheses around comparisons next to these.
        for (operator, join) in [('|', Self::Any as fn(Vec<Self>) -> Self), ('&', Self::All)] {
            let parts = split(text, operator);
            if parts.len() > 1 {
                return join(parts.into_iter().map(|part| Self::read(part, is_switch)).collect());
            }
        }
        if let Some(rest) = text.strip_prefix('!')
            && (is_name(rest.trim()) || inside(rest.trim()).is_some())
        {
            return Self::Not(Box::new(Self::read(rest, is_switch)));
        }
        if let Some(inside) = inside(text) {
            return Self::read(inside, is_switch);
        }
        match text {
            "true" => Self::Known(true),
            "false" => Self::Known(false),
            name if is_name(name) && is_switch(name) => Self::Switch(name.to_owned()),
            _ => Self::Unknown,
        }
    }

    /// The value, if the switches decide it.
    pub(crate) fn value(&self, switch: &dyn Fn(&str) -> Option<bool>) -> Option<bool> {
        let decided = |parts: &[Self], by: bool| {
            let values: Vec<_> = parts.iter().map(|part| part.value(switch)).collect();
            if values.contains(&Some(by)) {
                Some(by)
            } else {
                values.iter().all(Option::is_some).then_some(!by)
            }
        };
        match self {
            Self::Known(value) => Some(*value),
            Self::Switch(name) => switch(name),
            Self::Unknown => None,
            Self::Not(part) => part.value(switch).map(|value| !value),
            Self::All(parts) => decided(parts, false),
            Self::Any(parts) => decided(parts, true),
        }
    }
}

/// The parts of a text between operators of one kind, single or double, outside all parentheses.
fn split(text: &str, operator: char) -> Vec<&str> {
    let mut parts = Vec::new();
    let (mut depth, mut start) = (0, 0);
    for (at, c) in text.char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            _ if c == operator && depth == 0 => {
                if start < at || !text[..at].ends_with(operator) {
                    parts.push(&text[start..at]);
                }
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&text[start..]);
    parts
}

/// What lies between parentheses, if one pair encloses the whole text.
fn inside(text: &str) -> Option<&str> {
    text.starts_with('(').then(|| closing(text, 0)).flatten().filter(|end| *end + 1 == text.len())?;
    Some(&text[1..text.len() - 1])
}

/// Where the bracket that opens at `open` is closed.
pub(crate) fn closing(text: &str, open: usize) -> Option<usize> {
    let mut depth = 0;
    for (at, byte) in text.bytes().enumerate().skip(open) {
        match byte {
            b'(' | b'{' | b'[' => depth += 1,
            b')' | b'}' | b']' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some(at);
        }
    }
    None
}

/// The most brackets within each other, and the most branches of an `if`, that a text may have: many times what shaders have,
/// and few enough to be followed one within the other.
const DEEPEST: usize = 64;

/// Asserts that each bracket of a text without comments is closed by its like, and that none lies deeper than [`DEEPEST`].
pub(crate) fn check_nesting(code: &str) -> Result<(), EffectsError> {
    let line = |at: usize| 1 + code[..at].matches('\n').count();
    let error = |at: usize, reason| Err(EffectsError::Malformed { line: line(at), reason });
    let mut open: Vec<(usize, u8)> = Vec::new();
    for (at, byte) in code.bytes().enumerate() {
        match byte {
            b'(' | b'[' | b'{' if open.len() == DEEPEST => {
                return error(at, "opens more brackets within each other than the 64 that are followed");
            }
            b'(' => open.push((at, b')')),
            b'[' => open.push((at, b']')),
            b'{' => open.push((at, b'}')),
            b')' | b']' | b'}' if open.pop().is_none_or(|(_, closing)| closing != byte) => {
                return error(at, "closes a bracket that is not open; each must be closed by its like");
            }
            _ => {}
        }
    }
    if let Some((at, _)) = open.last() {
        return error(*at, "opens a bracket that is not closed; each must be closed by its like");
    }
    let chained = code.match_indices("else").find(|(at, _)| branches(code, *at) > DEEPEST);
    match chained {
        Some((at, _)) => error(at, "has more branches of one `if` than the 64 that are followed"),
        None => Ok(()),
    }
}

/// How many branches the `else` at `at` begins, one more than [`DEEPEST`] at most.
fn branches(code: &str, mut at: usize) -> usize {
    for count in 0..=DEEPEST {
        let rest = code[at + 4..].trim_start();
        let block = rest.starts_with("if").then(|| code[at..].find('{')).flatten();
        let Some(close) = block.and_then(|block| closing(code, at + block)) else { return count };
        let after = code[close + 1..].trim_start();
        if !after.starts_with("else") {
            return count + 1;
        }
        at = code.len() - after.len();
    }
    DEEPEST + 1
}

/// Whether a character may be part of a name.
pub(crate) fn is_part(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

fn is_name(text: &str) -> bool {
    !text.is_empty() && text.chars().all(is_part)
}

/// The names and numbers of a text.
pub(crate) fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !is_part(c)).filter(|word| !word.is_empty())
}

/// The text with spaces in the place of comments, byte for byte. Line comments only: the include has no
/// others.
pub(crate) fn without_comments(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let start = line.find("//").unwrap_or(line.len());
        code.push_str(&line[..start]);
        code.extend(line[start..].bytes().map(|byte| if byte == b'\n' { '\n' } else { ' ' }));
    }
    code
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Formula {
        Formula::read(text, &|name| name.starts_with("use_"))
    }

    #[test]
    fn conditions_are_read_by_precedence() {
        let switch = |name: &str| Some(name == "use_a");
        for (text, value) in [
            ("use_a", Some(true)),
            ("(use_b)", Some(false)),
            ("!use_b", Some(true)),
            ("use_b ? use_b : use_b & x", None),
            ("!(use_b | x)", None),
            ("use_b & (kind == 1u)", Some(false)),
            ("(kind == 1u) && use_b", Some(false)),
            ("use_a & (kind == 1u)", None),
            ("use_a | (kind == 1u)", Some(true)),
            ("x & use_b | use_a", Some(true)),
            ("x & (use_b | use_a)", None),
            ("!use_a == x", None),
            ("(use_b) != (x)", None),
            ("f(use_b, use_b)", None),
            ("(flags & 2u) != 0u", None),
            ("true & !false", Some(true)),
        ] {
            assert_eq!(read(text).value(&switch), value, "{text}: {:?}", read(text));
        }
    }
}
