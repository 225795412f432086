use glam::{DVec3, Vec3};
use proptest::prelude::*;

use super::*;
use crate::geom::Ray;
use crate::geom::frame::power_of_two;
use crate::geom::tests::{exact, holds, threshold, threshold_in_single};
use crate::geom::truth::{Place, Point, round_f64};

pub(super) fn number() -> impl Strategy<Value = f32> {
    let few = [0.0, -0.0, 1.0, -1.0, 2.0, 0.1, -3.0, 1e-20, 1e10, -1e30, 1e-42, 1e-45, -1e-45];
    prop_oneof![3 => prop::sample::select(few.to_vec()), 3 => -4.0..4.0f32, 2 => threshold_in_single()]
}

pub(super) fn double() -> impl Strategy<Value = f64> {
    let few = [0.0, 1.0, -1.0, 0.1, 6.4e6, 1e-50, -1e50, 1e-200, -1e150, 5e-324, -1e-310, 1e300];
    prop_oneof![prop::sample::select(few.to_vec()), -4.0..4.0f64, threshold()]
}

/// Draws numbers of few bits, so the results of a few sums and products are floats.
fn whole() -> impl Strategy<Value = f32> {
    (-3..=3i8).prop_map(f32::from)
}

fn vector<S: Strategy<Value = f32>>(number: fn() -> S) -> impl Strategy<Value = Vec3> {
    [number(), number(), number()].prop_map(Vec3::from)
}

fn affine<S: Strategy<Value = f32>>(number: fn() -> S) -> impl Strategy<Value = AffineMap> {
    let row = move || [number(), number(), number(), number()];
    [row(), row(), row()].prop_filter_map("singular", |rows| AffineMap::new(rows).ok())
}

fn exact_vector(v: Vec3) -> [RBig; 3] {
    v.to_array().map(exact)
}

fn image(affine: &AffineMap, v: &[RBig; 3]) -> [RBig; 3] {
    affine.rows().map(|[x, y, z, b]| exact(x) * &v[0] + exact(y) * &v[1] + exact(z) * &v[2] + exact(b))
}

