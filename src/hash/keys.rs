//! The keys that are ever looked up.

use alloc::collections::{BTreeMap, VecDeque};
use alloc::vec;
use alloc::vec::Vec;

use super::fold::Step;
use crate::threads;
use crate::tree::{Node, Reach, Topology};

/// A set of nodes whose keys are hashed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeySet {
    /// All nodes: the set for a traversal without uncles.
    All,
    /// The nodes with "at least a grand nephew, which is an internal node, or at least a grand grand nephew that is a
    /// leaf node" (Binder & Keller 2016, Section 2.2.2). The second half follows from the first.
    Paper,
    /// The nodes that some search with register and uncles of this reach looks up, and no other nodes. `[HASH-3]`
    ///
    /// **Rule.** Hash x iff the subtree of its sibling s contains an inner node more than Ui levels below s, or a leaf
    /// more than Ul levels below s, where records of inner nodes have the siblings of Ui ancestors, and those of leaves
    /// Ul.
    ///
    /// **Sufficient.** Let a search go to x from the visited node y without its address. Then x is the lowest postponed
    /// node and y, some number δ of levels below s, does not have it in its record. δ is not 0: at s the register still
    /// holds x from the descent into s. So y is a node below s without x in its record: more than Ui below s if it is
    /// an inner node, more than Ul if it is a leaf.
    ///
    /// **Necessary.** Let z be such a node. Take a search that postpones x, enters single children down to the parent
    /// of z, and postpones z there. It finds nothing in the sibling of z, returns to z (which empties the register) and
    /// finds nothing there either. Then x is its next node, and neither the register nor the record of z has its
    /// address.
    ///
    /// **In one number.** A subtree with a leaf more than Ul below s is higher than Ul. A subtree with an inner node
    /// more than Ui below s is higher than Ui + 1. So x is hashed iff the height of its sibling's subtree is at least
    /// min(Ui + 2, Ul + 1). The paper's rule is a height of at least 3: exact for reaches of (2, 2) and (1, 2), with
    /// too many keys for (2, 3), and with missing keys for (1, 1).
    Exact(Reach),
}

impl KeySet {
    /// Returns for each slot whether the node is hashed. Linear time, no recursion.
    pub fn slots(self, tree: &impl Topology) -> Vec<bool> {
        let mut hashed = vec![self == Self::All; tree.node_count()];
        collect(tree, (tree.root(), ()), self.sibling_height(), &mut |(), node| hashed[tree.slot(node)] = true);
        hashed
    }

    /// Returns the least height (levels) of a sibling's subtree for which a node is hashed.
    const fn sibling_height(self) -> u32 {
        match self {
            Self::All => 0,
            Self::Paper => 3,
            Self::Exact(reach) => {
                let (inner, leaf) = (reach.of(false) + 2, reach.of(true) + 1);
                if inner < leaf { inner } else { leaf }
            }
        }
    }

    /// Returns the hashed keys of a tree with their nodes, in no particular order.
    pub(super) fn keys<P: Step + Send>(self, tree: &impl Topology, root: P) -> Vec<HashedKey> {
        let mut keys = self.root_key(tree, root);
        let mut push = |path: P, node| keys.push(HashedKey { key: path.key(), node });
        collect(tree, (tree.root(), root), self.sibling_height(), &mut push);
        keys
    }

    /// The root is no node's sibling: only [`All`](Self::All) has it.
    fn root_key<P: Step>(self, tree: &impl Topology, root: P) -> Vec<HashedKey> {
        let key = HashedKey { key: root.key(), node: tree.root() };
        if self == Self::All { vec![key] } else { Vec::new() }
    }

