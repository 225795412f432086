//! The loop over rays: one, or two in turns.

use fearless_simd::{Simd, f32x8};

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
    // Two levels of x86: what SSE4.2 and AVX-512 add is no use here (benches/README.md), and each level costs every
    // build of the library its time.
    #[cfg(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2"))]
    {
        let baseline = || level.as_sse2().or_else(|| Level::new().as_sse2());
        match (level.as_avx2(), baseline()) {
            (Some(avx2), _) => avx2.vectorize(
                #[inline(always)]
                || run(avx2, method, job),
            ),
            (None, Some(sse2)) => sse2.vectorize(
                #[inline(always)]
                || run(sse2, method, job),
            ),
            // The target has it.
            (None, None) => unreachable!("a processor without SSE2"),
        }
    }
    #[cfg(not(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2")))]
    fearless_simd::dispatch!(level, simd => run(simd, method, job))
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
    let (mut first, mut second) = (Scratch::default(), None);
    if job.rays.len() > 1 {
        second = Some(Scratch::default());
    }
    let job = Job { answer: &mut *job.answer, ..job };
    method.dispatch(Turns::<S, ANY> { simd, job, first: &mut first, second: second.as_mut() })
}

type RaySearch<'a, S, const ANY: bool> = WideSearch<'a, S, f32x8<S>, 8, ANY>;

/// Two rays at a time: while one waits for memory, the other computes. The last one alone.
struct Turns<'t, 'f, S, const ANY: bool> {
    simd: S,
    job: Job<'t, 'f>,
    /// Memory of the two traversals; the second one's if there are two rays.
    first: &'t mut Scratch,
    second: Option<&'t mut Scratch>,
}

impl<'t, S: Simd, const ANY: bool> Context<'t, 8, WideBvh> for Turns<'t, '_, S, ANY> {
    type Output = ();

    #[inline(always)]
    fn run<C: Cursor<8>>(self, start: impl Fn(Supply<'t, WideBvh>) -> Result<C, Unfit>) -> Result<(), Unfit> {
        let Self { simd, job: Job { bvh, tables, rays, ask, answer }, first, second } = self;
        let mut cursor = start(Supply { tree: bvh, tables, memory: first })?;
        let (Some(ray), others) = (rays.first(), rays.get(1..).unwrap_or_default()) else { return Ok(()) };
        let (mut number, mut search) = (0, RaySearch::<S, ANY>::new(simd, bvh, ray));
        if let (Some(memory), Some((ray, rest))) = (second, others.split_first()) {
            let mut numbers = [0, 1];
            let mut cursors = [cursor, start(Supply { tree: bvh, tables, memory })?];
            let mut searches = [search, RaySearch::new(simd, bvh, ray)];
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
            number = numbers[last];
            let ([first, second], [of_first, of_second]) = (cursors, searches);
            (cursor, search) = if last == 0 { (first, of_first) } else { (second, of_second) };
        }
        // If it was asked just now, it is asked again.
        finish(bvh, &mut cursor, &mut search);
        answer(number, search.answer(ask));
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
