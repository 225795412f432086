use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DVec3, Vec3};

use super::*;
use crate::bvh::tests::awkward;
use crate::bvh::{Bounded, validate};
use crate::generate::draw::Draw;
use crate::generate::procedural;
use crate::geom::{Aabb, Real, Vector, power_of_two};
use crate::tree::Topology;

fn options(builder: Builder, max_leaf: u32, depth_limit: u32) -> BuildOptions {
    BuildOptions { builder, sah: SahOptions { max_leaf, depth_limit }, ..BuildOptions::default() }
}

/// [BUILD-2] [BUILD-3]
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
                    // Complete trees have no empty leaves, so some leaves may need 2.
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
    // The areas of these small boxes are 0 in single precision.
    let soup = procedural::soup(7, 4000);
    let tiny = |size: f32| {
        let vertices = soup.vertices().iter().map(|&corner| corner * size).collect();
        Mesh::new(vertices, soup.triangles().to_vec()).expect("a mesh")
    };
    for size in [1e-23, 1e-25, 1e-30, 1e-36] {
        for builder in Builder::ALL {
            let bvh = options(builder, 4, 100).build(&tiny(size)).expect("a tree");
            assert!(bvh.depth() <= 18, "{size:e} {builder}: {}", bvh.depth());
        }
    }
}

/// [BUILD-1]
#[test]
fn any_number_of_threads_builds_the_same_tree() {
    // More than one chunk, and more than one task for filling bins.
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

fn is_same(a: &Draft, b: &Draft) -> bool {
    let mut pairs = a.nodes.iter().zip(&b.nodes);
    a.nodes.len() == b.nodes.len() && pairs.all(|(a, b)| a.is_same(b) && a.first() == b.first())
}

/// [BUILD-1]
#[test]
fn any_level_builds_the_same_tree() {
    for mesh in [procedural::soup(3, 20_000), procedural::strands(1, 2000)] {
        for builder in Builder::ALL {
            let at = |level| options(builder, 4, 31).draft_by(level, &mesh, &|_| ()).expect("a tree").0;
            let drafts: Vec<_> = levels().into_iter().map(|(_, level)| at(level)).collect();
            assert!(drafts.iter().all(|draft| is_same(draft, &drafts[0])), "{builder}");
        }
    }
}

/// If areas overflow or vanish, the tree is no worse. [BUILD-4]
#[test]
fn trees_do_not_depend_on_the_unit() {
    let soup = procedural::soup(7, 3000);
    let order = |exponent: i32| {
        let vertices = soup.vertices().iter().map(|&corner| corner * power_of_two(exponent) as f32).collect();
        let mesh = Mesh::new(vertices, soup.triangles().to_vec()).expect("a mesh");
        let bvh = Bvh::build(&mesh).expect("a tree");
        validate(&bvh, &mesh).expect("sound");
        bvh.triangles().iter().map(|held| held.prim).collect::<Vec<_>>()
    };
    let expected = order(0);
    for exponent in [-90, -60, -30, 30, 60, 120] {
        assert!(order(exponent) == expected, "2^{exponent}");
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
    // Shapes without bounds are valid, even without a centroid.
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

/// Returns the expected cost of a ray through the root's box, in triangle tests.
fn cost(bvh: &Bvh) -> f32 {
    let boxes = bvh.own_boxes();
    let (inner, leaves) = boxes.split_at(bvh.nodes().len());
    let leaves = leaves.iter().zip(bvh.leaves()).map(|(aabb, leaf)| aabb.half_area() * leaf.count as f32);
    (inner.iter().map(|aabb| 2.0 * aabb.half_area()).chain(leaves).sum::<f32>()) / bvh.bounds().half_area()
}

#[test]
fn trees_by_area_are_the_cheapest() {
    for mesh in [procedural::stadium(1), procedural::strands(1, 500), procedural::soup(1, 20_000)] {
        let costs = [Builder::Standard, Builder::Best, Builder::Bounded, Builder::Median]
            .map(|builder| cost(&options(builder, 4, 31).build(&mesh).expect("a tree")));
        let [standard, best, bounded, median] = costs;
        let (least, most) = (standard.min(best), standard.max(best));
        assert!(most < 1.2 * least && most < bounded && bounded < median, "{costs:?}");
    }
}

#[test]
fn the_bounded_builder_has_eight_levels_and_then_medians() {
    let mesh = procedural::stadium(2);
    let bounded = options(Builder::Bounded, 4, 31).build(&mesh).expect("a tree");
    let standard = Bvh::sah(&mesh, SahOptions::default()).expect("a tree");
    // Number of primitives below each node of the eighth level, and its depth.
    let mut rests = Vec::new();
    let mut pending = vec![(bounded.root(), 0)];
    while let Some((node, depth)) = pending.pop() {
        if depth == 8 {
            rests.push(below(&bounded, node));
        } else if !node.is_leaf() {
            pending.extend(bounded.children(node).map(|child| (child, depth + 1)));
        }
    }
    let greatest = rests.iter().copied().max().expect("the tree is deep enough");
    assert!(bounded.depth() <= 8 + greatest.next_power_of_two().ilog2(), "{} {greatest}", bounded.depth());
    assert!(bounded.depth() < standard.depth());
}

/// Returns the number of primitives below a node.
fn below(bvh: &Bvh, node: Node) -> u32 {
    if node.is_leaf() {
        bvh.leaf_triangles(node).len() as u32
    } else {
        bvh.children(node).map(|child| below(bvh, child)).iter().sum()
    }
}

/// A primitive that is a box.
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

/// Its box may be invalid: NaN or inverted. Refitting a tree to other shapes accepts such boxes.
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

/// A vector reports this error for impossible capacities.
#[test]
fn memory_that_there_is_not_is_an_error() {
    assert_eq!(room::<Vec3>(usize::MAX / 2).err(), Some(BuildError::Memory(usize::MAX)));
    assert_eq!(filled(7_u64, 3), Ok(vec![7; 3]));
}

/// The memory for additional references is allocated at once, so it must be bounded.
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
    // Other builders ignore options that do not apply to them.
    assert!(build(Builder::Standard, u32::MAX).is_ok());
}

/// Long, thin triangles that are split, with and without frames. With every builder the bounds equal those of the
/// triangles, so no builder affects whether an image fits. [INST-2]
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
        let bounds = |builder| {
            let spatial = SpatialOptions { extra_percent: 1000, overlap: 0.0 };
            let options = BuildOptions { builder, spatial, ..BuildOptions::fine() };
            options.build(&mesh).expect("a tree").bounds()
        };
        let expected = bounds(Builder::Median);
        for builder in Builder::ALL {
            assert_eq!(bounds(builder), expected, "{round} {builder} {scale:e} {shift}");
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
