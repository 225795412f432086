//! What is not put on a page.

use super::MOST_NODES;
use stackless_bvh::hash::BuildError;
use stackless_bvh::traverse::{Method, Unsupported};
use stackless_bvh::wide;

/// Why a case or a traversal is not put on a page.
#[derive(Debug, thiserror::Error)]
pub enum ExplainError {
    /// The tree is too large to be drawn.
    #[error("the tree has {nodes} nodes, and a page shows at most {MOST_NODES}")]
    TooLarge {
        /// Number of nodes.
        nodes: usize,
    },
    /// The tree is too deep to be drawn.
    #[error("the tree is {depth} edges deep, and a page shows at most {limit}")]
    TooDeep {
        /// Depth in edges.
        depth: u32,
        /// The greatest depth that is shown.
        limit: u32,
    },
    /// The traversal does not run on this tree.
    #[error("{method}: {error}")]
    Unsupported {
        /// The traversal.
        method: Method,
        /// Why.
        error: Unsupported,
    },
    /// The same of a wide tree.
    #[error("{method}: {error}")]
    UnsupportedWide {
        /// The traversal.
        method: wide::Method,
        /// Why.
        error: wide::Unsupported,
    },
    /// The traversal needs ranks that do not become less on the way down.
    #[error("{method}: on the way down ranks become less, and it may not visit what its oracle visits")]
    Falling {
        /// The traversal.
        method: wide::Method,
    },
    /// The traversal asks the search again on its way down, and the answers of this one change: there is no one trace.
    #[error("{method}: it asks the search again, and the answers of this one change on the way")]
    Changing {
        /// The traversal.
        method: Method,
    },
    /// There is no perfect hash.
    #[error("{method}: {error}")]
    Table {
        /// The traversal.
        method: Method,
        /// Why.
        error: BuildError,
    },
    /// The traversal differs from its oracle.
    #[error("{method}: visit {visit}: {what} is {found}, the oracle's is {expected}")]
    Differs {
        /// The traversal.
        method: &'static str,
        /// Number of the visit, from 0.
        visit: usize,
        /// What differs.
        what: &'static str,
        /// What the oracle has.
        expected: String,
        /// What the traversal has.
        found: String,
    },
    /// There is nothing to show.
    #[error("no traversal is named")]
    NoMethod,
    /// The page cannot be written down.
    #[error("{0}")]
    Json(#[from] serde_json::Error),
}

impl ExplainError {
    /// Whether other traversals may run.
    pub(super) const fn is_of_method(&self) -> bool {
        matches!(
            self,
            Self::Unsupported { .. }
                | Self::UnsupportedWide { .. }
                | Self::Falling { .. }
                | Self::Changing { .. }
                | Self::Table { .. }
        )
    }
}
