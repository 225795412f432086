//! Plots, as SVG.

mod campaign;
mod distances;
mod pareto;

pub use campaign::{Stretch, plot_campaign};
pub use distances::plot_distances;
pub use pareto::{Choice, Errors, front, plot_pareto};
