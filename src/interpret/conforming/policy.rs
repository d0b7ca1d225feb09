//! What a device makes of the freedom that WGSL leaves it.

/// Whether a device does what it may do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Freedom {
    /// It does not.
    #[default]
    Never,
    /// It does whenever it may.
    Always,
    /// Chance decides for each operation.
    Either,
}

/// Which of the permitted results an operation comes to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rounding {
    /// What IEEE 754 makes of it in single precision, square roots included.
    #[default]
    Plain,
    /// The nearest; a square root is 1 over an inverse one.
    Nearest,
    /// The least.
    Down,
    /// The largest.
    Up,
    /// The one nearest to zero.
    TowardZero,
    /// Any.
    Random,
}

/// How a texture's texels are weighted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// By the coordinate.
    #[default]
    Exact,
    /// By the coordinate in texels, rounded up or down to so many binary places. Direct3D asks for 8 at least (Direct3D 11.3
    /// functional specification, 7.18.16.1, and `D3D11_SUBTEXEL_FRACTIONAL_BIT_COUNT`), and so does Vulkan's profile
    /// "Roadmap 2022"; Vulkan alone asks for 4 (`subTexelPrecisionBits`).
    FixedPoint(u32),
}

/// A device that does what WGSL allows ("Differences from IEEE-754", "Floating Point Accuracy" and "Reassociation and
/// Fusion" of its specification).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Policy {
    /// Which of the permitted results operations come to.
    pub rounding: Rounding,
    /// Whether subnormal operands and results become zero.
    pub flushing: Freedom,
    /// Whether the sign of a zero is the other one.
    pub zeros: Freedom,
    /// Whether a sum takes a product without rounding that first.
    pub fusion: Freedom,
    /// Whether (a + b) + c is a + (b + c) or (a + c) + b, for differences alike; whether (a b) c is a (b c) or (a c) b, (a b) / c is
    /// (a / c) b, and (a / b) c is (a c) / b.
    pub reassociation: Freedom,
    /// How textures are filtered.
    pub filter: Filter,
    /// Whether it is one device: the same operation on the same numbers comes to the same, and what a compiler decides holds
    /// wherever it meets that place of the text. No word of the specification says so, but every device is like that.
    pub consistent: bool,
    /// What chance starts from.
    pub seed: u64,
}

impl Policy {
    /// Plain single precision.
    pub const fn exact() -> Self {
        Self {
            rounding: Rounding::Plain,
            flushing: Freedom::Never,
            zeros: Freedom::Never,
            fusion: Freedom::Never,
            reassociation: Freedom::Never,
            filter: Filter::Exact,
            consistent: true,
            seed: 0,
        }
    }

    /// Whatever is permitted, by chance, but as one device; textures are filtered exactly.
    pub const fn random(seed: u64) -> Self {
        Self {
            rounding: Rounding::Random,
            flushing: Freedom::Either,
            zeros: Freedom::Either,
            fusion: Freedom::Either,
            reassociation: Freedom::Either,
            filter: Filter::Exact,
            consistent: true,
            seed,
        }
    }

    /// The order of operations that [`Policy::random`] of the same seed has, every operation to nearest.
    pub const fn ordered(seed: u64) -> Self {
        Self { rounding: Rounding::Nearest, ..Self::random(seed) }
    }

    /// The same, but for every operation anew.
    pub const fn capricious(self) -> Self {
        Self { consistent: false, ..self }
    }

    /// The same with another rounding.
    pub const fn with_rounding(self, rounding: Rounding) -> Self {
        Self { rounding, ..self }
    }

    /// The same with another filter.
    pub const fn with_filter(self, filter: Filter) -> Self {
        Self { filter, ..self }
    }

    /// Devices that differ as much as they may, with names: of each rounding one that keeps subnormal numbers and the order of
    /// the text, and one that flushes, fuses and puts in another order; then `count` that leave it to chance.
    pub fn devices(count: u64) -> Vec<(String, Self)> {
        let named = [
            ("nearest", Rounding::Nearest),
            ("down", Rounding::Down),
            ("up", Rounding::Up),
            ("toward zero", Rounding::TowardZero),
        ];
        let mut devices = Vec::new();
        for (name, rounding) in named {
            let strict = Self::exact().with_rounding(rounding);
            let [flushing, fusion] = [Freedom::Always; 2];
            devices.push((name.to_owned(), strict));
            devices.push((format!("{name}, fused and flushed"), Self { flushing, fusion, ..strict }));
        }
        devices.extend((1..=count).map(|seed| (format!("chance {seed}"), Self::random(seed))));
        devices
    }
}
