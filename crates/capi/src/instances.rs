//! Instances of scenes, without `unsafe`.

use std::collections::HashMap;
use std::sync::Arc;

use glam::{DVec3, Vec3};
use rayon::ThreadPool;
use stackless_bvh::bvh::BuildOptions;
use stackless_bvh::geom::{AffineMap, Precision, Real as _};
use stackless_bvh::trace::{self, Assembly, Instance, InstanceHit as Found, InstanceTracer, RayQueries as _};
use stackless_bvh::traverse::Method;

use crate::error::{Error, Fault};
use crate::exact::Exact;
use crate::filters::{Filters, OneFilter};
use crate::memory::{Anywhere, In, Out, room};
use crate::queries::{Rays, Real, batch, checked};
use crate::scene::{Scene, builder, pool, shared};
use crate::types::{InstanceHit, Options, Ray, STACKLESS_MAX_LEVELS, STACKLESS_NO_FACE};

/// Scenes and other instances, placed by affine maps. They share the hierarchies of their scenes. Any number of threads
/// may query them at the same time.
#[derive(Debug)]
pub struct Instances<V: Precision> {
    assembly: Assembly<V>,
    root: trace::Object,
    tracer: InstanceTracer<V>,
    /// The masks of the scenes that have masks.
    masks: HashMap<trace::Object, Arc<[u32]>>,
    pool: Option<ThreadPool>,
}

/// Queries need no lock.
const _: () = {
    const fn is_shared<T: Sync + Send>() {}
    is_shared::<Instances<Vec3>>();
    is_shared::<Instances<DVec3>>();
};

/// A scene or a group of instances. Of the two pointers, one is null.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Object<V: Precision> {
    /// A scene, or null.
    pub scene: *const Scene<V>,
    /// Instances, or null.
    pub instances: *const Instances<V>,
}

