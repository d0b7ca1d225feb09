//! The lookup table: packing, reading and file formats.

mod anisotropic;
#[cfg(feature = "package")]
mod container;
#[cfg(feature = "bake")]
mod pack;
mod several;
#[cfg(feature = "bake")]
mod several_pack;

pub use anisotropic::{AnisotropicTable, stretched_lobe};
#[cfg(feature = "package")]
pub use container::{Container, ContainerError};
#[cfg(feature = "bake")]
pub use pack::clipped_sphere;

use crate::effects::Effects;
pub use crate::effects::Layer;

use half::f16;

use crate::shade::{
    LobeSum, LtcLobe, LtcSurface, Real, ltc_diffuse_lobe, ltc_lobe, ltc_sheen_lobe, ltc_surface,
    ltc_table_coordinates,
};

/// A table of half-precision texels: layers of `size` × `size` texels of four numbers, at first
/// [`Layer::BASE`] and then whatever else a renderer's surfaces need:
///
/// ```
/// use softbox::table::{Layer, Table};
///
/// let table = Table::default().with(&Table::sheen());
/// assert_eq!(table.layers(), [Layer::Shape, Layer::Amplitude, Layer::Sheen]);
/// // What to give to the shader's ltc_sheen_lobe_from_table.
/// assert_eq!(table.index(Layer::Sheen), Some(2));
/// assert_eq!(table.index(Layer::Diffuse), None);
/// ```
///
/// Its bytes are those of an RGBA16F texture array without mipmaps: little-endian, layer after
/// layer, row after row, roughness fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    size: usize,
    layers: Vec<Layer>,
    texels: Vec<[f16; 4]>,
}

/// Why bytes are no table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableError {
    length: usize,
    size: usize,
    layers: usize,
}

impl core::fmt::Display for TableError {
    fn fmt(&self, formatter: &mut core::fmt::Formatter) -> core::fmt::Result {
        let Self { length, size, layers } = self;
        write!(
            formatter,
            "a table of {layers} × {size} × {size} texels has {} bytes and finite numbers only; these {length} bytes are not one",
            8 * layers * size * size
        )
    }
}

impl core::error::Error for TableError {}

/// The default table, of 64 × 64 texels for GGX with height-correlated Smith masking.
impl Default for Table {
    fn default() -> Self {
        Self::from_bytes(crate::TABLE_SIZE, crate::TABLE_NATIVE).expect("the embedded table is whole")
    }
}

impl Table {
    #[cfg(feature = "bake")]
    pub(crate) fn new(size: usize, layers: Vec<Layer>, texels: Vec<[f16; 4]>) -> Self {
        Self { size, layers, texels }
    }

    /// The embedded layer for [`Charlie`](crate::brdf::Charlie)'s sheen.
    pub fn sheen() -> Self {
        Self::from_layers(crate::TABLE_SIZE, &[Layer::Sheen], crate::TABLE_SHEEN)
            .expect("the embedded layer is whole")
    }

    /// The embedded layer for the single scattering of [`Eon`](crate::brdf::Eon)'s rough diffuse
    /// surface.
    pub fn diffuse() -> Self {
        Self::from_layers(crate::TABLE_SIZE, &[Layer::Diffuse], crate::TABLE_DIFFUSE)
            .expect("the embedded layer is whole")
    }

    /// This table with the layers of another one behind its own.
    ///
    /// # Panics
    ///
    /// If the two differ in size, or have a layer in common.
    pub fn with(mut self, other: &Self) -> Self {
        assert_eq!(self.size, other.size, "layers of one table are of one size");
        for layer in &other.layers {
            assert!(!self.layers.contains(layer), "the table has its {layer:?} already");
        }
        self.layers.extend(&other.layers);
        self.texels.extend(&other.texels);
        self
    }

    /// This table with those of the given layers that it lacks, from the embedded tables.
    ///
    /// ```
    /// use softbox::effects::Effects;
    /// use softbox::table::{Layer, Table};
    ///
    /// let layers = "disk+ggx,sheen".parse::<Effects>()?.layers();
    /// let table = Table::default().completed(&layers);
    /// assert_eq!(table.layers(), [Layer::Shape, Layer::Amplitude, Layer::Sheen]);
    /// assert_eq!(table.only(&[Layer::Sheen]), Table::sheen());
    /// # Ok::<(), softbox::effects::EffectsError>(())
    /// ```
    ///
    /// # Panics
    ///
    /// If it lacks one and is not of [`TABLE_SIZE`](crate::TABLE_SIZE).
    pub fn completed(self, layers: &[Layer]) -> Self {
        let embedded = |layer: Layer| match layer {
            Layer::Shape | Layer::Amplitude => Self::default(),
            Layer::FirstOfTwo | Layer::SecondOfTwo | Layer::WeightsOfTwo => Self::two_lobes(),
            Layer::FirstOfThree
            | Layer::SecondOfThree
            | Layer::ThirdOfThree
            | Layer::WeightsOfThree
            | Layer::ExcessesOfThree => Self::three_lobes(),
            Layer::Sheen => Self::sheen(),
            Layer::Diffuse => Self::diffuse(),
            Layer::AnisotropicFirst | Layer::AnisotropicSecond => {
                AnisotropicTable::default().layers().clone()
            }
        };
        layers.iter().fold(self, |table, layer| match table.index(*layer) {
            Some(_) => table,
            None => table.with(&embedded(*layer).only(&[*layer])),
        })
    }

