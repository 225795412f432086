//! The timed and judged rays.

use std::ops::Range;

use rayon::prelude::*;
use stackless_bvh::generate::procedural::View;
use stackless_bvh::generate::{Rng, stress};
use stackless_bvh::geom::Ray;
use stackless_bvh::internals::trace::{Closest, reflect};
use stackless_bvh::traverse::{Stack, traverse};

use super::pairs::Trees;
use super::rows::Kind;
use crate::input::Scene;
use crate::judge::Query;
use crate::output::bar;
use crate::record::in_blocks;

/// Rays of one kind with their numbers, for one kind of query.
pub(super) struct Set {
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    pub(super) query: Query,
    pub(super) numbers: Vec<u64>,
    pub(super) rays: Vec<Ray>,
}

/// All sets: from each set, the rays with these numbers of `of`; adversarial rays only below `aimed`.
pub(super) fn sets(
    scene: &Scene,
    view: &View,
    trees: &Trees,
    seed: u64,
    numbers: Range<u64>,
    of: u64,
    aimed: u64,
) -> [Set; 5] {
    let primary = |number: u64| Some((number, view.ray_of(number as usize, of as usize)?));
    let primary: Vec<_> = numbers.clone().filter_map(primary).collect();
    let progress = bar(1, &format!("{}, bounce", scene.name));
    let diffuse = |memory: &mut Vec<_>, &(number, ray): &(u64, Ray)| {
        let mut search = Closest::new(trees.by_area(), &ray);
        traverse(Stack::new(trees.by_area(), memory), &mut search, &mut ());
        let mut rng = rng_of(seed, number);
        Some((number, reflect(&scene.mesh, &ray, &search.hit()?, &mut rng)?))
    };
    let diffuse: Vec<_> = primary.par_iter().map_init(Vec::new, diffuse).flatten().collect();
    progress.finish_and_clear();
    let is_aimed = numbers.start.min(aimed)..numbers.end.min(aimed);
    let aimed: Vec<_> = in_blocks(is_aimed, aimed, seed, |seed, n| stress::aimed(&scene.mesh, seed, n)).collect();
    let set = |name, kind, query, rays: &Vec<(u64, Ray)>| {
        let (numbers, rays) = rays.iter().copied().unzip();
        Set { name, kind, query, numbers, rays }
    };
    [
        set("primary", Kind::Ordinary, Query::Closest, &primary),
        set("any", Kind::Ordinary, Query::Any, &diffuse),
        set("diffuse", Kind::Ordinary, Query::Closest, &diffuse),
        set("aimed", Kind::Adversarial, Query::Closest, &aimed),
        set("aimed-any", Kind::Adversarial, Query::Any, &aimed),
    ]
}

/// The random numbers of a bounce. They depend only on the number of the camera ray.
pub(super) fn rng_of(seed: u64, number: u64) -> Rng {
    Rng::new(seed ^ Rng::new(number).bits())
}
