//! `stackless stats`: a scene's hierarchies, hash tables and backtracks.

mod wide;

use std::cell::Cell;
use std::path::PathBuf;
use std::slice::from_ref;
use std::time::Instant;

use crate::plots::plot_distances;
use serde::Serialize;
use stackless_bvh::bvh::{Builder, Bvh};
use stackless_bvh::generate::procedural::{self, View};
use stackless_bvh::hash::{self, BuildError, KeySet, Lookup, Options, PerfectHash, Sizing};
use stackless_bvh::internals::event::{Backtracks, Source};
use stackless_bvh::internals::trace::{Closest, bounce};
use stackless_bvh::internals::traverse::{WithWord, with_word};
use stackless_bvh::key::KeyWord;
use stackless_bvh::traverse::{Hashed, WordName, traverse};
use stackless_bvh::tree::{Linked, Node, Reach, Topology};

use crate::build;
use crate::input::Scene;
use crate::output::{self, Table, grouped, say, table, write_file};
use crate::places::{self, Output};
use crate::record::write_figures;
use crate::{Outcome, camera};

/// Summarise the hierarchies and hash tables of a scene, its backtracks, and the parts that the tracer omits, in six
/// lines. Print tables with -v.
///
/// The figures correspond to Table 1 and Fig. 3 of Binder & Keller 2016. Backtracks are those of closest-hit rays: half
/// of the rays start at a camera, half at the hits of those rays in random directions.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    stackless stats examples/data/room.obj\n  \
    stackless stats examples/data/torus.ply --build sbvh --plot distances.svg --json stats.json")]
pub(crate) struct Args {
    /// Mesh file (.ply, .obj, .stl, .gltf, .glb), or a generated scene: `strands`, `stadium`, `soup`.
    scene: PathBuf,
    /// Builder of the hierarchy.
    #[arg(long, default_value_t, value_parser = build::builder())]
    build: Builder,
    /// Number of rays.
    #[arg(long, default_value_t = 65_536, value_parser = clap::value_parser!(u32).range(1..=1 << 28))]
    count: u32,
    #[command(flatten)]
    place: camera::Place,
    /// Seed of the rays.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write the figures to this file.
    #[arg(long, value_name = "FILE", value_parser = places::file())]
    json: Option<Output>,
    /// Draw the backtracking distances into this .svg file.
    #[arg(long, value_name = "FILE", value_parser = places::file_as("svg"))]
    plot: Option<Output>,
}

/// The file of `--json`.
#[derive(Serialize)]
struct Stats {
    scene: String,
    triangles: usize,
    nodes: usize,
    depth: u32,
    tree_bytes: usize,
    bytes_per_triangle: f64,
    /// Triangles without area, which rays miss.
    dropped: usize,
    /// Additional references to triangles.
    duplicates: usize,
    /// Build time, on all threads.
    build_seconds: f64,
    /// The tables of the traversals.
    tables: TableStats,
    /// Tables of other sizes.
    other_tables: Vec<TableStats>,
    backtracks: BacktrackStats,
    /// The hierarchy of eight children.
    wide: wide::WideStats,
    #[serde(skip)]
    counted: Backtracks,
}

#[derive(Serialize)]
struct TableStats {
    sizing: &'static str,
    keys: u32,
    #[serde(rename = "D")]
    d: u32,
    #[serde(rename = "H")]
    h: u32,
    bytes: usize,
    /// Share of the tree's bytes.
    share: f64,
    direct_share: f64,
    /// Number of tried seeds; 0 for the hash function in the paper.
    reseeds: u32,
    /// On one thread.
    build_seconds: f64,
    /// On all threads.
    parallel_build_seconds: f64,
}

#[derive(Serialize)]
struct BacktrackStats {
    total: u64,
    register: f64,
    uncle: f64,
    grand_uncle: f64,
    leaf: f64,
    hash: f64,
    /// Share of the hash lookups that took one load.
    hash_direct: f64,
    /// Number of hash lookups per ray.
    hash_per_ray: f64,
    /// Number of backtracks over each distance, in levels.
    distances: Vec<u64>,
}

