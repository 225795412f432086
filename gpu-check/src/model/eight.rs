//! The search of `eight/search_ray.wgsl`.

use stackless_bvh::geom::Ray;
use stackless_bvh::order::Flow;
use stackless_bvh::tree::Node;
use stackless_bvh::wide::{Method, Search, Tables, Topology as _, Wanted};

use super::{Found, OfRay};
use crate::kernel::SLOTS;
use crate::probe::Arithmetic;
use crate::scene::Eight;

/// The visits of a search through nodes of eight children.
#[derive(Clone, Copy, Debug, Default)]
pub struct Visited {
    /// Inner nodes, whose boxes are tested.
    pub nodes: usize,
    /// Leaves.
    pub leaves: usize,
    /// Triangles in the leaves, up to the triangle that ends the search.
    pub triangles: usize,
}

/// The closest or any hit of a ray, and the visits.
pub fn through(arithmetic: &Arithmetic, records: &Eight, ray: &Ray, any: bool) -> (Found, Visited) {
    let of = OfRay::new(arithmetic, ray);
    if any { run::<true>(of, records) } else { run::<false>(of, records) }
}

fn run<const ANY: bool>(of: OfRay<'_>, records: &Eight) -> (Found, Visited) {
    let mut search = Wide::<ANY> { of, records, visited: Visited::default() };
    // A stack supports any tree.
    let ran = Method::Stack.run(records.bvh(), &Tables::NONE, &mut search, &mut ());
    debug_assert_eq!(ran, Ok(()));
    (search.of.found, search.visited)
}

struct Wide<'a, const ANY: bool> {
    of: OfRay<'a>,
    records: &'a Eight,
    visited: Visited,
}

impl<const ANY: bool> Search<SLOTS> for Wide<'_, ANY> {
    const SORTED: bool = !ANY;
    type Ranks = [u32; SLOTS];

    fn ask(&mut self, node: Node) -> Wanted<Self::Ranks> {
        self.visited.nodes += 1;
        let mut wanted = Wanted { set: 0, ranks: [0; SLOTS] };
        let children = self.records.bvh().children(node);
        for slot in (0..SLOTS as u32).filter(|slot| children >> slot & 1 == 1) {
            let [near, far] = self.of.slab(|axis| self.records.planes(node, slot, axis));
            wanted.set |= u32::from(near <= far) << slot;
            wanted.ranks[slot as usize] = near.to_bits() & !(SLOTS as u32 - 1) | slot;
        }
        wanted
    }

    fn leaf(&mut self, leaf: Node) -> Flow {
        self.visited.leaves += 1;
        let records = self.records;
        for (shape, index) in records.triangles(leaf) {
            self.visited.triangles += 1;
            if self.of.meets(&shape, index) && ANY {
                return Flow::Stop;
            }
        }
        Flow::Continue
    }

    fn end(&self) -> u32 {
        // Without an order no child is beyond the end: WIDE-6.
        if ANY { u32::MAX } else { self.of.found.t.to_bits() }
    }
}
