//! A device that decides each operation by a policy.

use naga::{BinaryOperator, MathFunction, UnaryOperator};

use super::super::number::{Kind, Number, Operation};
use super::super::observer::{Observer, Place};
use super::super::random::Random;
use super::super::texels::Texels;
use super::finding::{Concern, Finding};
use super::permitted::{self, Exact, Permitted};
use super::policy::{Filter, Freedom, Policy, Rounding};
use super::trace::{Made, Node, Slope, Term, Trace};

/// Runs an invocation as a policy says and keeps what it finds.
#[derive(Debug, Default)]
pub struct Device {
    pub policy: Policy,
    pub trace: Trace,
    /// Chooses what is done in which order, so that this is the same for every rounding.
    pub order: Random,
    /// Chooses among permitted results.
    values: Random,
    /// Where the operations that are run stand.
    place: Place,
    /// Whether they are those of the text.
    pub in_text: bool,
    /// For each operation whether its result shall be the largest or the least permitted one, and what kind it has to be.
    directions: Option<(Vec<i8>, Vec<u8>)>,
    pub findings: Vec<Finding>,
    /// What has been written to buffers, in order.
    pub written: Vec<Number>,
    /// Conditions of branches.
    conditions: Vec<u32>,
    /// What textures gave, with binding and layer.
    pub sampled: Vec<(u32, u32, [f32; 4])>,
    /// Where the last sample was taken: the bits of the coordinate, and the place in texels with its operation.
    sampled_at: Option<([u32; 2], [InTexels; 2])>,
}

impl Device {
    /// Makes it a device of a policy for the next invocation.
    pub fn prepare(&mut self, policy: Policy, with_slopes: bool, directions: Option<(Vec<i8>, Vec<u8>)>) {
        self.policy = policy;
        self.trace.with_slopes = with_slopes;
        self.directions = directions;
    }

    /// Whether it makes use of a freedom; `what` tells it from others in the same place.
    pub fn may(&mut self, freedom: Freedom, what: u64) -> bool {
        match freedom {
            Freedom::Never => false,
            Freedom::Always => true,
            Freedom::Either => self.coin(what),
        }
    }

    /// One of two ways to do something here.
    pub fn coin(&mut self, what: u64) -> bool {
        if self.policy.consistent {
            Random::of([self.policy.seed, u64::from(self.place.expression), what]) >> 63 == 1
        } else {
            self.order.coin()
        }
    }

    /// A number as an operation reads it.
    pub fn flushed(&mut self, number: Number) -> Number {
        if number.kind == Kind::Float && number.float().is_subnormal() && self.may(self.policy.flushing, 1) {
            return Number { bits: number.bits & 0x8000_0000, ..number };
        }
        number
    }

    /// One of the permitted results.
    pub fn chosen(&mut self, permitted: Permitted, plain: f32, kind: u8, inputs: &[f32]) -> f32 {
        let Permitted { low, high } = permitted;
        if low.is_nan() || high.is_nan() {
            return plain;
        }
        if let Some((directions, kinds)) = &self.directions {
            let at = self.trace.next() as usize - 1;
            // Another way than that of the run that the directions are from leaves them without a meaning.
            if kinds.get(at) == Some(&kind) {
                match directions[at] {
                    1 => return high,
                    -1 => return low,
                    _ => return plain.clamp(low.min(high), high.max(low)),
                }
            }
            self.directions = None;
        }
        if permitted.is_single() && self.policy.rounding != Rounding::Plain {
            return low;
        }
        match self.policy.rounding {
            Rounding::Plain => plain,
            Rounding::Nearest => plain.clamp(low, high),
            Rounding::Down => low,
            Rounding::Up => high,
            Rounding::TowardZero => {
                if low.abs() < high.abs() {
                    low
                } else {
                    high
                }
            }
            Rounding::Random => {
                if self.policy.consistent {
                    let known = [u64::from(kind), u64::from(low.to_bits()), u64::from(high.to_bits())];
                    let inputs = inputs.iter().map(|input| u64::from(input.to_bits()));
                    let all = [self.policy.seed].into_iter().chain(known).chain(inputs);
                    self.values = Random::new(Random::of(all));
                }
                match self.values.index(4) {
                    0 => low,
                    1 => high,
                    _ => between(low, high, &mut self.values),
                }
            }
        }
    }

    pub fn find(&mut self, concern: Concern, operands: &[f32], result: f32) {
        let (line, in_text, node) = (self.place.line, self.in_text, self.trace.next());
        let operands = operands.to_vec();
        self.findings.push(Finding { concern, line, operands, result, matters: true, in_text, node });
    }

