//! The search: a visitor of the tree of dyadic intervals.

use std::fmt;

use super::CurveError;
use super::bezier::{Bezier, Bounds, Seen};
use super::dyadic::{Dyadic, Span};
use stackless_bvh::event::Recorder;
use stackless_bvh::order::{ByNode, Descent, FixedOrder, Flow, NodeTest, Visitor, Whole};
use stackless_bvh::traverse::{Context, Cursor, Method, Unfit, traverse, traverse_pruned};
use stackless_bvh::tree::Node;

/// What a search is to reach, and how.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Width of the enclosure that is wanted, in units of the coordinates. 0: as narrow as rounding allows.
    pub tolerance: f64,
    /// Intervals that may be split. About as many visits as the tree has levels can follow.
    pub budget: u32,
    /// The traversal, one of [`METHODS`](Self::METHODS).
    pub method: Method,
}

impl Options {
    /// The traversals that need no table of all nodes and do not ask about a node again.
    pub const METHODS: [Method; 13] = [
        Method::Stack,
        Method::LeftFirst,
        Method::ImplicitA,
        Method::ImplicitA1,
        Method::ImplicitB,
        Method::ImplicitB1,
        Method::Sparse,
        Method::Hapala,
        Method::Afra,
        Method::Uncle,
        Method::HashOnly,
        Method::Hashed,
        Method::Complete,
    ];
}

impl Default for Options {
    fn default() -> Self {
        Self { tolerance: 1e-9, budget: 10_000, method: Method::ImplicitB1 }
    }
}

/// The closest point of a curve, as far as it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// The best parameter that was met.
    pub t: f64,
    /// The least distance of the curve is between these, both included. At `t` the distance is at most the greater one.
    pub distance: [f64; 2],
    /// Number of intervals that were split.
    pub steps: u32,
    /// Whether the tolerance was met.
    pub end: End,
}

/// Why a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The enclosure is at most as wide as the tolerance.
    Reached,
    /// The budget is spent.
    OutOfSteps,
    /// What is left cannot be split any more, or rounding hides the difference.
    Rounding,
}

impl fmt::Display for End {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Reached => "reached",
            Self::OutOfSteps => "out of steps",
            Self::Rounding => "rounding",
        })
    }
}

impl<const D: usize> Bezier<D> {
    /// The point of the curve that is closest to `point`. `[CURVE-1]`
    ///
    /// ```
    /// use stackless_curve::{Bezier, End, Options};
    ///
    /// let arch = Bezier::new(&[[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]])?;
    /// let closest = arch.closest(&[1.0, 3.0], &Options::default())?;
    /// assert_eq!((closest.t, closest.end), (0.5, End::Reached));
    /// let [lo, hi] = closest.distance;
    /// assert!(lo <= 2.0 && 2.0 <= hi && hi - lo <= 1e-9);
    /// # Ok::<(), stackless_curve::CurveError>(())
    /// ```
    ///
    /// # Errors
    /// [`CurveError::Point`], [`CurveError::Tolerance`] and [`CurveError::Method`].
    pub fn closest(&self, point: &[f64; D], options: &Options) -> Result<Closest, CurveError> {
        let mut search = Search::new(self, point, options)?;
        search.run(options.method, Dyadic::new(LEVELS), &mut ())?;
        Ok(search.closest())
    }
}

/// Levels of each of the two trees. `[CURVE-5]`
pub(super) const LEVELS: u32 = 26;

/// A search for the closest point. It does not know which traversal it is in.
#[derive(Clone, Debug)]
pub(super) struct Search<const D: usize> {
    curve: Seen<D>,
    tolerance: f64,
    budget: u32,
    steps: u32,
    /// The best parameter, and at least its distance.
    t: f64,
    best: f64,
    /// At most the distance of all that was left out.
    floor: f64,
}

impl<const D: usize> Search<D> {
    pub(super) fn new(curve: &Bezier<D>, point: &[f64; D], options: &Options) -> Result<Self, CurveError> {
        let &Options { tolerance, budget, .. } = options;
        if tolerance.is_nan() || tolerance < 0.0 {
            return Err(CurveError::Tolerance(tolerance));
        }
        let curve = curve.seen_from(point)?;
        // The ends of the curve: everywhere else a least distance is stationary.
        let [start, end] = curve.ends();
        let mut search =
            Self { curve, tolerance, budget, steps: 0, t: 0.0, best: start[1], floor: start[0].min(end[0]) };
        search.meet(1.0, end[1]);
        Ok(search)
    }

