//! Embree 4 through its C library, which is loaded on first use: the file named by `EMBREE_LIBRARY`, or the installed
//! library.
//!
//! Scenes are static, with medium build quality, and with or without the flag for robust tests; or dynamic and
//! refitted. Rays are traced one by one, like those of other peers. [`DoubleScene`] tests triangles in double
//! precision. Embree's manual recommends flushing denormal numbers. This module does not flush them, because that would
//! change the results of exact tests in the thread.
//!
//! # Safety
//!
//! Only this module and its submodule have `unsafe`. The code relies on these facts:
//! - The types and declarations of functions are those of the headers of Embree 4.4. The device's version is checked,
//!   because older versions have smaller hits. The compiler checks the sizes.
//! - The library is never unloaded, because its thread-local data is cleared when a thread ends. So its functions exist
//!   until the program ends.
//! - [`Scene`] releases its handles once, on drop. It is neither `Send` nor `Sync`, so it stays on its thread.
//! - Embree owns the buffers, which have the size of the written items. Indices are checked before.
//! - A ray and its hit are on the stack, with the alignment of Embree's types, and outlive the call.
#![allow(unsafe_code)]

mod double;

use std::ffi::{c_char, c_int, c_uint, c_void};
use std::sync::OnceLock;
use std::{env, ptr};

use libloading::Library;

pub(crate) use double::DoubleScene;
use double::{Bounds, Callback};

use crate::{Hit, PeerError, Ray, Tracer, each};

/// A committed scene of one mesh.
pub(crate) struct Scene {
    device: Handle,
    handle: Handle,
    /// Owned by the scene.
    geometry: Handle,
    vertices: usize,
    api: &'static Api,
}

type Handle = *mut c_void;

/// `RTCRayHit`, whose first part is an `RTCRay`.
#[repr(C, align(16))]
struct RayHit {
    ray: RayPart,
    normal: [f32; 3],
    weights: [f32; 2],
    prim: c_uint,
    geometry: c_uint,
    instance: c_uint,
    instance_prim: c_uint,
}

/// `RTCRay`.
#[repr(C, align(16))]
struct RayPart {
    origin: [f32; 3],
    tnear: f32,
    direction: [f32; 3],
    time: f32,
    tfar: f32,
    mask: c_uint,
    id: c_uint,
    flags: c_uint,
}

const _: () = assert!(size_of::<RayPart>() == 48 && size_of::<RayHit>() == 96);

/// `RTCRayQueryContext`.
#[repr(C)]
struct Context {
    instance: c_uint,
    instance_prim: c_uint,
}

/// `RTCIntersectArguments` and `RTCOccludedArguments`.
#[repr(C)]
struct Arguments {
    flags: c_int,
    features: c_uint,
    context: *mut Context,
    filter: *const c_void,
    callback: *const c_void,
}

const SONAME: &str = "libembree4.so.4";
/// The version, as 10000 major + 100 minor + patch, from which on the types are those of this module.
const OLDEST: isize = 40_400;
const VERSION: c_int = 0;
const NONE: c_uint = c_uint::MAX;
const TRIANGLES: c_int = 0;
const INDEX_BUFFER: c_int = 0;
const VERTEX_BUFFER: c_int = 1;
const UINT3: c_int = 0x5003;
const FLOAT3: c_int = 0x9003;
const LOW: c_int = 0;
const REFIT: c_int = 3;

/// A kind of scene, with its flags for `rtcSetSceneFlags`.
#[derive(Clone, Copy, PartialEq, Eq)]
#[repr(i32)]
pub(crate) enum Kind {
    Plain = 0,
    /// The vertices move, and the scene is refitted.
    Moving = 1,
    Robust = 1 << 2,
}

/// Declares the functions, and loads them.
macro_rules! api {
    ($($field:ident: $symbol:literal fn($($argument:ty),*) $(-> $result:ty)?;)*) => {
        struct Api {
            $($field: unsafe extern "C" fn($($argument),*) $(-> $result)?,)*
            _library: Library,
        }

        impl Api {
            fn load() -> Result<&'static Self, PeerError> {
                static API: OnceLock<Result<Api, PeerError>> = OnceLock::new();
                API.get_or_init(Self::find).as_ref().map_err(Clone::clone)
            }

            fn find() -> Result<Self, PeerError> {
                let name = env::var_os("EMBREE_LIBRARY").unwrap_or_else(|| SONAME.into());
                let missing = |error| PeerError::NotInstalled(format!("{}: {error}", name.display()));
                // SAFETY: Embree's initialisers have no side effects on this program.
                let library = unsafe { Library::new(&name) }.map_err(missing)?;
                Ok(Self {
                    // SAFETY: the declarations are those of the headers, and the library is never unloaded.
                    $($field: *unsafe { library.get(concat!($symbol, "\0").as_bytes()) }.map_err(missing)?,)*
                    _library: library,
                })
            }
        }
    };
}

