//! Runs the layers for each bug.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use crate::bug::Bug;
use crate::copy;
use crate::layers::{Job, LAYERS, Layer, Programs, UNIT_TESTS};
use crate::process::{self, End};
use crate::table::{Found, Row, Table, Verdict};

/// The options of a run.
pub(crate) struct Plan {
    pub(crate) choice: Choice,
    /// Names of layers; all layers if empty.
    pub(crate) layers: Vec<String>,
    pub(crate) every_layer: bool,
    /// Maximum number of seconds of a layer.
    pub(crate) seconds: Option<u64>,
    pub(crate) json: Option<PathBuf>,
}

/// The choice of bugs.
pub(crate) enum Choice {
    Sample(usize),
    Only(Vec<String>),
    All,
}

/// The folder of the copy.
pub(crate) fn copy_folder(root: &Path) -> PathBuf {
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    target.join("planted/tree")
}

impl Plan {
    /// Returns whether exactly the bugs that must be caught were caught.
    pub(crate) fn run(&self, root: &Path, bugs: &[Bug]) -> Result<bool, Box<dyn Error>> {
        let chosen = self.chosen(root, bugs)?;
        if chosen.is_empty() {
            return Err("no bug is chosen, expected at least one".into());
        }
        let copy = copy_folder(root);
        copy::write(root, &copy, bugs)?;
        let programs = Programs::build(&copy, matches!(self.choice, Choice::Sample(_)))?;
        println!("built in {:.0} s", programs.seconds);
        let mut controls = Controls { programs: &programs, seconds: BTreeMap::new() };
        let folder = root.join("tests/planted");
        let kept = folder.join("table.json");
        let known = Table::read(&kept)?;
        let json = self.json.clone().or_else(|| self.writes_page().then_some(kept));
        let mut before = json.as_deref().map(Table::read).transpose()?.unwrap_or_default();
        let mut table = Table { build_seconds: programs.seconds.round(), ..Table::default() };
        for (done, &number) in chosen.iter().enumerate() {
            let bug = &bugs[number - 1];
            let row = match known.caught(&bug.name).filter(|_| !self.every_layer) {
                Some((layer, test)) => caught_again(bug, number, layer, test, &mut controls)?,
                None => None,
            };
            let row = match row {
                Some(row) => row,
                None => self.row(bug, number, &mut controls)?,
            };
            if row.caught().is_none() && !self.layers.is_empty() {
                println!("{}/{} {}: open, {:.1} s", done + 1, chosen.len(), row.bug, row.seconds());
                before.rows.retain(|old| old.bug != row.bug);
            } else {
                println!("{}/{} {}", done + 1, chosen.len(), told(&row));
                table.rows.push(row);
            }
            table.control_seconds = controls.of_layers();
            // Written after each bug, so that an interrupted run is not lost.
            if let Some(json) = &json {
                table.clone().completed(before.clone(), bugs).write(json)?;
            }
        }
        if self.writes_page() {
            table.clone().completed(before, bugs).write_page(&folder, bugs)?;
        }
        Ok(judge(&table.rows))
    }

    fn has(&self, layer: &Layer) -> bool {
        self.layers.is_empty() || self.layers.iter().any(|name| name == layer.name)
    }

    fn writes_page(&self) -> bool {
        matches!(self.choice, Choice::All)
    }

    /// The numbers of the chosen bugs, from 1.
    fn chosen(&self, root: &Path, bugs: &[Bug]) -> Result<Vec<usize>, Box<dyn Error>> {
        let all = 1..=bugs.len();
        Ok(match &self.choice {
            Choice::All => all.collect(),
            Choice::Only(texts) => {
                all.filter(|&number| texts.iter().any(|text| has(&bugs[number - 1], text))).collect()
            }
            Choice::Sample(count) => {
                let commit = commit(root)?;
                let table = Table::read(&root.join("tests/planted/table.json"))?;
                let by_unit_test = |name: &str| table.caught(name).is_some_and(|(layer, _)| layer.target == UNIT_TESTS);
                let mut numbers: Vec<_> = all.filter(|&number| by_unit_test(&bugs[number - 1].name)).collect();
                numbers.sort_by_key(|&number| hash(&format!("{commit} {}", bugs[number - 1].name)));
                numbers.truncate(*count);
                numbers
            }
        })
    }

