//! Runs a WGSL kernel one invocation at a time and tells an observer of each operation.
//!
//! Of WGSL there is what the include and the methods that it is compared with are written in. What is missing is an
//! error, never a guess.

use naga::{Block, Expression, Function, Handle, ImageQuery, Module, SampleLevel, Statement, TypeInner};

use super::arithmetic;
use super::memory::constant;
use super::number::{Kind, Number, Operation};
use super::observer::{Observer, Place};
use super::program::{ExecuteError, Machine, unsupported};
use super::values::{self, Note, Path, Value};

/// How a block ended.
enum Flow {
    Next,
    Break,
    Continue,
    Return(Option<Value>),
}

/// A function that runs.
struct Frame<'a> {
    function: &'a Function,
    lines: &'a [u32],
    /// The number of its first expression.
    first: u32,
    arguments: Vec<Value>,
    values: Vec<Option<Value>>,
    /// Index of its first local variable's cell.
    cells: usize,
    site: u32,
    call: u32,
    /// Whether the innermost loop may end at a condition that is not known beforehand, so that its turns cannot be told apart.
    endless: bool,
    /// Whether what such a loop does between its turns is run.
    turning: bool,
}

pub(super) struct Context<'a, O> {
    pub module: &'a Module,
    pub lines: &'a [Vec<u32>],
    pub firsts: &'a [u32],
    /// The last line that was known.
    pub line: u32,
    /// The expression that is evaluated.
    pub expression: u32,
    pub on: &'a mut Machine<O>,
}

impl<'a, O: Observer> Context<'a, O> {
    /// The place of the `kind`-th part of what lies at an address, within another place.
    fn site<T>(&mut self, frame: &Frame, at: &T, part: u8) -> u32 {
        let address = core::ptr::from_ref(at) as usize;
        self.on.observer.site(frame.site, frame.call, address, part)
    }

    pub(super) fn place(&self, site: u32) -> Place {
        Place { site, line: self.line, expression: self.expression }
    }

    pub(super) fn note(
        &mut self,
        operation: Operation,
        operands: &[Number],
        result: (u32, Kind),
        site: u32,
    ) -> Number {
        let place = self.place(site);
        self.on.observer.note(operation, operands, result, place)
    }

    fn branch(&mut self, condition: Number, site: u32) {
        let place = self.place(site);
        self.on.observer.branch(condition, place);
    }

