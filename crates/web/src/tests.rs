//! The page's answers are those of the library.

use stackless_bvh::internals::geom::kernel::Moller32;
use stackless_bvh::internals::geom::slabs::Plain;
use stackless_bvh::trace::{BinaryTracer, Hit, RayQueries};
use stackless_bvh::traverse::Method;

use super::*;

const ROOM: &[u8] = include_bytes!("../../../examples/data/room.obj");

#[test]
fn answers_are_those_of_the_tracers() {
    let scene = Scene::read("room.obj", ROOM).unwrap();
    let inexact = BinaryTracer::<_, Moller32, Plain>::with_tests(scene.bvh(), Method::Hashed).unwrap();
    let exact = BinaryTracer::new(scene.bvh());
    let rays = (0..SIDE * SIDE).step_by(101).filter_map(|i| scene.ray([i % SIDE, i / SIDE]));
    for ray in rays {
        assert_eq!(scene.hits(&ray), [exact.closest(&ray), inexact.closest(&ray)]);
    }
}

#[test]
fn a_difference_is_in_the_triangle_not_in_the_distance() {
    let hit = |prim, t| Some(Hit { prim, t, u: 0.0, v: 0.0 });
    let pairs = [
        [None, None],
        [hit(1, 2.0), hit(1, 3.0)],
        [hit(1, 2.0), None],
        [None, hit(1, 2.0)],
        [hit(1, 2.0), hit(2, 2.0)],
    ];
    let expected = [Difference::None, Difference::None, Difference::Lost, Difference::Ghost, Difference::Other];
    assert_eq!(pairs.map(|pair| Difference::of(&pair)), expected);
}

#[test]
fn a_row_shows_what_its_totals_count() {
    let (scene, mut totals) = (Scene::example("corners").unwrap(), Totals::default());
    let rows: Vec<_> = (100..110).map(|y| scene.row(y, &mut totals)).collect();
    let count = |what: Difference| rows.iter().flat_map(|row| &row.differences).filter(|&&it| it == what as u8).count();
    let counts = [Difference::Lost, Difference::Ghost, Difference::Other].map(|what| count(what) as u64);
    assert_eq!(counts, [totals.lost, totals.ghosts, totals.other]);
    assert!(counts[0] > 10 && counts[2] > 10, "{counts:?}");
    let seen = |picture: fn(&Row) -> &Vec<u8>| {
        rows.iter().flat_map(|row| picture(row).chunks(4)).filter(|colour| colour[3] == 255).count() as u64
    };
    let [exact, inexact] = [seen(|row| &row.exact), seen(|row| &row.inexact)];
    assert_eq!((exact, inexact), (totals.hits, totals.hits + totals.ghosts - totals.lost));
}

#[test]
fn every_example_is_a_scene_with_a_page_for_its_middle() {
    for example in Example::ALL {
        let scene = Scene::example(example.name).unwrap();
        let page = scene.explain([SIDE / 2, SIDE / 2]).unwrap();
        assert!(page.contains(&format!("\"title\":\"{}, pixel 256,256\"", example.name)), "{}", example.name);
    }
}

#[test]
fn what_is_no_scene_is_told_in_a_line() {
    let fault = |name: &str, bytes: &[u8]| Scene::read(name, bytes).unwrap_err().to_string();
    assert_eq!(fault("a.xyz", b""), "a.xyz: extension \"xyz\", expected .ply, .obj, .stl, .gltf or .glb");
    assert_eq!(fault("a.obj", b"v 0 0 0\n"), "a.obj: no triangles, expected at least one");
    assert!(fault("a.obj", b"v 0 0\n").starts_with("a.obj: line 1: "));
    assert!(fault("a.ply", &vec![0; MOST_BYTES + 1]).contains("at most 67108864"));
    assert_eq!(Scene::example("nosuch").unwrap_err().to_string(), "nosuch: there is no such example");
    let room = Scene::read("room.obj", ROOM).unwrap();
    assert!(matches!(room.explain([SIDE, 0]), Err(SceneFault::NoRay)));
}
