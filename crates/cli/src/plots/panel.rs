//! Two axes with a frame, and the mapping of numbers to pixels.

use super::canvas::{Anchor, Canvas, path};
use super::labels::Rect;
use super::text::{LINE, SMALL, width, wrap};
use super::ticks::Scale;

/// An axis: its scale, for a maximum number of steps, and its title.
pub(super) struct Axis<'a> {
    pub(super) scale: &'a dyn Fn(usize) -> Scale,
    pub(super) title: &'a str,
}

/// The area of the data.
pub(super) struct Panel {
    pub(super) frame: Rect,
    x: Scale,
    y: Scale,
}

/// Pixels between an axis and its numbers.
const GAP: f64 = 6.0;
/// Pixels between the horizontal axis and its numbers. The lowest number of the other axis ends above them.
const BELOW: f64 = 9.0;
/// Minimum space between two numbers.
const APART: f64 = 14.0;
/// Minimum width of the numbers of a vertical axis, so that axes of most charts align.
const NUMBERS: f64 = 52.0;

impl Panel {
    /// Draws the axes. The title of the vertical axis is above it.
    pub(super) fn draw(canvas: &mut Canvas, room: Rect, x: &Axis<'_>, y: &Axis<'_>) -> Self {
        let line = SMALL * LINE;
        let top = canvas.paragraph(y.title, SMALL, "soft", (room.x, room.y), room.width) + 11.0;
        let below = wrap(x.title, room.width * 0.9, |part| width(part, SMALL));
        let bottom = room.bottom() - line * below.len() as f64 - BELOW - line - GAP;
        let height = (bottom - top).max(20.0);
        let y_scale = (y.scale)(((height / 34.0) as usize).clamp(1, 10));
        let texts: Vec<String> = y_scale.ticks.iter().map(|&tick| (y_scale.format)(tick)).collect();
        let left = room.x + texts.iter().map(|text| width(text, SMALL)).fold(NUMBERS, f64::max) + GAP;
        // Half of the rightmost number is outside the frame.
        let fits = |scale: &Scale| {
            let widths: Vec<f64> = scale.ticks.iter().map(|&tick| width(&(scale.format)(tick), SMALL)).collect();
            let right = room.right() - widths.last().map_or(0.0, |width| width / 2.0);
            let at = |i: usize| left + scale.share(scale.ticks[i]) * (right - left);
            let free = |i: usize| at(i) - at(i - 1) - widths[i].midpoint(widths[i - 1]) >= APART;
            (1..widths.len()).all(free).then_some(right)
        };
        let (x_scale, right) = (1..=10)
            .rev()
            .find_map(|most| {
                let scale = (x.scale)(most);
                fits(&scale).map(|right| (scale, right))
            })
            .unwrap_or_else(|| {
                // Two numbers do not fit: keep the first.
                let mut scale = (x.scale)(1);
                scale.ticks.truncate(1);
                (scale, room.right())
            });
        let frame = Rect { x: left, y: top, width: right - left, height };
        let panel = Self { frame, x: x_scale, y: y_scale };
        panel.draw_axes(canvas, &texts);
        let mut y = bottom + BELOW + line + GAP + line / 2.0;
        for text in below {
            let half = width(&text, SMALL) / 2.0;
            let middle = (left + frame.width / 2.0).clamp(room.x + half, (room.right() - half).max(room.x + half));
            canvas.text(&text, SMALL, "soft", (middle, y), Anchor::Middle);
            y += line;
        }
        panel
    }

    fn draw_axes(&self, canvas: &mut Canvas, texts: &[String]) {
        let Rect { x: left, y: top, .. } = self.frame;
        let (right, bottom) = (self.frame.right(), self.frame.bottom());
        for (&tick, text) in self.y.ticks.iter().zip(texts) {
            let y = bottom - self.y.share(tick) * self.frame.height;
            canvas.stroke("grid", &path(&[(left, y), (right, y)]), 1.0, "none");
            canvas.text(text, SMALL, "ink", (left - GAP, y), Anchor::End);
        }
        for &tick in &self.x.ticks {
            let x = left + self.x.share(tick) * self.frame.width;
            canvas.stroke("soft", &path(&[(x, bottom), (x, bottom + 4.0)]), 1.0, "none");
            let below = (x, bottom + BELOW + SMALL * LINE / 2.0);
            canvas.text(&(self.x.format)(tick), SMALL, "ink", below, Anchor::Middle);
        }
        canvas.stroke("soft", &path(&[(left, top), (left, bottom), (right, bottom)]), 1.0, "none");
    }

    /// The pixel position of a pair of numbers.
    pub(super) fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let Rect { x: left, width, height, .. } = self.frame;
        (left + self.x.share(x) * width, self.frame.bottom() - self.y.share(y) * height)
    }
}

/// Minimum and maximum of some numbers; `without` if there are none.
pub(super) fn range(numbers: impl Iterator<Item = f64>, without: [f64; 2]) -> [f64; 2] {
    let ends = numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
    if ends[0] <= ends[1] { ends } else { without }
}
