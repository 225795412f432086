//! The checks bite: planted bugs are caught, made small, and reproduced from a file; and so are mistakes in what
//! traversals rest on.
//!
//! What is seen of each is in `tests/PLANTED.md`, which says how it is made anew.

mod gpu;
mod layers;
#[allow(dead_code, reason = "the other columns are written by those who look")]
pub(crate) mod table;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use glam::Vec3;
use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::generate::{Family, Kind, Rng, procedural};
use stackless_bvh::geom::kernel::{Exact, Exact64};
use stackless_bvh::geom::slabs::{Directed, Wide};
use stackless_bvh::geom::{Kernel, Mesh, Ray, Slabs, Triangle, Vector};
use stackless_bvh::order::Pruning;
use stackless_bvh::trace::Truth;
use stackless_bvh::traverse::{Method, WordName};
use stackless_check::planted::{self, Planted};
use stackless_check::{Case, CaseOptions, Fault, Plan, Replay, SceneTree, check_scene, shrink};

const CASES: u64 = 400;

const HEAD: &str = include_str!("bites/head.md");

const TRAVERSALS: &str = "\
The battery runs each over 400 cases: in how many it is seen, from which on, as what; and of how many nodes the
smallest of up to 20 made-small cases is.";

/// Cases that can show the bug. Where nodes are pruned: trees that are deep enough to look keys up, under intervals
/// that often are disjoint.
fn cases(pruning: Pruning) -> Vec<Case> {
    let case = |seed| {
        if pruning == Pruning::Never {
            return Case::random(seed, CaseOptions::default());
        }
        let mut rng = Rng::new(seed);
        let tree = Family::ALL[seed as usize % Family::ALL.len()].tree(&mut rng, 24);
        let kind = if seed % 2 == 0 { Kind::Intervals } else { Kind::Clipped };
        Case { any: false, ..Case::with_tree(tree, kind, &mut rng) }
    };
    (0..CASES).map(case).collect()
}

/// What the battery sees of a bug: how often, first in which case, as what, and how small it gets.
fn seen(bug: &Planted, cases: &[Case]) -> String {
    let caught: Vec<_> = cases.iter().enumerate().filter_map(|(i, case)| Some((i, case, bug.fault(case)?))).collect();
    let mut kinds = BTreeMap::<_, u32>::new();
    for (_, _, fault) in &caught {
        *kinds.entry(kind(fault)).or_default() += 1;
    }
    let Some((first, ..)) = caught.first() else { panic!("{bug:?}: not caught in {} cases", cases.len()) };
    let smallest = caught.iter().step_by(caught.len().div_ceil(20)).map(|(_, case, _)| made_small(bug, case)).min();
    let kinds: Vec<_> = kinds.iter().map(|(kind, count)| format!("{kind} {count}")).collect();
    let (count, smallest) = (caught.len(), smallest.unwrap_or_default());
    format!("{count} from {first}: {}; {smallest}", kinds.join(", "))
}

/// Makes a case small that shows the bug, and reads it back from a file. The number of its nodes.
fn made_small(bug: &Planted, case: &Case) -> usize {
    let small = shrink(case.clone(), |case| bug.fault(case).is_some());
    let fault = bug.fault(&small).unwrap();
    // Words of 8 bits are too narrow only for trees that are deeper than 7 edges.
    let words_of_8_bits = ["AnyDepth", "Algorithm 2 of J", "Narrow"];
    let most = if words_of_8_bits.iter().any(|name| bug.name().contains(name)) { 2 * 8 + 1 } else { 9 };
    assert!(small.size() <= most, "{bug:?}: {} nodes, {fault}", small.size());

    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("case.json");
    let replay = Replay::of(&small, Method::Stack, WordName::U64, &fault);
    std::fs::write(&file, serde_json::to_string(&replay).unwrap()).unwrap();
    let again = Replay::load(&file).unwrap();
    assert_eq!(again.fault, Some(fault.to_string()));
    let again = again.case().unwrap();
    assert_eq!(again, small, "{bug:?}");
    assert_eq!(bug.fault(&again), Some(fault), "{bug:?}");
    small.size()
}

/// [CONF-1] [REGISTER-2] [DISJOINT-3] [PAUSE-3]
#[test]
fn every_planted_bug_is_caught() {
    let (plain, pruned) = (cases(Pruning::Never), cases(Pruning::Disjoint));
    let cases = |bug: &Planted| if bug.test().pruning() == Pruning::Never { &plain } else { &pruned };
    for control in planted::controls() {
        assert!(cases(&control).iter().all(|case| control.fault(case).is_none()), "{control:?}");
    }
    let bugs = planted::all();
    let mut text = format!("{HEAD}\n## Traversals\n\n{TRAVERSALS}\n\n{}", heading(true));
    for bug in &bugs {
        text += &row("", bug.name(), bug.clause(), &seen(bug, cases(bug)), true);
    }
    writeln!(text, "\n{} bugs.", bugs.len()).unwrap();
    text += "\n## Marks\n\n";
    text +=
        "Searches that mark otherwise than they may. Beside what the battery sees: in how many of 4,000 cases a hit ";
    text += "is lost.\n\n";
    text += "| bug | breaks | battery | lost |\n|---|---|---|---|\n";
    for bug in planted::marks() {
        let (battery, (lost, first, _)) = (seen(&bug, &pruned), super::disjoint::lost(&bug));
        writeln!(text, "| {} | {} | {battery} | {lost} from {} |", bug.name(), bug.clause(), first.unwrap()).unwrap();
    }
    text += &layers::tables();
    text += &gpu::table();
    table::compare(&text);
    let gaps = table::rows(&text, "battery")
        .into_iter()
        .chain(table::COLUMNS.iter().flat_map(|column| table::rows(&text, column)));
    let without_reason: Vec<_> =
        gaps.filter(|row| ["", table::NO.trim(), MISSING].contains(&row.cell.as_str())).collect();
    assert!(without_reason.is_empty(), "{without_reason:?}");
}

