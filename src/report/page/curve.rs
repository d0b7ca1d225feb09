//! How costs grow: lines over numbers, bars over names.

use maud::html;

use super::label::spread;
use super::number::figure;
use super::scale::Scale;
use super::svg::{
    COLOURS, FAINT, FONT, Frame, GRID, KEY_LINE, Look, WIDTH, at, document, key, key_box, line, path,
    small_text, text, text_width, upright,
};
use crate::report::data::{GrowthCurve, Report};

/// Most of the width that labels behind the lines may take.
const LABELS: f64 = 200.0;

/// The look of a curve, that of its method where it has one.
fn look(report: &Report, curve: &GrowthCurve, index: usize) -> Look {
    let method = report.methods.iter().position(|method| method.name == curve.method);
    Look::of(method.unwrap_or(index))
}

fn label(report: &Report, curve: &GrowthCurve) -> String {
    let method = report.methods.iter().find(|method| method.name == curve.method);
    method.map_or_else(|| curve.method.clone(), |method| method.label.clone())
}

/// One chart of curves with the same axes; `title` stands above.
pub(super) fn draw(report: &Report, curves: &[&GrowthCurve], title: &str) -> String {
    if curves.iter().all(|curve| curve.names.is_empty()) {
        lines(report, curves, title)
    } else {
        bars(report, curves, title)
    }
}

fn lines(report: &Report, curves: &[&GrowthCurve], title: &str) -> String {
    const HEIGHT: f64 = 380.0;
    let labels: Vec<String> = curves.iter().map(|curve| label(report, curve)).collect();
    let room = labels.iter().map(|label| text_width(label, FONT)).fold(0.0, f64::max).min(LABELS);
    let [left, right, top, bottom] = [66.0, WIDTH - room - 24.0, 38.0, HEIGHT - 48.0];
    let x = Scale::logarithmic(curves.iter().flat_map(|curve| curve.x.iter().copied()), left, right);
    let y = Scale::logarithmic(curves.iter().flat_map(|curve| curve.y.iter().copied()), bottom, top);
    let frame = Frame { x, y };
    let shown = |curve: &GrowthCurve| -> Vec<[f64; 2]> {
        let pairs = curve.x.iter().zip(&curve.y).map(|(x, y)| [*x, *y]);
        pairs.filter(|pair| pair.iter().all(|value| *value > 0.0)).collect()
    };
    let ends: Vec<[f64; 2]> = curves
        .iter()
        .map(|curve| shown(curve).last().map_or([left, bottom], |[x, y]| frame.place(*x, *y)))
        .collect();
    let heights: Vec<f64> = ends.iter().map(|end| end[1]).collect();
    let places = spread(&heights, FONT + 2.0, top, bottom);
    let content = html! {
        (frame.axes(&curves[0].x_label, &curves[0].y_label, 1.0))
        (text(14.0, 20.0, "start", title))
        @for (index, curve) in curves.iter().enumerate() {
            @let look = look(report, curve, index);
            @let dash = if index >= COLOURS.len() { "5 3" } else { "none" };
            path d=(path(shown(curve).into_iter().map(|[x, y]| frame.place(x, y)))) fill="none" stroke=(look.colour)
                stroke-width="1.8" stroke-dasharray=(dash) {}
            @for [x, y] in shown(curve) {
                @let [across, down] = frame.place(x, y);
                g class="point" tabindex="0" {
                    title { (labels[index]) "\n" (curve.x_label) ": " (figure(x)) "\n" (curve.y_label) ": " (figure(y)) }
                    circle cx=(at(across)) cy=(at(down)) r="9" fill="transparent" {}
                    (look.marker(across, down, 4.0, false))
                }
            }
            @let start = right + 18.0;
            (line([ends[index][0] + 6.0, ends[index][1], start - 3.0, places[index]], "#aaa", 0.8))
            text class="label" x=(at(start)) y=(at(places[index] + 4.5)) { (labels[index]) }
        }
    };
    document(WIDTH, HEIGHT, title, &content)
}

/// Horizontal bars, a group for each name, a bar in it for each curve.
fn bars(report: &Report, curves: &[&GrowthCurve], title: &str) -> String {
    let mut names: Vec<String> = Vec::new();
    for (curve, index) in curves.iter().flat_map(|curve| (0..curve.y.len()).map(move |index| (curve, index)))
    {
        let name = point_name(curve, index);
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let thick = if curves.len() == 1 { 16.0 } else { 12.0 };
    let group = thick * curves.len() as f64 + 8.0;
    let labels: Vec<String> = curves.iter().map(|curve| label(report, curve)).collect();
    let entries: Vec<&str> = labels.iter().map(String::as_str).filter(|_| curves.len() > 1).collect();
    let (key, lines) = key(&entries, [12.0, WIDTH - 8.0, 42.0], 17.0, &|index, x, y| {
        key_box(look(report, curves[index], index).colour, x, y)
    });
    let top = 34.0 + KEY_LINE * lines;
    let bottom = top + group * names.len() as f64;
    let room = names.iter().map(|name| text_width(name, FONT)).fold(0.0, f64::max).min(240.0);
    let [left, right] = [room + 34.0, WIDTH - 66.0];
    let x = Scale::linear(curves.iter().flat_map(|curve| curve.y.iter().copied()), left, right);
    let zero = x.place(0.0);
    // Numbers that would touch are left out.
    let ticks = x.ticks();
    let widest = ticks.iter().map(|value| text_width(&super::number::tick(*value), FONT)).fold(0.0, f64::max);
    let apart = (right - left) / ticks.len().saturating_sub(1).max(1) as f64;
    let stride = ((widest + 6.0) / apart).ceil().max(1.0) as usize;
    let content = html! {
        (text(12.0, 20.0, "start", title))
        (key)
        @for (index, value) in ticks.iter().enumerate() {
            (line([x.place(*value), top, x.place(*value), bottom], GRID, 1.0))
            @if index % stride == 0 {
                (small_text(x.place(*value), bottom + 16.0, "middle", FAINT, &super::number::tick(*value)))
            }
        }
        @for (row, name) in names.iter().enumerate() {
            @let start = top + group * row as f64;
            (text(left - 8.0, start + 0.5 * group + 4.5, "end", name))
            @for (index, curve) in curves.iter().enumerate() {
                @if let Some(value) = (0..curve.y.len()).find(|at| point_name(curve, *at) == *name).map(|at| curve.y[at]) {
                    @let (end, y) = (x.place(value), start + 4.0 + thick * index as f64);
                    g class="point" tabindex="0" {
                        title { (labels[index]) "\n" (name) "\n" (curve.y_label) ": " (figure(value)) }
                        rect x=(at(zero.min(end))) y=(at(y)) width=(at((end - zero).abs())) height=(at(thick - 1.5))
                            fill=(look(report, curve, index).colour) {}
                    }
                    (small_text(zero.max(end) + 4.0, y + thick - 3.0, "start", FAINT, &figure(value)))
                }
            }
        }
        (line([zero, top, zero, bottom], FAINT, 1.0))
        (text(0.5 * (left + right), bottom + 36.0, "middle", &curves[0].y_label))
        (upright(15.0, 0.5 * (top + bottom), &curves[0].x_label))
    };
    document(WIDTH, bottom + 46.0, title, &content)
}

fn point_name(curve: &GrowthCurve, index: usize) -> String {
    curve.names.get(index).cloned().unwrap_or_else(|| figure(curve.x[index]))
}
