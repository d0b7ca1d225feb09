//! Error against cost.

use maud::{Markup, html};

use super::frontier::frontier;
use super::label::{Anchor, Bounds, place};
use super::measure::{Measure, measures};
use super::number::{figure, percent, signed_percent};
use super::scale::Scale;
use super::svg::{FAINT, FONT, Frame, KEY_LINE, Look, WIDTH, document, key, line, path, text, text_width};
use crate::report::data::{CostRow, ErrorRow, Kind, Part, Report};

/// One method on a chart of error against cost.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Point<'a> {
    /// Index of the method.
    pub method: usize,
    pub cost: &'a CostRow,
    pub error: &'a ErrorRow,
    /// Whether no other method is both cheaper and closer.
    pub best: bool,
}

/// Mean errors that are drawn: below the first only roundings are compared; beyond the last a method is of no use, and
/// the rest would be squeezed together.
const DRAWN: [f64; 2] = [1e-5, 1.0];

/// A mean error as it is drawn and compared.
fn drawn(error: &ErrorRow) -> f64 {
    error.mean.clamp(DRAWN[0], DRAWN[1])
}

/// The methods that have both a cost of a kind and an error, above zero each, in the order of the report.
pub(super) fn points<'a>(report: &'a Report, measure: Measure, part: Part) -> Vec<Point<'a>> {
    let mut points: Vec<Point> = report
        .methods
        .iter()
        .enumerate()
        .filter_map(|(method, info)| {
            let cost = report.costs.iter().find(|row| {
                row.method == info.name && row.measure == measure.measure && row.stage == measure.stage
            })?;
            let error = whole_error(report, &info.name, part)?;
            let shown = cost.ratio > 0.0 && error.mean > 0.0;
            shown.then_some(Point { method, cost, error, best: false })
        })
        .collect();
    let pairs: Vec<[f64; 2]> =
        points.iter().map(|point| [point.cost.ratio, point.error.mean.max(DRAWN[0])]).collect();
    for index in frontier(&pairs) {
        points[index].best = true;
    }
    points
}

/// The error of a method over all inputs.
pub(super) fn whole_error<'a>(report: &'a Report, method: &str, part: Part) -> Option<&'a ErrorRow> {
    report.errors.iter().find(|row| row.method == method && row.part == part && row.stratum == "all")
}

/// The chart of error against cost of a measure, named as in [`CostRow`] (then in the first stage that has it) or as
/// `measure, stage`, as an SVG document that stands alone; none where no method has both figures.
pub fn chart_svg(report: &Report, measure: &str, part: Part) -> Option<String> {
    let known = measures(report);
    let found = known.iter().find(|known| known.name() == measure || known.measure == measure)?;
    let points = points(report, *found, part);
    (!points.is_empty()).then(|| draw(report, *found, part, &points))
}

