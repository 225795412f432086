//! Harnesses with their twins, declared once for all methods of running them.

use crate::Drawn;

/// A harness, for tests and scripts.
#[derive(Clone, Copy, Debug)]
pub struct Harness {
    /// Its name under Kani and CBMC.
    pub name: &'static str,
    /// Name of the twin, which must be refuted.
    pub twin: &'static str,
    /// Bound of its loops, plus one.
    pub unwind: u32,
    /// The bound of nested loops, if it is less. CBMC unrolls them for each iteration of the outer loop; Kani has one
    /// bound for all.
    pub nested: Option<u32>,
    /// How often `check.sh` proves it: `daily`; `long`, only on request; or `kani`, never, because it uses too much
    /// memory for that method.
    pub often: &'static str,
    /// The claim, with its clauses.
    pub claim: &'static str,
    /// The body, on drawn choices; `None` if they violate the assumptions.
    pub body: fn(&mut Drawn<false>) -> Option<()>,
    /// The body of the twin.
    pub planted: fn(&mut Drawn<true>) -> Option<()>,
}

/// Declares harnesses: claim, names of the proof and of its twin, unwind (then that of nested loops in parentheses, and
/// the frequency, if not daily), and body.
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

/// The claim of a harness, which its twin breaks. A twin that fails for another reason is not refuted, because it may
/// not have reached its mistake.
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

/// Returns the first element, if any.
pub(crate) const fn first<T: Copy>(said: &[T]) -> Option<T> {
    match said {
        [said, ..] => Some(*said),
        [] => None,
    }
}
