//! `stackless bench`: the traversals beside each other, in one run.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use serde::Serialize;
use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::geom::{Aabb, Ray};
use stackless_bvh::key::KeyWord;
use stackless_bvh::scene::procedural;
use stackless_bvh::trace::{self, ClosestByNode, Counted};
use stackless_bvh::traverse::{Method, Tables, Unfit};
use stackless_bvh::tree::{Implicit, Node, Recorded, Topology};

use crate::Outcome;
use crate::input::{self, Scene};
use crate::output::{bar, say, table, write_json};

/// Measure closest-hit throughput on one thread, same tree, same rays.
///
/// Traversals take turns on chunks of the rays; the ratio is the median over the rounds of the time of `stack` to that
/// of the traversal. The hits of all must be the same, or the exit code is 1.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Mesh files (.ply, .obj), or the made scenes `strands`, `stadium`, `soup`.
    #[arg(required = true)]
    scenes: Vec<PathBuf>,
    /// Only these traversals (and `stack`), separated by commas.
    #[arg(long, value_delimiter = ',', value_parser = input::method)]
    methods: Vec<Method>,
    /// Number of rays: half from a camera, half from where those hit, in all directions.
    #[arg(long, default_value_t = 131_072)]
    rays: usize,
    /// How often all rays are traced.
    #[arg(long, default_value_t = 7)]
    rounds: usize,
    /// Seed of the rays.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write the figures to this file.
    #[arg(long)]
    json: Option<PathBuf>,
}

/// Rays that are timed before it is another traversal's turn; as many others are traced first.
const CHUNK: usize = 16_384;

#[derive(Serialize)]
struct Row {
    scene: String,
    rays: &'static str,
    method: &'static str,
    mrays: f64,
    ratio: f64,
    state_bytes: usize,
    nodes_per_ray: f64,
}

pub(crate) fn run(args: &Args) -> Outcome {
    let scenes = input::scenes(&args.scenes)?;
    let mut methods = if args.methods.is_empty() { Method::ALL.to_vec() } else { args.methods.clone() };
    // The tree is built for speed and so is not complete; `stack` is what the others are measured by.
    methods.retain(|&method| method != Method::Complete && method != Method::Stack);
    methods.insert(0, Method::Stack);
    let (mut rows, mut all_agree) = (Vec::new(), true);
    for scene in &scenes {
        let bvh = Bvh::sah(&scene.mesh, SahOptions::default())?;
        let with_parents = bvh.clone().with_links(Recorded::ParentSibling);
        let bench = Bench::new(scene, [&bvh, &with_parents], &methods, args);
        let measured = if bvh.depth() <= 30 { bench.run::<u32>() } else { bench.run::<u64>() };
        let (measured, agree) = measured.map_err(|unfit| format!("{}: {unfit}", scene.name))?;
        all_agree &= agree;
        let lines = measured.iter().map(Row::cells).collect();
        let header = ["scene", "method", "Mrays/s", "ratio", "state bytes", "nodes/ray"];
        say!("{}", table(&header, 2, lines));
        rows.extend(measured);
    }
    if let Some(path) = &args.json {
        write_json(path, &rows)?;
    }
    if !all_agree {
        say!("the hits differ: run `stackless check` on the scene");
    }
    Ok(all_agree)
}

struct Bench<'a> {
    scene: &'a Scene,
    /// The hierarchy with uncles in its records, and the same with parents and siblings.
    trees: [&'a Bvh; 2],
    boxes: Vec<Aabb>,
    methods: &'a [Method],
    rays: Vec<Ray>,
    rounds: usize,
}

/// A traversal with the tree whose records suit it, and that tree's tables.
struct Runner<'a> {
    method: Method,
    bvh: &'a Bvh,
    boxes: &'a [Aabb],
    tables: Tables<'a, Bvh>,
}

