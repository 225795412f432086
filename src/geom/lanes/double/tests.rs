use fearless_simd::dispatch;

use super::*;
use crate::generate::{double, stress};
use crate::geom::frame::power_of_two;
use crate::geom::lanes::Level;
use crate::geom::lanes::tests::levels;
use crate::geom::tests::exact;
use crate::geom::truth;
use crate::geom::{Frame, Mesh};

/// The answers of a level for the lanes of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Told {
    left: u32,
    certain: u32,
    /// Bits of the bounds.
    ends: [[u64; 4]; 2],
    /// After the best distance, before it, and between 0 and it.
    after: u32,
    before: u32,
    within: u32,
}

#[inline(always)]
fn told<S: Simd>(simd: S, ray: &TriangleRay<S, DVec3>, block: &Block<DVec3>, best: f64) -> Told {
    let found = ray.found(simd, block);
    let (certain, ends) = ray.certain(simd, block, &found);
    // In other lanes the bounds are meaningless.
    let bits = |lane: usize, end: f64| if certain >> lane & 1 == 1 { end.to_bits() } else { 0 };
    let ends = ends.map(|ends| [0, 1, 2, 3].map(|lane| bits(lane, ends[lane])));
    let left = ray.left(simd, block, best, &found);
    let [after, before] = ray.placed(simd, block, &found, [best, f64::INFINITY]);
    let [within, _] = ray.placed(simd, block, &found, [0.0, best]);
    Told { left, certain, ends, after, before, within }
}

fn region(frame: &Frame, triangles: &[Triangle<DVec3>]) -> Region {
    let around = triangles.iter().map(|triangle| frame.aabb(triangle)).reduce(crate::geom::Aabb::union);
    Region::within(*frame, &around.expect("a triangle"))
}

/// Returns scenes at places beyond the reach of single precision, with difficult rays.
fn scenes(rays: usize) -> impl Iterator<Item = (Mesh<DVec3>, Vec<Ray<DVec3>>)> {
    stress::cases(rays).enumerate().filter_map(move |(i, case)| {
        let place = double::PLACES[i % double::PLACES.len()];
        let mesh = place.mesh(&case.mesh).ok()?;
        let mut aimed = double::aimed(&mesh, i as u64, rays);
        aimed.extend(case.rays.iter().filter_map(|ray| place.ray(ray)));
        Some((mesh, aimed))
    })
}

