//! The target of wide trees.

use arbitrary::Unstructured;
use stackless_bvh::generate::{Rng, Source};
use stackless_check::WideCase;

use super::right;

/// Checks every traversal of wide trees, and all combinations of storing pending nodes with returning to an ancestor.
/// `[WIDE-7]`
pub(crate) fn wide(bytes: &[u8]) {
    let mut source = Unstructured::new(bytes);
    match source.below(3) {
        0 => check::<4>(&mut source),
        1 => check::<8>(&mut source),
        _ => check::<2>(&mut source),
    }
}

/// Draws a case, choice by choice or wholly from a seed.
fn check<const A: usize>(source: &mut Unstructured<'_>) {
    let case = if source.below(8) == 1 {
        WideCase::<A>::draw(&mut Rng::new(source.below(u64::MAX)), 48, 24, 40)
    } else {
        let (chain, distances) = (source.below(24) as u32, 1 + source.below(30) as u32);
        WideCase::draw(source, 32, chain, distances)
    };
    let compared = right(case.check(), format_args!("{A} children: {case:?}"));
    // The stack supports every tree, so at least one comparison is made.
    assert!(compared > 0, "{case:?}");
}
