use glam::Vec3;

use super::*;
use crate::generate::draw::Draw;
use crate::geom::Aabb;
use crate::geom::lanes::{levels, vectorize};

/// Checks boxes and counts below a pair, records its items, and returns the union of their boxes.
fn check(nodes: &[Record], pair: usize, seen: &mut Vec<u32>) -> Planes {
    let [left, right] = [nodes[pair], nodes[pair + 1]].map(|node| {
        if node.is_leaf() {
            seen.push(node.first());
            return *node.planes();
        }
        let (before, planes) = (seen.len(), check(nodes, node.first() as usize - 1, seen));
        assert_eq!(node.count() as usize, seen.len() - before);
        assert!(node.is_same(&Record::over(&planes, 0, node.count())));
        planes
    });
    union(&left, &right)
}

/// Returns the sum of half areas of all merges. Each merges the two clusters with the smallest union.
fn greedy(items: &[Record]) -> f32 {
    let (mut clusters, mut sum): (Vec<Planes>, f32) = (items.iter().map(|item| *item.planes()).collect(), 0.0);
    while clusters.len() > 1 {
        let pairs = (0..clusters.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
        let area = |&(a, b): &(usize, usize)| half_area(&union(&clusters[a], &clusters[b]));
        let (a, b) = pairs.min_by(|x, y| area(x).total_cmp(&area(y))).expect("two clusters");
        let both = union(&clusters[a], &clusters[b]);
        sum += half_area(&both);
        clusters.swap_remove(a);
        clusters[b] = both;
    }
    sum
}

#[test]
fn the_smallest_unions_are_merged_first_on_any_level() {
    let mut draw = Draw::new(5);
    for round in 0..2000 {
        let items: Vec<_> = (0..2 + round % (MAX as u32 - 1))
            .map(|prim| {
                let (lo, size) = (draw.centred(), draw.centred().abs() * 0.3);
                Record::item(&Aabb { lo, hi: lo + size + Vec3::splat(1e-3) }, prim)
            })
            .collect();
        let trees = levels().into_iter().map(|(_, level)| {
            let mut nodes = vec![Record::NONE; 2 * items.len() - 2];
            vectorize!(level, simd => merge(simd, &items, &mut nodes, 1));
            nodes
        });
        let trees: Vec<_> = trees.collect();
        let mut seen = Vec::new();
        let all = check(&trees[0], 0, &mut seen);
        seen.sort_unstable();
        assert!(seen.into_iter().eq(0..items.len() as u32));
        let inner = trees[0].iter().filter(|node| !node.is_leaf()).map(Record::half_area);
        let (sum, expected) = (inner.sum::<f32>() + half_area(&all), greedy(&items));
        assert!((sum - expected).abs() <= 1e-4 * expected, "{round}: {sum} {expected}");
        assert!(
            trees.iter().all(|nodes| nodes.iter().zip(&trees[0]).all(|(a, b)| a.is_same(b) && a.first() == b.first()))
        );
    }
}
