//! Tables of perfect hashes with a mistake in them, as bytes.

use super::draw::Draw;
use super::layers::{Instead, Mistake, Table};
use crate::check_table_bytes;
use stackless_bvh::hash::{AddressBounds, KeySet, Mix, Options, PerfectHash, Sizing, certify};
use stackless_bvh::tree::{Keys, Reach, Tree};

/// A change of a table's words.
macro_rules! of {
    ($name:literal, $clause:literal, $change:expr) => {
        Mistake::new(
            $name,
            $clause,
            |draw| changed(draw, $change),
            Instead::Table(|tree, keys| built(tree, keys, $change)),
        )
    };
}

pub(super) const MISTAKES: [Mistake; 12] = [
    of!("H is even, so not coprime to D", "HASH-2", even_cells),
    of!("H two short, for the cells of an H before", "HASH-2", fewer_cells),
    Mistake::new("keys of a generation are missing", "HASH-3", missing_generation, Instead::Reach(further)),
    Mistake::new("keys of another tree", "HASH-9", another_tree, Instead::Table(table_of_another)),
    of!("two displacements exchanged", "HASH-1", exchanged_displacements),
    of!("a cell written over another", "HASH-8", overwritten_cell),
    of!("a direct address without its mark", "HASH-5", unmarked),
    of!("a leaf as an inner node", "HASH-5", leaf_as_inner),
    of!("keys said to fit 32 bits that do not", "HASH-1", other_width),
    of!("the seed of the remedy not stored", "HASH-7", seed_not_stored),
    of!("the seed of another fold", "HASH-6", other_fold),
    of!("a word lost at the end", "HASH-9", truncated),
];

pub(super) const CONTROLS: [Mistake; 1] = [of!("a table, unchanged", "HASH-9", |_| ())];

/// A table as words: 12 of the header, two seeds of two words each, displacements, cells.
struct Words {
    words: Vec<u32>,
    /// D: the cells begin after so many displacements.
    displacements: usize,
}

const MAGIC_BYTES: usize = 8;
const SET: usize = 1;
const FLAGS: usize = 5;
const CELLS: usize = 9;
const RESEEDS: usize = 10;
const SEED: usize = 12;
const FOLD_SEED: usize = 14;
const TABLES: usize = 16;

/// Flags: keys fit 32 bits; there is a seed.
const NARROW: u32 = 1;
const SEEDED: u32 = 2;
const MARK: u32 = 1 << 31;

impl Words {
    fn of(hash: &PerfectHash) -> Self {
        let bytes = hash.to_bytes();
        let words = bytes[MAGIC_BYTES..].as_chunks().0.iter().map(|&word| u32::from_le_bytes(word)).collect();
        Self { words, displacements: hash.displacements().len() }
    }

    fn tables(&mut self) -> &mut [u32] {
        &mut self.words[TABLES..]
    }

    fn cells(&mut self) -> &mut [u32] {
        let first = TABLES + self.displacements;
        &mut self.words[first..]
    }
}

/// A table of a drawn tree is changed.
fn changed(draw: &mut Draw<'_>, change: fn(&mut Words)) -> Option<String> {
    let (tree, options) = (draw.tree(70), options(draw));
    let hash = PerfectHash::build(&tree, options).ok()?;
    fault(&hash, &tree, options.key_set, change)
}

/// The table that an implementation builds, changed.
fn built(tree: &Tree, key_set: KeySet, change: fn(&mut Words)) -> Option<Table> {
    let hash = PerfectHash::build(tree, Options { key_set, sizing: Sizing::Tight }).ok()?;
    let mut table = Words::of(&hash);
    change(&mut table);
    let Words { words, displacements } = table;
    let (header, tables) = words.split_at_checked(TABLES)?;
    let (displacements, cells) = tables.split_at_checked(displacements)?;
    let seed = |at: usize| u64::from(header[at]) | u64::from(header[at + 1]) << 32;
    let mix = Mix { narrow: header[FLAGS] & NARROW != 0, seed: (header[FLAGS] & SEEDED != 0).then(|| seed(SEED)) };
    Some(Table { displacements: displacements.to_vec(), cells: cells.to_vec(), mix, fold: seed(FOLD_SEED) })
}