    /// The findings, each with whether what is written or the way taken depends on it.
    pub fn inspected(&self) -> Vec<Finding> {
        if self.findings.is_empty() {
            return Vec::new();
        }
        let written = self.written.iter().map(|number| number.node);
        let reached = self.trace.reached(written.chain(self.conditions.iter().copied()));
        let matters = |finding: &Finding| reached.get(finding.node as usize).copied().unwrap_or(false);
        let all = self.findings.iter();
        all.map(|finding| Finding { matters: matters(finding), ..finding.clone() }).collect()
    }

    /// An operation that WGSL leaves no freedom.
    fn exact(&mut self, operands: &[Number], (bits, kind): (u32, Kind), slopes: [f64; 4]) -> Number {
        let mut nodes = [0; 4];
        nodes.iter_mut().zip(operands).for_each(|(node, operand)| *node = operand.node);
        let node = self.trace.push(Node { operands: nodes, made: Made::Otherwise }, || Slope {
            slopes,
            error: [0.0; 2],
            kind: 0,
        });
        Number { bits, kind, node }
    }

    fn exact_float(&mut self, operands: &[Number], value: f32, slopes: [f64; 4]) -> Number {
        self.exact(operands, (value.to_bits(), Kind::Float), slopes)
    }

    fn negated(&mut self, n: Number) -> Number {
        let n = self.flushed(n);
        let result = self.exact_float(&[n], -n.float(), [-1.0, 0.0, 0.0, 0.0]);
        let made = match self.trace.made(n) {
            Made::Sum(terms) => Made::Sum(terms.map(|term| term.turned(true))),
            Made::Product(factors, negative) => Made::Product(factors, !negative),
            Made::Quotient(parts, negative) => Made::Quotient(parts, !negative),
            Made::Otherwise => Made::Otherwise,
        };
        self.trace.remake(result.node, made);
        result
    }

    fn compared(&mut self, operator: BinaryOperator, operands: &[Number]) -> Number {
        use BinaryOperator as B;
        let [a, b] = [operands[0], operands[1]].map(|n| self.flushed(n).float());
        let mut outcome = match operator {
            B::Equal => a == b,
            B::NotEqual => a != b,
            B::Less => a < b,
            B::LessEqual => a <= b,
            B::Greater => a > b,
            _ => a >= b,
        };
        if a.is_nan() || b.is_nan() {
            self.find(Concern::Compared, &[a, b], f32::NAN);
            if self.policy.rounding == Rounding::Random {
                outcome = self.values.coin();
            }
        }
        self.exact(operands, (u32::from(outcome), Kind::Bool), [0.0; 4])
    }

    /// The larger or the smaller of two numbers.
    fn extreme(&mut self, operands: &[Number], larger: bool) -> Number {
        let [a, b] = [operands[0], operands[1]].map(|n| self.flushed(n).float());
        let mut first = if larger { a >= b } else { a <= b };
        if a.is_nan() || b.is_nan() {
            self.find(Concern::Compared, &[a, b], f32::NAN);
            // Either, or what plain single precision says: the one that is a number.
            first = if self.policy.rounding == Rounding::Random { self.values.coin() } else { b.is_nan() };
        } else if a.is_subnormal() && b.is_subnormal() && self.policy.flushing == Freedom::Either {
            first = self.coin(2);
        }
        let slopes = [f64::from(u8::from(first)), f64::from(u8::from(!first)), 0.0, 0.0];
        self.exact_float(operands, if first { a } else { b }, slopes)
    }

    fn function(&mut self, function: MathFunction, operands: &[Number], plain: f32) -> Number {
        use MathFunction as M;
        let x = self.flushed(operands[0]).float();
        let y = operands.get(1).map_or(0.0, |n| self.flushed(*n).float());
        let inputs = [x, y];
        let inputs = &inputs[..operands.len()];
        let pi = core::f32::consts::PI;
        match function {
            M::InverseSqrt | M::Log | M::Log2 if x < 0.0 => self.find(Concern::Negative, inputs, plain),
            M::InverseSqrt | M::Log | M::Log2 if x == 0.0 => self.find(Concern::Zero, inputs, plain),
            M::Sin | M::Cos if !(-pi..=pi).contains(&x) => self.find(Concern::Domain, inputs, plain),
            M::Acos | M::Asin if !(x.abs() < 1.0 && x != 0.0) => self.find(Concern::Domain, inputs, plain),
            M::Atan2 if !(x.is_normal() && in_range(y)) => self.find(Concern::Domain, inputs, plain),
            _ => {}
        }
        let Some((_, slopes, permitted)) = permitted::function(function, f64::from(x), f64::from(y)) else {
            return self.exact_float(operands, plain, [0.0; 4]);
        };
        let permitted = if self.policy.rounding == Rounding::Plain || plain.is_nan() {
            Permitted::only(plain)
        } else {
            permitted
        };
        let nodes = [operands[0].node, operands.get(1).map_or(0, |n| n.node), 0, 0];
        self.result(permitted, plain, (nodes, [slopes[0], slopes[1], 0.0, 0.0], 4), Made::Otherwise, inputs)
    }

