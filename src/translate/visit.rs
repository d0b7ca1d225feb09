//! What expressions and statements refer to.

use naga::{AtomicFunction, Expression, Function, Handle, ImageQuery, SampleLevel, Statement};

/// A visit to each operand, which may put another in its place.
pub(super) type Visit<'a> = &'a mut dyn FnMut(&mut Handle<Expression>);

/// Visits the operands of an expression. False for the kinds that plain WGSL does not have.
pub(super) fn operands(expression: &mut Expression, visit: Visit) -> bool {
    match expression {
        Expression::Literal(_)
        | Expression::Constant(_)
        | Expression::Override(_)
        | Expression::ZeroValue(_)
        | Expression::FunctionArgument(_)
        | Expression::GlobalVariable(_)
        | Expression::LocalVariable(_)
        | Expression::CallResult(_)
        | Expression::AtomicResult { .. }
        | Expression::WorkGroupUniformLoadResult { .. } => {}
        Expression::Compose { components, .. } => components.iter_mut().for_each(visit),
        Expression::Access { base, index } => [base, index].into_iter().for_each(visit),
        Expression::AccessIndex { base: operand, .. }
        | Expression::Splat { value: operand, .. }
        | Expression::Swizzle { vector: operand, .. }
        | Expression::Load { pointer: operand }
        | Expression::Unary { expr: operand, .. }
        | Expression::Derivative { expr: operand, .. }
        | Expression::Relational { argument: operand, .. }
        | Expression::As { expr: operand, .. }
        | Expression::ArrayLength(operand) => visit(operand),
        Expression::Binary { left, right, .. } => [left, right].into_iter().for_each(visit),
        Expression::Select { condition, accept, reject } => {
            [condition, accept, reject].into_iter().for_each(visit);
        }
        Expression::Math { arg, arg1, arg2, arg3, .. } => {
            visit(arg);
            [arg1, arg2, arg3].into_iter().flatten().for_each(visit);
        }
        Expression::ImageSample {
            image, sampler, coordinate, array_index, offset, level, depth_ref, ..
        } => {
            [image, sampler, coordinate].into_iter().for_each(&mut *visit);
            [array_index, offset, depth_ref].into_iter().flatten().for_each(&mut *visit);
            match level {
                SampleLevel::Auto | SampleLevel::Zero => {}
                SampleLevel::Exact(operand) | SampleLevel::Bias(operand) => visit(operand),
                SampleLevel::Gradient { x, y } => [x, y].into_iter().for_each(visit),
            }
        }
        Expression::ImageLoad { image, coordinate, array_index, sample, level } => {
            [image, coordinate].into_iter().for_each(&mut *visit);
            [array_index, sample, level].into_iter().flatten().for_each(visit);
        }
        Expression::ImageQuery { image, query } => {
            visit(image);
            if let ImageQuery::Size { level: Some(level) } = query {
                visit(level);
            }
        }
        _ => return false,
    }
    true
}

/// Visits the expressions that a statement itself refers to, but for what it emits. False for the kinds
/// that plain WGSL does not have.
pub(super) fn statement_operands(statement: &mut Statement, visit: Visit) -> bool {
    match statement {
        Statement::Emit(_)
        | Statement::Block(_)
        | Statement::Break
        | Statement::Continue
        | Statement::Kill
        | Statement::ControlBarrier(_)
        | Statement::MemoryBarrier(_)
        | Statement::Return { value: None } => {}
        Statement::If { condition, .. } => visit(condition),
        Statement::Switch { selector, .. } => visit(selector),
        Statement::Loop { break_if, .. } => break_if.iter_mut().for_each(visit),
        Statement::Return { value: Some(value) } => visit(value),
        Statement::Store { pointer, value } => [pointer, value].into_iter().for_each(visit),
        Statement::ImageStore { image, coordinate, array_index, value } => {
            [image, coordinate, value].into_iter().chain(array_index).for_each(visit);
        }
        Statement::Atomic { pointer, fun, value, result } => {
            [pointer, value].into_iter().chain(result).for_each(&mut *visit);
            if let AtomicFunction::Exchange { compare: Some(compare) } = fun {
                visit(compare);
            }
        }
        Statement::WorkGroupUniformLoad { pointer, result } => {
            [pointer, result].into_iter().for_each(visit);
        }
        Statement::Call { arguments, result, .. } => arguments.iter_mut().chain(result).for_each(visit),
        _ => return false,
    }
    true
}

/// The blocks within a statement.
pub(super) fn blocks(statement: &mut Statement) -> Vec<&mut naga::Block> {
    match statement {
        Statement::Block(block) => vec![block],
        Statement::If { accept, reject, .. } => vec![accept, reject],
        Statement::Switch { cases, .. } => cases.iter_mut().map(|case| &mut case.body).collect(),
        Statement::Loop { body, continuing, .. } => vec![body, continuing],
        _ => Vec::new(),
    }
}

/// Visits every statement of a block, those within others after the one that they are in.
pub(super) fn statements<'a>(block: &'a naga::Block, visit: &mut dyn FnMut(&'a Statement)) {
    for statement in block {
        visit(statement);
        match statement {
            Statement::Block(block) => statements(block, visit),
            Statement::If { accept, reject, .. } => {
                statements(accept, visit);
                statements(reject, visit);
            }
            Statement::Switch { cases, .. } => cases.iter().for_each(|case| statements(&case.body, visit)),
            Statement::Loop { body, continuing, .. } => {
                statements(body, visit);
                statements(continuing, visit);
            }
            _ => {}
        }
    }
}

/// The functions that a function calls, in the order of the calls.
pub(super) fn callees(function: &Function) -> Vec<Handle<Function>> {
    let mut callees = Vec::new();
    statements(&function.body, &mut |statement| {
        if let Statement::Call { function, .. } = statement {
            callees.push(*function);
        }
    });
    callees
}
