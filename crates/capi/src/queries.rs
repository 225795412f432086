//! Queries of single rays, and of arrays of rays and points.

use std::ops::Range;
use std::sync::Arc;

use rayon::ThreadPool;
use stackless_bvh::bvh::WideBvh;
use stackless_bvh::geom::{Ball, Precision, Ray as CheckedRay, RayError, Real as _, check_environment};
use stackless_bvh::trace::{
    Filterable as _, Hit as Found, Location, MeshQueries as _, Near as FoundNear, RayQueries as _, Rule, Solid, Tracer,
};

use crate::error::Fault;
use crate::filters::SceneFilters;
use crate::memory::{In, Out};
use crate::scene::{Scene, shared};
use crate::types::{
    Hit, Near, Ray, STACKLESS_INSIDE, STACKLESS_NO_FACE, STACKLESS_OUTSIDE, STACKLESS_PARALLEL, STACKLESS_RULE_NONZERO,
    STACKLESS_RULE_PARITY, STACKLESS_RULE_WINDING, STACKLESS_SERIAL, STACKLESS_SURFACE,
};

/// Numbers of a precision.
pub(crate) type Real<V> = <V as stackless_bvh::geom::Vector>::Real;

/// Rays of the caller.
pub(crate) type Rays<'a, V> = In<'a, Ray<Real<V>>>;

impl<V: Precision> Scene<V> {
    #[inline(always)]
    pub(crate) fn closest1(
        &self,
        rays: &Rays<'_, V>,
        filters: &SceneFilters<'_, Real<V>>,
        index: usize,
    ) -> Result<Hit<Real<V>>, Fault> {
        let ray = checked::<V>(rays, index)?;
        // Converted in each branch: one place for both would copy the answer.
        Ok(match filters.get(index, rays)? {
            None => hit::<V>(self.tracer().closest(&ray)),
            Some(filter) => hit::<V>(filter.ask(self.masks(), |filter| self.tracer().filtered(filter).closest(&ray))),
        })
    }

    #[inline(always)]
    pub(crate) fn any1(
        &self,
        rays: &Rays<'_, V>,
        filters: &SceneFilters<'_, Real<V>>,
        index: usize,
    ) -> Result<bool, Fault> {
        let ray = checked::<V>(rays, index)?;
        Ok(match filters.get(index, rays)? {
            None => self.tracer().any(&ray),
            Some(filter) => filter.ask(self.masks(), |filter| self.tracer().filtered(filter).any(&ray)),
        })
    }

    pub(crate) fn all1(
        &self,
        ray: &Rays<'_, V>,
        filters: &SceneFilters<'_, Real<V>>,
    ) -> Result<Vec<Hit<Real<V>>>, Fault> {
        let (checked, filter) = (checked::<V>(ray, 0)?, filters.get(0, ray)?);
        let hits = match filter {
            None => self.tracer().all(&checked),
            Some(filter) => filter.ask(self.masks(), |filter| self.tracer().filtered(filter).all(&checked)),
        };
        Ok(hits.into_iter().map(|found| hit::<V>(Some(found))).collect())
    }

    pub(crate) fn next1(&self, ray: &Rays<'_, V>, after: Hit<Real<V>>) -> Result<Hit<Real<V>>, Fault> {
        let (t, faces): (f64, _) = (after.t.into(), self.mesh().triangles().len());
        if t.is_nan() || after.face as usize >= faces {
            let found = format!("t {t}, face {}", after.face);
            return Err(Fault::argument(format!("after: {found}, expected a hit of one of {faces} faces")));
        }
        Ok(hit::<V>(self.tracer().next(&checked::<V>(ray, 0)?, (after.t, after.face))))
    }

    /// Rays without filters are traced interleaved, which is faster.
    pub(crate) fn closest_n(
        &self,
        rays: &Rays<'_, V>,
        filters: &SceneFilters<'_, Real<V>>,
        hits: Out<'_, Hit<Real<V>>>,
        flags: u32,
    ) -> Result<(), Fault> {
        self.batch(hits, flags, |range| {
            if !filters.is_none() {
                return range.map(|index| self.closest1(rays, filters, index)).collect();
            }
            let hits = self.tracer().closest_each(&all_checked::<V>(rays, range)?);
            Ok(hits.into_iter().map(hit::<V>).collect())
        })
    }

    pub(crate) fn any_n(
        &self,
        rays: &Rays<'_, V>,
        filters: &SceneFilters<'_, Real<V>>,
        hits: Out<'_, bool>,
        flags: u32,
    ) -> Result<(), Fault> {
        self.batch(hits, flags, |range| {
            if !filters.is_none() {
                return range.map(|index| self.any1(rays, filters, index)).collect();
            }
            Ok(self.tracer().any_each(&all_checked::<V>(rays, range)?))
        })
    }

    pub(crate) fn crossings_n(&self, rays: &Rays<'_, V>, counts: Out<'_, u32>, flags: u32) -> Result<(), Fault> {
        self.batch(counts, flags, |range| Ok(self.tracer().crossings_each(&all_checked::<V>(rays, range)?)))
    }

    pub(crate) fn locate_n(
        &self,
        points: &In<'_, [Real<V>; 3]>,
        rule: u32,
        locations: Out<'_, u8>,
        flags: u32,
    ) -> Result<(), Fault> {
        self.of_solid(points, rule, locations, flags, |solid, point| {
            Ok(match solid.locate(point)? {
                Location::Inside => STACKLESS_INSIDE,
                Location::Outside => STACKLESS_OUTSIDE,
                Location::Surface => STACKLESS_SURFACE,
            })
        })
    }

