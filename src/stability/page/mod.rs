//! The page on hard cases: what is promised, what was tried and what came of it, as Markdown.
//!
//! [`Sheet`] holds what the page shows. The one in `docs/` is [`Sheet::documented`], which is the same on every run.

mod approaches;
mod families;
mod known;
mod stacks;
mod words;

use std::path::Path;

use rayon::prelude::*;

use super::approach::{self, Curve, OVERVIEW_NAME, Tables, approaches, charts, curves};
use super::{Inputs, Run, StackRow};
use crate::effects::Quality;
use crate::folder::{self, Kind, WriteError};

const KIND: Kind = Kind { name: "stability report", mark: "stability.md" };

/// Units of cases on the page in `docs/`, see [`super::cases`].
pub const DOCUMENTED_CASES: usize = 20;

/// Makes the page in `docs/` anew.
pub const DOCUMENTED_COMMAND: &str = "cargo run --release -- stability --docs docs";

/// The cases of a level, and what each stack made of them; the first is the twin on the CPU.
#[derive(Clone, Debug)]
pub struct LevelSheet {
    /// The cases.
    pub inputs: Inputs,
    /// What came of them.
    pub runs: Vec<Run>,
}

/// A part of the page that is made elsewhere.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Section {
    /// Its heading.
    pub title: String,
    /// Its Markdown.
    pub text: String,
}

/// What the page shows.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// A sheet for each level, the cheapest first.
    pub levels: Vec<LevelSheet>,
    /// Errors along the approaches.
    pub curves: Vec<Curve>,
    /// Rows of the stacks.
    pub stacks: Vec<StackRow>,
    /// What says more, after the approaches.
    pub sections: Vec<Section>,
    /// Makes the page again.
    pub command: String,
}

/// Asserts that [`Sheet::write`] would replace nothing in a folder but what it wrote before.
///
/// # Errors
///
/// If it holds anything else.
pub fn check_folder(folder: &Path) -> Result<(), WriteError> {
    folder::check_replaceable(folder, KIND)
}

/// The curves of every approach, in their order.
pub fn all_curves() -> Vec<Curve> {
    let tables = Tables::default();
    let curves: Vec<Vec<Curve>> = approaches().par_iter().map(|approach| curves(approach, &tables)).collect();
    curves.concat()
}

impl Sheet {
    /// What the page in `docs/` shows: fixed cases by the twin on the CPU, and the rows of `docs/stacks.jsonl`, if there are any.
    pub fn documented(stacks: Vec<StackRow>) -> Self {
        let level = |level: Quality| {
            let inputs = Inputs::of(level, DOCUMENTED_CASES);
            let run = inputs.run_twin(DOCUMENTED_COMMAND);
            LevelSheet { inputs, runs: vec![run] }
        };
        Self {
            levels: Quality::ALL.into_iter().map(level).collect(),
            curves: all_curves(),
            stacks,
            sections: Vec::new(),
            command: DOCUMENTED_COMMAND.to_owned(),
        }
    }

    /// The page. It shows `stability.svg`, which lies beside it.
    pub fn markdown(&self) -> String {
        let mut text = words::introduction(&self.command);
        text += &families::section(self);
        text += &approaches::section(&self.curves);
        for section in &self.sections {
            text += &format!("\n## {}\n\n{}\n", section.title, section.text.trim_end());
        }
        text += &stacks::section(&self.stacks);
        text += &known::section();
        text += words::AGAIN;
        text
    }

    /// The charts: names and SVG documents, the overview first.
    pub fn charts(&self) -> Vec<(String, String)> {
        charts(&self.curves)
    }

    /// The page and the chart that it shows, by the names of their files.
    pub fn documents(&self) -> Vec<(String, String)> {
        let charts = self.charts().into_iter().filter(|(name, _)| name == OVERVIEW_NAME);
        let chart = charts.map(|(name, text)| (format!("{name}.svg"), text));
        std::iter::once(("stability.md".to_owned(), self.markdown())).chain(chart).collect()
    }

    /// The files of a folder that shows all: the page, a chart of every approach, the curves, a row for each family on each stack and
    /// one for each stack, all also as JSON Lines, and `pictures`, which sections of the page name.
    ///
    /// # Errors
    ///
    /// If a row cannot be written as JSON: what is said.
    pub fn files(&self, pictures: Vec<(String, Vec<u8>)>) -> Result<Vec<(String, Vec<u8>)>, String> {
        let mut text = self.markdown();
        let mut files = Vec::new();
        text += "\n## Every approach\n";
        for (name, chart) in self.charts() {
            let path =
                if name == OVERVIEW_NAME { format!("{name}.svg") } else { format!("approach/{name}.svg") };
            if name != OVERVIEW_NAME {
                text += &format!("\n![{name}]({path})\n");
            }
            files.push((path, chart.into_bytes()));
        }
        files.push(("stability.md".to_owned(), text.into_bytes()));
        files.push(("curves.csv".to_owned(), approach::table(&self.curves).into_bytes()));
        files.push(("curves.jsonl".to_owned(), approach::lines(&self.curves)?.into_bytes()));
        let runs = || self.levels.iter().flat_map(|level| &level.runs);
        let families: Vec<String> = runs().map(Run::lines).collect::<Result<_, _>>()?;
        files.push(("families.jsonl".to_owned(), families.concat().into_bytes()));
        let stack =
            |run: &Run| Ok(serde_json::to_string(&run.stack).map_err(|error| error.to_string())? + "\n");
        let stacks: Vec<String> = runs().map(stack).collect::<Result<_, String>>()?;
        files.push(("stacks.jsonl".to_owned(), stacks.concat().into_bytes()));
        files.extend(pictures);
        Ok(files)
    }

    /// Writes those files into a folder, whole or not at all, in the place of an older one.
    ///
    /// # Errors
    ///
    /// If the folder holds anything but what this wrote before, or the operating system refuses.
    pub fn write(files: &[(String, Vec<u8>)], folder: &Path) -> Result<(), WriteError> {
        folder::write(files, folder, KIND)
    }
}

/// Reads rows of stacks from JSON Lines.
///
/// # Errors
///
/// If a line is none: the number of the line and why.
pub fn read_stacks(text: &str) -> Result<Vec<StackRow>, String> {
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    lines
        .map(|(index, line)| {
            serde_json::from_str(line).map_err(|error| {
                format!(
                    "line {} is no row of a stack: {error}; tests/stacks/run writes such a file",
                    index + 1
                )
            })
        })
        .collect()
}

/// A table in Markdown; columns whose head begins with `>` are set to the right.
fn table(head: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let heads: Vec<String> = head.iter().map(|head| head.trim_start_matches('>').to_owned()).collect();
    let rule: Vec<String> =
        head.iter().map(|head| if head.starts_with('>') { "---:" } else { "---" }.to_owned()).collect();
    let mut text = line(&heads) + &line(&rule);
    for row in rows {
        assert_eq!(row.len(), head.len(), "{row:?} has not the columns {head:?}");
        text +=
            &line(&row.iter().map(|cell| cell.replace('|', "\\|").replace('*', "\\*")).collect::<Vec<_>>());
    }
    text
}
