//! The loop over rays: one, or two in turns.

use fearless_simd::{Simd, dispatch, f32x8};

use super::search::WideSearch;
use crate::bvh::WideBvh;
use crate::geom::Ray;
use crate::geom::lanes::Level;
use crate::trace::Hit;
use crate::wide::{Context, Cursor, Method, Scratch, Search, Supply, Tables, Unfit, advance};

/// What is asked of each ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ask {
    /// The closest hit.
    Closest,
    /// The same; the weights in the answer are 0.
    Distance,
    /// Whether there is a hit; distance and weights in the answer mean nothing.
    Any,
    /// Any hit.
    AnyHit,
}

/// What is to be done.
pub(super) struct Job<'a, 'f> {
    pub(super) bvh: &'a WideBvh,
    pub(super) tables: &'a Tables,
    pub(super) rays: &'a [Ray],
    pub(super) ask: Ask,
    /// Gets the number of a ray and its answer, in whatever order rays end.
    pub(super) answer: &'a mut (dyn FnMut(usize, Option<Hit>) + 'f),
}

/// Answers each ray of a job.
///
/// Compiled once for each level of instructions and each traversal. Everything below is inlined always, or it would
/// not be compiled for the level.
pub(super) fn trace(level: Level, method: Method, job: Job<'_, '_>) -> Result<(), Unfit> {
    dispatch!(level, simd => run(simd, method, job))
}

#[inline(always)]
fn run<S: Simd>(simd: S, method: Method, job: Job<'_, '_>) -> Result<(), Unfit> {
    match job.ask {
        Ask::Closest | Ask::Distance => run_as::<S, false>(simd, method, job),
        Ask::Any | Ask::AnyHit => run_as::<S, true>(simd, method, job),
    }
}

#[inline(always)]
fn run_as<S: Simd, const ANY: bool>(simd: S, method: Method, job: Job<'_, '_>) -> Result<(), Unfit> {
    let mut memory = [Scratch::default(), Scratch::default()];
    let job = Job { answer: &mut *job.answer, ..job };
    if job.rays.len() < 2 {
        method.dispatch(Alone::<S, ANY> { simd, job, memory: &mut memory[0] })
    } else {
        method.dispatch(InTurns::<S, ANY> { simd, job, memory: &mut memory })
    }
}

type RaySearch<'a, S, const ANY: bool> = WideSearch<'a, S, f32x8<S>, 8, ANY>;

/// One ray at most.
struct Alone<'t, 'f, S, const ANY: bool> {
    simd: S,
    job: Job<'t, 'f>,
    memory: &'t mut Scratch,
}

impl<'t, S: Simd, const ANY: bool> Context<'t, 8, WideBvh> for Alone<'t, '_, S, ANY> {
    type Output = ();

    #[inline(always)]
    fn run<C: Cursor<8>>(self, start: impl Fn(Supply<'t, WideBvh>) -> Result<C, Unfit>) -> Result<(), Unfit> {
        let Self { simd, job: Job { bvh, tables, rays, ask, answer }, memory } = self;
        let mut cursor = start(Supply { tree: bvh, tables, memory })?;
        if let Some(ray) = rays.first() {
            let mut search = RaySearch::<S, ANY>::new(simd, bvh, ray);
            finish(bvh, &mut cursor, &mut search);
            answer(0, search.answer(ask));
        }
        Ok(())
    }
}

/// Two rays or more, two at a time: while one waits for memory, the other computes.
struct InTurns<'t, 'f, S, const ANY: bool> {
    simd: S,
    job: Job<'t, 'f>,
    memory: &'t mut [Scratch; 2],
}

impl<'t, S: Simd, const ANY: bool> Context<'t, 8, WideBvh> for InTurns<'t, '_, S, ANY> {
    type Output = ();

    #[inline(always)]
    fn run<C: Cursor<8>>(self, start: impl Fn(Supply<'t, WideBvh>) -> Result<C, Unfit>) -> Result<(), Unfit> {
        let Self { simd, job: Job { bvh, tables, rays, ask, answer }, memory: [first, second] } = self;
        let mut cursors =
            [start(Supply { tree: bvh, tables, memory: first })?, start(Supply { tree: bvh, tables, memory: second })?];
        let [first, second, rest @ ..] = rays else { return Ok(()) };
        let mut searches = [RaySearch::<S, ANY>::new(simd, bvh, first), RaySearch::new(simd, bvh, second)];
        let mut numbers = [0, 1];
        let mut rest = (2..).zip(rest);
        let last = 'turns: loop {
            let asked = [searches[0].ask(cursors[0].node()), searches[1].ask(cursors[1].node())];
            for i in 0..2 {
                if advance(bvh, &mut cursors[i], asked[i], &mut searches[i], &mut ()) {
                    continue;
                }
                answer(numbers[i], searches[i].answer(ask));
                let Some((number, ray)) = rest.next() else { break 'turns 1 - i };
                cursors[i].reset();
                (numbers[i], searches[i]) = (number, RaySearch::new(simd, bvh, ray));
            }
        };
        // If the other one was asked just now, it is asked again.
        finish(bvh, &mut cursors[last], &mut searches[last]);
        answer(numbers[last], searches[last].answer(ask));
        Ok(())
    }
}

/// Traces one ray to its end, from wherever it is.
#[inline(always)]
fn finish<S: Simd, const ANY: bool>(bvh: &WideBvh, cursor: &mut impl Cursor<8>, search: &mut RaySearch<'_, S, ANY>) {
    loop {
        let wanted = search.ask(cursor.node());
        if !advance(bvh, cursor, wanted, search, &mut ()) {
            return;
        }
    }
}
