//! The part of a module that a set of effects calls for.
//!
//! The module is built anew, in an order that depends on nothing but what is in it: types, constants and
//! functions follow the order of the source, what a function calls coming first. A module that never had
//! an effect is therefore the same, bit for bit, as one that had it and lost it.

use std::collections::{BTreeMap, BTreeSet};

use naga::{
    Block, Constant, EntryPoint, Expression, Function, GlobalVariable, Handle, Literal, Module, Span,
    Statement, Type, TypeInner,
};

use super::fold::{fold, is_pure};
use super::visit::{blocks, callees, operands};
use super::{TranslateError, failed};

/// What becomes of the switches.
#[derive(Clone, Copy)]
pub(super) enum Switches<'a> {
    /// They are decided.
    Decided(&'a BTreeMap<&'a str, bool>),
    /// They stay, as constants under their names.
    Named(&'a BTreeMap<&'a str, bool>),
}

/// What the functions named `roots` and the entry points reach once the switches are decided, and nothing
/// else.
pub(super) fn select(module: &Module, roots: &[&str], switches: Switches) -> Result<Module, TranslateError> {
    let mut module = module.clone();
    match switches {
        Switches::Decided(values) => decide(&mut module, values),
        Switches::Named(values) => name(&mut module, values),
    }
    let mut pure = vec![false; module.functions.len()];
    // What a function calls comes before it.
    for handle in module.functions.iter().map(|(handle, _)| handle).collect::<Vec<_>>() {
        let is_known_pure = |callee: Handle<Function>| pure[callee.index()];
        let folded = fold(&module.functions[handle], &is_known_pure)?;
        let folded_is_pure = is_pure(&module, &folded, &is_known_pure);
        module.functions[handle] = folded;
        pure[handle.index()] = folded_is_pure;
    }
    for entry_point in &mut module.entry_points {
        entry_point.function = fold(&entry_point.function, &|callee| pure[callee.index()])?;
    }
    let mut roots: Vec<_> = roots
        .iter()
        .map(|root| {
            let found = module.functions.iter().find(|(_, function)| function.name.as_deref() == Some(*root));
            found
                .map(|(handle, _)| handle)
                .ok_or_else(|| failed("cannot select", format!("there is no {root}")))
        })
        .collect::<Result<_, _>>()?;
    roots.extend(module.entry_points.iter().flat_map(|entry_point| callees(&entry_point.function)));
    Copy::new(&module).run(roots)
}

/// Puts literals in the place of the switches, whether they are overrides or decided in the text.
fn decide(module: &mut Module, values: &BTreeMap<&str, bool>) {
    let constants: Vec<_> =
        module.constants.iter().map(|(_, constant)| value(&constant.name, values)).collect();
    let overrides: Vec<_> = module.overrides.iter().map(|(_, switch)| value(&switch.name, values)).collect();
    every_expression(module, &mut |expression| {
        let value = match expression {
            Expression::Constant(constant) => constants[constant.index()],
            Expression::Override(switch) => overrides[switch.index()],
            _ => None,
        };
        if let Some(value) = value {
            *expression = Expression::Literal(Literal::Bool(value));
        }
    });
}

fn value(name: &Option<String>, values: &BTreeMap<&str, bool>) -> Option<bool> {
    values.get(name.as_deref()?).copied()
}

/// Puts constants of the same names in the place of the switches.
fn name(module: &mut Module, values: &BTreeMap<&str, bool>) {
    let mut named = BTreeMap::new();
    let overrides: Vec<_> =
        module.overrides.iter().map(|(handle, switch)| (handle, switch.clone())).collect();
    for (handle, switch) in overrides {
        if let Some(value) = value(&switch.name, values) {
            let init = Expression::Literal(Literal::Bool(value));
            let init = module.global_expressions.append(init, Span::UNDEFINED);
            let span = module.overrides.get_span(handle);
            let constant = Constant { name: switch.name, ty: switch.ty, init };
            named.insert(handle, module.constants.append(constant, span));
        }
    }
    every_expression(module, &mut |expression| {
        if let Expression::Override(switch) = expression
            && let Some(constant) = named.get(switch)
        {
            *expression = Expression::Constant(*constant);
        }
    });
}

fn every_expression(module: &mut Module, change: &mut dyn FnMut(&mut Expression)) {
    let functions = module.functions.iter_mut().map(|(_, function)| function);
    let entry_points = module.entry_points.iter_mut().map(|entry_point| &mut entry_point.function);
    for function in functions.chain(entry_points) {
        function.expressions.iter_mut().for_each(|(_, expression)| change(expression));
    }
    module.global_expressions.iter_mut().for_each(|(_, expression)| change(expression));
}

