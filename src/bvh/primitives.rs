//! The input of builders.

use glam::Vec3;

use crate::geom::{Aabb, Frame, Mesh, Triangle, Vector};

/// Shapes with boxes, indexed from 0: a [`Mesh`], or a slice of a [`Bounded`] type.
pub trait Primitives: Sync {
    /// The shape that leaves store.
    type Shape: Copy + Send + Sync;

    /// Returns the number of shapes.
    fn count(&self) -> usize;

    /// Returns the shape with this index, which must be less than the [`count`](Self::count).
    fn shape(&self, index: usize) -> Self::Shape;

    /// Returns the frame of the boxes.
    fn frame(&self) -> Frame {
        Frame::IDENTITY
    }

    /// Returns the smallest box that contains the whole shape; a greater box makes queries slower, not wrong. An empty
    /// box and a box with a NaN are refused.
    fn aabb(&self, index: usize) -> Aabb;

    /// Returns whether any ray can meet the shape. [`Degenerate`](super::Degenerate) determines the treatment of other
    /// shapes.
    fn can_be_hit(&self, _: usize) -> bool {
        true
    }

    /// Returns a box that contains the part of the shape inside `part`, and does not extend beyond `part`. Smaller
    /// boxes make better hierarchies if shapes are divided.
    fn part(&self, index: usize, part: &Aabb) -> Aabb {
        self.aabb(index).intersection(part)
    }

    /// Returns the corners in the [frame](Self::frame), rounded, if the shape is a triangle. A builder that divides
    /// shapes estimates the effect of a plane by them. Without corners it calls [`part`](Self::part) many times, which
    /// takes longer.
    fn corners(&self, _: usize) -> Option<[Vec3; 3]> {
        None
    }
}

/// A shape that has a box. With a [`Kernel`](crate::geom::Kernel) for it, rays can be traced:
///
/// ```
/// use stackless_bvh::bvh::{Bounded, BuildOptions, Bvh};
/// use stackless_bvh::geom::{Aabb, Kernel, Ray, Region};
/// use stackless_bvh::glam::{DVec3, Vec3};
/// use stackless_bvh::trace::BinaryTracer;
/// use stackless_bvh::traverse::Method;
///
/// #[derive(Clone, Copy, Debug, PartialEq)]
/// struct Sphere {
///     center: Vec3,
///     radius: f32,
/// }
///
/// impl Bounded for Sphere {
///     fn aabb(&self) -> Aabb {
///         Aabb { lo: self.center - self.radius, hi: self.center + self.radius }
///     }
/// }
///
/// /// A ray that meets spheres from outside.
/// #[derive(Clone, Copy, Debug)]
/// struct SphereTest(Ray);
///
/// impl Kernel for SphereTest {
///     type Vector = Vec3;
///     type Shape = Sphere;
///     type Filter = ();
///
///     fn new(ray: &Ray, _: &Region) -> Self {
///         Self(*ray)
///     }
///
///     fn distance(&self, sphere: &Sphere, _: f32) -> Option<f32> {
///         let (d, r) = (self.0.direction().as_dvec3(), f64::from(sphere.radius));
///         let to_center: DVec3 = (sphere.center - self.0.origin()).as_dvec3();
///         let along = d.dot(to_center) / d.length_squared();
///         let root = (along * along - (to_center.length_squared() - r * r) / d.length_squared()).sqrt();
///         let t = (along - root) as f32;
///         (self.0.tmin() <= t && t <= self.0.tmax()).then_some(t)
///     }
///
///     fn weights(&self, _: &Sphere) -> [f32; 2] {
///         [0.0; 2]
///     }
/// }
///
/// let spheres: Vec<_> = (0..100).map(|i| Sphere { center: Vec3::X * i as f32, radius: 0.25 }).collect();
/// let bvh = Bvh::build(&spheres[..])?;
/// let tracer = BinaryTracer::<_, SphereTest>::with_tests(&bvh, Method::default())?;
/// let ray = Ray::new(Vec3::new(7.0, 0.0, -3.0), Vec3::Z)?;
/// assert_eq!(tracer.closest_distance(&ray), Some((7, 2.75)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Bounded {
    /// Returns the smallest box that contains the whole shape. An empty box and a box with a NaN are refused.
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
    fn frame(&self) -> Frame {
        *Mesh::frame(self)
    }

    #[inline]
    fn aabb(&self, index: usize) -> Aabb {
        Mesh::frame(self).aabb(&self.shape(index))
    }

    #[inline]
    fn can_be_hit(&self, index: usize) -> bool {
        !self.shape(index).is_degenerate()
    }

    #[inline]
    fn part(&self, index: usize, part: &Aabb) -> Aabb {
        Mesh::frame(self).part(&self.shape(index), part)
    }

    #[inline]
    fn corners(&self, index: usize) -> Option<[Vec3; 3]> {
        let frame = Mesh::frame(self);
        Some(self.shape(index).widen().map(|corner| frame.rounded(corner).as_vec3()))
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
