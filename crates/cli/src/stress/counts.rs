//! The counts of `stackless stress`.

use serde::{Deserialize, Serialize};
use stackless_bvh::internals::trace::Accuracy;
use stackless_check::Errors;

use crate::output::{count, detail, say, table};
use crate::record::{Counts, Run, add_rows, expect};

/// The name of the rows of wide trees, which are exact.
pub(super) const WIDE: &str = "exact, wide";

/// The name of the rows in double precision, which are exact. Each ray counts twice, for two places.
pub(super) const DOUBLE: &str = "exact, double";

const HEADER: [&str; 7] = ["case", "accuracy", "rays", "false misses", "false hits", "wrong primitives", "max ulp"];

/// The errors of each accuracy in each case.
#[derive(Serialize, Deserialize)]
pub(crate) struct StressCounts {
    pub(super) rows: Vec<Row>,
    /// Whether the rows are already printed.
    #[serde(skip)]
    pub(super) are_shown: bool,
}

#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Row {
    case: String,
    accuracy: String,
    rays: u64,
    false_misses: u64,
    false_hits: u64,
    wrong_primitives: u64,
    max_ulp: u32,
}

impl Counts for StressCounts {
    const COMMAND: &str = "stress";

    fn check(&self, run: &Run) -> Result<(), String> {
        for row in &self.rows {
            let name = format!("{}, {}", row.case, row.accuracy);
            let cases = self.rows.iter().filter(|other| other.accuracy == row.accuracy).map(|row| row.case.clone());
            if run.asked.get("cases") != Some(&cases.collect()) {
                return Err(format!("{name}: expected a row of {} for each of the `cases`", row.accuracy));
            }
            let rays = run.done(|_| true).saturating_mul(if row.accuracy == DOUBLE { 2 } else { 1 });
            expect(&format!("{name}: rays"), row.rays, rays..=rays)?;
            for errors in [row.false_misses, row.false_hits, row.wrong_primitives] {
                expect(&format!("{name}: errors"), errors, 0..=rays)?;
            }
        }
        Ok(())
    }

    fn add(&mut self, other: Self) {
        let is_same = |row: &Row, other: &Row| (&row.case, &row.accuracy) == (&other.case, &other.accuracy);
        add_rows(&mut self.rows, other.rows, is_same, |row, other| row.add(&other));
    }

    /// Prints the rows, unless they are already printed, and their sums for each accuracy.
    fn print(&self) {
        if !self.are_shown {
            detail(table(&HEADER, 2, self.rows.iter().map(Row::cells).collect()));
        }
        let mut sums: Vec<Row> = Vec::new();
        for row in &self.rows {
            match sums.iter_mut().find(|sum| sum.accuracy == row.accuracy) {
                Some(sum) => sum.add(row),
                None => sums.push(Row { case: "all".to_owned(), ..row.clone() }),
            }
        }
        say!("{}", table(&HEADER, 2, sums.iter().map(Row::cells).collect()));
    }

    fn sum(&self) -> String {
        let cases = self.rows.chunk_by(|a, b| a.case == b.case).count() as u64;
        let [rays, errors] = self.cases_and_errors();
        format!("{}, {}, exact: {}", count(cases, "case"), count(rays, "ray"), count(errors, "error"))
    }

    /// The counts of exact tests. Binary and wide trees have the same rays; double precision has each of those rays
    /// twice.
    fn cases_and_errors(&self) -> [u64; 2] {
        let sum = |accuracy: &str, of: fn(&Row) -> u64| {
            let rows = self.rows.iter().filter(|row| row.accuracy == accuracy);
            rows.map(of).fold(0, u64::saturating_add)
        };
        let kinds = [Accuracy::Exact.name(), WIDE, DOUBLE];
        let [rays, errors] = [|row: &Row| row.rays, Row::errors].map(|of| kinds.map(|kind| sum(kind, of)));
        [rays[0].max(rays[1]), errors.into_iter().fold(0, u64::saturating_add)]
    }

    fn is_empty(&self) -> bool {
        self.rows.iter().all(|row| row.rays == 0)
    }
}

impl Row {
    pub(super) fn new(case: &str, accuracy: &str, errors: Errors) -> Self {
        let Errors { rays, false_misses, false_hits, wrong_primitives, max_ulp } = errors;
        let (case, accuracy) = (case.to_owned(), accuracy.to_owned());
        Self { case, accuracy, rays, false_misses, false_hits, wrong_primitives, max_ulp }
    }

    fn add(&mut self, other: &Self) {
        self.rays = self.rays.saturating_add(other.rays);
        self.false_misses = self.false_misses.saturating_add(other.false_misses);
        self.false_hits = self.false_hits.saturating_add(other.false_hits);
        self.wrong_primitives = self.wrong_primitives.saturating_add(other.wrong_primitives);
        self.max_ulp = self.max_ulp.max(other.max_ulp);
    }

    /// The header of rows that are printed one by one. `widths` are the widths of the names.
    pub(super) fn header(widths: [usize; 2]) -> String {
        in_columns(widths, &HEADER)
    }

    pub(super) fn line(&self, widths: [usize; 2]) -> String {
        in_columns(widths, &self.cells())
    }

    /// Number of wrong answers, plus 1 if a distance is wrong.
    pub(super) fn errors(&self) -> u64 {
        let counts = [self.false_misses, self.false_hits, self.wrong_primitives, u64::from(self.max_ulp > 0)];
        counts.into_iter().fold(0, u64::saturating_add)
    }

    fn cells(&self) -> Vec<String> {
        let numbers = [self.rays, self.false_misses, self.false_hits, self.wrong_primitives, self.max_ulp.into()];
        let names = [self.case.clone(), self.accuracy.clone()];
        names.into_iter().chain(numbers.map(|number| number.to_string())).collect()
    }
}

/// Aligns cells like a table: names left, numbers right.
fn in_columns(names: [usize; 2], cells: &[impl AsRef<str>]) -> String {
    let cell = |(i, cell): (usize, &_)| match (names.get(i), AsRef::<str>::as_ref(cell)) {
        (Some(&width), cell) => format!("{cell:width$}"),
        (None, cell) => format!("{cell:>width$}", width = HEADER[i].len()),
    };
    cells.iter().enumerate().map(cell).collect::<Vec<_>>().join("  ")
}
