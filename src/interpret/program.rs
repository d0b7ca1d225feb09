//! Kernels as they are run, and what is bound to them.

use std::collections::BTreeMap;
use std::sync::Arc;

use naga::{EntryPoint, Function, Module};

use super::number::{Kind, Number, Operation};
use super::observer::{Observer, Place};
use super::run::Context;
use super::texels::Texels;
use super::values::Value;
use crate::effects::Effects;
use crate::translate::{TranslateError, kernel_module};

/// Why a kernel could not be run.
#[derive(Debug, thiserror::Error)]
pub enum ExecuteError {
    /// It is no valid WGSL.
    #[error("{0}")]
    Invalid(#[from] TranslateError),
    /// It has something that the interpreter lacks.
    #[error("the interpreter of src/interpret has no {0}")]
    Unsupported(String),
    /// It reads or writes what is not there.
    #[error("the kernel uses {0}, which it has not been given")]
    Missing(String),
    /// It has run more statements than any kernel should.
    #[error(
        "the kernel does not end: at line {line} it has run {STATEMENTS} statements, and should by then have written its result"
    )]
    Endless {
        /// The line of the source text at which it was stopped.
        line: u32,
    },
}

pub(super) fn unsupported<T>(what: impl core::fmt::Debug) -> Result<T, ExecuteError> {
    Err(ExecuteError::Unsupported(format!("{what:?}")))
}

/// What is bound to a kernel of group 0.
#[derive(Clone, Debug)]
pub(crate) enum Resource {
    /// Of one machine alone, which may write to it.
    Buffer(Vec<u8>),
    /// Read by several machines.
    Shared(Arc<[u8]>),
    Texels(Arc<Texels>),
}

/// A kernel that can be run.
#[derive(Debug)]
pub(crate) struct Program {
    module: Module,
    /// The lines of the source text at which the expressions of each function start, 0 where that is not known; those of the
    /// entry point come last.
    lines: Vec<Vec<u32>>,
    /// How many expressions come before those of each function.
    firsts: Vec<u32>,
}

/// What changes while a kernel runs.
pub(crate) struct Machine<O> {
    pub resources: BTreeMap<u32, Resource>,
    pub observer: O,
    pub cells: Vec<Value>,
    /// How many more statements may be run, see [`STATEMENTS`].
    pub left: u64,
}

/// Statements that an invocation may run: far more than any kernel here needs, so that more means one that does not end.
pub const STATEMENTS: u64 = 1 << 22;

impl<O> Machine<O> {
    pub fn new(observer: O) -> Self {
        Self { resources: BTreeMap::new(), observer, cells: Vec::new(), left: STATEMENTS }
    }
}

impl Program {
    /// A kernel of a WGSL text with the switches of a set of effects.
    ///
    /// # Errors
    ///
    /// If the text is not valid or has no such entry point.
    pub fn new(source: &str, entry_point: &str, effects: Effects) -> Result<Self, ExecuteError> {
        let (module, _) = kernel_module(source, entry_point, effects)?;
        let starts: Vec<usize> = source.match_indices('\n').map(|(at, _)| at).collect();
        let lines = |function: &Function| -> Vec<u32> {
            let spans = function.expressions.iter().map(|(handle, _)| function.expressions.get_span(handle));
            let line = |start: usize| starts.partition_point(|end| *end < start) as u32 + 1;
            spans.map(|span| span.to_range().map_or(0, |range| line(range.start))).collect()
        };
        let mut all: Vec<Vec<u32>> = module.functions.iter().map(|(_, function)| lines(function)).collect();
        all.extend(module.entry_points.iter().map(|entry_point| lines(&entry_point.function)));
        let mut count = 0;
        let firsts = all.iter().map(|lines| {
            count += lines.len() as u32;
            count - lines.len() as u32
        });
        let firsts = firsts.collect();
        Ok(Self { module, lines: all, firsts })
    }

    /// Runs the invocation of the given number.
    ///
    /// # Errors
    ///
    /// If the kernel has something that the interpreter lacks, uses what is not there, or does not end.
    pub fn run<O: Observer>(&self, machine: &mut Machine<O>, invocation: u32) -> Result<(), ExecuteError> {
        let Some(EntryPoint { function, .. }) = self.module.entry_points.first() else {
            return unsupported("kernel without an entry point");
        };
        machine.cells.clear();
        machine.left = STATEMENTS;
        machine.observer.begin();
        // Which invocation it is, is not known beforehand: it is read like a word of a buffer.
        let load = Operation::Load(u32::MAX, 0);
        let number = machine.observer.note(load, &[], (invocation, Kind::Uint), Place::default());
        let zero = Number::constant(0, Kind::Uint);
        let arguments = vec![Value::vector(&[number, zero, zero])];
        let mut context = Context {
            module: &self.module,
            lines: &self.lines,
            firsts: &self.firsts,
            line: 0,
            expression: 0,
            on: machine,
        };
        context.call((function, self.lines.len() - 1), arguments, 0, 0)?;
        Ok(())
    }
}
