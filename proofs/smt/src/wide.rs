//! Lemmas about keys and trails of wide trees.

use stackless_bvh::key::{self, Word};
use stackless_bvh::{trail, wide};
use z3::ast::BV;

use crate::lemma::{Lemma, Query};
use crate::word::Symbolic;

/// The functions under proof, on words of `N` bits, for nodes of `A` children.
struct Wide<const A: usize, const N: u32> {
    child: fn(Symbolic<N>, Symbolic<N>) -> Symbolic<N>,
    ancestor: fn(Symbolic<N>, Symbolic<N>) -> Symbolic<N>,
    leave: fn(Symbolic<N>, &Symbolic<N>) -> Symbolic<N>,
    back: fn(Symbolic<N>) -> (Symbolic<N>, Symbolic<N>, Symbolic<N>),
    sibling: fn(Symbolic<N>) -> Symbolic<N>,
}

impl<const A: usize, const N: u32> Wide<A, N> {
    /// Returns the library's functions.
    fn library() -> Self {
        Self {
            child: wide::child_key::<A, Symbolic<N>>,
            ancestor: wide::ancestor_key::<A, Symbolic<N>>,
            leave: wide::leave::<A, Symbolic<N>>,
            back: wide::back::<A, Symbolic<N>>,
            sibling: key::sibling,
        }
    }

    /// Returns an unknown word with room for `bits` more bits.
    fn room_for(q: &mut Query, name: &'static str, bits: u32) -> Symbolic<N> {
        let word = q.word::<N>(name);
        q.assume(word.less(&Symbolic(BV::from_u64(1, N).bvshl(BV::from_u64(u64::from(N - bits), N)))));
        word
    }

    fn lemma(
        name: &'static str,
        clauses: &'static str,
        says: fn(&Self, &mut Query),
        slip: &'static str,
        plant: fn(&mut Self),
    ) -> Lemma {
        let query = move |plant: fn(&mut Self)| {
            let (mut formulas, mut query) = (Self::library(), Query::default());
            plant(&mut formulas);
            says(&formulas, &mut query);
            query
        };
        let others = Box::new(move || Self::slips().map(query).into());
        Lemma { name, clauses, width: N, slip, library: query(|_| ()), control: query(plant), others }
    }

    /// Slips for claims that a lemma's own slip does not break.
    fn slips() -> [fn(&mut Self); 6] {
        [
            |f| f.child = |key, slot| wide::child_key::<A, _>(key, slot).xor(&Word::one()),
            |f| f.ancestor = |key, _| key.shr1(),
            |f| f.leave = |trail, pending| wide::leave::<A, _>(trail.xor(&Word::one()), pending),
            |f| f.back = |trail| (Word::zero(), trail.clone(), trail),
            |f| f.back = |trail| (trail.clone(), Word::zero(), trail),
            |f| f.sibling = |key| key.wrapping_add(&Word::one()),
        ]
    }
}

/// Returns all lemmas for words of `N` bits.
pub(crate) fn lemmas<const N: u32>() -> Vec<Lemma> {
    let of = [
        of_slots::<2, N>(["child of 2", "ancestor of 2", "2: leave, then back", "2: back past an empty group"]),
        of_slots::<4, N>(["child of 4", "ancestor of 4", "4: leave, then back", "4: back past an empty group"]),
        of_slots::<8, N>(["child of 8", "ancestor of 8", "8: leave, then back", "8: back past an empty group"]),
    ];
    let binary = Wide::<2, N>::lemma("2: the binary trail", "[WIDE-12]", binary, "the group cut to a bit", |f| {
        f.back = |trail| {
            let (up, pending, rest) = wide::back::<2, _>(trail);
            (up, pending.and(&Word::one()), rest)
        };
    });
    of.into_iter().flatten().chain([binary]).collect()
}

