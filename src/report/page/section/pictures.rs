//! Lobes and rendered scenes.

use std::io::Cursor;

use image::ImageFormat;
use image::imageops::FilterType;

use super::super::document::{Block, Cell, Columns, Picture, Table};
use super::super::number::percent;
use super::super::{LobePlot, PageError, PictureFile, check, lobe};
use super::{heading, label, origins, text};
use crate::report::data::{Origin, PictureRow, Report};

/// Pixels across of the pictures on the page, at most.
const THUMBNAIL: u32 = 480;
/// Of those, how many of a screen's; twice as fine screens have twice as many.
const SHOWN: u32 = 372;
/// Of a smaller picture, which is enlarged: four are side by side.
const SMALL: u32 = 278;

pub(super) fn lobes(report: &Report, plots: &[LobePlot]) -> Vec<Block> {
    let mut blocks = vec![
        heading("Lobes"),
        text(
            "A linearly transformed cosine (Heitz, Dupuy, Hill and Neubelt 2016) is a clamped cosine whose directions a matrix M has \
         moved. Its integral over a polygon is that of the clamped cosine over the polygon moved back, which has a closed form. \
         Each sphere of directions is seen from the side, 34° above the horizon, which is the grey line; x runs to the right. \
         Colours run from zero (grey) to the peak, contours are at each tenth of it.",
        ),
        Block::Pictures(lobe::cosines()),
    ];
    let drawn = Origin {
        command: String::new(),
        device: "drawn with the page, in double precision".to_owned(),
        seed: String::new(),
    };
    blocks.push(Block::Origins(vec![drawn.clone()]));
    if !plots.is_empty() {
        blocks.push(Block::Heading(3, "Lobes beside the reflectance model".to_owned()));
        blocks.push(text(
            "The first curve and map of each group is the model, f·cos for F = 1; the others stand in for it. Maps show the \
             hemisphere from above in a projection that keeps areas: the normal is in the middle, the horizon is the rim, a ring \
             marks the view, a dot the mirror direction. The scale of densities is logarithmic with two contours for each power of \
             ten; that of differences grows with their square root, orange where a lobe has too much and purple where it has too little. Total \
             variation is half the integral of |difference|, both normalised: 0 for equal lobes, 1 for those that never meet.",
        ));
    }
    let mut groups: Vec<Vec<&LobePlot>> = Vec::new();
    for plot in plots {
        let same = |group: &&mut Vec<&LobePlot>| {
            group[0].roughness == plot.roughness && group[0].cosine == plot.cosine
        };
        match groups.iter_mut().find(same) {
            Some(group) => group.push(plot),
            None => groups.push(vec![plot]),
        }
    }
    for group in &groups {
        let sight = lobe::sight(group);
        blocks.push(Block::Heading(3, capital(&sight.title)));
        blocks.push(Block::Figures(Columns::Two, sight.sections));
        blocks.push(Block::Figures(Columns::Two, sight.keys));
        blocks.push(Block::Pictures(sight.maps));
        blocks.push(Block::Origins(vec![drawn.clone()]));
    }
    if !report.lobes.is_empty() {
        let rows = report.lobes.iter().map(|row| {
            vec![
                Cell::text(label(report, &row.method)),
                Cell::text(row.part.name()),
                Cell::figure(row.mean),
                Cell::figure(row.maximum),
                Cell::figure(row.worst[0]),
                Cell::figure(row.worst[1]),
            ]
        });
        let columns = ["method", "part", "mean", "largest", "at roughness", "at cosine"];
        let caption = "Total variation between a lobe and the model's, over roughness and view";
        blocks.push(Block::Table(Table::new(caption, &columns, rows.collect())));
        blocks.push(origins(report, [report.lobes_origin]));
    }
    blocks
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

/// Names of all pictures, each once.
pub(in super::super) fn picture_names(report: &Report) -> Vec<&str> {
    let mut names = Vec::new();
    for name in report.pictures.iter().flat_map(|row| [&row.picture, &row.difference]) {
        if !name.is_empty() && !names.contains(&name.as_str()) {
            names.push(name.as_str());
        }
    }
    names
}

pub(super) fn scenes(report: &Report, files: &[PictureFile]) -> Result<Vec<Block>, PageError> {
    if report.pictures.is_empty() {
        return Ok(Vec::new());
    }
    let mut scenes: Vec<&str> = Vec::new();
    for row in &report.pictures {
        if !scenes.contains(&row.scene.as_str()) {
            scenes.push(&row.scene);
        }
    }
    let mut blocks = vec![
        heading("Scenes"),
        text(
            "Each method's rendering, and its difference from ground truth below: yellow and orange are too bright, blue is too dark, full colours stand \
         for 20 % of the mean luminance. RMSE is the root mean square of the difference of linear luminance over the mean \
         luminance, of pixels that show surfaces. Pictures wider than 480 pixels are reduced on the page; beside it they are \
         whole.",
        ),
    ];
    for scene in scenes {
        let rows: Vec<&PictureRow> = report.pictures.iter().filter(|row| row.scene == scene).collect();
        blocks.push(Block::Heading(3, format!("Scene {scene}")));
        let caption = |row: &PictureRow| {
            let errors = format!("RMSE {}, mean |error| {}", percent(row.rmse), percent(row.mean));
            let is_truth = row.rmse == 0.0 && row.difference.is_empty();
            [label(report, &row.method)].into_iter().chain((!is_truth).then_some(errors)).collect::<Vec<_>>()
        };
        let column = |row: &&PictureRow| -> Result<Vec<Picture>, PageError> {
            let difference = vec![format!("{}: difference", label(report, &row.method))];
            let named = [(&row.picture, caption(row)), (&row.difference, difference)];
            let named = named.into_iter().filter(|(name, _)| !name.is_empty());
            named.map(|(name, caption)| thumbnail(name, caption, files)).collect()
        };
        let columns: Vec<Vec<Picture>> = rows.iter().map(column).collect::<Result<_, _>>()?;
        blocks.push(Block::Pictures(columns.into_iter().filter(|column| !column.is_empty()).collect()));
        let cells = rows.iter().map(|row| {
            vec![
                Cell::text(label(report, &row.method)),
                Cell::percent(row.rmse),
                Cell::percent(row.mean),
                if row.picture.is_empty() { Cell::none() } else { Cell::code(&row.picture) },
                if row.difference.is_empty() { Cell::none() } else { Cell::code(&row.difference) },
            ]
        });
        let columns = ["method", "RMSE", "mean |error|", "picture", "difference"];
        blocks.push(Block::Table(
            Table::new(&format!("Errors in scene {scene}"), &columns, cells.collect()).folded(),
        ));
        blocks.push(origins(report, rows.iter().map(|row| row.origin)));
    }
    Ok(blocks)
}

/// A picture as the page shows it.
fn thumbnail(name: &str, caption: Vec<String>, files: &[PictureFile]) -> Result<Picture, PageError> {
    let refused = |reason: &str| PageError::Picture { name: name.to_owned(), reason: reason.to_owned() };
    if !check::is_picture_name(name) {
        return Err(refused("its name leads out of the folder or is not that of a PNG file"));
    }
    let (_, bytes) =
        files.iter().find(|(known, _)| known == name).ok_or_else(|| refused("it is not there"))?;
    let whole = image::load_from_memory_with_format(bytes, ImageFormat::Png)
        .map_err(|error| refused(&error.to_string()))?;
    let (png, width) = if whole.width() > THUMBNAIL {
        let small = whole.resize(THUMBNAIL, u32::MAX, FilterType::CatmullRom);
        let mut png = Cursor::new(Vec::new());
        small.write_to(&mut png, ImageFormat::Png).map_err(|error| refused(&error.to_string()))?;
        (png.into_inner(), SHOWN)
    } else {
        (bytes.clone(), if whole.width() < SHOWN { SMALL } else { SHOWN })
    };
    Ok(Picture { file: name.to_owned(), caption, png, width })
}
