//! Closed spheres, seen from inside. Every ray must hit.

use std::collections::HashSet;
use std::ops::Range;

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use stackless_bvh::generate::stress;
use stackless_bvh::geom::{Mesh, Ray};
use stackless_bvh::internals::trace::Truth;

use super::pairs::{Pair, Trees};
use super::rows::{Kind, Row};
use crate::judge::{Query, csv_line};
use crate::output::bar;
use crate::record::Numbered;

/// Radius and offset of each sphere, of 81,920 triangles. If the offset is much greater than the radius, most corners
/// coincide, but the sphere remains closed.
const SPHERES: [(f32, f32); 6] = [(1.0, 0.0), (1.0, 1e3), (1.0, 1e6), (100.0, 0.0), (100.0, 1e3), (100.0, 1e6)];
const LEVEL: u32 = 6;

/// Origins of the rays, in radii from the centre.
const ORIGINS: [Vec3; 4] =
    [Vec3::ZERO, Vec3::new(0.3, -0.2, 0.1), Vec3::new(-0.5, 0.5, 0.25), Vec3::new(0.7, 0.3, -0.55)];

/// Aims at this share of the corners and midpoints of edges of each sphere. A leak is a ray that truly hits, but that a
/// pair misses. (An origin may be rounded to the outside of a tiny sphere, so the truth decides.) `part` selects the
/// rays of a sphere, given their number.
pub(super) fn count(
    pairs: &[Pair],
    share: f64,
    part: &mut dyn FnMut(&str, u64) -> Range<u64>,
) -> Result<Vec<Row>, Box<dyn std::error::Error>> {
    let mut rows = Vec::new();
    for (radius, offset) in SPHERES {
        let name = format!("sphere {radius} + {offset:e}");
        let mesh = stress::icosphere(LEVEL, radius, Vec3::splat(offset))?;
        let (trees, truth) = (Trees::new(&mesh)?, Truth::new(&mesh));
        let mut rays = rays(&mesh, radius, offset, share);
        let numbers = part(&name, rays.len() as u64);
        rays.truncate(numbers.end as usize);
        rays.drain(..numbers.start as usize);
        let progress = bar(rays.len() as u64, &name);
        // Bit p is set if pair p misses, and the last bit if the ray truly hits. Only rays that some pair misses need
        // the truth.
        let missed = |memory: &mut Vec<_>, ray: &Ray| {
            let misses = |pair: &Pair| pair.answer(Query::Closest, &trees, ray, memory).is_none();
            let mut bits =
                pairs.iter().map(misses).enumerate().fold(0_u32, |bits, (p, miss)| bits | u32::from(miss) << p);
            if bits != 0 {
                bits |= u32::from(truth.any(ray)) << pairs.len();
            }
            progress.inc(1);
            bits
        };
        let missed: Vec<_> = rays.par_iter().with_min_len(256).map_init(Vec::new, missed).collect();
        progress.finish_and_clear();
        for (p, pair) in pairs.iter().enumerate() {
            let leak = 1 << p | 1 << pairs.len();
            let count = |bits: u32| missed.iter().filter(|&&missed| missed & bits == bits).count() as u64;
            let leaking = missed.iter().position(|&missed| missed & leak == leak).filter(|_| pair.is_exact());
            let offence = leaking.map(|i| {
                let what = format!("{name}: {} with {} leaks: {}", pair.kernel, pair.slabs, csv_line(&rays[i]));
                Numbered { number: numbers.start + i as u64, found: what }
            });
            let row = Row::new(&name, "from inside", Kind::Closed, pair);
            let row = row.leaked(rays.len() as u64, count(leak), count(1 << p));
            rows.push(Row { offence, ..row });
        }
    }
    Ok(rows)
}

/// Rays from each origin to each corner and to the midpoint of each edge, rounded to single precision.
fn rays(mesh: &Mesh, radius: f32, offset: f32, share: f64) -> Vec<Ray> {
    let mut edges = HashSet::new();
    let middles = mesh.triangles().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).filter_map(|[a, b]| {
        let vertex = |i: u32| mesh.vertices()[i as usize].as_dvec3();
        edges.insert([a.min(b), a.max(b)]).then(|| DVec3::midpoint(vertex(a), vertex(b)).as_vec3())
    });
    let aims: Vec<_> = mesh.vertices().iter().copied().chain(middles).collect();
    let wanted = ((aims.len() as f64 * share).ceil() as usize).min(aims.len());
    let aims = (0..wanted).map(|i| aims[i * aims.len() / wanted]);
    let from = ORIGINS.map(|origin| Vec3::splat(offset) + origin * radius);
    let ray = |origin: Vec3, aim: Vec3| Ray::new(origin, aim - origin).ok();
    aims.flat_map(|aim| from.map(|origin| ray(origin, aim))).flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_corner_and_every_middle_is_aimed_at_from_every_origin() {
        let mesh = stress::icosphere(2, 1.0, Vec3::ZERO).unwrap();
        let (corners, edges) = (162, 480);
        assert_eq!(rays(&mesh, 1.0, 0.0, 1.0).len(), 4 * (corners + edges));
        assert_eq!(rays(&mesh, 1.0, 0.0, 0.5).len(), 2 * (corners + edges));
        assert_eq!(rays(&mesh, 1.0, 0.0, 1e-9).len(), 4);
        let truth = Truth::new(&mesh);
        assert!(rays(&mesh, 1.0, 0.0, 0.2).iter().all(|ray| truth.all(ray).len() % 2 == 1 || truth.any(ray)));
    }
}
