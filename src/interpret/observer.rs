//! What is done with the operations that an interpreted kernel runs.

use super::number::{Kind, Number, Operation};
use super::texels::Texels;

/// Where an operation stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Place {
    /// Number of the place in the program that [`Observer::site`] gave it.
    pub site: u32,
    /// Line of the source text, from 1; 0 where that is not known.
    pub line: u32,
    /// Number of the expression among those of the program.
    pub expression: u32,
}

/// Decides what each operation comes to, and keeps what it wants to know of it.
pub(crate) trait Observer {
    /// Whether built-in functions for which WGSL states an expression are run as that expression; otherwise they are run as
    /// compilers take them apart.
    const AS_STATED: bool;

    /// A new invocation starts.
    fn begin(&mut self);

    /// An operation has been run; `result` is what single precision, rounded to nearest, makes of it.
    fn note(
        &mut self,
        operation: Operation,
        operands: &[Number],
        result: (u32, Kind),
        place: Place,
    ) -> Number;

    /// A texture has been asked for its value at a coordinate.
    fn sample(
        &mut self,
        binding: u32,
        texels: &Texels,
        coordinate: [Number; 2],
        layer: Number,
        place: Place,
    ) -> [Number; 4];

    /// The program went one of two ways by a condition.
    fn branch(&mut self, condition: Number, place: Place);

    /// A number has been written to a buffer.
    fn written(&mut self, number: Number);

    /// The number of the `part`-th part of what lies at an address of the program, within another place, in a call. Those
    /// who tell no places apart need not.
    fn site(&mut self, _around: u32, _call: u32, _address: usize, _part: u8) -> u32 {
        0
    }
}
