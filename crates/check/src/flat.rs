//! The oracle of instances: every triangle of every instance moved to where it is, and each of them asked, in rational
//! arithmetic.

use std::sync::Arc;

use dashu_int::{IBig, UBig};
use glam::Vec3;

use stackless_bvh::bvh::{BuildError, BuildOptions, Bvh};
use stackless_bvh::geom::truth::{RBig, round_f32};
use stackless_bvh::geom::{AffineMap, Mesh, Ray};
use stackless_bvh::trace::{Assembly, AssemblyError, Instance, InstanceHit, InstanceTracer, Object};

type Vector = [IBig; 3];

/// What is placed, as the oracle knows it.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Triangles.
    Mesh(Mesh),
    /// Indices of earlier shapes, and their places.
    Group(Vec<(usize, AffineMap)>),
}

/// The hierarchies of shapes, from which an assembly of them is made.
#[derive(Debug)]
pub struct Hierarchies {
    /// By shape; `None` for groups.
    bvhs: Vec<Option<Arc<Bvh>>>,
    options: BuildOptions,
}

impl Hierarchies {
    /// Builds those of the meshes, all in one way.
    ///
    /// # Errors
    /// What [`BuildError`] lists.
    pub fn new(shapes: &[Shape], options: BuildOptions) -> Result<Self, BuildError> {
        let build = |shape: &Shape| match shape {
            Shape::Mesh(mesh) => options.build(mesh).map(|bvh| Some(Arc::new(bvh))),
            Shape::Group(_) => Ok(None),
        };
        Ok(Self { bvhs: shapes.iter().map(build).collect::<Result<_, _>>()?, options })
    }

