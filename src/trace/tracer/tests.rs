use super::shared::Counted;
use super::*;
use crate::bvh::{BuildOptions, Builder, Bvh};
use crate::generate::{double, procedural, stress};
use crate::geom::{Mesh, Real as _, Triangle, lanes};
use crate::order::{Descent, Flow, Visitor};
use crate::trace::truth::Truth;
use crate::trace::{BinaryTracer, WideCounters};
use crate::traverse;

fn bits<R: Into<f64>>(hit: Option<Hit<R>>) -> Option<(u32, [u64; 3])> {
    hit.map(|Hit { prim, t, u, v }| (prim, [t, u, v].map(|x| x.into().to_bits())))
}

type Binary<'b, V> = BinaryTracer<&'b Bvh<Triangle<V>>, <V as Precision>::Exact, <V as Precision>::Slabs>;

/// Checks that all traversals and levels answer like `BinaryTracer`, bit for bit. Returns the number of hits.
fn compare<V: Precision>(mesh: &Mesh<V>, rays: &[Ray<V>], options: &BuildOptions) -> usize {
    let bvh = options.build(mesh).expect("a hierarchy");
    let wide = WideBvh::of(&bvh).expect("a wide one");
    wide.validate(mesh).expect("sound");
    let binary = Binary::<V>::with_tests(&bvh, traverse::Method::default()).expect("a tracer");
    let expected: Vec<_> = binary.closest_each(rays).into_iter().map(bits).collect();
    let rare = Rare::of(&binary, rays);
    for method in Method::ALL {
        rare.compare(&Tracer::with_method(&wide, method).expect("a tracer"), rays);
        for (name, level) in lanes::levels() {
            let tracer = Tracer::with_method(&wide, method).expect("a tracer").with_level(level);
            let closest: Vec<_> = tracer.closest_each(rays).into_iter().map(bits).collect();
            assert_eq!(closest, expected, "{method} {name}");
            let any = tracer.any_each(rays);
            for (i, ray) in rays.iter().enumerate() {
                assert_eq!(bits(tracer.closest(ray)), expected[i], "{method} {name} {ray:?}");
                let is_hit = expected[i].is_some();
                assert_eq!((any[i], tracer.any(ray)), (is_hit, is_hit), "{method} {name} {ray:?}");
                assert_eq!(tracer.any_hit(ray).is_some(), is_hit);
            }
        }
    }
    expected.iter().flatten().count()
}

/// A binary tracer's answers to the queries that share one copy of the traversals, for every third ray.
struct Rare<V: Precision> {
    all: Vec<Vec<Hit<V::Real>>>,
    crossings: Vec<u32>,
    near: Vec<Vec<Near<V>>>,
}

/// Some balls contain no triangle, and some contain all.
fn ball<V: Precision>(i: usize, ray: &Ray<V>) -> Ball<V> {
    let length = ray.direction().widen().length();
    Ball::new(ray.origin(), V::Real::rounded([0.1, 0.5 * length, f64::INFINITY][i % 3])).expect("a ball")
}

/// None, one, some, and all.
const SEVERAL: [usize; 4] = [0, 1, 5, 100_000];

impl<V: Precision> Rare<V> {
    fn of(binary: &Binary<'_, V>, rays: &[Ray<V>]) -> Self {
        let rays = || rays.iter().step_by(3).enumerate();
        Self {
            all: rays().map(|(_, ray)| binary.all(ray)).collect(),
            crossings: rays().map(|(_, ray)| binary.crossings(ray)).collect(),
            near: rays().map(|(i, ray)| binary.nearest_k(&ball(i, ray), SEVERAL[i % 4])).collect(),
        }
    }

