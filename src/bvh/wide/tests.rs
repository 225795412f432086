use super::WideBvhError as E;
use super::*;
use crate::bvh::{BuildOptions, Builder, Bvh, BvhNode, Degenerate, Leaf, LeafTriangle, SahOptions, SpatialOptions};
use crate::generate::{double, procedural, stress};
use crate::geom::{Mesh, Triangle};
use crate::wide::{Link, Recorded, ancestor_key, child_key, key_level};

use std::collections::HashMap;

pub(super) fn wide<const A: usize>(bvh: &Bvh) -> WideBvh<A> {
    WideBvh::of(bvh).expect("small enough")
}

/// Checks that the trees of both widths are valid, and returns their numbers of nodes.
fn sound(mesh: &Mesh, bvh: &Bvh) -> [usize; 2] {
    let (eight, four) = (wide::<8>(bvh), wide::<4>(bvh));
    assert_eq!((eight.validate(mesh), four.validate(mesh)), (Ok(()), Ok(())));
    [eight.nodes.len(), four.nodes.len()]
}

pub(super) fn triangles(corners: Vec<Vec3>) -> Mesh {
    let count = corners.len() as u32 / 3;
    Mesh::new(corners, (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).expect("a mesh")
}

/// Builds a chain: the left child of each inner node is a leaf of one triangle, and the right child has all remaining
/// triangles.
pub(super) fn chain(mesh: &Mesh) -> Bvh {
    let mut bvh = Bvh::build(mesh).expect("a tree");
    let n = mesh.triangles().len() as u32;
    bvh.triangles = (0..n).map(|prim| LeafTriangle { shape: Triangle(mesh.triangle(prim as usize)), prim }).collect();
    let links = [Node::inner(0); 2];
    bvh.tree.leaves = (0..n).map(|first| Leaf { first, count: 1, links }).collect();
    bvh.tree.nodes.clear();
    let mut rest = bvh.triangles[n as usize - 1].shape.aabb();
    for i in (0..n - 1).rev() {
        let right = if i + 2 == n { Node::leaf(i + 1) } else { Node::inner(i + 1) };
        let mut node = BvhNode { planes: [[0.0; 4]; 3], children: [Node::leaf(i), right], links };
        let left = bvh.triangles[i as usize].shape.aabb();
        node.set_child_boxes(&left, &rest);
        rest = rest.union(left);
        bvh.tree.nodes.push(node);
    }
    bvh.tree.nodes.reverse();
    bvh.dropped = 0;
    (bvh.tree.root, bvh.tree.depth, bvh.tree.axes) = (Node::inner(0), n - 1, vec![0; n as usize - 1]);
    bvh
}

pub(super) fn cut(n: u32) -> (Bvh, Mesh) {
    crate::bvh::validate::tests::cut(n, 3)
}

#[test]
fn records_fill_cache_lines() {
    assert_eq!((size_of::<WideNode<8>>(), size_of::<WideNode<4>>(), size_of::<Block>()), (256, 128, 176));
    assert_eq!((align_of::<WideNode<8>>(), align_of::<Block>()), (64, 16));
}

#[test]
fn scenes_of_all_builders_are_sound() {
    for mesh in [procedural::stadium(1), procedural::soup(2, 500), procedural::layers(60), procedural::strands(3, 700)]
    {
        for builder in Builder::ALL {
            let bvh = BuildOptions { builder, ..BuildOptions::default() }.build(&mesh).expect("a tree");
            let [eight, four] = sound(&mesh, &bvh);
            assert!(eight < four && 2 * eight < bvh.nodes().len() + 4, "{builder:?} {eight} {four}");
        }
    }
}

#[test]
fn stress_cases_are_sound() {
    for case in stress::cases(0) {
        sound(&case.mesh, &Bvh::build(&case.mesh).expect("a tree"));
    }
}

#[test]
fn the_smallest_ones_are_sound() {
    let empty = WideBvh::<8>::empty();
    assert_eq!((empty.nodes().len(), empty.blocks().len(), empty.levels(), empty.leaves(empty.root())), (1, 0, 0, 0));
    for n in 1..40 {
        let mesh = procedural::soup(n as u64, n);
        for max_leaf in [1, 4, 8, 20] {
            let bvh = Bvh::sah(&mesh, SahOptions { max_leaf, ..SahOptions::default() }).expect("a tree");
            sound(&mesh, &bvh);
        }
    }
    let mesh = procedural::soup(1, 1);
    let one = wide::<8>(&Bvh::build(&mesh).expect("a tree"));
    assert_eq!((one.nodes.len(), one.blocks.len(), one.nodes[0].leaves().count_ones()), (1, 1, 1));
    // A degenerate triangle cannot be hit. A tree may contain it or omit it.
    let line = triangles(vec![Vec3::ZERO, Vec3::X, 2.0 * Vec3::X]);
    sound(&line, &Bvh::build(&line).expect("a tree"));
    let none = WideBvh::<8> { triangles: 1, ..WideBvh::empty() };
    assert_eq!((none.validate(&line), none.validate(&mesh)), (Ok(()), Err(WideBvhError::Missing(0))));
}

#[test]
fn large_leaves_are_divided() {
    // A single binary leaf, and coincident triangles.
    let mesh = procedural::soup(1, 1000);
    let options = BuildOptions {
        builder: Builder::Median,
        sah: SahOptions { max_leaf: 1000, ..SahOptions::default() },
        ..BuildOptions::default()
    };
    let bvh = options.build(&mesh).expect("a tree");
    assert_eq!(bvh.leaves().len(), 1);
    sound(&mesh, &bvh);
    for wide in [
        wide::<8>(&bvh),
        WideBvh::with_options(&bvh, &WideOptions { max_leaf: 15, ..WideOptions::default() }).expect("small"),
    ] {
        let most = wide.nodes.iter().flat_map(|node| node.children).filter(|&bits| Node::from_bits(bits).is_leaf());
        assert!(most.map(|bits| leaf_parts(Node::from_bits(bits)).1).max().expect("a leaf") <= 15);
    }
    // In every frame: the boxes of the halves are also in the frame.
    for place in double::PLACES {
        let mesh = place.mesh(&mesh).expect("a mesh");
        let bvh = options.build(&mesh).expect("a tree");
        let wide = WideBvh::<8, _>::of(&bvh).expect("small enough");
        assert_eq!((bvh.leaves().len(), wide.validate(&mesh)), (1, Ok(())), "{}", place.name);
    }
    let same = triangles([Vec3::ZERO, Vec3::X, Vec3::Y].repeat(300));
    sound(&same, &Bvh::build(&same).expect("a tree"));
    // With triangles in parts.
    let (mut bvh, mesh) = crate::bvh::validate::tests::cut(60, 40);
    assert!(bvh.duplicates() > 0);
    sound(&mesh, &bvh);
    bvh.refit(&mesh).expect("the same mesh");
    sound(&mesh, &bvh);
}

#[test]
fn triangles_in_parts_are_covered() {
    let (bvh, mesh) = cut(40);
    assert!(bvh.duplicates() > 2 && wide::<8>(&bvh).duplicates() > 2);
    sound(&mesh, &bvh);
    let options = BuildOptions {
        builder: Builder::Spatial,
        spatial: SpatialOptions { extra_percent: 100, overlap: 0.0 },
        degenerate: Degenerate::Kept,
        ..BuildOptions::default()
    };
    let mesh = procedural::strands(2, 300);
    sound(&mesh, &options.build(&mesh).expect("a tree"));
}

/// Large enough for several tasks; from a binary tree with large leaves, and from a chain.
#[test]
fn the_number_of_threads_does_not_matter() {
    let mesh = procedural::soup(1, 8 * CUT as usize);
    let large = Bvh::sah(&mesh, SahOptions { max_leaf: 64, ..SahOptions::default() }).expect("a tree");
    for bvh in [BuildOptions::fine().build(&mesh).expect("a tree"), large, chain(&mesh)] {
        let made = [1, 2, 5].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| wide::<8>(&bvh))
        });
        for other in &made[1..] {
            assert!(other.nodes == made[0].nodes && other.blocks == made[0].blocks);
        }
        sound(&mesh, &bvh);
    }
}

