//! The arithmetic on values: WGSL's, each operation rounded to the nearest number of single precision.

use naga::{BinaryOperator, MathFunction, RelationalFunction, ScalarKind, UnaryOperator};

use super::number::{Kind, Number, Operation};
use super::program::{ExecuteError, unsupported};
use super::values::{Note, Outcome, Value, composite, each, kind};

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
            Ok(composite(columns.collect::<Result<_, _>>()?))
        }
        (Value::Composite(columns), Value::Scalar(_)) if operator == B::Multiply => {
            let columns = columns.iter().map(|column| binary(operator, column, right, note));
            Ok(composite(columns.collect::<Result<_, _>>()?))
        }
        (Value::Scalar(_), Value::Composite(_)) if operator == B::Multiply => {
            binary(operator, right, left, note)
        }
        (Value::Composite(left), Value::Composite(right)) => {
            let columns =
                left.iter().zip(right.iter()).map(|(left, right)| binary(operator, left, right, note));
            Ok(composite(columns.collect::<Result<_, _>>()?))
        }
        _ => each(&[left, right], |n| {
            Ok(note.note(Operation::Binary(operator), n, scalar_binary(operator, n[0], n[1])?))
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
        result = note.note(Operation::Binary(operator), &[result, next], outcome);
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

pub(super) fn math<N: Note>(function: MathFunction, arguments: &[Value], note: &mut N) -> Outcome {
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
        M::Length if matches!(a, Value::Scalar(_)) => math(M::Abs, core::slice::from_ref(a), note),
        M::Length => {
            let squared = math(M::Dot, &[a.clone(), a.clone()], note)?;
            math(M::Sqrt, &[squared], note)
        }
        M::Distance => {
            let difference = binary(B::Subtract, a, b, note)?;
            math(M::Length, &[difference], note)
        }
        M::Normalize => {
            if N::AS_STATED {
                let length = math(M::Length, core::slice::from_ref(a), note)?;
                return binary(B::Divide, a, &length, note);
            }
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
        M::Mix if N::AS_STATED => {
            let rest = binary(B::Subtract, &Value::Scalar(constant_float(1.0)), c, note)?;
            let first = binary(B::Multiply, a, &rest, note)?;
            let second = binary(B::Multiply, b, c, note)?;
            binary(B::Add, &first, &second, note)
        }
        M::Tan if N::AS_STATED => {
            let sine = math(M::Sin, core::slice::from_ref(a), note)?;
            let cosine = math(M::Cos, core::slice::from_ref(a), note)?;
            binary(B::Divide, &sine, &cosine, note)
        }
        M::Pow if N::AS_STATED => {
            let logarithm = math(M::Log2, core::slice::from_ref(a), note)?;
            let exponent = binary(B::Multiply, b, &logarithm, note)?;
            math(M::Exp2, &[exponent], note)
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
                Ok(note.note(Operation::Select, n, (chosen.bits, chosen.kind)))
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
            Ok(composite((0..columns[0].size()?).map(row).collect::<Result<_, ExecuteError>>()?))
        }
        _ => {
            let operands: Vec<&Value> = arguments.iter().collect();
            each(&operands, |n| Ok(note.note(Operation::Math(function), n, scalar_math(function, n)?)))
        }
    }
}

fn constant_float(value: f32) -> Number {
    Number::constant(value.to_bits(), Kind::Float)
}
