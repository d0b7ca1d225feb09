//! Tables as methods, the library's own and others'.

use std::path::{Path, PathBuf};

use glam::DVec3;
use half::f16;

use crate::input;
use crate::report::data::{Kind, MethodInfo};
use crate::report::{Method, Quad, Technique, shade};
use crate::shade::{ltc_quad, ltc_surface};
use crate::table::{Table, TableError};

/// Bytes of the largest file: text of the largest table that is baked, 1024 × 1024 texels.
const LARGEST_FILE: usize = 256 << 20;

/// A table with what makes light of it.
#[derive(Clone, Debug, PartialEq)]
pub struct TableMethod {
    /// What it is.
    pub info: MethodInfo,
    /// The table.
    pub table: Table,
    /// How it is used. The include's way is computed in f32 as the shader does, the published one in f64.
    pub technique: Technique,
}

impl TableMethod {
    /// The level `standard`: the include with the shipped table.
    pub fn standard() -> Self {
        Self {
            info: MethodInfo {
                name: "standard".to_owned(),
                label: "Standard".to_owned(),
                kind: Kind::Level,
                description: "One lobe from a table of 64 × 64 texels, cut at both horizons.".to_owned(),
            },
            table: Table::default(),
            technique: Technique::Include,
        }
    }

    /// A table from a file, named like the file; see [`read_table`].
    ///
    /// # Errors
    ///
    /// If the file cannot be read or holds no table.
    pub fn from_file(path: &Path) -> Result<Self, TableFileError> {
        let (table, technique) = read_table(path)?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let used = match technique {
            Technique::Include | Technique::With(_) => "the include",
            Technique::Published => "the published technique with an exact cut at the lobe's horizon",
        };
        let info = MethodInfo {
            label: name.clone(),
            name,
            kind: Kind::Comparator,
            description: format!("A table of {0} × {0} texels with {used}.", table.size()),
        };
        Ok(Self { info, table, technique })
    }
}

impl Method for TableMethod {
    fn info(&self) -> MethodInfo {
        self.info.clone()
    }

    fn value(&self, quad: &Quad) -> [f64; 3] {
        match self.technique {
            Technique::Include | Technique::With(_) => {
                let (up, view) = (DVec3::Z.as_vec3(), quad.view.as_vec3());
                let surface = ltc_surface::<f32>(glam::Vec3::ZERO, up, view, quad.roughness as f32);
                let corners = quad.corners.map(|corner| corner.as_vec3());
                ltc_quad(&surface, &self.table.lobe(&surface), corners, false).to_array().map(f64::from)
            }
            Technique::Published => {
                let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, quad.view, quad.roughness);
                // The form factor needs no table.
                let diffuse = ltc_quad(&surface, &Table::default().lobe(&surface), quad.corners, false).x;
                let [specular, fresnel] = shade(&self.table, self.technique, quad);
                [diffuse, specular, fresnel]
            }
        }
    }
}

/// Why a file is no table.
#[derive(Debug, thiserror::Error)]
pub enum TableFileError {
    /// It cannot be read.
    #[error("cannot read {path}; name a file that exists and can be read")]
    File {
        /// The file.
        path: PathBuf,
        /// What was said.
        source: std::io::Error,
    },
    /// It is of another kind.
    #[error(
        "{path} holds no table ({reason}); give a .bin or .dds as `softbox bake` writes it, raw f32 numbers of the same order, or text with two lists in brackets"
    )]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
}

