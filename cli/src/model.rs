//! The reflectance model that a table is baked for.

use clap::{Args, ValueEnum};
use softbox::brdf::{Beckmann, Brdf, Charlie, Eon, Ggx, Lambert, Masking, Visibility};
use softbox::fit::Layout;

#[derive(Args)]
pub struct ModelArguments {
    /// Reflectance model.
    /// [default: ggx; for the layouts sheen and diffuse charlie and eon]
    #[arg(long, value_enum)]
    model: Option<ModelName>,
    /// For ggx-schlick: the constant k of G1 = (n.w) / ((n.w)(1 - k) + k), as a multiple of alpha, or of
    /// (roughness + 1)^2 with --k-of-roughness.
    /// [default: 0.5, or 0.125 with --k-of-roughness]
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true)]
    k: Option<f64>,
    /// For ggx-schlick: take k as a multiple of (roughness + 1)^2 instead of alpha.
    #[arg(long)]
    k_of_roughness: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ModelName {
    /// GGX with height-correlated Smith masking.
    Ggx,
    /// GGX with Schlick's separable approximation to Smith masking, see --k.
    GgxSchlick,
    /// Beckmann with height-correlated Smith masking.
    Beckmann,
    /// A diffuse surface.
    Lambert,
    /// Sheen with Smith's shadowing.
    Charlie,
    /// Sheen with Neubelt's shadowing.
    CharlieNeubelt,
    /// The first bounce of a white rough diffuse surface.
    Eon,
}

impl ModelArguments {
    /// The model at every roughness, or why there is none.
    pub fn family(&self) -> anyhow::Result<impl Fn(f64) -> Box<dyn Brdf> + Sync + use<>> {
        self.family_for(Layout::Native)
    }

    /// The same, with the default model of a layout.
    pub fn family_for(&self, layout: Layout) -> anyhow::Result<impl Fn(f64) -> Box<dyn Brdf> + Sync + use<>> {
        let Self { model, k, k_of_roughness } = *self;
        let model = model.unwrap_or(match layout {
            Layout::Native | Layout::Compatible => ModelName::Ggx,
            Layout::Sheen => ModelName::Charlie,
            Layout::Diffuse => ModelName::Eon,
        });
        anyhow::ensure!(
            model == ModelName::GgxSchlick || (k.is_none() && !k_of_roughness),
            "--k and --k-of-roughness say nothing to this model; they are for --model ggx-schlick"
        );
        let k = k.unwrap_or(if k_of_roughness { 0.125 } else { 0.5 });
        anyhow::ensure!(
            k.is_finite() && (0.0..=1.0).contains(&k),
            "--k is {k}, but a factor must be a number from 0 to 1"
        );
        Ok(move |roughness: f64| -> Box<dyn Brdf> {
            let alpha = roughness * roughness;
            match model {
                ModelName::Ggx => Box::new(Ggx::new(alpha)),
                ModelName::GgxSchlick => {
                    let k = if k_of_roughness { k * (roughness + 1.0).powi(2) } else { k * alpha };
                    Box::new(Ggx { alpha, masking: Masking::Schlick { k } })
                }
                ModelName::Beckmann => Box::new(Beckmann { alpha }),
                ModelName::Lambert => Box::new(Lambert),
                ModelName::Charlie => Box::new(Charlie::of_roughness(roughness)),
                ModelName::CharlieNeubelt => {
                    Box::new(Charlie { visibility: Visibility::Neubelt, ..Charlie::of_roughness(roughness) })
                }
                ModelName::Eon => Box::new(Eon::single(roughness)),
            }
        })
    }
}
