use super::*;

/// A square of two triangles in the plane z = 0, and a larger triangle behind it.
const VERTICES: [[f32; 3]; 7] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [-9.0, -9.0, 4.0],
    [9.0, -9.0, 4.0],
    [0.0, 9.0, 4.0],
];
const TRIANGLES: [[u32; 3]; 3] = [[0, 1, 2], [0, 2, 3], [4, 5, 6]];

fn ray(origin: [f32; 3], direction: [f32; 3], tmin: f32, tmax: f32) -> Ray {
    Ray { origin, direction, tmin, tmax }
}

/// Rays with their closest hits, with directions of several lengths, seen from every side.
fn cases() -> Vec<(Ray, Option<Hit>)> {
    let (up, down) = ([0.0, 0.0, 2.0], [0.0, 0.0, -0.5]);
    vec![
        (ray([0.75, 0.25, -2.0], up, 0.0, f32::INFINITY), Some((0, 1.0))),
        (ray([0.25, 0.75, -2.0], up, 0.0, f32::INFINITY), Some((1, 1.0))),
        (ray([0.75, 0.25, -2.0], up, 0.0, 0.5), None),
        (ray([0.75, 0.25, -2.0], up, 1.5, f32::INFINITY), Some((2, 3.0))),
        (ray([0.75, 0.25, -2.0], up, 1.5, 2.5), None),
        (ray([-2.0, -2.0, -2.0], up, 0.0, f32::INFINITY), Some((2, 3.0))),
        (ray([0.75, 0.25, 6.0], down, 0.0, f32::INFINITY), Some((2, 4.0))),
        (ray([0.75, 0.25, 2.0], down, 0.0, f32::INFINITY), Some((0, 4.0))),
        (ray([20.0, 0.25, 2.0], down, 0.0, f32::INFINITY), None),
        (ray([0.75, 0.25, -2.0], down, 0.0, f32::INFINITY), None),
    ]
}

#[test]
fn every_peer_that_is_there_finds_the_hits() {
    let (rays, expected): (Vec<_>, Vec<_>) = cases().into_iter().unzip();
    for peer in Peer::ALL {
        let tracer = match peer.build(&VERTICES, &TRIANGLES) {
            Err(PeerError::NotInstalled(what)) => {
                println!("{}: {what}", peer.name());
                continue;
            }
            built => built.unwrap(),
        };
        let mut hits = vec![Some((7, 7.0)); rays.len()];
        tracer.closest(&rays, &mut hits);
        for (i, (&hit, &expected)) in hits.iter().zip(&expected).enumerate() {
            assert!(same(peer, hit, expected), "{}, ray {i}: {hit:?}, not {expected:?}", peer.name());
        }
        for before in [false, true] {
            let mut hits = vec![before; rays.len()];
            tracer.any(&rays, &mut hits);
            assert_eq!(hits, expected.iter().map(Option::is_some).collect::<Vec<_>>(), "{}", peer.name());
        }
    }
}

/// Whether the hits are one triangle at one distance. Embree divides by `rcpps`, whose result depends on the processor,
/// with one Newton step: on AMD the distance is one ulp off.
fn same(peer: Peer, hit: Option<Hit>, expected: Option<Hit>) -> bool {
    let error = if matches!(peer, Peer::Embree | Peer::EmbreeRobust) { f32::EPSILON } else { 0.0 };
    match (hit, expected) {
        (Some((a, t)), Some((b, exact))) => a == b && (t - exact).abs() <= error * exact,
        _ => hit == expected,
    }
}

#[test]
fn corners_must_be_vertices() {
    for peer in Peer::ALL {
        let error = peer.build(&VERTICES, &[[0, 1, 2], [0, 7, 1]]).err();
        assert_eq!(error, Some(PeerError::Index { triangle: 1 }), "{}", peer.name());
    }
}

#[test]
fn names_differ() {
    let mut names = Peer::ALL.map(Peer::name).to_vec();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), Peer::ALL.len());
}

#[test]
fn what_has_moved_is_hit_where_it_is() {
    let mut moving = match Moving::new(&VERTICES, &TRIANGLES) {
        Err(PeerError::NotInstalled(what)) => return println!("{what}"),
        built => built.unwrap(),
    };
    let there = VERTICES.map(|[x, y, z]| [x, y + 100.0, z + 1.0]);
    moving.refit(&there).unwrap();
    let (rays, expected): (Vec<_>, Vec<_>) = cases().into_iter().unzip();
    let moved = |ray: &Ray| Ray { origin: [ray.origin[0], ray.origin[1] + 100.0, ray.origin[2] + 1.0], ..*ray };
    let mut hits = vec![None; rays.len()];
    moving.closest(&rays.iter().map(moved).collect::<Vec<_>>(), &mut hits);
    assert!(hits.iter().zip(&expected).all(|(&hit, &expected)| same(Peer::Embree, hit, expected)), "{hits:?}");
    assert!(moving.refit(&there[1..]).is_err());
}
