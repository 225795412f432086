//! Lemmas about the perfect hash, from the text of its files.

use syn::visit::{self, Visit};
use syn::{Block, Expr};
use z3::ast::{BV, Bool};

use crate::lemma::{Lemma, Query};
use crate::machine::{Machine, Number};
use crate::numbers::Bits;
use crate::source::{Source, Type, text, where_some};

/// Returns all lemmas.
pub(crate) fn lemmas() -> Result<Vec<Lemma>, String> {
    let bucket = Slip {
        says: "k & D",
        from: "displacements[low_bits & (self.displacements.len() - 1)]",
        to: "displacements[low_bits & self.displacements.len()]",
    };
    let cell_slip =
        Slip { says: "min(r, H - r)", from: "r.min(r.wrapping_sub(size))", to: "r.min(size.wrapping_sub(r))" };
    let leaf = Slip {
        says: "leaf not complemented",
        from: "if node.is_leaf() { !index }",
        to: "if node.is_leaf() { SIGN | index }",
    };
    let factor = Slip {
        says: "an even factor",
        from: "x = x.wrapping_mul(0x94d0_49bb_1331_11eb)",
        to: "x = x.wrapping_mul(0x94d0_49bb_1331_11ea)",
    };
    let shift = Slip { says: "or for xor", from: "x ^= x >> 15", to: "x |= x >> 15" };
    Ok(vec![
        lemma("bucket = k mod D", "[HASH-1]", 64, bucket_of_key, bucket)?,
        lemma("cell = (k mod H + d) mod H", "[HASH-1]", 32, cell, cell_slip)?,
        lemma("addresses survive a round trip", "[HASH-5]", 32, addresses, leaf)?,
        lemma("mix is a bijection", "[HASH-7]", 64, mix, factor)?,
        lemma("mix_u32 is a bijection", "[HASH-7]", 32, mix_u32, shift)?,
    ])
}

/// A slip in the library's files: a text that occurs once, and its replacement.
pub(crate) struct Slip {
    /// A short description.
    pub(crate) says: &'static str,
    pub(crate) from: &'static str,
    pub(crate) to: &'static str,
}

/// Builds a lemma about functions of the library's files, with and without a slip.
pub(crate) fn lemma(
    name: &'static str,
    clauses: &'static str,
    width: u32,
    says: fn(&Source, &mut Query) -> Result<(), String>,
    slip: Slip,
) -> Result<Lemma, String> {
    let query = move |source: Source| {
        let mut query = Query::default();
        says(&source, &mut query).map(|()| query).map_err(|error| format!("{name}: {error}"))
    };
    let (library, control) = (query(Source::library()?)?, query(Source::with(slip.from, slip.to)?)?);
    // Slips that the interpreter rejects break nothing.
    let slips = move |&(from, to): &(&str, &str)| query(Source::with(from, to).ok()?).ok();
    let others = Box::new(move || SLIPS.iter().filter_map(slips).collect());
    Ok(Lemma { name, clauses, width, slip: slip.says, library, control, others })
}

/// Slips for claims that a lemma's own slip does not break.
pub(crate) const SLIPS: &[(&str, &str)] = &[
    ("take(&mut self.index).shl1().or(&rejected_one)", "take(&mut self.index).shl1()"),
    ("self.tree.child(self.node, descent.first())", "self.tree.parent(self.node)"),
    ("for _ in 0..up {", "for _ in 0..up.shr1() {"),
    ("take(&mut self.0).shr(levels)", "take(&mut self.0).shr1()"),
    ("self.tree.sibling(self.node)", "self.tree.parent(self.node)"),
    (
        "wrapping_add(&W::one());\n        let up = index.trailing_zeros();\n        for",
        "shr1();\n        let up = W::one();\n        for",
    ),
    ("take(&mut self.level_index).shl1()", "take(&mut self.level_index).shl1().shl1()"),
    (
        "shl1().or(&mask_bit(descent));\n        self.node = self.layout.node(&self",
        "shl1();\n        self.node = self.layout.node(&self",
    ),
    ("index.xor(mask)", "index.or(mask)"),
    ("take(&mut self.level_index).wrapping_add(&W::one())", "take(&mut self.level_index)"),
    ("take(&mut self.index).wrapping_add(&W::one())", "take(&mut self.index)"),
    (
        "index.shr(up);\n        self.swap_mask = take(&mut self.swap_mask).shr(up);\n        if self.level",
        "index.shr(up);\n        self.swap_mask = take(&mut self.swap_mask).shr1();\n        if self.level",
    ),
    ("shr(up);\n        self.level_index = index", "shr(up).shr1();\n        self.level_index = index"),
    ("*path = take(path).shr(up).xor(&W::one());", "*path = take(path).shr(up);"),
    ("*counter = index.shr(up);", "*counter = index.shr1();"),
    ("[low_bits & (self.displacements.len() - 1)]", "[low_bits | (self.displacements.len() - 1)]"),
    ("r.min(r.wrapping_sub(size))", "r.min(r)"),
    ("if node.is_leaf() { !index }", "if node.is_leaf() { index }"),
    ("word & SIGN != 0", "word | SIGN != 0"),
    ("key ^ seed as u32", "key & seed as u32"),
    ("mix(key ^ seed)", "mix(key & seed)"),
    ("u64::MAX / size.get() as u64", "u64::MAX * size.get() as u64"),
];

