//! The error of textured lights, on random quads.

use glam::DVec3;
use rayon::prelude::*;

use super::{Quad, Region, random_quads};
use crate::fit::{Family, Sight};
use crate::shade::{
    LtcLobe, LtcLookup, ltc_edge_part, ltc_quad, ltc_rectangle_diffuse_lookup, ltc_rectangle_lookup,
    ltc_surface, ltc_transform,
};
use crate::table::Table;
use crate::texture::{Prefiltered, prefilter};
use crate::truth;

/// Texels along each side of the [`pictures`].
pub const PICTURE_SIZE: usize = 256;

/// Three pictures to measure with: a gradient, a board of 8 × 8 fields, and strokes like those of writing.
pub fn pictures() -> [(&'static str, Prefiltered); 3] {
    let paint = |colour: &dyn Fn(f64, f64) -> [f64; 3]| {
        let size = PICTURE_SIZE;
        let texels: Vec<[f32; 4]> = (0..size * size)
            .map(|i| {
                let at = |k: usize| (k as f64 + 0.5) / size as f64;
                let [r, g, b] = colour(at(i % size), at(i / size)).map(|value| value as f32);
                [r, g, b, 1.0]
            })
            .collect();
        prefilter(size, size, &texels)
    };
    [
        ("gradient", paint(&|u, v| [u, v, 1.0 - u])),
        (
            "board",
            paint(&|u, v| {
                if ((8.0 * u) as usize + (8.0 * v) as usize).is_multiple_of(2) {
                    [1.0; 3]
                } else {
                    [0.0, 0.0, 0.2]
                }
            }),
        ),
        ("writing", paint(&|u, v| if is_ink(u, v) { [1.0, 0.9, 0.2] } else { [0.02, 0.02, 0.1] })),
    ]
}

/// Four lines of seven signs, each of a few strokes out of eight.
fn is_ink(u: f64, v: f64) -> bool {
    const STROKES: [[f64; 4]; 8] = [
        [0.2, 0.1, 0.2, 0.9],
        [0.8, 0.1, 0.8, 0.9],
        [0.2, 0.1, 0.8, 0.1],
        [0.2, 0.5, 0.8, 0.5],
        [0.2, 0.9, 0.8, 0.9],
        [0.2, 0.9, 0.8, 0.1],
        [0.2, 0.1, 0.5, 0.5],
        [0.5, 0.5, 0.5, 0.9],
    ];
    let (column, row) = ((7.0 * u) as usize, (4.0 * v) as usize);
    let (x, y) = (7.0 * u - column as f64, 4.0 * v - row as f64);
    // Any set of strokes that differs between neighbours does.
    let chosen = [0b0001_1111, 0b0010_0011, 0b1110_0000, 0b0001_0111, 0b0110_0001, 0b1000_0100, 0b0001_1101]
        [(column + 3 * row) % 7];
    STROKES.iter().enumerate().any(|(index, [ax, ay, bx, by])| {
        let (dx, dy) = (bx - ax, by - ay);
        let t = (((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
        let distance = (x - ax - t * dx).hypot(1.5 * (y - ay - t * dy));
        chosen >> index & 1 == 1 && distance < 0.09
    })
}

/// Blur of [`Colouring::Nearest`] in units of the distance over the root of the area; half as much or twice as much is
/// worse on [`random_quads`](super::random_quads) and the [`pictures`].
const NEAREST_BLUR: f64 = 1.0;

/// Ways to find the colour of a textured light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colouring {
    /// The picture's mean.
    Mean,
    /// The point of the light's plane that is nearest to the surface point in the lobe's space, or the nearest one to
    /// that on the light, blurred in proportion to the distance of the plane over the root of the light's area: the
    /// scheme of Heitz et al. 2016, with the pyramid of this crate.
    Nearest,
    /// The include's look-up with one sample.
    Single,
    /// The include's look-up with two.
    Pair,
}

impl Colouring {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Mean, Self::Nearest, Self::Single, Self::Pair];
}

/// Vector form factors of a quad, cut at the horizons: in the surface's frame, and in the lobe's space.
pub fn form_factors(lobe: &LtcLobe<f64>, corners: [DVec3; 4]) -> [DVec3; 2] {
    let above = above(&corners);
    let lobe_space: Vec<DVec3> = above.iter().map(|v| ltc_transform(lobe, *v)).collect();
    [edges(&above), edges(&self::above(&lobe_space))]
}

/// The part of a convex polygon above the plane z = 0.
fn above(points: &[DVec3]) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(points.len() + 1);
    for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
        if a.z > 0.0 {
            kept.push(*a);
        }
        if (a.z > 0.0) != (b.z > 0.0) {
            kept.push(*a + (*b - *a) * (a.z / (a.z - b.z)));
        }
    }
    kept
}

