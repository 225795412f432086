//! The worked examples of the specification: blocks that begin with `as-run NAME` are computed again and compared.
//!
//! `UPDATE=1 cargo test --test library examples` rewrites them.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use glam::Vec3;
use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::event::{Recorder, State};
use stackless_bvh::geom::{Aabb, Mesh, Ray, Region};
use stackless_bvh::hash::{KeyMap, KeySet, Options, PerfectHash, Sizing};
use stackless_bvh::internals::geom::slabs::{Directed, Plain, Slabs};
use stackless_bvh::key::{Grow, KeyWord};
use stackless_bvh::order::{Descent, Flow, Pruned, Pruning, Side, Visitor};
use stackless_bvh::traverse::Disjoint;
use stackless_bvh::traverse::{Hashed, Sparse, traverse, traverse_pruned};
use stackless_bvh::tree::{Keys, Linked, Node, Reach, Recorded, Topology, Tree};
use stackless_bvh::{swap, trail};

type Example = (&'static str, fn() -> String);

/// The output of each example.
const EXAMPLES: [Example; 8] = [
    ("backtrack", backtrack),
    ("swap", swaps),
    ("depth", depth),
    ("walk", walk),
    ("table", table),
    ("prune", prune),
    ("slab", slab),
    ("file", file),
];

/// Fig. 2 of Binder & Keller. [TRAIL-3] [TRAIL-4]
fn backtrack() -> String {
    let (key, trail) = (0b10110_u32, 0b1000);
    let (next, left) = trail::backtrack(key, trail);
    format!("key {key:b} trail {trail:b} -> levels {} key {next:b} trail {left:b}\n", trail::levels(&trail))
}

fn swaps() -> String {
    let line = |(index, mask): (u32, u32)| {
        let forms = [swap::fcomp_printed(index, &mask), swap::fcomp(index, &mask), swap::swap_levels(index, &mask)];
        let [printed, xor, levels] = forms;
        format!("index {index:b} mask {mask:b} -> printed {printed:b} xor {xor:b} levels {levels:b}\n")
    };
    [(0b10, 0b110), (0b1111_1111, 0b1010_1010)].map(line).concat()
}

/// Wants all children, left first.
struct All(usize);

impl Visitor for All {
    fn inner(&mut self, _: Node) -> Descent {
        self.0 += 1;
        Descent::both(Side::Left)
    }

    fn leaf(&mut self, _: Node) -> Flow {
        self.0 += 1;
        Flow::Continue
    }
}

/// [DEPTH-2]
fn depth() -> String {
    fn line<W: KeyWord>(depths: &[u32]) -> String {
        let visits = |&depth: &u32| {
            let children = |at: u32| (at.is_multiple_of(2) && at < 2 * depth).then_some([at + 1, at + 2]);
            let tree = Tree::new(&(0..=2 * depth).map(children).collect::<Vec<_>>()).expect("a chain");
            let mut all = All(0);
            let uncles = Linked::uncles(&tree);
            match Hashed::<W, _, _>::new(&uncles, KeyMap::of(&tree)) {
                Ok(hashed) => drop(traverse(hashed, &mut all, &mut ())),
                Err(error) => return format!("{depth} edges: {error}"),
            }
            format!("{depth} edges: {} visits", all.0)
        };
        format!("{}: {}\n", W::NAME, depths.iter().map(visits).collect::<Vec<_>>().join("; "))
    }
    [line::<u32>(&[31, 32]), line::<u64>(&[63, 64]), line::<u128>(&[127, 128]), line::<Grow>(&[1000])].concat()
}

/// The inner nodes with these keys, each with the decision of its visit.
struct Script {
    tree: Tree,
    decisions: Vec<(u64, Descent)>,
    keys: Keys,
    /// Keys of leaves with a hit.
    found: Vec<u64>,
}

impl Script {
    fn new(decisions: &[(u64, Descent)], found: &[u64]) -> Self {
        let mut nodes = vec![1];
        let mut children = Vec::new();
        for at in 0.. {
            let Some(&key) = nodes.get(at) else { break };
            let is_inner = decisions.iter().any(|&(inner, _)| inner == key);
            children.push(is_inner.then(|| [0, 1].map(|side| (nodes.len() + side) as u32)));
            nodes.extend([2 * key, 2 * key + 1].into_iter().filter(|_| is_inner));
        }
        let tree = Tree::new(&children).expect("a tree");
        let keys = Keys::of(&tree);
        Self { tree, decisions: decisions.to_vec(), keys, found: found.to_vec() }
    }

    fn key(&self, node: Node) -> u64 {
        self.keys.key(self.tree.slot(node))
    }
}

impl Visitor for &Script {
    fn inner(&mut self, node: Node) -> Descent {
        let key = self.key(node);
        self.decisions.iter().find(|(inner, _)| *inner == key).map_or(Descent::NEITHER, |&(_, descent)| descent)
    }

    fn leaf(&mut self, _: Node) -> Flow {
        Flow::Continue
    }
}

impl Pruned for &Script {
    fn allows(&self, _: Pruning) -> bool {
        true
    }

    fn found_at(&self, leaf: Node) -> bool {
        self.found.contains(&self.key(leaf))
    }
}

/// One line per visit: the node's key, and the words of the state.
struct Lines<'a> {
    script: &'a Script,
    text: String,
}

