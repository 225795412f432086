use super::*;
use crate::geom::Aabb;

/// Double precision is used only if necessary.
#[test]
fn single_precision_takes_what_it_can() {
    let is_wide = |[o, d]: [Vec3; 2], reach: f32| {
        let ray = Ray::new(o, d).expect("a ray");
        Directed::new(&ray, &Region::of(&Aabb { lo: Vec3::splat(-reach), hi: Vec3::ZERO })).is_wide
    };
    let across = |d: f32| [Vec3::Y, Vec3::new(1.0, 0.0, d)];
    // Coordinates up to 2^126.
    let most = 2f32.powi(126);
    for x in [1.0, most] {
        let o = Vec3::Y * x;
        assert_eq!(
            [is_wide([o, Vec3::ONE], x), is_wide([-o, -Vec3::ONE], x), is_wide(across(0.5), x)],
            [false; 3],
            "{x}"
        );
    }
    let beyond = most.next_up();
    assert_eq!([is_wide([Vec3::Y * beyond, Vec3::ONE], most), is_wide(across(0.5), beyond)], [true; 2]);
    // Components with finite reciprocals.
    for d in [0.0, -0.0, f32::MIN_POSITIVE, -f32::MIN_POSITIVE, f32::MAX] {
        assert!(!is_wide(across(d), 1.0), "{d}");
    }
    for d in [1e-39, -1e-39, 1e-45] {
        assert!(is_wide(across(d), 1.0), "{d}");
    }
    // Distances that do not overflow.
    let short = |d: f32| is_wide([Vec3::Y * 1e30, Vec3::X * d], 1e30);
    assert_eq!([short(1e-4), short(1e-5)], [false, true]);
    // No distant origins.
    let away = |x: f32| [is_wide([Vec3::Y * x, Vec3::ONE], 1.0), is_wide([Vec3::Y * -x, Vec3::ONE], 1.0)];
    assert_eq!([away(8191.0), away(8194.0)], [[false; 2], [true; 2]]);
}

/// From far away, single precision cannot decide what is hit. [BOX-9]
#[test]
fn rays_from_afar_meet_what_is_in_their_way_and_nothing_else() {
    let all = Aabb { lo: Vec3::splat(-1.0), hi: Vec3::ONE };
    let part = |at: Vec3| Aabb { lo: at - 1.0 / 1024.0, hi: at + 1.0 / 1024.0 };
    for octant in 0..8u8 {
        let sign = Vec3::from([0, 1, 2].map(|k| if octant >> k & 1 == 1 { -1.0 } else { 1.0 }));
        for far in [1e5, 1e8, 1e20, 1e37] {
            let to = |target: Vec3| {
                Ray::new(-sign * far, sign)
                    .map(|ray| Directed::new(&ray, &Region::of(&all)))
                    .map(|slabs| (slabs.is_wide, slabs.one(&part(target), f32::INFINITY).is_some()))
            };
            assert_eq!(to(Vec3::ZERO), Ok((true, true)), "{sign} {far}");
            assert_eq!(to(sign * Vec3::new(0.5, 0.5, 0.49)), Ok((true, false)), "{sign} {far}");
            let beside = Ray::new(-sign * far + sign.with_y(0.0) * far * 0.5, sign).expect("a ray");
            assert!(Directed::new(&beside, &Region::of(&all)).one(&all, f32::INFINITY).is_none(), "{sign} {far}");
        }
    }
}

/// A ray that leaves the plane of flat boxes, even slowly, is soon above them. [BOX-9]
#[test]
fn a_slow_component_takes_a_ray_out_of_a_plane() {
    for at in 0..4u8 {
        let lo = Vec3::new(f32::from(at), 0.0, 1.0);
        let aabb = Aabb { lo, hi: lo + Vec3::new(1.0, 1.0, 0.0) };
        for slow in [0.0, 1e-45, -1e-45, 1e-38, -f32::MIN_POSITIVE] {
            let ray = Ray::new(Vec3::new(0.5, 0.5, 1.0), Vec3::new(64.0, 0.0, slow)).expect("a ray");
            let slabs = Directed::new(&ray, &Region::of(&Aabb { lo: Vec3::ZERO, hi: Vec3::splat(9.0) }));
            assert_eq!(slabs.one(&aabb, f32::INFINITY).is_some(), at == 0 || slow == 0.0, "{at} {slow}");
        }
    }
}
