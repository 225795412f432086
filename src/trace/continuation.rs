//! Paths: rays that start where others have hit, and are traced on from there.

use super::counters::{Counters, Counting};
use super::level::Level;
use super::{FromLeft, Hit, Nearest, NodeSearch, Tracer};
use crate::event::Recorder;
use crate::geom::kernel::Real;
use crate::geom::{Kernel, Ray, Slabs};
use crate::key::KeyWord;
use crate::order::Repeatable;
use crate::traverse::{ByWalk, KeyOnly, Next, Pause, Unfit, WithCursor, WithWord, revisit, traverse, with_word};
use crate::tree::{Keys, Node, Topology};

/// Where a path is: the leaf of its last hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Place(Node);

/// Queries that begin in a leaf, at the place of a path's last hit, and not at the root: the leaf first, then what is
/// beside it, then what is beside its parent, and so on upwards (Binder & Keller 2016, Section 2.4 and Fig. 8). `[PAUSE-7]`
///
/// Where a ray begins in the hierarchy changes what it costs, never what it hits: the answers are those of the tracer, for
/// any place. Close hits are found sooner, and keep what is far away from being looked at.
///
/// The traversal has nothing but the key of the leaf, as the decisions that led there were another ray's: so the siblings
/// on the way up are visited without a test of their own boxes. Addresses of leaf and sibling are found by a walk along the
/// key, which tests no boxes.
///
/// ```
/// use glam::Vec3;
/// use stackless_bvh::{bvh::{Bvh, SahOptions}, geom::Ray, scene::procedural, trace::{Continuation, Tracer}};
///
/// let mesh = procedural::soup(1, 500);
/// let bvh = Bvh::sah(&mesh, SahOptions::default())?;
/// let tracer = Tracer::new(&bvh);
/// let continuation = Continuation::new(&tracer)?;
/// let mut ray = procedural::rays(&mesh, 1, 1)[0];
/// let mut place = None;
/// for _ in 0..4 {
///     let Some((hit, leaf)) = continuation.closest(&ray, place) else { break };
///     assert_eq!(Some(hit), tracer.closest(&ray));
///     let origin = ray.origin() + ray.direction() * hit.t;
///     (ray, place) = (Ray::new(origin, -ray.direction().yzx(), 1e-3, f32::INFINITY)?, Some(leaf));
/// }
/// # use glam::Vec3Swizzles;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Continuation<'t, 'a, K: Kernel, B> {
    tracer: &'t Tracer<'a, K, B>,
    keys: Keys,
}

impl<'t, 'a, K: Kernel, B: Slabs<Vector = K::Vector>> Continuation<'t, 'a, K, B> {
    /// Makes a table of the keys of all nodes.
    ///
    /// # Errors
    /// [`Unfit::NoPause`] where the tracer's traversal cannot begin but at the root.
    pub fn new(tracer: &'t Tracer<'a, K, B>) -> Result<Self, Unfit> {
        if tracer.method().can_pause() {
            Ok(Self { tracer, keys: Keys::of(tracer.bvh()) })
        } else {
            Err(Unfit::NoPause)
        }
    }

    /// The closest hit, and its place. The first ray of a path comes from nowhere.
    pub fn closest(&self, ray: &Ray<K::Vector>, from: Option<Place>) -> Option<(Hit<Real<K>>, Place)> {
        let mut search = NodeSearch::<K, B, false>::new(self.tracer.level.bvh, &self.tracer.level.boxes, ray);
        self.run(from, &mut search, &mut ());
        Some((search.hit()?, Place(search.query.hit_leaf()?)))
    }

    /// Whether there is any hit.
    pub fn any(&self, ray: &Ray<K::Vector>, from: Option<Place>) -> bool {
        let mut search = NodeSearch::<K, B, true, FromLeft>::new(self.tracer.level.bvh, &self.tracer.level.boxes, ray);
        self.run(from, &mut search, &mut ());
        search.found().is_some()
    }

