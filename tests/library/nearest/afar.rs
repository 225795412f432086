//! Nearest points of a mesh from far away, where all its points are at nearly equal distances.

use glam::{DVec3, Vec3};
use stackless_bvh::bvh::{Bvh, WideBvh};
use stackless_bvh::generate::{Rng, procedural, stress};
use stackless_bvh::geom::{Ball, Mesh, Precision, Real, Triangle, Vector};
use stackless_bvh::order::{Descent, Flow, Pruned, Repeatable, Visitor};
use stackless_bvh::trace::{BinaryTracer, MeshQueries, NearestPoint, Tracer};
use stackless_bvh::traverse::{Method, Stack, traverse};
use stackless_bvh::tree::Node;
use stackless_check::{check_nearest, nearest as truth};

use super::{all, ball, meshes_of_all_kinds, point, trees};

/// Draws a point on the mesh or near it, moved away by a power of two.
fn afar<V: Vector>(mesh: &Mesh<V>, random: &mut Rng, power: i32) -> V {
    let near = point(mesh, random).widen();
    let away = near + (near - mesh.vertices()[0].widen()) * 2f64.powi(power);
    V::from_components(away.to_array().map(V::Real::rounded))
}

/// In double precision, far from the origin and in another unit.
fn moved(mesh: &Mesh, far: f64, unit: f64) -> Mesh<DVec3> {
    let vertices = mesh.vertices().iter().map(|v| (v.as_dvec3() + far) * unit).collect();
    Mesh::new(vertices, mesh.triangles().to_vec()).expect("a mesh")
}

fn check<V: Precision>(mesh: &Mesh<V>, powers: impl Iterator<Item = i32>) {
    let mut random = Rng::new(14);
    let trees = trees(mesh);
    let tracers: Vec<_> = trees
        .iter()
        .flat_map(|bvh| {
            Method::ALL.iter().filter_map(move |&m| BinaryTracer::<_, V::Exact, V::Slabs>::with_tests(bvh, m).ok())
        })
        .collect();
    for power in powers {
        let point = afar(mesh, &mut random, power);
        if !point.is_finite() {
            continue;
        }
        for bvh in &trees {
            let checked = check_nearest(bvh, mesh, point, V::Real::INFINITY, 1 + power as usize % 9);
            checked.unwrap_or_else(|fault| panic!("{fault}: {point:?}, 2^{power}"));
        }
        let truth = truth(mesh, point, V::Real::INFINITY, 3);
        for tracer in &tracers {
            assert_eq!(all(&tracer.nearest_k(&ball(point, f64::INFINITY), 3)), truth, "{tracer:?} {point:?} 2^{power}");
        }
    }
}

/// [NEAR-1] [NEAR-2] [NEAR-6] [NEAR-8]
#[test]
fn every_traversal_finds_what_is_nearest_from_afar() {
    for mesh in meshes_of_all_kinds() {
        check(&mesh, (0..128).step_by(3));
        for (far, unit) in [(0.0, 1.0), (1e6, 1.0), (0.0, 1e-60), (7.0, 1e60)] {
            check(&moved(&mesh, far, unit), (1..80).step_by(7).chain([46, 200, 500, 800]));
        }
    }
}

/// Wide trees, also of sizes at which squares underflow. [NEAR-4] [NEAR-6]
#[test]
fn wide_trees_find_what_is_nearest_from_afar() {
    let mut random = Rng::new(15);
    for mesh in meshes_of_all_kinds() {
        for unit in [0, -90, -120] {
            let vertices = mesh.vertices().iter().map(|&v| v * 2f32.powi(unit)).collect();
            let mesh = Mesh::new(vertices, mesh.triangles().to_vec()).expect("a mesh");
            let tracer = Tracer::new(WideBvh::build(&mesh).expect("a tree"));
            for power in 0..128 {
                let point = afar(&mesh, &mut random, power);
                if point.is_finite() {
                    let nears = tracer.nearest_k(&ball(point, f64::INFINITY), 3);
                    assert_eq!(all(&nears), truth(&mesh, point, f32::INFINITY, 3), "{point:?}, 2^{power} of 2^{unit}");
                }
            }
        }
    }
}

