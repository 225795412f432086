//! A camera and its rays.

use glam::{DVec3, Vec3};

use crate::geom::{Aabb, Mesh, Ray};

/// A pinhole camera with a square image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Its position.
    pub eye: Vec3,
    /// The point in the middle of its image.
    pub target: Vec3,
    /// The up direction of the image; any length, not along the view.
    pub up: Vec3,
    /// Field of view from the lower to the upper edge of the image, in degrees.
    pub degrees: f32,
}

/// The default direction to the eye from a scene (y is up).
const FROM: DVec3 = DVec3::new(0.5, 0.4, 1.0);
const DEGREES: f32 = 40.0;

/// The part of the image, from the middle to the edges, that a scene fills by default.
const FILLED: f64 = 0.96;

impl View {
    /// Returns the view of a whole scene, from the front, the right and above, at the least distance at which all of
    /// its triangles are in the image. It shows interiors from outside; they need a custom view.
    ///
    /// ```
    /// use stackless_bvh::generate::procedural::{self, View};
    /// let mesh = procedural::strands(1, 10);
    /// assert_eq!(View::of(&mesh).rays(1000).len(), 1000);
    /// ```
    pub fn of(mesh: &Mesh) -> Self {
        let corners = || (0..mesh.triangles().len()).flat_map(|i| mesh.triangle(i));
        let target = corners().fold(Aabb::EMPTY, Aabb::grow).centroid();
        let mut view = Self { eye: target + FROM.as_vec3(), target, up: Vec3::Y, degrees: DEGREES };
        // The target may be so far away that a sum with it loses the offset. So the axes are those of a view at the
        // origin.
        let [forward, right, up] = Self { eye: FROM.as_vec3(), target: Vec3::ZERO, ..view }.frame();
        // A point is in the image if |x - eye| is at most slope (z - eye), along both edges: a bound on the eye for each.
        let slope = view.tangent() * FILLED;
        let mut most = [f64::NEG_INFINITY; 4];
        for v in corners().map(|v| v.as_dvec3() - target.as_dvec3()) {
            let [x, y, z] = [right, up, forward].map(|axis| axis.dot(v));
            for (most, side) in most.iter_mut().zip([x, -x, y, -y]) {
                *most = most.max(side - slope * z);
            }
        }
        let [right_edge, left, upper, lower] = most;
        let back = (right_edge + left).max(upper + lower) / (2.0 * slope);
        if !(back.is_finite() && back > 0.0) {
            return view;
        }
        let mut aside = right * ((right_edge - left) / 2.0) + up * ((upper - lower) / 2.0);
        // Along the other edge there is room. The middle of its bounds is not the middle of the image, which depends on the
        // depths of both ends.
        for _ in 0..4 {
            let mut ends = [[[f64::INFINITY, 1.0], [f64::NEG_INFINITY, 1.0]]; 2];
            for v in corners().map(|v| v.as_dvec3() - target.as_dvec3() - aside) {
                let depth = forward.dot(v) + back;
                for ([least, most], axis) in ends.iter_mut().zip([right, up]) {
                    let x = axis.dot(v) / depth;
                    if x < least[0] {
                        *least = [x, depth];
                    }
                    if x > most[0] {
                        *most = [x, depth];
                    }
                }
            }
            for ([[least, of_least], [most, of_most]], axis) in ends.into_iter().zip([right, up]) {
                aside += axis * ((least + most) / (1.0 / of_least + 1.0 / of_most));
            }
        }
        let middle = target.as_dvec3() + aside;
        view.eye = (middle - forward * back).as_vec3();
        view.target = middle.as_vec3();
        view
    }

    /// Returns `n` primary rays through a square of pixels, row by row from the upper left; fewer if coordinates
    /// overflow. Directions end in the plane of the target.
    pub fn rays(&self, n: usize) -> Vec<Ray> {
        (0..n).filter_map(|i| self.ray_of(i, n)).collect()
    }

    /// Returns ray `i` of `n` [`rays`](Self::rays). `None` if coordinates overflow.
    pub fn ray_of(&self, i: usize, n: usize) -> Option<Ray> {
        let width = (n as f64).sqrt().ceil();
        let [x, y] = [i as f64 % width, (i as f64 / width).floor()].map(|i| 2.0 * (i + 0.5) / width - 1.0);
        self.ray(x, -y)
    }

