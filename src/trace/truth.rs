//! The truth about rays and meshes, in rational arithmetic: what every exact query has to answer.
//!
//! A ray hits a triangle if the line crosses it, edges and corners included, at an exact `t` with `tmin <= t <= tmax`
//! ([`crate::geom::truth::meet`]). A triangle of determinant 0 is not hit. Hits are ordered by `t` rounded to the
//! nearest `f32`, then by primitive; the closest hit is the first one. `[EXACT-1]` For a mesh and rays in double
//! precision, read `f64`. `[EXACT-7]`
//!
//! [`brute_force`] is this definition. [`Truth`] gives the same answers sooner, by leaving out triangles that the ray
//! misses by far. Its hierarchy and its box test are its own and as plain as can be, so that it does not rest on what
//! it judges.

use std::cmp::Ordering;
use std::ops::{Range, RangeInclusive};

use glam::Vec3;

use super::Hit;
use crate::geom::truth::{Number, Point, RBig, distance_from, meet, round_f64};
use crate::geom::{Mesh, Ray, Vector};

/// Where a ray truly hits a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct TrueHit<R = f32> {
    /// Index of the triangle in the mesh.
    pub prim: u32,
    /// The float nearest to the distance, in lengths of the direction. Infinite if that is beyond all floats.
    pub t: R,
    /// The point itself, with the exact distance.
    pub point: Point,
}

impl<R: Number> TrueHit<R> {
    /// The hit with distance and weights rounded to the nearest floats, ties to even: what an exact query answers.
    pub fn rounded(&self) -> Hit<R> {
        let Point { u, v, .. } = &self.point;
        Hit { prim: self.prim, t: self.t, u: R::nearest(u), v: R::nearest(v) }
    }
}

/// All hits of a ray, by testing every triangle of the mesh, in the order (rounded `t`, primitive).
///
/// ```
/// use glam::Vec3;
/// use stackless_bvh::{geom::Ray, geom::Mesh, trace};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2], [2, 1, 0]])?;
/// let ray = Ray::within(Vec3::new(0.5, 0.5, -2.0), Vec3::Z, 0.0, 2.0)?;
/// let hits = trace::truth::brute_force(&mesh, &ray);
/// assert_eq!(hits.iter().map(|hit| (hit.prim, hit.t)).collect::<Vec<_>>(), [(0, 2.0), (1, 2.0)]);
/// # Ok(())
/// # }
/// ```
pub fn brute_force<V: Vector>(mesh: &Mesh<V>, ray: &Ray<V>) -> Vec<TrueHit<V::Real>> {
    let corners = (0..mesh.triangles().len()).map(|prim| corners(mesh, prim));
    in_order((0..).zip(corners).filter_map(|(prim, corners)| hit(prim, corners, ray)))
}

/// The answers of [`brute_force`], in time that does not grow much with the mesh: for tests of many rays.
///
/// ```
/// use stackless_bvh::generate::procedural;
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
pub struct Truth<V: Vector = Vec3> {
    triangles: Vec<Corners<V>>,
    /// The leaves from left to right: all primitives, once each.
    prims: Vec<u32>,
    /// Of every node in preorder. A node over `n` primitives has `2 n - 1` in its subtree and halves them.
    boxes: Vec<Bounds>,
}

type Corners<V> = [[<V as Vector>::Real; 3]; 3];

impl<V: Vector> Truth<V> {
    /// Prepares a mesh; it is copied.
    pub fn new(mesh: &Mesh<V>) -> Self {
        let triangles: Vec<_> = (0..mesh.triangles().len()).map(|prim| corners(mesh, prim)).collect();
        let (mut prims, mut boxes): (Vec<_>, _) = ((0..triangles.len() as u32).collect(), Vec::new());
        build::<V>(&triangles, &mut prims, &mut boxes);
        Self { triangles, prims, boxes }
    }

    /// The first hit in the order (rounded `t`, primitive).
    pub fn closest(&self, ray: &Ray<V>) -> Option<TrueHit<V::Real>> {
        self.hits(ray).min_by(order)
    }

    /// Whether there is a hit.
    pub fn any(&self, ray: &Ray<V>) -> bool {
        self.hits(ray).next().is_some()
    }

    /// Whether a ray from a rational point meets a triangle strictly between 0 and `tmax`. `[SECOND-2]`
    pub fn any_from(&self, origin: &[RBig; 3], direction: V, tmax: V::Real) -> bool {
        let components = |v: V| v.widen().to_array();
        let gross = Gross::along(origin.each_ref().map(round_f64), components(direction), [0.0, tmax.into()]);
        let tmax = RBig::try_from(tmax.into()).ok();
        self.candidates(gross).any(|prim| {
            let t = distance_from(self.triangles[prim as usize], origin, direction.components());
            t.is_some_and(|t| t > RBig::ZERO && tmax.as_ref().is_none_or(|tmax| t < *tmax))
        })
    }

