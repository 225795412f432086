//! The traced rays.

use serde::Serialize;
use stackless_bvh::bvh::Bvh;
use stackless_bvh::generate::stress;
use stackless_bvh::geom::Ray;
use stackless_bvh::internals::trace::{bounce, cut};

use crate::input::Scene;
use crate::judge::Query;

/// The kind of rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub(super) enum Kind {
    /// Closest hits of camera rays, row by row.
    Primary,
    /// Any hit of rays from the camera rays' hits: ambient occlusion within a tenth of the scene's diagonal.
    Any,
    /// Closest hits of unbounded rays from the camera rays' hits.
    Diffuse,
    /// Closest hits of rays at edges, corners and planes, where rounding errs.
    Aimed,
}

impl Kind {
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Primary => "primary",
            Self::Any => "any",
            Self::Diffuse => "diffuse",
            Self::Aimed => "aimed",
        }
    }
}

/// Rays of one kind.
pub(super) struct Set {
    pub(super) kind: Kind,
    pub(super) query: Query,
    pub(super) rays: Vec<Ray>,
}

/// The length of occlusion rays, in diagonals of the scene. Unbounded rays would all hit in a closed room.
const REACH: f32 = 0.1;

/// Sets of these kinds: camera rays, one ray from each of their hits, and an equal number of aimed rays.
///
/// Occlusion rays have the directions of the diffuse rays (cosine distribution, like Binder & Keller and Barringer &
/// Akenine-Möller).
pub(super) fn sets(scene: &Scene, bvh: &Bvh, primary: Vec<Ray>, kinds: Vec<Kind>, seed: u64) -> Vec<Set> {
    let diffuse = bounce(&scene.mesh, bvh, &primary, seed);
    let reach = REACH * bvh.bounds().extent().length();
    let set = |kind| match kind {
        Kind::Primary => Set { kind, query: Query::Closest, rays: primary.clone() },
        Kind::Any => Set { kind, query: Query::Any, rays: diffuse.iter().filter_map(|ray| cut(ray, reach)).collect() },
        Kind::Diffuse => Set { kind, query: Query::Closest, rays: diffuse.clone() },
        Kind::Aimed => Set { kind, query: Query::Closest, rays: stress::aimed(&scene.mesh, seed, primary.len()) },
    };
    kinds.into_iter().map(set).collect()
}

#[cfg(test)]
mod tests {
    use stackless_bvh::generate::procedural::{self, View};

    use super::*;

    #[test]
    fn occlusion_rays_are_the_diffuse_ones_cut_at_a_tenth_of_the_diagonal() {
        let scene = Scene { name: "soup".to_owned(), mesh: procedural::soup(1, 500), faces: Vec::new() };
        let bvh = Bvh::median(&scene.mesh, 4).unwrap();
        let rays = View::of(&scene.mesh).rays(400);
        let sets = sets(&scene, &bvh, rays, vec![Kind::Diffuse, Kind::Primary, Kind::Any], 1);
        let [diffuse, primary, any] = sets.as_slice() else { panic!() };
        assert_eq!((primary.rays.len(), primary.query), (400, Query::Closest));
        assert_eq!((diffuse.query, any.query), (Query::Closest, Query::Any));
        assert!(!any.rays.is_empty() && any.rays.len() == diffuse.rays.len() && diffuse.rays.len() < 400);
        let tenth = 0.1 * bvh.bounds().extent().length();
        for (short, long) in any.rays.iter().zip(&diffuse.rays) {
            assert_eq!((short.origin(), short.direction()), (long.origin(), long.direction()));
            assert!((short.tmax() * short.direction().length() / tenth - 1.0).abs() < 1e-6);
            assert_eq!(long.tmax(), f32::INFINITY);
        }
    }
}
