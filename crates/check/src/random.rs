//! Checks of many cases: random ones, and those at the depth limits of the words.

use std::ops::Range;

use rayon::prelude::*;

use super::watch::Fault;
use super::{Battery, Case, CaseOptions, PauseFault, Pauses, Tally, Verdict};
use stackless_bvh::generate::{Family, Kind, Rng};
use stackless_bvh::hash::mix;
use stackless_bvh::internals::traverse::{WithWord, with_word};
use stackless_bvh::key::KeyWord;
use stackless_bvh::traverse::{Method, WordName};
use stackless_bvh::tree::Topology;

/// The traversals, words and random trees of a check.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Number of random trees.
    pub trees: u64,
    /// Seed of tree 0.
    pub seed: u64,
    /// Limits of the random cases.
    pub options: CaseOptions,
    /// The traversals.
    pub methods: Vec<Method>,
    /// The words. Traversals without words run once.
    pub words: Vec<WordName>,
}

/// A traversal that differs from its oracle.
#[derive(Clone, Debug)]
pub struct Disagreement {
    /// Number of the case, if it has one.
    pub number: u64,
    /// The case.
    pub case: Case,
    /// The traversal.
    pub method: Method,
    /// Its word.
    pub word: WordName,
    /// The first difference.
    pub fault: Fault,
}

/// Receives the number of newly finished trees, from any thread.
pub type Progress<'a> = &'a (dyn Fn(u64) + Sync);

impl Plan {
    /// Returns the supported pairs of traversal and word. A traversal without words appears once.
    pub fn pairs(&self) -> Vec<(Method, WordName)> {
        let pairs = self.methods.iter().flat_map(|&method| {
            let words = if method.has_words() { &self.words[..] } else { &self.words[..1] };
            words.iter().map(move |&word| (method, word))
        });
        pairs.filter(|&(method, word)| with_word(word, Exists(method))).collect()
    }

    /// Generates random case number `i`.
    pub fn case(&self, i: u64) -> Case {
        Case::random(mix(self.seed.wrapping_add(i)), self.options)
    }

    /// Checks all traversals in all words on one case.
    pub fn check_case(&self, case: &Case, tally: &mut Tally) -> Option<Disagreement> {
        self.check_pairs(&self.pairs(), case, tally)
    }

    /// Checks one case, with the pairs of the plan computed by the caller.
    fn check_pairs(&self, pairs: &[(Method, WordName)], case: &Case, tally: &mut Tally) -> Option<Disagreement> {
        let mut battery = Battery::new(case, &self.methods);
        tally.depth = tally.depth.max(case.tree.depth());
        let mut first = None;
        for &(method, word) in pairs {
            let verdict = battery.check(method, word);
            tally.add(method, word, &verdict);
            if let Verdict::Differs(fault) = verdict {
                first.get_or_insert_with(|| Disagreement { number: 0, case: case.clone(), method, word, fault });
            }
        }
        first
    }
}

struct Exists(Method);

impl WithWord for Exists {
    type Output = bool;

    fn call<W: KeyWord>(self) -> bool {
        self.0.exists_for::<W>()
    }
}

/// Checks a range of the plan's random cases on all cores. The result does not depend on the number of cores.
///
/// Of all disagreements, returns the one with the smallest tree.
pub fn check_random(plan: &Plan, numbers: Range<u64>, progress: Progress<'_>) -> (Tally, Option<Disagreement>) {
    check_numbered(plan, numbers, &|number| plan.case(number), progress)
}

/// Checks a range of numbered cases on all cores. The result does not depend on the number of cores.
///
/// Of all disagreements, returns the one with the smallest tree.
pub fn check_numbered(
    plan: &Plan,
    numbers: Range<u64>,
    case: &(dyn Fn(u64) -> Case + Sync),
    progress: Progress<'_>,
) -> (Tally, Option<Disagreement>) {
    const CHUNK: u64 = 256;
    let chunks = (numbers.end - numbers.start).div_ceil(CHUNK);
    let chunk = |index: u64| {
        let start = numbers.start + index * CHUNK;
        let range = start..numbers.end.min(start + CHUNK);
        let cases = range.clone().map(|i| (i, case(i)));
        let result = check_cases(plan, cases);
        progress(range.end - range.start);
        result
    };
    (0..chunks).into_par_iter().map(chunk).reduce(<(Tally, Option<Disagreement>)>::default, merge)
}

