//! The Pareto front of cost and error, and its chart.

use super::canvas::{Anchor, Canvas, Sample, arrow, legend, path, ring};
use super::labels::{Placed, Rect, place};
use super::panel::{Axis, Panel, range};
use super::style::Series;
use super::text::{LINE, SMALL, TITLE, width};
use super::ticks::Scale;

/// A choice with its cost and its error rate.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Choice {
    /// The label of its point.
    pub(crate) label: String,
    /// Choices of a family share a colour and a marker. The legend explains them.
    pub(crate) family: String,
    /// Time, relative to a baseline.
    pub(crate) cost: f64,
    /// Errors per 10^9 rays.
    pub(crate) errors: Errors,
}

/// An error rate, per 10^9 rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Errors {
    /// The observed rate.
    Observed(f64),
    /// No error was observed; upper bound of the rate, with a probability of 95 %.
    Below(f64),
}

impl Errors {
    /// The rate from the number of errors in `rays` rays. If N rays have no error, the rate is below 3/N with a
    /// probability of 95 %, because (1 - 3/N)^N is about e^-3.
    pub(crate) fn of(events: u64, rays: u64) -> Self {
        match events {
            0 => Self::Below(3e9 / rays as f64),
            _ => Self::Observed(events as f64 * 1e9 / rays as f64),
        }
    }

    /// The observed rate.
    pub(crate) fn observed(self) -> f64 {
        match self {
            Self::Observed(rate) => rate,
            Self::Below(_) => 0.0,
        }
    }

    /// The vertical position of the point.
    fn height(self) -> f64 {
        match self {
            Self::Observed(rate) | Self::Below(rate) => rate,
        }
    }
}

/// For each choice, whether it is on the Pareto front: no choice is better in cost or errors without being worse in the
/// other. Equal choices are all on the front, or none of them. An unknown cost (NaN) is never on the front.
pub(crate) fn front(choices: &[Choice]) -> Vec<bool> {
    let beats = |a: &Choice, b: &Choice| {
        let (a_errors, b_errors) = (a.errors.observed(), b.errors.observed());
        a.cost <= b.cost && a_errors <= b_errors && (a.cost < b.cost || a_errors < b_errors)
    };
    choices.iter().map(|b| !b.cost.is_nan() && !choices.iter().any(|a| beats(a, b))).collect()
}

/// Draws cost against errors, as SVG: one chart below the other, each with its title. The vertical axis is logarithmic,
/// and the front is a line through rings. Without observed errors, a hollow point with an arrow shows the bound of the
/// rate.
pub(crate) fn plot_pareto(charts: &[(&str, &[Choice])], cost: &str) -> String {
    draw((960.0, 90.0 + 520.0 * charts.len().max(1) as f64), charts, cost).finish()
}

pub(super) fn draw(size: (f64, f64), charts: &[(&str, &[Choice])], cost: &str) -> Canvas {
    let mut families: Vec<&str> = Vec::new();
    for choice in charts.iter().flat_map(|(_, choices)| *choices) {
        if !families.contains(&choice.family.as_str()) {
            families.push(&choice.family);
        }
    }
    let mut canvas = Canvas::new(size, "cost against error");
    let mut entries: Vec<_> =
        (0..).zip(&families).map(|(i, family)| (Sample::Marker(Series(i)), (*family).to_owned())).collect();
    entries.push((Sample::Hollow, "no error: the rate is lower (95 %)".to_owned()));
    entries.push((Sample::Front, "Pareto front".to_owned()));
    let top = legend(&mut canvas, 12.0, &entries);
    let room = canvas.room(top + 10.0);
    let height = room.height / charts.len().max(1) as f64;
    for (i, (title, choices)) in charts.iter().enumerate() {
        let area = Rect { y: room.y + i as f64 * height, height: height - 14.0, ..room };
        draw_chart(&mut canvas, area, title, (choices, &families), cost);
    }
    canvas
}

