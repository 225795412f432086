use alloc::string::ToString;

use super::*;
use crate::generate::{Family, Rng};
use crate::hash::{Options, TableSize};
use crate::tree::Tree;

fn tree() -> Tree {
    Family::Catalan.tree(&mut Rng::new(7), 100)
}

fn table(key_set: KeySet, sizing: Sizing) -> PerfectHash {
    PerfectHash::build(&tree(), Options { key_set, sizing }).unwrap()
}

/// Returns the error for a planted fault.
fn refusal(key_set: KeySet, sizing: Sizing, plant: impl FnOnce(&mut PerfectHash)) -> CertificateError {
    let mut hash = table(key_set, sizing);
    assert_eq!(certify(&hash, &tree(), key_set), Ok(()));
    plant(&mut hash);
    certify(&hash, &tree(), key_set).unwrap_err()
}

/// Every wrong word is found. Each address is replaced by the next node's, and each displacement by the next one.
#[test]
fn any_word_that_is_changed_is_found() {
    for sizing in Sizing::ALL {
        let key_set = KeySet::Exact(Reach::ALGORITHM_1);
        let hash = table(key_set, sizing);
        let size = hash.header().cells.get();
        let shared = |i: usize| {
            let mut keys = 0;
            for_each_folded_key(&tree(), hash.header().fold_seed, |key, node| {
                let bucket = hash.header().mix.apply(key) as usize & (hash.displacements().len() - 1);
                keys += usize::from(bucket == i && key_set.slots(&tree())[node.index()]);
            });
            keys > 0
        };
        for (i, &word) in hash.displacements().iter().enumerate() {
            let other = if word >= 1 << 31 { word ^ 1 } else { (word + 1) % size };
            if word >= 1 << 31 || shared(i) {
                let error = refusal(key_set, sizing, |hash| hash.displacements[i] = other);
                assert!(matches!(error, CertificateError::Unresolved { .. }), "{sizing} displacement {i}: {error}");
            }
        }
        for (i, _) in hash.cells().iter().enumerate().filter(|&(_, &word)| word != 0) {
            let error = refusal(key_set, sizing, |hash| hash.cells[i] ^= 1);
            assert!(matches!(error, CertificateError::Unresolved { .. }), "{sizing} cell {i}: {error}");
        }
    }
}

#[test]
fn planted_faults_have_their_names() {
    use CertificateError as E;
    let exact = KeySet::Exact(Reach::ALGORITHM_1);
    let printed = Sizing::PrintedHashed;
    let hash = table(exact, printed);
    let header = *hash.header();
    let odd = |size| TableSize::new(size).unwrap();

    assert_eq!(certify(&hash, &tree(), KeySet::Paper), Err(E::KeySet { stated: exact }));
    let sibling = |hash: &mut PerfectHash| hash.header.key_set = KeySet::All;
    assert_eq!(refusal(exact, printed, sibling), E::KeySet { stated: KeySet::All });

    let field = |plant: fn(&mut PerfectHash)| match refusal(exact, printed, plant) {
        E::Header { field, .. } => field,
        error => panic!("{error}"),
    };
    assert_eq!(field(|hash| hash.header.keys += 1), "number of keys");
    assert_eq!(field(|hash| hash.header.direct += 1), "number of direct addresses");
    assert_eq!(field(|hash| hash.header.displacements *= 2), "number of displacements");
    assert_eq!(field(|hash| hash.header.mix.narrow ^= true), "whether keys fit 32 bits");
    assert_eq!(field(|hash| hash.header.reseeds = u32::from(hash.header.reseeds == 0)), "whether seeds were tried");
    assert_eq!(field(|hash| hash.header.sizing = Sizing::Printed), "D");
    assert_eq!(field(|hash| hash.cells = hash.cells[1..].into()), "number of cells");
    assert_eq!(field(|hash| *hash.cells.iter_mut().find(|word| **word == 0).unwrap() = !0), "number of addresses");
    let larger = |hash: &mut PerfectHash| {
        hash.header.cells = TableSize::new(hash.header.cells.get() + 2).unwrap();
        hash.cells = [&hash.cells[..], &[0, 0]].concat().into();
    };
    assert_eq!(field(larger), "H");

    let cells = header.cells.get() + 1;
    let even = E::NotCoprime { displacements: header.displacements, cells };
    assert_eq!(refusal(exact, printed, |hash| hash.header.cells = odd(cells)), even);
    let three = E::NotCoprime { displacements: 3, cells: cells - 1 };
    assert_eq!(refusal(exact, printed, |hash| hash.header.displacements = 3), three);

    let free = hash.cells().iter().position(|&word| word == 0).unwrap();
    let low = E::Word { in_cells: true, index: free, word: 5 };
    assert_eq!(refusal(exact, printed, |hash| hash.cells[free] = 5), low);
    let displacement = hash.displacements().iter().position(|&word| word < 1 << 31).unwrap();
    // Cells from H on.
    for word in [cells - 1, cells, (1 << 31) - 1] {
        let high = E::Word { in_cells: false, index: displacement, word };
        assert_eq!(refusal(exact, printed, |hash| hash.displacements[displacement] = word), high);
    }
    assert_eq!(low.to_string(), format!("cell {free} holds 0x00000005, which is out of range"));
}

/// Compares the definitions of the sets in the certificate with the construction's single number.
#[test]
fn sets_by_definition_are_sets_by_height() {
    let mut rng = Rng::new(1);
    for i in 0..3000 {
        let tree = Family::ALL[i % 6].tree(&mut rng, 1 + i as u32 % 60);
        let reaches = (1..=3).flat_map(|inner| (1..=3).filter_map(move |leaf| Reach::new(inner, leaf)));
        for key_set in reaches.map(KeySet::Exact).chain([KeySet::All, KeySet::Paper]) {
            assert_eq!(hashed_slots(&tree, key_set), key_set.slots(&tree), "{key_set:?} {:?}", tree.to_children());
        }
    }
}

/// A power of two below half of n is not half of n.
#[test]
fn sizes_of_a_power_of_two_of_keys_are_certified() {
    let (mut rng, mut powers) = (Rng::new(3), 0);
    for i in 0..400 {
        let tree = Family::ALL[i % 6].tree(&mut rng, 1 + i as u32 % 30);
        let key_set = KeySet::Exact(Reach::ALGORITHM_1);
        let hash = PerfectHash::build(&tree, Options { key_set, sizing: Sizing::PrintedHashed }).unwrap();
        assert_eq!(certify(&hash, &tree, key_set), Ok(()));
        powers += u32::from(hash.header().keys > 2 && hash.header().keys.is_power_of_two());
    }
    assert!(powers > 9, "{powers}");
}
