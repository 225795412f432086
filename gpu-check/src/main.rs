//! The command `gpu-check`.

mod commands;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use gpu_check::{Gpu, GpuError, probe};

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
    /// What the arithmetic of the device does.
    Probe,
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
        Command::Tapes { trees, seed } => commands::tapes(&gpu, *trees, *seed),
        Command::Rays { scenes, rays } => commands::rays(&gpu, scenes, *rays),
        Command::Probe => probe::probe(&gpu).map(|arithmetic| {
            println!("arithmetic: {arithmetic}");
            true
        }),
        Command::Planted { trees } => commands::planted(&gpu, *trees),
    }
}
