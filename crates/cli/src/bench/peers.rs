//! Other ray tracers.

use stackless_bvh::bvh::Builder;
use stackless_bvh::geom::{Mesh, Ray};
use stackless_bvh::internals::trace::Accuracy;
use stackless_peers as peers;

use super::{Contestant, timed};
use crate::judge::{Answer, Query};

/// Builds all available peers. A note gives the reason for each missing peer.
pub(super) fn build(mesh: &Mesh, notes: &mut Vec<String>) -> Vec<Box<dyn Contestant>> {
    let vertices = vertices(mesh);
    let mut built = Vec::<Box<dyn Contestant>>::new();
    for peer in peers::Peer::ALL {
        match timed(|| peer.build(&vertices, mesh.triangles())) {
            Ok((tracer, build_seconds)) => {
                built.push(Box::new(Foreign { peer, tracer, build_seconds, rays: Vec::new(), blocked: Vec::new() }));
            }
            Err(error @ peers::PeerError::NotInstalled(_)) => notes.push(error.to_string()),
            Err(error) => notes.push(format!("{}: {error}", peer.name())),
        }
    }
    built
}

/// Vertices in the format of peers.
pub(crate) fn vertices(mesh: &Mesh) -> Vec<[f32; 3]> {
    mesh.vertices().iter().map(glam::Vec3::to_array).collect()
}

/// A ray in the format of peers.
pub(crate) fn plain(ray: &Ray) -> peers::Ray {
    peers::Ray {
        origin: ray.origin().to_array(),
        direction: ray.direction().to_array(),
        tmin: ray.tmin(),
        tmax: ray.tmax(),
    }
}

struct Foreign {
    peer: peers::Peer,
    tracer: Box<dyn peers::Tracer>,
    build_seconds: f64,
    /// The prepared rays.
    rays: Vec<peers::Ray>,
    /// Buffer for answers.
    blocked: Vec<bool>,
}

impl Contestant for Foreign {
    fn method(&self) -> &'static str {
        self.peer.name()
    }

    fn build(&self) -> Option<Builder> {
        None
    }

    fn accuracy(&self) -> Option<Accuracy> {
        None
    }

    fn take(&mut self, rays: &[Ray]) {
        self.rays = rays.iter().map(plain).collect();
        self.blocked = vec![false; rays.len()];
    }

    fn trace(&mut self, query: Query, rays: &[Ray], first: usize, answers: &mut [Answer]) {
        let rays = &self.rays[first..first + rays.len()];
        match query {
            Query::Closest => self.tracer.closest(rays, answers),
            Query::Any => {
                let blocked = &mut self.blocked[..rays.len()];
                self.tracer.any(rays, blocked);
                // Peers do not report the triangle.
                for (answer, &blocked) in answers.iter_mut().zip(&*blocked) {
                    *answer = blocked.then_some((0, 0.0));
                }
            }
        }
    }

    fn nodes(&mut self, _: Query, _: &[Ray]) -> Option<u64> {
        None
    }

    fn state_bytes(&self) -> Option<usize> {
        None
    }

    fn build_seconds(&self) -> f64 {
        self.build_seconds
    }
}
