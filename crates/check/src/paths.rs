//! The property body of paths: rays that begin at the hits of other rays.

use std::array;

use dashu_int::{IBig, UBig};
use glam::Vec3;

use stackless_bvh::geom::{Ends, ExactPoint, ExactRay, Mesh};
use stackless_bvh::internals::geom::truth::{RBig, round_f32};
use stackless_bvh::trace::{InstanceHit, InstanceTracer};

use crate::instance_oracle::meet;

/// One leg of a path, from the current point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// The direction or the target.
    pub heading: Heading,
    /// Whether the ends of the ray belong to it.
    pub ends: Ends,
}

/// A direction or a point, in floats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Heading {
    /// Along a direction, up to this distance.
    Along(Vec3, f32),
    /// To a point.
    Toward(Vec3),
}

/// An implementation of path continuation.
pub trait Path {
    /// Builds the ray of the next leg; `None` if there is none.
    fn ray(&self, from: &ExactPoint, leg: &Leg) -> Option<ExactRay>;

    /// Returns the closest hit and its point. `left` is the triangle where the ray begins.
    fn closest(&self, tracer: &InstanceTracer, ray: &ExactRay, left: Option<u32>) -> Option<(InstanceHit, ExactPoint)>;
}

/// The library's implementation.
#[derive(Clone, Copy, Debug)]
pub struct Exactly;

impl Path for Exactly {
    fn ray(&self, from: &ExactPoint, leg: &Leg) -> Option<ExactRay> {
        match leg.heading {
            Heading::Along(direction, tmax) => from.ray(direction, tmax, leg.ends).ok(),
            Heading::Toward(target) => from.toward(&ExactPoint::new(target).ok()?, leg.ends).ok(),
        }
    }

    fn closest(&self, tracer: &InstanceTracer, ray: &ExactRay, _: Option<u32>) -> Option<(InstanceHit, ExactPoint)> {
        tracer.closest_and_point(ray)
    }
}

/// A hit of a path that differs from rational arithmetic.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("leg {leg} hits {found:?}, expected {expected:?} (triangle, and bits of distance and weights)")]
pub struct PathFault {
    /// Number of the leg.
    pub leg: usize,
    /// The right triangle, with its distance and weights as bits.
    pub expected: Option<(u32, [u32; 3])>,
    /// The answer found.
    pub found: Option<(u32, [u32; 3])>,
}

/// Follows a path through a mesh from a point, until a leg misses. `tracer` must be of this mesh. Checks that each hit
/// equals that of rational arithmetic in every bit. `[SECOND-1]` `[SECOND-2]`
///
/// Returns the number of legs that hit.
///
/// # Errors
/// The first leg that differs.
pub fn check_path(
    path: &impl Path,
    tracer: &InstanceTracer,
    mesh: &Mesh,
    origin: Vec3,
    legs: &[Leg],
) -> Result<usize, PathFault> {
    let Ok(mut from) = ExactPoint::new(origin) else { return Ok(0) };
    let (mut place, mut left) = (rational(origin), None);
    for (i, leg) in legs.iter().enumerate() {
        let direction = match leg.heading {
            Heading::Along(direction, _) => rational(direction),
            Heading::Toward(target) => {
                let target = rational(target);
                array::from_fn(|k| &target[k] - &place[k])
            }
        };
        let Some(ray) = path.ray(&from, leg) else { return Ok(i) };
        let (expected, found) = (closest(mesh, &place, &direction, leg), path.closest(tracer, &ray, left));
        let bits = |prim: u32, numbers: [f32; 3]| (prim, numbers.map(f32::to_bits));
        let right = expected.as_ref().map(|(prim, [t, u, v])| bits(*prim, [t, u, v].map(round_f32)));
        let given = found.as_ref().map(|(hit, _)| bits(hit.prim, [hit.t, hit.u, hit.v]));
        if right != given {
            return Err(PathFault { leg: i, expected: right, found: given });
        }
        let (Some((prim, [t, ..])), Some((_, point))) = (expected, found) else { return Ok(i) };
        place = array::from_fn(|k| &place[k] + &t * &direction[k]);
        (from, left) = (point, Some(prim));
    }
    Ok(legs.len())
}

/// Returns the first hit by exact distance and triangle, with distance and weights.
fn closest(mesh: &Mesh, origin: &[RBig; 3], direction: &[RBig; 3], leg: &Leg) -> Option<(u32, [RBig; 3])> {
    let end = match leg.heading {
        Heading::Along(_, tmax) => RBig::try_from(tmax).ok(),
        Heading::Toward(_) => Some(RBig::ONE),
    };
    let is_within = |t: &RBig| match leg.ends {
        Ends::Open => *t > RBig::ZERO && end.as_ref().is_none_or(|end| t < end),
        Ends::Closed => *t >= RBig::ZERO && end.as_ref().is_none_or(|end| t <= end),
    };
    // A common factor makes all coordinates integers; distance and weights do not change.
    let over = origin.iter().chain(direction).fold(UBig::ONE << 149, |over, x| over * x.denominator());
    let integer = |x: &RBig| x.numerator() * IBig::from(&over / x.denominator());
    let [o, d] = [origin, direction].map(|v| v.each_ref().map(integer));
    let hits = (0..mesh.triangles().len()).filter_map(|prim| {
        let corners = mesh.triangle(prim).map(|corner| rational(corner).each_ref().map(integer));
        let hit = meet(&corners, &o, &d).filter(|[t, ..]| is_within(t))?;
        Some((prim as u32, hit))
    });
    hits.min_by(|(a, [s, ..]), (b, [t, ..])| (s, a).cmp(&(t, b)))
}

fn rational(v: Vec3) -> [RBig; 3] {
    // All coordinates are finite.
    v.to_array().map(|x| RBig::try_from(x).unwrap_or_default())
}
