//! Trees in the format of kernels: records, links and tables, in pieces of 16 bytes.

use stackless_bvh::generate::Tape;
use stackless_bvh::geom::Triangle;
use stackless_bvh::hash::Mix;
use stackless_bvh::hash::{BuildError, KeySet, Options, PerfectHash, Sizing};
use stackless_bvh::tree::{Node, Parents, Reach, Topology, Tree, Uncles};

use crate::kernel::{Links, Table};

/// The mark at the end of a leaf.
pub const TERMINATOR: u32 = 1 << 31;

/// No node.
pub const NOWHERE: u32 = 0;

/// Addresses of the nodes of a tree, by slot: a multiple of 4 for an inner node, the complement of an offset for a
/// leaf.
#[derive(Clone, Debug)]
pub struct Addresses(Vec<u32>);

/// The records of one or more trees, with links of one kind.
#[derive(Clone, Debug, Default)]
pub struct Records {
    /// Inner nodes, 16 words each; the first record is unused.
    pub nodes: Vec<u32>,
    /// Leaves: pieces of 4 words, the last of each a terminator with links.
    pub leaves: Vec<u32>,
}

/// The tables of one or more trees, with the kernel's addresses.
#[derive(Clone, Debug, Default)]
pub struct HashTables {
    /// Tables of displacements, one after the other.
    pub displacements: Vec<u32>,
    /// Hash tables.
    pub cells: Vec<u32>,
}

/// The parameters of one perfect hash.
#[derive(Clone, Copy, Debug)]
pub struct TableHead {
    /// D - 1.
    pub mask: u32,
    /// Start of its displacements.
    pub displacements_at: u32,
    /// H.
    pub size: u32,
    /// Start of its cells.
    pub cells_at: u32,
    /// floor((2^64 - 1) / H).
    pub reciprocal: u64,
    /// The bijection before the remainders.
    pub mix: Mix,
    /// Seed of the fold of long keys.
    pub fold_seed: u64,
}

impl TableHead {
    /// No table.
    pub const NONE: Self = Self {
        mask: 0,
        displacements_at: 0,
        size: 1,
        cells_at: 0,
        reciprocal: 0,
        mix: Mix { narrow: false, seed: None },
        fold_seed: 0,
    };

    /// Words for kernels without a compiled-in table: the parameters, the address of the root, and a word for the
    /// search.
    pub const fn words(&self, root: u32, search: u32) -> [u32; 16] {
        let [recip, recip_high] = halves(self.reciprocal);
        let (seed, is_seeded) = match self.mix.seed {
            Some(seed) => (halves(seed), 1),
            None => ([0; 2], 0),
        };
        let [fold, fold_high] = halves(self.fold_seed);
        let Self { mask, displacements_at, size, cells_at, .. } = *self;
        let narrow = self.mix.narrow as u32;
        [
            root,
            search,
            mask,
            displacements_at,
            size,
            cells_at,
            recip,
            recip_high,
            is_seeded,
            narrow,
            seed[0],
            seed[1],
            fold,
            fold_high,
            0,
            0,
        ]
    }
}

/// Low and high half.
pub const fn halves(word: u64) -> [u32; 2] {
    [word as u32, (word >> 32) as u32]
}

/// Appends a leaf: three pieces per triangle, with the index in the first, then a terminator without links.
pub fn push_leaf(leaves: &mut Vec<u32>, triangles: impl Iterator<Item = (Triangle, u32)>) {
    for (shape, index) in triangles {
        for (corner, last) in shape.0.into_iter().zip([index, 0, 0]) {
            // -0 becomes 0, because its bits are those of the terminator.
            leaves.extend((corner + 0.0).to_array().map(f32::to_bits));
            leaves.push(last);
        }
    }
    leaves.extend([TERMINATOR, 0, 0, 0]);
}

