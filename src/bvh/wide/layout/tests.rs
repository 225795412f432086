use super::*;
use crate::generate::draw::Draw;

/// Assigns the best pairs first, out of all pairs.
fn expected(boxes: &[Aabb]) -> Vec<u32> {
    let middle = boxes.iter().copied().fold(Aabb::EMPTY, Aabb::union).centroid();
    let toward = |slot: u32| Vec3::from([0, 1, 2].map(|axis| if slot >> axis & 1 == 1 { 1.0 } else { -1.0 }));
    let pair = |child: usize, slot: u32| ((boxes[child].centroid() - middle).dot(toward(slot)), child, slot);
    let mut pairs: Vec<_> = (0..boxes.len()).flat_map(|child| (0..8).map(move |slot| pair(child, slot))).collect();
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut slots = vec![u32::MAX; boxes.len()];
    for (_, child, slot) in pairs {
        if slots[child] == u32::MAX && !slots.contains(&slot) {
            slots[child] = slot;
        }
    }
    slots
}

#[test]
fn the_best_pairs_come_first() {
    let mut draw = Draw::new(3);
    for round in 0..2000 {
        let boxes: Vec<_> = (0..2 + round % 7)
            .map(|_| {
                let lo = draw.centred();
                Aabb { lo, hi: lo + draw.centred().abs() }
            })
            .collect();
        assert_eq!(assign::<8>(&boxes)[..boxes.len()], expected(&boxes));
    }
    // Equal boxes and boxes without a centroid get separate slots.
    let all = Aabb { lo: Vec3::NEG_INFINITY, hi: Vec3::INFINITY };
    for aabb in [all, Aabb { lo: Vec3::ZERO, hi: Vec3::ONE }, Aabb { lo: Vec3::MIN, hi: Vec3::MIN }] {
        let mut slots = assign::<8>(&[aabb; 8]);
        slots.sort_unstable();
        assert_eq!(slots, [0, 1, 2, 3, 4, 5, 6, 7]);
    }
}