/// An object of the caller, by reference.
#[derive(Debug)]
pub(crate) enum Source<'a, V: Precision> {
    Scene(&'a Scene<V>),
    Instances(&'a Instances<V>),
}

/// Maps in the format of C.
pub(crate) type Transforms<'a, V> = In<'a, Anywhere<[[Real<V>; 4]; 3]>>;

/// The filters of rays of instances.
pub(crate) type InstanceFilters<'a, R> = Filters<'a, Ray<R>, InstanceHit<R>, InstanceHit<R>>;

impl<V: Precision> Instances<V> {
    pub(crate) fn new(
        sources: &[Source<'_, V>],
        indices: &In<'_, u32>,
        transforms: &Transforms<'_, V>,
        options: Options,
    ) -> Result<Self, Fault> {
        let (builder, pool) = (builder(options.quality)?, pool(options.threads)?);
        let (mut assembly, mut masks, mut objects) = (Assembly::new(), HashMap::new(), room(sources.len())?);
        // Instances come first, because an empty assembly shares all groups of the first one.
        for (index, source) in sources.iter().enumerate() {
            if let Source::Instances(other) = source {
                let added = assembly.append(&other.assembly);
                masks.extend(other.masks.iter().map(|(&object, masks)| (added(object), Arc::clone(masks))));
                objects.push((index, added(other.root)));
            }
        }
        for (index, source) in sources.iter().enumerate() {
            if let Source::Scene(scene) = source {
                let object = assembly.add_wide::<V>(Arc::clone(scene.bvh()));
                if !scene.masks().is_empty() {
                    masks.insert(object, Arc::clone(scene.masks()));
                }
                objects.push((index, object));
            }
        }
        objects.sort_unstable_by_key(|&(index, _)| index);
        let mut placed = room(indices.count())?;
        for index in 0..indices.count() {
            let found = indices.get(index);
            let Some(&(_, object)) = objects.get(found as usize) else {
                let (element, count) = (indices.element(index), objects.len());
                return Err(Fault::argument(format!("{element}: {found}, expected less than object_count, {count}")));
            };
            let Anywhere(rows) = transforms.get(index);
            let affine = AffineMap::new(rows).map_err(|error| Fault::of_affine(error, transforms.element(index)))?;
            placed.push(Instance { object, affine });
        }
        let build = BuildOptions { builder, ..BuildOptions::default() };
        let root = shared(pool.as_ref(), || assembly.add_group(placed, &build))?;
        let tracer = InstanceTracer::new(&assembly, root, Method::default());
        let tracer = tracer.map_err(|error| Fault::new(Error::Internal, error))?;
        Ok(Self { assembly, root, tracer, masks, pool })
    }

    /// The number of groups that contain each other.
    pub(crate) fn levels(&self) -> usize {
        self.assembly.levels(self.root) as usize - 1
    }

    /// The corners of a box that contains all faces.
    pub(crate) fn bounds(&self) -> [[Real<V>; 3]; 2] {
        // The assembly has its root.
        self.assembly.bounds(self.root).map(|bounds| bounds.map(V::components)).unwrap_or_default()
    }

    pub(crate) fn closest1(
        &self,
        rays: &Rays<'_, V>,
        filters: &InstanceFilters<'_, Real<V>>,
        index: usize,
    ) -> Result<InstanceHit<Real<V>>, Fault> {
        let (ray, filter) = (checked::<V>(rays, index)?, filters.get(index, rays)?);
        Ok(hit::<V>(
            match filter {
                None => self.tracer.closest(&ray),
                Some(filter) => self.ask(&filter, |filter| self.tracer.filtered(filter).closest(&ray)),
            }
            .as_ref(),
        ))
    }

    pub(crate) fn any1(
        &self,
        rays: &Rays<'_, V>,
        filters: &InstanceFilters<'_, Real<V>>,
        index: usize,
    ) -> Result<bool, Fault> {
        let (ray, filter) = (checked::<V>(rays, index)?, filters.get(index, rays)?);
        Ok(match filter {
            None => self.tracer.any(&ray),
            Some(filter) => self.ask(&filter, |filter| self.tracer.filtered(filter).any(&ray)),
        })
    }

    pub(crate) fn all1(
        &self,
        ray: &Rays<'_, V>,
        filters: &InstanceFilters<'_, Real<V>>,
    ) -> Result<Vec<InstanceHit<Real<V>>>, Fault> {
        let (checked, filter) = (checked::<V>(ray, 0)?, filters.get(0, ray)?);
        let hits = match filter {
            None => self.tracer.all(&checked),
            Some(filter) => self.ask(&filter, |filter| self.tracer.filtered(filter).all(&checked)),
        };
        Ok(hits.iter().map(|found| hit::<V>(Some(found))).collect())
    }

    pub(crate) fn closest_n(
        &self,
        rays: &Rays<'_, V>,
        filters: &InstanceFilters<'_, Real<V>>,
        hits: Out<'_, InstanceHit<Real<V>>>,
        flags: u32,
    ) -> Result<(), Fault> {
        batch(self.pool.as_ref(), hits, flags, |range| range.map(|index| self.closest1(rays, filters, index)).collect())
    }

    pub(crate) fn any_n(
        &self,
        rays: &Rays<'_, V>,
        filters: &InstanceFilters<'_, Real<V>>,
        hits: Out<'_, bool>,
        flags: u32,
    ) -> Result<(), Fault> {
        batch(self.pool.as_ref(), hits, flags, |range| range.map(|index| self.any1(rays, filters, index)).collect())
    }

    /// The masks of the scene at the end of a path.
    fn masks_at(&self, path: &[u32]) -> &[u32] {
        if self.masks.is_empty() {
            return &[];
        }
        self.tracer.object(path).and_then(|object| self.masks.get(&object)).map_or(&[], |masks| masks)
    }
}

impl<V: Precision> Exact<V> for Instances<V> {
    type Skip = InstanceHit<Real<V>>;

    type Hit = InstanceHit<Real<V>>;

    fn tracer(&self) -> Result<&InstanceTracer<V>, Fault> {
        Ok(&self.tracer)
    }

    fn pool(&self) -> Option<&ThreadPool> {
        self.pool.as_ref()
    }

    fn hit(found: Option<&Found<Real<V>>>) -> Self::Hit {
        hit::<V>(found)
    }

    fn sees<Y>(&self, filter: &OneFilter<Y, Self::Skip, Self::Hit>, path: &[u32], face: u32) -> bool {
        let is_skipped = filter.skip.is_some_and(|skip| skip.face == face && is_path(&skip, path));
        !is_skipped && filter.sees(self.masks_at(path), face)
    }
}

impl<V: Precision> Source<'_, V> {
    /// Checks that another group may contain it.
    pub(crate) fn check(self) -> Result<Self, Fault> {
        let most = STACKLESS_MAX_LEVELS - 1;
        match &self {
            Source::Instances(other) if other.levels() > most => {
                Err(Fault::argument(format!("instances: {} levels of groups, expected at most {most}", other.levels())))
            }
            _ => Ok(self),
        }
    }
}

/// Returns whether a hit of the caller has this path.
fn is_path<R>(hit: &InstanceHit<R>, path: &[u32]) -> bool {
    hit.path.get(..hit.levels as usize) == Some(path)
}

fn hit<V: Precision>(found: Option<&Found<Real<V>>>) -> InstanceHit<Real<V>> {
    let nan = V::Real::rounded(f64::NAN);
    let none = [u32::MAX; STACKLESS_MAX_LEVELS];
    let miss = InstanceHit { t: V::Real::INFINITY, u: nan, v: nan, face: STACKLESS_NO_FACE, levels: 0, path: none };
    found.map_or(miss, |&Found { ref path, prim, t, u, v }| {
        let mut hit = InstanceHit { t, u, v, face: prim, levels: 0, path: none };
        for (index, &instance) in hit.path.iter_mut().zip(path) {
            *index = instance;
            hit.levels += 1;
        }
        hit
    })
}
