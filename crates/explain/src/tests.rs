//! The comparison with the oracle detects faults.

use super::judge::Judge;
use super::observe::{self, Log, Seen};
use super::*;
use stackless_bvh::order::Descent;

fn compare(method: Method, change: impl FnOnce(&mut Vec<Seen>)) -> Result<usize, (&'static str, usize)> {
    let (case, log) = (example(), Log::default());
    observe::run(&case, method, &log).unwrap();
    let mut steps = log.into_steps();
    change(&mut steps);
    match Judge::new(&case, method).compare(&steps) {
        Ok(stacks) => Ok(stacks.len()),
        Err(ExplainError::Differs { what, visit, .. }) => Err((what, visit)),
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn what_differs_from_the_oracle_is_seen() {
    assert_eq!(compare(Method::Hashed, |_| ()), Ok(11));
    assert_eq!(compare(Method::Hashed, |steps| steps[5].state.trail = Some(0b1001)), Err(("the trail", 5)));
    assert_eq!(compare(Method::Hashed, |steps| steps[5].state.key = Some(0b10111)), Err(("the key", 5)));
    assert_eq!(compare(Method::Sparse, |steps| steps[5].state.counter = Some(0b10110)), Err(("the counter", 5)));
    assert_eq!(
        compare(Method::Hashed, |steps| steps[2].state.register = Some(steps[1].state.node)),
        Err(("the register", 2))
    );
    assert_eq!(
        compare(Method::Hashed, |steps| steps[6].state.register = Some(steps[7].state.node)),
        Err(("the register", 6))
    );
    assert_eq!(compare(Method::Stack, |steps| steps.swap(4, 5)), Err(("the node", 4)));
    assert_eq!(compare(Method::Stack, |steps| steps[1].descent = Some(Descent::NEITHER)), Err(("the decision", 1)));
    assert_eq!(compare(Method::Stack, |steps| steps.truncate(7)), Err(("the number of visits", 7)));
    assert_eq!(compare(Method::Stack, |steps| steps.push(steps[0].clone())), Err(("the number of visits", 11)));
    assert_eq!(
        compare(Method::Laine1, |steps| steps.iter_mut().for_each(|seen| seen.state.is_restarting = false)),
        Err(("the node", 6))
    );
}
