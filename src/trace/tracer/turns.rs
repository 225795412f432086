//! The loop over rays: one alone, or two in turns.

use std::cell::Cell;

use fearless_simd::{Simd, f32x8};

use super::search::WideSearch;
use crate::bvh::WideBvh;
use crate::geom::Ray;
use crate::geom::lanes::{LazyExact, Level};
use crate::trace::Hit;
use crate::wide::{Context, Cursor, Method, Scratch, Search, Supply, Tables, Unfit, advance, traverse};

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
pub(super) fn trace(level: Level, method: Method, job: &mut Job<'_, '_>) -> Result<(), Unfit> {
    with_memory(|memory| match job.ask {
        Ask::Closest | Ask::Distance => method.dispatch(Start::<false> { level, job, memory }),
        Ask::Any | Ask::AnyHit => method.dispatch(Start::<true> { level, job, memory }),
    })
}

/// Does something with the cursors' memory of this thread.
pub(in crate::trace) fn with_memory<R>(run: impl FnOnce(&mut [Scratch; 2]) -> R) -> R {
    let mut memory = MEMORY.try_with(Cell::take).ok().flatten().unwrap_or_default();
    let ran = run(&mut memory);
    // A thread that ends keeps nothing any more.
    _ = MEMORY.try_with(|kept| kept.set(Some(memory)));
    ran
}

thread_local! {
    /// Memory of two cursors: to allocate or to clear it for each ray would cost a call a tenth of its time.
    static MEMORY: Cell<Option<Box<[Scratch; 2]>>> = const { Cell::new(None) };
}

/// Makes a cursor, or two for more than one ray.
struct Start<'t, 'a, 'f, const ANY: bool> {
    level: Level,
    job: &'t mut Job<'a, 'f>,
    memory: &'t mut [Scratch; 2],
}

/// The loop is compiled once for each traversal and level of instructions, in a function of its own. All that it calls
/// is inlined always, or it would not be compiled for the level.
macro_rules! vectorize {
    ($level:expr, $simd:ident => $run:expr) => {{
        // Two levels of x86: what SSE4.2 and AVX-512 add is no use here, and each level costs every build of the
        // library its time.
        #[cfg(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2"))]
        match ($level.as_avx2(), $level.as_sse2().or_else(|| Level::new().as_sse2())) {
            (Some($simd), _) => $simd.vectorize(
                #[inline(always)]
                || $run,
            ),
            (None, Some($simd)) => $simd.vectorize(
                #[inline(always)]
                || $run,
            ),
            (None, None) => unreachable!("the target has SSE2"),
        }
        #[cfg(not(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2")))]
        fearless_simd::dispatch!($level, $simd => $run);
    }};
}

impl<'t, const ANY: bool> Context<'t, 8, WideBvh> for Start<'t, '_, '_, ANY> {
    type Output = ();

    #[inline(always)]
    fn run<C: Cursor<8>>(self, start: impl Fn(Supply<'t, WideBvh>) -> Result<C, Unfit>) -> Result<(), Unfit> {
        let Self { level, job, memory: [first, second] } = self;
        let (tree, tables) = (job.bvh, job.tables);
        let cursor = start(Supply { tree, tables, memory: first })?;
        match job.rays {
            [] => (),
            [ray] => vectorize!(level, simd => alone::<_, C, ANY>(simd, cursor, ray, job)),
            [one, two, rest @ ..] => {
                let cursors = [cursor, start(Supply { tree, tables, memory: second })?];
                vectorize!(level, simd => in_turns::<_, C, ANY>(simd, cursors, [one, two], rest, job));
            }
        }
        Ok(())
    }
}

type RaySearch<'a, 'm, S, const ANY: bool> = WideSearch<'a, 'm, S, f32x8<S>, 8, ANY>;

/// Traces one ray to its end.
#[inline(always)]
fn alone<S: Simd, C: Cursor<8>, const ANY: bool>(simd: S, cursor: C, ray: &Ray, job: &mut Job<'_, '_>) {
    let Job { bvh, ask, ref mut answer, .. } = *job;
    let mut exact = LazyExact::new(ray, bvh.region());
    let mut search = RaySearch::<S, ANY>::new(simd, bvh, &mut exact);
    traverse(bvh, cursor, &mut search, &mut ());
    answer(0, search.answer(ask));
}

/// Two rays at a time: while one waits for memory, the other computes. `rest` follows the first two.
#[inline(always)]
fn in_turns<S: Simd, C: Cursor<8>, const ANY: bool>(
    simd: S,
    [mut cursor_a, mut cursor_b]: [C; 2],
    [a, b]: [&Ray; 2],
    rest: &[Ray],
    job: &mut Job<'_, '_>,
) {
    let Job { bvh, ask, ref mut answer, .. } = *job;
    let mut exact = [a, b].map(|ray| LazyExact::new(ray, bvh.region()));
    let [exact_a, exact_b] = &mut exact;
    let (mut search_a, mut search_b) =
        (RaySearch::<S, ANY>::new(simd, bvh, exact_a), RaySearch::<S, ANY>::new(simd, bvh, exact_b));
    let (mut number_a, mut number_b) = (0, 1);
    let (mut is_done_a, mut is_done_b) = (false, false);
    let mut rest = (2..).zip(rest);
    // Written out for each of the two: with a number that varies, both rays' states are in memory, which costs a tenth.
    macro_rules! turn {
        ($asked:ident, $number:ident, $cursor:ident, $search:ident, $is_done:ident, $other_is_done:ident) => {
            if !$is_done && !advance(bvh, &mut $cursor, $asked, &mut $search, &mut ()) {
                answer($number, $search.answer(ask));
                if let Some((number, ray)) = rest.next() {
                    $cursor.reset();
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
        // A ray that is done is asked too: only at the end of a batch, and nobody uses the answer.
        let (asked_a, asked_b) = (search_a.ask(cursor_a.node()), search_b.ask(cursor_b.node()));
        turn!(asked_a, number_a, cursor_a, search_a, is_done_a, is_done_b);
        turn!(asked_b, number_b, cursor_b, search_b, is_done_b, is_done_a);
    }
}
