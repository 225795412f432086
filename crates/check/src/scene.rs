//! Checks of rays through real hierarchies, in single or double precision. Every traversal is compared with the
//! recursive oracle, and the oracle with rational arithmetic.

use std::sync::Arc;

use rayon::prelude::*;

use super::random::Progress;
use super::{Plan, Tally, Verdict};
use stackless_bvh::bvh::{Bvh, BvhTree};
use stackless_bvh::event::{Recorder, State};
use stackless_bvh::geom::{Aabb, Kernel, Ray, Triangle, Vector};
use stackless_bvh::hash::mix;
use stackless_bvh::internals::geom::Slabs;
use stackless_bvh::internals::trace::{FromLeft, NodeSearch, Query, Truth};
use stackless_bvh::internals::traverse::{AuxTables, VerifiedTables};
use stackless_bvh::key::KeyWord;
use stackless_bvh::oracle;
use stackless_bvh::order::{ByNode, Flow, LeftOrder, SignOrder};
use stackless_bvh::trace::Hit;
use stackless_bvh::traverse::{Method, Tables, Test, Unsupported, WordName};
use stackless_bvh::tree::{Implicit, Keys, Node, Topology};

/// A hierarchy of a mesh, with the data for its check.
#[derive(Debug)]
pub struct SceneTree<'m, V: Vector> {
    truth: &'m Truth<V>,
    bvh: &'m Bvh<Triangle<V>>,
    boxes: Vec<Aabb>,
    keys: Arc<Keys>,
}

/// A ray for which a traversal differs from the oracle, or the oracle from the exact answer.
#[derive(Clone, Debug)]
pub struct SceneDisagreement<V: Vector> {
    /// Index of the ray among the checked rays.
    pub number: u64,
    /// The ray.
    pub ray: Ray<V>,
    /// An any-hit query.
    pub any: bool,
    /// The traversal; `None` if the oracle differs.
    pub method: Option<(Method, WordName)>,
    /// The record of the oracle, or the exact hit.
    pub expected: Seen<V::Real>,
    /// The record that differs.
    pub found: Seen<V::Real>,
}

/// A record of one search: its hit, and a hash of its visits without restarts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seen<R> {
    /// The hit.
    pub hit: Option<Hit<R>>,
    /// Number of visits.
    pub visits: u64,
    /// Hash of the visited nodes, in order.
    pub hash: u64,
    /// Visits whose key did not match the node.
    pub wrong_keys: u64,
}

impl<'m, V: Vector> SceneTree<'m, V> {
    /// Prepares a hierarchy of the mesh of `truth`.
    pub fn new(truth: &'m Truth<V>, bvh: &'m Bvh<Triangle<V>>) -> Self {
        Self { truth, bvh, boxes: bvh.own_boxes(), keys: Arc::new(Keys::of(bvh)) }
    }

