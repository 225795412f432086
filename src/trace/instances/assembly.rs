//! Assemblies of placed objects.

use std::sync::Arc;

use glam::Vec3;

use super::wide_walk::WideObject;
use crate::bvh::{BuildError, BuildOptions, Bvh, Primitives, WideBvh};
use crate::geom::lanes::Precision;
use crate::geom::{Aabb, AffineMap, Frame, Interval, Real, Triangle, Vector, check_environment};

/// Objects that consist of other objects: hierarchies over meshes, and groups of placed objects that were added
/// earlier. So no object contains itself. A clone shares all hierarchies with the original.
///
/// All numbers are in single precision, or with [`DVec3`](glam::DVec3) in double precision. See
/// [`InstanceTracer`](super::InstanceTracer) for an example.
#[derive(Clone, Debug)]
pub struct Assembly<V: Vector = Vec3> {
    parts: Vec<Part<V>>,
}

/// An object of an [`Assembly`], by its index. In another assembly it denotes another object, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Object(u32);

/// An object and its placement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance<R: Real = f32> {
    /// The placed object.
    pub object: Object,
    /// The map from the object's space to that of the group.
    pub affine: AffineMap<R>,
}

/// Errors of [`Assembly::add_group`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AssemblyError {
    /// The assembly has no such object.
    #[error("instance {instance}: object {object} is not one of the {objects} of this assembly")]
    UnknownObject {
        /// Index of the instance.
        instance: usize,
        /// The object that it places.
        object: u32,
        /// Number of objects in the assembly.
        objects: usize,
    },
    /// The box of the image has an end beyond the greatest float.
    #[error("instance {instance}: the image of its object leaves the range of floats")]
    OutOfRange {
        /// Index of the instance.
        instance: usize,
    },
    /// The object of an instance already has the greatest number of levels.
    #[error("instance {instance}: its object has {levels} levels, and a group may have {max}", max = Assembly::MAX_LEVELS)]
    TooManyLevels {
        /// Index of the instance.
        instance: usize,
        /// Levels of its object.
        levels: u32,
    },
    /// The hierarchy over the instances cannot be built. The triangles in the error's text are instances.
    #[error(transparent)]
    Build(#[from] BuildError),
}

/// An object of an assembly.
#[derive(Clone, Debug)]
pub(super) enum Part<V: Vector> {
    Mesh(Arc<Bvh<Triangle<V>>>),
    Wide(Arc<dyn WideObject<V>>),
    Group(Arc<Group<V::Real>>),
}

/// Placed objects, with a hierarchy over their boxes, which are in a frame of the group.
#[derive(Clone, Debug)]
pub(super) struct Group<R: Real> {
    pub(super) instances: Vec<Instance<R>>,
    pub(super) bvh: Bvh<()>,
    levels: u32,
}

impl Assembly {
    /// Greatest number of levels of an object: a mesh has one, a group one more than the deepest of its objects.
    pub const MAX_LEVELS: u32 = 32;
}

impl<V: Vector> Assembly<V> {
    /// Creates an assembly without objects.
    pub const fn new() -> Self {
        Self { parts: Vec::new() }
    }

    /// Adds a mesh by its hierarchy, owned or shared.
    pub fn add_mesh(&mut self, bvh: impl Into<Arc<Bvh<Triangle<V>>>>) -> Object {
        self.add(Part::Mesh(bvh.into()))
    }

    /// Adds a mesh by a hierarchy of eight children. The answers are those of [`add_mesh`](Self::add_mesh), bit for
    /// bit. `[INST-6]`
    ///
    /// In an assembly in double precision, whose maps are in double precision, its triangles may be in single
    /// precision.
    pub fn add_wide<W: Precision>(&mut self, bvh: impl Into<Arc<WideBvh<8, W>>>) -> Object
    where
        V: From<W>,
    {
        let bvh: Arc<WideBvh<8, W>> = bvh.into();
        self.add(Part::Wide(bvh))
    }

    /// Adds a group of placed objects of this assembly, and builds a hierarchy over their boxes. Each box contains the
    /// exact image of all triangles of its instance. `[INST-2]`
    ///
    /// # Errors
    /// [`AssemblyError`]; then nothing is added.
    pub fn add_group(
        &mut self,
        instances: Vec<Instance<V::Real>>,
        options: &BuildOptions,
    ) -> Result<Object, AssemblyError> {
        check_environment().map_err(BuildError::Environment)?;
        let (mut images, mut below) = (Vec::with_capacity(instances.len()), 0);
        for (index, Instance { object, affine }) in instances.iter().enumerate() {
            let part = self.part(*object).ok_or(AssemblyError::UnknownObject {
                instance: index,
                object: object.0,
                objects: self.parts.len(),
            })?;
            if part.levels() >= Assembly::MAX_LEVELS {
                return Err(AssemblyError::TooManyLevels { instance: index, levels: part.levels() });
            }
            below = below.max(part.levels());
            images.push(affine.image(part.bounds()));
        }
        let boxes = Boxes::of::<V>(&images);
        if let Some(instance) = boxes.boxes.iter().position(|aabb| !(aabb.lo.is_finite() && aabb.hi.is_finite())) {
            return Err(AssemblyError::OutOfRange { instance });
        }
        let bvh = options.build(&boxes)?;
        Ok(self.add(Part::Group(Arc::new(Group { instances, bvh, levels: below + 1 }))))
    }

