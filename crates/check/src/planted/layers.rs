//! What traversals rest on, with one mistake each: tables, lookups, tests of triangles and boxes, searches,
//! hierarchies; and traversals of wide trees.

use super::draw::Draw;
use super::lookups::Function;
use super::wide::WidePlanted;
use super::{Planted, doubles, filters, hierarchies, kernels, lookups, paths, searches, slabs, tables, wide};
use stackless_bvh::generate::Source;
use stackless_bvh::geom::{Mesh, Ray};
use stackless_bvh::hash::{KeySet, Mix};
use stackless_bvh::trace::Hit;
use stackless_bvh::tree::{Reach, Tree};

/// A layer below the traversals, with its mistakes, and the same without one.
#[derive(Debug)]
pub struct Layer {
    /// What is spoilt.
    pub name: &'static str,
    /// The property body that has to see it, in [`check`](crate).
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
    instead: Instead,
}

/// What an implementation with the mistake has where one without has what is right.
#[derive(Clone, Copy)]
pub enum Instead {
    /// This table for the hashed keys of a tree; `None` where there is none.
    Table(fn(&Tree, KeySet) -> Option<Table>),
    /// Records that are taken to name so many ancestors' siblings.
    Reach(fn(Reach) -> Option<Reach>),
    /// This function of keys.
    Function(Function),
    /// These answers to rays; `None` where the mesh has no hierarchy.
    Rays(fn(&Mesh, &[Ray]) -> Option<Hits>),
    /// This traversal.
    Walk(fn() -> Planted),
    /// This traversal of wide trees.
    Wide(WidePlanted),
    /// Nothing that the conformance suite asks for, and why.
    Nothing(&'static str),
}

/// A perfect hash, by its words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// D displacements or direct addresses.
    pub displacements: Vec<u32>,
    /// H addresses.
    pub cells: Vec<u32>,
    /// What keys go through first.
    pub mix: Mix,
    /// Under which long keys are folded.
    pub fold: u64,
}

/// The answers to rays, in their order.
#[derive(Clone, Debug, PartialEq)]
pub struct Hits {
    /// The closest hits.
    pub closest: Vec<Option<Hit>>,
    /// Whether there is any.
    pub any: Vec<bool>,
}

/// Draws an input, makes the mistake, and asks the property body.
pub(super) type Body = fn(&mut Draw<'_>) -> Option<String>;

/// All layers. [`all`](super::all) has the bugs of traversals.
///
/// ```
/// use stackless_check::planted::LAYERS;
/// use stackless_bvh::generate::Rng;
///
/// for layer in &LAYERS {
///     assert!(layer.controls.iter().all(|control| control.fault(&mut Rng::new(1)).is_none()));
/// }
/// ```
pub static LAYERS: [Layer; 10] = [
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
    Layer {
        name: "smaller bounds",
        body: "an error within its bound",
        mistakes: &filters::MISTAKES,
        controls: &filters::CONTROLS,
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
    Layer { name: "double precision", body: "check_tree", mistakes: &doubles::MISTAKES, controls: &doubles::CONTROLS },
    Layer { name: "paths", body: "check_path", mistakes: &paths::MISTAKES, controls: &paths::CONTROLS },
    Layer { name: "wide traversals", body: "WideCase::compare", mistakes: &wide::MISTAKES, controls: &wide::CONTROLS },
];

impl Mistake {
    pub(super) const fn new(name: &'static str, clause: &'static str, fault: Body, instead: Instead) -> Self {
        Self { name, clause, fault, instead }
    }

    /// What is wrong, in a few words: unique.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// The clause that it breaks.
    pub const fn clause(&self) -> &'static str {
        self.clause
    }

    /// What an implementation with it has in place of what is right.
    pub const fn instead(&self) -> Instead {
        self.instead
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

impl core::fmt::Debug for Instead {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Table(_) => "Table",
            Self::Reach(_) => "Reach",
            Self::Function(_) => "Function",
            Self::Rays(_) => "Rays",
            Self::Walk(_) => "Walk",
            Self::Wide(_) => "Wide",
            Self::Nothing(_) => "Nothing",
        })
    }
}

/// Mistakes in a test of triangles or boxes, which a type has to name.
macro_rules! marks {
    ($($name:ident)*) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum Bug {
            $($name),*
        }

        /// The name of a mistake.
        pub(super) trait Spoil: Copy + Debug {
            const BUG: Bug;
        }

        $(
            #[derive(Clone, Copy, Debug)]
            pub(super) struct $name;

            impl Spoil for $name {
                const BUG: Bug = Bug::$name;
            }
        )*
    };
}

pub(super) use marks;
