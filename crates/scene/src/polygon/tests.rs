use super::*;
use crate::tests::Random;

/// Triangulates a polygon. Returns its triangles and the number of notes.
fn cut_one(points: &[DVec3]) -> (Vec<[u32; 3]>, usize) {
    let mut triangles: Vec<_> = (2..points.len() as u32).map(|i| [0, i - 1, i]).collect();
    let (faces, mut notes) = (vec![0; triangles.len()], Notes::default());
    cut(points, &mut triangles, &faces, &mut notes);
    (triangles, notes.0.len())
}

fn area(points: &[DVec3], [a, b, c]: [u32; 3]) -> DVec3 {
    let [a, b, c] = [a, b, c].map(|corner| points[corner as usize]);
    (b - a).cross(c - a)
}

/// Returns a star-shaped polygon around the origin of its plane. Nearly all have many concave corners.
fn star(random: &mut Random, corners: usize) -> Vec<DVec3> {
    let mut number = || random.below(1000) as f64 / 1000.0;
    let [x, y] = [DVec3::new(number(), -1.0, number()), DVec3::new(0.5, number(), 1.0)];
    let corner = |i: usize| {
        let angle = (i as f64 + 0.9 * number()) / corners as f64 * std::f64::consts::TAU;
        (x * angle.cos() + y * angle.sin()) * (0.1 + number())
    };
    (0..corners).map(corner).collect()
}

#[test]
fn triangles_cover_the_polygon_and_nothing_else() {
    let mut random = Random(1);
    for _ in 0..2000 {
        let corners = 4 + random.below(40);
        let points = star(&mut random, corners);
        let (triangles, notes) = cut_one(&points);
        let whole: DVec3 = (2..corners as u32).map(|i| area(&points, [0, i - 1, i])).sum();
        let parts: f64 = triangles.iter().map(|&triangle| area(&points, triangle).length()).sum();
        assert!((parts - whole.length()).abs() <= 1e-9 * parts, "{points:?}");
        // Each triangle has the orientation of the polygon, and all corners are used.
        assert!(triangles.iter().all(|&triangle| area(&points, triangle).dot(whole) >= -1e-12 * parts * parts));
        let mut used: Vec<_> = triangles.as_flattened().to_vec();
        used.sort_unstable();
        used.dedup();
        assert_eq!((triangles.len(), used.len(), notes), (corners - 2, corners, 0));
    }
}

#[test]
fn size_and_place_do_not_matter() {
    let dart = [[0.0, 0.0, 0.0], [2.0, 1.0, 0.0], [4.0, 0.0, 0.0], [2.0, 4.0, 0.0]].map(DVec3::from_array);
    for scale in [1.0, 1e-300, 1e-160, 1e160, 4e307] {
        let (triangles, notes) = cut_one(&dart.map(|point| point * scale));
        assert_eq!((&triangles[..], notes), (&[[0, 1, 3], [1, 2, 3]][..], 0), "{scale}");
    }
    let (far, _) = cut_one(&dart.map(|point| point + 1e9));
    assert_eq!(far, [[0, 1, 3], [1, 2, 3]]);
}

/// The time is bounded for any corners.
#[test]
fn large_polygons_end() {
    let mut random = Random(2);
    let mut number = || random.below(1 << 20) as f64;
    let wild: Vec<_> = (0..MOST_CORNERS).map(|_| DVec3::new(number(), number(), 0.0)).collect();
    assert_eq!(cut_one(&wild).1, 1);
    let teeth = |i: usize| DVec3::new(i as f64, if i.is_multiple_of(2) { 0.0 } else { 9.0 }, 0.0);
    let mut comb: Vec<_> = (0..MOST_CORNERS - 1).map(teeth).collect();
    comb.push(DVec3::new(0.0, -9e9, 0.0));
    assert_eq!(cut_one(&comb).1, 0);
    comb.push(DVec3::new(-1.0, -9e9, 0.0));
    assert_eq!(cut_one(&comb).1, 1);
}
