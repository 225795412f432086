//! The choice of a tracer, with reasons.

use crate::wide::Method;

/// One row each: the name, and the reason why wide trees do not support it.
macro_rules! needs {
    ($($variant:ident: $name:literal, $reason:literal;)*) => {
        /// A feature that [`Tracer`](crate::trace::Tracer) lacks, and that
        /// [`BinaryTracer`](crate::trace::BinaryTracer), or another type over binary trees, has.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Need {
            $(#[doc = $reason] $variant,)*
        }

        impl Need {
            /// All needs.
            pub const ALL: [Self; [$(Self::$variant),*].len()] = [$(Self::$variant),*];

            /// Returns the name in tables.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }

            /// Returns the reason why it requires a binary tree.
            pub const fn reason(self) -> &'static str {
                match self { $(Self::$variant => $reason,)* }
            }
        }
    };
}
needs! {
    Shapes: "other shapes", "The leaves of a wide tree hold triangles, four in a block.";
    Tests: "inexact tests", "Wide trees are traced by exact tests alone.";
    Traversal: "a binary traversal", "A traversal of binary trees runs on binary trees.";
    Instances: "instances", "The groups of `InstanceTracer` are binary trees. The meshes in them may be wide.";
    Paths: "paths", "`Continuation` goes on from the leaf of the last hit by key and trail of a binary tree.";
    Pausing: "pausing", "The states that can be put aside and taken up again are those of binary trees.";
}

/// The tracer for a caller's needs. Both tracers give identical answers, bit for bit, so the choice affects only speed.
///
/// ```
/// use stackless_bvh::trace::{Choice, Need};
///
/// assert!(Choice::for_needs(&[]).is_wide());
/// let choice = Choice::for_needs(&[Need::Shapes]);
/// assert_eq!(choice.tracer(), "BinaryTracer");
/// println!("{}", choice.reasons()[0]);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    needs: Vec<Need>,
}

impl Choice {
    /// Chooses the fastest tracer with all needed features.
    pub fn for_needs(needs: &[Need]) -> Self {
        Self { needs: needs.to_vec() }
    }

    /// Returns whether it is [`Tracer`](crate::trace::Tracer).
    pub const fn is_wide(&self) -> bool {
        self.needs.is_empty()
    }

    /// Returns the name of its type.
    pub const fn tracer(&self) -> &'static str {
        if self.is_wide() { "Tracer" } else { "BinaryTracer" }
    }

    /// Returns the name of its traversal.
    pub fn method(&self) -> &'static str {
        if self.is_wide() { Method::default().name() } else { crate::traverse::Method::default().name() }
    }

    /// Returns the reasons for the choice, one sentence each.
    pub fn reasons(&self) -> Vec<&'static str> {
        if self.is_wide() { WIDE.to_vec() } else { self.needs.iter().map(|need| need.reason()).collect() }
    }
}

/// Reasons for wide trees with [`Method::default`] as the default.
const WIDE: [&str; 3] = [
    "It is exact: its answers are those of rational arithmetic.",
    "It is the fastest that was measured (benches/records/2026-11-28-leaves.md), but for wide-stack, whose state grows with the tree.",
    "It finds ancestors by references in the nodes, and so has no hash, which a patent may cover.",
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bvh::{Bvh, WideBvh};
    use crate::generate::procedural;
    use crate::trace::{BinaryTracer, Tracer};

    #[test]
    fn the_choice_is_what_the_tracers_do() {
        let mesh = procedural::soup(1, 200);
        let (wide, tracer) = (Choice::for_needs(&[]), Tracer::of(&mesh).expect("a tree"));
        assert_eq!((wide.tracer(), wide.method()), ("Tracer", tracer.method().name()));
        let built = WideBvh::build(&mesh).expect("a wide tree");
        assert_eq!(built.to_bytes(), tracer.bvh().to_bytes());
        assert!(!Method::default().needs_hash() && wide.reasons() == WIDE);
        for need in Need::ALL {
            let binary = Choice::for_needs(&[need]);
            let bvh = Bvh::build(&mesh).expect("a tree");
            let tracer = BinaryTracer::new(&bvh);
            assert_eq!((binary.tracer(), binary.method()), ("BinaryTracer", tracer.method().name()), "{need:?}");
            assert_eq!(binary.reasons(), [need.reason()]);
        }
        assert_eq!(Choice::for_needs(&Need::ALL).reasons().len(), Need::ALL.len());
    }
}
