//! The ground truth about rays and meshes, in rational arithmetic: the required answers of every exact query.
//!
//! A ray hits a triangle if the line crosses it, including edges and corners, at an exact `t` with `tmin <= t <= tmax`
//! ([`crate::geom::truth::meet`]). A triangle of determinant 0 is not hit. Hits are ordered by `t`, then by primitive;
//! the closest hit is the first one. Its distance is `t` rounded to the nearest `f32`. `[EXACT-1]` For a mesh and rays
//! in double precision, read `f64`. `[EXACT-7]`
//!
//! [`brute_force`] is this definition. [`Truth`] gives the same answers faster, because it skips triangles that the ray
//! misses by a wide margin. It has a separate, simple hierarchy, box test and triangle test, which share nothing with
//! the code under test.

mod conservative_cull;

use std::cmp::Ordering;
use std::ops::Range;

use glam::Vec3;

use super::Hit;
use crate::geom::truth::{Number, Point, RBig, distance_from, meet, round_f64};
use crate::geom::{Mesh, Ray, Vector};
use conservative_cull::{Bounds, ConservativeCull};

/// An exact hit of a ray and a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct TrueHit<R = f32> {
    /// Index of the triangle in the mesh.
    pub prim: u32,
    /// The float nearest to the distance, in units of the length of the direction. Infinite if that is beyond all
    /// floats.
    pub t: R,
    /// The point, with the exact distance.
    pub point: Point,
}

impl<R: Number> TrueHit<R> {
    /// Returns the hit with distance and weights rounded to the nearest floats, ties to even: the answer of an exact
    /// query.
    pub fn rounded(&self) -> Hit<R> {
        let Point { u, v, .. } = &self.point;
        Hit { prim: self.prim, t: self.t, u: R::nearest(u), v: R::nearest(v) }
    }
}

/// Returns all hits of a ray in the order (exact `t`, primitive), by tests of every triangle of the mesh.
///
/// ```
/// use stackless_bvh::glam::Vec3;
/// use stackless_bvh::{geom::Mesh, geom::Ray, internals::trace::brute_force};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2], [2, 1, 0]])?;
/// let ray = Ray::within(Vec3::new(0.5, 0.5, -2.0), Vec3::Z, 0.0, 2.0)?;
/// let hits = brute_force(&mesh, &ray);
/// assert_eq!(hits.iter().map(|hit| (hit.prim, hit.t)).collect::<Vec<_>>(), [(0, 2.0), (1, 2.0)]);
/// # Ok(())
/// # }
/// ```
pub fn brute_force<V: Vector>(mesh: &Mesh<V>, ray: &Ray<V>) -> Vec<TrueHit<V::Real>> {
    let corners = (0..mesh.triangles().len()).map(|prim| corners(mesh, prim));
    in_order((0..).zip(corners).filter_map(|(prim, corners)| hit(prim, corners, ray)))
}

/// The answers of [`brute_force`], in time that grows little with the mesh: for tests of many rays.
///
/// ```
/// use stackless_bvh::generate::procedural;
/// use stackless_bvh::internals::trace::{Truth, brute_force};
///
/// let mesh = procedural::soup(1, 100);
/// let judge = Truth::new(&mesh);
/// for ray in procedural::rays(&mesh, 2, 20) {
///     assert_eq!(judge.all(&ray), brute_force(&mesh, &ray));
///     assert_eq!(judge.any(&ray), judge.closest(&ray).is_some());
/// }
/// ```
#[derive(Clone, Debug)]
pub struct Truth<V: Vector = Vec3> {
    triangles: Vec<Corners<V>>,
    /// The leaves from left to right: all primitives, once each.
    prims: Vec<u32>,
    /// The box of every node in preorder. A node over `n` primitives has `2 n - 1` nodes in its subtree and halves the
    /// primitives.
    boxes: Vec<Bounds>,
}

type Corners<V> = [[<V as Vector>::Real; 3]; 3];

impl<V: Vector> Truth<V> {
    /// Prepares a copy of a mesh.
    pub fn new(mesh: &Mesh<V>) -> Self {
        let triangles: Vec<_> = (0..mesh.triangles().len()).map(|prim| corners(mesh, prim)).collect();
        let (mut prims, mut boxes): (Vec<_>, _) = ((0..triangles.len() as u32).collect(), Vec::new());
        build::<V>(&triangles, &mut prims, &mut boxes);
        Self { triangles, prims, boxes }
    }

    /// Returns the first hit in the order (exact `t`, primitive).
    pub fn closest(&self, ray: &Ray<V>) -> Option<TrueHit<V::Real>> {
        let (mut candidates, mut first) = (self.candidates(ConservativeCull::new(ray)), None);
        while let Some(prim) = candidates.next() {
            let hit = hit(prim, self.triangles[prim as usize], ray);
            first = first.into_iter().chain(hit).min_by(order);
            if let Some(TrueHit { t, .. }) = first {
                candidates.conservative_cull.end_by(t.into());
            }
        }
        first
    }

    /// Returns whether there is a hit.
    pub fn any(&self, ray: &Ray<V>) -> bool {
        self.hits(ray).next().is_some()
    }

