use super::*;
use crate::geom::Aabb;

/// Returns whether single precision can prove a miss of a right triangle with legs of length `e` along x and y.
fn misses(e: f32, origin: [f32; 3], direction: Vec3) -> bool {
    let triangle = Triangle([Vec3::ZERO, Vec3::X * e, Vec3::Y * e]);
    let ray = Ray::new(origin.into(), direction).expect("a ray");
    ExactFromSingle::new(&ray, &Region::of(&triangle.aabb())).misses(&triangle)
}

/// At a distance of 39 u (2 C + E) from an edge, and at the next float. [EXACT-5]
#[test]
fn a_miss_is_certain_beyond_the_bound() {
    let lengths = [1.0, -1.0, 1.5, -(2f32.powi(20)), 1.5 * 2f32.powi(-30)];
    for (e, height) in [(1.0, 1.0), (4.0, 3.0), (4.0, 32.0), (0.5, 5.0), (64.0, 100.0)] {
        let beside = 39.0 * 2f32.powi(-24) * (2.0 * height + e);
        for direction in lengths.map(|length| Vec3::Z * length) {
            for (beside, expected) in [(beside, false), (beside.next_up(), true)] {
                assert_eq!(misses(e, [-beside, e / 2.0, -height], direction), expected, "{e} {height} {direction}");
                assert_eq!(misses(e, [e / 2.0, -beside, -height], direction), expected, "{e} {height} {direction}");
            }
        }
    }
}

/// Tiny triangles have the bound of edges of 2^-60. [EXACT-5]
#[test]
fn edges_count_as_if_they_were_no_smaller() {
    let beside = 39.0 * 2f32.powi(-14);
    for (beside, expected) in [(beside, false), (beside.next_up(), true)] {
        assert_eq!(misses(2f32.powi(-70), [-beside, 1.5 * beside, -0.5], Vec3::Z), expected);
    }
}

#[test]
fn each_edge_is_seen_from_either_side() {
    for e in [2f32.powi(-30), 1.0, 3.0, 2f32.powi(30)] {
        for direction in [Vec3::Z, Vec3::NEG_Z, Vec3::new(0.01, -0.02, 1.0)] {
            for [x, y] in [[-0.1, 0.5], [0.5, -0.1], [0.6, 0.6], [0.9, 0.9], [1.2, -0.1], [-0.1, 1.2], [-1.0, -1.0]] {
                assert!(misses(e, [x * e, y * e, -e], direction), "{e} {x} {y}");
            }
            for [x, y] in [[0.2, 0.2], [0.1, 0.6], [0.6, 0.1]] {
                assert!(!misses(e, [x * e, y * e, -e], direction), "{e} {x} {y}");
            }
        }
    }
}

/// Beyond 2^40 it might overflow, and decides nothing. [EXACT-5]
#[test]
fn all_that_cannot_overflow_is_asked() {
    let most = 2f32.powi(40);
    for (far, expected) in [(1.0, true), (most, true), (most.next_up(), false)] {
        assert_eq!(misses(1.0, [-far, far, -1.0], Vec3::Z), expected, "{far}");
        let triangle = Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
        let region = Region::of(&Aabb { lo: Vec3::splat(-far), hi: Vec3::ONE });
        let ray = Ray::new(Vec3::new(-1.0, 1.0, -1.0), Vec3::Z).expect("a ray");
        assert_eq!(ExactFromSingle::new(&ray, &region).misses(&triangle), expected, "{far}");
    }
}
