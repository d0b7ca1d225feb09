//! Every loop of the shaders ends: each has a counter that every round moves towards a bound that no round moves.

use naga::{
    BinaryOperator as Operator, Block, Expression, Function, Handle, Literal, LocalVariable, Module,
    Statement,
};

type Local = Handle<LocalVariable>;

fn module(source: &str) -> Module {
    naga::front::wgsl::parse_str(source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)))
}

/// Every statement of a block, those within others too.
fn each<'a>(block: &'a Block, visit: &mut dyn FnMut(&'a Statement)) {
    for statement in block {
        visit(statement);
        match statement {
            Statement::Block(inner) => each(inner, visit),
            Statement::If { accept, reject, .. } => [accept, reject].into_iter().for_each(|b| each(b, visit)),
            Statement::Switch { cases, .. } => cases.iter().for_each(|case| each(&case.body, visit)),
            Statement::Loop { body, continuing, .. } => {
                [body, continuing].into_iter().for_each(|b| each(b, visit));
            }
            _ => {}
        }
    }
}

/// A loop within a function.
struct Loop<'a> {
    module: &'a Module,
    function: &'a Function,
    body: &'a Block,
    continuing: &'a Block,
}

impl Loop<'_> {
    fn expression(&self, handle: Handle<Expression>) -> &Expression {
        &self.function.expressions[handle]
    }

    /// The local variable that a pointer leads into.
    fn root(&self, pointer: Handle<Expression>) -> Option<Local> {
        match *self.expression(pointer) {
            Expression::LocalVariable(local) => Some(local),
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => self.root(base),
            _ => None,
        }
    }

    /// The local variable whose value an expression is.
    fn loaded(&self, handle: Handle<Expression>) -> Option<Local> {
        match *self.expression(handle) {
            Expression::Load { pointer } => match *self.expression(pointer) {
                Expression::LocalVariable(local) => Some(local),
                _ => None,
            },
            _ => None,
        }
    }

    /// How often a round may write a variable, and in how many places a function gets hold of it.
    fn writes(&self, local: Local) -> usize {
        let mut count = 0;
        for block in [self.body, self.continuing] {
            each(block, &mut |statement| match statement {
                Statement::Store { pointer, .. } => count += usize::from(self.root(*pointer) == Some(local)),
                Statement::Call { arguments, .. } => {
                    count += arguments.iter().filter(|argument| self.root(**argument) == Some(local)).count();
                }
                _ => {}
            });
        }
        count
    }

    /// A whole number above zero that is known when the shader is compiled.
    fn positive(&self, handle: Handle<Expression>) -> Option<i64> {
        let known = |literal: &Literal| match *literal {
            Literal::I32(value) => Some(value.into()),
            Literal::U32(value) => Some(value.into()),
            _ => None,
        };
        let value = match *self.expression(handle) {
            Expression::Literal(ref literal) => known(literal),
            Expression::Constant(constant) => {
                match &self.module.global_expressions[self.module.constants[constant].init] {
                    Expression::Literal(literal) => known(literal),
                    _ => None,
                }
            }
            _ => None,
        };
        value.filter(|value| *value > 0)
    }

    /// Whether a value is the same in every round.
    fn is_fixed(&self, handle: Handle<Expression>) -> bool {
        match *self.expression(handle) {
            Expression::Literal(_)
            | Expression::Constant(_)
            | Expression::Override(_)
            | Expression::FunctionArgument(_)
            | Expression::GlobalVariable(_) => true,
            Expression::LocalVariable(local) => self.writes(local) == 0,
            // Inputs that a shader only reads.
            Expression::ArrayLength(_) => true,
            Expression::Load { pointer } => self.is_fixed(pointer),
            Expression::AccessIndex { base, .. } => self.is_fixed(base),
            Expression::Access { base, index } => self.is_fixed(base) && self.is_fixed(index),
            Expression::Binary { left, right, .. } => self.is_fixed(left) && self.is_fixed(right),
            Expression::ImageQuery { .. } => true,
            // What was computed before the loop began, such as what a call returned.
            Expression::CallResult(_) => !self.emits(handle),
            _ => false,
        }
    }

    fn emits(&self, handle: Handle<Expression>) -> bool {
        let mut found = false;
        for block in [self.body, self.continuing] {
            each(block, &mut |statement| {
                found |=
                    matches!(statement, Statement::Call { result: Some(result), .. } if *result == handle);
            });
        }
        found
    }

    /// The counter and its bound, where a round leaves the loop by `condition` being `value`.
    fn counter(&self, condition: Handle<Expression>, value: bool) -> Option<(Local, bool)> {
        let Expression::Binary { op, left, right } = *self.expression(condition) else { return None };
        let local = self.loaded(left).filter(|_| self.is_fixed(right))?;
        // Upwards to a bound, or down to zero and below.
        match (op, value) {
            (Operator::GreaterEqual, true) | (Operator::Less, false) => Some((local, true)),
            (Operator::Greater, false) => Some((local, false)),
            _ => None,
        }
    }

    /// Whether the value that a round writes to a counter is a step towards its bound.
    fn is_step(&self, local: Local, value: Handle<Expression>, up: bool) -> bool {
        let Expression::Binary { op, left, right } = *self.expression(value) else { return false };
        self.loaded(left) == Some(local)
            && match (op, up) {
                (Operator::Add, true) => self.positive(right).is_some(),
                (Operator::Divide, false) => self.positive(right).is_some_and(|by| by > 1),
                _ => false,
            }
    }

    /// Whether the loop ends for all inputs: every round that does not leave it comes to the check and to the one step.
    fn ends(&self) -> bool {
        let leaves = |block: &Block| matches!(block.last(), Some(Statement::Break));
        let counters = self.body.iter().filter_map(|statement| match statement {
            Statement::If { condition, accept, .. } if leaves(accept) => self.counter(*condition, true),
            Statement::If { condition, reject, .. } if leaves(reject) => self.counter(*condition, false),
            _ => None,
        });
        let mut continues = false;
        each(self.body, &mut |statement| continues |= matches!(statement, Statement::Continue));
        counters.into_iter().any(|(local, up)| {
            let steps = |block: &Block| {
                block
                    .iter()
                    .filter(|statement| {
                        matches!(statement, Statement::Store { pointer, value }
                            if self.root(*pointer) == Some(local) && self.is_step(local, *value, up))
                    })
                    .count()
            };
            // A round that is cut short comes to the continuing block only.
            let reached = steps(self.continuing) + if continues { 0 } else { steps(self.body) };
            self.writes(local) == 1 && reached == 1
        })
    }
}