fn draw_chart(canvas: &mut Canvas, area: Rect, title: &str, (choices, families): (&[Choice], &[&str]), cost: &str) {
    let known: Vec<_> = choices.iter().filter(|choice| choice.cost.is_finite()).cloned().collect();
    let costs = range(known.iter().map(|choice| choice.cost), [0.9, 1.1]);
    let heights = range(known.iter().map(|choice| choice.errors.height()), [1e3, 1e9]);
    let top = canvas.paragraph(title, TITLE, "ink", (area.x, area.y), area.width) + 4.0;
    let area = Rect { y: top, height: area.bottom() - top, ..area };
    // Labels need space left and right of the points, and the lowest points have an arrow below them.
    let margin = 0.05 * (costs[1] - costs[0]).max(0.02);
    let costs = [costs[0] - margin, costs[1] + margin];
    let y = Axis {
        scale: &|most| Scale::log([heights[0] * 0.5, heights[1] * 1.5], most),
        title: "errors of the most frequent kind in 10^9 rays",
    };
    let x = Axis { scale: &|most| Scale::linear(costs, most), title: cost };
    let panel = Panel::draw(canvas, area, &x, &y);
    let points: Vec<_> = known.iter().map(|choice| panel.at((choice.cost, choice.errors.height()))).collect();
    let on_front = front(&known);
    let mut corners: Vec<_> = points.iter().zip(&on_front).filter(|&(_, &on)| on).map(|(&point, _)| point).collect();
    corners.sort_by(|a, b| a.0.total_cmp(&b.0));
    canvas.stroke("soft", &path(&corners), 1.5, "none");
    for ((choice, &at), &on) in known.iter().zip(&points).zip(&on_front) {
        let (series, is_hollow) = (series(choice, families), matches!(choice.errors, Errors::Below(_)));
        if on {
            ring(canvas, at);
        }
        if is_hollow {
            arrow(canvas, series.class(), at);
        }
        let bound = if is_hollow { "less than " } else { "" };
        let rate = choice.errors.height();
        let meaning = format!("{} + {}: {:.3}, {bound}{rate:.0} in 10^9", choice.family, choice.label, choice.cost);
        canvas.marker(series, at, is_hollow, &meaning.replace('^', ""));
    }
    let sizes: Vec<_> = known.iter().map(|choice| (width(&choice.label, SMALL), SMALL * LINE)).collect();
    let lines: Vec<_> = corners.windows(2).map(|pair| (pair[0], pair[1])).collect();
    for (choice, placed) in known.iter().zip(place(&panel.frame, &points, &sizes, &lines)) {
        let Some(Placed { label, leader }) = placed else { continue };
        let class = series(choice, families).class();
        if let Some((from, to)) = leader {
            canvas.stroke(class, &path(&[from, to]), 1.0, "none");
        }
        let middle = (label.x + label.width / 2.0, label.y + label.height / 2.0);
        canvas.text(&choice.label, SMALL, class, middle, Anchor::Middle);
    }
}

fn series(choice: &Choice, families: &[&str]) -> Series {
    Series(families.iter().position(|family| *family == choice.family).unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn choice(label: &str, cost: f64, events: u64) -> Choice {
        Choice { label: label.to_owned(), family: "f".to_owned(), cost, errors: Errors::of(events, 1_000_000) }
    }

    #[test]
    fn rates_are_those_of_a_billion() {
        assert_eq!(Errors::of(2, 1000), Errors::Observed(2e6));
        assert_eq!(Errors::of(0, 1000), Errors::Below(3e6));
        assert_eq!(Errors::of(0, 1000).observed(), 0.0);
    }

    #[test]
    fn nobody_on_the_front_is_beaten() {
        let on_front = |choices: &[(f64, u64)]| {
            front(&choices.iter().map(|&(cost, events)| choice("", cost, events)).collect::<Vec<_>>())
        };
        assert!(front(&[]).is_empty());
        assert_eq!(on_front(&[(1.0, 9), (1.1, 5), (1.2, 5), (1.2, 0), (0.9, 9)]), [false, true, false, true, true]);
        // Equal choices do not beat each other. No observed error beats any error, independent of the bound.
        assert_eq!(on_front(&[(1.0, 0), (1.0, 0), (1.0, 1)]), [true, true, false]);
        assert_eq!(on_front(&[(f64::NAN, 0), (2.0, 7)]), [false, true]);
    }

    #[test]
    fn charts_are_drawn_whatever_is_in_them() {
        let some = [choice("one & other", 1.0, 1000), choice("never", 1.2, 0), choice("unknown", f64::NAN, 5)];
        let svg = plot_pareto(&[("first", &some), ("second", &[])], "time");
        assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"), "{svg}");
        for text in ["first", "second", "one &amp; other", "never", "time"] {
            assert!(svg.contains(text), "{text}: {svg}");
        }
        assert!(!svg.contains("unknown"));
        assert!(plot_pareto(&[], "time").starts_with("<svg"));
    }
}
