//! The command `stackless`: trace, draw, check, measure.

use clap::Parser;

use crate::run::{Outcome, Program, command_line};
use crate::{bench, check, conform, explain, generate, merge, methods, points, render, stats, stress, suite, trace};

/// Exact ray tracing on triangle meshes, and stackless traversals that are checked and measured.
#[derive(Parser)]
#[command(name = "stackless", version, arg_required_else_help = true)]
#[command(after_help = "Exit codes: 0 success; 1 a check failed; 2 bad input or usage.\n\
    An output file of `-` is the standard output. A failed command leaves no partial file.\n\n\
    Examples:\n  stackless check\n  stackless render examples/data/torus.ply -o torus.png\n  stackless conform -- python3 mine.py")]
pub(crate) enum Stackless {
    /// Trace the rays of a file through a scene.
    Trace(trace::Args),
    /// Classify points: inside, on or outside a closed mesh.
    Contains(points::Contains),
    /// Find the nearest point of a mesh and its distance.
    Nearest(points::Nearest),
    /// Draw a scene, or the cost of its traversal.
    Render(render::Args),
    /// Compare every traversal with the oracle, on abstract trees and on scenes.
    Check(check::Args),
    /// Measure time and errors of traversals on scenes.
    Bench(bench::Args),
    /// Count the errors of each accuracy on hard scenes.
    Stress(stress::Args),
    /// Summarise the hierarchies and hash tables of a scene.
    Stats(stats::Args),
    /// List the traversals: name, trees and method of backtracking.
    Methods,
    /// Run the conformance suite against another implementation.
    Conform(conform::Args),
    /// List, print or export the conformance suite, or answer it with this library.
    Suite(suite::Args),
    /// Write a page that steps through traversals of a small tree.
    Explain(explain::Args),
    /// Add up the records of the parts of a run.
    Merge(merge::Args),
    /// Write the manual pages, or completions for a shell.
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
            Self::Generate(args) => generate::run(&args, command_line::<Self>()),
        }
    }
}
