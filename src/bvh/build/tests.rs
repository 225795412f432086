use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DVec3, Vec3};

use super::*;
use crate::bvh::tests::awkward;
use crate::bvh::{Bounded, BvhNode, validate};
use crate::generate::draw::Draw;
use crate::generate::procedural;
use crate::geom::{Aabb, Real, Vector};
use crate::order::{Side, SignOrder};
use crate::tree::Topology;

fn options(builder: Builder, max_leaf: u32, depth_limit: u32) -> BuildOptions {
    BuildOptions {
        builder,
        sah: SahOptions { max_leaf, depth_limit, ..SahOptions::default() },
        ..BuildOptions::default()
    }
}

#[test]
fn every_builder_is_sound_and_keeps_its_word() {
    for mesh in awkward() {
        let n = mesh.triangles().len();
        for builder in Builder::ALL {
            for max_leaf in [1, 2, 3, 4, 8, 2000] {
                let tightest = n.div_ceil(max_leaf as usize).next_power_of_two().ilog2();
                for limit in [tightest, tightest + 1, tightest + 4, 31, 100_000] {
                    let placed = AtomicUsize::new(0);
                    let progress = |n| {
                        placed.fetch_add(n, Ordering::Relaxed);
                    };
                    let bvh = options(builder, max_leaf, limit).build_watched(&mesh, &progress).expect("a tree");
                    validate(&bvh, &mesh).expect("sound");
                    assert!(bvh.depth() <= limit, "{builder} {n} {max_leaf} {limit}: {}", bvh.depth());
                    // Complete trees have no empty leaves, and so may need some of 2.
                    let most = if builder == Builder::Median { max_leaf.max(2) } else { max_leaf };
                    assert!(bvh.leaves().iter().all(|leaf| leaf.count <= most), "{builder} {n} {max_leaf}");
                    assert_eq!(placed.into_inner() + bvh.duplicates(), bvh.triangles().len(), "{builder}");
                    assert_eq!(bvh.triangles().len() + bvh.dropped(), n + bvh.duplicates());
                }
            }
            let refusal = options(builder, 1, 0).build(&mesh).err();
            let left = n - Bvh::median(&mesh, 4).expect("a tree").dropped();
            let expected = (left > 1).then_some(BuildError::DepthLimit { triangles: left, max_leaf: 1, limit: 0 });
            assert_eq!(refusal, expected, "{builder}");
        }
    }
}

#[test]
fn boxes_without_areas_are_halved() {
    // Areas of so small boxes are 0 in single precision.
    let soup = procedural::soup(7, 4000);
    let tiny = |size: f32| {
        let vertices = soup.vertices().iter().map(|&corner| corner * size).collect();
        Mesh::new(vertices, soup.triangles().to_vec()).expect("a mesh")
    };
    for size in [1e-23, 1e-25, 1e-30, 1e-36] {
        for builder in [Builder::Sah, Builder::Linear, Builder::Spatial] {
            let bvh = options(builder, 4, 100).build(&tiny(size)).expect("a tree");
            assert!(bvh.depth() <= 18, "{size:e} {builder}: {}", bvh.depth());
        }
    }
}

