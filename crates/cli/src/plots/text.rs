//! Upper bounds of text widths, without access to the font.

use std::fmt::Write;

/// Fonts of charts, in order of preference. No font is wider than [`WIDTHS`], if it is the system's default font.
pub(super) const FONT: &str = "Inter,system-ui,'Segoe UI','DejaVu Sans','Liberation Sans',Arial,sans-serif";

/// Font sizes: titles, and other text.
pub(super) const TITLE: f64 = 17.0;
pub(super) const SMALL: f64 = 13.0;

/// Height of a line, relative to the font size.
pub(super) const LINE: f64 = 1.17;

/// Widths of the printable ASCII characters from the space on, in thousandths of the font size: the widths of `DejaVu
/// Sans`, the widest of the fonts; for the hyphen the width of Inter.
const WIDTHS: [u16; 95] = [
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 460, 318, 337, 636, 636, 636, 636, 636, 636, 636,
    636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632, 575, 775, 752, 295, 295, 656, 557, 863,
    748, 787, 603, 787, 695, 635, 611, 732, 684, 989, 685, 611, 685, 390, 337, 390, 838, 500, 500, 613, 635, 550, 635,
    615, 352, 635, 634, 278, 278, 579, 278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592, 818, 592, 592, 525, 636,
    337, 636, 838,
];

/// Relative font size of exponents.
const EXPONENT: f64 = 0.75;

/// An upper bound of the width of a text. Titles are bold.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let letter = |letter: char| match u32::from(letter) {
        code @ 32..=126 => f64::from(WIDTHS[code as usize - 32]),
        // Letters with accents; then characters that may be as wide as they are high.
        0xC0..=0x24F => 800.0,
        _ => 1000.0,
    };
    let run = |(run, is_exponent): (&str, bool)| {
        run.chars().map(letter).sum::<f64>() * if is_exponent { EXPONENT } else { 1.0 }
    };
    let bold = if size == TITLE { 1.12 } else { 1.0 };
    runs(text).into_iter().map(run).sum::<f64>() / 1000.0 * size * bold
}

/// The text as SVG markup; `10^-6` becomes an exponent.
pub(super) fn markup(text: &str, size: f64) -> String {
    let mut svg = String::new();
    for (run, is_exponent) in runs(text) {
        let run = escaped(run);
        if is_exponent {
            let (up, small) = (0.4 * size, EXPONENT * size);
            let minus = run.replace('-', "−");
            let _ = write!(
                svg,
                "<tspan dy=\"-{up:.1}\" font-size=\"{small:.1}\">{minus}</tspan><tspan dy=\"{up:.1}\">\u{200b}</tspan>"
            );
        } else {
            svg += &run;
        }
    }
    svg
}

/// Wraps a text into lines of at most `room`, except for wider words. `width` measures parts of a line.
///
/// ```
/// let letters = |text: &str| text.len() as f64;
/// assert_eq!(crate::plots::wrap("one two three", 8.0, letters), ["one two", "three"]);
/// ```
pub(crate) fn wrap(text: &str, room: f64, width: impl Fn(&str) -> f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(line) + width(" ") + width(word) <= room => line.extend([" ", word]),
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Escapes text for an element or an attribute of SVG.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Splits a text into parts, and returns whether each part is an exponent: digits after `^`.
fn runs(text: &str) -> Vec<(&str, bool)> {
    let mut runs = Vec::new();
    let mut parts = text.split('^');
    runs.extend(parts.next().map(|first| (first, false)));
    for part in parts {
        let end = part.find(|c: char| c != '-' && !c.is_ascii_digit()).unwrap_or(part.len());
        runs.extend([(&part[..end], true), (&part[end..], false)]);
    }
    runs.retain(|(run, _)| !run.is_empty());
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_are_small_and_high() {
        assert_eq!(runs("10^-6 of 10^9"), [("10", false), ("-6", true), (" of 10", false), ("9", true)]);
        assert!(width("10^9", 10.0) < width("109", 10.0) && width("10^9", 10.0) > width("10", 10.0));
        assert!(markup("10^-6 & x", 10.0).contains(">−6</tspan>") && markup("a<b", 10.0).contains("a&lt;b"));
    }

    #[test]
    fn lines_are_as_wide_as_the_room() {
        let text = "levels up to the ancestor whose sibling comes next";
        for room in [90.0, 150.0, 1000.0] {
            let lines = wrap(text, room, |part| width(part, SMALL));
            assert!(lines.iter().all(|line| width(line, SMALL) <= room), "{lines:?}");
            assert_eq!(lines.join(" "), text);
        }
    }
}
