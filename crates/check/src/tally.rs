//! Counts of a check, by traversal and word.

use super::Verdict;
use stackless_bvh::traverse::{Method, Unsupported, WordName};

/// Counts for one traversal with one word.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// Cases that were run.
    pub cases: u64,
    /// Cases in which the traversal agreed with its oracle.
    pub agree: u64,
    /// Cases that the traversal refused before the first step.
    pub refused: u64,
    /// A reason for a refusal: the last in the order of the texts, so it does not depend on the order of cases.
    pub refusal: Option<Unsupported>,
    /// Visits, restarts included.
    pub steps: u64,
}

/// Counts for all traversals and words.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    counts: [[Count; WordName::ALL.len()]; Method::ALL.len()],
    /// The texts of the refusals, which determine their order.
    texts: [[String; WordName::ALL.len()]; Method::ALL.len()],
    /// Depth of the deepest checked tree, in edges.
    pub depth: u32,
    /// Searches whose oracle differs from the test of all triangles.
    pub oracle_faults: u64,
    /// Lookups in a scene's perfect hash that did not find the node of the key.
    pub misses: u64,
}

impl Tally {
    /// Adds one verdict.
    pub fn add<F>(&mut self, method: Method, word: WordName, verdict: &Verdict<F>) {
        let count = &mut self.counts[method as usize][word as usize];
        let text = &mut self.texts[method as usize][word as usize];
        match verdict {
            Verdict::Agrees { steps } => {
                count.cases += 1;
                count.agree += 1;
                count.steps += steps;
            }
            Verdict::Refused(unfit) => {
                count.refused += 1;
                // Refusals are nearly always equal.
                if count.refusal != Some(*unfit) {
                    count.note(text, *unfit, unfit.to_string());
                }
            }
            Verdict::Differs(_) => count.cases += 1,
        }
    }

    /// Adds the counts of another tally.
    #[must_use]
    pub fn merge(mut self, other: &Self) -> Self {
        let texts = self.texts.iter_mut().flatten().zip(other.texts.iter().flatten());
        let counts = self.counts.iter_mut().flatten().zip(other.counts.iter().flatten());
        for ((mine, theirs), (text, their_text)) in counts.zip(texts) {
            mine.cases += theirs.cases;
            mine.agree += theirs.agree;
            mine.refused += theirs.refused;
            if let Some(refusal) = theirs.refusal {
                mine.note(text, refusal, their_text.clone());
            }
            mine.steps += theirs.steps;
        }
        self.depth = self.depth.max(other.depth);
        self.oracle_faults += other.oracle_faults;
        self.misses += other.misses;
        self
    }

    /// Returns the counts of one traversal with one word.
    pub fn get(&self, method: Method, word: WordName) -> Count {
        self.counts[method as usize][word as usize]
    }

    /// Counts disagreements: of a traversal with its oracle, of an oracle with the exact answer, and wrong lookups.
    pub fn disagreements(&self) -> u64 {
        self.misses
            + self.oracle_faults
            + self.counts.iter().flatten().map(|count| count.cases - count.agree).sum::<u64>()
    }

    /// Counts comparisons.
    pub fn comparisons(&self) -> u64 {
        self.counts.iter().flatten().map(|count| count.cases).sum()
    }
}

impl Count {
    /// Stores a refusal and its text, if the text comes later in order.
    fn note(&mut self, text: &mut String, refusal: Unsupported, its_text: String) {
        if self.refusal.is_none() || *text < its_text {
            (self.refusal, *text) = (Some(refusal), its_text);
        }
    }
}
