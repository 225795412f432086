//! Planted bugs: one change of text each, which the comparison has to see.

use stackless_bvh::bvh::{Bvh, SahOptions};
use stackless_bvh::trace::Tracer;

use crate::kernel::Kernel;
use crate::made::{self, Made};
use crate::scene::{Query, Scene};
use crate::tapes::{self, Batch};
use crate::{Gpu, GpuError, probe, rays};

/// A mistake in a kernel.
#[derive(Clone, Copy, Debug)]
pub struct Bug {
    /// What is wrong.
    pub name: &'static str,
    /// The kernel, by its full name.
    pub kernel: &'static str,
    /// What stands in its text.
    pub from: &'static str,
    /// What is planted.
    pub to: &'static str,
}

macro_rules! bugs {
    ($($name:literal, $kernel:literal: $from:literal => $to:literal;)*) => {
        &[$(Bug { name: $name, kernel: $kernel, from: $from, to: $to }),*]
    };
}

/// All of them.
pub const BUGS: &[Bug] = bugs! {
    "the key is shifted by one level too many", "hashed":
        "key = word_toggle(word_shift(key, levels))" => "key = word_toggle(word_shift(key, levels + 1u))";
    "the trail is shifted by one level too few", "hashed":
        "trail = word_toggle(word_shift(trail, levels))" => "trail = word_toggle(word_shift(trail, max(levels, 1u) - 1u))";
    "the trail is not toggled", "hashed":
        "trail = word_toggle(word_shift(trail, levels))" => "trail = word_shift(trail, levels)";
    "the key is not toggled", "hashed-printed":
        "key = word_toggle(word_shift(key, levels))" => "key = word_shift(key, levels)";
    "the address in the table of displacements is not extended by its sign", "hashed":
        "bitcast<u32>(bitcast<i32>(entry << 1u) >> 1u)" => "(entry << 1u) >> 1u";
    "direct addresses are taken for displacements", "hashed":
        "return (entry >> 31u) == 1u;" => "return false;";
    "the key is not reduced", "hashed-printed":
        "mixed % TABLE_SIZE" => "mixed";
    "the sum is not reduced", "hashed":
        "min(sum, sum - TABLE_SIZE)" => "sum";
    "the wrong displacement", "hashed-printed":
        "(mixed & DIRECT_MASK)" => "((mixed >> 1u) & DIRECT_MASK)";
    "no bijection where the plain hash fails", "hashed-printed":
        "mixed = mix_narrow(key ^ SEED.x);" => "";
    "the register is kept after it is used", "hashed":
        "node = latest;\n            latest = 0u;" => "node = latest;";
    "the register holds the wrong child", "hashed":
        "latest = second_child(record, descent);" => "latest = first_child(record, descent);";
    "the grand uncle is taken before the uncle", "hashed":
        "named = select(named, links.x, (pending & 2u) != 0u)" =>
        "named = select(named, links.x, (pending & 6u) == 2u)";
    "the uncle counts as postponed when the sibling is", "hashed-printed":
        "(pending & 2u)" => "(word_low(trail) & 1u)";
    "leaves are taken to name two nodes, and the table holds the keys for three", "hashed":
        "const LEAF_REACH = 14u;" => "const LEAF_REACH = 6u;";
    "the register is not emptied when its node is masked", "hashed-disjoint":
        "if word_is_zero(kept) || word_zeros(kept) != word_zeros(trail) {" => "if false {";
    "the register is filled before the mask", "hashed-disjoint":
        "cursor_prune();\n        }\n        cursor_load(links, LEAF_REACH);\n        cursor_backtrack(links, LEAF_REACH);" =>
        "fill(links, LEAF_REACH); cursor_prune(); } else { fill(links, LEAF_REACH); } cursor_backtrack(links, 0u);";
    "the second trail is not shifted", "hashed-disjoint":
        "disjoint = word_shift(disjoint, levels);" => "";
    "intervals that touch count as disjoint", "hashed-disjoint":
        "first_exit < second_enter" => "first_exit <= second_enter";
    "a hit beyond its leaf's box masks", "hashed-disjoint":
        "&& best.x <= cell.y" => "";
    "a missed child is preferred (H Algorithm 1 as printed)", "stack":
        "right && (!left || prefer_right)" => "(!left || prefer_right)";
    "ties go right", "stack":
        "record.both.x == 1u, left.x == right.x" => "true, left.x == right.x";
    "any hit does not end the search", "stack":
        "stopped = any_hit;" => "stopped = false;";
    "a node that begins where the hit is is dropped", "stack-t0":
        "load(height - 1u) <= end()" => "load(height - 1u) < end()";
    "lanes share a stack", "stack-workgroup":
        "stack[at * WORKGROUP + lane] = word" => "stack[at * WORKGROUP] = word";
    "the last result is not written", "stack-persistent":
        "if task != NONE {" => "if task + 1u < params.x {";
    "the leaf that was put aside is forgotten", "stack-speculative":
        "if held != DONE {\n            look_into(~held);" => "if held == 0u {\n            look_into(~held);";
    "the climb stops one level short", "afra":
        "i < levels" => "i + 1u < levels";
    "the climb takes siblings for parents", "afra":
        "nodes[family.x + 3u].zw" => "nodes[family.x + 3u].wz";
    "a child that is culled at the pop level is replaced by its sibling", "laine-0":
        "word_equal(below, pop_level)" => "false";
    "the bits below the level stay", "laine-1":
        "word_and(trail, word_negate(level))" => "trail";
    "the ring is one too long", "laine-4":
        "ring_length = min(ring_length + 1u, SHORT)" => "ring_length = min(ring_length + 1u, SHORT + 1u)";
    "no carry into the second word", "laine-1/64":
        "a.y + b.y + select(0u, 1u, low < a.x)" => "a.y + b.y";
    "the second word is shifted into the first by one bit too few", "afra/64":
        "((moved.y << 1u) << (31u - bits))" => "(moved.y << (31u - bits))";
    "zeros of the second word without those of the first", "hashed/64":
        "32u + firstTrailingBit(word.y)" => "firstTrailingBit(word.y)";
    "the bit between the words is lost on descending", "hashed/64":
        "(word.y << 1u) | (word.x >> 31u)" => "(word.y << 1u)";
    "the remainder of the low word alone", "hashed-printed/64":
        "wide_multiply_high(key, RECIPROCAL)" => "wide_multiply_high(vec2(key.x, 0u), RECIPROCAL)";
    "a carry is lost in the product", "hashed-printed/64":
        "wide_add(vec2(first.y, 0u), vec2(second.y, 0u))" => "vec2(first.y, 0u)";
    "keys are cut one bit too early", "hashed/96":
        "let rest_bits = length - 63u;" => "let rest_bits = length - 62u;";
    "the length is not folded in", "hashed-printed/96":
        "return wide_mix(folded ^ vec2(length, 0u));" => "return folded;";
    "the third word has no zeros", "afra/96":
        "select(64u + firstTrailingBit(word.z)" => "select(32u + firstTrailingBit(word.z)";
};