    fn compare(&self, tracer: &Tracer<&WideBvh<8, V>, V>, rays: &[Ray<V>]) {
        let method = tracer.method();
        for (i, ray) in rays.iter().step_by(3).enumerate() {
            let all: Vec<_> = tracer.all(ray);
            assert_eq!(all, self.all[i], "{method} {ray:?}");
            assert_eq!(tracer.crossings(ray), self.crossings[i], "{method} {ray:?}");
            let before_all = V::Real::rounded(f64::NEG_INFINITY);
            let after = |hit: Option<&Hit<V::Real>>| hit.map_or((before_all, 0), |hit| (hit.t, hit.prim));
            for at in 0..=all.len().min(4) {
                assert_eq!(tracer.next(ray, after(all[..at].last())), all.get(at).copied(), "{method} {ray:?} {at}");
            }
            let ball = ball(i, ray);
            let near = tracer.nearest_k(&ball, SEVERAL[i % 4]);
            assert_eq!(near, self.near[i], "{method} {ball:?}");
            assert_eq!(tracer.nearest(&ball), tracer.nearest_k(&ball, 1).pop(), "{method} {ball:?}");
        }
    }
}

/// [DET-1] [PARITY-1] [NEAR-1] [NEAR-2] [NEAR-4] [LANES-1] [LANES-2] [LANES-3] [LANES-4] [WIDE-4] [WIDE-8]
#[test]
fn all_traversals_and_levels_answer_as_the_binary_tracer_does() {
    let meshes = [procedural::soup(1, 500), procedural::strands(2, 60), procedural::layers(40)];
    for mesh in &meshes {
        let rays = procedural::rays(mesh, 3, 300);
        for builder in Builder::ALL {
            let hits = compare(mesh, &rays, &BuildOptions { builder, ..BuildOptions::default() });
            assert!(hits > 20, "{hits}");
        }
    }
}

#[test]
fn hard_rays_are_answered_as_by_the_binary_tracer() {
    let mut hits = 0;
    for case in stress::cases(16) {
        hits += compare(&case.mesh, &case.rays, &BuildOptions::default());
    }
    assert!(hits > 1000, "{hits}");
}

#[test]
fn the_truth_is_the_answer() {
    let mesh = procedural::soup(4, 300);
    let (truth, rays) = (Truth::new(&mesh), procedural::rays(&mesh, 5, 400));
    let tracer = Tracer::new(WideBvh::of(&Bvh::build(&mesh).unwrap()).unwrap());
    for ray in &rays {
        let expected = truth.closest(ray).map(|hit| hit.rounded());
        assert_eq!(bits(tracer.closest(ray)), bits(expected), "{ray:?}");
        assert_eq!(tracer.closest_distance(ray), expected.map(|hit| (hit.prim, hit.t)));
    }
    assert_eq!(tracer.closest_parallel(&rays), Ok(tracer.closest_each(&rays)));
    assert_eq!(tracer.any_parallel(&rays), Ok(tracer.any_each(&rays)));
    assert_eq!(tracer.any_hit_parallel(&rays), Ok(tracer.any_hit_each(&rays)));
    assert_eq!(tracer.all_parallel(&rays), Ok(tracer.all_each(&rays)));
    assert_eq!(tracer.crossings_parallel(&rays), Ok(tracer.crossings_each(&rays)));
    let balls: Vec<_> = rays.iter().enumerate().map(|(i, ray)| ball(i, ray)).collect();
    assert_eq!(tracer.nearest_parallel(&balls), Ok(tracer.nearest_each(&balls)));
    assert_eq!(tracer.nearest_each(&balls), BinaryTracer::of(&mesh).unwrap().nearest_each(&balls));
}

#[test]
fn an_empty_hierarchy_and_no_rays() {
    let ray = Ray::new(glam::Vec3::ZERO, glam::Vec3::X).unwrap();
    for method in Method::ALL {
        let tracer = Tracer::with_method(WideBvh::empty(), method).unwrap();
        assert_eq!((tracer.closest(&ray), tracer.any(&ray)), (None, false));
        assert_eq!(tracer.closest_each(&[ray; 3]), [None; 3]);
        assert_eq!(tracer.any_each(&[]), [false; 0]);
        assert_eq!((tracer.all(&ray).len(), tracer.next(&ray, (0.0, 0)), tracer.crossings(&ray)), (0, None, 0));
        let ball = Ball::around(glam::Vec3::ZERO).unwrap();
        assert_eq!((tracer.nearest(&ball), tracer.nearest_k(&ball, 3)), (None, vec![]));
    }
}

