//! Cost against error: which choices nobody beats in both, and a picture of it.

use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

/// A choice with what it costs and how often it errs.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// What is written beside its point.
    pub label: String,
    /// Choices with the same number have the same colour.
    pub family: usize,
    /// Time, in units of a baseline's.
    pub cost: f64,
    /// Errors in 10^9 rays.
    pub errors: Errors,
}

/// How often something errs, in 10^9 rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Errors {
    /// This often.
    Observed(f64),
    /// Never in the rays that were traced: with a probability of 95 %, not more often than this.
    Below(f64),
}

impl Errors {
    /// From the number of errors in so many rays. None in N is less than 3 in N with a probability of 95 %, as
    /// (1 - 3/N)^N is about e^-3.
    pub fn of(events: u64, rays: u64) -> Self {
        match events {
            0 => Self::Below(3e9 / rays as f64),
            _ => Self::Observed(events as f64 * 1e9 / rays as f64),
        }
    }

    /// The rate that was seen: 0 where there was no error.
    pub fn observed(self) -> f64 {
        match self {
            Self::Observed(rate) => rate,
            Self::Below(_) => 0.0,
        }
    }

    /// Where the point is drawn.
    fn height(self) -> f64 {
        match self {
            Self::Observed(rate) | Self::Below(rate) => rate,
        }
    }
}

/// For each choice, whether it is on the Pareto front: no other costs no more and errs no more often, and is better in
/// one of these. Of choices that are equal in both, all are on it or none. Not being known (NaN), a cost is never on
/// it.
pub fn front(choices: &[Choice]) -> Vec<bool> {
    let beats = |a: &Choice, b: &Choice| {
        let (a_errors, b_errors) = (a.errors.observed(), b.errors.observed());
        a.cost <= b.cost && a_errors <= b_errors && (a.cost < b.cost || a_errors < b_errors)
    };
    choices.iter().map(|b| !b.cost.is_nan() && !choices.iter().any(|a| beats(a, b))).collect()
}

/// Cost against errors, one chart below the other, each with its title, as SVG: the vertical axis is logarithmic, the
/// front a line through rings. Where no error was seen, a hollow point with an arrow stands at what bounds the rate.
///
/// # Errors
/// What the drawing library reports, in words.
pub fn plot_pareto(charts: &[(&str, &[Choice])], cost: &str) -> Result<String, String> {
    let mut svg = String::new();
    draw(&mut svg, charts, cost).map_err(|error| error.to_string())?;
    Ok(svg)
}

/// Size of a chart in pixels.
const SIZE: (u32, u32) = (960, 560);
const FONT: (&str, i32) = ("sans-serif", 12);
/// About what a letter of [`FONT`] takes.
const LETTER: (i32, i32) = (7, 14);
/// Dark enough for text.
const COLORS: [RGBColor; 6] = [
    RGBColor(190, 75, 0),
    RGBColor(170, 20, 40),
    RGBColor(120, 60, 150),
    RGBColor(40, 90, 180),
    RGBColor(0, 120, 125),
    RGBColor(0, 110, 40),
];

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, LogCoord<f64>>>;
type Drawn = Result<(), Box<dyn std::error::Error>>;

fn draw(svg: &mut String, charts: &[(&str, &[Choice])], cost: &str) -> Drawn {
    let count = charts.len().max(1);
    let root = SVGBackend::with_string(svg, (SIZE.0, SIZE.1 * count as u32)).into_drawing_area();
    root.fill(&WHITE)?;
    for (area, (title, choices)) in root.split_evenly((count, 1)).iter().zip(charts) {
        draw_chart(area, title, choices, cost)?;
    }
    root.present()?;
    Ok(())
}

fn draw_chart(area: &Area<'_>, title: &str, choices: &[Choice], cost: &str) -> Drawn {
    let known: Vec<_> = choices.iter().filter(|choice| choice.cost.is_finite()).cloned().collect();
    let (least, most) = range(known.iter().map(|choice| choice.cost), 1.0);
    let (low, high) = range(known.iter().map(|choice| choice.errors.height().log10()), 3.0);
    let margin = 0.06 * (most - least).max(0.1);
    let mut chart = ChartBuilder::on(area)
        .caption(title, ("sans-serif", 20))
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(64)
        .build_cartesian_2d(
            least - margin..most + 2.0 * margin,
            (10f64.powf(low.floor() - 0.3)..10f64.powf(high + 0.4)).log_scale(),
        )?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.1))
        .x_desc(cost)
        .y_desc("errors of the most frequent kind in 10^9 rays")
        .y_label_formatter(&|rate| format!("{rate:.0e}"))
        .draw()?;
    let on_front = front(&known);
    let mut corners: Vec<_> =
        known.iter().zip(&on_front).filter(|&(_, &on)| on).map(|(c, _)| (c.cost, c.errors.height())).collect();
    corners.sort_by(|a, b| a.0.total_cmp(&b.0));
    if corners.len() > 1 {
        chart.draw_series(LineSeries::new(corners, BLACK.mix(0.35).stroke_width(2)))?;
    }
    area.draw(&Text::new("hollow: none seen, rarer than this (95 %)", (76, SIZE.1 as i32 - 24), FONT.into_font()))?;
    draw_points(area, &chart, &known, &on_front)
}

