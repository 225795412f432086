//! Checks of rays through real hierarchies, in single or double precision. Every traversal is compared with the
//! recursive oracle, and the oracle with rational arithmetic.

use std::sync::Arc;

use rayon::prelude::*;

use super::random::Progress;
use super::{Plan, Tally, Verdict};
use stackless_bvh::bvh::Bvh;
use stackless_bvh::event::{Recorder, State};
use stackless_bvh::geom::{Aabb, Kernel, Ray, Slabs, Triangle, Vector};
use stackless_bvh::hash::mix;
use stackless_bvh::key::KeyWord;
use stackless_bvh::oracle;
use stackless_bvh::order::{ByNode, Flow, LeftOrder, SignOrder};
use stackless_bvh::trace::{FromLeft, Hit, NodeSearch, Query, Truth};
use stackless_bvh::traverse::{AuxTables, Method, Tables, Test, Unsupported, WordName};
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
        run: impl FnOnce(&mut dyn Query, &mut Watch<'_, V>) -> Result<(), Unsupported>,
    ) -> Result<(Seen<V::Real>, u64), Unsupported> {
        let mut watch = Watch { scene: self, seen: Seen::default(), steps: 0 };
        let hit = if any {
            let mut search = NodeSearch::<K, B, true, FromLeft>::new(self.bvh, &self.boxes, ray);
            run(&mut search, &mut watch)?;
            search.hit()
        } else {
            let mut search = NodeSearch::<K, B, false>::new(self.bvh, &self.boxes, ray);
            run(&mut search, &mut watch)?;
            search.hit()
        };
        Ok((Seen { hit, ..watch.seen }, watch.steps))
    }

    /// Runs and records the oracle of a test.
    fn see_oracle<K: Kernel<Vector = V, Shape = Triangle<V>>, B: Slabs<Vector = V>>(
        &self,
        ray: &Ray<V>,
        any: bool,
        test: Test,
    ) -> Seen<V::Real> {
        let (tree, octant) = (self.bvh.tree(), ray.octant());
        let seen = self.see::<K, B>(ray, any, |mut query, watch| {
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
                let seen = scene.see::<K, B>(&ray, any, |mut query, watch| {
                    tables.run_in(word, method, ray.octant(), &mut memory, &mut query, watch)
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

/// Hashes the visits and checks the keys.
struct Watch<'a, V: Vector> {
    scene: &'a SceneTree<'a, V>,
    seen: Seen<V::Real>,
    steps: u64,
}

impl<V: Vector> Recorder for Watch<'_, V> {
    fn visit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow {
        self.steps += 1;
        let (slot, state) = (self.scene.bvh.slot(node), state());
        if !state.is_restarting {
            self.seen.visits += 1;
            self.seen.hash = mix(self.seen.hash ^ slot as u64);
        }
        self.seen.wrong_keys += u64::from(state.key.is_some_and(|key| !self.scene.keys.is(slot, &key)));
        Flow::Continue
    }
}
