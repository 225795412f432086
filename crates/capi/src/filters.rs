//! Filters of the caller: masks, a face to skip, and a function.

use std::ffi::c_void;

use stackless_bvh::trace::{Filter as Chooses, Hit as Found};

use crate::error::Fault;
use crate::memory::{In, shared};
use crate::types::{Filter, Hit, Ray};

/// The filters of an array of rays: one for each ray, one for all rays, or none.
#[derive(Debug)]
pub(crate) struct Filters<'a, R>(Option<In<'a, Filter<R>>>);

// SAFETY: filters and their pointers are only read; the header requires functions that several threads may call.
unsafe impl<R: Sync> Sync for Filters<'_, R> {}

/// The filter of one ray.
#[derive(Debug)]
pub(crate) struct OneFilter<R> {
    mask: u32,
    skip: Option<u32>,
    call: Option<Call<R>>,
}

/// A function of the caller, and its arguments.
#[derive(Debug)]
struct Call<R> {
    accepts: unsafe extern "C" fn(*mut c_void, *const Ray<R>, *const Hit<R>) -> bool,
    user: *mut c_void,
    ray: *const Ray<R>,
}

// SAFETY: the header requires a function that several threads may call, and `ray` is only read.
unsafe impl<R: Sync> Sync for Call<R> {}

impl<R: Copy> Filters<'_, R> {
    /// Filters that are `stride` bytes apart; with a stride of 0 one filter for all rays. `None` if the pointer is
    /// null.
    ///
    /// # Safety
    /// See [`In::new`]. Each `skip` is null, misaligned, or points to a number. Each `accepts` is null, or a function
    /// that meets the header's requirements with this `user`.
    pub(crate) unsafe fn new(first: *const Filter<R>, stride: usize, count: usize) -> Result<Self, Fault> {
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
    pub(crate) fn get(&self, index: usize, rays: &In<'_, Ray<R>>) -> Result<Option<OneFilter<R>>, Fault> {
        let Some(filters) = &self.0 else { return Ok(None) };
        let Filter { mask, skip, accepts, user } = filters.get(index);
        // SAFETY: `new` requires that the pointer is null, misaligned, or points to a number.
        let skip = if skip.is_null() { None } else { Some(*unsafe { shared(skip, "filter.skip") }?) };
        let ray = rays.pointer(index);
        Ok(Some(OneFilter { mask, skip, call: accepts.map(|accepts| Call { accepts, user, ray }) }))
    }
}

impl<R: Copy + Sync> OneFilter<R> {
    /// Runs a query with the filter. `masks` are the masks of the faces; if empty, all bits are set.
    pub(crate) fn ask<A>(&self, masks: &[u32], query: impl FnOnce(Chooses<'_, R>) -> A) -> A {
        let is_seen =
            |face: u32| masks.get(face as usize).is_none_or(|mask| mask & self.mask != 0) && self.skip != Some(face);
        match &self.call {
            None => query(Chooses::ALL.triangles(&is_seen)),
            Some(call) => query(Chooses::ALL.triangles(&is_seen).hits(&|hit| call.accepts(hit))),
        }
    }
}

impl<R: Copy> Call<R> {
    fn accepts(&self, &Found { prim, t, u, v }: &Found<R>) -> bool {
        let hit = Hit { t, u, v, face: prim };
        // SAFETY: `Filters::new` requires a function that supports this call; ray and hit outlive the call.
        unsafe { (self.accepts)(self.user, self.ray, &raw const hit) }
    }
}
