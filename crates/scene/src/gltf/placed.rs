//! Transforms of the nodes of a glTF document, in double precision.
//!
//! Numbers are the document's decimals. The rounding error of each sum and product is known.

use serde::Deserialize;

use crate::number::Number;

type Real = Number<f64>;

/// An affine map, by columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Map([[Real; 3]; 4]);

/// A node of a document.
#[derive(Deserialize)]
pub(super) struct Node {
    pub(super) name: Option<String>,
    pub(super) mesh: Option<usize>,
    pub(super) skin: Option<usize>,
    #[serde(default)]
    pub(super) children: Vec<usize>,
    #[serde(default)]
    pub(super) extensions: Extensions,
    matrix: Option<Box<[Real; 16]>>,
    translation: Option<Box<[Real; 3]>>,
    rotation: Option<Box<[Real; 4]>>,
    scale: Option<Box<[Real; 3]>>,
}

/// The supported extensions of a node.
#[derive(Default, Deserialize)]
pub(super) struct Extensions {
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub(super) instancing: Option<Box<Instancing>>,
}

/// Instances: further transforms of a node's mesh, relative to the node.
#[derive(Deserialize)]
pub(super) struct Instancing {
    pub(super) attributes: Places,
}

/// The accessors of the instances' transforms.
#[derive(Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub(super) struct Places {
    pub(super) translation: Option<usize>,
    pub(super) rotation: Option<usize>,
    pub(super) scale: Option<usize>,
}

const ZERO: Real = Number { value: 0.0, error: 0.0 };
const ONE: Real = Number { value: 1.0, error: 0.0 };

impl Node {
    pub(super) fn map(&self) -> Map {
        if let Some(m) = &self.matrix {
            return Map([0, 4, 8, 12].map(|first| [m[first], m[first + 1], m[first + 2]]));
        }
        Map::of(self.translation.as_deref(), self.rotation.as_deref(), self.scale.as_deref())
    }
}

/// Returns the matrix of a unit quaternion, by columns.
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

    /// Composes a scaling, then a rotation, then a translation.
    pub(super) fn of(translation: Option<&[Real; 3]>, turn: Option<&[Real; 4]>, scale: Option<&[Real; 3]>) -> Self {
        let scale = scale.unwrap_or(&[ONE; 3]);
        let [x, y, z] = turn.map_or(Self::IDENTITY.linear(), |turn| rotation(*turn));
        let scaled = |column: [Real; 3], by: Real| column.map(|number| number * by);
        let translation = translation.copied().unwrap_or([ZERO; 3]);
        Self([scaled(x, scale[0]), scaled(y, scale[1]), scaled(z, scale[2]), translation])
    }

    fn linear(self) -> [[Real; 3]; 3] {
        let [x, y, z, _] = self.0;
        [x, y, z]
    }

    /// Composes this map with an earlier one.
    pub(super) fn after(&self, first: &Self) -> Self {
        let [x, y, z, origin] = first.0;
        let [x, y, z] = [x, y, z].map(|column| self.turned(column));
        Self([x, y, z, self.point(origin)])
    }

    /// Transforms a point.
    pub(super) fn point(&self, point: [Real; 3]) -> [Real; 3] {
        let turned = self.turned(point);
        std::array::from_fn(|i| turned[i] + self.0[3][i])
    }

    fn turned(&self, [x, y, z]: [Real; 3]) -> [Real; 3] {
        std::array::from_fn(|i| self.0[0][i] * x + self.0[1][i] * y + self.0[2][i] * z)
    }
}
