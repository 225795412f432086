//! The meshes in `examples/data`. This test generates them, so there is no question of licences.
//!
//! `UPDATE=1 cargo test --test project data` writes them.

use std::collections::HashSet;
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;

use crate::files::root;

/// Points, and faces of any number of corners.
#[derive(Default)]
struct Shape {
    points: Vec<[f32; 3]>,
    faces: Vec<Vec<u32>>,
}

/// With `UPDATE=1` in the environment, writes the meshes.
#[test]
fn the_example_meshes_are_what_is_made_here() {
    let made = [
        ("torus.ply", torus().to_ascii_ply()),
        ("room.obj", room().to_obj()),
        ("slivers.ply", slivers().to_binary_ply()),
        ("part.stl", part().to_binary_stl()),
    ];
    for (name, bytes) in made {
        let path = root().join("examples/data").join(name);
        if std::env::var_os("UPDATE").is_some() {
            fs::write(&path, &bytes).expect(name);
        }
        assert!(bytes.len() < 100_000, "{name}: {} bytes", bytes.len());
        assert!(fs::read(&path).is_ok_and(|found| found == bytes), "{name} differs from the generated file");
    }
}

#[test]
fn torus_and_part_are_closed_and_are_not_without_a_triangle() {
    for mut shape in [torus(), part()] {
        assert!(shape.is_closed());
        shape.faces.pop();
        assert!(!shape.is_closed());
    }
}

#[test]
fn the_slivers_are_slivers() {
    let shape = slivers();
    let length = |a: u32, b: u32| {
        let [a, b] = [a, b].map(|i| shape.points[i as usize].map(f64::from));
        a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    };
    for face in &shape.faces {
        let edges = [length(face[0], face[1]), length(face[1], face[2]), length(face[2], face[0])];
        let [least, most] = [edges.iter().copied().fold(f64::MAX, f64::min), edges.iter().copied().fold(0.0, f64::max)];
        assert!(most > 100.0 * least, "{edges:?}");
    }
}

/// A torus: 48 segments around, 24 across.
fn torus() -> Shape {
    let (around, across) = (48, 24);
    let mut shape = Shape::default();
    for i in 0..around {
        for j in 0..across {
            let [a, b] = [TAU * f64::from(i) / f64::from(around), TAU * f64::from(j) / f64::from(across)];
            let radius = 1.0 + 0.4 * b.cos();
            shape.points.push([radius * a.cos(), 0.4 * b.sin(), radius * a.sin()].map(rounded));
            let at = |i: i32, j: i32| (i % around * across + j % across) as u32;
            let [p, q, r, s] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            shape.faces.extend([vec![p, q, r], vec![p, r, s]]);
        }
    }
    shape
}

