//! Wide trees, in the levels `hash`, `trace` and `resume`.

use serde_json::{Value, json};

use super::text::hex;
use crate::ask::WideWalk;
use crate::bits::Bits;
use crate::protocol::WideLimits;
use crate::scripted::{Noted, ScriptedSearch, wide_events};
use crate::{Answer, Ask, Start, WideChildren};
use stackless_bvh::event::{Recorder as _, State};
use stackless_bvh::internals::wide::{Context, Scratch, Supply, asked_keys};
use stackless_bvh::key::Grow;
use stackless_bvh::order::Flow;
use stackless_bvh::tree::Node;
use stackless_bvh::wide::{
    Cursor, Method, Next, Search as _, Tables, Topology as _, Tree, Unsupported, Wanted, advance,
};

/// Levels of the deepest chain tried.
const DEEP: u32 = 200;

/// Returns whether a traversal can resume. Restart trails count finished children, which a state does not contain.
pub(super) fn can_resume(method: Method) -> bool {
    matches!(method, Method::Stack | Method::Trail | Method::Recorded | Method::Hashed)
}

/// Returns the limits of a traversal.
pub(super) fn claims(method: Method) -> WideLimits {
    WideLimits { of_2: Some(limit::<2>(method)), of_4: Some(limit::<4>(method)), of_8: Some(limit::<8>(method)) }
}

fn limit<const A: usize>(method: Method) -> u32 {
    let fits = |levels: &u32| {
        let walk = chain(A as u32, *levels);
        matches!(traced::<A, true>(method, &walk), Some(Answer::Result(_)))
    };
    (0..=DEEP).take_while(fits).last().unwrap_or(0)
}

/// Returns a chain of inner nodes with one child each.
fn chain(slots: u32, levels: u32) -> WideWalk {
    let below = |node: u32| (node <= levels).then(|| vec![node + 1]);
    let rank = |node: u32| (node <= levels).then(|| vec![Some(0)]);
    let nodes = 0..levels + 2;
    WideWalk {
        slots,
        children: nodes.clone().map(below).collect(),
        ranks: nodes.map(rank).collect(),
        ..WideWalk::default()
    }
}

pub(super) fn answer(method: Method, ask: &Ask) -> Option<Answer> {
    let (Ask::TraceWide(walk) | Ask::ResumeWide(walk)) = ask else { return None };
    let resumes = matches!(ask, Ask::ResumeWide(_));
    match (walk.slots, walk.is_sorted()) {
        (2, true) => walked::<2, true>(method, walk, resumes),
        (2, false) => walked::<2, false>(method, walk, resumes),
        (4, true) => walked::<4, true>(method, walk, resumes),
        (4, false) => walked::<4, false>(method, walk, resumes),
        (8, true) => walked::<8, true>(method, walk, resumes),
        (8, false) => walked::<8, false>(method, walk, resumes),
        _ => None,
    }
}

fn walked<const A: usize, const SORTED: bool>(method: Method, walk: &WideWalk, resumes: bool) -> Option<Answer> {
    if resumes { resumed::<A, SORTED>(method, walk) } else { traced::<A, SORTED>(method, walk) }
}

fn reject(code: &str) -> Answer {
    Answer::Reject(code.to_owned())
}

fn traced<const A: usize, const SORTED: bool>(method: Method, walk: &WideWalk) -> Option<Answer> {
    let Ok(tree) = walk.tree::<A>() else { return Some(reject("not-a-tree")) };
    let (mut search, mut noted) = (walk.search::<A, SORTED>()?, Noted::default());
    let ran = method.run(&tree, &Tables::new(&tree), &mut search, &mut noted);
    Some(told(ran.map(|()| noted), &tree, None, walk, &search))
}

/// Formats the result.
fn told<const A: usize, const SORTED: bool>(
    ran: Result<Noted, Unsupported>,
    tree: &Tree<A>,
    before: Option<Node>,
    walk: &WideWalk,
    search: &ScriptedSearch<'_, A, SORTED>,
) -> Answer {
    match ran {
        Ok(Noted(visits)) => {
            let hit: Option<(_, Value)> = walk.hits.as_ref().map(|_| ("hit", json!(search.best())));
            let events = json!(wide_events(tree, before, &visits));
            Answer::of([("events", events)].into_iter().chain(hit))
        }
        Err(Unsupported::TooDeep(_)) => reject("too-deep"),
        Err(unfit) => Answer::Unsupported(unfit.to_string()),
    }
}

