//! What is left of a function once its switches are decided.

use std::collections::BTreeSet;

use naga::{
    AddressSpace, Arena, BinaryOperator, Block, Expression, Function, Handle, Literal, Module, Range,
    Statement, TypeInner, UnaryOperator,
};

use super::visit::{blocks, operands, statement_operands, statements};
use super::{TranslateError, failed};

/// The function without what its switches, now literals, leave unused: `if` statements that are decided,
/// what follows a return, calls without effect whose results nothing reads, expressions and locals that
/// nothing refers to. `pure` tells which functions have no effect but their result.
///
/// Blocks within blocks are flattened, so that it does not show which statements an `if` was around.
pub(super) fn fold(
    function: &Function,
    pure: &dyn Fn(Handle<Function>) -> bool,
) -> Result<Function, TranslateError> {
    let folded = Folded::of(function);
    let mut body = folded.block(function.body.clone());
    let needed = loop {
        let needed = folded.needed(function, &body, pure)?;
        let before = count(&body);
        body = without_dead_calls(body, &needed, pure);
        if count(&body) == before {
            break needed;
        }
    };
    folded.rebuild(function, body, &needed)
}

/// Whether a function has no effect but its result.
pub(super) fn is_pure(module: &Module, function: &Function, pure: &dyn Fn(Handle<Function>) -> bool) -> bool {
    let takes_pointer = function
        .arguments
        .iter()
        .any(|argument| matches!(module.types[argument.ty].inner, TypeInner::Pointer { .. }));
    let mut effects = takes_pointer;
    statements(&function.body, &mut |statement| {
        effects |= match statement {
            Statement::Emit(_)
            | Statement::Block(_)
            | Statement::If { .. }
            | Statement::Switch { .. }
            | Statement::Loop { .. }
            | Statement::Break
            | Statement::Continue
            | Statement::Return { .. } => false,
            Statement::Store { pointer, .. } => !is_local(module, function, *pointer),
            Statement::Call { function, .. } => !pure(*function),
            _ => true,
        };
    });
    !effects
}

/// Whether a pointer leads to a local variable of the function.
fn is_local(module: &Module, function: &Function, pointer: Handle<Expression>) -> bool {
    match &function.expressions[pointer] {
        Expression::LocalVariable(_) => true,
        Expression::GlobalVariable(global) => {
            module.global_variables[*global].space == AddressSpace::Function
        }
        Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => {
            is_local(module, function, *base)
        }
        _ => false,
    }
}

fn count(block: &Block) -> usize {
    let mut count = 0;
    statements(block, &mut |_| count += 1);
    count
}

/// What is known of a function's expressions.
struct Folded {
    /// The value of each expression that is a decided bool.
    known: Vec<Option<bool>>,
    /// The expression that each one equals.
    same: Vec<Handle<Expression>>,
}

impl Folded {
    fn of(function: &Function) -> Self {
        let mut folded = Self { known: Vec::new(), same: Vec::new() };
        for (handle, expression) in function.expressions.iter() {
            let known = |operand: &Handle<Expression>| folded.known[operand.index()];
            let is = |operand: &Handle<Expression>| Ok(folded.same[operand.index()]);
            let chosen = |condition: &Handle<Expression>| match &function.expressions[*condition] {
                Expression::Splat { value, .. } => known(value),
                _ => known(condition),
            };
            // Ok: equal to another expression; Err: known or not.
            let result = match expression {
                Expression::Literal(Literal::Bool(value)) => Err(Some(*value)),
                Expression::Unary { op: UnaryOperator::LogicalNot, expr } => {
                    Err(known(expr).map(|value| !value))
                }
                Expression::Binary { op: BinaryOperator::And | BinaryOperator::LogicalAnd, left, right } => {
                    match (known(left), known(right)) {
                        (Some(false), _) | (_, Some(false)) => Err(Some(false)),
                        (Some(true), _) => is(right),
                        (_, Some(true)) => is(left),
                        _ => Err(None),
                    }
                }
                Expression::Binary {
                    op: BinaryOperator::InclusiveOr | BinaryOperator::LogicalOr,
                    left,
                    right,
                } => match (known(left), known(right)) {
                    (Some(true), _) | (_, Some(true)) => Err(Some(true)),
                    (Some(false), _) => is(right),
                    (_, Some(false)) => is(left),
                    _ => Err(None),
                },
                Expression::Binary { op: BinaryOperator::Equal, left, right } => {
                    Err(known(left).zip(known(right)).map(|(left, right)| left == right))
                }
                Expression::Binary { op: BinaryOperator::NotEqual, left, right } => {
                    Err(known(left).zip(known(right)).map(|(left, right)| left != right))
                }
                Expression::Select { condition, accept, reject } => match chosen(condition) {
                    Some(true) => is(accept),
                    Some(false) => is(reject),
                    None => Err(None),
                },
                _ => Err(None),
            };
            // An expression equal to a known one is known, too.
            let (same, known) = match result {
                Ok(same) => (same, folded.known[same.index()]),
                Err(known) => (handle, known),
            };
            folded.same.push(same);
            folded.known.push(known);
        }
        folded
    }

