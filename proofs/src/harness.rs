//! A harness with its twin, declared once for all ways to run it.

use crate::Drawn;

/// A harness, as tests and scripts see it.
#[derive(Clone, Copy, Debug)]
pub struct Harness {
    /// Its name under Kani and CBMC.
    pub name: &'static str,
    /// Name of the twin, which must be refuted.
    pub twin: &'static str,
    /// Bound of its loops, plus one.
    pub unwind: u32,
    /// The same for loops within a loop, where it is less. CBMC unrolls these for each turn of the outer one; Kani has
    /// one bound for all.
    pub nested: Option<u32>,
    /// How often `check.sh` proves it: `daily`; `long`, only when asked to; or `kani`, never, as it has too much memory
    /// for the way there.
    pub often: &'static str,
    /// What it claims, with the clauses.
    pub claim: &'static str,
    /// The body, on drawn choices; `None` where they are not as assumed.
    pub body: fn(&mut Drawn<false>) -> Option<()>,
    /// The twin's.
    pub planted: fn(&mut Drawn<true>) -> Option<()>,
}

/// Declares harnesses: claim, names of the proof and of its twin, unwind (then that of loops within a loop, in
/// parentheses, and how often, if not daily), and body.
macro_rules! harnesses {
    ($($(#[doc = $claim:literal])+ $name:ident, $twin:ident, $unwind:tt $(($nested:tt))? $($often:ident)? => $body:expr;)*) => {
        $(
            #[cfg(kani)]
            #[kani::proof]
            #[kani::unwind($unwind)]
            fn $name() {
                let _ = $body(&mut $crate::choose::Symbolic::<false>);
            }

            #[cfg(kani)]
            #[kani::proof]
            #[kani::should_panic]
            #[kani::unwind($unwind)]
            fn $twin() {
                let _ = $body(&mut $crate::choose::Symbolic::<true>);
            }
        )*

        /// The harnesses of this topic.
        pub const HARNESSES: &[$crate::Harness] = &[$($crate::Harness {
            name: stringify!($name),
            twin: stringify!($twin),
            unwind: $unwind,
            nested: $crate::harness::first(&[$($nested)?]),
            often: match $crate::harness::first(&[$(stringify!($often))?]) {
                Some(often) => often,
                None => "daily",
            },
            claim: concat!($($claim),+),
            body: |choose| $body(choose),
            planted: |choose| $body(choose),
        }),*];
    };
}

pub(crate) use harnesses;

/// The message of a `claim!` that does not hold.
pub const CLAIM: &str = "the claim of the harness";

/// What a harness claims, and its twin breaks. A twin that dies of anything else is not refuted: it may never have come
/// to its mistake.
macro_rules! claim {
    ($condition:expr) => {
        #[cfg(kani)]
        {
            let holds: bool = $condition;
            kani::assert(holds, "the claim of the harness");
            // No path comes here, and so the compiler knows the condition below, as after `assert!`. Without that there
            // is no answer in 200 s for trees of nine nodes.
            if !holds {
                panic!();
            }
        }
        #[cfg(not(kani))]
        assert!($condition, "{}", $crate::CLAIM);
    };
}

pub(crate) use claim;

/// What is said, or nothing.
pub(crate) const fn first<T: Copy>(said: &[T]) -> Option<T> {
    match said {
        [said, ..] => Some(*said),
        [] => None,
    }
}
