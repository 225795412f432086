//! The filter for triangles that are not in blocks.

use glam::Vec3;

use super::{Baseline, Block, TriangleRay, baseline};
use crate::geom::kernel::Filter;
use crate::geom::{Ray, Region, Triangle};

/// The filter of [`TriangleRay`] for any four triangles, with the target's baseline instructions. `[LANES-3]`
/// `[LANES-4]`
///
/// ```
/// use stackless_bvh::glam::Vec3;
/// use stackless_bvh::internals::geom::kernel::Filter;
/// use stackless_bvh::internals::geom::lanes::TriangleFilter;
/// use stackless_bvh::geom::{Ray, Region, Triangle};
///
/// let triangle = Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
/// let beside = Triangle(triangle.0.map(|corner| corner + 2.0 * Vec3::X));
/// let region = Region::of(&triangle.aabb().union(beside.aabb()));
/// let filter = TriangleFilter::new(&Ray::new(Vec3::new(0.25, 0.25, -3.0), Vec3::Z)?, &region);
/// let shapes = [&triangle, &beside, &beside, &triangle];
/// assert_eq!(filter.survivors(shapes, f32::INFINITY), 0b1001);
/// assert_eq!(filter.survivors(shapes, 2.0), 0, "beyond the limit");
/// # Ok::<(), stackless_bvh::geom::RayError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct TriangleFilter(TriangleRay<Baseline>);

impl Filter<Vec3, Triangle> for TriangleFilter {
    /// On targets without vector instructions, it would take longer.
    const REJECTS: bool = cfg!(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2"));

    #[inline(always)]
    fn new(ray: &Ray, region: &Region) -> Self {
        Self(TriangleRay::new(baseline(), ray, region))
    }

    /// A separate function: inlined, it is not faster, and each traversal and search would have a copy.
    #[inline(never)]
    fn survivors(&self, shapes: [&Triangle; 4], limit: f32) -> u32 {
        let simd = baseline();
        self.0.survivors(simd, &Block::of(simd, shapes), limit)
    }
}
