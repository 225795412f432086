//! Exact ray tracing on triangle meshes, and tested implementations of published stackless BVH traversals.
//!
//! # A ray through a mesh
//!
//! ```
//! # #[cfg(feature = "rays")]
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! use stackless_bvh::{geom::Mesh, geom::Ray, glam::Vec3, trace::RayQueries, trace::Tracer};
//!
//! let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]])?;
//! let ray = Ray::new(Vec3::new(0.25, 0.5, -3.0), Vec3::Z)?;
//! let hit = Tracer::of(&mesh)?.closest(&ray);
//! assert_eq!(hit.map(|hit| (hit.prim, hit.t)), Some((0, 3.0)));
//! # Ok(())
//! # }
//! # #[cfg(not(feature = "rays"))]
//! # fn main() {}
//! ```
//!
//! [`Tracer`](trace::Tracer) has the other queries. [`bvh`] has the builders of hierarchies.
//!
//! # A traversal of any tree
//!
//! A traversal of a binary tree visits the wanted children, in an order that each visit decides. A textbook traversal
//! keeps the postponed children on a stack. The algorithms here need no stack. They find the next node from its key
//! (Binder & Keller 2016), from a counter and the layout of the tree (Barringer & Akenine-Möller 2013), or from parents,
//! uncles or skip pointers. Each is a small [`Cursor`](traverse::Cursor), and one loop drives all cursors. The tests
//! compare each with one oracle, visit by visit.
//!
//! # Map
//!
//! | module | contents |
//! |---|---|
//! | [`key`], [`trail`], [`swap`] | bits: node keys, the bit trail, the swap mask, over words of any width |
//! | [`tree`] | topology: arena, implicit layout, links, keys of nodes |
//! | [`order`], [`event`] | decisions of visits; observable events |
//! | [`oracle`], [`traverse`] | the reference, and every algorithm |
//! | [`hash`] | perfect hash from keys to addresses |
//! | [`wide`] | trees of 2, 4 or 8 children per node, and their traversals |
//! | `generate` | trees, decision tapes, sources of choices, scenes (feature `generate`) |
//! | [`geom`], [`bvh`], [`trace`] | rays, hierarchies, queries (feature `rays`; by all threads with `parallel`) |
//! | `internals` | parts for this project's own crates, without a promise (feature `internals`) |
//!
//! All modules before `geom` in this table are `no_std` with `alloc`, and independent of geometry.
//!
//! # Example
//!
//! ```
//! use stackless_bvh::order::{Descent, Flow, Side, Visitor};
//! use stackless_bvh::traverse::{self, Afra};
//! use stackless_bvh::tree::{Node, Recorded, Tree};
//!
//! /// Collects the leaves from right to left.
//! struct Leaves(Vec<usize>);
//! impl Visitor for Leaves {
//!     fn inner(&mut self, _: Node) -> Descent {
//!         Descent::both(Side::Right)
//!     }
//!     fn leaf(&mut self, node: Node) -> Flow {
//!         self.0.push(node.index());
//!         Flow::Continue
//!     }
//! }
//!
//! let tree = Tree::new(&[Some([1, 2]), None, Some([3, 4]), None, None])?.with_links(Recorded::ParentSibling);
//! let mut leaves = Leaves(Vec::new());
//! traverse::traverse(Afra::<u32, _>::new(&tree)?, &mut leaves, &mut ());
//! assert_eq!(leaves.0, [4, 3, 1]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(not(any(test, feature = "std")), no_std)]
#![forbid(unsafe_code)]
// Without these features, the parts for this project's own crates are unreachable: the kernels that `bench` compares.
#![cfg_attr(
    not(all(feature = "generate", feature = "internals", feature = "parallel")),
    allow(
        dead_code,
        unreachable_pub,
        unused_imports,
        clippy::trivially_copy_pass_by_ref,
        clippy::wrong_self_convention
    )
)]

extern crate alloc;

pub mod event;
#[cfg(any(test, feature = "generate"))]
pub mod generate;
pub mod hash;
#[cfg(feature = "internals")]
pub mod internals;
pub mod key;
pub mod name;
pub mod oracle;
pub mod order;
pub mod swap;
pub mod trail;
pub mod traverse;
pub mod tree;
pub mod wide;

#[cfg(feature = "rays")]
pub mod bvh;
#[cfg(feature = "rays")]
mod environment;
#[cfg(feature = "rays")]
pub mod geom;
mod threads;
#[cfg(feature = "rays")]
pub mod trace;

/// The vector types of the public interface.
#[cfg(feature = "rays")]
pub use glam;

/// The example of the README. `cargo test --doc` compiles and runs it.
#[cfg(all(doctest, feature = "rays", feature = "generate"))]
#[doc = include_str!("../README.md")]
struct Readme;
