//! The least triangle below each inner node, for queries that many triangles answer equally well. `[NEAR-6]`

use std::sync::OnceLock;

use super::wide::leaf_places;
use super::{Bvh, WideBvh};
use crate::tree::Node;

/// By the index of the node. It is made when it is first asked for: few queries do.
#[derive(Clone, Debug, Default)]
pub(super) struct Least(OnceLock<Box<[u32]>>);

impl Least {
    /// Of node `i` of so many, which stand before their children, given the leasts of its children: each the index of
    /// an inner node, or the least of a leaf.
    fn of<I>(&self, i: usize, count: usize, children: impl Fn(usize) -> I) -> u32
    where
        I: IntoIterator<Item = Result<usize, u32>>,
    {
        let table = self.0.get_or_init(|| {
            // What is not known yet is taken for 0, which leaves nothing out.
            let mut least = vec![0; count];
            for i in (0..count).rev() {
                let below = children(i).into_iter().map(|child| child.map_or_else(|leaf| leaf, |inner| least[inner]));
                least[i] = below.min().unwrap_or(u32::MAX);
            }
            least.into()
        });
        table[i]
    }
}

impl<S> Bvh<S> {
    /// The least index of the triangles below an inner node.
    pub(crate) fn least_below(&self, node: Node) -> u32 {
        let of_leaf = |leaf| self.leaf_triangles(leaf).iter().map(|held| held.prim).min().unwrap_or(u32::MAX);
        self.least.of(node.index(), self.nodes().len(), |i| {
            self.node(i).children.map(|child| if child.is_leaf() { Err(of_leaf(child)) } else { Ok(child.index()) })
        })
    }
}

impl<const A: usize> WideBvh<A> {
    /// The least index of the triangles below an inner node.
    pub(crate) fn least_below(&self, node: Node) -> u32 {
        let prim = |place: usize| self.blocks()[place / 4].prims[place & 3];
        let of_leaf = |leaf| leaf_places(leaf).map(prim).min().unwrap_or(u32::MAX);
        self.least.of(node.index(), self.nodes().len(), |i| {
            let node = &self.nodes()[i];
            (0..A as u32)
                .filter(|&slot| node.has_child(slot))
                .map(|slot| node.child(slot))
                .map(|child| if child.is_leaf() { Err(of_leaf(child)) } else { Ok(child.index()) })
        })
    }
}
