//! The k nearest triangles.

use std::collections::BTreeMap;

use glam::Vec3;

use super::{Around, Limit, Near};
use crate::bvh::Bvh;
use crate::geom::{Ball, Real, Triangle, Vector};
use crate::trace::leaf_primitives::NearTriangles;
use crate::trace::query::binary_query;
use crate::tree::Node;

/// A search for the `k` nearest triangles of a mesh within a radius, exact: the first `k` in the order of
/// [`NearestPoint`](super::NearestPoint), each once. `[NEAR-2]`
///
/// The radius shrinks to the distance of the `k`-th triangle so far. Memory is proportional to the number of found
/// triangles, and each costs time logarithmic in `k`.
#[derive(Clone, Debug)]
pub struct NearestPoints<'a, H = Bvh, V: Vector = Vec3> {
    pub(in crate::trace) around: Around<'a, H, V>,
    k: usize,
    /// Places in the hierarchy, by distance and index. Bits of distances as doubles, which are not negative, have their
    /// order. A triangle in several leaves has one distance, and so one entry.
    found: BTreeMap<(u64, u32), usize>,
}

impl<'a, V: Vector, H: NearTriangles<V>> NearestPoints<'a, H, V> {
    /// Prepares a search. `k` may be any number.
    pub fn new(bvh: &'a H, ball: &Ball<V>, k: usize) -> Self {
        let mut around = Around::new(bvh, ball);
        if k == 0 {
            // No triangle is this near.
            around.limit.distance = V::Real::rounded(f64::NEG_INFINITY);
        }
        Self { around, k, found: BTreeMap::new() }
    }

    /// Returns the nearest triangles, in order, after the traversal.
    pub fn nears(&self) -> impl ExactSizeIterator<Item = Near<V>> {
        self.found.iter().map(|(&(distance, prim), &place)| self.around.near(prim, from_rank(distance), place))
    }

    pub(in crate::trace) fn meet(&mut self, leaf: Node) {
        let Self { around, k, found } = self;
        around.meet(leaf, |Limit { distance, prim }, place| {
            found.insert((rank(distance), prim), place);
            if found.len() > *k {
                found.pop_last();
            }
            let (&(last, prim), _) = found.last_key_value().filter(|_| found.len() == *k)?;
            Some(Limit { distance: from_rank(last), prim })
        });
    }
}

/// Returns the bits of a distance as a double.
fn rank(distance: impl Real) -> u64 {
    let distance: f64 = distance.into();
    distance.abs().to_bits()
}

fn from_rank<R: Real>(rank: u64) -> R {
    R::rounded(f64::from_bits(rank))
}

binary_query!([V: Vector] NearestPoints<'_, Bvh<Triangle<V>>, V>, around.descend);
