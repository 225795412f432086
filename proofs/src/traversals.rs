//! Proves that every traversal equals the oracle on all trees up to a size, for any decisions.
//!
//! The cursors are the library's. Trees and links are those of [`Shape`], computed from keys, so a proof needs no
//! memory. At each visit, node, key, trail, counter, marks and register are compared with the
//! [reference](crate::reference). `INNER` is the greatest number of inner nodes: trees have up to `2 INNER + 1` nodes
//! and are up to `INNER` edges deep.

mod resumed;

use alloc::vec::Vec;

use stackless_bvh::oracle;
use stackless_bvh::order::{Pruned, Pruning};
use stackless_bvh::traverse::Disjoint;
use stackless_bvh::traverse::{
    Afra, ByKey, Cursor, Hapala, HashOnly, Hashed, ImplicitA, ImplicitA1, ImplicitB, ImplicitB1, Laine, LeftFirst,
    Skip, Skips, Sparse, Stack, Uncle, traverse, traverse_pruned,
};
use stackless_bvh::tree::Topology;

use crate::harness::{claim, harnesses};
use crate::reference::{Keyed, ScriptedSearch, Watch};
use crate::shape::{Computed, HashedKeys, Script, Shape};
use crate::{Choose, cover};
use resumed::{Resumed, by_key_and_trail};

