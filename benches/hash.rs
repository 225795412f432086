//! Construction of the perfect hash from 10^4 to 10^7 keys, on one thread. Constant throughput means linear time.
//!
//! An element is one key. All nodes of uneven trees are hashed, with tight sizes; every table is certified before it is
//! timed. `cargo bench --bench hash`

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use stackless_bvh::generate::{Family, Rng};
use stackless_bvh::hash::{KeySet, Options, PerfectHash, Sizing, certify};
use stackless_bvh::tree::Topology;

fn construction(criterion: &mut Criterion) {
    let options = Options { key_set: KeySet::All, sizing: Sizing::Tight };
    let mut group = criterion.benchmark_group("construction");
    group.sample_size(10).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(2));
    for keys in [10_000, 100_000, 1_000_000, 10_000_000] {
        let tree = Family::Skew.tree(&mut Rng::new(1), keys / 2);
        let hash = PerfectHash::build(&tree, options).expect("a table");
        certify(&hash, &tree, options.key_set).expect("a right table");
        group.throughput(Throughput::Elements(tree.node_count() as u64));
        group.bench_function(BenchmarkId::from_parameter(keys), |bencher| {
            bencher.iter(|| PerfectHash::build(black_box(&tree), options).map(|hash| hash.header().bytes()));
        });
    }
    group.finish();
}

criterion_group!(benches, construction);
criterion_main!(benches);
