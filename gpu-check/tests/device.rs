//! The checks of the command, on the available device. Without a device the tests fail, because nothing is checked.

use glam::Vec3;
use gpu_check::bench::{self, Setting};
use gpu_check::kernel::{Kernel, Table};
use gpu_check::made::{self, Made};
use gpu_check::planted::ShownBy;
use gpu_check::rays::Models;
use gpu_check::scene::{self, Query, Scene};
use gpu_check::summary::Summary;
use gpu_check::tapes::wide::{self, WideBatch};
use gpu_check::tapes::{Batch, Searches as _, cases, compare, unchanged};
use gpu_check::{Access, Checks, Gpu, GpuError, exact, planted, probe, rays, tables};
use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::generate::{Exhaustive, Family, Rng, procedural};
use stackless_bvh::geom::{Mesh, Ray};
use stackless_bvh::hash::{KeySet, Options, PerfectHash, Sizing};
use stackless_bvh::internals::trace::bounce;
use stackless_bvh::trace::{BinaryTracer, RayQueries};
use stackless_bvh::tree::Topology as _;

fn gpu() -> Gpu {
    Gpu::open(None).unwrap()
}

#[test]
fn every_kernel_has_the_events_of_the_oracle() {
    let gpu = gpu();
    let batch = Batch::new(&gpu, cases(2048, 1)).unwrap();
    for depth in [31, 32, 62, 63, 64] {
        assert!((0..batch.searches()).filter(|&i| batch.depth(i) == depth).count() >= 20, "{depth}");
    }
    for kernel in (1..=3).flat_map(Kernel::all) {
        let report = compare(&gpu, &batch, &kernel, &unchanged).unwrap();
        assert!(report.compared >= 3000, "{report:?}");
        assert_eq!(report.mismatches, 0, "{}: {}", report.name, report.first.unwrap());
    }
}

fn wide_batch(gpu: &Gpu, count: usize) -> WideBatch {
    WideBatch::new(gpu, wide::cases(count, 1)).unwrap()
}

/// [WIDE-3] [WIDE-4] [WIDE-6] [WIDE-7] [WIDE-14] [WIDE-15] [WIDE-17] [WIDE-18] [WSTACK-1] [WTRAIL-1] [WRECORD-1]
/// [WHASHED-1]
#[test]
fn wide_kernels_have_the_events_of_the_oracle() {
    let gpu = gpu();
    let batch = wide_batch(&gpu, 1024);
    let searches = || 0..batch.searches();
    let limits = [
        ("wide-stack", u32::MAX),
        ("wide-trail", 4),
        ("wide-trail/64", 8),
        ("wide-trail/128", 16),
        ("wide-record", 32),
        ("wide-hashed/64", 21),
    ];
    assert_eq!(Kernel::wide().iter().map(Kernel::full_name).collect::<Vec<_>>(), limits.map(|(name, _)| name));
    for (kernel, (name, limit)) in Kernel::wide().iter().zip(limits) {
        let above = searches().filter(|&i| batch.depth(i) > limit).count();
        for level in [limit, limit.saturating_add(1)].into_iter().filter(|&level| level < u32::MAX) {
            assert!(searches().filter(|&i| batch.depth(i) == level).count() >= 20, "{name}: {level}");
        }
        let report = compare(&gpu, &batch, kernel, &unchanged).unwrap();
        assert_eq!((report.too_deep, report.compared), (above, batch.searches() - above), "{name}");
        assert_eq!(report.mismatches, 0, "{name}: {}", report.first.unwrap());
        let visits: usize = searches().filter(|&i| batch.depth(i) <= limit).map(|i| batch.visits(i)).sum();
        assert!(report.visits == visits && visits > 6 * report.compared, "{report:?}");
    }
}

/// With invalid links, every kernel still terminates, and its visits differ from those of the oracle.
#[test]
fn wide_kernels_end_on_any_links() {
    let gpu = gpu();
    let batch = wide_batch(&gpu, 64);
    let child = "return nodes[address + (slot >> 2u)][slot & 3u];";
    let ancestor = "return nodes[address + 2u + ((up - 1u) >> 2u)][(up - 1u) & 3u];";
    for kernel in Kernel::wide() {
        for (from, to) in [
            (child, "return root;"),
            (child, "return address;"),
            (child, "return nodes[address * 77u + slot].x ^ 0x5eed0123u;"),
            (ancestor, "return address;"),
            (ancestor, "return 0x7ffffff0u - address;"),
        ] {
            // Some kernels do not find ancestors by the record.
            let is_read = from == child || ["wide-trail", "wide-record"].contains(&kernel.name);
            let report = compare(&gpu, &batch, &kernel, &|text| text.replace(from, to)).unwrap();
            assert_eq!(report.mismatches > 0, is_read, "{}: {to}", report.name);
        }
    }
}

