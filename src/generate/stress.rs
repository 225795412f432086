//! The stress suite: scenes and rays that are hard to trace correctly, from fixed seeds.
//!
//! Each [`StressCase`] takes one weakness of ray tracers to its limit: rays through edges and corners, triangles
//! thinner than an ulp, distances between two floats, coordinates at both ends of the range. A case has only the
//! inputs: the truth is computed elsewhere, over the whole mesh.
//!
//! All numbers are computed with operations that IEEE 754 rounds exactly (`+ - * /`, square root, powers of two by
//! their bits), so the cases are identical on every machine. Each case has a separate seed, from its name: a new case
//! changes no other case. The first rays of a case do not depend on the requested number.
//!
//! Origins of the ideas: the trackers of ray tracers (numbers in [`StressCase::about`]) and Woop, Benthin & Wald 2013,
//! "Watertight ray/triangle intersection"; Ize 2013, "Robust BVH ray traversal"; Wächter & Binder 2019, "A fast and
//! robust method for avoiding self-intersection"; Shewchuk 1997, "Adaptive precision floating-point arithmetic".
//!
//! ```
//! use stackless_bvh::generate::stress;
//!
//! let case = stress::case("t-junction", 100).expect("a case of this name");
//! assert_eq!(case.rays.len(), 100);
//! assert_eq!(stress::cases(1).count(), stress::NAMES.len());
//! ```

mod aim;
mod boxes;
mod build;
mod closed;
mod degenerate;
mod families;
mod lattice;
mod range;
mod scenes;
mod sphere;
mod ties;
mod wide;

pub use aim::aimed;
pub use sphere::icosphere;

use super::draw::Draw;
use crate::geom::{Mesh, Ray};
use aim::Target;

/// A mesh, and rays that are hard to trace through it.
#[derive(Clone, Debug, PartialEq)]
pub struct StressCase {
    /// One of [`NAMES`].
    pub name: &'static str,
    /// The difficulty, in one line, and its source if it was published.
    pub about: &'static str,
    /// From 12 to 2,000 triangles, mostly several hundred.
    pub mesh: Mesh,
    /// The requested number of rays.
    pub rays: Vec<Ray>,
    /// Whether each ray must hit: the mesh is closed (every edge is shared by two triangles that run along it in
    /// opposite directions), every origin is strictly inside (the mesh winds around it an odd number of times), and
    /// every ray has the interval from 0 to infinity. The number of crossings is odd.
    ///
    /// Rounding may have made some triangles of a closed mesh degenerate. This opens no gap.
    pub closed: bool,
}

/// The names of all cases, in order.
pub const NAMES: [&str; COUNT] = {
    let mut names = [""; COUNT];
    let (mut group, mut next) = (0, 0);
    while group < GROUPS.len() {
        let mut i = 0;
        while i < GROUPS[group].len() {
            names[next] = GROUPS[group][i].name;
            (next, i) = (next + 1, i + 1);
        }
        group += 1;
    }
    names
};

/// Returns all cases, in the order of [`NAMES`], each built on demand, with `rays_per_case` rays.
pub fn cases(rays_per_case: usize) -> impl Iterator<Item = StressCase> {
    GROUPS.into_iter().flatten().filter_map(move |recipe| recipe.case(rays_per_case))
}

/// Returns the case of this name with `rays` rays, or `None` if there is no such case.
pub fn case(name: &str, rays: usize) -> Option<StressCase> {
    GROUPS.into_iter().flatten().find(|recipe| recipe.name == name)?.case(rays)
}

const GROUPS: [&[Recipe]; 9] = [
    families::CASES,
    lattice::CASES,
    wide::CASES,
    ties::CASES,
    degenerate::CASES,
    boxes::CASES,
    range::CASES,
    scenes::CASES,
    closed::CASES,
];

const COUNT: usize = {
    let (mut group, mut count) = (0, 0);
    while group < GROUPS.len() {
        count += GROUPS[group].len();
        group += 1;
    }
    count
};

/// The generator of a case.
struct Recipe {
    name: &'static str,
    about: &'static str,
    closed: bool,
    mesh: fn(&mut Draw) -> Option<Mesh>,
    ray: MakeRay,
}

/// One ray at a target, of the kind that the running number selects; `None` if the numbers are not a ray.
type MakeRay = fn(&mut Draw, &Target<'_>, usize) -> Option<Ray>;

impl Recipe {
    const fn new(name: &'static str, about: &'static str, mesh: fn(&mut Draw) -> Option<Mesh>, ray: MakeRay) -> Self {
        Self { name, about, closed: false, mesh, ray }
    }

    const fn closed(self) -> Self {
        Self { closed: true, ..self }
    }

    /// `None` would be an error in the recipe; a test checks that none has it.
    fn case(&self, rays: usize) -> Option<StressCase> {
        let mut draw = Draw::named(self.name);
        let mesh = (self.mesh)(&mut draw)?;
        let target = Target::new(&mesh);
        let rays = draw.rays(rays, |draw, i| (self.ray)(draw, &target, i));
        Some(StressCase { name: self.name, about: self.about, mesh, rays, closed: self.closed })
    }
}

#[cfg(test)]
mod tests;