fn draw_points(area: &Area<'_>, chart: &Chart<'_, '_>, choices: &[Choice], on_front: &[bool]) -> Drawn {
    // In pixels of the chart's own area.
    let (left, top) = area.get_base_pixel();
    let at = |choice: &Choice| {
        let (x, y) = chart.backend_coord(&(choice.cost, choice.errors.height()));
        (x - left, y - top)
    };
    let points: Vec<_> = choices.iter().map(at).collect();
    let mut taken: Vec<Rectangle> =
        points.iter().map(|&(x, y)| Rectangle { x: x - 5, y: y - 5, width: 10, height: 14 }).collect();
    for ((choice, &(x, y)), &on) in choices.iter().zip(&points).zip(on_front) {
        let color = COLORS[choice.family % COLORS.len()];
        if on {
            area.draw(&Circle::new((x, y), 7, BLACK.mix(0.6).stroke_width(1)))?;
        }
        match choice.errors {
            Errors::Observed(_) => area.draw(&Circle::new((x, y), 4, color.filled()))?,
            Errors::Below(_) => {
                area.draw(&Circle::new((x, y), 4, WHITE.filled()))?;
                area.draw(&Circle::new((x, y), 4, color.stroke_width(2)))?;
                area.draw(&Polygon::new([(x - 3, y + 5), (x + 3, y + 5), (x, y + 10)], color))?;
            }
        }
        let size = (LETTER.0 * choice.label.chars().count() as i32, LETTER.1);
        let label = place(&taken, (x, y), size);
        taken.push(label);
        let nearest = (x.clamp(label.x, label.x + label.width), y.clamp(label.y, label.y + label.height));
        if (nearest.0 - x).abs().max((nearest.1 - y).abs()) > 12 {
            area.draw(&PathElement::new([(x, y), nearest], color.mix(0.5)))?;
        }
        let style = TextStyle::from(FONT.into_font()).color(&color);
        area.draw(&Text::new(choice.label.as_str(), (label.x, label.y), style))?;
    }
    Ok(())
}

/// Least and greatest number; around `default` if there is none.
fn range(numbers: impl Iterator<Item = f64>, default: f64) -> (f64, f64) {
    let (least, most) =
        numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), x| (least.min(x), most.max(x)));
    if least <= most { (least, most) } else { (default, default) }
}

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug)]
struct Rectangle {
    x: i32,
    y: i32,
    width: i32,
    height: i32,
}

impl Rectangle {
    fn overlaps(&self, other: &Self) -> bool {
        let apart = |a: i32, a_size: i32, b: i32, b_size: i32| a + a_size <= b || b + b_size <= a;
        !apart(self.x, self.width, other.x, other.width) && !apart(self.y, self.height, other.y, other.height)
    }

    fn is_within_chart(&self) -> bool {
        self.x >= 76
            && self.y >= 40
            && self.x + self.width <= SIZE.0 as i32 - 8
            && self.y + self.height <= SIZE.1 as i32 - 60
    }
}

/// The free place for a label that is nearest to its point; beside it if there is none.
fn place(taken: &[Rectangle], (x, y): (i32, i32), (width, height): (i32, i32)) -> Rectangle {
    let beside = Rectangle { x: x + 8, y: y - height / 2, width, height };
    let rings = (0..40).flat_map(|ring| {
        let (dx, dy) = (8 + 6 * ring, 8 + 6 * ring);
        [
            Rectangle { x: x + dx, ..beside },
            Rectangle { x: x - dx - width, ..beside },
            Rectangle { x: x - width / 2, y: y - dy - height, ..beside },
            Rectangle { x: x - width / 2, y: y + dy + 4, ..beside },
            Rectangle { x: x + 8, y: y - dy - height, ..beside },
            Rectangle { x: x + 8, y: y + dy, ..beside },
            Rectangle { x: x - 8 - width, y: y - dy - height, ..beside },
            Rectangle { x: x - 8 - width, y: y + dy, ..beside },
        ]
    });
    let mut rings = rings;
    rings.find(|place| place.is_within_chart() && !taken.iter().any(|other| other.overlaps(place))).unwrap_or(beside)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn choice(label: &str, cost: f64, events: u64) -> Choice {
        Choice { label: label.to_owned(), family: 7, cost, errors: Errors::of(events, 1_000_000) }
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
        // Equals do not beat each other, and no error beats one, whatever the bound.
        assert_eq!(on_front(&[(1.0, 0), (1.0, 0), (1.0, 1)]), [true, true, false]);
        assert_eq!(on_front(&[(f64::NAN, 0), (2.0, 7)]), [false, true]);
    }

    #[test]
    fn labels_keep_apart() {
        let mut taken = Vec::new();
        for _ in 0..18 {
            let label = place(&taken, (300, 200), (120, 14));
            assert!(!taken.iter().any(|other: &Rectangle| other.overlaps(&label)), "{label:?}");
            taken.push(label);
        }
    }

    #[test]
    fn charts_are_drawn_whatever_is_in_them() {
        let some = [choice("one & other", 1.0, 1000), choice("never", 1.2, 0), choice("unknown", f64::NAN, 5)];
        let svg = plot_pareto(&[("first", &some), ("second", &[])], "time").unwrap();
        assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"), "{svg}");
        for text in ["first", "second", "one &amp; other", "never", "time"] {
            assert!(svg.contains(text), "{text}: {svg}");
        }
        assert!(!svg.contains("unknown"));
        assert!(plot_pareto(&[], "time").unwrap().starts_with("<svg"));
    }
}