    /// The given layers of this table, in the given order.
    ///
    /// # Panics
    ///
    /// If it lacks one of them.
    pub fn only(&self, layers: &[Layer]) -> Self {
        let texels = layers.iter().flat_map(|layer| {
            let index = self.index(*layer).unwrap_or_else(|| panic!("the table has no layer {layer:?}"));
            let size = self.size * self.size;
            &self.texels[index * size..(index + 1) * size]
        });
        Self { size: self.size, layers: layers.to_vec(), texels: texels.copied().collect() }
    }

    /// Reads the bytes that [`Table::bytes`] writes for a table of [`Layer::BASE`].
    ///
    /// # Errors
    ///
    /// If there are not 16·`size`² bytes, or a number among them is not finite.
    pub fn from_bytes(size: usize, bytes: &[u8]) -> Result<Self, TableError> {
        Self::from_layers(size, &Layer::BASE, bytes)
    }

    /// Reads the bytes that [`Table::bytes`] writes for a table of the given layers.
    ///
    /// # Errors
    ///
    /// If there are not 8·`size`² bytes a layer, or a number among them is not finite.
    pub fn from_layers(size: usize, layers: &[Layer], bytes: &[u8]) -> Result<Self, TableError> {
        let error = TableError { length: bytes.len(), size, layers: layers.len() };
        let expected = size.checked_mul(size).and_then(|texels| texels.checked_mul(8 * layers.len()));
        if size < 2 || layers.is_empty() || expected != Some(bytes.len()) {
            return Err(error);
        }
        let number = |i: usize| f16::from_le_bytes([bytes[2 * i], bytes[2 * i + 1]]);
        let texels: Vec<[f16; 4]> =
            (0..bytes.len() / 8).map(|texel| core::array::from_fn(|k| number(4 * texel + k))).collect();
        if texels.iter().flatten().all(|number| number.is_finite()) {
            Ok(Self { size, layers: layers.to_vec(), texels })
        } else {
            Err(error)
        }
    }

    /// Texels along each axis.
    pub fn size(&self) -> usize {
        self.size
    }

    /// What the layers hold, in their order.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// The place of a layer in the texture array.
    pub fn index(&self, layer: Layer) -> Option<usize> {
        self.layers.iter().position(|held| *held == layer)
    }

    /// The four numbers of a texel.
    ///
    /// # Panics
    ///
    /// If there is no such texel.
    pub fn texel(&self, layer: usize, column: usize, row: usize) -> [f16; 4] {
        assert!(
            layer < self.layers.len() && column < self.size && row < self.size,
            "no texel ({column}, {row}) in layer {layer}"
        );
        self.texels[(layer * self.size + row) * self.size + column]
    }

    /// The texels as bytes, ready for a texture upload.
    pub fn bytes(&self) -> Vec<u8> {
        self.texels.iter().flatten().flat_map(|number| number.to_le_bytes()).collect()
    }

    /// A layer at texture coordinates (0…1 from edge to edge), filtered linearly and clamped to the
    /// edge, as a sampler would return it.
    pub fn sample<R: Real>(&self, layer: usize, coordinates: R::Vec2) -> R::Vec4 {
        let last = self.size - 1;
        let place = |coordinate: R| {
            let position = coordinate.to_f64() * self.size as f64 - 0.5;
            let position = position.clamp(0.0, last as f64);
            let cell = (position as usize).min(last - 1);
            (cell, position - cell as f64)
        };
        let [u, v] = coordinates.into();
        let ((column, right), (row, down)) = (place(u), place(v));
        let corners = [
            (self.texel(layer, column, row), (1.0 - right) * (1.0 - down)),
            (self.texel(layer, column + 1, row), right * (1.0 - down)),
            (self.texel(layer, column, row + 1), (1.0 - right) * down),
            (self.texel(layer, column + 1, row + 1), right * down),
        ];
        let sum: [R; 4] = core::array::from_fn(|k| {
            R::new(corners.iter().map(|(texel, weight)| weight * texel[k].to_f64()).sum())
        });
        sum.into()
    }