harnesses! {
    /// The reference of these harnesses equals the oracle: trees of up to 5 nodes. `[ORACLE-1]` `[TRACE-1]`
    oracle_5, oracle_5_twin, 4 kani => oracle::<2>;
    /// The reference that skips disjoint nodes equals its oracle. `[ORACLE-2]`
    oracle_disjoint_5, oracle_disjoint_5_twin, 4 kani => oracle_disjoint::<2>;
    /// Key and trail, every node by its key: trees of up to 9 nodes. `[TRAIL-7]` `[TRAVERSE-1]`
    by_key_9, by_key_9_twin, 11 => by_key::<4>;
    /// Key and trail: up to 11 nodes. `[TRAIL-7]` `[TRAVERSE-1]`
    by_key_11, by_key_11_twin, 13 => by_key::<5>;
    /// Children by their parent's record, postponed nodes by their key, also if a leaf ends the search. `[HASHONLY-1]`
    /// `[TRAVERSE-1]`
    hash_only_9, hash_only_9_twin, 11 => hash_only::<4>;
    /// The climb while bit 0 is clear: up to 7 nodes. `[AFRA-1]` `[TRAVERSE-1]`
    afra_7, afra_7_twin, 9 (3) => afra::<3>;
    /// The climb: up to 9 nodes. `[AFRA-1]` `[TRAVERSE-1]`
    afra_9, afra_9_twin, 11 (4) long => afra::<4>;
    /// Register and uncles, no table. `[UNCLE-1]` `[UNCLE-2]` `[REGISTER-1]` `[TRAVERSE-1]`
    uncle_9, uncle_9_twin, 11 (1) => uncle::<4>;
    /// Algorithm 1, which looks up only hashed keys. `[HASHED-1]` `[REGISTER-1]` `[HASH-3]` `[TRAVERSE-1]`
    hashed_9, hashed_9_twin, 11 => hashed::<4>;
    /// Algorithm 1: up to 11 nodes. `[HASHED-1]` `[REGISTER-1]` `[HASH-3]` `[TRAVERSE-1]`
    hashed_11, hashed_11_twin, 13 long => hashed::<5>;
    /// The counter, and the climb by its carries: up to 7 nodes. `[SPARSE-1]` `[SPARSE-2]` `[TRAVERSE-1]`
    sparse_7, sparse_7_twin, 9 (3) => sparse::<3>;
    /// The counter: up to 9 nodes. `[SPARSE-1]` `[SPARSE-2]` `[TRAVERSE-1]`
    sparse_9, sparse_9_twin, 11 (4) long => sparse::<4>;
    /// Algorithm 2, level index and swap mask. `[IMPLICIT-1]` `[TRAVERSE-1]`
    implicit_a_9, implicit_a_9_twin, 11 => implicit_a::<4>;
    /// Algorithm 2 with the combined index. `[IMPLICIT-1]` `[IMPLICIT-3]` `[TRAVERSE-1]`
    implicit_a1_9, implicit_a1_9_twin, 11 => implicit_a1::<4>;
    /// Algorithm 3. `[IMPLICIT-2]` `[TRAVERSE-1]`
    implicit_b_9, implicit_b_9_twin, 11 => implicit_b::<4>;
    /// Algorithm 3 with the combined index. `[IMPLICIT-2]` `[IMPLICIT-3]` `[TRAVERSE-1]`
    implicit_b1_9, implicit_b1_9_twin, 11 => implicit_b1::<4>;
    /// Algorithm 1 of Barringer & Akenine-Möller: node tests, left first. `[LEFT-1]` `[TRAVERSE-1]`
    left_first_9, left_first_9_twin, 11 => left_first::<4>;
    /// Restarts from the root. `[LAINE-1]` `[TRAVERSE-1]`
    laine_0_5, laine_0_5_twin, 10 kani => laine::<0, 2>;
    /// Restarts with a short stack of two. `[LAINE-1]` `[TRAVERSE-1]`
    laine_2_5, laine_2_5_twin, 10 kani => laine::<2, 2>;
    /// Parents, and an order that is recomputed on the path up. `[HAPALA-1]` `[TRAVERSE-1]`
    hapala_7, hapala_7_twin, 9 (3) => hapala::<3>;
    /// Parents and a recomputed order: up to 9 nodes. `[HAPALA-1]` `[TRAVERSE-1]`
    hapala_9, hapala_9_twin, 11 (4) long => hapala::<4>;
    /// A stack in memory. `[STACK-1]` `[TRAVERSE-1]`
    stack_9, stack_9_twin, 11 kani => stack::<4>;
    /// Skip pointers, in a table in memory. `[SKIP-1]` `[TRAVERSE-1]`
    skip_7, skip_7_twin, 17 kani => skip::<3>;
    /// The climb with a second trail. `[DISJOINT-1]` `[DISJOINT-2]` `[TRAVERSE-1]`
    afra_disjoint_7, afra_disjoint_7_twin, 9 (3) => afra_disjoint::<3>;
    /// The climb with a second trail: up to 9 nodes. `[DISJOINT-1]` `[DISJOINT-2]` `[TRAVERSE-1]`
    afra_disjoint_9, afra_disjoint_9_twin, 11 (4) long => afra_disjoint::<4>;
    /// The counter with a second trail. `[DISJOINT-1]` `[DISJOINT-2]` `[TRAVERSE-1]`
    sparse_disjoint_7, sparse_disjoint_7_twin, 9 (3) => sparse_disjoint::<3>;
    /// The counter with a second trail: up to 9 nodes. `[DISJOINT-1]` `[DISJOINT-2]` `[TRAVERSE-1]`
    sparse_disjoint_9, sparse_disjoint_9_twin, 11 (4) long => sparse_disjoint::<4>;
    /// The second trail and the register, without a table. `[DISJOINT-1]` `[DISJOINT-2]` `[DISJOINT-3]` `[TRAVERSE-1]`
    uncle_disjoint_9, uncle_disjoint_9_twin, 11 (1) => uncle_disjoint::<4>;
    /// The second trail and the register: the table needs no additional keys. `[DISJOINT-1]` `[DISJOINT-2]`
    /// `[DISJOINT-3]` `[TRAVERSE-1]`
    hashed_disjoint_9, hashed_disjoint_9_twin, 11 => hashed_disjoint::<4>;
    /// The climb, paused and resumed before each step. `[PAUSE-1]`
    afra_resumed_7, afra_resumed_7_twin, 9 (3) => afra_resumed::<3>;
    /// The counter, paused and resumed before each step. `[PAUSE-1]`
    sparse_resumed_7, sparse_resumed_7_twin, 9 (3) => sparse_resumed::<3>;
    /// Register and uncles, paused and resumed before each step. `[PAUSE-1]` `[PAUSE-3]`
    uncle_resumed_9, uncle_resumed_9_twin, 11 (1) => uncle_resumed::<4>;
    /// Register and table, paused and resumed before each step. `[PAUSE-1]` `[PAUSE-3]`
    hashed_resumed_9, hashed_resumed_9_twin, 11 => hashed_resumed::<4>;
    /// Paused before each step, and resumed from key and trail. `[PAUSE-1]` `[PAUSE-2]` `[PAUSE-3]`
    hashed_by_key_and_trail_9, hashed_by_key_and_trail_9_twin, 11 => hashed_by_key_and_trail::<4>;
}