/// Returns the v with A v = w, by Cramer's rule.
pub(super) fn solution<R: Real>(affine: &AffineMap<R>, w: &[RBig; 3]) -> [RBig; 3] {
    let a = affine.rows().map(|[x, y, z, _]| [x, y, z].map(exact));
    let determinant = |a: &[[RBig; 3]; 3]| {
        let minor = |p: usize, q: usize| &a[1][p] * &a[2][q] - &a[1][q] * &a[2][p];
        &a[0][0] * minor(1, 2) + &a[0][1] * minor(2, 0) + &a[0][2] * minor(0, 1)
    };
    [0, 1, 2].map(|column| {
        let mut with = a.clone();
        for row in 0..3 {
            with[row][column] = w[row].clone();
        }
        determinant(&with) / determinant(&a)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// [INST-3]
    #[test]
    fn rays_are_held_through_three_levels(
        maps in [affine(number), affine(number), affine(number)],
        o in vector(number),
        d in vector(number),
    ) {
        let Ok(ray) = Ray::within(o, d, 0.0, 1.0) else { return Ok(()) };
        let (mut bounds, mut origin, mut direction) = (EnclosedRay::exact(&ray), exact_vector(o), exact_vector(d));
        for map in &maps {
            let offset = map.rows().map(|row| exact(row[3]));
            origin = solution(map, &[0, 1, 2].map(|k| &origin[k] - &offset[k]));
            direction = solution(map, &direction);
            bounds = map.pull_back(&bounds);
            for k in 0..3 {
                prop_assert!(holds(bounds.origin[k], &origin[k]), "{:?}", bounds.origin);
                prop_assert!(holds(bounds.direction[k], &direction[k]), "{:?}", bounds.direction);
            }
        }
    }

    /// [INST-2]
    #[test]
    fn boxes_hold_the_images_and_hardly_more(map in affine(number), a in vector(number), b in vector(number)) {
        let aabb = Aabb::of(&[a, b]);
        let found = map.image_of_box(&aabb);
        let corners: Vec<_> = (0..8).map(|i| {
            let corner = [0, 1, 2].map(|k| if i >> k & 1 == 0 { aabb.lo[k] } else { aabb.hi[k] });
            image(&map, &corner.map(exact))
        }).collect();
        for k in 0..3 {
            let (least, most) = corners.iter().map(|corner| &corner[k]).fold(None, |ends: Option<(&RBig, &RBig)>, x| {
                Some(ends.map_or((x, x), |(least, most)| (least.min(x), most.max(x))))
            }).expect("eight corners");
            let below = |float: f32, x: &RBig| RBig::try_from(float).map_or(float < 0.0, |float| float <= *x);
            prop_assert!(below(found.lo[k], least) && below(-found.hi[k], &-most), "{found:?}");
            // The point two floats further inward is inside, unless digits cancelled.
            let sizes: f64 = map.rows()[k].iter().zip([a, a, a, Vec3::ONE].iter().zip([b, b, b, Vec3::ONE]).enumerate())
                .map(|(m, (axis, (a, b)))| f64::from(*m).abs() * f64::from(a[axis.min(2)].abs().max(b[axis.min(2)].abs())))
                .sum();
            let near = |float: f32, x: &RBig| {
                let x = round_f64(x);
                (f64::from(float) - x).abs() <= 2f64.powi(-23) * x.abs() + 2f64.powi(-50) * sizes + 2f64.powi(-149)
            };
            prop_assert!(near(found.lo[k], least) && near(found.hi[k], most) || !found.lo.is_finite() || !found.hi.is_finite());
        }
    }

    /// Doubles of all magnitudes, boxes in a frame, and their images in another frame. [INST-2] [FRAME-1]
    #[test]
    fn boxes_hold_the_images_in_frames(
        rows in [[double(), double(), double(), double()], [double(), double(), double(), double()],
            [double(), double(), double(), double()]],
        a in vector(number), b in vector(number),
        frames in [(double(), -1000..1000), (double(), -1000..1000)],
    ) {
        let Ok(map) = AffineMap::new(rows) else { return Ok(()) };
        let frames = frames.map(|(origin, exponent)| Frame::new(DVec3::splat(origin), exponent).expect("a frame"));
        let power = |exponent: i32| RBig::try_from(power_of_two(exponent)).expect("finite");
        let aabb = Aabb::of(&[a, b]);
        let inside = frames[0].leave(&aabb);
        let outside = map.image(inside);
        let found = frames[1].enter(&outside);
        for i in 0..8 {
            let corner = [0, 1, 2].map(|k| if i >> k & 1 == 0 { aabb.lo[k] } else { aabb.hi[k] });
            let [unit, shift] = [power(frames[0].exponent()), exact(frames[0].origin().x)];
            let corner = corner.map(|x| exact(x) * &unit + &shift);
            let image: [RBig; 3] = map.rows().map(|[x, y, z, b]| {
                exact(x) * &corner[0] + exact(y) * &corner[1] + exact(z) * &corner[2] + exact(b)
            });
            for k in 0..3 {
                prop_assert!(holds(inside[k], &corner[k]) && holds(outside[k], &image[k]), "{inside:?} {outside:?}");
                let coordinate = (&image[k] - exact(frames[1].origin().x)) * power(-frames[1].exponent());
                let ends = Interval::between([found.lo[k], found.hi[k]].map(f64::from));
                prop_assert!(holds(ends, &coordinate), "{found:?}");
            }
        }
    }

    /// [INST-5]
    #[test]
    fn images_are_met_where_they_are(
        maps in [affine(whole), affine(whole)],
        corners in [vector(whole), vector(whole), vector(whole)],
        o in vector(whole),
    ) {
        // A line through the image of the second corner hits it there, at t = 1.
        let [inner, outer] = &maps;
        let target = image(outer, &image(inner, &exact_vector(corners[1])));
        let way = [0, 1, 2].map(|k| &target[k] - exact(o[k]));
        let d = Vec3::from([0, 1, 2].map(|k| way[k].to_f32().value()));
        prop_assert_eq!(exact_vector(d), way);
        match meet_image(corners, &maps, o, d) {
            Meeting::Hit(Point { place, t, u, v }) => {
                prop_assert_eq!((place, t, u, v), (Place::Vertex, RBig::ONE, RBig::ONE, RBig::ZERO));
            }
            Meeting::Coplanar => return Err(TestCaseError::reject("seen edge-on, or no triangle")),
            Meeting::Miss => prop_assert!(false, "a miss"),
        }
    }
}

#[test]
fn maps_without_an_inverse_are_refused_exactly() {
    let map = |rows: [[f32; 3]; 3]| AffineMap::new(rows.map(|[x, y, z]| [x, y, z, 7.0]));
    // A product whose last bit is below double precision.
    let (x, next) = (1f32.next_up(), 1f32.next_up().next_up());
    let (flat, steep) =
        ([[x, x * x, 0.0], [1.0, x, 0.0], [0.0, 0.0, 1.0]], [[x, next, 0.0], [1.0, x, 0.0], [0.0, 0.0, 1.0]]);
    assert!(map(flat).is_ok() && map(steep).is_ok(), "x times x is not a float");
    assert_eq!(map([[x, x, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 1.0]]), Err(AffineError::Singular));
    assert_eq!(map([[0.0; 3]; 3]), Err(AffineError::Singular));
    let (tiny, huge) = (f32::from_bits(1), f32::MAX);
    assert!(map([[tiny, 0.0, 0.0], [0.0, tiny, 0.0], [0.0, 0.0, tiny]]).is_ok());
    assert!(map([[huge, 0.0, 0.0], [0.0, huge, 0.0], [0.0, 0.0, huge]]).is_ok());
    assert_eq!(map([[huge, huge, 0.0], [huge, huge, 0.0], [0.0, 0.0, 1.0]]), Err(AffineError::Singular));
}

#[test]
fn the_first_number_that_is_not_finite_is_named() {
    let mut rows = *AffineMap::IDENTITY.rows();
    rows[1][3] = f32::INFINITY;
    assert_eq!(
        AffineMap::new(rows).map_err(|error| error.to_string()),
        Err("row 1, column 3: inf, expected a finite number".to_owned())
    );
    rows[0][2] = f32::NAN;
    assert!(matches!(AffineMap::new(rows), Err(AffineError::NotFinite { row: 0, column: 2, .. })));
    assert_eq!(AffineMap::<f32>::new(*AffineMap::IDENTITY.rows()), Ok(AffineMap::IDENTITY));
    assert_eq!(AffineMap::translation(Vec3::ZERO), Ok(AffineMap::IDENTITY));
}

#[test]
fn what_needs_no_rounding_is_exact() {
    let map = AffineMap::new([[0.0, 2.0, 0.0, 5.0], [0.0, 0.0, -4.0, 1.0], [0.5, 0.0, 0.0, 0.0]]).expect("a map");
    let aabb = Aabb { lo: Vec3::new(-1.0, 0.1, 2.0), hi: Vec3::new(1.0, 3.0, 2.5) };
    assert_eq!(map.image_of_box(&aabb), Aabb { lo: Vec3::new(5.2, -9.0, -0.5), hi: Vec3::new(11.0, -7.0, 0.5) });
    let ray = Ray::within(Vec3::new(5.0, 1.0, 0.0), Vec3::Y, 0.0, 1.0).expect("a ray");
    let EnclosedRay { origin, direction, .. } = map.pull_back(&EnclosedRay::exact(&ray));
    assert!(origin.iter().all(Interval::is_zero));
    assert_eq!(direction.map(|x| x.is_zero()), [true, true, false], "a ray along an axis stays so");
}

/// Integer maps have integer images of integers, so the line to any point of an image is a line of floats. `[INST-1]`
#[test]
fn whole_images_are_met_at_their_points() {
    let inner = AffineMap::new([[2.0, 1.0, 0.0, 3.0], [0.0, 3.0, -1.0, -4.0], [1.0, 0.0, 5.0, 2.0]]).unwrap();
    let outer = AffineMap::new([[0.0, -1.0, 2.0, 7.0], [4.0, 0.0, 1.0, 1.0], [-1.0, 2.0, 0.0, -6.0]]).unwrap();
    let corners = [[1.0, 2.0, 3.0], [5.0, -4.0, 3.0], [-3.0, 2.0, 7.0]].map(Vec3::from);
    let origin = Vec3::new(11.0, -60.0, 35.0);
    let apply = |map: &AffineMap, v: Vec3| Vec3::from(map.rows().map(|[x, y, z, b]| x * v.x + y * v.y + z * v.z + b));
    let lists: [&[AffineMap]; 4] = [&[], &[inner], &[inner, outer], &[outer, inner, outer]];
    for maps in lists {
        for [u, v] in [[0.25, 0.5], [0.5, 0.25], [0.125, 0.125]] {
            let point = corners[0] + (corners[1] - corners[0]) * u + (corners[2] - corners[0]) * v;
            let way = maps.iter().fold(point, |point, map| apply(map, point)) - origin;
            let Meeting::Hit(point) = meet_image(corners, maps, origin, way) else { panic!("{maps:?} {u} {v}") };
            assert_eq!((point.place, point.t, point.u, point.v), (Place::Interior, RBig::ONE, exact(u), exact(v)));
            let beside = corners[0] - (corners[1] - corners[0]) * u + (corners[2] - corners[0]) * v;
            let way = maps.iter().fold(beside, |point, map| apply(map, point)) - origin;
            assert!(matches!(meet_image(corners, maps, origin, way), Meeting::Miss));
        }
    }
}
