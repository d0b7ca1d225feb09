//! The report as Markdown with its charts and pictures in files beside.

use super::document::{Block, Picture, Table, by_command};
use crate::report::data::Origin;

/// The whole text, and the files that it shows.
pub(super) fn text(title: &str, blocks: &[Block]) -> (String, Vec<(String, Vec<u8>)>) {
    let mut writer = Writer { text: format!("# {title}\n"), files: Vec::new() };
    writer.blocks(blocks);
    (writer.text, writer.files)
}

struct Writer {
    text: String,
    files: Vec<(String, Vec<u8>)>,
}

impl Writer {
    fn blocks(&mut self, blocks: &[Block]) {
        for block in blocks {
            self.text.push('\n');
            self.block(block);
        }
    }

    fn block(&mut self, block: &Block) {
        match block {
            Block::Heading(level, text) => {
                self.text += &format!("{} {}\n", "#".repeat(usize::from(*level)), escaped(text));
            }
            Block::Text(text) => self.text += &format!("{}\n", escaped(text)),
            Block::Table(table) => self.table(table),
            Block::Figures(_, figures) => {
                for figure in figures {
                    self.text += &format!("![{}]({})\n", escaped(&figure.title), figure.file);
                    self.file(&figure.file, figure.svg.as_bytes());
                    self.text.extend(
                        figure
                            .origin
                            .iter()
                            .map(|origin| format!("\n{}\n", said(std::slice::from_ref(origin)))),
                    );
                }
            }
            Block::Choice(_, options) => {
                for (index, (name, blocks)) in options.iter().enumerate() {
                    self.text += &format!("{}### {}\n", if index == 0 { "" } else { "\n" }, escaped(name));
                    self.blocks(blocks);
                }
            }
            Block::Pictures(columns) => self.pictures(columns),
            Block::Origins(origins) => {
                self.text += &format!("{}\n", said(origins));
            }
        }
    }

    /// A table whose lines are pictures and captions in turn.
    fn pictures(&mut self, columns: &[Vec<Picture>]) {
        let height = columns.iter().map(Vec::len).max().unwrap_or(0);
        for row in 0..height {
            let pictures: Vec<Option<&Picture>> = columns.iter().map(|column| column.get(row)).collect();
            let line = |cell: &dyn Fn(&Picture) -> String| {
                let cells = pictures.iter().map(|picture| picture.map(cell).unwrap_or_default());
                format!("| {} |\n", cells.collect::<Vec<_>>().join(" | "))
            };
            self.text += &line(&|shown| format!("![{}]({})", escaped(&shown.caption.join(", ")), shown.file));
            if row == 0 {
                self.text += &format!("|{}\n", " --- |".repeat(columns.len()));
            }
            self.text += &line(&|shown| escaped(&shown.caption.join("<br>")));
        }
        for picture in columns.iter().flatten() {
            self.file(&picture.file, &picture.png);
        }
    }

    fn table(&mut self, table: &Table) {
        let row = |cells: &mut dyn Iterator<Item = String>| {
            format!("| {} |\n", cells.collect::<Vec<_>>().join(" | "))
        };
        if table.folded {
            let caption = table.caption.replace('&', "&amp;").replace('<', "&lt;");
            self.text += &format!("<details><summary>{caption}</summary>\n\n");
        } else {
            self.text += &format!("{}\n\n", escaped(&table.caption));
        }
        self.text += &row(&mut table.columns.iter().map(|column| escaped(column)));
        let rule = |column| if table.is_numeric(column) { "---:" } else { "---" }.to_owned();
        self.text += &row(&mut (0..table.columns.len()).map(rule));
        for cells in &table.rows {
            self.text += &row(&mut cells.iter().map(|cell| escaped(&cell.text)));
        }
        if table.folded {
            self.text += "\n</details>\n";
        }
    }

    /// Keeps a file, once.
    fn file(&mut self, name: &str, bytes: &[u8]) {
        if !self.files.iter().any(|(known, _)| known == name) {
            self.files.push((name.to_owned(), bytes.to_vec()));
        }
    }
}

/// What reproduces figures.
fn said(origins: &[Origin]) -> String {
    let origins = by_command(origins).into_iter().map(|(command, devices)| match command {
        "" => escaped(&devices),
        command => format!("`{command}` · {}", escaped(&devices)),
    });
    format!("_Origin:_ {}", origins.collect::<Vec<_>>().join("; "))
}

/// A text that means in Markdown what it says, but for its code between backticks.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for (index, part) in text.split('`').enumerate() {
        if index > 0 {
            escaped.push('`');
        }
        for letter in part.chars() {
            if letter == '|' || index % 2 == 0 && matches!(letter, '*' | '_' | '[' | ']' | '#' | '\\') {
                escaped.push('\\');
            }
            escaped.push(letter);
        }
    }
    escaped.replace('\n', " ")
}
