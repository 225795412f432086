//! What a campaign has seen, over the time that it took.

use plotters::prelude::*;

/// A part of a campaign.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    /// Seconds of processor time.
    pub seconds: f64,
    /// Number of cases.
    pub cases: u64,
    /// How many of them went wrong.
    pub errors: u64,
}

/// Two charts, as SVG: the cases of all parts so far, and what bounds the rate of errors after them, on a logarithmic axis.
/// With no error in n cases that is 3/n (95 %). A part with an error is a red line, and from there on no bound is drawn.
/// Parts stand one after the other, over the sum of their processor time.
///
/// ```
/// use stackless_cli::plots::{Stretch, plot_campaign};
///
/// let parts = [Stretch { seconds: 60.0, cases: 1000, errors: 0 }; 3];
/// assert!(plot_campaign("three minutes", &parts)?.contains("processor"));
/// # Ok::<(), String>(())
/// ```
///
/// # Errors
/// What the drawing library reports, in words.
pub fn plot_campaign(title: &str, parts: &[Stretch]) -> Result<String, String> {
    let mut svg = String::new();
    draw(&mut svg, title, parts).map_err(|error| error.to_string())?;
    Ok(svg)
}

/// Width and height of a chart in pixels.
const SIZE: (u32, u32) = (800, 320);
const RED: RGBColor = RGBColor(170, 20, 40);
const BLUE: RGBColor = RGBColor(40, 90, 180);

/// Time so far, cases so far, errors so far.
type Sum = (f64, u64, u64);
type Drawn = Result<(), Box<dyn std::error::Error>>;

fn draw(svg: &mut String, title: &str, parts: &[Stretch]) -> Drawn {
    let seconds: f64 = parts.iter().map(|part| part.seconds).sum();
    let (unit, name) = if seconds < 7200.0 { (60.0, "minutes") } else { (3600.0, "hours") };
    let time = format!("{name} of processor time");
    let sums: Vec<Sum> = parts
        .iter()
        .scan((0.0, 0_u64, 0_u64), |sum, part| {
            *sum = (sum.0 + part.seconds / unit, sum.1.saturating_add(part.cases), sum.2 + part.errors);
            Some(*sum)
        })
        .collect();
    let (end, cases, _) = sums.last().copied().unwrap_or_default();
    let (end, cases) = (end.max(1e-9), cases.max(1) as f64);
    let wrong: Vec<f64> = sums.iter().zip(parts).filter(|(_, part)| part.errors > 0).map(|(&(at, ..), _)| at).collect();
    let root = SVGBackend::with_string(svg, (SIZE.0, 2 * SIZE.1)).into_drawing_area();
    root.fill(&WHITE)?;
    let areas = root.split_evenly((2, 1));
    let start = [(0.0, 0.0)].into_iter();

    let mut chart = ChartBuilder::on(&areas[0])
        .caption(title, ("sans-serif", 20))
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(76)
        .build_cartesian_2d(0.0..end, 0.0..cases * 1.05)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.1))
        .x_desc(&time)
        .y_desc("cases")
        .y_label_formatter(&|cases| format!("{cases:.1e}"))
        .draw()?;
    let counts = start.chain(sums.iter().map(|&(at, cases, _)| (at, cases as f64)));
    chart.draw_series(LineSeries::new(counts, BLUE.stroke_width(2)))?;
    chart.draw_series(wrong.iter().map(|&at| PathElement::new([(at, 0.0), (at, cases * 1.05)], RED)))?;

    let is_clean = |sum: &&Sum| sum.2 == 0 && sum.1 > 0;
    let rates: Vec<_> = sums.iter().filter(is_clean).map(|&(at, cases, _)| (at, 3.0 / cases as f64)).collect();
    // Whole decades.
    let low = 10_f64.powf(rates.iter().map(|rate| rate.1).fold(1.0, f64::min).log10().floor());
    let high = 10_f64.powf(rates.iter().map(|rate| rate.1).fold(low, f64::max).log10().floor() + 1.0);
    let mut chart = ChartBuilder::on(&areas[1])
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(76)
        .build_cartesian_2d(0.0..end, (low..high).log_scale())?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.1))
        .x_desc(&time)
        .y_desc("rate of errors, below this (95 %)")
        .y_labels(5)
        .y_label_formatter(&|rate| format!("{rate:.0e}"))
        .draw()?;
    chart.draw_series(LineSeries::new(rates, BLUE.stroke_width(2)))?;
    chart.draw_series(wrong.iter().map(|&at| PathElement::new([(at, low), (at, high)], RED)))?;
    root.present()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_red_and_no_parts_are_drawn_too() {
        let part = |errors| Stretch { seconds: 30.0, cases: 500, errors };
        let red = "#AA1428";
        let [clean, wrong] = [0, 2].map(|errors| plot_campaign("t", &[part(0), part(errors), part(0)]).unwrap());
        assert!(!clean.contains(red) && wrong.matches(red).count() == 2, "{wrong}");
        assert!(plot_campaign("nothing", &[]).unwrap().ends_with("</svg>\n"));
    }
}
