use glam::Vec3;

use super::*;
use crate::bvh::Primitives;
use crate::generate::procedural;
use crate::geom::Aabb;

/// Sum over both sides of half area times count, the items being divided by this many along this axis.
fn weight(items: &[Item], axis: usize, left: usize) -> f32 {
    let mut sorted = items.to_vec();
    sorted.sort_by(|a, b| a.centroid()[axis].total_cmp(&b.centroid()[axis]));
    let side = |side: &[Item]| Extents::of(side).boxes.half_area() * side.len() as f32;
    side(&sorted[..left]) + side(&sorted[left..])
}

fn check<const N: usize>(items: &[Item]) {
    let all = (0..3).flat_map(|axis| (1..items.len()).map(move |left| (axis, left)));
    let least = all.map(|(axis, left)| weight(items, axis, left)).fold(f32::INFINITY, f32::min);
    let sweep = Sweep::<N>::new(items).expect("a cut");
    assert!((sweep.weight() - least).abs() <= 1e-5 * least, "{} {least}", sweep.weight());
    let mut parted = items.to_vec();
    let Cut { axis, left, extents } = sweep.part(&mut parted);
    assert!(parted.is_sorted_by(|a, b| a.centroid()[axis] <= b.centroid()[axis]));
    assert_eq!(sweep.greater(), left.max(items.len() - left));
    for (side, extents) in [&parted[..left], &parted[left..]].into_iter().zip(extents) {
        assert_eq!(extents.boxes.aabb(), side.iter().fold(Aabb::EMPTY, |all, item| all.union(item.spread().aabb())));
    }
    let prims = |items: &[Item]| {
        let mut prims: Vec<_> = items.iter().map(Item::prim).collect();
        prims.sort_unstable();
        prims
    };
    assert_eq!(prims(&parted), prims(items));
}

#[test]
fn no_cut_is_cheaper() {
    for seed in 0..200 {
        let n = 2 + seed as usize % 15;
        let mesh = procedural::soup(seed, n);
        let items: Vec<_> = (0..n).map(|i| Item::new(&mesh.aabb(i), i as u32)).collect();
        check::<16>(&items);
        if n <= 8 {
            check::<8>(&items);
        }
        if n <= 4 {
            check::<4>(&items);
        }
    }
}

#[test]
fn items_without_a_middle_are_kept() {
    let item = |lo: f32, hi: f32, prim| Item::new(&Aabb { lo: Vec3::splat(lo), hi: Vec3::splat(hi) }, prim);
    let items = [item(0.0, 0.0, 0), item(f32::NEG_INFINITY, f32::INFINITY, 1), item(1.0, 1.0, 2)];
    let mut places: Vec<_> = ranks::<4>(&items)[..3].iter().map(|ranks| ranks[0]).collect();
    places.sort_unstable();
    assert_eq!(places, [0, 1, 2]);
}
