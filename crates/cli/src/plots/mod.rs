//! Charts as SVG, for papers and for light and dark screens.
//!
//! Shared modules: fonts and text widths (`text`), colours, markers and dashes (`style`), round ticks (`ticks`), axes
//! (`panel`), legends (`canvas`) and positions of labels (`labels`).

mod campaign;
mod canvas;
mod distances;
mod labels;
mod panel;
mod pareto;
mod style;
mod text;
mod ticks;

pub(crate) use campaign::{Stretch, plot_campaign};
pub(crate) use distances::plot_distances;
pub(crate) use pareto::{Choice, Errors, front, plot_pareto};
pub(crate) use style::heat;
pub(crate) use text::wrap;
pub(crate) use ticks::round_ticks;

#[cfg(test)]
mod tests;
