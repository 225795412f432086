//! Level `trace`.

use serde_json::{Value, json};

use super::reference::{Reference, Rule, Search};
use super::trees::{
    Scene, after_far, boundary_scenes, comb, complete, depth_of, depths, random, random_script, scene_of, script, spine,
};
use super::{Author, result};
use crate::ask::Walk;
use crate::{Ask, Children, Feature, Level, Profile};
use stackless_bvh::generate::{Cell, Kind};

pub(super) fn profiles() -> Vec<Profile> {
    vec![
        scripts(),
        complete_trees(),
        tapes(),
        by_rule("node-left", &["LEFT-1", "SKIP-1"], 60, |_| Rule::NodeLeft),
        by_rule("node-sign", &["HAPALA-1", "SKIP-1"], 80, |case| Rule::NodeSign(case.octant)),
        by_rule("disjoint", &["ORDER-2", "ORDER-3", "ORACLE-2", "DISJOINT-1", "DISJOINT-2", "DISJOINT-3"], 300, |_| {
            Rule::Disjoint
        }),
        by_rule("distance", &["ORACLE-3"], 60, |_| Rule::Distance),
        invalid(),
    ]
}

/// Trees with scripts: all small ones, random ones, and chains around the depth limits of the words.
fn scripts() -> Profile {
    let mut author = Author::new(Level::Trace, "script");
    for (name, text) in [("leaf", "."), ("leaf-stop", "!")] {
        scripted(&mut author, name, "Nothing to descend into.", vec![None], text.to_owned());
    }
    for decision in ['n', 'l', 'r', 'L', 'R'] {
        for stop in [".", "!"] {
            let name = format!("three-{}{}", name_of(decision), if stop == "!" { "-stop" } else { "" });
            let text = format!("{decision}{stop}.");
            scripted(&mut author, &name, "One decision.", vec![Some([1, 2]), None, None], text);
        }
    }
    for seed in 0..180 {
        // Small trees first, because their failures are easy to understand.
        let (children, text) = random_script(seed, 3 + seed as u32 / 6, seed % 3 == 2);
        scripted(&mut author, &format!("random-{seed}"), "Decisions of all kinds.", children, text);
    }
    for depth in [1, 2, 3, 4, 5, 8, 16, 30, 31, 32, 33, 62, 63, 64, 65, 126, 127, 128, 129, 200] {
        chains(&mut author, depth);
    }
    for depth in [8, 31, 63, 127] {
        for (side, goes_right) in SIDES {
            let children = comb(depth, |_| goes_right);
            let bottom = 2 * depth - u32::from(!goes_right);
            let (one, both) = if goes_right { ('r', 'R') } else { ('l', 'L') };
            let only = script(&children, |_| one, |_| '.');
            let why = "Nothing is postponed: the search ends at the bottom.";
            scripted(&mut author, &format!("chain-{side}-{depth}-only"), why, children.clone(), only);
            let stop = script(&children, |_| both, |leaf| if leaf == bottom { '!' } else { '.' });
            let why = "A leaf is postponed at each level, and the search ends at the bottom.";
            scripted(&mut author, &format!("chain-{side}-{depth}-stop"), why, children, stop);
        }
    }
    for [above, far, below] in ways_after_far() {
        let (children, text) = after_far(above, far, below);
        scripted(&mut author, &format!("after-far-{above}-{far}-{below}"), AFTER_FAR, children, text);
    }
    author.done()
}

pub(super) const SIDES: [(&str, bool); 2] = [("left", false), ("right", true)];

/// Depths around the word sizes.
const DEPTHS: [u32; 6] = [31, 32, 33, 63, 64, 65];

const AFTER_FAR: &str =
    "Back from afar the register is empty; one child at each level, until no record names what comes next.";

fn ways_after_far() -> impl Iterator<Item = [u32; 3]> {
    (0..4).flat_map(|above| [0, 3].map(|far| [above, far])).flat_map(|[above, far]| [1, 2, 3].map(|c| [above, far, c]))
}

fn name_of(decision: char) -> String {
    let side = if decision.eq_ignore_ascii_case(&'l') { "left" } else { "right" };
    match decision {
        'n' => "neither".to_owned(),
        'l' | 'r' => format!("only-{side}"),
        _ => format!("both-{side}-first"),
    }
}

