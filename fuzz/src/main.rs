//! libFuzzer with one of the targets, the one that the variable SOFTBOX_FUZZ_TARGET names.

#![no_main]

mod targets;

use std::sync::OnceLock;

use targets::Target;

#[global_allocator]
static MEMORY: targets::Counting = targets::Counting;

static TARGET: OnceLock<&'static Target> = OnceLock::new();

libfuzzer_sys::fuzz_target!(
    init: {
        let name = std::env::var("SOFTBOX_FUZZ_TARGET").unwrap_or_default();
        let names: Vec<_> = targets::ALL.iter().map(|target| target.name).collect();
        let target = targets::ALL.iter().find(|target| target.name == name);
        let target = target.unwrap_or_else(|| panic!("there is no target {name:?}; all are {names:?}"));
        TARGET.get_or_init(|| target);
    },
    |data: &[u8]| {
        if let Some(target) = TARGET.get() {
            target.check(data);
        }
    }
);
