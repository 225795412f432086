//! The property body of perfect hashes.

use stackless_bvh::hash::{BuildError, CertificateError, KeySet, Lookup, Options, PerfectHash, TableError, certify};
use stackless_bvh::internals::hash::AddressBounds;
use stackless_bvh::key::{Grow, KeyWord};
use stackless_bvh::tree::{Keys, Node, Topology, Tree};

/// A fault of a perfect hash.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TableFault {
    /// It cannot be built.
    #[error("it cannot be built: {0}")]
    Build(BuildError),
    /// The certificate fails.
    #[error("it is not certified: {0}")]
    Certificate(CertificateError),
    /// Many threads build another table than a single thread.
    #[error("many threads build another table")]
    Parallel,
    /// The printed function is right for this tree, but the table lacks it; or the table has it, and it is wrong.
    #[error("the remedy is where it is not needed, or missing")]
    Remedy,
    /// A key does not lead to its node.
    #[error("the key of {node:?} leads to {found:?}")]
    Lookup {
        /// The node.
        node: Node,
        /// The address found.
        found: Option<Node>,
    },
    /// A key leads to an address that is no node of the tree.
    #[error("a key leads to {0:?}, which the tree does not have")]
    Stray(Node),
    /// The table's own bytes are rejected.
    #[error("its own bytes are refused: {0}")]
    Bytes(TableError),
    /// Encoding and decoding changes the table or its bytes.
    #[error("bytes and table differ")]
    Changed,
}

/// Builds a table with one thread, with many, and without the remedy. Certifies it, encodes and decodes it, and looks
/// up every key with every word that can represent it. `[HASH-9]`
///
/// # Errors
/// The first fault.
pub fn check_table(tree: &Tree, keys: &Keys, options: Options) -> Result<PerfectHash, TableFault> {
    let hash = PerfectHash::build(tree, options).map_err(TableFault::Build)?;
    certify(&hash, tree, options.key_set).map_err(TableFault::Certificate)?;
    if PerfectHash::build_parallel(tree, options).as_ref() != Ok(&hash) {
        return Err(TableFault::Parallel);
    }
    let is_remedied = hash.header().mix.seed.is_some() && hash.header().reseeds > 0;
    match PerfectHash::build_plain(tree, options) {
        Ok(plain) if plain == hash => {}
        Err(BuildError::NoDisplacement { .. }) if is_remedied => {}
        Err(error) if !is_remedied => return Err(TableFault::Build(error)),
        _ => return Err(TableFault::Remedy),
    }
    let back = PerfectHash::from_bytes(&hash.to_bytes(), AddressBounds::of(tree)).map_err(TableFault::Bytes)?;
    if back != hash {
        return Err(TableFault::Changed);
    }
    find_all(&hash, tree, keys, options.key_set)?;
    Ok(hash)
}

/// Reads arbitrary bytes as a table of a tree. An accepted table encodes to these bytes again, and every lookup returns
/// a node of the tree or none. In a certified table all keys lead to their nodes. `[HASH-9]`
///
/// Returns whether the table is certified, or `None` if it was rejected.
///
/// # Errors
/// The first fault.
pub fn check_table_bytes(bytes: &[u8], tree: &Tree, keys: &Keys) -> Result<Option<bool>, TableFault> {
    let bounds = AddressBounds::of(tree);
    let Ok(hash) = PerfectHash::from_bytes(bytes, bounds) else { return Ok(None) };
    if hash.to_bytes() != bytes {
        return Err(TableFault::Changed);
    }
    for slot in 0..tree.node_count() {
        let key: Grow = keys.key(slot);
        if let Some(stray) = hash.probe(&key).filter(|&node| !bounds.contains(node)) {
            return Err(TableFault::Stray(stray));
        }
    }
    let key_set = hash.header().key_set;
    let is_certified = certify(&hash, tree, key_set).is_ok();
    if is_certified {
        find_all(&hash, tree, keys, key_set)?;
    }
    Ok(Some(is_certified))
}

/// Looks up every key of a set with every word that can represent it.
fn find_all(hash: &PerfectHash, tree: &Tree, keys: &Keys, key_set: KeySet) -> Result<(), TableFault> {
    // The lengths of whole keys are the depths of their nodes, so looking up all of them takes quadratic time.
    if tree.depth() > 1000 {
        return Ok(());
    }
    let hashed = key_set.slots(tree);
    find_in::<u32>(hash, tree, keys, &hashed)?;
    find_in::<u64>(hash, tree, keys, &hashed)?;
    find_in::<u128>(hash, tree, keys, &hashed)?;
    find_in::<Grow>(hash, tree, keys, &hashed)
}

fn find_in<W: KeyWord>(hash: &PerfectHash, tree: &Tree, keys: &Keys, hashed: &[bool]) -> Result<(), TableFault> {
    if W::carries(tree.depth(), 1).is_err() {
        return Ok(());
    }
    for slot in (0..tree.node_count()).filter(|&slot| hashed[slot]) {
        let (key, node) = (keys.key::<W>(slot), tree.node(slot as u32));
        let found = hash.probe(&key);
        if found != node || Some(hash.node(&key)) != node {
            return Err(TableFault::Lookup { node: node.unwrap_or(tree.root()), found });
        }
    }
    Ok(())
}
