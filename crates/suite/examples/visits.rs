//! Writes cases, and the states of every traversal on them: node, key, trail, counter, second trail and register at
//! each visit, also on the way down after a restart.
//!
//! The machines extracted from the proofs (spec/rocq/extract) read these cases and compute the states independently.
//! Usage: `visits CASES SEED [I/N]`.
//!
//! The list begins with all small trees, trees at the depth limits of the words, and the known worst cases
//! (`tests/data/worst`). CASES further cases follow: random ones, some of them deep, combs with long climbs, cases
//! drawn from bytes like a fuzzer's, and worst cases with some changed answers. Every traversal that can be paused is
//! paused once in each case, and another one resumes it.

use std::env::args;
use std::fmt::Write as _;
use std::fs;
use std::io::{self, BufWriter, Write};
use std::ops::Range;
use std::path::Path;
use std::time::Instant;

use arbitrary::Unstructured;
use serde_json::{Value, json};
use stackless_bvh::event::{Recorder, State};
use stackless_bvh::generate::{Rng, Search, Source as _, Tape};
use stackless_bvh::hash::mix;
use stackless_bvh::internals::traverse::{AuxTables, ByWalk, WithCursor, WithWord, with_word};
use stackless_bvh::key::{Grow, KeyWord};
use stackless_bvh::order::{Flow, Pruning};
use stackless_bvh::traverse::{KeyTrail, Method, Next, Pause, Paused, Tables, WordName, resume, traverse_pruned};
use stackless_bvh::tree::{Keys, Node, Topology, Tree};
use stackless_check::{AllCases, Case, CaseOptions, Replay, Shard, boundary_cases};
use stackless_suite::hex;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut args = args().skip(1);
    let mut next = |default: &str| args.next().unwrap_or_else(|| default.to_owned());
    let (drawn, seed): (u64, u64) = (next("1000").parse()?, next("1").parse()?);
    let shard: Shard = next("1/1").parse()?;
    let (start, list) = (Instant::now(), List::new(drawn, seed)?);
    let range = shard.range(list.len());
    let mut out = BufWriter::with_capacity(1 << 16, io::stdout().lock());
    writeln!(out, "run {}", list.run(&range))?;
    for number in range.clone() {
        out.write_all(text(&list.case(number)).as_bytes())?;
    }
    writeln!(out, "end {}", range.end - range.start)?;
    out.flush()?;
    eprintln!("visits: cases {range:?} in {:.1} s", start.elapsed().as_secs_f64());
    Ok(())
}

/// All cases, by number.
struct List {
    small: AllCases,
    listed: Vec<Case>,
    worst: Vec<Case>,
    drawn: u64,
    seed: u64,
}

impl List {
    /// Leaves of the small trees: 2,743 cases.
    const SMALL: u32 = 5;

    fn new(drawn: u64, seed: u64) -> Result<Self, Box<dyn std::error::Error>> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let mut files = Vec::new();
        for folder in ["tests/data/worst", "spec/departures"] {
            for entry in fs::read_dir(root.join(folder))? {
                files.push(entry?.path());
            }
        }
        files.sort();
        // The other files are cases of rays.
        let worst: Vec<Case> = files.iter().filter_map(|path| Replay::load(path).ok()?.case().ok()).collect();
        let listed = boundary_cases(seed).chain(worst.iter().cloned()).collect();
        Ok(Self { small: AllCases::up_to(Self::SMALL), listed, worst, drawn, seed })
    }

    fn len(&self) -> u64 {
        self.small.count() + self.listed.len() as u64 + self.drawn
    }

    fn case(&self, number: u64) -> Case {
        let Some(number) = number.checked_sub(self.small.count()) else { return self.small.case(number) };
        let Some(drawn) = number.checked_sub(self.listed.len() as u64) else {
            return self.listed[number as usize].clone();
        };
        let seed = mix(self.seed ^ mix(drawn));
        let mut rng = Rng::new(mix(seed));
        match drawn % 10 {
            0..3 => Case::random(seed, CaseOptions::default()),
            // The depth limit of 128-bit words.
            3 => Case::random(seed, CaseOptions { depth: Some(rng.below(128) as u32), ..CaseOptions::default() }),
            4 | 5 => {
                let depth = rng.below(128) as u32;
                Case::chain(&mut rng, depth)
            }
            6 | 7 => {
                let bytes: Vec<u8> = (0..rng.below(400)).map(|_| rng.below(256) as u8).collect();
                Case::draw(&mut Unstructured::new(&bytes), Case::LEAVES)
            }
            _ => {
                let worst = &self.worst[rng.below(self.worst.len() as u64) as usize];
                let tape = changed(worst, &mut rng).unwrap_or_else(|| worst.tape.clone());
                Case { tape, any: rng.coin(), octant: rng.below(8) as u8, ..worst.clone() }
            }
        }
    }

    /// Returns the record of the run, except for the counts (campaign/README.md).
    fn run(&self, range: &Range<u64>) -> Value {
        json!({
            "command": "differ",
            "version": env!("CARGO_PKG_VERSION"),
            "commit": option_env!("STACKLESS_COMMIT"),
            "asked": { "seed": self.seed },
            "parts": { "cases": { "of": self.len(), "done": [[range.start, range.end]] } },
            "machines": {},
        })
    }
}

