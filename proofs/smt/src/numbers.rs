//! Two kinds of unknown numbers: bits, for bit-blasting, and integers, for products.

use z3::ast::{BV, Bool, Int};

use crate::machine::{Number, Op};
use crate::source::Type;
use crate::word::{self, require};

/// Unknown bits.
#[derive(Clone)]
pub(crate) struct Bits {
    pub(crate) bits: BV,
    signed: bool,
}

impl Bits {
    /// Builds an unsigned number.
    pub(crate) fn new(bits: BV) -> Self {
        Self { bits, signed: false }
    }

    fn truth(condition: &Bool) -> Self {
        Self::new(condition.ite(&BV::from_u64(1, 1), &BV::from_u64(0, 1)))
    }
}

impl Number for Bits {
    fn literal(value: u128, ty: Type) -> Self {
        let [low, high] = [value as u64, (value >> 64) as u64].map(|half| BV::from_u64(half, 64));
        Self { bits: high.concat(&low).extract(ty.width - 1, 0), signed: ty.signed }
    }

    fn ty(&self) -> Type {
        Type { width: self.bits.get_size(), signed: self.signed }
    }

    fn is_true(&self) -> Result<Bool, String> {
        if self.bits.get_size() == 1 { Ok(self.bits.eq(BV::from_u64(1, 1))) } else { Err("not a truth value".into()) }
    }

    fn cast(&self, to: Type) -> Self {
        let width = self.bits.get_size();
        let bits = if to.width <= width {
            self.bits.extract(to.width - 1, 0)
        } else if self.signed {
            self.bits.sign_ext(to.width - width)
        } else {
            self.bits.zero_ext(to.width - width)
        };
        Self { bits, signed: to.signed }
    }

    fn binary(&self, op: Op, other: &Self) -> Result<Self, String> {
        let (a, b, signed) = (&self.bits, &other.bits, self.signed);
        if matches!(op, Op::Shl | Op::Shr) {
            require(b.bvult(BV::from_u64(a.get_size().into(), a.get_size())));
        }
        let bits = match op {
            Op::Add => {
                require(a.bvadd_no_overflow(b, signed));
                if signed {
                    require(a.bvadd_no_underflow(b));
                }
                a.bvadd(b)
            }
            Op::Sub => {
                require(a.bvsub_no_underflow(b, signed));
                if signed {
                    require(a.bvsub_no_overflow(b));
                }
                a.bvsub(b)
            }
            Op::And => a.bvand(b),
            Op::Or => a.bvor(b),
            Op::Xor => a.bvxor(b),
            Op::Shl => a.bvshl(b),
            Op::Shr if signed => a.bvashr(b),
            Op::Shr => a.bvlshr(b),
            Op::WrappingAdd => a.bvadd(b),
            Op::WrappingSub => a.bvsub(b),
            Op::WrappingMul => a.bvmul(b),
            Op::Min if !signed => a.bvult(b).ite(a, b),
            Op::Equal => return Ok(Self::truth(&a.eq(b))),
            Op::Unequal => return Ok(Self::truth(&a.eq(b).not())),
            Op::Min | Op::Mul | Op::Div => return Err(format!("{op:?} is not there for bits")),
        };
        Ok(Self { bits, signed })
    }

    fn not(&self) -> Result<Self, String> {
        Ok(Self { bits: self.bits.bvnot(), signed: self.signed })
    }

    fn trailing_zeros(&self) -> Result<Self, String> {
        Ok(Self::new(word::trailing_zeros(&self.bits)))
    }

    fn select(&self, yes: &Self, no: &Self) -> Result<Self, String> {
        Ok(Self { bits: self.is_true()?.ite(&yes.bits, &no.bits), signed: yes.signed })
    }
}

/// An unknown integer in the range of an unsigned type.
#[derive(Clone)]
pub(crate) struct Whole {
    pub(crate) number: Int,
    width: u32,
}

/// Returns two to the power `width`.
pub(crate) fn power(width: u32) -> Int {
    let half = |bits: u32| Int::from_u128(1 << bits.min(127));
    Int::mul(&[half(width.min(64)), half(width.saturating_sub(64))])
}

impl Whole {
    /// Builds a number that the caller guarantees to fit.
    pub(crate) fn new(number: Int, width: u32) -> Self {
        Self { number, width }
    }

    fn wrapped(&self, number: &Int) -> Self {
        Self::new(number.modulo(power(self.width)), self.width)
    }

    fn checked(&self, number: Int) -> Self {
        require(number.ge(0));
        require(number.lt(power(self.width)));
        Self::new(number, self.width)
    }
}

impl Number for Whole {
    fn literal(value: u128, ty: Type) -> Self {
        Self::new(Int::from_u128(value), ty.width)
    }

    fn ty(&self) -> Type {
        Type::unsigned(self.width)
    }

    fn is_true(&self) -> Result<Bool, String> {
        Err("a whole number is no truth value".into())
    }

    fn cast(&self, to: Type) -> Self {
        if to.width < self.width {
            Self::new(self.number.modulo(power(to.width)), to.width)
        } else {
            Self::new(self.number.clone(), to.width)
        }
    }

    fn binary(&self, op: Op, other: &Self) -> Result<Self, String> {
        let (a, b) = (&self.number, &other.number);
        Ok(match op {
            Op::Add => self.checked(Int::add(&[a, b])),
            Op::Sub => self.checked(Int::sub(&[a, b])),
            Op::Mul => self.checked(Int::mul(&[a, b])),
            Op::Div => {
                require(b.gt(0));
                Self::new(a.div(b), self.width)
            }
            Op::Shr => {
                let by = b.as_u64().and_then(|by| u32::try_from(by).ok()).ok_or("a shift by an unknown")?;
                Self::new(a.div(power(by)), self.width)
            }
            Op::WrappingAdd => self.wrapped(&Int::add(&[a, b])),
            Op::WrappingSub => self.wrapped(&Int::sub(&[a, b])),
            Op::WrappingMul => self.wrapped(&Int::mul(&[a, b])),
            Op::Min => Self::new(a.lt(b).ite(a, b), self.width),
            _ => return Err(format!("{op:?} is not there for whole numbers")),
        })
    }

    fn not(&self) -> Result<Self, String> {
        Err("a complement of a whole number".into())
    }

    fn trailing_zeros(&self) -> Result<Self, String> {
        Err("trailing zeros of a whole number".into())
    }

    fn select(&self, _: &Self, _: &Self) -> Result<Self, String> {
        Err("a choice of whole numbers".into())
    }
}
