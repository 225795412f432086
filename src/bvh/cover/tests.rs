use glam::{BVec3, DVec3, Vec3};

use super::*;
use crate::generate::{Rng, Source};

fn aabb(lo: [f32; 3], hi: [f32; 3]) -> Aabb {
    Aabb { lo: lo.into(), hi: hi.into() }
}

fn hold<V: Vector>(boxes: &[Aabb], triangle: &Triangle<V>) -> bool {
    super::hold(&Frame::IDENTITY, boxes, triangle)
}

fn surely_hold(boxes: &[Aabb], triangle: &Triangle) -> bool {
    super::surely_hold(&Frame::IDENTITY, boxes, triangle)
}

fn covers<V: Vector>(boxes: &[Aabb], triangle: &Triangle<V>) -> bool {
    super::covers(&Frame::IDENTITY, boxes, triangle)
}

/// Half of the unit square, at z = 1.
const FLAT: Triangle = Triangle([Vec3::Z, Vec3::new(1.0, 0.0, 1.0), Vec3::new(0.0, 1.0, 1.0)]);

#[test]
fn boxes_that_meet_cover_and_gaps_are_seen() {
    let left = aabb([0.0, 0.0, 1.0], [0.3, 1.0, 1.0]);
    let right = |x: f32, y: f32| aabb([x, 0.0, 0.0], [1.0, y, 1.0]);
    assert!(covers(&[left, right(0.3, 0.7f32.next_up())], &FLAT));
    assert!(covers(&[right(0.0, 1.0)], &FLAT));
    assert!(!covers(&[left, right(0.3f32.next_up(), 1.0)], &FLAT));
    // Above 0.3 the triangle ends at exactly 1 - 0.3, slightly below or above the float 0.7.
    let exact = 1.0 - f64::from(0.3f32);
    let least = if f64::from(0.7f32) < exact { 0.7f32.next_up() } else { 0.7 };
    assert!(covers(&[left, right(0.3, least)], &FLAT));
    assert!(!covers(&[left, right(0.3, least.next_down())], &FLAT));
    assert!(!covers(&[left], &FLAT));
    assert!(!covers(&[], &FLAT));
    assert!(!covers(&[aabb([0.0; 3], [1.0, 1.0, 1.0f32.next_down()])], &FLAT));
}

#[test]
fn a_grid_of_boxes_covers_unless_one_is_missing() {
    let triangle = Triangle([Vec3::new(0.1, 0.2, 0.3), Vec3::new(0.9, 0.5, 0.2), Vec3::new(0.4, 0.95, 0.9)]);
    let cell = |i: u32| {
        let lo = Vec3::from([i % 5, i / 5 % 5, i / 25].map(|k| k as f32 / 5.0));
        let hi = Vec3::from([i % 5, i / 5 % 5, i / 25].map(|k| (k + 1) as f32 / 5.0));
        Aabb { lo, hi }
    };
    let cells: Vec<_> = (0..125).map(cell).collect();
    assert!(covers(&cells, &triangle));
    let without = |i: usize| cells.iter().enumerate().filter(|(k, _)| *k != i).map(|(_, c)| *c).collect::<Vec<_>>();
    for boxes in (0..125).map(without) {
        assert!(!surely_hold(&boxes, &triangle) || covers(&boxes, &triangle));
    }
    assert!(surely_hold(&cells, &triangle));
    let needed = (0..125).filter(|&i| !covers(&without(i), &triangle)).count();
    assert!((10..40).contains(&needed), "{needed}");
}

#[test]
fn double_precision_and_infinite_boxes() {
    let corners = FLAT.0.map(|v| v.as_dvec3() + DVec3::splat(1e-12));
    let all = Aabb { lo: Vec3::splat(f32::NEG_INFINITY), hi: Vec3::splat(f32::INFINITY) };
    assert!(covers(&[all], &Triangle(corners)));
    assert!(!covers(&[aabb([0.0; 3], [1.0; 3])], &Triangle(corners)));
}

#[test]
fn what_is_seen_easily_is_true() {
    let mut rng = Rng::new(8);
    let mut corner = |grid: u64| Vec3::from([(); 3].map(|()| (rng.below(grid) as f32 - 2.0) / 3.0));
    let (mut sure, mut covered) = (0, 0);
    for _ in 0..20_000 {
        let triangle = Triangle([corner(9), corner(9), corner(9)]);
        // Parts between random planes, like those of a builder, each moved by an ulp or not.
        let (cut, aabb) = (corner(7), triangle.aabb());
        let boxes: Vec<_> = (0..8)
            .map(|i| {
                let side = BVec3::new(i & 1 == 0, i & 2 == 0, i & 4 == 0);
                let part = Aabb { lo: Vec3::select(side, aabb.lo, cut), hi: Vec3::select(side, cut, aabb.hi) };
                let part = triangle.part(&part);
                if corner(9).x < 1.5 { part } else { Aabb { hi: part.hi.with_x(part.hi.x.next_down()), ..part } }
            })
            .filter(|part| part.lo.cmple(part.hi).all())
            .collect();
        if triangle.is_degenerate() {
            continue;
        }
        let (is_sure, is_covered) = (surely_hold(&boxes, &triangle), covers(&boxes, &triangle));
        assert!(is_covered || !is_sure, "{triangle:?} {boxes:?}");
        sure += u32::from(is_sure);
        covered += u32::from(is_covered);
    }
    assert!(covered < 19_000 && 10 * sure > 9 * covered, "{sure} {covered}");
}

#[test]
fn degenerate_triangles_are_covered_too() {
    let line = Triangle([Vec3::ZERO, Vec3::splat(2.0), Vec3::ONE]);
    let [low, high] = [aabb([0.0; 3], [1.0; 3]), aabb([1.0; 3], [2.0; 3])];
    let point = Triangle([Vec3::ONE; 3]);
    for covers in [covers::<Vec3>, hold] {
        assert!(covers(&[low, high], &line) && covers(&[high, low], &line));
        assert!(!covers(&[low], &line) && !covers(&[high], &line));
        assert!(covers(&[low], &point) && !covers(&[aabb([0.0; 3], [1.0, 1.0, 1f32.next_down()])], &point));
    }
    let gap = aabb([0.0; 3], [1f32.next_down(); 3]);
    assert!(!hold(&[gap, high], &line) && !hold(&[high, gap], &line));
}

#[test]
fn a_box_without_end_on_one_side_ends_on_the_other() {
    let triangle = Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
    let below = |end: f32| Aabb { lo: Vec3::NEG_INFINITY, hi: Vec3::new(end, 2.0, 2.0) };
    assert!(hold(&[below(1.0)], &triangle) && covers(&[below(1.0)], &triangle));
    assert!(!hold(&[below(0.5)], &triangle));
}