    fn square_root(&mut self, operand: Number, plain: f32) -> Number {
        let x = self.flushed(operand);
        let value = x.float();
        if value < 0.0 {
            self.find(Concern::Negative, &[value], plain);
        } else if value == 0.0 {
            self.find(Concern::RootOfZero, &[value], plain);
            return self.exact_float(&[operand], value, [0.0; 4]);
        }
        if self.policy.rounding == Rounding::Plain || value.is_nan() || value < 0.0 || value.is_infinite() {
            let slope = 0.5 / f64::from(plain);
            let nodes = [operand.node, 0, 0, 0];
            let only = Permitted::only(plain);
            return self.result(only, plain, (nodes, [slope, 0.0, 0.0, 0.0], 5), Made::Otherwise, &[value]);
        }
        let inverse = (1.0 / f64::from(value).sqrt()) as f32;
        let inverse = self.function(MathFunction::InverseSqrt, &[x], inverse);
        self.plain_quotient(Number::constant(1.0_f32.to_bits(), Kind::Float), inverse)
    }

    /// An operation on floating-point numbers.
    fn float(&mut self, operation: Operation, n: &[Number], plain: (u32, Kind)) -> Number {
        use BinaryOperator as B;
        use MathFunction as M;
        let value = f32::from_bits(plain.0);
        let plus = |n: Number| Term::of(n, false);
        match operation {
            Operation::Unary(UnaryOperator::Negate) => self.negated(n[0]),
            Operation::Binary(B::Add) => self.sum(plus(n[0]), plus(n[1])),
            Operation::Binary(B::Subtract) => self.sum(plus(n[0]), Term::of(n[1], true)),
            Operation::Binary(B::Multiply) => self.product(n[0], n[1]),
            Operation::Binary(B::Divide) => self.quotient(n[0], n[1]),
            Operation::Binary(B::Modulo) => {
                let quotient = self.quotient(n[0], n[1]);
                let whole = self.exact_float(&[quotient], quotient.float().trunc(), [0.0; 4]);
                let product = self.product(n[1], whole);
                self.sum(plus(n[0]), Term::of(product, true))
            }
            Operation::Binary(operator) => self.compared(operator, n),
            Operation::Math(M::Min) => self.extreme(n, false),
            Operation::Math(M::Max) => self.extreme(n, true),
            Operation::Math(M::Abs) => {
                let x = self.flushed(n[0]).float();
                self.exact_float(n, x.abs(), [f64::from(x.signum()), 0.0, 0.0, 0.0])
            }
            Operation::Math(M::Saturate) => {
                let x = self.flushed(n[0]).float();
                if x.is_nan() {
                    self.find(Concern::Compared, &[x], value);
                }
                let inside = f64::from(u8::from((0.0..=1.0).contains(&x)));
                self.exact_float(n, x.clamp(0.0, 1.0), [inside, 0.0, 0.0, 0.0])
            }
            Operation::Math(M::Fract) => {
                let x = self.flushed(n[0]);
                let floor = self.exact_float(&[x], x.float().floor(), [0.0; 4]);
                self.sum(plus(x), Term::of(floor, true))
            }
            Operation::Math(M::Sqrt) => self.square_root(n[0], value),
            Operation::Math(function) => self.function(function, n, value),
            Operation::Convert(to) => {
                let x = n[0].float();
                let (least, end) = if to == Kind::Uint {
                    (0.0, 4_294_967_296.0)
                } else {
                    (-2_147_483_648.0, 2_147_483_648.0)
                };
                if to != Kind::Bool && !(x.trunc() >= least && x.trunc() < end) {
                    self.find(Concern::Converted, &[x], x);
                }
                self.exact(n, plain, [0.0; 4])
            }
            Operation::Bitcast(kind) => {
                let bits = self.flushed(n[0]).bits;
                self.exact(n, (bits, kind), [0.0; 4])
            }
            _ => self.exact(n, plain, [0.0; 4]),
        }
    }

    /// A coordinate in texels, as the filter sees it.
    fn in_texels(&mut self, coordinate: Number, size: usize) -> InTexels {
        let size = size as f64;
        let at = f64::from(coordinate.float()) * size - 0.5;
        let Filter::FixedPoint(bits) = self.policy.filter else {
            return InTexels { at, node: coordinate.node, slope: size };
        };
        let unit = 2.0_f64.powi(bits as i32);
        let [low, high] = [(at * unit).floor(), (at * unit).ceil()];
        let permitted = Permitted { low: low as f32, high: high as f32 };
        let nearest = (at * unit).round_ties_even() as f32;
        let slopes = [size * unit, 0.0, 0.0, 0.0];
        let operands = [coordinate.node, 0, 0, 0];
        let place = self.result(permitted, nearest, (operands, slopes, 6), Made::Otherwise, &[]);
        InTexels { at: f64::from(place.float()) / unit, node: place.node, slope: 1.0 / unit }
    }
}

