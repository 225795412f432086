//! Lemmas about the swap mask.

use stackless_bvh::key::Word;

use crate::formulas::{Formulas, lemma, plus};
use crate::lemma::{Lemma, Query};
use crate::word::Symbolic;

/// Returns all lemmas for words of `N` bits.
pub(crate) fn lemmas<const N: u32>() -> Vec<Lemma> {
    vec![
        lemma::<N>("a level swap toggles a bit", "[SWAP-1]", toggles, "x + 2^n", |f| f.swap_level = plus),
        lemma::<N>("fcomp as printed is fcomp", "[SWAP-2] [SWAP-3]", printed, "x + m - (x & m)", |f| {
            f.fcomp_printed = |index, mask| {
                let common = index.clone().and(mask);
                index.wrapping_add(mask).wrapping_sub(&common)
            };
        }),
        lemma::<N>("two level swaps commute", "[SWAP-4]", commute, "(x xor 2^n) - 2^n", |f| {
            f.swap_level = |index, bit| index.xor(bit).wrapping_sub(bit);
        }),
        lemma::<N>("fcomp of disjoint masks composes", "[SWAP-4]", composes, "& for xor", |f| f.fcomp = Word::and),
        lemma::<N>("fcomp by one swap and the rest", "[SWAP-3] [SWAP-4]", peel, "| for xor", |f| f.fcomp = Word::or),
        lemma::<N>("fcomp of a key swaps its level's index", "[SWAP-3] [IMPLICIT-3]", of_key, "x + m", |f| {
            f.fcomp = plus;
        }),
    ]
}

fn toggles<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let (index, bit) = (q.word::<N>("index"), q.word::<N>("bit"));
    q.assume(bit.is_power());
    let swapped = (f.swap_level)(index.clone(), &bit);
    q.claim("the bit is the other one", swapped.clone().and(&bit).is(&index.clone().and(&bit)).not());
    q.claim("the others stay", swapped.clone().or(&bit).is(&index.clone().or(&bit)));
    q.claim("twice is nothing", (f.swap_level)(swapped, &bit).is(&index));
}

fn printed<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let (index, mask) = (q.word::<N>("index"), q.word::<N>("mask"));
    q.claim("x + m - 2 (x & m) = x xor m", (f.fcomp_printed)(index.clone(), &mask).is(&(f.fcomp)(index, &mask)));
}

fn commute<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let (index, a, b) = (q.word::<N>("index"), q.word::<N>("a"), q.word::<N>("b"));
    q.assume(a.is_power());
    q.assume(b.is_power());
    let (ab, ba) =
        ((f.swap_level)((f.swap_level)(index.clone(), &a), &b), (f.swap_level)((f.swap_level)(index, &b), &a));
    q.claim("either order gives the same", ab.is(&ba));
}

fn composes<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let (index, a, b) = (q.word::<N>("index"), q.word::<N>("a"), q.word::<N>("b"));
    q.assume(a.clone().and(&b).is_number(0));
    let parts = (f.fcomp)((f.fcomp)(index.clone(), &a), &b);
    q.claim("fcomp(x, a | b) = fcomp(fcomp(x, a), b)", (f.fcomp)(index, &a.or(&b)).is(&parts));
}

/// Proves `swap_levels` by induction on the bits of the mask, in any order. If any bit is swapped first, the remaining
/// mask applies `fcomp`; an empty mask changes nothing.
fn peel<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let (index, mask, bit) = (q.word::<N>("index"), q.word::<N>("mask"), q.word::<N>("bit"));
    q.assume(bit.is_power());
    q.assume(mask.clone().and(&bit).is(&bit));
    let rest = mask.clone().xor(&bit);
    let peeled = (f.fcomp)((f.swap_level)(index.clone(), &bit), &rest);
    q.claim("fcomp(x, m) = fcomp(swap(x, bit), m without the bit)", (f.fcomp)(index.clone(), &mask).is(&peeled));
    q.claim("fcomp(x, 0) = x", (f.fcomp)(index.clone(), &Symbolic::zero()).is(&index));
}

fn of_key<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let (start, index, mask) = (q.word::<N>("start"), q.word::<N>("index"), q.word::<N>("mask"));
    q.assume(start.is_power());
    q.assume(index.less(&start));
    q.assume(mask.less(&start));
    let apart = start.clone().or(&(f.fcomp)(index.clone(), &mask));
    let combined = (f.fcomp)(start.clone().wrapping_add(&index), &mask);
    q.claim("fcomp(start + x, m) = start | fcomp(x, m)", combined.is(&apart));
    q.claim("the level's start stays", combined.xor(&start).less(&start));
}