fn resumed<const A: usize, const SORTED: bool>(method: Method, walk: &WideWalk) -> Option<Answer> {
    let Ok(tree) = walk.tree::<A>() else { return Some(reject("not-a-tree")) };
    let path = match path::<A>(walk.key.as_ref()?, walk.trail.as_ref()?) {
        Ok(path) => path,
        Err(code) => return Some(reject(code)),
    };
    let mut from = tree.root();
    for &(slot, pending) in &path {
        if from.is_leaf() || tree.children(from) >> slot & 1 == 0 {
            return Some(reject("no-such-node"));
        }
        if pending & (!tree.children(from) | 1 << slot) != 0 {
            return Some(reject("trail"));
        }
        from = tree.child(from, slot);
    }
    let (mut search, mut noted) = (walk.search::<A, SORTED>()?, Noted::default());
    let (tables, memory) = (Tables::new(&tree), &mut Scratch::default());
    let supply = Supply { tree: &tree, tables: &tables, memory };
    let is_visited = walk.next == Some(Start::Backtrack);
    let (way, leaf) = match path.split_last() {
        Some((last, way)) if from.is_leaf() => (way, Some(*last)),
        _ => (&path[..], None),
    };
    let go_on = GoOn { from: supply, way, leaf, is_visited, search: &mut search, noted: &mut noted };
    let ran = method.dispatch(go_on).map(|()| noted);
    Some(told(ran, &tree, is_visited.then_some(from), walk, &search))
}

/// Returns for each level the slot on the path and the set of pending slots, or the rejection code for a malformed key
/// or trail. `[WIDE-9]` `[WIDE-10]`
fn path<const A: usize>(key: &str, trail: &str) -> Result<Vec<(u32, u32)>, &'static str> {
    let (key, bits) = (Bits::of_hex(key).ok_or("no-such-node")?, A.ilog2() as usize);
    let below = key.0.get(1..).filter(|below| below.len() % bits == 0).ok_or("no-such-node")?;
    let trail = Bits::of_hex(trail).and_then(|trail| trail.of_length(A * (below.len() / bits))).ok_or("trail")?;
    let number = |bits: &[bool]| bits.iter().fold(0, |number, &bit| 2 * number + u32::from(bit));
    let groups = below.chunks(bits).zip(trail.0.chunks(A));
    Ok(groups.map(|(slot, set)| (number(slot), number(set))).collect())
}

/// Descends to a state, with answers that want only the path and the pending children, and continues from there.
struct GoOn<'t, 'a, 'w, const A: usize, const SORTED: bool> {
    from: Supply<'t, Tree<A>>,
    /// Slots and pending sets down to the node, or to the parent of the leaf.
    way: &'a [(u32, u32)],
    leaf: Option<(u32, u32)>,
    is_visited: bool,
    search: &'a mut ScriptedSearch<'w, A, SORTED>,
    noted: &'a mut Noted,
}

impl<'t, const A: usize, const SORTED: bool> Context<'t, A, Tree<A>> for GoOn<'t, '_, '_, A, SORTED> {
    type Output = ();

    fn run<C: Cursor<A>>(
        self,
        start: impl Fn(Supply<'t, Tree<A>>) -> Result<C, Unsupported>,
    ) -> Result<(), Unsupported> {
        let Self { from, way, leaf, is_visited, search, noted } = self;
        let tree = from.tree;
        let mut cursor = start(from)?;
        for &(slot, pending) in way {
            // The path comes before the pending children, for every end.
            let set = pending | 1 << slot;
            let wanted = Wanted { set, ..search.of(cursor.node(), set) };
            if let Next::Child(child) = cursor.choose(tree, wanted, search) {
                cursor.enter(child);
            }
        }
        let first = leaf.map_or(cursor.node(), |(slot, _)| tree.child(cursor.node(), slot));
        if !is_visited {
            let flow = noted.visit(first, || State::<u64>::of(first));
            if flow == Flow::Stop || first.is_leaf() && search.leaf(first) == Flow::Stop {
                return Ok(());
            }
        }
        // The time of the last change of the end is unknown.
        cursor.shortened();
        let mut wanted = search.of(cursor.node(), leaf.map_or(u32::MAX, |(_, pending)| pending));
        while advance(tree, &mut cursor, wanted, search, noted) {
            wanted = search.ask(cursor.node());
        }
        Ok(())
    }
}

pub(super) fn hashed_keys(slots: u32, children: &WideChildren) -> Option<Answer> {
    let walk = WideWalk { slots, children: children.clone(), ..WideWalk::default() };
    let keys = match slots {
        2 => keys::<2>(&walk)?,
        4 => keys::<4>(&walk)?,
        8 => keys::<8>(&walk)?,
        _ => return None,
    };
    Some(Answer::of([("keys", json!(keys))]))
}

/// Returns the keys in the order of node indices.
fn keys<const A: usize>(walk: &WideWalk) -> Option<Vec<String>> {
    let asked = asked_keys::<A, Grow>(&walk.tree::<A>().ok()?);
    let mut keys: Vec<String> = asked.iter().map(|(key, _)| hex(key)).collect();
    keys.sort_unstable_by(|a, b| (a.len(), a).cmp(&(b.len(), b)));
    Some(keys)
}
