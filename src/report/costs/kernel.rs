//! The kernels whose costs are measured.

use std::borrow::Cow;

use crate::effects::{Effect, Effects, Quality};
use crate::report::compare;
use crate::{TABLE_SIZE, WGSL_INCLUDE};

/// What evaluates a method on an array of surface points and quads; to be appended to a text that defines
/// `method_value`.
pub const MEASURE: &str = include_str!("../../../wgsl/compare/measure.wgsl");

/// The compute entry point of [`MEASURE`].
pub const COMPUTE: &str = "compare_quads";
/// Its fragment entry point.
pub const FRAGMENT: &str = "compare_fragment";
/// Its vertex entry point.
pub const VERTEX: &str = "compare_vertex";

/// The method whose costs are 1 in every ratio.
pub const BASELINE: &str = "published";

/// A method as a kernel.
#[derive(Clone, Debug)]
pub struct Kernel {
    /// The method's name.
    pub name: String,
    /// WGSL that defines `method_value` and what that calls.
    pub method: String,
    /// The include's switches.
    pub effects: Effects,
    /// Layers of 64 × 64 RGBA16F texels that the method reads.
    pub table: Cow<'static, [u8]>,
}

impl Kernel {
    /// A method that stands for itself, with the table that it reads.
    pub fn own(name: &str, method: &str, table: impl Into<Cow<'static, [u8]>>) -> Self {
        Self { name: name.to_owned(), method: method.to_owned(), effects: Effects::NONE, table: table.into() }
    }

    /// A method by the include with some effects.
    pub fn level(name: &str, method: &str, effects: Effects, table: impl Into<Cow<'static, [u8]>>) -> Self {
        let method = format!("{WGSL_INCLUDE}\n{method}");
        Self { name: name.to_owned(), method, effects, table: table.into() }
    }

    /// The method of a name: a quality level of the include, or a comparator.
    pub fn of(name: &str) -> Option<Self> {
        let method = compare::wgsl(name)?;
        let table = compare::table(name).bytes();
        Some(match compare::level(name) {
            Some(effects) => Self::level(name, method, effects, table),
            None => Self::own(name, method, table),
        })
    }

    /// The quality levels, whose costs the baseline holds, and the method that others are compared with.
    pub fn levels() -> Vec<Self> {
        let names = Quality::ALL.iter().map(|level| level.name());
        names.chain([BASELINE]).filter_map(Self::of).collect()
    }

    /// Everything that costs something: the quality levels and the comparators.
    pub fn all() -> Vec<Self> {
        let levels = Quality::ALL.iter().map(|level| level.name().to_owned());
        let comparators = compare::comparators().into_iter().map(|method| method.info().name);
        levels.chain(comparators).filter_map(|name| Self::of(&name)).collect()
    }

    /// The whole text.
    pub fn source(&self) -> String {
        format!("{}\n{MEASURE}", self.method)
    }

    /// Whether the method has loops of its own, or asks the include for the one over several lobes, of which a compiler that
    /// runs nothing can only guess how often they turn.
    pub fn has_loops(&self) -> bool {
        if self.effects.contains(Effect::SecondLobe) {
            return true;
        }
        let own = self.method.strip_prefix(WGSL_INCLUDE).unwrap_or(&self.method);
        ["for (", "while (", "loop {"].iter().any(|word| own.contains(word))
    }

    /// Layers of the table.
    pub fn layers(&self) -> usize {
        (self.table.len() / (8 * TABLE_SIZE * TABLE_SIZE)).max(1)
    }
}

/// Index of the kernel that others are compared with: [`BASELINE`], or the first where that is not there.
pub fn baseline(kernels: &[Kernel]) -> usize {
    kernels.iter().position(|kernel| kernel.name == BASELINE).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn methods_have_names_of_their_own_and_loops_are_seen() {
        let mut names: Vec<String> = Kernel::all().into_iter().map(|kernel| kernel.name).collect();
        let count = names.len();
        names.sort();
        names.dedup();
        assert!(count == names.len() && count >= 12, "{names:?}");
        let standard = Kernel::of("standard").expect("a level");
        assert!(!standard.has_loops(), "the include's loops are not the method's");
        assert!(Kernel::of("fine").expect("a level").has_loops(), "one over lobes");
        assert!(Kernel::own("looping", "for (var i = 0; i < 3; i++) {}", Vec::new()).has_loops());
        assert_eq!(standard.layers(), 2);
    }
}
