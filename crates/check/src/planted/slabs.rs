//! Box tests: the directed one, spoilt in one place; and others, held to its promise.

use std::fmt::Debug;
use std::marker::PhantomData;

use glam::Vec3;

use super::draw::Draw;
use super::files::cast;
use super::layers::{Instead, Mistake, marks};
use crate::check_slabs;
use stackless_bvh::generate::Source;
use stackless_bvh::geom::kernel::Exact;
use stackless_bvh::geom::slabs::{Directed, EnclosedSlabs, Intervals, Plain, TwoSided};
use stackless_bvh::geom::{Aabb, Ray, Region, Slabs};

pub(super) const MISTAKES: [Mistake; 11] = [
    of::<Plain>("nothing is padded", "BOX-2"),
    of::<TwoSided>("padded on both sides, for rays of any size", "BOX-5"),
    of::<Spoilt<Rounded>>("reciprocals as they are rounded", "BOX-4"),
    of::<Spoilt<WrongWay>>("reciprocals moved the wrong way", "BOX-1"),
    of::<Spoilt<Late>>("entered a float too late", "BOX-2"),
    of::<Spoilt<NotANumber>>("0 times infinity bounds the ray", "BOX-1"),
    of::<Spoilt<MinusZero>>("-0 has a negative reciprocal", "BOX-1"),
    of::<Spoilt<NotExchanged>>("lo and hi not exchanged for negative directions", "BOX-1"),
    of::<Spoilt<Strict>>("a box that is only touched is skipped", "BOX-2"),
    of::<Spoilt<BeforeEnd>>("a box at the end of the ray is skipped", "BOX-2"),
    of::<Spoilt<FirstLane>>("the second box is hit if the first one is", "BOX-3"),
];

pub(super) const CONTROLS: [Mistake; 4] = [
    of::<Directed>("the directed test", "BOX-2"),
    of::<EnclosedSlabs>("the test of enclosed rays", "INST-4"),
    of::<Spoilt<Nothing>>("the directed test, wrapped", "BOX-2"),
    of::<Spoilt<Plainly>>("the directed test, written plainly", "BOX-1"),
];

const fn of<B: Slabs<Vector = Vec3>>(name: &'static str, clause: &'static str) -> Mistake {
    Mistake::new(name, clause, fault::<B>, Instead::Rays(cast::<Exact, B>))
}

fn fault<B: Slabs<Vector = Vec3>>(draw: &mut Draw<'_>) -> Option<String> {
    let bits = draw.bits();
    let (mut points, flat) = ([(); 4].map(|()| draw.ints(bits)), draw.below(6) as usize);
    // Often without extent along an axis.
    if flat < 3 {
        points[1][flat] = points[0][flat];
    }
    let [inner, other] = [Aabb::of(&points[..2]), Aabb::of(&points[2..])];
    let target = draw.target(bits, [inner.lo, inner.hi, inner.lo.with_x(inner.hi.x)]);
    let ray = draw.ray(bits, target)?;
    check_slabs::<B>(&ray, &inner, &other, true).err().map(|fault| fault.to_string())
}

marks! { Nothing Plainly Rounded WrongWay Late NotANumber MinusZero NotExchanged Strict BeforeEnd FirstLane }

/// The directed test with a mistake.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spoilt<S> {
    directed: Directed,
    ray: Ray,
    spoil: PhantomData<S>,
}

impl<S: Spoil> Slabs for Spoilt<S> {
    type Vector = Vec3;

    fn new(ray: &Ray, region: &Region) -> Self {
        Self { directed: Directed::new(ray, region), ray: *ray, spoil: PhantomData }
    }

    fn pair(&self, planes: &[[f32; 4]; 3], tmax: f32) -> Intervals<f32> {
        let found = self.directed.pair(planes, tmax);
        match S::BUG {
            Bug::Plainly => self.stepped(2, planes, tmax).unwrap_or(found),
            Bug::Rounded => self.stepped(0, planes, tmax).unwrap_or(found),
            Bug::WrongWay => self.stepped(-2, planes, tmax).unwrap_or(found),
            // The two floats of the reciprocal are up to three of the distance.
            Bug::Late => {
                Intervals { near: found.near.map(|near| (0..4).fold(near, |near, _| near.next_up())), ..found }
            }
            Bug::FirstLane => Intervals { hit: [found.hit[0]; 2], ..found },
            _ => {
                let keeps = |i: usize| {
                    let planes = planes.map(|axis| [axis[2 * i], axis[2 * i + 1]]);
                    self.keeps(planes, [found.near[i], found.far[i]], tmax)
                };
                Intervals { hit: [0, 1].map(|i| found.hit[i] && keeps(i)), ..found }
            }
        }
    }
}

impl<S: Spoil> Spoilt<S> {
    /// Whether a box that the directed test enters is entered: the planes, the part of the ray in it, and the ray's
    /// end.
    fn keeps(&self, planes: [[f32; 2]; 3], [near, far]: [f32; 2], tmax: f32) -> bool {
        let (o, d) = (self.ray.origin(), self.ray.direction());
        let mut axes = 0..3;
        match S::BUG {
            Bug::NotANumber => axes.all(|axis| d[axis] != 0.0 || !planes[axis].contains(&o[axis])),
            // (lo - o) times minus infinity is the near distance.
            Bug::MinusZero => {
                axes.all(|axis| d[axis].to_bits() != (-0.0_f32).to_bits() || planes[axis].contains(&o[axis]))
            }
            Bug::NotExchanged => axes.all(|axis| d[axis] >= 0.0 || planes[axis][0] == planes[axis][1]),
            Bug::Strict => near < far,
            Bug::BeforeEnd => near < tmax,
            _ => true,
        }
    }

    /// [BOX-1] as it is written, with another number of steps; extreme numbers are left to double precision.
    fn stepped(&self, steps: i32, planes: &[[f32; 4]; 3], tmax: f32) -> Option<Intervals<f32>> {
        let (o, d) = (self.ray.origin(), self.ray.direction());
        if d.to_array().iter().any(|&d| d != 0.0 && d.recip().abs() >= f32::MAX) {
            return None;
        }
        let part = |i: usize| {
            let mut part = [self.ray.tmin(), tmax];
            for axis in 0..3 {
                let (lo, hi) = (planes[axis][2 * i], planes[axis][2 * i + 1]);
                let ([first, last], size) = (if d[axis] < 0.0 { [hi, lo] } else { [lo, hi] }, d[axis].abs());
                let way = |plane: f32| if d[axis] < 0.0 { o[axis] - plane } else { plane - o[axis] };
                let moved = |by: i32| f32::from_bits(size.recip().to_bits().wrapping_add_signed(by));
                let away = if size == 0.0 { f32::INFINITY } else { moved(steps) };
                // A NaN is dropped.
                part = [part[0].max(way(first) * moved(-steps)), part[1].min(way(last) * away)];
            }
            part
        };
        let [[near, far], [other_near, other_far]] = [part(0), part(1)];
        let hit = [near <= far, other_near <= other_far];
        Some(Intervals { hit, near: [near, other_near], far: [far, other_far] })
    }
}
