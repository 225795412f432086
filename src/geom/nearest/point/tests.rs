use glam::Vec3;

use super::*;
use crate::generate::{Rng, Source};
use crate::geom::fine::Fine;
use crate::geom::nearest::Measure;
use crate::geom::nearest::tests::{bits, enclosed, narrow, square, true_point};
use crate::geom::{Real, Triangle, Vector as Point, truth};

/// Draws collinear corners in any order, two or all of which may be equal, of any magnitude, in double precision also
/// far away.
pub(in crate::geom::nearest) fn flat<V: Point>(random: &mut Rng, round: i32) -> (Triangle<V>, V) {
    let is_double = size_of::<V>() == size_of::<DVec3>();
    let mut whole = |size: u64| random.below(2 * size + 1) as f64 - size as f64;
    let [a, way, p, off] = [(); 4].map(|()| DVec3::new(whole(999), whole(999), whole(999)));
    let far = if is_double && round % 3 == 0 { DVec3::new(6.4e9, -1e10, 2f64.powi(40)) } else { DVec3::ZERO };
    let (a, scale) = (a + far, 2f64.powi(round * 7 % 121 - 60));
    let corners = [0.0, whole(5), whole(3)].map(|times| a + way * times);
    let point = match round % 4 {
        0 => far + p * 3.0,
        1 => corners[1],
        2 => a.midpoint(corners[2]),
        _ => a + way * whole(2) + off * 2f64.powi(-10),
    };
    let turned = [0, 1, 2].map(|k| narrow((corners[(k + round as usize / 4) % 3]) * scale));
    (Triangle(turned), narrow(point * scale))
}

/// Returns the numbers of distances and of points that were settled without rational arithmetic.
fn check_flat<V: Point>() -> [usize; 2] {
    let (mut random, mut settled) = (Rng::new(21), [0; 2]);
    for round in 0..10_000 {
        let (triangle, point) = flat::<V>(&mut random, round);
        assert!(triangle.is_degenerate(), "{triangle:?}");
        let measure = Measure::new(point, V::Real::INFINITY);
        let truth = truth::round_root(&square(&triangle, point));
        assert_eq!(measure.distance(&triangle, V::Real::INFINITY), Some(truth), "{triangle:?} {point:?}");
        let nearest = true_point(&triangle, point);
        assert_eq!(bits(measure.nearest(&triangle)), nearest, "{triangle:?} {point:?}");
        let fine = measure.fine(&triangle);
        assert!(fine.is_none_or(|fine| fine == truth), "{triangle:?} {point:?}");
        let placed = enclosed::<Fine, V>(&triangle.widen(), point.widen());
        assert!(placed.is_none_or(|placed| bits(V::from_components(placed)) == nearest), "{triangle:?} {point:?}");
        settled[0] += usize::from(fine.is_some());
        settled[1] += usize::from(placed.is_some());
    }
    settled
}

/// [NEAR-1] [NEAR-3]
#[test]
fn triangles_without_area_are_segments_and_points() {
    let settled = [check_flat::<Vec3>(), check_flat::<DVec3>()];
    // No bounds prove that a distance is 0.
    assert!(settled.as_flattened().iter().all(|&settled| settled > 7500), "{settled:?}");
}