/// Changes up to four answers or orders of a tape; `None` if the result is not a valid tape.
fn changed(case: &Case, rng: &mut Rng) -> Option<Tape> {
    let mut cells = case.tape.cells().to_vec();
    for _ in 0..=rng.below(4) {
        let node = rng.below(cells.len() as u64) as usize;
        match rng.below(3) {
            0 => cells[node].axis = rng.below(3) as u8,
            1 => cells[node].right_first ^= true,
            _ => cells[node].miss ^= node > 0,
        }
    }
    Tape::from_cells(&case.tree, cells)
}

/// Formats a case, with a line for each traversal and each word that can represent its tree.
fn text(case: &Case) -> String {
    let mut text = format!("case {} {}", u8::from(case.any), case.octant);
    let mut pending = vec![case.tree.root()];
    while let Some(node) = pending.pop() {
        let slot = case.tree.slot(node);
        let cell = &case.tape.cells()[slot];
        let flags =
            u8::from(node.is_leaf()) | u8::from(cell.miss) << 1 | u8::from(cell.right_first) << 2 | cell.axis << 3;
        let [exit, hit] = [cell.exit, cell.hit].map(|distance| distance.map_or(0, |t| u64::from(t) + 1));
        // Writing to a string cannot fail.
        let _ = write!(text, " {flags} {} {exit} {hit} {slot}", cell.enter);
        if !node.is_leaf() {
            let [left, right] = case.tree.children(node);
            pending.extend([right, left]);
        }
    }
    text.push('\n');
    let methods = Method::ALL;
    let octants = case.octant..case.octant + 1;
    let beside = AuxTables::for_octants(&case.tree, case.tape.axes(), &methods, IMPLICIT_DEPTH, octants);
    let run = Run { case, keys: &Keys::of(&case.tree), tables: &Tables::with(&case.tree, case.tape.axes(), beside) };
    let is_small = case.tree.node_count() <= SMALL;
    let is_compared = |method: &Method| is_small || !method.restarts();
    for method in methods.into_iter().filter(is_compared) {
        let words = if method.has_words() { &WordName::ALL[..] } else { &[WordName::U64] };
        for &word in words {
            text.extend(with_word(word, Line { run: &run, method, word }));
        }
    }
    for pruning in [Pruning::Never, Pruning::Disjoint] {
        let ring = || methods.iter().filter(|method| method.can_pause() && method.test().pruning() == pruning);
        for (&from, &to) in ring().zip(ring().cycle().skip(1)) {
            for word in WordName::ALL {
                text.extend(with_word(word, Resumed { run: &run, from, to, word }));
            }
        }
    }
    text
}

/// The maximum number of nodes for comparing restarts. In deep trees their machine, which uses words of single bits,
/// takes minutes.
const SMALL: usize = 41;

/// The deepest tree with an implicit layout. In deeper trees the addresses are looked up.
const IMPLICIT_DEPTH: u32 = 13;

struct Run<'c> {
    case: &'c Case,
    keys: &'c Keys,
    tables: &'c Tables<'c, Tree>,
}

struct Line<'c> {
    run: &'c Run<'c>,
    method: Method,
    word: WordName,
}

impl WithWord for Line<'_> {
    /// `None` if the traversal refuses the tree or does not support the word.
    type Output = Option<String>;

    fn call<W: KeyWord>(self) -> Option<String> {
        let Run { case, keys, tables } = *self.run;
        let mut search = Search::new(&case.tree, &case.tape, case.any);
        let mut seen = Seen { text: format!("{} {}", self.method, self.word), tree: &case.tree, keys };
        tables.run_in(self.word, self.method, case.octant, &mut Vec::new(), &mut search, &mut seen).ok()?;
        Some(seen.text + &found(&search))
    }
}

/// Formats the end of a line.
fn found(search: &Search<'_, Tree>) -> String {
    search.outcome.hit.map_or_else(|| " none\n".to_owned(), |(t, slot)| format!(" hit {t} {slot}\n"))
}

/// A search that one traversal pauses and another resumes, from key, trail and second trail.
struct Resumed<'c> {
    run: &'c Run<'c>,
    from: Method,
    to: Method,
    word: WordName,
}

