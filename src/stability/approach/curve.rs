//! The error of every method along an approach.

use super::list::{Approach, Measure, Part};
use super::precision::{Precision, vector};
use super::published::{self, EdgeForm};
use super::setting::Setting;
use super::{exact, round};
use crate::effects::{Effects, Quality};
use crate::light::{Light, polygon_value};
use crate::report::compare::published_table;
use crate::shade::{LTC_TINY, LobeSum, Real, Vector, ltc_fast_quad, ltc_quad, ltc_surface};
use crate::table::{Layer, Table};

/// Who evaluates a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The published technique for polygons.
    Polygon(EdgeForm),
    /// The published formula for disks.
    Disk,
    /// The published formula for lines.
    Line,
    /// A level of this library.
    Level(Quality),
}

impl Method {
    /// Its name in a key and in tables.
    pub fn label(self) -> &'static str {
        match self {
            Self::Polygon(EdgeForm::Printed) => "published 2016, arc cosine",
            Self::Polygon(EdgeForm::Fitted) => "published 2017, rational fit",
            Self::Disk => "published 2017, disk",
            Self::Line => "published 2017, line",
            Self::Level(Quality::Fast) => "Softbox, fast",
            Self::Level(Quality::Standard) => "Softbox, standard",
            Self::Level(Quality::Fine) => "Softbox, fine",
            Self::Level(Quality::Finest) => "Softbox, finest",
        }
    }

    /// Whether it is a level of this library.
    pub fn is_ours(self) -> bool {
        matches!(self, Self::Level(_))
    }

    /// What the method would make of a setting in exact arithmetic.
    ///
    /// # Panics
    ///
    /// If it knows nothing of such a light.
    pub fn exact(self, tables: &Tables, setting: &Setting) -> Parts {
        exact_value(self, tables, setting)
    }

    /// What it makes of a setting in f32, whose functions round correctly.
    ///
    /// # Panics
    ///
    /// As [`Method::exact`].
    pub fn single(self, tables: &Tables, setting: &Setting) -> Parts {
        value::<f32>(self, tables, setting)
    }

    /// The methods that differ along an approach: what is published for its light, then the levels.
    pub fn of(approach: &Approach) -> Vec<Self> {
        let light = approach.setting(approach.range[1], 0).light;
        let mut methods = match light {
            // The horizon is that of this library's own lobe.
            Light::Polygon { .. } if approach.measure == Measure::OfLight => Vec::new(),
            Light::Polygon { .. } => {
                vec![Self::Polygon(EdgeForm::Printed), Self::Polygon(EdgeForm::Fitted)]
            }
            Light::Disk { .. } | Light::Sphere { .. } => vec![Self::Disk],
            Light::Tube { .. } => vec![Self::Line],
        };
        let is_polygon = matches!(light, Light::Polygon { .. });
        methods.extend(Quality::ALL.into_iter().map(Self::Level).filter(|method| {
            match (method, approach.part) {
                (Self::Level(Quality::Standard), _) => true,
                (Self::Level(Quality::Fast), part) => is_polygon || part == Part::Specular,
                (_, part) => part == Part::Specular,
            }
        }));
        methods
    }
}

/// The tables that the methods read.
#[derive(Clone, Debug)]
pub struct Tables {
    native: Table,
    published: Table,
}

impl Default for Tables {
    fn default() -> Self {
        let layers: Vec<Layer> = Quality::ALL.into_iter().flat_map(|level| effects(level).layers()).collect();
        Self { native: Table::default().completed(&layers), published: published_table() }
    }
}

fn effects(level: Quality) -> Effects {
    let every = "quad,polygon,disk,sphere,tube+ggx".parse().expect("these are effects");
    level.of(every)
}

/// The parts of a value: the form factor, ∫ f·cos of the lobe for F = 1, and its Schlick part.
pub type Parts = [f64; 3];

