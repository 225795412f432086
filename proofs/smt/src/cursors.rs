//! Lemmas about the steps of the counting traversals, from the text of their files.
//!
//! `start` is two to the power of the node's depth. `trail` is the trail that another traversal would have at the node.
//! The counter is its complement below the depth, computed by the library's own function.

use stackless_bvh::key::{self, Word};
use stackless_bvh::{swap, trail};
use syn::Expr;
use z3::ast::Bool;

use crate::hash::{Slip, lemma};
use crate::lemma::{Lemma, Query};
use crate::machine::{Machine, Number};
use crate::numbers::Bits;
use crate::source::{Source, Type, where_some};
use crate::trails::{climbed, trail_and_start};
use crate::word::Symbolic;

/// The count of zeros by which the steps shift. After a claim about its value, the value replaces it.
const ZEROS: &str = "index.trailing_zeros()";

/// Returns all lemmas for words of `N` bits.
pub(crate) fn lemmas<const N: u32>() -> Result<Vec<Lemma>, String> {
    let slip = |says, from, to| Slip { says, from, to };
    let combined = slip("no shift", "self.index = take(&mut self.index).shl1()", "self.index = take(&mut self.index)");
    let carry = slip("end at 2", "if self.index == W::one() {", "if self.index == W::one().shl1() {");
    let apart = slip("shift by one level", "self.level_index = index.shr(up);", "self.level_index = index.shr1();");
    let toggle = slip("+ for xor", "take(path).shr(up).xor(&W::one())", "take(path).shr(up).wrapping_add(&W::one())");
    let added = "take(&mut self.0), W::from_bit(disjoint)";
    let down = slip("no mark added", added, "take(&mut self.0), W::zero()");
    let all_ones = slip("all zeros", "*self & self.wrapping_add(1) == 0", "*self == 0");
    let shift = slip("no addition", "let index = index.wrapping_add(&W::one());\n        let up", "let up");
    let kept = slip("T xor S", "trail.or(&disjoint).xor(&disjoint)", "trail.xor(&disjoint)");
    let taken = "core::mem::take(&mut self.index).or(&disjoint)";
    let counted = slip("c xor S", taken, "core::mem::take(&mut self.index).xor(&disjoint)");
    Ok(vec![
        lemma("Alg. 2, combined: descend", "[IMPLICIT-3]", N, combined_descends::<N>, combined)?,
        lemma("Alg. 2, combined: end", "[IMPLICIT-1] [IMPLICIT-3]", N, combined_ends::<N>, carry)?,
        lemma("Alg. 2, combined: backtrack", "[IMPLICIT-1] [IMPLICIT-3]", N, combined_backtracks::<N>, apart)?,
        lemma("Alg. 3: up and over", "[IMPLICIT-2]", N, up_and_over::<N>, toggle)?,
        lemma("Alg. 4: descend", "[SPARSE-1] [TRAIL-6] [DISJOINT-1]", N, sparse_descends::<N>, down)?,
        lemma("Alg. 4: end", "[SPARSE-1] [TRAIL-6]", N, sparse_ends::<N>, all_ones)?,
        lemma("Alg. 4: backtrack", "[SPARSE-1] [TRAIL-6]", N, sparse_backtracks::<N>, shift)?,
        lemma("pruned part of a trail", "[DISJOINT-2]", N, prunes::<N>, kept)?,
        lemma("pruned part of a counter", "[DISJOINT-2]", N, prunes_counter::<N>, counted)?,
    ])
}

fn machine<const N: u32>(
    source: &Source,
    values: impl IntoIterator<Item = (&'static str, Symbolic<N>)>,
) -> Machine<'_, Bits> {
    let values = values.into_iter().map(|(text, word)| (text, Bits::new(word.0)));
    Machine::new(source, Type::unsigned(N), values)
}

/// Returns the value of a word after a run.
fn word<const N: u32>(machine: &Machine<'_, Bits>, name: &str) -> Result<Symbolic<N>, String> {
    machine.value(name).map(|value| Symbolic(value.bits))
}

/// Returns whether the run has returned early, where it can do that once.
fn ended(machine: &Machine<'_, Bits>) -> Result<Bool, String> {
    match machine.returned.as_slice() {
        [condition] => condition.is_true(),
        all => Err(format!("{} early returns", all.len())),
    }
}

