//! Charts, as SVG: for papers, and for light and dark screens.
//!
//! What they share is here: fonts and what text takes (`text`), colours, markers and dashes (`style`), round ticks
//! (`ticks`), axes (`panel`), legends (`canvas`) and places for labels (`labels`).

mod campaign;
mod canvas;
mod distances;
mod labels;
mod panel;
mod pareto;
mod style;
mod text;
mod ticks;

pub use campaign::{Stretch, plot_campaign};
pub use distances::plot_distances;
pub use pareto::{Choice, Errors, front, plot_pareto};
pub use style::heat;
pub use text::wrap;
pub use ticks::round_ticks;

#[cfg(test)]
mod tests;
