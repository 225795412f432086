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
    /// Every kernel on rays: made scenes, or files.
    Rays {
        /// Meshes (PLY, OBJ); the made scenes without any.
        scenes: Vec<PathBuf>,
        /// Rays of each scene.
        #[arg(long, default_value_t = 7000)]
        rays: usize,
    },
    /// Exact closest hits: what is certain on the device, the rest on the CPU; compared with the exact tracer.
    Exact {
        /// Meshes (PLY, OBJ); made ones without any.
        scenes: Vec<PathBuf>,
        /// Rays of each scene.
        #[arg(long, default_value_t = 7000)]
        rays: usize,
    },
    /// Hash tables made on the device, certified on the CPU.
    Hash {
        /// Meshes (PLY, OBJ); made ones without any.
        scenes: Vec<PathBuf>,
    },
    /// Times of all kernels by turns, as lines of CSV.
    Bench {
        /// Meshes (PLY, OBJ); a made one without any.
        scenes: Vec<PathBuf>,
        /// Rays of a set.
        #[arg(long, default_value_t = 4_194_304)]
        rays: usize,
        /// Views of the camera.
        #[arg(long, default_value_t = 3)]
        views: u64,
        /// Passes that are not counted.
        #[arg(long, default_value_t = 50)]
        warm_up: usize,
        /// Passes that are.
        #[arg(long, default_value_t = 100)]
        passes: usize,
        /// Kernels with wgpu's run-time checks. Software devices always have them.
        #[arg(long)]
        checked: bool,
        /// A folder for a dated record: `DATE-gpu.md`, the lines as `.csv`, a picture as `.svg`.
        #[arg(long)]
        record: Option<PathBuf>,
    },
    /// What the arithmetic of the device does.
    Probe,
    /// Answer the conformance suite as a kernel does: an implementation for `stackless conform`.
    Suite {
        /// The kernel, by its full name.
        #[arg(long, default_value = "hashed/64")]
        kernel: String,
        /// A mistake in it, by its name.
        #[arg(long)]
        planted: Option<String>,
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
    let gpu = match Gpu::open(arguments.adapter.as_deref()) {
        Ok(gpu) => gpu,
        Err(error) => return failed(&error),
    };
    // The suite's adapter speaks with a runner.
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
        // To give the device back is to wait for it.
        std::process::exit(error.exit_code().into());
    }
    code
}

fn failed(error: &GpuError) -> ExitCode {
    eprintln!("gpu-check: {error}");
    ExitCode::from(error.exit_code())
}

/// Whether all was as it should be.
fn run(arguments: &Arguments, gpu: &Gpu) -> Result<bool, GpuError> {
    match &arguments.command {
        Command::Tapes { trees, seed } => commands::tapes(gpu, *trees, *seed),
        Command::Rays { scenes, rays } => commands::rays(gpu, scenes, *rays),
        Command::Exact { scenes, rays } => commands::exact(gpu, scenes, *rays),
        Command::Hash { scenes } => commands::hash(gpu, scenes),
        Command::Bench { scenes, rays, views, warm_up, passes, checked, record } => {
            // Software devices miscompile loops that are not bounded.
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
