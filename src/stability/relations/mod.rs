//! Relations between values that hold whatever the true value is: they need no oracle.
//!
//! Each of [`RELATIONS`] makes of one setting a few cases and a claim about their values: that a weighted sum vanishes, that one
//! is at most another, that bits are the same. The tolerance is what the documentation allows each of the values, and what
//! the rounding of coordinates costs that the relation itself had to make. The form of each follows from that; some of their
//! factors were set after inputs that offended.
//!
//! [`settings`] makes inputs that aim at trouble, [`examine`] compares all of them in one evaluation, [`shrunk`] simplifies
//! what offends, [`Kept`] keeps the worst.

mod around;
mod examine;
mod kept;
mod moves;
mod outline;
mod promise;
mod settings;
mod shrink;
mod sight;
mod slack;
mod split;
mod surface;

pub use examine::{Finding, Tally, Values, examine, on_twin, pose};
pub use kept::Kept;
pub use promise::{PHYSICAL, Promise, promise};
pub use settings::{Setting, settings};
pub use shrink::shrunk;

use super::{Case, Random};
use crate::effects::Quality;

/// A relation between values.
#[derive(Clone, Copy, Debug)]
pub struct Relation {
    /// Its name.
    pub name: &'static str,
    /// What must hold.
    pub about: &'static str,
    /// The levels at which it must.
    pub levels: &'static [Quality],
    /// What it makes of a setting; nothing of those that it says nothing about.
    pub pose: fn(&Case, &mut Random) -> Option<Posed>,
}

/// Cases and what must hold of their values.
#[derive(Clone, Debug, PartialEq)]
pub struct Posed {
    /// The cases.
    pub cases: Vec<Case>,
    /// The lobes that they are shaded with.
    pub lobes: Lobes,
    /// What must hold.
    pub claim: Claim,
    /// What the rounding of the cases' own coordinates may cost, of each part; infinite for parts that nothing is claimed of.
    pub slack: [f64; 3],
}

/// Lobes of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lobes {
    /// Those of the level's table.
    Level,
    /// The cosine itself.
    Identity,
}

/// What must hold of the values of some cases.
#[derive(Clone, Debug, PartialEq)]
pub enum Claim {
    /// All are those of the first, to the bit.
    SameBits,
    /// The sum, each value times its weight, is nothing.
    Nothing(Vec<f64>),
    /// That sum is nothing or less.
    AtMost(Vec<f64>),
    /// The sum of all is what a light all around the point gives: 1 and the albedo.
    AllAround,
    /// All but one are dark.
    OneLit,
    /// The form factor of the first is its specular value.
    Cosine,
}

impl Posed {
    /// Cases shaded with the level's lobes, whose coordinates are exact.
    fn exact(cases: Vec<Case>, claim: Claim) -> Self {
        Self { cases, lobes: Lobes::Level, claim, slack: [0.0; 3] }
    }

    /// The same where rounding costs something.
    fn rounded(cases: Vec<Case>, claim: Claim, slack: [f64; 3]) -> Self {
        Self { slack, ..Self::exact(cases, claim) }
    }

    /// Nothing is claimed of Schlick's part, which follows the mean direction of each light.
    fn without_schlick(mut self) -> Self {
        self.slack[2] = f64::INFINITY;
        self
    }
}

/// Every level.
const EVERY: &[Quality] = &Quality::ALL;

/// The levels whose values are integrals. [`Quality::Fast`] takes the four directions of a light and bends the horizon: its
/// values depend on how a light is cut and turned, by more than rounding and by no documented bound.
const INTEGRALS: &[Quality] = &[Quality::Standard, Quality::Fine, Quality::Finest];

const fn relation(
    name: &'static str,
    about: &'static str,
    levels: &'static [Quality],
    pose: fn(&Case, &mut Random) -> Option<Posed>,
) -> Relation {
    Relation { name, about, levels, pose }
}

