use super::*;
use crate::generate::Family;
use crate::hash::{AddressBounds, Mix, certify};
use crate::key::Grow;
use crate::tree::{Keys, Reach, Tree};

#[test]
fn sizes_as_printed_and_tight() {
    for n in 0..2000_usize {
        let below_half = (0..12).map(|i| 1_usize << i).filter(|&power| 2 * power < n).max().unwrap_or(1);
        assert_eq!(highest_power_below_half(n), below_half, "{n}");
        let nearest = (0..13).map(|i| 1_usize << i).min_by(|a, b| {
            let quotient = |power: usize| (power as f64 / n.max(1) as f64).ln().abs();
            quotient(*a).total_cmp(&quotient(*b))
        });
        assert_eq!(Some(nearest_power(n)), nearest, "{n}");
    }
    let size = |n| odd_above_twice(n).ok().map(TableSize::get);
    assert_eq!(size(0), Some(1));
    assert_eq!(size(63), Some(127));
    assert_eq!(size((1 << 30) - 1), Some((1 << 31) - 1));
    assert_eq!(size(1 << 30), None);
}

/// A node with two leaves, at custom addresses.
struct Three {
    inner: u32,
    leaf: u32,
}

impl Topology for Three {
    fn root(&self) -> Node {
        Node::inner(self.inner)
    }

    fn children(&self, _: Node) -> [Node; 2] {
        [self.leaf, self.leaf - 1].map(Node::leaf)
    }

    fn node_count(&self) -> usize {
        3
    }

    fn slot(&self, node: Node) -> usize {
        usize::from(node.is_leaf()) * (1 + self.leaf as usize - node.index())
    }

    fn depth(&self) -> u32 {
        1
    }
}

#[test]
fn indices_of_thirty_bits_and_no_more() {
    let last = (1 << 30) - 1;
    for sizing in Sizing::ALL {
        let options = Options { key_set: KeySet::All, sizing };
        let build = |inner, leaf| PerfectHash::build(&Three { inner, leaf }, options);
        let hash = build(last, last).unwrap();
        assert_eq!(hash.probe(&1_u32), Some(Node::inner(last)));
        assert_eq!(hash.probe(&2_u32), Some(Node::leaf(last)));
        assert_eq!(hash.probe(&3_u32), Some(Node::leaf(last - 1)));
        assert_eq!(certify(&hash, &Three { inner: last, leaf: last }, KeySet::All), Ok(()));
        let bounds = AddressBounds::of(&Three { inner: last, leaf: last });
        assert_eq!(PerfectHash::from_bytes(&hash.to_bytes(), bounds).as_ref(), Ok(&hash));
        let (inner, leaf) = (Node::inner(last + 1), Node::leaf(last + 1));
        assert_eq!(build(last + 1, 7), Err(BuildError::TooManyNodes { node: inner }));
        assert_eq!(build(7, last + 1), Err(BuildError::TooManyNodes { node: leaf }));
        assert!(build(last + 1, 7).unwrap_err().to_string().starts_with("inner 1073741824: tables address at most"));
    }
}

/// Collisions of folds are forced: with some seeds, all long keys fold to the same number.
#[test]
fn another_fold_where_two_meet() {
    let tree = Family::comb(100, |_| true);
    let options = Options { key_set: KeySet::Exact(Reach::ALGORITHM_1), sizing: Sizing::Tight };
    let (good, bad) = (seed(3), |fold_seed| fold_seed != seed(3));
    let keys = |fold_seed| {
        let mut keys = hashed_keys(&tree, options.key_set, fold_seed);
        keys.iter_mut().filter(|key| bad(fold_seed) && key.key >> 40 != 0).for_each(|key| key.key = 1 << 50);
        keys
    };
    let hash = with_fold_seeds(Size::of(&tree), options, keys, |request| remedied(request, false)).unwrap();
    assert_eq!(hash.header().fold_seed, good);
    assert_eq!(certify(&hash, &tree, options.key_set), Ok(()));
    let all = Keys::of(&tree);
    let hashed = options.key_set.slots(&tree);
    for slot in (0..tree.node_count()).filter(|&slot| hashed[slot]) {
        assert_eq!(hash.probe(&all.key::<Grow>(slot)), tree.node(slot as u32));
        assert_eq!(hash.probe(&all.key::<u128>(slot)), tree.node(slot as u32));
    }
    let never = |_| keys(0);
    let none = with_fold_seeds(Size::of(&tree), options, never, |request| remedied(request, false));
    assert_eq!(none, Err(BuildError::NoSeed { seeds: SEEDS }));
}

/// [HASH-9]
#[test]
fn keys_of_64_bits_are_whole_and_those_of_65_are_folded() {
    for depth in [62, 63, 64, 65, 130] {
        let tree = comb(depth);
        let options = Options { key_set: KeySet::All, sizing: Sizing::Tight };
        let hash = PerfectHash::build(&tree, options).unwrap();
        assert_eq!(PerfectHash::build_parallel(&tree, options).as_ref(), Ok(&hash), "{depth}");
        assert_eq!(certify(&hash, &tree, options.key_set), Ok(()), "{depth}");
        let keys = Keys::of(&tree);
        for slot in 0..tree.node_count() {
            assert_eq!(hash.probe(&keys.key::<Grow>(slot)), tree.node(slot as u32), "{depth}");
        }
    }
}