/// Keys fit for binary trees of any depth.
#[test]
fn depth_is_limited() {
    let one = WideOptions { max_leaf: 1, ..WideOptions::default() };
    let of = |n: usize| {
        let mesh = procedural::soup(1, n);
        let bvh = chain(&mesh);
        sound(&mesh, &bvh);
        let eight = WideBvh::<8>::with_options(&bvh, &one).expect("small enough");
        let four = WideBvh::<4>::with_options(&bvh, &one).expect("small enough");
        assert_eq!((eight.validate(&mesh), four.validate(&mesh)), (Ok(()), Ok(())));
        (eight.levels(), four.levels(), eight)
    };
    // Each node has seven leaves, or three, and the last one has one more.
    for (n, eight, four) in [(94, 13, 30), (148, 16, 30), (149, 16, 30), (2000, 16, 30), (30_000, 16, 30)] {
        let (found_eight, found_four, _) = of(n);
        assert_eq!((found_eight, found_four), (eight, four), "{n}");
    }
    let (_, _, eight) = of(500);
    for (key, node) in keys(&eight) {
        assert_eq!(Recorded.ancestor(&eight, node, key_level::<8>(key).max(1)), eight.root());
    }
}

#[test]
fn keys_and_ancestors_agree() {
    let mesh = procedural::strands(5, 3000);
    let bvh = Bvh::sah(&mesh, SahOptions { max_leaf: 1, ..SahOptions::default() }).expect("a tree");
    agree(&wide::<8>(&bvh));
    agree(&wide::<4>(&bvh));
}

