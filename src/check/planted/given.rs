//! Tables and records that are not those of the tree.

use crate::hash::{KeySet, Lookup, Options, PerfectHash, Sizing};
use crate::key::KeyWord;
use crate::order::{FixedOrder, Side};
use crate::tree::{Keys, Node, Reach, Recorded, Topology, Tree, UncleLinks, Uncles};

/// A table that answers with the sibling.
pub(super) struct Misled<'t>(pub(super) &'t Tree);

impl<W: KeyWord> Lookup<W> for Misled<'_> {
    fn node(&self, key: &W) -> Node {
        Keys::walk(self.0, &key.clone().xor(&W::one())).unwrap_or(self.0.root())
    }
}

/// A table of the keys for records that reach a generation further than they do.
pub(super) struct Short {
    table: Option<PerfectHash>,
    root: Node,
}

impl Short {
    pub(super) fn of(tree: &Tree) -> Self {
        let key_set = Reach::new(3, 3).map_or(KeySet::Paper, KeySet::Exact);
        Self { table: PerfectHash::build(tree, Options { key_set, sizing: Sizing::Tight }).ok(), root: tree.root() }
    }
}

impl<W: KeyWord> Lookup<W> for Short {
    fn node(&self, key: &W) -> Node {
        self.table.as_ref().and_then(|table| table.probe(key)).unwrap_or(self.root)
    }
}

/// A tree whose records name uncle and grand uncle the wrong way round.
pub(super) struct Misrecorded<'t> {
    pub(super) tree: &'t Tree,
    pub(super) uncles: Uncles,
}

impl Topology for Misrecorded<'_> {
    fn root(&self) -> Node {
        self.tree.root()
    }
    fn children(&self, node: Node) -> [Node; 2] {
        self.tree.children(node)
    }
    fn node_count(&self) -> usize {
        self.tree.node_count()
    }
    fn slot(&self, node: Node) -> usize {
        self.tree.slot(node)
    }
    fn depth(&self) -> u32 {
        self.tree.depth()
    }
    fn recorded(&self) -> Recorded {
        Recorded::Uncles
    }
    fn links(&self, node: Node) -> [Node; 2] {
        match (&self.uncles).row(self.tree, node) {
            [uncle, grand_uncle, _] if grand_uncle == self.root() => [uncle, grand_uncle],
            [uncle, grand_uncle, _] => [grand_uncle, uncle],
        }
    }
}

pub(super) struct RightFirst;

impl FixedOrder for RightFirst {
    fn first(&self, _: Node) -> Side {
        Side::Right
    }
}
