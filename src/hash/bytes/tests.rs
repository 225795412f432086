use super::*;
use crate::generate::{Family, Rng, Source};
use crate::hash::{Options, certify};
use crate::tree::{Keys, Tree};

/// Offsets of the header's words.
const VERSION_AT: usize = 8;
const SET_AT: usize = 12;
const SIZING_AT: usize = 24;
const FLAGS_AT: usize = 28;
const KEYS_AT: usize = 32;
const DIRECT_AT: usize = 36;
const D_AT: usize = 40;
const H_AT: usize = 44;
const RESEEDS_AT: usize = 48;
const RESERVED_AT: usize = 52;
const SEED_AT: usize = 56;

fn tree() -> Tree {
    Family::Skew.tree(&mut Rng::new(2), 300)
}

fn table(tree: &Tree, sizing: Sizing) -> PerfectHash {
    PerfectHash::build(tree, Options { key_set: KeySet::All, sizing }).unwrap()
}

fn patched(bytes: &[u8], at: usize, word: u32) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    bytes[at..at + 4].copy_from_slice(&word.to_le_bytes());
    bytes
}

#[test]
fn tables_come_back() {
    let tree = tree();
    let keys = Keys::of(&tree);
    let sets = [KeySet::All, KeySet::Paper, KeySet::Exact(Reach::SECTION_2_1)];
    for (key_set, sizing) in sets.into_iter().flat_map(|set| Sizing::ALL.map(|sizing| (set, sizing))) {
        let hash = PerfectHash::build(&tree, Options { key_set, sizing }).unwrap();
        let bytes = hash.to_bytes();
        assert_eq!(bytes.len(), HEADER_BYTES + hash.header().bytes());
        let back = PerfectHash::from_bytes(&bytes, AddressBounds::of(&tree)).unwrap();
        assert_eq!(back, hash);
        assert_eq!(back.to_bytes(), bytes);
        certify(&back, &tree, key_set).unwrap();
        let hashed = key_set.slots(&tree);
        for slot in (0..tree.node_count()).filter(|&slot| hashed[slot]) {
            assert_eq!(back.probe(&keys.key::<u128>(slot)), tree.node(slot as u32));
        }
    }
}

#[test]
fn malformed_tables_are_refused_by_name() {
    use TableError as E;
    let tree = tree();
    let bounds = AddressBounds::of(&tree);
    let hash = table(&tree, Sizing::PrintedHashed);
    let (bytes, header) = (hash.to_bytes(), *hash.header());
    let (d, h) = (header.displacements, header.cells.get());
    let refuse = |bytes: &[u8], error: E| assert_eq!(PerfectHash::from_bytes(bytes, bounds), Err(error));
    let refuse_word = |at, word, error| refuse(&patched(&bytes, at, word), error);

    // Lengths, including absurd ones, that must not cause allocations.
    let expected = bytes.len() as u64;
    for found in [0, 1, HEADER_BYTES - 1] {
        refuse(&bytes[..found], E::Length { expected: HEADER_BYTES as u64, found });
    }
    for found in [HEADER_BYTES, bytes.len() - 4, bytes.len() - 1] {
        refuse(&bytes[..found], E::Length { expected, found });
    }
    refuse(&[&bytes[..], &[0]].concat(), E::Length { expected, found: bytes.len() + 1 });
    let absurd = |words: u64| E::Length { expected: expected + 4 * words, found: bytes.len() };
    refuse_word(D_AT, 1 << 31, absurd((1 << 31) - u64::from(d)));
    refuse_word(H_AT, (1 << 31) - 1, absurd((1 << 31) - 1 - u64::from(h)));

    refuse_word(0, 0, E::Magic);
    refuse_word(VERSION_AT, 2, E::Version { version: 2 });
    refuse_word(SET_AT, 3, E::Field { name: "set of keys", value: 3 });
    refuse_word(SET_AT + 4, 2, E::Field { name: "set of keys", value: 0 });
    refuse_word(SIZING_AT, 3, E::Field { name: "sizing", value: 3 });
    refuse_word(FLAGS_AT, 4, E::Field { name: "flags", value: 4 });
    refuse_word(
        RESEEDS_AT,
        u32::from(header.reseeds == 0),
        E::Field { name: "number of seeds", value: u32::from(header.reseeds == 0) },
    );
    refuse_word(RESERVED_AT, 1, E::Field { name: "reserved word", value: 1 });
    for displacements in [0, 3, d + 1, u32::MAX] {
        refuse_word(D_AT, displacements, E::Displacements { displacements });
    }
    for cells in [0, 2, h + 1, (1 << 31) + 1, u32::MAX] {
        refuse_word(H_AT, cells, E::Cells { cells });
    }
    let (keys, direct) = (header.keys, header.direct);
    refuse_word(KEYS_AT, keys + 1, E::Count { name: "keys", stated: keys + 1, found: keys as usize });
    refuse_word(DIRECT_AT, direct - 1, E::Count { name: "direct", stated: direct - 1, found: direct as usize });

    // Words of the tables. The tree numbers its inner nodes and leaves together, up to 598.
    let displacement = hash.displacements().iter().position(|&word| word < 1 << 31).unwrap();
    let address = hash.displacements().iter().position(|&word| word >= 1 << 31).unwrap();
    let first_cell = HEADER_BYTES + 4 * d as usize;
    let (full, empty) = (|&word: &u32| word != 0, |&word: &u32| word == 0);
    let [full, empty] = [hash.cells().iter().position(full), hash.cells().iter().position(empty)].map(Option::unwrap);
    refuse_word(HEADER_BYTES + 4 * displacement, h, E::Displacement { index: displacement, displacement: h });
    for word in [0x8000_0000 + 599, !599, 0xbfff_ffff, 0xc000_0000] {
        refuse_word(HEADER_BYTES + 4 * address, word, E::Address { in_cells: false, index: address, word });
        refuse_word(first_cell + 4 * full, word, E::Address { in_cells: true, index: full, word });
    }
    refuse_word(first_cell + 4 * full, 1, E::Address { in_cells: true, index: full, word: 1 });
    let more = E::Count { name: "keys", stated: keys, found: keys as usize + 1 };
    refuse_word(first_cell + 4 * empty, 0x8000_0000, more);
    assert_eq!(more.to_string(), "header: keys is 599, the tables hold 600");
}

