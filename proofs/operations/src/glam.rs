//! The operations of glam's vectors that the kernels use, written out: their meaning for the reader. This file is read
//! like the library's. It is also compiled, and compared with glam on numbers, bit by bit.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Sub};

pub(crate) use double::Vector as DVec3;
pub(crate) use single::Vector as Vec3;

mod single {
    type Number = f32;

    include!("glam/vector.rs");
}

mod double {
    type Number = f64;

    include!("glam/vector.rs");
}

#[derive(Clone, Copy)]
pub(crate) struct Vec4 {
    pub(crate) x: f32,
    pub(crate) y: f32,
    pub(crate) z: f32,
    pub(crate) w: f32,
}

#[derive(Clone, Copy)]
pub(crate) struct BVec3 {
    pub(crate) x: bool,
    pub(crate) y: bool,
    pub(crate) z: bool,
}

#[derive(Clone, Copy)]
#[expect(clippy::struct_excessive_bools, reason = "one for each lane")]
pub(crate) struct BVec4 {
    x: bool,
    y: bool,
    z: bool,
    w: bool,
}

impl DVec3 {
    pub(crate) const NAN: Self = Self { x: f64::NAN, y: f64::NAN, z: f64::NAN };

    pub(crate) fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self::new(f(self.x), f(self.y), f(self.z))
    }

    pub(crate) fn length(self) -> f64 {
        self.dot(self).sqrt()
    }

    pub(crate) fn cmplt(self, rhs: Self) -> BVec3 {
        BVec3 { x: self.x < rhs.x, y: self.y < rhs.y, z: self.z < rhs.z }
    }
}

impl Add<f64> for DVec3 {
    type Output = Self;

    fn add(self, rhs: f64) -> Self {
        Self::new(self.x + rhs, self.y + rhs, self.z + rhs)
    }
}

impl Vec3 {
    pub(crate) const INFINITY: Self = Self { x: f32::INFINITY, y: f32::INFINITY, z: f32::INFINITY };

    pub(crate) fn extend(self, w: f32) -> Vec4 {
        Vec4::new(self.x, self.y, self.z, w)
    }

    pub(crate) fn as_dvec3(self) -> DVec3 {
        DVec3::new(f64::from(self.x), f64::from(self.y), f64::from(self.z))
    }

    pub(crate) fn max(self, rhs: Self) -> Self {
        Self::new(
            if self.x > rhs.x { self.x } else { rhs.x },
            if self.y > rhs.y { self.y } else { rhs.y },
            if self.z > rhs.z { self.z } else { rhs.z },
        )
    }

    pub(crate) fn is_finite_mask(self) -> BVec3 {
        BVec3 { x: self.x.is_finite(), y: self.y.is_finite(), z: self.z.is_finite() }
    }
}

impl Vec4 {
    pub(crate) const ZERO: Self = Self { x: 0.0, y: 0.0, z: 0.0, w: 0.0 };
    pub(crate) const ONE: Self = Self { x: 1.0, y: 1.0, z: 1.0, w: 1.0 };
    pub(crate) const MAX: Self = Self { x: f32::MAX, y: f32::MAX, z: f32::MAX, w: f32::MAX };
    pub(crate) const INFINITY: Self = Self { x: f32::INFINITY, y: f32::INFINITY, z: f32::INFINITY, w: f32::INFINITY };

    pub(crate) const fn new(x: f32, y: f32, z: f32, w: f32) -> Self {
        Self { x, y, z, w }
    }

    pub(crate) const fn splat(v: f32) -> Self {
        Self::new(v, v, v, v)
    }

    pub(crate) fn from_array(a: [f32; 4]) -> Self {
        Self::new(a[0], a[1], a[2], a[3])
    }

    pub(crate) fn to_array(self) -> [f32; 4] {
        [self.x, self.y, self.z, self.w]
    }

    pub(crate) fn xxxx(self) -> Self {
        Self::splat(self.x)
    }

    pub(crate) fn yyyy(self) -> Self {
        Self::splat(self.y)
    }

    pub(crate) fn zzzz(self) -> Self {
        Self::splat(self.z)
    }

    pub(crate) fn yxwz(self) -> Self {
        Self::new(self.y, self.x, self.w, self.z)
    }

