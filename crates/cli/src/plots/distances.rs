//! The chart of backtracking distances.

use stackless_bvh::internals::event::Backtracks;

use super::canvas::{Canvas, Sample, legend, rectangle};
use super::labels::Rect;
use super::panel::{Axis, Panel};
use super::style::Series;
use super::ticks::Scale;

/// A histogram of backtracking distances with the cumulative share, as SVG (Binder & Keller 2016, Fig. 3).
///
/// Bars are shares of all backtracks, by the level of the ancestor whose sibling comes next. The line is the cumulative
/// share.
pub(crate) fn plot_distances(title: &str, backtracks: &Backtracks) -> String {
    let total = backtracks.total().max(1) as f64;
    let shares: Vec<f64> = backtracks.distances().iter().map(|&count| count as f64 / total).collect();
    draw((800.0, 480.0), title, &shares).finish()
}

pub(super) fn draw(size: (f64, f64), title: &str, shares: &[f64]) -> Canvas {
    let mut canvas = Canvas::new(size, title);
    let top = canvas.heading();
    let (bars, sum) = (Series(0), Series(1));
    let entries = [
        (Sample::Column(bars), "share of backtracks at this distance".to_owned()),
        (Sample::Both(sum), "share at this distance or less".to_owned()),
    ];
    let top = legend(&mut canvas, top, &entries) + 10.0;
    let x = Axis {
        scale: &|most| Scale::columns(shares.len(), most),
        title: "levels up to the ancestor whose sibling comes next (0: sibling, 1: uncle, 2: grand uncle)",
    };
    let percent = |most| {
        let mut scale = Scale::linear([0.0, 1.0], most);
        scale.format = |share| format!("{:.0} %", share * 100.0);
        scale
    };
    let room = canvas.room(top);
    let panel = Panel::draw(&mut canvas, room, &x, &Axis { scale: &percent, title: "share of backtracks" });
    for (level, &share) in shares.iter().enumerate() {
        let (left, top) = panel.at((level as f64 - 0.4, share));
        let (right, bottom) = panel.at((level as f64 + 0.4, 0.0));
        let bar = Rect { x: left, y: top, width: right - left, height: bottom - top };
        canvas.fill(bars.class(), &rectangle(bar));
    }
    let sums = shares.iter().scan(0.0, |sum, share| {
        *sum += share;
        Some(*sum)
    });
    let sums: Vec<(f64, f64)> = sums.enumerate().map(|(level, sum)| (level as f64, sum)).collect();
    let points: Vec<_> = sums.iter().map(|&point| panel.at(point)).collect();
    canvas.line(sum, &points);
    for (&point, (level, share)) in points.iter().zip(&sums) {
        canvas.marker(sum, point, false, &format!("{level} levels or less: {:.1} %", share * 100.0));
    }
    canvas
}

#[cfg(test)]
mod tests {
    use super::*;
    use stackless_bvh::tree::Reach;

    #[test]
    fn an_empty_count_is_drawn_too() {
        let svg = plot_distances("nothing", &Backtracks::new(Reach::ALGORITHM_1));
        assert!(svg.starts_with("<svg") && svg.contains("nothing") && svg.ends_with("</svg>\n"), "{svg}");
    }
}
