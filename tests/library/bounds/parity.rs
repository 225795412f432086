//! The half-open rule counts each crossing of a closed mesh once [PARITY-1].

type Point = [i64; 3];

/// The treatment of an edge function of value zero.
#[derive(Clone, Copy, PartialEq)]
enum Rule {
    /// The hit counts.
    Closed,
    /// The hit does not count.
    Open,
    /// The sign is that of the first component of `(a - b) x d` that is not zero.
    HalfOpen,
}

fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Point, b: Point) -> i64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns the sign of the edge function from `a` to `b`.
fn side(o: Point, d: Point, a: Point, b: Point, rule: Rule) -> i64 {
    let exact = dot(d, cross(sub(a, o), sub(b, o))).signum();
    if exact != 0 || rule != Rule::HalfOpen {
        return exact;
    }
    cross(sub(a, b), d).into_iter().find(|&x| x != 0).unwrap_or(0).signum()
}

/// Returns whether the half-line from `o` crosses the triangle.
fn crosses(o: Point, d: Point, [a, b, c]: [Point; 3], rule: Rule) -> bool {
    let normal = cross(sub(b, a), sub(c, a));
    let (det, t) = (dot(d, normal), dot(sub(a, o), normal));
    if det == 0 || t * det.signum() < 0 {
        return false;
    }
    let sides = [(a, b), (b, c), (c, a)].map(|(a, b)| side(o, d, a, b, rule));
    match rule {
        Rule::Closed => sides.iter().all(|&s| s >= 0) || sides.iter().all(|&s| s <= 0),
        Rule::Open | Rule::HalfOpen => sides.iter().all(|&s| s > 0) || sides.iter().all(|&s| s < 0),
    }
}

/// Returns the cube of half edge 4 with faces of 8 triangles around the middle, an octahedron, and a tetrahedron.
fn meshes() -> [Vec<[Point; 3]>; 3] {
    let (mut cube, mut octahedron) = (Vec::new(), Vec::new());
    for (axis, side) in (0..3).flat_map(|axis| [(axis, 1), (axis, -1)]) {
        let point = |x: i64, y: i64| {
            let mut p = [4 * side; 3];
            (p[(axis + 1) % 3], p[(axis + 2) % 3]) = (4 * x, 4 * y);
            p
        };
        let ring = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)];
        cube.extend(ring.windows(2).map(|w| [point(0, 0), point(w[0].0, w[0].1), point(w[1].0, w[1].1)]));
    }
    for signs in 0..8 {
        let tip = |axis: usize| std::array::from_fn(|k| if k == axis { 5 - 10 * (signs >> axis & 1) } else { 0 });
        octahedron.push([tip(0), tip(1), tip(2)]);
    }
    let corners = [[-3, -3, -3], [9, -3, -3], [-3, 9, -3], [-3, -3, 9]];
    let tetrahedron = (0..4).map(|k| [corners[(k + 1) % 4], corners[(k + 2) % 4], corners[(k + 3) % 4]]).collect();
    [cube, octahedron, tetrahedron]
}

/// Traces rays from all close integer points in all integer directions. Most hit an edge or a vertex or graze a face.
/// Returns the number of rays with an even number of crossings from inside, or an odd number from outside.
fn wrong(rule: Rule) -> usize {
    let range = |reach: i64| {
        (-reach..=reach).flat_map(move |x| (-reach..=reach).flat_map(move |y| (-reach..=reach).map(move |z| [x, y, z])))
    };
    let inside: [fn(Point) -> std::cmp::Ordering; 3] = [
        |p| p.map(i64::abs).into_iter().max().unwrap_or(0).cmp(&4),
        |p| p.map(i64::abs).into_iter().sum::<i64>().cmp(&5),
        |p| (p.into_iter().sum::<i64>() - 3).max(p.map(|x| -3 - x).into_iter().max().unwrap_or(0)).cmp(&0),
    ];
    let mut wrong = 0;
    for (mesh, place) in meshes().iter().zip(inside) {
        for o in range(5).filter(|&o| place(o).is_ne()) {
            for d in range(2).filter(|&d| d != [0; 3]) {
                let count = mesh.iter().filter(|&&triangle| crosses(o, d, triangle, rule)).count();
                wrong += usize::from((count % 2 == 1) != place(o).is_lt());
            }
        }
    }
    wrong
}

#[test]
fn the_half_open_rule_counts_each_crossing_once() {
    assert_eq!(wrong(Rule::HalfOpen), 0);
    assert!(wrong(Rule::Closed) > 10_000 && wrong(Rule::Open) > 10_000);
}
