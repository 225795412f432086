//! The table of traversals.
//!
//! A new traversal is a file for its cursor in this folder, and a row here. The row defines its name, help and
//! documentation, its tables, and the cursor for all code that selects a traversal at run time: the ray tracer, the
//! battery in all words, the pages of `explain`, the benchmarks. `tests/toy` shows it.

use super::method::{Kind, Need, Row, Test, Words};
use super::{
    Afra, ByKey, Context, Disjoint, Hapala, HashOnly, Hashed, ImplicitA, ImplicitA1, ImplicitB, ImplicitB1, Laine,
    LeftFirst, PausingContext, PruningStack, Skip, Sparse, Stack, Supply, Uncle, Unsupported,
};
use crate::key::KeyWord;
use crate::name::named;
use crate::order;
use crate::tree::Recorded;

/// Most fields are self-explanatory. `without`: the same traversal without pruning. `state`: bytes of the state by the
/// bytes of a word and by depth, as Barringer & Akenine-Möller count: 4 for each variable, a word for each key, trail,
/// counter or mask, and a head for a stack (for a short stack also its length). `cursor`: made from a [`Supply`] for
/// words `W`; `ByNode` also gives the order.
macro_rules! traversals {
    ($($variant:ident {
        name: $name:literal, by: $by:literal, clause: $clause:literal,
        help: $help:literal,
        tests: $test:ident, links: $links:ident, needs: $need:ident, words: $words:ident, without: $without:ident,
        state: |$word:pat_param, $depth:pat_param| $state:expr,
        cursor: $kind:ident |$from:ident| $cursor:expr,
    })*) => {
        /// A traversal, by the name that code, command line, suite and tables share.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Method {
            $(#[doc = $help] $variant,)*
        }

        impl Method {
            /// All traversals, in the order of the tables.
            pub const ALL: [Self; [$(Self::$variant),*].len()] = [$(Self::$variant),*];

            pub(super) const fn row(self) -> Row {
                match self {
                    $(Self::$variant => Row {
                        name: $name,
                        by: $by,
                        clause: $clause,
                        help: $help,
                        test: Test::$test,
                        links: Recorded::$links,
                        need: Need::$need,
                        words: Words::$words,
                        kind: Kind::$kind,
                        without: Self::$without,
                    },)*
                }
            }

            /// Returns the bytes of its state for one ray in a tree of this depth, as Barringer & Akenine-Möller count.
            /// `[STATE-1]`
            pub fn state_bytes<W: KeyWord>(self, depth: u32) -> usize {
                let of_words = (W::bytes(depth), depth as usize);
                match self {
                    $(Self::$variant => { let ($word, $depth) = of_words; $state })*
                }
            }

            /// Calls a function with this traversal in words `W`: the only conversion from a name to a cursor.
            ///
            /// # Errors
            /// [`Unsupported`], before the first step.
            #[inline]
            pub fn dispatch<'t, W: KeyWord, X: Context<'t, W>>(self, context: X) -> Result<X::Output, Unsupported> {
                self.fits::<W>()?;
                match self {
                    $(Self::$variant => traversals!(@any $kind context, X, $from, $cursor),)*
                }
            }

            /// Calls a function with a traversal that can be [paused](super::Pause).
            ///
            /// # Errors
            /// [`Unsupported::NoPause`] for other traversals, and other errors of [`Unsupported`], before the first
            /// step.
            #[inline]
            pub fn dispatch_pausing<'t, W: KeyWord, X: PausingContext<'t, W>>(
                self,
                context: X,
            ) -> Result<X::Output, Unsupported> {
                self.fits::<W>()?;
                match self {
                    $(Self::$variant => traversals!(@pausing $kind context, X, $from, $cursor),)*
                }
            }
        }

        named!(Method);
    };

    (@any ByNode $context:ident, $x:ident, $from:ident, $cursor:expr) => {
        $context.by_node(|$from: $x::From| $cursor)
    };
    (@any $kind:ident $context:ident, $x:ident, $from:ident, $cursor:expr) => {
        $context.by_parent(|$from: $x::From| $cursor)
    };
    (@pausing Pausing $context:ident, $x:ident, $from:ident, $cursor:expr) => {
        $context.pausing(|$from: $x::From| $cursor)
    };
    (@pausing $kind:ident $context:ident, $x:ident, $from:ident, $cursor:expr) => { Err(Unsupported::NoPause) };
}

