//! Cases of `ray/exact` about the order of hits: by exact distance, and ties by triangle index. Most distances of two
//! hits differ by less than an ulp.

use glam::Vec3;

use super::Author;
use super::ray::{any, closest, ray};
use super::tolerant::{scaled, sphere};
use super::truth::{Mesh, Ray};
use stackless_bvh::generate::{Rng, Source};

/// The corners of a triangle.
type Face = [Vec3; 3];

const WHOLE: [f32; 2] = [0.0, f32::INFINITY];

pub(super) fn cases(author: &mut Author) {
    sheets(author);
    shells(author);
    edges(author);
    planes(author);
    points(author);
    crossing(author);
    stacks(author);
    ranges(author);
    ends(author);
}

/// Adds two cases, with the triangles in both orders.
fn both_ways(author: &mut Author, name: &str, why: &str, faces: &[Face], rays: &[Ray]) {
    closest(author, name, why, &mesh(faces), rays);
    let turned: Vec<_> = faces.iter().rev().copied().collect();
    closest(author, &format!("{name}-turned"), why, &mesh(&turned), rays);
}

fn sheets(author: &mut Author) {
    let mut rays = Vec::new();
    for height in [10.0, 100.0, 1000.0, 1e5, -100.0, -1000.0] {
        for slope in [Vec3::ZERO, Vec3::new(0.25, -0.125, 0.0)] {
            let along = slope - Vec3::Z;
            rays.push(ray(-height * along, 3f32.copysign(height) * along, WHOLE));
        }
    }
    rays.push(ray(100.0 * Vec3::Z, -Vec3::Z, WHOLE));
    let why = "Two sheets 1e-6 apart: from afar both distances round to one float, and the nearer sheet is hit.";
    both_ways(author, "order-sheets", why, &[flat(0.0), flat(1e-6)], &rays);
}

fn shells(author: &mut Author) {
    let rng = &mut Rng::new(7100);
    let rays: Vec<_> = (0..16)
        .map(|_| {
            let (from, to) = (drawn(rng, 2001), drawn(rng, 1001) / 1000.0);
            let from = from * (3000.0 / from.dot(from).sqrt());
            ray(from, (to - from) / 3000.0, WHOLE)
        })
        .collect();
    let shells = [1.0, 1.0 + 4e-5].map(|radius| faces(&scaled(&sphere(1), Vec3::splat(radius))));
    let why =
        "Shells of radius 1 and 1 + 4e-5 from a distance of 3,000: the outer one is hit, whatever its numbers are.";
    both_ways(author, "order-shells", why, &shells.concat(), &rays);
}

/// Adds a landscape with integer vertices, and rays at its corners and at the midpoints of its edges.
fn edges(author: &mut Author) {
    let rng = &mut Rng::new(7101);
    let heights: Vec<_> = (0..16).map(|_| 2.0 * rng.below(3) as f32).collect();
    let at = |i: usize| Vec3::new(16.0 * (i % 4) as f32, 16.0 * (i / 4) as f32, heights[i]);
    let cells = [0, 1, 2, 4, 5, 6, 8, 9, 10];
    let mut land: Vec<_> = cells.iter().flat_map(|&i| [[i, i + 1, i + 4], [i + 5, i + 4, i + 1]]).collect();
    shuffle(rng, &mut land);
    let mut rays = Vec::new();
    while rays.len() < 16 {
        let corners = land[rng.below(land.len() as u64) as usize].map(at);
        let [a, b] = [corners[rng.below(3) as usize], corners[rng.below(3) as usize]];
        let from = drawn(rng, 33) + Vec3::new(24.0, 24.0, 1000.0);
        rays.push(towards(rng, from, (a + b) / 2.0));
    }
    let land: Vec<Face> = land.into_iter().map(|corners| corners.map(at)).collect();
    let why = "At edges and corners all neighbours are hit at one distance, which is no float: the lowest number wins.";
    closest(author, "order-edges", why, &mesh(&land), &rays);
    let why =
        "The same above its image 2^-20 lower, which has the lower numbers, and distances that round to the same.";
    closest(author, "order-edges-thin", why, &mesh(&[moved(&land, -Vec3::Z / 1_048_576.0), land].concat()), &rays);
}

