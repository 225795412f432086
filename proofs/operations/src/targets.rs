//! The functions that are printed.

/// A function.
pub(crate) struct Target {
    /// Its type, or its trait's, if it has one; and its name.
    pub(crate) owner: &'static str,
    pub(crate) name: &'static str,
    /// The file that it stands in.
    pub(crate) file: &'static str,
    /// What generic parameters stand for.
    pub(crate) known: &'static [(&'static str, &'static str)],
    /// What is printed of a result that has several parts; all, if this is empty.
    pub(crate) parts: &'static [&'static str],
}

/// Methods of a sum that are not looked into, with their names in Rocq.
pub(crate) const OPAQUE: &[(&str, &str)] = &[("add", "sum_add"), ("add_product", "Sum_add_product")];

const SINGLE: &[(&str, &str)] = &[("V", "Vec3"), ("V::Real", "f32")];
const TWO_SIDED: &[(&str, &str)] = &[("V", "Vec3"), ("V::Real", "f32"), ("PADDED", "true")];

const FILTER: &str = "src/geom/kernel/exact/filter.rs";
const SUM: &str = "src/geom/kernel/exact/sum.rs";
const PREDICATES: &str = "src/geom/kernel/exact/predicates.rs";
const STAGE: &str = "src/geom/kernel/exact/single.rs";

/// In the order in which they are printed.
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
    Target { owner: "Region", name: "of", file: "src/geom/region.rs", known: &[], parts: &["reach", "size"] },
    Target {
        owner: "Exact",
        name: "new",
        file: "src/geom/kernel/exact/mod.rs",
        known: SINGLE,
        parts: &["origin", "direction", "errors"],
    },
    Target { owner: "", name: "is_usual", file: "src/geom/kernel/exact/double.rs", known: &[], parts: &[] },
    Target { owner: "Doubled", name: "new", file: "src/geom/slabs/doubled.rs", known: &[], parts: &[] },
    Target { owner: "Doubled", name: "pair", file: "src/geom/slabs/doubled.rs", known: &[], parts: &[] },
    Target {
        owner: "Directed",
        name: "new",
        file: "src/geom/slabs/directed.rs",
        known: SINGLE,
        parts: &["origin", "inverse", "is_wide"],
    },
    Target { owner: "", name: "near_and_far", file: "src/geom/slabs/mod.rs", known: &[], parts: &[] },
    Target { owner: "Directed", name: "pair", file: "src/geom/slabs/directed.rs", known: &[], parts: &[] },
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
    Target { owner: "Sum", name: "add_product", file: SUM, known: &[], parts: &[] },
    Target { owner: "", name: "minus", file: PREDICATES, known: &[], parts: &[] },
    Target { owner: "", name: "add_edge", file: PREDICATES, known: &[], parts: &[] },
];
