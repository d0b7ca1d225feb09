//! A whole report: every method measured in error and in cost.

use std::path::{Path, PathBuf};

use glam::DVec3;

use super::compare::{Level, Truth, comparators};
use super::costs::{self, CostsError, Kernel};
use super::data::{MethodInfo, Origin, PictureRow, Report};
use super::errors::{
    self, Effort, ErrorSet, LevelSteps, MapSet, MapSettings, PictureError, PictureLevel, StandardSteps,
    TableFileError, TableMethod, cosine_density,
};
use super::method::Method;
use super::page::{LOBE_SIGHTS, LobePlot, PageError, PictureFile, read_pictures};
use crate::device::{Device, DeviceError};
use crate::effects::{Effect, Effects, Quality};
use crate::fit;
use crate::scene::{Scene, SceneError};
use crate::shade::{LobeSum, LtcLobe, ltc_surface};
use crate::table::Table;

/// Random lights for the budget of errors.
const BUDGET_LIGHTS: usize = 1500;

/// Width and height of rendered scenes.
const PICTURE_SIZE: [u32; 2] = [192, 108];

/// What to measure.
pub struct Settings<'a> {
    /// Whether to be done in seconds: fewer lights, operations counted and nothing timed, no rendered scenes.
    pub quick: bool,
    /// What measures costs.
    pub costs: costs::Options<'a>,
    /// Files of further tables.
    pub tables: Vec<PathBuf>,
    /// A folder for files that are not kept.
    pub scratch: PathBuf,
}

