//! Where a camera stands, and its rays.

use glam::{DVec3, Vec3};

use crate::geom::{Aabb, Mesh, Ray};

/// A pinhole camera with a square image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where it stands.
    pub eye: Vec3,
    /// What is in the middle of its image.
    pub target: Vec3,
    /// What is up there; any length, not along the view.
    pub up: Vec3,
    /// Field of view from the lower to the upper edge of the image, in degrees.
    pub degrees: f32,
}

/// The view of a scene: for some that are known by name, one that shows what they are; for all others, from the front,
/// the right and above (y is up), as near that three quarters of the surface are in the image.
///
/// The cameras for interiors are inside of them.
pub fn view(name: &str, mesh: &Mesh) -> View {
    let known = KNOWN.iter().find(|(known, _)| *known == name);
    known.map_or_else(|| from_outside(mesh), |&(_, view)| view)
}

const KNOWN: [(&str, View); 4] = [
    ("sibenik", View::new([-15.0, -8.0, 0.0], [0.0, -6.0, 0.0], Vec3::Y, 70.0)),
    ("conference", View::new([1469.0, 258.0, 496.0], [-479.0, 128.0, -711.0], Vec3::Y, 70.0)),
    ("crytek_sponza", View::new([-60.0, -2.0, -8.0], [60.0, -2.0, -20.0], Vec3::NEG_Z, 70.0)),
    ("munich", View::new([-400.0, -400.0, 250.0], [0.0, 0.0, 0.0], Vec3::Z, 50.0)),
];

/// From where single objects are seen, and how wide.
const FROM: DVec3 = DVec3::new(0.5, 0.4, 1.0);
const DEGREES: f32 = 40.0;

/// The share of its surface that is in the image. With all of it, thin and long parts would have most rays miss.
const IN_IMAGE: f64 = 0.75;

impl View {
    const fn new(eye: [f32; 3], target: [f32; 3], up: Vec3, degrees: f32) -> Self {
        Self { eye: Vec3::from_array(eye), target: Vec3::from_array(target), up, degrees }
    }

    /// `n` primary rays through a square of pixels, row by row from the upper left; fewer where coordinates overflow.
    /// Directions are as long as the distance to the plane of the target needs.
    ///
    /// ```
    /// use stackless_bvh::generate::procedural;
    /// let mesh = procedural::strands(1, 10);
    /// assert_eq!(procedural::view("strands", &mesh).rays(1000).len(), 1000);
    /// ```
    pub fn rays(&self, n: usize) -> Vec<Ray> {
        (0..n).filter_map(|i| self.ray_of(i, n)).collect()
    }

    /// Ray `i` of `n` [`rays`](Self::rays). `None` where coordinates overflow.
    pub fn ray_of(&self, i: usize, n: usize) -> Option<Ray> {
        let width = (n as f64).sqrt().ceil();
        let [x, y] = [i as f64 % width, (i as f64 / width).floor()].map(|i| 2.0 * (i + 0.5) / width - 1.0);
        self.ray(x, -y)
    }

    /// The primary ray through a place of the image: from -1 at the left and lower edges to 1 at the right and upper
    /// ones, and beyond in a wider image. `None` where coordinates overflow.
    pub fn ray(&self, x: f64, y: f64) -> Option<Ray> {
        let [forward, right, up] = self.frame();
        let direction = forward + (right * x + up * y) * self.tangent();
        Ray::new(self.eye, direction.as_vec3()).ok()
    }

    /// Forward, right and up: of unit length and across each other.
    fn frame(&self) -> [DVec3; 3] {
        let forward = (self.target.as_dvec3() - self.eye.as_dvec3()).try_normalize().unwrap_or(DVec3::NEG_Z);
        let right = forward.cross(self.up.as_dvec3()).try_normalize().unwrap_or(forward.any_orthonormal_vector());
        [forward, right, right.cross(forward)]
    }

    /// Half of the image's height at a distance of 1.
    fn tangent(&self) -> f64 {
        (f64::from(self.degrees) * 0.5).to_radians().tan()
    }
}

