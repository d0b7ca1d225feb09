//! Textures that a kernel reads.

use half::f16;

/// A texture array of half-precision texels, filtered linearly and clamped to its edge.
#[derive(Clone, Debug)]
pub struct Texels {
    size: usize,
    texels: Vec<[f32; 4]>,
}

impl Texels {
    /// Layers of `size` by `size` texels as a table's file holds them.
    pub fn new(size: usize, bytes: &[u8]) -> Self {
        let half = |bytes: &[u8]| f16::from_le_bytes([bytes[0], bytes[1]]).to_f32();
        let texel = |bytes: &[u8]| [0, 2, 4, 6].map(|at| half(&bytes[at..]));
        Self { size, texels: bytes.chunks_exact(8).map(texel).collect() }
    }

    /// Texels along each side.
    pub fn size(&self) -> usize {
        self.size
    }

    /// A texel of a layer; layers and places outside are those at the edge.
    pub(super) fn at(&self, layer: usize, x: usize, y: usize) -> [f32; 4] {
        let last = self.size - 1;
        let layer = layer.min(self.texels.len() / (self.size * self.size) - 1);
        self.texels[(layer * self.size + y.min(last)) * self.size + x.min(last)]
    }

    pub(super) fn sample(&self, x: f32, y: f32, layer: usize) -> [f32; 4] {
        let place = |at: f32| {
            let scaled = at * self.size as f32 - 0.5;
            let low = scaled.floor();
            let edge = |index: f32| index.clamp(0.0, self.size as f32 - 1.0) as usize;
            (edge(low), edge(low + 1.0), scaled - low)
        };
        let ((left, right, u), (top, bottom, v)) = (place(x), place(y));
        let at = |x: usize, y: usize| self.at(layer, x, y);
        let blend = |a: [f32; 4], b: [f32; 4], t: f32| [0, 1, 2, 3].map(|i| a[i] + (b[i] - a[i]) * t);
        blend(blend(at(left, top), at(right, top), u), blend(at(left, bottom), at(right, bottom), u), v)
    }

    /// The value at a place in texels from the first one's centre, and how it grows along both axes; each weight with all
    /// its digits.
    pub(super) fn blend(&self, x: f64, y: f64, layer: usize) -> ([f64; 4], [[f64; 4]; 2]) {
        let last = self.size as f64 - 1.0;
        let cell = |at: f64| {
            let low = at.clamp(0.0, last).floor().min(last - 1.0).max(0.0);
            (low as usize, at.clamp(0.0, last) - low, f64::from(u8::from((0.0..=last).contains(&at))))
        };
        let ((column, u, moves_x), (row, v, moves_y)) = (cell(x), cell(y));
        let corner = |right: usize, down: usize| self.at(layer, column + right, row + down).map(f64::from);
        let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)];
        let each = |of: &dyn Fn(usize) -> f64| [0, 1, 2, 3].map(of);
        let value = each(&|k| (1.0 - v) * ((1.0 - u) * a[k] + u * b[k]) + v * ((1.0 - u) * c[k] + u * d[k]));
        let along = each(&|k| moves_x * ((1.0 - v) * (b[k] - a[k]) + v * (d[k] - c[k])));
        let across = each(&|k| moves_y * ((1.0 - u) * (c[k] - a[k]) + u * (d[k] - b[k])));
        (value, [along, across])
    }
}
