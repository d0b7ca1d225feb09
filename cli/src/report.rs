//! `softbox report`: what accuracy costs in time.

use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;

use anyhow::Context;
use clap::Args;
use softbox::input;
use softbox::report::cost::FAMILIES;
use softbox::report::costs::{self, Adapter, Effort, Kernel, Measured, Options};
use softbox::report::page;
use softbox::report::{Settings, gather};

use crate::bake::write_file;
use crate::progress;
use crate::say::say;

/// Bytes of the largest file of times.
const LARGEST_FILE: usize = 16 << 20;

#[derive(Args)]
pub struct ReportArguments {
    /// Folder of the report; an older report there is replaced.
    #[arg(long, default_value = "softbox-report", value_name = "DIR")]
    out: PathBuf,
    /// Be done in seconds: fewer lights, operations counted and nothing timed or rendered.
    #[arg(long)]
    quick: bool,
    /// A table to compare, in the published layout or this library's: raw, DDS, or text. May be given more than once.
    #[arg(long, value_name = "FILE")]
    compare_table: Vec<PathBuf>,
    /// Do not count instructions in valgrind's callgrind.
    #[arg(long)]
    without_callgrind: bool,
    /// Times that `--gpu` wrote before, to be shown with the others. May be given more than once.
    #[arg(long, value_name = "FILE")]
    measured: Vec<PathBuf>,
    /// Time every method on a graphics processor by its own clock, write that to --out as JSON, and nothing else.
    #[arg(long, conflicts_with_all = ["quick", "compare_table", "without_callgrind", "measured"])]
    gpu: bool,
    /// With --gpu, the adapter whose name holds this text.
    #[arg(long, value_name = "NAME", requires = "gpu", conflicts_with = "quick")]
    adapter: Option<String>,
    /// Compile what standard input holds, in a process of its own.
    #[arg(long, hide = true)]
    compile: bool,
    /// Run every method for callgrind to count.
    #[arg(long, hide = true)]
    count: bool,
}

/// Measures and writes the report.
///
/// # Errors
///
/// If something that is asked for is missing, or the report cannot be written.
pub fn report(arguments: &ReportArguments) -> anyhow::Result<()> {
    if arguments.compile {
        return Ok(costs::serve()?);
    }
    if arguments.count {
        return Ok(costs::callgrind_child(&Kernel::all())?);
    }
    if arguments.gpu {
        return gpu(arguments);
    }
    page::check_folder(&arguments.out)?;
    let started = Instant::now();
    let this = std::env::current_exe().context("cannot find this program to start it again")?;
    let again = |argument: &str| {
        let mut command = Command::new(&this);
        command.args(["report", argument]);
        command
    };
    let compiler = || again("--compile");
    let command =
        std::iter::once("softbox".to_owned()).chain(std::env::args().skip(1)).collect::<Vec<_>>().join(" ");
    let scratch = tempfile::tempdir().context("cannot make a folder for temporary files")?;
    let measured = arguments.measured.iter().map(|path| {
        let text = input::read_text(path, LARGEST_FILE)
            .with_context(|| format!("cannot read {}", path.display()))?;
        Measured::read(&text).with_context(|| path.display().to_string())
    });
    let mut options = Options::quick(&command);
    options.compiler = Some(&compiler);
    options.measured = measured.collect::<anyhow::Result<_>>()?;
    options.families = vec![FAMILIES[1].to_owned()];
    if !arguments.quick {
        options.families = FAMILIES.map(str::to_owned).to_vec();
        if !arguments.without_callgrind {
            options.callgrind = Some((again("--count"), scratch.path().to_owned()));
        }
        options.lavapipe = true;
        options.effort = Effort::WHOLE;
        options.random = 256;
        options.growth = true;
        options.pixels = ["standard", "fine", "finest", "published"].map(str::to_owned).to_vec();
    }
    let settings = Settings {
        quick: arguments.quick,
        costs: options,
        tables: arguments.compare_table.clone(),
        scratch: scratch.path().to_owned(),
    };
    let bar = progress::bar("Measuring");
    let gathered = gather(&settings, &|what, share| {
        bar.set_message(what.to_owned());
        progress::advance(&bar, share);
    });
    bar.finish_and_clear();
    let gathered = gathered?;
    page::write(&gathered.report, &gathered.lobes, &gathered.pictures, &arguments.out)?;
    say!("{}", arguments.out.join("index.html").display());
    say!("Took {:.0} s.", started.elapsed().as_secs_f64());
    Ok(())
}

fn gpu(arguments: &ReportArguments) -> anyhow::Result<()> {
    let adapter = arguments.adapter.clone().map_or(Adapter::Hardware, Adapter::Named);
    let measured = costs::time(&Kernel::all(), &adapter, Effort::WHOLE, "softbox report --gpu")?;
    let name: String = measured
        .device
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' })
        .collect();
    let name = name.split('-').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("-");
    std::fs::create_dir_all(&arguments.out)
        .with_context(|| format!("cannot make the folder {}", arguments.out.display()))?;
    let path = arguments.out.join(format!("{name}.json"));
    write_file(&path, (serde_json::to_string_pretty(&measured)? + "\n").as_bytes())?;
    for time in &measured.times {
        say!("{:16} {:>10.2} ns {:>8.2}", time.method, time.nanoseconds, time.ratio);
    }
    say!("{}", path.display());
    Ok(())
}
