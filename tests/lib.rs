//! The external tests of `stackless-bvh`, in this folder, and the programs of the book.

/// The programs of the book.
#[cfg(doctest)]
#[doc = include_str!("../docs/tasks.md")]
struct Tasks;
