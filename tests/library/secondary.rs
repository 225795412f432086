//! Rays that begin exactly at hits of other rays, compared with an independent implementation in rational arithmetic.

use std::array;

use dashu_int::ops::BitTest;
use glam::{DVec3, Vec3};
use stackless_bvh::bvh::{BuildOptions, Bvh, WideBvh};
use stackless_bvh::generate::{Rng, Source, procedural};
use stackless_bvh::geom::{AffineMap, Ends, ExactPoint, ExactRay, Mesh, Precision, Ray, RayError, Real, Vector};
use stackless_bvh::internals::geom::Interval;
use stackless_bvh::internals::geom::truth::{Number, RBig};
use stackless_bvh::trace::{Assembly, Instance, InstanceFilter, InstanceHit, InstanceTracer, RayQueries};
use stackless_bvh::traverse::Method;

use stackless_check::in_single;

use crate::instances::scenes::narrow;

type Rational = [RBig; 3];

/// Rounded distance, path, triangle, rounded weights, and exact distance.
type Hit<'s, R> = (R, &'s [u32], u32, [R; 2], RBig);

/// A scene with its tracers, and its exact triangles.
struct Scene<V: Precision> {
    /// Over a binary tree, over a wide one, and over one of these in single precision if that represents the mesh.
    tracers: Vec<InstanceTracer<V>>,
    /// Path and index of each triangle, with its corners.
    triangles: Vec<(Vec<u32>, u32, [Rational; 3])>,
}

impl<V: Precision> Scene<V> {
    /// Builds a scene from a mesh, nested in these transforms if there are any.
    fn new(mesh: &Mesh<V>, maps: &[AffineMap<V::Real>], method: Method) -> Self {
        let mut assembly = Assembly::new();
        let mut objects = vec![assembly.add_mesh(Bvh::build(mesh).unwrap())];
        objects.push(assembly.add_wide::<V>(WideBvh::build(mesh).unwrap()));
        objects.extend(in_single(mesh).map(|mesh| assembly.add_wide::<Vec3>(WideBvh::build(&mesh).unwrap())));
        let mut tracer = |object| {
            let placed: Vec<_> = maps.iter().map(|&affine| Instance { object, affine }).collect();
            let is_alone = maps.is_empty();
            let root = if is_alone { object } else { assembly.add_group(placed, &BuildOptions::default()).unwrap() };
            InstanceTracer::new(&assembly, root, method).unwrap()
        };
        let tracers = objects.into_iter().map(&mut tracer).collect();
        let corners = |prim: u32| mesh.triangle(prim as usize).map(exact);
        let prims = 0..mesh.triangles().len() as u32;
        let triangles = if maps.is_empty() {
            prims.map(|prim| (vec![], prim, corners(prim))).collect()
        } else {
            let placed = maps.iter().zip(0..).flat_map(|(map, i)| prims.clone().map(move |prim| (map, i, prim)));
            placed.map(|(map, i, prim)| (vec![i], prim, corners(prim).map(|corner| image(map, &corner)))).collect()
        };
        Self { tracers, triangles }
    }

    /// Returns all hits of a line up to a distance, by exact distance, path and triangle. `ends` selects the included
    /// ends.
    fn hits(&self, [o, d]: &[Rational; 2], tmax: V::Real, ends: Ends) -> Vec<Hit<'_, V::Real>> {
        let tmax = RBig::try_from(tmax.into()).ok();
        let is_within = |t: &RBig| match ends {
            Ends::Open => RBig::ZERO < *t && tmax.as_ref().is_none_or(|tmax| t < tmax),
            Ends::Closed => RBig::ZERO <= *t && tmax.as_ref().is_none_or(|tmax| t <= tmax),
        };
        let mut hits = Vec::new();
        for (path, prim, corners) in &self.triangles {
            if let Some([t, u, v]) = cross(corners, o, d).filter(|[t, ..]| is_within(t)) {
                hits.push((Number::nearest(&t), path.as_slice(), *prim, [&u, &v].map(Number::nearest), t));
            }
        }
        hits.sort_by(|a, b| (&a.4, a.1, a.2).cmp(&(&b.4, b.1, b.2)));
        hits
    }
}

