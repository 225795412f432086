//! The oracle: every triangle of every instance moved to where it is, and each of them asked, in rational arithmetic.

use dashu_int::{IBig, UBig};
use glam::Vec3;
use stackless_bvh::geom::truth::{RBig, round_f32};
use stackless_bvh::geom::{Affine, Ray};
use stackless_bvh::scene::Mesh;
use stackless_bvh::trace::InstanceHit;

type Vector = [IBig; 3];

/// What is placed, as the oracle knows it.
pub(crate) enum Shape {
    Mesh(Mesh),
    /// Indices of earlier shapes, and their places.
    Group(Vec<(usize, Affine)>),
}

/// All triangles of the last shape.
pub(crate) struct Flat {
    triangles: Vec<Placed>,
    /// Coordinates are integers over 2 to this power.
    log: usize,
}

struct Placed {
    path: Vec<u32>,
    prim: u32,
    exact: [Vector; 3],
    /// Rounded.
    corners: [Vec3; 3],
}

impl Flat {
    pub(crate) fn new(shapes: &[Shape]) -> Self {
        let mut found = Vec::new();
        collect(shapes, shapes.len() - 1, &mut Vec::new(), &mut Vec::new(), &mut found);
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
    pub(crate) fn corners(&self) -> impl Iterator<Item = &[Vec3; 3]> {
        self.triangles.iter().map(|triangle| &triangle.corners)
    }

    /// The first hit in the order of rounded distance, path, triangle.
    pub(crate) fn closest(&self, ray: &Ray) -> Option<InstanceHit> {
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

fn collect(shapes: &[Shape], shape: usize, path: &mut Vec<u32>, maps: &mut Vec<Affine>, found: &mut Vec<Moved>) {
    match &shapes[shape] {
        Shape::Mesh(mesh) => {
            for prim in 0..mesh.triangles().len() {
                let corners = mesh.triangle(prim).map(|corner| {
                    maps.iter().rev().fold(corner.to_array().map(exact), |v, map| {
                        map.rows().map(|[x, y, z, b]| exact(x) * &v[0] + exact(y) * &v[1] + exact(z) * &v[2] + exact(b))
                    })
                });
                found.push((path.clone(), prim as u32, corners));
            }
        }
        Shape::Group(instances) => {
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

/// Distance and weights of the hit of a line, if the triangle is hit: Cramer's rule for o + t d = a + u (b - a) + v (c - a).
fn meet([a, b, c]: &[Vector; 3], o: &Vector, d: &Vector) -> Option<[RBig; 3]> {
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
    RBig::try_from(x).expect("a finite number")
}

/// A number whose denominator is a power of two, times 2 to the power of `log`.
fn scaled(x: &RBig, log: usize) -> IBig {
    let whole = x * RBig::from(UBig::ONE << log);
    assert!(whole.is_int());
    whole.numerator().clone()
}
