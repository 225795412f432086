//! Proves that one step of each cursor, from any state of a traversal, is the step of the machine in Rocq.
//!
//! Keys and trails have all their bits, and trees have any size. A step reads only the nodes on the path to the root,
//! which [`Ladder`] computes. The state is resumed from [`Paused`] and satisfies only the invariant: its bits are below
//! the depth, and the register has the next node or, unless the sibling is postponed, nothing. Then *one* call of
//! `descend`, `backtrack`, `prune` or `put_aside` is compared with [`Machine`]. Induction in Rocq proves that all steps
//! together equal the reference (`proofs/SOUNDNESS.md`).

mod ladder;
mod machine;

use stackless_bvh::hash::Lookup;
use stackless_bvh::order::{Descent, Side};
use stackless_bvh::traverse::Disjoint;
use stackless_bvh::traverse::{Afra, HashOnly, Hashed, Incomplete, Next, Pause, Paused, Sparse, Uncle};
use stackless_bvh::tree::Node;

use crate::bits::Full;
use crate::harness::{claim, harnesses};
use crate::{Choose, cover};
pub use ladder::Ladder;
pub use machine::{Machine, Wanted};

harnesses! {
    /// One step of key and trail with a table of all keys equals the machine's step. `[TRAIL-7]` `[HASHONLY-1]`
    step_hash_only_u64, step_hash_only_u64_twin, 5 => hash_only::<u64>;
    /// For u128. `[TRAIL-7]` `[HASHONLY-1]`
    step_hash_only_u128, step_hash_only_u128_twin, 5 long => hash_only::<u128>;
    /// One step of Algorithm 1 equals the machine's step, and looks up only nodes that no record names. `[HASHED-1]`
    /// `[REGISTER-1]` `[REGISTER-2]` `[PAUSE-1]` `[PAUSE-3]`
    step_hashed_u64, step_hashed_u64_twin, 5 => hashed::<u64, 2, 2>;
    /// For u128. `[HASHED-1]` `[REGISTER-1]` `[REGISTER-2]` `[PAUSE-1]` `[PAUSE-3]`
    step_hashed_u128, step_hashed_u128_twin, 5 => hashed::<u128, 2, 2>;
    /// With three uncles in the records of leaves. `[HASHED-1]` `[REGISTER-1]` `[REGISTER-2]` `[PAUSE-3]`
    step_hashed_3_u64, step_hashed_3_u64_twin, 5 => hashed::<u64, 2, 3>;
    /// One step of Algorithm 1 with a second trail equals the machine's step. `[DISJOINT-1]` `[DISJOINT-2]` `[DISJOINT-3]` `[HASHED-1]`
    step_hashed_disjoint_u64, step_hashed_disjoint_u64_twin, 5 => hashed_disjoint::<u64, 2, 2>;
    /// For u128. `[DISJOINT-1]` `[DISJOINT-2]` `[DISJOINT-3]` `[HASHED-1]`
    step_hashed_disjoint_u128, step_hashed_disjoint_u128_twin, 5 => hashed_disjoint::<u128, 2, 2>;
    /// One step of the climb by grand uncles, up to the limit of words, equals the machine's step. `[UNCLE-2]`
    /// `[REGISTER-1]` `[REGISTER-2]` `[PAUSE-1]` `[PAUSE-3]`
    step_uncle_u64, step_uncle_u64_twin, 34 => uncle::<u64, 2, 2>;
    /// For u128. `[UNCLE-2]` `[REGISTER-1]` `[REGISTER-2]` `[PAUSE-1]` `[PAUSE-3]`
    step_uncle_u128, step_uncle_u128_twin, 66 kani => uncle::<u128, 2, 2>;
    /// The climb by grand uncles with a second trail. `[UNCLE-2]` `[DISJOINT-1]` `[DISJOINT-2]` `[DISJOINT-3]`
    step_uncle_disjoint_u64, step_uncle_disjoint_u64_twin, 34 long => uncle_disjoint::<u64, 2, 2>;
    /// For u128. `[UNCLE-2]` `[DISJOINT-1]` `[DISJOINT-2]` `[DISJOINT-3]`
    step_uncle_disjoint_u128, step_uncle_disjoint_u128_twin, 66 kani => uncle_disjoint::<u128, 2, 2>;
    /// One step of the climb by parents equals the machine's step. `[AFRA-1]` `[PAUSE-1]`
    step_afra_u64, step_afra_u64_twin, 66 => afra::<u64>;
    /// For u128. `[AFRA-1]` `[PAUSE-1]`
    step_afra_u128, step_afra_u128_twin, 130 long => afra::<u128>;
    /// The climb by parents with a second trail. `[AFRA-1]` `[DISJOINT-1]` `[DISJOINT-2]`
    step_afra_disjoint_u64, step_afra_disjoint_u64_twin, 66 => afra_disjoint::<u64>;
    /// For u128. `[AFRA-1]` `[DISJOINT-1]` `[DISJOINT-2]`
    step_afra_disjoint_u128, step_afra_disjoint_u128_twin, 130 long => afra_disjoint::<u128>;
    /// One step of the counter equals the machine's step. `[SPARSE-1]` `[TRAIL-6]` `[PAUSE-1]`
    step_sparse_u64, step_sparse_u64_twin, 66 => sparse::<u64>;
    /// For u128. `[SPARSE-1]` `[TRAIL-6]` `[PAUSE-1]`
    step_sparse_u128, step_sparse_u128_twin, 130 long => sparse::<u128>;
    /// The counter with a second trail. `[SPARSE-1]` `[TRAIL-6]` `[DISJOINT-1]` `[DISJOINT-2]`
    step_sparse_disjoint_u64, step_sparse_disjoint_u64_twin, 66 => sparse_disjoint::<u64>;
    /// For u128. `[SPARSE-1]` `[TRAIL-6]` `[DISJOINT-1]` `[DISJOINT-2]`
    step_sparse_disjoint_u128, step_sparse_disjoint_u128_twin, 130 long => sparse_disjoint::<u128>;
}

