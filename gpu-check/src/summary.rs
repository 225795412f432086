//! The summary of a table of measurements, and its chart.

use std::fmt::{self, Write as _};

use crate::bench::{Rays, Row};

/// A kernel over all scenes and views of one kind of rays: geometric means of speeds relative to stacks.
#[derive(Clone, Debug)]
pub struct Line {
    /// The rays.
    pub rays: Rays,
    /// The kernel.
    pub kernel: String,
    /// Relative to the best stack kernel of each cell.
    pub to_best: f64,
    /// Relative to the best of while-while, speculative and persistent.
    pub to_paper: f64,
    /// Relative to the best stack kernel with an equal number of children.
    pub to_own: f64,
}

/// All kernels over all cells.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    /// By rays, then by kernel in the order of measurement.
    pub lines: Vec<Line>,
    /// Maximum relative difference between two measurements of one kernel, over the cells.
    pub noise: f64,
}

impl Summary {
    /// Summarises these rows.
    pub fn of(rows: &[Row]) -> Self {
        let mut lines = Vec::new();
        for rays in Rays::ALL {
            let mut kernels: Vec<&str> = Vec::new();
            for row in rows.iter().filter(|row| row.rays == rays && !row.is_noise) {
                if !kernels.contains(&row.kernel.as_str()) {
                    kernels.push(&row.kernel);
                }
            }
            for kernel in kernels {
                let cells = || rows.iter().filter(|row| row.rays == rays && row.kernel == kernel && !row.is_noise);
                let to_best = geometric_mean(cells().map(|row| row.to_best[0]));
                let to_paper = geometric_mean(cells().map(|row| row.to_paper[0]));
                let to_own = geometric_mean(cells().map(|row| row.to_own));
                lines.push(Line { rays, kernel: kernel.to_owned(), to_best, to_paper, to_own });
            }
        }
        let again = rows.iter().filter(|row| row.is_noise).filter_map(|again| {
            let is_same = |row: &&Row| {
                (&row.scene, row.rays, row.view, &row.kernel) == (&again.scene, again.rays, again.view, &again.kernel)
            };
            let first = rows.iter().filter(|row| !row.is_noise).find(is_same)?;
            Some((again.nanoseconds / first.nanoseconds - 1.0).abs())
        });
        Self { lines, noise: again.fold(0.0, f64::max) }
    }

    /// Bars of speeds relative to the best stack kernel, as SVG.
    pub fn svg(&self) -> String {
        const ROW: usize = 16;
        const UNIT: f64 = 300.0;
        let height = ROW * (self.lines.len() + Rays::ALL.len() + 2);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"760\" height=\"{height}\" font-family=\"sans-serif\" \
             font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        );
        let mut y = ROW;
        for rays in Rays::ALL {
            let _ = writeln!(svg, "<text x=\"4\" y=\"{y}\" font-weight=\"bold\">{}</text>", rays.name());
            y += ROW;
            for line in self.lines.iter().filter(|line| line.rays == rays) {
                let (top, width) = (y - ROW * 3 / 4, UNIT * line.to_best);
                let color = match line.kernel.as_str() {
                    kernel if kernel.starts_with("hashed") => "#b22222",
                    kernel if kernel.starts_with("wide") => "#4682b4",
                    _ => "#808080",
                };
                let _ =
                    writeln!(svg, "<rect x=\"170\" y=\"{top}\" width=\"{width:.1}\" height=\"12\" fill=\"{color}\"/>");
                let _ = writeln!(svg, "<text x=\"12\" y=\"{y}\">{}</text>", line.kernel);
                let _ = writeln!(svg, "<text x=\"{:.1}\" y=\"{y}\">{:.2}</text>", 174.0 + width, line.to_best);
                y += ROW;
            }
        }
        let one = 170.0 + UNIT;
        let _ = writeln!(svg, "<line x1=\"{one}\" x2=\"{one}\" y1=\"0\" y2=\"{y}\" stroke=\"black\"/>");
        let _ = writeln!(svg, "<text x=\"4\" y=\"{y}\">speed, best stack = 1; noise {:.3}</text>", self.noise);
        svg.push_str("</svg>\n");
        svg
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for Line { rays, kernel, to_best, to_paper, to_own } in &self.lines {
            let rays = rays.name();
            writeln!(
                f,
                "# {rays:12} {kernel:20} {to_best:.3} of the best stack, {to_paper:.3} of the paper's, {to_own:.3} of the \
                 best of as many children"
            )?;
        }
        write!(f, "# noise: {:.3}", self.noise)
    }
}

fn geometric_mean(values: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for value in values {
        sum += value.ln();
        count += 1.0;
    }
    if count > 0.0 { f64::exp(sum / count) } else { 0.0 }
}
