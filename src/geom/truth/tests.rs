use super::*;
use crate::generate::{Rng, Source};

pub(in crate::geom::truth) fn rational<S: Number>(x: S) -> RBig {
    RBig::try_from(x.into()).expect("a finite number")
}

fn fraction(numerator: i64, denominator: u64) -> RBig {
    RBig::from_parts(numerator.into(), denominator.into())
}

/// Draws an integer of at most this magnitude, as a float.
pub(in crate::geom::truth) fn whole(random: &mut Rng, most: u32) -> f32 {
    random.below(2 * u64::from(most) + 1) as f32 - most as f32
}

/// Draws any finite float: with uniform exponents, and a few bits or all.
pub(in crate::geom::truth) fn wild(random: &mut Rng) -> f32 {
    loop {
        let bits = random.bits() as u32;
        let x = f32::from_bits(if random.coin() { bits } else { bits & 0xfff0_0000 });
        if x.is_finite() {
            return x;
        }
    }
}

/// Draws any finite double, like [`wild`].
pub(in crate::geom::truth) fn wild64(random: &mut Rng) -> f64 {
    loop {
        let bits = random.bits();
        let x = f64::from_bits(if random.coin() { bits } else { bits & (u64::MAX << 48) });
        if x.is_finite() {
            return x;
        }
    }
}

/// Vectors of rationals and their products, component by component.
pub(in crate::geom::truth) mod plain {
    use super::*;

    pub(in crate::geom::truth) type Vector = [RBig; 3];

    pub(in crate::geom::truth) fn vector<S: Number>(v: [S; 3]) -> Vector {
        v.map(rational)
    }

    pub(in crate::geom::truth) fn minus([ax, ay, az]: Vector, [bx, by, bz]: Vector) -> Vector {
        [ax - bx, ay - by, az - bz]
    }

    pub(in crate::geom::truth) fn dot([ax, ay, az]: Vector, [bx, by, bz]: Vector) -> RBig {
        ax * bx + ay * by + az * bz
    }

    pub(in crate::geom::truth) fn cross([ax, ay, az]: Vector, [bx, by, bz]: Vector) -> Vector {
        [&ay * &bz - &az * &by, &az * &bx - &ax * &bz, &ax * &by - &ay * &bx]
    }

    pub(in crate::geom::truth) fn along(o: Vector, t: &RBig, d: Vector) -> Vector {
        let ([ox, oy, oz], [dx, dy, dz]) = (o, d);
        [ox + t * dx, oy + t * dy, oz + t * dz]
    }
}

/// Intersects by schoolbook geometry: the point on the plane, and its side of each edge.
fn meet_by_plane<S: Number>(triangle: [[S; 3]; 3], origin: [S; 3], direction: [S; 3]) -> Meeting {
    use plain::{along, cross, dot, minus, vector};
    let [a, b, c] = triangle.map(vector);
    let (o, d) = (vector(origin), vector(direction));
    let normal = cross(minus(b.clone(), a.clone()), minus(c.clone(), a.clone()));
    let slope = dot(normal.clone(), d.clone());
    if slope.is_zero() {
        return Meeting::Coplanar;
    }
    let t = dot(normal.clone(), minus(a.clone(), o.clone())) / slope;
    let p = along(o, &t, d);
    // Twice the areas of the three parts, multiplied by the length of the normal.
    let part = |from: &plain::Vector, to: &plain::Vector| {
        dot(normal.clone(), cross(minus(to.clone(), from.clone()), minus(p.clone(), from.clone())))
    };
    let parts = [part(&b, &c), part(&c, &a), part(&a, &b)];
    if parts.iter().any(|part| *part < RBig::ZERO) {
        return Meeting::Miss;
    }
    let place = match parts.iter().filter(|part| part.is_zero()).count() {
        0 => Place::Interior,
        1 => Place::Edge,
        _ => Place::Vertex,
    };
    let [_, u, v] = parts;
    let whole = dot(normal.clone(), normal);
    Meeting::Hit(Point { place, t, u: u / &whole, v: v / &whole })
}

/// Counts of each kind of intersection.
#[derive(Debug, Default)]
struct Seen {
    miss: u32,
    coplanar: u32,
    places: [u32; 3],
}

impl Seen {
    fn count(&mut self, meeting: &Meeting) {
        match meeting {
            Meeting::Miss => self.miss += 1,
            Meeting::Coplanar => self.coplanar += 1,
            Meeting::Hit(point) => self.places[point.place as usize] += 1,
        }
    }

    fn least(&self) -> u32 {
        self.places.into_iter().fold(self.miss.min(self.coplanar), u32::min)
    }
}

