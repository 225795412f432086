use super::super::tests::{plain, rational, whole, wild, wild64};
use super::*;
use crate::generate::Rng;

/// Declares a test of roots: squares of the midpoint between two floats, exact and almost exact.
macro_rules! roots {
    ($name:ident, $float:ty, $wild:ident, $next_power:expr) => {
        #[test]
        fn $name() {
            let value = |bits| {
                let x = <$float>::from_bits(bits);
                if x.is_infinite() { RBig::from(IBig::ONE << $next_power) } else { rational(x) }
            };
            let root = |x: RBig| round_root::<$float>(&x).to_bits();
            let hair = RBig::from_parts(1.into(), UBig::ONE << 4400);
            let mut random = Rng::new(8);
            let limits = [0, 1, 2, 3, <$float>::MIN_POSITIVE.to_bits() - 1, <$float>::MIN_POSITIVE.to_bits()];
            let limits = limits.into_iter().chain([<$float>::MAX.to_bits() - 1, <$float>::MAX.to_bits()]);
            for bits in limits.chain((0..3000).map(|_| $wild(&mut random).abs().to_bits())) {
                let [this, next] = [value(bits), value(bits + 1)];
                let middle = (&this + &next) / RBig::from(2);
                let square = &middle * &middle;
                assert_eq!(root(&this * &this), bits);
                assert_eq!(root(square.clone()), bits + bits % 2);
                assert_eq!([root(&square - &hair), root(&square + &hair)], [bits, bits + 1]);
            }
            assert_eq!(round_root::<$float>(&RBig::from(IBig::ONE << 2200)), <$float>::INFINITY);
        }
    };
}

roots!(roots_are_rounded_to_the_nearest_single, f32, wild, 128);
roots!(roots_are_rounded_to_the_nearest_double, f64, wild64, 1024);

/// Checks integers and scaled fractions of them, with the corners in any order.
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

/// The point is in the triangle and at the distance, so it is the nearest one. Grids also give triangles without area.
/// [NEAR-3]
#[test]
fn nearest_points_are_points_of_the_triangle_at_the_least_distance() {
    let mut random = Rng::new(10);
    for i in 0..4000 {
        let mut vector = || std::array::from_fn(|_| if i % 8 == 0 { wild(&mut random) } else { whole(&mut random, 3) });
        let ([a, b, c], p): ([[f32; 3]; 3], _) = ([vector(), vector(), vector()], vector());
        let x = nearest_point([a, b, c], p).expect("finite");
        let square = |v: plain::Vector| plain::dot(v.clone(), v);
        let to = |corner| plain::minus(plain::vector(corner), x.clone());
        assert_eq!(square(to(p)), square_distance([a, b, c], p).expect("finite"));
        // The triangle is on one side of the plane through the point, across the direction to the query point.
        let is_beyond = |corner| plain::dot(to(p), to(corner)) > RBig::ZERO;
        assert!(![a, b, c].into_iter().any(is_beyond), "{a:?} {b:?} {c:?} {p:?}");
        // In the plane, and on the inner side of each edge. Without area, on one of the edges.
        let [ab, ac, bc] = [(a, b), (a, c), (b, c)].map(|(s, t)| plain::minus(plain::vector(t), plain::vector(s)));
        let normal = plain::cross(ab.clone(), ac);
        if square(normal.clone()) > RBig::ZERO {
            let ca = plain::minus(plain::vector(a), plain::vector(c));
            assert_eq!(plain::dot(normal.clone(), to(a)), RBig::ZERO);
            let is_outside = |(edge, start)| plain::dot(plain::cross(normal.clone(), edge), to(start)) > RBig::ZERO;
            assert!(![(ab, a), (bc, b), (ca, c)].into_iter().any(is_outside), "{a:?} {b:?} {c:?} {p:?}");
        } else {
            let is_between =
                |(s, t)| square(plain::cross(to(s), to(t))) == RBig::ZERO && plain::dot(to(s), to(t)) <= RBig::ZERO;
            assert!([(a, b), (b, c), (c, a)].into_iter().any(is_between), "{a:?} {b:?} {c:?} {p:?}");
        }
    }
}
