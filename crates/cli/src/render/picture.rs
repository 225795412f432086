//! Pixels, text and the colours of heat maps.

use std::collections::BTreeMap;
use std::convert::Infallible;

use crate::plots::{heat, round_ticks, wrap};
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Point, Size as Extent};
use embedded_graphics::mono_font::MonoTextStyle;
use embedded_graphics::mono_font::ascii::FONT_7X13;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::text::{Alignment, Baseline, Text};
use embedded_graphics::{Drawable, Pixel};
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError};

use crate::camera::Size;

/// A picture in memory, initially white.
pub(crate) struct Picture {
    width: u32,
    height: u32,
    pixels: Vec<[u8; 3]>,
}

impl Picture {
    pub(super) fn new(width: u32, height: u32) -> Self {
        Self { width, height, pixels: vec![[255; 3]; width as usize * height as usize] }
    }

    /// Fills a rectangle, given its upper left corner. `colour` receives the index of the pixel in the rectangle.
    pub(super) fn fill(&mut self, [left, top]: [u32; 2], size: Size, colour: impl Fn(usize) -> [u8; 3]) {
        for row in 0..size.height {
            for column in 0..size.width {
                let at = (top + row) as usize * self.width as usize + (left + column) as usize;
                self.pixels[at] = colour(row as usize * size.width as usize + column as usize);
            }
        }
    }

    fn text(&mut self, text: &str, [x, y]: [u32; 2], alignment: Alignment) {
        let style = MonoTextStyle::new(&FONT_7X13, Rgb888::BLACK);
        let mut text = Text::with_alignment(text, Point::new(x as i32, y as i32), style, alignment);
        text.text_style.baseline = Baseline::Top;
        let Ok(_) = text.draw(self);
    }

    /// Encodes the picture as PNG, with a palette if it has few enough colours.
    pub(crate) fn to_png(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        // Encoding small pictures into memory cannot fail.
        let encoded = self.encode(&mut bytes);
        debug_assert!(encoded.is_ok(), "{encoded:?}");
        bytes
    }

    fn encode(&self, bytes: &mut Vec<u8>) -> Result<(), EncodingError> {
        let mut palette = BTreeMap::new();
        for colour in &self.pixels {
            let next = palette.len();
            palette.entry(colour).or_insert(next);
            if palette.len() > 256 {
                break;
            }
        }
        let mut encoder = Encoder::new(bytes, self.width, self.height);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::High);
        if palette.len() > 256 {
            encoder.set_color(ColorType::Rgb);
            return encoder.write_header()?.write_image_data(self.pixels.as_flattened());
        }
        let mut colours: Vec<_> = palette.iter().collect();
        colours.sort_by_key(|&(_, index)| index);
        encoder.set_color(ColorType::Indexed);
        encoder.set_palette(colours.into_iter().flat_map(|(&&colour, _)| colour).collect::<Vec<u8>>());
        let indices: Vec<u8> = self.pixels.iter().map(|colour| palette[colour] as u8).collect();
        encoder.write_header()?.write_image_data(&indices)
    }
}

impl OriginDimensions for Picture {
    fn size(&self) -> Extent {
        Extent::new(self.width, self.height)
    }
}

impl DrawTarget for Picture {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(Point { x, y }, colour) in pixels {
            if (0..self.width as i32).contains(&x) && (0..self.height as i32).contains(&y) {
                let at = y as usize * self.width as usize + x as usize;
                self.pixels[at] = [colour.r(), colour.g(), colour.b()];
            }
        }
        Ok(())
    }
}

/// Space around panels, and the height of a line of text including space.
const GAP: u32 = 6;
const LINE: u32 = 18;
/// Height of the colour bar, and of its ticks.
const BAR: u32 = 12;
const TICK: u32 = 4;
/// Width of a letter.
const LETTER: u32 = 7;

/// Heat maps with one scale from 0 to `end`, each below its label. The scale and its title are below all of them.
/// Pixels without rays are black.
pub(crate) fn heat_maps(size: Size, panels: &[(String, &Vec<Option<f64>>)], end: f64, unit: &str) -> Picture {
    let count = panels.len() as u32;
    let widest = panels.iter().map(|(label, _)| width(label)).max().unwrap_or(0);
    let column = size.width.max(widest).max(if count == 1 { 200 } else { 0 });
    let across = count * column + (count + 1) * GAP;
    let end_number = if end < 10.0 { format!("{end:.1}") } else { format!("{end:.0}") };
    let title = wrapped(&format!("{unit}; brightest: {end_number} or more; black: no ray"), across - 2 * GAP);
    let below = LINE + size.height + GAP;
    let mut picture = Picture::new(across, below + BAR + TICK + LINE * (1 + title.len() as u32));
    for (i, (label, costs)) in (0..).zip(panels) {
        let left = GAP + i * (column + GAP);
        picture.text(label, [left, 3], Alignment::Left);
        picture.fill([left, LINE], size, |pixel| costs[pixel].map_or([0; 3], |cost| heat(cost / end)));
    }
    let bar = Size { width: across - 2 * GAP, height: BAR };
    let share = |pixel: usize| (pixel % bar.width as usize) as f64 / f64::from(bar.width);
    picture.fill([GAP, below], bar, |pixel| heat(share(pixel)));
    let mut free = 0;
    for (tick, number) in round_ticks(end, (bar.width / 60).clamp(1, 10) as usize) {
        let x = GAP + (tick / end * f64::from(bar.width - 1)) as u32;
        picture.fill([x, below + BAR], Size { width: 1, height: TICK }, |_| [0; 3]);
        let half = width(&number) / 2;
        let middle = x.clamp(half + 1, across - half - 1);
        if middle - half >= free {
            picture.text(&number, [middle, below + BAR + TICK + 2], Alignment::Center);
            free = middle + half + LETTER;
        }
    }
    for (i, line) in (1..).zip(&title) {
        picture.text(line, [across / 2, below + BAR + TICK + 2 + i * LINE], Alignment::Center);
    }
    picture
}

fn width(text: &str) -> u32 {
    text.chars().count() as u32 * LETTER
}

fn wrapped(text: &str, room: u32) -> Vec<String> {
    wrap(text, f64::from(room), |part| f64::from(width(part)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_picture_has_room_for_its_texts() {
        let costs = vec![Some(1.0), None];
        let panels = [("a traversal: mean 1.00".to_owned(), &costs), ("b".to_owned(), &costs)];
        let size = Size { width: 2, height: 1 };
        let picture = heat_maps(size, &panels, 37.0, "nodes a primary ray");
        assert_eq!(picture.width, 2 * 22 * LETTER + 3 * GAP);
        // Nothing but the bar touches the border.
        let is_white = |x: u32, y: u32| picture.pixels[(y * picture.width + x) as usize] == [255; 3];
        assert!((0..picture.height).all(|y| is_white(0, y) && is_white(picture.width - 1, y)));
        assert!((0..picture.width).all(|x| is_white(x, picture.height - 1)));
        assert_eq!(wrapped("one two three", 8 * LETTER), ["one two", "three"]);
    }
}
