//! The entry of a distant ray into the region of all boxes, by twice the digits of a double.

use glam::DVec3;

use super::entered::{Approach, Entry};
use crate::geom::fine::{Fine, shortened};
use crate::geom::frame::power_of_two;
use crate::geom::kernel::USUAL;
use crate::geom::{Interval, Ray, Region};

/// Number of regions from which on a distance is far; doubles suffice for nearer rays.
const FAR: f64 = power_of_two(12);

/// Moves a ray to a point of its line before the region, with its distance, and from there to its entry. `None` if
/// twice the digits have no room, or the line is not near to the region. `[BOX-9]`
pub(super) fn approach(ray: &Ray<DVec3>, region: &Region) -> Option<(Interval, Approach<Entry>)> {
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
