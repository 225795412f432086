use super::*;
use stackless_bvh::trace::RayQueries;

/// Tests families that are fast without optimisation.
#[test]
fn families_have_queries_of_both_kinds_and_a_price() {
    let quick: Vec<_> = FAMILIES
        .into_iter()
        .filter(|family| family.name.ends_with(" an edge") || family.name.starts_with("an "))
        .collect();
    assert_eq!(quick.len(), 2);
    let prices = prices_of(&quick, Duration::from_millis(50)).expect("scenes");
    assert!(prices.iter().all(|price| price.ordinary > 0.0 && 0.0 < price.dearest && price.dearest <= price.found));
    let [Block::Line(line), Block::Table(table), ..] = &blocks(&prices)[..] else { panic!("a line and a table") };
    assert!(line.contains(&format!("of {} families", quick.len())));
    assert_eq!(table.rows.len(), quick.len());
}

#[test]
fn hard_rays_are_hard() {
    let mesh = lattice(64, 1).expect("a mesh");
    let tracer = Tracer::of(&mesh).expect("a tree");
    assert!(in_plane().iter().all(|ray| tracer.closest(ray).is_none()));
    let mesh = lattice(32, 16).expect("a mesh");
    let tracer = Tracer::of(&mesh).expect("a tree");
    assert!(at_vertices().iter().all(|ray| tracer.all(ray).iter().any(|hit| hit.t == 1.0)));
    let mesh = coincident(10).expect("a mesh");
    let tracer = Tracer::of(&mesh).expect("a tree");
    for rays in [at_edge(), inside()] {
        assert!(rays.iter().all(|ray| tracer.all(ray).len() == 10), "all of them are met");
    }
}
