//! The kernels, and the composition of their texts from parts.
//!
//! Each part exists once: a traversal, a storage of its stack, a width of its words, a search, a driver. Parts that a
//! kernel does not need depend on a constant that is false, and are compiled out.

mod wide;

pub use wide::{SLOTS, Wide};

use std::fmt::Write as _;

use stackless_bvh::traverse::Method;

use wide::{WIDE_RAY_SEARCH, WIDE_TAPE_SEARCH};

/// Invocations in a work group.
pub const WORKGROUP: u32 = 64;

/// The method of finding the next node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Traversal {
    /// A stack in private memory.
    Stack,
    /// A stack in the memory of the work group.
    StackWorkgroup,
    /// A stack in private memory that also keeps the distance at which each postponed node begins.
    StackT0,
    /// Laine's restart trail with a short stack of this size.
    Laine(u32),
    /// Parents and siblings (Áfra & Szirmay-Kalos 2014).
    Afra,
    /// Binder & Keller's Algorithm 1 as printed, with printed sizes and keys.
    HashedPrinted,
    /// `HashedPrinted` with the keys that can be looked up, and sizes for direct addresses.
    Hashed,
    /// `Hashed` with a second trail.
    HashedDisjoint,
    /// Nodes with up to eight children.
    Wide(Wide),
}

/// The distribution of tasks to invocations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Driver {
    /// One task per invocation, while-while.
    Single,
    /// An invocation that finishes a task fetches the next task.
    Persistent,
    /// One task per invocation, with a postponed leaf.
    Speculative,
}

/// A kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kernel {
    /// The name in commands and tables, without the word size.
    pub name: &'static str,
    /// The traversal.
    pub traversal: Traversal,
    /// The driver.
    pub driver: Driver,
    /// Number of 32-bit words of a key or trail: 1, 2 or 3; for trails of wide trees 1, 2 or 4.
    pub words: u32,
}

/// The two links in the records of a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Links {
    /// Uncles, or links that are not read.
    Uncles,
    /// Parent and sibling.
    Parents,
}

/// The tables in which a kernel looks up keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Table {
    /// Sizes and keys as printed.
    Printed,
    /// The keys of HASH-3 for leaves with three references, and sizes for direct addresses.
    Tight,
}

/// The recording of a traversal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Record {
    /// Nothing.
    Nothing,
    /// A hash of the events.
    Hash,
    /// The events.
    Events,
}

const SINGLE: [(&str, Traversal); 11] = [
    ("stack", Traversal::Stack),
    ("stack-workgroup", Traversal::StackWorkgroup),
    ("stack-t0", Traversal::StackT0),
    ("laine-0", Traversal::Laine(0)),
    ("laine-1", Traversal::Laine(1)),
    ("laine-4", Traversal::Laine(4)),
    ("laine-8", Traversal::Laine(8)),
    ("afra", Traversal::Afra),
    ("hashed-printed", Traversal::HashedPrinted),
    ("hashed", Traversal::Hashed),
    ("hashed-disjoint", Traversal::HashedDisjoint),
];

impl Kernel {
    /// All kernels for trees of two children with this number of words. Kernels without words belong to 1.
    pub fn all(words: u32) -> Vec<Self> {
        let single = SINGLE.map(|(name, traversal)| Self { name, traversal, driver: Driver::Single, words });
        let mut all: Vec<Self> = single.into_iter().filter(|kernel| words == 1 || kernel.has_words()).collect();
        if words == 1 {
            let stack = all[0];
            all.push(Self { name: "stack-persistent", driver: Driver::Persistent, ..stack });
            all.push(Self { name: "stack-speculative", driver: Driver::Speculative, ..stack });
        }
        all
    }

    /// Number of 32-bit words that keys and trails need for a tree of this depth.
    pub const fn words_for(depth: u32) -> u32 {
        match depth {
            0..32 => 1,
            32..64 => 2,
            _ => 3,
        }
    }

    /// The name, with the word size if it is above 32 bits.
    pub fn full_name(&self) -> String {
        if self.words == 1 { self.name.to_owned() } else { format!("{}/{}", self.name, 32 * self.words) }
    }

    /// Whether it has words that limit the depth.
    pub const fn has_words(&self) -> bool {
        match self.traversal {
            Traversal::Stack | Traversal::StackWorkgroup | Traversal::StackT0 => false,
            Traversal::Wide(wide) => wide.has_words(),
            _ => true,
        }
    }

