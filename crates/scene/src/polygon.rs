//! Triangulation of polygons.
//!
//! A polygon is first a fan from its first corner. The fan is correct if all its triangles have the same orientation.
//! Other polygons are projected along the longest axis of their normal, which keeps the other two coordinates, and
//! triangulated by `earcut`. So triangles have only corners of the polygon and stay in its plane.

use earcut::Earcut;
use glam::{DVec2, DVec3};

use super::float::Position;
use super::note::{NoteKind, Notes};

/// The maximum number of corners for triangulation, whose time is quadratic.
const MOST_CORNERS: usize = 1 << 14;

/// Triangulates the polygons whose fans are incorrect. A polygon of n corners has n - 2 triangles.
pub(crate) fn cut<V: Position>(vertices: &[V], triangles: &mut [[u32; 3]], faces: &[u32], notes: &mut Notes) {
    let mut cutter = Cutter::default();
    let mut rest = triangles;
    for face in faces.chunk_by(|a, b| a == b) {
        let (fan, behind) = std::mem::take(&mut rest).split_at_mut(face.len());
        rest = behind;
        if fan.len() > 1 && !cutter.cut(vertices, fan) {
            notes.add(NoteKind::Crossing, 1, || format!("at face {}", face[0]));
        }
    }
}

/// Buffers shared by all polygons.
#[derive(Default)]
struct Cutter {
    earcut: Earcut<f64>,
    corners: Vec<u32>,
    flat: Vec<DVec2>,
    found: Vec<u32>,
    is_used: Vec<bool>,
    ring: Vec<usize>,
    cut: Vec<[usize; 3]>,
}

impl Cutter {
    /// Triangulates a polygon given as a fan. Returns `false` if that is impossible.
    fn cut<V: Position>(&mut self, vertices: &[V], fan: &mut [[u32; 3]]) -> bool {
        self.corners.clear();
        self.corners.extend(fan[0].iter().chain(fan[1..].iter().map(|triangle| &triangle[2])));
        let Some(sign) = self.flatten(vertices) else { return true };
        let turns = |triangle: [usize; 3]| sign * turn(triangle.map(|corner| self.flat[corner]));
        if sign != 0.0 && (1..=fan.len()).all(|i| turns([0, i, i + 1]) >= 0.0) {
            return true;
        }
        if sign == 0.0 || self.corners.len() > MOST_CORNERS {
            return false;
        }
        self.earcut.earcut(self.flat.iter().map(DVec2::to_array), &[], &mut self.found);
        self.collect();
        // Except for rounding, every triangle of a simple polygon has the orientation of the polygon.
        let (whole, mut wrong) = (sign * turn_of(&self.flat), 0.0);
        for &triangle in &self.cut {
            wrong += (-sign * turn(triangle.map(|corner| self.flat[corner]))).max(0.0);
        }
        let is_right = self.cut.len() == fan.len() && wrong <= 1e-12 * whole;
        if is_right {
            fan.iter_mut().zip(&self.cut).for_each(|(to, from)| *to = from.map(|corner| self.corners[corner]));
        }
        is_right
    }

    /// Projects the corners along the longest axis of the normal, and scales them to a size around 1. Returns the
    /// orientation of the polygon: 0 if both orientations are equal. `None` if all corners lie on a line.
    fn flatten<V: Position>(&mut self, vertices: &[V]) -> Option<f64> {
        let at = |corner: &u32| vertices[*corner as usize].widen();
        let largest = self.corners.iter().map(|corner| at(corner).abs().max_element()).fold(0.0, f64::max);
        // A power of two, so scaling does not round.
        let unit = f64::from_bits(largest.to_bits() & 0x7ff0_0000_0000_0000).max(f64::MIN_POSITIVE);
        let points = || self.corners.iter().map(|corner| at(corner) / unit);
        let origin = points().next()?;
        let (mut normal, mut extent) = (DVec3::ZERO, DVec3::ZERO);
        for (a, b) in points().zip(points().skip(1)) {
            let cross = (a - origin).cross(b - origin);
            normal += cross;
            extent += cross.abs();
        }
        if extent == DVec3::ZERO {
            return None;
        }
        let axis = if normal == DVec3::ZERO { extent.max_position() } else { normal.abs().max_position() };
        self.flat.clear();
        self.flat.extend(points().map(|point| DVec2::new(point[(axis + 1) % 3], point[(axis + 2) % 3])));
        Some(if normal[axis] == 0.0 { 0.0 } else { normal[axis].signum() })
    }

    /// Collects the triangles, and adds omitted corners that lie on a side of one.
    fn collect(&mut self) {
        let Self { corners, found, is_used, ring, cut, .. } = self;
        is_used.clear();
        is_used.resize(corners.len(), false);
        for &corner in &*found {
            is_used[corner as usize] = true;
        }
        cut.clear();
        for triangle in found.chunks_exact(3) {
            let mut triangle = [0, 1, 2].map(|i| triangle[i] as usize);
            // The order of corners in the polygon.
            triangle.sort_unstable();
            let [a, b, c] = triangle;
            ring.clear();
            for (from, to) in [(a, b), (b, c), (c, a + corners.len())] {
                ring.push(from);
                let between = (from + 1..to).map(|corner| corner % corners.len());
                let count = between.clone().take_while(|&corner| !is_used[corner]).count();
                if from + 1 + count == to {
                    ring.extend(between);
                }
            }
            cut.extend((2..ring.len()).map(|i| [ring[0], ring[i - 1], ring[i]]));
        }
    }
}

/// Returns twice the area of a triangle, negative if it is clockwise.
fn turn([a, b, c]: [DVec2; 3]) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Returns twice the area of a polygon, negative if it is clockwise.
fn turn_of(points: &[DVec2]) -> f64 {
    points.windows(2).map(|pair| turn([points[0], pair[0], pair[1]])).sum()
}

#[cfg(test)]
mod tests;
