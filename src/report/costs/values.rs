//! The values that a kernel computes, and the arithmetic on them: WGSL's, each operation rounded to single precision.

use half::f16;
use naga::{
    BinaryOperator, Handle, MathFunction, Module, RelationalFunction, ScalarKind, Type, TypeInner,
    UnaryOperator,
};

use super::interpreter::{ExecuteError, unsupported};
use super::operations::{Kind, Number, Operation};

/// A value or a pointer.
#[derive(Clone, Debug)]
pub(super) enum Value {
    Scalar(Number),
    Vector(usize, [Number; 4]),
    /// A structure, an array, or a matrix by columns.
    Composite(Vec<Value>),
    /// A pointer into a local variable.
    Local {
        cell: usize,
        path: Vec<u32>,
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

const NOTHING: Number = Number::constant(0, Kind::Float);

/// Notes an operation on numbers and what it comes to.
pub(super) trait Note: FnMut(Operation, &[Number], (u32, Kind)) -> Number {}
impl<F: FnMut(Operation, &[Number], (u32, Kind)) -> Number> Note for F {}

type Outcome = Result<Value, ExecuteError>;

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
            Self::Composite(mut parts) if at < parts.len() => Ok(parts.swap_remove(at)),
            other => unsupported(other),
        }
    }

    pub fn set(&mut self, path: &[u32], value: Self) -> Result<(), ExecuteError> {
        let Some((first, rest)) = path.split_first() else {
            *self = value;
            return Ok(());
        };
        match (self, value) {
            (Self::Composite(parts), value) => parts[*first as usize].set(rest, value),
            (Self::Vector(_, numbers), Self::Scalar(number)) => {
                numbers[*first as usize] = number;
                Ok(())
            }
            (_, value) => unsupported(value),
        }
    }

    fn size(&self) -> Result<usize, ExecuteError> {
        match self {
            Self::Scalar(_) => Ok(1),
            Self::Vector(size, _) => Ok(*size),
            other => unsupported(other),
        }
    }
}

/// A texture array of half-precision texels, filtered linearly and clamped to its edge.
#[derive(Clone, Debug)]
pub struct Texels {
    size: usize,
    texels: Vec<[f32; 4]>,
}

impl Texels {
    /// Layers of `size` by `size` texels as a table's file holds them.
    pub fn new(size: usize, bytes: &[u8]) -> Self {
        let half = |bytes: &[u8]| f16::from_le_bytes([bytes[0], bytes[1]]).to_f32();
        let texel = |bytes: &[u8]| [0, 2, 4, 6].map(|at| half(&bytes[at..]));
        Self { size, texels: bytes.chunks_exact(8).map(texel).collect() }
    }

    pub(super) fn sample(&self, x: f32, y: f32, layer: usize) -> [f32; 4] {
        let place = |at: f32| {
            let scaled = at * self.size as f32 - 0.5;
            let low = scaled.floor();
            let edge = |index: f32| index.clamp(0.0, self.size as f32 - 1.0) as usize;
            (edge(low), edge(low + 1.0), scaled - low)
        };
        let ((left, right, u), (top, bottom, v)) = (place(x), place(y));
        let layer = layer.min(self.texels.len() / (self.size * self.size) - 1);
        let at = |x: usize, y: usize| self.texels[(layer * self.size + y) * self.size + x];
        let blend = |a: [f32; 4], b: [f32; 4], t: f32| [0, 1, 2, 3].map(|i| a[i] + (b[i] - a[i]) * t);
        blend(blend(at(left, top), at(right, top), u), blend(at(left, bottom), at(right, bottom), u), v)
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
            Ok(Value::Composite((0..*columns as u32).map(&mut column).collect::<Result<_, ExecuteError>>()?))
        }
        TypeInner::Struct { members, .. } => {
            let parts = members.iter().map(|member| read(module, member.ty, offset + member.offset, word));
            Ok(Value::Composite(parts.collect::<Result<_, _>>()?))
        }
        TypeInner::Array { base, size: naga::ArraySize::Constant(count), stride } => {
            let parts = (0..count.get()).map(|at| read(module, *base, offset + at * stride, word));
            Ok(Value::Composite(parts.collect::<Result<_, _>>()?))
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
            Ok(Value::Composite(numbers.chunks(*rows as usize).map(Value::vector).collect()))
        }
        _ => Ok(Value::Composite(parts)),
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
        let operands = values.iter().map(|value| value.component(at)).collect::<Result<Vec<_>, _>>()?;
        *number = with(&operands)?;
    }
    let scalar = values.iter().all(|value| matches!(value, Value::Scalar(_)));
    Ok(if scalar { Value::Scalar(result[0]) } else { Value::vector(&result[..size]) })
}

fn float(value: f32) -> (u32, Kind) {
    (value.to_bits(), Kind::Float)
}

