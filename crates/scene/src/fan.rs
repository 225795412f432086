//! Polygons as triangles.

/// Cuts a polygon into the triangles `(0, i, i + 1)` while its corners arrive.
#[derive(Default)]
pub(crate) struct Fan {
    corners: u64,
    first: u32,
    last: u32,
}

impl Fan {
    /// The triangle that this corner completes: from the third on, one each.
    #[inline]
    pub(crate) fn push(&mut self, corner: u32) -> Option<[u32; 3]> {
        if self.corners == 0 {
            self.first = corner;
        }
        let triangle = (self.corners >= 2).then_some([self.first, self.last, corner]);
        self.corners += 1;
        self.last = corner;
        triangle
    }

    /// Number of corners so far.
    pub(crate) fn corners(&self) -> u64 {
        self.corners
    }
}
