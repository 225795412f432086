//! An SVG drawing that records the boxes of its texts.

use std::fmt::Write;

use super::labels::Rect;
use super::style::{Series, style};
use super::text::{LINE, SMALL, TITLE, escaped, markup, width, wrap};

/// The anchor of a text: left, middle or right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A drawing.
pub(super) struct Canvas {
    size: (f64, f64),
    title: String,
    body: String,
    /// The boxes of all texts.
    pub(super) texts: Vec<Rect>,
}

/// The width of the margins.
pub(super) const MARGIN: f64 = 14.0;

impl Canvas {
    /// An empty drawing; `title` is its accessible name.
    pub(super) fn new(size: (f64, f64), title: &str) -> Self {
        Self { size, title: title.to_owned(), body: String::new(), texts: Vec::new() }
    }

    /// The area within the margins, below `top`.
    pub(super) fn room(&self, top: f64) -> Rect {
        let (width, height) = self.size;
        Rect { x: MARGIN, y: top, width: width - 2.0 * MARGIN, height: height - MARGIN - top }
    }

    /// Draws the title at the top, and returns its lower end.
    pub(super) fn heading(&mut self) -> f64 {
        let (room, title) = (self.room(12.0), self.title.clone());
        self.paragraph(&title, TITLE, "ink", (room.x, room.y), room.width) + 4.0
    }

    /// Draws lines of text from the top downwards, and returns their lower end.
    pub(super) fn paragraph(&mut self, text: &str, size: f64, class: &str, (x, top): (f64, f64), room: f64) -> f64 {
        let mut y = top;
        for line in wrap(text, room, |part| width(part, size)) {
            self.text(&line, size, class, (x, y + size * LINE / 2.0), Anchor::Start);
            y += size * LINE + 1.0;
        }
        y
    }

    /// Draws a line of text, vertically centred at `y`, and returns its box.
    pub(super) fn text(&mut self, text: &str, size: f64, class: &str, (x, y): (f64, f64), anchor: Anchor) -> Rect {
        let taken = width(text, size);
        let (left, anchor) = match anchor {
            Anchor::Start => (x, "start"),
            Anchor::Middle => (x - taken / 2.0, "middle"),
            Anchor::End => (x - taken, "end"),
        };
        let label = Rect { x: left, y: y - size * LINE / 2.0, width: taken, height: size * LINE };
        let baseline = y + 0.345 * size;
        let bold = if size == TITLE { " font-weight=\"bold\"" } else { "" };
        let _ = writeln!(
            self.body,
            "<text class=\"{class}\" x=\"{x:.1}\" y=\"{baseline:.1}\" font-size=\"{size}\" text-anchor=\"{anchor}\"{bold}>{}</text>",
            markup(text, size)
        );
        self.texts.push(label);
        label
    }

    /// A filled shape.
    pub(super) fn fill(&mut self, class: &str, path: &str) {
        let _ = writeln!(self.body, "<path class=\"{class}\" d=\"{path}\" fill=\"currentColor\"/>");
    }

    /// Draws a line, from path data. `dash` is `none` or a list of lengths.
    pub(super) fn stroke(&mut self, class: &str, path: &str, width: f64, dash: &str) {
        let dash = if dash == "none" { String::new() } else { format!(" stroke-dasharray=\"{dash}\"") };
        let _ = writeln!(
            self.body,
            "<path class=\"{class}\" d=\"{path}\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"{width}\"{dash}/>"
        );
    }

    /// Draws the line of a series through points.
    pub(super) fn line(&mut self, series: Series, points: &[(f64, f64)]) {
        self.stroke(series.class(), &path(points), 2.0, series.dash());
    }

