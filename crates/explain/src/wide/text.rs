//! Descriptions of visits of wide trees, in words and digits.

use super::judge::{Judge, group, number};
use super::observe::{Back, LevelState, Seen};
use super::places::children;
use crate::text::looked_up;
use crate::{By, Next, Step};
use stackless_bvh::internals::wide::StateView;
use stackless_bvh::tree::Node;
use stackless_bvh::wide::{Method, Topology as _};

impl<const A: usize> Judge<'_, A> {
    /// Converts a step to its form on the page.
    pub(super) fn step(&self, steps: &[Seen], at: usize, postponed: &[(Node, u32)]) -> Step {
        let seen = &steps[at];
        let next = steps.get(at + 1).map(|following| self.next(seen, following));
        let (text, clauses) = of(self, seen, next.as_ref(), postponed.is_empty());
        let beyond = postponed.iter().filter(|&&(_, rank)| self.is_beyond(rank, seen.end));
        let numbers = |nodes: &mut dyn Iterator<Item = &(Node, u32)>| nodes.map(|(node, _)| number(*node)).collect();
        let words = Digits::of::<A>(&seen.levels);
        // A leaf has no record, so the traversal is at its parent.
        let at = if seen.node.is_leaf() { self.places.ancestors(seen.node)[0] } else { seen.node };
        let links = (1..=self.links()).map(|up| {
            let is_there = up <= self.places.depth(at);
            is_there.then(|| number(self.tree.ancestor(at, up)))
        });
        Step {
            node: number(seen.node),
            restart: seen.is_restarting,
            key: seen.key.map(|key| format!("{key:b}")),
            trail: words.trail,
            counter: None,
            disjoint: None,
            sets: words.sets,
            rows: words.rows,
            register: None,
            links: links.collect(),
            stack: numbers(&mut postponed.iter()),
            beyond: numbers(&mut beyond.into_iter()),
            decision: seen.wanted.as_ref().map(|wanted| decision(wanted.len(), children(self.tree, seen.node).count())),
            wanted: numbers(&mut seen.wanted.iter().flatten()),
            hit: seen.is_hit,
            next,
            text,
            clauses,
        }
    }
}

/// The stored state of all levels, as digits.
#[derive(Default)]
struct Digits {
    trail: Option<String>,
    sets: Option<String>,
    rows: Vec<(&'static str, Vec<String>)>,
}

impl Digits {
    fn of<const A: usize>(levels: &[LevelState]) -> Self {
        let mut digits = Self::default();
        for LevelState { words, .. } in levels {
            match *words {
                StateView::Trail { pending, is_dirty } => {
                    digits.trail.get_or_insert_default().push_str(&group::<A>(pending));
                    digits.cell("dirty", Some(is_dirty.into()));
                }
                StateView::Ranked { pending, is_open, ranks: [first, second] } => {
                    digits.sets.get_or_insert_default().push_str(&group::<A>(pending));
                    digits.cell("summary", is_open.map(u32::from));
                    digits.cell("1st rank", (first != 0).then_some(first / A as u32));
                    digits.cell("2nd rank", (second != 0).then_some(second / A as u32));
                }
                StateView::Number { number, is_last } => {
                    digits.cell("number", Some(number));
                    digits.cell("last", Some(is_last.into()));
                }
            }
        }
        // Like words, without leading zeros.
        digits.trail = digits.trail.map(|trail| match trail.trim_start_matches('0') {
            "" => "0".to_owned(),
            bits => bits.to_owned(),
        });
        digits
    }

