//! A ray against four or eight boxes at once, and against four triangles at once.
//!
//! Tracers of wide hierarchies ([`bvh::wide`](crate::bvh::wide)) use these tests. Instructions are those of
//! [`fearless_simd`]; the caller selects the level. All functions are always inlined, so they are compiled for the
//! caller's level. The box test gives identical bits on all levels; the filter rejects the same triangles on all
//! levels. Derivations: spec/wide-lanes.md, `[LANES-1]` to `[LANES-7]`.
//!
//! ```
//! use fearless_simd::{Level, Simd, dispatch, f32x8};
//! use stackless_bvh::glam::Vec3;
//! use stackless_bvh::internals::geom::lanes::BoxRay;
//! use stackless_bvh::geom::{Aabb, Ray, Region};
//!
//! #[inline(always)]
//! fn met<S: Simd>(simd: S, planes: &[[[f32; 8]; 2]; 3], ray: &Ray, region: &Region) -> u32 {
//!     let (_, set) = BoxRay::<S, f32x8<S>, 8>::new(simd, ray, region).enter(planes, ray.tmax());
//!     set
//! }
//!
//! // Lane i from i to i + 1 on the axis x, and from -1 to 1 on the others.
//! let row = |offset: f32| std::array::from_fn(|i| i as f32 + offset);
//! let planes = [[row(0.0), row(1.0)], [[-1.0; 8], [1.0; 8]], [[-1.0; 8], [1.0; 8]]];
//! let region = Region::of(&Aabb { lo: Vec3::splat(-1.0), hi: Vec3::splat(8.0) });
//! let ray = Ray::new(Vec3::new(2.5, 0.0, 0.0), Vec3::NEG_X)?;
//! let set = dispatch!(Level::new(), simd => met(simd, &planes, &ray, &region));
//! assert_eq!(set, 0b0000_0111);
//! # Ok::<(), stackless_bvh::geom::RayError>(())
//! ```

mod block;
mod boxes;
mod double;
mod enclosed;
mod filter;
mod framed;
mod leaf;
mod lines;
mod point;
mod precision;
mod triangles;

pub use block::Block;
pub use boxes::BoxRay;
pub use double::{LazyExact64, Nearest64};
pub use enclosed::EnclosedBoxes;
pub use filter::TriangleFilter;
pub use framed::FramedBoxes;
pub(crate) use leaf::{LaneSet, filled};
pub use leaf::{LazyExact, Nearest};
pub use point::BoxPoint;
pub use precision::{FourLanes, Hits, NodeBoxes, Precision};
pub use triangles::{DETERMINANT, DISTANCE, MIN_EDGE, OFF, OFF_EDGE, OFF_REACH, TriangleRay};

/// A level of instructions: `Level::new()` is the best of this machine.
pub use fearless_simd::Level;
use fearless_simd::{Simd, SimdFloat};

/// Returns the instruction levels for rays on this machine, the best one first, with their names.
///
/// On x86, SSE4.2 and AVX-512 are not among them, because they do not help here. With AVX-512 rays take 5 to 8 % longer
/// (benches/records/2026-11-27-wide.md).
pub fn levels() -> Vec<(&'static str, Level)> {
    let best = Level::new();
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        let avx2 = best.as_avx2().map(|avx2| ("avx2", Level::Avx2(avx2)));
        let sse2 = best.as_sse2().map(|sse2| ("sse2", Level::Sse2(sse2)));
        let known: Vec<_> = avx2.into_iter().chain(sse2).collect();
        if known.is_empty() { vec![("scalar", best)] } else { known }
    }
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    vec![(if best.is_fallback() { "scalar" } else { "simd" }, best)]
}

/// The target's baseline instructions, as one type: SSE2, or scalar instructions if the target has none.
#[cfg(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2"))]
pub(crate) type Baseline = fearless_simd::x86::Sse2;
#[cfg(not(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2")))]
pub(crate) type Baseline = fearless_simd::Fallback;

#[cfg(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2"))]
#[inline(always)]
pub(crate) fn baseline() -> Baseline {
    match Level::baseline().as_sse2() {
        Some(simd) => simd,
        None => unreachable!("the target has SSE2"),
    }
}

#[cfg(not(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2")))]
pub(crate) const fn baseline() -> Baseline {
    fearless_simd::Fallback::new()
}

/// Runs code with the target's baseline instructions, if a choice is not worth a copy of the code for each level.
macro_rules! with_baseline {
    ($simd:ident => $run:expr) => {{
        #[cfg(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2"))]
        {
            let $simd = $crate::geom::lanes::baseline();
            $run
        }
        #[cfg(not(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2")))]
        fearless_simd::dispatch!($crate::geom::lanes::Level::baseline(), $simd => $run)
    }};
}
pub(crate) use with_baseline;

/// Runs code with the instructions of a level, in a separate function. All functions that it calls must be inlined, or
/// they would not be compiled for the level.
macro_rules! vectorize {
    ($level:expr, $simd:ident => $run:expr) => {{
        // Two levels of x86: SSE4.2 and AVX-512 do not help here, and each level costs every build of the library time.
        #[cfg(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2"))]
        match ($level.as_avx2(), $level.as_sse2().or_else(|| $crate::geom::lanes::Level::new().as_sse2())) {
            (Some($simd), _) => $simd.vectorize(
                #[inline(always)]
                || $run,
            ),
            (None, Some($simd)) => $crate::geom::lanes::apart(
                #[inline(always)]
                || $run,
            ),
            (None, None) => unreachable!("the target has SSE2"),
        }
        #[cfg(not(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2")))]
        {
            fearless_simd::dispatch!($level, $simd => $run)
        }
    }};
}
pub(crate) use vectorize;

/// Runs it in a separate function. The baseline's instructions are also those of the caller. So without this function
/// the caller would contain all copies of it, and save and restore their registers at each call.
#[cfg(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2"))]
#[inline(never)]
pub(crate) fn apart<R>(run: impl FnOnce() -> R) -> R {
    run()
}

/// A vector of `A` floats: `f32x4` or `f32x8`.
pub trait Lanes<S: Simd, const A: usize>: SimdFloat<S, Element = f32, Array = [f32; A]> {}

impl<S: Simd, const A: usize, V: SimdFloat<S, Element = f32, Array = [f32; A]>> Lanes<S, A> for V {}

#[cfg(test)]
mod tests;
