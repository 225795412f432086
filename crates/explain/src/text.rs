//! Descriptions of visits.

use super::judge::Judge;
use super::lookup::binary;
use super::observe::Seen;
use super::{By, Entry, HashLookup, Next, Step, slot};
use stackless_bvh::event::State;
use stackless_bvh::key::{KeyWord as _, Side};
use stackless_bvh::order::Descent;
use stackless_bvh::traverse::{Method, Test};
use stackless_bvh::tree::{Node, Recorded};

impl Judge<'_> {
    /// Converts a visit to its form on the page.
    pub(super) fn step(&self, steps: &[Seen], visit: usize, stack: &[Node]) -> Step {
        let (seen, following) = (&steps[visit], steps.get(visit + 1));
        let (state, wanted) = (&seen.state, self.wanted(seen.state.node, seen.descent));
        let next = following.map(|following| self.next(seen, &following.state, &wanted));
        let (text, clauses) = of(self, seen, next.as_ref());
        let slots = |nodes: &[Node]| nodes.iter().map(|&node| slot(self.tree, node)).collect();
        let links = self.links.of_node(self.tree, state.node);
        let [key, trail, counter, disjoint] =
            [state.key, state.trail, state.counter, state.disjoint].map(|word| word.as_ref().map(binary));
        Step {
            node: slot(self.tree, state.node),
            restart: state.is_restarting,
            key,
            trail,
            counter,
            disjoint,
            register: state.register.map(|node| slot(self.tree, node)),
            links: links.into_iter().map(|link| link.map(|node| slot(self.tree, node))).collect(),
            sets: None,
            rows: Vec::new(),
            stack: slots(stack),
            beyond: Vec::new(),
            decision: seen.descent.map(decision),
            wanted: slots(&wanted),
            hit: seen.found.hit,
            next,
            text,
            clauses,
        }
    }
}

/// Formats a decision.
fn decision(descent: Descent) -> String {
    let side = side(descent.first());
    match (descent.is_neither(), descent.postpones()) {
        (true, _) => "neither child".to_owned(),
        (false, false) => format!("only the {side} child"),
        (false, true) if descent.is_disjoint() => format!("both, {side} first, disjoint"),
        (false, true) => format!("both, {side} first"),
    }
}

/// Returns the description of a visit, and its clauses.
fn of(judge: &Judge<'_>, seen: &Seen, next: Option<&Next>) -> (String, Vec<&'static str>) {
    let (visit, mut clauses) = visited(judge, seen);
    let (way, by) = match next {
        None => end(judge.method, seen),
        Some(next) if next.by == By::Child => down(judge, seen, next),
        Some(next) => back(judge, seen, next),
    };
    clauses.extend(by);
    (format!("{visit} {way}"), clauses)
}

const fn side(side: Side) -> &'static str {
    if side.is_right() { "right" } else { "left" }
}

/// Describes the hit or the decision.
fn visited(judge: &Judge<'_>, seen: &Seen) -> (String, Vec<&'static str>) {
    let node = judge.name(seen.state.node);
    let wanted: Vec<_> = judge.wanted(seen.state.node, seen.descent).into_iter().map(|node| judge.name(node)).collect();
    if seen.state.is_restarting {
        return (format!("Node {node} is passed again on the way down from the root."), vec!["LAINE-1"]);
    }
    let tests_nodes = matches!(judge.method.test(), Test::NodeLeftFirst | Test::NodeBySign);
    let text = match (seen.descent, &wanted[..]) {
        (Some(descent), [only]) => format!("Of {node} only the {} child, {only}, is wanted.", side(descent.first())),
        (Some(_), [first, _]) if tests_nodes => format!("Node {node} is wanted; its near child is {first}."),
        (Some(_), [first, second]) => format!("Both children of {node} are wanted, {first} before {second}."),
        (Some(_), _) if tests_nodes => format!("Node {node} is not wanted."),
        (Some(_), _) => format!("No child of {node} is wanted."),
        (None, _) if seen.found.stops => format!("Leaf {node} is hit, which answers the query."),
        (None, _) if seen.found.hit && seen.found.prunes && seen.state.disjoint.is_some() => {
            format!("Leaf {node} is hit: the trail drops nodes that are marked as disjoint.")
        }
        (None, _) if seen.found.hit => format!("Leaf {node} is hit."),
        (None, _) => format!("Leaf {node} has no hit."),
    };
    let clause = if seen.descent.is_some() { "ORDER-1" } else { "TRACE-1" };
    let pruned = seen.found.prunes && seen.state.disjoint.is_some();
    (text, if pruned { vec![clause, "DISJOINT-2"] } else { vec![clause] })
}

fn end(method: Method, seen: &Seen) -> (String, Vec<&'static str>) {
    let text = match (seen.found.stops, seen.state.trail, seen.state.counter) {
        (true, ..) => return ("The search stops.".to_owned(), vec!["ORACLE-1"]),
        (_, Some(0), _) => "The trail is 0: no node is postponed.",
        (_, _, Some(counter)) if counter.is_all_ones() => "The counter is all ones: no node is postponed.",
        _ => "No node is postponed.",
    };
    let clause = if seen.state.trail.is_some() { "TRAIL-3" } else { method.clause() };
    (text.to_owned(), vec![clause])
}

