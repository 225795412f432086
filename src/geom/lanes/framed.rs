//! The slab test of all boxes of a node, for rays in double precision.

use fearless_simd::{Simd, SimdBase as _, f32x8};
use glam::DVec3;

use super::boxes::ranked_by_pairs;
use super::lines::Lines;
use super::precision::NodeBoxes;
use crate::geom::slabs::{Entered, Framed};
use crate::geom::{Ray, Region};

/// A ray in double precision, prepared for the eight boxes of a node. `[BOX-8]`
///
/// The test is that of [`EnclosedBoxes`](super::EnclosedBoxes), in the frame. Rays for which doubles do not suffice are
/// tested box by box. `[BOX-9]`
#[derive(Clone, Debug)]
pub struct FramedBoxes<S: Simd> {
    simd: S,
    lines: Lines<S, f32x8<S>, 8>,
    unit: f64,
    start: f64,
    /// For rare rays; other rays do not store it.
    entered: Option<Box<Entered>>,
}

impl<S: Simd> NodeBoxes<S, DVec3> for FramedBoxes<S> {
    #[inline(always)]
    fn new(simd: S, ray: &Ray<DVec3>, region: &Region) -> Self {
        let (framed, entered) = match Framed::new(ray, region) {
            Ok(framed) => (framed, None),
            Err(entered) => (Framed::MISSING, Some(entered)),
        };
        let Framed { near, far, backward, tmin, unit, start } = framed;
        let is_backward = |axis: u32| backward >> axis & 1 == 1;
        let lines = [[near[0].truncate(), near[1].truncate()], [far[0].truncate(), far[1].truncate()]];
        let lines = Lines::new(simd, lines, [is_backward(0), is_backward(1), is_backward(2)], tmin);
        Self { simd, lines, unit, start, entered }
    }

    #[inline(always)]
    fn end(&self, t: f64) -> f32 {
        match &self.entered {
            None => Framed::end(self.unit, self.start, t),
            Some(entered) => end_slowly(entered, t),
        }
    }

    #[inline(always)]
    fn enter(&self, planes: &[[[f32; 8]; 2]; 3], end: f32) -> (f32x8<S>, u32) {
        if let Some(entered) = &self.entered {
            let (ranks, set) = enter_slowly(entered, planes, end);
            return (f32x8::load_array(self.simd, ranks), set);
        }
        self.lines.enter(planes, end)
    }
}

#[cold]
#[inline(never)]
fn end_slowly(entered: &Entered, t: f64) -> f32 {
    entered.in_units(t)[1]
}

#[cold]
#[inline(never)]
fn enter_slowly(entered: &Entered, planes: &[[[f32; 8]; 2]; 3], end: f32) -> ([f32; 8], u32) {
    ranked_by_pairs(planes, end, |pair| entered.enter(pair))
}
