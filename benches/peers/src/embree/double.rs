//! Embree's boxes in single precision around triangles that are tested in double precision.
//!
//! double-down uses this method for particle transport (github.com/pshriwise/double-down,
//! `docs/methodology/implementation.rst`). Triangles are user geometry. Their boxes are enlarged by √3 d 10⁻⁶, where d
//! is the longest path through the scene, here its diagonal. The test uses Plücker coordinates (Platis & Theoharis
//! 2003); two neighbours compute their common edge with equal results.
#![allow(
    clippy::cast_possible_truncation,
    reason = "Embree has triangles by 32 bits, and boxes and distances in single precision"
)]

use std::ffi::{c_int, c_uint, c_void};

use super::{Arguments, Context, Kind, NONE, RayHit, RayPart, Scene};
use crate::{Hit, PeerError, Ray, Tracer, each};

type Point = [f64; 3];

/// A committed scene, and the data of its callbacks.
pub(crate) struct DoubleScene {
    scene: Scene,
    /// Embree keeps its address. It is dropped after the scene.
    _triangles: Box<Triangles>,
}

struct Triangles {
    corners: Vec<[Point; 3]>,
    /// Enlarges boxes on each side.
    margin: f64,
}

const USER: c_int = 120;

/// `RTCBoundsFunctionArguments`.
#[repr(C)]
pub(super) struct BoundsArguments {
    user: *const c_void,
    prim: c_uint,
    time: c_uint,
    /// `RTCBounds`: a lower and an upper corner, each with an unused number.
    bounds: *mut [[f32; 4]; 2],
}

/// `RTCIntersectFunctionNArguments`, or with an `RTCRay`, `RTCOccludedFunctionNArguments`.
#[repr(C)]
pub(super) struct RayArguments<R> {
    valid: *mut c_int,
    user: *const c_void,
    prim: c_uint,
    /// The `RTCRayQueryContext` of the call.
    context: *mut c_void,
    ray: *mut R,
    count: c_uint,
    geometry: c_uint,
}

#[cfg(target_pointer_width = "64")]
const _: () = assert!(size_of::<BoundsArguments>() == 24 && size_of::<RayArguments<RayHit>>() == 48);

pub(super) type Bounds = unsafe extern "C" fn(*const BoundsArguments);
pub(super) type Callback<R> = unsafe extern "C" fn(*const RayArguments<R>);

/// The ray in double precision, for the callbacks. `tmax` is the distance of the nearest hit.
#[repr(C)]
struct DoubleContext {
    context: Context,
    origin: Point,
    direction: Point,
    /// direction × origin.
    moment: Point,
    tmin: f64,
    tmax: f64,
}

impl DoubleScene {
    pub(crate) fn new(corners: Vec<[Point; 3]>) -> Result<Self, PeerError> {
        let [mut lo, mut hi] = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for corner in corners.as_flattened() {
            (lo, hi) = (each_axis(|k| lo[k].min(corner[k])), each_axis(|k| hi[k].max(corner[k])));
        }
        let across = minus(hi, lo);
        let length = if corners.is_empty() { 0.0 } else { dot(across, across).sqrt() };
        let triangles = Box::new(Triangles { corners, margin: 3.0_f64.sqrt() * length * 1e-6 });
        let scene = Scene::of(USER, 0, Kind::Robust, |&Scene { geometry, api, .. }| {
            let address = (&raw const *triangles).cast::<c_void>().cast_mut();
            // SAFETY: the geometry is a user geometry. The triangles are not moved or changed until the scene is
            // dropped. The callbacks have the signatures of the headers.
            unsafe {
                (api.set_count)(geometry, triangles.corners.len() as c_uint);
                (api.set_user_data)(geometry, address);
                (api.set_bounds)(geometry, bounds, std::ptr::null_mut());
                (api.set_intersect)(geometry, closest);
                (api.set_occluded)(geometry, any);
            }
            true
        })?;
        Ok(Self { scene, _triangles: triangles })
    }
}

impl Tracer for DoubleScene {
    fn closest(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        each(rays, hits, |ray| {
            let (mut context, mut hit) = (DoubleContext::new(ray), RayHit::new(ray));
            let mut arguments = Arguments::new((&raw mut context).cast());
            // SAFETY: see `Scene`. The context is the first field of a `DoubleContext`, which the callbacks expect.
            unsafe { (self.scene.api.intersect)(self.scene.handle, &raw mut hit, &raw mut arguments) };
            (hit.geometry != NONE).then_some((hit.prim, context.tmax as f32))
        });
    }

    fn any(&self, rays: &[Ray], hits: &mut [bool]) {
        each(rays, hits, |ray| {
            let (mut context, mut part) = (DoubleContext::new(ray), RayPart::new(ray));
            let mut arguments = Arguments::new((&raw mut context).cast());
            // SAFETY: see `closest`.
            unsafe { (self.scene.api.occluded)(self.scene.handle, &raw mut part, &raw mut arguments) };
            part.tfar == f32::NEG_INFINITY
        });
    }
}