pub(crate) fn run(args: &Args) -> Outcome {
    let scene = Scene::load(&args.scene)?;
    let stats = Stats::of(&scene, &args.place.of(&scene), args.build, args.count as usize, args.seed)?;
    stats.lines().iter().for_each(|line| say!("{line}"));
    stats.tables().iter().for_each(output::detail);
    if let Some(path) = &args.plot {
        let svg = stats.plot();
        write_file(path, |file| file.write_all(svg.as_bytes()))?;
    }
    if let Some(path) = &args.json {
        write_figures(path, "stats", from_ref(&scene), &stats)?;
    }
    Ok(true)
}

/// Builds tables three times, serially and in parallel, and keeps the median times. Every table is certified.
fn measure(bvh: &Bvh, sizing: Sizing) -> Result<TableStats, Box<dyn std::error::Error>> {
    let options = Options { key_set: KeySet::Exact(Reach::ALGORITHM_1), sizing };
    let hash = PerfectHash::build(bvh, options)?;
    hash::certify(&hash, bvh, options.key_set)?;
    let median = |build: &dyn Fn() -> Result<PerfectHash, BuildError>| {
        let mut seconds = [(); 3].map(|()| timed(build).1);
        seconds.sort_by(f64::total_cmp);
        seconds[1]
    };
    let header = hash.header();
    Ok(TableStats {
        sizing: sizing.name(),
        keys: header.keys,
        d: header.displacements,
        h: header.cells.get(),
        bytes: header.bytes(),
        share: header.bytes() as f64 / bvh.bytes() as f64,
        direct_share: header.direct_share(),
        reseeds: header.reseeds,
        build_seconds: median(&|| PerfectHash::build(bvh, options)),
        parallel_build_seconds: median(&|| PerfectHash::build_parallel(bvh, options)),
    })
}

fn timed<T>(f: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let value = f();
    (value, start.elapsed().as_secs_f64())
}

/// Counts of hash lookups.
#[derive(Clone, Copy, Default)]
struct Lookups {
    all: u64,
    direct: u64,
    rays: usize,
}

/// A hash that counts its lookups.
struct Counted<'a> {
    hash: &'a PerfectHash,
    lookups: &'a Cell<Lookups>,
}

impl<W: KeyWord> Lookup<W> for Counted<'_> {
    fn node(&self, key: &W) -> Node {
        let Lookups { all, direct, rays } = self.lookups.get();
        let direct = direct + u64::from(self.hash.is_direct(key));
        self.lookups.set(Lookups { all: all + 1, direct, rays });
        self.hash.node(key)
    }
}

struct Count<'a> {
    rays: usize,
    seed: u64,
    scene: &'a Scene,
    bvh: &'a Bvh,
}

impl WithWord for Count<'_> {
    type Output = Result<(Backtracks, Lookups), Box<dyn std::error::Error>>;

    fn call<W: KeyWord>(self) -> Self::Output {
        let Self { rays: n, seed, scene, bvh } = self;
        let uncles = Linked::uncles(bvh);
        let options = Options { key_set: KeySet::Exact(Reach::ALGORITHM_1), sizing: Sizing::Tight };
        let hash = PerfectHash::build(bvh, options)?;
        let mut rays = procedural::camera_rays(&scene.mesh, seed, n / 2);
        let bounced = bounce(&scene.mesh, bvh, &rays, seed);
        rays.extend(bounced);
        let lookups = Cell::new(Lookups { rays: rays.len(), ..Lookups::default() });
        let mut backtracks = Backtracks::new(Reach::ALGORITHM_1);
        for ray in &rays {
            backtracks.begin();
            let cursor = Hashed::<W, _, _>::new(&uncles, Counted { hash: &hash, lookups: &lookups });
            traverse(cursor?, &mut Closest::new(bvh, ray), &mut backtracks);
        }
        Ok((backtracks, lookups.get()))
    }
}

impl BacktrackStats {
    fn of(backtracks: &Backtracks, lookups: Lookups) -> Self {
        let total = backtracks.total();
        let share = |source| backtracks.by(source) as f64 / total.max(1) as f64;
        Self {
            total,
            register: share(Source::Register),
            uncle: share(Source::Uncle),
            grand_uncle: share(Source::GrandUncle),
            leaf: share(Source::Leaf),
            hash: share(Source::Hash),
            hash_direct: lookups.direct as f64 / lookups.all.max(1) as f64,
            hash_per_ray: lookups.all as f64 / lookups.rays.max(1) as f64,
            distances: backtracks.distances().to_vec(),
        }
    }
}