    /// Maximum depth in edges, or for wide trees in levels; `None` without a limit.
    pub const fn depth_limit(&self) -> Option<u32> {
        if let Traversal::Wide(wide) = self.traversal {
            return wide.level_limit(self.words);
        }
        if !self.has_words() {
            return None;
        }
        Some(if matches!(self.traversal, Traversal::Afra) { 32 * self.words } else { 32 * self.words - 1 })
    }

    /// Bytes of work group memory that it needs for trees of this depth.
    pub const fn workgroup_bytes(&self, depth: u32) -> u32 {
        if matches!(self.traversal, Traversal::StackWorkgroup) { 4 * WORKGROUP * depth } else { 0 }
    }

    /// The traversal of the library with equal events; `None` for wide trees, which have one oracle.
    pub const fn method(&self) -> Option<Method> {
        Some(match self.traversal {
            Traversal::Stack | Traversal::StackWorkgroup => Method::Stack,
            Traversal::StackT0 => Method::StackT0,
            Traversal::Laine(0) => Method::Laine0,
            Traversal::Laine(1) => Method::Laine1,
            Traversal::Laine(4) => Method::Laine4,
            Traversal::Laine(_) => Method::Laine8,
            Traversal::Afra => Method::Afra,
            Traversal::HashedPrinted | Traversal::Hashed => Method::Hashed,
            Traversal::HashedDisjoint => Method::HashedDisjoint,
            Traversal::Wide(_) => return None,
        })
    }

    /// Whether it visits nodes in the order of its oracle. Only the speculative kernel does not.
    pub const fn keeps_order(&self) -> bool {
        !matches!(self.driver, Driver::Speculative)
    }

    /// Whether its events have keys.
    pub const fn has_keys(&self) -> bool {
        self.table().is_some()
    }

    /// Whether its events have the levels of backtracks.
    pub const fn has_levels(&self) -> bool {
        match self.traversal {
            Traversal::Wide(wide) => wide.has_levels(),
            Traversal::Afra => true,
            _ => self.has_keys(),
        }
    }

    /// Whether it keeps the trail of TRAIL-1.
    pub const fn has_trail(&self) -> bool {
        self.has_levels()
    }

    /// Whether it keeps the most recently postponed node in a register.
    pub const fn has_register(&self) -> bool {
        self.has_keys()
    }

    /// Whether each node is decided once. Kernels that restart from the root decide again.
    pub const fn decides_once(&self) -> bool {
        !matches!(self.traversal, Traversal::Laine(_))
    }

    /// The links that it reads.
    pub const fn links(&self) -> Links {
        if matches!(self.traversal, Traversal::Afra) { Links::Parents } else { Links::Uncles }
    }

    /// The tables that it reads.
    pub const fn table(&self) -> Option<Table> {
        match self.traversal {
            Traversal::HashedPrinted => Some(Table::Printed),
            Traversal::Hashed | Traversal::HashedDisjoint | Traversal::Wide(Wide::Hashed) => Some(Table::Tight),
            _ => None,
        }
    }

