//! The oracle of instances: transforms every triangle of every instance and tests all of them in rational arithmetic.

use std::cmp::Ordering;
use std::sync::Arc;

use dashu_int::ops::BitTest as _;
use dashu_int::{IBig, UBig};
use glam::Vec3;

use stackless_bvh::bvh::wide::WideOptions;
use stackless_bvh::bvh::{BuildOptions, Bvh, WideBvh, WideError};
use stackless_bvh::geom::{AffineMap, Ball, Mesh, Precision, Ray, Real, Triangle, Vector};
use stackless_bvh::internals::geom::truth::{Number, RBig, Relaxed, round_root};
use stackless_bvh::trace::{
    Assembly, AssemblyError, Instance, InstanceHit, InstanceNear, InstanceTracer, Object, RayQueries,
};

use crate::foot::{Foot, IntegerPoint};

/// A placed shape, in the form that the oracle uses.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape<V: Vector = Vec3> {
    /// Triangles.
    Mesh(Mesh<V>),
    /// Indices of earlier shapes, and their transforms.
    Group(Vec<(usize, AffineMap<V::Real>)>),
}

/// Hierarchies of shapes, for building assemblies.
#[derive(Debug)]
pub struct Hierarchies<V: Precision = Vec3> {
    /// By shape; `None` for groups.
    bvhs: Vec<Option<Held<V>>>,
    options: BuildOptions,
}

#[derive(Debug)]
enum Held<V: Precision> {
    Binary(Arc<Bvh<Triangle<V>>>),
    Wide(Arc<WideBvh<8, V>>),
    Single(Arc<WideBvh>),
}

impl<V: Precision> Hierarchies<V> {
    /// Builds the hierarchies of the meshes with the same options. With `wide` they are wide, and every second one is
    /// in single precision if it can represent the mesh.
    ///
    /// # Errors
    /// The errors of [`WideError`].
    pub fn new(shapes: &[Shape<V>], options: BuildOptions, wide: Option<&WideOptions>) -> Result<Self, WideError> {
        let build = |(i, shape): (usize, &Shape<V>)| -> Result<_, WideError> {
            let Shape::Mesh(mesh) = shape else { return Ok(None) };
            let single = if i % 2 == 1 { in_single(mesh) } else { None };
            Ok(Some(match (wide, single) {
                (Some(wide), Some(mesh)) => Held::Single(WideBvh::with_options(&options.build(&mesh)?, wide)?.into()),
                (Some(wide), None) => Held::Wide(WideBvh::with_options(&options.build(mesh)?, wide)?.into()),
                (None, _) => Held::Binary(options.build(mesh)?.into()),
            }))
        };
        Ok(Self { bvhs: shapes.iter().enumerate().map(build).collect::<Result<_, _>>()?, options })
    }

    /// Assembles these shapes, which must be those of [`new`](Self::new). Returns the assembly and its objects.
    ///
    /// # Errors
    /// The errors of [`AssemblyError`]. A group omits shapes that do not come before it.
    pub fn assembly(&self, shapes: &[Shape<V>]) -> Result<(Assembly<V>, Vec<Object>), AssemblyError> {
        let (mut assembly, mut objects) = (Assembly::new(), Vec::<Object>::new());
        for (shape, bvh) in shapes.iter().zip(&self.bvhs) {
            match (shape, bvh) {
                (Shape::Mesh(_), Some(Held::Binary(bvh))) => objects.push(assembly.add_mesh(Arc::clone(bvh))),
                (Shape::Mesh(_), Some(Held::Wide(bvh))) => objects.push(assembly.add_wide::<V>(Arc::clone(bvh))),
                (Shape::Mesh(_), Some(Held::Single(bvh))) => objects.push(assembly.add_wide::<Vec3>(Arc::clone(bvh))),
                (Shape::Group(instances), _) => {
                    let place = |&(shape, affine): &(usize, AffineMap<V::Real>)| {
                        objects.get(shape).map(|&object| Instance { object, affine })
                    };
                    let group = instances.iter().filter_map(place).collect();
                    objects.push(assembly.add_group(group, &self.options)?);
                }
                (Shape::Mesh(_), None) => {}
            }
        }
        Ok((assembly, objects))
    }
}

/// Converts the mesh to single precision, if that is exact.
pub fn in_single<V: Vector>(mesh: &Mesh<V>) -> Option<Mesh> {
    let single = |v: &V| Some(v.widen().as_vec3()).filter(|single| single.as_dvec3() == v.widen());
    Mesh::new(mesh.vertices().iter().map(single).collect::<Option<_>>()?, mesh.triangles().to_vec()).ok()
}

