//! What is placed where.

use std::sync::Arc;

use crate::bvh::{BuildError, BuildOptions, Bvh, Primitives};
use crate::geom::{Aabb, AffineMap};

/// Objects that are made of other objects: hierarchies over meshes, and groups of placed objects that came before. So
/// no object contains itself. A clone shares all hierarchies with the original.
///
/// See [`InstanceTracer`](super::InstanceTracer) for an example.
#[derive(Clone, Debug, Default)]
pub struct Assembly {
    parts: Vec<Part>,
}

/// An object of an [`Assembly`], by its place there. In another assembly it stands for another object, or for none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Object(u32);

/// An object and where it is placed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// What is placed.
    pub object: Object,
    /// From the object's space to that of the group.
    pub affine: AffineMap,
}

/// Why instances are not a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AssemblyError {
    /// The assembly has no such object.
    #[error("instance {instance}: object {object} is not one of the {objects} of this assembly")]
    UnknownObject {
        /// Index of the instance.
        instance: usize,
        /// The object that it places.
        object: u32,
        /// How many objects there are.
        objects: usize,
    },
    /// The box of the image has an end beyond the greatest float.
    #[error("instance {instance}: the image of its object leaves the range of single precision")]
    OutOfRange {
        /// Index of the instance.
        instance: usize,
    },
    /// The object of an instance is nested too deeply already.
    #[error("instance {instance}: its object has {levels} levels, and a group may have {max}", max = Assembly::MAX_LEVELS)]
    TooManyLevels {
        /// Index of the instance.
        instance: usize,
        /// Levels of its object.
        levels: u32,
    },
    /// The hierarchy over the instances cannot be built. Where the error speaks of triangles, these are instances.
    #[error(transparent)]
    Build(#[from] BuildError),
}

/// An object of an assembly.
#[derive(Clone, Debug)]
pub(super) enum Part {
    Mesh(Arc<Bvh>),
    Group(Arc<Group>),
}

/// Placed objects, with a hierarchy over their boxes.
#[derive(Clone, Debug)]
pub(super) struct Group {
    pub(super) instances: Vec<Instance>,
    pub(super) bvh: Bvh<()>,
    levels: u32,
}

impl Assembly {
    /// Greatest number of levels of an object: a mesh has one, a group one more than the deepest of its objects.
    pub const MAX_LEVELS: u32 = 32;

    /// An assembly without objects.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a mesh by its hierarchy, its own or one that others share.
    pub fn add_mesh(&mut self, bvh: impl Into<Arc<Bvh>>) -> Object {
        self.add(Part::Mesh(bvh.into()))
    }

    /// Adds a group of placed objects of this assembly, and builds a hierarchy over their boxes. Each box holds the
    /// exact image of all triangles of its instance. `[INST-2]`
    ///
    /// # Errors
    /// What [`AssemblyError`] lists; then nothing is added.
    pub fn add_group(&mut self, instances: Vec<Instance>, options: &BuildOptions) -> Result<Object, AssemblyError> {
        let (mut boxes, mut below) = (Vec::with_capacity(instances.len()), 0);
        for (index, Instance { object, affine }) in instances.iter().enumerate() {
            let part = self.part(*object).ok_or(AssemblyError::UnknownObject {
                instance: index,
                object: object.0,
                objects: self.parts.len(),
            })?;
            if part.levels() >= Self::MAX_LEVELS {
                return Err(AssemblyError::TooManyLevels { instance: index, levels: part.levels() });
            }
            let image = affine.image_of_box(&part.bounds());
            if !(image.lo.is_finite() && image.hi.is_finite()) {
                return Err(AssemblyError::OutOfRange { instance: index });
            }
            below = below.max(part.levels());
            boxes.push(image);
        }
        let bvh = options.build(&Boxes(boxes))?;
        Ok(self.add(Part::Group(Arc::new(Group { instances, bvh, levels: below + 1 }))))
    }

    /// How many levels an object has: 1 for a mesh, 0 for an object that is not of this assembly.
    pub fn levels(&self, object: Object) -> u32 {
        self.part(object).map_or(0, Part::levels)
    }

    pub(super) fn part(&self, object: Object) -> Option<&Part> {
        self.parts.get(object.index())
    }

    /// All objects, in the order in which they were added.
    pub(super) fn parts(&self) -> &[Part] {
        &self.parts
    }

    fn add(&mut self, part: Part) -> Object {
        self.parts.push(part);
        Object(self.parts.len() as u32 - 1)
    }
}

impl Object {
    /// Its place in the order in which objects were added.
    pub(super) fn index(self) -> usize {
        self.0 as usize
    }
}

impl Part {
    fn bounds(&self) -> Aabb {
        match self {
            Self::Mesh(bvh) => bvh.bounds(),
            Self::Group(group) => group.bvh.bounds(),
        }
    }

    fn levels(&self) -> u32 {
        match self {
            Self::Mesh(_) => 1,
            Self::Group(group) => group.levels,
        }
    }
}

/// The boxes of instances: leaves of their hierarchy hold nothing but the indices.
struct Boxes(Vec<Aabb>);

impl Primitives for Boxes {
    type Shape = ();

    fn count(&self) -> usize {
        self.0.len()
    }

    fn shape(&self, _: usize) {}

    fn aabb(&self, index: usize) -> Aabb {
        self.0[index]
    }
}
