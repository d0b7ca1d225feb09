//! Ground truth: a real BRDF integrated numerically over the solid angle of a light.
//!
//! The integrals run over azimuth around the normal and, for each azimuth, over elevation, both by adaptive
//! Gauss–Kronrod quadrature. In solid angle the integrands are bounded however close, large or oblique the light is,
//! and nothing here shares a formula with linearly transformed cosines. Break points lie where a light's outline is
//! not smooth and, at geometric distances, around the mirror direction, so that no narrow peak falls between samples.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3};

use crate::brdf::Brdf;
use crate::light::Light;
use ellipse::{Ellipse, Everything};
use outline::{Crossing, Outline, elevation, wrap};
use quadrature::{Goal, Integral, Panel, integrate};

mod ellipse;
mod outline;
mod quadrature;
mod textured;
mod tube;

pub use textured::{texel_shares, textured_polygon};
pub use tube::tube;

/// A light's result at a surface point for unit radiance, with estimates of its errors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Truth {
    /// ∫cos/π over the solid angle of the light above the horizon: the form factor, 0…1.
    pub diffuse: f64,
    /// ∫f·cos for F = 1.
    pub specular: f64,
    /// ∫f·cos·(1−v·h)⁵ for F = 1, the Schlick part; v is the view direction and h the half vector.
    pub fresnel: f64,
    /// Estimates of the absolute errors of the three values.
    pub error: Estimate,
    /// How many directions the integrands were evaluated for.
    pub evaluations: usize,
    /// Whether refinement met the tolerance, or as much of it as rounded vertices allow; the values and estimates hold
    /// even if it gave up.
    pub converged: bool,
}

/// Estimates of absolute errors: those of the quadrature and of the light's rounded outline.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// Error of [`Truth::diffuse`].
    pub diffuse: f64,
    /// Error of [`Truth::specular`].
    pub specular: f64,
    /// Error of [`Truth::fresnel`].
    pub fresnel: f64,
}

/// Integrates `brdf` over the polygon through `points`, relative to the surface point in its frame (normal +z).
///
/// * `view` is a unit vector that points away from the surface, at any azimuth. Below the horizon only the diffuse
///   value is not zero.
/// * `points` are the vertices of a planar simple polygon, three or more, convex or not, of any finite size; it is cut
///   at the horizon. A self-intersecting outline counts by the even-odd rule. Vertices must lie in one plane up to
///   rounding.
/// * The polygon emits from the side from which its vertices run counter-clockwise; a point behind it gets exactly
///   zero unless `two_sided`. So does a point in its plane, even one inside its outline.
/// * `tolerance` is the relative error to reach in each of the three values, raised to at least 1e-11.
///
/// The result is finite for finite input. For a light of the angular size s, rounded vertices limit the relative
/// accuracy to about ε/s with ε = 2.2e-16; the estimates include that. What they cannot know is a peak of `brdf` that
/// lies neither near the mirror direction nor wider than [`Brdf::width`].
pub fn polygon(brdf: &dyn Brdf, view: DVec3, points: &[DVec3], two_sided: bool, tolerance: f64) -> Truth {
    let dark = Truth { converged: true, ..Truth::default() };
    if points.iter().all(|point| point.z <= 0.0) {
        return dark;
    }
    match Outline::new(points) {
        Some(outline) if two_sided || outline.faces_origin() => solid_angle(brdf, view, &outline, tolerance),
        _ => dark,
    }
}

/// Integrates `brdf` over any light; see the function of its shape.
pub fn light(brdf: &dyn Brdf, view: DVec3, light: &Light, tolerance: f64) -> Truth {
    match light {
        Light::Polygon { points, two_sided } => polygon(brdf, view, points, *two_sided, tolerance),
        Light::Tube { start, end, radius, caps } => tube(brdf, view, *start, *end, *radius, *caps, tolerance),
        Light::Disk { center, half_x, half_y, two_sided } => {
            disk(brdf, view, *center, *half_x, *half_y, *two_sided, tolerance)
        }
        Light::Sphere { center, radius } => sphere(brdf, view, *center, *radius, tolerance),
    }
}

