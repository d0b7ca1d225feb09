//! What there is to choose from: one line for each effect.

/// What an effect belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Group {
    /// Shapes of lights.
    Light,
    /// Layers of a surface.
    Surface,
    /// How either is evaluated.
    Option,
}

/// A layer of the table's texture array: one RGBA16F image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Layer {
    /// The specular lobe's shape.
    Shape,
    /// The specular lobe's albedo and its Schlick part.
    Amplitude,
    /// The lobe of a sheen with its albedo.
    Sheen,
    /// The lobe of a rough diffuse surface with its albedo.
    Diffuse,
    /// The first half of the corrections for anisotropic surfaces.
    AnisotropicFirst,
    /// The second half, right behind the first.
    AnisotropicSecond,
    /// The shape of the first of two lobes.
    FirstOfTwo,
    /// The shape of the second of two lobes.
    SecondOfTwo,
    /// The albedos of both, then what Schlick's part of each exceeds that of its mean direction by.
    WeightsOfTwo,
    /// The shape of the first of three lobes.
    FirstOfThree,
    /// The shape of the second of three lobes.
    SecondOfThree,
    /// The shape of the third lobe.
    ThirdOfThree,
    /// The albedos of all three, then the Schlick part of all together.
    WeightsOfThree,
    /// What Schlick's part of each of three lobes exceeds that of its mean direction by.
    ExcessesOfThree,
}

impl Layer {
    /// The layers of a single specular lobe, at the places where the include's
    /// `ltc_lobe_from_table` looks for them.
    pub const BASE: [Self; 2] = [Self::Shape, Self::Amplitude];

    /// The layers that anisotropic surfaces need besides, for tables of 64 × 64 texels.
    pub const ANISOTROPIC: [Self; 2] = [Self::AnisotropicFirst, Self::AnisotropicSecond];

    /// The layers of a sum of two lobes, one behind the other.
    pub const TWO_LOBES: [Self; 3] = [Self::FirstOfTwo, Self::SecondOfTwo, Self::WeightsOfTwo];

    /// The layers of a sum of three lobes, one behind the other.
    pub const THREE_LOBES: [Self; 5] = [
        Self::FirstOfThree,
        Self::SecondOfThree,
        Self::ThirdOfThree,
        Self::WeightsOfThree,
        Self::ExcessesOfThree,
    ];

    /// Bytes of the layer with `size` texels along each axis.
    pub const fn bytes(self, size: usize) -> usize {
        size * size * 4 * 2
    }
}

/// A line of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Which effect it describes.
    pub effect: Effect,
    /// What it belongs to.
    pub group: Group,
    /// Its name in texts.
    pub name: &'static str,
    /// The `override` of the include that it drives; empty where there is none to drive.
    pub switch: &'static str,
    /// Effects of which the set must hold at least one for this one to mean anything.
    pub needs: &'static [Effect],
    /// The include's functions that it is there for.
    pub roots: &'static [&'static str],
    /// Those that it is there for when the set has a surface with a lobe.
    pub lobe_roots: &'static [&'static str],
    /// Whether it is a surface with a lobe.
    pub has_lobe: bool,
    /// Layers of the table that it reads.
    pub layers: &'static [Layer],
    /// What it means, in one line.
    pub meaning: &'static str,
}

