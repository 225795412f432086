//! The hill climb.

use super::{Cost, Goal, Subject};
use stackless_bvh::generate::Rng;

/// A search on its way: each [`step`](Self::step) costs one case. It can be stopped and looked at after any of them.
#[derive(Debug)]
pub struct Search {
    goal: &'static Goal,
    rng: Rng,
    steps: u64,
    /// Sum of the costs of random cases, and their number.
    random: (f64, u64),
    /// Where the climb is.
    current: Option<(Subject, Cost)>,
    /// Random cases that this climb has begun with.
    starts: u32,
    /// Steps since it got worse.
    stale: u32,
    worst: Option<Worst>,
}

/// The worst case of a search.
#[derive(Clone, Debug)]
pub struct Worst {
    /// The case.
    pub subject: Subject,
    /// What it costs.
    pub cost: Cost,
    /// The step that found it, from 1.
    pub step: u64,
}

/// Random cases of which a climb starts at the worst.
const STARTS: u32 = 64;

/// Steps without a worse case after which a climb ends.
const PATIENCE: u32 = 4000;

impl Search {
    /// Before the first step.
    pub const fn new(goal: &'static Goal, seed: u64) -> Self {
        let rng = Rng::new(seed);
        Self { goal, rng, steps: 0, random: (0.0, 0), current: None, starts: 0, stale: 0, worst: None }
    }

    /// Looks at one more case, and says whether it is the worst so far.
    pub fn step(&mut self) -> bool {
        self.steps += 1;
        if self.stale == PATIENCE {
            (self.current, self.starts, self.stale) = (None, 0, 0);
        }
        let is_random = self.starts < STARTS;
        let next = if is_random {
            self.starts += 1;
            Some(self.goal.draw(&mut self.rng))
        } else {
            self.stale += 1;
            self.current.as_ref().and_then(|(subject, _)| subject.change(&mut self.rng))
        };
        let Some((subject, cost)) = next.and_then(|next| self.goal.cost(&next).map(|cost| (next, cost))) else {
            return false;
        };
        if is_random {
            self.random = (self.random.0 + cost.ratio(), self.random.1 + 1);
        }
        // Equals are taken: where many cases cost the same, that is how the climb gets about.
        match &self.current {
            Some((_, height)) if cost < *height => return false,
            Some((_, height)) if cost == *height => {}
            _ => self.stale = 0,
        }
        let is_worst = self.worst.as_ref().is_none_or(|worst| cost > worst.cost);
        if is_worst {
            self.worst = Some(Worst { subject: subject.clone(), cost, step: self.steps });
        }
        self.current = Some((subject, cost));
        is_worst
    }

    /// Steps so far.
    pub const fn steps(&self) -> u64 {
        self.steps
    }

    /// The mean cost of the random cases so far, of those that have one.
    pub fn random_average(&self) -> f64 {
        let (sum, cases) = self.random;
        sum / cases.max(1) as f64
    }

    /// The worst case so far.
    pub const fn worst(&self) -> Option<&Worst> {
        self.worst.as_ref()
    }
}
