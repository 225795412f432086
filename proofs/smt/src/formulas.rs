//! The library's bit functions, as a table. A control replaces one of them.

use stackless_bvh::key::{self, Word};
use stackless_bvh::{swap, trail};

use crate::lemma::{Lemma, Query};
use crate::word::Symbolic;

/// The functions under proof, on words of `N` bits.
pub(crate) struct Formulas<const N: u32> {
    pub(crate) root: fn() -> Symbolic<N>,
    pub(crate) child: fn(Symbolic<N>, Symbolic<N>) -> Symbolic<N>,
    pub(crate) parent: fn(Symbolic<N>) -> Symbolic<N>,
    pub(crate) sibling: fn(Symbolic<N>) -> Symbolic<N>,
    pub(crate) trail_child: fn(Symbolic<N>, Symbolic<N>) -> Symbolic<N>,
    pub(crate) levels: fn(&Symbolic<N>) -> Symbolic<N>,
    pub(crate) backtrack: fn(Symbolic<N>, Symbolic<N>) -> (Symbolic<N>, Symbolic<N>),
    pub(crate) leave: fn(Symbolic<N>) -> Symbolic<N>,
    pub(crate) counter: fn(Symbolic<N>, Symbolic<N>) -> Symbolic<N>,
    pub(crate) fcomp: fn(Symbolic<N>, &Symbolic<N>) -> Symbolic<N>,
    pub(crate) fcomp_printed: fn(Symbolic<N>, &Symbolic<N>) -> Symbolic<N>,
    pub(crate) swap_level: fn(Symbolic<N>, &Symbolic<N>) -> Symbolic<N>,
}

impl<const N: u32> Formulas<N> {
    /// Returns the library's functions.
    pub(crate) fn library() -> Self {
        Self {
            root: key::root,
            child: key::child,
            parent: key::parent,
            sibling: key::sibling,
            trail_child: trail::child,
            levels: trail::levels,
            backtrack: trail::backtrack,
            leave: trail::leave,
            counter: trail::counter,
            fcomp: swap::fcomp,
            fcomp_printed: swap::fcomp_printed,
            swap_level: swap::swap_level,
        }
    }
}

/// Builds a lemma: `says` of the library's functions, and of a table that `plant` has changed.
pub(crate) fn lemma<const N: u32>(
    name: &'static str,
    clauses: &'static str,
    says: fn(&Formulas<N>, &mut Query),
    slip: &'static str,
    plant: fn(&mut Formulas<N>),
) -> Lemma {
    let query = move |plant: fn(&mut Formulas<N>)| {
        let (mut formulas, mut query) = (Formulas::library(), Query::default());
        plant(&mut formulas);
        says(&formulas, &mut query);
        query
    };
    let others = Box::new(move || slips().map(query).into());
    Lemma { name, clauses, width: N, slip, library: query(|_| ()), control: query(plant), others }
}

/// Slips for claims that a lemma's own slip does not break.
fn slips<const N: u32>() -> [fn(&mut Formulas<N>); 17] {
    fn up<const N: u32>(trail: Symbolic<N>, more: u64) -> Symbolic<N> {
        let levels = trail.trailing_zeros().wrapping_add(&Symbolic::number(more));
        trail.shr(levels)
    }
    [
        |f| f.root = || Symbolic::number(2),
        |f| f.child = |key, right| key.shl1().xor(&right).xor(&Word::one()),
        |f| f.child = |key, right| key.or(&right),
        |f| f.parent = |key| key,
        |f| f.sibling = |key| key,
        |f| f.sibling = |key| key.xor(&Symbolic::number(2)),
        |f| f.trail_child = |trail, _| trail.shl1(),
        |f| f.levels = |_| Word::one(),
        |f| f.backtrack = |key, trail| (key.shr1(), up(trail, 0)),
        |f| f.backtrack = |key, trail| (key, up(trail, 1).xor(&Word::one())),
        |f| f.leave = |trail| up(trail, 1),
        |f| f.counter = |trail, _| trail,
        |f| f.swap_level = |index, bit| index.shl1().xor(bit),
        |f| f.trail_child = |trail, both| trail.shl1().shl1().or(&both),
        |f| f.backtrack = |key, trail| (key, trail),
        |f| f.counter = |trail, _| trail.shr1(),
        |f| f.fcomp = Word::and,
    ]
}

/// Adds without carries, which is often mistaken for exclusive or.
pub(crate) fn plus<const N: u32>(a: Symbolic<N>, b: &Symbolic<N>) -> Symbolic<N> {
    a.wrapping_add(b)
}
