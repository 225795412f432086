//! Levels `trace` and `resume`.

use serde_json::{Value, json};

use super::text::{events, hex, word};
use crate::ask::{Best, Walk};
use crate::{Answer, Ask, Feature, Start, WalkError};
use stackless_bvh::event::{Recorder, State, Trace};
use stackless_bvh::generate::{Cell, Family, Search, Tape};
use stackless_bvh::internals::traverse::{ByWalk, WithWord, with_word};
use stackless_bvh::key::{self, Grow, KeyWord, TooDeep, Word as _};
use stackless_bvh::order::Flow;
use stackless_bvh::traverse::{KeyOnly, KeyTrail, Method, Next, Paused, Tables, Test, Unsupported, WordName};
use stackless_bvh::tree::{Keys, Node, Topology, Tree};
use stackless_check::GoOn;

/// Deepest tree that gets the implicit layout.
const IMPLICIT_DEPTH: u32 = 13;

/// Returns the features of a traversal, and the depth of the deepest supported tree.
pub(super) fn claims(method: Option<Method>, word: WordName) -> (Vec<Feature>, Option<u32>) {
    let Some(method) = method else { return (vec![Feature::Changing], None) };
    let (shallow, deep) = (chain(1), chain(200));
    let mut features = Vec::new();
    if let Ok((record, _)) = run(method, word, &shallow) {
        let has = |words: &[Option<String>]| words.iter().all(Option::is_some);
        let register = matches!(method.without_pruning(), Method::Uncle | Method::Hashed);
        let wants = [
            (has(&record.trails) && method.test() != Test::Distance, Feature::Trails),
            (has(&record.counters) && method.test() != Test::Distance, Feature::Counters),
            (register, Feature::Registers),
            (!method.restarts(), Feature::Changing),
        ];
        features.extend(wants.into_iter().filter_map(|(has, feature)| has.then_some(feature)));
    }
    let limit = match run(method, word, &deep) {
        Err(Unsupported::TooDeep(TooDeep { limit, .. })) => Some(limit),
        _ => None,
    };
    (features, limit)
}

/// Returns a case with a chain.
fn chain(depth: u32) -> stackless_check::Case {
    let tree = Family::comb(depth, |_| false);
    let tape = Tape::from_cells(&tree, vec![Cell::default(); tree.node_count()]).unwrap_or_default();
    stackless_check::Case { tree, tape, any: false, octant: 0 }
}

pub(super) fn answer(method: Method, word: WordName, features: &[Feature], ask: &Ask) -> Option<Answer> {
    let (Ask::Trace(walk) | Ask::Resume(walk) | Ask::ResumeDisjoint(walk) | Ask::ResumeKey(walk)) = ask else {
        return None;
    };
    let case = match walk.case() {
        Ok(case) => case,
        Err(WalkError::Tree(_)) => return Some(Answer::Reject("not-a-tree".to_owned())),
        Err(WalkError::Search) => return None,
    };
    if matches!(ask, Ask::Trace(_)) {
        return Some(trace(method, word, features, &case, walk));
    }
    with_word(word, Resume { method, case: &case, walk, by_key: matches!(ask, Ask::ResumeKey(_)) })
}

fn trace(method: Method, word: WordName, features: &[Feature], case: &stackless_check::Case, walk: &Walk) -> Answer {
    let (record, search) = match run(method, word, case) {
        Ok(run) => run,
        Err(Unsupported::TooDeep(_)) => return Answer::Reject("too-deep".to_owned()),
        Err(unfit) => return Answer::Unsupported(unfit.to_string()),
    };
    let keys = Keys::of(&case.tree);
    let mut fields = vec![("events", json!(events(&record.trace, &case.tree, &keys)))];
    if walk.cells.is_some() {
        fields.push(("hit", json!(best(&search))));
    }
    for feature in features {
        match feature {
            Feature::Trails => fields.push(("trails", json!(record.trails))),
            Feature::Counters => fields.push(("counters", json!(record.counters))),
            Feature::Registers => {
                let key = |node: &Option<Node>| node.map(|node| hex::<Grow>(&keys.key(case.tree.slot(node))));
                fields.push(("registers", record.registers.iter().map(|node| json!(key(node))).collect()));
            }
            Feature::Changing | Feature::Weights => {}
        }
    }
    Answer::of(fields)
}

fn run(
    method: Method,
    word: WordName,
    case: &stackless_check::Case,
) -> Result<(Record, Search<'_, Tree>), Unsupported> {
    let tables = Tables::new(&case.tree, case.tape.axes(), &[method], IMPLICIT_DEPTH);
    let mut search = Search::new(&case.tree, &case.tape, case.any);
    let mut record = Record::default();
    tables.run_in(word, method, case.octant, &mut Vec::new(), &mut search, &mut record)?;
    Ok((record, search))
}

fn best(search: &Search<'_, Tree>) -> Option<Best> {
    search.outcome.hit.map(|(t, node)| Best { t, node: node as u32 })
}

/// Records each visit except repeated ones after a restart.
#[derive(Debug, Default)]
struct Record {
    trace: Trace,
    trails: Vec<Option<String>>,
    counters: Vec<Option<String>>,
    registers: Vec<Option<Node>>,
}

