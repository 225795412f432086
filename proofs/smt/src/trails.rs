//! Lemmas about trails and counters.

use stackless_bvh::key::Word;
use z3::ast::Bool;

use crate::formulas::{Formulas, lemma, plus};
use crate::lemma::{Lemma, Query};
use crate::word::Symbolic;

/// Returns all lemmas for words of `N` bits.
pub(crate) fn lemmas<const N: u32>() -> Vec<Lemma> {
    vec![
        lemma::<N>("trail of a child", "[TRAIL-1] [TRAIL-2]", descend, "shift left out", |f| {
            f.trail_child = |trail, both| trail.or(&both);
        }),
        lemma::<N>("descend, then backtrack", "[TRAIL-2] [TRAIL-4]", descend_and_back, "no xor on the trail", |f| {
            f.backtrack = |key, trail| {
                let up = trail.trailing_zeros();
                (key.shr(up.clone()).xor(&Word::one()), trail.shr(up))
            };
        }),
        lemma::<N>("levels", "[TRAIL-3]", levels, "zeros of t / 2", |f| {
            f.levels = |trail| trail.clone().shr1().trailing_zeros();
        }),
        lemma::<N>("backtrack", "[TRAIL-4]", backtrack, "+ for xor on the key", |f| {
            f.backtrack = |key, trail| {
                let up = trail.trailing_zeros();
                (plus(key.shr(up.clone()), &Word::one()), trail.shr(up).xor(&Word::one()))
            };
        }),
        lemma::<N>("one step of the climb", "[TRAIL-5]", climb, "the key a level too far", |f| {
            f.backtrack = |key, trail| {
                let up = trail.trailing_zeros();
                (key.shr1().shr(up.clone()).xor(&Word::one()), trail.shr(up).xor(&Word::one()))
            };
        }),
        lemma::<N>("counter", "[TRAIL-6]", counter, "complement of all but the start", |f| {
            f.counter = |trail, start| trail.xor(&start);
        }),
        lemma::<N>("counter + 1", "[TRAIL-6]", increment, "start - 2", |f| {
            f.counter = |trail, start| trail.xor(&start.wrapping_sub(&Word::one()).wrapping_sub(&Word::one()));
        }),
        lemma::<N>("counter of a child", "[TRAIL-6] [SPARSE-1]", counter_descends, "- for xor, from the start", |f| {
            f.counter = |trail, start| start.wrapping_sub(&trail);
        }),
        lemma::<N>(
            "counter after backtracking",
            "[TRAIL-6] [SPARSE-1]",
            counter_backtracks,
            "trail left as it was",
            |f| {
                f.leave = |trail| {
                    let up = trail.trailing_zeros();
                    trail.shr(up)
                };
            },
        ),
    ]
}

fn descend<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let (trail, both, i) = (q.word::<N>("trail"), q.bit::<N>("both"), q.word::<N>("i"));
    let child = (f.trail_child)(trail.clone(), both.clone());
    q.claim("bit 0 is the child's own sibling", child.clone().and(&Word::one()).is(&both));
    let next = i.clone().wrapping_add(&Word::one());
    q.assume(next.less(&Symbolic::number(N.into())));
    q.assume(next.is_number(0).not());
    let bit = |word: Symbolic<N>, i| word.shr(i).and(&Word::one());
    q.claim("bit i + 1 is the parent's bit i", bit(child, next).is(&bit(trail, i)));
}

fn descend_and_back<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let (key, trail, right) = (q.word::<N>("key"), q.word::<N>("trail"), q.bit::<N>("right"));
    let first = (f.child)(key, right);
    let (back, left) = (f.backtrack)(first.clone(), (f.trail_child)(trail.clone(), Word::one()));
    q.claim("the postponed sibling comes next", back.is(&(f.sibling)(first)));
    q.claim("and is no longer postponed", left.is(&(f.trail_child)(trail, Word::zero())));
}

fn levels<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let trail = q.word::<N>("trail");
    q.assume(trail.is_number(0).not());
    let up = (f.levels)(&trail);
    let above = trail.clone().shr(up.clone());
    q.claim("bit n is set", above.clone().and(&Word::one()).is_number(1));
    q.claim("and none below it", above.shl(&up).is(&trail));
}

fn backtrack<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let (key, trail) = (q.word::<N>("key"), q.word::<N>("trail"));
    q.assume(trail.is_number(0).not());
    let up = (f.levels)(&trail);
    let (next, left) = (f.backtrack)(key.clone(), trail.clone());
    q.claim("the key is the sibling of the ancestor n levels up", next.is(&(f.sibling)(key.shr(up.clone()))));
    q.claim("bit 0 of the trail is clear", left.clone().and(&Word::one()).is_number(0));
    let rest = trail.clone().and(&trail.clone().wrapping_sub(&Word::one()));
    q.claim("and the other bits are those above n", left.shl(&up).is(&rest));
    q.claim("leave is its half", left.is(&(f.leave)(trail)));
}