    /// Returns whether a ray from a rational point meets a triangle strictly between 0 and `tmax`. `[SECOND-2]`
    pub fn any_from(&self, origin: &[RBig; 3], direction: V, tmax: V::Real) -> bool {
        let components = |v: V| v.widen().to_array();
        let conservative_cull =
            ConservativeCull::along(origin.each_ref().map(round_f64), components(direction), [0.0, tmax.into()]);
        let tmax = RBig::try_from(tmax.into()).ok();
        self.candidates(conservative_cull).any(|prim| {
            let t = distance_from(self.triangles[prim as usize], origin, direction.components());
            t.is_some_and(|t| t > RBig::ZERO && tmax.as_ref().is_none_or(|tmax| t < *tmax))
        })
    }

    /// Returns all hits in the order (exact `t`, primitive).
    pub fn all(&self, ray: &Ray<V>) -> Vec<TrueHit<V::Real>> {
        in_order(self.hits(ray))
    }

    /// Returns all hits, in no particular order.
    fn hits(&self, ray: &Ray<V>) -> impl Iterator<Item = TrueHit<V::Real>> {
        self.candidates(ConservativeCull::new(ray)).filter_map(|prim| hit(prim, self.triangles[prim as usize], ray))
    }

    fn candidates(&self, conservative_cull: ConservativeCull) -> Candidates<'_, V> {
        let root = conservative_cull.entry(&self.boxes[0]).map(|near| (near, 0, 0..self.prims.len()));
        let waiting = root.into_iter().filter(|(.., leaves)| !leaves.is_empty()).collect();
        Candidates { truth: self, conservative_cull, waiting }
    }
}

/// The primitives that the ray does not miss by a wide margin, nor their boxes, nor any box above; roughly from near to
/// far.
struct Candidates<'t, V: Vector> {
    truth: &'t Truth<V>,
    conservative_cull: ConservativeCull,
    /// The distance at which the ray enters a node's box, the node, and its leaves.
    waiting: Vec<(f64, usize, Range<usize>)>,
}

impl<V: Vector> Iterator for Candidates<'_, V> {
    type Item = u32;

    fn next(&mut self) -> Option<u32> {
        let Self { truth: Truth { triangles, prims, boxes }, conservative_cull, waiting } = self;
        loop {
            let (near, node, leaves) = waiting.pop()?;
            if conservative_cull.ends_before(near) {
                continue;
            }
            if leaves.len() == 1 {
                let prim = prims[leaves.start];
                if conservative_cull.misses_triangle::<V>(&triangles[prim as usize]) {
                    continue;
                }
                return Some(prim);
            }
            let (left, right) = halves(leaves);
            let children = [(node + 1, left.clone()), (node + 2 * left.len(), right)];
            let first = waiting.len();
            let entered =
                |(node, leaves): (usize, _)| conservative_cull.entry(&boxes[node]).map(|near| (near, node, leaves));
            waiting.extend(children.into_iter().filter_map(entered));
            // The nearer child is taken first.
            waiting[first..].sort_by(|(a, ..), (b, ..)| b.total_cmp(a));
        }
    }
}

/// Returns the hit of one triangle, if the ray hits it.
fn hit<V: Vector>(prim: u32, corners: Corners<V>, ray: &Ray<V>) -> Option<TrueHit<V::Real>> {
    let meeting = meet(corners, ray.origin().components(), ray.direction().components());
    let point = meeting.within([ray.tmin(), ray.tmax()])?;
    Some(TrueHit { prim, t: Number::nearest(&point.t), point })
}

fn order<R>(a: &TrueHit<R>, b: &TrueHit<R>) -> Ordering {
    a.point.t.cmp(&b.point.t).then(a.prim.cmp(&b.prim))
}

fn in_order<R>(hits: impl Iterator<Item = TrueHit<R>>) -> Vec<TrueHit<R>> {
    let mut hits: Vec<_> = hits.collect();
    hits.sort_unstable_by(order);
    hits
}

fn corners<V: Vector>(mesh: &Mesh<V>, prim: usize) -> Corners<V> {
    mesh.triangle(prim).map(Vector::components)
}

/// Adds the boxes of the tree over `prims`, at least one, and sorts `prims`: it halves them along the axis on which the
/// centers of their boxes differ most, recursively.
fn build<V: Vector>(triangles: &[Corners<V>], prims: &mut [u32], boxes: &mut Vec<Bounds>) {
    let bounds = |&prim: &u32| Bounds::of::<V>(&triangles[prim as usize]);
    let middles = |prim: &u32| bounds(prim).middle();
    boxes.push(prims.iter().map(bounds).fold(Bounds::EMPTY, Bounds::union));
    if prims.len() > 1 {
        let spread = prims.iter().map(middles).fold(Bounds::EMPTY, Bounds::grow);
        let width = |axis: &usize| spread.hi[*axis] - spread.lo[*axis];
        let axis = (0..3).max_by(|a, b| width(a).total_cmp(&width(b))).unwrap_or(0);
        let (left, _) = halves(0..prims.len());
        prims.select_nth_unstable_by(left.end, |a, b| middles(a)[axis].total_cmp(&middles(b)[axis]));
        let (left, right) = prims.split_at_mut(left.end);
        build::<V>(triangles, left, boxes);
        build::<V>(triangles, right, boxes);
    }
}

fn halves(leaves: Range<usize>) -> (Range<usize>, Range<usize>) {
    let middle = leaves.start + leaves.len() / 2;
    (leaves.start..middle, middle..leaves.end)
}

#[cfg(test)]
mod tests;
