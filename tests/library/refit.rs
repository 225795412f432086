//! Hierarchies of moved triangles.

use glam::Vec3;

use stackless_bvh::bvh::{Bounded, BuildOptions, Builder, Bvh, Degenerate, RefitError, SahOptions, validate};
use stackless_bvh::generate::procedural;
use stackless_bvh::geom::{Aabb, Mesh, Region};
use stackless_check::check_trees;

/// Returns the mesh bent and stretched.
fn deformed(mesh: &Mesh) -> Mesh {
    let bent = |v: &Vec3| Vec3::new(v.x + v.y * v.y, 3.0 * v.y - v.z * v.x, v.z + 0.5 * v.x);
    Mesh::new(mesh.vertices().iter().map(bent).collect(), mesh.triangles().to_vec()).expect("a mesh")
}

/// [BUILD-7]
#[test]
fn a_deformed_mesh_is_hit_where_it_is() {
    let mesh = procedural::soup(5, 300);
    let moved = deformed(&mesh);
    for builder in Builder::ALL {
        let options = BuildOptions { builder, ..BuildOptions::default() };
        let mut bvh = options.build(&mesh).expect("a tree");
        assert!(validate(&bvh, &moved).is_err());
        bvh.refit(&moved).expect("the same triangles");
        let mut wide = options.build_wide(&mesh).expect("a tree");
        wide.refit(&moved).expect("the same triangles");
        assert_eq!(bvh.bounds(), Aabb::of(moved.vertices()));
        assert_eq!(bvh.region(), &Region::of(&bvh.bounds()));
        let rays = procedural::rays(&moved, 3, 200);
        let hits = check_trees(&bvh, &wide, &moved, &rays).expect("the truth");
        assert!(hits > 20, "{hits}");
        wide.optimize().expect("memory");
        assert_eq!(check_trees(&bvh, &wide, &moved, &rays).expect("the truth"), hits);
    }
}

#[test]
fn boxes_are_the_smallest_and_a_way_back_leads_home() {
    let mesh = procedural::strands(2, 20);
    let bvh = Bvh::sah(&mesh, SahOptions::default()).expect("a tree");
    let mut there = bvh.clone();
    there.refit(&deformed(&mesh)).expect("the same triangles");
    assert_ne!(there.nodes(), bvh.nodes());
    there.refit(&mesh).expect("the same triangles");
    assert_eq!(there.nodes(), bvh.nodes());
    assert_eq!(there.triangles(), bvh.triangles());
}

#[test]
fn what_does_not_fit_is_refused_and_changes_nothing() {
    let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::X * 2.0];
    let flat = Mesh::new(corners.clone(), vec![[0, 1, 2], [0, 1, 3]]).expect("a mesh");
    let left_out = BuildOptions { degenerate: Degenerate::LeftOut, ..BuildOptions::default() };
    let bvh = left_out.build(&flat).expect("a tree");
    assert_eq!(bvh.dropped(), 1);
    let refusal = |mesh: &Mesh| {
        let mut changed = bvh.clone();
        let refusal = changed.refit(mesh).err();
        assert_eq!((changed.nodes(), changed.triangles()), (bvh.nodes(), bvh.triangles()));
        refusal
    };
    let one = Mesh::new(corners.clone(), vec![[0, 1, 2]]).expect("a mesh");
    assert_eq!(refusal(&one), Some(RefitError::Count { found: 1, expected: 2 }));
    let up = Mesh::new(corners.into_iter().map(|v| v + Vec3::Z * v.x * v.x).collect(), flat.triangles().to_vec());
    assert_eq!(refusal(&up.expect("a mesh")), Some(RefitError::Revived(1)));
    assert_eq!(refusal(&flat), None);
}

/// A primitive that is a box.
#[derive(Clone, Copy, Debug)]
struct Block(Aabb);

impl Bounded for Block {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

#[test]
fn shapes_without_a_box_are_refused() {
    let blocks = [0.0, 1.0, 2.0].map(|x| Block(Aabb::of(&[Vec3::splat(x)])));
    let mut bvh = Bvh::build(&blocks[..]).expect("a tree");
    for bad in [Aabb::EMPTY, Aabb { lo: Vec3::ZERO, hi: Vec3::splat(f32::NAN) }] {
        let mut blocks = blocks;
        blocks[1].0 = bad;
        assert_eq!(bvh.refit(&blocks[..]), Err(RefitError::NoBox(1)));
    }
    assert_eq!(bvh.refit(&blocks[..]), Ok(()));
}
