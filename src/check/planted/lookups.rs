//! Lookups in perfect hashes that are right, each with a mistake in the function: the traversal that looks every node up.

use super::draw::Draw;
use super::layers::Mistake;
use super::{Planted, drive, tables};
use crate::check::Case;
use crate::generate::{Kind, Source, Tape};
use crate::hash::{AddressBounds, KeySet, Lookup, Options, PerfectHash};
use crate::key::KeyWord;
use crate::traverse::HashOnly;
use crate::tree::{Node, Topology, Tree};

pub(super) const MISTAKES: [Mistake; 7] = [
    Mistake::new("the sum of the remainder stays below H by clamping", "HASH-1", |draw| fault(draw, Slip::Clamped)),
    Mistake::new("the remainder is by H - 1", "HASH-1", |draw| fault(draw, Slip::Short)),
    Mistake::new("the bucket of the parent", "HASH-1", |draw| fault(draw, Slip::Bucket)),
    Mistake::new("the mark of a direct address is not looked at", "HASH-5", |draw| fault(draw, Slip::Unmarked)),
    Mistake::new("the sign of an address is not extended", "HASH-5", |draw| fault(draw, Slip::Unsigned)),
    Mistake::new("keys cut to 32 bits", "HASH-1", |draw| fault(draw, Slip::Narrow)),
    Mistake::new("the seed of the remedy forgotten", "HASH-7", |draw| fault(draw, Slip::Unseeded)),
];

pub(super) const CONTROLS: [Mistake; 1] =
    [Mistake::new("the function as it is written", "HASH-1", |draw| fault(draw, Slip::None))];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Slip {
    None,
    Clamped,
    Short,
    Bucket,
    Unmarked,
    Unsigned,
    Narrow,
    Unseeded,
}

/// A table, looked up as the function is written, with a slip.
struct Slipping<'t> {
    hash: PerfectHash,
    tree: &'t Tree,
    bounds: AddressBounds,
    slip: Slip,
}

impl<W: KeyWord> Lookup<W> for Slipping<'_> {
    /// The root, where a slip leads to no node.
    fn node(&self, key: &W) -> Node {
        let header = self.hash.header();
        let is_plain = header.mix.seed.is_none() || self.slip == Slip::Unseeded;
        let word = || self.word(key.to_u64()?).and_then(|word| self.decode(word));
        let found = if is_plain { word() } else { self.hash.probe(key) };
        found.filter(|&node| self.bounds.contains(node)).unwrap_or(self.tree.root())
    }
}

impl Slipping<'_> {
    /// (key mod H + d[key mod D]) mod H, or what the slip makes of it.
    fn word(&self, key: u64) -> Option<u32> {
        let (displacements, slip) = (self.hash.displacements(), self.slip);
        let key = if slip == Slip::Narrow { u64::from(key as u32) } else { key };
        let bucket = if slip == Slip::Bucket { key >> 1 } else { key };
        let displacement = *displacements.get(bucket as usize & (displacements.len() - 1))?;
        if displacement >> 31 == 1 && slip != Slip::Unmarked {
            return Some(displacement);
        }
        let (size, by) = (u64::from(self.hash.header().cells.get()), u64::from(displacement));
        let cell = match slip {
            Slip::Clamped => (key % size + by).min(size - 1),
            Slip::Short => (key % (size - 1).max(1) + by) % size,
            _ => (key % size + by) % size,
        };
        self.hash.cells().get(cell as usize).copied()
    }

    fn decode(&self, word: u32) -> Option<Node> {
        match word >> 30 {
            2 => Some(Node::inner(word & !(1 << 31))),
            3 if self.slip == Slip::Unsigned => Some(Node::inner(word & !(1 << 31))),
            3 => Some(Node::leaf(!word)),
            _ => None,
        }
    }
}

/// What the battery says of a traversal that backtracks by such lookups only.
fn fault(draw: &mut Draw<'_>, slip: Slip) -> Option<String> {
    let (tree, sizing) = (draw.tree(if slip == Slip::Narrow { 40 } else { 31 }), tables::options(draw).sizing);
    let kind = draw.one_of(Kind::ALL);
    let tape = Tape::draw(draw, &tree, kind);
    let case = Case { tree, tape, any: draw.coin(), octant: 0 };
    let planted = Planted::any("", "", move |tree, _, visitor, watcher| {
        let options = Options { key_set: KeySet::All, sizing };
        let Ok(hash) = PerfectHash::build(tree, options) else { return };
        let lookup = Slipping { hash, tree, bounds: AddressBounds::of(tree), slip };
        if let Ok(cursor) = HashOnly::<u64, _, _>::new(tree, lookup) {
            drive(cursor, visitor, watcher);
        }
    });
    planted.fault(&case).map(|fault| fault.to_string())
}
