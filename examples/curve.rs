//! The closest point of a Bézier curve: a traversal prunes over a shape that is not a triangle.
//!
//! The halves of `[0, 1]`, their halves, and so on, are a tree that is not stored. The search bounds the distance on each
//! half, and skips those that are too far away (`spec/searches.md`). `cargo run --release --example curve`

use std::error::Error;

use stackless_bvh::order::{Descent, Flow, Visitor};
use stackless_bvh::traverse::{Afra, traverse};
use stackless_bvh::tree::{Node, Recorded, Topology};

/// The closest point of an arch, by a traversal that keeps a trail.
pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let arch = [[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]];
    let mut search = Search::new(&arch, [0.5, 3.0], 1e-9)?;
    traverse(Afra::<u32, _>::new(&Halves(28))?, &mut search, &mut ());
    let [lo, hi] = search.distance();
    println!("t = {}, distance in [{lo}, {hi}], {} intervals split", search.t, search.splits);
    assert!(hi - lo <= 1e-9 && search.splits < 50);
    Ok(())
}

/// Real numbers from `lo` to `hi`. Results are rounded outwards. [CURVE-2]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Interval {
    pub(crate) lo: f64,
    pub(crate) hi: f64,
}

impl Interval {
    fn outwards(lo: f64, hi: f64) -> Self {
        Self { lo: lo.next_down(), hi: hi.next_up() }
    }

    pub(crate) fn difference(a: f64, b: f64) -> Self {
        if a == b { Self::default() } else { Self::outwards(a - b, a - b) }
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        Self::outwards(self.lo + other.lo, self.hi + other.hi)
    }

    pub(crate) fn times(self, other: Self) -> Self {
        let [a, b] = [self.lo * other.lo, self.lo * other.hi];
        let [c, d] = [self.hi * other.lo, self.hi * other.hi];
        Self::outwards(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }

    fn root(self) -> Self {
        let Self { lo, hi } = Self::outwards(self.lo.max(0.0).sqrt(), self.hi.max(0.0).sqrt());
        Self { lo: lo.max(0.0), hi }
    }
}

/// The binary tree of halves of this depth, at most 29: the index of a node is its key. [CURVE-5]
#[derive(Clone, Copy)]
pub(crate) struct Halves(pub(crate) u32);

impl Halves {
    fn at(self, key: u32) -> Node {
        if key >> self.0 == 0 { Node::inner(key) } else { Node::leaf(key) }
    }
}

impl Topology for Halves {
    fn root(&self) -> Node {
        self.at(1)
    }
    fn children(&self, node: Node) -> [Node; 2] {
        halves(node.index()).map(|key| self.at(key as u32))
    }
    fn node_count(&self) -> usize {
        (2 << self.0) - 1
    }
    fn slot(&self, node: Node) -> usize {
        node.index() - 1
    }
    fn depth(&self) -> u32 {
        self.0
    }
    fn recorded(&self) -> Recorded {
        Recorded::ParentSibling
    }
    /// Computes parent and sibling, which other trees store.
    fn links(&self, node: Node) -> [Node; 2] {
        let key = node.index() as u32;
        if key == 1 { [node; 2] } else { [key >> 1, key ^ 1].map(|key| self.at(key)) }
    }
}

fn halves(key: usize) -> [usize; 2] {
    [2 * key, 2 * key + 1]
}

/// The ends of a key's interval.
fn ends(key: usize) -> [f64; 2] {
    let count = 1 << key.ilog2();
    [key - count, key - count + 1].map(|i| i as f64 / count as f64)
}

/// A search for the closest point. [CURVE-1]
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Search {
    /// Control points relative to the given point.
    curve: Vec<[Interval; 2]>,
    pub(crate) tolerance: f64,
    /// The best parameter, and an upper bound of its distance.
    pub(crate) t: f64,
    best: f64,
    /// A lower bound of the distance on skipped intervals and at ends.
    floor: f64,
    splits: u32,
}

impl Search {
    /// Takes control points, a point, and how much farther than the closest point the answer may be.
    pub(crate) fn new(points: &[[f64; 2]], to: [f64; 2], tolerance: f64) -> Result<Self, Box<dyn Error>> {
        let mut numbers = points.as_flattened().iter().chain(&to).chain([&tolerance]);
        if !(2..=9).contains(&points.len()) || !numbers.all(|x| x.abs() <= 2f64.powi(480)) {
            return Err("expected 2 to 9 control points, and numbers up to 2^480".into());
        }
        let curve = points.iter().map(|p| [0, 1].map(|k| Interval::difference(p[k], to[k]))).collect();
        let mut search = Self { curve, tolerance, t: 0.0, best: f64::INFINITY, floor: f64::INFINITY, splits: 0 };
        search.bound(1);
        Ok(search)
    }