    /// The assembly of these shapes, which must be the same, and the objects that they have become.
    ///
    /// # Errors
    /// What [`AssemblyError`] lists. A group of shapes that do not come before it leaves those out.
    pub fn assembly(&self, shapes: &[Shape]) -> Result<(Assembly, Vec<Object>), AssemblyError> {
        let (mut assembly, mut objects) = (Assembly::new(), Vec::<Object>::new());
        for (shape, bvh) in shapes.iter().zip(&self.bvhs) {
            match (shape, bvh) {
                (Shape::Mesh(_), Some(bvh)) => objects.push(assembly.add_mesh(Arc::clone(bvh))),
                (Shape::Group(instances), _) => {
                    let place = |&(shape, affine): &(usize, AffineMap)| {
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

/// A ray through instances that is answered otherwise than by the oracle.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{found:?}, expected {expected:?}")]
pub struct InstanceFault {
    /// The hit that is right.
    pub expected: Option<InstanceHit>,
    /// The hit that was found, or that any hit is found where there is none or the other way round.
    pub found: Result<Option<InstanceHit>, bool>,
}

/// Asks for the closest hit, which must be that of the oracle in every bit, and for any hit. `[INST-6]`
///
/// Returns whether there is one.
///
/// # Errors
/// The first answer that is wrong.
pub fn check_instances(tracer: &InstanceTracer, flat: &Flat, ray: &Ray) -> Result<bool, InstanceFault> {
    check_answer(tracer, &flat.closest(ray), ray)
}

/// The same where the right answer is known.
///
/// # Errors
/// The first answer that is wrong.
pub fn check_answer(tracer: &InstanceTracer, expected: &Option<InstanceHit>, ray: &Ray) -> Result<bool, InstanceFault> {
    let bits = |hit: &Option<InstanceHit>| {
        hit.as_ref().map(|hit| (hit.path.clone(), hit.prim, [hit.t, hit.u, hit.v].map(f32::to_bits)))
    };
    let (found, any) = (tracer.closest(ray), tracer.any(ray));
    let fault = |found| Err(InstanceFault { expected: expected.clone(), found });
    if bits(&found) != bits(expected) {
        return fault(Ok(found));
    }
    if any == expected.is_some() { Ok(any) } else { fault(Err(any)) }
}

/// All triangles of the last shape, moved to where they are. `[INST-1]`
#[derive(Debug)]
pub struct Flat {
    triangles: Vec<Placed>,
    /// Coordinates are integers over 2 to this power.
    log: usize,
}

#[derive(Debug)]
struct Placed {
    path: Vec<u32>,
    prim: u32,
    exact: [Vector; 3],
    /// Rounded.
    corners: [Vec3; 3],
}

impl Flat {
    /// Moves them. Groups must place shapes that come before them.
    pub fn new(shapes: &[Shape]) -> Self {
        let mut found = Vec::new();
        collect(shapes, shapes.len().saturating_sub(1), &mut Vec::new(), &mut Vec::new(), &mut found);
        let numbers = found.iter().flat_map(|(_, _, corners)| corners.iter().flatten());
        // Rays are made of floats.
        let log = numbers.map(|x| x.denominator().trailing_zeros().unwrap_or(0)).fold(149, usize::max);
        let triangles = found.into_iter().map(|(path, prim, corners)| {
            let exact = corners.clone().map(|corner| corner.map(|x| scaled(&x, log)));
            let corners = corners.map(|corner| Vec3::from(corner.map(|x| round_f32(&x))));
            Placed { path, prim, exact, corners }
        });
        Self { triangles: triangles.collect(), log }
    }

    /// Corners of all triangles, rounded to floats.
    pub fn corners(&self) -> impl Iterator<Item = &[Vec3; 3]> {
        self.triangles.iter().map(|triangle| &triangle.corners)
    }

    /// The first hit in the order of rounded distance, path, triangle.
    pub fn closest(&self, ray: &Ray) -> Option<InstanceHit> {
        let [o, d] = [ray.origin(), ray.direction()].map(|v| v.to_array().map(|x| scaled(&exact(x), self.log)));
        let hits = self.triangles.iter().filter_map(|placed| {
            let [t, u, v] = meet(&placed.exact, &o, &d)?;
            let ends_before = ray.tmax() != f32::INFINITY && t > exact(ray.tmax());
            let is_within = !ends_before && t >= exact(ray.tmin());
            let [t, u, v] = [t, u, v].map(|x| round_f32(&x));
            is_within.then(|| InstanceHit { path: placed.path.clone(), prim: placed.prim, t, u, v })
        });
        hits.min_by(|a, b| a.t.total_cmp(&b.t).then_with(|| (&a.path, a.prim).cmp(&(&b.path, b.prim))))
    }
}

type Moved = (Vec<u32>, u32, [[RBig; 3]; 3]);

fn collect(shapes: &[Shape], shape: usize, path: &mut Vec<u32>, maps: &mut Vec<AffineMap>, found: &mut Vec<Moved>) {
    match shapes.get(shape) {
        None => {}
        Some(Shape::Mesh(mesh)) => {
            for prim in 0..mesh.triangles().len() {
                let corners = mesh.triangle(prim).map(|corner| {
                    maps.iter().rev().fold(corner.to_array().map(exact), |v, map| {
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

/// Distance and weights of the hit of a line, if the triangle is hit: Cramer's rule for o + t d = a + u (b - a) + v (c
/// - a).
pub(crate) fn meet([a, b, c]: &[Vector; 3], o: &Vector, d: &Vector) -> Option<[RBig; 3]> {
    let minus = |x: &Vector, y: &Vector| -> Vector { std::array::from_fn(|k| &x[k] - &y[k]) };
    let (e, f, s) = (minus(b, a), minus(c, a), minus(o, a));
    let back: Vector = d.clone().map(|x| -x);
    let whole = determinant(&e, &f, &back);
    if whole.is_zero() {
        return None;
    }
    let over = |top: IBig| RBig::from_parts_signed(top, whole.clone());
    let (u, v) = (over(determinant(&s, &f, &back)), over(determinant(&e, &s, &back)));
    if u < RBig::ZERO || v < RBig::ZERO || &u + &v > RBig::ONE {
        return None;
    }
    Some([over(determinant(&e, &f, &s)), u, v])
}

/// Of the matrix with these columns.
fn determinant(a: &Vector, b: &Vector, c: &Vector) -> IBig {
    let minor = |i: usize, j: usize| &b[i] * &c[j] - &b[j] * &c[i];
    &a[0] * minor(1, 2) + &a[1] * minor(2, 0) + &a[2] * minor(0, 1)
}

fn exact(x: f32) -> RBig {
    // All numbers here are finite.
    RBig::try_from(x).unwrap_or(RBig::ZERO)
}

/// A number whose denominator is a power of two, times 2 to the power of `log`.
fn scaled(x: &RBig, log: usize) -> IBig {
    let whole = x * RBig::from(UBig::ONE << log);
    debug_assert!(whole.is_int(), "{x} has more than {log} digits");
    whole.numerator().clone()
}
