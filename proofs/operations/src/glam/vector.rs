// The operations of vectors of three numbers in either precision: `Vector` is `Vec3` or `DVec3`, and `Number` is `f32` or `f64`.

use std::ops::{Add, Mul, Sub};

use super::BVec3;

#[derive(Clone, Copy)]
pub(crate) struct Vector {
    pub(crate) x: Number,
    pub(crate) y: Number,
    pub(crate) z: Number,
}

impl Vector {
    pub(crate) const ZERO: Self = Self { x: 0.0, y: 0.0, z: 0.0 };

    pub(crate) const fn new(x: Number, y: Number, z: Number) -> Self {
        Self { x, y, z }
    }

    pub(crate) fn to_array(self) -> [Number; 3] {
        [self.x, self.y, self.z]
    }

    pub(crate) fn dot(self, rhs: Self) -> Number {
        (self.x * rhs.x) + (self.y * rhs.y) + (self.z * rhs.z)
    }

    pub(crate) fn cross(self, rhs: Self) -> Self {
        Self::new(self.y * rhs.z - rhs.y * self.z, self.z * rhs.x - rhs.z * self.x, self.x * rhs.y - rhs.x * self.y)
    }

    pub(crate) fn abs(self) -> Self {
        Self::new(self.x.abs(), self.y.abs(), self.z.abs())
    }

    pub(crate) fn recip(self) -> Self {
        Self::new(1.0 / self.x, 1.0 / self.y, 1.0 / self.z)
    }

    /// For numbers except NaN, and up to the sign of zero. The order is that of glam 0.34.3; 0.34.2 has another.
    pub(crate) fn max_element(self) -> Number {
        let max = |a: Number, b: Number| if a > b { a } else { b };
        max(max(self.x, self.y), self.z)
    }

    pub(crate) fn select(mask: BVec3, if_true: Self, if_false: Self) -> Self {
        Self::new(
            if mask.x { if_true.x } else { if_false.x },
            if mask.y { if_true.y } else { if_false.y },
            if mask.z { if_true.z } else { if_false.z },
        )
    }
}

impl Add for Vector {
    type Output = Self;

    fn add(self, rhs: Self) -> Self {
        Self::new(self.x + rhs.x, self.y + rhs.y, self.z + rhs.z)
    }
}

impl Sub for Vector {
    type Output = Self;

    fn sub(self, rhs: Self) -> Self {
        Self::new(self.x - rhs.x, self.y - rhs.y, self.z - rhs.z)
    }
}

impl Mul<Number> for Vector {
    type Output = Self;

    fn mul(self, rhs: Number) -> Self {
        Self::new(self.x * rhs, self.y * rhs, self.z * rhs)
    }
}
