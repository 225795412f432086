//! The arithmetic of the ray kernels on the CPU, operation by operation, as searches for the library's traversals.

mod eight;
mod two;

pub use eight::{Visited, through};
pub use two::Model;

use stackless_bvh::geom::{Ray, Triangle};

use crate::probe::Arithmetic;

/// The end of unbounded rays.
pub const END: f32 = 1e38;

/// The box test treats smaller direction components than the reciprocal of this as 0.
pub const CLAMPED_RECIPROCAL: f32 = f32::from_bits((80 + 127) << 23);

/// The result of a ray: triangle (`u32::MAX` for none), distance, weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// Index of the triangle in the mesh.
    pub triangle: u32,
    /// Distance, or the ray's end.
    pub t: f32,
    /// Weights of the second and third corner.
    pub weights: [f32; 2],
}

impl Found {
    /// From the four words of a kernel.
    pub fn of_words(words: [u32; 4]) -> Self {
        let [t, u, v] = [words[1], words[2], words[3]].map(f32::from_bits);
        Self { triangle: words[0], t, weights: [u, v] }
    }

    /// Whether there is a hit.
    pub const fn is_hit(&self) -> bool {
        self.triangle != u32::MAX
    }
}

/// A ray in the format of kernels, 12 words.
pub fn ray_words(ray: &Ray) -> [u32; 12] {
    let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin().to_array(), ray.direction().to_array());
    let [ix, iy, iz] = reciprocals(ray);
    [ox, oy, oz, ray.tmin(), dx, dy, dz, ray.tmax().min(END), ix, iy, iz, 0.0].map(f32::to_bits)
}

/// Whether the box test treats a component of the ray's direction as 0.
pub fn has_parallel(ray: &Ray) -> bool {
    reciprocals(ray).iter().any(|i| i.abs() == CLAMPED_RECIPROCAL)
}

fn reciprocals(ray: &Ray) -> [f32; 3] {
    // -0 becomes 0, so a component of 0 has a positive reciprocal.
    let of = |d: f32| (1.0 / (d + 0.0)).clamp(-CLAMPED_RECIPROCAL, CLAMPED_RECIPROCAL);
    ray.direction().to_array().map(of)
}

/// The common part of all searches of a ray: `ray.wgsl`, `triangle_single.wgsl`, and the test of a box.
#[derive(Debug)]
struct OfRay<'a> {
    arithmetic: &'a Arithmetic,
    ray: Ray,
    inverse_near: [f32; 3],
    inverse_far: [f32; 3],
    parallel: [bool; 3],
    found: Found,
}

impl<'a> OfRay<'a> {
    fn new(arithmetic: &'a Arithmetic, ray: &Ray) -> Self {
        let inverse = reciprocals(ray);
        let moved = |by: i32| inverse.map(|i| f32::from_bits(i.to_bits().wrapping_add_signed(by)));
        let found = Found { triangle: u32::MAX, t: ray.tmax().min(END), weights: [0.0; 2] };
        let parallel = inverse.map(|i| i.abs() == CLAMPED_RECIPROCAL);
        Self { arithmetic, ray: *ray, inverse_near: moved(-2), inverse_far: moved(2), parallel, found }
    }

    /// Distances at which the ray enters and leaves a box. `planes` returns the lower and the upper plane along an
    /// axis.
    fn slab(&self, planes: impl Fn(usize) -> [f32; 2]) -> [f32; 2] {
        let (mut near, mut far) = (self.ray.tmin(), self.found.t);
        for k in 0..3 {
            let [lower, upper] = planes(k);
            let backward = self.inverse_near[k].is_sign_negative();
            let (first, second) = if backward { (upper, lower) } else { (lower, upper) };
            let near_k = self.arithmetic.kept((first - self.ray.origin()[k]) * self.inverse_near[k]);
            let mut far_k = self.arithmetic.kept((second - self.ray.origin()[k]) * self.inverse_far[k]);
            if self.parallel[k] && far_k >= 0.0 {
                far_k = END;
            }
            near = if near_k > near { near_k } else { near };
            far = if far_k < far { far_k } else { far };
        }
        [near, far]
    }

    /// Tests a triangle. Returns whether it is the best hit so far.
    fn meets(&mut self, Triangle([v0, v1, v2]): &Triangle, index: u32) -> bool {
        // Numbers are 0 or at least 2^-100 [BAND-1], so differences are not subnormal.
        let (arithmetic, e1, e2, s) = (self.arithmetic, *v1 - *v0, *v2 - *v0, self.ray.origin() - *v0);
        let d = self.ray.direction();
        let (p, q) = (arithmetic.cross(d, e2), arithmetic.cross(s, e1));
        let det = arithmetic.dot(e1, p);
        let sign = if det < 0.0 { -1.0 } else { 1.0 };
        let (size, u, v) = (det * sign, arithmetic.dot(s, p) * sign, arithmetic.dot(d, q) * sign);
        if !(size > 0.0 && u >= 0.0 && v >= 0.0 && arithmetic.kept(arithmetic.kept(size - u) - v) >= 0.0) {
            return false;
        }
        // Returns +0 for 0 of either sign.
        let divide = |a: f32, b: f32| if a == 0.0 { 0.0 } else { arithmetic.kept(a / b) + 0.0 };
        let (t, best) = (divide(arithmetic.dot(e2, q), det), &self.found);
        let is_best = t >= self.ray.tmin() && (t < best.t || t == best.t && index <= best.triangle);
        if is_best {
            self.found = Found { triangle: index, t, weights: [divide(u, size), divide(v, size)] };
        }
        is_best
    }
}
