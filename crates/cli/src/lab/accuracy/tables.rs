//! Tables and the chart.

use std::collections::BTreeMap;

use crate::plots::{Choice, Errors, front, plot_pareto};
use stackless_bvh::internals::trace::Accuracy;

use super::pairs::BASELINE;
use super::rows::{Kind, Row};
use super::stages::{Reached, Stages};
use crate::output::{Block, Table, grouped, table};
use crate::turns::geometric_mean;

/// All rows of a pair of tests.
struct Summary<'a>(Vec<&'a Row>);

/// A kind of error: its name and its count in a row.
type Event = (&'static str, fn(&Row) -> Option<u64>);

const EVENTS: [Event; 5] = [
    ("false misses", |row| row.false_misses),
    ("false hits", |row| row.false_hits),
    ("wrong ids", |row| row.wrong_primitives),
    ("by order", |row| row.order_differences),
    ("leaks", |row| row.leaks),
];

/// Ordinary rays; adversarial rays, with leaks.
const SIDES: [(&str, &[Kind], &[Event]); 2] = [
    ("ordinary rays", &[Kind::Ordinary], EVENTS.split_at(4).0),
    ("adversarial rays", &[Kind::Adversarial, Kind::Closed], &EVENTS),
];

/// All tables.
pub(super) fn blocks(rows: &[Row], stages: &[Stages]) -> Vec<Block> {
    let (summaries, mut blocks) = (summaries(rows), Vec::new());
    for (name, kinds, events) in SIDES {
        if rows.iter().any(|row| kinds.contains(&row.kind)) {
            blocks.extend(side(&summaries, name, kinds, events));
        }
    }
    if rows.iter().any(|row| row.ratio.is_some()) {
        blocks.push(Block::Table(levels(rows)));
    }
    if !stages.is_empty() {
        blocks.push(Block::Table(stage_table(stages)));
    }
    blocks
}

/// The figures as two charts, as SVG.
pub(super) fn plot(rows: &[Row]) -> String {
    let summaries = summaries(rows);
    let charts = SIDES.map(|(name, kinds, events)| {
        let choices = summaries.iter().filter_map(|summary| summary.choice(kinds, events)).collect::<Vec<_>>();
        (name, choices)
    });
    let charts: Vec<_> = charts.iter().map(|(name, choices)| (*name, choices.as_slice())).collect();
    plot_pareto(&charts, &format!("time, in units of {} with {} boxes", BASELINE.0, BASELINE.1))
}

fn summaries(rows: &[Row]) -> Vec<Summary<'_>> {
    let mut by_pair: Vec<Summary<'_>> = Vec::new();
    for row in rows {
        match by_pair.iter_mut().find(|summary| summary.pair() == Some((&row.kernel, &row.slabs))) {
            Some(summary) => summary.0.push(row),
            None => by_pair.push(Summary(vec![row])),
        }
    }
    by_pair
}

