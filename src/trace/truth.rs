//! The truth about rays and meshes, in rational arithmetic: what every exact query has to answer.
//!
//! A ray hits a triangle if the line crosses it, edges and corners included, at an exact `t` with `tmin <= t <= tmax`
//! ([`crate::geom::truth::meet`]). A triangle of determinant 0 is not hit. Hits are ordered by `t` rounded to the
//! nearest `f32`, then by primitive; the closest hit is the first one. `[EXACT-1]`
//!
//! [`brute_force`] is this definition. [`Truth`] gives the same answers sooner, by leaving out triangles that the ray
//! misses by far. Its hierarchy and its box test are its own and as plain as can be, so that it does not rest on what
//! it judges.

use std::cmp::Ordering;
use std::ops::Range;

use super::Hit;
use crate::geom::Ray;
use crate::geom::truth::{Meeting, Point, holds, meet, round_f32};
use crate::scene::Mesh;

/// Where a ray truly hits a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct TrueHit {
    /// Index of the triangle in the mesh.
    pub prim: u32,
    /// The `f32` nearest to the distance, in lengths of the direction. Infinite if that is beyond all floats.
    pub t: f32,
    /// The point itself, with the exact distance.
    pub point: Point,
}

impl TrueHit {
    /// The hit with distance and weights rounded to the nearest floats, ties to even: what an exact query answers.
    pub fn rounded(&self) -> Hit {
        let Point { u, v, .. } = &self.point;
        Hit { prim: self.prim, t: self.t, u: round_f32(u), v: round_f32(v) }
    }
}

/// All hits of a ray, by testing every triangle of the mesh, in the order (rounded `t`, primitive).
///
/// ```
/// use glam::Vec3;
/// use stackless_bvh::{geom::Ray, scene::Mesh, trace};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2], [2, 1, 0]])?;
/// let ray = Ray::new(Vec3::new(0.5, 0.5, -2.0), Vec3::Z, 0.0, 2.0)?;
/// let hits = trace::truth::brute_force(&mesh, &ray);
/// assert_eq!(hits.iter().map(|hit| (hit.prim, hit.t)).collect::<Vec<_>>(), [(0, 2.0), (1, 2.0)]);
/// # Ok(())
/// # }
/// ```
pub fn brute_force(mesh: &Mesh, ray: &Ray) -> Vec<TrueHit> {
    let corners = (0..mesh.triangles().len()).map(|prim| corners(mesh, prim));
    in_order((0..).zip(corners).filter_map(|(prim, corners)| hit(prim, corners, ray)))
}

/// The answers of [`brute_force`], in time that does not grow much with the mesh: for tests of many rays.
///
/// ```
/// use stackless_bvh::scene::procedural;
/// use stackless_bvh::trace::{Truth, truth};
///
/// let mesh = procedural::soup(1, 100);
/// let judge = Truth::new(&mesh);
/// for ray in procedural::rays(&mesh, 2, 20) {
///     assert_eq!(judge.all(&ray), truth::brute_force(&mesh, &ray));
///     assert_eq!(judge.any(&ray), judge.closest(&ray).is_some());
/// }
/// ```
#[derive(Clone, Debug)]
pub struct Truth {
    triangles: Vec<Corners>,
    /// The leaves from left to right: all primitives, once each.
    prims: Vec<u32>,
    /// Of every node in preorder. A node over `n` primitives has `2 n - 1` in its subtree and halves them.
    boxes: Vec<Bounds>,
}

type Corners = [[f32; 3]; 3];

impl Truth {
    /// Prepares a mesh; it is copied.
    pub fn new(mesh: &Mesh) -> Self {
        let triangles: Vec<_> = (0..mesh.triangles().len()).map(|prim| corners(mesh, prim)).collect();
        let (mut prims, mut boxes): (Vec<_>, _) = ((0..triangles.len() as u32).collect(), Vec::new());
        build(&triangles, &mut prims, &mut boxes);
        Self { triangles, prims, boxes }
    }

    /// The first hit in the order (rounded `t`, primitive).
    pub fn closest(&self, ray: &Ray) -> Option<TrueHit> {
        self.hits(ray).min_by(order)
    }

    /// Whether there is a hit.
    pub fn any(&self, ray: &Ray) -> bool {
        self.hits(ray).next().is_some()
    }

    /// All hits in the order (rounded `t`, primitive).
    pub fn all(&self, ray: &Ray) -> Vec<TrueHit> {
        in_order(self.hits(ray))
    }

    /// All hits, in the order of the leaves.
    fn hits(&self, ray: &Ray) -> impl Iterator<Item = TrueHit> {
        self.candidates(ray).filter_map(|prim| hit(prim, self.triangles[prim as usize], ray))
    }

    /// The primitives whose box, and all boxes above it, the ray does not miss by far.
    fn candidates(&self, ray: &Ray) -> impl Iterator<Item = u32> {
        let gross = Gross::new(ray);
        let mut stack = vec![(0, 0..self.prims.len())];
        std::iter::from_fn(move || {
            loop {
                let (node, leaves) = stack.pop()?;
                if gross.misses(&self.boxes[node]) {
                    continue;
                }
                if leaves.len() == 1 {
                    return Some(self.prims[leaves.start]);
                }
                let (left, right) = halves(leaves);
                stack.push((node + 2 * left.len(), right));
                stack.push((node + 1, left));
            }
        })
    }
}

