use proptest::prelude::*;

use super::*;
use crate::bvh::validate::tests::cut;
use crate::bvh::{BuildOptions, Builder, Degenerate, SahOptions, SpatialOptions, validate};
use crate::generate::{Rng, Source, procedural, stress};
use crate::geom::{Mesh, Ray};
use crate::trace::search::Closest64;
use crate::trace::{BinaryTracer, RayQueries, truth};
use crate::traverse::{Method, Stack, traverse};

/// Offsets of the header's words.
const VERSION_AT: usize = 8;
const REAL_AT: usize = 12;
const RECORDED_AT: usize = 16;
const ROOT_AT: usize = 20;
const DEPTH_AT: usize = 24;
const NODES_AT: usize = 28;
const LEAVES_AT: usize = 32;
const TRIANGLES_AT: usize = 36;
const DROPPED_AT: usize = 40;
const DUPLICATES_AT: usize = 44;

fn load(bytes: &[u8]) -> Result<Bvh, BvhFileError> {
    Bvh::from_bytes(bytes)
}

/// Returns the bytes with a valid checksum.
pub(in crate::bvh) fn sealed(mut bytes: Vec<u8>) -> Vec<u8> {
    if let Some((content, sum)) = bytes.split_last_chunk_mut() {
        *sum = checksum(content).to_le_bytes();
    }
    bytes
}

pub(in crate::bvh) fn patched(bytes: &[u8], at: usize, word: u32) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    bytes[at..at + 4].copy_from_slice(&word.to_le_bytes());
    bytes
}

fn soup(n: usize) -> Bvh {
    Bvh::sah(&procedural::soup(4, n), SahOptions { max_leaf: 2, ..SahOptions::default() }).expect("a tree")
}

/// Returns small hierarchies of all kinds.
fn small() -> Vec<Bvh> {
    let (cut, _) = cut(4, 1);
    assert!(cut.duplicates() > 1);
    vec![soup(1), soup(9), soup(9).with_links(Recorded::Uncles), cut.with_links(Recorded::Nothing)]
}

fn double(mesh: &Mesh) -> Mesh<DVec3> {
    let fine = |v: &Vec3| v.as_dvec3() + DVec3::new(1e-12, -1e-13, 1e-14);
    Mesh::new(mesh.vertices().iter().map(fine).collect(), mesh.triangles().to_vec()).expect("a mesh")
}

fn come_back<V: Stored>(mesh: &Mesh<V>) {
    for builder in Builder::ALL {
        let spatial = SpatialOptions { extra_percent: 50, overlap: 0.0 };
        for degenerate in [Degenerate::Kept, Degenerate::LeftOut] {
            let options = BuildOptions { builder, spatial, degenerate, ..BuildOptions::default() };
            let mut bvh = options.build(mesh).expect("a tree");
            for recorded in RECORDED {
                bvh = bvh.with_links(recorded);
                let bytes = bvh.to_bytes();
                let fixed = HEADER_BYTES + frame_bytes::<V>() + 8;
                assert_eq!(bytes.len(), bvh.bytes() + bvh.tree.nodes.len() + fixed - padding(&bvh));
                let back = Bvh::from_bytes(&bytes).expect("what was written");
                assert_eq!(format!("{back:?}"), format!("{bvh:?}"), "{builder}");
                assert_eq!(back.to_bytes(), bytes);
                validate(&back, mesh).expect("sound");
            }
        }
    }
}

/// Counts the padding bytes of triangles in memory.
fn padding<V: Stored>(bvh: &Bvh<Triangle<V>>) -> usize {
    (size_of::<LeafTriangle<Triangle<V>>>() - triangle_bytes::<V>()) * bvh.triangles.len()
}

#[test]
fn hierarchies_come_back() {
    let with_degenerate = {
        let soup = procedural::soup(3, 100);
        let triangles = soup.triangles().iter().copied().chain([[0, 0, 1], [5, 5, 5]]).collect();
        Mesh::new(soup.vertices().to_vec(), triangles).expect("a mesh")
    };
    let point = Mesh::new(vec![Vec3::new(-0.0, 1.0, 2.0)], vec![[0; 3]; 3]).expect("a mesh");
    let all = [procedural::soup(1, 1), point, with_degenerate, procedural::soup(2, 500), cut(30, 1).1];
    for mesh in all {
        come_back(&mesh);
        come_back(&double(&mesh));
    }
    // Beyond the range of single precision.
    let vast: Vec<_> = (0..60).map(|i| DVec3::new(f64::from(i) * 1e300, f64::from(i * i % 7), -1e200)).collect();
    come_back(&Mesh::new(vast, (0..20).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).expect("a mesh"));
}

#[test]
fn what_a_refit_makes_comes_back() {
    let (mut bvh, mesh) = cut(20, 2);
    let line = mesh.vertices().iter().map(|v| Vec3::X * v.x).collect();
    bvh.refit(&Mesh::new(line, mesh.triangles().to_vec()).expect("a mesh")).expect("the same triangles");
    let back = load(&bvh.to_bytes()).expect("what was written");
    assert_eq!(format!("{back:?}"), format!("{bvh:?}"));
}