/// One list has all bugs.
#[test]
fn the_table_has_what_is_listed() {
    let rows = table::rows(&table::text(), "breaks");
    let rows: Vec<_> = rows.iter().map(|row| (row.name.clone(), row.cell.as_str())).collect();
    assert_eq!(rows, planted::rows());
    let names: BTreeSet<_> = rows.iter().map(|row| &row.0).collect();
    assert_eq!(names.len(), rows.len());
}

/// What stands in a column of a new row until the test of the column writes it.
const MISSING: &str = "?";

fn heading(has_harness: bool) -> String {
    let (harness, line) = if has_harness { (" harness |", "---|") } else { ("", "") };
    format!("| bug | breaks | battery | fuzz | suite |{harness}\n|---|---|---|---|---|{line}\n")
}

/// A row with what its other columns have in the file.
fn row(layer: &str, name: &str, clause: &str, battery: &str, has_harness: bool) -> String {
    let file = table::text();
    let kept = table::COLUMNS[..if has_harness { 3 } else { 2 }].iter().map(|column| {
        let rows = table::rows(&file, column);
        let row = rows.into_iter().find(|row| row.name == format!("{layer}{name}"));
        row.map_or(MISSING.to_owned(), |row| row.cell)
    });
    format!("| {name} | {clause} | {battery} | {} |\n", kept.collect::<Vec<_>>().join(" | "))
}

fn kind(fault: &Fault) -> &'static str {
    match fault {
        Fault::Node { expected: Some(_), .. } => "node",
        Fault::Node { expected: None, .. } => "beyond the end",
        Fault::Early { .. } => "early",
        Fault::Decision { .. } => "decision",
        Fault::Key { .. } => "key",
        Fault::Trail { .. } => "trail",
        Fault::Register { .. } => "register",
        Fault::Endless { .. } => "endless",
        Fault::Hit { .. } => "hit",
        Fault::Visits { .. } => "visits",
        Fault::Restart { .. } => "restart",
        Fault::Miss { .. } => "miss",
        Fault::Unpruned { .. } => "unpruned",
    }
}

/// A hierarchy cannot be damaged through the public interface, but it can be that of another mesh.
#[test]
fn a_hierarchy_that_does_not_hold_the_mesh() {
    let mesh = procedural::soup(3, 400);
    let rays = procedural::rays(&mesh, 1, 300);
    other_meshes_are_seen::<Exact, Directed, _>(&mesh, &rays, |vertex| vertex * 1.001);

    let far = |v: Vec3| v.as_dvec3() + 6.4e6;
    let vertices = mesh.vertices().iter().map(|&vertex| far(vertex)).collect();
    let moved = Mesh::new(vertices, mesh.triangles().to_vec()).unwrap();
    let ray = |ray: &Ray| Ray::new(far(ray.origin()), ray.direction().as_dvec3()).unwrap();
    let rays: Vec<_> = rays.iter().map(ray).collect();
    other_meshes_are_seen::<Exact64, Wide, _>(&moved, &rays, |vertex| vertex + 0.001);
}

fn other_meshes_are_seen<K, B, V>(mesh: &Mesh<V>, rays: &[Ray<V>], away: impl Fn(V) -> V)
where
    K: Kernel<Vector = V, Shape = Triangle<V>>,
    B: Slabs<Vector = V>,
    V: Vector,
{
    let plan = Plan {
        trees: 0,
        seed: 1,
        options: CaseOptions::default(),
        methods: vec![Method::Stack, Method::Hashed],
        words: vec![WordName::U64],
    };
    let truth = Truth::new(mesh);
    let check = |held: &Mesh<V>| {
        let bvh = Bvh::sah(held, SahOptions::default()).unwrap();
        check_scene::<K, B, V>(&plan, &SceneTree::new(&truth, &bvh), rays, &|_| ())
    };
    let (tally, found) = check(mesh);
    assert_eq!((tally.disagreements(), found.is_none()), (0, true));

    let without = |lost: usize| {
        let kept = mesh.triangles().iter().enumerate().filter(|&(prim, _)| prim != lost).map(|(_, &corners)| corners);
        Mesh::new(mesh.vertices().to_vec(), kept.collect()).unwrap()
    };
    let moved = mesh.vertices().iter().map(|&vertex| away(vertex)).collect();
    let mut turned = mesh.triangles().to_vec();
    turned.rotate_left(1);
    for held in [
        without(0),
        without(7),
        Mesh::new(moved, mesh.triangles().to_vec()).unwrap(),
        Mesh::new(mesh.vertices().to_vec(), turned).unwrap(),
    ] {
        let (tally, found) = check(&held);
        assert!(tally.oracle_faults > 0);
        assert_eq!(tally.disagreements(), tally.oracle_faults);
        let found = found.unwrap();
        assert_eq!(found.method, None);
        assert_ne!(found.expected.hit, found.found.hit);
    }
}

#[test]
fn every_case_comes_back_from_a_file() {
    for (seed, case) in cases(Pruning::Never).into_iter().enumerate() {
        let fault = Fault::Early { visits: 0, expected: 1 };
        let replay = Replay::of(&case, Method::Stack, WordName::U64, &fault);
        let again = replay.case().unwrap_or_else(|error| panic!("seed {seed}: {error}"));
        assert_eq!(again, case);
    }
}
