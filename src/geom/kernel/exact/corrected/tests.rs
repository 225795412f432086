use super::super::filter::Determinants;
use super::*;
use crate::generate::{Rng, Source as _};
use crate::geom::truth::{self, Point};

/// Rays through triangles, with numbers of all digits.
fn aimed(rng: &mut Rng) -> ([DVec3; 3], DVec3, DVec3) {
    let mut number =
        || (rng.below(1 << 53) as f64 / (1_u64 << 52) as f64 - 1.0) * power_of_two(rng.below(8) as i32 - 4);
    let [a, b, c, o] = [(); 4].map(|()| DVec3::new(number(), number(), number()));
    let [x, y] = [number(), number()].map(|x| x.abs().min(0.49));
    let d = (a + (b - a) * x + (c - a) * y - o) * number();
    ([a, b, c], o, d)
}

/// [EXACT-14]
///
/// Each answer is that of rationals, and nearly all are known.
#[test]
fn corrected_quotients_are_those_of_rationals() {
    let mut rng = Rng::new(14);
    let (mut asked, mut told) = (0, 0);
    for _ in 0..20_000 {
        let (corners, o, d) = aimed(&mut rng);
        let (found, errors) = (Determinants::of(&corners, o, d), Errors::of_triangle(&corners, o, d));
        if !found.is_hit(&errors) {
            continue;
        }
        let meeting = truth::meet(corners.map(|v| v.to_array()), o.to_array(), d.to_array());
        let Some(Point { t, u, v, .. }) = meeting.within([f64::MIN, f64::MAX]) else { panic!("{corners:?} {o} {d}") };
        asked += 1;
        for hit in [Corrected::of::<false>(&corners, o, d), Corrected::of::<true>(&corners, o, d)] {
            let weights = [&u, &v].map(truth::round_f64);
            assert!(hit.t.is_none_or(|found| found == truth::round_f64(&t)), "{corners:?} {o} {d}");
            assert!(hit.weights.is_none_or(|found| found == weights), "{corners:?} {o} {d}");
            told += u32::from(hit.t.is_some()) + u32::from(hit.weights.is_some());
        }
    }
    assert!(asked > 10_000 && 4 * asked - told < asked / 500, "{told} of {asked}");
}
