//! Comparison of slab tests with the exact slab: where boxes are entered and left [BOX-2] to [BOX-7].

use std::cmp::Ordering;

use stackless_bvh::generate::{Rng, Source};

use super::constants::{DOWN, STEPS, STRICT_STEPS, UP};
use super::draw::{power, sign, unit, wild};
use super::dyadic::{Dyadic, nearest};

/// Origin, direction, and the lower and the upper corner of a box.
type Case<T> = [[T; 3]; 4];

/// A parameter of the ray: a fraction with a positive divisor.
type Fraction = (Dyadic, Dyadic);

/// The directed test in one precision.
macro_rules! directed {
    ($name:ident, $float:ty) => {
        mod $name {
            /// Returns the reciprocals for near planes and for far planes.
            pub(crate) fn inverse(d: $float, steps: u32) -> [$float; 2] {
                // For zero, infinity and, a step below, the greatest number.
                let middle = 1.0 / d.abs();
                let [low, high] = (0..steps).fold([middle; 2], |[low, high], _| [low.next_down(), high.next_up()]);
                [low.copysign(d), high.copysign(d)]
            }

            /// Returns the distance of a plane.
            pub(crate) fn plane(b: $float, o: $float, inverse: $float) -> $float {
                (b - o) * inverse
            }

            /// Returns where a box is entered and left, between `tmin` and `tmax`.
            pub(crate) fn slab(
                [o, d, lo, hi]: super::Case<$float>,
                [tmin, tmax]: [$float; 2],
                steps: u32,
            ) -> [$float; 2] {
                let (mut near, mut far) = (tmin, tmax);
                for k in 0..3 {
                    let [slow, fast] = inverse(d[k], steps);
                    let [first, last] = if d[k].is_sign_negative() { [hi[k], lo[k]] } else { [lo[k], hi[k]] };
                    let (enter, leave) = (plane(first, o[k], slow), plane(last, o[k], fast));
                    near = near.max(enter);
                    // A NaN is dropped: the origin is on a plane that the ray leaves infinitely late.
                    far = if leave < far { leave } else { far };
                }
                [near, far]
            }
        }
    };
}

directed!(single, f32);
directed!(double, f64);

/// The two-sided test.
fn two_sided([o, d, lo, hi]: Case<f32>, [mut near, mut far]: [f32; 2], [down, up]: [f32; 2]) -> [f32; 2] {
    for k in 0..3 {
        // An infinite reciprocal is positive for both signs of zero.
        let inverse = Some(1.0 / d[k]).filter(|x| x.is_finite()).unwrap_or(f32::INFINITY);
        let (t1, t2) = ((lo[k] - o[k]) * inverse, (hi[k] - o[k]) * inverse);
        let (enter, leave) = (if t2 < t1 { t2 } else { t1 }, if t1 > t2 { t1 } else { t2 });
        near = if enter > near { enter } else { near };
        far = if leave < far { leave } else { far };
    }
    [near * down, far * up]
}

fn less((a, b): &Fraction, (c, d): &Fraction) -> bool {
    a * d < c * b
}

/// Returns where the half-line enters and leaves the box; `None` for a miss.
fn exact<T: Copy + Into<Dyadic>>(case: Case<T>) -> Option<[Fraction; 2]> {
    let [o, d, lo, hi] = case.map(|row| row.map(Into::<Dyadic>::into));
    let mut near = (Dyadic::ZERO, Dyadic::from(1.0));
    let mut far: Option<Fraction> = None;
    for k in 0..3 {
        let (first, last) = match d[k].sign() {
            0 if lo[k] <= o[k] && o[k] <= hi[k] => continue,
            0 => return None,
            1 => (&lo[k] - &o[k], &hi[k] - &o[k]),
            _ => (&o[k] - &hi[k], &o[k] - &lo[k]),
        };
        let (enter, leave) = ((first, d[k].abs()), (last, d[k].abs()));
        near = if less(&near, &enter) { enter } else { near };
        far = Some(far.filter(|far| !less(&leave, far)).unwrap_or(leave));
    }
    far.filter(|far| !less(far, &near)).map(|far| [near, far])
}