/// A module and the one that it is copied to.
struct Copy<'a> {
    from: &'a Module,
    to: Module,
    types: BTreeMap<Handle<Type>, Handle<Type>>,
    constants: BTreeMap<Handle<Constant>, Handle<Constant>>,
    globals: BTreeMap<Handle<GlobalVariable>, Handle<GlobalVariable>>,
    expressions: BTreeMap<Handle<Expression>, Handle<Expression>>,
    functions: BTreeMap<Handle<Function>, Handle<Function>>,
}

impl<'a> Copy<'a> {
    fn new(from: &'a Module) -> Self {
        let to = Module {
            diagnostic_filters: from.diagnostic_filters.clone(),
            diagnostic_filter_leaf: from.diagnostic_filter_leaf,
            ..Module::default()
        };
        Self {
            from,
            to,
            types: BTreeMap::new(),
            constants: BTreeMap::new(),
            globals: BTreeMap::new(),
            expressions: BTreeMap::new(),
            functions: BTreeMap::new(),
        }
    }

    fn run(mut self, roots: Vec<Handle<Function>>) -> Result<Module, TranslateError> {
        let from = self.from;
        let mut reached = BTreeSet::new();
        let mut pending = roots;
        while let Some(handle) = pending.pop() {
            if reached.insert(handle) {
                pending.extend(callees(&from.functions[handle]));
            }
        }
        let functions = || {
            let entry_points = from.entry_points.iter().map(|entry_point| &entry_point.function);
            reached.iter().map(|handle| &from.functions[*handle]).chain(entry_points)
        };

        // What has a name first, in the order of the source; what has none where it is first used.
        let mut types = BTreeSet::new();
        let mut constants = BTreeSet::new();
        let mut globals = BTreeSet::new();
        for function in functions() {
            types.extend(function.arguments.iter().map(|argument| argument.ty));
            types.extend(function.result.iter().map(|result| result.ty));
            types.extend(function.local_variables.iter().map(|(_, local)| local.ty));
            for (_, expression) in function.expressions.iter() {
                match expression {
                    Expression::Constant(constant) => constants.extend([*constant]),
                    Expression::GlobalVariable(global) => globals.extend([*global]),
                    Expression::ZeroValue(kind) | Expression::Compose { ty: kind, .. } => {
                        types.extend([*kind])
                    }
                    _ => {}
                }
            }
        }
        types.extend(constants.iter().map(|constant| from.constants[*constant].ty));
        types.extend(globals.iter().map(|global| from.global_variables[*global].ty));
        let mut named = BTreeSet::new();
        types.into_iter().for_each(|kind| note_named(from, kind, &mut named));
        for handle in in_order(named, |handle| from.types.get_span(handle)) {
            self.kind(handle);
        }
        for handle in in_order(constants, |handle| from.constants.get_span(handle)) {
            self.constant(handle)?;
        }
        for handle in in_order(globals, |handle| from.global_variables.get_span(handle)) {
            let mut global = from.global_variables[handle].clone();
            global.ty = self.kind(global.ty);
            global.init = global.init.map(|init| self.global_expression(init)).transpose()?;
            let span = from.global_variables.get_span(handle);
            self.globals.insert(handle, self.to.global_variables.append(global, span));
        }
        for handle in in_order(reached, |handle| from.functions.get_span(handle)) {
            self.function(handle)?;
        }
        for entry_point in &from.entry_points {
            if entry_point.workgroup_size_overrides.is_some() {
                return Err(failed("cannot select", "the size of a workgroup is an override"));
            }
            let function = self.body(&entry_point.function)?;
            self.to.entry_points.push(EntryPoint { function, ..entry_point.clone() });
        }
        Ok(self.to)
    }

    fn function(&mut self, handle: Handle<Function>) -> Result<(), TranslateError> {
        if self.functions.contains_key(&handle) {
            return Ok(());
        }
        let from = self.from;
        for callee in callees(&from.functions[handle]) {
            self.function(callee)?;
        }
        let function = self.body(&from.functions[handle])?;
        let span = from.functions.get_span(handle);
        self.functions.insert(handle, self.to.functions.append(function, span));
        Ok(())
    }

