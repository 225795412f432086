//! Ways to the ancestors, and records, with a mistake.

use std::collections::BTreeMap;

use super::Bug;
use stackless_bvh::tree::Node;
use stackless_bvh::wide::{Link, Topology, Tree};

/// Along parents.
#[derive(Debug)]
pub(super) struct Climb(pub(super) Bug);

impl<const A: usize> Link<A> for Climb {
    fn enter(&mut self, _: u32) {}

    fn ancestor<T: Topology<A>>(&mut self, tree: &T, node: Node, up: u32) -> Node {
        let up = match self.0 {
            Bug::ParentsShort => up - 1,
            Bug::ParentsLong => up + 1,
            _ => up,
        };
        (0..up).fold(node, |node, _| tree.parent(node))
    }
}

/// By the ancestors that records name.
#[derive(Debug)]
pub(super) struct ByRecord(pub(super) Bug);

impl<const A: usize> Link<A> for ByRecord {
    fn enter(&mut self, _: u32) {}

    fn ancestor<T: Topology<A>>(&mut self, tree: &T, mut node: Node, mut up: u32) -> Node {
        let (a, bug) = (A as u32, self.0);
        while up > a {
            if bug != Bug::FarNotFollowed {
                node = tree.ancestor(node, a);
            }
            up = match bug {
                Bug::NotRepeated => a,
                Bug::FarCountsLess => up - a + 1,
                _ => up - a,
            };
        }
        tree.ancestor(node, up)
    }
}

/// By keys.
#[derive(Debug)]
pub(super) struct ByKey {
    key: u128,
    nodes: BTreeMap<u128, Node>,
    root: Node,
    bug: Bug,
}

impl ByKey {
    /// With the keys that can be asked for.
    pub(super) fn of<const A: usize>(tree: &Tree<A>, bug: Bug) -> Self {
        let (mut nodes, mut open) = (BTreeMap::new(), vec![(1_u128, tree.root())]);
        while let Some((key, node)) = open.pop() {
            let (children, leaves) = (tree.children(node), tree.leaves(node));
            let (count, inner) = (children.count_ones(), (children & !leaves).count_ones());
            let is_asked = match bug {
                Bug::KeysOfPairsMissing => inner > 0 && count > 2,
                Bug::KeysBesideLeavesMissing => inner > 1,
                _ => inner > 0 && count > 1,
            };
            if is_asked {
                nodes.insert(key, node);
            }
            let slots = (0..A as u32).filter(|slot| (children & !leaves) >> slot & 1 == 1);
            open.extend(slots.map(|slot| (key << A.ilog2() | u128::from(slot), tree.child(node, slot))));
        }
        Self { key: 1, nodes, root: tree.root(), bug }
    }
}

impl<const A: usize> Link<A> for ByKey {
    fn clear(&mut self) {
        if self.bug != Bug::KeyNotReset {
            self.key = 1;
        }
    }

    fn enter(&mut self, slot: u32) {
        let (bits, slot) = match self.bug {
            Bug::KeyShiftLong => (A.ilog2() + 1, slot),
            Bug::KeyShiftByOne => (1, slot),
            Bug::SlotLost => (A.ilog2(), 0),
            Bug::SlotsFromOne => (A.ilog2(), slot + 1),
            _ => (A.ilog2(), slot),
        };
        self.key = self.key << bits | u128::from(slot);
    }

    fn ancestor<T: Topology<A>>(&mut self, _: &T, _: Node, up: u32) -> Node {
        let bits = if self.bug == Bug::KeyShiftByLevels { up } else { up * A.ilog2() };
        let key = self.key.checked_shr(bits).unwrap_or(0);
        if self.bug != Bug::KeyLeftBehind {
            self.key = key;
        }
        self.nodes.get(&key).copied().unwrap_or(self.root)
    }
}

/// A tree whose records may be wrong.
#[derive(Debug)]
pub(super) struct Records<'t, const A: usize> {
    pub(super) tree: &'t Tree<A>,
    pub(super) bug: Bug,
}

impl<const A: usize> Topology<A> for Records<'_, A> {
    fn root(&self) -> Node {
        self.tree.root()
    }

    fn children(&self, node: Node) -> u32 {
        self.tree.children(node)
    }

    fn leaves(&self, node: Node) -> u32 {
        if self.bug == Bug::LeavesInSlotOrder { 0 } else { self.tree.leaves(node) }
    }

    fn child(&self, node: Node, slot: u32) -> Node {
        self.tree.child(node, slot)
    }

    fn levels(&self) -> u32 {
        if self.bug == Bug::LevelsSaidShort { self.tree.levels().saturating_sub(1) } else { self.tree.levels() }
    }

    fn parent(&self, node: Node) -> Node {
        self.tree.parent(node)
    }

    fn ancestor(&self, node: Node, up: u32) -> Node {
        match (self.bug, up) {
            (Bug::RecordsANodeShort, 1) => node,
            (Bug::RecordsANodeShort, _) => self.tree.ancestor(node, up - 1),
            (Bug::RecordsANodeLong, _) => self.tree.ancestor(self.tree.parent(node), up),
            (Bug::RecordsBackwards, _) => self.tree.ancestor(node, A as u32 + 1 - up),
            (Bug::LastRecordMissing, _) if up == A as u32 => self.tree.root(),
            _ => self.tree.ancestor(node, up),
        }
    }
}
