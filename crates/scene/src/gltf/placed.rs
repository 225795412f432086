//! Where the nodes of a glTF document place their meshes, in double precision.
//!
//! The crate `gltf` has the numbers of nodes in single precision. Here they are the decimals of the document, and what
//! rounding does to them is known after each sum and product.

use serde::Deserialize;

use crate::number::Number;

type Real = Number<f64>;

/// An affine map, by columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Map([[Real; 3]; 4]);

/// The nodes of a document.
#[derive(Deserialize)]
pub(super) struct Nodes {
    #[serde(default)]
    nodes: Vec<Node>,
}

#[derive(Deserialize)]
struct Node {
    matrix: Option<[Real; 16]>,
    translation: Option<[Real; 3]>,
    rotation: Option<[Real; 4]>,
    scale: Option<[Real; 3]>,
}

impl Nodes {
    /// The map of a node.
    pub(super) fn map(&self, index: usize) -> Map {
        self.nodes.get(index).map_or(Map::IDENTITY, Node::map)
    }
}

const ZERO: Real = Number { value: 0.0, error: 0.0 };
const ONE: Real = Number { value: 1.0, error: 0.0 };

impl Node {
    fn map(&self) -> Map {
        if let Some(m) = self.matrix {
            return Map([0, 4, 8, 12].map(|first| [m[first], m[first + 1], m[first + 2]]));
        }
        let scale = self.scale.unwrap_or([ONE; 3]);
        let [x, y, z] = self.rotation.map_or(Map::IDENTITY.linear(), rotation);
        let scaled = |column: [Real; 3], by: Real| column.map(|number| number * by);
        let translation = self.translation.unwrap_or([ZERO; 3]);
        Map([scaled(x, scale[0]), scaled(y, scale[1]), scaled(z, scale[2]), translation])
    }
}

/// The matrix of a unit quaternion, by columns.
fn rotation([x, y, z, w]: [Real; 4]) -> [[Real; 3]; 3] {
    let minus = |number: Real| Number { value: -number.value, ..number };
    let twice = |a: Real, b: Real, c: Real, d: Real| {
        let sum = a * b + c * d;
        sum + sum
    };
    let on = |a, b| ONE + minus(twice(a, a, b, b));
    let w_minus = minus(w);
    [
        [on(y, z), twice(x, y, w, z), twice(x, z, w_minus, y)],
        [twice(x, y, w_minus, z), on(x, z), twice(y, z, w, x)],
        [twice(x, z, w, y), twice(y, z, w_minus, x), on(x, y)],
    ]
}

impl Map {
    pub(super) const IDENTITY: Self = Self([[ONE, ZERO, ZERO], [ZERO, ONE, ZERO], [ZERO, ZERO, ONE], [ZERO; 3]]);

    fn linear(self) -> [[Real; 3]; 3] {
        let [x, y, z, _] = self.0;
        [x, y, z]
    }

    /// This map after another.
    pub(super) fn after(&self, first: &Self) -> Self {
        let [x, y, z, origin] = first.0;
        let [x, y, z] = [x, y, z].map(|column| self.turned(column));
        Self([x, y, z, self.point(origin)])
    }

    /// Where a point is moved to.
    pub(super) fn point(&self, point: [Real; 3]) -> [Real; 3] {
        let turned = self.turned(point);
        std::array::from_fn(|i| turned[i] + self.0[3][i])
    }

    fn turned(&self, [x, y, z]: [Real; 3]) -> [Real; 3] {
        std::array::from_fn(|i| self.0[0][i] * x + self.0[1][i] * y + self.0[2][i] * z)
    }
}
