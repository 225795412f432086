//! The visitor of a ray in the hierarchy of one object.

use std::cmp::Ordering;

use super::{Instance, InstanceCounts, InstanceFilter, InstanceTracer};
use crate::bvh::{Bvh, LeafTriangle};
use crate::geom::kernel::{self, Certainty};
use crate::geom::slabs::{EnclosedSlabs, Intervals};
use crate::geom::truth::Number;
use crate::geom::{Aabb, EnclosedRay, Ends, ExactRay, Real, Region, Slabs, Triangle, Vector};
use crate::order::{Descent, Flow, Pruned, Visitor};
use crate::trace::level::Level;
use crate::trace::{BoxQuery, OwnBoxes};
use crate::tree::{Node, Topology};

/// The state of one ray through all levels.
#[derive(Debug)]
pub(super) struct Search<'r, V: Vector> {
    /// The ray itself.
    pub(super) ray: &'r ExactRay<V>,
    pub(super) wanted: Wanted,
    pub(super) filter: InstanceFilter<'r, V::Real>,
    /// Whether some triangles may be excluded. One comparison answers this for most rays.
    is_choosy: bool,
    /// The distance of the best hit, or the ray's end: hits beyond are ignored.
    pub(super) t: V::Real,
    /// This distance, rounded up: boxes beyond are skipped.
    pub(super) end: f32,
    /// The best hit so far, or all hits.
    pub(super) found: Vec<Found<V>>,
    /// The current instances, outermost first.
    pub(super) path: Vec<u32>,
    /// Memory of the traversals with a stack, for each level that has requested it.
    memory: Vec<Vec<Node>>,
    pub(super) counts: InstanceCounts,
}

/// The hits that a search requests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wanted {
    /// Only whether there is a hit: its distance is not computed.
    Any,
    AnyHit,
    Closest,
    All,
}

impl Wanted {
    /// Returns whether the first hit ends the search.
    pub(super) const fn is_any(self) -> bool {
        matches!(self, Self::Any | Self::AnyHit)
    }
}

/// A hit triangle of an instance.
#[derive(Clone, Debug)]
pub(super) struct Found<V: Vector> {
    /// The distance, rounded.
    pub(super) t: V::Real,
    /// The instances, outermost first.
    pub(super) path: Vec<u32>,
    pub(super) prim: u32,
    pub(super) triangle: Triangle<V>,
    /// The ray in the space of its mesh.
    pub(super) test: kernel::EnclosedTest<V::Real>,
}

impl<'r, V: Vector> Search<'r, V> {
    pub(super) fn new(ray: &'r ExactRay<V>, wanted: Wanted) -> Self {
        Self::filtered(ray, wanted, InstanceFilter::ALL)
    }

    pub(super) fn filtered(ray: &'r ExactRay<V>, wanted: Wanted, filter: InstanceFilter<'r, V::Real>) -> Self {
        let (found, path, memory) = (Vec::new(), Vec::new(), Vec::new());
        let [_, t] = ray.interval();
        let [_, end] = t.ends_in_single();
        let is_choosy = ray.ends() == Ends::Open || filter.is_by_triangle();
        Self { ray, wanted, filter, is_choosy, t, end, found, path, memory, counts: InstanceCounts::default() }
    }

    /// Returns the start of the ray, rounded down.
    pub(super) fn tmin(&self) -> f32 {
        let [tmin, _] = self.ray.interval();
        let [tmin, _] = tmin.ends_in_single();
        tmin
    }

    /// Returns whether the search is complete.
    pub(super) fn is_over(&self) -> bool {
        self.wanted.is_any() && !self.found.is_empty()
    }

    /// Records a hit.
    #[inline]
    fn take(&mut self, t: V::Real, held: &LeafTriangle<Triangle<V>>, test: &kernel::EnclosedTest<V::Real>) {
        let LeafTriangle { shape: triangle, prim } = *held;
        let is_best = self.wanted != Wanted::All;
        let mut path = self.found.pop_if(|_| is_best).map(|best| best.path).unwrap_or_default();
        path.clone_from(&self.path);
        self.found.push(Found { t, path, prim, triangle, test: *test });
        if is_best {
            let [_, end] = t.ends_in_single();
            (self.t, self.end) = (t, end);
        }
    }
}

