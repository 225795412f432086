//! Rounded edge functions, determinant and distance against exact ones [EXACT-4] to [EXACT-8].

use std::ops::{Add, Mul, Sub};

use stackless_bvh::generate::{Rng, Source};

use super::constants::{DET, DISTANCE, EDGE, EDGES, FLOOR, FLOOR_UNSCALED, LENGTHS, REACH, SIGN};
use super::draw::{Family, draw, sign};
use super::dyadic::{Dyadic, nearest};
use super::worst::{DOUBLE, MIXED, SINGLE};

/// Origin, direction and the three corners.
pub(crate) type Input<T> = [[T; 3]; 5];

/// The number type of a kernel.
pub(crate) trait Real:
    Copy + PartialOrd + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Into<f64>
{
    /// Half of the distance from 1 to the next number.
    const U: Self;
    /// Zero.
    const ZERO: Self;
    /// Converts a small constant.
    fn of(constant: f32) -> Self;
    /// The magnitude.
    fn magnitude(self) -> Self;
}

impl Real for f32 {
    const U: Self = f32::EPSILON / 2.0;
    const ZERO: Self = 0.0;

    fn of(constant: f32) -> Self {
        constant
    }

    fn magnitude(self) -> Self {
        self.abs()
    }
}

impl Real for f64 {
    const U: Self = f64::EPSILON / 2.0;
    const ZERO: Self = 0.0;

    fn of(constant: f32) -> Self {
        constant.into()
    }

    fn magnitude(self) -> Self {
        self.abs()
    }
}

/// Values of U, V, W, det and T.
pub(crate) const NAMES: [&str; 5] = ["U", "V", "W", "det", "T"];

/// The rounded values, and the sizes that bound their errors.
pub(crate) struct Rounded<T> {
    /// In the order of [`NAMES`].
    pub(crate) values: [T; 5],
    /// Greatest magnitude in s, e1 and e2, and d.
    pub(crate) sizes: [T; 3],
}

