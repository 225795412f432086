//! What is nearest to a point over binary hierarchies, in single and in double precision.

use std::borrow::Borrow;

use super::{BinaryTracer, each, in_parallel};
use crate::bvh::Bvh;
use crate::geom::{Ball, EnvironmentError, Kernel, Slabs, Triangle, Vector};
use crate::trace::{Near, NearestPoint, NearestPoints, OwnBoxes};
use crate::tree::Node;

impl<T, K, B, V> BinaryTracer<T, K, B>
where
    T: Borrow<Bvh<Triangle<V>>>,
    K: Kernel<Vector = V, Shape = Triangle<V>>,
    B: Slabs<Vector = V>,
    V: Vector,
{
    /// The point of the mesh that is nearest to the middle of a ball, if there is one in it. `[NEAR-1]` Exact, whatever
    /// the tests for rays are.
    pub fn nearest(&self, ball: &Ball<V>) -> Option<Near<V>> {
        self.nearest_in(ball, &mut Vec::new())
    }

    /// [`nearest`](Self::nearest) of each ball, on this thread.
    pub fn nearest_each(&self, balls: &[Ball<V>]) -> Vec<Option<Near<V>>> {
        each(balls, |ball, memory| self.nearest_in(ball, memory))
    }

    /// [`nearest`](Self::nearest) of each ball, on all threads.
    ///
    /// # Errors
    /// [`EnvironmentError`], of any thread that took part.
    pub fn nearest_parallel(&self, balls: &[Ball<V>]) -> Result<Vec<Option<Near<V>>>, EnvironmentError>
    where
        T: Sync,
    {
        in_parallel(balls, |ball, memory| self.nearest_in(ball, memory))
    }

    /// The `k` triangles that are nearest to the middle of a ball, in order of distance and then index, as many as
    /// there are in the ball. `[NEAR-2]`
    ///
    /// ```
    /// use glam::DVec3;
    /// use stackless_bvh::geom::{Ball, Mesh, kernel::Exact64, slabs::Wide};
    /// use stackless_bvh::{bvh::Bvh, trace::BinaryTracer, traverse::Method};
    ///
    /// let mesh = Mesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z], vec![[0, 1, 2], [0, 1, 3]])?;
    /// let tracer = BinaryTracer::<_, Exact64, Wide>::with_tests(Bvh::build(&mesh)?, Method::default())?;
    /// let ball = Ball::around(DVec3::new(0.25, 0.5, -1e-10))?;
    /// assert_eq!(tracer.nearest(&ball).map(|near| (near.prim, near.distance)), Some((0, 1e-10)));
    /// assert_eq!(tracer.nearest_k(&ball, 9).len(), 2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn nearest_k(&self, ball: &Ball<V>, k: usize) -> Vec<Near<V>> {
        let bvh = self.bvh();
        let mut search = OwnBoxes::over(NearestPoints::new(bvh, ball, k), &self.level.boxes);
        self.level.run_shared(bvh.tree(), 0, &mut Vec::new(), &mut search);
        search.query.nears().collect()
    }

    fn nearest_in(&self, ball: &Ball<V>, memory: &mut Vec<Node>) -> Option<Near<V>> {
        let bvh = self.bvh();
        let mut search = OwnBoxes::over(NearestPoint::new(bvh, ball), &self.level.boxes);
        self.level.run_shared(bvh.tree(), 0, memory, &mut search);
        search.query.near()
    }
}
