//! The counts, as they are written to files.

use std::fmt::Write as _;

use serde::Serialize;
use stackless_bvh::trace::Accuracy;

use super::pairs::Pair;
use super::timing::Time;
use crate::judge::Counts;

/// What a set of rays is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Kind {
    /// What renderers trace.
    Ordinary,
    /// Aimed at what rounding gets wrong.
    Adversarial,
    /// From inside of a closed mesh: every ray hits.
    Closed,
}

/// A pair of tests on one set of rays through one scene. What was not asked is `None`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    pub(super) scene: String,
    pub(super) set: &'static str,
    pub(super) kind: Kind,
    pub(super) kernel: &'static str,
    #[serde(rename = "box")]
    pub(super) slabs: &'static str,
    pub(super) level: Option<&'static str>,
    pub(super) rays: u64,
    pub(super) hits: Option<u64>,
    pub(super) false_misses: Option<u64>,
    pub(super) false_hits: Option<u64>,
    pub(super) wrong_primitives: Option<u64>,
    pub(super) order_differences: Option<u64>,
    pub(super) leaks: Option<u64>,
    pub(super) misses: Option<u64>,
    pub(super) max_ulp: Option<u32>,
    pub(super) p999_ulp: Option<u32>,
    pub(super) mean_ulp: Option<f64>,
    pub(super) timed_rays: Option<u64>,
    pub(super) ns_per_ray: Option<f64>,
    pub(super) mrays: Option<f64>,
    pub(super) ratio: Option<f64>,
}

impl Row {
    pub(super) fn new(scene: &str, set: &'static str, kind: Kind, pair: &Pair) -> Self {
        Self {
            scene: scene.to_owned(),
            set,
            kind,
            kernel: pair.kernel.name(),
            slabs: pair.slabs.name(),
            level: pair.level().map(Accuracy::name),
            rays: 0,
            hits: None,
            false_misses: None,
            false_hits: None,
            wrong_primitives: None,
            order_differences: None,
            leaks: None,
            misses: None,
            max_ulp: None,
            p999_ulp: None,
            mean_ulp: None,
            timed_rays: None,
            ns_per_ray: None,
            mrays: None,
            ratio: None,
        }
    }

    pub(super) fn judged(self, counts: &Counts) -> Self {
        Self {
            rays: counts.rays,
            hits: Some(counts.hits),
            false_misses: Some(counts.false_misses),
            false_hits: Some(counts.false_hits),
            wrong_primitives: Some(counts.wrong_primitives),
            order_differences: Some(counts.order_differences),
            max_ulp: counts.quantile(1.0),
            p999_ulp: counts.quantile(0.999),
            mean_ulp: counts.mean(),
            ..self
        }
    }

    pub(super) fn timed(self, time: Option<&Time>) -> Self {
        let Some(time) = time else { return self };
        Self {
            timed_rays: Some(time.rays),
            ns_per_ray: Some(time.nanoseconds),
            mrays: Some(1e3 / time.nanoseconds),
            ratio: Some(time.ratio),
            ..self
        }
    }

    /// `misses` counts the leaks, and the rays that truly miss.
    pub(super) fn leaked(self, rays: u64, leaks: u64, misses: u64) -> Self {
        Self { rays, leaks: Some(leaks), misses: Some(misses), ..self }
    }
}

/// A line of names, and one for each row; what was not asked is empty.
pub(super) fn csv(rows: &[Row]) -> String {
    let mut text = "scene,set,kind,kernel,box,level,rays,hits,false_misses,false_hits,wrong_primitives,\
                    order_differences,leaks,misses,max_ulp,p999_ulp,mean_ulp,timed_rays,ns_per_ray,mrays,ratio\n"
        .to_owned();
    for row in rows {
        let kind = match row.kind {
            Kind::Ordinary => "ordinary",
            Kind::Adversarial => "adversarial",
            Kind::Closed => "closed",
        };
        let counts = [row.hits, row.false_misses, row.false_hits, row.wrong_primitives, row.order_differences];
        let counts = counts.into_iter().chain([row.leaks, row.misses]).map(or_nothing);
        let ulps = [row.max_ulp.map(f64::from), row.p999_ulp.map(f64::from), row.mean_ulp].into_iter().map(or_nothing);
        let times = [row.ns_per_ray, row.mrays, row.ratio].into_iter().map(or_nothing);
        let names = [&*quoted(&row.scene), row.set, kind, row.kernel, row.slabs, row.level.unwrap_or("")].join(",");
        let numbers: Vec<_> = counts.chain(ulps).chain([or_nothing(row.timed_rays)]).chain(times).collect();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{names},{},{}", row.rays, numbers.join(","));
    }
    text
}

fn or_nothing(number: Option<impl ToString>) -> String {
    number.map_or_else(String::new, |number| number.to_string())
}

/// As RFC 4180 has it, where a scene's name needs it.
fn quoted(name: &str) -> String {
    if name.contains([',', '"', '\n', '\r']) { format!("\"{}\"", name.replace('"', "\"\"")) } else { name.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_as_many_fields_as_there_are_names() {
        let row = Row::new("a, \"b\"", "any", Kind::Ordinary, &Pair::all()[0]).leaked(7, 1, 2);
        let text = csv(&[row]);
        let lines: Vec<_> = text.lines().collect();
        assert!(lines[1].starts_with("\"a, \"\"b\"\"\",any,ordinary,affine,plain,fast,7,,,,,,1,2,,"), "{text}");
        assert_eq!(lines[0].split(',').count(), lines[1].split(',').count() - 1);
    }
}
