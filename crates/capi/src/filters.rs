//! Filters of the caller: masks, a face to skip, and a function.

use std::ffi::c_void;

use stackless_bvh::trace::{Filter as Chooses, Hit as Found, InstanceFilter, InstanceHit as Placed};

use crate::error::Fault;
use crate::memory::{In, shared};
use crate::types::{Filter, Hit, Ray};

/// The filters of an array of rays `Y`: one for each ray, one for all rays, or none. They skip an `S` and accept hits
/// `H`.
#[derive(Debug)]
pub(crate) struct Filters<'a, Y, S, H>(Option<In<'a, Filter<Y, S, H>>>);

/// The filters of rays of a scene.
pub(crate) type SceneFilters<'a, R> = Filters<'a, Ray<R>, u32, Hit<R>>;

// SAFETY: filters and their pointers are only read; the header requires functions that several threads may call.
unsafe impl<Y, S: Sync, H> Sync for Filters<'_, Y, S, H> {}

/// The filter of one ray.
#[derive(Debug)]
pub(crate) struct OneFilter<Y, S, H> {
    pub(crate) mask: u32,
    pub(crate) skip: Option<S>,
    call: Option<Call<Y, H>>,
}

/// A function of the caller, and its arguments.
#[derive(Debug)]
struct Call<Y, H> {
    accepts: unsafe extern "C" fn(*mut c_void, *const Y, *const H) -> bool,
    user: *mut c_void,
    ray: *const Y,
}

// SAFETY: the header requires a function that several threads may call, and this library does not read `ray`.
unsafe impl<Y, H> Sync for Call<Y, H> {}

impl<Y: Copy, S: Copy, H: Copy> Filters<'_, Y, S, H> {
    /// Filters that are `stride` bytes apart; with a stride of 0 one filter for all rays. `None` if the pointer is
    /// null.
    ///
    /// # Safety
    /// See [`In::new`]. Each `skip` is null, misaligned, or points to an `S`. Each `accepts` is null, or a function
    /// that meets the header's requirements with this `user`.
    pub(crate) unsafe fn new(first: *const Filter<Y, S, H>, stride: usize, count: usize) -> Result<Self, Fault> {
        if first.is_null() {
            return Ok(Self(None));
        }
        // SAFETY: the caller guarantees the requirements.
        let filters = unsafe {
            if stride == 0 { In::repeated("filter", first, count)? } else { In::new("filters", first, stride, count)? }
        };
        Ok(Self(Some(filters)))
    }

    pub(crate) const fn is_none(&self) -> bool {
        self.0.is_none()
    }

    /// The filter of the ray with this index.
    #[inline(always)]
    pub(crate) fn get(&self, index: usize, rays: &In<'_, Y>) -> Result<Option<OneFilter<Y, S, H>>, Fault> {
        self.0.as_ref().map(|filters| Self::one(filters, index, rays)).transpose()
    }

    fn one(filters: &In<'_, Filter<Y, S, H>>, index: usize, rays: &In<'_, Y>) -> Result<OneFilter<Y, S, H>, Fault> {
        let Filter { mask, skip, accepts, user } = filters.get(index);
        // SAFETY: `new` requires that the pointer is null, misaligned, or points to a value.
        let skip = if skip.is_null() { None } else { Some(*unsafe { shared(skip, "filter.skip") }?) };
        let ray = rays.pointer(index);
        Ok(OneFilter { mask, skip, call: accepts.map(|accepts| Call { accepts, user, ray }) })
    }
}

impl<R: Copy> OneFilter<Ray<R>, u32, Hit<R>> {
    /// Runs a query of a scene with the filter. `masks` are the masks of the faces; if empty, all bits are set.
    pub(crate) fn ask<A>(&self, masks: &[u32], query: impl FnOnce(Chooses<'_, R>) -> A) -> A {
        let is_seen = |face: u32| self.sees(masks, face) && self.skip != Some(face);
        match &self.call {
            None => query(Chooses::ALL.triangles(&is_seen)),
            Some(call) => query(
                Chooses::ALL
                    .triangles(&is_seen)
                    .hits(&|&Found { prim, t, u, v }| call.accepts(&Hit { t, u, v, face: prim })),
            ),
        }
    }
}

impl<Y, S, H> OneFilter<Y, S, H> {
    /// Whether the mask of a face and that of the filter have a bit in common. Without masks all bits are set.
    pub(crate) fn sees(&self, masks: &[u32], face: u32) -> bool {
        masks.get(face as usize).unwrap_or(&u32::MAX) & self.mask != 0
    }

    /// Runs a query of instances with the filter, for faces that `is_seen` accepts. `hit` converts a hit.
    pub(crate) fn ask_instances<R, A>(
        &self,
        is_seen: &(dyn Fn(&[u32], u32) -> bool + Sync),
        hit: fn(&Placed<R>) -> H,
        query: impl FnOnce(InstanceFilter<'_, R>) -> A,
    ) -> A {
        match &self.call {
            None => query(InstanceFilter::ALL.triangles(is_seen)),
            Some(call) => {
                query(InstanceFilter::ALL.triangles(is_seen).hits(&|found: &Placed<R>| call.accepts(&hit(found))))
            }
        }
    }
}

impl<Y, H> Call<Y, H> {
    fn accepts(&self, hit: &H) -> bool {
        // SAFETY: `Filters::new` requires a function that supports this call; ray and hit outlive the call.
        unsafe { (self.accepts)(self.user, self.ray, hit) }
    }
}
