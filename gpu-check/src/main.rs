//! The command `gpu-check`.

mod commands;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use gpu_check::bench::Setting;
use gpu_check::{Checks, Gpu, GpuError, probe};

#[derive(Parser)]
#[command(version, about)]
struct Arguments {
    /// Part of the name of the adapter. [default: the fastest adapter]
    #[arg(long, global = true)]
    adapter: Option<String>,
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Compare every kernel with the oracle on trees and decision tapes, event by event.
    Tapes {
        /// Number of trees, each with its own tape.
        #[arg(long, default_value_t = 2048)]
        trees: usize,
        /// Seed of the trees and tapes.
        #[arg(long, default_value_t = 1)]
        seed: u64,
    },
    /// Check every kernel on rays through generated scenes or files.
    Rays {
        /// Mesh files (PLY, OBJ). [default: generated scenes]
        scenes: Vec<PathBuf>,
        /// Number of rays through each scene.
        #[arg(long, default_value_t = 7000)]
        rays: usize,
    },
    /// Find exact closest hits on the device, settle uncertain rays on the CPU, and compare with the exact tracer.
    Exact {
        /// Mesh files (PLY, OBJ). [default: generated scenes]
        scenes: Vec<PathBuf>,
        /// Number of rays through each scene.
        #[arg(long, default_value_t = 7000)]
        rays: usize,
    },
    /// Build hash tables on the device, and certify them on the CPU.
    Hash {
        /// Mesh files (PLY, OBJ). [default: generated scenes]
        scenes: Vec<PathBuf>,
    },
    /// Measure all kernels interleaved, and print the times as CSV.
    Bench {
        /// Mesh files (PLY, OBJ). [default: a generated scene]
        scenes: Vec<PathBuf>,
        /// Number of rays of a set.
        #[arg(long, default_value_t = 4_194_304)]
        rays: usize,
        /// Number of camera views.
        #[arg(long, default_value_t = 3)]
        views: u64,
        /// Warm-up passes, which are not counted.
        #[arg(long, default_value_t = 50)]
        warm_up: usize,
        /// Measured passes.
        #[arg(long, default_value_t = 100)]
        passes: usize,
        /// Enable wgpu's run-time checks. Software devices always have them.
        #[arg(long)]
        checked: bool,
        /// Write a dated record into this folder: `DATE-gpu.md`, the lines as `.csv`, a chart as `.svg`.
        #[arg(long)]
        record: Option<PathBuf>,
    },
    /// Print the properties of the device's arithmetic.
    Probe,
    /// Answer the conformance suite with a kernel: an implementation for `stackless conform`.
    Suite {
        /// Full name of the kernel.
        #[arg(long, default_value = "hashed/64")]
        kernel: String,
        /// Plant a bug of this name.
        #[arg(long)]
        planted: Option<String>,
    },
    /// Run kernels with a planted bug each. All bugs must be caught.
    Planted {
        /// Number of trees.
        #[arg(long, default_value_t = 1024)]
        trees: usize,
    },
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let gpu = match Gpu::open(arguments.adapter.as_deref()) {
        Ok(gpu) => gpu,
        Err(error) => return failed(&error),
    };
    // The adapter of the suite writes to a runner, without other output.
    if let Command::Suite { kernel, planted } = &arguments.command {
        return match commands::suite(&gpu, kernel, planted.as_deref()) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => ended(&error),
        };
    }
    println!("device: {}", gpu.name());
    match run(&arguments, &gpu) {
        Ok(true) => {
            println!("pass");
            ExitCode::SUCCESS
        }
        Ok(false) => {
            println!("fail");
            ExitCode::from(1)
        }
        Err(error) => ended(&error),
    }
}

fn ended(error: &GpuError) -> ExitCode {
    let code = failed(error);
    if matches!(error, GpuError::Timeout(_)) {
        // Skips destructors, which would wait for the device.
        std::process::exit(error.exit_code().into());
    }
    code
}

fn failed(error: &GpuError) -> ExitCode {
    eprintln!("gpu-check: {error}");
    ExitCode::from(error.exit_code())
}

/// Returns whether all checks passed.
fn run(arguments: &Arguments, gpu: &Gpu) -> Result<bool, GpuError> {
    match &arguments.command {
        Command::Tapes { trees, seed } => commands::tapes(gpu, *trees, *seed),
        Command::Rays { scenes, rays } => commands::rays(gpu, scenes, *rays),
        Command::Exact { scenes, rays } => commands::exact(gpu, scenes, *rays),
        Command::Hash { scenes } => commands::hash(gpu, scenes),
        Command::Bench { scenes, rays, views, warm_up, passes, checked, record } => {
            // Software devices miscompile unbounded loops.
            let checks = if *checked || gpu.is_software() { Checks::All } else { Checks::None };
            let setting = Setting { rays: *rays, views: *views, warm_up: *warm_up, passes: *passes, checks };
            commands::bench(gpu, scenes, setting, record.as_deref())
        }
        Command::Probe => probe::probe(gpu).map(|arithmetic| {
            println!("arithmetic: {arithmetic}");
            true
        }),
        Command::Planted { trees } => commands::planted(gpu, *trees),
        Command::Suite { .. } => Ok(true),
    }
}
