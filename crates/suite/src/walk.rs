//! Walks as cases of the library.

use super::{Children, Walk};
use stackless_bvh::generate::{Cell, Tape};
use stackless_bvh::tree::{Tree, TreeError};

/// Errors of converting a walk to a case.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WalkError {
    /// The children do not form a tree.
    #[error("children: {0}")]
    Tree(#[from] TreeError),
    /// Script or cells do not fit the tree, or not exactly one of them is given.
    #[error("expected a script or cells that fit the tree")]
    Search,
}

impl Walk {
    /// Returns the tree with its search. A script becomes a tape: unwanted nodes are missed, and leaves that stop the
    /// search are hit.
    ///
    /// # Errors
    /// [`WalkError`].
    pub fn case(&self) -> Result<stackless_check::Case, WalkError> {
        let tree = Tree::new(&self.children)?;
        let (cells, any) = match (&self.script, &self.cells) {
            (Some(script), None) => (cells_of(script, &self.children).ok_or(WalkError::Search)?, true),
            (None, Some(cells)) => (cells.clone(), self.any.unwrap_or(false)),
            _ => return Err(WalkError::Search),
        };
        let tape = Tape::from_cells(&tree, cells).ok_or(WalkError::Search)?;
        Ok(stackless_check::Case { tree, tape, any, octant: self.octant.unwrap_or(0) })
    }
}

fn cells_of(script: &str, children: &Children) -> Option<Vec<Cell>> {
    let mut cells = vec![Cell::default(); children.len()];
    if script.len() != children.len() {
        return None;
    }
    for (node, (decision, pair)) in script.bytes().zip(children).enumerate() {
        match (decision, pair) {
            (b'.', None) => {}
            (b'!', None) => cells[node].hit = Some(u32::MAX - 1),
            (_, Some(pair)) => {
                let missed = match decision {
                    b'n' => [true, true],
                    b'l' => [false, true],
                    b'r' => [true, false],
                    b'L' | b'R' => [false, false],
                    _ => return None,
                };
                cells[node].right_first = decision == b'R';
                for (&child, missed) in pair.iter().zip(missed) {
                    cells.get_mut(child as usize)?.miss = missed;
                }
            }
            _ => return None,
        }
    }
    Some(cells)
}
