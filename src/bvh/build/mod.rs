//! Builders. Each makes a [`Draft`] with a node for each primitive; all share one layout.
//!
//! The same primitives and options give the same tree, on any number of threads and any machine. `[BUILD-1]`
//! `[BUILD-2]`

mod bins;
mod draft;
mod merge;
mod record;
mod reinsert;
mod sah;
mod spatial;
mod top_down;

pub(super) use draft::Draft;
pub(super) use merge::merge;
pub(super) use record::{Record, scale};
pub(super) use reinsert::Rounds;
pub use sah::SahOptions;
pub use spatial::SpatialOptions;

use fearless_simd::Level;

use super::{Bvh, Primitives};
use crate::geom::lanes::levels;
use crate::geom::{EnvironmentError, Mesh, Triangle, Vector};
use crate::name::named;
use crate::threads;
use crate::tree::Node;
use draft::Leaves;
use top_down::TopDown;

/// Errors of the builders.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BuildError {
    /// There are no primitives.
    #[error("the mesh has no triangles")]
    Empty,
    /// More triangles than leaves can address.
    #[error("{0} triangles are more than the {max} that a tree can hold", max = Node::MAX_INDEX)]
    TooManyTriangles(usize),
    /// A leaf must hold a triangle.
    #[error("leaves of 0 triangles were asked for")]
    ZeroLeafSize,
    /// The box of a primitive is empty or has a NaN.
    #[error("primitive {0} has no box")]
    NoBox(u32),
    /// More additional references than [`SpatialOptions::MAX_EXTRA_PERCENT`]: memory for all of them is allocated at
    /// once.
    #[error("{0} further references for 100 triangles are more than {max}", max = SpatialOptions::MAX_EXTRA_PERCENT)]
    ExtraPercent(u32),
    /// A tree within the limit has too few leaves.
    #[error("{triangles} triangles do not fit in leaves of {max_leaf} at a depth of at most {limit}")]
    DepthLimit {
        /// Triangles of the mesh.
        triangles: usize,
        /// Triangles that a leaf may hold.
        max_leaf: u32,
        /// Greatest depth, in edges.
        limit: u32,
    },
    /// An allocation of this number of bytes failed.
    #[error("no memory for {0} bytes")]
    Memory(usize),
    /// The arithmetic of this thread, or of a participating thread, is not that of IEEE 754. `[ENV-1]`
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

/// Creates an empty vector with this capacity.
pub(super) fn room<T>(count: usize) -> Result<Vec<T>, BuildError> {
    let mut made = Vec::new();
    reserve(&mut made, count)?;
    Ok(made)
}

/// Reserves room for `count` more elements.
pub(super) fn reserve<T>(all: &mut Vec<T>, count: usize) -> Result<(), BuildError> {
    all.try_reserve_exact(count).map_err(|_| BuildError::Memory(count.saturating_mul(size_of::<T>())))
}

/// Creates a vector of `count` equal values. All threads write it, because the first touch of memory takes time.
pub(super) fn filled<T: Copy + Send + Sync>(value: T, count: usize) -> Result<Vec<T>, BuildError> {
    let mut made = room(count)?;
    threads::map_into(&mut made, 0..count, record::CHUNK, |_| value);
    Ok(made)
}

/// A builder, by name.
///
/// The first three split by surface area, at the borders of bins (Wald 2007). Then they remove the largest nodes and
/// reinsert them where boxes become smallest (Meister & Bittner 2018), in four rounds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Builder {
    /// Moves 1 % of the nodes. With 10 %, builds take a quarter longer, and some views from outside of a scene twice as
    /// long.
    #[default]
    Standard,
    /// Moves any node.
    Best,
    /// Divides triangles where that is cheaper (Stich, Friedrich & Dietrich 2009), and moves up to 10 % of the nodes.
    Spatial,
    /// Eight levels by surface area, then medians: of bounded depth (Barringer & Akenine-Möller 2013).
    Bounded,
    /// A complete tree: all leaves at one depth.
    Median,
}