/// Adds chains that visit the spine first and postpone its side leaves: all of them, the first, or two.
fn chains(author: &mut Author, depth: u32) {
    type Side = fn(u32) -> bool;
    let sides: [(&str, Side); 3] = [("left", |_| false), ("right", |_| true), ("turns", |level| level % 2 == 1)];
    for (name, goes_right) in sides {
        let children = comb(depth, goes_right);
        let depths = depths(&children);
        let down = |node: u32, postpones: bool| match (goes_right(depths[node as usize]), postpones) {
            (false, false) => 'l',
            (true, false) => 'r',
            (false, true) => 'L',
            (true, true) => 'R',
        };
        let mut chain = |label: &str, why: &str, postpones: &dyn Fn(u32) -> bool| {
            let text = script(&children, |node| down(node, postpones(depths[node as usize])), |_| '.');
            scripted(author, &format!("chain-{name}-{depth}-{label}"), why, children.clone(), text);
        };
        chain("all", "A leaf is postponed at each level.", &|_| true);
        chain("first", "From the bottom to the root's other child in one step.", &|level| level == 0);
        // The second one empties the register, so the first must be found by another method.
        let mut two = |second: u32| {
            chain(&format!("two-{second}"), "Two are postponed; the lower one comes first.", &|level| {
                level == 0 || level == second
            });
        };
        [1, 2, 3, 4, depth / 2].into_iter().filter(|&second| second + 1 < depth).for_each(&mut two);
    }
}

fn complete_trees() -> Profile {
    let mut author = Author::new(Level::Trace, "complete");
    for depth in 0..=6 {
        let children = complete(depth);
        let depths = depths(&children);
        let orders: [(&str, &dyn Fn(u32) -> char); 4] = [
            ("left", &|_| 'L'),
            ("right", &|_| 'R'),
            ("turns", &|node| if depths[node as usize] % 2 == 1 { 'R' } else { 'L' }),
            ("some", &|node| ['L', 'r', 'R', 'l', 'L', 'R'][node as usize * 7 % 6]),
        ];
        for (name, order) in orders {
            let text = script(&children, order, |leaf| if name == "some" && leaf % 16 == 9 { '!' } else { '.' });
            scripted(
                &mut author,
                &format!("{name}-{depth}"),
                "The address is the key less one.",
                children.clone(),
                text,
            );
        }
    }
    author.done()
}

/// Adds a case of a script. The events determine its clauses.
fn scripted(author: &mut Author, name: &str, why: &str, children: Children, text: String) {
    let run = Reference::run(&children, Search::Script(text.as_bytes()));
    let clauses = clauses(&run, &children);
    let clauses: Vec<_> =
        clauses.iter().copied().chain(author.0.profile.eq("complete").then_some("COMPLETE-1")).collect();
    let expect = result([("events", json!(run.events)), ("trails", trails(&run))]);
    let ask = Ask::Trace(Walk { children, script: Some(text), ..Walk::default() });
    author.case(name, &clauses, why, &ask, expect);
}

