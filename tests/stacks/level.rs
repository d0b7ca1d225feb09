//! The cases of a level, as every stack reads them.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock};

use bytemuck::{Pod, cast_slice};
use softbox::device::Device;
use softbox::effects::Quality;
use softbox::stability::{Inputs, program};

use crate::{is_long, tools};

/// A level with its cases and its folder.
pub struct Level {
    /// Cases and exact values.
    pub inputs: Inputs,
    /// Where its files are.
    pub folder: PathBuf,
    reference: OnceLock<Result<Vec<[f32; 3]>, String>>,
    made: Mutex<HashMap<String, Result<PathBuf, String>>>,
}

/// Units of cases: see `softbox::stability::cases`.
fn count() -> usize {
    let count = std::env::var("SOFTBOX_STACKS_CASES").ok();
    count.map_or(if is_long() { 15 } else { 6 }, |count| {
        count.parse().unwrap_or_else(|error| panic!("SOFTBOX_STACKS_CASES={count}: {error}"))
    })
}

impl Level {
    /// The level, made at the first call.
    pub fn of(quality: Quality) -> &'static Self {
        static LEVELS: [OnceLock<Level>; 4] = [const { OnceLock::new() }; 4];
        let index = Quality::ALL.iter().position(|level| *level == quality).unwrap_or_default();
        LEVELS[index].get_or_init(|| {
            let inputs = Inputs::of(quality, count());
            let folder = tools::scratch(&format!("stacks_{quality}"));
            write(&folder, &inputs);
            Self { inputs, folder, reference: OnceLock::new(), made: Mutex::default() }
        })
    }

    /// What the first Vulkan adapter makes of the WGSL.
    pub fn reference(&self) -> Result<&[[f32; 3]], String> {
        let evaluate = || {
            let device = Device::open(wgpu::Backends::VULKAN).map_err(|error| error.to_string())?;
            let program = program(self.inputs.level).map_err(|error| error.to_string())?;
            device
                .evaluate(&program, &self.inputs.table, &self.inputs.batch)
                .map_err(|error| error.to_string())
        };
        self.reference.get_or_init(evaluate).as_deref().map_err(Clone::clone)
    }

    /// The file of that name in the level's folder, made at the first call.
    pub fn made(
        &self,
        name: &str,
        make: impl FnOnce(&Path) -> Result<(), String>,
    ) -> Result<PathBuf, String> {
        let mut made = self.made.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        let entry = made.entry(name.to_owned()).or_insert_with(|| {
            let path = self.folder.join(name);
            make(&path).map(|()| path)
        });
        entry.clone()
    }
}

/// Every array of the kernel as a file, and all of them as one.
///
/// `input.bin` holds the counts of surfaces, lights, vectors, pairs and the table's size as uint32, those arrays, and the
/// texels of the table's layers as floats; `table.bin` holds the texels in half precision.
fn write(folder: &Path, inputs: &Inputs) {
    let batch = &inputs.batch;
    let counts = [
        batch.surfaces.len(),
        batch.lights.len(),
        batch.vertices.len(),
        batch.pairs.len(),
        inputs.table.size(),
    ];
    let mut all: Vec<u8> = cast_slice(&counts.map(|count| count as u32)).to_vec();
    let mut array = |name: &str, bytes: &[u8]| {
        tools::write(folder, name, bytes);
        all.extend(bytes);
    };
    array("surfaces.bin", cast_slice(&batch.surfaces));
    array("lights.bin", cast_slice(&batch.lights));
    array("vertices.bin", cast_slice(&batch.vertices));
    array("pairs.bin", cast_slice(&batch.pairs));
    let table = inputs.table.bytes();
    tools::write(folder, "table.bin", &table);
    for half in table.chunks_exact(2) {
        all.extend(half::f16::from_le_bytes([half[0], half[1]]).to_f32().to_le_bytes());
    }
    tools::write(folder, "input.bin", all);
}

/// An array of the kernel as [`write`] left it.
pub fn read<T: Pod>(path: &Path) -> Result<Vec<T>, String> {
    let bytes = std::fs::read(path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    Ok(bytemuck::pod_collect_to_vec(&bytes))
}

/// The values in a file of four floats for each pair.
pub fn values(path: &Path) -> Result<Vec<[f32; 3]>, String> {
    Ok(read::<[f32; 4]>(path)?
        .into_iter()
        .map(|[diffuse, specular, fresnel, _]| [diffuse, specular, fresnel])
        .collect())
}