/// Runs a method on these values.
fn run<'s, const N: u32>(
    source: &'s Source,
    name: &'static str,
    values: impl IntoIterator<Item = (&'static str, Symbolic<N>)>,
) -> Result<Machine<'s, Bits>, String> {
    let (owner, _) = name.split_once("::").unwrap_or_default();
    let mut machine = machine(source, values).of(owner);
    machine.run(&source.function(name)?.body)?;
    Ok(machine)
}

fn combined_descends<const N: u32>(source: &Source, q: &mut Query) -> Result<(), String> {
    let (trail, start) = trail_and_start::<N>(q);
    let (rejected, swapped, mask) = (q.bit::<N>("rejected"), q.bit::<N>("swapped"), q.word::<N>("mask"));
    q.assume(start.less(&Symbolic::highest()));
    let counter = trail::counter(trail, start.clone());
    let (key, is_mask) = key_of(&start, &counter, &mask);
    let decided = [("branched(!descent.postpones())", rejected.clone()), ("mask_bit(descent)", swapped.clone())];
    let [combined, apart] = [
        vec![("self.index", start.clone().wrapping_add(&counter))],
        vec![("self.level_start", start), ("self.level_index", counter)],
    ];
    let values = |own: Vec<_>| own.into_iter().chain(decided.clone()).chain([("self.swap_mask", mask.clone())]);
    let combined = run::<N>(source, "ImplicitA1::descend", values(combined))?;
    let apart = run::<N>(source, "ImplicitA::descend", values(apart))?;
    let (start, index): (Symbolic<N>, Symbolic<N>) =
        (word(&apart, "self.level_start")?, word(&apart, "self.level_index")?);
    q.claim("the index stays below its level's start", index.less(&start));
    let sum = start.wrapping_add(&index);
    q.claim("the combined index is their sum", word::<N>(&combined, "self.index")?.is(&sum));
    let masks: [Symbolic<N>; 2] = [word(&combined, "self.swap_mask")?, word(&apart, "self.swap_mask")?];
    q.claim("the masks are equal", masks[0].is(&masks[1]));
    let below = trail::child(key, rejected.xor(&swapped));
    let nodes: [Symbolic<N>; 2] = [word(&apart, "self.node")?, word(&combined, "self.node")?];
    q.claim("two words go to the child, where the mask has no bit above", is_mask.implies(nodes[0].is(&below)));
    q.claim("so does one", is_mask.implies(nodes[1].is(&below)));
    Ok(())
}

/// Returns the key of the node for an index and a swap mask, and whether the mask is below the level's start.
fn key_of<const N: u32>(start: &Symbolic<N>, counter: &Symbolic<N>, mask: &Symbolic<N>) -> (Symbolic<N>, Bool) {
    (start.clone().or(&swap::fcomp(counter.clone(), mask)), mask.less(start))
}

fn combined_ends<const N: u32>(source: &Source, q: &mut Query) -> Result<(), String> {
    let (trail, start) = trail_and_start::<N>(q);
    let last = trail.is_number(0);
    let counter = trail::counter(trail, start.clone());
    let sum = start.clone().wrapping_add(&counter);
    let deepest = start.is(&Symbolic::highest());
    let wraps = sum.clone().wrapping_add(&Word::one()).is_number(0);
    let carried = Bool::and(&[deepest.clone(), last.clone()]);
    q.step("one word wraps at depth W - 1, at the last carry, and nowhere else", wraps.iff(carried));
    let mask = ("self.swap_mask", Word::zero());
    let values = [("self.level_start", start), ("self.level_index", counter), mask.clone()];
    let apart = run::<N>(source, "ImplicitA::backtrack", values)?;
    q.claim("two words end where the trail is 0, to depth W - 1", ended(&apart)?.iff(&last));
    // At depth W - 1 nothing is claimed of one word, so the word is replaced by another one.
    let sum = Symbolic(deepest.ite(&Symbolic::<N>::one().0, &sum.0));
    let combined = run::<N>(source, "ImplicitA1::backtrack", [("self.index", sum), mask])?;
    q.claim("one word ends there, to depth W - 2", Bool::or(&[deepest, ended(&combined)?.iff(&last)]));
    Ok(())
}