fn exact<V: Precision>(v: V) -> Rational {
    v.widen().to_array().map(|x| RBig::try_from(x).unwrap())
}

fn image<R: Real>(map: &AffineMap<R>, v: &Rational) -> Rational {
    let number = |x: R| RBig::try_from(x.into()).unwrap();
    map.rows().map(|[a, b, c, by]| number(a) * &v[0] + number(b) * &v[1] + number(c) * &v[2] + number(by))
}

fn minus(a: &Rational, b: &Rational) -> Rational {
    array::from_fn(|k| &a[k] - &b[k])
}

fn dot(a: &Rational, b: &Rational) -> RBig {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn cross_product(a: &Rational, b: &Rational) -> Rational {
    array::from_fn(|k| &a[(k + 1) % 3] * &b[(k + 2) % 3] - &a[(k + 2) % 3] * &b[(k + 1) % 3])
}

/// Returns distance and weights, from the plane's normal and the areas around the point.
fn cross([a, b, c]: &[Rational; 3], o: &Rational, d: &Rational) -> Option<[RBig; 3]> {
    let normal = cross_product(&minus(b, a), &minus(c, a));
    let speed = dot(&normal, d);
    if speed == RBig::ZERO {
        return None;
    }
    let t = dot(&normal, &minus(a, o)) / speed;
    let p = along(o, d, &t);
    let area = dot(&normal, &normal);
    let weight = |x: &Rational, y: &Rational| dot(&normal, &cross_product(&minus(y, x), &minus(&p, x))) / &area;
    let [u, v, w] = [weight(c, a), weight(a, b), weight(b, c)];
    let is_inside = [&u, &v, &w].into_iter().all(|weight| *weight >= RBig::ZERO);
    is_inside.then_some([t, u, v])
}

fn along(o: &Rational, d: &Rational, t: &RBig) -> Rational {
    array::from_fn(|k| &o[k] + t * &d[k])
}

/// Returns a box of `n` by `n` squares per side, of two triangles each, with an inner box. Rays hit corners, edges and
/// planes.
fn boxes<V: Precision>(n: i32, scale: f64) -> Mesh<V> {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for size in [f64::from(n), f64::from(n) * 0.5] {
        for axis in 0..3 {
            for side in [-1.0, 1.0] {
                for i in 0..n * n {
                    let corner = |x: i32, y: i32| {
                        let at = |x: i32| (2.0 * f64::from(x) / f64::from(n) - 1.0) * size;
                        let mut corner = [0.0; 3];
                        (corner[axis], corner[(axis + 1) % 3], corner[(axis + 2) % 3]) = (side * size, at(x), at(y));
                        narrow::<V>(DVec3::from(corner) * scale)
                    };
                    let (first, x, y) = (vertices.len() as u32, i % n, i / n);
                    vertices.extend([corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)]);
                    triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
                }
            }
        }
    }
    Mesh::new(vertices, triangles).unwrap()
}