/// The stress suite, from the origins of its rays, from far away, and in double precision. [NEAR-1] [NEAR-3]
#[test]
fn the_nearest_of_stress_cases_are_the_truth() {
    for case in stress::cases(6) {
        let [single, double] = [Bvh::build(&case.mesh), Bvh::median(&case.mesh, 2)].map(|bvh| bvh.expect("a tree"));
        let wide = moved(&case.mesh, 0.0, 1.0);
        let wide_tree = Bvh::<Triangle<DVec3>>::build(&wide).expect("a tree");
        for (i, ray) in case.rays.iter().enumerate() {
            let point = ray.origin() * [1.0, 2f32.powi(22), 2f32.powi(100)][i % 3];
            if point.is_finite() {
                for bvh in [&single, &double] {
                    let checked = check_nearest(bvh, &case.mesh, point, f32::INFINITY, 1 + i);
                    checked.unwrap_or_else(|fault| panic!("{}: {fault}, {point}", case.name));
                }
            }
            let point = ray.origin().as_dvec3() * [1.0, 2f64.powi(47), 2f64.powi(600)][i % 3];
            let checked = check_nearest(&wide_tree, &wide, point, f64::INFINITY, 1 + i);
            checked.unwrap_or_else(|fault| panic!("{}: {fault}, {point}", case.name));
        }
    }
}

/// A search that counts the nodes and triangles that it looks at.
struct Counted<'a> {
    search: NearestPoint<'a, Bvh<Triangle<DVec3>>, DVec3>,
    bvh: &'a Bvh<Triangle<DVec3>>,
    count: usize,
}

impl Visitor for Counted<'_> {
    fn inner(&mut self, node: Node) -> Descent {
        self.count += 1;
        self.search.inner(node)
    }

    fn leaf(&mut self, leaf: Node) -> Flow {
        self.count += self.bvh.leaf_triangles(leaf).len();
        self.search.leaf(leaf)
    }
}

impl Pruned for Counted<'_> {}

impl Repeatable for Counted<'_> {}

/// Without bounds that tell equal distances, all are looked at. [NEAR-4] [NEAR-6] [NEAR-8]
#[test]
fn few_are_looked_at_from_afar() {
    let ways = [DVec3::X, DVec3::ONE, DVec3::new(0.3, -0.7, 0.2), DVec3::new(-0.9, 0.1, 0.4)];
    let (sphere, soup) = (stress::icosphere(5, 1.0, Vec3::ZERO).expect("a mesh"), procedural::soup(1, 20_000));
    for (mesh, most_single, most_double) in [(sphere, 4000, 1500), (soup, 4000, 500)] {
        for unit in [0, -100] {
            let vertices = mesh.vertices().iter().map(|&v| v * 2f32.powi(unit)).collect();
            let mesh = Mesh::new(vertices, mesh.triangles().to_vec()).expect("a mesh");
            let tracer = Tracer::of(&mesh).expect("a tracer");
            for (power, way) in (4..127).flat_map(|power| ways.map(|way| (power, way))) {
                let ball = Ball::around((way * 2f64.powi(power + unit)).as_vec3()).expect("a ball");
                let met = tracer.count_nearest(&[ball]);
                assert!(met.nodes + met.triangles < most_single, "2^{power} {way}: {met:?}");
            }
        }
        for unit in [1.0, 1e-50] {
            let mesh = moved(&mesh, 0.0, unit);
            let bvh = Bvh::<Triangle<DVec3>>::build(&mesh).expect("a tree");
            for (power, way) in (4..62).chain([200, 201, 600, 1000]).flat_map(|power| ways.map(|way| (power, way))) {
                let ball = Ball::around(way * 2f64.powi(power) * unit).expect("a ball");
                let search = NearestPoint::new(&bvh, &ball);
                let mut counted = Counted { search, bvh: &bvh, count: 0 };
                traverse(Stack::new(&bvh, &mut Vec::new()), &mut counted, &mut ());
                assert!(counted.count < most_double, "2^{power} {way}: {}", counted.count);
            }
        }
    }
}