/// The leaf contents of a hierarchy, and a ray in its space.
pub(super) trait Leaves<S, V: Vector> {
    /// Tests the ray against the contents of a leaf.
    fn meet(&mut self, held: &LeafTriangle<S>, search: &mut Search<'_, V>);
}

/// Traverses a hierarchy with a ray in its space.
pub(super) fn walk<S, V: Vector>(
    bvh: &Bvh<S>,
    level: &Level,
    ray: &EnclosedRay,
    leaves: impl Leaves<S, V>,
    search: &mut Search<'_, V>,
) {
    let (depth, slabs) = (search.path.len(), EnclosedSlabs::of(ray, search.tmin(), bvh.region()));
    let mut memory = search.memory.get_mut(depth).map(std::mem::take).unwrap_or_default();
    let walk = Walk { bvh, slabs, leaves, search: &mut *search };
    level.run(bvh.tree(), ray.octant(), &mut memory, &mut OwnBoxes::over(walk, &level.boxes));
    if memory.capacity() > 0 {
        search.memory.resize_with(search.memory.len().max(depth + 1), Vec::new);
        search.memory[depth] = memory;
    }
}

/// The visitor of a ray.
struct Walk<'s, 'r, S, L, V: Vector> {
    bvh: &'s Bvh<S>,
    slabs: EnclosedSlabs,
    leaves: L,
    search: &'s mut Search<'r, V>,
}

impl<S, L: Leaves<S, V>, V: Vector> Visitor for Walk<'_, '_, S, L, V> {
    #[inline(always)]
    fn inner(&mut self, node: Node) -> Descent {
        let planes = &self.bvh.node(node.index()).planes;
        let Intervals { hit: [left, right], near, .. } = self.slabs.pair(planes, self.search.end);
        Descent::new(left, right, near[1] < near[0] && self.search.wanted == Wanted::Closest)
    }

    #[inline(always)]
    fn leaf(&mut self, node: Node) -> Flow {
        for held in &self.bvh.triangles()[self.bvh.leaf_range(node)] {
            self.leaves.meet(held, self.search);
            if self.search.is_over() {
                return Flow::Stop;
            }
        }
        Flow::Continue
    }
}

impl<S, L: Leaves<S, V>, V: Vector> Pruned for Walk<'_, '_, S, L, V> {}

impl<S, L: Leaves<S, V>, V: Vector> BoxQuery for Walk<'_, '_, S, L, V> {
    #[inline]
    fn touches(&self, aabb: &Aabb) -> bool {
        self.slabs.one(aabb, self.search.end).is_some()
    }

    #[inline]
    fn slot(&self, node: Node) -> usize {
        self.bvh.slot(node)
    }
}

/// Triangles of a mesh.
pub(super) struct Triangles<'s, V: Vector> {
    tracer: &'s InstanceTracer<V>,
    /// The ray in the space of the mesh.
    ray: &'s EnclosedRay,
    region: &'s Region,
    /// Prepared at the first triangle: a ray that misses everything does not pay for it.
    test: Option<kernel::EnclosedTest<V::Real>>,
}

impl<V: Vector> Leaves<Triangle<V>, V> for Triangles<'_, V> {
    #[inline(always)]
    fn meet(&mut self, held: &LeafTriangle<Triangle<V>>, search: &mut Search<'_, V>) {
        search.counts.triangles += 1;
        self.settle(held, search);
    }
}

impl<'s, V: Vector> Triangles<'s, V> {
    /// Creates the tests of a mesh, which `region` must contain.
    pub(super) const fn new(tracer: &'s InstanceTracer<V>, ray: &'s EnclosedRay, region: &'s Region) -> Self {
        Self { tracer, ray, region, test: None }
    }

