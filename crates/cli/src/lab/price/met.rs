//! The work of queries, as counts.

use std::fmt;

use stackless_bvh::internals::trace::{Counters, WideCounters};
use stackless_bvh::trace::InstanceCounts;

/// The nodes and triangles of a query.
pub(super) struct Met {
    nodes: u64,
    triangles: u64,
    /// The kind of nodes.
    of: &'static str,
}

impl Met {
    /// Nodes and triangles. Each query has at least one.
    pub(super) fn both(&self) -> f64 {
        (self.nodes + self.triangles).max(1) as f64
    }
}

impl fmt::Display for Met {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} triangles in {} {}", self.triangles, self.nodes, self.of)
    }
}

impl From<WideCounters> for Met {
    fn from(WideCounters { nodes, triangles, .. }: WideCounters) -> Self {
        Self { nodes, triangles, of: "nodes of eight" }
    }
}

impl From<Counters> for Met {
    fn from(Counters { inner, triangles, .. }: Counters) -> Self {
        Self { nodes: inner, triangles, of: "nodes of two" }
    }
}

impl From<InstanceCounts> for Met {
    fn from(InstanceCounts { instances, triangles, .. }: InstanceCounts) -> Self {
        Self { nodes: instances, triangles, of: "instances" }
    }
}
