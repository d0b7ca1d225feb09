//! Many small charts with the same vertical axis: errors on the way to a limit, both on logarithmic axes.

use maud::{Markup, html};

use super::number::tick;
use super::scale::{Law, Scale};
use super::svg::{FAINT, FONT, GRID, at, document, flow, path, text, text_width};

/// What a line stands for in every chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Its name in the key.
    pub name: String,
    /// Its colour.
    pub colour: &'static str,
    /// Its width.
    pub width: f64,
}

/// A line of one chart.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorLine {
    /// The series that it belongs to.
    pub series: usize,
    /// Parameters and errors; what is not positive lies at the lower edge.
    pub points: Vec<[f64; 2]>,
    /// Parameters at which values are not finite, with the share of those that are not.
    pub not_finite: Vec<[f64; 2]>,
}

/// One chart.
#[derive(Clone, Debug, PartialEq)]
pub struct SmallChart {
    /// What happens along it.
    pub title: String,
    /// The name of its horizontal axis.
    pub parameter: String,
    /// What its vertical axis measures, in brackets behind the name.
    pub measure: String,
    /// The values at its left and its right end.
    pub ends: [f64; 2],
    /// The lines, those in front last.
    pub lines: Vec<ErrorLine>,
    /// What the error may be at most: parameters and errors.
    pub bound: Vec<[f64; 2]>,
}

/// The errors that the vertical axis spans. What is larger is drawn at its upper end.
pub const ERROR_AXIS: [f64; 2] = [1e-9, 10.0];

const HEAD: f64 = 34.0;
const FOOT: f64 = 34.0;
const LEFT: f64 = 33.0;
const RIGHT: f64 = 9.0;
const SMALL: f64 = 10.5;

/// Charts in rows of `columns`, each of a size in pixels, under a title and a key.
pub fn small_charts(
    title: &str,
    charts: &[SmallChart],
    series: &[Series],
    columns: usize,
    [width, height]: [f64; 2],
) -> String {
    let whole = width * columns as f64;
    let used = |index: usize| charts.iter().any(|chart| chart.lines.iter().any(|line| line.series == index));
    let shown: Vec<&Series> =
        (0..series.len()).filter(|index| used(*index)).map(|index| &series[index]).collect();
    let any_bound = charts.iter().any(|chart| !chart.bound.is_empty());
    let any_mark = charts.iter().any(|chart| chart.lines.iter().any(|line| !line.not_finite.is_empty()));
    let mut names: Vec<&str> = shown.iter().map(|series| series.name.as_str()).collect();
    names.extend(any_bound.then_some("bound of Softbox's exact levels"));
    names.extend(any_mark.then_some("infinite or not a number"));
    // A reader without these fonts gets wider ones.
    let widths: Vec<f64> =
        names.iter().map(|name| 30.0 + 1.2 * text_width(name, FONT - 1.0) + 12.0).collect();
    let places = flow(&widths, 12.0, whole - 6.0);
    let lines = places.last().map_or(0, |(_, line)| line + 1);
    let top = 32.0 + 18.0 * lines as f64;
    let rows = charts.len().div_ceil(columns);
    let content = html! {
        g font-weight="bold" { (text(12.0, 19.0, "start", title)) }
        @for (index, ((x, line), name)) in places.iter().zip(&names).enumerate() {
            @let y = 38.0 + 18.0 * *line as f64;
            @if let Some(series) = shown.get(index) {
                (stroke(&path([[*x, y - 4.0], [x + 24.0, y - 4.0]]), series.colour, series.width, "none"))
            } @else if *name == "infinite or not a number" {
                (cross(x + 12.0, y - 4.0, "#222", 1.0))
            } @else {
                (stroke(&path([[*x, y - 4.0], [x + 24.0, y - 4.0]]), FAINT, 1.0, "4 3"))
            }
            text x=(at(x + 30.0)) y=(at(y)) font-size=(FONT - 1.0) { (name) }
        }
        @for (index, chart) in charts.iter().enumerate() {
            g transform=(format!("translate({} {})", at(width * (index % columns) as f64),
                at(top + height * (index / columns) as f64))) {
                (draw(chart, series, [width, height]))
            }
        }
    };
    document(whole, top + height * rows as f64 + 4.0, title, &content)
}

