//! The command line of Softbox.

mod bake;
mod cost;
mod effects;
mod eval;
mod model;
mod number;
mod package;
mod prefilter;
mod progress;
mod quality;
mod render;
mod report;
mod say;
mod select;
mod stability;

use clap::error::ErrorKind;
use clap::{Parser, Subcommand};

/// Area lights by linearly transformed cosines: bake the table, translate the include, evaluate lights.
///
/// Errors are one sentence on standard error, and the exit code is then 2.
#[derive(Parser)]
#[command(name = "softbox", version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Write the drop-in package: the include in every language, the tables in every format, a guide.
    Build(package::BuildArguments),
    /// Bake one table into one file.
    Bake(bake::BakeArguments),
    /// Blur a picture for a textured light: write its mipmaps.
    Prefilter(prefilter::PrefilterArguments),
    /// Render a scene file, on a device and by numerical integration.
    Render(render::RenderArguments),
    /// Tell which effects a scene calls for.
    Effects(effects::EffectsArguments),
    /// Write the part of the include that a set of effects calls for, in any language.
    Select(select::SelectArguments),
    /// Tell what sets of effects cost, as compiled for AMD's processors; none needs to be there.
    Cost(cost::CostArguments),
    /// Measure what accuracy costs in time: every quality level and what else there is, as a page, Markdown and tables.
    Report(report::ReportArguments),
    /// Try hard cases, where lights and surfaces lie so that arithmetic fails, on this machine's devices: a table, a page, pictures.
    Stability(stability::StabilityArguments),
    /// Evaluate surfaces and lights given as JSON Lines.
    #[command(long_about = eval::HELP)]
    Eval(eval::EvalArguments),
}

/// Says what is wrong with the arguments in one line; help and version are no errors.
fn refuse(error: &clap::Error) -> ! {
    if !error.use_stderr() || error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        error.exit();
    }
    let text = error.render().to_string();
    let paragraphs =
        text.split("\n\n").map(|paragraph| paragraph.split_whitespace().collect::<Vec<_>>().join(" "));
    let said = paragraphs.filter(|paragraph| {
        !paragraph.is_empty()
            && !paragraph.starts_with("Usage:")
            && !paragraph.starts_with("For more information")
    });
    eprintln!("{}; softbox --help tells more", said.collect::<Vec<_>>().join("; "));
    std::process::exit(2);
}

fn main() {
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        // Some drivers complain on standard error when there is no such folder, though nothing is put there.
        // SAFETY: no other thread runs yet.
        unsafe { std::env::set_var("XDG_RUNTIME_DIR", std::env::temp_dir()) };
    }
    let arguments = Arguments::try_parse().unwrap_or_else(|error| refuse(&error));
    let result = match arguments.command {
        Command::Build(arguments) => package::build(&arguments),
        Command::Bake(arguments) => bake::bake(&arguments),
        Command::Prefilter(arguments) => prefilter::prefilter(&arguments),
        Command::Render(arguments) => render::render(&arguments),
        Command::Effects(arguments) => effects::effects(&arguments),
        Command::Select(arguments) => select::select(&arguments),
        Command::Cost(arguments) => cost::cost(&arguments),
        Command::Report(arguments) => report::report(&arguments),
        Command::Stability(arguments) => stability::stability(&arguments),
        Command::Eval(arguments) => eval::eval(&arguments),
    };
    if let Err(error) = result {
        eprintln!("error: {error:#}");
        std::process::exit(2);
    }
}