macro_rules! table {
    ($($effect:ident $group:ident $name:literal $switch:literal needs $needs:tt roots $roots:tt
       with_lobe $lobe_roots:tt has_lobe $has_lobe:literal layers $layers:tt $meaning:literal;)*) => {
        /// Something that a scene may call for.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u8)]
        pub enum Effect {
            $(#[doc = $meaning] $effect,)*
        }

        use Effect::*;

        /// Every effect, in canonical order.
        pub(super) const TABLE: &[Entry] = &[$(Entry {
            effect: $effect,
            group: Group::$group,
            name: $name,
            switch: $switch,
            needs: &$needs,
            roots: &$roots,
            lobe_roots: &$lobe_roots,
            has_lobe: $has_lobe,
            layers: &$layers,
            meaning: $meaning,
        },)*];
    };
}

// The order is that of texts, and groups are contiguous. What an effect needs may need something itself,
// as long as the chain ends.
#[rustfmt::skip]
table! {
    Quad     Light "quad"     "ltc_use_quad"     needs [] roots ["ltc_quad", "ltc_quad_begin", "ltc_quad_diffuse", "ltc_shading_quad"] with_lobe ["ltc_quad_lobe", "ltc_quad_specular"] has_lobe false layers [] "Convex quads and triangles.";
    Polygon  Light "polygon"  "ltc_use_polygon"  needs [] roots ["ltc_polygon_begin", "ltc_polygon_add", "ltc_polygon_end", "ltc_outline_begin", "ltc_outline_add", "ltc_outline_diffuse", "ltc_shading_polygon_begin", "ltc_shading_polygon_add", "ltc_shading_polygon_end"] with_lobe ["ltc_outline_lobe_begin", "ltc_outline_lobe_add", "ltc_outline_lobe", "ltc_outline_lobes_begin", "ltc_outline_lobes_add", "ltc_outline_specular"] has_lobe false layers [] "Polygons of any number of vertices, convex or not.";
    Disk     Light "disk"     "ltc_use_disk"     needs [] roots ["ltc_disk", "ltc_disk_begin", "ltc_disk_diffuse", "ltc_shading_disk"] with_lobe ["ltc_disk_lobe", "ltc_disk_specular"] has_lobe false layers [] "Disks and ellipses.";
    Sphere   Light "sphere"   "ltc_use_sphere"   needs [] roots ["ltc_sphere", "ltc_sphere_begin", "ltc_sphere_diffuse", "ltc_shading_sphere"] with_lobe ["ltc_sphere_lobe", "ltc_sphere_specular"] has_lobe false layers [] "Spheres.";
    Tube     Light "tube"     "ltc_use_tube"     needs [] roots ["ltc_tube", "ltc_tube_begin", "ltc_tube_diffuse", "ltc_shading_tube"] with_lobe ["ltc_tube_lobe", "ltc_tube_specular"] has_lobe false layers [] "Cylinders, from thin lines on.";
    Textured Light "textured" "ltc_use_textured" needs [Quad] roots ["ltc_quad_toward", "ltc_rectangle_diffuse_lookup", "ltc_texture_fetch", "ltc_texture_fetch_pair", "ltc_reflected_picture"] with_lobe ["ltc_rectangle_lookup", "ltc_quad_picture"] has_lobe false layers [] "Rectangles that show an image.";

    Lambert            Surface "lambert"             ""                            needs [] roots ["ltc_surface", "ltc_in_range", "ltc_material", "ltc_shading", "ltc_reflected"] with_lobe [] has_lobe false layers [] "Diffuse reflection by Lambert's law; part of every set.";
    Ggx                Surface "ggx"                 "ltc_use_ggx"                 needs [] roots ["ltc_table_coordinates", "ltc_lobe", "ltc_lobe_from_table", "ltc_reflectance", "ltc_shape", "ltc_shape_lobe", "ltc_lobe_value", "ltc_lobes_of", "ltc_lobes_part", "ltc_lobes_from_table", "ltc_lobes_together"] with_lobe [] has_lobe true layers [Layer::Shape, Layer::Amplitude] "Specular reflection of a rough surface.";
    ClearCoat          Surface "clearcoat"           "ltc_use_clearcoat"           needs [Ggx] roots ["ltc_surface_with_roughness", "ltc_coat_over"] with_lobe [] has_lobe true layers [] "A second, clear layer on top.";
    Sheen              Surface "sheen"               "ltc_use_sheen"               needs [] roots ["ltc_surface_with_roughness", "ltc_sheen_lobe", "ltc_sheen_lobe_from_table", "ltc_sheen_over"] with_lobe [] has_lobe true layers [Layer::Sheen] "Reflection of fibres at grazing angles.";
    RoughDiffuse       Surface "rough-diffuse"       "ltc_use_rough_diffuse"       needs [] roots ["ltc_surface_with_roughness", "ltc_diffuse_lobe", "ltc_diffuse_lobe_from_table", "ltc_rough_diffuse"] with_lobe [] has_lobe true layers [Layer::Diffuse] "Diffuse reflection of a rough surface.";
    EnergyCompensation Surface "energy-compensation" "ltc_use_energy_compensation" needs [Ggx] roots ["ltc_energy_compensation"] with_lobe [] has_lobe false layers [] "Light that a rough surface reflects more than once.";
    Anisotropic        Surface "anisotropic"         "ltc_use_anisotropic"         needs [Ggx] roots ["ltc_anisotropic_alpha", "ltc_anisotropy", "ltc_anisotropic_round", "ltc_anisotropic_coordinates", "ltc_anisotropic_lobe", "ltc_anisotropic_lobe_from_table", "ltc_stretched_lobe_from_table"] with_lobe [] has_lobe true layers [Layer::AnisotropicFirst, Layer::AnisotropicSecond] "Different roughness along two axes.";

    TwoSided     Option "two-sided"     "ltc_use_two_sided"     needs [Quad, Polygon, Disk] roots [] with_lobe [] has_lobe false layers [] "Lights that emit from both sides.";
    Caps         Option "caps"          "ltc_use_caps"          needs [Tube] roots [] with_lobe [] has_lobe false layers [] "Tubes with ends that emit.";
    CheapHorizon  Option "cheap-horizon"  "ltc_use_cheap_horizon"  needs [Quad, Polygon] roots [] with_lobe [] has_lobe false layers [] "Quads and polygons cut at the horizons by a cheap approximation.";
    CheapDistance Option "cheap-distance" "ltc_use_cheap_distance" needs [Quad, Polygon] roots [] with_lobe [] has_lobe false layers [] "Small lights treated like any other, at a loss of digits.";
    TableFree     Option "table-free"     "ltc_use_table_free"     needs [Ggx] roots ["ltc_lobe_fitted"] with_lobe [] has_lobe false layers [] "A closed form in place of the table of specular reflection.";
    SecondLobe   Option "second-lobe"   "ltc_use_second_lobe"   needs [Ggx] roots ["ltc_two_lobes"] with_lobe [] has_lobe false layers [Layer::FirstOfTwo, Layer::SecondOfTwo, Layer::WeightsOfTwo] "Isotropic specular reflection by the sum of two lobes.";
    ThirdLobe    Option "third-lobe"    "ltc_use_third_lobe"    needs [SecondLobe] roots ["ltc_three_lobes"] with_lobe [] has_lobe false layers [Layer::FirstOfThree, Layer::SecondOfThree, Layer::ThirdOfThree, Layer::WeightsOfThree, Layer::ExcessesOfThree] "Isotropic specular reflection by the sum of three lobes.";
}
