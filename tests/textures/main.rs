//! Lights with a picture on them.

mod accuracy;
#[path = "../common/mod.rs"]
mod common;
mod device;
mod lookup;
mod pyramid;
mod truth;
