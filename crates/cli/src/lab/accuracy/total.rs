//! The counts of `lab accuracy`, in records of runs and of parts.

use serde::{Deserialize, Serialize};
use stackless_bvh::internals::trace::Accuracy;

use super::rows::Row;
use super::stages::Stages;
use super::tables;
use crate::output::{self, Block, count, say, table};
use crate::record::{Counts, Numbered, Run, add_rows, expect};

/// Results of the measurement.
#[derive(Default, Serialize, Deserialize)]
pub(crate) struct Found {
    pub(super) rows: Vec<Row>,
    #[serde(skip)]
    pub(super) stages: Vec<Stages>,
    /// Sets without rays.
    #[serde(skip)]
    pub(super) notes: Vec<String>,
}

impl Found {
    fn blocks(&self) -> Vec<Block> {
        let notes = self.notes.iter().cloned().map(Block::Line);
        notes.chain(tables::blocks(&self.rows, &self.stages)).collect()
    }

    /// Draws time against error, as SVG.
    pub(super) fn plot(&self) -> String {
        tables::plot(&self.rows)
    }

    /// Errors of pairs that promise none, in words.
    fn offences(&self) -> impl Iterator<Item = &String> {
        self.rows.iter().filter_map(|row| row.offence.as_ref()).map(|offence| &offence.found)
    }
}

impl Counts for Found {
    const COMMAND: &str = "accuracy";

    fn check(&self, run: &Run) -> Result<(), String> {
        self.rows.iter().try_for_each(|row| row.check(run))
    }

    fn add(&mut self, other: Self) {
        add_rows(&mut self.rows, other.rows, Row::is_same, Row::add);
    }

    fn sum(&self) -> String {
        sum(self.cases_and_errors())
    }

    fn print(&self) {
        for offence in self.offences() {
            say!("{offence}");
        }
        output::print(&self.blocks());
    }

    /// The counts of exact tests. All pairs have equal rays.
    fn cases_and_errors(&self) -> [u64; 2] {
        let exact = self.rows.iter().filter(|row| row.level.as_deref() == Some(Accuracy::Exact.name()));
        let held = self.rows.iter().filter(|row| row.is_exact());
        [exact.map(|row| row.rays).fold(0, u64::saturating_add), held.map(Row::errors).fold(0, u64::saturating_add)]
    }

    fn is_empty(&self) -> bool {
        self.rows.iter().all(|row| row.rays == 0)
    }
}

/// The start point that promises no errors.
pub(super) const EXACT: &str = "exact point";

/// The errors of one kind of start point.
#[derive(Serialize, Deserialize)]
pub(super) struct SecondaryRow {
    pub(super) scene: String,
    pub(super) start: String,
    pub(super) rays: u64,
    /// Wrongly in shadow.
    pub(super) false_shadows: u64,
    /// Wrongly lit.
    pub(super) false_light: u64,
    /// The first error of [`EXACT`], with the number of its pixel.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) offence: Option<Numbered<String>>,
}

impl SecondaryRow {
    pub(super) fn new(scene: &str, start: &str, answers: &[bool], truth: &[bool]) -> Self {
        let count = |is_blocked: bool| {
            answers.iter().zip(truth).filter(|(answer, truth)| **answer == is_blocked && answer != truth).count() as u64
        };
        let (false_shadows, false_light) = (count(true), count(false));
        let (scene, start) = (scene.to_owned(), start.to_owned());
        Self { scene, start, rays: truth.len() as u64, false_shadows, false_light, offence: None }
    }

    fn is_same(&self, other: &Self) -> bool {
        (&self.scene, &self.start) == (&other.scene, &other.start)
    }

    fn add(&mut self, other: Self) {
        self.rays = self.rays.saturating_add(other.rays);
        self.false_shadows = self.false_shadows.saturating_add(other.false_shadows);
        self.false_light = self.false_light.saturating_add(other.false_light);
        self.offence = Numbered::first(self.offence.take(), other.offence);
    }

    pub(super) const fn wrong(&self) -> u64 {
        self.false_shadows.saturating_add(self.false_light)
    }

    fn cells(&self) -> Vec<String> {
        let share = |count: u64| format!("{count} ({:.2e})", count as f64 / self.rays.max(1) as f64);
        let [shadows, light] = [self.false_shadows, self.false_light].map(share);
        vec![self.scene.clone(), self.start.clone(), self.rays.to_string(), shadows, light]
    }
}

/// Results for rays from surfaces.
#[derive(Default, Serialize, Deserialize)]
pub(crate) struct SecondaryFound {
    pub(super) rows: Vec<SecondaryRow>,
}

impl Counts for SecondaryFound {
    const COMMAND: &str = "accuracy --secondary";

    fn check(&self, run: &Run) -> Result<(), String> {
        let expect = |row: &SecondaryRow, what, number, most| {
            expect(&format!("{}, {}: {what}", row.scene, row.start), number, 0..=most)
        };
        self.rows.iter().try_for_each(|row| {
            expect(row, "rays", row.rays, run.done(|_| true))?;
            expect(row, "false_shadows and false_light", row.wrong(), row.rays)
        })
    }

    fn add(&mut self, other: Self) {
        add_rows(&mut self.rows, other.rows, SecondaryRow::is_same, SecondaryRow::add);
    }

    fn sum(&self) -> String {
        sum(self.cases_and_errors())
    }

    fn print(&self) {
        for offence in self.rows.iter().filter_map(|row| row.offence.as_ref()) {
            say!("{}", offence.found);
        }
        let header = ["scene", "start", "rays", "false shadows", "false light"];
        say!("{}", table(&header, 2, self.rows.iter().map(SecondaryRow::cells).collect()));
    }

    /// The counts of exact points.
    fn cases_and_errors(&self) -> [u64; 2] {
        let exact = self.rows.iter().filter(|row| row.start == EXACT);
        exact.fold([0_u64; 2], |sum, row| [sum[0].saturating_add(row.rays), sum[1].saturating_add(row.wrong())])
    }

    fn is_empty(&self) -> bool {
        self.rows.iter().all(|row| row.rays == 0)
    }
}

fn sum([rays, errors]: [u64; 2]) -> String {
    format!("{} judged, exact: {}", count(rays, "ray"), count(errors, "error"))
}
