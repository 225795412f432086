//! The counts of `stackless check`.

use std::collections::{BTreeMap, HashSet};
use std::fmt::Write as _;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use stackless_bvh::bvh::Builder;
use stackless_bvh::traverse::{Method, WordName};
use stackless_check::{Battery, Disagreement, Plan, Replay, SceneDisagreement, Tally, Verdict, shrink};
use stackless_scene::Position;

use super::Total;
use crate::build;
use crate::input::Scene;
use crate::output::{count, detail, grouped, say, table};
use crate::record::{Counts, Numbered, Part, Run, claim, expect};

/// The counts of the file of `--json`.
#[derive(Serialize, Deserialize)]
pub(crate) struct Summary {
    trees: u64,
    rays: u64,
    methods: usize,
    disagreements: u64,
    /// Number of pauses and resumptions of a traversal.
    resumes: u64,
    /// Depth in edges that determines the bytes of state.
    depth: u32,
    rows: Vec<Row>,
    smallest: Option<Smallest>,
    /// The first fault of a resumed traversal, in the order of the trees.
    pause_fault: Option<Numbered<String>>,
    scene_faults: Vec<SceneFault>,
}

/// One line of the table.
#[derive(Serialize, Deserialize)]
struct Row {
    method: String,
    word: String,
    cases: u64,
    agree: u64,
    refused: u64,
    refusal: Option<String>,
    steps: u64,
    state_bytes: usize,
}

/// The smallest case with a disagreement.
#[derive(Serialize, Deserialize)]
struct Smallest {
    /// Number of the case and of its nodes, before shrinking.
    number: u64,
    nodes: usize,
    replay: Replay,
}

/// A ray for which a traversal differs from the oracle, or the oracle from the truth.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct SceneFault {
    /// Index of the scene.
    scene: usize,
    tree: String,
    ray: u64,
    text: String,
}

impl Summary {
    pub(super) fn new(plan: &Plan, total: &Total) -> Self {
        // The state is given for the requested depth; for trees of many depths, for the maximum depth of a u32.
        let depth = total.tally.depth.min(plan.options.depth.unwrap_or(31));
        let pairs = plan.pairs();
        let methods = pairs.iter().map(|(method, _)| method).collect::<HashSet<_>>().len();
        let rows = pairs.into_iter().map(|(method, word)| Row::of(method, word, &total.tally, depth)).collect();
        let pause_fault = total.pauses.first.as_ref();
        Self {
            trees: total.trees,
            rays: total.rays,
            methods,
            disagreements: total.tally.disagreements() + total.pauses.faults,
            resumes: total.pauses.resumes,
            depth,
            rows,
            smallest: total.found.as_ref().map(Smallest::of),
            pause_fault: pause_fault.map(|(number, fault)| Numbered { number: *number, found: fault.to_string() }),
            scene_faults: total.scenes.clone(),
        }
    }
}

impl Counts for Summary {
    const COMMAND: &str = "check";

    fn check(&self, run: &Run) -> Result<(), String> {
        let is_scene = |name: &str| name.starts_with("rays of scene ");
        let abstract_trees = run.done(|name| !is_scene(name) && name != "trees, putting aside");
        // The part with the first ray of a scene counts its trees.
        let begins = |(name, part): (&String, &Part)| is_scene(name) && part.done.iter().any(|[from, _]| *from == 0);
        let builds = build::CHECKED.len() as u64;
        let trees = abstract_trees + builds * run.parts.iter().filter(|&part| begins(part)).count() as u64;
        expect("trees", self.trees, trees..=trees)?;
        let rays = run.done(is_scene).saturating_mul(builds);
        expect("rays", self.rays, rays..=rays)?;
        let methods: HashSet<_> = self.rows.iter().map(|row| &row.method).collect();
        expect("methods", self.methods as u64, methods.len() as u64..=methods.len() as u64)?;
        // Each ray is a closest-hit and an any-hit query.
        let cases = abstract_trees.saturating_add(rays.saturating_mul(2));
        let (mut keys, mut wrong) = (HashSet::new(), 0_u64);
        for row in &self.rows {
            let name = format!("{} {}", row.method, row.word);
            expect(&format!("{name}: cases and refused"), row.cases.saturating_add(row.refused), cases..=cases)?;
            expect(&format!("{name}: agree"), row.agree, 0..=row.cases)?;
            wrong = wrong.saturating_add(row.cases - row.agree);
            if !keys.insert(name.clone()) {
                return Err(format!("{name}: two rows, expected one"));
            }
        }
        // Faults of the oracle and of pauses belong to no row.
        let is_faulty = self.smallest.is_some() || self.pause_fault.is_some() || !self.scene_faults.is_empty();
        expect("disagreements", self.disagreements, wrong.max(is_faulty.into())..=u64::MAX)
    }

    fn add(&mut self, other: Self) {
        self.trees = self.trees.saturating_add(other.trees);
        self.rays = self.rays.saturating_add(other.rays);
        self.methods = self.methods.max(other.methods);
        self.disagreements = self.disagreements.saturating_add(other.disagreements);
        self.resumes = self.resumes.saturating_add(other.resumes);
        self.depth = self.depth.max(other.depth);
        let mut theirs: BTreeMap<_, _> =
            other.rows.into_iter().map(|row| ((row.method.clone(), row.word.clone()), row)).collect();
        for row in &mut self.rows {
            if let Some(other) = theirs.remove(&(row.method.clone(), row.word.clone())) {
                row.add(other, self.depth);
            }
        }
        self.rows.extend(theirs.into_values());
        let smallest = self.smallest.take().into_iter().chain(other.smallest);
        self.smallest = smallest.min_by_key(|found| (found.nodes, found.number));
        self.pause_fault = Numbered::first(self.pause_fault.take(), other.pause_fault);
        self.scene_faults.extend(other.scene_faults);
        self.scene_faults.sort_by(|a, b| a.key().cmp(&b.key()));
        self.scene_faults.dedup_by(|later, first| (&later.scene, &later.tree) == (&first.scene, &first.tree));
    }

