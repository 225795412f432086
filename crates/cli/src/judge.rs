//! Compares answers with the truth.

use std::collections::BTreeMap;

use rayon::prelude::*;
use stackless_bvh::geom::Ray;
use stackless_bvh::internals::trace::Truth;
use stackless_check::floats_between;

use crate::output::bar;

/// The kind of query.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Query {
    Closest,
    Any,
}

/// Triangle and distance. The distance is meaningless for any-hit queries.
pub(crate) type Answer = Option<(u32, f32)>;

/// Rays, each with all its true hits in their order.
pub(crate) struct Truths {
    rays: Vec<Ray>,
    hits: Vec<Vec<(u32, f32)>>,
}

/// Counts of wrong answers.
#[derive(Debug, Default)]
pub(crate) struct Counts {
    pub(crate) rays: u64,
    /// Number of rays that truly hit.
    pub(crate) hits: u64,
    pub(crate) false_misses: u64,
    pub(crate) false_hits: u64,
    /// A triangle other than the closest; for any-hit queries, a triangle that the ray misses.
    pub(crate) wrong_primitives: u64,
    /// Answers that differ for another tree or order.
    pub(crate) order_differences: u64,
    /// Number of distances by their error, in floats from the correctly rounded distance.
    pub(crate) ulps: BTreeMap<u32, u64>,
    /// The first error, in words, and the index of its ray among the judged rays.
    pub(crate) offence: Option<(usize, String)>,
}

impl Truths {
    /// Computes the truth about at most `n` of the rays, evenly spaced: number `i` is ray `chosen(i, n, all)`.
    pub(crate) fn new(truth: &Truth, rays: &[Ray], n: usize, name: &str) -> Self {
        let n = n.min(rays.len());
        let rays: Vec<_> = (0..n).map(|i| rays[chosen(i, n, rays.len())]).collect();
        let progress = bar(rays.len() as u64, &format!("{name}, truth"));
        let hits = |ray: &Ray| {
            let hits = truth.all(ray).into_iter().map(|hit| (hit.prim, hit.t)).collect();
            progress.inc(1);
            hits
        };
        let hits = rays.par_iter().map(hits).collect();
        progress.finish_and_clear();
        Self { rays, hits }
    }

    pub(crate) fn rays(&self) -> &[Ray] {
        &self.rays
    }

    /// The true closest hit of ray `i`, if there is such a ray.
    pub(crate) fn closest(&self, i: usize) -> Answer {
        self.hits.get(i)?.first().copied()
    }

    /// Counts the errors of answers to all rays. The first answer of each ray is judged; the remaining answers must be
    /// equal to it.
    pub(crate) fn counts<const N: usize>(&self, query: Query, answers: &[[Answer; N]]) -> Counts {
        let mut counts = Counts::default();
        for (i, ((ray, truth), answers)) in self.rays.iter().zip(&self.hits).zip(answers).enumerate() {
            counts.add(query, (i, ray), truth, *answers);
        }
        counts
    }
}

/// The index of ray `i` of `n` evenly spaced rays.
pub(crate) const fn chosen(i: usize, n: usize, all: usize) -> usize {
    i * all / n
}

impl Counts {
    /// `truth` has all hits in order.
    fn add<const N: usize>(
        &mut self,
        query: Query,
        (index, ray): (usize, &Ray),
        truth: &[(u32, f32)],
        answers: [Answer; N],
    ) {
        self.rays += 1;
        self.hits += u64::from(!truth.is_empty());
        let Some((&judged, others)) = answers.split_first() else { return };
        let (error, ulps) = verdict(query, truth, judged);
        match error {
            Some(Error::FalseMiss) => self.false_misses += 1,
            Some(Error::FalseHit) => self.false_hits += 1,
            Some(Error::WrongPrimitive) => self.wrong_primitives += 1,
            None => {}
        }
        if let Some(ulps) = ulps {
            *self.ulps.entry(ulps).or_default() += 1;
        }
        let differs = others.iter().any(|&other| !is_same(query, judged, other));
        self.order_differences += u64::from(differs);
        if (error.is_some() || differs || ulps.is_some_and(|ulps| ulps > 0)) && self.offence.is_none() {
            let (ray, truth) = (csv_line(ray), truth.first());
            let what = format!("ray {ray}: expected the closest hit {truth:?}, found {answers:?}");
            self.offence = Some((index, what));
        }
    }