/// Every relation.
pub const RELATIONS: &[Relation] = &[
    relation(
        "parts at a diagonal",
        "A polygon gives what the two parts give that a diagonal makes of it; no coordinate is rounded.",
        INTEGRALS,
        split::at_diagonal,
    ),
    relation(
        "parts at any chord",
        "A convex polygon gives what the two parts give that a chord from edge to edge makes of it.",
        INTEGRALS,
        split::at_chord,
    ),
    relation(
        "another first vertex",
        "It does not matter with which vertex an outline begins.",
        INTEGRALS,
        outline::another_first,
    ),
    relation(
        "quad and polygon",
        "The function of quads gives what the functions of polygons give.",
        INTEGRALS,
        outline::by_either_function,
    ),
    relation(
        "more vertices",
        "Vertices given twice, and further ones halfway between two, change nothing.",
        INTEGRALS,
        outline::more_vertices,
    ),
    relation("both sides", "A two-sided light gives what its sides give.", INTEGRALS, outline::both_sides),
    relation("one side", "No point sees both sides of a light.", INTEGRALS, outline::one_side),
    relation(
        "two-sided, reversed",
        "It does not matter which way round a two-sided light is.",
        INTEGRALS,
        outline::either_way,
    ),
    relation("a part", "A part of a light gives no more than all of it.", INTEGRALS, outline::part_of),
    relation(
        "vertices along their rays",
        "A triangle whose vertices move along their rays, each by a power of two, covers the same directions.",
        INTEGRALS,
        moves::slid,
    ),
    relation(
        "named otherwise",
        "Other conjugate half-axes are the same disk; a tube has no first end.",
        INTEGRALS,
        moves::named_otherwise,
    ),
    relation(
        "scaled by a power of two",
        "Nothing in the arithmetic has a length of its own: no bit changes.",
        EVERY,
        moves::scaled,
    ),
    relation(
        "moved by an exact amount",
        "Only differences of places count: no bit changes.",
        EVERY,
        moves::shifted,
    ),
    relation(
        "lengths of normal and view",
        "Powers of two on normal and view change no bit.",
        EVERY,
        surface::lengths_of_directions,
    ),
    relation(
        "axes exchanged",
        "The axes of coordinates may be exchanged and turned round, handedness with them.",
        INTEGRALS,
        moves::exchanged,
    ),
    relation("everything turned", "Turning everything changes nothing.", INTEGRALS, moves::turned),
    relation(
        "turned about the normal",
        "Turning light and view about the normal changes nothing.",
        INTEGRALS,
        moves::turned_about_the_normal,
    ),
    relation(
        "light and complement",
        "The faces of a pyramid over the light, the point inside, give 1 and the albedo.",
        INTEGRALS,
        around::with_complement,
    ),
    relation("closed box", "Six walls around the point give 1 and the albedo.", INTEGRALS, around::in_a_box),
    relation(
        "disk and polygons",
        "A disk gives no less than the polygon of points on its rim, and no more than that of its tangents.",
        INTEGRALS,
        around::between_polygons,
    ),
    relation(
        "sphere and silhouette",
        "A sphere gives what the disk gives that its tangents from the point touch.",
        INTEGRALS,
        around::as_its_silhouette,
    ),
    relation(
        "sphere and polyhedra",
        "A sphere gives no less than the octahedron in it, and no more than the cube around it.",
        INTEGRALS,
        around::between_polyhedra,
    ),
    relation(
        "identity lobe",
        "A lobe whose matrix is the identity reflects what the form factor says.",
        &[Quality::Standard],
        surface::identity_is_lambert,
    ),
    relation(
        "form factor and view",
        "The form factor depends on neither view nor roughness.",
        INTEGRALS,
        surface::form_factor_has_no_view,
    ),
    relation(
        "one step",
        "The next representable number in the place of any one moves the value by what the two may be off.",
        INTEGRALS,
        surface::one_step,
    ),
];
