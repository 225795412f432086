//! Triangle tests: the exact one, spoilt in one place.

use std::cmp::Ordering;
use std::fmt::Debug;
use std::marker::PhantomData;

use glam::Vec3;

use super::draw::Draw;
use super::files::cast;
use super::layers::{Instead, Mistake, marks};
use crate::check_triangle;
use stackless_bvh::geom::kernel::{Exact, ExactFromSingle, Moller32, Moller64, Woop};
use stackless_bvh::geom::slabs::Directed;
use stackless_bvh::geom::{Aabb, Kernel, Ray, Region, Triangle};

pub(super) const MISTAKES: [Mistake; 19] = [
    of::<Spoilt<Tenth>>("bounds for the scene a tenth", "EXACT-6"),
    of::<Spoilt<NoBounds>>("no bounds, and so no exact sums", "EXACT-6"),
    of::<Spoilt<FirstStage>>("a miss in single precision is believed", "EXACT-5"),
    of::<Spoilt<Open>>("edges are not part of the triangle", "EXACT-1"),
    of::<Spoilt<Twice>>("distance rounded to double, then to single", "EXACT-3"),
    of::<Spoilt<Single>>("distance divided in single precision", "EXACT-9"),
    of::<Spoilt<Exchanged>>("weights of the two corners exchanged", "EXACT-1"),
    of::<Spoilt<FromFirst>>("weights begin at the first corner", "EXACT-1"),
    of::<Spoilt<Culled>>("back faces are culled", "EXACT-1"),
    of::<Spoilt<EdgeOn>>("edge-on triangles are hit", "EXACT-1"),
    of::<Spoilt<OpenInterval>>("the ends of the interval are left out", "EXACT-1"),
    of::<Spoilt<RoundedFirst>>("the rounded distance is compared with the interval", "EXACT-3"),
    of::<Spoilt<BelowLimit>>("a hit at the limit is left out", "DET-1"),
    of::<Spoilt<Behind>>("what is behind is in front", "EXACT-1"),
    of::<Spoilt<Endless>>("shadows beyond the end of the ray", "EXACT-1"),
    of::<Spoilt<AnyGrid>>("on every grid, products are exact", "EXACT-11"),
    of::<Spoilt<HalfWall>>("a wall may have its third corner elsewhere", "EXACT-11"),
    of::<Woop>("signs of single precision, watertight", "EXACT-2"),
    of::<Moller64>("double precision without bounds", "EXACT-6"),
];

pub(super) const CONTROLS: [Mistake; 2] = [
    of::<Spoilt<Nothing>>("the exact test, wrapped", "EXACT-1"),
    of::<ExactFromSingle>("the exact test from single precision", "EXACT-5"),
];

const fn of<K: Kernel<Vector = Vec3, Shape = Triangle>>(name: &'static str, clause: &'static str) -> Mistake {
    Mistake::new(name, clause, fault::<K>, Instead::Rays(cast::<K, Directed>))
}

fn fault<K: Kernel<Vector = Vec3, Shape = Triangle>>(draw: &mut Draw<'_>) -> Option<String> {
    let bits = draw.bits();
    let corners = [draw.ints(bits), draw.ints(bits), draw.ints(bits)];
    let target = draw.target(bits, corners);
    let ray = draw.ray(bits, target)?;
    check_triangle::<K, _>(&Triangle(corners), &ray).err().map(|fault| fault.to_string())
}

marks! {
    Nothing Tenth NoBounds FirstStage Open Twice Single Exchanged FromFirst Culled EdgeOn OpenInterval RoundedFirst
    BelowLimit Behind Endless AnyGrid HalfWall ByIndex
}

/// The exact test with a mistake.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spoilt<S> {
    exact: Exact,
    ray: Ray,
    spoil: PhantomData<S>,
}

impl<S: Spoil> Kernel for Spoilt<S> {
    type Vector = Vec3;
    type Shape = Triangle;
    type Filter = ();

    fn new(ray: &Ray, region: &Region) -> Self {
        // Error bounds are those of a scene that is a part of this one.
        let part = |part: f64| {
            let [reach, size] = [region.reach(), region.size()].map(|length| (length * part) as f32);
            Region::of(&Aabb { lo: Vec3::splat(reach - size), hi: Vec3::splat(reach) })
        };
        let exact = match S::BUG {
            Bug::Tenth => Exact::new(ray, &part(0.1)),
            Bug::NoBounds => Exact::new(ray, &part(0.0)),
            _ => Exact::new(ray, region),
        };
        Self { exact, ray: *ray, spoil: PhantomData }
    }