/// Integrates `brdf` over the elliptical disk with the semi-axes `half_x` and `half_y` around `center`, relative to
/// the surface point in its frame; the axes need not be orthogonal.
///
/// The disk emits along `half_x` × `half_y`; a point behind it or in its plane gets exactly zero, the former unless
/// `two_sided`. For the rest see [`polygon`].
pub fn disk(
    brdf: &dyn Brdf,
    view: DVec3,
    center: DVec3,
    half_x: DVec3,
    half_y: DVec3,
    two_sided: bool,
    tolerance: f64,
) -> Truth {
    match Ellipse::new(center, half_x, half_y) {
        Some(ellipse) if two_sided || ellipse.faces_origin() => solid_angle(brdf, view, &ellipse, tolerance),
        _ => Truth { converged: true, ..Truth::default() },
    }
}

/// Integrates `brdf` over the sphere around `center`, relative to the surface point in its frame. From within, the
/// sphere covers every direction. For the rest see [`polygon`].
pub fn sphere(brdf: &dyn Brdf, view: DVec3, center: DVec3, radius: f64, tolerance: f64) -> Truth {
    if radius > 0.0 && center.length() <= radius {
        return solid_angle(brdf, view, &Everything, tolerance);
    }
    match Ellipse::of_sphere(center, radius) {
        Some(ellipse) => solid_angle(brdf, view, &ellipse, tolerance),
        None => Truth { converged: true, ..Truth::default() },
    }
}

/// The solid angle that a light covers, described by its cuts with vertical half-planes.
trait Footprint {
    /// Appends the azimuths, in any order and at any multiple of 2π, between which cuts change smoothly and keep
    /// their number of segments.
    fn breaks(&self, breaks: &mut Vec<f64>);

    /// Replaces `segments` by the cut with the half-plane at `azimuth`, clipped to the upper hemisphere. `crossings`
    /// is working memory.
    fn cut(&self, azimuth: f64, crossings: &mut Vec<Crossing>, segments: &mut Vec<Segment>);
}

/// A stretch of elevation at one azimuth.
struct Segment {
    /// Unit vector (horizontal, vertical) to the lower end.
    start: DVec2,
    /// Angle from there to the upper end.
    width: f64,
    /// Error of the width that rounded vertices cause.
    error: f64,
}

/// Number of integrals: diffuse, specular, Schlick part.
const VALUES: usize = 3;

/// Azimuthal integrands: the values and the errors of the integrals over elevation.
const COLUMNS: usize = 2 * VALUES;

/// Share of the tolerance that the integrals over elevation may use up.
const INNER_SHARE: f64 = 0.1;

/// Factor between successive break points around a peak.
///
/// With 15 points, (1 + x²)⁻² from 1 to 4 is accurate to 1e-9: most panels need no halving at usual tolerances.
const PEAK_RATIO: f64 = 4.0;

/// Rounding error of azimuths, in radians, at both ends of a light.
const AZIMUTH_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Panels at which refinement gives up, over elevation and over azimuth: far beyond need, but a bound on time.
const LIMITS: (usize, usize) = (200, 1000);

/// Integrates over the solid angle of `footprint`.
fn solid_angle(brdf: &dyn Brdf, view: DVec3, footprint: &dyn Footprint, tolerance: f64) -> Truth {
    let tolerance = tolerance.max(1e-11);
    let mut meridian = Meridian::new(brdf, view, footprint);
    let stretches = stretches(footprint, &meridian.peak, &mut meridian.crossings, &mut meridian.segments);
    let width: f64 = stretches.iter().map(|(from, to)| to - from).sum();
    if width <= 0.0 {
        return Truth { converged: true, ..Truth::default() };
    }
    let mut panels = Vec::new();
    // A first look tells how much each value amounts to. With it, meridians that add little can be integrated to an
    // absolute error instead of a relative one.
    let coarse = Goal { relative: f64::INFINITY, floor: &[], noisy: false, limit: 0 };
    let mut scale = integrate(stretches.iter().copied(), &coarse, &mut panels, |azimuth| {
        meridian.integrate(azimuth, f64::INFINITY, &[0.0; VALUES])
    })
    .value;
    let goal = Goal { relative: tolerance, floor: &[0.0; VALUES], noisy: true, limit: LIMITS.1 };
    let inner_tolerance = INNER_SHARE * tolerance;
    let mut attempts = 0;
    loop {
        let floor: [f64; VALUES] = std::array::from_fn(|index| inner_tolerance * scale[index] / width);
        meridian.converged = true;
        let result = integrate(stretches.iter().copied(), &goal, &mut panels, |azimuth| {
            meridian.integrate(azimuth, inner_tolerance, &floor)
        });
        attempts += 1;
        // A first look that saw too much has let the meridians stop too early.
        let misjudged = (0..VALUES).any(|index| result.value[index] < 0.25 * scale[index]);
        if attempts == 3 || !misjudged {
            return truth(&result, &panels, &meridian);
        }
        scale = result.value;
    }
}

