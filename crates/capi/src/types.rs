//! The structures and constants of the C interface.

use std::ffi::c_void;

/// The index that means no face, for a ray that misses.
pub const STACKLESS_NO_FACE: u32 = u32::MAX;

/// The greatest number of groups that contain each other: the length of a path.
pub const STACKLESS_MAX_LEVELS: usize = 8;

/// Build quality: a short build, and nearly the fastest queries.
pub const STACKLESS_QUALITY_STANDARD: u32 = 0;
/// Build quality: a long build.
pub const STACKLESS_QUALITY_HIGH: u32 = 1;
/// Build quality: a long build, with long and thin triangles split between leaves. It takes more memory.
pub const STACKLESS_QUALITY_SPATIAL: u32 = 2;

/// The calling thread answers a batch.
pub const STACKLESS_SERIAL: u32 = 0;
/// The threads of the scene answer a batch, with equal answers.
pub const STACKLESS_PARALLEL: u32 = 1;

/// Points with an odd number of crossings are inside. The mesh must be closed.
pub const STACKLESS_RULE_PARITY: u32 = 0;
/// Points with a winding number other than 0 are inside. The mesh must be closed and oriented. Overlapping parts unite.
pub const STACKLESS_RULE_NONZERO: u32 = 1;
/// Points with a winding number above 1/2 are inside. Any mesh is suitable; near holes the result is a good guess.
pub const STACKLESS_RULE_WINDING: u32 = 2;

/// The point is outside.
pub const STACKLESS_OUTSIDE: u8 = 0;
/// The point is inside.
pub const STACKLESS_INSIDE: u8 = 1;
/// The point is on a face, exactly.
pub const STACKLESS_SURFACE: u8 = 2;

/// Options of a scene. All zeros are the defaults.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct Options {
    /// One of `STACKLESS_QUALITY_...`.
    pub quality: u32,
    /// Number of threads for the build and for parallel batches; 0 for one per processor, shared by all scenes.
    pub threads: u32,
}

/// The points `origin + t * direction` with `tmin <= t <= tmax`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Ray<R> {
    /// Finite.
    pub origin: [R; 3],
    /// The minimum distance of a hit, at least 0.
    pub tmin: R,
    /// Finite, nonzero. It need not have length 1.
    pub direction: [R; 3],
    /// The maximum distance of a hit, at least `tmin`. May be infinite.
    pub tmax: R,
}

/// A filter for hits. A query finds the first accepted hit. Masked and skipped faces are not tested.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Filter<Y, S, H> {
    /// Hits of a face are accepted if its mask and this mask have a bit in common. In a new scene the masks of all
    /// faces have all bits set.
    pub mask: u32,
    /// The index of a face whose hits are not accepted; for instances, a hit of this face. May be null.
    pub skip: *const S,
    /// Returns whether a hit is accepted, for example for transparency or for sides of faces. May be null. `ray` is the
    /// ray of the call, at the program's address. The function must always return the same value for a hit. It is
    /// called in no particular order, possibly several times for one face, and by several threads at once in parallel
    /// batches. It must return: it must neither throw an exception nor jump. It may run queries.
    pub accepts: Option<unsafe extern "C" fn(user: *mut c_void, ray: *const Y, hit: *const H) -> bool>,
    /// Passed to `accepts`.
    pub user: *mut c_void,
}

/// The hit of a ray with a face.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Hit<R> {
    /// Distance in lengths of the direction; infinite for a miss.
    pub t: R,
    /// Weight of the face's second vertex; NaN for a miss.
    pub u: R,
    /// Weight of the face's third vertex; NaN for a miss.
    pub v: R,
    /// Index of the face; `STACKLESS_NO_FACE` for a miss.
    pub face: u32,
}

/// The hit of a ray with a face of an instance.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct InstanceHit<R> {
    /// Distance in lengths of the direction; infinite for a miss.
    pub t: R,
    /// Weight of the face's second vertex; NaN for a miss.
    pub u: R,
    /// Weight of the face's third vertex; NaN for a miss.
    pub v: R,
    /// Index of the face in its scene; `STACKLESS_NO_FACE` for a miss.
    pub face: u32,
    /// Number of groups that contain the face; 0 for a miss.
    pub levels: u32,
    /// The index of the instance in each of these groups, outermost first. The other numbers are `UINT32_MAX`.
    pub path: [u32; STACKLESS_MAX_LEVELS],
}

/// The nearest point of the mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Near<R> {
    /// Its coordinates; NaN if there is none.
    pub point: [R; 3],
    /// Its distance; infinite if there is none.
    pub distance: R,
    /// Index of its face; `STACKLESS_NO_FACE` if there is none.
    pub face: u32,
}
