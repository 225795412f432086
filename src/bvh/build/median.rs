//! The median builder: a complete tree.

use super::BuildError;
use super::draft::Draft;
use super::item::{Extents, Item};
use super::sah::SahOptions;
use super::top_down::{self, halve};

pub(super) fn build(
    items: Vec<Item>,
    options: SahOptions,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Draft, BuildError> {
    options.check(items.len())?;
    let leaves_wanted = items.len().div_ceil(options.max_leaf as usize);
    let full = leaves_wanted.next_power_of_two().ilog2().min(items.len().ilog2());
    let cut = |range: &mut [Item], extents: &Extents, depth| (depth < full).then(|| halve(range, extents));
    Ok(top_down::build(items, cut, progress))
}
