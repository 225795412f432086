//! The target of wide trees.

use arbitrary::Unstructured;
use stackless_bvh::generate::{Rng, Source};
use stackless_check::WideCase;

use super::right;

/// Every traversal of wide trees, and every way to keep what is pending with every way to an ancestor. `[WIDE-7]`
pub(crate) fn wide(bytes: &[u8]) {
    let mut source = Unstructured::new(bytes);
    match source.below(3) {
        0 => check::<4>(&mut source),
        1 => check::<8>(&mut source),
        _ => check::<2>(&mut source),
    }
}

/// A case, choice by choice; or all of it from a seed.
fn check<const A: usize>(source: &mut Unstructured<'_>) {
    let case = if source.below(8) == 1 {
        WideCase::<A>::draw(&mut Rng::new(source.below(u64::MAX)), 48, 24, 40)
    } else {
        let (chain, distances) = (source.below(24) as u32, 1 + source.below(30) as u32);
        WideCase::draw(source, 32, chain, distances)
    };
    let compared = right(case.check(), format_args!("{A} children: {case:?}"));
    // The stack fits every tree, and with it something is compared.
    assert!(compared > 0, "{case:?}");
}
