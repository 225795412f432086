//! `stackless bench`: time and errors of the traversals and of other ray tracers, in one run.

mod double;
mod own;
#[cfg(feature = "peers")]
mod peers;
mod rays;
mod rows;
mod wide;

use std::hint::black_box;
use std::path::PathBuf;

use cpu_time::ProcessTime;
use serde_json::json;
use stackless_bvh::bvh::Builder;
use stackless_bvh::geom::Ray;
use stackless_bvh::internals::geom::lanes::Level;
use stackless_bvh::internals::trace::{Accuracy, Truth};
use stackless_bvh::traverse::Method;
use stackless_bvh::wide::Method as WideMethod;
use stackless_suite::Traversal;

use crate::build;
use crate::input::{self, Scene};
use crate::judge::{Answer, Counts, Query, Truths, csv_line, is_same};
use crate::output::say;
use crate::places::{self, Output};
use crate::record::write_figures;
use crate::turns::take_turns;
use crate::{Outcome, camera};
use own::Trees;
#[cfg(feature = "peers")]
pub(crate) use peers::{plain, vertices};
use rays::{Kind, Set};
use rows::{Row, means, of_scene};
use wide::{Manner, WideTree};

/// Measure time and errors of traversals on one thread, with the same rays and by default the same tree.
///
/// Contestants alternate after each chunk of the rays. Times are processor time of the thread: for each chunk, the
/// least of all rounds, because other work on the same core slows down some rounds. The ratio is the time of `stack`
/// (on the first tree, with the first accuracy) divided by the contestant's time: above 1 is faster.
///
/// Up to 5,000 rays of each kind are judged by rational arithmetic: the number of wrong answers, and the error of
/// distances in floats. The exit code is 1 if an exact answer is wrong, or if the hits of two exact contestants differ.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    stackless bench examples/data/torus.ply examples/data/slivers.ply\n  \
    stackless bench examples/data/room.obj --method afra,wide-stack --kinds diffuse --count 1000000\n  \
    stackless bench examples/data/torus.ply --accuracy fast,exact --kinds any,aimed --json bench.json")]
pub(crate) struct Args {
    /// Mesh files (.ply, .obj, .stl, .gltf, .glb), or the generated scenes `strands`, `stadium`, `soup`.
    #[arg(required = true)]
    scenes: Vec<PathBuf>,
    /// Traversals, separated by commas (`stackless methods` lists them). `stack` is always included. Traversals of wide
    /// trees are exact. They trace two rays interleaved, over trees of eight children from the same builders. The
    /// default wide traversal, `wide-record`, also traces the rays and triangles in double precision, as `wide-record-f64`,
    /// over the first tree. Its distances are judged as rounded to single precision.
    #[arg(long, value_delimiter = ',', value_parser = input::traversal(), hide_possible_values = true)]
    #[arg(default_value = "stack,sparse,afra,uncle,hashed,hash-only,implicit-b1,wide-stack,wide-record")]
    method: Vec<Traversal>,
    /// Builders of the hierarchy, separated by commas.
    #[arg(long, value_delimiter = ',', default_value = "standard", value_parser = build::builder())]
    build: Vec<Builder>,
    /// Kinds of rays, separated by commas.
    #[arg(long, value_delimiter = ',', default_value = "primary,any,diffuse")]
    kinds: Vec<Kind>,
    /// Levels of accuracy, separated by commas.
    #[arg(long, value_delimiter = ',', default_value = "exact", value_parser = input::accuracy())]
    accuracy: Vec<Accuracy>,
    /// Number of camera rays. The kinds `any` and `diffuse` have a ray for each hit of a camera ray.
    #[arg(long, default_value_t = 65_536, value_parser = clap::value_parser!(u32).range(1..=1 << 28))]
    count: u32,
    /// Number of rounds.
    #[arg(long, default_value_t = 7, value_parser = clap::value_parser!(u32).range(1..=1000))]
    rounds: u32,
    #[command(flatten)]
    place: camera::Place,
    /// Seed of the rays.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Measure other ray tracers, too (feature `peers`). Their ratios are to `stack` with exact tests. `embree-double`
    /// uses Embree's boxes, and a callback that tests triangles in double precision.
    #[arg(long)]
    peers: bool,
    /// Write the figures to this file.
    #[arg(long, value_name = "FILE", value_parser = places::file())]
    json: Option<Output>,
}

/// Options of `lab bench` only.
#[derive(Clone, Default, clap::Args)]
pub(crate) struct Extra {
    /// Instruction level for traversals of wide trees. [default: the best of the machine]
    #[arg(long, value_name = "LEVEL", value_parser = input::simd())]
    simd: Option<Level>,
    /// Trace one ray per call through wide trees.
    #[arg(long)]
    one_by_one: bool,
    /// Also compute the weights of closest hits in wide trees.
    #[arg(long)]
    weights: bool,
    /// Measure double precision in these places, separated by commas: `f64`, the scene unchanged; with an extent of 1
    /// at `6.4e6` and at `1e9`, scaled by `1e-50` and by `1e50`; and rays whose smallest component is `1e-130`. Only
    /// `f64` is judged.
    #[arg(long, conflicts_with = "peers", value_name = "PLACES", value_delimiter = ',', num_args = 0..=1)]
    #[arg(default_missing_value = double::NAMES, value_parser = double::place())]
    double: Vec<double::Place>,
}