/// The hit of one triangle, if the ray hits it.
fn hit(prim: u32, corners: Corners, ray: &Ray) -> Option<TrueHit> {
    match meet(corners, ray.origin().to_array(), ray.direction().to_array()) {
        Meeting::Hit(point) if holds([ray.tmin(), ray.tmax()], &point.t) => {
            Some(TrueHit { prim, t: round_f32(&point.t), point })
        }
        _ => None,
    }
}

fn order(a: &TrueHit, b: &TrueHit) -> Ordering {
    a.t.total_cmp(&b.t).then(a.prim.cmp(&b.prim))
}

fn in_order(hits: impl Iterator<Item = TrueHit>) -> Vec<TrueHit> {
    let mut hits: Vec<_> = hits.collect();
    hits.sort_by(order);
    hits
}

fn corners(mesh: &Mesh, prim: usize) -> Corners {
    mesh.triangle(prim).map(|corner| corner.to_array())
}

/// Adds the boxes of the tree over `prims`, at least one, and sorts these: along the axis on which the middles of
/// their boxes differ most, halved, and again.
fn build(triangles: &[Corners], prims: &mut [u32], boxes: &mut Vec<Bounds>) {
    let bounds = |&prim: &u32| Bounds::of(&triangles[prim as usize]);
    let middles = |prim: &u32| bounds(prim).middle();
    boxes.push(prims.iter().map(bounds).fold(Bounds::EMPTY, Bounds::union));
    if prims.len() > 1 {
        let spread = prims.iter().map(middles).fold(Bounds::EMPTY, Bounds::grow);
        let width = |axis: &usize| spread.hi[*axis] - spread.lo[*axis];
        let axis = (0..3).max_by(|a, b| width(a).total_cmp(&width(b))).unwrap_or(0);
        let (left, _) = halves(0..prims.len());
        prims.select_nth_unstable_by(left.end, |a, b| middles(a)[axis].total_cmp(&middles(b)[axis]));
        let (left, right) = prims.split_at_mut(left.end);
        build(triangles, left, boxes);
        build(triangles, right, boxes);
    }
}

fn halves(leaves: Range<usize>) -> (Range<usize>, Range<usize>) {
    let middle = leaves.start + leaves.len() / 2;
    (leaves.start..middle, middle..leaves.end)
}

/// A box.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    lo: [f64; 3],
    hi: [f64; 3],
}

impl Bounds {
    const EMPTY: Self = Self { lo: [f64::INFINITY; 3], hi: [f64::NEG_INFINITY; 3] };

    fn of(corners: &Corners) -> Self {
        corners.iter().map(|corner| corner.map(f64::from)).fold(Self::EMPTY, Self::grow)
    }

    fn grow(self, point: [f64; 3]) -> Self {
        self.union(Self { lo: point, hi: point })
    }

    fn union(self, other: Self) -> Self {
        let each = |f: fn(f64, f64) -> f64, a: [f64; 3], b: [f64; 3]| std::array::from_fn(|k| f(a[k], b[k]));
        Self { lo: each(f64::min, self.lo, other.lo), hi: each(f64::max, self.hi, other.hi) }
    }

    fn middle(&self) -> [f64; 3] {
        std::array::from_fn(|axis| 0.5 * (self.lo[axis] + self.hi[axis]))
    }
}

/// A ray, for a test that tells which boxes it misses by far.
struct Gross {
    origin: [f64; 3],
    direction: [f64; 3],
    tmin: f64,
    tmax: f64,
}

impl Gross {
    fn new(ray: &Ray) -> Self {
        let [origin, direction] = [ray.origin(), ray.direction()].map(|x| x.to_array().map(f64::from));
        Self { origin, direction, tmin: ray.tmin().into(), tmax: ray.tmax().into() }
    }

    /// False for every box that the ray touches.
    ///
    /// The box is widened by a margin of 10^-9 of the greatest coordinate `m` at hand. Rounding moves a plane of it,
    /// as the ray sees it, by less than 10^-15 `m`: 1.1 units of 2^-53 for adding the margin, 2.1 for subtracting
    /// the origin, and 2.1 for the quotient, whose numerator is below 2.1 `m`. So the margin is a million times
    /// what it must be, and a ray that touches the box at some `t` has `near <= t <= far` on every axis.
    ///
    /// Nothing overflows or underflows: coordinates are zero or between 2^-149 and 2^128, differences and margin zero
    /// or above 2^-260, quotients below 2^279 and above 2^-390. No NaN arises; if one did, it would not bound the ray.
    fn misses(&self, bounds: &Bounds) -> bool {
        let Self { origin: o, direction: d, .. } = self;
        let Bounds { lo, hi } = bounds;
        let margin = 1e-9 * [o, lo, hi].into_iter().flatten().fold(0.0, |greatest: f64, x| greatest.max(x.abs()));
        let (mut near, mut far) = (self.tmin, self.tmax);
        for k in 0..3 {
            let (lo, hi) = (lo[k] - margin, hi[k] + margin);
            if d[k] == 0.0 {
                if o[k] < lo || hi < o[k] {
                    return true;
                }
            } else {
                let (t1, t2) = ((lo - o[k]) / d[k], (hi - o[k]) / d[k]);
                near = near.max(t1.min(t2));
                far = far.min(t1.max(t2));
            }
        }
        near > far
    }
}

#[cfg(test)]
mod tests;
