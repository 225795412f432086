//! Solid angles of a border, with few steps for distant parts.
//!
//! # Idea
//!
//! A border consists of loops. Let a loop be in a ball around c. The triangles from c to its edges are a surface in
//! that ball with the same border. If the ray from q along e misses the ball, the loop's fan from -e is the solid angle
//! of this surface: the integral of (x - q)·dA / |x - q|³. At a distance, its Taylor polynomial of second degree around
//! c suffices. The coefficients are the surface's area vector ∫ dA and its moments ∫ x dA and ∫ x x dA (Barill et al.
//! 2018, "Fast winding numbers for soups and clouds", use them for all triangles of a mesh). The chord of a path, from
//! its end to its start, makes it a loop; the fan of the chord is subtracted again.
//!
//! # Error
//!
//! The k-th derivative of 1/|v| in directions of length 1 is at most k! / |v|^(k+1), because Legendre polynomials are
//! at most 1. Let d be the distance of c, r the radius of the ball and s = r / d < 1. The omitted terms, of degree k >=
//! 3, add up to at most ∫ |dA| Σ (k + 1) |x|^k / d^(k+2) <= ∫ |x|² |dA| / d^4 · s (4 - 3s) / (1 - s)². A node is
//! replaced by its polynomial if this bound is within its part of the remaining tolerance. `[WINDING-3]`
//!
//! # Cost
//!
//! The moments of a node are sums over its edges, so the tree of n edges takes O(n log n).

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::ops::{Range, RangeInclusive};

use glam::{DMat3, DVec3};

use super::Border;

type Edge = [DVec3; 2];

/// A hierarchy over the edges of a border: its loops, and the paths of each loop.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::trace) struct BorderTree {
    /// Consecutive within each loop.
    edges: Vec<Edge>,
    /// The first child follows its parent; the root comes first.
    nodes: Vec<Node>,
}

/// A set of loops, or a path.
#[derive(Clone, Debug, Default, PartialEq)]
struct Node {
    edges: Range<usize>,
    /// The second child; `None` in a leaf.
    second: Option<usize>,
    /// The edge from the end of a path to its start.
    chord: Option<Edge>,
    center: DVec3,
    radius: f64,
    /// Integrals over the triangles from the center to edges and chord: dA, x dA, x x dA, |x|² dA, |dA| and |x|² |dA|.
    area: DVec3,
    square: DMat3,
    cube: Cubic,
    trace: DVec3,
    surface: f64,
    spread: f64,
}

/// A homogeneous polynomial of third degree: the coefficients of xxx, yyy, zzz, xxy, xxz, yyx, yyz, zzx, zzy and xyz.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Cubic([f64; 10]);

/// Most edges of a leaf.
const LEAF: usize = 4;

/// The part of the remaining tolerance that any node may use. A node with more than this part of the remaining edges
/// may use that part.
const LARGEST: f64 = 1.0 / 64.0;

/// Distances whose fourth powers neither over- nor underflow.
const USUAL: RangeInclusive<f64> = 1e-60..=1e60;

impl BorderTree {
    /// Builds the hierarchy of a border.
    pub(super) fn new(borders: &[Border], at: impl Fn(u32) -> DVec3) -> Self {
        let mut tree = Self { edges: Vec::new(), nodes: Vec::new() };
        let mut loops: Vec<Vec<Edge>> =
            loops(borders).into_iter().map(|ends| ends.into_iter().map(|ends| ends.map(&at)).collect()).collect();
        if !loops.is_empty() {
            tree.add_loops(&mut loops);
        }
        tree
    }

    /// Returns the fan of the border from the opposite of `e`, of length 1, except for the edges passed to `show`. The
    /// result is a part of all directions, with an error of at most `tolerance`.
    pub(in crate::trace) fn fan(&self, point: DVec3, e: DVec3, tolerance: f64, mut show: impl FnMut(Edge)) -> f64 {
        let (mut sum, mut open) = (0.0, Vec::new());
        open.extend((!self.nodes.is_empty()).then_some(0));
        let (mut tolerance, mut count) = (tolerance, self.edges.len() as f64);
        while let Some(at) = open.pop() {
            let node = &self.nodes[at];
            let edges = node.edges.len() as f64;
            let part = node.seen_from(point, e, tolerance * (edges / count).max(LARGEST));
            if part.is_some() || node.second.is_none() {
                count -= edges;
            }
            match (part, node.second) {
                (Some([part, off]), _) => {
                    sum += part;
                    tolerance -= off;
                    // The path is the loop plus its reversed chord.
                    node.chord.iter().for_each(|&[end, start]| show([start, end]));
                }
                (None, Some(second)) => open.extend([second, at + 1]),
                (None, None) => self.edges[node.edges.clone()].iter().for_each(|&edge| show(edge)),
            }
        }
        sum
    }

    fn add_loops(&mut self, loops: &mut [Vec<Edge>]) {
        if let [path] = loops {
            return self.add_path(path);
        }
        let [lo, hi] = bounds(loops.iter().map(|path| path[0][0]));
        let (axis, half) = ((hi - lo).max_position(), loops.len() / 2);
        loops.select_nth_unstable_by(half, |a, b| a[0][0][axis].total_cmp(&b[0][0][axis]));
        let (first, second) = loops.split_at_mut(half);
        let at = self.begin();
        self.add_loops(first);
        self.nodes[at].second = Some(self.nodes.len());
        self.add_loops(second);
        self.finish(at, None);
    }

    fn add_path(&mut self, path: &[Edge]) {
        let at = self.begin();
        if path.len() > LEAF {
            let (first, second) = path.split_at(path.len() / 2);
            self.add_path(first);
            self.nodes[at].second = Some(self.nodes.len());
            self.add_path(second);
        } else {
            self.edges.extend(path);
        }
        let ([start, _], [_, end]) = (path[0], path[path.len() - 1]);
        self.finish(at, (start != end).then_some([end, start]));
    }

