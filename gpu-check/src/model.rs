//! The ray kernels' arithmetic on the CPU, operation by operation, as a search that the library's traversals run.

use glam::Vec3;
use stackless_bvh::bvh::Bvh;
use stackless_bvh::geom::{Ray, Triangle};
use stackless_bvh::order::{Descent, Flow, Pruned, Pruning, Side, Visitor};
use stackless_bvh::traverse::{PruningStack, Stack, traverse, traverse_pruned};
use stackless_bvh::tree::Node;

use crate::probe::Arithmetic;

/// The end of rays that have none.
pub const END: f32 = 1e38;

/// Components of a direction below the reciprocal of this are taken to be 0 by the box test.
pub const CLAMPED_RECIPROCAL: f32 = f32::from_bits((80 + 127) << 23);

/// What a kernel writes for a ray: triangle (`u32::MAX` for none), distance, weights.
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

/// A ray as kernels read it, 12 words.
pub fn ray_words(ray: &Ray) -> [u32; 12] {
    let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin().to_array(), ray.direction().to_array());
    let [ix, iy, iz] = reciprocals(ray);
    [ox, oy, oz, ray.tmin(), dx, dy, dz, ray.tmax().min(END), ix, iy, iz, 0.0].map(f32::to_bits)
}

/// Whether the box test takes a component of the ray's direction to be 0.
pub fn has_parallel(ray: &Ray) -> bool {
    reciprocals(ray).iter().any(|i| i.abs() == CLAMPED_RECIPROCAL)
}

fn reciprocals(ray: &Ray) -> [f32; 3] {
    // Without -0: a component of 0 has a positive reciprocal.
    let of = |d: f32| (1.0 / (d + 0.0)).clamp(-CLAMPED_RECIPROCAL, CLAMPED_RECIPROCAL);
    ray.direction().to_array().map(of)
}

/// The search of `search_ray.wgsl` and `triangle_single.wgsl`.
#[derive(Debug)]
pub struct Model<'a> {
    arithmetic: &'a Arithmetic,
    bvh: &'a Bvh,
    ray: Ray,
    inverse_near: [f32; 3],
    inverse_far: [f32; 3],
    parallel: [bool; 3],
    any: bool,
    found: Found,
    leaf: Option<Node>,
}

impl<'a> Model<'a> {
    /// The result of a ray, with this pruning, for the closest hit or any.
    pub fn trace(arithmetic: &'a Arithmetic, bvh: &'a Bvh, ray: &Ray, pruning: Pruning, any: bool) -> Found {
        let inverse = reciprocals(ray);
        let moved = |by: i32| inverse.map(|i| f32::from_bits(i.to_bits().wrapping_add_signed(by)));
        let found = Found { triangle: u32::MAX, t: ray.tmax().min(END), weights: [0.0; 2] };
        let (inverse_near, inverse_far) = (moved(-2), moved(2));
        let parallel = inverse.map(|i| i.abs() == CLAMPED_RECIPROCAL);
        let mut model =
            Self { arithmetic, bvh, ray: *ray, inverse_near, inverse_far, parallel, any, found, leaf: None };
        let mut memory = Vec::new();
        let (search, recorder) = (&mut model, &mut ());
        match pruning {
            Pruning::Never => traverse(Stack::new(bvh, &mut memory), search, recorder),
            Pruning::Disjoint => traverse_pruned(PruningStack::<_, false>::new(bvh, &mut memory), search, recorder),
            Pruning::Distance => traverse_pruned(PruningStack::<_, true>::new(bvh, &mut memory), search, recorder),
        };
        model.found
    }

