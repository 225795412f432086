//! What a hierarchy is built over.

use crate::geom::{Aabb, Triangle, Vector};
use crate::scene::Mesh;

/// Shapes with boxes, told apart by an index from 0 on: a [`Mesh`], or a slice of anything that is [`Bounded`].
pub trait Primitives: Sync {
    /// What leaves hold of each.
    type Shape: Copy + Send + Sync;

    /// How many there are.
    fn count(&self) -> usize;

    /// The shape with this index, which must be less than the [`count`](Self::count).
    fn shape(&self, index: usize) -> Self::Shape;

    /// The smallest box that holds all of the shape; a greater one makes queries slower, not wrong.
    fn aabb(&self, index: usize) -> Aabb;

    /// Whether any ray can meet the shape. Where none can, it is left out.
    fn can_be_hit(&self, _: usize) -> bool {
        true
    }

    /// A box that holds all of the shape that is inside of `part`, and does not stick out of `part`. Smaller ones make
    /// better hierarchies where shapes are cut in two.
    fn part(&self, index: usize, part: &Aabb) -> Aabb {
        self.aabb(index).intersection(part)
    }
}

/// A shape that has a box.
pub trait Bounded {
    /// The smallest box that holds all of the shape. Its coordinates are not NaN.
    fn aabb(&self) -> Aabb;
}

impl<V: Vector> Primitives for Mesh<V> {
    type Shape = Triangle<V>;

    fn count(&self) -> usize {
        self.triangles().len()
    }

    #[inline]
    fn shape(&self, index: usize) -> Triangle<V> {
        Triangle(self.triangle(index))
    }

    #[inline]
    fn aabb(&self, index: usize) -> Aabb {
        self.shape(index).aabb()
    }

    #[inline]
    fn can_be_hit(&self, index: usize) -> bool {
        !self.shape(index).is_degenerate()
    }

    #[inline]
    fn part(&self, index: usize, part: &Aabb) -> Aabb {
        self.shape(index).part(part)
    }
}

impl<S: Bounded + Copy + Send + Sync> Primitives for [S] {
    type Shape = S;

    fn count(&self) -> usize {
        self.len()
    }

    #[inline]
    fn shape(&self, index: usize) -> S {
        self[index]
    }

    #[inline]
    fn aabb(&self, index: usize) -> Aabb {
        self[index].aabb()
    }
}
