//! Runs a WGSL kernel one invocation at a time and notes what it takes.
//!
//! Of WGSL there is what the include and the methods that it is compared with are written in. What is missing is an
//! error, never a guess.

use std::collections::{BTreeMap, HashMap};

use naga::{Block, EntryPoint, Expression, Function, Handle, Module, SampleLevel, Statement, TypeInner};

use super::memory::constant;
use super::operations::{Kind, Number, Operation, Operations, Trace};
use super::values::{self, Texels, Value};
use crate::effects::Effects;
use crate::translate::{TranslateError, kernel_module};

/// Why a kernel could not be run.
#[derive(Debug, thiserror::Error)]
pub enum ExecuteError {
    /// It is no valid WGSL.
    #[error("{0}")]
    Invalid(#[from] TranslateError),
    /// It has something that the interpreter lacks.
    #[error("the interpreter of src/report/costs has no {0}")]
    Unsupported(String),
    /// It reads or writes what is not there.
    #[error("the kernel uses {0}, which it has not been given")]
    Missing(String),
}

pub(super) fn unsupported<T>(what: impl core::fmt::Debug) -> Result<T, ExecuteError> {
    Err(ExecuteError::Unsupported(format!("{what:?}")))
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

/// What is bound to a kernel of group 0.
#[derive(Clone, Debug)]
pub(super) enum Resource {
    Buffer(Vec<u8>),
    Texels(Texels),
}

/// A kernel with what is bound to it.
pub struct Interpreter {
    module: Module,
    machine: Machine,
}

/// What changes while a kernel runs.
#[derive(Default)]
pub(super) struct Machine {
    pub resources: BTreeMap<u32, Resource>,
    pub trace: Trace,
    pub cells: Vec<Value>,
    /// Numbers of the places in the program, by the place around them, the call and the address of what is there.
    sites: HashMap<(u32, u32, usize, u8), u32>,
    /// The place around each.
    around: Vec<u32>,
}

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

impl Interpreter {
    /// A kernel of a WGSL text with the switches of a set of effects.
    ///
    /// # Errors
    ///
    /// If the text is not valid or has no such entry point.
    pub fn new(source: &str, entry_point: &str, effects: Effects) -> Result<Self, ExecuteError> {
        let (module, _) = kernel_module(source, entry_point, effects)?;
        Ok(Self { module, machine: Machine { around: vec![0], ..Machine::default() } })
    }

    /// Binds a buffer.
    pub fn bind_buffer(&mut self, binding: u32, bytes: Vec<u8>) {
        self.machine.resources.insert(binding, Resource::Buffer(bytes));
    }

    /// Binds a texture array.
    pub fn bind_texels(&mut self, binding: u32, texels: Texels) {
        self.machine.resources.insert(binding, Resource::Texels(texels));
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
        let Some(EntryPoint { function, .. }) = self.module.entry_points.first() else {
            return unsupported("kernel without an entry point");
        };
        self.machine.trace.clear();
        self.machine.cells.clear();
        // Which invocation it is, is not known beforehand: it is read like a word of a buffer.
        let number = self.machine.trace.note(
            Operation::Load(u32::MAX, 0),
            &[],
            (invocation, Kind::Uint),
            0,
            |_, _| false,
        );
        let zero = Number::constant(0, Kind::Uint);
        let arguments = vec![Value::vector(&[number, zero, zero])];
        let mut context = Context { module: &self.module, on: &mut self.machine };
        context.call(function, arguments, 0, 0)?;
        Ok(Executed { sites: self.machine.trace.operations() })
    }
}

pub(super) struct Context<'a> {
    pub module: &'a Module,
    pub on: &'a mut Machine,
}

impl<'a> Context<'a> {
    /// The place of the `kind`-th part of what lies at an address, within another place.
    fn site<T>(&mut self, frame: &Frame, at: &T, part: u8) -> u32 {
        let key = (frame.site, frame.call, core::ptr::from_ref(at) as usize, part);
        let around = &mut self.on.around;
        *self.on.sites.entry(key).or_insert_with(|| {
            around.push(frame.site);
            around.len() as u32 - 1
        })
    }

    pub(super) fn note(
        &mut self,
        operation: Operation,
        operands: &[Number],
        result: (u32, Kind),
        site: u32,
    ) -> Number {
        let around = &self.on.around;
        let sees = |from: u32, to: u32| {
            let mut place = to;
            while place > from {
                place = around[place as usize];
            }
            place == from
        };
        self.on.trace.note(operation, operands, result, site, sees)
    }

    fn call(
        &mut self,
        function: &'a Function,
        arguments: Vec<Value>,
        site: u32,
        call: u32,
    ) -> Result<Option<Value>, ExecuteError> {
        let cells = self.on.cells.len();
        let mut frame = Frame {
            function,
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
                self.on.trace.branch(condition, frame.site);
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
                    self.on.trace.branch(outcome, frame.site);
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
                        self.on.trace.branch(condition, site);
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
                let value = self.call(&self.module.functions[*function], arguments, frame.site, call)?;
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
        let mut of = |this: &mut Self, handle: &Handle<Expression>| this.value(frame, *handle);
        match &function.expressions[handle] {
            Expression::Literal(literal) => constant(literal),
            Expression::Constant(constant) => self.global(self.module.constants[*constant].init),
            Expression::ZeroValue(kind) => self.zero(*kind),
            Expression::FunctionArgument(index) => Ok(frame.arguments[*index as usize].clone()),
            Expression::GlobalVariable(global) => self.variable(*global),
            Expression::LocalVariable(local) => {
                Ok(Value::Local { cell: frame.cells + local.index(), path: Vec::new() })
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
            Expression::Unary { op, expr } => {
                let value = of(self, expr)?;
                let run = |this: &mut Self, n: &[Number]| {
                    let result = values::unary(*op, n[0])?;
                    Ok(this.note(Operation::Unary(*op), n, result, site))
                };
                values::each(&[&value], |numbers| run(self, numbers))
            }
            Expression::Binary { op, left, right } => {
                let (left, right) = (of(self, left)?, of(self, right)?);
                values::binary(*op, &left, &right, &mut self.noter(site))
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
                values::relational(*fun, &argument, &mut self.noter(site))
            }
            Expression::Math { fun, arg, arg1, arg2, .. } => {
                let mut arguments = vec![of(self, arg)?];
                for more in [arg1, arg2].into_iter().flatten() {
                    arguments.push(of(self, more)?);
                }
                values::math(*fun, &arguments, &mut self.noter(site))
            }
            Expression::As { expr, kind, convert } => {
                let value = of(self, expr)?;
                values::each(&[&value], |n| {
                    let (operation, result) = values::convert(n[0], *kind, convert.is_some())?;
                    Ok(if result.1 == n[0].kind { n[0] } else { self.note(operation, n, result, site) })
                })
            }
            other => unsupported(other),
        }
    }

    fn noter(&mut self, site: u32) -> impl FnMut(Operation, &[Number], (u32, Kind)) -> Number {
        move |operation, operands, result| self.note(operation, operands, result, site)
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