/// Evaluates the kernel in the order of operations that the bounds assume.
pub(crate) fn rounded<T: Real>([o, d, v0, v1, v2]: Input<T>) -> Rounded<T> {
    let sub = |a: [T; 3], b: [T; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: [T; 3], b: [T; 3]| (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
    let cross =
        |a: [T; 3], b: [T; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let greatest = |a: &[T]| a.iter().map(|x| x.magnitude()).fold(T::ZERO, |a, b| if b > a { b } else { a });
    let (e1, e2, s) = (sub(v1, v0), sub(v2, v0), sub(o, v0));
    let (p, q) = (cross(d, e2), cross(s, e1));
    let (det, u, v, t) = (dot(e1, p), dot(s, p), dot(d, q), dot(e2, q));
    let edges = [e1, e2].concat();
    Rounded { values: [u, v, (det - u) - v, det, t], sizes: [greatest(&s), greatest(&edges), greatest(&d)] }
}

impl<T: Real> Rounded<T> {
    /// Evaluates the bounds, with `scale` times each constant.
    pub(crate) fn bounds(&self, scale: f32) -> [T; 5] {
        let [c, e, d] = self.sizes;
        let k = |constant: f32| T::of(constant * scale) * T::U;
        let edge = k(EDGE) * d * c * e;
        [edge, edge, self.edges(scale, T::ZERO), k(DET) * d * e * e, k(DISTANCE) * c * e * e]
    }

    /// The common bound of U, V and W.
    pub(crate) fn edges(&self, scale: f32, floor: T) -> T {
        let [c, e, d] = self.sizes;
        let e = if e > floor { e } else { floor };
        (T::of(EDGES * scale) * T::U * d) * e * (T::of(2.0) * c + e)
    }
}

/// Returns the exact values, in the order of [`NAMES`].
pub(crate) fn exact<T: Real>(input: Input<T>) -> [Dyadic; 5] {
    let [o, d, v0, v1, v2] = input.map(|a| a.map(|x| Dyadic::from(x.into())));
    polynomials(&o, &d, &v0, &v1, &v2)
}

type Point = [Dyadic; 3];

fn polynomials(o: &Point, d: &Point, v0: &Point, v1: &Point, v2: &Point) -> [Dyadic; 5] {
    let (e1, e2, s) = (sub(v1, v0), sub(v2, v0), sub(o, v0));
    let (p, q) = (cross(d, &e2), cross(&s, &e1));
    let (det, u, v, t) = (dot(&e1, &p), dot(&s, &p), dot(d, &q), dot(&e2, &q));
    let w = &(&det - &u) - &v;
    [u, v, w, det, t]
}

fn sub(a: &Point, b: &Point) -> Point {
    std::array::from_fn(|k| &a[k] - &b[k])
}

fn dot(a: &Point, b: &Point) -> Dyadic {
    &(&(&a[0] * &b[0]) + &(&a[1] * &b[1])) + &(&a[2] * &b[2])
}

fn cross(a: &Point, b: &Point) -> Point {
    let minor = |i: usize, j: usize| &(&a[i] * &b[j]) - &(&a[j] * &b[i]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

fn error<T: Real>(value: T, truth: &Dyadic) -> Dyadic {
    (&Dyadic::from(value.into()) - truth).abs()
}

/// Updates the greatest `|error| / bound` of each value, and checks that none exceeds 1.
fn check<T: Real>(input: Input<T>, worst: &mut [f64; 5]) {
    let (rounded, exact) = (rounded(input), exact(input));
    for (k, bound) in rounded.bounds(1.0).into_iter().enumerate() {
        let error = error(rounded.values[k], &exact[k]);
        let bound = Dyadic::from(bound.into());
        assert!(error <= bound, "{} of {:?}", NAMES[k], input.map(|a| a.map(Into::into)));
        if bound.sign() > 0 {
            worst[k] = worst[k].max(share(&error, &bound));
        }
    }
}

/// Returns `error / bound`, to three digits.
fn share(error: &Dyadic, bound: &Dyadic) -> f64 {
    nearest::<f64>(error, bound)
}

/// Checks that the bounds hold for these inputs, one for each value, and that 5/6 of them would not.
fn nearly_reaches<T: Real>(inputs: [Input<T>; 5]) {
    for (k, input) in inputs.into_iter().enumerate() {
        check(input, &mut [0.0; 5]);
        let (rounded, exact) = (rounded(input), exact(input));
        let (error, less) = (error(rounded.values[k], &exact[k]), rounded.bounds(5.0 / 6.0)[k]);
        assert!(error > Dyadic::from(less.into()), "{}: {}", NAMES[k], share(&error, &Dyadic::from(less.into())));
    }
}

#[test]
fn five_sixths_of_any_constant_is_too_little() {
    nearly_reaches(SINGLE.map(|input| input.map(|a| a.map(f32::from_bits))));
    nearly_reaches(DOUBLE.map(|input| input.map(|a| a.map(f64::from_bits))));
    nearly_reaches(MIXED.map(|input| input.map(|a| a.map(|bits| f64::from(f32::from_bits(bits))))));
}

/// The common bound of the edge functions is that of W. It must cover U and V where their own bounds do.
#[test]
fn the_common_bound_covers_each_edge_function() {
    for input in SINGLE.map(|input| input.map(|a| a.map(f32::from_bits))) {
        let (rounded, exact) = (rounded(input), exact(input));
        let bound = Dyadic::from(rounded.edges(1.0, FLOOR));
        assert!((0..3).all(|k| error(rounded.values[k], &exact[k]) <= bound));
    }
}

/// The bound for sign decisions covers an edge function and the determinant together. (The end of spec/exactness.md has
/// an input that refutes half of it.)
#[test]
fn the_bound_of_signs_covers_an_edge_function_and_the_determinant() {
    for input in MIXED.map(|input| input.map(|a| a.map(|bits| f64::from(f32::from_bits(bits))))) {
        let (rounded, exact) = (rounded(input), exact(input));
        let [c, e, d] = rounded.sizes;
        let bound = Dyadic::from(SIGN * f64::U * (d * e) * (c + e));
        let [u, v, w, det] = [0, 1, 2, 3].map(|k| error(rounded.values[k], &exact[k]));
        assert!([u, v, w].iter().all(|edge| edge + &det <= bound));
    }
}

const CASES: u32 = 3000;

/// All bounds in double precision, for numbers of any of the exponents that [EXACT-6] and [EXACT-7] allow.
#[test]
fn no_bound_of_the_second_stage_is_exceeded() {
    let (mut rng, mut worst) = (Rng::new(1), [0.0; 5]);
    for _ in 0..CASES {
        for family in Family::ALL {
            check(draw(&mut rng, family, [-200, 200]), &mut worst);
            let single = draw(&mut rng, family, [-149, 128]).map(|a| a.map(|x| x as f32));
            if single.as_flattened().iter().all(|x| x.is_finite()) {
                check(single.map(|a| a.map(f64::from)), &mut worst);
            }
        }
    }
    // The cases are difficult: even random ones have errors this close to the bounds.
    assert!(worst.iter().all(|&share| share > 0.2), "{worst:?}");
}

/// An input for the first stage, the power of two that scales its direction, and the floor of E.
struct Prepared {
    input: Input<f32>,
    shift: i32,
    floor: f32,
}

/// Prepares both forms of the first stage for supported inputs: with the direction scaled to 1 <= D < 2, and unscaled.
fn prepared(input: Input<f32>) -> Vec<Prepared> {
    let greatest = input[1].iter().fold(0.0_f32, |a, b| a.max(b.abs()));
    let in_reach = [0, 2, 3, 4].iter().all(|&row| input[row].iter().all(|x| x.abs() <= REACH));
    if !in_reach || greatest == 0.0 || !greatest.is_finite() {
        return Vec::new();
    }
    let shift = 1023 - (f64::from(greatest).to_bits() >> 52) as i32;
    let mut scaled = input;
    scaled[1] = input[1].map(|x| (f64::from(x) * 2_f64.powi(shift)) as f32);
    let mut forms = vec![Prepared { input: scaled, shift, floor: FLOOR }];
    if (LENGTHS[0]..=LENGTHS[1]).contains(&greatest) {
        forms.push(Prepared { input, shift: 0, floor: FLOOR_UNSCALED });
    }
    forms
}

/// Counts of outcomes.
#[derive(Debug, Default)]
struct Counts {
    seen: u32,
    certain: u32,
    open: u32,
    underflows: u32,
}

/// Checks the common bound and the decision for one input. Returns the greatest error as a fraction of the bound.
fn judge(prepared: &Prepared, truth: &[Dyadic; 5], counts: &mut Counts) -> f64 {
    let Prepared { input, shift, floor } = *prepared;
    let rounded = rounded(input);
    let delta = rounded.edges(1.0, floor);
    let (bound, mut worst) = (Dyadic::from(delta), 0.0_f64);
    for k in 0..3 {
        let error = error(rounded.values[k], &truth[k].shifted(shift));
        assert!(error <= bound, "{} of {input:?} with floor {floor:e}", NAMES[k]);
        worst = worst.max(share(&error, &bound));
    }
    let [u, v, w] = [0, 1, 2].map(|k| rounded.values[k]);
    let misses = u.min(v).min(w) < -delta && u.max(v).max(w) > delta;
    let signs = [0, 1, 2].map(|k| truth[k].sign());
    let hit = signs.iter().all(|&s| s >= 0) || signs.iter().all(|&s| s <= 0);
    assert!(!(misses && hit), "{input:?}");
    counts.seen += 1;
    counts.certain += u32::from(misses);
    counts.open += u32::from(!misses && !hit);
    counts.underflows += u32::from((0..3).any(|k| rounded.values[k] == 0.0 && signs[k] != 0));
    worst
}

/// The common bound in single precision, including underflow and the scaling of the direction, and the decision.
/// [EXACT-5]
#[test]
fn no_bound_of_the_first_stage_is_exceeded() {
    let (mut rng, mut counts, mut worst) = (Rng::new(2), Counts::default(), 0.0_f64);
    for _ in 0..2 * CASES {
        for (family, range) in Family::ALL.into_iter().flat_map(|f| [(f, [-40, 41]), (f, [-149, 41]), (f, [-149, -60])])
        {
            let drawn = draw(&mut rng, family, range).map(|a| a.map(|x| x as f32));
            let truth = exact(drawn);
            for form in prepared(drawn) {
                worst = worst.max(judge(&form, &truth, &mut counts));
            }
        }
    }
    let Counts { seen, certain, open, underflows } = counts;
    assert!(seen > 40 * CASES && certain > seen / 5 && open > seen / 20 && underflows > 1000, "{counts:?}");
    assert!(worst > 0.2, "{worst}");
}

/// The second stage neither overflows nor underflows for finite inputs in single precision of any magnitude [EXACT-6].
#[test]
fn the_second_stage_stays_in_range() {
    let extremes = [0.0, 1e-45, 3e-45, f32::MIN_POSITIVE, 1.0, 1.000_000_1, 3e38, f32::MAX];
    let mut rng = Rng::new(3);
    let (least, greatest) = (Dyadic::from(1.0).shifted(-447), Dyadic::from(1.0).shifted(390));
    for _ in 0..CASES {
        let input = [(); 5].map(|()| [(); 3].map(|()| f64::from(extremes[rng.below(8) as usize]) * sign(&mut rng)));
        check(input, &mut [0.0; 5]);
        for (value, exact) in rounded(input).values.into_iter().zip(exact(input)) {
            let range = |x: &Dyadic| x.sign() == 0 || (&least..&greatest).contains(&&x.abs());
            assert!(range(&value.into()) && range(&exact), "{input:?}");
        }
    }
}