fn of_slots<const A: usize, const N: u32>(names: [&'static str; 4]) -> [Lemma; 4] {
    [
        Wide::<A, N>::lemma(names[0], "[WIDE-9]", child, "shift by a bit too many", |f| {
            f.child = |key, slot| wide::child_key::<A, _>(key.shl1(), slot);
        }),
        Wide::<A, N>::lemma(names[1], "[WIDE-9]", ancestor, "a level further", |f| {
            f.ancestor = |key, levels| wide::ancestor_key::<A, _>(key, levels.wrapping_add(&Word::one()));
        }),
        Wide::<A, N>::lemma(names[2], "[WIDE-10] [WIDE-11]", leave_and_back, "the group stays in the trail", |f| {
            f.back = |trail| {
                let (up, pending, rest) = wide::back::<A, _>(trail);
                let left = wide::leave::<A, _>(rest, &pending);
                (up, pending, left)
            };
        }),
        Wide::<A, N>::lemma(names[3], "[WIDE-11]", past_empty, "zeros rounded up", |f| {
            f.back = |trail| {
                let up = plus(trail.trailing_zeros(), A as u64 - 1) >> A.ilog2();
                let (_, pending, rest) = wide::back::<A, _>(trail);
                (up, pending, rest)
            };
        }),
    ]
}

fn plus<const N: u32>(word: Symbolic<N>, number: u64) -> Symbolic<N> {
    word.wrapping_add(&Symbolic::number(number))
}

fn slot<const A: usize, const N: u32>(q: &mut Query) -> Symbolic<N> {
    let slot = q.word::<N>("slot");
    q.assume(slot.less(&Symbolic::number(A as u64)));
    slot
}

fn child<const A: usize, const N: u32>(f: &Wide<A, N>, q: &mut Query) {
    let (key, slot) = (Wide::<A, N>::room_for(q, "key", A.ilog2()), slot::<A, N>(q));
    let child = (f.child)(key.clone(), slot.clone());
    let times = key.wide().bvmul(BV::from_u64(A as u64, 2 * N));
    q.claim("it is k A + s, without a carry out of the word", child.wide().eq(times.bvadd(slot.wide())));
    q.claim("the ancestor a level up is k", (f.ancestor)(child.clone(), Word::one()).is(&key));
    q.claim("the lowest bits are the slot", child.and(&Symbolic::number(A as u64 - 1)).is(&slot));
}

/// By induction: the ancestor one level further above the child is the node's own.
fn ancestor<const A: usize, const N: u32>(f: &Wide<A, N>, q: &mut Query) {
    let (key, slot) = (Wide::<A, N>::room_for(q, "key", A.ilog2()), slot::<A, N>(q));
    let levels = q.word::<N>("levels");
    q.assume(levels.less(&Symbolic::number(u64::from((N - 1) / A.ilog2()))));
    q.claim("none up it is the node", (f.ancestor)(key.clone(), Word::zero()).is(&key));
    let above = (f.ancestor)((f.child)(key.clone(), slot), plus(levels.clone(), 1));
    q.claim("n + 1 above the child is n above the node", above.is(&(f.ancestor)(key, levels)));
}

fn leave_and_back<const A: usize, const N: u32>(f: &Wide<A, N>, q: &mut Query) {
    let (trail, pending) = (Wide::<A, N>::room_for(q, "trail", A as u32), q.word::<N>("pending"));
    q.assume(pending.is_number(0).not());
    q.assume(pending.less(&Symbolic::number(1 << A)));
    let (up, set, rest) = (f.back)((f.leave)(trail.clone(), &pending));
    q.claim("a level up", up.is_number(1));
    q.claim("are the pending children", set.is(&pending));
    q.claim("and the trail is that of before", rest.is(&trail));
}

fn past_empty<const A: usize, const N: u32>(f: &Wide<A, N>, q: &mut Query) {
    let trail = Wide::<A, N>::room_for(q, "trail", A as u32);
    q.assume(trail.is_number(0).not());
    let (up, set, rest) = (f.back)(trail.clone());
    let (more, same, left) = (f.back)((f.leave)(trail, &Word::zero()));
    q.claim("a level more", more.is(&plus(up.clone(), 1)));
    q.claim("the same set", same.is(&set));
    q.claim("the same trail", left.is(&rest));
    q.claim("the set is not empty", set.is_number(0).not());
    q.claim("it is of A bits", set.less(&Symbolic::number(1 << A)));
    q.claim("at least a level", up.is_number(0).not());
}

/// Returns a word with bit i set if group i is not 0.
fn groups<const N: u32>(trail: &Symbolic<N>) -> Symbolic<N> {
    let any = trail.clone().or(&trail.clone().shr1());
    let bits = (0..N / 2).map(|i| any.0.extract(2 * i, 2 * i));
    let bits = bits.reduce(|low, bit| bit.concat(low));
    Symbolic(bits.map_or_else(|| BV::from_u64(0, N), |bits| bits.zero_ext(N - N / 2)))
}

/// With one bit per level, the trail is that of TRAIL-1, in descents and backtracks. If the lowest group has only the
/// sibling's slot, the child in that slot is the next node of TRAIL-4.
fn binary<const N: u32>(f: &Wide<2, N>, q: &mut Query) {
    let (pairs, pending) = (Wide::<2, N>::room_for(q, "trail", 2), q.word::<N>("pending"));
    q.assume(pending.less(&Symbolic::number(3)));
    let bits = groups(&pairs);
    let both = Symbolic(pending.is_number(0).ite(&Symbolic::<N>::zero().0, &Symbolic::<N>::one().0));
    let below = groups(&(f.leave)(pairs.clone(), &pending));
    q.claim("down: the trail of a child", below.is(&trail::child(bits.clone(), both)));

    let key = q.word::<N>("key");
    q.assume(pairs.is_number(0).not());
    let levels = trail::levels(&bits);
    let (_, lowest, _) = wide::back::<2, _>(pairs.clone());
    let (up, set, rest) = (f.back)(pairs);
    q.claim("back: n + 1 levels", up.is(&plus(levels.clone(), 1)));
    let (next, left) = trail::backtrack(key.clone(), bits);
    q.claim("back: the trail of TRAIL-4", groups(&(f.leave)(rest, &Word::zero())).is(&left));
    let own = key.clone().shr(levels).and(&Word::one());
    let is_sibling = lowest.is(&Symbolic(own.is_number(0).ite(&Symbolic::<N>::number(2).0, &Symbolic::<N>::one().0)));
    let taken = (f.child)((f.ancestor)(key.clone(), up), set.shr1());
    q.claim("back: the key of TRAIL-4", is_sibling.implies(taken.is(&next)));
    q.claim("it is a sibling's", (f.sibling)((f.sibling)(next.clone())).is(&next));
}
