//! The report as one page that needs nothing else.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::document::{Block, Cell, Columns, Figure, Picture, Table, by_command};
use super::number::slug;
use crate::report::data::Origin;

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// Letters from which on a cell needs a width of its own on a narrow screen.
const LONG: usize = 50;

/// The whole page.
pub(super) fn page(title: &str, blocks: &[Block]) -> String {
    let chapters = blocks.iter().filter_map(|block| match block {
        Block::Heading(2, text) => Some(text),
        _ => None,
    });
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                main {
                    h1 { (title) }
                    nav aria-label="Contents" {
                        @for chapter in chapters { a href=(format!("#{}", slug(chapter))) { (chapter) } " " }
                    }
                    @for block in blocks { (self::block(block)) }
                }
                div id="tip" role="status" hidden {}
                script { (PreEscaped(SCRIPT)) }
            }
        }
    }
    .into_string()
}

fn block(block: &Block) -> Markup {
    html! {
        @match block {
            Block::Heading(2, text) => h2 id=(slug(text)) { (text) },
            Block::Heading(_, text) => h3 id=(slug(text)) { (text) },
            Block::Text(text) => p { (inline(text)) },
            Block::Table(table) => (self::table(table)),
            Block::Figures(columns, figures) => {
                div class=(match columns { Columns::One => "charts large", Columns::Two => "charts", Columns::Three => "charts small" }) {
                    @for figure in figures { (chart(figure)) }
                }
            },
            Block::Choice(label, options) => {
                div class="choice" data-label=(label) {
                    @for (name, blocks) in options {
                        section data-name=(name) {
                            h3 { (name) }
                            @for block in blocks { (self::block(block)) }
                        }
                    }
                }
            },
            Block::Pictures(columns) => {
                div class="pictures" {
                    @for column in columns { div { @for picture in column { (self::picture(picture)) } } }
                }
            },
            Block::Origins(origins) => {
                (self::origins(origins))
            },
        }
    }
}

fn chart(figure: &Figure) -> Markup {
    html! {
        figure {
            (PreEscaped(&figure.svg))
            @if let Some(origin) = &figure.origin { (origins(std::slice::from_ref(origin))) }
        }
    }
}

/// All origins in one paragraph; what several have in common is said once.
fn origins(origins: &[Origin]) -> Markup {
    html! {
        p class="origin" {
            "Origin: "
            @for (index, (command, devices)) in by_command(origins).into_iter().enumerate() {
                @if index > 0 { "; " }
                @if !command.is_empty() { code { (command) } " · " }
                (devices)
            }
            "."
        }
    }
}

fn picture(picture: &Picture) -> Markup {
    let source = format!("data:image/png;base64,{}", STANDARD.encode(&picture.png));
    html! {
        figure {
            img src=(source) alt=(picture.caption.join(", ")) width=(picture.width) loading="lazy";
            figcaption {
                @for (index, line) in picture.caption.iter().enumerate() {
                    @if index == 0 { strong { (line) } } @else { br; (line) }
                }
            }
        }
    }
}

fn table(table: &Table) -> Markup {
    let content = html! {
        div class="scroll" {
            table {
                thead {
                    tr {
                        @for (index, column) in table.columns.iter().enumerate() {
                            th scope="col" class=[table.is_numeric(index).then_some("number")] { (inline(column)) }
                        }
                    }
                }
                tbody { @for row in &table.rows { tr { @for (index, cell) in row.iter().enumerate() { (self::cell(cell, table.is_numeric(index))) } } } }
            }
        }
    };
    html! {
        @if table.folded {
            details { summary { (table.caption) } (content) }
        } @else {
            p class="caption" { (table.caption) }
            (content)
        }
    }
}

fn cell(cell: &Cell, numeric: bool) -> Markup {
    html! {
        @match cell.value {
            Some(value) => td class="number" data-value=(value) { (cell.text) },
            None if cell.text.chars().count() > LONG => td class="long" { (inline(&cell.text)) },
            None => td class=[numeric.then_some("number")] { (inline(&cell.text)) },
        }
    }
}

/// A text whose parts between backticks are code.
fn inline(text: &str) -> Markup {
    html! {
        @for (index, part) in text.split('`').enumerate() {
            @if index % 2 == 1 { code { (part) } } @else { (part) }
        }
    }
}