/// [LANES-3] [LANES-4] [LANES-5] [LANES-6] [LANES-7]
#[test]
fn what_is_told_of_four_triangles_is_true() {
    let (mut rejected, mut certain_hits, mut placed, mut enclosed) = (0, 0, 0, 0);
    for (mesh, rays) in scenes(40) {
        let n = mesh.triangles().len();
        for (i, ray) in rays.iter().enumerate() {
            let triangles = [0, 1, 2, 3].map(|k| Triangle(mesh.triangle((i + k * k * 7) % n)));
            let region = region(mesh.frame(), &triangles);
            let mut block = Block::EMPTY;
            triangles.iter().enumerate().for_each(|(lane, triangle)| block.set(lane, triangle, lane as u32));
            let hits = triangles.map(|Triangle(corners)| {
                let meeting =
                    truth::meet(corners.map(|v| v.to_array()), ray.origin().to_array(), ray.direction().to_array());
                meeting.within([f64::MIN, f64::MAX]).map(|point| point.t)
            });
            let of_hits = hits.iter().flatten().map(truth::round_f64).flat_map(|t| [t, t.next_down(), t.next_up()]);
            for best in of_hits.chain([0.0, f64::INFINITY]).filter(|best| *best >= 0.0) {
                let mut answers = levels().into_iter().map(|level| {
                    dispatch!(level, simd => told(simd, &TriangleRay::double(simd, ray, &region), &block, best))
                });
                let told = answers.next().expect("a level");
                assert!(answers.all(|answer| answer == told), "{ray:?} {triangles:?} {best}");
                let Told { left, certain, ends, after, before, within } = told;
                for (lane, t) in hits.iter().enumerate() {
                    let is_left = left >> lane & 1 == 1;
                    rejected += u32::from(!is_left);
                    let is_near = |t: &truth::RBig| *t >= truth::RBig::ZERO && truth::round_f64(t) <= best;
                    assert!(is_left || !t.as_ref().is_some_and(is_near), "{ray:?} {:?} {best}", triangles[lane]);
                    if certain >> lane & 1 == 1 {
                        let [lo, hi] = ends.map(|ends| f64::from_bits(ends[lane]));
                        let t = t.as_ref().expect("a certain hit is one");
                        assert!(exact(lo) <= *t && *t <= exact(hi), "{ray:?} {:?} {lo} {hi}", triangles[lane]);
                        certain_hits += 1;
                        let [is_after, is_before, is_within] = [after, before, within].map(|set| set >> lane & 1 == 1);
                        let is_least = best.is_infinite() || *t < exact(best);
                        assert!(!is_after || !is_least && *t != exact(best), "{ray:?} {triangles:?} {best}");
                        assert!(is_least || !is_before && !is_within, "{ray:?} {triangles:?} {best}");
                        assert!(!is_within || *t > truth::RBig::ZERO, "{ray:?} {triangles:?} {best}");
                        placed += [is_after, is_before, is_within].map(u32::from).iter().sum::<u32>();
                    }
                }
                // The ray is within bounds that enclose it, so its hits must not be rejected.
                let wide = |x: f64, by: f64| Interval::between([x - by, x + by * 0.5]);
                let by = ray.direction().abs().max_element() * power_of_two(-20 - (i % 30) as i32);
                let off = region.size() * power_of_two(-20 - (i % 23) as i32);
                let bounds = EnclosedRay::new(
                    ray.origin().to_array().map(|x| wide(x, off)),
                    ray.direction().to_array().map(|x| wide(x, by)),
                );
                let left = dispatch!(Level::new(), simd => DVec3::enclosed(simd, &bounds, &region).survivors(simd, &block, best));
                for (lane, t) in hits.iter().enumerate() {
                    let is_near = |t: &truth::RBig| *t >= truth::RBig::ZERO && truth::round_f64(t) <= best;
                    let is_left = left >> lane & 1 == 1;
                    enclosed += u32::from(!is_left);
                    assert!(is_left || !t.as_ref().is_some_and(is_near), "{bounds:?} {:?} {best}", triangles[lane]);
                }
            }
        }
    }
    assert!(rejected > 10_000 && certain_hits > 10_000, "{rejected} {certain_hits}");
    assert!(placed > 10_000 && enclosed > 5_000, "{placed} {enclosed}");
}

#[inline(always)]
fn ask<S: Simd>(
    simd: S,
    ray: &Ray<DVec3>,
    region: &Region,
    blocks: &[Block<DVec3>],
    count: u32,
) -> (Option<(u32, f64)>, Option<u32>) {
    let mut hits = <LazyExact64<'_> as Hits<'_, DVec3>>::new(ray, region);
    let (filter, none) = (hits.filter(simd), hits.none());
    let nearest = hits.nearest(simd, &filter, blocks, count, none);
    let found = LazyExact64::prim(&nearest).map(|prim| (prim, hits.distance(simd, nearest)));
    let whole = hits.whole(simd, nearest);
    assert_eq!(found.map(|(_, t)| t), whole.map(|(t, _)| t).filter(|_| found.is_some()));
    (found, hits.any(simd, &filter, blocks, count).map(|hit| hit.prim))
}

