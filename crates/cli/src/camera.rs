//! The size of images and the camera.

use std::path::Path;
use std::str::FromStr;

use glam::{DVec3, Vec3};
use stackless_bvh::generate::procedural::View;
use stackless_bvh::geom::Ray;
use stackless_scene::read_text;

use crate::input::Scene;

/// The cameras of scenes.
#[derive(Clone, Default, clap::Args)]
pub(crate) struct Place {
    /// Camera position and target, `ex,ey,ez,tx,ty,tz`; then optionally the up vector, `ux,uy,uz`, and the field of
    /// view across the shorter edge in degrees. Or a file with a line `NAME: NUMBERS` for each scene. By default, and
    /// for scenes that the file does not name, the whole scene is in the image.
    #[arg(long, value_name = "NUMBERS|FILE", allow_hyphen_values = true)]
    view: Option<Given>,
}

/// Camera and image size.
#[derive(Clone, clap::Args)]
pub(crate) struct Options {
    #[command(flatten)]
    place: Place,
    /// Image size in pixels: width and height, or one number for a square.
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
    /// Maximum number of pixels along an edge.
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

/// A camera of the command line.
#[derive(Clone, Debug, PartialEq)]
enum Given {
    /// For all scenes.
    One(View),
    /// For the scenes of these names.
    Named(Vec<(String, View)>),
}

impl FromStr for Given {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text.contains(',') && !Path::new(text).exists() {
            return view(text).map(Self::One);
        }
        let lines =
            read_text(Path::new(text)).map_err(|error| format!("{text}: {error}; {EXPECTED}, or a file of views"));
        named(&lines?).map(Self::Named).map_err(|error| format!("{text}, {error}"))
    }
}

const EXPECTED: &str = "expected 6, 7, 9 or 10 numbers: eye, target, then up, then degrees";

/// Parses the lines `NAME: NUMBERS` of a file of views. `#` starts a comment.
fn named(text: &str) -> Result<Vec<(String, View)>, String> {
    let lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim()));
    let lines = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let read = |(number, line): (usize, &str)| {
        let (name, numbers) = line.split_once(':').ok_or(format!("line {number}: expected NAME: NUMBERS"))?;
        let view = view(numbers).map_err(|error| format!("line {number}: {error}"))?;
        Ok((name.trim().to_owned(), view))
    };
    lines.map(read).collect()
}

fn view(text: &str) -> Result<View, String> {
    let numbers: Vec<f32> =
        text.split(',').filter_map(|number| number.trim().parse().ok().filter(|x: &f32| x.is_finite())).collect();
    if numbers.len() != text.split(',').count() {
        return Err(EXPECTED.to_owned());
    }
    let (points, degrees) = match numbers.len() {
        6 | 9 => (&numbers[..], 50.0),
        7 | 10 => (&numbers[..numbers.len() - 1], numbers[numbers.len() - 1]),
        _ => return Err(EXPECTED.to_owned()),
    };
    let points: Vec<_> = points.chunks(3).map(Vec3::from_slice).collect();
    let up = points.get(2).copied().unwrap_or(Vec3::Y);
    if points[0] == points[1] {
        return Err("eye and target are the same point".to_owned());
    }
    if !(degrees > 0.0 && degrees < 180.0) {
        return Err(format!("{degrees} degrees, expected more than 0 and less than 180"));
    }
    Ok(View { eye: points[0], target: points[1], up, degrees })
}

impl Place {
    /// The view of a scene.
    pub(crate) fn of(&self, scene: &Scene) -> View {
        let given = match &self.view {
            Some(Given::One(view)) => Some(*view),
            Some(Given::Named(views)) => views.iter().find(|(name, _)| *name == scene.name).map(|&(_, view)| view),
            None => None,
        };
        given.unwrap_or_else(|| View::of(&scene.mesh))
    }
}

/// Formats a view for `--view`.
pub(crate) fn numbers(view: &View) -> String {
    let points = [view.eye, view.target, view.up].map(|v| v.to_array());
    let all: Vec<_> = points.iter().flatten().chain([&view.degrees]).map(f32::to_string).collect();
    all.join(",")
}