/// How many loops there are, and the functions of those that may not end.
fn endless(source: &str) -> (usize, Vec<String>) {
    let module = module(source);
    let (mut count, mut found) = (0, Vec::new());
    let entries = module.entry_points.iter().map(|entry| &entry.function);
    for function in module.functions.iter().map(|(_, function)| function).chain(entries) {
        each(&function.body, &mut |statement| {
            if let Statement::Loop { body, continuing, break_if } = statement {
                count += 1;
                let one = Loop { module: &module, function, body, continuing };
                if break_if.is_some() || !one.ends() {
                    found.push(function.name.clone().unwrap_or_default());
                }
            }
        });
    }
    (count, found)
}

#[test]
fn every_loop_has_a_counter_with_a_bound() {
    let include = softbox::WGSL_INCLUDE;
    let sources = [
        ("the include", include.to_owned(), 6),
        ("evaluate.wgsl", format!("{include}\n{}", softbox::WGSL_EVALUATE), 7),
        ("render.wgsl", format!("{include}\n{}", softbox::WGSL_RENDER), 12),
        ("prefilter.wgsl", softbox::WGSL_PREFILTER.to_owned(), 5),
    ];
    for (name, source, known) in sources {
        let (count, endless) = endless(&source);
        assert!(endless.is_empty(), "{name}: loops without a bound in {endless:?}");
        assert_eq!(count, known, "{name}");
    }
}

/// The include's own loops run over the lobes of a surface, which are three at most: no other number is ever written there.
#[test]
fn no_surface_has_more_than_three_lobes() {
    let module = module(softbox::WGSL_INCLUDE);
    let (lobes, inner) = module
        .types
        .iter()
        .find(|(_, ty)| ty.name.as_deref() == Some("LtcLobes"))
        .map(|(handle, ty)| (handle, &ty.inner))
        .expect("the include has LtcLobes");
    let naga::TypeInner::Struct { members, .. } = inner else { panic!("LtcLobes is a structure") };
    let field = members.iter().position(|member| member.name.as_deref() == Some("count")).expect("count");
    let mut written = Vec::new();
    for (_, function) in module.functions.iter() {
        for (_, expression) in function.expressions.iter() {
            let composed = matches!(expression, Expression::Compose { ty, .. } if *ty == lobes);
            assert!(!composed, "{:?} makes lobes in another way", function.name);
        }
        each(&function.body, &mut |statement| {
            let Statement::Store { pointer, value } = statement else { return };
            let Expression::AccessIndex { base, index } = function.expressions[*pointer] else { return };
            let of_lobes = match function.expressions[base] {
                Expression::LocalVariable(local) => function.local_variables[local].ty == lobes,
                _ => false,
            };
            if of_lobes && index as usize == field {
                match function.expressions[*value] {
                    Expression::Literal(Literal::I32(count)) => written.push(count),
                    ref other => panic!("{:?} writes {other:?} to the count", function.name),
                }
            }
        });
    }
    written.sort_unstable();
    assert_eq!(written, [1, 2, 3]);
}

/// The check would tell: loops that may go on for some input.
#[test]
fn loops_without_a_bound_are_seen() {
    let function = |body: &str| format!("fn f(x: f32, n: i32) {{ var y = x; var i = 0; {body} }}");
    for body in [
        "loop { if (y > 1.0) { break; } y *= 2.0; }",
        "loop { if (i >= n) { break; } }",
        "loop { if (i >= n) { break; } i -= 1; }",
        "loop { if (i >= n) { break; } if (y > 1.0) { i += 1; } }",
        "loop { if (i >= n) { break; } i += 1; if (y > 1.0) { i = 0; } }",
        "var m = n; loop { if (i >= m) { break; } i += 1; m += 1; }",
        "loop { if (i >= n) { break; } if (y > 1.0) { continue; } i += 1; }",
        "loop { if (y > 1.0) { if (i >= n) { break; } } i += 1; }",
        "while (y < 1.0) { y *= 2.0; }",
    ] {
        assert_eq!(endless(&function(body)), (1, vec!["f".to_owned()]), "{body}");
    }
    for body in [
        "loop { if (i >= n) { break; } i += 1; }",
        "for (i = 0; i < n; i++) { if (y > 1.0) { continue; } y *= 2.0; }",
        "for (var k = 8u; k > 0u; k /= 2u) { y *= 2.0; }",
    ] {
        assert_eq!(endless(&function(body)), (1, Vec::new()), "{body}");
    }
}
