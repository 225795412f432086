//! The ray queries of all tracers.

use crate::geom::EnvironmentError;
use crate::threads;

/// Queries of rays `R`: each for one ray, for a slice on this thread (`_each`), and for a slice on all threads
/// (`_parallel`). All three forms give equal answers.
///
/// [`Tracer`](super::Tracer) and [`BinaryTracer`](super::BinaryTracer) take a [`Ray`](crate::geom::Ray),
/// [`InstanceTracer`](super::InstanceTracer) an [`ExactRay`](crate::geom::ExactRay) as well.
///
/// ```
/// use stackless_bvh::generate::procedural;
/// use stackless_bvh::geom::Ray;
/// use stackless_bvh::trace::{BinaryTracer, RayQueries, Tracer};
///
/// /// Counts the rays that hit.
/// fn hits<T: RayQueries<Ray>>(tracer: &T, rays: &[Ray]) -> usize {
///     tracer.any_each(rays).into_iter().filter(|&hit| hit).count()
/// }
///
/// let mesh = procedural::soup(1, 2000);
/// let rays = procedural::rays(&mesh, 1, 300);
/// let tracer = Tracer::of(&mesh)?;
/// assert_eq!(hits(&tracer, &rays), hits(&BinaryTracer::of(&mesh)?, &rays));
/// assert_eq!(tracer.closest_each(&rays), tracer.closest_parallel(&rays)?);
/// assert_eq!(tracer.all(&rays[0]).first(), tracer.closest(&rays[0]).as_ref());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait RayQueries<R: Sync> {
    /// The intersection of a ray and a triangle.
    type Hit: Send;

    /// Finds the closest hit: the least exact distance, and of equal distances the least index. `[EXACT-1]`
    fn closest(&self, ray: &R) -> Option<Self::Hit>;

    /// Returns whether there is a hit.
    fn any(&self, ray: &R) -> bool;

    /// Finds any hit: the first hit of the traversal, which depends on the hierarchy.
    fn any_hit(&self, ray: &R) -> Option<Self::Hit>;

    /// Finds all hits, including those at edges and corners, each triangle once. They are in the order of exact
    /// distance and then of index.
    fn all(&self, ray: &R) -> Vec<Self::Hit>;

    /// Finds the [`closest`](Self::closest) hit of each ray, on this thread.
    fn closest_each(&self, rays: &[R]) -> Vec<Option<Self::Hit>> {
        rays.iter().map(|ray| self.closest(ray)).collect()
    }

    /// Returns for each ray whether there is [`any`](Self::any) hit, on this thread.
    fn any_each(&self, rays: &[R]) -> Vec<bool> {
        rays.iter().map(|ray| self.any(ray)).collect()
    }

    /// Finds [`any_hit`](Self::any_hit) of each ray, on this thread.
    fn any_hit_each(&self, rays: &[R]) -> Vec<Option<Self::Hit>> {
        rays.iter().map(|ray| self.any_hit(ray)).collect()
    }

    /// Finds [`all`](Self::all) hits of each ray, on this thread.
    fn all_each(&self, rays: &[R]) -> Vec<Vec<Self::Hit>> {
        rays.iter().map(|ray| self.all(ray)).collect()
    }

    /// Finds the [`closest`](Self::closest) hit of each ray, on all threads.
    ///
    /// # Errors
    /// [`EnvironmentError`] of any participating thread.
    fn closest_parallel(&self, rays: &[R]) -> Result<Vec<Option<Self::Hit>>, EnvironmentError>
    where
        Self: Sync,
    {
        in_parallel(rays, |rays| self.closest_each(rays))
    }

    /// Returns for each ray whether there is [`any`](Self::any) hit, on all threads.
    ///
    /// # Errors
    /// [`EnvironmentError`] of any participating thread.
    fn any_parallel(&self, rays: &[R]) -> Result<Vec<bool>, EnvironmentError>
    where
        Self: Sync,
    {
        in_parallel(rays, |rays| self.any_each(rays))
    }

    /// Finds [`any_hit`](Self::any_hit) of each ray, on all threads.
    ///
    /// # Errors
    /// [`EnvironmentError`] of any participating thread.
    fn any_hit_parallel(&self, rays: &[R]) -> Result<Vec<Option<Self::Hit>>, EnvironmentError>
    where
        Self: Sync,
    {
        in_parallel(rays, |rays| self.any_hit_each(rays))
    }

    /// Finds [`all`](Self::all) hits of each ray, on all threads.
    ///
    /// # Errors
    /// [`EnvironmentError`] of any participating thread.
    fn all_parallel(&self, rays: &[R]) -> Result<Vec<Vec<Self::Hit>>, EnvironmentError>
    where
        Self: Sync,
    {
        in_parallel(rays, |rays| self.all_each(rays))
    }
}

/// Number of items that a thread takes at a time.
pub(super) const CHUNK: usize = 256;

/// Answers slices of the items, on all threads.
pub(super) fn in_parallel<I: Sync, A: Send>(
    items: &[I],
    answer: impl Fn(&[I]) -> Vec<A> + Sync + Send,
) -> Result<Vec<A>, EnvironmentError> {
    let chunks: Vec<_> = items.chunks(CHUNK).collect();
    let answers = threads::guarded(|| threads::map(0..chunks.len(), 1, |i| answer(chunks[i])))?;
    Ok(answers.into_iter().flatten().collect())
}