fn truth(result: &Integral<COLUMNS>, panels: &[Panel<COLUMNS>], meridian: &Meridian) -> Truth {
    let error = |index: usize| {
        // Azimuths round wherever the light ends or the integrand varies: at most the highest panel shifts by that.
        let highest = panels.iter().map(|panel| panel.mean(index)).fold(0.0, f64::max);
        result.error[index] + result.value[VALUES + index] + AZIMUTH_ROUNDING * highest
    };
    Truth {
        diffuse: result.value[0],
        specular: result.value[1],
        fresnel: result.value[2],
        error: Estimate { diffuse: error(0), specular: error(1), fresnel: error(2) },
        evaluations: meridian.evaluations,
        converged: result.converged && meridian.converged,
    }
}

/// Stretches of azimuth within which the light is present and its cuts are smooth.
fn stretches(
    footprint: &dyn Footprint,
    peak: &Peak,
    crossings: &mut Vec<Crossing>,
    segments: &mut Vec<Segment>,
) -> Vec<(f64, f64)> {
    let mut breaks = Vec::new();
    footprint.breaks(&mut breaks);
    peak.azimuths(&mut breaks);
    for angle in &mut breaks {
        *angle = wrap(*angle);
    }
    breaks.sort_unstable_by(f64::total_cmp);
    breaks.dedup();
    let first = breaks.first().copied().unwrap_or(-PI);
    let mut stretches = Vec::with_capacity(breaks.len());
    for (index, &from) in breaks.iter().enumerate() {
        let to = breaks.get(index + 1).copied().unwrap_or(first + TAU);
        footprint.cut(0.5 * (from + to), crossings, segments);
        if to > from && !segments.is_empty() {
            stretches.push((from, to));
        }
    }
    stretches
}

/// Where the BRDF's lobe lies for a view direction.
struct Peak {
    /// Azimuth of the mirror direction.
    azimuth: f64,
    /// Horizontal and vertical part of the mirror direction.
    direction: DVec2,
    /// Width of the lobe of half vectors; 2 or more where there is no peak to look for.
    width: f64,
}

impl Peak {
    fn new(brdf: &dyn Brdf, view: DVec3) -> Self {
        let width = if view.z > 0.0 { brdf.width().max(1e-9) } else { f64::INFINITY };
        Self { azimuth: (-view.y).atan2(-view.x), direction: DVec2::new(view.x.hypot(view.y), view.z), width }
    }

    /// Appends azimuths around the mirror direction.
    ///
    /// When half vectors turn by δ across the plane of incidence, the reflected direction turns by 2δ times the
    /// cosine of incidence: seen from grazing directions the lobe is narrow in azimuth.
    fn azimuths(&self, breaks: &mut Vec<f64>) {
        let mut distance = self.width * self.direction.y.max(1e-9) / self.direction.x;
        if distance < PI {
            breaks.push(self.azimuth);
        }
        while distance < PI {
            breaks.push(self.azimuth - distance);
            breaks.push(self.azimuth + distance);
            distance *= PEAK_RATIO;
        }
    }

