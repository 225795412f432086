//! Checking traversals against the oracle.
//!
//! A [`Case`] is a tree, a decision tape and a query. A [`Battery`] runs the oracle on it once and then any traversal
//! in any word, comparing at every visit ([`Fault`] lists what can differ). Tests, the command line, fuzzing and
//! benchmarks all drive this one body. [`shrink()`] makes a failing case small, and a [`Replay`] file keeps it.

pub mod adversary;
mod battery;
mod boxes;
mod case;
mod pauses;
mod random;
mod replay;
mod scene;
mod shrink;
mod stress;
mod tally;
mod watch;

pub use battery::{Battery, Verdict};
pub use boxes::{BoxTally, check_boxes};
pub use case::{Case, CaseOptions};
pub use pauses::{PauseFault, Pauses, Way, check_pauses};
pub use random::{Disagreement, Plan, Progress, boundary_cases, check_cases, check_random, merge};
pub use replay::{Replay, ReplayError};
pub use scene::{SceneDisagreement, SceneTree, Seen, check_scene};
pub use shrink::shrink;
pub use stress::{Errors, Stress, floats_between};
pub use tally::{Count, Tally};
pub use watch::{Fault, Watch};