    /// Draws a marker of a series; a hollow marker shows the paper. Browsers show `meaning` as a tooltip.
    pub(super) fn marker(&mut self, series: Series, at: (f64, f64), is_hollow: bool, meaning: &str) {
        let shape = series.marker(at, 4.5);
        let _ = writeln!(self.body, "<g><title>{}</title>", escaped(meaning));
        self.fill(if is_hollow { "paper" } else { series.class() }, &shape);
        self.stroke(series.class(), &shape, if is_hollow { 1.8 } else { 0.5 }, "none");
        self.body += "</g>\n";
    }

    /// Returns the file.
    pub(super) fn finish(self) -> String {
        let (width, height) = self.size;
        format!(
            "<svg class=\"chart\" xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{}\">\n<style>{}</style>\n\
             <rect class=\"paper\" width=\"{width}\" height=\"{height}\" fill=\"currentColor\"/>\n{}</svg>\n",
            escaped(&self.title),
            style(),
            self.body
        )
    }
}

/// Path data of a line through points.
pub(super) fn path(points: &[(f64, f64)]) -> String {
    let mut path = String::new();
    for (i, (x, y)) in points.iter().enumerate() {
        let _ = write!(path, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
    }
    path
}

/// Path data of a rectangle.
pub(super) fn rectangle(Rect { x, y, width, height }: Rect) -> String {
    format!("M{x:.1} {y:.1}h{width:.1}v{height:.1}h-{width:.1}z")
}

/// An entry of a legend.
#[derive(Clone, Copy, Debug)]
pub(super) enum Sample {
    /// A line of a series, with its markers.
    Both(Series),
    /// Markers of a series.
    Marker(Series),
    /// Hollow markers, of any series.
    Hollow,
    /// Columns in a series' colour.
    Column(Series),
    /// The rings and the line of a Pareto front.
    Front,
    /// The mark of an error.
    Wrong,
}

/// Draws the legend, in several rows if necessary, and returns its lower end.
pub(super) fn legend(canvas: &mut Canvas, top: f64, entries: &[(Sample, String)]) -> f64 {
    const SAMPLE: f64 = 30.0;
    const ROW: f64 = 20.0;
    let room = canvas.room(top);
    let (mut x, mut y) = (room.x, top + ROW / 2.0);
    for (sample, text) in entries {
        let needed = SAMPLE + 6.0 + width(text, SMALL);
        if x > room.x && x + needed > room.right() {
            (x, y) = (room.x, y + ROW);
        }
        let (middle, ends) = ((x + SAMPLE / 2.0, y), [(x, y), (x + SAMPLE, y)]);
        match *sample {
            Sample::Both(series) => {
                canvas.line(series, &ends);
                canvas.marker(series, middle, false, text);
            }
            Sample::Marker(series) => canvas.marker(series, middle, false, text),
            Sample::Hollow => {
                let circle = Series(0).marker(middle, 4.5);
                canvas.stroke("soft", &circle, 1.8, "none");
                arrow(canvas, "soft", middle);
            }
            Sample::Column(series) => canvas.fill(series.class(), &rectangle(Rect::around(middle, 14.0, 12.0))),
            Sample::Front => {
                canvas.stroke("soft", &path(&ends), 1.5, "none");
                ring(canvas, middle);
            }
            Sample::Wrong => canvas.stroke("wrong", &path(&[(middle.0, y - 7.0), (middle.0, y + 7.0)]), 2.0, "none"),
        }
        canvas.text(text, SMALL, "ink", (x + SAMPLE + 6.0, y), Anchor::Start);
        x += needed + 18.0;
    }
    if entries.is_empty() { top } else { y + ROW / 2.0 }
}

/// Draws an arrow below a hollow marker: the value is less.
pub(super) fn arrow(canvas: &mut Canvas, class: &str, (x, y): (f64, f64)) {
    canvas.fill(class, &(path(&[(x - 3.0, y + 7.0), (x + 3.0, y + 7.0), (x, y + 12.0)]) + "z"));
}

/// Draws the ring around a point of a Pareto front.
pub(super) fn ring(canvas: &mut Canvas, at: (f64, f64)) {
    canvas.stroke("soft", &Series(0).marker(at, 8.0), 1.2, "none");
}
