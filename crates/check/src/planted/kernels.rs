//! Triangle tests: the exact one, spoilt in one place.

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

pub(super) const MISTAKES: [Mistake; 17] = [
    of::<Spoilt<Part<10>>>("bounds for the scene a tenth", "EXACT-6"),
    of::<Spoilt<Part<0>>>("no bounds, and so no exact sums", "EXACT-6"),
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

/// The exact test with a mistake.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spoilt<S> {
    exact: Exact,
    ray: Ray,
    spoil: PhantomData<S>,
}

/// What is not as in the exact test.
pub(super) trait Spoil: Copy + Debug {
    fn prepare(ray: &Ray, region: &Region) -> Exact {
        Exact::new(ray, region)
    }

    fn distance(test: &Spoilt<Self>, triangle: &Triangle, limit: f32) -> Option<f32> {
        test.exact.distance(triangle, limit)
    }

    fn blocks(test: &Spoilt<Self>, triangle: &Triangle) -> bool {
        Self::distance(test, triangle, f32::INFINITY).is_some()
    }

    fn weights(test: &Spoilt<Self>, triangle: &Triangle) -> [f32; 2] {
        test.exact.weights(triangle)
    }
}

impl<S: Spoil> Kernel for Spoilt<S> {
    type Vector = Vec3;
    type Shape = Triangle;

    fn new(ray: &Ray, region: &Region) -> Self {
        Self { exact: S::prepare(ray, region), ray: *ray, spoil: PhantomData }
    }

    fn distance(&self, shape: &Triangle, limit: f32) -> Option<f32> {
        S::distance(self, shape, limit)
    }

    fn blocks(&self, shape: &Triangle) -> bool {
        S::blocks(self, shape)
    }

    fn weights(&self, shape: &Triangle) -> [f32; 2] {
        S::weights(self, shape)
    }
}

impl<S> Spoilt<S> {
    /// What the library's other test `K` says.
    fn by<K: Kernel<Vector = Vec3, Shape = Triangle>>(&self, triangle: &Triangle) -> Option<f32> {
        K::new(&self.ray, &Region::of(&triangle.aabb())).distance(triangle, f32::INFINITY)
    }

    /// The ray with another interval, tested exactly.
    fn over(&self, [tmin, tmax]: [f32; 2], triangle: &Triangle) -> Option<f32> {
        let ray = Ray::within(self.ray.origin(), self.ray.direction(), tmin, tmax).ok()?;
        Exact::new(&ray, &Region::of(&triangle.aabb())).distance(triangle, f32::INFINITY)
    }

    /// The direction times the normal: 0 for a triangle that is seen edge-on.
    fn determinant(&self, triangle: &Triangle) -> f64 {
        let [v0, v1, v2] = triangle.widen();
        (v1 - v0).cross(v2 - v0).dot(self.ray.direction().as_dvec3())
    }
}

marks! { Nothing FirstStage Open Twice Single Exchanged FromFirst Culled EdgeOn OpenInterval RoundedFirst BelowLimit Behind Endless }

impl Spoil for Nothing {}

/// Error bounds of a scene that is so many times smaller; with 0, none.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part<const OF: u16>;

impl<const OF: u16> Spoil for Part<OF> {
    fn prepare(ray: &Ray, region: &Region) -> Exact {
        let part = if OF == 0 { 0.0 } else { 1.0 / f64::from(OF) };
        let [reach, size] = [region.reach(), region.size()].map(|length| (length * part) as f32);
        Exact::new(ray, &Region::of(&Aabb { lo: Vec3::splat(reach - size), hi: Vec3::splat(reach) }))
    }
}

impl Spoil for FirstStage {
    fn distance(test: &Spoilt<Self>, triangle: &Triangle, limit: f32) -> Option<f32> {
        test.by::<Moller32>(triangle).and_then(|_| test.exact.distance(triangle, limit))
    }
}

impl Spoil for Open {
    fn distance(test: &Spoilt<Self>, triangle: &Triangle, limit: f32) -> Option<f32> {
        let is_within = |[u, v]: [f32; 2]| u > 0.0 && v > 0.0 && u + v < 1.0;
        test.exact.distance(triangle, limit).filter(|_| is_within(test.exact.weights(triangle)))
    }
}

impl Spoil for Twice {
    fn distance(test: &Spoilt<Self>, triangle: &Triangle, limit: f32) -> Option<f32> {
        test.exact.distance(triangle, limit).map(|t| test.by::<Moller64>(triangle).unwrap_or(t))
    }
}

impl Spoil for Single {
    fn distance(test: &Spoilt<Self>, triangle: &Triangle, limit: f32) -> Option<f32> {
        test.exact.distance(triangle, limit).map(|t| test.by::<Moller32>(triangle).unwrap_or(t))
    }
}

impl Spoil for Exchanged {
    fn weights(test: &Spoilt<Self>, triangle: &Triangle) -> [f32; 2] {
        let [u, v] = test.exact.weights(triangle);
        [v, u]
    }
}

impl Spoil for FromFirst {
    fn weights(test: &Spoilt<Self>, &Triangle([v0, v1, v2]): &Triangle) -> [f32; 2] {
        test.exact.weights(&Triangle([v2, v0, v1]))
    }
}

impl Spoil for Culled {
    fn distance(test: &Spoilt<Self>, triangle: &Triangle, limit: f32) -> Option<f32> {
        test.exact.distance(triangle, limit).filter(|_| test.determinant(triangle) < 0.0)
    }
}

impl Spoil for EdgeOn {
    fn distance(test: &Spoilt<Self>, triangle: &Triangle, limit: f32) -> Option<f32> {
        let is_edge_on = test.determinant(triangle) == 0.0;
        test.exact.distance(triangle, limit).or_else(|| is_edge_on.then_some(test.ray.tmin()))
    }
}

impl Spoil for OpenInterval {
    fn distance(test: &Spoilt<Self>, triangle: &Triangle, limit: f32) -> Option<f32> {
        test.exact.distance(triangle, limit).filter(|&t| test.ray.tmin() < t && t < test.ray.tmax())
    }
}

impl Spoil for RoundedFirst {
    fn distance(test: &Spoilt<Self>, triangle: &Triangle, _: f32) -> Option<f32> {
        let interval @ [tmin, tmax] = [test.ray.tmin(), test.ray.tmax()];
        let wider = [tmin.next_down().max(0.0), tmax.next_up()];
        test.over(wider, triangle).filter(|&t| interval[0] <= t && t <= interval[1])
    }
}

impl Spoil for BelowLimit {
    fn distance(test: &Spoilt<Self>, triangle: &Triangle, limit: f32) -> Option<f32> {
        test.exact.distance(triangle, limit).filter(|&t| t < limit)
    }
}

impl Spoil for Behind {
    fn distance(test: &Spoilt<Self>, triangle: &Triangle, limit: f32) -> Option<f32> {
        let behind = || {
            let ray = Ray::within(test.ray.origin(), -test.ray.direction(), test.ray.tmin(), test.ray.tmax()).ok()?;
            Exact::new(&ray, &Region::of(&triangle.aabb())).distance(triangle, limit)
        };
        test.exact.distance(triangle, limit).or_else(behind)
    }
}

impl Spoil for Endless {
    fn blocks(test: &Spoilt<Self>, triangle: &Triangle) -> bool {
        test.over([test.ray.tmin(), f32::INFINITY], triangle).is_some()
    }
}
