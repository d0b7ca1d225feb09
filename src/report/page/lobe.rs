//! Lobes beside the BRDF that they stand in for.

use glam::{DMat3, DVec3};
use maud::html;

use super::document::{Figure, Picture};
use super::map::{bar, colour};
use super::number::{figure, slug};
use super::scale::{Law, Scale, rounded};
use super::sphere::{DECADES, ball, density_map, difference_colour, difference_map, direction};
use super::svg::{COLOURS, FAINT, Frame, KEY_LINE, WIDTH, document, key, line, path, small_text, text};
use crate::brdf::{Brdf, Ggx};
use crate::shade::{LtcLobe, ltc_surface, ltc_transform};
use crate::table::Table;

/// A distribution of reflected light over directions, to be drawn. Those of the same roughness and cosine stand side by
/// side; the first of them is what the others are compared with.
pub struct LobePlot {
    /// What charts call it.
    pub label: String,
    /// Perceptual roughness of the surface.
    pub roughness: f64,
    /// Cosine between normal and view.
    pub cosine: f64,
    /// f·cos in 1/sr for a unit direction above the surface, in the surface's frame: normal +z, the view at x ≥ 0 in the
    /// xz-plane.
    pub density: Box<dyn Fn(DVec3) -> f64 + Sync>,
}

impl LobePlot {
    /// GGX itself, F = 1.
    pub fn ggx(roughness: f64, cosine: f64) -> Self {
        let brdf = Ggx::new(roughness * roughness);
        let view = view(cosine);
        let density = move |light: DVec3| brdf.evaluate(view, light) * light.z.max(0.0);
        Self { label: "GGX".to_owned(), roughness, cosine, density: Box::new(density) }
    }

    /// A sum of lobes with an albedo each, as the include evaluates them: cut at the surface's horizon and divided by the
    /// share that is left.
    pub fn lobes(label: &str, roughness: f64, cosine: f64, lobes: Vec<LtcLobe<f64>>) -> Self {
        let density = move |light: DVec3| lobes.iter().map(|lobe| lobe_density(lobe, light)).sum();
        Self { label: label.to_owned(), roughness, cosine, density: Box::new(density) }
    }

    /// The one lobe of a table in the native layout.
    pub fn one_lobe(label: &str, table: &Table, roughness: f64, cosine: f64) -> Self {
        let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, view(cosine), roughness);
        Self::lobes(label, roughness, cosine, vec![table.lobe(&surface)])
    }
}

/// Pairs of roughness and cosine at which lobes are worth a look: smooth and rough, facing and grazing.
pub const LOBE_SIGHTS: [(f64, f64); 4] = [(0.25, 0.8), (0.5, 0.5), (0.5, 0.15), (0.85, 0.3)];

/// GGX and the one lobe of a table at each of [`LOBE_SIGHTS`].
pub fn lobe_plots(table: &Table) -> Vec<LobePlot> {
    let pair = |(roughness, cosine)| {
        [
            LobePlot::ggx(roughness, cosine),
            LobePlot::one_lobe("one lobe (standard)", table, roughness, cosine),
        ]
    };
    LOBE_SIGHTS.into_iter().flat_map(pair).collect()
}

fn view(cosine: f64) -> DVec3 {
    DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine)
}

/// D(ω) = max(0, z of M⁻¹ω / |M⁻¹ω|)/π · |M⁻¹| / |M⁻¹ω|³ (Heitz et al. 2016, equation 1), times albedo over share, above the
/// surface.
fn lobe_density(lobe: &LtcLobe<f64>, light: DVec3) -> f64 {
    if light.z <= 0.0 {
        return 0.0;
    }
    let determinant = lobe.axis_x.cross(lobe.axis_y).dot(lobe.axis_z).abs();
    let turned = ltc_transform(lobe, light);
    transformed(turned, determinant) * lobe.albedo / lobe.share
}

/// A clamped cosine's density at ω, from M⁻¹ω and |M⁻¹|.
fn transformed(turned: DVec3, determinant: f64) -> f64 {
    let square = turned.length_squared().max(f64::MIN_POSITIVE);
    turned.z.max(0.0) * core::f64::consts::FRAC_1_PI * determinant / (square * square)
}

