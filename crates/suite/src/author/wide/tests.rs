use super::reference::Reference;
use super::trace::drawn;
use super::trees::chain;
use super::{WIDTHS, levels_if_tree, profiles};
use crate::scripted::{Noted, wide_events};
use crate::{Ask, WideWalk};
use stackless_bvh::wide::oracle;

/// Runs the library's oracle on a case. Returns the visits and the best hit.
fn by_oracle<const A: usize, const SORTED: bool>(walk: &WideWalk) -> (Vec<String>, Option<crate::Best>) {
    let tree = walk.tree::<A>().unwrap();
    let (mut search, mut noted) = (walk.search::<A, SORTED>().unwrap(), Noted::default());
    oracle::traverse(&tree, &mut search, &mut noted);
    (wide_events(&tree, None, &noted.0), search.best())
}

/// Compares two independent references. `[CONF-4]` `[WIDE-5]` `[WIDE-6]`
#[test]
fn the_two_references_agree() {
    for seed in 0..2000 {
        let (name, _, walk) = drawn(seed, 2 + seed as u32 % 40);
        let run = Reference::run(&walk);
        let oracle = match (walk.slots, walk.is_sorted()) {
            (2, true) => by_oracle::<2, true>(&walk),
            (2, false) => by_oracle::<2, false>(&walk),
            (4, true) => by_oracle::<4, true>(&walk),
            (4, false) => by_oracle::<4, false>(&walk),
            (_, true) => by_oracle::<8, true>(&walk),
            (_, false) => by_oracle::<8, false>(&walk),
        };
        assert_eq!((run.events, run.best), oracle, "{name}");
    }
}

/// Returns whether no child begins before its parent, as searches that restart require. `[WRESTART-1]`
fn is_monotone(walk: &WideWalk) -> bool {
    let begins = |rank: u32| rank - rank % walk.slots;
    let mut open = vec![(0, 0)];
    while let Some((node, above)) = open.pop() {
        let lists = walk.children[node as usize].iter().flatten().zip(walk.ranks[node as usize].iter().flatten());
        for (&child, rank) in lists {
            let begin = rank.map_or(above, begins);
            if begin < above {
                return false;
            }
            open.push((child, begin));
        }
    }
    true
}

/// No case for restarting searches has ranks that they do not support. `[WRESTART-1]`
#[test]
fn ranks_do_not_become_less_on_the_way_down() {
    let mut count = 0;
    for case in profiles().into_iter().flat_map(|profile| profile.cases) {
        if let (Ok(Ask::TraceWide(walk) | Ask::ResumeWide(walk)), crate::Expect::Result(_)) =
            (Ask::of(&case.input), &case.expect)
        {
            assert!(is_monotone(&walk), "{}", case.id);
            count += 1;
        }
    }
    assert!(count > 200, "{count}");
    let mut walk = chain(4, 3, |_| 0, |_| true);
    assert!(is_monotone(&walk));
    walk.ranks[0] = Some(vec![Some(12), Some(13)]);
    assert!(!is_monotone(&walk));
}

/// The cases are diverse: small and large, pruned and not, with all features that make cases difficult.
#[test]
fn cases_are_hard_enough() {
    let (mut skipped, mut far, mut hits) = (0, 0, 0);
    for seed in 0..96 {
        let (_, _, walk) = drawn(seed, 3 + seed as u32 / 3);
        let run = Reference::run(&walk);
        skipped += usize::from(run.skipped > 0);
        far += usize::from(run.events.iter().any(|event| event.ends_with(" 3")));
        hits += usize::from(run.best.is_some());
    }
    assert!(skipped > 15 && far > 10 && hits > 25, "{skipped} {far} {hits}");
}

#[test]
fn only_trees_have_levels() {
    for slots in WIDTHS {
        assert_eq!(levels_if_tree(slots, &vec![Some(vec![])]), Some(0));
        assert_eq!(levels_if_tree(slots, &chain(slots, 7, |level| level, |_| true).children), Some(7));
        let many = (1..=slots + 1).collect();
        assert_eq!(levels_if_tree(slots, &[vec![Some(many)], vec![None; slots as usize + 1]].concat()), None);
    }
    for wrong in [
        vec![],
        vec![None],
        vec![Some(vec![1]), Some(vec![])],
        vec![Some(vec![1]), Some(vec![1])],
        vec![Some(vec![0])],
        vec![Some(vec![2]), None],
        vec![Some(vec![1]), None, None],
    ] {
        assert_eq!(levels_if_tree(4, &wrong), None, "{wrong:?}");
    }
}
