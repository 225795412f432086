//! Tables and records that are not those of the tree.

use super::wrapped::{Mutation, Wrapped};
use super::{Planted, drive};
use stackless_bvh::hash::{KeySet, Lookup, Options, PerfectHash, Sizing};
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::{FixedOrder, Side};
use stackless_bvh::traverse::{Sparse, Uncle};
use stackless_bvh::tree::{Keys, Linked, Node, Parents, Reach, Recorded, Topology, Tree, Uncles};

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

/// What a record names in place of the uncle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Misrecord {
    /// The grand uncle; and the uncle in its place.
    GrandUncle,
    Sibling,
}

/// A traversal by records with a mistake.
pub(super) fn misrecorded(name: &str, how: Misrecord) -> Planted {
    Planted::any(name, "UNCLE-1", move |tree, _, visitor, watcher| {
        let tree = Misrecorded { tree, uncles: Uncles::of(tree), parents: Parents::of(tree), how };
        if let Ok(cursor) = Uncle::<u64, _>::new(&tree) {
            drive(cursor, visitor, watcher);
        }
    })
}

struct Misrecorded<'t> {
    tree: &'t Tree,
    uncles: Uncles,
    parents: Parents,
    how: Misrecord,
}

/// A tree that says it is this deep, whatever it is.
#[derive(Debug)]
pub struct Shallow<'t> {
    /// The tree, with the links that a traversal follows.
    pub tree: Linked<'t, Tree>,
    /// What it says.
    pub depth: u32,
}

impl Topology for Misrecorded<'_> {
    stackless_bvh::topology_of!(tree);

    fn recorded(&self) -> Recorded {
        Recorded::Uncles
    }
    fn links(&self, node: Node) -> [Node; 2] {
        match (self.uncles.row(self.tree, node), self.how) {
            ([uncle, grand_uncle, _], Misrecord::GrandUncle) if grand_uncle != self.root() => [grand_uncle, uncle],
            ([_, grand_uncle, _], Misrecord::Sibling) => [self.parents.row(self.tree, node)[1], grand_uncle],
            ([uncle, grand_uncle, _], Misrecord::GrandUncle) => [uncle, grand_uncle],
        }
    }
}

impl Topology for Shallow<'_> {
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
    fn names(&self, what: Recorded) -> bool {
        self.tree.names(what)
    }
    fn parent(&self, node: Node) -> Node {
        self.tree.parent(node)
    }
    fn sibling(&self, node: Node) -> Node {
        self.tree.sibling(node)
    }
    fn depth(&self) -> u32 {
        self.depth
    }
}

/// A traversal in words of 64 bits that takes a tree of 64 levels for one of 63.
pub(super) fn shallow() -> Planted {
    let run = Planted::any("", "DEPTH-1", |tree, _, visitor, watcher| {
        let shallow = Shallow { tree: Linked::parents(tree), depth: tree.depth().saturating_sub(1) };
        if let Ok(cursor) = Sparse::<u64, _>::new(&shallow) {
            drive(cursor, visitor, watcher);
        }
    });
    run.carrying(64)
}

/// A traversal that does not know that the root has no sibling.
pub(super) fn with_sibling_of_root() -> Planted {
    Planted::any("", "SPARSE-1", |tree, _, visitor, watcher| {
        if let Ok(sparse) = Sparse::<u64, _>::new(&Linked::parents(tree)) {
            drive(Wrapped::new(tree, sparse, Mutation::PastRoot), visitor, watcher);
        }
    })
}

pub(super) struct RightFirst;

impl FixedOrder for RightFirst {
    fn first(&self, _: Node) -> Side {
        Side::Right
    }
}
