//! Rays that aim at rounding errors.

use glam::Vec3;

use crate::generate::draw::{Draw, exp2, nudge, one_of};
use crate::geom::{Aabb, Mesh, Ray};

/// Returns `n` adversarial rays for any mesh, the same for the same seed.
///
/// The kinds alternate: at a corner, at the middle of an edge, at another point of an edge, at a point inside; along an
/// axis through a corner or a middle, with zeros of either sign; from a rounded point of the surface; within the plane
/// of a triangle, or an ulp out of it; from a plane of a box, along that plane; with a direction of extreme length, or
/// with components that are zero or close to it; along an edge; from a corner or an edge; with a normalised direction
/// at an edge; and up to exactly a corner or from it on (`tmin` or `tmax` at 1 or an ulp from it).
///
/// Origins are around and inside the mesh. If coordinates are so great that differences overflow, a kind of ray is
/// tried several times before it is skipped, so there may be fewer than `n`.
///
/// ```
/// use stackless_bvh::generate::{procedural, stress};
/// let mesh = procedural::soup(1, 100);
/// assert_eq!(stress::aimed(&mesh, 7, 1000).len(), 1000);
/// ```
pub fn aimed(mesh: &Mesh, seed: u64, n: usize) -> Vec<Ray> {
    let target = Target::new(mesh);
    Draw::new(seed).rays(n, |draw, i| mixed(draw, &target, i))
}

/// A mesh to aim at.
pub(super) struct Target<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) bounds: Aabb,
    /// Half of the greatest extent; 1 for a single point.
    reach: f32,
}

impl<'a> Target<'a> {
    pub(super) fn new(mesh: &'a Mesh) -> Self {
        let bounds = Aabb::of(mesh.vertices());
        let reach = (bounds.hi * 0.5 - bounds.lo * 0.5).max_element();
        Self { mesh, bounds, reach: if reach > 0.0 { reach } else { 1.0 } }
    }

    /// From a plane of a box, along that plane or nearly.
    fn along_box(&self, draw: &mut Draw, corners: [Vec3; 3]) -> Option<Ray> {
        let aabb = if draw.one_in(2) { self.bounds } else { Aabb::of(&corners) };
        let plane = one_of([aabb.lo, aabb.hi], draw);
        let (axis, mut origin) = (draw.below(3), self.origin(draw));
        origin[axis] = plane[axis];
        let mut direction = toward(origin, on_edge(draw, corners));
        if !draw.one_in(4) {
            direction[axis] = draw.zeros()[axis];
        }
        whole(origin, direction)
    }

    /// The corners of the triangle with this number, modulo their number.
    pub(super) fn triangle(&self, i: usize) -> [Vec3; 3] {
        self.mesh.triangle(i % self.mesh.triangles().len())
    }

    /// The corners of any triangle, beginning with any.
    pub(super) fn corners(&self, draw: &mut Draw) -> [Vec3; 3] {
        let any = draw.below(self.mesh.triangles().len());
        turned(draw, self.triangle(any))
    }

    /// A point inside the box of the mesh or around it.
    fn origin(&self, draw: &mut Draw) -> Vec3 {
        let wide = one_of([0.5, 1.5, 3.0], draw);
        self.bounds.centroid() + draw.centred() * (wide * self.reach)
    }
}

/// A ray of [`aimed`], of the kind that the running number chooses.
pub(super) fn mixed(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    const KINDS: usize = 16;
    let corners @ [a, b, _] = target.corners(draw);
    let origin = target.origin(draw);
    match i % KINDS {
        0 => whole(origin, toward(origin, a)),
        1 => whole(origin, toward(origin, middle(a, b))),
        2 => whole(origin, toward(origin, on_edge(draw, corners))),
        3 => whole(origin, toward(origin, within(draw, corners))),
        4 => {
            let (through, direction) = (one_of([a, middle(a, b)], draw), draw.axis());
            whole(through - direction * (target.reach * (2.0 * draw.unit())), direction)
        }
        5 => {
            let origin = within(draw, corners);
            let other = target.corners(draw);
            whole(origin, if draw.one_in(2) { draw.direction() } else { toward(origin, within(draw, other)) })
        }
        6 => {
            let aim = on_edge(draw, corners);
            let origin = aim + (aim - within(draw, corners)) * one_of([1.0, 4.0, 64.0], draw);
            let nudges = one_of([0, 0, 1], draw);
            whole(draw.nudged(origin, nudges), toward(origin, aim))
        }
        7 => target.along_box(draw, corners),
        8 => whole(origin, toward(origin, on_edge(draw, corners)) * exp2(one_of([-120, -60, 60, 100], draw))),
        9 => {
            let mut direction = toward(origin, a);
            let axis = draw.below(3);
            let small = draw.float(-149, -120);
            direction[axis] = one_of([0.0, -0.0, small, direction[axis] * exp2(-100)], draw);
            whole(a - direction * draw.between(0.5, 1.0), direction)
        }
        10 => whole(one_of([a, a + (a - b), b], draw), toward(a, b)),
        11 => {
            let other = target.corners(draw);
            let origin = one_of([a, middle(a, b)], draw);
            whole(origin, toward(origin, one_of([other[0], middle(other[0], other[1])], draw)))
        }
        12 => whole(origin, unit(toward(origin, middle(a, b)))?),
        13 => ending(draw, origin, a),
        14 => ending(draw, origin, middle(a, b)),
        _ => {
            let point = within(draw, corners);
            ending(draw, origin, point)
        }
    }
}