/// Returns the key of each inner node.
fn keys<const A: usize>(wide: &WideBvh<A>) -> HashMap<u64, Node> {
    let mut keys = HashMap::new();
    let mut open = vec![(1_u64, wide.root())];
    while let Some((key, node)) = open.pop() {
        let inner = wide.children(node) & !wide.leaves(node);
        let inner = (0..A as u32).filter(|slot| inner >> slot & 1 == 1);
        open.extend(inner.map(|slot| (child_key::<A, u64>(key, u64::from(slot)), wide.child(node, slot))));
        assert_eq!(keys.insert(key, node), None);
    }
    keys
}

fn agree<const A: usize>(wide: &WideBvh<A>) {
    let keys = keys(wide);
    assert_eq!(keys.len(), wide.nodes.len());
    for (&key, &node) in &keys {
        let level = key_level::<A>(key);
        for up in 1..=level {
            assert_eq!(Recorded.ancestor(wide, node, up), keys[&ancestor_key::<A, u64>(key, up)]);
        }
        if level > 0 {
            assert_eq!(wide.child(wide.parent(node), key as u32 & (A as u32 - 1)), node);
        }
    }
    let levels = keys.keys().map(|&key| key_level::<A>(key));
    assert_eq!(levels.max(), Some(wide.levels()));
}

#[test]
fn options_are_checked() {
    let bvh = Bvh::build(&procedural::soup(1, 20)).expect("a tree");
    let refused = |options: WideOptions| WideBvh::<8>::with_options(&bvh, &options).expect_err("refused");
    for max_leaf in [0, 16] {
        assert_eq!(refused(WideOptions { max_leaf, ..WideOptions::default() }), WideError::LeafSize(max_leaf));
    }
    for cost in [-1.0, f32::INFINITY] {
        assert_eq!(refused(WideOptions { node_cost: cost, ..WideOptions::default() }), WideError::Cost(cost));
        assert_eq!(refused(WideOptions { block_cost: cost, ..WideOptions::default() }), WideError::Cost(cost));
    }
}

/// Returns the node and slot of the first leaf that satisfies a condition.
fn leaf_where(wide: &WideBvh<8>, is_wanted: impl Fn(u32) -> bool) -> (usize, u32) {
    let slots = (0..wide.nodes.len()).flat_map(|node| (0..8).map(move |slot| (node, slot)));
    let is_wanted = |&(node, slot): &(usize, u32)| {
        wide.nodes[node].child(slot).is_leaf() && is_wanted(leaf_parts(wide.nodes[node].child(slot)).1)
    };
    slots.into_iter().find(is_wanted).expect("a leaf")
}