    /// The search of a decision tape.
    pub const fn tape_search(&self) -> &'static str {
        if self.is_wide() { WIDE_TAPE_SEARCH } else { TAPE_SEARCH }
    }

    /// The search of a ray, without its triangles.
    pub const fn ray_search(&self) -> &'static str {
        if self.is_wide() { WIDE_RAY_SEARCH } else { RAY_SEARCH }
    }

    /// Whether it is for trees of up to eight children.
    pub const fn is_wide(&self) -> bool {
        matches!(self.traversal, Traversal::Wide(_))
    }

    /// The text of the kernel: constants, `search` with its dependencies, then the parts.
    pub fn source(&self, shape: Shape, search: &str, record: Record) -> String {
        let mut text = String::new();
        let leaf_reach = if self.table() == Some(Table::Printed) { 6 } else { 14 };
        let short = if let Traversal::Laine(short) = self.traversal { short } else { 0 };
        let stack_size = match self.traversal {
            Traversal::Wide(_) => wide::stack_entries(shape.depth),
            Traversal::StackT0 => 2 * shape.depth,
            _ => shape.depth,
        };
        for (name, value) in [
            ("WORKGROUP", WORKGROUP),
            ("STACK_SIZE", stack_size.max(1)),
            ("TRAIL_WORDS", self.words),
            ("SHORT", short),
            ("RING_SIZE", short.max(1)),
            ("LEAF_REACH", leaf_reach),
            ("LEVELS", wide::kept_levels(shape.depth)),
        ] {
            let _ = writeln!(text, "const {name} = {value}u;");
        }
        for (name, value) in [
            ("KEEPS_DISTANCES", self.traversal == Traversal::StackT0),
            ("PRUNES", self.traversal == Traversal::HashedDisjoint),
            ("FILLS_AT_LOAD", self.traversal == Traversal::HashedPrinted),
        ] {
            let _ = writeln!(text, "const {name} = {value};");
        }
        for part in self.parts(record) {
            text.push_str(part);
            text.push('\n');
        }
        text.push_str(search);
        if self.driver == Driver::Speculative {
            text.push_str(if shape.subgroups { ALL_LANES } else { EACH_LANE });
        }
        text
    }

    fn parts(&self, record: Record) -> Vec<&'static str> {
        let mut parts = vec![include_str!("../wgsl/bindings.wgsl")];
        if !self.is_wide() {
            parts.extend([include_str!("../wgsl/types.wgsl"), include_str!("../wgsl/loop.wgsl")]);
        }
        // The key; a wide kernel without keys records nothing instead.
        parts.push(match if matches!(self.traversal, Traversal::Wide(Wide::Trail)) { 1 } else { self.words } {
            1 => include_str!("../wgsl/word1.wgsl"),
            2 => include_str!("../wgsl/word2.wgsl"),
            _ => include_str!("../wgsl/word3.wgsl"),
        });
        parts.push(match record {
            Record::Nothing => include_str!("../wgsl/record_none.wgsl"),
            Record::Hash => include_str!("../wgsl/record_hash.wgsl"),
            Record::Events => include_str!("../wgsl/record_events.wgsl"),
        });
        parts.extend(match self.traversal {
            Traversal::Stack | Traversal::StackT0 => {
                vec![include_str!("../wgsl/cursor_stack.wgsl"), include_str!("../wgsl/store_private.wgsl")]
            }
            Traversal::StackWorkgroup => {
                vec![include_str!("../wgsl/cursor_stack.wgsl"), include_str!("../wgsl/store_workgroup.wgsl")]
            }
            Traversal::Laine(_) => vec![include_str!("../wgsl/cursor_laine.wgsl")],
            Traversal::Afra => vec![include_str!("../wgsl/cursor_afra.wgsl")],
            Traversal::Wide(wide) => wide.parts(),
            _ => vec![include_str!("../wgsl/cursor_hashed.wgsl"), include_str!("../wgsl/table.wgsl")],
        });
        if !self.has_levels() {
            parts.push(include_str!("../wgsl/state_none.wgsl"));
        }
        if self.has_keys() {
            match self.words {
                1 => parts.push(include_str!("../wgsl/table_narrow.wgsl")),
                words => parts.extend([
                    include_str!("../wgsl/wide.wgsl"),
                    include_str!("../wgsl/table_wide.wgsl"),
                    include_str!("../wgsl/remainder.wgsl"),
                    if words == 2 { include_str!("../wgsl/fold2.wgsl") } else { include_str!("../wgsl/fold3.wgsl") },
                ]),
            }
        }
        parts.push(match self.driver {
            Driver::Single => include_str!("../wgsl/drive_single.wgsl"),
            Driver::Persistent => include_str!("../wgsl/drive_persistent.wgsl"),
            Driver::Speculative => include_str!("../wgsl/drive_speculative.wgsl"),
        });
        parts
    }
}

/// Other inputs of the text of a kernel.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// Depth of the deepest tree, in edges; for wide trees, in levels. A stack must hold this number of nodes.
    pub depth: u32,
    /// Whether lanes can vote.
    pub subgroups: bool,
}

/// The search of a decision tape, through trees of two children.
pub const TAPE_SEARCH: &str = concat!(include_str!("../wgsl/head.wgsl"), include_str!("../wgsl/search_tape.wgsl"));

/// The search of a ray, through trees of two children.
const RAY_SEARCH: &str = concat!(
    include_str!("../wgsl/arithmetic.wgsl"),
    include_str!("../wgsl/ray.wgsl"),
    include_str!("../wgsl/search_ray.wgsl")
);

/// The pass that writes tapes into records.
pub fn tape_fill() -> String {
    [include_str!("../wgsl/wide.wgsl"), include_str!("../wgsl/tape_fill.wgsl")].concat()
}

const ALL_LANES: &str = "
fn all_lanes(is: bool) -> bool {
    return subgroupAll(is);
}
";

const EACH_LANE: &str = "
fn all_lanes(is: bool) -> bool {
    return is;
}
";