    fn sum(&self) -> String {
        let counts = [
            (self.trees, "tree"),
            (self.rays, "ray"),
            (self.methods as u64, "method"),
            (self.disagreements, "disagreement"),
        ];
        counts.map(|(number, what)| count(number, what)).join(", ")
    }

    /// Prints the disagreements and the table.
    fn print(&self) {
        let refused = self.rows.iter().filter_map(|row| row.refusal.as_ref().map(|why| (row, why)));
        if let Some((row, why)) = refused.into_iter().next() {
            say!("refused before the first step, e.g. {} {}: {why}", row.method, row.word);
        }
        for SceneFault { text, .. } in &self.scene_faults {
            say!("{text}");
        }
        if let Some(Smallest { replay, .. }) = &self.smallest {
            let of = |names: &[String]| names.first().cloned().unwrap_or_default();
            let word = replay.word.clone().unwrap_or_default();
            say!("{} {word}: {}", of(&replay.methods), replay.fault.as_deref().unwrap_or_default());
            say!("smallest case, for `stackless check --replay FILE`:");
            say!("{}", serde_json::to_string(replay).unwrap_or_default());
        }
        if self.resumes > 0 {
            say!("paused and resumed: {} times", grouped(self.resumes));
        }
        if let Some(Numbered { number, found }) = &self.pause_fault {
            say!("tree {number}: {found}");
        }
        let header = ["method", "word", "cases", "agree", "refused", "steps", "state bytes"];
        detail(table(&header, 2, self.rows.iter().map(Row::cells).collect()));
        detail(format_args!("state bytes: for one ray in a tree {} edges deep", self.depth));
    }

    fn cases_and_errors(&self) -> [u64; 2] {
        [self.trees.saturating_add(self.rays), self.disagreements]
    }

    fn is_empty(&self) -> bool {
        self.rows.iter().all(|row| row.cases == 0)
    }

    /// All trees up to a size are not a sample.
    fn claim(&self, run: &Run) -> String {
        match (run.asked.get("leaves").and_then(Value::as_u64), self.cases_and_errors()) {
            (Some(leaves), [cases, 0]) => {
                format!(
                    "claim: 0 of {} cases went wrong: all trees of up to {leaves} leaves, with all decisions",
                    grouped(cases)
                )
            }
            (_, counts) => claim(counts),
        }
    }
}

impl Row {
    fn of(method: Method, word: WordName, tally: &Tally, depth: u32) -> Self {
        let count = tally.get(method, word);
        let word_name = if method.has_words() { word.name() } else { "-" };
        Self {
            method: method.to_string(),
            word: word_name.to_owned(),
            cases: count.cases,
            agree: count.agree,
            refused: count.refused,
            refusal: count.refusal.map(|refusal| refusal.to_string()),
            steps: count.steps,
            state_bytes: method.state_bytes_in(word, depth),
        }
    }

    fn add(&mut self, other: Self, depth: u32) {
        self.cases = self.cases.saturating_add(other.cases);
        self.agree = self.agree.saturating_add(other.agree);
        self.refused = self.refused.saturating_add(other.refused);
        self.steps = self.steps.saturating_add(other.steps);
        self.refusal = self.refusal.take().into_iter().chain(other.refusal).max();
        // Stacks have the same size for every word.
        let word = self.word.parse().unwrap_or(WordName::U32);
        if let Ok(method) = self.method.parse::<Method>() {
            self.state_bytes = method.state_bytes_in(word, depth);
        }
    }

    fn cells(&self) -> Vec<String> {
        let numbers = [self.cases, self.agree, self.refused, self.steps, self.state_bytes as u64].map(grouped);
        [self.method.clone(), self.word.clone()].into_iter().chain(numbers).collect()
    }
}

impl Smallest {
    /// The shrunk case, in the format of a file.
    fn of(found: &Disagreement) -> Self {
        let &Disagreement { number, method, word, fault, .. } = found;
        let verdict = |case: &_| Battery::new(case, &[method]).check(method, word);
        let case = shrink(found.case.clone(), |case| matches!(verdict(case), Verdict::Differs(_)));
        let fault = if let Verdict::Differs(fault) = verdict(&case) { fault } else { fault };
        Self { number, nodes: found.case.size(), replay: Replay::of(&case, method, word, &fault) }
    }
}

impl SceneFault {
    pub(super) fn new<V: Position>(
        index: usize,
        scene: &Scene<V>,
        tree: Builder,
        fault: &SceneDisagreement<V>,
    ) -> Self {
        let SceneDisagreement { number, ray, any, method, expected, found } = fault;
        let who = method.map_or_else(|| "the oracle".to_owned(), |(method, word)| format!("{method} {word}"));
        let query = if *any { "any hit" } else { "closest hit" };
        let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin().components(), ray.direction().components());
        let name = &scene.name;
        let mut text = format!("{name}, {tree} tree, {query}, ray {number}: {who} disagrees on this ray\n");
        // Writing to a string is infallible.
        let _ = writeln!(text, "  {ox:?},{oy:?},{oz:?},{dx:?},{dy:?},{dz:?},{:?},{:?}", ray.tmin(), ray.tmax());
        let _ = writeln!(text, "  expected {expected:?}");
        let _ = write!(text, "  found    {found:?}");
        Self { scene: index, tree: tree.to_string(), ray: *number, text }
    }

    fn key(&self) -> (usize, &str, u64) {
        (self.scene, &self.tree, self.ray)
    }
}
