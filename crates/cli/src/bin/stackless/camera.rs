//! Images: how large, and from where.

use std::str::FromStr;

use glam::Vec3;
use stackless_bvh::generate::procedural::{self, View};
use stackless_bvh::geom::Ray;

use crate::input::Scene;

/// Where an image is taken from.
#[derive(Clone, Copy, clap::Args)]
pub(crate) struct Options {
    /// The camera: where it stands and what is in the middle of the image, `ex,ey,ez,tx,ty,tz`; then, if given, what is
    /// up there, `ux,uy,uz`, and the field of view from the lower to the upper edge in degrees. Without it, one that
    /// shows the scene.
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    view: Option<Given>,
    /// Pixels: width and height, or both in one number.
    #[arg(long, value_name = "WxH", default_value = "512")]
    pub(crate) size: Size,
}

/// Width and height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl Size {
    /// Most pixels along an edge.
    const MOST: u32 = 8192;

    pub(crate) const fn pixels(self) -> usize {
        self.width as usize * self.height as usize
    }
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (width, height) = text.split_once('x').unwrap_or((text, text));
        let number = |text: &str| text.parse().ok().filter(|pixels| (1..=Self::MOST).contains(pixels));
        match (number(width), number(height)) {
            (Some(width), Some(height)) => Ok(Self { width, height }),
            _ => Err(format!("expected WIDTHxHEIGHT or a number, each from 1 to {}", Self::MOST)),
        }
    }
}

/// A camera as the user gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Given(View);

impl FromStr for Given {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Vec<f32> =
            text.split(',').filter_map(|number| number.trim().parse().ok().filter(|x: &f32| x.is_finite())).collect();
        let expected = || "expected 6, 7, 9 or 10 numbers: eye, target, then up, then degrees".to_owned();
        if numbers.len() != text.split(',').count() {
            return Err(expected());
        }
        let (points, degrees) = match numbers.len() {
            6 | 9 => (&numbers[..], 50.0),
            7 | 10 => (&numbers[..numbers.len() - 1], numbers[numbers.len() - 1]),
            _ => return Err(expected()),
        };
        let points: Vec<_> = points.chunks(3).map(Vec3::from_slice).collect();
        let up = points.get(2).copied().unwrap_or(Vec3::Y);
        if points[0] == points[1] {
            return Err("eye and target are the same point".to_owned());
        }
        if !(degrees > 0.0 && degrees < 180.0) {
            return Err(format!("{degrees} degrees, expected more than 0 and less than 180"));
        }
        Ok(Self(View { eye: points[0], target: points[1], up, degrees }))
    }
}

/// A camera with its image.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    view: View,
    size: Size,
}

impl Options {
    /// The camera that shows a scene, with a square image.
    pub(crate) const fn automatic(pixels: u32) -> Self {
        Self { view: None, size: Size { width: pixels, height: pixels } }
    }

    pub(crate) fn of(&self, scene: &Scene) -> Camera {
        let view = self.view.map_or_else(|| procedural::view(&scene.name, &scene.mesh), |Given(view)| view);
        Camera { view, size: self.size }
    }
}

impl Camera {
    /// The ray through a place in a pixel, whose upper left corner is 0, 0. Pixels are counted row by row.
    pub(crate) fn ray(&self, pixel: usize, [x, y]: [f64; 2]) -> Option<Ray> {
        let Size { width, height } = self.size;
        let column = (pixel % width as usize) as f64 + x;
        let row = (pixel / width as usize) as f64 + y;
        let (width, height) = (f64::from(width), f64::from(height));
        self.view.ray((2.0 * column - width) / height, 1.0 - 2.0 * row / height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_views_are_read_or_refused() {
        assert_eq!("7".parse(), Ok(Size { width: 7, height: 7 }));
        assert_eq!("800x300".parse(), Ok(Size { width: 800, height: 300 }));
        for bad in ["", "0", "8x", "x8", "9000x9", "-1", "3x3x3", "1.5"] {
            assert!(bad.parse::<Size>().is_err(), "{bad}");
        }
        let Given(view) = "0,0,5,0,0,0".parse().unwrap();
        assert_eq!((view.eye, view.target, view.up, view.degrees), (Vec3::Z * 5.0, Vec3::ZERO, Vec3::Y, 50.0));
        let Given(view) = "0, 0, 5, 0, 0, 0, 0, 0, 1, 90".parse().unwrap();
        assert_eq!((view.up, view.degrees), (Vec3::Z, 90.0));
        for bad in ["", "1,2,3", "0,0,5,0,0,x", "0,0,5,0,0,inf", "1,1,1,1,1,1", "0,0,5,0,0,0,180", "0,0,5,0,0,0,1,2"] {
            assert!(bad.parse::<Given>().is_err(), "{bad}");
        }
    }

    #[test]
    fn pixels_are_square_in_wide_images_too() {
        let Given(view) = "0,0,1,0,0,0,90".parse().unwrap();
        let camera = Camera { view, size: Size { width: 4, height: 2 } };
        let direction = |pixel, place| camera.ray(pixel, place).unwrap().direction();
        assert!(direction(0, [0.0, 0.0]).distance(Vec3::new(-2.0, 1.0, -1.0)) < 1e-6);
        assert!(direction(7, [1.0, 1.0]).distance(Vec3::new(2.0, -1.0, -1.0)) < 1e-6);
        assert!(direction(6, [0.0, 0.0]).distance(Vec3::new(0.0, 0.0, -1.0)) < 1e-6);
    }
}
