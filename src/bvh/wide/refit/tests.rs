use glam::Vec3;

use super::*;
use crate::bvh::wide::tests::{chain, cut, triangles, wide};
use crate::bvh::wide::{WideNode, name_ancestors};
use crate::bvh::{BuildOptions, Degenerate};
use crate::generate::{double, procedural};
use crate::wide::Topology;

#[test]
fn moved_triangles_are_held_again() {
    let (bvh, mesh) = cut(40);
    let mut cut = wide::<8>(&bvh);
    let turned = mesh.vertices().iter().map(|v| Vec3::new(v.y, -v.x, 3.0 * v.z)).collect();
    let turned = Mesh::new(turned, mesh.triangles().to_vec()).expect("a mesh");
    assert!(cut.validate(&turned).is_err());
    assert_eq!((cut.refit(&turned), cut.validate(&turned)), (Ok(()), Ok(())));
    let fewer = Mesh::new(mesh.vertices().to_vec(), mesh.triangles()[1..].to_vec()).expect("a mesh");
    assert_eq!(cut.refit(&fewer), Err(RefitError::Count { found: 39, expected: 40 }));
    let flat = triangles(vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ZERO, Vec3::X, 2.0 * Vec3::X]);
    let left_out = BuildOptions { degenerate: Degenerate::LeftOut, ..BuildOptions::default() };
    let mut four = wide::<4>(&left_out.build(&flat).expect("a tree"));
    let raised = triangles(vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ZERO, Vec3::X, Vec3::Z]);
    assert_eq!((four.refit(&raised), four.validate(&flat)), (Err(RefitError::Revived(1)), Ok(())));
}

/// Twists a mesh about the y axis by an angle per unit of y.
fn twisted(mesh: &Mesh, turn: f32) -> Mesh {
    let vertices = mesh.vertices().iter().map(|v| v.rotate_y(turn * v.y)).collect();
    Mesh::new(vertices, mesh.triangles().to_vec()).expect("a mesh")
}

/// Returns the sum of half areas of all boxes, roughly the number of visits of rays.
fn cost<const A: usize, V: Precision>(wide: &WideBvh<A, V>) -> f64 {
    let boxes =
        wide.nodes.iter().flat_map(|node| (0..A as u32).map(|slot| (node.has_child(slot), node.child_box(slot))));
    boxes.filter(|(is_there, _)| *is_there).map(|(_, aabb)| f64::from(aabb.half_area())).sum()
}

fn leaves<const A: usize, V: Precision>(wide: &WideBvh<A, V>) -> Vec<u32> {
    let mut leaves: Vec<_> = wide.leaf_boxes().map(|(leaf, _)| leaf.to_bits()).collect();
    leaves.sort_unstable();
    leaves
}

/// [BUILD-7]
#[test]
fn optimizing_makes_a_spoilt_tree_cheaper() {
    let mesh = procedural::strands(5, 3000);
    for (turn, most) in [(0.0, 1.01), (0.5, 0.95), (3.0, 0.8)] {
        let moved = twisted(&mesh, turn);
        let mut wide = WideBvh::<8>::build(&mesh).expect("a tree");
        wide.refit(&moved).expect("as many");
        let (before, blocks, held, least) =
            (cost(&wide), wide.blocks.clone(), leaves(&wide), wide.least_below(wide.root()));
        assert_eq!((wide.optimize(), wide.validate(&moved)), (Ok(()), Ok(())));
        assert!(wide.blocks == blocks && leaves(&wide) == held, "leaves stay as they are");
        let fresh = WideBvh { least: Least::default(), ..wide.clone() };
        let inner = (0..wide.nodes.len() as u32).map(Node::inner);
        assert!(inner.clone().all(|node| wide.least_below(node) == fresh.least_below(node)));
        assert_eq!(wide.least_below(wide.root()), least);
        let (after, built) = (cost(&wide), cost(&WideBvh::<8>::build(&moved).expect("a tree")));
        assert!(after < most * before && after < 1.7 * built, "{turn}: {before} {after} {built}");
    }
}

