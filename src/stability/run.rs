//! The catalogue at a level through one stack and another.

use serde::Serialize;

use super::{FamilyRow, Inputs, Stack, StackRow, driver_name, driver_version, program};
use crate::device::{Device, DeviceError};

/// What one stack made of the cases of a level.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Run {
    /// All of them together.
    pub stack: StackRow,
    /// Family by family, in the order of the catalogue.
    pub families: Vec<FamilyRow>,
    /// The values.
    #[serde(skip)]
    pub values: Vec<[f32; 3]>,
}

impl Run {
    /// A line of JSON for each family, with the driver and the level that it is of.
    ///
    /// # Errors
    ///
    /// If a row cannot be written as JSON: what is said.
    pub fn lines(&self) -> Result<String, String> {
        let line = |row: &FamilyRow| {
            let mut value = serde_json::to_value(row).map_err(|error| error.to_string())?;
            value["driver"] = self.stack.driver.as_str().into();
            value["level"] = self.stack.level.as_str().into();
            Ok(format!("{value}\n"))
        };
        self.families.iter().map(line).collect()
    }
}

impl Inputs {
    /// The run that gave `values`, compared with those of a reference stack.
    pub fn run(&self, stack: &Stack, values: Vec<[f32; 3]>, reference: &[[f32; 3]]) -> Run {
        Run { stack: self.row(stack, &values, reference), families: self.families(&values), values }
    }

    /// The twin of the include on the CPU, in single precision.
    pub fn run_twin(&self, command: &str) -> Run {
        let values = self.twin();
        let stack = Stack {
            driver: "CPU".to_owned(),
            path: "twin in Rust".to_owned(),
            version: format!("softbox {}, {}", env!("CARGO_PKG_VERSION"), std::env::consts::ARCH),
            command: command.to_owned(),
        };
        self.run(&stack, values.clone(), &values)
    }

    /// The include on a wgpu device, compared with the values of a reference stack.
    ///
    /// # Errors
    ///
    /// If the device refuses the kernel or fails.
    pub fn run_device(
        &self,
        device: &Device,
        command: &str,
        reference: &[[f32; 3]],
    ) -> Result<Run, DeviceError> {
        let program = program(self.level).map_err(|error| DeviceError::Failed {
            adapter: device.info().name.clone(),
            reason: error.to_string(),
        })?;
        let values = device.evaluate(&program, &self.table, &self.batch)?;
        let stack = Stack {
            driver: driver_name(device),
            path: "WGSL, naga".to_owned(),
            version: driver_version(device),
            command: command.to_owned(),
        };
        Ok(self.run(&stack, values, reference))
    }
}
