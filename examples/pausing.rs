//! A search in slices: it stops when its budget is used up, and continues in another thread from a few bytes.
//!
//! Without a stack, the state of a traversal is a few words, for every depth of the tree (`spec/state.md`).
//!
//! `cargo run --release --example pausing`

use std::error::Error;
use std::thread;

use stackless_bvh::bvh::Bvh;
use stackless_bvh::generate::procedural;
use stackless_bvh::geom::Aabb;
use stackless_bvh::key::Side;
use stackless_bvh::order::{Descent, Flow, Unpruned, Visitor};
use stackless_bvh::traverse::{Next, Pause as _, Sparse, States, resume};
use stackless_bvh::tree::{Node, Topology as _};

/// The leaves that one slice may visit.
const BUDGET: usize = 20;

/// Collects the triangles of all leaves whose boxes overlap a region.
struct Overlaps<'a> {
    bvh: &'a Bvh,
    region: Aabb,
    found: Vec<u32>,
    budget: usize,
}

fn overlap(a: &Aabb, b: &Aabb) -> bool {
    a.lo.cmple(b.hi).all() && b.lo.cmple(a.hi).all()
}

impl Visitor for Overlaps<'_> {
    fn inner(&mut self, node: Node) -> Descent {
        let record = self.bvh.node(node.index());
        let [left, right] = [Side::Left, Side::Right].map(|side| overlap(&record.child_box(side), &self.region));
        Descent::new(left, right, false)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        self.found.extend(self.bvh.leaf_triangles(node).iter().map(|triangle| triangle.prim));
        self.budget -= 1;
        if self.budget == 0 { Flow::Stop } else { Flow::Continue }
    }
}

/// Continues the search until its budget is used up. Returns the state, or `None` if the search is complete.
fn slice(search: &mut Overlaps<'_>, state: &[u8]) -> Result<Option<Vec<u8>>, Box<dyn Error + Send + Sync>> {
    let states = States::of(search.bvh);
    // This traversal counts the visited nodes of each level (Barringer & Akenine-Möller 2013).
    let mut cursor = Sparse::<u64, _>::new(search.bvh)?;
    search.budget = BUDGET;
    // The bytes are checked: a state of another tree, or a damaged one, is an error.
    let next = resume(&mut cursor, states.from_bytes(state)?, &mut Unpruned(search), &mut ())?;
    Ok(next.map(|next| states.to_bytes(&cursor.put_aside(next))))
}

/// Finds the triangles in an eighth of a scene, each slice in a separate thread.
pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let bvh = Bvh::build(&procedural::strands(1, 50))?;
    let Aabb { lo, hi } = bvh.bounds();
    let region = Aabb { lo, hi: (lo + hi) / 2.0 };
    let mut search = Overlaps { bvh: &bvh, region, found: Vec::new(), budget: 0 };

    let start = Sparse::<u64, _>::new(&bvh)?.put_aside(Next::Visit);
    let mut state = Some(States::of(&bvh).to_bytes(&start));
    let mut slices = 0;
    while let Some(bytes) = state {
        state = thread::scope(|scope| scope.spawn(|| slice(&mut search, &bytes)).join())
            .map_err(|_| "the thread of a slice panicked")?
            .map_err(|error| error as Box<dyn Error>)?;
        slices += 1;
        println!("slice {slices}: from {} bytes, {} triangles so far", bytes.len(), search.found.len());
    }
    let mut found = search.found;

    // Without the hierarchy: all leaves are tested.
    let boxes = bvh.own_boxes();
    let mut expected: Vec<_> = (0..bvh.leaves().len())
        .map(|i| Node::leaf(i as u32))
        .filter(|&leaf| overlap(&boxes[bvh.slot(leaf)], &region))
        .flat_map(|leaf| bvh.leaf_triangles(leaf).iter().map(|triangle| triangle.prim))
        .collect();
    expected.sort_unstable();
    found.sort_unstable();
    assert_eq!(found, expected);
    assert!(slices > 2, "one slice does not pause");
    Ok(())
}
