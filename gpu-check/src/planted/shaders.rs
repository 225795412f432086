//! The list of bugs. Each bug is one edit of a kernel's text.

/// A bug in a kernel.
#[derive(Clone, Copy, Debug)]
pub struct Shader {
    /// A short, unique description.
    pub name: &'static str,
    /// The clause that it breaks.
    pub clause: &'static str,
    /// The kernel, by its full name.
    pub kernel: &'static str,
    /// The original text.
    pub from: &'static str,
    /// The planted text.
    pub to: &'static str,
    /// The kind of test that detects it.
    pub by: ShownBy,
    /// The profile of the conformance suite that runs; empty for none.
    pub profile: &'static str,
    /// The kernel that answers the suite, with this bug.
    pub asked: &'static str,
    /// Why it passes the suite; `None` if it fails cases of its clause.
    pub passes: Option<&'static str>,
}

/// The kind of test of `gpu-check` that detects a bug.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShownBy {
    /// Searches along tapes.
    Tapes,
    /// Rays through generated scenes.
    Rays,
    /// Rays of the suite that are answered exactly, or are left in doubt.
    Exact,
}

macro_rules! shaders {
    ($($name:literal, $clause:literal, $kernel:literal, $by:ident
        $(fails $failed:literal $(by $asked:literal)?)? $(passes $passed:literal because $why:literal)?
        $(unasked $unasked:literal)?:
        $from:literal => $to:literal;)*) => {
        &[$(Shader {
            name: $name,
            clause: $clause,
            kernel: $kernel,
            from: $from,
            to: $to,
            by: ShownBy::$by,
            profile: concat!($($failed)? $($passed)?),
            asked: [$($($asked,)?)? $kernel][0],
            passes: [$(Some($why),)? $(Some(concat!("kernels are not asked about ", $unasked)),)? None][0],
        }),*]
    };
}

