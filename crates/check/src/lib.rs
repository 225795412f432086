//! Checks of traversals against the oracle.
//!
//! A [`Case`] is a tree, a decision tape and a query. A [`Battery`] runs the oracle on it once, then runs any traversal
//! with any word and compares every visit ([`Fault`] lists the differences). Tests, the command line, fuzzing and
//! benchmarks all use this property body. [`shrink()`] reduces a failing case, and a [`Replay`] file stores it.
//!
//! The crate also has property bodies for the components of traversals: [`Pauses`], [`check_table`],
//! [`check_triangle`], [`check_slabs`], [`check_trees`], [`InstanceOracle`]. Callers supply their inputs.

#![forbid(unsafe_code)]

mod all;
mod battery;
mod boxes;
mod case;
mod foot;
mod instance_oracle;
mod kernels;
mod paths;
mod pauses;
mod pieces;
mod random;
mod replay;
mod scene;
mod shard;
mod shrink;
mod solids;
mod states;
mod stress;
mod tables;
mod tally;
mod trees;
mod watch;
mod watched;
mod wide;

pub use all::AllCases;
pub use battery::{Battery, Verdict};
pub use boxes::{BoxTally, check_boxes};
pub use case::{Case, CaseOptions};
pub use instance_oracle::{
    Hierarchies, InstanceFault, InstanceOracle, Shape, check_answer, check_instances, in_single,
};
pub use kernels::{GeometryFault, check_degenerate, check_distance, check_slabs, check_triangle};
pub use paths::{Exactly, Heading, Leg, Path, PathFault, check_path};
pub use pauses::{GoOn, PauseFault, Pauses, Start, Way};
pub use pieces::Pieces;
pub use random::{
    Disagreement, PauseTally, Plan, Progress, boundary_cases, check_cases, check_numbered, check_pauses, check_random,
    merge,
};
pub use replay::{Replay, ReplayError};
pub use scene::{SceneDisagreement, SceneTree, Seen, check_scene};
pub use shard::{Shard, ShardError};
pub use shrink::shrink;
pub use solids::{SolidFault, Solids};
pub use stress::{Errors, Stress, floats_between};
pub use tables::{TableFault, check_table, check_table_bytes};
pub use tally::{Count, Tally};
pub use trees::{TreeFault, check_held, check_nearest, check_trees, nearest};
pub use watch::{Expected, Fault, Visit, Watch};
pub use watched::{Reads, Steps, Watched};
pub use wide::{WideCase, WideFault};
