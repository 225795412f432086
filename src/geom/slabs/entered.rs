//! The slab test in double precision, from the entry of a ray into the region of all boxes.

use glam::DVec3;

use super::{Doubled, Intervals, MAX_COORDINATE};
use crate::geom::fine::{Fine, shortened};
use crate::geom::frame::{exponent_of, power_of_two};
use crate::geom::kernel::USUAL;
use crate::geom::truth::{Relaxed, first_touch};
use crate::geom::{Interval, Ray, Region};

/// A slab test for rays that single precision does not support, in either precision: from far away, and with huge and
/// tiny numbers. It skips no box that the ray touches. `[BOX-9]`
///
/// The ray starts at its entry into the region of all boxes, so doubles are finer than boxes, for any origin. If
/// doubles do not determine the entry, the computation takes some microseconds.
#[derive(Clone, Copy, Debug)]
pub(in crate::geom) struct Entered {
    /// In the frame of the boxes, from the entry on.
    pub(super) slabs: Doubled,
    /// Bounds of the distance at which the ray enters.
    pub(super) start: Interval,
    /// Exponent of the slabs' unit of distance.
    pub(super) exponent: i32,
    pub(super) tmin: f64,
}

/// Whether a ray enters a region, if doubles decide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Approach<E> {
    /// It does not enter.
    Misses,
    /// It enters; the ray from there on.
    Enters(E),
    /// Doubles do not decide.
    Unknown,
}

/// A ray from its entry into the region, or from before that, in the frame of the boxes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) origin: [Interval; 3],
    /// The greatest component is from 1 to 2.
    pub(super) direction: [Interval; 3],
    /// The distance, in units of 2 to the power of `exponent`.
    pub(super) start: f64,
    pub(super) exponent: i32,
}

/// The greatest component of a direction is within 2^-1000 to 2^1000.
pub(super) const MAX_LENGTH: i32 = 1000;

/// Units are within 2^-800 to 2^800. So the least distances of single precision in one unit are normal doubles in the
/// other, and subnormal distances in the other unit are negligible in the first.
pub(super) const MAX_UNIT: i32 = 800;

/// If bounds of the entry are farther apart than this fraction of the region, single precision is finer.
const FINE: f64 = power_of_two(-24);

/// Number of regions from which on a distance is far; doubles suffice for nearer rays.
const FAR: f64 = power_of_two(12);

impl Approach<Entry> {
    /// Transforms a ray into the frame of the boxes, and moves it to its entry into their region.
    pub(super) fn of(ray: &Ray<DVec3>, region: &Region) -> Self {
        if region.is_passed_by(ray) {
            return Self::Misses;
        }
        let frame = region.frame();
        let Some([_, exponent]) = lengths(ray, region) else { return Self::Unknown };
        let origin = [0, 1, 2].map(|axis| frame.coordinate(axis, ray.origin()[axis]));
        // Rounded down: to the next double, if it underflows.
        let [tmin, _] = Interval::exact(ray.tmin()).scaled(-exponent).ends();
        Self::on(ray, region, origin, tmin)
    }

    /// Moves a ray from a point of its line that is known within bounds, in the frame.
    #[inline]
    pub(super) fn on(ray: &Ray<DVec3>, region: &Region, origin: [Interval; 3], tmin: f64) -> Self {
        let Some([length, exponent]) = lengths(ray, region) else { return Self::Unknown };
        let direction = ray.direction().to_array().map(|d| Interval::exact(d).scaled(-length));
        let Some(start) = entry(region, &origin, &direction, tmin) else { return Self::Misses };
        let origin = [0, 1, 2].map(|axis| origin[axis] + Interval::exact(start) * direction[axis]);
        let reach = f64::from(region.reach_in_frame());
        // If the difference of long vectors is rounded, it may end far from the region, even if no other operation is
        // rounded.
        let most_near = (2.0 * reach).min(MAX_COORDINATE.into());
        let is_fine = origin
            .iter()
            .map(Interval::ends)
            .all(|[least, most]| most - least <= FINE * reach && least.abs().max(most.abs()) <= most_near);
        if start.is_finite() && is_fine {
            Self::Enters(Entry { origin, direction, start, exponent })
        } else {
            Self::Unknown
        }
    }
}

