use glam::Vec3;

use super::*;
use crate::bvh::BuildOptions;
use crate::generate::procedural;
use crate::geom::Mesh;

/// Returns the sum of half areas, relative to that of the root.
fn area(nodes: &[Record]) -> f64 {
    nodes.iter().map(|node| f64::from(node.half_area())).sum::<f64>() / f64::from(nodes[0].half_area())
}

/// Returns a soup with an equal number of triangles that are points or parallel to an axis. Their boxes have no area.
fn with_flat(n: usize) -> Mesh {
    let soup = procedural::soup(5, n);
    let mut corners = soup.vertices().to_vec();
    for corner in soup.vertices().chunks_exact(3).map(|chunk| chunk[0]) {
        corners.extend([corner, corner + Vec3::X * 0.01, corner]);
    }
    let triangles = (0..corners.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Mesh::new(corners, triangles).expect("a mesh")
}

#[test]
fn only_the_largest_nodes_are_moved() {
    let (mut draft, _) = BuildOptions::fine().draft(&with_flat(4000), &|_| ()).expect("a tree");
    let total = draft.nodes.len();
    let (tree, areas) = Tree::of(&mut draft.nodes, BuildOptions::fine().sah).expect("memory");
    for share in [0.001, 0.01, 0.1, 0.3] {
        let large = tree.large(areas.least(share)).len();
        let wanted = (total as f32 * share) as usize;
        assert!((wanted..wanted + wanted / 4 + 20).contains(&large), "{large} of {total} for {share}");
    }
    assert_eq!(tree.large(areas.least(1.0)).len(), total);
}

/// Rejected moves leave the tree unchanged, and accepted moves make it cheaper. [BUILD-5]
#[test]
fn every_move_pays() {
    for (mesh, depth_limit) in [(with_flat(300), 60), (procedural::strands(5, 60), 60), (procedural::soup(6, 500), 10)]
    {
        let options = BuildOptions { builder: crate::bvh::Builder::Median, ..BuildOptions::fine() };
        let (mut draft, _) = options.draft(&mesh, &|_| ()).expect("a tree");
        let (before, sah) = (draft.nodes.clone(), SahOptions { max_leaf: 1, depth_limit });
        let (mut tree, _) = Tree::of(&mut draft.nodes, sah).expect("memory");
        let (mut made, mut refused) = (0, 0);
        for node in (1..before.len() as u32).step_by(7) {
            for target in (0..before.len() as u32).step_by(41) {
                let (area_before, nodes_before) = (area(tree.nodes), tree.nodes.to_vec());
                if tree.try_move(node, target) {
                    assert!(area(tree.nodes) < area_before);
                    made += 1;
                } else {
                    let is_same = |(a, b): (&Record, &Record)| a.is_same(b) && a.first() == b.first();
                    assert!(nodes_before.iter().zip(&*tree.nodes).all(is_same));
                    refused += 1;
                }
            }
        }
        assert!(made >= 5 && refused > 1000, "{made} {refused}");
        assert!(tree.height(tree.node(0)) <= depth_limit);
        // Boxes, counts, parents and heights match the children.
        for place in 0..tree.nodes.len() as u32 {
            let node = *tree.node(place);
            if !node.is_leaf() {
                let children = [node.first(), node.first() + 1];
                assert!(node.is_same(&Record::parent(children.map(|child| tree.node(child)), node.first())));
                assert!(children.iter().all(|&child| tree.parent(child) == Some(place)));
                assert_eq!(tree.height(&node), tree.height_over(&node));
            }
        }
    }
}
