//! The comparison with the oracle detects faults.

use super::observe::{Log, Seen};
use super::*;
use stackless_bvh::internals::wide::StateView;
use stackless_bvh::trace::RayQueries;

fn compare(method: Method, change: impl FnOnce(&mut Vec<Seen>)) -> Result<usize, (&'static str, usize)> {
    let case = example();
    let (tree, search) = (&case.tree, case.search::<true>());
    let (places, tables) = (Places::of(tree), Tables::new(tree));
    let log = Log::new(&places);
    observe::run(tree, &tables, method, search.clone(), &log).unwrap();
    let (mut steps, _) = log.into_steps();
    change(&mut steps);
    match Judge::new(tree, search, method, &places, &tables).compare(&steps) {
        Ok(stacks) => Ok(stacks.len()),
        Err(ExplainError::Differs { what, visit, .. }) => Err((what, visit)),
        Err(error) => panic!("{error}"),
    }
}

/// Changes the stored state of the root at the second visit.
fn of_root(steps: &mut [Seen], change: impl FnOnce(&mut StateView)) {
    change(&mut steps[1].levels[0].words);
}

#[test]
fn what_differs_from_the_oracle_is_seen() {
    for method in [Method::Stack, Method::Trail, Method::Recorded, Method::Hashed] {
        assert_eq!(compare(method, |_| ()), Ok(12), "{method}");
        assert_eq!(compare(method, |steps| steps.swap(4, 5)), Err(("the node", 4)), "{method}");
        assert_eq!(compare(method, |steps| steps.truncate(7)), Err(("the number of visits", 7)), "{method}");
        let again = |steps: &mut Vec<Seen>| steps.push(steps[0].clone());
        assert_eq!(compare(method, again), Err(("the number of visits", 12)), "{method}");
        assert_eq!(compare(method, |steps| steps[1].wanted = Some(Vec::new())), Err(("the answer", 1)), "{method}");
    }
    assert_eq!(compare(Method::Hashed, |steps| steps[2].key = Some(0o124)), Err(("the key", 2)));
    let more = |words: &mut StateView| match words {
        StateView::Trail { pending, .. } | StateView::Ranked { pending, .. } => *pending ^= 1,
        StateView::Number { number, .. } => *number += 1,
    };
    for (method, what) in
        [(Method::Trail, "the pending set"), (Method::Recorded, "the pending set"), (Method::Restart0, "the number")]
    {
        assert_eq!(compare(method, |steps| of_root(steps, more)), Err((what, 1)), "{method}");
    }
    let dirty = |words: &mut StateView| {
        if let StateView::Trail { is_dirty, .. } = words {
            *is_dirty ^= true;
        }
    };
    assert_eq!(compare(Method::Trail, |steps| of_root(steps, dirty)), Err(("the dirty bit", 1)));
    let closed = |words: &mut StateView| {
        if let StateView::Ranked { is_open, .. } = words {
            *is_open = Some(false);
        }
    };
    assert_eq!(compare(Method::Hashed, |steps| of_root(steps, closed)), Err(("the summary bit", 1)));
    let later = |words: &mut StateView| {
        if let StateView::Ranked { ranks, .. } = words {
            ranks[1] += 8;
        }
    };
    assert_eq!(compare(Method::Recorded, |steps| of_root(steps, later)), Err(("a rank", 1)));
    let last = |words: &mut StateView| {
        if let StateView::Number { is_last, .. } = words {
            *is_last = true;
        }
    };
    assert_eq!(compare(Method::Restart0, |steps| of_root(steps, last)), Err(("what is left", 1)));
    let visits = |steps: &mut Vec<Seen>| steps.iter_mut().for_each(|seen| seen.is_restarting = false);
    assert!(matches!(compare(Method::Restart0, visits), Err(("the node", _))));
}

#[test]
fn the_case_of_a_ray_is_what_the_tracer_does() {
    use stackless_bvh::bvh::WideBvh;
    use stackless_bvh::generate::procedural;
    use stackless_bvh::trace::Tracer;

    let mesh = procedural::soup(3, 400);
    let bvh = WideBvh::build(&mesh).unwrap();
    let mut hits = 0;
    for method in Method::ALL {
        let tracer = Tracer::with_method(&bvh, method).unwrap();
        for ray in procedural::rays(&mesh, 5, 60) {
            let case = of_ray(&bvh, &ray);
            let recording = record(&case.tree, &case.search::<true>(), method).unwrap();
            let (counters, mut asked, mut leaves) = (tracer.count_closest(&[ray]), 0, 0);
            for step in &recording.steps {
                // Queried at its visit, at each repetition, and at each mention in the text.
                asked += u64::from(step.decision.is_some()) + step.text.matches("is queried again").count() as u64;
                leaves += u64::from(step.decision.is_none() && !step.restart);
            }
            assert_eq!((asked, leaves), (counters.nodes, counters.leaves), "{method}, {ray:?}");
            assert_eq!(recording.steps.iter().any(|step| step.hit), tracer.closest(&ray).is_some());
            hits += usize::from(tracer.closest(&ray).is_some());
        }
    }
    assert!((90..540).contains(&hits), "{hits}");
}