/// Those in the part that tests boxes and triangles; rays of made scenes show them.
pub const RAY_BUGS: &[Bug] = bugs! {
    "near planes are not chosen by the direction", "stack":
        "(select(lo, hi, backward) - origin)" => "(lo - origin)";
    "a plane of a box bounds a ray that lies in it", "stack":
        "if HAS_PARALLEL {" => "if false {";
    "the planes of the two boxes are exchanged", "hashed":
        "vec3(left.xz, both.x)" => "vec3(left.xz, both.z)";
    "boxes end where the best hit is, not after it", "stack":
        "first.x <= first.y" => "first.x < first.y";
    "of equal hits the last triangle counts", "stack":
        "corner.w <= best_triangle" => "corner.w >= best_triangle";
    "a hit where the ray begins is left out", "stack":
        "t >= tmin" => "t > tmin";
    "edges do not belong to triangles", "afra":
        "u >= 0.0" => "u > 0.0";
    "triangles are seen from one side", "stack":
        "select(1.0, -1.0, det < 0.0)" => "1.0";
    "a postponed box is taken to begin later than it does", "stack-t0":
        "bitcast<u32>(select(nears.y, nears.x, (descent & RIGHT) != 0u))" =>
        "bitcast<u32>(select(nears.y, nears.x, (descent & RIGHT) != 0u) * 1.5)";
    "zeros keep their sign", "stack":
        "select(quotient, 0.0, quotient == 0.0)" => "quotient";
};