    /// Returns the primary ray through a position in the image: from -1 at the left and lower edges to 1 at the right
    /// and upper edges, and beyond in a wider image. `None` if coordinates overflow.
    pub fn ray(&self, x: f64, y: f64) -> Option<Ray> {
        let [forward, right, up] = self.frame();
        let direction = forward + (right * x + up * y) * self.tangent();
        Ray::new(self.eye, direction.as_vec3()).ok()
    }

    /// Returns forward, right and up: orthogonal vectors of unit length.
    pub fn frame(&self) -> [DVec3; 3] {
        let forward = (self.target.as_dvec3() - self.eye.as_dvec3()).try_normalize().unwrap_or(DVec3::NEG_Z);
        let right = forward.cross(self.up.as_dvec3()).try_normalize().unwrap_or(forward.any_orthonormal_vector());
        [forward, right, right.cross(forward)]
    }

    /// Returns half of the image's height at a distance of 1.
    fn tangent(&self) -> f64 {
        (f64::from(self.degrees) * 0.5).to_radians().tan()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{soup, stadium, strands};
    use super::*;
    use crate::generate::stress::icosphere;

    /// Returns the position of a point in the image, from -1 to 1, if it is in front of the camera.
    fn project(view: &View, point: Vec3) -> Option<[f64; 2]> {
        let ([forward, right, up], v) = (view.frame(), point.as_dvec3() - view.eye.as_dvec3());
        let depth = forward.dot(v) * view.tangent();
        (depth > 0.0).then(|| [right.dot(v) / depth, up.dot(v) / depth])
    }

    /// All of a scene is in the image, centred, and at two opposite edges there is no room left.
    #[test]
    fn all_of_a_scene_fills_the_image() {
        let spheres = [(1.0, 0.0), (100.0, 1e3), (1e-3, 0.0), (1e10, 0.0)];
        let spheres = spheres.map(|(radius, offset)| icosphere(3, radius, Vec3::splat(offset)).unwrap());
        let far_beside = Mesh::new(vec![Vec3::X, Vec3::Y, Vec3::Z, Vec3::splat(1e9)], vec![[0, 1, 2]]).unwrap();
        for mesh in spheres.into_iter().chain([strands(1, 50), soup(1, 50), stadium(1), far_beside]) {
            let view = View::of(&mesh);
            let mut ends = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
            for corner in (0..mesh.triangles().len()).flat_map(|i| mesh.triangle(i)) {
                let place = project(&view, corner).unwrap();
                for ([least, most], x) in ends.iter_mut().zip(place) {
                    (*least, *most) = (least.min(x), most.max(x));
                }
            }
            let is_within = |[least, most]: [f64; 2]| least > -FILLED - 0.001 && most < FILLED + 0.001;
            let is_full = |[least, most]: [f64; 2]| least < 0.001 - FILLED && most > FILLED - 0.001;
            assert!(ends.into_iter().all(is_within) && ends.into_iter().any(is_full), "{view:?}: {ends:?}");
            assert!(ends.into_iter().all(|[least, most]| (least + most).abs() < 0.01), "{view:?}: {ends:?}");
        }
    }

    #[test]
    fn rays_go_row_by_row_from_the_upper_left_corner_of_the_image() {
        let view = View { eye: Vec3::Z * 5.0, target: Vec3::ZERO, up: Vec3::Y, degrees: 90.0 };
        let directions: Vec<_> = view.rays(4).iter().map(Ray::direction).collect();
        let expected = [[-0.5, 0.5], [0.5, 0.5], [-0.5, -0.5], [0.5, -0.5]].map(|[x, y]| Vec3::new(x, y, -1.0));
        for (direction, expected) in directions.iter().zip(expected) {
            assert!(direction.distance(expected) < 1e-6, "{directions:?}");
        }
        assert_eq!(view.rays(1)[0].direction(), Vec3::NEG_Z);
        assert!(view.rays(0).is_empty());
    }

    #[test]
    fn points_have_a_view() {
        let point = Mesh::new(vec![Vec3::splat(1e30)], vec![[0, 0, 0]]).unwrap();
        assert_eq!(View::of(&point).rays(9).len(), 9);
    }
}
