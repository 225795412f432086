//! Probes a device's arithmetic, to select the corresponding model on the CPU.

use std::fmt;

use glam::Vec3;
use stackless_bvh::generate::{Rng, Source as _};

use crate::launch::{groups, params};
use crate::{Access, Checks, Gpu, GpuError, Pass};

/// The arithmetic of a device, according to samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(clippy::struct_excessive_bools, reason = "seven questions with yes or no")]
pub struct Arithmetic {
    /// `fma` rounds once; otherwise twice.
    pub fuses: bool,
    /// Differences and products are rounded to nearest.
    pub rounds: bool,
    /// `a * b + c` is contracted to one rounding.
    pub contracts: bool,
    /// Quotients are rounded to nearest.
    pub divides: bool,
    /// Quotients are rounded to nearest after one step with the remainder.
    pub divides_refined: bool,
    /// Results below the least normal number are kept.
    pub keeps_subnormals: bool,
    /// `min(0, -0)` equals a comparison and a select.
    pub min_is_select: bool,
}

impl Arithmetic {
    /// Whether kernels need the step after a division.
    ///
    /// # Errors
    /// [`GpuError::Feature`] if that step is not enough.
    pub fn refines(&self) -> Result<bool, GpuError> {
        match (self.divides, self.divides_refined) {
            (true, _) => Ok(false),
            (false, true) => Ok(true),
            (false, false) => Err(GpuError::Feature("division that can be made exact, so there is no model of it")),
        }
    }

    /// The device's version of a result: 0 if the device flushes it.
    #[inline]
    pub fn kept(&self, x: f32) -> f32 {
        if self.keeps_subnormals || x.abs() >= f32::MIN_POSITIVE || x.is_nan() { x } else { 0.0_f32.copysign(x) }
    }

    /// Multiply-add of the device.
    #[inline]
    pub fn fma(&self, a: f32, b: f32, c: f32) -> f32 {
        self.kept(if self.fuses { a.mul_add(b, c) } else { self.kept(a * b) + c })
    }

    /// `product3` of `arithmetic.wgsl`.
    #[inline]
    pub fn dot(&self, a: Vec3, b: Vec3) -> f32 {
        self.fma(a.x, b.x, self.fma(a.y, b.y, self.kept(a.z * b.z)))
    }

    /// `cross3` of `arithmetic.wgsl`.
    #[inline]
    pub fn cross(&self, a: Vec3, b: Vec3) -> Vec3 {
        let minor = |a0: f32, b1: f32, a1: f32, b0: f32| self.fma(a0, b1, -self.kept(a1 * b0));
        Vec3::new(minor(a.y, b.z, a.z, b.y), minor(a.z, b.x, a.x, b.z), minor(a.x, b.y, a.y, b.x))
    }
}

impl fmt::Display for Arithmetic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let say = |is: bool, yes: &'static str, no: &'static str| if is { yes } else { no };
        write!(
            f,
            "{}, fma {}, a * b + c {}, division {}, subnormal numbers {}, min {}",
            say(self.rounds, "rounds to nearest", "does not round to nearest"),
            say(self.fuses, "rounds once", "rounds twice"),
            say(self.contracts, "is contracted", "is not contracted"),
            match (self.divides, self.divides_refined) {
                (true, _) => "is rounded to nearest",
                (false, true) => "is rounded to nearest after one step",
                (false, false) => "has errors",
            },
            say(self.keeps_subnormals, "are kept", "are flushed"),
            say(self.min_is_select, "is a select", "is not a select"),
        )
    }
}

/// Probes the device.
///
/// # Errors
/// [`GpuError`]; [`GpuError::Feature`] if `fma` is inconsistent.
pub fn probe(gpu: &Gpu) -> Result<Arithmetic, GpuError> {
    let samples = samples();
    let words: Vec<u32> = samples.iter().flatten().map(|x| x.to_bits()).collect();
    let bindings = [Access::Read, Access::Write, Access::Uniform];
    let pipeline = gpu.compile("probe", include_str!("../wgsl/probe.wgsl"), &bindings, Checks::All)?;
    let (inputs, outputs) = (gpu.buffer("samples", &words)?, gpu.zeros("answers", 2 * words.len())?);
    let params = params(gpu, samples.len() as u32)?;
    let groups = groups(samples.len() as u32);
    gpu.run(&[Pass { pipeline: &pipeline, buffers: vec![&inputs, &outputs, &params], groups, clear: Vec::new() }])?;
    let answers = gpu.read(&outputs, 2 * words.len())?;
    let (answers, _) = answers.as_chunks::<8>();
    let all = |column: usize, expected: &dyn Fn([f32; 4]) -> f32| {
        let pairs = samples[..ORDINARY].iter().zip(answers);
        pairs.into_iter().all(|(&sample, answer)| answer[column] == expected(sample).to_bits())
    };
    let once = |[a, b, c, _]: [f32; 4]| a.mul_add(b, c);
    let twice = |[a, b, c, _]: [f32; 4]| a * b + c;
    let quotient = |[a, b, _, _]: [f32; 4]| a / b;
    let fuses = all(0, &once);
    if !fuses && !all(0, &twice) {
        return Err(GpuError::Feature("multiply-add of one kind, so there is no model of it"));
    }
    let [difference, product, zeros] = [ORDINARY, ORDINARY + 1, ORDINARY + 2];
    Ok(Arithmetic {
        fuses,
        rounds: all(4, &|[a, _, c, _]| a - c) && all(5, &|[a, b, _, _]| a * b),
        contracts: !all(1, &twice),
        divides: all(2, &quotient),
        divides_refined: all(3, &quotient),
        keeps_subnormals: answers[difference][4] != 0 && answers[product][5] != 0,
        min_is_select: answers[zeros][6] == answers[zeros][7],
    })
}

const ORDINARY: usize = 1 << 16;

/// Numbers of all signs and magnitudes in scenes, then three special cases.
fn samples() -> Vec<[f32; 4]> {
    let mut rng = Rng::new(7);
    let mut number = || {
        let mantissa = rng.below(1 << 23) as u32;
        let exponent = 127 - 20 + rng.below(40) as u32;
        f32::from_bits((rng.below(2) as u32) << 31 | exponent << 23 | mantissa)
    };
    let mut samples: Vec<[f32; 4]> = (0..ORDINARY).map(|_| [number(), number(), number(), 0.0]).collect();
    // Cancelling sums reveal whether a product was rounded.
    for sample in samples.iter_mut().step_by(4) {
        sample[2] = -(sample[0] * sample[1]);
    }
    let least = f32::MIN_POSITIVE;
    samples.push([1.5 * least, 1.0, least, 0.0]);
    samples.push([f32::exp2(-70.0), f32::exp2(-70.0), 0.0, 0.0]);
    samples.push([0.0, 1.0, -0.0, 0.0]);
    samples
}
