//! Errors by roughness and view, as colours.

use maud::html;

use super::number::{percent, tick};
use super::scale::{Law, Scale, rounded};
use super::svg::{FAINT, Frame, WIDTH, at, document, line, small_text, text};
use crate::report::data::ErrorMap;

/// The colour of a share 0…1 of the scale: van der Walt and Smith's viridis (2015), whose lightness grows evenly, also for
/// colour-blind eyes.
pub(super) fn colour(share: f64) -> [u8; 3] {
    colorous::VIRIDIS.eval_continuous(share.clamp(0.0, 1.0)).as_array()
}

fn hex([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Bounds of a common scale for some maps, at most three powers of ten apart: few cells lie beyond, and none counts whose
/// error exceeds the value itself, so that methods which are worth a look can be told apart.
pub(super) fn bounds<'a>(maps: impl Iterator<Item = &'a ErrorMap>) -> [f64; 2] {
    const MOST: f64 = 1.0;
    let mut values: Vec<f64> =
        maps.flat_map(|map| map.values.iter().flatten()).copied().filter(|value| *value > 0.0).collect();
    values.sort_by(f64::total_cmp);
    let Some(last) = values.len().checked_sub(1) else {
        return [1e-3, 1.0];
    };
    let high = rounded(values[last - last / 100].min(MOST), true);
    let low = rounded(values[last / 50].min(high), false);
    [low.max(rounded(1e-3 * high, false)).min(0.5 * high), high]
}

fn share(value: f64, [low, high]: [f64; 2]) -> f64 {
    (value.max(low) / low).ln() / (high / low).ln()
}

/// Where cells begin and end whose middles are given.
fn edges(middles: &[f64]) -> Vec<f64> {
    let between = middles.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let inner: Vec<f64> = between.collect();
    match (middles.first(), middles.last(), inner.first(), inner.last()) {
        (Some(first), Some(last), Some(low), Some(high)) => {
            let ends = [2.0 * first - low, 2.0 * last - high];
            [ends[0]].into_iter().chain(inner).chain([ends[1]]).collect()
        }
        (Some(only), ..) => vec![only - 0.05, only + 0.05],
        _ => Vec::new(),
    }
}

/// Mean and largest error of a map, and roughness and cosine of the latter.
pub(super) fn extremes(map: &ErrorMap) -> (f64, f64, [f64; 2]) {
    let cells = map.values.iter().zip(&map.cosine).flat_map(|(row, cosine)| {
        row.iter().zip(&map.roughness).map(move |(value, roughness)| (*value, [*roughness, *cosine]))
    });
    let cells: Vec<(f64, [f64; 2])> = cells.collect();
    let mean = cells.iter().map(|cell| cell.0).sum::<f64>() / cells.len().max(1) as f64;
    let largest = cells.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, [0.0; 2]));
    (mean, largest.0, largest.1)
}

/// Two decimals.
fn short(value: f64) -> String {
    tick((100.0 * value).round() / 100.0)
}

/// One map.
pub(super) fn draw(map: &ErrorMap, title: &str, bounds: [f64; 2]) -> String {
    const SIDE: f64 = 340.0;
    const HEIGHT: f64 = 320.0;
    let [left, right, top, bottom] = [58.0, SIDE - 14.0, 32.0, HEIGHT - 66.0];
    let (columns, rows) = (edges(&map.roughness), edges(&map.cosine));
    let axis = |edges: &[f64], from: f64, to: f64| {
        let low = edges.iter().copied().fold(f64::INFINITY, f64::min);
        let high = edges.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Scale { from, to, ..Scale::between(low, high, Law::Linear) }
    };
    let frame = Frame { x: axis(&columns, left, right), y: axis(&rows, bottom, top) };
    let wide = (right - left) / columns.len() as f64 > 34.0;
    let (mean, largest, [roughness, cosine]) = extremes(map);
    let cell = |row: usize, column: usize| {
        let value = map.values[row][column];
        let [ax, ay] = frame.place(columns[column], rows[row]);
        let [bx, by] = frame.place(columns[column + 1], rows[row + 1]);
        let shade = share(value, bounds);
        html! {
            rect class="point" x=(at(ax.min(bx))) y=(at(ay.min(by))) width=(at((bx - ax).abs())) height=(at((by - ay).abs())) fill=(hex(colour(shade))) {
                title { "roughness " (short(map.roughness[column])) ", cosine " (short(map.cosine[row])) ": " (percent(value)) }
            }
            @if wide {
                (small_text(0.5 * (ax + bx), 0.5 * (ay + by) + 4.0, "middle", if shade > 0.6 { "#000" } else { "#fff" }, &percent(value)))
            }
        }
    };
    let content = html! {
        (frame.axes("roughness", "cosine between normal and view", 1.0))
        (text(left, 20.0, "start", title))
        g shape-rendering="crispEdges" {
            @for row in 0..map.cosine.len() { @for column in 0..map.roughness.len() { (cell(row, column)) } }
        }
        (small_text(left, HEIGHT - 10.0, "start", FAINT, &format!("mean {}, largest {} at ({}, {})", percent(mean), percent(largest), short(roughness), short(cosine))))
    };
    document(SIDE, HEIGHT, title, &content)
}

/// The key to the colours of maps with the same bounds.
pub(super) fn key([low, high]: [f64; 2], title: &str) -> String {
    bar(Scale::between(low, high, Law::Logarithmic), title, 100.0, &colour)
}

/// The key to colours: the values of a scale, whose ends are set here; numbers are multiplied by `factor`.
pub(super) fn bar(scale: Scale, title: &str, factor: f64, colour: &dyn Fn(f64) -> [u8; 3]) -> String {
    const HEIGHT: f64 = 66.0;
    const STEPS: usize = 128;
    let x = Scale { from: 24.0, to: WIDTH - 32.0, ..scale };
    let step = (x.to - x.from) / STEPS as f64;
    let content = html! {
        (text(x.from, 16.0, "start", title))
        g shape-rendering="crispEdges" {
            @for index in 0..STEPS {
                rect x=(at(x.from + step * index as f64)) y="24" width=(at(step + 0.5)) height="16"
                    fill=(hex(colour((index as f64 + 0.5) / STEPS as f64))) {}
            }
        }
        @for value in x.ticks() {
            (line([x.place(value), 40.0, x.place(value), 45.0], FAINT, 1.0))
            (small_text(x.place(value), 59.0, "middle", FAINT, &tick(factor * value)))
        }
    };
    document(WIDTH, HEIGHT, title, &content)
}