/// What a method makes of a setting in f32, or in any precision.
pub(super) fn value<R: Precision>(method: Method, tables: &Tables, setting: &Setting) -> Parts {
    match (method, &setting.light) {
        (Method::Level(level), _) => level_value::<R>(level, tables, setting),
        (Method::Polygon(form), Light::Polygon { points, .. }) => {
            let (rows, weights) = published::lobe::<R>(&tables.published, setting);
            let diffuse =
                published::form_factor::<R>(form, published::plain_frame::<R>(setting), setting, points);
            parts(diffuse, published::form_factor::<R>(form, rows, setting, points), weights)
        }
        (Method::Disk, _) => {
            let (rows, weights) = published::lobe::<R>(&tables.published, setting);
            let share = |rows: [R::Vec3; 3]| {
                round::ellipse::<R>(rows, setting)
                    .map_or(R::new(0.0), |ellipse| round::elliptic(&tables.published, &ellipse))
            };
            parts(share(published::plain_frame::<R>(setting)), share(rows), weights)
        }
        (Method::Line, Light::Tube { start, end, radius, .. }) => {
            let frame = published::plain_frame::<R>(setting);
            let local = |v: glam::DVec3| {
                published::transform::<R>(frame, vector::<R>(v) - vector::<R>(setting.position))
            };
            let diffuse = round::line::<R>(local(*start), local(*end), R::new(*radius)).to_f64();
            [diffuse, f64::NAN, f64::NAN]
        }
        (method, light) => panic!("{method:?} knows no {}", light.shape()),
    }
}

/// What a method would make of a setting in exact arithmetic.
pub(super) fn exact_value(method: Method, tables: &Tables, setting: &Setting) -> Parts {
    match (method, &setting.light) {
        (Method::Level(Quality::Fast), _) => level_value::<f64>(Quality::Fast, tables, setting),
        (Method::Level(level), Light::Polygon { points, .. }) => {
            // An integral that shares no formula with the library, and in lobes the walk along any polygon's edges, which cuts
            // each of them wherever it is.
            let [_, specular, fresnel] = streamed_value(level, tables, setting, points);
            [exact::form_factor(exact::frame(setting), setting, points), specular, fresnel]
        }
        (Method::Level(level), _) => level_value::<f64>(level, tables, setting),
        (Method::Polygon(_), Light::Polygon { points, .. }) => {
            let (rows, weights) = exact::lobe(&tables.published, setting);
            let diffuse = exact::form_factor(exact::frame(setting), setting, points);
            parts(diffuse, exact::form_factor(rows, setting, points), weights)
        }
        (Method::Disk, _) => {
            let (rows, weights) = exact::lobe(&tables.published, setting);
            let share = |rows| {
                round::ellipse::<f64>(rows, setting)
                    .map_or(0.0, |ellipse| exact::elliptic(&tables.published, &ellipse))
            };
            parts(share(exact::frame(setting)), share(rows), weights)
        }
        (Method::Line, Light::Tube { start, end, radius, .. }) => {
            let rows = exact::frame(setting);
            let local = |v: glam::DVec3| published::transform::<f64>(rows, v - setting.position);
            [2.0 * radius * exact::line(local(*start), local(*end)), f64::NAN, f64::NAN]
        }
        (method, light) => panic!("{method:?} knows no {}", light.shape()),
    }
}

fn level_value<R: Real>(level: Quality, tables: &Tables, setting: &Setting) -> Parts {
    let effects = effects(level);
    let surface = ltc_surface::<R>(
        vector::<R>(setting.position),
        vector::<R>(setting.normal),
        vector::<R>(setting.view),
        R::new(setting.roughness),
    );
    let lobes = tables.native.specular(&surface, effects);
    let value = light_value(&surface, &lobes, &setting.light, effects);
    [value.x(), value.y(), value.z()].map(R::to_f64)
}

/// A value from the form factors over the surface and in the lobe, and the lobe's weights.
fn parts<R: Real>(diffuse: R, specular: R, [albedo, fresnel]: [R; 2]) -> Parts {
    [diffuse, albedo * specular, fresnel * specular].map(R::to_f64)
}