/// What the checks say of a table, once its words are changed, that was promised for a tree and a set of keys.
fn fault(hash: &PerfectHash, tree: &Tree, key_set: KeySet, change: impl FnOnce(&mut Words)) -> Option<String> {
    let (magic, mut table) = (hash.to_bytes()[..MAGIC_BYTES].to_vec(), Words::of(hash));
    change(&mut table);
    let bytes = [magic, table.words.into_iter().flat_map(u32::to_le_bytes).collect()].concat();
    match check_table_bytes(&bytes, tree, &Keys::of(tree)) {
        Err(fault) => Some(fault.to_string()),
        Ok(verdict) => match PerfectHash::from_bytes(&bytes, AddressBounds::of(tree)) {
            Err(refusal) => Some(refusal.to_string()),
            Ok(hash) => match certify(&hash, tree, key_set) {
                Err(refusal) => Some(refusal.to_string()),
                Ok(()) => (verdict != Some(true)).then(|| "certified for another set of keys only".to_owned()),
            },
        },
    }
}

pub(super) fn options(draw: &mut Draw<'_>) -> Options {
    let key_set = draw.one_of([KeySet::Exact(Reach::ALGORITHM_1), KeySet::All, KeySet::Paper]);
    Options { key_set, sizing: draw.one_of(Sizing::ALL) }
}

/// The table is that of records which reach further than those that are promised.
fn missing_generation(draw: &mut Draw<'_>) -> Option<String> {
    let (tree, sizing) = (draw.tree(70), draw.one_of(Sizing::ALL));
    let further = KeySet::Exact(Reach::new(3, 3)?);
    let hash = PerfectHash::build(&tree, Options { key_set: further, sizing }).ok()?;
    let promised = Reach::ALGORITHM_1;
    let reach = [promised.of(false), promised.of(true)];
    fault(&hash, &tree, KeySet::Exact(promised), |table| table.words[SET + 1..=SET + 2].copy_from_slice(&reach))
}

/// Left and right are exchanged: all addresses are of the tree.
fn another_tree(draw: &mut Draw<'_>) -> Option<String> {
    let (tree, options) = (draw.tree(70), options(draw));
    let hash = PerfectHash::build(&mirrored(&tree)?, options).ok()?;
    fault(&hash, &tree, options.key_set, |_| ())
}

fn table_of_another(tree: &Tree, key_set: KeySet) -> Option<Table> {
    built(&mirrored(tree)?, key_set, |_| ())
}

fn mirrored(tree: &Tree) -> Option<Tree> {
    let children = tree.to_children().into_iter().map(|children| children.map(|[left, right]| [right, left]));
    Tree::new(&children.collect::<Vec<_>>()).ok()
}

fn further(reach: Reach) -> Option<Reach> {
    let [inner, leaf] = [false, true].map(|leaf| (reach.of(leaf) + 1).min(3));
    Reach::new(inner, leaf)
}

fn even_cells(table: &mut Words) {
    if table.words[CELLS] > 1 {
        table.words[CELLS] -= 1;
        table.words.pop();
    }
}

fn fewer_cells(table: &mut Words) {
    let cells = table.cells();
    // Where nothing stands there.
    if let [.., _, 0, 0] = cells {
        table.words[CELLS] -= 2;
        table.words.truncate(table.words.len() - 2);
    }
}

fn exchanged_displacements(table: &mut Words) {
    let displacements = table.displacements;
    let words = &mut table.tables()[..displacements];
    if let Some(other) = words.iter().position(|word| *word != words[0]) {
        words.swap(0, other);
    }
}

fn overwritten_cell(table: &mut Words) {
    let cells = table.cells();
    let mut taken = (0..cells.len()).filter(|&cell| cells[cell] != 0);
    if let (Some(first), Some(last)) = (taken.next(), taken.next_back()) {
        cells[first] = cells[last];
    }
}

fn unmarked(table: &mut Words) {
    let displacements = table.displacements;
    if let Some(word) = table.tables()[..displacements].iter_mut().find(|word| **word & MARK != 0) {
        *word &= !MARK;
    }
}

fn leaf_as_inner(table: &mut Words) {
    // From 0xC0000000 up: the complement of a leaf's index.
    if let Some(word) = table.tables().iter_mut().find(|word| **word >> 30 == 3) {
        *word = MARK | !*word;
    }
}

fn other_width(table: &mut Words) {
    // Keys that fit are told so.
    table.words[FLAGS] |= NARROW;
}

fn seed_not_stored(table: &mut Words) {
    table.words[FLAGS] &= !SEEDED;
    table.words[RESEEDS] = 0;
    table.words[SEED..SEED + 2].fill(0);
}

fn other_fold(table: &mut Words) {
    table.words[FOLD_SEED] ^= 1;
}

fn truncated(table: &mut Words) {
    table.words.pop();
}
