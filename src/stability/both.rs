//! A scene shaded by the published technique and by this library, each against itself in exact arithmetic.

use glam::DVec3;
use rayon::prelude::*;

use super::approach::{EdgeForm, Method, Setting, Tables};
use crate::device::{Device, RenderError};
use crate::effects::Quality;
use crate::light::Light;
use crate::report::compare::published_table;
use crate::scene::{Hit, Image, Panel, Scene, SceneError};
use crate::table::Table;

/// Shown where a value is infinite or not a number.
pub const NOT_FINITE: [u8; 3] = [255, 0, 255];

/// A picture of a scene by one method, on a device and in exact arithmetic.
#[derive(Clone, Debug, PartialEq)]
pub struct Shaded {
    /// Who shades.
    pub method: Method,
    /// In f32 on the device, as it comes.
    pub picture: Image,
    /// The same in f64, by formulas that hold in the limits.
    pub exact: Image,
}

/// How far a picture is from exact arithmetic.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// Pixels that are infinite or not a number.
    pub not_finite: usize,
    /// Share of the pixels that are off by more than 1 % of the mean, those among them.
    pub visible: f64,
    /// Mean error of the others over the mean.
    pub mean: f64,
}

/// Why a scene was not drawn by both.
#[derive(Debug, thiserror::Error)]
pub enum BothError {
    /// The device or the scene refused.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// There is no published form for something in it.
    #[error(
        "{place}: {what}; the published technique is for polygons on surfaces of a diffuse and a GGX part"
    )]
    Unpublished {
        /// Which light or object.
        place: String,
        /// What it has.
        what: String,
    },
}

impl From<SceneError> for BothError {
    fn from(error: SceneError) -> Self {
        Self::Render(error.into())
    }
}

/// Draws a scene by the published technique with both forms of its edge integral, and at the standard level; one sample in each
/// pixel's centre.
///
/// # Errors
///
/// If the scene has lights or materials that the published technique knows nothing of, or the device fails.
pub fn scene_by_both(device: &Device, scene: &Scene, size: [u32; 2]) -> Result<[Shaded; 3], BothError> {
    check(scene)?;
    let nothing = |_: f64| ();
    let effects = scene.effects();
    let ours = device.render_with(&Table::default(), scene, effects, size, 1, &nothing)?;
    let published = |form: EdgeForm| {
        let arc_cosine = f64::from(u8::from(form == EdgeForm::Printed));
        let switches = effects.switches().map(|(name, on)| (name, f64::from(u8::from(on))));
        let constants: Vec<(&str, f64)> = switches.chain([("published_arc_cosine", arc_cosine)]).collect();
        device.draw(&published_text(), &constants, &published_table(), scene, effects, size, 1, &nothing)
    };
    let tables = Tables::default();
    let shaded = |method, picture| Shaded { method, picture, exact: exact(scene, method, &tables, size) };
    Ok([
        shaded(Method::Polygon(EdgeForm::Printed), published(EdgeForm::Printed)?),
        shaded(Method::Polygon(EdgeForm::Fitted), published(EdgeForm::Fitted)?),
        shaded(Method::Level(Quality::Standard), ours),
    ])
}

/// Pictures side by side with their errors below.
pub fn sheet(shaded: &[Shaded], exposure: f64) -> Panel {
    let rows = shaded.iter().map(|shaded| {
        let mut picture = shaded.panel(exposure);
        picture.caption(&shaded.method.label().to_uppercase().replace(',', ":"));
        let spread = shaded.spread();
        let mut errors = shaded.error_panel();
        errors.caption(&match spread.not_finite {
            0 => format!("ERROR OVER 1%: {:.1}% OF PIXELS", 100.0 * spread.visible),
            count => format!("{:.1}% - {count} NOT FINITE", 100.0 * spread.visible),
        });
        (picture, errors)
    });
    let (pictures, errors): (Vec<Panel>, Vec<Panel>) = rows.unzip();
    let (above, below) = (Panel::beside(&pictures), Panel::beside(&errors));
    let gap = vec![[16; 3]; 4 * above.width as usize];
    let pixels = [above.pixels, gap, below.pixels].concat();
    Panel { width: above.width, height: above.height + 4 + below.height, pixels }
}

/// The kernel of scenes with the published shading in the place of its own.
fn published_text() -> String {
    const OWN: &str = "fn render_shade(";
    let (before, after) = crate::WGSL_RENDER.split_once(OWN).expect("wgsl/render.wgsl has its render_shade");
    format!(
        "{}{before}fn render_shade_by_the_include({after}{}",
        crate::WGSL_INCLUDE,
        include_str!("../../wgsl/compare/published_scene.wgsl")
    )
}

