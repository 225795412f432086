//! One hierarchy with the triangle shapes of different kernels.

use std::sync::OnceLock;

use crate::bvh::Bvh;
use crate::geom::Triangle;
use crate::geom::kernel::AffineTriangle;

/// A hierarchy, and copies of it with the triangle shapes of the kernels of [`with_tests`](super::accuracy::with_tests). Each
/// copy is built at its first use.
///
/// ```
/// use stackless_bvh::bvh::Bvh;
/// use stackless_bvh::geom::Mesh;
/// use stackless_bvh::glam::Vec3;
/// use stackless_bvh::internals::geom::kernel::AffineTriangle;
/// use stackless_bvh::internals::trace::KernelBvhs;
///
/// let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]])?;
/// let forms = KernelBvhs::new(Bvh::median(&mesh, 1)?);
/// assert_eq!(forms.of::<AffineTriangle>().nodes(), forms.corners().nodes());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct KernelBvhs {
    corners: Bvh,
    affine: OnceLock<Bvh<AffineTriangle>>,
}

impl KernelBvhs {
    /// Creates the collection of this hierarchy.
    pub fn new(bvh: Bvh) -> Self {
        Self { corners: bvh, affine: OnceLock::new() }
    }

    /// Returns the hierarchy itself.
    pub fn corners(&self) -> &Bvh {
        &self.corners
    }

    /// Returns the hierarchy with triangles of this shape.
    pub fn of<S: KernelShape>(&self) -> &Bvh<S> {
        S::form(self)
    }
}

/// A triangle shape of [`KernelBvhs`].
pub trait KernelShape: Copy + From<Triangle> + 'static {
    /// Computes [`KernelBvhs::of`].
    fn form(forms: &KernelBvhs) -> &Bvh<Self>;
}

impl KernelShape for Triangle {
    fn form(forms: &KernelBvhs) -> &Bvh<Self> {
        &forms.corners
    }
}

impl KernelShape for AffineTriangle {
    fn form(forms: &KernelBvhs) -> &Bvh<Self> {
        forms.affine.get_or_init(|| forms.corners.clone().map(Self::from))
    }
}
