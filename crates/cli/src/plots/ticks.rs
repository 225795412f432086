//! Axes with round numbers at the ends and between them.

/// Round numbers from 0 to at most `end`, with their texts: at most `most` multiples of 1, 2 or 5 times a power of ten.
///
/// ```
/// let ticks = crate::plots::round_ticks(37.0, 5);
/// assert_eq!(ticks.iter().map(|(at, _)| *at).collect::<Vec<_>>(), [0.0, 10.0, 20.0, 30.0]);
/// assert_eq!(ticks[1].1, "10");
/// ```
pub(crate) fn round_ticks(end: f64, most: usize) -> Vec<(f64, String)> {
    let scale = Scale::linear([0.0, end], most);
    scale.ticks.iter().filter(|&&tick| tick <= end).map(|&tick| (tick, plain(tick))).collect()
}

/// The scale of an axis.
#[derive(Clone, Debug)]
pub(super) struct Scale {
    low: f64,
    high: f64,
    is_log: bool,
    pub(super) ticks: Vec<f64>,
    pub(super) format: fn(f64) -> String,
}

impl Scale {
    /// A scale around these numbers, in at most `most` steps of 1, 2 or 5 times a power of ten.
    pub(super) fn linear([low, high]: [f64; 2], most: usize) -> Self {
        let ticks = steps([low, high], most, f64::MIN_POSITIVE);
        let [low, high] = [ticks[0], ticks[ticks.len() - 1]];
        Self { low, high, is_log: false, format: format(&ticks), ticks }
    }

    /// A scale of counts from 0 on, each with a column of width 1.
    pub(super) fn columns(count: usize, most: usize) -> Self {
        let last = count.max(1) as f64 - 1.0;
        let mut ticks = steps([0.0, last], most, 1.0);
        ticks.retain(|&tick| tick <= last);
        Self { low: -0.5, high: last + 0.5, is_log: false, ticks, format: plain }
    }

    /// A logarithmic scale around these positive numbers, in at most `most` steps: 1, 2 and 5 times powers of ten, or
    /// powers of ten, or every second, third, fifth and so on.
    pub(super) fn log([low, high]: [f64; 2], most: usize) -> Self {
        let [low, high] = [low, high].map(|end| end.clamp(1e-300, 1e300));
        let power = |exponent: i32| times_power(1.0, exponent);
        let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
        let fine = (first..=last).flat_map(|exponent| [1.0, 2.0, 5.0].map(|digit| times_power(digit, exponent)));
        let fine: Vec<f64> = fine.collect();
        let from = fine.iter().rposition(|&tick| tick <= low).unwrap_or(0);
        let to = fine.iter().position(|&tick| tick >= high).unwrap_or(fine.len() - 1).max(from + 1);
        let ticks = if to - from <= most {
            fine[from..=to].to_vec()
        } else {
            let stride = (0..).flat_map(|exponent| [1, 2, 3, 5].map(|digit: i32| digit * 10_i32.pow(exponent)));
            let count = |stride: i32| (last.div_euclid(stride) + 1 - first.div_euclid(stride)) as usize;
            let stride = stride.take(12).find(|&stride| count(stride) <= most).unwrap_or(1000);
            let (first, last) = (first.div_euclid(stride), -(-last).div_euclid(stride));
            (first..=last.max(first + 1)).map(|i| power(i * stride)).collect()
        };
        let [low, high] = [ticks[0], ticks[ticks.len() - 1]];
        Self { low, high, is_log: true, format: format(&ticks), ticks }
    }

    /// The position of a number on the axis, from 0 to 1.
    pub(super) fn share(&self, x: f64) -> f64 {
        let of = |x: f64| if self.is_log { x.max(f64::MIN_POSITIVE).log10() } else { x };
        (of(x) - of(self.low)) / (of(self.high) - of(self.low))
    }
}

/// Selects the format of an axis: all numbers have exponents if one number needs an exponent.
fn format(ticks: &[f64]) -> fn(f64) -> String {
    let is_plain = |tick: &f64| *tick == 0.0 || (0.999e-3..1e6).contains(&tick.abs());
    if ticks.iter().all(is_plain) { plain } else { with_exponent }
}

/// Formats with commas between thousands.
fn plain(x: f64) -> String {
    let text = format!("{}", x.abs());
    let (whole, rest) = text.split_at(text.find('.').unwrap_or(text.len()));
    let sign = if x < 0.0 { "-" } else { "" };
    match whole.len() {
        ..=3 => format!("{sign}{whole}{rest}"),
        n => format!("{sign}{},{}{rest}", &whole[..n - 3], &whole[n - 3..]),
    }
}

