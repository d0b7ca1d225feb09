//! The pyramid.

/// Texels of a level along each axis that a texel of the next one is made from.
pub const TAPS: usize = 8;

/// Variance of the blur, in squared texels of the image, of what level L has over the image: this times 4ᴸ − 1.
///
/// The steps add 4/3, 4·4/3, 16·4/3, … squared texels.
pub const VARIANCE: f64 = 4.0 / 9.0;

/// Variance, in squared texels of a level, that a sampler's linear filter adds, over all places between texels.
pub const LINEAR_VARIANCE: f64 = 1.0 / 6.0;

/// One level of a pyramid.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Texels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The texels, linear and premultiplied by alpha, row after row from the top.
    pub texels: Vec<[f32; 4]>,
}

/// An image at every level of blur, as a texture with mipmaps.
#[derive(Clone, Debug, PartialEq)]
pub struct Prefiltered {
    levels: Vec<Level>,
}

/// The pyramid of an image of `width` × `height` texels, linear and premultiplied by alpha, row after row from the
/// top. Sides halve, rounded down, until both are one. No texel of any level is brighter than the brightest of the
/// image, or darker than the darkest, but for rounding.
///
/// # Panics
///
/// If a side is zero, or there are not `width` · `height` texels.
pub fn prefilter(width: usize, height: usize, image: &[[f32; 4]]) -> Prefiltered {
    assert!(
        width > 0 && height > 0 && image.len() == width * height,
        "an image of {width} x {height} texels does not have {}",
        image.len()
    );
    let mut levels = vec![Level { width, height, texels: image.to_vec() }];
    while let Some(last) = levels.last().filter(|level| level.width.max(level.height) > 1) {
        let next = last.next();
        levels.push(next);
    }
    // Sides that cannot be halved give some texels more weight than others.
    if let Some(top) = levels.last_mut() {
        top.texels[0] = mean(image);
    }
    Prefiltered { levels }
}

/// Index of the first of [`TAPS`] texels, of a row of `from` texels, that the texel `index` of a row of `to` texels is
/// made from, and their weights. The row continues mirrored at both ends.
pub fn weights(index: usize, from: usize, to: usize) -> (isize, [f32; TAPS]) {
    let centre = (index as f32 + 0.5) * (from as f32 / to as f32);
    let first = (centre + 0.5).floor() - 0.5 * TAPS as f32;
    let weights = core::array::from_fn(|tap| 0.5 * spline(0.5 * (first + tap as f32 + 0.5 - centre)));
    (first as isize, weights)
}

/// The cubic B-spline of unit knots, centred.
fn spline(x: f32) -> f32 {
    let x = x.abs();
    let (near, far) = ((1.0 - x).max(0.0), (2.0 - x).max(0.0));
    (far * far * far - 4.0 * near * near * near) / 6.0
}

/// The index 0…`count` − 1 of the texel that lies at `index` of a row that is mirrored at both ends, over and over.
fn mirrored(index: isize, count: usize) -> usize {
    let folded = index.rem_euclid(2 * count as isize) as usize;
    if folded < count { folded } else { 2 * count - 1 - folded }
}

fn mean(image: &[[f32; 4]]) -> [f32; 4] {
    core::array::from_fn(|k| {
        let sum: f64 = image.iter().map(|texel| f64::from(texel[k])).sum();
        (sum / image.len() as f64) as f32
    })
}

impl Level {
    /// The next level, of half the size.
    fn next(&self) -> Self {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let sum = |weights: &[f32; TAPS], texel: &dyn Fn(usize) -> [f32; 4]| {
            let mut sum = [0.0; 4];
            for (tap, weight) in weights.iter().enumerate() {
                for (total, value) in sum.iter_mut().zip(texel(tap)) {
                    *total += weight * value;
                }
            }
            sum
        };
        let mut rows = Vec::with_capacity(width * self.height);
        for row in self.texels.chunks_exact(self.width) {
            rows.extend((0..width).map(|column| {
                let (first, weights) = weights(column, self.width, width);
                sum(&weights, &|tap| row[mirrored(first + tap as isize, self.width)])
            }));
        }
        let mut texels = Vec::with_capacity(width * height);
        for row in 0..height {
            let (first, weights) = weights(row, self.height, height);
            texels.extend((0..width).map(|column| {
                sum(&weights, &|tap| rows[mirrored(first + tap as isize, self.height) * width + column])
            }));
        }
        Self { width, height, texels }
    }

    /// The level at texture coordinates, filtered linearly and clamped to the edge.
    fn sample(&self, [u, v]: [f64; 2]) -> [f64; 4] {
        let place = |coordinate: f64, count: usize| {
            let position = (coordinate * count as f64 - 0.5).clamp(0.0, (count - 1) as f64);
            let cell = (position as usize).min(count.max(2) - 2);
            (cell, (cell + 1).min(count - 1), position - cell as f64)
        };
        let (left, right, along) = place(u, self.width);
        let (upper, lower, down) = place(v, self.height);
        let texel = |column: usize, row: usize| self.texels[row * self.width + column].map(f64::from);
        let corners = [
            (texel(left, upper), (1.0 - along) * (1.0 - down)),
            (texel(right, upper), along * (1.0 - down)),
            (texel(left, lower), (1.0 - along) * down),
            (texel(right, lower), along * down),
        ];
        core::array::from_fn(|k| corners.iter().map(|(texel, weight)| weight * texel[k]).sum())
    }
}

impl Prefiltered {
    /// The levels, the image first and its mean last.
    pub fn levels(&self) -> &[Level] {
        &self.levels
    }

    /// A pyramid that was made elsewhere, on a device for example.
    ///
    /// # Panics
    ///
    /// If there is no level, a level does not have the texels that its size says, or its size is not half that of
    /// the one before, rounded down.
    pub fn from_levels(levels: Vec<Level>) -> Self {
        assert!(!levels.is_empty(), "a pyramid has at least one level");
        for (index, level) in levels.iter().enumerate() {
            let half = |side: usize| (side >> index).max(1);
            let size = (half(levels[0].width), half(levels[0].height));
            assert_eq!((level.width, level.height), size, "level {index} has another size");
            assert_eq!(level.texels.len(), size.0 * size.1, "level {index} has another number of texels");
        }
        Self { levels }
    }

    /// Size of the image, as the include's look-ups take it.
    pub fn texels(&self) -> [f64; 2] {
        [self.levels[0].width as f64, self.levels[0].height as f64]
    }

    /// The image at texture coordinates and a level of any fraction, filtered linearly within levels and between
    /// them and clamped at every end, as a sampler returns it.
    pub fn sample(&self, at: [f64; 2], level: f64) -> [f64; 4] {
        let last = self.levels.len() - 1;
        let level = level.clamp(0.0, last as f64);
        let lower = (level as usize).min(last);
        let share = level - lower as f64;
        let (fine, coarse) = (self.levels[lower].sample(at), self.levels[(lower + 1).min(last)].sample(at));
        core::array::from_fn(|k| fine[k] + (coarse[k] - fine[k]) * share)
    }
}
