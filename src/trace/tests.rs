use super::search::{Any, AnyByNode, ClosestByNode, Search};
use super::truth::Truth;
use super::*;
use crate::bvh::{Bvh, SahOptions};
use crate::generate::procedural;
use crate::geom::kernel::Exact;
use crate::geom::slabs::Directed;
use crate::geom::{Aabb, Mesh, Ray};
use crate::order::{ByNode, Flow, LeftOrder, SignOrder, Visitor};
use crate::tree::{Node, Topology};

/// The reference traversal.
fn walk(bvh: &Bvh, node: Node, visitor: &mut impl Visitor) -> Flow {
    if node.is_leaf() {
        return visitor.leaf(node);
    }
    let children = bvh.children(node);
    let descent = visitor.inner(node);
    if descent.is_neither() {
        return Flow::Continue;
    }
    let first = walk(bvh, children[descent.first().index()], visitor);
    if first == Flow::Stop || !descent.postpones() {
        return first;
    }
    walk(bvh, children[descent.first().other().index()], visitor)
}

fn bits(hit: Option<Hit>) -> Option<(u32, [u32; 3])> {
    hit.map(|Hit { prim, t, u, v }| (prim, [t, u, v].map(f32::to_bits)))
}

fn trees(mesh: &Mesh) -> Vec<Bvh> {
    let sah = |max_leaf, depth_limit| Bvh::sah(mesh, SahOptions { max_leaf, depth_limit });
    let trees = [Bvh::median(mesh, 1), Bvh::median(mesh, 4), sah(1, 99), sah(4, 31), sah(9, 12)];
    trees.map(|tree| tree.expect("a tree")).into()
}

fn compare(mesh: &Mesh, rays: usize) {
    let trees: Vec<_> = trees(mesh).into_iter().map(|bvh| (bvh.own_boxes(), bvh)).collect();
    let mut hits = 0;
    let (truth, rays) = (Truth::new(mesh), procedural::rays(mesh, 3, rays));
    for ray in &rays {
        let truth = bits(truth.closest(ray).map(|hit| hit.rounded()));
        hits += usize::from(truth.is_some());
        for (boxes, bvh) in &trees {
            compare_on_tree(bvh, boxes, ray, truth);
        }
    }
    let share = hits as f32 / rays.len() as f32;
    assert!((0.1..0.9).contains(&share), "{share} of the rays hit");
}

fn compare_on_tree(bvh: &Bvh, boxes: &[Aabb], ray: &Ray, truth: Option<(u32, [u32; 3])>) {
    let mut closest = Closest::new(bvh, ray);
    walk(bvh, bvh.root(), &mut closest);
    assert_eq!(bits(closest.hit()), truth, "{ray:?}");

    let mut from_left = Search::<Exact, Directed, false, FromLeft>::new(bvh, ray);
    walk(bvh, bvh.root(), &mut from_left);
    assert_eq!(bits(from_left.hit()), truth, "{ray:?}");

    let mut nearest = Search::<Exact, Directed, true, Nearest>::new(bvh, ray);
    walk(bvh, bvh.root(), &mut nearest);
    assert_eq!(nearest.hit().is_some(), truth.is_some(), "{ray:?}");

    let mut by_node = ByNode { test: ClosestByNode::new(bvh, boxes, ray), order: LeftOrder };
    walk(bvh, bvh.root(), &mut by_node);
    assert_eq!(bits(by_node.test.hit()), truth, "{ray:?}");

    let order = SignOrder { axes: bvh.axes(), octant: ray.octant() };
    let mut by_sign = ByNode { test: ClosestByNode::new(bvh, boxes, ray), order };
    walk(bvh, bvh.root(), &mut by_sign);
    assert_eq!(bits(by_sign.test.hit()), truth, "{ray:?}");

    let mut any = Any::new(bvh, ray);
    let flow = walk(bvh, bvh.root(), &mut any);
    assert_eq!((any.hit().is_some(), flow == Flow::Stop), (truth.is_some(), truth.is_some()), "{ray:?}");

    let mut any = ByNode { test: AnyByNode::new(bvh, boxes, ray), order };
    walk(bvh, bvh.root(), &mut any);
    assert_eq!(any.test.hit().is_some(), truth.is_some(), "{ray:?}");
}

#[test]
fn all_trees_give_the_truth_on_strands() {
    compare(&procedural::strands(1, 40), 4000);
}

#[test]
fn all_trees_give_the_truth_in_the_stadium() {
    compare(&procedural::stadium(1), 400);
}

#[test]
fn all_trees_give_the_truth_in_the_soup() {
    compare(&procedural::soup(1, 500), 8000);
    compare(&procedural::soup(2, 3), 400);
    compare(&procedural::soup(3, 1), 400);
}

#[test]
fn the_first_of_equal_triangles_is_hit() {
    let corners = vec![glam::Vec3::ZERO, glam::Vec3::X, glam::Vec3::Y];
    let mesh = Mesh::new(corners, vec![[0, 1, 2]; 1000]).expect("a mesh");
    let ray = Ray::within(glam::Vec3::new(0.25, 0.25, -1.0), glam::Vec3::Z, 0.0, 1.0).expect("a ray");
    for bvh in trees(&mesh) {
        let mut closest = Closest::new(&bvh, &ray);
        walk(&bvh, bvh.root(), &mut closest);
        assert_eq!(closest.hit().map(|hit| hit.prim), Some(0));
    }
}

#[test]
fn counts_are_those_of_the_walk() {
    let mesh = procedural::soup(1, 64);
    let bvh = Bvh::median(&mesh, 1).expect("a tree");
    let origin = mesh.vertices()[0] - glam::Vec3::ONE;
    let ray = Ray::within(origin, glam::Vec3::NEG_ONE, 0.0, 1.0).expect("a ray");
    let counters = BinaryTracer::new(&bvh).count_closest(&[ray]);
    assert_eq!((counters.inner, counters.leaves, counters.boxes), (1, 0, 2));
}
