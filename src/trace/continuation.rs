//! Paths: rays that start at hits, and traversals that start at their leaves.

use std::borrow::Borrow;

use super::counters::{Counters, Counting};
use super::{BinaryTracer, BoxQuery, ChildOrder, FromLeft, Hit, Nearest, NodeSearch};
use crate::bvh::Bvh;
use crate::geom::kernel::Real;
use crate::geom::{Aabb, Kernel, Ray, Slabs};
use crate::key::KeyWord;
use crate::order::{Descent, Flow, Pruned, Pruning, Repeatable, Visitor};
use crate::traverse::{
    ByWalk, KeyOnly, Next, Pause, Unsupported, WithCursor, WithWord, revisit, traverse_pruned, with_word,
};
use crate::tree::{Keys, Node, Topology};

/// A position of a path in the hierarchy: the leaf of its last hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Place(Node);

/// Queries that start in the leaf of a path's last hit instead of at the root. They visit the leaf, then its sibling,
/// then its parent's sibling, and so on upwards (Binder & Keller 2016, Section 2.4 and Fig. 8). `[PAUSE-7]`
///
/// The start in the hierarchy changes the cost of a ray, never its hits: the answers are those of the tracer, for any
/// place. The queries find close hits earlier, which prune distant nodes.
///
/// The traversal has only the key of the leaf, because the decisions on the path to it were those of another ray. So it
/// visits each sibling on the way up, and tests the sibling's own box there. A walk along the key, which tests no
/// boxes, finds the addresses of leaf and sibling.
///
/// ```
/// use stackless_bvh::glam::Vec3;
/// use stackless_bvh::{bvh::{Bvh, SahOptions}, geom::Ray, generate::procedural};
/// use stackless_bvh::trace::{BinaryTracer, Continuation, RayQueries};
///
/// let mesh = procedural::soup(1, 500);
/// let bvh = Bvh::sah(&mesh, SahOptions::default())?;
/// let tracer = BinaryTracer::new(&bvh);
/// let continuation = Continuation::new(&tracer)?;
/// let mut ray = procedural::rays(&mesh, 1, 1)[0];
/// let mut place = None;
/// for _ in 0..4 {
///     let Some((hit, leaf)) = continuation.closest(&ray, place) else { break };
///     assert_eq!(Some(hit), tracer.closest(&ray));
///     let origin = ray.origin() + ray.direction() * hit.t;
///     (ray, place) = (Ray::within(origin, -ray.direction().yzx(), 1e-3, f32::INFINITY)?, Some(leaf));
/// }
/// # use stackless_bvh::glam::Vec3Swizzles;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Continuation<'t, T, K, B> {
    tracer: &'t BinaryTracer<T, K, B>,
    keys: Keys,
    /// The box of each node.
    boxes: Vec<Aabb>,
}

impl<'t, T: Borrow<Bvh<K::Shape>>, K: Kernel, B: Slabs<Vector = K::Vector>> Continuation<'t, T, K, B> {
    /// Builds tables of the keys and boxes of all nodes.
    ///
    /// # Errors
    /// [`Unsupported::NoPause`] if the tracer's traversal can only start at the root.
    pub fn new(tracer: &'t BinaryTracer<T, K, B>) -> Result<Self, Unsupported> {
        if !tracer.method().can_pause() {
            return Err(Unsupported::NoPause);
        }
        let bvh = tracer.bvh();
        Ok(Self { tracer, keys: Keys::of(bvh), boxes: bvh.own_boxes() })
    }

    /// Finds the closest hit, and its place. The first ray of a path has no place.
    pub fn closest(&self, ray: &Ray<K::Vector>, from: Option<Place>) -> Option<(Hit<Real<K>>, Place)> {
        let mut search = NodeSearch::<K, B, false>::new(self.tracer.bvh(), &self.boxes, ray);
        self.run(from, &mut search);
        Some((search.hit()?, Place(search.query.hit_leaf()?)))
    }

    /// Returns whether there is any hit.
    pub fn any(&self, ray: &Ray<K::Vector>, from: Option<Place>) -> bool {
        let mut search = NodeSearch::<K, B, true, FromLeft>::new(self.tracer.bvh(), &self.boxes, ray);
        self.run(from, &mut search);
        search.found().is_some()
    }

