//! What a report holds, apart from how it is shown: every figure with what reproduces it.

use serde::{Deserialize, Serialize};

/// What a method is to the reader.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A quality level of this library.
    Level,
    /// What users have otherwise.
    Comparator,
    /// A numerical integration.
    Reference,
}

/// A way to evaluate a light.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MethodInfo {
    /// Its short name, the key of all other lists: `standard`, `published`, …
    pub name: String,
    /// What charts call it.
    pub label: String,
    /// What it is.
    pub kind: Kind,
    /// What it does, in one or two sentences, with its source.
    pub description: String,
}

/// What reproduces a figure.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Origin {
    /// The command.
    pub command: String,
    /// What ran it: a processor, a driver, a compiler, each with its version.
    pub device: String,
    /// The seed of its random inputs; empty where there are none.
    pub seed: String,
}

/// Which integral an error belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Part {
    /// ∫ cos/π, the form factor.
    Diffuse,
    /// ∫ f·cos for F = 1.
    Specular,
    /// ∫ f·cos·(1 − v·h)⁵, Schlick's part.
    Fresnel,
    /// Of a dielectric: F0 = 0.04, F90 = 1.
    Dielectric,
}

impl Part {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Diffuse, Self::Specular, Self::Fresnel, Self::Dielectric];

    /// What charts call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Diffuse => "diffuse",
            Self::Specular => "specular (F = 1)",
            Self::Fresnel => "Schlick's part",
            Self::Dielectric => "dielectric (F0 = 0.04)",
        }
    }
}

/// The error of a method over some inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorRow {
    /// The method's name.
    pub method: String,
    /// Which integral.
    pub part: Part,
    /// Which inputs: `all`, or a stratum such as `roughness 0.1-0.3`.
    pub stratum: String,
    /// How many inputs.
    pub count: usize,
    /// Mean |error| over mean value.
    pub mean: f64,
    /// 99th percentile of |error|, over the mean value.
    pub percentile: f64,
    /// Largest |error| over the mean value.
    pub maximum: f64,
    /// Mean signed error over the mean value.
    pub bias: f64,
}

/// Mean |error| over mean value by roughness and view.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorMap {
    /// The method's name, or that of a table's file.
    pub method: String,
    /// Which integral.
    pub part: Part,
    /// Middles of the columns.
    pub roughness: Vec<f64>,
    /// Cosines between normal and view: middles of the rows.
    pub cosine: Vec<f64>,
    /// `values[row][column]`.
    pub values: Vec<Vec<f64>>,
}

/// One cause's share of a method's error; the causes of one method and part add up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BudgetRow {
    /// The method's name.
    pub method: String,
    /// Which integral.
    pub part: Part,
    /// `lobe model`, `fit`, `interpolation`, `half precision`, `horizon`, `edge integral`, `single precision`; `total` is
    /// measured on its own.
    pub cause: String,
    /// Mean |difference| that the cause alone makes, over the mean value.
    pub alone: f64,
    /// What it adds to the mean |error| when causes are added one by one in the order of the list.
    pub added: f64,
}

/// The distance between a lobe and the BRDF's, total variation: half the integral of |difference| over the hemisphere,
/// both normalised; 0 to 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LobeRow {
    /// The method's name.
    pub method: String,
    /// Which integral's lobe.
    pub part: Part,
    /// Mean over roughness and view.
    pub mean: f64,
    /// Largest.
    pub maximum: f64,
    /// Where that is: roughness and cosine.
    pub worst: [f64; 2],
}

/// A univariate approximation, swept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SweepRow {
    /// The function of the include.
    pub function: String,
    /// Its domain, as text.
    pub domain: String,
    /// How many floats were tried.
    pub count: u64,
    /// Whether those are all floats of the domain.
    pub exhaustive: bool,
    /// Largest error, relative to the largest value or as `unit` says.
    pub maximum: f64,
    /// What `maximum` is in: `relative`, `radians`, `ulp`, …
    pub unit: String,
    /// The input of the largest error.
    pub worst: f64,
}

/// A cost of a method, measured in one way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CostRow {
    /// The method's name.
    pub method: String,
    /// What is measured, the key of a chart: `navi21 instructions`, `navi21 inverse throughput`, `navi21 worst path`,
    /// `lavapipe time`, `callgrind instructions`, `gpu time`, …
    pub measure: String,
    /// `compute` or `fragment`.
    pub stage: String,
    /// The figure.
    pub value: f64,
    /// Its unit: `instructions`, `cycles`, `ns`, …
    pub unit: String,
    /// The figure over that of the method `published`, measured in the same run.
    pub ratio: f64,
    /// Index into the report's origins.
    pub origin: usize,
}

/// How a cost grows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GrowthCurve {
    /// The key of a chart: `lights`, `vertices`, `pixels`, `lobes`, `effects`, `shared work`.
    pub chart: String,
    /// The method's name or a label.
    pub method: String,
    /// What the horizontal axis counts.
    pub x_label: String,
    /// What the vertical axis measures, with its unit.
    pub y_label: String,
    /// The points; where `x` are names, `names` holds them.
    pub x: Vec<f64>,
    /// The measured values.
    pub y: Vec<f64>,
    /// Names of the points, or empty.
    pub names: Vec<String>,
    /// Index into the report's origins.
    pub origin: usize,
}

/// The error of a rendered scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PictureRow {
    /// The method's name.
    pub method: String,
    /// The scene's name.
    pub scene: String,
    /// Root mean square error of linear radiance over the mean radiance.
    pub rmse: f64,
    /// Mean |error| over the mean radiance.
    pub mean: f64,
    /// File name of the rendering, PNG, in the report's folder.
    pub picture: String,
    /// File name of the difference image.
    pub difference: String,
    /// Index into the report's origins.
    pub origin: usize,
}

/// Everything that a report shows.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The crate's version.
    pub version: String,
    /// The command that made it.
    pub command: String,
    /// What is compared.
    pub methods: Vec<MethodInfo>,
    /// Commands, devices and seeds that figures point to.
    pub origins: Vec<Origin>,
    /// Errors on random lights.
    pub errors: Vec<ErrorRow>,
    /// Index of their origin.
    pub errors_origin: usize,
    /// Maps of errors.
    pub maps: Vec<ErrorMap>,
    /// Index of their origin.
    pub maps_origin: usize,
    /// Where errors come from.
    pub budget: Vec<BudgetRow>,
    /// Index of their origin.
    pub budget_origin: usize,
    /// Distances between lobes.
    pub lobes: Vec<LobeRow>,
    /// Index of their origin.
    pub lobes_origin: usize,
    /// Univariate approximations.
    pub sweeps: Vec<SweepRow>,
    /// Index of their origin.
    pub sweeps_origin: usize,
    /// Costs.
    pub costs: Vec<CostRow>,
    /// How costs grow.
    pub growth: Vec<GrowthCurve>,
    /// Rendered scenes.
    pub pictures: Vec<PictureRow>,
}
