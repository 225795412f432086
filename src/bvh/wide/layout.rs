//! Assignment of children to slots.

use glam::Vec3;

use crate::geom::Aabb;

/// Returns the slots of these children, at most `A`.
///
/// For eight children, `slot ^ octant` is approximately the order along a ray in that octant, where octants are signs
/// of directions: each slot is a corner of the node, and children lie toward their slots. Ylitie et al. 2017, section
/// 3.2, with the best pairs first instead of an auction. For four children, the slots are in the given order.
pub(super) fn assign<const A: usize>(boxes: &[Aabb]) -> [u32; A] {
    let mut slots = std::array::from_fn(|slot| slot as u32);
    if A != 8 {
        return slots;
    }
    let middle = boxes.iter().copied().fold(Aabb::EMPTY, Aabb::union).centroid();
    // For each child without a slot, its best free slot, which is that of its signs until another child takes it.
    let mut children = [Seeker { apart: Vec3::ZERO, slot: 0, score: f32::NEG_INFINITY }; A];
    for (child, aabb) in children.iter_mut().zip(boxes) {
        *child = Seeker::new(aabb.centroid() - middle);
    }
    let mut taken = 0;
    for _ in boxes {
        let best =
            (1..A).fold(0, |best, other| if children[other].score > children[best].score { other } else { best });
        let slot = children[best].slot;
        slots[best] = slot;
        taken |= 1 << slot;
        children[best].score = f32::NEG_INFINITY;
        for other in children.iter_mut().filter(|other| other.slot == slot && other.score > f32::NEG_INFINITY) {
            other.seek(taken);
        }
    }
    slots
}

/// A child without a slot.
#[derive(Clone, Copy)]
struct Seeker {
    /// The offset from the center of the node.
    apart: Vec3,
    slot: u32,
    /// Its extent toward the slot.
    score: f32,
}

impl Seeker {
    fn new(apart: Vec3) -> Self {
        // A box without a center may be anywhere.
        let apart = Vec3::select(apart.cmpeq(apart), apart, Vec3::ZERO).clamp(Vec3::MIN / 8.0, Vec3::MAX / 8.0);
        let slot = apart.cmpgt(Vec3::ZERO).bitmask();
        Self { apart, slot, score: apart.abs().element_sum() }
    }

    fn seek(&mut self, taken: u32) {
        self.score = f32::NEG_INFINITY;
        for slot in (0..8).filter(|slot| taken >> slot & 1 == 0) {
            let toward =
                [0, 1, 2].map(|axis: usize| if slot >> axis & 1 == 1 { self.apart[axis] } else { -self.apart[axis] });
            let score = toward[0] + toward[1] + toward[2];
            if score > self.score {
                (self.slot, self.score) = (slot, score);
            }
        }
    }
}

#[cfg(test)]
mod tests;
