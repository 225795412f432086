//! Builders. Each makes a [`Draft`] with a node for each primitive; the layout is one for all.
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
use reinsert::Rounds;
use top_down::TopDown;

/// Why a hierarchy cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BuildError {
    /// There is nothing to build from.
    #[error("the mesh has no triangles")]
    Empty,
    /// More triangles than leaves can be addressed.
    #[error("{0} triangles are more than the {max} that a tree can hold", max = Node::MAX_INDEX)]
    TooManyTriangles(usize),
    /// A leaf must hold a triangle.
    #[error("leaves of 0 triangles were asked for")]
    ZeroLeafSize,
    /// The box of a primitive is empty or has a NaN.
    #[error("primitive {0} has no box")]
    NoBox(u32),
    /// More further references were allowed than is sensible: room for them is taken at once.
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
    /// There is no memory for so many bytes.
    #[error("no memory for {0} bytes")]
    Memory(usize),
    /// Floats of this thread, or of one that helps, are not those of IEEE 754. `[ENV-1]`
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

/// An empty vector with room for so many.
pub(super) fn room<T>(count: usize) -> Result<Vec<T>, BuildError> {
    let mut made = Vec::new();
    reserve(&mut made, count)?;
    Ok(made)
}

/// Makes room for so many more.
pub(super) fn reserve<T>(all: &mut Vec<T>, count: usize) -> Result<(), BuildError> {
    all.try_reserve_exact(count).map_err(|_| BuildError::Memory(count.saturating_mul(size_of::<T>())))
}

/// A vector of `count` equal values. All threads write it, as the first touch of memory takes time.
pub(super) fn filled<T: Copy + Send + Sync>(value: T, count: usize) -> Result<Vec<T>, BuildError> {
    let mut made = room(count)?;
    threads::map_into(&mut made, 0..count, record::CHUNK, |_| value);
    Ok(made)
}

/// How a hierarchy is built, by name.
///
/// The first three cut by surface area, at the borders of bins (Wald 2007); then the largest nodes are taken out and put
/// where they make boxes smallest (Meister & Bittner 2018).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Builder {
    /// In four rounds 1 % of the nodes are moved.
    Fast,
    /// In four rounds up to 10 % of the nodes are moved.
    #[default]
    Standard,
    /// In four rounds any node is moved.
    Best,
    /// As [`Standard`](Self::Standard), with triangles cut in two where that is cheaper (Stich, Friedrich & Dietrich
    /// 2009).
    Spatial,
    /// Eight levels by surface area, then medians: of bounded depth (Barringer & Akenine-Möller 2013).
    Bounded,
    /// A complete tree: all leaves at one depth.
    Median,
}

impl Builder {
    /// All builders.
    pub const ALL: [Self; 6] = [Self::Fast, Self::Standard, Self::Best, Self::Spatial, Self::Bounded, Self::Median];

    /// The name on the command line and in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Standard => "standard",
            Self::Best => "best",
            Self::Spatial => "sbvh",
            Self::Bounded => "bounded",
            Self::Median => "median",
        }
    }

    /// How much is moved.
    const fn rounds(self) -> Rounds {
        match self {
            Self::Fast => Rounds { count: 4, share: 0.01, decay: 1.0 },
            Self::Standard | Self::Spatial => Rounds { count: 4, share: 0.1, decay: 0.7 },
            Self::Best => Rounds { count: 4, share: 1.0, decay: 1.0 },
            Self::Bounded | Self::Median => Rounds { count: 0, share: 0.0, decay: 0.0 },
        }
    }
}

named!(Builder);

/// What is to be built. Builders ignore what does not concern them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BuildOptions {
    /// Which builder.
    pub builder: Builder,
    /// Leaf size and depth limit of binary hierarchies.
    pub sah: SahOptions,
    /// How primitives are cut.
    pub spatial: SpatialOptions,
    /// What becomes of triangles that no ray meets.
    pub degenerate: Degenerate,
}

/// What becomes of primitives that [cannot be hit](Primitives::can_be_hit).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Degenerate {
    /// They are in the tree. Rays miss them, and they have nearest points. Tests that are not
    /// [exact](crate::trace::Accuracy) may hit them by rounding, and a ray that comes near tests them in vain.
    #[default]
    Kept,
    /// They are not in the tree, which is for rays alone: it is smaller, and a search for the nearest point does not find them.
    LeftOut,
}