fn check(scene: &Scene) -> Result<(), BothError> {
    let refused = |place: String, what: &str| Err(BothError::Unpublished { place, what: what.to_owned() });
    for (index, light) in scene.lights.iter().enumerate() {
        if !matches!(light.shape, Light::Polygon { .. }) || light.picture.is_some() {
            let what = if light.picture.is_some() { "a picture" } else { light.shape.shape() };
            return refused(format!("light {}", index + 1), what);
        }
    }
    for (index, object) in scene.objects.iter().enumerate() {
        let material = &object.material;
        let layered = material.coat > 0.0
            || material.sheen_colour != DVec3::ZERO
            || material.diffuse_roughness > 0.0
            || material.anisotropy > 0.0;
        if layered {
            return refused(format!("object {}", index + 1), "a layered or anisotropic material");
        }
    }
    if scene.energy_compensation {
        return refused("the scene".to_owned(), "energy compensation");
    }
    Ok(())
}

/// The scene in f64.
fn exact(scene: &Scene, method: Method, tables: &Tables, [width, height]: [u32; 2]) -> Image {
    let pixel = |index: u32| {
        let [x, y] = [index % width, index / width].map(|at| f64::from(at) + 0.5);
        let origin = scene.camera.position;
        let direction = scene.camera.direction(x, y, width, height);
        let radiance = match scene.trace(origin, direction) {
            Hit::Background => scene.background,
            Hit::Light(light, emits) => scene.lights[light].radiance * f64::from(u8::from(emits)),
            Hit::Surface { object, position, normal } => {
                let material = scene.objects[object].material.at(position);
                let setting = |light: &Light| Setting {
                    position,
                    normal,
                    view: -direction,
                    roughness: material.roughness,
                    light: light.clone(),
                };
                let reflected = scene.lights.iter().map(|light| {
                    let [diffuse, specular, fresnel] = method.exact(tables, &setting(&light.shape));
                    let plain = material.normal_reflectance * (specular - fresnel);
                    light.radiance
                        * (material.base_colour * diffuse + plain + material.grazing_reflectance * fresnel)
                });
                reflected.sum()
            }
        };
        radiance.as_vec3().to_array()
    };
    Image { width, height, pixels: (0..width * height).into_par_iter().map(pixel).collect() }
}

fn luminance([red, green, blue]: [f32; 3]) -> f64 {
    0.2126 * f64::from(red) + 0.7152 * f64::from(green) + 0.0722 * f64::from(blue)
}

fn is_finite(pixel: &[f32; 3]) -> bool {
    pixel.iter().all(|value| value.is_finite())
}

impl Shaded {
    fn mean(&self) -> f64 {
        let sum: f64 = self.exact.pixels.iter().map(|pixel| luminance(*pixel)).sum();
        sum / self.exact.pixels.len() as f64
    }

    /// The error of each pixel over the mean luminance; none where it is not finite.
    pub fn errors(&self) -> Vec<Option<f64>> {
        let mean = self.mean();
        let pairs = self.picture.pixels.iter().zip(&self.exact.pixels);
        let error = |(picture, exact): (&[f32; 3], &[f32; 3])| {
            is_finite(picture).then(|| (luminance(*picture) - luminance(*exact)) / mean)
        };
        pairs.map(error).collect()
    }

    /// What to say of the errors.
    pub fn spread(&self) -> Spread {
        let errors = self.errors();
        let finite = errors.iter().flatten().map(|error| error.abs());
        let not_finite = errors.iter().filter(|error| error.is_none()).count();
        let visible = not_finite + finite.clone().filter(|error| *error > 0.01).count();
        Spread {
            not_finite,
            visible: visible as f64 / errors.len() as f64,
            mean: finite.sum::<f64>() / (errors.len() - not_finite).max(1) as f64,
        }
    }

    /// The picture as a film shows it.
    pub fn panel(&self, exposure: f64) -> Panel {
        let mut panel = self.picture.tone_mapped(exposure);
        for (shown, pixel) in panel.pixels.iter_mut().zip(&self.picture.pixels) {
            if !is_finite(pixel) {
                *shown = NOT_FINITE;
            }
        }
        panel
    }

    /// The errors in false colours, by their powers of ten: black below 1e-5 of the mean, then blue, red from 1e-3, yellow and
    /// white from 1e-1 on.
    pub fn error_panel(&self) -> Panel {
        let colour = |error: Option<f64>| {
            error.map_or(NOT_FINITE, |error| heat((error.abs().max(1e-30).log10() + 5.0) / 5.0))
        };
        let pixels = self.errors().into_iter().map(colour).collect();
        Panel { width: self.picture.width, height: self.picture.height, pixels }
    }
}

/// From black at 0 over blue, red and yellow to white at 1.
fn heat(share: f64) -> [u8; 3] {
    const STOPS: [[f64; 3]; 5] = [
        [0.0, 0.0, 0.0],
        [20.0, 40.0, 140.0],
        [200.0, 40.0, 60.0],
        [255.0, 200.0, 40.0],
        [255.0, 255.0, 255.0],
    ];
    let at = 4.0 * share.clamp(0.0, 1.0);
    let index = (at as usize).min(3);
    core::array::from_fn(|k| {
        let [low, high] = [STOPS[index][k], STOPS[index + 1][k]];
        (low + (high - low) * (at - index as f64)).round() as u8
    })
}
