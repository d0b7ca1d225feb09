//! What a kernel does that WGSL promises nothing about.

use core::fmt;

/// What is wrong with an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Concern {
    /// The result is no number.
    NotANumber,
    /// The result is infinite, or may be rounded to infinity.
    Infinite,
    /// A divisor is smaller in magnitude than 2^-126 or larger than 2^126.
    Divisor,
    /// A root, an inverse root or a logarithm of a number below zero.
    Negative,
    /// An inverse root or a logarithm of zero.
    Zero,
    /// A square root of zero, whose accuracy is that of 1 over the inverse root, which is infinite. Devices return zero.
    RootOfZero,
    /// An operand of another function for which its accuracy is not stated.
    Domain,
    /// A comparison, a minimum or a maximum of what is no number: a device may assume that there is none.
    Compared,
    /// A number converted to an integer type that does not hold it.
    Converted,
    /// A texture coordinate that is infinite or no number.
    Coordinate,
}

impl fmt::Display for Concern {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str(match self {
            Self::NotANumber => "a result that is no number",
            Self::Infinite => "a result that is or may be infinite",
            Self::Divisor => "a divisor outside 2^-126 to 2^126",
            Self::Negative => "a root or logarithm of a number below zero",
            Self::Zero => "an inverse root or logarithm of zero",
            Self::RootOfZero => "a square root of zero",
            Self::Domain => "an operand for which no accuracy is stated",
            Self::Compared => "a comparison with what is no number",
            Self::Converted => "a number that the integer type does not hold",
            Self::Coordinate => "a texture coordinate that is not finite",
        })
    }
}

/// An operation of an invocation that leaves what WGSL promises.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What is wrong.
    pub concern: Concern,
    /// The line of the source text, from 1.
    pub line: u32,
    /// The operands.
    pub operands: Vec<f32>,
    /// What the operation came to.
    pub result: f32,
    /// Whether what the kernel writes or the way that it takes depends on the result. What flows into the side of a `select`
    /// that is not chosen does not.
    pub matters: bool,
    /// Whether the operation is in the text; otherwise the device made it by putting others in another order.
    pub in_text: bool,
    /// The operation's number in the trace.
    pub(super) node: u32,
}

impl fmt::Display for Finding {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        let Self { concern, line, operands, result, .. } = self;
        write!(formatter, "line {line}: {concern}: {result:e} of {operands:?}")?;
        if !self.matters {
            formatter.write_str(", which nothing depends on")?;
        }
        if !self.in_text {
            formatter.write_str(", in another order than that of the text")?;
        }
        Ok(())
    }
}
