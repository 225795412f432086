//! Colours, markers and dashes of all charts.
//!
//! Every colour is a class of the style sheet in the SVG, with a value for light screens and paper, and one for dark
//! screens. Programs without support for the media query show the light values. The series are darker or lighter
//! variants of the colours of Okabe & Ito, which colour-blind people can distinguish. Each series also has its own
//! marker and dash, for grey prints.

use std::fmt::Write;

use super::text::FONT;

/// A colour, on light and on dark paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Ink {
    /// Its class.
    pub(super) name: &'static str,
    /// As `#rrggbb`, on white.
    pub(super) light: &'static str,
    /// As `#rrggbb`, on [`PAPER`]'s dark.
    pub(super) dark: &'static str,
}

const fn ink(name: &'static str, light: &'static str, dark: &'static str) -> Ink {
    Ink { name, light, dark }
}

/// The background of charts.
pub(super) const PAPER: Ink = ink("paper", "#ffffff", "#1c1f24");

/// Data series.
pub(super) const SERIES: [Ink; 6] = [
    ink("s0", "#0b62a8", "#6cb8f0"),
    ink("s1", "#b84300", "#f5a250"),
    ink("s2", "#00735c", "#35c79c"),
    ink("s3", "#9c3f7c", "#eba0cb"),
    ink("s4", "#756000", "#e8d34a"),
    ink("s5", "#4a505a", "#c4cad3"),
];

/// Colours of text; of secondary text and axes; of errors.
pub(super) const TEXTS: [Ink; 3] =
    [ink("ink", "#23272e", "#e8e6e1"), ink("soft", "#5c6470", "#a0a7b1"), ink("wrong", "#b3152d", "#ff8b95")];

/// Grid lines.
pub(super) const GRID: Ink = ink("grid", "#e2dfd8", "#353a42");

/// Dashes of lines, by series.
const DASHES: [&str; 6] = ["none", "9 4", "2 3", "9 3 2 3", "14 4", "5 3"];

/// The index of a series, which selects colour, marker and dash.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Series(pub(super) usize);

impl Series {
    pub(super) const fn class(self) -> &'static str {
        SERIES[self.0 % SERIES.len()].name
    }

    /// Markers and dashes repeat later than colours.
    const fn shape(self) -> usize {
        (self.0 + self.0 / SERIES.len()) % DASHES.len()
    }

    pub(super) const fn dash(self) -> &'static str {
        DASHES[self.shape()]
    }

    /// The marker at a point, as path data.
    pub(super) fn marker(self, (x, y): (f64, f64), radius: f64) -> String {
        // Shapes around the origin, with similar areas.
        let corners: &[(f64, f64)] = match self.shape() {
            0 => {
                let r = radius;
                return format!("M{:.1} {y:.1}a{r} {r} 0 1 0 {:.1} 0a{r} {r} 0 1 0 {:.1} 0z", x - r, 2.0 * r, -2.0 * r);
            }
            1 => &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
            2 => &[(0.0, -1.25), (1.15, 0.85), (-1.15, 0.85)],
            3 => &[(0.0, -1.3), (1.3, 0.0), (0.0, 1.3), (-1.3, 0.0)],
            4 => &[(0.0, 1.25), (1.15, -0.85), (-1.15, -0.85)],
            _ => &[
                (-0.4, -1.2),
                (0.4, -1.2),
                (0.4, -0.4),
                (1.2, -0.4),
                (1.2, 0.4),
                (0.4, 0.4),
                (0.4, 1.2),
                (-0.4, 1.2),
                (-0.4, 0.4),
                (-1.2, 0.4),
                (-1.2, -0.4),
                (-0.4, -0.4),
            ],
        };
        let mut path = String::new();
        for (i, (dx, dy)) in corners.iter().enumerate() {
            let step = if i == 0 { 'M' } else { 'L' };
            let _ = write!(path, "{step}{:.1} {:.1}", x + radius * dx, y + radius * dy);
        }
        path + "z"
    }
}

