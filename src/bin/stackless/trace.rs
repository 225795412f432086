//! `stackless trace`: the caller's rays through a scene.

use std::path::PathBuf;

use rayon::prelude::*;
use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::check::{WithWord, with_word};
use stackless_bvh::geom::{Aabb, Ray};
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::{NodeTest, Visitor};
use stackless_bvh::scene;
use stackless_bvh::trace::{AnyByNode, ClosestByNode, Hit};
use stackless_bvh::traverse::{Method, Tables, Unfit};
use stackless_bvh::tree::{Implicit, Node, Topology};

use crate::Outcome;
use crate::input::{self, Scene};
use crate::output::{bar, say};

/// Trace rays through a scene.
///
/// A ray is a line of ox,oy,oz,dx,dy,dz,tmin,tmax; a hit is a line of prim,t,u,v, where prim is the index of the
/// triangle in the file's order (polygons are fanned out in place), or -1 for a miss, with the other columns empty.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Mesh file (.ply, .obj), or a made scene: `strands`, `stadium`, `soup`.
    scene: PathBuf,
    /// File of the rays.
    #[arg(long)]
    rays: PathBuf,
    /// File for the hits; written whole or not at all.
    #[arg(long)]
    out: PathBuf,
    /// The traversal.
    #[arg(long, default_value = "hashed", value_parser = input::method)]
    method: Method,
    /// End at the first hit that is met, instead of finding the closest.
    #[arg(long)]
    any: bool,
}

pub(crate) fn run(args: &Args) -> Outcome {
    let rays = scene::read_rays(&args.rays)?;
    let scene = Scene::load(&args.scene)?;
    // Only complete trees have computed addresses.
    let bvh = match args.method {
        Method::Complete => Bvh::median(&scene.mesh, 4)?,
        _ => Bvh::sah(&scene.mesh, SahOptions::default())?,
    };
    let boxes = bvh.own_boxes();
    let tables = Tables::new(&bvh, bvh.axes(), &[args.method], Implicit::LIMIT);
    let hits = with_word(input::narrowest(bvh.depth()), Trace { args, bvh: &bvh, tables, boxes, rays: &rays })
        .map_err(|unfit| format!("{}: {unfit}", args.method))?;
    let rows = hits.iter().map(|hit| hit.map(|Hit { prim, t, u, v }| (prim, t, u, v)));
    scene::write_atomically(&args.out, |file| scene::write_hits(file, rows))
        .map_err(|error| format!("{}: cannot be written: {error}", args.out.display()))?;
    let hit = hits.iter().flatten().count();
    say!("{}: {} rays, {hit} hits, by {}", scene.name, rays.len(), args.method);
    Ok(true)
}

struct Trace<'a> {
    args: &'a Args,
    bvh: &'a Bvh,
    tables: Tables<'a, Bvh>,
    boxes: Vec<Aabb>,
    rays: &'a [Ray],
}

impl WithWord for Trace<'_> {
    type Output = Result<Vec<Option<Hit>>, Unfit>;

    fn call<W: KeyWord>(self) -> Self::Output {
        let progress = bar(self.rays.len() as u64, "rays");
        let trace = |memory: &mut Vec<Node>, ray: &Ray| {
            let hit = if self.args.any {
                let search = AnyByNode::new(self.bvh, &self.boxes, ray);
                self.trace_one::<W, _>(search, ray, memory)?.hit()
            } else {
                let search = ClosestByNode::new(self.bvh, &self.boxes, ray);
                self.trace_one::<W, _>(search, ray, memory)?.hit()
            };
            progress.inc(1);
            Ok(hit)
        };
        let hits = self.rays.par_iter().with_min_len(1024).map_init(Vec::new, trace).collect();
        progress.finish_and_clear();
        hits
    }
}

impl Trace<'_> {
    fn trace_one<W: KeyWord, S: Visitor + NodeTest>(
        &self,
        mut search: S,
        ray: &Ray,
        memory: &mut Vec<Node>,
    ) -> Result<S, Unfit> {
        self.tables.run::<W, S>(self.args.method, ray.octant(), memory, &mut search, &mut ())?;
        Ok(search)
    }
}