    /// Returns bounds of the least distance. The distance at `t` is at most the upper bound.
    pub(crate) fn distance(&self) -> [f64; 2] {
        [self.floor.min(self.best), self.best]
    }

    /// Bounds the distance on an interval by the Bernstein coefficients of its square, and notes the distance at the ends.
    /// Returns also whether splitting gains less than rounding loses. [CURVE-3]
    fn bound(&mut self, key: usize) -> (f64, bool) {
        let ([start, end], n) = (ends(key), self.curve.len() - 1);
        let at = |t: f64| Interval { lo: t, hi: t };
        // A control point of a part is a value of the curve's blossom (Ramshaw 1989).
        let control = |ends| {
            let mut row = self.curve.clone();
            for step in 0..n {
                let t = if step < ends { end } else { start };
                let mix = |a: Interval, b: Interval| a.times(at(1.0 - t)).plus(b.times(at(t)));
                row = row.windows(2).map(|pair| [0, 1].map(|k| mix(pair[0][k], pair[1][k]))).collect();
            }
            row[0]
        };
        let part: Vec<_> = (0..=n).map(control).collect();
        let mut squares = vec![Interval::default(); 2 * n + 1];
        for (i, j) in (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))) {
            let dot = part[i][0].times(part[j][0]).plus(part[i][1].times(part[j][1]));
            let weight = binomial(n, i) * binomial(n, j) / binomial(2 * n, i + j);
            squares[i + j] = squares[i + j].plus(dot.times(Interval::outwards(weight, weight)));
        }
        let [lo, most] = [f64::min, f64::max].map(|of| squares.iter().map(|c| c.lo).fold(squares[0].lo, of));
        let pairs = || squares.windows(2);
        let is_monotone = pairs().all(|c| c[0].hi < c[1].lo) || pairs().all(|c| c[1].hi < c[0].lo);
        for (t, square) in [(start, squares[0]), (end, squares[2 * n])] {
            let distance = square.root();
            self.floor = self.floor.min(distance.lo);
            if distance.hi < self.best {
                (self.t, self.best) = (t, distance.hi);
            }
        }
        // A distance that is monotone is least at an end.
        let least = if is_monotone { f64::INFINITY } else { Interval { lo, hi: most }.root().lo };
        (least, squares.iter().any(|c| c.hi - c.lo >= most - lo))
    }

    /// Whether to split an interval: it may hold a distance that is less than the best by more than the tolerance, and
    /// is not one that rounding hides. [CURVE-4]
    fn wants(&mut self, (least, is_rounded): (f64, bool)) -> bool {
        let limit = (self.best - self.tolerance).next_up().min(self.best);
        let is_wanted = !is_rounded && least < limit;
        if !is_wanted {
            self.floor = self.floor.min(least);
        }
        is_wanted
    }
}

pub(crate) fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |b, i| b * (n - i) as f64 / (i + 1) as f64)
}

impl Visitor for Search {
    fn inner(&mut self, node: Node) -> Descent {
        self.splits += 1;
        let [left, right] = halves(node.index()).map(|half| self.bound(half));
        Descent::new(self.wants(left), self.wants(right), right.0 < left.0)
    }

    fn leaf(&mut self, node: Node) -> Flow {
        let (least, _) = self.bound(node.index());
        self.floor = self.floor.min(least);
        Flow::Continue
    }
}
