//! Trees as kernels read them: records, links, tables, in pieces of 16 bytes.

use stackless_bvh::hash::{BuildError, KeySet, Mix, Options, PerfectHash, Sizing};
use stackless_bvh::tree::{Node, ParentLinks as _, Parents, Reach, Topology, UncleLinks as _, Uncles};

use crate::kernel::{Links, Table};

/// What a leaf ends with.
pub const TERMINATOR: u32 = 1 << 31;

/// No node.
pub const NOWHERE: u32 = 0;

/// Where the nodes of a tree are, by slot: a multiple of 4 for an inner node, the complement of an offset for a leaf.
#[derive(Clone, Debug)]
pub struct Addresses(Vec<u32>);

/// The records of one or more trees, with links of one kind.
#[derive(Clone, Debug, Default)]
pub struct Records {
    /// Inner nodes, 16 words each; the first is nobody's.
    pub nodes: Vec<u32>,
    /// Leaves: pieces of 4 words, the last of each a terminator with links.
    pub leaves: Vec<u32>,
}

/// The tables of one or more trees, with addresses of kernels in them.
#[derive(Clone, Debug, Default)]
pub struct HashTables {
    /// Tables of displacements, one behind the other.
    pub displacements: Vec<u32>,
    /// Hash tables.
    pub cells: Vec<u32>,
}

/// What a kernel has to know of one perfect hash.
#[derive(Clone, Copy, Debug)]
pub struct TableHead {
    /// D - 1.
    pub mask: u32,
    /// Where its displacements begin.
    pub displacements_at: u32,
    /// H.
    pub size: u32,
    /// Where its cells begin.
    pub cells_at: u32,
    /// floor((2^64 - 1) / H).
    pub reciprocal: u64,
    /// The bijection before the remainders.
    pub mix: Mix,
    /// Seed of the fold of long keys.
    pub fold_seed: u64,
}

impl Addresses {
    /// Those of a tree's nodes where inner nodes begin at the record `first` and leaves at the piece `first_leaf`, each
    /// leaf as many pieces long as `pieces` says; and where the next tree may begin.
    pub fn of(tree: &impl Topology, first: u32, first_leaf: u32, pieces: impl Fn(Node) -> u32) -> (Self, u32, u32) {
        let mut addresses = vec![NOWHERE; tree.node_count()];
        let (mut next, mut next_leaf) = (first, first_leaf);
        let mut pending = vec![tree.root()];
        while let Some(node) = pending.pop() {
            let address = &mut addresses[tree.slot(node)];
            if node.is_leaf() {
                *address = !next_leaf;
                next_leaf += pieces(node);
            } else {
                *address = 4 * next;
                next += 1;
                let [left, right] = tree.children(node);
                pending.extend([right, left]);
            }
        }
        (Self(addresses), next, next_leaf)
    }

    /// The address of a node.
    pub fn at(&self, tree: &impl Topology, node: Node) -> u32 {
        self.0[tree.slot(node)]
    }
}

/// The links of each node, by slot: uncle, grand uncle and grand grand uncle, or parent and sibling.
pub fn links<T: Topology>(tree: &T, addresses: &Addresses, kind: Links) -> Vec<[u32; 3]> {
    let mut rows = vec![[NOWHERE; 3]; tree.node_count()];
    let (uncles, parents) = (Uncles::<2, 3>::of(tree), Parents::of(tree));
    let root = tree.root();
    let address = |node: Node| if node == root { NOWHERE } else { addresses.at(tree, node) };
    let mut pending = vec![root];
    while let Some(node) = pending.pop() {
        rows[tree.slot(node)] = match kind {
            Links::Uncles => (&uncles).row(tree, node).map(address),
            Links::Parents => {
                let parents = &parents;
                [addresses.at(tree, parents.parent(tree, node)), address(parents.sibling(tree, node)), NOWHERE]
            }
        };
        if !node.is_leaf() {
            pending.extend(tree.children(node));
        }
    }
    rows
}

impl HashTables {
    /// Adds the table of a tree.
    ///
    /// # Errors
    /// [`BuildError`].
    pub fn add(&mut self, tree: &impl Topology, addresses: &Addresses, table: Table) -> Result<TableHead, BuildError> {
        let hash = PerfectHash::build(tree, table.options())?;
        Ok(self.add_hash(&hash, |node| addresses.at(tree, node)))
    }

    /// Adds a finished table, with these addresses for nodes.
    pub fn add_hash(&mut self, hash: &PerfectHash, address: impl Fn(Node) -> u32) -> TableHead {
        let header = hash.header();
        let head = TableHead {
            mask: header.displacements - 1,
            displacements_at: self.displacements.len() as u32,
            size: header.cells.get(),
            cells_at: self.cells.len() as u32,
            reciprocal: u64::MAX / u64::from(header.cells.get()),
            mix: header.mix,
            fold_seed: header.fold_seed,
        };
        let translated = |&word: &u32| node_of(word).map_or(word, |node| encoded(address(node)));
        self.displacements.extend(hash.displacements().iter().map(translated));
        self.cells.extend(hash.cells().iter().map(|&word| node_of(word).map_or(NOWHERE, &address)));
        head
    }
}

impl Table {
    /// How it is built.
    pub const fn options(self) -> Options {
        match self {
            Self::Printed => Options { key_set: KeySet::Paper, sizing: Sizing::Printed },
            Self::Tight => Options { key_set: KeySet::Exact(Reach::SECTION_2_1), sizing: Sizing::Tight },
        }
    }
}

/// The node that an entry stands for; `None` for a displacement or an empty cell. `[HASH-5]`
pub const fn node_of(word: u32) -> Option<Node> {
    match word {
        0..0x8000_0000 => None,
        0x8000_0000..0xc000_0000 => Some(Node::inner(word & 0x3fff_ffff)),
        _ => Some(Node::leaf(!word)),
    }
}

/// An address in the table of displacements: marked by the sign.
pub const fn encoded(address: u32) -> u32 {
    address | TERMINATOR
}
