//! Where errors come from: stacked bars, and each cause alone.

use maud::html;

use super::number::percent;
use super::scale::Scale;
use super::svg::{
    COLOURS, FAINT, FONT, GRID, INK, KEY_LINE, Look, WIDTH, at, document, key, key_box, line, path,
    small_text, text, text_width,
};
use crate::report::data::{BudgetRow, Part, Report};

/// Colours of causes: no two neighbours look alike to colour-blind eyes.
const STACK: [&str; 7] = [COLOURS[0], COLOURS[4], COLOURS[5], COLOURS[1], COLOURS[2], COLOURS[6], COLOURS[3]];
/// The row that is measured on its own.
pub(super) const TOTAL: &str = "total";

/// The rows of a part, for each method in the order of the report.
fn by_method(report: &Report, part: Part) -> Vec<(usize, Vec<&BudgetRow>)> {
    let methods = report.methods.iter().enumerate().map(|(index, method)| {
        let rows = report.budget.iter().filter(|row| row.method == method.name && row.part == part);
        (index, rows.collect::<Vec<_>>())
    });
    methods.filter(|(_, rows)| !rows.is_empty()).collect()
}

/// Shares below this are drawn at it.
const LEAST: f64 = 1e-8;

/// Causes other than the total, in the order in which the method with the most of them adds them.
fn all_causes(report: &Report) -> Vec<&str> {
    let mut methods: Vec<_> = Part::ALL.into_iter().flat_map(|part| by_method(report, part)).collect();
    methods.sort_by_key(|(_, rows)| core::cmp::Reverse(rows.len()));
    let mut causes = Vec::new();
    for row in methods.into_iter().flat_map(|(_, rows)| rows) {
        if row.cause != TOTAL && !causes.contains(&row.cause.as_str()) {
            causes.push(&row.cause);
        }
    }
    causes
}

/// Those that make a difference to a part.
fn causes(report: &Report, part: Part) -> Vec<&str> {
    let counts = |row: &&BudgetRow| row.part == part && (row.alone > 0.0 || row.added != 0.0);
    let mut causes = all_causes(report);
    causes.retain(|cause| report.budget.iter().filter(counts).any(|row| row.cause == *cause));
    causes
}

/// What each cause adds, stacked, with a mark at the total.
pub(super) fn stacked(report: &Report, part: Part) -> String {
    const BAR: f64 = 30.0;
    let methods = by_method(report, part);
    let causes = causes(report, part);
    // A cause has one colour on all charts.
    let all = all_causes(report);
    let colour = |cause: &str| STACK[all.iter().position(|known| *known == cause).unwrap_or(0) % STACK.len()];
    let (key, lines) =
        key(&causes, [12.0, WIDTH - 8.0, 44.0], 17.0, &|index, x, y| key_box(colour(causes[index]), x, y));
    let top = 42.0 + KEY_LINE * lines;
    let bottom = top + BAR * methods.len() as f64;
    let label = |index: usize| report.methods[index].label.as_str();
    let room = methods.iter().map(|(index, _)| text_width(label(*index), FONT)).fold(0.0, f64::max);
    let [left, right] = [room.min(200.0) + 20.0, WIDTH - 76.0];
    let sum = |rows: &[&BudgetRow], sign: f64| {
        rows.iter().filter(|row| row.cause != TOTAL).map(|row| (sign * row.added).max(0.0)).sum::<f64>()
    };
    let total = |rows: &[&BudgetRow]| rows.iter().find(|row| row.cause == TOTAL).map(|row| row.alone);
    let extents = methods
        .iter()
        .flat_map(|(_, rows)| [sum(rows, 1.0), -sum(rows, -1.0), total(rows).unwrap_or(0.0)])
        .collect::<Vec<_>>();
    // A sliver on the other side of zero needs no axis of its own.
    let most = extents.iter().copied().fold(0.0, f64::max);
    let axis: Vec<f64> = extents.into_iter().filter(|extent| !(-0.03 * most..0.0).contains(extent)).collect();
    let x = Scale::linear(axis.iter().copied(), left, right);
    let title = format!("Where the error comes from: {}", part.name());
    let content = html! {
        (text(12.0, 20.0, "start", &title))
        (key)
        @for value in x.ticks() {
            (line([x.place(value), top, x.place(value), bottom], GRID, 1.0))
            (small_text(x.place(value), bottom + 16.0, "middle", FAINT, &super::number::tick(100.0 * value)))
        }
        @for (index, (method, rows)) in methods.iter().enumerate() {
            @let y = top + BAR * index as f64 + 5.0;
            (text(left - 8.0, y + 15.0, "end", label(*method)))
            @for (from, to, row) in segments(rows) {
                @let (start, end) = (x.place(from).min(x.place(to)), x.place(from).max(x.place(to)));
                g class="point" tabindex="0" {
                    title { (label(*method)) "\n" (row.cause) ": adds " (percent(row.added)) ", alone " (percent(row.alone)) }
                    rect x=(at(start)) y=(at(y)) width=(at(end - start)) height="20" fill=(colour(&row.cause)) stroke="#fff"
                        stroke-width=(if end - start > 3.0 { "1" } else { "0" }) {}
                }
            }
            @if let Some(total) = total(rows) {
                @let mark = x.place(total);
                path d=(path([[mark, y - 3.0], [mark, y + 23.0]])) stroke="#fff" stroke-width="5" {}
                path d=(path([[mark, y - 3.0], [mark, y + 23.0]])) stroke=(INK) stroke-width="2.4" {}
                (small_text((x.place(sum(rows, 1.0)) + 6.0).max(mark + 6.0), y + 14.5, "start", INK, &percent(total)))
            }
        }
        (line([x.place(0.0), top, x.place(0.0), bottom], FAINT, 1.0))
        (text(0.5 * (left + right), bottom + 36.0, "middle", "share of the mean |error| / mean value (%); upright mark: total"))
    };
    document(WIDTH, bottom + 46.0, &title, &content)
}