/// A coordinate in texels, the operation that it comes from, and how it grows with that.
#[derive(Clone, Copy, Debug)]
struct InTexels {
    at: f64,
    node: u32,
    slope: f64,
}

/// Any of the numbers from one to another.
fn between(low: f32, high: f32, random: &mut Random) -> f32 {
    let order = |value: f32| {
        let bits = value.to_bits() as i32;
        i64::from(if bits < 0 { i32::MIN - bits } else { bits })
    };
    let (first, last) = (order(low), order(high));
    let at = first + random.index((last - first).max(0) as u64 + 1) as i64;
    let bits = if at < 0 { i64::from(i32::MIN) - at } else { at };
    f32::from_bits(bits as i32 as u32)
}

/// Whether a number may be the second operand of `atan2`.
fn in_range(y: f32) -> bool {
    (permitted::LEAST_DIVISOR..=permitted::LARGEST_DIVISOR).contains(&y.abs())
}

impl Observer for Device {
    const AS_STATED: bool = true;

    fn begin(&mut self) {
        self.trace.clear();
        self.order = Random::new(self.policy.seed);
        self.values = Random::new(self.policy.seed ^ 0x5EED);
        self.in_text = true;
        self.findings.clear();
        self.written.clear();
        self.conditions.clear();
        self.sampled.clear();
        self.sampled_at = None;
    }

    fn note(
        &mut self,
        operation: Operation,
        operands: &[Number],
        result: (u32, Kind),
        place: Place,
    ) -> Number {
        self.place = place;
        let passes = matches!(operation, Operation::Load(..) | Operation::Turn | Operation::Select);
        match operands.first() {
            Some(first) if first.kind == Kind::Float && !passes => self.float(operation, operands, result),
            _ if operation == Operation::Select => {
                let chosen = if operands[0].truth() { 1 } else { 2 };
                let slopes = [0.0, 1.0, 0.0, 0.0];
                self.exact(&[operands[0], operands[chosen]], result, slopes)
            }
            Some(first) if matches!(operation, Operation::Convert(Kind::Float)) => {
                let exact = match first.kind {
                    Kind::Sint => f64::from(first.bits as i32),
                    _ => f64::from(first.bits),
                };
                let permitted = Permitted::rounded(Exact(exact, 0.0));
                let operands = [first.node, 0, 0, 0];
                let plain = f32::from_bits(result.0);
                self.result(permitted, plain, (operands, [0.0; 4], 7), Made::Otherwise, &[])
            }
            _ => self.exact(operands, result, [0.0; 4]),
        }
    }

    fn sample(
        &mut self,
        binding: u32,
        texels: &Texels,
        coordinate: [Number; 2],
        layer: Number,
        place: Place,
    ) -> [Number; 4] {
        self.place = place;
        let [x, y] = coordinate.map(Number::float);
        if !(x.is_finite() && y.is_finite()) {
            self.find(Concern::Coordinate, &[x, y], f32::NAN);
        }
        let bits = coordinate.map(|number| number.bits);
        let at = match self.sampled_at {
            Some((known, at)) if known == bits => at,
            // The weights are a function of the coordinate, the same for every layer.
            _ => coordinate.map(|number| self.in_texels(number, texels.size())),
        };
        self.sampled_at = Some((bits, at));
        let layer = layer.bits;
        let plain = texels.sample(x, y, layer as usize);
        let (values, slopes) = texels.blend(at[0].at, at[1].at, layer as usize);
        let nodes = [at[0].node, at[1].node, 0, 0];
        let numbers = [0, 1, 2, 3].map(|part: usize| {
            let permitted = Permitted::rounded(Exact(values[part], 0.0));
            let nearest = values[part] as f32;
            let plain = if self.policy.rounding == Rounding::Plain && self.policy.filter == Filter::Exact {
                plain[part]
            } else {
                nearest
            };
            let slopes = [at[0].slope * slopes[0][part], at[1].slope * slopes[1][part], 0.0, 0.0];
            self.result(permitted, plain, (nodes, slopes, 8), Made::Otherwise, &[x, y])
        });
        self.sampled.push((binding, layer, numbers.map(Number::float)));
        numbers
    }

    fn branch(&mut self, condition: Number, _: Place) {
        self.conditions.push(condition.node);
    }

    fn written(&mut self, number: Number) {
        self.written.push(number);
    }
}
