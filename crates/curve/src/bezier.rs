//! Bézier curves, and what is known of their distance on a part of them.

use super::CurveError;
use super::dyadic::Span;
use super::interval::Interval;

/// A Bézier curve of degree 1 to 8 in `D` dimensions, 2 or 3 as a rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bezier<const D: usize> {
    points: [[f64; D]; POINTS],
    degree: usize,
}

const MAX_DEGREE: usize = 8;
const POINTS: usize = MAX_DEGREE + 1;

impl<const D: usize> Bezier<D> {
    /// Greatest degree.
    pub const MAX_DEGREE: usize = MAX_DEGREE;

    /// Greatest coordinate, of either sign: squares of distances do not overflow. 2^480.
    pub const GREATEST: f64 = f64::from_bits((1023 + 480) << 52);

    /// A curve by its control points, of which there is one more than the degree.
    ///
    /// # Errors
    /// [`CurveError::Degree`] and [`CurveError::ControlPoint`].
    pub fn new(control: &[[f64; D]]) -> Result<Self, CurveError> {
        if !(2..=POINTS).contains(&control.len()) {
            return Err(CurveError::Degree(control.len()));
        }
        let mut points = [[0.0; D]; POINTS];
        for (index, (point, given)) in points.iter_mut().zip(control).enumerate() {
            if let Some(coordinate) = out_of_range(given) {
                return Err(CurveError::ControlPoint { index, coordinate });
            }
            *point = *given;
        }
        Ok(Self { points, degree: control.len() - 1 })
    }

    /// The control points.
    pub fn points(&self) -> &[[f64; D]] {
        &self.points[..=self.degree]
    }

    /// The degree.
    pub const fn degree(&self) -> usize {
        self.degree
    }

    /// The curve as seen from a point.
    pub(super) fn seen_from(&self, point: &[f64; D]) -> Result<Seen<D>, CurveError> {
        if let Some(coordinate) = out_of_range(point) {
            return Err(CurveError::Point(coordinate));
        }
        let offset = |control: [f64; D]| std::array::from_fn(|k| Interval::difference(control[k], point[k]));
        Ok(Seen { points: self.points.map(offset), degree: self.degree })
    }
}

/// The first coordinate that is too great, or no number.
fn out_of_range<const D: usize>(point: &[f64; D]) -> Option<f64> {
    // Not `>`, which a NaN is not.
    point.iter().copied().find(|x| !(-Bezier::<D>::GREATEST..=Bezier::<D>::GREATEST).contains(x))
}

/// A curve, or a part of one, relative to the point that is asked about: control points in intervals.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen<const D: usize> {
    points: [[Interval; D]; POINTS],
    degree: usize,
}

/// What is known of the distance on a part of a curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// At most the least distance.
    pub(super) least: f64,
    /// At least the distance at the start, and at the end.
    pub(super) at_ends: [f64; 2],
    /// The distance grows, or shrinks, all the way: it is least at an end, and nowhere else stationary.
    pub(super) is_monotone: bool,
    /// Rounding is at least the difference that splitting could still make.
    pub(super) is_rounded: bool,
}

impl<const D: usize> Seen<D> {
    /// The part over a dyadic interval, by its blossom: control point `i` is that of `n - i` starts and `i` ends
    /// (Ramshaw 1989, "Blossoms are polar forms"). From the whole curve each time, so that rounding does not grow with
    /// depth.
    pub(super) fn part(&self, span: Span) -> Self {
        let ([start, end], n) = (span.ends(), self.degree);
        let (mut part, mut from_start) = (*self, *self);
        for starts in 0..=n {
            let mut row = from_start;
            for length in (1..=n - starts).rev() {
                row.step(length, end);
            }
            part.points[n - starts] = row.points[0];
            from_start.step(n - starts, start);
        }
        part
    }

    /// Both halves (de Casteljau).
    pub(super) fn halves(&self) -> [Self; 2] {
        let n = self.degree;
        let (mut left, mut right) = (*self, *self);
        for length in (1..=n).rev() {
            for i in 0..length {
                let (from, to) = (right.points[i], right.points[i + 1]);
                right.points[i] = std::array::from_fn(|k| from[k].mean(to[k]));
            }
            // What ends a row ends the right half, which it stays in.
            left.points[n + 1 - length] = right.points[0];
        }
        [left, right]
    }