    /// The lobe of a surface, for a table in the native layout.
    pub fn lobe<R: Real>(&self, surface: &LtcSurface<R>) -> LtcLobe<R> {
        let [u, v] = ltc_table_coordinates(surface, R::new(self.size as f64)).into();
        let shape = self.sample::<R>(0, [u, v].into());
        let amplitude = self.sample::<R>(1, [u, v].into());
        ltc_lobe(surface, shape, amplitude)
    }

    /// The lobe of a sheen; the surface's roughness is the sheen's.
    ///
    /// # Panics
    ///
    /// If the table has no such layer.
    pub fn sheen_lobe<R: Real>(&self, surface: &LtcSurface<R>) -> LtcLobe<R> {
        ltc_sheen_lobe(surface, self.sample_layer(surface, Layer::Sheen))
    }

    /// The lobe of a rough diffuse surface's single scattering; the surface's roughness is the diffuse
    /// one.
    ///
    /// # Panics
    ///
    /// If the table has no such layer.
    pub fn diffuse_lobe<R: Real>(&self, surface: &LtcSurface<R>) -> LtcLobe<R> {
        ltc_diffuse_lobe(surface, self.sample_layer(surface, Layer::Diffuse))
    }

    fn sample_layer<R: Real>(&self, surface: &LtcSurface<R>, layer: Layer) -> R::Vec4 {
        let index = self.index(layer).unwrap_or_else(|| panic!("the table has no layer {layer:?}"));
        self.sample::<R>(index, ltc_table_coordinates(surface, R::new(self.size as f64)))
    }

    /// The largest value per steradian that any small light can have on a surface at least as rough as `roughness`,
    /// whatever the view: a bound on the lobe's density times its albedo, for [`Light::range`](crate::light::Light::range).
    ///
    /// Found on a grid four times as fine as the table in both directions, and raised by a tenth for what lies
    /// between its points.
    pub fn peak(&self, roughness: f64) -> f64 {
        self.peak_with(roughness, Effects::NONE)
    }

    /// The same with the lobes that some effects bring: of a sum the peaks of all of its lobes together.
    ///
    /// # Panics
    ///
    /// If the table lacks their layers.
    pub fn peak_with(&self, roughness: f64, effects: Effects) -> f64 {
        let last = 4 * (self.size - 1);
        let first = roughness.clamp(0.0, 1.0);
        let mut peak = 0.0_f64;
        for column in 0..=last {
            let roughness = first + (1.0 - first) * column as f64 / last as f64;
            for row in 0..=last {
                let cosine = (row as f64 / last as f64).powi(2);
                let view = glam::DVec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
                let surface = ltc_surface::<f64>(glam::DVec3::ZERO, glam::DVec3::Z, view, roughness);
                let lobes = self.specular(&surface, effects);
                let each = lobes.lobes().iter();
                peak = peak.max(each.map(|lobe| lobe.albedo * largest_density(lobe) / lobe.share).sum());
            }
        }
        1.1 * peak
    }
}

/// The largest density of a lobe: |M⁻¹| / (π σ³) with σ the smallest singular value of M⁻¹, since the density in a
/// direction ω is |M⁻¹| (M⁻¹ω).z / (π |M⁻¹ω|⁴) (Heitz et al. 2016, equation 7).
fn largest_density(lobe: &LtcLobe<f64>) -> f64 {
    let determinant = lobe.axis_x.dot(lobe.normal_x);
    // The inverse's largest singular value is one over σ; its columns are the cofactors over the determinant. Power
    // iteration on the symmetric product runs from each of three axes, so that one of them has a part in the answer.
    let cofactors = [lobe.normal_x, lobe.normal_y, lobe.normal_z];
    let largest = glam::DVec3::AXES.map(|axis| {
        let mut v = axis;
        let mut growth = 0.0;
        for _ in 0..64 {
            let through = cofactors[0] * v.x + cofactors[1] * v.y + cofactors[2] * v.z;
            let next = glam::DVec3::new(
                cofactors[0].dot(through),
                cofactors[1].dot(through),
                cofactors[2].dot(through),
            );
            growth = next.length();
            v = next / growth.max(f64::MIN_POSITIVE);
        }
        growth
    });
    let inverse = largest.into_iter().fold(0.0, f64::max).sqrt() / determinant;
    determinant * inverse.powi(3) / core::f64::consts::PI
}