/// The camera is moved back along its axis until enough of the surface is in the image.
fn from_outside(mesh: &Mesh) -> View {
    let target = Aabb::of(mesh.vertices()).centroid();
    let mut view = View { eye: target + FROM.as_vec3(), target, up: Vec3::Y, degrees: DEGREES };
    // As the target may be so far out that adding to it is rounded away, the axes are those of a view at the origin.
    let [forward, right, up] = View { eye: FROM.as_vec3(), target: Vec3::ZERO, ..view }.frame();
    let mut wanted: Vec<_> = (0..mesh.triangles().len())
        .map(|i| {
            let [a, b, c] = mesh.triangle(i).map(|v| v.as_dvec3() - target.as_dvec3());
            let distance = |v: DVec3| right.dot(v).abs().max(up.dot(v).abs()) / view.tangent() - forward.dot(v);
            (distance(a).max(distance(b)).max(distance(c)), (b - a).cross(c - a).length())
        })
        .collect();
    wanted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let all: f64 = wanted.iter().map(|(_, area)| area).sum();
    let mut seen = 0.0;
    let is_enough = |&&(_, area): &&(f64, f64)| {
        seen += area;
        seen >= IN_IMAGE * all
    };
    let distance = wanted.iter().find(is_enough).map_or(0.0, |(distance, _)| *distance);
    let distance = if distance > 0.0 { distance } else { 1.0 };
    view.eye = (target.as_dvec3() - forward * distance).as_vec3();
    view
}

#[cfg(test)]
mod tests {
    use super::super::{soup, strands};
    use super::*;
    use crate::generate::stress::icosphere;

    /// Where a point is in the image, from -1 to 1, if it is in front of the camera.
    fn project(view: &View, point: Vec3) -> Option<[f64; 2]> {
        let ([forward, right, up], v) = (view.frame(), point.as_dvec3() - view.eye.as_dvec3());
        let depth = forward.dot(v) * view.tangent();
        (depth > 0.0).then(|| [right.dot(v) / depth, up.dot(v) / depth])
    }

    #[test]
    fn three_quarters_of_the_surface_fill_the_image() {
        let spheres = [(1.0, 0.0), (100.0, 1e3), (1e-3, 0.0), (1e10, 0.0)];
        let spheres = spheres.map(|(radius, offset)| icosphere(3, radius, Vec3::splat(offset)).unwrap());
        for mesh in spheres.into_iter().chain([strands(1, 50), soup(1, 50)]) {
            let view = view("nothing known", &mesh);
            let mut seen = [0.0; 3];
            for i in 0..mesh.triangles().len() {
                let [a, b, c] = mesh.triangle(i);
                let area = (b.as_dvec3() - a.as_dvec3()).cross(c.as_dvec3() - a.as_dvec3()).length();
                let far = |v| project(&view, v).map_or(9.0, |[x, y]| x.abs().max(y.abs()));
                let farthest = [a, b, c].into_iter().map(far).fold(0.0, f64::max);
                for (sum, edge) in seen.iter_mut().zip([1.001, 0.999, f64::INFINITY]) {
                    *sum += if farthest <= edge { area } else { 0.0 };
                }
            }
            let [within, well_within, all] = seen;
            assert!(well_within < IN_IMAGE * all && IN_IMAGE * all <= within, "{view:?}: {seen:?}");
        }
    }

    #[test]
    fn rays_go_row_by_row_from_the_upper_left_corner_of_the_image() {
        let view = View::new([0.0, 0.0, 5.0], [0.0, 0.0, 0.0], Vec3::Y, 90.0);
        let directions: Vec<_> = view.rays(4).iter().map(Ray::direction).collect();
        let expected = [[-0.5, 0.5], [0.5, 0.5], [-0.5, -0.5], [0.5, -0.5]].map(|[x, y]| Vec3::new(x, y, -1.0));
        for (direction, expected) in directions.iter().zip(expected) {
            assert!(direction.distance(expected) < 1e-6, "{directions:?}");
        }
        assert_eq!(view.rays(1)[0].direction(), Vec3::NEG_Z);
        assert!(view.rays(0).is_empty());
    }

    #[test]
    fn points_and_known_scenes_have_a_view() {
        let point = Mesh::new(vec![Vec3::splat(1e30)], vec![[0, 0, 0]]).unwrap();
        assert_eq!(view("point", &point).rays(9).len(), 9);
        for (name, known) in KNOWN {
            assert_eq!(view(name, &point), known);
            let [forward, right, up] = known.frame();
            assert!(up.dot(known.up.as_dvec3()) > 0.7 && right.dot(forward).abs() < 1e-9, "{name}");
        }
    }
}
