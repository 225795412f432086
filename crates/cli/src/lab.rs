//! The command `lab`: measurements and cases for developers of the library.

mod accuracy;
mod boxes;
mod figure;
mod motion;
mod parts;
mod price;

use clap::Parser;

use crate::run::{Outcome, Program};
use crate::{bench, check, explain, merge, stress};

/// Measurements and cases for developers of the library. `stackless` is the command for users.
#[derive(Parser)]
#[command(name = "lab", version, arg_required_else_help = true)]
pub(crate) enum Lab {
    /// Measure run time against error, for every triangle test with every box test.
    Accuracy(accuracy::Args),
    /// `stackless bench`, with a choice of instructions, single calls and double precision.
    Bench {
        #[command(flatten)]
        args: bench::Args,
        #[command(flatten)]
        extra: bench::Extra,
    },
    /// Count how often each box test skips a box that its ray touches.
    Boxes(boxes::Args),
    /// `stackless check`, with a choice of trees, words and places.
    Check {
        #[command(flatten)]
        args: check::Args,
        #[command(flatten)]
        extra: check::Extra,
    },
    /// Print a tree or a traversal as text. The cases are those of `lab explain`.
    Debug {
        part: explain::Part,
        #[command(flatten)]
        shown: explain::Shown,
        #[command(flatten)]
        extra: explain::Extra,
    },
    /// `stackless explain`, also of random trees.
    Explain {
        #[command(flatten)]
        args: explain::Args,
        #[command(flatten)]
        extra: explain::Extra,
    },
    /// Draw a figure of Binder & Keller 2016 for a scene.
    Figure(figure::Args),
    /// Add up the records of the parts of a run of `accuracy` or `boxes`.
    Merge(merge::Args),
    /// Measure the cost of a moving mesh, with refits, optimised refits and builds.
    Motion(motion::Args),
    /// Measure the parts of a ray's time, and the savings of omitting a part.
    Parts(parts::Args),
    /// Time the most expensive query of each hard family, relative to an ordinary query.
    Price(price::Args),
    /// `stackless stress`, with a choice of triangle and box tests.
    Stress {
        #[command(flatten)]
        args: stress::Args,
        #[command(flatten)]
        extra: stress::Extra,
    },
}

/// Commands whose records `lab merge` accepts.
const MERGED: [merge::Command; 3] = [
    merge::command::<accuracy::Found>(),
    merge::command::<accuracy::SecondaryFound>(),
    merge::command::<boxes::BoxCounts>(),
];

impl Program for Lab {
    fn run(self) -> Outcome {
        match self {
            Self::Accuracy(args) => accuracy::run(&args),
            Self::Bench { args, extra } => bench::run(&args, &extra),
            Self::Boxes(args) => boxes::run(&args),
            Self::Check { args, extra } => check::run(&args, &extra),
            Self::Debug { part, shown, extra } => explain::debug(part, &shown, extra),
            Self::Explain { args, extra } => explain::run(&args, extra),
            Self::Figure(args) => figure::run(&args),
            Self::Merge(args) => merge::run(&args, &MERGED),
            Self::Motion(args) => motion::run(&args),
            Self::Parts(args) => parts::run(&args),
            Self::Price(args) => price::run(&args),
            Self::Stress { args, extra } => stress::run(&args, extra),
        }
    }
}
