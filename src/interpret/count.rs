//! What an executed path needs: the operations that an invocation ran, as a graph of scalar operations, and their
//! count after what every compiler does with them.

use std::collections::{BTreeMap, HashMap};

use std::sync::Arc;

use naga::{BinaryOperator, MathFunction, UnaryOperator};

use super::number::{Kind, Number, Operation};
use super::observer::{Observer, Place};
use super::program::{ExecuteError, Machine, Program, Resource};
use super::texels::Texels;
use crate::effects::Effects;

/// Operations on single numbers, by the unit of a processor that does them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Sums, products, both at once, minima, maxima, roundings, conversions, whole-number arithmetic.
    pub arithmetic: u64,
    /// Reciprocals, roots, exponentials, logarithms, sines and cosines, for which a processor has a unit that is slower
    /// than the one for sums; also products of whole numbers.
    pub special: u64,
    /// Comparisons of two numbers, and choices between two by the outcome.
    pub decisions: u64,
    /// Operations on truth values.
    pub logic: u64,
    /// Conditional branches.
    pub branches: u64,
    /// Samples of textures.
    pub samples: u64,
    /// Numbers read from buffers.
    pub loads: u64,
}

/// Slots that a special operation takes: AMD's RDNA (whitepaper, 2019) does 8 where it does 32 sums.
pub const SPECIAL_SLOTS: u64 = 4;

impl Operations {
    /// Slots of the arithmetic unit that the operations take: one each, [`SPECIAL_SLOTS`] where special. Samples and loads
    /// take none: another unit does them while others run.
    pub fn slots(&self) -> u64 {
        self.arithmetic + SPECIAL_SLOTS * self.special + self.decisions + self.logic + self.branches
    }

    /// How many there are of all kinds but samples and loads.
    pub fn count(&self) -> u64 {
        self.arithmetic + self.special + self.decisions + self.logic + self.branches
    }

    fn each(self, other: Self, with: impl Fn(u64, u64) -> u64) -> Self {
        Self {
            arithmetic: with(self.arithmetic, other.arithmetic),
            special: with(self.special, other.special),
            decisions: with(self.decisions, other.decisions),
            logic: with(self.logic, other.logic),
            branches: with(self.branches, other.branches),
            samples: with(self.samples, other.samples),
            loads: with(self.loads, other.loads),
        }
    }

    /// The larger of each.
    pub fn max(self, other: Self) -> Self {
        self.each(other, u64::max)
    }
}

impl core::ops::Add for Operations {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.each(other, |a, b| a + b)
    }
}

impl core::iter::Sum for Operations {
    fn sum<I: Iterator<Item = Self>>(numbers: I) -> Self {
        numbers.fold(Self::default(), |sum, each| sum + each)
    }
}

