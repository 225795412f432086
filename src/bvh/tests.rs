use glam::Vec3;

use super::*;
use crate::generate::procedural;
use crate::geom::Mesh;
use crate::order::SignOrder;

/// Returns triangles of equal shape with the given first corners.
fn mesh(corners: impl IntoIterator<Item = Vec3>) -> Mesh {
    let vertices: Vec<_> = corners.into_iter().flat_map(|c| [c, c + Vec3::X, c + Vec3::Y]).collect();
    let triangles = (0..vertices.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Mesh::new(vertices, triangles).expect("a mesh")
}

fn scattered(n: usize) -> Mesh {
    procedural::soup(11, n)
}

/// Returns meshes that are difficult to split.
pub(super) fn awkward() -> Vec<Mesh> {
    let along = |n: usize| (0..n).map(|i| Vec3::splat(i as f32));
    let mut meshes: Vec<_> = [1, 2, 3, 5, 8, 9, 100].map(scattered).into();
    meshes.push(mesh([Vec3::ONE; 1000]));
    meshes.push(mesh(along(1000)));
    meshes.push(mesh((0..130).map(|i| Vec3::X * 2f32.powi(i - 64))));
    meshes.push(mesh((0..999).map(|i| Vec3::new(if i == 7 { 3e38 } else { -3e38 }, 0.0, 0.0))));
    // Equal centroids, different sizes.
    let nested =
        (1..200).flat_map(|i| [[-1.0, 0.0], [1.0, -1.0], [1.0, 1.0]].map(|[x, y]| Vec3::new(x, y, 0.0) * i as f32));
    meshes
        .push(Mesh::new(nested.collect(), (0..199).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).expect("a mesh"));
    // Points on a line: every box has area 0.
    meshes.push(Mesh::new(along(500).collect(), (0..500).map(|i| [i; 3]).collect()).expect("a mesh"));
    meshes
}

#[test]
fn the_median_makes_complete_trees() {
    for mesh in awkward() {
        let n = mesh.triangles().len();
        for leaf_size in [1, 2, 3, 4, 7, 2000] {
            let bvh = Bvh::median(&mesh, leaf_size).expect("a tree");
            validate(&bvh, &mesh).expect("sound");
            let counts = || bvh.leaves().iter().map(|leaf| leaf.count);
            let (least, most) = (counts().min().unwrap_or(0), counts().max().unwrap_or(0));
            assert!(most <= leaf_size.max(2) && most - least <= 1, "{n} {leaf_size}: {least} to {most}");
            assert_eq!(bvh.leaves().len(), 1 << bvh.depth(), "complete");
        }
    }
}

#[test]
fn a_single_triangle_is_a_leaf() {
    let mesh = scattered(1);
    for bvh in [Bvh::median(&mesh, 4), Bvh::sah(&mesh, SahOptions::default())].map(|bvh| bvh.expect("a tree")) {
        assert_eq!((bvh.root(), bvh.depth(), bvh.node_count()), (Node::leaf(0), 0, 1));
        assert_eq!(bvh.own_boxes(), [bvh.bounds()]);
        assert_eq!(bvh.bounds(), Triangle(mesh.triangle(0)).aabb());
    }
}

#[test]
fn left_children_are_the_larger_and_axes_say_which_middle_is_less() {
    let mesh = scattered(700);
    for bvh in [Bvh::median(&mesh, 2), Bvh::sah(&mesh, SahOptions::default())].map(|bvh| bvh.expect("a tree")) {
        for (node, &axis) in bvh.nodes().iter().zip(bvh.axes()) {
            let [left, right] = [Side::Left, Side::Right].map(|side| node.child_box(side).half_area());
            assert!(left >= right, "{left} {right}");
            let along = usize::from(axis % SignOrder::REVERSED);
            let mut middles = [Side::Left, Side::Right].map(|side| node.child_box(side).centroid()[along]);
            if axis >= SignOrder::REVERSED {
                middles.reverse();
            }
            assert!(middles[0] <= middles[1], "{middles:?}");
        }
        assert!(bvh.axes().iter().any(|&axis| axis < 4) && bvh.axes().iter().any(|&axis| axis >= 4));
    }
}

#[test]
fn the_median_cuts_the_longest_axis() {
    let wide = mesh((0..64).map(|i| Vec3::new((i / 16) as f32, (i % 16) as f32, 0.0)));
    let bvh = Bvh::median(&wide, 16).expect("a tree");
    assert_eq!(bvh.axes(), [1, 1, 1]);
    // For squares, the first of the longest axes.
    assert_eq!(Bvh::median(&wide, 8).expect("a tree").axes()[2], 0);
}

#[test]
fn a_tree_by_surface_area_is_cheaper() {
    let mesh = procedural::stadium(1);
    let cost = |bvh: Bvh| {
        let boxes = bvh.own_boxes();
        boxes[..bvh.nodes().len()].iter().map(Aabb::half_area).sum::<f32>() / bvh.bounds().half_area()
    };
    let [median, sah] =
        [Bvh::median(&mesh, 4), Bvh::sah(&mesh, SahOptions::default())].map(|b| cost(b.expect("a tree")));
    assert!(sah < 0.75 * median, "{sah} {median}");
}

#[test]
fn impossible_wishes_are_refused() {
    let mesh = scattered(33);
    let with = |max_leaf, depth_limit| Bvh::sah(&mesh, SahOptions { max_leaf, depth_limit }).err();
    assert_eq!(Bvh::median(&mesh, 0).err(), Some(BuildError::ZeroLeafSize));
    assert_eq!(with(0, 31), Some(BuildError::ZeroLeafSize));
    assert_eq!(with(4, 3), Some(BuildError::DepthLimit { triangles: 33, max_leaf: 4, limit: 3 }));
    assert_eq!(with(4, 4), None);
}

#[test]
fn validation_bites() {
    let mesh = scattered(50);
    let bvh = Bvh::sah(&mesh, SahOptions { max_leaf: 2, ..SahOptions::default() }).expect("a tree");
    let bvh = bvh.with_links(Recorded::Uncles);
    let broken = |change: &dyn Fn(&mut Bvh)| {
        let mut bvh = bvh.clone();
        change(&mut bvh);
        validate(&bvh, &mesh)
    };
    let (nodes, last) = (bvh.tree.nodes.len(), bvh.tree.leaves.len() - 1);
    let child = bvh.tree.nodes[0].children[1];

    assert_eq!(broken(&|_| ()), Ok(()));
    assert_eq!(
        broken(&|b| b.tree.depth += 1),
        Err(BvhError::Depth { stored: bvh.tree.depth + 1, found: bvh.tree.depth })
    );
    assert_eq!(broken(&|b| b.tree.axes[3] = 3), Err(BvhError::Axis { node: Node::inner(3), axis: Some(3) }));
    assert_eq!(broken(&|b| b.tree.axes.truncate(3)), Err(BvhError::Axis { node: Node::inner(3), axis: None }));
    assert_eq!(broken(&|b| b.tree.nodes[4].links[1] = child), Err(BvhError::Links(Node::inner(4))));
    assert_eq!(broken(&|b| b.tree.leaves[1].links.swap(0, 1)), Err(BvhError::Links(Node::leaf(1))));
    assert_eq!(broken(&|b| b.tree.recorded = Recorded::ParentSibling), Err(BvhError::Links(Node::inner(1))));
    assert_eq!(broken(&|b| *b = b.clone().with_links(Recorded::ParentSibling)), Ok(()));

    let order = |found, expected| Err(BvhError::Order { found, expected });
    assert_eq!(broken(&|b| b.tree.nodes[0].children[0] = Node::inner(0)), order(Node::inner(0), 1));
    assert_eq!(broken(&|b| b.tree.nodes[0].children[0] = Node::inner(9999)), order(Node::inner(9999), 1));
    assert_eq!(broken(&|b| b.tree.root = Node::leaf(1)), order(Node::leaf(1), 0));
    assert_eq!(broken(&|b| b.tree.nodes.push(b.tree.nodes[0])), Err(BvhError::Unreached(Node::inner(nodes as u32))));
    let unreached = Node::leaf(last as u32 + 1);
    assert_eq!(broken(&|b| b.tree.leaves.push(b.tree.leaves[0])), Err(BvhError::Unreached(unreached)));

    assert_eq!(broken(&|b| b.tree.nodes[0].planes[1][3] += 9.0), Err(BvhError::Nesting(child)));
    let holds_first = |node: &&mut BvhNode| node.children.contains(&Node::leaf(0));
    let shrink = |b: &mut Bvh| {
        let node = b.tree.nodes.iter_mut().find(holds_first).expect("the first leaf's parent");
        let side = usize::from(node.children[1] == Node::leaf(0));
        node.planes[0][2 * side] = node.planes[0][2 * side + 1];
    };
    assert!(matches!(broken(&shrink), Err(BvhError::Outside { leaf, .. }) if leaf == Node::leaf(0)));

    let range = |leaf: usize| Err(BvhError::Range(Node::leaf(leaf as u32)));
    assert_eq!(broken(&|b| b.tree.leaves[0].count = 0), range(0));
    assert_eq!(broken(&|b| b.tree.leaves[1].first += 1), range(1));
    assert_eq!(broken(&|b| b.tree.leaves[last].count = u32::MAX), range(last));
    assert_eq!(broken(&|b| b.triangles.push(b.triangles[0])), range(last));

    let (leaf, prim) = (Node::leaf(0), bvh.triangles[0].prim);
    assert_eq!(broken(&|b| b.triangles[0].prim = 50), Err(BvhError::Triangle { leaf, prim: 50 }));
    assert_eq!(broken(&|b| b.triangles[0].shape.0[1].x += 9.0), Err(BvhError::Outside { leaf, prim }));
    assert_eq!(broken(&|b| b.triangles[0].shape.0.swap(1, 2)), Err(BvhError::Triangle { leaf, prim }));
}

#[test]
fn the_same_triangle_twice_is_found() {
    let mesh = mesh([Vec3::ONE; 2]);
    let mut bvh = Bvh::median(&mesh, 1).expect("a tree");
    bvh.triangles[1].prim = bvh.triangles[0].prim;
    let prim = bvh.triangles[0].prim;
    assert_eq!(validate(&bvh, &mesh), Err(BvhError::Twice { leaf: Node::leaf(1), prim }));
    bvh.triangles.pop();
    bvh.tree.nodes.clear();
    bvh.tree.leaves.pop();
    (bvh.tree.root, bvh.tree.depth, bvh.dropped) = (Node::leaf(0), 0, 1);
    assert_eq!(validate(&bvh.with_links(Recorded::Uncles), &mesh), Err(BvhError::Missing(1 - prim)));
}