/// Those in what is certain; the cases of `ray/exact` show them. BAND-2 to BAND-5 in `spec/exactness.md` say why each is one.
pub const BAND_BUGS: &[Bug] = bugs! {
    "edge functions are taken for exact", "stack":
        "(((EDGE_FACTOR * U) * size) * edge) * (2.0 * reach + edge)" => "0.0";
    "the numerator of the distance is taken for exact", "stack":
        "(((36.0 * U) * reach) * edge) * edge" => "0.0";
    "the distance is taken for exact", "stack":
        "let t_low = (first - (16.0 * U) * abs(first)) - FLOOR;\n    let t_high = (last + (16.0 * U) * abs(last)) + FLOOR;" =>
        "let t_low = above / below;\n    let t_high = above / below;";
    "hits that may be equally far are put in order", "stack":
        "} else if best_triangle != corner.w {\n        doubt();" => "} else if best_triangle != corner.w {";
    "the end of the interval is not left in doubt", "stack":
        "if !(t_least >= tmin && t_high <= ray_end) {\n        doubt();\n        return;\n    }" => "";
    "a line that may meet an edge misses", "stack":
        "if !(least > delta || most < -delta) {\n        doubt();" => "if !(least > delta || most < -delta) {";
};

/// Runs the ray kernel with the bug over the made scenes. The answer is how many closest hits are not those of rational
/// arithmetic.
///
/// # Errors
/// As [`hunt`].
pub fn hunt_rays(gpu: &Gpu, bug: &Bug) -> Result<usize, GpuError> {
    let kernel = by_name(bug.kernel)?;
    let arithmetic = probe::probe(gpu)?;
    let mut seen = 0;
    for scene in Made::ALL {
        let data = |error: &dyn std::fmt::Display| GpuError::Data(error.to_string());
        let mesh = scene.mesh(1).map_err(|error| data(&error))?;
        let bvh = Bvh::sah(&mesh, SahOptions::default()).map_err(|error| data(&error))?;
        let rays = made::rays(&mesh, 2000, 3);
        let on_device = Scene::new(gpu, &bvh)?;
        let query = Query::single(&arithmetic, &rays, false)?;
        if !on_device.source(gpu, &kernel, query).contains(bug.from) {
            return Err(GpuError::Data(format!("{}: nothing to change in {}", bug.name, bug.kernel)));
        }
        let found = rays::trace(gpu, &on_device, &kernel, query, &rays, &|text| text.replace(bug.from, bug.to))?;
        seen += rays::errors(&found, &Tracer::new(&bvh).closest_parallel(&rays), false).differences;
    }
    Ok(seen)
}

/// The mistake of a name.
///
/// # Errors
/// [`GpuError::Data`] if there is none.
pub fn named(name: &str) -> Result<Bug, GpuError> {
    let bug = BUGS.iter().chain(RAY_BUGS).chain(BAND_BUGS).find(|bug| bug.name == name);
    bug.copied().ok_or_else(|| GpuError::Data(format!("no mistake {name:?}")))
}

/// The kernel of a full name.
///
/// # Errors
/// [`GpuError::Data`] if there is none.
pub fn by_name(name: &str) -> Result<Kernel, GpuError> {
    let kernel = (1..=3).flat_map(Kernel::all).find(|kernel| kernel.full_name() == name);
    kernel.ok_or_else(|| GpuError::Data(format!("no kernel {name}")))
}

/// Runs the kernel with the bug. The answer is how many searches show it.
///
/// # Errors
/// [`GpuError`]; [`GpuError::Data`] where the text has nothing to change.
pub fn hunt(gpu: &Gpu, batch: &Batch, bug: &Bug) -> Result<usize, GpuError> {
    let kernel = by_name(bug.kernel)?;
    let shape = crate::kernel::Shape { depth: 1, subgroups: false };
    let text = kernel.source(shape, crate::kernel::TAPE_SEARCH, crate::kernel::Record::Hash);
    if !text.contains(bug.from) {
        return Err(GpuError::Data(format!("{}: nothing to change in {}", bug.name, bug.kernel)));
    }
    let report = tapes::compare(gpu, batch, &kernel, &|text| text.replace(bug.from, bug.to))?;
    Ok(report.mismatches)
}
