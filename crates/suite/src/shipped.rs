//! The suite's files, included in this crate. Reading them takes a tenth of the time of generating the cases.

use std::io;

use super::{Suite, SuiteError};

macro_rules! texts {
    ($($file:literal)*) => {
        [$(($file, include_str!(concat!("../", $file)))),*]
    };
}

/// Paths and texts.
static TEXTS: [(&str, &str); 36] = texts! {
    "index.json"
    "vectors/key/u128.json"
    "vectors/key/u32.json"
    "vectors/key/u64.json"
    "vectors/key/wide.json"
    "vectors/hash/address.json"
    "vectors/hash/build.json"
    "vectors/hash/build-deep.json"
    "vectors/hash/fold.json"
    "vectors/hash/function.json"
    "vectors/hash/keys.json"
    "vectors/hash/lookup.json"
    "vectors/hash/wide.json"
    "vectors/hash/wide-deep.json"
    "vectors/trace/complete.json"
    "vectors/trace/disjoint.json"
    "vectors/trace/distance.json"
    "vectors/trace/invalid.json"
    "vectors/trace/node-left.json"
    "vectors/trace/node-sign.json"
    "vectors/trace/script.json"
    "vectors/trace/tape.json"
    "vectors/trace/wide.json"
    "vectors/trace/wide-invalid.json"
    "vectors/resume/disjoint.json"
    "vectors/resume/invalid.json"
    "vectors/resume/key-only.json"
    "vectors/resume/state.json"
    "vectors/resume/wide.json"
    "vectors/ray/exact.json"
    "vectors/ray/grid.json"
    "vectors/ray/invalid.json"
    "vectors/ray/parity.json"
    "vectors/ray/ulp-256.json"
    "vectors/ray/ulp-8.json"
    "vectors/ray/watertight.json"
};

impl Suite {
    /// Reads the cases of the files in `spec/suite`, which this crate includes. They equal those of
    /// [`author::suite`](super::author::suite).
    ///
    /// # Errors
    /// None in a released crate: a test reads the files.
    pub fn shipped() -> Result<Self, SuiteError> {
        Self::read(|file| {
            let text = TEXTS.iter().find(|(path, _)| *path == file);
            text.map(|(_, text)| (*text).to_owned()).ok_or_else(|| io::ErrorKind::NotFound.into())
        })
    }
}
