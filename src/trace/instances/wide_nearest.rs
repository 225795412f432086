//! The search for the nearest point in the wide hierarchy of a mesh.

use super::nearest::NearTest;
use crate::bvh::WideBvh;
use crate::geom::lanes::{LaneSet, Precision, filled};
use crate::geom::{Interval, Triangle, Vector};
use crate::trace::tracer::SharedQuery;
use crate::tree::Node;
use crate::wide::Wanted;

/// The visitor of a point, whose measure is in the precision of an assembly.
pub(super) struct WideNear<'s, V: Vector, W: Precision> {
    pub(super) bvh: &'s WideBvh<8, W>,
    pub(super) near: &'s mut dyn NearTest<Triangle<V>>,
}

impl<V: Vector + From<W>, W: Precision> SharedQuery for WideNear<'_, V, W> {
    fn ask(&mut self, node: Node) -> Wanted<[u32; 8]> {
        let (record, end) = (&self.bvh.nodes()[node.index()], self.end().to_bits());
        let (mut set, mut ranks) = (0, [0; 8]);
        for slot in (0..8).filter(|&slot| record.has_child(slot)) {
            let [least, _] = Interval::exact(self.near.to_box(&record.child_box(slot))).ends_in_single();
            // The last bits are the slot.
            let distance = least.to_bits() & !7;
            ranks[slot as usize] = distance | slot;
            set |= u32::from(distance <= end) << slot;
        }
        Wanted { set, ranks }
    }

    fn leaf(&mut self, leaf: Node) {
        let (blocks, count) = self.bvh.leaf(leaf);
        for (block, filled) in filled(blocks, count) {
            for lane in LaneSet(filled) {
                self.near.meet(&Triangle(block.triangle(lane).0.map(V::from)), block.prims[lane]);
            }
        }
    }

    fn end(&self) -> f32 {
        let [_, end] = Interval::exact(self.near.end()).ends_in_single();
        end
    }
}