/// A ray whose answer differs from that of the oracle.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{found:?}, expected {expected:?}")]
pub struct InstanceFault<R: Real = f32> {
    /// All hits of the ray, in order.
    pub expected: Vec<InstanceHit<R>>,
    /// The hits of the query that differs, or its yes or no.
    pub found: Result<Vec<InstanceHit<R>>, bool>,
}

/// Compares all queries of a ray with the oracle, in every bit. `[INST-6]`
///
/// Returns whether the ray hits.
///
/// # Errors
/// The first wrong answer.
pub fn check_instances<V: Vector>(
    tracer: &InstanceTracer<V>,
    flat: &InstanceOracle<V>,
    ray: &Ray<V>,
) -> Result<bool, InstanceFault<V::Real>> {
    check_answer(tracer, &flat.all(ray), ray)
}

/// Compares all queries of a ray with its expected hits, which must be sorted. The tracer may be filtered.
///
/// # Errors
/// The first wrong answer.
pub fn check_answer<V: Vector>(
    tracer: &impl RayQueries<Ray<V>, Hit = InstanceHit<V::Real>>,
    expected: &[InstanceHit<V::Real>],
    ray: &Ray<V>,
) -> Result<bool, InstanceFault<V::Real>> {
    let bits = |hit: &InstanceHit<V::Real>| {
        let bits = |x: V::Real| -> u64 { f64::to_bits(x.into()) };
        (hit.path.clone(), hit.prim, [hit.t, hit.u, hit.v].map(bits))
    };
    let equal = |a: &[_], b: &[_]| a.iter().map(bits).eq(b.iter().map(bits));
    let fault = |found| Err(InstanceFault { expected: expected.to_vec(), found });
    let (closest, all, any_hit) = (tracer.closest(ray), tracer.all(ray), tracer.any_hit(ray));
    if !equal(closest.as_slice(), &expected[..expected.len().min(1)]) {
        return fault(Ok(closest.into_iter().collect()));
    }
    if !equal(&all, expected) {
        return fault(Ok(all));
    }
    let is_one = any_hit.as_ref().is_none_or(|hit| expected.iter().any(|other| bits(hit) == bits(other)));
    if !is_one || any_hit.is_none() != expected.is_empty() {
        return fault(Ok(any_hit.into_iter().collect()));
    }
    let any = tracer.any(ray);
    if any == expected.is_empty() { fault(Err(any)) } else { Ok(any) }
}

/// All triangles of the last shape, transformed to their places. `[INST-1]`
#[derive(Debug)]
pub struct InstanceOracle<V: Vector = Vec3> {
    triangles: Vec<Placed<V>>,
    /// Coordinates are integers divided by 2 to this power.
    log: usize,
}

#[derive(Debug)]
struct Placed<V> {
    path: Vec<u32>,
    prim: u32,
    exact: [IntegerPoint; 3],
    /// The rounded corners.
    corners: [V; 3],
}

impl<V: Vector> InstanceOracle<V> {
    /// Transforms all triangles. Groups must place shapes that come before them.
    pub fn new(shapes: &[Shape<V>]) -> Self {
        let mut found = Vec::new();
        collect(shapes, shapes.len().saturating_sub(1), &mut Vec::new(), &mut Vec::new(), &mut found);
        let log = log_of(found.iter().flat_map(|(_, _, corners)| corners.iter().flatten()));
        let triangles = found.into_iter().map(|(path, prim, corners)| {
            let exact = corners.clone().map(|corner| corner.map(|x| scaled(&x, log)));
            let corners = corners.map(|corner| V::from_components(corner.map(|x| V::Real::nearest(&x))));
            Placed { path, prim, exact, corners }
        });
        Self { triangles: triangles.collect(), log }
    }

    /// Returns the corners of all triangles, rounded to floats.
    pub fn corners(&self) -> impl Iterator<Item = &[V; 3]> {
        self.triangles.iter().map(|triangle| &triangle.corners)
    }

    /// Returns all hits, ordered by exact distance, path and triangle.
    pub fn all(&self, ray: &Ray<V>) -> Vec<InstanceHit<V::Real>> {
        let mut hits: Vec<_> =
            self.met(ray).map(|([t, u, v], placed, _)| (t, &placed.path, placed.prim, [u, v])).collect();
        hits.sort();
        let rounded = |(t, path, prim, [u, v]): (RBig, &Vec<u32>, u32, [RBig; 2])| {
            let [t, u, v] = [&t, &u, &v].map(V::Real::nearest);
            InstanceHit { path: path.clone(), prim, t, u, v }
        };
        hits.into_iter().map(rounded).collect()
    }