    fn row(&self, bug: &Bug, number: usize, controls: &mut Controls<'_>) -> Result<Row, Box<dyn Error>> {
        let mut found = Vec::new();
        for layer in LAYERS.iter().filter(|layer| self.has(layer)) {
            let Some(job) = controls.programs.job(layer, &bug.file) else { continue };
            let usual = Duration::from_secs_f64(10.0 + 4.0 * controls.seconds(layer, &job)?);
            let (end, seconds) = process::run(&job, number, self.seconds.map_or(usual, Duration::from_secs))?;
            if end == End::Passed(0) {
                return Err(format!("{}: layer {} ran no test", bug.place(), layer.name).into());
            }
            let of_layer = Found::new(layer, end, seconds);
            let verdict = of_layer.verdict;
            found.push(of_layer);
            if verdict != Verdict::Survived && !self.every_layer {
                break;
            }
        }
        Ok(Row::new(bug, found))
    }
}

/// The row of a bug, if the test that caught it before fails again. This test is faster than its whole layer.
fn caught_again(
    bug: &Bug,
    number: usize,
    layer: &'static Layer,
    test: &str,
    controls: &mut Controls<'_>,
) -> Result<Option<Row>, Box<dyn Error>> {
    let Some(job) = controls.programs.one(layer, test) else { return Ok(None) };
    let limit = Duration::from_secs_f64(10.0 + 4.0 * controls.seconds(layer, &job)?);
    let (end, seconds) = process::run(&job, number, limit)?;
    // The test is known, independent of the kind of end.
    let found = Found { by: Some(test.to_owned()), ..Found::new(layer, end, seconds) };
    Ok((found.verdict != Verdict::Survived).then(|| Row::new(bug, vec![found])))
}

/// Runs without a bug. Each layer runs before its first use for a bug.
struct Controls<'p> {
    programs: &'p Programs,
    /// Seconds by layer and arguments.
    seconds: BTreeMap<(&'static str, Vec<String>), f64>,
}

impl Controls<'_> {
    /// Returns the seconds of a job without a bug.
    ///
    /// # Errors
    /// A test fails, or no test runs.
    fn seconds(&mut self, layer: &'static Layer, job: &Job<'_>) -> Result<f64, Box<dyn Error>> {
        let key = (layer.name, job.arguments.clone());
        if let Some(&seconds) = self.seconds.get(&key) {
            return Ok(seconds);
        }
        let (end, seconds) = process::run(job, 0, Duration::from_hours(2))?;
        match end {
            End::Passed(count) if count > 0 => println!("without a bug: {}: {count} tests, {seconds:.1} s", layer.name),
            end => return Err(format!("without a bug, layer {} must pass, found {end:?}", layer.name).into()),
        }
        self.seconds.insert(key, seconds);
        Ok(seconds)
    }

    /// The seconds of each layer that has run. If modules run separately, the seconds of the slowest module.
    fn of_layers(&self) -> BTreeMap<String, f64> {
        let mut layers = BTreeMap::<_, f64>::new();
        for ((layer, _), seconds) in &self.seconds {
            let slowest = layers.entry((*layer).to_owned()).or_default();
            *slowest = slowest.max((seconds * 10.0).round() / 10.0);
        }
        layers
    }
}

fn has(bug: &Bug, text: &str) -> bool {
    let topic = bug.listed_in.file_stem().unwrap_or_default();
    [&bug.name, &bug.file].iter().any(|field| field.contains(text)) || bug.clause == text || topic == text
}

/// Prints the faults. Returns whether there are none.
fn judge(rows: &[Row]) -> bool {
    let mut is_right = true;
    for row in rows {
        match (row.caught(), &row.survives) {
            (None, None) => println!("SURVIVES: {} ({}, {})", row.bug, row.clause, row.file),
            (Some(found), Some(_)) => println!("CAUGHT by {}, expected to survive: {}", found.layer, row.bug),
            _ => continue,
        }
        is_right = false;
    }
    let caught = rows.iter().filter(|row| row.caught().is_some()).count();
    println!("{} bugs, {caught} caught, {:.0} s", rows.len(), rows.iter().map(Row::seconds).sum::<f64>());
    is_right
}

fn told(row: &Row) -> String {
    let found = row.caught().map_or_else(
        || "SURVIVES".to_owned(),
        |found| format!("{} {}", found.layer, found.by.clone().unwrap_or_else(|| format!("{:?}", found.verdict))),
    );
    format!("{} ({}): {found}, {:.1} s", row.bug, row.clause, row.seconds())
}

fn commit(root: &Path) -> Result<String, Box<dyn Error>> {
    let output = Command::new("git").args(["rev-parse", "HEAD"]).current_dir(root).output()?;
    if !output.status.success() {
        return Err(format!("git rev-parse HEAD: {}", String::from_utf8_lossy(&output.stderr).trim()).into());
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// FNV-1a, which is equal on every machine.
fn hash(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}
