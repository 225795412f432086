//! Errors of explaining a case.

use super::MOST_NODES;
use stackless_bvh::hash::BuildError;
use stackless_bvh::traverse::{Method, Unsupported};
use stackless_bvh::wide;

/// Errors that exclude a case or a traversal from a page.
#[derive(Debug, thiserror::Error)]
pub enum ExplainError {
    /// The tree is too large to draw.
    #[error("the tree has {nodes} nodes, and a page shows at most {MOST_NODES}")]
    TooLarge {
        /// Number of nodes.
        nodes: usize,
    },
    /// The tree is too deep to draw.
    #[error("the tree is {depth} edges deep, and a page shows at most {limit}")]
    TooDeep {
        /// Depth in edges.
        depth: u32,
        /// The greatest supported depth.
        limit: u32,
    },
    /// The traversal does not support this tree.
    #[error("{method}: {error}")]
    Unsupported {
        /// The traversal.
        method: Method,
        /// The reason.
        error: Unsupported,
    },
    /// The traversal does not support this wide tree.
    #[error("{method}: {error}")]
    UnsupportedWide {
        /// The traversal.
        method: wide::Method,
        /// The reason.
        error: wide::Unsupported,
    },
    /// The traversal requires ranks that do not decrease on the way down.
    #[error("{method}: on the way down ranks become less, and it may not visit what its oracle visits")]
    Falling {
        /// The traversal.
        method: wide::Method,
    },
    /// The traversal repeats queries on its way down, and the answers of this search change, so the trace is not
    /// unique.
    #[error("{method}: it asks the search again, and the answers of this one change on the way")]
    Changing {
        /// The traversal.
        method: Method,
    },
    /// The perfect hash cannot be built.
    #[error("{method}: {error}")]
    Table {
        /// The traversal.
        method: Method,
        /// The reason.
        error: BuildError,
    },
    /// The traversal differs from its oracle.
    #[error("{method}: visit {visit}: {what} is {found}, the oracle's is {expected}")]
    Differs {
        /// The traversal.
        method: &'static str,
        /// Number of the visit, from 0.
        visit: usize,
        /// The part that differs.
        what: &'static str,
        /// The oracle's value.
        expected: String,
        /// The traversal's value.
        found: String,
    },
    /// No traversal is given.
    #[error("no traversal is named")]
    NoMethod,
    /// The page cannot be serialised.
    #[error("{0}")]
    Json(#[from] serde_json::Error),
}

impl ExplainError {
    /// Returns whether other traversals may still run.
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