/// The clamped cosine and what some matrices make of it, on the sphere.
pub(super) fn cosines() -> Vec<Vec<Picture>> {
    let matrix = |rows: [[f64; 3]; 3]| DMat3::from_cols_array_2d(&rows).transpose();
    let sights: [(&str, &str, DMat3); 5] = [
        ("clamped cosine", "M = 1", DMat3::IDENTITY),
        (
            "narrowed evenly, as by a smooth surface",
            "M = diag(0.4, 0.4, 1)",
            DMat3::from_diagonal(DVec3::new(0.4, 0.4, 1.0)),
        ),
        (
            "narrowed more across, as by a surface seen at an angle or brushed",
            "M = diag(0.8, 0.2, 1)",
            DMat3::from_diagonal(DVec3::new(0.8, 0.2, 1.0)),
        ),
        (
            "leant towards the mirror direction",
            "M = rows (1, 0, −0.8), (0, 1, 0), (0, 0, 1)",
            matrix([[1.0, 0.0, -0.8], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        ),
        (
            "both",
            "M = rows (0.5, 0, −0.8), (0, 0.25, 0), (0.1, 0, 1)",
            matrix([[0.5, 0.0, -0.8], [0.0, 0.25, 0.0], [0.1, 0.0, 1.0]]),
        ),
    ];
    let draw = |(name, shown, matrix): (&str, &str, DMat3)| {
        let (inverse, determinant) = (matrix.inverse(), matrix.determinant().abs().recip());
        let density = move |direction: DVec3| transformed(inverse * direction, determinant);
        let peak = peak(&density);
        vec![Picture {
            file: format!("charts/cosine-{}.png", slug(name)),
            caption: vec![name.to_owned(), shown.to_owned(), format!("peak {} /sr", figure(peak))],
            png: ball(&density, peak),
            width: SHOWN,
        }]
    };
    sights.into_iter().map(draw).collect()
}

/// Pixels across of the pictures on the page.
const SHOWN: u32 = 214;

/// Steps along each side of the grid that [`peak`] and [`distance`] sum over.
const GRID: usize = 400;

/// Directions that cover the hemisphere evenly.
fn hemisphere() -> impl Iterator<Item = DVec3> {
    let place = |index: usize| 2.0 * (index as f64 + 0.5) / GRID as f64 - 1.0;
    let grid = (0..GRID * GRID).map(move |index| glam::DVec2::new(place(index % GRID), place(index / GRID)));
    grid.filter_map(direction)
}

/// The largest value of a density above the surface.
fn peak(density: &(dyn Fn(DVec3) -> f64 + Sync)) -> f64 {
    hemisphere().map(density).fold(1e-9, f64::max)
}

/// Half the integral of |difference| of two densities, both normalised.
fn distance(a: &LobePlot, b: &LobePlot) -> f64 {
    let pairs: Vec<[f64; 2]> = hemisphere().map(|light| [(a.density)(light), (b.density)(light)]).collect();
    let sum = |index: usize| pairs.iter().map(|pair| pair[index]).sum::<f64>().max(f64::MIN_POSITIVE);
    let (first, second) = (sum(0), sum(1));
    0.5 * pairs.iter().map(|[a, b]| (a / first - b / second).abs()).sum::<f64>()
}

/// Everything about lobes at one roughness and view.
pub(super) struct Sight {
    pub title: String,
    /// In the plane of incidence: densities, and differences from the first.
    pub sections: Vec<Figure>,
    /// Keys to the colours of the maps.
    pub keys: Vec<Figure>,
    /// Over the hemisphere: a column for each density, with its difference from the first.
    pub maps: Vec<Vec<Picture>>,
}

/// Draws plots of the same roughness and cosine.
pub(super) fn sight(plots: &[&LobePlot]) -> Sight {
    let (roughness, cosine) = (plots[0].roughness, plots[0].cosine);
    let title =
        format!("roughness {roughness}, view at {:.0}° (cosine {cosine})", cosine.acos().to_degrees());
    let name = slug(&format!("lobe r{roughness} c{cosine}"));
    let peak = peak(&*plots[0].density);
    let reference = &plots[0].density;
    let largest = plots[1..]
        .iter()
        .flat_map(|plot| hemisphere().map(|light| ((plot.density)(light) - reference(light)).abs()))
        .fold(1e-9, f64::max);
    let full = rounded(largest, true);
    let density = |plot: &LobePlot| Picture {
        file: format!("charts/{name}-{}.png", slug(&plot.label)),
        caption: vec![plot.label.clone()],
        png: density_map(&*plot.density, peak, cosine),
        width: SHOWN,
    };
    let difference = |plot: &&LobePlot| Picture {
        file: format!("charts/{name}-{}-difference.png", slug(&plot.label)),
        caption: vec![
            format!("{} − {}", plot.label, plots[0].label),
            format!("total variation {}", figure(distance(plots[0], plot))),
        ],
        png: difference_map(&|light| (plot.density)(light) - reference(light), full, cosine),
        width: SHOWN,
    };
    let maps = plots.iter().enumerate().map(|(index, plot)| {
        let below = (index > 0).then(|| difference(plot));
        [density(plot)].into_iter().chain(below).collect()
    });
    let maps: Vec<Vec<Picture>> = maps.collect();
    let section = |difference: bool| {
        let heading = if difference {
            format!("Difference from {} in the plane of incidence", plots[0].label)
        } else {
            "In the plane of incidence".to_owned()
        };
        let svg = section(plots, &format!("{heading}: {title}"), &heading, difference);
        let kind = if difference { "difference" } else { "section" };
        Figure {
            file: format!("charts/{name}-{kind}.svg"),
            title: format!("{heading}: {title}"),
            svg,
            origin: None,
        }
    };
    let key = |kind: &str, svg: String| Figure {
        file: format!("charts/{name}-{kind}-key.svg"),
        title: format!("Key to the colours: {title}"),
        svg,
        origin: None,
    };
    let densities = Scale::between(peak * 10_f64.powf(-DECADES), peak, Law::Logarithmic);
    let differing = Scale::root(full);
    let keys = vec![
        key("density", bar(densities, "f·cos (1/sr)", 1.0, &colour)),
        key(
            "difference",
            bar(differing, "difference of f·cos (1/sr), root scale", 1.0, &|share| {
                difference_colour(2.0 * share - 1.0)
            }),
        ),
    ];
    Sight {
        sections: if plots.len() > 1 { vec![section(false), section(true)] } else { vec![section(false)] },
        keys,
        maps,
        title,
    }
}

/// Dashes of the lines of a section, so that they differ not in colour alone.
const DASHES: [&str; 4] = ["none", "8 3", "3 2", "9 2 2 2"];

/// Densities, or their differences from the first, along the plane of incidence.
fn section(plots: &[&LobePlot], name: &str, heading: &str, difference: bool) -> String {
    const HEIGHT: f64 = 360.0;
    let light = |degrees: f64| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        DVec3::new(sine, 0.0, cosine)
    };
    let angles: Vec<f64> = (-358..=358).map(|step| 0.25 * f64::from(step)).collect();
    let first = &plots[0].density;
    let curves: Vec<(usize, Vec<f64>)> = plots
        .iter()
        .enumerate()
        .skip(usize::from(difference))
        .map(|(index, plot)| {
            let value = |angle: &f64| {
                let base = if difference { first(light(*angle)) } else { 0.0 };
                (plot.density)(light(*angle)) - base
            };
            (index, angles.iter().map(value).collect())
        })
        .collect();
    let [left, right] = [62.0, WIDTH - 14.0];
    let x = Scale { from: left, to: right, step: Some(30.0), ..Scale::between(-90.0, 90.0, Law::Linear) };
    let mirror = -plots[0].cosine.acos().to_degrees();
    let colour_of = |index: usize| if index == 0 { "#000000" } else { COLOURS[(index - 1) % 6] };
    let names: Vec<&str> = curves.iter().map(|(index, _)| plots[*index].label.as_str()).collect();
    let (key, lines) = key(&names, [14.0, right, 42.0], 34.0, &|index, x, y| {
        let index = curves[index].0;
        html! {
            path d=(path([[x, y - 4.5], [x + 28.0, y - 4.5]])) stroke=(colour_of(index)) stroke-width="2.2"
                stroke-dasharray=(DASHES[index % 4]) {}
        }
    });
    let [top, bottom] = [40.0 + KEY_LINE * lines, HEIGHT - 48.0];
    let y = Scale::linear(curves.iter().flat_map(|(_, values)| values.iter().copied()), bottom, top);
    let frame = Frame { x, y };
    let content = html! {
        (frame.axes("angle from the normal (°); the view is on the right", if difference { "difference of f·cos (1/sr)" } else { "f·cos (1/sr)" }, 1.0))
        (text(14.0, 20.0, "start", heading))
        (key)
        (line([x.place(mirror), top, x.place(mirror), bottom], "#bbb", 1.2))
        g stroke="#fff" stroke-width="3" paint-order="stroke" {
            (small_text(x.place(mirror) + 4.0, top + 10.0, "start", FAINT, "mirror"))
        }
        (line([left, y.place(0.0), right, y.place(0.0)], FAINT, 0.8))
        @for (index, values) in &curves {
            path d=(path(angles.iter().zip(values).map(|(angle, value)| frame.place(*angle, *value)))) fill="none"
                stroke=(colour_of(*index)) stroke-width=(if *index == 0 { 2.6 } else { 1.8 })
                stroke-dasharray=(DASHES[index % 4]) {}
        }
    };
    document(WIDTH, HEIGHT, name, &content)
}