impl Stats {
    /// Builds a scene's hierarchies and measures them with `rays` rays.
    fn of(
        scene: &Scene,
        view: &View,
        build: Builder,
        rays: usize,
        seed: u64,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        let (bvh, build_seconds) = timed(|| build::binary(build, scene));
        let bvh = bvh?;
        let mut tables = Vec::new();
        for sizing in [Sizing::Tight, Sizing::PrintedHashed, Sizing::Printed] {
            tables.push(measure(&bvh, sizing)?);
        }
        let word = WordName::narrowest(bvh.depth());
        let (counted, lookups) = with_word(word, Count { rays, seed, scene, bvh: &bvh })?;
        let primary = view.rays(rays / 4);
        Ok(Self {
            scene: scene.name.clone(),
            triangles: scene.mesh.triangles().len(),
            nodes: bvh.node_count(),
            depth: bvh.depth(),
            tree_bytes: bvh.bytes(),
            bytes_per_triangle: bvh.bytes() as f64 / scene.mesh.triangles().len() as f64,
            dropped: scene.degenerate(),
            duplicates: bvh.duplicates(),
            build_seconds,
            tables: tables.remove(0),
            other_tables: tables,
            backtracks: BacktrackStats::of(&counted, lookups),
            wide: wide::measure(scene, &primary)?,
            counted,
        })
    }

    /// Draws the backtracking distances (SVG).
    fn plot(&self) -> String {
        plot_distances(&format!("Backtracking distance, {}", self.scene), &self.counted)
    }

    fn lines(&self) -> [String; 6] {
        let Self { tables, backtracks: shares, .. } = self;
        [
            format!(
                "{}: {} triangles, {} nodes, depth {}, {} bytes ({:.1} a triangle), built in {:.1} ms; {} triangles without area, {} duplicate references",
                self.scene,
                grouped(self.triangles as u64),
                grouped(self.nodes as u64),
                self.depth,
                grouped(self.tree_bytes as u64),
                self.bytes_per_triangle,
                self.build_seconds * 1e3,
                grouped(self.dropped as u64),
                grouped(self.duplicates as u64)
            ),
            format!(
                "perfect hash: {} keys, {} bytes ({} of the tree), {} of the keys direct, built in {:.1} ms",
                grouped(tables.keys.into()),
                grouped(tables.bytes as u64),
                percent(tables.share),
                percent(tables.direct_share),
                tables.build_seconds * 1e3
            ),
            format!(
                "{} backtracks: register {}, uncle {}, grand uncle {}, leaf {}, hash {}; {:.2} lookups a ray, {} of them direct",
                grouped(shares.total),
                percent(shares.register),
                percent(shares.uncle),
                percent(shares.grand_uncle),
                percent(shares.leaf),
                percent(shares.hash),
                shares.hash_per_ray,
                percent(shares.hash_direct)
            ),
            self.wide.line(),
            self.wide.choice(),
            self.wide.omitted(),
        ]
    }

    fn tables(&self) -> [Table; 5] {
        let header =
            ["tables", "keys", "D", "H", "bytes", "of tree", "direct", "reseeds", "ms", "of build", "ms parallel"];
        let rows = std::iter::once(&self.tables).chain(&self.other_tables).map(|tables| {
            let numbers = [u64::from(tables.keys), u64::from(tables.d), u64::from(tables.h), tables.bytes as u64];
            let mut row = vec![tables.sizing.to_owned()];
            row.extend(numbers.map(grouped));
            row.extend([percent(tables.share), percent(tables.direct_share), tables.reseeds.to_string()]);
            row.push(format!("{:.2}", tables.build_seconds * 1e3));
            row.push(percent(tables.build_seconds / self.build_seconds));
            row.push(format!("{:.2}", tables.parallel_build_seconds * 1e3));
            row
        });
        let shares = &self.backtracks;
        let mut cumulative = 0;
        let distances = shares.distances.iter().enumerate().map(|(distance, &count)| {
            cumulative += count;
            let of_all = |count: u64| percent(count as f64 / shares.total.max(1) as f64);
            vec![distance.to_string(), grouped(count), of_all(count), of_all(cumulative)]
        });
        [
            table(&header, 1, rows.collect()),
            self.wide.to_table(),
            self.wide.otherwise(),
            self.wide.plan(),
            table(&["levels up", "backtracks", "share", "cumulative"], 0, distances.collect()),
        ]
    }
}

fn percent(share: f64) -> String {
    if share.is_finite() { format!("{:.1} %", 100.0 * share) } else { "-".to_owned() }
}