#[test]
fn other_lengths_are_refused_before_anything_is_allocated() {
    let length = |expected: usize, found| Err(BvhFileError::Length { expected: expected as u64, found });
    for bvh in small() {
        let bytes = bvh.to_bytes();
        for found in 0..bytes.len() {
            let expected = if found < HEADER_BYTES + 8 { HEADER_BYTES + 8 } else { bytes.len() };
            assert_eq!(load(&bytes[..found]).map(|_| ()), length(expected, found));
            assert_eq!(load(&sealed(bytes[..found].to_vec())).map(|_| ()), length(expected, found));
        }
        let more = [&bytes[..], &[0]].concat();
        assert_eq!(load(&sealed(more)).map(|_| ()), length(bytes.len(), bytes.len() + 1));
        for (at, size) in [(NODES_AT, 65), (LEAVES_AT, 16), (TRIANGLES_AT, 40)] {
            let count = u32::from_le_bytes(bytes[at..at + 4].try_into().expect("a word"));
            for absurd in [u32::MAX, 1 << 31, count + 1] {
                let expected = bytes.len() as u64 + size * u64::from(absurd - count);
                let error = BvhFileError::Length { expected, found: bytes.len() };
                assert_eq!(load(&sealed(patched(&bytes, at, absurd))).err(), Some(error));
            }
        }
    }
}

/// [FILE-5]
#[test]
fn malformed_files_are_refused_by_name() {
    use BvhFileError as E;
    let bvh = soup(9).with_links(Recorded::Uncles);
    let bytes = bvh.to_bytes();
    let refuse = |at, word, error| assert_eq!(load(&sealed(patched(&bytes, at, word))).err(), Some(error));
    refuse(0, 0, E::Magic("SBVHTREE"));
    refuse(VERSION_AT, 1, E::Version { version: 1 });
    refuse(REAL_AT, 8, E::Numbers { expected: 4, found: 8 });
    assert_eq!(Bvh::<Triangle<DVec3>>::from_bytes(&bytes).err(), Some(E::Numbers { expected: 8, found: 4 }));
    refuse(RECORDED_AT, 3, E::Field { name: "recorded", value: 3 });
    refuse(RECORDED_AT, 1, E::Unsound(BvhError::Links(Node::inner(1))));
    refuse(ROOT_AT, 1, E::Unsound(BvhError::Order { found: Node::inner(1), expected: 0 }));
    refuse(DEPTH_AT, 0, E::Unsound(BvhError::Depth { stored: 0, found: bvh.tree.depth }));
    refuse(DEPTH_AT, u32::MAX, E::Unsound(BvhError::Depth { stored: u32::MAX, found: bvh.tree.depth }));
    refuse(DROPPED_AT, Node::MAX_INDEX + 1, E::Field { name: "dropped", value: Node::MAX_INDEX + 1 });
    for stored in [1, u32::MAX] {
        let error = BvhError::Duplicates { stored: stored as usize, found: 0 };
        refuse(DUPLICATES_AT, stored, E::Unsound(error));
    }
    let (found, sum) = (checksum(&bytes[..bytes.len() - 8]), bytes.len() - 8);
    let flipped = patched(&bytes, sum, found as u32 ^ 1);
    assert_eq!(load(&flipped).err(), Some(E::Checksum { stored: found ^ 1, found }));
    assert_eq!(E::Magic(MAGIC).to_string(), "not such a hierarchy: it does not begin with SBVHTREE");

    // A file without any content is not a hierarchy.
    let nothing = (NODES_AT..DROPPED_AT).step_by(4).fold(bytes, |bytes, at| patched(&bytes, at, 0));
    let nothing = sealed(nothing[..HEADER_BYTES + 8].to_vec());
    assert!(matches!(load(&nothing), Err(E::Unsound(BvhError::Order { .. }))));
}

/// [FILE-5]
#[test]
fn every_flipped_bit_is_refused() {
    for bvh in small() {
        let bytes = bvh.to_bytes();
        for bit in 0..8 * bytes.len() {
            let mut bytes = bytes.clone();
            bytes[bit / 8] ^= 1 << (bit % 8);
            assert!(load(&bytes).is_err(), "bit {bit}");
        }
    }
}

/// Returns the mesh of a hierarchy as far as it is known. Dropped triangles become points.
fn mesh_of<V: Stored>(bvh: &Bvh<Triangle<V>>) -> Option<Mesh<V>> {
    let count = bvh.triangles.len() + bvh.dropped - bvh.duplicates;
    let mut corners = vec![bvh.triangles[0].shape.0[0]];
    let mut triangles = vec![[0; 3]; if count < 1000 { count } else { return None }];
    for held in &bvh.triangles {
        triangles[held.prim as usize] = [0, 1, 2].map(|i| corners.len() as u32 + i);
        corners.extend(held.shape.0);
    }
    Some(Mesh::new(corners, triangles).expect("finite corners"))
}

