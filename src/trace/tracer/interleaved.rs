//! The loop over rays: one alone, or two interleaved.

use fearless_simd::Simd;

use super::search::{HitOf, HitQuery, Job, WideSearch};
use super::shared;
use crate::bvh::WideBvh;
use crate::geom::lanes::{Hits as _, Precision, vectorize};
use crate::geom::{Ray, Region};
use crate::trace::memory::with_memory;
use crate::wide::{Context, Cursor, Method, Scratch, Search, Supply, Unsupported, advance, traverse};

/// The answers of several rays, by the numbers of the rays.
///
/// A callback would be simpler. But it takes a hit from memory that was just written number by number, and waits for
/// it: a sixth of the time of rays that meet no box.
pub(super) enum Answers<'a, V: Precision> {
    Hits(&'a mut [Option<HitOf<V>>]),
    Distances(&'a mut [Option<(u32, V::Real)>]),
    Any(&'a mut [bool]),
}

impl<V: Precision> Answers<'_, V> {
    #[inline(always)]
    fn set(&mut self, number: usize, hit: Option<HitOf<V>>) {
        match self {
            Self::Hits(hits) => hits[number] = hit,
            Self::Distances(found) => found[number] = hit.map(|hit| (hit.prim, hit.t)),
            Self::Any(found) => found[number] = hit.is_some(),
        }
    }
}

/// Answers one ray.
pub(super) fn trace_one<V: Precision>(
    method: Method,
    job: Job<'_, V>,
    ray: &Ray<V>,
) -> Result<Option<HitOf<V>>, Unsupported> {
    if !has_copy::<V>(method) {
        return shared::trace(method, job, ray);
    }
    with_memory(|[memory, _]| match job.ask {
        HitQuery::Closest | HitQuery::Distance => dispatch(method, One::<V, false> { job, ray, memory }),
        HitQuery::Any | HitQuery::AnyHit => dispatch(method, One::<V, true> { job, ray, memory }),
    })
}

/// Answers each ray. `answers` has a place for each.
pub(super) fn trace<V: Precision>(
    method: Method,
    job: Job<'_, V>,
    rays: &[Ray<V>],
    answers: &mut Answers<'_, V>,
) -> Result<(), Unsupported> {
    if let [ray] = rays {
        return trace_one(method, job, ray).map(|hit| answers.set(0, hit));
    }
    if !has_copy::<V>(method) {
        // Detects an unfit traversal even without rays.
        shared::check(method, job)?;
        for (i, ray) in rays.iter().enumerate() {
            answers.set(i, shared::trace(method, job, ray)?);
        }
        return Ok(());
    }
    with_memory(|memory| match job.ask {
        HitQuery::Closest | HitQuery::Distance => dispatch(method, Several::<V, false> { job, rays, answers, memory }),
        HitQuery::Any | HitQuery::AnyHit => dispatch(method, Several::<V, true> { job, rays, answers, memory }),
    })
}

/// Returns whether this traversal has a separate copy. All other traversals share one.
fn has_copy<V: Precision>(method: Method) -> bool {
    V::HAS_ALL_COPIES || method == Method::Recorded
}

/// Dispatches to the compiled copies.
#[inline(always)]
fn dispatch<'t, V: Precision, X: Context<'t, 8, WideBvh<8, V>>>(
    method: Method,
    context: X,
) -> Result<X::Output, Unsupported> {
    if V::HAS_ALL_COPIES { method.dispatch(context) } else { Method::recorded(context) }
}

/// A single ray.
struct One<'t, V: Precision, const ANY: bool> {
    job: Job<'t, V>,
    ray: &'t Ray<V>,
    memory: &'t mut Scratch,
}

impl<'t, V: Precision, const ANY: bool> Context<'t, 8, WideBvh<8, V>> for One<'t, V, ANY> {
    type Output = Option<HitOf<V>>;

    #[inline(always)]
    fn run<C: Cursor<8>>(
        self,
        start: impl Fn(Supply<'t, WideBvh<8, V>>) -> Result<C, Unsupported>,
    ) -> Result<Self::Output, Unsupported> {
        let Self { job: Job { bvh, tables, level, ask }, ray, memory } = self;
        let cursor = start(Supply { tree: bvh, tables, memory })?;
        Ok(vectorize!(level, simd => alone::<_, C, V, ANY>(simd, cursor, bvh, ray, ask)))
    }
}

