//! Pixels, text and the colours of heat maps.

use std::collections::BTreeMap;
use std::convert::Infallible;

use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Point, Size as Extent};
use embedded_graphics::mono_font::MonoTextStyle;
use embedded_graphics::mono_font::ascii::FONT_7X13;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::text::{Alignment, Baseline, Text};
use embedded_graphics::{Drawable, Pixel};
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError};

use crate::camera::Size;

/// A picture in memory, white at first.
pub(crate) struct Picture {
    width: u32,
    height: u32,
    pixels: Vec<[u8; 3]>,
}

impl Picture {
    pub(super) fn new(width: u32, height: u32) -> Self {
        Self { width, height, pixels: vec![[255; 3]; width as usize * height as usize] }
    }

    /// Sets a rectangle from its upper left corner, pixel by pixel of the rectangle.
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

    /// The file: with a palette, if that has room for all colours.
    pub(crate) fn to_png(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        // Sizes are small and memory is no file: nothing that the encoder refuses.
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

/// Space around panels, and the height of a line of text with its own.
const GAP: u32 = 6;
const LINE: u32 = 18;
/// Height of the colour bar.
const BAR: u32 = 12;

/// Heat maps with one scale from 0 to `end`, each below its label, and the scale below them all. Black: no ray.
pub(crate) fn heat_maps(size: Size, panels: &[(String, &Vec<Option<f64>>)], end: f64, unit: &str) -> Picture {
    let count = panels.len() as u32;
    let width = count * size.width + (count + 1) * GAP;
    let mut picture = Picture::new(width, LINE + size.height + GAP + BAR + LINE);
    for (i, (label, costs)) in (0..).zip(panels) {
        let left = GAP + i * (size.width + GAP);
        picture.text(label, [left, 3], Alignment::Left);
        picture.fill([left, LINE], size, |pixel| costs[pixel].map_or([0; 3], |cost| colour(cost / end)));
    }
    let (top, bar) = (LINE + size.height + GAP, Size { width: width - 2 * GAP, height: BAR });
    picture.fill([GAP, top], bar, |pixel| colour((pixel % bar.width as usize) as f64 / f64::from(bar.width)));
    let below = top + BAR + 3;
    picture.text("0", [GAP, below], Alignment::Left);
    picture.text(unit, [width / 2, below], Alignment::Center);
    let number = if end < 10.0 { format!("{end:.1} or more") } else { format!("{end:.0} or more") };
    picture.text(&number, [width - GAP, below], Alignment::Right);
    picture
}

/// From blue over green and red to white, in few enough steps for a palette.
fn colour(share: f64) -> [u8; 3] {
    const STEPS: f64 = 200.0;
    const STOPS: [[f64; 3]; 5] =
        [[20.0, 20.0, 90.0], [0.0, 130.0, 160.0], [70.0, 190.0, 60.0], [250.0, 140.0, 20.0], [255.0; 3]];
    let at = (share.clamp(0.0, 1.0) * STEPS).round() / STEPS * (STOPS.len() - 1) as f64;
    let below = (at as usize).min(STOPS.len() - 2);
    [0, 1, 2].map(|i| {
        let (from, to) = (STOPS[below][i], STOPS[below + 1][i]);
        (from + (to - from) * (at - below as f64)) as u8
    })
}