/// For any number of triangles, chains that are too deep, parts of triangles, and boxes whose areas overflow or vanish.
#[test]
fn any_tree_is_optimized() {
    let mut empty = WideBvh::<8>::empty();
    assert_eq!((empty.optimize(), empty.nodes.len()), (Ok(()), 1));
    for n in (1..40).chain([500]) {
        let mesh = procedural::soup(n as u64, n);
        let fine = BuildOptions::fine().build(&mesh).expect("a tree");
        for bvh in [if n > 1 { chain(&mesh) } else { fine.clone() }, fine] {
            let (mut eight, mut four) = (wide::<8>(&bvh), wide::<4>(&bvh));
            assert_eq!((eight.optimize(), eight.validate(&mesh)), (Ok(()), Ok(())), "{n}");
            assert_eq!((four.optimize(), four.validate(&mesh)), (Ok(()), Ok(())), "{n}");
        }
    }
    let (bvh, mesh) = cut(40);
    let mut parts = wide::<8>(&bvh);
    assert!(parts.duplicates() > 0);
    assert_eq!((parts.optimize(), parts.validate(&mesh)), (Ok(()), Ok(())));
    for size in [1e-42, 1e-30, 1e25, 3e38] {
        let vertices = procedural::strands(2, 300).vertices().iter().map(|v| *v / 8.0 * size).collect();
        let mesh = Mesh::new(vertices, procedural::strands(2, 300).triangles().to_vec()).expect("a mesh");
        let mut wide = WideBvh::<8>::build(&mesh).expect("a tree");
        assert_eq!((wide.optimize(), wide.validate(&mesh)), (Ok(()), Ok(())), "{size}");
    }
    for place in double::PLACES {
        let mesh = place.mesh(&procedural::strands(2, 300)).expect("a mesh");
        let mut wide = WideBvh::<8, _>::build(&mesh).expect("a tree");
        assert_eq!((wide.optimize(), wide.validate(&mesh)), (Ok(()), Ok(())), "{}", place.name);
    }
}

/// An only child replaces its parent.
#[test]
fn nodes_of_one_child_are_left_out() {
    let mesh = procedural::soup(3, 200);
    let mut wide = WideBvh::<8>::build(&mesh).expect("a tree");
    let root = Node::inner(1).to_bits();
    let mut nodes = vec![WideNode { children: [root, 0, 0, 0, 0, 0, 0, 0], ..WideNode::EMPTY }];
    nodes[0].set_child_box(0, &wide.nodes[0].aabb());
    nodes.extend(wide.nodes.iter().map(|node| {
        let moved = |bits: u32| if bits != 0 && !Node::from_bits(bits).is_leaf() { bits + 1 } else { bits };
        WideNode { children: node.children.map(moved), ancestors: [0; 8], ..*node }
    }));
    name_ancestors(&mut nodes, |i| i as u32);
    let before = wide.levels;
    (wide.nodes, wide.levels) = (nodes, before + 1);
    assert_eq!(wide.validate(&mesh), Ok(()));
    assert_eq!((wide.optimize(), wide.validate(&mesh)), (Ok(()), Ok(())));
    assert!(
        wide.levels <= before
            && wide.nodes.iter().all(|node| node.children.iter().filter(|&&bits| bits != 0).count() > 1)
    );
}

#[test]
fn threads_change_nothing() {
    let mesh = procedural::soup(1, 40_000);
    let moved = twisted(&mesh, 1.0);
    let made = [1, 2, 5].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let mut wide = WideBvh::build(&mesh).expect("a tree");
            wide.refit(&moved).expect("as many");
            let refitted = wide.nodes.clone();
            wide.optimize().expect("memory");
            (refitted, wide.nodes, wide.blocks)
        })
    });
    assert!(made[1] == made[0] && made[2] == made[0]);
}
