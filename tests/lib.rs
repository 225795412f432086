//! The tests of `stackless-bvh` from outside, beside this file, and the programs of the book.

/// The programs of the book.
#[cfg(doctest)]
#[doc = include_str!("../docs/tasks.md")]
struct Tasks;