    fn same(&self, handle: Handle<Expression>) -> Handle<Expression> {
        self.same[handle.index()]
    }

    /// A block with decided statements replaced by what they come to.
    fn block(&self, block: Block) -> Block {
        let mut out = Block::new();
        for (mut statement, span) in block.span_into_iter() {
            let inner = match &mut statement {
                Statement::Block(inner) => Some(core::mem::take(inner)),
                Statement::If { condition, accept, reject } => self.known[condition.index()]
                    .map(|value| core::mem::take(if value { accept } else { reject })),
                _ => None,
            };
            match inner {
                Some(inner) => out.extend_block(self.block(inner)),
                None => {
                    for within in blocks(&mut statement) {
                        *within = self.block(core::mem::take(within));
                    }
                    if !is_hollow(&statement) {
                        out.push(statement, span);
                    }
                }
            }
            if out.last().is_some_and(leaves) {
                break;
            }
        }
        out
    }

    /// The expressions that the body comes to need, results of calls that have no other effect only where
    /// something reads them.
    fn needed(
        &self,
        function: &Function,
        body: &Block,
        pure: &dyn Fn(Handle<Function>) -> bool,
    ) -> Result<BTreeSet<Handle<Expression>>, TranslateError> {
        let mut pending: Vec<Handle<Expression>> = Vec::new();
        let mut calls: Vec<(Vec<Handle<Expression>>, Handle<Expression>)> = Vec::new();
        let mut supported = true;
        statements(body, &mut |statement| match statement {
            Statement::Call { function, arguments, result: Some(result) } if pure(*function) => {
                calls.push((arguments.clone(), *result));
            }
            _ => {
                supported &= statement_operands(&mut statement.clone(), &mut |operand| pending.push(*operand))
            }
        });
        let mut needed = BTreeSet::new();
        loop {
            while let Some(handle) = pending.pop() {
                let handle = self.same(handle);
                if !needed.insert(handle) || self.literal(handle).is_some() {
                    continue;
                }
                let mut expression = function.expressions[handle].clone();
                supported &= operands(&mut expression, &mut |operand| pending.push(*operand));
                if let Expression::LocalVariable(local) = expression {
                    pending.extend(function.local_variables[local].init);
                }
            }
            let Some(at) = calls.iter().position(|(_, result)| needed.contains(result)) else { break };
            pending.extend(calls.swap_remove(at).0);
        }
        if supported {
            Ok(needed)
        } else {
            Err(failed("cannot select", "a kind of statement that the include has no use for"))
        }
    }

    /// What a decided expression is, where it is not so already.
    fn literal(&self, handle: Handle<Expression>) -> Option<Expression> {
        self.known[handle.index()].map(|value| Expression::Literal(Literal::Bool(value)))
    }