/// Describes the step to a child.
fn down(judge: &Judge<'_>, seen: &Seen, next: &Next) -> (String, Vec<&'static str>) {
    let child = judge.name_of(next.node);
    if seen.state.is_restarting {
        return (format!("The trail leads to {child}."), vec![]);
    }
    let postponed = judge.wanted(seen.state.node, seen.descent).get(1).map(|&node| judge.name(node));
    let has_register = judge.method.wants_recorded() == Recorded::Uncles;
    let mut clauses = Vec::new();
    let word = match (seen.state.trail, seen.state.counter, postponed.is_some()) {
        (Some(_), _, pending) => {
            clauses.push("TRAIL-2");
            Some(if pending { "the trail gets a 1" } else { "the trail gets a 0" })
        }
        (None, Some(_), pending) => {
            clauses.push(judge.method.clause());
            Some(if pending { "the counter gets a 0" } else { "the counter gets a 1" })
        }
        _ => None,
    };
    let text = match (postponed, word) {
        (Some(postponed), Some(word)) if has_register => {
            clauses.push("REGISTER-2");
            format!("Next is {child}; {postponed} is postponed: {word}, and the register takes {postponed}.")
        }
        (Some(postponed), Some(word)) => format!("Next is {child}; {postponed} is postponed: {word}."),
        (Some(postponed), None) => {
            clauses.push(judge.method.clause());
            format!("Next is {child}; {postponed} is postponed.")
        }
        (None, Some(word)) => format!("Next is {child}; {word}."),
        (None, None) => format!("Next is {child}."),
    };
    (text, clauses)
}

/// Describes the step to a postponed node.
fn back(judge: &Judge<'_>, seen: &Seen, next: &Next) -> (String, Vec<&'static str>) {
    let (name, method) = (judge.name_of(next.node), judge.method);
    let mut clauses = Vec::new();
    let mut text = String::new();
    if let Some(levels) = next.levels {
        let up = match levels {
            0 => format!("to the sibling {name}"),
            1 => format!("1 level up, to the sibling {name}"),
            levels => format!("{levels} levels up, to the sibling {name}"),
        };
        let end = match levels {
            0 => "a 1".to_owned(),
            1 => "1 zero".to_owned(),
            levels => format!("{levels} zeros"),
        };
        let State { key, trail, counter, .. } = &seen.state;
        let [key, trail, counter] = [key, trail, counter].map(|word| word.as_ref().map(binary));
        text = match (&key, &trail, &counter) {
            // The hit has changed the trail since the visit was shown.
            (_, Some(_), _) if seen.found.prunes && seen.state.disjoint.is_some() => format!("Back: {up}."),
            (Some(key), Some(trail), _) => {
                clauses.extend(["TRAIL-3", "TRAIL-4"]);
                let next = binary(&judge.key_of(next.node));
                format!("The trail {trail} ends in {end}: {up}; the key {key} becomes {next}.")
            }
            (None, Some(trail), _) => {
                clauses.push("TRAIL-3");
                format!("The trail {trail} ends in {end}: {up}.")
            }
            (_, None, Some(counter)) => {
                clauses.push("TRAIL-6");
                format!("The counter {counter} plus 1 ends in {end}: {up}.")
            }
            _ => format!("Back: {up}."),
        };
    }
    let (how, clause) = source(judge, next, &name);
    clauses.push(clause.unwrap_or(method.clause()));
    (format!("{text} {how}").trim_start().to_owned(), clauses)
}

/// Describes the source of the address, with its clause if it is not the traversal's own.
fn source(judge: &Judge<'_>, next: &Next, name: &str) -> (String, Option<&'static str>) {
    let way = || next.way.iter().map(|&node| judge.name_of(node)).collect::<Vec<_>>().join(", ");
    let steps = next.way.len();
    match (next.by, &next.lookup) {
        (By::Table, Some(lookup)) => {
            let reason = if judge.method.wants_recorded() == Recorded::Nothing { "" } else { "No record names it. " };
            (format!("{reason}{}", looked_up(lookup)), None)
        }
        (By::Register, _) => ("The register holds its address.".to_owned(), Some("REGISTER-1")),
        (By::Uncle, _) => (format!("It is the uncle: the record names {name}."), Some("REGISTER-2")),
        (By::GrandUncle, _) => (format!("It is the grand uncle: the record names {name}."), Some("REGISTER-2")),
        (By::Climb, _) if judge.method.wants_recorded() == Recorded::Uncles => {
            (format!("By grand uncles, two levels per step, through {}.", way()), None)
        }
        (By::Climb, _) if steps == 1 => (format!("Through the parent {} to its sibling.", way()), None),
        (By::Climb, _) if steps == 0 => ("The record names it.".to_owned(), None),
        (By::Climb, _) => (format!("Through the parents {} to the sibling of the last.", way()), None),
        (By::Stack, _) if judge.method.restarts() => ("The short stack has its address.".to_owned(), None),
        (By::Stack, _) => ("Its address is on top of the stack.".to_owned(), None),
        (By::Skip, _) => ("The skip pointer names it.".to_owned(), None),
        (By::Restart, _) => {
            ("The short stack has lost the next node: the traversal restarts at the root.".to_owned(), None)
        }
        (By::Key | By::Child | By::Table | By::Parent | By::Ancestor, _) => {
            ("Its address follows from its key.".to_owned(), None)
        }
    }
}

/// Describes the result of a lookup.
pub(super) fn looked_up(lookup: &HashLookup) -> String {
    let bucket = lookup.bucket;
    match (lookup.entry, lookup.cell) {
        (Entry::Displacement(displacement), Some(cell)) => {
            format!("Bucket {bucket} of the table has the displacement {displacement}, which leads to cell {cell}.")
        }
        _ => format!("Bucket {bucket} of the table has its address."),
    }
}
