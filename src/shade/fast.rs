//! Lights with the switches for a cheap horizon and a cheap distance.

use super::quad::{OVER_TWO_PI, ltc_shorter};
use super::real::{Real, Vector};
use super::several::{LobeSum, ltc_lobes_value, with_form_factor};
use super::surface::{
    LTC_HEADROOM, LTC_SMALLEST, LTC_TINY, LtcLobe, LtcSurface, ltc_extent, ltc_in_frame, ltc_transform_framed,
};

/// τ₀, τ₁ and τ₂ of the fit `softbox::fit::fit_half_angle`, from which the coefficients of [`ltc_fast_ratio`] come.
pub const LTC_HALF_ANGLE: [f64; 3] = [1.569595133, -0.390705002, 0.169246011];

/// Coefficients of [`ltc_round_above`]: by the depth, its square and the offset; the fit
/// `softbox::fit::fit_round_above`.
pub const LTC_ROUND_ABOVE: [f64; 3] = [1.221, -0.80223, 0.0892];

/// `v` over its length, for a `v` whose square is in range; shorter than 1 below 1e-18.
pub fn ltc_fast_unit<R: Real>(v: R::Vec3) -> R::Vec3 {
    v * (v.dot(v) + R::new(LTC_TINY)).inverse_sqrt()
}

/// θ / sin θ for the angle between two unit vectors, from their sum: what the include's polynomial gives, in any
/// precision.
pub fn ltc_fast_ratio<R: Real>(v: R::Vec3) -> R {
    let squared = v.dot(v) + R::new(1e-12);
    let inverse = squared.inverse_sqrt();
    let [a, b, c] = LTC_HALF_ANGLE;
    R::new(2.0 * a) * inverse
        + ((R::new(0.5 * (c - b)) * inverse + R::new(-0.25 * c)) * squared + R::new(1.0 + b - a))
}

/// The edge integral of two unit vectors.
pub fn ltc_fast_edge<R: Real>(a: R::Vec3, b: R::Vec3) -> R::Vec3 {
    let product = a.cross(b - a);
    product * ltc_fast_ratio::<R>(a + b)
}

/// Vector form factor, times 2π and signed, of the quad between four unit vectors.
pub fn ltc_fast_form_factor<R: Real>([a, b, c, d]: [R::Vec3; 4]) -> R::Vec3 {
    let a_ratio = ltc_fast_ratio::<R>(a + b);
    let b_ratio = ltc_fast_ratio::<R>(b + c);
    let c_ratio = ltc_fast_ratio::<R>(c + d);
    let d_ratio = ltc_fast_ratio::<R>(d + a);
    let from_a = b * a_ratio - d * d_ratio;
    let more_from_c = b * (b_ratio - a_ratio) + d * (d_ratio - c_ratio);
    (c - a).cross(from_a) + c.cross(more_from_c)
}

/// The form factor of what a horizon leaves of the round light whose vector form factor is given; `height` is the
/// product of that one and the horizon's normal.
pub fn ltc_round_above<R: Real>(form_factor: R::Vec3, height: R) -> R {
    let (zero, one, tiny): (R, R, R) = (R::new(0.0), R::new(1.0), R::new(LTC_TINY));
    let root = |x: R| x * x.inverse_sqrt();
    let squared = form_factor.dot(form_factor).min(one);
    let inverse = squared.max(tiny).inverse_sqrt();
    let whole = squared * inverse;
    let reach = whole * root(whole.max(tiny));
    let tilt = (height * inverse).abs().min(R::new(1.0));
    let offset = (tilt * tilt * inverse).min(one);
    let depth = root((one - whole).max(tiny));
    let [a, b, c] = LTC_ROUND_ABOVE.map(R::new);
    let missing = (a + b * depth) * depth + c * offset;
    let level = height.abs().max(reach * (one - (one - offset) * missing));
    (R::new(0.5) * (height + level)).clamp(zero, one)
}

/// The directions of a light's vertices, scaled by a power of two first as the include does it.
fn directions<R: Real, const N: usize>(surface: &LtcSurface<R>, vertices: [R::Vec3; N]) -> [R::Vec3; N] {
    let extent = vertices.iter().map(|v| ltc_extent::<R>(*v)).fold(R::new(1e-30), R::max);
    let extent = extent.max(ltc_extent::<R>(surface.position)).to_f64();
    let scale = R::new((1.0 - extent.log2().floor()).exp2());
    let origin = surface.position * scale;
    vertices.map(|v| ltc_fast_unit::<R>(v * scale - origin))
}

/// A quad or polygon as the include sees it with the switches for a cheap horizon and a cheap distance.
#[derive(Clone, Debug)]
pub struct LtcFastLight<R: Real> {
    /// Directions of the vertices, in the surface's frame: of a quad its four, of a polygon those of each edge in turn.
    units: Vec<R::Vec3>,
    /// Whether it is a quad.
    is_quad: bool,
    /// What turns the sum over the edges into the form factor of the light that arrives; 0 if none does.
    scale: R,
}

