//! Level `hash`.

use serde_json::{Value, json};

use super::table::{Sizes, Table, half, mix_64, mixed};
use super::trees::{comb, complete, depth_of, depths};
use super::{Author, result};
use crate::ask::{Build, LookupTable};
use crate::bits::Bits;
use crate::{Ask, Children, Expect, Level, Profile};
use stackless_bvh::generate::{Family, Rng, Source};

pub(super) fn profiles() -> Vec<Profile> {
    vec![function(), fold(), address(), keys(), lookup(), build(), build_deep()]
}

const SIGN: u32 = 1 << 31;

/// Returns the hashed keys in ascending order, each with the word of its node. Long keys are folded with a seed, which
/// short keys ignore.
pub(crate) fn keys_of(children: &Children, reach: Option<[u32; 2]>, seed: u64) -> Vec<(u64, u32)> {
    let word = |node: u32| if children[node as usize].is_some() { SIGN | node } else { !node };
    let hashed = hashed(children, reach).into_iter();
    let mut hashed: Vec<_> = hashed.map(|(key, node)| (folded(&key, seed), word(node))).collect();
    hashed.sort_unstable();
    hashed
}

/// Returns whether a key of more than 64 bits is hashed.
pub(crate) fn folds(children: &Children, reach: Option<[u32; 2]>) -> bool {
    hashed(children, reach).iter().any(|(key, _)| key.0.len() > 64)
}

/// Returns the hashed keys with their nodes: the keys of a reach (HASH-3, first sentence), or all keys.
fn hashed(children: &Children, reach: Option<[u32; 2]>) -> Vec<(Bits, u32)> {
    let depths = depths(children);
    let mut keys = vec![(Bits::root(), 0_u32, None)];
    let mut at = 0;
    while let Some((key, node, _)) = keys.get(at) {
        if let Some([left, right]) = children[*node as usize] {
            let below = [(key.clone().then(false), left, Some(right)), (key.clone().then(true), right, Some(left))];
            keys.extend(below);
        }
        at += 1;
    }
    let is_hashed = |sibling: Option<u32>| match (reach, sibling) {
        (None, _) => true,
        (Some(_), None) => false,
        (Some([inner, leaf]), Some(sibling)) => subtree(children, sibling).any(|node| {
            let below = depths[node as usize] - depths[sibling as usize];
            below > if children[node as usize].is_some() { inner } else { leaf }
        }),
    };
    keys.into_iter().filter(|&(.., sibling)| is_hashed(sibling)).map(|(key, node, _)| (key, node)).collect()
}

/// Folds a key. Keys of up to 64 bits do not change. The pieces of longer keys are mixed from the root down, then the
/// length. `[HASH-6]`
fn folded(key: &Bits, seed: u64) -> u64 {
    let number = |bits: &[bool]| bits.iter().fold(0, |number, &bit| 2 * number + u64::from(bit));
    if key.0.len() <= 64 {
        return number(&key.0);
    }
    let pieces = key.0.chunks(63).map(number).chain([key.0.len() as u64]);
    pieces.fold(seed, |folded, piece| mix_64(piece, folded))
}

fn subtree(children: &Children, top: u32) -> impl Iterator<Item = u32> {
    let mut pending = vec![top];
    std::iter::from_fn(move || {
        let node = pending.pop()?;
        pending.extend(children[node as usize].into_iter().flatten());
        Some(node)
    })
}

fn function() -> Profile {
    let mut author = Author::new(Level::Hash, "function");
    let mut rng = Rng::new(1);
    let sizes = [(1, 1), (1, 3), (4, 27), (16, 127), (64, 255), (1 << 20, (1 << 21) + 1), (1 << 30, (1 << 31) - 1)];
    for (displacements, cells) in sizes {
        let last = cells - 1;
        let keys = [1, 22, u64::from(cells), u64::from(u32::MAX), u64::MAX, rng.bits() | 1 << 63];
        for (i, key) in keys.into_iter().enumerate() {
            for (name, displacement) in [("zero", 0), ("last", last), ("random", rng.below(u64::from(cells)) as u32)] {
                let cell = (u128::from(key) + u128::from(displacement)) % u128::from(cells);
                let answer = result([("bucket", json!(key % u64::from(displacements))), ("cell", json!(cell as u64))]);
                let ask = Ask::Cell { key: format!("{key:x}"), displacements, cells, displacement };
                let why = "The key is reduced before the displacement is added: the sum would overflow.";
                author.case(&format!("cell-{displacements}-{cells}-{i}-{name}"), &["HASH-1"], why, &ask, answer);
            }
        }
    }
    for i in 0..12 {
        let (wide, seed) = (rng.bits() >> (4 * i), rng.bits());
        for bits in [32, 64] {
            let key = if bits == 32 { wide & u64::from(u32::MAX) } else { wide };
            let mixed = mixed(key, seed, bits == 32);
            let ask = Ask::Mix { key: format!("{key:x}"), seed: format!("{seed:x}"), bits };
            let answer = result([("key", Value::String(format!("{mixed:x}")))]);
            author.case(&format!("mix-{bits}-{i}"), &["HASH-7"], "A bijection, chosen by a seed.", &ask, answer);
        }
    }
    author.done()
}