/// Draws rays and boxes that often touch: the box has a corner on the ray, as closely as rounding allows, and the ray
/// may be parallel to an axis or start on a plane.
fn draw(rng: &mut Rng, range: [i32; 2]) -> Case<f32> {
    let integers = rng.coin();
    let number = |rng: &mut Rng| if integers { rng.below(2048) as f64 - 1024.0 } else { wild(rng, range) };
    let [mut o, mut d, mut lo, mut hi] = [(); 4].map(|()| [(); 3].map(|()| number(rng)));
    if integers {
        // Corners that are hit exactly.
        let t = rng.below(1000) as f64;
        let scale = power(rng, range[0].max(-120), (range[1] - 25).min(80));
        let corner: [f64; 3] = std::array::from_fn(|k| o[k] + t * d[k]);
        for k in 0..3 {
            let other = corner[k] + lo[k];
            [lo[k], hi[k]] = [corner[k].min(other), corner[k].max(other)];
        }
        [o, lo, hi] = [o, lo, hi].map(|row| row.map(|x| x * scale));
    } else {
        let (from, to) = (unit(rng) * power(rng, -8, 8), unit(rng) * power(rng, -8, 8));
        for k in 0..3 {
            match rng.below(8) {
                0 => d[k] = 0.0 * sign(rng),
                1 => o[k] = lo[k],
                2..5 => lo[k] = o[k] + from * d[k],
                _ => {}
            }
            hi[k] = if rng.coin() { o[k] + to * d[k] } else { hi[k] };
            [lo[k], hi[k]] = [lo[k].min(hi[k]), lo[k].max(hi[k])];
        }
    }
    [o, d, lo, hi].map(|row| row.map(|x| x as f32))
}

/// Returns whether the clause applies: finite, coordinates below 2^127, and a direction.
fn is_valid([o, d, lo, hi]: &Case<f32>) -> bool {
    let below = |row: &[f32; 3], limit: f32| row.iter().all(|x| x.abs() < limit);
    [o, lo, hi].into_iter().all(|row| below(row, 2_f32.powi(127))) && below(d, f32::INFINITY) && *d != [0.0; 3]
}

const CASES: u32 = 60_000;

/// [BOX-2]
#[test]
fn no_touched_box_is_skipped() {
    let mut rng = Rng::new(10);
    let (mut touched, mut points) = (0, 0);
    for case in (0..CASES).map(|k| draw(&mut rng, [[-20, 20], [-149, 127]][k as usize % 2])) {
        let Some([enter, leave]) = Some(case).filter(is_valid).and_then(exact) else { continue };
        let [rounded_enter, rounded_leave]: [f32; 2] = [&enter, &leave].map(|(a, b)| nearest(a, b));
        let [near, far] = single::slab(case, [0.0, f32::INFINITY], STEPS);
        assert!(near <= rounded_enter && rounded_leave <= far, "{case:?}");
        // The interval of the ray may end at the entry of the box, and begin at its exit.
        let [near, far] = single::slab(case, [0.0, rounded_enter], STEPS);
        assert!(near <= far, "{case:?}");
        if rounded_leave.is_finite() {
            let [near, far] = single::slab(case, [rounded_leave, f32::INFINITY], STEPS);
            assert!(near <= far, "{case:?}");
        }
        // In double precision, the strict form rounds to a lower bound of the rounded entry.
        let wide = case.map(|row| row.map(f64::from));
        let [near, far] = double::slab(wide, [0.0, f64::INFINITY], STRICT_STEPS);
        assert!(&Dyadic::from(near) * &enter.1 <= enter.0, "{case:?}");
        assert!(near as f32 <= rounded_enter && near <= far, "{case:?}");
        touched += 1;
        points += u32::from(!less(&enter, &leave));
    }
    assert!(touched > CASES / 4 && points > CASES / 100, "{touched} {points}");
}

/// Returns the violations on an axis: the rounded entry is above the exact one, or above its nearest float, and for
/// exits reversed.
fn faults(o: f32, d: f32, b: f32, steps: u32) -> [bool; 4] {
    let [slow, fast] = single::inverse(d, steps);
    let [near, far] = [slow, fast].map(|inverse| single::plane(b, o, inverse));
    let (x, d) = ((&Dyadic::from(b) - &Dyadic::from(o)).abs(), Dyadic::from(d).abs());
    let rounded = nearest::<f32>(&x, &d);
    // The sign of the difference to the exact quotient; infinity is above it.
    let side = |t: f32| if t.is_finite() { (&Dyadic::from(t) * &d).cmp(&x) } else { Ordering::Greater };
    let near_is_above = near.is_finite() && side(near).is_gt();
    [near_is_above, near > rounded, side(far).is_lt(), far < rounded]
}

/// Draws a plane ahead with a difference just above a power of two, and a reciprocal just below one, which have the
/// greatest rounding errors.
fn hard_plane(rng: &mut Rng) -> [f32; 3] {
    let d = 0.5 * (1.0 + unit(rng) * power(rng, -11, -2));
    let b = (2.0 * unit(rng) - 1.0) * power(rng, -7, 0);
    [b - (1.0 + unit(rng) * power(rng, -15, -2)), d, b].map(|x| x as f32)
}