/// Rays end in another order than they begin, and with every possible number of remaining rays.
#[test]
fn each_answer_is_of_its_ray() {
    let mesh = procedural::soup(6, 200);
    let tracer = Tracer::new(WideBvh::of(&Bvh::build(&mesh).unwrap()).unwrap());
    let rays = procedural::rays(&mesh, 7, 64);
    let expected: Vec<_> = rays.iter().map(|ray| tracer.closest_distance(ray)).collect();
    for count in 0..rays.len() {
        let mut found = vec![Some((7, 7.0)); rays.len()];
        tracer.closest_distances(&rays[..count], &mut found);
        assert_eq!(found[..count], expected[..count]);
        assert!(found[count..].iter().all(|&untouched| untouched == Some((7, 7.0))));
    }
}

/// All visit the same leaves. A stack never returns to a node. The record does if more than two children were pending.
#[test]
fn traversals_differ_in_how_often_they_ask() {
    let mesh = procedural::soup(8, 3000);
    let (wide, rays) = (WideBvh::build(&mesh).unwrap(), procedural::rays(&mesh, 9, 200));
    let count = |method| Tracer::with_method(&wide, method).unwrap().count_closest(&rays);
    let stack = count(Method::Stack);
    assert!(stack.rays == 200 && stack.nodes > 200 && stack.triangles > stack.leaves);
    for method in Method::ALL {
        let counted = count(method);
        assert_eq!((counted.leaves, counted.triangles), (stack.leaves, stack.triangles), "{method}");
        assert!(counted.nodes >= stack.nodes, "{method}");
    }
    let [record, hashed, trail] = [Method::Recorded, Method::Hashed, Method::Trail].map(|method| count(method).nodes);
    assert!(stack.nodes < record && record == hashed && record < trail);
}

/// [NEAR-6]
#[test]
fn few_of_many_that_are_equally_near_are_looked_at() {
    const SPOKES: u32 = 4096;
    let spoke = |i: u32| {
        let angle = f64::from(i) / f64::from(SPOKES) * std::f64::consts::TAU;
        [angle.cos() as f32, angle.sin() as f32, 0.0].into()
    };
    let vertices = std::iter::once(glam::Vec3::ZERO).chain((0..SPOKES).map(spoke)).collect();
    // Indices are scattered over the fan.
    let triangle = |i: u32| [0, 1 + i * 1597 % SPOKES, 1 + (i * 1597 + 1) % SPOKES];
    let mesh = Mesh::new(vertices, (0..SPOKES).map(triangle).collect()).expect("a mesh");
    let bvh = Bvh::build(&mesh).expect("a hierarchy");
    let wide = WideBvh::of(&bvh).expect("a wide one");
    for height in [0.0, 0.25, 0.1] {
        let ball = Ball::around(glam::Vec3::Z * height).expect("a ball");
        for k in [1, 3, 40] {
            let is_first = |nears: Vec<Near>| {
                nears.len() == k && nears.iter().zip(0..).all(|(near, i)| (near.prim, near.distance) == (i, height))
            };
            for method in Method::ALL {
                let tracer = Tracer::with_method(&wide, method).expect("a tracer");
                assert!(is_first(tracer.nearest_k(&ball, k)), "{method} {height} {k}");
            }
            for method in traverse::Method::ALL {
                let Ok(tracer) = BinaryTracer::with_method(&bvh, method) else { continue };
                assert!(is_first(tracer.nearest_k(&ball, k)), "{method} {height} {k}");
            }
        }
        let mut counters = WideCounters::default();
        let mut query = NearestPoint::new(&wide, &ball);
        Tracer::new(&wide).run_shared(&mut Counted(&mut query, &mut counters));
        assert_eq!(query.near().map(|near| near.prim), Some(0));
        assert!(counters.triangles < 600, "{height}: {counters:?}");
        let mut looked_at = Leaves { query: NearestPoint::new(&bvh, &ball), count: 0 };
        traverse::traverse(traverse::Stack::new(&bvh, &mut Vec::new()), &mut looked_at, &mut ());
        assert!(looked_at.count < 200, "{height}: {}", looked_at.count);
    }
}

