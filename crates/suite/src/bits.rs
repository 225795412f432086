//! Words as lists of bits: literal, and of any length.

/// Bits, the highest first.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Bits(pub(crate) Vec<bool>);

impl Bits {
    /// Returns the key of the root.
    pub(crate) fn root() -> Self {
        Self(vec![true])
    }

    /// Returns `count` zeros.
    pub(crate) fn zeros(count: usize) -> Self {
        Self(vec![false; count])
    }

    pub(crate) fn is_zero(&self) -> bool {
        !self.0.contains(&true)
    }

    pub(crate) fn trailing(&self, bit: bool) -> usize {
        self.0.iter().rev().take_while(|&&other| other == bit).count()
    }

    pub(crate) fn then(mut self, bit: bool) -> Self {
        self.0.push(bit);
        self
    }

    pub(crate) fn flip_last(mut self) -> Self {
        if let Some(last) = self.0.last_mut() {
            *last = !*last;
        }
        self
    }

    /// Removes the lowest bits.
    pub(crate) fn without(mut self, count: usize) -> Self {
        self.0.truncate(self.0.len().saturating_sub(count));
        self
    }

    pub(crate) fn complement(mut self) -> Self {
        self.0.iter_mut().for_each(|bit| *bit = !*bit);
        self
    }

    /// Prepends zeros up to a length; `None` if there are more bits.
    pub(crate) fn of_length(self, length: usize) -> Option<Self> {
        let above = length.checked_sub(self.0.len())?;
        Some(Self([vec![false; above], self.0].concat()))
    }

    /// Parses the output of [`hex`](Self::hex), without leading zeros; `None` for other text.
    pub(crate) fn of_hex(digits: &str) -> Option<Self> {
        let is_plain = digits == "0" || !digits.is_empty() && !digits.starts_with('0');
        let digit = |c: char| c.to_digit(16).filter(|_| !c.is_ascii_uppercase());
        let digits = digits.chars().map(digit).collect::<Option<Vec<_>>>().filter(|_| is_plain)?;
        let bits = digits.iter().flat_map(|digit| [8, 4, 2, 1].map(|bit| digit & bit != 0));
        Some(Self(bits.skip_while(|&bit| !bit).collect()))
    }

    /// Returns the number; `None` if it has more than 64 bits.
    pub(crate) fn number(&self) -> Option<u64> {
        (self.0.len() <= 64).then(|| self.0.iter().fold(0, |number, &bit| 2 * number + u64::from(bit)))
    }

    pub(crate) fn hex(&self) -> String {
        let digits: String = self
            .0
            .rchunks(4)
            .rev()
            .map(|digit| digit.iter().fold(0, |digit, &bit| 2 * digit + u32::from(bit)))
            .filter_map(|digit| char::from_digit(digit, 16))
            .collect();
        let digits = digits.trim_start_matches('0');
        if digits.is_empty() { "0".to_owned() } else { digits.to_owned() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_come_back() {
        for value in [0, 1, 0xf, 0x10, 0x1f, u64::MAX / 2, u64::MAX] {
            let bits = Bits::of_hex(&format!("{value:x}")).unwrap();
            assert_eq!((bits.number(), bits.hex()), (Some(value), format!("{value:x}")));
        }
        let long = Bits::of_hex(&"1".repeat(80)).unwrap();
        assert_eq!((long.number(), long.hex()), (None, "1".repeat(80)));
        assert_eq!(Bits::of_hex("2").unwrap().of_length(3), Some(Bits(vec![false, true, false])));
        assert_eq!(Bits::of_hex("2").unwrap().of_length(1), None);
        for wrong in ["", "00", "01", "0x1", "F", "-1", " 1", "g"] {
            assert_eq!(Bits::of_hex(wrong), None, "{wrong}");
        }
    }
}
