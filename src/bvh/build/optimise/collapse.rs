//! The moved tree as a draft, with subtrees made leaves where that is cheaper.

use super::super::draft::{Draft, DraftNode, order_of};
use super::super::sah::NODE_COST;
use super::tree::Tree;

/// The left child is the one with the smaller centre, on the axis on which the two centres differ most.
pub(super) fn to_draft(tree: &Tree, draft: &Draft, max_leaf: u32) -> Draft {
    let leaves = Leaves::of(tree, draft, max_leaf as usize);
    let mut made = Draft { nodes: vec![DraftNode::NONE], references: Vec::with_capacity(draft.references.len()) };
    let mut pending = vec![(0, 0)];
    while let Some((index, place)) = pending.pop() {
        let aabb = tree.node(index).aabb;
        let children = tree.node(index).children().filter(|_| !leaves.is_leaf[index]);
        made.nodes[place] = if let Some([left, right]) = children {
            let (axis, in_order) = order_of(&tree.node(left).aabb, &tree.node(right).aabb);
            let child = made.nodes.len();
            made.nodes.extend([DraftNode::NONE; 2]);
            let [left, right] = if in_order { [left, right] } else { [right, left] };
            pending.extend([(right, child + 1), (left, child)]);
            DraftNode::inner(aabb, child, axis)
        } else {
            let first = made.references.len();
            let mut held = references_below(tree, draft, index);
            // Parts of one primitive may meet again.
            held.sort_unstable();
            held.dedup();
            made.references.extend(&held);
            DraftNode::leaf(aabb, first, held.len())
        };
    }
    made
}

/// Which nodes are leaves, or become leaves.
struct Leaves {
    is_leaf: Vec<bool>,
}

impl Leaves {
    fn of(tree: &Tree, draft: &Draft, max_leaf: usize) -> Self {
        // Of each node the number of references below it, and what it costs.
        let mut below = vec![(0, 0.0); tree.len()];
        let mut is_leaf = vec![false; tree.len()];
        let mut order = vec![0];
        let mut next = 0;
        while let Some(&index) = order.get(next) {
            next += 1;
            order.extend(tree.node(index).children().into_iter().flatten());
        }
        for index in order.into_iter().rev() {
            let node = tree.node(index);
            let area = f64::from(node.aabb.half_area());
            below[index] = if let Some([left, right]) = node.children() {
                let count = below[left].0 + below[right].0;
                let (as_inner, as_leaf) =
                    (area * f64::from(NODE_COST) + below[left].1 + below[right].1, area * count as f64);
                is_leaf[index] = count <= max_leaf && as_leaf <= as_inner;
                (count, if is_leaf[index] { as_leaf } else { as_inner })
            } else {
                is_leaf[index] = true;
                let count = draft.nodes[index].references().len();
                (count, area * count as f64)
            };
        }
        Self { is_leaf }
    }
}

fn references_below(tree: &Tree, draft: &Draft, index: usize) -> Vec<u32> {
    let (mut held, mut pending) = (Vec::new(), vec![index]);
    while let Some(index) = pending.pop() {
        match tree.node(index).children() {
            Some(children) => pending.extend(children),
            None => held.extend(&draft.references[draft.nodes[index].references()]),
        }
    }
    held
}