    /// All hits in the order (rounded `t`, primitive).
    pub fn all(&self, ray: &Ray<V>) -> Vec<TrueHit<V::Real>> {
        in_order(self.hits(ray))
    }

    /// All hits, in the order of the leaves.
    fn hits(&self, ray: &Ray<V>) -> impl Iterator<Item = TrueHit<V::Real>> {
        self.candidates(Gross::new(ray)).filter_map(|prim| hit(prim, self.triangles[prim as usize], ray))
    }

    /// The primitives whose box, and all boxes above it, the ray does not miss by far.
    fn candidates(&self, gross: Gross) -> impl Iterator<Item = u32> {
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
fn hit<V: Vector>(prim: u32, corners: Corners<V>, ray: &Ray<V>) -> Option<TrueHit<V::Real>> {
    let meeting = meet(corners, ray.origin().components(), ray.direction().components());
    let point = meeting.within([ray.tmin(), ray.tmax()])?;
    Some(TrueHit { prim, t: Number::nearest(&point.t), point })
}

fn order<R: Number>(a: &TrueHit<R>, b: &TrueHit<R>) -> Ordering {
    let (t, other): (f64, f64) = (a.t.into(), b.t.into());
    t.total_cmp(&other).then(a.prim.cmp(&b.prim))
}

fn in_order<R: Number>(hits: impl Iterator<Item = TrueHit<R>>) -> Vec<TrueHit<R>> {
    let mut hits: Vec<_> = hits.collect();
    hits.sort_by(order);
    hits
}

fn corners<V: Vector>(mesh: &Mesh<V>, prim: usize) -> Corners<V> {
    mesh.triangle(prim).map(Vector::components)
}

/// Adds the boxes of the tree over `prims`, at least one, and sorts these: along the axis on which the middles of
/// their boxes differ most, halved, and again.
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

/// A box.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    lo: [f64; 3],
    hi: [f64; 3],
}

impl Bounds {
    const EMPTY: Self = Self { lo: [f64::INFINITY; 3], hi: [f64::NEG_INFINITY; 3] };

    fn of<V: Vector>(corners: &Corners<V>) -> Self {
        corners.iter().map(|corner| corner.map(Into::into)).fold(Self::EMPTY, Self::grow)
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
    /// Whether the components of the direction that are not 0 are in [`RANGE`].
    in_range: bool,
}

/// Numbers of such size can be told to be far from each other without overflow. All in single precision are of it.
const RANGE: RangeInclusive<f64> = f64::from_bits((1023 - 400) << 52)..=f64::from_bits((1023 + 400) << 52);

impl Gross {
    fn new<V: Vector>(ray: &Ray<V>) -> Self {
        let [origin, direction] = [ray.origin(), ray.direction()].map(|x| x.widen().to_array());
        Self::along(origin, direction, [ray.tmin().into(), ray.tmax().into()])
    }

    /// The origin may have been rounded, which the margin allows for.
    fn along(origin: [f64; 3], direction: [f64; 3], [tmin, tmax]: [f64; 2]) -> Self {
        let in_range = direction.into_iter().all(|x| x == 0.0 || RANGE.contains(&x.abs()));
        Self { origin, direction, tmin, tmax, in_range }
    }

    /// False for every box that the ray touches.
    ///
    /// The box is widened by a margin of 10^-9 of the greatest coordinate `m` at hand. Rounding moves a plane of it,
    /// as the ray sees it, by less than 10^-15 `m`: 1.1 units of 2^-53 for adding the margin, 2.1 for subtracting
    /// the origin, and 2.1 for the quotient, whose numerator is below 2.1 `m`. So the margin is a million times
    /// what it must be, and a ray that touches the box at some `t` has `near <= t <= far` on every axis.
    ///
    /// Of `m` and of the direction's components, none may be outside of 2^-400 to 2^400, unless it is 0; else no box is
    /// missed. So nothing overflows, and no NaN arises: differences are below 2^402, quotients below 2^803. Sums and
    /// differences do not underflow. A quotient may, by 2^-1075; but the margin, over a component of the direction, is
    /// above 2^-830.
    fn misses(&self, bounds: &Bounds) -> bool {
        let Self { origin: o, direction: d, .. } = self;
        let Bounds { lo, hi } = bounds;
        let greatest = [o, lo, hi].into_iter().flatten().fold(0.0, |greatest: f64, x| greatest.max(x.abs()));
        if !self.in_range || greatest != 0.0 && !RANGE.contains(&greatest) {
            return false;
        }
        let margin = 1e-9 * greatest;
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
