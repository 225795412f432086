//! The command `stackless`: trace, draw, check, measure.

use clap::Parser;

use crate::run::{Outcome, Program};
use crate::{bench, check, conform, explain, generate, merge, methods, points, render, stats, stress, suite, trace};

/// Exact ray tracing on triangle meshes, and stackless traversals that are checked and measured.
#[derive(Parser)]
#[command(name = "stackless", version, arg_required_else_help = true)]
#[command(
    after_help = "Exit codes: 0 all is well; 1 a check found something wrong; 2 it could not run: bad input or usage.\n\
    Where a file is written, `-` is the standard output. Files are written whole or not at all.\n\n\
    Examples:\n  stackless check\n  stackless render examples/data/torus.ply -o torus.png\n  stackless conform -- python3 mine.py"
)]
pub(crate) enum Stackless {
    /// Trace the rays of a file through a scene.
    Trace(trace::Args),
    /// Say which points are inside of a closed mesh.
    Contains(points::Contains),
    /// Find the nearest point of a mesh, and how far it is.
    Nearest(points::Nearest),
    /// Draw a scene, or what its traversal costs.
    Render(render::Args),
    /// Compare every traversal with the oracle, on abstract trees and on scenes.
    Check(check::Args),
    /// Measure the time and the errors of traversals beside each other on scenes.
    Bench(bench::Args),
    /// Count the errors of each accuracy on hard scenes.
    Stress(stress::Args),
    /// Say what a scene's hierarchies and hash tables take.
    Stats(stats::Args),
    /// List the traversals: their names, their trees, and how each comes back.
    Methods,
    /// Ask another implementation the cases of the conformance suite.
    Conform(conform::Args),
    /// The conformance suite: as files, and as what this library answers.
    Suite(suite::Args),
    /// Write a page that steps through traversals of a small tree.
    Explain(explain::Args),
    /// Add up the records of the parts of a run.
    Merge(merge::Args),
    /// Write the manual pages, or the completions for a shell.
    Generate(generate::Args),
}

impl Program for Stackless {
    fn run(self) -> Outcome {
        match self {
            Self::Trace(args) => trace::run(&args),
            Self::Contains(args) => args.run(),
            Self::Nearest(args) => args.run(),
            Self::Render(args) => render::run(&args),
            Self::Check(args) => check::run(&args, &check::Extra::default()),
            Self::Bench(args) => bench::run(&args, &bench::Extra::default()),
            Self::Stress(args) => stress::run(&args, stress::Extra::default()),
            Self::Stats(args) => stats::run(&args),
            Self::Methods => {
                methods::run();
                Ok(true)
            }
            Self::Conform(args) => conform::run(&args),
            Self::Suite(args) => suite::run(&args),
            Self::Explain(args) => explain::run(&args, explain::Extra::default()),
            Self::Merge(args) => merge::run(&args, &merge::COMMANDS),
            Self::Generate(args) => generate::run(&args),
        }
    }
}
