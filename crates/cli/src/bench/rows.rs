//! The figures as printed and written.

use serde::Serialize;

use super::Contestant;
use super::rays::{Kind, Set};
use crate::input::Scene;
use crate::judge::Counts;
use crate::output::{Table, table};
use crate::turns::{Times, geometric_mean};

/// The figures of one contestant on one set of rays. Unknown figures are `None`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    scene: String,
    rays: Kind,
    /// The builder; `own` for a peer.
    build: String,
    method: &'static str,
    /// The level of accuracy; `own` for a peer.
    accuracy: &'static str,
    /// Number of timed rays in each round.
    count: usize,
    mrays: f64,
    ratio: f64,
    state_bytes: Option<usize>,
    nodes_per_ray: Option<f64>,
    /// Million triangles per second and thread, for the tree without tables.
    build_mtriangles: f64,
    #[serde(flatten)]
    errors: Option<Errors>,
}

/// The errors of the judged rays.
#[derive(Clone, Copy, Debug, Serialize)]
struct Errors {
    judged: u64,
    false_misses: u64,
    false_hits: u64,
    wrong_primitives: u64,
    p999_ulp: Option<u32>,
    max_ulp: Option<u32>,
}

impl Row {
    pub(super) fn new(scene: &Scene, set: &Set, contestant: &dyn Contestant) -> Self {
        Self {
            scene: scene.name.clone(),
            rays: set.kind,
            build: contestant.build().map_or_else(|| "own".to_owned(), |build| build.to_string()),
            method: contestant.method(),
            accuracy: contestant.tests(),
            count: set.rays.len(),
            mrays: f64::NAN,
            ratio: f64::NAN,
            state_bytes: contestant.state_bytes(),
            nodes_per_ray: None,
            build_mtriangles: scene.mesh.triangles().len() as f64 / contestant.build_seconds() / 1e6,
            errors: None,
        }
    }

    /// Adds the times of contestant `own`, compared with those of contestant `base`.
    pub(super) fn timed(self, times: &Times, own: usize, base: usize) -> Self {
        let [own, base] = [own, base].map(|contestant| times.by_chunk(contestant).iter().sum::<f64>());
        Self { mrays: self.count as f64 / own / 1e6, ratio: base / own, ..self }
    }

    /// Adds the number of nodes that all rays visit.
    pub(super) fn counted(self, nodes: Option<u64>) -> Self {
        Self { nodes_per_ray: nodes.map(|nodes| nodes as f64 / self.count as f64), ..self }
    }

    pub(super) fn judged(self, counts: Option<&Counts>) -> Self {
        let errors = counts.map(|counts| Errors {
            judged: counts.rays,
            false_misses: counts.false_misses,
            false_hits: counts.false_hits,
            wrong_primitives: counts.wrong_primitives,
            p999_ulp: counts.quantile(0.999),
            max_ulp: counts.quantile(1.0),
        });
        Self { errors, ..self }
    }

    fn is_as(&self, other: &Self) -> bool {
        (&self.build, self.method, self.accuracy) == (&other.build, other.method, other.accuracy)
    }
}

/// All rows of a scene.
pub(super) fn of_scene(rows: &[Row]) -> Table {
    let mut header =
        vec!["scene", "rays", "build", "method", "accuracy", "Mrays/s", "ratio", "state bytes", "nodes/ray"];
    header.push("build Mtri/s");
    header.extend(["judged", "wrong", "max ulp"]);
    let cells = |row: &Row| {
        let names = [&row.scene, row.rays.name(), &row.build, row.method, row.accuracy].map(str::to_owned);
        let mut cells = names.to_vec();
        cells.extend([format!("{:.3}", row.mrays), format!("{:.3}", row.ratio), or_dash(row.state_bytes)]);
        cells.push(or_dash(row.nodes_per_ray.map(|nodes| format!("{nodes:.1}"))));
        cells.push(format!("{:.2}", row.build_mtriangles));
        let errors = row.errors.as_ref();
        let wrong = errors.map(|e| e.false_misses + e.false_hits + e.wrong_primitives);
        cells.extend([or_dash(errors.map(|e| e.judged)), or_dash(wrong)]);
        cells.push(or_dash(errors.and_then(|e| e.max_ulp)));
        cells
    };
    table(&header, 5, rows.iter().map(cells).collect())
}

/// Geometric means of the ratios of each contestant, over the scenes: for each kind of rays, and for all rays.
pub(super) fn means(rows: &[Row]) -> Table {
    let mut kinds = Vec::new();
    for row in rows {
        if !kinds.contains(&row.rays) {
            kinds.push(row.rays);
        }
    }
    let header = ["geometric means of", "build", "accuracy"].into_iter().chain(kinds.iter().map(|kind| kind.name()));
    let header: Vec<_> = header.chain(["all", "least", "build Mtri/s"]).collect();
    let mut lines = Vec::new();
    for (i, first) in rows.iter().enumerate() {
        if rows[..i].iter().any(|row| row.is_as(first)) {
            continue;
        }
        let own: Vec<_> = rows.iter().filter(|row| row.is_as(first)).collect();
        let ratios = |kind: Option<Kind>| {
            let of_kind = own.iter().filter(move |row| kind.is_none_or(|kind| row.rays == kind));
            of_kind.map(|row| row.ratio)
        };
        let number = |x: Option<f64>| or_dash(x.map(|x| format!("{x:.3}")));
        let mut line = vec![first.method.to_owned(), first.build.clone(), first.accuracy.to_owned()];
        line.extend(kinds.iter().map(|&kind| number(geometric_mean(ratios(Some(kind))))));
        line.extend([number(geometric_mean(ratios(None))), number(ratios(None).reduce(f64::min))]);
        line.push(or_dash(geometric_mean(own.iter().map(|row| row.build_mtriangles)).map(|x| format!("{x:.2}"))));
        lines.push(line);
    }
    table(&header, 3, lines)
}

fn or_dash(what: Option<impl ToString>) -> String {
    what.map_or_else(|| "-".to_owned(), |what| what.to_string())
}
