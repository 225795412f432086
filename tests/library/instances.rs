//! Comparison of instances with an oracle that transforms every triangle in rational arithmetic. `[INST-1]` to
//! `[INST-6]`, `[INST-8]`

mod afar;
mod filters;
mod nearest;
pub(crate) mod scenes;
mod thresholds;

use std::sync::Arc;

use glam::{DVec3, Vec3};
use scenes::{Kind, Scene, narrow, unit, vector};
use stackless_bvh::bvh::wide::WideOptions;
use stackless_bvh::bvh::{BuildOptions, Builder, Bvh, SahOptions, WideBvh};
use stackless_bvh::generate::{Rng, Source, stress};
use stackless_bvh::geom::{AffineMap, Ends, ExactRay, Mesh, Precision, Ray, Real, Vector};
use stackless_bvh::trace::{
    Assembly, AssemblyError, Instance, InstanceError, InstanceHit, InstanceTracer, Object, RayQueries,
};
use stackless_bvh::traverse::Method;
use stackless_bvh::wide::{self, Topology};
use stackless_check::{Hierarchies, InstanceOracle, Shape, check_answer, check_instances};

fn options(builder: Builder, max_leaf: u32) -> BuildOptions {
    BuildOptions { builder, sah: SahOptions { max_leaf, ..SahOptions::default() }, ..BuildOptions::default() }
}

fn hierarchies<V: Precision>(scene: &Scene<V>, builder: Builder, max_leaf: u32) -> Hierarchies<V> {
    Hierarchies::new(&scene.shapes, options(builder, max_leaf), None).expect("trees")
}

/// Returns hierarchies with wide meshes.
fn wide<V: Precision>(scene: &Scene<V>, builder: Builder, max_leaf: u32) -> Hierarchies<V> {
    let wide = WideOptions { max_leaf, ..WideOptions::default() };
    Hierarchies::new(&scene.shapes, options(builder, max_leaf), Some(&wide)).expect("trees")
}

fn assembly<V: Precision>(built: &Hierarchies<V>, scene: &Scene<V>) -> (Assembly<V>, Object) {
    let (assembly, objects) = built.assembly(&scene.shapes).expect("groups");
    (assembly, *objects.last().expect("a shape"))
}

/// Draws up to `n` rays: at corners, edges and insides of triangles, along the axes through corners, and from corner to corner.
fn rays<V: Precision>(flat: &InstanceOracle<V>, rng: &mut Rng, n: usize) -> Vec<Ray<V>> {
    let corners: Vec<_> = flat.corners().map(|corners| corners.map(Vector::widen)).collect();
    let all = corners.iter().flatten();
    let (lo, hi) = all.fold((DVec3::MAX, DVec3::MIN), |(lo, hi), corner| (lo.min(*corner), hi.max(*corner)));
    let size = (hi - lo).max_element();
    let mut rays = Vec::new();
    // If all corners are equal, a part of the rays is invalid.
    for _ in 0..4 * n {
        if rays.len() == n {
            break;
        }
        let [a, b, c] = corners[rng.below(corners.len() as u64) as usize];
        let (u, v) = (unit(rng).abs(), unit(rng).abs());
        let target = match rng.below(4) {
            0 => a,
            1 => a + (b - a) * 0.5,
            2 => a + (b - a) * u,
            _ => a + (b - a) * u + (c - a) * (v * (1.0 - u)),
        };
        let axis = DVec3::AXES[rng.below(3) as usize] * size;
        let rounded = |v: DVec3| narrow::<V>(v).widen();
        let (origin, direction) = match rng.below(5) {
            0 => (target - axis * 2.0, axis),
            1 => (target + axis, -axis),
            2 => {
                let other = corners[rng.below(corners.len() as u64) as usize][0];
                (target + (target - other), other - target)
            }
            _ => {
                let origin = rounded(lo * 0.5 + hi * 0.5 + vector(rng) * (2.0 * size));
                (origin, target - origin)
            }
        };
        rays.extend(Ray::new(narrow(origin), narrow(direction)));
    }
    rays
}

