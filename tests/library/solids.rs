//! Points inside, outside and on solids with known answers in integers. `[CLOSED-2]` `[WINDING-1]`

use glam::{DVec3, Vec3};
use stackless_bvh::generate::Rng;
use stackless_check::Solids;

#[test]
fn points_are_where_integers_say() {
    let mut counts = [0; 3];
    for seed in 0..4_000 {
        let solids = Solids::draw(&mut Rng::new(seed), 6);
        for found in [solids.check::<Vec3>(), solids.check::<DVec3>()] {
            let found = found.unwrap_or_else(|fault| panic!("seed {seed}: {fault}\n{solids:?}"));
            counts = [0, 1, 2].map(|i| counts[i] + found[i]);
        }
    }
    assert!(counts.iter().all(|&count| count > 5_000), "inside, on the surface, outside: {counts:?}");
}
