use super::reference::{Reference, Rule, Search};
use super::trees::{Scene, random, random_script};
use crate::Walk;
use crate::own::text::events;
use stackless_bvh::event::Trace;
use stackless_bvh::generate::{self, Kind};
use stackless_bvh::oracle;
use stackless_bvh::order::{ByNode, LeftOrder, Pruning, SignOrder};
use stackless_bvh::tree::{Keys, Topology};

/// Runs the library's oracle on a case.
fn by_oracle(case: &stackless_check::Case, rule: Rule) -> (Vec<String>, Option<(u32, usize)>) {
    let mut search = generate::Search::new(&case.tree, &case.tape, case.any);
    let (tree, mut trace) = (&case.tree, Trace::default());
    let pruning = match rule {
        Rule::Disjoint => Pruning::Disjoint,
        Rule::Distance => Pruning::Distance,
        _ => Pruning::Never,
    };
    match rule {
        Rule::NodeLeft => oracle::traverse(tree, &mut ByNode { test: &mut search, order: LeftOrder }, &mut trace),
        Rule::NodeSign(octant) => {
            let order = SignOrder { axes: case.tape.axes(), octant };
            oracle::traverse(tree, &mut ByNode { test: &mut search, order }, &mut trace);
        }
        _ => {
            oracle::traverse_pruned(tree, tree.root(), pruning, &mut search, &mut trace);
        }
    }
    (events(&trace, tree, &Keys::of(tree)), search.outcome.hit)
}

/// Compares two independent references: one over addresses with a recorder, one over indices with a list. `[CONF-4]`
/// `[ORACLE-1]`
#[test]
fn the_two_references_agree() {
    for seed in 0..2000 {
        let kind = Kind::ALL[seed as usize % Kind::ALL.len()];
        let mut case = random(seed, 2 + seed as u32 % 40, kind);
        case.any = seed % 5 == 1;
        let Scene { children, cells, any, octant } = case;
        let walk = Walk {
            children: children.clone(),
            cells: Some(cells.clone()),
            any: Some(any),
            octant: Some(octant),
            ..Walk::default()
        };
        let case = walk.case().unwrap();
        for rule in [Rule::Children, Rule::NodeLeft, Rule::NodeSign(octant), Rule::Disjoint, Rule::Distance] {
            let run = Reference::run(&children, Search::Cells { cells: &cells, any, rule });
            let (events, hit) = by_oracle(&case, rule);
            assert_eq!(run.events, events, "seed {seed}, {rule:?}");
            assert_eq!(run.best.map(|best| (best.t, best.node as usize)), hit, "seed {seed}, {rule:?}");
        }
        let (children, script) = random_script(seed, 2 + seed as u32 % 40, seed % 2 == 0);
        let events = Reference::run(&children, Search::Script(script.as_bytes())).events;
        let case = Walk { children, script: Some(script), ..Walk::default() }.case().unwrap();
        assert_eq!(events, by_oracle(&case, Rule::Children).0, "seed {seed}");
    }
}

/// Resuming from any state gives the rest of the whole trace.
#[test]
fn the_reference_goes_on_where_it_was() {
    for seed in 0..300 {
        let kind = [Kind::Intervals, Kind::Clipped, Kind::Random][seed as usize % 3];
        let Scene { children, cells, .. } = random(seed, 2 + seed as u32 % 30, kind);
        let search = Search::Cells { cells: &cells, any: false, rule: Rule::Disjoint };
        let run = Reference::run(&children, search);
        for visit in &run.visits {
            let rest = Reference::resume(&children, search, &visit.key, &visit.trail, &visit.marks, visit.best, true);
            assert_eq!(rest.events, run.events[visit.events..], "seed {seed}");
            assert_eq!(rest.best, run.best, "seed {seed}");
        }
    }
}
