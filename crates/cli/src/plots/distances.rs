//! Pictures.

use plotters::prelude::*;

use stackless_bvh::event::Backtracks;

/// A histogram of backtracking distances with the cumulative share, as SVG (Binder & Keller 2016, Fig. 3).
///
/// Bars are shares of all backtracks, by the level of the ancestor whose sibling comes next; the line is their sum.
///
/// # Errors
/// What the drawing library reports, in words.
pub fn plot_distances(title: &str, backtracks: &Backtracks) -> Result<String, String> {
    let mut svg = String::new();
    draw(&mut svg, title, backtracks).map_err(|error| error.to_string())?;
    Ok(svg)
}

fn draw(svg: &mut String, title: &str, backtracks: &Backtracks) -> Result<(), Box<dyn std::error::Error>> {
    let total = backtracks.total().max(1) as f64;
    let shares: Vec<f64> = backtracks.distances().iter().map(|&count| count as f64 / total).collect();
    let levels = shares.len().max(1) as u32;
    let root = SVGBackend::with_string(svg, (800, 480)).into_drawing_area();
    root.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&root)
        .caption(title, ("sans-serif", 22))
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(56)
        .build_cartesian_2d((0..levels - 1).into_segmented(), 0.0..1.0)?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .x_desc("levels up to the ancestor whose sibling comes next (0: sibling, 1: uncle, 2: grand uncle)")
        .y_desc("share of backtracks")
        .y_label_formatter(&|share| format!("{:.0} %", share * 100.0))
        .draw()?;
    let bars = Histogram::vertical(&chart).style(BLACK.mix(0.7).filled()).margin(3);
    chart.draw_series(bars.data((0..).zip(shares.iter().copied())))?;
    let cumulative = shares.iter().scan(0.0, |sum, share| {
        *sum += share;
        Some(*sum)
    });
    let points = (0..).map(SegmentValue::CenterOf).zip(cumulative);
    chart.draw_series(LineSeries::new(points, GREEN.stroke_width(2)))?;
    root.present()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use stackless_bvh::tree::Reach;

    #[test]
    fn an_empty_count_is_drawn_too() {
        let svg = plot_distances("nothing", &Backtracks::new(Reach::ALGORITHM_1)).unwrap();
        assert!(svg.starts_with("<svg") && svg.contains("nothing") && svg.ends_with("</svg>\n"), "{svg}");
    }
}