    /// One row of de Casteljau's scheme, of this length.
    fn step(&mut self, length: usize, t: f64) {
        for i in 0..length {
            let (from, to) = (self.points[i], self.points[i + 1]);
            self.points[i] = std::array::from_fn(|k| from[k].toward(to[k], t));
        }
    }

    /// What the Bernstein coefficients of the squared distance say: it is between the least and the greatest of them,
    /// it is the first and the last one at the ends, and it is monotone if they are. `[CURVE-3]`
    pub(super) fn bounds(&self) -> Bounds {
        let (squares, count) = self.squares();
        let squares = &squares[..count];
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut rounding = 0f64;
        for square in squares {
            (least, most) = (least.min(square.lo), most.max(square.lo));
            rounding = rounding.max(square.hi - square.lo);
        }
        let pairs = || squares.iter().zip(&squares[1..]);
        let is_monotone = pairs().all(|(a, b)| a.hi < b.lo) || pairs().all(|(a, b)| b.hi < a.lo);
        Bounds {
            least: root_down(least),
            at_ends: [squares[0], squares[count - 1]].map(|square| root_up(square.hi)),
            is_monotone,
            is_rounded: most - least <= rounding,
        }
    }

    /// At most and at least the distance at the start, and at the end, of the part.
    pub(super) fn ends(&self) -> [[f64; 2]; 2] {
        [self.points[0], self.points[self.degree]].map(|end| {
            let square = norm(&end);
            [root_down(square.lo), root_up(square.hi)]
        })
    }

    /// Bernstein coefficients of the squared distance, of twice the degree, and their number.
    fn squares(&self) -> ([Interval; 2 * MAX_DEGREE + 1], usize) {
        let n = self.degree;
        let mut squares = [Interval::default(); 2 * MAX_DEGREE + 1];
        for (i, a) in self.points[..=n].iter().enumerate() {
            let own = norm(a).times(BINOMIALS[n][i] * BINOMIALS[n][i]);
            squares[2 * i] = squares[2 * i].plus(own);
            // Pairs count twice.
            for (j, b) in self.points[..=n].iter().enumerate().skip(i + 1) {
                let both = dot(a, b).times(2.0 * BINOMIALS[n][i] * BINOMIALS[n][j]);
                squares[i + j] = squares[i + j].plus(both);
            }
        }
        for (k, square) in squares[..=2 * n].iter_mut().enumerate() {
            *square = square.over(BINOMIALS[2 * n][k]);
        }
        (squares, 2 * n + 1)
    }
}

pub(super) fn dot<const D: usize>(a: &[Interval; D], b: &[Interval; D]) -> Interval {
    let products = a.iter().zip(b).map(|(a, b)| a.product(*b));
    products.reduce(Interval::plus).unwrap_or_default()
}

/// The square of a length: of one and the same point, where [`dot`] would allow for two in the same intervals.
pub(super) fn norm<const D: usize>(a: &[Interval; D]) -> Interval {
    a.iter().map(|a| a.square()).reduce(Interval::plus).unwrap_or_default()
}

fn root_down(square: f64) -> f64 {
    square.max(0.0).sqrt().next_down().max(0.0)
}

fn root_up(square: f64) -> f64 {
    square.sqrt().next_up()
}

/// Binomial coefficients up to twice the greatest degree.
const BINOMIALS: [[f64; 2 * MAX_DEGREE + 1]; 2 * MAX_DEGREE + 1] = {
    let mut table = [[0.0; 2 * MAX_DEGREE + 1]; 2 * MAX_DEGREE + 1];
    let mut n = 0;
    while n <= 2 * MAX_DEGREE {
        table[n][0] = 1.0;
        let mut k = 1;
        while k <= n {
            table[n][k] = table[n - 1][k - 1] + table[n - 1][k];
            k += 1;
        }
        n += 1;
    }
    table
};