/// Counts visited leaves.
struct Leaves<Q> {
    query: Q,
    count: usize,
}

impl<Q: Visitor> Visitor for Leaves<Q> {
    fn inner(&mut self, node: Node) -> Descent {
        self.query.inner(node)
    }

    fn leaf(&mut self, leaf: Node) -> Flow {
        self.count += 1;
        self.query.leaf(leaf)
    }
}

/// A short direction, whose distances overflow, must not visit all boxes. `[LANES-1]`
#[test]
fn short_directions_leave_boxes_out() {
    let mesh = stress::icosphere(4, 1.0, glam::Vec3::ZERO).expect("a sphere");
    let tracer = Tracer::of(&mesh).expect("a tracer");
    let truth = Truth::new(&mesh);
    let short = crate::generate::draw::exp2(-140);
    for x in [5.0, 0.25] {
        let rays =
            [1.0, short].map(|length| Ray::new(glam::Vec3::new(x, 0.5, -3.0), glam::Vec3::Z * length).expect("a ray"));
        let nodes = rays.map(|ray| tracer.count_closest(&[ray]).nodes);
        assert!(nodes[1] <= 8 * nodes[0], "{nodes:?}");
        assert_eq!(tracer.closest(&rays[1]), truth.closest(&rays[1]).map(|hit| hit.rounded()));
    }
}

/// Double precision, at places beyond the reach of single precision. [DET-1] [BOX-8] [BOX-9] [LANES-3] [LANES-4]
/// [LANES-6] [LANES-7]
#[test]
fn doubles_are_answered_as_by_the_binary_tracer() {
    let mut hits = 0;
    for (i, case) in stress::cases(10).enumerate() {
        let place = double::PLACES[i % double::PLACES.len()];
        let Ok(mesh) = place.mesh(&case.mesh) else { continue };
        let mut rays: Vec<_> = case.rays.iter().filter_map(|ray| place.ray(ray)).collect();
        rays.extend(double::aimed(&mesh, 1, 24));
        hits += compare(&mesh, &rays, &BuildOptions::fine());
    }
    assert!(hits > 1000, "{hits}");
}

/// Large numbers of rays reach rare cases. The last ray is distant and leaves the scene. [BOX-9]
#[test]
fn many_doubles_are_answered_as_by_the_binary_tracer() {
    for mesh in [procedural::soup(1, 500), procedural::strands(2, 60), procedural::layers(40)] {
        for place in double::PLACES {
            let mesh = place.mesh(&mesh).expect("a mesh");
            let bvh = BuildOptions::fine().build(&mesh).expect("a hierarchy");
            let (tracer, mut rays) = (Tracer::of(&mesh).expect("a tracer"), double::aimed(&mesh, 2, 6_000));
            let lo = mesh.vertices().iter().fold(glam::DVec3::INFINITY, |lo, &v| lo.min(v));
            let hi = mesh.vertices().iter().fold(glam::DVec3::NEG_INFINITY, |hi, &v| hi.max(v));
            rays.extend(Ray::new(hi + (hi - lo) * 100.0, hi - lo));
            let binary = Binary::with_tests(&bvh, traverse::Method::default()).expect("a tracer");
            let (closest, any) = (tracer.closest_each(&rays), tracer.any_each(&rays));
            let mut found = vec![Some((7, 7.0)); rays.len()];
            tracer.closest_distances(&rays, &mut found);
            for (i, expected) in binary.closest_each(&rays).into_iter().enumerate() {
                let distance = expected.map(|hit| (hit.prim, hit.t));
                assert_eq!(bits(closest[i]), bits(expected), "{} {:?}", place.name, rays[i]);
                assert_eq!((any[i], found[i]), (expected.is_some(), distance), "{} {:?}", place.name, rays[i]);
            }
        }
    }
}

mod plan;
