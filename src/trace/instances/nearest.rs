//! The nearest point of all instances.

use std::cmp::Ordering;
use std::mem;

use glam::Vec3;

use super::{Instance, InstanceTracer, Object, Stage};
use crate::bvh::Bvh;
use crate::geom::{Aabb, Ball, EnclosedMap, EnvironmentError, Frame, Real, Triangle, Vector, nearest_of_image, to_box};
use crate::order::{Descent, Flow, Pruned, Side, Visitor};
use crate::trace::level::Level;
use crate::trace::ray_queries::in_parallel;
use crate::trace::{BoxQuery, OwnBoxes};
use crate::tree::{Node, Topology};

/// The point of all instances nearest to a query point.
#[derive(Clone, Debug, PartialEq)]
pub struct InstanceNear<V: Vector = Vec3> {
    /// The index of the instance in each group, outermost first. Empty if the object is a mesh.
    pub path: Vec<u32>,
    /// Index of the triangle in its mesh.
    pub prim: u32,
    /// The float nearest to the exact distance.
    pub distance: V::Real,
    /// The exact nearest point on the image of the triangle, each coordinate rounded once to the nearest float. A zero
    /// is positive.
    pub point: V,
}

impl<V: Vector> InstanceTracer<V> {
    /// Finds the point of the exact images that is nearest to the center of a ball, if one is in the ball: the least
    /// rounded distance, of equal distances the least path, and of equal paths the least triangle. `[INST-9]`
    ///
    /// Bounds in double precision exclude most triangles, and rational arithmetic decides the rest.
    ///
    /// ```
    /// use stackless_bvh::bvh::{BuildOptions, Bvh};
    /// use stackless_bvh::geom::{AffineMap, Ball, Mesh};
    /// use stackless_bvh::glam::DVec3;
    /// use stackless_bvh::trace::{Assembly, Instance, InstanceTracer};
    /// use stackless_bvh::traverse::Method;
    ///
    /// let mesh = Mesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2]])?;
    /// let mut assembly = Assembly::new();
    /// let object = assembly.add_mesh(Bvh::build(&mesh)?);
    /// let row = |z| AffineMap::translation(DVec3::Z * z).map(|affine| Instance { object, affine });
    /// let scene = assembly.add_group(vec![row(0.0)?, row(3.0)?], &BuildOptions::default())?;
    /// let tracer = InstanceTracer::new(&assembly, scene, Method::default())?;
    /// let near = tracer.nearest(&Ball::around(DVec3::new(0.25, 0.5, 2.0))?).ok_or("none")?;
    /// assert_eq!((near.path, near.distance, near.point), (vec![1], 1.0, DVec3::new(0.25, 0.5, 3.0)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn nearest(&self, ball: &Ball<V>) -> Option<InstanceNear<V>> {
        let mut search = NearSearch {
            tracer: self,
            point: ball.center(),
            radius: ball.radius(),
            limit: ball.radius(),
            path: Vec::new(),
            found: Vec::new(),
            room: ROOM,
        };
        search.visit(self.root, &EnclosedMap::identity());
        search.nearest()
    }

    /// Finds the [`nearest`](Self::nearest) point of each ball, on all threads.
    ///
    /// # Errors
    /// [`EnvironmentError`] of any participating thread.
    pub fn nearest_parallel(&self, balls: &[Ball<V>]) -> Result<Vec<Option<InstanceNear<V>>>, EnvironmentError> {
        in_parallel(balls, |balls| balls.iter().map(|ball| self.nearest(ball)).collect())
    }
}

/// The search for one point, through all levels.
struct NearSearch<'t, V: Vector> {
    tracer: &'t InstanceTracer<V>,
    point: V,
    radius: V::Real,
    /// An upper bound of the rounded least distance, at most the radius.
    limit: V::Real,
    /// The current instances, outermost first.
    path: Vec<u32>,
    /// Triangles that may be nearest.
    found: Vec<Candidate<V>>,
    /// Number of candidates after which those beyond the limit are removed.
    room: usize,
}

/// A triangle with a lower bound of its rounded distance.
struct Candidate<V: Vector> {
    near: V::Real,
    path: Vec<u32>,
    prim: u32,
    triangle: Triangle<V>,
}

const ROOM: usize = 32;