fn clauses(run: &Reference<'_>, children: &Children) -> Vec<&'static str> {
    let levels: Vec<u32> = run
        .events
        .iter()
        .filter_map(|event| event.strip_prefix("backtrack ")?.split(' ').nth(1)?.parse().ok())
        .collect();
    let mut clauses = vec!["ORACLE-1", "TRACE-1", "TRAVERSE-1", "KEY-1"];
    if run.visits.len() > 1 {
        clauses.extend(["ORDER-1", "KEY-2", "TRAIL-1", "TRAIL-2"]);
    }
    if !levels.is_empty() {
        clauses.extend(["TRAIL-3", "TRAIL-4", "TRAIL-7", "REGISTER-1"]);
    }
    // A backtrack from further than the sibling needs records or a table to find the node.
    if levels.iter().any(|&levels| levels > 0) {
        clauses.extend(["REGISTER-2", "UNCLE-1", "UNCLE-2"]);
    }
    if levels.iter().any(|&levels| levels > 2) {
        clauses.extend(["HASHED-1", "HASH-3"]);
    }
    let depth = depth_of(children);
    if depth > 7 {
        clauses.push("DEPTH-1");
    }
    if depth > 30 {
        clauses.extend(["DEPTH-2", "CONF-3"]);
    }
    if depth > 127 {
        clauses.extend(["DEPTH-3", "DEPTH-4"]);
    }
    clauses
}

fn trails(run: &Reference<'_>) -> Value {
    run.visits.iter().map(|visit| visit.trail.hex()).collect()
}

fn tapes() -> Profile {
    let mut author = Author::new(Level::Trace, "tape");
    let kinds = [
        Kind::Random,
        Kind::AllHit,
        Kind::NoneHit,
        Kind::OnlyOne,
        Kind::Alternating,
        Kind::Shrinking,
        Kind::Intervals,
        Kind::Clipped,
    ];
    for seed in 0..160 {
        let kind = kinds[seed as usize % kinds.len()];
        let mut case = random(1000 + seed, 3 + seed as u32 / 6, kind);
        case.any = seed / 8 % 3 == 1;
        let why = if case.any {
            "The first hit ends the search."
        } else {
            "A hit shortens the search: less is wanted later."
        };
        let clauses = ["ORACLE-1", "ORDER-1", "TRACE-1", "TRAVERSE-1", "TRAIL-2", "TRAIL-4"];
        let made = taped(&mut author, &format!("{kind}-{seed}"), &clauses, why, &case, Rule::Children);
        if !case.is_static() {
            made.needs(Feature::Changing);
        }
        if seed % 8 == 6 {
            let why = "Distances are equal often: what is entered where the best hit is, is wanted.";
            let case = with_ties(case);
            taped(&mut author, &format!("ties-{seed}"), &clauses, why, &case, Rule::Children).needs(Feature::Changing);
        }
    }
    let clauses = ["ORACLE-1", "TRACE-1", "TRAVERSE-1", "TRAIL-2", "TRAIL-4"];
    for [above, far, below] in ways_after_far() {
        let (children, text) = after_far(above, far, below);
        let (name, clauses) = (format!("after-far-{above}-{far}-{below}"), [&clauses[..], &["REGISTER-2"]].concat());
        taped(&mut author, &name, &clauses, AFTER_FAR, &scene_of(&children, &text), Rule::Children);
    }
    chains_with_cells(&mut author, &clauses, &[("", |_| false)], |_| Rule::Children);
    boundaries(&mut author, &clauses, |_| Rule::Children);
    author.done()
}

/// The suffix of a name, and the marked levels.
type Marks = (&'static str, fn(u32) -> bool);

/// Adds chains around the depth limits of the words, with marked levels.
fn chains_with_cells(author: &mut Author, clauses: &[&str], marks: &[Marks], rule: impl Fn(&Scene) -> Rule) {
    let clauses = [clauses, &["DEPTH-1", "DEPTH-2", "CONF-3"]].concat();
    for depth in DEPTHS {
        for ((side, goes_right), (label, is_marked)) in
            SIDES.iter().flat_map(|side| marks.iter().map(move |it| (side, it)))
        {
            let scene = spine(depth, *goes_right, is_marked);
            let why = "Longer than a word, or just not: bits of the first levels decide what comes last.";
            taped(author, &format!("chain-{side}-{depth}{label}"), &clauses, why, &scene, rule(&scene));
        }
    }
}

fn by_rule(name: &str, clauses: &[&str], count: u64, rule: impl Fn(&Scene) -> Rule) -> Profile {
    let mut author = Author::new(Level::Trace, name);
    let kinds = [Kind::Intervals, Kind::Clipped, Kind::Shrinking, Kind::Random];
    for seed in 0..count {
        // If much is pruned, only large trees have long traces.
        let kind = kinds[seed as usize % if count > 100 { 2 } else { kinds.len() }];
        let mut case = random(2000 + seed, 3 + (seed as u32 / 4).min(40), kind);
        let rule = rule(&case);
        let nodes = matches!(rule, Rule::NodeLeft | Rule::NodeSign(_));
        case.any = nodes && seed / 4 % 4 == 3;
        let why = if nodes { "Each node is tested at its own visit." } else { "What lies behind a hit is given up." };
        let beyond = (kind == Kind::Clipped && rule == Rule::Disjoint).then_some("DISJOINT-4");
        let clauses: Vec<_> = clauses.iter().copied().chain(beyond).collect();
        taped(&mut author, &format!("{kind}-{seed}"), &clauses, why, &case, rule);
        if seed % 4 == 0 {
            let why = "Distances are equal often: what is entered where the best hit is, is wanted.";
            taped(&mut author, &format!("ties-{seed}"), &clauses, why, &with_ties(case), rule);
        }
    }
    let is_marked = matches!(rule(&spine(1, false, |_| true)), Rule::Disjoint | Rule::Distance);
    let marks: [Marks; 2] = [("-first", |level| level == 0), ("-others", |level| level > 0)];
    let marks: &[_] = if is_marked { &marks } else { &[("", |_| false)] };
    chains_with_cells(&mut author, clauses, marks, &rule);
    if rule(&spine(1, false, |_| true)) == Rule::Disjoint {
        open_ends(&mut author, clauses);
    }
    boundaries(&mut author, clauses, rule);
    author.done()
}

fn boundaries(author: &mut Author, clauses: &[&str], rule: impl Fn(&Scene) -> Rule) {
    for (name, why, scene) in boundary_scenes() {
        let (rule, is_static) = (rule(&scene), scene.is_static());
        let case = taped(author, name, clauses, why, &scene, rule);
        if rule == Rule::Children && !is_static {
            case.needs(Feature::Changing);
        }
    }
}

/// Adds nodes with unlimited intervals.
fn open_ends(author: &mut Author, clauses: &[&str]) {
    for (name, why, scene) in open_scenes() {
        taped(author, name, clauses, why, &scene, Rule::Disjoint);
    }
}

pub(super) fn open_scenes() -> [(&'static str, &'static str, Scene); 2] {
    let children = vec![Some([1, 2]), Some([3, 4]), None, None, None];
    let node = |enter, exit, hit| Cell { enter, exit, hit, ..Cell::default() };
    let with_leaf = |exit| Scene {
        children: children.clone(),
        cells: vec![
            node(0, None, None),
            node(0, None, None),
            node(9, Some(20), None),
            node(0, exit, Some(1)),
            node(5, Some(7), None),
        ],
        any: false,
        octant: 0,
    };
    [
        ("open-first", "The root's first child has no end, so the second comes; what is marked below is given up.", {
            with_leaf(Some(3))
        }),
        ("open-leaf", "The hit leaf has no end: nothing is marked.", with_leaf(None)),
    ]
}

/// Quantises the distances of a scene.
fn with_ties(scene: Scene) -> Scene {
    let coarse = |t: u32| t >> 18 << 18;
    let cell =
        |cell: Cell| Cell { enter: coarse(cell.enter), exit: cell.exit.map(coarse), hit: cell.hit.map(coarse), ..cell };
    Scene { cells: scene.cells.into_iter().map(cell).collect(), ..scene }
}

fn taped<'a>(
    author: &'a mut Author,
    name: &str,
    clauses: &[&str],
    why: &str,
    scene: &Scene,
    rule: Rule,
) -> &'a mut crate::SuiteCase {
    let Scene { children, cells, any, .. } = scene.clone();
    let run = Reference::run(&children, Search::Cells { cells: &cells, any, rule });
    let mut fields = vec![("events", json!(run.events)), ("hit", json!(run.best))];
    // With pruning by distance, the postponed nodes are determined only when they are visited.
    if rule != Rule::Distance {
        fields.push(("trails", trails(&run)));
    }
    let searches = matches!(rule, Rule::Children | Rule::NodeLeft | Rule::NodeSign(_));
    let octant = if let Rule::NodeSign(octant) = rule { Some(octant) } else { None };
    let walk = Walk { children, cells: Some(cells), any: searches.then_some(any), octant, ..Walk::default() };
    author.case(name, clauses, why, &Ask::Trace(walk), result(fields))
}