/// Returns the ray with an end or its begin at a hit, where rounding must not decide.
fn cut<V: Precision>(ray: &Ray<V>, hit: &InstanceHit<V::Real>) -> impl Iterator<Item = Ray<V>> + use<V> {
    let (t, zero, infinity) = (hit.t, V::Real::ZERO, V::Real::INFINITY);
    let ends = [(zero, t), (t, infinity), (zero, t.next_down()), (t.next_up(), infinity)];
    let ray = *ray;
    ends.into_iter().filter_map(move |(tmin, tmax)| Ray::within(ray.origin(), ray.direction(), tmin, tmax).ok())
}

/// Every scene by every traversal, alone and nested in another one, over four kinds of trees, and with wide meshes.
fn answers_are_those_of_rational_arithmetic<V: Kind>() {
    let (mut hits, mut several, mut asked, mut deep, mut tracers) = (0, 0, 0, 0, 0);
    for (seed, scene) in scenes::all::<V>().iter().enumerate() {
        let (flat, mut rng) = (InstanceOracle::new(&scene.shapes), Rng::new(seed as u64));
        let mut cases: Vec<_> = rays(&flat, &mut rng, 18).into_iter().map(|ray| (ray, flat.all(&ray))).collect();
        let cut: Vec<_> =
            cases.iter().take(10).filter_map(|(ray, hits)| hits.first().map(|hit| cut(ray, hit))).flatten().collect();
        cases.extend(cut.into_iter().map(|ray| (ray, flat.all(&ray))));
        asked += cases.len();
        hits += cases.iter().filter(|(_, hits)| !hits.is_empty()).count();
        deep += cases.iter().filter_map(|(_, hits)| hits.first()).filter(|hit| hit.path.len() > 1).count();
        several += cases.iter().filter(|(_, hits)| hits.len() > 1).count();
        for (builder, leaf) in [(Builder::Median, 1), (Builder::Standard, 1), (Builder::Spatial, 2), (Builder::Best, 4)]
        {
            let built = hierarchies(scene, builder, leaf);
            let (assembly, root) = assembly(&built, scene);
            for (i, method) in Method::ALL.into_iter().enumerate() {
                let other = Method::ALL[(i + 5) % Method::ALL.len()];
                for (groups, meshes) in [(method, method), (method, other)] {
                    let tracer = match InstanceTracer::with_methods(&assembly, root, groups, meshes) {
                        Ok(tracer) => tracer,
                        // `complete` on other trees, and traversals that need searches of another kind.
                        Err(InstanceError::Unsupported { .. }) => continue,
                        Err(error) => panic!("{error}"),
                    };
                    tracers += 1;
                    for (ray, hit) in &cases {
                        check_answer(&tracer, hit, ray).unwrap_or_else(|fault| {
                            panic!("{}, {builder}, {groups} and {meshes}, {ray:?}: {fault}", scene.name)
                        });
                    }
                }
            }
            let (assembly, root) = self::assembly(&wide(scene, builder, leaf), scene);
            for (method, groups) in wide::Method::ALL.into_iter().zip([Method::Stack, Method::Hashed].repeat(5)) {
                let tracer = InstanceTracer::new(&assembly, root, groups).and_then(|it| it.with_wide(method));
                let tracer = tracer.expect("any tree");
                for (ray, hit) in &cases {
                    check_answer(&tracer, hit, ray).unwrap_or_else(|fault| {
                        panic!("{}, {builder}, {groups} and {method}, {ray:?}: {fault}", scene.name)
                    });
                }
            }
        }
    }
    // All 21 traversals run alone and in pairs, over four kinds of trees. `complete` supports one kind.
    assert!(tracers >= 36 * (42 + 3 * 39), "{tracers}");
    assert!(asked > 1500 && hits > asked / 2 && deep > 50, "{hits} of {asked}, {deep}");
    assert!(several > asked / 10, "{several} of {asked}");
}