/// Runs a traversal over any tree with up to `inner_nodes` inner nodes, and compares it with the reference.
pub fn follows<C: Choose, T: Keyed>(
    choose: &mut C,
    inner_nodes: u32,
    pruning: Pruning,
    script: impl FnOnce(&mut C, Shape) -> Script,
    tree: impl FnOnce(Shape) -> T,
    run: impl FnOnce(&T, &mut ScriptedSearch<'_, T>, &mut Watch<'_, T>),
) -> Option<()> {
    let shape = Shape::any(choose, inner_nodes)?;
    let script = script(choose, shape);
    let tree = tree(shape);
    // The mistake: the deepest inner node of a comb wants no child.
    let silent_from = choose.plant(u32::MAX, |_| 1 << (inner_nodes - 1));
    let mut watch = Watch::new(&tree, script, pruning);
    run(&tree, &mut ScriptedSearch { tree: &tree, script, silent_from }, &mut watch);
    claim!(watch.reference.key().is_none());
    cover!(choose, watch.visits == 2 * inner_nodes + 1, "every node of a tree of the greatest size is visited");
    cover!(choose, watch.longest == inner_nodes - 1, "from the deepest leaf of a comb to the root's other child");
    Some(())
}

/// Runs a cursor. (A refused cursor visits no node, which the comparison detects.)
fn run<T: Keyed, E>(cursor: Result<impl Cursor, E>, search: &mut impl Pruned, watch: &mut Watch<'_, T>) {
    if let Ok(cursor) = cursor {
        traverse_pruned(cursor, search, watch);
    }
}