/// Reads a table of two layers of n × n texels of four numbers, roughness fastest, and tells how it is meant to be used.
///
/// * `.dds`: an array of two layers of R16G16B16A16_FLOAT;
/// * text, such as the JavaScript file of the published tables (Heitz et al. 2016): the first two lists in brackets hold
///   a layer each;
/// * any other file: 16·n² bytes are half-precision numbers, 32·n² bytes f32 ones, both little-endian.
///
/// Numbers are rounded to half precision, as textures of such tables hold them. The layout is told by its first row:
/// in the published one that is the view along the normal, where every lobe is round and upright, (1, 0, 0, w); in the
/// include's the most grazing one.
///
/// # Errors
///
/// If the file cannot be read or holds no such table.
pub fn read_table(path: &Path) -> Result<(Table, Technique), TableFileError> {
    let bytes = input::read(path, LARGEST_FILE)
        .map_err(|source| TableFileError::File { path: path.into(), source })?;
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    decode_table(&bytes, &extension).map_err(|reason| TableFileError::Content { path: path.into(), reason })
}

/// The same from the bytes of a file with that extension, in lower case.
///
/// # Errors
///
/// The reason, if they hold no such table.
pub fn decode_table(bytes: &[u8], extension: &str) -> Result<(Table, Technique), String> {
    let halves = match extension {
        "dds" => dds(bytes),
        "js" | "json" | "txt" => numbers(bytes),
        _ => raw(bytes),
    }?;
    let size = (halves.len() / 16).isqrt();
    let table = Table::from_bytes(size, &halves).map_err(|error: TableError| error.to_string())?;
    let is_upright = |column: usize| {
        let [x, y, z, _] = table.texel(0, column, 0).map(f16::to_f64);
        (x - 1.0).abs().max(y.abs()).max(z.abs()) < 0.02
    };
    let published = (0..size).all(is_upright);
    Ok((table, if published { Technique::Published } else { Technique::Include }))
}

/// Little-endian half-precision bytes of a raw file.
fn raw(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let is_square = |number: usize| number > 0 && number.isqrt().pow(2) == number;
    // The root of two is not rational: no length is both.
    if bytes.len().is_multiple_of(16) && is_square(bytes.len() / 16) {
        Ok(bytes.to_vec())
    } else if bytes.len().is_multiple_of(32) && is_square(bytes.len() / 32) {
        let single = |four: &[u8]| f32::from_le_bytes([four[0], four[1], four[2], four[3]]);
        Ok(bytes.chunks_exact(4).flat_map(|four| f16::from_f32(single(four)).to_le_bytes()).collect())
    } else {
        Err(format!("{} bytes are neither 16 nor 32 times a square", bytes.len()))
    }
}

/// Half-precision bytes of the first two lists of numbers.
fn numbers(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let text = core::str::from_utf8(bytes).map_err(|error| error.to_string())?;
    let lists: Vec<&str> = text
        .split('[')
        .skip(1)
        .filter_map(|rest| rest.split_once(']'))
        .map(|(list, _)| list)
        .take(2)
        .collect();
    let &[first, second] = lists.as_slice() else { return Err("it lacks two lists in brackets".to_owned()) };
    let words = first.split(',').chain(second.split(',')).map(str::trim).filter(|word| !word.is_empty());
    let mut halves = Vec::new();
    for word in words {
        let number: f64 = word.parse().map_err(|_| format!("{word:?} is no number"))?;
        halves.extend(f16::from_f64(number).to_le_bytes());
    }
    raw(&halves)
}

/// Half-precision bytes of a DirectDraw surface.
fn dds(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let file = ddsfile::Dds::read(bytes).map_err(|error| error.to_string())?;
    if file.get_dxgi_format() != Some(ddsfile::DxgiFormat::R16G16B16A16_Float) {
        return Err("its texels are not R16G16B16A16_FLOAT".to_owned());
    }
    // The number as the file has it: `get_num_array_layers` multiplies it for cubes, and overflows.
    let header = file.header10.as_ref();
    if header.is_some_and(|header| header.misc_flag.contains(ddsfile::MiscFlag::TEXTURECUBE)) {
        return Err("it is a cube and not two layers".to_owned());
    }
    let layers = header.map_or(1, |header| header.array_size);
    if file.get_width() != file.get_height() || layers != 2 {
        return Err(format!(
            "it has {layers} layers of {} × {} texels and not two square ones",
            file.get_width(),
            file.get_height()
        ));
    }
    Ok(file.data)
}
