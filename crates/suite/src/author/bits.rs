//! Words as lists of bits: as literal as can be, and of any length.

/// Bits, the highest first.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Bits(pub(super) Vec<bool>);

impl Bits {
    /// Key of the root.
    pub(super) fn root() -> Self {
        Self(vec![true])
    }

    /// As many zeros as are asked for.
    pub(super) fn zeros(count: usize) -> Self {
        Self(vec![false; count])
    }

    pub(super) fn is_zero(&self) -> bool {
        !self.0.contains(&true)
    }

    pub(super) fn trailing(&self, bit: bool) -> usize {
        self.0.iter().rev().take_while(|&&other| other == bit).count()
    }

    pub(super) fn then(mut self, bit: bool) -> Self {
        self.0.push(bit);
        self
    }

    pub(super) fn flip_last(mut self) -> Self {
        if let Some(last) = self.0.last_mut() {
            *last = !*last;
        }
        self
    }

    /// Without the lowest bits.
    pub(super) fn without(mut self, count: usize) -> Self {
        self.0.truncate(self.0.len().saturating_sub(count));
        self
    }

    pub(super) fn complement(mut self) -> Self {
        self.0.iter_mut().for_each(|bit| *bit = !*bit);
        self
    }

    pub(super) fn hex(&self) -> String {
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
