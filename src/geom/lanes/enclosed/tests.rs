use fearless_simd::{dispatch, f32x4, f32x8};

use super::*;
use crate::generate::draw::{Draw, one_of};
use crate::geom::lanes::tests::levels;
use crate::geom::slabs::Intervals;
use crate::geom::{Aabb, EnclosedRay, Interval, Region, truth};
use crate::wide::is_beyond;
use glam::Vec3;

#[inline(always)]
fn enter<S: Simd, V: Lanes<S, A>, const A: usize>(
    simd: S,
    slabs: &EnclosedSlabs,
    boxes: &[Aabb],
    end: f32,
) -> (Vec<u32>, u32) {
    let planes = std::array::from_fn(|axis| {
        let side = |corner: fn(&Aabb) -> Vec3| std::array::from_fn(|lane| corner(&boxes[lane])[axis]);
        [side(|aabb| aabb.lo), side(|aabb| aabb.hi)]
    });
    let (ranks, set) = EnclosedBoxes::<S, V, A>::new(simd, *slabs).enter(&planes, end);
    (ranks.as_array().map(f32::to_bits).to_vec(), set)
}

/// Returns the answer of all levels.
fn entered(slabs: &EnclosedSlabs, boxes: &[Aabb], end: f32) -> (Vec<u32>, u32) {
    let mut results = levels().into_iter().map(|level| match boxes.len() {
        8 => dispatch!(level, simd => enter::<_, f32x8<_>, 8>(simd, slabs, boxes, end)),
        _ => dispatch!(level, simd => enter::<_, f32x4<_>, 4>(simd, slabs, boxes, end)),
    });
    let first = results.next().expect("a level");
    assert!(results.all(|result| result == first), "{slabs:?} {boxes:?} {end}");
    first
}

/// Checks that the set has the boxes that the single-box test keeps, and those that it would keep if boxes were entered
/// at their ranks, and no other boxes.
fn check(slabs: &EnclosedSlabs, boxes: &[Aabb], end: f32) {
    let (count, (ranks, set)) = (boxes.len() as u32, entered(slabs, boxes, end));
    for (lane, (aabb, rank)) in (0..).zip(boxes.iter().zip(ranks)) {
        let (is_met, cleared) = (set >> lane & 1 == 1, rank & !(count - 1));
        let Intervals { hit: [hit, _], near: [near, _], far: [far, _] } =
            slabs.pair(&aabb.planes_twice(), f32::INFINITY);
        let is_box = aabb.lo.cmple(aabb.hi).all();
        assert_eq!(is_met, is_box && f32::from_bits(cleared) <= far.min(end), "{slabs:?} {aabb:?} {end}");
        if is_box && hit {
            assert_eq!(rank, (near.min(f32::MAX) + 0.0).to_bits() / count * count + lane, "{slabs:?} {aabb:?}");
        }
        assert!(is_met || !is_box || slabs.one(aabb, end).is_none(), "{slabs:?} {aabb:?} {end}");
    }
}

/// The last ones are out of range in single precision.
const NUMBERS: [f64; 14] =
    [1.0, -1.0, 2.0, -3.0, 0.1, -0.3, 0.0, -0.0, 1e-30, 1e-45, 1e-60, 1e38, -1e39, f64::INFINITY];

/// Draws an interval from the first `numbers` numbers.
fn interval(draw: &mut Draw, numbers: usize) -> Interval {
    let (a, b) = (NUMBERS[draw.below(numbers)], NUMBERS[draw.below(numbers)]);
    match draw.below(3) {
        0 => Interval::between([a.min(b), a.max(b)]),
        1 => Interval::between([a, a]),
        _ => Interval::between([a.next_down(), a.next_up()]),
    }
}

fn corner(draw: &mut Draw, numbers: usize) -> Vec3 {
    Vec3::from([(); 3].map(|()| (NUMBERS[draw.below(numbers)] as f32).clamp(f32::MIN, f32::MAX)))
}

