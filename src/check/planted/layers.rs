//! What traversals rest on, with one mistake each: tables, lookups, tests of triangles and boxes, searches, hierarchies.

use super::draw::Draw;
use super::{hierarchies, kernels, lookups, searches, slabs, tables};
use crate::generate::Source;

/// A layer below the traversals, with its mistakes, and the same without one.
#[derive(Debug)]
pub struct Layer {
    /// What is spoilt.
    pub name: &'static str,
    /// The property body that has to see it, in [`check`](crate::check).
    pub body: &'static str,
    /// One mistake each.
    pub mistakes: &'static [Mistake],
    /// No mistake: no draw may show a fault.
    pub controls: &'static [Mistake],
}

/// One mistake, or, as a control, none.
#[derive(Clone, Copy)]
pub struct Mistake {
    name: &'static str,
    clause: &'static str,
    fault: Body,
}

/// Draws an input, makes the mistake, and asks the property body.
pub(super) type Body = fn(&mut Draw<'_>) -> Option<String>;

/// All layers. [`all`](super::all) has the bugs of traversals.
///
/// ```
/// use stackless_bvh::check::planted::LAYERS;
/// use stackless_bvh::generate::Rng;
///
/// for layer in &LAYERS {
///     assert!(layer.controls.iter().all(|control| control.fault(&mut Rng::new(1)).is_none()));
/// }
/// ```
pub const LAYERS: [Layer; 6] = [
    Layer {
        name: "tables",
        body: "check_table_bytes, certify",
        mistakes: &tables::MISTAKES,
        controls: &tables::CONTROLS,
    },
    Layer { name: "lookups", body: "Battery", mistakes: &lookups::MISTAKES, controls: &lookups::CONTROLS },
    Layer {
        name: "triangle tests",
        body: "check_triangle",
        mistakes: &kernels::MISTAKES,
        controls: &kernels::CONTROLS,
    },
    Layer { name: "box tests", body: "check_slabs", mistakes: &slabs::MISTAKES, controls: &slabs::CONTROLS },
    Layer {
        name: "searches",
        body: "check_tree, Battery",
        mistakes: &searches::MISTAKES,
        controls: &searches::CONTROLS,
    },
    Layer {
        name: "hierarchies",
        body: "Bvh::from_bytes, check_tree",
        mistakes: &hierarchies::MISTAKES,
        controls: &hierarchies::CONTROLS,
    },
];

impl Mistake {
    pub(super) const fn new(name: &'static str, clause: &'static str, fault: Body) -> Self {
        Self { name, clause, fault }
    }

    /// What is wrong, in a few words: unique.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// The clause that it breaks.
    pub const fn clause(&self) -> &'static str {
        self.clause
    }

    /// What the property body says of an input that is drawn; `None` if it sees nothing wrong.
    pub fn fault(&self, source: &mut dyn Source) -> Option<String> {
        (self.fault)(&mut Draw(source))
    }
}

impl core::fmt::Debug for Mistake {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.name)
    }
}

/// Names of mistakes that types carry.
macro_rules! marks {
    ($($name:ident)*) => { $(#[derive(Clone, Copy, Debug)] pub(super) struct $name;)* };
}

pub(super) use marks;
