//! The part of a triangle that is inside of a box.

use std::ops::RangeInclusive;

use glam::DVec3;

use super::{Aabb, Frame, Triangle, Vector};

impl<V: Vector> Triangle<V> {
    /// [`Frame::part`] in the coordinates as they are.
    pub fn part(&self, part: &Aabb) -> Aabb {
        Frame::IDENTITY.part(self, part)
    }
}

impl Frame {
    /// A box in this frame that holds all of the triangle that is inside of `part`, exactly, and does not stick out of
    /// `part` or of the triangle's own box. On some axis its `lo` is above its `hi` if no point of the triangle is inside.
    ///
    /// It is hardly larger than the smallest box of what is inside of `part` grown by 2^-45 of the triangle's greatest
    /// coordinate on each axis: by as much again, and by rounding to single precision.
    ///
    /// # Why nothing is lost
    ///
    /// The triangle is cut by the planes of `part` one after the other (Sutherland & Hodgman 1974, "Reentrant polygon
    /// clipping"), in double precision. Let u = 2^-53, let M be the greatest magnitude of a corner's coordinate on an
    /// axis, and δ = 16uM. After i cuts there is an exact convex polygon X inside of the triangle that holds all of the
    /// triangle on the inner sides of the i planes, and whose corners are within iδ of the computed ones on each axis,
    /// in the same order. For i = 0 that is the triangle, whose corners in the frame are off by uM.
    ///
    /// - *A cut* drops corners beyond the plane moved outwards by 128uM, and puts a point on each edge between a kept
    ///   corner a and a dropped one b: a + t (b - a), with t in \[0, 1\] as computed. Let X' have the points with the same
    ///   t on the edges of X. They lie in order on the border of X, so X' is convex and inside of X.
    /// - *Distance.* A convex combination of points that are within iδ + uM of others is as near to theirs.
    ///   Evaluating it costs less than 6uM, as a and b are at most M + 96uM.
    /// - *Nothing needed is dropped.* t has an error of 3u, so the exact combination is within 7uM of the moved plane,
    ///   and
    ///   the point of X' within 5δ + 8uM < 89uM, the least that the plane is moved by being 127uM. So all that X loses is
    ///   between corners strictly beyond the plane itself.
    /// - *The end.* After 6 cuts the box of the computed corners, grown by 128uM > 6δ + uM, holds X.
    ///
    /// `[SPLIT-1]` Nothing overflows, and what underflows is too small to matter, if M is 0 or from 2^-900 to 2^1000,
    /// as in single precision it always is. Otherwise, also where a coordinate in the frame has become 0 and was not, the
    /// answer is the intersection of the two boxes.
    pub fn part<V: Vector>(&self, triangle: &Triangle<V>, part: &Aabb) -> Aabb {
        let whole = self.aabb(triangle);
        let within = whole.intersection(part);
        let corners = triangle.widen().map(|corner| self.rounded(corner));
        let size = corners.into_iter().fold(DVec3::ZERO, |size, corner| size.max(corner.abs()));
        // A coordinate in the frame may be so small that it has become 0: the box knows.
        let is_zero = |axis: usize| whole.lo[axis] == 0.0 && whole.hi[axis] == 0.0;
        if !(0..3).all(|axis| is_zero(axis) || RANGE.contains(&size[axis])) {
            return within;
        }
        let margin = size * MARGIN;
        let mut buffers = [Polygon::of(corners), Polygon::EMPTY];
        let [mut polygon, mut room] = buffers.each_mut();
        let mut cut = |axis: usize, sign: f64, plane: f32| {
            polygon.cut(axis, sign, sign * f64::from(plane) + margin[axis], room);
            std::mem::swap(&mut polygon, &mut room);
        };
        for axis in 0..3 {
            if whole.hi[axis] > part.hi[axis] {
                cut(axis, 1.0, part.hi[axis]);
            }
            if part.lo[axis] > whole.lo[axis] {
                cut(axis, -1.0, part.lo[axis]);
            }
        }
        let Some((&first, others)) = polygon.corners().split_first() else { return Aabb::EMPTY };
        let (lo, hi) = others.iter().fold((first, first), |(lo, hi), &v| (lo.min(v), hi.max(v)));
        Self::IDENTITY.aabb_of(&[lo - margin, hi + margin, lo]).intersection(&within)
    }
}

/// 128 u.
const MARGIN: f64 = 128.0 * (0.5 * f64::EPSILON);

/// 2^-900 to 2^1000.
const RANGE: RangeInclusive<f64> = f64::from_bits((1023 - 900) << 52)..=f64::from_bits((1023 + 1000) << 52);

/// A cut adds two corners for each run of dropped ones, and as many runs are kept: so at most half as many as there
/// were. Six cuts make 4, 6, 9, 13, 19 and 28 of three. (Of a convex polygon they make nine, but rounding may dent it.)
const MOST: usize = 28;

#[derive(Clone, Copy)]
struct Polygon {
    corners: [DVec3; MOST],
    count: usize,
}

impl Polygon {
    const EMPTY: Self = Self { corners: [DVec3::ZERO; MOST], count: 0 };

    fn of(corners: [DVec3; 3]) -> Self {
        let mut polygon = Self::EMPTY;
        polygon.corners[..3].copy_from_slice(&corners);
        polygon.count = 3;
        polygon
    }

    fn corners(&self) -> &[DVec3] {
        &self.corners[..self.count]
    }

    fn push(&mut self, corner: DVec3) {
        self.corners[self.count] = corner;
        self.count += 1;
    }

    /// Makes `left` what is left where `sign` times the coordinate is at most `bound`.
    fn cut(&self, axis: usize, sign: f64, bound: f64, left: &mut Self) {
        left.count = 0;
        let mut last = self.corners().last().copied().unwrap_or_default();
        for &next in self.corners() {
            let [from, to] = [last, next].map(|v| sign * v[axis]);
            if (from <= bound) != (to <= bound) {
                let (kept, dropped) = if from <= bound { (last, next) } else { (next, last) };
                let t = (bound - sign * kept[axis]) / (sign * dropped[axis] - sign * kept[axis]);
                left.push(kept + (dropped - kept) * t);
            }
            if to <= bound {
                left.push(next);
            }
            last = next;
        }
    }
}

#[cfg(test)]
mod tests;
