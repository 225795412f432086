//! The remainder by a reciprocal, in integers: products of 64 unknown bits are too difficult for bit-blasting.
//!
//! The formulas are those of the library's text, with its remainders modulo powers of two. With W = 2^32 or 2^64, the
//! key k, M = floor((W - 1) / H) and kM = qW + l,
//!
//! ```text
//! W (k - qH) = l H + k (W - M H),
//! ```
//!
//! where both terms lie between 0 and WH: so 0 <= k - qH < 2H, and the remainder, the only number below H that differs
//! from k by a multiple of H, is that or H less. The claims are the steps of that proof, in order.

use syn::visit::Visit;
use syn::{Expr, FieldValue};
use z3::ast::{Bool, Int};

use crate::hash::{Slip, lemma};
use crate::lemma::{Lemma, Query};
use crate::machine::Machine;
use crate::numbers::{Whole, power};
use crate::source::{Source, Type, text};

/// Returns all lemmas.
pub(crate) fn lemmas() -> Result<Vec<Lemma>, String> {
    let narrow = Slip {
        says: "quotient shifted by 31",
        from: "(self.reciprocal >> 32)) >> 32",
        to: "(self.reciprocal >> 32)) >> 31",
    };
    let wide = Slip {
        says: "quotient shifted by 63",
        from: "u128::from(self.reciprocal)) >> 64",
        to: "u128::from(self.reciprocal)) >> 63",
    };
    Ok(vec![
        lemma("k mod H by the reciprocal, u32", "[HASH-1]", 32, of_u32, narrow)?,
        lemma("k mod H by the reciprocal, u64", "[HASH-1]", 64, of_u64, wide)?,
    ])
}

fn of_u32(source: &Source, q: &mut Query) -> Result<(), String> {
    remainder(source, q, 32)
}

fn of_u64(source: &Source, q: &mut Query) -> Result<(), String> {
    remainder(source, q, 64)
}

fn times(a: &Int, b: &Int) -> Int {
    Int::mul(&[a, b])
}

fn between(low: &Int, value: &Int, high: &Int) -> Bool {
    Bool::and(&[low.le(value), value.le(high)])
}

fn remainder(source: &Source, q: &mut Query, width: u32) -> Result<(), String> {
    let (key, size) = (q.integer("key"), q.integer("H"));
    let (zero, one) = (Int::from_u64(0), Int::from_u64(1));
    q.assume(between(&one, &size, &Int::from_u64(1 << 31)));
    q.assume(between(&zero, &key, &Int::sub(&[power(width), one.clone()])));
    q.chain();
    let stored = [("size.get()", Whole::new(size.clone(), 32))];
    let stored = Machine::new(source, Type::unsigned(64), stored).eval(&reciprocal(source)?, None)?.number;
    let top = power(64);
    let after = Int::sub(&[&top, &times(&stored, &size)]);
    q.claim("M for 64 bits is the floor", between(&one, &after, &size));
    let m = if width == 64 { stored.clone() } else { stored.div(power(32)) };
    if width == 32 {
        let low = stored.modulo(power(32));
        let high = Int::sub(&[power(32), one.clone()]);
        q.step("a low half times H", between(&zero, &times(&low, &size), &times(&high, &size)));
        q.step(
            "halves",
            times(&stored, &size).eq(Int::add(&[times(&power(32), &times(&m, &size)), times(&low, &size)])),
        );
    }
    let word = power(width);
    let after = Int::sub(&[&word, &times(&m, &size)]);
    q.claim("M is the floor", between(&one, &after, &size));
    q.claim("M fits", between(&zero, &m, &word));

    let product = times(&key, &m);
    let (quotient, low) = (product.div(&word), product.modulo(&word));
    let rest = Int::sub(&[&key, &times(&quotient, &size)]);
    q.step("kM = qW + l", product.eq(Int::add(&[times(&quotient, &word), low.clone()])));
    q.step("0 <= l < W", Bool::and(&[low.ge(0), low.lt(&word)]));
    q.step("0 <= l H <= (W - 1) H", between(&zero, &times(&low, &size), &times(&Int::sub(&[&word, &one]), &size)));
    let other = times(&key, &after);
    q.claim("0 <= k (W - MH) <= (W - 1) H", between(&zero, &other, &times(&Int::sub(&[&word, &one]), &size)));
    let sum = Int::add(&[times(&low, &size), other]);
    q.step("W (k - qH) = l H + k (W - MH)", times(&word, &rest).eq(sum));
    q.claim("0 <= k - qH < 2H", Bool::and(&[rest.ge(0), rest.lt(times(&Int::from_u64(2), &size))]));

    let name = if width == 64 { "Reciprocal::of_u64" } else { "Reciprocal::of_u32" };
    let values = [("key", &key, width), ("self.size", &size, 32), ("self.reciprocal", &stored, 64)];
    let values = values.map(|(text, number, width)| (text, Whole::new(number.clone(), width)));
    let result = Machine::new(source, Type::unsigned(64), values).run(&source.function(name)?.body)?;
    let result = result.ok_or("no value")?.number;
    q.claim("it is k - qH, or that less H", Bool::or(&[result.eq(&rest), result.eq(Int::sub(&[&rest, &size]))]));
    q.claim("it is below H", Bool::and(&[result.ge(0), result.lt(&size)]));
    Ok(())
}

/// Returns the stored value of `Reciprocal::of`.
fn reciprocal(source: &Source) -> Result<Expr, String> {
    struct Field(Option<Expr>);
    impl<'ast> Visit<'ast> for Field {
        fn visit_field_value(&mut self, field: &'ast FieldValue) {
            if text(&field.member) == "reciprocal" {
                self.0 = Some(field.expr.clone());
            }
        }
    }
    let mut field = Field(None);
    field.visit_block(&source.function("Reciprocal::of")?.body);
    field.0.ok_or_else(|| "no reciprocal is stored".into())
}