/// [EXACT-2]
#[test]
fn a_meeting_is_what_plane_and_edges_say() {
    let (mut random, mut seen) = (Rng::new(1), Seen::default());
    for i in 0..60_000 {
        let most = [1, 2, 4, 1 << 20][i % 4];
        let mut vector = || std::array::from_fn(|_| whole(&mut random, most));
        let (triangle, o, d) = ([vector(), vector(), vector()], vector(), vector());
        let meeting = meet(triangle, o, d);
        assert_eq!(meeting, meet_by_plane(triangle, o, d), "{triangle:?} {o:?} {d:?}");
        seen.count(&meeting);
    }
    assert!(seen.least() > 1000, "{seen:?}");
}

#[test]
fn a_meeting_is_what_plane_and_edges_say_of_wild_numbers() {
    let (mut random, mut seen) = (Rng::new(2), Seen::default());
    for _ in 0..4000 {
        let mut vector = || std::array::from_fn(|_| wild(&mut random));
        let (triangle, o, d) = ([vector(), vector(), vector()], vector(), vector());
        let meeting = meet(triangle, o, d);
        assert_eq!(meeting, meet_by_plane(triangle, o, d), "{triangle:?} {o:?} {d:?}");
        let wide = |v: [f32; 3]| v.map(f64::from);
        assert_eq!(meeting, meet(triangle.map(wide), wide(o), wide(d)), "{triangle:?} {o:?} {d:?}");
        seen.count(&meeting);
    }
    assert!(seen.miss > 100 && seen.places[0] > 100, "{seen:?}");
    for _ in 0..500 {
        let mut vector = || std::array::from_fn(|_| wild64(&mut random));
        let (triangle, o, d) = ([vector(), vector(), vector()], vector(), vector());
        assert_eq!(meet(triangle, o, d), meet_by_plane(triangle, o, d), "{triangle:?} {o:?} {d:?}");
    }
}

#[test]
fn turning_the_triangle_changes_only_the_names_of_the_weights() {
    let mut random = Rng::new(3);
    let mut hits = 0;
    for _ in 0..20_000 {
        let mut vector = || std::array::from_fn(|_| whole(&mut random, 3));
        let ([a, b, c], o, d): ([[f32; 3]; 3], _, _) = ([vector(), vector(), vector()], vector(), vector());
        let Meeting::Hit(Point { place, t, u, v }) = meet([a, b, c], o, d) else { continue };
        let w = RBig::ONE - &u - &v;
        let point = |u: &RBig, v: &RBig| Meeting::Hit(Point { place, t: t.clone(), u: u.clone(), v: v.clone() });
        assert_eq!(meet([b, c, a], o, d), point(&v, &w));
        assert_eq!(meet([a, c, b], o, d), point(&v, &u));
        assert_eq!(meet([b, a, c], o, d), point(&w, &v));
        hits += 1;
    }
    assert!(hits > 500, "{hits}");
}

#[test]
fn the_least_step_off_an_edge_is_a_miss() {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let at = |x: f64, y: f64| meet(triangle, [x, y, -1.0], [0.0, 0.0, 2.0]);
    let half = fraction(1, 2);
    let edge = Point { place: Place::Edge, t: half.clone(), u: half.clone(), v: half.clone() };
    assert_eq!(at(0.5, 0.5), Meeting::Hit(edge));
    assert_eq!(at(0.5, 0.5f64.next_up()), Meeting::Miss);
    assert_eq!(at(-5e-324, 0.5), Meeting::Miss);
    let corner = Point { place: Place::Vertex, t: half.clone(), u: RBig::ZERO, v: RBig::ONE };
    assert_eq!(at(-0.0, 1.0), Meeting::Hit(corner));
    let Meeting::Hit(inside) = at(5e-324, 0.5) else { panic!("missed") };
    assert_eq!((inside.place, inside.u), (Place::Interior, rational(5e-324)));
    // Behind the origin, and at it.
    let Meeting::Hit(behind) = meet(triangle, [0.25, 0.25, 1.0], [0.0, 0.0, 2.0]) else { panic!("missed") };
    assert_eq!(behind.t, -half);
    let Meeting::Hit(on) = meet(triangle, [0.25, 0.25, 0.0], [0.0, 0.0, 2.0]) else { panic!("missed") };
    assert_eq!(on.t, RBig::ZERO);
}

#[test]
fn without_area_or_direction_there_is_no_crossing() {
    let (o, d) = ([0.25f32, 0.25, -1.0], [0.0, 0.0, 1.0]);
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(meet([[0.0; 3], [1.0; 3], [2.0; 3]], o, d), Meeting::Coplanar);
    assert_eq!(meet([[0.0; 3], [0.0; 3], [1.0; 3]], o, d), Meeting::Coplanar);
    assert_eq!(meet(triangle, o, [0.0, -0.0, 0.0]), Meeting::Coplanar);
    assert_eq!(meet(triangle, [-1.0, 0.25, 0.0], [1.0, 0.0, 0.0]), Meeting::Coplanar);
    // These products underflow in floats.
    let tiny = triangle.map(|corner| corner.map(|x| x * 1e-45));
    assert!(matches!(meet(tiny, [0.0, 0.0, -1.0], [0.0, 0.0, 1e-45]), Meeting::Hit(_)));
}

