use glam::{DVec3, Vec3};
use proptest::prelude::*;

use super::*;
use crate::bvh::bytes::tests::{patched, sealed};
use crate::bvh::validate::tests::cut;
use crate::bvh::{BuildOptions, Builder, Bvh, SpatialOptions};
use crate::generate::{double, procedural, stress};
use crate::geom::Mesh;
use crate::trace::{RayQueries, Tracer};

const SLOTS_AT: usize = 12;
const LEVELS_AT: usize = 16;
const NODES_AT: usize = 20;
const BLOCKS_AT: usize = 24;
const TRIANGLES_AT: usize = 28;
const DUPLICATES_AT: usize = 32;
const BODY_AT: usize = 36;

fn wide<const A: usize>(mesh: &Mesh) -> WideBvh<A> {
    WideBvh::of(&Bvh::build(mesh).expect("a tree")).expect("small enough")
}

fn comes_back<const A: usize, V: Precision + Stored>(wide: &WideBvh<A, V>, mesh: &Mesh<V>) {
    let bytes = wide.to_bytes();
    assert_eq!(bytes.len() as u64, file_bytes::<A, V>(wide.nodes.len() as u32, wide.blocks.len() as u32));
    let back = WideBvh::<A, V>::from_bytes(&bytes).expect("what was written");
    assert_eq!((&back.nodes, &back.blocks), (&wide.nodes, &wide.blocks));
    let rest = |wide: &WideBvh<A, V>| (wide.levels, wide.triangles, wide.duplicates);
    assert_eq!(rest(&back), rest(wide));
    assert_eq!(back.to_bytes(), bytes);
    assert_eq!(back.validate(mesh), Ok(()));
}

/// Wide hierarchies survive a round trip. [FILE-6] [FILE-7]
#[test]
fn wide_hierarchies_come_back() {
    let meshes = [procedural::soup(1, 1), procedural::soup(2, 500), procedural::strands(3, 300), cut(30, 1).1];
    for mesh in &meshes {
        for builder in Builder::ALL {
            let spatial = SpatialOptions { extra_percent: 100, overlap: 0.0 };
            let options = BuildOptions { builder, spatial, ..BuildOptions::default() };
            let bvh = options.build(mesh).expect("a tree");
            comes_back(&WideBvh::<8>::of(&bvh).expect("small enough"), mesh);
            comes_back(&WideBvh::<4>::of(&bvh).expect("small enough"), mesh);
        }
    }
    for case in stress::cases(0) {
        comes_back(&wide::<8>(&case.mesh), &case.mesh);
    }
    let (bvh, mesh) = cut(40, 1);
    let parts = WideBvh::<8>::of(&bvh).expect("small enough");
    assert!(parts.duplicates() > 2);
    comes_back(&parts, &mesh);
    let nothing = WideBvh::<8>::empty();
    assert_eq!(nothing.to_bytes().len(), BODY_AT + node_bytes::<8>() + 8);
    let back = WideBvh::<8>::from_bytes(&nothing.to_bytes()).expect("what was written");
    assert_eq!((back.nodes, back.blocks), (nothing.nodes, nothing.blocks));
}

/// Also with frames, which a tree without triangles may have. [FILE-6] [FILE-7]
#[test]
fn wide_hierarchies_in_double_precision_come_back() {
    for place in double::PLACES {
        let mesh = place.mesh(&procedural::soup(2, 500)).expect("a mesh");
        let bvh = Bvh::build(&mesh).expect("a tree");
        comes_back(&WideBvh::<8, _>::of(&bvh).expect("small enough"), &mesh);
        comes_back(&WideBvh::<4, _>::of(&bvh).expect("small enough"), &mesh);
        let mut nothing = WideBvh::<8, DVec3>::empty();
        nothing.region = Region::within(*mesh.frame(), nothing.region.bounds());
        let bytes = nothing.to_bytes();
        assert_eq!(WideBvh::<8, DVec3>::from_bytes(&bytes).expect("what was written").to_bytes(), bytes);
    }
}