/// At the triangle with this number (modulo their number): corners, edges, the inside, or a hair outside.
pub(super) fn at(draw: &mut Draw, target: &Target<'_>, i: usize) -> Option<Ray> {
    let (origin, point) = (target.origin(draw), place(draw, target.triangle(i)));
    if draw.one_in(4) { ending(draw, origin, point) } else { whole(origin, toward(origin, point)) }
}

/// The corners, beginning with any.
pub(super) fn turned(draw: &mut Draw, mut corners: [Vec3; 3]) -> [Vec3; 3] {
    corners.rotate_left(draw.below(3));
    corners
}

/// A ray without ends.
pub(super) fn whole(origin: Vec3, direction: Vec3) -> Option<Ray> {
    Ray::new(origin, direction).ok()
}

/// A ray whose hit at this `t` is to be the first: mostly, its interval begins there or a little before.
pub(super) fn late(draw: &mut Draw, origin: Vec3, direction: Vec3, t: f32) -> Option<Ray> {
    Ray::within(origin, direction, one_of([0.0, 0.99, 1.0 - exp2(-16), 1.0], draw) * t, f32::INFINITY).ok()
}

/// A ray whose interval begins or ends at a point (`t` about 1) or next to it, or goes on from there.
pub(super) fn ending(draw: &mut Draw, origin: Vec3, point: Vec3) -> Option<Ray> {
    let end = nudge(1.0, draw.int(1) as i32);
    let [tmin, tmax] = one_of([[0.0, end], [end, f32::INFINITY], [0.5, 2.0], [end, end]], draw);
    Ray::within(origin, point - origin, tmin, tmax).ok()
}

/// The difference; half of it where it overflows.
pub(super) fn toward(origin: Vec3, point: Vec3) -> Vec3 {
    let direction = point - origin;
    if direction.is_finite() { direction } else { point * 0.5 - origin * 0.5 }
}

/// The direction with unit length, at any scale; `None` for zero.
pub(super) fn unit(direction: Vec3) -> Option<Vec3> {
    // Squares of the greatest and of the least floats are out of range.
    (direction / direction.abs().max_element()).try_normalize()
}

/// The middle of an edge. It does not overflow, but for subnormal numbers it may be rounded.
pub(super) fn middle(a: Vec3, b: Vec3) -> Vec3 {
    a * 0.5 + b * 0.5
}

/// A point of the first edge, rounded.
pub(super) fn on_edge(draw: &mut Draw, [a, b, _]: [Vec3; 3]) -> Vec3 {
    let weight = draw.unit();
    a * (1.0 - weight) + b * weight
}

/// A point of the triangle, rounded.
pub(super) fn within(draw: &mut Draw, [a, b, c]: [Vec3; 3]) -> Vec3 {
    let (mut u, mut v) = (draw.unit(), draw.unit());
    if u + v > 1.0 {
        (u, v) = (1.0 - u, 1.0 - v);
    }
    a * (1.0 - u - v) + b * u + c * v
}

/// A corner, a point of an edge, a point inside, or one that is a hair outside.
pub(super) fn place(draw: &mut Draw, corners: [Vec3; 3]) -> Vec3 {
    let corners @ [a, b, c] = turned(draw, corners);
    match draw.below(6) {
        0 => a,
        1 => middle(a, b),
        2 => on_edge(draw, corners),
        3 => {
            let (weight, out) = (draw.unit(), one_of([exp2(-23), -exp2(-23), exp2(-12)], draw));
            a * (1.0 - weight + out) + b * weight - c * out
        }
        _ => within(draw, corners),
    }
}