    pub(crate) fn abs(self) -> Self {
        Self::new(self.x.abs(), self.y.abs(), self.z.abs(), self.w.abs())
    }

    /// Equals the SSE instruction, which the kernels use.
    pub(crate) fn min(self, rhs: Self) -> Self {
        Self::select(self.cmplt(rhs), self, rhs)
    }

    /// Equals the SSE instruction, which the kernels use.
    pub(crate) fn max(self, rhs: Self) -> Self {
        Self::select(self.cmpgt(rhs), self, rhs)
    }

    pub(crate) fn truncate(self) -> Vec3 {
        Vec3::new(self.x, self.y, self.z)
    }

    pub(crate) fn cmpeq(self, rhs: Self) -> BVec4 {
        BVec4 { x: self.x == rhs.x, y: self.y == rhs.y, z: self.z == rhs.z, w: self.w == rhs.w }
    }

    pub(crate) fn cmplt(self, rhs: Self) -> BVec4 {
        BVec4 { x: self.x < rhs.x, y: self.y < rhs.y, z: self.z < rhs.z, w: self.w < rhs.w }
    }

    pub(crate) fn cmpgt(self, rhs: Self) -> BVec4 {
        BVec4 { x: self.x > rhs.x, y: self.y > rhs.y, z: self.z > rhs.z, w: self.w > rhs.w }
    }

    pub(crate) fn cmple(self, rhs: Self) -> BVec4 {
        BVec4 { x: self.x <= rhs.x, y: self.y <= rhs.y, z: self.z <= rhs.z, w: self.w <= rhs.w }
    }

    pub(crate) fn select(mask: BVec4, if_true: Self, if_false: Self) -> Self {
        Self::new(
            if mask.x { if_true.x } else { if_false.x },
            if mask.y { if_true.y } else { if_false.y },
            if mask.z { if_true.z } else { if_false.z },
            if mask.w { if_true.w } else { if_false.w },
        )
    }
}

impl From<[f32; 4]> for Vec4 {
    fn from(a: [f32; 4]) -> Self {
        Self::from_array(a)
    }
}

impl Add<f32> for Vec4 {
    type Output = Self;

    fn add(self, rhs: f32) -> Self {
        Self::new(self.x + rhs, self.y + rhs, self.z + rhs, self.w + rhs)
    }
}

impl Sub for Vec4 {
    type Output = Self;

    fn sub(self, rhs: Self) -> Self {
        Self::new(self.x - rhs.x, self.y - rhs.y, self.z - rhs.z, self.w - rhs.w)
    }
}

impl Mul for Vec4 {
    type Output = Self;

    fn mul(self, rhs: Self) -> Self {
        Self::new(self.x * rhs.x, self.y * rhs.y, self.z * rhs.z, self.w * rhs.w)
    }
}

impl Mul<f32> for Vec4 {
    type Output = Self;

    fn mul(self, rhs: f32) -> Self {
        Self::new(self.x * rhs, self.y * rhs, self.z * rhs, self.w * rhs)
    }
}

impl Div for Vec4 {
    type Output = Self;

    fn div(self, rhs: Self) -> Self {
        Self::new(self.x / rhs.x, self.y / rhs.y, self.z / rhs.z, self.w / rhs.w)
    }
}

impl BVec4 {
    pub(crate) fn test(self, index: usize) -> bool {
        [self.x, self.y, self.z, self.w][index]
    }

    pub(crate) fn bitmask(self) -> u32 {
        u32::from(self.x) | u32::from(self.y) << 1 | u32::from(self.z) << 2 | u32::from(self.w) << 3
    }
}

impl BitAnd for BVec4 {
    type Output = Self;

    fn bitand(self, rhs: Self) -> Self {
        Self { x: self.x & rhs.x, y: self.y & rhs.y, z: self.z & rhs.z, w: self.w & rhs.w }
    }
}

impl BitOr for BVec4 {
    type Output = Self;

    fn bitor(self, rhs: Self) -> Self {
        Self { x: self.x | rhs.x, y: self.y | rhs.y, z: self.z | rhs.z, w: self.w | rhs.w }
    }
}
