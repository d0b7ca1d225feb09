//! `softbox cost`.

use std::process::Command;

use anyhow::{Context, bail};
use clap::Args;
use serde::{Deserialize, Serialize};
use softbox::effects::Effects;
use softbox::report::cost::{self, Cost};

use crate::quality::QualityArguments;
use crate::say::say;
use crate::select::print_text;

#[derive(Args)]
pub struct CostArguments {
    /// A set of effects, such as quad,polygon+ggx+two-sided; may be given more than once. Typical sets by
    /// default.
    #[arg(long, value_name = "SET")]
    effects: Vec<String>,
    #[command(flatten)]
    quality: QualityArguments,
    /// Families of AMD processors to compile for, as Mesa names them.
    #[arg(long, value_delimiter = ',', default_values = cost::FAMILIES, value_name = "NAMES")]
    family: Vec<String>,
    /// Print JSON instead of a table.
    #[arg(long)]
    json: bool,
    /// Compile for the family that the environment says, in this process.
    #[arg(long, hide = true)]
    here: bool,
}

/// What the program prints for one family.
#[derive(Serialize, Deserialize)]
struct Report {
    family: String,
    device: String,
    driver: String,
    /// The kernel of an engine without the include, then one with it and an empty set.
    sets: Vec<Row>,
}

#[derive(Serialize, Deserialize)]
struct Row {
    /// The set; none where the include is not there at all.
    effects: Option<String>,
    vector_registers: u64,
    scalar_registers: u64,
    spilled_registers: u64,
    scratch_bytes: u64,
    waves: u64,
    instructions: u64,
    latency: u64,
    inverse_throughput: u64,
    code_bytes: u64,
    wgsl_bytes: usize,
    glsl_bytes: usize,
    hlsl_bytes: usize,
    msl_bytes: usize,
    spirv_bytes: usize,
    table_bytes: usize,
}

pub fn cost(arguments: &CostArguments) -> anyhow::Result<()> {
    let mut sets = arguments.effects.iter().map(|text| text.parse()).collect::<Result<Vec<Effects>, _>>()?;
    if sets.is_empty() {
        sets = cost::typical();
    }
    let sets: Vec<Effects> = sets.into_iter().map(|set| arguments.quality.of(set)).collect();
    if arguments.here {
        let family = arguments.family.join(",");
        say!("{}", serde_json::to_string(&report(family, &sets)?)?);
        return Ok(());
    }
    let reports: Vec<Report> =
        arguments.family.iter().map(|family| child(family, &sets)).collect::<Result<_, _>>()?;
    let text = if arguments.json {
        serde_json::to_string_pretty(&reports)? + "\n"
    } else {
        let tables: String = reports.iter().map(costs).collect();
        tables + &reports.first().map(sizes).unwrap_or_default()
    };
    print_text(&text)
}

/// Measures in a process of its own: the driver reads the family from its environment, and ends the process
/// when it does not know it.
fn child(family: &str, sets: &[Effects]) -> anyhow::Result<Report> {
    let mut command = Command::new(std::env::current_exe()?);
    command.args(["cost", "--here", "--family", family]).envs(cost::environment(family)?);
    command.args(sets.iter().flat_map(|set| ["--effects".to_owned(), set.to_string()]));
    let output = command.output().context("cannot start another process")?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        let said = said.trim().trim_start_matches("error: ");
        match output.status.code() {
            Some(_) => bail!("{said}"),
            None => {
                bail!(
                    "the driver gave up on the family {family:?}: {said}; {} are common",
                    cost::FAMILIES.join(", ")
                )
            }
        }
    }
    serde_json::from_slice(&output.stdout).context("the other process printed no report")
}

fn report(family: String, sets: &[Effects]) -> anyhow::Result<Report> {
    let mut kernels = vec![cost::kernel_without_library()?];
    for set in sets {
        kernels.push(cost::kernel(*set)?);
    }
    let (compiler, costs) = cost::compile(&kernels)?;
    let names = std::iter::once(None).chain(sets.iter().map(Some));
    let rows = names.zip(&costs).zip(&kernels).map(|((set, cost), kernel)| row(set, *cost, kernel.len()));
    let sets = rows.collect::<Result<_, _>>()?;
    Ok(Report { family, device: compiler.device, driver: compiler.driver, sets })
}

fn row(set: Option<&Effects>, cost: Cost, spirv: usize) -> anyhow::Result<Row> {
    let sizes = set.map(|set| cost::sizes(*set)).transpose()?;
    let of = |size: fn(&cost::Sizes) -> usize| sizes.as_ref().map_or(0, size);
    Ok(Row {
        effects: set.map(Effects::to_string),
        vector_registers: cost.vector_registers,
        scalar_registers: cost.scalar_registers,
        spilled_registers: cost.spilled_registers,
        scratch_bytes: cost.scratch_bytes,
        waves: cost.waves,
        instructions: cost.instructions,
        latency: cost.latency,
        inverse_throughput: cost.inverse_throughput,
        code_bytes: cost.code_bytes,
        wgsl_bytes: of(|sizes| sizes.wgsl),
        glsl_bytes: of(|sizes| sizes.glsl),
        hlsl_bytes: of(|sizes| sizes.hlsl),
        msl_bytes: of(|sizes| sizes.msl),
        spirv_bytes: spirv,
        table_bytes: of(|sizes| sizes.table),
    })
}

const WITHOUT: &str = "(without the include)";

fn costs(report: &Report) -> String {
    let mut text = format!("{}, {}:\n\n", report.device, report.driver);
    text.push_str("| effects | VGPR | SGPR | waves | instructions | inverse throughput | latency | code bytes | spilled | scratch |\n");
    text.push_str("|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for row in &report.sets {
        text.push_str(&format!(
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n",
            row.effects.as_deref().unwrap_or(WITHOUT),
            row.vector_registers,
            row.scalar_registers,
            row.waves,
            row.instructions,
            row.inverse_throughput,
            row.latency,
            row.code_bytes,
            row.spilled_registers,
            row.scratch_bytes
        ));
    }
    text + "\n"
}

fn sizes(report: &Report) -> String {
    let mut text =
        String::from("Bytes of the include in each language, of the kernel in SPIR-V, and of the table:\n\n");
    text.push_str("| effects | WGSL | GLSL | HLSL | MSL | SPIR-V | table |\n");
    text.push_str("|---|---:|---:|---:|---:|---:|---:|\n");
    for row in &report.sets {
        text.push_str(&format!(
            "| {} | {} | {} | {} | {} | {} | {} |\n",
            row.effects.as_deref().unwrap_or(WITHOUT),
            row.wgsl_bytes,
            row.glsl_bytes,
            row.hlsl_bytes,
            row.msl_bytes,
            row.spirv_bytes,
            row.table_bytes
        ));
    }
    text
}
