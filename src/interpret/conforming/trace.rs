//! The operations of an invocation, and how what it writes depends on them.

use super::super::number::Number;

/// A number that is added, or its negative.
#[derive(Clone, Copy, Debug)]
pub struct Term {
    pub number: Number,
    pub negative: bool,
}

impl Term {
    pub const fn of(number: Number, negative: bool) -> Self {
        Self { number, negative }
    }

    pub fn turned(self, by: bool) -> Self {
        Self { negative: self.negative != by, ..self }
    }

    pub fn value(self) -> f32 {
        if self.negative { -self.number.float() } else { self.number.float() }
    }
}

/// How a number came about, as far as a device may put it in another order.
#[derive(Clone, Copy, Debug)]
pub enum Made {
    Otherwise,
    Sum([Term; 2]),
    /// Of two numbers, and whether the negative of it.
    Product([Number; 2], bool),
    /// The same.
    Quotient([Number; 2], bool),
}

/// An operation.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// Numbers of the operations that made its operands, 0 where none did.
    pub operands: [u32; 4],
    pub made: Made,
}

/// How an operation's result depends on its operands and on the device.
#[derive(Clone, Copy, Debug, Default)]
pub struct Slope {
    /// Partial derivatives.
    pub slopes: [f64; 4],
    /// How far below and above what it came to the result may be.
    pub error: [f64; 2],
    /// What kind of operation it is, to tell whether another run takes the same way.
    pub kind: u8,
}

/// Operations in the order in which they were run; the first has number 1.
#[derive(Debug, Default)]
pub struct Trace {
    nodes: Vec<Node>,
    /// Their slopes, if those are wanted.
    slopes: Vec<Slope>,
    pub with_slopes: bool,
}

impl Trace {
    pub fn clear(&mut self) {
        self.nodes.clear();
        self.slopes.clear();
    }

    /// The number of the next operation.
    pub fn next(&self) -> u32 {
        self.nodes.len() as u32 + 1
    }

    pub fn push(&mut self, node: Node, slope: impl FnOnce() -> Slope) -> u32 {
        self.nodes.push(node);
        if self.with_slopes {
            self.slopes.push(slope());
        }
        self.nodes.len() as u32
    }

    pub fn made(&self, number: Number) -> Made {
        match number.node.checked_sub(1) {
            Some(index) => self.nodes[index as usize].made,
            None => Made::Otherwise,
        }
    }

    /// Says how a number came about.
    pub fn remake(&mut self, node: u32, made: Made) {
        self.nodes[node as usize - 1].made = made;
    }

    /// The kinds of the operations.
    pub fn kinds(&self) -> Vec<u8> {
        self.slopes.iter().map(|slope| slope.kind).collect()
    }

    /// Which operations some numbers depend on.
    pub fn reached(&self, roots: impl Iterator<Item = u32>) -> Vec<bool> {
        let mut reached = vec![false; self.nodes.len() + 1];
        roots.for_each(|root| reached[root as usize] = true);
        for (at, node) in self.nodes.iter().enumerate().rev() {
            if reached[at + 1] {
                node.operands.iter().for_each(|operand| reached[*operand as usize] = true);
            }
        }
        reached
    }

    /// How a number depends on the error of each operation (reverse differentiation: Linnainmaa 1976, "Taylor Expansion of
    /// the Accumulated Rounding Error"): for each whether it shall err upwards to raise the number, and how far errors
    /// within what is permitted may lower and raise it, to first order.
    pub fn sensitivity(&self, of: Number) -> (Vec<i8>, [f64; 2]) {
        let mut directions = vec![0; self.nodes.len()];
        let mut adjoints = vec![0.0; self.nodes.len() + 1];
        let mut reach = [0.0; 2];
        adjoints[of.node as usize] = 1.0;
        for (at, (node, slope)) in self.nodes.iter().zip(&self.slopes).enumerate().rev() {
            let adjoint = adjoints[at + 1];
            if adjoint == 0.0 {
                continue;
            }
            let [down, up] = slope.error.map(|error| adjoint * error);
            reach[0] += down.min(up).min(0.0);
            reach[1] += down.max(up).max(0.0);
            directions[at] = if adjoint > 0.0 { 1 } else { -1 };
            for (operand, slope) in node.operands.iter().zip(slope.slopes) {
                let part = adjoint * slope;
                if *operand != 0 && part.is_finite() {
                    adjoints[*operand as usize] += part;
                }
            }
        }
        (directions, reach)
    }
}