/// The visible state of a cursor.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is kept or not, apart from the others")]
struct Keeps {
    key: bool,
    register: bool,
    counter: bool,
    marks: bool,
}

const TRAIL: Keeps = Keeps { key: false, register: false, counter: false, marks: false };
const KEY: Keeps = Keeps { key: true, ..TRAIL };
const COUNTER: Keeps = Keeps { counter: true, ..TRAIL };
const REGISTER: Keeps = Keeps { register: true, ..TRAIL };
const BOTH: Keeps = Keeps { key: true, register: true, ..TRAIL };

impl Keeps {
    const fn marked(self) -> Self {
        Self { marks: true, ..self }
    }
}

/// One call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Call {
    Descend,
    Backtrack,
    Prune,
    /// Pauses, which must fail if the state lacks a necessary register.
    PutAside,
}

/// Any state of a traversal, and the call there.
#[derive(Clone, Copy, Debug)]
struct Any<W, const UI: u32, const UL: u32> {
    ladder: Ladder<W, UI, UL>,
    machine: Machine,
    key: W,
    trail: W,
    marks: W,
    call: Call,
    keeps: Keeps,
}

/// Returns the number of bits.
fn length(number: u128) -> u32 {
    128 - number.leading_zeros()
}

impl<W: Full + Into<u128>, const UI: u32, const UL: u32> Any<W, UI, UL> {
    fn choose(choose: &mut impl Choose, keeps: Keeps) -> Option<Self> {
        let width = W::WIDTH?;
        let call = [Call::Descend, Call::Backtrack, Call::Prune, Call::PutAside][choose.bits(2) as usize];
        choose.assume(call != Call::Prune || keeps.marks)?;
        // A key and a counter have a bit above those of the levels. A trail alone is as long as the tree is deep.
        let (key, limit): (W, u32) = (choose.any(), if keeps.key || keeps.counter { width - 1 } else { width });
        choose.assume(key > W::zero() || limit == width)?;
        let depth = length(key.into()) + limit - width;
        choose.assume(call != Call::Descend || depth < limit)?;
        let ladder = Ladder {
            node_depth: depth,
            limit,
            is_leaf: call == Call::Prune || call != Call::Descend && choose.any::<bool>(),
            leaf_children: [choose.any(), choose.any()],
            leaf_siblings: choose.any(),
        };
        let [trail, marks] = [(); 2].map(|()| choose.any::<W>());
        let below = if depth == 0 { W::zero() } else { W::zero().wrapping_sub(&W::one()).shr(width - depth) };
        let (trail, marks) = (trail.and(&below), if keeps.marks { marks.and(&below) } else { W::zero() });
        let number = if keeps.key { key.into() } else { 0 };
        let mut machine = Machine {
            node: ladder.node(),
            depth,
            key: number,
            trail: trail.into(),
            marks: marks.into(),
            register: None,
        };
        // `holds` of Register.v.
        if keeps.register && machine.trail != 0 && (machine.trail % 2 == 1 || choose.any::<bool>()) {
            machine.register = Some(machine.next(&ladder));
        }
        Some(Self { ladder, machine, key, trail, marks, call, keeps })
    }