/// Adds triangles of all kinds that overlap in an oblique plane.
fn planes(author: &mut Author) {
    let rng = &mut Rng::new(7102);
    let axes = [Vec3::new(5.0, 1.0, -3.0), Vec3::new(-2.0, 7.0, 4.0)];
    let overlapping: Vec<_> = (0..24).map(|_| within(rng, Vec3::ONE, axes)).collect();
    let rays: Vec<_> = (0..16)
        .map(|_| {
            let [i, j] = [(); 2].map(|()| rng.below(9) as f32 - 4.0);
            let from = drawn(rng, 65) + Vec3::new(1500.0, 2500.0, -3500.0);
            towards(rng, from, Vec3::ONE + i * axes[0] + j * axes[1])
        })
        .collect();
    let why = "Triangles overlap in a skew plane: their distances are equal, but round to unequal ones on the way.";
    both_ways(author, "order-plane", why, &overlapping, &rays);
    let why = "The same in front of its image 2^-16 behind, which has the lower numbers: of the triangles in front the lowest number wins.";
    let behind = moved(&overlapping, -Vec3::new(1.0, 1.0, -1.0) / 65_536.0);
    closest(author, "order-plane-thin", why, &mesh(&[behind, overlapping].concat()), &rays);
}

/// Adds triangles in random planes with one common point, and rays through this point.
fn points(author: &mut Author) {
    let rng = &mut Rng::new(7103);
    let (mut apart, mut thin, mut rays) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..12 {
        let (point, from) = (64.0 * drawn(rng, 9), drawn(rng, 15) + Vec3::splat(0.5));
        for size in [1.0, 3.0, 4.0, 7.0, 8.0] {
            let [a, b] = [(); 2].map(|()| size * drawn(rng, 9));
            let face = [a, b, -a - b].map(|side| point + side);
            apart.push(face);
            thin.extend([moved(&[face], -from / 2048.0)[0], face]);
        }
        let along = [1.0, 3.0, 7.0][rng.below(3) as usize] * -from;
        rays.push(ray(point + 1_048_576.0 * from, along, WHOLE));
    }
    shuffle(rng, &mut apart);
    let why = "Triangles of many planes and sizes meet in a point, at one exact distance: the lowest number wins.";
    closest(author, "order-point", why, &mesh(&apart), &rays);
    let why = "The same, each before its own image, which has the lower number: 2^-11 farther, of a distance of 2^20.";
    closest(author, "order-point-thin", why, &mesh(&thin), &rays);
}

fn crossing(author: &mut Author) {
    let across =
        |slope: f32| [[-2.0, -2.0], [2.0, -2.0], [0.0, 4.0]].map(|[x, y]| Vec3::new(x, y, slope * x / 1_048_576.0));
    let rays: Vec<_> = [-1.0, -0.001, -1e-30, -0.0, 1e-30, 0.001, 1.0]
        .into_iter()
        .flat_map(|x| [64.0, -64.0].map(|z: f32| ray(Vec3::new(x, 0.5, z), -z.signum() * Vec3::Z, WHOLE)))
        .collect();
    let why = "Two triangles cross at a millionth of a slope: the nearer one changes at the line where they are equal.";
    both_ways(author, "order-crossing", why, &[across(1.0), across(-1.0)], &rays);
}

fn stacks(author: &mut Author) {
    const LEAST: f32 = 1.0 / (1 << 30) as f32;
    let rng = &mut Rng::new(7104);
    let tilted = |k: i32| {
        let at = |x, y, step: f32| Vec3::new(x, y, (k as f32).mul_add(LEAST, step / 256.0));
        [at(-1.0, -1.0, -1.0), at(3.0, -1.0, 2.0), at(-1.0, 3.0, 0.0)]
    };
    let rays: Vec<_> = (0..12)
        .map(|_| {
            let [x, y] = [(); 2].map(|()| rng.below(9) as f32 / 8.0 - 0.5);
            ray(Vec3::new(x, y, 1.0), -[1.0, 3.0, 0.125][rng.below(3) as usize] * Vec3::Z, WHOLE)
        })
        .collect();
    let mut stack: Vec<_> = (0..16).map(tilted).collect();
    let why = "Sixteen parallel triangles 2^-30 apart from a distance of 1: all distances round to one float.";
    both_ways(author, "order-stack", why, &stack, &rays);
    shuffle(rng, &mut stack);
    closest(author, "order-stack-mixed", why, &mesh(&stack), &rays);
}