impl BuildOptions {
    /// One primitive a leaf, and deep enough for that: the tree that [wide hierarchies](Self::build_wide) are made of,
    /// which choose their leaves themselves.
    #[must_use]
    pub fn fine() -> Self {
        Self { sah: SahOptions { max_leaf: 1, depth_limit: 60 }, ..Self::default() }
    }

    /// A tree over primitives of any kind.
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
    /// What [`BuildError`] lists.
    pub fn build<P: Primitives + ?Sized>(&self, primitives: &P) -> Result<Bvh<P::Shape>, BuildError> {
        self.build_watched(primitives, &|_| ())
    }

    /// The same, with a callback that hears now and then, from any thread, how many primitives have found their leaf
    /// since the call before; a call may say 0.
    ///
    /// # Errors
    /// What [`BuildError`] lists.
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

    /// A tree with a node for each primitive, and how many primitives were left out.
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
        let draft = Draft { nodes, has_parts: is_spatial, unscaled: None }.improved(self.builder, sah, progress)?;
        let aabb = |prim| primitives.aabb(prim as usize);
        Ok((if is_scaled { draft.fitted(aabb)? } else { draft }, dropped))
    }

    /// What becomes a leaf of so many items.
    fn leaves(&self, items: usize) -> Leaves {
        match self.builder {
            Builder::Fast | Builder::Standard | Builder::Best | Builder::Spatial => Leaves::Cheapest,
            Builder::Bounded => Leaves::Full,
            Builder::Median => {
                let wanted = items.div_ceil(self.sah.max_leaf as usize);
                Leaves::At(wanted.next_power_of_two().ilog2().min(items.ilog2()))
            }
        }
    }
}

/// Levels of [`Builder::Bounded`] that are cut by surface area.
const BOUNDED_LEVELS: u32 = 8;

impl<S> Bvh<S> {
    /// A tree of low cost by the surface area heuristic, over a mesh or primitives of another kind. For others see
    /// [`BuildOptions::build`].
    ///
    /// ```
    /// use stackless_bvh::{bvh::Bvh, generate::procedural};
    ///
    /// let bvh = Bvh::build(&procedural::strands(1, 100))?;
    /// # Ok::<(), stackless_bvh::bvh::BuildError>(())
    /// ```
    ///
    /// # Errors
    /// [`BuildError::Empty`], which no mesh is, [`BuildError::NoBox`], which no triangle gives, and for more than 2^31 of
    /// them [`BuildError::TooManyTriangles`] and [`BuildError::DepthLimit`].
    pub fn build<P: Primitives<Shape = S> + ?Sized>(primitives: &P) -> Result<Self, BuildError> {
        BuildOptions::default().build(primitives)
    }
}

impl<V: Vector> Bvh<Triangle<V>> {
    /// A tree of low cost by the surface area heuristic.
    ///
    /// A node is cut by its middle where no plane parts the centroids, or where the cheapest cut would leave one side
    /// with more triangles than fit below it within the depth limit.
    ///
    /// # Errors
    /// What [`BuildError`] lists.
    pub fn sah(mesh: &Mesh<V>, sah: SahOptions) -> Result<Self, BuildError> {
        BuildOptions { sah, ..BuildOptions::default() }.build(mesh)
    }

    /// A complete tree: all leaves at the same depth, and their counts differ by at most 1.
    ///
    /// Each node is cut at the exact middle of its count, along the axis on which the centroids spread most. The
    /// depth is the least with which leaves hold at most `leaf_size` triangles. No leaf is empty: so with a
    /// `leaf_size` of 1, some leaves hold 2 unless the number of triangles is a power of two.
    ///
    /// # Errors
    /// Any but [`BuildError::DepthLimit`] and [`BuildError::ExtraPercent`].
    pub fn median(mesh: &Mesh<V>, leaf_size: u32) -> Result<Self, BuildError> {
        let sah = SahOptions { max_leaf: leaf_size, depth_limit: u32::MAX };
        BuildOptions { builder: Builder::Median, sah, ..BuildOptions::default() }.build(mesh)
    }
}

#[cfg(test)]
mod tests;