/// Leaves of one to twelve triangles have the first hit of rational arithmetic, also for ties and near ties. [LANES-7]
#[test]
fn leaves_have_the_nearest_hit() {
    let mut found = 0;
    for (mesh, rays) in scenes(30) {
        let n = mesh.triangles().len();
        for (i, ray) in rays.iter().enumerate() {
            let held: Vec<_> = (0..=i % 12).map(|k| (i + k * k) % n).collect();
            let triangles: Vec<_> = held.iter().map(|&at| Triangle(mesh.triangle(at))).collect();
            let region = region(mesh.frame(), &triangles);
            let mut blocks = vec![Block::EMPTY; held.len().div_ceil(4)];
            for (k, (triangle, &at)) in triangles.iter().zip(&held).enumerate() {
                // Some have equal corners and different indices.
                blocks[k / 4].set(k % 4, triangle, (at ^ (k * 64)) as u32);
            }
            let hits = triangles.iter().zip(&held).enumerate().filter_map(|(k, (Triangle(corners), &at))| {
                let corners = corners.map(|v| v.to_array());
                let meeting = truth::meet(corners, ray.origin().to_array(), ray.direction().to_array());
                Some((meeting.within([ray.tmin(), ray.tmax()])?.t, (at ^ (k * 64)) as u32))
            });
            let first = hits.min().map(|(t, prim)| (prim, truth::round_f64(&t)));
            found += u32::from(first.is_some());
            for level in levels() {
                let (nearest, any) = dispatch!(level, simd => ask(simd, ray, &region, &blocks, held.len() as u32));
                assert_eq!(nearest, first, "{level:?} {ray:?} {triangles:?}");
                assert_eq!(any.is_some(), first.is_some(), "{level:?} {ray:?} {triangles:?}");
            }
        }
    }
    assert!(found > 1_000, "{found}");
}

/// Lines with errors that are large relative to a bound: the bits of origin, direction, corners, and the origin of the
/// frame. Hill climbing over bits found them.
const WORST: [[[u64; 3]; 6]; 5] = [
    // An edge function of a hit has the wrong sign, by 0.32 of its bound. [LANES-3]
    [
        [0xc001_8000_055b_07c7, 0x3ffd_0000_06ad_0c9d, 0x4002_7fff_fc23_78cf],
        [0x3ff0_0000_0026_349c, 0xbfef_ffff_fbf0_74df, 0xbfef_ffff_fdfa_069b],
        [0xbfd0_0000_2b87_be46, 0xbfcf_ffff_aa54_b840, 0x3fcf_ffff_c09e_ef76],
        [0xbfd4_0003_eddb_caba, 0xbfd3_fffe_41ad_fa05, 0x3fd4_145a_973e_9011],
        [0xbfc8_0000_534d_329e, 0xbfc7_ffff_aa1b_421e, 0x3fd3_ffff_e933_ac04],
        [0xbfd0_0002_0766_a7dc, 0xbfcf_fff8_b24b_b8fb, 0x3fd0_601d_83a4_af71],
    ],
    // Nearly a hit: the edge functions have one sign, by 0.12 of their bound. [LANES-6]
    [
        [0xbfba_04cc_83ae_9581, 0x4000_f1b3_e412_9e90, 0x3fc0_e51f_37d0_69ac],
        [0xbff0_5b06_3d7f_b30c, 0xbfef_c764_0fb1_d3da, 0xbff0_21b5_2350_7cb1],
        [0xbff0_00f9_ef22_6be9, 0x3fef_ff69_7d78_cb73, 0xbfef_fed5_0683_d85c],
        [0xbfec_01f0_fbc6_d8fd, 0x3ff1_ffb7_8a2b_7dcd, 0xbff1_ff6b_d7bd_b584],
        [0xbff2_00f9_d45a_cc3b, 0x3ff1_ffb5_bdc1_cfea, 0xbfeb_fed4_db34_e8ff],
        [0xbff0_00f9_2f25_cf2d, 0x3ff0_cab6_7ab3_06b1, 0xbfef_fed6_43f6_56ca],
    ],
    // The distance has an error of 0.24 of its bound. [LANES-6]
    [
        [0xbff0_01d9_26ce_5689, 0xbff0_20f8_ce58_ef50, 0xbff0_2f79_7eb6_0cf9],
        [0xbff0_003c_5fe3_d848, 0xbfef_96ba_c336_c836, 0xbfef_b28f_0eb0_a92b],
        [0x3f32_c395_2ebb_4c00, 0x3fbf_8794_214d_d268, 0xbf3f_759b_9f9d_77ff],
        [0xbff0_59a1_0e5f_3510, 0xbfef_ffc9_c10f_fa19, 0x3ff0_0010_c11c_1e82],
        [0x3ff0_003c_5fe3_d848, 0xbfef_fd05_27e8_1912, 0xbfef_f6be_91a2_0621],
        [0xbf86_593c_4098_4f75, 0xbfa1_8c00_4987_c706, 0xbf86_6f10_beab_f682],
    ],
    // A quarter of the distance bound's term for the origin is too small. [LANES-6]
    [
        [0xbfef_f852_c694_5f80, 0xbff0_004c_c060_9856, 0xbff0_004c_4302_90a1],
        [0x4002_b410_bd23_463f, 0xc002_9018_8c7a_5be8, 0xbfd0_4319_2588_b2bd],
        [0x3ff0_0d54_50fb_1457, 0x3ff0_000e_3324_80d7, 0xbfee_dea9_9a60_2e67],
        [0xbff0_0000_184e_2762, 0xbff0_0001_1590_71b4, 0x3ff0_63fe_e8bf_f378],
        [0xbff0_00f2_cb02_aeee, 0xbff0_06c6_1488_6944, 0xc007_bd9e_3d09_582c],
        [0xbfef_a653_c8ee_da4c, 0xbfef_1a44_ee8e_2691, 0xbfef_173d_9269_6daa],
    ],
    // A hit is beyond its own distance by 0.22 of the bound. [LANES-4]
    [
        [0x3fef_fff6_3b96_6524, 0x3fef_b03a_09ac_3f35, 0x3ff0_2f72_4cf6_a697],
        [0xbfed_8973_9e36_0d9f, 0x3ff0_70f3_1b20_cbc8, 0xbff0_1ba5_94cc_1fd8],
        [0xbff0_0001_b5b8_c259, 0xbfed_f94d_fb18_0da0, 0xbff0_0014_0be1_1d00],
        [0xbfef_fff8_4de0_41db, 0x3ff3_a84e_c12a_c43a, 0x3ff0_0014_0bf0_0ea3],
        [0x3fef_ff09_4172_948e, 0x3ff3_a84e_412a_b6b3, 0x3ff0_06bc_6074_6ff1],
        [0x3fb5_2681_831c_0575, 0x3fc2_aea1_024a_de98, 0x3fb5_2673_201c_6f88],
    ],
];

