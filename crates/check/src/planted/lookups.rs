//! Lookups in perfect hashes that are right, each with a mistake in the function: the traversal that looks every node
//! up.

use super::draw::Draw;
use super::layers::{Instead, Mistake};
use super::{Planted, drive, tables};
use crate::Case;
use stackless_bvh::generate::{Kind, Source, Tape};
use stackless_bvh::hash::{AddressBounds, KeySet, Lookup, Mix, Options, PerfectHash};
use stackless_bvh::key::KeyWord;
use stackless_bvh::traverse::HashOnly;
use stackless_bvh::tree::{Node, Topology, Tree};

macro_rules! of {
    ($name:literal, $clause:literal, $slip:ident) => {
        Mistake::new($name, $clause, |draw| fault(draw, Slip::$slip), Instead::Function(Function(Slip::$slip)))
    };
}

pub(super) const MISTAKES: [Mistake; 8] = [
    of!("the sum of the remainder stays below H by clamping", "HASH-1", Clamped),
    of!("key and displacement are added in the key's word", "HASH-1", Overflowing),
    of!("the remainder is by H - 1", "HASH-1", Short),
    of!("the bucket of the parent", "HASH-1", Bucket),
    of!("the mark of a direct address is not looked at", "HASH-5", Unmarked),
    of!("the sign of an address is not extended", "HASH-5", Unsigned),
    of!("keys cut to 32 bits", "HASH-1", Narrow),
    of!("the seed of the remedy forgotten", "HASH-7", Unseeded),
];

pub(super) const CONTROLS: [Mistake; 1] = [of!("the function as it is written", "HASH-1", None)];

/// The function of a perfect hash and its addresses, with a slip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Function(Slip);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Slip {
    None,
    Clamped,
    Overflowing,
    Short,
    Bucket,
    Unmarked,
    Unsigned,
    Narrow,
    Unseeded,
}

impl Function {
    /// The word that a key leads to in tables of D displacements and H cells, after the bijection of a seed.
    pub fn word(self, displacements: &[u32], cells: &[u32], mix: Mix, key: u64) -> Option<u32> {
        let key = if self.0 == Slip::Unseeded { key } else { mix.apply(key) };
        let displacement = *displacements.get(self.bucket(key, displacements.len() as u64) as usize)?;
        if self.is_address(displacement) {
            return Some(displacement);
        }
        cells.get(self.cell(key, cells.len() as u64, displacement) as usize).copied()
    }

    /// Which of so many displacements a key has.
    pub fn bucket(self, key: u64, displacements: u64) -> u64 {
        let key = self.cut(key);
        let key = if self.0 == Slip::Bucket { key >> 1 } else { key };
        key & displacements.wrapping_sub(1)
    }

    /// In which of so many cells a key's node is.
    pub fn cell(self, key: u64, cells: u64, displacement: u32) -> u64 {
        let (key, by) = (self.cut(key), u64::from(displacement));
        match self.0 {
            Slip::Clamped => (key % cells + by).min(cells - 1),
            Slip::Overflowing if key >> 32 == 0 => u64::from((key as u32).wrapping_add(displacement)) % cells,
            Slip::Overflowing => key.wrapping_add(by) % cells,
            Slip::Short => (key % (cells - 1).max(1) + by) % cells,
            _ => (key % cells + by) % cells,
        }
    }

    /// Whether a word of the displacements is an address.
    pub fn is_address(self, word: u32) -> bool {
        word >> 31 == 1 && self.0 != Slip::Unmarked
    }

    /// The node that an address is.
    pub fn node(self, word: u32) -> Option<Node> {
        match word >> 30 {
            2 => Some(Node::inner(word & !(1 << 31))),
            3 if self.0 == Slip::Unsigned => Some(Node::inner(word & !(1 << 31))),
            3 => Some(Node::leaf(!word)),
            _ => None,
        }
    }

    fn cut(self, key: u64) -> u64 {
        if self.0 == Slip::Narrow { u64::from(key as u32) } else { key }
    }
}

/// A table, looked up by a function with a slip.
struct Slipping<'t> {
    hash: PerfectHash,
    tree: &'t Tree,
    bounds: AddressBounds,
    function: Function,
}

impl<W: KeyWord> Lookup<W> for Slipping<'_> {
    /// The root, where a slip leads to no node.
    fn node(&self, key: &W) -> Node {
        let (hash, function) = (&self.hash, self.function);
        let is_plain = hash.header().mix.seed.is_none() || function.0 == Slip::Unseeded;
        let word = || function.word(hash.displacements(), hash.cells(), hash.header().mix, key.to_u64()?);
        let found = if is_plain { word().and_then(|word| function.node(word)) } else { hash.probe(key) };
        found.filter(|&node| self.bounds.contains(node)).unwrap_or(self.tree.root())
    }
}

/// What the battery says of a traversal that backtracks by such lookups only.
fn fault(draw: &mut Draw<'_>, slip: Slip) -> Option<String> {
    let tree = match slip {
        Slip::Overflowing => draw.leaning_right(31),
        Slip::Narrow => draw.tree(40),
        _ => draw.tree(31),
    };
    let sizing = tables::options(draw).sizing;
    let kind = draw.one_of(Kind::ALL);
    let tape = Tape::draw(draw, &tree, kind);
    let case = Case { tree, tape, any: draw.coin(), octant: 0 };
    let planted = Planted::any("", "", move |tree, _, visitor, watcher| {
        let options = Options { key_set: KeySet::All, sizing };
        let Ok(hash) = PerfectHash::build(tree, options) else { return };
        let lookup = Slipping { hash, tree, bounds: AddressBounds::of(tree), function: Function(slip) };
        if let Ok(cursor) = HashOnly::<u64, _, _>::new(tree, lookup) {
            drive(cursor, visitor, watcher);
        }
    });
    planted.fault(&case).map(|fault| fault.to_string())
}
