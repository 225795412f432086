//! The property bodies of triangle tests, box tests and distances: each compares with rational arithmetic.

use glam::Vec3;

use stackless_bvh::geom::{Aabb, Kernel, Ray, Real, Region, Triangle, Vector};
use stackless_bvh::internals::geom::truth;
use stackless_bvh::internals::geom::truth::{Meeting, Number, RBig};
use stackless_bvh::internals::geom::{Measure, Slabs};

/// A geometric test whose answer differs from rational arithmetic.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{what}: {found:?}, expected {expected:?}")]
pub struct GeometryFault {
    /// The property that was tested.
    pub what: &'static str,
    /// The right answer; `None` for a miss.
    pub expected: Option<f64>,
    /// The answer found.
    pub found: Option<f64>,
}

/// Checks all properties of a triangle test with one triangle: distance, occlusion, weights, and that an interval
/// ending at the distance itself still includes the hit. The scene is the triangle alone, and then a much larger one.
/// `[EXACT-1]`
///
/// Returns whether the triangle is hit.
///
/// # Errors
/// The first answer that differs from the correctly rounded result, in any bit.
pub fn check_triangle<K, V>(triangle: &Triangle<V>, ray: &Ray<V>) -> Result<bool, GeometryFault>
where
    K: Kernel<Vector = V, Shape = Triangle<V>>,
    V: Vector,
{
    let corners = triangle.0.map(Vector::components);
    let meeting = truth::meet(corners, ray.origin().components(), ray.direction().components());
    let point = meeting.within([ray.tmin(), ray.tmax()]);
    let t = point.as_ref().map(|point| V::Real::nearest(&point.t));
    let aabb = triangle.aabb();
    let scene = aabb.union(Aabb { lo: Vec3::splat(-1e30), hi: Vec3::splat(1e30) });
    for region in [aabb, scene] {
        let kernel = K::new(ray, &Region::of(&region));
        same("distance", t, kernel.distance(triangle, Real::INFINITY))?;
        same("whether it blocks", t.map(|_| 1.0), kernel.blocks(triangle).then_some(1.0))?;
        if let (Some(t), Some(point)) = (t, &point) {
            same("distance within itself", Some(t), kernel.distance(triangle, t))?;
            let nearer = kernel.distance(triangle, t.next_down());
            same("distance within less", nearer.map(|_| t), nearer)?;
            let [u, v] = kernel.weights(triangle);
            same("second weight", Some(Number::nearest(&point.u)), Some(u))?;
            same("third weight", Some(Number::nearest(&point.v)), Some(v))?;
        }
    }
    Ok(t.is_some())
}

/// Checks whether a triangle is reported as degenerate exactly when no line along an axis crosses it.
///
/// # Errors
/// A wrong answer.
pub fn check_degenerate<V: Vector>(triangle: &Triangle<V>) -> Result<(), GeometryFault> {
    let corners = triangle.0.map(|corner| corner.widen().to_array());
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let is_flat = axes.iter().all(|&axis| truth::meet(corners, corners[0], axis) == Meeting::Coplanar);
    let as_number = |is: bool| Some(f64::from(u8::from(is)));
    same("whether it is degenerate", as_number(is_flat), as_number(triangle.is_degenerate()))
}

/// Tests a box and a larger box around it, one by one and as a pair. Checks that the answers are equal, and that the
/// outer box is entered no later than the inner one. `[BOX-3]`
///
/// If the test `promises` to skip no touched box, also checks that no box is entered later than in exact arithmetic,
/// even if the ray ends there. `[BOX-2]` `[BOX-6]`
///
/// Returns whether the inner box is touched.
///
/// # Errors
/// The first violated property.
pub fn check_slabs<B: Slabs>(
    ray: &Ray<B::Vector>,
    inner: &Aabb,
    other: &Aabb,
    promises: bool,
) -> Result<bool, GeometryFault> {
    let boxes = [*inner, inner.union(*other)];
    let slabs = B::new(ray, &Region::of(&boxes[1]));
    let planes = [0, 1, 2].map(|k| [boxes[0].lo[k], boxes[0].hi[k], boxes[1].lo[k], boxes[1].hi[k]]);
    let pair = slabs.pair(&planes, ray.tmax());
    let nears = [0, 1].map(|i| pair.hit[i].then_some(pair.near[i]));
    let mut is_touched = false;
    for (i, aabb) in boxes.iter().enumerate() {
        let one = slabs.one(aabb, ray.tmax());
        same("one box of a pair", one, nears[i])?;
        let (o, d) = (ray.origin().widen().to_array(), ray.direction().widen().to_array());
        let (lo, hi) = (aabb.lo.widen().to_array(), aabb.hi.widen().to_array());
        let entry = truth::entry(o, d, [ray.tmin().into(), ray.tmax().into()], lo, hi);
        is_touched |= i == 0 && entry.is_some();
        if let Some(entry) = entry.filter(|_| promises) {
            let t = <B::Vector as Vector>::Real::nearest(&entry);
            if !one.is_some_and(|near| near <= t) {
                return fault("a box that is touched", Some(t), one);
            }
            if slabs.one(aabb, t).is_none() {
                return fault("a box that is touched where the ray ends", Some(t), None);
            }
        }
    }
    match nears {
        [Some(near), outer] if !outer.is_some_and(|outer| outer <= near) && !is_behind(ray, inner) => {
            fault("the outer box", Some(near), outer)
        }
        _ => Ok(is_touched),
    }
}