impl Recorder for Lines<'_> {
    fn visit<W: KeyWord>(&mut self, node: Node, state: impl FnOnce() -> State<W>) -> Flow {
        let mut visitor = self.script;
        let state = state();
        let kind = if node.is_leaf() { "leaf" } else { "enter" };
        write!(self.text, "{kind:5} {:<2}", self.script.key(node)).unwrap();
        let words =
            [("key", state.key), ("trail", state.trail), ("counter", state.counter), ("second trail", state.disjoint)];
        for (name, word) in words.iter().filter_map(|(name, word)| Some((name, word.as_ref()?))) {
            write!(self.text, "  {name} {:5}", format!("{:b}", word.to_u64().unwrap())).unwrap();
        }
        if let Some(register) = state.register {
            write!(self.text, "  register {}", self.script.key(register)).unwrap();
        }
        if !node.is_leaf() {
            write!(self.text, "  -> {:?}", visitor.inner(node)).unwrap();
        }
        self.text.truncate(self.text.trim_end().len());
        self.text.push('\n');
        Flow::Continue
    }
}

fn example_script() -> Script {
    let both = Descent::both(Side::Left);
    let right = Descent::only(Side::Right);
    let decisions = [(1, both), (2, right), (5, right), (11, both), (3, Descent::both(Side::Right)), (7, both)];
    Script::new(&decisions, &[])
}

/// [HASHED-1] [SPARSE-1] [TRAIL-2] [TRAIL-6]
fn walk() -> String {
    let script = example_script();
    let mut text = String::new();
    let linked = Linked::both(&script.tree);
    let hash = PerfectHash::build(&script.tree, printed()).expect("a table");
    for (name, hashed) in [("hashed", true), ("sparse", false)] {
        let mut lines = Lines { script: &script, text: format!("{name}\n") };
        if hashed {
            traverse(Hashed::<u32, _, _>::new(&linked, &hash).unwrap(), &mut &script, &mut lines);
        } else {
            traverse(Sparse::<u32, _>::new(&linked).unwrap(), &mut &script, &mut lines);
        }
        text += &(lines.text + "end\n");
    }
    text
}

fn printed() -> Options {
    Options { key_set: KeySet::Exact(Reach::ALGORITHM_1), sizing: Sizing::Printed }
}

/// [HASH-2] [HASH-3] [HASH-5]
fn table() -> String {
    let script = example_script();
    let mut text = String::new();
    let sets = [("all", KeySet::All), ("HASH-3", KeySet::Exact(Reach::ALGORITHM_1))];
    for (name, key_set) in sets {
        let hash = PerfectHash::build(&script.tree, Options { key_set, ..printed() }).expect("a table");
        let hashed = key_set.slots(&script.tree);
        let mut keys: Vec<_> = (0..script.tree.node_count() as u32)
            .filter(|&slot| hashed[slot as usize])
            .map(|slot| script.key(script.tree.node(slot).unwrap()))
            .collect();
        keys.sort_unstable();
        let words = |words: &[u32]| words.iter().map(|word| format!("{word:x}")).collect::<Vec<_>>().join(" ");
        writeln!(text, "keys {name}: {keys:?}").unwrap();
        writeln!(text, "  displacements: {}", words(hash.displacements())).unwrap();
        writeln!(text, "  cells: {}", words(hash.cells())).unwrap();
    }
    text
}