impl Recorder for Record {
    fn visit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow {
        let state = state();
        if state.is_restarting {
            return Flow::Continue;
        }
        let State { trail, counter, register, .. } = state.map(|word| Some(hex(&word)));
        self.trails.push(trail);
        self.counters.push(counter);
        self.registers.push(register);
        self.trace.visit(node, || State::<W>::of(node))
    }
}

/// Resumes from a state.
struct Resume<'a> {
    method: Method,
    case: &'a stackless_check::Case,
    walk: &'a Walk,
    by_key: bool,
}

impl WithWord for Resume<'_> {
    type Output = Option<Answer>;

    fn call<W: KeyWord>(self) -> Option<Answer> {
        let Self { method, case, walk, by_key } = self;
        let tree = &case.tree;
        let reject = |code: &str| Some(Answer::Reject(code.to_owned()));
        let next = if walk.next == Some(Start::Backtrack) { Next::Backtrack } else { Next::Visit };
        let key: Grow = word(walk.key.as_ref()?)?;
        let Some(from) = Keys::walk(tree, &key) else { return reject("no-such-node") };
        let start = if by_key { from_key(&key, next, tree) } else { from_state(&key, next, walk, tree)? };
        let start: stackless_check::Start<W> = match start {
            Ok(start) => start,
            Err(code) => return reject(code),
        };
        let tables = Tables::new(tree, case.tape.axes(), &[method], 0);
        let (mut search, mut trace) = (Search::new(tree, &case.tape, case.any), Trace::default());
        search.outcome.hit = walk.hit.map(|best| (best.t, best.node as usize));
        match tables.with_cursor::<W, _>(method, GoOn { from: start, search: &mut search, trace: &mut trace }) {
            Ok(Ok(())) => {}
            Ok(Err(error)) => return Some(Answer::Unsupported(error)),
            Err(Unsupported::TooDeep(_)) => return reject("too-deep"),
            Err(unfit) => return Some(Answer::Unsupported(unfit.to_string())),
        }
        let keys = Keys::of(tree);
        let mut events = events(&trace, tree, &keys);
        // The first visit follows a backtrack from a node that is not in the trace.
        if let (Next::Backtrack, Some(&first)) = (next, trace.nodes().first()) {
            let [from, first] = [from, first].map(|node| tree.slot(node));
            let levels = keys.depth(from).saturating_sub(keys.depth(first));
            events.insert(0, format!("backtrack {} {levels}", hex::<Grow>(&keys.key(first))));
        }
        let hit: Option<(&str, Value)> = walk.cells.is_some().then(|| ("hit", json!(best(&search))));
        Some(Answer::of([("events", json!(events))].into_iter().chain(hit)))
    }
}

/// Returns the state of a walk, or the reason for its absence; `None` if the input is not a valid state. If a tree's
/// levels equal the bits of the word, it can be traversed without keys, which do not fit. Its nodes are found by longer
/// keys.
/// keys.
fn from_state<W: KeyWord>(
    key: &Grow,
    next: Next,
    walk: &Walk,
    tree: &Tree,
) -> Option<Result<stackless_check::Start<W>, &'static str>> {
    let bits = |text: &Option<String>| text.as_ref().map(|text| word(text));
    let trail: Grow = bits(&walk.trail)??;
    let disjoint: Option<Grow> = match bits(&walk.marks) {
        Some(marks) => Some(marks?),
        None => None,
    };
    let state = KeyTrail { key: key.clone(), trail, disjoint, next };
    // The node exists, so the trail is wrong.
    Some(state.locate(&ByWalk(tree)).map_err(|_| "trail").and_then(in_word).map(stackless_check::Start::State))
}

/// Returns the state of a walk from the key alone.
fn from_key<W: KeyWord>(key: &Grow, next: Next, tree: &Tree) -> Result<stackless_check::Start<W>, &'static str> {
    if let Some(key) = narrow(key) {
        return KeyOnly::locate(key, next, &ByWalk(tree)).map(stackless_check::Start::Key).map_err(|_| "no-such-node");
    }
    let trail = key::level_start(key).wrapping_sub(&Grow::one());
    let state = KeyTrail { key: key.clone(), trail, disjoint: None, next };
    state.locate(&ByWalk(tree)).map_err(|_| "trail").and_then(in_word).map(stackless_check::Start::State)
}

/// Converts a state to a narrower word. It may lose its key, but not its trails: the tree has more levels than the word
/// has bits.
fn in_word<W: KeyWord>(state: Paused<Grow>) -> Result<Paused<W>, &'static str> {
    let Paused { node, register, key, trail, disjoint, next } = state;
    let trail = narrow(&trail).ok_or("too-deep")?;
    let disjoint = disjoint.map(|bits| narrow(&bits).ok_or("too-deep")).transpose()?;
    Ok(Paused { node, register, key: key.and_then(|key| narrow(&key)), trail, disjoint, next })
}

fn narrow<W: KeyWord>(wide: &Grow) -> Option<W> {
    word(&hex(wide))
}