pub(super) fn unary(operator: UnaryOperator, n: Number) -> Result<(u32, Kind), ExecuteError> {
    Ok(match (operator, n.kind) {
        (UnaryOperator::Negate, Kind::Float) => float(-n.float()),
        (UnaryOperator::Negate, kind) => (n.bits.wrapping_neg(), kind),
        (UnaryOperator::LogicalNot, _) => (u32::from(!n.truth()), Kind::Bool),
        (UnaryOperator::BitwiseNot, kind) => (!n.bits, kind),
    })
}

fn scalar_binary(operator: BinaryOperator, a: Number, b: Number) -> Result<(u32, Kind), ExecuteError> {
    use BinaryOperator as B;
    let truth = |value: bool| (u32::from(value), Kind::Bool);
    let order = match a.kind {
        Kind::Float => a.float().partial_cmp(&b.float()),
        Kind::Sint => Some((a.bits as i32).cmp(&(b.bits as i32))),
        Kind::Uint | Kind::Bool => Some(a.bits.cmp(&b.bits)),
    };
    Ok(match (operator, a.kind) {
        (B::Equal, _) => truth(order.is_some_and(|order| order.is_eq())),
        (B::NotEqual, _) => truth(!order.is_some_and(|order| order.is_eq())),
        (B::Less, _) => truth(order.is_some_and(|order| order.is_lt())),
        (B::LessEqual, _) => truth(order.is_some_and(|order| order.is_le())),
        (B::Greater, _) => truth(order.is_some_and(|order| order.is_gt())),
        (B::GreaterEqual, _) => truth(order.is_some_and(|order| order.is_ge())),
        (B::Add, Kind::Float) => float(a.float() + b.float()),
        (B::Subtract, Kind::Float) => float(a.float() - b.float()),
        (B::Multiply, Kind::Float) => float(a.float() * b.float()),
        (B::Divide, Kind::Float) => float(a.float() / b.float()),
        (B::Modulo, Kind::Float) => float(a.float() % b.float()),
        (B::Add, kind) => (a.bits.wrapping_add(b.bits), kind),
        (B::Subtract, kind) => (a.bits.wrapping_sub(b.bits), kind),
        (B::Multiply, kind) => (a.bits.wrapping_mul(b.bits), kind),
        (B::Divide, Kind::Uint) => (a.bits.checked_div(b.bits).unwrap_or(a.bits), a.kind),
        (B::Modulo, Kind::Uint) => (a.bits.checked_rem(b.bits).unwrap_or(0), a.kind),
        (B::Divide, Kind::Sint) => {
            ((a.bits as i32).checked_div(b.bits as i32).unwrap_or(a.bits as i32) as u32, a.kind)
        }
        (B::Modulo, Kind::Sint) => ((a.bits as i32).checked_rem(b.bits as i32).unwrap_or(0) as u32, a.kind),
        (B::And | B::LogicalAnd, kind) => (a.bits & b.bits, kind),
        (B::InclusiveOr | B::LogicalOr, kind) => (a.bits | b.bits, kind),
        (B::ExclusiveOr, kind) => (a.bits ^ b.bits, kind),
        (B::ShiftLeft, kind) => (a.bits.wrapping_shl(b.bits), kind),
        (B::ShiftRight, Kind::Sint) => ((a.bits as i32).wrapping_shr(b.bits) as u32, a.kind),
        (B::ShiftRight, kind) => (a.bits.wrapping_shr(b.bits), kind),
        other => return unsupported(other),
    })
}

pub(super) fn binary(operator: BinaryOperator, left: &Value, right: &Value, note: &mut impl Note) -> Outcome {
    use BinaryOperator as B;
    match (left, right) {
        (Value::Composite(columns), Value::Vector(..)) if operator == B::Multiply => {
            let mut sum: Option<Value> = None;
            for (at, column) in columns.iter().enumerate() {
                let term = binary(B::Multiply, column, &Value::Scalar(right.component(at)?), note)?;
                sum = Some(match sum {
                    Some(sum) => binary(B::Add, &sum, &term, note)?,
                    None => term,
                });
            }
            sum.map_or_else(|| unsupported("empty matrix"), Ok)
        }
        (Value::Vector(..), Value::Composite(columns)) if operator == B::Multiply => {
            let dots =
                columns.iter().map(|column| math(MathFunction::Dot, &[left.clone(), column.clone()], note));
            let dots = dots.map(|dot| dot?.component(0)).collect::<Result<Vec<_>, _>>()?;
            Ok(Value::vector(&dots))
        }
        (Value::Composite(_), Value::Composite(columns)) if operator == B::Multiply => {
            let columns = columns.iter().map(|column| binary(operator, left, column, note));
            Ok(Value::Composite(columns.collect::<Result<_, _>>()?))
        }
        (Value::Composite(columns), Value::Scalar(_)) if operator == B::Multiply => {
            let columns = columns.iter().map(|column| binary(operator, column, right, note));
            Ok(Value::Composite(columns.collect::<Result<_, _>>()?))
        }
        (Value::Scalar(_), Value::Composite(_)) if operator == B::Multiply => {
            binary(operator, right, left, note)
        }
        (Value::Composite(left), Value::Composite(right)) => {
            let columns = left.iter().zip(right).map(|(left, right)| binary(operator, left, right, note));
            Ok(Value::Composite(columns.collect::<Result<_, _>>()?))
        }
        _ => each(&[left, right], |n| {
            Ok(note(Operation::Binary(operator), n, scalar_binary(operator, n[0], n[1])?))
        }),
    }
}

