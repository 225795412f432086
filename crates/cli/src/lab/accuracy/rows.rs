//! The counts, as written to files.

use super::pairs::Pair;
use super::timing::Time;
use crate::judge::Counts;
use crate::record::{Numbered, Run, expect};
use serde::{Deserialize, Serialize};

/// The kind of a set of rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Kind {
    /// Typical rays of a renderer.
    Ordinary,
    /// Rays aimed at places where rounding errs.
    Adversarial,
    /// Rays from inside of a closed mesh: every ray hits.
    Closed,
}

/// A pair of tests on one set of rays through one scene. Counts that were not measured are `None`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Row {
    pub(super) scene: String,
    pub(super) set: String,
    pub(super) kind: Kind,
    pub(super) kernel: String,
    #[serde(rename = "box")]
    pub(super) slabs: String,
    pub(super) level: Option<String>,
    pub(super) rays: u64,
    pub(super) hits: Option<u64>,
    pub(super) false_misses: Option<u64>,
    pub(super) false_hits: Option<u64>,
    pub(super) wrong_primitives: Option<u64>,
    pub(super) order_differences: Option<u64>,
    pub(super) leaks: Option<u64>,
    pub(super) misses: Option<u64>,
    pub(super) max_ulp: Option<u32>,
    pub(super) p999_ulp: Option<u32>,
    pub(super) mean_ulp: Option<f64>,
    pub(super) timed_rays: Option<u64>,
    pub(super) ns_per_ray: Option<f64>,
    pub(super) mrays: Option<f64>,
    pub(super) ratio: Option<f64>,
    /// The first error of a test that promises none, with the number of its ray.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) offence: Option<Numbered<String>>,
}

impl Row {
    pub(super) fn new(scene: &str, set: &str, kind: Kind, pair: &Pair) -> Self {
        Self {
            scene: scene.to_owned(),
            set: set.to_owned(),
            kind,
            kernel: pair.kernel.name().to_owned(),
            slabs: pair.slabs.name().to_owned(),
            level: pair.level().map(|level| level.name().to_owned()),
            rays: 0,
            hits: None,
            false_misses: None,
            false_hits: None,
            wrong_primitives: None,
            order_differences: None,
            leaks: None,
            misses: None,
            max_ulp: None,
            p999_ulp: None,
            mean_ulp: None,
            timed_rays: None,
            ns_per_ray: None,
            mrays: None,
            ratio: None,
            offence: None,
        }
    }

    pub(super) fn judged(self, counts: &Counts) -> Self {
        Self {
            rays: counts.rays,
            hits: Some(counts.hits),
            false_misses: Some(counts.false_misses),
            false_hits: Some(counts.false_hits),
            wrong_primitives: Some(counts.wrong_primitives),
            order_differences: Some(counts.order_differences),
            max_ulp: counts.quantile(1.0),
            p999_ulp: counts.quantile(0.999),
            mean_ulp: counts.mean(),
            ..self
        }
    }

    pub(super) fn timed(self, time: &Time) -> Self {
        Self {
            timed_rays: Some(time.rays),
            ns_per_ray: Some(time.nanoseconds),
            mrays: Some(1e3 / time.nanoseconds),
            ratio: Some(time.ratio),
            ..self
        }
    }

    /// Drops figures that do not add up: times, quantiles and means.
    pub(super) fn counts_alone(self) -> Self {
        Self { p999_ulp: None, mean_ulp: None, timed_rays: None, ns_per_ray: None, mrays: None, ratio: None, ..self }
    }

    /// Refuses counts that contradict the parts of the run or each other.
    pub(super) fn check(&self, run: &Run) -> Result<(), String> {
        let expect = |what, number, within| {
            expect(&format!("{}, {}, {}, {}: {what}", self.scene, self.set, self.kernel, self.slabs), number, within)
        };
        // Parts of a sphere have its name.
        let of_sphere = run.done(|name| name == self.scene);
        let rays = if run.parts.contains_key(&self.scene) {
            of_sphere..=of_sphere
        } else {
            0..=run.done(|name| name == "rays of each kind")
        };
        expect("rays", self.rays, rays)?;
        let errors = [self.false_misses, self.false_hits, self.wrong_primitives, self.order_differences];
        for number in errors.into_iter().chain([self.hits, self.misses]).flatten() {
            expect("hits, misses and errors", number, 0..=self.rays)?;
        }
        expect("leaks", self.leaks.unwrap_or(0), 0..=self.misses.unwrap_or(0))
    }

    /// Adds the counts of another part.
    pub(super) fn add(&mut self, other: Self) {
        let sum = |mine: &mut Option<u64>, other: Option<u64>| {
            *mine = mine.map_or(other, |mine| Some(mine.saturating_add(other.unwrap_or(0))));
        };
        self.rays = self.rays.saturating_add(other.rays);
        sum(&mut self.hits, other.hits);
        sum(&mut self.false_misses, other.false_misses);
        sum(&mut self.false_hits, other.false_hits);
        sum(&mut self.wrong_primitives, other.wrong_primitives);
        sum(&mut self.order_differences, other.order_differences);
        sum(&mut self.leaks, other.leaks);
        sum(&mut self.misses, other.misses);
        self.max_ulp = self.max_ulp.max(other.max_ulp);
        self.offence = Numbered::first(self.offence.take(), other.offence);
    }

    /// Whether both rows have the tests and rays in common.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        (&self.scene, &self.set) == (&other.scene, &other.set)
            && (&self.kernel, &self.slabs) == (&other.kernel, &other.slabs)
    }

    /// Whether every answer must be true.
    pub(super) fn is_exact(&self) -> bool {
        let tests = self.kernel.parse().ok().zip(self.slabs.parse().ok());
        tests.is_some_and(|(kernel, slabs)| Pair::promises((kernel, slabs)))
    }

    /// Number of wrong answers, plus 1 if a distance is wrong.
    pub(super) fn errors(&self) -> u64 {
        let counts = [self.false_misses, self.false_hits, self.wrong_primitives, self.order_differences, self.leaks];
        let wrong = counts.into_iter().flatten().fold(0, u64::saturating_add);
        wrong.saturating_add(u64::from(self.max_ulp > Some(0)))
    }

    /// Sets the leaks. `misses` counts the leaks and the rays that truly miss.
    pub(super) fn leaked(self, rays: u64, leaks: u64, misses: u64) -> Self {
        Self { rays, leaks: Some(leaks), misses: Some(misses), ..self }
    }
}