/// Several rays, two at a time.
struct Several<'t, 'a, V: Precision, const ANY: bool> {
    job: Job<'t, V>,
    rays: &'t [Ray<V>],
    answers: &'t mut Answers<'a, V>,
    memory: &'t mut [Scratch; 2],
}

impl<'t, V: Precision, const ANY: bool> Context<'t, 8, WideBvh<8, V>> for Several<'t, '_, V, ANY> {
    type Output = ();

    #[inline(always)]
    fn run<C: Cursor<8>>(
        self,
        start: impl Fn(Supply<'t, WideBvh<8, V>>) -> Result<C, Unsupported>,
    ) -> Result<(), Unsupported> {
        let Self { job, rays, answers, memory: [first, second] } = self;
        let Job { bvh: tree, tables, level, .. } = job;
        let cursors = [start(Supply { tree, tables, memory: first })?, start(Supply { tree, tables, memory: second })?];
        if let [one, two, rest @ ..] = rays {
            vectorize!(level, simd => interleaved::<_, C, V, ANY>(simd, cursors, [one, two], rest, job, answers));
        }
        Ok(())
    }
}

/// Traces one ray to its end.
#[inline(always)]
fn alone<S: Simd, C: Cursor<8>, V: Precision, const ANY: bool>(
    simd: S,
    cursor: C,
    bvh: &WideBvh<8, V>,
    ray: &Ray<V>,
    ask: HitQuery,
) -> Option<HitOf<V>> {
    let (tree, mut hits) = (bvh.tree(), V::Hits::new(ray, bvh.region()));
    let mut search = WideSearch::<S, V, ANY>::new(simd, bvh, tree, &mut hits);
    traverse(&tree, cursor, &mut search, &mut ());
    search.answer(ask)
}

/// Two rays at a time: while one waits for memory, the other computes. `rest` follows the first two.
#[inline(always)]
fn interleaved<S: Simd, C: Cursor<8>, V: Precision, const ANY: bool>(
    simd: S,
    [mut cursor_a, mut cursor_b]: [C; 2],
    [a, b]: [&Ray<V>; 2],
    rest: &[Ray<V>],
    Job { bvh, ask, .. }: Job<'_, V>,
    answers: &mut Answers<'_, V>,
) {
    let mut hits = [a, b].map(|ray| V::Hits::new(ray, bvh.region()));
    let [hits_a, hits_b] = &mut hits;
    let tree = bvh.tree();
    let (mut search_a, mut search_b) =
        (WideSearch::<S, V, ANY>::new(simd, bvh, tree, hits_a), WideSearch::<S, V, ANY>::new(simd, bvh, tree, hits_b));
    let (mut number_a, mut number_b) = (0, 1);
    let (mut is_done_a, mut is_done_b) = (false, false);
    let mut rest = (2..).zip(rest);
    // Written out for each of the two: with a variable index, both rays' states are in memory, which costs a tenth.
    macro_rules! turn {
        ($asked:ident, $number:ident, $cursor:ident, $search:ident, $is_done:ident, $other_is_done:ident) => {
            if !$is_done && !advance(&tree, &mut $cursor, $asked, &mut $search, &mut ()) {
                answers.set($number, $search.answer(ask));
                if let Some((number, ray)) = next_ray(&mut rest, bvh.region(), answers) {
                    $cursor.reset(&tree);
                    ($number, $search) = (number, $search.with_ray(ray));
                } else if $other_is_done {
                    return;
                } else {
                    $is_done = true;
                }
            }
        };
    }
    loop {
        // This also queries a ray that is done: only at the end of a batch, and the answer is not used.
        let (asked_a, asked_b) = (search_a.ask(cursor_a.node()), search_b.ask(cursor_b.node()));
        turn!(asked_a, number_a, cursor_a, search_a, is_done_a, is_done_b);
        turn!(asked_b, number_b, cursor_b, search_b, is_done_b, is_done_a);
    }
}

/// Returns the next ray that needs a traversal: rays that pass by the whole scene need no preparation either.
#[inline(always)]
fn next_ray<'r, V: Precision>(
    rays: &mut impl Iterator<Item = (usize, &'r Ray<V>)>,
    region: &Region,
    answers: &mut Answers<'_, V>,
) -> Option<(usize, &'r Ray<V>)> {
    loop {
        let (number, ray) = rays.next()?;
        if !V::passes_by(ray, region) {
            return Some((number, ray));
        }
        answers.set(number, None);
    }
}
