//! Scenes in double precision, and rays that aim at rounding errors there.

use glam::{DVec3, Vec3};

use super::draw::{Draw, one_of};
use crate::geom::{Mesh, MeshError, Ray};

/// A transformation of a scene in single precision: `point * scale + shift`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Its name in reports.
    pub name: &'static str,
    /// Added to all points, after scaling.
    pub shift: DVec3,
    /// Factor of all lengths, before the shift.
    pub scale: f64,
    /// Whether each coordinate of a corner is changed by up to 1e-12 of itself, so that single precision cannot
    /// represent it.
    pub is_perturbed: bool,
}

/// The original position, with more digits, at the earth's radius, tiny, and huge.
pub const PLACES: [Place; 5] = [
    Place { name: "as it is", shift: DVec3::ZERO, scale: 1.0, is_perturbed: false },
    Place { name: "perturbed", shift: DVec3::ZERO, scale: 1.0, is_perturbed: true },
    Place { name: "at 6.4e6", shift: DVec3::new(6.4e6, -3.1e6, 5.2e6), scale: 1.0, is_perturbed: true },
    Place { name: "by 1e-50", shift: DVec3::ZERO, scale: 1e-50, is_perturbed: false },
    Place { name: "by 1e50", shift: DVec3::ZERO, scale: 1e50, is_perturbed: true },
];

impl Place {
    /// Returns the transformed mesh.
    ///
    /// # Errors
    /// [`MeshError`] if coordinates overflow.
    pub fn mesh(&self, mesh: &Mesh) -> Result<Mesh<DVec3>, MeshError> {
        let mut draw = Draw::named(self.name);
        let vertices = mesh.vertices().iter().map(|&v| {
            let by = if self.is_perturbed { draw.centred().as_dvec3() * 1e-12 } else { DVec3::ZERO };
            self.point(v) * (DVec3::ONE + by)
        });
        Mesh::new(vertices.collect(), mesh.triangles().to_vec())
    }

    /// Returns the transformed ray; distances do not change.
    pub fn ray(&self, ray: &Ray) -> Option<Ray<DVec3>> {
        let direction = ray.direction().as_dvec3() * self.scale;
        Ray::within(self.point(ray.origin()), direction, ray.tmin().into(), ray.tmax().into()).ok()
    }

    fn point(&self, v: Vec3) -> DVec3 {
        v.as_dvec3() * self.scale + self.shift
    }
}

/// Returns `n` adversarial rays for any mesh, the same for the same seed; fewer if numbers overflow.
///
/// The kinds alternate: at random; at a corner, at the middle of an edge, at another point of an edge; up to exactly a
/// corner; along an axis through a corner; from a point of the surface; within the plane of a triangle, from a corner;
/// with a component of 0, up to a corner or next to it; with a direction of any length; with a component close to 0;
/// and from up to 2^40 sizes away.
pub fn aimed(mesh: &Mesh<DVec3>, seed: u64, n: usize) -> Vec<Ray<DVec3>> {
    let (mut lo, mut hi) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for &v in mesh.vertices() {
        (lo, hi) = (lo.min(v), hi.max(v));
    }
    let (middle, size) = (lo * 0.5 + hi * 0.5, (hi - lo).max_element());
    let size = if size > 0.0 { size } else { 1.0 };
    let mut draw = Draw::new(seed);
    (0..n).filter_map(|i| ray(&mut draw, mesh, middle, size, i)).collect()
}

fn ray(draw: &mut Draw, mesh: &Mesh<DVec3>, middle: DVec3, size: f64, i: usize) -> Option<Ray<DVec3>> {
    const KINDS: usize = 12;
    let around = middle + vector(draw) * size * one_of([0.5, 1.0, 3.0, 30.0], draw);
    let [a, b, c] = mesh.triangle(draw.below(mesh.triangles().len()));
    let inside = || a * 0.25 + b * 0.5 + c * 0.25;
    let endless = f64::INFINITY;
    let (origin, direction, tmin, tmax) = match i % KINDS {
        0 => (around, vector(draw) * size, 0.0, endless),
        1 => (around, a - around, 0.0, endless),
        2 => (around, (a * 0.5 + b * 0.5) - around, 0.0, endless),
        3 => (around, (a + (b - a) * unit(draw)) - around, 0.0, endless),
        4 => (around, a - around, unit(draw), 1.0),
        5 => {
            let axis = draw.axis().as_dvec3();
            (a - axis * size * unit(draw), axis, 0.0, endless)
        }
        6 => {
            let (u, v) = (unit(draw) * 0.5, unit(draw) * 0.5);
            (a + (b - a) * u + (c - a) * v, vector(draw), one_of([0.0, 1e-9 * size], draw), endless)
        }
        7 => (a, b - a + (c - a) * unit(draw), 0.0, endless),
        8 => {
            let mut d = vector(draw);
            d[draw.below(3)] = 0.0;
            (a - d * size, d * size, 0.0, 1.0 + (unit(draw) - 0.5) * 1e-15)
        }
        9 => (around, vector(draw) * 2f64.powi(draw.int(60) as i32), 0.0, endless),
        10 => {
            let mut d = vector(draw);
            d[draw.below(3)] *= 2f64.powi(-(draw.below(200) as i32));
            (a - d * size * unit(draw), d, 0.0, endless)
        }
        _ => {
            let o = middle + vector(draw) * size * 2f64.powi(draw.below(40) as i32);
            (o, inside() - o, 0.0, endless)
        }
    };
    Ray::within(origin, direction, tmin, tmax).ok()
}

/// In [0, 1), with all digits of a double.
fn unit(draw: &mut Draw) -> f64 {
    f64::from(draw.unit()) + f64::from(draw.unit()) / f64::from(1 << 24)
}

/// In the cube from -1 to 1.
fn vector(draw: &mut Draw) -> DVec3 {
    DVec3::new(unit(draw), unit(draw), unit(draw)) * 2.0 - DVec3::ONE
}
