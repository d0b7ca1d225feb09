//! What the page and the Markdown file have in common: a list of headings, texts, tables, charts and pictures.

use crate::report::data::Origin;

/// A chart.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Figure {
    /// Its file beside the Markdown text.
    pub file: String,
    /// What it shows.
    pub title: String,
    /// An SVG document.
    pub svg: String,
    /// What reproduces it, where that is not said below the whole group.
    pub origin: Option<Origin>,
}

/// A picture of pixels.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Picture {
    /// Its file beside the Markdown text.
    pub file: String,
    /// Lines below it.
    pub caption: Vec<String>,
    /// What the page shows.
    pub png: Vec<u8>,
    /// Width at which it is shown, in pixels.
    pub width: u32,
}

/// A cell of a table.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cell {
    /// What is read; between backticks it is code.
    pub text: String,
    /// The exact figure behind it.
    pub value: Option<f64>,
}

impl Cell {
    pub fn text(text: impl Into<String>) -> Self {
        Self { text: text.into(), value: None }
    }

    pub fn code(text: &str) -> Self {
        Self::text(format!("`{text}`"))
    }

    pub fn number(text: String, value: f64) -> Self {
        Self { text, value: Some(value) }
    }

    pub fn percent(share: f64) -> Self {
        Self::number(super::number::percent(share), share)
    }

    pub fn signed_percent(share: f64) -> Self {
        Self::number(super::number::signed_percent(share), share)
    }

    pub fn figure(value: f64) -> Self {
        Self::number(super::number::figure(value), value)
    }

    pub fn count(value: u64) -> Self {
        Self::number(super::number::count(value), value as f64)
    }

    /// Where there is nothing to say.
    pub fn none() -> Self {
        Self::text("—")
    }
}

/// Lines and columns.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Table {
    /// What it holds.
    pub caption: String,
    /// Names of the columns.
    pub columns: Vec<String>,
    /// Cells of each line.
    pub rows: Vec<Vec<Cell>>,
    /// Whether the page shows it only when asked to.
    pub folded: bool,
}

impl Table {
    pub fn new(caption: &str, columns: &[&str], rows: Vec<Vec<Cell>>) -> Self {
        let columns = columns.iter().map(|column| (*column).to_owned()).collect();
        Self { caption: caption.to_owned(), columns, rows, folded: false }
    }

    /// Whether a column holds figures.
    pub fn is_numeric(&self, column: usize) -> bool {
        self.rows.iter().any(|row| row.get(column).is_some_and(|cell| cell.value.is_some()))
    }

    pub fn folded(self) -> Self {
        Self { folded: true, ..self }
    }
}

/// How many figures stand side by side on a wide screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Columns {
    One,
    Two,
    Three,
}

/// A part of the report.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Block {
    /// Of the second or a deeper level.
    Heading(u8, String),
    /// A paragraph; between backticks it is code.
    Text(String),
    Table(Table),
    /// Side by side where there is room.
    Figures(Columns, Vec<Figure>),
    /// One at a time on the page, by its name.
    Choice(String, Vec<(String, Vec<Block>)>),
    /// Columns of pictures, side by side where there is room.
    Pictures(Vec<Vec<Picture>>),
    /// What reproduces the figures above.
    Origins(Vec<Origin>),
}

/// Commands, each once, with the devices that they ran on and the seeds.
pub(super) fn by_command(origins: &[Origin]) -> Vec<(&str, String)> {
    let mut commands: Vec<(&str, Vec<String>)> = Vec::new();
    for origin in origins {
        let seed = if origin.seed.is_empty() { String::new() } else { format!(" (seed {})", origin.seed) };
        let device = origin.device.clone() + &seed;
        match commands.iter_mut().find(|(command, _)| *command == origin.command) {
            Some((_, devices)) => devices.push(device),
            None => commands.push((&origin.command, vec![device])),
        }
    }
    commands.into_iter().map(|(command, devices)| (command, devices.join("; "))).collect()
}
