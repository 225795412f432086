//! Statistics of traversals, and pictures of them.

mod backtracks;
mod pareto;
mod plot;
mod watched;

pub use backtracks::{Backtracks, Source};
pub use pareto::{Choice, Errors, front, plot_pareto};
pub use plot::plot_distances;
pub use watched::{Reads, Steps, Watched};
