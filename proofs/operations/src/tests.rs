//! The reader's meanings of external operations, tested on numbers.

use crate::glam as meaning;

/// Numbers of all kinds, the components of random vectors.
const KINDS: [f64; 12] =
    [0.0, -0.0, 1.0, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 5e-324, -1e-310, 1e-40, 3.4e38, -1.7e308];

/// A generator of random numbers (Steele, Lea & Flood 2014).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    }

    /// Draws random bits, a special number, or one of ordinary magnitude.
    fn double(&mut self) -> f64 {
        match self.bits() % 3 {
            0 => f64::from_bits(self.bits()),
            1 => KINDS[(self.bits() % KINDS.len() as u64) as usize],
            _ => (self.bits() as i32).into(),
        }
    }

    fn single(&mut self) -> f32 {
        match self.bits() % 3 {
            0 => f32::from_bits(self.bits() as u32),
            1 => KINDS[(self.bits() % KINDS.len() as u64) as usize] as f32,
            _ => (self.bits() as i16).into(),
        }
    }
}

const TURNS: u32 = 100_000;

/// Compares numbers in every bit. All NaNs are equal, as in Rocq.
fn same<const N: usize>(ours: [f64; N], theirs: [f64; N], what: &str) {
    for (x, y) in ours.into_iter().zip(theirs) {
        assert!(x.to_bits() == y.to_bits() || x.is_nan() && y.is_nan(), "{what}: {ours:?} is not {theirs:?}");
    }
}

fn wide<const N: usize>(of: [f32; N]) -> [f64; N] {
    of.map(f64::from)
}

fn bits(mask: u32) -> [f64; 1] {
    [mask.into()]
}

#[test]
fn dvec3() {
    let mut random = Random(1);
    for _ in 0..TURNS {
        let [a, b] = [0; 2].map(|_| [0; 3].map(|_| random.double()));
        let (x, y) = (meaning::DVec3::new(a[0], a[1], a[2]), meaning::DVec3::new(b[0], b[1], b[2]));
        let (p, q) = (glam::DVec3::from_array(a), glam::DVec3::from_array(b));
        same((x - y).to_array(), (p - q).to_array(), "sub");
        same((x + y).to_array(), (p + q).to_array(), "add");
        same((x + b[0]).to_array(), (p + b[0]).to_array(), "add");
        same((x * b[0]).to_array(), (p * b[0]).to_array(), "mul");
        same([x.dot(y)], [p.dot(q)], "dot");
        same([x.length()], [p.length()], "length");
        same(x.cross(y).to_array(), p.cross(q).to_array(), "cross");
        same(x.abs().to_array(), p.abs().to_array(), "abs");
        same(x.recip().to_array(), p.recip().to_array(), "recip");
        if !p.is_nan() {
            assert_eq!(x.max_element(), p.max_element());
        }
        same(x.map(|x| x * 3.0).to_array(), p.map(|x| x * 3.0).to_array(), "map");
        let ours = meaning::DVec3::select(x.cmplt(y), x, y);
        same(ours.to_array(), glam::DVec3::select(p.cmplt(q), p, q).to_array(), "select");
        same(meaning::DVec3::ZERO.to_array(), glam::DVec3::ZERO.to_array(), "ZERO");
        same(meaning::DVec3::NAN.to_array(), glam::DVec3::NAN.to_array(), "NAN");
    }
}

#[test]
fn vec3() {
    let mut random = Random(2);
    for _ in 0..TURNS {
        let [a, b] = [0; 2].map(|_| [0; 3].map(|_| random.single()));
        let (x, y) = (meaning::Vec3::new(a[0], a[1], a[2]), meaning::Vec3::new(b[0], b[1], b[2]));
        let (p, q) = (glam::Vec3::from_array(a), glam::Vec3::from_array(b));
        same(wide((x - y).to_array()), wide((p - q).to_array()), "sub");
        same(wide((x + y).to_array()), wide((p + q).to_array()), "add");
        same(wide((x * b[0]).to_array()), wide((p * b[0]).to_array()), "mul");
        same([x.dot(y).into()], [p.dot(q).into()], "dot");
        same(wide(x.cross(y).to_array()), wide(p.cross(q).to_array()), "cross");
        same(wide(x.abs().to_array()), wide(p.abs().to_array()), "abs");
        same(wide(x.recip().to_array()), wide(p.recip().to_array()), "recip");
        same(wide(x.max(y).to_array()), wide(p.max(q).to_array()), "max");
        if !p.is_nan() {
            assert_eq!(x.max_element(), p.max_element());
        }
        same(x.as_dvec3().to_array(), p.as_dvec3().to_array(), "as_dvec3");
        same(wide(x.extend(b[0]).to_array()), wide(p.extend(b[0]).to_array()), "extend");
        assert_eq!(meaning::Vec3::ZERO.to_array(), glam::Vec3::ZERO.to_array());
        let ours = meaning::Vec3::select(x.is_finite_mask(), x, meaning::Vec3::INFINITY);
        same(
            wide(ours.to_array()),
            wide(glam::Vec3::select(p.is_finite_mask(), p, glam::Vec3::INFINITY).to_array()),
            "select",
        );
    }
}