impl<R: Real> LtcFastLight<R> {
    /// A convex quad.
    pub fn quad(surface: &LtcSurface<R>, vertices: [R::Vec3; 4], two_sided: bool) -> Self {
        let units = directions::<R, 4>(surface, vertices).map(|v| ltc_in_frame(surface, v));
        let [a, b, c, d] = units;
        let front = (b - d).cross(c).dot(a) < R::new(0.0);
        let scale = if front { OVER_TWO_PI } else { -OVER_TWO_PI };
        let scale = if front | two_sided { scale } else { 0.0 };
        Self { units: units.to_vec(), is_quad: true, scale: R::new(scale) }
    }

    /// A polygon of any number of vertices.
    pub fn polygon(surface: &LtcSurface<R>, vertices: &[R::Vec3], two_sided: bool) -> Self {
        let (mut units, mut facing) = (Vec::with_capacity(2 * vertices.len()), R::new(0.0));
        let headroom: R = R::new(LTC_HEADROOM);
        let origin = surface.position * headroom;
        let first = vertices[0] * headroom;
        let unit = R::new(1.0) / ltc_extent::<R>(first - origin).max(R::new(LTC_SMALLEST));
        for (index, vertex) in vertices.iter().enumerate() {
            let next = vertices[(index + 1) % vertices.len()];
            let (a, b) = (*vertex * headroom, next * headroom);
            let extent = ltc_extent::<R>(a - origin).max(ltc_extent::<R>(b - origin));
            let unit = unit.min(R::new(1e8) / extent.max(R::new(1e-11)));
            let offset = ltc_shorter::<R>((a - first) * unit, (b - first) * unit);
            let point = ltc_shorter::<R>((a - origin) * unit, (b - origin) * unit);
            facing += ltc_shorter::<R>(offset, point).cross((b - a) * unit).dot((first - origin) * unit);
            units.extend(directions::<R, 2>(surface, [*vertex, next]).map(|v| ltc_in_frame(surface, v)));
        }
        let front = facing < R::new(0.0);
        let scale = if front { -OVER_TWO_PI } else { OVER_TWO_PI };
        let scale = if front | two_sided { scale } else { 0.0 };
        Self { units, is_quad: false, scale: R::new(scale) }
    }

    /// The vector form factor with the directions led elsewhere.
    fn form_factor(&self, moved: impl Fn(R::Vec3) -> R::Vec3) -> R::Vec3 {
        let units: Vec<R::Vec3> = self.units.iter().map(|unit| moved(*unit)).collect();
        let zero: R = R::new(0.0);
        let sum = if self.is_quad {
            ltc_fast_form_factor::<R>([units[0], units[1], units[2], units[3]])
        } else {
            let edges = units.chunks(2).map(|edge| ltc_fast_edge::<R>(edge[0], edge[1]));
            edges.fold(R::Vec3::new(zero, zero, zero), |sum, edge| sum + edge)
        };
        sum * self.scale
    }

    /// The form factor, 0…1.
    pub fn diffuse(&self) -> R {
        let toward = self.form_factor(|unit| unit);
        ltc_round_above(toward, toward.z())
    }

    /// The vector form factor in a lobe's space, above its horizon, towards the light.
    pub fn lobe(&self, lobe: &LtcLobe<R>) -> R::Vec3 {
        let toward = self.form_factor(|unit| ltc_fast_unit::<R>(ltc_transform_framed(lobe, unit)));
        R::Vec3::new(toward.x(), toward.y(), ltc_round_above(toward, toward.z())) * lobe.share
    }

    /// The value (diffuse, specular, fresnel).
    pub fn value(&self, surface: &LtcSurface<R>, lobes: &impl LobeSum<R>) -> R::Vec3 {
        with_form_factor(self.diffuse(), ltc_lobes_value(surface, lobes, |lobe| self.lobe(lobe)))
    }
}

/// The value (diffuse, specular, fresnel) of a convex quad light as the include's `ltc_quad` gives it with the switches for
/// a cheap horizon and a cheap distance.
pub fn ltc_fast_quad<R: Real>(
    surface: &LtcSurface<R>,
    lobes: &impl LobeSum<R>,
    vertices: [R::Vec3; 4],
    two_sided: bool,
) -> R::Vec3 {
    LtcFastLight::quad(surface, vertices, two_sided).value(surface, lobes)
}

/// The value (diffuse, specular, fresnel) of a polygon as the include's polygon functions give it with the switches for a
/// cheap horizon and a cheap distance.
pub fn ltc_fast_polygon<R: Real>(
    surface: &LtcSurface<R>,
    lobes: &impl LobeSum<R>,
    vertices: &[R::Vec3],
    two_sided: bool,
) -> R::Vec3 {
    LtcFastLight::polygon(surface, vertices, two_sided).value(surface, lobes)
}