api! {
    new_device: "rtcNewDevice" fn(*const c_char) -> Handle;
    release_device: "rtcReleaseDevice" fn(Handle);
    get_property: "rtcGetDeviceProperty" fn(Handle, c_int) -> isize;
    device_error: "rtcGetDeviceError" fn(Handle) -> c_int;
    new_scene: "rtcNewScene" fn(Handle) -> Handle;
    set_scene_flags: "rtcSetSceneFlags" fn(Handle, c_int);
    release_scene: "rtcReleaseScene" fn(Handle);
    commit_scene: "rtcCommitScene" fn(Handle);
    new_geometry: "rtcNewGeometry" fn(Handle, c_int) -> Handle;
    new_buffer: "rtcSetNewGeometryBuffer" fn(Handle, c_int, c_uint, c_int, usize, usize) -> *mut c_void;
    set_scene_quality: "rtcSetSceneBuildQuality" fn(Handle, c_int);
    set_quality: "rtcSetGeometryBuildQuality" fn(Handle, c_int);
    get_buffer: "rtcGetGeometryBufferData" fn(Handle, c_int, c_uint) -> *mut c_void;
    update_buffer: "rtcUpdateGeometryBuffer" fn(Handle, c_int, c_uint);
    commit_geometry: "rtcCommitGeometry" fn(Handle);
    attach_geometry: "rtcAttachGeometry" fn(Handle, Handle) -> c_uint;
    release_geometry: "rtcReleaseGeometry" fn(Handle);
    intersect: "rtcIntersect1" fn(Handle, *mut RayHit, *mut Arguments);
    occluded: "rtcOccluded1" fn(Handle, *mut RayPart, *mut Arguments);
    set_count: "rtcSetGeometryUserPrimitiveCount" fn(Handle, c_uint);
    set_user_data: "rtcSetGeometryUserData" fn(Handle, *mut c_void);
    set_bounds: "rtcSetGeometryBoundsFunction" fn(Handle, Bounds, *mut c_void);
    set_intersect: "rtcSetGeometryIntersectFunction" fn(Handle, Callback<RayHit>);
    set_occluded: "rtcSetGeometryOccludedFunction" fn(Handle, Callback<RayPart>);
}

impl Scene {
    /// All indices must be valid.
    pub(crate) fn new(vertices: &[[f32; 3]], triangles: &[[u32; 3]], kind: Kind) -> Result<Self, PeerError> {
        Self::of(TRIANGLES, vertices.len(), kind, |scene| {
            scene.fill(VERTEX_BUFFER, FLOAT3, vertices) && scene.fill(INDEX_BUFFER, UINT3, triangles)
        })
    }

    /// Creates a scene of one geometry. `fill` describes the geometry, and returns whether there is enough memory.
    fn of(shape: c_int, vertices: usize, kind: Kind, fill: impl FnOnce(&Self) -> bool) -> Result<Self, PeerError> {
        let api = Api::load()?;
        // SAFETY: the text ends with a zero.
        let device = unsafe { (api.new_device)(c"threads=1".as_ptr()) };
        if device.is_null() {
            return Err(PeerError::Refused("Embree has no device for this processor".to_owned()));
        }
        // SAFETY: the device is valid, and not used after its release.
        let version = unsafe { (api.get_property)(device, VERSION) };
        if version < OLDEST {
            // SAFETY: see above.
            unsafe { (api.release_device)(device) };
            return Err(PeerError::Refused(format!("Embree has version {version}, expected {OLDEST} or newer")));
        }
        // SAFETY: the device is valid.
        let (handle, geometry) = unsafe { ((api.new_scene)(device), (api.new_geometry)(device, shape)) };
        let this = Self { device, handle, geometry, vertices, api };
        let Api { set_scene_flags, set_scene_quality, set_quality, commit_geometry, attach_geometry, .. } = *api;
        let Api { release_geometry, commit_scene, device_error, .. } = *api;
        // SAFETY: device, scene and geometry come from their constructors. The scene keeps the geometry after its
        // release here.
        let written = unsafe {
            set_scene_flags(handle, kind as c_int);
            let written = fill(&this);
            if written {
                if kind == Kind::Moving {
                    // These qualities give the geometry its own tree, which can be refitted.
                    set_scene_quality(handle, LOW);
                    set_quality(geometry, REFIT);
                }
                commit_geometry(geometry);
                attach_geometry(handle, geometry);
                commit_scene(handle);
            }
            release_geometry(geometry);
            written
        };
        // SAFETY: the device is valid.
        match unsafe { device_error(device) } {
            0 if written => Ok(this),
            error => Err(PeerError::Refused(format!("Embree's error {error}"))),
        }
    }