/// Returns the exponents of the direction's length, and of the unit of distance in the frame; `None` if they, or
/// coordinates there, are out of range.
#[inline]
fn lengths(ray: &Ray<DVec3>, region: &Region) -> Option<[i32; 2]> {
    let length = exponent_of(ray.direction().abs().max_element());
    let exponent = region.frame().exponent() - length;
    let is_within =
        length.abs() <= MAX_LENGTH && exponent.abs() <= MAX_UNIT && region.reach_in_frame() <= MAX_COORDINATE;
    is_within.then_some([length, exponent])
}

/// Returns a lower bound of the distance at which a ray enters the region, at least `tmin`. `None` if it certainly
/// misses the region.
pub(in crate::geom) fn entry(
    region: &Region,
    origin: &[Interval; 3],
    direction: &[Interval; 3],
    tmin: f64,
) -> Option<f64> {
    let aabb = region.bounds();
    let (mut start, mut end) = (tmin, f64::INFINITY);
    for axis in 0..3 {
        let ([least, most], [slowest, fastest]) = (origin[axis].ends(), direction[axis].ends());
        let (lo, hi) = (f64::from(aabb.lo[axis]), f64::from(aabb.hi[axis]));
        // least + t fastest >= lo where it comes from below, and likewise with all signs changed.
        for (way, speed) in [(lo - most, fastest), (least - hi, -slowest)] {
            if way > 0.0 && speed > 0.0 {
                start = start.max((way.next_down() / speed).next_down());
            } else if way.next_down() > 0.0 {
                return None;
            }
        }
        // least + t slowest <= hi where it leaves there, and likewise.
        for (way, speed) in [(hi - least, slowest), (most - lo, -fastest)] {
            if speed > 0.0 {
                end = end.min((way.next_up() / speed).next_up());
            }
        }
    }
    (start <= end).then_some(start)
}

/// Moves a ray to a point of its line before the region, with its distance, and from there to its entry. `None` if
/// twice the digits have no room, or the line is not near to the region. `[BOX-9]`
fn approach(ray: &Ray<DVec3>, region: &Region) -> Option<(Interval, Approach<Entry>)> {
    let (frame, o, d) = (region.frame(), ray.origin(), ray.direction());
    let (middle, radius) = Interval::middles(&frame.leave(region.bounds()));
    let [length, far] = [d, o - middle].map(|v| v.abs().max_element());
    if ![length, far, radius].iter().all(|x| USUAL.contains(x)) || far < FAR * radius {
        return None;
    }
    let [o, middle] = [o, middle].map(|v| v.to_array().map(Fine::exact));
    let (beside, parts) = shortened([0, 1, 2].map(|k| o[k] - middle[k]), d);
    // If the line meets the region, this is less than twice the radius on each axis.
    if !beside.iter().all(|x| x.middle().abs() <= 2.0 * radius && x.off_middle() <= 0.5 * radius) {
        return None;
    }
    // On the longest axis that is before the region: 4 - 2 - 1/2 radii from its center.
    let back = 4.0 * radius / length;
    let point = [0, 1, 2].map(|k| middle[k] + beside[k] - Fine::exact(back) * Fine::exact(d[k]));
    let parts = parts.into_iter().chain([back]).map(|part| Interval::exact(-part));
    let before = parts.fold(Interval::exact(0.0), |sum, part| sum + part);
    let origin = [0, 1, 2].map(|k| frame.inside(k, point[k].interval()));
    Some((before, Approach::on(ray, region, origin, 0.0)))
}

/// Components below this, where the greatest one is at least 1, move no point within a region by [`MARGIN`].
const NOTHING: f64 = power_of_two(-1000);

/// Regions are no larger than 2^130.
const MARGIN: f64 = power_of_two(-800);

impl Entered {
    /// A ray that meets no box. Other rays do not have an infinite least origin.
    pub(super) const MISSING: Self = Self {
        slabs: Doubled { origin: [DVec3::INFINITY; 2], inverse: [DVec3::ONE; 2] },
        start: Interval::exact(0.0),
        exponent: 0,
        tmin: 0.0,
    };

    /// Prepares a ray.
    pub(super) fn new(ray: &Ray<DVec3>, region: &Region) -> Self {
        match Approach::of(ray, region) {
            Approach::Misses => Self::MISSING,
            Approach::Enters(entry) => Self::at(entry, Interval::exact(0.0), ray.tmin()),
            Approach::Unknown => Self::slowly(ray, region),
        }
    }

    /// Prepares an entry whose ray starts at some distance.
    fn at(Entry { origin, direction, start, exponent }: Entry, before: Interval, tmin: f64) -> Self {
        let direction = DVec3::from(direction.map(|d| d.ends()[0]));
        Self::from(origin, direction, before + Interval::exact(start).scaled(exponent), exponent, tmin)
    }