    pub(super) fn call(
        &mut self,
        (function, index): (&'a Function, usize),
        arguments: Vec<Value>,
        site: u32,
        call: u32,
    ) -> Result<Option<Value>, ExecuteError> {
        let cells = self.on.cells.len();
        let mut frame = Frame {
            function,
            lines: &self.lines[index],
            first: self.firsts[index],
            arguments,
            values: vec![None; function.expressions.len()],
            cells,
            site,
            call,
            endless: false,
            turning: false,
        };
        for (_, local) in function.local_variables.iter() {
            let value = match local.init {
                Some(init) => self.value(&mut frame, init)?,
                None => self.zero(local.ty)?,
            };
            self.on.cells.push(value);
        }
        let flow = self.block(&mut frame, &function.body)?;
        self.on.cells.truncate(cells);
        Ok(if let Flow::Return(value) = flow { value } else { None })
    }

    /// Runs a block in the place that the frame is in, and leaves it there.
    fn block(&mut self, frame: &mut Frame<'a>, block: &'a Block) -> Result<Flow, ExecuteError> {
        let site = frame.site;
        let mut flow = Flow::Next;
        for statement in block.iter() {
            flow = self.statement(frame, statement)?;
            if !matches!(flow, Flow::Next) {
                break;
            }
        }
        frame.site = site;
        Ok(flow)
    }

    fn within(&mut self, frame: &mut Frame<'a>, block: &'a Block, site: u32) -> Result<Flow, ExecuteError> {
        let outer = core::mem::replace(&mut frame.site, site);
        let flow = self.block(frame, block);
        frame.site = outer;
        flow
    }

    fn statement(&mut self, frame: &mut Frame<'a>, statement: &'a Statement) -> Result<Flow, ExecuteError> {
        self.on.left = self.on.left.checked_sub(1).ok_or(ExecuteError::Endless { line: self.line })?;
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    let value = self.evaluate(frame, handle)?;
                    frame.values[handle.index()] = Some(value);
                }
            }
            Statement::Block(block) => return self.block(frame, block),
            Statement::If { condition, accept, reject } => {
                let condition = self.number(frame, *condition)?;
                let decided = condition.node == 0;
                self.branch(condition, frame.site);
                let (taken, part) = if condition.truth() { (accept, 0) } else { (reject, 1) };
                let site = if decided { frame.site } else { self.site(frame, statement, part) };
                let flow = self.within(frame, taken, site)?;
                if !decided && (leaves(accept) || leaves(reject)) {
                    frame.endless = true;
                    // What follows is reached by those alone that did not leave.
                    frame.site = self.site(frame, statement, 2);
                }
                return Ok(flow);
            }
            Statement::Switch { selector, cases } => {
                let selector = self.number(frame, *selector)?;
                let mut chosen = None;
                for (index, case) in cases.iter().enumerate() {
                    let value = match case.value {
                        naga::SwitchValue::I32(value) => value as u32,
                        naga::SwitchValue::U32(value) => value,
                        naga::SwitchValue::Default => continue,
                    };
                    // One comparison and one branch after the other.
                    let constant = Number::constant(value, selector.kind);
                    let equal = Operation::Binary(naga::BinaryOperator::Equal);
                    let same = u32::from(value == selector.bits);
                    let outcome = self.note(equal, &[selector, constant], (same, Kind::Bool), frame.site);
                    self.branch(outcome, frame.site);
                    if outcome.truth() {
                        chosen = Some(index);
                        break;
                    }
                }
                let is_default = |case: &naga::SwitchCase| matches!(case.value, naga::SwitchValue::Default);
                let chosen = chosen.or_else(|| cases.iter().position(is_default));
                for case in chosen.map(|first| &cases[first..]).unwrap_or_default() {
                    let site = self.site(frame, &case.body, 0);
                    match self.within(frame, &case.body, site)? {
                        Flow::Next if case.fall_through => {}
                        Flow::Next | Flow::Break => break,
                        flow => return Ok(flow),
                    }
                }
            }
            Statement::Loop { body, continuing, break_if } => {
                let site = self.site(frame, statement, 0);
                let outer = core::mem::replace(&mut frame.site, site);
                let outer_endless = core::mem::replace(&mut frame.endless, false);
                let flow = loop {
                    match self.block(frame, body)? {
                        Flow::Next | Flow::Continue => {}
                        Flow::Break => break Flow::Next,
                        flow => break flow,
                    }
                    frame.turning = frame.endless;
                    self.block(frame, continuing)?;
                    frame.turning = false;
                    if let Some(condition) = break_if {
                        let condition = self.number(frame, *condition)?;
                        self.branch(condition, site);
                        if condition.truth() {
                            break Flow::Next;
                        }
                    }
                };
                frame.site = outer;
                frame.endless = outer_endless;
                return Ok(flow);
            }
            Statement::Break => return Ok(Flow::Break),
            Statement::Continue => return Ok(Flow::Continue),
            Statement::Return { value } => {
                return Ok(Flow::Return(value.map(|value| self.value(frame, value)).transpose()?));
            }
            Statement::Store { pointer, value } => {
                let mut value = self.value(frame, *value)?;
                if let (true, Value::Scalar(number)) = (frame.turning, &mut value)
                    && number.node == 0
                {
                    // A counter, which is no constant where turns share their instructions.
                    *number = self.note(Operation::Turn, &[], (number.bits, number.kind), frame.site);
                }
                let pointer = self.value(frame, *pointer)?;
                self.store(&pointer, value)?;
            }
            Statement::Call { function, arguments, result } => {
                let arguments = arguments
                    .iter()
                    .map(|argument| self.value(frame, *argument))
                    .collect::<Result<_, _>>()?;
                // Compilers put the body in the place of the call.
                let call = self.site(frame, statement, 3);
                let callee = (&self.module.functions[*function], function.index());
                let value = self.call(callee, arguments, frame.site, call)?;
                if let (Some(result), Some(value)) = (result, value) {
                    frame.values[result.index()] = Some(value);
                }
            }
            other => return unsupported(other),
        }
        Ok(Flow::Next)
    }

    fn number(&mut self, frame: &mut Frame<'a>, handle: Handle<Expression>) -> Result<Number, ExecuteError> {
        match self.value(frame, handle)? {
            Value::Scalar(number) => Ok(number),
            other => unsupported(other),
        }
    }

    fn value(&mut self, frame: &mut Frame<'a>, handle: Handle<Expression>) -> Result<Value, ExecuteError> {
        match &frame.values[handle.index()] {
            Some(value) => Ok(value.clone()),
            None => self.evaluate(frame, handle),
        }
    }

    fn evaluate(&mut self, frame: &mut Frame<'a>, handle: Handle<Expression>) -> Result<Value, ExecuteError> {
        let site = frame.site;
        let function = frame.function;
        let line = frame.lines[handle.index()];
        // What is not computed is evaluated in the midst of what reads it, whose place this is.
        let is_computed = !matches!(
            function.expressions[handle],
            Expression::Literal(_)
                | Expression::Constant(_)
                | Expression::ZeroValue(_)
                | Expression::FunctionArgument(_)
                | Expression::GlobalVariable(_)
                | Expression::LocalVariable(_)
        );
        if is_computed {
            self.expression = frame.first + handle.index() as u32;
            self.line = if line == 0 { self.line } else { line };
        }
        let mut of = |this: &mut Self, handle: &Handle<Expression>| this.value(frame, *handle);
        match &function.expressions[handle] {
            Expression::Literal(literal) => constant(literal),
            Expression::Constant(constant) => self.global(self.module.constants[*constant].init),
            Expression::ZeroValue(kind) => self.zero(*kind),
            Expression::FunctionArgument(index) => Ok(frame.arguments[*index as usize].clone()),
            Expression::GlobalVariable(global) => self.variable(*global),
            Expression::LocalVariable(local) => {
                Ok(Value::Local { cell: frame.cells + local.index(), path: Path::default() })
            }
            Expression::Compose { ty, components } => {
                let parts = components.iter().map(|part| of(self, part)).collect::<Result<Vec<_>, _>>()?;
                values::compose(&self.module.types[*ty].inner, parts)
            }
            Expression::Splat { size, value } => {
                let Value::Scalar(number) = of(self, value)? else { return unsupported("splat") };
                Ok(Value::vector(&[number; 4][..*size as usize]))
            }
            Expression::Swizzle { size, vector, pattern } => {
                let vector = of(self, vector)?;
                let picked = pattern[..*size as usize].iter().map(|from| vector.component(*from as usize));
                Ok(Value::vector(&picked.collect::<Result<Vec<_>, _>>()?))
            }
            Expression::AccessIndex { base, index } => {
                let base = of(self, base)?;
                self.access(base, *index)
            }
            Expression::Access { base, index } => {
                let (base, index) = (of(self, base)?, of(self, index)?);
                let Value::Scalar(index) = index else { return unsupported(index) };
                self.access(base, index.bits)
            }
            Expression::Load { pointer } => {
                let pointer = of(self, pointer)?;
                self.load(&pointer, site)
            }
            Expression::ImageSample {
                image,
                coordinate,
                array_index,
                level: SampleLevel::Zero | SampleLevel::Exact(_),
                gather: None,
                offset: None,
                depth_ref: None,
                ..
            } => {
                let image = of(self, image)?;
                let coordinate = of(self, coordinate)?;
                let layer = array_index.map(|layer| of(self, &layer)).transpose()?;
                self.sample(&image, &coordinate, layer, site)
            }
            Expression::ArrayLength(pointer) => match of(self, pointer)? {
                // It comes with the buffer's descriptor.
                Value::Buffer { binding, offset, kind } => {
                    let TypeInner::Array { stride, .. } = self.module.types[kind].inner else {
                        return unsupported("length of what is no array");
                    };
                    let count = (self.bytes(binding)?.len() as u32 - offset) / stride;
                    let load = Operation::Load(u32::MAX, 1 + binding);
                    Ok(Value::Scalar(self.note(load, &[], (count, Kind::Uint), site)))
                }
                other => unsupported(other),
            },
            Expression::ImageQuery { image, query: ImageQuery::Size { level: None } } => {
                let image = of(self, image)?;
                let Value::Handle(binding) = image else { return unsupported(image) };
                let size = self.texels(binding)?.size() as u32;
                let word = |at| Operation::Load(u32::MAX - 1 - at, binding);
                let part = |at| self.note(word(at), &[], (size, Kind::Uint), site);
                Ok(Value::vector(&[0, 1].map(part)))
            }
            Expression::Unary { op, expr } => {
                let value = of(self, expr)?;
                let run = |this: &mut Self, n: &[Number]| {
                    let result = arithmetic::unary(*op, n[0])?;
                    Ok(this.note(Operation::Unary(*op), n, result, site))
                };
                values::each(&[&value], |numbers| run(self, numbers))
            }
            Expression::Binary { op, left, right } => {
                let (left, right) = (of(self, left)?, of(self, right)?);
                arithmetic::binary(*op, &left, &right, &mut self.noter(site))
            }
            Expression::Select { condition, accept, reject } => {
                let (condition, accept, reject) =
                    (of(self, condition)?, of(self, accept)?, of(self, reject)?);
                values::each(&[&condition, &accept, &reject], |n| {
                    let chosen = if n[0].truth() { n[1] } else { n[2] };
                    Ok(self.note(Operation::Select, n, (chosen.bits, chosen.kind), site))
                })
            }
            Expression::Relational { fun, argument } => {
                let argument = of(self, argument)?;
                arithmetic::relational(*fun, &argument, &mut self.noter(site))
            }
            Expression::Math { fun, arg, arg1, arg2, .. } => {
                let mut arguments = vec![of(self, arg)?];
                for more in [arg1, arg2].into_iter().flatten() {
                    arguments.push(of(self, more)?);
                }
                arithmetic::math(*fun, &arguments, &mut self.noter(site))
            }
            Expression::As { expr, kind, convert } => {
                let value = of(self, expr)?;
                values::each(&[&value], |n| {
                    let (operation, result) = arithmetic::convert(n[0], *kind, convert.is_some())?;
                    Ok(if result.1 == n[0].kind { n[0] } else { self.note(operation, n, result, site) })
                })
            }
            other => unsupported(other),
        }
    }

    fn noter(&mut self, site: u32) -> Noter<'_, O> {
        let place = self.place(site);
        Noter { observer: &mut self.on.observer, place }
    }
}

/// Tells an observer of operations at a place.
pub(super) struct Noter<'a, O> {
    observer: &'a mut O,
    place: Place,
}

impl<O: Observer> Note for Noter<'_, O> {
    const AS_STATED: bool = O::AS_STATED;

    fn note(&mut self, operation: Operation, operands: &[Number], result: (u32, Kind)) -> Number {
        self.observer.note(operation, operands, result, self.place)
    }
}

/// Whether a block may leave the one around it.
fn leaves(block: &Block) -> bool {
    block.iter().any(|statement| match statement {
        Statement::Return { .. } | Statement::Break | Statement::Continue | Statement::Kill => true,
        Statement::Block(block) => leaves(block),
        Statement::If { accept, reject, .. } => leaves(accept) || leaves(reject),
        Statement::Switch { cases, .. } => cases.iter().any(|case| leaves(&case.body)),
        Statement::Loop { body, .. } => leaves(body),
        _ => false,
    })
}
