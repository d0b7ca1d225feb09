//! Sums, products and quotients, in the order of the text or in another.

use super::super::number::{Kind, Number};
use super::device::Device;
use super::finding::Concern;
use super::permitted::{Exact, LARGEST_DIVISOR, LEAST_DIVISOR, Permitted, QUOTIENT_ULPS};
use super::policy::Rounding;
use super::trace::{Made, Slope, Term};

/// A number that is added: a product is added as such where it is fused.
#[derive(Clone, Copy)]
struct Addend {
    exact: f64,
    operands: [u32; 2],
    slopes: [f64; 2],
}

impl Device {
    /// The sum of two terms.
    pub fn sum(&mut self, a: Term, b: Term) -> Number {
        let (a, b) = self.terms_in_order(a, b);
        self.plain_sum(a, b)
    }

    /// Either the terms or what they are after a sum has been taken apart and part of it added to the other.
    fn terms_in_order(&mut self, a: Term, b: Term) -> (Term, Term) {
        if !self.may(self.policy.reassociation, 3) {
            return (a, b);
        }
        let parts = [a, b].map(|term| match self.trace.made(term.number) {
            Made::Sum(terms) => Some(terms.map(|part| part.turned(term.negative))),
            _ => None,
        });
        let (parts, other) = match parts {
            [Some(parts), None] => (parts, b),
            [None, Some(parts)] => (parts, a),
            [Some(of_a), Some(of_b)] => {
                if self.coin(9) {
                    (of_a, b)
                } else {
                    (of_b, a)
                }
            }
            [None, None] => return (a, b),
        };
        let kept = usize::from(self.coin(10));
        let moved = self.between(|device| device.plain_sum(parts[1 - kept], other));
        (parts[kept], Term::of(moved, false))
    }

    fn plain_sum(&mut self, a: Term, b: Term) -> Number {
        let terms = [a, b].map(|term| {
            let number = self.flushed(term.number);
            Term::of(number, term.negative)
        });
        let plain = terms[0].value() + terms[1].value();
        let fused = [0, 1].map(|at: usize| match self.trace.made(terms[at].number) {
            Made::Product(factors, negative) if self.policy.fusion != super::Freedom::Never => {
                Some((factors, negative != terms[at].negative))
            }
            _ => None,
        });
        let [of_a, of_b] = fused;
        let fused = [
            of_a.filter(|_| self.may(self.policy.fusion, 6)),
            of_b.filter(|_| self.may(self.policy.fusion, 16)),
        ];
        let addend = |at: usize| match fused[at] {
            Some(([x, y], negative)) => {
                let sign = if negative { -1.0 } else { 1.0 };
                let [x_value, y_value] = [x, y].map(|number| f64::from(number.float()));
                Addend {
                    exact: sign * x_value * y_value,
                    operands: [x.node, y.node],
                    slopes: [sign * y_value, sign * x_value],
                }
            }
            None => Addend {
                exact: f64::from(terms[at].value()),
                operands: [terms[at].number.node, 0],
                slopes: [if terms[at].negative { -1.0 } else { 1.0 }, 0.0],
            },
        };
        let [left, right] = [0, 1].map(addend);
        let exact = Exact::sum(left.exact, right.exact);
        let plain = if fused.iter().all(Option::is_none) { plain } else { exact.0 as f32 };
        let operands = [left.operands[0], left.operands[1], right.operands[0], right.operands[1]];
        let slopes = [left.slopes[0], left.slopes[1], right.slopes[0], right.slopes[1]];
        let inputs = [a.value(), b.value()];
        self.result(Permitted::rounded(exact), plain, (operands, slopes, 1), Made::Sum(terms), &inputs)
    }

    /// The product of two numbers.
    pub fn product(&mut self, a: Number, b: Number) -> Number {
        if self.may(self.policy.reassociation, 4) {
            let of_a = self.trace.made(a);
            let of_b = self.trace.made(b);
            let apart = |made: &Made| !matches!(made, Made::Otherwise | Made::Sum(_));
            let (made, other) = match (apart(&of_a), apart(&of_b)) {
                (true, false) => (of_a, b),
                (false, true) => (of_b, a),
                (true, true) => {
                    if self.coin(11) {
                        (of_a, b)
                    } else {
                        (of_b, a)
                    }
                }
                (false, false) => return self.plain_product(a, b, false),
            };
            match made {
                Made::Product(factors, negative) => {
                    let kept = usize::from(self.coin(12));
                    let moved =
                        self.between(|device| device.plain_product(factors[1 - kept], other, negative));
                    return self.plain_product(factors[kept], moved, false);
                }
                Made::Quotient([dividend, divisor], negative) => {
                    let moved = self.between(|device| device.plain_product(dividend, other, negative));
                    return self.plain_quotient(moved, divisor);
                }
                Made::Otherwise | Made::Sum(_) => {}
            }
        }
        self.plain_product(a, b, false)
    }

