//! A tree whose subtrees can be moved.

use super::super::draft::Draft;
use crate::geom::Aabb;

/// The nodes of a draft, by the same indices. Node 0 stays the root.
pub(super) struct Tree {
    nodes: Vec<TreeNode>,
}

#[derive(Clone)]
pub(super) struct TreeNode {
    pub(super) aabb: Aabb,
    parent: u32,
    children: [u32; 2],
    /// Edges to the deepest leaf.
    height: u32,
}

/// In place of a parent or a child that there is not.
const NONE: u32 = u32::MAX;

impl TreeNode {
    /// `None` for a leaf.
    pub(super) fn children(&self) -> Option<[usize; 2]> {
        (self.children[0] != NONE).then(|| self.children.map(|child| child as usize))
    }
}

impl Tree {
    pub(super) fn of(draft: &Draft) -> Self {
        let node = |aabb| TreeNode { aabb, parent: NONE, children: [NONE; 2], height: 0 };
        let mut tree = Self { nodes: draft.nodes.iter().map(|draft| node(draft.aabb)).collect() };
        let mut order = vec![0];
        let mut next = 0;
        while let Some(&index) = order.get(next) {
            next += 1;
            let draft = &draft.nodes[index];
            if !draft.is_leaf() {
                for child in draft.children() {
                    tree.nodes[child].parent = index as u32;
                    order.push(child);
                }
                tree.nodes[index].children = draft.children().map(|child| child as u32);
            }
        }
        for index in order.into_iter().rev() {
            tree.nodes[index].height = tree.height_by_children(index);
        }
        tree
    }

    pub(super) fn len(&self) -> usize {
        self.nodes.len()
    }

    pub(super) fn node(&self, index: usize) -> &TreeNode {
        &self.nodes[index]
    }

    pub(super) fn parent(&self, index: usize) -> Option<usize> {
        Some(self.nodes[index].parent).filter(|&parent| parent != NONE).map(|parent| parent as usize)
    }

    /// The other child of a node's parent.
    pub(super) fn sibling(&self, parent: usize, index: usize) -> usize {
        let [left, right] = self.nodes[parent].children.map(|child| child as usize);
        if left == index { right } else { left }
    }

    /// Makes `node` the sibling of another one, if that keeps the depth limit and makes the tree cheaper.
    pub(super) fn try_move(&mut self, node: usize, sibling: usize, depth_limit: u32) -> bool {
        let Some(parent) = self.parent(node).filter(|&parent| parent != sibling) else { return false };
        let mut depth = 0;
        let mut above = sibling;
        while let Some(next) = self.parent(above) {
            if above == node {
                return false;
            }
            depth += 1;
            above = next;
        }
        let height = self.nodes[node].height.max(self.nodes[sibling].height);
        // Neither the root nor a child of it is moved.
        if depth == 0 || self.parent(parent).is_none() || depth + 1 + height > depth_limit {
            return false;
        }
        let before = self.sibling(parent, node);
        let is_cheaper = self.make_sibling(node, sibling) < 0.0;
        if !is_cheaper {
            self.make_sibling(node, before);
        }
        is_cheaper
    }

    /// Moves `node` with its parent to where `sibling` is, which becomes the other child. Returns by how much the sum
    /// of all half areas grows.
    fn make_sibling(&mut self, node: usize, sibling: usize) -> f64 {
        let (Some(parent), Some(_)) = (self.parent(node), self.parent(sibling)) else { return 0.0 };
        let Some(grandparent) = self.parent(parent) else { return 0.0 };
        let other = self.sibling(parent, node);
        self.replace_child(grandparent, parent, other);
        let mut growth = self.refit_from(grandparent);
        let Some(above) = self.parent(sibling) else { return 0.0 };
        self.replace_child(above, sibling, parent);
        self.nodes[parent].children = [sibling, node].map(|child| child as u32);
        self.nodes[sibling].parent = parent as u32;
        // The box at the new place is another, even if it should be equal to the one at the old place.
        growth += self.refit(parent);
        growth + self.refit_from(above)
    }

    fn replace_child(&mut self, parent: usize, old: usize, new: usize) {
        for child in &mut self.nodes[parent].children {
            if *child == old as u32 {
                *child = new as u32;
            }
        }
        self.nodes[new].parent = parent as u32;
    }

    /// Sets boxes and heights from a node up, as far as they change.
    fn refit_from(&mut self, index: usize) -> f64 {
        let (mut growth, mut next) = (0.0, Some(index));
        while let Some(index) = next {
            let (aabb, height) = (self.nodes[index].aabb, self.nodes[index].height);
            growth += self.refit(index);
            let node = &self.nodes[index];
            next = self.parent(index).filter(|_| node.aabb != aabb || node.height != height);
        }
        growth
    }

    /// Sets box and height of an inner node by its children, and says by how much its half area grows.
    fn refit(&mut self, index: usize) -> f64 {
        let Some([left, right]) = self.nodes[index].children() else { return 0.0 };
        let aabb = self.nodes[left].aabb.union(self.nodes[right].aabb);
        let growth = f64::from(aabb.half_area()) - f64::from(self.nodes[index].aabb.half_area());
        self.nodes[index].height = self.height_by_children(index);
        self.nodes[index].aabb = aabb;
        growth
    }

    fn height_by_children(&self, index: usize) -> u32 {
        let children = self.nodes[index].children();
        children.map_or(0, |children| 1 + children.map(|child| self.nodes[child].height).into_iter().fold(0, u32::max))
    }
}