#[test]
#[ignore = "takes minutes; `.ci/run planted` runs it weekly"]
fn planted_bugs_are_caught() {
    let gpu = gpu();
    let batches = (Batch::new(&gpu, cases(1024, 1)).unwrap(), wide_batch(&gpu, 1024));
    let missed = planted::shown_by(ShownBy::Tapes).filter(|bug| planted::hunt(&gpu, &batches, bug).unwrap() == 0);
    let missed_by_rays = planted::shown_by(ShownBy::Rays).filter(|bug| planted::hunt_rays(&gpu, bug).unwrap() == 0);
    let missed: Vec<_> = missed.chain(missed_by_rays).map(|bug| (&bug.kernel, &bug.name)).collect();
    assert_eq!(missed, []);
}

/// [WIDE-14]
#[test]
fn a_kernel_for_which_a_hierarchy_is_too_deep_is_not_launched() {
    let gpu = gpu();
    let mesh = procedural::strands(1, 400);
    let (bvh, rays) = (Bvh::sah(&mesh, SahOptions::default()).unwrap(), made::view(&mesh, 64, 1));
    let query = Query::single(&probe::probe(&gpu).unwrap(), &rays, false).unwrap();
    let two = Scene::new(&gpu, &bvh).unwrap();
    let both = Scene::new(&gpu, &bvh).unwrap().with_eight(&gpu, scene::hierarchy(&mesh).unwrap()).unwrap();
    let levels = both.eight().unwrap().levels();
    assert!((5..=8).contains(&levels), "{levels}");
    for kernel in Kernel::wide() {
        let trace = |scene| rays::trace(&gpu, scene, &kernel, query, &rays, &unchanged);
        let refused = trace(&two).unwrap_err().to_string();
        assert!(refused.contains("no hierarchy of eight children"), "{refused}");
        let is_refused = kernel.depth_limit().is_some_and(|limit| limit < levels);
        assert_eq!(is_refused, kernel.full_name() == "wide-trail", "{kernel:?}");
        let expected = format!("wide-trail: the hierarchy is {levels} deep, and its words carry 4");
        assert_eq!(trace(&both).err().map(|error| error.to_string()), is_refused.then_some(expected));
    }
}

/// A corner at -0 has the bits of the word that ends leaves.
#[test]
fn zeros_of_either_sign_are_coordinates() {
    let gpu = gpu();
    let arithmetic = probe::probe(&gpu).unwrap();
    let soup = Made::Soup.mesh(5).unwrap();
    let mirrored = Mesh::new(soup.vertices().iter().map(|v| -*v).collect(), soup.triangles().to_vec()).unwrap();
    assert!(mirrored.vertices().iter().any(|v| v.x.to_bits() == 1 << 31));
    let bvh = Bvh::sah(&mirrored, SahOptions { max_leaf: 8, ..SahOptions::default() }).unwrap();
    let (scene, rays) = (Scene::new(&gpu, &bvh).unwrap(), made::rays(&mirrored, 3000, 5));
    let query = Query::single(&arithmetic, &rays, false).unwrap();
    for kernel in Kernel::all(1) {
        let found = rays::trace(&gpu, &scene, &kernel, query, &rays, &unchanged).unwrap();
        let errors = rays::errors(&found, &BinaryTracer::new(&bvh).closest_parallel(&rays).unwrap(), false);
        assert_eq!(errors, rays::Errors::default(), "{}", kernel.full_name());
    }
}

#[test]
fn a_mismatch_is_shown_event_by_event() {
    let gpu = gpu();
    let batch = Batch::new(&gpu, cases(64, 1)).unwrap();
    let bug = |text: String| text.replace("stack[at] = word;", "stack[at] = word + 4u;");
    let report = compare(&gpu, &batch, &Kernel::all(1)[0], &bug).unwrap();
    let text = report.first.unwrap().to_string();
    assert!(text.contains("visit ") && text.contains("expected ") && text.contains("tape "), "{text}");

    let wide = Kernel::wide()[4];
    let bug = |text: String| text.replace("firstLeadingBit(summary)", "firstTrailingBit(summary)");
    let text = compare(&gpu, &wide_batch(&gpu, 64), &wide, &bug).unwrap().first.unwrap().to_string();
    assert!(text.contains("wide ") && text.contains("expected backtrack ") && text.contains("(end, leaves)"), "{text}");
}

