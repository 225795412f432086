use super::*;
use crate::bvh::Primitives;
use crate::generate::procedural;
use crate::geom::Aabb;

#[test]
fn bits_are_spread() {
    for bits in 0..1 << BITS {
        let apart = (0..BITS).map(|i| u64::from(bits >> i & 1) << (3 * i)).sum::<u64>();
        assert_eq!(spread(bits), apart);
    }
}

#[test]
fn radix_sort_sorts() {
    let mut state = 1_u64;
    let mut next = || {
        state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(1);
        state >> 31 & 0xf_00ff_ffff
    };
    for n in [0, 1, 2, 2047, 2048, 2049, 10_000] {
        let mut codes: Vec<_> = (0..n).map(|i| next() << INDEX_BITS | i).collect();
        let mut expected = codes.clone();
        expected.sort_unstable();
        radix_sort(&mut codes);
        assert_eq!(codes, expected);
    }
}

#[test]
fn clusters_cover_all_in_order_and_are_small() {
    let n = 5000;
    let mesh = procedural::soup(8, n);
    let items: Vec<_> = (0..n).map(|i| Item::new(&mesh.aabb(i), i as u32)).collect();
    let mut codes: Vec<_> = (0..n as u64).collect();
    sort(&items, &mut codes);
    assert!(codes.is_sorted());
    let mut clusters = Vec::new();
    cluster(&items, &mut codes, 0, &mut clusters);
    assert_eq!(clusters.iter().flat_map(Clone::clone).collect::<Vec<_>>(), (0..n).collect::<Vec<_>>());
    assert!(clusters.iter().all(|cluster| (1..=CLUSTER).contains(&cluster.len())));
    assert!(clusters.len() < n / 4, "{}", clusters.len());
}

/// So small that the number of cells over the extent overflows: cells are wider, but no item is sorted alone, again and
/// again.
#[test]
fn clusters_of_tiny_scenes_are_few() {
    let n = 5000;
    let mesh = procedural::soup(8, n);
    for size in [1e-35, 1e-36, 1e-37, 1e-38, 1e-40] {
        let smaller = |aabb: Aabb| Aabb { lo: aabb.lo * size, hi: aabb.hi * size };
        let items: Vec<_> = (0..n).map(|i| Item::new(&smaller(mesh.aabb(i)), i as u32)).collect();
        let mut codes: Vec<_> = (0..n as u64).collect();
        sort(&items, &mut codes);
        let mut clusters = Vec::new();
        cluster(&items, &mut codes, 0, &mut clusters);
        assert!(clusters.len() < n / 4, "{size:e}: {}", clusters.len());
    }
}
