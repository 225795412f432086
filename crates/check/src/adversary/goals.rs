//! All goals.

use super::{Cost, Goal, Of, boxes, kernels, trees};
use crate::Case;
use stackless_bvh::generate::stress;
use stackless_bvh::geom::kernel::{Affine, Moller32, Moller64, Woop};
use stackless_bvh::geom::slabs::{Directed, Plain, TwoSided};

/// All goals: of trees with up to 63 nodes, of tests of triangles one by one, of complete trees over 16 triangles.
pub const GOALS: &[Goal] = &[
    tree("climb-afra", "parents that afra follows, per visit", trees::climb_afra),
    tree("climb-sparse", "parents that sparse follows, per visit", trees::climb_sparse),
    tree("climb-hapala", "parents that hapala follows, per visit", trees::climb_hapala),
    tree("restarts-laine-0", "visits again from the root, per visit", trees::restarts::<0>),
    tree("restarts-laine-1", "visits again from the root, per visit", trees::restarts::<1>),
    tree("restarts-laine-2", "visits again from the root, per visit", trees::restarts::<2>),
    tree("restarts-laine-4", "visits again from the root, per visit", trees::restarts::<4>),
    tree("restarts-laine-8", "visits again from the root, per visit", trees::restarts::<8>),
    tree("lookups-hashed", "lookups in the perfect hash, per visit", trees::lookups),
    tree("register-misses", "backtracks that the register does not serve, per visit", trees::register_misses),
    tree("table-hashed", "bytes of the hash table of hashed, per node", trees::table_hashed),
    tree("table-hash-only", "bytes of the hash table of all keys, per node", trees::table_hash_only),
    tree("cells-hashed", "cells of the hash table of hashed, out of as few as it begins with", trees::cells),
    tree("reseeds-printed", "seeds tried for all keys in the printed size", trees::reseeds_printed),
    scene("fallbacks", "triangles that bounds for the scene leave open, per ray", kernels::fallbacks),
    scene("sums", "triangles that take exact sums, per ray", kernels::sums),
    scene("box-tests", "box tests, per hit", kernels::box_tests),
    scene("boxes-plain", "boxes touched and skipped, of all", boxes::skipped::<Plain>),
    scene("boxes-two-sided", "boxes entered and not touched, of all", boxes::in_vain::<TwoSided>),
    scene("boxes-directed", "boxes entered and not touched, of all", boxes::in_vain::<Directed>),
    pair("ulps-affine", ULPS, kernels::ulps::<Affine>),
    pair("ulps-moller-32", ULPS, kernels::ulps::<Moller32>),
    pair("ulps-woop", ULPS, kernels::ulps::<Woop>),
    pair("ulps-moller-64", ULPS, kernels::ulps::<Moller64>),
    few("false-misses-affine", MISSES, kernels::false_misses::<Affine>),
    few("false-misses-moller-32", MISSES, kernels::false_misses::<Moller32>),
    few("false-misses-woop", MISSES, kernels::false_misses::<Woop>),
    few("false-misses-moller-64", MISSES, kernels::false_misses::<Moller64>),
    few("false-hits-affine", HITS, kernels::false_hits::<Affine>),
    few("false-hits-moller-32", HITS, kernels::false_hits::<Moller32>),
    few("false-hits-woop", HITS, kernels::false_hits::<Woop>),
    few("false-hits-moller-64", HITS, kernels::false_hits::<Moller64>),
];

const ULPS: &str = "floats between the distance found and the true one";
const MISSES: &str = "triangles hit and not found, of all tests";
const HITS: &str = "triangles found and not hit, of all tests";

type CostOf<C> = fn(&C) -> Option<Cost>;

const fn tree(name: &'static str, about: &'static str, cost: CostOf<Case>) -> Goal {
    Goal { name, about, of: Of::Tree(cost) }
}

/// Four rays through sixteen triangles.
const fn scene(name: &'static str, about: &'static str, cost: CostOf<stress::StressCase>) -> Goal {
    Goal { name, about, of: Of::Rays { triangles: 16, rays: 4, cost } }
}

/// Eight rays and four triangles, each with each.
const fn few(name: &'static str, about: &'static str, cost: CostOf<stress::StressCase>) -> Goal {
    Goal { name, about, of: Of::Rays { triangles: 4, rays: 8, cost } }
}

/// One ray and one triangle.
const fn pair(name: &'static str, about: &'static str, cost: CostOf<stress::StressCase>) -> Goal {
    Goal { name, about, of: Of::Rays { triangles: 1, rays: 1, cost } }
}
