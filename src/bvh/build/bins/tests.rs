use super::*;
use crate::bvh::Primitives;
use crate::generate::procedural;
use crate::geom::lanes::{levels, vectorize};

/// Returns the least weight of all borders, computed item by item.
fn least<const N: usize>(items: &[Record], centroids: &Planes) -> f32 {
    let mut least = f32::INFINITY;
    for axis in 0..3 {
        let (start, extent) = (centroids[axis], -(centroids[axis] + centroids[axis + 4]));
        let scale = N as f32 / extent;
        for border in 1..N {
            let (mut boxes, mut counts) = ([EMPTY; 2], [0; 2]);
            for item in items {
                let bin = ((item.centroid()[axis] - start) * scale - 0.5).round_ties_even();
                let side = usize::from(bin >= border as f32);
                (boxes[side], counts[side]) = (union(&boxes[side], item.planes()), counts[side] + 1);
            }
            if counts.iter().all(|&count| count > 0) {
                let weight = |side: usize| super::super::record::half_area(&boxes[side]) * counts[side] as f32;
                least = least.min(weight(0) + weight(1));
            }
        }
    }
    least
}

fn check<const N: usize>(items: &[Record]) {
    let mut found = Vec::new();
    for (name, level) in levels() {
        let mut items = items.to_vec();
        let [boxes, centroids] = vectorize!(level, simd => extents(simd, &items));
        let scale = Scale::new(&centroids, N);
        let bins = vectorize!(level, simd => Bins::<N>::of(simd, &items, &scale));
        for (axis, bin) in (0..3).flat_map(|axis| (1..N).map(move |bin| (axis, bin))) {
            let border = vectorize!(level, simd => bins.border(simd, axis, bin));
            let (left, _) = vectorize!(level, simd => border.part(simd, &mut items.clone(), &scale));
            assert_eq!(left, border.left, "{name} {axis} {bin}");
        }
        let border = vectorize!(level, simd => bins.cheapest(simd, items.len())).expect("a border");
        let (left, of_sides) = vectorize!(level, simd => border.part(simd, &mut items, &scale));
        assert_eq!(left, border.left, "{name}");
        let sides = items.split_at(left);
        let mut weight = 0.0;
        for (i, side) in [sides.0, sides.1].into_iter().enumerate() {
            let [boxes, centroids] = vectorize!(level, simd => extents(simd, side));
            for lane in [0, 1, 2, 4, 5, 6] {
                assert_eq!((boxes[lane], centroids[lane]), (border.boxes[i][lane], of_sides[i][lane]), "{name}");
            }
            weight += super::super::record::half_area(&boxes) * side.len() as f32;
        }
        let expected = least::<N>(&items, &centroids);
        assert!((weight - expected).abs() <= 1e-5 * expected, "{name}: {weight} {expected}");
        found.push((boxes, items.iter().map(Record::first).collect::<Vec<_>>()));
    }
    for (boxes, order) in &found {
        assert!(boxes[..3] == found[0].0[..3] && *order == found[0].1);
    }
}

#[test]
fn no_border_is_cheaper_and_items_go_to_their_sides() {
    for n in [9, 30, 63, 300, 2000] {
        let mesh = procedural::soup(n as u64, n);
        let items: Vec<_> = (0..n).map(|i| Record::item(&mesh.aabb(i), i as u32)).collect();
        check::<8>(&items);
        check::<16>(&items);
        check::<32>(&items);
    }
}

/// Centroids are at the borders, where rounding decides.
#[test]
fn halves_go_where_they_are_counted() {
    let items: Vec<_> = (0..65_u8)
        .map(|i| {
            let corner = glam::Vec3::new(f32::from(i), f32::from(i % 7), f32::from(i % 3));
            Record::item(&crate::geom::Aabb { lo: corner, hi: corner }, u32::from(i))
        })
        .collect();
    check::<8>(&items);
    check::<16>(&items);
    check::<32>(&items);
}