fn invalid() -> Profile {
    let mut author = Author::new(Level::Trace, "invalid");
    let faults: [(&str, &str, Children); 14] = [
        ("empty", "There is no root.", vec![]),
        ("out-of-range", "A child that there is not.", vec![Some([1, 2]), None]),
        ("far-out-of-range", "A child that there is not.", vec![Some([1, (1 << 31) - 1]), None]),
        ("own-child", "A node is its own child.", vec![Some([0, 1]), None]),
        ("root-as-child", "The root is the child of another.", vec![Some([1, 2]), Some([0, 3]), None, None]),
        ("twice", "Both children are one node.", vec![Some([1, 1]), None]),
        ("two-parents", "A node with two parents.", vec![Some([1, 2]), Some([3, 4]), Some([4, 5]), None, None, None]),
        ("unreached", "A node without a parent.", vec![Some([1, 2]), None, None, None]),
        ("unreached-tree", "Two trees.", vec![Some([1, 2]), None, None, Some([4, 5]), None, None]),
        (
            "cycle-below",
            "A node is its own grandchild.",
            vec![Some([1, 2]), Some([3, 4]), None, Some([1, 5]), None, None],
        ),
        (
            "cycle",
            "Nodes that are each other's children.",
            vec![Some([1, 2]), None, None, Some([4, 5]), Some([3, 6]), None, None],
        ),
        // Implementations that stop at the first leaf fail this case.
        (
            "later-out-of-range",
            "A child that there is not, after a leaf.",
            vec![Some([1, 2]), None, Some([3, 4]), None],
        ),
        ("later-twice", "Both children are one node, after a leaf.", vec![Some([1, 2]), None, Some([3, 3]), None]),
        ("later-root", "The root is the child of another, after a leaf.", vec![Some([1, 2]), None, Some([3, 0]), None]),
    ];
    for (name, why, children) in faults {
        let text = script(&children, |_| 'L', |_| '.');
        let ask = Ask::Trace(Walk { children, script: Some(text), ..Walk::default() });
        author.reject(name, &["TREE-1", "TREE-2"], why, &ask, "not-a-tree");
    }
    for depth in 0..3 {
        let children = complete(depth);
        let text = script(&children, |_| 'L', |_| '.');
        scripted(&mut author, &format!("right-{depth}"), "This is a tree: not everything is rejected.", children, text);
    }
    author.done()
}
