use glam::Vec3;

use super::*;
use crate::bvh::{BuildOptions, Builder, Degenerate, SahOptions, SpatialOptions};
use crate::generate::procedural;

/// Returns a hierarchy with some triangles in several leaves, and its mesh of long parallel diagonals.
pub(in crate::bvh) fn cut(n: u32, max_leaf: u32) -> (Bvh, Mesh) {
    let corners = (0..n).flat_map(|i| {
        let (from, to) = (Vec3::X * (i as f32 * 0.3), Vec3::new(i as f32 * 0.3 + 9.0, 9.0, 9.1));
        [from, to, to + Vec3::X * 0.1]
    });
    let mesh = Mesh::new(corners.collect(), (0..n).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).expect("a mesh");
    let sah = SahOptions { max_leaf, ..SahOptions::default() };
    let spatial = SpatialOptions { extra_percent: 100, overlap: 0.0 };
    let options = BuildOptions { builder: Builder::Spatial, sah, spatial, ..BuildOptions::default() };
    (options.build(&mesh).expect("a tree"), mesh)
}

fn broken((bvh, mesh): &(Bvh, Mesh), change: impl Fn(&mut Bvh)) -> Result<(), BvhError> {
    let mut bvh = bvh.clone();
    change(&mut bvh);
    validate(&bvh, mesh)
}

#[test]
fn boxes_without_points_are_refused() {
    let (sah, one) = ([2, 1].map(|n| procedural::soup(5, n))).into();
    for mesh in [sah, one] {
        let bvh = Bvh::sah(&mesh, SahOptions { max_leaf: 1, ..SahOptions::default() }).expect("a tree");
        let (root, tree) = (bvh.tree.root, (bvh, mesh));
        assert_eq!(broken(&tree, |b| b.bounds.lo.y = f32::NAN), Err(BvhError::NoBox(root)));
        assert_eq!(broken(&tree, |b| b.bounds.hi.z = b.bounds.lo.z - 1.0), Err(BvhError::NoBox(root)));
        assert_eq!(broken(&tree, |b| b.bounds.hi.x = f32::INFINITY), Ok(()));
    }
    let tree = cut(40, 3);
    // Beyond the opposite side, but not of the root's own box.
    let node = &tree.0.tree.nodes[0];
    let (child, [lo, hi, ..]) = (node.children[0], node.planes[0]);
    assert!(lo < hi);
    assert_eq!(broken(&tree, |b| b.tree.nodes[0].planes[0][..2].swap(0, 1)), Err(BvhError::NoBox(child)));
    assert_eq!(broken(&tree, |b| b.tree.nodes[0].planes[0][1] = f32::NAN), Err(BvhError::Nesting(child)));
}

#[test]
fn corners_are_finite_and_the_same_in_all_leaves() {
    let tree = cut(40, 3);
    let (bvh, _) = &tree;
    assert!(bvh.duplicates() > 2);
    for bad in [f32::NAN, f32::INFINITY] {
        let prim = bvh.triangles[0].prim;
        let error = BvhError::NotFinite { leaf: Node::leaf(0), prim };
        assert_eq!(broken(&tree, |b| b.triangles[0].shape.0[2].y = bad), Err(error));
    }
    let mut seen = std::collections::BTreeMap::new();
    let again = (0..bvh.triangles.len()).find(|&i| seen.insert(bvh.triangles[i].prim, i).is_some());
    let again = again.expect("a duplicate");
    let prim = bvh.triangles[again].prim;
    let found = broken(&tree, |b| b.triangles[again].shape.0.swap(0, 1));
    assert!(matches!(found, Err(BvhError::Corners { prim: found, .. }) if found == prim), "{found:?}");
    // All its copies are changed equally: valid, but not of this mesh.
    let turn = |b: &mut Bvh| b.triangles.iter_mut().filter(|held| held.prim == prim).for_each(|h| h.shape.0.swap(0, 1));
    let found = broken(&tree, turn);
    assert!(matches!(found, Err(BvhError::Triangle { prim: found, .. }) if found == prim), "{found:?}");
}

#[test]
fn one_leaf_holds_a_triangle_once() {
    let tree = cut(40, 3);
    let leaf = tree.0.tree.leaves.iter().position(|leaf| leaf.count > 1).expect("a leaf of two");
    let first = tree.0.tree.leaves[leaf].first as usize;
    let (leaf, prim) = (Node::leaf(leaf as u32), tree.0.triangles[first].prim);
    assert_eq!(broken(&tree, |b| b.triangles[first + 1] = b.triangles[first]), Err(BvhError::Twice { leaf, prim }));
}

#[test]
fn dropped_triangles_are_counted() {
    let flat = [Vec3::ZERO, Vec3::X, Vec3::Y, 2.0 * Vec3::X];
    let mesh = Mesh::new(flat.to_vec(), vec![[0, 1, 3], [0, 1, 2], [0, 0, 1]]).expect("a mesh");
    let left_out = BuildOptions { degenerate: Degenerate::LeftOut, ..BuildOptions::default() };
    let bvh = left_out.build(&mesh).expect("a tree");
    assert_eq!((bvh.dropped(), validate(&bvh, &mesh)), (2, Ok(())));
    let tree = (bvh, mesh);
    for stored in [1, 3, usize::MAX] {
        assert_eq!(broken(&tree, |b| b.dropped = stored), Err(BvhError::Dropped { stored, found: 2 }));
    }
    // Too few primitives for this index.
    let error = BvhError::Triangle { leaf: Node::leaf(0), prim: 1 };
    assert_eq!(broken(&tree, |b| b.dropped = 0), Err(error));
}

#[test]
fn a_flattened_mesh_is_sound() {
    let (mut bvh, mesh) = cut(40, 3);
    let line = mesh.vertices().iter().map(|v| Vec3::X * v.x).collect();
    let line = Mesh::new(line, mesh.triangles().to_vec()).expect("a mesh");
    bvh.refit(&line).expect("the same triangles");
    assert_eq!(validate(&bvh, &line), Ok(()));
}
