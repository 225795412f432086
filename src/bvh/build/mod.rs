//! Builders. Each makes a [`Draft`](draft::Draft); the layout is one for all.
//!
//! The same primitives and options give the same tree, on any number of threads.

mod bins;
mod bounded;
mod draft;
mod item;
mod linear;
mod median;
mod optimise;
mod sah;
mod spatial;
mod sweep;
mod top_down;

pub use sah::SahOptions;
pub use spatial::SpatialOptions;

use super::{Bvh, Primitives};
use crate::geom::{EnvironmentError, Mesh, Triangle, Vector};
use crate::name::named;
use crate::threads;
use crate::tree::Node;

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
    /// The number of bins is too small to split with, or absurdly great.
    #[error("{0} bins are not between 2 and {max}", max = SahOptions::MAX_BINS)]
    Bins(u32),
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
    /// Floats of this thread, or of one that helps, are not those of IEEE 754. `[ENV-1]`
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

/// How a hierarchy is built, by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Builder {
    /// By surface area, at the borders of bins (Wald 2007).
    #[default]
    Sah,
    /// By surface area, with triangles cut in two where that is cheaper (Stich, Friedrich & Dietrich 2009).
    Spatial,
    /// Fast: clusters along a space-filling curve, by surface area over and in them (Lauterbach et al. 2009; Garanzha
    /// et al. 2011).
    Linear,
    /// Eight levels by surface area, then medians: of bounded depth (Barringer & Akenine-Möller 2013).
    Bounded,
    /// A complete tree: all leaves at one depth.
    Median,
}

impl Builder {
    /// All builders.
    pub const ALL: [Self; 5] = [Self::Sah, Self::Spatial, Self::Linear, Self::Bounded, Self::Median];

    /// The name on the command line and in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sah => "sah",
            Self::Spatial => "sbvh",
            Self::Linear => "lbvh",
            Self::Bounded => "bounded",
            Self::Median => "median",
        }
    }
}

named!(Builder);

/// What is to be built. Builders ignore what does not concern them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BuildOptions {
    /// Which builder.
    pub builder: Builder,
    /// Bins, leaf size and depth limit.
    pub sah: SahOptions,
    /// How primitives are cut.
    pub spatial: SpatialOptions,
    /// Rounds of reinsertion (Meister & Bittner 2018) after the build; 0 for none.
    pub reinsertion: u32,
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
    /// One primitive a leaf, and deep enough for that: what a [wide hierarchy](super::WideBvh) is best made of, which
    /// chooses its leaves itself.
    #[must_use]
    pub fn fine() -> Self {
        Self { sah: SahOptions { max_leaf: 1, depth_limit: 60, ..SahOptions::default() }, ..Self::default() }
    }

    /// A tree over primitives of any kind.
    ///
    /// ```
    /// use stackless_bvh::bvh::{BuildOptions, Builder};
    /// use stackless_bvh::generate::procedural;
    ///
    /// let options = BuildOptions { builder: Builder::Spatial, reinsertion: 1, ..BuildOptions::default() };
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
        threads::guarded(|| self.build_fit(primitives, progress))?
    }

    fn build_fit<P: Primitives + ?Sized>(
        &self,
        primitives: &P,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Bvh<P::Shape>, BuildError> {
        let (options, sah) = (self, self.sah);
        if sah.max_leaf == 0 {
            return Err(BuildError::ZeroLeafSize);
        }
        if !(2..=SahOptions::MAX_BINS).contains(&sah.bins) {
            return Err(BuildError::Bins(sah.bins));
        }
        let extra_percent = options.spatial.extra_percent;
        if options.builder == Builder::Spatial && extra_percent > SpatialOptions::MAX_EXTRA_PERCENT {
            return Err(BuildError::ExtraPercent(extra_percent));
        }
        let items = item::items(primitives, options.degenerate)?;
        let dropped = primitives.count() - items.len();
        let draft = match options.builder {
            Builder::Sah => sah::build(items, sah, progress)?,
            Builder::Spatial => spatial::build(primitives, items, options, progress)?,
            Builder::Linear => linear::build(items, sah, progress)?,
            Builder::Bounded => bounded::build(items, sah, progress)?,
            Builder::Median => median::build(items, sah, progress)?,
        };
        let draft = match options.reinsertion {
            0 => draft,
            rounds => optimise::reinsert(draft, rounds, sah, progress),
        };
        Ok(draft.lay_out(primitives, dropped))
    }
}

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
    /// A node is cut by its middle where no plane separates the centroids, or where the cheapest cut would leave
    /// one side with more triangles than fit below it within the depth limit.
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
    /// Any but [`BuildError::Bins`], [`BuildError::DepthLimit`] and [`BuildError::ExtraPercent`].
    pub fn median(mesh: &Mesh<V>, leaf_size: u32) -> Result<Self, BuildError> {
        let sah = SahOptions { max_leaf: leaf_size, depth_limit: u32::MAX, ..SahOptions::default() };
        BuildOptions { builder: Builder::Median, sah, ..BuildOptions::default() }.build(mesh)
    }
}

#[cfg(test)]
mod tests;