fn number(value: u64, width: u32) -> BV {
    BV::from_u64(value, width)
}

/// Returns the array indices in a body, in order.
fn indices(body: &Block) -> Vec<Expr> {
    struct Indices(Vec<Expr>);
    impl<'ast> Visit<'ast> for Indices {
        fn visit_expr_index(&mut self, expr: &'ast syn::ExprIndex) {
            self.0.push((*expr.index).clone());
            visit::visit_expr_index(self, expr);
        }
    }
    let mut all = Indices(Vec::new());
    all.visit_block(body);
    all.0
}

/// Returns both indices of a lookup: that of the displacement and that of the cell.
fn lookup(source: &Source) -> Result<[Expr; 2], String> {
    let all = indices(&source.function("PerfectHash::word")?.body);
    all.try_into().map_err(|_| "a lookup has not two indices".into())
}

fn bucket_of_key(source: &Source, q: &mut Query) -> Result<(), String> {
    let (key, n) = (q.bits("key", 64), q.bits("n", 64));
    q.assume(n.bvult(number(64, 64)));
    let buckets = number(1, 64).bvshl(&n);
    let values = [("low_bits", Bits::new(key.clone())), ("self.displacements.len()", Bits::new(buckets.clone()))];
    let [bucket, _] = lookup(source)?;
    let bucket = Machine::new(source, Type::unsigned(64), values).eval(&bucket, None)?.bits;
    q.claim("it is below D", bucket.bvult(&buckets));
    q.claim("and not above the key", bucket.bvule(&key));
    let rest = key.bvsub(&bucket);
    q.claim("the rest is a multiple of D", rest.bvlshr(&n).bvshl(&n).eq(&rest));
    Ok(())
}

fn cell(source: &Source, q: &mut Query) -> Result<(), String> {
    let [remainder, displacement, size] = ["remainder", "displacement", "H"].map(|name| q.bits(name, 32));
    q.assume(remainder.bvult(&size));
    q.assume(displacement.bvult(&size));
    q.assume(size.bvule(number(1 << 31, 32)));
    let values = [("remainder()", &remainder), ("displacement", &displacement), ("self.modulus.size()", &size)];
    let values = values.map(|(text, bits)| (text, Bits::new(bits.clone())));
    let [_, cell] = lookup(source)?;
    let cell = Machine::new(source, Type::unsigned(64), values).eval(&cell, None)?.bits;
    let [remainder, displacement, size] = [remainder, displacement, size].map(|bits| bits.zero_ext(32));
    let sum = remainder.bvadd(&displacement);
    q.claim("it is below H", cell.bvult(&size));
    q.claim("it is the sum, or the sum less H", Bool::or(&[cell.eq(&sum), cell.bvadd(&size).eq(&sum)]));
    Ok(())
}

fn addresses(source: &Source, q: &mut Query) -> Result<(), String> {
    let (index, leaf, other) = (q.bits("index", 32), q.bits("leaf", 1), q.bits("displacement", 32));
    q.assume(index.bvult(number(1 << 30, 32)));
    q.assume(other.bvult(number(1 << 31, 32)));
    // `Node` has 31 bits of index below the bit of leaves; `usize` has 64 bits.
    let node = [("node.index()", Bits::new(index.zero_ext(32))), ("node.is_leaf()", Bits::new(leaf.clone()))];
    let machine = Machine::new(source, Type::unsigned(32), []);
    let encode = source.function("encode")?.body;
    let word = Machine::new(source, Type::unsigned(32), node).run(&encode)?.ok_or("encode has no value")?;
    let is_address =
        |word: &Bits| machine.call("is_address", std::slice::from_ref(word)).and_then(|found| found.is_true());
    q.claim("the word is an address", is_address(&word)?);
    q.claim("a displacement is none", is_address(&Bits::new(other))?.not());
    let bits = leaf.concat(number(0, 31)).bvor(&index);
    q.claim("it comes back", machine.call("decode", std::slice::from_ref(&word))?.bits.eq(&bits));
    let is_leaf = Bits::new(leaf).is_true()?;
    q.claim("leaves are from 0xC0000000 up", word.bits.bvuge(number(0xc000_0000, 32)).iff(&is_leaf));
    let printed = is_leaf.ite(&index.bvnot(), &number(0x8000_0000, 32).bvadd(&index));
    q.claim("it is 0x80000000 + a, or !i", word.bits.eq(printed));
    Ok(())
}

