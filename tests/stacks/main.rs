//! The same hard cases through every shader stack that this machine has: each keeps the stated bounds.
//!
//! `cargo test --release -p softbox --all-features --test stacks` runs what `tests/tools/install` installs;
//! `tests/stacks/run` installs browsers, further compilers and drivers, runs all and writes `docs/stacks.jsonl`.
//! Arguments are those of any test: a part of a name selects.

#[path = "../common/tools.rs"]
mod tools;

mod compile;
mod driver;
mod level;
mod native;
mod web;

use std::process::ExitCode;
use std::sync::{Arc, Mutex};

use libtest_mimic::{Arguments, Failed, Trial};
use softbox::effects::Quality;
use softbox::stability::{REORDERED, Stack, StackRow};

use level::Level;

/// Whether everything that `tests/stacks/install` brings is to be run as well.
fn is_long() -> bool {
    std::env::var_os("SOFTBOX_STACKS").is_some_and(|value| value == "all")
}

/// What must hold of a stack.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Promise {
    /// The stated bounds, times a factor.
    Bounds(f64),
    /// The stated bounds, for inputs within [`REORDERED`]: of what reorders products no more is promised.
    InRange,
    /// It must go beyond them, or the bounds, the cases or this harness could not fail.
    Beyond,
}

/// What a stack gave: values, and what it says of itself.
struct Output {
    values: Vec<[f32; 3]>,
    version: String,
}

type Run = dyn Fn(&Level) -> Result<Output, String> + Send + Sync;

/// One way to values.
struct Way {
    driver: String,
    path: String,
    levels: Vec<Quality>,
    promise: Promise,
    run: Box<Run>,
}

type Rows = Arc<Mutex<Vec<StackRow>>>;

fn trial(way: &Arc<Way>, quality: Quality, rows: &Rows) -> Trial {
    let name = format!("{}, {}: {quality}", way.path, way.driver);
    let (way, rows, filter) = (Arc::clone(way), Arc::clone(rows), name.clone());
    Trial::test(name, move || {
        let level = Level::of(quality);
        let output = (way.run)(level)?;
        let stack = Stack {
            driver: way.driver.clone(),
            path: way.path.clone(),
            version: output.version,
            command: format!("tests/stacks/run '{filter}'"),
        };
        if output.values.len() != level.inputs.cases.len() {
            return Err(Failed::from(format!(
                "{} values of {} cases",
                output.values.len(),
                level.inputs.cases.len()
            )));
        }
        let row = level.inputs.row(&stack, &output.values, level.reference()?);
        println!(
            "{filter}: {:.2} and {:.2} of the bounds ({} {}); p99.9 {:.1e} {:.1e} {:.1e}; {} of {} beyond, {} not finite, {} numbers differ from the reference, by up to {:.1e}; {}",
            row.share,
            row.specular_share,
            row.family,
            row.worst,
            row.differences[0].p999,
            row.differences[1].p999,
            row.differences[2].p999,
            row.beyond,
            row.inputs,
            row.not_finite,
            row.different,
            row.from_reference,
            row.version
        );
        let keeps = match way.promise {
            Promise::Bounds(factor) if factor <= 1.0 => row.beyond == 0 && row.worst_share() <= factor,
            Promise::Bounds(factor) => row.not_finite == 0 && row.worst_share() <= factor,
            Promise::InRange => {
                let outcomes = level.inputs.outcomes(&output.values);
                let mut offenders = outcomes.values().flat_map(|outcome| &outcome.offenders);
                offenders.all(|index| !level.inputs.cases[*index].is_within(&REORDERED))
            }
            Promise::Beyond => row.beyond > 0,
        };
        let verdict = if keeps {
            Ok(())
        } else {
            let said = level.inputs.offences(&output.values);
            Err(Failed::from(format!("{:?} does not hold of {row:?}\n{}", way.promise, said.join("\n"))))
        };
        rows.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).push(row);
        verdict
    })
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    // Drivers read their environment once, and some end the process that they run in: each has a process of its own.
    if let [first, rest @ ..] = &arguments[..]
        && first == driver::CHILD
    {
        return driver::child(rest);
    }
    let mut arguments = Arguments::from_args();
    // Each stack uses all processors.
    arguments.test_threads = Some(1);
    let rows = Rows::default();
    let mut ways = driver::ways();
    ways.extend(native::ways());
    if is_long() {
        ways.extend(web::ways());
    }
    let trials = ways
        .into_iter()
        .map(Arc::new)
        .flat_map(|way| way.levels.iter().map(|level| trial(&way, *level, &rows)).collect::<Vec<_>>())
        .collect();
    let conclusion = libtest_mimic::run(&arguments, trials);
    if let Some(path) = std::env::var_os("SOFTBOX_STACKS_TABLE") {
        let rows = rows.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        let line =
            |row: &StackRow| serde_json::to_string(row).unwrap_or_else(|error| panic!("{error}")) + "\n";
        let text: String = rows.iter().map(line).collect();
        if let Err(error) = std::fs::write(&path, text) {
            eprintln!("cannot write {}: {error}", path.display());
            return ExitCode::FAILURE;
        }
    }
    conclusion.exit_code()
}