/// Vector form factor of a polygon that is counter-clockwise seen from the origin.
fn edges(points: &[DVec3]) -> DVec3 {
    let pairs = points.iter().zip(points.iter().cycle().skip(1));
    let sum: DVec3 =
        pairs.map(|(a, b)| ltc_edge_part::<f64>(a.normalize(), b.normalize(), a.cross(*b))).sum();
    -sum / core::f64::consts::TAU
}

/// What to fit the look-up to: `count` random quads, less those that hardly appear, for lobes in each of four bands of
/// roughness, and for diffuse light.
pub fn lookup_sights(table: &Table, count: usize) -> Vec<Vec<Sight>> {
    let bands = [
        ((0.1, 0.2), false),
        ((0.2, 0.4), false),
        ((0.4, 0.7), false),
        ((0.7, 1.0), false),
        ((0.1, 1.0), true),
    ];
    let sight = |quad: &Quad, diffuse: bool| {
        let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, quad.view, quad.roughness);
        let lobe: LtcLobe<f64> = table.lobe(&surface);
        Sight::new(quad.corners, &|v| if diffuse { v } else { ltc_transform(&lobe, v) })
    };
    let set = |(roughness, diffuse)| {
        let quads = random_quads(Region { roughness, cosine: (0.05, 1.0) }, count);
        quads.par_iter().map(|quad| sight(quad, diffuse)).filter(|sight| sight.coverage() > 1e-4).collect()
    };
    bands.into_iter().map(set).collect()
}

/// Errors of one colouring in one picture: mean |error| over mean value, of diffuse and of specular light (F = 1).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TextureAccuracy {
    /// Of ∫cos/π times the radiance.
    pub diffuse: f64,
    /// Of ∫f·cos times the radiance.
    pub specular: f64,
    /// Of the Schlick part, coloured as specular light is.
    pub fresnel: f64,
}

/// The look-ups of diffuse light and of a lobe for a quad whose surface point is the origin; none for a `Mean`.
fn lookups(colouring: Colouring, table: &Table, quad: &Quad) -> Option<[LtcLookup<f64>; 2]> {
    let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, quad.view, quad.roughness);
    let lobe = table.lobe(&surface);
    let [a, b, _, d] = quad.corners;
    let texels = [PICTURE_SIZE as f64; 2].into();
    match colouring {
        Colouring::Mean => None,
        Colouring::Nearest => {
            let near = |corner: DVec3, u: DVec3, v: DVec3| {
                let normal = u.cross(v);
                let foot = normal * (corner.dot(normal) / normal.length_squared()) - corner;
                let place = [foot.cross(v).dot(normal), u.cross(foot).dot(normal)]
                    .map(|c| (c / normal.length_squared()).clamp(0.0, 1.0));
                let blur =
                    NEAREST_BLUR * corner.dot(normal).abs() / normal.length().powf(1.5) * PICTURE_SIZE as f64;
                let level = (1.5 * blur).max(1.0).log2();
                LtcLookup { place: place.into(), apart: [0.0; 2].into(), level }
            };
            let [corner, u, v] = [d, b - a, a - d];
            Some([
                near(corner, u, v),
                near(ltc_transform(&lobe, corner), ltc_transform(&lobe, u), ltc_transform(&lobe, v)),
            ])
        }
        Colouring::Single | Colouring::Pair => {
            let pair = colouring == Colouring::Pair;
            let [diffuse, specular] = form_factors(&lobe, quad.corners);
            Some([
                ltc_rectangle_diffuse_lookup::<f64>(&surface, [a, b, d], diffuse, texels, pair),
                ltc_rectangle_lookup::<f64>(&surface, &lobe, [a, b, d], specular, texels, pair),
            ])
        }
    }
}