impl WithWord for Resumed<'_> {
    /// `None` if one of them does not support the tree, or the search ends earlier.
    type Output = Option<String>;

    fn call<W: KeyWord>(self) -> Option<String> {
        let Run { case, keys, tables } = *self.run;
        let tree = &case.tree;
        // The node's key is also a word.
        W::carries(tree.depth(), 1).ok()?;
        let mut search = Search::new(tree, &case.tape, case.any);
        let visits = mix(tree.node_count() as u64 ^ u64::from(case.octant)) % tree.node_count() as u64;
        let put_aside = PutAside { search: &mut search, visits };
        let Paused { node, trail, disjoint, next, .. } = tables.with_cursor::<W, _>(self.from, put_aside).ok()??;
        let kept = KeyTrail { key: keys.key::<W>(tree.slot(node)), trail, disjoint, next };
        let mut text = format!("resume-{} {} {visits}", self.to, self.word);
        for word in [&kept.key, &kept.trail, kept.disjoint.as_ref().unwrap_or(&W::zero())] {
            text.push(' ');
            add(&mut text, word);
        }
        let _ = match search.outcome.hit {
            Some((t, slot)) => write!(text, " {t} {slot} ;"),
            None => write!(text, " - - ;"),
        };
        // Every state of a traversal of this tree can be located.
        let Ok(kept) = kept.locate(&ByWalk(tree)) else { return Some(text + " refused\n") };
        let mut seen = Seen { text, tree, keys };
        let take_up = TakeUp { kept, search: &mut search, seen: &mut seen };
        tables.with_cursor::<W, _>(self.to, take_up).ok()?;
        Some(seen.text + &found(&search))
    }
}

/// Pauses before a visit, by number.
struct PutAside<'a, 'c> {
    search: &'a mut Search<'c, Tree>,
    visits: u64,
}

impl<W: KeyWord> WithCursor<W> for PutAside<'_, '_> {
    type Output = Option<Paused<W>>;

    fn call(self, mut cursor: impl Pause<Word = W>) -> Option<Paused<W>> {
        let next = traverse_pruned(&mut cursor, self.search, &mut Countdown(self.visits));
        next.filter(|&next| next == Next::Visit).map(|next| cursor.put_aside(next))
    }
}

struct Countdown(u64);

impl Recorder for Countdown {
    fn visit<W: KeyWord>(&mut self, _: Node, _: impl FnOnce() -> State<W>) -> Flow {
        match self.0.checked_sub(1) {
            Some(left) => {
                self.0 = left;
                Flow::Continue
            }
            None => Flow::Stop,
        }
    }
}

struct TakeUp<'a, 'c, W> {
    kept: Paused<W>,
    search: &'a mut Search<'c, Tree>,
    seen: &'a mut Seen<'c>,
}

impl<W: KeyWord> WithCursor<W> for TakeUp<'_, '_, W> {
    type Output = ();

    fn call(self, cursor: impl Pause<Word = W>) {
        // A rejected state leaves the line without visits.
        let _ = resume(cursor, self.kept, self.search, self.seen);
    }
}

/// Writes the state at each visit.
struct Seen<'c> {
    text: String,
    tree: &'c Tree,
    keys: &'c Keys,
}

impl Recorder for Seen<'_> {
    fn visit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow {
        let State { key, trail, counter, disjoint, register, .. } = state();
        self.text.push(' ');
        self.add_node(node);
        for word in [key, trail, counter, disjoint] {
            self.text.push(':');
            if let Some(word) = word {
                add(&mut self.text, &word);
            }
        }
        self.text.push(':');
        if let Some(node) = register {
            self.add_node(node);
        }
        self.goes_on()
    }

    /// On the way down after a restart: marks decisions that are repeated.
    fn revisit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow {
        let flow = self.visit(node, state);
        if !node.is_leaf() {
            self.text.push('~');
        }
        flow
    }
}

impl Seen<'_> {
    /// Stops a traversal that does not end.
    fn goes_on(&self) -> Flow {
        if self.text.len() > LONGEST { Flow::Stop } else { Flow::Continue }
    }

    /// Writes a node by its key, which may be longer than the traversal's word.
    fn add_node(&mut self, node: Node) {
        let slot = self.tree.slot(node);
        if self.keys.depth(slot) < u64::BITS {
            add(&mut self.text, &self.keys.key::<u64>(slot));
        } else {
            add(&mut self.text, &self.keys.key::<Grow>(slot));
        }
    }
}

/// Longer than any line of a terminating traversal.
const LONGEST: usize = 1 << 20;

fn add(text: &mut String, word: &impl KeyWord) {
    let _ = match word.to_u64() {
        Some(word) => write!(text, "{word:x}"),
        None => write!(text, "{}", hex(word)),
    };
}