    fn begin(&mut self) -> usize {
        self.nodes.push(Node { edges: self.edges.len()..self.edges.len(), ..Node::default() });
        self.nodes.len() - 1
    }

    fn finish(&mut self, at: usize, chord: Option<Edge>) {
        let Node { edges: Range { start, .. }, second, .. } = self.nodes[at];
        let edges = &self.edges[start..];
        self.nodes[at] = Node { edges: start..self.edges.len(), second, ..Node::of(edges, chord) };
    }
}

impl Node {
    /// Computes all fields except `edges` and `second`.
    fn of(edges: &[Edge], chord: Option<Edge>) -> Self {
        let [lo, hi] = bounds(edges.iter().flatten().copied());
        let center = lo.midpoint(hi);
        let mut node = Self { chord, center, square: DMat3::ZERO, ..Self::default() };
        for ends in edges.iter().chain(&chord) {
            let [a, b] = ends.map(|end| end - center);
            let area = a.cross(b) * 0.5;
            let (size, middle) = (area.length(), (a + b) / 3.0);
            node.radius = node.radius.max(a.length()).max(b.length());
            node.area += area;
            node.square += DMat3::from_cols(middle * area.x, middle * area.y, middle * area.z);
            for x in [a, b, a + b] {
                node.cube.add(x, area / 12.0);
            }
            let spread = (a.length_squared() + a.dot(b) + b.length_squared()) / 6.0;
            node.trace += area * spread;
            node.surface += size;
            node.spread += size * spread;
        }
        node.radius *= 1.0 + 1e-9;
        node
    }

    /// Returns the part of all directions and the bound of its error, if this is at most `allowed` and the ray misses
    /// the ball.
    fn seen_from(&self, point: DVec3, e: DVec3, allowed: f64) -> Option<[f64; 2]> {
        let way = self.center - point;
        let square = way.length_squared();
        // Most nodes are this close.
        if square < 2.0 * self.radius * self.radius {
            return None;
        }
        let distance = square.sqrt();
        let beside = (way - e * way.dot(e).max(0.0)).length();
        let size = self.radius / distance;
        let left_out = self.spread / square * size * (4.0 - 3.0 * size) / (1.0 - size).powi(2);
        let rounded = (self.edges.len() as f64 + 64.0) * 16.0 * f64::EPSILON * self.surface;
        let off = (left_out + rounded) / square / (4.0 * PI);
        // False for a NaN.
        let is_fit = USUAL.contains(&distance) && beside > self.radius + distance * 1e-12;
        if !(is_fit && off <= allowed) {
            return None;
        }
        let e = way / distance;
        let terms = [e.dot(self.area), -3.0 * e.dot(self.square * e), 7.5 * self.cube.at(e) - 1.5 * e.dot(self.trace)];
        Some([((terms[2] / distance + terms[1]) / distance + terms[0]) / square / (4.0 * PI), off])
    }
}

impl Cubic {
    /// Adds (x·e)² (y·e) as a polynomial in e.
    fn add(&mut self, x: DVec3, y: DVec3) {
        let (xx, xy) = (x * x, 2.0 * x.x * x.y);
        let (xz, yz) = (2.0 * x.x * x.z, 2.0 * x.y * x.z);
        let terms = [
            xx.x * y.x,
            xx.y * y.y,
            xx.z * y.z,
            xx.x * y.y + xy * y.x,
            xx.x * y.z + xz * y.x,
            xx.y * y.x + xy * y.y,
            xx.y * y.z + yz * y.y,
            xx.z * y.x + xz * y.z,
            xx.z * y.y + yz * y.z,
            xy * y.z + xz * y.y + yz * y.x,
        ];
        self.0.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
    }

    fn at(&self, DVec3 { x, y, z }: DVec3) -> f64 {
        let [xxx, yyy, zzz, xxy, xxz, yyx, yyz, zzx, zzy, xyz] = self.0;
        let of_squares = x * x * (xxx * x + xxy * y + xxz * z) + y * y * (yyy * y + yyx * x + yyz * z);
        of_squares + z * z * (zzz * z + zzx * x + zzy * y) + xyz * x * y * z
    }
}

fn bounds(points: impl Iterator<Item = DVec3>) -> [DVec3; 2] {
    points.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[lo, hi], p| [lo.min(p), hi.max(p)])
}

/// Decomposes a border into loops, in which no vertex occurs twice. Equal numbers of edges begin and end at each
/// vertex: this holds for the edges of one face, and edges of opposite directions cancel in pairs.
fn loops(borders: &[Border]) -> Vec<Vec<[u32; 2]>> {
    let mut ways: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for &Border { ends: [from, to], faces } in borders {
        ways.entry(from).or_default().extend((0..faces).map(|_| to));
    }
    let mut loops = Vec::new();
    while let Some((&start, _)) = ways.first_key_value() {
        // The index of the path's edge at each of its vertices.
        let (mut path, mut places, mut from) = (Vec::new(), BTreeMap::from([(start, 0)]), start);
        while let Some(to) = ways.get_mut(&from).and_then(Vec::pop) {
            path.push([from, to]);
            if let Some(&place) = places.get(&to) {
                let closed = path.split_off(place);
                closed.iter().skip(1).for_each(|[from, _]| _ = places.remove(from));
                loops.push(closed);
            } else {
                places.insert(to, path.len());
            }
            from = to;
        }
        debug_assert!(path.is_empty(), "a path from {start} has an end");
        ways.remove(&start);
    }
    loops
}

#[cfg(test)]
mod tests;
