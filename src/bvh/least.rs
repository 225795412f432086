//! The least triangle index below each node, for queries with many equally good answers. `[NEAR-6]`

use std::sync::OnceLock;

use super::Bvh;
use crate::tree::Node;

/// The indices for inner nodes, computed at first use: few queries need them.
#[derive(Clone, Debug, Default)]
pub(super) struct Least(OnceLock<Box<[u32]>>);

impl Least {
    /// Returns the index for a node. There are `count` inner nodes, which come before their children. `prims` returns
    /// the indices in a leaf.
    pub(super) fn below<C, P>(
        &self,
        node: Node,
        count: usize,
        children: impl Fn(usize) -> C,
        prims: impl Fn(Node) -> P,
    ) -> u32
    where
        C: IntoIterator<Item = Node>,
        P: Iterator<Item = u32>,
    {
        let of_leaf = |leaf| prims(leaf).min().unwrap_or(u32::MAX);
        if node.is_leaf() {
            return of_leaf(node);
        }
        let table = self.0.get_or_init(|| {
            // Unknown indices count as 0, which skips nothing.
            let mut least = vec![0; count];
            for i in (0..count).rev() {
                let of = |child: Node| if child.is_leaf() { of_leaf(child) } else { least[child.index()] };
                least[i] = children(i).into_iter().map(of).min().unwrap_or(u32::MAX);
            }
            least.into()
        });
        table[node.index()]
    }
}

impl<S> Bvh<S> {
    /// Returns the least index of the triangles of a leaf, or below an inner node.
    pub(crate) fn least_below(&self, node: Node) -> u32 {
        let prims = |leaf| self.leaf_triangles(leaf).iter().map(|held| held.prim);
        self.least.below(node, self.nodes().len(), |i| self.node(i).children, prims)
    }
}
