//! The structures and constants that C sees.

use std::ffi::c_void;

use stackless_bvh::geom::lanes::Precision;

use crate::exact::Point;

/// The index of no face: that of a ray that misses.
pub const STACKLESS_NO_FACE: u32 = u32::MAX;

/// How much time a build may take: a moderate time, and nearly the fastest queries.
pub const STACKLESS_QUALITY_STANDARD: u32 = 0;
/// A shorter build, and slower queries.
pub const STACKLESS_QUALITY_FAST: u32 = 1;
/// A longer build.
pub const STACKLESS_QUALITY_HIGH: u32 = 2;
/// As standard, with triangles split between leaves where they are long and thin. It takes more memory.
pub const STACKLESS_QUALITY_SPATIAL: u32 = 3;

/// A batch is answered by the calling thread.
pub const STACKLESS_SERIAL: u32 = 0;
/// A batch is answered by the threads of the scene. The answers are the same.
pub const STACKLESS_PARALLEL: u32 = 1;

/// Points with an odd number of crossings are inside. The mesh must be closed.
pub const STACKLESS_RULE_PARITY: u32 = 0;
/// Points with a winding number other than 0 are inside. The mesh must be closed and oriented. Overlapping parts unite.
pub const STACKLESS_RULE_NONZERO: u32 = 1;
/// Points with a winding number above 1/2 are inside. Any mesh will do: where it has holes this is a good guess.
pub const STACKLESS_RULE_WINDING: u32 = 2;

/// The point is outside.
pub const STACKLESS_OUTSIDE: u8 = 0;
/// The point is inside.
pub const STACKLESS_INSIDE: u8 = 1;
/// The point is on a face, exactly.
pub const STACKLESS_SURFACE: u8 = 2;

/// How a scene is built. All zeros are the defaults.
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
    /// The least distance of a hit, at least 0.
    pub tmin: R,
    /// Finite, and not zero. It need not have length 1.
    pub direction: [R; 3],
    /// The greatest distance of a hit, at least `tmin`. May be infinite.
    pub tmax: R,
}

/// The hits of a ray that count. A query finds the first of these. Faces that are masked or skipped are not tested.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Filter<R> {
    /// Hits of a face count if its mask and this one have a bit in common. All bits are set in the masks of a new scene.
    pub mask: u32,
    /// The index of a face whose hits do not count. May be null.
    pub skip: *const u32,
    /// Returns whether a hit counts: for transparency, and for the sides of faces. May be null. `ray` is that of the call,
    /// where the program has it. The function must always return the same for a hit. It is called in no particular order,
    /// perhaps several times for one face, and by several threads at once in parallel batches. It must return: it must
    /// neither throw an exception nor jump. It may query scenes.
    pub accepts: Option<unsafe extern "C" fn(user: *mut c_void, ray: *const Ray<R>, hit: *const Hit<R>) -> bool>,
    /// Passed to `accepts`.
    pub user: *mut c_void,
}

/// A ray that begins at an exact point, such as that of a hit.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ExactRay<R, V: Precision> {
    /// Where it begins.
    pub origin: *const Point<V>,
    /// Where it ends, at t = 1. May be null: then the ray has this direction and this end.
    pub target: *const Point<V>,
    /// Finite, and not zero.
    pub direction: [R; 3],
    /// The greatest distance of a hit, at least 0. May be infinite.
    pub tmax: R,
    /// Whether the ends count. If not, hits have 0 < t < tmax: the face that the ray leaves is not hit, nor any other face
    /// that contains the origin.
    pub is_closed: bool,
}

/// Where a ray meets a face.
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

/// The point of the mesh that is nearest to another point.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Near<R> {
    /// Where it is; NaN if there is none.
    pub point: [R; 3],
    /// How far away; infinite if there is none.
    pub distance: R,
    /// Index of its face; `STACKLESS_NO_FACE` if there is none.
    pub face: u32,
}