    /// Prepares a ray for which doubles do not suffice.
    #[cold]
    #[inline(never)]
    pub(super) fn slowly(ray: &Ray<DVec3>, region: &Region) -> Self {
        match approach(ray, region) {
            Some((_, Approach::Misses)) => Self::MISSING,
            Some((before, Approach::Enters(entry))) => Self::at(entry, before, ray.tmin()),
            _ => Self::exactly(ray, region),
        }
    }

    /// Prepares a ray in rational arithmetic.
    pub(super) fn exactly(ray: &Ray<DVec3>, region: &Region) -> Self {
        let (frame, [o, d]) = (region.frame(), [ray.origin(), ray.direction()].map(|v| v.to_array()));
        let [lo, hi] = region.sides();
        let Some(start) = first_touch(o, d, [ray.tmin(), f64::INFINITY], lo, hi) else { return Self::MISSING };
        let exact = |x: f64| Relaxed::try_from(x).unwrap_or_default();
        let at = |k: usize| exact(o[k]) + &start * exact(d[k]) - exact(frame.origin()[k]);
        let origin = [0, 1, 2].map(|k| Interval::around(&at(k)).scaled(-frame.exponent()));
        let length = exponent_of(ray.direction().abs().max_element());
        let direction = ray.direction().map(|d| scaled(Interval::exact(d), -length).ends()[0]);
        Self::from(origin, direction, Interval::around(&start), frame.exponent() - length, ray.tmin())
    }

    /// Creates the test from bounds of the origin, and a direction that is exact except for negligible components.
    fn from(origin: [Interval; 3], direction: DVec3, start: Interval, exponent: i32, tmin: f64) -> Self {
        let is_nothing = direction.abs().cmplt(DVec3::splat(NOTHING));
        let margin = |k: usize| if is_nothing.test(k) { MARGIN } else { 0.0 };
        let bounds = [0, 1, 2].map(|k| (origin[k] + Interval::between([-margin(k), margin(k)])).ends());
        let [least, most] = [0, 1].map(|end| DVec3::from(bounds.map(|ends| ends[end])));
        let slabs = Doubled::new([most, least], DVec3::select(is_nothing, DVec3::ZERO, direction));
        Self { slabs, start, exponent, tmin }
    }

    /// Returns the entries of the ray into two boxes, if it enters, in the units of the frame from its start on,
    /// rounded to single precision.
    pub(in crate::geom) fn enter(&self, planes: &[[f32; 4]; 3]) -> [Option<f32>; 2] {
        self.met(planes).map(|met| met.map(|[near, _]| self.in_units(near)[0]))
    }

    /// Returns bounds of a distance in these units, rounded: so a smaller distance has no greater bound.
    pub(in crate::geom) fn in_units(&self, t: f64) -> [f32; 2] {
        let bounds = scaled(Interval::exact(t) - self.start, -self.exponent);
        bounds.ends().map(|x| (x as f32).clamp(0.0, f32::MAX))
    }

    /// Two boxes at once, as [`Slabs::pair`](super::Slabs::pair).
    pub(super) fn pair(&self, planes: &[[f32; 4]; 3], tmax: f64) -> Intervals<f64> {
        let met = self.met(planes).map(|met| met.filter(|[near, _]| *near <= tmax));
        let [near, far] = [0, 1].map(|end| met.map(|met| met.map_or(0.0, |ends| ends[end])));
        Intervals { hit: met.map(|met| met.is_some()), near, far: far.map(|far| far.min(tmax)) }
    }

    /// Returns bounds of the entries and exits of the ray for two boxes, if it enters.
    pub(super) fn met(&self, planes: &[[f32; 4]; 3]) -> [Option<[f64; 2]>; 2] {
        let Intervals { hit, near, far } = self.slabs.pair(planes, f64::INFINITY);
        [0, 1].map(|i| {
            // If a product underflows, its error is less than the least number.
            let from_start = Interval::between([near[i].next_down(), far[i].next_up()]);
            let [near, far] =
                if hit[i] { (scaled(from_start, self.exponent) + self.start).ends() } else { return None };
            (self.tmin <= far).then_some([near.max(self.tmin), far])
        })
    }
}

/// Multiplies by 2 to the power of any exponent.
fn scaled(x: Interval, exponent: i32) -> Interval {
    let step = exponent.clamp(-MAX_LENGTH, MAX_LENGTH);
    if step == exponent { x.scaled(step) } else { scaled(x.scaled(step), exponent - step) }
}