    /// Moves the vertices. Their number must not change.
    pub(crate) fn refit(&mut self, vertices: &[[f32; 3]]) -> Result<(), PeerError> {
        if vertices.len() != self.vertices {
            return Err(PeerError::Refused(format!("{} vertices, expected {}", vertices.len(), self.vertices)));
        }
        let Api { get_buffer, update_buffer, commit_geometry, commit_scene, device_error, .. } = *self.api;
        // SAFETY: the scene keeps the geometry, whose buffer has space for `self.vertices`. `self` is borrowed mutably,
        // so no ray is traced meanwhile.
        let error = unsafe {
            let buffer = get_buffer(self.geometry, VERTEX_BUFFER, 0);
            ptr::copy_nonoverlapping(vertices.as_ptr(), buffer.cast(), vertices.len());
            update_buffer(self.geometry, VERTEX_BUFFER, 0);
            commit_geometry(self.geometry);
            commit_scene(self.handle);
            device_error(self.device)
        };
        if error == 0 { Ok(()) } else { Err(PeerError::Refused(format!("Embree's error {error}"))) }
    }

    /// Creates a buffer of the geometry with these items. Returns `false` without memory.
    fn fill<T: Copy>(&self, kind: c_int, format: c_int, items: &[[T; 3]]) -> bool {
        // SAFETY: the geometry is valid. The new buffer has space for the items, with their alignment (4 bytes), and no
        // other references exist.
        unsafe {
            let buffer = (self.api.new_buffer)(self.geometry, kind, 0, format, size_of::<[T; 3]>(), items.len());
            if !buffer.is_null() {
                ptr::copy_nonoverlapping(items.as_ptr(), buffer.cast(), items.len());
            }
            !buffer.is_null()
        }
    }
}

impl Drop for Scene {
    fn drop(&mut self) {
        // SAFETY: scene and device come from their constructors, and are released once.
        unsafe {
            (self.api.release_scene)(self.handle);
            (self.api.release_device)(self.device);
        }
    }
}

impl Tracer for Scene {
    fn closest(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        let mut context = Context::NONE;
        let mut arguments = Arguments::new(&raw mut context);
        each(rays, hits, |ray| {
            let mut hit = RayHit::new(ray);
            // SAFETY: the scene is committed; all are initialised, aligned, and owned by this function.
            unsafe { (self.api.intersect)(self.handle, &raw mut hit, &raw mut arguments) };
            (hit.geometry != NONE).then_some((hit.prim, hit.ray.tfar))
        });
    }

    fn any(&self, rays: &[Ray], hits: &mut [bool]) {
        let mut context = Context::NONE;
        let mut arguments = Arguments::new(&raw mut context);
        each(rays, hits, |ray| {
            let mut ray = RayPart::new(ray);
            // SAFETY: see `closest`.
            unsafe { (self.api.occluded)(self.handle, &raw mut ray, &raw mut arguments) };
            ray.tfar == f32::NEG_INFINITY
        });
    }
}

impl Context {
    /// The result of `rtcInitRayQueryContext`.
    const NONE: Self = Self { instance: NONE, instance_prim: NONE };
}

impl Arguments {
    /// The result of `rtcInitIntersectArguments`, with all features, and a context.
    const fn new(context: *mut Context) -> Self {
        Self { flags: 0, features: c_uint::MAX, context, filter: ptr::null(), callback: ptr::null() }
    }
}

impl RayHit {
    #[inline]
    fn new(ray: &Ray) -> Self {
        let ray = RayPart::new(ray);
        Self {
            ray,
            normal: [0.0; 3],
            weights: [0.0; 2],
            prim: NONE,
            geometry: NONE,
            instance: NONE,
            instance_prim: NONE,
        }
    }
}

impl RayPart {
    #[inline]
    fn new(ray: &Ray) -> Self {
        let Ray { origin, direction, tmin, tmax } = *ray;
        Self { origin, tnear: tmin, direction, time: 0.0, tfar: tmax, mask: NONE, id: 0, flags: 0 }
    }
}