impl Operation {
    /// What it takes; `divisor` tells of a division what is known beforehand: the dividend is 1, the divisor is.
    fn cost(self, kind: Kind, one_over: bool, by_constant: bool) -> Operations {
        use MathFunction as M;
        let of = |arithmetic, special| Operations { arithmetic, special, ..Operations::default() };
        let decision = Operations { decisions: 1, ..Operations::default() };
        let logic = Operations { logic: 1, ..Operations::default() };
        match self {
            Self::Load(..) => Operations { loads: 1, ..Operations::default() },
            Self::Sample(_) => Operations { samples: 1, ..Operations::default() },
            Self::Branch => Operations { branches: 1, ..Operations::default() },
            Self::Select => decision,
            Self::Convert(_) | Self::Turn => of(1, 0),
            Self::Component(_) | Self::Bitcast(_) => of(0, 0),
            Self::Unary(UnaryOperator::LogicalNot) => logic,
            // The sign of what an operation reads is the reader's affair on all processors.
            Self::Unary(UnaryOperator::Negate) if kind == Kind::Float => of(0, 0),
            Self::Unary(_) => of(1, 0),
            Self::Binary(operator) => match operator {
                BinaryOperator::Divide | BinaryOperator::Modulo if kind == Kind::Float => {
                    if by_constant {
                        of(1, 0)
                    } else if one_over {
                        of(0, 1)
                    } else {
                        of(1, 1)
                    }
                }
                // No processor divides whole numbers: a reciprocal and corrections.
                BinaryOperator::Divide | BinaryOperator::Modulo => of(8, 2),
                BinaryOperator::Multiply if kind != Kind::Float => of(0, 1),
                BinaryOperator::Equal
                | BinaryOperator::NotEqual
                | BinaryOperator::Less
                | BinaryOperator::LessEqual
                | BinaryOperator::Greater
                | BinaryOperator::GreaterEqual => decision,
                _ if kind == Kind::Bool => logic,
                _ => of(1, 0),
            },
            Self::Math(function) => match function {
                M::Abs | M::Saturate if kind == Kind::Float => of(0, 0),
                M::InverseSqrt | M::Sqrt | M::Exp2 | M::Log2 => of(0, 1),
                M::Exp | M::Log | M::Sin | M::Cos => of(1, 1),
                M::Tan => of(2, 3),
                M::Pow => of(1, 2),
                // As Mesa takes them apart (nir_builtin_builder.c): a polynomial and a root, or a reciprocal.
                M::Asin | M::Acos => of(9, 1),
                M::Atan => of(12, 1),
                M::Atan2 => of(22, 1),
                M::Sign => of(2, 0),
                _ => of(1, 0),
            },
        }
    }

    fn is(self, operator: BinaryOperator) -> bool {
        self == Self::Binary(operator)
    }
}

/// What one invocation took.
#[derive(Clone, Debug, Default)]
pub struct Executed {
    /// By the place in the program: what is reached under the same conditions in the same call.
    pub sites: BTreeMap<u32, Operations>,
}

impl Executed {
    /// All that it took.
    pub fn total(&self) -> Operations {
        self.sites.values().copied().sum()
    }

    /// What a wave of invocations takes that run in step: whatever any of them takes, for as long as the longest.
    pub fn wave<'a>(invocations: impl IntoIterator<Item = &'a Self>) -> Operations {
        let mut sites: BTreeMap<u32, Operations> = BTreeMap::new();
        for (site, operations) in invocations.into_iter().flat_map(|one| &one.sites) {
            let most = sites.entry(*site).or_default();
            *most = most.max(*operations);
        }
        sites.into_values().sum()
    }
}

#[derive(Clone, Debug)]
struct Node {
    operation: Operation,
    kind: Kind,
    operands: [u32; 3],
    one_over: bool,
    by_constant: bool,
    site: u32,
}

/// A kernel with what is bound to it, and what its invocations take.
pub struct Interpreter {
    program: Program,
    machine: Machine<Counting>,
}

impl Interpreter {
    /// A kernel of a WGSL text with the switches of a set of effects.
    ///
    /// # Errors
    ///
    /// If the text is not valid or has no such entry point.
    pub fn new(source: &str, entry_point: &str, effects: Effects) -> Result<Self, ExecuteError> {
        let program = Program::new(source, entry_point, effects)?;
        let counting = Counting { around: vec![0], ..Counting::default() };
        Ok(Self { program, machine: Machine::new(counting) })
    }

    /// Binds a buffer.
    pub fn bind_buffer(&mut self, binding: u32, bytes: Vec<u8>) {
        self.machine.resources.insert(binding, Resource::Buffer(bytes));
    }

    /// Binds a texture array.
    pub fn bind_texels(&mut self, binding: u32, texels: Texels) {
        self.machine.resources.insert(binding, Resource::Texels(Arc::new(texels)));
    }

    /// What a buffer holds.
    pub fn buffer(&self, binding: u32) -> &[u8] {
        match self.machine.resources.get(&binding) {
            Some(Resource::Buffer(bytes)) => bytes,
            _ => &[],
        }
    }

