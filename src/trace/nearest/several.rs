//! The nearest several triangles.

use std::collections::BTreeMap;

use super::{Around, Near};
use crate::bvh::Bvh;
use crate::geom::{Aabb, Ball, Triangle};
use crate::order::{Descent, Flow, Pruned, Visitor};
use crate::trace::BoxQuery;
use crate::trace::held::Held;
use crate::tree::{Node, Topology};

/// A search for the `k` nearest triangles of a mesh within a radius, exact: the first `k` in the order of
/// [`NearestPoint`](super::NearestPoint), each once. `[NEAR-2]`
///
/// The radius shrinks to the distance of the `k`-th triangle so far. Memory is for as many triangles as are found, and
/// each costs the logarithm of `k`.
#[derive(Clone, Debug)]
pub struct NearestPoints<'a, H = Bvh> {
    pub(in crate::trace) around: Around<'a, H>,
    k: usize,
    /// By distance and index, where they are in the hierarchy. The bits of distances, which are not negative, have
    /// their order. A triangle that several leaves refer to has one distance, and so one entry.
    found: BTreeMap<(u32, u32), usize>,
}

impl<'a, H: Held<Triangle>> NearestPoints<'a, H> {
    /// Prepares a search. `k` may be any number.
    pub fn new(bvh: &'a H, ball: &Ball, k: usize) -> Self {
        let mut around = Around::new(bvh, ball);
        if k == 0 {
            // Nothing is so near.
            around.limit = f32::NEG_INFINITY;
        }
        Self { around, k, found: BTreeMap::new() }
    }

    /// What is nearest, in order, after the traversal.
    pub fn nears(&self) -> impl ExactSizeIterator<Item = Near> {
        self.found.iter().map(|(&(distance, prim), &place)| self.around.near(prim, f32::from_bits(distance), place))
    }

    pub(in crate::trace) fn meet(&mut self, leaf: Node) {
        let Self { around, k, found } = self;
        around.meet(leaf, |limit, (distance, prim, place)| {
            found.insert((distance.abs().to_bits(), prim), place);
            if found.len() > *k {
                found.pop_last();
            }
            match found.last_key_value() {
                Some((&(last, _), _)) if found.len() == *k => f32::from_bits(last),
                _ => limit,
            }
        });
    }
}

impl Visitor for NearestPoints<'_> {
    fn inner(&mut self, node: Node) -> Descent {
        self.around.descend(node)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        self.meet(node);
        Flow::Continue
    }
}

impl Pruned for NearestPoints<'_> {}

impl BoxQuery for NearestPoints<'_> {
    fn touches(&self, aabb: &Aabb) -> bool {
        self.around.touches(aabb)
    }

    fn slot(&self, node: Node) -> usize {
        self.around.bvh.slot(node)
    }
}
