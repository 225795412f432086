use super::*;
use crate::order::{Descent, Side};
use crate::traverse::{Afra, Cursor, Incomplete, Pause, Uncle};
use crate::tree::{Linked, Tree};

/// Removes the register from a state's bytes and corrects the checksum.
fn without_register(bytes: &[u8]) -> Vec<u8> {
    let mut bytes = bytes[..bytes.len() - CHECKSUM_BYTES].to_vec();
    bytes[5] &= !REGISTER;
    bytes[22..26].fill(0);
    bytes.extend(checksum(&bytes).to_le_bytes());
    bytes
}

/// Every bit of the header, with a corrected checksum, and every bit of the checksum. [PAUSE-6]
#[test]
fn every_bit_of_a_header_and_of_a_checksum_counts() {
    let tree = Tree::new(&[Some([1, 2]), None, None]).unwrap();
    let (linked, states) = (Linked::both(&tree), States::of(&tree));
    let bytes = states.to_bytes(&Afra::<u32, _>::new(&linked).unwrap().put_aside(Next::Visit));
    let content = bytes.len() - CHECKSUM_BYTES;
    for bit in (0..8 * 18).chain(8 * content..8 * bytes.len()) {
        let mut other = bytes.clone();
        other[bit / 8] ^= 1 << (bit % 8);
        if bit / 8 < content {
            let sum = checksum(&other[..content]);
            other[content..].copy_from_slice(&sum.to_le_bytes());
        }
        let error = states.from_bytes::<u32>(&other).unwrap_err();
        let is_named = match (bit / 8, error) {
            (0..4, StateError::Magic)
            | (4, StateError::Version { .. })
            | (6..10, StateError::WordBytes { .. })
            | (10..18, StateError::Tree) => true,
            (5, error) => error != StateError::Checksum,
            (at, error) => at >= content && error == StateError::Checksum,
        };
        assert!(is_named, "bit {bit}: {error}");
    }
}

/// [PAUSE-3] [PAUSE-6]
#[test]
fn a_postponed_sibling_is_in_the_bytes_of_a_traversal_without_a_register_too() {
    let tree = Tree::new(&[Some([1, 2]), Some([3, 4]), None, None, None]).unwrap();
    let (linked, states) = (Linked::both(&tree), States::of(&tree));
    let [left, right] = tree.children(tree.root());
    let mut afra = Afra::<u32, _>::new(&linked).unwrap();
    afra.descend(Descent::both(Side::Left));
    let paused = afra.put_aside(Next::Visit);
    assert_eq!((paused.node, paused.register, states.check(&paused)), (left, None, Ok(())));
    let bytes = states.to_bytes(&paused);
    let read = states.from_bytes::<u32>(&bytes).unwrap();
    assert_eq!(read, Paused { register: Some(right), ..paused.clone() });
    assert_eq!(states.from_bytes::<u32>(&without_register(&bytes)), Err(StateError::Register));
    // Therefore any traversal can resume there.
    let mut uncle = Uncle::<u32, _>::new(&linked).unwrap();
    assert_eq!(uncle.take_up(paused), Err(Incomplete::Register));
    assert_eq!(uncle.take_up(read), Ok(()));
    assert_eq!((uncle.backtrack(), uncle.node()), (true, right));

    // An only child has no postponed sibling. Nodes further up are in the records.
    afra.descend(Descent::only(Side::Right));
    let paused = afra.put_aside(Next::Visit);
    let bytes = states.to_bytes(&paused);
    assert_eq!(without_register(&bytes), bytes);
    assert_eq!(states.from_bytes(&bytes), Ok(paused));
}