fn count_faults(steps: u32) -> [u32; 4] {
    let mut rng = Rng::new(11);
    let mut counts = [0; 4];
    for _ in 0..60_000 {
        let [o, d, b] = hard_plane(&mut rng);
        for (count, fault) in counts.iter_mut().zip(faults(o, d, b, steps)) {
            *count += u32::from(fault);
        }
    }
    counts
}

/// [BOX-4]
#[test]
fn one_step_less_is_too_little() {
    assert!(count_faults(STEPS - 1).into_iter().all(|count| count > 100));
    let [above, above_rounded, below, below_rounded] = count_faults(STEPS);
    assert!(
        above > 20 && above_rounded == 0 && below > 20 && below_rounded == 0,
        "{above} {above_rounded} {below} {below_rounded}"
    );
    assert_eq!(STEPS, STRICT_STEPS - 1);
    assert_eq!(count_faults(STRICT_STEPS), [0; 4]);
}

/// With one step fewer, this box is skipped although the ray touches it at an edge. [BOX-4]
#[test]
fn a_touched_box_needs_both_steps() {
    let bits = [[0xbf80_9c14, 0xbf8c_d7c2], [0x3f00_5797, 0x3f0d_173c], [0xbb93_066e, 0xba36_e47f]];
    let [o, d, plane] = bits.map(|row| row.map(f32::from_bits));
    let case = [[o[0], o[1], 0.0], [d[0], d[1], 0.0], [plane[0], -1.0, -1.0], [1.0, plane[1], 1.0]];
    assert!(exact(case).is_some());
    let [near, far] = single::slab(case, [0.0, f32::INFINITY], STEPS);
    assert!(near <= far);
    let [near, far] = single::slab(case, [0.0, f32::INFINITY], STEPS - 1);
    assert!(near > far);
}

/// Subnormal and huge components, and reciprocals that overflow.
#[test]
fn reciprocals_of_any_size_are_directed() {
    let mut rng = Rng::new(12);
    let limits = [1, 2, 0x1f_ffff, 0x20_0000, 0x20_0001, 0x7f_ffff, 0x80_0000, 0x7e80_0000, 0x7e80_0001, 0x7f7f_ffff];
    let mut checked = 0;
    for k in 0..CASES {
        let near_limit = limits[k as usize % limits.len()] + rng.below(3) as u32;
        let bits = if rng.coin() { near_limit } else { rng.below(0x7f80_0000) as u32 };
        let d = f32::from_bits(bits.clamp(1, 0x7f7f_ffff));
        let [o, b] = [(); 2].map(|()| wild(&mut rng, [-149, 127]) as f32);
        let [o, b] = [o.min(b), o.max(b)];
        let faults = faults(o, d, b, STEPS);
        assert!(!faults[1] && !faults[3], "{o:e} {d:e} {b:e}");
        let [near, _] = single::inverse(d, STEPS);
        assert!(near > 0.0 && near.is_finite());
        assert!(single::plane(o, b, near) <= 0.0);
        checked += 1;
    }
    assert_eq!(checked, CASES);
}

/// [BOX-3]
#[test]
fn a_box_within_is_not_entered_before() {
    let mut rng = Rng::new(13);
    let (mut inside, mut equal) = (0, 0);
    for k in 0..4 * CASES {
        let inner = draw(&mut rng, [[-20, 20], [-149, 127]][k as usize % 2]);
        let [o, d, lo, hi] = inner;
        let mut grow = |x: f32, toward: f64| match rng.below(3) {
            0 => x,
            1 => (f64::from(x) + toward * f64::from(f32::EPSILON) * f64::from(x).abs()) as f32,
            _ => (f64::from(x) + toward * unit(&mut rng)) as f32,
        };
        let outer = [o, d, lo.map(|x| grow(x, -1.0)), hi.map(|x| grow(x, 1.0))];
        if !is_valid(&outer) {
            continue;
        }
        let interval = [0.0, f32::INFINITY];
        let pairs = [
            (single::slab(outer, interval, STEPS), single::slab(inner, interval, STEPS)),
            (two_sided(outer, interval, [DOWN, UP]), two_sided(inner, interval, [DOWN, UP])),
        ];
        for ([outer_near, outer_far], [near, far]) in pairs {
            assert!(outer_near <= near && far <= outer_far, "{inner:?} {outer:?}");
            inside += 1;
            equal += u32::from(near == outer_near && near > 0.0);
        }
    }
    assert!(inside > 4 * CASES && equal > CASES / 10, "{inside} {equal}");
}

