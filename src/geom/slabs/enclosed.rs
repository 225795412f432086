//! The slab test for a ray that is known within bounds.

use glam::{Vec3, Vec4};

use super::{Intervals, MAX_COORDINATE, MISSED, STEPS, Slabs, near_and_far};
use crate::geom::region::SHORT;
use crate::geom::{EnclosedRay, Interval, Ray, Region};

/// A slab test that skips no box that any ray within the bounds touches. `[INST-4]`
///
/// At distances that are not negative, a ray is never above the line from the greatest origin in the greatest
/// direction, and never below the line from the least origin in the least direction. So two distances bound the part of
/// the ray in a box: that at which the first line reaches the lower plane, and that at which the second line reaches
/// the upper plane. In single precision, with reciprocals that are moved as in [`Directed`](super::Directed), this
/// takes the same instructions.
///
/// Boxes may be in a [frame](crate::geom::Frame): the ray is transformed into it. For a ray that was moved to its entry
/// into the region, reported distances are relative to its original start. `[INST-7]`
#[derive(Clone, Copy, Debug)]
pub struct EnclosedSlabs {
    /// Greatest and least origin, in the lanes of lo and hi, twice.
    origin: [Vec4; 3],
    inverse: [Vec4; 3],
    tmin: f32,
    is_wide: bool,
    /// Whether the lanes suffice, unless the ray [is wide](Self::is_wide).
    is_single: bool,
    ray: EnclosedRay,
}

impl EnclosedSlabs {
    /// Prepares a ray from `tmin` on. `region` must contain all boxes of the tests.
    pub fn of(ray: &EnclosedRay, tmin: f32, region: &Region) -> Self {
        if !region.frame().is_identity() {
            return Self::in_frame(&region.frame().ray(ray), tmin, region);
        }
        Self::in_frame(ray, tmin, region)
    }

    /// Prepares a ray in the frame of the region.
    #[inline(always)]
    fn in_frame(ray: &EnclosedRay, tmin: f32, region: &Region) -> Self {
        // Written out: closures over three axes are not inlined here, and took most of the time.
        let ([x, y, z], is_single) = match (lanes(ray, 0), lanes(ray, 1), lanes(ray, 2)) {
            (Some(x), Some(y), Some(z)) => ([x, y, z], region.reach_in_frame() <= MAX_COORDINATE && is_long(ray)),
            _ => (Default::default(), false),
        };
        let is_wide = !is_single || ray.start != Interval::exact(0.0);
        let twice = |[lo, hi]: [f32; 2]| Vec4::new(lo, hi, lo, hi);
        let origin = [twice(x[0]), twice(y[0]), twice(z[0])];
        let inverse = [twice(x[1]), twice(y[1]), twice(z[1])];
        Self { origin, inverse, tmin, is_wide, is_single, ray: *ray }
    }

    /// Returns for each axis and for the lower and the upper plane the start of the bounding ray and the reciprocal of
    /// its direction, which is negative if the ray runs backward. Meaningless if it [is wide](Self::is_wide).
    #[inline(always)]
    pub(in crate::geom) fn axes(&self) -> [[[f32; 2]; 2]; 3] {
        [0, 1, 2].map(|axis| {
            let (origin, inverse) = (self.origin[axis], self.inverse[axis]);
            [[origin.x, inverse.x], [origin.y, inverse.y]]
        })
    }

    /// Returns the start of the ray.
    #[inline(always)]
    pub(in crate::geom) fn tmin(&self) -> f32 {
        self.tmin
    }

    /// Returns whether it is tested in double precision.
    #[inline(always)]
    pub(in crate::geom) fn is_wide(&self) -> bool {
        self.is_wide
    }

    /// Tests distant rays from their entry into the region, and rays for which single precision does not suffice.
    #[cold]
    #[inline(never)]
    fn pair_wide(&self, planes: &[[f32; 4]; 3], tmax: f32) -> [f32; 4] {
        let met = if self.is_single { self.met_in_single(planes) } else { self.met_in_double(planes) };
        let lanes = met.map(|[near, far]| {
            let [near, far] =
                if near <= far { (Interval::between([near, far]) + self.ray.start).ends() } else { [near, far] };
            // Rounding keeps the order, so entries are rounded before they are compared with the rounded distance of a hit.
            let [near, far] = [near as f32, far as f32];
            if near <= far && self.tmin <= far { [near.max(self.tmin), far.min(tmax)] } else { MISSED }
        });
        [lanes[0][0], lanes[0][1], lanes[1][0], lanes[1][1]]
    }