    /// Adds all objects of another assembly, and returns the function from its objects to the added ones. Meshes are
    /// shared, and groups as well if this assembly is empty; otherwise groups are copied.
    pub fn append(&mut self, other: &Self) -> impl Fn(Object) -> Object + use<V> {
        let first = self.parts.len() as u32;
        let added = move |object: Object| Object(object.0.saturating_add(first));
        self.parts.extend(other.parts.iter().map(|part| match part {
            Part::Group(group) if first > 0 => {
                let place = |&Instance { object, affine }| Instance { object: added(object), affine };
                let instances = group.instances.iter().map(place).collect();
                Part::Group(Arc::new(Group { instances, bvh: group.bvh.clone(), levels: group.levels }))
            }
            part => part.clone(),
        }));
        added
    }

    /// Returns the least and the greatest corner of a box that contains the exact image of all triangles of an object.
    /// The box is not the least. `None` for an object that is not of this assembly. `[INST-2]`
    pub fn bounds(&self, object: Object) -> Option<[V; 2]> {
        let bounds = self.part(object)?.bounds().map(|bounds| bounds.ends());
        let below = |x: f64| {
            let near = V::Real::rounded(x);
            if near.into() > x { near.next_down() } else { near }
        };
        let above = |x: f64| {
            let below: f64 = below(-x).into();
            V::Real::rounded(-below)
        };
        Some([V::from_components(bounds.map(|[lo, _]| below(lo))), V::from_components(bounds.map(|[_, hi]| above(hi)))])
    }

    /// Returns the number of levels of an object: 1 for a mesh, 0 for an object that is not of this assembly.
    pub fn levels(&self, object: Object) -> u32 {
        self.part(object).map_or(0, Part::levels)
    }

    pub(super) fn part(&self, object: Object) -> Option<&Part<V>> {
        self.parts.get(object.index())
    }

    /// Returns all objects, in the order in which they were added.
    pub(super) fn parts(&self) -> &[Part<V>] {
        &self.parts
    }

    fn add(&mut self, part: Part<V>) -> Object {
        self.parts.push(part);
        Object(self.parts.len() as u32 - 1)
    }
}

impl<V: Vector> Default for Assembly<V> {
    fn default() -> Self {
        Self::new()
    }
}

impl Object {
    /// Returns its position in the order in which objects were added.
    pub(super) fn index(self) -> usize {
        self.0 as usize
    }
}

impl<V: Vector> Part<V> {
    /// Returns bounds of the whole object.
    fn bounds(&self) -> [Interval; 3] {
        match self {
            Self::Mesh(bvh) => bvh.frame().leave(&bvh.bounds()),
            Self::Wide(object) => object.region().frame().leave(object.region().bounds()),
            Self::Group(group) => group.bvh.frame().leave(&group.bvh.bounds()),
        }
    }

    fn levels(&self) -> u32 {
        match self {
            Self::Mesh(_) | Self::Wide(_) => 1,
            Self::Group(group) => group.levels,
        }
    }
}

/// The boxes of instances: leaves of their hierarchy hold only the indices.
struct Boxes {
    boxes: Vec<Aabb>,
    frame: Frame,
}

impl Boxes {
    /// Creates them in a separate frame, as for a mesh. `[FRAME-1]`
    fn of<V: Vector>(images: &[[Interval; 3]]) -> Self {
        let corner = |image: &[Interval; 3], end: usize| {
            V::from_components(image.map(|bounds| V::Real::rounded(bounds.ends()[end])))
        };
        let corners = images.iter().flat_map(|image| [corner(image, 0), corner(image, 1)]);
        let frame = V::frame(corners.filter(|&corner| V::is_finite(corner)));
        Self { boxes: images.iter().map(|image| frame.enter(image)).collect(), frame }
    }
}

impl Primitives for Boxes {
    type Shape = ();

    fn count(&self) -> usize {
        self.boxes.len()
    }

    fn shape(&self, _: usize) {}

    fn frame(&self) -> Frame {
        self.frame
    }

    fn aabb(&self, index: usize) -> Aabb {
        self.boxes[index]
    }
}

#[cfg(test)]
mod tests;