/// Checks that bytes are rejected, or give a valid hierarchy with correct hits. Returns whether they are accepted.
fn does_not_mislead(bytes: &[u8], seed: u64) -> bool {
    let Ok(bvh) = load(bytes) else { return false };
    let Some(mesh) = mesh_of(&bvh) else { return true };
    validate(&bvh, &mesh).expect("sound");
    let tracers = [Method::Stack, Method::Sparse, Method::Uncle, Method::Hapala, Method::Hashed]
        .map(|method| BinaryTracer::with_method(&bvh, method).expect("tables"));
    for ray in stress::aimed(&mesh, seed, 4) {
        let truth: Vec<_> = truth::brute_force(&mesh, &ray).iter().map(truth::TrueHit::rounded).collect();
        for tracer in &tracers {
            assert_eq!(tracer.closest(&ray), truth.first().copied(), "{ray:?}");
            assert_eq!(tracer.any(&ray), !truth.is_empty(), "{ray:?}");
        }
        assert_eq!(tracers[0].all(&ray), truth, "{ray:?}");
    }
    true
}

#[test]
fn flipped_bits_under_a_right_checksum_do_not_mislead() {
    for bvh in small() {
        let (bytes, mut accepted, mut refused) = (bvh.to_bytes(), 0, 0);
        for bit in 0..8 * (bytes.len() - 8) {
            let mut bytes = bytes.clone();
            bytes[bit / 8] ^= 1 << (bit % 8);
            *(if does_not_mislead(&sealed(bytes), bit as u64) { &mut accepted } else { &mut refused }) += 1;
        }
        assert!(accepted > 30 && refused > 200, "{accepted} {refused}");
    }
}

#[test]
fn any_changes_under_a_right_checksum_do_not_mislead() {
    let mut rng = Rng::new(6);
    for bvh in small() {
        let (bytes, mut accepted) = (bvh.to_bytes(), 0);
        for seed in 0..4000 {
            let mut bytes = bytes.clone();
            for _ in 0..=rng.below(3) {
                // Replaces a word, or flips a bit.
                let [to, from] = [(); 2].map(|()| 4 * rng.below(bytes.len() as u64 / 4) as usize);
                if rng.coin() {
                    bytes.copy_within(from..from + 4, to);
                } else {
                    bytes[to + rng.below(4) as usize] ^= 1 << rng.below(8);
                }
            }
            accepted += u32::from(does_not_mislead(&sealed(bytes), seed));
        }
        assert!(accepted > 100, "{accepted}");
    }
}

#[test]
fn double_precision_does_not_mislead() {
    let mesh = double(&procedural::soup(4, 5));
    let bytes = Bvh::sah(&mesh, SahOptions { max_leaf: 2, ..SahOptions::default() }).expect("a tree").to_bytes();
    let mut accepted = 0;
    for bit in 0..8 * (bytes.len() - 8) {
        let mut bytes = bytes.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        let Ok(bvh) = Bvh::<Triangle<DVec3>>::from_bytes(&sealed(bytes)) else { continue };
        let Some(mesh) = mesh_of(&bvh) else { continue };
        accepted += 1;
        for t in 0..2 {
            let [a, b, c] = mesh.triangle((bit + t) % mesh.triangles().len());
            let origin = DVec3::new(3.0, -4.0, 5.0);
            let Ok(ray) = Ray::new(origin, (a * 0.3 + b * 0.3 + c * 0.4) - origin) else {
                continue;
            };
            let mut closest = Closest64::new(&bvh, &ray);
            traverse(Stack::new(&bvh, &mut Vec::new()), &mut closest, &mut ());
            let truth = truth::brute_force(&mesh, &ray);
            assert_eq!(closest.hit(), truth.first().map(truth::TrueHit::rounded), "{ray:?}");
        }
    }
    assert!(accepted > 500, "{accepted}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(5000))]

    /// Random bytes, with and without a header that matches their length.
    #[test]
    fn random_bytes_are_no_hierarchy(body in prop::collection::vec(any::<u8>(), 0..500), words in any::<[u32; 13]>()) {
        prop_assert!(load(&body).is_err());
        let counts = [body.len() % 4, body.len() % 5, body.len() % 3].map(|count| count as u32);
        let mut bytes = MAGIC.as_bytes().to_vec();
        let [recorded, root, depth, dropped, duplicates, ..] = words;
        bytes.extend([VERSION, 4, recorded % 3, (root % 2) << 31, depth % 3].into_iter().flat_map(u32::to_le_bytes));
        bytes.extend(counts.into_iter().chain([dropped, duplicates % 2]).flat_map(u32::to_le_bytes));
        bytes.extend(words[7..].iter().flat_map(|word| word.to_le_bytes()));
        let [nodes, leaves, triangles] = counts;
        bytes.extend(body.iter().cycle().take(500));
        bytes.resize(file_bytes::<Vec3>(nodes, leaves, triangles) as usize, 7);
        let refused = load(&sealed(bytes));
        prop_assert!(matches!(refused, Err(BvhFileError::Unsound(_) | BvhFileError::Field { .. })), "{refused:?}");
    }
}