/// Returns whether a box lies wholly behind the origin on an axis. Such a box is not touched, and nothing is promised
/// about it.
fn is_behind<V: Vector>(ray: &Ray<V>, aabb: &Aabb) -> bool {
    let [o, d] = [ray.origin(), ray.direction()].map(|v| v.widen().to_array());
    let (lo, hi) = (aabb.lo.widen().to_array(), aabb.hi.widen().to_array());
    (0..3).any(|k| d[k] > 0.0 && hi[k] < o[k] || d[k] < 0.0 && lo[k] > o[k])
}

/// Checks the distance of a triangle from a point: without a limit, with the distance itself as the limit and as the
/// radius, and with limits around it. Also checks the nearest point. `[NEAR-1]` `[NEAR-3]`
///
/// # Errors
/// The first answer that differs from the correctly rounded one.
pub fn check_distance<V: Vector>(triangle: &Triangle<V>, point: V) -> Result<(), GeometryFault> {
    let Some(square) = truth::square_distance(triangle.0.map(V::components), point.components()) else { return Ok(()) };
    let (distance, infinity) = (truth::round_root::<V::Real>(&square), V::Real::INFINITY);
    let ask = |what, radius: V::Real, limit: V::Real, expected: Option<V::Real>| {
        same(what, expected, Measure::new(point, radius).distance(triangle, limit))
    };
    ask("distance", infinity, infinity, Some(distance))?;
    ask("distance within itself", infinity, distance, Some(distance))?;
    // The radius is compared with the unrounded distance.
    if let Ok(radius) = RBig::try_from(distance.into()) {
        let is_within = square <= &radius * &radius;
        ask("distance within its radius", distance, distance, is_within.then_some(distance))?;
        ask("distance within more", distance.next_up(), infinity, Some(distance))?;
    }
    if distance > V::Real::default() {
        ask("distance within less", distance.next_down(), infinity, None)?;
    }
    check_point(triangle, point, Measure::new(point, infinity).nearest(triangle))
}

/// Checks that `found` is the point of the triangle nearest to `point`, with each coordinate rounded once. `[NEAR-3]`
pub(crate) fn check_point<V: Vector>(triangle: &Triangle<V>, point: V, found: V) -> Result<(), GeometryFault> {
    let truth = truth::nearest_point(triangle.0.map(V::components), point.components());
    for (expected, found) in truth.iter().flatten().zip(found.components()) {
        // Zeros become positive.
        let expected = V::Real::nearest(expected).into() + 0.0;
        same("coordinate of the nearest point", Some(expected), Some(found.into()))?;
    }
    Ok(())
}

fn same<R: Into<f64>>(what: &'static str, expected: Option<R>, found: Option<R>) -> Result<(), GeometryFault> {
    let (expected, found) = (expected.map(Into::into), found.map(Into::into));
    let is_same = expected.map(f64::to_bits) == found.map(f64::to_bits);
    if is_same { Ok(()) } else { Err(GeometryFault { what, expected, found }) }
}

fn fault<T, R: Into<f64>>(what: &'static str, expected: Option<R>, found: Option<R>) -> Result<T, GeometryFault> {
    Err(GeometryFault { what, expected: expected.map(Into::into), found: found.map(Into::into) })
}