    /// Runs the invocation of the given number.
    ///
    /// # Errors
    ///
    /// If the kernel has something that the interpreter lacks.
    pub fn run(&mut self, invocation: u32) -> Result<Executed, ExecuteError> {
        self.program.run(&mut self.machine, invocation)?;
        Ok(Executed { sites: self.machine.observer.trace.operations() })
    }
}

/// Counts what an invocation takes.
#[derive(Default)]
struct Counting {
    trace: Trace,
    /// Numbers of the places in the program, by the place around them, the call and the address of what is there.
    sites: HashMap<(u32, u32, usize, u8), u32>,
    /// The place around each.
    around: Vec<u32>,
}

impl Observer for Counting {
    const AS_STATED: bool = false;

    fn begin(&mut self) {
        self.trace.clear();
    }

    fn note(
        &mut self,
        operation: Operation,
        operands: &[Number],
        result: (u32, Kind),
        place: Place,
    ) -> Number {
        let around = &self.around;
        let sees = |from: u32, to: u32| {
            let mut place = to;
            while place > from {
                place = around[place as usize];
            }
            place == from
        };
        self.trace.note(operation, operands, result, place.site, sees)
    }

    fn sample(
        &mut self,
        binding: u32,
        texels: &Texels,
        [x, y]: [Number; 2],
        layer: Number,
        place: Place,
    ) -> [Number; 4] {
        let texel = texels.sample(x.float(), y.float(), layer.bits as usize);
        let sample = self.note(Operation::Sample(binding), &[x, y, layer], (0, Kind::Float), place);
        [0, 1, 2, 3].map(|at: usize| {
            let result = (texel[at].to_bits(), Kind::Float);
            self.note(Operation::Component(at as u32), &[sample], result, place)
        })
    }

    fn branch(&mut self, condition: Number, place: Place) {
        // One on a condition that is known beforehand is none.
        if condition.node != 0 {
            let branch =
                self.trace.note(Operation::Branch, &[condition], (0, Kind::Bool), place.site, |_, _| false);
            self.trace.roots.push(branch.node);
        }
    }

    fn written(&mut self, number: Number) {
        self.trace.roots.push(number.node);
    }

    fn site(&mut self, around: u32, call: u32, address: usize, part: u8) -> u32 {
        let places = &mut self.around;
        *self.sites.entry((around, call, address, part)).or_insert_with(|| {
            places.push(around);
            places.len() as u32 - 1
        })
    }
}

/// The operations of one invocation.
///
/// What is known beforehand takes none; what was computed before where it is seen from here is not computed again.
#[derive(Default)]
struct Trace {
    nodes: Vec<Node>,
    known: HashMap<(Operation, [u64; 3]), u32>,
    roots: Vec<u32>,
}

impl Trace {
    pub fn clear(&mut self) {
        self.nodes.clear();
        self.known.clear();
        self.roots.clear();
    }

    /// Notes an operation that is run at `site` and comes to `bits`. `sees` tells whether a site is reached only after
    /// another.
    pub fn note(
        &mut self,
        operation: Operation,
        operands: &[Number],
        (bits, kind): (u32, Kind),
        site: u32,
        sees: impl Fn(u32, u32) -> bool,
    ) -> Number {
        let reads = matches!(operation, Operation::Load(..) | Operation::Sample(_) | Operation::Turn);
        if !reads && operands.iter().all(|operand| operand.node == 0) {
            return Number::constant(bits, kind);
        }
        if let Some(same) = simpler(operation, operands) {
            return Number { bits, kind, node: same };
        }
        let mut key = [0; 3];
        let mut nodes = [0; 3];
        for (at, operand) in operands.iter().enumerate() {
            nodes[at] = operand.node;
            key[at] = if operand.node == 0 { u64::from(operand.bits) } else { u64::from(operand.node) << 32 };
        }
        if let Some(&node) = self.known.get(&(operation, key))
            && operation != Operation::Turn
            && sees(self.nodes[node as usize - 1].site, site)
        {
            return Number { bits, kind, node };
        }
        let divides = operation.is(BinaryOperator::Divide);
        self.nodes.push(Node {
            operation,
            kind: operands.first().map_or(kind, |operand| operand.kind),
            operands: nodes,
            one_over: divides && operands[0].is(1.0),
            by_constant: divides && operands[1].node == 0,
            site,
        });
        let node = self.nodes.len() as u32;
        self.known.insert((operation, key), node);
        Number { bits, kind, node }
    }

