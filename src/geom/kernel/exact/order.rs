//! The order of hits whose rounded distances are equal. `[EXACT-13]`
//!
//! Nearly all such hits are the faces around an edge or a corner that the line meets, and faces of one floor or wall,
//! which may coincide. Their exact distances are equal, which the code decides without computing them. Other hits are
//! compared by numbers of twice the digits, and by exact sums if these do not decide.

use std::cmp::Ordering;

use dashu_ratio::Relaxed;
use glam::DVec3;

use super::fine::FineDeterminants;
use super::{predicates, quotient};
use crate::geom::fine::Fine;

/// A triangle and a ray whose line meets it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing<'a> {
    pub(super) corners: &'a [DVec3; 3],
    pub(super) o: DVec3,
    pub(super) d: DVec3,
    /// Whether twice the digits have room: no number is above 2^200.
    pub(super) has_room: bool,
}

impl Crossing<'_> {
    /// Compares the exact distances of two crossings. The rays may be images of one ray under maps: a distance is the
    /// same in every space.
    #[cold]
    #[inline(never)]
    pub(super) fn compare(&self, other: &Self) -> Ordering {
        let is_one_ray = self.o == other.o && self.d == other.d;
        if is_one_ray && self.is_met_with(other) {
            return Ordering::Equal;
        }
        let by_digits = || {
            let is_known = self.has_room && other.has_room;
            is_known.then(|| self.fine().compare_distance(&other.fine())).flatten()
        };
        by_digits().unwrap_or_else(|| self.fraction().cmp(&other.fraction()))
    }

    /// Compares the exact distance with a float.
    #[cold]
    #[inline(never)]
    pub(super) fn compare_with(&self, t: f64) -> Ordering {
        let Ok(exact) = Relaxed::try_from(t) else { return 0_f64.total_cmp(&t) };
        let by_digits = self.has_room.then(|| self.fine().compare_distance_with(Fine::exact(t))).flatten();
        by_digits.unwrap_or_else(|| self.fraction().cmp(&exact))
    }

    /// Returns whether the line of one ray certainly meets both triangles in one point.
    fn is_met_with(&self, other: &Self) -> bool {
        let (Self { corners, o, d, has_room }, others) = (*self, other.corners);
        let has_room = has_room && other.has_room;
        let shared = corners.map(|corner| others.contains(&corner));
        let is_through = |corner: DVec3| {
            // Relative to the origin, the corner is along the direction.
            DVec3::AXES.iter().all(|&axis| predicates::sign(axis, [DVec3::ZERO, d], [o, corner], has_room).is_eq())
        };
        let [a, b, c] = *corners;
        let is_on_shared = match shared {
            [true, true, true] => true,
            [true, true, false] => predicates::edge(d, o, a, b, has_room).is_eq(),
            [false, true, true] => predicates::edge(d, o, b, c, has_room).is_eq(),
            [true, false, true] => predicates::edge(d, o, c, a, has_room).is_eq(),
            [true, false, false] => is_through(a),
            [false, true, false] => is_through(b),
            [false, false, true] => is_through(c),
            [false, false, false] => false,
        };
        is_on_shared || are_in_one_wall(corners, others)
    }

    fn fine(&self) -> FineDeterminants {
        FineDeterminants::new(self.corners, self.o, self.d)
    }

    fn fraction(&self) -> Relaxed {
        quotient::fraction(self.corners, self.o, self.d)
    }
}

/// Returns whether triangles lie in one plane across an axis, like floors, or along one, like walls on one line: seen
/// along the axis, their corners are two points.
fn are_in_one_wall(corners: &[DVec3; 3], others: &[DVec3; 3]) -> bool {
    let all = || corners.iter().chain(others);
    (0..3).any(|k| {
        let seen = |corner: &DVec3| [corner[(k + 1) % 3], corner[(k + 2) % 3]];
        let first = seen(&corners[0]);
        let second = all().map(seen).find(|point| *point != first).unwrap_or(first);
        all().all(|corner| corner[k] == corners[0][k]) || all().all(|corner| [first, second].contains(&seen(corner)))
    })
}

#[cfg(test)]
mod tests;
