//! Nearest points and distances.

use super::*;

/// Integers and fractions of them, which are scaled; and the corners in any order.
#[test]
fn squares_of_distances_grow_with_the_square_of_the_size() {
    let mut random = Rng::new(9);
    for _ in 0..2000 {
        let mut vector = || std::array::from_fn(|_| whole(&mut random, 9));
        let ([a, b, c], p): ([[f32; 3]; 3], _) = ([vector(), vector(), vector()], vector());
        let square = square_distance([a, b, c], p).expect("finite");
        for scale in [0.125, 0.25, 8.0f32] {
            let small = |v: [f32; 3]| v.map(|x| x * scale);
            let scaled = square_distance([a, b, c].map(small), small(p)).expect("finite");
            assert_eq!(scaled, &square * rational(scale * scale));
        }
        for corners in [[b, c, a], [c, b, a], [b, a, c]] {
            assert_eq!(square_distance(corners, p), Some(square.clone()));
        }
    }
}

/// In the triangle, at the distance: so it is the nearest one. [NEAR-3]
#[test]
fn nearest_points_are_points_of_the_triangle_at_the_least_distance() {
    let mut random = Rng::new(10);
    for i in 0..4000 {
        // Grids make triangles without area, and points above corners and edges.
        let mut vector = || std::array::from_fn(|_| if i % 8 == 0 { wild(&mut random) } else { whole(&mut random, 3) });
        let ([a, b, c], p): ([[f32; 3]; 3], _) = ([vector(), vector(), vector()], vector());
        let x = nearest_point([a, b, c], p).expect("finite");
        let square = |v: plain::Vector| plain::dot(v.clone(), v);
        let to = |corner| plain::minus(plain::vector(corner), x.clone());
        assert_eq!(square(to(p)), square_distance([a, b, c], p).expect("finite"));
        // Nothing of the triangle is on the far side of the plane through it, across the way to the point.
        for corner in [a, b, c] {
            assert!(plain::dot(to(p), to(corner)) <= RBig::ZERO, "{a:?} {b:?} {c:?} {p:?}");
        }
        // In the plane, and on the inner side of each edge; without area, on one of the edges.
        let [ab, ac, bc] = [(a, b), (a, c), (b, c)].map(|(s, t)| plain::minus(plain::vector(t), plain::vector(s)));
        let normal = plain::cross(ab.clone(), ac);
        if square(normal.clone()) > RBig::ZERO {
            let ca = plain::minus(plain::vector(a), plain::vector(c));
            assert_eq!(plain::dot(normal.clone(), to(a)), RBig::ZERO);
            for (edge, start) in [(ab, a), (bc, b), (ca, c)] {
                let inward = plain::cross(normal.clone(), edge);
                assert!(plain::dot(inward, to(start)) <= RBig::ZERO, "{a:?} {b:?} {c:?} {p:?}");
            }
        } else {
            let is_between =
                |(s, t)| square(plain::cross(to(s), to(t))) == RBig::ZERO && plain::dot(to(s), to(t)) <= RBig::ZERO;
            assert!([(a, b), (b, c), (c, a)].into_iter().any(is_between), "{a:?} {b:?} {c:?} {p:?}");
        }
    }
}
