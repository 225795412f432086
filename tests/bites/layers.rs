//! Mistakes below the traversals: each is seen by the property body of its layer.

use std::fmt::Write as _;

use stackless_bvh::check::planted::{LAYERS, Layer, Mistake};
use stackless_bvh::generate::Rng;

/// Inputs that are drawn for each mistake: more where they are cheap, and where a mistake shows in few.
fn draws(layer: &Layer) -> u64 {
    match layer.name {
        "triangle tests" | "box tests" => 6000,
        "tables" | "lookups" => 500,
        _ => 800,
    }
}

/// How often the body sees the mistake, and first in which draw.
fn seen(mistake: &Mistake, draws: u64) -> (usize, Option<u64>) {
    let caught: Vec<_> = (0..draws).filter(|&seed| mistake.fault(&mut Rng::new(seed)).is_some()).collect();
    (caught.len(), caught.first().copied())
}

/// A part of `tests/PLANTED.md` for each layer.
pub(crate) fn tables() -> String {
    let mut text = String::new();
    for layer in &LAYERS {
        let draws = draws(layer);
        for control in layer.controls {
            assert_eq!(seen(control, draws), (0, None), "{control:?}");
        }
        writeln!(
            text,
            "\n## {}\n\nSeen by `{}` in how many of {draws} random draws, and first in which.\n",
            capital(layer.name),
            layer.body
        )
        .unwrap();
        text += "| mistake | breaks | draws | first |\n|---|---|---:|---:|\n";
        for mistake in layer.mistakes {
            let (count, first) = seen(mistake, draws);
            let Some(first) = first else { panic!("{mistake:?}: not seen in {draws} draws") };
            writeln!(text, "| {} | {} | {count} | {first} |", mistake.name(), mistake.clause()).unwrap();
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

#[test]
fn names_are_unique() {
    let mut names: Vec<_> =
        LAYERS.iter().flat_map(|layer| layer.mistakes.iter().chain(layer.controls)).map(Mistake::name).collect();
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count);
}
