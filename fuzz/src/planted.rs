//! Planted bugs in place of the library, on the cases that the targets draw: fuzzing finds what is there to be found.

use arbitrary::Unstructured;
use stackless_check::planted::{self, LAYERS, Layer, Mistake, Planted};

use super::traversals::small_case;

/// A planted bug, or the same without a bug.
pub struct Bug {
    name: String,
    /// The fault that it shows on the case of these bytes.
    fault: Box<Fault>,
}

/// The fault that some bytes show.
type Fault = dyn Fn(&[u8]) -> Option<String>;

impl Bug {
    /// What is wrong, in a few words: unique.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Runs it on the case of these bytes.
    ///
    /// # Panics
    /// If the bug shows.
    pub fn run(&self, bytes: &[u8]) {
        if let Some(fault) = (self.fault)(bytes) {
            panic!("{}: {fault}", self.name);
        }
    }
}

/// All that a target can reach.
pub fn bugs() -> Vec<Bug> {
    [traversals(planted::all()), layers(|layer| layer.mistakes)].into_iter().flatten().collect()
}

/// The same without a bug.
pub fn controls() -> Vec<Bug> {
    [traversals(planted::controls()), layers(|layer| layer.controls)].into_iter().flatten().collect()
}

/// On the cases of the target `traversals`.
fn traversals(list: Vec<Planted>) -> Vec<Bug> {
    let of = |planted: Planted| Bug {
        name: planted.name().into(),
        fault: Box::new(move |bytes| {
            let case = small_case(bytes);
            planted.fault(&case).map(|fault| format!("{fault}\n{case:?}"))
        }),
    };
    list.into_iter().map(of).collect()
}

/// On the inputs of the layers below the traversals.
fn layers(list: fn(&Layer) -> &'static [Mistake]) -> Vec<Bug> {
    let of = |layer: &Layer, mistake: &'static Mistake| Bug {
        name: format!("{}: {}", layer.name, mistake.name()),
        fault: Box::new(|bytes| mistake.fault(&mut Unstructured::new(bytes))),
    };
    LAYERS.iter().flat_map(|layer| list(layer).iter().map(move |mistake| of(layer, mistake))).collect()
}
