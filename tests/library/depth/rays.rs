//! Rays through a mesh whose hierarchy is deeper than any machine word.

use glam::Vec3;
use stackless_bvh::bvh::{self, Bvh, SahOptions};
use stackless_bvh::event::{Recorder, State, Trace};
use stackless_bvh::generate::procedural;
use stackless_bvh::geom::{Mesh, Ray};
use stackless_bvh::internals::geom::kernel::Exact;
use stackless_bvh::internals::geom::slabs::Directed;
use stackless_bvh::internals::trace::{AnyByNode, Closest, ClosestByNode, Truth};
use stackless_bvh::key::KeyWord;
use stackless_bvh::oracle;
use stackless_bvh::order::Flow;
use stackless_bvh::trace::{BinaryTracer, RayQueries};
use stackless_bvh::traverse::{Afra, Cuts, Hashed, Method, Split, Unsupported, WordName, traverse};
use stackless_bvh::tree::{Keys, Linked, Node, Recorded, Topology};
use stackless_check::{CaseOptions, Pieces, Plan, SceneTree, check_scene};

use super::FOR_ANY_DEPTH;

/// Returns a mesh, with a hierarchy that is a chain.
fn chain(layers: usize) -> (Mesh, Bvh) {
    let mesh = procedural::layers(layers);
    let bvh = Bvh::sah(&mesh, SahOptions { depth_limit: u32::MAX, ..SahOptions::default() }).unwrap();
    (mesh, bvh)
}

/// Deeper than any machine word.
fn deep() -> (Mesh, Bvh) {
    chain(256)
}

/// Returns rays of all kinds, and some through the whole chain, to and from its end, and past it.
fn rays(mesh: &Mesh) -> Vec<Ray> {
    let mut rays = procedural::rays(mesh, 1, 160);
    let wide = 65_536.0;
    let aimed = |from: [f32; 3], to: [f32; 3]| {
        let (from, to) = (Vec3::from_array(from), Vec3::from_array(to));
        Ray::new(from, to - from).unwrap()
    };
    let places = [0.1, 0.3, 0.49, 0.5, 0.51, 0.9].map(|part| part * wide);
    for y in places {
        for z in places {
            rays.push(aimed([1.0, y, z], [0.0, y, z]));
            rays.push(aimed([-1.0, y, z], [0.0, y, z]));
            rays.push(aimed([-1.0 / 1024.0, wide + y, z], [0.0, 0.9 * wide, z]));
            rays.push(aimed([0.0, -y, z], [0.0, 0.0, z]));
        }
    }
    rays
}

#[test]
fn the_hierarchy_is_a_chain_with_one_leaf_of_several_triangles() {
    for layers in [128, 256] {
        let (mesh, bvh) = chain(layers);
        bvh::validate(&bvh, &mesh).unwrap();
        assert_eq!((bvh.depth(), bvh.dropped()), (layers as u32 - 4, 0));
    }
}

#[test]
fn all_traversals_find_the_truth_in_the_words_that_carry_it() {
    for (layers, narrowest) in [(128, WordName::U128), (256, WordName::Grow)] {
        let (mesh, bvh) = chain(layers);
        assert_eq!(WordName::narrowest(bvh.depth()), narrowest);
        let (truth, rays) = (Truth::new(&mesh), rays(&mesh));
        let (options, words) = (CaseOptions::default(), WordName::ALL.to_vec());
        let plan = Plan { trees: 0, seed: 0, options, methods: Method::ALL.to_vec(), words };
        let (tally, found) = check_scene::<Exact, Directed, _>(&plan, &SceneTree::new(&truth, &bvh), &rays, &|_| ());
        assert!(found.is_none(), "{found:?}");
        assert_eq!((tally.oracle_faults, tally.misses), (0, 0));
        let all = 2 * rays.len() as u64;
        for (method, word) in plan.pairs() {
            let count = tally.get(method, word);
            let is_wide = !method.has_words() || word as u8 >= narrowest as u8;
            let carried = is_wide && method != Method::Complete;
            // Pruning traversals do not support any-hit rays.
            let refused = if method == method.without_pruning() { 0 } else { all / 2 };
            let expected = if carried { (all - refused, refused) } else { (0, all) };
            assert_eq!((count.agree, count.refused), expected, "{method} {word}");
            if !is_wide && method != Method::Complete {
                assert!(matches!(count.refusal, Some(Unsupported::TooDeep(_))), "{method} {word}: {:?}", count.refusal);
            }
        }
    }
}

#[test]
fn the_tracer_takes_the_growing_word() {
    let (mesh, bvh) = deep();
    let (truth, tracer) = (Truth::new(&mesh), BinaryTracer::new(&bvh));
    assert_eq!((tracer.method(), tracer.word()), (Method::default(), WordName::Grow));
    let mut hits = 0;
    for ray in rays(&mesh) {
        let hit = truth.closest(&ray).map(|hit| hit.rounded());
        assert_eq!(tracer.closest(&ray), hit);
        assert_eq!(tracer.any(&ray), hit.is_some());
        hits += u32::from(hit.is_some());
    }
    assert!(hits > 100, "{hits}");
}

