//! The builder of Barringer & Akenine-Möller 2013, "Dynamic stackless binary tree traversal", whose trees are of
//! bounded depth: by surface area at first, then by medians.

use super::BuildError;
use super::draft::Draft;
use super::item::{Extents, Item};
use super::sah::SahOptions;
use super::top_down::{self, halve};

/// Levels that are cut by surface area.
const LEVELS: u32 = 8;

pub(super) fn build(
    items: Vec<Item>,
    options: SahOptions,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Draft, BuildError> {
    options.check(items.len())?;
    let cut = |range: &mut [Item], extents: &Extents, depth: u32| {
        if depth < LEVELS {
            options.cut(range, extents, depth)
        } else {
            (range.len() > options.max_leaf as usize).then(|| halve(range, extents))
        }
    };
    Ok(top_down::build(items, cut, progress))
}