const NODE: usize = 4;

traversals! {
    Stack {
        name: "stack", by: "the textbook", clause: "STACK-1",
        help: "Pushes postponed nodes on a stack, and pops the next node.",
        tests: Children, links: Nothing, needs: Nothing, words: None, without: Stack,
        state: |_, depth| NODE + 4 + NODE * depth,
        cursor: ByParent |from| Ok(Stack::with(from.tree(), from.memory())),
    }
    StackDisjoint {
        name: "stack-disjoint", by: "the textbook", clause: "ORACLE-2",
        help: "A stack with a mark for each node; a hit drops the nodes that are disjoint from it.",
        tests: Disjoint, links: Nothing, needs: Nothing, words: None, without: Stack,
        state: |_, depth| NODE + 4 + 2 * NODE * depth,
        cursor: ByParent |from| Ok(PruningStack::<_, false, _>::with(from.tree(), from.memory())),
    }
    StackT0 {
        name: "stack-t0", by: "Dammertz 2011", clause: "ORACLE-3",
        help: "A stack with the distance of each node; drops nodes that begin beyond the hit.",
        tests: Distance, links: Nothing, needs: Nothing, words: None, without: Stack,
        state: |_, depth| NODE + 4 + 2 * NODE * depth,
        cursor: ByParent |from| Ok(PruningStack::<_, true, _>::with(from.tree(), from.memory())),
    }
    LeftFirst {
        name: "left-first", by: "Barringer & Akenine-Möller 2013, Alg. 1", clause: "LEFT-1",
        help: "A counter in an implicit tree, left before right; tests each node at its visit.",
        tests: NodeLeftFirst, links: Nothing, needs: Layout, words: Any, without: LeftFirst,
        state: |word, _| 2 * word,
        cursor: ByNode |from| Ok((LeftFirst::new(from.tree(), from.layout()?)?, order::LeftOrder)),
    }
    ImplicitA {
        name: "implicit-a", by: "Barringer & Akenine-Möller 2013, Alg. 2", clause: "IMPLICIT-1",
        help: "A counter and a mask of swapped levels; their exclusive or is the address.",
        tests: Children, links: Nothing, needs: Layout, words: Any, without: ImplicitA,
        state: |word, _| 3 * word,
        cursor: ByParent |from| Ok(ImplicitA::new(from.tree(), from.layout()?)?),
    }
    ImplicitA1 {
        name: "implicit-a1", by: "Barringer & Akenine-Möller 2013, Alg. 2 with combined index", clause: "IMPLICIT-3",
        help: "An implicit tree with two variables combined in one word.",
        tests: Children, links: Nothing, needs: Layout, words: Any, without: ImplicitA1,
        state: |word, _| 2 * word,
        cursor: ByParent |from| Ok(ImplicitA1::new(from.tree(), from.layout()?)?),
    }
    ImplicitB {
        name: "implicit-b", by: "Barringer & Akenine-Möller 2013, Alg. 3", clause: "IMPLICIT-2",
        help: "A counter, and the path itself as the address.",
        tests: Children, links: Nothing, needs: Layout, words: Any, without: ImplicitB,
        state: |word, _| 3 * word,
        cursor: ByParent |from| Ok(ImplicitB::new(from.tree(), from.layout()?)?),
    }
    ImplicitB1 {
        name: "implicit-b1", by: "Barringer & Akenine-Möller 2013, Alg. 3 with combined index", clause: "IMPLICIT-3",
        help: "An implicit tree with two variables combined in one word.",
        tests: Children, links: Nothing, needs: Layout, words: Any, without: ImplicitB1,
        state: |word, _| 2 * word,
        cursor: ByParent |from| Ok(ImplicitB1::new(from.tree(), from.layout()?)?),
    }
    Sparse {
        name: "sparse", by: "Barringer & Akenine-Möller 2013, Alg. 4", clause: "SPARSE-1",
        help: "A counter whose carry is the number of parents to climb.",
        tests: Children, links: ParentSibling, needs: Nothing, words: Any, without: Sparse,
        state: |word, _| NODE + word,
        cursor: Pausing |from| Sparse::<W, _>::new(from.tree()),
    }
    SparseDisjoint {
        name: "sparse-disjoint", by: "Binder & Keller 2016, Sec. 2.3", clause: "DISJOINT-2",
        help: "`sparse` with a second trail; a hit drops the nodes that are disjoint from it.",
        tests: Disjoint, links: ParentSibling, needs: Nothing, words: Any, without: Sparse,
        state: |word, _| NODE + 2 * word,
        cursor: Pausing |from| Sparse::<W, _, Disjoint<W>>::new(from.tree()),
    }
    Hapala {
        name: "hapala", by: "Hapala et al. 2011", clause: "HAPALA-1",
        help: "Only the node: a fixed order determines on the way up which child was near.",
        tests: NodeBySign, links: ParentSibling, needs: Nothing, words: None, without: Hapala,
        state: |_, _| NODE + 4,
        cursor: ByNode |from| Ok((Hapala::new(from.tree(), from.by_sign())?, from.by_sign())),
    }
    Laine0 {
        name: "laine-0", by: "Laine 2010", clause: "LAINE-1",
        help: "A trail of levels; restarts at the root to find the next node.",
        tests: Children, links: Nothing, needs: Nothing, words: Fixed, without: Laine0,
        state: |word, _| NODE + 3 * word,
        cursor: Restarting |from| Ok(Laine::<0, W, _>::new(from.tree())?),
    }
    Laine1 {
        name: "laine-1", by: "Laine 2010", clause: "LAINE-1",
        help: "A trail of levels and a short stack; restarts at the root for nodes that the stack has lost.",
        tests: Children, links: Nothing, needs: Nothing, words: Fixed, without: Laine1,
        state: |word, _| NODE + 3 * word + 12,
        cursor: Restarting |from| Ok(Laine::<1, W, _>::new(from.tree())?),
    }
    Laine2 {
        name: "laine-2", by: "Laine 2010", clause: "LAINE-1",
        help: "A trail of levels and a short stack; restarts at the root for nodes that the stack has lost.",
        tests: Children, links: Nothing, needs: Nothing, words: Fixed, without: Laine2,
        state: |word, _| NODE + 3 * word + 16,
        cursor: Restarting |from| Ok(Laine::<2, W, _>::new(from.tree())?),
    }
    Laine4 {
        name: "laine-4", by: "Laine 2010", clause: "LAINE-1",
        help: "A trail of levels and a short stack; restarts at the root for nodes that the stack has lost.",
        tests: Children, links: Nothing, needs: Nothing, words: Fixed, without: Laine4,
        state: |word, _| NODE + 3 * word + 24,
        cursor: Restarting |from| Ok(Laine::<4, W, _>::new(from.tree())?),
    }
    Laine8 {
        name: "laine-8", by: "Laine 2010", clause: "LAINE-1",
        help: "A trail of levels and a short stack; restarts at the root for nodes that the stack has lost.",
        tests: Children, links: Nothing, needs: Nothing, words: Fixed, without: Laine8,
        state: |word, _| NODE + 3 * word + 40,
        cursor: Restarting |from| Ok(Laine::<8, W, _>::new(from.tree())?),
    }
    Afra {
        name: "afra", by: "Áfra & Szirmay-Kalos 2014", clause: "AFRA-1",
        help: "A trail; climbs along parents while its lowest bit is clear.",
        tests: Children, links: ParentSibling, needs: Nothing, words: Any, without: Afra,
        state: |word, _| NODE + word,
        cursor: Pausing |from| Afra::<W, _>::new(from.tree()),
    }
    AfraDisjoint {
        name: "afra-disjoint", by: "Binder & Keller 2016, Sec. 2.3", clause: "DISJOINT-2",
        help: "`afra` with a second trail; a hit drops the nodes that are disjoint from it.",
        tests: Disjoint, links: ParentSibling, needs: Nothing, words: Any, without: Afra,
        state: |word, _| NODE + 2 * word,
        cursor: Pausing |from| Afra::<W, _, Disjoint<W>>::new(from.tree()),
    }
    Uncle {
        name: "uncle", by: "Binder & Keller 2016, Sec. 2.2.1", clause: "UNCLE-2",
        help: "A trail and a register; records name uncle and grand uncle, so a climb takes two levels per step.",
        tests: Children, links: Uncles, needs: Nothing, words: Any, without: Uncle,
        state: |word, _| 2 * NODE + word,
        cursor: Pausing |from| Uncle::<W, _>::new(from.tree()),
    }
    UncleDisjoint {
        name: "uncle-disjoint", by: "Binder & Keller 2016, Sec. 2.3", clause: "DISJOINT-2",
        help: "`uncle` with a second trail; a hit drops the nodes that are disjoint from it.",
        tests: Disjoint, links: Uncles, needs: Nothing, words: Any, without: Uncle,
        state: |word, _| 2 * NODE + 2 * word,
        cursor: Pausing |from| Uncle::<W, _, Disjoint<W>>::new(from.tree()),
    }
    HashOnly {
        name: "hash-only", by: "Binder & Keller 2016, Sec. 2.2", clause: "HASHONLY-1",
        help: "Key and trail; a perfect hash maps the key of the next node to its address.",
        tests: Children, links: Nothing, needs: AllKeys, words: Any, without: HashOnly,
        state: |word, _| NODE + 2 * word,
        cursor: Pausing |from| Ok(HashOnly::<W, _, _>::new(from.tree(), from.all_keys()?)?),
    }
    Hashed {
        name: "hashed", by: "Binder & Keller 2016, Alg. 1", clause: "HASHED-1",
        help: "Key, trail and a register, filled by uncles; a perfect hash has the other nodes.",
        tests: Children, links: Uncles, needs: ReachedKeys, words: Any, without: Hashed,
        state: |word, _| 2 * NODE + 2 * word,
        cursor: Pausing |from| Hashed::<W, _, _>::new(from.tree(), from.reached_keys()?),
    }
    HashedDisjoint {
        name: "hashed-disjoint", by: "Binder & Keller 2016, Sec. 2.3", clause: "DISJOINT-2",
        help: "`hashed` with a second trail; a hit drops the nodes that are disjoint from it.",
        tests: Disjoint, links: Uncles, needs: ReachedKeys, words: Any, without: Hashed,
        state: |word, _| 2 * NODE + 3 * word,
        cursor: Pausing |from| Hashed::<W, _, _, Disjoint<W>>::new(from.tree(), from.reached_keys()?),
    }
    Skip {
        name: "skip", by: "Smits 1998", clause: "SKIP-1",
        help: "Each node names the node after its subtree, in a fixed order.",
        tests: NodeLeftFirst, links: Nothing, needs: Skips, words: None, without: Skip,
        state: |_, _| NODE,
        cursor: ByNode |from| Ok((Skip::new(from.tree(), from.skips()?, order::LeftOrder), order::LeftOrder)),
    }
    SkipOctant {
        name: "skip-octant", by: "Boulos & Haines 2006", clause: "SKIP-1",
        help: "Each node names the node after its subtree, in a fixed order.",
        tests: NodeBySign, links: Nothing, needs: SkipsBySign, words: None, without: SkipOctant,
        state: |_, _| NODE,
        cursor: ByNode |from| Ok((Skip::new(from.tree(), from.skips_by_sign()?, from.by_sign()), from.by_sign())),
    }
    Complete {
        name: "complete", by: "Binder & Keller 2016, Sec. 1.1", clause: "COMPLETE-1",
        help: "Key and trail in a complete tree: the address is the key less one.",
        tests: Children, links: Nothing, needs: Complete, words: Any, without: Complete,
        state: |word, _| 2 * word,
        cursor: ByParent |from| Ok(ByKey::<W, _>::new(from.tree(), from.complete()?)?),
    }
    Glassner {
        name: "glassner", by: "Glassner 1984", clause: "GLASSNER-1",
        help: "Key and trail; a chained table compares keys.",
        tests: Children, links: Nothing, needs: Chains, words: Any, without: Glassner,
        state: |word, _| NODE + 2 * word,
        cursor: ByParent |from| Ok(ByKey::<W, _>::new(from.tree(), from.chains()?)?),
    }
}