    /// Returns the entries and exits of the ray for two boxes, from its origin on, by the lanes.
    fn met_in_single(&self, planes: &[[f32; 4]; 3]) -> [[f64; 2]; 2] {
        let Intervals { hit, near, far } =
            Intervals::of_lanes(near_and_far(planes, &self.origin, &self.inverse, 0.0, f32::INFINITY));
        // These distances are rounded.
        [0, 1].map(|i| if hit[i] { [near[i].next_down().max(0.0), far[i].next_up()] } else { MISSED }.map(f64::from))
    }

    /// Returns the entries and exits in double precision, each operation rounded outwards: for rays that may run in
    /// either direction along an axis, and for huge and tiny numbers.
    fn met_in_double(&self, planes: &[[f32; 4]; 3]) -> [[f64; 2]; 2] {
        let (mut near, mut far) = ([0.0_f64; 2], [f64::INFINITY; 2]);
        for (axis, planes) in planes.iter().enumerate() {
            let ([o_least, o_most], [d_least, d_most]) =
                (self.ray.origin[axis].ends(), self.ray.direction[axis].ends());
            for side in 0..2 {
                let [lo, hi] = [0, 1].map(|plane| f64::from(planes[2 * side + plane]));
                // o_most + t d_most >= lo, and likewise for hi with all signs changed.
                for (way, speed) in [((lo - o_most).next_down(), d_most), ((o_least - hi).next_down(), -d_least)] {
                    // A NaN is no bound.
                    let t = way / speed;
                    if speed > 0.0 {
                        near[side] = near[side].max(t.next_down());
                    } else if speed < 0.0 {
                        far[side] = far[side].min(t.next_up());
                    } else if speed == 0.0 && way >= 0.0 {
                        // It was above 0 before it was rounded down.
                        far[side] = f64::NEG_INFINITY;
                    }
                }
            }
        }
        [0, 1].map(|side| [near[side], far[side]])
    }
}

/// Returns whether a direction is long enough for the replacement of a component 0 to have no effect. `[BOX-9]`
fn is_long(ray: &EnclosedRay) -> bool {
    ray.direction.iter().any(|x| x.ends()[0] >= SHORT || x.ends()[1] <= -SHORT)
}

/// Returns for the lower and the upper plane of an axis the start of the bounding ray and the reciprocal of its
/// direction. `None` if single precision does not suffice.
fn lanes(ray: &EnclosedRay, axis: usize) -> Option<[[f32; 2]; 2]> {
    let ([o_least, o_most], [d_least, d_most]) =
        (ray.origin[axis].ends_in_single(), ray.direction[axis].ends_in_single());
    let is_usual = |d: f32| d.is_finite() && d.recip().is_finite();
    let moved = |d: f32, by: i32| f32::from_bits(d.recip().to_bits().wrapping_add_signed(by));
    let (toward, away) = (-(STEPS as i32), STEPS as i32);
    let inverse = if ray.direction[axis].is_zero() {
        [moved(0.0, toward), f32::INFINITY]
    } else if !(is_usual(d_least) && is_usual(d_most)) {
        return None;
    } else if d_least > 0.0 {
        [moved(d_most, toward), moved(d_least, away)]
    } else if d_most < 0.0 {
        [moved(d_most, away), moved(d_least, toward)]
    } else {
        return None;
    };
    let is_near = o_least >= -MAX_COORDINATE && o_most <= MAX_COORDINATE;
    is_near.then_some([[o_most, o_least], inverse])
}

impl Slabs for EnclosedSlabs {
    type Vector = Vec3;

    fn new(ray: &Ray, region: &Region) -> Self {
        Self::of(&EnclosedRay::exact(ray), ray.tmin(), region)
    }

    #[inline(always)]
    fn pair(&self, planes: &[[f32; 4]; 3], tmax: f32) -> Intervals<f32> {
        Intervals::of_lanes(if self.is_wide {
            [Vec4::from_array(self.pair_wide(planes, tmax)); 2]
        } else {
            near_and_far(planes, &self.origin, &self.inverse, self.tmin, tmax)
        })
    }
}

#[cfg(test)]
mod tests;