/// [LANES-3] [LANES-4] [LANES-6]
#[test]
fn bounds_are_great_enough_for_the_worst() {
    for row in WORST {
        let [o, d, a, b, c, middle] = row.map(|bits| DVec3::from(bits.map(f64::from_bits)));
        let (ray, triangle) = (Ray::new(o, d).expect("a ray"), Triangle([a, b, c]));
        let region = region(&Frame::new(middle, 0).expect("a frame"), &[triangle]);
        let mut block = Block::EMPTY;
        block.set(0, &triangle, 0);
        let meeting = truth::meet([a, b, c].map(|v| v.to_array()), o.to_array(), d.to_array());
        let t = meeting.within([f64::MIN, f64::MAX]).map(|point| point.t);
        let best = t.as_ref().map_or(-1.0, truth::round_f64);
        for level in levels() {
            let Told { left, certain, ends: [lo, hi], .. } =
                dispatch!(level, simd => told(simd, &TriangleRay::double(simd, &ray, &region), &block, best));
            assert!(best < 0.0 || left & 1 == 1, "{ray:?} {triangle:?}");
            let [lo, hi] = [lo, hi].map(|ends| f64::from_bits(ends[0]));
            let is_true = t.as_ref().is_some_and(|t| exact(lo) <= *t && *t <= exact(hi));
            assert!(certain & 1 == 0 || is_true, "{ray:?} {triangle:?} {lo} {hi}");
        }
    }
}
