//! Conversion of a ray through a scene to a case.

use stackless_bvh::bvh::Bvh;
use stackless_bvh::generate::{Cell, Tape};
use stackless_bvh::geom::{Kernel, Ray};
use stackless_bvh::internals::geom::Slabs;
use stackless_bvh::internals::geom::kernel::Exact;
use stackless_bvh::internals::geom::slabs::{Directed, Intervals};
use stackless_bvh::order::{FixedOrder, SignOrder};
use stackless_bvh::tree::{Node, Topology, Tree};
use stackless_check::Case;

/// With these signs, axis 0 has the left child first and axis 1 the right child.
const OCTANT: u8 = 0b010;

/// Converts a closest-hit query to a case: its tape has the decisions of [`Closest`](stackless_bvh::internals::trace::Closest).
///
/// The tree has the nodes whose boxes the ray hits. Their missed siblings are leaves. Distances are replaced by their
/// ranks. The result may be too large for a page.
pub fn of_ray(bvh: &Bvh, ray: &Ray) -> Case {
    let nodes = met(bvh, ray);
    let mut distances: Vec<f32> =
        nodes.iter().flat_map(|met| [Some(met.enter), Some(met.exit), met.hit]).flatten().collect();
    distances.sort_by(f32::total_cmp);
    distances.dedup();
    let rank = |t: f32| distances.partition_point(|&other| other < t) as u32;
    let cell = |met: &Met| {
        let enter = rank(met.enter);
        // A hit is never before the entry of its box, except for a part of a triangle.
        let hit = met.hit.map(|t| rank(t).max(enter));
        Cell { miss: met.is_missed, enter, exit: Some(rank(met.exit)), right_first: false, axis: met.axis, hit }
    };
    let children: Vec<_> = nodes.iter().map(|met| met.children).collect();
    let tree = Tree::from_generated(&children);
    let mut cells: Vec<_> = nodes.iter().map(cell).collect();
    cells[0] = Cell { enter: 0, exit: None, ..cells[0] };
    let tape = Tape::from_cells(&tree, cells).unwrap_or_default();
    Case { tree, tape, any: false, octant: OCTANT }
}

/// A node that the ray hits, or the top node of a missed subtree.
struct Met {
    children: Option<[u32; 2]>,
    is_missed: bool,
    /// The distance where the ray enters the node's box.
    enter: f32,
    exit: f32,
    /// The distance of the closest hit in a leaf.
    hit: Option<f32>,
    axis: u8,
}

/// Returns the nodes with parents before their children, the root first.
fn met(bvh: &Bvh, ray: &Ray) -> Vec<Met> {
    let (kernel, slabs) = (Exact::new(ray, bvh.region()), Directed::new(ray, bvh.region()));
    let by_sign = SignOrder { axes: bvh.axes(), octant: ray.octant() };
    // Adding 0 turns -0 into 0.
    let met = |node: Node, is_missed, enter: f32, exit: f32| {
        let distances = || bvh.leaf_triangles(node).iter().filter_map(|held| kernel.distance(&held.shape, ray.tmax()));
        let hit = if is_missed || !node.is_leaf() { None } else { distances().min_by(f32::total_cmp) };
        let axis = u8::from(!node.is_leaf() && by_sign.first(node).is_right());
        Met { children: None, is_missed, enter: enter + 0.0, exit: exit + 0.0, hit: hit.map(|t| t + 0.0), axis }
    };
    let mut nodes = vec![met(bvh.root(), false, ray.tmin(), ray.tmax())];
    let mut pending = vec![(bvh.root(), 0)];
    while let Some((node, slot)) = pending.pop() {
        if node.is_leaf() {
            continue;
        }
        let Intervals { hit, near, far } = slabs.pair(&bvh.node(node.index()).planes, ray.tmax());
        let Met { enter, exit, .. } = nodes[slot];
        let first = nodes.len();
        nodes[slot].children = Some([first as u32, first as u32 + 1]);
        for (i, child) in bvh.children(node).into_iter().enumerate() {
            if hit[i] {
                // The interval is within the parent's, except for rounding.
                nodes.push(met(child, false, near[i].max(enter), far[i].min(exit)));
                pending.push((child, first + i));
            } else {
                nodes.push(met(child, true, enter, exit));
            }
        }
    }
    nodes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record;
    use stackless_bvh::bvh::{BuildOptions, Builder};
    use stackless_bvh::generate::procedural;
    use stackless_bvh::internals::trace::Counters;
    use stackless_bvh::trace::{BinaryTracer, RayQueries};
    use stackless_bvh::traverse::Method;

    #[test]
    fn the_case_of_a_ray_is_what_the_tracer_does() {
        let mesh = procedural::soup(3, 400);
        for builder in [Builder::Standard, Builder::Spatial] {
            let bvh = BuildOptions { builder, ..BuildOptions::default() }.build(&mesh).unwrap();
            let tracer = BinaryTracer::new(&bvh);
            let mut hits = 0;
            for ray in procedural::rays(&mesh, 5, 60) {
                let case = of_ray(&bvh, &ray);
                let recording = record(&case, Method::Hashed).unwrap();
                let counters = tracer.count_closest(&[ray]);
                assert_eq!(recording.steps.len() as u64, counters.inner + counters.leaves, "{ray:?}");
                let by_sign = BinaryTracer::with_method(&bvh, Method::Hapala).unwrap();
                let visits = record(&case, Method::Hapala).unwrap().steps.len() as u64;
                // The traversal tests one box per visit.
                let Counters { boxes, .. } = by_sign.count_closest(&[ray]);
                assert_eq!(visits, boxes, "{ray:?}");
                hits += usize::from(recording.steps.iter().any(|step| step.hit));
                assert_eq!(recording.steps.iter().any(|step| step.hit), tracer.closest(&ray).is_some());
            }
            assert!((10..60).contains(&hits), "{hits}");
        }
    }
}