/// The style sheet of a chart. Shapes use `currentColor`, so one rule colours a class.
pub(super) fn style() -> String {
    let all = || [PAPER, GRID].into_iter().chain(TEXTS).chain(SERIES);
    let rules = |value: fn(Ink) -> &'static str| {
        let mut text = String::new();
        for ink in all() {
            let _ = write!(text, ".chart .{}{{color:{}}}", ink.name, value(ink));
        }
        text
    };
    format!(
        ".chart text{{font-family:{FONT};fill:currentColor}}{}\n@media screen and (prefers-color-scheme:dark){{{}}}",
        rules(|ink| ink.light),
        rules(|ink| ink.dark)
    )
}

/// The colour map viridis, by van der Walt & Smith: from dark violet over blue and green to yellow, in few enough steps
/// for a palette. Its lightness rises evenly, so it is readable in grey and for colour-blind people.
pub(crate) fn heat(share: f64) -> [u8; 3] {
    const STEPS: f64 = 200.0;
    const STOPS: [[u8; 3]; 9] = [
        [68, 1, 84],
        [71, 45, 123],
        [59, 82, 139],
        [44, 114, 142],
        [33, 145, 140],
        [40, 174, 128],
        [94, 201, 98],
        [173, 220, 48],
        [253, 231, 37],
    ];
    let at = (share.clamp(0.0, 1.0) * STEPS).round() / STEPS * (STOPS.len() - 1) as f64;
    let below = (at as usize).min(STOPS.len() - 2);
    [0, 1, 2].map(|i| {
        let (from, to) = (f64::from(STOPS[below][i]), f64::from(STOPS[below + 1][i]));
        (from + (to - from) * (at - below as f64)).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance of the Web Content Accessibility Guidelines.
    fn luminance(colour: [u8; 3]) -> f64 {
        let linear = colour.map(|channel| {
            let value = f64::from(channel) / 255.0;
            if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        });
        0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    }

    fn contrast(a: &str, b: &str) -> f64 {
        let of = |colour: &str| {
            let channel = |at: usize| u8::from_str_radix(&colour[at..at + 2], 16).unwrap();
            luminance([channel(1), channel(3), channel(5)]) + 0.05
        };
        let (a, b) = (of(a), of(b));
        (a / b).max(b / a)
    }

    /// Labels have the colours of their series, so every series needs the contrast of text.
    #[test]
    fn every_colour_can_be_read_on_its_paper() {
        for ink in TEXTS.into_iter().chain(SERIES) {
            for (paper, colour) in [(PAPER.light, ink.light), (PAPER.dark, ink.dark)] {
                assert!(contrast(paper, colour) >= 4.5, "{}: {:.2}", ink.name, contrast(paper, colour));
            }
        }
        assert!(contrast("#ffffff", "#000000") > 20.9 && contrast("#ffffff", "#999999") < 3.0);
    }

    #[test]
    fn no_two_series_look_alike() {
        let look = |i| (Series(i).class(), Series(i).dash(), Series(i).marker((0.0, 0.0), 4.0));
        for a in 0..12 {
            for b in 0..a {
                let (a, b) = (look(a), look(b));
                assert!(a.0 != b.0 || (a.1 != b.1 && a.2 != b.2), "{a:?} {b:?}");
            }
        }
        // In grey, the first six series differ by dash and by marker.
        for of in [|i| Series(i).dash().to_owned(), |i| Series(i).marker((0.0, 0.0), 4.0)] {
            assert_eq!((0..6).map(of).collect::<std::collections::BTreeSet<_>>().len(), 6);
        }
    }

    /// Lightness L* of CIELAB, from 0 to 100.
    fn lightness(colour: [u8; 3]) -> f64 {
        let y = luminance(colour);
        if y <= 0.008_856 { 903.3 * y } else { 116.0 * y.cbrt() - 16.0 }
    }

    #[test]
    fn the_colours_can_be_read_in_grey() {
        let steps: Vec<f64> = (0..=40).map(|i| lightness(heat(f64::from(i) / 40.0))).collect();
        let rise = (steps[40] - steps[0]) / 40.0;
        assert!(rise > 1.8, "from {} to {}", steps[0], steps[40]);
        for pair in steps.windows(2) {
            assert!((0.6 * rise..1.5 * rise).contains(&(pair[1] - pair[0])), "{pair:?}, on average {rise}");
        }
        // Black pixels (no ray) differ from the colour of cost 0.
        assert!(steps[0] - lightness([0; 3]) > 10.0);
    }
}
