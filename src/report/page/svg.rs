//! Parts of charts: texts, markers, colours, axes.
//!
//! Charts are written directly as SVG because each point needs its own hover text, a marker that colour-blind readers tell
//! apart, and a label whose size is known before it is drawn.

use maud::{Markup, html};

use super::number::tick;
use super::scale::Scale;

/// Colours of Okabe and Ito (2008) that stand out on white: told apart with any colour vision.
pub(super) const COLOURS: [&str; 7] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];
/// Of texts.
pub(super) const INK: &str = "#222";
/// Of axes and what stands behind.
pub(super) const FAINT: &str = "#666";
/// Of grid lines.
pub(super) const GRID: &str = "#e4e4e4";
/// Width of a chart: on a page of two columns its texts are a little larger than on paper, on a phone still legible.
pub(super) const WIDTH: f64 = 480.0;
/// Size of texts.
pub(super) const FONT: f64 = 13.0;

/// A chart as an SVG document that stands alone. `name` is what it shows, for those who do not see it.
pub(super) fn document(width: f64, height: f64, name: &str, content: &Markup) -> String {
    html! {
        svg xmlns="http://www.w3.org/2000/svg" viewBox=(format!("0 0 {width} {height}"))
            width=(width) height=(height) role="img" aria-label=(name)
            font-family="Arial, Helvetica, 'Liberation Sans', sans-serif" font-size=(FONT) fill=(INK)
        {
            rect width=(width) height=(height) fill="#fff" {}
            (content)
        }
    }
    .into_string()
}

/// A length with one decimal.
pub(super) fn at(length: f64) -> String {
    let text = format!("{length:.1}");
    text.strip_suffix(".0").map_or_else(|| text.clone(), str::to_owned)
}

/// Width of a text in Arial and the fonts of its widths, rounded up.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    let letter = |letter: char| match letter {
        'i' | 'j' | 'l' | '\'' | '|' => 0.24,
        'f' | 't' | 'I' | ' ' | '.' | ',' | ':' | ';' | '/' | '!' | '·' => 0.29,
        '(' | ')' | '-' | 'r' | '\u{202f}' => 0.34,
        'c' | 'k' | 's' | 'v' | 'x' | 'y' | 'z' | 'J' => 0.51,
        'm' | 'M' | '%' => 0.89,
        'w' | 'A'..='H' | 'K'..='L' | 'N'..='V' | 'X'..='Z' | '&' => 0.76,
        'W' | '@' | '—' | '…' => 1.01,
        _ => 0.59,
    };
    size * text.chars().map(letter).sum::<f64>()
}

/// A text whose baseline starts, ends or is centred (`start`, `end`, `middle`) at a place.
pub(super) fn text(x: f64, y: f64, anchor: &str, content: &str) -> Markup {
    html! { text x=(at(x)) y=(at(y)) text-anchor=(anchor) { (content) } }
}

/// A text of another size and colour.
pub(super) fn small_text(x: f64, y: f64, anchor: &str, colour: &str, content: &str) -> Markup {
    html! { text x=(at(x)) y=(at(y)) text-anchor=(anchor) font-size=(FONT - 1.5) fill=(colour) { (content) } }
}

/// A straight line.
pub(super) fn line([ax, ay, bx, by]: [f64; 4], colour: &str, width: f64) -> Markup {
    html! {
        path d=(format!("M{} {}L{} {}", at(ax), at(ay), at(bx), at(by))) stroke=(colour) stroke-width=(width) fill="none" {}
    }
}

/// The points of a line as the attribute of a path.
pub(super) fn path(points: impl IntoIterator<Item = [f64; 2]>) -> String {
    let mut path = String::new();
    for [x, y] in points {
        path += &format!("{}{} {}", if path.is_empty() { 'M' } else { 'L' }, at(x), at(y));
    }
    path
}

/// Where pieces of the given widths begin when they are set in lines between two sides, and in which line.
pub(super) fn flow(widths: &[f64], left: f64, right: f64) -> Vec<(f64, usize)> {
    let (mut x, mut line) = (left, 0);
    let place = |width: &f64| {
        if x + width > right && x > left {
            (x, line) = (left, line + 1);
        }
        x += width;
        (x - width, line)
    };
    widths.iter().map(place).collect()
}

/// Distance of the lines of a key.
pub(super) const KEY_LINE: f64 = 18.0;

/// A key in lines between two sides, the first with its baseline at `top`; `mark` draws what stands for an entry, `room` wide,
/// on a baseline. Returns how many lines there are, too.
pub(super) fn key(
    names: &[&str],
    [left, right, top]: [f64; 3],
    room: f64,
    mark: &dyn Fn(usize, f64, f64) -> Markup,
) -> (Markup, f64) {
    let widths: Vec<f64> = names.iter().map(|name| room + text_width(name, FONT) + 14.0).collect();
    let places = flow(&widths, left, right);
    let lines = places.last().map_or(0, |(_, line)| line + 1);
    let key = html! {
        @for (index, ((x, line), name)) in places.into_iter().zip(names).enumerate() {
            @let y = top + KEY_LINE * line as f64;
            (mark(index, x, y))
            (text(x + room, y, "start", name))
        }
    };
    (key, lines as f64)
}

