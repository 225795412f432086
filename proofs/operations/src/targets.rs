//! The functions that are printed.

/// A function.
pub(crate) struct Target {
    /// Its type or trait, if any, and its name.
    pub(crate) owner: &'static str,
    pub(crate) name: &'static str,
    /// Its file.
    pub(crate) file: &'static str,
    /// The values of generic parameters.
    pub(crate) known: &'static [(&'static str, &'static str)],
    /// The printed parts of a result with several parts, or empty for all parts.
    pub(crate) parts: &'static [&'static str],
}

/// One of four lanes. Rows of lanes and vectors then become numbers.
const LANE: &[(&str, &str)] = &[
    ("S", "simd"),
    ("V", "Vec3"),
    ("V::Real", "f32"),
    ("BoxRay::V", "f32"),
    ("::V", "f32"),
    ("A", "4"),
    ("F", "f32"),
    ("R", "f32"),
    ("Lanes", "f32"),
    ("V::Lanes<S>", "f32"),
    ("f32x4", "f32"),
    ("f32x4<S>", "f32"),
    ("[f32;4]", "f32"),
    ("[R;4]", "f32"),
    ("[V::Real;4]", "f32"),
    ("[f32;A]", "f32"),
    ("usize", "side"),
    ("lane_numbers", "unknown"),
    ("entered_if", "unknown"),
    ("Option", "unknown"),
    ("self_is_wide", "false"),
];
const SINGLE: &[(&str, &str)] = &[("V", "Vec3"), ("V::Real", "f32")];
const SLABS: &[(&str, &str)] =
    &[("V", "Vec3"), ("V::Real", "f32"), ("enter_if", "unknown"), ("Entrance", "unknown"), ("self_is_wide", "false")];
const TWO_SIDED: &[(&str, &str)] = &[("V", "Vec3"), ("V::Real", "f32"), ("PADDED", "true")];

const FILTER: &str = "src/geom/kernel/exact/filter.rs";
const SUM: &str = "src/geom/kernel/exact/sum.rs";
const PREDICATES: &str = "src/geom/kernel/exact/predicates.rs";
const STAGE: &str = "src/geom/kernel/exact/single.rs";
const INTERVAL: &str = "src/geom/interval.rs";
const EXACT: &str = "src/geom/kernel/exact/mod.rs";
const BOXES: &str = "src/geom/lanes/boxes.rs";
const TRIANGLES: &str = "src/geom/lanes/triangles.rs";
const FINE: &str = "src/geom/fine.rs";
const FINE_STAGE: &str = "src/geom/kernel/exact/fine.rs";
const NEAREST: &str = "src/geom/nearest.rs";