    /// Returns the state as one traversal leaves it for another.
    fn paused(&self) -> Paused<W> {
        Paused {
            node: self.machine.node,
            register: self.machine.register,
            key: self.keeps.key.then_some(self.key),
            trail: self.trail,
            disjoint: self.keeps.marks.then_some(self.marks),
            next: Next::Visit,
        }
    }
}

/// A table with one key, which is looked up only if no record has the node.
#[derive(Clone, Copy, Debug)]
struct Table {
    is_asked: bool,
    key: u128,
    node: Node,
}

impl<W: Full + Into<u128>> Lookup<W> for Table {
    fn node(&self, key: &W) -> Node {
        assert!(self.is_asked && (*key).into() == self.key);
        self.node
    }
}

impl<W: Full + Into<u128>, const UI: u32, const UL: u32> Any<W, UI, UL> {
    /// Returns the machine's lookup; `asks` of Register.v.
    fn table(&self) -> Table {
        let reach = if self.ladder.is_leaf { UL } else { UI };
        let is_asked = !self.keeps.register || self.machine.filled(&self.ladder, reach).is_none();
        let next = self.machine.backtrack(&self.ladder).unwrap_or(self.machine);
        Table { is_asked, key: next.key, node: next.node }
    }

    /// Runs one call of the cursor, and of the machine.
    fn step(&self, choose: &mut impl Choose, mut cursor: impl Pause<Word = W>) -> Option<()> {
        let Self { ladder, machine, keeps, call, .. } = self;
        let (width, levels) = (W::WIDTH?, machine.levels());
        assert!(cursor.take_up(self.paused()).is_ok());
        let expected = match call {
            Call::Descend => {
                let wanted = Wanted {
                    first: Side::right_if(choose.any()),
                    both: choose.any(),
                    mark: keeps.marks && choose.any::<bool>(),
                };
                cover!(choose, machine.depth == ladder.limit - 1, "down to the greatest depth");
                let Wanted { first, both, mark } = wanted;
                let descent = if both { Descent::both(first) } else { Descent::only(first) };
                assert!(cursor.descend(descent.disjoint_if(mark)));
                machine.descend(ladder, wanted)
            }
            Call::Backtrack => {
                cover!(choose, machine.trail == 0, "the end");
                let is_far = machine.depth == ladder.limit && machine.trail != 0 && levels >= width / 2;
                cover!(choose, is_far, "from the greatest depth over half of the word");
                let next = machine.backtrack(ladder);
                assert!(cursor.backtrack() == next.is_some());
                // The state of a cursor at its end is not used.
                let next = next?;
                choose.plant(next, |next| if is_far { Machine { trail: next.trail | 1, ..next } } else { next })
            }
            Call::Prune => {
                let pruned = machine.prune();
                cover!(choose, pruned.trail != 0 && pruned.levels() > levels, "the next node is another one");
                cursor.prune();
                pruned
            }
            Call::PutAside => {
                let lost = keeps.register && machine.trail % 2 == 1;
                cover!(choose, lost || !keeps.register, "a state that needs its register, if there is one");
                if lost {
                    let refused = cursor.take_up(Paused { register: None, ..self.paused() });
                    assert!(refused == Err(Incomplete::Register));
                }
                *machine
            }
        };
        self.compare(expected, &cursor);
        Some(())
    }

