//! Objects that are placed by affine maps, repeatedly, in groups that may be placed themselves.
//!
//! The hierarchy of a group is over the boxes of its instances. At one of its leaves, the ray and the state of its
//! traversal wait. A traversal of the instance's object starts, with the ray in the object's space and the best hit so
//! far. When it ends, the waiting traversal resumes (Binder & Keller 2016, Section 2.4). Groups have binary
//! hierarchies, meshes binary or wide hierarchies.
//!
//! # Exactness
//!
//! The answers are those of rational arithmetic on the exact images of the triangles under the given maps, and the
//! given ray. `[INST-1]` Distances along a ray are the same in every space, so nothing is transformed back. In an
//! object's space the ray is known only within bounds, which decide most tests. Otherwise the triangle's corners are
//! transformed with twice the digits of a double. If these do not decide either, they are transformed exactly, which
//! takes about a thousand times as long. `[INST-5]`

mod assembly;
mod crossings;
mod filter;
mod nearest;
mod walk;
mod wide_nearest;
mod wide_walk;

pub use assembly::{Assembly, AssemblyError, Instance, Object};
pub use filter::{FilteredInstances, InstanceFilter};
pub use nearest::InstanceNear;

use std::fmt;
use std::sync::Arc;

use glam::Vec3;

use crate::bvh::Bvh;
use crate::geom::truth::{Number, Point};
use crate::geom::{AffineMap, Approach, EnclosedRay, ExactPoint, ExactRay, Region, Triangle, Vector};
use crate::trace::level::Level;
use crate::trace::{Plan, QueryKind, RayQueries};
use crate::traverse::{Method, Unsupported};
use crate::wide;
use assembly::{Group, Part};
use walk::{Found, Instances, Search, Triangles, Wanted, walk};
use wide_walk::{WideLevel, WideObject};

/// Answers queries over an object of an assembly by one of the traversals. It shares the hierarchies with the assembly,
/// and borrows nothing.
///
/// ```
/// use stackless_bvh::bvh::{BuildOptions, Bvh};
/// use stackless_bvh::geom::{AffineMap, Mesh, Ray};
/// use stackless_bvh::glam::Vec3;
/// use stackless_bvh::trace::{Assembly, Instance, InstanceTracer, RayQueries};
/// use stackless_bvh::traverse::Method;
///
/// let bvh = Bvh::median(&Mesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]])?, 1)?;
/// let mut assembly = Assembly::new();
/// let triangle = assembly.add_mesh(bvh);
/// let row = |z| AffineMap::translation(Vec3::Z * z).map(|affine| Instance { object: triangle, affine });
/// let row = assembly.add_group(vec![row(3.0)?, row(1.0)?], &BuildOptions::default())?;
/// let grown = AffineMap::new([[2.0, 0.0, 0.0, 0.0], [0.0, 2.0, 0.0, 0.0], [0.0, 0.0, 2.0, 0.0]])?;
/// let scene = assembly.add_group(vec![Instance { object: row, affine: grown }], &BuildOptions::default())?;
///
/// let tracer = InstanceTracer::new(&assembly, scene, Method::default())?;
/// let hit = tracer.closest(&Ray::within(Vec3::new(1.0, 0.5, 0.0), Vec3::Z, 0.0, 10.0)?).ok_or("a miss")?;
/// assert_eq!((hit.path, hit.prim, hit.t, hit.u, hit.v), (vec![0, 1], 0, 2.0, 0.5, 0.25));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct InstanceTracer<V: Vector = Vec3> {
    root: Object,
    /// By index, the objects up to the root; `None` for those that are not part of it.
    stages: Vec<Option<Stage<V>>>,
}

/// The intersection of a ray and a triangle of an instance.
#[derive(Clone, Debug, PartialEq)]
pub struct InstanceHit<R = f32> {
    /// The index of the instance in each group, outermost first. Empty if the object is a mesh.
    pub path: Vec<u32>,
    /// Index of the triangle in its mesh.
    pub prim: u32,
    /// Distance along the ray, in units of the length of its direction; the float nearest to the exact distance.
    pub t: R,
    /// Weight of the triangle's second corner; the float nearest to the exact weight.
    pub u: R,
    /// Weight of the triangle's third corner; the float nearest to the exact weight.
    pub v: R,
}