    /// A function with everything that it refers to in the new module.
    fn body(&mut self, function: &Function) -> Result<Function, TranslateError> {
        let mut function = function.clone();
        for argument in &mut function.arguments {
            argument.ty = self.kind(argument.ty);
        }
        if let Some(result) = &mut function.result {
            result.ty = self.kind(result.ty);
        }
        for (_, local) in function.local_variables.iter_mut() {
            local.ty = self.kind(local.ty);
        }
        for (_, expression) in function.expressions.iter_mut() {
            self.expression(expression)?;
        }
        self.calls(&mut function.body);
        Ok(function)
    }

    fn calls(&self, block: &mut Block) {
        for statement in block.iter_mut() {
            if let Statement::Call { function, .. } = statement {
                *function = self.functions[function];
            }
            blocks(statement).into_iter().for_each(|block| self.calls(block));
        }
    }

    /// Leads what an expression refers to, but for its operands, to the new module.
    fn expression(&mut self, expression: &mut Expression) -> Result<(), TranslateError> {
        match expression {
            Expression::Constant(constant) => *constant = self.constant(*constant)?,
            Expression::GlobalVariable(global) => *global = self.globals[global],
            Expression::CallResult(function) => *function = self.functions[function],
            Expression::ZeroValue(kind)
            | Expression::Compose { ty: kind, .. }
            | Expression::AtomicResult { ty: kind, .. }
            | Expression::WorkGroupUniformLoadResult { ty: kind } => *kind = self.kind(*kind),
            Expression::Override(switch) => {
                let name = self.from.overrides[*switch].name.clone().unwrap_or_default();
                return Err(failed("cannot select", format!("the override {name} is no effect's")));
            }
            _ => {}
        }
        Ok(())
    }

    fn global_expression(
        &mut self,
        handle: Handle<Expression>,
    ) -> Result<Handle<Expression>, TranslateError> {
        if let Some(copied) = self.expressions.get(&handle) {
            return Ok(*copied);
        }
        let mut expression = self.from.global_expressions[handle].clone();
        let mut result = Ok(());
        operands(&mut expression, &mut |operand| match self.global_expression(*operand) {
            Ok(copied) => *operand = copied,
            Err(error) => result = Err(error),
        });
        result?;
        self.expression(&mut expression)?;
        let span = self.from.global_expressions.get_span(handle);
        let copied = self.to.global_expressions.append(expression, span);
        self.expressions.insert(handle, copied);
        Ok(copied)
    }

    fn constant(&mut self, handle: Handle<Constant>) -> Result<Handle<Constant>, TranslateError> {
        if let Some(copied) = self.constants.get(&handle) {
            return Ok(*copied);
        }
        let mut constant = self.from.constants[handle].clone();
        constant.ty = self.kind(constant.ty);
        constant.init = self.global_expression(constant.init)?;
        let copied = self.to.constants.append(constant, self.from.constants.get_span(handle));
        self.constants.insert(handle, copied);
        Ok(copied)
    }

    fn kind(&mut self, handle: Handle<Type>) -> Handle<Type> {
        if let Some(copied) = self.types.get(&handle) {
            return *copied;
        }
        let mut kind = self.from.types[handle].clone();
        parts(&mut kind.inner, &mut |part| *part = self.kind(*part));
        let copied = self.to.types.insert(kind, self.from.types.get_span(handle));
        self.types.insert(handle, copied);
        copied
    }
}

/// Visits the types that a type is made of.
fn parts(kind: &mut TypeInner, visit: &mut dyn FnMut(&mut Handle<Type>)) {
    match kind {
        TypeInner::Pointer { base, .. }
        | TypeInner::Array { base, .. }
        | TypeInner::BindingArray { base, .. } => {
            visit(base);
        }
        TypeInner::Struct { members, .. } => members.iter_mut().for_each(|member| visit(&mut member.ty)),
        _ => {}
    }
}

/// Notes a type, if it has a name, and those that it is made of.
fn note_named(module: &Module, handle: Handle<Type>, named: &mut BTreeSet<Handle<Type>>) {
    let mut kind = module.types[handle].clone();
    if kind.name.is_none() || named.insert(handle) {
        parts(&mut kind.inner, &mut |part| note_named(module, *part, named));
    }
}

/// Handles in the order in which the source declares what they stand for.
fn in_order<T>(handles: BTreeSet<Handle<T>>, span: impl Fn(Handle<T>) -> Span) -> Vec<Handle<T>> {
    let mut handles: Vec<_> = handles.into_iter().collect();
    handles.sort_by_key(|handle| span(*handle).to_range().map_or(usize::MAX, |range| range.start));
    handles
}
