//! The parts of a ray's time: finding the next node, boxes, triangles (Barringer & Akenine-Möller 2013, Fig. 5).

use std::hint::black_box;

use serde::Serialize;
use stackless_bvh::bvh::{Bvh, BvhTree};
use stackless_bvh::geom::{Kernel, Ray};
use stackless_bvh::internals::geom::Slabs;
use stackless_bvh::internals::geom::kernel::Exact;
use stackless_bvh::internals::geom::slabs::Directed;
use stackless_bvh::internals::trace::Closest;
use stackless_bvh::internals::traverse::{WithCursor, WithWord, with_word};
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::{Descent, Flow, Unpruned, Visitor};
use stackless_bvh::trace::BinaryTracer;
use stackless_bvh::traverse::{Method, Pause, Stack, Tables, Unsupported, traverse, traverse_pruned};
use stackless_bvh::tree::{Implicit, Node, Recorded};

use crate::output::{Table, table};
use crate::turns::{median, take_turns};

/// Nanoseconds per ray of one traversal.
#[derive(Serialize)]
pub(super) struct Row {
    method: &'static str,
    /// The whole query.
    all: f64,
    /// The traversal alone, with known decisions.
    traversal: f64,
    /// Preparing the ray, and the box tests of the query.
    boxes: f64,
    /// Preparing the ray, and the triangle tests of the query.
    triangles: f64,
}

const METHODS: [Method; 5] = [Method::Stack, Method::Sparse, Method::Afra, Method::Uncle, Method::Hashed];
const CHUNK: usize = 1024;
const ROUNDS: usize = 5;

/// Times the parts of queries alone. The parts do not add up to the whole: the processor overlaps them, and each part
/// reads memory.
pub(super) fn measure(bvh: &Bvh, rays: &[Ray]) -> Result<Vec<Row>, Unsupported> {
    let with_uncles = bvh.clone().with_links(Recorded::Uncles);
    let tree = |method: Method| if method.wants_recorded() == Recorded::Uncles { &with_uncles } else { bvh };
    let mut tracers = Vec::new();
    for method in METHODS {
        tracers.push(BinaryTracer::with_method(tree(method), method)?);
    }
    let tables = METHODS.map(|method| Tables::new(tree(method).tree(), bvh.axes(), &[method], Implicit::LIMIT));
    let tapes: Vec<_> = rays.iter().map(|ray| Tape::of(bvh, ray)).collect();
    let (mut memory, mut found, mut unfit) = (Vec::new(), [None; CHUNK], None);
    // Contestants: each method with the whole query, then with the traversal alone; then boxes; then triangles.
    let contestants = 2 * METHODS.len() + 2;
    let times = take_turns(contestants, rays.len(), CHUNK, ROUNDS, "parts of the time", |who, chunk| {
        let (rays, tapes) = (&rays[chunk.clone()], &tapes[chunk]);
        match (METHODS.get(who / 2), who % 2) {
            (Some(_), 0) => tracers[who / 2].closest_distances(rays, black_box(&mut found)),
            (Some(&method), _) => {
                let word = tracers[who / 2].word();
                for tape in tapes {
                    let replay = Replay { tape, tables: &tables[who / 2], method, memory: &mut memory };
                    unfit = unfit.or(with_word(word, replay).err());
                }
            }
            (None, 0) => tapes.iter().zip(rays).for_each(|(tape, ray)| tape.boxes(bvh, ray)),
            (None, _) => tapes.iter().zip(rays).for_each(|(tape, ray)| tape.triangles(bvh, ray)),
        }
    });
    if let Some(unfit) = unfit {
        return Err(unfit);
    }
    let nanoseconds = |who: usize| median(times.by_round(who)) / rays.len() as f64 * 1e9;
    let [boxes, triangles] = [0, 1].map(|part| nanoseconds(2 * METHODS.len() + part));
    let row = |(i, method): (usize, Method)| {
        let [all, traversal] = [nanoseconds(2 * i), nanoseconds(2 * i + 1)];
        Row { method: method.name(), all, traversal, boxes, triangles }
    };
    Ok(METHODS.into_iter().enumerate().map(row).collect())
}

