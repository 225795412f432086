//! Rays for a given mesh.

use glam::Vec3;

use crate::generate::draw::Draw;
use crate::geom::{Aabb, Mesh, Ray};

/// Returns `n` rays for a mesh, of ordinary and difficult kinds; fewer if coordinates overflow.
///
/// The kinds alternate: a camera's primary rays, row by row; rays through the box of the mesh; rays at a vertex and at
/// the middle of an edge; rays along an axis, with zeros of either sign; rays that start on a plane of a box; rays with
/// `tmin > 0` and a finite `tmax`, some of which end exactly at a vertex; rays that start on a triangle.
pub fn rays(mesh: &Mesh, seed: u64, n: usize) -> Vec<Ray> {
    let mut source = Source { mesh, bounds: Aabb::of(mesh.vertices()), random: Draw::new(seed) };
    if mesh.triangles().is_empty() {
        return Vec::new();
    }
    let camera = source.camera(n.div_ceil(KINDS));
    (0..n).filter_map(|i| source.ray(i % KINDS, i / KINDS, &camera)).collect()
}

/// Returns `n` primary rays of a camera that looks at the whole mesh from outside, row by row.
pub fn camera_rays(mesh: &Mesh, seed: u64, n: usize) -> Vec<Ray> {
    let mut source = Source { mesh, bounds: Aabb::of(mesh.vertices()), random: Draw::new(seed) };
    let camera = source.camera(n);
    (0..n).filter_map(|i| Ray::new(camera.eye, camera.direction(i)).ok()).collect()
}

const KINDS: usize = 8;

struct Source<'a> {
    mesh: &'a Mesh,
    bounds: Aabb,
    random: Draw,
}

/// A pinhole camera: the direction of pixel (x, y) is `forward + x right + y up`, each from -1 to 1.
struct Camera {
    eye: Vec3,
    forward: Vec3,
    right: Vec3,
    up: Vec3,
    width: usize,
}

impl Source<'_> {
    fn ray(&mut self, kind: usize, i: usize, camera: &Camera) -> Option<Ray> {
        let endless = |origin, direction| (origin, direction, 0.0, f32::INFINITY);
        let (origin, direction, tmin, tmax) = match kind {
            0 => endless(camera.eye, camera.direction(i)),
            1 => {
                let origin = self.around();
                endless(origin, self.inside() - origin)
            }
            2 => {
                let origin = self.around();
                endless(origin, self.vertex() - origin)
            }
            3 => {
                let (origin, [a, b, _]) = (self.around(), self.corners());
                endless(origin, (a * 0.5 + b * 0.5) - origin)
            }
            4 => {
                let axis = self.random.below(3);
                let mut direction = self.random.zeros();
                direction[axis] = self.random.sign();
                let through = if self.random.below(2) == 0 { self.inside() } else { self.vertex() };
                endless(through - direction * self.size() * self.random.unit(), direction)
            }
            5 => {
                let (axis, plane) = (self.random.below(3), self.plane());
                let mut origin = self.inside();
                origin[axis] = plane[axis];
                let mut direction = self.random.direction();
                if self.random.below(4) != 0 {
                    direction[axis] = self.random.zeros()[axis];
                }
                endless(origin, direction)
            }
            6 => {
                let (origin, target) = (self.around(), self.vertex());
                let whole = self.random.below(2) == 0;
                let tmax = if whole { 1.0 } else { self.random.between(0.5, 2.0) };
                (origin, target - origin, self.random.unit() * tmax, tmax)
            }
            _ => {
                let [a, b, c] = self.corners();
                let (u, v) = (self.random.unit() * 0.5, self.random.unit() * 0.5);
                (a + (b - a) * u + (c - a) * v, self.random.direction(), 1e-4 * self.size(), f32::INFINITY)
            }
        };
        Ray::within(origin, direction, tmin, tmax).ok()
    }

    /// Returns a camera that looks at the whole mesh from a corner of its surroundings, with `pixels` pixels.
    fn camera(&mut self, pixels: usize) -> Camera {
        let eye = self.bounds.centroid() + self.random.direction() * (0.75 * self.size());
        let forward = (self.bounds.centroid() - eye).try_normalize().unwrap_or(Vec3::X);
        let right = forward.any_orthonormal_vector();
        let width = (pixels as f32).sqrt().ceil() as usize;
        Camera { eye, forward, right: right * 0.5, up: forward.cross(right) * 0.5, width }
    }

    /// Returns the length of the diagonal; 1 for a single point.
    fn size(&self) -> f32 {
        let size = self.bounds.extent().length();
        if size > 0.0 { size } else { 1.0 }
    }

    fn inside(&mut self) -> Vec3 {
        self.bounds.lo + self.bounds.extent() * self.random.cube()
    }

    /// Returns a point in a cube twice as wide as the diagonal.
    fn around(&mut self) -> Vec3 {
        self.bounds.centroid() + (self.random.cube() * 2.0 - 1.0) * self.size()
    }

    fn corners(&mut self) -> [Vec3; 3] {
        let mut corners = self.mesh.triangle(self.random.below(self.mesh.triangles().len()));
        corners.rotate_left(self.random.below(3));
        corners
    }

    fn vertex(&mut self) -> Vec3 {
        self.corners()[0]
    }

    /// Returns a corner of the whole box or of a triangle's box.
    fn plane(&mut self) -> Vec3 {
        let aabb = if self.random.below(2) == 0 { self.bounds } else { Aabb::of(&self.corners()) };
        if self.random.below(2) == 0 { aabb.lo } else { aabb.hi }
    }
}

impl Camera {
    fn direction(&self, i: usize) -> Vec3 {
        let [x, y] = [i % self.width, i / self.width].map(|i| 2.0 * (i as f32 + 0.5) / self.width as f32 - 1.0);
        self.forward + self.right * x + self.up * y
    }
}