    /// Counts the hits that remain if the origin is moved by (ε, ε², ε³), for an ε that is small enough. `[INST-8]`
    pub fn crossings(&self, ray: &Ray<V>) -> u32 {
        let is_crossing = |([_, u, v], _, line): &Met<'_, V>| {
            let Line { corners, o, d } = line;
            // The edge function is an integer, and so are the factors of ε, ε² and ε³ in its change. With this many bits of
            // ε, the first of them that is not 0 outweighs the following ones.
            let bits = 2 * line.bits() + 8;
            let finer = |point: &IntegerPoint| point.each_ref().map(|x| x << (3 * bits));
            let [x, y, z] = finer(o);
            let moved = [x + (IBig::ONE << (2 * bits)), y + (IBig::ONE << bits), z + IBig::ONE];
            // Inside, there is room to move.
            let is_inside = *u > RBig::ZERO && *v > RBig::ZERO && u + v < RBig::ONE;
            is_inside || tops(&corners.each_ref().map(finer), &moved, d).is_some()
        };
        self.met(ray).filter(is_crossing).count() as u32
    }

    /// Returns the nearest point of all triangles. `[INST-9]`
    pub fn nearest(&self, ball: &Ball<V>) -> Option<InstanceNear<V>> {
        let center = ball.center().components().map(exact);
        let log = self.log.max(log_of(center.iter()));
        let (center, scale) = (center.map(|x| scaled(&x, log)), Relaxed::from(IBig::ONE << log));
        let measured: Vec<_> = self
            .triangles
            .iter()
            .map(|placed| {
                let corners = placed.exact.each_ref().map(|corner| corner.each_ref().map(|x| x << (log - self.log)));
                let foot = Foot::of(&corners, &center);
                (&foot.square / (&scale * &scale), foot, corners, placed)
            })
            .collect();
        let least = measured.iter().map(|(square, ..)| square).min()?;
        let distance: V::Real = round_root(&least.clone().canonicalize());
        // All squares up to that of the middle between two floats have this root, and that of the middle perhaps.
        let [below, above] = [distance, distance.next_up()].map(|x| Relaxed::try_from(x.into()).ok());
        let middle = below.zip(above).map(|(below, above)| (below + above) / Relaxed::from(2));
        let has_root = |square: &Relaxed| {
            let by_middle = middle.as_ref().map(|middle| square.cmp(&(middle * middle)));
            by_middle
                .filter(|order| order.is_ne())
                .map_or_else(|| round_root::<V::Real>(&square.clone().canonicalize()) == distance, Ordering::is_lt)
        };
        let radius: f64 = ball.radius().into();
        let most = Relaxed::try_from(radius).ok().map(|radius| &radius * &radius);
        let is_in = |square: &Relaxed| most.as_ref().is_none_or(|most| square <= most);
        let nearest = measured.iter().filter(|(square, ..)| has_root(square) && is_in(square));
        let (_, foot, corners, placed) = nearest.min_by_key(|(.., placed)| (&placed.path, placed.prim))?;
        let coordinate = |k: usize| {
            let [a, b, c] = corners;
            let [v, w] = &foot.weights;
            let x = &a[k] * &foot.whole + v * (&b[k] - &a[k]) + w * (&c[k] - &a[k]);
            let x = Relaxed::from_parts_signed(x, foot.whole.clone()) / &scale;
            V::Real::rounded(V::Real::nearest_to(&x).into() + 0.0)
        };
        let point = V::from_components([0, 1, 2].map(coordinate));
        Some(InstanceNear { path: placed.path.clone(), prim: placed.prim, distance, point })
    }

    /// Returns distance and weights of each hit, with its triangle, in any order.
    fn met(&self, ray: &Ray<V>) -> impl Iterator<Item = Met<'_, V>> {
        let line = [ray.origin(), ray.direction()].map(|v| v.components().map(exact));
        let log = self.log.max(log_of(line.as_flattened().iter()));
        let [o, d] = line.map(|v| v.map(|x| scaled(&x, log)));
        let ([tmin, tmax], finer) = ([ray.tmin(), ray.tmax()], log - self.log);
        self.triangles.iter().filter_map(move |placed| {
            let corners = placed.exact.each_ref().map(|corner| corner.each_ref().map(|x| x << finer));
            let found = meet(&corners, &o, &d)?;
            let ends_before = tmax != V::Real::INFINITY && found[0] > exact(tmax);
            let is_within = !ends_before && found[0] >= exact(tmin);
            is_within.then(|| (found, placed, Line { corners, o: o.clone(), d: d.clone() }))
        })
    }
}