#[test]
fn what_is_not_finite_is_not_hit() {
    let triangle = [[0.0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let (o, d) = ([0.25f32, 0.25, -1.0], [0.0f32, 0.0, 1.0]);
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(meet([[bad, 0.0, 0.0], triangle[1], triangle[2]], o, d), Meeting::Miss);
        assert_eq!(meet(triangle, [0.25, bad, -1.0], d), Meeting::Miss);
        assert_eq!(meet(triangle, o, [0.0, 0.0, bad]), Meeting::Miss);
        assert!(!touches([bad, 0.5, 0.5], d, [0.0, 1.0], [0.0; 3], [1.0; 3]));
        assert!(!touches(o, d, [bad, 1.0], [0.0; 3], [1.0; 3]));
    }
    assert!(!touches(o, d, [0.0, f32::NAN], [0.0; 3], [1.0; 3]));
    assert!(!touches(o, d, [0.0, 1.0], [f32::INFINITY; 3], [f32::NEG_INFINITY; 3]));
}

#[test]
fn an_interval_holds_its_ends() {
    let third = fraction(1, 3);
    assert!(holds([1.0 / 3.0, f64::INFINITY], &third), "the double is below a third");
    assert!(!holds([1.0f32 / 3.0, f32::INFINITY], &third), "the float is above a third");
    assert!(holds([0.0, 1.0f32 / 3.0], &third) && !holds([0.0, 1.0 / 3.0], &third));
    assert!(holds([0.5f32, 0.5], &fraction(1, 2)) && holds([-0.0f32, 0.0], &RBig::ZERO));
    assert!(holds([f32::NEG_INFINITY, 0.0], &fraction(-1, 3)) && !holds([f32::INFINITY; 2], &third));
    assert!(!holds([f32::NAN, 1.0], &third) && !holds([0.0, f32::NAN], &third));
}

/// Returns the first common point: a closed interval begins at `tmin` or where the line crosses a plane.
fn entry_by_trial<S: Number>(o: [S; 3], d: [S; 3], [tmin, tmax]: [S; 2], lo: [S; 3], hi: [S; 3]) -> Option<RBig> {
    let (ends, lo, hi) = ([tmin, tmax], plain::vector(lo), plain::vector(hi));
    let (o, d) = (plain::vector(o), plain::vector(d));
    let planes = [&lo, &hi].into_iter().flat_map(|b| (0..3).map(|k| (b[k].clone(), k)));
    let crossings = planes.filter(|(_, k)| !d[*k].is_zero()).map(|(plane, k)| (plane - &o[k]) / &d[k]);
    let is_common = |t: &RBig| {
        let point = plain::along(o.clone(), t, d.clone());
        holds(ends, t) && (0..3).all(|k| lo[k] <= point[k] && point[k] <= hi[k])
    };
    crossings.chain([rational(tmin)]).filter(is_common).min()
}

#[test]
fn a_box_is_entered_where_trial_says() {
    let mut random = Rng::new(4);
    let (mut touched, mut inverted, mut bounded) = (0, 0, 0);
    for i in 0..60_000 {
        let most = [2, 3, 8, 1 << 20][i % 4];
        let mut vector = || std::array::from_fn(|_| whole(&mut random, most));
        let ([o, d, a, b], [x, y, _]): ([[f32; 3]; 4], _) = (std::array::from_fn(|_| vector()), vector());
        let each = |f: fn(f32, f32) -> f32| std::array::from_fn(|k| f(a[k], b[k]));
        // One in five boxes may be inverted, and one in three intervals is unbounded.
        let (lo, hi) = if i % 5 == 0 { (a, b) } else { (each(f32::min), each(f32::max)) };
        let interval = if i % 3 == 0 { [x, f32::INFINITY] } else { [x.abs() / 4.0, y.abs()] };
        let truth = entry(o, d, interval, lo, hi);
        assert_eq!(truth, entry_by_trial(o, d, interval, lo, hi), "{o:?} {d:?} {interval:?} {lo:?} {hi:?}");
        assert_eq!(truth.is_some(), touches(o, d, interval, lo, hi));
        touched += u32::from(truth.is_some());
        inverted += u32::from((0..3).any(|k| lo[k] > hi[k]));
        bounded += u32::from(truth.is_none() && touches(o, d, [x, f32::INFINITY], lo, hi));
    }
    assert!(touched > 3000 && inverted > 5000 && bounded > 300, "{touched} {inverted} {bounded}");
}

#[test]
fn a_box_of_wild_numbers_is_entered_where_trial_says() {
    let mut random = Rng::new(5);
    let mut touched = 0;
    for _ in 0..6000 {
        let mut number = || if random.below(6) == 0 { 0.0 } else { wild(&mut random) };
        let [o, d, a, b]: [[f32; 3]; 4] = std::array::from_fn(|_| std::array::from_fn(|_| number()));
        let each = |f: fn(f32, f32) -> f32| std::array::from_fn(|k| f(a[k], b[k]));
        let (lo, hi, interval) = (each(f32::min), each(f32::max), [0.0, f32::INFINITY]);
        let truth = entry(o, d, interval, lo, hi);
        assert_eq!(truth, entry_by_trial(o, d, interval, lo, hi), "{o:?} {d:?} {lo:?} {hi:?}");
        touched += u32::from(truth.is_some());
    }
    assert!(touched > 300, "{touched}");
}

/// Declares a test of rounding to a float. The definition is a search among all floats in the order of their bits.
macro_rules! rounding {
    ($name:ident, $round:ident, $float:ty, $bits:ty, $wild:ident, $next_power:expr) => {
        #[test]
        fn $name() {
            let value = |bits: $bits| {
                let x = <$float>::from_bits(bits);
                // The next float with an unlimited exponent: infinity begins at the midpoint below it.
                if x.is_infinite() { RBig::from(IBig::ONE << $next_power) } else { rational(x) }
            };
            let nearest = |x: &RBig| {
                let magnitude = if *x < RBig::ZERO { -x } else { x.clone() };
                let (mut below, mut above): ($bits, $bits) = (0, <$float>::INFINITY.to_bits());
                if magnitude >= value(above) {
                    below = above - 1;
                }
                while above - below > 1 {
                    let middle = below + (above - below) / 2;
                    if value(middle) <= magnitude { below = middle } else { above = middle }
                }
                let [down, up] = [&magnitude - value(below), value(above) - &magnitude];
                let takes_lower = down < up || down == up && below % 2 == 0;
                let nearest = <$float>::from_bits(if takes_lower { below } else { above });
                if *x < RBig::ZERO { -nearest } else { nearest }
            };
            let same = |x: RBig| {
                let [rounded, truth] = [$round(&x), nearest(&x)].map(<$float>::to_bits);
                assert_eq!(rounded, truth, "{x}");
                rounded
            };
            let mut random = Rng::new(6);
            let limits = [0, 1, 2, 3, <$float>::MIN_POSITIVE.to_bits() - 1, <$float>::MIN_POSITIVE.to_bits()];
            let limits = limits.into_iter().chain([<$float>::MAX.to_bits() - 1, <$float>::MAX.to_bits()]);
            let floats = (0..3000).map(|i| {
                let bits = $wild(&mut random).abs().to_bits();
                // A third of them are subnormal.
                if i % 3 == 0 { bits % <$float>::MIN_POSITIVE.to_bits() } else { bits }
            });
            for bits in limits.chain(floats.collect::<Vec<_>>()) {
                let [this, next] = [value(bits), value(bits + 1)];
                let middle = (&this + &next) / RBig::from(2);
                // Far below any gap between floats.
                let hair = RBig::from_parts(1.into(), dashu_int::UBig::ONE << 1200);
                let even = bits + bits % 2;
                for sign in [RBig::ONE, -RBig::ONE] {
                    let negative = if sign < RBig::ZERO { (-0.0 as $float).to_bits() } else { 0 };
                    assert_eq!(same(&this * &sign) & !negative, bits);
                    assert_eq!(same(&middle * &sign) & !negative, even);
                    assert_eq!(same((&middle - &hair) * &sign) & !negative, bits);
                    assert_eq!(same((&middle + &hair) * &sign) & !negative, bits + 1);
                    same((&this + (&next - &this) / RBig::from(3)) * &sign);
                    same((&this + (&next - &this) * fraction(5, 7)) * &sign);
                }
            }
            assert_eq!($round(&(value(<$float>::INFINITY.to_bits()) * RBig::from(3))), <$float>::INFINITY);
            for _ in 0..3000 {
                let [a, b] = [(); 2].map(|()| IBig::from(random.bits() as i64 >> random.below(60)));
                if !b.is_zero() {
                    same(RBig::from_parts_signed(a, b));
                }
            }
        }
    };
}

rounding!(rounding_to_single_is_to_the_nearest, round_f32, f32, u32, wild, 128);
rounding!(rounding_to_double_is_to_the_nearest, round_f64, f64, u64, wild64, 1024);
