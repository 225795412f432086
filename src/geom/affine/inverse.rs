//! The inverse of a matrix, applied to rays that are known within bounds.

use std::ops::RangeInclusive;

use crate::geom::frame::{exponent_of, power_of_two};
use crate::geom::truth::{RBig, round_f64};
use crate::geom::{EnclosedRay, Frame, Interval};

/// The inverse of a matrix of floats. Its entries are rational numbers. `[INST-3]`
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Inverse {
    /// Each row has one entry that is not 0, which is a power of two or its negative.
    Turned([Turn; 3]),
    /// The doubles nearest to the entries, if these are 0 or within the range.
    Nearest([[f64; 3]; 3]),
    /// Bounds of the entries, each as narrow as possible: the entries are doubles, or huge or tiny.
    Bounded([[Interval; 3]; 3]),
}

/// The entry of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Turn {
    column: usize,
    exponent: i32,
    is_negative: bool,
}

/// The share of a component in the error of a row, over the entry: u for the entry, u for the component, 3u for a sum
/// of three products, and u for the ends. `[INST-3]`
const OFF: f64 = 8.0 * (f64::EPSILON / 2.0);

/// The factor of a radius, which covers the loss of evaluating bounds. `[INST-3]`
const WIDER: f64 = 1.0 + 8.0 * f64::EPSILON;

/// Entries other than 0 in [`Inverse::Nearest`].
const USUAL_ENTRIES: RangeInclusive<f64> = power_of_two(-500)..=power_of_two(500);

/// The error of a component other than 0, in [`Inverse::Nearest`].
const USUAL_ERRORS: RangeInclusive<f64> = power_of_two(-400)..=power_of_two(400);

impl Inverse {
    pub(super) const IDENTITY: Self = Self::Turned([Turn::axis(0), Turn::axis(1), Turn::axis(2)]);

    pub(super) fn new(entries: &[[RBig; 3]; 3]) -> Self {
        let bounds = entries.each_ref().map(|row| row.each_ref().map(|x| Interval::around(x.as_relaxed())));
        if let [Some(x), Some(y), Some(z)] = bounds.map(Turn::of_row) {
            return Self::Turned([x, y, z]);
        }
        let nearest = entries.each_ref().map(|row| row.each_ref().map(round_f64));
        let is_exact = bounds.as_flattened().iter().all(Interval::is_exact);
        let mut both = bounds.as_flattened().iter().zip(nearest.as_flattened());
        let is_usual = both.all(|(bounds, x)| bounds.is_zero() || USUAL_ENTRIES.contains(&x.abs()));
        if is_exact || !is_usual { Self::Bounded(bounds) } else { Self::Nearest(nearest) }
    }

    /// Returns bounds of A^-1 (o - b) and A^-1 d for all o and d within the bounds.
    #[inline]
    pub(super) fn pull_back(&self, ray: &EnclosedRay, offset: [f64; 3]) -> EnclosedRay {
        match self {
            Self::Turned(turns) => solve(ray, offset, |v| turns.map(|turn| turn.of(v))),
            Self::Nearest(entries) => {
                let origin = within(entries, ray.origin, offset);
                match (origin, within(entries, ray.direction, [0.0; 3])) {
                    (Some(origin), Some(direction)) => EnclosedRay { origin, direction, ..*ray },
                    _ => by_intervals(&entries.map(|row| row.map(around_nearest)), ray, offset),
                }
            }
            Self::Bounded(entries) => by_intervals(entries, ray, offset),
        }
    }
}

impl Turn {
    const fn axis(column: usize) -> Self {
        Self { column, exponent: 0, is_negative: false }
    }

    /// Returns the entry of a row, if it has no other entry.
    fn of_row(row: [Interval; 3]) -> Option<Self> {
        let column = row.iter().position(|x| !x.is_zero())?;
        let [x, last] = row[column].ends();
        let exponent = exponent_of(x.abs());
        let is_power = x == last && exponent.abs() <= Frame::MAX_EXPONENT && x.abs() == power_of_two(exponent);
        let is_alone = row.iter().filter(|x| x.is_zero()).count() == 2;
        (is_power && is_alone).then_some(Self { column, exponent, is_negative: x < 0.0 })
    }

    /// Multiplies the row by a vector.
    #[inline]
    fn of(self, v: [Interval; 3]) -> Interval {
        let x = v[self.column].scaled(self.exponent);
        if self.is_negative { -x } else { x }
    }
}

/// Multiplies by rows of the nearest doubles, minus an offset; `None` if a number may over- or underflow. A component
/// that is certainly 0 stays 0. `[INST-3]`
#[inline]
fn within(rows: &[[f64; 3]; 3], v: [Interval; 3], offset: [f64; 3]) -> Option<[Interval; 3]> {
    let (mut middle, mut off, mut is_usual) = ([0.0; 3], [0.0; 3], true);
    for k in 0..3 {
        let [x, radius] = v[k].middle_and_radius();
        let x = x - offset[k];
        (middle[k], off[k]) = (x, OFF * x.abs() + WIDER * radius);
        is_usual &= USUAL_ERRORS.contains(&off[k]) || x == 0.0 && radius == 0.0;
    }
    let product = |[a, b, c]: [f64; 3], [x, y, z]: [f64; 3]| a * x + b * y + c * z;
    is_usual.then(|| {
        rows.map(|row| {
            let (x, off) = (product(row, middle), product(row.map(f64::abs), off));
            Interval::between([x - off, x + off])
        })
    })
}

#[inline(never)]
fn by_intervals(rows: &[[Interval; 3]; 3], ray: &EnclosedRay, offset: [f64; 3]) -> EnclosedRay {
    solve(ray, offset, |v| rows.map(|[x, y, z]| x * v[0] + y * v[1] + z * v[2]))
}

#[inline(always)]
fn solve(ray: &EnclosedRay, offset: [f64; 3], by: impl Fn([Interval; 3]) -> [Interval; 3]) -> EnclosedRay {
    let ([x, y, z], [a, b, c]) = (ray.origin, offset.map(Interval::exact));
    EnclosedRay { origin: by([x - a, y - b, z - c]), direction: by(ray.direction), ..*ray }
}

/// Returns bounds of the numbers whose nearest double is this one; 0 is exact.
fn around_nearest(x: f64) -> Interval {
    if x == 0.0 { Interval::exact(0.0) } else { Interval::between([x.next_down(), x.next_up()]) }
}

#[cfg(test)]
mod tests;