/// The picture at a look-up: the mean of two samples.
pub fn fetch(picture: &Prefiltered, lookup: &LtcLookup<f64>) -> [f64; 4] {
    let (place, apart) = (lookup.place, lookup.apart);
    let [first, second] = [place + apart, place - apart].map(|at| picture.sample(at.into(), lookup.level));
    core::array::from_fn(|k| 0.5 * (first[k] + second[k]))
}

/// Errors of each of `colourings` (rows) in each of `pictures` (columns), and last those of a white light, against
/// numerical integration of the model over each texel.
pub fn texture_accuracy(
    table: &Table,
    family: &dyn Family,
    colourings: &[Colouring],
    pictures: &[(&'static str, Prefiltered)],
    quads: &[Quad],
) -> (Vec<Vec<TextureAccuracy>>, TextureAccuracy) {
    // Sums of |error| for each colouring, picture and value, then of values; the last picture is white.
    let columns = pictures.len() + 1;
    let zero = || vec![[0.0_f64; 6]; colourings.len() * columns];
    let add = |mut a: Vec<[f64; 6]>, b: Vec<[f64; 6]>| {
        for (a, b) in a.iter_mut().flatten().zip(b.iter().flatten()) {
            *a += b;
        }
        a
    };
    let measure = |quad: &Quad| {
        let mut sums = zero();
        let brdf = family.at(quad.roughness);
        let [a, b, _, d] = quad.corners;
        let shares = truth::texel_shares(brdf.as_ref(), quad.view, [a, b, d], [PICTURE_SIZE; 2]);
        let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, quad.view, quad.roughness);
        let value = ltc_quad(&surface, &table.lobe(&surface), quad.corners, false).to_array();
        for (column, picture) in pictures.iter().map(|(_, picture)| Some(picture)).chain([None]).enumerate() {
            let mut exact = [[0.0; 3]; 3];
            for (index, share) in shares.iter().enumerate() {
                let texel = picture.map_or([1.0; 4], |picture| picture.levels()[0].texels[index]);
                for colour in 0..3 {
                    for k in 0..3 {
                        exact[colour][k] += share[k] * f64::from(texel[colour]);
                    }
                }
            }
            for (row, colouring) in colourings.iter().enumerate() {
                let colours = match (picture, lookups(*colouring, table, quad)) {
                    (None, _) => [[1.0; 4]; 2],
                    (Some(picture), None) => [picture.sample([0.5; 2], f64::INFINITY); 2],
                    (Some(picture), Some(lookups)) => lookups.map(|lookup| fetch(picture, &lookup)),
                };
                for colour in 0..3 {
                    for k in 0..3 {
                        let found = value[k] * colours[k.min(1)][colour];
                        sums[row * columns + column][k] += (found - exact[colour][k]).abs();
                        sums[row * columns + column][3 + k] += exact[colour][k];
                    }
                }
            }
        }
        sums
    };
    let sums = quads.par_iter().map(measure).reduce(zero, add);
    let ratio =
        |s: &[f64; 6]| TextureAccuracy { diffuse: s[0] / s[3], specular: s[1] / s[4], fresnel: s[2] / s[5] };
    let rows: Vec<Vec<TextureAccuracy>> =
        sums.chunks(columns).map(|row| row[..columns - 1].iter().map(ratio).collect()).collect();
    (rows, ratio(&sums[columns - 1]))
}