impl Records {
    /// Space for these numbers of inner nodes and of pieces of leaves.
    pub fn with_room(inner: u32, pieces: u32) -> Self {
        Self { nodes: vec![0; 16 * inner as usize], leaves: vec![0; 4 * pieces as usize] }
    }

    /// Writes children and links of a tree. Its leaves are two pieces long, and never hit.
    pub fn add_tree(&mut self, tree: &Tree, addresses: &Addresses, kind: Links) {
        let rows = links(tree, addresses, kind);
        for node in (0..tree.node_count() as u32).filter_map(|i| tree.node(i)) {
            let (address, slot) = (addresses.at(tree, node), tree.slot(node));
            let row = rows[slot];
            if node.is_leaf() {
                let at = 4 * !address as usize;
                let words = [u32::MAX, u32::MAX, slot as u32, 0, TERMINATOR, row[0], row[1], row[2]];
                self.leaves[at..at + 8].copy_from_slice(&words);
            } else {
                let at = 4 * address as usize + 12;
                let [left, right] = tree.children(node).map(|child| addresses.at(tree, child));
                self.nodes[at..at + 4].copy_from_slice(&[left, right, row[0], row[1]]);
            }
        }
    }
}

impl Records {
    /// Writes the decisions of a tape into the nodes of an added tree.
    pub fn add_cells(&mut self, tree: &Tree, addresses: &Addresses, tape: &Tape) {
        let cell = |node: Node| tape.cells()[tree.slot(node)];
        for node in (0..tree.node_count() as u32).filter_map(|i| tree.node(i)) {
            let (address, said) = (addresses.at(tree, node), cell(node));
            let none = |distance: Option<u32>| distance.unwrap_or(u32::MAX);
            if node.is_leaf() {
                let at = 4 * !address as usize;
                self.leaves[at] = none(said.hit.filter(|_| !said.miss));
                self.leaves[at + 1] = none(said.exit);
            } else {
                let at = 4 * address as usize;
                for (child, at) in tree.children(node).map(cell).into_iter().zip([at, at + 4]) {
                    let words = [child.enter, none(child.exit), none(child.hit), u32::from(child.miss)];
                    self.nodes[at..at + 4].copy_from_slice(&words);
                }
                self.nodes[at + 8] = u32::from(said.right_first);
            }
        }
    }
}

impl Addresses {
    /// Addresses of a tree's nodes. Inner nodes start at the record `first`, leaves at the piece `first_leaf`; `pieces`
    /// returns the length of a leaf. Also returns the starts for the next tree.
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
    let (uncles, parents) = (Uncles::of(tree), Parents::of(tree));
    let root = tree.root();
    let address = |node: Node| if node == root { NOWHERE } else { addresses.at(tree, node) };
    let mut pending = vec![root];
    while let Some(node) = pending.pop() {
        rows[tree.slot(node)] = match kind {
            Links::Uncles => uncles.row(tree, node).map(address),
            Links::Parents => {
                let [parent, sibling] = parents.row(tree, node);
                [addresses.at(tree, parent), address(sibling), NOWHERE]
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

    /// Adds a finished table; `address` maps nodes to addresses.
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
    /// The options of its builder.
    pub const fn options(self) -> Options {
        match self {
            Self::Printed => Options { key_set: KeySet::Paper, sizing: Sizing::Printed },
            Self::Tight => Options { key_set: KeySet::Exact(Reach::SECTION_2_1), sizing: Sizing::Tight },
        }
    }
}

/// The node of an entry; `None` for a displacement or an empty cell. `[HASH-5]`
pub const fn node_of(word: u32) -> Option<Node> {
    match word {
        0..0x8000_0000 => None,
        0x8000_0000..0xc000_0000 => Some(Node::inner(word & 0x3fff_ffff)),
        _ => Some(Node::leaf(!word)),
    }
}

/// An address in the table of displacements, marked by the sign.
pub const fn encoded(address: u32) -> u32 {
    address | TERMINATOR
}