fn fold() -> Profile {
    let mut author = Author::new(Level::Hash, "fold");
    let mut rng = Rng::new(2);
    for length in [1, 63, 64, 65, 66, 126, 127, 128, 189, 190, 300] {
        let below = |bit: bool| vec![bit; length - 1];
        let random = (1..length).map(|_| rng.coin()).collect();
        for (name, below) in [("left", below(false)), ("right", below(true)), ("random", random)] {
            let (key, seed) = (Bits([vec![true], below].concat()), if name == "random" { rng.bits() } else { 0 });
            let answer = result([("key", Value::String(format!("{:x}", folded(&key, seed))))]);
            let why =
                if length > 64 { "Longer than 64 bits: pieces of 63, and the length." } else { "Short: as it is." };
            let ask = Ask::Fold { key: key.hex(), seed: format!("{seed:x}") };
            author.case(&format!("{name}-{length}"), &["HASH-6"], why, &ask, answer);
        }
    }
    author.done()
}

fn address() -> Profile {
    let mut author = Author::new(Level::Hash, "address");
    for index in [0, 1, 5, 0x1234_5678, (1 << 30) - 2, (1 << 30) - 1] {
        for leaf in [false, true] {
            let word = if leaf { !index } else { SIGN | index };
            let kind = if leaf { "leaf" } else { "inner" };
            let answer = result([("word", Value::String(format!("{word:x}")))]);
            let why = "The top bit marks an address; a leaf's is inverted.";
            author.case(&format!("encode-{kind}-{index}"), &["HASH-5"], why, &Ask::Encode { leaf, index }, answer);
            let answer = result([("leaf", json!(leaf)), ("index", json!(index))]);
            let why = "Bit 30, extended over the sign, tells leaves from inner nodes.";
            let ask = Ask::Decode { word: format!("{word:x}") };
            author.case(&format!("decode-{kind}-{index}"), &["HASH-5"], why, &ask, answer);
        }
    }
    for displacement in [0, 1, 126, i32::MAX as u32] {
        let ask = Ask::Decode { word: format!("{displacement:x}") };
        let answer = result([("displacement", json!(displacement))]);
        author.case(&format!("decode-displacement-{displacement}"), &["HASH-5"], "The top bit is clear.", &ask, answer);
    }
    author.done()
}

/// Trees with and without keys to hash.
fn trees() -> Vec<(String, Children)> {
    let mut trees = vec![("leaf".to_owned(), vec![None])];
    for depth in [1, 2, 3, 4, 5, 8, 31, 32, 63] {
        trees.push((format!("comb-left-{depth}"), comb(depth, |_| false)));
        trees.push((format!("comb-right-{depth}"), comb(depth, |_| true)));
        trees.push((format!("comb-turns-{depth}"), comb(depth, |level| level % 2 == 0)));
    }
    for depth in [2, 3, 4, 6] {
        trees.push((format!("complete-{depth}"), complete(depth)));
    }
    for seed in 0..12 {
        let mut rng = Rng::new(seed);
        let family = Family::ALL[seed as usize % Family::ALL.len()];
        trees.push((format!("random-{family}-{seed}"), family.tree(&mut rng, 8 + 2 * seed as u32).to_children()));
    }
    trees
}

const REACHES: [[u32; 2]; 4] = [[1, 1], [1, 2], [2, 2], [2, 3]];

/// Reaches where only inner nodes decide, or only leaves.
const UNEVEN: [[u32; 2]; 3] = [[1, 3], [3, 1], [3, 3]];

fn keys() -> Profile {
    let mut author = Author::new(Level::Hash, "keys");
    for (name, children) in trees() {
        let uneven = if (3..=8).contains(&depth_of(&children)) { &UNEVEN[..] } else { &[] };
        for &reach in REACHES.iter().chain(uneven) {
            let keys: Vec<_> = keys_of(&children, Some(reach), 0).iter().map(|(key, _)| format!("{key:x}")).collect();
            let why = "Those that neither register nor record can name, somewhere below their sibling.";
            let ask = Ask::HashedKeys { children: children.clone(), reach };
            let name = format!("{name}-reach-{}-{}", reach[0], reach[1]);
            author.case(&name, &["HASH-3"], why, &ask, result([("keys", json!(keys))]));
        }
    }
    author.done()
}

