//! Numbers of an interpreted kernel, and the operations that make them.

use naga::{BinaryOperator, MathFunction, UnaryOperator};

/// What a number is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Kind {
    Float,
    Uint,
    Sint,
    Bool,
}

/// A number and what made it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Number {
    pub bits: u32,
    pub kind: Kind,
    /// Index of the operation; 0 for what is known before the program runs.
    pub node: u32,
}

impl Number {
    pub const fn constant(bits: u32, kind: Kind) -> Self {
        Self { bits, kind, node: 0 }
    }
    pub fn float(self) -> f32 {
        f32::from_bits(self.bits)
    }
    pub fn truth(self) -> bool {
        self.bits != 0
    }
    pub fn is(self, value: f32) -> bool {
        self.node == 0 && self.kind == Kind::Float && self.float() == value
    }
}

/// An operation on up to three numbers. Those on vectors have been taken apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Operation {
    /// The word of that offset in the buffer of that binding.
    Load(u32, u32),
    /// A sample of the texture of that binding.
    Sample(u32),
    /// A component of it.
    Component(u32),
    Unary(UnaryOperator),
    Binary(BinaryOperator),
    Math(MathFunction),
    /// A step of a loop's counter.
    Turn,
    Select,
    Convert(Kind),
    Bitcast(Kind),
    Branch,
}