#[test]
fn answers_are_those_of_rational_arithmetic_in_single() {
    answers_are_those_of_rational_arithmetic::<Vec3>();
}

#[test]
fn answers_are_those_of_rational_arithmetic_in_double() {
    answers_are_those_of_rational_arithmetic::<DVec3>();
}

/// More rays, with one traversal, and with wide meshes. Crossings are compared with those of a moved ray. `[INST-8]`
fn many_rays_are_answered_by_rational_arithmetic<V: Kind>() {
    let (mut counts, mut asked, mut fewer) = ([0; 4], 0, 0);
    for (seed, scene) in scenes::all::<V>().iter().enumerate() {
        let (flat, mut rng) = (InstanceOracle::new(&scene.shapes), Rng::new(1000 + seed as u64));
        let tracer = |built: Hierarchies<V>| {
            let (assembly, root) = assembly(&built, scene);
            InstanceTracer::new(&assembly, root, Method::Hashed).expect("any tree")
        };
        let (tracer, wide) =
            (tracer(hierarchies(scene, Builder::Standard, 2)), tracer(wide(scene, Builder::Standard, 1)));
        let rays = rays(&flat, &mut rng, 300);
        asked += rays.len();
        for ray in &rays {
            let (hits, crossed) = (flat.all(ray), flat.crossings(ray));
            fewer += usize::from((crossed as usize) < hits.len());
            for tracer in [&tracer, &wide] {
                check_answer(tracer, &hits, ray).unwrap_or_else(|fault| panic!("{}, {ray:?}: {fault}", scene.name));
                assert_eq!(tracer.crossings(ray), crossed, "{}, {ray:?}", scene.name);
            }
        }
        for tracer in [&tracer, &wide] {
            assert_eq!(tracer.closest_parallel(&rays), Ok(rays.iter().map(|ray| tracer.closest(ray)).collect()));
            assert_eq!(tracer.any_parallel(&rays), Ok(tracer.any_each(&rays)));
            assert_eq!(tracer.all_parallel(&rays), Ok(tracer.all_each(&rays)));
            assert_eq!(tracer.crossings_parallel(&rays), Ok(rays.iter().map(|ray| tracer.crossings(ray)).collect()));
        }
        let found = tracer.count_closest(&rays);
        for (sum, count) in counts.iter_mut().zip([found.instances, found.triangles, found.open, found.rational]) {
            *sum += count;
        }
    }
    let [instances, triangles, open, rational] = counts;
    assert!(fewer > asked / 20, "rays that meet edges: {fewer} of {asked}");
    assert!(instances > asked as u64 && open > triangles / 100 && rational > 0, "the scenes are hard: {counts:?}");
}

#[test]
fn many_rays_are_answered_by_rational_arithmetic_in_single() {
    many_rays_are_answered_by_rational_arithmetic::<Vec3>();
}

#[test]
fn many_rays_are_answered_by_rational_arithmetic_in_double() {
    many_rays_are_answered_by_rational_arithmetic::<DVec3>();
}

