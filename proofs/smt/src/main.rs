//! Straight-line facts of `stackless-bvh` at full width, proved by Z3.

mod formulas;
mod keys;
mod lemma;
mod swaps;
mod trails;
mod word;

use std::process::ExitCode;

use lemma::Lemma;

fn main() -> ExitCode {
    println!("| lemma | clauses | bits | result | s | control | s |");
    println!("|---|---|---:|---|---:|---|---:|");
    let lemmas = [of_words::<32>(), of_words::<64>(), of_words::<128>()].into_iter().flatten();
    let (mut passed, mut failed) = (0_u32, 0_u32);
    for lemma in lemmas {
        *if lemma.check() { &mut passed } else { &mut failed } += 1;
    }
    println!("{passed} lemmas proved and their controls refuted, {failed} failed");
    if failed == 0 && passed > 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn of_words<const N: u32>() -> Vec<Lemma> {
    [keys::lemmas::<N>(), trails::lemmas::<N>(), swaps::lemmas::<N>()].into_iter().flatten().collect()
}
