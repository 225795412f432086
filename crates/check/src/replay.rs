//! Files of failing cases.

use std::path::Path;

use serde::{Deserialize, Serialize};
use stackless_scene::read_text;

use super::Case;
use stackless_bvh::generate::{Cell, Tape};
use stackless_bvh::traverse::{Method, WordName};
use stackless_bvh::tree::{Tree, TreeError};

/// A case as JSON, with the traversals and the word to run.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Replay {
    /// Children of each node, `null` for a leaf; node 0 is the root.
    pub children: Vec<Option<[u32; 2]>>,
    /// The tape's entry for each node. Omitted fields are `false`, 0 or no hit.
    pub cells: Vec<Cell>,
    /// An any-hit query.
    #[serde(default)]
    pub any: bool,
    /// Signs of the direction, one bit per axis.
    #[serde(default)]
    pub octant: u8,
    /// Names of the traversals; all if empty.
    #[serde(default)]
    pub methods: Vec<String>,
    /// Name of the word; all if absent.
    #[serde(default)]
    pub word: Option<String>,
    /// A description of the fault, for readers of the file.
    #[serde(default)]
    pub fault: Option<String>,
}

/// Errors of reading a replay file.
#[derive(Debug, thiserror::Error)]
pub enum ReplayError {
    /// The file cannot be read.
    #[error("{0}")]
    Read(#[from] std::io::Error),
    /// The text is not a replay. The message has line and column.
    #[error(
        "{}: {}; expected a replay: the line of JSON that `stackless check` prints for a disagreement on a tree",
        if .0.is_data() { "not a replay" } else { "not JSON" },
        .0
    )]
    Json(#[from] serde_json::Error),
    /// The children do not form a tree.
    #[error("children: {0}")]
    Tree(#[from] TreeError),
    /// The cells do not fit the tree.
    #[error("cells: expected one for each of the {nodes} nodes, with children entered no earlier than their parent")]
    Cells {
        /// Number of nodes.
        nodes: usize,
    },
    /// The octant is greater than 7.
    #[error("octant {0}: expected 0 to 7")]
    Octant(u8),
    /// A traversal or word is unknown.
    #[error("'{0}' is not the name of a traversal or word")]
    Name(String),
}

impl Replay {
    /// Builds the replay of a failing case.
    pub fn of(case: &Case, method: Method, word: WordName, fault: &super::Fault) -> Self {
        Self {
            children: case.tree.to_children(),
            cells: case.tape.cells().to_vec(),
            any: case.any,
            octant: case.octant,
            methods: vec![method.name().to_owned()],
            word: Some(word.name().to_owned()),
            fault: Some(fault.to_string()),
        }
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`ReplayError::Read`] and [`ReplayError::Json`].
    pub fn load(path: &Path) -> Result<Self, ReplayError> {
        Ok(serde_json::from_str(&read_text(path)?)?)
    }

    /// Returns the case.
    ///
    /// # Errors
    /// [`ReplayError`], if the file does not describe a tree with a tape.
    pub fn case(&self) -> Result<Case, ReplayError> {
        let tree = Tree::new(&self.children)?;
        let nodes = self.children.len();
        let tape = Tape::from_cells(&tree, self.cells.clone()).ok_or(ReplayError::Cells { nodes })?;
        if self.octant > 7 {
            return Err(ReplayError::Octant(self.octant));
        }
        Ok(Case { tree, tape, any: self.any, octant: self.octant })
    }

    /// Returns the named traversals, or all if no name is given.
    ///
    /// # Errors
    /// [`ReplayError::Name`].
    pub fn methods(&self) -> Result<Vec<Method>, ReplayError> {
        if self.methods.is_empty() {
            return Ok(Method::ALL.to_vec());
        }
        self.methods.iter().map(|name| name.parse().map_err(|_| ReplayError::Name(name.clone()))).collect()
    }

    /// Returns the named word, or all if no name is given.
    ///
    /// # Errors
    /// [`ReplayError::Name`].
    pub fn words(&self) -> Result<Vec<WordName>, ReplayError> {
        match &self.word {
            None => Ok(WordName::ALL.to_vec()),
            Some(name) => Ok(vec![name.parse().map_err(|_| ReplayError::Name(name.clone()))?]),
        }
    }
}
