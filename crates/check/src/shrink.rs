//! Reduction of failing cases.

use super::Case;
use stackless_bvh::generate::{Cell, Tape};
use stackless_bvh::tree::Tree;

/// Applies the first simplification with which `fails` still holds, and repeats this until there is none.
///
/// A simplification replaces a node by one of its subtrees, replaces a subtree by a leaf, or sets a field of a cell or
/// of the query to its default.
pub fn shrink(mut case: Case, fails: impl Fn(&Case) -> bool) -> Case {
    loop {
        let simpler = simplifications(&case).find(&fails);
        match simpler {
            Some(simpler) => case = simpler,
            None => return case,
        }
    }
}

fn simplifications(case: &Case) -> impl Iterator<Item = Case> + '_ {
    let nodes = 0..case.size();
    let subtrees = nodes.clone().flat_map(move |node| {
        let children = case.tree.to_children()[node];
        let inside = children.into_iter().flatten().map(move |child| rebuild(case, node, Some(child)));
        inside.chain(children.map(|_| rebuild(case, node, None)))
    });
    let cells = nodes.flat_map(move |node| {
        let cell = case.tape.cells()[node];
        let simpler = [
            Cell { miss: false, ..cell },
            Cell { enter: 0, ..cell },
            // From the root down, so no child outlives its parent.
            Cell { exit: None, ..cell },
            Cell { right_first: false, ..cell },
            Cell { axis: 0, ..cell },
            Cell { hit: None, ..cell },
            Cell { hit: cell.hit.map(|_| cell.enter), ..cell },
        ];
        simpler.into_iter().filter(move |&simple| simple != cell).map(move |simple| with_cell(case, node, simple))
    });
    let queries = [Case { any: false, ..case.clone() }, Case { octant: 0, ..case.clone() }];
    let queries = queries.into_iter().filter(move |simple| simple != case);
    subtrees.chain(cells).flatten().chain(queries)
}

fn with_cell(case: &Case, node: usize, cell: Cell) -> Option<Case> {
    let mut cells = case.tape.cells().to_vec();
    cells[node] = cell;
    Some(Case { tape: Tape::from_cells(&case.tree, cells)?, ..case.clone() })
}

/// Replaces `node` by one of its children, or by a leaf.
fn rebuild(case: &Case, node: usize, by: Option<u32>) -> Option<Case> {
    let (children, cells) = (case.tree.to_children(), case.tape.cells());
    let substitute = |old: u32| if old as usize == node { by.unwrap_or(old) } else { old };
    let (mut new_children, mut new_cells) = (vec![None], vec![Cell::default()]);
    let mut pending = vec![(substitute(0), 0_usize)];
    while let Some((old, new)) = pending.pop() {
        let is_root = new == 0;
        let cell = cells[old as usize];
        new_cells[new] = if is_root { Cell { miss: false, enter: 0, ..cell } } else { cell };
        let cut = by.is_none() && old as usize == node;
        if let Some(pair) = children[old as usize].filter(|_| !cut) {
            let first = new_children.len() as u32;
            new_children[new] = Some([first, first + 1]);
            new_children.extend([None, None]);
            new_cells.extend([Cell::default(); 2]);
            pending.extend([(substitute(pair[0]), first as usize), (substitute(pair[1]), first as usize + 1)]);
        }
    }
    let tree = Tree::new(&new_children).ok()?;
    let tape = Tape::from_cells(&tree, new_cells)?;
    Some(Case { tree, tape, ..case.clone() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use stackless_bvh::generate::{Family, Kind, Rng};

    /// A case of any kind that fails by its tree alone loses its whole tape.
    #[test]
    fn every_field_becomes_its_default() {
        for kind in Kind::ALL {
            let mut rng = Rng::new(3);
            let tree = Family::ALL[0].tree(&mut rng, 12);
            let mut case = Case::with_tree(tree, kind, &mut rng);
            (case.any, case.octant) = (true, 5);
            let small = shrink(case, |case| case.size() >= 5);
            assert_eq!((small.size(), small.any, small.octant), (5, false, 0), "{kind}");
            assert!(small.tape.cells().iter().all(|&cell| cell == Cell::default()), "{kind}: {:?}", small.tape.cells());
        }
    }
}
