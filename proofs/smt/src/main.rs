//! Straight-line facts of `stackless-bvh` at full width, proved by Z3: `cargo run [PART OF A NAME]`.
//!
//! The functions of `key`, `trail` and `swap` are generic over [`Word`](stackless_bvh::key::Word), and run here in
//! compiled form on words of unknown bits. The functions of the hash and the steps of the counting traversals are read
//! from the library's files and interpreted.
//!
//! A lemma is proved if its negation has no model. It includes the claims that no shift is out of range and no addition
//! overflows. Its control is the lemma about functions with a slip, under equal assumptions. The counterexample to the
//! control shows that the lemma can fail and that the assumptions are satisfiable.
//!
//! Z3, the operations of a symbolic word and the interpreter are trusted. The tests compare the operations and the
//! interpreter with the compiled library on numbers. Loops are covered by their induction step.

mod cursors;
mod formulas;
mod hash;
mod keys;
mod lemma;
mod machine;
mod modulo;
mod numbers;
mod source;
mod swaps;
#[cfg(test)]
mod tests;
mod trails;
mod wide;
mod word;

use std::process::ExitCode;

use lemma::Lemma;

fn main() -> ExitCode {
    let part = std::env::args().nth(1).unwrap_or_default();
    let passed = all().map(|lemmas| table(lemmas.into_iter().filter(|lemma| lemma.name.contains(&part))));
    match passed {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Prints a row for each lemma. Returns whether there are lemmas, all are proved, and all controls are refuted.
fn table(lemmas: impl Iterator<Item = Lemma>) -> bool {
    println!("| lemma | clauses | bits | result | s | control | s |");
    println!("|---|---|---:|---|---:|---|---:|");
    let (passed, failed): (Vec<_>, Vec<_>) = lemmas.map(|lemma| lemma.check()).partition(|passed| *passed);
    let all = passed.len() + failed.len();
    println!("{} of {all} lemmas proved and their controls refuted", passed.len());
    all > 0 && failed.is_empty()
}

/// Returns all lemmas.
fn all() -> Result<Vec<Lemma>, String> {
    let words = [of_words::<32>()?, of_words::<64>()?, of_words::<128>()?].into_iter().flatten();
    Ok(words.chain(hash::lemmas()?).chain(modulo::lemmas()?).collect())
}

/// Returns the lemmas about words of `N` bits.
fn of_words<const N: u32>() -> Result<Vec<Lemma>, String> {
    let kinds = [
        keys::lemmas::<N>(),
        trails::lemmas::<N>(),
        wide::lemmas::<N>(),
        swaps::lemmas::<N>(),
        cursors::lemmas::<N>()?,
    ];
    Ok(kinds.into_iter().flatten().collect())
}