pub(super) fn relational(fun: RelationalFunction, argument: &Value, note: &mut impl Note) -> Outcome {
    let operator = match fun {
        RelationalFunction::Any => BinaryOperator::InclusiveOr,
        RelationalFunction::All => BinaryOperator::And,
        other => return unsupported(other),
    };
    let mut result = argument.component(0)?;
    for at in 1..argument.size()? {
        let next = argument.component(at)?;
        let outcome = scalar_binary(operator, result, next)?;
        result = note(Operation::Binary(operator), &[result, next], outcome);
    }
    Ok(Value::Scalar(result))
}

pub(super) fn convert(
    n: Number,
    to: ScalarKind,
    by_value: bool,
) -> Result<(Operation, (u32, Kind)), ExecuteError> {
    let to = kind(to)?;
    if !by_value {
        return Ok((Operation::Bitcast(to), (n.bits, to)));
    }
    let bits = match (n.kind, to) {
        (Kind::Float, Kind::Uint) => n.float() as u32,
        (Kind::Float, Kind::Sint) => n.float() as i32 as u32,
        (Kind::Uint, Kind::Float) => (n.bits as f32).to_bits(),
        (Kind::Sint, Kind::Float) => (n.bits as i32 as f32).to_bits(),
        (Kind::Bool, Kind::Float) => f32::from(u8::from(n.truth())).to_bits(),
        (Kind::Float, Kind::Bool) => u32::from(n.float() != 0.0),
        (_, Kind::Bool) => u32::from(n.bits != 0),
        _ => n.bits,
    };
    let whole = matches!((n.kind, to), (Kind::Uint, Kind::Sint) | (Kind::Sint, Kind::Uint));
    Ok((if whole { Operation::Bitcast(to) } else { Operation::Convert(to) }, (bits, to)))
}

fn scalar_math(function: MathFunction, n: &[Number]) -> Result<(u32, Kind), ExecuteError> {
    use MathFunction as M;
    let a = n[0];
    if a.kind != Kind::Float {
        let signed = a.kind == Kind::Sint;
        let above = |b: &Number| if signed { a.bits as i32 > b.bits as i32 } else { a.bits > b.bits };
        return Ok(match function {
            M::Max => (if above(&n[1]) { a.bits } else { n[1].bits }, a.kind),
            M::Min => (if above(&n[1]) { n[1].bits } else { a.bits }, a.kind),
            M::Abs if signed => ((a.bits as i32).wrapping_abs() as u32, a.kind),
            M::Abs => (a.bits, a.kind),
            other => return unsupported(other),
        });
    }
    let (x, y) = (a.float(), n.get(1).map_or(0.0, |b| b.float()));
    Ok(float(match function {
        M::Abs => x.abs(),
        M::Min => x.min(y),
        M::Max => x.max(y),
        M::Saturate => x.clamp(0.0, 1.0),
        M::Cos => x.cos(),
        M::Sin => x.sin(),
        M::Tan => x.tan(),
        M::Acos => x.acos(),
        M::Asin => x.asin(),
        M::Atan => x.atan(),
        M::Atan2 => x.atan2(y),
        M::Ceil => x.ceil(),
        M::Floor => x.floor(),
        M::Round => x.round_ties_even(),
        M::Trunc => x.trunc(),
        M::Fract => x - x.floor(),
        M::Exp => x.exp(),
        M::Exp2 => x.exp2(),
        M::Log => x.ln(),
        M::Log2 => x.log2(),
        M::Pow => x.powf(y),
        M::Sign => f32::from(i8::from(x > 0.0) - i8::from(x < 0.0)),
        M::Sqrt => x.sqrt(),
        M::InverseSqrt => 1.0 / x.sqrt(),
        other => return unsupported(other),
    }))
}