/// [FILE-8]
#[test]
fn malformed_wide_files_are_refused_by_name() {
    use WideBvhFileError as E;
    let good = wide::<8>(&procedural::soup(4, 100));
    let bytes = good.to_bytes();
    let load = |bytes: &[u8]| WideBvh::<8>::from_bytes(bytes).map(|_| ());
    let refuse = |at, word, error| assert_eq!(load(&sealed(patched(&bytes, at, word))), Err(error), "{at}");
    refuse(0, 0, E::Magic(MAGIC));
    refuse(8, 1, E::Version { version: 1 });
    refuse(SLOTS_AT, 4, E::Field { name: "slots", value: 4 });
    assert_eq!(WideBvh::<4>::from_bytes(&bytes).map(|_| ()), Err(E::Field { name: "slots", value: 8 }));
    assert_eq!(Bvh::<crate::geom::Triangle>::from_bytes(&bytes).err(), Some(FileError::Magic("SBVHTREE")));
    let (levels, unsound) = (good.levels, E::Unsound);
    refuse(LEVELS_AT, 9, unsound(WideBvhError::Levels { stored: 9, found: levels }));
    refuse(DUPLICATES_AT, 3, unsound(WideBvhError::Duplicates { stored: 3, found: 0 }));
    for (at, size) in [(NODES_AT, node_bytes::<8>()), (BLOCKS_AT, block_bytes::<Vec3>())] {
        let count = u32::from_le_bytes(bytes[at..at + 4].try_into().expect("a word"));
        for absurd in [u32::MAX, 1 << 31, count + 1] {
            let expected = bytes.len() as u64 + size as u64 * u64::from(absurd - count);
            refuse(at, absurd, E::Length { expected, found: bytes.len() });
        }
    }
    for found in 0..bytes.len() {
        let least = BODY_AT + 8;
        let expected = if found < least { least } else { bytes.len() } as u64;
        assert_eq!(load(&sealed(bytes[..found].to_vec())), Err(E::Length { expected, found }));
    }
    let prims = good.blocks.iter().flat_map(|block| block.prims).filter(|&prim| prim != Block::NONE);
    assert_eq!(prims.max(), Some(99));
    assert!(matches!(
        load(&sealed(patched(&bytes, TRIANGLES_AT, 99))),
        Err(E::Unsound(WideBvhError::Triangle { prim: 99, .. }))
    ));
    let first_block = BODY_AT + good.nodes.len() * node_bytes::<8>();
    for bad in [f32::NAN, f32::INFINITY] {
        let found = load(&sealed(patched(&bytes, first_block, bad.to_bits())));
        assert!(matches!(found, Err(E::Unsound(WideBvhError::NotFinite { .. }))), "{found:?}");
    }
    let flipped = patched(&bytes, bytes.len() - 8, 0);
    assert!(matches!(load(&flipped), Err(E::Checksum { .. })));
    // One part of a split triangle has moved.
    let parts = WideBvh::<8>::of(&cut(40, 1).0).expect("small enough");
    let mut prims: Vec<_> =
        parts.blocks.iter().enumerate().flat_map(|(b, it)| it.prims.map(|prim| (prim, b))).collect();
    prims.sort_unstable();
    let [(prim, _), (_, block)] = *prims.array_windows().find(|[a, b]| a.0 == b.0).expect("parts");
    let lane = parts.blocks[block].prims.iter().position(|&held| held == prim).expect("it is there");
    let mut moved = parts.clone();
    moved.blocks[block].corners[2][1][lane] += 1.0;
    let found = load(&moved.to_bytes());
    assert_eq!(found, Err(E::Unsound(WideBvhError::Differs(prim))));
}

/// [FILE-8]
#[test]
fn every_flipped_bit_of_a_wide_file_is_refused() {
    let bytes = wide::<8>(&procedural::soup(9, 9)).to_bytes();
    for bit in 0..8 * bytes.len() {
        let mut bytes = bytes.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        assert!(WideBvh::<8>::from_bytes(&bytes).is_err(), "bit {bit}");
    }
}

proptest! {
    /// Accepted files encode to the same bytes, and rays through them terminate. [FILE-8]
    #[test]
    fn patched_wide_files_do_not_mislead(
        seed in 0_u64..50,
        patches in prop::collection::vec((any::<prop::sample::Index>(), any::<u32>()), 1..4),
    ) {
        let mesh = procedural::soup(seed, 1 + seed as usize);
        let mut bytes = wide::<8>(&mesh).to_bytes();
        for (at, word) in patches {
            let at = BODY_AT + 4 * at.index((bytes.len() - 8 - BODY_AT) / 4);
            // Words from elsewhere in the file are more likely to be plausible.
            let from = BODY_AT + 4 * (word as usize % ((bytes.len() - 8 - BODY_AT) / 4));
            let word = if word % 2 == 0 { word } else { u32::from_le_bytes(bytes[from..from + 4].try_into().unwrap()) };
            bytes = patched(&bytes, at, word);
        }
        let bytes = sealed(bytes);
        if let Ok(found) = WideBvh::<8>::from_bytes(&bytes) {
            prop_assert_eq!(found.to_bytes(), bytes);
            let tracer = Tracer::new(found);
            for ray in procedural::rays(&mesh, seed, 20) {
                prop_assert_eq!(tracer.closest(&ray).is_some(), !tracer.all(&ray).is_empty());
            }
        }
    }
}