#[test]
fn tight_tables_grow_where_keys_clash() {
    let keys = |keys: &[u64]| keys.iter().map(|&key| HashedKey { key, ..HashedKey::NONE }).collect::<Vec<_>>();
    let sizes = |list: &[u64]| tight(&keys(list)).ok().map(|(buckets, cells)| (buckets.size(), cells.get()));
    // Both keys are in bucket 1 of 4. They are equal modulo 5, but not modulo 7, the odd number above 2 (5 * 9 / 16 +
    // 1).
    assert_eq!(sizes(&[1, 3]), Some((4, 1)));
    assert_eq!(sizes(&[1, 5]), Some((4, 5)));
    assert_eq!(sizes(&[1, 21]), Some((4, 7)));
    assert_eq!(sizes(&(0..100).collect::<Vec<_>>()), Some((256, 1)));
}

/// The first numbers of `SplitMix64` with seed 0, printed by its authors' program.
#[test]
fn the_mix_is_the_finaliser_of_splitmix64() {
    let states = (1..=3_u64).map(|i| i.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let expected = [0xe220_a839_7b1d_cdaf, 0x6e78_9e6a_a1b9_65f4, 0x06c4_5d18_8009_454f];
    assert_eq!(states.map(mix).collect::<Vec<_>>(), expected);
    // The 32-bit mix, by its author's formula.
    let narrow = Mix { narrow: true, seed: Some(0) };
    assert_eq!([1, 2, 0xdead_beef].map(|key| narrow.apply(key)), [0x6889_90c0, 0xd113_2181, 0xe628_c683]);
}

#[test]
fn tables_say_what_they_are() {
    let names = Sizing::ALL.map(|sizing| (sizing.name(), alloc::format!("{sizing:>9}")));
    let names = names.each_ref().map(|(name, text)| (*name, text.as_str()));
    assert_eq!(names, [("printed", "  printed"), ("printed-hashed", "printed-hashed"), ("tight", "    tight")]);
    let (tree, other) = (comb(40), comb(41));
    let keys = Keys::of(&tree);
    for (key_set, sizing) in [KeySet::All, KeySet::Paper].into_iter().flat_map(|set| Sizing::ALL.map(|s| (set, s))) {
        let options = Options { key_set, sizing };
        let hash = PerfectHash::build(&tree, options).unwrap();
        assert_ne!(hash, PerfectHash::build(&other, options).unwrap());
        let (header, hashed) = (hash.header(), key_set.slots(&tree));
        let keys = (0..tree.node_count()).filter(|&slot| hashed[slot]).map(|slot| keys.key::<u64>(slot));
        let direct = keys.filter(|key| {
            let lead = header.mix.apply(*key) % u64::from(header.displacements);
            let is_direct = hash.displacements()[lead as usize] >> 31 == 1;
            assert_eq!(hash.is_direct(key), is_direct);
            is_direct
        });
        assert_eq!(direct.count(), header.direct as usize);
        let share = f64::from(header.direct) / f64::from(header.keys);
        assert!(header.direct > 0 && header.direct < header.keys && header.direct_share() == share);
    }
    let leaf = Tree::new(&[None]).unwrap();
    let empty = PerfectHash::build(&leaf, Options { key_set: KeySet::Paper, sizing: Sizing::Tight }).unwrap();
    assert_eq!((empty.header().keys, empty.header().direct_share()), (0, 1.0));
}

fn comb(depth: u32) -> Tree {
    Family::comb(depth, |i| i.is_multiple_of(3))
}

#[test]
fn lookups_and_misses_are_counted() {
    use crate::hash::{Lookup, Verified};
    let tree = comb(10);
    let keys = Keys::of(&tree);
    let hash = PerfectHash::build(&tree, Options { key_set: KeySet::All, sizing: Sizing::Tight }).unwrap();
    let verified = Verified::new(&hash, &tree, &keys);
    assert_eq!((verified.lookups(), verified.misses()), (0, 0));
    for slot in 0..5 {
        assert_eq!(Some(verified.node(&keys.key::<u64>(slot))), tree.node(slot as u32));
    }
    assert_eq!((verified.lookups(), verified.misses()), (5, 0));
    // No node has this key.
    assert_eq!(verified.node(&(1_u64 << 40)), tree.root());
    assert_eq!((verified.lookups(), verified.misses()), (6, 1));
}

#[test]
fn given_tables_answer_as_those_that_were_built() {
    let tree = comb(40);
    let (keys, hash) =
        (Keys::of(&tree), PerfectHash::build(&tree, Options { key_set: KeySet::All, sizing: Sizing::Tight }).unwrap());
    let (cells, displacements, mix) = (hash.cells(), hash.displacements(), hash.header().mix);
    let given = |displacements: &[u32], cells: &[u32]| PerfectHash::given(displacements.into(), cells.into(), mix);
    let same = given(displacements, cells).expect("tables that were built");
    for slot in 0..tree.node_count() {
        let key = keys.key::<u64>(slot);
        assert_eq!(same.probe(&key), hash.probe(&key));
    }
    // D is not a power of two, there are no cells, and a displacement is not below their number.
    assert_eq!(given(&displacements[1..], cells), None);
    assert_eq!(given(displacements, &[]), None);
    let size = cells.len() as u32;
    let with = |word: u32| given(&[&[word], &displacements[1..]].concat(), cells).is_some();
    assert_eq!([size - 1, size, u32::MAX].map(with), [true, false, true]);
}