/// Difficult meshes of a few hundred triangles, in groups of groups. Over wide trees of several levels, the answers
/// equal those of binary ones, also for paths that begin at hits. `[INST-6]` `[SECOND-2]`
#[test]
fn wide_meshes_are_answered_as_binary_ones() {
    let (mut rng, mut hits, mut deepest, mut duplicates) = (Rng::new(3), [0; 2], 0, 0);
    for (i, case) in stress::cases(30).enumerate() {
        let size = case.mesh.vertices().iter().fold(0.0, |size, v| v.abs().max_element().max(size));
        if size > 1e36 {
            // Images may be out of range.
            continue;
        }
        let builder = [Builder::Spatial, Builder::Standard, Builder::Median][i % 3];
        let bvh = Arc::new(options(builder, 1).build(&case.mesh).expect("a tree"));
        let wide = WideOptions { max_leaf: [1, 4, 15, 8][i % 4], ..WideOptions::default() };
        let wide = Arc::new(WideBvh::with_options(&bvh, &wide).expect("a tree"));
        (deepest, duplicates) = (deepest.max(wide.levels()), duplicates + wide.duplicates());
        let maps: Vec<_> = (0..6).map(|_| scenes::about(&mut rng, size.into())).collect();
        let scene = |is_wide: bool| {
            let mut assembly = Assembly::new();
            let mesh = if is_wide { assembly.add_wide(Arc::clone(&wide)) } else { assembly.add_mesh(Arc::clone(&bvh)) };
            let mut group = |object: [Object; 3], maps: &[AffineMap]| {
                let instances = maps.iter().zip(object).map(|(&affine, object)| Instance { object, affine }).collect();
                assembly.add_group(instances, &options(Builder::Standard, 1)).expect("a group")
            };
            let inner = group([mesh; 3], &maps[..3]);
            let outer = group([inner, mesh, inner], &maps[3..]);
            InstanceTracer::new(&assembly, outer, Method::Stack).expect("any tree")
        };
        let (binary, wide) = (scene(false), scene(true).with_wide(wide::Method::ALL[i % 9]).expect("any tree"));
        for ray in &case.rays {
            // The ray in the space of the instances, where difficult cases stay difficult.
            let [origin, target] = [ray.origin(), ray.origin() + ray.direction()].map(|v| image(&maps[4], v));
            let Ok(ray) = Ray::within(origin, target - origin, ray.tmin(), ray.tmax()) else { continue };
            let mut ray = ExactRay::from(&ray);
            for bounce in 0..4 {
                let found = [&binary, &wide].map(|tracer| tracer.closest_and_point(&ray));
                let [expected, given] = found.each_ref().map(|found| found.as_ref().map(|(hit, _)| hit));
                assert_eq!(given, expected, "{}: {ray:?}", case.name);
                assert_eq!(wide.any(&ray), expected.is_some(), "{}: {ray:?}", case.name);
                let [_, Some((_, point))] = found else { break };
                hits[usize::from(bounce > 0)] += 1;
                let ends = [Ends::Open, Ends::Closed][bounce % 2];
                let Ok(next) = point.ray(narrow(vector(&mut rng) * f64::from(size)), f32::INFINITY, ends) else {
                    break;
                };
                ray = next;
            }
        }
    }
    assert!(
        hits.into_iter().all(|hits| hits > 500) && deepest > 2 && duplicates > 100,
        "{hits:?} {deepest} {duplicates}"
    );
}

/// Returns the rounded image.
fn image(map: &AffineMap, v: Vec3) -> Vec3 {
    Vec3::from(map.rows().map(|[x, y, z, w]| x * v.x + y * v.y + z * v.z + w))
}

/// A hit in an instance ends the search in instances behind it, and in their nodes.
#[test]
fn what_is_behind_a_hit_is_not_entered() {
    let bvh = Bvh::sah(&stress::icosphere(3, 1.0, Vec3::ZERO).expect("a mesh"), SahOptions::default()).expect("a tree");
    let wide = WideBvh::of(&bvh).expect("a tree");
    let mut assembly = Assembly::new();
    let [binary, wide] = [assembly.add_mesh(bvh), assembly.add_wide(wide)];
    for object in [binary, wide] {
        what_is_behind_a_hit_in_it_is_not_entered(&mut assembly, object);
    }
}

fn what_is_behind_a_hit_in_it_is_not_entered(assembly: &mut Assembly, object: Object) {
    let options = options(Builder::Standard, 1);
    let place = |i: u8| AffineMap::translation(Vec3::Z * f32::from(i) * 3.0).expect("a map");
    let instances = (0..64).map(|i| Instance { object, affine: place(i) }).collect();
    let row = assembly.add_group(instances, &options).expect("a group");
    let tracer = InstanceTracer::new(assembly, row, Method::Hashed).expect("any tree");
    let ray = Ray::within(Vec3::new(0.1, 0.2, -5.0), Vec3::new(0.001, 0.002, 1.0), 0.0, 1000.0).expect("a ray");
    let (closest, any) = (tracer.count_closest(&[ray]), tracer.count_any(&[ray]));
    // The second one was postponed before the first was entered, and postponed nodes are not tested again.
    assert!(closest.instances <= 2 && closest.rational == 0 && any.instances == 1, "{closest:?}, {any:?}");
    assert!(closest.triangles < 10 && any.triangles < 10, "{closest:?}, {any:?}");
}