    /// Computes [`keys`](Self::keys) on all threads: the top of the tree first, then the subtrees below it.
    pub(super) fn keys_parallel<P: Step + Send + Sync>(self, tree: &(impl Topology + Sync), root: P) -> Vec<HashedKey> {
        let height = self.sibling_height();
        let top = Top::of(tree, root);
        let below = threads::map(0..top.below.len(), 1, |i| {
            let mut keys = Vec::new();
            let push = &mut |path: P, node| keys.push(HashedKey { key: path.key(), node });
            (collect(tree, top.below[i], height, push), keys)
        });
        let (heights, mut lists): (Vec<_>, Vec<_>) = below.into_iter().unzip();
        lists.push(self.root_key(tree, root));
        let mut own = Vec::new();
        top.finish(tree, heights, height, &mut |path, node| own.push(HashedKey { key: path.key(), node }));
        lists.push(own);
        lists.concat()
    }
}

/// A key of up to 64 bits, or the fold of a longer one, and its node.
#[derive(Clone, Copy, Debug)]
pub(super) struct HashedKey {
    pub(super) key: u64,
    pub(super) node: Node,
}

impl HashedKey {
    /// A filler for arrays.
    pub(super) const NONE: Self = Self { key: 0, node: Node::inner(0) };
}

/// An inner node on the path to the current node of the walk.
struct Open<P> {
    left: Node,
    right: Node,
    path: P,
    /// The height of the left subtree, once the walk is in the right one.
    left_height: Option<u32>,
}

/// Calls `found` for each node below `top` whose sibling's subtree is at least `sibling_height` high, and returns the
/// height of the subtree of `top`. One walk, each record read once, children before parents.
fn collect<P: Step>(
    tree: &impl Topology,
    (top, path): (Node, P),
    sibling_height: u32,
    found: &mut impl FnMut(P, Node),
) -> u32 {
    let mut open: Vec<Open<P>> = Vec::new();
    let (mut node, mut path) = (top, path);
    loop {
        while !node.is_leaf() {
            let [left, right] = tree.children(node);
            open.push(Open { left, right, path, left_height: None });
            (node, path) = (left, path.child(0));
        }
        let mut height = 0;
        loop {
            let Some(parent) = open.last_mut() else { return height };
            let Some(left_height) = parent.left_height else {
                parent.left_height = Some(height);
                (node, path) = (parent.right, parent.path.child(1));
                break;
            };
            if left_height >= sibling_height {
                found(parent.path.child(1), parent.right);
            }
            if height >= sibling_height {
                found(parent.path.child(0), parent.left);
            }
            height = 1 + height.max(left_height);
            open.pop();
        }
    }
}

/// The top of a tree, and the subtrees below it.
struct Top<P> {
    /// Inner nodes, parents before children, each with the place of its children's heights.
    inner: Vec<(Node, P)>,
    below: Vec<(Node, P)>,
}

impl<P: Step> Top<P> {
    /// Number of subtrees that keeps threads busy in any balanced tree; in a chain, the search for more stops.
    const SUBTREES: usize = 256;

    fn of(tree: &impl Topology, root: P) -> Self {
        let mut queue = VecDeque::from([(tree.root(), root)]);
        let (mut inner, mut leaves) = (Vec::new(), Vec::new());
        while inner.len() < Self::SUBTREES
            && let Some((node, path)) = queue.pop_front()
        {
            if node.is_leaf() {
                leaves.push((node, path));
            } else {
                inner.push((node, path));
                let [left, right] = tree.children(node);
                queue.extend([(left, path.child(0)), (right, path.child(1))]);
            }
        }
        leaves.extend(queue);
        Self { inner, below: leaves }
    }

    /// Computes [`collect`] for the top alone: `heights` are those of the subtrees below.
    fn finish(&self, tree: &impl Topology, heights: Vec<u32>, sibling_height: u32, found: &mut impl FnMut(P, Node)) {
        let nodes = self.below.iter().map(|&(node, _)| node);
        let mut heights: BTreeMap<Node, u32> = nodes.zip(heights).collect();
        for &(node, path) in self.inner.iter().rev() {
            let [left, right] = tree.children(node);
            let [of_left, of_right] = [left, right].map(|child| heights.get(&child).copied().unwrap_or(0));
            if of_left >= sibling_height {
                found(path.child(1), right);
            }
            if of_right >= sibling_height {
                found(path.child(0), left);
            }
            heights.insert(node, 1 + of_left.max(of_right));
        }
    }
}

#[cfg(test)]
mod tests;
