//! `stackless curve`: run time against proved error of the closest point of a Bézier curve.

mod plot;

use std::hint::black_box;

use serde::Serialize;
use serde_json::json;
use stackless_bvh::generate::Rng;
use stackless_bvh::traverse::Method;
use stackless_curve::{Bezier, Closest, End, Family, Options};

use crate::output::{say, table, write_file};
use crate::places::{self, Output};
use crate::record::write_figures;
use crate::turns::{median, take_turns};
use crate::{Outcome, input};

/// Measure run time against proved error: the closest point of a Bézier curve, by interval arithmetic over an implicit
/// tree.
///
/// A query asks for the closest point of a curve of its own, in space, ordinary or degenerate; coordinates are about 1.
/// Its error is the width of the interval that is proved to hold the least distance. Times are of one thread; the
/// traversals and tolerances take turns.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    stackless curve\n  \
    stackless curve --plot curve.svg")]
pub(crate) struct Args {
    /// Number of curves; the families take turns.
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(1..=1 << 24))]
    curves: u32,
    /// Degree of the curves.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u8).range(1..=8))]
    degree: u8,
    /// Widths that are asked for, separated by commas; 1e-1 to 1e-15 and 0 if none are given.
    #[arg(long, value_delimiter = ',', value_parser = tolerance)]
    tolerance: Vec<f64>,
    /// Only these families of curves, separated by commas; all whose coordinates are about 1 if none are given.
    #[arg(long, value_delimiter = ',', value_parser = input::names(Family::ALL, Family::name))]
    families: Vec<Family>,
    /// Only these traversals, separated by commas.
    #[arg(long, value_delimiter = ',', default_value = "stack,implicit-b1,left-first", value_parser = input::method_of(Options::METHODS))]
    methods: Vec<Method>,
    /// Intervals that a search may split.
    #[arg(long, default_value_t = 10_000)]
    budget: u32,
    /// How often all are timed; the least time of a chunk counts.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=1000))]
    rounds: u32,
    /// Seed of the curves.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write the figures to this file.
    #[arg(long, value_name = "FILE", value_parser = places::file)]
    json: Option<Output>,
    /// Draw time against error, as SVG.
    #[arg(long, value_name = "FILE", value_parser = places::file_as("svg"))]
    plot: Option<Output>,
}

/// Queries that are timed before it is another's turn.
const CHUNK: usize = 128;

/// A curve and a point.
type Asked = (Bezier<3>, [f64; 3]);

/// What a traversal takes for a tolerance, and what it gives.
#[derive(Serialize)]
struct Row {
    method: String,
    tolerance: f64,
    queries: usize,
    /// For one query: the median over the chunks, and the mean.
    nanoseconds: f64,
    steps: f64,
    /// How many answers are as narrow as asked for, and why the others are not.
    reached: usize,
    out_of_steps: usize,
    rounding: usize,
    /// Widths.
    median_error: f64,
    max_error: f64,
}

pub(crate) fn run(args: &Args) -> Outcome {
    let queries = queries(args)?;
    let tolerances = match &args.tolerance[..] {
        [] => (1..=15).map(|digits| 10f64.powi(-digits)).chain([0.0]).collect(),
        given => given.to_vec(),
    };
    let contestants: Vec<_> = tolerances
        .iter()
        .flat_map(|&tolerance| args.methods.iter().map(move |&method| (tolerance, method)))
        .map(|(tolerance, method)| Options { tolerance, budget: args.budget, method })
        .collect();
    // All answers once, which also refuses what cannot be asked.
    let answer = |options: &Options| queries.iter().map(|(curve, point)| curve.closest(point, options)).collect();
    let answers = contestants.iter().map(answer).collect::<Result<Vec<Vec<Closest>>, _>>()?;
    let times =
        take_turns(contestants.len(), queries.len(), CHUNK, args.rounds as usize, "curves", |contestant, chunk| {
            for (curve, point) in &queries[chunk] {
                let _ = black_box(curve.closest(point, &contestants[contestant]));
            }
        });
    let row = |(contestant, options): (usize, &Options)| {
        let each = times.by_chunk(contestant).into_iter().zip(times.lengths());
        let nanoseconds = median(each.map(|(time, &length)| time * 1e9 / length as f64).collect());
        Row::new(options, &answers[contestant], nanoseconds)
    };
    let rows: Vec<_> = contestants.iter().enumerate().map(row).collect();
    print(args, &rows);
    if let Some(path) = &args.json {
        write_figures(path, "curve", &[], json!({ "rows": rows }))?;
    }
    if let Some(path) = &args.plot {
        let svg = plot::plot(&rows, args);
        write_file(path, |file| file.write_all(svg.as_bytes()))?;
    }
    Ok(true)
}

fn queries(args: &Args) -> Result<Vec<Asked>, Box<dyn std::error::Error>> {
    let ordinary = Family::ALL.into_iter().filter(|family| !matches!(family, Family::Far | Family::Scaled));
    let families = if args.families.is_empty() { ordinary.collect() } else { args.families.clone() };
    let mut random = Rng::new(args.seed);
    let query = |i: usize| {
        let (points, point) = families[i % families.len()].draw(args.degree.into(), &mut random);
        Ok((Bezier::new(&points)?, point))
    };
    (0..args.curves as usize).map(query).collect()
}

impl Row {
    fn new(options: &Options, answers: &[Closest], nanoseconds: f64) -> Self {
        let ends = |end| answers.iter().filter(|answer| answer.end == end).count();
        let widths: Vec<_> = answers.iter().map(|answer| answer.distance[1] - answer.distance[0]).collect();
        Self {
            method: options.method.to_string(),
            tolerance: options.tolerance,
            queries: answers.len(),
            nanoseconds,
            steps: answers.iter().map(|answer| f64::from(answer.steps)).sum::<f64>() / answers.len() as f64,
            reached: ends(End::Reached),
            out_of_steps: ends(End::OutOfSteps),
            rounding: ends(End::Rounding),
            max_error: widths.iter().copied().fold(0.0, f64::max),
            median_error: median(widths),
        }
    }

    fn cells(&self) -> Vec<String> {
        let share = 100.0 * self.reached as f64 / self.queries as f64;
        vec![
            self.method.clone(),
            format!("{:.0e}", self.tolerance),
            format!("{:.0}", self.nanoseconds),
            format!("{:.1}", self.steps),
            format!("{share:.1} %"),
            self.out_of_steps.to_string(),
            self.rounding.to_string(),
            format!("{:.1e}", self.median_error),
            format!("{:.1e}", self.max_error),
        ]
    }
}

fn print(args: &Args, rows: &[Row]) {
    let header =
        ["traversal", "tolerance", "ns", "steps", "reached", "out of steps", "rounding", "median error", "max error"];
    say!("{}", table(&header, 1, rows.iter().map(Row::cells).collect()));
    say!("{} curves of degree {}: an error is the width of the interval that is proved", args.curves, args.degree);
}

fn tolerance(text: &str) -> Result<f64, String> {
    let number = text.parse().map_err(|_| "not a number".to_owned())?;
    if number >= 0.0 { Ok(number) } else { Err("negative or not a number".to_owned()) }
}