/// Returns a triangle, the smallest scene.
fn triangle() -> Bvh {
    let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]]).expect("a mesh");
    Bvh::median(&mesh, 1).expect("a tree")
}

#[test]
fn what_cannot_be_placed_is_refused_by_name() {
    let (bvh, options) = (Arc::new(triangle()), BuildOptions::default());
    let mut assembly = Assembly::new();
    let mesh = assembly.add_mesh(Arc::clone(&bvh));
    let place = |object| Instance { object, affine: AffineMap::IDENTITY };
    let mut other = Assembly::new();
    other.add_mesh(Arc::clone(&bvh));
    let unknown = other.add_group(vec![place(mesh)], &options).expect("a group");
    let refusal = |result: Result<Object, AssemblyError>| result.expect_err("refused").to_string();
    assert_eq!(
        refusal(assembly.add_group(vec![place(mesh), place(unknown)], &options)),
        "instance 1: object 1 is not one of the 1 of this assembly"
    );
    let wide = |x| AffineMap::new([[x, x, 0.0, 0.0], [0.0, x, 0.0, 0.0], [0.0, 0.0, 1.0, f32::MAX]]).expect("a map");
    let far = Instance { object: mesh, affine: wide(f32::MAX) };
    assert_eq!(
        refusal(assembly.add_group(vec![place(mesh), far], &options)),
        "instance 1: the image of its object leaves the range of floats"
    );
    assert!(assembly.add_group(vec![Instance { object: mesh, affine: wide(1e38) }], &options).is_ok());
    assert!(matches!(assembly.add_group(Vec::new(), &options), Err(AssemblyError::Build(_))));
    assert_eq!(
        InstanceTracer::new(&assembly, other.add_mesh(bvh), Method::Stack).err(),
        Some(InstanceError::UnknownObject)
    );
}

#[test]
fn levels_end_where_they_must() {
    let (bvh, options) = (triangle(), BuildOptions::default());
    let mut assembly = Assembly::new();
    let (mut object, mut expected) = (assembly.add_mesh(bvh), Vec::new());
    let half = AffineMap::new([[0.5, 0.0, 0.0, 0.0], [0.0, 0.5, 0.0, 0.0], [0.0, 0.0, 0.5, 1.0]]).expect("a map");
    let ray = Ray::within(Vec3::new(0.0, 0.0, -8.0), Vec3::Z, 0.0, 100.0).expect("a ray");
    let (mut height, mut bytes) = (0.0, Vec::new());
    for levels in 1..=Assembly::MAX_LEVELS {
        assert_eq!(assembly.levels(object), levels);
        for method in Method::ALL {
            let tracer = InstanceTracer::new(&assembly, object, method).expect("trees of one leaf are complete");
            let hit = tracer.closest(&ray).expect("the corner");
            assert_eq!((hit.path, hit.t, hit.u), (expected.clone(), (8.0 + height) as f32, 0.0), "{method}");
        }
        bytes.push(InstanceTracer::new(&assembly, object, Method::Hashed).expect("any tree").state_bytes());
        let group = assembly.add_group(vec![Instance { object, affine: half }], &options);
        if levels == Assembly::MAX_LEVELS {
            let error = AssemblyError::TooManyLevels { instance: 0, levels };
            assert_eq!(group, Err(error));
        } else {
            object = group.expect("a group");
        }
        expected.push(0);
        height = height * 0.5 + 1.0;
    }
    let one = InstanceTracer::RAY_BYTES + Method::Hashed.state_bytes::<u32>(0);
    assert!(bytes.iter().zip(1..).all(|(&bytes, levels)| bytes == levels * one), "as much for each level: {bytes:?}");
}

