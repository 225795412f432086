use super::*;
use crate::hash::{AddressBounds, certify};
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

/// A node with two leaves, at addresses of its own.
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

/// Folds that meet are made to: a few seeds in whose place all long keys fold to the same number.
#[test]
fn another_fold_where_two_meet() {
    let inner = |i: u32| [2 * i + 1, 2 * i + 2];
    let children: Vec<_> = (0..100).flat_map(|i| [Some(inner(i)), None]).chain([None]).collect();
    let tree = Tree::new(&children).unwrap();
    let options = Options { key_set: KeySet::Exact(Reach::ALGORITHM_1), sizing: Sizing::Tight };
    let (good, bad) = (seed(3), |fold_seed| fold_seed != seed(3));
    let keys = |fold_seed| {
        let mut keys = hashed_keys(&tree, options.key_set, fold_seed);
        keys.iter_mut().filter(|key| bad(fold_seed) && key.key >> 40 != 0).for_each(|key| key.key = 1 << 50);
        keys
    };
    let hash = with_fold_seeds(&tree, options, keys, |request| remedied(request, false)).unwrap();
    assert_eq!(hash.header().fold_seed, good);
    assert_eq!(certify(&hash, &tree, options.key_set), Ok(()));
    let all = Keys::of(&tree);
    let hashed = options.key_set.slots(&tree);
    for slot in (0..tree.node_count()).filter(|&slot| hashed[slot]) {
        assert_eq!(hash.probe(&all.key::<Grow>(slot)), tree.node(slot as u32));
        assert_eq!(hash.probe(&all.key::<u128>(slot)), tree.node(slot as u32));
    }
    let never = |_| keys(0);
    let none = with_fold_seeds(&tree, options, never, |request| remedied(request, false));
    assert_eq!(none, Err(BuildError::NoSeed { seeds: SEEDS }));
}
