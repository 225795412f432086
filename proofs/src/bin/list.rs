//! Lists the harnesses for scripts, one per line, with tabs between the fields: name, twin, unwind, unwind of nested
//! loops, frequency, covers as `number:name` with semicolons between them, and the claim.

use proofs::{ALL, Cases, Drawn, Harness, id};
use stackless_bvh::generate::Rng;

/// Cases after which every cover has been named, whether reached or not.
const CASES: u32 = 20_000;

fn main() {
    for harness in ALL.into_iter().flatten() {
        let mut drawn = Drawn::new(Cases::Some(Rng::new(0)));
        for _ in 0..CASES {
            let _ = (harness.body)(&mut drawn);
        }
        let covers: Vec<_> = drawn.covers.keys().map(|name| format!("{}:{name}", id(name))).collect();
        assert!(!covers.is_empty(), "{}: no case was as assumed", harness.name);
        let Harness { name, twin, unwind, nested, often, claim, .. } = harness;
        let nested = nested.unwrap_or(*unwind);
        println!("{name}\t{twin}\t{unwind}\t{nested}\t{often}\t{}\t{}", covers.join(";"), claim.trim());
    }
}
