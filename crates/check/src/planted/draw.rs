//! Inputs that show mistakes: small and large whole numbers, points that are met exactly, and what is a float or less
//! beside.

use glam::Vec3;

use stackless_bvh::generate::{Family, Source, shape};
use stackless_bvh::geom::{Mesh, Ray};
use stackless_bvh::tree::Tree;

/// Draws from any source; 0 is the simplest choice.
pub(super) struct Draw<'a>(pub(super) &'a mut dyn Source);

impl Source for Draw<'_> {
    fn below(&mut self, bound: u64) -> u64 {
        self.0.below(bound)
    }
}

/// What is lost beside 1 in single or in double precision, or nearly so.
const TINY: [f32; 6] = [f32::EPSILON / 2.0, -f32::EPSILON / 2.0, f32::EPSILON, 1e-20, -1e-20, -1e-40];

/// Sizes that make directions so large or small that reciprocals and products leave the range of single precision.
const EXTREME: [f32; 4] = [f32::from_bits(1), 1e-38, 1e30, f32::MAX];

impl Draw<'_> {
    /// One of these (at least one).
    pub(super) fn one_of<T: Copy, const N: usize>(&mut self, choices: [T; N]) -> T {
        choices[self.below(N as u64) as usize]
    }

    /// A whole number of up to so many bits, of either sign, zero included.
    fn int(&mut self, bits: u32) -> f32 {
        let drawn = self.below(2 << bits);
        let size = (drawn >> 1) as f32;
        if drawn & 1 == 1 { -size } else { size }
    }

    /// A power of two that is not far from 1.
    pub(super) fn power(&mut self) -> f32 {
        let exponent = self.below(9) as u32;
        f32::from_bits((127 + exponent - 4) << 23)
    }

    pub(super) fn ints(&mut self, bits: u32) -> Vec3 {
        Vec3::new(self.int(bits), self.int(bits), self.int(bits))
    }

    /// How large numbers are, in bits. Products of three of the last are beyond double precision.
    pub(super) fn bits(&mut self) -> u32 {
        self.one_of([2, 3, 2, 11, 20])
    }

    /// A ray through a point, exactly, but for what is added now and then.
    pub(super) fn ray(&mut self, bits: u32, target: Vec3) -> Option<Ray> {
        let (mut d, k) = (self.ints(bits), self.below(4) as f32);
        let mut o = target - d * k;
        for axis in 0..3 {
            match self.below(8) {
                1 => o[axis] += self.one_of(TINY),
                2 if self.coin() => o[axis] = o[axis].next_up(),
                3 if self.coin() => d[axis] = d[axis].next_up(),
                _ => {}
            }
        }
        if self.below(16) == 1 {
            d *= self.one_of(EXTREME);
        }
        let [tmin, tmax] = self.one_of([[0.0, f32::INFINITY], [0.0, k], [k, f32::INFINITY], [k, k]]);
        Ray::within(o, d, tmin, tmax).ok()
    }

    /// A corner of a triangle, the middle of an edge, a point within, or any.
    pub(super) fn target(&mut self, bits: u32, [a, b, c]: [Vec3; 3]) -> Vec3 {
        match self.below(5) {
            0 => a * 0.5 + b * 0.25 + c * 0.25,
            1 => a,
            2 => b * 0.5 + c * 0.5,
            3 => self.one_of([a * 0.5 + b * 0.5, a * 0.5 + c * 0.5]),
            _ => self.ints(bits),
        }
    }

    /// A mesh of a few triangles that share vertices, some of them degenerate, and rays at it.
    pub(super) fn scene(&mut self) -> Option<(Mesh, Vec<Ray>)> {
        let bits = self.one_of([2, 1, 11]);
        let (count, vertices) = (1 + self.below(8), 3 + self.below(8));
        let triangles = (0..count).map(|_| [(); 3].map(|()| self.below(vertices) as u32)).collect();
        let vertices = (0..vertices).map(|_| self.ints(bits)).collect();
        let mesh = Mesh::new(vertices, triangles).ok()?;
        let ray = |draw: &mut Self| {
            let corners = mesh.triangle(draw.below(count) as usize);
            let target = draw.target(bits, corners);
            draw.ray(bits, target)
        };
        let rays = (0..4).filter_map(|_| ray(self)).collect();
        Some((mesh, rays))
    }

    /// A chain to the right, so that keys are as large as can be, with a few more leaves beside it.
    pub(super) fn leaning_right(&mut self, depth: u32) -> Tree {
        let inner = |i: u32| Some([2 * i + 1, 2 * i + 2]);
        let mut children: Vec<_> = (0..depth).flat_map(|i| [inner(i), None]).chain([None]).collect();
        for i in 0..depth as usize {
            if self.below(4) == 1 {
                let next = children.len() as u32;
                children[2 * i + 1] = Some([next, next + 1]);
                children.extend([None, None]);
            }
        }
        // A child comes after its parent: a generated tree.
        Tree::from_generated(&children)
    }

    /// A tree of any shape, or one that is deep, mostly a chain to the right but for one turn, so that keys are large.
    pub(super) fn tree(&mut self, deepest: u32) -> Tree {
        match self.below(4) {
            0 => {
                let leaves = 1 + self.below(24) as u32;
                Tree::from_generated(&shape(self, leaves))
            }
            1 => {
                let (family, leaves) = (self.one_of(Family::ALL), 1 + self.below(64) as u32);
                family.tree(self, leaves.min(deepest + 1))
            }
            kind => {
                let depth = if kind == 2 { deepest } else { 1 + self.below(deepest.into()) as u32 };
                let turn = self.below(u64::from(depth) + 1) as u32;
                let inner = |i: u32| if i == turn { [2 * i + 2, 2 * i + 1] } else { [2 * i + 1, 2 * i + 2] };
                let children: Vec<_> = (0..depth).flat_map(|i| [Some(inner(i)), None]).chain([None]).collect();
                Tree::from_generated(&children)
            }
        }
    }
}