/// A room of 6 by 3 by 4 with a doorway in its right wall: pillars, stairs, a table, shelves with books.
fn room() -> Shape {
    let mut shape = Shape::default();
    let floor_to_wall = [([-0.2, -0.2, -0.2], [6.2, 0.0, 4.2]), ([-0.2, 3.0, -0.2], [6.2, 3.2, 4.2])];
    let walls = [
        ([-0.2, 0.0, -0.2], [6.2, 3.0, 0.0]),
        ([-0.2, 0.0, 4.0], [6.2, 3.0, 4.2]),
        ([-0.2, 0.0, 0.0], [0.0, 3.0, 4.0]),
    ];
    let doorway =
        [([6.0, 0.0, 0.0], [6.2, 3.0, 2.6]), ([6.0, 0.0, 3.5], [6.2, 3.0, 4.0]), ([6.0, 2.1, 2.6], [6.2, 3.0, 3.5])];
    for (lo, hi) in floor_to_wall.into_iter().chain(walls).chain(doorway) {
        shape.add_box(lo, hi);
    }
    for pillar in 0..4 {
        let [x, z] = [1.5 + f64::from(pillar % 2) * 3.0, 0.8 + f64::from(pillar / 2) * 2.2];
        shape.add_box([x - 0.22, 0.0, z - 0.22], [x + 0.22, 0.15, z + 0.22]);
        shape.add_prism([x, z], 0.16, [0.15, 2.85], 16);
        shape.add_box([x - 0.22, 2.85, z - 0.22], [x + 0.22, 3.0, z + 0.22]);
    }
    for step in 0..8 {
        let [x, y] = [5.9 - 0.25 * f64::from(step), 0.2 * f64::from(8 - step)];
        shape.add_box([x - 0.25, 0.0, 0.1], [x, y, 1.0]);
    }
    shape.add_box([2.2, 0.7, 1.5], [3.8, 0.76, 2.4]);
    for leg in 0..4 {
        shape.add_prism([2.3 + f64::from(leg % 2) * 1.4, 1.6 + f64::from(leg / 2) * 0.7], 0.04, [0.0, 0.7], 8);
    }
    for shelf in 0..5 {
        let y = 0.3 + 0.5 * f64::from(shelf);
        shape.add_box([0.0, y, 1.2], [0.35, y + 0.03, 2.8]);
        for book in 0..20 {
            let (z, height) = (1.22 + 0.078 * f64::from(book), 0.25 + 0.02 * f64::from((book * 7 + shelf * 5) % 9));
            shape.add_box([0.02, y + 0.03, z], [0.24, y + 0.03 + height, z + 0.07]);
        }
    }
    shape
}

/// A fan of needles that lean on a ring. Each triangle is more than a hundred times as long as wide.
fn slivers() -> Shape {
    let mut shape = Shape::default();
    for needle in 0..1200_u32 {
        let angle = TAU * f64::from(needle) / 1200.0;
        let lean = 0.9 * (7.0 * angle).sin();
        let [x, z] = [angle.cos(), angle.sin()];
        let [across, along] = [0.004, 0.3 + 0.2 * (5.0 * angle).cos()];
        let begin = shape.points.len() as u32;
        shape.points.push([x, -1.0, z].map(rounded));
        shape.points.push([x - across * z, -1.0, z + across * x].map(rounded));
        shape.points.push([along * (angle + lean).cos(), 1.0, along * (angle + lean).sin()].map(rounded));
        shape.faces.push(vec![begin, begin + 1, begin + 2]);
    }
    shape
}

/// A plate of 6 by 4 by 1, with an octagonal hole in the middle.
fn part() -> Shape {
    let mut shape = Shape::default();
    let outline =
        [[3.0, 0.0], [3.0, 2.0], [0.0, 2.0], [-3.0, 2.0], [-3.0, 0.0], [-3.0, -2.0], [0.0, -2.0], [3.0, -2.0]];
    let hole = (0..8).map(|i| f64::from(i) * TAU / 8.0).map(|angle| [angle.cos(), angle.sin()]);
    let rings = [outline.to_vec(), hole.collect()];
    for (z, ring) in [0.0, 1.0].iter().flat_map(|z| rings.iter().map(move |ring| (*z, ring))) {
        shape.points.extend(ring.iter().map(|&[x, y]| [x, y, z].map(rounded)));
    }
    // Strips between pairs of rings: below outside, below inside, above inside, above outside.
    for [from, to] in [[1, 0], [0, 2], [2, 3], [3, 1]] {
        for (i, j) in (0..8).map(|i| (i, (i + 1) % 8)) {
            let [a, b, c, d] = [8 * from + i, 8 * from + j, 8 * to + j, 8 * to + i];
            shape.faces.extend([vec![a, b, c], vec![a, c, d]]);
        }
    }
    shape
}

/// Rounds to five digits, so that sines of all machines give equal files.
fn rounded(x: f64) -> f32 {
    ((x * 1e5).round() / 1e5 + 0.0) as f32
}