#[test]
fn mistakes_are_named() {
    // Nearly all nodes are full.
    let empty = |good: &WideBvh<8>| {
        let mut slots = (0..good.nodes.len()).flat_map(|node| (0..8).map(move |slot| (node, slot)));
        slots.find(|&(node, slot)| !good.nodes[node].has_child(slot))
    };
    let made = (1..20).find_map(|seed| {
        let mesh = procedural::soup(seed, 500);
        let good = wide::<8>(&Bvh::build(&mesh).expect("a tree"));
        empty(&good).map(|empty| (mesh, good, empty))
    });
    let (mesh, good, (empty, empty_slot)) = made.expect("an empty slot");
    let broken = |change: &dyn Fn(&mut WideBvh<8>)| {
        let mut wide = good.clone();
        change(&mut wide);
        wide.validate(&mesh).expect_err("a mistake")
    };
    let (node, slot) = leaf_where(&good, |count| count % 4 != 0 && count > 1);
    let at = slot as usize;
    let (first, count) = leaf_parts(good.nodes[node].child(slot));
    let (block, last) = (first + (count as usize - 1) / 4, (count as usize - 1) % 4);
    let prim = good.blocks[block].prims[last];
    let inner = (0..8).find(|&slot| good.nodes[0].has_inner(slot)).expect("an inner node");
    let child = good.nodes[0].child(inner).index();

    assert_eq!(broken(&|w| w.nodes.clear()), E::Size { nodes: 0, blocks: good.blocks.len() });
    assert_eq!(broken(&|w| w.triangles += 1), E::Triangles { stored: 501, found: 500 });
    assert_eq!(broken(&|w| w.levels += 1), E::Levels { stored: good.levels + 1, found: good.levels });
    assert_eq!(broken(&|w| w.duplicates += 1), E::Duplicates { stored: 1, found: 0 });
    let moved = |w: &mut WideBvh<8>| w.nodes[0].children[inner as usize] = 0;
    assert_eq!(
        broken(&|w| {
            moved(w);
            w.nodes[0].planes = good.nodes[0].planes;
        }),
        E::EmptySlot { node: 0, slot: inner }
    );
    assert_eq!(
        broken(&|w| {
            moved(w);
            w.nodes[0].set_child_box(inner, &Aabb::EMPTY);
        }),
        E::Unreached(child)
    );
    let other = good.nodes.len() as u32;
    let error = E::Child { node: 0, slot: inner, child: Node::inner(other) };
    assert_eq!(broken(&|w| w.nodes[0].children[inner as usize] = other), error);
    assert_eq!(broken(&|w| w.nodes.push(WideNode::EMPTY)), E::Unreached(good.nodes.len()));
    assert_eq!(broken(&|w| w.blocks.push(Block::EMPTY)), E::UnreachedBlock(good.blocks.len()));
    let slot_of = (0..8).filter(|&s| good.nodes[empty].has_child(s)).min().expect("a child");
    let aabb = good.nodes[empty].child_box(slot_of);
    assert_eq!(
        broken(&|w| w.nodes[empty].set_child_box(empty_slot, &aabb)),
        E::EmptySlot { node: empty, slot: empty_slot }
    );
    for lo in [f32::NAN, f32::INFINITY] {
        assert_eq!(broken(&|w| w.nodes[node].planes[1][0][at] = lo), E::NoBox { node, slot });
    }
    let grown = (0..8).find(|&s| good.nodes[child].has_child(s)).expect("a child");
    assert_eq!(broken(&|w| w.nodes[child].planes[2][1][grown as usize] = 1e9), E::Nesting { node: child, slot: grown });
    for lane in 0..8 {
        assert_eq!(broken(&|w| w.nodes[child].ancestors[lane] ^= 1), E::Ancestors(child));
        assert_eq!(broken(&|w| w.nodes[0].ancestors[lane] ^= 1), E::Ancestors(0));
    }
    assert_eq!(broken(&|w| w.nodes[child].ancestors[1] |= 1 << 24), E::Ancestors(child));
    assert_eq!(broken(&|w| w.nodes[node].ancestors[0] ^= 1 << (24 + slot)), E::Leaves(node));
    assert_eq!(broken(&|w| w.nodes[node].children[at] &= !(15 << 27)), E::EmptyLeaf { node, slot });
    assert_eq!(
        broken(&|w| w.nodes[node].children[at] |= (1 << 27) - 1),
        E::Child { node, slot, child: Node::from_bits(good.nodes[node].children[at] | ((1 << 27) - 1)) }
    );
    assert_eq!(broken(&|w| w.blocks[block].prims[last] = 500), E::Triangle { node, slot, prim: 500 });
    assert_eq!(broken(&|w| w.blocks[block].corners[2][1][last] += 1.0), E::Triangle { node, slot, prim });
    assert_eq!(broken(&|w| w.blocks[block].edges[last] /= 2.0), E::Edge { node, slot, prim });
    assert_eq!(broken(&|w| w.blocks[block].prims[last + 1] = 3), E::Padding { node, slot });
    assert_eq!(broken(&|w| w.blocks[block].corners[0][0][last + 1] = 3.0), E::Padding { node, slot });
    let again = good.blocks[first].prims[0];
    let twice = |w: &mut WideBvh<8>| {
        let t = w.blocks[first].triangle(0);
        w.blocks[block].set(last, &t, again);
    };
    assert_eq!(broken(&twice), E::Twice { node, slot, prim: again });
    assert_eq!(
        broken(&|w| {
            let aabb = w.nodes[node].child_box(slot);
            w.nodes[node].set_child_box(slot, &Aabb { hi: aabb.lo, ..aabb });
        }),
        E::Uncovered((0..count as usize).map(|i| good.blocks[first + i / 4].prims[i % 4]).min().expect("one"))
    );
    // One triangle fewer in its leaf.
    let fewer = |w: &mut WideBvh<8>| {
        w.nodes[node].children[at] -= 1 << 27;
        (w.blocks[block].prims[last], w.blocks[block].edges[last]) = (Block::NONE, Block::<Vec3>::EMPTY.edges[0]);
        w.blocks[block].corners.as_flattened_mut().iter_mut().for_each(|row| row[last] = 0.0);
        if last == 0 {
            w.blocks.remove(block);
        }
    };
    if last > 0 {
        assert_eq!(broken(&fewer), E::Missing(prim));
    }
    assert_eq!(broken(&|w| w.region = Region::of(&Aabb { lo: Vec3::ZERO, hi: Vec3::ZERO })), E::Region);
}
