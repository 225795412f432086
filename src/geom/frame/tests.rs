use glam::DVec3;
use proptest::prelude::*;

use super::*;
use crate::generate::draw::Draw;
use crate::geom::tests::{exact, exponent, holds};

fn far_and_small() -> impl Strategy<Value = [DVec3; 3]> {
    let scale = prop::sample::select(vec![1.0, 1e-3, 1e-30, 1e-50, 1e-300, 5e-324, 1e30, 1e50, 1e300]);
    let shift = prop::sample::select(vec![0.0, 1.0, 6.4e6, -1e9, 1e-9, 1e40, -1e300]);
    let number = || -1.0..1.0f64;
    let corner = || [number(), number(), number()].prop_map(DVec3::from);
    ([corner(), corner(), corner()], scale, shift, any::<bool>()).prop_map(|(corners, scale, shift, is_flat)| {
        corners.map(|v| {
            let v = v * scale + DVec3::new(shift, -0.5 * shift, 0.0);
            if is_flat { v.with_y(shift) } else { v }
        })
    })
}

/// Returns whether a plane is on this side of a number and the next float toward the number is not.
fn is_tight(plane: f32, next: f32, x: &RBig, is_lower: bool) -> bool {
    let is_beyond = |plane: f32| match RBig::try_from(plane) {
        Ok(plane) => {
            if is_lower {
                plane <= *x
            } else {
                *x <= plane
            }
        }
        Err(_) => (plane < 0.0) == is_lower,
    };
    is_beyond(plane) && (RBig::try_from(plane).is_ok_and(|plane| plane == *x) || !is_beyond(next))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// [FRAME-1]
    #[test]
    fn boxes_hold_the_exact_coordinates_and_no_float_more(corners in far_and_small(), other in far_and_small()) {
        for frame in [Frame::around(corners), Frame::around(other), Frame::IDENTITY] {
            let aabb = frame.aabb(&Triangle(corners));
            for axis in 0..3 {
                let exact = corners.map(|corner| frame.exact(corner).expect("finite")[axis].clone());
                let (least, most) = (exact.iter().min().expect("three"), exact.iter().max().expect("three"));
                let (lo, hi) = (aabb.lo[axis], aabb.hi[axis]);
                // The bounds of a sum of doubles are first doubles, which may cost a float of single precision.
                prop_assert!(is_tight(lo, lo.next_up().next_up(), least, true), "{lo} {least}");
                prop_assert!(is_tight(hi, hi.next_down().next_down(), most, false), "{hi} {most}");
            }
        }
    }

    /// In its own frame the greatest coordinate of a mesh is between 1 and 2.
    #[test]
    fn a_frame_fits(corners in far_and_small()) {
        let frame = Frame::around(corners);
        let aabb = frame.aabb(&Triangle(corners));
        let reach = aabb.lo.abs().max(aabb.hi.abs()).max_element();
        prop_assert!(reach == 0.0 || (1.0..=2.0).contains(&reach) || frame.exponent().abs() == 1000, "{reach}");
    }
}

#[test]
fn frames_are_about_medians() {
    let unit = [DVec3::ZERO, DVec3::X, DVec3::Y * 5.0];
    for shift in [0.0, 9.0, -1e9, 1e300] {
        let frame = Frame::around(unit.map(|v| v + shift));
        assert_eq!(
            (frame.origin(), shift.abs() > 1e20 || frame.exponent() == 2),
            (DVec3::splat(shift), true),
            "{shift}"
        );
    }
    assert!(Frame::around([]).is_identity() && Frame::around([DVec3::ZERO; 3]).is_identity());
    assert_eq!(Frame::around(unit.map(|v| v * 2f64.powi(100))).exponent(), 102);
    // For many points the frame samples some of them, from the first to nearly the last.
    let many = (0..100_000).map(|i| DVec3::splat(if i < 60_000 { f64::from(i) } else { 1e9 }));
    assert!((49_900.0..50_100.0).contains(&Frame::around(many).origin().x));
    // The frame does not overflow at the limits of doubles.
    assert_eq!(
        Frame::around([DVec3::splat(f64::MAX), DVec3::splat(f64::MIN), DVec3::splat(f64::MIN)]).exponent(),
        1000
    );
    assert_eq!(Frame::new(DVec3::NAN, 0).or(Frame::new(DVec3::ZERO, 1001)).or(Frame::new(DVec3::ZERO, i32::MIN)), None);
}

#[test]
fn exponents() {
    for (x, exponent) in [(1.0, 0), (1.5, 0), (2f64.next_down(), 0), (0.25, -2), (5e-324, -1074), (0.0, -1074)] {
        assert_eq!(exponent_of(x), exponent, "{x}");
    }
    assert_eq!([f64::MAX, f64::MIN_POSITIVE, 1e-310].map(exponent_of), [1023, -1022, -1030]);
}

/// Points, boxes and rays at thresholds, in frames at thresholds. [FRAME-1] [INST-3]
#[test]
fn thresholds_are_held_in_frames() {
    let (mut draw, mut exactly) = (Draw::new(1), 0);
    for _ in 0..50_000 {
        let [x, y, c] = [draw.threshold(), draw.threshold(), if draw.one_in(2) { 0.0 } else { draw.threshold() }];
        let frame = Frame::new(DVec3::splat(c), exponent(&mut draw, x)).expect("a frame");
        let unit = exact(power_of_two(-frame.exponent()));
        let [inside, along] = [(exact(x) - exact(c)) * &unit, exact(y) * &unit];
        let ray = frame.ray(&EnclosedRay::new([Interval::exact(x); 3], [Interval::exact(y); 3]));
        assert!(holds(ray.origin[0], &inside) && holds(ray.direction[0], &along), "{x:e} {y:e} {frame:?}");
        assert_eq!(frame.coordinate(0, x), ray.origin[0]);
        exactly += usize::from(ray.origin[0].is_exact() && ray.direction[0].is_exact());
        let aabb = frame.enter(&[Interval::exact(x); 3]);
        let ends = Interval::between([aabb.lo.x, aabb.hi.x].map(f64::from));
        assert!(holds(ends, &inside), "{x:e} {frame:?}");
        let plane = draw.threshold_in_single();
        let [left, ..] = frame.leave(&Aabb { lo: Vec3::splat(plane), hi: Vec3::splat(plane) });
        assert!(holds(left, &(exact(plane) / &unit + exact(c))), "{plane:e} {frame:?}");
    }
    assert!(exactly > 5000, "{exactly}");
}