    /// Runs and records a search. Also returns its number of visits, restarts included.
    fn see<K: Kernel<Vector = V, Shape = Triangle<V>>, B: Slabs<Vector = V>>(
        &self,
        ray: &Ray<V>,
        any: bool,
        run: impl FnOnce(&mut dyn Query, &mut Watch<'_>) -> Result<(), Unsupported>,
    ) -> Result<(Seen<V::Real>, u64), Unsupported> {
        let mut watch = Watch::new(self.bvh.tree(), &self.keys);
        let hit = if any {
            let mut search = NodeSearch::<K, B, true, FromLeft>::new(self.bvh, &self.boxes, ray);
            run(&mut search, &mut watch)?;
            search.hit()
        } else {
            let mut search = NodeSearch::<K, B, false>::new(self.bvh, &self.boxes, ray);
            run(&mut search, &mut watch)?;
            search.hit()
        };
        let Watch { visits, hash, wrong_keys, steps, .. } = watch;
        Ok((Seen { hit, visits, hash, wrong_keys }, steps))
    }

    /// Runs and records the oracle of a test.
    fn see_oracle<K: Kernel<Vector = V, Shape = Triangle<V>>, B: Slabs<Vector = V>>(
        &self,
        ray: &Ray<V>,
        any: bool,
        test: Test,
    ) -> Seen<V::Real> {
        let seen = self.see::<K, B>(ray, any, |query, watch| {
            run_oracle(self.bvh.tree(), test, ray.octant(), query, watch);
            Ok(())
        });
        seen.map(|(seen, _)| seen).unwrap_or_default()
    }
}

/// Checks the traversals of a plan with rays through one hierarchy, with exact triangle and box tests of its precision,
/// on all cores. Returns the first disagreement.
///
/// For traversals that restart, only the hits are compared: after a restart, the shorter ray changes their decisions.
pub fn check_scene<K, B, V>(
    plan: &Plan,
    scene: &SceneTree<'_, V>,
    rays: &[Ray<V>],
    progress: Progress<'_>,
) -> (Tally, Option<SceneDisagreement<V>>)
where
    K: Kernel<Vector = V, Shape = Triangle<V>>,
    B: Slabs<Vector = V>,
    V: Vector,
{
    let tree = scene.bvh.tree();
    let beside = AuxTables::new(tree, tree.axes(), &plan.methods, Implicit::LIMIT);
    let tables = Tables::verified(tree, tree.axes(), beside, Arc::clone(&scene.keys));
    let pairs = plan.pairs();
    let check_ray = |(number, &ray): (usize, &Ray<V>)| {
        let mut tally = Tally::default();
        tally.depth = scene.bvh.depth();
        let (mut disagreement, mut memory) = (None, Vec::new());
        let truth = scene.truth.closest(&ray).map(|hit| hit.rounded());
        for any in [false, true] {
            let mut report = |method, expected, found| {
                disagreement.get_or_insert(SceneDisagreement {
                    number: number as u64,
                    ray,
                    any,
                    method,
                    expected,
                    found,
                });
            };
            let oracles = Test::ALL.map(|test| scene.see_oracle::<K, B>(&ray, any, test));
            for oracle in oracles {
                let is_true = if any { truth.is_some() == oracle.hit.is_some() } else { truth == oracle.hit };
                if !is_true {
                    report(None, Seen { hit: truth, ..oracle }, oracle);
                    tally.oracle_faults += 1;
                }
            }
            for &(method, word) in &pairs {
                let seen = scene.see::<K, B>(&ray, any, |query, watch| {
                    run(&tables, (method, word), ray.octant(), &mut memory, query, watch)
                });
                let verdict = match seen {
                    Err(unfit) => Verdict::Refused(unfit),
                    Ok((seen, steps)) => {
                        let expected = oracles[method.test() as usize];
                        if agrees(method, any, expected, seen) {
                            Verdict::Agrees { steps }
                        } else {
                            report(Some((method, word)), expected, seen);
                            Verdict::Differs(())
                        }
                    }
                };
                tally.add(method, word, &verdict);
            }
        }
        progress(1);
        (tally, disagreement)
    };
    let none = || (Tally::default(), None);
    let (mut tally, first) =
        rays.par_iter().enumerate().map(check_ray).reduce(none, |(a, x), (b, y)| (a.merge(&b), x.or(y)));
    tally.misses += tables.misses() as u64;
    (tally, first)
}

fn agrees<R: PartialEq>(method: Method, any: bool, expected: Seen<R>, seen: Seen<R>) -> bool {
    let changing = method.restarts() && !any;
    if changing { expected.hit == seen.hit } else { expected == seen }
}

/// Runs the oracle of a test. Like [`run`], it is compiled once for all kernels.
fn run_oracle(tree: &BvhTree, test: Test, octant: u8, mut query: &mut dyn Query, watch: &mut Watch<'_>) {
    match test {
        Test::Children | Test::Disjoint | Test::Distance => {
            oracle::traverse_pruned(tree, tree.root(), test.pruning(), &mut query, watch);
        }
        Test::NodeLeftFirst => oracle::traverse(tree, &mut ByNode { test: query, order: LeftOrder }, watch),
        Test::NodeBySign => {
            let order = SignOrder { axes: tree.axes(), octant };
            oracle::traverse(tree, &mut ByNode { test: query, order }, watch);
        }
    }
}

/// Runs a traversal. The compiler makes hundreds of functions of this one.
fn run(
    tables: &VerifiedTables<'_, BvhTree>,
    (method, word): (Method, WordName),
    octant: u8,
    memory: &mut Vec<Node>,
    mut query: &mut dyn Query,
    watch: &mut Watch<'_>,
) -> Result<(), Unsupported> {
    tables.run_in(word, method, octant, memory, &mut query, watch)
}

/// Hashes the visits and checks the keys.
struct Watch<'a> {
    tree: &'a BvhTree,
    keys: &'a Keys,
    visits: u64,
    hash: u64,
    wrong_keys: u64,
    steps: u64,
}

impl<'a> Watch<'a> {
    fn new(tree: &'a BvhTree, keys: &'a Keys) -> Self {
        Self { tree, keys, visits: 0, hash: 0, wrong_keys: 0, steps: 0 }
    }
}

impl Recorder for Watch<'_> {
    fn visit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow {
        self.steps += 1;
        let (slot, state) = (self.tree.slot(node), state());
        if !state.is_restarting {
            self.visits += 1;
            self.hash = mix(self.hash ^ slot as u64);
        }
        self.wrong_keys += u64::from(state.key.is_some_and(|key| !self.keys.is(slot, &key)));
        Flow::Continue
    }
}