fn combined_backtracks<const N: u32>(source: &Source, q: &mut Query) -> Result<(), String> {
    let (trail, start) = trail_and_start::<N>(q);
    let up = climbed(q, &trail);
    let swapped = q.word::<N>("mask");
    let mask = ("self.swap_mask", swapped.clone());
    let counter = trail::counter(trail, start.clone());
    let (key, is_mask) = key_of(&start, &counter, &swapped);
    let sum = start.clone().wrapping_add(&counter);
    let zeros = [None, Some((ZEROS, up.clone()))];
    for (i, zeros) in zeros.into_iter().enumerate() {
        let combined = [("self.index", sum.clone()), mask.clone()].into_iter().chain(zeros.clone());
        let combined = run::<N>(source, "ImplicitA1::backtrack", combined)?;
        let apart = [("self.level_start", start.clone()), ("self.level_index", counter.clone()), mask.clone()];
        let apart = run::<N>(source, "ImplicitA::backtrack", apart.into_iter().chain(zeros))?;
        if i == 0 {
            q.claim("two words climb as far as the trail says", word::<N>(&apart, "up")?.is(&up));
            q.claim("so does one", word::<N>(&combined, "up")?.is(&up));
            continue;
        }
        let start: Symbolic<N> = word(&apart, "self.level_start")?;
        let index: Symbolic<N> = word(&apart, "self.level_index")?;
        q.claim("the index stays below its level's start", index.less(&start));
        let sum = start.wrapping_add(&index);
        q.claim("the combined index is their sum", word::<N>(&combined, "self.index")?.is(&sum));
        let masks: [Symbolic<N>; 2] = [word(&combined, "self.swap_mask")?, word(&apart, "self.swap_mask")?];
        q.claim("the masks are equal", masks[0].is(&masks[1]));
        let next = key.clone().shr(up.clone()).xor(&Word::one());
        let nodes: [Symbolic<N>; 2] = [word(&apart, "self.node")?, word(&combined, "self.node")?];
        q.claim(
            "two words go where the trail does, where the mask has no bit above",
            is_mask.implies(nodes[0].is(&next)),
        );
        q.claim("there goes one", is_mask.implies(nodes[1].is(&next)));
    }
    Ok(())
}

/// Claims that the body of Algorithm 3, applied to a key and its counter, is backtracking, also as printed.
fn up_and_over<const N: u32>(source: &Source, q: &mut Query) -> Result<(), String> {
    let (trail, start) = trail_and_start::<N>(q);
    let path = q.word::<N>("path");
    q.assume(path.less(&start));
    let (key, last) = (start.clone().or(&path), trail.is_number(0));
    let counter = trail::counter(trail.clone(), start);
    let moved = run::<N>(source, "up_and_over", [("path", key.clone()), ("counter", counter.clone())])?;
    let (to, left): (Symbolic<N>, Symbolic<N>) = (word(&moved, "path")?, word(&moved, "counter")?);
    q.claim("the key ends as 0 where the trail is 0, and only there", to.is_number(0).iff(&last));
    let next = counter.wrapping_add(&Word::one());
    let ancestor = key.clone().shr(next.trailing_zeros());
    let even = ancestor.clone().and(&Word::one()).shl1();
    let printed = ancestor.wrapping_add(&Word::one()).wrapping_sub(&even);
    q.claim("it is x + 1 - 2 (x & 1), as printed", to.is(&printed));
    // A trail of 0 is replaced by another one.
    let some = Symbolic(last.ite(&Symbolic::<N>::one().0, &trail.0));
    let (back, _) = trail::backtrack(key, some);
    q.claim("it is backtracking", Bool::or(&[last, to.is(&back)]));
    q.claim("the counter takes the carry", left.is(&next.clone().shr(next.trailing_zeros())));
    Ok(())
}

fn sparse_descends<const N: u32>(source: &Source, q: &mut Query) -> Result<(), String> {
    let (trail, start) = trail_and_start::<N>(q);
    let (rejected, right, mark) = (q.bit::<N>("rejected"), q.bit::<N>("right"), q.bit::<N>("mark"));
    let (key, marks) = (q.word::<N>("key"), q.word::<N>("S"));
    q.assume(start.less(&Symbolic::highest()));
    let values = [
        ("self.index", start.clone().wrapping_add(&trail::counter(trail.clone(), start.clone()))),
        ("self.node", key.clone()),
        ("self.marks", marks.clone()),
        ("descent.first()", right.clone()),
        ("branched(!descent.postpones())", rejected.clone()),
        ("descent.is_disjoint()", mark.clone()),
    ];
    let moved = run::<N>(source, "Sparse::descend", values)?;
    let (below, pending) = (start.shl1(), trail::child(trail, rejected.xor(&Word::one())));
    let counted = below.clone().wrapping_add(&trail::counter(pending, below));
    q.claim("the index is that of the child's trail", word::<N>(&moved, "self.index")?.is(&counted));
    q.claim("the marks have the child's", word::<N>(&moved, "self.marks")?.is(&trail::child(marks, mark)));
    q.claim("the node is the child", word::<N>(&moved, "self.node")?.is(&key::child(key, right)));
    Ok(())
}