fn lookup() -> Profile {
    let mut author = Author::new(Level::Hash, "lookup");
    for (name, children) in trees() {
        let is_narrow = depth_of(&children) < 32;
        for (set, reach) in [("all", None), ("few", Some([2, 3]))] {
            let keys = keys_of(&children, reach, 0);
            for (name_of_sizes, sizes) in Sizes::of(children.len(), keys.len()) {
                let Some(table) = Table::of(&keys, sizes, is_narrow).filter(|_| !keys.is_empty()) else { continue };
                let words = |words: &[u32]| words.iter().map(|word| format!("{word:x}")).collect();
                let ask = Ask::Lookup(LookupTable {
                    displacements: words(&table.displacements),
                    cells: words(&table.cells),
                    seed: table.seed.map(|seed| format!("{seed:x}")),
                    bits: table.seed.map(|_| if is_narrow { 32 } else { 64 }),
                    keys: keys.iter().map(|(key, _)| format!("{key:x}")).collect(),
                });
                let answer: Vec<_> = keys.iter().map(|(_, word)| format!("{word:x}")).collect();
                let (clauses, why): (&[_], _) = if table.seed.is_some() {
                    (&["HASH-1", "HASH-5", "HASH-7"], "Keys go through the seeded bijection first.")
                } else {
                    (&["HASH-1", "HASH-5"], "A direct address, or the cell of the sum.")
                };
                author.case(
                    &format!("{name}-{set}-{name_of_sizes}"),
                    clauses,
                    why,
                    &ask,
                    result([("words", json!(answer))]),
                );
            }
        }
    }
    for bits in [32, 64] {
        author.case(
            &format!("seed-0-{bits}"),
            &["HASH-1", "HASH-5", "HASH-7"],
            "A seed of 0 is a seed.",
            &Ask::Lookup(LookupTable { seed: Some("0".to_owned()), bits: Some(bits), ..of_seed_0(bits) }),
            result([("words", json!(["80000000", "fffffffe", "fffffffd"]))]),
        );
    }
    author.done()
}

/// Returns a table of direct addresses for the keys 1, 2, 3 with seed 0. It has the least size that separates the mixed
/// keys, and would not separate the unmixed ones.
fn of_seed_0(bits: u32) -> LookupTable {
    let keys = [1, 2, 3];
    let of_size = |size: u64| {
        let mut displacements = vec!["0".to_owned(); size as usize];
        let buckets = keys.map(|key| mixed(key, 0, bits == 32) % size);
        let is_apart = buckets[0] != buckets[1] && buckets[0] != buckets[2] && buckets[1] != buckets[2];
        for (bucket, word) in buckets.into_iter().zip(["80000000", "fffffffe", "fffffffd"]) {
            word.clone_into(&mut displacements[bucket as usize]);
        }
        (is_apart && buckets != keys).then_some(displacements)
    };
    let displacements = [4, 8, 16, 32].into_iter().find_map(of_size).unwrap_or_default();
    LookupTable {
        displacements,
        cells: vec!["0".to_owned()],
        keys: keys.map(|key| format!("{key:x}")).to_vec(),
        ..LookupTable::default()
    }
}

fn build() -> Profile {
    let mut author = Author::new(Level::Hash, "build");
    for (name, children) in trees() {
        for (set, reach) in [("all", None), ("few", Some([2, 3]))] {
            let ask = Ask::Build(Build { children: children.clone(), reach, sizes: None });
            let why = "Every key leads to its node, in a table of any size.";
            let clauses = ["HASH-1", "HASH-5", "HASH-7", "HASH-9"];
            author.case(&format!("{name}-{set}"), &clauses, why, &ask, Expect::Valid(true));
        }
        // The table sizes: D is the highest power of two below N/2, H = 2N + 1.
        let nodes = children.len() as u32;
        let sizes = [half(nodes as usize) as u32, 2 * nodes + 1];
        if is_inseparable(&keys_of(&children, None, 0), sizes) {
            let ask = Ask::Build(Build { children, reach: None, sizes: Some(sizes) });
            let why = "Two keys are equal modulo both sizes: no displacement separates them.";
            author.reject(&format!("{name}-printed"), &["HASH-1", "HASH-4"], why, &ask, "no-table");
        }
    }
    author.done()
}

/// Trees with keys of more than 64 bits.
fn build_deep() -> Profile {
    let mut author = Author::new(Level::Hash, "build-deep");
    for depth in [64, 65, 125, 126, 127, 200] {
        let combs = [
            ("left", comb(depth, |_| false)),
            ("right", comb(depth, |_| true)),
            ("turns", comb(depth, |i| i % 2 == 0)),
        ];
        for (name, children) in combs {
            for (set, reach) in [("all", None), ("few", Some([2, 3]))] {
                let ask = Ask::Build(Build { children: children.clone(), reach, sizes: None });
                let why = "Long keys are folded under a seed that keeps them apart, then each leads to its node.";
                author.case(
                    &format!("{name}-{depth}-{set}"),
                    &["HASH-6", "HASH-1", "HASH-9"],
                    why,
                    &ask,
                    Expect::Valid(true),
                );
            }
        }
    }
    author.done()
}

fn is_inseparable(keys: &[(u64, u32)], [displacements, cells]: [u32; 2]) -> bool {
    let rests: Vec<_> = keys.iter().map(|(key, _)| (key % u64::from(displacements), key % u64::from(cells))).collect();
    let distinct: std::collections::BTreeSet<_> = rests.iter().collect();
    distinct.len() < rests.len()
}
