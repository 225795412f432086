//! Straight-line facts of `stackless-bvh` at full width, proved by Z3.

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
mod trails;
mod word;

use std::process::ExitCode;

use lemma::Lemma;

fn main() -> ExitCode {
    match all() {
        Ok(lemmas) if table(&lemmas) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Prints a row for each lemma. Whether all were proved, and all controls refuted.
fn table(lemmas: &[Lemma]) -> bool {
    println!("| lemma | clauses | bits | result | s | control | s |");
    println!("|---|---|---:|---|---:|---|---:|");
    let passed = lemmas.iter().filter(|lemma| lemma.check()).count();
    println!("{passed} of {} lemmas proved and their controls refuted", lemmas.len());
    passed == lemmas.len()
}

fn all() -> Result<Vec<Lemma>, String> {
    let only = std::env::args().nth(1);
    let words = [of_words::<32>()?, of_words::<64>()?, of_words::<128>()?].into_iter().flatten();
    let lemmas = words.chain(hash::lemmas()?).chain(modulo::lemmas()?);
    Ok(lemmas.filter(|lemma| only.as_ref().is_none_or(|only| lemma.name.contains(only))).collect())
}

fn of_words<const N: u32>() -> Result<Vec<Lemma>, String> {
    let kinds = [keys::lemmas::<N>(), trails::lemmas::<N>(), swaps::lemmas::<N>(), cursors::lemmas::<N>()?];
    Ok(kinds.into_iter().flatten().collect())
}
