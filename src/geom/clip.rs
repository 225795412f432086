//! The part of a triangle inside a box.

use std::ops::RangeInclusive;

use glam::DVec3;

use super::{Aabb, Frame, Triangle, Vector};

impl<V: Vector> Triangle<V> {
    /// Returns the box of the part inside a box, rounded outwards.
    pub fn part(&self, part: &Aabb) -> Aabb {
        Frame::IDENTITY.part(self, part)
    }
}

impl Frame {
    /// Returns a box in this frame that contains the whole part of the triangle inside `part`, exactly, and does not
    /// extend beyond `part` or the triangle's own box. On some axis its `lo` is above its `hi` if no point of the
    /// triangle is inside.
    ///
    /// Take the smallest box of the part of the triangle inside `part`, where `part` is enlarged by 2^-45 of the
    /// triangle's greatest coordinate on each axis. The result is larger than this box by at most the same amount, and
    /// by rounding to single precision.
    ///
    /// # Why nothing is lost
    ///
    /// The triangle is cut by the planes of `part` one after the other (Sutherland & Hodgman 1974, "Reentrant polygon
    /// clipping"), in double precision. Let u = 2^-53, let M be the greatest magnitude of a corner's coordinate on an
    /// axis, and δ = 16uM. After i cuts there is an exact convex polygon X inside the triangle that contains the whole
    /// part of the triangle on the inner sides of the i planes, and whose corners are within iδ of the computed ones on
    /// each axis, in the same order. For i = 0 that is the triangle, whose corners in the frame have an error of uM.
    ///
    /// - *A cut* drops corners beyond the plane moved outwards by 128uM, and puts a point on each edge between a kept
    ///   corner a and a dropped one b: a + t (b - a), with t in \[0, 1\] as computed. Let X' have the points with the
    ///   same t on the edges of X. They lie in order on the border of X, so X' is convex and inside X.
    /// - *Distance.* Let points be within iδ + uM of other points. A convex combination of them is equally near to that
    ///   of the other points. Its evaluation costs less than 6uM, as a and b are at most M + 96uM.
    /// - *Nothing needed is dropped.* t has an error of 3u, so the exact combination is within 7uM of the moved plane,
    ///   and the point of X' within 5δ + 8uM < 89uM; the plane is moved by at least 127uM. So all that X loses is
    ///   between corners strictly beyond the plane itself.
    /// - *The end.* After 6 cuts the box of the computed corners, enlarged by 128uM > 6δ + uM, contains X.
    ///
    /// `[SPLIT-1]` Nothing overflows, and underflow is negligible, if M is 0 or from 2^-900 to 2^1000, as it always is
    /// in single precision. Otherwise, and if a nonzero coordinate has become 0 in the frame, the answer is the
    /// intersection of the two boxes.
    pub fn part<V: Vector>(&self, triangle: &Triangle<V>, part: &Aabb) -> Aabb {
        let whole = self.aabb(triangle);
        let within = whole.intersection(part);
        let corners = triangle.widen().map(|corner| self.rounded(corner));
        let size = corners.into_iter().fold(DVec3::ZERO, |size, corner| size.max(corner.abs()));
        // A coordinate in the frame may be so small that it has become 0. The box shows this.
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

/// A cut adds two corners for each run of dropped corners, and each such run needs a run of kept corners: at most half
/// of the corners. From three corners, six cuts make 4, 6, 9, 13, 19 and 28. (A convex polygon gets nine, but rounding
/// may dent it.)
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

    /// Clips into `left` the part where `sign` times the coordinate is at most `bound`.
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