#[test]
fn any_number_of_threads_builds_the_same_tree() {
    // More than one chunk, and more than bins are filled by one task.
    let mesh = procedural::soup(3, 80_000);
    for builder in Builder::ALL {
        let build = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| options(builder, 4, 31).build(&mesh).expect("a tree"))
        };
        let one = build(1);
        validate(&one, &mesh).expect("sound");
        for threads in [2, 5] {
            let other = build(threads);
            assert!(one.nodes() == other.nodes(), "{builder} on {threads} threads");
            assert!(one.leaves() == other.leaves() && one.triangles() == other.triangles(), "{builder} on {threads}");
            assert_eq!((one.axes(), one.depth()), (other.axes(), other.depth()));
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Ball {
    centre: Vec3,
    radius: f32,
}

impl Bounded for Ball {
    fn aabb(&self) -> Aabb {
        Aabb { lo: self.centre - self.radius, hi: self.centre + self.radius }
    }
}

#[test]
fn a_hierarchy_of_balls_has_each_ball_once_and_inside() {
    let centres = procedural::soup(9, 2000);
    let ball = |(i, &centre): (usize, &Vec3)| Ball { centre, radius: 0.001 * (i % 7) as f32 };
    let mut balls: Vec<_> = centres.vertices().iter().enumerate().map(ball).collect();
    // Shapes without bounds are allowed, even if they have no middle.
    balls[17].radius = f32::INFINITY;
    balls[3000].centre.x = f32::NEG_INFINITY;
    for builder in Builder::ALL {
        let bvh = options(builder, 4, 31).build(&balls[..]).expect("a tree");
        let boxes = bvh.own_boxes();
        let mut seen = vec![false; balls.len()];
        for leaf in (0..bvh.leaves().len() as u32).map(Node::leaf) {
            for held in bvh.leaf_triangles(leaf) {
                assert!(!std::mem::replace(&mut seen[held.prim as usize], true), "{builder}: {} twice", held.prim);
                assert_eq!(held.shape, balls[held.prim as usize]);
                assert!(boxes[bvh.slot(leaf)].encloses(&held.shape.aabb()), "{builder}");
            }
        }
        assert!(seen.iter().all(|&seen| seen), "{builder}");
        let nested = |node: &crate::bvh::BvhNode, i: u32| {
            node.children.iter().all(|&child| boxes[bvh.slot(Node::inner(i))].encloses(&boxes[bvh.slot(child)]))
        };
        assert!((0..).zip(bvh.nodes()).all(|(i, node)| nested(node, i)), "{builder}");
    }
}

/// Expected cost of a ray through the root's box, in triangle tests.
fn cost(bvh: &Bvh) -> f32 {
    let boxes = bvh.own_boxes();
    let (inner, leaves) = boxes.split_at(bvh.nodes().len());
    let leaves = leaves.iter().zip(bvh.leaves()).map(|(aabb, leaf)| aabb.half_area() * leaf.count as f32);
    (inner.iter().map(|aabb| 2.0 * aabb.half_area()).chain(leaves).sum::<f32>()) / bvh.bounds().half_area()
}

#[test]
fn the_fast_builder_is_nearly_as_good() {
    for mesh in [procedural::stadium(1), procedural::strands(1, 500), procedural::soup(1, 20_000)] {
        let [sah, fast, median] = [Builder::Sah, Builder::Linear, Builder::Median]
            .map(|builder| cost(&options(builder, 4, 31).build(&mesh).expect("a tree")));
        assert!(fast < 1.25 * sah && fast < median, "{sah} {fast} {median}");
    }
}

#[test]
fn axes_say_which_child_comes_first() {
    let mesh = procedural::soup(5, 20_000);
    for builder in Builder::ALL {
        let bvh = options(builder, 4, 31).build(&mesh).expect("a tree");
        // Centroids of triangles are in order, so middles of boxes nearly always are.
        let is_first = |pair: &(&BvhNode, &u8)| {
            let (node, &axis) = *pair;
            let along = usize::from(axis % SignOrder::REVERSED);
            let [left, right] = [Side::Left, Side::Right].map(|side| node.child_box(side).centroid()[along]);
            if axis < SignOrder::REVERSED { left <= right } else { right <= left }
        };
        let first = bvh.nodes().iter().zip(bvh.axes()).filter(is_first).count();
        assert!(first as f32 > 0.9 * bvh.nodes().len() as f32, "{builder}: {first} of {}", bvh.nodes().len());
    }
}

#[test]
fn a_small_object_far_from_another_is_sorted_too() {
    // All but one triangle have the same code at first.
    let mut corners: Vec<Vec3> = procedural::soup(4, 3000).vertices().to_vec();
    corners.extend([1e8, 1.1e8, 1.2e8].map(|x| Vec3::new(x, x * x / 1e8, 0.0)));
    let triangles = (0..corners.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let mesh = Mesh::new(corners, triangles).expect("a mesh");
    let [sah, fast] =
        [Builder::Sah, Builder::Linear].map(|builder| options(builder, 4, 31).build(&mesh).expect("a tree"));
    validate(&fast, &mesh).expect("sound");
    validate(&fast, &mesh).expect("sound");
    let areas = |bvh: &Bvh| bvh.own_boxes().iter().skip(1).map(Aabb::half_area).filter(|&a| a < 10.0).sum::<f32>();
    assert!(areas(&fast) < 1.2 * areas(&sah), "{} {}", areas(&fast), areas(&sah));
}

#[test]
fn the_bounded_builder_has_eight_levels_and_then_medians() {
    let mesh = procedural::stadium(2);
    let sah = Bvh::sah(&mesh, SahOptions::default()).expect("a tree");
    let bounded = options(Builder::Bounded, 4, 31).build(&mesh).expect("a tree");
    // Primitives below each node of the eighth level.
    let mut rests = Vec::new();
    let mut pending = vec![(bounded.root(), sah.root(), 0)];
    while let Some((node, same, depth)) = pending.pop() {
        if depth == 8 {
            rests.push(below(&bounded, node));
        } else if !node.is_leaf() {
            assert_eq!(bounded.node(node.index()).planes, sah.node(same.index()).planes);
            let children = bounded.children(node).into_iter().zip(sah.children(same));
            pending.extend(children.map(|(child, same)| (child, same, depth + 1)));
        }
    }
    let greatest = rests.iter().copied().max().expect("the tree is deep enough");
    assert!(bounded.depth() <= 8 + greatest.next_power_of_two().ilog2(), "{} {greatest}", bounded.depth());
    assert!(bounded.depth() < sah.depth());
}

/// Number of primitives below a node.
fn below(bvh: &Bvh, node: Node) -> u32 {
    if node.is_leaf() {
        bvh.leaf_triangles(node).len() as u32
    } else {
        bvh.children(node).map(|child| below(bvh, child)).iter().sum()
    }
}

/// A box, or nothing.
#[derive(Clone, Copy, Debug)]
struct Block(Aabb);

impl Bounded for Block {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

fn blocks() -> Vec<Block> {
    (0..9u8).map(|i| Block(Aabb { lo: Vec3::splat(f32::from(i)), hi: Vec3::splat(f32::from(i) + 2.0) })).collect()
}

/// As they are when a tree takes on other shapes.
#[test]
fn primitives_without_a_box_are_refused() {
    let nan = Vec3::new(0.0, f32::NAN, 0.0);
    for bad in [Aabb::EMPTY, Aabb { lo: nan, hi: Vec3::ONE }, Aabb { lo: Vec3::ZERO, hi: nan }] {
        for place in [0, 5, 8] {
            let mut blocks = blocks();
            blocks[place].0 = bad;
            for builder in Builder::ALL {
                let mut options = options(builder, 1, 31);
                options.spatial = SpatialOptions { extra_percent: 100, overlap: 0.0 };
                let refusal = options.build(&blocks[..]).err();
                assert_eq!(refusal, Some(BuildError::NoBox(place as u32)), "{builder} {bad:?}");
            }
        }
    }
    let all = Aabb { lo: Vec3::NEG_INFINITY, hi: Vec3::INFINITY };
    for builder in Builder::ALL {
        let mut blocks = blocks();
        blocks[3].0 = all;
        assert_eq!(options(builder, 1, 31).build(&blocks[..]).map(|bvh| bvh.triangles().len()), Ok(9), "{builder}");
    }
}

/// Memory for further references is taken at once, so it has to be bounded.
#[test]
fn too_many_further_references_are_refused() {
    let build = |builder, extra_percent| {
        let spatial = SpatialOptions { extra_percent, overlap: 0.0 };
        BuildOptions { spatial, ..options(builder, 1, 31) }.build(&blocks()[..]).map(|bvh| bvh.triangles().len())
    };
    let most = SpatialOptions::MAX_EXTRA_PERCENT;
    assert!(build(Builder::Spatial, most).is_ok());
    for extra_percent in [most + 1, u32::MAX] {
        assert_eq!(build(Builder::Spatial, extra_percent), Err(BuildError::ExtraPercent(extra_percent)));
    }
    // Others ignore what does not concern them.
    assert!(build(Builder::Sah, u32::MAX).is_ok());
}

/// Thin and long triangles, which are cut, in frames or not: bounds are those of the triangles, by every builder. So it
/// depends on no builder whether an image of them fits. [INST-2]
fn bounds_depend_on_no_builder<V: Vector>(scales: &[f64]) {
    let mut draw = Draw::new(1);
    for round in 0..300 {
        let (scale, shift) =
            (scales[draw.below(scales.len())], if draw.one_in(2) { 0.0 } else { draw.int(100).into() });
        let vertices = (0..24).map(|_| {
            let v = (draw.centred().as_dvec3() * draw.ints(3).as_dvec3() + shift) * scale;
            V::from_components(v.to_array().map(V::Real::rounded))
        });
        let mesh =
            Mesh::new(vertices.collect(), (0..8).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).expect("a mesh");
        let bounds = |builder, reinsertion| {
            let spatial = SpatialOptions { extra_percent: 1000, overlap: 0.0 };
            let options = BuildOptions { builder, spatial, reinsertion, ..BuildOptions::fine() };
            options.build(&mesh).expect("a tree").bounds()
        };
        let expected = bounds(Builder::Median, 0);
        for builder in Builder::ALL {
            for reinsertion in [0, 3] {
                assert_eq!(bounds(builder, reinsertion), expected, "{round} {builder} {reinsertion} {scale:e} {shift}");
            }
        }
    }
}

#[test]
fn bounds_depend_on_no_builder_in_single() {
    bounds_depend_on_no_builder::<Vec3>(&[1.0, 1e30, 1e36, 1e-30, 1e-42]);
}

#[test]
fn bounds_depend_on_no_builder_in_double() {
    bounds_depend_on_no_builder::<DVec3>(&[1.0, 0.1, 1e30, 1e300, 1e-300, 1e-320]);
}