#[test]
fn a_seed_that_nobody_tried_is_refused() {
    let tree = Tree::new(&[Some([1, 2]), None, None]).unwrap();
    let bytes = patched(&table(&tree, Sizing::Printed).to_bytes(), SEED_AT, 1);
    let error = TableError::Field { name: "number of seeds", value: 0 };
    assert_eq!(PerfectHash::from_bytes(&bytes, AddressBounds::of(&tree)), Err(error));
}

/// Any bytes are rejected, or give a table that answers every key with an address of the tree or none.
#[test]
fn no_bytes_make_a_lookup_panic() {
    let mut rng = Rng::new(4);
    let tree = Family::Catalan.tree(&mut rng, 40);
    let bounds = AddressBounds::of(&tree);
    let (mut accepted, mut refused) = (0, 0);
    for sizing in Sizing::ALL {
        let bytes = table(&tree, sizing).to_bytes();
        for _ in 0..20_000 {
            let mut bytes = bytes.clone();
            for _ in 0..=rng.below(3) {
                let at = rng.below(bytes.len() as u64) as usize;
                bytes[at] = if rng.coin() { rng.bits() as u8 } else { bytes[at] ^ 1 << rng.below(8) };
            }
            bytes.truncate(bytes.len() - if rng.below(10) == 1 { rng.below(9) as usize } else { 0 });
            let Ok(hash) = PerfectHash::from_bytes(&bytes, bounds) else {
                refused += 1;
                continue;
            };
            accepted += 1;
            for _ in 0..20 {
                let key = rng.bits() >> rng.below(64);
                assert!(hash.probe(&key).is_none_or(|node| bounds.contains(node)));
                assert!(hash.probe(&(u128::from(key) << 50)).is_none_or(|node| bounds.contains(node)));
            }
            let _ = certify(&hash, &tree, KeySet::All);
        }
    }
    assert!(accepted > 1000 && refused > 1000, "{accepted} {refused}");
}

#[test]
fn only_exact_sets_have_a_reach() {
    let tree = tree();
    for (key_set, value) in [(KeySet::All, 0), (KeySet::Paper, 1)] {
        let hash = PerfectHash::build(&tree, Options { key_set, sizing: Sizing::Tight }).unwrap();
        for (at, word) in [(SET_AT + 4, 1), (SET_AT + 8, 1), (SET_AT + 4, 4)] {
            let bytes = patched(&hash.to_bytes(), at, word);
            let error = TableError::Field { name: "set of keys", value };
            assert_eq!(PerfectHash::from_bytes(&bytes, AddressBounds::of(&tree)), Err(error));
        }
    }
}
