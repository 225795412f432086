//! `lab motion`: a moving mesh with refits, optimised refits and builds, and the time of rays.

use std::ops::Range;
use std::path::PathBuf;

use cpu_time::ProcessTime;
use serde::Serialize;
use serde_json::json;
use stackless_bvh::bvh::{BuildOptions, Builder, Bvh, Degenerate, WideBvh};
use stackless_bvh::geom::{Aabb, Mesh, Ray};
use stackless_bvh::internals::trace::bounce;
use stackless_bvh::trace::Tracer;

use crate::input::{self, Scene};
use crate::output::{say, table};
use crate::places::{self, Output};
use crate::record::write_figures;
use crate::turns::take_turns;
use crate::{Outcome, camera};

/// Measure the cost of a moving mesh: new boxes for an old tree, new boxes and moved subtrees, and new trees.
///
/// The mesh is twisted about the vertical axis, further in each frame. Update times are processor time of all threads,
/// the least over the frames. The time of a diffuse ray is relative to a tree built for the frame (`standard`). Trees
/// alternate on the same rays.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  lab motion examples/data/torus.ply --threads 1")]
pub(crate) struct Args {
    /// Mesh files (.ply, .obj, .stl, .gltf, .glb), or the generated scenes `strands`, `stadium`, `soup`.
    #[arg(required = true)]
    scenes: Vec<PathBuf>,
    /// Number of frames after the first.
    #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=1000))]
    frames: u32,
    /// Twist of the upper end in the last frame, relative to the lower end, in degrees.
    #[arg(long, default_value_t = 90.0)]
    turn: f32,
    /// Number of camera rays. There is a diffuse ray for each of their hits.
    #[arg(long, default_value_t = 16_384, value_parser = clap::value_parser!(u32).range(1..=1 << 28))]
    count: u32,
    /// Number of rounds.
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    rounds: u32,
    #[command(flatten)]
    place: camera::Place,
    /// Seed of the rays.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write the figures to this file.
    #[arg(long, value_name = "FILE", value_parser = places::file())]
    json: Option<Output>,
}

/// Figures of one tree.
#[derive(Serialize)]
struct Row {
    scene: String,
    method: &'static str,
    /// Nanoseconds per triangle and frame.
    update: f64,
    /// Time of rays, relative to a new tree, by frame.
    rays: Vec<f64>,
}

pub(crate) fn run(args: &Args) -> Outcome {
    let scenes = input::scenes(&args.scenes)?;
    let mut rows = Vec::new();
    for scene in &scenes {
        rows.extend(measure(args, scene)?);
    }
    let cells = |Row { scene, method, update, rays }: &Row| {
        let [first, last] =
            [rays.first(), rays.last()].map(|rays| rays.map_or_else(String::new, |rays| format!("{rays:.2}")));
        vec![scene.clone(), (*method).to_owned(), format!("{update:.0}"), first, last]
    };
    let header = ["scene", "method", "update ns/triangle", "rays, first frame", "rays, last frame"];
    say!("{}", table(&header, 2, rows.iter().map(cells).collect()));
    if let Some(path) = &args.json {
        write_figures(path, "motion", &scenes, json!({ "rows": rows }))?;
    }
    Ok(true)
}

/// A tree that follows the motion.
trait Follower {
    fn name(&self) -> &'static str;

    /// Adapts the tree to the mesh of a frame.
    fn follow(&mut self, mesh: &Mesh) -> Result<(), Box<dyn std::error::Error>>;

    /// Prepares these rays, untimed.
    fn take(&mut self, _rays: &[Ray]) {}

    /// Traces some of the prepared rays, and counts hits.
    fn trace(&self, rays: &[Ray], range: Range<usize>) -> usize;
}

/// Number of rays that a tree traces before the next tree continues.
const CHUNK: usize = 2048;

fn measure(args: &Args, scene: &Scene) -> Result<Vec<Row>, Box<dyn std::error::Error>> {
    let mut followers: Vec<Box<dyn Follower>> = Vec::new();
    for how in [How::Built(Builder::Standard), How::Optimized, How::Refitted] {
        followers.push(Box::new(Own { how, tree: options(Builder::Standard).build_wide(&scene.mesh)? }));
    }
    let own = followers.len();
    #[cfg(feature = "peers")]
    followers.extend(peers::followers(&scene.mesh)?);
    let triangles = scene.mesh.triangles().len() as f64;
    let row = |method| Row { scene: scene.name.clone(), method, update: f64::INFINITY, rays: Vec::new() };
    let mut rows: Vec<_> = followers.iter().map(|follower| row(follower.name())).collect();
    for frame in 1..=args.frames {
        let moved = twisted(&scene.mesh, args.turn.to_radians() * frame as f32 / args.frames as f32)?;
        for (follower, row) in followers.iter_mut().zip(&mut rows) {
            let start = ProcessTime::now();
            follower.follow(&moved)?;
            row.update = row.update.min(start.elapsed().as_secs_f64() * 1e9 / triangles);
        }
        let moved = Scene { name: scene.name.clone(), mesh: moved, faces: Vec::new() };
        let primary = args.place.of(&moved).rays(args.count as usize);
        let rays = bounce(&moved.mesh, &Bvh::build(&moved.mesh)?, &primary, args.seed);
        for follower in &mut followers {
            follower.take(&rays);
        }
        let mut hits = vec![0; followers.len()];
        let times = take_turns(followers.len(), rays.len(), CHUNK, args.rounds as usize, &scene.name, |i, range| {
            hits[i] += followers[i].trace(&rays, range);
        });
        let seconds = |i: usize| times.by_chunk(i).iter().sum::<f64>();
        for (i, row) in rows.iter_mut().enumerate() {
            row.rays.push(seconds(i) / seconds(0));
        }
        if hits[1..own].iter().any(|&other| other != hits[0]) {
            return Err(
                format!("{}, frame {frame}: {:?} hits, expected equal numbers", scene.name, &hits[..own]).into()
            );
        }
    }
    Ok(rows)
}

