//! Queries of exact rays: reads the rays, whose points are pointers, and writes the points of their hits.

use std::ptr;

use stackless_bvh::geom::Precision;

use crate::error::Fault;
use crate::exact::{Exact, ExactRay, Point, Way};
use crate::filters::Filters;
use crate::memory::{In, Out, room, shared};
use crate::queries::Real;

/// Exact rays in the format of C.
type Rays<'a, V> = In<'a, ExactRay<Real<V>, V>>;

/// The filters of exact rays of a scene or of instances.
type WayFilters<'a, V, T> = Filters<'a, ExactRay<Real<V>, V>, <T as Exact<V>>::Skip, <T as Exact<V>>::Hit>;

/// Pointers to points that are made for the caller, if it wants them.
pub(crate) struct Points<'a, V: Precision>(Option<Out<'a, *mut Point<V>>>);

impl<'a, V: Precision> Points<'a, V> {
    /// Makes all pointers of the caller's array null, so that they are null after an error. The caller does not want
    /// the points if `first` is null; otherwise `array` checks the array.
    pub(crate) fn null<A>(first: *mut *mut Point<V>, array: A) -> Result<Self, Fault>
    where
        A: FnOnce(*mut *mut Point<V>) -> Result<Out<'a, *mut Point<V>>, Fault>,
    {
        if first.is_null() {
            return Ok(Self(None));
        }
        let mut points = array(first)?;
        for index in 0..points.count() {
            points.set(index, ptr::null_mut());
        }
        Ok(Self(Some(points)))
    }

    fn set(&mut self, index: usize, point: Option<Point<V>>) {
        if let (Some(points), Some(point)) = (&mut self.0, point) {
            points.set(index, boxed(point));
        }
    }
}

/// Finds the closest hit of each ray, with its point on request.
///
/// # Safety
/// See [`way`].
pub(crate) unsafe fn closest<V: Precision, T: Exact<V>>(
    object: &T,
    rays: &Rays<'_, V>,
    filters: &WayFilters<'_, V, T>,
    mut hits: Out<'_, T::Hit>,
    mut points: Points<'_, V>,
    flags: u32,
) -> Result<(), Fault> {
    // SAFETY: the caller guarantees the requirements.
    let ways = unsafe { ways(rays, filters) }?;
    for (index, (hit, point)) in object.exact_closest(&ways, points.0.is_some(), flags)?.into_iter().enumerate() {
        hits.set(index, hit);
        points.set(index, point);
    }
    Ok(())
}

/// Finds whether each ray has a hit.
///
/// # Safety
/// See [`way`].
pub(crate) unsafe fn any<V: Precision, T: Exact<V>>(
    object: &T,
    rays: &Rays<'_, V>,
    filters: &WayFilters<'_, V, T>,
    mut is_hit: Out<'_, bool>,
    flags: u32,
) -> Result<(), Fault> {
    // SAFETY: the caller guarantees the requirements.
    is_hit.fill(&object.exact_any(&unsafe { ways(rays, filters) }?, flags)?);
    Ok(())
}

/// Reads all rays.
///
/// # Safety
/// See [`way`].
unsafe fn ways<'a, V: Precision, S: Copy, H: Copy>(
    rays: &Rays<'a, V>,
    filters: &Filters<'_, ExactRay<Real<V>, V>, S, H>,
) -> Result<Vec<Way<'a, V, S, H>>, Fault> {
    let mut ways = room(rays.count())?;
    for index in 0..rays.count() {
        // SAFETY: the caller guarantees the requirements.
        ways.push(unsafe { way(rays, filters, index) }?);
    }
    Ok(ways)
}

/// Reads an exact ray of an array, and its filter.
///
/// # Safety
/// See [`shared`], for the points of the rays.
unsafe fn way<'a, V: Precision, S: Copy, H: Copy>(
    rays: &Rays<'a, V>,
    filters: &Filters<'_, ExactRay<Real<V>, V>, S, H>,
    index: usize,
) -> Result<Way<'a, V, S, H>, Fault> {
    let (element, filter) = (rays.element(index), filters.get(index, rays)?);
    let ExactRay { origin, target, direction, tmax, is_closed } = rays.get(index);
    // SAFETY: the caller guarantees the requirements.
    let (origin, target) = unsafe {
        let point = |point, name| shared(point, name).map_err(|fault| fault.within(element));
        (point(origin, "origin")?, if target.is_null() { None } else { Some(point(target, "target")?) })
    };
    Ok(Way { origin, target, direction, tmax, is_closed, filter, element })
}

/// Returns a pointer for the caller, who frees it.
pub(crate) fn boxed<V: Precision>(point: Point<V>) -> *mut Point<V> {
    Box::into_raw(Box::new(point))
}