    fn plain_product(&mut self, a: Number, b: Number, negative: bool) -> Number {
        let factors = [a, b].map(|number| self.flushed(number));
        let sign = if negative { -1.0 } else { 1.0 };
        let [x, y] = factors.map(|number| f64::from(number.float()));
        let plain = factors[0].float() * factors[1].float() * sign as f32;
        // Exact: 24 and 24 digits are fewer than 53.
        let permitted = Permitted::rounded(Exact(sign * x * y, 0.0));
        let operands = [a.node, b.node, 0, 0];
        let slopes = [sign * y, sign * x, 0.0, 0.0];
        let inputs = [a.float(), b.float()];
        self.result(permitted, plain, (operands, slopes, 2), Made::Product(factors, negative), &inputs)
    }

    /// The quotient of two numbers.
    pub fn quotient(&mut self, a: Number, b: Number) -> Number {
        if let Made::Product(factors, negative) = self.trace.made(a)
            && self.may(self.policy.reassociation, 5)
        {
            let kept = usize::from(self.coin(13));
            let moved = self.between(|device| device.plain_quotient(factors[1 - kept], b));
            return self.plain_product(factors[kept], moved, negative);
        }
        self.plain_quotient(a, b)
    }

    /// The quotient in the order of the text. That of zero is zero, as it is however one divides; by the letter the specification
    /// permits a few of the smallest subnormal numbers.
    pub fn plain_quotient(&mut self, a: Number, b: Number) -> Number {
        let flushed = [a, b].map(|number| self.flushed(number));
        let [x, y] = flushed.map(|number| f64::from(number.float()));
        let plain = flushed[0].float() / flushed[1].float();
        let exact = x / y;
        let permitted = if self.policy.rounding == Rounding::Plain {
            Permitted::only(plain)
        } else if exact != 0.0 && exact.is_finite() {
            Permitted::within_ulps(exact, QUOTIENT_ULPS)
        } else {
            Permitted::only(plain)
        };
        let inputs = [a.float(), b.float()];
        // The operand as it was: a device that does not flush it finds it there.
        if !(LEAST_DIVISOR..=LARGEST_DIVISOR).contains(&b.float().abs()) {
            self.find(Concern::Divisor, &inputs, plain);
        }
        let slopes = [1.0 / y, -exact / y, 0.0, 0.0];
        let made = Made::Quotient(flushed, false);
        self.result(permitted, plain, ([a.node, b.node, 0, 0], slopes, 3), made, &inputs)
    }

    /// Does something that the text does not have in this order.
    fn between(&mut self, what: impl FnOnce(&mut Self) -> Number) -> Number {
        let outer = core::mem::replace(&mut self.in_text, false);
        let number = what(self);
        self.in_text = outer;
        number
    }

    /// The number that an operation comes to, of those that are permitted. `plain` is what it is to nearest.
    pub fn result(
        &mut self,
        permitted: Permitted,
        plain: f32,
        (operands, slopes, kind): ([u32; 4], [f64; 4], u8),
        made: Made,
        inputs: &[f32],
    ) -> Number {
        let mut value = self.chosen(permitted, plain, kind, inputs);
        if value.is_subnormal() && self.may(self.policy.flushing, 7) {
            value = 0.0_f32.copysign(value);
        }
        if value == 0.0 && self.may(self.policy.zeros, 8) {
            value = -value;
        }
        if plain.is_nan() {
            self.find(Concern::NotANumber, inputs, plain);
        } else if !(permitted.low.is_finite() && permitted.high.is_finite()) {
            self.find(Concern::Infinite, inputs, plain);
        }
        let of = |end: f32| f64::from(end) - f64::from(value);
        let error = [of(permitted.low), of(permitted.high)].map(|e| if e.is_finite() { e } else { 0.0 });
        let node = super::trace::Node { operands, made };
        let node = self.trace.push(node, || Slope { slopes, error, kind });
        Number { bits: value.to_bits(), kind: Kind::Float, node }
    }
}