fn side(summaries: &[Summary<'_>], name: &str, kinds: &[Kind], events: &[Event]) -> [Block; 2] {
    let choices: Vec<_> = summaries.iter().map(|summary| summary.choice(kinds, events)).collect();
    let known: Vec<_> = choices.iter().flatten().cloned().collect();
    let mut on_front = front(&known).into_iter();
    let header = ["", "kernel", "box", "level", "time", "most", "Mrays/s", "judged"].into_iter();
    let header: Vec<_> = header.chain(events.iter().map(|event| event.0)).chain(["p99.9 ulp", "max ulp"]).collect();
    let lines = summaries.iter().zip(&choices).map(|(summary, choice)| {
        let star = choice.is_some() && on_front.next() == Some(true);
        summary.cells(kinds, events, star)
    });
    let caption = "time of these rays; errors in 10^9 rays, the maximum of all scenes; `<`: no error, upper bound (95 %). \
                   *: no pair is both faster and more accurate";
    [Block::Line(format!("{name}: {caption}")), Block::Table(table(&header, 4, lines.collect()))]
}

impl Summary<'_> {
    fn pair(&self) -> Option<(&str, &str)> {
        self.0.first().map(|row| (&*row.kernel, &*row.slabs))
    }

    fn rows(&self, kinds: &[Kind]) -> impl Iterator<Item = &Row> {
        self.0.iter().copied().filter(move |row| kinds.contains(&row.kind))
    }

    /// Geometric mean of the time over scenes and sets, its maximum, and the geometric mean of the throughput.
    fn time(&self, kinds: &[Kind]) -> Option<[f64; 3]> {
        let mean = |of: fn(&Row) -> Option<f64>| geometric_mean(self.rows(kinds).filter_map(of));
        let most = self.rows(kinds).filter_map(|row| row.ratio).reduce(f64::max)?;
        Some([mean(|row| row.ratio)?, most, mean(|row| row.mrays)?])
    }

    /// The rate of a kind of error, in the scene where it is highest.
    fn errors(&self, kinds: &[Kind], event: Event) -> Option<Errors> {
        let mut scenes = BTreeMap::<&str, [u64; 2]>::new();
        for row in self.rows(kinds).filter(|row| row.rays > 0) {
            if let Some(events) = event.1(row) {
                let sums = scenes.entry(&row.scene).or_default();
                *sums = [sums[0] + events, sums[1] + row.rays];
            }
        }
        let all = scenes.values().fold([0; 2], |[a, b], [c, d]| [a + c, b + d]);
        let rates = scenes.values().map(|&[events, rays]| Errors::of(events, rays).observed());
        match rates.reduce(f64::max)? {
            0.0 => Some(Errors::of(0, all[1])),
            rate => Some(Errors::Observed(rate)),
        }
    }

    /// The most frequent kind of error; without errors, the kind with the highest bound.
    fn choice(&self, kinds: &[Kind], events: &[Event]) -> Option<Choice> {
        let (kernel, slabs) = self.pair()?;
        let all: Vec<_> = events.iter().filter_map(|&event| self.errors(kinds, event)).collect();
        let observed = all.iter().map(|errors| errors.observed()).fold(0.0, f64::max);
        let bounds = all.iter().filter_map(|errors| if let Errors::Below(rate) = errors { Some(*rate) } else { None });
        let errors = if observed > 0.0 { Errors::Observed(observed) } else { Errors::Below(bounds.reduce(f64::max)?) };
        let cost = self.time(kinds).map_or(f64::NAN, |time| time[0]);
        Some(Choice { label: slabs.to_owned(), family: kernel.to_owned(), cost, errors })
    }

    fn cells(&self, kinds: &[Kind], events: &[Event], star: bool) -> Vec<String> {
        let (kernel, slabs) = self.pair().unwrap_or_default();
        let level = self.0.first().and_then(|row| row.level.as_deref()).unwrap_or_default();
        let mut cells = vec![if star { "*" } else { "" }.to_owned()];
        cells.extend([kernel, slabs, level].map(str::to_owned));
        match self.time(kinds) {
            Some([ratio, most, mrays]) => {
                cells.extend([format!("{ratio:.3}"), format!("{most:.3}"), format!("{mrays:.3}")]);
            }
            None => cells.extend(["-"; 3].map(str::to_owned)),
        }
        cells.push(grouped(self.rows(kinds).map(|row| row.rays).sum()));
        cells.extend(events.iter().map(|&event| match self.errors(kinds, event) {
            None => "-".to_owned(),
            Some(Errors::Observed(rate)) => grouped(rate.round() as u64),
            Some(Errors::Below(rate)) => format!("<{}", grouped(rate.ceil() as u64)),
        }));
        let most = |of: fn(&Row) -> Option<u32>| self.rows(kinds).filter_map(of).max();
        let ulps = [most(|row| row.p999_ulp), most(|row| row.max_ulp)];
        cells.extend(ulps.map(|ulps| ulps.map_or_else(|| "-".to_owned(), |ulps| grouped(ulps.into()))));
        cells
    }
}

/// The times of the levels of accuracy, by scene and set.
fn levels(rows: &[Row]) -> Table {
    let mut lines = Vec::new();
    let timed = |row: &&Row| row.ratio.is_some();
    let baseline = rows.iter().filter(|row| (&*row.kernel, &*row.slabs) == (BASELINE.0.name(), BASELINE.1.name()));
    for base in baseline.filter(timed) {
        let of_level = |level: Accuracy| {
            let is_it = |row: &&Row| {
                (&row.scene, &row.set, row.level.as_deref()) == (&base.scene, &base.set, Some(level.name()))
            };
            rows.iter().find(is_it).and_then(|row| row.ratio)
        };
        let or_dash = |number: Option<f64>| number.map_or_else(|| "-".to_owned(), |number| format!("{number:.3}"));
        let mut line = vec![base.scene.clone(), base.set.clone(), or_dash(base.mrays)];
        line.extend(Accuracy::ALL.map(|level| or_dash(of_level(level))));
        lines.push(line);
    }
    let baseline = format!("{} {} Mrays/s", BASELINE.0, BASELINE.1);
    let header = ["scene", "time of", &baseline].into_iter().chain(Accuracy::ALL.map(Accuracy::name));
    table(&header.collect::<Vec<_>>(), 2, lines)
}

/// How often the exact test needed later stages.
fn stage_table(stages: &[Stages]) -> Table {
    let shares = |Reached { all, triangle, sums }: Reached| {
        [triangle, sums].map(|count| format!("{:.2e}", count as f64 / all.max(1) as f64))
    };
    let line = |stages: &Stages| {
        let mut line = vec![stages.scene.clone(), stages.set.to_owned(), grouped(stages.tests.all)];
        line.extend(shares(stages.tests).into_iter().chain(shares(stages.rays)));
        line
    };
    let header = ["scene", "stages of exact", "tests", "own bounds", "exact sums", "own bounds/ray", "exact sums/ray"];
    table(&header, 2, stages.iter().map(line).collect())
}
