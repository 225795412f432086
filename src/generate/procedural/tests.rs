use super::*;
use crate::geom::{Aabb, Ray};

#[test]
fn scenes_have_the_stated_size_and_repeat() {
    assert_eq!(strands(1, 10).triangles().len(), 10 * 2 * SEGMENTS);
    assert_eq!(stadium(1).triangles().len(), 2 * (16 * 2 * TIERS + 6 * SQUARES * SQUARES));
    assert_eq!(soup(1, 100).triangles().len(), 100);
    for make in [|seed| strands(seed, 9), stadium, |seed| soup(seed, 99)] {
        assert_eq!(make(7).vertices(), make(7).vertices());
        assert_ne!(make(7).vertices(), make(8).vertices());
    }
}

#[test]
fn the_ball_is_tiny_in_the_stadium() {
    let mesh = stadium(3);
    let outer = Aabb::of(mesh.vertices()).extent();
    let ball = Aabb::of(&mesh.vertices()[17 * (2 * TIERS + 1)..]).extent();
    assert!(outer.min_element() > 100.0 && ball.max_element() < 0.11, "{outer} {ball}");
}

#[test]
fn rays_are_of_all_kinds() {
    let mesh = soup(5, 50);
    let rays = rays(&mesh, 2, 800);
    assert_eq!(rays.len(), 800);
    let count = |f: fn(&Ray) -> bool| rays.iter().filter(|ray| f(ray)).count();
    let is_negative_zero = |x: f32| x == 0.0 && x.is_sign_negative();
    assert!(rays.iter().any(|ray| ray.direction().to_array().into_iter().any(is_negative_zero)));
    assert!(count(|ray| ray.direction().cmpeq(Vec3::ZERO).bitmask().count_ones() == 2) >= 100);
    assert!(count(|ray| ray.tmax() < f32::INFINITY && ray.tmin() > 0.0) >= 90);
}

#[test]
fn layers_come_ever_nearer_to_the_last_plane() {
    let mesh = layers(256);
    let planes: Vec<_> = mesh.vertices().chunks(3).map(|corners| corners[0].x).collect();
    assert_eq!((mesh.triangles().len(), layers(0).triangles().len()), (256, 1));
    assert!(planes.windows(2).all(|pair| pair[0] < pair[1]) && planes[255] < -f32::MIN_POSITIVE);
    assert!(mesh.vertices().chunks(3).all(|corners| corners.iter().all(|corner| corner.x == corners[0].x)));
}
