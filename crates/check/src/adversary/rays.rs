//! Triangles and rays by their numbers, and small changes of them.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::AdversaryError;
use stackless_bvh::generate::draw::{Draw, exp2, nudge};
use stackless_bvh::generate::stress;
use stackless_bvh::geom::{Mesh, Ray, Triangle};

/// Triangles, and rays with the interval from 0 to infinity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RayCase {
    /// Corners.
    pub triangles: Vec<[[f32; 3]; 3]>,
    /// Origins and directions.
    pub rays: Vec<[[f32; 3]; 2]>,
    /// What was found, for the reader.
    #[serde(default)]
    pub found: Option<String>,
}

impl RayCase {
    /// The same as a case of the stress suite, with a mesh in which no triangles share vertices.
    ///
    /// # Errors
    /// [`AdversaryError`], for numbers that are not a mesh of triangles with an area, or not rays.
    pub fn scene(&self, name: &'static str) -> Result<stress::StressCase, AdversaryError> {
        let corners = self.triangles.iter().flatten().copied().map(Vec3::from).collect();
        let triangles = (0..self.triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let mesh = Mesh::new(corners, triangles)?;
        let is_degenerate = |&i: &usize| Triangle(mesh.triangle(i)).is_degenerate();
        if let Some(triangle) = (0..self.triangles.len()).find(is_degenerate) {
            return Err(AdversaryError::Degenerate { triangle });
        }
        let ray = |(ray, &[o, d]): (usize, &[[f32; 3]; 2])| {
            Ray::new(o.into(), d.into()).map_err(|error| AdversaryError::Ray { ray, error })
        };
        let rays = self.rays.iter().enumerate().map(ray).collect::<Result<_, _>>()?;
        Ok(stress::StressCase { name, about: "found by a search", mesh, rays, closed: false })
    }

    /// Random triangles about the origin, one time of four at whole numbers, with rays that are aimed at them.
    pub(super) fn draw(draw: &mut Draw, triangles: usize, rays: usize) -> Self {
        let is_grid = draw.one_in(4);
        let point = |draw: &mut Draw| if is_grid { draw.ints(4) } else { draw.centred() };
        let triangles = (0..triangles).map(|_| [(); 3].map(|()| point(draw).to_array())).collect();
        let mut case = Self { triangles, rays: Vec::new(), found: None };
        for _ in 0..rays {
            let o = point(draw) * 2.0;
            let d = case.target(draw) - o;
            case.rays.push([o.to_array(), d.to_array()]);
        }
        case
    }

    /// Up to three changes. `None` where a number leaves the range: nothing is to over- or underflow.
    pub(super) fn change(&self, draw: &mut Draw) -> Option<Self> {
        const RANGE: std::ops::RangeInclusive<f32> = exp2(-20)..=exp2(10);
        let mut case = self.clone();
        for _ in 0..=draw.below(3) {
            case.edit(draw)?;
        }
        let (triangles, rays) = (case.triangles.as_flattened().as_flattened(), case.rays.as_flattened().as_flattened());
        let in_range = |x: &f32| *x == 0.0 || RANGE.contains(&x.abs());
        (triangles.iter().all(in_range) && rays.iter().all(in_range)).then_some(case)
    }

    fn edit(&mut self, draw: &mut Draw) -> Option<()> {
        match draw.below(7) {
            0 => {
                let (target, ray) = (self.target(draw), draw.below(self.rays.len()));
                let [o, d] = self.rays.get_mut(ray)?;
                *d = (target - Vec3::from(*o)).to_array();
            }
            1 => {
                let corner = self.corner(draw);
                let corners = self.triangles.as_flattened_mut();
                *corners.get_mut(draw.below(corners.len()))? = corner.to_array();
            }
            2 => {
                let other = *self.number(draw)?;
                *self.number(draw)? = other;
            }
            3 => *self.number(draw)? = draw.int(4),
            4 => {
                let number = self.number(draw)?;
                *number = nudge(*number, draw.int(8) as i32);
            }
            _ => {
                let number = self.number(draw)?;
                *number = f32::from_bits(number.to_bits() ^ 1 << draw.below(32));
            }
        }
        Some(())
    }

    /// Any of the numbers, of triangles as often as of rays.
    fn number(&mut self, draw: &mut Draw) -> Option<&mut f32> {
        let of_triangles = self.triangles.as_flattened_mut().as_flattened_mut();
        let of_rays = self.rays.as_flattened_mut().as_flattened_mut();
        let numbers = if draw.one_in(2) { of_triangles } else { of_rays };
        numbers.get_mut(draw.below(numbers.len()))
    }

    /// A corner, the middle of an edge, a point inside, or a point of which each coordinate is some corner's: such are
    /// the corners of boxes.
    fn target(&self, draw: &mut Draw) -> Vec3 {
        let triangle = self.triangles.get(draw.below(self.triangles.len())).copied().unwrap_or_default();
        let [a, b, c] = triangle.map(Vec3::from);
        match draw.below(4) {
            0 => a,
            1 => (b + c) * 0.5,
            2 => a + ((b - a) * draw.unit() + (c - a) * draw.unit()) * 0.5,
            _ => Vec3::from([0, 1, 2].map(|axis| self.corner(draw)[axis])),
        }
    }

    fn corner(&self, draw: &mut Draw) -> Vec3 {
        let corners = self.triangles.as_flattened();
        corners.get(draw.below(corners.len())).copied().unwrap_or_default().into()
    }
}
