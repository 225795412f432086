//! Traversals by name, piece by piece.

use std::convert::Infallible;

use stackless_bvh::event::Recorder;
use stackless_bvh::hash::{BuildError, KeyMap, KeySet, Options, PerfectHash, Sizing};
use stackless_bvh::key::KeyWord;
use stackless_bvh::order::{self, ByNode, NodeTest, Pruned, Whole};
use stackless_bvh::traverse::{
    Afra, ByKey, Cuts, Disjoint, HashOnly, Hashed, ImplicitA, ImplicitA1, ImplicitB, ImplicitB1, Laine, LeftFirst,
    Method, PieceTable, Sparse, Split, Uncle, Unfit, traverse_pruned,
};
use stackless_bvh::tree::{Reach, Topology};

/// A cut tree with the tables of all traversals whose state has words. `[DEPTH-4]`
#[derive(Debug)]
pub struct Pieces<'c, T> {
    cuts: &'c Cuts<'c, T>,
    hashes: Vec<PieceTable<PerfectHash>>,
    full_hashes: Vec<PieceTable<PerfectHash>>,
    /// In place of implicit layouts and of Glassner's table.
    maps: Vec<PieceTable<KeyMap>>,
}

impl<'c, T: Topology> Pieces<'c, T> {
    /// All traversals whose state has words, but `complete`, which is Glassner's with another table.
    pub const METHODS: [Method; 20] = [
        Method::LeftFirst,
        Method::ImplicitA,
        Method::ImplicitA1,
        Method::ImplicitB,
        Method::ImplicitB1,
        Method::Sparse,
        Method::SparseDisjoint,
        Method::Laine0,
        Method::Laine1,
        Method::Laine2,
        Method::Laine4,
        Method::Laine8,
        Method::Afra,
        Method::AfraDisjoint,
        Method::Uncle,
        Method::UncleDisjoint,
        Method::HashOnly,
        Method::Hashed,
        Method::HashedDisjoint,
        Method::Glassner,
    ];

    /// Makes the tables. The tree must name [links](stackless_bvh::tree::Linked) for the traversals that follow them.
    ///
    /// # Errors
    /// Those of the perfect hashes.
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

    /// By piece: the keys that `hashed` looks up.
    pub fn hashes(&self) -> &[PieceTable<PerfectHash>] {
        &self.hashes
    }

    /// By piece: all keys.
    pub fn full_hashes(&self) -> &[PieceTable<PerfectHash>] {
        &self.full_hashes
    }

    /// Runs one search.
    ///
    /// # Errors
    /// [`Unfit`], before the first step.
    pub fn run<W: KeyWord>(
        &self,
        method: Method,
        search: &mut (impl Pruned + NodeTest),
        recorder: &mut impl Recorder,
    ) -> Result<(), Unfit> {
        macro_rules! run {
            ($search:expr, $piece:ident => $cursor:expr) => {{
                let mut waiting = Vec::new();
                let split = Split::new(self.cuts, &mut waiting, |$piece| $cursor)?;
                traverse_pruned(split, $search, recorder);
            }};
        }

        let Self { hashes, full_hashes, maps, .. } = self;
        match method {
            Method::LeftFirst => {
                let mut search = Whole(ByNode { test: search, order: order::LeftFirst });
                run!(&mut search, piece => LeftFirst::<W, _>::new(piece, &maps[piece.number()]));
            }
            Method::ImplicitA => run!(search, piece => ImplicitA::<W, _>::new(piece, &maps[piece.number()])),
            Method::ImplicitA1 => run!(search, piece => ImplicitA1::<W, _>::new(piece, &maps[piece.number()])),
            Method::ImplicitB => run!(search, piece => ImplicitB::<W, _>::new(piece, &maps[piece.number()])),
            Method::ImplicitB1 => run!(search, piece => ImplicitB1::<W, _>::new(piece, &maps[piece.number()])),
            Method::Sparse => run!(search, piece => Sparse::<W, _>::new(piece)),
            Method::SparseDisjoint => {
                run!(search, piece => Sparse::<W, _, Disjoint<W>>::new(piece));
            }
            Method::AfraDisjoint => run!(search, piece => Afra::<W, _, Disjoint<W>>::new(piece)),
            Method::UncleDisjoint => run!(search, piece => Uncle::<W, _, Disjoint<W>>::new(piece)),
            Method::HashedDisjoint => {
                run!(search, piece => Hashed::<W, _, _, Disjoint<W>>::new(piece, &hashes[piece.number()]));
            }
            Method::Laine0 => run!(search, piece => Laine::<0, W, _>::new(piece)),
            Method::Laine1 => run!(search, piece => Laine::<1, W, _>::new(piece)),
            Method::Laine2 => run!(search, piece => Laine::<2, W, _>::new(piece)),
            Method::Laine4 => run!(search, piece => Laine::<4, W, _>::new(piece)),
            Method::Laine8 => run!(search, piece => Laine::<8, W, _>::new(piece)),
            Method::Afra => run!(search, piece => Afra::<W, _>::new(piece)),
            Method::Uncle => run!(search, piece => Uncle::<W, _>::new(piece)),
            Method::HashOnly => run!(search, piece => HashOnly::<W, _, _>::new(piece, &full_hashes[piece.number()])),
            Method::Hashed => run!(search, piece => Hashed::<W, _, _>::new(piece, &hashes[piece.number()])),
            Method::Glassner => run!(search, piece => ByKey::<W, _>::new(piece, &maps[piece.number()])),
            _ => return Err(Unfit::NoTable),
        }
        Ok(())
    }
}
