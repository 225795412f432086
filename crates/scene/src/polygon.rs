//! Polygons as triangles.
//!
//! A polygon comes as a fan from its first corner, which is right where all triangles turn the same way. Others are
//! triangulated by `earcut` as they are seen along the longest axis of their normal, where each coordinate stays what it
//! is. So triangles have no other corners than the polygon's, and do not leave its plane.

use earcut::Earcut;
use glam::{DVec2, DVec3};

use super::float::Position;
use super::note::{NoteKind, Notes};

/// Most corners of a polygon that is triangulated: time grows by their square.
const MOST_CORNERS: usize = 1 << 14;

/// Cuts the polygons among the faces that are not right as fans. A polygon of n corners stays n - 2 triangles.
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

/// Memory that polygons share.
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
    /// Cuts a polygon that comes as a fan. `false` if that cannot be done.
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
        // In a polygon that does not cross itself every triangle turns as it does, but for rounding.
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

    /// Looks at the corners along the longest axis of the normal, from beside and at a size around 1. Returns how the
    /// polygon turns: 0 if as much one way as the other. `None` if all corners lie on a line.
    fn flatten<V: Position>(&mut self, vertices: &[V]) -> Option<f64> {
        let at = |corner: &u32| vertices[*corner as usize].widen();
        let largest = self.corners.iter().map(|corner| at(corner).abs().max_element()).fold(0.0, f64::max);
        // A power of two, so that nothing is rounded.
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

    /// Takes the triangles that were found, and corners that were left out since they lie on a side of one.
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
            // In the order of the polygon.
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

/// Twice the area of a triangle, negative if it turns right.
fn turn([a, b, c]: [DVec2; 3]) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Twice the area of a polygon, negative if it turns right.
fn turn_of(points: &[DVec2]) -> f64 {
    points.windows(2).map(|pair| turn([points[0], pair[0], pair[1]])).sum()
}

#[cfg(test)]
mod tests;