    /// What the operations that the outcome depends on take, by site. A sum takes one product with it that nothing else
    /// reads.
    pub fn operations(&self) -> BTreeMap<u32, Operations> {
        let mut uses = vec![0_u32; self.nodes.len() + 1];
        for root in &self.roots {
            uses[*root as usize] += 1;
        }
        // Operands come before what reads them.
        for (at, node) in self.nodes.iter().enumerate().rev() {
            if uses[at + 1] > 0 {
                node.operands.iter().for_each(|operand| uses[*operand as usize] += 1);
            }
        }
        let mut fused = vec![false; self.nodes.len() + 1];
        for (at, node) in self.nodes.iter().enumerate() {
            let adds = node.operation.is(BinaryOperator::Add) || node.operation.is(BinaryOperator::Subtract);
            if uses[at + 1] > 0 && adds && node.kind == Kind::Float {
                let product =
                    node.operands[..2].iter().find_map(|operand| self.product(*operand, &uses, &fused));
                if let Some(product) = product {
                    fused[product] = true;
                }
            }
        }
        let mut sites: BTreeMap<u32, Operations> = BTreeMap::new();
        for (at, node) in self.nodes.iter().enumerate() {
            if uses[at + 1] > 0 && !fused[at + 1] {
                let cost = node.operation.cost(node.kind, node.one_over, node.by_constant);
                let site = sites.entry(node.site).or_default();
                *site = *site + cost;
            }
        }
        sites
    }

    /// The product that a number is, negated or not, if one reader is all that it has.
    fn product(&self, mut number: u32, uses: &[u32], fused: &[bool]) -> Option<usize> {
        loop {
            let node = self.nodes.get((number as usize).checked_sub(1)?)?;
            if uses[number as usize] != 1 || fused[number as usize] {
                return None;
            }
            match node.operation {
                Operation::Binary(BinaryOperator::Multiply) => return Some(number as usize),
                Operation::Unary(UnaryOperator::Negate) => number = node.operands[0],
                _ => return None,
            }
        }
    }
}

/// The operand that an operation comes to, if that is known beforehand.
fn simpler(operation: Operation, operands: &[Number]) -> Option<u32> {
    use BinaryOperator as B;
    let [left, right] = [operands.first()?, operands.get(1).unwrap_or(&operands[0])];
    let either = |neutral: &dyn Fn(&Number) -> bool| {
        if neutral(right) {
            Some(left.node)
        } else if neutral(left) {
            Some(right.node)
        } else {
            None
        }
    };
    let truth = |value: bool| move |n: &Number| n.node == 0 && n.kind == Kind::Bool && n.truth() == value;
    match operation {
        Operation::Binary(B::Multiply) => either(&|n| n.is(1.0)),
        Operation::Binary(B::Divide) if right.is(1.0) => Some(left.node),
        Operation::Binary(B::Add) => either(&|n| n.is(0.0)),
        Operation::Binary(B::Subtract) if right.is(0.0) => Some(left.node),
        Operation::Binary(B::And | B::LogicalAnd) => {
            if truth(false)(left) || truth(false)(right) {
                Some(0)
            } else {
                either(&truth(true))
            }
        }
        Operation::Binary(B::InclusiveOr | B::LogicalOr) => {
            if truth(true)(left) || truth(true)(right) {
                Some(0)
            } else {
                either(&truth(false))
            }
        }
        Operation::Select => {
            let (condition, accept, reject) = (operands[0], operands[1], operands[2]);
            if condition.node == 0 {
                Some(if condition.truth() { accept.node } else { reject.node })
            } else {
                let same = accept.node == reject.node && (accept.node != 0 || accept.bits == reject.bits);
                same.then_some(accept.node)
            }
        }
        _ => None,
    }
}