/// Number of rays that a contestant traces before the next contestant continues.
const CHUNK: usize = 4096;

/// Number of builds of each tree.
const BUILDS: usize = 3;

/// Number of judged rays of a kind.
const JUDGED: usize = 5000;

/// A traversal or another ray tracer.
trait Contestant {
    /// The traversal, or the name of the peer.
    fn method(&self) -> &'static str;

    /// The builder; `None` for a peer.
    fn build(&self) -> Option<Builder>;

    /// The level of accuracy; `None` for a peer.
    fn accuracy(&self) -> Option<Accuracy>;

    /// The name of its tests in tables.
    fn tests(&self) -> &'static str {
        self.accuracy().map_or("own", Accuracy::name)
    }

    /// Whether its answers are judged.
    fn is_judged(&self) -> bool {
        true
    }

    /// Prepares for these rays, untimed.
    fn take(&mut self, _rays: &[Ray]) {}

    /// Traces some of the rays of [`take`](Self::take), from `first` on.
    fn trace(&mut self, query: Query, rays: &[Ray], first: usize, answers: &mut [Answer]);

    /// Visits of inner nodes and leaves by all rays, if they can be counted.
    fn nodes(&mut self, query: Query, rays: &[Ray]) -> Option<u64>;

    /// Bytes of the state for one ray, if known.
    fn state_bytes(&self) -> Option<usize>;

    /// Processor time of a build, in seconds: the least of several builds.
    fn build_seconds(&self) -> f64;
}

pub(crate) fn run(args: &Args, extra: &Extra) -> Outcome {
    if args.peers && !cfg!(feature = "peers") {
        return Err("--peers: this program was built without the feature `peers`".into());
    }
    if args.peers && !args.accuracy.contains(&Accuracy::Exact) {
        return Err("--peers: expected exact in --accuracy, for the ratios of the peers".into());
    }
    let scenes = input::scenes(&args.scenes)?;
    let Found { rows, notes, offences } = measure(args, extra, &scenes)?;
    say!("{}", means(&rows));
    for note in notes.iter().chain(&offences) {
        say!("{note}");
    }
    if let Some(path) = &args.json {
        write_figures(path, "bench", &scenes, json!({ "rows": rows }))?;
    }
    Ok(offences.is_empty())
}

/// Builds several times. Returns the last result and the least processor time, in seconds. The first build is slower,
/// because it touches new memory.
fn timed<T, E>(mut build: impl FnMut() -> Result<T, E>) -> Result<(T, f64), E> {
    let mut least = f64::INFINITY;
    for _ in 1..BUILDS {
        let start = ProcessTime::now();
        drop(black_box(build()?));
        least = least.min(start.elapsed().as_secs_f64());
    }
    let start = ProcessTime::now();
    let built = build()?;
    Ok((built, least.min(start.elapsed().as_secs_f64())))
}

/// Results of the measurement.
#[derive(Default)]
struct Found {
    rows: Vec<Row>,
    /// Omitted measurements, with reasons.
    notes: Vec<String>,
    /// Errors of exact contestants, and differences between their hits.
    offences: Vec<String>,
}

/// Measures all scenes, and prints the rows of each scene when it is finished.
fn measure(args: &Args, extra: &Extra, scenes: &[Scene]) -> Result<Found, Box<dyn std::error::Error>> {
    let builds = once_each(args.build.iter().copied());
    let accuracies = once_each(args.accuracy.iter().copied());
    // `stack` is the baseline.
    let (binary, wide) = Traversal::of_each_kind(&args.method);
    let methods = once_each([Method::Stack].into_iter().chain(binary));
    let wide_methods = once_each(wide);
    let Found { mut rows, mut notes, mut offences } = Found::default();
    for scene in scenes {
        let trees: Result<Vec<_>, _> = builds.iter().map(|&build| Trees::build(scene, build)).collect();
        let trees = trees?;
        let wide_builds = if wide_methods.is_empty() { &[][..] } else { &builds };
        let wide_trees: Result<Vec<_>, _> = wide_builds.iter().map(|&build| WideTree::build(scene, build)).collect();
        let wide_trees = wide_trees?;
        let mut contestants = Vec::new();
        for trees in &trees {
            for &accuracy in &accuracies {
                for &method in &methods {
                    let contestant = trees.contestant(method, accuracy);
                    contestants.push(contestant.map_err(|unfit| format!("{}: {method}: {unfit}", scene.name))?);
                }
            }
        }
        let level = extra.simd.unwrap_or_else(Level::new);
        let manner = Manner { level, is_alone: extra.one_by_one, with_weights: extra.weights };
        for tree in &wide_trees {
            for &method in &wide_methods {
                contestants.push(tree.contestant(method, manner)?);
            }
        }
        #[cfg(feature = "peers")]
        if args.peers {
            contestants.extend(peers::build(&scene.mesh, &mut notes));
        }
        let as_it_is = wide_methods.contains(&WideMethod::default()).then_some(double::Place::AS_IT_IS);
        let places = once_each(as_it_is.into_iter().chain(extra.double.iter().copied()));
        contestants.extend(double::build(scene, builds[0], &places, manner)?);
        let course = Course { scene, truth: Truth::new(&scene.mesh), rounds: args.rounds as usize };
        let first = rows.len();
        let primary = args.place.of(scene).rays(args.count as usize);
        for set in rays::sets(scene, trees[0].bvh(), primary, once_each(args.kinds.iter().copied()), args.seed) {
            if set.rays.is_empty() {
                notes.push(format!("{}, {}: no rays", scene.name, set.kind.name()));
            } else {
                rows.extend(course.measure(&set, &mut contestants, &mut offences));
            }
        }
        say!("{}", of_scene(&rows[first..]));
    }
    Ok(Found { rows, notes: once_each(notes), offences })
}