/// Also `min` and `max`, which are SSE instructions: the kernels call them only there.
#[test]
fn vec4() {
    use glam::Vec4Swizzles as _;
    let mut random = Random(3);
    for _ in 0..TURNS {
        let [a, b] = [0; 2].map(|_| [0; 4].map(|_| random.single()));
        let (x, y) = (meaning::Vec4::from(a), meaning::Vec4::from(b));
        let (p, q) = (glam::Vec4::from(a), glam::Vec4::from(b));
        let each = |ours: meaning::Vec4, theirs: glam::Vec4, what| {
            same(wide(ours.to_array()), wide(theirs.to_array()), what);
        };
        each(x - y, p - q, "sub");
        each(x * y, p * q, "mul");
        each(x / y, p / q, "div");
        each(x * b[0], p * b[0], "mul by a number");
        each(x + b[0], p + b[0], "add");
        each(x.abs(), p.abs(), "abs");
        if cfg!(all(target_arch = "x86_64", target_feature = "sse2")) {
            each(x.min(y), p.min(q), "min");
            each(x.max(y), p.max(q), "max");
        }
        each(x.xxxx(), p.xxxx(), "xxxx");
        each(x.yyyy(), p.yyyy(), "yyyy");
        each(x.zzzz(), p.zzzz(), "zzzz");
        each(x.yxwz(), p.yxwz(), "yxwz");
        each(meaning::Vec4::splat(a[0]), glam::Vec4::splat(a[0]), "splat");
        each(meaning::Vec4::select(x.cmplt(y), x, y), glam::Vec4::select(p.cmplt(q), p, q), "select");
        same(wide(x.truncate().to_array()), wide(p.truncate().to_array()), "truncate");
        assert_eq!([0, 1, 2, 3].map(|i| x.cmplt(y).test(i)), [0, 1, 2, 3].map(|i| p.cmplt(q).test(i)), "test");
        same(bits(x.cmpeq(y).bitmask()), bits(p.cmpeq(q).bitmask()), "cmpeq");
        same(bits(x.cmplt(y).bitmask()), bits(p.cmplt(q).bitmask()), "cmplt");
        same(bits(x.cmpgt(y).bitmask()), bits(p.cmpgt(q).bitmask()), "cmpgt");
        same(bits(x.cmple(y).bitmask()), bits(p.cmple(q).bitmask()), "cmple");
        same(bits((x.cmpeq(y) | x.cmplt(y)).bitmask()), bits((p.cmpeq(q) | p.cmplt(q)).bitmask()), "bitor");
        same(bits((x.cmple(y) & x.cmpgt(x)).bitmask()), bits((p.cmple(q) & p.cmpgt(p)).bitmask()), "bitand");
    }
    let same = |ours: meaning::Vec4, theirs: glam::Vec4| assert_eq!(ours.to_array(), theirs.to_array());
    same(meaning::Vec4::ZERO, glam::Vec4::ZERO);
    same(meaning::Vec4::ONE, glam::Vec4::ONE);
    same(meaning::Vec4::MAX, glam::Vec4::MAX);
    same(meaning::Vec4::INFINITY, glam::Vec4::INFINITY);
}

/// Rust leaves the sign of a zero open, and drops NaN. The reader's meaning is for other numbers.
#[test]
fn greater_and_lesser() {
    let mut random = Random(4);
    for _ in 0..TURNS {
        let [a, b] = [random.double(), random.double()];
        if !a.is_nan() && !b.is_nan() {
            assert_eq!(a.max(b), if a > b { a } else { b });
            assert_eq!(a.min(b), if a < b { a } else { b });
        }
        same([a.recip()], [1.0 / a], "recip");
    }
}

/// Adding to the bits gives the next numbers in magnitude, up to infinity and down to 0. Exclusive or changes the sign
/// by that of the other number. Bits of an exponent are a power of two. The lowest bits are those of the significand.
#[test]
#[expect(clippy::cast_precision_loss, reason = "a significand has 53 bits")]
fn bits_of_numbers() {
    fn moved(x: f64, by: i64) -> f64 {
        let step = |x: f64| if by < 0 { x.next_down() } else { x.next_up() };
        let magnitude = (0..by.abs()).fold(x.abs(), |x, _| step(x));
        magnitude.copysign(x)
    }
    let mut random = Random(5);
    for _ in 0..TURNS {
        let [x, y] = [random.double(), random.double()];
        for by in [-3, -2, 2, 3] {
            if !x.is_nan() && (by < 0 || x.is_finite()) && (by > 0 || x.abs() > 2e-323) {
                same([f64::from_bits(x.to_bits().wrapping_add_signed(by))], [moved(x, by)], "moved");
            }
        }
        if !y.is_nan() {
            let changed = f64::from_bits(x.to_bits() ^ y.to_bits() & 1 << 63);
            same([changed], [if y.is_sign_negative() { -x } else { x }], "sign");
        }
        if !x.is_nan() {
            let magnitude = (x.to_bits() & ((1 << 63) - 1)) + 2;
            let capped = f64::from_bits(magnitude.min(f64::INFINITY.to_bits()) | x.to_bits() & 1 << 63);
            same([capped], [moved(x, 2)], "capped");
        }
        if x.is_finite() {
            let (exponent, fraction) = (x.to_bits() >> 52 & 0x7ff, x.to_bits() & ((1 << 52) - 1));
            let significand = fraction | u64::from(exponent > 0) << 52;
            let unit = f64::from_bits(if exponent >= 53 { (exponent - 52) << 52 } else { 1 << (exponent.max(1) - 1) });
            let cleared = f64::from_bits(x.to_bits() & ((1 << 63) - 4));
            same([cleared], [(significand >> 2 << 2) as f64 * unit], "cleared");
        }
        let power = f64::from_bits(x.to_bits() & 0x7ff << 52);
        if x.is_normal() {
            assert!(power <= x.abs() && x.abs() / 2.0 < power && power.to_bits().trailing_zeros() >= 52, "{x}");
        } else {
            same([power], [if x.is_finite() { 0.0 } else { f64::INFINITY }], "power");
        }
    }
}