/// Counts of instances and triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InstanceCounts {
    /// Entered instances.
    pub instances: u64,
    /// Tested triangles.
    pub triangles: u64,
    /// Triangle tests that bounds left undecided, which needed more digits.
    pub open: u64,
    /// Undecided tests that needed rational arithmetic.
    pub rational: u64,
}

/// Errors of the constructors of [`InstanceTracer`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum InstanceError {
    /// The object is not one of the assembly.
    #[error("the assembly has no such object")]
    UnknownObject,
    /// The traversal does not support the hierarchy of an object.
    #[error("object {object}: {unfit}")]
    Unsupported {
        /// Index of the object in the order in which objects were added.
        object: usize,
        /// The cause.
        unfit: Unsupported,
    },
    /// The traversal of wide trees does not support the hierarchy of an object.
    #[error("object {object}: {unfit}")]
    UnsupportedWide {
        /// Index of the object in the order in which objects were added.
        object: usize,
        /// The cause.
        unfit: wide::Unsupported,
    },
}

impl InstanceTracer {
    /// Bytes of a waiting ray: bounds of origin and direction in doubles.
    pub const RAY_BYTES: usize = size_of::<EnclosedRay>();
}

impl<V: Vector> InstanceTracer<V> {
    /// Creates a tracer with one traversal on all levels, except wide meshes, which use [`wide::Method::default`].
    ///
    /// # Errors
    /// [`InstanceError`].
    pub fn new(assembly: &Assembly<V>, root: Object, method: Method) -> Result<Self, InstanceError> {
        Self::with_methods(assembly, root, method, method)
    }

    /// Creates a tracer with one traversal for groups and another for meshes.
    ///
    /// # Errors
    /// [`InstanceError`].
    pub fn with_methods(
        assembly: &Assembly<V>,
        root: Object,
        groups: Method,
        meshes: Method,
    ) -> Result<Self, InstanceError> {
        let mut stages = Vec::new();
        assembly.part(root).ok_or(InstanceError::UnknownObject)?;
        // Objects come after their parts.
        let mut is_used = vec![false; root.index() + 1];
        is_used[root.index()] = true;
        for object in (0..=root.index()).rev() {
            let part = assembly.parts().get(object).filter(|_| is_used[object]);
            if let Some(Part::Group(group)) = part {
                for instance in &group.instances {
                    is_used[instance.object.index()] = true;
                }
            }
            stages.push(part.map(|part| Stage::new(object, part, groups, meshes)).transpose()?);
        }
        stages.reverse();
        Ok(Self { root, stages })
    }

    /// Returns this tracer with another traversal for wide meshes.
    ///
    /// # Errors
    /// [`InstanceError::UnsupportedWide`].
    pub fn with_wide(mut self, method: wide::Method) -> Result<Self, InstanceError> {
        for (object, stage) in self.stages.iter_mut().enumerate() {
            if let Some(Stage::Wide(bvh, level)) = stage {
                *level = bvh.level(method).map_err(|unfit| InstanceError::UnsupportedWide { object, unfit })?;
            }
        }
        Ok(self)
    }

    /// Finds the closest hit and its exact point, from which further rays may start, without a safety distance.
    /// `[SECOND-1]`
    ///
    /// ```
    /// use stackless_bvh::bvh::Bvh;
    /// use stackless_bvh::generate::procedural;
    /// use stackless_bvh::geom::{Ends, ExactRay};
    /// use stackless_bvh::glam::Vec3;
    /// use stackless_bvh::trace::{Assembly, InstanceTracer};
    /// use stackless_bvh::traverse::Method;
    ///
    /// let mesh = procedural::soup(1, 1000);
    /// let mut assembly = Assembly::new();
    /// let object = assembly.add_mesh(Bvh::build(&mesh)?);
    /// let tracer = InstanceTracer::new(&assembly, object, Method::default())?;
    /// // A path of rays, each from the exact point of the previous hit.
    /// let mut ray = ExactRay::from(&procedural::rays(&mesh, 1, 1)[0]);
    /// for bounce in 0..20 {
    ///     let Some((_, point)) = tracer.closest_and_point(&ray) else { break };
    ///     let direction = Vec3::AXES[bounce % 3] - Vec3::splat(0.3);
    ///     ray = point.ray(direction, f32::INFINITY, Ends::Open)?;
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn closest_and_point(&self, ray: impl Into<ExactRay<V>>) -> Option<(InstanceHit<V::Real>, ExactPoint<V>)> {
        let ray = ray.into();
        let found = self.search(&ray, Wanted::Closest).found.pop()?;
        self.hit_and_point(ray, found)
    }