/// The functions, in the order of printing.
pub(crate) const TARGETS: &[Target] = &[
    Target { owner: "Determinants", name: "of", file: FILTER, known: &[], parts: &[] },
    Target { owner: "Errors", name: "new", file: FILTER, known: &[], parts: &[] },
    Target { owner: "Determinants", name: "is_miss", file: FILTER, known: &[], parts: &[] },
    Target { owner: "Determinants", name: "is_hit", file: FILTER, known: &[], parts: &[] },
    Target { owner: "Determinants", name: "over_determinant", file: FILTER, known: &[], parts: &[] },
    Target { owner: "Determinants", name: "distance", file: FILTER, known: &[], parts: &[] },
    Target { owner: "Determinants", name: "weights", file: FILTER, known: &[], parts: &[] },
    Target { owner: "Errors", name: "of_triangle", file: FILTER, known: &[], parts: &[] },
    Target { owner: "Errors", name: "of_scene", file: FILTER, known: &[], parts: &[] },
    Target { owner: "Errors", name: "within", file: FILTER, known: &[], parts: &[] },
    Target { owner: "Errors", name: "of_triangle_within", file: FILTER, known: &[], parts: &[] },
    Target { owner: "", name: "is_certain", file: EXACT, known: &[("R", "f32")], parts: &[] },
    Target { owner: "", name: "is_within", file: EXACT, known: &[("R", "f32")], parts: &[] },
    Target {
        owner: "Region",
        name: "of",
        file: "src/geom/region.rs",
        known: &[("near_of", "unknown")],
        parts: &["reach", "size"],
    },
    Target { owner: "Exact", name: "new", file: EXACT, known: SINGLE, parts: &["origin", "direction", "errors"] },
    Target { owner: "Doubled", name: "new", file: "src/geom/slabs/doubled.rs", known: &[], parts: &[] },
    Target { owner: "Doubled", name: "pair", file: "src/geom/slabs/doubled.rs", known: &[], parts: &[] },
    Target {
        owner: "Directed",
        name: "new",
        file: "src/geom/slabs/directed.rs",
        known: SLABS,
        parts: &["origin", "inverse", "is_wide"],
    },
    Target { owner: "", name: "near_and_far", file: "src/geom/slabs/mod.rs", known: &[], parts: &[] },
    Target { owner: "Directed", name: "pair", file: "src/geom/slabs/directed.rs", known: SLABS, parts: &[] },
    Target { owner: "Centred", name: "new", file: "src/geom/slabs/centred.rs", known: TWO_SIDED, parts: &[] },
    Target { owner: "Centred", name: "pair", file: "src/geom/slabs/centred.rs", known: TWO_SIDED, parts: &[] },
    Target { owner: "ExactFromSingle", name: "misses", file: STAGE, known: SINGLE, parts: &[] },
    Target {
        owner: "ExactFromSingle",
        name: "new",
        file: STAGE,
        known: SINGLE,
        parts: &["origin", "direction", "bound"],
    },
    Target { owner: "", name: "two_sum", file: SUM, known: &[], parts: &[] },
    Target { owner: "", name: "split", file: SUM, known: &[], parts: &[] },
    Target { owner: "", name: "two_product", file: SUM, known: &[], parts: &[] },
    Target { owner: "Interval", name: "add", file: INTERVAL, known: &[], parts: &[] },
    Target { owner: "Interval", name: "neg", file: INTERVAL, known: &[], parts: &[] },
    Target { owner: "Interval", name: "middle_and_radius", file: INTERVAL, known: &[], parts: &[] },
    Target { owner: "Interval", name: "ends_in_single", file: INTERVAL, known: &[], parts: &[] },
    Target { owner: "Fine", name: "new", file: FINE, known: &[], parts: &[] },
    Target { owner: "Fine", name: "is_within", file: FINE, known: &[], parts: &[] },
    Target { owner: "Fine", name: "sign", file: FINE, known: &[], parts: &[] },
    Target { owner: "Fine", name: "bounds", file: FINE, known: &[], parts: &[] },
    Target { owner: "Fine", name: "add", file: FINE, known: &[], parts: &[] },
    Target { owner: "Fine", name: "neg", file: FINE, known: &[], parts: &[] },
    Target { owner: "Fine", name: "sub", file: FINE, known: &[], parts: &[] },
    Target { owner: "Fine", name: "mul", file: FINE, known: &[], parts: &[] },
    Target { owner: "Fine", name: "hull", file: FINE, known: &[], parts: &[] },
    Target { owner: "Fine", name: "over", file: FINE, known: &[], parts: &[] },
    Target { owner: "Fine", name: "root", file: FINE, known: &[], parts: &[] },
    Target { owner: "", name: "volume", file: FINE_STAGE, known: &[], parts: &[] },
    Target { owner: "", name: "minus", file: FINE_STAGE, known: &[], parts: &[] },
    Target { owner: "", name: "dot", file: FINE_STAGE, known: &[], parts: &[] },
    Target { owner: "", name: "cross", file: FINE_STAGE, known: &[], parts: &[] },
    Target { owner: "FineDeterminants", name: "of", file: FINE_STAGE, known: &[], parts: &[] },
    Target { owner: "FineDeterminants", name: "distance_within", file: FINE_STAGE, known: &[("R", "f64")], parts: &[] },
    Target { owner: "FineDeterminants", name: "weights", file: FINE_STAGE, known: &[("R", "f64")], parts: &[] },
    Target { owner: "FineDeterminants", name: "within_range", file: FINE_STAGE, known: &[], parts: &[] },
    Target { owner: "f32", name: "between", file: "src/geom/vector.rs", known: &[], parts: &[] },
    Target { owner: "", name: "minus", file: PREDICATES, known: &[], parts: &[] },
    Target {
        owner: "BoxRay",
        name: "new",
        file: BOXES,
        known: LANE,
        parts: &["origin", "near", "far", "side", "tmin", "is_wide"],
    },
    Target { owner: "BoxRay", name: "enter", file: BOXES, known: LANE, parts: &["1"] },
    Target { owner: "", name: "longest", file: "src/geom/lanes/block.rs", known: SINGLE, parts: &[] },
    Target { owner: "TriangleRay", name: "new", file: TRIANGLES, known: LANE, parts: &[] },
    Target { owner: "TriangleRay", name: "survivors", file: TRIANGLES, known: LANE, parts: &[] },
    Target { owner: "", name: "nearest", file: NEAREST, known: &[], parts: &[] },
    Target { owner: "", name: "bounds", file: NEAREST, known: &[], parts: &[] },
];