/// A run with any decisions.
macro_rules! runs {
    ($pruning:ident, $script:expr; $($(#[$doc:meta])* $name:ident $(<$k:ident>)?,
        |$tree:ident, $told:ident, $watch:ident| $run:expr;)*) => {$(
        $(#[$doc])*
        pub fn $name<$(const $k: usize,)? const INNER: u32>(choose: &mut impl Choose) -> Option<()> {
            follows(choose, INNER, Pruning::$pruning, $script, |shape| shape, |$tree, $told, $watch| {
                $run;
            })
        }
    )*};
}

/// A traversal with any decisions.
macro_rules! bodies {
    ($pruning:ident, $script:expr; $($(#[$doc:meta])* $name:ident $(<$k:ident>)?, |$tree:ident| $cursor:expr;)*) => {
        runs! {
            $pruning, $script;
            $($(#[$doc])* $name $(<$k>)?, |$tree, told, watch| run($cursor, told, watch);)*
        }
    };
}

bodies! {
    Never, Script::any;
    /// `[TRAIL-7]`
    by_key, |tree| ByKey::<u32, _>::new(tree, Computed(*tree));
    /// `[AFRA-1]`
    afra, |tree| Afra::<u32, _>::new(tree);
    /// `[UNCLE-1]` `[UNCLE-2]` `[REGISTER-1]`
    uncle, |tree| Uncle::<u32, _>::new(tree);
    /// `[HASHED-1]` `[REGISTER-1]` `[HASH-3]`
    hashed, |tree| Hashed::<u32, _, _>::new(tree, HashedKeys(*tree));
    /// `[SPARSE-1]` `[SPARSE-2]`
    sparse, |tree| Sparse::<u32, _>::new(tree);
    /// `[IMPLICIT-1]`
    implicit_a, |tree| ImplicitA::<u32, _>::new(tree, Computed(*tree));
    /// `[IMPLICIT-1]` `[IMPLICIT-3]`
    implicit_a1, |tree| ImplicitA1::<u32, _>::new(tree, Computed(*tree));
    /// `[IMPLICIT-2]`
    implicit_b, |tree| ImplicitB::<u32, _>::new(tree, Computed(*tree));
    /// `[IMPLICIT-2]` `[IMPLICIT-3]`
    implicit_b1, |tree| ImplicitB1::<u32, _>::new(tree, Computed(*tree));
    /// `[LAINE-1]`
    laine<K>, |tree| Laine::<K, u32, _>::new(tree);
    /// `[PAUSE-1]`
    afra_resumed, |tree| Resumed::new(|| Afra::<u32, _>::new(tree), Some);
    /// `[PAUSE-1]`
    sparse_resumed, |tree| Resumed::new(|| Sparse::<u32, _>::new(tree), Some);
    /// `[PAUSE-1]` `[PAUSE-3]`
    uncle_resumed, |tree| Resumed::new(|| Uncle::<u32, _>::new(tree), Some);
    /// `[PAUSE-1]` `[PAUSE-3]`
    hashed_resumed, |tree| {
        Resumed::new(|| Hashed::<u32, _, _>::new(tree, HashedKeys(*tree)), Some)
    };
    /// `[PAUSE-1]` `[PAUSE-2]` `[PAUSE-3]`
    hashed_by_key_and_trail, |tree| {
        let start = || Hashed::<u32, _, _>::new(tree, HashedKeys(*tree));
        Resumed::new(start, by_key_and_trail(*tree))
    };
}

bodies! {
    Never, |choose, shape| Script::any(choose, shape).with_ends(choose, shape);
    /// `[HASHONLY-1]`
    hash_only, |tree| HashOnly::<u32, _, _>::new(tree, Computed(*tree));
}

bodies! {
    Never, |choose, shape| Script::any(choose, shape).left_first();
    /// `[LEFT-1]`
    left_first, |tree| LeftFirst::<u32, _>::new(tree, Computed(*tree));
}

bodies! {
    Disjoint, |choose, shape| Script::any(choose, shape).with_marks(choose, shape);
    /// `[DISJOINT-1]` `[DISJOINT-2]`
    afra_disjoint, |tree| Afra::<u32, _, Disjoint<u32>>::new(tree);
    /// `[DISJOINT-1]` `[DISJOINT-2]`
    sparse_disjoint, |tree| Sparse::<u32, _, Disjoint<u32>>::new(tree);
    /// `[DISJOINT-1]` `[DISJOINT-2]` `[DISJOINT-3]`
    uncle_disjoint, |tree| Uncle::<u32, _, Disjoint<u32>>::new(tree);
    /// `[DISJOINT-1]` `[DISJOINT-2]` `[DISJOINT-3]`
    hashed_disjoint, |tree| {
        Hashed::<u32, _, _, Disjoint<u32>>::new(tree, HashedKeys(*tree))
    };
}

runs! {
    Never, |choose, shape| Script::any(choose, shape).by_node();
    /// `[HAPALA-1]`
    hapala, |tree, told, watch| run(Hapala::new(tree, *told), told, watch);
    /// `[SKIP-1]`
    skip, |tree, told, watch| {
        let skips = Skips::of(tree, told);
        traverse(Skip::new(tree, &skips, *told), told, watch)
    };
}

runs! {
    Never, Script::any;
    /// `[STACK-1]`
    stack, |tree, told, watch| traverse(Stack::new(tree, &mut Vec::new()), told, watch);
}

runs! {
    Never, |choose, shape| Script::any(choose, shape).with_ends(choose, shape);
    /// `[ORACLE-1]`
    oracle, |tree, told, watch| oracle::traverse(tree, told, watch);
}

runs! {
    Disjoint, |choose, shape| Script::any(choose, shape).with_marks(choose, shape);
    /// `[ORACLE-2]`
    oracle_disjoint, |tree, told, watch| {
        oracle::traverse_pruned(tree, tree.root(), Pruning::Disjoint, told, watch)
    };
}
