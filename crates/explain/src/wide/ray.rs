//! Conversion of a ray through a scene to a case.

use stackless_bvh::bvh::WideBvh;
use stackless_bvh::generate::{WideAnswer, WideTape, wide_tree};
use stackless_bvh::geom::{Kernel, Ray};
use stackless_bvh::internals::geom::kernel::Exact;
use stackless_bvh::trace::Tracer;
use stackless_bvh::tree::Node;
use stackless_bvh::wide::{Ranks, Topology};
use stackless_check::WideCase;

/// Converts a closest-hit query to a case: its tape has the answers that [`Tracer`] receives.
///
/// The tree has the nodes whose boxes the ray hits. Their missed siblings are leaves. Distances are replaced by their
/// ranks. The result may be too large for a page.
pub fn of_ray(bvh: &WideBvh, ray: &Ray) -> WideCase<8> {
    let nodes = met(bvh, ray);
    let mut distances: Vec<u32> = nodes.iter().flat_map(|met| [Some(met.begin), met.hit]).flatten().collect();
    distances.sort_unstable();
    distances.dedup();
    let place = |t: u32| 8 * distances.partition_point(|&other| other < t) as u32;
    let answer = |met: &Met| WideAnswer { is_wanted: met.is_wanted, begin: place(met.begin), end: met.hit.map(place) };
    let children: Vec<_> = nodes.iter().map(|met| met.children.clone()).collect();
    let answers: Vec<_> = nodes.iter().map(answer).collect();
    let tree = wide_tree(&children);
    WideCase { tape: WideTape::of(&tree, &answers), tree, is_sorted: true }
}

/// A node that the ray hits, or the top node of a missed subtree. Distances are given by their bits.
struct Met {
    children: Option<Vec<u32>>,
    is_wanted: bool,
    begin: u32,
    /// The distance of the closest hit in a leaf.
    hit: Option<u32>,
}

/// Returns the nodes with parents before their children, the root first.
fn met(bvh: &WideBvh, ray: &Ray) -> Vec<Met> {
    let (tracer, exact) = (Tracer::new(bvh), Exact::new(ray, bvh.region()));
    let hit = |leaf: Node| {
        let (blocks, count) = bvh.leaf(leaf);
        let triangles = (0..count as usize).map(|place| blocks[place / 4].triangle(place % 4));
        let distances = triangles.filter_map(|triangle| exact.distance(&triangle, ray.tmax()));
        distances.map(|t| (t + 0.0).to_bits()).min()
    };
    let mut nodes = vec![Met { children: None, is_wanted: true, begin: 0, hit: None }];
    let mut open = vec![(bvh.root(), 0)];
    while let Some((node, place)) = open.pop() {
        let (wanted, children) = (tracer.wanted(ray, node), bvh.children(node));
        let mut below = Vec::new();
        for slot in (0..8).filter(|slot| children >> slot & 1 == 1) {
            let (child, is_wanted) = (bvh.child(node, slot), wanted.set >> slot & 1 == 1);
            let hit = if is_wanted && child.is_leaf() { hit(child) } else { None };
            let begin = if is_wanted { wanted.ranks.rank(slot) & !7 } else { 0 };
            below.push(nodes.len() as u32);
            open.extend((is_wanted && !child.is_leaf()).then_some((child, nodes.len())));
            nodes.push(Met { children: None, is_wanted, begin, hit });
        }
        nodes[place].children = Some(below);
    }
    nodes
}