impl<V: Vector> NearSearch<'_, V> {
    /// Traverses an object that is placed by a map.
    fn visit(&mut self, object: Object, map: &EnclosedMap) {
        match self.tracer.stage(object) {
            None => {}
            Some(Stage::Mesh(bvh, level)) => {
                walk(bvh, level, Near { search: self, map, frame: bvh.frame(), placed: &[] });
            }
            Some(Stage::Wide(bvh, level)) => {
                let frame = bvh.region().frame();
                bvh.run_near(level, &mut Near { search: self, map, frame, placed: &[] });
            }
            Some(Stage::Group(group, level)) => {
                let (frame, placed) = (group.bvh.frame(), &*group.instances);
                walk(&group.bvh, level, Near { search: self, map, frame, placed });
            }
        }
    }

    /// Returns the nearest candidate.
    fn nearest(mut self) -> Option<InstanceNear<V>> {
        self.prune();
        let mut found = mem::take(&mut self.found);
        // No bound is a NaN.
        found.sort_by(|a, b| {
            a.near
                .partial_cmp(&b.near)
                .unwrap_or(Ordering::Equal)
                .then_with(|| (&a.path, a.prim).cmp(&(&b.path, b.prim)))
        });
        // A triangle may be in several leaves.
        found.dedup_by(|a, b| a.prim == b.prim && a.path == b.path);
        let mut best: Option<InstanceNear<V>> = None;
        for Candidate { near, path, prim, triangle } in found {
            if best.as_ref().is_some_and(|best| best.distance < near) {
                break;
            }
            let maps = self.tracer.maps(&path);
            let Some((distance, point)) = nearest_of_image(&triangle, &maps, self.point, self.radius) else { continue };
            let is_best = best.as_ref().is_none_or(|best| {
                distance < best.distance || distance == best.distance && (&path, prim) < (&best.path, best.prim)
            });
            if is_best {
                best = Some(InstanceNear { path, prim, distance, point });
            }
        }
        best
    }

    fn prune(&mut self) {
        let limit = self.limit;
        self.found.retain(|found| found.near <= limit);
    }
}

/// The leaf contents of a hierarchy, and the distances of its boxes from the point.
pub(super) trait NearTest<S> {
    /// Returns a lower bound of the distance of the image of a box.
    fn to_box(&self, aabb: &Aabb) -> f64;

    /// Returns the distance beyond which boxes are skipped.
    fn end(&self) -> f64;

    /// Measures the contents of a leaf.
    fn meet(&mut self, shape: &S, prim: u32);
}

/// A search in an object, which a map places.
struct Near<'s, 't, V: Vector> {
    search: &'s mut NearSearch<'t, V>,
    map: &'s EnclosedMap,
    /// The frame of the boxes.
    frame: &'s Frame,
    /// The instances of a group.
    placed: &'s [Instance<V::Real>],
}

impl<V: Vector> Near<'_, '_, V> {
    fn to_box(&self, aabb: &Aabb) -> f64 {
        to_box(&self.map.image(self.frame.leave(aabb)), self.search.point.widen())
    }

    /// Distances are compared after rounding. So the end is beyond all numbers that round to the limit.
    fn end(&self) -> f64 {
        self.search.limit.next_up().into()
    }
}

impl<V: Vector> NearTest<Triangle<V>> for Near<'_, '_, V> {
    fn to_box(&self, aabb: &Aabb) -> f64 {
        self.to_box(aabb)
    }

    fn end(&self) -> f64 {
        self.end()
    }

    fn meet(&mut self, triangle: &Triangle<V>, prim: u32) {
        let search = &mut *self.search;
        let [near, far] = self.map.distance(triangle, search.point.widen()).map(V::Real::rounded);
        if near > search.limit {
            return;
        }
        if far < search.limit {
            search.limit = far;
        }
        search.found.push(Candidate { near, path: search.path.clone(), prim, triangle: *triangle });
        if search.found.len() > search.room {
            search.prune();
            search.room = ROOM.max(2 * search.found.len());
        }
    }
}

impl<V: Vector> NearTest<()> for Near<'_, '_, V> {
    fn to_box(&self, aabb: &Aabb) -> f64 {
        self.to_box(aabb)
    }

    fn end(&self) -> f64 {
        self.end()
    }

    fn meet(&mut self, (): &(), index: u32) {
        let Instance { object, affine } = &self.placed[index as usize];
        self.search.path.push(index);
        self.search.visit(*object, &self.map.after(affine));
        self.search.path.pop();
    }
}

/// Traverses a binary hierarchy.
fn walk<S>(bvh: &Bvh<S>, level: &Level, test: impl NearTest<S>) {
    let mut walk = OwnBoxes::over(Walk { bvh, test }, &level.boxes);
    level.run_shared(bvh.tree(), 0, &mut Vec::new(), &mut walk);
}

/// The visitor of a point in a binary hierarchy.
struct Walk<'b, S, T> {
    bvh: &'b Bvh<S>,
    test: T,
}

impl<S, T: NearTest<S>> Visitor for Walk<'_, S, T> {
    fn inner(&mut self, node: Node) -> Descent {
        let (record, end) = (self.bvh.node(node.index()), self.test.end());
        let [left, right] = [Side::Left, Side::Right].map(|side| self.test.to_box(&record.child_box(side)));
        Descent::new(left <= end, right <= end, right < left)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        for held in &self.bvh.triangles()[self.bvh.leaf_range(node)] {
            self.test.meet(&held.shape, held.prim);
        }
        Flow::Continue
    }
}

impl<S, T: NearTest<S>> Pruned for Walk<'_, S, T> {}

impl<S, T: NearTest<S>> BoxQuery for Walk<'_, S, T> {
    fn touches(&self, aabb: &Aabb) -> bool {
        self.test.to_box(aabb) <= self.test.end()
    }

    fn slot(&self, node: Node) -> usize {
        self.bvh.slot(node)
    }
}