    fn one(&self, ray: &ExactRay<V>, wanted: Wanted) -> Option<InstanceHit<V::Real>> {
        self.hit(ray, self.search(ray, wanted).found.pop()?)
    }

    /// Returns the hit, with its weights.
    fn hit(&self, ray: &ExactRay<V>, found: Found<V>) -> Option<InstanceHit<V::Real>> {
        let Found { t, path, prim, triangle, test } = found;
        let fine = || ray.fine_weights(&triangle, &self.maps(&path));
        let exact = || ray.meet(&triangle, &self.maps(&path)).map(|Point { u, v, .. }| [&u, &v].map(V::Real::nearest));
        let [u, v] = test.weights(&triangle).or_else(fine).or_else(exact)?;
        Some(InstanceHit { path, prim, t, u, v })
    }

    /// Counts the cost of the closest hits of these rays.
    pub fn count_closest<'r, R>(&self, rays: &'r [R]) -> InstanceCounts
    where
        &'r R: Into<ExactRay<V>>,
    {
        self.count(rays, Wanted::Closest)
    }

    /// Counts the cost of any-hit queries of these rays.
    pub fn count_any<'r, R>(&self, rays: &'r [R]) -> InstanceCounts
    where
        &'r R: Into<ExactRay<V>>,
    {
        self.count(rays, Wanted::Any)
    }

    fn count<'r, R>(&self, rays: &'r [R], wanted: Wanted) -> InstanceCounts
    where
        &'r R: Into<ExactRay<V>>,
    {
        rays.iter().map(|ray| self.search(&ray.into(), wanted).counts).fold(InstanceCounts::default(), |a, b| {
            InstanceCounts {
                instances: a.instances + b.instances,
                triangles: a.triangles + b.triangles,
                open: a.open + b.open,
                rational: a.rational + b.rational,
            }
        })
    }

    /// Returns the bytes of the state of one ray. For each level that a ray can be in at once, this is the traversal's
    /// state, by [`Method::state_bytes_in`] and [`wide::Method::state_bytes`], and
    /// [`RAY_BYTES`](InstanceTracer::RAY_BYTES). The deepest levels count. The result does not include the hits found
    /// so far.
    pub fn state_bytes(&self) -> usize {
        let mut bytes: Vec<usize> = Vec::new();
        for stage in &self.stages {
            let own = match stage {
                None => 0,
                Some(Stage::Mesh(bvh, level)) => level.state_bytes(bvh) + InstanceTracer::RAY_BYTES,
                Some(Stage::Wide(bvh, level)) => bvh.state_bytes(level) + InstanceTracer::RAY_BYTES,
                Some(Stage::Group(group, level)) => {
                    let inner = group.instances.iter().map(|instance| bytes[instance.object.index()]).max();
                    level.state_bytes(&group.bvh) + InstanceTracer::RAY_BYTES + inner.unwrap_or(0)
                }
            };
            bytes.push(own);
        }
        bytes.last().copied().unwrap_or(0)
    }

    fn search<'r>(&self, ray: &'r ExactRay<V>, wanted: Wanted) -> Search<'r, V> {
        let mut search = Search::new(ray, wanted);
        self.visit(self.root, ray.enclosed(), &mut search);
        search
    }

    /// Traverses an object with a ray in its space.
    fn visit(&self, object: Object, ray: EnclosedRay, search: &mut Search<'_, V>) {
        let Some(stage) = self.stage(object) else { return };
        let region = stage.region();
        let ray = if ray.is_far(region) { self.approach(&ray, region, search) } else { Some(ray) };
        let Some(ray) = ray else { return };
        let triangles = Triangles::new(self, &ray, region);
        match stage {
            Stage::Mesh(bvh, level) => walk(bvh, level, &ray, triangles, search),
            Stage::Wide(bvh, level) => bvh.run(level, &ray, triangles, search),
            Stage::Group(group, level) => {
                walk(&group.bvh, level, &ray, Instances { tracer: self, placed: &group.instances, ray }, search);
            }
        }
    }

    /// Moves a distant ray to its entry into the region of an object; `None` if it misses the region. If doubles do not
    /// decide, rational arithmetic on the ray itself does. `[INST-7]`
    #[cold]
    #[inline(never)]
    fn approach(&self, ray: &EnclosedRay, region: &Region, search: &Search<'_, V>) -> Option<EnclosedRay> {
        match ray.approach(region) {
            Approach::Misses => None,
            Approach::Enters(ray) => Some(ray),
            Approach::Unknown => search.ray.approach(&self.maps(&search.path), region),
        }
    }

    fn stage(&self, object: Object) -> Option<&Stage<V>> {
        self.stages.get(object.index())?.as_ref()
    }

    /// Returns the maps of the instances on a path, innermost first.
    fn maps(&self, path: &[u32]) -> Vec<AffineMap<V::Real>> {
        let (mut object, mut maps) = (self.root, Vec::new());
        for &index in path {
            if let Some(Stage::Group(group, _)) = self.stage(object) {
                let instance = &group.instances[index as usize];
                maps.push(instance.affine);
                object = instance.object;
            }
        }
        maps.reverse();
        maps
    }
}

