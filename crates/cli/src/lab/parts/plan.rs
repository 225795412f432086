//! The savings of the plan of a binary hierarchy.

use std::error::Error;

use stackless_bvh::bvh::{BuildOptions, Bvh};
use stackless_bvh::geom::{Mesh, Ray};
use stackless_bvh::internals::trace::bounce;
use stackless_bvh::trace::{BinaryTracer, Part, Plan, QueryKind};
use stackless_bvh::traverse::Method;

use crate::savings::{self, Answers, Row, Setup};

/// Measures the decisions for any-hit and closest-hit queries by `hashed`.
pub(super) fn measure(mesh: &Mesh, bvh: &Bvh, rays: &[Ray]) -> Result<Vec<Row>, Box<dyn Error>> {
    let bounced = bounce(mesh, bvh, rays, 1);
    let mut rows = Vec::new();
    for (ask, rays) in [(QueryKind::Any, &*bounced), (QueryKind::Distance, rays)] {
        let lean = Plan::new(bvh, Method::Hashed, ask);
        let with_degenerate = lean.clone().with(Part::Degenerate).options(BuildOptions::default()).build(mesh)?;
        let setup = |plan: &Plan| {
            let bvh = if plan.restores(Part::Degenerate) { &with_degenerate } else { bvh };
            let tracer = BinaryTracer::planned(bvh, Method::Hashed, plan)?;
            let bytes = bvh.bytes() + tracer.bytes();
            let answers = move |rays: &[Ray]| {
                Answers::of(&tracer, ask, rays, |rays, found| tracer.closest_distances(rays, found))
            };
            Ok(Setup { bytes, answers: Box::new(answers) })
        };
        rows.extend(savings::measure(ask, rays, &lean, setup)?);
    }
    Ok(rows)
}