    /// Goes through both trees; the recorder sees the upper one.
    pub(super) fn run(&mut self, method: Method, tree: Dyadic, recorder: &mut impl Recorder) -> Result<(), CurveError> {
        let lower = |level: &mut Level<'_, D>| {
            let fits = walk(method, tree, level, &mut ());
            debug_assert_eq!(fits, Ok(()), "the upper tree is as deep");
        };
        walk(method, tree, &mut self.level(Some(&lower)), recorder)
    }

    /// The upper tree, with what to do below its leaves. Without, it is the only one.
    pub(super) fn level<'a>(&'a mut self, lower: Option<&'a dyn Fn(&mut Level<'_, D>)>) -> Level<'a, D> {
        Level { search: self, root: Span::ALL, lower }
    }

    pub(super) fn closest(&self) -> Closest {
        let lo = self.floor.min(self.best);
        let end = match () {
            () if lo >= self.limit() => End::Reached,
            () if self.is_spent() => End::OutOfSteps,
            () => End::Rounding,
        };
        Closest { t: self.t, distance: [lo, self.best], steps: self.steps, end }
    }

    /// What is at least so far away need not be looked at: it is no better than the best, or better by no more than the
    /// tolerance. `[CURVE-4]`
    fn limit(&self) -> f64 {
        (self.best - self.tolerance).next_up().min(self.best)
    }

    fn is_spent(&self) -> bool {
        self.steps >= self.budget
    }

    /// Splits an interval: which halves are wanted, and which is nearer.
    fn split(&mut self, span: Span) -> Descent {
        if self.is_spent() {
            self.leave(span);
            return Descent::NEITHER;
        }
        self.steps += 1;
        let [start, end] = span.ends();
        let [left, right] = self.curve.part(span).halves().map(|half| half.bounds());
        self.meet(start.midpoint(end), left.at_ends[1].min(right.at_ends[0]));
        Descent::new(self.wants(&left), self.wants(&right), right.least < left.least)
    }

    /// Looks at an interval itself: whether its halves are to be looked at.
    fn accept(&mut self, span: Span) -> bool {
        let bounds = self.curve.part(span).bounds();
        for (t, distance) in span.ends().into_iter().zip(bounds.at_ends) {
            self.meet(t, distance);
        }
        if self.is_spent() {
            self.leave_out(&bounds);
            return false;
        }
        self.steps += 1;
        self.wants(&bounds)
    }

    /// Leaves an interval out that is wanted.
    fn leave(&mut self, span: Span) {
        self.leave_out(&self.curve.part(span).bounds());
    }

    fn wants(&mut self, bounds: &Bounds) -> bool {
        let is_wanted = !bounds.is_monotone && !bounds.is_rounded && bounds.least < self.limit();
        if !is_wanted {
            self.leave_out(bounds);
        }
        is_wanted
    }

    /// What is monotone has its least distance at an end: it is stationary nowhere, and the ends of the curve are
    /// known.
    fn leave_out(&mut self, bounds: &Bounds) {
        if !bounds.is_monotone {
            self.floor = self.floor.min(bounds.least);
        }
    }

    fn meet(&mut self, t: f64, distance: f64) {
        if distance < self.best {
            (self.t, self.best) = (t, distance);
        }
    }
}

/// A search in one of the two trees.
pub(super) struct Level<'a, const D: usize> {
    search: &'a mut Search<D>,
    /// The interval of the tree's root.
    root: Span,
    lower: Option<&'a dyn Fn(&mut Level<'_, D>)>,
}

impl<const D: usize> Level<'_, D> {
    fn look_below(&mut self, leaf: Node) {
        let root = self.root.below(leaf);
        match self.lower {
            Some(lower) => lower(&mut Level { search: self.search, root, lower: None }),
            None => self.search.leave(root),
        }
    }
}

impl<const D: usize> Visitor for Level<'_, D> {
    fn inner(&mut self, node: Node) -> Descent {
        self.search.split(self.root.below(node))
    }

    fn leaf(&mut self, node: Node) -> Flow {
        self.look_below(node);
        Flow::Continue
    }
}

impl<const D: usize> NodeTest for Level<'_, D> {
    fn accept(&mut self, node: Node) -> bool {
        self.search.accept(self.root.below(node))
    }

    fn leaf(&mut self, node: Node) -> Flow {
        self.look_below(node);
        Flow::Continue
    }
}

/// Runs a traversal over a tree that is not stored: what other trees have in tables is computed here.
pub(super) fn walk<const D: usize>(
    method: Method,
    tree: Dyadic,
    level: &mut Level<'_, D>,
    recorder: &mut impl Recorder,
) -> Result<(), CurveError> {
    if !Options::METHODS.contains(&method) {
        return Err(CurveError::Method(method));
    }
    let walk = Walk { tree: &tree, level, recorder };
    // No tree here is as deep as 31.
    method.dispatch::<u32, _>(walk).map_err(|_| CurveError::Method(method))
}

struct Walk<'t, 'a, 'l, R, const D: usize> {
    tree: &'t Dyadic,
    level: &'a mut Level<'l, D>,
    recorder: &'a mut R,
}

/// Nothing stops it.
impl<'t, R: Recorder, const D: usize> Context<'t, u32> for Walk<'t, '_, '_, R, D> {
    type From = &'t Dyadic;
    type Output = ();

    fn by_parent<C: Cursor>(self, start: impl Fn(&'t Dyadic) -> Result<C, Unfit>) -> Result<(), Unfit> {
        traverse_pruned(start(self.tree)?, &mut Whole(self.level), self.recorder);
        Ok(())
    }

    fn by_node<C: Cursor, O: FixedOrder>(
        self,
        start: impl Fn(&'t Dyadic) -> Result<(C, O), Unfit>,
    ) -> Result<(), Unfit> {
        let (cursor, order) = start(self.tree)?;
        traverse(cursor, &mut ByNode { test: self.level, order }, self.recorder);
        Ok(())
    }
}