/// Checks numbered cases one after another.
pub fn check_cases(plan: &Plan, cases: impl Iterator<Item = (u64, Case)>) -> (Tally, Option<Disagreement>) {
    let (pairs, mut tally) = (plan.pairs(), Tally::default());
    let mut smallest = None;
    for (number, case) in cases {
        let found = plan.check_pairs(&pairs, &case, &mut tally).map(|found| Disagreement { number, ..found });
        smallest = smaller(smallest, found);
    }
    (tally, smallest)
}

/// Combines two results.
pub fn merge(
    (tally, found): (Tally, Option<Disagreement>),
    (other, also): (Tally, Option<Disagreement>),
) -> (Tally, Option<Disagreement>) {
    (tally.merge(&other), smaller(found, also))
}

fn smaller(a: Option<Disagreement>, b: Option<Disagreement>) -> Option<Disagreement> {
    // The first of the smallest cases.
    a.into_iter().chain(b).min_by_key(|found| (found.case.size(), found.number))
}

/// Counts of the checks of pausing.
#[derive(Debug, Default)]
pub struct PauseTally {
    /// Number of resumed traversals.
    pub resumes: u64,
    /// Number of pairs of case and traversal that failed.
    pub faults: u64,
    /// The first fault, with the number of its case.
    pub first: Option<(u64, Box<PauseFault>)>,
}

impl PauseTally {
    fn merge(self, later: Self) -> Self {
        Self {
            resumes: self.resumes + later.resumes,
            faults: self.faults + later.faults,
            first: self.first.or(later.first),
        }
    }
}

/// Pauses and resumes the traversals of a plan, in its words, on the small ones of a range of random cases.
pub fn check_pauses(plan: &Plan, numbers: Range<u64>, progress: Progress<'_>) -> PauseTally {
    // Each traversal is resumed after each step by each method, which is feasible for small trees.
    const NODES: usize = 2 * Case::LEAVES as usize;
    let pairs: Vec<_> = plan.pairs().into_iter().filter(|(method, _)| method.can_pause()).collect();
    let check = |i: u64| {
        progress(1);
        let case = plan.case(i);
        if case.size() > NODES {
            return PauseTally::default();
        }
        let pauses = Pauses::new(&case);
        let mut tally = PauseTally::default();
        for &(method, word) in &pairs {
            match with_word(word, InWord { pauses: &pauses, method }) {
                Ok(count) => tally.resumes += count as u64,
                Err(fault) => {
                    tally.faults += 1;
                    tally.first.get_or_insert((i, fault));
                }
            }
        }
        tally
    };
    numbers.into_par_iter().map(check).reduce(PauseTally::default, PauseTally::merge)
}

struct InWord<'a, 'c> {
    pauses: &'a Pauses<'c>,
    method: Method,
}

impl WithWord for InWord<'_, '_> {
    type Output = Result<usize, Box<PauseFault>>;

    fn call<W: KeyWord>(self) -> Self::Output {
        self.pauses.check::<W>(self.method)
    }
}

/// Generates cases at and around the depth limits of the words: combs and caterpillars with every kind of tape.
pub fn boundary_cases(seed: u64) -> impl Iterator<Item = Case> {
    let depths = [0, 1, 2, 30, 31, 32, 33, 62, 63, 64, 65, 126, 127, 128, 129, 200];
    let families = [Family::Comb, Family::Caterpillar, Family::Skew];
    let mut rng = Rng::new(seed);
    families.into_iter().flat_map(move |family| depths.map(|depth| (family, depth))).flat_map(move |(family, depth)| {
        Kind::ALL.map(|kind| {
            let tree = family.tree(&mut rng, depth + 1);
            Case::with_tree(tree, kind, &mut rng)
        })
    })
}