impl<'a> Bench<'a> {
    fn new(scene: &'a Scene, trees: [&'a Bvh; 2], methods: &'a [Method], args: &Args) -> Self {
        let boxes = trees[0].own_boxes();
        let mut rays = procedural::camera_rays(&scene.mesh, args.seed, args.rays / 2);
        let bounced = trace::bounce(&scene.mesh, trees[0], &rays, args.seed);
        rays.extend(bounced);
        Self { scene, trees, boxes, methods, rays, rounds: args.rounds.max(1) }
    }

    fn runner(&self, method: Method) -> Runner<'_> {
        let bvh = self.trees[usize::from(method.wants_recorded() == Recorded::ParentSibling)];
        let tables = Tables::new(bvh, bvh.axes(), &[method], Implicit::LIMIT);
        Runner { method, bvh, boxes: &self.boxes, tables }
    }

    fn run<W: KeyWord>(&self) -> Result<(Vec<Row>, bool), Unfit> {
        let runners: Vec<_> = self.methods.iter().map(|&method| self.runner(method)).collect();
        let chunks: Vec<_> = self.rays.chunks(CHUNK).collect();
        let progress = bar((self.rounds * chunks.len()) as u64, &self.scene.name);
        // times[m] has the time of traversal m for each round.
        let mut times = vec![vec![Duration::ZERO; self.rounds]; runners.len()];
        let mut hits = vec![0_u64; runners.len()];
        let mut memory = Vec::new();
        for turn in 0..self.rounds * chunks.len() {
            // Each turn starts with another traversal, so that none always has the same one before it.
            for i in 0..runners.len() {
                let m = (turn + i) % runners.len();
                // Other rays than the traversal before, which would leave these rays' nodes in the caches; and still
                // others first, untimed, to bring its own tree and tables there.
                let chunk = |ahead: usize| chunks[(turn + m + ahead) % chunks.len()];
                runners[m].trace::<W>(chunk(chunks.len() / 2), &mut memory)?;
                let rays = chunk(0);
                let start = Instant::now();
                let sum = runners[m].trace::<W>(rays, &mut memory)?;
                times[m][turn / chunks.len()] += start.elapsed();
                hits[m] = hits[m].wrapping_add(sum);
            }
            progress.inc(1);
        }
        progress.finish_and_clear();
        let mut rows = Vec::new();
        for (runner, own) in runners.iter().zip(&times) {
            let nodes = runner.count::<W>(&self.rays, &mut memory)?;
            let ratios = times[0].iter().zip(own).map(|(stack, own)| stack.as_secs_f64() / own.as_secs_f64());
            let traced = (self.rounds * self.rays.len()) as f64;
            rows.push(Row {
                scene: self.scene.name.clone(),
                rays: "camera + diffuse, closest hit",
                method: runner.method.name(),
                mrays: traced / own.iter().sum::<Duration>().as_secs_f64() / 1e6,
                ratio: median(ratios.collect()),
                state_bytes: runner.method.state_bytes::<W>(runner.bvh.depth()),
                nodes_per_ray: nodes as f64 / self.rays.len() as f64,
            });
        }
        Ok((rows, hits.iter().all(|&sum| sum == hits[0])))
    }
}

impl Runner<'_> {
    /// Traces rays and sums their hits up in one number.
    #[inline(never)]
    fn trace<W: KeyWord>(&self, rays: &[Ray], memory: &mut Vec<Node>) -> Result<u64, Unfit> {
        let mut sum = 0_u64;
        for ray in rays {
            let mut search = ClosestByNode::new(self.bvh, self.boxes, ray);
            self.tables.run::<W, _>(self.method, ray.octant(), memory, &mut search, &mut ())?;
            if let Some(hit) = search.hit() {
                sum = sum.wrapping_add(u64::from(hit.t.to_bits()) << 32 | u64::from(hit.prim));
            }
        }
        Ok(sum)
    }

    /// Visits of inner nodes and leaves by all rays.
    fn count<W: KeyWord>(&self, rays: &[Ray], memory: &mut Vec<Node>) -> Result<u64, Unfit> {
        let mut sum = 0;
        for ray in rays {
            let mut search = Counted::new(ClosestByNode::new(self.bvh, self.boxes, ray));
            self.tables.run::<W, _>(self.method, ray.octant(), memory, &mut search, &mut ())?;
            sum += search.inner + search.leaves;
        }
        Ok(sum)
    }
}

impl Row {
    fn cells(&self) -> Vec<String> {
        vec![
            self.scene.clone(),
            self.method.to_owned(),
            format!("{:.3}", self.mrays),
            format!("{:.3}", self.ratio),
            self.state_bytes.to_string(),
            format!("{:.1}", self.nodes_per_ray),
        ]
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