fn sparse_ends<const N: u32>(source: &Source, q: &mut Query) -> Result<(), String> {
    let (trail, start) = trail_and_start::<N>(q);
    let last = trail.is_number(0);
    let index = start.clone().wrapping_add(&trail::counter(trail, start));
    let rest = [("self.node", q.word::<N>("key")), ("self.marks", q.word::<N>("S"))];
    let moved = run::<N>(source, "Sparse::backtrack", [("self.index", index)].into_iter().chain(rest))?;
    q.claim("it ends where the trail is 0, and only there, to depth W - 1", ended(&moved)?.iff(last));
    Ok(())
}

fn sparse_backtracks<const N: u32>(source: &Source, q: &mut Query) -> Result<(), String> {
    let (trail, start) = trail_and_start::<N>(q);
    let up = climbed(q, &trail);
    let index = start.clone().wrapping_add(&trail::counter(trail.clone(), start.clone()));
    let (key, marks) = (q.word::<N>("key"), q.word::<N>("S"));
    let values = [("self.index", index), ("self.node", key.clone()), ("self.marks", marks.clone())];
    let moved = run::<N>(source, "Sparse::backtrack", values.clone())?;
    q.claim("it counts as many levels as the trail says", word::<N>(&moved, "up")?.is(&up));
    let moved = run::<N>(source, "Sparse::backtrack", values.into_iter().chain([(ZEROS, up.clone())]))?;
    let [times] = &moved.loops[..] else { return Err("not one loop".into()) };
    q.claim("the loop runs as often", times.bits.eq(&up.0));
    q.claim("the marks are shifted as far", word::<N>(&moved, "self.marks")?.is(&marks.shr(up.clone())));
    let next = key::sibling(key.shr(up.clone()));
    q.claim("the node is the postponed one", word::<N>(&moved, "self.node")?.is(&next));
    let (start, left) = (start.shr(up.clone()), trail.clone().shr(up).xor(&Word::one()));
    q.step("the trail left is that of backtracking", trail::leave(trail).is(&left));
    let counted = start.clone().wrapping_add(&trail::counter(left, start));
    q.claim("the index is that of the trail left", word::<N>(&moved, "self.index")?.is(&counted));
    Ok(())
}

/// Returns the library's pruned trail.
fn pruned<const N: u32>(source: &Source, trail: &Symbolic<N>, marks: &Symbolic<N>) -> Result<Symbolic<N>, String> {
    let values = [("trail", trail.clone()), ("disjoint", marks.clone())];
    let expr = where_some(&source.function("::prune")?.body, "disjoint")?;
    machine(source, values).eval(&expr, None).map(|value| Symbolic(value.bits))
}

fn prunes<const N: u32>(source: &Source, q: &mut Query) -> Result<(), String> {
    let (trail, marks) = (q.word::<N>("T"), q.word::<N>("S"));
    let kept = pruned(source, &trail, &marks)?;
    q.claim("it is T & ~S", kept.is(&trail.and(&Symbolic(marks.0.bvnot()))));
    Ok(())
}

fn prunes_counter<const N: u32>(source: &Source, q: &mut Query) -> Result<(), String> {
    let (trail, start) = trail_and_start::<N>(q);
    let marks = q.word::<N>("S");
    q.assume(marks.less(&start));
    let index = |trail: Symbolic<N>| start.clone().wrapping_add(&trail::counter(trail, start.clone()));
    let values = [("self.index", index(trail.clone())), ("disjoint", marks.clone())];
    let mut machine = machine(source, values);
    let Expr::Block(block) = where_some(&source.function("Sparse::prune")?.body, "disjoint")? else {
        return Err("no block".into());
    };
    machine.run(&block.block)?;
    let kept = pruned(source, &trail, &marks)?;
    q.claim("c | S is the counter of T & ~S", word::<N>(&machine, "self.index")?.is(&index(kept)));
    Ok(())
}