/// Rays in one direction, along an axis, or possibly in either direction, of any magnitude. `[INST-4]`
#[test]
fn boxes_are_kept_that_the_test_of_one_keeps() {
    let (mut draw, mut seen) = (Draw::new(1), [0; 2]);
    while seen[0].min(seen[1]) < 5000 {
        let numbers = one_of([6, 9, NUMBERS.len()], &mut draw);
        let ray = EnclosedRay::new(
            [(); 3].map(|()| interval(&mut draw, numbers)),
            [(); 3].map(|()| interval(&mut draw, numbers)),
        );
        let boxes: [Aabb; 8] = [(); 8].map(|()| {
            let (a, b) = (corner(&mut draw, numbers), corner(&mut draw, numbers));
            if draw.one_in(6) { Aabb::EMPTY } else { Aabb { lo: a.min(b), hi: a.max(b) } }
        });
        let zero = Aabb { lo: Vec3::ZERO, hi: Vec3::ZERO };
        let region =
            Region::of(&boxes.iter().filter(|aabb| **aabb != Aabb::EMPTY).fold(zero, |all, aabb| all.union(*aabb)));
        let tmin = one_of([0.0, 1e-45, 0.5, 1.0], &mut draw);
        let slabs = EnclosedSlabs::of(&ray, tmin, &region);
        seen[usize::from(slabs.is_wide())] += 1;
        for end in [tmin, 2.0, f32::MAX, f32::INFINITY] {
            check(&slabs, &boxes, end);
            check(&slabs, &boxes[..4], end);
        }
    }
}

/// No ray within the bounds touches a skipped box: checked at the corners of the bounds, in rational arithmetic. With
/// another end, exactly the boxes beyond it are skipped. `[INST-4]` `[WIDE-4]`
#[test]
fn no_box_is_left_out_that_a_ray_within_the_bounds_touches() {
    let (mut draw, mut touched, mut left) = (Draw::new(2), 0, 0);
    for round in 0..3000 {
        let (origin, direction) = (draw.ints(8), draw.ints(3));
        let wide = draw.ints(1) * [0.0, 1e-3, 2.0][round % 3];
        let off = |v: Vec3| {
            [0, 1, 2].map(|axis| {
                let (x, by) = (f64::from(v[axis]), f64::from(wide[axis].abs()));
                Interval::between([x - by, x + by])
            })
        };
        let ray = EnclosedRay::new(off(origin), off(direction));
        let boxes: [Aabb; 8] = [(); 8].map(|()| {
            let (a, b) = (draw.ints(8), draw.ints(8));
            Aabb { lo: a.min(b), hi: a.max(b) }
        });
        let region = Region::of(&boxes.iter().fold(boxes[0], |all, aabb| all.union(*aabb)));
        let slabs = EnclosedSlabs::of(&ray, 0.25, &region);
        let (end, corners) = ([f32::INFINITY, 1.0, 3.5][round / 3 % 3], round as u32);
        let (ranks, set) = entered(&slabs, &boxes, end);
        let at = |bounds: [Interval; 3], which: u32| {
            [0, 1, 2].map(|axis| bounds[axis].ends_in_single()[(which >> axis & 1) as usize])
        };
        for (lane, aabb) in boxes.iter().enumerate() {
            let (o, d) = (at(ray.origin, corners), at(ray.direction, corners >> 3));
            if let Some(t) = truth::entry(o, d, [0.25, end], aabb.lo.into(), aabb.hi.into()) {
                let is_met = set >> lane & 1 == 1;
                assert!(is_met && f32::from_bits(ranks[lane] & !7) <= truth::round_f32(&t), "{ray:?} {aabb:?} {end}");
                touched += 1;
            }
        }
        left += 8 - set.count_ones();
        let (_, without_end) = entered(&slabs, &boxes, f32::INFINITY);
        let beyond = (0..8).fold(0, |set, lane| set | u32::from(is_beyond::<8>(ranks[lane], end.to_bits())) << lane);
        assert_eq!(set, without_end & !beyond, "{ray:?} {end}");
    }
    assert!(touched > 2000 && left > 2000, "{touched} {left}");
}