impl Builder {
    /// All builders.
    pub const ALL: [Self; 5] = [Self::Standard, Self::Best, Self::Spatial, Self::Bounded, Self::Median];

    /// Returns the name on the command line and in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Standard => "standard",
            Self::Best => "best",
            Self::Spatial => "sbvh",
            Self::Bounded => "bounded",
            Self::Median => "median",
        }
    }

    /// Returns the nodes to move.
    const fn rounds(self) -> Rounds {
        match self {
            Self::Standard => Rounds { count: 4, share: 0.01, decay: 1.0 },
            Self::Spatial => Rounds::SEVERAL,
            Self::Best => Rounds { count: 4, share: 1.0, decay: 1.0 },
            Self::Bounded | Self::Median => Rounds { count: 0, share: 0.0, decay: 0.0 },
        }
    }
}

named!(Builder);

/// Options of all builders. Each builder ignores the options that do not apply to it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BuildOptions {
    /// The builder.
    pub builder: Builder,
    /// Leaf size and depth limit of binary hierarchies.
    pub sah: SahOptions,
    /// Options for spatial splits.
    pub spatial: SpatialOptions,
    /// The treatment of triangles that no ray meets.
    pub degenerate: Degenerate,
}

/// The treatment of primitives that [cannot be hit](Primitives::can_be_hit).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Degenerate {
    /// They are in the tree. Rays miss them, and they have nearest points. Inexact tests may
    /// hit them by rounding, and nearby rays test them unnecessarily.
    #[default]
    Kept,
    /// They are not in the tree, which is for rays only: it is smaller, and a search for the nearest point does not
    /// find them.
    LeftOut,
}

impl BuildOptions {
    /// Returns options with one primitive per leaf, and the necessary depth. [Wide hierarchies](Self::build_wide) are
    /// made from such a tree and choose their leaves themselves.
    #[must_use]
    pub fn fine() -> Self {
        Self { sah: SahOptions { max_leaf: 1, depth_limit: 60 }, ..Self::default() }
    }

    /// Builds a tree over primitives of any kind.
    ///
    /// ```
    /// use stackless_bvh::bvh::{BuildOptions, Builder};
    /// use stackless_bvh::generate::procedural;
    ///
    /// let options = BuildOptions { builder: Builder::Best, ..BuildOptions::default() };
    /// let bvh = options.build(&procedural::strands(1, 100))?;
    /// # Ok::<(), stackless_bvh::bvh::BuildError>(())
    /// ```
    ///
    /// # Errors
    /// [`BuildError`].
    pub fn build<P: Primitives + ?Sized>(&self, primitives: &P) -> Result<Bvh<P::Shape>, BuildError> {
        self.build_watched(primitives, &|_| ())
    }

