//! Random rays and triangles, ordinary and difficult.

use stackless_bvh::generate::{Rng, Source};

use super::filter::Input;

/// Families of inputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Family {
    /// Uniform in a cube.
    Uniform,
    /// All magnitudes just above one, which rounds worst, with a small common offset.
    Corner,
    /// Small integers: many exact zeros.
    Lattice,
    /// Aimed at a point of an edge or at a corner, so that an edge function cancels.
    Aimed,
    /// Numbers with independent exponents, and some zeros.
    Wild,
    /// Different scales: a tiny triangle near a tiny origin, or far from a large one.
    Scaled,
}

impl Family {
    /// All families.
    pub(crate) const ALL: [Self; 6] =
        [Self::Uniform, Self::Corner, Self::Lattice, Self::Aimed, Self::Wild, Self::Scaled];
}

/// Numbers of magnitude `2^low` to `2^high`, as f64 with 53 random bits.
pub(crate) fn draw(rng: &mut Rng, family: Family, [low, high]: [i32; 2]) -> Input<f64> {
    let mut input = [[0.0; 3]; 5];
    match family {
        Family::Uniform | Family::Aimed => fill(&mut input, || 2.0 * unit(rng) - 1.0),
        Family::Corner => {
            let (tiny, offset) = (power(rng, -30, -8), power(rng, -32, -1));
            fill(&mut input, || sign(rng) * (1.0 + unit(rng) * tiny));
            let v0: [f64; 3] = std::array::from_fn(|_| sign(rng) * unit(rng) * offset);
            for row in [0, 3, 4] {
                input[row] = std::array::from_fn(|k| input[row][k] + v0[k]);
            }
            input[2] = v0;
        }
        Family::Lattice => fill(&mut input, || rng.below(9) as f64 - 4.0),
        Family::Wild => fill(&mut input, || wild(rng, [low, high])),
        Family::Scaled => {
            let (whole, part) = (power(rng, low / 2, high / 2), power(rng, -30, 0));
            fill(&mut input, || (2.0 * unit(rng) - 1.0) * whole);
            for row in [3, 4] {
                input[row] = std::array::from_fn(|k| input[2][k] + (input[row][k] - input[2][k]) * part);
            }
        }
    }
    if matches!(family, Family::Aimed) || family != Family::Wild && rng.below(4) == 0 {
        let weight = [0.0, 1.0, unit(rng)][rng.below(3) as usize];
        let edge = rng.below(3) as usize;
        let (a, b) = (input[2 + edge], input[2 + (edge + 1) % 3]);
        input[1] = std::array::from_fn(|k| a[k] + (b[k] - a[k]) * weight - input[0][k]);
    }
    input
}

/// Draws zero, or a number of magnitude `2^low` to `2^high`.
pub(crate) fn wild(rng: &mut Rng, [low, high]: [i32; 2]) -> f64 {
    if rng.below(12) == 0 { 0.0 } else { sign(rng) * (1.0 + unit(rng)) * power(rng, low, high - 1) }
}

/// Draws a number from 0 to 1.
pub(crate) fn unit(rng: &mut Rng) -> f64 {
    (rng.bits() >> 11) as f64 / (1_u64 << 53) as f64
}

/// Draws a sign.
pub(crate) fn sign(rng: &mut Rng) -> f64 {
    if rng.coin() { -1.0 } else { 1.0 }
}

/// Draws a power of two.
pub(crate) fn power(rng: &mut Rng, low: i32, high: i32) -> f64 {
    2_f64.powi(low + rng.below((high - low + 1) as u64) as i32)
}

fn fill(input: &mut Input<f64>, mut number: impl FnMut() -> f64) {
    for x in input.as_flattened_mut() {
        *x = number();
    }
}