/// Formats with the exponent after `^`.
fn with_exponent(x: f64) -> String {
    if (1.0..100.0).contains(&x) || x == 0.0 {
        return plain(x);
    }
    let text = format!("{x:e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    if digits == "1" { format!("10^{exponent}") } else { format!("{digits}×10^{exponent}") }
}

/// Multiples of the smallest round step that encloses both numbers in at most `most` steps.
fn steps([low, high]: [f64; 2], most: usize, least: f64) -> Vec<f64> {
    let span = (high - low).abs().max(low.abs().max(high.abs()) * 1e-9).max(1e-300);
    let first = (span / most.max(1) as f64).log10().floor() as i32;
    let candidates = (first..first + 3).flat_map(|exponent| [1.0, 2.0, 5.0].map(|digit| (digit, exponent)));
    let ends = |(digit, exponent): (f64, i32)| {
        let step = times_power(digit, exponent);
        // The tolerance accepts multiples with rounding errors.
        let low = (low / step + 1e-9).floor();
        (low, (high / step - 1e-9).ceil().max(low + 1.0))
    };
    let fits = |step: &(f64, i32)| {
        let (low, high) = ends(*step);
        high - low <= most.max(1) as f64 && times_power(step.0, step.1) >= least
    };
    let step = candidates.clone().find(fits).unwrap_or((1.0, first + 3));
    let (low, high) = ends(step);
    (low as i64..=high as i64).map(|i| times_power(i as f64 * step.0, step.1)).collect()
}

/// Rounds once, because the power of ten is a float.
fn times_power(digits: f64, exponent: i32) -> f64 {
    if (-22..0).contains(&exponent) { digits / 10f64.powi(-exponent) } else { digits * 10f64.powi(exponent) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plots::tests::unit;
    use stackless_bvh::generate::Rng;

    /// The leading digits of a number, without trailing zeros.
    fn digits(x: f64) -> String {
        format!("{x:e}").split('e').next().unwrap().to_owned()
    }

    #[test]
    fn ticks_are_round_and_enclose_what_is_drawn() {
        let mut random = Rng::new(7);
        let mut unit = || unit(&mut random);
        for _ in 0..2000 {
            let (a, b) = (10f64.powf(30.0 * unit() - 20.0), 10f64.powf(30.0 * unit() - 20.0));
            let (low, high) = (a.min(b), a.max(b));
            let most = 2 + (unit() * 9.0) as usize;
            for (scale, low) in [
                (Scale::linear([low, high], most), low),
                (Scale::linear([-high, high], most), -high),
                (Scale::log([low, high], most), low),
            ] {
                let ticks = &scale.ticks;
                assert!((2..=most + 1).contains(&ticks.len()), "{low} {high} {most}: {ticks:?}");
                assert!(ticks[0] <= low * (1.0 - low.signum() * 1e-8) + 1e-300 || ticks[0] <= low, "{low} {ticks:?}");
                assert!(ticks[ticks.len() - 1] >= high * (1.0 - 1e-8), "{high} {ticks:?}");
                if scale.is_log {
                    assert!(ticks.iter().all(|&tick| ["1", "2", "5"].contains(&&*digits(tick))), "{ticks:?}");
                } else {
                    // A step is 1, 2 or 5 times a power of ten, up to the rounding error of the difference.
                    let step = ticks[1] - ticks[0];
                    let mantissa = step / 10f64.powf((step * 1.0001).log10().floor());
                    assert!([1.0, 2.0, 5.0].iter().any(|round| (mantissa - round).abs() < 1e-3), "{ticks:?}");
                    assert!(ticks.iter().all(|&tick| digits(tick).len() < 12), "{ticks:?}");
                }
                assert!(scale.share(scale.ticks[0]).abs() < 1e-12 && (scale.share(high) - 1.0) < 1e-6);
            }
        }
        assert_eq!(Scale::linear([0.97, 1.2], 6).ticks, [0.95, 1.0, 1.05, 1.1, 1.15, 1.2]);
        assert_eq!(Scale::log([3.0, 70.0], 6).ticks, [2.0, 5.0, 10.0, 20.0, 50.0, 100.0]);
        assert_eq!(Scale::columns(13, 8).ticks, [0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0]);
    }

    #[test]
    fn numbers_are_written_as_people_do() {
        assert_eq!([0.0, 0.3, 1.0, -20_000.0, 0.001].map(plain), ["0", "0.3", "1", "-20,000", "0.001"]);
        let texts = |scale: Scale| scale.ticks.iter().map(|&tick| (scale.format)(tick)).collect::<Vec<_>>();
        assert_eq!(texts(Scale::log([1e-6, 1.0], 4)), ["10^-6", "10^-4", "10^-2", "1"]);
        assert_eq!(texts(Scale::linear([0.0, 3e6], 3)), ["0", "10^6", "2×10^6", "3×10^6"]);
        assert_eq!(texts(Scale::log([20.0, 150_000.0], 12))[..3], ["20", "50", "100"]);
    }
}
