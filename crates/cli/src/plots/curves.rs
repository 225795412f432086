//! Lines over two logarithmic axes.

use super::canvas::{Canvas, Sample, legend};
use super::panel::{Axis, Panel, range};
use super::style::Series;
use super::ticks::Scale;

/// A line of a chart: its name, and its points in order.
#[derive(Clone, Debug)]
pub struct Line {
    /// What the legend says.
    pub name: String,
    /// Positive numbers.
    pub points: Vec<(f64, f64)>,
}

/// Lines over two logarithmic axes, each with its title, as SVG.
///
/// ```
/// use stackless_cli::plots::{Line, plot_lines};
///
/// let line = Line { name: "stack".to_owned(), points: vec![(1e-3, 200.0), (1e-9, 700.0)] };
/// assert!(plot_lines("time against error", ["error", "time"], &[line]).contains("stack"));
/// ```
pub fn plot_lines(title: &str, axes: [&str; 2], lines: &[Line]) -> String {
    draw((800.0, 520.0), title, axes, lines).finish()
}

pub(super) fn draw(size: (f64, f64), title: &str, [x, y]: [&str; 2], lines: &[Line]) -> Canvas {
    let points = || lines.iter().flat_map(|line| &line.points);
    let (across, up) = (range(points().map(|it| it.0), [1.0, 10.0]), range(points().map(|it| it.1), [1.0, 10.0]));
    let mut canvas = Canvas::new(size, title);
    let top = canvas.heading();
    let entries = lines.iter().enumerate().map(|(i, line)| (Sample::Both(Series(i)), line.name.clone()));
    let top = legend(&mut canvas, top, &entries.collect::<Vec<_>>()) + 10.0;
    let room = canvas.room(top);
    let x = Axis { scale: &|most| Scale::log(across, most), title: x };
    let panel = Panel::draw(&mut canvas, room, &x, &Axis { scale: &|most| Scale::log(up, most), title: y });
    for (i, line) in lines.iter().enumerate() {
        let at: Vec<_> = line.points.iter().map(|&point| panel.at(point)).collect();
        canvas.line(Series(i), &at);
        for (&at, (x, y)) in at.iter().zip(&line.points) {
            canvas.marker(Series(i), at, false, &format!("{}: {x:.2e}, {y:.4}", line.name));
        }
    }
    canvas
}