    /// Appends the elevations at which to break a cut at `azimuth`, in any order.
    fn elevations(&self, azimuth: f64, breaks: &mut Vec<f64>) {
        let (sine, cosine) = (azimuth - self.azimuth).sin_cos();
        let aside = self.direction.x * sine.abs();
        let mut distance = 1.5 * self.width.max(aside / self.direction.y.max(1e-9));
        if distance > 0.5 {
            return;
        }
        let center = self.direction.y.atan2(self.direction.x * cosine);
        breaks.push(center);
        while distance < FRAC_PI_2 {
            breaks.push(center - distance);
            breaks.push(center + distance);
            distance *= PEAK_RATIO;
        }
    }
}

/// The integrals over elevation at one azimuth, with the memory that they need.
struct Meridian<'a> {
    brdf: &'a dyn Brdf,
    view: DVec3,
    footprint: &'a dyn Footprint,
    peak: Peak,
    crossings: Vec<Crossing>,
    segments: Vec<Segment>,
    breaks: Vec<f64>,
    panels: Vec<Panel<VALUES>>,
    evaluations: usize,
    converged: bool,
}

impl<'a> Meridian<'a> {
    fn new(brdf: &'a dyn Brdf, view: DVec3, footprint: &'a dyn Footprint) -> Self {
        Self {
            brdf,
            view,
            footprint,
            peak: Peak::new(brdf, view),
            crossings: Vec::new(),
            segments: Vec::new(),
            breaks: Vec::new(),
            panels: Vec::new(),
            evaluations: 0,
            converged: true,
        }
    }

    /// The three values, then estimates of their absolute errors, for a unit of azimuth.
    fn integrate(&mut self, azimuth: f64, relative: f64, floor: &[f64; VALUES]) -> [f64; COLUMNS] {
        self.footprint.cut(azimuth, &mut self.crossings, &mut self.segments);
        let (sine, cosine) = azimuth.sin_cos();
        let goal = Goal { relative, floor, noisy: false, limit: LIMITS.0 };
        let mut columns = [0.0; COLUMNS];
        for segment in &self.segments {
            let base = elevation(segment.start);
            self.breaks.clear();
            self.peak.elevations(azimuth, &mut self.breaks);
            for angle in &mut self.breaks {
                *angle -= base;
            }
            self.breaks.retain(|&angle| angle > 0.0 && angle < segment.width);
            self.breaks.extend([0.0, segment.width]);
            self.breaks.sort_unstable_by(f64::total_cmp);
            let stretches = self.breaks.windows(2).map(|pair| (pair[0], pair[1]));
            let (brdf, view) = (self.brdf, self.view);
            let mut evaluations = 0;
            let result = integrate(stretches, &goal, &mut self.panels, |angle| {
                evaluations += 1;
                // Turning the lower end upwards adds positive terms, so that the height stays exact near the horizon.
                let (turn, keep) = angle.sin_cos();
                let horizontal = segment.start.x * keep - segment.start.y * turn;
                let vertical = segment.start.y * keep + segment.start.x * turn;
                let light = DVec3::new(horizontal * cosine, horizontal * sine, vertical);
                integrand(brdf, view, light).map(|value| value * horizontal)
            });
            self.evaluations += evaluations;
            self.converged &= result.converged;
            for index in 0..VALUES {
                columns[index] += result.value[index];
                columns[VALUES + index] +=
                    result.error[index] + segment.error * result.value[index].abs() / segment.width;
            }
        }
        columns
    }
}

/// The three integrands for one direction, per unit of solid angle.
fn integrand(brdf: &dyn Brdf, view: DVec3, light: DVec3) -> [f64; VALUES] {
    let diffuse = light.z / PI;
    let specular = brdf.evaluate(view, light) * light.z;
    // v·h is |v + l|/2. The difference from one cancels where the light is behind the viewer; in this form of
    // sin²/(1 + cos) of the angle between them it does not.
    let sine_squared = 0.25 * (view - light).length_squared();
    let cosine = 0.5 * (view + light).length();
    let schlick = sine_squared / (1.0 + cosine);
    let square = schlick * schlick;
    [diffuse, specular, specular * square * square * schlick]
}
