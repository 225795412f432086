//! Made curves and points, ordinary and degenerate, for tests and measurements.

use super::Bezier;
use stackless_bvh::generate::Source;
use stackless_bvh::name::named;

/// A kind of curve, with a point that is hard for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Family {
    /// Any control points and point.
    Random,
    /// The point is on the curve, about or exactly: at an end.
    On,
    /// Small whole coordinates: ties, symmetry, stationary ends.
    Grid,
    /// All control points are one.
    Coincident,
    /// All control points are on a line, on which the curve turns back.
    Collinear,
    /// The curve stops and turns: where it has degree 3 or more, sharply, and to a side.
    Cusp,
    /// The curve crosses itself, about where the point is.
    Loop,
    /// About a part of a circle, seen from its centre.
    Arc,
    /// Far from the origin.
    Far,
    /// All coordinates greater or smaller by a power of two, down to subnormal ones.
    Scaled,
}

impl Family {
    /// All families.
    pub const ALL: [Self; 10] = [
        Self::Random,
        Self::On,
        Self::Grid,
        Self::Coincident,
        Self::Collinear,
        Self::Cusp,
        Self::Loop,
        Self::Arc,
        Self::Far,
        Self::Scaled,
    ];

    /// The name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::On => "on",
            Self::Grid => "grid",
            Self::Coincident => "coincident",
            Self::Collinear => "collinear",
            Self::Cusp => "cusp",
            Self::Loop => "loop",
            Self::Arc => "arc",
            Self::Far => "far",
            Self::Scaled => "scaled",
        }
    }

    /// Control points of a curve of this degree, 1 to [`Bezier::MAX_DEGREE`] (others become those), and a point.
    pub fn draw<const D: usize>(self, degree: usize, source: &mut impl Source) -> (Vec<[f64; D]>, [f64; D]) {
        let degree = degree.clamp(1, Bezier::<D>::MAX_DEGREE);
        let mut any: Vec<[f64; D]> = (0..=degree).map(|_| point(source)).collect();
        let mut target = point(source).map(|x| 1.5 * x);
        match self {
            Self::Random => {}
            Self::On => {
                let t = [unit(source).abs(), 0.0, 1.0, 0.5][source.below(4) as usize];
                target = at(any.clone(), t);
            }
            Self::Grid => {
                let mut whole = |_| source.below(5) as f64 - 2.0;
                change(&mut any, &mut whole);
                target = target.map(&mut whole);
            }
            Self::Coincident => any = vec![any[0]; degree + 1],
            Self::Collinear => {
                let [start, end] = [any[0], any[1]];
                any = any.iter().map(|_| between(start, end, 2.0 * unit(source))).collect();
                if source.coin() {
                    target = between(start, end, 2.0 * unit(source));
                }
            }
            // The squares and cubes of 2t - 1.
            Self::Cusp if degree >= 3 => {
                any = shaped(&[[3.0, -1.0], [-1.0, 1.0], [-1.0, -1.0], [3.0, 1.0]], degree);
            }
            Self::Cusp => any = shaped(&[[1.0, 0.0], [-1.0, 0.0], [1.0, 0.0]][..=degree], degree),
            Self::Loop => {
                let corners = [[0.0, 0.0], [3.0, 2.0], [-2.0, 2.0], [1.0, 0.0]];
                any = shaped(if degree >= 3 { &corners } else { &corners[..2] }, degree);
                target = placed([0.5, 1.0 + 0.5 * unit(source)]);
            }
            Self::Arc => {
                let (cubic, square) =
                    ([[1.0, 0.0], [1.0, 0.5522], [0.5522, 1.0], [0.0, 1.0]], [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
                any = shaped(if degree >= 3 { &cubic } else { &square[..=degree] }, degree);
                target = [0.0; D];
            }
            Self::Far => {
                let offset = unit(source) * 1e9;
                change(&mut any, |x| x + offset);
                target = target.map(|x| x + offset);
            }
            Self::Scaled => {
                let exponent = [source.below(800) as i32 - 400, -1060][usize::from(source.below(4) == 0)];
                // In two steps: no power of two beyond the normal ones is needed.
                let scale = |x: f64| x * 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2);
                change(&mut any, scale);
                target = target.map(scale);
            }
        }
        (any, target)
    }
}

named!(Family);

fn change<const D: usize>(points: &mut [[f64; D]], mut to: impl FnMut(f64) -> f64) {
    for x in points.as_flattened_mut() {
        *x = to(*x);
    }
}

/// In -1..1, with 53 bits.
fn unit(source: &mut impl Source) -> f64 {
    source.below(1 << 54) as f64 / (1_u64 << 53) as f64 - 1.0
}

fn point<const D: usize>(source: &mut impl Source) -> [f64; D] {
    [(); D].map(|()| unit(source))
}

fn between<const D: usize>(start: [f64; D], end: [f64; D], t: f64) -> [f64; D] {
    std::array::from_fn(|k| start[k] + t * (end[k] - start[k]))
}

/// In the plane of the first two axes.
fn placed<const D: usize>(flat: [f64; 2]) -> [f64; D] {
    std::array::from_fn(|k| flat.get(k).copied().unwrap_or(0.0))
}

/// Control points of the same curve in a higher degree, rounded.
fn shaped<const D: usize>(flat: &[[f64; 2]], degree: usize) -> Vec<[f64; D]> {
    let mut points: Vec<[f64; D]> = flat.iter().map(|&flat| placed(flat)).collect();
    while points.len() <= degree {
        let n = points.len();
        let raised = (0..=n).map(|i| {
            let (before, here) = (points[i.saturating_sub(1)], points[i.min(n - 1)]);
            between(here, before, i as f64 / n as f64)
        });
        points = raised.collect();
    }
    points
}

/// The curve at `t`, rounded.
fn at<const D: usize>(mut points: Vec<[f64; D]>, t: f64) -> [f64; D] {
    while points.len() > 1 {
        points = points.windows(2).map(|pair| between(pair[0], pair[1], t)).collect();
    }
    points[0]
}
