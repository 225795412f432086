//! Ray queries, and the tracers that answer them.
//!
//! The answer to a closest-hit query is that of rational arithmetic, rounded. So it is identical, bit for bit, for
//! every tree over the same mesh, every order and every traversal. `[DET-1]` For an any-hit query, only the existence of
//! a hit is identical.
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

#[cfg(any(test, feature = "internals"))]
pub(crate) mod accuracy;
mod binary;
#[cfg(any(test, feature = "generate"))]
pub(crate) mod bounce;
mod boundary;
pub(crate) mod child_order;
mod continuation;
pub(crate) mod counters;
pub(crate) mod crossings;
mod filter;
mod instances;
#[cfg(any(test, feature = "internals"))]
pub(crate) mod kernel_bvhs;
mod leaf_primitives;
mod level;
mod memory;
mod mesh_queries;
mod nearest;
pub(crate) mod next;
mod plan;
mod prepared_ray;
pub(crate) mod query;
mod ray_queries;
pub(crate) mod search;
mod solid;
mod tracer;
pub(crate) mod truth;
mod winding;

pub use binary::BinaryTracer;
pub use boundary::{Border, Boundary, OpenEdge};
pub(crate) use child_order::{ChildOrder, FromLeft, Nearest};
pub use continuation::{Continuation, Place};
pub(crate) use counters::WideCounters;
pub(crate) use crossings::AllHitsQuery;
pub use crossings::Crossings;
pub use filter::{Filter, Filterable, Filtered};
pub use instances::{
    Assembly, AssemblyError, FilteredInstances, Instance, InstanceCounts, InstanceError, InstanceFilter, InstanceHit,
    InstanceNear, InstanceTracer, Object,
};
#[cfg(any(test, feature = "internals"))]
pub(crate) use kernel_bvhs::KernelShape;
pub use leaf_primitives::{LeafPrimitives, NearTriangles};
pub use mesh_queries::MeshQueries;
pub use nearest::{Near, NearestPoint, NearestPoints};
pub(crate) use next::NextHitQuery;
pub use plan::{Choice, Decision, Need, Part, Plan, QueryKind};
pub(crate) use query::{BoxQuery, OwnBoxes, Query};
pub use ray_queries::RayQueries;
pub(crate) use search::{Closest, NodeSearch};
pub use solid::{Location, Rule, Solid, SolidError};
pub use tracer::Tracer;
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