/// All bugs.
#[rustfmt::skip]
pub static SHADERS: &[Shader] = shaders! {
    // Detected by searches along tapes.
    "the key is shifted by one level too many", "TRAIL-4", "hashed", Tapes fails "trace/script":
        "key = word_toggle(word_shift(key, levels))" => "key = word_toggle(word_shift(key, levels + 1u))";
    "the trail is shifted by one level too few", "TRAIL-4", "hashed", Tapes fails "trace/script":
        "trail = word_toggle(word_shift(trail, levels))" =>
        "trail = word_toggle(word_shift(trail, max(levels, 1u) - 1u))";
    "the trail is not toggled", "TRAIL-4", "hashed", Tapes fails "trace/script":
        "trail = word_toggle(word_shift(trail, levels))" => "trail = word_shift(trail, levels)";
    "the key is not toggled", "TRAIL-4", "hashed-printed", Tapes fails "trace/script":
        "key = word_toggle(word_shift(key, levels))" => "key = word_shift(key, levels)";
    "the address in the table of displacements is not extended by its sign", "HASHED-1", "hashed",
        Tapes fails "trace/script":
        "bitcast<u32>(bitcast<i32>(entry << 1u) >> 1u)" => "(entry << 1u) >> 1u";
    "direct addresses are taken for displacements", "HASHED-1", "hashed", Tapes fails "trace/complete":
        "return (entry >> 31u) == 1u;" => "return false;";
    "the key is not reduced", "HASHED-1", "hashed-printed", Tapes fails "trace/script":
        "mixed % TABLE_SIZE" => "mixed";
    // Most keys of `hashed` have direct addresses.
    "the sum is not reduced", "HASH-1", "hashed", Tapes fails "hash/lookup" by "hashed/64":
        "min(sum, sum - TABLE_SIZE)" => "sum";
    "the wrong displacement", "HASHED-1", "hashed-printed", Tapes fails "trace/complete":
        "(mixed & DIRECT_MASK)" => "((mixed >> 1u) & DIRECT_MASK)";
    "no bijection where the plain hash fails", "HASHED-1", "hashed-printed", Tapes fails "trace/script":
        "mixed = mix_narrow(key ^ SEED.x);" => "";
    "the register is kept after it is used", "REGISTER-1", "hashed", Tapes fails "trace/script":
        "node = latest;\n            latest = 0u;" => "node = latest;";
    "the register holds the wrong child", "REGISTER-1", "hashed", Tapes fails "trace/script":
        "latest = second_child(record, descent);" => "latest = first_child(record, descent);";
    "the grand uncle is taken before the uncle", "UNCLE-1", "hashed", Tapes fails "trace/complete":
        "named = select(named, links.x, (pending & 2u) != 0u)" =>
        "named = select(named, links.x, (pending & 6u) == 2u)";
    "the uncle counts as postponed when the sibling is", "UNCLE-1", "hashed-printed", Tapes fails "trace/complete":
        "(pending & 2u)" => "(word_low(trail) & 1u)";
    "leaves are taken to name two nodes, and the table holds the keys for three", "HASH-3", "hashed",
        Tapes fails "trace/complete":
        "const LEAF_REACH = 14u;" => "const LEAF_REACH = 6u;";
    "the register is not emptied when its node is masked", "DISJOINT-3", "hashed-disjoint",
        Tapes fails "trace/disjoint":
        "if word_is_zero(kept) || word_zeros(kept) != word_zeros(trail) {" => "if false {";
    "the register is filled before the mask", "DISJOINT-3", "hashed-disjoint", Tapes fails "trace/disjoint":
        "cursor_prune();\n        }\n        cursor_load(links, LEAF_REACH);\n        \
        cursor_backtrack(links, LEAF_REACH);" =>
        "fill(links, LEAF_REACH); cursor_prune(); } else { fill(links, LEAF_REACH); } cursor_backtrack(links, 0u);";
    "the second trail is not shifted", "DISJOINT-1", "hashed-disjoint", Tapes fails "trace/disjoint":
        "disjoint = word_shift(disjoint, levels);" => "";
    "intervals that touch count as disjoint", "DISJOINT-1", "hashed-disjoint", Tapes fails "trace/disjoint":
        "first_exit < second_enter" => "first_exit <= second_enter";
    "a hit beyond its leaf's box masks", "DISJOINT-2", "hashed-disjoint", Tapes fails "trace/disjoint":
        "&& best.x <= cell.y" => "";
    "a missed child is preferred (H Algorithm 1 as printed)", "ORDER-1", "stack", Tapes fails "trace/tape":
        "right && (!left || prefer_right)" => "(!left || prefer_right)";
    "ties go right", "ORDER-1", "stack", Tapes fails "trace/complete":
        "record.both.x == 1u, left.x == right.x" => "true, left.x == right.x";
    "any hit does not end the search", "ORACLE-1", "stack", Tapes fails "trace/complete":
        "stopped = any_hit;" => "stopped = false;";
    "a node that begins where the hit is is dropped", "ORACLE-3", "stack-t0", Tapes fails "trace/distance":
        "load(height - 1u) <= end()" => "load(height - 1u) < end()";
    // A case of `trace` has a single lane.
    "lanes share a stack", "EXACT-1", "stack-workgroup", Tapes fails "ray/grid":
        "stack[at * WORKGROUP + lane] = word" => "stack[at * WORKGROUP] = word";
    "the last result is not written", "TRAVERSE-1", "stack-persistent", Tapes fails "trace/complete":
        "if task != NONE {" => "if task + 1u < params.x {";
    "the leaf that was put aside is forgotten", "EXACT-1", "stack-speculative", Tapes fails "ray/grid":
        "if held != DONE {\n            look_into(~held);" => "if held == 0u {\n            look_into(~held);";
    "the climb stops one level short", "TRAVERSE-1", "afra", Tapes fails "trace/complete":
        "i < levels" => "i + 1u < levels";
    "the climb takes siblings for parents", "TRAVERSE-1", "afra", Tapes fails "trace/complete":
        "nodes[family.x + 3u].zw" => "nodes[family.x + 3u].wz";
    "a child that is culled at the pop level is replaced by its sibling", "LAINE-1", "laine-0",
        Tapes passes "trace/tape" because "searches that change while it restarts are asked only of who decides once":
        "word_equal(below, pop_level)" => "false";
    "the bits below the level stay", "LAINE-1", "laine-1",
        Tapes passes "trace/tape" because "they are set only where decisions have changed":
        "word_and(trail, word_negate(level))" => "trail";
    "the ring is one too long", "TRAVERSE-1", "laine-4", Tapes fails "trace/complete":
        "ring_length = min(ring_length + 1u, SHORT)" => "ring_length = min(ring_length + 1u, SHORT + 1u)";
    "no carry into the second word", "TRAIL-6", "laine-1/64", Tapes fails "key/u64":
        "a.y + b.y + select(0u, 1u, low < a.x)" => "a.y + b.y";
    "the second word is shifted into the first by one bit too few", "TRAIL-4", "afra/64", Tapes fails "key/u64":
        "((moved.y << 1u) << (31u - bits))" => "(moved.y << (31u - bits))";
    "zeros of the second word without those of the first", "TRAIL-3", "hashed/64", Tapes fails "key/u64":
        "32u + firstTrailingBit(word.y)" => "firstTrailingBit(word.y)";
    "the bit between the words is lost on descending", "KEY-2", "hashed/64", Tapes fails "key/u64":
        "(word.y << 1u) | (word.x >> 31u)" => "(word.y << 1u)";
    "the remainder of the low word alone", "HASH-1", "hashed-printed/64", Tapes fails "hash/function":
        "wide_multiply_high(key, RECIPROCAL)" => "wide_multiply_high(vec2(key.x, 0u), RECIPROCAL)";
    "a carry is lost in the product", "HASH-1", "hashed-printed/64", Tapes fails "hash/function":
        "wide_add(vec2(first.y, 0u), vec2(second.y, 0u))" => "vec2(first.y, 0u)";
    "keys are cut one bit too early", "HASH-6", "hashed/96",
        Tapes passes "trace/script" because "no tree of up to 95 edges has lookups of more than 64 bits":
        "let rest_bits = length - 63u;" => "let rest_bits = length - 62u;";
    "the length is not folded in", "HASH-6", "hashed-printed/96",
        Tapes passes "trace/script" because "no tree of up to 95 edges has lookups of more than 64 bits":
        "return wide_mix(folded ^ vec2(length, 0u));" => "return folded;";
    "the third word has no zeros", "TRAIL-3", "afra/96", Tapes fails "trace/script":
        "select(64u + firstTrailingBit(word.z)" => "select(32u + firstTrailingBit(word.z)";
    // In the tests of boxes and triangles, detected by rays through generated scenes.
    "near planes are not chosen by the direction", "EXACT-1", "stack", Rays fails "ray/grid":
        "(select(lo, hi, backward) - origin)" => "(lo - origin)";
    "a plane of a box bounds a ray that lies in it", "EXACT-1", "stack", Rays fails "ray/grid":
        "if HAS_PARALLEL {" => "if false {";
    "the planes of the two boxes are exchanged", "EXACT-1", "hashed", Rays fails "ray/grid":
        "vec3(left.xz, both.x)" => "vec3(left.xz, both.z)";
    "boxes end where the best hit is, not after it", "EXACT-1", "stack", Rays fails "ray/exact":
        "first.x <= first.y" => "first.x < first.y";
    "of equal hits the last triangle counts", "EXACT-1", "stack", Rays fails "ray/grid":
        "corner.w <= best_triangle" => "corner.w >= best_triangle";
    "a hit where the ray begins is left out", "EXACT-1", "stack", Rays fails "ray/grid":
        "t >= tmin" => "t > tmin";
    "edges do not belong to triangles", "EXACT-1", "afra", Rays fails "ray/grid":
        "u >= 0.0" => "u > 0.0";
    "triangles are seen from one side", "EXACT-1", "stack", Rays fails "ray/grid":
        "select(1.0, -1.0, det < 0.0)" => "1.0";
    "a postponed box is taken to begin later than it does", "EXACT-1", "stack-t0", Rays fails "ray/grid":
        "bitcast<u32>(select(nears.y, nears.x, (descent & RIGHT) != 0u))" =>
        "bitcast<u32>(select(nears.y, nears.x, (descent & RIGHT) != 0u) * 1.5)";
    "zeros keep their sign", "EXACT-1", "stack",
        Rays passes "ray/grid" because "zeros of either sign are equal in the suite":
        "select(quotient, 0.0, quotient == 0.0)" => "quotient";
    // In the certain results, detected by rays with exact answers.
    "edge functions are taken for exact", "BAND-2", "stack", Exact fails "ray/exact":
        "(((EDGE_FACTOR * U) * size) * edge) * (2.0 * reach + edge)" => "0.0";
    "the numerator of the distance is taken for exact", "BAND-3", "stack", Exact fails "ray/exact":
        "(((36.0 * U) * reach) * edge) * edge" => "0.0";
    "the distance is taken for exact", "BAND-4", "stack", Exact fails "ray/exact":
        "let t_low = (first - (16.0 * U) * abs(first)) - FLOOR;\n    \
        let t_high = (last + (16.0 * U) * abs(last)) + FLOOR;" =>
        "let t_low = above / below;\n    let t_high = above / below;";
    "hits that may be equally far are put in order", "BAND-5", "stack", Exact fails "ray/exact":
        "} else if best_triangle != corner.w {\n        doubt();" => "} else if best_triangle != corner.w {";
    "the end of the interval is not left in doubt", "BAND-4", "stack", Exact fails "ray/exact":
        "if !(t_least >= tmin && t_high <= ray_end) {\n        doubt();\n        return;\n    }" => "";
    "a line that may meet an edge misses", "BAND-2", "stack", Exact fails "ray/exact":
        "if !(least > delta || most < -delta) {\n        doubt();" => "if !(least > delta || most < -delta) {";
    // In wide trees, detected by searches along tapes. The adapter does not answer the suite's cases of wide trees.
    "of the wanted children the last comes first", "WSTACK-1", "wide-stack", Tapes unasked "wide trees":
        "stack[at - 1u].x > entry.x" => "stack[at - 1u].x < entry.x";
    "what is beyond is popped all the same", "WSTACK-1", "wide-stack", Tapes unasked "wide trees":
        "if !is_beyond(entry.x) {" => "if true {";
    "the slot counts as distance", "WIDE-3", "wide-stack", Tapes unasked "wide trees":
        "(rank & ~SLOT_MASK) > end" => "rank > end";
    "a child that begins at the end is beyond", "WIDE-3", "wide-record", Tapes unasked "wide trees":
        "(rank & ~SLOT_MASK) > end" => "(rank & ~SLOT_MASK) >= end";
    "inner nodes and leaves by their slots", "WIDE-6", "wide-record", Tapes unasked "wide trees":
        "wanted = visit_leaves(wanted);" => "";
    "what was pending above is pending below", "WIDE-10", "wide-record", Tapes unasked "wide trees":
        "link_enter(slot);\n        pending = 0u;" => "link_enter(slot);";
    "a kept rank is taken twice", "WIDE-17", "wide-record", Tapes unasked "wide trees":
        "next_ranks = vec2(next_ranks.y, 0u);" => "";
    "the sets of levels are joined", "WIDE-17", "wide-record", Tapes unasked "wide trees":
        "(kept_sets[at >> 2u] & ~(0xffu << bits)) |" => "kept_sets[at >> 2u] |";
    "back to the highest level that has pending children", "WIDE-17", "wide-record", Tapes unasked "wide trees":
        "firstLeadingBit(summary)" => "firstTrailingBit(summary)";
    "a level that is beyond ends the search", "WIDE-17", "wide-record", Tapes unasked "wide trees":
        "summary ^= 1u << at;" => "summary = 0u;";
    "asked again, all wanted children are pending", "WIDE-17", "wide-record", Tapes unasked "wide trees":
        "ask(present, true) & pending" => "ask(present, true)";
    "asked again, the search wants what it would now", "WIDE-4", "wide-record", Tapes unasked "wide trees":
        "is_changing && !is_again" => "is_changing";
    "the farthest ancestor in the record is the nearest but one", "WIDE-15", "wide-record", Tapes unasked "wide trees":
        "return ancestor_of(at, min(up, SLOTS));" => "return ancestor_of(at, min(up, SLOTS - 1u));";
    "the climb to an ancestor stops one level short", "WIDE-15", "wide-trail", Tapes unasked "wide trees":
        "i < up; i++" => "i + 1u < up; i++";
    "no set is carried from word to word", "WIDE-10", "wide-trail/128", Tapes unasked "wide trees":
        " | (trail[i - 1u] >> (32u - SET_BITS))" => "";
    "words above are not shifted back", "WIDE-11", "wide-trail/64", Tapes unasked "wide trees":
        ">> SET_BITS) | above;" => ">> SET_BITS);";
    "a word without pending children counts as one level", "WIDE-11", "wide-trail/128", Tapes unasked "wide trees":
        "32u / SET_BITS * words + skipped + 1u" => "words + skipped + 1u";
    "a change of the end is not noted", "WIDE-18", "wide-trail", Tapes unasked "wide trees":
        "changed = NONE;" => "";
    "what has changed is not shifted back", "WIDE-18", "wide-trail/128", Tapes unasked "wide trees":
        "changed = (changed >> (up - 1u)) >> 1u;" => "";
    "a node that is asked again counts for all above it", "WIDE-18", "wide-trail", Tapes unasked "wide trees":
        "changed &= ~1u;" => "changed = 0u;";
    "the key is shifted by levels, not by bits", "WIDE-9", "wide-hashed/64", Tapes unasked "wide trees":
        "word_shift(key, SLOT_BITS * up)" => "word_shift(key, up)";
    "leaves in the last four slots are taken for inner nodes", "WIDE-6", "wide-record", Tapes unasked "wide trees":
        "(nodes[address + 1u] >> sign) == vec4(1u)" => "vec4<bool>(false, false, false, false)";
    // In the tests of eight boxes, detected by rays through generated scenes.
    "of eight boxes the lower planes are always near", "EXACT-1", "wide-stack", Rays unasked "wide trees":
        "return select(words, words.zwxy, is_backward);" => "return words;";
    "flat boxes of eight are missed", "EXACT-1", "wide-trail", Rays unasked "wide trees":
        "let is_low = low <= exits" => "let is_low = low < exits";
    "distances in ranks are rounded up", "WIDE-2", "wide-record", Rays unasked "wide trees":
        "(bitcast<vec4<u32>>(low) & vec4(~SLOT_MASK))" =>
        "((bitcast<vec4<u32>>(low) + vec4(SLOT_MASK)) & vec4(~SLOT_MASK))";
    "the boxes of the last four slots begin where those of the first do", "WIDE-2", "wide-hashed/64",
        Rays unasked "wide trees":
        "vec3(x.y, y.y, z.y)" => "vec3(x.x, y.x, z.x)";
};