/// Two searches for each of three scenes, 20,000 rays in total, by every kernel of one and two words and every kernel
/// of eight children. [WIDE-2] [WIDE-3] [WIDE-6]
#[test]
fn hits_are_those_of_the_model_and_of_rational_arithmetic() {
    let gpu = gpu();
    let arithmetic = probe::probe(&gpu).unwrap();
    for made in Made::ALL {
        let mesh = made.mesh(1).unwrap();
        let bvh = Bvh::sah(&mesh, SahOptions::default()).unwrap();
        let rays = made::rays(&mesh, 6700, 2);
        let eight = scene::hierarchy(&mesh).unwrap();
        let on_device = Scene::new(&gpu, &bvh).unwrap().with_eight(&gpu, eight).unwrap();
        let tracer = BinaryTracer::new(&bvh);
        let truth = tracer.closest_parallel(&rays).unwrap();
        let hits = truth.iter().flatten().count();
        assert!((1000..6600).contains(&hits), "{hits}");
        for any in [false, true] {
            let query = Query::single(&arithmetic, &rays, any).unwrap();
            let mut models = Models::new(&arithmetic, (&bvh, on_device.eight()), &rays, any);
            for kernel in (1..=2).flat_map(Kernel::all).chain(Kernel::wide()) {
                let name = format!("{} {} {any}", made.name(), kernel.full_name());
                let found = rays::trace(&gpu, &on_device, &kernel, query, &rays, &unchanged).unwrap();
                let report = rays::compare(&kernel, &found, models.of(&kernel).unwrap(), any, &rays);
                assert_eq!(report.mismatches, 0, "{name}: {}", report.first.unwrap());
                let errors = rays::errors(&found, &truth, any);
                assert_eq!(errors, rays::Errors::default(), "{name}");
            }
        }
    }
}

/// No float arithmetic is exact on these coordinates. Answers equal those of the exact tracer, and without the bounds
/// they differ. [BAND-2] [BAND-3] [BAND-4] [BAND-5] [BAND-6]
#[test]
fn certain_and_settled_hits_are_exact() {
    let gpu = gpu();
    let arithmetic = probe::probe(&gpu).unwrap();
    let terrain = Made::Terrain.mesh(1).unwrap();
    let moved: Vec<_> = terrain.vertices().iter().map(|v| *v * 0.7 + Vec3::new(0.3, 5.1, -2.3)).collect();
    let edges = Mesh::new(moved, terrain.triangles().to_vec()).unwrap();
    let mut to_edges = Vec::new();
    for (i, ray) in made::view(&edges, 3000, 1).iter().enumerate() {
        let [a, b, _] = edges.triangle(i % edges.triangles().len());
        let aim = a + (b - a) * (0.1 + (i % 7) as f32 / 8.0) - ray.origin();
        to_edges.push(Ray::new(ray.origin(), aim).unwrap());
    }
    let soup = procedural::soup(3, 2000);
    let mut from_soup = made::view(&soup, 2000, 2);
    from_soup.extend(bounce(&soup, &Bvh::sah(&soup, SahOptions::default()).unwrap(), &from_soup, 1));
    let mut wrong_without_bounds = 0;
    for (mesh, rays) in [(&edges, &to_edges), (&soup, &from_soup)] {
        let bvh = Bvh::sah(mesh, SahOptions::default()).unwrap();
        let eight = scene::hierarchy(mesh).unwrap();
        let scene = Scene::new(&gpu, &bvh).unwrap().with_eight(&gpu, eight).unwrap();
        let truth = BinaryTracer::new(&bvh).closest_parallel(rays).unwrap();
        assert!(truth.iter().flatten().count() > 500);
        for name in ["stack", "hashed", "laine-4", "afra", "wide-stack", "wide-record"] {
            let mut kernels = Kernel::all(1).into_iter().chain(Kernel::wide());
            let kernel = kernels.find(|kernel| kernel.name == name).unwrap();
            let trace = |factor| exact::closest(&gpu, (&scene, &bvh), &arithmetic, &kernel, rays, factor).unwrap();
            let settled = trace(exact::EDGE_FACTOR);
            assert_eq!(settled.hits, truth, "{name}");
            assert!(settled.uncertain < rays.len(), "{name}: {}", settled.uncertain);
            wrong_without_bounds += trace(0.0).hits.iter().zip(&truth).filter(|(a, b)| a != b).count();
        }
    }
    assert!(wrong_without_bounds > 0);
}

