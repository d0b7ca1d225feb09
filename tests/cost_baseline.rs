//! No level costs more than it did: operations that its executed paths take, counted alike everywhere, and what Mesa's compiler for
//! AMD's processors makes of it, compared with what the same version of that compiler made before.
//!
//! A machine with another version of Mesa than any in `docs/cost-baseline.toml` fails with a sentence that says so: at a commit whose
//! costs are known to be good, the command below adds that version beside the others.

use std::process::Command;

use softbox::report::cost::FAMILIES;
use softbox::report::costs::{Baseline, Kernel, Options, measure, serve};

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/cost-baseline.toml");
const UPDATE: &str =
    "SOFTBOX_UPDATE_BASELINE=1 cargo test --release -p softbox --features report --test cost_baseline";
/// Tells a process that it is to compile.
const SERVE: &str = "SOFTBOX_TEST_COMPILES";

#[test]
#[ignore = "it is the process that the other test starts to compile in"]
fn compiler() {
    if std::env::var_os(SERVE).is_some() {
        serve().unwrap_or_else(|error| panic!("{error}"));
    }
}

#[test]
fn no_level_costs_more_than_it_did() {
    let this = std::env::current_exe().unwrap_or_else(|error| panic!("{error}"));
    let child = || {
        let mut command = Command::new(&this);
        command.args(["--exact", "compiler", "--ignored", "--nocapture"]).env(SERVE, "1");
        command
    };
    let mut options = Options::quick(UPDATE);
    options.families = FAMILIES.map(str::to_owned).to_vec();
    options.compiler = Some(&child);
    let costs = measure(&Kernel::levels(), &options, &mut |_| ()).unwrap_or_else(|error| panic!("{error}"));
    let devices = costs.origins.iter().filter_map(|origin| origin.device.split_once(", radv "));
    let compiler = devices.map(|(_, version)| format!("radv {version}")).next().unwrap_or_default();
    let now = Baseline::of(&costs, &compiler);
    assert!(now.executed.len() >= 3 * Kernel::levels().len() && !now.compiled.is_empty(), "{now:?}");
    let old = match std::fs::read_to_string(FILE) {
        Ok(text) => Baseline::read(&text).unwrap_or_else(|error| panic!("{FILE}: {error}")),
        Err(_) => Baseline::default(),
    };
    if std::env::var_os("SOFTBOX_UPDATE_BASELINE").is_some() {
        let text = old.updated(now).write().unwrap_or_else(|error| panic!("{error}"));
        let header =
            format!("# What costs must not grow beyond; see tests/cost_baseline.rs.\n# {UPDATE}\n\n");
        std::fs::write(FILE, header + &text).unwrap_or_else(|error| panic!("{FILE}: {error}"));
        return;
    }
    old.check(&now, UPDATE).unwrap_or_else(|error| panic!("{error}"));
}
