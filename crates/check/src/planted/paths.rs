//! Rays that begin where others have hit, with the usual remedies, each of which is wrong somewhere.

use std::fmt::Debug;
use std::marker::PhantomData;

use glam::Vec3;

use super::draw::Draw;
use super::layers::{Instead, Mistake, marks};
use super::searches::built;
use crate::paths::{Exactly, Heading, Leg, Path, check_path};
use stackless_bvh::generate::Source;
use stackless_bvh::geom::truth::round_f32;
use stackless_bvh::geom::{Ends, ExactPoint, ExactRay};
use stackless_bvh::trace::{Assembly, InstanceHit, InstanceTracer};
use stackless_bvh::traverse::Method;

pub(super) const MISTAKES: [Mistake; 5] = [
    of::<Rounded>("the point of a hit is rounded to floats", "SECOND-1"),
    of::<Moved>("a ray begins a little in front of the point", "SECOND-1"),
    of::<OwnOnly>("of what holds the origin only the triangle that is left does not count", "SECOND-2"),
    of::<AllClosed>("ends belong to all rays", "SECOND-2"),
    of::<AllOpen>("ends belong to no ray", "SECOND-2"),
];

pub(super) const CONTROLS: [Mistake; 1] = [of::<Nothing>("exact paths, wrapped", "SECOND-2")];

const fn of<S: Spoil>(name: &'static str, clause: &'static str) -> Mistake {
    Mistake::new(name, clause, fault::<S>, Instead::Nothing("the suite's rays begin at points of floats"))
}

fn fault<S: Spoil>(draw: &mut Draw<'_>) -> Option<String> {
    let (mesh, rays) = draw.scene()?;
    let mut assembly = Assembly::new();
    let object = assembly.add_mesh(built(draw, &mesh)?);
    let tracer = InstanceTracer::new(&assembly, object, Method::default()).ok()?;
    let first = rays.first()?;
    let leg = |draw: &mut Draw<'_>, heading| Leg { heading, ends: if draw.coin() { Ends::Closed } else { Ends::Open } };
    let mut legs = vec![leg(draw, Heading::Along(first.direction(), f32::INFINITY))];
    for ray in &rays[1..] {
        legs.push(leg(draw, Heading::Along(ray.direction(), ray.tmax())));
    }
    let corner = mesh.vertices()[draw.below(mesh.vertices().len() as u64) as usize];
    legs.push(leg(draw, Heading::Toward(corner)));
    check_path(&Spoilt::<S>(PhantomData), &tracer, &mesh, first.origin(), &legs).err().map(|fault| fault.to_string())
}

marks! { Nothing Rounded Moved OwnOnly AllClosed AllOpen }

/// Paths with a mistake.
#[derive(Clone, Copy, Debug)]
struct Spoilt<S>(PhantomData<S>);

impl<S: Spoil> Path for Spoilt<S> {
    fn ray(&self, from: &ExactPoint, leg: &Leg) -> Option<ExactRay> {
        let place = || Vec3::from(from.rational().each_ref().map(round_f32));
        let (from, ends) = match S::BUG {
            Bug::Rounded => (ExactPoint::new(place()).ok()?, leg.ends),
            Bug::Moved => match leg.heading {
                Heading::Along(direction, _) => (ExactPoint::new(place() + direction * 1e-4).ok()?, leg.ends),
                Heading::Toward(target) => (ExactPoint::new(place() + (target - place()) * 1e-4).ok()?, leg.ends),
            },
            Bug::OwnOnly | Bug::AllClosed => (from.clone(), Ends::Closed),
            Bug::AllOpen => (from.clone(), Ends::Open),
            Bug::Nothing => (from.clone(), leg.ends),
        };
        Exactly.ray(&from, &Leg { ends, ..*leg })
    }

    fn closest(&self, tracer: &InstanceTracer, ray: &ExactRay, left: Option<u32>) -> Option<(InstanceHit, ExactPoint)> {
        let found = Exactly.closest(tracer, ray, left);
        found.filter(|(hit, _)| S::BUG != Bug::OwnOnly || left != Some(hit.prim))
    }
}