    fn slab(&self, node: Node, side: Side) -> [f32; 2] {
        let aabb = self.bvh.node(node.index()).child_box(side);
        let (mut near, mut far) = (self.ray.tmin(), self.found.t);
        for k in 0..3 {
            let backward = self.inverse_near[k].is_sign_negative();
            let (first, second) = if backward { (aabb.hi[k], aabb.lo[k]) } else { (aabb.lo[k], aabb.hi[k]) };
            let near_k = (first - self.ray.origin()[k]) * self.inverse_near[k];
            let mut far_k = (second - self.ray.origin()[k]) * self.inverse_far[k];
            if self.parallel[k] && far_k >= 0.0 {
                far_k = END;
            }
            near = if near_k > near { near_k } else { near };
            far = if far_k < far { far_k } else { far };
        }
        [near, far]
    }

    fn slabs(&self, node: Node) -> [[f32; 2]; 2] {
        [Side::Left, Side::Right].map(|side| self.slab(node, side))
    }

    fn prefers_right(&self, [left, right]: [[f32; 2]; 2]) -> bool {
        !self.any && right[0] < left[0]
    }

    fn dot(&self, a: Vec3, b: Vec3) -> f32 {
        self.arithmetic.fma(a.x, b.x, self.arithmetic.fma(a.y, b.y, a.z * b.z))
    }

    fn cross(&self, a: Vec3, b: Vec3) -> Vec3 {
        let minor = |a0: f32, b1: f32, a1: f32, b0: f32| self.arithmetic.fma(a0, b1, -(a1 * b0));
        Vec3::new(minor(a.y, b.z, a.z, b.y), minor(a.z, b.x, a.x, b.z), minor(a.x, b.y, a.y, b.x))
    }

    fn meet(&mut self, Triangle([v0, v1, v2]): &Triangle, index: u32, leaf: Node) -> Flow {
        let (e1, e2, s) = (*v1 - *v0, *v2 - *v0, self.ray.origin() - *v0);
        let d = self.ray.direction();
        let (p, q) = (self.cross(d, e2), self.cross(s, e1));
        let det = self.dot(e1, p);
        let sign = if det < 0.0 { -1.0 } else { 1.0 };
        let (size, u, v) = (det * sign, self.dot(s, p) * sign, self.dot(d, q) * sign);
        if size > 0.0 && u >= 0.0 && v >= 0.0 && size - u - v >= 0.0 {
            // +0 for 0 of either sign.
            let divide = |a: f32, b: f32| if a == 0.0 { 0.0 } else { a / b };
            let t = divide(self.dot(e2, q), det);
            let best = &mut self.found;
            if t >= self.ray.tmin() && (t < best.t || t == best.t && index <= best.triangle) {
                *best = Found { triangle: index, t, weights: [divide(u, size), divide(v, size)] };
                self.leaf = Some(leaf);
                if self.any {
                    return Flow::Stop;
                }
            }
        }
        Flow::Continue
    }
}

impl Visitor for Model<'_> {
    fn inner(&mut self, node: Node) -> Descent {
        let slabs = self.slabs(node);
        let [left, right] = slabs.map(|[near, far]| near <= far);
        Descent::new(left, right, self.prefers_right(slabs))
    }

    fn leaf(&mut self, leaf: Node) -> Flow {
        let bvh = self.bvh;
        for held in bvh.leaf_triangles(leaf) {
            if self.meet(&held.shape, held.prim, leaf) == Flow::Stop {
                return Flow::Stop;
            }
        }
        Flow::Continue
    }
}

impl Pruned for Model<'_> {
    fn allows(&self, _: Pruning) -> bool {
        true
    }

    fn inner_marked(&mut self, node: Node) -> Descent {
        let slabs = self.slabs(node);
        let right = self.prefers_right(slabs);
        let [first, second] = if right { [slabs[1], slabs[0]] } else { slabs };
        self.inner(node).disjoint_if(first[1] < second[0])
    }

    fn found_at(&self, leaf: Node) -> bool {
        self.leaf == Some(leaf)
    }

    fn postponed(&self, node: Node, descent: Descent) -> u32 {
        let [near, _] = self.slab(node, descent.first().other());
        near.to_bits()
    }

    fn end(&self) -> u32 {
        self.found.t.to_bits()
    }
}
