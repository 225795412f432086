use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{Vec3, Vec3A};

use super::extents::Spread;
use super::split::Scale;
use super::*;
use crate::bvh::{Bvh, BvhError, validate};
use crate::generate::{procedural, stress};
use crate::geom::{Aabb, Mesh, Ray, Triangle};
use crate::trace::truth::Truth;
use crate::trace::{Closest, Hit};
use crate::traverse::{Stack, traverse};
use crate::tree::Topology;

fn options(extra_percent: u32, overlap: f32) -> BuildOptions {
    let spatial = SpatialOptions { extra_percent, overlap };
    BuildOptions { builder: super::super::Builder::Spatial, spatial, ..BuildOptions::default() }
}

fn build(mesh: &Mesh, options: &BuildOptions) -> Bvh {
    let bvh = options.build(mesh).expect("a tree");
    validate(&bvh, mesh).expect("sound");
    bvh
}

fn meshes() -> Vec<Mesh> {
    // Long parallel diagonals, identical triangles, and coordinates whose extent overflows.
    let diagonals = (0..60).flat_map(|i| {
        let (from, to) = (Vec3::X * (i as f32 * 0.3), Vec3::new(i as f32 * 0.3 + 9.0, 9.0, 9.1));
        [from, to, to + Vec3::X * 0.1]
    });
    let same = [Vec3::ZERO, Vec3::X, Vec3::Y].into_iter().cycle().take(600);
    let huge = (0..300).map(|i| Vec3::new([3e38, -3e38, 1.0][i % 3], [-3e38, 3e38][i % 2], i as f32));
    let mesh = |vertices: Vec<Vec3>| {
        let count = vertices.len() as u32 / 3;
        Mesh::new(vertices, (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).expect("a mesh")
    };
    let made = [diagonals.collect(), same.collect(), huge.collect()].map(mesh);
    made.into_iter().chain([procedural::soup(3, 700), procedural::strands(3, 40), procedural::soup(3, 1)]).collect()
}

#[test]
fn trees_are_sound_and_keep_depth_limit_leaf_size_and_budget() {
    let mut most = 0;
    for mesh in meshes() {
        let n = mesh.triangles().len();
        for (extra_percent, overlap) in [(0, 0.0), (10, 0.0), (30, 1e-3), (300, 0.0), (30, f32::NAN)] {
            for max_leaf in [1, 4] {
                let tightest = n.div_ceil(max_leaf as usize).next_power_of_two().ilog2();
                for depth_limit in [tightest, tightest + 2, 60] {
                    let mut options = options(extra_percent, overlap);
                    (options.sah.max_leaf, options.sah.depth_limit) = (max_leaf, depth_limit);
                    let bvh = build(&mesh, &options);
                    assert!(bvh.depth() <= depth_limit);
                    assert!(bvh.leaves().iter().all(|leaf| leaf.count <= max_leaf));
                    assert!(100 * bvh.duplicates() <= extra_percent as usize * n, "{}", bvh.duplicates());
                    most = most.max(100 * bvh.duplicates() / n);
                }
            }
        }
    }
    assert!(most > 100, "{most} in 100 were cut");
}

#[test]
fn boxes_become_smaller() {
    let mesh = &meshes()[0];
    let area = |bvh: Bvh| bvh.own_boxes().iter().map(Aabb::half_area).sum::<f32>() / bvh.bounds().half_area();
    let [plain, cut] = [0, 300].map(|extra| area(build(mesh, &options(extra, 0.0))));
    assert!(cut < 0.7 * plain, "{cut} {plain}");
}

#[test]
fn slices_are_nearly_the_parts() {
    let mut compared = 0;
    for mesh in [&meshes()[0], &procedural::soup(5, 300)] {
        for prim in 0..mesh.triangles().len() {
            let corners = mesh.corners(prim).expect("a triangle").map(Vec3A::from);
            let whole = Spread::of(&Record::item(&mesh.aabb(prim), 0));
            // The whole triangle, and a part of it: its middle half on every axis.
            let quarter = (whole.hi - whole.lo) * 0.25;
            for node in [whole, Spread { lo: whole.lo + quarter, hi: whole.hi - quarter }] {
                for axis in 0..3 {
                    let Some(scale) = Scale::new(&whole, axis, 8) else { continue };
                    let [begin, end] = [node.lo, node.hi].map(|plane| scale.bin(plane[axis]));
                    let mut slices = [Spread::EMPTY; 8];
                    bins::slice(&mut slices[..=end - begin], corners, begin, &scale, axis);
                    for (slice, bin) in slices.iter().zip(begin..=end) {
                        let mut within = node.aabb();
                        within.lo[axis] = within.lo[axis].max(scale.border(bin));
                        within.hi[axis] = within.hi[axis].min(scale.border(bin + 1));
                        let [slice, part] = [slice.intersection(node).aabb(), mesh.part(prim, &within)];
                        // The bound of rounding errors, from the extent and the coordinates.
                        let greatest = Vec3::from(whole.lo.abs().max(whole.hi.abs())).max_element();
                        let slack =
                            1e-5 * Vec3::from(whole.hi - whole.lo).max_element() + 4.0 * f32::EPSILON * greatest;
                        // A part of a part is clipped by all of its planes, a slice by two, so the slice is larger.
                        let holds = (slice.lo - slack).cmple(part.lo).all() && part.hi.cmple(slice.hi + slack).all();
                        let is_near = (slice.lo - part.lo).abs().max((part.hi - slice.hi).abs()).max_element() < slack;
                        let is_cut_before = node.lo != whole.lo;
                        if part.lo.cmple(part.hi).all() {
                            assert!(holds && (is_cut_before || is_near), "{prim} {axis} {bin}: {slice:?} for {part:?}");
                            compared += 1;
                        }
                    }
                }
            }
        }
    }
    assert!(compared > 5000, "{compared}");
}

#[test]
fn planes_that_cut_more_than_there_is_room_for_are_not_tried() {
    // All triangles are equal, so every plane cuts all of them.
    let bvh = build(&meshes()[1], &options(50, 0.0));
    assert_eq!(bvh.duplicates(), 0);
    assert!(build(&meshes()[1], &options(100, 0.0)).duplicates() > 0);
}

#[test]
fn the_tree_does_not_depend_on_the_number_of_threads_and_progress_counts_all() {
    let mesh = procedural::soup(4, 9000);
    let trees = [1, 2, 5].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let counted = AtomicUsize::new(0);
        let progress = |n: usize| {
            counted.fetch_add(n, Ordering::Relaxed);
        };
        let bvh = pool.install(|| options(50, 0.0).build_watched(&mesh, &progress)).expect("a tree");
        assert_eq!(counted.into_inner() + bvh.dropped(), mesh.triangles().len());
        assert!(bvh.duplicates() > 1000, "{}", bvh.duplicates());
        bvh
    });
    for other in &trees[1..] {
        assert_eq!((trees[0].nodes(), trees[0].leaves()), (other.nodes(), other.leaves()));
        assert_eq!(trees[0].triangles(), other.triangles());
    }
}