/// The inverse of a step of a mix.
#[derive(Clone, Copy)]
enum Undo {
    /// `x ^ x >> s`.
    Shift(u32),
    /// `x * odd`.
    Times(u64),
}

impl Undo {
    fn of(self, x: &BV) -> BV {
        let width = x.get_size();
        match self {
            Self::Shift(by) => {
                let shifts = (1..).map(|i| i * by).take_while(|&shift| shift < width);
                shifts.fold(x.clone(), |all, shift| all.bvxor(x.bvlshr(number(shift.into(), width))))
            }
            // Newton's iteration: each round doubles the number of correct low bits, from 3.
            Self::Times(odd) => {
                let step = |inverse: u64, _| inverse.wrapping_mul(2_u64.wrapping_sub(odd.wrapping_mul(inverse)));
                let inverse = (0..5).fold(odd, step);
                x.bvmul(Bits::literal(u128::from(inverse) & u128::MAX >> (128 - width), Type::unsigned(width)).bits)
            }
        }
    }
}

fn mix(source: &Source, q: &mut Query) -> Result<(), String> {
    let factors = [0xbf58_476d_1ce4_e5b9, 0x94d0_49bb_1331_11eb].map(Undo::Times);
    seeded(source, q, "Mix::wide", "mix", 64)?;
    bijection(source, q, "mix", 64, [Undo::Shift(30), factors[0], Undo::Shift(27), factors[1], Undo::Shift(31)])
}

fn mix_u32(source: &Source, q: &mut Query) -> Result<(), String> {
    let factors = [0x7feb_352d, 0x846c_a68b].map(Undo::Times);
    seeded(source, q, "Mix::narrow", "mix_u32", 32)?;
    bijection(source, q, "mix_u32", 32, [Undo::Shift(16), factors[0], Undo::Shift(15), factors[1], Undo::Shift(16)])
}

/// Claims that mixing under a seed gives different results for different keys: the seed's part is its own inverse.
fn seeded(source: &Source, q: &mut Query, name: &str, mix: &str, width: u32) -> Result<(), String> {
    let (key, seed) = (q.bits("key", width), q.bits("seed", 64));
    let Expr::Call(call) = where_some(&source.function(name)?.body, "seed")? else { return Err("no call".into()) };
    if text(&call.func) != mix {
        return Err(format!("{name} calls {}", text(&call.func)));
    }
    let argument = call.args.first().ok_or("no argument")?;
    let apply = |key: &BV| {
        let values = [("key", key), ("seed", &seed)].map(|(text, bits)| (text, Bits::new(bits.clone())));
        Machine::new(source, Type::unsigned(width), values).eval(argument, None).map(|value| value.bits)
    };
    q.claim("the seed is undone by itself", apply(&apply(&key)?)?.eq(&key));
    Ok(())
}

/// Claims that each statement of the function has an inverse on both sides, and that their composition has.
fn bijection(source: &Source, q: &mut Query, name: &str, width: u32, undo: [Undo; 5]) -> Result<(), String> {
    let x = q.bits("x", width);
    let steps = source.function(name)?.body.stmts;
    if steps.len() != undo.len() {
        return Err(format!("{} steps", steps.len()));
    }
    for (step, undo) in steps.iter().zip(undo) {
        let run = |x: &BV| {
            let mut machine = Machine::new(source, Type::unsigned(width), [("x", Bits::new(x.clone()))]);
            let value = machine.step(step)?;
            value.map_or_else(|| machine.value("x"), Ok).map(|value| value.bits)
        };
        let there = run(&x)?;
        q.claim("each step is undone", undo.of(&there).eq(&x));
        let back = undo.of(&x);
        q.claim("each step undoes", run(&back)?.eq(&x));
    }
    Ok(())
}