    /// The error of distances at this quantile, in floats.
    pub(crate) fn quantile(&self, share: f64) -> Option<u32> {
        let wanted = (share * self.ulps.values().sum::<u64>() as f64).ceil() as u64;
        let mut seen = 0;
        let reaches = |&(_, count): &(&u32, &u64)| {
            seen += count;
            seen >= wanted
        };
        self.ulps.iter().find(reaches).map(|(&ulps, _)| ulps)
    }

    /// The mean error of distances, in floats.
    pub(crate) fn mean(&self) -> Option<f64> {
        let sum: f64 = self.ulps.iter().map(|(&ulps, &count)| f64::from(ulps) * count as f64).sum();
        (!self.ulps.is_empty()).then(|| sum / self.ulps.values().sum::<u64>() as f64)
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Error {
    FalseMiss,
    FalseHit,
    WrongPrimitive,
}

/// The error of an answer, and for the right triangle the error of the distance, in floats.
fn verdict(query: Query, truth: &[(u32, f32)], answer: Answer) -> (Option<Error>, Option<u32>) {
    let Some(closest) = truth.first() else { return (answer.map(|_| Error::FalseHit), None) };
    let Some((prim, t)) = answer else { return (Some(Error::FalseMiss), None) };
    match query {
        Query::Any if truth.iter().any(|hit| hit.0 == prim) => (None, None),
        Query::Closest if closest.0 == prim => (None, Some(floats_between(t, closest.1))),
        _ => (Some(Error::WrongPrimitive), None),
    }
}

/// Whether two exact answers agree.
pub(crate) fn is_same(query: Query, a: Answer, b: Answer) -> bool {
    let bits = |answer: Answer| answer.map(|(prim, t)| (prim, t.to_bits()));
    match query {
        Query::Any => a.is_some() == b.is_some(),
        Query::Closest => bits(a) == bits(b),
    }
}

/// A ray in the CSV format of `stackless trace`.
pub(crate) fn csv_line(ray: &Ray) -> String {
    let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin().to_array(), ray.direction().to_array());
    format!("{ox:?},{oy:?},{oz:?},{dx:?},{dy:?},{dz:?},{:?},{:?}", ray.tmin(), ray.tmax())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn verdicts() {
        use Query::{Any, Closest};
        let truth = [(3, 1.0), (5, 1.0), (4, 2.0)];
        for query in [Closest, Any] {
            assert_eq!(verdict(query, &[], None), (None, None));
            assert_eq!(verdict(query, &[], Some((1, 1.0))), (Some(Error::FalseHit), None));
            assert_eq!(verdict(query, &truth, None), (Some(Error::FalseMiss), None));
            assert_eq!(verdict(query, &truth, Some((7, 1.0))), (Some(Error::WrongPrimitive), None));
        }
        assert_eq!(verdict(Closest, &truth, Some((3, 1.0))), (None, Some(0)));
        assert_eq!(verdict(Closest, &truth, Some((3, 1.0f32.next_down().next_down()))), (None, Some(2)));
        assert_eq!(verdict(Closest, &[(0, 0.0)], Some((0, -0.0))), (None, Some(0)));
        assert_eq!(verdict(Closest, &truth, Some((5, 1.0))), (Some(Error::WrongPrimitive), None));
        assert_eq!(verdict(Any, &truth, Some((4, f32::NAN))), (None, None));
    }

    #[test]
    fn answers_are_counted() {
        let ray = Ray::new(Vec3::ZERO, Vec3::X).unwrap();
        let (right, late) = (Some((3, 1.0)), Some((3, 1.0f32.next_up())));
        let mut counts = Counts::default();
        for _ in 0..999 {
            counts.add(Query::Closest, (7, &ray), &[(3, 1.0)], [right; 3]);
        }
        assert!(counts.offence.is_none());
        counts.add(Query::Closest, (7, &ray), &[(3, 1.0)], [late; 3]);
        assert!(counts.offence.is_some());
        assert_eq!((counts.quantile(0.999), counts.quantile(1.0), counts.mean()), (Some(0), Some(1), Some(0.001)));
        for answers in [[right, late, right], [right, right, None], [None; 3]] {
            counts.add(Query::Closest, (7, &ray), &[(3, 1.0)], answers);
        }
        counts.add(Query::Any, (7, &ray), &[(3, 1.0)], [right, late, right]);
        counts.add(Query::Any, (7, &ray), &[], [right, right, None]);
        let all = counts;
        assert_eq!((all.rays, all.hits), (1005, 1004));
        assert_eq!((all.false_misses, all.false_hits, all.wrong_primitives, all.order_differences), (1, 1, 0, 3));
        assert_eq!(all.ulps, [(0, 1001), (1, 1)].into());
        assert_eq!(Counts::default().quantile(0.999), None);
    }
}