    pub(crate) fn signed_distances_n(
        &self,
        points: &In<'_, [Real<V>; 3]>,
        rule: u32,
        distances: Out<'_, Real<V>>,
        flags: u32,
    ) -> Result<(), Fault> {
        self.of_solid(points, rule, distances, flags, Solid::signed_distance)
    }

    /// Runs point queries against the solid that the mesh bounds.
    fn of_solid<'s, A: Copy + Send>(
        &'s self,
        points: &In<'_, [Real<V>; 3]>,
        rule: u32,
        answers: Out<'_, A>,
        flags: u32,
        ask: impl Fn(&Solid<'s, Tracer<Arc<WideBvh<8, V>>, V>, V>, V) -> Result<A, RayError> + Sync,
    ) -> Result<(), Fault> {
        let rule = match rule {
            STACKLESS_RULE_PARITY => Rule::Parity,
            STACKLESS_RULE_NONZERO => Rule::Nonzero,
            STACKLESS_RULE_WINDING => Rule::Winding,
            _ => return Err(Fault::argument(format!("rule: {rule}, expected a STACKLESS_RULE constant, 0 to 2"))),
        };
        check_environment()?;
        let solid = Solid::new(self.tracer(), self.mesh(), self.boundary(), rule)?;
        self.batch(answers, flags, |range| {
            let answer = |index| {
                let answer = ask(&solid, V::from_components(points.get(index)));
                answer.map_err(|error| Fault::of_point(error, points.element(index)))
            };
            range.map(answer).collect()
        })
    }

    pub(crate) fn nearest_n(
        &self,
        points: &In<'_, [Real<V>; 3]>,
        radius: Real<V>,
        nears: Out<'_, Near<Real<V>>>,
        flags: u32,
    ) -> Result<(), Fault> {
        self.batch(nears, flags, |range| {
            let ball = |index| {
                let ball = Ball::new(V::from_components(points.get(index)), radius);
                ball.map_err(|error| Fault::of_ball(error, points.element(index)))
            };
            let balls = range.map(ball).collect::<Result<Vec<_>, _>>()?;
            Ok(self.tracer().nearest_each(&balls).into_iter().map(near::<V>).collect())
        })
    }

    /// Finds the `k` nearest faces.
    pub(crate) fn nearest_k1(
        &self,
        point: &In<'_, [Real<V>; 3]>,
        radius: Real<V>,
        k: usize,
    ) -> Result<Vec<Near<Real<V>>>, Fault> {
        let ball = Ball::new(V::from_components(point.get(0)), radius);
        let ball = ball.map_err(|error| Fault::of_ball(error, point.element(0)))?;
        let k = k.min(self.mesh().triangles().len());
        Ok(self.tracer().nearest_k(&ball, k).into_iter().map(|found| near::<V>(Some(found))).collect())
    }

    /// Writes the results of `answer` for ranges of indices.
    fn batch<A: Copy + Send>(
        &self,
        answers: Out<'_, A>,
        flags: u32,
        answer: impl Fn(Range<usize>) -> Result<Vec<A>, Fault> + Sync,
    ) -> Result<(), Fault> {
        batch(self.pool(), answers, flags, answer)
    }
}

/// Writes the results of `answer` for ranges of indices, on this thread or on these threads.
pub(crate) fn batch<A: Copy + Send>(
    pool: Option<&ThreadPool>,
    mut answers: Out<'_, A>,
    flags: u32,
    answer: impl Fn(Range<usize>) -> Result<Vec<A>, Fault> + Sync,
) -> Result<(), Fault> {
    if is_parallel(flags)? { shared(pool, || answers.answer(true, &answer)) } else { answers.answer(false, answer) }
}

pub(crate) fn is_parallel(flags: u32) -> Result<bool, Fault> {
    match flags {
        STACKLESS_SERIAL => Ok(false),
        STACKLESS_PARALLEL => Ok(true),
        _ => Err(Fault::argument(format!("flags: {flags}, expected STACKLESS_SERIAL or STACKLESS_PARALLEL"))),
    }
}

fn all_checked<V: Precision>(rays: &Rays<'_, V>, range: Range<usize>) -> Result<Vec<CheckedRay<V>>, Fault> {
    let first = range.start;
    let ray = |index| {
        let Ray { origin, tmin, direction, tmax } = rays.get(index);
        (V::from_components(origin), V::from_components(direction), tmin, tmax)
    };
    CheckedRay::collect(range.map(ray)).map_err(|(i, error)| Fault::of_ray(error, rays.element(first + i)))
}

#[inline(always)]
pub(crate) fn checked<V: Precision>(rays: &Rays<'_, V>, index: usize) -> Result<CheckedRay<V>, Fault> {
    let Ray { origin, tmin, direction, tmax } = rays.get(index);
    let ray = CheckedRay::within(V::from_components(origin), V::from_components(direction), tmin, tmax);
    ray.map_err(|error| Fault::of_ray(error, rays.element(index)))
}

#[inline(always)]
pub(crate) fn hit<V: Precision>(found: Option<Found<Real<V>>>) -> Hit<Real<V>> {
    let nan = V::Real::rounded(f64::NAN);
    let miss = Hit { t: V::Real::INFINITY, u: nan, v: nan, face: STACKLESS_NO_FACE };
    // By reference: a copy of the whole would wait for stores of its parts.
    found.as_ref().map_or(miss, |&Found { prim, t, u, v }| Hit { t, u, v, face: prim })
}

fn near<V: Precision>(found: Option<FoundNear<V>>) -> Near<Real<V>> {
    let point = [V::Real::rounded(f64::NAN); 3];
    let none = Near { point, distance: V::Real::INFINITY, face: STACKLESS_NO_FACE };
    found.map_or(none, |FoundNear { point, distance, prim, .. }| Near {
        point: point.components(),
        distance,
        face: prim,
    })
}
