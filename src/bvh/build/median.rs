//! The median builder: a complete tree.

use super::draft::Draft;
use super::item::{Extents, Item};
use super::top_down::{self, halve};

pub(super) fn build(items: Vec<Item>, leaf_size: u32, progress: &(dyn Fn(usize) + Sync)) -> Draft {
    let leaves_wanted = items.len().div_ceil(leaf_size as usize);
    let full = leaves_wanted.next_power_of_two().ilog2().min(items.len().ilog2());
    let cut = |range: &mut [Item], extents: &Extents, depth| (depth < full).then(|| halve(range, extents));
    top_down::build(items, cut, progress)
}
