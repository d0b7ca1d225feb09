//! What the page says in words.

use crate::stability::{FACTORS, FILTERED, REORDERED};

/// What is promised and what is not.
pub(super) fn introduction(command: &str) -> String {
    format!(
        "# Hard cases

_Made from the code by `{command}`; a test asserts that this is what the code makes._

A hard case is a place of light and surface where arithmetic of single precision goes wrong, or nearly: a light that touches the
surface, vanishes in the distance, lies on the horizon, is seen edge-on; a mirror; a view along the normal. The catalogue below makes
inputs of every family that was found, in public trackers, in shader code and by search. Each input carries the bound that must hold.

**Promised, for every finite input at every level:** values are finite. The form factor is between 0 and 1, specular light
between 0 and the albedo of its lobes, Schlick's part between 0 and the specular light.

**Promised at `standard`, `fine` and `finest`:** the bounds of the tables below, against exact arithmetic on the same input. The form
factor of polygons, disks and spheres is that of the light itself, so the bound is on the whole error. Specular light is compared with the same
lobes in exact arithmetic: how close those lobes are to GGX is another question, which the README's accuracy answers. Light
that comes from below the surface or from a light's back is exactly zero.

**Promised at `fast`:** disks, spheres and tubes keep those bounds, but for specular light seen within a few degrees of the normal, where
the lobe is not quite round and the rounding of the view turns it. Quads and polygons are its own closed forms within 1e-3, specular light within
2e-3 more than the catalogue's bound, in the families that have numbers in the last table of the catalogue; elsewhere physical values, no more.

**Bounds hold** on devices that round to nearest and keep the order of the text. On any other device that conforms to WGSL, bounds
are {} times as wide for form factors and {} times for specular light. Values stay finite on devices that also reorder sums and
products, where the largest number of each vector and each radius is nothing or within {:e} to {:e}. A texture filter with weights of 8 bits,
as graphics processors have it, moves specular light by up to {} of the albedo besides.

**Not promised:** digits that coordinates do not have. Where a bound follows a gap, a size or an offset, the table gives the range that it has
over the family. Bounds of 1 or more say no more than physics and count as `physical`.
",
        FACTORS[0],
        FACTORS[1],
        REORDERED.start(),
        REORDERED.end(),
        FILTERED
    )
}

/// How to have the numbers again.
pub(super) const AGAIN: &str = "
## Again

```sh
cargo run --release -- stability                           # the catalogue on this machine's devices, as a table; seconds
cargo run --release -- stability --out softbox-stability   # with every chart, the curves' numbers, scenes by both forms
cargo run --release -- stability --docs docs               # this page
tests/stacks/run                                           # every driver, compiler and browser; half an hour
cargo test --release -p softbox --all-features --test conforming   # the worst device that conforms
```
";
