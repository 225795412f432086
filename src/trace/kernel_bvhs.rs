//! One hierarchy in the shapes of triangles that kernels want.

use std::sync::OnceLock;

use crate::bvh::Bvh;
use crate::geom::Triangle;
use crate::geom::kernel::AffineTriangle;

/// A hierarchy, and the same with its triangles in every other shape that a kernel of [`with_tests`](super::with_tests)
/// wants, made when it is first asked for.
///
/// ```
/// use glam::Vec3;
/// use stackless_bvh::{bvh::Bvh, geom::kernel::AffineTriangle, geom::Mesh, trace::KernelBvhs};
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
    /// The forms of this hierarchy.
    pub fn new(bvh: Bvh) -> Self {
        Self { corners: bvh, affine: OnceLock::new() }
    }

    /// The hierarchy itself.
    pub fn corners(&self) -> &Bvh {
        &self.corners
    }

    /// The hierarchy with triangles of this shape.
    pub fn of<S: KernelShape>(&self) -> &Bvh<S> {
        S::form(self)
    }
}

/// A shape of triangles that [`KernelBvhs`] have.
pub trait KernelShape: Copy + From<Triangle> + 'static {
    /// As [`KernelBvhs::of`].
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