/// Removes duplicates, and keeps the order of first occurrences.
fn once_each<T: PartialEq>(all: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut once = Vec::new();
    for one in all {
        if !once.contains(&one) {
            once.push(one);
        }
    }
    once
}

/// A scene for all contestants.
struct Course<'a> {
    scene: &'a Scene,
    truth: Truth,
    rounds: usize,
}

impl Course<'_> {
    /// Measures all contestants on the rays of one set. An offence is an error of an exact contestant, in words.
    fn measure(&self, set: &Set, contestants: &mut [Box<dyn Contestant + '_>], offences: &mut Vec<String>) -> Vec<Row> {
        let name = format!("{}, {}", self.scene.name, set.kind.name());
        let mut answers = vec![None; set.rays.len()];
        let mut nodes = Vec::new();
        let mut expected = None;
        for contestant in contestants.iter_mut() {
            contestant.take(&set.rays);
            contestant.trace(set.query, &set.rays, 0, &mut answers);
            if contestant.accuracy() == Some(Accuracy::Exact) {
                let expected = expected.get_or_insert_with(|| answers.clone());
                let differs = expected.iter().zip(&answers).position(|(a, b)| !is_same(set.query, *a, *b));
                offences.extend(differs.map(|i| {
                    let (ray, method) = (csv_line(&set.rays[i]), contestant.method());
                    format!("{name}: ray {ray}: {:?} by {method}, but {:?} by stack", answers[i], expected[i])
                }));
            }
            nodes.push(contestant.nodes(set.query, &set.rays));
        }
        let times = take_turns(contestants.len(), set.rays.len(), CHUNK, self.rounds, &name, |i, chunk| {
            let (first, rays) = (chunk.start, &set.rays[chunk.clone()]);
            contestants[i].trace(set.query, rays, first, &mut answers[chunk.clone()]);
            black_box(&answers[chunk]);
        });
        let counts = self.judge(set, contestants, &name);
        for (contestant, counts) in contestants.iter().zip(&counts) {
            let is_exact = contestant.accuracy() == Some(Accuracy::Exact);
            let offence = counts.as_ref().and_then(|counts| counts.offence.as_ref()).filter(|_| is_exact);
            offences.extend(offence.map(|(_, what)| format!("{name}: {}: {what}", contestant.method())));
        }
        let exact_stack = (Method::Stack.name(), Some(Accuracy::Exact));
        let exact_stack = contestants.iter().position(|other| (other.method(), other.accuracy()) == exact_stack);
        let rows = contestants.iter().zip(nodes).zip(counts).enumerate().map(|(i, ((contestant, nodes), counts))| {
            let base = if contestant.accuracy().is_some() { 0 } else { exact_stack.unwrap_or(0) };
            let row = Row::new(self.scene, set, contestant.as_ref());
            row.timed(&times, i, base).counted(nodes).judged(counts.as_ref())
        });
        rows.collect()
    }

    /// Counts the errors of each contestant.
    fn judge(&self, set: &Set, contestants: &mut [Box<dyn Contestant + '_>], name: &str) -> Vec<Option<Counts>> {
        let truths = Truths::new(&self.truth, &set.rays, JUDGED, name);
        let counts = contestants.iter_mut().map(|contestant| {
            if !contestant.is_judged() {
                return None;
            }
            let mut answers = vec![None; truths.rays().len()];
            contestant.take(truths.rays());
            contestant.trace(set.query, truths.rays(), 0, &mut answers);
            let judged = answers.into_iter().enumerate().map(|(i, answer)| match set.query {
                Query::Closest => [answer],
                // The query does not return a triangle. A hit counts as the closest triangle, if there is one.
                Query::Any => [answer.map(|answer| truths.closest(i).unwrap_or(answer))],
            });
            Some(truths.counts(set.query, &judged.collect::<Vec<_>>()))
        });
        counts.collect()
    }
}