/// Returns whether the two-sided test applies: coordinates up to 2^126, a direction between 1 and 2 with no subnormal
/// component, and planes at the origin or at least 2^-125 away.
fn is_two_sided([o, d, lo, hi]: &Case<f32>) -> bool {
    let greatest = d.iter().fold(0.0_f32, |a, x| a.max(x.abs()));
    let is_far = |b: f32, o: f32| b == o || (f64::from(b) - f64::from(o)).abs() >= 2_f64.powi(-125);
    (1.0..2.0).contains(&greatest)
        && d.iter().all(|x| *x == 0.0 || x.is_normal())
        && [o, lo, hi].iter().all(|row| row.iter().all(|x| x.abs() <= 2_f32.powi(126)))
        && (0..3).all(|k| is_far(lo[k], o[k]) && is_far(hi[k], o[k]))
}

/// [BOX-5]
#[test]
fn no_touched_box_is_skipped_by_the_two_sided_test() {
    let mut rng = Rng::new(14);
    let mut touched = 0;
    for k in 0..2 * CASES {
        let mut case = draw(&mut rng, [[-20, 20], [-126, 126]][k as usize % 2]);
        let greatest = case[1].iter().fold(0.0_f32, |a, x| a.max(x.abs()));
        let exponent = (f64::from(greatest).to_bits() >> 52) as i32 - 1023;
        case[1] = case[1].map(|x| (f64::from(x) * 2_f64.powi(-exponent.clamp(-149, 127))) as f32);
        let Some([enter, leave]) = Some(case).filter(is_two_sided).and_then(exact) else { continue };
        let [rounded_enter, rounded_leave]: [f32; 2] = [&enter, &leave].map(|(a, b)| nearest(a, b));
        let [near, far] = two_sided(case, [0.0, f32::INFINITY], [DOWN, UP]);
        assert!(near <= rounded_enter && rounded_leave <= far && near <= far, "{case:?}");
        touched += 1;
    }
    assert!(touched > CASES / 10, "{touched}");
}

/// With factors closer to 1, even by less than half, an entry may be above the nearest float of the exact one, or an
/// exit below. [BOX-5]
#[test]
fn factors_halved_are_too_little() {
    let along_x = |bits: [u32; 3]| {
        let [o, d, b] = bits.map(f32::from_bits);
        ([[o, 0.0, 0.0], [d, 0.0, 0.0], [b, -1.0, -1.0], [b, 1.0, 1.0]], [0.0, f32::INFINITY])
    };
    let truth = |case| exact(case).map(|[(a, b), _]| nearest::<f32>(&a, &b));
    let (case, interval) = along_x([0xbf76_8c3c, 0x3fff_ffdb, 0x3e8e_2b16]);
    assert!(Some(two_sided(case, interval, [DOWN, UP])[0]) <= truth(case));
    assert!(Some(two_sided(case, interval, [1.0 - f32::EPSILON, UP])[0]) > truth(case));
    let (case, interval) = along_x([0xbf95_f9ce, 0x3fff_f028, 0x3c6c_ba3e]);
    assert!(Some(two_sided(case, interval, [DOWN, UP])[1]) >= truth(case));
    assert!(Some(two_sided(case, interval, [DOWN, 1.0 + f32::EPSILON])[1]) < truth(case));
}

/// Meshes and rays in double precision, with equal steps, and the nearest number of that precision. [BOX-6]
#[test]
fn no_touched_box_is_skipped_in_double_precision() {
    let mut rng = Rng::new(15);
    let mut touched = 0;
    for _ in 0..CASES / 3 {
        let [o, d, c] = [(); 3].map(|()| [(); 3].map(|()| sign(&mut rng) * unit(&mut rng) * power(&mut rng, -30, 30)));
        let t = unit(&mut rng) * power(&mut rng, -8, 8);
        let corner: [f64; 3] = std::array::from_fn(|k| o[k] + t * d[k]);
        let lo = std::array::from_fn(|k| corner[k].min(c[k]));
        let hi = std::array::from_fn(|k| corner[k].max(c[k]));
        let case = [o, d, lo, hi];
        let Some([enter, leave]) = exact(case) else { continue };
        let [rounded_enter, rounded_leave]: [f64; 2] = [&enter, &leave].map(|(a, b)| nearest(a, b));
        let [near, far] = double::slab(case, [0.0, f64::INFINITY], STEPS);
        assert!(near <= rounded_enter && rounded_leave <= far, "{case:?}");
        touched += 1;
    }
    assert!(touched > CASES / 20, "{touched}");
}
