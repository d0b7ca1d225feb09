//! Instructions that a processor executes for each invocation on lavapipe, as valgrind's callgrind counts them: unlike times
//! they do not depend on what else the machine does. lavapipe runs both sides of most branches, so this is what a wave takes
//! whose invocations go all ways.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::CostsError;
use super::bench::{Adapter, Bench};
use super::kernel::Kernel;
use super::timing::{job, timed_inputs};

/// Invocations of the shorter dispatch; the longer one has twice as many, and the difference is what is counted.
const INVOCATIONS: u32 = 4096;

/// Counts the instructions of some methods. `child` starts a process that calls [`callgrind_child`] with the same methods; it
/// is run within valgrind.
///
/// # Errors
///
/// If valgrind is missing or the process fails.
pub fn callgrind(count: usize, child: &Command, folder: &Path) -> Result<Vec<f64>, CostsError> {
    let failed = |what: &dyn core::fmt::Display| CostsError::Callgrind(what.to_string());
    if !cfg!(any(target_arch = "x86_64", target_arch = "aarch64")) {
        return Err(failed(&"it is not told when to count on this kind of processor"));
    }
    let out = folder.join("callgrind.out");
    let mut command = Command::new("valgrind");
    command
        .args(["--tool=callgrind", "--instr-atstart=no", "--smc-check=all-non-file", "--quiet"])
        .arg(format!("--callgrind-out-file={}", out.display()))
        .arg(child.get_program())
        .args(child.get_args())
        .envs(child.get_envs().filter_map(|(name, value)| Some((name, value?))))
        // One thread: which one does what would depend on the moment.
        .env("LP_NUM_THREADS", "0");
    let output = command.output().map_err(|error| {
        failed(&format!("valgrind does not start ({error}); it comes with Debian's package valgrind"))
    })?;
    if !output.status.success() {
        return Err(failed(&String::from_utf8_lossy(&output.stderr).trim()));
    }
    let totals: Vec<f64> = (1..=2 * count).map(|at| total(&numbered(&out, at))).collect::<Result<_, _>>()?;
    Ok(totals.chunks(2).map(|pair| (pair[1] - pair[0]) / f64::from(INVOCATIONS)).collect())
}

fn numbered(out: &Path, at: usize) -> PathBuf {
    PathBuf::from(format!("{}.{at}", out.display()))
}

/// The instructions that a dump adds up to.
fn total(dump: &Path) -> Result<f64, CostsError> {
    let text = std::fs::read_to_string(dump)
        .map_err(|error| CostsError::Callgrind(format!("{}: {error}", dump.display())))?;
    let total = text.lines().find_map(|line| line.strip_prefix("totals: ")?.trim().parse().ok());
    total.ok_or_else(|| CostsError::Callgrind(format!("{} has no totals", dump.display())))
}

/// Runs dispatches of each method on lavapipe, telling callgrind to count each and to dump the count.
///
/// # Errors
///
/// If there is no lavapipe, or it refuses a kernel.
pub fn callgrind_child(kernels: &[Kernel]) -> Result<(), CostsError> {
    let bench = Bench::open(&Adapter::Software)?;
    let inputs = timed_inputs();
    for kernel in kernels {
        let prepared = bench.prepare(&job(kernel, &inputs, 2 * INVOCATIONS))?;
        // What is done once is done here.
        bench.run(&prepared, 64, 1)?;
        for invocations in [INVOCATIONS, 2 * INVOCATIONS] {
            request(START);
            bench.run(&prepared, invocations, 1)?;
            request(DUMP);
            request(STOP);
        }
    }
    Ok(())
}

/// Requests of callgrind's, by their numbers in valgrind's `callgrind.h`.
const DUMP: usize = 0x4354_0000;
const START: usize = DUMP + 4;
const STOP: usize = DUMP + 5;

/// Asks something of callgrind by a sequence of instructions that does nothing elsewhere (valgrind's manual, "The client request
/// mechanism").
#[cfg(target_arch = "x86_64")]
fn request(code: usize) {
    let block = [code, 0, 0, 0, 0, 0];
    // SAFETY: the rotations add up to whole turns, and exchanging a register with itself does nothing; valgrind reads the
    // block, whose address is in rax, and writes rdx.
    unsafe {
        core::arch::asm!(
            "rol rdi, 3",
            "rol rdi, 13",
            "rol rdi, 61",
            "rol rdi, 51",
            "xchg rbx, rbx",
            in("rax") block.as_ptr(),
            inout("rdx") 0_usize => _,
            inout("rdi") 0_usize => _,
        );
    }
}

/// As for the other processor.
#[cfg(target_arch = "aarch64")]
fn request(code: usize) {
    let block = [code, 0, 0, 0, 0, 0];
    // SAFETY: as above; valgrind reads the block, whose address is in x4, and writes x3.
    unsafe {
        core::arch::asm!(
            "ror x12, x12, #3",
            "ror x12, x12, #13",
            "ror x12, x12, #51",
            "ror x12, x12, #61",
            "orr x10, x10, x10",
            in("x4") block.as_ptr(),
            inout("x3") 0_usize => _,
            inout("x12") 0_usize => _,
        );
    }
}

/// Elsewhere nothing is asked, and [`callgrind`] refuses.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
fn request(_code: usize) {}