    /// The function from a body and the expressions that it needs.
    fn rebuild(
        &self,
        function: &Function,
        mut body: Block,
        needed: &BTreeSet<Handle<Expression>>,
    ) -> Result<Function, TranslateError> {
        let mut locals = Arena::new();
        let mut new_local = vec![None; function.local_variables.len()];
        for (handle, local) in function.local_variables.iter() {
            let used = |h: &Handle<Expression>| matches!(function.expressions[*h], Expression::LocalVariable(l) if l == handle);
            if needed.iter().any(used) {
                let span = function.local_variables.get_span(handle);
                new_local[handle.index()] = Some(locals.append(local.clone(), span));
            }
        }
        let mut expressions = Arena::new();
        let mut new: Vec<Option<Handle<Expression>>> = vec![None; function.expressions.len()];
        for handle in needed {
            let mut expression =
                self.literal(*handle).unwrap_or_else(|| function.expressions[*handle].clone());
            let mut complete = true;
            operands(&mut expression, &mut |operand| match new[self.same(*operand).index()] {
                Some(moved) => *operand = moved,
                None => complete = false,
            });
            if let Expression::LocalVariable(local) = &mut expression {
                match new_local[local.index()] {
                    Some(moved) => *local = moved,
                    None => complete = false,
                }
            }
            if !complete {
                return Err(failed("cannot select", "an expression comes before what it needs"));
            }
            new[handle.index()] =
                Some(expressions.append(expression, function.expressions.get_span(*handle)));
        }
        let moved = |handle: Handle<Expression>| new[self.same(handle).index()];
        for (_, local) in locals.iter_mut() {
            local.init = local.init.and_then(moved);
        }
        body = self.renumber(body, &expressions, &new);
        Ok(Function {
            name: function.name.clone(),
            arguments: function.arguments.clone(),
            result: function.result.clone(),
            local_variables: locals,
            named_expressions: function
                .named_expressions
                .iter()
                .filter_map(|(handle, name)| Some((moved(*handle)?, name.clone())))
                .filter(|(handle, _)| !expressions[*handle].needs_pre_emit())
                .collect(),
            expressions,
            body,
            diagnostic_filter_leaf: function.diagnostic_filter_leaf,
        })
    }

    /// A block with the new numbers of its expressions.
    fn renumber(
        &self,
        block: Block,
        expressions: &Arena<Expression>,
        new: &[Option<Handle<Expression>>],
    ) -> Block {
        let mut out = Block::new();
        for (mut statement, span) in block.span_into_iter() {
            if let Statement::Emit(range) = &statement {
                for range in emitted(range, expressions, new) {
                    out.push(Statement::Emit(range), span);
                }
                continue;
            }
            statement_operands(&mut statement, &mut |operand| {
                if let Some(moved) = new[self.same(*operand).index()] {
                    *operand = moved;
                }
            });
            for within in blocks(&mut statement) {
                *within = self.renumber(core::mem::take(within), expressions, new);
            }
            out.push(statement, span);
        }
        out
    }
}

/// The ranges of new expressions that take the place of an old one. Literals need no place.
fn emitted(
    range: &Range<Expression>,
    expressions: &Arena<Expression>,
    new: &[Option<Handle<Expression>>],
) -> Vec<Range<Expression>> {
    let mut ranges: Vec<(Handle<Expression>, Handle<Expression>)> = Vec::new();
    for handle in range.clone().filter_map(|old| new[old.index()]) {
        if expressions[handle].needs_pre_emit() {
            continue;
        }
        match ranges.last_mut() {
            Some((_, last)) if last.index() + 1 == handle.index() => *last = handle,
            _ => ranges.push((handle, handle)),
        }
    }
    ranges.into_iter().map(|(first, last)| Range::new_from_bounds(first, last)).collect()
}

/// Whether what follows a statement is never run.
fn leaves(statement: &Statement) -> bool {
    matches!(statement, Statement::Return { .. } | Statement::Break | Statement::Continue | Statement::Kill)
}

/// Whether a statement is an `if` around nothing.
fn is_hollow(statement: &Statement) -> bool {
    match statement {
        Statement::If { accept, reject, .. } => {
            accept.iter().chain(reject.iter()).all(|within| matches!(within, Statement::Emit(_)))
        }
        _ => false,
    }
}

/// A block without calls that have no effect and whose results nothing needs.
fn without_dead_calls(
    block: Block,
    needed: &BTreeSet<Handle<Expression>>,
    pure: &dyn Fn(Handle<Function>) -> bool,
) -> Block {
    let mut out = Block::new();
    for (mut statement, span) in block.span_into_iter() {
        if let Statement::Call { function, result: Some(result), .. } = &statement
            && pure(*function)
            && !needed.contains(result)
        {
            continue;
        }
        for within in blocks(&mut statement) {
            *within = without_dead_calls(core::mem::take(within), needed, pure);
        }
        if !is_hollow(&statement) {
            out.push(statement, span);
        }
    }
    out
}
