//! Plots, as SVG.

mod distances;
mod pareto;

pub use distances::plot_distances;
pub use pareto::{Choice, Errors, front, plot_pareto};
