//! Mistakes below the traversals and in those of wide trees: each is seen by the property body of its layer.

use std::fmt::Write as _;

use stackless_bvh::generate::Rng;
use stackless_check::planted::{LAYERS, Layer, Mistake};

/// Inputs that are drawn for each mistake: more where they are cheap, and where a mistake shows in few.
fn draws(layer: &Layer) -> u64 {
    match layer.name {
        "triangle tests" | "box tests" | "smaller bounds" | "double precision" => 6000,
        "tables" | "lookups" => 500,
        "wide traversals" => 2000,
        _ => 800,
    }
}

/// How often the body sees the mistake, and first in which draw.
fn seen(mistake: &Mistake, draws: u64) -> (usize, Option<u64>) {
    let caught: Vec<_> = (0..draws).filter(|&seed| mistake.fault(&mut Rng::new(seed)).is_some()).collect();
    (caught.len(), caught.first().copied())
}

/// Why the layer has no harness.
fn without_harness(layer: &Layer) -> &'static str {
    match layer.name {
        "tables" | "lookups" => {
            "No harness has tables: what is proved of them by SMT, for all keys, has slips of its own that are refuted."
        }
        "wide traversals" => "No harness has wide trees: of their words `wide` has all, with a twin each.",
        _ => "No harness has geometry, which needs `std`: the way to CBMC does not build that.",
    }
}

/// A part of `tests/PLANTED.md` for each layer.
pub(crate) fn tables() -> String {
    let mut text = String::new();
    for layer in &LAYERS {
        let draws = draws(layer);
        for control in layer.controls {
            assert_eq!(seen(control, draws), (0, None), "{control:?}");
        }
        let (name, body, harness) = (capital(layer.name), layer.body, without_harness(layer));
        writeln!(text, "\n## {name}\n\nThe battery is `{body}` over {draws} random draws. {harness}\n").unwrap();
        text += &super::heading(false);
        for mistake in layer.mistakes {
            let (count, first) = seen(mistake, draws);
            let Some(first) = first else { panic!("{mistake:?}: not seen in {draws} draws") };
            let battery = format!("{count} from {first}");
            text += &super::row(&format!("{}: ", layer.name), mistake.name(), mistake.clause(), &battery, false);
        }
    }
    let count: usize = LAYERS.iter().map(|layer| layer.mistakes.len()).sum();
    writeln!(text, "\n{count} mistakes.").unwrap();
    text
}

fn capital(name: &str) -> String {
    let (first, rest) = name.split_at(1);
    first.to_uppercase() + rest
}