    /// Counts the cost of [`closest`](Self::closest), without backtracks.
    pub fn count_closest(&self, ray: &Ray<K::Vector>, from: Option<Place>) -> Counters {
        self.count::<false, Nearest>(ray, from)
    }

    /// Counts the cost of [`any`](Self::any), without backtracks.
    pub fn count_any(&self, ray: &Ray<K::Vector>, from: Option<Place>) -> Counters {
        self.count::<true, FromLeft>(ray, from)
    }

    fn count<const ANY: bool, O: ChildOrder>(&self, ray: &Ray<K::Vector>, from: Option<Place>) -> Counters {
        let mut counters = Counters { rays: 1, ..Counters::default() };
        let mut query = Counting::<K, B, ANY, O>::new(self.tracer.bvh(), &self.boxes, ray, &mut counters);
        let [tests, missed] = self.run(from, &mut query);
        Counters { boxes: counters.boxes + tests, inner: counters.inner + missed, ..counters }
    }

    /// Returns the number of tested siblings, and the number of missed inner nodes among them.
    fn run(&self, from: Option<Place>, query: &mut dyn Seeking) -> [u64; 2] {
        let bvh = self.tracer.bvh();
        // A place of another hierarchy is invalid in this one: it starts from the last leaf.
        let last = bvh.leaves().len() as u32 - 1;
        let from = from.map(|Place(leaf)| Node::leaf((leaf.index() as u32).min(last)));
        let next = from.unwrap_or(bvh.root());
        let mut upwards = Upwards { query, bvh, boxes: &self.boxes, next, postponed: 0, tests: 0, missed: 0 };
        let ran = with_word(self.tracer.level.word, Begin { at: self, from, query: &mut upwards });
        debug_assert_eq!(ran, Ok(()), "checked when the tracer and this were made");
        [upwards.tests, upwards.missed]
    }
}

impl<T, K, B> std::fmt::Debug for Continuation<'_, T, K, B> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Continuation").field("tracer", self.tracer).finish_non_exhaustive()
    }
}

/// A query that starts at a leaf: one type for all queries.
trait Seeking: BoxQuery + Repeatable {}

impl<Q: BoxQuery + Repeatable> Seeking for Q {}

/// A query that tests a node's box if no descent has tested it: at the siblings on the way up.
struct Upwards<'q, S> {
    query: &'q mut dyn Seeking,
    bvh: &'q Bvh<S>,
    boxes: &'q [Aabb],
    /// The next node, unless the traversal backtracks.
    next: Node,
    /// Number of nodes that descents have postponed: they come before the nodes further up. (If some of them are
    /// pruned, a sibling may be mistaken for one of them, and not be tested.)
    postponed: u32,
    tests: u64,
    /// Inner nodes that were tested and missed.
    missed: u64,
}

impl<S> Upwards<'_, S> {
    fn is_wanted(&mut self, node: Node) -> bool {
        if node == self.next {
            return true;
        }
        if self.postponed > 0 {
            self.postponed -= 1;
            return true;
        }
        let is_met = self.query.touches(&self.boxes[self.bvh.slot(node)]);
        self.tests += 1;
        self.missed += u64::from(!is_met && !node.is_leaf());
        is_met
    }

    fn follow(&mut self, node: Node, descent: Descent) -> Descent {
        self.next = self.bvh.child(node, descent.first());
        self.postponed += u32::from(descent.postpones());
        descent
    }
}

impl<S> Visitor for Upwards<'_, S> {
    fn inner(&mut self, node: Node) -> Descent {
        if !self.is_wanted(node) {
            return Descent::NEITHER;
        }
        let descent = self.query.inner(node);
        self.follow(node, descent)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        if self.is_wanted(node) { self.query.leaf(node) } else { Flow::Continue }
    }
}

impl<S> Pruned for Upwards<'_, S> {
    fn inner_marked(&mut self, node: Node) -> Descent {
        if !self.is_wanted(node) {
            return Descent::NEITHER;
        }
        let descent = self.query.inner_marked(node);
        self.follow(node, descent)
    }

    fn allows(&self, pruning: Pruning) -> bool {
        self.query.allows(pruning)
    }

    fn found_at(&self, leaf: Node) -> bool {
        self.query.found_at(leaf)
    }
}

impl<S> Repeatable for Upwards<'_, S> {}