pub(super) fn to_table(rows: &[Row]) -> Table {
    let cells = |row: &Row| {
        let numbers = [row.all, row.traversal, row.boxes, row.triangles].map(|ns| format!("{ns:.0}"));
        [row.method.to_owned()].into_iter().chain(numbers).collect()
    };
    let header = ["ns a ray", "all", "traversal alone", "boxes alone", "triangles alone"];
    table(&header, 1, rows.iter().map(cells).collect())
}

/// A recorded closest-hit query.
struct Tape {
    descents: Vec<Descent>,
    /// Inner nodes, with the length of the ray when they are visited.
    inner: Vec<(Node, f32)>,
    leaves: Vec<(Node, f32)>,
}

impl Tape {
    fn of(bvh: &Bvh, ray: &Ray) -> Self {
        let tape = Self { descents: Vec::new(), inner: Vec::new(), leaves: Vec::new() };
        let mut recording = Recording { search: Closest::new(bvh, ray), end: ray.tmax(), tape };
        traverse(Stack::new(bvh, &mut Vec::new()), &mut recording, &mut ());
        recording.tape
    }

    #[inline(never)]
    fn boxes(&self, bvh: &Bvh, ray: &Ray) {
        let slabs = Directed::new(ray, bvh.region());
        for &(node, end) in &self.inner {
            black_box(slabs.pair(&bvh.node(node.index()).planes, end));
        }
    }

    #[inline(never)]
    fn triangles(&self, bvh: &Bvh, ray: &Ray) {
        let kernel = Exact::new(ray, bvh.region());
        for &(leaf, end) in &self.leaves {
            for held in bvh.leaf_triangles(leaf) {
                black_box(kernel.distance(&held.shape, end));
            }
        }
    }
}

struct Recording<'a> {
    search: Closest<'a>,
    end: f32,
    tape: Tape,
}

impl Recording<'_> {
    fn length(&self) -> f32 {
        self.search.found().map_or(self.end, |(_, t)| t)
    }
}

impl Visitor for Recording<'_> {
    fn inner(&mut self, node: Node) -> Descent {
        self.tape.inner.push((node, self.length()));
        let descent = self.search.inner(node);
        self.tape.descents.push(descent);
        descent
    }

    fn leaf(&mut self, node: Node) -> Flow {
        self.tape.leaves.push((node, self.length()));
        self.search.leaf(node)
    }
}

/// A traversal that repeats the recorded decisions of a query.
struct Replay<'r> {
    tape: &'r Tape,
    tables: &'r Tables<'r, BvhTree>,
    method: Method,
    memory: &'r mut Vec<Node>,
}

impl WithWord for Replay<'_> {
    type Output = Result<(), Unsupported>;

    fn call<W: KeyWord>(self) -> Result<(), Unsupported> {
        let Self { tape, tables, method, memory } = self;
        let known = Known(tape.descents.iter());
        if method == Method::Stack {
            traverse(Stack::new(&tables.tree(), memory), &mut { known }, &mut ());
            return Ok(());
        }
        tables.with_cursor::<W, _>(method, known)
    }
}

/// Recorded decisions.
struct Known<'t>(std::slice::Iter<'t, Descent>);

impl<W: KeyWord> WithCursor<W> for Known<'_> {
    type Output = ();

    fn call(mut self, cursor: impl Pause<Word = W>) {
        traverse_pruned(cursor, &mut Unpruned(&mut self), &mut ());
    }
}

impl Visitor for Known<'_> {
    #[inline(always)]
    fn inner(&mut self, _: Node) -> Descent {
        self.0.next().copied().unwrap_or(Descent::NEITHER)
    }

    #[inline(always)]
    fn leaf(&mut self, _: Node) -> Flow {
        Flow::Continue
    }
}
