//! Other ray tracers, as implementations of the level `ray`.

use serde_json::{Map, Value, json};
use stackless_peers::{Peer, Ray};
use stackless_suite::{Answer, Ask, Hello, Implementation, Level, Limits, PROTOCOL, Query};

pub(super) struct Foreign(pub(super) Peer);

pub(super) fn named(name: &str) -> Result<Peer, String> {
    let names = Peer::ALL.map(Peer::name);
    Peer::ALL
        .into_iter()
        .find(|peer| peer.name() == name)
        .ok_or_else(|| format!("expected one of {}", names.join(", ")))
}

impl Implementation for Foreign {
    fn hello(&self) -> Hello {
        Hello {
            protocol: PROTOCOL,
            name: self.0.name().to_owned(),
            version: String::new(),
            profiles: ["ray/grid", "ray/exact", "ray/watertight", "ray/ulp-8", "ray/ulp-256"]
                .map(ToOwned::to_owned)
                .to_vec(),
            features: Vec::new(),
            limits: Limits::default(),
        }
    }

    fn answer(&mut self, _: Level, _: &str, input: &Map<String, Value>) -> Answer {
        match hits(self.0, input) {
            Ok(hits) => Answer::Result([("hits".to_owned(), Value::Array(hits))].into_iter().collect()),
            Err(error) => Answer::Unsupported(error.to_string()),
        }
    }
}

fn hits(peer: Peer, input: &Map<String, Value>) -> Result<Vec<Value>, Box<dyn std::error::Error>> {
    let Ask::Ray(asked) = Ask::of(input)? else { return Err("no rays".into()) };
    // Invalid rays are rejected before they reach the peer.
    asked.read()?;
    let (vertices, rays) = asked.numbers()?;
    let tracer = peer.build(&vertices, &asked.triangles)?;
    let plain = |[a, b, c, x, y, z, tmin, tmax]: [f32; 8]| Ray { origin: [a, b, c], direction: [x, y, z], tmin, tmax };
    let rays: Vec<_> = rays.into_iter().map(plain).collect();
    Ok(match asked.query {
        Query::Parity => return Err("crossings are not counted".into()),
        Query::Closest => {
            let mut hits = vec![None; rays.len()];
            tracer.closest(&rays, &mut hits);
            let text = |(prim, t): (u32, f32)| json!({ "prim": prim, "t": format!("{:08x}", t.to_bits()) });
            hits.into_iter().map(|hit| hit.map_or(Value::Null, text)).collect()
        }
        Query::Any => {
            let mut hits = vec![false; rays.len()];
            tracer.any(&rays, &mut hits);
            hits.into_iter().map(Value::Bool).collect()
        }
    })
}
