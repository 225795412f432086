//! Parts for this project's own crates, without a promise: any release may change them. They are reference arithmetic,
//! kernels, lanes of vectors, single-purpose searches, and what selects a traversal by name.
//!
//! Each module has the parts of its namesake at the root.

/// Parts of [`crate::event`].
pub mod event {
    pub use crate::event::backtracks::{Backtracks, Source};
}

/// Parts of [`crate::hash`].
pub mod hash {
    pub use crate::hash::address::{decode, encode, is_address};
    pub use crate::hash::bytes::AddressBounds;
    pub use crate::hash::fold::for_each_folded_key;
    pub use crate::hash::modulo::{Constant, Modulo, Reciprocal, Remainder, TableSize, wrap};
    pub use crate::hash::perfect::Header;
}

/// Parts of [`crate::traverse`].
pub mod traverse {
    pub use crate::traverse::layout::Layout;
    pub use crate::traverse::method::Need;
    pub use crate::traverse::pause::{ByTable, ByWalk, Locate};
    pub use crate::traverse::split::{Piece, PieceTable};
    pub use crate::traverse::supply::{Context, PausingContext, Supply};
    pub use crate::traverse::tables::{AuxTables, FromTables, LinkedTree, VerifiedTables, WithCursor};
    pub use crate::traverse::word::{WithWord, with_word};
}

/// Parts of [`crate::wide`].
pub mod wide {
    pub use crate::wide::keys::asked_keys;
    pub use crate::wide::pending_store::{Count, PendingLevel, Ranked, StateView, TrailWord};
    pub use crate::wide::table::{Context, Scratch, Supply};
}

/// Parts of [`crate::bvh`].
#[cfg(feature = "rays")]
pub mod bvh {
    pub use crate::bvh::bytes::Stored;
}

/// Parts of [`crate::geom`].
#[cfg(feature = "rays")]
pub mod geom {
    pub use crate::geom::affine::meet_image;
    pub use crate::geom::enclosed_ray::EnclosedRay;
    pub use crate::geom::interval::Interval;
    pub use crate::geom::nearest::{Foot, Measure};
    pub use crate::geom::slabs::Slabs;

    /// Tests of rays and triangles.
    pub mod kernel {
        pub use crate::geom::kernel::*;
    }

    /// Tests of a ray with several boxes or triangles at once.
    pub mod lanes {
        pub use crate::geom::lanes::*;
    }

    /// Tests of rays and boxes.
    pub mod slabs {
        pub use crate::geom::slabs::*;
    }

    /// The true answers, in rational arithmetic.
    pub mod truth {
        pub use crate::geom::truth::*;
    }
}

/// Parts of [`crate::trace`].
#[cfg(feature = "rays")]
pub mod trace {
    pub use crate::trace::accuracy::{Accuracy, KernelName, SlabsName, WithTests, with_level, with_tests};
    #[cfg(feature = "generate")]
    pub use crate::trace::bounce::{bounce, cut, reflect, reflect_each};
    pub use crate::trace::child_order::{ChildOrder, FromLeft, Nearest};
    pub use crate::trace::counters::{Counters, WideCounters};
    pub use crate::trace::crossings::{AllHits, AllHits64, AllHitsQuery};
    pub use crate::trace::kernel_bvhs::{KernelBvhs, KernelShape};
    pub use crate::trace::next::NextHitQuery;
    pub use crate::trace::query::{BoxQuery, OwnBoxes, Query};
    pub use crate::trace::search::{Any, Any64, AnyByNode, Closest, Closest64, ClosestByNode, NodeSearch, Search};
    pub use crate::trace::truth::{TrueHit, Truth, brute_force};
}