/// The closest hit has the least exact distance, of equal distances the least path, and of equal paths the least
/// triangle. `[INST-6]` A ray is a [`Ray`](crate::geom::Ray), or starts on a surface. `[SECOND-2]`
impl<V: Vector, R: Sync> RayQueries<R> for InstanceTracer<V>
where
    for<'r> &'r R: Into<ExactRay<V>>,
{
    type Hit = InstanceHit<V::Real>;

    fn closest(&self, ray: &R) -> Option<Self::Hit> {
        self.one(&ray.into(), Wanted::Closest)
    }

    fn any(&self, ray: &R) -> bool {
        !self.search(&ray.into(), Wanted::Any).found.is_empty()
    }

    fn any_hit(&self, ray: &R) -> Option<Self::Hit> {
        self.one(&ray.into(), Wanted::AnyHit)
    }

    fn all(&self, ray: &R) -> Vec<Self::Hit> {
        let ray = ray.into();
        let mut found = self.search(&ray, Wanted::All).found;
        found.sort_by(|a, b| a.order(b, self, &ray));
        // A triangle may be in several leaves.
        found.dedup_by(|a, b| a.path == b.path && a.prim == b.prim);
        found.into_iter().filter_map(|found| self.hit(&ray, found)).collect()
    }
}

/// An object, and the data to traverse it.
#[derive(Debug)]
enum Stage<V: Vector> {
    Mesh(Arc<Bvh<Triangle<V>>>, Level),
    Wide(Arc<dyn WideObject<V>>, WideLevel),
    Group(Arc<Group<V::Real>>, Level),
}

impl<V: Vector> Stage<V> {
    /// Returns a region that contains the whole object.
    fn region(&self) -> &Region {
        match self {
            Self::Mesh(bvh, _) => bvh.region(),
            Self::Wide(bvh, _) => bvh.region(),
            Self::Group(group, _) => group.bvh.region(),
        }
    }

    fn new(object: usize, part: &Part<V>, groups: Method, meshes: Method) -> Result<Self, InstanceError> {
        let unfit = |unfit| InstanceError::Unsupported { object, unfit };
        Ok(match part {
            Part::Mesh(bvh) => {
                let level = Level::new(bvh, meshes, &Plan::new(bvh, meshes, QueryKind::Hit)).map_err(unfit)?;
                Self::Mesh(Arc::clone(bvh), level)
            }
            Part::Wide(bvh) => {
                let level = bvh.level(wide::Method::default());
                Self::Wide(Arc::clone(bvh), level.map_err(|unfit| InstanceError::UnsupportedWide { object, unfit })?)
            }
            Part::Group(group) => {
                let level =
                    Level::new(&group.bvh, groups, &Plan::new(&group.bvh, groups, QueryKind::Hit)).map_err(unfit)?;
                Self::Group(Arc::clone(group), level)
            }
        })
    }
}

impl<V: Vector> fmt::Debug for InstanceTracer<V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("InstanceTracer").field("root", &self.root).finish_non_exhaustive()
    }
}