/// A wide mesh is one level, and has the state of its traversal.
#[test]
fn wide_meshes_have_the_state_of_their_traversal() {
    let bvh = Bvh::build(&stress::icosphere(2, 1.0, Vec3::ZERO).expect("a mesh")).expect("a tree");
    let wide = WideBvh::of(&bvh).expect("a wide tree");
    let (mut assembly, levels) = (Assembly::<Vec3>::new(), wide.levels() as usize);
    let object = assembly.add_wide(wide);
    assert_eq!((assembly.levels(object), levels > 0), (1, true));
    for method in wide::Method::ALL {
        let tracer = InstanceTracer::new(&assembly, object, Method::Stack).and_then(|it| it.with_wide(method));
        let bytes = tracer.expect("any tree").state_bytes();
        assert_eq!(bytes, InstanceTracer::RAY_BYTES + method.state_bytes::<8>(levels), "{method}");
    }
}

/// Exact sums decide cases that bounds leave open if maps keep the ray exact. Double-double arithmetic decides them if
/// maps enclose images exactly or the ray passes next to the corners. Rationals are for a hit edge of an image that is
/// no triangle of doubles.
#[test]
fn rationals_are_for_what_is_met_and_not_known() {
    let turn = [[0.0, -1.0, 0.0, 1.0], [1.0, 0.0, 0.0, -2.0], [0.0, 0.0, 1.0, 0.5]];
    let half = [[0.5, 0.0, 0.0, 0.0], [0.0, 0.5, 0.0, 0.0], [0.0, 0.0, 0.5, 0.0]];
    let third = [[3.0, 0.0, 0.0, 0.0], [0.0, 3.0, 0.0, 0.0], [0.0, 0.0, 3.0, 0.0]];
    // Corners of its images are no floats, but for those on the axis.
    let slant = [[0.8, -0.6, 0.0, 0.0], [0.6, 0.8, 0.0, 0.0], [0.0, 0.0, 1.0, 0.5]];
    let sphere = stress::icosphere(2, 1.0, Vec3::ZERO).expect("a mesh");
    let on_axis = Mesh::new(vec![Vec3::new(0.1, 0.7, 0.3), Vec3::ZERO, Vec3::Z], vec![[0, 1, 2]]).expect("a mesh");
    let corners = sphere.vertices();
    let edge = [Vec3::Z * 0.25];
    let cases: [(_, _, &[Vec3], _); 6] = [
        (turn, &sphere, corners, false),
        (half, &sphere, corners, false),
        (third, &sphere, corners, false),
        (slant, &sphere, corners, false),
        (third, &on_axis, &edge, false),
        (slant, &on_axis, &edge, true),
    ];
    for (rows, mesh, targets, needs_some) in cases {
        let map = AffineMap::new(rows).expect("a map");
        let mut shapes = vec![Shape::Mesh(mesh.clone())];
        shapes.extend((0..4).map(|below| Shape::Group(vec![(below, map)])));
        let scene = Scene { name: format!("{rows:?}"), shapes };
        let flat = InstanceOracle::new(&scene.shapes);
        let (assembly, object) = assembly(&hierarchies(&scene, Builder::Standard, 1), &scene);
        let tracer = InstanceTracer::new(&assembly, object, Method::default()).expect("any tree");
        let mut rays = Vec::new();
        for &target in targets {
            let (origin, image) = (Vec3::new(0.5, -3.25, 5.0), (0..4).fold(target, |target, _| image(&map, target)));
            rays.extend(Ray::new(origin, image - origin));
        }
        for ray in &rays {
            check_instances(&tracer, &flat, ray).unwrap_or_else(|fault| panic!("{rows:?}, {ray:?}: {fault}"));
        }
        let counts = tracer.count_closest(&rays);
        assert_eq!((counts.rational > 0, counts.triangles > 0), (needs_some, true), "{rows:?}: {counts:?}");
    }
}
