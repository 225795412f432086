//! Statistics of traversals, and pictures of them.

mod backtracks;
mod plot;

pub use backtracks::{Backtracks, Source};
pub use plot::plot_distances;