    /// What a closest hit (or with `any`, any hit) costs, counted, without backtracks.
    pub fn count(&self, ray: &Ray<K::Vector>, from: Option<Place>, any: bool) -> Counters {
        let mut counters = Counters { rays: 1, ..Counters::default() };
        let (bvh, boxes, counted) = (self.tracer.level.bvh, &*self.tracer.level.boxes, &mut counters);
        let query: &mut dyn Repeatable = if any {
            let search = NodeSearch::new(bvh, boxes, ray);
            &mut Counting::<K, B, true, FromLeft> { search, counters: counted }
        } else {
            let search = NodeSearch::new(bvh, boxes, ray);
            &mut Counting::<K, B, false, Nearest> { search, counters: counted }
        };
        self.run(from, query, &mut ());
        counters
    }

    fn run(&self, from: Option<Place>, query: &mut dyn Repeatable, recorder: &mut impl Recorder) {
        let ran = with_word(self.tracer.level.word, Begin { at: self, from, query, recorder });
        debug_assert_eq!(ran, Ok(()), "checked when the tracer and this were made");
    }
}

impl<K: Kernel, B> std::fmt::Debug for Continuation<'_, '_, K, B> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Continuation").field("tracer", self.tracer).finish_non_exhaustive()
    }
}

struct Begin<'q, 'c, 't, 'a, K: Kernel, B, R> {
    at: &'c Continuation<'t, 'a, K, B>,
    from: Option<Place>,
    query: &'q mut dyn Repeatable,
    recorder: &'q mut R,
}

impl<K: Kernel, B: Slabs<Vector = K::Vector>, R: Recorder> WithWord for Begin<'_, '_, '_, '_, K, B, R> {
    type Output = Result<(), Unfit>;

    fn call<W: KeyWord>(self) -> Result<(), Unfit> {
        let Self { at: Continuation { tracer, keys }, from, query, recorder } = self;
        let Level { bvh, tables, .. } = &tracer.level;
        // A place of another hierarchy is no place in this one: then from the root.
        let key = from.map(|Place(leaf)| keys.key::<W>(bvh.slot(leaf).min(bvh.node_count() - 1)));
        let from = key.and_then(|key| KeyOnly::locate(key, Next::Visit, &ByWalk(*bvh)).ok());
        tables.with_cursor::<W, _>(tracer.level.method_for(query), Run { from, query, recorder })
    }
}

/// From a node, or from the root.
struct Run<'q, W, R> {
    from: Option<KeyOnly<W>>,
    query: &'q mut dyn Repeatable,
    recorder: &'q mut R,
}

impl<W: KeyWord, R: Recorder> WithCursor<W> for Run<'_, W, R> {
    type Output = ();

    fn call(self, cursor: impl Pause<Word = W>) {
        let Self { from, mut query, recorder } = self;
        if let Some(from) = from {
            let began = revisit(cursor, from, &mut query, recorder);
            debug_assert!(began.is_ok(), "located with its sibling");
        } else {
            traverse(cursor, &mut query, recorder);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bvh::{BuildOptions, Builder, Bvh};
    use crate::scene::procedural;
    use crate::traverse::Method;

    #[test]
    fn a_path_hits_what_it_hits_wherever_it_begins() {
        let mesh = procedural::strands(4, 60);
        let rays = procedural::rays(&mesh, 3, 150);
        for builder in [Builder::Sah, Builder::Spatial, Builder::Median] {
            let options = BuildOptions { builder, ..BuildOptions::default() };
            let bvh = Bvh::build(&mesh, &options, &|_| ()).expect("a tree");
            for method in Method::ALL {
                let Ok(tracer) =
                    Tracer::<crate::geom::kernel::Exact, crate::geom::slabs::Directed>::with_method(&bvh, method)
                else {
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
                    // The same ray again begins where it ends.
                    let [root, leaf] = [None, Some(place)].map(|from| continuation.count(ray, from, true).inner as i64);
                    cheaper += root - leaf;
                }
                assert!(cheaper > 0, "{method}: {cheaper}");
            }
        }
    }

    #[test]
    fn a_place_that_is_none_is_the_root() {
        let mesh = procedural::soup(2, 40);
        let bvh = Bvh::sah(&mesh, crate::bvh::SahOptions::default()).expect("a tree");
        let tracer = Tracer::new(&bvh);
        let continuation = Continuation::new(&tracer).expect("hashed can pause");
        for ray in procedural::rays(&mesh, 3, 50) {
            let elsewhere = Some(Place(Node::leaf(1 << 20)));
            assert_eq!(continuation.closest(&ray, elsewhere).map(|(hit, _)| hit), tracer.closest(&ray));
        }
    }
}
