//! The library's bit functions, as a table in which a control replaces one.

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
    /// Those of the library.
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

/// A lemma about these functions: `says` of the library's, and of a table that `plant` has changed.
pub(crate) fn lemma<const N: u32>(
    name: &'static str,
    clauses: &'static str,
    says: fn(&Formulas<N>, &mut Query),
    slip: &'static str,
    plant: fn(&mut Formulas<N>),
) -> Lemma {
    let query = |formulas: &Formulas<N>| {
        let mut query = Query::default();
        says(formulas, &mut query);
        query
    };
    let mut planted = Formulas::library();
    plant(&mut planted);
    Lemma { name, clauses, width: N, slip, library: query(&Formulas::library()), control: query(&planted) }
}

/// The addition without carries that an exclusive or is often mistaken for.
pub(crate) fn plus<const N: u32>(a: Symbolic<N>, b: &Symbolic<N>) -> Symbolic<N> {
    a.wrapping_add(b)
}
