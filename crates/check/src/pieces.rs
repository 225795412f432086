//! Traversals of cut trees, by name.

use std::convert::Infallible;

use stackless_bvh::event::Recorder;
use stackless_bvh::hash::{BuildError, KeyMap, KeySet, Options, PerfectHash, Sizing};
use stackless_bvh::internals::traverse::{Context, Piece, PieceTable, Supply};
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::{self, ByNode, FixedOrder, NodeTest, Pruned};
use stackless_bvh::traverse::{Cursor, Cuts, Method, Skips, Split, Unsupported, traverse, traverse_pruned};
use stackless_bvh::tree::{Node, Reach, Topology};

/// A cut tree with the tables of all traversals that have a word in their state. `[DEPTH-4]`
#[derive(Debug)]
pub struct Pieces<'c, T> {
    cuts: &'c Cuts<'c, T>,
    hashes: Vec<PieceTable<PerfectHash>>,
    full_hashes: Vec<PieceTable<PerfectHash>>,
    /// Replace implicit layouts and Glassner's table.
    maps: Vec<PieceTable<KeyMap>>,
}

impl<'c, T: Topology> Pieces<'c, T> {
    /// Returns all traversals that have a word in their state, except `complete`, which equals Glassner's with another
    /// table.
    pub fn methods() -> impl Iterator<Item = Method> {
        Method::ALL.into_iter().filter(|&method| method.has_words() && method != Method::Complete)
    }

    /// Builds the tables. The tree must have [links](stackless_bvh::tree::Linked) for the traversals that follow links.
    ///
    /// # Errors
    /// The errors of building perfect hashes.
    pub fn new(cuts: &'c Cuts<'c, T>) -> Result<Self, BuildError> {
        let hashes = |key_set| {
            let options = Options { key_set, sizing: Sizing::Tight };
            cuts.tables(|tree| PerfectHash::build(tree, options))
        };
        Ok(Self {
            cuts,
            hashes: hashes(KeySet::Exact(Reach::ALGORITHM_1))?,
            full_hashes: hashes(KeySet::All)?,
            maps: cuts.tables(|tree| Ok::<_, Infallible>(KeyMap::of(tree))).unwrap_or_else(|error| match error {}),
        })
    }

    /// Returns a perfect hash per piece, of the keys that `hashed` looks up.
    pub fn hashes(&self) -> &[PieceTable<PerfectHash>] {
        &self.hashes
    }

    /// Returns a perfect hash per piece, of all keys.
    pub fn full_hashes(&self) -> &[PieceTable<PerfectHash>] {
        &self.full_hashes
    }

    /// Runs one search.
    ///
    /// # Errors
    /// [`Unsupported`], before the first step.
    pub fn run<W: KeyWord>(
        &'c self,
        method: Method,
        search: &mut (impl Pruned + NodeTest),
        recorder: &mut impl Recorder,
    ) -> Result<(), Unsupported> {
        method.dispatch::<W, _>(InPieces { pieces: self, search, recorder })
    }
}

/// A piece, with its tables.
#[derive(Debug)]
struct OfPiece<'c, T> {
    pieces: &'c Pieces<'c, T>,
    piece: &'c Piece<'c, T>,
}

impl<'c, W: KeyWord, T: Topology> Supply<'c, W> for OfPiece<'c, T> {
    type Tree = Piece<'c, T>;
    type Memory = Vec<Node>;
    type Hash = &'c PieceTable<PerfectHash>;
    type Layout = &'c PieceTable<KeyMap>;
    type Complete = &'c PieceTable<KeyMap>;
    type Chains = &'c PieceTable<KeyMap>;
    type BySign = order::LeftOrder;

    fn tree(&self) -> &'c Piece<'c, T> {
        self.piece
    }

    fn memory(self) -> Vec<Node> {
        Vec::new()
    }

    fn by_sign(&self) -> order::LeftOrder {
        order::LeftOrder
    }

    fn reached_keys(&self) -> Result<Self::Hash, Unsupported> {
        Ok(&self.pieces.hashes[self.piece.number()])
    }

    fn all_keys(&self) -> Result<Self::Hash, Unsupported> {
        Ok(&self.pieces.full_hashes[self.piece.number()])
    }

    fn layout(&self) -> Result<Self::Layout, Unsupported> {
        Ok(&self.pieces.maps[self.piece.number()])
    }

    /// Pieces may be incomplete trees.
    fn complete(&self) -> Result<Self::Complete, Unsupported> {
        Err(Unsupported::NoTable)
    }

    fn chains(&self) -> Result<Self::Chains, Unsupported> {
        Ok(&self.pieces.maps[self.piece.number()])
    }

    fn skips(&self) -> Result<&'c Skips, Unsupported> {
        Err(Unsupported::NoTable)
    }

    fn skips_by_sign(&self) -> Result<&'c Skips, Unsupported> {
        Err(Unsupported::NoTable)
    }
}

struct InPieces<'c, 's, T, S, R> {
    pieces: &'c Pieces<'c, T>,
    search: &'s mut S,
    recorder: &'s mut R,
}

impl<'c, W, T, S, R> Context<'c, W> for InPieces<'c, '_, T, S, R>
where
    W: KeyWord,
    T: Topology,
    S: Pruned + NodeTest,
    R: Recorder,
{
    type From = OfPiece<'c, T>;
    type Output = ();

    fn by_parent<C: Cursor>(self, start: impl Fn(OfPiece<'c, T>) -> Result<C, Unsupported>) -> Result<(), Unsupported> {
        let Self { pieces, search, recorder } = self;
        let mut waiting = Vec::new();
        let split = Split::new(pieces.cuts, &mut waiting, |piece| start(OfPiece { pieces, piece }))?;
        traverse_pruned(split, search, recorder);
        Ok(())
    }

    fn by_node<C: Cursor, O: FixedOrder>(
        self,
        start: impl Fn(OfPiece<'c, T>) -> Result<(C, O), Unsupported>,
    ) -> Result<(), Unsupported> {
        let Self { pieces, search, recorder } = self;
        let (_, order) = start(OfPiece { pieces, piece: pieces.cuts.top() })?;
        let mut waiting = Vec::new();
        let cursor = |piece| start(OfPiece { pieces, piece }).map(|(cursor, _)| cursor);
        traverse(Split::new(pieces.cuts, &mut waiting, cursor)?, &mut ByNode { test: search, order }, recorder);
        Ok(())
    }
}