pub(super) fn draw(report: &Report, measure: Measure, part: Part, points: &[Point]) -> String {
    const HEIGHT: f64 = 420.0;
    let costs = points.iter().map(|point| point.cost.ratio);
    let errors = points.iter().map(|point| drawn(point.error));
    let (legend, lines) = legend();
    let [left, right, top, bottom] = [58.0, WIDTH - 12.0, 38.0 + KEY_LINE * lines, HEIGHT - 48.0];
    // Both axes show ratios as lengths: twice as dear is as far everywhere.
    // On the left and above there is room for the labels of cheap and of bad methods.
    let cheapest = costs.clone().fold(1.0, f64::min);
    let x = Scale::logarithmic(costs.chain([1.0, 0.7 * cheapest]), left, right);
    let worst = errors.clone().fold(0.0, f64::max);
    let y = Scale::logarithmic(errors.chain([1.6 * worst]), bottom, top);
    let frame = Frame { x, y };
    let steps = steps(&frame, points);
    let label = |point: &Point| report.methods[point.method].label.clone();
    // What lies beyond the edge says how far.
    let beyond = |point: &Point| {
        if point.error.mean > DRAWN[1] {
            format!(" ↑ {}", percent(point.error.mean))
        } else {
            String::new()
        }
    };
    let anchors: Vec<Anchor> = points
        .iter()
        .map(|point| {
            let [x, y] = frame.place(point.cost.ratio, drawn(point.error));
            Anchor {
                x,
                y,
                radius: 7.5,
                width: text_width(&(label(point) + &beyond(point)), FONT) + 2.0,
                height: FONT + 2.0,
            }
        })
        .collect();
    let lines: Vec<[f64; 4]> =
        steps.windows(2).map(|pair| [pair[0][0], pair[0][1], pair[1][0], pair[1][1]]).collect();
    let area = Bounds { left: left + 2.0, top: top + 1.0, right: right - 1.0, bottom: bottom - 2.0 };
    let labels = place(&anchors, area, &lines);
    let one = x.place(1.0);
    let name = format!("Error against cost: {}, {}", part.name(), measure.said());
    // Those of the frontier lie above the others.
    let mut marked: Vec<(&Point, &Anchor)> = points.iter().zip(&anchors).collect();
    marked.sort_by_key(|(point, _)| point.best);
    let content = html! {
        (frame.axes(&format!("{} / published method (×)", measure.said()), "mean |error| / mean value (%)", 100.0))
        (line([one, top, one, bottom], "#bbb", 1.2))
        (text(14.0, 20.0, "start", &format!("Error against cost: {}", part.name())))
        (legend)
        (frontier_line(&path(steps)))
        @for label in &labels {
            @if let Some(leader) = label.leader { (line(leader, FAINT, 0.8)) }
        }
        @for (point, anchor) in marked {
            g class="point" tabindex="0" {
                title { (hover(&label(point), point, part)) }
                circle cx=(anchor.x) cy=(anchor.y) r="14" fill="transparent" {}
                (Look::of(point.method).marker(anchor.x, anchor.y, 6.0, !point.best))
            }
        }
        @for (point, placed) in points.iter().zip(&labels) {
            @let bounds = placed.bounds;
            g font-weight=(if report.methods[point.method].kind == Kind::Level { "bold" } else { "normal" }) {
                text class="label" x=(super::svg::at(0.5 * (bounds.left + bounds.right))) y=(super::svg::at(bounds.bottom - 4.0))
                    text-anchor="middle" stroke="#fff" stroke-width="2.5" paint-order="stroke" {
                        (label(point))
                        @if point.error.mean > DRAWN[1] { tspan font-weight="normal" { (beyond(point)) } }
                    }
            }
        }
    };
    document(WIDTH, HEIGHT, &name, &content)
}

/// The boundary of what can be had: for each cost the least error of the methods that cost no more.
fn steps(frame: &Frame, points: &[Point]) -> Vec<[f64; 2]> {
    let mut best: Vec<[f64; 2]> = points
        .iter()
        .filter(|point| point.best)
        .map(|point| [point.cost.ratio, drawn(point.error)])
        .collect();
    best.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut steps = Vec::new();
    let [_, right, top, _] = frame.edges();
    for (index, [cost, error]) in best.iter().enumerate() {
        let [x, y] = frame.place(*cost, *error);
        let above = if index == 0 { top } else { frame.y.place(best[index - 1][1]) };
        steps.extend([[x, above], [x, y]]);
    }
    steps.extend(steps.last().map(|last| [right, last[1]]));
    steps
}

/// What filled and hollow markers and the line mean.
fn legend() -> (Markup, f64) {
    let look = Look::circle(FAINT);
    let names = ["on the frontier", "another is cheaper and closer", "least error for a cost"];
    key(&names, [14.0, WIDTH - 6.0, 42.0], 32.0, &|index, x, y| match index {
        2 => frontier_line(&path([[x + 3.0, y - 4.5], [x + 27.0, y - 4.5]])),
        _ => look.marker(x + 16.0, y - 4.5, 5.0, index == 1),
    })
}

fn frontier_line(path: &str) -> Markup {
    html! { path d=(path) fill="none" stroke="#888" stroke-width="2" stroke-dasharray="6 3" {} }
}

fn hover(label: &str, point: &Point, part: Part) -> String {
    let Point { cost, error, best, .. } = point;
    format!(
        "{label}\n{}: mean error {}, 99th percentile {}, largest {}, bias {}\n{} {} ({} × published)\n{}",
        part.name(),
        percent(error.mean),
        percent(error.percentile),
        percent(error.maximum),
        signed_percent(error.bias),
        figure(cost.value),
        cost.unit,
        figure(cost.ratio),
        if *best { "on the frontier" } else { "another method is cheaper and closer" },
    )
}