/// Returns coincident triangles, and triangles that touch other triangles with an edge, a corner, or their interior.
fn sheets<V: Precision>(rng: &mut Rng) -> Mesh<V> {
    let mut vertices = Vec::new();
    for _ in 0..8 {
        let mut point = || DVec3::from(array::from_fn(|_| rng.below(5) as f64 - 2.0));
        let [a, b, c, d] = [point(), point(), point(), point()];
        vertices.extend([a, b, c, c, a, b, a, b, d, a, (b + c) * 0.5, d, a * 0.5 + b * 0.25 + c * 0.25, d, b]);
    }
    let triangles = (0..vertices.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Mesh::new(vertices.into_iter().map(narrow).collect(), triangles).unwrap()
}

fn scenes<V: Precision>(tiny: f64, huge: f64) -> Vec<Scene<V>> {
    let mut rng = Rng::new(7);
    let map = |rows: [[f64; 4]; 3]| AffineMap::new(rows.map(|row| row.map(V::Real::rounded))).unwrap();
    let soup = procedural::soup(3, 60);
    let soup = Mesh::new(soup.vertices().iter().map(|v| narrow(v.widen() * 1.1)).collect(), soup.triangles().to_vec());
    let maps = [
        map([[0.1, 0.7, 0.0, 3.0], [0.3, 0.1, 0.2, 0.1], [0.0, 0.3, 1.1, -1.0]]),
        map([[1.0, 0.0, 0.0, 1.5], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]),
        AffineMap::IDENTITY,
    ];
    vec![
        Scene::new(&soup.unwrap(), &[], Method::default()),
        Scene::new(&boxes(3, 1.0), &[], Method::Hashed),
        Scene::new(&boxes(2, 0.1), &[], Method::Stack),
        Scene::new(&boxes(2, tiny), &[], Method::Uncle),
        Scene::new(&boxes(2, huge), &[], Method::default()),
        Scene::new(&sheets(&mut rng), &[], Method::default()),
        Scene::new(&sheets(&mut rng), &[], Method::Sparse),
        Scene::new(&boxes(1, 1.0), &maps, Method::default()),
    ]
}

/// Hits, points and bounds. `[SECOND-1]` `[SECOND-2]` `[SECOND-3]`
fn paths_are_those_of_rational_arithmetic<V: Precision>(scenes: &[Scene<V>]) {
    let mut rng = Rng::new(1);
    let (mut hits, mut at_own_plane, mut longest) = (0, 0, 0);
    for scene in scenes {
        let corners: Vec<V> = scene.triangles.iter().flat_map(|(_, _, corners)| corners).map(rounded).collect();
        let size = corners.iter().fold(0.0, |size: f64, corner| size.max(corner.widen().abs().max_element()));
        for _ in 0..30 {
            let mut origin = ExactPoint::<V>::new(narrow(direction(&mut rng) * (1.5 * size))).unwrap();
            let mut place: Rational = origin.rational().into_owned();
            for length in 0..12 {
                let ends = if rng.below(2) == 0 { Ends::Open } else { Ends::Closed };
                let a = corners[rng.below(corners.len() as u64) as usize];
                let near: V = rounded(&place);
                let (ray, line, tmax) = match rng.below(5) {
                    // To a corner, exactly.
                    0 => {
                        let target = ExactPoint::new(a).unwrap();
                        match origin.toward(&target, ends) {
                            Ok(ray) => (ray, [place.clone(), minus(&exact(a), &place)], V::Real::ONE),
                            Err(error) => {
                                assert!(error == RayError::ZeroDirection && exact(a) == place);
                                continue;
                            }
                        }
                    }
                    way => {
                        let b = corners[rng.below(corners.len() as u64) as usize];
                        let direction: V = match way {
                            1 => a - b,
                            2 => a - near,
                            3 => narrow(DVec3::AXES[rng.below(3) as usize] * size),
                            _ => narrow(direction(&mut rng) * size),
                        };
                        let tmax = if rng.below(4) == 0 { V::Real::ONE } else { V::Real::INFINITY };
                        let Ok(ray) = origin.ray(direction, tmax, ends) else { continue };
                        (ray, [place.clone(), exact(direction)], tmax)
                    }
                };
                let enclosed = ray.enclosed();
                assert!(holds(&enclosed.origin, &line[0]) && holds(&enclosed.direction, &line[1]), "{ray:?}");
                let expected = scene.hits(&line, tmax, ends);
                at_own_plane += usize::from(expected.iter().any(|(.., t)| *t == RBig::ZERO));
                // Any of the tracers continues the path.
                let tracer = &scene.tracers[rng.below(scene.tracers.len() as u64) as usize];
                let found = tracer.closest_and_point(&ray);
                for tracer in &scene.tracers {
                    assert_eq!(tracer.any(&ray), !expected.is_empty(), "{ray:?}");
                    assert_eq!(tracer.closest(&ray).as_ref(), found.as_ref().map(|(hit, _)| hit), "{ray:?}");
                }
                check_filtered(&scene.tracers, &ray, &expected);
                let Some((t, path, prim, weights, exact_t)) = expected.first() else {
                    assert!(found.is_none(), "{ray:?} {found:?}");
                    continue;
                };
                let Some((hit, point)) = found else { panic!("{ray:?}, expected {:?}", expected[0]) };
                assert_eq!(
                    (hit.t, hit.path.as_slice(), hit.prim, [hit.u, hit.v]),
                    (*t, *path, *prim, *weights),
                    "{ray:?}"
                );
                hits += 1;
                // The path continues from there.
                place = along(&line[0], &line[1], exact_t);
                assert!(holds(&point.bounds(), &place), "{point:?}");
                // Most points are known only by bounds.
                if rng.below(4) == 0 {
                    assert_eq!(point.rational().as_ref(), &place);
                }
                origin = point;
                longest = longest.max(length);
            }
        }
    }
    assert!(hits > 1000 && at_own_plane > 200 && longest == 11, "{hits} {at_own_plane} {longest}");
    assert!(scenes.iter().filter(|scene| scene.tracers.len() == 3).count() > 2);
}

/// The closest accepted hit is the first accepted one of all hits, also of rays that leave a triangle. `[FILTER-1]`
fn check_filtered<V: Precision>(tracers: &[InstanceTracer<V>], ray: &ExactRay<V>, expected: &[Hit<'_, V::Real>]) {
    let by_triangle = |path: &[u32], prim: u32| !(path.iter().sum::<u32>() + prim).is_multiple_of(3);
    let by_hit = |hit: &InstanceHit<V::Real>| hit.u <= hit.v || hit.prim.is_multiple_of(4);
    let accepted = expected.iter().map(|(t, path, prim, [u, v], _)| InstanceHit {
        path: path.to_vec(),
        prim: *prim,
        t: *t,
        u: *u,
        v: *v,
    });
    let accepted: Vec<_> = accepted.filter(|hit| by_triangle(&hit.path, hit.prim) && by_hit(hit)).collect();
    for tracer in tracers {
        let filtered = tracer.filtered(InstanceFilter::ALL.triangles(&by_triangle).hits(&by_hit));
        assert_eq!(filtered.closest_and_point(ray).map(|(hit, _)| hit).as_ref(), accepted.first(), "{ray:?}");
        assert_eq!((filtered.all(ray), filtered.any(ray)), (accepted.clone(), !accepted.is_empty()), "{ray:?}");
    }
}

#[test]
fn paths_are_those_of_rational_arithmetic_in_single() {
    paths_are_those_of_rational_arithmetic::<Vec3>(&scenes(3e-20, 7e20));
}

#[test]
fn paths_are_those_of_rational_arithmetic_in_double() {
    paths_are_those_of_rational_arithmetic::<DVec3>(&scenes(3e-50, 7e50));
}

fn rounded<V: Precision>(v: &Rational) -> V {
    V::from_components(v.each_ref().map(Number::nearest))
}

fn holds(bounds: &[Interval; 3], v: &Rational) -> bool {
    bounds.iter().zip(v).all(|(bounds, x)| {
        let [lo, hi] = bounds.ends().map(|end| RBig::try_from(end).unwrap());
        lo <= *x && *x <= hi
    })
}

/// In a closed box no path ends, and from its inside nothing outside is visible.
fn nothing_leaks<V: Precision>(mesh: &Mesh<V>, most: u32) {
    let scene = Scene::new(mesh, &[], Method::default());
    let (mut rng, mut bounces) = (Rng::new(5), 0);
    let outside = ExactPoint::new(narrow(DVec3::new(5.0, 1.0, -0.25))).unwrap();
    let mut ray = start();
    let normal = |prim: usize| DVec3::AXES[prim / 64 % 3] * [1.0, -1.0][prim / 32 % 2];
    while bounces < most {
        let Some((hit, point)) = scene.tracers[0].closest_and_point(&ray) else { panic!("{bounces}: {ray:?}") };
        // The inner box is not reachable from between the boxes, so its walls reflect outwards.
        let inwards = normal(hit.prim as usize % 192) * if hit.prim >= 192 { -1.0 } else { 1.0 };
        assert!(scene.tracers[0].any(&point.toward(&outside, Ends::Open).unwrap()) || hit.prim < 192);
        // To corners of squares, along the diagonals, or anywhere.
        let way = DVec3::from(array::from_fn(|_| match bounces % 3 {
            0 => rng.below(3) as f64 - 1.0,
            _ => unit(&mut rng),
        }));
        let direction = way - inwards * (way.dot(inwards) - 1.0);
        ray = point.ray(narrow(direction), V::Real::INFINITY, Ends::Open).unwrap();
        bounces += 1;
    }
}

#[test]
fn nothing_leaks_in_single() {
    nothing_leaks::<Vec3>(&boxes(4, 0.3), 3000);
}

#[test]
fn nothing_leaks_in_double() {
    // Their distances come from rational points, which grow.
    nothing_leaks::<DVec3>(&boxes(4, 0.3), 300);
}

/// Returns a ray from between the boxes.
fn start<V: Precision>() -> ExactRay<V> {
    ExactRay::from(&Ray::new(narrow(DVec3::splat(1.0)), narrow(DVec3::new(0.2, 0.5, 0.9))).unwrap())
}

/// Draws a number from -1 to 1, of 24 bits.
fn unit(rng: &mut Rng) -> f64 {
    rng.below(1 << 24) as f64 / f64::from(1 << 23) - 1.0
}

fn direction(rng: &mut Rng) -> DVec3 {
    DVec3::from(array::from_fn(|_| unit(rng)))
}

/// The bits of a path's points grow by a constant number at each hit, and computing a point late gives an equal result.
/// `[SECOND-4]`
#[test]
fn points_grow_with_the_length_of_their_path() {
    let scene = Scene::<Vec3>::new(&boxes(4, 0.3), &[], Method::default());
    let bits = |point: &ExactPoint| {
        let point = point.rational();
        point.iter().map(|x| x.denominator().bit_len()).max().unwrap()
    };
    let start = start();
    let (mut early, mut late, mut sizes) = (start.clone(), start, Vec::new());
    let mut rng = Rng::new(9);
    for _ in 0..160 {
        let direction = direction(&mut rng).as_vec3();
        let next = |ray: &ExactRay, is_early: bool| {
            let (_, point) = scene.tracers[0].closest_and_point(ray).unwrap_or_else(|| panic!("{ray:?}"));
            let size = if is_early { bits(&point) } else { 0 };
            let ahead = point.ray(direction, f32::INFINITY, Ends::Open).unwrap();
            // On either side of the wall. Outside there is nothing to hit.
            let ray = if scene.tracers[0].any(&ahead) {
                ahead
            } else {
                point.ray(-direction, f32::INFINITY, Ends::Open).unwrap()
            };
            (ray, point, size)
        };
        let (ray, point, size) = next(&early, true);
        sizes.push(size);
        early = ray;
        let (ray, other, _) = next(&late, false);
        late = ray;
        // It depends on earlier points, until one is computed.
        assert!((1..=8).contains(&format!("{late:?}").matches("Met {").count()), "{late:?}");
        if sizes.len() % 40 == 0 {
            assert_eq!(point.rational(), other.rational());
        }
    }
    let [first, second] = [sizes[79] - sizes[39], sizes[159] - sizes[119]];
    assert!(first > 40 && second < first * 3 / 2, "{sizes:?}");
}
