//! A picture of run time against error.

use stackless_cli::plots::{Line, plot_lines};

use super::{Args, Row};

/// Time against the greatest width, both logarithmic, a line for each traversal, as SVG.
pub(super) fn plot(rows: &[Row], args: &Args) -> String {
    // An error of 0 is not on a logarithmic axis.
    let point = |row: &Row| (row.max_error.max(1e-20), row.nanoseconds.max(1.0));
    let line = |name: &str| {
        let own = rows.iter().filter(|row| row.method == name);
        Line { name: name.to_owned(), points: own.map(point).collect() }
    };
    let lines: Vec<_> = args.methods.iter().map(|method| line(method.name())).collect();
    let title = format!("Closest point of a Bézier curve of degree {}", args.degree);
    plot_lines(&title, ["greatest width of an enclosure", "time of a query in ns"], &lines)
}