impl Shape {
    /// A closed box.
    fn add_box(&mut self, lo: [f64; 3], hi: [f64; 3]) {
        let corners = [[lo[0], lo[2]], [lo[0], hi[2]], [hi[0], hi[2]], [hi[0], lo[2]]];
        self.add_column(&corners, [lo[1], hi[1]]);
    }

    /// A closed column over a regular polygon.
    fn add_prism(&mut self, [x, z]: [f64; 2], radius: f64, heights: [f64; 2], sides: u32) {
        let corner = |i: u32| -TAU * f64::from(i) / f64::from(sides);
        let corners: Vec<_> =
            (0..sides).map(|i| [x + radius * corner(i).cos(), z + radius * corner(i).sin()]).collect();
        self.add_column(&corners, heights);
    }

    fn add_column(&mut self, corners: &[[f64; 2]], heights: [f64; 2]) {
        let (begin, n) = (self.points.len() as u32, corners.len() as u32);
        for y in heights {
            self.points.extend(corners.iter().map(|&[x, z]| [x, y, z].map(rounded)));
        }
        self.faces.push((begin..begin + n).rev().collect());
        self.faces.push((begin + n..begin + 2 * n).collect());
        let side = |i: u32| vec![begin + i, begin + (i + 1) % n, begin + n + (i + 1) % n, begin + n + i];
        self.faces.extend((0..n).map(side));
    }

    /// Whether each edge has a triangle on either side.
    fn is_closed(&self) -> bool {
        let edges = self.faces.iter().flat_map(|face| (0..face.len()).map(|i| (face[i], face[(i + 1) % face.len()])));
        let edges: Vec<_> = edges.collect();
        let set: HashSet<_> = edges.iter().copied().collect();
        set.len() == edges.len() && edges.iter().all(|&(a, b)| set.contains(&(b, a)))
    }

    fn header(&self, format: &str) -> String {
        let (points, faces) = (self.points.len(), self.faces.len());
        format!(
            "ply\nformat {format} 1.0\ncomment made by tests/project/data.rs\nelement vertex {points}\n\
            property float x\nproperty float y\nproperty float z\nelement face {faces}\n\
            property list uchar uint vertex_indices\nend_header\n"
        )
    }

    fn to_ascii_ply(&self) -> Vec<u8> {
        let mut text = self.header("ascii");
        for [x, y, z] in &self.points {
            writeln!(text, "{x} {y} {z}").expect("a string");
        }
        for face in &self.faces {
            let corners: Vec<_> = face.iter().map(u32::to_string).collect();
            writeln!(text, "{} {}", face.len(), corners.join(" ")).expect("a string");
        }
        text.into_bytes()
    }

    fn to_binary_ply(&self) -> Vec<u8> {
        let mut bytes = self.header("binary_little_endian").into_bytes();
        bytes.extend(self.points.iter().flatten().flat_map(|x| x.to_le_bytes()));
        for face in &self.faces {
            bytes.push(face.len() as u8);
            bytes.extend(face.iter().flat_map(|i| i.to_le_bytes()));
        }
        bytes
    }

    /// Normals are zeros.
    fn to_binary_stl(&self) -> Vec<u8> {
        let mut bytes = vec![0; 80];
        bytes.extend((self.faces.len() as u32).to_le_bytes());
        for face in &self.faces {
            let corners = face.iter().flat_map(|&i| self.points[i as usize]);
            bytes.extend([0.0; 3].into_iter().chain(corners).flat_map(f32::to_le_bytes));
            bytes.extend([0; 2]);
        }
        bytes
    }

    fn to_obj(&self) -> Vec<u8> {
        let mut text = String::from("# made by tests/project/data.rs\n");
        for [x, y, z] in &self.points {
            writeln!(text, "v {x} {y} {z}").expect("a string");
        }
        for face in &self.faces {
            let corners: Vec<_> = face.iter().map(|i| (i + 1).to_string()).collect();
            writeln!(text, "f {}", corners.join(" ")).expect("a string");
        }
        text.into_bytes()
    }
}