/// [DISJOINT-1] [DISJOINT-2]
fn prune() -> String {
    let both = Descent::both(Side::Left);
    let decisions = [(1, both.disjoint_if(true)), (2, both), (4, both.disjoint_if(true)), (3, both)];
    let mut text = String::new();
    for found in [vec![], vec![8]] {
        let script = Script::new(&decisions, &found);
        let mut lines = Lines { script: &script, text: format!("found at {found:?}\n") };
        let (uncles, map) = (Linked::uncles(&script.tree), KeyMap::of(&script.tree));
        let hashed = Hashed::<u32, _, _, Disjoint<u32>>::new(&uncles, &map).unwrap();
        traverse_pruned(hashed, &mut &script, &mut lines);
        text += &(lines.text + "end\n");
    }
    text
}

/// [BOX-1]
fn slab() -> String {
    let ray = Ray::new(Vec3::ZERO, Vec3::new(1.0, 41.0, 0.0)).expect("a ray");
    let aabb = Aabb { lo: Vec3::new(1.0, 40.0, 0.0), hi: Vec3::new(2.0, 41.0, 1.0) };
    let region = Region::of(&aabb);
    let mut text = String::new();
    let (directed, plain) = (Directed::new(&ray, &region), Plain::new(&ray, &region));
    let planes = aabb.planes_twice();
    for (name, intervals) in
        [("BOX-1", directed.pair(&planes, f32::INFINITY)), ("plain", plain.pair(&planes, f32::INFINITY))]
    {
        let (near, far) = (intervals.near[0], intervals.far[0]);
        let hit = if intervals.hit[0] { "hit" } else { "missed" };
        writeln!(text, "{name}: near {near} {:08x}, far {far} {:08x}: {hit}", near.to_bits(), far.to_bits()).unwrap();
    }
    text
}

/// [FILE-1] [FILE-3] [FILE-4]
fn file() -> String {
    let mesh = Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]]);
    let bvh = Bvh::sah(&mesh.expect("a mesh"), SahOptions::default()).expect("a tree");
    let bvh = bvh.with_links(Recorded::Uncles);
    let bytes = bvh.to_bytes();
    let lines = bytes.chunks(16).enumerate().map(|(at, bytes)| {
        let bytes: Vec<_> = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        format!("{:3}: {}\n", 16 * at, bytes.join(" "))
    });
    lines.collect()
}

fn specification() -> impl Iterator<Item = PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../spec");
    let files = fs::read_dir(folder).expect("spec").map(|entry| entry.expect("a file").path());
    files.filter(|path| path.extension().is_some_and(|extension| extension == "md"))
}

#[test]
fn the_specification_shows_what_is_run() {
    let mut seen = Vec::new();
    for path in specification() {
        let text = fs::read_to_string(&path).expect("a text");
        let mut anew = text.clone();
        for (name, run) in EXAMPLES {
            let start = format!("```as-run {name}\n");
            let Some(begin) = anew.find(&start).map(|at| at + start.len()) else { continue };
            let end = begin + anew[begin..].find("```").expect("the end of an example");
            anew.replace_range(begin..end, &run());
            seen.push(name);
        }
        if std::env::var_os("UPDATE").is_some() {
            fs::write(&path, &anew).expect("a text");
        } else {
            assert!(text == anew, "{}: not what is run:\n{anew}", path.display());
        }
        let blocks = anew.matches("```as-run ").count();
        let known = EXAMPLES.iter().filter(|(name, _)| anew.contains(&format!("```as-run {name}\n"))).count();
        assert_eq!(blocks, known, "{}: an example that nobody runs", path.display());
    }
    seen.sort_unstable();
    let mut all = EXAMPLES.map(|(name, _)| name);
    all.sort_unstable();
    assert_eq!(seen, all);
}
