//! The specular lobe by a closed form, in place of a table.

use super::real::Real;
use super::surface::{LtcLobe, LtcSurface, ltc_lobe};

/// Coefficients of the closed form; see [`FittedLobe::shape`] and the following for what they multiply.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedLobe {
    /// Of X, by the monomials r², r³, r⁴, r·c and r·c².
    pub x: [f64; 5],
    /// Of Y, by c, r⁴·c, r² and r³.
    pub y: [f64; 4],
    /// Of Z, by r, r·c and r³.
    pub z: [f64; 3],
    /// Of W, by 1, r², c² and r⁴·c².
    pub w: [f64; 4],
    /// Of the albedo less 1, by r, r·c², r³·c and r⁴·c.
    pub albedo: [f64; 4],
    /// Of the fifth root of the albedo's Schlick part, by u, r, r²u², r³u³ and r⁴u⁴ with u = 1 − c.
    pub fresnel: [f64; 5],
}

/// The coefficients that the include holds; the fit `softbox::fit::fit_lobe_formula`.
pub const LTC_FITTED: FittedLobe = FittedLobe {
    x: [1.508871, 3.145455, -3.884754, 1.488739, -2.649476],
    y: [-0.8051475, 1.19368, 0.4593228, -0.5799547],
    z: [1.491276, -1.525616, -1.383334],
    w: [1.22383, 0.3294481, 0.7461472, -1.447918],
    albedo: [-0.1695292, 0.4340052, -2.495072, 1.536499],
    fresnel: [1.00488, 0.1454361, -2.643383, 3.282343, -1.25427],
};

impl FittedLobe {
    /// The lobe's deviation (X, Y, Z, W) from the mirror's at the roughness `r` and the cosine `c` of the view, as
    /// [`ltc_lobe`] reads it.
    pub fn shape<R: Real>(&self, r: R, c: R) -> [R; 4] {
        let (alpha, squared) = (r * r, c * c);
        let (x, y, z, w) = (self.x.map(R::new), self.y.map(R::new), self.z.map(R::new), self.w.map(R::new));
        [
            r * ((x[0] + (x[1] + x[2] * r) * r) * r + (x[3] + x[4] * c) * c),
            (y[1] * (alpha * alpha) + y[0]) * c + (y[2] + y[3] * r) * alpha,
            r * (z[0] + z[1] * c + z[2] * alpha),
            (w[2] + w[3] * (alpha * alpha)) * squared + (w[0] + w[1] * alpha),
        ]
    }

    /// ∫ f·cos over the hemisphere.
    pub fn albedo<R: Real>(&self, r: R, c: R) -> R {
        let [a, b, d, e] = self.albedo.map(R::new);
        let one: R = R::new(1.0);
        (one + r * (b * (c * c) + a + (e * r + d) * (r * r * c))).clamp(R::new(0.0), one)
    }

    /// ∫ f·cos·(1 − v·h)⁵ over the hemisphere, no more than the albedo.
    pub fn fresnel<R: Real>(&self, r: R, c: R) -> R {
        let q: [R; 5] = self.fresnel.map(R::new);
        let u = R::new(1.0) - c;
        let z = r * u;
        let root = (q[0] * u + q[1] * r + ((q[3] + q[4] * z) * z + q[2]) * (z * z)).max(R::new(0.0));
        let squared = root * root;
        (squared * squared * root).min(self.albedo(r, c))
    }
}

/// The lobe of a surface by the closed form of [`LTC_FITTED`].
pub fn ltc_lobe_fitted<R: Real>(surface: &LtcSurface<R>) -> LtcLobe<R> {
    let (r, c) = (surface.roughness, surface.cos_view);
    let zero = R::new(0.0);
    let amplitude = [LTC_FITTED.albedo(r, c), LTC_FITTED.fresnel(r, c), zero, zero];
    ltc_lobe(surface, LTC_FITTED.shape(r, c).into(), amplitude.into())
}
