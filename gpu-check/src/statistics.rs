//! Medians and their noise.

use stackless_bvh::generate::{Rng, Source as _};

/// The median; 0 without values.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    match sorted.len() {
        0 => 0.0,
        odd if odd % 2 == 1 => sorted[middle],
        _ => f64::midpoint(sorted[middle - 1], sorted[middle]),
    }
}

/// The median absolute deviation from the median.
pub fn deviation(values: &[f64]) -> f64 {
    let middle = median(values);
    median(&values.iter().map(|value| (value - middle).abs()).collect::<Vec<_>>())
}

/// The median of the ratios `above[i] / below[i]`, with its 95 % interval by 1,000 bootstrap resamplings.
pub fn ratio(above: &[f64], below: &[f64]) -> [f64; 3] {
    const RESAMPLINGS: usize = 1000;
    let ratios: Vec<f64> = above.iter().zip(below).map(|(a, b)| a / b).collect();
    if ratios.is_empty() {
        return [0.0; 3];
    }
    let mut rng = Rng::new(1);
    let mut draw = || ratios[rng.below(ratios.len() as u64) as usize];
    let mut medians: Vec<f64> =
        (0..RESAMPLINGS).map(|_| median(&(0..ratios.len()).map(|_| draw()).collect::<Vec<_>>())).collect();
    medians.sort_by(f64::total_cmp);
    [median(&ratios), medians[RESAMPLINGS / 40], medians[RESAMPLINGS - 1 - RESAMPLINGS / 40]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_few_and_many() {
        assert_eq!([median(&[]), median(&[3.0]), median(&[4.0, 1.0]), median(&[9.0, 1.0, 2.0])], [0.0, 3.0, 2.5, 2.0]);
        assert_eq!(deviation(&[1.0, 2.0, 3.0, 10.0, 2.0]), 1.0);
        let below: Vec<f64> = (1..50).map(f64::from).collect();
        let above: Vec<f64> = below.iter().map(|x| 2.0 * x).collect();
        assert_eq!(ratio(&above, &below), [2.0; 3]);
        let [middle, low, high] = ratio(&below, &above.iter().rev().copied().collect::<Vec<_>>());
        assert!(low < middle && middle < high);
    }
}