/// Adds distances that round to 0, to infinity, and to a subnormal number.
fn ranges(author: &mut Author) {
    let rng = &mut Rng::new(7105);
    let mut stack = |at: f32, step: f32| {
        let mut faces: Vec<_> = (0..12).map(|k| flat((k as f32).mul_add(-step, -at))).collect();
        shuffle(rng, &mut faces);
        mesh(&faces)
    };
    let [p2_60, p2_100] = [60, 100].map(|power| f32::from_bits((127 + power) << 23));
    let from = |heights: &[f32], speeds: &[f32], ends| -> Vec<_> {
        let each = heights.iter().flat_map(|&z| speeds.iter().map(move |&speed| (z, speed)));
        each.map(|(z, speed)| ray(Vec3::new(0.5, 0.25, z), -speed * Vec3::Z, ends)).collect()
    };
    let near = stack(0.0, 1.0 / p2_60 / 16.0);
    let heights = [1.0, 0.25, 0.0, -0.125, -0.25, -0.5].map(|z| z / p2_60);
    let why = "Distances below 2^-150: all round to 0, and are not equal, also where one is 0.";
    closest(author, "order-underflow", why, &near, &from(&heights, &[p2_100, 3.0 * p2_100], WHOLE));
    let why = "Distances around half of the least subnormal number, which rounds to 0: they round to 0 or 2^-149.";
    let speeds = [p2_60 * 536_870_912.0, p2_60 * 268_435_456.0];
    closest(author, "order-underflow-half", why, &near, &from(&heights, &speeds, WHOLE));
    let far = stack(p2_60, p2_60 / 1_048_576.0);
    let slow = [1.0 / p2_100, 3.0 / p2_100];
    let infinite = [[0.0, f32::INFINITY], [f32::MAX, f32::INFINITY], [0.0, f32::MAX]];
    let rays = infinite.map(|ends| from(&[0.0, 64.0, p2_60], &slow, ends)).concat();
    let why =
        "Distances beyond all floats: all round to infinity, and are not equal. Those with a finite end are missed.";
    closest(author, "order-overflow", why, &far, &rays);
    let step = 1.0 / 32_768.0;
    let subnormal = stack(0.0, 1.0 / p2_60 * 1_048_576.0 * step);
    let why = "Subnormal distances: 2^-140 and a little more, which is less than they are apart.";
    let heights = [1.0, 1.0 + 2.0 * step, 2.0, 0.5].map(|z| z / p2_60 * 1_048_576.0);
    closest(author, "order-subnormal", why, &subnormal, &from(&heights, &[p2_100, 3.0 * p2_100], WHOLE));
}

/// Adds distances inside and outside the interval that round to its ends.
fn ends(author: &mut Author) {
    const MAX: f32 = f32::MAX;
    let mut at_ends = |name: &str, why: &str, faces: &[Face], rays: &[Ray]| {
        closest(author, name, why, &mesh(faces), rays);
        any(author, name, why, &mesh(faces), rays);
    };
    let from = |[x, y, z]: [f32; 3], speed: f32, ends: &[[f32; 2]]| -> Vec<_> {
        ends.iter().map(|&ends| ray(Vec3::new(x, y, z), -speed * Vec3::Z, ends)).collect()
    };
    let [below, above] = [1f32.next_down(), 1f32.next_up()];
    let ends = [[0.0, 1.0], [1.0, 1.0], [1.0, 2.0], [below, 1.0], [1.0, above], [below, above], [0.0, below]];
    let ends = [&ends[..], &[[above, 2.0], [0.0, above], [below, below], [above, above]]].concat();
    let sheets = |steps: &[i8], step: f32| steps.iter().map(|&k| flat(f32::from(k) * step)).collect::<Vec<_>>();
    let why = "Distances that round to tmin and tmax, on either side of it: the exact ones are compared.";
    let step = 1.0 / (1 << 30) as f32;
    at_ends("order-ends", why, &sheets(&[-3, -2, -1, 1, 2, 3], step), &from([0.5, 0.25, 1.0], 1.0, &ends));
    at_ends("order-ends-met", why, &sheets(&[2, 0, 1, -2, -1], step), &from([0.5, 0.25, 1.0], 1.0, &ends));
    let (tiny, fast) = (f32::from_bits(1), f32::from_bits((127 + 100) << 23));
    let ends = [[0.0, 0.0], [-0.0, tiny], [tiny, tiny], [0.0, f32::INFINITY], [tiny, f32::INFINITY]];
    let why = "Distances that round to 0, on either side of it: a ray from 0 to 0 hits what is exactly there.";
    let step = 1.0 / fast / 1024.0;
    at_ends("order-ends-0", why, &sheets(&[-3, -2, -1, 1, 2], step), &from([0.5, 0.25, 0.0], fast, &ends));
    at_ends("order-ends-0-met", why, &sheets(&[2, -3, -2, -1, 0, 1], step), &from([0.5, 0.25, 0.0], fast, &ends));
    // Corners are 16 apart there. Planes through the corners have the values in between.
    let farthest = -MAX / fast;
    let steep = |a: f32, b: f32, c: f32| {
        [[-1.0, -1.0, a], [3.0, -1.0, b], [-1.0, 3.0, c]].map(|[x, y, k]| Vec3::new(x, y, (16.0 * k) + farthest))
    };
    let faces = [steep(0.0, 0.0, 0.0), steep(1.0, 0.0, 0.0), steep(0.0, 0.0, 1.0), steep(0.0, 1.0, 0.0)];
    let ends = [[0.0, f32::INFINITY], [0.0, MAX], [MAX, MAX], [MAX, f32::INFINITY]];
    let heights = [-12.0, -6.0, -1.0, 0.0, 1.0, 8.0, 12.0];
    let rays: Vec<_> = heights.into_iter().flat_map(|z| from([-0.5, 0.25, z], 1.0 / fast, &ends)).collect();
    let why = "Distances around the greatest float: those that round to it may be beyond it.";
    at_ends("order-ends-max", why, &faces, &rays);
}