    /// The exact test of a triangle.
    #[inline(always)]
    pub(super) fn settle(&mut self, held: &LeafTriangle<Triangle<V>>, search: &mut Search<'_, V>) {
        if search.is_choosy && search.excludes(self.tracer, held) {
            return;
        }
        let (ray, region) = (self.ray, self.region);
        let test = self.test.get_or_insert_with(|| kernel::EnclosedTest::new(ray, search.ray.interval(), region));
        let verdict = if search.wanted == Wanted::Any {
            match test.blocks(&held.shape) {
                Certainty::Hit(()) => Certainty::Hit(search.t),
                Certainty::Miss => Certainty::Miss,
                Certainty::Open => Certainty::Open,
            }
        } else {
            test.distance(&held.shape, search.t)
        };
        let t = match verdict {
            Certainty::Hit(t) => Some(t),
            Certainty::Miss => None,
            Certainty::Open => ask_truth(self.tracer, test, &held.shape, search),
        };
        if let Some(t) = t
            && (t < search.t || search.wanted == Wanted::All || comes_first(self.tracer, test, held, search))
            && search.accepts(self.tracer, t, held, test)
        {
            search.take(t, held, test);
        }
    }
}

/// Returns whether a hit at the rounded distance of the best hit so far comes before it. `[INST-6]`
#[cold]
#[inline(never)]
fn comes_first<V: Vector>(
    tracer: &InstanceTracer<V>,
    test: &kernel::EnclosedTest<V::Real>,
    &LeafTriangle { shape: triangle, prim }: &LeafTriangle<Triangle<V>>,
    search: &Search<'_, V>,
) -> bool {
    let found = Found { t: search.t, path: search.path.clone(), prim, triangle, test: *test };
    search.found.first().is_none_or(|best| found.order(best, tracer, search.ray).is_lt())
}

impl<V: Vector> Found<V> {
    /// Compares two hits of a ray by exact distance, then by path, then by triangle. `[EXACT-13, INST-6]`
    pub(super) fn order(&self, other: &Self, tracer: &InstanceTracer<V>, ray: &ExactRay<V>) -> Ordering {
        let by_index = (&self.path, self.prim).cmp(&(&other.path, other.prim));
        // The same triangle in another leaf.
        if by_index.is_eq() {
            return Ordering::Equal;
        }
        let exactly = || {
            let [maps, of_other] = [&self.path, &other.path].map(|path| tracer.maps(path));
            if self.triangle == other.triangle && maps == of_other {
                return Ordering::Equal;
            }
            ray.compare([(&self.triangle, &maps), (&other.triangle, &of_other)])
        };
        let by_distance = || self.test.compare(&self.triangle, (&other.test, &other.triangle)).unwrap_or_else(exactly);
        // No distance is a NaN.
        self.t.partial_cmp(&other.t).unwrap_or(Ordering::Equal).then_with(by_distance).then(by_index)
    }
}

/// Decides the cases that bounds leave undecided.
#[cold]
#[inline(never)]
fn ask_truth<V: Vector>(
    tracer: &InstanceTracer<V>,
    test: &kernel::EnclosedTest<V::Real>,
    triangle: &Triangle<V>,
    search: &mut Search<'_, V>,
) -> Option<V::Real> {
    search.counts.open += 1;
    let ray = search.ray;
    if ray.ends() == Ends::Closed {
        match test.settle(triangle) {
            Certainty::Hit(t) => return Some(t),
            Certainty::Miss => return None,
            Certainty::Open => {}
        }
    }
    let maps = tracer.maps(&search.path);
    match ray.fine_distance(triangle, &maps) {
        Certainty::Hit(t) => Some(t),
        Certainty::Miss => None,
        Certainty::Open => {
            search.counts.rational += 1;
            ray.meet(triangle, &maps).map(|point| V::Real::nearest(&point.t))
        }
    }
}

/// Instances of a group.
pub(super) struct Instances<'s, V: Vector> {
    pub(super) tracer: &'s InstanceTracer<V>,
    pub(super) placed: &'s [Instance<V::Real>],
    pub(super) ray: EnclosedRay,
}

impl<V: Vector> Leaves<(), V> for Instances<'_, V> {
    /// Here the ray of the group waits, with the state of its traversal, until the instance is done (Binder & Keller
    /// 2016, Section 2.4).
    fn meet(&mut self, held: &LeafTriangle<()>, search: &mut Search<'_, V>) {
        let index = held.prim;
        let Instance { object, affine } = &self.placed[index as usize];
        search.counts.instances += 1;
        search.path.push(index);
        self.tracer.visit(*object, affine.pull_back(&self.ray), search);
        search.path.pop();
    }
}