pub(super) fn math(function: MathFunction, arguments: &[Value], note: &mut impl Note) -> Outcome {
    use BinaryOperator as B;
    use MathFunction as M;
    let [a, b, c] = [0, 1, 2].map(|at| arguments.get(at).unwrap_or(&arguments[0]));
    match function {
        M::Dot => {
            let mut sum = None;
            for at in 0..a.size()? {
                let [x, y] = [a, b].map(|value| value.component(at).map(Value::Scalar));
                let term = binary(B::Multiply, &x?, &y?, note)?;
                sum = Some(match sum {
                    Some(sum) => binary(B::Add, &sum, &term, note)?,
                    None => term,
                });
            }
            sum.map_or_else(|| unsupported("empty vector"), Ok)
        }
        M::Cross => {
            let turned = |value: &Value, by: usize| -> Outcome {
                let numbers = (0..3).map(|at| value.component((at + by) % 3));
                Ok(Value::vector(&numbers.collect::<Result<Vec<_>, _>>()?))
            };
            let left = binary(B::Multiply, &turned(a, 1)?, &turned(b, 2)?, note)?;
            let right = binary(B::Multiply, &turned(a, 2)?, &turned(b, 1)?, note)?;
            binary(B::Subtract, &left, &right, note)
        }
        M::Length => {
            let squared = math(M::Dot, &[a.clone(), a.clone()], note)?;
            math(M::Sqrt, &[squared], note)
        }
        M::Distance => {
            let difference = binary(B::Subtract, a, b, note)?;
            math(M::Length, &[difference], note)
        }
        M::Normalize => {
            let squared = math(M::Dot, &[a.clone(), a.clone()], note)?;
            let inverse = math(M::InverseSqrt, &[squared], note)?;
            binary(B::Multiply, a, &inverse, note)
        }
        M::Reflect => {
            let along = math(M::Dot, &[b.clone(), a.clone()], note)?;
            let twice = binary(B::Multiply, &along, &Value::Scalar(constant_float(2.0)), note)?;
            let step = binary(B::Multiply, b, &twice, note)?;
            binary(B::Subtract, a, &step, note)
        }
        M::Mix => {
            let difference = binary(B::Subtract, b, a, note)?;
            let step = binary(B::Multiply, &difference, c, note)?;
            binary(B::Add, a, &step, note)
        }
        M::Step => {
            let above = binary(B::GreaterEqual, b, a, note)?;
            let [zero, one] = [0.0_f32, 1.0].map(|value| Value::Scalar(constant_float(value)));
            each(&[&above, &one, &zero], |n| {
                let chosen = if n[0].truth() { n[1] } else { n[2] };
                Ok(note(Operation::Select, n, (chosen.bits, chosen.kind)))
            })
        }
        M::SmoothStep => {
            let along = binary(B::Subtract, c, a, note)?;
            let whole = binary(B::Subtract, b, a, note)?;
            let t = math(M::Saturate, &[binary(B::Divide, &along, &whole, note)?], note)?;
            let double = binary(B::Multiply, &t, &Value::Scalar(constant_float(2.0)), note)?;
            let rest = binary(B::Subtract, &Value::Scalar(constant_float(3.0)), &double, note)?;
            let squared = binary(B::Multiply, &t, &t, note)?;
            binary(B::Multiply, &squared, &rest, note)
        }
        M::Radians | M::Degrees => {
            let factor = if function == M::Radians { 1.0_f32.to_radians() } else { 1.0_f32.to_degrees() };
            binary(B::Multiply, a, &Value::Scalar(constant_float(factor)), note)
        }
        M::Fma => {
            let product = binary(B::Multiply, a, b, note)?;
            binary(B::Add, &product, c, note)
        }
        M::Clamp => {
            let bounds = [b, c].map(|bound| bound.component(0));
            let zero_to_one = matches!(bounds, [Ok(low), Ok(high)] if low.node + high.node == 0
                && low.kind == Kind::Float && low.float() == 0.0 && high.float() == 1.0);
            if zero_to_one {
                return math(M::Saturate, core::slice::from_ref(a), note);
            }
            let low = math(M::Max, &[a.clone(), b.clone()], note)?;
            math(M::Min, &[low, c.clone()], note)
        }
        M::Transpose => {
            let Value::Composite(columns) = a else { return unsupported(a) };
            let row = |at: usize| {
                let numbers = columns.iter().map(|column| column.component(at));
                Ok(Value::vector(&numbers.collect::<Result<Vec<_>, ExecuteError>>()?))
            };
            Ok(Value::Composite((0..columns[0].size()?).map(row).collect::<Result<_, ExecuteError>>()?))
        }
        _ => {
            let operands: Vec<&Value> = arguments.iter().collect();
            each(&operands, |n| Ok(note(Operation::Math(function), n, scalar_math(function, n)?)))
        }
    }
}

fn constant_float(value: f32) -> Number {
    Number::constant(value.to_bits(), Kind::Float)
}