fn flat(z: f32) -> Face {
    [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]].map(|[x, y]| Vec3::new(x, y, z))
}

fn mesh(faces: &[Face]) -> Mesh {
    let vertices = faces.as_flattened().iter().map(Vec3::to_array).collect();
    Mesh { vertices, triangles: (0..faces.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect() }
}

fn faces(mesh: &Mesh) -> Vec<Face> {
    let corner = |corner: u32| Vec3::from_array(mesh.vertices[corner as usize]);
    mesh.triangles.iter().map(|corners| corners.map(corner)).collect()
}

fn moved(faces: &[Face], by: Vec3) -> Vec<Face> {
    faces.iter().map(|corners| corners.map(|corner| corner + by)).collect()
}

/// Draws integers around 0, `count` per axis.
fn drawn(rng: &mut Rng, count: u32) -> Vec3 {
    Vec3::from_array([(); 3].map(|()| rng.below(u64::from(count)) as f32 - (count / 2) as f32))
}

/// Draws a triangle in the plane of a point and two directions, with corners at integer multiples of the directions.
fn within(rng: &mut Rng, point: Vec3, axes: [Vec3; 2]) -> Face {
    [(); 3].map(|()| {
        let [i, j] = [(); 2].map(|()| rng.below(17) as f32 - 8.0);
        point + i * axes[0] + j * axes[1]
    })
}

/// Draws a ray from an integer point through another one whose distance is not a float.
fn towards(rng: &mut Rng, from: Vec3, to: Vec3) -> Ray {
    ray(from, [3.0, 5.0, 7.0][rng.below(3) as usize] * (to - from), WHOLE)
}

fn shuffle<T>(rng: &mut Rng, list: &mut [T]) {
    for last in (1..list.len()).rev() {
        list.swap(last, rng.below(last as u64 + 1) as usize);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ask, Level, Query};

    /// In each case, ordering by rounded distance and index gives a wrong hit from either end, or the exact distances
    /// are equal.
    #[test]
    fn each_case_tells_orders_apart() {
        let mut author = Author::new(Level::Ray, "exact");
        cases(&mut author);
        let mut total = [0; 3];
        for case in &author.0.cases {
            let Ok(Ask::Ray(rays)) = Ask::of(&case.input) else { panic!("{}", case.id) };
            if rays.query != Query::Closest {
                continue;
            }
            let (vertices, origins) = rays.numbers().unwrap();
            let turned = Mesh { vertices: vertices.clone(), triangles: rays.triangles.iter().rev().copied().collect() };
            let mesh = Mesh { vertices, triangles: rays.triangles };
            let mut told = [0; 3];
            for ray in &origins {
                let (hits, turned) = (mesh.hits(ray), turned.hits(ray));
                let Some(first) = hits.first() else { continue };
                let alike: Vec<_> = hits.iter().filter(|hit| hit.t == first.t).map(|hit| hit.prim).collect();
                let [lowest, highest] = [alike.iter().min(), alike.iter().max()].map(|prim| *prim.unwrap());
                let last = mesh.triangles.len() as u32 - 1;
                let is_told = [lowest != first.prim, highest != first.prim, last - turned[0].prim != first.prim];
                for (count, is_told) in told.iter_mut().zip(is_told) {
                    *count += u32::from(is_told);
                }
            }
            assert!(told.iter().sum::<u32>() >= 2, "{}: {told:?}", case.id);
            total = [0, 1, 2].map(|i| total[i] + told[i]);
        }
        assert!(total.iter().all(|&count| count >= 50), "{total:?}");
    }
}