/// A polygon by the functions for any number of vertices, in f64.
fn streamed_value(level: Quality, tables: &Tables, setting: &Setting, points: &[glam::DVec3]) -> Parts {
    let surface = ltc_surface(setting.position, setting.normal, setting.view, setting.roughness);
    let lobes = tables.native.specular(&surface, effects(level));
    polygon_value::<f64>(&surface, &lobes, points, false, setting.is_two_sided()).to_array()
}

/// Four vertices are a quad, however far rounding has bent it.
fn light_value<R: Real>(
    surface: &crate::shade::LtcSurface<R>,
    lobes: &impl LobeSum<R>,
    light: &Light,
    effects: Effects,
) -> R::Vec3 {
    match light {
        Light::Polygon { points, two_sided } if points.len() == 4 => {
            let corners = core::array::from_fn(|i| vector::<R>(points[i]));
            if effects.is_fast() {
                ltc_fast_quad(surface, lobes, corners, *two_sided)
            } else {
                ltc_quad(surface, lobes, corners, *two_sided)
            }
        }
        _ => crate::light::light_value_with(surface, lobes, light, effects),
    }
}

/// One evaluation in f32 against exact arithmetic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// What single precision makes of it.
    pub value: f64,
    /// What exact arithmetic does.
    pub exact: f64,
    /// The difference in the approach's measure; infinite where the value is not finite.
    pub error: f64,
}

/// Evaluates a method in f32 at a setting of an approach.
pub fn read(approach: &Approach, method: Method, tables: &Tables, setting: &Setting) -> Reading {
    let part = match approach.part {
        Part::Diffuse => 0,
        Part::Specular => 1,
    };
    let value = value::<f32>(method, tables, setting)[part];
    let all = exact_value(method, tables, setting);
    let exact = all[part];
    let difference = (value - exact).abs();
    let error = match approach.measure {
        _ if !value.is_finite() => f64::INFINITY,
        Measure::Absolute => difference,
        Measure::Relative => difference / exact.max(LTC_TINY),
        Measure::OfLight => difference / all[0].max(LTC_TINY),
    };
    Reading { value, exact, error }
}

/// A step of a curve: the worst of some settings with the same parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// The parameter.
    pub parameter: f64,
    /// The largest finite error.
    pub error: f64,
    /// How many settings were evaluated.
    pub count: usize,
    /// How many of the values were infinite or not a number.
    pub not_finite: usize,
    /// The error that the library promises at most.
    pub bound: f64,
}

/// The error of a method along an approach.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The approach.
    pub approach: Approach,
    /// The method.
    pub method: Method,
    /// From the end of the range where nothing is hard.
    pub steps: Vec<Step>,
}

/// Parameters in each factor of ten.
const STEPS_PER_DECADE: f64 = 8.0;
/// Settings with the same parameter.
pub const VARIANTS: usize = 24;

/// The curves of every method along an approach.
pub fn curves(approach: &Approach, tables: &Tables) -> Vec<Curve> {
    let curve = |method| {
        let steps = parameters(approach).into_iter().map(|parameter| {
            let mut step = Step { parameter, error: 0.0, count: VARIANTS, not_finite: 0, bound: 0.0 };
            for variant in 0..VARIANTS {
                let setting = approach.setting(parameter, variant);
                let reading = read(approach, method, tables, &setting);
                step.bound = step.bound.max(approach.bound(method, &setting, parameter));
                if reading.error.is_finite() {
                    step.error = step.error.max(reading.error);
                } else {
                    step.not_finite += 1;
                }
            }
            step
        });
        Curve { approach: *approach, method, steps: steps.collect() }
    };
    Method::of(approach).into_iter().map(curve).collect()
}

/// The parameters of an approach, evenly in the logarithm, both ends included.
pub fn parameters(approach: &Approach) -> Vec<f64> {
    let [low, high] = approach.range.map(f64::log10);
    let count = ((high - low) * STEPS_PER_DECADE).round().max(8.0) as usize;
    (0..=count).map(|i| 10_f64.powf(low + (high - low) * i as f64 / count as f64)).collect()
}
