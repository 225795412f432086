//! A picture of run time against error.

use plotters::prelude::*;

use super::{Args, Row};

const COLORS: [RGBColor; 5] =
    [RGBColor(40, 90, 180), RGBColor(190, 75, 0), RGBColor(0, 110, 40), RGBColor(120, 60, 150), RGBColor(80, 80, 80)];
const FONT: (&str, i32) = ("sans-serif", 12);

/// Time against the greatest width, both logarithmic, a line for each traversal, as SVG.
pub(super) fn plot(rows: &[Row], args: &Args) -> Result<String, String> {
    let mut svg = String::new();
    draw(&mut svg, rows, args).map_err(|error| error.to_string())?;
    Ok(svg)
}

fn draw(svg: &mut String, rows: &[Row], args: &Args) -> Result<(), Box<dyn std::error::Error>> {
    // An error of 0 is not on a logarithmic axis.
    let seen = |row: &Row| (row.max_error.max(1e-20), row.nanoseconds.max(1.0));
    let points: Vec<_> = rows.iter().map(seen).collect();
    let (errors, times) = (range(points.iter().map(|point| point.0)), range(points.iter().map(|point| point.1)));
    let root = SVGBackend::with_string(svg, (800, 520)).into_drawing_area();
    root.fill(&WHITE)?;
    let caption = format!("closest point of a Bézier curve of degree {}", args.degree);
    let mut chart = ChartBuilder::on(&root)
        .caption(caption, ("sans-serif", 20))
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(64)
        .build_cartesian_2d(errors.log_scale(), times.log_scale())?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.1))
        .x_desc("greatest width of an enclosure")
        .y_desc("time of a query in ns")
        .x_label_formatter(&|error| format!("{error:.0e}"))
        .y_label_formatter(&|time| format!("{time:.0}"))
        .draw()?;
    for (i, method) in args.methods.iter().enumerate() {
        let color = COLORS[i % COLORS.len()];
        let own = rows.iter().zip(&points).filter(|(row, _)| row.method == method.name()).map(|(_, &point)| point);
        let own: Vec<_> = own.collect();
        chart.draw_series(LineSeries::new(own.iter().copied(), color.stroke_width(2)))?;
        chart.draw_series(own.iter().map(|&point| Circle::new(point, 3, color.filled())))?;
        let style = TextStyle::from(FONT.into_font()).color(&color);
        root.draw(&Text::new(method.name(), (90, 50 + 16 * i as i32), style))?;
    }
    root.present()?;
    Ok(())
}

/// All numbers, with some room.
fn range(numbers: impl Iterator<Item = f64>) -> std::ops::Range<f64> {
    let (least, most) = numbers.fold((f64::INFINITY, 0f64), |(least, most), x| (least.min(x), most.max(x)));
    least * 0.5..most * 2.0
}