impl DoubleContext {
    #[inline]
    fn new(ray: &Ray) -> Self {
        let [origin, direction] = [ray.origin, ray.direction].map(|v| v.map(f64::from));
        let [tmin, tmax] = [ray.tmin, ray.tmax].map(f64::from);
        Self { context: Context::NONE, origin, direction, moment: cross(direction, origin), tmin, tmax }
    }

    /// The distance of a triangle that the ray hits up to `tmax`.
    #[inline]
    fn distance(&self, [a, b, c]: [Point; 3]) -> Option<f64> {
        let weights = [self.side(b, c), self.side(c, a), self.side(a, b)];
        let is_met = weights.iter().all(|&w| w >= 0.0) || weights.iter().all(|&w| w <= 0.0);
        let sum = weights[0] + weights[1] + weights[2];
        if !is_met || sum == 0.0 {
            return None;
        }
        // Uses the axis with the greatest component of the direction.
        let k = (0..3).max_by(|&i, &j| self.direction[i].abs().total_cmp(&self.direction[j].abs())).unwrap_or(0);
        let at = (weights[0] * a[k] + weights[1] * b[k] + weights[2] * c[k]) / sum;
        let t = (at - self.origin[k]) / self.direction[k];
        (self.tmin <= t && t <= self.tmax).then_some(t)
    }

    /// The side of an edge on which the ray passes. The end points are ordered, so two triangles compute one number,
    /// with opposite signs.
    #[inline]
    fn side(&self, a: Point, b: Point) -> f64 {
        let is_turned = b < a;
        let [a, b] = if is_turned { [b, a] } else { [a, b] };
        let edge = minus(b, a);
        let side = dot(self.direction, cross(edge, a)) + dot(self.moment, edge);
        if is_turned { -side } else { side }
    }
}

/// The box of a triangle.
unsafe extern "C" fn bounds(arguments: *const BoundsArguments) {
    // SAFETY: Embree passes arguments with the triangles of the constructor.
    let (arguments, Triangles { corners, margin }) = unsafe { (&*arguments, &*(*arguments).user.cast::<Triangles>()) };
    let Some([a, b, c]) = corners.get(arguments.prim as usize) else { return };
    let lo = each_axis(|k| a[k].min(b[k]).min(c[k]) - margin);
    let hi = each_axis(|k| a[k].max(b[k]).max(c[k]) + margin);
    // Rounding errors are far smaller than the margin, unless the margin is 0.
    let [lo, hi] = [lo.map(|x| (x as f32).next_down()), hi.map(|x| (x as f32).next_up())];
    // SAFETY: there is space for a box.
    unsafe { *arguments.bounds = [[lo[0], lo[1], lo[2], 0.0], [hi[0], hi[1], hi[2], 0.0]] };
}

/// Records the hit if it is nearer than the previous hit.
unsafe extern "C" fn closest(arguments: *const RayArguments<RayHit>) {
    // SAFETY: see `found`; the ray is an `RTCRayHit`.
    unsafe {
        if let Some(t) = found(arguments) {
            let RayArguments { context, ray, prim, geometry, .. } = *arguments;
            (*context.cast::<DoubleContext>()).tmax = t;
            // Boxes that begin at this distance are still entered.
            (*ray).ray.tfar = (t as f32).next_up();
            ((*ray).prim, (*ray).geometry) = (prim, geometry);
        }
    }
}

/// Records whether there is a hit.
unsafe extern "C" fn any(arguments: *const RayArguments<RayPart>) {
    // SAFETY: see `found`.
    unsafe {
        if found(arguments).is_some() {
            (*(*arguments).ray).tfar = f32::NEG_INFINITY;
        }
    }
}

/// The distance of the triangle in the arguments.
///
/// # Safety
/// The arguments must be Embree's, for one ray of [`DoubleScene`].
#[inline]
unsafe fn found<R>(arguments: *const RayArguments<R>) -> Option<f64> {
    // SAFETY: rays are traced one by one, with a `DoubleContext`. No other references to it exist, and the triangles
    // are not changed.
    unsafe {
        let RayArguments { valid, user, prim, context, count, .. } = &*arguments;
        debug_assert_eq!(*count, 1);
        if **valid == 0 {
            return None;
        }
        let triangle = (&*user.cast::<Triangles>()).corners.get(*prim as usize)?;
        (&*context.cast::<DoubleContext>()).distance(*triangle)
    }
}

#[inline]
fn each_axis(component: impl Fn(usize) -> f64) -> Point {
    [component(0), component(1), component(2)]
}

#[inline]
fn minus(a: Point, b: Point) -> Point {
    each_axis(|k| a[k] - b[k])
}

#[inline]
fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
