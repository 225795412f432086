//! The nearest point of a triangle, in integers, for the oracle of instances. `[INST-9]`

use dashu_int::IBig;
use stackless_bvh::internals::geom::truth::Relaxed;

/// The coordinates of a point, times a power of two.
pub(crate) type IntegerPoint = [IBig; 3];

/// The nearest point of a triangle: a + (v (b - a) + w (c - a)) / whole, and the square of its distance.
pub(crate) struct Foot {
    pub(crate) weights: [IBig; 2],
    pub(crate) whole: IBig,
    pub(crate) square: Relaxed,
}

impl Foot {
    /// The least of the feet on the three edges and, if it is in the triangle, the foot on its plane, by the products of
    /// its edges (Gram's matrix).
    pub(crate) fn of([a, b, c]: &[IntegerPoint; 3], p: &IntegerPoint) -> Self {
        let minus = |x: &IntegerPoint, y: &IntegerPoint| -> IntegerPoint { std::array::from_fn(|k| &x[k] - &y[k]) };
        let dot = |x: &IntegerPoint, y: &IntegerPoint| &x[0] * &y[0] + &x[1] * &y[1] + &x[2] * &y[2];
        let (e, f, s) = (minus(b, a), minus(c, a), minus(p, a));
        let (ee, ef, ff, se, sf, ss) = (dot(&e, &e), dot(&e, &f), dot(&f, &f), dot(&s, &e), dot(&s, &f), dot(&s, &s));
        let square = |[v, w]: &[IBig; 2], whole: &IBig| {
            // |s - (v e + w f) / whole|^2.
            let of_foot = v * v * &ee + IBig::from(2) * v * w * &ef + w * w * &ff;
            let top = &ss * whole * whole - IBig::from(2) * (v * &se + w * &sf) * whole + of_foot;
            Relaxed::from_parts_signed(top, whole * whole)
        };
        let foot = |weights: [IBig; 2], whole: IBig| Self { square: square(&weights, &whole), weights, whole };
        let on_edge = |along: IBig, length: IBig| (along.clamp(IBig::ZERO, length.clone()), length.max(IBig::ONE));
        // From a to b, from a to c, and from b to c.
        let ((v, of_e), (w, of_f)) = (on_edge(se.clone(), ee.clone()), on_edge(sf.clone(), ff.clone()));
        let (t, of_g) = on_edge(&sf - &se - &ef + &ee, &ee + &ff - IBig::from(2) * &ef);
        let edges = [foot([v, IBig::ZERO], of_e), foot([IBig::ZERO, w], of_f), foot([&of_g - &t, t], of_g)];
        let (v, w, whole) = (&ff * &se - &ef * &sf, &ee * &sf - &ef * &se, &ee * &ff - &ef * &ef);
        let is_inside = !whole.is_zero() && v >= IBig::ZERO && w >= IBig::ZERO && &v + &w <= whole;
        let plane = is_inside.then(|| foot([v, w], whole));
        let [first, second, third] = edges;
        let others = [second, third].into_iter().chain(plane);
        others.fold(first, |least, foot| if foot.square < least.square { foot } else { least })
    }
}
