//! Ray queries: visitors for the closest hit or any hit, and the tracers that run them.
//!
//! [`Closest`] and [`Any`] test both children at their parent, so the root's own box is not tested. [`ClosestByNode`]
//! and [`AnyByNode`] test each node's box at its own visit, for traversals that need this. They are exact: the answer
//! to a closest-hit query is that of rational arithmetic ([`Truth`]). So it is identical, bit for bit, for every tree
//! over the same mesh, every order and every traversal. `[DET-1]` For an any-hit query, only the existence of a hit is
//! identical.
//!
//! # Tracers
//!
//! | tracer | over | queries |
//! |---|---|---|
//! | [`Tracer`], the default | a hierarchy of eight children | [`RayQueries`], [`MeshQueries`], [`Filterable`] |
//! | [`BinaryTracer`] | a binary hierarchy, with any traversal of both papers and any tests | [`RayQueries`], [`MeshQueries`], [`Filterable`] |
//! | [`InstanceTracer`] | meshes placed by affine maps, also for rays that start on a surface | [`RayQueries`], [`filtered`](InstanceTracer::filtered), crossings, nearest points |
//!
//! Construction of a tracer refuses a traversal that does not fit ([`Unsupported`](crate::traverse::Unsupported)).
//! Tracing is infallible. The constructors of meshes, rays, balls and builders check their inputs
//! ([`MeshError`](crate::geom::MeshError), [`RayError`](crate::geom::RayError), [`BallError`](crate::geom::BallError),
//! [`BuildError`](crate::bvh::BuildError)). ARCHITECTURE.md lists the functions that a ray passes.

mod accuracy;
mod binary;
#[cfg(any(test, feature = "generate"))]
mod bounce;
mod boundary;
mod child_order;
mod continuation;
mod counters;
mod crossings;
mod filter;
mod instances;
mod kernel_bvhs;
mod leaf_primitives;
mod level;
mod memory;
mod mesh_queries;
mod nearest;
mod next;
mod plan;
mod prepared_ray;
mod query;
mod ray_queries;
mod search;
mod solid;
mod tracer;
pub mod truth;
mod winding;

pub use accuracy::{Accuracy, KernelName, SlabsName, WithTests, with_level, with_tests};
pub use binary::BinaryTracer;
#[cfg(any(test, feature = "generate"))]
pub use bounce::{bounce, cut, reflect, reflect_each};
pub use boundary::{Border, Boundary, OpenEdge};
pub use child_order::{ChildOrder, FromLeft, Nearest};
pub use continuation::{Continuation, Place};
pub use counters::{Counters, WideCounters};
pub use crossings::{AllHits, AllHits64, AllHitsQuery, Crossings};
pub use filter::{Filter, Filterable, Filtered};
pub use instances::{
    Assembly, AssemblyError, FilteredInstances, Instance, InstanceCounts, InstanceError, InstanceFilter, InstanceHit,
    InstanceNear, InstanceTracer, Object,
};
pub use kernel_bvhs::{KernelBvhs, KernelShape};
pub use leaf_primitives::LeafPrimitives;
pub use mesh_queries::MeshQueries;
pub use nearest::{Near, NearestPoint, NearestPoints};
pub use next::NextHitQuery;
pub use plan::{Choice, Decision, Need, Part, Plan, QueryKind};
pub use query::{BoxQuery, OwnBoxes, Query};
pub use ray_queries::RayQueries;
pub use search::{Any, Any64, AnyByNode, Closest, Closest64, ClosestByNode, NodeSearch, Search};
pub use solid::{Location, Rule, Solid, SolidError};
pub use tracer::Tracer;
pub use truth::{TrueHit, Truth};
pub use winding::Winding;

/// The intersection of a ray and a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<R = f32> {
    /// Index of the triangle in the mesh.
    pub prim: u32,
    /// Distance along the ray, in units of the length of its direction.
    pub t: R,
    /// Weight of the triangle's second corner.
    pub u: R,
    /// Weight of the triangle's third corner.
    pub v: R,
}

#[cfg(test)]
mod tests;
