//! The surface area heuristic, evaluated at the borders of bins.
//!
//! Wald 2007, "On fast construction of SAH-based bounding volume hierarchies": centroids are counted in bins of
//! equal width along each axis; the cheapest border between two bins is where the node is cut.

use glam::Vec3A;

use super::BuildError;
use super::draft::Draft;
use super::item::{Item, Spread};
use super::top_down::{self, Cut, halve};

/// What the builder by surface area may choose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SahOptions {
    /// Bins per axis, 2 to [`MAX_BINS`](Self::MAX_BINS).
    pub bins: u32,
    /// Triangles that a leaf may hold, at least 1. Where fewer are cheaper, leaves are smaller.
    pub max_leaf: u32,
    /// Greatest depth, in edges. It is always kept.
    pub depth_limit: u32,
}

impl SahOptions {
    /// Greatest number of bins.
    pub const MAX_BINS: u32 = 1024;
}

impl Default for SahOptions {
    /// 32 bins, leaves of up to 4, and the depth that a 32-bit key carries.
    fn default() -> Self {
        Self { bins: 32, max_leaf: 4, depth_limit: 31 }
    }
}

pub(super) fn build(
    items: Vec<Item>,
    options: SahOptions,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Draft, BuildError> {
    let SahOptions { bins, max_leaf, depth_limit } = options;
    if items.len() > capacity(max_leaf, depth_limit) {
        return Err(BuildError::DepthLimit { triangles: items.len(), max_leaf, limit: depth_limit });
    }
    let mut binning = Binning::new(bins as usize);
    let cut = |range: &mut [Item], depth: u32| {
        let levels = depth_limit - depth;
        let may_be_leaf = range.len() <= max_leaf as usize;
        if range.len() == 1 || levels == 0 {
            return None;
        }
        let Some(plane) = binning.cheapest(range) else {
            return (!may_be_leaf).then(|| halve(range));
        };
        if may_be_leaf && plane.cost >= range.len() as f32 {
            return None;
        }
        let fits = plane.greater <= capacity(max_leaf, levels - 1);
        Some(if fits { plane.part(range) } else { halve(range) })
    };
    Ok(top_down::build(items, cut, progress))
}

/// Triangles that fit in a subtree with this many levels below its root.
pub(super) fn capacity(max_leaf: u32, levels: u32) -> usize {
    if levels < 32 { (max_leaf as usize).saturating_mul(1 << levels) } else { usize::MAX }
}

/// Cost of visiting a node, in triangle tests: two boxes are tested, and the next node is waited for.
pub(super) const NODE_COST: f32 = 2.0;

#[derive(Clone, Copy, Debug)]
struct Bin {
    aabb: Spread,
    count: usize,
}

impl Bin {
    const EMPTY: Self = Self { aabb: Spread::EMPTY, count: 0 };

    #[inline]
    fn add(&mut self, other: &Self) {
        self.aabb = self.aabb.union(other.aabb);
        self.count += other.count;
    }

    /// Triangle tests expected below, times the half area of the box.
    #[inline]
    fn weight(&self) -> f32 {
        self.aabb.half_area() * self.count as f32
    }
}

/// Room for the bins of one node.
struct Binning {
    bins: [Vec<Bin>; 3],
    /// Weight of all bins from here on, for each bin of one axis.
    from_here: Vec<f32>,
}

impl Binning {
    fn new(bins: usize) -> Self {
        Self { bins: [(); 3].map(|()| vec![Bin::EMPTY; bins]), from_here: vec![0.0; bins] }
    }

    /// The cheapest plane with centroids on both sides, if there is one of finite cost.
    fn cheapest(&mut self, items: &[Item]) -> Option<Plane> {
        let scale = Scale::new(Spread::of_centroids(items), self.from_here.len());
        for bins in &mut self.bins {
            bins.fill(Bin::EMPTY);
        }
        for item in items {
            let bin = Bin { aabb: item.spread(), count: 1 };
            for (bins, i) in self.bins.iter_mut().zip(scale.bins(item)) {
                bins[i].add(&bin);
            }
        }
        let planes = (0..3).filter_map(|axis| self.cheapest_across(axis, scale));
        planes.reduce(|best, plane| if plane.order() < best.order() { plane } else { best })
    }

    fn cheapest_across(&mut self, axis: usize, scale: Scale) -> Option<Plane> {
        let bins = &self.bins[axis];
        let mut right = Bin::EMPTY;
        for (bin, weight) in bins.iter().zip(&mut self.from_here).skip(1).rev() {
            right.add(bin);
            *weight = right.weight();
        }
        let mut all = right;
        all.add(&bins[0]);
        let mut best = Plane { axis, scale, border: 0, greater: all.count, cost: f32::INFINITY };
        let mut left = Bin::EMPTY;
        for (border, (bin, right)) in bins.iter().zip(&self.from_here[1..]).enumerate() {
            left.add(bin);
            let separates = 0 < left.count && left.count < all.count;
            let cost = NODE_COST + (left.weight() + right) / all.aabb.half_area();
            let plane = Plane { border, greater: left.count.max(all.count - left.count), cost, ..best };
            if separates && plane.order() < best.order() {
                best = plane;
            }
        }
        best.cost.is_finite().then_some(best)
    }
}

/// A border between bins.
#[derive(Clone, Copy)]
struct Plane {
    axis: usize,
    scale: Scale,
    /// Last bin of the left side.
    border: usize,
    /// Items on the side that has more.
    greater: usize,
    /// Of the node when cut here, in triangle tests.
    cost: f32,
}

impl Plane {
    /// Cheaper first, then more even.
    fn order(&self) -> (f32, usize) {
        (self.cost, self.greater)
    }

    /// Moves what is left of the plane to the front.
    fn part(&self, items: &mut [Item]) -> Cut {
        let mut left = 0;
        for i in 0..items.len() {
            if self.scale.bins(&items[i])[self.axis] <= self.border {
                items.swap(left, i);
                left += 1;
            }
        }
        Cut { axis: self.axis, left }
    }
}

/// Maps centroids to bins of equal width, monotonically on each axis.
#[derive(Clone, Copy)]
struct Scale {
    start: Vec3A,
    factor: Vec3A,
    last: Vec3A,
}

impl Scale {
    fn new(centroids: Spread, bins: usize) -> Self {
        let last = Vec3A::splat(bins as f32 - 1.0);
        Self { start: centroids.lo, factor: bins as f32 / centroids.extent(), last }
    }

    /// Bin on each axis. Where all centroids are equal, the factor is infinite, and the last bin has them all.
    #[inline]
    fn bins(&self, item: &Item) -> [usize; 3] {
        let bins = ((item.centroid() - self.start) * self.factor).min(self.last);
        bins.to_array().map(|bin| bin as usize)
    }
}
