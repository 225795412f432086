//! `--build`: the builder of a scene's hierarchy.

use clap::builder::TypedValueParser;
use stackless_bvh::bvh::{BuildError, BuildOptions, Builder, Bvh, Degenerate, WideBvh, WideError};
use stackless_bvh::geom::{Precision, Triangle};
use stackless_bvh::traverse::Method;
use stackless_scene::Position;

use crate::input::{Scene, names};
use crate::output::bar;

/// The builders of the checks: the default, complete trees, and trees with split triangles.
pub(crate) const CHECKED: [Builder; 3] = [Builder::Standard, Builder::Median, Builder::Spatial];

/// Reads the name of a builder.
pub(crate) fn builder() -> impl TypedValueParser<Value = Builder> {
    names(Builder::ALL, Builder::name)
}

/// The chosen builder; by default `median` for the traversal `complete`, which needs a complete tree.
pub(crate) fn chosen(asked: Option<Builder>, methods: &[Method]) -> Builder {
    asked.unwrap_or(if methods.contains(&Method::Complete) { Builder::Median } else { Builder::default() })
}

/// Options for rays, which miss degenerate triangles.
pub(crate) fn options(builder: Builder) -> BuildOptions {
    BuildOptions { builder, degenerate: Degenerate::LeftOut, ..BuildOptions::default() }
}

/// Builds a binary hierarchy, with a progress bar.
pub(crate) fn binary<V: Position>(builder: Builder, scene: &Scene<V>) -> Result<Bvh<Triangle<V>>, BuildError> {
    watched(builder, scene, |progress| options(builder).build_watched(&scene.mesh, progress))
}

/// Builds a wide hierarchy for rays, with a progress bar.
pub(crate) fn wide<V: Precision + Position>(builder: Builder, scene: &Scene<V>) -> Result<WideBvh<8, V>, WideError> {
    wide_by(options(builder), scene)
}

/// Builds a wide hierarchy for points, with a progress bar. Degenerate triangles may be nearest to a point.
pub(crate) fn wide_for_points<V: Precision + Position>(
    builder: Builder,
    scene: &Scene<V>,
) -> Result<WideBvh<8, V>, WideError> {
    wide_by(BuildOptions { builder, ..BuildOptions::default() }, scene)
}

fn wide_by<V: Precision + Position>(options: BuildOptions, scene: &Scene<V>) -> Result<WideBvh<8, V>, WideError> {
    watched(options.builder, scene, |progress| options.build_wide_watched(&scene.mesh, progress))
}

fn watched<V: Position, R>(builder: Builder, scene: &Scene<V>, run: impl FnOnce(&(dyn Fn(usize) + Sync)) -> R) -> R {
    let bar = bar(scene.mesh.triangles().len() as u64, &format!("{}, {builder}", scene.name));
    let built = run(&|placed| bar.inc(placed as u64));
    bar.finish_and_clear();
    built
}