fn draw(chart: &SmallChart, series: &[Series], [width, height]: [f64; 2]) -> Markup {
    let [left, right, top, bottom] = [LEFT, width - RIGHT, HEAD, height - FOOT];
    let [from, to] = chart.ends;
    let reversed = from > to;
    let (low, high) = (from.min(to), from.max(to));
    let (start, end) = if reversed { (right, left) } else { (left, right) };
    let x = Scale { from: start, to: end, ..Scale::between(low, high, Law::Logarithmic) };
    let y = Scale { from: bottom, to: top, ..Scale::between(ERROR_AXIS[0], ERROR_AXIS[1], Law::Logarithmic) };
    let x_ticks: Vec<f64> = decades(low, high, ((high / low).log10() / 4.0).ceil().max(1.0) as i32);
    let y_lines = decades(ERROR_AXIS[0], ERROR_AXIS[1], 1);
    let place = |[parameter, error]: [f64; 2]| {
        [x.place(parameter.clamp(low, high)), y.place(error.clamp(ERROR_AXIS[0], ERROR_AXIS[1]))]
    };
    let grid = y_lines.iter().map(|value| path([[left, y.place(*value)], [right, y.place(*value)]]));
    let upright = x_ticks.iter().map(|value| path([[x.place(*value), top], [x.place(*value), bottom]]));
    html! {
        path d=(grid.chain(upright).collect::<String>()) stroke=(GRID) stroke-width="0.7" {}
        g font-size=(FONT - 1.0) { (text(left - 4.0, 15.0, "start", &chart.title)) }
        g font-size=(SMALL) fill=(FAINT) {
            (text(left - 4.0, 28.0, "start", &chart.measure))
            @for value in decades(ERROR_AXIS[0], ERROR_AXIS[1], 2) {
                (text(left - 4.0, y.place(value) + 3.5, "end", &tick(value)))
            }
            @for value in &x_ticks { (text(x.place(*value).clamp(left + 4.0, right - 8.0), bottom + 13.0, "middle", &tick(*value))) }
            (text(0.5 * (left + right), bottom + 27.0, "middle", &chart.parameter))
        }
        (stroke(&path(chart.bound.iter().map(|point| place(*point))), FAINT, 1.0, "4 3"))
        @for line in &chart.lines {
            @let series = &series[line.series];
            (stroke(&path(line.points.iter().map(|point| place(*point))), series.colour, series.width, "none"))
        }
        @for (row, line) in chart.lines.iter().filter(|line| !line.not_finite.is_empty()).enumerate() {
            @for [parameter, share] in &line.not_finite {
                (cross(x.place(*parameter), top + 4.0 + 6.0 * row as f64, series[line.series].colour, *share))
            }
        }
        path d=(path([[left, top], [left, bottom], [right, bottom]])) stroke=(FAINT) fill="none" stroke-width="0.8" {}
    }
}

/// A mark for values that are not finite; the fewer they are, the smaller.
fn cross(x: f64, y: f64, colour: &str, share: f64) -> Markup {
    let size = 1.2 + 1.3 * share.clamp(0.0, 1.0).sqrt();
    let arms = path([[x - size, y - size], [x + size, y + size]])
        + &path([[x - size, y + size], [x + size, y - size]]);
    stroke(&arms, colour, 1.3, "none")
}

fn stroke(path: &str, colour: &str, width: f64, dash: &str) -> Markup {
    html! {
        path d=(path) fill="none" stroke=(colour) stroke-width=(width) stroke-dasharray=(dash) stroke-linejoin="round" {}
    }
}

/// Powers of ten within a range, every `stride`-th, 1 among them.
fn decades(low: f64, high: f64, stride: i32) -> Vec<f64> {
    let [first, last] = [(low.log10() - 1e-9).ceil() as i32, (high.log10() + 1e-9).floor() as i32];
    (first..=last).filter(|power| power % stride == 0).map(|power| 10_f64.powi(power)).collect()
}
