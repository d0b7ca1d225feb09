//! The values that a kernel computes.

use std::rc::Rc;

use naga::{Handle, Module, ScalarKind, Type, TypeInner};

use super::number::{Kind, Number, Operation};
use super::program::{ExecuteError, unsupported};

/// A value or a pointer.
#[derive(Clone, Debug)]
pub(super) enum Value {
    Scalar(Number),
    Vector(usize, [Number; 4]),
    /// A structure, an array, or a matrix by columns.
    Composite(Rc<Vec<Value>>),
    /// A pointer into a local variable.
    Local {
        cell: usize,
        path: Path,
    },
    /// A pointer into a buffer.
    Buffer {
        binding: u32,
        offset: u32,
        kind: Handle<Type>,
    },
    /// A pointer to a number in a buffer.
    Word {
        binding: u32,
        offset: u32,
        kind: Kind,
    },
    /// A texture or a sampler.
    Handle(u32),
}

pub(super) const NOTHING: Number = Number::constant(0, Kind::Float);

/// Notes an operation on numbers and what it comes to.
pub(super) trait Note {
    /// See [`super::observer::Observer::AS_STATED`].
    const AS_STATED: bool;

    fn note(&mut self, operation: Operation, operands: &[Number], result: (u32, Kind)) -> Number;
}

/// The way from a variable to a part of it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Path {
    indices: [u32; 6],
    length: usize,
}

impl Path {
    pub fn indices(&self) -> &[u32] {
        &self.indices[..self.length]
    }

    /// The way on to a part of the part.
    pub fn and(mut self, index: u32) -> Result<Self, ExecuteError> {
        let Some(last) = self.indices.get_mut(self.length) else {
            return unsupported("pointer that deep into a variable");
        };
        *last = index;
        self.length += 1;
        Ok(self)
    }
}

pub(super) fn composite(parts: Vec<Value>) -> Value {
    Value::Composite(Rc::new(parts))
}

pub(super) type Outcome = Result<Value, ExecuteError>;

impl Value {
    pub fn vector(numbers: &[Number]) -> Self {
        let mut all = [NOTHING; 4];
        all[..numbers.len()].copy_from_slice(numbers);
        Self::Vector(numbers.len(), all)
    }

    /// A component of a vector; a scalar stands for a vector of itself.
    pub fn component(&self, at: usize) -> Result<Number, ExecuteError> {
        match self {
            Self::Scalar(number) => Ok(*number),
            Self::Vector(size, numbers) if at < *size => Ok(numbers[at]),
            other => unsupported(other),
        }
    }

    pub fn part(self, at: usize) -> Outcome {
        match self {
            Self::Vector(size, numbers) if at < size => Ok(Self::Scalar(numbers[at])),
            Self::Composite(parts) if at < parts.len() => Ok(parts[at].clone()),
            other => unsupported(other),
        }
    }

    pub fn set(&mut self, path: &[u32], value: Self) -> Result<(), ExecuteError> {
        let Some((first, rest)) = path.split_first() else {
            *self = value;
            return Ok(());
        };
        match (self, value) {
            (Self::Composite(parts), value) => Rc::make_mut(parts)[*first as usize].set(rest, value),
            (Self::Vector(_, numbers), Self::Scalar(number)) => {
                numbers[*first as usize] = number;
                Ok(())
            }
            (_, value) => unsupported(value),
        }
    }

    pub fn size(&self) -> Result<usize, ExecuteError> {
        match self {
            Self::Scalar(_) => Ok(1),
            Self::Vector(size, _) => Ok(*size),
            other => unsupported(other),
        }
    }
}

pub(super) fn kind(kind: ScalarKind) -> Result<Kind, ExecuteError> {
    match kind {
        ScalarKind::Float => Ok(Kind::Float),
        ScalarKind::Uint => Ok(Kind::Uint),
        ScalarKind::Sint => Ok(Kind::Sint),
        ScalarKind::Bool => Ok(Kind::Bool),
        other => unsupported(other),
    }
}

/// The value of a type whose numbers, at their offsets in memory, a function tells.
pub(super) fn read(
    module: &Module,
    handle: Handle<Type>,
    offset: u32,
    word: &mut dyn FnMut(u32, Kind) -> Result<Number, ExecuteError>,
) -> Outcome {
    match &module.types[handle].inner {
        TypeInner::Scalar(scalar) => Ok(Value::Scalar(word(offset, kind(scalar.kind)?)?)),
        TypeInner::Vector { size, scalar } => {
            let kind = kind(scalar.kind)?;
            let numbers = (0..*size as u32).map(|at| word(offset + 4 * at, kind));
            Ok(Value::vector(&numbers.collect::<Result<Vec<_>, _>>()?))
        }
        TypeInner::Matrix { columns, rows, .. } => {
            let stride = if *rows as u32 == 2 { 8 } else { 16 };
            let mut column = |at: u32| {
                let numbers = (0..*rows as u32).map(|row| word(offset + stride * at + 4 * row, Kind::Float));
                Ok(Value::vector(&numbers.collect::<Result<Vec<_>, ExecuteError>>()?))
            };
            Ok(composite((0..*columns as u32).map(&mut column).collect::<Result<_, ExecuteError>>()?))
        }
        TypeInner::Struct { members, .. } => {
            let parts = members.iter().map(|member| read(module, member.ty, offset + member.offset, word));
            Ok(composite(parts.collect::<Result<_, _>>()?))
        }
        TypeInner::Array { base, size: naga::ArraySize::Constant(count), stride } => {
            let parts = (0..count.get()).map(|at| read(module, *base, offset + at * stride, word));
            Ok(composite(parts.collect::<Result<_, _>>()?))
        }
        other => unsupported(other),
    }
}

pub(super) fn zero(module: &Module, handle: Handle<Type>) -> Outcome {
    read(module, handle, 0, &mut |_, kind| Ok(Number::constant(0, kind)))
}

pub(super) fn compose(inner: &TypeInner, parts: Vec<Value>) -> Outcome {
    match inner {
        TypeInner::Vector { .. } => {
            let mut numbers = Vec::new();
            for part in &parts {
                for at in 0..part.size()? {
                    numbers.push(part.component(at)?);
                }
            }
            Ok(Value::vector(&numbers))
        }
        // Columns may be given number by number.
        TypeInner::Matrix { rows, .. } if matches!(parts[0], Value::Scalar(_)) => {
            let numbers = parts.iter().map(|part| part.component(0)).collect::<Result<Vec<_>, _>>()?;
            Ok(composite(numbers.chunks(*rows as usize).map(Value::vector).collect()))
        }
        _ => Ok(composite(parts)),
    }
}

/// Applies an operation on numbers to each component; scalars stand for vectors of themselves.
pub(super) fn each(
    values: &[&Value],
    mut with: impl FnMut(&[Number]) -> Result<Number, ExecuteError>,
) -> Outcome {
    let mut sizes = values.iter().map(|value| value.size());
    let size = sizes.try_fold(1, |most, size| size.map(|size| most.max(size)))?;
    let mut result = [NOTHING; 4];
    for (at, number) in result[..size].iter_mut().enumerate() {
        let mut operands = [NOTHING; 3];
        for (operand, value) in operands.iter_mut().zip(values) {
            *operand = value.component(at)?;
        }
        *number = with(&operands[..values.len()])?;
    }
    let scalar = values.iter().all(|value| matches!(value, Value::Scalar(_)));
    Ok(if scalar { Value::Scalar(result[0]) } else { Value::vector(&result[..size]) })
}
