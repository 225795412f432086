//! A dated record of a measurement: a text, the lines as CSV, and a chart.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use stackless_scene::write_atomically;

use crate::bench::{HEADER, Rays, Row, Setting};
use crate::summary::{Line, Summary};
use crate::{Checks, GpuError};

/// A measurement with its device.
#[derive(Debug)]
pub struct Record<'a> {
    /// Name of the device and its driver.
    pub device: String,
    /// The device's arithmetic.
    pub arithmetic: String,
    /// The size of the measurement.
    pub setting: Setting,
    /// All lines.
    pub rows: &'a [Row],
    /// Memory traffic of each scene and set of rays, a line each.
    pub traffic: &'a [String],
}

/// Goals of `hashed`, relative to the best stack's speed: the averages of Binder & Keller 2016.
const GOALS: [(Rays, f64); 3] = [(Rays::Primary, 1.08), (Rays::DiffuseAny, 1.20), (Rays::Diffuse, 1.17)];

impl Record<'_> {
    /// Writes `DATE-gpu.md`, `.csv` and `.svg` into a folder, with a number if that record exists. Returns the path of
    /// the text.
    ///
    /// # Errors
    /// [`GpuError::Data`] if a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<PathBuf, GpuError> {
        let wrong = |error: std::io::Error| GpuError::Data(format!("{}: {error}", folder.display()));
        std::fs::create_dir_all(folder).map_err(wrong)?;
        let date = date(SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs() / 86400));
        let names = [format!("{date}-gpu")].into_iter().chain((2..).map(|n| format!("{date}-gpu-{n}")));
        let mut free = names.filter(|name| !folder.join(format!("{name}.md")).exists());
        let name = free.next().unwrap_or_default();
        let summary = Summary::of(self.rows);
        let lines = [HEADER.to_owned()].into_iter().chain(self.rows.iter().map(ToString::to_string));
        let lines = lines.map(|line| line + "\n").collect();
        let text = self.text(&date, &name, &summary);
        for (ending, text) in [("csv", lines), ("svg", summary.svg()), ("md", text)] {
            let path = folder.join(format!("{name}.{ending}"));
            write_atomically(&path, |file| file.write_all(text.as_bytes())).map_err(wrong)?;
        }
        Ok(folder.join(format!("{name}.md")))
    }

    fn text(&self, date: &str, name: &str, summary: &Summary) -> String {
        let Setting { rays, views, warm_up, passes, checks } = self.setting;
        let checks = if checks == Checks::All { "with" } else { "without" };
        let mut text = format!(
            "# Kernels on a device: {date}\n\n{}\n\nArithmetic: {}.\n\n`gpu-check bench --rays {rays} --views {views} \
             --warm-up {warm_up} --passes {passes}`, kernels {checks} run-time checks. Speeds are geometric means over \
             scenes and views, relative to the best stack kernel of two children of each; one kernel measured twice \
             differs by up to {:.3}. Each line: [{name}.csv]({name}.csv).\n",
            self.device, self.arithmetic, summary.noise
        );
        for (rays, goal) in GOALS {
            let _ = writeln!(
                text,
                "\n| {} | best stack = 1 | best of the paper's stacks = 1 | best stack of as many children = 1 |\n\
                 |---|---:|---:|---:|",
                rays.name()
            );
            for line in summary.lines.iter().filter(|line| line.rays == rays) {
                let Line { kernel, to_best, to_paper, to_own, .. } = line;
                let _ = writeln!(text, "| `{kernel}` | {to_best:.3} | {to_paper:.3} | {to_own:.3} |");
            }
            let hashed = summary.lines.iter().filter(|line| line.rays == rays && line.kernel.starts_with("hashed"));
            let best = hashed.map(|line| line.to_best).fold(0.0, f64::max);
            let verdict = if best >= goal { "reached" } else { "not reached" };
            let _ = writeln!(text, "\nThe goal, {goal:.2} by a hashed kernel, is {verdict}: {best:.3}.");
        }
        let _ = write!(text, "\n![Speeds]({name}.svg)\n\n```\n{}\n```\n", self.traffic.join("\n"));
        text
    }
}

/// Year, month and day of the Gregorian calendar, from the number of days since 1970.
fn date(days: u64) -> String {
    // Years start in March, so a leap day is the last day of its year. An era has 400 years.
    let days = days + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let (day, month) = (day - (153 * month + 2) / 5 + 1, if month < 10 { month + 3 } else { month - 9 });
    format!("{}-{month:02}-{day:02}", era * 400 + year + u64::from(month < 3))
}

#[cfg(test)]
mod tests {
    #[test]
    fn dates_are_those_of_the_calendar() {
        for (days, expected) in [
            (0, "1970-01-01"),
            (59, "1970-03-01"),
            (11_016, "2000-02-29"),
            (20_779, "2026-11-22"),
            (47_541, "2100-03-01"),
        ] {
            assert_eq!(super::date(days), expected);
        }
    }
}
