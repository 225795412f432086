//! The command `gpu-check`.

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use gpu_check::kernel::Kernel;
use gpu_check::{Gpu, GpuError, planted, tapes};

#[derive(Parser)]
#[command(version, about)]
struct Arguments {
    /// Part of the name of the adapter; the fastest one without it.
    #[arg(long, global = true)]
    adapter: Option<String>,
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Every kernel on trees and decision tapes, event by event.
    Tapes {
        /// Number of trees, each with a tape of its own.
        #[arg(long, default_value_t = 2048)]
        trees: usize,
        /// Seed of the trees and tapes.
        #[arg(long, default_value_t = 1)]
        seed: u64,
    },
    /// Kernels with a mistake each: all have to be caught by `tapes`.
    Planted {
        /// Number of trees.
        #[arg(long, default_value_t = 1024)]
        trees: usize,
    },
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match run(&arguments) {
        Ok(true) => {
            println!("pass");
            ExitCode::SUCCESS
        }
        Ok(false) => {
            println!("fail");
            ExitCode::from(1)
        }
        Err(error) => {
            eprintln!("gpu-check: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}

/// Whether all was as it should be.
fn run(arguments: &Arguments) -> Result<bool, GpuError> {
    let gpu = Gpu::open(arguments.adapter.as_deref())?;
    println!("device: {}", gpu.name());
    match &arguments.command {
        Command::Tapes { trees, seed } => run_tapes(&gpu, *trees, *seed),
        Command::Planted { trees } => run_planted(&gpu, *trees),
    }
}

fn run_tapes(gpu: &Gpu, trees: usize, seed: u64) -> Result<bool, GpuError> {
    const BATCH: usize = 4096;
    let mut good = true;
    for from in (0..trees).step_by(BATCH) {
        let batch = tapes::Batch::new(gpu, tapes::cases(BATCH.min(trees - from), seed.wrapping_add(from as u64)))?;
        for kernel in (1..=3).flat_map(Kernel::all) {
            let start = std::time::Instant::now();
            let report = tapes::compare(gpu, &batch, &kernel, &tapes::unchanged)?;
            let tapes::Report { name, compared, too_deep, mismatches, first } = report;
            let seconds = start.elapsed().as_secs_f32();
            println!("{name:20} {compared:6} searches, {too_deep:5} too deep, {mismatches} mismatches, {seconds:.1} s");
            if let Some(first) = first {
                println!("{first}");
            }
            good &= mismatches == 0;
        }
    }
    Ok(good)
}

fn run_planted(gpu: &Gpu, trees: usize) -> Result<bool, GpuError> {
    let batch = tapes::Batch::new(gpu, tapes::cases(trees, 1))?;
    let mut good = true;
    for bug in planted::BUGS {
        let seen = planted::hunt(gpu, &batch, bug)?;
        let verdict = if seen > 0 { "caught" } else { "NOT CAUGHT" };
        println!("{verdict}: {seen:5} searches, {:20} {}", bug.kernel, bug.name);
        good &= seen > 0;
    }
    Ok(good)
}
