//! What pointers of an interpreted kernel lead to: local variables, buffers and textures.

use naga::{Expression, GlobalVariable, Handle, Literal, Type, TypeInner};

use super::number::{Kind, Number, Operation};
use super::observer::Observer;
use super::program::{ExecuteError, Resource, unsupported};
use super::run::Context;
use super::texels::Texels;
use super::values::{self, Value};

impl<O: Observer> Context<'_, O> {
    /// A constant expression outside of functions.
    pub(super) fn global(&self, handle: Handle<Expression>) -> Result<Value, ExecuteError> {
        match &self.module.global_expressions[handle] {
            Expression::Literal(literal) => constant(literal),
            Expression::Constant(constant) => self.global(self.module.constants[*constant].init),
            Expression::ZeroValue(kind) => self.zero(*kind),
            Expression::Splat { size, value } => {
                Ok(Value::vector(&[self.global(*value)?.component(0)?; 4][..*size as usize]))
            }
            Expression::Compose { ty, components } => {
                let parts = components.iter().map(|part| self.global(*part)).collect::<Result<_, _>>()?;
                values::compose(&self.module.types[*ty].inner, parts)
            }
            other => unsupported(other),
        }
    }

    pub(super) fn zero(&self, kind: Handle<Type>) -> Result<Value, ExecuteError> {
        values::zero(self.module, kind)
    }

    pub(super) fn variable(&self, global: Handle<GlobalVariable>) -> Result<Value, ExecuteError> {
        let variable = &self.module.global_variables[global];
        let Some(at) = &variable.binding else { return unsupported("variable without a binding") };
        Ok(match self.module.types[variable.ty].inner {
            TypeInner::Image { .. } | TypeInner::Sampler { .. } => Value::Handle(at.binding),
            _ => Value::Buffer { binding: at.binding, offset: 0, kind: variable.ty },
        })
    }

    pub(super) fn bytes(&self, binding: u32) -> Result<&[u8], ExecuteError> {
        match self.on.resources.get(&binding) {
            Some(Resource::Buffer(bytes)) => Ok(bytes),
            Some(Resource::Shared(bytes)) => Ok(bytes),
            _ => Err(ExecuteError::Missing(format!("a buffer at binding {binding}"))),
        }
    }

    pub(super) fn texels(&self, binding: u32) -> Result<&Texels, ExecuteError> {
        match self.on.resources.get(&binding) {
            Some(Resource::Texels(texels)) => Ok(texels),
            _ => Err(ExecuteError::Missing(format!("a texture at binding {binding}"))),
        }
    }

    /// A part of a value or of what a pointer leads to.
    pub(super) fn access(&self, base: Value, index: u32) -> Result<Value, ExecuteError> {
        match base {
            Value::Local { cell, path } => Ok(Value::Local { cell, path: path.and(index)? }),
            Value::Buffer { binding, offset, kind } => {
                let (step, kind) = match &self.module.types[kind].inner {
                    TypeInner::Array { base, stride, .. } => (index * stride, *base),
                    TypeInner::Struct { members, .. } => {
                        (members[index as usize].offset, members[index as usize].ty)
                    }
                    TypeInner::Vector { scalar, .. } => {
                        let kind = values::kind(scalar.kind)?;
                        return Ok(Value::Word { binding, offset: offset + 4 * index, kind });
                    }
                    other => return unsupported(other),
                };
                Ok(Value::Buffer { binding, offset: offset + step, kind })
            }
            value => value.part(index as usize),
        }
    }

    pub(super) fn load(&mut self, pointer: &Value, site: u32) -> Result<Value, ExecuteError> {
        match *pointer {
            Value::Local { cell, ref path } => {
                let mut value = &self.on.cells[cell];
                for (at, index) in path.indices().iter().enumerate() {
                    match value {
                        Value::Composite(parts) => value = &parts[*index as usize],
                        Value::Vector(..) if at + 1 == path.indices().len() => {
                            return value.clone().part(*index as usize);
                        }
                        other => return unsupported(other),
                    }
                }
                Ok(value.clone())
            }
            Value::Word { binding, offset, kind } => {
                Ok(Value::Scalar(self.word(binding, offset, kind, site)?))
            }
            Value::Buffer { binding, offset, kind } => {
                let module = self.module;
                values::read(module, kind, offset, &mut |offset, kind| self.word(binding, offset, kind, site))
            }
            ref other => unsupported(other),
        }
    }

    pub(super) fn word(
        &mut self,
        binding: u32,
        offset: u32,
        kind: Kind,
        site: u32,
    ) -> Result<Number, ExecuteError> {
        let at = offset as usize;
        let Some(word) = self.bytes(binding)?.get(at..at + 4) else {
            return Err(ExecuteError::Missing(format!("byte {at} of the buffer at binding {binding}")));
        };
        let bits = u32::from_le_bytes([word[0], word[1], word[2], word[3]]);
        Ok(self.note(Operation::Load(binding, offset), &[], (bits, kind), site))
    }

    pub(super) fn store(&mut self, pointer: &Value, value: Value) -> Result<(), ExecuteError> {
        match pointer {
            Value::Local { cell, path } => self.on.cells[*cell].set(path.indices(), value),
            Value::Buffer { binding, offset, .. } | Value::Word { binding, offset, .. } => {
                let numbers = match &value {
                    Value::Scalar(number) => core::slice::from_ref(number),
                    Value::Vector(size, numbers) => &numbers[..*size],
                    other => return unsupported(other),
                };
                numbers.iter().for_each(|number| self.on.observer.written(*number));
                let Some(Resource::Buffer(bytes)) = self.on.resources.get_mut(binding) else {
                    return Err(ExecuteError::Missing(format!("a buffer at binding {binding}")));
                };
                let at = *offset as usize;
                let Some(place) = bytes.get_mut(at..at + 4 * numbers.len()) else {
                    return Err(ExecuteError::Missing(format!(
                        "byte {at} of the buffer at binding {binding}"
                    )));
                };
                let words = numbers.iter().flat_map(|number| number.bits.to_le_bytes());
                place.iter_mut().zip(words).for_each(|(to, from)| *to = from);
                Ok(())
            }
            other => unsupported(other),
        }
    }

    pub(super) fn sample(
        &mut self,
        image: &Value,
        coordinate: &Value,
        layer: Option<Value>,
        site: u32,
    ) -> Result<Value, ExecuteError> {
        let &Value::Handle(binding) = image else { return unsupported(image) };
        let (x, y) = (coordinate.component(0)?, coordinate.component(1)?);
        let layer = layer.map_or(Ok(Number::constant(0, Kind::Sint)), |layer| layer.component(0))?;
        let place = self.place(site);
        let Some(Resource::Texels(texels)) = self.on.resources.get(&binding) else {
            return Err(ExecuteError::Missing(format!("a texture at binding {binding}")));
        };
        Ok(Value::vector(&self.on.observer.sample(binding, texels, [x, y], layer, place)))
    }
}

pub(super) fn constant(literal: &Literal) -> Result<Value, ExecuteError> {
    Ok(Value::Scalar(match literal {
        Literal::F32(value) => Number::constant(value.to_bits(), Kind::Float),
        Literal::U32(value) => Number::constant(*value, Kind::Uint),
        Literal::I32(value) => Number::constant(*value as u32, Kind::Sint),
        Literal::Bool(value) => Number::constant(u32::from(*value), Kind::Bool),
        other => return unsupported(other),
    }))
}
