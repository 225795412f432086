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
/// The loop is compiled once for each traversal and level of instructions, in a function of its own. All that it calls
/// is inlined always, or it would not be compiled for the level.
pub(super) fn trace(level: Level, method: Method, job: Job<'_, '_>) -> Result<(), Unfit> {
    let (mut first, mut second) = (Scratch::default(), None);
    if job.rays.len() > 1 {
        second = Some(Scratch::default());
    }
    let job = Job { answer: &mut *job.answer, ..job };
    let (first, second) = (&mut first, second.as_mut());
    match job.ask {
        Ask::Closest | Ask::Distance => method.dispatch(Start::<false> { level, job, first, second }),
        Ask::Any | Ask::AnyHit => method.dispatch(Start::<true> { level, job, first, second }),
    }
}

/// Makes two cursors, or one if there is only one ray.
struct Start<'t, 'f, const ANY: bool> {
    level: Level,
    job: Job<'t, 'f>,
    /// Memory of the two.
    first: &'t mut Scratch,
    second: Option<&'t mut Scratch>,
}

impl<'t, const ANY: bool> Context<'t, 8, WideBvh> for Start<'t, '_, ANY> {
    type Output = ();

    #[inline(always)]
    fn run<C: Cursor<8>>(self, start: impl Fn(Supply<'t, WideBvh>) -> Result<C, Unfit>) -> Result<(), Unfit> {
        let (tree, tables) = (self.job.bvh, self.job.tables);
        let first = start(Supply { tree, tables, memory: self.first })?;
        let second = self.second.map(|memory| start(Supply { tree, tables, memory })).transpose()?;
        with_level::<C, ANY>(self.level, first, second, self.job);
        Ok(())
    }
}

/// Chooses the instructions.
fn with_level<C: Cursor<8>, const ANY: bool>(level: Level, first: C, second: Option<C>, job: Job<'_, '_>) {
    // Two levels of x86: what SSE4.2 and AVX-512 add is no use here, and each level costs every build of the library
    // its time.
    #[cfg(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2"))]
    match (level.as_avx2(), level.as_sse2().or_else(|| Level::new().as_sse2())) {
        (Some(avx2), _) => avx2.vectorize(
            #[inline(always)]
            || run::<_, C, ANY>(avx2, first, second, job),
        ),
        (None, Some(sse2)) => sse2.vectorize(
            #[inline(always)]
            || run::<_, C, ANY>(sse2, first, second, job),
        ),
        (None, None) => unreachable!("the target has SSE2"),
    }
    #[cfg(not(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2")))]
    fearless_simd::dispatch!(level, simd => run::<_, C, ANY>(simd, first, second, job));
}

type RaySearch<'a, S, const ANY: bool> = WideSearch<'a, S, f32x8<S>, 8, ANY>;

/// Two rays at a time: while one waits for memory, the other computes. The last one alone.
#[inline(always)]
fn run<S: Simd, C: Cursor<8>, const ANY: bool>(simd: S, mut cursor: C, second: Option<C>, job: Job<'_, '_>) {
    let Job { bvh, rays, ask, answer, .. } = job;
    let (Some(ray), others) = (rays.first(), rays.get(1..).unwrap_or_default()) else { return };
    let (mut number, mut search) = (0, RaySearch::<S, ANY>::new(simd, bvh, ray));
    if let (Some(second), Some((ray, rest))) = (second, others.split_first()) {
        let mut numbers = [0, 1];
        let mut cursors = [cursor, second];
        let mut searches = [search, RaySearch::new(simd, bvh, ray)];
        let mut rest = (2..).zip(rest);
        // One turn of ray `$one`; the loop ends with the number of the other one, if no further ray takes its place.
        macro_rules! turn {
            ($asked:ident $one:literal, $other:literal) => {
                if !advance(bvh, &mut cursors[$one], $asked[$one], &mut searches[$one], &mut ()) {
                    answer(numbers[$one], searches[$one].answer(ask));
                    let Some((number, ray)) = rest.next() else { break $other };
                    cursors[$one].reset();
                    (numbers[$one], searches[$one]) = (number, RaySearch::new(simd, bvh, ray));
                }
            };
        }
        let last = loop {
            let asked = [searches[0].ask(cursors[0].node()), searches[1].ask(cursors[1].node())];
            // Written out twice: with a number that varies, both rays' states are in memory, which costs a tenth.
            turn!(asked 0, 1);
            turn!(asked 1, 0);
        };
        number = numbers[last];
        let ([first, second], [of_first, of_second]) = (cursors, searches);
        (cursor, search) = if last == 0 { (first, of_first) } else { (second, of_second) };
    }
    // If it was asked just now, it is asked again.
    finish(bvh, &mut cursor, &mut search);
    answer(number, search.answer(ask));
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