/// [HASH-4] [HASH-9]
#[test]
fn tables_from_the_device_are_certified() {
    let gpu = gpu();
    for mesh in [procedural::soup(1, 3000), procedural::strands(2, 40), Made::City.mesh(4).unwrap()] {
        let bvh = Bvh::sah(&mesh, SahOptions::default()).unwrap();
        for table in [Table::Printed, Table::Tight] {
            let built = tables::build(&gpu, &bvh, table.options()).unwrap();
            let on_cpu = PerfectHash::build(&bvh, table.options()).unwrap();
            let facts = |hash: &PerfectHash| (hash.header().keys, hash.header().direct, hash.header().displacements);
            assert_eq!(facts(&built.hash), facts(&on_cpu));
        }
    }
    let mut rng = Rng::new(1);
    for leaves in [1, 2, 3, 9, 40, 200, 2000] {
        let tree = Family::Catalan.tree(&mut rng, leaves);
        let built = tables::build(&gpu, &tree, Table::Tight.options());
        assert!(built.is_ok() || tree.depth() > 63, "{built:?}");
    }
    // The printed sizes have no displacements for this chain: an error, and no endless search.
    let chain = Family::Comb.tree(&mut Exhaustive::new(), 32);
    let options = Options { key_set: KeySet::All, sizing: Sizing::Printed };
    assert!(matches!(tables::build(&gpu, &chain, options), Err(GpuError::Data(_))));
}

#[test]
fn a_small_bench_has_all_kernels_and_the_noise() {
    let gpu = gpu();
    let arithmetic = probe::probe(&gpu).unwrap();
    let mesh = Made::Terrain.mesh(1).unwrap();
    let bvh = Bvh::sah(&mesh, SahOptions::default()).unwrap();
    let setting = Setting { rays: 500, views: 1, warm_up: 1, passes: 3, checks: Checks::All };
    let (mut rows, mut traffic) = (Vec::new(), 0);
    bench::bench(&gpu, &arithmetic, ("terrain", &mesh, &bvh), setting, &mut |said| match said {
        Ok(row) => rows.push(row.clone()),
        Err(_) => traffic += 1,
    })
    .unwrap();
    // The trail of wide trees with the fewest words.
    let kernels = Kernel::all(1).len() + ["wide-stack", "wide-trail", "wide-record", "wide-hashed/64"].len();
    assert_eq!((rows.len(), traffic), (3 * (kernels + 1), 6));
    assert!(rows.iter().all(|row| row.nanoseconds > 0.0 && row.to_best[0] > 0.0));
    assert_eq!(rows.iter().filter(|row| row.is_noise).count(), 3);
    let summary = Summary::of(&rows);
    assert_eq!(summary.lines.len(), 3 * kernels);
    let own = summary.lines.iter().filter(|line| line.kernel == "wide-stack").map(|line| line.to_own);
    assert_eq!(own.collect::<Vec<_>>(), [1.0; 3]);
    let of = |kernel: &str| summary.lines.iter().find(|line| line.kernel == kernel).unwrap().to_best;
    assert!((of("hashed") - rows.iter().find(|row| row.kernel == "hashed").unwrap().to_best[0]).abs() < 1e-9);
    assert_eq!(summary.svg().matches("<rect x").count(), summary.lines.len());
}

#[test]
fn what_the_device_refuses_is_an_error() {
    let gpu = gpu();
    let refused = gpu.compile("nonsense", "fn main( {", &[Access::Read], Checks::All);
    assert!(matches!(refused, Err(GpuError::Refused { .. })), "{refused:?}");
    // This exceeds every limit, and nothing is allocated.
    let too_large = gpu.zeros("all memory there is", 1 << 46);
    assert!(matches!(too_large, Err(GpuError::Limit { .. })), "{too_large:?}");
    assert_eq!(too_large.unwrap_err().exit_code(), 3);
    // The device still works.
    assert!(probe::probe(&gpu).is_ok());
}