/// A report with what its page shows besides.
pub struct Gathered {
    /// The figures.
    pub report: Report,
    /// Lobes to plot.
    pub lobes: Vec<LobePlot>,
    /// Rendered scenes.
    pub pictures: Vec<PictureFile>,
}

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A cost could not be measured.
    #[error(transparent)]
    Costs(#[from] CostsError),
    /// A table could not be read.
    #[error(transparent)]
    Table(#[from] TableFileError),
    /// No device draws the scenes.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// A scene could not be drawn.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// A shipped scene is broken.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A picture could not be read back.
    #[error(transparent)]
    Page(#[from] PageError),
}

/// Measures everything. `progress` hears what is being done and the share of all that is done, 0…1.
///
/// # Errors
///
/// If something that is asked for is missing.
pub fn gather(settings: &Settings, progress: &(dyn Fn(&str, f64) + Sync)) -> Result<Gathered, ReportError> {
    let effort = if settings.quick { Effort::Quick } else { Effort::Full };
    let command = settings.costs.command.clone();
    let levels: Vec<Level> = Level::all().collect();
    let others = comparators();
    let tables: Vec<TableMethod> =
        settings.tables.iter().map(|path| TableMethod::from_file(path)).collect::<Result<_, _>>()?;
    let mut methods: Vec<&dyn Method> = levels.iter().map(|level| level as &dyn Method).collect();
    methods.extend(others.iter().map(|method| method.as_ref()));
    methods.extend(tables.iter().map(|table| table as &dyn Method));

    let mut report = Report { version: env!("CARGO_PKG_VERSION").to_owned(), command, ..Report::default() };
    report.methods = methods.iter().map(|method| method.info()).collect();
    report.methods.push(Truth::default().info());
    progress("errors", 0.0);
    let origin = add_origin(
        &mut report,
        &format!("quads: {}, triangles: {}", errors::QUAD_SEED, errors::TRIANGLE_SEED),
    );
    report.errors = errors::error_rows(&methods, &ErrorSet::new(effort));
    report.errors_origin = origin;
    progress("error maps", 0.1);
    report.maps_origin = add_origin(&mut report, &format!("{}", errors::MAP_SEED));
    let maps = MapSet::new(MapSettings::new(effort));
    let mapped = methods.iter().filter(|method| is_mapped(&method.info()));
    report.maps = mapped.flat_map(|method| maps.maps(*method)).collect();
    progress("error budget", 0.2);
    report.budget_origin = add_origin(&mut report, &format!("quads: {}", errors::QUAD_SEED));
    report.budget = budgets(&levels, settings.quick);
    progress("lobes", 0.3);
    report.lobes_origin = add_origin(&mut report, "");
    for level in &levels {
        let density = |roughness: f64, cosine: f64| {
            let (view, lobes) = lobes_at(level, roughness, cosine);
            cosine_density(lobes, view)
        };
        report.lobes.extend(errors::lobe_rows(&level.info().name, &density, effort));
    }
    progress("sweeps of approximations", 0.33);
    report.sweeps_origin = add_origin(&mut report, "");
    report.sweeps =
        errors::univariate(effort, &|share| progress("sweeps of approximations", 0.33 + 0.15 * share));
    let mut pictures = Vec::new();
    if !settings.quick {
        pictures = draw(&mut report, &levels, settings, progress)?;
    }
    progress("costs", 0.7);
    let mut step = 0.7;
    let costs = costs::measure(&Kernel::all(), &settings.costs, &mut |what| {
        step += 0.02;
        progress(what, f64::min(step, 0.98));
    })?;
    costs.append_to(&mut report);
    progress("page", 1.0);
    Ok(Gathered { report, lobes: plots(&levels), pictures })
}

/// Adds what reproduces figures that the processor computes.
fn add_origin(report: &mut Report, seed: &str) -> usize {
    let device = "the crate itself, on the processor".to_owned();
    report.origins.push(Origin { command: report.command.clone(), device, seed: seed.to_owned() });
    report.origins.len() - 1
}

/// Whether the errors of a method are shown over roughness and view: noise is not.
fn is_mapped(info: &MethodInfo) -> bool {
    !["samples-", "light-", "brdf-"].iter().any(|prefix| info.name.starts_with(prefix))
}

/// The view and the lobes of a level.
fn lobes_at(level: &Level, roughness: f64, cosine: f64) -> (DVec3, Vec<LtcLobe<f64>>) {
    let view = DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine);
    let surface = ltc_surface::<f64>(DVec3::ZERO, DVec3::Z, view, roughness);
    (view, level.lobes(&surface).lobes().to_vec())
}

fn plots(levels: &[Level]) -> Vec<LobePlot> {
    let sight = |(roughness, cosine)| {
        let level = move |level: &Level| {
            let (_, lobes) = lobes_at(level, roughness, cosine);
            let count = ["one lobe", "two lobes", "three lobes"][lobes.len() - 1];
            LobePlot::lobes(&format!("{count} ({})", level.quality()), roughness, cosine, lobes)
        };
        [LobePlot::ggx(roughness, cosine)].into_iter().chain(levels.iter().map(level))
    };
    LOBE_SIGHTS.into_iter().flat_map(sight).collect()
}

/// Of the level of one lobe every cause; of the others what the model and what single precision adds.
fn budgets(levels: &[Level], quick: bool) -> Vec<super::data::BudgetRow> {
    let count = if quick { BUDGET_LIGHTS / 5 } else { BUDGET_LIGHTS };
    let cases = errors::cases(errors::random_lights(errors::QUAD_SEED, errors::REGION, count));
    let native = fit::Settings::native(crate::TABLE_SIZE);
    let mut rows = Vec::new();
    for level in levels {
        if level.quality() == Quality::Standard {
            let steps = StandardSteps::new(TableMethod::standard(), native, &cases, &|_| ());
            rows.extend(errors::budget(&steps.steps(), &cases));
        } else {
            let steps: Vec<(String, errors::Evaluate)> = vec![
                ("lobe model".to_owned(), Box::new(|quad| level.precise_value(quad))),
                ("single precision".to_owned(), Box::new(|quad| level.value(quad))),
            ];
            rows.extend(errors::budget(&LevelSteps { steps, method: level }, &cases));
        }
    }
    rows
}

/// Renders the shipped scenes at every level, with a plain light in place of the one that shows a picture.
fn draw(
    report: &mut Report,
    levels: &[Level],
    settings: &Settings,
    progress: &(dyn Fn(&str, f64) + Sync),
) -> Result<Vec<PictureFile>, ReportError> {
    let device = Device::open_any()?;
    let origin = report.origins.len();
    report.origins.push(Origin {
        command: report.command.clone(),
        device: format!("{}, {}", device.info().name, device.info().driver_info),
        seed: String::new(),
    });
    let drawn: Vec<PictureLevel> = levels
        .iter()
        .map(|level| PictureLevel {
            name: level.info().name,
            effects: level
                .quality()
                .of(Effects::of(&[Effect::Quad, Effect::Polygon, Effect::Ggx]).unwrap_or_default()),
            table: Table::default(),
        })
        .collect();
    let texts = [
        ("gallery", include_str!("../../scenes/gallery.toml")),
        ("lights", include_str!("../../scenes/lights.toml")),
    ];
    for (at, (name, text)) in texts.into_iter().enumerate() {
        let plain: Vec<&str> = text.lines().filter(|line| !line.starts_with("picture")).collect();
        let scene = Scene::parse(&plain.join("\n"), name)?;
        let from = 0.48 + 0.11 * at as f64;
        let rows = errors::pictures(
            &device,
            &drawn,
            (name, &scene),
            PICTURE_SIZE,
            &settings.scratch,
            origin,
            &|share| {
                progress("rendered scenes", from + 0.11 * share);
            },
        )?;
        report.pictures.push(PictureRow {
            method: Truth::default().info().name,
            scene: name.to_owned(),
            rmse: 0.0,
            mean: 0.0,
            picture: format!("{name}-truth.png"),
            difference: String::new(),
            origin,
        });
        report.pictures.extend(rows);
    }
    Ok(read_pictures(report, Path::new(&settings.scratch))?)
}