    fn cell(&mut self, row: &'static str, value: Option<u32>) {
        let cell = value.map_or_else(String::new, |value| value.to_string());
        match self.rows.iter_mut().find(|(name, _)| *name == row) {
            Some((_, cells)) => cells.push(cell),
            None => self.rows.push((row, vec![cell])),
        }
    }
}

/// Formats an answer.
fn decision(wanted: usize, children: usize) -> String {
    format!("{wanted} of {}", counted(children))
}

fn counted(children: usize) -> String {
    if children == 1 { "1 child".to_owned() } else { format!("{children} children") }
}

/// Returns the description of a visit, and its clauses. `is_empty` means that the oracle has no postponed nodes.
fn of<const A: usize>(
    judge: &Judge<'_, A>,
    seen: &Seen,
    next: Option<&Next>,
    is_empty: bool,
) -> (String, Vec<&'static str>) {
    let (mut text, mut clauses) = visited(judge, seen);
    let mut add = |(sentence, clause): (String, &'static str)| {
        text = format!("{text} {sentence}");
        if !clauses.contains(&clause) {
            clauses.push(clause);
        }
    };
    for back in &seen.backs {
        gone_back(judge, seen, back).into_iter().for_each(&mut add);
    }
    match next {
        None if seen.stops => add(("The search stops.".to_owned(), "WIDE-5")),
        None if is_empty => add(("No node is pending.".to_owned(), "WIDE-5")),
        None => add(("All pending nodes are beyond the end.".to_owned(), "WIDE-3")),
        Some(next) => add(onward(judge, seen, next)),
    }
    (text, clauses)
}

/// Describes the hit or the wanted children.
fn visited<const A: usize>(judge: &Judge<'_, A>, seen: &Seen) -> (String, Vec<&'static str>) {
    let node = judge.name(seen.node);
    if seen.is_restarting {
        return (format!("Node {node} is passed again on the way down from the root."), vec!["WRESTART-1"]);
    }
    let Some(wanted) = &seen.wanted else {
        let text = match (seen.is_hit, seen.stops) {
            (_, true) => format!("Leaf {node} is hit, which answers the query."),
            (true, false) => format!("Leaf {node} is hit: the search now ends there."),
            (false, false) => format!("Leaf {node} has no hit."),
        };
        return (text, vec![if seen.is_hit { "WIDE-3" } else { "WIDE-5" }]);
    };
    let names: Vec<_> = wanted.iter().map(|&(child, _)| judge.name(child)).collect();
    let order = if judge.is_sorted() { "the nearest first" } else { "leaves first" };
    let text = match &names[..] {
        [] => format!("No child of {node} is wanted."),
        [only] => format!("One child of {node} is wanted: {only}."),
        names => format!("{} children of {node} are wanted, {order}: {}.", names.len(), names.join(", ")),
    };
    (text, vec!["WIDE-2", if judge.is_sorted() { "WIDE-5" } else { "WIDE-6" }])
}

/// Describes the return to an ancestor, and its repeated query.
fn gone_back<const A: usize>(judge: &Judge<'_, A>, seen: &Seen, back: &Back) -> Vec<(String, &'static str)> {
    let (to, clause) = (judge.name(back.to), judge.method.clause());
    let mut said = Vec::new();
    if back.from != back.to {
        let up = judge.places.depth(back.from) - judge.places.depth(back.to);
        let levels = if up == 1 { "1 level".to_owned() } else { format!("{up} levels") };
        if is_dropped(judge, seen, back) {
            said.push(("Pending nodes below are beyond the end, by the stored rank.".to_owned(), "WIDE-17"));
        }
        said.push((format!("{levels} up, {to} has pending children."), "WIDE-11"));
        let names = |nodes: &[Node]| nodes.iter().map(|&node| judge.name(node)).collect::<Vec<_>>().join(", ");
        said.push(match (judge.lookup(back), judge.method, &back.read[..]) {
            (Some(lookup), ..) => (format!("Its key {} is looked up. {}", lookup.key, looked_up(&lookup)), clause),
            (_, Method::Trail, read) => (format!("By parents, in the records of {}.", names(read)), clause),
            (_, _, [one]) => (format!("The record of {} names it.", judge.name(*one)), clause),
            (_, _, read) => (format!("By the ancestors in the records of {}.", names(read)), clause),
        });
    }
    if back.is_asked {
        let clause = if judge.method == Method::Trail { "WIDE-18" } else { "WIDE-17" };
        said.push((format!("Node {to} is queried again."), clause));
    }
    said
}

/// Returns whether a set between the two nodes is not empty, but was skipped without reading its node.
fn is_dropped<const A: usize>(judge: &Judge<'_, A>, seen: &Seen, back: &Back) -> bool {
    let between = judge.places.depth(back.to) + 1..judge.places.depth(back.from);
    let is_open = |kept: &LevelState| matches!(kept.words, StateView::Ranked { pending, .. } if pending != 0);
    between.filter_map(|level| seen.levels.get(level as usize)).any(is_open)
}

/// Describes the step to the next node.
fn onward<const A: usize>(judge: &Judge<'_, A>, seen: &Seen, next: &Next) -> (String, &'static str) {
    let (to, clause) = (judge.name_of(next.node), judge.method.clause());
    let others = seen.wanted.as_ref().map_or(0, |wanted| wanted.len().saturating_sub(1));
    match next.by {
        By::Child if seen.is_restarting => (format!("Next is {to}."), clause),
        By::Child if others == 0 => (format!("Next is {to}."), "WIDE-10"),
        By::Child if judge.method == Method::Stack => (format!("Next is {to}; the other children are pushed."), clause),
        By::Child => (format!("Next is {to}; the other children stay pending."), "WIDE-10"),
        By::Restart => {
            ("The short stack has lost the next node: the traversal restarts at the root.".to_owned(), clause)
        }
        By::Stack if judge.method == Method::Stack => (format!("The top of the stack is {to}."), clause),
        By::Stack => (format!("The short stack has {to}."), clause),
        By::Parent => (format!("The next pending sibling is {to}."), "WIDE-19"),
        _ => (format!("Its next pending child is {to}."), "WIDE-19"),
    }
}
