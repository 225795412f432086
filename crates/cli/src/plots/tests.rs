//! Properties of every chart with any data: texts neither overlap nor leave the chart.

use stackless_bvh::generate::Rng;

use super::canvas::Canvas;
use super::labels::Rect;
use super::*;
use super::{campaign, distances, pareto};

/// A random number in [0, 1).
pub(super) fn unit(random: &mut Rng) -> f64 {
    (random.bits() >> 11) as f64 / (1_u64 << 53) as f64
}

fn look(canvas: &Canvas, size: (f64, f64), what: &str) {
    let paper = Rect { x: 0.0, y: 0.0, width: size.0, height: size.1 };
    for (i, text) in canvas.texts.iter().enumerate() {
        assert!(paper.contains(text), "{what}, {size:?}: {text:?}");
        assert!(!canvas.texts[..i].iter().any(|other| other.overlaps(text)), "{what}, {size:?}: {text:?}");
    }
}

#[test]
fn texts_keep_apart_in_every_chart_at_every_size() {
    let mut random = Rng::new(5);
    let mut unit = || unit(&mut random);
    for size in [(340.0, 420.0), (480.0, 480.0), (800.0, 520.0), (960.0, 1100.0), (1800.0, 1200.0)] {
        for round in 0..40_u32 {
            let parts: Vec<_> = (0..round)
                .map(|_| Stretch {
                    seconds: 10f64.powf(7.0 * unit() - 2.0),
                    cases: 10f64.powf(9.0 * unit()) as u64,
                    errors: u64::from(unit() < 0.1),
                })
                .collect();
            look(&campaign::draw(size, "stackless check", &parts), size, "campaign");
            let shares: Vec<_> = (0..round * 3 / 2).map(|_| unit() / f64::from(round + 1)).collect();
            look(&distances::draw(size, "Backtracking distance, crytek_sponza", &shares), size, "distances");
            let choices: Vec<_> = (0..round)
                .map(|i| Choice {
                    label: ["plain", "two-sided", "directed"][i as usize % 3].to_owned(),
                    family: format!("kernel-{}", i / 3 % 7),
                    cost: 0.9 + 0.2 * unit() * unit() * unit(),
                    errors: Errors::of((unit() * unit() * 5e6) as u64 * u64::from(unit() < 0.7), 100_000_000),
                })
                .collect();
            let charts: [(&str, &[Choice]); 2] = [("ordinary rays", &choices), ("adversarial rays", &choices)];
            // Two charts, and a legend of up to nine rows.
            let size = (size.0, size.1 + 500.0);
            look(&pareto::draw(size, &charts, "time, in units of moller-32 with plain boxes"), size, "pareto");
        }
    }
}

/// If all labels have room, all labels are placed.
#[test]
fn no_label_is_lost_at_the_size_that_is_written() {
    let choices: Vec<_> = (0..18)
        .map(|i| Choice {
            label: "two-sided".to_owned(),
            family: format!("kernel-{}", i / 3),
            cost: 1.0 + f64::from(i % 3) * 0.002,
            errors: Errors::of(0, 1_000_000),
        })
        .collect();
    let svg = plot_pareto(&[("all at one place", &choices)], "time");
    assert_eq!(svg.matches(">two-sided</text>").count(), 18);
    assert!(!svg.contains("plotters") && svg.contains("prefers-color-scheme:dark"));
}
