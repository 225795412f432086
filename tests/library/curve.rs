//! The closest point of a curve (`examples/curve.rs`) against rational arithmetic.

use stackless_bvh::generate::{Rng, Source};
use stackless_bvh::internals::geom::truth::RBig;
use stackless_bvh::oracle;
use stackless_bvh::traverse::{Afra, traverse};

use super::usage::curve::{Halves, Interval, Search, binomial};

fn exact(x: f64) -> RBig {
    RBig::try_from(x).unwrap()
}

/// Splits a polynomial in Bernstein form at `t`, returns the left part, and keeps the right one.
fn split(right: &mut [RBig], t: &RBig) -> Vec<RBig> {
    let mut left = vec![right[0].clone()];
    for length in (1..right.len()).rev() {
        for i in 0..length {
            right[i] = &right[i] + t * (&right[i + 1] - &right[i]);
        }
        left.push(right[0].clone());
    }
    left
}

/// Returns whether the curve is nowhere closer than `lo`, and at `t` as close as `hi`.
fn is_true(points: &[[f64; 2]], to: [f64; 2], t: f64, [lo, hi]: [f64; 2]) -> bool {
    let n = points.len() - 1;
    let [lo, hi] = [lo, hi].map(|x| exact(x).sqr());
    let offset = |i: usize, k: usize| exact(points[i][k]) - exact(to[k]);
    // The squared distance, minus that of `lo`.
    let mut squares = vec![-&lo; 2 * n + 1];
    for (i, j) in (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))) {
        let dot = offset(i, 0) * offset(j, 0) + offset(i, 1) * offset(j, 1);
        squares[i + j] += dot * exact(binomial(n, i) * binomial(n, j)) / exact(binomial(2 * n, i + j));
    }
    let is_near = split(&mut squares.clone(), &exact(t))[2 * n] <= hi - &lo;
    let mut parts = vec![(squares, 0)];
    while let Some((mut right, depth)) = parts.pop().filter(|_| lo > RBig::ZERO) {
        if right.iter().any(|c| *c < RBig::ZERO) {
            if right[0] < RBig::ZERO || right[2 * n] < RBig::ZERO || depth == 200 {
                return false;
            }
            let left = split(&mut right, &exact(0.5));
            parts.extend([(left, depth + 1), (right, depth + 1)]);
        }
    }
    is_near
}

#[test]
fn the_judge_is_not_blind() {
    let judge = |t, lo, hi| is_true(&[[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]], [1.0, 3.0], t, [lo, hi]);
    assert!(judge(0.5, 2f64.next_down(), 2.0) && judge(0.5, 0.0, 2.0));
    assert!(
        !judge(0.5, 2f64.next_up(), 3.0) && !judge(0.5, 1.0, 2f64.next_down()) && !judge(0.5f64.next_up(), 1.0, 2.0)
    );
}

/// Curves and points with arbitrary numbers, and with small integers: ties, cusps, a point on the curve, a curve that
/// is a point. [CURVE-1] [CURVE-3] [CURVE-4] [CURVE-5]
#[test]
fn enclosures_hold_and_are_those_of_the_oracle() {
    let mut reached = 0;
    for seed in 0..300 {
        let mut random = Rng::new(seed);
        let size = [1.0, 1.0, 2f64.powi(300), 2f64.powi(-300)][random.below(4) as usize];
        let tolerance = size * [0.0, 1e-6, 1e-12][random.below(3) as usize];
        let mut point = || {
            [(); 2].map(|()| match seed % 3 {
                0 => size * (random.below(5) as f64 - 2.0),
                _ => size * (random.below(1 << 54) as f64 * 2f64.powi(-53) - 1.0),
            })
        };
        let mut points: Vec<_> = (0..2 + seed % 5).map(|_| point()).collect();
        let to = if seed % 7 == 0 { points[0] } else { point() };
        if seed % 11 == 0 {
            points.fill(point());
        }
        let start = Search::new(&points, to, tolerance).unwrap();
        for tree in [1, 4, 28].map(Halves) {
            let [mut search, mut expected] = [(); 2].map(|()| start.clone());
            oracle::traverse(&tree, &mut expected, &mut ());
            traverse(Afra::<u32, _>::new(&tree).unwrap(), &mut search, &mut ());
            assert_eq!(search, expected);
            let [lo, hi] = search.distance();
            assert!(is_true(&points, to, search.t, [lo, hi]), "{points:?} {to:?} {search:?}");
            reached += u32::from(tree.0 == 28 && hi - lo <= tolerance);
        }
    }
    assert!(reached > 150, "{reached}");
}

#[test]
fn what_is_no_curve_is_refused() {
    for points in [&[[0.0; 2]][..], &[[0.0; 2]; 10], &[[f64::NAN, 0.0], [0.0; 2]], &[[0.0; 2], [0.0, 1e150]]] {
        assert!(Search::new(points, [0.0; 2], 0.0).is_err(), "{points:?}");
    }
}

/// [CURVE-2]
#[test]
fn intervals_are_rounded_outwards() {
    let mut random = Rng::new(1);
    let mut number = || {
        let size = [-53, -60, 250, -400, -1074][random.below(5) as usize];
        // In two steps, so no power of two is subnormal.
        (random.below(1 << 54) as f64 - 2f64.powi(53)) * 2f64.powi(size / 2) * 2f64.powi(size - size / 2)
    };
    for _ in 0..10_000 {
        let [a, b, c, d] = [(); 4].map(|()| number());
        let [x, y] = [[a, b], [c, d]].map(|[a, b]| Interval { lo: a.min(b), hi: a.max(b) });
        let holds = |result: Interval, value: RBig| exact(result.lo) <= value && value <= exact(result.hi);
        for (p, q) in [(a, c), (a, d), (b, c), (b, d)] {
            let [p, q] = [p, q].map(exact);
            assert!(holds(x.plus(y), &p + &q) && holds(x.times(y), &p * &q), "{x:?} {y:?}");
        }
        assert!(holds(Interval::difference(a, c), exact(a) - exact(c)), "{a:e} {c:e}");
    }
}