#[test]
fn closest_hits_are_the_truth() {
    let mut cut = 0;
    for case in stress::cases(60) {
        let bvh = build(&case.mesh, &options(200, 0.0));
        cut += usize::from(bvh.duplicates() > 10);
        let truth = Truth::new(&case.mesh);
        for ray in &case.rays {
            let expected = bits(truth.closest(ray).map(|hit| hit.rounded()));
            assert_eq!(bits(closest(&bvh, ray)), expected, "{}: {ray:?}", case.name);
        }
    }
    assert!(cut > 20, "{cut} trees have parts");
}

fn closest(bvh: &Bvh, ray: &Ray) -> Option<Hit> {
    let mut search = Closest::new(bvh, ray);
    traverse(Stack::new(bvh, &mut Vec::new()), &mut search, &mut ());
    search.hit()
}

fn bits(hit: Option<Hit>) -> Option<(u32, [u32; 3])> {
    hit.map(|Hit { prim, t, u, v }| (prim, [t, u, v].map(f32::to_bits)))
}

/// A mesh whose parts are too small by one ulp.
struct Clumsy<'a>(&'a Mesh);

impl Primitives for Clumsy<'_> {
    type Shape = Triangle;

    fn count(&self) -> usize {
        self.0.count()
    }

    fn shape(&self, index: usize) -> Triangle {
        self.0.shape(index)
    }

    fn aabb(&self, index: usize) -> Aabb {
        self.0.aabb(index)
    }

    fn part(&self, index: usize, part: &Aabb) -> Aabb {
        let part = self.0.part(index, part);
        Aabb { hi: part.hi.with_x(part.hi.x.next_down()), ..part }
    }
}

#[test]
fn validation_sees_parts_that_are_too_small_by_one_float() {
    let mesh = &meshes()[0];
    let options = options(100, 0.0);
    let bvh = options.build(&Clumsy(mesh)).expect("a tree");
    assert!(bvh.duplicates() > 10);
    assert!(matches!(validate(&bvh, mesh), Err(BvhError::Uncovered(_))));
}

#[test]
fn validation_counts_duplicates() {
    let mesh = &meshes()[0];
    let bvh = build(mesh, &options(100, 0.0));
    let found = bvh.duplicates();
    let with = |duplicates: usize| validate(&Bvh { duplicates, ..bvh.clone() }, mesh);
    assert_eq!(with(found + 1), Err(BvhError::Duplicates { stored: found + 1, found }));
    assert_eq!(with(found - 1), Err(BvhError::Duplicates { stored: found - 1, found }));
    assert!(matches!(with(0), Err(BvhError::Twice { .. } | BvhError::Outside { .. })));
}
