//! Objects and floats in the format of the suite's files, and quotations of untrusted text.

use core::fmt::{self, Write as _};
use std::io::{self, BufRead, Read as _};

use serde::de::{Error as _, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value, json};

/// Builds an object from named values.
pub(super) fn object<'a>(fields: impl IntoIterator<Item = (&'a str, Value)>) -> Map<String, Value> {
    fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// Formats the bits of floats: 8 digits each, separated by spaces.
pub(super) fn floats(floats: &[f32]) -> String {
    floats.iter().map(|float| format!("{:08x}", float.to_bits())).collect::<Vec<_>>().join(" ")
}

/// Parses exactly `N` floats.
pub(super) fn parse_floats<const N: usize>(text: &str) -> Option<[f32; N]> {
    let mut words = text.split(' ');
    let mut floats = [0.0; N];
    for float in &mut floats {
        let is_digit = |byte: u8| matches!(byte, b'0'..=b'9' | b'a'..=b'f');
        let digits = words.next().filter(|digits| digits.len() == 8 && digits.bytes().all(is_digit))?;
        *float = f32::from_bits(u32::from_str_radix(digits, 16).ok()?);
    }
    words.next().is_none().then_some(floats)
}

/// Formats a hit with its distance and weights for answers.
pub(super) fn hit(prim: u32, [t, u, v]: [f32; 3]) -> Value {
    let bits = |x: f32| floats(&[x]);
    json!({ "prim": prim, "t": bits(t), "u": bits(u), "v": bits(v) })
}

/// The maximum length of a line, in bytes.
const MOST_BYTES: u64 = 64 << 20;

/// Reads the next line with its line end; `None` after the last. A line that is too long or not text gives
/// [`InvalidData`](io::ErrorKind::InvalidData).
pub(super) fn read_line(input: &mut impl BufRead) -> io::Result<Option<String>> {
    let mut bytes = Vec::new();
    if input.by_ref().take(MOST_BYTES).read_until(b'\n', &mut bytes)? == 0 {
        return Ok(None);
    }
    let invalid = |what: String| io::Error::new(io::ErrorKind::InvalidData, what);
    if bytes.last() != Some(&b'\n') && bytes.len() as u64 == MOST_BYTES {
        return Err(invalid(format!("a line of more than {MOST_BYTES} bytes")));
    }
    String::from_utf8(bytes).map(Some).map_err(|error| invalid(format!("a line that is not UTF-8: {error}")))
}

/// Parses JSON whose objects have no duplicate keys. (`serde_json` would accept them and use the last value.)
///
/// ```
/// use stackless_suite::parse_json;
///
/// assert_eq!(parse_json("[1]")?, serde_json::json!([1]));
/// assert!(parse_json(r#"{"a": 1, "a": 1}"#).unwrap_err().to_string().starts_with("the key `a` stands twice"));
/// # Ok::<(), serde_json::Error>(())
/// ```
///
/// # Errors
/// [`serde_json::Error`]: of syntax, or of data for a duplicate key.
pub fn parse_json(text: &str) -> serde_json::Result<Value> {
    serde_json::from_str::<Strict>(text).map(|Strict(value)| value)
}

struct Strict(Value);

impl<'de> Deserialize<'de> for Strict {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(StrictVisitor).map(Self)
    }
}

struct StrictVisitor;

impl<'de> Visitor<'de> for StrictVisitor {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("JSON")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_str<E>(self, value: &str) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
        let mut list = Vec::new();
        while let Some(Strict(item)) = items.next_element()? {
            list.push(item);
        }
        Ok(Value::Array(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut fields: A) -> Result<Value, A::Error> {
        let mut map = Map::new();
        while let Some((name, Strict(value))) = fields.next_entry::<String, _>()? {
            if map.contains_key(&name) {
                return Err(A::Error::custom(format_args!("the key `{}` stands twice", Shown(name))));
            }
            map.insert(name, value);
        }
        Ok(Value::Object(map))
    }
}

/// Untrusted text for a message: its beginning, on one line.
pub(super) struct Shown<T>(pub(super) T);

impl<T: AsRef<str>> fmt::Display for Shown<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const MOST: usize = 120;
        let text = self.0.as_ref().trim_end();
        for c in text.chars().take(MOST) {
            if is_seen(c) { f.write_char(c)? } else { write!(f, "{}", c.escape_unicode())? }
        }
        if text.chars().nth(MOST).is_some() { f.write_char('…') } else { Ok(()) }
    }
}

/// Returns whether a character is printable and safe in a terminal: neither a control code nor a change of writing
/// direction.
fn is_seen(c: char) -> bool {
    !c.is_control()
        && !matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_come_back() {
        assert_eq!(floats(&[1.0, -0.0]), "3f800000 80000000");
        assert_eq!(
            parse_floats("3f800000 80000000").map(|[a, b]: [f32; 2]| [a.to_bits(), b.to_bits()]),
            Some([0x3f80_0000, 1 << 31])
        );
        assert_eq!(parse_floats::<1>("3f800000 80000000"), None);
        assert_eq!(parse_floats::<1>("3f80000"), None);
        assert_eq!(parse_floats::<2>("3f800000"), None);
    }

    #[test]
    fn what_others_write_does_nothing() {
        let shown = Shown("a\u{1b}[2J\u{9b}b\u{202e}c\u{feff}\nd").to_string();
        assert_eq!(shown, "a\\u{1b}[2J\\u{9b}b\\u{202e}c\\u{feff}\\u{a}d");
    }

    #[test]
    fn hits_are_written_by_their_bits() {
        let written = hit(3, [1.0, -0.0, 0.5]);
        assert_eq!(written, json!({ "prim": 3, "t": "3f800000", "u": "80000000", "v": "3f000000" }));
    }
}
