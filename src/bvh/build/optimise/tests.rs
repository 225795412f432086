use super::super::{BuildOptions, Builder};
use crate::bvh::{Bvh, validate};
use crate::generate::procedural;
use crate::geom::{Aabb, Mesh};
use crate::order::{Side, SignOrder};
use crate::tree::Topology;

fn build(mesh: &Mesh, options: &BuildOptions) -> Bvh {
    let bvh = options.build(mesh).expect("a tree");
    validate(&bvh, mesh).expect("sound");
    bvh
}

fn area(bvh: &Bvh) -> f32 {
    bvh.own_boxes().iter().map(Aabb::half_area).sum::<f32>() / bvh.bounds().half_area()
}

#[test]
fn every_draft_becomes_cheaper_and_keeps_depth_limit_and_leaf_size() {
    for mesh in [procedural::soup(5, 900), procedural::strands(5, 60)] {
        for builder in Builder::ALL {
            let mut options = BuildOptions { builder, ..BuildOptions::default() };
            let before = build(&mesh, &options);
            options.reinsertion = 3;
            for depth_limit in [before.depth(), before.depth() + 2, 60] {
                options.sah.depth_limit = depth_limit;
                let after = build(&mesh, &options);
                assert!(after.depth() <= depth_limit, "{builder:?}");
                assert!(after.leaves().iter().all(|leaf| leaf.count <= options.sah.max_leaf));
                let gain = area(&after) / area(&before);
                // A complete tree at its own depth has no room for any move.
                let is_free = depth_limit == 60;
                assert!(gain < 1.0 || !is_free && gain == 1.0, "{builder:?} {depth_limit}: {gain}");
            }
        }
    }
}

#[test]
fn small_leaves_are_merged() {
    let mesh = procedural::soup(6, 300);
    let mut options = BuildOptions { builder: Builder::Median, ..BuildOptions::default() };
    options.sah.max_leaf = 4;
    let plain = build(&mesh, &options);
    options.reinsertion = 1;
    let bvh = build(&mesh, &options);
    assert!(bvh.leaves().len() <= plain.leaves().len());
    for (node, &axis) in bvh.nodes().iter().zip(bvh.axes()) {
        let (axis, reversed) = (usize::from(axis % SignOrder::REVERSED), axis >= SignOrder::REVERSED);
        let [left, right] = [Side::Left, Side::Right].map(|side| node.child_box(side).centroid()[axis]);
        assert!(if reversed { right <= left } else { left <= right });
    }
}

#[test]
fn tiny_and_repeated_meshes() {
    let options = BuildOptions { reinsertion: 9, ..BuildOptions::default() };
    for n in 1..12 {
        build(&procedural::soup(7, n), &options);
    }
    let corners = vec![glam::Vec3::ZERO, glam::Vec3::X, glam::Vec3::Y];
    build(&Mesh::new(corners, vec![[0, 1, 2]; 500]).expect("a mesh"), &options);
}

#[test]
fn the_tree_does_not_depend_on_the_number_of_threads() {
    let mesh = procedural::soup(8, 5000);
    let options = BuildOptions { reinsertion: 2, ..BuildOptions::default() };
    let trees = [1, 2, 5].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| options.build(&mesh)).expect("a tree")
    });
    for other in &trees[1..] {
        assert_eq!((trees[0].nodes(), trees[0].triangles()), (other.nodes(), other.triangles()));
    }
}