/// Proves `backtrack_climbing` by induction on its iterations. While bit 0 is clear, both words go up a level, and the
/// constant-time form gives an equal result from there. If bit 0 is set, both toggle. `levels` counts the iterations,
/// so the loop ends.
fn climb<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let (key, trail) = (q.word::<N>("key"), q.word::<N>("trail"));
    let pending = trail.clone().and(&Word::one()).is_number(1);
    // For a set bit 0 the step uses another nonzero trail, so this one has no requirements.
    let up = Symbolic(pending.ite(&trail.0, &trail.clone().shr1().0));
    q.assume(trail.is_number(0).not());
    let (next, left) = (f.backtrack)(key.clone(), trail.clone());
    let (above, rest) = (f.backtrack)((f.parent)(key.clone()), up.clone());
    let toggled = |new: &Symbolic<N>, old: &Symbolic<N>| new.is(&old.clone().xor(&Word::one()));
    q.claim("bit 0 set: the key toggles", pending.implies(toggled(&next, &key)));
    q.claim("bit 0 set: the trail toggles", pending.implies(toggled(&left, &trail)));
    q.claim("bit 0 set: no level is climbed", pending.implies((f.levels)(&trail).is_number(0)));
    q.claim("bit 0 clear: the same key as a level up", Bool::or(&[pending.clone(), next.is(&above)]));
    q.claim("bit 0 clear: the same trail as a level up", Bool::or(&[pending.clone(), left.is(&rest)]));
    let fewer = (f.levels)(&up).wrapping_add(&Word::one()).is(&(f.levels)(&trail));
    q.claim("bit 0 clear: a level less from there", Bool::or(&[pending, fewer]));
}

/// Returns the trail of a node, and two to the power of the node's depth, which is at most W - 1.
pub(crate) fn trail_and_start<const N: u32>(q: &mut Query) -> (Symbolic<N>, Symbolic<N>) {
    let (trail, start) = (q.word::<N>("trail"), q.word::<N>("start"));
    q.assume(start.is_power());
    q.assume(trail.less(&start));
    (trail, start)
}

fn counter<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let (trail, start) = trail_and_start::<N>(q);
    let counter = (f.counter)(trail.clone(), start.clone());
    let last = start.clone().wrapping_sub(&Word::one());
    q.claim("it is below the level start", counter.less(&start));
    q.claim("counter and trail share no bit", counter.clone().and(&trail).is_number(0));
    q.claim("and have all below the depth", counter.clone().or(&trail).is(&last));
    q.claim("all ones where the trail is 0, and only there", counter.is(&last).iff(trail.is_number(0)));
    q.claim("it is its own inverse", (f.counter)(counter, start).is(&trail));
}

fn increment<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let (trail, start) = trail_and_start::<N>(q);
    q.assume(trail.is_number(0).not());
    let next = (f.counter)(trail.clone(), start.clone()).wrapping_add(&Word::one());
    q.claim("no carry leaves the level", next.less(&start));
    q.claim("ctz(counter + 1) = ctz(trail)", (f.levels)(&next).is(&(f.levels)(&trail)));
}

fn counter_descends<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let (trail, start) = trail_and_start::<N>(q);
    let both = q.bit::<N>("both");
    q.assume(start.less(&Symbolic::highest()));
    let below = (f.counter)((f.trail_child)(trail.clone(), both.clone()), start.clone().shl1());
    let rejected = both.xor(&Word::one());
    let counted = (f.trail_child)((f.counter)(trail, start), rejected);
    q.claim("it takes a 1 where a child is rejected", below.is(&counted));
}

/// Returns the levels that a nonzero trail climbs, as an unknown. All shifts share it, so the solver need not compare
/// counts of zeros.
pub(crate) fn climbed<const N: u32>(q: &mut Query, trail: &Symbolic<N>) -> Symbolic<N> {
    let up = q.word::<N>("levels");
    q.assume(up.less(&Symbolic::number(N.into())));
    let above = Symbolic(trail.0.bvlshr(&up.0));
    q.assume(above.shl(&up).is(trail));
    q.assume(above.and(&Word::one()).is_number(1));
    up
}

fn counter_backtracks<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let (trail, start) = trail_and_start::<N>(q);
    let up = climbed(q, &trail);
    let next = (f.counter)(trail.clone(), start.clone()).wrapping_add(&Word::one());
    q.claim("counter + 1 climbs as far as the trail", (f.levels)(&next).is(&up));
    let left = trail.clone().shr(up.clone()).xor(&Word::one());
    q.claim("the trail left", (f.leave)(trail).is(&left));
    let above = start.shr(up.clone());
    q.step("is one of the level above", left.less(&above));
    q.claim("(c + 1) >> n is its counter", next.shr(up).is(&(f.counter)(left, above)));
}