/// A coloured box for a key.
pub(super) fn key_box(colour: &str, x: f64, y: f64) -> Markup {
    html! { rect x=(at(x)) y=(at(y - 9.5)) width="12" height="10" fill=(colour) {} }
}

/// What a method looks like on every chart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Look {
    /// A colour of [`COLOURS`].
    pub colour: &'static str,
    /// Corners of the marker; none for a circle.
    corners: u32,
    /// Where the first corner is, in turns from the top.
    turn: f64,
    /// Radius of every other corner over that of the marker: 1, or less for a star.
    waist: f64,
}

impl Look {
    /// The look of the method at an index of the list. Colours and shapes repeat at different periods, so that the pairs
    /// do not within 63.
    pub fn of(index: usize) -> Self {
        let (corners, turn, waist) = [
            (0, 0.0, 1.0),
            (4, 0.125, 1.0),
            (3, 0.0, 1.0),
            (4, 0.0, 1.0),
            (3, 0.5, 1.0),
            (5, 0.0, 1.0),
            (10, 0.0, 0.45),
            (3, 0.25, 1.0),
            (8, 0.0, 0.4),
        ][index % 9];
        Self { colour: COLOURS[index % COLOURS.len()], corners, turn, waist }
    }

    /// A circle.
    pub fn circle(colour: &'static str) -> Self {
        Self { colour, ..Self::of(0) }
    }

    /// Draws the marker; hollow ones keep their outline.
    pub fn marker(&self, x: f64, y: f64, radius: f64, hollow: bool) -> Markup {
        let fill = if hollow { "#fff" } else { self.colour };
        if self.corners == 0 {
            return html! {
                circle cx=(at(x)) cy=(at(y)) r=(radius) fill=(fill) stroke=(self.colour) stroke-width="1.8" {}
            };
        }
        let corner = |index: u32| {
            let angle = core::f64::consts::TAU * (self.turn + f64::from(index) / f64::from(self.corners));
            let radius = radius * if index % 2 == 1 { 1.15 * self.waist } else { 1.15 };
            let radius = if self.waist < 1.0 { radius * 1.15 } else { radius };
            [x + radius * angle.sin(), y - radius * angle.cos()]
        };
        html! {
            path d=(format!("{}Z", path((0..self.corners).map(corner)))) fill=(fill) stroke=(self.colour)
                stroke-width="1.8" stroke-linejoin="round" {}
        }
    }
}

/// The part of a chart that two axes span.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// From left to right.
    pub x: Scale,
    /// From bottom to top.
    pub y: Scale,
}

impl Frame {
    /// Left, right, top and bottom.
    pub fn edges(&self) -> [f64; 4] {
        [self.x.from, self.x.to, self.y.to, self.y.from]
    }

    /// The place of a pair of values.
    pub fn place(&self, x: f64, y: f64) -> [f64; 2] {
        [self.x.place(x), self.y.place(y)]
    }

    /// Grid lines, numbers and names of both axes; numbers of the vertical one are multiplied by `factor`.
    pub fn axes(&self, x_name: &str, y_name: &str, factor: f64) -> Markup {
        let [left, right, top, bottom] = self.edges();
        let grid = |ticks: &[f64], vertical: bool| {
            let lines = ticks.iter().map(|value| {
                if vertical {
                    let x = self.x.place(*value);
                    path([[x, top], [x, bottom]])
                } else {
                    let y = self.y.place(*value);
                    path([[left, y], [right, y]])
                }
            });
            html! { path d=(lines.collect::<String>()) stroke=(GRID) {} }
        };
        let (x_ticks, y_ticks) = (self.x.ticks(), self.y.ticks());
        html! {
            (grid(&x_ticks, true)) (grid(&y_ticks, false))
            @for value in x_ticks { (small_text(self.x.place(value), bottom + 17.0, "middle", FAINT, &tick(value))) }
            @for value in y_ticks {
                (small_text(left - 6.0, self.y.place(value) + 4.0, "end", FAINT, &tick(factor * value)))
            }
            path d=(path([[left, top], [left, bottom], [right, bottom]])) stroke=(FAINT) fill="none" {}
            (text(0.5 * (left + right), bottom + 37.0, "middle", x_name))
            (upright(15.0, 0.5 * (top + bottom), y_name))
        }
    }
}

/// The name of a vertical axis.
pub(super) fn upright(x: f64, y: f64, content: &str) -> Markup {
    html! {
        text transform=(format!("translate({} {})rotate(-90)", at(x), at(y))) text-anchor="middle" { (content) }
    }
}