    /// Builds a tree as [`build`](Self::build) does, with a progress callback. It is called periodically, from any
    /// thread, with the number of primitives that have found their leaf since the previous call; the number may be 0.
    ///
    /// # Errors
    /// [`BuildError`].
    pub fn build_watched<P: Primitives + ?Sized>(
        &self,
        primitives: &P,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Bvh<P::Shape>, BuildError> {
        threads::guarded(|| {
            let (draft, dropped) = self.draft(primitives, progress)?;
            draft.lay_out(primitives, dropped, self.leaves(draft.nodes[0].count() as usize), self.sah)
        })?
    }

    /// Returns a tree with a node for each primitive, and the number of omitted primitives.
    pub(super) fn draft<P: Primitives + ?Sized>(
        &self,
        primitives: &P,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<(Draft, usize), BuildError> {
        self.draft_by(levels()[0].1, primitives, progress)
    }

    fn draft_by<P: Primitives + ?Sized>(
        &self,
        level: Level,
        primitives: &P,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<(Draft, usize), BuildError> {
        let sah = self.sah;
        if sah.max_leaf == 0 {
            return Err(BuildError::ZeroLeafSize);
        }
        let extra_percent = self.spatial.extra_percent;
        if self.builder == Builder::Spatial && extra_percent > SpatialOptions::MAX_EXTRA_PERCENT {
            return Err(BuildError::ExtraPercent(extra_percent));
        }
        let mut items = record::items(primitives, self.degenerate)?;
        let dropped = primitives.count() - items.len();
        sah.check(items.len())?;
        let is_spatial = self.builder == Builder::Spatial;
        let is_scaled = !is_spatial && record::scale(&mut items);
        let nodes = if is_spatial {
            spatial::build(primitives, items, self, progress)?
        } else {
            let by_area = match self.builder {
                Builder::Bounded => BOUNDED_LEVELS,
                Builder::Median => 0,
                _ => u32::MAX,
            };
            TopDown { options: sah, by_area, level, progress }.build(items)?
        };
        let draft =
            Draft { nodes, has_parts: is_spatial, unscaled: None }.improved(self.builder.rounds(), sah, progress)?;
        let aabb = |prim| primitives.aabb(prim as usize);
        Ok((if is_scaled { draft.fitted(aabb)? } else { draft }, dropped))
    }

    /// Returns the leaves for this number of items.
    fn leaves(&self, items: usize) -> Leaves {
        match self.builder {
            Builder::Standard | Builder::Best | Builder::Spatial => Leaves::Cheapest,
            Builder::Bounded => Leaves::Full,
            Builder::Median => {
                let wanted = items.div_ceil(self.sah.max_leaf as usize);
                Leaves::At(wanted.next_power_of_two().ilog2().min(items.ilog2()))
            }
        }
    }
}

/// Levels of [`Builder::Bounded`] that are split by surface area.
const BOUNDED_LEVELS: u32 = 8;

impl<S> Bvh<S> {
    /// Builds a tree of low cost by the surface area heuristic, over a mesh or other primitives.
    /// [`BuildOptions::build`] has the other builders.
    ///
    /// ```
    /// use stackless_bvh::{bvh::Bvh, generate::procedural};
    ///
    /// let bvh = Bvh::build(&procedural::strands(1, 100))?;
    /// # Ok::<(), stackless_bvh::bvh::BuildError>(())
    /// ```
    ///
    /// # Errors
    /// [`BuildError::Empty`], which does not occur for a mesh, [`BuildError::NoBox`], which does not occur for
    /// triangles, and for more than 2^31 primitives [`BuildError::TooManyTriangles`] and [`BuildError::DepthLimit`].
    pub fn build<P: Primitives<Shape = S> + ?Sized>(primitives: &P) -> Result<Self, BuildError> {
        BuildOptions::default().build(primitives)
    }
}

impl<V: Vector> Bvh<Triangle<V>> {
    /// Builds a tree of low cost by the surface area heuristic.
    ///
    /// A node is split by the middle of its count if no plane separates the centroids, or if one side of the cheapest
    /// split would have more triangles than fit below it within the depth limit.
    ///
    /// # Errors
    /// [`BuildError`].
    pub fn sah(mesh: &Mesh<V>, sah: SahOptions) -> Result<Self, BuildError> {
        BuildOptions { sah, ..BuildOptions::default() }.build(mesh)
    }

    /// Builds a complete tree: all leaves have the same depth, and their counts differ by at most 1.
    ///
    /// Each node is split at the exact middle of its count, along the axis on which the centroids spread most. The
    /// depth is the least for which leaves hold at most `leaf_size` triangles. No leaf is empty: so with a `leaf_size`
    /// of 1, some leaves hold 2 unless the number of triangles is a power of two.
    ///
    /// # Errors
    /// [`BuildError`], except [`BuildError::DepthLimit`] and [`BuildError::ExtraPercent`].
    pub fn median(mesh: &Mesh<V>, leaf_size: u32) -> Result<Self, BuildError> {
        let sah = SahOptions { max_leaf: leaf_size, depth_limit: u32::MAX };
        BuildOptions { builder: Builder::Median, sah, ..BuildOptions::default() }.build(mesh)
    }
}

#[cfg(test)]
mod tests;