/// Distance and weights of a hit, the triangle, and the integers of the triangle and of the line.
type Met<'a, V> = ([RBig; 3], &'a Placed<V>, Line);

struct Line {
    corners: [IntegerPoint; 3],
    o: IntegerPoint,
    d: IntegerPoint,
}

impl Line {
    /// Number of bits of the greatest integer.
    fn bits(&self) -> usize {
        let all = self.corners.iter().chain([&self.o, &self.d]).flatten();
        all.map(IBig::bit_len).max().unwrap_or(0)
    }
}

type Moved = (Vec<u32>, u32, [[RBig; 3]; 3]);

fn collect<V: Vector>(
    shapes: &[Shape<V>],
    shape: usize,
    path: &mut Vec<u32>,
    maps: &mut Vec<AffineMap<V::Real>>,
    found: &mut Vec<Moved>,
) {
    match shapes.get(shape) {
        None => {}
        Some(Shape::Mesh(mesh)) => {
            for prim in 0..mesh.triangles().len() {
                let corners = mesh.triangle(prim).map(|corner| {
                    maps.iter().rev().fold(corner.components().map(exact), |v, map| {
                        map.rows().map(|[x, y, z, b]| exact(x) * &v[0] + exact(y) * &v[1] + exact(z) * &v[2] + exact(b))
                    })
                });
                found.push((path.clone(), prim as u32, corners));
            }
        }
        Some(Shape::Group(instances)) => {
            for (index, (inner, map)) in instances.iter().enumerate() {
                path.push(index as u32);
                maps.push(*map);
                collect(shapes, *inner, path, maps, found);
                maps.pop();
                path.pop();
            }
        }
    }
}

/// Returns the distance and the weights where a line hits a triangle, by Cramer's rule for o + t d = a + u (b - a) + v
/// (c - a).
pub(crate) fn meet(corners: &[IntegerPoint; 3], o: &IntegerPoint, d: &IntegerPoint) -> Option<[RBig; 3]> {
    let [t, u, v, whole] = tops(corners, o, d)?;
    Some([t, u, v].map(|top| RBig::from_parts_signed(top, whole.clone())))
}

/// Returns the numerators of [`meet`], and their positive denominator.
fn tops([a, b, c]: &[IntegerPoint; 3], o: &IntegerPoint, d: &IntegerPoint) -> Option<[IBig; 4]> {
    let minus = |x: &IntegerPoint, y: &IntegerPoint| -> IntegerPoint { std::array::from_fn(|k| &x[k] - &y[k]) };
    let (e, f, s) = (minus(b, a), minus(c, a), minus(o, a));
    let back: IntegerPoint = d.clone().map(|x| -x);
    let whole = determinant(&e, &f, &back);
    if whole.is_zero() {
        return None;
    }
    let sign = IBig::from(if whole < IBig::ZERO { -1 } else { 1 });
    let [u, v] = [determinant(&s, &f, &back), determinant(&e, &s, &back)].map(|top| top * &sign);
    let whole = whole * &sign;
    if u < IBig::ZERO || v < IBig::ZERO || &u + &v > whole {
        return None;
    }
    Some([determinant(&e, &f, &s) * sign, u, v, whole])
}

/// Returns the determinant of the matrix with these columns.
fn determinant(a: &IntegerPoint, b: &IntegerPoint, c: &IntegerPoint) -> IBig {
    let minor = |i: usize, j: usize| &b[i] * &c[j] - &b[j] * &c[i];
    &a[0] * minor(1, 2) + &a[1] * minor(2, 0) + &a[2] * minor(0, 1)
}

fn exact<R: Real>(x: R) -> RBig {
    // All numbers here are finite.
    RBig::try_from(x.into()).unwrap_or(RBig::ZERO)
}

/// Returns the exponent of the least power of two that all denominators divide.
fn log_of<'x>(numbers: impl Iterator<Item = &'x RBig>) -> usize {
    numbers.map(|x| x.denominator().trailing_zeros().unwrap_or(0)).max().unwrap_or(0)
}

/// Scales a number whose denominator is a power of two by 2 to the power of `log`.
fn scaled(x: &RBig, log: usize) -> IBig {
    let whole = x * RBig::from(UBig::ONE << log);
    debug_assert!(whole.is_int(), "{x} has more than {log} digits");
    whole.numerator().clone()
}
