//! What fuzzers hand bytes to: everything that reads input, and what must hold whatever the bytes are. A target panics
//! where it does not. Shared by the fuzzer and by an ordinary test, which replays the corpus.

mod bytes;
mod lights;
mod memory;
mod reports;
mod scenes;
mod tables;
mod texts;

pub use memory::Counting;

/// Something that reads input.
pub struct Target {
    /// Its name, and that of its folder in the corpus.
    pub name: &'static str,
    /// Reads the bytes, and panics where what must hold does not.
    pub run: fn(&[u8]),
    /// MiB that it may take besides the input.
    pub memory: usize,
}

/// Every target.
pub const ALL: &[Target] = &[
    Target { name: "scene", run: scenes::scene, memory: 256 },
    Target { name: "case", run: scenes::case, memory: 256 },
    Target { name: "picture", run: scenes::picture, memory: 256 },
    Target { name: "table", run: tables::table, memory: 256 },
    Target { name: "effects", run: texts::effects, memory: 256 },
    Target { name: "source", run: texts::source, memory: 256 },
    Target { name: "light", run: lights::light, memory: 256 },
    Target { name: "surface", run: lights::surface, memory: 256 },
    Target { name: "baseline", run: reports::baseline, memory: 256 },
    Target { name: "measured", run: reports::measured, memory: 256 },
];

impl Target {
    /// Runs the target within its memory.
    pub fn check(&self, data: &[u8]) {
        memory::within(self.memory << 20, || (self.run)(data));
    }
}

/// Asserts that an error is one sentence for a reader: a line that says something.
fn assert_sentence(error: &dyn core::fmt::Display) {
    let text = error.to_string();
    assert!(text.trim().len() > 10, "an error that says nothing: {text:?}");
    assert!(!text.contains('\n'), "an error of several lines: {text:?}");
}