/// A camera with its image.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    view: View,
    pub(crate) size: Size,
}

impl Options {
    pub(crate) fn of(&self, scene: &Scene) -> Camera {
        Camera { view: self.place.of(scene), size: self.size }
    }
}

impl Camera {
    /// Forward, right and up, of length 1.
    pub(crate) fn axes(&self) -> [Vec3; 3] {
        self.view.frame().map(DVec3::as_vec3)
    }

    /// The ray through a point of a pixel. The pixel's upper left corner is 0, 0. Pixels are numbered row by row.
    pub(crate) fn ray(&self, pixel: usize, [x, y]: [f64; 2]) -> Option<Ray> {
        let Size { width, height } = self.size;
        let column = (pixel % width as usize) as f64 + x;
        let row = (pixel / width as usize) as f64 + y;
        let (width, height) = (f64::from(width), f64::from(height));
        let shorter = width.min(height);
        self.view.ray((2.0 * column - width) / shorter, (height - 2.0 * row) / shorter)
    }
}

#[cfg(test)]
mod tests {
    use stackless_bvh::generate::procedural;

    use super::*;

    #[test]
    fn sizes_and_views_are_read_or_refused() {
        assert_eq!("7".parse(), Ok(Size { width: 7, height: 7 }));
        assert_eq!("800x300".parse(), Ok(Size { width: 800, height: 300 }));
        for bad in ["", "0", "8x", "x8", "9000x9", "-1", "3x3x3", "1.5"] {
            assert!(bad.parse::<Size>().is_err(), "{bad}");
        }
        let read = super::view;
        let view = read("0,0,5,0,0,0").unwrap();
        assert_eq!(read(&numbers(&view)).as_ref(), Ok(&view));
        assert_eq!((view.eye, view.target, view.up, view.degrees), (Vec3::Z * 5.0, Vec3::ZERO, Vec3::Y, 50.0));
        let view = read("0, 0, 5, 0, 0, 0, 0, 0, 1, 90").unwrap();
        assert_eq!((view.up, view.degrees), (Vec3::Z, 90.0));
        for bad in ["", "1,2,3", "0,0,5,0,0,x", "0,0,5,0,0,inf", "1,1,1,1,1,1", "0,0,5,0,0,0,180", "0,0,5,0,0,0,1,2"] {
            assert!(read(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_file_has_the_views_of_the_scenes_that_it_names() {
        let views = named("# inside\n\n a: 0,0,5,0,0,0\nb : 0,0,5,0,0,0,90\n").unwrap();
        let place = Place { view: Some(Given::Named(views)) };
        let mesh = procedural::soup(1, 5);
        let of = |name: &str| place.of(&Scene { name: name.to_owned(), mesh: mesh.clone(), faces: Vec::new() });
        assert_eq!((of("a").degrees, of("b").degrees), (50.0, 90.0));
        assert_eq!(of("c"), View::of(&mesh));
        assert_eq!(named("\na 0,0,5").unwrap_err(), "line 2: expected NAME: NUMBERS");
        assert!(named("a: 0,0,5").unwrap_err().starts_with("line 1: expected 6"));
        assert!("no/such.views".parse::<Given>().unwrap_err().contains("no/such.views"));
    }

    #[test]
    fn pixels_are_square_in_wide_images_too() {
        let view = super::view("0,0,1,0,0,0,90").unwrap();
        let tall = Camera { view, size: Size { width: 2, height: 4 } };
        assert!(tall.ray(0, [0.0; 2]).unwrap().direction().distance(Vec3::new(-1.0, 2.0, -1.0)) < 1e-6);
        let camera = Camera { view, size: Size { width: 4, height: 2 } };
        let direction = |pixel, place| camera.ray(pixel, place).unwrap().direction();
        assert!(direction(0, [0.0, 0.0]).distance(Vec3::new(-2.0, 1.0, -1.0)) < 1e-6);
        assert!(direction(7, [1.0, 1.0]).distance(Vec3::new(2.0, -1.0, -1.0)) < 1e-6);
        assert!(direction(6, [0.0, 0.0]).distance(Vec3::new(0.0, 0.0, -1.0)) < 1e-6);
    }
}
