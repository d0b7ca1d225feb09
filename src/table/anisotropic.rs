//! The table of anisotropic lobes.

use half::f16;

use super::{Layer, Table, TableError};
use crate::shade::{
    LTC_ANISOTROPIC_SIZE, LtcAnisotropy, LtcLobe, LtcSurface, Real, ltc_anisotropic_coordinates,
    ltc_anisotropic_lobe, ltc_anisotropic_round, ltc_anisotropic_texels, ltc_table_coordinates,
};

/// Two layers of half-precision texels that correct stretched isotropic lobes, see `ltc_anisotropic_lobe`.
///
/// Its bytes are two further layers of the texture array of a [`Table`] of 64 × 64 texels: tiles of 8 × 8 texels, α
/// along x and view along y within a tile, azimuth along x and ratio along y from tile to tile.
#[derive(Clone, Debug, PartialEq)]
pub struct AnisotropicTable(Table);

/// The default table, for GGX with height-correlated Smith masking.
impl Default for AnisotropicTable {
    fn default() -> Self {
        Self::from_bytes(crate::TABLE_ANISOTROPIC).expect("the embedded table is whole")
    }
}

impl AnisotropicTable {
    /// Texels of a layer along each axis.
    pub const SIZE: usize = LTC_ANISOTROPIC_SIZE * LTC_ANISOTROPIC_SIZE;

    /// Rounds a fitted table to half precision. No texel is subnormal.
    #[cfg(feature = "bake")]
    pub fn pack(fitted: &crate::fit::FittedAnisotropic) -> Self {
        let size = LTC_ANISOTROPIC_SIZE;
        let texel = |layer: usize, column: usize, row: usize| {
            let index = column % size + size * (row % size + size * (column / size + size * (row / size)));
            let numbers = fitted.texels[index];
            core::array::from_fn(|k| super::pack::normal_half(numbers[4 * layer + k]))
        };
        let places = |layer| {
            (0..Self::SIZE).flat_map(move |row| (0..Self::SIZE).map(move |column| (layer, column, row)))
        };
        let texels = places(0).chain(places(1)).map(|(layer, column, row)| texel(layer, column, row));
        Self(Table::new(Self::SIZE, Layer::ANISOTROPIC.to_vec(), texels.collect()))
    }

    /// Reads the bytes that [`AnisotropicTable::bytes`] writes.
    ///
    /// # Errors
    ///
    /// If there are not 64 KiB, or a number among them is not finite.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, TableError> {
        Table::from_layers(Self::SIZE, &Layer::ANISOTROPIC, bytes).map(Self)
    }

    /// The texels as bytes, ready for a texture upload: little-endian, layer after layer, row after row.
    pub fn bytes(&self) -> Vec<u8> {
        self.0.bytes()
    }

    /// The four numbers of a texel.
    ///
    /// # Panics
    ///
    /// If there is no such texel.
    pub fn texel(&self, layer: usize, column: usize, row: usize) -> [f16; 4] {
        self.0.texel(layer, column, row)
    }

    /// A layer at the four coordinates of `ltc_anisotropic_coordinates`.
    pub fn sample<R: Real>(&self, layer: usize, coordinates: R::Vec4) -> R::Vec4 {
        sample::<R>(&self.0, layer, coordinates)
    }

    /// The two layers, to put behind others with [`Table::with`].
    pub fn layers(&self) -> &Table {
        &self.0
    }

    /// The lobe of an anisotropic surface; `table` is the isotropic one in the native layout.
    pub fn lobe<R: Real>(
        &self,
        table: &Table,
        surface: &LtcSurface<R>,
        anisotropy: &LtcAnisotropy<R>,
    ) -> LtcLobe<R> {
        let coordinates = ltc_anisotropic_coordinates(surface, anisotropy);
        let first = self.sample::<R>(0, coordinates);
        let second = self.sample::<R>(1, coordinates);
        lobe(table, surface, anisotropy, first, second)
    }
}

/// A layer at the four coordinates of `ltc_anisotropic_coordinates`, as four linearly filtered samples and their weights
/// by hand.
fn sample<R: Real>(table: &Table, layer: usize, coordinates: R::Vec4) -> R::Vec4 {
    let size = R::new(AnisotropicTable::SIZE as f64);
    let (places, weights) = ltc_anisotropic_texels::<R>(coordinates, size);
    let samples = places.map(|place| -> [R; 4] { table.sample::<R>(layer, place).into() });
    let sum: [R; 4] = core::array::from_fn(|k| {
        (1..4).fold(samples[0][k] * weights[0], |sum, i| sum + samples[i][k] * weights[i])
    });
    sum.into()
}

impl Table {
    /// The lobe of an anisotropic surface, for a table with the layers [`Layer::BASE`] and [`Layer::ANISOTROPIC`].
    ///
    /// # Panics
    ///
    /// If the table lacks one of them, or is not of 64 × 64 texels.
    pub fn anisotropic_lobe<R: Real>(
        &self,
        surface: &LtcSurface<R>,
        anisotropy: &LtcAnisotropy<R>,
    ) -> LtcLobe<R> {
        assert_eq!(self.size(), AnisotropicTable::SIZE, "anisotropic layers have 64 × 64 texels");
        let [first, second] = Layer::ANISOTROPIC.map(|layer| {
            self.index(layer)
                .unwrap_or_else(|| panic!("the table has no layer {layer:?}, but {:?}", self.layers()))
        });
        let coordinates = ltc_anisotropic_coordinates(surface, anisotropy);
        let first = sample::<R>(self, first, coordinates);
        let second = sample::<R>(self, second, coordinates);
        lobe(self, surface, anisotropy, first, second)
    }
}

/// The lobe of an anisotropic surface from the isotropic table alone.
pub fn stretched_lobe<R: Real>(
    table: &Table,
    surface: &LtcSurface<R>,
    anisotropy: &LtcAnisotropy<R>,
) -> LtcLobe<R> {
    let nothing = [R::new(0.0); 4];
    lobe(table, surface, anisotropy, nothing.into(), nothing.into())
}

fn lobe<R: Real>(
    table: &Table,
    surface: &LtcSurface<R>,
    anisotropy: &LtcAnisotropy<R>,
    first: R::Vec4,
    second: R::Vec4,
) -> LtcLobe<R> {
    let round = ltc_anisotropic_round(surface, anisotropy);
    let at = ltc_table_coordinates(&round, R::new(table.size() as f64));
    let shape = table.sample::<R>(0, at);
    let amplitude = table.sample::<R>(1, at);
    ltc_anisotropic_lobe(surface, anisotropy, shape, amplitude, first, second)
}
