//! `lab boxes`: compares the box tests with rational arithmetic.

use serde::{Deserialize, Serialize};
use stackless_bvh::internals::trace::SlabsName;
use stackless_check::{BoxTally, Shard, check_boxes};

use crate::Outcome;
use crate::output::{bar, count, grouped, say, table};
use crate::places::{self, Output};
use crate::record::{Counts, Run, expect};

/// Count how often each box test skips a box that its ray touches.
///
/// The exit code is 1 if the `directed` test skips such a box.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  lab boxes 1000000")]
pub(crate) struct Args {
    /// Number of rays, each with a box.
    #[arg(value_parser = clap::value_parser!(u64).range(1..=1 << 40))]
    rays: u64,
    /// Seed of the rays.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Run only part I of N. `lab merge` adds up the counts.
    #[arg(long, value_name = "I/N", default_value_t = Shard::WHOLE, hide_default_value = true)]
    shard: Shard,
    /// Write the counts to this file.
    #[arg(long, value_name = "FILE", value_parser = places::file())]
    json: Option<Output>,
}

pub(crate) fn run(args: &Args) -> Outcome {
    let mut run = Run::of::<BoxCounts>([("rays", args.rays.into()), ("seed", args.seed.into())]);
    let numbers = run.take(args.shard, "rays", args.rays);
    run.refuse_empty(args.shard)?;
    let progress = bar(numbers.end - numbers.start, "rays");
    let tally = check_boxes(args.seed, numbers, &|done| progress.inc(done));
    progress.finish_and_clear();
    run.finish(BoxCounts(tally), args.json.as_deref())
}

/// Counts of skipped boxes that the ray touches.
#[derive(Serialize, Deserialize)]
pub(crate) struct BoxCounts(BoxTally);

impl Counts for BoxCounts {
    const COMMAND: &str = "boxes";

    fn check(&self, run: &Run) -> Result<(), String> {
        let BoxTally { rays, touched, skipped, in_vain } = self.0;
        // Some numbers yield no valid ray.
        expect("rays", rays, 0..=run.done(|_| true))?;
        expect("touched", touched, 0..=rays)?;
        skipped.into_iter().try_for_each(|skipped| expect("skipped", skipped, 0..=touched))?;
        in_vain.into_iter().try_for_each(|in_vain| expect("in_vain", in_vain, 0..=rays - touched))
    }

    fn add(&mut self, other: Self) {
        self.0 = self.0.merge(other.0);
    }

    fn print(&self) {
        let BoxTally { skipped, in_vain, .. } = self.0;
        let rows = SlabsName::ALL.into_iter().zip(skipped).zip(in_vain);
        let rows = rows.map(|((form, skipped), in_vain)| vec![form.to_string(), grouped(skipped), grouped(in_vain)]);
        say!("{}", table(&["box test", "touched and skipped", "not touched and entered"], 1, rows.collect()));
    }

    fn sum(&self) -> String {
        format!("{} with a box each, {} touched", count(self.0.rays, "ray"), grouped(self.0.touched))
    }

    /// The counts of the directed test.
    fn cases_and_errors(&self) -> [u64; 2] {
        [self.0.rays, self.0.skipped[2]]
    }

    fn is_empty(&self) -> bool {
        self.0.rays == 0
    }
}