    /// Compares the visible state of the cursor.
    fn compare(&self, expected: Machine, cursor: &impl Pause<Word = W>) {
        let keeps = self.keeps;
        let Paused { node, register, key, trail, disjoint, next } = cursor.put_aside(Next::Backtrack);
        assert!(node == expected.node && cursor.node() == node && next == Next::Backtrack);
        assert!(register == if keeps.register { expected.register } else { None });
        assert!(key.map(Into::into) == keeps.key.then_some(expected.key));
        assert!(disjoint.map(Into::into) == keeps.marks.then_some(expected.marks));
        claim!(trail.into() == expected.trail);
        assert!(cursor.state().counter.map(Into::into) == keeps.counter.then(|| expected.counter()));
    }
}

/// A cursor, with its visible state.
macro_rules! bodies {
    ($($(#[$doc:meta])* $name:ident $(<$ui:ident, $ul:ident>)?, $keeps:expr, |$tree:ident, $table:ident| $cursor:expr;)*) => {$(
        $(#[$doc])*
        pub fn $name<W: Full + Into<u128> $(, const $ui: u32, const $ul: u32)?>(choose: &mut impl Choose) -> Option<()> {
            let any = bodies!(choose $($ui $ul)?)(choose, $keeps)?;
            let ($tree, $table) = (&any.ladder, any.table());
            let Ok(cursor) = $cursor else { panic!("the tree is refused") };
            any.step(choose, cursor)
        }
    )*};
    (choose $ui:ident $ul:ident) => { Any::<W, $ui, $ul>::choose };
    (choose) => { Any::<W, 2, 2>::choose };
}

bodies! {
    /// `[TRAIL-7]` `[HASHONLY-1]`
    hash_only, KEY, |tree, table| HashOnly::<W, _, _>::new(tree, table);
    /// `[HASHED-1]` `[REGISTER-1]` `[REGISTER-2]` `[PAUSE-1]` `[PAUSE-3]`
    hashed<UI, UL>, BOTH, |tree, table| Hashed::<W, _, _>::new(tree, table);
    /// `[HASHED-1]` `[DISJOINT-1]` `[DISJOINT-2]` `[DISJOINT-3]`
    hashed_disjoint<UI, UL>, BOTH.marked(), |tree, table| Hashed::<W, _, _, Disjoint<W>>::new(tree, table);
    /// `[UNCLE-2]` `[REGISTER-1]` `[REGISTER-2]` `[PAUSE-1]` `[PAUSE-3]`
    uncle<UI, UL>, REGISTER, |tree, _table| Uncle::<W, _>::new(tree);
    /// `[UNCLE-2]` `[DISJOINT-1]` `[DISJOINT-2]` `[DISJOINT-3]`
    uncle_disjoint<UI, UL>, REGISTER.marked(), |tree, _table| Uncle::<W, _, Disjoint<W>>::new(tree);
    /// `[AFRA-1]` `[PAUSE-1]`
    afra, TRAIL, |tree, _table| Afra::<W, _>::new(tree);
    /// `[AFRA-1]` `[DISJOINT-1]` `[DISJOINT-2]`
    afra_disjoint, TRAIL.marked(), |tree, _table| Afra::<W, _, Disjoint<W>>::new(tree);
    /// `[SPARSE-1]` `[TRAIL-6]` `[PAUSE-1]`
    sparse, COUNTER, |tree, _table| Sparse::<W, _>::new(tree);
    /// `[SPARSE-1]` `[TRAIL-6]` `[DISJOINT-1]` `[DISJOINT-2]`
    sparse_disjoint, COUNTER.marked(), |tree, _table| Sparse::<W, _, Disjoint<W>>::new(tree);
}