/// Beginning and end of each cause's part of a bar; what takes away goes to the left of zero.
fn segments<'a>(rows: &[&'a BudgetRow]) -> Vec<(f64, f64, &'a BudgetRow)> {
    let (mut above, mut below) = (0.0, 0.0);
    let mut segments = Vec::new();
    for row in rows.iter().filter(|row| row.cause != TOTAL) {
        let start = if row.added < 0.0 { &mut below } else { &mut above };
        segments.push((*start, *start + row.added, *row));
        *start += row.added;
    }
    segments
}

/// Each cause alone, on a logarithmic axis, because causes span many powers of ten.
pub(super) fn alone(report: &Report, part: Part) -> String {
    let methods = by_method(report, part);
    let causes: Vec<&str> = causes(report, part).into_iter().chain([TOTAL]).collect();
    let room = causes.iter().map(|cause| text_width(cause, FONT)).fold(0.0, f64::max);
    let [left, right] = [room + 24.0, WIDTH - 16.0];
    let labels: Vec<&str> =
        methods.iter().map(|(method, _)| report.methods[*method].label.as_str()).collect();
    let (key, lines) = key(&labels, [14.0, WIDTH - 8.0, 42.0], 16.0, &|index, x, y| {
        Look::of(methods[index].0).marker(x + 5.0, y - 4.5, 4.5, false)
    });
    let top = 40.0 + KEY_LINE * lines;
    // A lane for each method, so that equal values do not hide each other.
    let lane = (40.0 / methods.len().max(1) as f64).clamp(5.0, 9.0);
    let row_height = lane * methods.len() as f64 + 10.0;
    let bottom = top + row_height * causes.len() as f64;
    let values = methods.iter().flat_map(|(_, rows)| {
        rows.iter().map(|row| if row.alone > 0.0 { row.alone.max(LEAST) } else { 0.0 })
    });
    let x = Scale::logarithmic(values, left, right);
    let title = format!("Each cause alone: {}", part.name());
    let content = html! {
        (text(12.0, 20.0, "start", &title))
        (key)
        @for index in (0..causes.len()).step_by(2) {
            rect x=(at(left)) y=(at(top + row_height * index as f64)) width=(at(right - left)) height=(at(row_height)) fill="#f6f6f6" {}
        }
        @for value in x.ticks() {
            (line([x.place(value), top, x.place(value), bottom], GRID, 1.0))
            (small_text(x.place(value), bottom + 16.0, "middle", FAINT, &super::number::tick(100.0 * value)))
        }
        @for (index, cause) in causes.iter().enumerate() {
            @let start = top + row_height * index as f64;
            (text(left - 8.0, start + 0.5 * row_height + 4.5, "end", cause))
            @for (rank, (method, rows)) in methods.iter().enumerate() {
                @for row in rows.iter().filter(|row| row.cause == *cause && row.alone > 0.0) {
                    g class="point" tabindex="0" {
                        title { (report.methods[*method].label) "\n" (cause) " alone: " (percent(row.alone)) }
                        (Look::of(*method).marker(x.place(row.alone.max(LEAST)), start + 5.0 + lane * (rank as f64 + 0.5), 4.0, false))
                    }
                }
            }
        }
        (line([left, bottom, right, bottom], FAINT, 1.0))
        (text(0.5 * (left + right), bottom + 36.0, "middle", "mean |difference| / mean value (%)"))
    };
    document(WIDTH, bottom + 46.0, &title, &content)
}
