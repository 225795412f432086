//! Which child is in which slot.

use glam::Vec3;

use crate::geom::Aabb;

/// A child that is to be placed.
pub(super) struct Child<T> {
    pub(super) aabb: Aabb,
    pub(super) source: T,
}

/// The slots of these children, at most `A`.
///
/// Of eight, so that `slot ^ octant` is about the order along a ray in that octant, octants being of the signs of
/// directions: each slot is a corner of the node, and children lie toward their slots. Ylitie et al. 2017, section 3.2,
/// with the best pairs first in place of an auction. Of four, in the given order.
pub(super) fn assign<const A: usize>(boxes: &[Aabb]) -> Vec<u32> {
    let mut slots: Vec<u32> = (0..boxes.len() as u32).collect();
    if A != 8 {
        return slots;
    }
    let middle = boxes.iter().copied().fold(Aabb::EMPTY, Aabb::union).centroid();
    let toward = |slot: u32| Vec3::from([0, 1, 2].map(|axis| if slot >> axis & 1 == 1 { 1.0 } else { -1.0 }));
    let pair = |child: usize, slot: u32| ((boxes[child].centroid() - middle).dot(toward(slot)), child, slot);
    let mut pairs: Vec<_> = (0..boxes.len()).flat_map(|child| (0..8).map(move |slot| pair(child, slot))).collect();
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (mut placed, mut taken) = (0_u32, 0_u32);
    for (_, child, slot) in pairs {
        if placed >> child & 1 == 0 && taken >> slot & 1 == 0 {
            slots[child] = slot;
            placed |= 1 << child;
            taken |= 1 << slot;
        }
    }
    slots
}
