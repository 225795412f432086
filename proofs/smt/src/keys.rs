//! Lemmas about node keys.

use stackless_bvh::key::Word;
use z3::ast::Bool;

use crate::formulas::{Formulas, lemma};
use crate::lemma::{Lemma, Query};
use crate::word::Symbolic;

/// Returns all lemmas for words of `N` bits.
pub(crate) fn lemmas<const N: u32>() -> Vec<Lemma> {
    vec![
        lemma::<N>("root", "[KEY-1]", root, "0 for 1", |f| f.root = Word::zero),
        lemma::<N>("child", "[KEY-2] [KEY-3] [KEY-7]", child, "no bit added", |f| f.child = |key, _| key.shl1()),
        lemma::<N>("parent", "[KEY-3]", parent, "two levels up", |f| f.parent = |key| key.shr1().shr1()),
        lemma::<N>("sibling", "[KEY-4] [KEY-7]", sibling, "+ for xor", |f| {
            f.sibling = |key| key.wrapping_add(&Word::one());
        }),
        lemma::<N>("depth W - 1 and no more", "[DEPTH-1]", depth, "shift left by two", |f| {
            f.child = |key, right| key.shl1().shl1().or(&right);
        }),
    ]
}

fn root<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let root = (f.root)();
    q.claim("it is 1", root.is_number(1));
    q.claim("nothing is above it", (f.parent)(root).is_number(0));
}

fn child<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let (key, right) = (q.word::<N>("key"), q.bit::<N>("right"));
    q.assume(key.less(&Symbolic::highest()));
    let child = (f.child)(key.clone(), right.clone());
    let twice = key.wide().bvadd(key.wide());
    q.claim("it is 2k + b, without a carry out of the word", child.wide().eq(twice.bvadd(right.wide())));
    q.claim("its parent is k", (f.parent)(child).is(&key));
}

fn parent<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let key = q.word::<N>("key");
    let parent = (f.parent)(key.clone());
    let last = key.clone().and(&Symbolic::one());
    let twice = parent.wide().bvadd(parent.wide());
    q.claim("k is twice its parent, or one more", twice.bvadd(last.wide()).eq(key.wide()));
}

fn sibling<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let key = q.word::<N>("key");
    let sibling = (f.sibling)(key.clone());
    q.claim("it is another node", sibling.is(&key).not());
    q.claim("it has the same parent", (f.parent)(sibling.clone()).is(&(f.parent)(key.clone())));
    q.claim("its sibling is the node", (f.sibling)(sibling).is(&key));
    let [left, right] = [Word::zero(), Word::one()].map(|side| (f.child)(key.clone(), side));
    q.claim("left and right are siblings", (f.sibling)(left).is(&right));
}

/// A key of depth W - 2 has a child, which fills the word. A key of depth W - 1 fills the word, and one more level
/// drops its leading one.
fn depth<const N: u32>(f: &Formulas<N>, q: &mut Query) {
    let (key, right) = (q.word::<N>("key"), q.bit::<N>("right"));
    let (trail, both) = (q.word::<N>("trail"), q.bit::<N>("both"));
    let fills = |key: &Symbolic<N>| key.less(&Symbolic::highest()).not();
    let child = (f.child)(key.clone(), right);
    let returns = (f.parent)(child.clone()).is(&key);
    q.assume(key.less(&Symbolic::highest().shr1()).not());
    q.claim("the child of a key of depth W - 2 fills the word", Bool::or(&[fills(&key), fills(&child)]));
    q.claim("and its parent is the key", Bool::or(&[fills(&key), returns.clone()]));
    q.claim("the key of depth W - 1 does not come back", Bool::or(&[fills(&key).not(), returns.not()]));
    let below = (f.trail_child)(trail.clone(), both);
    let fits = trail.less(&Symbolic::highest());
    q.claim("a trail below the depth W - 1 loses no bit", fits.implies(below.shr1().is(&trail)));
}