#[test]
fn pieces_find_the_same_hits_by_the_same_way_in_narrow_words() {
    fn check<W: KeyWord>(levels: u32, mesh: &Mesh, bvh: &Bvh) {
        let (truth, boxes, linked) = (Truth::new(mesh), bvh.own_boxes(), Linked::both(bvh));
        let cuts = Cuts::every(levels, &linked);
        assert_eq!(cuts.nesting(), bvh.depth().div_ceil(levels));
        let pieces = Pieces::new(&cuts).expect("tables");
        for ray in rays(mesh) {
            let hit = truth.closest(&ray).map(|hit| hit.rounded());
            let (mut search, mut expected) = (ClosestByNode::new(bvh, &boxes, &ray), Trace::default());
            oracle::traverse(bvh, &mut search, &mut expected);
            assert_eq!(search.hit(), hit);
            let (mut search, mut expected_any) = (AnyByNode::new(bvh, &boxes, &ray), Trace::default());
            oracle::traverse(bvh, &mut search, &mut expected_any);
            let any = search.hit();
            for method in FOR_ANY_DEPTH {
                let (mut search, mut trace) = (ClosestByNode::new(bvh, &boxes, &ray), Trace::default());
                pieces.run::<W>(method, &mut search, &mut trace).unwrap();
                assert_eq!((search.hit(), &trace), (hit, &expected), "{method} {}", W::NAME);
                let (mut search, mut trace) = (AnyByNode::new(bvh, &boxes, &ray), Trace::default());
                pieces.run::<W>(method, &mut search, &mut trace).unwrap();
                assert_eq!((search.hit(), &trace), (any, &expected_any), "{method} {}", W::NAME);
            }
        }
    }

    let (mesh, bvh) = deep();
    check::<u8>(7, &mesh, &bvh);
    check::<u32>(30, &mesh, &bvh);
    check::<u64>(62, &mesh, &bvh);
}

#[test]
fn links_in_records_serve_all_pieces() {
    let (mesh, bvh) = deep();
    let bvh = bvh.with_links(Recorded::Uncles);
    let climbing = bvh.clone().with_links(Recorded::ParentSibling);
    let (by_uncles, by_parents) = (Cuts::every(31, &bvh), Cuts::every(31, &climbing));
    let pieces = Pieces::new(&by_uncles).expect("tables");
    for ray in rays(&mesh) {
        let (mut search, mut expected) = (Closest::new(&bvh, &ray), Trace::default());
        oracle::traverse(&bvh, &mut search, &mut expected);
        let hit = search.hit();

        let (mut search, mut trace, mut waiting) = (Closest::new(&bvh, &ray), Trace::default(), Vec::new());
        let split = Split::new(&by_uncles, &mut waiting, |piece| {
            Hashed::<u32, _, _>::new(piece, &pieces.hashes()[piece.number()])
        });
        traverse(split.unwrap(), &mut search, &mut trace);
        assert_eq!((search.hit(), &trace), (hit, &expected));

        let (mut search, mut trace, mut waiting) = (Closest::new(&climbing, &ray), Trace::default(), Vec::new());
        let split = Split::new(&by_parents, &mut waiting, Afra::<u32, _>::new);
        traverse(split.unwrap(), &mut search, &mut trace);
        assert_eq!((search.hit(), &trace), (hit, &expected));
    }
}

/// The depth of a search, and its longest backtrack.
struct Reach<'a> {
    bvh: &'a Bvh,
    keys: Keys,
    before: u32,
    deepest: u32,
    farthest: u32,
}

impl Recorder for Reach<'_> {
    fn visit<W: KeyWord>(&mut self, node: Node, _: impl FnOnce() -> State<W>) -> Flow {
        let depth = self.keys.depth(self.bvh.slot(node));
        self.deepest = self.deepest.max(depth);
        self.farthest = self.farthest.max(self.before.saturating_sub(depth));
        self.before = depth;
        Flow::Continue
    }
}

#[test]
fn rays_reach_the_deepest_leaves_and_go_back_to_the_top_at_once() {
    let (mesh, bvh) = deep();
    let bvh = bvh.with_links(Recorded::Uncles);
    let mut reach = Reach { bvh: &bvh, keys: Keys::of(&bvh), before: 0, deepest: 0, farthest: 0 };
    let (boxes, cuts) = (bvh.own_boxes(), Cuts::every(30, &bvh));
    let pieces = Pieces::new(&cuts).expect("tables");
    for ray in rays(&mesh) {
        reach.before = 0;
        let mut search = ClosestByNode::new(&bvh, &boxes, &ray);
        pieces.run::<u32>(Method::Hashed, &mut search, &mut reach).unwrap();
    }
    // The first leaves are a few levels below the root.
    assert_eq!(reach.deepest, bvh.depth());
    assert!(reach.farthest >= bvh.depth() - 4, "{}", reach.farthest);
}