    fn distance(&self, shape: &Triangle, limit: f32) -> Option<f32> {
        let (found, [tmin, tmax]) = (self.exact.distance(shape, limit), [self.ray.tmin(), self.ray.tmax()]);
        let is_within = |[u, v]: [f32; 2]| u > 0.0 && v > 0.0 && u + v < 1.0;
        match S::BUG {
            Bug::FirstStage => self.by::<Moller32>(shape).and(found),
            Bug::Open => found.filter(|_| is_within(self.exact.weights(shape))),
            Bug::Twice => found.map(|t| self.by::<Moller64>(shape).unwrap_or(t)),
            Bug::Single => found.map(|t| self.by::<Moller32>(shape).unwrap_or(t)),
            Bug::Culled => found.filter(|_| self.determinant(shape) < 0.0),
            Bug::EdgeOn => found.or_else(|| (self.determinant(shape) == 0.0).then_some(tmin)),
            Bug::OpenInterval => found.filter(|&t| tmin < t && t < tmax),
            Bug::RoundedFirst => {
                let wider = [tmin.next_down().max(0.0), tmax.next_up()];
                self.along(1.0, wider, shape, f32::INFINITY).filter(|&t| tmin <= t && t <= tmax)
            }
            Bug::BelowLimit => found.filter(|&t| t < limit),
            Bug::AnyGrid if self.are_whole(shape) => self.by::<Moller64>(shape).and_then(|t| found.or(Some(t))),
            Bug::HalfWall => found.filter(|_| !self.runs_along_edge(shape)),
            Bug::Behind => found.or_else(|| self.along(-1.0, [tmin, tmax], shape, limit)),
            _ => found,
        }
    }

    fn blocks(&self, shape: &Triangle) -> bool {
        match S::BUG {
            Bug::Endless => self.along(1.0, [self.ray.tmin(), f32::INFINITY], shape, f32::INFINITY).is_some(),
            _ => self.distance(shape, f32::INFINITY).is_some(),
        }
    }

    fn compare(&self, shape: &Triangle, other: &Triangle) -> Ordering {
        if S::BUG == Bug::ByIndex { Ordering::Equal } else { self.exact.compare(shape, other) }
    }

    fn compare_with(&self, shape: &Triangle, t: f32) -> Ordering {
        self.exact.compare_with(shape, t)
    }

    fn weights(&self, shape: &Triangle) -> [f32; 2] {
        let (Triangle([v0, v1, v2]), [u, v]) = (*shape, self.exact.weights(shape));
        match S::BUG {
            Bug::Exchanged => [v, u],
            Bug::FromFirst => self.exact.weights(&Triangle([v2, v0, v1])),
            _ => [u, v],
        }
    }
}

impl<S> Spoilt<S> {
    /// What the library's other test `K` says.
    fn by<K: Kernel<Vector = Vec3, Shape = Triangle>>(&self, triangle: &Triangle) -> Option<f32> {
        K::new(&self.ray, &Region::of(&triangle.aabb())).distance(triangle, f32::INFINITY)
    }

    /// What the exact test says of the ray, or of its reverse, over another interval.
    fn along(&self, sign: f32, [tmin, tmax]: [f32; 2], triangle: &Triangle, limit: f32) -> Option<f32> {
        let ray = Ray::within(self.ray.origin(), self.ray.direction() * sign, tmin, tmax).ok()?;
        Exact::new(&ray, &Region::of(&triangle.aabb())).distance(triangle, limit)
    }

    /// Whether all coordinates are whole numbers.
    fn are_whole(&self, &Triangle(corners): &Triangle) -> bool {
        corners.into_iter().chain([self.ray.origin(), self.ray.direction()]).all(|v| v == v.trunc())
    }

    /// Whether there is an axis on which the first two corners are at one place, and the ray stays where it is.
    fn runs_along_edge(&self, &Triangle([v0, v1, _]): &Triangle) -> bool {
        (0..3).any(|axis| self.ray.direction()[axis] == 0.0 && v0[axis] == v1[axis])
    }

    /// The direction times the normal: 0 for a triangle that is seen edge-on.
    fn determinant(&self, triangle: &Triangle) -> f64 {
        let [v0, v1, v2] = triangle.widen();
        (v1 - v0).cross(v2 - v0).dot(self.ray.direction().as_dvec3())
    }
}