/// Keeps degenerate triangles, because they may have an area in a later frame.
fn options(builder: Builder) -> BuildOptions {
    BuildOptions { builder, degenerate: Degenerate::Kept, ..BuildOptions::default() }
}

/// The mesh, twisted about the vertical axis by `turn` radians from its lower end to its upper end.
fn twisted(mesh: &Mesh, turn: f32) -> Result<Mesh, Box<dyn std::error::Error>> {
    let bounds = Aabb::of(mesh.vertices());
    let (middle, height) = (bounds.centroid(), bounds.extent().y.max(f32::MIN_POSITIVE));
    let moved = mesh.vertices().iter().map(|&v| (v - middle).rotate_y(turn * (v.y - bounds.lo.y) / height) + middle);
    Ok(Mesh::new(moved.collect(), mesh.triangles().to_vec())?)
}

/// A tree of this library.
struct Own {
    how: How,
    tree: WideBvh,
}

/// The kind of update.
enum How {
    Built(Builder),
    Optimized,
    Refitted,
}

impl Follower for Own {
    fn name(&self) -> &'static str {
        match self.how {
            How::Built(builder) => builder.name(),
            How::Optimized => "refit, optimize",
            How::Refitted => "refit",
        }
    }

    fn follow(&mut self, mesh: &Mesh) -> Result<(), Box<dyn std::error::Error>> {
        if let How::Built(builder) = self.how {
            self.tree = options(builder).build_wide(mesh)?;
            return Ok(());
        }
        self.tree.refit(mesh)?;
        if let How::Optimized = self.how {
            self.tree.optimize()?;
        }
        Ok(())
    }

    fn trace(&self, rays: &[Ray], range: Range<usize>) -> usize {
        let mut found = vec![None; range.len()];
        Tracer::new(&self.tree).closest_distances(&rays[range], &mut found);
        found.iter().flatten().count()
    }
}

#[cfg(feature = "peers")]
mod peers {
    use stackless_peers::{Moving, Peer, PeerError, Tracer};

    use super::{Follower, Mesh, Range, Ray};
    use crate::bench::{plain, vertices};

    /// Embree, with refits and with builds; empty if Embree is not installed.
    pub(super) fn followers(mesh: &Mesh) -> Result<Vec<Box<dyn Follower>>, PeerError> {
        let vertices = vertices(mesh);
        let moving = match Moving::new(&vertices, mesh.triangles()) {
            Err(PeerError::NotInstalled(_)) => return Ok(Vec::new()),
            moving => moving?,
        };
        let built = Peer::Embree.build(&vertices, mesh.triangles())?;
        let embree = |tree| -> Box<dyn Follower> { Box::new(Embree { tree, rays: Vec::new() }) };
        Ok(vec![embree(Tree::Built(built)), embree(Tree::Refitted(moving))])
    }

    /// Embree's tree of a mesh.
    struct Embree {
        tree: Tree,
        rays: Vec<stackless_peers::Ray>,
    }

    enum Tree {
        Built(Box<dyn Tracer>),
        Refitted(Moving),
    }

    impl Follower for Embree {
        fn name(&self) -> &'static str {
            match self.tree {
                Tree::Built(_) => "embree",
                Tree::Refitted(_) => "embree, refit",
            }
        }

        fn follow(&mut self, mesh: &Mesh) -> Result<(), Box<dyn std::error::Error>> {
            match &mut self.tree {
                Tree::Built(tracer) => *tracer = Peer::Embree.build(&vertices(mesh), mesh.triangles())?,
                Tree::Refitted(moving) => moving.refit(&vertices(mesh))?,
            }
            Ok(())
        }

        fn take(&mut self, rays: &[Ray]) {
            self.rays = rays.iter().map(plain).collect();
        }

        fn trace(&self, _: &[Ray], range: Range<usize>) -> usize {
            let mut hits = vec![None; range.len()];
            match &self.tree {
                Tree::Built(tracer) => tracer.closest(&self.rays[range], &mut hits),
                Tree::Refitted(moving) => moving.closest(&self.rays[range], &mut hits),
            }
            hits.iter().flatten().count()
        }
    }
}
