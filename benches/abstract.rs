//! Speed of the comparison with the oracle, on one core: the main cost of every random test, fuzzer and `stackless
//! check`.
//!
//! An element is one comparison: one tree of up to 64 nodes, one traversal, one word. The oracle's own run and the
//! tables of the traversals are part of the time, as they are of every check. `cargo bench --bench abstract`

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use stackless_bvh::traverse::{Method, WordName};
use stackless_check::{Case, CaseOptions, Plan, Tally};

/// Enough for the mix of families, sizes and tapes of a long run.
const CASES: u64 = 2000;

fn plan(methods: &[Method], words: &[WordName]) -> Plan {
    Plan { trees: CASES, seed: 1, options: CaseOptions::default(), methods: methods.to_vec(), words: words.to_vec() }
}

/// Returns the number of comparisons. A traversal that differs from its oracle ends the benchmark.
fn compare(plan: &Plan, cases: &[Case]) -> u64 {
    let mut tally = Tally::default();
    for case in cases {
        let found = plan.check_case(case, &mut tally);
        assert!(found.is_none(), "{found:?}");
    }
    tally.comparisons()
}

fn comparisons(criterion: &mut Criterion) {
    let cases: Vec<_> = (0..CASES).map(|seed| Case::random(seed, CaseOptions::default())).collect();
    let mut group = criterion.benchmark_group("comparisons");
    group.sample_size(10).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3));
    let mut measure = |name: &str, plan: &Plan| {
        // Refusals cost almost nothing and are not counted.
        group.throughput(Throughput::Elements(compare(plan, &cases)));
        group.bench_function(name, |bencher| bencher.iter(|| compare(plan, black_box(&cases))));
    };
    measure("all traversals, all words", &plan(&Method::ALL, &WordName::ALL));
    for word in WordName::ALL {
        measure(&format!("all traversals, {word}"), &plan(&Method::ALL, &[word]));
    }
    group.finish();
}

/// The cost of generating the cases, without comparisons.
fn cases(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("cases");
    group.sample_size(10).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(1));
    group.throughput(Throughput::Elements(CASES));
    group.bench_function("drawn", |bencher| {
        bencher.iter(|| (0..CASES).map(|seed| Case::random(seed, CaseOptions::default()).size()).sum::<usize>());
    });
    group.finish();
}

criterion_group!(benches, comparisons, cases);
criterion_main!(benches);