struct Begin<'q, 'c, 't, T, K: Kernel, B> {
    at: &'c Continuation<'t, T, K, B>,
    from: Option<Node>,
    query: &'q mut Upwards<'c, K::Shape>,
}

impl<T: Borrow<Bvh<K::Shape>>, K: Kernel, B: Slabs<Vector = K::Vector>> WithWord for Begin<'_, '_, '_, T, K, B> {
    type Output = Result<(), Unsupported>;

    fn call<W: KeyWord>(self) -> Result<(), Unsupported> {
        let Self { at: Continuation { tracer, keys, .. }, from, query } = self;
        let (bvh, level) = (tracer.bvh(), &tracer.level);
        let locate = |leaf| KeyOnly::locate(keys.key::<W>(bvh.slot(leaf)), Next::Visit, &ByWalk(bvh)).ok();
        let from = from.and_then(locate);
        level.tables(bvh.tree()).with_cursor::<W, _>(level.method_for(query), Run { from, query })
    }
}

/// A run from a node, or from the root.
struct Run<'q, W, Q> {
    from: Option<KeyOnly<W>>,
    query: &'q mut Q,
}

impl<W: KeyWord, Q: Repeatable + Pruned> WithCursor<W> for Run<'_, W, Q> {
    type Output = ();

    fn call(self, cursor: impl Pause<Word = W>) {
        let Self { from, query } = self;
        if let Some(from) = from {
            let began = revisit(cursor, from, query, &mut ());
            debug_assert!(began.is_ok(), "located with its sibling");
        } else {
            traverse_pruned(cursor, query, &mut ());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bvh::{BuildOptions, Builder};
    use crate::generate::procedural;
    use crate::trace::RayQueries;
    use crate::traverse::Method;

    /// [PAUSE-7]
    #[test]
    fn a_path_hits_what_it_hits_wherever_it_begins() {
        let mesh = procedural::strands(4, 60);
        let rays = procedural::rays(&mesh, 3, 150);
        for builder in [Builder::Standard, Builder::Spatial, Builder::Median] {
            let options = BuildOptions { builder, ..BuildOptions::default() };
            let bvh = options.build(&mesh).expect("a tree");
            for method in Method::ALL {
                let Ok(tracer) = BinaryTracer::with_method(&bvh, method) else {
                    continue;
                };
                let Ok(continuation) = Continuation::new(&tracer) else {
                    assert!(!method.can_pause());
                    continue;
                };
                let mut cheaper = 0_i64;
                for ray in &rays {
                    let hit = tracer.closest(ray);
                    for leaf in (0..bvh.leaves().len()).step_by(7) {
                        let from = Some(Place(Node::leaf(leaf as u32)));
                        assert_eq!(continuation.closest(ray, from).map(|(hit, _)| hit), hit, "{method}");
                        assert_eq!(continuation.any(ray, from), hit.is_some(), "{method}");
                    }
                    let Some((hit, place)) = continuation.closest(ray, None) else { continue };
                    assert!(bvh.leaf_triangles(place.0).iter().any(|held| held.prim == hit.prim));
                    // The same ray starts in the leaf of its hit.
                    let [root, leaf] = [None, Some(place)].map(|from| continuation.count_any(ray, from).inner as i64);
                    cheaper += root - leaf;
                }
                assert!(cheaper > 0, "{method}: {cheaper}");
            }
        }
    }

    #[test]
    fn a_place_of_another_hierarchy_is_the_last_leaf() {
        let mesh = procedural::soup(2, 40);
        let tracer = BinaryTracer::of(&mesh).expect("a tree");
        let continuation = Continuation::new(&tracer).expect("it can pause");
        let last = Place(Node::leaf(tracer.bvh().leaves().len() as u32 - 1));
        let elsewhere = Place(Node::leaf(1 << 20));
        let mut differ = 0;
        for ray in procedural::rays(&mesh, 3, 50) {
            assert_eq!(continuation.closest(&ray, Some(elsewhere)).map(|(hit, _)| hit), tracer.closest(&ray));
            let boxes = |from| continuation.count_closest(&ray, from).boxes;
            assert_eq!(boxes(Some(elsewhere)), boxes(Some(last)), "{ray:?}");
            differ += usize::from(boxes(Some(last)) != boxes(None));
        }
        assert!(differ > 25, "{differ}");
    }
}
