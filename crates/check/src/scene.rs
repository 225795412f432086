//! Rays through real hierarchies, in single or double precision: every traversal against the recursive oracle, and that
//! against rational arithmetic.

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

/// A hierarchy over a mesh with all that its check needs.
#[derive(Debug)]
pub struct SceneTree<'m, V: Vector> {
    truth: &'m Truth<V>,
    bvh: &'m Bvh<Triangle<V>>,
    boxes: Vec<Aabb>,
    keys: Arc<Keys>,
}

/// A ray for which a traversal differs from the oracle, or the oracle from the truth.
#[derive(Clone, Debug)]
pub struct SceneDisagreement<V: Vector> {
    /// Number of the ray: its index among those that were checked.
    pub number: u64,
    /// The ray.
    pub ray: Ray<V>,
    /// An any-hit query.
    pub any: bool,
    /// The traversal; `None` where it is the oracle that differs.
    pub method: Option<(Method, WordName)>,
    /// What was seen of the oracle, or the true hit.
    pub expected: Seen<V::Real>,
    /// What was seen instead.
    pub found: Seen<V::Real>,
}

/// What is seen of one search: its hit, and the sequence of its visits in one number, restarts left out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seen<R> {
    /// The hit.
    pub hit: Option<Hit<R>>,
    /// Number of visits.
    pub visits: u64,
    /// Hash of the visited nodes, in order.
    pub hash: u64,
    /// Visits at which the key was not that of the node.
    pub wrong_keys: u64,
}

impl<'m, V: Vector> SceneTree<'m, V> {
    /// Prepares a hierarchy of the mesh that the truth is of.
    pub fn new(truth: &'m Truth<V>, bvh: &'m Bvh<Triangle<V>>) -> Self {
        Self { truth, bvh, boxes: bvh.own_boxes(), keys: Arc::new(Keys::of(bvh)) }
    }

    /// Runs a search and says what was seen of it, and how many visits were made with restarts.
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

    /// What is seen of the oracle of a test.
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

/// Checks the traversals of a plan on rays through one hierarchy, with exact triangle and box tests of its precision, on
/// all cores; the first disagreement is returned.
///
/// Of a traversal that restarts only the hits are compared: its questions are answered anew when the ray has become
/// shorter.
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

/// Hashes the visits and looks at the keys.
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
