//! Cases and errors of a campaign, over processor time.

use super::canvas::{Canvas, Sample, legend, path};
use super::labels::Rect;
use super::panel::{Axis, Panel, range};
use super::style::Series;
use super::ticks::Scale;

/// A part of a campaign.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch {
    /// Processor time in seconds.
    pub(crate) seconds: f64,
    /// Number of cases.
    pub(crate) cases: u64,
    /// Number of cases with an error.
    pub(crate) errors: u64,
}

/// Draws two charts, as SVG: the number of cases so far, and the bound on the error rate, on a logarithmic axis. With
/// no error in n cases the bound is 3/n (95 %). A red line marks a part with an error, and the bound ends there. Parts
/// follow each other, over the sum of their processor time.
///
/// ```
/// use crate::plots::{Stretch, plot_campaign};
///
/// let parts = [Stretch { seconds: 60.0, cases: 1000, errors: 0 }; 3];
/// assert!(plot_campaign("three minutes", &parts).contains("processor"));
/// ```
pub(crate) fn plot_campaign(title: &str, parts: &[Stretch]) -> String {
    draw((800.0, 660.0), title, parts).finish()
}

/// Time so far, cases so far, errors so far.
type Sum = (f64, u64, u64);

pub(super) fn draw(size: (f64, f64), title: &str, parts: &[Stretch]) -> Canvas {
    let seconds: f64 = parts.iter().map(|part| part.seconds).sum();
    let (unit, name) = match seconds {
        ..180.0 => (1.0, "seconds"),
        180.0..7200.0 => (60.0, "minutes"),
        _ => (3600.0, "hours"),
    };
    let time = format!("{name} of processor time");
    let sums: Vec<Sum> = parts
        .iter()
        .scan((0.0, 0_u64, 0_u64), |sum, part| {
            *sum = (sum.0 + part.seconds / unit, sum.1.saturating_add(part.cases), sum.2.saturating_add(part.errors));
            Some(*sum)
        })
        .collect();
    let (end, cases, _) = sums.last().copied().unwrap_or_default();
    let (end, cases) = (end.max(1e-9), cases.max(1) as f64);
    let wrong: Vec<f64> = sums.iter().zip(parts).filter(|(_, part)| part.errors > 0).map(|(&(at, ..), _)| at).collect();
    let is_clean = |sum: &&Sum| sum.2 == 0 && sum.1 > 0;
    let rates: Vec<_> = sums.iter().filter(is_clean).map(|&(at, cases, _)| (at, 3.0 / cases as f64)).collect();
    let counts: Vec<_> =
        [(0.0, 0.0)].into_iter().chain(sums.iter().map(|&(at, cases, _)| (at, cases as f64))).collect();
    let ends = range(rates.iter().map(|rate| rate.1), [1e-3, 1.0]);

    let mut canvas = Canvas::new(size, title);
    let mut top = canvas.heading();
    if !wrong.is_empty() {
        top = legend(&mut canvas, top, &[(Sample::Wrong, "a part with an error".to_owned())]);
    }
    let room = canvas.room(top + 4.0);
    let half = (room.height - 14.0) / 2.0;
    let rate = "bound on the error rate (95 %)";
    let cases = Axis { scale: &|most| Scale::linear([0.0, cases], most), title: "cases" };
    let rate = Axis { scale: &|most| Scale::log(ends, most), title: rate };
    for (i, (y, points)) in [(cases, counts), (rate, rates)].into_iter().enumerate() {
        let area = Rect { y: room.y + i as f64 * (half + 14.0), height: half, ..room };
        let x = Axis { scale: &|most| Scale::linear([0.0, end], most), title: &time };
        let panel = Panel::draw(&mut canvas, area, &x, &y);
        for &at in &wrong {
            let (x, _) = panel.at((at, 1.0));
            canvas.stroke("wrong", &path(&[(x, panel.frame.y), (x, panel.frame.bottom())]), 2.0, "none");
        }
        canvas.line(Series(0), &points.iter().map(|&point| panel.at(point)).collect::<Vec<_>>());
    }
    canvas
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_red_and_no_parts_are_drawn_too() {
        let part = |errors| Stretch { seconds: 30.0, cases: 500, errors };
        let red = "class=\"wrong\"";
        let [clean, wrong] = [0, 2].map(|errors| plot_campaign("t", &[part(0), part(errors), part(0)]));
        // One line in each chart, and one in the legend.
        assert!(!clean.contains(red) && wrong.matches(red).count() == 3, "{wrong}");
        let most = Stretch { seconds: 9e15, cases: u64::MAX, errors: u64::MAX };
        for parts in [&[][..], &[most, most]] {
            assert!(plot_campaign("extremes", parts).ends_with("</svg>\n"));
        }
    }
}
