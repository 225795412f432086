//! `bvh`: its hierarchy by surface area.
//!
//! Its iterators in the order of distance do not shorten the ray after a hit. Its traversal of the boxes that a query
//! hits calls the query for each box, so the query here is a ray that becomes shorter. Its triangle test is for front
//! sides and unit directions, so the test here is that of Möller & Trumbore, with precomputed edges.

use std::cell::Cell;

use bvh::aabb::{Aabb, Bounded, IntersectsAabb};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::{Bvh, BvhNode};
use bvh::ray::Ray as BvhRay;
use nalgebra::{Point3, Vector3};

use crate::{Hit, PeerError, Ray, Tracer, each};

pub(crate) struct Hierarchy {
    bvh: Bvh<f32, 3>,
    triangles: Vec<Triangle>,
}

struct Triangle {
    origin: Point3<f32>,
    edges: [Vector3<f32>; 2],
    prim: u32,
    node: usize,
}

/// A ray that ends at the closest hit so far.
struct Segment {
    ray: BvhRay<f32, 3>,
    tmin: f32,
    tmax: Cell<f32>,
}

impl Hierarchy {
    pub(crate) fn new(corners: &[[[f32; 3]; 3]]) -> Result<Self, PeerError> {
        let triangle = |(prim, corners): (u32, &[[f32; 3]; 3])| {
            let [a, b, c] = corners.map(Point3::from);
            Triangle { origin: a, edges: [b - a, c - a], prim, node: 0 }
        };
        let mut triangles: Vec<_> = (0..).zip(corners).map(triangle).collect();
        let bvh = Bvh::build(&mut triangles);
        let depth = depth(&bvh);
        if depth > STACK {
            return Err(PeerError::Refused(format!("its tree has {depth} levels, and its traversals keep {STACK}")));
        }
        Ok(Self { bvh, triangles })
    }
}

impl Tracer for Hierarchy {
    fn closest(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        each(rays, hits, |ray| {
            let segment = Segment::new(ray);
            let mut best = None;
            for triangle in self.bvh.traverse_iterator(&segment, &self.triangles) {
                if let Some(t) = triangle.distance(&segment) {
                    segment.tmax.set(t);
                    best = Some((triangle.prim, t));
                }
            }
            best
        });
    }

    fn any(&self, rays: &[Ray], hits: &mut [bool]) {
        each(rays, hits, |ray| {
            let segment = Segment::new(ray);
            let mut candidates = self.bvh.traverse_iterator(&segment, &self.triangles);
            candidates.any(|triangle| triangle.distance(&segment).is_some())
        });
    }
}

/// The capacity of the crate's iterators in levels. In deeper trees they panic.
const STACK: usize = 32;

fn depth(bvh: &Bvh<f32, 3>) -> usize {
    let (mut deepest, mut pending) = (0, vec![(0, 0)]);
    while let Some((node, depth)) = pending.pop() {
        deepest = deepest.max(depth);
        if let Some(&BvhNode::Node { child_l_index, child_r_index, .. }) = bvh.nodes.get(node) {
            pending.extend([(child_l_index, depth + 1), (child_r_index, depth + 1)]);
        }
    }
    deepest
}

impl Triangle {
    #[inline]
    fn distance(&self, segment: &Segment) -> Option<f32> {
        let [e1, e2] = &self.edges;
        let Segment { ray, tmin, tmax } = segment;
        let p = ray.direction.cross(e2);
        let inverse = 1.0 / e1.dot(&p);
        let s = ray.origin - self.origin;
        let u = s.dot(&p) * inverse;
        let q = s.cross(e1);
        let v = ray.direction.dot(&q) * inverse;
        let t = e2.dot(&q) * inverse;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && *tmin <= t && t <= tmax.get()).then_some(t)
    }
}

impl Bounded<f32, 3> for Triangle {
    fn aabb(&self) -> Aabb<f32, 3> {
        let [b, c] = self.edges.map(|edge| self.origin + edge);
        Aabb::empty().grow(&self.origin).grow(&b).grow(&c)
    }
}

impl BHShape<f32, 3> for Triangle {
    fn set_bh_node_index(&mut self, node: usize) {
        self.node = node;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

impl Segment {
    #[inline]
    fn new(ray: &Ray) -> Self {
        // `Ray::new` would normalise the direction, but distances are in units of its length.
        let direction = Vector3::from(ray.direction);
        let inverse = direction.map(|x| 1.0 / x);
        let prepared = BvhRay { origin: ray.origin.into(), direction, inv_direction: inverse };
        Self { ray: prepared, tmin: ray.tmin, tmax: Cell::new(ray.tmax) }
    }
}

impl IntersectsAabb<f32, 3> for Segment {
    #[inline]
    fn intersects_aabb(&self, aabb: &Aabb<f32, 3>) -> bool {
        self.ray.intersection_slice_for_aabb(aabb).is_some_and(|(near, _)| near <= self.tmax.get())
    }
}
