//! Kernels on devices that do what WGSL allows.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::super::program::{ExecuteError, Machine, Program, Resource};
use super::super::random::Random;
use super::super::texels::Texels;
use super::device::Device;
use super::finding::Finding;
use super::policy::Policy;
use crate::effects::Effects;

/// A kernel with what is bound to it, to be run on any device that conforms.
pub struct Conforming {
    program: Program,
    resources: BTreeMap<u32, Resource>,
}

/// What a texture gave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled {
    /// The texture's binding.
    pub binding: u32,
    /// The layer.
    pub layer: u32,
    /// The value.
    pub value: [f32; 4],
}

/// What a device made of an invocation.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The numbers that it wrote, in order.
    pub values: Vec<f32>,
    /// Where it left what WGSL promises.
    pub findings: Vec<Finding>,
    /// What textures gave it, in order.
    pub sampled: Vec<Sampled>,
    /// How many operations it ran.
    pub operations: usize,
}

/// The worst that errors within what is permitted make of one of the numbers that an invocation writes.
#[derive(Clone, Debug, PartialEq)]
pub struct Worst {
    /// The number with every operation to nearest.
    pub nearest: f32,
    /// The least and the largest that it may be, to first order.
    pub predicted: [f64; 2],
    /// What it is with every operation erring as far as it may to lower it, and to raise it.
    pub found: [Outcome; 2],
}

impl Conforming {
    /// A kernel of a WGSL text with the switches of a set of effects.
    ///
    /// # Errors
    ///
    /// If the text is not valid or has no such entry point.
    pub fn new(source: &str, entry_point: &str, effects: Effects) -> Result<Self, ExecuteError> {
        Ok(Self { program: Program::new(source, entry_point, effects)?, resources: BTreeMap::new() })
    }

    /// Binds a buffer that is read.
    pub fn bind_buffer(&mut self, binding: u32, bytes: &[u8]) {
        self.resources.insert(binding, Resource::Shared(bytes.into()));
    }

    /// Binds a buffer of so many bytes that is written to.
    pub fn bind_output(&mut self, binding: u32, size: usize) {
        self.resources.insert(binding, Resource::Buffer(vec![0; size]));
    }

    /// Binds a texture array.
    pub fn bind_texels(&mut self, binding: u32, texels: Texels) {
        self.resources.insert(binding, Resource::Texels(Arc::new(texels)));
    }

    /// A machine that runs it; several may at the same time.
    pub fn machine(&self) -> ConformingMachine<'_> {
        let mut machine = Machine::new(Device::default());
        machine.resources = self.resources.clone();
        ConformingMachine { program: &self.program, machine }
    }
}

/// Runs invocations of a kernel on one device after the other.
pub struct ConformingMachine<'a> {
    program: &'a Program,
    machine: Machine<Device>,
}

impl ConformingMachine<'_> {
    /// Runs the invocation of the given number on a device. Chance starts from the policy's seed and that number.
    ///
    /// # Errors
    ///
    /// If the kernel has something that the interpreter lacks, uses what is not there, or does not end.
    pub fn run(&mut self, invocation: u32, policy: Policy) -> Result<Outcome, ExecuteError> {
        self.prepared(invocation, policy, false, None)
    }

    fn prepared(
        &mut self,
        invocation: u32,
        policy: Policy,
        with_slopes: bool,
        directions: Option<(Vec<i8>, Vec<u8>)>,
    ) -> Result<Outcome, ExecuteError> {
        let seed = Random::new(policy.seed ^ (u64::from(invocation) << 32)).bits();
        self.machine.observer.prepare(Policy { seed, ..policy }, with_slopes, directions);
        self.program.run(&mut self.machine, invocation)?;
        let device = &self.machine.observer;
        let sampled = device.sampled.iter();
        Ok(Outcome {
            values: device.written.iter().map(|number| number.float()).collect(),
            findings: device.inspected(),
            sampled: sampled.map(|&(binding, layer, value)| Sampled { binding, layer, value }).collect(),
            operations: device.trace.next() as usize - 1,
        })
    }

    /// Runs the invocation on the devices that err the most: first with every operation to nearest, in the order that the
    /// policy says, then, for each of the first `count` numbers that it writes, with every operation erring as far as is
    /// permitted in the direction that lowers that number, and in the other. Those directions are to first order.
    ///
    /// # Errors
    ///
    /// As [`ConformingMachine::run`].
    pub fn worst(
        &mut self,
        invocation: u32,
        policy: Policy,
        count: usize,
    ) -> Result<Vec<Worst>, ExecuteError> {
        self.prepared(invocation, policy, true, None)?;
        let trace = &self.machine.observer.trace;
        let kinds = trace.kinds();
        let written: Vec<_> = self.machine.observer.written.iter().take(count).copied().collect();
        let sensitivities: Vec<_> = written.iter().map(|number| trace.sensitivity(*number)).collect();
        let each = written.iter().zip(sensitivities);
        each.map(|(number, (directions, reach))| {
            let mut towards = |sign: i8| {
                let directions = directions.iter().map(|direction| sign * direction).collect();
                self.prepared(invocation, policy, true, Some((directions, kinds.clone())))
            };
            let nearest = number.float();
            let predicted = reach.map(|reach| f64::from(nearest) + reach);
            Ok(Worst { nearest, predicted, found: [towards(-1)?, towards(1)?] })
        })
        .collect()
    }
}
